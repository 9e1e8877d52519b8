//! sqrt2: a new point in each face; each edge inside the mesh becomes a quad of its ends and the new points beside it, and old edges
//! vanish. Two steps bisect every edge. The quad of the edge with first corner h, from a to b, with the new points f to its left and
//! g to its right, is
//!
//! > (a, g, b, f), and (a, b, f) on the boundary, whose edges stay.
//!
//! In every second step an edge a b of the boundary is halved by a point p: its triangle with the apex f has no new point, p stands for it, and the
//! edge makes no face.

use super::cut::Stands;
use super::{Numbering, room};
use crate::mesh::{Connectivity, Faces, HalfEdgeMesh, NONE};

pub(super) fn faces(mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let stands = Stands::in_every_face(mesh);
    let mut sizes = Vec::new();
    let mut new = room(buffer, 0);
    new.clear();
    for h in numbering.first_corners() {
        let [a, b] = [mesh.origin(*h), mesh.target(*h)];
        match mesh.twins()[*h as usize] {
            NONE => new.extend([a, b, stands.at(*h)]),
            twin => new.extend([a, stands.at(twin), b, stands.at(*h)]),
        }
        sizes.push(if mesh.twins()[*h as usize] == NONE { 3 } else { 4 });
    }
    if mesh.is_closed() { Faces::same(4, new) } else { Faces::mixed(&sizes, new) }
}

pub(super) fn faces_with_halves(mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let stands = Stands::cut(mesh, numbering, 1);
    let mut new = room(buffer, 0);
    new.clear();
    for h in numbering.first_corners() {
        let twin = mesh.twins()[*h as usize];
        if twin != NONE {
            new.extend([mesh.origin(*h), stands.at(twin), mesh.target(*h), stands.at(*h)]);
        }
    }
    Faces::same(4, new)
}
