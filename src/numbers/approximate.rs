//! What is the value of a formula, approximately?
//!
//! `f64` without error bounds. Cosine and sine are those of the `libm` crate, so that results don't depend on the
//! machine's C library. Every operation refuses a result that is not finite: NaN never travels.

use super::{Field, Function, Literal, Number, Trouble};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// The largest upper argument of a binomial coefficient (a limit, not a theorem: larger ones overflow or say nothing).
const MAX_BINOM: f64 = 1000.0;

fn finite(value: f64) -> Result<f64, Trouble> {
    if value.is_finite() { Ok(value) } else { Err(Trouble::NotFinite) }
}

fn binomial(n: f64, k: f64) -> Result<f64, Trouble> {
    if n.fract() != 0.0 || k.fract() != 0.0 || !(0.0..=MAX_BINOM).contains(&n) {
        return Err(Trouble::Domain("binom(a, b) takes whole numbers, 0 <= a <= 1000"));
    }
    if k < 0.0 || k > n {
        return Ok(0.0);
    }
    let k = k.min(n - k) as u32;
    finite((0..k).fold(1.0, |product, i| product * (n - f64::from(i)) / (f64::from(i) + 1.0)).round())
}

impl Field for f64 {
    const EXACT: bool = false;

    fn rational(value: &RBig) -> Self {
        value.to_f64().value()
    }

    fn whole(value: i64) -> Self {
        value as f64
    }

    fn negated(&self) -> Self {
        -self
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        finite(self + other)
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        finite(self * other)
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        if *other == 0.0 { Err(Trouble::DivisionByZero) } else { finite(self / other) }
    }

    fn is_certainly_zero(&self) -> bool {
        *self == 0.0
    }
}

impl Number for f64 {
    fn literal(literal: &Literal) -> Self {
        literal.approx
    }

    fn pi() -> Self {
        std::f64::consts::PI
    }

    fn power(&self, exponent: &Self) -> Result<Self, Trouble> {
        if *self == 0.0 && *exponent < 0.0 {
            return Err(Trouble::DivisionByZero);
        }
        finite(libm::pow(*self, *exponent))
    }

    fn call(function: Function, arguments: &[Self]) -> Result<Self, Trouble> {
        let [first, rest @ ..] = arguments else {
            return Err(Trouble::Domain("a function needs an argument"));
        };
        let second = rest.first().copied().unwrap_or(0.0);
        match function {
            Function::Cos => finite(libm::cos(*first)),
            Function::Sin => finite(libm::sin(*first)),
            Function::Sqrt if *first < 0.0 => Err(Trouble::NegativeRoot),
            Function::Sqrt => finite(first.sqrt()),
            Function::Binom => binomial(*first, second),
            Function::Min => Ok(first.min(second)),
            Function::Max => Ok(first.max(second)),
        }
    }

    fn order(&self, other: &Self) -> Option<Ordering> {
        // sides that rounding alone may have parted are not ordered
        let near = (self - other).abs() <= 1e-12 * self.abs().max(other.abs()).max(1.0);
        if near && self != other { None } else { self.partial_cmp(other) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn binomial_coefficients_fill_pascals_triangle() {
        for n in 1..40 {
            for k in 1..=n {
                let (n, k) = (f64::from(n), f64::from(k));
                let sum = binomial(n - 1.0, k - 1.0).unwrap() + binomial(n - 1.0, k).unwrap();
                assert_eq!(binomial(n, k).unwrap(), sum);
            }
        }
        assert!(binomial(0.5, 1.0).is_err());
    }

    #[test]
    fn nothing_that_is_not_finite_comes_out() {
        assert_eq!(1.0.over(&0.0), Err(Trouble::DivisionByZero));
        assert_eq!(0.0.power(&-1.0), Err(Trouble::DivisionByZero));
        assert_eq!(10.0.power(&400.0), Err(Trouble::NotFinite));
        assert_eq!((-8.0).power(&(1.0 / 3.0)), Err(Trouble::NotFinite));
        assert_eq!(f64::call(Function::Sqrt, &[-1.0]), Err(Trouble::NegativeRoot));
        assert_eq!(1e300.times(&1e300), Err(Trouble::NotFinite));
    }
}
