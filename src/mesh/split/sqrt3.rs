//! sqrt3: a new point in each triangle; each edge inside the mesh, between the points a and b with the new points f to the left and
//! g to the right of a b, gives way to f g (Kobbelt 2000). Half-edge h, from a to b, becomes the triangle
//!
//! > (a, g, f), and (a, b, f) on the boundary,
//!
//! which is the face h of the new mesh. In every second step an edge a b of the boundary is cut into three, by the points p near a and q near b: its
//! triangle with the apex f has no new point, and becomes (p, q, f) in the middle; for its two other edges p stands for the new point at a, and q at b.

use super::{Birth, Numbering, room};
use crate::mesh::{Connectivity, Faces, HalfEdgeMesh, NONE};
use rayon::prelude::*;

pub(super) fn faces(mesh: &HalfEdgeMesh, buffer: Vec<u32>) -> Faces {
    let (faces, twins) = (mesh.faces(), mesh.twins());
    let in_face = |h: u32| mesh.vertices() as u32 + faces.face_of(h);
    let mut new = room(buffer, 3 * twins.len());
    new.as_chunks_mut::<3>().0.par_iter_mut().enumerate().for_each(|(h, new)| {
        let (h, twin) = (h as u32, twins[h]);
        let beyond = if twin == NONE { faces.corners()[faces.next(h) as usize] } else { in_face(twin) };
        *new = [faces.corners()[h as usize], beyond, in_face(h)];
    });
    Faces::same(3, new)
}

/// The birth of an old vertex in a step that leaves the boundary's edges whole.
pub(super) fn vertex(mesh: &HalfEdgeMesh, vertex: usize) -> Birth {
    let leaving = mesh.vertex_edges()[vertex];
    if mesh.twins()[leaving as usize] == NONE { Birth::Kept(leaving) } else { Birth::Vertex(leaving) }
}

/// The edges that are cut into three, and the triangles that have new points.
pub(super) fn with_thirds(mesh: &HalfEdgeMesh, numbering: Numbering) -> Numbering {
    let twins = mesh.twins();
    let thirds = numbering.first_corners().iter().copied().filter(|h| twins[*h as usize] == NONE).collect();
    let inside = |face: &u32| mesh.faces().range(*face as usize).all(|h| twins[h] != NONE);
    let kept = (0..mesh.faces().len() as u32).filter(inside).collect();
    numbering.keeping(kept).with_thirds(thirds)
}

/// The birth of a point after those of the old vertices.
pub(super) fn birth(mesh: &HalfEdgeMesh, numbering: &Numbering, point: usize) -> Birth {
    let kept = numbering.kept().unwrap_or_default();
    match point.checked_sub(kept.len()) {
        None => Birth::Face(mesh.faces().range(kept[point] as usize).start as u32),
        Some(third) => {
            let h = numbering.thirds()[third / 2];
            Birth::Third(if third % 2 == 0 { h } else { mesh.twin(h) })
        }
    }
}

pub(super) fn faces_with_thirds(mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let (faces, twins) = (mesh.faces(), mesh.twins());
    let kept = numbering.kept().unwrap_or_default();
    let mut in_face = vec![NONE; faces.len()];
    kept.iter().enumerate().for_each(|(at, face)| in_face[*face as usize] = (mesh.vertices() + at) as u32);
    let first_third = (mesh.vertices() + kept.len()) as u32;
    // for each corner the point that stands for the new one of its triangle
    let mut stands: Vec<u32> = (0..twins.len() as u32).map(|h| in_face[faces.face_of(h) as usize]).collect();
    for (at, h) in numbering.thirds().iter().enumerate() {
        let near_a = first_third + 2 * at as u32;
        (stands[faces.prev(*h) as usize], stands[faces.next(*h) as usize]) = (near_a, near_a + 1);
        stands[*h as usize] = near_a;
    }
    let mut new = room(buffer, 3 * twins.len());
    for (h, new) in new.as_chunks_mut::<3>().0.iter_mut().enumerate() {
        let (own, twin) = (stands[h], twins[h]);
        let apex = faces.corners()[faces.prev(h as u32) as usize];
        *new = match twin {
            NONE => [own, own + 1, apex],
            _ => [faces.corners()[h], stands[twin as usize], own],
        };
    }
    Faces::same(3, new)
}
