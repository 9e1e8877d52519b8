//! What are the rational numbers as a field? Without limits of size.

use super::{Field, Trouble};
use dashu_ratio::RBig;

impl Field for RBig {
    fn rational(value: &RBig) -> Self {
        value.clone()
    }

    fn negated(&self) -> Self {
        -self.clone()
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        Ok(self + other)
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        Ok(self * other)
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        if other.is_zero() { Err(Trouble::DivisionByZero) } else { Ok(self / other) }
    }

    fn is_certainly_zero(&self) -> bool {
        self.is_zero()
    }
}
