//! How are points made fast where rules are compact?
//!
//! A compact rule gives one weight to a whole class of neighbours, so that a new point is one sum over the ring of its birth
//! place: a gather, with the weights of a valence from a table. Sums are taken in the order of the ring, whatever the number of threads.
//! Points whose surroundings are not plain (boundary, creases, valences beyond the table) are left to the general route.

use crate::mesh::{HalfEdgeMesh, NONE, Numbering};
use rayon::prelude::*;

/// A coordinate: f32 or f64.
pub trait Coordinate:
    Copy
    + Default
    + Send
    + Sync
    + PartialEq
    + std::fmt::Debug
    + std::ops::Add<Output = Self>
    + std::ops::Mul<Output = Self>
    + 'static
{
    /// The nearest number of this kind.
    fn from_f64(value: f64) -> Self;
    /// The same number.
    fn to_f64(self) -> f64;
}

impl Coordinate for f32 {
    fn from_f64(value: f64) -> f32 {
        value as f32
    }

    fn to_f64(self) -> f64 {
        self.into()
    }
}

impl Coordinate for f64 {
    fn from_f64(value: f64) -> f64 {
        value
    }

    fn to_f64(self) -> f64 {
        self
    }
}

/// A point or a vector.
pub type Point<T> = [T; 3];

#[inline(always)]
fn plus<T: Coordinate>(a: Point<T>, b: Point<T>) -> Point<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
fn times<T: Coordinate>(a: Point<T>, weight: T) -> Point<T> {
    [a[0] * weight, a[1] * weight, a[2] * weight]
}

/// The weights of a vertex rule at one valence: of the vertex, of each edge neighbour, of each vertex across a quad, of each
/// new face point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct AtVertex<T> {
    pub(super) centre: T,
    pub(super) ring: T,
    pub(super) diagonals: T,
    pub(super) faces: T,
}

/// The weights of an edge rule: of each end, of each vertex across a triangle, of the other vertices of each quad, of each new
/// face point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct AtEdge<T> {
    pub(super) ends: T,
    pub(super) opposite: T,
    pub(super) sides: T,
    pub(super) faces: T,
}

/// Which of the weights are not zero, as constants that the compiler sees.
macro_rules! with_parts {
    ($a:expr, $b:expr, $f:ident, $($args:expr),*) => {
        match ($a, $b) {
            (false, false) => $f::<T, false, false>($($args),*),
            (true, false) => $f::<T, true, false>($($args),*),
            (false, true) => $f::<T, false, true>($($args),*),
            (true, true) => $f::<T, true, true>($($args),*),
        }
    };
}

/// The points of faces: the mean of each face's corners with one weight each, by the number of corners.
pub(super) fn face_points<T: Coordinate>(
    mesh: &HalfEdgeMesh,
    positions: &[Point<T>],
    weights: &[Option<T>],
    new: &mut [Point<T>],
) {
    let zero = [T::default(); 3];
    let sum = |face: &[u32]| face.iter().fold(zero, |sum, vertex| plus(sum, positions[*vertex as usize]));
    let point = |face: &[u32]| times(sum(face), weights.get(face.len()).copied().flatten().unwrap_or_default());
    new.par_iter_mut().enumerate().with_min_len(1024).for_each(|(face, new)| *new = point(mesh.faces().face(face)));
}

/// The points of edges inside the mesh.
pub(super) fn edge_points<T: Coordinate>(
    mesh: &HalfEdgeMesh,
    numbering: &Numbering,
    positions: &[Point<T>],
    new_faces: &[Point<T>],
    weights: &AtEdge<T>,
    new: &mut [Point<T>],
) {
    let zero = T::default();
    if mesh.faces().same_size() == Some(3) && weights.sides == zero && weights.faces == zero {
        return triangle_edges(mesh, numbering, positions, weights, new);
    }
    let (faces, twins) = (mesh.faces(), mesh.twins());
    let (corners, at) = (faces.corners(), |h: u32| positions[faces.corners()[h as usize] as usize]);
    let point = |h: u32| {
        let twin = twins[h as usize];
        if twin == NONE {
            return [zero; 3];
        }
        let ends = plus(positions[corners[h as usize] as usize], positions[corners[twin as usize] as usize]);
        let mut point = times(ends, weights.ends);
        if weights.faces != zero {
            let in_faces = plus(new_faces[faces.face_of(h) as usize], new_faces[faces.face_of(twin) as usize]);
            point = plus(point, times(in_faces, weights.faces));
        }
        if weights.opposite != zero {
            point = plus(point, times(plus(at(faces.prev(h)), at(faces.prev(twin))), weights.opposite));
        }
        if weights.sides != zero {
            let side = |h: u32| plus(at(faces.next(faces.next(h))), at(faces.prev(h)));
            point = plus(point, times(plus(side(h), side(twin)), weights.sides));
        }
        point
    };
    new.par_iter_mut().zip(numbering.first_corners()).with_min_len(1024).for_each(|(new, h)| *new = point(*h));
}

fn triangle_edges<T: Coordinate>(
    mesh: &HalfEdgeMesh,
    numbering: &Numbering,
    positions: &[Point<T>],
    weights: &AtEdge<T>,
    new: &mut [Point<T>],
) {
    let twins = mesh.twins();
    let triangles = mesh.faces().corners().as_chunks::<3>().0;
    let point = |h: u32| {
        let twin = twins[h as usize];
        if twin == NONE {
            return [T::default(); 3];
        }
        let (face, other) = (h / 3, twin / 3);
        let (own, beyond) = (&triangles[face as usize], &triangles[other as usize]);
        let (c, d) = ((h - 3 * face) as usize, (twin - 3 * other) as usize);
        let before = |c: usize| if c == 0 { 2 } else { c - 1 };
        let ends = plus(positions[own[c] as usize], positions[beyond[d] as usize]);
        let across = plus(positions[own[before(c)] as usize], positions[beyond[before(d)] as usize]);
        plus(times(ends, weights.ends), times(across, weights.opposite))
    };
    new.par_iter_mut().zip(numbering.first_corners()).with_min_len(1024).for_each(|(new, h)| *new = point(*h));
}

/// The points of vertices inside the mesh, by a table of weights by valence. Gives the vertices whose valence has none.
pub(super) fn vertex_points<T: Coordinate>(
    mesh: &HalfEdgeMesh,
    positions: &[Point<T>],
    new_faces: &[Point<T>],
    table: &[Option<AtVertex<T>>],
    new: &mut [Point<T>],
) -> Vec<u32> {
    let zero = T::default();
    let any = |part: fn(&AtVertex<T>) -> T| table.iter().flatten().any(|weights| part(weights) != zero);
    let (diagonals, faces) = (any(|w| w.diagonals), any(|w| w.faces));
    with_parts!(diagonals, faces, vertices_of, mesh, positions, new_faces, table, new)
}

/// Corners are gone through in runs of this many, and so many runs at a time: what they make stays in the caches. A tuning.
const RUN: usize = 8192;
const RUNS: usize = 32;

/// Vertices are taken in the order of the faces, since memory near to each other is read together: the oldest vertices stand
/// first, but lie far apart.
fn vertices_of<T: Coordinate, const DIAGONALS: bool, const FACES: bool>(
    mesh: &HalfEdgeMesh,
    positions: &[Point<T>],
    new_faces: &[Point<T>],
    table: &[Option<AtVertex<T>>],
    new: &mut [Point<T>],
) -> Vec<u32> {
    let (corners, leaving) = (mesh.faces().corners(), mesh.vertex_edges());
    let mut made: Vec<Made<T>> = vec![Made::default(); RUNS];
    let mut left = Vec::new();
    for (batch, batch_corners) in corners.chunks(RUN * RUNS).enumerate() {
        let runs = made.par_iter_mut().zip(batch_corners.par_chunks(RUN)).enumerate();
        runs.for_each(|(run, (made, corners))| {
            made.points.clear();
            made.left.clear();
            let first = (batch * RUNS + run) * RUN;
            for (at, vertex) in corners.iter().enumerate() {
                let h = (first + at) as u32;
                if leaving[*vertex as usize] != h {
                    continue;
                }
                let ring = Ring::around::<DIAGONALS, FACES>(mesh, positions, new_faces, h);
                match table.get(ring.valence) {
                    Some(Some(weights)) => {
                        let point = ring.point::<DIAGONALS, FACES>(positions[*vertex as usize], weights);
                        made.points.push((*vertex, point));
                    }
                    _ => made.left.push(*vertex),
                }
            }
        });
        for made in &made[..batch_corners.len().div_ceil(RUN)] {
            made.points.iter().for_each(|(vertex, point)| new[*vertex as usize] = *point);
            left.extend(&made.left);
        }
    }
    left
}

/// What one run makes, and what it leaves.
#[derive(Clone, Default)]
struct Made<T> {
    points: Vec<(u32, Point<T>)>,
    left: Vec<u32>,
}

/// Sums around a vertex.
struct Ring<T> {
    valence: usize,
    ring: Point<T>,
    diagonals: Point<T>,
    faces: Point<T>,
}

impl<T: Coordinate> Ring<T> {
    /// The sums around the vertex that a half-edge leaves, counter-clockwise from there as far as the boundary.
    #[inline(always)]
    fn around<const DIAGONALS: bool, const FACES: bool>(
        mesh: &HalfEdgeMesh,
        positions: &[Point<T>],
        new_faces: &[Point<T>],
        start: u32,
    ) -> Ring<T> {
        let zero = [T::default(); 3];
        let mut sums = Ring { valence: 0, ring: zero, diagonals: zero, faces: zero };
        let (faces, twins) = (mesh.faces(), mesh.twins());
        let at = |h: u32| positions[faces.corners()[h as usize] as usize];
        let mut h = start;
        loop {
            let next = faces.next(h);
            sums.ring = plus(sums.ring, at(next));
            if DIAGONALS {
                sums.diagonals = plus(sums.diagonals, at(faces.next(next)));
            }
            if FACES {
                sums.faces = plus(sums.faces, new_faces[faces.face_of(h) as usize]);
            }
            sums.valence += 1;
            h = twins[faces.prev(h) as usize];
            if h == start || h == NONE {
                return sums;
            }
        }
    }

    #[inline(always)]
    fn point<const DIAGONALS: bool, const FACES: bool>(&self, own: Point<T>, weights: &AtVertex<T>) -> Point<T> {
        let mut point = plus(times(own, weights.centre), times(self.ring, weights.ring));
        if DIAGONALS {
            point = plus(point, times(self.diagonals, weights.diagonals));
        }
        if FACES {
            point = plus(point, times(self.faces, weights.faces));
        }
        point
    }
}

/// The points of corners, by a table of weights by the number of the face's corners: w_j for the corner j places on.
pub(super) fn corner_points<T: Coordinate>(
    mesh: &HalfEdgeMesh,
    positions: &[Point<T>],
    table: &[Option<Vec<T>>],
    new: &mut [Point<T>],
) {
    let faces = mesh.faces();
    let point = |h: u32| {
        let face = faces.range(faces.face_of(h) as usize);
        let Some(Some(weights)) = table.get(face.len()) else { return [T::default(); 3] };
        let own = h as usize - face.start;
        let corners = &faces.corners()[face];
        let (before, after) = corners.split_at(own);
        let around = after.iter().chain(before).zip(weights);
        around.fold([T::default(); 3], |sum, (vertex, weight)| plus(sum, times(positions[*vertex as usize], *weight)))
    };
    new.par_iter_mut().enumerate().with_min_len(1024).for_each(|(h, new)| *new = point(h as u32));
}
