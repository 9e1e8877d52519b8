//! From which ring on are cells refined by the regular rules alone?
//!
//! Rows are looked at one by one, exactly, as far out as a rule may still see the centre: up to the distance that
//! stencils keep clear of it from.

use super::cells::{Cell, Local};
use crate::analysis::exact::formulas::GENERIC;
use crate::analysis::regular::mask::{Point, Sequence};
use crate::mesh::{Label, Lattice, Patch};
use crate::numbers::{Free, FreeWorld, N, PerFrequency};
use crate::proof::valence::source;
use crate::refine::{Count, ExactWeights, Obstacle, Refinement};
use crate::scheme::Scheme;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// The rows around a centre, with rational numbers for weights.
pub struct Rows<'a> {
    refinement: Refinement<'a, PerFrequency<Free>>,
    patch: Patch,
}

static WORLD: FreeWorld = FreeWorld { parameters: Vec::new() };

/// The rings that are tried, as their inner radius.
const SCALES: [i32; 3] = [4, 8, 16];

impl<'a> Rows<'a> {
    /// The rows at one valence, or (`None`) those that all valences share that forms are made for.
    pub fn of(scheme: &'a Scheme, lattice: Lattice, n: Option<usize>) -> Rows<'a> {
        let valence = n.unwrap_or(GENERIC);
        let count = match n {
            Some(_) => Count::Number,
            None => Count::Free { n: Free::variable(N), like: GENERIC },
        };
        // at the regular valence every place looks like the centre
        let centre = if valence == scheme.regular_valence() { usize::MAX } else { valence };
        let weights = ExactWeights::new(&WORLD, count, centre, Rc::default());
        Rows { refinement: Refinement::weighed(scheme, weights), patch: Patch::new(lattice, valence) }
    }

    /// Whether the row of the new point at (i, j) in the coordinates of sector 0 is the mask's. A weight that is no
    /// rational number isn't.
    ///
    /// # Errors
    /// When a rule has no value.
    pub fn is_regular(&self, [i, j]: Point, mask: &Sequence, dilation: i32) -> Result<bool, Obstacle> {
        let row = match self.refinement.row(&self.patch, self.patch.point(0, i, j)) {
            Err(Obstacle::Inexact(_) | Obstacle::Trouble(_)) => return Ok(false),
            row => row?,
        };
        let mut regular: BTreeMap<Label, &Free> = BTreeMap::new();
        for (alpha, weight) in mask {
            if let Some([x, y]) = source([i, j], *alpha, dilation) {
                regular.insert(self.patch.point(0, x, y), weight);
            }
        }
        let same = |(label, weight): &(Label, PerFrequency<Free>)| regular.get(label) == Some(&weight.value(Some(1)));
        Ok(row.len() == regular.len() && row.iter().all(same))
    }

    /// The inner radius of a ring from which on every point of every cell's parts, at all levels, has the mask's row.
    ///
    /// # Errors
    /// As [`Rows::is_regular`].
    pub fn scale(&self, local: &Local, mask: &Sequence, clear: i32) -> Result<Option<i32>, Obstacle> {
        let mut known: BTreeMap<Point, bool> = BTreeMap::new();
        // points of a cell reach into the sectors beside sector 0, and no further
        'scales: for scale in SCALES.into_iter().filter(|scale| local.extent() < *scale) {
            let tiling = local.tiling;
            let mut finer = tiling.dilation * scale;
            // points of cells from ring s on are on rings from s - extent on
            while finer - local.extent() < clear {
                let near = |[i, j]: &Point| {
                    let Label { i, j, .. } = self.patch.point(0, *i, *j);
                    i + j < clear
                };
                for point in points(&tiling.ring(finer), local).into_iter().filter(near) {
                    let regular = match known.get(&point) {
                        Some(own) => *own,
                        None => self.is_regular(point, mask, tiling.dilation)?,
                    };
                    known.insert(point, regular);
                    if !regular {
                        continue 'scales;
                    }
                }
                finer *= tiling.dilation;
            }
            return Ok(Some(scale));
        }
        Ok(None)
    }
}

/// The points of cells, each once.
pub fn points(cells: &[Cell], local: &Local) -> BTreeSet<Point> {
    cells.iter().flat_map(|cell| local.points.iter().map(|q| cell.point(*q))).collect()
}
