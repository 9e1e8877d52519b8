//! Which factors do polynomials share, and which of their factors repeat?
//!
//! Greatest common divisors by Kronecker's substitution, after the heuristic of Char, Geddes & Gonnet (1989): the
//! greatest common divisor of two values, read as digits, is the one of the polynomials if it divides both. Images
//! modulo a prime come first, since they show most pairs to be coprime. Repeated factors by Yun (1976).

use crate::numbers::Trouble;
use crate::numbers::kronecker::{Substitution, height_bits};
use crate::numbers::polynomial::{Polynomial, SLOTS, TOO_LARGE};
use dashu_base::{Gcd, RemEuclid, SquareRootRem, UnsignedAbs};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// A Mersenne prime, for images.
const PRIME: u64 = (1 << 61) - 1;
/// Where the indeterminates stand in an image; any fixed numbers without structure.
const POINT: [u64; SLOTS] = [
    0x1d3a_55f1_9c2b_7e41,
    0x0b7e_1516_28ae_d2a6,
    0x1234_9e37_79b9_7f4a,
    0x0f39_cc06_05ce_dc83,
    0x1082_276b_f3a2_7251,
    0x05c1_0f21_7b54_9a1d,
    0x0c6e_f372_fe94_f82b,
];
/// How many substitutions are tried.
const ATTEMPTS: usize = 8;

impl Polynomial {
    /// The greatest common divisor, primitive; zero if both are zero.
    ///
    /// # Errors
    /// When the polynomials are too large.
    pub fn gcd(&self, other: &Self) -> Result<Self, Trouble> {
        if self.is_zero() || other.is_zero() {
            return Ok(if self.is_zero() { other.primitive() } else { self.primitive() });
        }
        let (p, q) = (self.monomial_part(), other.monomial_part());
        let shared: [u16; SLOTS] = std::array::from_fn(|index| p[index].min(q[index]));
        let (a, b) = (self.without_monomial(&p), other.without_monomial(&q));
        let rest = without_monomials(&a.primitive(), &b.primitive())?;
        if shared == [0; SLOTS] { Ok(rest) } else { rest.times(&Polynomial::monomial(shared)) }
    }

    /// The greatest common divisor of the coefficients of the powers of an indeterminate, primitive.
    ///
    /// # Errors
    /// When the polynomials are too large.
    pub fn content_in(&self, index: usize) -> Result<Self, Trouble> {
        common(self.coefficients_in(index))
    }

    /// Pairwise coprime primitive polynomials without repeated factors, and their multiplicities; with the content, the
    /// product of their powers is this. Zero and constants have none.
    ///
    /// # Errors
    /// When the polynomials are too large.
    pub fn squarefree_factors(&self) -> Result<Vec<(Polynomial, usize)>, Trouble> {
        let monomial = self.monomial_part();
        let powers = monomial.iter().enumerate().filter(|(_, e)| **e > 0);
        let mut factors: Vec<_> = powers.map(|(index, e)| (Polynomial::variable(index), usize::from(*e))).collect();
        let mut rest = self.without_monomial(&monomial).primitive();
        for index in 0..SLOTS {
            if rest.mentions(index) {
                let content = rest.content_in(index)?;
                factors.extend(rest.divided_exactly(&content).ok_or(TOO_LARGE)?.squarefree_in(index)?);
                rest = content;
            }
        }
        Ok(factors)
    }

    /// The same for a polynomial without factors that are free of this indeterminate, which sorts by multiplicity.
    pub(crate) fn squarefree_in(&self, index: usize) -> Result<Vec<(Polynomial, usize)>, Trouble> {
        let quotient = |a: &Polynomial, b: &Polynomial| a.divided_exactly(b).ok_or(TOO_LARGE);
        let derivative = self.derivative_in(index);
        let repeated = self.gcd(&derivative)?;
        let (mut b, mut c) = (quotient(self, &repeated)?, quotient(&derivative, &repeated)?);
        let (mut factors, mut multiplicity) = (Vec::new(), 1);
        while b.mentions(index) {
            let d = c.minus(&b.derivative_in(index))?;
            let factor = b.gcd(&d)?;
            (b, c) = (quotient(&b, &factor)?, quotient(&d, &factor)?);
            if factor.mentions(index) {
                factors.push((factor, multiplicity));
            }
            multiplicity += 1;
        }
        Ok(factors)
    }
}

/// The greatest common divisor of all.
pub(crate) fn common(mut all: Vec<Polynomial>) -> Result<Polynomial, Trouble> {
    all.sort_by_key(Polynomial::len);
    let mut divisor = Polynomial::whole(0);
    for p in &all {
        divisor = divisor.gcd(p)?;
        if divisor.as_constant().is_some_and(|value| !value.is_zero()) {
            break;
        }
    }
    Ok(divisor)
}

fn without_monomials(a: &Polynomial, b: &Polynomial) -> Result<Polynomial, Trouble> {
    if a.len() == 1 || b.len() == 1 {
        return Ok(Polynomial::whole(1));
    }
    if a == b {
        return Ok(a.clone());
    }
    let bounds: [usize; SLOTS] = std::array::from_fn(|index| degree_bound(a, b, index));
    if bounds == [0; SLOTS] {
        return Ok(Polynomial::whole(1));
    }
    let foreign = |index: &usize| bounds[*index] == 0 && (a.mentions(*index) || b.mentions(*index));
    if let Some(index) = (0..SLOTS).find(foreign) {
        return common([a.coefficients_in(index), b.coefficients_in(index)].concat());
    }
    for (p, q) in [(a, b), (b, a)] {
        if (0..SLOTS).all(|index| bounds[index] == p.degree_in(index)) && q.divided_exactly(p).is_some() {
            return Ok(p.clone());
        }
    }
    by_values(a, b)
}

/// A bound of the degree of common factors in an indeterminate: the degree of those of two images.
fn degree_bound(a: &Polynomial, b: &Polynomial, index: usize) -> usize {
    let bound = a.degree_in(index).min(b.degree_in(index));
    if bound == 0 {
        return 0;
    }
    let (p, q) = (image(a, index), image(b, index));
    if p.last() == Some(&0) || q.last() == Some(&0) { bound } else { common_degree(p, q) }
}

fn times(a: u64, b: u64) -> u64 {
    u64::try_from(u128::from(a) * u128::from(b) % u128::from(PRIME)).unwrap_or(0)
}

fn power(base: u64, exponent: u64) -> u64 {
    let square = |value| times(value, value);
    (0..64)
        .rev()
        .fold(1, |value, bit| if exponent >> bit & 1 == 1 { times(square(value), base) } else { square(value) })
}

fn residue(value: &IBig) -> u64 {
    match i64::try_from(value) {
        Ok(small) => u64::try_from(i128::from(small).rem_euclid(i128::from(PRIME))).unwrap_or(0),
        Err(_) => u64::try_from(value.rem_euclid(&IBig::from(PRIME))).unwrap_or(0),
    }
}

/// The coefficients of the powers of one indeterminate, modulo the prime, with the others at the point.
fn image(p: &Polynomial, index: usize) -> Vec<u64> {
    let mut coefficients = vec![0; p.degree_in(index) + 1];
    for (exponents, coefficient) in p.terms() {
        let others = exponents.iter().enumerate().filter(|(other, e)| *other != index && **e > 0);
        let value = others
            .fold(residue(coefficient), |value, (other, e)| (0..*e).fold(value, |value, _| times(value, POINT[other])));
        let slot = &mut coefficients[usize::from(exponents[index])];
        *slot = (*slot + value) % PRIME;
    }
    coefficients
}

/// The degree of the greatest common divisor of polynomials with leading coefficients other than 0, by Euclid.
fn common_degree(mut p: Vec<u64>, mut q: Vec<u64>) -> usize {
    while let Some(leading) = q.last() {
        let inverse = power(*leading, PRIME - 2);
        while p.len() >= q.len() {
            let factor = times(p.last().copied().unwrap_or(0), inverse);
            let shift = p.len() - q.len();
            for (slot, value) in p[shift..].iter_mut().zip(&q) {
                *slot = (*slot + PRIME - times(factor, *value)) % PRIME;
            }
            p.pop();
        }
        while p.last() == Some(&0) {
            p.pop();
        }
        std::mem::swap(&mut p, &mut q);
    }
    p.len().saturating_sub(1)
}

/// The heuristic. The base is more than twice the smaller height, so that a divisor of both is the greatest.
fn by_values(a: &Polynomial, b: &Polynomial) -> Result<Polynomial, Trouble> {
    let degrees = std::array::from_fn(|index| a.degree_in(index).max(b.degree_in(index)));
    let bits = height_bits(a.terms()).min(height_bits(b.terms())) + 3;
    for attempt in 0..ATTEMPTS {
        let substitution = Substitution::new(bits + attempt * attempt, &degrees, attempt)?;
        let (x, y) = (substitution.value(a.terms()), substitution.value(b.terms()));
        if x.is_zero() || y.is_zero() {
            continue;
        }
        let candidate = substitution.polynomial((&x).gcd(&y).into()).map(|p| p.primitive());
        let divides = |p: &Polynomial| a.divided_exactly(p).is_some() && b.divided_exactly(p).is_some();
        if let Some(divisor) = candidate.filter(divides) {
            return Ok(divisor);
        }
    }
    Err(TOO_LARGE)
}

fn whole_root(value: &UBig) -> Option<UBig> {
    let (root, rest) = value.sqrt_rem();
    rest.is_zero().then_some(root)
}

/// The square root of a rational number, if it is rational.
pub(super) fn rational_root(value: &RBig) -> Option<RBig> {
    let numerator = UBig::try_from(value.numerator().clone()).ok()?;
    Some(RBig::from_parts(whole_root(&numerator)?.into(), whole_root(value.denominator())?))
}

/// Polynomials s and d with p = s^2 d, where d has no repeated factor and a whole content without small square divisors;
/// s is positive at its leading term. When that is too much work, s = 1.
pub(super) fn square_part(p: &Polynomial) -> (Polynomial, Polynomial) {
    parts(p).unwrap_or_else(|_| (Polynomial::whole(1), p.clone()))
}

fn parts(p: &Polynomial) -> Result<(Polynomial, Polynomial), Trouble> {
    let (scale, free) = rational_square_part(p.content());
    let (mut s, mut d) = (Polynomial::constant(scale), Polynomial::constant(free));
    for (factor, multiplicity) in p.squarefree_factors()? {
        s = s.times(&factor.power(multiplicity / 2)?)?;
        d = d.times(&factor.power(multiplicity % 2)?)?;
    }
    Ok((s, d))
}

/// Numbers s > 0 and d with value = s^2 d, where d is whole and, as far as trial division shows, squarefree.
pub(super) fn rational_square_part(value: &RBig) -> (RBig, RBig) {
    let numerator = value.numerator() * IBig::from(value.denominator().clone());
    if numerator.is_zero() {
        return (RBig::ONE, RBig::ZERO);
    }
    let (mut s, mut d) = (UBig::ONE, (&numerator).unsigned_abs());
    for p in 2..1000u32 {
        let square = UBig::from(p * p);
        while d >= square && (&d % &square).is_zero() {
            d /= &square;
            s *= UBig::from(p);
        }
    }
    if let Some(root) = whole_root(&d) {
        (s, d) = (s * root, UBig::ONE);
    }
    let scale = RBig::from_parts(s.into(), value.denominator().clone());
    (scale, RBig::from(numerator.sign() * d))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::polynomial::tests::{polynomial, ratio, small, whole};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn divisors_divide(f in small(), g in small(), h in small()) {
            let (a, b) = (f.times(&h).unwrap(), g.times(&h).unwrap());
            let divisor = a.gcd(&b).unwrap();
            if a.is_zero() && b.is_zero() {
                prop_assert!(divisor.is_zero());
            } else {
                prop_assert!(a.divided_exactly(&divisor).is_some());
                prop_assert!(b.divided_exactly(&divisor).is_some());
                prop_assert!(divisor.divided_exactly(&h).is_some());
                prop_assert_eq!(divisor.content(), &RBig::ONE);
            }
        }

        #[test]
        fn squarefree_factors_multiply_back(f in small(), g in small(), h in small()) {
            let p = f.times(&g.power(2).unwrap()).unwrap().times(&h.power(3).unwrap()).unwrap();
            let factors = p.squarefree_factors().unwrap();
            let product = factors.iter().fold(Polynomial::constant(p.content().clone()), |product, (factor, m)| {
                product.times(&factor.power(*m).unwrap()).unwrap()
            });
            prop_assert_eq!(product, p);
            for (i, (factor, _)) in factors.iter().enumerate() {
                let others = factors[i + 1..].iter();
                prop_assert!(others.clone().all(|(other, _)| factor.gcd(other).unwrap() == whole(1)));
            }
        }

        #[test]
        fn squares_have_roots(f in small()) {
            let square = f.times(&f).unwrap().scaled(&ratio(4, 9));
            if !f.is_zero() {
                let (root, rest) = square_part(&square);
                prop_assert_eq!(root.times(&root).unwrap(), square.clone());
                prop_assert_eq!(rest, whole(1));
                let off = square.times(&polynomial(&[(1, 1, 0), (1, 0, 0)])).unwrap();
                let (s, d) = square_part(&off);
                prop_assert_eq!(d.clone(), polynomial(&[(1, 1, 0), (1, 0, 0)]));
                prop_assert_eq!(s.times(&s).unwrap().times(&d).unwrap(), off);
            }
        }
    }

    #[test]
    fn square_parts_of_numbers() {
        assert_eq!(rational_square_part(&ratio(-8, 9)), (ratio(2, 3), ratio(-2, 1)));
        assert_eq!(rational_square_part(&ratio(1, 2)), (ratio(1, 2), ratio(2, 1)));
        assert_eq!(rational_square_part(&RBig::ZERO), (RBig::ONE, RBig::ZERO));
        assert_eq!(rational_root(&ratio(-1, 4)), None);
    }

    #[test]
    fn large_polynomials_end_in_trouble_or_an_answer() {
        let sum = |m: i64| (0..6).fold(whole(m), |sum, i| sum.plus(&Polynomial::variable(i)).unwrap());
        let (a, b) = (sum(1).power(5).unwrap(), sum(2).power(5).unwrap());
        assert_eq!(a.gcd(&b), Ok(whole(1)));
        let shared = a.times(&sum(3)).unwrap().gcd(&b.times(&sum(3)).unwrap());
        assert!(shared == Ok(sum(3)) || shared == Err(TOO_LARGE));
    }
}
