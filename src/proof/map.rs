//! Is the characteristic map regular and injective, for every valence?
//!
//! Regular: the Jacobian is positive on the closed ring (Reif 1995); by the reflection half a sector is enough. Injective: if moreover the ring of a sector
//! is mapped into the open half plane around the sector's axis, then the map of the punctured plane is a covering whose winding number is 1. This is
//! proved in docs/theory.md; it asks for n >= 3, lambda > 0 and frequency 1. The half plane is a + b > 0 for a value a + b w where a sector begins on
//! a spoke, and a + b c > 0 on the dual lattice, where its axis is the middle of sector 0.

use super::course::{Range, range};
use super::jacobian::{ControlNet, Pieces};
use super::net::{Function, Net, Pair, polynomial_scale};
use super::outcome::{Outcome, Valences};
use super::positive::is_positive_quotient;
use super::ring::least_radius;
use crate::analysis::Analyzer;
use crate::analysis::exact::formulas::GENERIC;
use crate::mesh::{Label, Lattice, Patch};
use crate::numbers::{Field, Trouble};
use crate::refine::Obstacle;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt;

/// How a map was proved regular and injective.
#[derive(Clone, Debug, PartialEq)]
pub struct MapProof {
    /// The valences that it is proved for.
    pub valences: Valences,
    /// The parametrisation and its range.
    pub range: Range,
    /// How many functions were shown to be positive.
    pub functions: usize,
    /// Their largest degree.
    pub degree: usize,
}

impl fmt::Display for MapProof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "for {} at once, in exact arithmetic: {} rational functions of degree at most {} are positive",
            self.valences, self.functions, self.degree
        )
    }
}

/// Whether the characteristic maps of all n are regular and injective. Nothing is said of the spectrum: whether lambda is subdominant at every n is a
/// condition of its own.
pub fn prove(analyzer: &Analyzer) -> Outcome<MapProof> {
    attempt(analyzer).unwrap_or_else(|obstacle| Outcome::stuck(obstacle.to_string()))
}

fn attempt(analyzer: &Analyzer) -> Result<Outcome<MapProof>, Obstacle> {
    let lattice = analyzer.lattice();
    let forms = match analyzer.forms() {
        Ok(forms) => forms,
        Err(why) => return Ok(Outcome::stuck(why)),
    };
    if !forms.parameters.is_empty() {
        return Ok(Outcome::stuck("a parameter is left free"));
    }
    if forms.except.is_some() {
        return Ok(Outcome::stuck("the regular valence has rules of its own"));
    }
    if analyzer.steps() != 1 || analyzer.dilation() != 2 {
        return Ok(Outcome::stuck("the lattice is not halved by each step"));
    }
    let spline = analyzer.regular().ok().and_then(|regular| regular.spline.as_ref());
    let Some(pieces) = spline.and_then(|spline| Pieces::of(spline, lattice)) else {
        return Ok(Outcome::stuck(
            "limit functions on regular meshes are not of a kind whose Bezier points are known here",
        ));
    };
    let Some(range) = range(forms)? else {
        return Ok(Outcome::stuck("c and the subdominant eigenvalue are not rational functions of one parameter"));
    };
    let scheme = analyzer.scheme().with_values();
    let mut net = Net::of(&scheme, lattice, forms, range.course.clone())?;
    if !is_positive_quotient(&range.course.lambda, &range.interval)? {
        return Ok(Outcome::stuck("the subdominant eigenvalue is not seen to be positive"));
    }
    let row = |label: Label| net.row(label).ok();
    if least_radius(pieces, Patch::new(lattice, GENERIC), analyzer.clear_of_centre(), &row) != Some(1) {
        return Ok(Outcome::stuck("rules at the extraordinary point reach into the ring"));
    }
    let functions = match verify(&mut net, pieces, lattice, &range)? {
        Ok(functions) => functions,
        Err(at) => return Ok(Outcome::stuck(at)),
    };
    let degree = functions.iter().filter_map(|own| own.numerator().degree().max(own.denominator().degree())).max();
    let valences = Valences::From(forms.from);
    Ok(Outcome::Proved(MapProof { valences, range, functions: functions.len(), degree: degree.unwrap_or(0) }))
}

/// The functions that were shown to be positive, if S f = lambda f and all of them are; else where not. The map is looked at times a function
/// of the parameter, the same for all its values, which makes them polynomials: that is an eigenfunction, too.
///
/// # Errors
/// When a limit of size is passed.
pub fn verify(
    net: &mut Net,
    pieces: Pieces,
    lattice: Lattice,
    range: &Range,
) -> Result<Result<Vec<Function>, String>, Obstacle> {
    let mut controls = Controls(BTreeMap::new());
    for (i, j) in pieces.ring().into_iter().flat_map(|patch| pieces.stencil(patch)) {
        if let Entry::Vacant(place) = controls.0.entry((i, j)) {
            place.insert(net.at(i, j)?);
        }
    }
    let scale = polynomial_scale(|| controls.0.values().flat_map(|(a, b)| [a, b]), &range.interval.low)?;
    for (a, b) in controls.0.values_mut() {
        (*a, *b) = (a.times(&scale)?, b.times(&scale)?);
    }
    let mut functions = Vec::new();
    for patch in pieces.ring() {
        let points = pieces.bezier(&mut controls, patch)?;
        for (index, value) in pieces.jacobian(&points)? {
            if !is_positive_quotient(&value, &range.interval)? {
                return Ok(Err(format!("coefficient {index:?} of the Jacobian on the patch at {:?}", patch.0)));
            }
            functions.push(value);
        }
        for (index, point) in &points {
            let value = along_axis(point, lattice, &range.course.c)?;
            if !is_positive_quotient(&value, &range.interval)? {
                return Ok(Err(format!("Bezier point {index:?} of the patch at {:?}: not in the half plane", patch.0)));
            }
            functions.push(value);
        }
    }
    if !net.satisfies_its_equation()? || !net.has_no_pole(&range.interval)? {
        return Ok(Err("the net doesn't satisfy S f = lambda f".to_string()));
    }
    Ok(Ok(functions))
}

/// The net at the controls of the ring.
struct Controls(BTreeMap<(i32, i32), Pair>);

impl ControlNet for Controls {
    type Value = Function;

    fn at(&mut self, i: i32, j: i32) -> Result<Pair, Obstacle> {
        let missing = || Obstacle::Limit("a control of the ring is missing".to_string());
        self.0.get(&(i, j)).cloned().ok_or_else(missing)
    }
}

fn along_axis((a, b): &Pair, lattice: Lattice, c: &Function) -> Result<Function, Trouble> {
    if lattice.has_centre() { a.plus(b) } else { a.plus(&b.times(c)?) }
}
