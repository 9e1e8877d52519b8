//! Is this list of points a polygon that a curve can be made of?

use std::fmt;

/// A control polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// Its points; those of plane curves have z = 0.
    pub points: Vec<[f64; 3]>,
    /// Whether its last point is joined to its first.
    pub closed: bool,
    /// The number of coordinates in the file, 2 or 3.
    pub dimension: usize,
}

/// Why points make no polygon.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotAPolygon {
    /// There is no point.
    Empty,
    /// There is one point.
    OnePoint,
    /// A coordinate is infinite or not a number, at this point.
    NotFinite(usize),
    /// Every point is the same.
    AllCoincide(usize),
}

impl fmt::Display for NotAPolygon {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotAPolygon::Empty => f.write_str("there is no point; a polygon has two or more"),
            NotAPolygon::OnePoint => f.write_str("there is one point; a polygon has two or more"),
            NotAPolygon::NotFinite(point) => write!(f, "a coordinate of point {point} is not a finite number"),
            NotAPolygon::AllCoincide(count) => write!(f, "all {count} points are the same, so that there is no curve"),
        }
    }
}

impl std::error::Error for NotAPolygon {}

impl Polygon {
    /// A polygon of points.
    ///
    /// # Errors
    /// When there are fewer than two different points, or a coordinate is not finite.
    pub fn new(points: Vec<[f64; 3]>, closed: bool, dimension: usize) -> Result<Polygon, NotAPolygon> {
        match points.as_slice() {
            [] => return Err(NotAPolygon::Empty),
            [_] => return Err(NotAPolygon::OnePoint),
            _ => {}
        }
        if let Some(point) = points.iter().position(|point| point.iter().any(|x| !x.is_finite())) {
            return Err(NotAPolygon::NotFinite(point));
        }
        if points.iter().all(|point| *point == points[0]) {
            return Err(NotAPolygon::AllCoincide(points.len()));
        }
        Ok(Polygon { points, closed, dimension })
    }

    /// The number of points that coincide with the one before them: allowed, and told.
    pub fn coincident(&self) -> usize {
        let around = self.closed && self.points.first() == self.points.last();
        self.points.windows(2).filter(|pair| pair[0] == pair[1]).count() + usize::from(around)
    }
}
