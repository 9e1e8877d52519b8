//! Is a polynomial positive on a box?
//!
//! It is, where its Bernstein coefficients are, on the box or its halves, up to 12 times in a row. Powers of t may be < 0.

use dashu_base::BitTest;
use dashu_ratio::RBig;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The unknowns: t = 1/n, a cosine c, z = cos(2 pi j/n), the parameter p, kappa of c = 1 - kappa t^2, one more.
pub(crate) const T: usize = 0;
pub(crate) const C: usize = 1;
pub(crate) const Z: usize = 2;
pub(crate) const P: usize = 3;
pub(crate) const K: usize = 4;
pub(crate) const U: usize = 5;
const ALL: usize = 6;
/// The most terms, the largest exponent and the most bits of polynomials that are read.
const MOST: (usize, i32, usize) = (40, 32, 512);

/// A closed box: some unknowns with the ends of their ranges.
pub(crate) type Ranges = [(usize, RBig, RBig)];

/// Coefficients that are not 0, by the exponents of the unknowns.
#[derive(Clone, Debug, PartialEq, Default, Deserialize)]
#[serde(from = "Vec<i128>")]
pub(crate) struct Poly(BTreeMap<[i32; ALL], RBig>);

/// In p, from power 0 on.
impl From<Vec<i128>> for Poly {
    fn from(list: Vec<i128>) -> Poly {
        let terms = (0..).zip(list).filter(|(_, own)| *own != 0);
        Poly(terms.map(|(i, own)| ([0, 0, 0, i, 0, 0], own.into())).collect())
    }
}

/// n choose k.
pub(crate) fn choose(n: i32, k: i32) -> RBig {
    (0..k).fold(RBig::ONE, |product, i| product * RBig::from(n - i) / RBig::from(i + 1))
}

impl Poly {
    pub(crate) fn number(value: impl Into<RBig>) -> Poly {
        Poly::default().and([0; ALL], value.into())
    }
    pub(crate) fn power_of(index: usize, power: i32) -> Poly {
        let mut exponents = [0; ALL];
        exponents[index] = power;
        Poly::default().and(exponents, RBig::ONE)
    }

    /// The sum of coefficients times powers of a value, from power 0 on.
    pub(crate) fn sum(coefficients: &[Poly], value: &Poly) -> Poly {
        coefficients.iter().rev().fold(Poly::default(), |sum, own| &(&sum * value) + own)
    }

    fn and(mut self, exponents: [i32; ALL], value: RBig) -> Poly {
        let sum = self.0.remove(&exponents).unwrap_or(RBig::ZERO) + value;
        self.0.extend((sum != RBig::ZERO).then_some((exponents, sum)));
        self
    }
    pub(crate) fn is_small(&self) -> bool {
        let fits = |own: &RBig| own.numerator().bit_len().max(own.denominator().bit_len()) <= MOST.2;
        let low = |exponents: &[i32; ALL]| exponents.iter().all(|power| power.abs() <= MOST.1);
        self.0.len() <= MOST.0 && self.0.iter().all(|(exponents, own)| low(exponents) && fits(own))
    }

    /// The least and the greatest power of an unknown.
    pub(crate) fn powers(&self, index: usize) -> (i32, i32) {
        let powers = self.0.keys().map(|exponents| exponents[index]);
        (powers.clone().min().unwrap_or(0), powers.max().unwrap_or(0))
    }
    pub(crate) fn has(&self, index: usize) -> bool {
        self.powers(index) != (0, 0)
    }
    pub(crate) fn as_number(&self) -> Option<RBig> {
        if self.0.is_empty() { Some(RBig::ZERO) } else { self.0.get(&[0; ALL]).filter(|_| self.0.len() == 1).cloned() }
    }
    pub(crate) fn scaled(&self, by: impl Into<RBig>) -> Poly {
        self * &Poly::number(by)
    }
    pub(crate) fn raised(&self, power: i32) -> Poly {
        (0..power).fold(Poly::number(1), |product, _| &product * self)
    }

    /// One over this, if it is a number times a power of t.
    pub(crate) fn inverse(&self) -> Option<Poly> {
        let (exponents, own) = self.0.first_key_value().filter(|_| self.0.len() == 1)?;
        let inverse = Poly::power_of(T, -exponents[T]).scaled(RBig::ONE / own);
        exponents[T + 1..].iter().all(|power| *power == 0).then_some(inverse)
    }

    /// The coefficients of the powers of an unknown, from power 0 on.
    pub(crate) fn by_power(&self, index: usize) -> Vec<Poly> {
        let mut parts = vec![Poly::default(); self.powers(index).1.max(0) as usize + 1];
        for (exponents, own) in &self.0 {
            let (part, mut rest) = (&mut parts[exponents[index].max(0) as usize], *exponents);
            rest[index] = 0;
            *part = std::mem::take(part).and(rest, own.clone());
        }
        parts
    }

    /// With a polynomial in place of an unknown that has no negative powers.
    pub(crate) fn with(&self, index: usize, value: &Poly) -> Poly {
        Poly::sum(&self.by_power(index), value)
    }

    /// The derivative in an unknown.
    pub(crate) fn slope(&self, index: usize) -> Poly {
        let parts = (0..).zip(self.by_power(index)).map(|(i, own): (i32, _)| own.scaled(i));
        Poly::sum(&parts.skip(1).collect::<Vec<_>>(), &Poly::power_of(index, 1))
    }

    /// With a part of the unit interval made the whole of it.
    fn on(&self, index: usize, low: &RBig, high: &RBig) -> Poly {
        self.with(index, &(&Poly::number(low.clone()) + &Poly::power_of(index, 1).scaled(high - low)))
    }

    /// Whether this is positive on a closed box; `false` may mean that it was not seen, or an unknown has no range.
    pub(crate) fn is_positive(&self, on: &Ranges) -> bool {
        let known = |index| on.iter().any(|own| own.0 == index && own.1 <= own.2) && self.powers(index).0 >= 0;
        let unit = on.iter().fold(self.clone(), |own, (index, low, high)| own.on(*index, low, high));
        (0..ALL).all(|index| known(index) || !self.has(index)) && unit.is_positive_on_unit(12)
    }

    fn is_positive_on_unit(&self, left: usize) -> bool {
        let corner = self.0.get(&[0; ALL]).is_some_and(|own| *own > RBig::ZERO);
        let [zero, half, one] = [0, 1, 2].map(|twice| RBig::from(twice) / RBig::from(2));
        let part = |index, low, high| self.on(index, low, high).is_positive_on_unit(left - 1);
        let halved = |index| part(index, &zero, &half) && part(index, &half, &one);
        let next = (0..ALL).filter(|index| self.has(*index)).cycle().nth(left);
        corner && (self.has_positive_coefficients() || (left > 0 && next.is_some_and(halved)))
    }

    /// Whether all Bernstein coefficients on the unit box are positive.
    fn has_positive_coefficients(&self) -> bool {
        let (mut own, mut count) = (self.0.clone(), 1);
        for index in 0..ALL {
            let degree = self.powers(index).1;
            count *= degree as usize + 1;
            for (exponents, value) in std::mem::take(&mut own) {
                let (share, mut at) = (value / choose(degree, exponents[index]), exponents);
                for k in exponents[index]..=degree {
                    at[index] = k;
                    *own.entry(at).or_insert(RBig::ZERO) += choose(k, exponents[index]) * &share;
                }
            }
        }
        own.len() == count && own.values().all(|value| *value > RBig::ZERO)
    }
}

macro_rules! operator {
    ($name:ident, $method:ident, |$own:ident, $other:ident| $value:expr) => {
        impl std::ops::$name for &Poly {
            type Output = Poly;
            fn $method(self, $other: &Poly) -> Poly {
                let $own = self;
                $value
            }
        }
    };
}
operator!(Add, add, |own, other| other.0.iter().fold(own.clone(), |sum, (at, value)| sum.and(*at, value.clone())));
operator!(Sub, sub, |own, other| own + &other.scaled(-1));
operator!(Mul, mul, |own, other| {
    let pairs = own.0.iter().flat_map(|one| other.0.iter().map(move |two| (one, two)));
    pairs.fold(Poly::default(), |sum, ((i, x), (j, y))| sum.and(std::array::from_fn(|k| i[k] + j[k]), x * y))
});
