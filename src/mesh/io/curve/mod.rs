//! How do polygons come from files, and go into them?
//!
//! | format | read | written |
//! |---|---|---|
//! | CSV | points as `x,y` or `x,y,z`, one a line; an empty line between two polygons | the same |
//! | JSON | a list of points, or `{"points": [[0, 0], [1, 2]], "closed": true}`, or a list of such | the latter |
//! | SVG | paths of straight lines (M, L, H, V, Z), `polyline`, `polygon` | paths |
//! | OBJ | `v` and `l`; a line that ends in its first vertex is closed | the same |
//!
//! Coordinates are those of the file: no `transform` of an SVG file is applied.

mod csv;
mod json;
mod obj;
mod svg;
mod write;

pub use write::{Style, write};

use super::bad_file::{BadFile, Kind, Place, empty};
use super::text;
use crate::mesh::{NotAPolygon, Polygon};
use std::path::Path;

/// A format of files of polygons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveFormat {
    /// Comma-separated values.
    Csv,
    /// JSON.
    Json,
    /// Scalable Vector Graphics.
    Svg,
    /// Wavefront OBJ, its lines.
    Obj,
}

impl CurveFormat {
    /// All formats.
    pub const ALL: [CurveFormat; 4] = [CurveFormat::Csv, CurveFormat::Json, CurveFormat::Svg, CurveFormat::Obj];

    /// The format that the ending of a file's name tells.
    pub fn of_path(path: &Path) -> Option<CurveFormat> {
        let ending = path.extension()?.to_str()?;
        CurveFormat::ALL.into_iter().find(|format| format.ending().eq_ignore_ascii_case(ending))
    }

    /// The ending of the names of such files, without a dot.
    pub fn ending(self) -> &'static str {
        match self {
            CurveFormat::Csv => "csv",
            CurveFormat::Json => "json",
            CurveFormat::Svg => "svg",
            CurveFormat::Obj => "obj",
        }
    }
}

/// Points of a polygon as a file tells them.
#[derive(Clone, Debug, Default, PartialEq)]
struct Told {
    points: Vec<[f64; 3]>,
    closed: bool,
    /// The number of coordinates, 2 or 3; 0 before the first point.
    dimension: usize,
}

impl Told {
    /// Takes a point of two or three coordinates.
    fn push(&mut self, values: &[f64], place: &Place) -> Result<(), BadFile> {
        if !(2..=3).contains(&values.len()) {
            let message = format!("a point has two or three coordinates, and {} are here", values.len());
            return Err(BadFile::new(Kind::Number, place.clone(), message, "give x and y, or x, y and z"));
        }
        if self.dimension != 0 && self.dimension != values.len() {
            let message =
                format!("this point has {} coordinates, and those before it {}", values.len(), self.dimension);
            return Err(BadFile::new(Kind::Number, place.clone(), message, "give every point as many"));
        }
        if values.iter().any(|value| !value.is_finite()) {
            let help = "write it as in 1.5 or -2e-3";
            return Err(BadFile::new(Kind::Number, place.clone(), "a coordinate is not a finite number", help));
        }
        self.dimension = values.len();
        self.points.push([values[0], values[1], values.get(2).copied().unwrap_or(0.0)]);
        Ok(())
    }
}

/// Reads the polygons of a file. `closed` closes those of formats that can't tell: CSV, and lists of points in JSON.
///
/// # Errors
/// The first fault, where, and what to do.
pub fn read(format: CurveFormat, bytes: &[u8], closed: bool) -> Result<Vec<Polygon>, BadFile> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(empty());
    }
    text::check(bytes)?;
    let told = match format {
        CurveFormat::Csv => csv::read(bytes)?,
        CurveFormat::Json => json::read(bytes)?,
        CurveFormat::Svg => svg::read(bytes)?,
        CurveFormat::Obj => obj::read(bytes)?,
    };
    if told.is_empty() {
        let help = "a polygon is a list of two points or more";
        return Err(BadFile::new(Kind::NoFaces, Place::Whole, "there is no polygon in it", help));
    }
    told.into_iter().map(|told| polygon(told, closed)).collect()
}

/// A polygon; where its last point is its first it is closed, and that point is told once.
fn polygon(mut told: Told, closed: bool) -> Result<Polygon, BadFile> {
    let closed = closed || told.closed;
    if closed && told.points.len() > 2 && told.points.first() == told.points.last() {
        told.points.pop();
    }
    Polygon::new(told.points, closed, told.dimension.max(2)).map_err(|wrong| {
        let help = match wrong {
            NotAPolygon::Empty | NotAPolygon::OnePoint => "add points",
            NotAPolygon::NotFinite(_) => "write every coordinate as in 1.5 or -2e-3",
            NotAPolygon::AllCoincide(_) => "give at least two different points",
        };
        BadFile::new(Kind::Number, Place::Whole, wrong.to_string(), help)
    })
}
