//! What is the net of the characteristic map at one valence, enclosed, and on which ring is it a spline?
//!
//! The eigenvalue is enclosed by the exact analysis, which also tells that it is simple in the block of frequency 1;
//! the vector is the one that the block less the eigenvalue sends to zero ([`super::kernel`]). Any weight that can be
//! enclosed will do. Whether a row is regular is asked of exact weights.

use super::enclosed_net::EnclosedNet;
use super::kernel::null_vector;
use super::ring::least_radius;
use crate::analysis::Analyzer;
use crate::analysis::exact::block::{Block, Wave};
use crate::analysis::exact::rows::Rows;
use crate::analysis::exact::{BITS, ExactAnalysis, Value};
use crate::mesh::{Label, Patch};
use crate::numbers::linear::{part, shifted};
use crate::numbers::{Angle, AtValence, Cosine, EnclosedWorld, PerFrequency, World};
use crate::proof::jacobian::Pieces;
use crate::proof::net::placed;
use crate::refine::{Count, EnclosedWeights, ExactWeights, Obstacle, Refinement};
use crate::scheme::Scheme;
use dashu_ratio::RBig;
use std::cell::Cell;
use std::rc::Rc;

static WORLD: EnclosedWorld<BITS> = EnclosedWorld::<BITS>;

/// The count that tells the centre from other places; at the regular valence all are alike.
fn centre(scheme: &Scheme, n: usize) -> usize {
    if n == scheme.regular_valence() { usize::MAX } else { n }
}

/// The net at valence n of a scheme whose parameters have values; `None` where the analysis doesn't tell a simple, real
/// and positive subdominant eigenvalue of frequency 1.
///
/// # Errors
/// When weights can't be enclosed, or enclosures are too wide.
pub fn net_at<'s>(
    scheme: &'s Scheme,
    analysis: &ExactAnalysis,
    patch: Patch,
) -> Result<Option<EnclosedNet<'s, Value>>, Obstacle> {
    let n = patch.valence as usize;
    let Some(lambda) = analysis.lambda.map(|index| analysis.eigenvalues[index].re.clone()) else { return Ok(None) };
    let c = WORLD.cos(&Angle::fixed(RBig::from(1) / RBig::from(n)))?;
    let weights = ExactWeights::new(&WORLD, Count::Number, centre(scheme, n), Rc::new(Cell::new(0)));
    let mut refinement: Refinement<PerFrequency<Value>> = Refinement::weighed(scheme, weights);
    let rows = match Rows::of(&refinement, patch, &analysis.orbits) {
        Err(Obstacle::Inexact(_)) => {
            refinement = Refinement::weighed(scheme, EnclosedWeights);
            Rows::of(&refinement, patch, &analysis.orbits)?
        }
        rows => rows?,
    };
    let block = Block::of(&rows, Some(1), Wave::Cosine(c.clone()))?;
    let all: Vec<usize> = (0..block.unknowns.len()).collect();
    let vector = null_vector(&shifted(&part(&block.matrix, &all), &lambda)?)?;
    let values = placed(&block.unknowns, &vector, &rows, &c)?;
    let row = move |(i, j): (i32, i32)| {
        let row = refinement.row(&patch, Label { sector: 0, i, j })?;
        Ok(row.into_iter().map(|(old, weight)| (old, weight.value(Some(1)).clone())).collect())
    };
    Ok(Some(EnclosedNet { patch, c, lambda, values, row: Box::new(row) }))
}

/// The least radius of a ring at valence n whose patches are refined by regular rules alone.
pub fn radius_at(analyzer: &Analyzer, scheme: &Scheme, pieces: Pieces, patch: Patch) -> Option<i32> {
    let n = patch.valence as usize;
    let world = AtValence::new(n as u64);
    let refinement: Option<Refinement<PerFrequency<Cosine>>> = world.as_ref().map(|world| {
        let weights = ExactWeights::new(world, Count::Number, centre(scheme, n), Rc::new(Cell::new(0)));
        Refinement::weighed(scheme, weights)
    });
    let row = |label: Label| {
        let row = refinement.as_ref()?.row(&patch, label).ok()?;
        Some(row.into_iter().map(|(old, weight)| (old, weight.value(Some(1)).clone())).collect())
    };
    least_radius(pieces, patch, analyzer.clear_of_centre(), &row)
}
