//! What becomes of the ends of an open curve?
//!
//! The first new points have rules of their own, told from the end on; then the mask goes on from an index. The other end is the
//! mirror image, so that the mask must be symmetric. Clamped and natural cubic splines are such schemes (knot insertion, Boehm 1980).

use super::forms::{all, nowhere, one, shortened};
use super::{CurveScheme, EndRules, MAX_TAPS, Mask};
use crate::fault::Fault;
use dashu_ratio::RBig;

/// The exact rules at an end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ends {
    /// Row r makes the new point r from the first old points on.
    pub rules: Vec<Vec<RBig>>,
    /// The index of the first new point of the mask after them.
    pub then: i64,
}

impl Ends {
    pub(super) fn of(scheme: &CurveScheme, told: &EndRules, mask: &Mask) -> Result<Ends, Vec<Fault>> {
        let mut faults = Vec::new();
        let mut rules = Vec::new();
        for (row, span) in &told.rules {
            if row.is_empty() || row.len() > MAX_TAPS {
                let message = format!("a rule of {} weights; 1 to {MAX_TAPS} are allowed", row.len());
                faults.push(Fault::at(span.clone(), message, ""));
                continue;
            }
            match all(row.iter().map(|placed| scheme.rational(placed, &nowhere()))) {
                Err(own) => faults.extend(own),
                Ok(weights) => {
                    let sum = weights.iter().fold(RBig::ZERO, |sum, weight| sum + weight);
                    if sum != RBig::ONE {
                        let message = format!("the weights of this end rule sum to {}, not to 1", shortened(&sum));
                        faults.push(Fault::at(span.clone(), message, "this rule"));
                    }
                    rules.push(weights);
                }
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let span = told.rules.first().map_or(0..0, |(_, span)| span.clone());
        if !mask.is_symmetric() {
            let fault = Fault::at(span, "end rules need a mask that is the same from both ends", "");
            return Err(one(fault.hint("the rules of the other end are the mirror image of these")));
        }
        let inside = first_inside(mask);
        let then = match &told.then {
            None => inside,
            Some(placed) => scheme.whole(placed, inside..inside + MAX_TAPS as i64, "`then`").map_err(|fault| {
                one(fault.hint(format!("the first new point whose old points are all there has the index {inside}")))
            })?,
        };
        Ok(Ends { rules, then })
    }
}

/// The index of the first new point that is made of old points from 0 on only.
pub(crate) fn first_inside(mask: &Mask) -> i64 {
    let Some((first, last)) = mask.support() else { return 0 };
    let reaches = |i: i64| mask.submask(i).first().is_none_or(|(j, _)| *j >= 0);
    (first..=last + i64::from(mask.arity)).rev().take_while(|i| reaches(*i)).last().unwrap_or(last)
}
