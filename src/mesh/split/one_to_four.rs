//! 1-to-4: each triangle (v0, v1, v2) with the points e0, e1, e2 on its edges v0 v1, v1 v2, v2 v0 becomes
//!
//! > (v0, e0, e2), (v1, e1, e0), (v2, e2, e1), (e0, e1, e2),
//!
//! so that the child at corner h = 3 f + c is the face 4 f + c, and its first half-edge leaves the old vertex.

use super::{Numbering, RUN, room, some};
use crate::mesh::{Faces, HalfEdgeMesh};
use rayon::prelude::*;

/// The half-edge that leaves the old vertex of corner h along the first half of its edge.
#[inline]
fn first_half(h: u32) -> u32 {
    let face = h / 3;
    12 * face + 3 * (h - 3 * face)
}

/// The half-edge that leads to the next old vertex along the second half of the edge of h.
#[inline]
fn second_half(h: u32) -> u32 {
    let face = h / 3;
    let corner = h - 3 * face;
    let next = if corner == 2 { 0 } else { corner + 1 };
    12 * face + 3 * next + 2
}

/// The new faces, from the old ones, their twins, and the number of old vertices.
pub(super) fn faces(old: &Faces, twins: &[u32], vertices: usize, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let corners = old.corners();
    let mut new = room(buffer, 4 * corners.len());
    let on_edges = vertices as u32;
    let run = |(index, new): (usize, &mut [u32])| {
        let old = 3 * RUN * index;
        let (corners, twins) = (&corners[old..old + new.len() / 4], &twins[old..old + new.len() / 4]);
        let faces = new.as_chunks_mut::<12>().0.iter_mut();
        let old_faces = corners.as_chunks::<3>().0.iter().zip(twins.as_chunks::<3>().0);
        for ((at, new), ([v0, v1, v2], [t0, t1, t2])) in faces.enumerate().zip(old_faces) {
            let h = (old + 3 * at) as u32;
            let e0 = on_edges + numbering.of_corner(h, *t0);
            let e1 = on_edges + numbering.of_corner(h + 1, *t1);
            let e2 = on_edges + numbering.of_corner(h + 2, *t2);
            *new = [*v0, e0, e2, *v1, e1, e0, *v2, e2, e1, e0, e1, e2];
        }
    };
    new.par_chunks_mut(12 * RUN).enumerate().for_each(run);
    Faces::same(3, new)
}

pub(super) fn twins(mesh: &HalfEdgeMesh) -> Vec<u32> {
    let twins = mesh.twins();
    let mut new = room(Vec::new(), 4 * twins.len());
    let run = |(index, new): (usize, &mut [u32])| {
        let twins = &twins[3 * RUN * index..3 * RUN * index + new.len() / 4];
        let faces = new.as_chunks_mut::<12>().0.iter_mut();
        for ((at, new), [t0, t1, t2]) in faces.enumerate().zip(twins.as_chunks::<3>().0) {
            let base = 12 * (RUN * index + at) as u32;
            // at each corner: the first half of its edge, the edge to the middle child, the second half of the edge before
            *new = [
                some(*t0, second_half),
                base + 11,
                some(*t2, first_half),
                some(*t1, second_half),
                base + 9,
                some(*t0, first_half),
                some(*t2, second_half),
                base + 10,
                some(*t1, first_half),
                base + 4,
                base + 7,
                base + 1,
            ];
        }
    };
    new.par_chunks_mut(12 * RUN).enumerate().for_each(run);
    new
}

pub(super) fn leaving(mesh: &HalfEdgeMesh, numbering: &Numbering) -> Vec<u32> {
    let old = mesh.vertex_edges().par_iter().map(|h| first_half(*h));
    // from the point on an edge to the old vertex: the half-edge before the first corner of the next child
    let on_edges = numbering.first_corners().par_iter().map(|h| second_half(*h));
    let mut leaving = room(Vec::new(), mesh.vertices() + numbering.edges());
    let (at_old, at_edges) = leaving.split_at_mut(mesh.vertices());
    at_old.par_iter_mut().zip(old).for_each(|(new, h)| *new = h);
    at_edges.par_iter_mut().zip(on_edges).for_each(|(new, h)| *new = h);
    leaving
}

pub(super) fn edge_children(_: &HalfEdgeMesh, h: u32) -> [u32; 2] {
    [first_half(h), second_half(h)]
}
