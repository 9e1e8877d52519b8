//! Between which two numbers does a real number certainly lie?
//!
//! Interval arithmetic in fixed point: an [`Enclosure`] has two ends, whole multiples of 2^-BITS, and every operation
//! rounds its lower end down and its upper end up (Moore 1966). Whatever the numbers inside the arguments are, the
//! result holds what the operation gives for them: the *inclusion principle*. So a sign or an order that is read off
//! ends is proven. The circle's constant comes from Machin's formula (1706); cosine and sine from their Taylor series at
//! an argument reduced to [-pi/4, pi/4], where the series alternate and the first term left out bounds the rest.

use crate::numbers::{Field, Trouble};
use dashu_base::{BitTest, DivEuclid, DivRemEuclid, Sign, SquareRoot, SquareRootRem, UnsignedAbs};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use std::cmp::Ordering;
use std::sync::OnceLock;

/// Values up to 2^MAX_EXPONENT are held; beyond them [`Trouble::BeyondThisWorld`].
const MAX_EXPONENT: usize = 4096;
/// Bits carried beyond the result's while a series is summed.
const GUARD: usize = 64;
/// Pi is kept once with this many bits.
const KEPT_PI_BITS: usize = 2048 + 2 * GUARD;

const TOO_LARGE: Trouble = Trouble::BeyondThisWorld("the value is too large to enclose");

/// A real number enclosed: some x with `lo * 2^-BITS <= x <= hi * 2^-BITS`. The inclusion principle holds always.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Enclosure<const BITS: usize> {
    lo: IBig,
    hi: IBig,
}

/// Where an enclosure lies against zero.
#[derive(Clone, Copy)]
enum Side {
    Below,
    Across,
    Above,
}

impl<const BITS: usize> Enclosure<BITS> {
    /// A whole number, with no width.
    pub fn exact_whole(value: impl Into<IBig>) -> Self {
        Enclosure::point(value.into() << BITS)
    }

    /// A number that is finite, with no width if it is a multiple of 2^-BITS (with BITS of 1074 or more it always is).
    ///
    /// # Errors
    /// When the number is infinite or not a number.
    pub fn from_f64(value: f64) -> Result<Self, Trouble> {
        RBig::try_from(value).map(|exact| Enclosure::rational(&exact)).map_err(|_| Trouble::NotFinite)
    }

    /// The circle's constant.
    pub fn pi() -> Self {
        let (value, error) = pi_in_units(BITS + GUARD);
        Enclosure::around(&value, &error)
    }

    /// Both ends.
    pub fn lo_hi(&self) -> (RBig, RBig) {
        (in_units(&self.lo, BITS), in_units(&self.hi, BITS))
    }

    /// The `f64` nearest to the middle (from 2^1024 on, an infinity).
    pub fn midpoint_f64(&self) -> f64 {
        nearest_f64(&(&self.lo + &self.hi), BITS + 1)
    }

    /// The distance of the ends.
    pub fn width(&self) -> RBig {
        in_units(&(&self.hi - &self.lo), BITS)
    }

    /// How the number compares with zero, where that is certain.
    pub fn sign(&self) -> Option<Ordering> {
        self.compare(&Enclosure::point(IBig::ZERO))
    }

    /// How the numbers compare, where that is certain: disjoint enclosures, or twice the same single point.
    pub fn compare(&self, other: &Self) -> Option<Ordering> {
        if self.hi < other.lo {
            return Some(Ordering::Less);
        }
        if self.lo > other.hi {
            return Some(Ordering::Greater);
        }
        (self.is_point() && other.is_point()).then_some(Ordering::Equal)
    }

    /// Whether the rational number lies between the ends, or on one.
    pub fn contains(&self, value: &RBig) -> bool {
        let scaled = value.numerator() << BITS;
        &self.lo * value.denominator() <= scaled && scaled <= &self.hi * value.denominator()
    }

    /// Whether the enclosures have a point in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.lo <= other.hi && other.lo <= self.hi
    }

    /// The least enclosure that holds both.
    pub fn hull(&self, other: &Self) -> Self {
        Enclosure { lo: (&self.lo).min(&other.lo).clone(), hi: (&self.hi).max(&other.hi).clone() }
    }

    /// The absolute value.
    pub fn abs(&self) -> Self {
        match self.side() {
            Side::Above => self.clone(),
            Side::Below => self.negated(),
            Side::Across => Enclosure { lo: IBig::ZERO, hi: (-&self.lo).max(self.hi.clone()) },
        }
    }

    /// The square; unlike the product with itself it is never below zero.
    ///
    /// # Errors
    /// When the value is beyond the limit of size.
    pub fn square(&self) -> Result<Self, Trouble> {
        let size = self.abs();
        Enclosure::unscaled(&size.lo * &size.lo, &size.hi * &size.hi)
    }

    /// The square root. An enclosure that reaches below zero is taken from zero on.
    ///
    /// # Errors
    /// When the number is certainly negative.
    pub fn sqrt(&self) -> Result<Self, Trouble> {
        if self.hi < IBig::ZERO {
            return Err(Trouble::NegativeRoot);
        }
        let scaled = |end: &IBig| end.clone().max(IBig::ZERO).unsigned_abs() << BITS;
        Ok(Enclosure { lo: scaled(&self.lo).sqrt().into(), hi: root_up(&scaled(&self.hi)).into() })
    }

    /// The cosine of an angle in radians.
    pub fn cos(&self) -> Self {
        if self.is_certainly_zero() {
            return Enclosure::exact_whole(1);
        }
        self.wave(0)
    }

    /// The sine of an angle in radians.
    pub fn sin(&self) -> Self {
        if self.is_certainly_zero() {
            return self.clone();
        }
        self.wave(3)
    }

    /// The power with a whole exponent; `0^0` is 1.
    ///
    /// # Errors
    /// When the exponent is negative and zero is inside, or the value is beyond the limit of size.
    pub fn power(&self, exponent: i64) -> Result<Self, Trouble> {
        let base = if exponent < 0 { Enclosure::whole(1).over(self)? } else { self.clone() };
        let base = if exponent % 2 == 0 { base.abs() } else { base };
        let exponent = exponent.unsigned_abs();
        if exponent <= 1 || base.is_point() {
            return base.repeated(exponent);
        }
        // A power is increasing in the base here, so that the ends suffice.
        let lo = Enclosure::point(base.lo).repeated(exponent)?;
        let hi = Enclosure::point(base.hi).repeated(exponent)?;
        Ok(lo.hull(&hi))
    }

    /// The number with so many digits after the point, correctly rounded (halves away from zero); `None` when the
    /// enclosure is too wide to decide them.
    pub fn decimal(&self, digits: usize) -> Option<String> {
        if digits > BITS && !self.is_point() {
            return None;
        }
        let scale = ten_to(digits);
        let rounded = |end: &IBig| rounded_away(&(end * &scale), &(UBig::ONE << BITS));
        let lo = rounded(&self.lo);
        (self.is_point() || lo == rounded(&self.hi)).then(|| with_point(&lo, digits))
    }

    /// The number with so many significant digits (at least one), correctly rounded (halves away from zero); `None` when
    /// the enclosure is too wide to decide them. An exponent is written below 1e-6 and above 1e15 only.
    pub fn significant(&self, digits: usize) -> Option<String> {
        let digits = digits.max(1);
        if self.is_certainly_zero() {
            return Some("0".to_string());
        }
        let undecided = matches!(self.side(), Side::Across) || digits > 2 * (BITS + MAX_EXPONENT);
        if undecided && !self.is_point() {
            return None;
        }
        let (lo, exponent) = leading_digits(&self.lo, BITS, digits);
        let same = self.is_point() || (lo.clone(), exponent) == leading_digits(&self.hi, BITS, digits);
        same.then(|| notation(&lo, exponent, digits))
    }

    /// The enclosure of all numbers between two multiples of 2^-BITS, given by their factors in order.
    pub(crate) fn between(lo: IBig, hi: IBig) -> Self {
        Enclosure { lo, hi }
    }

    /// Both ends as multiples of 2^-BITS.
    pub(crate) fn ends(&self) -> (&IBig, &IBig) {
        (&self.lo, &self.hi)
    }

    /// This enclosure, unless it passes the limit of size.
    pub(crate) fn checked(self) -> Result<Self, Trouble> {
        let fits = |end: &IBig| end.bit_len() <= BITS + MAX_EXPONENT;
        if fits(&self.lo) && fits(&self.hi) { Ok(self) } else { Err(TOO_LARGE) }
    }

    fn point(end: IBig) -> Self {
        Enclosure { lo: end.clone(), hi: end }
    }

    fn is_point(&self) -> bool {
        self.lo == self.hi
    }

    fn side(&self) -> Side {
        if self.lo >= IBig::ZERO {
            Side::Above
        } else if self.hi <= IBig::ZERO {
            Side::Below
        } else {
            Side::Across
        }
    }

    /// Products of two ends each, brought back to one factor 2^-BITS.
    fn unscaled(lo: IBig, hi: IBig) -> Result<Self, Trouble> {
        Enclosure { lo: lo >> BITS, hi: up(&hi, BITS) }.checked()
    }

    /// What lies within an error of a value, both in units of 2^-(BITS + GUARD).
    fn around(value: &IBig, error: &IBig) -> Self {
        Enclosure { lo: (value - error) >> GUARD, hi: up(&(value + error), GUARD) }
    }

    fn repeated(&self, mut exponent: u64) -> Result<Self, Trouble> {
        let (mut product, mut base) = (Enclosure::whole(1), self.clone());
        while exponent > 0 {
            if exponent & 1 == 1 {
                product = product.times(&base)?;
            }
            exponent >>= 1;
            if exponent > 0 {
                base = base.square()?;
            }
        }
        Ok(product)
    }

    /// cos(x + quarters * pi/2). The middle's value, give or take the radius: no wave is steeper than 1.
    fn wave(&self, quarters: u8) -> Self {
        let one = IBig::ONE << BITS;
        let middle: IBig = (&self.lo + &self.hi) >> 1;
        let radius = &self.hi - &middle;
        if radius >= one || middle.bit_len() > BITS + MAX_EXPONENT {
            return Enclosure { lo: -&one, hi: one };
        }
        let (value, error) = wave_in_units(&middle, BITS, quarters);
        let narrow = Enclosure::<BITS>::around(&value, &error);
        Enclosure { lo: (narrow.lo - &radius).max(-&one), hi: (narrow.hi + radius).min(one) }
    }
}

impl<const BITS: usize> Field for Enclosure<BITS> {
    const EXACT: bool = false;

    fn rational(value: &RBig) -> Self {
        let denominator: &IBig = value.denominator().as_ibig();
        let scaled = value.numerator() << BITS;
        Enclosure { lo: (&scaled).div_euclid(denominator), hi: quotient_up(&scaled, denominator) }
    }

    fn whole(value: i64) -> Self {
        Enclosure::exact_whole(value)
    }

    fn negated(&self) -> Self {
        Enclosure { lo: -&self.hi, hi: -&self.lo }
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        Enclosure { lo: &self.lo + &other.lo, hi: &self.hi + &other.hi }.checked()
    }

    fn minus(&self, other: &Self) -> Result<Self, Trouble> {
        Enclosure { lo: &self.lo - &other.hi, hi: &self.hi - &other.lo }.checked()
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        let (a, b, c, d) = (&self.lo, &self.hi, &other.lo, &other.hi);
        let (lo, hi) = match (self.side(), other.side()) {
            (Side::Above, Side::Above) => (a * c, b * d),
            (Side::Above, Side::Across) => (b * c, b * d),
            (Side::Above, Side::Below) => (b * c, a * d),
            (Side::Across, Side::Above) => (a * d, b * d),
            (Side::Across, Side::Across) => ((a * d).min(b * c), (a * c).max(b * d)),
            (Side::Across, Side::Below) => (b * c, a * c),
            (Side::Below, Side::Above) => (a * d, b * c),
            (Side::Below, Side::Across) => (a * d, a * c),
            (Side::Below, Side::Below) => (b * d, a * c),
        };
        Enclosure::unscaled(lo, hi)
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        if other.hi < IBig::ZERO {
            return self.negated().over(&other.negated());
        }
        if other.lo <= IBig::ZERO {
            return Err(Trouble::DivisionByZero);
        }
        let low_divisor = if self.lo >= IBig::ZERO { &other.hi } else { &other.lo };
        let high_divisor = if self.hi >= IBig::ZERO { &other.lo } else { &other.hi };
        let lo = (&self.lo << BITS).div_euclid(low_divisor);
        Enclosure { lo, hi: quotient_up(&(&self.hi << BITS), high_divisor) }.checked()
    }

    fn is_certainly_zero(&self) -> bool {
        self.lo.is_zero() && self.hi.is_zero()
    }
}

/// The rational number with so many digits after the point, rounded to nearest, halves to an even last digit.
pub fn rational_decimal(value: &RBig, digits: usize) -> String {
    let denominator = value.denominator();
    let (quotient, rest) = (value.numerator() * ten_to(digits)).div_rem_euclid(denominator.as_ibig());
    let up = match (rest << 1).cmp(denominator) {
        Ordering::Less => false,
        Ordering::Equal => quotient.bit(0),
        Ordering::Greater => true,
    };
    with_point(&(quotient + IBig::from(up)), digits)
}

fn in_units(value: &IBig, bits: usize) -> RBig {
    RBig::from_parts(value.clone(), UBig::ONE << bits)
}

/// value / 2^bits, rounded up.
fn up(value: &IBig, bits: usize) -> IBig {
    -(-value >> bits)
}

/// The quotient by a positive divisor, rounded up.
fn quotient_up(value: &IBig, divisor: &IBig) -> IBig {
    -(-value).div_euclid(divisor)
}

fn root_up(value: &UBig) -> UBig {
    let (root, rest) = value.sqrt_rem();
    if rest.is_zero() { root } else { root + UBig::ONE }
}

/// The `f64` nearest to value * 2^-bits.
pub(crate) fn nearest_f64(value: &IBig, bits: usize) -> f64 {
    let (sign, size) = value.clone().into_parts();
    let dropped = size.bit_len().saturating_sub(63);
    let kept = &size >> dropped;
    let sticky = u64::from((&kept << dropped) != size);
    let mantissa = u64::try_from(kept).unwrap_or(u64::MAX) | sticky;
    let exponent = dropped as i64 - bits as i64;
    let magnitude = times_power_of_two(mantissa as f64, exponent);
    if sign == Sign::Negative { -magnitude } else { magnitude }
}

fn times_power_of_two(mut value: f64, mut exponent: i64) -> f64 {
    while exponent != 0 && value != 0.0 && value.is_finite() {
        let step = exponent.clamp(-900, 900);
        value *= f64::from_bits(((step + 1023) as u64) << 52);
        exponent -= step;
    }
    value
}

/// Pi and a bound for its error, in units of 2^-bits.
fn pi_in_units(bits: usize) -> (IBig, IBig) {
    static KEPT: OnceLock<(IBig, IBig)> = OnceLock::new();
    if bits > KEPT_PI_BITS {
        return machin(bits);
    }
    let (value, error) = KEPT.get_or_init(|| machin(KEPT_PI_BITS));
    let drop = KEPT_PI_BITS - bits;
    (value >> drop, (error >> drop) + IBig::from(2))
}

/// pi = 16 arctan(1/5) - 4 arctan(1/239)
fn machin(bits: usize) -> (IBig, IBig) {
    let (fifth, fifth_error) = arctan_of_inverse(5, bits);
    let (small, small_error) = arctan_of_inverse(239, bits);
    (fifth * 16 - small * 4, IBig::from(16 * fifth_error + 4 * small_error))
}

/// arctan(1/k) and a bound for its error. Each power is at most 2 units too small, so each term is off by at most 3; the
/// series alternates, so its rest is at most the first term left out, which is below 3.
fn arctan_of_inverse(k: u32, bits: usize) -> (IBig, u64) {
    let mut power = (IBig::ONE << bits) / k;
    let (mut sum, mut terms) = (IBig::ZERO, 0u64);
    while !power.is_zero() {
        let term = &power / (2 * terms + 1);
        if terms.is_multiple_of(2) {
            sum += term
        } else {
            sum -= term
        };
        power /= k * k;
        terms += 1;
    }
    (sum, 3 * (terms + 1))
}

/// cos(angle * 2^-bits + quarters * pi/2) and a bound for its error, in units of 2^-(bits + GUARD).
fn wave_in_units(angle: &IBig, bits: usize, quarters: u8) -> (IBig, IBig) {
    let extra = angle.bit_len().saturating_sub(bits) + 8;
    let (half_pi, pi_error) = pi_in_units(bits + GUARD + extra - 1);
    let fine: IBig = angle << (GUARD + extra);
    let turns: IBig = ((&fine << 1) + &half_pi).div_euclid(&half_pi << 1);
    let rest = (fine - &turns * half_pi) >> extra;
    let size = IBig::from(turns.clone().unsigned_abs());
    let rest_error = ((size * pi_error) >> extra) + IBig::from(2);
    let quarter = (u64::try_from(turns & IBig::from(3)).unwrap_or(0) + u64::from(quarters)) % 4;
    let (value, error) = series(&rest, bits + GUARD, quarter % 2 == 1);
    // cos, -sin, -cos, sin
    let value = if quarter == 1 || quarter == 2 { -value } else { value };
    (value, rest_error + IBig::from(error))
}

/// Cosine or sine of an angle of size at most 1, and a bound for the error. A term is off by at most 4 units, since it is
/// the one before times a square at most 1, over a divisor of at least 2, with two roundings; the rest of the alternating
/// series is at most the first term left out, which is at most 4.
fn series(angle: &IBig, bits: usize, odd: bool) -> (IBig, u64) {
    let (sign, size) = angle.clone().into_parts();
    let square: UBig = (&size * &size) >> bits;
    let mut term = if odd { size } else { UBig::ONE << bits };
    let (mut sum, mut terms) = (IBig::ZERO, 0u64);
    while !term.is_zero() {
        let signed = IBig::from(term.clone());
        if terms.is_multiple_of(2) {
            sum += signed
        } else {
            sum -= signed
        };
        let next = 2 * terms + 1 + u64::from(odd);
        term = ((term * &square) >> bits) / (next * (next + 1));
        terms += 1;
    }
    let sum = if odd && sign == Sign::Negative { -sum } else { sum };
    (sum, 4 * (terms + 1))
}

fn ten_to(exponent: usize) -> UBig {
    UBig::from(10u8).pow(exponent)
}

/// The quotient rounded to nearest, halves away from zero.
fn rounded_away(numerator: &IBig, denominator: &UBig) -> IBig {
    let (sign, size) = numerator.clone().into_parts();
    let rounded = ((size << 1) + denominator) / (denominator << 1);
    IBig::from_parts(sign, rounded)
}

/// scaled / 10^digits in plain notation.
fn with_point(scaled: &IBig, digits: usize) -> String {
    let (sign, size) = scaled.clone().into_parts();
    let minus = if sign == Sign::Negative && !size.is_zero() { "-" } else { "" };
    let text = format!("{:0>width$}", size.to_string(), width = digits + 1);
    let (whole, fraction) = text.split_at(text.len() - digits);
    if digits == 0 { format!("{minus}{whole}") } else { format!("{minus}{whole}.{fraction}") }
}

/// The significant digits of value * 2^-bits, which isn't zero, as a whole number, and the first one's power of ten.
fn leading_digits(value: &IBig, bits: usize, digits: usize) -> (IBig, i64) {
    let exponent = power_of_ten(value, bits);
    let places = digits as i64 - 1 - exponent;
    let (more, less) = (places.max(0) as usize, (-places).max(0) as usize);
    let rounded = rounded_away(&(value * ten_to(more)), &(ten_to(less) << bits));
    if rounded.clone().unsigned_abs() < ten_to(digits) { (rounded, exponent) } else { (rounded / 10, exponent + 1) }
}

/// The whole e with 10^e <= |value| * 2^-bits < 10^(e+1), for a value that isn't zero.
fn power_of_ten(value: &IBig, bits: usize) -> i64 {
    let size = value.clone().unsigned_abs();
    let binary = size.bit_len() as i64 - 1 - bits as i64;
    // From below: the logarithm of 2 is near enough that this is one or two too small at most.
    let mut exponent = (binary as f64 * std::f64::consts::LOG10_2).floor() as i64 - 1;
    while reaches(&size, bits, exponent + 1) {
        exponent += 1;
    }
    exponent
}

/// Whether size * 2^-bits >= 10^exponent.
fn reaches(size: &UBig, bits: usize, exponent: i64) -> bool {
    let (more, less) = ((-exponent).max(0) as usize, exponent.max(0) as usize);
    size * ten_to(more) >= ten_to(less) << bits
}

/// Significant digits, given as a whole number, whose first one counts 10^exponent.
fn notation(leading: &IBig, exponent: i64, digits: usize) -> String {
    let last = exponent + 1 - digits as i64;
    let above = exponent > 15 || (exponent == 15 && leading.clone().unsigned_abs() > ten_to(digits - 1));
    if exponent < -6 || above {
        format!("{}e{exponent}", with_point(leading, digits - 1))
    } else if last >= 0 {
        with_point(&(leading * ten_to(last as usize)), 0)
    } else {
        with_point(leading, last.unsigned_abs() as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu_base::Abs;
    use proptest::prelude::*;

    type Real = Enclosure<128>;

    const PI: &str =
        "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803482534211706798";

    fn ratio(a: i64, b: i64) -> RBig {
        RBig::from(a) / RBig::from(b)
    }

    fn real(a: i64, b: i64) -> Real {
        Real::rational(&ratio(a, b))
    }

    /// The enclosure of two rational numbers and all between.
    fn wide(a: &RBig, b: &RBig) -> Real {
        Real::rational(a).hull(&Real::rational(b))
    }

    fn narrow<const BITS: usize>(value: &Enclosure<BITS>, lost: usize) -> bool {
        value.width() < in_units(&IBig::ONE, BITS - lost)
    }

    fn any_ratio() -> impl Strategy<Value = RBig> {
        (-1_000_000i64..1_000_000, 1i64..100_000).prop_map(|(a, b)| ratio(a, b))
    }

    proptest! {
        #[test]
        fn operations_hold_what_they_give_for_numbers_inside(
            a in any_ratio(), b in any_ratio(), c in any_ratio(), d in any_ratio(), e in -7i64..8,
        ) {
            let (x, y) = (wide(&a, &b), wide(&c, &d));
            let middle = (&a + &b) / RBig::from(2);
            for (p, q) in [(&a, &c), (&a, &d), (&b, &c), (&b, &d), (&middle, &c)] {
                prop_assert!(x.contains(p) && y.contains(q));
                prop_assert!(x.plus(&y).unwrap().contains(&(p + q)));
                prop_assert!(x.minus(&y).unwrap().contains(&(p - q)));
                prop_assert!(x.times(&y).unwrap().contains(&(p * q)));
                prop_assert!(x.square().unwrap().contains(&(p * p)));
                prop_assert!(x.abs().contains(p) || x.abs().contains(&-p));
                prop_assert!(x.negated().contains(&-p));
                if let Ok(quotient) = x.over(&y) {
                    prop_assert!(quotient.contains(&(p / q)));
                }
                if let Ok(power) = x.power(e) {
                    let size = (0..e.abs()).fold(RBig::ONE, |product, _| product * p);
                    let exact = if e < 0 { RBig::ONE / size } else { size };
                    prop_assert!(power.contains(&exact));
                }
                if let Some(order) = x.compare(&y) {
                    prop_assert_eq!(order, p.cmp(q));
                }
            }
        }

        #[test]
        fn narrow_arguments_give_narrow_results(a in any_ratio(), b in any_ratio()) {
            let (x, y) = (Real::rational(&a), Real::rational(&b));
            prop_assert!(narrow(&x.times(&y).unwrap(), 24));
            if !b.is_zero() {
                prop_assert!(narrow(&x.over(&y).unwrap(), 64));
            }
            let root = x.abs().sqrt().unwrap();
            prop_assert!(root.square().unwrap().overlaps(&x.abs()));
        }

        #[test]
        fn waves_lie_on_the_circle_and_agree_with_floating_point(a in any_ratio(), b in 0i64..3000) {
            let x = wide(&a, &(&a + ratio(b, 1000)));
            let (cos, sin) = (x.cos(), x.sin());
            let sum = cos.square().unwrap().plus(&sin.square().unwrap()).unwrap();
            prop_assert!(sum.contains(&RBig::ONE));
            let inside = (&a + ratio(b, 3000)).to_f64().value();
            let slack = ratio(1, 1 << 30);
            let near = |y: &Real, value: f64| wide(&-&slack, &slack).plus(y).unwrap().contains(&RBig::try_from(value).unwrap());
            prop_assert!(near(&cos, inside.cos()) && near(&sin, inside.sin()));
        }

        #[test]
        fn floating_point_numbers_come_back(value in proptest::num::f64::NORMAL) {
            let there = Enclosure::<2048>::from_f64(value).unwrap();
            prop_assert_eq!(there.midpoint_f64(), value);
            prop_assert!(there.is_point());
        }

        #[test]
        fn decimals_are_within_half_a_unit(a in any_ratio(), digits in 0usize..20) {
            let half_unit = ratio(1, 2) / RBig::from(ten_to(digits));
            let value = |text: &str| RBig::from_str_decimal(text).unwrap();
            prop_assert!((value(&rational_decimal(&a, digits)) - &a).abs() <= half_unit.clone());
            if let Some(text) = Real::rational(&a).decimal(digits) {
                prop_assert!((value(&text) - &a).abs() <= half_unit);
            }
            if let (Some(text), false) = (Real::rational(&a).significant(digits), a.is_zero()) {
                let unit = RBig::ONE / RBig::from(ten_to(digits.max(1) - 1));
                prop_assert!((value(&text) - &a).abs() <= a.clone().abs() * unit);
            }
        }
    }

    #[test]
    fn pi_has_its_digits() {
        assert_eq!(Enclosure::<512>::pi().decimal(101).as_deref(), Some(PI));
        assert_eq!(Enclosure::<2048>::pi().decimal(101).as_deref(), Some(PI));
        assert!(narrow(&Enclosure::<2048>::pi(), 2) && narrow(&Enclosure::<4000>::pi(), 2) && narrow(&Real::pi(), 2));
        assert!(Enclosure::<4000>::pi().lo_hi().0 >= Enclosure::<2048>::pi().lo_hi().0);
    }

    #[test]
    fn waves_have_their_exact_values() {
        let third = Enclosure::<512>::pi().over(&Enclosure::whole(3)).unwrap();
        assert!(third.cos().contains(&ratio(1, 2)) && narrow(&third.cos(), 20));
        let sixth = Real::pi().over(&Real::whole(6)).unwrap();
        assert!(sixth.sin().contains(&ratio(1, 2)) && sixth.negated().sin().contains(&ratio(-1, 2)));
        for k in -9i64..10 {
            let quarters = Real::pi().times(&real(k, 2)).unwrap();
            let cos = [1, 0, -1, 0][k.rem_euclid(4) as usize];
            let sin = [0, 1, 0, -1][k.rem_euclid(4) as usize];
            assert!(quarters.cos().contains(&RBig::from(cos)) && quarters.sin().contains(&RBig::from(sin)), "{k}");
            assert!(narrow(&quarters.cos(), 20));
        }
        assert_eq!(Real::whole(0).cos(), Real::whole(1));
        assert_eq!(wide(&ratio(0, 1), &ratio(7, 1)).sin().lo_hi(), (RBig::from(-1), RBig::ONE));
        let huge = Real::whole(2).power(4000).unwrap().plus(&Real::whole(1)).unwrap();
        assert!(narrow(&huge.cos(), 4));
    }

    #[test]
    fn roots_are_tight_and_start_at_zero() {
        assert_eq!(Real::whole(49).sqrt(), Ok(Real::whole(7)));
        assert_eq!(Real::whole(-1).sqrt(), Err(Trouble::NegativeRoot));
        assert_eq!(wide(&ratio(-1, 1), &ratio(4, 1)).sqrt(), Ok(wide(&ratio(0, 1), &ratio(2, 1))));
        let root = Real::whole(2).sqrt().unwrap();
        assert!(narrow(&root, 2) && root.square().unwrap().contains(&RBig::from(2)));
        let across = wide(&ratio(-3, 1), &ratio(2, 1));
        assert_eq!(across.square(), Ok(wide(&ratio(0, 1), &ratio(9, 1))));
        assert_eq!(across.power(3), Ok(wide(&ratio(-27, 1), &ratio(8, 1))));
    }

    #[test]
    fn what_is_not_certain_is_not_said() {
        let across = wide(&ratio(-1, 1), &ratio(1, 1));
        assert_eq!((across.sign(), Real::whole(0).sign()), (None, Some(Ordering::Equal)));
        assert_eq!((real(-1, 3).sign(), real(1, 3).sign()), (Some(Ordering::Less), Some(Ordering::Greater)));
        assert_eq!((real(1, 3).compare(&real(1, 3)), real(1, 4).compare(&real(1, 4))), (None, Some(Ordering::Equal)));
        assert_eq!(across.over(&across), Err(Trouble::DivisionByZero));
        assert_eq!(Real::whole(0).power(-1), Err(Trouble::DivisionByZero));
        assert_eq!((across.significant(3), across.decimal(3), across.decimal(usize::MAX)), (None, None, None));
        assert_eq!(Real::whole(3).power(i64::MAX), Err(TOO_LARGE));
        assert_eq!(Real::whole(1).power(i64::MIN), Ok(Real::whole(1)));
        assert_eq!(Real::from_f64(f64::NAN), Err(Trouble::NotFinite));
    }

    #[test]
    fn decimals_round_where_decided() {
        assert_eq!(real(1, 8).decimal(2).as_deref(), Some("0.13"));
        assert_eq!(real(-1, 8).decimal(2).as_deref(), Some("-0.13"));
        assert_eq!(real(-1, 300).decimal(2).as_deref(), Some("0.00"));
        assert_eq!(real(5, 2).decimal(0).as_deref(), Some("3"));
        assert_eq!(real(1, 3).decimal(5).as_deref(), Some("0.33333"));
        assert_eq!(real(1, 3).decimal(60), None);
        assert_eq!(rational_decimal(&ratio(1, 8), 2), "0.12");
        assert_eq!(rational_decimal(&ratio(3, 8), 2), "0.38");
        assert_eq!(rational_decimal(&ratio(-1, 8), 2), "-0.12");
        assert_eq!(rational_decimal(&ratio(-1, 800), 2), "0.00");
        assert_eq!(rational_decimal(&ratio(-5, 2), 0), "-2");
        assert_eq!(rational_decimal(&ratio(7, 2), 0), "4");
        assert_eq!(rational_decimal(&ratio(-2, 3), 4), "-0.6667");
    }

    #[test]
    fn significant_digits_are_plain_unless_extreme() {
        let text = |a: i64, b: i64, digits: usize| real(a, b).significant(digits).unwrap();
        assert_eq!(text(123_456, 1, 3), "123000");
        assert_eq!(text(1, 3, 4), "0.3333");
        assert_eq!(text(-2, 3, 4), "-0.6667");
        assert_eq!(text(99_999, 1000, 3), "100");
        assert_eq!(text(99_999, 1000, 4), "100.0");
        assert_eq!(text(1, 1_000_000, 2), "0.0000010");
        assert_eq!(text(1234, 1_000_000_000_000_000, 4), "1.234e-12");
        assert_eq!(text(1_000_000_000_000_000, 1, 3), "1000000000000000");
        assert_eq!(text(1_500_000_000_000_000, 1, 2), "1.5e15");
        assert_eq!(text(7, 100_000_000, 1), "7e-8");
        assert_eq!(text(0, 1, 5), "0");
        assert_eq!(Real::pi().significant(30).as_deref(), Some("3.14159265358979323846264338328"));
    }
}
