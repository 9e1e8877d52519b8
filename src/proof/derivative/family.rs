//! What is a rational function of p on a small interval?
//!
//! With p = m + h a polynomial in h of a fixed degree and a remainder. For N/D with T the polynomial's coefficients,
//! N - T D = h^(d + 1) E, so that the remainder is h^(d + 1) E/D, which is enclosed as it stands. For a polynomial D
//! = 1, and E is what T leaves out.

use crate::numbers::{Interval, Univariate};
use crate::proof::net::Function;
use dashu_ratio::RBig;

/// The degree d.
const ORDER: usize = 5;

/// An interval of the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The low end.
    pub low: f64,
    /// The high end.
    pub high: f64,
}

impl Range {
    /// Its middle, and a bound of the distance of its members from there.
    fn middle_and_reach(self) -> (f64, f64) {
        let all = Interval::new(self.low, self.high).unwrap_or(Interval::REALS);
        (all.middle(), all.radius())
    }

    /// Both halves.
    pub fn halves(self) -> [Range; 2] {
        let (middle, _) = self.middle_and_reach();
        [Range { high: middle, ..self }, Range { low: middle, ..self }]
    }

    /// The range of the factor of each of the [`Range::coefficients`]: 1, h, ..., h^d, and 1 for the remainder.
    pub fn powers(self) -> Vec<Interval> {
        let reach = Interval::point(self.middle_and_reach().1);
        let mut powers = powers(reach, ORDER + 1);
        powers.push(Interval::point(1.0));
        powers
    }

    /// The coefficients of a function, and its remainder.
    pub fn coefficients(self, function: &Function) -> Vec<Interval> {
        let (middle, reach) = self.middle_and_reach();
        let (above, below) = (shifted(function.numerator(), middle), shifted(function.denominator(), middle));
        let at = |values: &[Interval], k: usize| values.get(k).copied().unwrap_or(Interval::ZERO);
        let mut taylor: Vec<Interval> = Vec::with_capacity(ORDER + 2);
        // the coefficient k of N - T D
        let rest = |taylor: &[Interval], k: usize| {
            let product = (0..taylor.len().min(k + 1)).map(|j| taylor[j] * at(&below, k - j));
            product.fold(at(&above, k), |sum, own| sum - own)
        };
        let constant = at(&below, 0);
        for k in 0..=ORDER {
            let own = rest(&taylor, k);
            taylor.push(if below.len() == 1 { own } else { own / constant });
        }
        let last = above.len().max(below.len() + ORDER);
        let powers = powers(Interval::point(reach), last.max(ORDER + 1));
        let left = (ORDER + 1..last).fold(Interval::ZERO, |sum, k| sum + rest(&taylor, k) * powers[k]);
        let whole = (0..below.len()).fold(Interval::ZERO, |sum, k| sum + below[k] * powers[k]);
        let exact = below.len() == 1 || left == Interval::ZERO;
        taylor.push(if exact { left } else { left / whole });
        taylor
    }
}

/// The ranges of h^0, ..., h^(count - 1) for |h| <= reach.
fn powers(reach: Interval, count: usize) -> Vec<Interval> {
    let mut largest = Interval::point(1.0);
    let mut powers = Vec::with_capacity(count);
    for k in 0..count {
        let own = if k % 2 == 0 { Interval::ZERO.hull(largest) } else { (-largest).hull(largest) };
        powers.push(if k == 0 { largest } else { own });
        largest = largest * reach;
    }
    powers
}

/// The coefficients of N(m + h), of which the leading one stays: those of a monic polynomial of degree 0 are 1.
fn shifted(polynomial: &Univariate<RBig>, middle: f64) -> Vec<Interval> {
    let mut values: Vec<Interval> = polynomial.coefficients().iter().map(Interval::around).collect();
    let size = values.len();
    for start in 0..size {
        for k in (start..size.saturating_sub(1)).rev() {
            values[k] = values[k] + values[k + 1] * Interval::point(middle);
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Field;

    fn rational(above: i64, below: i64) -> RBig {
        RBig::from(above) / RBig::from(below)
    }

    fn exact(polynomial: &Univariate<RBig>, at: &RBig) -> RBig {
        polynomial.coefficients().iter().rev().fold(RBig::ZERO, |sum, own| sum * at + own)
    }

    /// Exact values of functions inside a range lie in their enclosures, at the ends, too; and these are narrow.
    #[test]
    fn expansions_hold_exact_values() {
        let p = Function::variable();
        let whole = Function::whole;
        let power = |k: usize| (0..k).fold(whole(1), |product, _| product.times(&p).unwrap());
        let polynomial = power(9).minus(&power(4).times(&whole(3)).unwrap()).unwrap().plus(&p).unwrap();
        let quotient = polynomial.over(&power(2).plus(&p).unwrap().plus(&whole(3)).unwrap()).unwrap();
        let simple = whole(1).over(&p.plus(&whole(2)).unwrap()).unwrap();
        for (low, high) in [(-0.5, -0.3), (0.0, 0.125), (0.9, 1.0), (0.4, 0.4)] {
            let range = Range { low, high };
            let middle = RBig::try_from(range.middle_and_reach().0).unwrap();
            for function in [&polynomial, &quotient, &simple, &p, &whole(7)] {
                let coefficients = range.coefficients(function);
                assert_eq!(coefficients.len(), range.powers().len());
                for step in 0..=8 {
                    let (a, b) = (RBig::try_from(low).unwrap(), RBig::try_from(high).unwrap());
                    let at = &a + (&b - &a) * rational(step, 8);
                    let h = Interval::around(&(&at - &middle));
                    let (mut power, mut sum) = (Interval::point(1.0), coefficients[ORDER + 1]);
                    for (coefficient, range) in coefficients.iter().zip(range.powers()).take(ORDER + 1) {
                        assert!(range.lo() <= power.hi() && power.lo() <= range.hi());
                        sum = sum + *coefficient * power;
                        power = power * h;
                    }
                    let value = exact(function.numerator(), &at) / exact(function.denominator(), &at);
                    assert!(sum.contains(&value), "{range:?} {step}");
                    assert!(sum.hi() - sum.lo() < 1e-4, "{range:?} {step}");
                }
            }
        }
    }

    /// 1/p has a pole at 0.
    #[test]
    fn a_pole_is_all_numbers() {
        let inverse = Function::whole(1).over(&Function::variable()).unwrap();
        let last = Range { low: -0.5, high: 0.25 }.coefficients(&inverse).pop().unwrap();
        assert_eq!(last, Interval::REALS);
    }
}
