//! Is the characteristic map of a piecewise polynomial scheme regular and injective, by enclosures?
//!
//! The same two tests as in [`crate::proof::map`], for what that does not reach: single valences with rules of their
//! own ([`super::valence`]), and B-splines of any degree, whose wider stencils ask for a ring further out ([`crate::proof::ring`]). Values
//! are enclosed ([`super::enclosed_net`]), so that a sign is proven ([`signs`]): at one valence, or on boxes of c that cover
//! all valences from one on ([`crate::proof::family`]). Where the Jacobian is certainly negative at a point, the map is not injective
//! (docs/theory.md).

pub mod enclosed_map;
pub mod signs;

use super::family::{CosineBox, Family, Open};
use super::jacobian::Pieces;
use super::outcome::{Outcome, Valences};
use super::ring::{half_sector, radius_at};
use super::valence::net_at;
use crate::analysis::Analyzer;
use crate::analysis::exact::ExactAnalysis;
use crate::mesh::Patch;
use crate::numbers::Interval;
use crate::refine::Obstacle;
use enclosed_map::EnclosedMap;
use signs::Reader;

/// A patch is quartered so often; on a box, before that is halved.
const DEPTH: usize = 5;
const DEPTH_ON_A_BOX: usize = 1;

/// Whether the characteristic maps of these valences are regular and injective. Nothing is said of the spectrum.
pub fn prove(analyzer: &Analyzer, valences: Valences) -> Outcome<EnclosedMap> {
    match valences {
        Valences::At(n) => match analyzer.at(n).map(|analysis| analysis.exact) {
            Ok(Ok(exact)) => prove_at(analyzer, n, &exact),
            Ok(Err(why)) => Outcome::stuck(why),
            Err(obstacle) => Outcome::stuck(obstacle.to_string()),
        },
        Valences::From(first) => {
            attempt_from(analyzer, first).unwrap_or_else(|obstacle| Outcome::stuck(obstacle.to_string()))
        }
    }
}

/// From the valence on from which the forms hold by boxes of c; those before it, and one with rules of its own, apart.
fn attempt_from(analyzer: &Analyzer, first: usize) -> Result<Outcome<EnclosedMap>, Obstacle> {
    let pieces = match pieces(analyzer) {
        Ok(pieces) => pieces,
        Err(why) => return Ok(Outcome::stuck(why)),
    };
    let scheme = analyzer.scheme().with_values();
    let family = match Family::of(analyzer, &scheme)? {
        Ok(family) => family,
        Err(why) => return Ok(Outcome::stuck(why)),
    };
    let Some(radius) = family.radius(pieces) else { return Ok(Outcome::stuck(NO_RING)) };
    let first = first.max(3);
    let from = family.from().max(first);
    let mut whole = EnclosedMap { valences: Valences::From(first), pieces, radius, patches: 0, boxes: Vec::new() };
    for n in (first..from).chain(family.except().filter(|n| *n >= from)) {
        match prove(analyzer, Valences::At(n)) {
            Outcome::Proved(own) => {
                whole.radius = whole.radius.max(own.radius);
                whole.patches += own.patches;
                whole.boxes.extend(own.boxes);
            }
            other => return Ok(other),
        }
    }
    let (patches, mut looked_at) = (half_sector(pieces, radius), 0);
    let cover = family.cover(from, |net| {
        let signs = Reader::read(net, pieces, &patches, DEPTH_ON_A_BOX)?;
        match signs.missing() {
            Some(why) => Err(Open::yet(why)),
            None => {
                looked_at += signs.patches;
                Ok(())
            }
        }
    });
    Ok(match cover {
        Ok(boxes) => {
            whole.patches += looked_at;
            whole.boxes.extend(boxes);
            Outcome::Proved(whole)
        }
        Err((c, why)) => Outcome::stuck(format!("c from {} to {}: {why}", c.lo(), c.hi())),
    })
}

const NO_RING: &str = "rules at the extraordinary point reach into every ring that was tried";

/// Whether the characteristic map of one valence is, from the exact analysis there.
pub fn prove_at(analyzer: &Analyzer, n: usize, analysis: &ExactAnalysis) -> Outcome<EnclosedMap> {
    attempt_at(analyzer, n, analysis).unwrap_or_else(|obstacle| Outcome::stuck(obstacle.to_string()))
}

fn attempt_at(analyzer: &Analyzer, n: usize, analysis: &ExactAnalysis) -> Result<Outcome<EnclosedMap>, Obstacle> {
    if n < 3 {
        return Ok(Outcome::stuck("the valence is below 3"));
    }
    let pieces = match pieces(analyzer) {
        Ok(pieces) => pieces,
        Err(why) => return Ok(Outcome::stuck(why)),
    };
    let scheme = analyzer.scheme().with_values();
    let patch = Patch::new(analyzer.lattice(), n);
    let Some(radius) = radius_at(analyzer, &scheme, pieces, patch) else {
        return Ok(Outcome::stuck(NO_RING));
    };
    let mut net = match net_at(&scheme, analyzer.lattice(), n, analysis)? {
        Ok(net) => net,
        Err(why) => return Ok(Outcome::stuck(why)),
    };
    let signs = Reader::read(&mut net, pieces, &half_sector(pieces, radius), DEPTH)?;
    if !net.may_satisfy_its_equation()? {
        return Ok(Outcome::stuck(format!("n = {n}: the net doesn't satisfy S f = lambda f")));
    }
    Ok(match (signs.missing(), &signs.negative) {
        (Some(witness), Some(_)) => Outcome::Refuted { witness: format!("n = {n}: {witness}") },
        (Some(at), None) => Outcome::stuck(format!("n = {n}: {at}")),
        (None, _) => {
            let (c, lambda) = (Interval::enclosing(&net.c), Interval::enclosing(&net.lambda));
            let boxes = vec![CosineBox { only: Some(n), c, lambda }];
            Outcome::Proved(EnclosedMap { valences: Valences::At(n), pieces, radius, patches: signs.patches, boxes })
        }
    })
}

/// What the limit functions on regular meshes are, or why that is not enough here.
fn pieces(analyzer: &Analyzer) -> Result<Pieces, &'static str> {
    if analyzer.steps() != 1 || analyzer.dilation() != 2 {
        return Err("the lattice is not halved by each step");
    }
    let spline = analyzer.regular().ok().and_then(|regular| regular.spline.as_ref());
    let pieces = spline.and_then(|spline| Pieces::of(spline, analyzer.lattice()));
    pieces.ok_or("limit functions on regular meshes are not of a kind whose Bezier points are known here")
}
