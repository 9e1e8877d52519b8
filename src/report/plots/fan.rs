//! Where is a point of the patch drawn?
//!
//! The fan: spokes of length 1 at equal angles, spoke 0 to the right, each sector a linear image of the lattice between its
//! two spokes.

use crate::mesh::{Connectivity, Label, Lattice, Patch, PatchEdge};
use crate::numbers::RootsOfUnity;
use num_complex::Complex64;
use std::collections::BTreeSet;

/// A patch laid out in the plane.
pub(super) struct Fan {
    pub(super) patch: Patch,
    roots: RootsOfUnity,
}

impl Fan {
    pub(super) fn new(lattice: Lattice, valence: usize) -> Fan {
        let patch = Patch::new(lattice, valence);
        Fan { patch, roots: RootsOfUnity::new(patch.valence as usize) }
    }

    /// Where a point lies.
    pub(super) fn at(&self, label: Label) -> Complex64 {
        let beyond = if self.patch.lattice.has_centre() { 0.0 } else { 0.5 };
        let sector = i64::from(label.sector);
        let (along, over) = (self.roots.get(sector), self.roots.get(sector + 1));
        along * (f64::from(label.i) + beyond) + over * (f64::from(label.j) + beyond)
    }

    /// The mean of points.
    pub(super) fn mean(&self, labels: &[Label]) -> Complex64 {
        labels.iter().map(|label| self.at(*label)).sum::<Complex64>() / labels.len() as f64
    }
}

/// The half-edges that leave a point.
pub(super) fn leaving(patch: &Patch, label: Label) -> impl Iterator<Item = PatchEdge> + use<> {
    let centre = patch.centre() == Some(label);
    let directions = if centre { patch.valence } else { patch.lattice.steps().len() as u32 };
    let patch = *patch;
    (0..directions).map(move |direction| patch.edge(label, direction))
}

/// The edges of the lattice that join two of the points, each once.
pub(super) fn edges_among(patch: &Patch, points: &BTreeSet<Label>) -> Vec<(Label, Label)> {
    let from = |label: &Label| leaving(patch, *label).map(|edge| (patch.origin(edge), patch.target(edge)));
    points.iter().flat_map(from).filter(|(a, b)| a < b && points.contains(b)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_the_regular_valence_every_edge_of_the_fan_has_length_one() {
        for lattice in [Lattice::Triangles, Lattice::Quads, Lattice::Dual] {
            let fan = Fan::new(lattice, lattice.regular_valence());
            let first = i32::from(lattice.has_centre());
            let orbits = (first..3).flat_map(|i| (0..3).map(move |j| (i, j)));
            let labels = orbits.flat_map(|(i, j)| (0..fan.patch.valence).map(move |sector| Label { sector, i, j }));
            let points: BTreeSet<Label> = labels.chain(fan.patch.centre()).collect();
            let edges = edges_among(&fan.patch, &points);
            assert!(edges.len() > points.len());
            for (a, b) in edges {
                assert!(((fan.at(a) - fan.at(b)).norm_sqr() - 1.0).abs() < 1e-12, "{lattice:?} {a:?} {b:?}");
            }
        }
    }
}
