//! Has a formula a value at every valence?
//!
//! The arithmetic of [`Laurent`], which cancels what stands above and below, without its freedom to divide by anything: a divisor has to be seen to vanish
//! at no whole number n >= 3, and the argument of a root to be a number that is not negative. Equalities that are shown for
//! all n hold where both sides are defined; a formula that has a value here is defined at all of them.

use super::{Field, Function, Laurent, Number, Trouble};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// A value in n (the name `n`) and j that has one at every n >= 3.
#[derive(Clone, Debug, PartialEq)]
pub struct Total(pub Laurent);

/// Divisors whose zeros may be larger are not looked at.
const LARGEST_ZERO: i64 = 10_000;

const MAY_VANISH: Trouble = Trouble::BeyondThisWorld("a divisor may be 0 at some n");
const MAY_BE_NEGATIVE: Trouble = Trouble::BeyondThisWorld("a root of what may be negative at some n");

/// Whether a value is a polynomial in n, times a power of n, without a zero at any n >= 3.
fn never_vanishes(value: &Laurent) -> bool {
    let Some(powers) = value.powers_of("n") else { return false };
    let least = powers.iter().map(|(exponent, _)| *exponent).min().unwrap_or(0);
    let Some((_, leading)) = powers.iter().max_by_key(|(exponent, _)| *exponent) else { return false };
    // Cauchy's bound
    let ratios = powers.iter().map(|(_, coefficient)| ratio_of_moduli(coefficient, leading));
    let bound = ratios.max().unwrap_or(RBig::ZERO) + RBig::ONE;
    if bound > RBig::from(LARGEST_ZERO) {
        return false;
    }
    let at = |n: i64| {
        let power = |exponent: i64| (least..exponent).fold(RBig::ONE, |product, _| product * RBig::from(n));
        powers.iter().fold(RBig::ZERO, |sum, (exponent, coefficient)| sum + coefficient * power(*exponent))
    };
    (3..=LARGEST_ZERO).take_while(|n| RBig::from(*n) <= bound).all(|n| at(n) != RBig::ZERO)
}

fn ratio_of_moduli(a: &RBig, b: &RBig) -> RBig {
    let ratio = a / b;
    if ratio < RBig::ZERO { -ratio } else { ratio }
}

impl Field for Total {
    fn rational(value: &RBig) -> Self {
        Total(Laurent::rational(value))
    }

    fn negated(&self) -> Self {
        Total(self.0.negated())
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        self.0.plus(&other.0).map(Total)
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        self.0.times(&other.0).map(Total)
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        if never_vanishes(&other.0) { self.0.over(&other.0).map(Total) } else { Err(MAY_VANISH) }
    }

    fn is_certainly_zero(&self) -> bool {
        self.0.is_certainly_zero()
    }
}

impl Number for Total {
    fn pi() -> Self {
        Total(Laurent::pi())
    }

    fn power(&self, exponent: &Self) -> Result<Self, Trouble> {
        let positive = exponent.0.as_constant().is_some_and(|own| own >= RBig::ZERO);
        if positive || never_vanishes(&self.0) { self.0.power(&exponent.0).map(Total) } else { Err(MAY_VANISH) }
    }

    fn call(function: Function, arguments: &[Self]) -> Result<Self, Trouble> {
        let inner: Vec<Laurent> = arguments.iter().map(|own| own.0.clone()).collect();
        let is_number = inner.iter().all(|own| own.as_constant().is_some());
        if function == Function::Sqrt && !is_number {
            return Err(MAY_BE_NEGATIVE);
        }
        Laurent::call(function, &inner).map(Total)
    }

    fn order(&self, other: &Self) -> Option<Ordering> {
        self.0.order(&other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn n(plus: i64) -> Total {
        Total(Laurent::atom("n")).plus(&Total::whole(plus)).unwrap()
    }

    #[test]
    fn divisors_without_a_zero_at_a_valence_will_do() {
        let one = Total::whole(1);
        for divisor in [
            n(0),
            n(5),
            n(-2),
            n(0).times(&n(0)).unwrap(),
            n(0).times(&Total::whole(2)).unwrap().plus(&Total::whole(-19)).unwrap(),
        ] {
            assert!(one.over(&divisor).is_ok(), "{divisor:?}");
        }
        let cosine = Total::call(Function::Cos, &[one.over(&n(0)).unwrap()]).unwrap();
        for divisor in [n(-3), n(-50), n(-13).times(&n(4)).unwrap(), cosine, Total::whole(0), n(-20_000)] {
            assert!(one.over(&divisor).is_err(), "{divisor:?}");
            assert!(divisor.over(&divisor).is_err() && divisor.power(&Total::whole(-1)).is_err());
        }
        assert!(
            Total::call(Function::Sqrt, &[n(0)]).is_err() && Total::call(Function::Sqrt, &[Total::whole(2)]).is_ok()
        );
    }
}
