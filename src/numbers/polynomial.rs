//! How are polynomials in the indeterminates of the free world held and computed with?
//!
//! A polynomial over Q is a rational *content* times a *primitive* part: whole coefficients without a common divisor,
//! the leading one positive, as sparse terms in lexicographic order. By Gauss's lemma the product of primitive parts is
//! primitive, and an exact quotient of them has whole coefficients (von zur Gathen & Gerhard, Modern Computer Algebra,
//! section 6.2). Two polynomials are equal exactly when their forms are.

use crate::numbers::{Field, Trouble};
use dashu_base::{BitTest, Gcd, Sign};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use std::collections::BTreeMap;

/// The number of indeterminates: n, cos(2 pi/n), cos(2 pi k/n), two parameters, and a spare one.
pub const VARIABLES: usize = 6;
/// One more indeterminate, for the unknown of a characteristic polynomial.
pub(crate) const UNKNOWN: usize = VARIABLES;
/// All indeterminates.
pub(crate) const SLOTS: usize = VARIABLES + 1;

/// The most terms that a polynomial may have.
pub const MAX_TERMS: usize = 2000;
/// The most bits that the numerator or denominator of a coefficient may have.
pub const MAX_BITS: usize = 8192;
/// The largest exponent of an indeterminate.
pub const MAX_EXPONENT: u16 = 200;
/// The most products of two terms in one multiplication or division.
const MAX_PRODUCTS: usize = 200_000;

/// Said when a stated limit of size is passed.
pub(crate) const TOO_LARGE: Trouble = Trouble::BeyondThisWorld("the exact form is too large to hold");

pub(crate) type Exponents = [u16; SLOTS];
pub(crate) type Term = (Exponents, IBig);

/// A polynomial over Q.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Polynomial {
    /// In ascending lexicographic order; a primitive part.
    terms: Vec<Term>,
    content: RBig,
}

impl Polynomial {
    /// A rational number.
    pub fn constant(value: RBig) -> Self {
        let terms = if value.is_zero() { Vec::new() } else { vec![([0; SLOTS], IBig::ONE)] };
        Polynomial { terms, content: value }
    }

    /// A whole number.
    pub fn whole(value: i64) -> Self {
        Polynomial::constant(RBig::from(value))
    }

    /// The indeterminate of this index; zero if there is none.
    pub fn variable(index: usize) -> Self {
        Polynomial::power_of_variable(index, 1)
    }

    pub(crate) fn power_of_variable(index: usize, exponent: u16) -> Self {
        let mut exponents = [0; SLOTS];
        let Some(slot) = exponents.get_mut(index) else { return Polynomial::whole(0) };
        *slot = exponent;
        Polynomial { terms: vec![(exponents, IBig::ONE)], content: RBig::ONE }
    }

    /// The normal form of `factor` times the sum of the terms, which ascend strictly and are not zero.
    pub(crate) fn of_terms(factor: RBig, mut terms: Vec<Term>) -> Self {
        let Some((_, last)) = terms.last() else { return Polynomial::whole(0) };
        if factor.is_zero() {
            return Polynomial::whole(0);
        }
        let divisor = last.sign() * common_divisor(&terms);
        if !divisor.is_one() {
            terms.iter_mut().for_each(|(_, coefficient)| *coefficient = &*coefficient / &divisor);
        }
        Polynomial { terms, content: factor * divisor }
    }

    pub(crate) fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// Whether this is zero.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The rational number that this is, if it is one.
    pub fn as_constant(&self) -> Option<RBig> {
        match self.terms.as_slice() {
            [] => Some(RBig::ZERO),
            [(exponents, _)] if *exponents == [0; SLOTS] => Some(self.content.clone()),
            _ => None,
        }
    }

    /// The rational number whose quotient is [`Polynomial::primitive`].
    pub fn content(&self) -> &RBig {
        &self.content
    }

    /// The multiple with whole coefficients without a common divisor, the leading one positive; zero stays zero.
    pub fn primitive(&self) -> Self {
        let content = if self.is_zero() { RBig::ZERO } else { RBig::ONE };
        Polynomial { terms: self.terms.clone(), content }
    }

    /// The number of terms.
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Whether there are no terms.
    pub fn is_empty(&self) -> bool {
        self.is_zero()
    }

    /// The largest exponent of an indeterminate, 0 for the zero polynomial.
    pub fn degree_in(&self, index: usize) -> usize {
        self.terms.iter().filter_map(|(exponents, _)| exponents.get(index)).max().map_or(0, |e| usize::from(*e))
    }

    /// The largest sum of exponents, 0 for the zero polynomial.
    pub fn total_degree(&self) -> usize {
        self.terms.iter().map(|(exponents, _)| total(exponents)).max().unwrap_or(0)
    }

    /// Whether an indeterminate stands in it.
    pub fn mentions(&self, index: usize) -> bool {
        self.degree_in(index) > 0
    }

    /// `-self`
    pub fn negated(&self) -> Self {
        Polynomial { terms: self.terms.clone(), content: -&self.content }
    }

    /// A rational multiple.
    pub fn scaled(&self, factor: &RBig) -> Self {
        let content = &self.content * factor;
        let terms = if content.is_zero() { Vec::new() } else { self.terms.clone() };
        Polynomial { terms, content }
    }

    /// `self + other`
    ///
    /// # Errors
    /// When the sum passes a limit of size.
    pub fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        if self.is_zero() {
            return Ok(other.clone());
        }
        if other.is_zero() {
            return Ok(self.clone());
        }
        let unit = common_unit(&self.content, &other.content);
        let (a, b) = (whole_part(&(&self.content / &unit)), whole_part(&(&other.content / &unit)));
        Polynomial::of_terms(unit, merged(&self.terms, &a, &other.terms, &b)).checked()
    }

    /// `self - other`
    ///
    /// # Errors
    /// When the difference passes a limit of size.
    pub fn minus(&self, other: &Self) -> Result<Self, Trouble> {
        self.plus(&other.negated())
    }

    /// `self * other`
    ///
    /// # Errors
    /// When the product passes a limit of size.
    pub fn times(&self, other: &Self) -> Result<Self, Trouble> {
        let content = &self.content * &other.content;
        if content.is_zero() {
            return Ok(Polynomial::whole(0));
        }
        if let Some(constant) = self.as_constant() {
            return other.scaled(&constant).checked();
        }
        if let Some(constant) = other.as_constant() {
            return self.scaled(&constant).checked();
        }
        Polynomial { terms: product(&self.terms, &other.terms)?, content }.checked()
    }

    /// `self ^ exponent`
    ///
    /// # Errors
    /// When the power passes a limit of size.
    pub fn power(&self, exponent: usize) -> Result<Self, Trouble> {
        (0..exponent).try_fold(Polynomial::whole(1), |power, _| power.times(self))
    }

    /// `self / other`, if `other` is not zero and divides this; none also when the division is too long.
    pub fn divided_exactly(&self, other: &Self) -> Option<Self> {
        if other.is_zero() {
            return None;
        }
        if self.is_zero() {
            return Some(self.clone());
        }
        let terms = quotient(&self.terms, &other.terms)?;
        Some(Polynomial { terms, content: &self.content / &other.content })
    }

    /// The derivative with respect to an indeterminate.
    pub fn derivative_in(&self, index: usize) -> Self {
        let terms = self.terms.iter().filter_map(|(exponents, coefficient)| {
            let mut lowered = *exponents;
            let slot = lowered.get_mut(index).filter(|e| **e > 0)?;
            let factor = *slot;
            *slot -= 1;
            Some((lowered, coefficient * IBig::from(factor)))
        });
        Polynomial::of_terms(self.content.clone(), terms.collect())
    }

    /// The coefficients of the powers 0, 1, 2, ... of an indeterminate; none for the zero polynomial.
    pub fn coefficients_in(&self, index: usize) -> Vec<Polynomial> {
        if self.is_zero() || index >= SLOTS {
            return if self.is_zero() { Vec::new() } else { vec![self.clone()] };
        }
        let mut parts = vec![Vec::new(); self.degree_in(index) + 1];
        for (exponents, coefficient) in &self.terms {
            let mut rest = *exponents;
            rest[index] = 0;
            parts[usize::from(exponents[index])].push((rest, coefficient.clone()));
        }
        parts.into_iter().map(|terms| Polynomial::of_terms(self.content.clone(), terms)).collect()
    }

    /// The polynomial in an indeterminate with these coefficients, low to high.
    ///
    /// # Errors
    /// When it passes a limit of size.
    pub fn from_coefficients_in(index: usize, coefficients: &[Polynomial]) -> Result<Self, Trouble> {
        let mut sum = Polynomial::whole(0);
        for (exponent, coefficient) in coefficients.iter().enumerate() {
            let exponent = u16::try_from(exponent).map_err(|_| TOO_LARGE)?;
            sum = sum.plus(&coefficient.times(&Polynomial::power_of_variable(index, exponent))?)?;
        }
        Ok(sum)
    }

    /// This with a rational number for an indeterminate.
    ///
    /// # Errors
    /// When the value passes a limit of size.
    pub fn at(&self, index: usize, value: &RBig) -> Result<Self, Trouble> {
        if !self.mentions(index) {
            return Ok(self.clone());
        }
        self.substituted(index, &Polynomial::constant(value.clone()))
    }

    /// This with a polynomial for an indeterminate.
    ///
    /// # Errors
    /// When the value passes a limit of size.
    pub fn substituted(&self, index: usize, value: &Polynomial) -> Result<Self, Trouble> {
        let coefficients = self.coefficients_in(index);
        coefficients.iter().rev().try_fold(Polynomial::whole(0), |sum, c| sum.times(value)?.plus(c))
    }

    /// The value at a point.
    ///
    /// # Errors
    /// When the point has too few coordinates.
    pub fn value(&self, point: &[RBig]) -> Result<RBig, Trouble> {
        Ok(self.evaluate(&point.iter().cloned().map(Exact).collect::<Vec<_>>())?.0)
    }

    /// The value in a world of numbers, by Horner's rule.
    ///
    /// # Errors
    /// When there are too few values, or the result is beyond their world.
    pub fn evaluate<F: Field>(&self, values: &[F]) -> Result<F, Trouble> {
        if self.is_zero() {
            return Ok(F::whole(0));
        }
        let primitive = horner(&self.terms, 0, values)?;
        if self.content.is_one() { Ok(primitive) } else { primitive.times(&F::rational(&self.content)) }
    }

    /// The sign of the leading coefficient: -1, 0 or 1. The leading term is the lexicographically last.
    pub fn leading_sign(&self) -> i64 {
        if self.is_zero() {
            return 0;
        }
        if self.content.sign() == Sign::Negative { -1 } else { 1 }
    }

    /// The largest exponents that divide every term.
    pub(crate) fn monomial_part(&self) -> Exponents {
        let mut least = self.terms.first().map_or([0; SLOTS], |(exponents, _)| *exponents);
        for (exponents, _) in &self.terms {
            least.iter_mut().zip(exponents).for_each(|(low, e)| *low = (*low).min(*e));
        }
        least
    }

    /// The product with a monomial's inverse, which must divide every term.
    pub(crate) fn without_monomial(&self, monomial: &Exponents) -> Self {
        let mut terms = self.terms.clone();
        for (exponents, _) in &mut terms {
            exponents.iter_mut().zip(monomial).for_each(|(e, m)| *e = e.saturating_sub(*m));
        }
        Polynomial { terms, content: self.content.clone() }
    }

    /// The monomial with these exponents.
    pub(crate) fn monomial(exponents: Exponents) -> Self {
        Polynomial { terms: vec![(exponents, IBig::ONE)], content: RBig::ONE }
    }

    fn checked(self) -> Result<Self, Trouble> {
        let low = |exponents: &Exponents| exponents.iter().all(|e| *e <= MAX_EXPONENT);
        let small = self.content.numerator().bit_len().max(self.content.denominator().bit_len()) <= MAX_BITS;
        let fits = self.terms.len() <= MAX_TERMS && small;
        let fits = fits && self.terms.iter().all(|(e, c)| low(e) && c.bit_len() <= MAX_BITS);
        if fits { Ok(self) } else { Err(TOO_LARGE) }
    }
}

/// Rational numbers as a field without limits, for values at a point.
#[derive(Clone, Debug, PartialEq)]
struct Exact(RBig);

impl Field for Exact {
    fn rational(value: &RBig) -> Self {
        Exact(value.clone())
    }
    fn negated(&self) -> Self {
        Exact(-&self.0)
    }
    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        Ok(Exact(&self.0 + &other.0))
    }
    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        Ok(Exact(&self.0 * &other.0))
    }
    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        if other.0.is_zero() { Err(Trouble::DivisionByZero) } else { Ok(Exact(&self.0 / &other.0)) }
    }
    fn is_certainly_zero(&self) -> bool {
        self.0.is_zero()
    }
}

pub(crate) fn total(exponents: &Exponents) -> usize {
    exponents.iter().map(|e| usize::from(*e)).sum()
}

/// The greatest common divisor of the coefficients, of which there is at least one.
fn common_divisor(terms: &[Term]) -> UBig {
    let mut divisor = UBig::ZERO;
    for (_, coefficient) in terms {
        divisor = divisor.gcd(coefficient.clone().into_parts().1);
        if divisor.is_one() {
            break;
        }
    }
    divisor
}

/// The largest rational number of which both, which are not zero, are whole multiples.
fn common_unit(a: &RBig, b: &RBig) -> RBig {
    let numerator = a.numerator().gcd(b.numerator());
    let shared = a.denominator().gcd(b.denominator());
    RBig::from_parts(numerator.into(), a.denominator() / shared * b.denominator())
}

fn whole_part(value: &RBig) -> IBig {
    value.numerator().clone()
}

fn multiple(coefficient: &IBig, factor: &IBig) -> IBig {
    if factor.is_one() { coefficient.clone() } else { coefficient * factor }
}

/// `a` times the left sum plus `b` times the right sum.
fn merged(left: &[Term], a: &IBig, right: &[Term], b: &IBig) -> Vec<Term> {
    let mut sum = Vec::with_capacity(left.len() + right.len());
    let (mut i, mut j) = (0, 0);
    while let (Some((p, x)), Some((q, y))) = (left.get(i), right.get(j)) {
        match p.cmp(q) {
            std::cmp::Ordering::Less => sum.push((*p, multiple(x, a))),
            std::cmp::Ordering::Greater => sum.push((*q, multiple(y, b))),
            std::cmp::Ordering::Equal => sum.push((*p, multiple(x, a) + multiple(y, b))),
        }
        i += usize::from(p <= q);
        j += usize::from(q <= p);
    }
    sum.extend(left[i..].iter().map(|(p, x)| (*p, multiple(x, a))));
    sum.extend(right[j..].iter().map(|(q, y)| (*q, multiple(y, b))));
    sum.retain(|(_, coefficient)| !coefficient.is_zero());
    sum
}

fn product(left: &[Term], right: &[Term]) -> Result<Vec<Term>, Trouble> {
    if left.len().saturating_mul(right.len()) > MAX_PRODUCTS {
        return Err(TOO_LARGE);
    }
    let mut all = Vec::with_capacity(left.len() * right.len());
    for (p, x) in left {
        for (q, y) in right {
            all.push((raised(p, q)?, x * y));
        }
    }
    all.sort_unstable_by_key(|term| term.0);
    Ok(collected(all))
}

/// The sum of the exponents.
fn raised(p: &Exponents, q: &Exponents) -> Result<Exponents, Trouble> {
    let mut sum = *p;
    for (slot, e) in sum.iter_mut().zip(q) {
        *slot += e;
        if *slot > MAX_EXPONENT {
            return Err(TOO_LARGE);
        }
    }
    Ok(sum)
}

/// Sorted terms with those of equal exponents added up.
fn collected(all: Vec<Term>) -> Vec<Term> {
    let mut sum: Vec<Term> = Vec::with_capacity(all.len());
    for (exponents, coefficient) in all {
        match sum.last_mut() {
            Some((last, total)) if *last == exponents => *total += coefficient,
            _ => sum.push((exponents, coefficient)),
        }
    }
    sum.retain(|(_, coefficient)| !coefficient.is_zero());
    sum
}

/// The exponents of p/q, if q divides p.
fn lowered(p: &Exponents, q: &Exponents) -> Option<Exponents> {
    let mut difference = *p;
    for (slot, e) in difference.iter_mut().zip(q) {
        *slot = slot.checked_sub(*e)?;
    }
    Some(difference)
}

fn divided_term((p, x): (&Exponents, &IBig), (q, y): &Term) -> Option<Term> {
    let exponents = lowered(p, q)?;
    let quotient = x / y;
    (&quotient * y == *x).then_some((exponents, quotient))
}

/// The quotient of primitive parts, by division of leading terms.
fn quotient(dividend: &[Term], divisor: &[Term]) -> Option<Vec<Term>> {
    let leading = divisor.last()?;
    if let [single] = divisor {
        return dividend.iter().map(|(p, x)| divided_term((p, x), single)).collect();
    }
    let (first, lowest) = (dividend.first()?, divisor.first()?);
    divided_term((&first.0, &first.1), lowest)?;
    let mut rest: BTreeMap<Exponents, IBig> = dividend.iter().cloned().collect();
    let (mut terms, mut products) = (Vec::new(), 0);
    while let Some((p, x)) = rest.pop_last() {
        let (e, c) = divided_term((&p, &x), leading)?;
        products += divisor.len();
        if products > MAX_PRODUCTS || c.bit_len() > MAX_BITS {
            return None;
        }
        for (q, y) in &divisor[..divisor.len() - 1] {
            subtract(&mut rest, raised(&e, q).ok()?, &c * y);
        }
        terms.push((e, c));
    }
    terms.reverse();
    Some(terms)
}

fn subtract(rest: &mut BTreeMap<Exponents, IBig>, exponents: Exponents, value: IBig) {
    let slot = rest.entry(exponents).or_insert(IBig::ZERO);
    *slot -= value;
    if slot.is_zero() {
        rest.remove(&exponents);
    }
}

/// The value of a sum of terms that agree in the indeterminates before this one.
fn horner<F: Field>(terms: &[Term], index: usize, values: &[F]) -> Result<F, Trouble> {
    if index == SLOTS {
        return Ok(terms.first().map_or(F::whole(0), |(_, c)| F::rational(&RBig::from(c.clone()))));
    }
    let highest = terms.last().map_or(0, |(exponents, _)| exponents[index]);
    if highest == 0 {
        return horner(terms, index + 1, values);
    }
    let value = values.get(index).ok_or(Trouble::Domain("an indeterminate without a value"))?;
    let (mut sum, mut power): (Option<F>, u16) = (None, highest);
    for part in terms.chunk_by(|(p, _), (q, _)| p[index] == q[index]).rev() {
        let exponent = part.first().map_or(0, |(exponents, _)| exponents[index]);
        let inner = horner(part, index + 1, values)?;
        sum = Some(match sum {
            None => inner,
            Some(sum) => raised_value(sum, value, power - exponent)?.plus(&inner)?,
        });
        power = exponent;
    }
    raised_value(sum.unwrap_or(F::whole(0)), value, power)
}

/// `sum * value^exponent`
fn raised_value<F: Field>(sum: F, value: &F, exponent: u16) -> Result<F, Trouble> {
    (0..exponent).try_fold(sum, |sum, _| sum.times(value))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use proptest::prelude::*;

    pub(crate) fn whole(value: i64) -> Polynomial {
        Polynomial::whole(value)
    }

    pub(crate) fn ratio(a: i64, b: i64) -> RBig {
        RBig::from(a) / RBig::from(b)
    }

    /// The sum of the terms coefficient * n^i * c^j.
    pub(crate) fn polynomial(terms: &[(i64, u16, u16)]) -> Polynomial {
        terms.iter().fold(whole(0), |sum, (value, i, j)| {
            let term = Polynomial::power_of_variable(0, *i).times(&Polynomial::power_of_variable(1, *j)).unwrap();
            sum.plus(&term.scaled(&RBig::from(*value))).unwrap()
        })
    }

    pub(crate) fn small() -> impl Strategy<Value = Polynomial> {
        let term = (-6i64..7, 0u16..4, 0u16..3);
        proptest::collection::vec(term, 0..5).prop_map(|terms| polynomial(&terms))
    }

    proptest! {
        #[test]
        fn ring_laws(a in small(), b in small(), c in small()) {
            prop_assert_eq!(a.plus(&b).unwrap(), b.plus(&a).unwrap());
            prop_assert_eq!(a.times(&b).unwrap(), b.times(&a).unwrap());
            let left = a.times(&b.plus(&c).unwrap()).unwrap();
            prop_assert_eq!(left, a.times(&b).unwrap().plus(&a.times(&c).unwrap()).unwrap());
            prop_assert!(a.minus(&a).unwrap().is_zero());
        }

        #[test]
        fn products_divide_back(a in small(), b in small()) {
            prop_assume!(!b.is_zero());
            let product = a.times(&b).unwrap();
            prop_assert_eq!(product.divided_exactly(&b), Some(a.clone()));
            let off = product.plus(&whole(1)).unwrap();
            if let Some(quotient) = off.divided_exactly(&b) {
                prop_assert_eq!(quotient.times(&b).unwrap(), off);
            }
        }

        #[test]
        fn values_are_homomorphic(a in small(), b in small(), x in -5i64..6, y in 1i64..6) {
            let point = [ratio(x, y), ratio(y, 7)];
            let value = |p: &Polynomial| p.value(&point).unwrap();
            prop_assert_eq!(value(&a.times(&b).unwrap()), value(&a) * value(&b));
            prop_assert_eq!(value(&a.plus(&b).unwrap()), value(&a) + value(&b));
            let step = a.at(0, &point[0]).unwrap().at(1, &point[1]).unwrap();
            prop_assert_eq!(step.as_constant(), Some(value(&a)));
        }

        #[test]
        fn coefficients_add_up(a in small()) {
            for index in 0..3 {
                let parts = a.coefficients_in(index);
                prop_assert_eq!(Polynomial::from_coefficients_in(index, &parts).unwrap(), a.clone());
            }
        }
    }

    #[test]
    fn derivatives_and_degrees() {
        let p = polynomial(&[(3, 2, 1), (-5, 1, 0), (7, 0, 0)]);
        assert_eq!(p.derivative_in(0), polynomial(&[(6, 1, 1), (-5, 0, 0)]));
        assert_eq!((p.degree_in(0), p.degree_in(1), p.degree_in(9), p.total_degree()), (2, 1, 0, 3));
        assert_eq!((p.leading_sign(), p.negated().leading_sign()), (1, -1));
        assert_eq!(p.substituted(1, &Polynomial::variable(0)).unwrap().total_degree(), 3);
    }

    #[test]
    fn limits_and_zero_are_told() {
        let steep = Polynomial::variable(0).power(200).unwrap();
        assert_eq!(steep.times(&steep), Err(TOO_LARGE));
        let sum = (0..VARIABLES).fold(whole(1), |sum, i| sum.plus(&Polynomial::variable(i)).unwrap());
        assert_eq!(sum.power(40), Err(TOO_LARGE));
        assert_eq!((0..14).try_fold(whole(3), |value, _| value.times(&value)), Err(TOO_LARGE));
        assert_eq!(whole(1).divided_exactly(&whole(0)), None);
        assert!(Polynomial::variable(99).is_zero());
        assert!(Polynomial::variable(2).value(&[]).is_err());
    }
}
