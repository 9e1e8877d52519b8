//! What is the net of the characteristic map at one valence, enclosed?
//!
//! The eigenvalue is enclosed by the exact analysis, which also tells that it is simple in the block of frequency 1; the
//! vector is the one that the block less the eigenvalue sends to zero ([`super::kernel`]). Any weight that can be enclosed
//! will do.

use super::enclosed_net::EnclosedNet;
use super::kernel::null_vector;
use super::net::placed;
use crate::analysis::exact::block::{Block, Wave};
use crate::analysis::exact::rows::Rows;
use crate::analysis::exact::{BITS, ExactAnalysis, Value};
use crate::analysis::neighbourhood::Orbit;
use crate::analysis::regular::mask::Point;
use crate::mesh::{Label, Lattice, Patch};
use crate::numbers::linear::{part, shifted};
use crate::numbers::{Angle, EnclosedWorld, Field, PerFrequency, World};
use crate::refine::{Count, EnclosedWeights, ExactWeights, Obstacle, Refinement};
use crate::scheme::Scheme;
use dashu_ratio::RBig;
use std::cell::Cell;
use std::cmp::Ordering;
use std::rc::Rc;

static WORLD: EnclosedWorld<BITS> = EnclosedWorld::<BITS>;

/// The count that tells the centre from other places; at the regular valence all are alike.
pub fn centre(scheme: &Scheme, n: usize) -> usize {
    if n == scheme.regular_valence() { usize::MAX } else { n }
}

/// The rows of points far from the centre: those of the regular mask.
pub struct Far {
    /// The mask, enclosed.
    pub mask: Vec<(Point, Value)>,
    /// The sum of a label's coordinates from which on.
    pub clear: i32,
    /// How many times the new lattice is as fine as the old one.
    pub dilation: i32,
}

impl Far {
    /// The row of a point in sector 0, where it is far.
    fn row(&self, patch: Patch, (i, j): Orbit) -> Option<Vec<(Label, Value)>> {
        let old = |(alpha, weight): &(Point, Value)| {
            let [x, y] = source([i, j], *alpha, self.dilation)?;
            Some((patch.point(0, x, y), weight.clone()))
        };
        (i + j >= self.clear).then(|| self.mask.iter().filter_map(old).collect())
    }
}

/// The old point beta with place = alpha + d beta, if there is one.
pub fn source([x, y]: Point, [a, b]: Point, d: i32) -> Option<Point> {
    let (x, y) = (x - a, y - b);
    (x % d == 0 && y % d == 0).then_some([x / d, y / d])
}

/// The net at valence n of a scheme whose parameters have values, for the subdominant eigenvalue of its exact analysis
/// there; else why there is none. Rows of far points are taken from `far`, if that is given.
///
/// # Errors
/// When weights can't be enclosed, or enclosures are too wide.
pub fn net_at<'s>(
    scheme: &'s Scheme,
    lattice: Lattice,
    n: usize,
    analysis: &ExactAnalysis,
    far: Option<&'s Far>,
) -> Result<Result<EnclosedNet<'s, Value>, String>, Obstacle> {
    let Some(index) = analysis.lambda else {
        return Ok(Err(format!("n = {n}: no simple, real and positive subdominant eigenvalue of frequency 1")));
    };
    let lambda = analysis.eigenvalues[index].re.clone();
    let below_one = Value::whole(1).minus(&lambda)?;
    if [&lambda, &below_one].iter().any(|own| own.sign() != Some(Ordering::Greater)) {
        return Ok(Err(format!("n = {n}: the subdominant eigenvalue is not seen to be between 0 and 1")));
    }
    let patch = Patch::new(lattice, n);
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
    let row = move |(i, j): Orbit| {
        if let Some(row) = far.and_then(|far| far.row(patch, (i, j))) {
            return Ok(row);
        }
        let row = refinement.row(&patch, Label { sector: 0, i, j })?;
        Ok(row.into_iter().map(|(old, weight)| (old, weight.value(Some(1)).clone())).collect())
    };
    Ok(Ok(EnclosedNet::new(patch, c, lambda, values, Box::new(row))?))
}
