//! What is the value of a formula at one valence, enclosed?
//!
//! Where exact arithmetic ends (a large field, a root of a number that is not rational), every value is an interval that
//! certainly holds it: unequal numbers are told apart, equal ones are not.

use super::enclosure::Enclosure;
use super::world::{Angle, World};
use super::{Field, Function, Number, Trouble};
use std::cmp::Ordering;

/// The enclosed world.
#[derive(Clone, Copy, Debug)]
pub struct EnclosedWorld<const BITS: usize>;

/// The angle in radians.
fn radians<const BITS: usize>(angle: &Angle) -> Result<Enclosure<BITS>, Trouble> {
    Enclosure::rational(angle.turns()?).times(&Enclosure::pi())?.times(&Enclosure::whole(2))
}

impl<const BITS: usize> World for EnclosedWorld<BITS> {
    type Value = Enclosure<BITS>;

    fn name(&self, _: &str) -> Result<Self::Value, Trouble> {
        Err(Trouble::Domain("this name has no value here"))
    }

    fn pi(&self) -> Result<Self::Value, Trouble> {
        Ok(Enclosure::pi())
    }

    fn cos(&self, angle: &Angle) -> Result<Self::Value, Trouble> {
        Ok(radians(angle)?.cos())
    }

    fn sin(&self, angle: &Angle) -> Result<Self::Value, Trouble> {
        Ok(radians(angle)?.sin())
    }

    fn sqrt(&self, radicand: &Self::Value) -> Result<Self::Value, Trouble> {
        radicand.sqrt()
    }
}

impl<const BITS: usize> Number for Enclosure<BITS> {
    fn pi() -> Self {
        Enclosure::pi()
    }

    fn power(&self, exponent: &Self) -> Result<Self, Trouble> {
        let (low, high) = exponent.lo_hi();
        let whole = if low == high && low.is_int() { i64::try_from(low.numerator().clone()).ok() } else { None };
        let whole = whole.filter(|exponent| exponent.abs() <= 4096);
        Enclosure::power(self, whole.ok_or(Trouble::BeyondThisWorld("the exponent is not a small whole number"))?)
    }

    fn call(function: Function, arguments: &[Self]) -> Result<Self, Trouble> {
        match (function, arguments) {
            (Function::Cos, [angle]) => Ok(angle.cos()),
            (Function::Sin, [angle]) => Ok(angle.sin()),
            (Function::Sqrt, [radicand]) => radicand.sqrt(),
            (Function::Min, [a, b]) => {
                a.order(b).map(|order| if order == Ordering::Less { a.clone() } else { b.clone() }).ok_or(TIE)
            }
            (Function::Max, [a, b]) => {
                a.order(b).map(|order| if order == Ordering::Less { b.clone() } else { a.clone() }).ok_or(TIE)
            }
            _ => Err(Trouble::BeyondThisWorld("binom is exact for numbers only")),
        }
    }

    fn order(&self, other: &Self) -> Option<Ordering> {
        self.compare(other)
    }
}

const TIE: Trouble = Trouble::BeyondThisWorld("enclosures can't tell which of the two is larger");
