//! Does the analysis agree with what the literature says?

use super::{Decision, Evidence, Verdict, bound, digits};
use crate::analysis::Analysis;
use crate::analysis::exact::Value;
use crate::analysis::spectrum::{Eigenvalue, NEAR};
use crate::fault::Fault;
use crate::scheme::{Claim, Place, Quantity, Scheme};
use dashu_ratio::RBig;
use serde::{Deserialize, Serialize};

/// Approximate values that differ by less are said to agree, unless the claim is a decimal: then half a unit of its last digit.
const AGREE: f64 = 1e-12;

/// How far the value may be off that is claimed by this formula.
pub(super) fn tolerance(formula: &str) -> f64 {
    match formula.trim().split_once('.') {
        Some((whole, digits)) if format!("{whole}{digits}").bytes().all(|byte| byte.is_ascii_digit()) => {
            AGREE + 0.5 * libm::pow(10.0, -(digits.len() as f64))
        }
        _ => AGREE,
    }
}

/// What became of a claim. None of it is a proof: the values compared are approximate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// The values agree, to rounding or to the digits given, at every valence where it is made.
    Agrees,
    /// At some valence they differ, or the evidence speaks against a property.
    Disagrees,
    /// It can't be told: a property without a proof, a value that the analysis has not, or no valence where it is made.
    Undecided,
}

/// A claim beside the analysis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClaimCheck {
    /// What it is about.
    pub what: String,
    /// The value claimed, as written.
    pub equals: Option<String>,
    /// Where it is made, as written.
    #[serde(rename = "where")]
    pub condition: Option<String>,
    /// Who makes it.
    pub source: Vec<String>,
    /// What became of it.
    pub outcome: Outcome,
    /// What was seen.
    pub seen: String,
}

/// Compares every claim of a scheme with the analyses. `verdicts` are those of the same valences. `names` tells which
/// orbit a position's name stands for.
///
/// # Errors
/// When a claimed value can't be computed.
pub fn check_claims(
    scheme: &Scheme,
    analyses: &[(Analysis, Vec<Verdict>)],
    orbit_of: &dyn Fn(&str) -> Option<(i32, i32)>,
) -> Result<Vec<ClaimCheck>, Fault> {
    scheme.claims.iter().map(|claim| check(scheme, claim, analyses, orbit_of)).collect()
}

fn check(
    scheme: &Scheme,
    claim: &Claim,
    analyses: &[(Analysis, Vec<Verdict>)],
    orbit_of: &dyn Fn(&str) -> Option<(i32, i32)>,
) -> Result<ClaimCheck, Fault> {
    let mut made = Vec::new();
    for (analysis, verdicts) in analyses {
        if scheme.claim_is_made_at(claim, analysis.valence)? {
            made.push((analysis, verdicts));
        }
    }
    let (outcome, seen) = match &claim.equals {
        _ if made.is_empty() => (Outcome::Undecided, "made for none of these valences".to_string()),
        Some(equals) => {
            let mut pairs = Vec::new();
            for (analysis, _) in &made {
                let place = Place::<f64>::at(Some("n"), analysis.valence as i64);
                let claimed = scheme.book.evaluate(equals, &place)?;
                let enclosed =
                    scheme.book.evaluate(equals, &Place::<Value>::at(Some("n"), analysis.valence as i64)).ok();
                let own = exactly_found(analysis, &claim.quantity, orbit_of);
                let meets = own.zip(enclosed).and_then(|(own, claimed)| meets(&own, &claimed));
                let found = found(analysis, &claim.quantity, orbit_of);
                pairs.push(Pair { valence: analysis.valence, found, claimed, meets });
            }
            compare(&pairs, tolerance(equals.formula.text()))
        }
        None => property(&made, &claim.quantity),
    };
    Ok(ClaimCheck {
        what: claim.what.clone(),
        equals: claim.equals.as_ref().map(|placed| placed.formula.text().to_string()),
        condition: claim.condition.as_ref().map(|condition| condition.text().to_string()),
        source: claim.sources.clone(),
        outcome,
        seen,
    })
}

/// Whether two enclosures have a number in common; `None` where they do but are too wide to say how near the numbers are.
fn meets(a: &Value, b: &Value) -> Option<bool> {
    if !a.overlaps(b) {
        return Some(false);
    }
    let narrow = RBig::ONE / RBig::from(10).pow(MAX_AGREEING as isize + 1);
    (a.width() < narrow && b.width() < narrow).then_some(true)
}

/// A value beside the one that is claimed.
struct Pair {
    valence: usize,
    found: Option<f64>,
    claimed: f64,
    /// Whether the enclosures of both have a number in common, where both are enclosed.
    meets: Option<bool>,
}

fn compare(pairs: &[Pair], tolerance: f64) -> (Outcome, String) {
    if tolerance <= AGREE && pairs.iter().all(|pair| pair.meets == Some(true)) {
        return (Outcome::Agrees, format!("equal to {MAX_AGREEING} decimals"));
    }
    let differs = |pair: &&Pair| tolerance <= AGREE && pair.meets == Some(false);
    let mut worst = (0, 0.0, 0.0, 0.0);
    for Pair { valence, found, claimed, .. } in pairs {
        let Some(found) = found else {
            return (
                Outcome::Undecided,
                format!("the analysis has no such value, or none sharp enough, at n = {valence}"),
            );
        };
        let difference = (found - claimed).abs();
        if worst.0 == 0 || difference > worst.1 {
            worst = (*valence, difference, *found, *claimed);
        }
    }
    let (n, difference, found, claimed) = worst;
    match pairs.iter().find(differs) {
        None if difference <= tolerance => (Outcome::Agrees, format!("differs by {} (approximate)", bound(difference))),
        Some(pair) if difference <= tolerance => (
            Outcome::Disagrees,
            format!("at n = {} it certainly differs, by less than {}", pair.valence, bound(difference)),
        ),
        _ => (Outcome::Disagrees, format!("at n = {n} it is {}, not {}", digits(found), digits(claimed))),
    }
}

/// Enclosures that meet are this narrow.
const MAX_AGREEING: usize = 100;

/// The enclosure of a quantity at a valence, where there is one.
fn exactly_found(
    analysis: &Analysis,
    quantity: &Quantity,
    orbit_of: &dyn Fn(&str) -> Option<(i32, i32)>,
) -> Option<Value> {
    let exact = analysis.exact.as_ref().ok()?;
    let real = |index: usize| {
        let e = &exact.eigenvalues[index];
        (e.is_real() && e.algebraic.is_some()).then(|| e.re.clone())
    };
    match quantity {
        Quantity::Subdominant => real(exact.subdominant?),
        Quantity::Cup => real(exact.largest_within(0, &analysis.classical.orbits)?),
        Quantity::Saddle if analysis.valence >= 4 => real(exact.largest_within(2, &analysis.classical.orbits)?),
        Quantity::Limit(position) => {
            let mask = exact.limit_mask.as_ref()?;
            if position == "centre" {
                return Some(mask.centre.as_ref()?.value.clone());
            }
            let orbit = orbit_of(position)?;
            let index = exact.orbits.iter().position(|own| *own == orbit)?;
            Some(mask.orbits[index].0.value.clone())
        }
        _ => None,
    }
}

fn property(made: &[(&Analysis, &Vec<Verdict>)], quantity: &Quantity) -> (Outcome, String) {
    let wanted = match quantity {
        Quantity::C1 => true,
        Quantity::NotC1 => false,
        _ => return (Outcome::Undecided, "this property is not decided yet".to_string()),
    };
    let found: Vec<(usize, Decision, Evidence)> = made.iter().map(|(a, own)| c1(a.valence, own)).collect();
    let (says, denies) = if wanted {
        ((Decision::Proved, Evidence::For), (Decision::Refuted, Evidence::Against))
    } else {
        ((Decision::Refuted, Evidence::Against), (Decision::Proved, Evidence::For))
    };
    let valence =
        |test: &dyn Fn(&(usize, Decision, Evidence)) -> bool| found.iter().find(|own| test(own)).map(|own| own.0);
    if found.iter().all(|own| own.1 == says.0) {
        return (Outcome::Agrees, format!("{} at every valence", says.0.word()));
    }
    if let Some(n) = valence(&|own| own.1 == denies.0) {
        return (Outcome::Disagrees, format!("{} at n = {n}", denies.0.word()));
    }
    if let Some(n) = valence(&|own| own.2 == denies.1) {
        return (Outcome::Disagrees, format!("evidence against it at n = {n}"));
    }
    match valence(&|own| own.1 != says.0 && own.2 != says.1) {
        Some(n) => (Outcome::Undecided, format!("not seen either way at n = {n}")),
        None => (Outcome::Undecided, format!("evidence for it at every valence; not {}", says.0.word())),
    }
}

/// What is decided, and what is seen, of C1 at a valence.
fn c1(n: usize, verdicts: &[Verdict]) -> (usize, Decision, Evidence) {
    let of_c1 = verdicts.iter().find(|verdict| verdict.claim == super::C1);
    of_c1.map_or((n, Decision::Undecided, Evidence::None), |own| (n, own.verdict, own.evidence))
}

/// The value of a quantity at a valence, where it is known to rounding: an eigenvalue of a cluster is not.
fn found(analysis: &Analysis, quantity: &Quantity, orbit_of: &dyn Fn(&str) -> Option<(i32, i32)>) -> Option<f64> {
    let sharp = |e: Eigenvalue| if e.approx_error <= NEAR { e.real() } else { None };
    match quantity {
        Quantity::Subdominant => sharp(analysis.spectrum.subdominant()?),
        Quantity::Cup => sharp(analysis.classical.cup?),
        Quantity::Saddle => sharp(analysis.classical.saddle?),
        Quantity::CurvatureRatio => {
            let (lambda, mu) = (analysis.lambda?.value.re, analysis.spectrum.after_subdominant().next()?);
            (mu.approx_error <= NEAR).then_some(mu.modulus() / (lambda * lambda))
        }
        Quantity::Limit(position) => {
            let mask = analysis.limit_mask.as_ref()?;
            if position == "centre" {
                return mask.centre;
            }
            let orbit = orbit_of(position)?;
            Some(mask.amplitudes[analysis.local.orbits.iter().position(|own| *own == orbit)?].re)
        }
        Quantity::C1 | Quantity::NotC1 | Quantity::C2 => None,
    }
}
