//! Is a rational function positive on an interval?
//!
//! Exactly, by Bernstein coefficients: a polynomial on [a, b] is a convex combination of them, so that it is positive where they
//! are (Farouki 2012). Where they are not, the interval is halved.

use crate::numbers::{Quotient, Trouble, Univariate};
use dashu_ratio::RBig;

/// A closed interval of rational numbers, low end first.
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    /// The low end.
    pub low: RBig,
    /// The high end.
    pub high: RBig,
}

/// How often an interval is halved.
const MOST_HALVINGS: usize = 12;

/// The Bernstein coefficients of a polynomial on an interval; empty for zero.
///
/// # Errors
/// When a limit of size is passed.
pub fn bernstein(polynomial: &Univariate<RBig>, on: &Interval) -> Result<Vec<RBig>, Trouble> {
    let Some(degree) = polynomial.degree() else { return Ok(vec![]) };
    let inner = Univariate::new(vec![on.low.clone(), &on.high - &on.low]);
    let mut moved = Univariate::new(vec![]);
    for coefficient in polynomial.coefficients().iter().rev() {
        moved = moved.times(&inner)?.plus(&Univariate::constant(coefficient.clone()))?;
    }
    let power = |i: usize| moved.coefficients().get(i).cloned().unwrap_or(RBig::ZERO);
    let share = |k: usize, i: usize| binomial(k, i) / binomial(degree, i) * power(i);
    Ok((0..=degree).map(|k| (0..=k).fold(RBig::ZERO, |sum, i| sum + share(k, i))).collect())
}

/// Whether a polynomial is seen to be positive on a closed interval; `false` may mean that it was not seen.
///
/// # Errors
/// When a limit of size is passed.
pub fn is_positive(polynomial: &Univariate<RBig>, on: &Interval) -> Result<bool, Trouble> {
    halving(polynomial, on, MOST_HALVINGS)
}

fn halving(polynomial: &Univariate<RBig>, on: &Interval, left: usize) -> Result<bool, Trouble> {
    let coefficients = bernstein(polynomial, on)?;
    let positive = |value: &RBig| *value > RBig::ZERO;
    if !coefficients.first().is_some_and(positive) || !coefficients.last().is_some_and(positive) {
        return Ok(false);
    }
    if coefficients.iter().all(positive) {
        return Ok(true);
    }
    if left == 0 {
        return Ok(false);
    }
    let middle = (&on.low + &on.high) / RBig::from(2);
    let (low, high) = (on.low.clone(), on.high.clone());
    Ok(halving(polynomial, &Interval { low, high: middle.clone() }, left - 1)?
        && halving(polynomial, &Interval { low: middle, high }, left - 1)?)
}

/// Whether a quotient is seen to be positive, and without a pole, on a closed interval.
///
/// # Errors
/// When a limit of size is passed.
pub fn is_positive_quotient(value: &Quotient<RBig>, on: &Interval) -> Result<bool, Trouble> {
    is_positive(&value.numerator().times(value.denominator())?, on)
}

/// n choose k.
pub fn binomial(n: usize, k: usize) -> RBig {
    (0..k.min(n)).fold(RBig::ONE, |product, i| product * RBig::from(n - i) / RBig::from(i + 1))
        * RBig::from(usize::from(k <= n))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Field;

    fn whole(values: &[i64]) -> Univariate<RBig> {
        Univariate::new(values.iter().map(|value| RBig::from(*value)).collect())
    }

    fn unit() -> Interval {
        Interval { low: RBig::ZERO, high: RBig::ONE }
    }

    #[test]
    fn a_zero_inside_or_at_an_end_is_never_passed() {
        // (2 x - 1)^2, x, 1 - x, (3 x - 1)^2 - 1/1000000
        assert!(!is_positive(&whole(&[1, -4, 4]), &unit()).unwrap());
        assert!(!is_positive(&whole(&[0, 1]), &unit()).unwrap());
        assert!(!is_positive(&whole(&[1, -1]), &unit()).unwrap());
        assert!(!is_positive(&whole(&[999_999, -6_000_000, 9_000_000]), &unit()).unwrap());
        assert!(!is_positive(&whole(&[]), &unit()).unwrap());
    }

    #[test]
    fn a_positive_polynomial_with_a_negative_coefficient_is_seen_by_halving() {
        // (2 x - 1)^2 + 1/10
        let value = whole(&[11, -40, 40]);
        assert!(bernstein(&value, &unit()).unwrap().iter().any(|own| *own < RBig::ZERO));
        assert!(is_positive(&value, &unit()).unwrap());
    }

    #[test]
    fn a_pole_is_not_positive() {
        // 1/(x - 1/2)^2
        let x =
            Quotient::<RBig>::variable().minus(&Quotient::rational(&RBig::from_parts(1.into(), 2u8.into()))).unwrap();
        let value = Quotient::whole(1).over(&x.times(&x).unwrap()).unwrap();
        assert!(!is_positive_quotient(&value, &unit()).unwrap());
    }
}
