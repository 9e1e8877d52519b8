//! How do the points around a vertex on a crease map to those of the next level?
//!
//! The local matrix over the full neighbourhood of a fan. There is no rotation: every point has a row of its own.

use crate::mesh::{Fan, Label};
use crate::numbers::Field;
use crate::refine::{Obstacle, Row};
use nalgebra::DMatrix;
use std::collections::BTreeMap;

/// How far the weights of rows that are mirror images may differ.
const TOLERANCE: f64 = 1e-12;

/// The local matrix of a fan.
#[derive(Clone, Debug)]
pub struct FanMatrix<F = f64> {
    /// The fan that its points lie on.
    pub fan: Fan,
    /// The point of each row and column.
    pub labels: Vec<Label>,
    /// Each row as (column, weight), in order of the columns.
    pub rows: Vec<Vec<(usize, F)>>,
    /// The row of each point's mirror image.
    pub mirror: Vec<usize>,
}

impl<F: Field> FanMatrix<F> {
    /// The matrix on these points.
    ///
    /// # Errors
    /// When a row can't be made, or leaves the points.
    pub fn of(
        fan: Fan,
        labels: Vec<Label>,
        row: impl Fn(Label) -> Result<Row<Label, F>, Obstacle>,
    ) -> Result<FanMatrix<F>, Obstacle> {
        let columns: BTreeMap<Label, usize> = labels.iter().enumerate().map(|(index, label)| (*label, index)).collect();
        let column = |label: &Label| columns.get(label).copied().ok_or_else(outside);
        let entries = |label: &Label| {
            let mut entries: Vec<(usize, F)> = Vec::new();
            for (old, weight) in row(*label)? {
                entries.push((column(&old)?, weight));
            }
            entries.sort_by_key(|(column, _)| *column);
            Ok(entries)
        };
        let rows = labels.iter().map(entries).collect::<Result<_, Obstacle>>()?;
        let mirror = labels.iter().map(|label| column(&fan.mirrored(*label))).collect::<Result<_, _>>()?;
        Ok(FanMatrix { fan, labels, rows, mirror })
    }

    /// The number of points.
    pub fn size(&self) -> usize {
        self.labels.len()
    }

    /// The row of a point.
    pub fn index(&self, label: Label) -> Option<usize> {
        self.labels.iter().position(|own| *own == label)
    }
}

impl FanMatrix<f64> {
    /// The whole matrix.
    pub fn dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.size(), self.size());
        for (row, entries) in self.rows.iter().enumerate() {
            entries.iter().for_each(|(column, weight)| dense[(row, *column)] = *weight);
        }
        dense
    }

    /// Checks that the matrix looks the same in the mirror.
    ///
    /// # Errors
    /// The first point whose row does not.
    pub fn check_mirror(&self) -> Result<(), Obstacle> {
        let weight = |row: usize, column: usize| {
            let own = self.rows[row].binary_search_by_key(&column, |(column, _)| *column);
            own.map_or(0.0, |at| self.rows[row][at].1)
        };
        for (row, entries) in self.rows.iter().enumerate() {
            let image = self.mirror[row];
            let differs = |(column, own): &(usize, f64)| (weight(image, self.mirror[*column]) - own).abs() > TOLERANCE;
            if entries.iter().any(differs) {
                let Label { sector, i, j } = self.labels[row];
                return Err(Obstacle::Limit(format!(
                    "the boundary rules tell left from right: the new point ({i}, {j}) of sector {sector} is not the mirror image of \
                     the one across; at a {} of {} faces",
                    self.fan.kind().name(),
                    self.fan.sectors()
                )));
            }
        }
        Ok(())
    }
}

fn outside() -> Obstacle {
    Obstacle::Limit("a point is made of points outside of the neighbourhood".to_string())
}
