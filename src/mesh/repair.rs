//! How do polygons become a mesh?
//!
//! By cutting: an edge with more than two faces, or with two that run along it in the same direction, is cut apart, and a vertex
//! whose faces are not one fan gets a copy for each fan. Surfaces keep their places and come apart where they only touched.

use super::half_edge::NONE;
use super::pairing::{self, NotAMesh, edge_groups, fan, opposed};
use super::{Crease, Faces, PolygonSoup};
use std::collections::{HashMap, HashSet};

/// What was cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repair {
    /// Edges with more than two faces, or with two in the same direction.
    pub edges_cut: usize,
    /// Vertices with more than one fan of faces, once those edges are cut.
    pub vertices_split: usize,
}

/// What was dropped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dropped {
    /// Vertices without a face.
    pub vertices: usize,
    /// Creases and corners at these.
    pub tags: usize,
}

/// Cuts polygons apart until they make a mesh, isolated vertices aside ([`drop_isolated`]).
///
/// Every half-edge of a bad edge becomes boundary; where two of them, in opposite directions, still have both of their ends in
/// common once the vertices are split, they are an edge again. Of the fans of a vertex the first, in order of the faces, keeps
/// its index; copies come after all vertices that were there. Creases follow their edges, and copies of corners are corners.
///
/// # Errors
/// A face that no cut can mend: with fewer than three corners, with a corner twice, or with one that is no vertex.
pub fn split_non_manifold(mut soup: PolygonSoup) -> Result<(PolygonSoup, Repair), NotAMesh> {
    pairing::check(soup.positions.len(), &soup.faces)?;
    let vertices = soup.positions.len();
    let (twin, edges_cut) = cut(vertices, &soup.faces);
    let split = split(vertices, &soup.faces, &twin);
    let vertices_split = split.vertices_split();
    soup.creases = creases(&soup, &split.corners);
    soup.corners = corners(&soup.corners, &split.originals, vertices);
    soup.positions.extend(split.originals.iter().map(|vertex| soup.positions[*vertex as usize]).collect::<Vec<_>>());
    soup.faces = with_corners(&soup.faces, split.corners);
    Ok((soup, Repair { edges_cut, vertices_split }))
}

/// The twins of a mesh whose bad edges are cut, and how many there were.
fn cut(vertices: usize, faces: &Faces) -> (Vec<u32>, usize) {
    let mut twin = vec![NONE; faces.corners().len()];
    let mut edges_cut = 0;
    edge_groups(vertices, faces, |_, group| match group {
        [_] => {}
        [a, b] if opposed(faces, *a, *b) => {
            twin[*a as usize] = *b;
            twin[*b as usize] = *a;
        }
        _ => edges_cut += 1,
    });
    (twin, edges_cut)
}

/// Vertices, a copy for each fan after the first.
struct Split {
    /// The vertex of each corner.
    corners: Vec<u32>,
    /// Of each copy the vertex that it is a copy of.
    originals: Vec<u32>,
}

impl Split {
    fn vertices_split(&self) -> usize {
        let mut originals = self.originals.clone();
        originals.sort_unstable();
        originals.dedup();
        originals.len()
    }
}

fn split(vertices: usize, faces: &Faces, twin: &[u32]) -> Split {
    let mut taken = vec![false; vertices];
    let mut split = Split { corners: vec![NONE; faces.corners().len()], originals: Vec::new() };
    for (corner, vertex) in faces.corners().iter().enumerate() {
        if split.corners[corner] != NONE {
            continue;
        }
        let index = if taken[*vertex as usize] {
            split.originals.push(*vertex);
            (vertices + split.originals.len() - 1) as u32
        } else {
            *vertex
        };
        taken[*vertex as usize] = true;
        fan(faces, twin, first_of_fan(faces, twin, corner as u32)).for_each(|at| split.corners[at as usize] = index);
    }
    split
}

/// The clockwise end of a corner's fan, or the corner itself where the fan goes round.
fn first_of_fan(faces: &Faces, twin: &[u32], corner: u32) -> u32 {
    let mut at = corner;
    while twin[at as usize] != NONE {
        at = faces.next(twin[at as usize]);
        if at == corner {
            break;
        }
    }
    at
}

/// The creases, one for each edge that has come of theirs; one that is on no edge stays as it is.
fn creases(soup: &PolygonSoup, corners: &[u32]) -> Vec<Crease> {
    if soup.creases.is_empty() {
        return Vec::new();
    }
    let edges = edges_of(soup, corners);
    let follow = |crease: &Crease| match edges.get(&crease.ends) {
        Some(found) if !found.is_empty() => found.iter().map(|ends| Crease { ends: *ends, ..*crease }).collect(),
        _ => vec![*crease],
    };
    soup.creases.iter().flat_map(follow).collect()
}

/// For the ends of each crease the ends of the edges that have come of it, once the corners are these.
fn edges_of(soup: &PolygonSoup, corners: &[u32]) -> HashMap<[u32; 2], Vec<[u32; 2]>> {
    let mut edges: HashMap<_, Vec<_>> = soup.creases.iter().map(|crease| (crease.ends, Vec::new())).collect();
    for (at, vertex) in soup.faces.corners().iter().enumerate() {
        let next = soup.faces.next(at as u32) as usize;
        let (old, new) = ([*vertex, soup.faces.corners()[next]], [corners[at], corners[next]]);
        for (old, new) in [(old, new), ([old[1], old[0]], [new[1], new[0]])] {
            if let Some(found) = edges.get_mut(&old) {
                found.push(new);
            }
        }
    }
    for found in edges.values_mut() {
        found.sort_unstable();
        found.dedup();
    }
    edges
}

/// The corners, and the copies of corners after them.
fn corners(corners: &[u32], originals: &[u32], vertices: usize) -> Vec<u32> {
    let known: HashSet<u32> = corners.iter().copied().collect();
    let copies = originals.iter().enumerate().filter(|(_, original)| known.contains(original));
    corners.iter().copied().chain(copies.map(|(copy, _)| (vertices + copy) as u32)).collect()
}

/// The same faces on other vertices.
fn with_corners(faces: &Faces, corners: Vec<u32>) -> Faces {
    match faces.same_size() {
        Some(size) => Faces::same(size, corners),
        None => {
            let sizes: Vec<u32> = faces.iter().map(|face| face.len() as u32).collect();
            Faces::mixed(&sizes, corners)
        }
    }
}

/// Drops vertices without a face, and tags at them. The order of the others is kept.
///
/// # Errors
/// A corner of a face that is no vertex.
pub fn drop_isolated(soup: PolygonSoup) -> Result<(PolygonSoup, Dropped), NotAMesh> {
    let vertices = soup.positions.len();
    let mut used = vec![false; vertices];
    for (index, face) in soup.faces.iter().enumerate() {
        for corner in face {
            *used.get_mut(*corner as usize).ok_or(NotAMesh::Corner(index, *corner as usize))? = true;
        }
    }
    let renumbered = renumbered(&used);
    let new = |vertex: u32| renumbered.get(vertex as usize).copied().filter(|vertex| *vertex != NONE);
    let tags = soup.creases.len() + soup.corners.len();
    let follow = |crease: &Crease| Some(Crease { ends: [new(crease.ends[0])?, new(crease.ends[1])?], ..*crease });
    let creases: Vec<Crease> = soup.creases.iter().filter_map(follow).collect();
    let corners: Vec<u32> = soup.corners.iter().filter_map(|vertex| new(*vertex)).collect();
    let kept = soup.faces.corners().iter().map(|vertex| renumbered[*vertex as usize]).collect();
    let faces = with_corners(&soup.faces, kept);
    let mut used = used.into_iter();
    let mut positions = soup.positions;
    positions.retain(|_| used.next() == Some(true));
    let dropped = Dropped { vertices: vertices - positions.len(), tags: tags - creases.len() - corners.len() };
    Ok((PolygonSoup { positions, faces, creases, corners }, dropped))
}

/// The new index of each vertex that is used.
fn renumbered(used: &[bool]) -> Vec<u32> {
    let mut count = 0;
    let number = |used: &bool| {
        count += u32::from(*used);
        if *used { count - 1 } else { NONE }
    };
    used.iter().map(number).collect()
}
