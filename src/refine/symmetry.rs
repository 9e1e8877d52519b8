//! Does a rule look the same from every side?
//!
//! Names of positions let a file break the symmetry of its mesh (`ring[0]` in a vertex rule prefers one edge). A scheme
//! must treat all edges of a vertex alike, both halves of an edge, all corners of a face, and left like right: else there
//! are no blocks to analyse. Checked on rows around the centre and far from it, in `f64`, to 1e-12.

use super::{Obstacle, Refinement, Row, lattice_of};
use crate::fault::{Fault, Faults};
use crate::mesh::{Connectivity, Label, Patch, Site};
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
    let mut faults: Vec<Fault> = Vec::new();
    let tried: BTreeSet<usize> = valences.iter().copied().chain([scheme.regular_valence()]).collect();
    for valence in tried {
        if let Err(found) = check_patch(&refinement, Patch::new(lattice_of(scheme), valence)) {
            for fault in found {
                if faults.iter().all(|known| known.span != fault.span) {
                    faults.push(fault);
                }
            }
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(scheme.book.faults(faults)) }
}

fn check_patch(refinement: &Refinement<f64>, patch: Patch) -> Result<(), Vec<Fault>> {
    let first = i32::from(patch.lattice.has_centre());
    let around = (first..4).flat_map(|i| (0..4).map(move |j| Label { sector: 0, i, j }));
    let mut faults = Vec::new();
    for label in patch.centre().into_iter().chain(around) {
        if let Err(fault) = check_point(refinement, &patch, label) {
            faults.push(fault);
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

fn check_point(refinement: &Refinement<f64>, patch: &Patch, label: Label) -> Result<(), Fault> {
    let site = patch.birth(label);
    let (kind, span) = told_by(refinement, patch, site);
    let fail = |obstacle: Obstacle| match obstacle {
        Obstacle::Fault(fault) => fault,
        other => Fault::at(span.clone(), other.to_string(), "this rule"),
    };
    let row = refinement.row_at(patch, site).map_err(fail)?;
    let turned = refinement.row_at(patch, seen_from_next_side(patch, site)).map_err(fail)?;
    if !agree(&row, &turned) {
        let message = format!("[{}] is not the same seen from every side", kind.name());
        let fault = Fault::at(span, message, format!("at n = {}", patch.valence));
        return Err(fault.hint("give weights to whole classes of points: no edge or end comes first"));
    }
    let mirrored = refinement.row_at(patch, patch.birth(patch.mirrored(label))).map_err(fail)?;
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
        Site::Corner(edge) => Site::Corner(edge),
    }
}

/// The rule that makes the point of a site, and its place in the file.
fn told_by(refinement: &Refinement<f64>, patch: &Patch, site: Site) -> (RuleKind, std::ops::Range<usize>) {
    let scheme = refinement.scheme();
    let kind = match site {
        Site::Vertex(_) => RuleKind::Vertex,
        Site::Face(_) => RuleKind::Face,
        Site::Corner(_) => RuleKind::Corner,
        Site::Edge(edge) => {
            let irregular =
                [edge, patch.twin(edge)].iter().any(|half| patch.valence(*half) != scheme.regular_valence());
            let from_end = RuleKind::EdgeFromIrregularEnd;
            if irregular && scheme.book.rules.contains_key(&from_end) { from_end } else { RuleKind::Edge }
        }
    };
    (kind, scheme.book.rules.get(&kind).map_or(0..0, |rule| rule.span.clone()))
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
