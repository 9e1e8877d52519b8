//! Does a rule look the same from every side?
//!
//! Names of positions let a file break the symmetry of its mesh (`ring[0]` in a vertex rule prefers one edge). A scheme
//! must treat all edges of a vertex alike, both halves of an edge, all corners of a face, and left like right: else there
//! are no blocks to analyse. Checked on rows around the centre and far from it, in `f64`, to 1e-12.

use super::{Obstacle, Pass, Refinement, Row};
use crate::fault::{Fault, Faults};
use crate::mesh::{Connectivity, Label, Patch, Placement, Site};
use crate::scheme::Scheme;
use crate::scheme::vocabulary::RuleKind;
use std::collections::BTreeSet;

/// How far the weights of symmetric rows may differ: rounding of formulas, far below any intended weight.
const TOLERANCE: f64 = 1e-12;

/// Checks rotation and reflection at the valences asked for and at the regular one.
///
/// # Errors
/// The rules that break a symmetry, or that have no value.
pub fn check_symmetry(scheme: &Scheme, valences: &[usize]) -> Result<(), Faults> {
    let refinement = Refinement::<f64>::new(scheme, None);
    let cycle = match refinement.cycle() {
        Ok(cycle) => cycle,
        Err(obstacle) => return Err(scheme.book.faults(vec![Fault::whole(obstacle.to_string())])),
    };
    let mut faults: Vec<Fault> = Vec::new();
    let tried: BTreeSet<usize> = valences.iter().copied().chain([scheme.regular_valence()]).collect();
    for valence in tried {
        for (pass, placement) in refinement.passes().iter().zip(&cycle.placements) {
            for fault in check_pass(pass, placement, valence) {
                if faults.iter().all(|known| known.span != fault.span) {
                    faults.push(fault);
                }
            }
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(scheme.book.faults(faults)) }
}

fn check_pass(pass: &Pass<f64>, placement: &Placement, valence: usize) -> Vec<Fault> {
    let (fine, coarse) = (Patch::new(placement.to, valence), Patch::new(placement.from, valence));
    let first = i32::from(fine.lattice.has_centre());
    let around = (first..4).flat_map(|i| (0..4).map(move |j| Label { sector: 0, i, j }));
    let labels = fine.centre().into_iter().chain(around);
    // the mirror fixes spoke 0, or on the dual lattice corner 0, half a sector on
    let shift = i32::from(!coarse.lattice.has_centre()) - i32::from(!fine.lattice.has_centre());
    let image = |label: Label| fine.rotated(fine.mirrored(label), shift);
    let sites = labels.map(|label| [coarse.birth(placement, label), coarse.birth(&placement.mirrored(), image(label))]);
    sites.filter_map(|[site, image]| check_point(pass, &coarse, site, image).err()).collect()
}

fn check_point(pass: &Pass<f64>, patch: &Patch, site: Site, image_site: Site) -> Result<(), Fault> {
    let (kind, span) = told_by(pass, patch, site);
    let fail = |obstacle: Obstacle| match obstacle {
        Obstacle::Fault(fault) => fault,
        other => Fault::at(span.clone(), other.to_string(), "this rule"),
    };
    let row = pass.row_at(patch, site).map_err(fail)?;
    let turned = pass.row_at(patch, seen_from_next_side(patch, site)).map_err(fail)?;
    if !agree(&row, &turned) {
        let message = format!("[{}] is not the same seen from every side", kind.name());
        let fault = Fault::at(span, message, format!("at n = {}", patch.valence));
        return Err(fault.hint("give weights to whole classes of points: no edge or end comes first"));
    }
    let mirrored = pass.row_at(patch, image_site).map_err(fail)?;
    let mut image: Row<Label, f64> = row.iter().map(|(old, weight)| (patch.mirrored(*old), *weight)).collect();
    image.sort_by_key(|(old, _)| *old);
    if !agree(&image, &mirrored) {
        let message = format!("[{}] tells left from right", kind.name());
        let fault = Fault::at(span, message, format!("at n = {}", patch.valence));
        return Err(fault.hint("weights must not change under reflection: ring[j] and ring[-j] weigh the same"));
    }
    Ok(())
}

/// The same place from its next half-edge.
fn seen_from_next_side(patch: &Patch, site: Site) -> Site {
    match site {
        Site::Vertex(edge) => Site::Vertex(patch.turn(edge)),
        Site::Edge(edge) => Site::Edge(patch.twin(edge)),
        Site::Face(edge) => Site::Face(patch.next(edge)),
        // told from one side only
        Site::Corner(_) | Site::Kept(_) | Site::Third(_) => site,
    }
}

/// The rule that makes the point of a site, and its place in the file.
fn told_by(pass: &Pass<f64>, patch: &Patch, site: Site) -> (RuleKind, std::ops::Range<usize>) {
    let kind = match site {
        Site::Vertex(_) | Site::Kept(_) => RuleKind::Vertex,
        Site::Face(_) => RuleKind::Face,
        Site::Corner(_) => RuleKind::Corner,
        Site::Third(_) => RuleKind::CreaseThird,
        Site::Edge(edge) => {
            let regular = pass.scheme().regular_valence();
            let irregular = [edge, patch.twin(edge)].iter().any(|half| patch.valence(*half) != regular);
            let from_end = RuleKind::EdgeFromIrregularEnd;
            if irregular && pass.rules().contains_key(&from_end) { from_end } else { RuleKind::Edge }
        }
    };
    (kind, pass.rules().get(&kind).map_or(0..0, |rule| rule.span.clone()))
}

fn agree(left: &Row<Label, f64>, right: &Row<Label, f64>) -> bool {
    let (mut left, mut right) = (left.iter().peekable(), right.iter().peekable());
    loop {
        let difference = match (left.peek(), right.peek()) {
            (None, None) => return true,
            (Some((a, w)), Some((b, v))) if a == b => {
                let difference = w - v;
                left.next();
                right.next();
                difference
            }
            (Some((a, w)), other) if other.is_none_or(|(b, _)| a < b) => {
                let weight = *w;
                left.next();
                weight
            }
            (_, other) => {
                let weight = other.map_or(0.0, |(_, v)| *v);
                right.next();
                weight
            }
        };
        if difference.abs() > TOLERANCE {
            return false;
        }
    }
}
