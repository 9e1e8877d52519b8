//! Which mesh do these polygons make?
//!
//! A half-edge is a corner of a face: h leaves the vertex `corners[h]` along its face, so face, next and previous are
//! arithmetic, and only the twin is stored. The boundary's half-edges have no face; they are not stored either: the one
//! across from h is numbered H + h, H being the number of corners.

use super::pairing::{self, NotAMesh};
use super::{Connectivity, Faces};

/// No half-edge: the twin of a boundary edge's only corner.
pub const NONE: u32 = u32::MAX;

/// The most corners of a mesh: half-edges, the boundary's included, are numbered with 32 bits.
pub const MAX_CORNERS: usize = (1 << 31) - 1;

/// A mesh of polygons, perhaps with a boundary. Every vertex is a disc or a half-disc.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HalfEdgeMesh {
    faces: Faces,
    twin: Vec<u32>,
    leaving: Vec<u32>,
}

impl HalfEdgeMesh {
    /// The mesh of `vertices` points with these faces.
    ///
    /// # Errors
    /// The first thing that keeps them from being a manifold mesh, every vertex with at least one face.
    pub fn new(vertices: usize, faces: Faces) -> Result<HalfEdgeMesh, NotAMesh> {
        pairing::check(vertices, &faces)?;
        let twin = pairing::twins(vertices, &faces)?;
        let leaving = pairing::leaving(vertices, &faces, &twin)?;
        Ok(HalfEdgeMesh { faces, twin, leaving })
    }

    /// The mesh of `vertices` points whose faces are these polygons, counter-clockwise.
    ///
    /// # Errors
    /// As [`HalfEdgeMesh::new`].
    pub fn from_faces<T: AsRef<[usize]>>(vertices: usize, faces: &[T]) -> Result<HalfEdgeMesh, NotAMesh> {
        for (index, face) in faces.iter().enumerate() {
            if let Some(corner) = face.as_ref().iter().find(|corner| **corner >= vertices) {
                return Err(NotAMesh::Corner(index, *corner));
            }
        }
        HalfEdgeMesh::new(vertices, Faces::from_lists(faces))
    }

    /// A mesh from its parts, as a split makes them: the twin of each corner, and a corner that leaves each vertex, the first
    /// of its fan where it lies on the boundary.
    pub(super) fn from_parts(faces: Faces, twin: Vec<u32>, leaving: Vec<u32>) -> HalfEdgeMesh {
        HalfEdgeMesh { faces, twin, leaving }
    }

    /// Faces and twins alone.
    pub(super) fn into_faces_and_twins(self) -> (Faces, Vec<u32>) {
        (self.faces, self.twin)
    }

    /// The number of vertices.
    pub fn vertices(&self) -> usize {
        self.leaving.len()
    }

    /// The faces.
    pub fn faces(&self) -> &Faces {
        &self.faces
    }

    /// The twin of each corner, [`NONE`] at the boundary.
    pub fn twins(&self) -> &[u32] {
        &self.twin
    }

    /// A half-edge that leaves each vertex, in order of the vertices; at a boundary vertex the first one counter-clockwise.
    pub fn vertex_edges(&self) -> &[u32] {
        &self.leaving
    }

    /// The number of edges.
    pub fn edge_count(&self) -> usize {
        self.edges().count()
    }

    /// A half-edge of each edge: the first of its corners.
    pub fn edges(&self) -> impl Iterator<Item = u32> {
        (0..self.twin.len() as u32).filter(|h| self.is_first(*h))
    }

    /// Whether a corner is the first one of its edge: edges are numbered in the order of these.
    #[inline]
    pub fn is_first(&self, corner: u32) -> bool {
        corner < self.twin[corner as usize]
    }

    /// The first half-edge of each face, in order of the faces.
    pub fn face_edges(&self) -> impl Iterator<Item = u32> {
        (0..self.faces.len()).map(|face| self.faces.range(face).start as u32)
    }

    /// Whether there is no boundary.
    pub fn is_closed(&self) -> bool {
        !self.twin.contains(&NONE)
    }

    /// Vertices - edges + faces.
    pub fn euler_characteristic(&self) -> i64 {
        self.vertices() as i64 - self.edge_count() as i64 + self.faces.len() as i64
    }

    /// Whether a half-edge is the boundary's, which has no face.
    #[inline]
    fn is_outer(&self, edge: u32) -> bool {
        edge as usize >= self.twin.len()
    }

    /// Checks every relation of the mesh.
    ///
    /// # Errors
    /// The first relation that is broken, in words.
    pub fn validate(&self) -> Result<(), String> {
        let (corners, vertices) = (self.faces.corners(), self.vertices());
        if self.twin.len() != corners.len() {
            return Err(format!("{} corners, but {} twins", corners.len(), self.twin.len()));
        }
        for (h, vertex) in corners.iter().enumerate() {
            if *vertex as usize >= vertices {
                return Err(format!("half-edge {h} leaves vertex {vertex}, which does not exist"));
            }
            let twin = self.twin[h];
            if twin == NONE {
                continue;
            }
            if self.twin.get(twin as usize) != Some(&(h as u32)) || twin as usize == h {
                return Err(format!("twin(twin({h})) is not {h}"));
            }
            if corners[self.faces.next(twin) as usize] != *vertex {
                return Err(format!("the twin of half-edge {h} does not lead to its origin"));
            }
        }
        let mut around = 0;
        for (vertex, h) in self.leaving.iter().enumerate() {
            if corners.get(*h as usize) != Some(&(vertex as u32)) {
                return Err(format!("the half-edge that leaves vertex {vertex} leaves another"));
            }
            let mut at = *h;
            loop {
                around += 1;
                at = self.twin[self.faces.prev(at) as usize];
                if at == *h || at == NONE {
                    break;
                }
                if around > corners.len() {
                    return Err(format!("walking around vertex {vertex} does not come to an end"));
                }
            }
        }
        if around != corners.len() {
            return Err(format!("{} corners, but {around} are met around the vertices", corners.len()));
        }
        Ok(())
    }
}

impl Connectivity for HalfEdgeMesh {
    type Edge = u32;
    type Point = u32;

    #[inline]
    fn twin(&self, edge: u32) -> u32 {
        if self.is_outer(edge) {
            return edge - self.twin.len() as u32;
        }
        let twin = self.twin[edge as usize];
        if twin == NONE { edge + self.twin.len() as u32 } else { twin }
    }

    fn turn(&self, edge: u32) -> u32 {
        if !self.is_outer(edge) {
            return self.twin(self.faces.prev(edge));
        }
        // clockwise through the fan, to the first of its half-edges
        let mut at = self.faces.next(self.twin(edge));
        while self.twin[at as usize] != NONE {
            at = self.faces.next(self.twin[at as usize]);
        }
        at
    }

    fn turn_back(&self, edge: u32) -> u32 {
        let twin = self.twin(edge);
        if !self.is_outer(twin) {
            return self.faces.next(twin);
        }
        // counter-clockwise through the fan, to the half-edge beyond its last
        let mut at = edge;
        while !self.is_outer(at) {
            at = self.turn(at);
        }
        at
    }

    #[inline]
    fn origin(&self, edge: u32) -> u32 {
        if self.is_outer(edge) {
            return self.faces.corners()[self.faces.next(self.twin(edge)) as usize];
        }
        self.faces.corners()[edge as usize]
    }

    #[inline]
    fn has_face(&self, edge: u32) -> bool {
        !self.is_outer(edge)
    }

    fn next(&self, edge: u32) -> u32 {
        if self.is_outer(edge) { self.turn_back(self.twin(edge)) } else { self.faces.next(edge) }
    }

    fn prev(&self, edge: u32) -> u32 {
        if self.is_outer(edge) { self.twin(self.turn(edge)) } else { self.faces.prev(edge) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Vec<Vec<usize>> {
        vec![vec![0, 2, 1], vec![0, 1, 3], vec![1, 2, 3], vec![2, 0, 3]]
    }

    #[test]
    fn a_closed_mesh_keeps_the_laws_of_half_edges() {
        let mesh = HalfEdgeMesh::from_faces(4, &tetrahedron()).unwrap();
        assert_eq!((mesh.vertices(), mesh.edges().count(), mesh.faces().len()), (4, 6, 4));
        assert_eq!((mesh.euler_characteristic(), mesh.is_closed()), (2, true));
        mesh.validate().unwrap();
        for edge in 0..12 {
            assert_eq!(mesh.twin(mesh.twin(edge)), edge);
            assert_eq!(mesh.next(edge), mesh.turn_back(mesh.twin(edge)));
            assert_eq!(mesh.around_face(edge).len(), 3);
            assert_eq!(mesh.valence(edge), 3);
            assert_eq!(mesh.boundary_at(edge), None);
        }
    }

    #[test]
    fn a_boundary_is_found_from_its_vertices() {
        let fan = [vec![0, 1, 2], vec![0, 2, 3]];
        let mesh = HalfEdgeMesh::from_faces(4, &fan).unwrap();
        mesh.validate().unwrap();
        for edge in mesh.vertex_edges() {
            let boundary = mesh.boundary_at(*edge).unwrap();
            assert!(!mesh.has_face(boundary) && mesh.origin(boundary) == mesh.origin(*edge));
            assert_eq!(mesh.around_face(boundary).len(), 4, "the boundary has four edges");
            assert_eq!(mesh.turn(boundary), *edge, "the fan starts after the boundary");
            assert_eq!(mesh.turn_back(*edge), boundary);
            assert_eq!(mesh.prev(mesh.next(boundary)), boundary);
            assert_eq!(mesh.target(boundary), mesh.origin(mesh.next(boundary)));
        }
    }

    #[test]
    fn what_is_not_a_mesh_is_named() {
        let refused = |vertices, faces: &[Vec<usize>]| HalfEdgeMesh::from_faces(vertices, faces).unwrap_err();
        assert_eq!(refused(3, &[vec![0, 1]]), NotAMesh::Face(0));
        assert_eq!(refused(3, &[vec![0, 1, 1]]), NotAMesh::Face(0));
        assert_eq!(refused(3, &[vec![0, 1, 7]]), NotAMesh::Corner(0, 7));
        assert_eq!(refused(4, &[vec![0, 1, 2]]), NotAMesh::Isolated(3));
        assert_eq!(refused(5, &[vec![0, 1, 2], vec![0, 3, 4]]), NotAMesh::Vertex(0));
        assert_eq!(refused(4, &[vec![0, 1, 2], vec![0, 1, 3]]), NotAMesh::Orientation { ends: [0, 1], faces: [0, 1] });
        assert_eq!(
            refused(5, &[vec![0, 1, 2], vec![1, 0, 3], vec![0, 1, 4]]),
            NotAMesh::Edge { ends: [0, 1], faces: vec![0, 1, 2] }
        );
        assert_eq!(refused(3, &[vec![0, 1, 2], vec![1, 2, 0]]), NotAMesh::Twice([0, 1]));
    }

    #[test]
    fn a_broken_relation_is_named() {
        let mesh = HalfEdgeMesh::from_faces(4, &tetrahedron()).unwrap();
        let mut broken = mesh.clone();
        broken.twin[0] = 0;
        assert!(broken.validate().unwrap_err().contains("twin(twin(0))"));
        let mut broken = mesh.clone();
        broken.leaving[2] = broken.leaving[1];
        assert!(broken.validate().unwrap_err().contains("vertex 2"));
        let mut broken = mesh;
        broken.twin.swap(0, 1);
        assert!(broken.validate().is_err());
    }
}
