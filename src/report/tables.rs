//! Which tables belong to a report?
//!
//! Plain rows of words, in the order of a paper; Markdown and LaTeX print them.

use super::model::{EigenvalueReport, Report, ValenceReport};
use crate::verdicts::{CurvatureClass, Decision, Evidence, Outcome, Verdict, digits};

/// Frequencies from this one on are left out of tables that have a column for each; the JSON and CSV forms have all.
const MOST_FREQUENCIES: usize = 7;

/// A table with its title.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// What it shows.
    pub title: String,
    /// How it is to be read, in a sentence or two.
    pub note: String,
    /// The head of each column.
    pub head: Vec<String>,
    /// The rows, each as long as the head.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    fn new(title: &str, note: &str, head: Vec<String>, rows: Vec<Vec<String>>) -> Table {
        Table { title: title.to_string(), note: note.to_string(), head, rows }
    }
}

/// Every table of a report.
pub fn tables(report: &Report) -> Vec<Table> {
    let mut tables = vec![
        weights(report),
        overview(report),
        by_frequency(report),
        all_eigenvalues(report),
        limit_masks(report),
        tangent_masks(report),
        conditions(report),
    ];
    if !report.claims.is_empty() {
        tables.push(claims(report));
    }
    tables.retain(|table| !table.rows.is_empty());
    tables
}

fn words(list: &[&str]) -> Vec<String> {
    list.iter().map(|word| (*word).to_string()).collect()
}

fn or_dash(value: Option<f64>) -> String {
    value.map_or("-".to_string(), digits)
}

fn weights(report: &Report) -> Table {
    let longest = report.valences.iter().map(|v| &v.rule_weights).max_by_key(|weights| weights.len());
    let mut names: Vec<String> =
        longest.into_iter().flatten().map(|(name, _)| name.clone()).take(MOST_FREQUENCIES).collect();
    for (name, _) in report.valences.iter().flat_map(|v| &v.rule_weights) {
        if !names.contains(name) && names.len() < MOST_FREQUENCIES {
            names.push(name.clone());
        }
    }
    let weight = |v: &ValenceReport, name: &String| v.rule_weights.iter().find(|(own, _)| own == name).map(|(_, w)| *w);
    let row = |v: &ValenceReport| {
        let cells = names.iter().map(|name| or_dash(weight(v, name)));
        std::iter::once(v.n.to_string()).chain(cells).collect()
    };
    let head = names.iter().map(|name| match name.as_str() {
        "centre" => "α (centre)".to_string(),
        "ring" => "β (each of the ring)".to_string(),
        name if report.classification.dual => format!("α of {name}"),
        name => format!("each of {name}"),
    });
    let head = std::iter::once("n".to_string()).chain(head).collect();
    let note = if report.classification.dual {
        "The weights that the new point at corner 0 of an n-sided face takes from the old corners; ring[j] and ring[-j] weigh \
         the same."
    } else {
        "The weights of the new extraordinary vertex on old points, after substitution of the points that the same step \
         makes: the centre as a whole, the others each."
    };
    Table::new("Weights at the extraordinary point", note, head, report.valences.iter().map(row).collect())
}

fn overview(report: &Report) -> Table {
    let note = "λ is the largest eigenvalue after 1 and μ the next, over the full neighbourhood of the size given; cup and saddle \
                are Doo and Sabin's eigenvalues, of frequencies 0 and 2 on the smallest invariant neighbourhood.";
    let head = words(&[
        "n",
        "size",
        "λ",
        "of frequency",
        "|μ|",
        "of frequencies",
        "|μ|/λ²",
        "curvature",
        "cup/λ²",
        "saddle/λ²",
    ]);
    let row = |v: &ValenceReport| {
        let mu = v.subsubdominant.as_ref();
        let class = mu.and_then(|mu| mu.class).map(CurvatureClass::words);
        vec![
            v.n.to_string(),
            v.size.to_string(),
            v.subdominant.as_ref().map_or("-".to_string(), |e| complex(e.value)),
            v.subdominant.as_ref().map_or("-".to_string(), |e| e.frequency.to_string()),
            or_dash(mu.map(|mu| mu.modulus)),
            mu.map_or("-".to_string(), |mu| list(&mu.frequencies)),
            or_dash(mu.and_then(|mu| mu.ratio)),
            class.unwrap_or("-").to_string(),
            or_dash(v.curvature.cup.as_ref().and_then(|e| e.ratio)),
            or_dash(v.curvature.saddle.as_ref().and_then(|e| e.ratio)),
        ]
    };
    Table::new("Subdominant eigenvalues and curvature", note, head, report.valences.iter().map(row).collect())
}

fn list(numbers: &[usize]) -> String {
    let shown: Vec<String> = numbers.iter().take(4).map(usize::to_string).collect();
    format!("{}{}", shown.join(", "), if numbers.len() > 4 { ", ..." } else { "" })
}

fn complex([re, im]: [f64; 2]) -> String {
    if im == 0.0 {
        digits(re)
    } else {
        format!("{} {} {}i", digits(re), if im < 0.0 { "-" } else { "+" }, digits(im.abs()))
    }
}

fn by_frequency(report: &Report) -> Table {
    let most = report.valences.iter().map(|v| v.n / 2 + 1).max().unwrap_or(0).min(MOST_FREQUENCIES);
    let largest = |v: &ValenceReport, k: usize| v.largest.get(k).copied().flatten().map(complex);
    let row = |v: &ValenceReport| {
        let cells = (0..most).map(|k| largest(v, k).unwrap_or("-".to_string()));
        std::iter::once(v.n.to_string()).chain(cells).collect()
    };
    let head = std::iter::once("n".to_string()).chain((0..most).map(|k| format!("k = {k}"))).collect();
    let note = "The largest eigenvalue of each frequency k, the 1 of the constants left out; n-k has the same as k.";
    Table::new("Largest eigenvalue by frequency", note, head, report.valences.iter().map(row).collect())
}

fn all_eigenvalues(report: &Report) -> Table {
    let rows = report.valences.iter().flat_map(|v| {
        (0..=v.n / 2).take(MOST_FREQUENCIES).map(|k| {
            let own: Vec<String> =
                v.eigenvalues.iter().filter(|e| e.frequency == k).map(|e| eigenvalue(e, v.n)).collect();
            vec![v.n.to_string(), k.to_string(), own.join(", ")]
        })
    });
    let note = "Block by block, largest modulus first. A value marked (m times) stands for m approximately equal ones, whose \
                Jordan structure floating numbers don't decide.";
    Table::new("Eigenvalues of the blocks", note, words(&["n", "k", "eigenvalues of block k"]), rows.collect())
}

fn eigenvalue(e: &EigenvalueReport, n: usize) -> String {
    let blocks = if e.frequency == 0 || 2 * e.frequency == n { 1 } else { 2 };
    let times = e.algebraic / blocks;
    if times > 1 { format!("{} ({times} times)", complex(e.value)) } else { complex(e.value) }
}

fn limit_masks(report: &Report) -> Table {
    let first = report.valences.iter().find(|v| v.limit_mask.is_some());
    let names: Vec<String> = first
        .into_iter()
        .flat_map(|v| &v.amplitudes)
        .map(|a| a.at.clone())
        .filter(|name| report.valences.iter().any(|v| limit_of(v, name).is_some_and(|weight| weight != 0.0)))
        .collect();
    let centre = |v: &ValenceReport| {
        let mask = v.limit_mask.as_ref()?;
        mask.iter().find(|weight| weight.at == "centre").map(|weight| weight.weight)
    };
    let has_centre = report.valences.iter().any(|v| centre(v).is_some());
    let row = |v: &ValenceReport| {
        let own = has_centre.then(|| or_dash(centre(v)));
        let cells = names.iter().map(|name| or_dash(limit_of(v, name)));
        std::iter::once(v.n.to_string()).chain(own).chain(cells).collect()
    };
    let own = has_centre.then(|| "centre".to_string());
    let head =
        std::iter::once("n".to_string()).chain(own).chain(names.iter().map(|name| format!("each of {name}"))).collect();
    let note = format!(
        "The left vector of the eigenvalue 1: applied to {} at any level of refinement, it gives the limit of the \
         extraordinary point. The weights sum to 1.",
        applied_to(has_centre, &names)
    );
    Table::new("Limit masks", &note, head, report.valences.iter().map(row).collect())
}

fn applied_to(has_centre: bool, names: &[String]) -> String {
    let own = has_centre.then(|| "the extraordinary vertex".to_string());
    let rings = names.iter().map(|name| match name.as_str() {
        "ring" if has_centre => "its n edge neighbours (ring)".to_string(),
        "ring" => "the n corners of the extraordinary face (ring)".to_string(),
        "diagonals" => "the n vertices across its quads (diagonals)".to_string(),
        name => format!("the n points at {name}"),
    });
    own.into_iter().chain(rings).collect::<Vec<_>>().join(" and ")
}

fn limit_of(v: &ValenceReport, name: &str) -> Option<f64> {
    v.amplitudes.iter().find(|a| a.at == name)?.limit
}

fn tangent_masks(report: &Report) -> Table {
    let rows = report.valences.iter().flat_map(|v| {
        v.amplitudes.iter().filter_map(|a| {
            let (r, phase) = a.tangent.filter(|(r, _)| *r > 1e-12)?;
            let shift = match phase {
                phase if phase.abs() < 5e-11 => "s".to_string(),
                phase if phase < 0.0 => format!("s - {:.4}", -phase),
                phase => format!("s + {phase:.4}"),
            };
            Some(vec![v.n.to_string(), a.at.clone(), digits(r), shift])
        })
    });
    let note = "Left vectors of λ in frequencies 1 and n-1. In sector s the cosine form has the weight r cos(2π x/n) and the sine \
                form r sin(2π x/n). Applied to the points at any level they give two vectors that span the tangent plane; cosine x \
                sine is the outward normal.";
    Table::new("Tangent masks", note, words(&["n", "points", "r", "x"]), rows.collect())
}

fn conditions(report: &Report) -> Table {
    let names: Vec<String> =
        report.valences.first().into_iter().flat_map(|v| &v.verdicts).map(|verdict| verdict.claim.clone()).collect();
    let cell = |v: &ValenceReport, name: &String| v.verdicts.iter().find(|own| own.claim == *name).map(verdict_word);
    let row = |v: &ValenceReport| {
        let cells = names.iter().map(|name| cell(v, name).unwrap_or("-").to_string());
        std::iter::once(v.n.to_string()).chain(cells).collect()
    };
    let note = "proved and refuted rest on exact or enclosed values. Everything else is undecided; 'seems so' and 'seems not' say \
                which way floating numbers point, 'open' that they don't.";
    let head = std::iter::once("n".to_string()).chain(names.iter().cloned()).collect();
    Table::new("Conditions", note, head, report.valences.iter().map(row).collect())
}

/// A verdict in a word or two.
pub fn verdict_word(verdict: &Verdict) -> &'static str {
    match (verdict.verdict, verdict.evidence) {
        (Decision::Proved, _) => "proved",
        (Decision::Refuted, _) => "refuted",
        (Decision::Undecided, Evidence::For) => "seems so",
        (Decision::Undecided, Evidence::Against) => "seems not",
        (Decision::Undecided, Evidence::None) => "open",
    }
}

fn claims(report: &Report) -> Table {
    let rows = report.claims.iter().map(|claim| {
        let value = claim.equals.clone().unwrap_or("-".to_string());
        let outcome = match claim.outcome {
            Outcome::Agrees => "agrees",
            Outcome::Disagrees => "DISAGREES",
            Outcome::Undecided => "undecided",
        };
        let condition = claim.condition.clone().unwrap_or("all n".to_string());
        let source = if claim.source.is_empty() { "-".to_string() } else { claim.source.join(", ") };
        vec![claim.what.clone(), value, condition, source, outcome.to_string(), claim.seen.clone()]
    });
    let head = words(&["claim", "value", "where", "source", "outcome", "seen"]);
    Table::new("What the literature says", "The claims of the scheme file beside this analysis.", head, rows.collect())
}
