//! The report as a summary that fits a screen.

use super::model::{Report, ValenceReport};
use super::tables::verdict_word;
use crate::verdicts::{CurvatureClass, Outcome};
use std::fmt::Write;

/// The most valences that the summary lists.
const MOST_ROWS: usize = 14;

/// The summary.
pub fn terminal(report: &Report) -> String {
    let class = &report.classification;
    let kind = if class.interpolating { "interpolating" } else { "approximating" };
    let mut text = format!(
        "{} · {}, split {}, {kind}, regular at n = {}\n\n",
        report.title, class.mesh, class.split, class.regular_valence
    );
    let _ = writeln!(
        text,
        "{:>6} {:>6} {:>13} {:>10} {:>9} {:>10} {:>10} {:>9}",
        "n", "points", "lambda", "|mu|/l^2", "cup/l^2", "saddle/l^2", "curvature", "C1"
    );
    let skipped = report.valences.len().saturating_sub(MOST_ROWS);
    let head = if skipped == 0 { report.valences.len() } else { MOST_ROWS - 2 };
    for valence in &report.valences[..head] {
        text.push_str(&row(valence));
    }
    if skipped > 0 {
        let _ = writeln!(text, "{:>6} ({} more valences in the files)", "...", report.valences.len() - head - 1);
        text.push_str(&row(&report.valences[report.valences.len() - 1]));
    }
    let affine = report.valences.first().and_then(|v| v.verdicts.first()).map_or("-", verdict_word);
    let _ = write!(
        text,
        "\nl is lambda, mu the next eigenvalue over the full neighbourhood. Weights sum to 1: {affine}. All else is\n\
         approximate (f64): 'seems so' and 'seems not' are evidence, not proof.\n"
    );
    for claim in report.claims.iter().filter(|claim| claim.outcome != Outcome::Agrees) {
        let _ = writeln!(
            text,
            "claim '{}' {}: {}",
            claim.what,
            if claim.outcome == Outcome::Disagrees { "DISAGREES" } else { "undecided" },
            claim.seen
        );
    }
    let agreeing = report.claims.iter().filter(|claim| claim.outcome == Outcome::Agrees).count();
    if agreeing > 0 {
        let _ =
            writeln!(text, "{agreeing} of {} claims of the scheme file agree with this analysis.", report.claims.len());
    }
    text
}

fn row(v: &ValenceReport) -> String {
    let short = |value: Option<f64>| value.map_or("-".to_string(), |value| format!("{value:.6}"));
    let mu = v.subsubdominant.as_ref();
    let curvature = mu.and_then(|mu| mu.class).map(CurvatureClass::words);
    let c1 = v.verdicts.iter().find(|verdict| verdict.claim == "C1").map_or("-", verdict_word);
    let lambda = v.subdominant.as_ref().map_or("-".to_string(), |e| {
        if e.value[1] == 0.0 { format!("{:.10}", e.value[0]) } else { format!("{:.4}{:+.4}i", e.value[0], e.value[1]) }
    });
    format!(
        "{:>6} {:>6} {:>13} {:>10} {:>9} {:>10} {:>10} {:>9}\n",
        v.n,
        v.size,
        lambda,
        short(mu.and_then(|mu| mu.ratio)),
        short(v.curvature.cup.as_ref().and_then(|e| e.ratio)),
        short(v.curvature.saddle.as_ref().and_then(|e| e.ratio)),
        curvature.unwrap_or("-"),
        c1
    )
}
