//! For which masks between two is the limit C^m?
//!
//! Along (1 - t) a + t b the transition matrices are affine in t, so that in the norm of one polytope they are at most q on a whole interval
//! of t when they are so at both ends: below a^(-m), the limit is C^m there. If det(r - P) or det(r + P), polynomials in t, are not positive for a
//! product P of L matrices and r = a^(-m L), P has a real eigenvalue of modulus r or more, and the limit is not C^m (Dyn and Levin 2002), here
//! for schemes that keep their points, whose shifts are stable. Intervals are halved until one of both is seen.

use super::polytope::{vertices_for, with_images};
use super::products::{leaders, product_of};
use super::symbol::differences;
use super::transition::{floats, transitions};
use super::witness::Polytope;
use crate::numbers::linear::{Matrix, shifted};
use crate::numbers::{Trouble, Univariate};
use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// Products of up to so many matrices are tried to refute.
const LONGEST: usize = 4;
/// The most vertices of a polytope.
const MOST_VERTICES: usize = 120;
/// The most intervals.
const MOST_INTERVALS: usize = 4000;

/// What is known on an interval.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// All limits are C^m: at both ends the same vertices show a bound of the radius below a^(-m).
    Proved {
        /// The bound.
        bound: RBig,
        /// What shows it, at either end.
        ends: Box<[Polytope; 2]>,
    },
    /// No scheme there has limits that are C^m: this product grows too fast.
    Refuted(Vec<usize>),
    /// Neither was seen.
    Undecided,
}

/// An interval of t with what is known there, ends included.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Where it begins.
    pub from: RBig,
    /// Where it ends.
    pub to: RBig,
    /// What is known.
    pub finding: Finding,
}

/// Masks (1 - t) a + t b, with the kernels that are left of both when as many factors as both have are taken out.
struct Family {
    kernels: [Mask; 2],
    interpolating: bool,
    /// a^(-m)
    target: RBig,
    /// Products that may refute, each with det(r - P) and det(r + P).
    tests: Vec<(Vec<usize>, [Univariate<RBig>; 2])>,
}

/// The finest pieces from t = 0 to t = 1; undecided ones are not wider than `width`, unless there are too many.
///
/// # Errors
/// In words: when submasks don't sum to 1, or the masks are of different kinds or too large.
pub fn continuity_between(a: &Mask, b: &Mask, m: usize, width: &RBig) -> Result<Vec<Piece>, String> {
    if a.arity != b.arity || [a, b].iter().any(|mask| mask.coset_sums().iter().any(|sum| *sum != RBig::ONE)) {
        return Err("both masks must have one arity, and submasks that sum to 1".to_string());
    }
    let family = Family::new(a, b, m).map_err(|trouble| trouble.to_string())?;
    let (mut open, mut pieces) = (vec![(RBig::ZERO, RBig::ONE)], Vec::new());
    while let Some((from, to)) = open.pop() {
        let finding = family.on(&from, &to);
        let last = &to - &from <= *width || pieces.len() + open.len() > MOST_INTERVALS;
        if finding == Finding::Undecided && !last {
            let middle = (&from + &to) / RBig::from(2);
            open.push((middle.clone(), to));
            open.push((from, middle));
        } else {
            pieces.push(Piece { from, to, finding });
        }
    }
    Ok(pieces)
}

/// The mask (1 - t) a + t b over the support of both; zeros at its ends stay.
fn between(a: &Mask, b: &Mask, t: &RBig) -> Mask {
    let ends = [a.support(), b.support()];
    let first = ends.iter().flatten().map(|(first, _)| *first).min().unwrap_or(0);
    let last = ends.iter().flatten().map(|(_, last)| *last).max().unwrap_or(0);
    let weight = |i: i64| a.get(i) * (RBig::ONE - t) + b.get(i) * t;
    Mask { first, arity: a.arity, coefficients: (first..=last).map(weight).collect() }
}

/// Whether every old point is kept, as a new point of one kind.
fn keeps_points(mask: &Mask, at: i64) -> bool {
    let arity = i64::from(mask.arity);
    mask.get(at) == RBig::ONE && mask.terms().all(|(i, w)| i == at || (i - at) % arity != 0 || w.is_zero())
}

impl Family {
    fn new(a: &Mask, b: &Mask, m: usize) -> Result<Family, Trouble> {
        let both = |k: usize| Some([differences(a, k)?, differences(b, k)?]);
        let longest = a.coefficients.len().min(b.coefficients.len());
        let kernels = (0..=longest).map_while(both).last().ok_or(Trouble::Domain("there is no mask"))?;
        let interpolating = a.terms().any(|(at, _)| keeps_points(a, at) && keeps_points(b, at));
        let target = (0..m).fold(RBig::ONE, |power, _| power / RBig::from(a.arity));
        let mut family = Family { kernels, interpolating, target, tests: Vec::new() };
        if family.matrices(&RBig::ZERO).first().is_none_or(|matrix| matrix.len() > 12) {
            return Err(Trouble::BeyondThisWorld("the masks have too many weights for ranges"));
        }
        let mut words: Vec<Vec<usize>> = vec![Vec::new()];
        for _ in 0..LONGEST {
            let longer =
                |word: &Vec<usize>| (0..a.arity as usize).map(|e| [word.as_slice(), &[e]].concat()).collect::<Vec<_>>();
            words = words.iter().flat_map(longer).take(64).collect();
            for word in &words {
                let tests = [family.determinant(word, 1)?, family.determinant(word, -1)?];
                family.tests.push((word.clone(), tests));
            }
        }
        Ok(family)
    }

    fn matrices(&self, t: &RBig) -> Vec<Matrix<RBig>> {
        transitions(&between(&self.kernels[0], &self.kernels[1], t))
    }

    /// det(r - sign P) as a polynomial in t, by its values.
    fn determinant(&self, word: &[usize], sign: i64) -> Result<Univariate<RBig>, Trouble> {
        let n = self.matrices(&RBig::ZERO).first().map_or(0, Vec::len);
        let r = word.iter().fold(RBig::from(sign), |power, _| power * &self.target);
        let (mut found, mut through) = (Univariate::constant(RBig::ZERO), Univariate::constant(RBig::ONE));
        for k in 0..=n * word.len() {
            let t = RBig::from(k);
            let own = shifted(&product_of(word, &self.matrices(&t))?, &r)?;
            let value = Univariate::characteristic(&own)?.evaluate(&RBig::ZERO)?;
            // det(-r - P) is (-1)^n det(r + P)
            let value = if n % 2 == 1 && sign < 0 { -value } else { value };
            let step = (value - found.evaluate(&t)?) / through.evaluate(&t)?;
            found = found.plus(&through.scaled(&step)?)?;
            through = through.times(&Univariate::new(vec![-t, RBig::ONE]))?;
        }
        Ok(found)
    }

    fn on(&self, from: &RBig, to: &RBig) -> Finding {
        let refutes =
            |(_, tests): &&(Vec<usize>, [Univariate<RBig>; 2])| tests.iter().any(|p| is_never_positive(p, from, to));
        if let (true, Some((word, _))) = (self.interpolating, self.tests.iter().find(refutes)) {
            return Finding::Refuted(word.clone());
        }
        self.proved(from, to).unwrap_or(Finding::Undecided)
    }

    /// Vertices for the middle, with a rate halfway to the target, that serve at both ends.
    fn proved(&self, from: &RBig, to: &RBig) -> Option<Finding> {
        let middle = self.matrices(&((from + to) / RBig::from(2)));
        let found = leaders(&middle.iter().map(floats).collect::<Vec<_>>());
        let (rate, target) = (found.first()?.rate, self.target.to_f64().value());
        if rate >= target {
            return None;
        }
        let plain: Vec<Vec<f64>> = found.iter().flat_map(|leader| leader.directions.clone()).collect();
        // near a mask with more factors the orbits of these are nearly flat, and their polytope serves nowhere else
        let thick = [plain.clone(), small_axes(middle.first()?.len())].concat();
        let bound = &self.target * (RBig::ONE - RBig::ONE / RBig::from(1_000_000_000));
        [plain, thick].iter().find_map(|directions| {
            let vertices = vertices_for(&middle, directions, libm::sqrt(rate * target), MOST_VERTICES)?;
            let at = |t: &RBig| with_images(&self.matrices(t), &vertices, &bound, 1.0 - 1e-9);
            let ends = Box::new([at(from)?, at(to)?]);
            Some(Finding::Proved { bound: bound.clone(), ends })
        })
    }
}

/// Short vectors along all axes, which keep a polytope from being flat.
fn small_axes(n: usize) -> Vec<Vec<f64>> {
    let axis = |i: usize| (0..n).map(|j| if i == j { 1.0 / 4.0 } else { 0.0 }).collect();
    (0..n).map(axis).collect()
}

/// Whether a polynomial is not positive on an interval, seen by its Bernstein coefficients there.
fn is_never_positive(p: &Univariate<RBig>, from: &RBig, to: &RBig) -> bool {
    let [low, high] = [from, to].map(|t| p.evaluate(t));
    if ![low, high].iter().all(|value| value.as_ref().is_ok_and(|value| *value <= RBig::ZERO)) {
        return false;
    }
    let degree = p.degree().unwrap_or(0);
    // p(from + (to - from) s) by Horner's rule
    let line = Univariate::new(vec![from.clone(), to - from]);
    let horner = p.coefficients().iter().rev().try_fold(Univariate::constant(RBig::ZERO), |so_far, c| {
        so_far.times(&line)?.plus(&Univariate::constant(c.clone()))
    });
    let Ok(own) = horner else { return false };
    let binomial = |n: usize, k: usize| (0..k).fold(RBig::ONE, |b, i| b * RBig::from(n - i) / RBig::from(i + 1));
    let bernstein = |k: usize| {
        let terms = own.coefficients().iter().take(k + 1).enumerate();
        terms.fold(RBig::ZERO, |sum, (i, c)| sum + c * binomial(k, i) / binomial(degree, i))
    };
    (0..=degree).all(|k| bernstein(k) <= RBig::ZERO)
}
