//! The report of a curve as a summary that fits a screen.

use super::model::{CurvePointReport, CurveReport};
use super::range::RangeReport;
use super::tables::{short_words, value_cell};
use crate::verdicts::Outcome;
use std::fmt::Write;

/// Eigenvalues shown at a point.
const MOST: usize = 6;

pub(super) fn terminal(report: &CurveReport) -> String {
    let class = &report.classification;
    let kind = if class.interpolating { "interpolating" } else { "approximating" };
    let primal = match class.primal {
        Some(true) => ", primal",
        Some(false) => ", dual",
        None => "",
    };
    let values: Vec<String> = report.parameters.iter().map(|(name, value)| format!(", {name} = {value}")).collect();
    let mut text = format!("{} · curve, arity {}, {kind}{primal}{}\n\n", report.title, report.arity, values.concat());
    if let (Some(mask), Some(first)) = (&report.mask, report.first_index) {
        let words = mask.join(", ");
        let shown = if words.len() <= 120 { format!("({words})") } else { format!("of {} weights", mask.len()) };
        let _ = writeln!(text, "mask {shown} from index {first}");
        let rules = report.sum_rules.unwrap_or(0);
        let factor = if report.arity == 2 { "1 + z" } else { "1 + z + ..." };
        let _ = writeln!(text, "{rules} factor{} {factor} of the symbol", if rules == 1 { "" } else { "s" });
    }
    if let Some(own) = &report.smoothness {
        let _ = writeln!(text, "{}; Hoelder exponent {}", own.continuity_words(), own.hoelder_words());
    }
    if let Some(why) = &report.why_no_smoothness {
        let _ = writeln!(text, "no smoothness is known: {why}");
    }
    if let (Some(made), Some(back)) = (report.generation_degree, report.reproduction_degree) {
        let _ = writeln!(text, "polynomials are made up to degree {made} and reproduced up to degree {back}");
    }
    text.push_str(&report.range.as_ref().map_or(String::new(), RangeReport::terminal));
    for point in &report.points {
        text.push_str(&at_point(point));
    }
    if let Some(own) = &report.convergence {
        let factors: Vec<String> =
            own.factors.iter().map(|factor| factor.map_or("-".to_string(), |f| format!("{f:.2}"))).collect();
        let _ = writeln!(
            text,
            "\nfrom the polygon to the curve: {} times less a step, level by level (measured)",
            factors.join(", ")
        );
    }
    for claim in report.claims.iter().filter(|claim| claim.outcome == Outcome::Disagrees) {
        let _ = writeln!(text, "claim '{}' DISAGREES: {}", claim.what, claim.seen);
    }
    let agreeing = report.claims.iter().filter(|claim| claim.outcome == Outcome::Agrees).count();
    if agreeing > 0 {
        let _ =
            writeln!(text, "{agreeing} of {} claims of the scheme file agree with this analysis.", report.claims.len());
    }
    text.push_str("\nMatrices, eigenvalues and masks are exact.\n");
    text
}

fn at_point(point: &CurvePointReport) -> String {
    let local = &point.minimal;
    let shown: Vec<String> = local
        .eigenvalues
        .iter()
        .take(MOST)
        .map(|e| {
            let jordan = if e.jordan > 1 { format!(", Jordan block {}", e.jordan) } else { String::new() };
            let times = if e.algebraic > 1 { format!(" ({}-fold{jordan})", e.algebraic) } else { String::new() };
            format!("{}{times}", value_cell(e).text)
        })
        .collect();
    let more = if local.eigenvalues.len() > MOST { ", ..." } else { "" };
    let before = if point.steps_before > 0 { ", after a step" } else { "" };
    let mut text = format!("\n{} · {} points, full neighbourhood {}{before}\n", point.at, local.size, point.full.size);
    let _ = writeln!(text, "  eigenvalues  {}{more}", shown.join(", "));
    for (name, mask, why) in
        [("limit", &point.limit_mask, &point.why_no_limit), ("tangent", &point.tangent_mask, &point.why_no_tangent)]
    {
        let words = match (mask, why) {
            (Some(mask), _) => short_words(mask),
            (None, why) => format!("none: {}", why.as_deref().unwrap_or("-")),
        };
        let _ = writeln!(text, "  {name:<11}  {words}");
    }
    text
}
