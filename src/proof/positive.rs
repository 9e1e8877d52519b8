//! Is a rational function positive on an interval?
//!
//! Exactly, by Bernstein coefficients: a polynomial on [a, b] is a convex combination of them, so that it is positive where they
//! are (Farouki 2012). Where they are not, the interval is halved.

use crate::numbers::{Quotient, Trouble, Univariate};
use dashu_base::Gcd;
use dashu_int::{IBig, UBig};
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

/// The Bernstein coefficients of a polynomial on an interval, times a common positive number that makes them whole; empty for zero.
pub fn bernstein(polynomial: &Univariate<RBig>, on: &Interval) -> Vec<IBig> {
    let Some(degree) = polynomial.degree() else { return vec![] };
    let width = &on.high - &on.low;
    let unit = common_denominator([&on.low, &width]);
    let (low, width, unit) = (whole(&on.low, &unit), whole(&width, &unit), IBig::from(unit));
    // of unit^degree times the polynomial of (low + width t)/unit
    let scale = common_denominator(polynomial.coefficients());
    let (mut moved, mut power) = (vec![], IBig::ONE);
    for coefficient in polynomial.coefficients().iter().rev() {
        moved.push(IBig::ZERO);
        for k in (0..moved.len()).rev() {
            let before = if k > 0 { &moved[k - 1] * &width } else { whole(coefficient, &scale) * &power };
            moved[k] = &moved[k] * &low + before;
        }
        power *= &unit;
    }
    // differences of the coefficients, times degree!: of these the coefficients are sums
    let mut factorials = vec![IBig::ONE];
    (1..=degree).for_each(|k| factorials.push(&factorials[k - 1] * IBig::from(k)));
    let mut sums: Vec<IBig> =
        moved.iter().enumerate().map(|(i, own)| own * &factorials[i] * &factorials[degree - i]).collect();
    for first in (0..degree).rev() {
        for k in first + 1..=degree {
            sums[k] = &sums[k] + &sums[k - 1];
        }
    }
    sums
}

fn common_denominator<'v>(values: impl IntoIterator<Item = &'v RBig>) -> UBig {
    values.into_iter().fold(UBig::ONE, |all, own| &all / (&all).gcd(own.denominator()) * own.denominator())
}

/// A number times a multiple of its denominator.
fn whole(value: &RBig, multiple: &UBig) -> IBig {
    value.numerator() * IBig::from(multiple / value.denominator())
}

/// Whether a polynomial is seen to be positive on a closed interval; `false` may mean that it was not seen.
pub fn is_positive(polynomial: &Univariate<RBig>, on: &Interval) -> bool {
    halving(polynomial, on, MOST_HALVINGS)
}

fn halving(polynomial: &Univariate<RBig>, on: &Interval, left: usize) -> bool {
    let coefficients = bernstein(polynomial, on);
    let positive = |value: &IBig| *value > IBig::ZERO;
    if !coefficients.first().is_some_and(positive) || !coefficients.last().is_some_and(positive) {
        return false;
    }
    if coefficients.iter().all(positive) || left == 0 {
        return coefficients.iter().all(positive);
    }
    let middle = (&on.low + &on.high) / RBig::from(2);
    let (low, high) = (on.low.clone(), on.high.clone());
    halving(polynomial, &Interval { low, high: middle.clone() }, left - 1)
        && halving(polynomial, &Interval { low: middle, high }, left - 1)
}

/// Whether a quotient is seen to be positive, and without a pole, on a closed interval.
///
/// # Errors
/// When a limit of size is passed.
pub fn is_positive_quotient(value: &Quotient<RBig>, on: &Interval) -> Result<bool, Trouble> {
    Ok(is_positive(&value.numerator().times(value.denominator())?, on))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Field;

    fn integers(values: &[i64]) -> Univariate<RBig> {
        Univariate::new(values.iter().map(|value| RBig::from(*value)).collect())
    }

    fn unit() -> Interval {
        Interval { low: RBig::ZERO, high: RBig::ONE }
    }

    #[test]
    fn a_zero_inside_or_at_an_end_is_never_passed() {
        // (2 x - 1)^2, x, 1 - x, (3 x - 1)^2 - 1/1000000
        assert!(!is_positive(&integers(&[1, -4, 4]), &unit()));
        assert!(!is_positive(&integers(&[0, 1]), &unit()));
        assert!(!is_positive(&integers(&[1, -1]), &unit()));
        assert!(!is_positive(&integers(&[999_999, -6_000_000, 9_000_000]), &unit()));
        assert!(!is_positive(&integers(&[]), &unit()));
    }

    #[test]
    fn a_positive_polynomial_with_a_negative_coefficient_is_seen_by_halving() {
        // (2 x - 1)^2 + 1/10
        let value = integers(&[11, -40, 40]);
        assert!(bernstein(&value, &unit()).iter().any(|own| *own < IBig::ZERO));
        assert!(is_positive(&value, &unit()));
    }

    #[test]
    fn a_pole_is_not_positive() {
        // 1/(x - 1/2)^2
        let x =
            Quotient::<RBig>::variable().minus(&Quotient::rational(&RBig::from_parts(1.into(), 2u8.into()))).unwrap();
        let value = Quotient::whole(1).over(&x.times(&x).unwrap()).unwrap();
        assert!(!is_positive_quotient(&value, &unit()).unwrap());
    }

    /// Their polynomial in Bernstein form has the values of the one that they are made from, but for a common factor.
    #[test]
    fn coefficients_are_those_of_the_polynomial() {
        let ratio = |a: i64, b: i64| RBig::from(a) / RBig::from(b);
        let value = Univariate::new(vec![ratio(3, 7), ratio(-5, 2), ratio(1, 3), RBig::from(4), ratio(-9, 5)]);
        let on = Interval { low: ratio(-2, 3), high: ratio(5, 4) };
        let coefficients = bernstein(&value, &on);
        let factor = |t: RBig| {
            let (mut sum, mut binomial) = (RBig::ZERO, RBig::ONE);
            for (k, own) in coefficients.iter().enumerate() {
                sum += &binomial * RBig::from(own.clone()) * t.pow(k as isize) * (RBig::ONE - &t).pow(4 - k as isize);
                binomial = binomial * RBig::from(4 - k) / RBig::from(k + 1);
            }
            sum / value.evaluate(&(&on.low + t * (&on.high - &on.low))).unwrap()
        };
        let first = factor(RBig::ZERO);
        assert!(first > RBig::ZERO);
        assert!((1..=7).all(|i| factor(ratio(i, 7)) == first));
    }
}
