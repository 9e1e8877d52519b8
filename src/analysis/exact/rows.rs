//! What are the rows of the local matrix exactly, each ring as one point with a weight for each frequency?

use crate::analysis::neighbourhood::Orbit;
use crate::mesh::{Label, Patch};
use crate::numbers::{Field, PerFrequency};
use crate::refine::{Obstacle, Refinement};

/// A weight of a row.
#[derive(Clone, Debug)]
pub struct Entry<F> {
    /// The old point's orbit, an index into [`Rows::orbits`]; `None` for the centre.
    pub orbit: Option<usize>,
    /// The old point's sector, nearest to 0 of those that are the same.
    pub sector: i64,
    /// The weight.
    pub weight: PerFrequency<F>,
}

/// The rows of the local matrix in sector 0.
#[derive(Clone, Debug)]
pub struct Rows<F> {
    /// The orbits of its points, without the centre.
    pub orbits: Vec<Orbit>,
    /// For each orbit its mirror image and the mirror's shift in sectors.
    pub mirrors: Vec<(usize, i64)>,
    /// The row of the centre, where that is a point.
    pub centre: Option<Vec<Entry<F>>>,
    /// The row of each orbit's point in sector 0.
    pub rows: Vec<Vec<Entry<F>>>,
}

impl<F: Field> Rows<F> {
    /// The rows of these orbits on a patch.
    ///
    /// # Errors
    /// When a weight has no value in this world, or a row leaves the orbits.
    pub fn of(refinement: &Refinement<PerFrequency<F>>, patch: Patch, orbits: &[Orbit]) -> Result<Rows<F>, Obstacle> {
        let index = |orbit: Orbit| orbits.iter().position(|own| *own == orbit);
        let row = |label: Label| -> Result<Vec<Entry<F>>, Obstacle> {
            let old = refinement.row(&patch, label)?;
            let entry = |(point, weight): (Label, PerFrequency<F>)| {
                let centre = patch.centre() == Some(point);
                let orbit = if centre { None } else { Some(index(point.orbit()).ok_or_else(outside)?) };
                Ok(Entry { orbit, sector: nearest_to_zero(point.sector, patch.valence), weight })
            };
            old.into_iter().map(entry).collect()
        };
        let mirror = |orbit: &Orbit| {
            let (image, shift) = patch.lattice.mirror(*orbit);
            Ok((index(image).ok_or_else(outside)?, i64::from(shift)))
        };
        Ok(Rows {
            orbits: orbits.to_vec(),
            mirrors: orbits.iter().map(mirror).collect::<Result<_, Obstacle>>()?,
            centre: patch.centre().map(row).transpose()?,
            rows: orbits.iter().map(|(i, j)| row(Label { sector: 0, i: *i, j: *j })).collect::<Result<_, _>>()?,
        })
    }

    /// The frequencies p that weights tell from others, in order.
    pub fn frequencies(&self) -> Vec<usize> {
        let entries = self.rows.iter().chain(&self.centre).flatten();
        let mut keys: Vec<usize> = entries.flat_map(|entry| entry.weight.at.keys().copied()).collect();
        keys.sort_unstable();
        keys.dedup();
        keys
    }
}

fn outside() -> Obstacle {
    Obstacle::Limit("an exact weight is not zero where its approximate value is".to_string())
}

fn nearest_to_zero(sector: u32, valence: u32) -> i64 {
    let (sector, valence) = (i64::from(sector), i64::from(valence));
    if 2 * sector > valence { sector - valence } else { sector }
}
