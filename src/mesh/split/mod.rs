//! How does a step make new faces out of old ones?
//!
//! Each split in a file of its own: which points are born, which faces they make, and, for those of the most used schemes, which
//! half-edges are twins. All is arithmetic on corners; the only thing looked up is the number of an edge. Old vertices come first, then the
//! points of edges, in the order of their first corners, then those of faces.

mod cut;
mod dual;
mod faces_to_vertices;
mod mid_edge;
mod numbering;
mod one_to_four;
mod one_to_n;
mod sqrt2;
mod sqrt3;

pub use numbering::Numbering;

use super::half_edge::NONE;
use super::{Connectivity, Faces, HalfEdgeMesh, MAX_CORNERS, NotAMesh, Tags};

/// The splits that there is topology for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    /// Each triangle into four, by new points on its edges.
    OneToFour,
    /// Each polygon into quads, by new points on its edges and in its middle.
    OneToN,
    /// A new point for each corner of each face; faces, edges and vertices become faces. The boundary recedes.
    Dual,
    /// A new point in each triangle, edges inside the mesh flipped; edges of the boundary stay.
    Sqrt3,
    /// The same after such a step: each edge of the boundary is cut into three, and its triangle has no new point.
    Sqrt3Thirds,
    /// A new point in each face, edges inside the mesh become quads; edges of the boundary stay.
    Sqrt2,
    /// The same after such a step: each edge of the boundary is halved, and its triangle has no new point.
    Sqrt2Halves,
    /// A new point on each edge; faces and vertices become faces. The boundary recedes.
    MidEdge,
    /// A new point in each face; vertices become faces: the dual mesh. The boundary recedes.
    FacesToVertices,
    /// The mesh as it is.
    Keep,
}

/// A vertex or a face, as they turn into each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Centre {
    /// A vertex.
    Vertex(u32),
    /// A face.
    Face(u32),
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
    /// At the vertex that this half-edge leaves, which stays where it is.
    Kept(u32),
    /// On an edge of the boundary, at the third that is nearer to the vertex that this half-edge leaves.
    Third(u32),
}

impl Birth {
    /// The half-edge that tells the place.
    pub fn half_edge(self) -> u32 {
        match self {
            Birth::Vertex(edge) | Birth::Edge(edge) | Birth::Face(edge) => edge,
            Birth::Corner(edge) | Birth::Kept(edge) | Birth::Third(edge) => edge,
        }
    }
}

impl Split {
    /// Every split with its name in scheme files.
    pub const NAMED: [(&'static str, Split); 8] = [
        ("1-to-4", Split::OneToFour),
        ("1-to-n", Split::OneToN),
        ("dual", Split::Dual),
        ("sqrt3", Split::Sqrt3),
        ("sqrt2", Split::Sqrt2),
        ("mid-edge", Split::MidEdge),
        ("faces-to-vertices", Split::FacesToVertices),
        ("keep", Split::Keep),
    ];

    /// The split of this name in scheme files.
    pub fn named(name: &str) -> Option<Split> {
        Split::NAMED.iter().find(|(own, _)| *own == name).map(|(_, split)| *split)
    }

    /// Whether a vertex inside the mesh becomes a face.
    pub fn makes_faces_of_vertices(self) -> bool {
        matches!(self, Split::Dual | Split::MidEdge | Split::FacesToVertices)
    }

    /// The split of a step on a mesh with these tags.
    pub fn at(self, tags: &Tags) -> Split {
        match self {
            Split::Sqrt3 if tags.are_turned() => Split::Sqrt3Thirds,
            Split::Sqrt2 if tags.are_turned() => Split::Sqrt2Halves,
            _ => self,
        }
    }

    /// Whether the boundary recedes; under other splits it is refined by rules of its own.
    pub fn recedes(self) -> bool {
        matches!(self, Split::Dual | Split::MidEdge | Split::FacesToVertices)
    }

    /// Whether edges are halved or stay in every step, so that there can be creases inside a mesh.
    pub fn keeps_edges(self) -> bool {
        matches!(self, Split::OneToFour | Split::OneToN | Split::Keep)
    }

    /// Whether it turns the lattice and keeps the boundary's edges, which are cut in every second step.
    pub fn cuts_in_turns(self) -> bool {
        matches!(self, Split::Sqrt3 | Split::Sqrt3Thirds | Split::Sqrt2 | Split::Sqrt2Halves)
    }

    /// The number of corners of the new mesh.
    ///
    /// # Errors
    /// When 32 bits don't number them.
    pub fn new_corners(self, mesh: &HalfEdgeMesh) -> Result<usize, NotAMesh> {
        let old = mesh.twins().len();
        let corners = match self {
            Split::OneToFour | Split::OneToN => old.checked_mul(4),
            Split::Dual => dual::new_corners(mesh),
            Split::Sqrt3 | Split::Sqrt3Thirds => old.checked_mul(3),
            Split::Sqrt2 | Split::Sqrt2Halves | Split::MidEdge => old.checked_mul(2),
            Split::FacesToVertices | Split::Keep => Some(old),
        };
        corners.filter(|corners| *corners <= MAX_CORNERS).ok_or(NotAMesh::TooLarge)
    }

    /// The edges' numbers, in the memory of a numbering that is done with, and what is kept near a receding boundary.
    pub fn numbering(self, mesh: &HalfEdgeMesh, old: Numbering) -> Numbering {
        let numbering = Numbering::in_buffers(mesh, old);
        match self {
            Split::FacesToVertices if !mesh.is_closed() => numbering.keeping(faces_to_vertices::kept_faces(mesh)),
            Split::MidEdge if !mesh.is_closed() => {
                let parting = mid_edge::parting_edges(mesh, &numbering);
                numbering.keeping(parting)
            }
            Split::Sqrt3Thirds | Split::Sqrt2Halves => cut::numbering(mesh, numbering),
            _ => numbering,
        }
    }

    /// The number of points of the new mesh.
    pub fn new_vertices(self, mesh: &HalfEdgeMesh, numbering: &Numbering) -> usize {
        let kept = |all: usize| numbering.kept().map_or(all, <[u32]>::len);
        match self {
            Split::OneToFour => mesh.vertices() + numbering.edges(),
            Split::OneToN => mesh.vertices() + numbering.edges() + mesh.faces().len(),
            Split::Dual => mesh.twins().len(),
            Split::Sqrt3 | Split::Sqrt2 => mesh.vertices() + mesh.faces().len(),
            Split::Sqrt3Thirds => mesh.vertices() + kept(mesh.faces().len()) + 2 * numbering.cut().len(),
            Split::Sqrt2Halves => mesh.vertices() + kept(mesh.faces().len()) + numbering.cut().len(),
            Split::MidEdge => numbering.edges() + numbering.kept().map_or(0, <[u32]>::len),
            Split::FacesToVertices => kept(mesh.faces().len()),
            Split::Keep => mesh.vertices(),
        }
    }

    /// Where a new point is born.
    pub fn birth(self, mesh: &HalfEdgeMesh, numbering: &Numbering, point: usize) -> Birth {
        let kept = |index: usize| numbering.kept().map_or(index, |kept| kept[index] as usize);
        let vertex = |vertex: usize| Birth::Vertex(mesh.vertex_edges()[vertex]);
        let face = |face: usize| Birth::Face(mesh.faces().range(face).start as u32);
        let edges = mesh.vertices() + numbering.edges();
        match self {
            Split::Dual => Birth::Corner(point as u32),
            Split::MidEdge => {
                let edge = point.checked_sub(numbering.edges()).map_or(point, kept);
                Birth::Edge(numbering.first_corners()[edge])
            }
            Split::FacesToVertices => face(kept(point)),
            Split::Sqrt3 | Split::Sqrt2 if point < mesh.vertices() => cut::vertex(mesh, point),
            _ if point < mesh.vertices() => vertex(point),
            Split::Sqrt3 | Split::Sqrt2 => face(point - mesh.vertices()),
            Split::Sqrt3Thirds => match cut::place(mesh, numbering, point - mesh.vertices(), 2) {
                Ok(in_face) => in_face,
                Err((h, 0)) => Birth::Third(h),
                Err((h, _)) => Birth::Third(mesh.twin(h)),
            },
            Split::Sqrt2Halves => match cut::place(mesh, numbering, point - mesh.vertices(), 1) {
                Ok(in_face) => in_face,
                Err((h, _)) => Birth::Edge(h),
            },
            _ if point < edges => Birth::Edge(numbering.first_corners()[point - mesh.vertices()]),
            _ => face(point - edges),
        }
    }

    /// The new faces, in the memory of `buffer` as far as it suffices.
    pub fn faces(self, mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
        let (faces, twins, vertices) = (mesh.faces(), mesh.twins(), mesh.vertices());
        match self {
            Split::OneToFour => one_to_four::faces(faces, twins, vertices, numbering, buffer),
            Split::OneToN => one_to_n::faces(faces, twins, vertices, numbering, buffer),
            Split::Dual => dual::faces(mesh, numbering, buffer),
            Split::Sqrt3 => sqrt3::faces(mesh, buffer),
            Split::Sqrt3Thirds => sqrt3::faces_with_thirds(mesh, numbering, buffer),
            Split::Sqrt2 => sqrt2::faces(mesh, numbering, buffer),
            Split::Sqrt2Halves => sqrt2::faces_with_halves(mesh, numbering, buffer),
            Split::MidEdge => mid_edge::faces(mesh, numbering, buffer),
            Split::FacesToVertices => faces_to_vertices::faces(mesh, numbering, buffer),
            Split::Keep => faces.clone(),
        }
    }

    /// The new faces of a mesh that is needed for nothing else: what they are not made of is given back first.
    pub fn last_faces(self, mesh: HalfEdgeMesh, numbering: Numbering) -> Faces {
        if !matches!(self, Split::OneToFour | Split::OneToN) {
            return self.faces(&mesh, &numbering, Vec::new());
        }
        let (vertices, numbering) = (mesh.vertices(), numbering.without_first_corners());
        let (faces, twins) = mesh.into_faces_and_twins();
        match self {
            Split::OneToFour => one_to_four::faces(&faces, &twins, vertices, &numbering, Vec::new()),
            _ => one_to_n::faces(&faces, &twins, vertices, &numbering, Vec::new()),
        }
    }

    /// The new mesh, from its faces.
    ///
    /// # Errors
    /// Where a boundary that recedes leaves faces that hang together at a vertex only, or two faces on the same corners.
    pub fn mesh(self, mesh: &HalfEdgeMesh, numbering: &Numbering, faces: Faces) -> Result<HalfEdgeMesh, NotAMesh> {
        let (twin, leaving) = match self {
            Split::OneToFour => (one_to_four::twins(mesh), one_to_four::leaving(mesh, numbering)),
            Split::OneToN => (one_to_n::twins(mesh), one_to_n::leaving(mesh, numbering)),
            Split::Dual => dual::twins_and_leaving(mesh, numbering, &faces),
            Split::Keep => return Ok(mesh.clone()),
            _ => return HalfEdgeMesh::new(self.new_vertices(mesh, numbering), faces),
        };
        Ok(HalfEdgeMesh::from_parts(faces, twin, leaving))
    }

    /// The tags of the new mesh: an edge's two children have one step less of its sharpness, corners stay. Splits that turn the lattice have
    /// corners alone, those under which the boundary recedes neither.
    pub fn tags(self, mesh: &HalfEdgeMesh, tags: &Tags, new: &HalfEdgeMesh) -> Tags {
        let children: fn(&HalfEdgeMesh, u32) -> [u32; 2] = match self {
            Split::OneToFour => one_to_four::edge_children,
            Split::OneToN => one_to_n::edge_children,
            Split::Keep => return tags.clone(),
            _ if self.cuts_in_turns() => return tags.turned(!mesh.is_closed()),
            _ => return Tags::default(),
        };
        let lasting = tags.creases().iter().filter(|(_, sharpness)| *sharpness > 1.0);
        let sharp = lasting.flat_map(|(edge, sharpness)| children(mesh, *edge).map(|child| (child, sharpness - 1.0)));
        Tags::of_children(new, sharp.collect(), tags.corners().to_vec())
    }

    /// What becomes of a vertex or face inside a mesh; nothing of a triangle under 1-to-4 and sqrt3 splits, and of what a receding
    /// boundary takes away.
    pub fn becoming(self, mesh: &HalfEdgeMesh) -> Becoming {
        let closed = mesh.is_closed();
        let inside = |vertex: &u32| mesh.twins()[mesh.vertex_edges()[*vertex as usize] as usize] != NONE;
        let of_vertices = (!closed && self.makes_faces_of_vertices())
            .then(|| places((0..mesh.vertices() as u32).filter(inside).collect(), mesh.vertices()));
        let kept = match self {
            Split::Sqrt2Halves => Some(places(cut::kept_faces(mesh), mesh.faces().len())),
            Split::FacesToVertices if !closed => Some(places(faces_to_vertices::kept_faces(mesh), mesh.faces().len())),
            _ => None,
        };
        let offset = match self {
            Split::Sqrt2 | Split::Sqrt2Halves => mesh.vertices(),
            Split::OneToN => mesh.vertices() + mesh.edge_count(),
            Split::Dual => mesh.faces().len() + mesh.edges().filter(|h| mesh.twins()[*h as usize] != NONE).count(),
            Split::MidEdge => mesh.faces().len(),
            _ => 0,
        };
        Becoming { split: self, offset: offset as u32, of_vertices, kept }
    }
}

/// Where each of some numbers stands in a list; [`NONE`] for those that are not in it.
fn places(list: Vec<u32>, count: usize) -> Vec<u32> {
    let mut at = vec![NONE; count];
    list.iter().enumerate().for_each(|(index, number)| at[*number as usize] = index as u32);
    at
}

/// What becomes of the vertices and faces of one mesh under a split.
pub struct Becoming {
    split: Split,
    /// Where the points of faces, or the faces of vertices, start.
    offset: u32,
    /// The number of each vertex among those inside the mesh, where not all are.
    of_vertices: Option<Vec<u32>>,
    /// The number of each face among those that are kept, where not all are.
    kept: Option<Vec<u32>>,
}

impl Becoming {
    /// What one becomes; `None` where nothing does.
    pub fn of(&self, centre: Centre) -> Option<Centre> {
        let among = |list: &Option<Vec<u32>>, number: u32| match list {
            Some(list) => Some(list[number as usize]).filter(|at| *at != NONE),
            None => Some(number),
        };
        match (self.split, centre) {
            (Split::Keep, _) | (Split::Dual | Split::MidEdge, Centre::Face(_)) => Some(centre),
            (Split::OneToFour | Split::Sqrt3 | Split::Sqrt3Thirds, Centre::Face(_)) => None,
            (Split::OneToN | Split::Sqrt2 | Split::Sqrt2Halves, Centre::Face(face)) => {
                among(&self.kept, face).map(|at| Centre::Vertex(self.offset + at))
            }
            (Split::FacesToVertices, Centre::Face(face)) => among(&self.kept, face).map(Centre::Vertex),
            (Split::Dual | Split::MidEdge | Split::FacesToVertices, Centre::Vertex(vertex)) => {
                Some(Centre::Face(self.offset + among(&self.of_vertices, vertex)?))
            }
            (_, Centre::Vertex(_)) => Some(centre),
        }
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
