//! Which spectra exclude C1 for every valence from one on?
//!
//! A radius r parts the eigenvalues after 1: those of the frequencies 0 and 1 are below r for every n, and some
//! frequency k >= 2 has one above, since its c_k lies in a window of cosines where one is. Or those of frequency 0
//! are below r but for one that is real and simple, and so are all of other frequencies. Proved in docs/theory.md;
//! enclosures decide.

use super::branch::{approx_largest_modulus, at_variable, rounded};
use super::disc::{Number, all_within, between, deflated, is_negative};
use super::parts::{cosine, depends_on_others, frequencies, in_order, in_t, one};
use super::refutation::SUPPOSED;
use super::tail::FIRST;
use crate::analysis::exact::formulas::{AllValences, FrequencyForms, Which};
use crate::numbers::{C, C_K, Field, Free, Trouble, Univariate};
use dashu_ratio::RBig;

/// The most halvings of a box.
const MOST_HALVINGS: usize = 14;
/// The most boxes of an attempt.
const MOST_BOXES: usize = 4000;
/// The most halvings of a step of a window.
const WINDOW_HALVINGS: usize = 5;
/// Windows of k/n have ends that are multiples of 1/STEPS.
const STEPS: usize = 96;
/// Radii are multiples of 2^-RADIUS_BITS.
const RADIUS_BITS: u32 = 12;

/// The least valence of those that are tried from which on limits of generic data are not C1, and why. It is told for
/// effective schemes, see [`super::refutation::is_effective`].
///
/// # Errors
/// When a limit of size is passed.
pub fn against_c1(forms: &AllValences) -> Result<Option<(usize, String)>, Trouble> {
    let Some(parts) = Parts::of(forms)? else { return Ok(None) };
    if !parts.may_exclude()? {
        return Ok(None);
    }
    let holds = |first: &usize| *first >= forms.from && forms.except.is_none_or(|except| *first > except);
    for from in FIRST.into_iter().filter(holds) {
        let mut attempt = Attempt { parts: &parts, from, boxes: 0 };
        let found = match attempt.general_leads()? {
            None => attempt.zero_leads()?,
            found => found,
        };
        if let Some(why) = found {
            return Ok(Some((from, why)));
        }
    }
    Ok(None)
}

/// The factors of the characteristic polynomials, each as often as it stands there, in t, at the place of n, and c; general
/// ones in c_k.
struct Parts {
    zero: Vec<Univariate<Free>>,
    first: Vec<Univariate<Free>>,
    /// Those that are singled out, from 2 on, and n/2.
    others: Vec<Univariate<Free>>,
    general: Vec<Univariate<Free>>,
    /// The largest frequency that is singled out.
    singled: usize,
}

impl Parts {
    fn of(forms: &AllValences) -> Result<Option<Parts>, Trouble> {
        let Ok((zero, first, general)) = frequencies(forms) else { return Ok(None) };
        let general: Vec<Univariate<Free>> = general.forms.iter().map(|form| form.polynomial.clone()).collect();
        if general.iter().any(|own| depends_on_others(own, C_K)) {
            return Ok(None);
        }
        let all = |own: &FrequencyForms| {
            let factors = own.forms.iter().flat_map(|form| std::iter::repeat_n(&form.polynomial, form.multiplicity));
            factors.map(|own| own.mapped(in_t)).collect::<Result<Vec<_>, _>>()
        };
        let with_c = |own: &Free| own.substituted(C_K, &Free::variable(C));
        let first = all(first)?.iter().map(|own| own.mapped(with_c)).collect::<Result<_, _>>()?;
        let zero = all(zero)?.into_iter().filter(|own| *own != one()).collect();
        let mut others = Vec::new();
        for own in forms.frequencies.iter().filter(|own| !matches!(own.which, Which::Is(0 | 1) | Which::General)) {
            others.extend(all(own)?);
        }
        let singled =
            forms.frequencies.iter().filter_map(|own| if let Which::Is(k) = own.which { Some(k) } else { None });
        Ok(Some(Parts { zero, first, others, general, singled: singled.max().unwrap_or(0) }))
    }

    /// Whether, approximately, frequency 1 is not the largest as n tends to infinity.
    fn may_exclude(&self) -> Result<bool, Trouble> {
        let mut values = in_order(Number::whole(0), Number::whole(1));
        let (first, zero) = (largest(self.first.iter(), &values)?, largest(self.zero.iter(), &values)?);
        let mut most = zero;
        for i in 1..8 {
            values[C_K] = cosine(&part(i, 16))?;
            most = most.zip(largest(self.general.iter(), &values)?).map(|(most, own)| most.max(own));
        }
        Ok(most.zip(first).is_some_and(|(most, first)| most > first + 1e-9))
    }
}

struct Attempt<'a> {
    parts: &'a Parts,
    from: usize,
    boxes: usize,
}

impl Attempt<'_> {
    /// A frequency from 2 on leads at every n.
    fn general_leads(&mut self) -> Result<Option<String>, Trouble> {
        let parts = self.parts;
        let rivals = || parts.zero.iter().chain(&parts.first);
        let Some(moduli) = self.moduli(rivals())? else { return Ok(None) };
        let most = moduli.into_iter().fold(0.0, f64::max);
        let radius = rounded(most, RADIUS_BITS) + part(2, 1 << RADIUS_BITS);
        let Some((start, end)) = window(&parts.general, &radius)? else { return Ok(None) };
        let one = RBig::ONE;
        if radius >= one || !self.meets(start, end) {
            return Ok(None);
        }
        for own in &parts.general {
            if !self.is_small(own, true, (-&one, one.clone()), &one, MOST_HALVINGS)? {
                return Ok(None);
            }
        }
        let last = part(1, self.from);
        for (own, radius) in rivals().map(|own| (own, &radius)).chain(parts.others.iter().map(|own| (own, &one))) {
            if !self.is_small(own, false, (RBig::ZERO, last.clone()), radius, MOST_HALVINGS)? {
                return Ok(None);
            }
        }
        let (low, high) = (part(start, STEPS), part(end, STEPS));
        Ok(Some(format!(
            "a frequency other than 0 and 1 leads: every n >= {} has one with k/n from {low} to {high}, whose largest \
             eigenvalue is above {radius}; those of frequency 1 and those of frequency 0 after 1 are smaller in modulus: limits are not \
             single-sheeted, {SUPPOSED}",
            self.from
        )))
    }

    /// One eigenvalue of frequency 0 leads at every n, and it is real and simple.
    fn zero_leads(&mut self) -> Result<Option<String>, Trouble> {
        let parts = self.parts;
        let others = || parts.first.iter().chain(&parts.others);
        let moduli = (self.moduli(parts.zero.iter())?, self.moduli(others())?);
        let (Some(zero), Some(moduli)) = moduli else { return Ok(None) };
        let (least, most) = (zero.into_iter().fold(1.0, f64::min), moduli.into_iter().fold(0.0, f64::max));
        let radius = rounded(0.5 * (least + most), RADIUS_BITS);
        if least <= most || radius <= RBig::ZERO || radius >= RBig::ONE {
            return Ok(None);
        }
        let last = part(1, self.from);
        for own in &parts.general {
            if !self.is_small(own, true, (-RBig::ONE, RBig::ONE), &radius, MOST_HALVINGS)? {
                return Ok(None);
            }
        }
        for own in others() {
            if !self.is_small(own, false, (RBig::ZERO, last.clone()), &radius, MOST_HALVINGS)? {
                return Ok(None);
            }
        }
        if !self.one_is_outside((RBig::ZERO, last), &radius, MOST_HALVINGS)? {
            return Ok(None);
        }
        Ok(Some(format!(
            "frequency 0 leads: at every n >= {} it has after 1 one eigenvalue above {radius} in modulus, and all others \
             are below: limits lie along a half line, {SUPPOSED}",
            self.from
        )))
    }

    /// Whether every n from the first on has a k >= 2, k < n/2, not singled out, with k/n in a window.
    fn meets(&self, start: usize, end: usize) -> bool {
        // from there on n (end - start)/STEPS >= 1, and more k are in the window the larger n is
        let clear = STEPS / (end - start) + STEPS * (self.parts.singled + 2) / end + 2;
        (self.from..=clear.max(self.from)).all(|n| {
            let k = end * n / STEPS;
            k >= 2 && k > self.parts.singled && k * STEPS >= start * n
        })
    }

    /// The largest modulus of all roots at each of some valences, approximately.
    fn moduli<'b>(
        &self,
        factors: impl Iterator<Item = &'b Univariate<Free>> + Clone,
    ) -> Result<Option<Vec<f64>>, Trouble> {
        self.samples()?.iter().map(|values| largest(factors.clone(), values)).collect()
    }

    /// Values of t and c for t from 0 to the first 1/n.
    fn samples(&self) -> Result<Vec<Vec<Number>>, Trouble> {
        let values = |i: usize| {
            let t = part(i, 8 * self.from);
            Ok(in_order(Number::rational(&t), cosine(&t)?))
        };
        (0..=8).map(values).collect()
    }

    fn counted(&mut self) -> bool {
        self.boxes += 1;
        self.boxes <= MOST_BOXES
    }

    /// Whether all roots have a modulus below a radius, for every c_k, or else every t, in a box.
    fn is_small(
        &mut self,
        own: &Univariate<Free>,
        general: bool,
        (from, to): (RBig, RBig),
        radius: &RBig,
        left: usize,
    ) -> Result<bool, Trouble> {
        if !self.counted() {
            return Ok(false);
        }
        let boxed = match general {
            true => at_variable(own, C_K, &between(&from, &to))?,
            false => on_box(own, &from, &to)?,
        };
        if all_within(&boxed, &Number::rational(radius))? {
            return Ok(true);
        }
        let middle = (&from + &to) / RBig::from(2);
        Ok(left > 0
            && self.is_small(own, general, (middle.clone(), to), radius, left - 1)?
            && self.is_small(own, general, (from, middle), radius, left - 1)?)
    }

    /// Whether of the roots of frequency 0 just one is outside, real and below 1 in modulus, for every t in a box.
    fn one_is_outside(&mut self, (from, to): (RBig, RBig), radius: &RBig, left: usize) -> Result<bool, Trouble> {
        if !self.counted() {
            return Ok(false);
        }
        let mut outside = 0;
        for own in &self.parts.zero {
            let boxed = on_box(own, &from, &to)?;
            if !all_within(&boxed, &Number::rational(radius))? {
                outside += if is_outside(&boxed, radius)? { 1 } else { 2 };
            }
        }
        if outside == 1 {
            return Ok(true);
        }
        let middle = (&from + &to) / RBig::from(2);
        Ok(left > 0
            && self.one_is_outside((middle.clone(), to), radius, left - 1)?
            && self.one_is_outside((from, middle), radius, left - 1)?)
    }
}

/// The largest modulus of all roots, approximately.
fn largest<'b>(factors: impl Iterator<Item = &'b Univariate<Free>>, values: &[Number]) -> Result<Option<f64>, Trouble> {
    let mut most = Some(0.0_f64);
    for own in factors {
        let own = approx_largest_modulus(&own.mapped(|value| value.evaluate(values))?);
        most = most.zip(own).map(|(most, own)| most.max(own));
    }
    Ok(most)
}

/// Whether just one root is outside a radius, real and below 1 in modulus.
fn is_outside(boxed: &Univariate<Number>, radius: &RBig) -> Result<bool, Trouble> {
    if !all_within(boxed, &Number::whole(1))? {
        return Ok(false);
    }
    for own in [boxed.clone(), boxed.at_negative().monic()?] {
        let inside = Number::rational(radius);
        if is_negative(&own.evaluate(&inside)?) {
            return all_within(&deflated(&own, &between(radius, &RBig::ONE))?, &inside);
        }
    }
    Ok(false)
}

/// The longest run of steps of k/n, below 1/2, on which one of these has a root above a radius.
fn window(general: &[Univariate<Free>], radius: &RBig) -> Result<Option<(usize, usize)>, Trouble> {
    let mut longest: Option<(usize, usize)> = None;
    for own in general {
        let mut start = 1;
        for i in 1..STEPS / 2 {
            if !has_root_above(own, radius, (part(i, STEPS), part(i + 1, STEPS)), WINDOW_HALVINGS)? {
                start = i + 1;
            } else if longest.is_none_or(|(low, high)| i + 1 - start > high - low) && i + 1 < STEPS / 2 {
                longest = Some((start, i + 1));
            }
        }
    }
    Ok(longest)
}

/// Whether a monic polynomial has a root above a radius for every k/n in a box: it is negative there.
fn has_root_above(
    own: &Univariate<Free>,
    radius: &RBig,
    (from, to): (RBig, RBig),
    left: usize,
) -> Result<bool, Trouble> {
    let cosines = cosine(&from)?.hull(&cosine(&to)?);
    if is_negative(&at_variable(own, C_K, &cosines)?.evaluate(&Number::rational(radius))?) {
        return Ok(true);
    }
    let middle = (&from + &to) / RBig::from(2);
    Ok(left > 0
        && has_root_above(own, radius, (from, middle.clone()), left - 1)?
        && has_root_above(own, radius, (middle, to), left - 1)?)
}

/// A polynomial in t and c, enclosed for every t in a box.
fn on_box(own: &Univariate<Free>, from: &RBig, to: &RBig) -> Result<Univariate<Number>, Trouble> {
    let values = in_order(between(from, to), cosine(from)?.hull(&cosine(to)?));
    own.mapped(|value| value.evaluate(&values))
}

fn part(above: usize, below: usize) -> RBig {
    RBig::from(above) / RBig::from(below)
}
