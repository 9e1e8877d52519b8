//! How does the subdominant eigenvalue move with c over a box?
//!
//! It is a root of a polynomial whose coefficients depend on c. Newton's method in Taylor forms finds numbers near it;
//! that it lies within an interval E of them at every c follows from the operator of Krawczyk (1969): where
//! -s(x)/s'(x_0) + (1 - s'(x + E)/s'(x_0)) E lies inside E, there is just one root in x + E. It is the largest real
//! root where all derivatives of s are positive there: s grows from it on.

use super::taylor::Taylor;
use crate::numbers::{Field, Interval, Trouble, Univariate};
use crate::proof::signed::Signed;
use std::cmp::Ordering;

/// Newton's steps: each gains at least one power of t.
const STEPS: usize = 8;

/// How often E is made wider.
const WIDER: usize = 8;

/// The largest real root of a monic polynomial over a box, where it is near `start` in the middle; `None` where that
/// isn't seen.
///
/// # Errors
/// When a limit of size is passed.
pub fn largest_root(polynomial: &Univariate<Taylor>, start: f64) -> Result<Option<Taylor>, Trouble> {
    if let [constant, _] = polynomial.coefficients() {
        return Ok(Some(constant.negated()));
    }
    let slope = polynomial.derivative()?;
    let mut root = Taylor::constant(Interval::point(start));
    let steepness = slope.evaluate(&root)?.approx();
    if steepness == 0.0 || !steepness.is_finite() {
        return Ok(None);
    }
    let inverse = Taylor::constant(Interval::point(1.0 / steepness));
    for _ in 0..STEPS {
        root = root.minus(&polynomial.evaluate(&root)?.times(&inverse)?)?.middle();
    }
    let offset = polynomial.evaluate(&root)?.times(&inverse)?.negated().range();
    let mut size = 2.0 * offset.magnitude() + f64::MIN_POSITIVE;
    for _ in 0..WIDER {
        let error = Interval::point(-size).hull(Interval::point(size));
        let near = root.widened(error);
        let contraction = Taylor::whole(1).minus(&slope.evaluate(&near)?.times(&inverse)?)?.range();
        let image = offset + contraction * error;
        if image.is_inside(error) {
            let root = root.widened(image);
            return Ok(is_largest(polynomial, &root)?.then_some(root));
        }
        size *= 4.0;
    }
    Ok(None)
}

/// Whether every derivative is positive at the root.
fn is_largest(polynomial: &Univariate<Taylor>, root: &Taylor) -> Result<bool, Trouble> {
    let mut derivative = polynomial.derivative()?;
    while derivative.degree().is_some_and(|degree| degree > 0) {
        if derivative.evaluate(root)?.sign() != Some(Ordering::Greater) {
            return Ok(false);
        }
        derivative = derivative.derivative()?;
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu_ratio::RBig;

    /// Catmull and Clark's eigenvalue: 16 x^2 - (2 c + 10) x + 1 = 0, with the larger root 1/2 at c = 0.
    #[test]
    fn the_larger_root_of_a_quadratic() {
        let polynomial = |c: &Taylor| {
            let part = Taylor::rational(&(RBig::ONE / RBig::from(16)));
            let middle = c.times(&Taylor::whole(2)).unwrap().plus(&Taylor::whole(10)).unwrap().times(&part).unwrap();
            Univariate::new(vec![part, middle.negated(), Taylor::whole(1)])
        };
        let c = Taylor::variable(-0.125, 0.125);
        let root = largest_root(&polynomial(&c), 0.48).unwrap().unwrap();
        let range = root.range();
        assert!(range.contains(&(RBig::from(1) / RBig::from(2))));
        for (lambda, below) in [(23, 50), (12, 25), (49, 100)] {
            let lambda = RBig::from(lambda) / RBig::from(below);
            let c = RBig::from(8) * &lambda + RBig::ONE / (RBig::from(2) * &lambda) - RBig::from(5);
            assert!(c >= RBig::from(-1) / RBig::from(4) && c <= RBig::ZERO);
            assert!(range.contains(&lambda), "{lambda} {range:?}");
        }
        // (19 + sqrt(105))/64 at c = -1/4, so that the width is near 0.04302
        assert!(range.hi() - range.lo() < 0.045, "{range:?}");
        // the smaller root is not the largest
        assert!(largest_root(&polynomial(&c), 0.13).unwrap().is_none());
    }
}
