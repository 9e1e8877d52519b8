//! What are the rational functions of one parameter, over a field of numbers?
//!
//! Quotients of polynomials in lowest terms, the denominator monic; so equal quotients have equal forms.

use super::univariate::Univariate;
use super::{AtValence, Cosine, Field, Trouble};
use crate::numbers::world::{Angle, World};
use dashu_ratio::RBig;

/// The largest degree that is held.
const MAX_DEGREE: usize = 120;

/// A quotient of polynomials in lowest terms.
#[derive(Clone, Debug, PartialEq)]
pub struct Quotient<F> {
    numerator: Univariate<F>,
    denominator: Univariate<F>,
}

impl<F: Field> Quotient<F> {
    /// A number.
    pub fn constant(value: F) -> Self {
        Quotient { numerator: Univariate::constant(value), denominator: Univariate::constant(F::whole(1)) }
    }

    /// The parameter itself.
    pub fn variable() -> Self {
        let numerator = Univariate::new(vec![F::whole(0), F::whole(1)]);
        Quotient { numerator, denominator: Univariate::constant(F::whole(1)) }
    }

    /// The quotient of two polynomials.
    ///
    /// # Errors
    /// When the one below is 0, or a limit of size is passed.
    pub fn of(above: Univariate<F>, below: Univariate<F>) -> Result<Self, Trouble> {
        Quotient::reduced(above, below)
    }

    /// The polynomial above.
    pub fn numerator(&self) -> &Univariate<F> {
        &self.numerator
    }

    /// The polynomial below, which is monic.
    pub fn denominator(&self) -> &Univariate<F> {
        &self.denominator
    }

    /// The number that this is, if it is one.
    pub fn as_constant(&self) -> Option<F> {
        match (self.numerator.coefficients(), self.denominator.degree()) {
            ([], _) => Some(F::whole(0)),
            ([value], Some(0)) => Some(value.clone()),
            _ => None,
        }
    }

    /// The value at a number of a world that holds the coefficients.
    ///
    /// # Errors
    /// At a pole, or when a limit of size is passed.
    pub fn evaluate<G: Field>(&self, at: &G, image: impl Fn(&F) -> G) -> Result<G, Trouble> {
        let value = |own: &Univariate<F>| own.mapped(|value| Ok(image(value)))?.evaluate(at);
        value(&self.numerator)?.over(&value(&self.denominator)?)
    }

    fn reduced(numerator: Univariate<F>, denominator: Univariate<F>) -> Result<Self, Trouble> {
        if numerator.degree().max(denominator.degree()) > Some(MAX_DEGREE) {
            return Err(Trouble::BeyondThisWorld("the function of the parameter has too large a degree"));
        }
        let leading = denominator.leading().ok_or(Trouble::DivisionByZero)?.clone();
        let common = match denominator.degree() {
            Some(0) => Univariate::constant(F::whole(1)),
            _ => numerator.gcd(&denominator)?,
        };
        let (numerator, denominator) = match common.degree() {
            Some(0) => (numerator, denominator),
            _ => (numerator.divided(&common)?.0, denominator.divided(&common)?.0),
        };
        let scale = F::whole(1).over(&leading)?;
        Ok(Quotient { numerator: numerator.scaled(&scale)?, denominator: denominator.scaled(&scale)? })
    }
}

impl<F: Field> Field for Quotient<F> {
    fn rational(value: &RBig) -> Self {
        Quotient::constant(F::rational(value))
    }

    fn negated(&self) -> Self {
        let coefficients = self.numerator.coefficients().iter().map(F::negated).collect();
        Quotient { numerator: Univariate::new(coefficients), denominator: self.denominator.clone() }
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        if self.denominator == other.denominator {
            return Quotient::reduced(self.numerator.plus(&other.numerator)?, self.denominator.clone());
        }
        let (left, right) = (self.numerator.times(&other.denominator)?, other.numerator.times(&self.denominator)?);
        Quotient::reduced(left.plus(&right)?, self.denominator.times(&other.denominator)?)
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        let numerator = self.numerator.times(&other.numerator)?;
        Quotient::reduced(numerator, self.denominator.times(&other.denominator)?)
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        let numerator = self.numerator.times(&other.denominator)?;
        Quotient::reduced(numerator, self.denominator.times(&other.numerator)?)
    }

    fn is_certainly_zero(&self) -> bool {
        self.numerator.is_zero()
    }
}

/// The exact world at one valence with one parameter left free.
pub struct ParameterWorld<'a> {
    /// The world of the numbers.
    pub base: &'a AtValence,
    /// The parameter's name.
    pub name: &'a str,
}

impl World for ParameterWorld<'_> {
    type Value = Quotient<Cosine>;

    fn name(&self, name: &str) -> Result<Self::Value, Trouble> {
        if name == self.name { Ok(Quotient::variable()) } else { self.base.name(name).map(Quotient::constant) }
    }

    fn cos(&self, angle: &Angle) -> Result<Self::Value, Trouble> {
        self.base.cos(angle).map(Quotient::constant)
    }

    fn sin(&self, angle: &Angle) -> Result<Self::Value, Trouble> {
        self.base.sin(angle).map(Quotient::constant)
    }

    fn sqrt(&self, radicand: &Self::Value) -> Result<Self::Value, Trouble> {
        let free = Trouble::BeyondThisWorld("the square root of a function of the parameter");
        self.base.sqrt(&radicand.as_constant().ok_or(free)?).map(Quotient::constant)
    }
}

/// The enclosed world at one valence with one parameter enclosed.
pub struct EnclosedParameter<'a, const BITS: usize> {
    /// The parameter's name.
    pub name: &'a str,
    /// Its value.
    pub value: &'a super::Enclosure<BITS>,
}

impl<const BITS: usize> World for EnclosedParameter<'_, BITS> {
    type Value = super::Enclosure<BITS>;

    fn name(&self, name: &str) -> Result<Self::Value, Trouble> {
        if name == self.name { Ok(self.value.clone()) } else { super::EnclosedWorld::<BITS>.name(name) }
    }

    fn cos(&self, angle: &Angle) -> Result<Self::Value, Trouble> {
        super::EnclosedWorld::<BITS>.cos(angle)
    }

    fn sin(&self, angle: &Angle) -> Result<Self::Value, Trouble> {
        super::EnclosedWorld::<BITS>.sin(angle)
    }

    fn sqrt(&self, radicand: &Self::Value) -> Result<Self::Value, Trouble> {
        super::EnclosedWorld::<BITS>.sqrt(radicand)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Free;

    #[test]
    fn quotients_are_in_lowest_terms() {
        let w = Quotient::<Free>::variable();
        let one = Quotient::<Free>::whole(1);
        let square = w.times(&w).unwrap();
        let quotient = square.minus(&one).unwrap().over(&w.minus(&one).unwrap()).unwrap();
        assert_eq!(quotient, w.plus(&one).unwrap());
        assert_eq!(one.over(&w).unwrap().times(&w).unwrap().as_constant(), Some(Free::whole(1)));
        assert_eq!(w.over(&Quotient::whole(0)), Err(Trouble::DivisionByZero));
        let half = one.over(&w.plus(&w).unwrap()).unwrap();
        assert_eq!(half.plus(&half).unwrap(), one.over(&w).unwrap());
    }
}
