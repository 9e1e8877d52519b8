//! What does a mesh file say, before anyone asks whether it is a mesh?

use super::Faces;

/// Points, polygons on them, and tags, as a file lists them.
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonSoup {
    /// The points; every coordinate is finite.
    pub positions: Vec<[f64; 3]>,
    /// The faces; every corner is an index into the points.
    pub faces: Faces,
    /// Edges that are creases.
    pub creases: Vec<Crease>,
    /// Vertices that are corners: they stay where they are.
    pub corners: Vec<u32>,
}

/// An edge tagged as a crease.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crease {
    /// The ends of the edge.
    pub ends: [u32; 2],
    /// How many steps the crease lasts, fractions included; infinite where it stays for ever.
    pub sharpness: f64,
}
