//! What does a scheme for curves make of a polygon?
//!
//! Rows of weights from the mask, applied to points: closed polygons go round, open ones end by the rules of their ends; without such
//! rules only those new points are made whose old points are all there, and the polygon grows shorter at its ends.

use crate::scheme::curve::{Halves, Mask, Rules};
use dashu_ratio::RBig;
use std::fmt;

/// The most points of a refined polygon.
pub const MAX_REFINED: usize = 1 << 28;

/// Weights of consecutive old points, from an index on.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The index of the first old point, less that of the new point over the arity, rounded down.
    pub start: i64,
    /// The weights.
    pub weights: Vec<f64>,
}

impl Row {
    fn of(submask: &[(i64, RBig)]) -> Row {
        let (Some((start, _)), Some((last, _))) = (submask.first(), submask.last()) else {
            return Row { start: 0, weights: Vec::new() };
        };
        let mut weights = vec![0.0; (last - start + 1) as usize];
        for (j, weight) in submask {
            weights[(j - start) as usize] = weight.to_f64().value();
        }
        Row { start: *start, weights }
    }

    fn last(&self) -> i64 {
        self.start + self.weights.len() as i64 - 1
    }

    /// The mean of points from an index on that lie in the list.
    fn inside<const D: usize>(&self, points: &[[f64; D]], at: usize) -> [f64; D] {
        let mut sum = [0.0; D];
        for (weight, point) in self.weights.iter().zip(&points[at..]) {
            for axis in 0..D {
                sum[axis] += weight * point[axis];
            }
        }
        sum
    }

    /// The same around a closed polygon.
    fn around<const D: usize>(&self, points: &[[f64; D]], at: i64) -> [f64; D] {
        let mut sum = [0.0; D];
        for (offset, weight) in (0..).zip(&self.weights) {
            let point = &points[(at + offset).rem_euclid(points.len() as i64) as usize];
            for axis in 0..D {
                sum[axis] += weight * point[axis];
            }
        }
        sum
    }
}

/// The rows at the ends of an open polygon.
#[derive(Clone, Debug)]
struct EndRows {
    rows: Vec<Vec<f64>>,
    then: i64,
}

#[derive(Clone, Debug)]
enum Kind {
    Mask {
        /// One row for each kind of new point.
        rows: Vec<Row>,
        /// The sum of the first and the last index of the mask.
        ends_sum: i64,
        ends: Option<EndRows>,
    },
    Halves {
        first: Vec<Vec<f64>>,
        second: Vec<Vec<f64>>,
    },
}

/// Refines polygons by a scheme.
#[derive(Clone, Debug)]
pub struct CurveRefiner {
    kind: Kind,
}

/// Why a polygon can't be refined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotRefinableCurve {
    /// It has fewer points than the scheme needs.
    TooFew {
        /// Its points.
        points: usize,
        /// What is needed.
        needed: usize,
    },
    /// Its points don't make up pieces of so many sides.
    Pieces {
        /// Its points.
        points: usize,
        /// The sides of a piece.
        sides: usize,
    },
    /// A scheme of halves is for open polygons.
    Closed,
    /// More points than [`MAX_REFINED`] would be made.
    TooMany,
}

impl fmt::Display for NotRefinableCurve {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotRefinableCurve::TooFew { points, needed } => {
                write!(f, "the polygon has {points} points, and at least {needed} are needed")
            }
            NotRefinableCurve::Pieces { points, sides } => write!(
                f,
                "the polygon has {points} points; one of {} points is needed, or several such that share their end points: {}, {}, ...",
                sides + 1,
                2 * sides + 1,
                3 * sides + 1
            ),
            NotRefinableCurve::Closed => f.write_str("a scheme of halves takes open polygons"),
            NotRefinableCurve::TooMany => write!(f, "more than {MAX_REFINED} points would be made"),
        }
    }
}

impl std::error::Error for NotRefinableCurve {}

fn floats(matrix: &[Vec<RBig>]) -> Vec<Vec<f64>> {
    matrix.iter().map(|row| row.iter().map(|weight| weight.to_f64().value()).collect()).collect()
}

impl CurveRefiner {
    /// The refiner of a scheme.
    pub fn new(rules: &Rules) -> CurveRefiner {
        let kind = match rules {
            Rules::Halves(Halves { first, second }) => Kind::Halves { first: floats(first), second: floats(second) },
            Rules::Mask(mask, ends) => {
                let ends = ends.as_ref().map(|ends| EndRows { rows: floats(&ends.rules), then: ends.then });
                Kind::Mask { rows: rows_of(mask), ends_sum: ends_sum(mask), ends }
            }
        };
        CurveRefiner { kind }
    }

    /// The number of new points for each old one.
    pub fn arity(&self) -> usize {
        match &self.kind {
            Kind::Mask { rows, .. } => rows.len(),
            Kind::Halves { .. } => 2,
        }
    }

    /// One step.
    ///
    /// # Errors
    /// When the polygon has too few points, or points that don't make up pieces.
    pub fn step<const D: usize>(&self, points: &[[f64; D]], closed: bool) -> Result<Vec<[f64; D]>, NotRefinableCurve> {
        if points.len().saturating_mul(self.arity()) > MAX_REFINED {
            return Err(NotRefinableCurve::TooMany);
        }
        match &self.kind {
            Kind::Halves { .. } if closed => Err(NotRefinableCurve::Closed),
            Kind::Halves { first, second } => halved(points, first, second),
            Kind::Mask { rows, .. } if closed => Ok(around(points, rows)),
            Kind::Mask { rows, ends: None, .. } => {
                let mut refined = Vec::new();
                inside(points, rows, first_inside(rows), last_inside(rows, points.len()), &mut refined);
                if refined.is_empty() { Err(too_few(points.len(), rows)) } else { Ok(refined) }
            }
            Kind::Mask { rows, ends: Some(ends), ends_sum } => ended(points, rows, ends, *ends_sum),
        }
    }

    /// Several steps.
    ///
    /// # Errors
    /// As [`CurveRefiner::step`].
    pub fn steps<const D: usize>(
        &self,
        points: &[[f64; D]],
        closed: bool,
        levels: usize,
    ) -> Result<Vec<[f64; D]>, NotRefinableCurve> {
        let mut at = points.to_vec();
        for _ in 0..levels {
            at = self.step(&at, closed)?;
        }
        Ok(at)
    }
}

/// One row for each kind of new point.
pub(crate) fn rows_of(mask: &Mask) -> Vec<Row> {
    (0..i64::from(mask.arity)).map(|r| Row::of(&mask.submask(r))).collect()
}

fn ends_sum(mask: &Mask) -> i64 {
    mask.support().map_or(0, |(first, last)| first + last)
}

fn around<const D: usize>(points: &[[f64; D]], rows: &[Row]) -> Vec<[f64; D]> {
    let mut refined = Vec::with_capacity(points.len() * rows.len());
    let count = points.len() as i64;
    let (low, high) =
        (rows.iter().map(|row| row.start).min().unwrap_or(0), rows.iter().map(Row::last).max().unwrap_or(0));
    let safe = (-low).max(0)..(count - high.max(0)).max((-low).max(0));
    let step = |old: i64, refined: &mut Vec<[f64; D]>| {
        refined.extend(rows.iter().map(|row| row.around(points, old + row.start)));
    };
    let (start, end) = (safe.start.min(count), safe.end.min(count));
    (0..start).for_each(|old| step(old, &mut refined));
    interior(points, rows, start.max(0) as usize, end.max(start) as usize, &mut refined);
    (end.max(start)..count).for_each(|old| step(old, &mut refined));
    refined
}

/// The new points of old ones whose stencils lie inside.
fn interior<const D: usize>(points: &[[f64; D]], rows: &[Row], from: usize, to: usize, refined: &mut Vec<[f64; D]>) {
    for old in from..to {
        for row in rows {
            refined.push(row.inside(points, (old as i64 + row.start) as usize));
        }
    }
}

/// The new points from one index to another.
fn inside<const D: usize>(points: &[[f64; D]], rows: &[Row], from: i64, to: i64, refined: &mut Vec<[f64; D]>) {
    let arity = rows.len() as i64;
    refined.reserve((to - from + 1).max(0) as usize);
    for i in from..=to {
        let row = &rows[i.rem_euclid(arity) as usize];
        refined.push(row.inside(points, (i.div_euclid(arity) + row.start) as usize));
    }
}

/// The first index from which on every new point is made of old points from 0 on.
fn first_inside(rows: &[Row]) -> i64 {
    // the new point i = a m + r needs m + start >= 0
    let arity = rows.len() as i64;
    let first = |(r, row): (i64, &Row)| -arity * row.start + r;
    let last_outside = (0..).zip(rows).map(first).map(|i| i - arity).max().unwrap_or(0);
    last_outside + 1
}

/// The last index up to which every new point is made of old points before `count`.
fn last_inside(rows: &[Row], count: usize) -> i64 {
    let arity = rows.len() as i64;
    let last = |(r, row): (i64, &Row)| arity * (count as i64 - 1 - row.last()) + r;
    let first_outside = (0..).zip(rows).map(last).map(|i| i + arity).min().unwrap_or(0);
    first_outside - 1
}

fn too_few(points: usize, rows: &[Row]) -> NotRefinableCurve {
    let needed = (1..).find(|count| first_inside(rows) <= last_inside(rows, *count)).unwrap_or(points + 1);
    NotRefinableCurve::TooFew { points, needed }
}

fn ended<const D: usize>(
    points: &[[f64; D]],
    rows: &[Row],
    ends: &EndRows,
    ends_sum: i64,
) -> Result<Vec<[f64; D]>, NotRefinableCurve> {
    let arity = rows.len() as i64;
    // the mirror image of the new point i is the new point a (n - 1) + l + r - i
    let last = |count: usize| arity * (count as i64 - 1) + ends_sum - ends.then;
    let longest = ends.rows.iter().map(Vec::len).max().unwrap_or(0);
    let fits = |count: usize| count >= longest && last(count) >= ends.then && last_inside(rows, count) >= last(count);
    if !fits(points.len()) {
        let needed = (points.len()..).find(|count| fits(*count)).unwrap_or(points.len() + 1);
        return Err(NotRefinableCurve::TooFew { points: points.len(), needed });
    }
    let mut refined = Vec::with_capacity(points.len() * rows.len());
    let mean = |row: &Vec<f64>, back: bool| {
        let mut sum = [0.0; D];
        for (j, weight) in row.iter().enumerate() {
            let point = &points[if back { points.len() - 1 - j } else { j }];
            for axis in 0..D {
                sum[axis] += weight * point[axis];
            }
        }
        sum
    };
    refined.extend(ends.rows.iter().map(|row| mean(row, false)));
    inside(points, rows, ends.then, last(points.len()), &mut refined);
    refined.extend(ends.rows.iter().rev().map(|row| mean(row, true)));
    Ok(refined)
}

fn halved<const D: usize>(
    points: &[[f64; D]],
    first: &[Vec<f64>],
    second: &[Vec<f64>],
) -> Result<Vec<[f64; D]>, NotRefinableCurve> {
    let sides = first.len() - 1;
    if points.len() < 2 || !(points.len() - 1).is_multiple_of(sides) {
        return Err(NotRefinableCurve::Pieces { points: points.len(), sides });
    }
    let mean = |row: &Vec<f64>, piece: &[[f64; D]]| {
        let mut sum = [0.0; D];
        for (weight, point) in row.iter().zip(piece) {
            for axis in 0..D {
                sum[axis] += weight * point[axis];
            }
        }
        sum
    };
    let mut refined = Vec::with_capacity(2 * points.len());
    for start in (0..points.len() - 1).step_by(sides) {
        let piece = &points[start..=start + sides];
        // the last point of a half is the first of the next
        refined.extend(first.iter().take(sides).map(|row| mean(row, piece)));
        refined.extend(second.iter().take(sides).map(|row| mean(row, piece)));
    }
    refined.extend(second.last().map(|row| mean(row, &points[points.len() - 1 - sides..])));
    Ok(refined)
}
