//! How do the points around an extraordinary point map to those of the next level?
//!
//! The local subdivision matrix S_n over the full neighbourhood. By rotation it is told by the row of the centre (where
//! that is a point) and one row for each orbit, in sector 0: memory and work grow linearly with the valence.

use super::neighbourhood::{Influence, Orbit};
use crate::mesh::{Label, Patch};
use crate::refine::{Obstacle, PatchRows};
use nalgebra::DMatrix;

/// The largest valence that is analysed.
pub const MAX_VALENCE: usize = 100_000;

/// The largest local matrix that is written out densely.
pub const MAX_DENSE: usize = 2_000;

/// A weight of a row of the local matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The old point's orbit, an index into [`LocalMatrix::orbits`]; `None` for the centre.
    pub orbit: Option<usize>,
    /// The old point's sector.
    pub sector: u32,
    /// The weight.
    pub weight: f64,
}

/// The local subdivision matrix of a valence, up to rotation. Its size is `centre + n * orbits`; rows and columns are in the
/// order: the centre, then sector by sector, and in each sector orbit by orbit.
#[derive(Clone, Debug)]
pub struct LocalMatrix {
    /// The canonical patch that its points lie on.
    pub patch: Patch,
    /// The orbits of its points, without the centre.
    pub orbits: Vec<Orbit>,
    /// The row of the centre, where that is a point.
    pub centre: Option<Vec<Entry>>,
    /// The row of each orbit's point in sector 0.
    pub rows: Vec<Vec<Entry>>,
}

impl LocalMatrix {
    /// The local matrix over the full neighbourhood.
    ///
    /// # Errors
    /// When a weight has no value at this valence.
    pub fn build(rows: &PatchRows, influence: &Influence) -> Result<LocalMatrix, Obstacle> {
        let patch = rows.patch;
        let orbits = influence.orbits(rows)?;
        let index = |orbit: Orbit| orbits.iter().position(|own| *own == orbit);
        let entries = |label: Label| -> Result<Vec<Entry>, Obstacle> {
            let mut entries = Vec::new();
            rows.visit(label, |old, weight| {
                let orbit = if patch.centre() == Some(old) { None } else { index(old.orbit()) };
                entries.push(Entry { orbit, sector: old.sector, weight });
            })?;
            Ok(entries)
        };
        let centre = patch.centre().map(&entries).transpose()?;
        let rows = orbits.iter().map(|(i, j)| entries(Label { sector: 0, i: *i, j: *j })).collect::<Result<_, _>>()?;
        Ok(LocalMatrix { patch, orbits, centre, rows })
    }

    /// The valence n.
    pub fn valence(&self) -> usize {
        self.patch.valence as usize
    }

    /// The number of points, which is the number of rows and of columns.
    pub fn size(&self) -> usize {
        usize::from(self.centre.is_some()) + self.valence() * self.orbits.len()
    }

    /// The number of weights, which is that of entries other than 0.
    pub fn weights(&self) -> usize {
        self.centre.as_ref().map_or(0, Vec::len) + self.valence() * self.rows.iter().map(Vec::len).sum::<usize>()
    }

    /// The point of a row.
    pub fn label(&self, row: usize) -> Label {
        let centre = usize::from(self.centre.is_some());
        if row < centre {
            return Label { sector: 0, i: 0, j: 0 };
        }
        let (sector, orbit) = ((row - centre) / self.orbits.len(), (row - centre) % self.orbits.len());
        let (i, j) = self.orbits[orbit];
        Label { sector: sector as u32, i, j }
    }

    /// The column of a point, given by its orbit and sector.
    pub fn column(&self, orbit: Option<usize>, sector: u32) -> usize {
        let centre = usize::from(self.centre.is_some());
        orbit.map_or(0, |orbit| centre + sector as usize * self.orbits.len() + orbit)
    }

    /// The weights of a row as (column, weight), in order of the columns.
    pub fn row(&self, row: usize) -> Vec<(usize, f64)> {
        let label = self.label(row);
        let entries = match (&self.centre, row) {
            (Some(centre), 0) => centre,
            _ => &self.rows[(row - usize::from(self.centre.is_some())) % self.orbits.len()],
        };
        let turned = |entry: &Entry| (entry.sector + label.sector) % self.patch.valence;
        let mut row: Vec<(usize, f64)> =
            entries.iter().map(|entry| (self.column(entry.orbit, turned(entry)), entry.weight)).collect();
        row.sort_by_key(|(column, _)| *column);
        row
    }

    /// The whole matrix, when its size is at most [`MAX_DENSE`].
    pub fn dense(&self) -> Option<DMatrix<f64>> {
        let size = self.size();
        if size > MAX_DENSE {
            return None;
        }
        let mut dense = DMatrix::zeros(size, size);
        for row in 0..size {
            for (column, weight) in self.row(row) {
                dense[(row, column)] += weight;
            }
        }
        Some(dense)
    }
}
