//! sqrt3: a new point in each triangle; each edge inside the mesh, between the points a and b with the new points f to the left and
//! g to the right of a b, gives way to f g (Kobbelt 2000). Half-edge h, from a to b, becomes the triangle
//!
//! > (a, g, f), and (a, b, f) on the boundary,
//!
//! which is the face h of the new mesh.

use super::room;
use crate::mesh::{Faces, HalfEdgeMesh, NONE};
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
