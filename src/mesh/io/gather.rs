//! What has a reader gathered, and is it sound?

use super::bad_file::{self, BadFile, Kind, Place};
use crate::mesh::pairing::repeats;
use crate::mesh::{Faces, MAX_CORNERS, PolygonSoup};

/// Points and faces as they are read, and the first fault.
#[derive(Default)]
pub(super) struct Gather {
    positions: Vec<[f64; 3]>,
    sizes: Vec<u32>,
    corners: Vec<u32>,
    fault: Option<BadFile>,
    sorted: Vec<u32>,
}

impl Gather {
    /// The number of points so far.
    pub(super) fn vertices(&self) -> usize {
        self.positions.len()
    }

    /// Makes room for points and faces, which must be no more than the file can hold.
    pub(super) fn reserve(&mut self, vertices: usize, faces: usize) {
        self.positions.reserve(vertices);
        self.sizes.reserve(faces);
        self.corners.reserve(faces.saturating_mul(3));
    }

    /// A fault is kept if it is the first, and counted if it is of the kind of the first.
    ///
    /// # Errors
    /// The first fault, where nothing can be read after this one.
    pub(super) fn fault(&mut self, fault: BadFile) -> Result<(), BadFile> {
        let fatal = fault.is_fatal();
        match &mut self.fault {
            None => self.fault = Some(fault),
            Some(first) if first.kind == fault.kind => first.more += 1,
            Some(_) => {}
        }
        if fatal { self.fault.take().map_or(Ok(()), Err) } else { Ok(()) }
    }

    /// One more point, or why it is none.
    pub(super) fn vertex(&mut self, position: Result<[f64; 3], BadFile>) -> Result<(), BadFile> {
        if self.positions.len() >= MAX_CORNERS {
            return self.fault(too_large("vertices"));
        }
        // a faulty point keeps its number, so that indices still mean what they meant
        self.positions.push(*position.as_ref().unwrap_or(&[0.0; 3]));
        position.map_or_else(|fault| self.fault(fault), |_| Ok(()))
    }

    /// One more face of these corners, which are all read even where one is at fault.
    pub(super) fn face(
        &mut self,
        corners: impl Iterator<Item = Result<u32, BadFile>>,
        place: impl FnOnce() -> Place,
    ) -> Result<(), BadFile> {
        let start = self.corners.len();
        let mut wrong = None;
        for corner in corners {
            match corner {
                Ok(vertex) if self.corners.len() < MAX_CORNERS => self.corners.push(vertex),
                Ok(_) => wrong = wrong.or_else(|| Some(too_large("corners of faces"))),
                Err(fault) if fault.is_fatal() => return self.fault(fault),
                Err(fault) => wrong = wrong.or(Some(fault)),
            }
        }
        match wrong.map_or_else(|| self.sound(start, place), Err) {
            Ok(()) => self.sizes.push((self.corners.len() - start) as u32),
            Err(fault) => {
                self.corners.truncate(start);
                self.fault(fault)?;
            }
        }
        Ok(())
    }

    /// Whether the corners from `start` on make a face.
    fn sound(&mut self, start: usize, place: impl FnOnce() -> Place) -> Result<(), BadFile> {
        let face = &self.corners[start..];
        if face.len() >= 3 && !repeats(face, &mut self.sorted) {
            return Ok(());
        }
        let (message, help) = if face.len() < 3 {
            (format!("a face has {} corners, but needs three or more", face.len()), "take it out, or mend it")
        } else {
            ("a face has a corner twice".to_string(), "take the corner or the face out, or cut the face in two")
        };
        Err(BadFile::new(Kind::Face, place(), message, help))
    }

    /// The first corner of a face that is no point: the face, the vertex, and how many more there are.
    pub(super) fn first_beyond(&self) -> Option<(usize, u32, usize)> {
        let beyond = |vertex: &u32| *vertex as usize >= self.positions.len();
        let at = self.corners.iter().position(beyond)?;
        let more = self.corners[at + 1..].iter().filter(|vertex| beyond(vertex)).count();
        let ends = self.sizes.iter().scan(0, |end, size| {
            *end += *size as usize;
            Some(*end)
        });
        Some((ends.take_while(|end| *end <= at).count(), self.corners[at], more))
    }

    /// Whether a fault has been met.
    pub(super) fn is_sound(&self) -> bool {
        self.fault.is_none()
    }

    /// What was gathered, if it is sound.
    pub(super) fn finish(self) -> Result<PolygonSoup, BadFile> {
        if let Some(fault) = self.fault {
            return Err(fault);
        }
        if self.sizes.is_empty() {
            return Err(bad_file::no_faces());
        }
        let faces = Faces::mixed(&self.sizes, self.corners);
        Ok(PolygonSoup { positions: self.positions, faces, creases: Vec::new(), corners: Vec::new() })
    }
}

/// An index of no vertex; `first` is what the format counts from.
pub(super) fn no_vertex(index: impl std::fmt::Display, vertices: usize, first: u32, place: Place) -> BadFile {
    let message = format!("there is no vertex {index}: the file has {vertices}, counted from {first}");
    BadFile::new(Kind::Index, place, message, "correct the index, or add the vertices that are missing")
}

fn too_large(what: &str) -> BadFile {
    let message = format!("there are more than {MAX_CORNERS} {what}");
    BadFile::new(Kind::TooLarge, Place::Whole, message, "cut the mesh into parts")
}
