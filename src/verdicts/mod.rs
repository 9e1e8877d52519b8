//! What follows from the analysis, and from which theorem?
//!
//! Each condition gets its value, a verdict and its reasons. A verdict is *proved* or *refuted* on exact or enclosed values
//! only; what rests on floating numbers is *undecided*, with the evidence named and what is missing.

mod boundary;
mod boundary_claims;
mod claims;
mod curve;
mod every_valence;

pub use boundary::c1_up_to_boundary;
pub use boundary_claims::check_boundary_claims;
pub use claims::{ClaimCheck, Outcome, check_claims};
pub use curve::{CurveFacts, check_curve_claims};
pub use every_valence::{EveryValence, Stretch};

use crate::analysis::Analysis;
use crate::analysis::exact::{Arithmetic, ExactAnalysis, ExactEigenvalue};
use crate::analysis::spectrum::{Eigenvalue, near};
use crate::proof::c1::Found;
use crate::proof::outcome::Outcome as ProofOutcome;
use crate::scheme::RuleSum;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

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

impl Decision {
    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            Decision::Proved => "proved",
            Decision::Refuted => "refuted",
            Decision::Undecided => "undecided",
        }
    }
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

/// The claim that decides whether surfaces are smooth.
const C1: &str = "C1";

const APPROXIMATE: &str = "approximate (f64): exact or enclosed eigenvalues would decide";
const SAMPLED: &str = "sampled in f64: an enclosure of the Jacobian over the whole ring would decide";

/// How near 1 a ratio of approximate eigenvalues is called a tie.
const TIE: f64 = 1e-9;

/// Every condition at one valence. `sums` are what the check of the scheme file found, `proofs` what was
/// proved there ([`crate::proof::c1::Proofs::at`]).
pub fn verdicts(analysis: &Analysis, sums: &[RuleSum], proofs: &Found) -> Vec<Verdict> {
    let mut verdicts = vec![
        affine_invariance(sums),
        regular_part(analysis),
        simple_one(analysis),
        subdominant(analysis),
        of_map(regular_map(analysis), &proofs.map),
        of_map(injective_map(analysis), &proofs.map),
    ];
    let c1 = c1(&verdicts, proofs.against_c1.as_deref());
    let one_is_known = sums.iter().all(|sum| sum.identity);
    verdicts.extend([c1, slope_ratio(analysis), classical(analysis, 0), classical(analysis, 2), curvature(analysis)]);
    if !one_is_known && analysis.exact.as_ref().is_ok_and(|exact| exact.arithmetic == Arithmetic::Enclosed) {
        verdicts.iter_mut().for_each(leave_open);
    }
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

/// How exact or enclosed numbers say "this holds".
fn decided(holds: bool) -> Decision {
    if holds { Decision::Proved } else { Decision::Refuted }
}

impl Verdict {
    /// The same condition decided, with what decided it in place of the reasons.
    fn by(mut self, holds: bool, exact: &ExactAnalysis, why: impl Into<String>) -> Verdict {
        self.verdict = decided(holds);
        self.evidence = says(holds);
        let how = match exact.arithmetic {
            Arithmetic::Exact => "in exact arithmetic",
            Arithmetic::Enclosed => "by enclosures",
        };
        self.why = vec![format!("{}, {how}", why.into())];
        self
    }
}

/// An eigenvalue with its frequency, for reasons.
fn named(e: &ExactEigenvalue) -> String {
    let value = match &e.exact {
        Some(words) if words.text.len() <= 40 => words.text.clone(),
        _ if e.is_real() => digits(e.re.midpoint_f64()),
        _ => format!("of modulus {}", digits(e.modulus_squared.midpoint_f64().sqrt())),
    };
    format!("{value} in frequency {}", e.frequency)
}

/// An enclosed eigenvalue near 1 is 1 only if the weights are known to sum to 1.
fn leave_open(verdict: &mut Verdict) {
    if verdict.verdict != Decision::Undecided {
        verdict.verdict = Decision::Undecided;
        verdict.why.push("the weights are not shown to sum to 1".to_string());
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
    let part = 1.0 / f64::from(regular.dilation.max(1));
    let alike = regular.lambda.is_some_and(|lambda| (lambda - part).abs() <= TIE);
    let evidence = match below(regular.rival, part, 0.0) {
        Evidence::For => says(regular.next_modulus < 1.0 && alike),
        other => other,
    };
    let spectrum = format!("1, then 1/{} twice, then less, at the regular valence", regular.dilation);
    let seen = if evidence == Evidence::For {
        format!("what is necessary was seen: {spectrum}")
    } else {
        format!("a C1 scheme has {spectrum}")
    };
    let (seen, evidence) = match regular.exactly {
        Some(true) => (format!("what is necessary holds exactly: {spectrum}"), Evidence::For),
        Some(false) => (format!("a C1 scheme has {spectrum}: exactly, it has not"), Evidence::Against),
        None => (seen, evidence),
    };
    let why = [seen, "contractive difference schemes would decide".to_string()];
    let verdict = undecided("regular part", states, value, evidence, &why, &["reif-1995", "zorin-2000"]);
    match regular.c1 {
        Some(holds) => by_symbol(verdict, holds),
        None => verdict,
    }
}

/// The regular part decided by the scheme's symbol.
fn by_symbol(verdict: Verdict, holds: bool) -> Verdict {
    let why = if holds { "difference schemes are contractive" } else { "limits are not C1 there for all data" };
    Verdict {
        verdict: decided(holds),
        evidence: says(holds),
        why: vec![format!("by the symbol, in exact arithmetic: {why}")],
        source: ["cavaretta-dahmen-micchelli-1991", "dyn-1992"].map(str::to_string).to_vec(),
        ..verdict
    }
}

fn simple_one(analysis: &Analysis) -> Verdict {
    let states = "1 is a simple eigenvalue and all others are smaller in modulus";
    let (next, error) = analysis.spectrum.subdominant().map_or((0.0, 0.0), |e| (e.modulus(), e.approx_error));
    let why = [format!("the next modulus is {}", digits(next)), APPROXIMATE.to_string()];
    let evidence = below(next, 1.0, error);
    let verdict = undecided("1 dominates", states, digits(next), evidence, &why, &["reif-1995", "peters-reif-2008"]);
    let Ok(exact) = &analysis.exact else { return verdict };
    let (Some(one), Some((next, e))) = (exact.one, exact.after_one().next()) else { return verdict };
    let simple = exact.eigenvalues[one].algebraic == Some(1);
    let why = format!("the next is {}", named(e));
    if exact.eigenvalues[one].algebraic.is_some_and(|times| times > 1) && exact.arithmetic == Arithmetic::Exact {
        return verdict.by(false, exact, "1 is not simple");
    }
    match exact.compare_moduli(one, next) {
        Some(order) if simple || order != Ordering::Greater => verdict.by(order == Ordering::Greater, exact, why),
        _ => verdict,
    }
}

fn subdominant(analysis: &Analysis) -> Verdict {
    let states = "the subdominant eigenvalue lambda is real and positive, simple in frequencies 1 and n-1, and larger in modulus \
                  than all that follow";
    let verdict = subdominant_approximately(analysis, states);
    let Ok(exact) = &analysis.exact else { return verdict };
    let Some(index) = exact.subdominant else { return verdict };
    let e = &exact.eigenvalues[index];
    if exact.lambda.is_none() {
        return match not_lambda(exact, index) {
            Some(why) => verdict.by(false, exact, why),
            None => verdict,
        };
    }
    let Some((rival, next)) = exact.after_subdominant().next() else {
        return verdict.by(true, exact, "nothing follows");
    };
    let why = format!("lambda is {}, the next {}", named(e), named(next));
    match exact.compare_moduli(index, rival) {
        Some(Ordering::Greater) => verdict.by(true, exact, why),
        Some(_) => verdict.by(false, exact, format!("a tie: {why}")),
        None => verdict,
    }
}

/// Why the subdominant eigenvalue is certainly not as it should be.
fn not_lambda(exact: &ExactAnalysis, index: usize) -> Option<String> {
    let e = &exact.eigenvalues[index];
    let largest_of_1 = exact.after_one().find(|(_, other)| other.frequency == 1).map(|(index, _)| index);
    let behind = largest_of_1.is_none_or(|first| exact.compare_moduli(index, first) == Some(Ordering::Greater));
    if e.frequency != 1 && behind {
        return Some(format!("the largest after 1 is {}, not of frequency 1", named(e)));
    }
    let wrong = !e.is_real() || e.re.sign() == Some(Ordering::Less) || e.algebraic.is_some_and(|times| times > 1);
    let certain = e.frequency == 1 && exact.certain[e.level] && wrong && exact.arithmetic == Arithmetic::Exact;
    certain.then(|| format!("the largest after 1 is {}, not positive and simple there", named(e)))
}

fn subdominant_approximately(analysis: &Analysis, states: &str) -> Verdict {
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

/// A condition on the characteristic map, decided where a proof was found for it. The proofs are about the eigenvalue that the exact
/// spectrum calls lambda, so that without it there is no map.
fn of_map(verdict: Verdict, map: &ProofOutcome<String>) -> Verdict {
    match map {
        ProofOutcome::Proved(how) => {
            Verdict { verdict: Decision::Proved, evidence: Evidence::For, why: vec![how.clone()], ..verdict }
        }
        ProofOutcome::Refuted { witness } => {
            Verdict { verdict: Decision::Refuted, evidence: Evidence::Against, why: vec![witness.clone()], ..verdict }
        }
        ProofOutcome::Undecided { at } => {
            let mut verdict = verdict;
            verdict.why.push(format!("a proof was tried: {at}"));
            verdict
        }
    }
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

/// C1 for generic control points: proved where every condition is, refuted where something excludes it.
fn c1(conditions: &[Verdict], against: Option<&str>) -> Verdict {
    let states = "limit surfaces are C1 at the extraordinary point, for generic control points";
    let undecided = |evidence, why: &[String]| {
        undecided(C1, states, "-".to_string(), evidence, why, &["reif-1995", "peters-reif-2008"])
    };
    if let Some(why) = against {
        return Verdict { verdict: Decision::Refuted, ..undecided(Evidence::Against, &[why.to_string()]) };
    }
    if let Some(why) = folded(conditions) {
        return Verdict { verdict: Decision::Refuted, ..undecided(Evidence::Against, &[why]) };
    }
    let open: Vec<&Verdict> = conditions.iter().filter(|own| own.verdict != Decision::Proved).collect();
    if open.is_empty() {
        let why = "every condition of Reif's theorem is proved".to_string();
        return Verdict { verdict: Decision::Proved, ..undecided(Evidence::For, &[why]) };
    }
    if let Some(own) = conditions.iter().find(|own| own.evidence == Evidence::Against) {
        let how = if own.verdict == Decision::Refuted { "is refuted" } else { "seems to fail" };
        return undecided(Evidence::Against, &[format!("the condition '{}' {how}", own.claim)]);
    }
    if let Some(own) = conditions.iter().find(|own| own.evidence == Evidence::None) {
        return undecided(Evidence::None, &[format!("the condition '{}' is not seen either way", own.claim)]);
    }
    let names: Vec<String> = open.iter().map(|own| format!("'{}'", own.claim)).collect();
    undecided(Evidence::For, &[format!("not proved: {}; they hold as far as floating numbers see", names.join(", "))])
}

/// A map that certainly is not regular and injective excludes C1, if it is that of the eigenvalue that leads after 1.
fn folded(conditions: &[Verdict]) -> Option<String> {
    let own = |claim: &str| conditions.iter().find(|own| own.claim == claim);
    let leads =
        ["1 dominates", "subdominant"].iter().all(|claim| own(claim).map(|own| own.verdict) == Some(Decision::Proved));
    let map = conditions.iter().find(|own| own.claim.ends_with(" map") && own.verdict == Decision::Refuted)?;
    leads.then(|| format!("lambda leads, and the condition '{}' is refuted: {}", map.claim, map.why.join("; ")))
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
    let why = [at, APPROXIMATE.to_string()];
    let verdict = undecided("slope ratios", states, digits(ratio), evidence, &why, &["doo-sabin-1978"]);
    let Ok(exact) = &analysis.exact else { return verdict };
    let rival = exact.after_one().find(|(_, e)| e.frequency != 1);
    match (exact.lambda, rival) {
        (Some(lambda), Some((index, e))) => match exact.compare_moduli(lambda, index) {
            Some(order) => verdict.by(order == Ordering::Greater, exact, format!("the largest other is {}", named(e))),
            None => verdict,
        },
        _ => verdict,
    }
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
    let verdict = undecided(claim, &states, digits(ratio), evidence, &[why.to_string()], &sources);
    let Ok(exact) = &analysis.exact else { return verdict };
    match exact_classical(analysis, exact, frequency) {
        Some((e, Ordering::Equal)) => verdict.by(true, exact, format!("it is lambda^2: {}", named(e))),
        Some((e, _)) => verdict.by(false, exact, format!("it is {}", named(e))),
        None => verdict,
    }
}

/// The largest eigenvalue of a frequency on the smallest invariant neighbourhood, against lambda^2.
fn exact_classical<'a>(
    analysis: &Analysis,
    exact: &'a ExactAnalysis,
    frequency: usize,
) -> Option<(&'a ExactEigenvalue, Ordering)> {
    let index = exact.largest_within(frequency, &analysis.classical.orbits)?;
    Some((&exact.eigenvalues[index], exact.against_square.get(index).copied().flatten()?))
}

/// What curvature does, by the largest modulus after lambda over the full neighbourhood.
fn curvature(analysis: &Analysis) -> Verdict {
    let states = "curvature at the extraordinary point is bounded, for generic control points: |mu| <= lambda^2 over the full \
                  neighbourhood, and at equality no Jordan block";
    let sources = ["doo-sabin-1978", "peters-reif-2008"];
    if analysis.lambda.is_none() {
        return undecided("curvature", states, "none".to_string(), Evidence::None, &[no_map(analysis)], &sources);
    }
    let Some(Curvature { ratio, class, proved }) = curvature_of(analysis) else {
        let why = match exact_lambda_dominates(analysis) {
            Some(false) => "asked only where lambda dominates and is below 1",
            _ => "asked only where lambda dominates: it ties with mu as far as floating numbers see",
        };
        return undecided("curvature", states, "none".to_string(), Evidence::None, &[why.to_string()], &sources);
    };
    let evidence = match class {
        CurvatureClass::Diverges | CurvatureClass::DivergesSlowly | CurvatureClass::DivergesNearby => Evidence::Against,
        CurvatureClass::Tie => Evidence::None,
        _ => Evidence::For,
    };
    let value = format!("|mu|/lambda^2 = {}", digits(ratio));
    let why = [class.reason().to_string(), APPROXIMATE.to_string()];
    let verdict = undecided("curvature", states, value, evidence, &why, &sources);
    match &analysis.exact {
        Ok(exact) if proved => verdict.by(evidence == Evidence::For, exact, class.reason()),
        _ => verdict,
    }
}

/// What |mu|/lambda^2 says of curvature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurvatureClass {
    /// Above 1.
    Diverges,
    /// Exactly 1, with a Jordan block.
    DivergesSlowly,
    /// Not by the eigenvalues here, but at regular vertices, which lie as near as one likes.
    DivergesNearby,
    /// Too near 1 for floating numbers to tell.
    Tie,
    /// Exactly 1, without a Jordan block; whether curvature converges is not decided.
    Bounded,
    /// Exactly 1, without a Jordan block, and some eigenfunction is no quadratic polynomial in the characteristic map.
    BoundedOnly,
    /// Exactly 1, and all eigenfunctions are such polynomials.
    Converges,
    /// Below 1.
    Flat,
}

impl CurvatureClass {
    /// In a word or two, for tables.
    pub fn words(self) -> &'static str {
        match self {
            CurvatureClass::Diverges => "diverges",
            CurvatureClass::DivergesSlowly => "diverges (log)",
            CurvatureClass::DivergesNearby => "diverges (reg)",
            CurvatureClass::Tie => "tie at 1",
            CurvatureClass::Bounded | CurvatureClass::BoundedOnly => "bounded",
            CurvatureClass::Converges => "converges",
            CurvatureClass::Flat => "flat",
        }
    }

    fn reason(self) -> &'static str {
        match self {
            CurvatureClass::Diverges => "above 1: curvature diverges",
            CurvatureClass::DivergesSlowly => {
                "exactly 1 with a Jordan block: curvature diverges, with the logarithm of the distance"
            }
            CurvatureClass::DivergesNearby => {
                "not by the eigenvalues here, but curvature diverges at regular vertices, which lie as near as one likes"
            }
            CurvatureClass::Tie => {
                "1 as far as floating numbers see: if exactly 1, curvature diverges with a Jordan block, and else is bounded and \
                 converges only if all eigenfunctions of that modulus are quadratic polynomials in the characteristic map"
            }
            CurvatureClass::Bounded => {
                "exactly 1 without a Jordan block: curvature is bounded; whether it converges is not decided"
            }
            CurvatureClass::BoundedOnly => {
                "exactly 1 without a Jordan block: curvature is bounded, but doesn't converge: some eigenfunction of that modulus is \
                 no quadratic polynomial in the characteristic map"
            }
            CurvatureClass::Converges => {
                "exactly 1 without a Jordan block, and all eigenfunctions of that modulus are quadratic polynomials in the \
                 characteristic map: curvature converges"
            }
            CurvatureClass::Flat => "below 1: a flat point, where curvature tends to 0",
        }
    }
}

/// What is known of curvature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature {
    /// |mu|/lambda^2 over the full neighbourhood, approximately.
    pub ratio: f64,
    /// What follows.
    pub class: CurvatureClass,
    /// Whether exact or enclosed numbers say so.
    pub proved: bool,
}

/// Whether lambda certainly is larger than all that follows, or certainly not.
fn exact_lambda_dominates(analysis: &Analysis) -> Option<bool> {
    let exact = analysis.exact.as_ref().ok()?;
    let (next, lambda) = (exact.after_subdominant().next()?.0, exact.lambda?);
    let below_one = exact.compare_moduli(exact.one?, lambda)? == Ordering::Greater;
    exact.compare_moduli(lambda, next).map(|order| order == Ordering::Greater && below_one)
}

/// What curvature does, where lambda is determined and dominates what follows.
pub fn curvature_of(analysis: &Analysis) -> Option<Curvature> {
    let (lambda, mu) = (analysis.lambda?.value.re, analysis.spectrum.after_subdominant().next()?);
    let ratio = mu.modulus() / (lambda * lambda);
    match exact_lambda_dominates(analysis) {
        Some(false) => return None,
        Some(true) => {
            if let Some(class) = analysis.exact.as_ref().ok().and_then(exact_curvature) {
                let diverges = matches!(class, CurvatureClass::Diverges | CurvatureClass::DivergesSlowly);
                let nearby = !diverges && analysis.regular.curvature_diverges == Some(true);
                let class = if nearby { CurvatureClass::DivergesNearby } else { class };
                return Some(Curvature { ratio, class, proved: true });
            }
        }
        None => {}
    }
    if below(mu.modulus(), lambda, mu.approx_error) != Evidence::For {
        return None;
    }
    let class = match below(ratio, 1.0, mu.approx_error / (lambda * lambda)) {
        Evidence::None => CurvatureClass::Tie,
        Evidence::For => CurvatureClass::Flat,
        Evidence::Against => CurvatureClass::Diverges,
    };
    Some(Curvature { ratio, class, proved: false })
}

fn exact_curvature(exact: &ExactAnalysis) -> Option<CurvatureClass> {
    let (first, _) = exact.after_subdominant().next()?;
    let order = exact.against_square.get(first).copied().flatten()?;
    Some(match (order, exact.curvature_diverges()?, exact.converges) {
        (Ordering::Less, ..) => CurvatureClass::Flat,
        (Ordering::Greater, ..) => CurvatureClass::Diverges,
        (Ordering::Equal, true, _) => CurvatureClass::DivergesSlowly,
        (Ordering::Equal, false, Some(true)) => CurvatureClass::Converges,
        (Ordering::Equal, false, Some(false)) => CurvatureClass::BoundedOnly,
        (Ordering::Equal, false, None) => CurvatureClass::Bounded,
    })
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
