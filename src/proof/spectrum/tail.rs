//! Is the subdominant eigenvalue real, simple, of frequency 1, and larger than all others but 1, for every valence from
//! one on?
//!
//! Boxes of the parameters that eigenvalues depend on ([`Parts`]) are halved until enclosures decide. General
//! frequencies k >= 2 have the polynomials of frequency 1 at c_k < c in place of c: there is an increasing root
//! ([`super::branch`]), and all others are below what lambda is at the first n. Frequency 0 may meet lambda as n
//! tends to infinity: see [`Tie`]. The statement is proved in docs/theory.md.

use super::branch::{Bounds, approx_largest, at_variable};
use super::disc::{Number, all_within, between};
use super::parts::{Found, Parts, cosine, in_order, named};
use super::tie::Tie;
use crate::analysis::exact::formulas::AllValences;
use crate::numbers::{C, C_K, Field, Free, Trouble, Univariate};
use dashu_ratio::RBig;

/// What shows the order of the eigenvalues for every valence from one on.
#[derive(Clone, Debug, PartialEq)]
pub struct TailProof {
    /// It holds for every valence from this one on, at least 4, ...
    pub from: usize,
    /// ... but for this one, which has rules of its own.
    pub except: Option<usize>,
    /// Lambda is above this from there on.
    pub low: RBig,
    /// Lambda is below this.
    pub high: RBig,
    /// The largest eigenvalue of general frequencies increases with c_k from here to 1, and before it is below `low`; none
    /// where all of them are.
    pub increases_from: Option<RBig>,
    /// Where frequency 0 meets lambda as n tends to infinity: the power of 1/n that their difference is like.
    pub tie_at_infinity: Option<usize>,
    /// How many boxes were looked at.
    pub boxes: usize,
    /// The polynomial that lambda is the largest root of, in c.
    pub polynomial: Univariate<Free>,
}

/// First valences that are tried, as far as the forms hold there.
pub const FIRST: [usize; 13] = [4, 5, 6, 7, 8, 10, 12, 16, 20, 24, 32, 48, 64];
/// The most halvings of a box.
const MOST_HALVINGS: usize = 14;
/// The most boxes of an attempt.
const MOST_BOXES: usize = 1000;
/// Steps from the first cosine to 1 at which the largest root is looked at before boxes are.
const SAMPLES: usize = 4;
/// Bounds of lambda are multiples of 2^-BOUND_BITS.
const BOUND_BITS: u32 = 20;

/// The proof with the least first valence of those that are tried, or where the last attempt got stuck.
///
/// # Errors
/// When a limit of size is passed.
pub fn prove(forms: &AllValences) -> Found<TailProof> {
    let parts = match Parts::of(forms)? {
        Ok(parts) => parts,
        Err(why) => return Ok(Err(why)),
    };
    let mut stuck = "no valence".to_string();
    for from in FIRST.into_iter().filter(|first| *first >= forms.from) {
        let mut attempt = Attempt { parts: &parts, from, boxes: 0, tie: None };
        match attempt.run()? {
            Ok(proof) => return Ok(Ok(TailProof { except: forms.except.filter(|n| *n >= from), ..proof })),
            Err(why) => stuck = why,
        }
    }
    Ok(Err(stuck))
}

struct Attempt<'a> {
    parts: &'a Parts,
    from: usize,
    boxes: usize,
    tie: Option<usize>,
}

impl Attempt<'_> {
    fn run(&mut self) -> Found<TailProof> {
        let (parts, from) = (self.parts, self.from);
        let last = RBig::ONE / RBig::from(from);
        let cosine = cosine(&last)?;
        let Some(low) = parts.branch.below(&cosine, BOUND_BITS)? else {
            return Ok(Err(format!("lambda at n = {from} has no bound from below")));
        };
        let (end, one) = (cosine.lo_hi().0, RBig::ONE);
        if !self.may_increase(&end)? {
            return Ok(Err("the largest eigenvalue of frequency 1 does not increase with its cosine".to_string()));
        }
        let start = if parts.is_general { -&one } else { end.clone() };
        let mut course = Course { increases_from: None, last: None, ended: false };
        if !self.course(&start, &one, &low, &mut course, MOST_HALVINGS)? {
            return Ok(
                Err("the largest eigenvalue of a frequency is not seen to increase with its cosine".to_string()),
            );
        }
        let (Some(first), Some(at_end)) = (course.increases_from, course.last) else {
            return Ok(Err("lambda is not seen to be simple".to_string()));
        };
        if first > end || at_end.high >= one && !self.ends_at_one(&at_end)? {
            return Ok(Err("lambda is not seen to be simple and below 1".to_string()));
        }
        for own in &parts.general {
            if !self.is_below(own, &-&one, &one, &low, MOST_HALVINGS)? {
                return Ok(Err("a general frequency may have an eigenvalue as large as lambda".to_string()));
            }
        }
        for (which, own) in &parts.single {
            if !self.is_led(own, &RBig::ZERO, &last, &at_end.high, MOST_HALVINGS)? {
                return Ok(Err(format!("{} may have an eigenvalue as large as lambda", named(*which))));
            }
        }
        let increases_from = parts.is_general.then_some(first);
        let (tie_at_infinity, boxes) = (self.tie, self.boxes);
        let c = Free::variable(C);
        let polynomial = parts.branch.polynomial().mapped(|value| value.substituted(C_K, &c))?;
        let high = at_end.high;
        Ok(Ok(TailProof { from, except: None, low, high, increases_from, tie_at_infinity, boxes, polynomial }))
    }

    /// Whether the largest root at samples, approximately, increases or is constant from a cosine to 1: else no box will do.
    fn may_increase(&self, from: &RBig) -> Result<bool, Trouble> {
        let step = (RBig::ONE - from) / RBig::from(SAMPLES);
        let mut before = f64::NEG_INFINITY;
        for i in 0..=SAMPLES {
            let at = self.parts.branch.at(&Number::rational(&(from + &step * RBig::from(i))))?;
            let Some(own) = approx_largest(&at).filter(|own| *own > before - 1e-9) else { return Ok(false) };
            before = own;
        }
        Ok(true)
    }

    /// Whether lambda tends to 1, from below: 1 is the root between the bounds at c = 1, and lambda increases with c.
    fn ends_at_one(&self, bounds: &Bounds) -> Result<bool, Trouble> {
        let branch = &self.parts.branch;
        let one = Free::whole(1);
        let last = branch.polynomial().mapped(|value| value.evaluate(&vec![one.clone(); 6]))?;
        let inside = bounds.low < RBig::ONE && RBig::ONE < bounds.high;
        Ok(inside && !branch.is_constant() && last.evaluate(&one)?.is_certainly_zero())
    }

    fn counted(&mut self) -> bool {
        self.boxes += 1;
        self.boxes <= MOST_BOXES
    }

    /// From the right on: the branch increases; then, on boxes of general frequencies, it is below `low`.
    fn course(
        &mut self,
        from: &RBig,
        to: &RBig,
        low: &RBig,
        course: &mut Course,
        left: usize,
    ) -> Result<bool, Trouble> {
        let branch = &self.parts.branch;
        if !self.counted() {
            return Ok(false);
        }
        let small = course.increases_from.is_some()
            && self.parts.is_general
            && all_within(&branch.at(&between(from, to))?, &Number::rational(low))?;
        if small {
            course.ended = true;
            return Ok(true);
        }
        if !course.ended
            && let Some(bounds) = branch.increasing(from, to, self.parts.is_general)?
        {
            course.increases_from = Some(from.clone());
            course.last.get_or_insert(bounds);
            return Ok(true);
        }
        if left == 0 {
            return Ok(false);
        }
        let middle = (from + to) / RBig::from(2);
        Ok(self.course(&middle, to, low, course, left - 1)? && self.course(from, &middle, low, course, left - 1)?)
    }

    /// Whether all roots are below `low` for every c_k in a box.
    fn is_below(
        &mut self,
        own: &Univariate<Free>,
        from: &RBig,
        to: &RBig,
        low: &RBig,
        left: usize,
    ) -> Result<bool, Trouble> {
        if !self.counted() {
            return Ok(false);
        }
        if all_within(&at_variable(own, C_K, &between(from, to))?, &Number::rational(low))? {
            return Ok(true);
        }
        if left == 0 {
            return Ok(false);
        }
        let middle = (from + to) / RBig::from(2);
        Ok(self.is_below(own, &middle, to, low, left - 1)? && self.is_below(own, from, &middle, low, left - 1)?)
    }

    /// Whether all roots are below lambda for every t in a box.
    fn is_led(
        &mut self,
        own: &Univariate<Free>,
        from: &RBig,
        to: &RBig,
        high: &RBig,
        left: usize,
    ) -> Result<bool, Trouble> {
        if !self.counted() {
            return Ok(false);
        }
        let branch = &self.parts.branch;
        let (first, last) = (cosine(to)?, cosine(from)?);
        if let Some(low) = branch.below(&first, BOUND_BITS)? {
            let values = in_order(between(from, to), first.hull(&last));
            let boxed = own.mapped(|value| value.evaluate(&values))?;
            if all_within(&boxed, &Number::rational(&low))? {
                return Ok(true);
            }
            if from.is_zero()
                && let Some(power) = (Tie { branch, own, to, low: &low, high }).power(&boxed)?
            {
                self.tie = self.tie.max(Some(power));
                return Ok(true);
            }
        }
        if left == 0 {
            return Ok(false);
        }
        let middle = (from + to) / RBig::from(2);
        Ok(self.is_led(own, &middle, to, high, left - 1)? && self.is_led(own, from, &middle, high, left - 1)?)
    }
}

/// What is known of the branch from the right on.
struct Course {
    /// It increases from here to 1.
    increases_from: Option<RBig>,
    /// Bounds of it on the last box, that of the largest cosines.
    last: Option<Bounds>,
    /// Whether further to the left it is only known to be small.
    ended: bool,
}
