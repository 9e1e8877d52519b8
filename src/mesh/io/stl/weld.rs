//! Which points of triangles are the same vertex?

use super::super::bad_file::{BadFile, Kind, Place};
use super::super::gather::Gather;
use crate::mesh::PolygonSoup;
use std::collections::HashMap;

/// Triangles, and the vertices that their corners were welded to.
#[derive(Default)]
pub(super) struct Weld {
    gather: Gather,
    vertices: HashMap<[u64; 3], u32>,
}

impl Weld {
    /// One more triangle, at a place.
    pub(super) fn triangle(&mut self, points: [[f64; 3]; 3], place: impl Fn() -> Place) -> Result<(), BadFile> {
        let mut corners = [0; 3];
        for (corner, point) in corners.iter_mut().zip(points) {
            *corner = self.vertex(point)?;
        }
        let [a, b, c] = corners;
        if a == b || b == c || c == a {
            let message = "two corners of a facet are the same point";
            return self.gather.fault(BadFile::new(Kind::Face, place(), message, "take the facet out, or mend it"));
        }
        self.gather.face(corners.into_iter().map(Ok), place)
    }

    /// The vertex at a point: the first that was met there.
    fn vertex(&mut self, point: [f64; 3]) -> Result<u32, BadFile> {
        // 0 and -0 are equal
        let key = point.map(|value| (value + 0.0).to_bits());
        if let Some(vertex) = self.vertices.get(&key) {
            return Ok(*vertex);
        }
        let vertex = self.gather.vertices() as u32;
        self.gather.vertex(Ok(point))?;
        self.vertices.insert(key, vertex);
        Ok(vertex)
    }

    pub(super) fn fault(&mut self, fault: BadFile) -> Result<(), BadFile> {
        self.gather.fault(fault)
    }

    pub(super) fn finish(self) -> Result<PolygonSoup, BadFile> {
        self.gather.finish()
    }
}
