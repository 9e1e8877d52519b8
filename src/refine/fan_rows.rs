//! How are points made on the canonical fan?
//!
//! By walking the rules near the centre and near the crease, and by the regular stencils elsewhere.

use super::{Obstacle, Refinement, RegularStencils, Row};
use crate::mesh::{Fan, Label};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// The rows of one fan.
pub struct FanRows<'r, 's> {
    /// The fan that the rows are on.
    pub fan: Fan,
    refinement: &'r Refinement<'s, f64>,
    stencils: &'r RegularStencils,
    walked: RefCell<HashMap<Label, Rc<Row<Label, f64>>>>,
}

impl<'r, 's> FanRows<'r, 's> {
    /// The rows on a fan.
    pub fn new(refinement: &'r Refinement<'s, f64>, stencils: &'r RegularStencils, fan: Fan) -> Self {
        FanRows { fan, refinement, stencils, walked: RefCell::new(HashMap::new()) }
    }

    /// Whether a new point's row is regular: it keeps clear of the centre and of the crease.
    fn is_regular(&self, Label { sector, i, j }: Label) -> bool {
        let clear = self.stencils.clear_of_crease();
        let along_first = sector == 0 && j < clear;
        let along_last = sector + 1 >= self.fan.sectors() && i < clear || sector >= self.fan.sectors();
        i + j >= self.stencils.clear_of_centre() && !along_first && !along_last
    }

    /// Calls `visit` with each old point that the new point `label` is made of, and its weight.
    ///
    /// # Errors
    /// When a weight has no value, or a rule reaches over the boundary.
    pub fn visit(&self, label: Label, mut visit: impl FnMut(Label, f64)) -> Result<(), Obstacle> {
        if self.is_regular(label) {
            let (i, j) = (label.i.div_euclid(2), label.j.div_euclid(2));
            for ((di, dj), weight) in self.stencils.at(label.i, label.j) {
                visit(self.fan.point(label.sector, i + di, j + dj), *weight);
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
    /// As [`FanRows::visit`].
    pub fn walked_row(&self, label: Label) -> Result<Rc<Row<Label, f64>>, Obstacle> {
        if let Some(row) = self.walked.borrow().get(&label) {
            return Ok(Rc::clone(row));
        }
        let row = Rc::new(self.refinement.row_at(&self.fan, self.fan.birth(label))?);
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
    fn regular_rows_are_those_that_walking_gives() {
        for id in ["loop", "loop-warren", "catmull-clark"] {
            let scheme = catalogue::open(id).unwrap().unwrap();
            let book = catalogue::boundary("cubic", &scheme.mesh).unwrap().unwrap();
            let (refinement, lattice) = (Refinement::new(&scheme, Some(&book)), lattice_of(&scheme));
            let stencils = RegularStencils::of(&refinement, lattice).unwrap();
            for kind in [FanKind::Crease { faces: 1 }, FanKind::Corner { faces: 2 }, FanKind::Dart { faces: 5 }] {
                let rows = FanRows::new(&refinement, &stencils, Fan::new(lattice, kind));
                let mut compared = 0;
                let labels = (0..rows.fan.sectors())
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
