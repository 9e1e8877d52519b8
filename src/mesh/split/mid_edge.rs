//! Mid-edge: a new point on each edge. Each face becomes that of the points on its edges, each vertex inside the mesh that of the points
//! on the edges around it (Peters and Reif 1997); faces first, then vertices. The boundary recedes. Where both ends of an edge inside the mesh
//! lie on it, the faces beside the edge part, and the edge has a point for each.

use super::{Numbering, room};
use crate::mesh::pairing::fan;
use crate::mesh::{Connectivity, Faces, HalfEdgeMesh, NONE};

/// The edges whose points come twice.
pub(super) fn parting_edges(mesh: &HalfEdgeMesh, numbering: &Numbering) -> Vec<u32> {
    let twins = mesh.twins();
    let on_boundary = |vertex: u32| twins[mesh.vertex_edges()[vertex as usize] as usize] == NONE;
    let parts = |h: &u32| twins[*h as usize] != NONE && on_boundary(mesh.origin(*h)) && on_boundary(mesh.target(*h));
    numbering.first_corners().iter().filter(|h| parts(h)).map(|h| numbering.of_first(*h)).collect()
}

pub(super) fn faces(mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let (faces, twins) = (mesh.faces(), mesh.twins());
    let edges = numbering.edges() as u32;
    let point = |h: u32| {
        let (twin, edge) = (twins[h as usize], numbering.of_corner(h, twins[h as usize]));
        let second = numbering.kept().filter(|_| twin < h).and_then(|parting| parting.binary_search(&edge).ok());
        second.map_or(edge, |at| edges + at as u32)
    };
    let mut sizes: Vec<u32> = (0..faces.len()).map(|face| faces.range(face).len() as u32).collect();
    let mut corners = room(buffer, 0);
    corners.clear();
    corners.extend((0..twins.len() as u32).map(point));
    for leaving in mesh.vertex_edges().iter().filter(|h| twins[**h as usize] != NONE) {
        let before = corners.len();
        corners.extend(fan(faces, twins, *leaving).map(point));
        sizes.push((corners.len() - before) as u32);
    }
    Faces::mixed(&sizes, corners)
}
