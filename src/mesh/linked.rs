//! How is a mesh cut up by hand?
//!
//! A mesh whose half-edges are linked, so that edges and faces can be split one at a time. Twins stand side by side (the twin of h is
//! h ^ 1); the mesh is the one permutation `next`, and the rest are its orbits. The boundary's half-edges are there, without a face.

use super::half_edge::MAX_CORNERS;
use super::{Connectivity, Faces, HalfEdgeMesh};
use std::fmt;

const NO_FACE: u32 = u32::MAX;

/// A mesh that can be cut.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinkedMesh {
    origin: Vec<u32>,
    next: Vec<u32>,
    prev: Vec<u32>,
    face: Vec<u32>,
    /// A half-edge that leaves each vertex.
    leaving: Vec<u32>,
    /// A half-edge of each face.
    of_face: Vec<u32>,
}

/// Why a cut can't be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoCut {
    /// The half-edge does not exist.
    NoHalfEdge(u32),
    /// The half-edge belongs to the boundary, and has no face.
    NoFace(u32),
    /// The half-edges are of different faces.
    TwoFaces(u32, u32),
    /// The half-edges lead to the same vertex, or to neighbours along the face: nothing would be cut off.
    NothingBetween(u32, u32),
    /// The mesh would have more half-edges than 32 bits number.
    TooLarge,
}

impl fmt::Display for NoCut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoCut::NoHalfEdge(h) => write!(f, "there is no half-edge {h}"),
            NoCut::NoFace(h) => write!(f, "half-edge {h} lies along the boundary and has no face to be split"),
            NoCut::TwoFaces(h, g) => write!(f, "half-edges {h} and {g} belong to different faces"),
            NoCut::NothingBetween(h, g) => {
                write!(f, "half-edges {h} and {g} lead to the same vertex, or to neighbours along the face")
            }
            NoCut::TooLarge => f.write_str("the mesh would have too many half-edges"),
        }
    }
}

impl std::error::Error for NoCut {}

impl From<&HalfEdgeMesh> for LinkedMesh {
    /// The same mesh: faces and vertices keep their numbers, edge e becomes the half-edges 2 e and 2 e + 1.
    fn from(mesh: &HalfEdgeMesh) -> LinkedMesh {
        let corners = mesh.twins().len() as u32;
        let mut number = vec![0; 2 * corners as usize];
        let mut order = Vec::new();
        for (edge, h) in mesh.edges().enumerate() {
            let twin = mesh.twin(h);
            number[h as usize] = 2 * edge as u32;
            number[twin as usize] = 2 * edge as u32 + 1;
            order.extend([h, twin]);
        }
        let of = |h: u32| number[h as usize];
        let face = |h: &u32| if mesh.has_face(*h) { mesh.faces().face_of(*h) } else { NO_FACE };
        LinkedMesh {
            origin: order.iter().map(|h| mesh.origin(*h)).collect(),
            next: order.iter().map(|h| of(mesh.next(*h))).collect(),
            prev: order.iter().map(|h| of(mesh.prev(*h))).collect(),
            face: order.iter().map(face).collect(),
            leaving: mesh.vertex_edges().iter().map(|h| of(*h)).collect(),
            of_face: mesh.face_edges().map(of).collect(),
        }
    }
}

impl LinkedMesh {
    /// The number of vertices.
    pub fn vertices(&self) -> usize {
        self.leaving.len()
    }

    /// The number of half-edges, twice that of edges.
    pub fn half_edges(&self) -> usize {
        self.origin.len()
    }

    /// A half-edge of each face, in order of the faces.
    pub fn face_edges(&self) -> &[u32] {
        &self.of_face
    }

    /// A half-edge that leaves each vertex, in order of the vertices.
    pub fn vertex_edges(&self) -> &[u32] {
        &self.leaving
    }

    /// The face to the left of a half-edge; `None` along the boundary.
    pub fn face(&self, h: u32) -> Option<u32> {
        Some(self.face[h as usize]).filter(|face| *face != NO_FACE)
    }

    /// The faces, each from its half-edge on.
    pub fn faces(&self) -> Faces {
        let around = |h: &u32| self.around_face(*h).into_iter().map(|edge| self.origin(edge) as usize).collect();
        Faces::from_lists(&self.of_face.iter().map(around).collect::<Vec<Vec<usize>>>())
    }

    /// Splits the edge of h by a new vertex. h keeps its origin and leads to the new vertex now; gives the half-edge that goes on
    /// from there, which is next(h).
    ///
    /// # Errors
    /// When there is no such half-edge.
    pub fn split_edge(&mut self, h: u32) -> Result<u32, NoCut> {
        self.check(h)?;
        let (twin, vertex) = (h ^ 1, self.leaving.len() as u32);
        let (before_twin, after) = (self.prev[twin as usize], self.next[h as usize]);
        let end = self.origin[twin as usize];
        let on = self.new_edge(vertex, end, self.face[h as usize], self.face[twin as usize])?;
        self.origin[twin as usize] = vertex;
        self.leaving.push(on);
        if self.leaving[end as usize] == twin {
            self.leaving[end as usize] = on ^ 1;
        }
        // along h: h, on; along its twin: on ^ 1, twin
        self.link(on, after);
        self.link(h, on);
        self.link(before_twin, on ^ 1);
        self.link(on ^ 1, twin);
        Ok(on)
    }

    /// Splits the face of h and g by an edge from the vertex that h leads to, to the one that g leads to. Gives the new half-edge after
    /// h, which is next(h): its side keeps the face; the side of g gets a new one.
    ///
    /// # Errors
    /// When h and g are not half-edges of one face, or nothing lies between their ends.
    pub fn split_face(&mut self, h: u32, g: u32) -> Result<u32, NoCut> {
        for edge in [h, g] {
            self.check(edge)?;
            if self.face[edge as usize] == NO_FACE {
                return Err(NoCut::NoFace(edge));
            }
        }
        if self.face[h as usize] != self.face[g as usize] {
            return Err(NoCut::TwoFaces(h, g));
        }
        let (after_h, after_g) = (self.next[h as usize], self.next[g as usize]);
        if h == g || after_h == g || after_g == h {
            return Err(NoCut::NothingBetween(h, g));
        }
        let (kept, new) = (self.face[h as usize], self.of_face.len() as u32);
        let edge = self.new_edge(self.target(h), self.target(g), kept, new)?;
        self.link(h, edge);
        self.link(edge, after_g);
        self.link(g, edge ^ 1);
        self.link(edge ^ 1, after_h);
        self.of_face[kept as usize] = h;
        self.of_face.push(g);
        for own in self.around_face(g) {
            self.face[own as usize] = new;
        }
        Ok(edge)
    }

    fn check(&self, h: u32) -> Result<(), NoCut> {
        if (h as usize) < self.origin.len() { Ok(()) } else { Err(NoCut::NoHalfEdge(h)) }
    }

    /// Two new half-edges, from a to b and back, with their faces, not linked yet.
    fn new_edge(&mut self, a: u32, b: u32, left: u32, right: u32) -> Result<u32, NoCut> {
        let edge = self.origin.len() as u32;
        if self.origin.len() + 2 > MAX_CORNERS {
            return Err(NoCut::TooLarge);
        }
        self.origin.extend([a, b]);
        self.face.extend([left, right]);
        self.next.extend([edge ^ 1, edge]);
        self.prev.extend([edge ^ 1, edge]);
        Ok(edge)
    }

    fn link(&mut self, edge: u32, next: u32) {
        self.next[edge as usize] = next;
        self.prev[next as usize] = edge;
    }

    /// Checks every relation of the mesh.
    ///
    /// # Errors
    /// The first relation that is broken, in words.
    pub fn validate(&self) -> Result<(), String> {
        let count = self.origin.len();
        let inside = |h: u32| (h as usize) < count;
        if self.next.len() != count || self.prev.len() != count || self.face.len() != count || !count.is_multiple_of(2)
        {
            return Err("the lists of half-edges differ in length".to_string());
        }
        for h in 0..count as u32 {
            let (next, prev) = (self.next[h as usize], self.prev[h as usize]);
            if !inside(next) || !inside(prev) || self.prev[next as usize] != h || self.next[prev as usize] != h {
                return Err(format!("next and prev of half-edge {h} do not undo each other"));
            }
            if self.face[next as usize] != self.face[h as usize] {
                return Err(format!("half-edge {h} and the next belong to different faces"));
            }
            if self.origin[next as usize] != self.origin[(h ^ 1) as usize] {
                return Err(format!("the half-edge after {h} does not leave where {h} leads to"));
            }
        }
        for (face, h) in self.of_face.iter().enumerate() {
            if !inside(*h) || self.face[*h as usize] != face as u32 {
                return Err(format!("the half-edge of face {face} belongs to another"));
            }
        }
        for (vertex, h) in self.leaving.iter().enumerate() {
            if !inside(*h) || self.origin[*h as usize] != vertex as u32 {
                return Err(format!("the half-edge that leaves vertex {vertex} leaves another"));
            }
        }
        let orbits =
            |heads: &[u32], step: fn(&Self, u32) -> Vec<u32>| heads.iter().map(|h| step(self, *h).len()).sum::<usize>();
        if orbits(&self.leaving, |mesh, h| mesh.around_vertex(h)) != count {
            return Err("the half-edges around a vertex are not all that leave it".to_string());
        }
        let with_face = self.face.iter().filter(|face| **face != NO_FACE).count();
        if orbits(&self.of_face, |mesh, h| mesh.around_face(h)) != with_face {
            return Err("the half-edges along a face are not all that belong to it".to_string());
        }
        Ok(())
    }
}

impl Connectivity for LinkedMesh {
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
    use crate::mesh::shapes;

    fn linked(soup: &crate::mesh::PolygonSoup) -> LinkedMesh {
        LinkedMesh::from(&HalfEdgeMesh::new(soup.positions.len(), soup.faces.clone()).unwrap())
    }

    #[test]
    fn every_cut_leaves_a_mesh() {
        for soup in [shapes::cube(), shapes::fan(3, false), shapes::tube(2, 4, true), shapes::fan(1, true)] {
            let mut mesh = linked(&soup);
            mesh.validate().unwrap();
            for h in (0..mesh.half_edges() as u32).step_by(2) {
                let vertices = mesh.vertices();
                let on = mesh.split_edge(h).unwrap();
                mesh.validate().unwrap();
                assert_eq!((mesh.next(h), mesh.origin(on) as usize, mesh.valence(on)), (on, vertices, 2));
            }
            for face in 0..mesh.face_edges().len() {
                let h = mesh.face_edges()[face];
                let g = mesh.next(mesh.next(h));
                let (from, to, faces) = (mesh.target(h), mesh.target(g), mesh.face_edges().len());
                let new = mesh.split_face(h, g).unwrap();
                mesh.validate().unwrap();
                assert_eq!((mesh.next(h), mesh.origin(new), mesh.target(new)), (new, from, to));
                assert_eq!((mesh.face(h), mesh.face(new ^ 1)), (Some(face as u32), Some(faces as u32)));
                assert_eq!(mesh.around_face(g).len(), 3, "the corner between h and g is cut off");
            }
        }
    }

    #[test]
    fn what_cannot_be_cut_is_named() {
        let mut mesh = linked(&shapes::fan(2, true));
        let inside = mesh.face_edges().to_vec();
        let (h, g) = (inside[0], mesh.next(inside[0]));
        let before = mesh.clone();
        assert_eq!(mesh.split_face(h, inside[1]), Err(NoCut::TwoFaces(h, inside[1])));
        assert_eq!(mesh.split_face(h, g), Err(NoCut::NothingBetween(h, g)));
        assert_eq!(mesh.split_face(h, h), Err(NoCut::NothingBetween(h, h)));
        assert_eq!(mesh.split_edge(99), Err(NoCut::NoHalfEdge(99)));
        let outer = (0..mesh.half_edges() as u32).find(|h| !mesh.has_face(*h)).unwrap();
        assert_eq!(mesh.split_face(outer, h), Err(NoCut::NoFace(outer)));
        assert_eq!(mesh, before, "a refused cut changes nothing");
    }

    #[test]
    fn a_broken_link_is_named() {
        let whole = linked(&shapes::cube());
        let broken = |break_it: fn(&mut LinkedMesh)| {
            let mut mesh = whole.clone();
            break_it(&mut mesh);
            mesh.validate().unwrap_err()
        };
        assert!(broken(|mesh| mesh.next[3] = 3).contains("next and prev"));
        assert!(broken(|mesh| mesh.face[0] ^= 1).contains("different faces"));
        assert!(broken(|mesh| mesh.origin[5] = mesh.origin[4]).contains("leave"));
        assert!(broken(|mesh| mesh.of_face[2] = mesh.of_face[1]).contains("face 2"));
        assert!(broken(|mesh| mesh.leaving[2] = mesh.leaving[1]).contains("vertex 2"));
    }
}
