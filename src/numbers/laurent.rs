//! Is this sum of weights 1 for *every* valence?
//!
//! Exact arithmetic with rational combinations of products of *atoms*: the valence `n`, the ring index `j`, parameters,
//! pi, and values such as `cos(2*pi/n)` that are taken as they stand. A product has whole exponents of either sign, so
//! that `n * (beta/n)` cancels; hence the name, after Laurent polynomials. An equality shown here is an identity, wherever
//! both sides are defined. An inequality of two normal forms shows nothing, since atoms may be related
//! (cos^2 + sin^2 = 1): use it to prove, never to refute.

use super::{Field, Function, Number, Trouble};
use dashu_base::{BitTest, Sign};
use dashu_ratio::RBig;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Stated limits on the size of a normal form; beyond them [`Trouble::BeyondThisWorld`].
const MAX_TERMS: usize = 1000;
const MAX_EXPONENT: i64 = 64;
const MAX_BITS: usize = 4096;

const TOO_LARGE: Trouble = Trouble::BeyondThisWorld("the exact form is too large to hold");

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Atom {
    Name(String),
    Call(Function, Vec<Laurent>),
    /// A sum of several terms in a denominator, with leading coefficient 1.
    Sum(Laurent),
}

/// A product of atoms with exponents other than 0, in order of the atoms.
pub(super) type Monomial = BTreeMap<Atom, i64>;

/// A rational combination of products of atoms, in normal form: no term has coefficient 0.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Laurent {
    terms: BTreeMap<Monomial, RBig>,
    /// The number of terms, those inside of atoms counted as often as they stand there.
    size: usize,
}

/// How many terms a sum over a ring has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RingSize {
    /// The atom `n`, which stands for every whole number from this one on.
    From(i64),
    /// One number.
    Exactly(i64),
}

impl Laurent {
    /// An indeterminate, by its name.
    pub fn atom(name: &str) -> Self {
        Laurent::of_atom(Atom::Name(name.to_string()))
    }

    /// A rational number.
    pub fn constant(value: RBig) -> Self {
        Laurent::from_terms([(Monomial::new(), value)])
    }

    /// The rational number that this is, if it is one.
    pub fn as_constant(&self) -> Option<RBig> {
        match self.terms.len() {
            0 => Some(RBig::ZERO),
            1 => self.terms.get(&Monomial::new()).cloned(),
            _ => None,
        }
    }

    /// The exponents of a name with their coefficients, where this is a sum of its powers with rational coefficients.
    pub fn powers_of(&self, name: &str) -> Option<Vec<(i64, RBig)>> {
        let power = |(monomial, coefficient): (&Monomial, &RBig)| {
            let exponent = match monomial.iter().collect::<Vec<_>>().as_slice() {
                [] => 0,
                [(Atom::Name(own), exponent)] if own == name => **exponent,
                _ => return None,
            };
            Some((exponent, coefficient.clone()))
        };
        self.terms.iter().map(power).collect()
    }

    /// The sum of this over `j = 0..n-1`, where it can be read off: terms without `j` count n times, and a term that is
    /// linear in one `cos(2*pi*p*j/n)` or `sin(2*pi*p*j/n)` with n not dividing p sums to nothing (a sum of roots of unity).
    pub fn sum_over_ring(&self, size: RingSize) -> Option<Laurent> {
        let n = match size {
            RingSize::From(_) => Laurent::atom("n"),
            RingSize::Exactly(n) => Laurent::whole(n),
        };
        let mut sum = Laurent::whole(0);
        for (monomial, coefficient) in &self.terms {
            let waves: Vec<_> = monomial.iter().filter(|(atom, _)| atom.mentions("j")).collect();
            match waves.as_slice() {
                [] => {
                    let term = Laurent::from_terms([(monomial.clone(), coefficient.clone())]);
                    sum = sum.plus(&term.times(&n).ok()?).ok()?;
                }
                [(wave, 1)] if wave.sums_to_nothing(size) => {}
                _ => return None,
            }
        }
        Some(sum)
    }

    /// Its terms: products of atoms with their coefficients.
    pub(super) fn terms(&self) -> impl Iterator<Item = (&Monomial, &RBig)> {
        self.terms.iter()
    }

    fn of_atom(atom: Atom) -> Self {
        Laurent::from_terms([(Monomial::from([(atom, 1)]), RBig::ONE)])
    }

    fn from_terms(terms: impl IntoIterator<Item = (Monomial, RBig)>) -> Self {
        let terms: BTreeMap<_, _> = terms.into_iter().filter(|(_, coefficient)| !coefficient.is_zero()).collect();
        let inner = terms.keys().flat_map(|monomial| monomial.keys()).map(Atom::size);
        let size = inner.fold(terms.len(), usize::saturating_add);
        Laurent { terms, size }
    }

    fn mentions(&self, name: &str) -> bool {
        self.terms.keys().flat_map(|monomial| monomial.keys()).any(|atom| atom.mentions(name))
    }

    fn checked(self) -> Result<Self, Trouble> {
        let small = |value: &RBig| value.numerator().bit_len().max(value.denominator().bit_len()) <= MAX_BITS;
        let low = |monomial: &Monomial| monomial.values().all(|exponent| exponent.abs() <= MAX_EXPONENT);
        let fits = self.size <= MAX_TERMS && self.terms.iter().all(|(m, c)| low(m) && small(c));
        if fits { Ok(self) } else { Err(TOO_LARGE) }
    }

    fn scaled(&self, factor: &RBig) -> Self {
        Laurent::from_terms(self.terms.iter().map(|(monomial, c)| (monomial.clone(), c * factor)))
    }

    fn inverse(&self) -> Result<Self, Trouble> {
        let (leading, coefficient) = self.terms.first_key_value().ok_or(Trouble::DivisionByZero)?;
        let inverse = RBig::ONE / coefficient;
        if self.terms.len() == 1 {
            let monomial = leading.iter().map(|(atom, exponent)| (atom.clone(), -exponent)).collect();
            return Ok(Laurent::from_terms([(monomial, inverse)]));
        }
        let monic = Atom::Sum(self.scaled(&inverse));
        Ok(Laurent::from_terms([(Monomial::from([(monic, -1)]), inverse)]))
    }

    /// The whole number that this is, if it is one of moderate size.
    fn as_whole(&self) -> Option<i64> {
        let value = self.as_constant()?;
        if value.is_int() { i64::try_from(value.numerator().clone()).ok() } else { None }
    }
}

impl Atom {
    fn size(&self) -> usize {
        match self {
            Atom::Name(_) => 0,
            Atom::Call(_, arguments) => arguments.iter().map(|argument| argument.size).fold(0, usize::saturating_add),
            Atom::Sum(sum) => sum.size,
        }
    }

    fn mentions(&self, name: &str) -> bool {
        match self {
            Atom::Name(own) => own == name,
            Atom::Call(_, arguments) => arguments.iter().any(|argument| argument.mentions(name)),
            Atom::Sum(sum) => sum.mentions(name),
        }
    }

    /// Whether this is cos or sin of 2 pi p j/n with a whole p that n does not divide.
    fn sums_to_nothing(&self, size: RingSize) -> bool {
        let Atom::Call(Function::Cos | Function::Sin, arguments) = self else { return false };
        let turns = Laurent::atom("pi").times(&Laurent::atom("j")).and_then(|angle| arguments[0].over(&angle));
        let turns = turns.and_then(|turns| match size {
            RingSize::From(_) => turns.times(&Laurent::atom("n")),
            RingSize::Exactly(n) => turns.times(&Laurent::whole(n)),
        });
        let Some(twice_p) = turns.ok().and_then(|turns| turns.as_whole()) else { return false };
        let p = twice_p / 2;
        twice_p % 2 == 0
            && match size {
                RingSize::From(first) => p != 0 && p.abs() < first,
                RingSize::Exactly(n) => p % n != 0,
            }
    }
}

/// A whole power of a number, its size known before it is computed.
fn constant_power(base: &RBig, exponent: i64) -> Result<Laurent, Trouble> {
    if base.is_zero() && exponent < 0 {
        return Err(Trouble::DivisionByZero);
    }
    let bits = base.numerator().bit_len().max(base.denominator().bit_len());
    let unit = base.numerator().bit_len() <= 1 && base.denominator().bit_len() <= 1;
    let times = usize::try_from(exponent.unsigned_abs()).map_err(|_| TOO_LARGE)?;
    if !unit && bits.saturating_mul(times) > 4 * MAX_BITS {
        return Err(TOO_LARGE);
    }
    let times = if unit { times % 2 + usize::from(times > 1) * 2 } else { times };
    let power = base.pow(isize::try_from(times).map_err(|_| TOO_LARGE)?);
    Laurent::constant(if exponent < 0 { RBig::ONE / power } else { power }).checked()
}

/// A binomial coefficient of whole numbers, the upper one at most 1000.
fn binomial(n: &RBig, k: &RBig) -> Result<Laurent, Trouble> {
    let domain = Trouble::Domain("binom(a, b) takes whole numbers, 0 <= a <= 1000");
    let whole = |value: &RBig| Laurent::constant(value.clone()).as_whole().ok_or(domain.clone());
    let (n, k) = (whole(n)?, whole(k)?);
    if !(0..=1000).contains(&n) {
        return Err(domain);
    }
    if k < 0 || k > n {
        return Ok(Laurent::whole(0));
    }
    let product = (0..k.min(n - k)).fold(RBig::ONE, |product, i| product * RBig::from(n - i) / RBig::from(i + 1));
    Laurent::constant(product).checked()
}

impl Field for Laurent {
    fn rational(value: &RBig) -> Self {
        Laurent::constant(value.clone())
    }

    fn negated(&self) -> Self {
        self.scaled(&RBig::from(-1))
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        let mut terms = self.terms.clone();
        for (monomial, coefficient) in &other.terms {
            *terms.entry(monomial.clone()).or_insert(RBig::ZERO) += coefficient;
        }
        Laurent::from_terms(terms).checked()
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        if self.terms.len() * other.terms.len() > MAX_TERMS {
            return Err(TOO_LARGE);
        }
        let mut product = BTreeMap::new();
        for (left, a) in &self.terms {
            for (right, b) in &other.terms {
                let mut monomial = left.clone();
                for (atom, exponent) in right {
                    *monomial.entry(atom.clone()).or_insert(0) += exponent;
                }
                monomial.retain(|_, exponent| *exponent != 0);
                *product.entry(monomial).or_insert(RBig::ZERO) += a * b;
            }
        }
        Laurent::from_terms(product).checked()
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        self.times(&other.inverse()?)
    }

    fn is_certainly_zero(&self) -> bool {
        self.terms.is_empty()
    }
}

impl Number for Laurent {
    fn indeterminate(name: &str) -> Option<Self> {
        Some(Laurent::atom(name))
    }

    fn pi() -> Self {
        Laurent::atom("pi")
    }

    fn power(&self, exponent: &Self) -> Result<Self, Trouble> {
        if let (Some(base), Some(exponent)) = (self.as_constant(), exponent.as_whole()) {
            return constant_power(&base, exponent);
        }
        let whole = exponent.as_whole().filter(|e| e.abs() <= MAX_EXPONENT);
        let exponent = whole.ok_or(Trouble::BeyondThisWorld("the exponent is not a small whole number"))?;
        let base = if exponent < 0 { self.inverse()? } else { self.clone() };
        (0..exponent.abs()).try_fold(Laurent::whole(1), |product, _| product.times(&base))
    }

    fn call(function: Function, arguments: &[Self]) -> Result<Self, Trouble> {
        let constants: Option<Vec<RBig>> = arguments.iter().map(Laurent::as_constant).collect();
        match (function, constants.as_deref()) {
            (Function::Cos, Some([angle])) if angle.is_zero() => Ok(Laurent::whole(1)),
            (Function::Sin, Some([angle])) if angle.is_zero() => Ok(Laurent::whole(0)),
            (Function::Sqrt, Some([value])) if value.sign() == Sign::Negative => Err(Trouble::NegativeRoot),
            (Function::Min, Some([a, b])) => Ok(Laurent::constant(a.min(b).clone())),
            (Function::Max, Some([a, b])) => Ok(Laurent::constant(a.max(b).clone())),
            (Function::Binom, Some([n, k])) => binomial(n, k),
            (Function::Binom | Function::Min | Function::Max, _) => {
                Err(Trouble::BeyondThisWorld("binom, min and max are decided for numbers only"))
            }
            _ => Laurent::of_atom(Atom::Call(function, arguments.to_vec())).checked(),
        }
    }

    fn order(&self, other: &Self) -> Option<Ordering> {
        Some(self.as_constant()?.cmp(&other.as_constant()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(a: i64, b: i64) -> Laurent {
        Laurent::whole(a).over(&Laurent::whole(b)).unwrap()
    }

    /// cos(2 pi p j/n)
    fn wave(p: i64) -> Laurent {
        let angle = Laurent::whole(2 * p).times(&Laurent::pi()).unwrap().times(&Laurent::atom("j")).unwrap();
        Laurent::call(Function::Cos, &[angle.over(&Laurent::atom("n")).unwrap()]).unwrap()
    }

    #[test]
    fn products_with_inverse_powers_cancel() {
        let n = Laurent::atom("n");
        let beta = ratio(5, 8).plus(&wave(1)).unwrap().over(&n).unwrap();
        let sum = Laurent::whole(1).plus(&n.times(&beta).unwrap().negated()).unwrap();
        let back = sum.plus(&beta.times(&n).unwrap()).unwrap();
        assert_eq!(back, Laurent::whole(1));
    }

    #[test]
    fn ring_sums_of_waves_vanish_unless_they_alias() {
        let weight = Laurent::whole(3).plus(&wave(1)).unwrap().over(&Laurent::atom("n")).unwrap();
        assert_eq!(weight.sum_over_ring(RingSize::From(3)), Some(Laurent::whole(3)));
        assert_eq!(wave(4).sum_over_ring(RingSize::From(4)), None, "n = 4 is among them, and 4 divides 4");
        assert_eq!(wave(4).sum_over_ring(RingSize::From(5)), Some(Laurent::whole(0)));
        assert_eq!(wave(1).times(&wave(1)).unwrap().sum_over_ring(RingSize::From(3)), None, "a square is not linear");
    }

    #[test]
    fn growth_stops_at_a_limit() {
        let sum = (0..40).fold(Laurent::whole(0), |sum, i| sum.plus(&Laurent::atom(&format!("a{i}"))).unwrap());
        assert_eq!(sum.power(&Laurent::whole(3)), Err(TOO_LARGE));
        let huge = Laurent::whole(2).power(&Laurent::whole(64)).unwrap();
        assert_eq!(huge.power(&huge), Err(Trouble::BeyondThisWorld("the exponent is not a small whole number")));
        let steep = (0..8).try_fold(Laurent::whole(3), |value, _| value.power(&Laurent::whole(64)));
        assert_eq!(steep, Err(TOO_LARGE));
        assert_eq!(Laurent::whole(1).over(&Laurent::whole(0)), Err(Trouble::DivisionByZero));
    }
}
