//! Which smoothing factors does a symbol have?
//!
//! For M = m I the factor of a direction v is 1 + z^v + ... + z^((m-1)v): averaging along v. It divides a symbol exactly when the
//! coefficients of every line along v, as a polynomial in one variable, are divisible by 1 + x + ... + x^(m-1). Its Newton polygon then
//! has an edge along v, so that directions longer than the mask's extent can't occur: the search is complete. Directions are primitive
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

/// The primitive directions that fit into a sequence, one of v and -v, shortest first.
fn candidates(sequence: &Sequence) -> Vec<Point> {
    let Some((low, high)) = bounds(sequence) else { return vec![] };
    let (width, height) = (high[0] - low[0], high[1] - low[1]);
    let all = (0..=width).flat_map(|x| (-height..=height).map(move |y| [x, y]));
    let primitive = |[x, y]: &Point| [*x, *y] > [0, 0] && x.unsigned_abs().gcd(y.unsigned_abs()) == 1;
    let mut candidates: Vec<Point> = all.filter(primitive).collect();
    // of two that are as long the one with positive coordinates comes first
    candidates.sort_by_key(|[x, y]| (x * x + y * y, *y < 0, *y, -x));
    candidates
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
