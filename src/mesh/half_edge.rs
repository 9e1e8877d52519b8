//! Which mesh do these polygons make?
//!
//! Half-edges in one array: h ^ 1 is the twin of h, and `next` is the one permutation that everything follows from.
//! Boundary half-edges have no face; `next` leads them along their hole.

use super::Connectivity;
use std::collections::BTreeMap;
use std::fmt;

const NO_FACE: u32 = u32::MAX;

/// A mesh of polygons, perhaps with a boundary. Every vertex is a disc or a half-disc.
#[derive(Clone, Debug)]
pub struct HalfEdgeMesh {
    origin: Vec<u32>,
    next: Vec<u32>,
    prev: Vec<u32>,
    face: Vec<u32>,
    /// A half-edge that leaves each vertex.
    leaving: Vec<u32>,
    /// A half-edge of each face.
    of_face: Vec<u32>,
}

/// Why polygons don't make a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotAMesh {
    /// A face with fewer than three corners, or with a corner twice.
    Face(usize),
    /// A corner that is not a vertex.
    Corner(usize, usize),
    /// Two faces on the same side of an edge: an edge of three faces, or faces of opposite orientation.
    Edge(usize, usize),
    /// A vertex whose faces are not one fan.
    Vertex(usize),
    /// A vertex without a face.
    Isolated(usize),
    /// More half-edges than 32 bits number.
    TooLarge,
}

impl fmt::Display for NotAMesh {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotAMesh::Face(face) => write!(f, "face {face} has fewer than three corners, or a corner twice"),
            NotAMesh::Corner(face, corner) => write!(f, "face {face} has the corner {corner}, which is not a vertex"),
            NotAMesh::Edge(a, b) => write!(f, "two faces have the edge from vertex {a} to vertex {b} on the same side"),
            NotAMesh::Vertex(vertex) => write!(f, "the faces around vertex {vertex} are not one fan"),
            NotAMesh::Isolated(vertex) => write!(f, "vertex {vertex} belongs to no face"),
            NotAMesh::TooLarge => f.write_str("the mesh has more than 2^31 half-edges"),
        }
    }
}

impl std::error::Error for NotAMesh {}

impl HalfEdgeMesh {
    /// The mesh of `vertices` points whose faces are these polygons, counter-clockwise.
    ///
    /// # Errors
    /// The first thing that keeps them from being a manifold mesh.
    pub fn from_faces(vertices: usize, faces: &[Vec<usize>]) -> Result<HalfEdgeMesh, NotAMesh> {
        if faces.iter().map(Vec::len).sum::<usize>() >= 1 << 30 || vertices >= 1 << 31 {
            return Err(NotAMesh::TooLarge);
        }
        let mut builder = Builder { mesh: HalfEdgeMesh::empty(vertices), by_ends: BTreeMap::new() };
        for (index, face) in faces.iter().enumerate() {
            builder.add_face(index, face, vertices)?;
        }
        builder.close()
    }

    fn empty(vertices: usize) -> Self {
        HalfEdgeMesh {
            origin: vec![],
            next: vec![],
            prev: vec![],
            face: vec![],
            leaving: vec![u32::MAX; vertices],
            of_face: vec![],
        }
    }

    /// The number of vertices.
    pub fn vertices(&self) -> usize {
        self.leaving.len()
    }

    /// The number of faces.
    pub fn faces(&self) -> usize {
        self.of_face.len()
    }

    /// A half-edge that leaves each vertex, in order of the vertices.
    pub fn vertex_edges(&self) -> &[u32] {
        &self.leaving
    }

    /// A half-edge of each edge.
    pub fn edges(&self) -> impl Iterator<Item = u32> {
        (0..self.origin.len() as u32).step_by(2)
    }

    /// A half-edge of each face, in order of the faces.
    pub fn face_edges(&self) -> &[u32] {
        &self.of_face
    }
}

struct Builder {
    mesh: HalfEdgeMesh,
    by_ends: BTreeMap<(usize, usize), u32>,
}

impl Builder {
    fn add_face(&mut self, index: usize, face: &[usize], vertices: usize) -> Result<(), NotAMesh> {
        let mut sorted = face.to_vec();
        sorted.sort_unstable();
        sorted.dedup();
        if face.len() < 3 || sorted.len() != face.len() {
            return Err(NotAMesh::Face(index));
        }
        if let Some(corner) = face.iter().find(|corner| **corner >= vertices) {
            return Err(NotAMesh::Corner(index, *corner));
        }
        let mut around = Vec::with_capacity(face.len());
        for (corner, a) in face.iter().enumerate() {
            let edge = self.half_edge(*a, face[(corner + 1) % face.len()])?;
            self.mesh.face[edge as usize] = index as u32;
            around.push(edge);
        }
        for (corner, edge) in around.iter().enumerate() {
            self.link(*edge, around[(corner + 1) % around.len()]);
        }
        self.mesh.of_face.push(around[0]);
        Ok(())
    }

    /// The half-edge from a to b, which must not have a face yet.
    fn half_edge(&mut self, a: usize, b: usize) -> Result<u32, NotAMesh> {
        if let Some(edge) = self.by_ends.get(&(a, b)) {
            return if self.mesh.face[*edge as usize] == NO_FACE { Ok(*edge) } else { Err(NotAMesh::Edge(a, b)) };
        }
        let mesh = &mut self.mesh;
        let edge = mesh.origin.len() as u32;
        mesh.origin.extend([a as u32, b as u32]);
        mesh.next.extend([u32::MAX; 2]);
        mesh.prev.extend([u32::MAX; 2]);
        mesh.face.extend([NO_FACE; 2]);
        self.by_ends.extend([((a, b), edge), ((b, a), edge + 1)]);
        Ok(edge)
    }

    fn link(&mut self, edge: u32, next: u32) {
        self.mesh.next[edge as usize] = next;
        self.mesh.prev[next as usize] = edge;
    }

    /// Links the boundary and checks that each vertex is one fan.
    fn close(mut self) -> Result<HalfEdgeMesh, NotAMesh> {
        let boundary: Vec<u32> =
            (0..self.mesh.face.len() as u32).filter(|e| self.mesh.face[*e as usize] == NO_FACE).collect();
        let mut leaving = BTreeMap::new();
        for edge in &boundary {
            let vertex = self.mesh.origin[*edge as usize];
            if leaving.insert(vertex, *edge).is_some() {
                return Err(NotAMesh::Vertex(vertex as usize));
            }
        }
        for edge in &boundary {
            let end = self.mesh.origin[(edge ^ 1) as usize];
            let next = leaving.get(&end).ok_or(NotAMesh::Vertex(end as usize))?;
            self.link(*edge, *next);
        }
        let mut degree = vec![0_usize; self.mesh.vertices()];
        for (edge, vertex) in self.mesh.origin.iter().enumerate() {
            degree[*vertex as usize] += 1;
            self.mesh.leaving[*vertex as usize] = edge as u32;
        }
        for (vertex, edge) in self.mesh.leaving.iter().enumerate() {
            if *edge == u32::MAX {
                return Err(NotAMesh::Isolated(vertex));
            }
            if self.mesh.valence(*edge) != degree[vertex] {
                return Err(NotAMesh::Vertex(vertex));
            }
        }
        Ok(self.mesh)
    }
}

impl Connectivity for HalfEdgeMesh {
    type Edge = u32;
    type Point = u32;

    fn twin(&self, edge: u32) -> u32 {
        edge ^ 1
    }

    fn turn(&self, edge: u32) -> u32 {
        self.prev[edge as usize] ^ 1
    }

    fn turn_back(&self, edge: u32) -> u32 {
        self.next[(edge ^ 1) as usize]
    }

    fn origin(&self, edge: u32) -> u32 {
        self.origin[edge as usize]
    }

    fn has_face(&self, edge: u32) -> bool {
        self.face[edge as usize] != NO_FACE
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
        assert_eq!((mesh.vertices(), mesh.edges().count(), mesh.faces()), (4, 6, 4));
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
        for edge in mesh.vertex_edges() {
            let boundary = mesh.boundary_at(*edge).unwrap();
            assert!(!mesh.has_face(boundary) && mesh.origin(boundary) == mesh.origin(*edge));
            assert_eq!(mesh.around_face(boundary).len(), 4, "the boundary has four edges");
        }
    }

    #[test]
    fn what_is_not_a_mesh_is_named() {
        let refused = |vertices, faces: &[Vec<usize>]| HalfEdgeMesh::from_faces(vertices, faces).unwrap_err();
        assert_eq!(refused(3, &[vec![0, 1]]), NotAMesh::Face(0));
        assert_eq!(refused(3, &[vec![0, 1, 1]]), NotAMesh::Face(0));
        assert_eq!(refused(3, &[vec![0, 1, 7]]), NotAMesh::Corner(0, 7));
        assert_eq!(refused(4, &[vec![0, 1, 2], vec![0, 1, 3]]), NotAMesh::Edge(0, 1));
        assert_eq!(refused(4, &[vec![0, 1, 2]]), NotAMesh::Isolated(3));
        assert_eq!(refused(5, &[vec![0, 1, 2], vec![0, 3, 4]]), NotAMesh::Vertex(0));
    }
}
