//! Between which two floating-point numbers does a real number surely lie?
//!
//! Each operation rounds outward by one unit in the last place, which holds the exact result of every pair of members
//! whatever the rounding mode does to the last bit: IEEE 754 rounds `+`, `-`, `*`, `/` to nearest, so that the exact
//! result lies strictly between the neighbours of the rounded one. What can't be bounded is [`Interval::REALS`].

use super::Enclosure;
use dashu_base::ConversionError;
use dashu_ratio::RBig;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A closed interval `[lo, hi]` of real numbers; an end may be infinite, none is NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lo: f64,
    hi: f64,
}

impl Interval {
    /// The number 0. It stays what it is: 0 times a number and 0 plus a number are not rounded.
    pub const ZERO: Interval = Interval { lo: 0.0, hi: 0.0 };

    /// All real numbers: nothing is known.
    pub const REALS: Interval = Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// The interval between two numbers; `None` when `lo > hi` or one of them is NaN.
    pub fn new(lo: f64, hi: f64) -> Option<Self> {
        (lo <= hi).then_some(Interval { lo, hi })
    }

    /// A floating-point number alone; all real numbers where it is none.
    pub fn point(value: f64) -> Self {
        Interval::new(value, value).unwrap_or(Interval::REALS)
    }

    /// An interval around an enclosed number.
    pub fn enclosing<const BITS: usize>(value: &Enclosure<BITS>) -> Self {
        let (lo, hi) = value.lo_hi();
        Interval::around(&lo).hull(Interval::around(&hi))
    }

    /// The least interval that holds both.
    #[must_use]
    pub fn hull(self, other: Interval) -> Self {
        Interval { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The least interval found around a rational number: its ends are compared with the number exactly.
    pub fn around(exact: &RBig) -> Self {
        let near = exact.to_f64().value();
        if is(near, exact) {
            return Interval { lo: near, hi: near };
        }
        let (lo, hi) = (near.next_down(), near.next_up());
        let below = lo == f64::NEG_INFINITY || rational(lo).is_ok_and(|lo| lo <= *exact);
        let above = hi == f64::INFINITY || rational(hi).is_ok_and(|hi| *exact <= hi);
        if below && above { Interval { lo, hi } } else { Interval::REALS }
    }

    /// The lower end.
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// The upper end.
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// Is the rational number a member? Decided exactly.
    pub fn contains(self, exact: &RBig) -> bool {
        let below = self.lo == f64::NEG_INFINITY || rational(self.lo).is_ok_and(|lo| lo <= *exact);
        let above = self.hi == f64::INFINITY || rational(self.hi).is_ok_and(|hi| *exact <= hi);
        below && above
    }

    /// Are all members positive?
    pub fn is_positive(self) -> bool {
        self.lo > 0.0
    }

    /// Are all members negative?
    pub fn is_negative(self) -> bool {
        self.hi < 0.0
    }

    /// Does it lie in the interior of `other`, as the theorem of Krawczyk asks?
    pub fn is_inside(self, other: Interval) -> bool {
        other.lo < self.lo && self.hi < other.hi
    }

    /// A floating-point number between the ends, near their middle.
    pub fn middle(self) -> f64 {
        let middle = 0.5 * self.lo + 0.5 * self.hi;
        if middle.is_nan() { 0.0 } else { middle.clamp(self.lo, self.hi) }
    }

    /// An upper bound for the distance of the members from [`Interval::middle`].
    pub fn radius(self) -> f64 {
        let (own, middle) = (self.middle(), Interval::point(self.middle()));
        if own == self.lo && own == self.hi { 0.0 } else { (self - middle).magnitude() }
    }

    /// The largest absolute value of a member.
    pub fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    fn is_bounded(self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }

    /// The hull of the rounded results of the four pairs of ends, one unit in the last place wider.
    fn rounded(ends: [f64; 4]) -> Self {
        if ends.iter().any(|end| end.is_nan()) {
            return Interval::REALS;
        }
        let lo = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let hi = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Interval { lo: lo.next_down(), hi: hi.next_up() }
    }
}

fn rational(end: f64) -> Result<RBig, ConversionError> {
    RBig::try_from(end)
}

fn is(near: f64, exact: &RBig) -> bool {
    rational(near).is_ok_and(|near| near == *exact)
}

impl Add for Interval {
    type Output = Interval;
    fn add(self, other: Interval) -> Interval {
        if !(self.is_bounded() && other.is_bounded()) {
            return Interval::REALS;
        }
        if self == Interval::ZERO || other == Interval::ZERO {
            return if self == Interval::ZERO { other } else { self };
        }
        Interval { lo: (self.lo + other.lo).next_down(), hi: (self.hi + other.hi).next_up() }
    }
}

impl Neg for Interval {
    type Output = Interval;
    fn neg(self) -> Interval {
        Interval { lo: -self.hi, hi: -self.lo }
    }
}

impl Sub for Interval {
    type Output = Interval;
    fn sub(self, other: Interval) -> Interval {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Interval;
    fn mul(self, other: Interval) -> Interval {
        if !(self.is_bounded() && other.is_bounded()) {
            return Interval::REALS;
        }
        if self == Interval::ZERO || other == Interval::ZERO {
            return Interval::ZERO;
        }
        let (a, b) = (self, other);
        Interval::rounded([a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi])
    }
}

/// By an interval that holds 0 the quotient is [`Interval::REALS`].
impl Div for Interval {
    type Output = Interval;
    fn div(self, other: Interval) -> Interval {
        if !(self.is_bounded() && (other.is_positive() || other.is_negative()) && other.is_bounded()) {
            return Interval::REALS;
        }
        let (a, b) = (self, other);
        Interval::rounded([a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi])
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Numbers with exponents from subnormal to near overflow, and small ones with cancellation, reproducibly.
    fn samples() -> Vec<f64> {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state
        };
        let mut numbers = vec![0.0, 1.0, -1.0, f64::MIN_POSITIVE, f64::from_bits(1), f64::MAX, f64::MIN, 0.1];
        while numbers.len() < 60 {
            let wild = f64::from_bits(next());
            if wild.is_finite() {
                numbers.push(wild);
            }
            numbers.push(next() as f64 / 2f64.powi(63) - 1.0);
        }
        numbers
    }

    #[test]
    fn every_operation_holds_the_exact_result_at_the_ends_and_between() {
        let numbers = samples();
        let intervals: Vec<Interval> = numbers
            .windows(2)
            .map(|pair| Interval::new(pair[0].min(pair[1]), pair[0].max(pair[1])).unwrap())
            .chain(numbers.iter().map(|x| Interval::new(*x, *x).unwrap()))
            .collect();
        let members = |x: Interval| {
            let (lo, hi) = (RBig::try_from(x.lo).unwrap(), RBig::try_from(x.hi).unwrap());
            let third = &lo + (&hi - &lo) / RBig::from(3u8);
            [lo, third, hi]
        };
        let mut divided = 0;
        for (i, x) in intervals.iter().enumerate() {
            for y in intervals.iter().skip(i % 5).step_by(5) {
                for a in members(*x) {
                    for b in members(*y) {
                        assert!((*x + *y).contains(&(&a + &b)), "{x:?} + {y:?}");
                        assert!((*x - *y).contains(&(&a - &b)), "{x:?} - {y:?}");
                        assert!((*x * *y).contains(&(&a * &b)), "{x:?} * {y:?}");
                        if b != RBig::ZERO {
                            divided += 1;
                            assert!((*x / *y).contains(&(&a / &b)), "{x:?} / {y:?}");
                        }
                    }
                }
            }
        }
        assert!(divided > 1000);
    }

    #[test]
    fn intervals_are_thin_where_they_can_be() {
        let third = RBig::from_parts(1.into(), 3u8.into());
        let around = Interval::around(&third);
        assert!(around.contains(&third) && around.hi() - around.lo() < 2e-16);
        assert!(!around.contains(&RBig::from_parts(1.into(), 4u8.into())));
        let half = Interval::around(&RBig::from_parts(1.into(), 2u8.into()));
        assert_eq!((half.lo(), half.hi()), (0.5, 0.5));
        let product = around * around;
        assert!(product.hi() - product.lo() < 3e-16 && product.is_positive());
    }

    #[test]
    fn a_rational_beyond_f64_is_still_held() {
        let mut huge = RBig::from(10u8);
        for _ in 0..9 {
            huge = &huge * &huge;
        }
        assert!(Interval::around(&huge).contains(&huge));
        let tiny = RBig::ONE / &huge;
        assert!(Interval::around(&tiny).contains(&tiny));
        assert!(!Interval::around(&tiny).is_negative());
    }

    #[test]
    fn what_cannot_be_bounded_is_all_reals() {
        let across = Interval::new(-1.0, 1.0).unwrap();
        assert_eq!(across / across, Interval::REALS);
        assert_eq!(Interval::REALS * across, Interval::REALS);
        assert!(Interval::new(f64::NAN, 1.0).is_none() && Interval::new(1.0, 0.0).is_none());
    }
}
