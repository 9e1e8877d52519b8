//! Which numbers are made of cosines of the N-th parts of a turn?
//!
//! The real field Q(2 cos(2 pi/N)), exactly: polynomials in theta = 2 cos(2 pi/N) below the degree phi(N)/2, modulo the
//! minimal polynomial psi_N of theta (Lehmer 1933; psi_N(z + 1/z) = z^(-phi(N)/2) Phi_N(z)). cos(2 pi p/N) = V_p(theta)/2 with
//! V_{p+1} = theta V_p - V_{p-1}. Square roots of rational numbers are in such fields, too, by Gauss's sums:
//! sqrt(p) = sum_a (a|p) cos(2 pi a/p) for primes p = 1 mod 4, the same with sines for p = 3 mod 4.

use super::enclosure::Enclosure;
use super::world::{Angle, World, common_multiple, denominator, fraction_of_turn, rational_cosine, square_part};
use super::{Field, Trouble};
use dashu_base::BitTest;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// The largest degree of a field: beyond it exact arithmetic is given up for enclosures.
pub const MAX_DEGREE: usize = 24;

/// Larger N have a larger degree in any case.
const MAX_ORDER: u64 = 8 * (MAX_DEGREE * MAX_DEGREE) as u64;

const MAX_BITS: usize = 1536;

const TOO_LARGE: Trouble = Trouble::BeyondThisWorld("the exact value is too large to hold");

/// A field Q(2 cos(2 pi/N)).
#[derive(Debug, PartialEq)]
pub struct CosineField {
    order: u64,
    /// The coefficients of psi_N below the leading 1, low to high.
    modulus: Vec<IBig>,
    /// 2 cos(2 pi p/N) for p = 0..N-1.
    waves: Vec<Vec<IBig>>,
}

impl CosineField {
    /// The field of the N-th parts of a turn; `None` where its degree passes [`MAX_DEGREE`].
    pub fn new(order: u64) -> Option<Rc<CosineField>> {
        let order = order.max(1);
        // phi(N) is at least the root of N/2
        if order > MAX_ORDER || degree(order) > MAX_DEGREE as u64 {
            return None;
        }
        let modulus = minimal_polynomial(order);
        let mut field = CosineField { order, modulus, waves: vec![vec![IBig::from(2)]] };
        let mut before = field.reduced(vec![IBig::ZERO, IBig::ONE]);
        for _ in 1..order {
            let last = field.waves.last().cloned().unwrap_or_default();
            let mut next: Vec<IBig> = std::iter::once(IBig::ZERO).chain(last).collect();
            next.resize(next.len().max(before.len()), IBig::ZERO);
            next.iter_mut().zip(&before).for_each(|(a, b)| *a -= b);
            let mut next = field.reduced(next);
            // V_1 is theta itself; afterwards V_{p+1} = theta V_p - V_{p-1}
            if field.waves.len() == 1 {
                next = field.reduced(vec![IBig::ZERO, IBig::ONE]);
            }
            before = field.waves.last().cloned().unwrap_or_default();
            field.waves.push(next);
        }
        Some(Rc::new(field))
    }

    /// N.
    pub fn order(&self) -> u64 {
        self.order
    }

    /// The degree over the rational numbers: phi(N)/2, at least 1.
    pub fn degree(&self) -> usize {
        self.modulus.len()
    }

    /// 2 cos(2 pi/N), enclosed.
    pub fn theta<const BITS: usize>(&self) -> Result<Enclosure<BITS>, Trouble> {
        let turn = Enclosure::<BITS>::pi().times(&Enclosure::whole(2))?;
        let order = i64::try_from(self.order).map_err(|_| TOO_LARGE)?;
        turn.over(&Enclosure::whole(order))?.cos().times(&Enclosure::whole(2))
    }

    /// cos(2 pi q), where q times N (or 2N, for an odd N) is whole.
    pub fn cosine(self: &Rc<Self>, turns: &RBig) -> Option<Cosine> {
        let parts = fraction_of_turn(turns) * RBig::from(self.order);
        let half = RBig::from_parts(IBig::ONE, UBig::from(2_u8));
        if parts.is_int() {
            let p = usize::try_from(parts.numerator().clone()).ok()?;
            return Some(self.element(self.waves.get(p)?, &half));
        }
        let opposite = fraction_of_turn(&(turns + &half)) * RBig::from(self.order);
        let p = if opposite.is_int() { usize::try_from(opposite.numerator().clone()).ok()? } else { return None };
        Some(self.element(self.waves.get(p)?, &-half))
    }

    /// cos(2 pi p/N), p below N.
    fn wave(self: &Rc<Self>, p: usize) -> Option<Cosine> {
        Some(self.element(self.waves.get(p)?, &RBig::from_parts(IBig::ONE, UBig::from(2_u8))))
    }

    fn element(self: &Rc<Self>, whole: &[IBig], scale: &RBig) -> Cosine {
        let coefficients = whole.iter().map(|value| RBig::from(value.clone()) * scale).collect();
        Cosine { field: Some(Rc::clone(self)), coefficients }.trimmed()
    }

    fn reduced(&self, mut polynomial: Vec<IBig>) -> Vec<IBig> {
        let degree = self.modulus.len();
        while polynomial.len() > degree {
            let Some(top) = polynomial.pop() else { break };
            if top.is_zero() {
                continue;
            }
            let shift = polynomial.len() - degree;
            for (index, coefficient) in self.modulus.iter().enumerate() {
                polynomial[shift + index] -= &top * coefficient;
            }
        }
        polynomial
    }
}

/// phi(N)/2, at least 1.
pub fn degree(order: u64) -> u64 {
    let (mut rest, mut phi, mut prime) = (order, order, 2);
    while prime * prime <= rest {
        if rest.is_multiple_of(prime) {
            phi -= phi / prime;
            while rest.is_multiple_of(prime) {
                rest /= prime;
            }
        }
        prime += 1;
    }
    if rest > 1 {
        phi -= phi / rest;
    }
    (phi / 2).max(1)
}

/// The minimal polynomial of 2 cos(2 pi/N) without its leading 1.
fn minimal_polynomial(order: u64) -> Vec<IBig> {
    if order <= 2 {
        return vec![IBig::from(if order == 1 { -2 } else { 2 })];
    }
    let mut cyclotomic = cyclotomic(order);
    // Phi_N is symmetric: write it in z^m + z^-m = V_m(theta), from the top
    let degree = cyclotomic.len() / 2;
    let mut chebyshev = vec![vec![IBig::from(2)], vec![IBig::ZERO, IBig::ONE]];
    for m in 2..=degree {
        let mut next: Vec<IBig> = std::iter::once(IBig::ZERO).chain(chebyshev[m - 1].iter().cloned()).collect();
        chebyshev[m - 2].iter().enumerate().for_each(|(index, value)| next[index] -= value);
        chebyshev.push(next);
    }
    let middle = cyclotomic.split_off(degree);
    let mut result = vec![IBig::ZERO; degree + 1];
    result[0] += &middle[0];
    for m in 1..=degree {
        chebyshev[m].iter().enumerate().for_each(|(index, value)| result[index] += &middle[m] * value);
    }
    result.truncate(degree);
    result
}

/// Phi_N, low to high: z^N - 1 divided by Phi_d for the proper divisors d of N.
fn cyclotomic(order: u64) -> Vec<IBig> {
    let mut known: BTreeMap<u64, Vec<IBig>> = BTreeMap::new();
    for divisor in (1..=order).filter(|d| order.is_multiple_of(*d)) {
        let mut quotient = vec![IBig::ZERO; divisor as usize + 1];
        (quotient[0], quotient[divisor as usize]) = (IBig::from(-1), IBig::ONE);
        for (d, factor) in &known {
            if divisor.is_multiple_of(*d) {
                quotient = divided_by_monic(quotient, factor);
            }
        }
        known.insert(divisor, quotient);
    }
    known.remove(&order).unwrap_or_default()
}

fn divided_by_monic(mut dividend: Vec<IBig>, divisor: &[IBig]) -> Vec<IBig> {
    let degree = divisor.len() - 1;
    let mut quotient = vec![IBig::ZERO; dividend.len() - degree];
    for shift in (0..quotient.len()).rev() {
        let top = dividend[shift + degree].clone();
        for (index, coefficient) in divisor.iter().enumerate() {
            dividend[shift + index] -= &top * coefficient;
        }
        quotient[shift] = top;
    }
    quotient
}

/// A number of such a field: a polynomial in theta. Rational numbers belong to every field.
#[derive(Clone, Debug)]
pub struct Cosine {
    field: Option<Rc<CosineField>>,
    /// Low to high, the last one not zero.
    coefficients: Vec<RBig>,
}

impl PartialEq for Cosine {
    fn eq(&self, other: &Self) -> bool {
        self.coefficients == other.coefficients
    }
}

impl Cosine {
    fn trimmed(mut self) -> Cosine {
        while self.coefficients.last().is_some_and(|last| last.is_zero()) {
            self.coefficients.pop();
        }
        self
    }

    fn checked(self) -> Result<Cosine, Trouble> {
        let small = |value: &RBig| value.numerator().bit_len().max(value.denominator().bit_len()) <= MAX_BITS;
        if self.coefficients.iter().all(small) { Ok(self.trimmed()) } else { Err(TOO_LARGE) }
    }

    fn shared_field(&self, other: &Cosine) -> Option<Rc<CosineField>> {
        self.field.clone().or_else(|| other.field.clone())
    }

    /// The rational number that this is, if it is one.
    pub fn as_rational(&self) -> Option<RBig> {
        match self.coefficients.as_slice() {
            [] => Some(RBig::ZERO),
            [value] => Some(value.clone()),
            _ => None,
        }
    }

    /// This number as a sum of cosines: (p, a_p) stands for a_p cos(2 pi p/N), p increasing from 0. A number a + b cos(2 pi p/N), or
    /// with a third term in cos(4 pi p/N), is written so; others in the basis p = 0..degree-1.
    pub fn as_cosines(&self) -> (u64, Vec<(usize, RBig)>) {
        let basis = self.in_basis();
        let Some(field) = self.field.as_ref().filter(|_| self.coefficients.len() > 1) else { return (1, basis) };
        let order = field.order as usize;
        let short = (1..=order / 2).find_map(|p| self.as_wave(field, p)).or_else(|| {
            let pairs = basis.len() > 3;
            (1..=order / 2).filter(|_| pairs).find_map(|p| self.as_two_waves(field, p))
        });
        (field.order, short.unwrap_or(basis))
    }

    /// a + b cos(2 pi p/N), if it is such.
    fn as_wave(&self, field: &Rc<CosineField>, p: usize) -> Option<Vec<(usize, RBig)>> {
        let wave = field.wave(p)?;
        let last = wave.coefficients.len().checked_sub(1).filter(|last| *last > 0)?;
        let factor = self.coefficients.get(last)? / &wave.coefficients[last];
        let rest = self.minus(&wave.scaled(&factor)).ok()?.as_rational()?;
        let terms = [(0, rest), (p, factor)];
        Some(terms.into_iter().filter(|(_, part)| !part.is_zero()).collect())
    }

    /// a + b cos(2 pi p/N) + d cos(4 pi p/N), if it is such.
    fn as_two_waves(&self, field: &Rc<CosineField>, p: usize) -> Option<Vec<(usize, RBig)>> {
        let order = field.order as usize;
        let q = (2 * p).min(order.abs_diff(2 * p));
        let (first, second) = (field.wave(p)?, field.wave(q)?);
        let at = |wave: &Cosine, index: usize| wave.coefficients.get(index).cloned().unwrap_or_default();
        // two rows in which the waves differ tell their factors
        for i in 1..field.degree() {
            for j in i + 1..field.degree() {
                let determinant = at(&first, i) * at(&second, j) - at(&first, j) * at(&second, i);
                if determinant.is_zero() {
                    continue;
                }
                let b = (at(self, i) * at(&second, j) - at(self, j) * at(&second, i)) / &determinant;
                let d = (at(&first, i) * at(self, j) - at(&first, j) * at(self, i)) / &determinant;
                let rest = self.minus(&first.scaled(&b)).ok()?.minus(&second.scaled(&d)).ok()?.as_rational()?;
                let terms = [(0, rest), (p, b), (q, d)];
                return Some(terms.into_iter().filter(|(_, part)| !part.is_zero()).collect());
            }
        }
        None
    }

    fn in_basis(&self) -> Vec<(usize, RBig)> {
        // theta^m = sum_i binom(m, i) z^(m - 2i): gather by |m - 2i|
        let mut parts: Vec<RBig> = vec![RBig::ZERO; self.coefficients.len()];
        for (m, coefficient) in self.coefficients.iter().enumerate() {
            let mut binomial = IBig::ONE;
            for i in 0..=m {
                let p = m.abs_diff(2 * i);
                parts[p] += coefficient * RBig::from(binomial.clone());
                binomial = binomial * IBig::from(m - i) / IBig::from(i + 1);
            }
        }
        parts.into_iter().enumerate().filter(|(_, part)| !part.is_zero()).collect()
    }

    /// The value enclosed, theta being so.
    ///
    /// # Errors
    /// When it is too large to enclose.
    pub fn enclosed<const BITS: usize>(&self, theta: &Enclosure<BITS>) -> Result<Enclosure<BITS>, Trouble> {
        let zero = Enclosure::whole(0);
        self.coefficients
            .iter()
            .rev()
            .try_fold(zero, |sum, coefficient| sum.times(theta)?.plus(&Enclosure::rational(coefficient)))
    }

    /// Numerators over one denominator.
    fn whole_parts(&self) -> (Vec<IBig>, UBig) {
        use dashu_base::Gcd;
        let lcm = |a: UBig, b: &UBig| {
            let gcd = (&a).gcd(b);
            a / gcd * b
        };
        let denominator = self.coefficients.iter().fold(UBig::ONE, |a, value| lcm(a, value.denominator()));
        let scaled = |value: &RBig| value.numerator() * IBig::from(&denominator / value.denominator());
        (self.coefficients.iter().map(scaled).collect(), denominator)
    }

    fn scaled(&self, factor: &RBig) -> Cosine {
        let coefficients = self.coefficients.iter().map(|value| value * factor).collect();
        Cosine { field: self.field.clone(), coefficients }.trimmed()
    }

    fn inverse(&self) -> Result<Cosine, Trouble> {
        if let Some(value) = self.as_rational() {
            let nothing = value.is_zero();
            return if nothing { Err(Trouble::DivisionByZero) } else { Ok(Cosine::rational(&(RBig::ONE / value))) };
        }
        let Some(field) = &self.field else { return Err(Trouble::DivisionByZero) };
        let modulus = field.modulus.iter().map(|value| RBig::from(value.clone())).chain([RBig::ONE]).collect();
        // Euclid: r_i = s_i self + ... modulus
        let (mut r0, mut r1) = (modulus, self.coefficients.clone());
        let (mut s0, mut s1) = (Vec::new(), vec![RBig::ONE]);
        while r1.len() > 1 {
            let (quotient, rest) = divided(r0, &r1);
            let next = difference(s0, &product(&quotient, &s1));
            (r0, r1, s0, s1) = (r1, rest, s1, next);
        }
        let Some(unit) = r1.first().filter(|unit| !unit.is_zero()) else { return Err(Trouble::DivisionByZero) };
        let coefficients = s1.iter().map(|value| value / unit).collect();
        Cosine { field: self.field.clone(), coefficients }.checked()
    }
}

fn trim(mut polynomial: Vec<RBig>) -> Vec<RBig> {
    while polynomial.last().is_some_and(|last| last.is_zero()) {
        polynomial.pop();
    }
    polynomial
}

fn product(a: &[RBig], b: &[RBig]) -> Vec<RBig> {
    let mut product = vec![RBig::ZERO; (a.len() + b.len()).saturating_sub(1)];
    for (i, x) in a.iter().enumerate() {
        b.iter().enumerate().for_each(|(j, y)| product[i + j] += x * y);
    }
    product
}

fn difference(mut a: Vec<RBig>, b: &[RBig]) -> Vec<RBig> {
    a.resize(a.len().max(b.len()), RBig::ZERO);
    a.iter_mut().zip(b).for_each(|(x, y)| *x -= y);
    trim(a)
}

/// Quotient and remainder; the divisor's last coefficient is not zero.
fn divided(mut dividend: Vec<RBig>, divisor: &[RBig]) -> (Vec<RBig>, Vec<RBig>) {
    let mut quotient = vec![RBig::ZERO; (dividend.len() + 1).saturating_sub(divisor.len())];
    while dividend.len() >= divisor.len() {
        let shift = dividend.len() - divisor.len();
        let factor = &dividend[dividend.len() - 1] / &divisor[divisor.len() - 1];
        divisor.iter().enumerate().for_each(|(index, value)| dividend[shift + index] -= &factor * value);
        dividend.pop();
        quotient[shift] = factor;
        dividend = trim(dividend);
    }
    (quotient, dividend)
}

impl Field for Cosine {
    fn rational(value: &RBig) -> Self {
        Cosine { field: None, coefficients: vec![value.clone()] }.trimmed()
    }

    fn negated(&self) -> Self {
        self.scaled(&RBig::from(-1))
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        let (long, short) =
            if self.coefficients.len() >= other.coefficients.len() { (self, other) } else { (other, self) };
        let mut coefficients = long.coefficients.clone();
        coefficients.iter_mut().zip(&short.coefficients).for_each(|(a, b)| *a += b);
        Cosine { field: self.shared_field(other), coefficients }.checked()
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        if let Some(factor) = self.as_rational() {
            return other.scaled(&factor).checked();
        }
        if let Some(factor) = other.as_rational() {
            return self.scaled(&factor).checked();
        }
        let Some(field) = self.shared_field(other) else { return Err(TOO_LARGE) };
        let ((a, left), (b, right)) = (self.whole_parts(), other.whole_parts());
        let mut product = vec![IBig::ZERO; a.len() + b.len() - 1];
        for (i, x) in a.iter().enumerate() {
            b.iter().enumerate().for_each(|(j, y)| product[i + j] += x * y);
        }
        let denominator = left * right;
        let over = |value: IBig| RBig::from_parts(value, denominator.clone());
        let coefficients = field.reduced(product).into_iter().map(over).collect();
        Cosine { field: Some(field), coefficients }.checked()
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        self.times(&other.inverse()?)
    }

    fn is_certainly_zero(&self) -> bool {
        self.coefficients.is_empty()
    }
}

/// The exact world at one valence. `needed` grows where a formula asks for a larger field: then the world is made again.
#[derive(Debug)]
pub struct AtValence {
    field: Rc<CosineField>,
    needed: Cell<u64>,
}

/// Said where a larger field is needed, or none is large enough.
const LARGER: Trouble = Trouble::BeyondThisWorld("the field that holds these cosines and roots has too large a degree");

impl AtValence {
    /// The world of the N-th parts of a turn; `None` where the degree is too large.
    pub fn new(order: u64) -> Option<AtValence> {
        Some(AtValence { field: CosineField::new(order)?, needed: Cell::new(order) })
    }

    /// The field.
    pub fn field(&self) -> &Rc<CosineField> {
        &self.field
    }

    /// The order that the formulas read so far need.
    pub fn needed(&self) -> u64 {
        self.needed.get()
    }

    fn cosine(&self, turns: &RBig) -> Result<Cosine, Trouble> {
        if let Some(value) = rational_cosine(turns) {
            return Ok(Cosine::rational(&value));
        }
        self.field.cosine(turns).ok_or_else(|| {
            let needed = denominator(turns).and_then(|d| common_multiple(self.needed.get(), d));
            self.needed.set(needed.unwrap_or(u64::MAX));
            LARGER
        })
    }

    /// The square root of a prime, by Gauss's sum.
    fn root_of_prime(&self, prime: u64) -> Result<Cosine, Trouble> {
        let parts = |a: u64, d: u64| RBig::from_parts(IBig::from(a), UBig::from(d));
        if prime == 2 {
            return self.cosine(&parts(1, 8))?.times(&Cosine::whole(2));
        }
        let quarter = if prime % 4 == 1 { RBig::ZERO } else { parts(1, 4) };
        let mut sum = Cosine::whole(0);
        for a in 1..prime {
            let term = self.cosine(&(parts(a, prime) - &quarter))?;
            let is_square = (1..prime).any(|b| b * b % prime == a);
            sum = if is_square { sum.plus(&term)? } else { sum.minus(&term)? };
        }
        Ok(sum)
    }
}

impl World for AtValence {
    type Value = Cosine;

    fn name(&self, _: &str) -> Result<Cosine, Trouble> {
        Err(Trouble::Domain("this name has no value here"))
    }

    fn cos(&self, angle: &Angle) -> Result<Cosine, Trouble> {
        self.cosine(angle.turns()?)
    }

    fn sin(&self, angle: &Angle) -> Result<Cosine, Trouble> {
        self.cosine(&(angle.turns()? - RBig::from_parts(IBig::ONE, UBig::from(4_u8))))
    }

    fn sqrt(&self, radicand: &Cosine) -> Result<Cosine, Trouble> {
        let irrational = Trouble::BeyondThisWorld("the square root of a number that is not rational");
        let (square, free) = square_part(&radicand.as_rational().ok_or(irrational)?)?;
        let mut root = Cosine::rational(&square);
        let (mut rest, mut prime) = (free, 2);
        while rest > 1 {
            if prime > 4 * MAX_DEGREE as u64 {
                return Err(LARGER);
            }
            if rest.is_multiple_of(prime) {
                root = root.times(&self.root_of_prime(prime)?)?;
                rest /= prime;
            }
            prime += 1;
        }
        Ok(root)
    }
}
