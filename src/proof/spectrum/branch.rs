//! How does the largest eigenvalue of a frequency depend on its cosine?
//!
//! It is a root of M(x; y), y being the cosine. On a box of y, with numbers low < high such that M(low; y) < 0 <
//! M(high; y), M_x > 0 > M_y on [low, high] and all other roots smaller than low in modulus, the root of the largest
//! modulus is real, simple, and increases with y (implicit functions). Signs at low and high are needed at one end of
//! the box each, since M decreases with y.

use super::disc::{Number, all_within, between, deflated, is_positive};
use crate::numbers::polynomial::Polynomial;
use crate::numbers::roots::roots;
use crate::numbers::{Field, Free, Trouble, Univariate};
use dashu_int::UBig;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// Steps of Newton's method.
const NEWTON_STEPS: usize = 60;

/// The factor of the characteristic polynomial, with its derivatives.
pub struct Branch {
    polynomial: Univariate<Free>,
    by_root: Univariate<Free>,
    by_cosine: Univariate<Free>,
    variable: usize,
}

/// Numbers between which the largest root lies.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    /// Below the root.
    pub low: RBig,
    /// Above it.
    pub high: RBig,
}

impl Branch {
    /// A monic polynomial over the rational functions of one indeterminate.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn of(polynomial: &Univariate<Free>, variable: usize) -> Result<Branch, Trouble> {
        let by_cosine = polynomial.mapped(|value| derivative(value, variable))?;
        Ok(Branch { by_root: polynomial.derivative()?, by_cosine, polynomial: polynomial.clone(), variable })
    }

    /// Whether the cosine stands in it.
    pub fn is_constant(&self) -> bool {
        self.polynomial.coefficients().iter().all(|value| value.as_rational().is_some())
    }

    /// The polynomial.
    pub fn polynomial(&self) -> &Univariate<Free> {
        &self.polynomial
    }

    /// The polynomial with a cosine put in.
    ///
    /// # Errors
    /// When a denominator may vanish there.
    pub fn at(&self, cosine: &Number) -> Result<Univariate<Number>, Trouble> {
        at_variable(&self.polynomial, self.variable, cosine)
    }

    /// The value M(x; y).
    fn value(&self, x: &RBig, y: &Number) -> Result<Number, Trouble> {
        self.at(y)?.evaluate(&Number::rational(x))
    }

    /// A number certainly below the largest root, at a cosine: M is negative there. The nearer, the larger `bits`.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn below(&self, cosine: &Number, bits: u32) -> Result<Option<RBig>, Trouble> {
        let Some(guess) = approx_largest(&self.at(cosine)?) else { return Ok(None) };
        let low = rounded(guess - 1.5 / (1_u64 << bits) as f64, bits);
        let holds = low > RBig::ZERO && self.value(&low, cosine)?.sign() == Some(Ordering::Less);
        Ok(holds.then_some(low))
    }

    /// Bounds with which the largest root is seen to be simple and increasing on a box of cosines; it may be constant there
    /// unless `strictly`.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn increasing(&self, from: &RBig, to: &RBig, strictly: bool) -> Result<Option<Bounds>, Trouble> {
        let (first, last, all) = (Number::rational(from), Number::rational(to), between(from, to));
        let guesses = (approx_largest(&self.at(&first)?), approx_largest(&self.at(&last)?));
        let (Some(least), Some(most)) = guesses else { return Ok(None) };
        let pad = 1.0 / 4096.0;
        let (low, high) = (rounded(least - pad, 16), rounded(most + pad, 16));
        if low <= RBig::ZERO || low >= high {
            return Ok(None);
        }
        let root = between(&low, &high);
        let slope = |own: &Univariate<Free>| at_variable(own, self.variable, &all)?.evaluate(&root);
        let grows = is_positive(&slope(&self.by_root)?)
            && (self.is_constant() && !strictly || is_positive(&slope(&self.by_cosine)?.negated()));
        let ends = self.value(&low, &first)?.sign() == Some(Ordering::Less) && is_positive(&self.value(&high, &last)?);
        if !grows || !ends || !all_within(&deflated(&self.at(&all)?, &root)?, &Number::rational(&low))? {
            return Ok(None);
        }
        Ok(Some(Bounds { low, high }))
    }
}

/// A polynomial over rational functions with a number put in for an indeterminate.
///
/// # Errors
/// When a denominator may vanish there.
pub fn at_variable(
    polynomial: &Univariate<Free>,
    variable: usize,
    value: &Number,
) -> Result<Univariate<Number>, Trouble> {
    let mut values = vec![Number::whole(0); 6];
    values[variable] = value.clone();
    polynomial.mapped(|coefficient| coefficient.evaluate(&values))
}

/// The derivative of a rational function with respect to an indeterminate.
fn derivative(value: &Free, variable: usize) -> Result<Free, Trouble> {
    let of = |own: &Polynomial| Free::polynomial(own.derivative_in(variable));
    let (above, below) = (Free::polynomial(value.numerator().clone()), Free::polynomial(value.denominator().clone()));
    let top = of(value.numerator()).times(&below)?.minus(&above.times(&of(value.denominator()))?)?;
    top.over(&below.times(&below)?)
}

/// The largest real root, approximately, by Newton's method from above where that gets there: a guess that is never taken
/// on trust.
pub fn approx_largest(polynomial: &Univariate<Number>) -> Option<f64> {
    let approx: Vec<f64> = polynomial.coefficients().iter().map(Number::midpoint_f64).collect();
    if let Some(root) = approx_from_above(&approx) {
        return Some(root);
    }
    let middle = |value: &Number| Number::from_f64(value.midpoint_f64()).ok();
    let coefficients: Vec<Number> = polynomial.coefficients().iter().map(middle).collect::<Option<_>>()?;
    let found = roots(&coefficients).ok()?;
    let real = found.iter().filter(|root| root.im.contains(&RBig::ZERO)).map(|root| root.re.midpoint_f64());
    real.max_by(f64::total_cmp)
}

/// Newton's method from 2 down; `None` where a step goes past a root.
fn approx_from_above(coefficients: &[f64]) -> Option<f64> {
    let mut x = 2.0;
    for _ in 0..NEWTON_STEPS {
        let (mut value, mut slope) = (0.0, 0.0);
        for coefficient in coefficients.iter().rev() {
            slope = slope * x + value;
            value = value * x + coefficient;
        }
        let step: f64 = value / slope;
        if step.abs() < 1e-15 {
            return Some(x - step);
        }
        if !step.is_finite() || value < 0.0 || slope < 0.0 {
            return None;
        }
        x -= step;
    }
    None
}

/// The largest modulus of the roots, approximately.
pub fn approx_largest_modulus(polynomial: &Univariate<Number>) -> Option<f64> {
    let middle = |value: &Number| Number::from_f64(value.midpoint_f64()).ok();
    let coefficients: Vec<Number> = polynomial.coefficients().iter().map(middle).collect::<Option<_>>()?;
    let found = roots(&coefficients).ok()?;
    let square = |value: f64| value * value;
    let moduli = found.iter().map(|root| (square(root.re.midpoint_f64()) + square(root.im.midpoint_f64())).sqrt());
    moduli.max_by(f64::total_cmp)
}

/// The multiple of 2^-bits below a number.
pub fn rounded(value: f64, bits: u32) -> RBig {
    let scaled = (value * (1_u64 << bits) as f64).floor();
    let whole = if scaled.abs() < 9e15 { scaled as i64 } else { 0 };
    RBig::from(whole) / RBig::from(UBig::ONE << bits as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::C;

    fn part(above: i64, below: i64) -> RBig {
        RBig::from(above) / RBig::from(below)
    }

    /// (x - a - b y)(x - 1/16).
    fn branch(a: RBig, b: RBig) -> Branch {
        let root = Free::rational(&a).plus(&Free::rational(&b).times(&Free::variable(C)).unwrap()).unwrap();
        let linear = |root: &Free| Univariate::new(vec![root.negated(), Free::whole(1)]);
        let product = linear(&root).times(&linear(&Free::rational(&part(1, 16)))).unwrap();
        Branch::of(&product, C).unwrap()
    }

    #[test]
    fn increasing_decreasing_and_constant_roots_are_told_apart() {
        let (half, one) = (part(1, 2), RBig::ONE);
        let found = |a, b, strictly| branch(a, b).increasing(&half, &one, strictly).unwrap();
        let bounds = found(part(3, 8), part(1, 4), true).unwrap();
        assert!(bounds.low < half && bounds.high > part(5, 8), "{bounds:?}");
        assert_eq!(found(part(5, 8), part(-1, 4), false), None);
        assert_eq!(found(part(1, 2), RBig::ZERO, true), None);
        assert!(found(part(1, 2), RBig::ZERO, false).is_some());
    }

    /// The larger root of (x - y)(x - 1/16) is the second one up to y = 1/16, and y from there on.
    #[test]
    fn roots_that_change_places_are_no_branch() {
        assert_eq!(branch(RBig::ZERO, RBig::ONE).increasing(&part(-1, 1), &RBig::ONE, false).unwrap(), None);
    }

    #[test]
    fn a_bound_is_below_the_root() {
        let low = branch(part(3, 8), part(1, 4)).below(&Number::rational(&part(1, 2)), 20).unwrap().unwrap();
        assert!(low < part(1, 2) && low > part(1, 2) - part(1, 1 << 18));
    }
}
