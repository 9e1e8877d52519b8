//! sqrt3: a new point in each triangle; each edge inside the mesh, between the points a and b with the new points f to the left and
//! g to the right of a b, gives way to f g (Kobbelt 2000). Half-edge h, from a to b, becomes the triangle
//!
//! > (a, g, f), and (a, b, f) on the boundary,
//!
//! which is the face h of the new mesh. In every second step an edge a b of the boundary is cut into three, by the points p near a and q near b: its
//! triangle with the apex f has no new point, and becomes (p, q, f) in the middle; for its two other edges p stands for the new point at a, and q at b.

use super::cut::Stands;
use super::{Numbering, room};
use crate::mesh::{Connectivity, Faces, HalfEdgeMesh, NONE};
use rayon::prelude::*;

pub(super) fn faces(mesh: &HalfEdgeMesh, buffer: Vec<u32>) -> Faces {
    let stands = Stands::in_every_face(mesh);
    triangles(mesh, buffer, |h, twin| match twin {
        NONE => [mesh.origin(h), mesh.target(h), stands.at(h)],
        _ => [mesh.origin(h), stands.at(twin), stands.at(h)],
    })
}

pub(super) fn faces_with_thirds(mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let stands = Stands::cut(mesh, numbering, 2);
    triangles(mesh, buffer, |h, twin| match twin {
        NONE => [stands.at(h), stands.at(h) + 1, mesh.origin(mesh.faces().prev(h))],
        _ => [mesh.origin(h), stands.at(twin), stands.at(h)],
    })
}

/// A triangle for each half-edge, from it and its twin.
fn triangles(mesh: &HalfEdgeMesh, buffer: Vec<u32>, of: impl Fn(u32, u32) -> [u32; 3] + Sync) -> Faces {
    let twins = mesh.twins();
    let mut new = room(buffer, 3 * twins.len());
    let each = new.as_chunks_mut::<3>().0.par_iter_mut().enumerate();
    each.for_each(|(h, new)| *new = of(h as u32, twins[h]));
    Faces::same(3, new)
}
