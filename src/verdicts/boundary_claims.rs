//! Does the analysis at a boundary agree with what the literature says of a boundary file?

use super::{ClaimCheck, Evidence, Outcome, Verdict, digits};
use crate::analysis::boundary::BoundaryAnalysis;
use crate::analysis::spectrum::{Eigenvalue, NEAR};
use crate::fault::Fault;
use crate::scheme::{BoundaryClaim, BoundaryQuantity, Place, RuleBook};

/// Values that differ by less are said to agree.
const AGREE: f64 = 1e-12;

/// The claims that a boundary file makes for this vertex, each compared with what was found; approximate. `c1` is the vertex's verdict.
///
/// # Errors
/// When a claimed value or a condition can't be computed.
pub fn check_boundary_claims(
    book: &RuleBook,
    analysis: &BoundaryAnalysis,
    c1: &Verdict,
) -> Result<Vec<ClaimCheck>, Fault> {
    let kind = analysis.fan.kind();
    let variable = if kind.is_closed() { "n" } else { "k" };
    let mut checks = Vec::new();
    for claim in book.claims.iter().filter(|claim| claim.at == kind.name()) {
        if !book.is_claimed_at(claim, variable, kind.faces())? {
            continue;
        }
        let place = Place::<f64>::at(Some(variable), kind.faces() as i64);
        let claimed = claim.equals.as_ref().map(|formula| book.evaluate(formula, &place)).transpose()?;
        let (outcome, seen) = match (claimed, found(analysis, claim.quantity)) {
            (None, _) => property(c1),
            (Some(_), None) => (Outcome::Undecided, "the analysis has no such value".to_string()),
            (Some(claimed), Some(found)) if (found - claimed).abs() <= AGREE => {
                (Outcome::Agrees, format!("{}, approximate", digits(found)))
            }
            (Some(claimed), Some(found)) => {
                (Outcome::Disagrees, format!("it is {}, not {}", digits(found), digits(claimed)))
            }
        };
        checks.push(checked(claim, outcome, seen));
    }
    Ok(checks)
}

fn checked(claim: &BoundaryClaim, outcome: Outcome, seen: String) -> ClaimCheck {
    ClaimCheck {
        what: format!("{}: {}", claim.at, claim.what),
        equals: claim.equals.as_ref().map(|placed| placed.formula.text().to_string()),
        condition: claim.condition.as_ref().map(|condition| condition.text().to_string()),
        source: claim.sources.clone(),
        outcome,
        seen,
    }
}

fn property(c1: &Verdict) -> (Outcome, String) {
    match c1.evidence {
        Evidence::Against => (Outcome::Disagrees, "evidence against it".to_string()),
        Evidence::For => (Outcome::Undecided, "evidence for it; not proved".to_string()),
        Evidence::None => (Outcome::Undecided, "not seen either way".to_string()),
    }
}

/// The value of a quantity, where floating numbers know it.
fn found(analysis: &BoundaryAnalysis, quantity: BoundaryQuantity) -> Option<f64> {
    let real = |e: &Eigenvalue| if e.approx_error <= NEAR { e.real() } else { None };
    let mut after_one = analysis.spectrum.after_one();
    match quantity {
        BoundaryQuantity::Subdominant => real(after_one.next()?),
        BoundaryQuantity::Second => real(after_one.nth(1)?),
        BoundaryQuantity::LimitCentre => {
            let mask = analysis.limit_mask.as_ref().ok()?;
            Some(mask.iter().find(|(label, _)| *label == analysis.fan.centre())?.1)
        }
        BoundaryQuantity::C1 => None,
    }
}
