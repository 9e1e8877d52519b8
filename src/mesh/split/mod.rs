//! How does a step make new faces out of old ones?
//!
//! Each split in a file of its own: which points are born, which faces they make, and which half-edges are twins. Everything is
//! arithmetic on corners; the only thing looked up is the number of an edge. Old vertices come first, then the points of
//! edges, in the order of their first corners, then those of faces.

mod dual;
mod numbering;
mod one_to_four;
mod one_to_n;

pub use numbering::Numbering;

use super::half_edge::NONE;
use super::{Faces, HalfEdgeMesh, MAX_CORNERS, NotAMesh, Tags};

/// The splits that there is topology for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    /// Each triangle into four, by new points on its edges.
    OneToFour,
    /// Each polygon into quads, by new points on its edges and in its middle.
    OneToN,
    /// A new point for each corner of each face; faces, edges and vertices become faces. The boundary recedes.
    Dual,
}

/// The place of a mesh that a new point is born at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Birth {
    /// At the vertex that this half-edge leaves.
    Vertex(u32),
    /// On the edge with this first corner.
    Edge(u32),
    /// In the face that this half-edge belongs to.
    Face(u32),
    /// At this corner.
    Corner(u32),
}

impl Birth {
    /// The half-edge that tells the place.
    pub fn half_edge(self) -> u32 {
        let (Birth::Vertex(edge) | Birth::Edge(edge) | Birth::Face(edge) | Birth::Corner(edge)) = self;
        edge
    }
}

impl Split {
    /// The split of this name in scheme files.
    pub fn named(name: &str) -> Option<Split> {
        match name {
            "1-to-4" => Some(Split::OneToFour),
            "1-to-n" => Some(Split::OneToN),
            "dual" => Some(Split::Dual),
            _ => None,
        }
    }

    /// The number of corners of the new mesh.
    ///
    /// # Errors
    /// When 32 bits don't number them.
    pub fn new_corners(self, mesh: &HalfEdgeMesh) -> Result<usize, NotAMesh> {
        let corners = match self {
            Split::OneToFour | Split::OneToN => mesh.twins().len().checked_mul(4),
            Split::Dual => dual::new_corners(mesh),
        };
        corners.filter(|corners| *corners <= MAX_CORNERS).ok_or(NotAMesh::TooLarge)
    }

    /// The number of points of the new mesh.
    pub fn new_vertices(self, mesh: &HalfEdgeMesh, numbering: &Numbering) -> usize {
        match self {
            Split::OneToFour => mesh.vertices() + numbering.edges(),
            Split::OneToN => mesh.vertices() + numbering.edges() + mesh.faces().len(),
            Split::Dual => mesh.twins().len(),
        }
    }

    /// Where a new point is born.
    pub fn birth(self, mesh: &HalfEdgeMesh, numbering: &Numbering, point: usize) -> Birth {
        let edges = mesh.vertices() + numbering.edges();
        match self {
            Split::Dual => Birth::Corner(point as u32),
            _ if point < mesh.vertices() => Birth::Vertex(mesh.vertex_edges()[point]),
            _ if point < edges => Birth::Edge(numbering.first_corners()[point - mesh.vertices()]),
            _ => Birth::Face(mesh.faces().range(point - edges).start as u32),
        }
    }

    /// The new faces, in the memory of `buffer` as far as it suffices.
    pub fn faces(self, mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
        let (faces, twins, vertices) = (mesh.faces(), mesh.twins(), mesh.vertices());
        match self {
            Split::OneToFour => one_to_four::faces(faces, twins, vertices, numbering, buffer),
            Split::OneToN => one_to_n::faces(faces, twins, vertices, numbering, buffer),
            Split::Dual => dual::faces(mesh, numbering, buffer),
        }
    }

    /// The new faces of a mesh that is needed for nothing else: what they are not made of is given back first.
    pub fn last_faces(self, mesh: HalfEdgeMesh, numbering: Numbering) -> Faces {
        if self == Split::Dual {
            return dual::faces(&mesh, &numbering, Vec::new());
        }
        let (vertices, numbering) = (mesh.vertices(), numbering.without_first_corners());
        let (faces, twins) = mesh.into_faces_and_twins();
        match self {
            Split::OneToFour => one_to_four::faces(&faces, &twins, vertices, &numbering, Vec::new()),
            _ => one_to_n::faces(&faces, &twins, vertices, &numbering, Vec::new()),
        }
    }

    /// The new mesh, from its faces.
    pub fn mesh(self, mesh: &HalfEdgeMesh, numbering: &Numbering, faces: Faces) -> HalfEdgeMesh {
        let (twin, leaving) = match self {
            Split::OneToFour => (one_to_four::twins(mesh), one_to_four::leaving(mesh, numbering)),
            Split::OneToN => (one_to_n::twins(mesh), one_to_n::leaving(mesh, numbering)),
            Split::Dual => dual::twins_and_leaving(mesh, numbering, &faces),
        };
        HalfEdgeMesh::from_parts(faces, twin, leaving)
    }

    /// The tags of the new mesh: an edge's two children have one step less of its sharpness, corners stay. A dual split has
    /// no creases.
    pub fn tags(self, mesh: &HalfEdgeMesh, tags: &Tags, new: &HalfEdgeMesh) -> Tags {
        let children: fn(&HalfEdgeMesh, u32) -> [u32; 2] = match self {
            Split::OneToFour => one_to_four::edge_children,
            Split::OneToN => one_to_n::edge_children,
            Split::Dual => return Tags::default(),
        };
        let lasting = tags.creases().iter().filter(|(_, sharpness)| *sharpness > 1.0);
        let sharp = lasting.flat_map(|(edge, sharpness)| children(mesh, *edge).map(|child| (child, sharpness - 1.0)));
        Tags::of_children(new, sharp.collect(), tags.corners().to_vec())
    }
}

/// Room for this many numbers: the buffer, or fresh memory whose pages nobody has touched yet.
fn room(mut buffer: Vec<u32>, length: usize) -> Vec<u32> {
    if buffer.capacity() < length {
        return vec![0; length];
    }
    buffer.resize(length, 0);
    buffer
}

/// What `f` makes of a half-edge, but [`NONE`] of none.
fn some(half_edge: u32, f: impl FnOnce(u32) -> u32) -> u32 {
    if half_edge == NONE { NONE } else { f(half_edge) }
}

/// Faces are dealt out to threads in runs of this many. A tuning: small enough to share, large enough to be worth it.
const RUN: usize = 4096;
