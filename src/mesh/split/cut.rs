//! How is the boundary refined under splits that turn the lattice?
//!
//! Its edges stay in one step and are cut in the next: into three (sqrt3), or halved (sqrt2). After the first, each lies at a triangle of its own, which
//! gets no new point in the second: the points on its edge stand for that.

use super::{Birth, Numbering};
use crate::mesh::{HalfEdgeMesh, NONE};

/// The birth of an old vertex in a step that leaves the boundary's edges whole.
pub(super) fn vertex(mesh: &HalfEdgeMesh, vertex: usize) -> Birth {
    let leaving = mesh.vertex_edges()[vertex];
    if mesh.twins()[leaving as usize] == NONE { Birth::Kept(leaving) } else { Birth::Vertex(leaving) }
}

/// The edges that are cut, and the faces that have new points.
pub(super) fn numbering(mesh: &HalfEdgeMesh, numbering: Numbering) -> Numbering {
    let twins = mesh.twins();
    let cut = numbering.first_corners().iter().copied().filter(|h| twins[*h as usize] == NONE).collect();
    numbering.keeping(kept_faces(mesh)).cutting(cut)
}

/// The faces that have no edge on the boundary.
pub(super) fn kept_faces(mesh: &HalfEdgeMesh) -> Vec<u32> {
    let inside = |face: &u32| mesh.faces().range(*face as usize).all(|h| mesh.twins()[h] != NONE);
    (0..mesh.faces().len() as u32).filter(inside).collect()
}

/// Where a point after those of the old vertices is born: in a face that is kept, or as one of some points on an edge that is cut, which tells the first
/// corner of the edge and which of the points it is.
pub(super) fn place(
    mesh: &HalfEdgeMesh,
    numbering: &Numbering,
    point: usize,
    points: usize,
) -> Result<Birth, (u32, usize)> {
    let kept = numbering.kept().unwrap_or_default();
    match point.checked_sub(kept.len()) {
        None => Ok(Birth::Face(mesh.faces().range(kept[point] as usize).start as u32)),
        Some(on_edges) => Err((numbering.cut()[on_edges / points], on_edges % points)),
    }
}

/// Which new point stands for that of the face at each corner.
pub(super) struct Stands<'m> {
    mesh: &'m HalfEdgeMesh,
    /// For each corner; `None` where all faces have new points.
    at: Option<Vec<u32>>,
}

impl<'m> Stands<'m> {
    /// Where every face has a new point.
    pub(super) fn in_every_face(mesh: &'m HalfEdgeMesh) -> Stands<'m> {
        Stands { mesh, at: None }
    }

    /// Where edges are cut by some points, the first near the edge's first corner, the last near its other end.
    pub(super) fn cut(mesh: &'m HalfEdgeMesh, numbering: &Numbering, points: u32) -> Stands<'m> {
        let faces = mesh.faces();
        let kept = numbering.kept().unwrap_or_default();
        let mut in_face = vec![NONE; faces.len()];
        kept.iter().enumerate().for_each(|(at, face)| in_face[*face as usize] = (mesh.vertices() + at) as u32);
        let mut at: Vec<u32> = (0..mesh.twins().len() as u32).map(|h| in_face[faces.face_of(h) as usize]).collect();
        let first = (mesh.vertices() + kept.len()) as u32;
        for (edge, h) in numbering.cut().iter().enumerate() {
            let near = first + points * edge as u32;
            at[*h as usize] = near;
            (at[faces.prev(*h) as usize], at[faces.next(*h) as usize]) = (near, near + points - 1);
        }
        Stands { mesh, at: Some(at) }
    }

    /// The point at a corner.
    pub(super) fn at(&self, corner: u32) -> u32 {
        let in_face = || self.mesh.vertices() as u32 + self.mesh.faces().face_of(corner);
        self.at.as_ref().map_or_else(in_face, |at| at[corner as usize])
    }
}
