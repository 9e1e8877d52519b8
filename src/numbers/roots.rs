//! Where are all complex roots of a polynomial whose real coefficients are known as enclosures?
//!
//! Degrees 1 and 2 are solved by formulas. Beyond, approximations come from the simultaneous iteration of Aberth (1973)
//! in floating point and are refined by that of Weierstrass (1891) in fixed point. Nothing is taken from them on trust:
//! with W = p(z) / (a prod (z - z_j)) over the other approximations z_j, the discs around each z with radius
//! degree * |W| hold all roots, and k discs that are connected and touch no other hold exactly k (Smith 1970, "Error
//! bounds for zeros of a polynomial based upon Gerschgorin's theorems"). The approximations are symmetric about the real
//! axis, as the roots are; so a disc that touches its own mirror image and no other disc holds a real root.

use crate::numbers::enclosure::{Enclosure, nearest_f64};
use crate::numbers::{Field, Trouble};
use dashu_base::{Abs, BitTest, DivEuclid, SquareRootRem, UnsignedAbs};
use dashu_int::{IBig, UBig};
use std::cmp::{Ordering, Reverse};

/// Polynomials of a higher degree are declined.
const MAX_DEGREE: usize = 128;
/// Rounds of the iteration in floating point.
const ROUNDS: usize = 120;
/// A quadratic is multiplied by 2^LIFT, so that the rounding of its discriminant doesn't count.
const LIFT: usize = 128;
/// Leading bits kept of a product of distances.
const DISTANCE_BITS: usize = 64;

/// A box that holds exactly `count` roots (with multiplicity).
#[derive(Clone, Debug, PartialEq)]
pub struct Root<const BITS: usize> {
    /// The real part.
    pub re: Enclosure<BITS>,
    /// The imaginary part: `[0, 0]` where the root is known to be real.
    pub im: Enclosure<BITS>,
    /// How many roots the box holds.
    pub count: usize,
}

impl<const BITS: usize> Root<BITS> {
    /// The square of the modulus.
    ///
    /// # Errors
    /// When the value is beyond the limit of size.
    pub fn modulus_squared(&self) -> Result<Enclosure<BITS>, Trouble> {
        self.re.square()?.plus(&self.im.square()?)
    }

    /// Whether all roots of the box are known to be real.
    pub fn is_real(&self) -> bool {
        self.im.is_certainly_zero()
    }

    fn real(re: Enclosure<BITS>, count: usize) -> Self {
        Root { re, im: Enclosure::whole(0), count }
    }

    fn mirrored(&self) -> Self {
        Root { re: self.re.clone(), im: self.im.negated(), count: self.count }
    }

    fn overlaps(&self, other: &Self) -> bool {
        self.re.overlaps(&other.re) && self.im.overlaps(&other.im)
    }

    fn united(&self, other: &Self) -> Self {
        Root { re: self.re.hull(&other.re), im: self.im.hull(&other.im), count: self.count + other.count }
    }

    /// Modulus squared, real and imaginary part of the middle, times powers of two that all boxes share.
    fn middle(&self) -> (IBig, IBig, IBig) {
        let twice = |value: &Enclosure<BITS>| value.ends().0 + value.ends().1;
        let (re, im) = (twice(&self.re), twice(&self.im));
        (&re * &re + &im * &im, re, im)
    }
}

/// All roots of a polynomial, given by its coefficients from low to high, in boxes that are disjoint. Boxes come in order
/// of their middles: descending modulus, then real part, then imaginary part. A box apart from the real axis has its exact
/// mirror image among the others.
///
/// # Errors
/// When the leading coefficient holds zero (there may be none), or a number or the degree is beyond a limit of size.
pub fn roots<const BITS: usize>(polynomial: &[Enclosure<BITS>]) -> Result<Vec<Root<BITS>>, Trouble> {
    let (lowest, rest) = without_zeros(polynomial)?;
    if rest.len() > MAX_DEGREE + 1 {
        return Err(Trouble::BeyondThisWorld("the degree is too high to look for roots"));
    }
    let mut found = match rest {
        [] | [_] => Vec::new(),
        [a, b] => vec![Root::real(a.over(b)?.negated(), 1)],
        [c, b, a] => match quadratic(c, b, a) {
            Ok(Some(found)) => found,
            _ => general(rest),
        },
        _ => general(rest),
    };
    if lowest > 0 {
        found.push(Root::real(Enclosure::whole(0), lowest));
    }
    let mut apart = separated(found);
    apart.sort_by_cached_key(|root| Reverse(root.middle()));
    apart.into_iter().map(checked).collect()
}

/// How often x divides the polynomial as it stands, and the quotient.
fn without_zeros<const BITS: usize>(polynomial: &[Enclosure<BITS>]) -> Result<(usize, &[Enclosure<BITS>]), Trouble> {
    let leading = polynomial.last().ok_or(Trouble::DivisionByZero)?;
    if !matches!(leading.sign(), Some(Ordering::Less | Ordering::Greater)) {
        return Err(Trouble::DivisionByZero);
    }
    let lowest = polynomial.iter().take_while(|coefficient| coefficient.is_certainly_zero()).count();
    Ok((lowest, polynomial.get(lowest..).unwrap_or_default()))
}

fn checked<const BITS: usize>(root: Root<BITS>) -> Result<Root<BITS>, Trouble> {
    Ok(Root { re: root.re.checked()?, im: root.im.checked()?, count: root.count })
}

/// Unites boxes until they are disjoint. A single root whose box meets the axis is real then: its conjugate lies in the
/// mirror image of the box, which is one of the boxes and meets this one.
fn separated<const BITS: usize>(boxes: Vec<Root<BITS>>) -> Vec<Root<BITS>> {
    let mut apart: Vec<Root<BITS>> = Vec::new();
    for mut next in boxes {
        while let Some(at) = apart.iter().position(|other| other.overlaps(&next)) {
            next = next.united(&apart.swap_remove(at));
        }
        apart.push(next);
    }
    let axis = Enclosure::whole(0);
    for root in apart.iter_mut().filter(|root| root.count == 1 && root.im.overlaps(&axis)) {
        root.im = axis.clone();
    }
    apart
}

/// The roots of `a x^2 + b x + c`, where the sign of the discriminant is certain.
fn quadratic<const BITS: usize>(
    c: &Enclosure<BITS>,
    b: &Enclosure<BITS>,
    a: &Enclosure<BITS>,
) -> Result<Option<Vec<Root<BITS>>>, Trouble> {
    let (a, b, c) = (lifted(a), lifted(b), lifted(c));
    let twice_a = a.plus(&a)?;
    let discriminant = b.square()?.minus(&twice_a.times(&c.plus(&c)?)?)?;
    let middle = || b.negated().over(&twice_a);
    Ok(match discriminant.sign() {
        None => None,
        Some(Ordering::Equal) => Some(vec![Root::real(middle()?, 2)]),
        Some(Ordering::Less) => {
            let im = discriminant.negated().sqrt()?.over(&twice_a.abs())?;
            let upper = Root { re: middle()?, im, count: 1 };
            Some(vec![upper.mirrored(), upper])
        }
        Some(Ordering::Greater) => {
            let root = discriminant.sqrt()?;
            let plain = |root: &Enclosure<BITS>| root.minus(&b)?.over(&twice_a);
            // The other root from the product of both, c/a; it is the better one where b cancels.
            let other = |root: &Enclosure<BITS>| c.plus(&c)?.negated().over(&b.plus(root)?);
            let better = |root: &Enclosure<BITS>| plain(root).map(|one| narrower(one, other(root).ok()));
            Some(vec![Root::real(better(&root)?, 1), Root::real(better(&root.negated())?, 1)])
        }
    })
}

fn lifted<const BITS: usize>(value: &Enclosure<BITS>) -> Enclosure<BITS> {
    let (lo, hi) = value.ends();
    Enclosure::between(lo << LIFT, hi << LIFT)
}

fn narrower<const BITS: usize>(one: Enclosure<BITS>, other: Option<Enclosure<BITS>>) -> Enclosure<BITS> {
    let width = |value: &Enclosure<BITS>| value.ends().1 - value.ends().0;
    other.filter(|other| width(other) < width(&one)).unwrap_or(one)
}

/// The roots of any polynomial, in boxes that may overlap, with a symmetric set of boxes. The leading coefficient has a
/// certain sign and the lowest one isn't certainly zero.
fn general<const BITS: usize>(polynomial: &[Enclosure<BITS>]) -> Vec<Root<BITS>> {
    let monic = Monic::of(polynomial);
    let (points, rest) = (monic.refined(monic.approximations()), monic.bound());
    let halves = symmetric(points, monic.bits);
    let all: Vec<Point> = halves.iter().flat_map(Half::points).collect();
    let boxes: Option<Vec<_>> = halves.iter().map(|half| monic.boxes(half, &all)).collect();
    let whole = Root { re: rest.clone(), im: rest.clone(), count: polynomial.len().saturating_sub(1) };
    let clip = |root: Root<BITS>| Root { re: within(&root.re, &rest), im: within(&root.im, &rest), ..root };
    boxes.map_or_else(|| vec![whole], |boxes| separated(boxes.concat()).into_iter().map(clip).collect())
}

/// The part of an enclosure that lies in another; the two have a point in common.
fn within<const BITS: usize>(value: &Enclosure<BITS>, bound: &Enclosure<BITS>) -> Enclosure<BITS> {
    let ((lo, hi), (least, most)) = (value.ends(), bound.ends());
    Enclosure::between(lo.clamp(least, most).clone(), hi.clamp(least, most).clone())
}

/// A complex number in fixed point, not rounded with any care.
#[derive(Clone, PartialEq, Eq)]
struct Point {
    re: IBig,
    im: IBig,
}

impl Point {
    fn conjugate(&self) -> Self {
        Point { re: self.re.clone(), im: -&self.im }
    }

    fn minus(&self, other: &Self) -> Self {
        Point { re: &self.re - &other.re, im: &self.im - &other.im }
    }

    fn times(&self, other: &Self) -> Self {
        let re = &self.re * &other.re - &self.im * &other.im;
        Point { re, im: &self.re * &other.im + &self.im * &other.re }
    }

    fn shifted_down(self, bits: usize) -> Self {
        Point { re: self.re >> bits, im: self.im >> bits }
    }

    fn modulus_squared(&self) -> UBig {
        (&self.re * &self.re + &self.im * &self.im).unsigned_abs()
    }

    fn bit_len(&self) -> usize {
        self.re.bit_len().max(self.im.bit_len())
    }

    fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }
}

/// One real approximation, or two that are conjugates, by the one above the axis.
struct Half {
    point: Point,
    paired: bool,
}

impl Half {
    fn points(&self) -> impl Iterator<Item = Point> {
        std::iter::once(self.point.clone()).chain(self.paired.then(|| self.point.conjugate()))
    }
}

/// A polynomial in y, where x = 2^shift * y, divided by its leading coefficient: its roots have moduli up to 2, and most
/// coefficients sizes up to about 1. Each lower coefficient is a middle and a radius in units of 2^-bits.
struct Monic<const BITS: usize> {
    coefficients: Vec<(IBig, IBig)>,
    bits: usize,
    shift: i64,
}

impl<const BITS: usize> Monic<BITS> {
    fn of(polynomial: &[Enclosure<BITS>]) -> Self {
        let degree = polynomial.len().saturating_sub(1);
        let shift = shift(polynomial);
        let bits = BITS + 64 + 4 * degree + shift.max(0) as usize;
        let scale = |power: usize| bits as i64 - shift * (degree - power) as i64;
        let coefficients = match polynomial.split_last() {
            Some((leading, lower)) => {
                lower.iter().enumerate().map(|(power, value)| quotient(value, leading, scale(power))).collect()
            }
            None => Vec::new(),
        };
        Monic { coefficients, bits, shift }
    }

    fn degree(&self) -> usize {
        self.coefficients.len()
    }

    /// No root is larger in modulus: with |a_(n-k) / a_n| <= M^k for all k, they are at most 2 M (Fujiwara 1916).
    fn bound(&self) -> Enclosure<BITS> {
        let end = -scaled_down(&IBig::NEG_ONE, -(BITS as i64 + self.shift + 1));
        Enclosure::between(-&end, end)
    }

    /// The polynomial's value and how far it is off at most, as a distance.
    fn value(&self, at: &Point) -> (Point, IBig) {
        let size = IBig::from(root_up(&at.modulus_squared()));
        let mut value = Point { re: IBig::ONE << self.bits, im: IBig::ZERO };
        let mut error = IBig::ZERO;
        for (middle, radius) in self.coefficients.iter().rev() {
            value = value.times(at).shifted_down(self.bits);
            value.re += middle;
            // Two parts are rounded by less than 1 each, and the bound itself by less than 1.
            error = ((error * &size) >> self.bits) + radius + IBig::from(3);
        }
        (value, error)
    }

    /// Starting points from floating point.
    fn approximations(&self) -> Vec<Point> {
        let coefficients: Vec<f64> =
            self.coefficients.iter().map(|(middle, _)| nearest_f64(middle, self.bits)).collect();
        let fixed = |part: f64| (IBig::from((part.clamp(-2.0, 2.0) * 2f64.powi(60)) as i64) << self.bits) >> 60;
        aberth(&coefficients).into_iter().map(|(re, im)| Point { re: fixed(re), im: fixed(im) }).collect()
    }

    /// Weierstrass's iteration, each point until the polynomial can't be told from zero there. Multiple roots are
    /// approached by a constant factor only, so the rounds are as many as there are bits.
    fn refined(&self, mut points: Vec<Point>) -> Vec<Point> {
        let mut open: Vec<usize> = (0..points.len()).collect();
        for _ in 0..self.bits + 100 {
            open.retain(|&index| self.improve(&mut points, index));
            if open.is_empty() {
                break;
            }
        }
        points
    }

    /// One step for one point; false when there is nothing to gain.
    fn improve(&self, points: &mut [Point], index: usize) -> bool {
        let Some(point) = points.get(index).cloned() else { return false };
        let (value, error) = self.value(&point);
        if IBig::from(value.modulus_squared()) <= &error * &error {
            return false;
        }
        let others = points.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, other)| other);
        let step = self.correction(&point, &value, others);
        let limit = IBig::ONE << (self.bits + 1);
        let clamp = |part: IBig| part.clamp(-&limit, limit.clone());
        let next = point.minus(&step);
        if let Some(place) = points.get_mut(index) {
            *place = Point { re: clamp(next.re), im: clamp(next.im) };
        }
        !step.is_zero()
    }

    /// value / prod (point - other). The product is kept with its own exponent, since it may be tiny.
    fn correction<'a>(&self, point: &Point, value: &Point, others: impl Iterator<Item = &'a Point>) -> Point {
        let mut product = Point { re: IBig::ONE << self.bits, im: IBig::ZERO };
        let mut exponent = -(self.bits as i64);
        for other in others {
            let difference = point.minus(other);
            if difference.is_zero() {
                return Point { re: IBig::ONE << (self.bits / 2), im: IBig::ONE << (self.bits / 3) };
            }
            product = product.times(&difference);
            let drop = product.bit_len().saturating_sub(self.bits);
            product = product.shifted_down(drop);
            exponent += drop as i64 - self.bits as i64;
        }
        let size = IBig::from(product.modulus_squared());
        let quotient = value.times(&product.conjugate());
        let divided = |part: &IBig| if size.is_zero() { IBig::ZERO } else { divided(part, &size, -exponent).0 };
        Point { re: divided(&quotient.re), im: divided(&quotient.im) }
    }

    /// Smith's discs around a point and its conjugate, as boxes; nothing where two points coincide.
    fn boxes(&self, half: &Half, all: &[Point]) -> Option<Vec<Root<BITS>>> {
        let radius = self.radius(&half.point, all)?;
        let part = |middle: &IBig| self.outward(&(middle - &radius), &(middle + &radius));
        let root = Root { re: part(&half.point.re), im: part(&half.point.im), count: 1 };
        if half.paired {
            return Some(vec![root.mirrored(), root]);
        }
        let reach = self.outward(&-&radius, &radius);
        Some(vec![Root { im: reach, ..root }])
    }

    /// degree * |p(point)| / prod |point - other|, rounded up, over the other points among all.
    fn radius(&self, point: &Point, all: &[Point]) -> Option<IBig> {
        let (value, error) = self.value(point);
        let size = (IBig::from(root_up(&value.modulus_squared())) + error) * self.degree();
        let (mut product, mut exponent) = (UBig::ONE, 0i64);
        for other in all.iter().filter(|other| *other != point) {
            product *= point.minus(other).modulus_squared();
            let drop = product.bit_len().saturating_sub(DISTANCE_BITS);
            product >>= drop;
            exponent += drop as i64 - 2 * self.bits as i64;
        }
        // Points that coincide with this one were passed over.
        let distinct = all.iter().filter(|other| *other == point).count() == 1 && !product.is_zero();
        let square = distinct.then(|| divided(&(&size * &size), &IBig::from(product), -exponent).1)?;
        Some(root_up(&square.unsigned_abs()).into())
    }

    /// An enclosure of the x that belong to y between two ends.
    fn outward(&self, lo: &IBig, hi: &IBig) -> Enclosure<BITS> {
        let drop = self.bits as i64 - BITS as i64 - self.shift;
        Enclosure::between(scaled_down(lo, drop), -scaled_down(&-hi, drop))
    }
}

/// The least s with |a_(n-k) / a_n| <= 2^(s k) for all k that bit lengths show.
fn shift<const BITS: usize>(polynomial: &[Enclosure<BITS>]) -> i64 {
    let sizes = |value: &Enclosure<BITS>| {
        let (lo, hi) = value.ends();
        (lo.clone().unsigned_abs().bit_len() as i64, hi.clone().unsigned_abs().bit_len() as i64)
    };
    let leading = polynomial.last().map(&sizes).map_or(0, |(lo, hi)| lo.min(hi));
    let lower = polynomial.iter().rev().zip(0i64..).skip(1).map(|(value, k)| (sizes(value), k));
    let steps = lower.filter(|((lo, hi), _)| lo.max(hi) > &0);
    steps.map(|((lo, hi), k)| (lo.max(hi) - leading + k).div_euclid(k)).max().unwrap_or(0)
}

/// value / divisor in units of 2^-scale, as a middle and a radius.
fn quotient<const BITS: usize>(value: &Enclosure<BITS>, divisor: &Enclosure<BITS>, scale: i64) -> (IBig, IBig) {
    if divisor.ends().1 < &IBig::ZERO {
        return quotient(&value.negated(), &divisor.negated(), scale);
    }
    let ((lo, hi), (least, most)) = (value.ends(), divisor.ends());
    let lo = divided(lo, if lo < &IBig::ZERO { least } else { most }, scale).0;
    let hi = divided(hi, if hi < &IBig::ZERO { most } else { least }, scale).1;
    let middle: IBig = (&lo + &hi) >> 1;
    let radius = hi - &middle;
    (middle, radius)
}

/// value * 2^scale / divisor for a positive divisor, rounded down and up.
fn divided(value: &IBig, divisor: &IBig, scale: i64) -> (IBig, IBig) {
    let (more, less) = (scale.max(0) as usize, scale.min(0).unsigned_abs() as usize);
    let (value, divisor) = (value << more, divisor << less);
    let down = (&value).div_euclid(&divisor);
    let exact = &down * &divisor == value;
    let up = if exact { down.clone() } else { &down + IBig::ONE };
    (down, up)
}

/// value / 2^drop, rounded down.
fn scaled_down(value: &IBig, drop: i64) -> IBig {
    if drop >= 0 { value >> drop as usize } else { value << drop.unsigned_abs() as usize }
}

fn root_up(value: &UBig) -> UBig {
    let (root, rest) = value.sqrt_rem();
    if rest.is_zero() { root } else { root + UBig::ONE }
}

/// Approximations made symmetric about the real axis, and distinct. From the one farthest off the axis on, each is joined
/// with the one nearest to its mirror image, which may be itself: then it becomes real.
fn symmetric(mut points: Vec<Point>, bits: usize) -> Vec<Half> {
    points.sort_by_cached_key(|point| point.im.clone().unsigned_abs());
    let mut halves: Vec<Half> = Vec::new();
    while let Some(point) = points.pop() {
        let mirror = point.conjugate();
        let distance = |other: &Point| (&other.re - &mirror.re).abs() + (&other.im - &mirror.im).abs();
        let nearest = points.iter().enumerate().map(|(at, other)| (distance(other), at)).min();
        let mut half = match nearest.filter(|(nearest, _)| *nearest < distance(&point)) {
            Some((_, at)) => joined(&point, &points.remove(at)),
            None => Half { point: Point { re: point.re, im: IBig::ZERO }, paired: false },
        };
        while halves.iter().any(|other| other.point == half.point) {
            half.point.re += IBig::ONE << (bits / 2);
        }
        halves.push(half);
    }
    halves
}

/// The conjugates nearest to two points on different sides of the axis.
fn joined(one: &Point, other: &Point) -> Half {
    let im = ((&one.im - &other.im) >> 1).abs().max(IBig::ONE);
    Half { point: Point { re: (&one.re + &other.re) >> 1, im }, paired: true }
}

/// A complex number in floating point: real and imaginary part.
type Complex = (f64, f64);

fn product(a: Complex, b: Complex) -> Complex {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

fn inverse(a: Complex) -> Complex {
    let size = a.0.hypot(a.1);
    (a.0 / size / size, -a.1 / size / size)
}

/// Approximate roots of a polynomial with leading coefficient 1, given the lower ones from low to high.
fn aberth(coefficients: &[f64]) -> Vec<Complex> {
    let degree = coefficients.len();
    let mut points = circle(coefficients);
    for _ in 0..ROUNDS {
        let mut largest = 0f64;
        for index in 0..degree {
            let Some(&point) = points.get(index) else { continue };
            let step = aberth_step(coefficients, &points, point);
            let Some(place) = points.get_mut(index).filter(|_| step.0.is_finite() && step.1.is_finite()) else {
                continue;
            };
            *place = (point.0 - step.0, point.1 - step.1);
            largest = largest.max(step.0.hypot(step.1) / (1e-300 + point.0.hypot(point.1)));
        }
        if largest < 1e-15 {
            break;
        }
    }
    points
}

/// Points around a circle whose radius is the geometric mean of the roots' moduli, not symmetric about the axis.
fn circle(coefficients: &[f64]) -> Vec<Complex> {
    let degree = coefficients.len();
    let mean = coefficients.first().map_or(1.0, |lowest| lowest.abs().powf(1.0 / degree as f64));
    let radius = mean.clamp(1e-6, 2.0);
    let angle = |index: usize| (index as f64 + 0.3) * std::f64::consts::TAU / degree as f64;
    (0..degree).map(|index| (radius * angle(index).cos(), radius * angle(index).sin())).collect()
}

/// 1 / (p'/p - sum 1/(point - other))
fn aberth_step(coefficients: &[f64], points: &[Complex], point: Complex) -> Complex {
    let (mut value, mut slope) = ((1.0, 0.0), (0.0, 0.0));
    for coefficient in coefficients.iter().rev() {
        slope = product(slope, point);
        slope = (slope.0 + value.0, slope.1 + value.1);
        value = product(value, point);
        value.0 += coefficient;
    }
    if value == (0.0, 0.0) {
        return value;
    }
    let mut sum = product(slope, inverse(value));
    for other in points.iter().filter(|other| **other != point) {
        let term = inverse((point.0 - other.0, point.1 - other.1));
        sum = (sum.0 - term.0, sum.1 - term.1);
    }
    inverse(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu_ratio::RBig;
    use proptest::prelude::*;
    use std::time::Instant;

    fn ratio(a: i64, b: i64) -> RBig {
        RBig::from(a) / RBig::from(b)
    }

    fn power_of_two(exponent: usize) -> RBig {
        RBig::from(UBig::ONE << exponent)
    }

    fn multiplied(a: &[RBig], b: &[RBig]) -> Vec<RBig> {
        let mut sum = vec![RBig::ZERO; a.len() + b.len() - 1];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                sum[i + j] += x * y;
            }
        }
        sum
    }

    /// The polynomial with these factors.
    fn of_factors(factors: &[Vec<RBig>]) -> Vec<RBig> {
        factors.iter().fold(vec![RBig::ONE], |product, factor| multiplied(&product, factor))
    }

    fn of_roots(roots: &[RBig]) -> Vec<RBig> {
        of_factors(&roots.iter().map(|root| vec![-root, RBig::ONE]).collect::<Vec<_>>())
    }

    fn solved<const BITS: usize>(polynomial: &[RBig]) -> Vec<Root<BITS>> {
        let found = roots(&polynomial.iter().map(Enclosure::rational).collect::<Vec<_>>()).unwrap();
        assert_eq!(found.iter().map(|root| root.count).sum::<usize>(), polynomial.len() - 1);
        for (i, root) in found.iter().enumerate() {
            assert!(found[..i].iter().all(|other| !other.overlaps(root)));
            assert!(found.contains(&root.mirrored()));
        }
        found
    }

    fn whole<const BITS: usize>(polynomial: &[i64]) -> Vec<Root<BITS>> {
        solved(&polynomial.iter().map(|&c| RBig::from(c)).collect::<Vec<_>>())
    }

    fn has<const BITS: usize>(found: &Root<BITS>, re: &RBig, im: &RBig) -> bool {
        found.re.contains(re) && found.im.contains(im)
    }

    fn narrow<const BITS: usize>(root: &Root<BITS>, lost: usize) -> bool {
        let limit = RBig::ONE / power_of_two(BITS - lost);
        root.re.width() < limit && root.im.width() < limit
    }

    /// Each box holds as many of the known roots as it says.
    fn holds<const BITS: usize>(found: &[Root<BITS>], known: &[(RBig, RBig)]) -> bool {
        found.iter().all(|root| known.iter().filter(|(re, im)| has(root, re, im)).count() == root.count)
    }

    fn real(values: &[RBig]) -> Vec<(RBig, RBig)> {
        values.iter().map(|value| (value.clone(), RBig::ZERO)).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]
        #[test]
        fn boxes_hold_the_roots_of_known_factors(
            reals in prop::collection::vec((-60i64..60, 1i64..30), 0..5),
            pairs in prop::collection::vec((-60i64..60, 1i64..60, 1i64..30), 0..4),
            leading in 1i64..40,
        ) {
            let mut known: Vec<_> = reals.iter().map(|&(a, b)| (ratio(a, b), RBig::ZERO)).collect();
            let mut factors = vec![vec![ratio(-leading, 7)]];
            factors.extend(known.iter().map(|(re, _)| vec![-re, RBig::ONE]));
            for &(a, b, c) in &pairs {
                let (re, im) = (ratio(a, c), ratio(b, c));
                factors.push(vec![&re * &re + &im * &im, RBig::from(-2) * &re, RBig::ONE]);
                known.push((re.clone(), -&im));
                known.push((re, im));
            }
            let found = solved::<256>(&of_factors(&factors));
            prop_assert!(holds(&found, &known));
        }

        #[test]
        fn enclosed_coefficients_hold_every_choice(
            values in prop::collection::vec((-40i64..40, 0i64..3), 3..8), at in 0i64..4,
        ) {
            let enclosed: Vec<_> = values.iter().map(|&(a, w)| {
                Enclosure::<128>::rational(&ratio(a, 4)).hull(&Enclosure::rational(&(ratio(a, 4) + ratio(w, 3000))))
            }).collect();
            let chosen: Vec<_> = values.iter().map(|&(a, w)| ratio(a, 4) + ratio(w * at, 9000)).collect();
            if let Ok(wide) = roots(&enclosed) {
                let mut left: Vec<usize> = wide.iter().map(|root| root.count).collect();
                for root in solved::<128>(&chosen) {
                    let index = wide.iter().position(|other| other.overlaps(&root)).unwrap();
                    prop_assert!(left[index] >= root.count);
                    left[index] -= root.count;
                }
            }
        }
    }

    #[test]
    fn what_has_no_roots_or_no_degree_says_so() {
        type Real = Enclosure<128>;
        assert_eq!(roots::<128>(&[]), Err(Trouble::DivisionByZero));
        assert_eq!(roots(&[Real::whole(1), Real::whole(0)]), Err(Trouble::DivisionByZero));
        assert_eq!(roots(&[Real::whole(1), Real::whole(-1).hull(&Real::whole(1))]), Err(Trouble::DivisionByZero));
        assert_eq!(roots(&[Real::whole(5)]), Ok(vec![]));
        assert!(roots(&vec![Real::whole(1); MAX_DEGREE + 2]).is_err());
    }

    #[test]
    fn quadratics_are_tight() {
        let found = whole::<128>(&[1, 0, 1]);
        assert!(
            found.len() == 2
                && has(&found[0], &ratio(0, 1), &ratio(1, 1))
                && has(&found[1], &ratio(0, 1), &ratio(-1, 1))
        );
        assert!(found.iter().all(|root| narrow(root, 3)));
        let steep = solved::<128>(&of_roots(&[ratio(1_000_000, 1), ratio(1, 1_000_000)]));
        assert!(steep.iter().all(|root| root.is_real() && narrow(root, 24)));
        let double = whole::<128>(&[1, -2, 1]);
        assert!(double.len() == 1 && double[0].is_real() && double[0].count == 2);
        let tiny = solved::<128>(&of_roots(&[ratio(1, 1 << 40), ratio(3, 1 << 40)]));
        assert!(tiny.len() == 2 && tiny.iter().all(|root| narrow(root, 3)), "{tiny:?}");
        let ninth = solved::<128>(&of_roots(&[ratio(1, 9), ratio(1, 9)]));
        assert!(ninth.len() == 1 && ninth[0].count == 2 && narrow(&ninth[0], 70), "{ninth:?}");
    }

    #[test]
    fn multiple_roots_share_a_box() {
        let found = whole::<128>(&[-1, 3, -3, 1]);
        assert!(found.len() == 1 && found[0].count == 3 && has(&found[0], &RBig::ONE, &RBig::ZERO));
        assert!(narrow(&found[0], 80), "{found:?}");
        let zeros = whole::<128>(&[0, 0, 2, -3, 1]);
        assert_eq!(zeros.iter().map(|root| root.count).collect::<Vec<_>>(), [1, 1, 2]);
        assert!(zeros[2].is_real() && zeros[2].re.is_certainly_zero());
        let values = [ratio(1, 2), ratio(1, 2), ratio(1, 4), ratio(1, 4), ratio(1, 4), ratio(1, 8), ratio(1, 1)];
        let found = solved::<512>(&of_roots(&values));
        assert_eq!(found.iter().map(|root| root.count).collect::<Vec<_>>(), [1, 2, 3, 1]);
        assert!(holds(&found, &real(&values)));
    }

    #[test]
    fn isolated_roots_are_narrow() {
        let values: Vec<_> = (1..=10).map(|i| ratio(i, 1)).collect();
        let found = solved::<128>(&of_roots(&values));
        assert!(found.len() == 10 && holds(&found, &real(&values)));
        assert!(found.iter().all(|root| root.is_real() && narrow(root, 40)));
        let cubic = whole::<256>(&[-2, 0, 0, 1]);
        assert!(cubic.len() == 3 && cubic.iter().filter(|root| root.is_real()).count() == 1);
        assert!(cubic.iter().all(|root| narrow(root, 40)));
        for root in &cubic {
            let cubed = root.modulus_squared().unwrap().power(3).unwrap();
            assert!(cubed.contains(&RBig::from(4)));
        }
        let close = [ratio(1, 1), ratio(1, 1) + RBig::ONE / power_of_two(40), ratio(-1, 3)];
        let found = solved::<256>(&of_roots(&close));
        assert!(found.len() == 3 && found.iter().all(|root| root.is_real()) && holds(&found, &real(&close)));
    }

    #[test]
    fn high_degrees_work() {
        let unity: Vec<i64> = std::iter::once(-1).chain([0; 39]).chain([1]).collect();
        let found = whole::<128>(&unity);
        assert!(found.len() == 40 && found.iter().filter(|root| root.is_real()).count() == 2);
        assert!(found.iter().all(|root| narrow(root, 40)));
        let geometric: Vec<_> = (0..20).map(|k| ratio(1, 1 << k)).collect();
        let found = solved::<512>(&of_roots(&geometric));
        assert!(found.len() == 20 && holds(&found, &real(&geometric)));
        let wilkinson: Vec<_> = (1..=40).map(|k| ratio(k, 1)).collect();
        let found = solved::<512>(&of_roots(&wilkinson));
        assert!(found.len() == 40 && holds(&found, &real(&wilkinson)));
    }

    #[test]
    fn extreme_coefficients_are_survived() {
        type Real = Enclosure<128>;
        let huge = Real::whole(2).power(4000).unwrap();
        let tiny = Real::between(IBig::ONE, IBig::ONE);
        let speck = Real::between(IBig::NEG_ONE, IBig::ONE);
        let choices = [huge.negated(), tiny.clone(), speck, Real::whole(3), Real::whole(0)];
        for code in 0..625usize {
            let lower = (0..4u32).map(|place| choices[code / 5usize.pow(place) % 5].clone());
            for leading in [&huge, &tiny, &Real::whole(-1)] {
                let polynomial: Vec<_> = lower.clone().chain([leading.clone()]).collect();
                match roots(&polynomial) {
                    Ok(found) => assert_eq!(found.iter().map(|root| root.count).sum::<usize>(), 4),
                    Err(trouble) => assert!(matches!(trouble, Trouble::BeyondThisWorld(_))),
                }
            }
        }
    }

    /// Run with `--release -- --ignored --nocapture`.
    #[test]
    #[ignore = "prints how long roots take"]
    #[allow(clippy::print_stdout)]
    fn timing() {
        fn time<const BITS: usize>(name: &str, values: &[RBig]) {
            let polynomial: Vec<_> = of_roots(values).iter().map(Enclosure::<BITS>::rational).collect();
            let (start, rounds) = (Instant::now(), 5);
            for _ in 0..rounds {
                assert!(roots(&polynomial).is_ok());
            }
            println!("{name} at {BITS} bits: {:?}", start.elapsed() / rounds);
        }
        let values: Vec<_> = (1..=40).map(|k| ratio(k, 41)).collect();
        let doubles = [ratio(1, 3), ratio(1, 3), ratio(1, 7), ratio(1, 7)];
        for (name, values) in [("quadratic", &values[..2]), ("quartic", &values[5..9]), ("double pairs", &doubles)] {
            time::<128>(name, values);
            time::<512>(name, values);
        }
        time::<2048>("quartic", &values[5..9]);
        time::<128>("degree 12", &values[..12]);
        time::<512>("degree 12", &values[..12]);
        time::<512>("degree 40", &values);
        time::<128>("degree 40", &values);
        time::<512>("20 fold root", &vec![ratio(1, 3); 20]);
    }
}
