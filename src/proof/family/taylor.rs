//! How does a value move with c over a box?
//!
//! On a box c = m + r t, |t| <= 1, a value is a_0 + a_1 t + ... + a_D t^D with coefficients in intervals: at each t
//! there are numbers in them for which this is the value. So every operation may be done coefficient by coefficient,
//! and the terms beyond t^D go into the last one with the range of the power of t left over. D = 0 would be plain
//! interval arithmetic; the higher terms keep that the same c stands in all values (Moore 1966: mean-value forms;
//! Makino and Berz 1996: Taylor models).

use crate::numbers::{Field, Interval, Trouble};
use crate::proof::signed::Signed;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// D.
const DEGREE: usize = 4;

/// A value over a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taylor {
    terms: [Interval; DEGREE + 1],
}

/// All of t^k.
fn power_of_t(k: usize) -> Interval {
    let low = match k {
        0 => 1.0,
        k if k % 2 == 0 => 0.0,
        _ => -1.0,
    };
    Interval::new(low, 1.0).unwrap_or(Interval::REALS)
}

impl Taylor {
    /// The value that is the same at every t.
    pub fn constant(value: Interval) -> Self {
        let mut terms = [Interval::ZERO; DEGREE + 1];
        terms[0] = value;
        Taylor { terms }
    }

    /// c itself, on the box from m - r to m + r.
    pub fn variable(m: f64, r: f64) -> Self {
        let mut own = Taylor::constant(Interval::point(m));
        own.terms[1] = Interval::point(r);
        own
    }

    /// The value with another number in the middle of each coefficient.
    pub fn middle(&self) -> Self {
        Taylor { terms: self.terms.map(|own| Interval::point(own.middle())) }
    }

    /// The same with everything within an interval added.
    #[must_use]
    pub fn widened(mut self, by: Interval) -> Self {
        self.terms[0] = self.terms[0] + by;
        self
    }

    /// The coefficients a_0, ..., a_D.
    pub fn terms(&self) -> &[Interval] {
        &self.terms
    }

    /// The ranges of the powers of t that they are multiplied with.
    pub fn powers() -> Vec<Interval> {
        (0..=DEGREE).map(power_of_t).collect()
    }

    /// All of its values.
    pub fn range(&self) -> Interval {
        let parts = (1..=DEGREE).filter(|k| !is_zero(self.terms[*k])).map(|k| self.terms[k] * power_of_t(k));
        parts.fold(self.terms[0], |sum, part| sum + part)
    }
}

fn is_zero(own: Interval) -> bool {
    own == Interval::ZERO
}

impl Field for Taylor {
    const EXACT: bool = false;

    fn rational(value: &RBig) -> Self {
        Taylor::constant(Interval::around(value))
    }

    fn whole(value: i64) -> Self {
        match i32::try_from(value) {
            Ok(small) => Taylor::constant(Interval::point(f64::from(small))),
            Err(_) => Taylor::rational(&RBig::from(value)),
        }
    }

    fn negated(&self) -> Self {
        Taylor { terms: self.terms.map(|own| -own) }
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        let mut terms = self.terms;
        for (own, other) in terms.iter_mut().zip(&other.terms).filter(|(_, other)| !is_zero(**other)) {
            *own = if is_zero(*own) { *other } else { *own + *other };
        }
        Ok(Taylor { terms })
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        let mut product = Taylor::constant(Interval::point(0.0));
        let mut beyond = [Interval::ZERO; DEGREE + 1];
        for (i, a) in self.terms.iter().enumerate().filter(|(_, a)| !is_zero(**a)) {
            for (j, b) in other.terms.iter().enumerate().filter(|(_, b)| !is_zero(**b)) {
                let place = if i + j <= DEGREE { &mut product.terms[i + j] } else { &mut beyond[i + j - DEGREE] };
                *place = if is_zero(*place) { *a * *b } else { *place + *a * *b };
            }
        }
        for (k, own) in beyond.iter().enumerate().filter(|(_, own)| !is_zero(**own)) {
            product.terms[DEGREE] = product.terms[DEGREE] + *own * power_of_t(k);
        }
        Ok(product)
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        let range = other.range();
        if !range.is_positive() && !range.is_negative() {
            return Err(Trouble::DivisionByZero);
        }
        // q_i of the powers below t^D, then the rest over the range of the divisor
        let mut quotient = Taylor::constant(Interval::point(0.0));
        for i in 0..DEGREE {
            let known = (1..=i).fold(self.terms[i], |rest, j| rest - other.terms[j] * quotient.terms[i - j]);
            quotient.terms[i] = known / other.terms[0];
        }
        let mut rest = self.terms[DEGREE];
        for (i, j) in (0..DEGREE).flat_map(|i| (DEGREE - i..=DEGREE).map(move |j| (i, j))) {
            rest = rest - quotient.terms[i] * other.terms[j] * power_of_t(i + j - DEGREE);
        }
        quotient.terms[DEGREE] = rest / range;
        Ok(quotient)
    }

    fn is_certainly_zero(&self) -> bool {
        self.terms.iter().all(|own| is_zero(*own))
    }
}

impl Signed for Taylor {
    fn sign(&self) -> Option<Ordering> {
        let range = self.range();
        match (range.is_positive(), range.is_negative()) {
            (true, _) => Some(Ordering::Greater),
            (_, true) => Some(Ordering::Less),
            _ => self.is_certainly_zero().then_some(Ordering::Equal),
        }
    }

    fn approx(&self) -> f64 {
        self.terms[0].middle()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rational(value: f64) -> RBig {
        RBig::try_from(value).unwrap()
    }

    /// (c^3 - c/3 + 1)/(c + 2) and its parts at rational c of a box, exactly.
    #[test]
    fn the_range_holds_every_value() {
        for (m, r) in [(0.0, 0.5), (0.25, 0.125), (-0.375, 0.0625), (0.75, 0.25)] {
            let c = Taylor::variable(m, r);
            let third = Taylor::rational(&(RBig::ONE / RBig::from(3)));
            let cube = c.times(&c).unwrap().times(&c).unwrap();
            let above = cube.minus(&c.times(&third).unwrap()).unwrap().plus(&Taylor::whole(1)).unwrap();
            let whole = above.over(&c.plus(&Taylor::whole(2)).unwrap()).unwrap();
            let powers = [&whole, &whole.times(&whole).unwrap(), &cube.times(&above).unwrap()].map(Taylor::range);
            for step in -8..=8 {
                let c = rational(m) + rational(r) * RBig::from(step) / RBig::from(8);
                let cube = &c * &c * &c;
                let above = &cube - &c / RBig::from(3) + RBig::ONE;
                let whole = &above / (&c + RBig::from(2));
                for (range, value) in powers.iter().zip([whole.clone(), &whole * &whole, cube * above]) {
                    assert!(range.contains(&value), "{m} {r} {step}");
                }
            }
        }
    }

    /// c - c is 0 at every c: plain intervals would not see that.
    #[test]
    fn the_same_c_stands_in_all_values() {
        let c = Taylor::variable(0.5, 0.5);
        let difference = c.minus(&c).unwrap().range();
        assert!(difference.magnitude() < 1e-300);
        assert!(c.over(&c).is_err());
        let shifted = c.plus(&Taylor::whole(1)).unwrap();
        let one = shifted.over(&shifted).unwrap().range();
        assert!(one.contains(&RBig::ONE) && one.magnitude() < 1.0 + 1e-12, "{one:?}");
    }
}
