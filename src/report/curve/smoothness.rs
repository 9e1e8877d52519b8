//! What does the report say of the smoothness of a curve?

use super::model::CurveReport;
use crate::analysis::smoothness::stability::Stability;
use crate::analysis::smoothness::{Smoothness, smoothness};
use crate::report::{Cell, Table};
use crate::scheme::curve::Mask;
use crate::verdicts::CurveFacts;
use dashu_ratio::RBig;
use serde::Serialize;

/// What is known of the smoothness of limit curves, certified.
#[derive(Clone, Debug, Serialize)]
pub struct SmoothnessReport {
    /// The largest k for which C^k is proved.
    pub continuity: u32,
    /// Whether the next is refuted.
    pub no_more: bool,
    /// The Hoelder exponent.
    pub hoelder: HoelderReport,
    /// Whether the integer shifts of the basic limit function are stable; null where that is not decided.
    pub stable: Option<bool>,
    /// The parameter shift tau = a'(1)/a.
    pub shift: String,
    /// The digits of the product of transition matrices that bounds the radius from below.
    pub product: Vec<usize>,
    /// How this is known.
    pub why: Vec<String>,
}

/// Bounds of the Hoelder exponent, rounded outwards.
#[derive(Clone, Debug, Serialize)]
pub struct HoelderReport {
    /// At least this.
    pub lower: f64,
    /// At most this; null where the shifts are not known to be stable.
    pub upper: Option<f64>,
    /// Whether it is attained; null where that is not known.
    pub attained: Option<bool>,
    /// Exactly, where it is known.
    pub exact: Option<String>,
}

/// Twelve decimals, rounded down; more would see the machine.
fn down(value: f64) -> f64 {
    (value * 1e12).floor() / 1e12
}

fn up(value: f64) -> f64 {
    (value * 1e12).ceil() / 1e12
}

/// Why nothing is said of limit curves.
pub(super) struct NoLimit {
    /// In words.
    pub(super) why: String,
    /// Whether it is certain that there are none that are continuous.
    pub(super) certain: bool,
}

/// The smoothness of a mask whose scheme is shown to converge.
pub(super) fn of_mask(mask: &Mask) -> Result<Smoothness, NoLimit> {
    let sums = mask.coset_sums().iter().any(|sum| *sum != RBig::ONE);
    let found = smoothness(mask).map_err(|why| NoLimit { why, certain: sums })?;
    match found.continuity {
        Some(_) => Ok(found),
        None => Err(NoLimit { why: found.why.join("; "), certain: found.radius.lower >= RBig::ONE }),
    }
}

impl SmoothnessReport {
    pub(super) fn of(found: &Smoothness) -> SmoothnessReport {
        let continuity = found.continuity.unwrap_or(0);
        SmoothnessReport {
            continuity: u32::try_from(continuity).unwrap_or(u32::MAX),
            no_more: found.refuted == Some(continuity + 1),
            hoelder: HoelderReport {
                lower: down(found.lower.unwrap_or(0.0)),
                upper: found.upper.map(up),
                attained: found.attained,
                exact: found.exact.clone(),
            },
            stable: match found.stability {
                Stability::Stable => Some(true),
                Stability::Unstable(_) => Some(false),
                Stability::Undecided(_) => None,
            },
            shift: found.shift.to_string(),
            product: found.radius.product.clone(),
            why: found.why.clone(),
        }
    }

    /// The continuity in words.
    pub(super) fn continuity_words(&self) -> String {
        let next = if self.no_more { "refuted" } else { "not decided" };
        format!("C{} proved, C{} {next}", self.continuity, self.continuity + 1)
    }

    /// The exponent in words.
    pub(super) fn hoelder_words(&self) -> String {
        let own = &self.hoelder;
        let value = match (&own.exact, own.upper) {
            (Some(exact), Some(upper)) if exact.parse::<u32>().is_err() => {
                format!("{exact} = {:.9}", (own.lower + upper) / 2.0)
            }
            (Some(exact), _) => exact.clone(),
            (None, Some(upper)) => format!("between {:.9} and {:.9}", floor9(own.lower), floor9(upper) + 1e-9),
            (None, None) => format!("at least {:.9}", floor9(own.lower)),
        };
        let attained = match own.attained {
            Some(true) => ", attained",
            Some(false) => ", not attained",
            None => "",
        };
        value + attained
    }
}

fn floor9(value: f64) -> f64 {
    (value * 1e9).floor() / 1e9
}

/// What claims are compared with.
pub(super) fn facts(found: &Result<Smoothness, NoLimit>) -> CurveFacts {
    let order = |m: usize| i64::try_from(m).ok();
    match found {
        Ok(own) => CurveFacts {
            generation: own.order.checked_sub(1),
            reproduction: Some(own.reproduction_degree),
            proved: own.continuity.and_then(order),
            refuted: own.refuted.and_then(order),
            hoelder: own.lower.map(|lower| [lower, own.upper.unwrap_or(f64::INFINITY)]),
        },
        Err(NoLimit { certain: true, .. }) => CurveFacts { refuted: Some(0), ..CurveFacts::default() },
        Err(_) => CurveFacts::default(),
    }
}

/// The table, if there is something to tell.
pub(super) fn table(report: &CurveReport) -> Option<Table> {
    let row = |what: &str, value: String| vec![Cell::from(what), Cell::from(value)];
    let mut rows = Vec::new();
    if let Some(own) = &report.smoothness {
        rows.push(row("continuity", own.continuity_words()));
        rows.push(row("Hoelder exponent", own.hoelder_words()));
        let degree = |degree: Option<usize>| degree.map_or("-".to_string(), |degree| degree.to_string());
        rows.push(row("polynomials made up to degree", degree(report.generation_degree)));
        let back = format!("{}, with the parameter shift {}", degree(report.reproduction_degree), own.shift);
        rows.push(row("polynomials reproduced up to degree", back));
        let stable = match own.stable {
            Some(true) => "yes",
            Some(false) => "no",
            None => "not decided",
        };
        rows.push(row("integer shifts stable", stable.to_string()));
        rows.push(row("how this is known", own.why.join("; ")));
    } else {
        rows.push(row("continuity", format!("none is known: {}", report.why_no_smoothness.as_ref()?)));
    }
    let note = "Proved and refuted by exact or outward rounded arithmetic: the joint spectral radius of the transition matrices of the differences.";
    Some(Table::new("Smoothness", note, vec!["property".to_string(), "value".to_string()], rows))
}
