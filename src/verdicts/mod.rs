//! What follows from the analysis, and from which theorem?
//!
//! Each condition gets its value, a verdict and its reasons. A verdict is *proved* or *refuted* on exact or enclosed values
//! only; what rests on floating numbers is *undecided*, with the evidence named and what is missing.

mod claims;

pub use claims::{ClaimCheck, Outcome, check_claims};

use crate::analysis::Analysis;
use crate::analysis::spectrum::{Eigenvalue, near};
use crate::scheme::RuleSum;
use serde::{Deserialize, Serialize};

/// How a question is decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Decision {
    /// True, by exact or enclosed arithmetic and the theorems named.
    Proved,
    /// False, with a certified witness.
    Refuted,
    /// Neither: the reasons say what is missing.
    Undecided,
}

/// Which way floating numbers point, where they don't decide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Evidence {
    /// They speak for it.
    For,
    /// They speak against it.
    Against,
    /// They can't tell: a tie, a cluster, or a missing value.
    None,
}

/// A condition with its verdict.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// The condition's short name.
    pub claim: String,
    /// The condition, in words.
    pub states: String,
    /// Its value, in words.
    pub value: String,
    /// Whether it is decided.
    pub verdict: Decision,
    /// Which way the evidence points.
    pub evidence: Evidence,
    /// Reasons: what was seen, what is missing.
    pub why: Vec<String>,
    /// Keys of the bibliography.
    pub source: Vec<String>,
}

const APPROXIMATE: &str = "approximate (f64): exact or enclosed eigenvalues would decide";
const SAMPLED: &str = "sampled in f64: an enclosure of the Jacobian over the whole ring would decide";

/// How near 1 a ratio of approximate eigenvalues is called a tie.
const TIE: f64 = 1e-9;

/// Every condition at one valence. `sums` are what the check of the scheme file found.
pub fn verdicts(analysis: &Analysis, sums: &[RuleSum]) -> Vec<Verdict> {
    let mut verdicts = vec![
        affine_invariance(sums),
        regular_part(analysis),
        simple_one(analysis),
        subdominant(analysis),
        regular_map(analysis),
        injective_map(analysis),
    ];
    let c1 = c1(&verdicts);
    verdicts.extend([c1, slope_ratio(analysis), classical(analysis, 0), classical(analysis, 2), curvature(analysis)]);
    verdicts
}

fn undecided(claim: &str, states: &str, value: String, evidence: Evidence, why: &[String], source: &[&str]) -> Verdict {
    Verdict {
        claim: claim.to_string(),
        states: states.to_string(),
        value,
        verdict: Decision::Undecided,
        evidence,
        why: why.to_vec(),
        source: source.iter().map(|key| (*key).to_string()).collect(),
    }
}

fn says(holds: bool) -> Evidence {
    if holds { Evidence::For } else { Evidence::Against }
}

/// Whether a is below b, unless an error of a may hide it.
fn below(a: f64, b: f64, approx_error: f64) -> Evidence {
    if (a - b).abs() <= TIE.max(4.0 * approx_error) { Evidence::None } else { says(a < b) }
}

fn affine_invariance(sums: &[RuleSum]) -> Verdict {
    let states = "the weights of every rule sum to 1: constants are reproduced, 1 is an eigenvalue";
    let worst = sums.iter().map(|sum| sum.approx_deviation).fold(0.0, f64::max);
    let loose: Vec<&str> = sums.iter().filter(|sum| !sum.identity).map(|sum| sum.kind.name()).collect();
    let value = if loose.is_empty() { "1 for every n".to_string() } else { format!("1 up to {}", bound(worst)) };
    let mut verdict = undecided("affine invariance", states, value, Evidence::For, &[], &["reif-1995"]);
    if loose.is_empty() {
        verdict.verdict = Decision::Proved;
        verdict.why = vec!["an identity in n, in exact arithmetic, for every rule".to_string()];
    } else {
        verdict.why = vec![format!("[{}]: the sum was compared in f64 at the valences asked for", loose.join("], ["))];
    }
    verdict
}

fn regular_part(analysis: &Analysis) -> Verdict {
    let states = "the scheme is C1 on regular meshes, which the other conditions presuppose";
    let regular = analysis.regular;
    let value = regular
        .lambda
        .map_or("none".to_string(), |lambda| format!("lambda = {} at n = {}", digits(lambda), regular.valence));
    let half = regular.lambda.is_some_and(|lambda| (lambda - 0.5).abs() <= TIE);
    let evidence = match below(regular.rival, 0.5, 0.0) {
        Evidence::For => says(regular.next_modulus < 1.0 && half),
        other => other,
    };
    let seen = if evidence == Evidence::For {
        "what is necessary was seen: 1, then 1/2 twice, then less, at the regular valence"
    } else {
        "a C1 scheme has 1, then 1/2 twice, then less, at the regular valence"
    };
    let why = [seen.to_string(), "contractive difference schemes would decide".to_string()];
    undecided("regular part", states, value, evidence, &why, &["reif-1995", "zorin-2000"])
}

fn simple_one(analysis: &Analysis) -> Verdict {
    let states = "1 is a simple eigenvalue and all others are smaller in modulus";
    let (next, error) = analysis.spectrum.subdominant().map_or((0.0, 0.0), |e| (e.modulus(), e.approx_error));
    let why = [format!("the next modulus is {}", digits(next)), APPROXIMATE.to_string()];
    let evidence = below(next, 1.0, error);
    undecided("1 dominates", states, digits(next), evidence, &why, &["reif-1995", "peters-reif-2008"])
}

fn subdominant(analysis: &Analysis) -> Verdict {
    let states = "the subdominant eigenvalue lambda is real and positive, simple in frequencies 1 and n-1, and larger in modulus \
                  than all that follow";
    let sources = ["reif-1995", "peters-reif-1998"];
    let Some(lambda) = analysis.lambda else {
        let Some(e) = analysis.spectrum.subdominant() else {
            return undecided("subdominant", states, "none".to_string(), Evidence::None, &[no_map(analysis)], &sources);
        };
        let seen = format!("the largest eigenvalue after 1 is {} in frequency {}", complex(&e), e.frequency);
        let first = analysis.spectrum.largest_of(1).map_or(0.0, |first| first.modulus());
        let (evidence, why) = if e.frequency != 1 {
            (below(e.modulus(), first, e.approx_error), "not frequency 1")
        } else if e.is_isolated() {
            (Evidence::Against, "not a positive number")
        } else {
            (Evidence::None, "one of a cluster, whose structure is undecided")
        };
        return undecided("subdominant", states, complex(&e), evidence, &[seen, why.to_string()], &sources);
    };
    let is_lambda = |e: &&Eigenvalue| e.frequency == 1 && near(e.value, lambda.value);
    let rival = analysis.spectrum.after_one().find(|e| !is_lambda(e));
    let (modulus, error) = rival.map_or((0.0, 0.0), |e| (e.modulus(), e.approx_error));
    let name = |e: &Eigenvalue| format!("the next is {} in frequency {}", digits(e.modulus()), e.frequency);
    let mut why = vec![rival.map_or("nothing follows".to_string(), name)];
    let evidence = below(modulus, lambda.value.re, error);
    let tie = "a tie, as far as floating numbers see: exact values would decide";
    why.push(if evidence == Evidence::None { tie } else { APPROXIMATE }.to_string());
    undecided("subdominant", states, digits(lambda.value.re), evidence, &why, &sources)
}

fn regular_map(analysis: &Analysis) -> Verdict {
    let states = "the characteristic map is regular: its Jacobian is positive on the closed ring";
    let sources = ["reif-1995", "peters-reif-2008"];
    let Some(shape) = analysis.map.as_ref().and_then(|map| map.shape) else {
        return undecided("regular map", states, "none".to_string(), Evidence::None, &[no_map(analysis)], &sources);
    };
    let least = shape.approx_least_jacobian;
    let why = [format!("the least of {} samples is {least:.4} of the largest", shape.samples), SAMPLED.to_string()];
    let evidence = below(-least, 0.0, 0.0);
    undecided("regular map", states, format!("{least:.4}"), evidence, &why, &sources)
}

fn injective_map(analysis: &Analysis) -> Verdict {
    let states = "the characteristic map is injective: regular, and its ring turns once around the centre";
    let sources = ["reif-1995", "zorin-2000"];
    let Some(shape) = analysis.map.as_ref().and_then(|map| map.shape) else {
        return undecided("injective map", states, "none".to_string(), Evidence::None, &[no_map(analysis)], &sources);
    };
    let winding = shape.approx_winding;
    let why = [
        format!("winding number {winding:.3}; least cosine to the sector's axis {:.4}", shape.approx_half_plane),
        SAMPLED.to_string(),
    ];
    // the half-plane test gives winding number 1; without it the number itself is read off, a whole one
    let once = shape.approx_half_plane > TIE || winding.round() == 1.0;
    let evidence = match below(-shape.approx_least_jacobian, 0.0, 0.0) {
        Evidence::For => says(once),
        other => other,
    };
    undecided("injective map", states, format!("winding {winding:.3}"), evidence, &why, &sources)
}

fn no_map(analysis: &Analysis) -> String {
    match analysis.lambda {
        None => "lambda is not determined".to_string(),
        Some(_) => {
            "the map's derivatives need the scheme's regular tangent masks, which are not determined".to_string()
        }
    }
}

/// C1 for generic control points, from the conditions before it.
fn c1(conditions: &[Verdict]) -> Verdict {
    let states = "limit surfaces are C1 at the extraordinary point, for generic control points";
    let against = conditions.iter().find(|verdict| verdict.evidence == Evidence::Against);
    let unclear = conditions.iter().find(|verdict| verdict.evidence == Evidence::None);
    let (evidence, why) = match (against, unclear) {
        (Some(verdict), _) => (Evidence::Against, format!("the condition '{}' seems to fail", verdict.claim)),
        (None, Some(verdict)) => (Evidence::None, format!("the condition '{}' is not seen either way", verdict.claim)),
        _ => (Evidence::For, "all conditions above hold as far as floating numbers see".to_string()),
    };
    let why = [why, "no proof has been made".to_string()];
    undecided("C1", states, "-".to_string(), evidence, &why, &["reif-1995", "peters-reif-2008"])
}

/// Doo and Sabin's test for slope: every frequency's largest eigenvalue lies strictly below that of frequency 1.
fn slope_ratio(analysis: &Analysis) -> Verdict {
    let states = "Doo and Sabin's test for slope: |lambda_k|/lambda_1 is below 1 for every frequency k other than 1";
    let Some(lambda) = analysis.lambda else {
        return undecided(
            "slope ratios",
            states,
            "none".to_string(),
            Evidence::None,
            &[no_map(analysis)],
            &["doo-sabin-1978"],
        );
    };
    let rival = analysis.spectrum.after_one().find(|e| e.frequency != 1);
    let ratio = rival.map_or(0.0, |e| e.modulus() / lambda.value.re);
    let evidence = below(ratio, 1.0, rival.map_or(0.0, |e| e.approx_error / lambda.value.re));
    let at =
        rival.map_or("no other frequency".to_string(), |e| format!("the largest is that of frequency {}", e.frequency));
    undecided("slope ratios", states, digits(ratio), evidence, &[at, APPROXIMATE.to_string()], &["doo-sabin-1978"])
}

/// Doo and Sabin's ratios: cup (frequency 0) and saddle (frequency 2) against lambda^2, on the smallest neighbourhood.
fn classical(analysis: &Analysis, frequency: usize) -> Verdict {
    let (claim, e) = match frequency {
        0 => ("cup ratio", analysis.classical.cup),
        _ => ("saddle ratio", analysis.classical.saddle),
    };
    let states = format!(
        "Doo and Sabin's test for curvature: the largest eigenvalue of frequency {frequency} over lambda^2, on the smallest \
         invariant neighbourhood, is 1"
    );
    let sources = ["doo-sabin-1978"];
    let (Some(e), Some(lambda)) = (e, analysis.lambda) else {
        let missing = "the smallest invariant neighbourhood has no such eigenvalue".to_string();
        let why = if e.is_none() { missing } else { no_map(analysis) };
        return undecided(claim, &states, "none".to_string(), Evidence::None, &[why], &sources);
    };
    let ratio = e.modulus() / (lambda.value.re * lambda.value.re);
    let tie = (ratio - 1.0).abs() <= TIE.max(4.0 * e.approx_error);
    let evidence = if tie { Evidence::None } else { Evidence::Against };
    let why = if tie { "1 as far as floating numbers see: an identity would decide" } else { APPROXIMATE };
    undecided(claim, &states, digits(ratio), evidence, &[why.to_string()], &sources)
}

/// What curvature does, by the largest modulus after lambda over the full neighbourhood.
fn curvature(analysis: &Analysis) -> Verdict {
    let states = "curvature at the extraordinary point is bounded, for generic control points: |mu| <= lambda^2 over the full \
                  neighbourhood, and at equality no Jordan block";
    let sources = ["doo-sabin-1978", "peters-reif-2008"];
    if analysis.lambda.is_none() {
        return undecided("curvature", states, "none".to_string(), Evidence::None, &[no_map(analysis)], &sources);
    }
    let Some((ratio, class)) = curvature_class(analysis) else {
        let why = "asked only where lambda dominates: it ties with mu as far as floating numbers see".to_string();
        return undecided("curvature", states, "none".to_string(), Evidence::None, &[why], &sources);
    };
    let (evidence, why) = match class {
        CurvatureClass::Diverges => (Evidence::Against, "above 1: curvature diverges"),
        CurvatureClass::Flat => (Evidence::For, "below 1: a flat point, where curvature tends to 0"),
        CurvatureClass::Tie => (
            Evidence::None,
            "1 as far as floating numbers see: if exactly 1, curvature diverges with a Jordan block, and else is bounded and \
             converges only if all eigenfunctions of that modulus are quadratic polynomials in the characteristic map",
        ),
    };
    let why = [why.to_string(), APPROXIMATE.to_string()];
    undecided("curvature", states, format!("|mu|/lambda^2 = {}", digits(ratio)), evidence, &why, &sources)
}

/// What |mu|/lambda^2 says of curvature, as far as floating numbers see.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurvatureClass {
    /// Above 1.
    Diverges,
    /// Too near 1 to tell.
    Tie,
    /// Below 1.
    Flat,
}

impl CurvatureClass {
    /// In a word or two, for tables.
    pub fn words(self) -> &'static str {
        match self {
            CurvatureClass::Diverges => "diverges",
            CurvatureClass::Tie => "tie at 1",
            CurvatureClass::Flat => "flat",
        }
    }
}

/// |mu|/lambda^2 over the full neighbourhood with its class, where lambda is determined and dominates what follows.
pub fn curvature_class(analysis: &Analysis) -> Option<(f64, CurvatureClass)> {
    let (lambda, mu) = (analysis.lambda?.value.re, analysis.spectrum.after_subdominant().next()?);
    if below(mu.modulus(), lambda, mu.approx_error) != Evidence::For {
        return None;
    }
    let ratio = mu.modulus() / (lambda * lambda);
    let class = match below(ratio, 1.0, mu.approx_error / (lambda * lambda)) {
        Evidence::None => CurvatureClass::Tie,
        Evidence::For => CurvatureClass::Flat,
        Evidence::Against => CurvatureClass::Diverges,
    };
    Some((ratio, class))
}

/// Ten decimals.
pub fn digits(value: f64) -> String {
    let text = format!("{value:.10}");
    if text.trim_start_matches(['-', '0', '.']).is_empty() { "0.0000000000".to_string() } else { text }
}

fn complex(e: &Eigenvalue) -> String {
    match e.real() {
        Some(value) => digits(value),
        None => format!(
            "{} {} {} i",
            digits(e.value.re),
            if e.value.im < 0.0 { "-" } else { "+" },
            digits(e.value.im.abs())
        ),
    }
}

/// A power of ten above a small number, as `< 1e-14`.
pub fn bound(value: f64) -> String {
    let exponent = (-18..=0).find(|exponent| value < libm::pow(10.0, f64::from(*exponent)));
    exponent.map_or("> 1".to_string(), |exponent| format!("< 1e{exponent}"))
}
