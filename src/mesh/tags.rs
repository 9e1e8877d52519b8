//! Which edges of a mesh are creases, and which vertices are corners?
//!
//! A crease has a sharpness: the number of steps that it lasts. An edge of sharpness s is sharp for s >= 1, and for a
//! fraction s in between the mean of sharp and smooth, s to 1 - s; its children have s - 1 (DeRose, Kass and Truong 1998).

use super::half_edge::NONE;
use super::{Connectivity, Crease, HalfEdgeMesh};

/// Creases and corners of a mesh. The boundary is always sharp, and not listed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tags {
    /// The first corner of each crease edge with its sharpness, in order.
    sharp: Vec<(u32, f64)>,
    /// The vertices that are corners, in order.
    corners: Vec<u32>,
    /// Whether a split has turned the lattice and left the boundary's edges whole, so that the next one cuts them.
    turned: bool,
}

/// Why a tag fits no place of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum BadTag {
    /// No edge runs between these vertices.
    NoEdge([u32; 2]),
    /// A vertex that does not exist.
    NoVertex(u32),
}

impl std::fmt::Display for BadTag {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            BadTag::NoEdge([a, b]) => {
                write!(f, "no edge runs between vertices {a} and {b}, which are tagged as a crease")
            }
            BadTag::NoVertex(vertex) => write!(f, "vertex {vertex} is tagged as a corner, but does not exist"),
        }
    }
}

impl std::error::Error for BadTag {}

impl Tags {
    /// The tags of a mesh, from edges given by their ends and from vertices. Of an edge told twice the last word counts;
    /// a sharpness of 0 or less is none,
    /// and a boundary edge is sharp with or without a tag.
    ///
    /// # Errors
    /// A tag that names no edge or vertex of the mesh.
    pub fn new(mesh: &HalfEdgeMesh, creases: &[Crease], corners: &[u32]) -> Result<Tags, BadTag> {
        let mut tags = Tags::default();
        for crease in creases {
            let edge = edge_between(mesh, crease.ends).ok_or(BadTag::NoEdge(crease.ends))?;
            if !mesh.is_sharp(edge) {
                tags.sharp.push((first_corner(mesh, edge), crease.sharpness));
            }
        }
        if let Some(vertex) = corners.iter().find(|vertex| **vertex as usize >= mesh.vertices()) {
            return Err(BadTag::NoVertex(*vertex));
        }
        tags.corners = corners.to_vec();
        Ok(tags.in_order())
    }

    /// From crease edges, told by any of their corners, and vertices.
    pub(super) fn of_children(mesh: &HalfEdgeMesh, sharp: Vec<(u32, f64)>, corners: Vec<u32>) -> Tags {
        let sharp = sharp.into_iter().map(|(edge, sharpness)| (first_corner(mesh, edge), sharpness)).collect();
        Tags { sharp, corners, turned: false }.in_order()
    }

    fn in_order(mut self) -> Tags {
        self.sharp.reverse();
        self.sharp.sort_by_key(|(edge, _)| *edge);
        self.sharp.dedup_by_key(|(edge, _)| *edge);
        self.sharp.retain(|(_, sharpness)| *sharpness > 0.0);
        self.corners.sort_unstable();
        self.corners.dedup();
        self
    }

    /// These tags, with the vertices of one face on the boundary as corners too.
    pub fn with_boundary_corners(mut self, mesh: &HalfEdgeMesh) -> Tags {
        let one_face =
            |h: &u32| mesh.twins()[*h as usize] == NONE && mesh.twins()[mesh.faces().prev(*h) as usize] == NONE;
        let corners = mesh.vertex_edges().iter().enumerate().filter(|(_, h)| one_face(h));
        self.corners.extend(corners.map(|(vertex, _)| vertex as u32));
        self.in_order()
    }

    /// The corners after a split that turns the lattice, or turns it back; `has_boundary` says whether there is anything to be cut.
    pub(super) fn turned(&self, has_boundary: bool) -> Tags {
        Tags { sharp: Vec::new(), corners: self.corners.clone(), turned: has_boundary && !self.turned }
    }

    /// Whether a split has turned the lattice and left the boundary's edges whole, so that the next one cuts them.
    pub fn are_turned(&self) -> bool {
        self.turned
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.sharp.is_empty() && self.corners.is_empty()
    }

    /// The crease edges, by their first corner, each with its sharpness.
    pub fn creases(&self) -> &[(u32, f64)] {
        &self.sharp
    }

    /// The vertices that are corners.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// The largest sharpness that is not infinite; 0 where there is none.
    pub fn most_steps(&self) -> f64 {
        self.sharp.iter().map(|(_, sharpness)| *sharpness).filter(|s| s.is_finite()).fold(0.0, f64::max)
    }

    /// The sharpness of an edge inside the mesh, told by its first corner; 0 where it is no crease.
    pub fn sharpness(&self, first_corner: u32) -> f64 {
        self.sharp.binary_search_by_key(&first_corner, |(edge, _)| *edge).map_or(0.0, |at| self.sharp[at].1)
    }
}

/// The half-edge from one vertex to another.
pub fn edge_between(mesh: &HalfEdgeMesh, [a, b]: [u32; 2]) -> Option<u32> {
    let start = *mesh.vertex_edges().get(a as usize)?;
    mesh.around_vertex(start).into_iter().find(|edge| mesh.target(*edge) == b)
}

/// The first corner of an edge.
pub fn first_corner(mesh: &HalfEdgeMesh, edge: u32) -> u32 {
    edge.min(mesh.twin(edge))
}

/// A mesh seen with its tags: edges beyond a sharpness are creases. A fraction of a step needs two views: beyond 0 and
/// beyond 1.
#[derive(Clone, Copy, Debug)]
pub struct Tagged<'a> {
    /// The mesh.
    pub mesh: &'a HalfEdgeMesh,
    /// Its tags.
    pub tags: &'a Tags,
    /// An edge is a crease where its sharpness is larger.
    pub beyond: f64,
}

impl Connectivity for Tagged<'_> {
    type Edge = u32;
    type Point = u32;

    fn twin(&self, edge: u32) -> u32 {
        self.mesh.twin(edge)
    }

    fn turn(&self, edge: u32) -> u32 {
        self.mesh.turn(edge)
    }

    fn turn_back(&self, edge: u32) -> u32 {
        self.mesh.turn_back(edge)
    }

    fn origin(&self, edge: u32) -> u32 {
        self.mesh.origin(edge)
    }

    fn has_face(&self, edge: u32) -> bool {
        self.mesh.has_face(edge)
    }

    fn next(&self, edge: u32) -> u32 {
        self.mesh.next(edge)
    }

    fn prev(&self, edge: u32) -> u32 {
        self.mesh.prev(edge)
    }

    fn is_sharp(&self, edge: u32) -> bool {
        self.mesh.is_sharp(edge) || self.tags.sharpness(first_corner(self.mesh, edge)) > self.beyond
    }

    fn is_corner(&self, edge: u32) -> bool {
        self.tags.corners.binary_search(&self.mesh.origin(edge)).is_ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_are_found_on_their_edges() {
        let faces = [vec![0, 1, 2], vec![0, 2, 3]];
        let mesh = HalfEdgeMesh::from_faces(4, &faces).unwrap();
        let crease = Crease { ends: [2, 0], sharpness: 1.5 };
        let tags = Tags::new(&mesh, &[crease], &[1]).unwrap();
        let edge = edge_between(&mesh, [0, 2]).unwrap();
        let sharp = |beyond: f64| Tagged { mesh: &mesh, tags: &tags, beyond }.is_sharp(edge);
        assert!(sharp(0.0) && sharp(1.0) && !sharp(1.5));
        assert_eq!(tags.most_steps(), 1.5);
        let outer = Crease { ends: [0, 1], sharpness: 3.0 };
        assert!(Tags::new(&mesh, &[outer], &[]).unwrap().is_empty(), "the boundary needs no tag");
        let cornered = tags.with_boundary_corners(&mesh);
        assert_eq!(cornered.corners(), [1, 3]);
        assert_eq!(Tags::new(&mesh, &[Crease { ends: [1, 3], sharpness: 1.0 }], &[]), Err(BadTag::NoEdge([1, 3])));
        assert_eq!(Tags::new(&mesh, &[], &[4]), Err(BadTag::NoVertex(4)));
    }
}
