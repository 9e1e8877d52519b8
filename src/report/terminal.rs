//! The report as a summary that fits a screen.

use super::model::{Report, ValenceReport};
use super::tables::verdict_word;
use crate::verdicts::{CurvatureClass, Decision, Outcome};
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
        "{:>6} {:>6} {:>13} {:>10} {:>9} {:>10} {:>14} {:>9}",
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
    let _ = writeln!(
        text,
        "\nl is lambda, mu the next eigenvalue over the full neighbourhood. Weights sum to 1: {affine}."
    );
    text.push_str(&known(report));
    let _ = writeln!(text, "C1 for generic control points: {}.", report.c1.statement);
    text.push_str(&formulas(report));
    text.push_str(&report.regular.as_ref().map_or(String::new(), super::regular::terminal));
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

/// Decimals beyond these don't fit the summary.
const MOST_DIGITS: usize = 13;

/// How the numbers are known.
fn known(report: &Report) -> String {
    let of = |kind: &str| report.valences.iter().filter(|v| v.arithmetic == kind).count();
    let (exact, enclosed, rest) = (of("exact"), of("enclosed"), of("approximate"));
    let what = match (exact, enclosed, rest) {
        (_, 0, 0) => "Eigenvalues, their order and curvature are exact".to_string(),
        (0, 0, _) => "All else is approximate (f64)".to_string(),
        _ => format!(
            "Eigenvalues are exact at {exact} of the valences, enclosed at {enclosed}, approximate (f64) at {rest}"
        ),
    };
    let open = |v: &ValenceReport| v.verdicts.iter().any(|own| own.claim == "C1" && own.verdict == Decision::Undecided);
    if !report.valences.iter().any(open) {
        return format!("{what}.\n");
    }
    format!("{what}; 'seems so' and 'seems not' are evidence, not proof.\n")
}

/// What holds for every n, in two lines.
fn formulas(report: &Report) -> String {
    let Some(all) = &report.all_valences else {
        return report
            .why_no_formulas
            .as_ref()
            .map_or(String::new(), |why| format!("No closed forms for all n: {why}.\n"));
    };
    let mut text = String::new();
    let told = |v: &&ValenceReport| v.n >= all.from && all.except != Some(v.n);
    if let Some(lambda) = &all.subdominant {
        let same = |v: &ValenceReport| {
            v.subdominant.as_ref().is_some_and(|e| e.quantity.formula.as_ref() == Some(&lambda.formula))
        };
        if report.valences.iter().filter(told).all(same) {
            let except = all.except.map_or(String::new(), |n| format!(" but {n}"));
            let _ = writeln!(
                text,
                "lambda = {} at these n >= {}{except}, and an eigenvalue for every such n.",
                lambda.formula, all.from
            );
        }
    }
    for identity in all.identities.iter().filter(|identity| identity.holds) {
        let _ = writeln!(text, "{}: {}", identity.claim, identity.states);
    }
    text
}

fn row(v: &ValenceReport) -> String {
    let short = |value: Option<f64>| value.map_or("-".to_string(), |value| format!("{value:.6}"));
    let mu = v.subsubdominant.as_ref();
    let curvature = mu.and_then(|mu| mu.class).map(CurvatureClass::words);
    let c1 = v.verdicts.iter().find(|verdict| verdict.claim == "C1").map_or("-", verdict_word);
    let lambda = v.subdominant.as_ref().map_or("-".to_string(), |e| {
        let [re, im] = e.quantity.value;
        match &e.quantity.decimal {
            Some(decimal) if im == 0.0 => decimal.chars().take(MOST_DIGITS).collect(),
            _ if im == 0.0 => format!("{re:.10}"),
            _ => format!("{re:.4}{im:+.4}i"),
        }
    });
    format!(
        "{:>6} {:>6} {:>13} {:>10} {:>9} {:>10} {:>14} {:>9}\n",
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
