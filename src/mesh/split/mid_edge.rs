//! Mid-edge: a new point on each edge. Each face becomes that of the points on its edges, each vertex inside the mesh that of the points
//! on the edges around it (Peters and Reif 1997); faces first, then vertices. The boundary recedes.

use super::{Numbering, room};
use crate::mesh::pairing::fan;
use crate::mesh::{Faces, HalfEdgeMesh, NONE};

pub(super) fn faces(mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let (faces, twins) = (mesh.faces(), mesh.twins());
    let point = |h: u32| numbering.of_corner(h, twins[h as usize]);
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
