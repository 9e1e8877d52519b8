//! What are the rational functions of the valence, the cosines and the parameters?
//!
//! The *free world*: quotients of polynomials over Q in indeterminates without relations. An identity in it holds for
//! every value at which both sides are defined. Sums by Henrici (1956), who takes greatest common divisors of small
//! polynomials only.

use crate::numbers::polynomial::Polynomial;
use crate::numbers::{Field, Trouble};
use dashu_ratio::RBig;

/// A quotient of polynomials in lowest terms. The denominator is primitive, so that equal quotients have equal forms.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Free {
    numerator: Polynomial,
    denominator: Polynomial,
}

impl Free {
    /// The quotient of two polynomials.
    ///
    /// # Errors
    /// When the denominator is zero, or the polynomials are too large.
    pub fn new(numerator: &Polynomial, denominator: &Polynomial) -> Result<Self, Trouble> {
        if denominator.is_zero() {
            return Err(Trouble::DivisionByZero);
        }
        let shared = numerator.gcd(denominator)?;
        Free::reduced(divided(numerator, &shared)?, divided(denominator, &shared)?)
    }

    /// A polynomial.
    pub fn polynomial(numerator: Polynomial) -> Self {
        Free { numerator, denominator: Polynomial::whole(1) }
    }

    /// The indeterminate of this index; zero if there is none.
    pub fn variable(index: usize) -> Self {
        Free::polynomial(Polynomial::variable(index))
    }

    /// The polynomial above, with the rational content.
    pub fn numerator(&self) -> &Polynomial {
        &self.numerator
    }

    /// The polynomial below, which is primitive.
    pub fn denominator(&self) -> &Polynomial {
        &self.denominator
    }

    /// The rational number that this is, if it is one.
    pub fn as_rational(&self) -> Option<RBig> {
        self.as_polynomial().and_then(Polynomial::as_constant)
    }

    /// The polynomial that this is, if it is one.
    pub fn as_polynomial(&self) -> Option<&Polynomial> {
        self.denominator.as_constant().map(|_| &self.numerator)
    }

    /// Whether an indeterminate stands in it.
    pub fn mentions(&self, index: usize) -> bool {
        self.numerator.mentions(index) || self.denominator.mentions(index)
    }

    /// This with a rational number for an indeterminate.
    ///
    /// # Errors
    /// When the denominator vanishes there, or the result is too large.
    pub fn at(&self, index: usize, value: &RBig) -> Result<Self, Trouble> {
        if !self.mentions(index) {
            return Ok(self.clone());
        }
        Free::new(&self.numerator.at(index, value)?, &self.denominator.at(index, value)?)
    }

    /// This with another quotient for an indeterminate.
    ///
    /// # Errors
    /// When the denominator vanishes there, or the result is too large.
    pub fn substituted(&self, index: usize, value: &Free) -> Result<Self, Trouble> {
        let insert = |p: &Polynomial| {
            let coefficients = p.coefficients_in(index).into_iter().rev();
            let zero = Free::whole(0);
            coefficients.map(Free::polynomial).try_fold(zero, |sum, c| sum.times(value)?.plus(&c))
        };
        insert(&self.numerator)?.over(&insert(&self.denominator)?)
    }

    /// The value in a world of numbers.
    ///
    /// # Errors
    /// When the denominator vanishes, there are too few values, or the result is beyond their world.
    pub fn evaluate<F: Field>(&self, values: &[F]) -> Result<F, Trouble> {
        let numerator = self.numerator.evaluate(values)?;
        if self.as_polynomial().is_some() {
            return Ok(numerator);
        }
        numerator.over(&self.denominator.evaluate(values)?)
    }

    /// The quotient of polynomials without common factors.
    fn reduced(numerator: Polynomial, denominator: Polynomial) -> Result<Self, Trouble> {
        if numerator.is_zero() {
            return Ok(Free::polynomial(numerator));
        }
        if denominator.content().is_one() {
            return Ok(Free { numerator, denominator });
        }
        let scale = RBig::ONE / denominator.content();
        Ok(Free { numerator: numerator.scaled(&scale), denominator: denominator.primitive() })
    }
}

/// The quotient by a divisor.
fn divided(p: &Polynomial, divisor: &Polynomial) -> Result<Polynomial, Trouble> {
    if divisor.len() == 1 && divisor.total_degree() == 0 {
        return Ok(p.scaled(&(RBig::ONE / divisor.content())));
    }
    p.divided_exactly(divisor).ok_or(Trouble::BeyondThisWorld("the exact form is too large to hold"))
}

impl Field for Free {
    fn rational(value: &RBig) -> Self {
        Free::polynomial(Polynomial::constant(value.clone()))
    }

    fn negated(&self) -> Self {
        Free { numerator: self.numerator.negated(), denominator: self.denominator.clone() }
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        if self.numerator.is_zero() {
            return Ok(other.clone());
        }
        let shared = self.denominator.gcd(&other.denominator)?;
        let left = divided(&self.denominator, &shared)?;
        let right = divided(&other.denominator, &shared)?;
        let sum = self.numerator.times(&right)?.plus(&other.numerator.times(&left)?)?;
        let common = sum.gcd(&shared)?;
        let denominator = divided(&other.denominator, &common)?.times(&left)?;
        Free::reduced(divided(&sum, &common)?, denominator)
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        if self.numerator.is_zero() || other.numerator.is_zero() {
            return Ok(Free::whole(0));
        }
        let left = self.numerator.gcd(&other.denominator)?;
        let right = other.numerator.gcd(&self.denominator)?;
        let numerator = divided(&self.numerator, &left)?.times(&divided(&other.numerator, &right)?)?;
        let denominator = divided(&self.denominator, &right)?.times(&divided(&other.denominator, &left)?)?;
        Free::reduced(numerator, denominator)
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        if other.numerator.is_zero() {
            return Err(Trouble::DivisionByZero);
        }
        self.times(&Free::reduced(other.denominator.clone(), other.numerator.clone())?)
    }

    fn is_certainly_zero(&self) -> bool {
        self.numerator.is_zero()
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::numbers::polynomial::tests::{ratio, small};
    use proptest::prelude::*;

    pub(crate) fn fraction() -> impl Strategy<Value = Free> {
        let pair = (small(), small()).prop_filter("a denominator", |(_, d)| !d.is_zero());
        pair.prop_map(|(a, b)| Free::new(&a, &b).unwrap())
    }

    proptest! {
        #[test]
        fn field_laws(a in fraction(), b in fraction(), c in fraction()) {
            let sum = a.plus(&b).unwrap();
            prop_assert_eq!(&sum, &b.plus(&a).unwrap());
            prop_assert_eq!(sum.minus(&b).unwrap(), a.clone());
            let spread = a.times(&c).unwrap().plus(&b.times(&c).unwrap()).unwrap();
            prop_assert_eq!(sum.times(&c).unwrap(), spread);
            if b.is_certainly_zero() {
                prop_assert_eq!(a.over(&b), Err(Trouble::DivisionByZero));
            } else {
                prop_assert_eq!(a.over(&b).unwrap().times(&b).unwrap(), a);
            }
        }

        #[test]
        fn values_agree(a in fraction(), b in fraction(), x in -5i64..6) {
            let point = [Free::rational(&ratio(x, 3)), Free::rational(&ratio(2, 7))];
            if let (Ok(p), Ok(q)) = (a.evaluate(&point), b.evaluate(&point)) {
                prop_assert_eq!(a.times(&b).unwrap().evaluate(&point).unwrap(), p.times(&q).unwrap());
                prop_assert_eq!(a.plus(&b).unwrap().evaluate(&point).unwrap(), p.plus(&q).unwrap());
                let step = a.at(0, &ratio(x, 3)).and_then(|value| value.at(1, &ratio(2, 7)));
                prop_assert_eq!(step.unwrap_or(p.clone()), p);
            }
        }
    }

    #[test]
    fn poles_are_told() {
        let n = Free::variable(0);
        let value = Free::whole(1).over(&n.minus(&Free::whole(5)).unwrap()).unwrap();
        assert_eq!(value.at(0, &ratio(5, 1)), Err(Trouble::DivisionByZero));
        assert_eq!(value.at(0, &ratio(7, 1)).unwrap().as_rational(), Some(ratio(1, 2)));
        assert_eq!(value.substituted(0, &n.plus(&Free::whole(5)).unwrap()), Free::whole(1).over(&n));
        assert!(value.mentions(0) && !value.mentions(1));
    }
}
