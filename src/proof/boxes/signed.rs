//! Which sign has a number that is only known to lie between two others?

use crate::numbers::{Enclosure, Field};
use std::cmp::Ordering;

/// Enclosed numbers.
pub trait Signed: Field {
    /// The sign, where it is certain.
    fn sign(&self) -> Option<Ordering>;

    /// A number inside, for choices that need not be right.
    fn approx(&self) -> f64;
}

impl<const BITS: usize> Signed for Enclosure<BITS> {
    fn sign(&self) -> Option<Ordering> {
        Enclosure::sign(self)
    }

    fn approx(&self) -> f64 {
        self.midpoint_f64()
    }
}
