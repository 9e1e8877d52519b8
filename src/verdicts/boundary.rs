//! Is the surface C1 up to the boundary at a vertex there?
//!
//! Two eigenvectors carry the tangents (see [`crate::analysis::boundary::masks`]). No theorem for a half-disc is used here, so nothing is
//! proved: what was seen is evidence. Against it speak modes that vanish along the crease and are larger than the crease's own eigenvalue;
//! where exact numbers show them, the reason says so, and which step of the argument is not checked by the program.

use super::{Decision, Evidence, Verdict, digits};
use crate::analysis::boundary::BoundaryAnalysis;
use crate::analysis::boundary::exact::ExactHalves;
use crate::mesh::FanKind;

const STATES: &str = "limit surfaces are C1 up to the crease or boundary at this vertex, for generic control points";

const NO_THEOREM: &str = "not proved: a theorem for the sector is missing (the characteristic map regular and injective on it, and the \
    crease mapped to the crease); its control net was looked at in f64";

const NO_INDEPENDENCE: &str = "not refuted: that the limit functions of these modes do not vanish is not shown; it follows where the \
    translates of the regular part's basis function are linearly independent";

/// The verdict at a vertex; exact numbers say how sure its reasons are.
pub fn c1_up_to_boundary(analysis: &BoundaryAnalysis, exact: Option<&ExactHalves>) -> Verdict {
    let (value, evidence, why) = match (&analysis.tangent_masks, exact.and_then(|exact| lost(analysis, exact))) {
        (Ok(tangents), _) => {
            let [a, b] = tangents.eigenvalues.map(|e| digits(e.modulus()));
            (format!("tangents at {a} and {b}"), Evidence::For, vec![NO_THEOREM.to_string()])
        }
        (Err(_), Some(reason)) => {
            ("no tangent plane".to_string(), Evidence::Against, vec![reason, NO_INDEPENDENCE.to_string()])
        }
        (Err(why), None) if why.starts_with("no tangent plane:") => {
            ("no tangent plane".to_string(), Evidence::Against, vec![format!("{why}; approximate (f64)")])
        }
        (Err(why), None) => ("not seen".to_string(), Evidence::None, vec![why.clone()]),
    };
    Verdict {
        claim: "C1 up to the boundary".to_string(),
        states: STATES.to_string(),
        value,
        verdict: Decision::Undecided,
        evidence,
        why,
        source: vec![],
    }
}

/// How exact numbers show that sine modes are larger than the crease's own eigenvalue.
fn lost(analysis: &BoundaryAnalysis, exact: &ExactHalves) -> Option<String> {
    let needed = match analysis.fan.kind() {
        FanKind::Crease { .. } => 2,
        FanKind::Corner { .. } => 1,
        FanKind::Dart { .. } => return None,
    };
    let modes = (1..=needed).map(|level| {
        let mut here = exact.eigenvalues.iter().enumerate().filter(|(_, e)| e.level == level);
        let (index, e) = here.next().filter(|_| here.next().is_none())?;
        let alone = e.algebraic == Some(1) && exact.certain.get(level) == Some(&true);
        let mode = exact.sine_of(index).filter(|_| alone && e.re.sign() == Some(std::cmp::Ordering::Greater))?;
        Some(format!("sine mode {} at {}", mode.number, digits(e.re.midpoint_f64())))
    });
    let modes = modes.collect::<Option<Vec<String>>>()?;
    (exact.certain.get(needed + 1) == Some(&true)).then(|| {
        let own =
            if needed == 2 { "all others, the boundary's own among them" } else { "those of the two boundary edges" };
        format!("{}: simple, and larger than {own}, in exact arithmetic", modes.join(" and "))
    })
}
