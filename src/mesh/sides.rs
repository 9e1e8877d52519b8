//! Which fans meet at a vertex of a mesh?
//!
//! Creases and the boundary cut the faces around a vertex into sides; each is a fan of its own. Inside the mesh, away from creases,
//! there is none, nor at a corner that fewer than two creases lead to.

use super::{Connectivity, FanKind, Tagged};

/// The fans at the vertex that a half-edge leaves: their kinds, and the half-edges that leave the vertex, counter-clockwise.
pub fn sides(tagged: &Tagged, start: u32) -> Vec<(FanKind, Vec<u32>)> {
    let sharp = tagged.sharp_spokes(start);
    let corner = tagged.is_corner(start) || sharp.len() > 2;
    let Some(first) = sharp.first() else { return vec![] };
    let spokes = tagged.around_vertex(*first);
    if sharp.len() == 1 {
        let faces = spokes.len();
        return if corner { vec![] } else { vec![(FanKind::Dart { faces }, spokes)] };
    }
    let mut sides = Vec::new();
    let mut from = 0;
    for to in (1..=spokes.len()).filter(|at| *at == spokes.len() || tagged.is_sharp(spokes[*at])) {
        let faces = to - from;
        let side: Vec<u32> = (from..=to).map(|at| spokes[at % spokes.len()]).collect();
        if tagged.has_face(side[0]) {
            let kind = if corner { FanKind::Corner { faces } } else { FanKind::Crease { faces } };
            sides.push((kind, side));
        }
        from = to;
    }
    sides
}
