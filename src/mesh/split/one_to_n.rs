//! 1-to-n: the corner h of a polygon, at the vertex v with the points e and e' on the edges after and before it and the
//! point f in the face, becomes the quad (v, e, f, e'). It is the face h of the new mesh.

use super::{Numbering, RUN, room, some};
use crate::mesh::{Faces, HalfEdgeMesh};
use rayon::prelude::*;

/// The new faces, from the old ones, their twins, and the number of old vertices.
pub(super) fn faces(old: &Faces, twins: &[u32], vertices: usize, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let mut new = room(buffer, 4 * twins.len());
    let on_edges = vertices as u32;
    let in_faces = on_edges + numbering.edges() as u32;
    let edge = |h: u32| on_edges + numbering.of_corner(h, twins[h as usize]);
    let run = |(index, new): (usize, &mut [u32])| {
        let first = (RUN * index) as u32;
        let (mut face, mut before) = (old.face_of(first), edge(old.prev(first)));
        for (h, new) in (first..).zip(new.as_chunks_mut::<4>().0) {
            if old.face_of(h) != face {
                (face, before) = (old.face_of(h), edge(old.prev(h)));
            }
            let after = edge(h);
            *new = [old.corners()[h as usize], after, in_faces + face, before];
            before = after;
        }
    };
    new.par_chunks_mut(4 * RUN).enumerate().for_each(run);
    Faces::same(4, new)
}

pub(super) fn twins(mesh: &HalfEdgeMesh) -> Vec<u32> {
    let (old, twins) = (mesh.faces(), mesh.twins());
    let mut new = room(Vec::new(), 4 * twins.len());
    let run = |(index, new): (usize, &mut [u32])| {
        for (at, new) in new.as_chunks_mut::<4>().0.iter_mut().enumerate() {
            let h = (RUN * index + at) as u32;
            let (next, prev) = (old.next(h), old.prev(h));
            *new = [
                some(twins[h as usize], |twin| 4 * old.next(twin) + 3),
                4 * next + 2,
                4 * prev + 1,
                some(twins[prev as usize], |twin| 4 * twin),
            ];
        }
    };
    new.par_chunks_mut(4 * RUN).enumerate().for_each(run);
    new
}

pub(super) fn leaving(mesh: &HalfEdgeMesh, numbering: &Numbering) -> Vec<u32> {
    let old = mesh.faces();
    let mut leaving = room(Vec::new(), mesh.vertices() + numbering.edges() + old.len());
    let (at_vertices, rest) = leaving.split_at_mut(mesh.vertices());
    let (at_edges, in_faces) = rest.split_at_mut(numbering.edges());
    at_vertices.par_iter_mut().zip(mesh.vertex_edges()).for_each(|(new, h)| *new = 4 * h);
    // from the point on an edge to the old vertex: the last half-edge of the next corner's quad
    at_edges.par_iter_mut().zip(numbering.first_corners()).for_each(|(new, h)| *new = 4 * old.next(*h) + 3);
    in_faces.par_iter_mut().enumerate().for_each(|(face, new)| *new = 4 * old.range(face).start as u32 + 2);
    leaving
}

pub(super) fn edge_children(mesh: &HalfEdgeMesh, h: u32) -> [u32; 2] {
    [4 * h, 4 * mesh.faces().next(h) + 3]
}
