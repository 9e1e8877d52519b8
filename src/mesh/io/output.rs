//! What is to be written, and can it be?

use crate::mesh::{Crease, Faces, PolygonSoup};
use std::io;

/// Points or directions, in one precision or the other.
#[derive(Clone, Copy, Debug)]
pub enum Coordinates<'a> {
    /// Of 32 bits.
    Single(&'a [[f32; 3]]),
    /// Of 64 bits.
    Double(&'a [[f64; 3]]),
}

impl<'a> From<&'a [[f32; 3]]> for Coordinates<'a> {
    fn from(list: &'a [[f32; 3]]) -> Self {
        Coordinates::Single(list)
    }
}

impl<'a> From<&'a [[f64; 3]]> for Coordinates<'a> {
    fn from(list: &'a [[f64; 3]]) -> Self {
        Coordinates::Double(list)
    }
}

impl Coordinates<'_> {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Coordinates::Single(list) => list.len(),
            Coordinates::Double(list) => list.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One of them, rounded to 32 bits.
    pub(super) fn single(&self, index: usize) -> [f32; 3] {
        match self {
            Coordinates::Single(list) => list[index],
            Coordinates::Double(list) => list[index].map(|value| value as f32),
        }
    }

    /// All of them, rounded to 32 bits.
    pub(super) fn singles(&self) -> impl Iterator<Item = [f32; 3]> {
        (0..self.len()).map(|index| self.single(index))
    }

    /// The first that has a coordinate which is not finite, in their own precision or in 32 bits.
    fn first_infinite(&self, in_single: bool) -> Option<usize> {
        match self {
            Coordinates::Double(list) if !in_single => list.iter().position(|all| !all.iter().all(|x| x.is_finite())),
            _ => self.singles().position(|all| !all.iter().all(|x| x.is_finite())),
        }
    }

    /// Whether some coordinate has more digits than 32 bits hold.
    pub(super) fn lose_digits(&self) -> bool {
        match self {
            Coordinates::Single(_) => false,
            Coordinates::Double(list) => list.as_flattened().iter().any(|x| f64::from(*x as f32) != *x),
        }
    }
}

/// A mesh to be written, borrowed.
#[derive(Clone, Copy, Debug)]
pub struct Output<'a> {
    /// The points.
    pub positions: Coordinates<'a>,
    /// The faces.
    pub faces: &'a Faces,
    /// A direction of length 1 for each point.
    pub normals: Option<Coordinates<'a>>,
    /// Edges that are creases.
    pub creases: &'a [Crease],
    /// Vertices that are corners.
    pub corners: &'a [u32],
}

impl<'a> Output<'a> {
    /// Points and faces.
    pub fn new(positions: impl Into<Coordinates<'a>>, faces: &'a Faces) -> Output<'a> {
        Output { positions: positions.into(), faces, normals: None, creases: &[], corners: &[] }
    }

    /// The same with a normal for each point.
    #[must_use]
    pub fn normals(self, normals: impl Into<Coordinates<'a>>) -> Output<'a> {
        Output { normals: Some(normals.into()), ..self }
    }

    /// The same with tags.
    #[must_use]
    pub fn tags(self, creases: &'a [Crease], corners: &'a [u32]) -> Output<'a> {
        Output { creases, corners, ..self }
    }

    /// Whether it can be written at all, `in_single` as numbers of 32 bits.
    pub(super) fn check(&self, in_single: bool) -> io::Result<()> {
        let vertices = self.positions.len();
        if self.faces.is_empty() {
            return Err(refused("a mesh without faces is not written: no file would be read back"));
        }
        if let Some(face) = self.faces.iter().position(|face| face.len() < 3) {
            return Err(refused(format!("face {face} has fewer than three corners")));
        }
        let ends = self.creases.iter().flat_map(|crease| crease.ends);
        let indices = self.faces.corners().iter().copied().chain(ends).chain(self.corners.iter().copied());
        if let Some(vertex) = indices.into_iter().find(|vertex| *vertex as usize >= vertices) {
            return Err(refused(format!("a face or a tag names vertex {vertex}, but there are {vertices}")));
        }
        if self.normals.is_some_and(|normals| normals.len() != vertices) {
            return Err(refused(format!("there is not one normal for each of the {vertices} vertices")));
        }
        let bits = if in_single { " of 32 bits" } else { "" };
        for (what, list) in [("position", Some(self.positions)), ("normal", self.normals)] {
            if let Some(vertex) = list.and_then(|list| list.first_infinite(in_single)) {
                return Err(refused(format!("the {what} of vertex {vertex} is not a finite number{bits}")));
            }
        }
        Ok(())
    }

    /// What is said where tags are left out.
    pub(super) fn tags_left_out(&self) -> Option<String> {
        let any = !self.creases.is_empty() || !self.corners.is_empty();
        any.then(|| "creases and corners are left out: of these formats only OBJ holds them".to_string())
    }
}

impl<'a> From<&'a PolygonSoup> for Output<'a> {
    fn from(soup: &'a PolygonSoup) -> Self {
        Output::new(soup.positions.as_slice(), &soup.faces).tags(&soup.creases, &soup.corners)
    }
}

/// What can't be written.
pub(super) fn refused(message: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, message.into())
}
