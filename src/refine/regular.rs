//! How are points made far from the centre of the canonical patch?
//!
//! By the same few stencils everywhere, one for each remainder of the label. They are read off the rules once, at a place far
//! inside a sector, and applied by arithmetic; near the centre the rules themselves are walked.

use super::{Obstacle, Refinement, Row};
use crate::mesh::{Canonical, Fan, Label, Lattice, Patch};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// The place that the stencils are read off, far from every sector's edge; more than twice the longest walk of a rule.
const FAR: i32 = 64;

/// The regular stencils: for each remainder (i mod d, j mod d) of a new point's label, d being the dilation, the old points that it is made
/// of, as offsets from (i div d, j div d), with their weights.
#[derive(Clone, Debug)]
pub struct RegularStencils {
    by_remainder: Vec<Vec<((i32, i32), f64)>>,
    dilation: i32,
    reach: i32,
}

impl RegularStencils {
    /// The stencils of a scheme.
    ///
    /// # Errors
    /// When a weight has no value.
    pub fn of(refinement: &Refinement<f64>, lattice: Lattice) -> Result<Self, Obstacle> {
        let patch = Patch::new(lattice, lattice.regular_valence());
        let dilation = refinement.cycle()?.dilation;
        let mut reach = 0;
        let mut by_remainder = Vec::new();
        for (p, q) in (0..dilation).flat_map(|q| (0..dilation).map(move |p| (p, q))) {
            let label = Label { sector: 0, i: dilation * FAR + p, j: dilation * FAR + q };
            let row = refinement.row(&patch, label)?;
            let offset = |(old, weight): (Label, f64)| ((old.i - FAR, old.j - FAR), weight);
            let stencil: Vec<_> = row.into_iter().map(offset).collect();
            reach = stencil.iter().fold(reach, |reach, ((i, j), _)| reach.max(i.abs()).max(j.abs()));
            by_remainder.push(stencil);
        }
        Ok(RegularStencils { by_remainder, dilation, reach })
    }

    /// How many times the new lattice is as fine as the old one.
    pub fn dilation(&self) -> i32 {
        self.dilation
    }

    /// The stencil of a new point with this label.
    pub fn at(&self, i: i32, j: i32) -> &[((i32, i32), f64)] {
        &self.by_remainder[(i.rem_euclid(self.dilation) + self.dilation * j.rem_euclid(self.dilation)) as usize]
    }

    /// The largest offset of a stencil.
    pub fn reach(&self) -> i32 {
        self.reach
    }

    /// The distance i + j from which on a new point's stencil keeps clear of the centre.
    pub fn clear_of_centre(&self) -> i32 {
        2 * self.dilation * (self.reach + 1)
    }

    /// The distance from a crease from which on a new point's stencil has points on one side only.
    pub fn clear_of_crease(&self) -> i32 {
        self.dilation * (self.reach + 1)
    }

    /// The place of the coarse lattice that the stencil of a new point is told from.
    pub fn base(&self, i: i32, j: i32) -> (i32, i32) {
        (i.div_euclid(self.dilation), j.div_euclid(self.dilation))
    }
}

/// The rows of one canonical mesh, walked near the centre and near a crease, and by stencils elsewhere.
pub struct CanonicalRows<'r, 's, M> {
    /// The mesh that the rows are on.
    pub patch: M,
    refinement: &'r Refinement<'s, f64>,
    stencils: &'r RegularStencils,
    walked: RefCell<HashMap<Label, Rc<Row<Label, f64>>>>,
}

/// The rows of a patch.
pub type PatchRows<'r, 's> = CanonicalRows<'r, 's, Patch>;

/// The rows of a fan.
pub type FanRows<'r, 's> = CanonicalRows<'r, 's, Fan>;

impl<'r, 's, M: Canonical> CanonicalRows<'r, 's, M> {
    /// The rows on a patch or fan.
    pub fn new(refinement: &'r Refinement<'s, f64>, stencils: &'r RegularStencils, patch: M) -> Self {
        CanonicalRows { patch, refinement, stencils, walked: RefCell::new(HashMap::new()) }
    }

    /// How many times the new lattice is as fine as the old one.
    pub fn dilation(&self) -> i32 {
        self.stencils.dilation()
    }

    /// Whether a new point's row is regular: it keeps clear of the centre and of every crease.
    fn is_regular(&self, label: Label) -> bool {
        self.patch.is_clear(label, self.stencils.clear_of_centre(), self.stencils.clear_of_crease())
    }

    /// Calls `visit` with each old point that the new point `label` is made of, and its weight.
    ///
    /// # Errors
    /// When a weight has no value, or a rule reaches over the boundary.
    pub fn visit(&self, label: Label, mut visit: impl FnMut(Label, f64)) -> Result<(), Obstacle> {
        if self.is_regular(label) {
            let (i, j) = self.stencils.base(label.i, label.j);
            for ((di, dj), weight) in self.stencils.at(label.i, label.j) {
                visit(self.patch.point(label.sector, i + di, j + dj), *weight);
            }
            return Ok(());
        }
        for (old, weight) in self.walked_row(label)?.iter() {
            visit(*old, *weight);
        }
        Ok(())
    }

    /// The row of a new point, by walking the rules.
    ///
    /// # Errors
    /// As [`CanonicalRows::visit`].
    pub fn walked_row(&self, label: Label) -> Result<Rc<Row<Label, f64>>, Obstacle> {
        if let Some(row) = self.walked.borrow().get(&label) {
            return Ok(Rc::clone(row));
        }
        let row = Rc::new(self.refinement.row(&self.patch, label)?);
        self.walked.borrow_mut().insert(label, Rc::clone(&row));
        Ok(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::FanKind;
    use crate::refine::lattice_of;
    use crate::scheme::catalogue;

    #[test]
    fn far_rows_by_stencil_are_the_rows_that_walking_gives() {
        for listed in catalogue::SCHEMES {
            let scheme = catalogue::open(listed.id).unwrap().unwrap();
            let (refinement, lattice) = (Refinement::new(&scheme, None), lattice_of(&scheme));
            let stencils = RegularStencils::of(&refinement, lattice).unwrap();
            let rows = PatchRows::new(&refinement, &stencils, Patch::new(lattice, 7));
            let clear = stencils.clear_of_centre();
            for (i, j) in (0..2 * clear).flat_map(|i| (0..2 * clear).map(move |j| (i, j))) {
                if i + j < clear || (lattice.has_centre() && i == 0) {
                    continue;
                }
                let label = Label { sector: 2, i, j };
                let mut by_stencil = Vec::new();
                rows.visit(label, |old, weight| by_stencil.push((old, weight))).unwrap();
                by_stencil.sort_by_key(|(old, _)| *old);
                let walked = rows.walked_row(label).unwrap();
                assert_eq!(by_stencil.len(), walked.len(), "{} {label:?}", listed.id);
                for ((a, w), (b, v)) in by_stencil.iter().zip(walked.iter()) {
                    assert!(a == b && (w - v).abs() < 1e-15, "{} {label:?}", listed.id);
                }
            }
        }
    }

    #[test]
    fn regular_rows_are_those_that_walking_gives() {
        for id in ["loop", "loop-warren", "catmull-clark"] {
            let scheme = catalogue::open(id).unwrap().unwrap();
            let book = catalogue::boundary("cubic", &scheme.mesh).unwrap().unwrap();
            let (refinement, lattice) = (Refinement::new(&scheme, Some(&book)), lattice_of(&scheme));
            let stencils = RegularStencils::of(&refinement, lattice).unwrap();
            for kind in [FanKind::Crease { faces: 1 }, FanKind::Corner { faces: 2 }, FanKind::Dart { faces: 5 }] {
                let rows = FanRows::new(&refinement, &stencils, Fan::new(lattice, kind));
                let mut compared = 0;
                let labels = (0..rows.patch.sectors())
                    .flat_map(|sector| (1..14).flat_map(move |i| (0..14).map(move |j| Label { sector, i, j })));
                for label in labels.filter(|label| rows.is_regular(*label)) {
                    let mut by_stencil = Vec::new();
                    rows.visit(label, |old, weight| by_stencil.push((old, weight))).unwrap();
                    by_stencil.sort_by_key(|(old, _)| *old);
                    let walked = rows.walked_row(label).unwrap();
                    assert_eq!(by_stencil.len(), walked.len(), "{id} {kind:?} {label:?}");
                    for ((a, w), (b, v)) in by_stencil.iter().zip(walked.iter()) {
                        assert!(a == b && (w - v).abs() < 1e-15, "{id} {kind:?} {label:?}");
                    }
                    compared += 1;
                }
                assert!(compared > 50, "{id} {kind:?}: {compared}");
            }
        }
    }
}
