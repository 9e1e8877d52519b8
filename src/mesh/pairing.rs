//! Which half-edges belong together, and what keeps polygons from being a mesh?
//!
//! Two half-edges are twins when they are all that runs between two vertices, in opposite directions. Then every vertex must be
//! one fan of faces. Work is O(H log H) for H corners, whatever the valences.

use super::Faces;
use super::half_edge::{MAX_CORNERS, NONE};
use std::fmt;

/// Why polygons don't make a mesh. Faces and vertices are counted from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotAMesh {
    /// A face with fewer than three corners, or with a corner twice.
    Face(usize),
    /// A corner that is not a vertex.
    Corner(usize, usize),
    /// Two faces on the same corners.
    Twice([usize; 2]),
    /// More than two faces at an edge.
    Edge {
        /// The edge's ends.
        ends: [usize; 2],
        /// Its faces.
        faces: Vec<usize>,
    },
    /// Two faces at an edge that run along it in the same direction.
    Orientation {
        /// The edge's ends.
        ends: [usize; 2],
        /// Its faces.
        faces: [usize; 2],
    },
    /// A vertex whose faces are not one fan.
    Vertex(usize),
    /// A vertex without a face.
    Isolated(usize),
    /// More corners than 32 bits number.
    TooLarge,
}

impl fmt::Display for NotAMesh {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotAMesh::Face(face) => write!(f, "face {face} has fewer than three corners, or a corner twice"),
            NotAMesh::Corner(face, corner) => write!(f, "face {face} has the corner {corner}, which is not a vertex"),
            NotAMesh::Twice([a, b]) => write!(f, "faces {a} and {b} have the same corners"),
            NotAMesh::Edge { ends: [a, b], faces } => {
                let list: Vec<String> = faces.iter().take(4).map(usize::to_string).collect();
                let more = if faces.len() > 4 { " and more" } else { "" };
                let (count, list) = (faces.len(), list.join(", "));
                write!(f, "the edge between vertices {a} and {b} has {count} faces ({list}{more}), not one or two")
            }
            NotAMesh::Orientation { ends: [a, b], faces: [first, second] } => write!(
                f,
                "faces {first} and {second} are oriented against each other: both run from vertex {a} to vertex {b}"
            ),
            NotAMesh::Vertex(vertex) => write!(f, "the faces around vertex {vertex} are not one fan"),
            NotAMesh::Isolated(vertex) => write!(f, "vertex {vertex} belongs to no face"),
            NotAMesh::TooLarge => write!(f, "the mesh has more than {MAX_CORNERS} corners of faces"),
        }
    }
}

impl std::error::Error for NotAMesh {}

/// Checks sizes and indices.
pub(super) fn check(vertices: usize, faces: &Faces) -> Result<(), NotAMesh> {
    if faces.corners().len() > MAX_CORNERS || vertices > MAX_CORNERS {
        return Err(NotAMesh::TooLarge);
    }
    let mut sorted = Vec::new();
    for (index, face) in faces.iter().enumerate() {
        if let Some(corner) = face.iter().find(|corner| **corner as usize >= vertices) {
            return Err(NotAMesh::Corner(index, *corner as usize));
        }
        if face.len() < 3 || repeats(face, &mut sorted) {
            return Err(NotAMesh::Face(index));
        }
    }
    Ok(())
}

/// Whether a face has a corner twice. Its corners are sorted in `sorted`.
pub(super) fn repeats(face: &[u32], sorted: &mut Vec<u32>) -> bool {
    if let [a, b, c] = face {
        return a == b || b == c || c == a;
    }
    sorted.clear();
    sorted.extend_from_slice(face);
    sorted.sort_unstable();
    sorted.windows(2).any(|pair| pair[0] == pair[1])
}

/// The half-edges between the same two vertices, group by group.
pub(super) fn edge_groups(vertices: usize, faces: &Faces, mut visit: impl FnMut([u32; 2], &[u32])) {
    let corners = faces.corners();
    let ends = |h: u32| {
        let (a, b) = (corners[h as usize], corners[faces.next(h) as usize]);
        [a.min(b), a.max(b)]
    };
    // by the lower end: a counting sort; then by the upper one, within each bucket
    let mut starts = vec![0_u32; vertices + 1];
    for h in 0..corners.len() as u32 {
        starts[ends(h)[0] as usize + 1] += 1;
    }
    for vertex in 0..vertices {
        starts[vertex + 1] += starts[vertex];
    }
    let mut filled = starts.clone();
    let mut sorted = vec![(0_u32, 0_u32); corners.len()];
    for h in 0..corners.len() as u32 {
        let [low, high] = ends(h);
        sorted[filled[low as usize] as usize] = (high, h);
        filled[low as usize] += 1;
    }
    let mut group = Vec::new();
    for low in 0..vertices {
        let bucket = &mut sorted[starts[low] as usize..starts[low + 1] as usize];
        bucket.sort_unstable();
        for same in bucket.chunk_by(|a, b| a.0 == b.0) {
            group.clear();
            group.extend(same.iter().map(|(_, h)| *h));
            visit([low as u32, same[0].0], &group);
        }
    }
}

/// Whether two half-edges run in opposite directions.
pub(super) fn opposed(faces: &Faces, a: u32, b: u32) -> bool {
    faces.corners()[a as usize] != faces.corners()[b as usize]
}

/// The twin of each corner.
pub(super) fn twins(vertices: usize, faces: &Faces) -> Result<Vec<u32>, NotAMesh> {
    let mut twin = vec![NONE; faces.corners().len()];
    let mut wrong = None;
    edge_groups(vertices, faces, |ends, group| match group {
        [_] => {}
        [a, b] if opposed(faces, *a, *b) => {
            twin[*a as usize] = *b;
            twin[*b as usize] = *a;
        }
        _ if wrong.is_none() => wrong = Some(fault(faces, ends, group)),
        _ => {}
    });
    wrong.map_or(Ok(twin), Err)
}

/// What is wrong with the half-edges between two vertices.
fn fault(faces: &Faces, ends: [u32; 2], group: &[u32]) -> NotAMesh {
    let at: Vec<usize> = group.iter().map(|h| faces.face_of(*h) as usize).collect();
    let sorted = |face: usize| {
        let mut corners = faces.face(face).to_vec();
        corners.sort_unstable();
        corners
    };
    for (index, face) in at.iter().enumerate() {
        if let Some(other) = at[..index].iter().find(|other| sorted(**other) == sorted(*face)) {
            return NotAMesh::Twice([*other, *face]);
        }
    }
    if let [first, second] = at[..] {
        let a = faces.corners()[group[0] as usize] as usize;
        let b = faces.corners()[faces.next(group[0]) as usize] as usize;
        return NotAMesh::Orientation { ends: [a, b], faces: [first, second] };
    }
    NotAMesh::Edge { ends: ends.map(|end| end as usize), faces: at }
}

/// A corner that leaves each vertex, the first of its fan where it lies on the boundary; and whether each vertex is one fan.
pub(super) fn leaving(vertices: usize, faces: &Faces, twin: &[u32]) -> Result<Vec<u32>, NotAMesh> {
    let corners = faces.corners();
    let mut leaving = vec![NONE; vertices];
    let mut degree = vec![0_u32; vertices];
    for (h, vertex) in corners.iter().enumerate() {
        degree[*vertex as usize] += 1;
        let first = &mut leaving[*vertex as usize];
        if *first == NONE || twin[h] == NONE {
            *first = h as u32;
        }
    }
    for (vertex, first) in leaving.iter().enumerate() {
        if *first == NONE {
            return Err(NotAMesh::Isolated(vertex));
        }
        if fan(faces, twin, *first).count() != degree[vertex] as usize {
            return Err(NotAMesh::Vertex(vertex));
        }
    }
    Ok(leaving)
}

/// The corners around a vertex, counter-clockwise from one, until the boundary or the first again.
pub(super) fn fan<'a>(faces: &'a Faces, twin: &'a [u32], first: u32) -> impl Iterator<Item = u32> + 'a {
    std::iter::successors(Some(first), move |at| {
        let next = twin[faces.prev(*at) as usize];
        (next != NONE && next != first).then_some(next)
    })
}
