//! Does what is found of a curve agree with what the literature says?
//!
//! Degrees are exact; continuity and the Hoelder exponent are decided by certified bounds, or not at all.

use super::{ClaimCheck, Outcome};
use crate::fault::Fault;
use crate::scheme::Place;
use crate::scheme::curve::{CurveClaim, CurveQuantity, CurveScheme};

/// What is known of a scheme for curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurveFacts {
    /// The largest degree of polynomials that are made, if the scheme converges.
    pub generation: Option<usize>,
    /// The largest degree of polynomials that come back from their samples.
    pub reproduction: Option<usize>,
    /// The largest k for which C^k is proved; -1 where not even C^0 is.
    pub proved: Option<i64>,
    /// The least k for which C^k is refuted.
    pub refuted: Option<i64>,
    /// A lower and an upper bound of the Hoelder exponent, both certified, the upper one infinite where there is none.
    pub hoelder: Option<[f64; 2]>,
}

/// Rational values are compared exactly by then; this is the rounding of the claimed formula.
const ROUNDING: f64 = 1e-12;

/// Compares every claim of a scheme that is made for the values of its parameters.
///
/// # Errors
/// When a claimed value can't be computed.
pub fn check_curve_claims(scheme: &CurveScheme, facts: &CurveFacts) -> Result<Vec<ClaimCheck>, Fault> {
    scheme.claims.iter().map(|claim| check(scheme, claim, facts)).collect()
}

fn check(scheme: &CurveScheme, claim: &CurveClaim, facts: &CurveFacts) -> Result<ClaimCheck, Fault> {
    let made = scheme.claim_is_made(claim)?;
    let claimed = |scheme: &CurveScheme| {
        let value = claim.equals.as_ref().map(|equals| scheme.book.evaluate::<f64>(equals, &Place::at(None, 0)));
        value.transpose()
    };
    let (outcome, seen) = if made {
        compared(claim, claimed(scheme)?, facts)
    } else {
        (Outcome::Undecided, "not made for these values of the parameters".to_string())
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

fn compared(claim: &CurveClaim, claimed: Option<f64>, facts: &CurveFacts) -> (Outcome, String) {
    let unknown = || (Outcome::Undecided, "not known here".to_string());
    let agrees = |agrees: bool| if agrees { Outcome::Agrees } else { Outcome::Disagrees };
    let degree = |found: Option<usize>| match (found, claimed) {
        (Some(found), Some(claimed)) => {
            (agrees((found as f64 - claimed).abs() < ROUNDING), format!("{found}, exactly"))
        }
        _ => unknown(),
    };
    match &claim.quantity {
        CurveQuantity::Generation => degree(facts.generation),
        CurveQuantity::Reproduction => degree(facts.reproduction),
        CurveQuantity::Continuity(k) => {
            let k = i64::from(*k);
            match (facts.proved, facts.refuted) {
                (Some(proved), _) if proved >= k => (Outcome::Agrees, format!("C{proved} is proved")),
                (_, Some(refuted)) if refuted <= k => (Outcome::Disagrees, format!("C{refuted} is refuted")),
                _ => unknown(),
            }
        }
        CurveQuantity::Order => match (facts.proved, facts.refuted, claimed) {
            (Some(proved), Some(refuted), Some(claimed)) if refuted == proved + 1 => {
                (agrees((proved as f64 - claimed).abs() < ROUNDING), format!("C{proved} is proved, C{refuted} refuted"))
            }
            (Some(proved), None, Some(claimed)) if proved as f64 > claimed + ROUNDING => {
                (Outcome::Disagrees, format!("C{proved} is proved"))
            }
            (Some(proved), ..) => (Outcome::Undecided, format!("C{proved} is proved, and not refuted beyond")),
            _ => unknown(),
        },
        CurveQuantity::Hoelder => match (facts.hoelder, claimed, &claim.equals) {
            (Some([low, high]), Some(claimed), Some(equals)) => {
                let off = super::claims::tolerance(equals.formula.text());
                let seen = format!("between {low:.9} and {high:.9}");
                if claimed < low - off || claimed > high + off {
                    (Outcome::Disagrees, seen)
                } else if high - low <= 2.0 * off.max(1e-9) {
                    (Outcome::Agrees, seen)
                } else {
                    (Outcome::Undecided, seen)
                }
            }
            _ => unknown(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::catalogue;

    fn outcomes(id: &str, facts: &CurveFacts) -> Vec<(String, Outcome)> {
        let scheme = catalogue::curve(id).unwrap().unwrap();
        check_curve_claims(&scheme, facts).unwrap().into_iter().map(|check| (check.what, check.outcome)).collect()
    }

    #[test]
    fn claims_agree_disagree_or_stay_open() {
        let chaikin = CurveFacts {
            generation: Some(2),
            reproduction: Some(1),
            proved: Some(1),
            refuted: Some(2),
            hoelder: Some([2.0, 2.0]),
        };
        assert!(outcomes("chaikin", &chaikin).iter().all(|(_, outcome)| *outcome == Outcome::Agrees));
        assert!(outcomes("chaikin", &CurveFacts::default()).iter().all(|(_, outcome)| *outcome == Outcome::Undecided));
        let wrong = CurveFacts {
            generation: Some(1),
            reproduction: Some(3),
            proved: Some(0),
            refuted: Some(1),
            hoelder: Some([1.5, 1.9]),
        };
        assert!(outcomes("chaikin", &wrong).iter().all(|(_, outcome)| *outcome == Outcome::Disagrees));
        let wide = CurveFacts { hoelder: Some([1.9, 2.1]), ..CurveFacts::default() };
        assert!(outcomes("chaikin", &wide).iter().all(|(_, outcome)| *outcome == Outcome::Undecided));
    }
}
