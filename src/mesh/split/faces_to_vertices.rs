//! Faces to vertices: a new point in each face, and each vertex inside the mesh becomes the face of the points around it: the dual mesh.
//! Vertices of the boundary make no face, so that the boundary recedes; faces with no other vertex vanish.

use super::{Numbering, room};
use crate::mesh::pairing::fan;
use crate::mesh::{Faces, HalfEdgeMesh, NONE};

fn inside(mesh: &HalfEdgeMesh, leaving: u32) -> bool {
    mesh.twins()[leaving as usize] != NONE
}

/// The faces that have a vertex inside the mesh.
pub(super) fn kept_faces(mesh: &HalfEdgeMesh) -> Vec<u32> {
    let vertex_is_inside = |vertex: &u32| inside(mesh, mesh.vertex_edges()[*vertex as usize]);
    let kept = |face: &usize| mesh.faces().face(*face).iter().any(vertex_is_inside);
    (0..mesh.faces().len()).filter(kept).map(|face| face as u32).collect()
}

pub(super) fn faces(mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let (faces, twins) = (mesh.faces(), mesh.twins());
    let mut at = vec![NONE; if numbering.kept().is_some() { faces.len() } else { 0 }];
    numbering.kept().into_iter().flatten().enumerate().for_each(|(new, old)| at[*old as usize] = new as u32);
    let point = |h: u32| {
        let face = faces.face_of(h);
        if at.is_empty() { face } else { at[face as usize] }
    };
    let (mut sizes, mut corners) = (Vec::new(), room(buffer, 0));
    corners.clear();
    for leaving in mesh.vertex_edges().iter().filter(|h| inside(mesh, **h)) {
        let before = corners.len();
        corners.extend(fan(faces, twins, *leaving).map(point));
        sizes.push((corners.len() - before) as u32);
    }
    Faces::mixed(&sizes, corners)
}
