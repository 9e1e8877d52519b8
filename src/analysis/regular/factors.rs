//! Which smoothing factors does a symbol have?
//!
//! For M = m I the factor of a direction v is 1 + z^v + ... + z^((m-1)v): averaging along v. It divides a symbol exactly when the
//! coefficients of every line along v, as a polynomial in one variable, are divisible by 1 + x + ... + x^(m-1). The convex hull of the mask
//! then has an edge along v (Newton's polygon of a product is the sum of those of its factors), so that all directions are found. Directions are primitive
//! (their coordinates have no common divisor); factors of different directions have none in common.

use super::mask::{Mask, Point, Sequence, add, bounds};
use crate::numbers::{Field, Free, Trouble};
use dashu_base::Gcd;

/// A symbol as a product: smoothing factors, each as often as it divides, and a kernel without any.
#[derive(Clone, Debug, PartialEq)]
pub struct Factors {
    /// Directions with their multiplicities, shortest first.
    pub directions: Vec<(Point, usize)>,
    /// What is left.
    pub kernel: Sequence,
}

impl Factors {
    /// The factors of a mask; none for a dilation matrix other than m I.
    ///
    /// # Errors
    /// When the numbers pass a limit of size.
    pub fn of(mask: &Mask) -> Result<Factors, Trouble> {
        let mut factors = Factors { directions: vec![], kernel: mask.coefficients.clone() };
        let Some(m) = mask.dilation.arity() else { return Ok(factors) };
        for direction in candidates(&mask.coefficients) {
            let mut times = 0;
            while let Some(quotient) = divided(&factors.kernel, direction, m)? {
                factors.kernel = quotient;
                times += 1;
            }
            if times > 0 {
                factors.directions.push((direction, times));
            }
        }
        Ok(factors)
    }

    /// The number of smoothing factors.
    pub fn count(&self) -> usize {
        self.directions.iter().map(|(_, times)| times).sum()
    }
}

/// The determinant of two directions.
pub fn cross([a, b]: Point, [c, d]: Point) -> i32 {
    a * d - b * c
}

/// The primitive directions of the edges of a sequence's convex hull, one of v and -v, shortest first.
fn candidates(sequence: &Sequence) -> Vec<Point> {
    let lower: Vec<Point> = chain(sequence.keys().copied());
    let upper: Vec<Point> = chain(sequence.keys().rev().copied());
    let edges = [&lower, &upper].into_iter().flat_map(|corners| corners.windows(2));
    let along = |pair: &[Point]| {
        let (x, y) = (pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
        let length = x.unsigned_abs().gcd(y.unsigned_abs()) as i32;
        let v = [x / length, y / length];
        if v > [0, 0] { v } else { [-v[0], -v[1]] }
    };
    let mut candidates: Vec<Point> = edges.map(along).collect();
    // of two that are as long the one with positive coordinates comes first
    candidates.sort_by_key(|[x, y]| (x * x + y * y, *y < 0, *y, -x));
    candidates.dedup();
    candidates
}

/// Half of the convex hull of points in order: every corner turns left.
fn chain(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut corners: Vec<Point> = Vec::new();
    for point in points {
        let minus = |[a, b]: Point, [c, d]: Point| [a - c, b - d];
        while let [.., p, q] = corners[..] {
            if cross(minus(q, p), minus(point, q)) > 0 {
                break;
            }
            corners.pop();
        }
        corners.push(point);
    }
    corners
}

/// The quotient by 1 + z^v + ... + z^((m-1)v), where there is one. v comes after 0 in the order of points, so that the least point
/// of what is left is the first of its line.
pub fn divided(sequence: &Sequence, v: Point, m: i32) -> Result<Option<Sequence>, Trouble> {
    let Some((low, high)) = bounds(sequence) else { return Ok(None) };
    let (mut rest, mut quotient) = (sequence.clone(), Sequence::new());
    while let Some((point, weight)) = rest.iter().next().map(|(point, weight)| (*point, weight.clone())) {
        let at = |step: i32| [point[0] + step * v[0], point[1] + step * v[1]];
        let last = at(m - 1);
        if (0..2).any(|axis| last[axis] > high[axis] || last[axis] < low[axis]) {
            return Ok(None);
        }
        let negative = weight.negated();
        (0..m).try_for_each(|step| add(&mut rest, at(step), &negative))?;
        quotient.insert(point, weight);
    }
    Ok(Some(quotient))
}

/// The product with 1 + z^v + ... + z^((m-1)v).
///
/// # Errors
/// When the numbers pass a limit of size.
pub fn multiplied(sequence: &Sequence, v: Point, m: i32) -> Result<Sequence, Trouble> {
    let mut product = Sequence::new();
    for (point, weight) in sequence {
        (0..m).try_for_each(|step| add(&mut product, [point[0] + step * v[0], point[1] + step * v[1]], weight))?;
    }
    Ok(product)
}

/// The product with a number.
///
/// # Errors
/// When the numbers pass a limit of size.
pub fn scaled(sequence: &Sequence, factor: &Free) -> Result<Sequence, Trouble> {
    sequence.iter().map(|(point, weight)| Ok((*point, weight.times(factor)?))).collect()
}
