//! Which ring around the centre is refined by regular rules alone?
//!
//! The ring of radius r has the patches between the distances r and 2r from the centre. On it Bezier points of the net
//! are those of the limit function where the controls of all patches that it is made of, at every finer level, have
//! rows of a regular mesh. Rows far from the centre have; the others are looked at, and the least r is taken that keeps
//! clear of those that are not regular. A patch is four smaller ones of the next level, whose net is the same net twice
//! as far out.

use crate::mesh::{Label, Patch};
use crate::proof::jacobian::{PatchAt, Pieces};
use std::collections::{BTreeMap, BTreeSet};

/// The row of a new point, in any form whose equality is exact; `None` where there is no such form.
pub type ExactRow<'r, W> = dyn Fn(Label) -> Option<Vec<(Label, W)>> + 'r;

/// So far from the centre that rows are regular.
const FAR: i32 = 64;

/// Rings of larger radius than this are not tried.
const MOST_RADIUS: i32 = 8;

/// The patches of half a sector of the ring of a radius.
pub fn half_sector(pieces: Pieces, radius: i32) -> Vec<PatchAt> {
    let places = (0..=2 * radius).flat_map(|y| (y..=2 * radius).map(move |x| (x, y)));
    let mut patches = Vec::new();
    for (x, y) in places {
        match pieces {
            Pieces::Tensor(_) if (radius..2 * radius).contains(&x) => patches.push(((x, y), 1)),
            Pieces::Quartic => {
                if (radius..2 * radius).contains(&(x + y)) {
                    patches.push(((x, y), 1));
                }
                if y > 0 && (radius..2 * radius).contains(&(x + y - 1)) {
                    patches.push(((x, y), -1));
                }
            }
            Pieces::Tensor(_) => {}
        }
    }
    patches
}

/// The least radius whose ring keeps clear of all rows that are not regular; `None` where it would be too large. Rows
/// from the distance `clear` on are regular.
pub fn least_radius<W: PartialEq>(pieces: Pieces, patch: Patch, clear: i32, row: &ExactRow<W>) -> Option<i32> {
    let mut known = BTreeMap::new();
    (1..=MOST_RADIUS).find(|radius| {
        let mut levels = (1..).map(|level| radius << level).take_while(|inner| *inner < clear + 2 * FURTHEST);
        levels.all(|inner| {
            let near = |patch: &PatchAt| patch.0.0 + patch.0.1 < 2 * (clear + FURTHEST);
            let patches = half_sector(pieces, inner).into_iter().filter(near);
            let controls: BTreeSet<(i32, i32)> = patches.flat_map(|at| pieces.stencil(at)).collect();
            controls
                .into_iter()
                .all(|(i, j)| *known.entry((i, j)).or_insert_with(|| is_regular(pieces, patch, clear, (i, j), row)))
        })
    })
}

/// Controls of a patch are at most so far from it.
const FURTHEST: i32 = 16;

/// Whether the row of the new point at (i, j) in the coordinates of sector 0 is that of a regular mesh in them. It is
/// looked at where rules may see the centre, and where old points may lie in both sectors beside sector 0, which have the
/// centre between them.
fn is_regular<W: PartialEq>(pieces: Pieces, patch: Patch, clear: i32, (i, j): (i32, i32), row: &ExactRow<W>) -> bool {
    let label = patch.point(0, i, j);
    if label.i + label.j >= clear && i.max(j) > pieces.reach() {
        return true;
    }
    let far = Label { sector: 0, i: i + 2 * FAR, j: j + 2 * FAR };
    let (Some(mut own), Some(mut regular)) = (row(label), row(far)) else { return false };
    for (label, _) in &mut regular {
        *label = patch.point(0, label.i - FAR, label.j - FAR);
    }
    own.sort_by_key(|(label, _)| *label);
    regular.sort_by_key(|(label, _)| *label);
    own == regular
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The area of the ring of a sector is 3 r^2, of each patch 1 (on triangles 1/2, of a sector that is half as
    /// large).
    #[test]
    fn half_a_sector_and_its_mirror_image_make_a_sector() {
        for radius in 1..5 {
            for pieces in [Pieces::Tensor(3), Pieces::Quartic] {
                let half = half_sector(pieces, radius);
                let image = |((x, y), sign): &PatchAt| ((*y, *x), *sign);
                let mut all: BTreeSet<PatchAt> = half.iter().map(image).collect();
                all.extend(&half);
                assert_eq!(all.len() as i32, 3 * radius * radius, "{pieces:?} {radius}");
            }
        }
    }
}
