//! sqrt2: a new point in each face; each edge inside the mesh becomes a quad of its ends and the new points beside it, and old edges
//! vanish. Two steps bisect every edge. The quad of the edge with first corner h, from a to b, with the new points f to its left and
//! g to its right, is
//!
//! > (a, g, b, f).
//!
//! Edges of the boundary make no quad, so that the boundary recedes; vertices with no other edge vanish.

use super::{Numbering, room};
use crate::mesh::{Connectivity, Faces, HalfEdgeMesh, NONE};

/// The vertices that have an edge inside the mesh.
pub(super) fn kept_vertices(mesh: &HalfEdgeMesh) -> Vec<u32> {
    let inner = |h: &u32| mesh.has_face(*h) && mesh.has_face(mesh.twin(*h));
    let kept = |vertex: &u32| mesh.around_vertex(mesh.vertex_edges()[*vertex as usize]).iter().any(inner);
    (0..mesh.vertices() as u32).filter(kept).collect()
}

pub(super) fn faces(mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let (faces, twins) = (mesh.faces(), mesh.twins());
    let vertices = numbering.kept().map_or(mesh.vertices(), <[u32]>::len) as u32;
    let mut at = vec![NONE; if numbering.kept().is_some() { mesh.vertices() } else { 0 }];
    numbering.kept().into_iter().flatten().enumerate().for_each(|(new, old)| at[*old as usize] = new as u32);
    let vertex = |old: u32| if at.is_empty() { old } else { at[old as usize] };
    let in_face = |h: u32| vertices + faces.face_of(h);
    let mut new = room(buffer, 0);
    new.clear();
    for h in numbering.first_corners() {
        let twin = twins[*h as usize];
        if twin != NONE {
            let [a, b] = [*h, faces.next(*h)].map(|h| vertex(faces.corners()[h as usize]));
            new.extend([a, in_face(twin), b, in_face(*h)]);
        }
    }
    Faces::same(4, new)
}
