//! How does each form of a curve scheme become exact weights?
//!
//! Split and average: with the midpoints' symbol h(z) = (1 + z)^2/(2 z) and the averaging weights r_k at k = -m, ..., the new point i is
//! sum_k r_k q_{i+k}, so that the symbol is r(1/z) h(z) (Lane and Riesenfeld 1980).

use super::{CurveScheme, Ends, Form, Halves, MAX_ARITY, MAX_HALVES, MAX_OFFSET, MAX_TAPS, Mask, Rules, Told};
use crate::fault::Fault;
use crate::numbers::{Field, Laurent};
use crate::scheme::{Place, Placed};
use dashu_ratio::RBig;
use std::ops::Range;

impl CurveScheme {
    pub(super) fn exact_rules(&self) -> Result<Rules, Vec<Fault>> {
        if let Form::Halves { halves, points } = &self.form {
            return self.halves(halves, points).map(Rules::Halves);
        }
        let arity = self.arity().map_err(one)?;
        let (mask, span) = match &self.form {
            Form::Mask(told, first) => (self.told_mask(told, first.as_ref(), arity)?, told.span()),
            Form::Symbol(symbol) => (self.mask_of_symbol(symbol, arity).map_err(one)?, symbol.span.clone()),
            Form::Average { weights, midpoints_only } => (self.averaged(weights, *midpoints_only)?, weights.span()),
            Form::Halves { .. } => return Err(Vec::new()),
        };
        check_mask(&mask, &span)?;
        let ends = self.ends.as_ref().map(|ends| Ends::of(self, ends, &mask)).transpose()?;
        Ok(Rules::Mask(mask, ends))
    }

    /// The value of a formula, which must be rational.
    pub(super) fn rational(&self, placed: &Placed, place: &Place<Laurent>) -> Result<RBig, Fault> {
        let value = self.book.evaluate(placed, place)?;
        value.as_constant().ok_or_else(|| {
            let fault = Fault::at(placed.span.clone(), "this weight is not a rational number", "not rational");
            fault.hint("weights of curves are fractions, such as 9/16")
        })
    }

    /// The value of a formula, which must be a whole number in a range.
    pub(super) fn whole(&self, placed: &Placed, range: Range<i64>, what: &str) -> Result<i64, Fault> {
        let value = self.rational(placed, &nowhere())?;
        let whole = value.is_int().then(|| i64::try_from(value.numerator().clone()).ok()).flatten();
        whole.filter(|whole| range.contains(whole)).ok_or_else(|| {
            let message = format!("{what} must be a whole number from {} to {}", range.start, range.end - 1);
            Fault::at(placed.span.clone(), message, format!("this is {}", shortened(&value)))
        })
    }

    fn arity(&self) -> Result<u32, Fault> {
        let Some(placed) = &self.arity else { return Ok(2) };
        self.whole(placed, 2..i64::from(MAX_ARITY) + 1, "the arity").map(|arity| arity as u32).map_err(|fault| {
            fault.hint("the arity is the number of new points for each old one: 2 is binary, 3 ternary")
        })
    }

    /// The weights of a list.
    fn weights(&self, told: &Told) -> Result<Vec<RBig>, Vec<Fault>> {
        let too_many = |span: &Range<usize>, count: String| {
            Fault::at(span.clone(), format!("{count} weights; the limit is {MAX_TAPS}"), "too many")
        };
        match told {
            Told::List(list, span) if list.len() > MAX_TAPS => Err(vec![too_many(span, list.len().to_string())]),
            Told::List(list, _) => all(list.iter().map(|placed| self.rational(placed, &nowhere()))),
            Told::Each(formula, taps) => {
                let count = self.whole(taps, 1..MAX_TAPS as i64 + 1, "the number of weights").map_err(one)?;
                all((0..count).map(|j| self.rational(formula, &indexed(j, j))))
            }
        }
    }

    fn told_mask(&self, told: &Told, first: Option<&Placed>, arity: u32) -> Result<Mask, Vec<Fault>> {
        let weights = self.weights(told);
        let first = first.map(|placed| self.whole(placed, -MAX_OFFSET..MAX_OFFSET + 1, "the first index")).transpose();
        match (weights, first) {
            (Ok(weights), Ok(first)) => Ok(Mask::new(first.unwrap_or(centred(weights.len())), arity, weights)),
            (weights, first) => Err(weights.err().into_iter().flatten().chain(first.err()).collect()),
        }
    }

    fn mask_of_symbol(&self, symbol: &Placed, arity: u32) -> Result<Mask, Fault> {
        let place = Place { variable: Some("z"), count: 0, value: Laurent::atom("z"), index: Laurent::whole(0) };
        let form = self.book.evaluate(symbol, &place)?;
        let wrong = |message: String| Fault::at(symbol.span.clone(), message, "the symbol");
        let powers = form.powers_of("z").ok_or_else(|| {
            wrong("the symbol is not a sum of powers of z with rational coefficients".to_string())
                .hint("such as (1 + z)^4/(8*z^2); a quotient that divides without rest is to be multiplied out")
        })?;
        let (Some(first), Some(last)) = (powers.iter().map(|(e, _)| *e).min(), powers.iter().map(|(e, _)| *e).max())
        else {
            return Ok(Mask::new(0, arity, vec![]));
        };
        if first < -MAX_OFFSET || last > MAX_OFFSET || last - first >= MAX_TAPS as i64 {
            let message = format!("the symbol has powers of z from {first} to {last}; the limit is {MAX_TAPS} of them");
            return Err(wrong(message));
        }
        let mut weights = vec![RBig::ZERO; (last - first + 1) as usize];
        for (exponent, value) in powers {
            weights[(exponent - first) as usize] += value;
        }
        Ok(Mask::new(first, arity, weights))
    }

    /// The mask of split and average.
    fn averaged(&self, told: &Told, midpoints_only: bool) -> Result<Mask, Vec<Fault>> {
        let r = self.weights(told)?;
        let half = RBig::ONE / RBig::from(2);
        let split = [(-1, half.clone()), (0, RBig::ONE), (1, half)];
        let first_k = centred(r.len());
        let (lowest, highest) = (-1 - (first_k + r.len() as i64 - 1), 1 - first_k);
        let mut weights = vec![RBig::ZERO; (highest - lowest + 1) as usize];
        let mut add = |i: i64, value: RBig| weights[(i - lowest) as usize] += value;
        for (k, r) in (first_k..).zip(&r) {
            for (i, h) in &split {
                let at = i - k;
                // the new points of old ones have even indices
                if !midpoints_only || at % 2 != 0 {
                    add(at, r * h);
                }
            }
        }
        if midpoints_only {
            weights[(-lowest) as usize] = RBig::ONE;
        }
        Ok(Mask::new(lowest, 2, weights))
    }

    fn halves(&self, halves: &[Placed; 2], points: &Placed) -> Result<Halves, Vec<Fault>> {
        let count = self.whole(points, 2..MAX_HALVES as i64 + 1, "the number of points").map_err(one)?;
        let row = |placed: &Placed, i: i64| all((0..count).map(|j| self.rational(placed, &indexed(i, j))));
        let matrix = |placed: &Placed| (0..count).map(|i| row(placed, i)).collect::<Result<Vec<_>, _>>();
        let own = Halves { first: matrix(&halves[0])?, second: matrix(&halves[1])? };
        let span = |second: bool| halves[usize::from(second)].span.clone();
        own.faults()
            .into_iter()
            .map(|(second, message)| Fault::at(span(second), message, ""))
            .try_fold((), |(), fault| Err(vec![fault]))?;
        Ok(own)
    }
}

/// The first index of so many weights about 0.
fn centred(count: usize) -> i64 {
    -((count.saturating_sub(1) / 2) as i64)
}

pub(super) fn nowhere() -> Place<Laurent> {
    Place::at(None, 0)
}

/// Formulas in i and j.
pub(super) fn indexed(i: i64, j: i64) -> Place<Laurent> {
    Place { variable: Some("i"), count: i, value: Laurent::whole(i), index: Laurent::whole(j) }
}

pub(super) fn one(fault: Fault) -> Vec<Fault> {
    vec![fault]
}

/// Every value, or the faults of as many as a user wants to see at once.
pub(super) fn all(values: impl Iterator<Item = Result<RBig, Fault>>) -> Result<Vec<RBig>, Vec<Fault>> {
    const MOST: usize = 20;
    let (mut good, mut bad) = (Vec::new(), Vec::new());
    for value in values {
        match value {
            Ok(value) => good.push(value),
            Err(fault) => bad.push(fault),
        }
        if bad.len() >= MOST {
            break;
        }
    }
    // one formula for many weights has the same fault many times
    bad.dedup_by(|a, b| a.span == b.span);
    if bad.is_empty() { Ok(good) } else { Err(bad) }
}

/// A number in words that fit a line.
pub(super) fn shortened(value: &RBig) -> String {
    let text = value.to_string();
    if text.len() <= 40 { text } else { format!("about {:e}", value.to_f64().value()) }
}

/// The sum of every submask is 1: needed for convergence (Dyn and Levin 2002).
fn check_mask(mask: &Mask, span: &Range<usize>) -> Result<(), Vec<Fault>> {
    if mask.coefficients.is_empty() {
        return Err(vec![Fault::at(span.clone(), "every weight of the mask is zero", "")]);
    }
    let arity = mask.arity;
    let wrong = mask.coset_sums().into_iter().enumerate().filter(|(_, sum)| *sum != RBig::ONE);
    let faults: Vec<Fault> = wrong
        .map(|(r, sum)| {
            let message = format!(
                "the sum rule fails: the weights with index {r} modulo {arity} sum to {}, not to 1, so that constants are not \
                 reproduced and the scheme can't converge",
                shortened(&sum)
            );
            let fault = Fault::at(span.clone(), message, "this mask");
            fault.hint(format!("each new point is a mean of old ones: the weights a_i with i = {r} modulo {arity} must sum to 1"))
        })
        .collect();
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}
