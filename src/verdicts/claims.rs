//! Does the analysis agree with what the literature says?

use super::{Evidence, Verdict, bound};
use crate::analysis::Analysis;
use crate::fault::Fault;
use crate::scheme::{Claim, Place, Quantity, Scheme};
use serde::{Deserialize, Serialize};

/// Approximate values that differ by less are said to agree.
const AGREE: f64 = 1e-12;

/// What became of a claim. None of it is a proof: the values compared are approximate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// The values agree to rounding, or the evidence speaks for it, at every valence where it is made.
    Agrees,
    /// At some valence they differ, or the evidence speaks against it.
    Disagrees,
    /// It can't be told, or is made for none of these valences.
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
                pairs.push((found(analysis, &claim.quantity, orbit_of), scheme.book.evaluate(equals, &place)?));
            }
            compare(&pairs)
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

fn compare(pairs: &[(Option<f64>, f64)]) -> (Outcome, String) {
    let differences: Option<Vec<f64>> =
        pairs.iter().map(|(found, claimed)| Some((found.as_ref()? - claimed).abs())).collect();
    let Some(differences) = differences else {
        return (Outcome::Undecided, "the analysis has no such value at some valence".to_string());
    };
    let worst = differences.iter().copied().fold(0.0, f64::max);
    let outcome = if worst <= AGREE { Outcome::Agrees } else { Outcome::Disagrees };
    (outcome, format!("differs by {} (approximate)", bound(worst)))
}

fn property(made: &[(&Analysis, &Vec<Verdict>)], quantity: &Quantity) -> (Outcome, String) {
    if *quantity != Quantity::C1 {
        return (Outcome::Undecided, "this property is not decided yet".to_string());
    }
    let verdicts: Vec<Evidence> =
        made.iter().flat_map(|(_, verdicts)| verdicts.iter().find(|v| v.claim == "C1")).map(|v| v.evidence).collect();
    if verdicts.contains(&Evidence::Against) {
        (Outcome::Disagrees, "evidence against it at some valence".to_string())
    } else if verdicts.iter().all(|evidence| *evidence == Evidence::For) {
        (Outcome::Agrees, "evidence for it at every valence; not proved".to_string())
    } else {
        (Outcome::Undecided, "not seen either way".to_string())
    }
}

/// The value of a quantity at a valence.
fn found(analysis: &Analysis, quantity: &Quantity, orbit_of: &dyn Fn(&str) -> Option<(i32, i32)>) -> Option<f64> {
    match quantity {
        Quantity::Subdominant => analysis.spectrum.subdominant()?.real(),
        Quantity::Cup => analysis.classical.cup?.real(),
        Quantity::Saddle => analysis.classical.saddle?.real(),
        Quantity::CurvatureRatio => {
            let lambda = analysis.lambda?.value.re;
            Some(analysis.spectrum.after_subdominant().next()?.modulus() / (lambda * lambda))
        }
        Quantity::Limit(position) => {
            let mask = analysis.limit_mask.as_ref()?;
            if position == "centre" {
                return mask.centre;
            }
            let orbit = orbit_of(position)?;
            Some(mask.amplitudes[analysis.local.orbits.iter().position(|own| *own == orbit)?].re)
        }
        Quantity::C1 | Quantity::C2 => None,
    }
}
