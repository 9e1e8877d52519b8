//! What is the value of an exact form in another exact world?
//!
//! A formula is brought to its normal form once ([`Laurent`]) and read in the world of a stage: at one valence or for all, in a
//! field or in enclosures, at one point of a ring or over the whole of it ([`Series`](super::Series)). A world says what names,
//! cosines, sines and roots are there; the rest is field arithmetic.

use super::laurent::Atom;
use super::{Field, Function, Laurent, Trouble};
use dashu_base::{Gcd, SquareRoot, UnsignedAbs};
use dashu_ratio::RBig;

/// A world that exact forms can be read in.
pub trait World {
    /// Its numbers.
    type Value: Field;
    /// The value of a name: `n`, `j` or a parameter.
    ///
    /// # Errors
    /// When the name has no value here.
    fn name(&self, name: &str) -> Result<Self::Value, Trouble>;
    /// The circle's constant.
    ///
    /// # Errors
    /// Where numbers are algebraic.
    fn pi(&self) -> Result<Self::Value, Trouble> {
        Err(Trouble::BeyondThisWorld("pi is exact only inside of cosines and sines"))
    }
    /// The cosine of an angle.
    ///
    /// # Errors
    /// When this world doesn't have it.
    fn cos(&self, angle: &Angle) -> Result<Self::Value, Trouble>;
    /// The sine of an angle.
    ///
    /// # Errors
    /// When this world doesn't have it.
    fn sin(&self, angle: &Angle) -> Result<Self::Value, Trouble>;
    /// The square root of a value.
    ///
    /// # Errors
    /// When the value is negative, or this world doesn't have its root.
    fn sqrt(&self, radicand: &Self::Value) -> Result<Self::Value, Trouble>;
}

/// The angle `constant + per_n/n + j (per_j + per_jn/n)`, in turns (of 2 pi).
#[derive(Clone, Debug, PartialEq)]
pub struct Angle {
    /// The part that is a number.
    pub constant: RBig,
    /// The part over n.
    pub per_n: RBig,
    /// The part that goes with j.
    pub per_j: RBig,
    /// The part that goes with j/n.
    pub per_jn: RBig,
}

/// Said where an angle is not one of those above.
const NO_ANGLE: Trouble =
    Trouble::BeyondThisWorld("exact cosines and sines are those of rational multiples of pi, pi/n and pi*j/n");

impl Angle {
    /// A fixed angle.
    pub fn fixed(constant: RBig) -> Angle {
        Angle { constant, per_n: RBig::ZERO, per_j: RBig::ZERO, per_jn: RBig::ZERO }
    }

    /// The angle at the index j = 0.
    pub fn at_start(&self) -> Angle {
        Angle { per_j: RBig::ZERO, per_jn: RBig::ZERO, ..self.clone() }
    }

    /// The number of turns, where the angle is fixed.
    ///
    /// # Errors
    /// When it depends on n or j.
    pub fn turns(&self) -> Result<&RBig, Trouble> {
        let free = [&self.per_n, &self.per_j, &self.per_jn].iter().any(|part| !part.is_zero());
        if free { Err(NO_ANGLE) } else { Ok(&self.constant) }
    }

    /// Reads an angle in radians off its exact form.
    fn of(form: &Laurent) -> Result<Angle, Trouble> {
        let mut angle = Angle::fixed(RBig::ZERO);
        for (monomial, coefficient) in form.terms() {
            let mut factors: Vec<(&str, i64)> = Vec::new();
            for (atom, exponent) in monomial {
                let Atom::Name(name) = atom else { return Err(NO_ANGLE) };
                factors.push((name, *exponent));
            }
            factors.sort_unstable();
            let part = match factors.as_slice() {
                [("pi", 1)] => &mut angle.constant,
                [("n", -1), ("pi", 1)] => &mut angle.per_n,
                [("j", 1), ("pi", 1)] => &mut angle.per_j,
                [("j", 1), ("n", -1), ("pi", 1)] => &mut angle.per_jn,
                _ => return Err(NO_ANGLE),
            };
            *part += coefficient / RBig::from(2);
        }
        Ok(angle)
    }
}

/// The part of a number of turns after whole ones, from 0 up to 1.
pub(super) fn fraction_of_turn(turns: &RBig) -> RBig {
    turns - RBig::from(turns.floor())
}

/// The cosine of a number of turns, where it is rational (Niven 1956).
pub(super) fn rational_cosine(turns: &RBig) -> Option<RBig> {
    let twelfths = fraction_of_turn(turns) * RBig::from(12);
    let index = if twelfths.is_int() { usize::try_from(twelfths.numerator().clone()).ok()? } else { return None };
    let doubled = [Some(2), None, Some(1), Some(0), Some(-1), None, Some(-2), None, Some(-1), Some(0), Some(1), None];
    doubled[index % 12].map(|doubled| RBig::from(doubled) / RBig::from(2))
}

/// The denominator of a number of turns, when it is moderate.
pub(super) fn denominator(turns: &RBig) -> Option<u64> {
    u64::try_from(turns.denominator().clone()).ok()
}

/// The least common multiple, if it is moderate.
pub(super) fn common_multiple(a: u64, b: u64) -> Option<u64> {
    (a / a.gcd(b).max(1)).checked_mul(b)
}

impl Laurent {
    /// The value of this form in a world.
    ///
    /// # Errors
    /// When a divisor is zero there, or the world lacks a name, a function's value, or room.
    pub fn read<W: World>(&self, world: &W) -> Result<W::Value, Trouble> {
        let mut sum = W::Value::whole(0);
        for (monomial, coefficient) in self.terms() {
            let mut term = W::Value::rational(coefficient);
            for (atom, exponent) in monomial {
                let value = power(&atom.read(world)?, exponent.unsigned_abs())?;
                term = if *exponent < 0 { term.over(&value)? } else { term.times(&value)? };
            }
            sum = sum.plus(&term)?;
        }
        Ok(sum)
    }
}

impl Atom {
    fn read<W: World>(&self, world: &W) -> Result<W::Value, Trouble> {
        match self {
            Atom::Name(name) if name == "pi" => world.pi(),
            Atom::Name(name) => world.name(name),
            Atom::Sum(sum) => sum.read(world),
            Atom::Call(function, arguments) => match (function, arguments.as_slice()) {
                (Function::Cos, [angle]) => world.cos(&Angle::of(angle)?),
                (Function::Sin, [angle]) => world.sin(&Angle::of(angle)?),
                (Function::Sqrt, [radicand]) => world.sqrt(&radicand.read(world)?),
                _ => Err(Trouble::BeyondThisWorld("binom, min and max are exact for numbers only")),
            },
        }
    }
}

/// A whole power.
///
/// # Errors
/// When it is beyond the field's limits.
pub(super) fn power<F: Field>(base: &F, exponent: u64) -> Result<F, Trouble> {
    let mut product = F::whole(1);
    for bit in (0..u64::BITS - exponent.leading_zeros()).rev() {
        product = product.times(&product)?;
        if exponent >> bit & 1 == 1 {
            product = product.times(base)?;
        }
    }
    Ok(product)
}

/// The largest square of a rational number's square factors and what is left: `value = s^2 m` with m a whole number without
/// square factors, found by trial division up to a stated limit.
///
/// # Errors
/// When the value is negative, or too large to be split.
pub fn square_part(value: &RBig) -> Result<(RBig, u64), Trouble> {
    const MOST: u64 = 1 << 32;
    let too_large = Trouble::BeyondThisWorld("the number under the root is too large to be split into factors");
    if value < &RBig::ZERO {
        return Err(Trouble::NegativeRoot);
    }
    let product = value.numerator().clone().unsigned_abs() * value.denominator();
    let root = SquareRoot::sqrt(&product);
    let over = RBig::from(value.denominator().clone());
    if &root * &root == product {
        return Ok((RBig::from(root) / over, u64::from(!product.is_zero())));
    }
    let mut rest = u64::try_from(product).ok().filter(|rest| *rest < MOST).ok_or(too_large)?;
    let (mut square, mut free) = (1_u64, 1_u64);
    let mut prime = 2;
    while prime * prime <= rest {
        while rest.is_multiple_of(prime * prime) {
            (rest, square) = (rest / (prime * prime), square * prime);
        }
        if rest.is_multiple_of(prime) {
            (rest, free) = (rest / prime, free * prime);
        }
        prime += 1;
    }
    Ok((RBig::from(square) / over, free * rest))
}
