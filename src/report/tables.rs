//! Which tables belong to a report?
//!
//! Plain rows of words, in the order of a paper; Markdown and LaTeX print them.

use super::formulas::{AllValencesReport, Formula};
use super::model::{EigenvalueReport, Quantity, Report, ValenceReport, centre_weight};
use crate::verdicts::{ClaimCheck, CurvatureClass, Decision, Evidence, Outcome, Stretch, Verdict, digits};

/// Frequencies from this one on are left out of tables that have a column for each; the JSON and CSV forms have all.
const MOST_FREQUENCIES: usize = 7;

/// A cell of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell {
    /// As text; formulas as people write them.
    pub text: String,
    /// In LaTeX, where that is not the text.
    pub latex: Option<String>,
}

impl From<String> for Cell {
    fn from(text: String) -> Cell {
        Cell { text, latex: None }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Cell {
        text.to_string().into()
    }
}

impl Cell {
    /// A closed form.
    fn formula(formula: &Formula) -> Cell {
        Cell { text: pretty(&formula.formula), latex: Some(format!("$\\displaystyle {}$", formula.latex)) }
    }

    /// A number with the digits asked for, and its exact form beside it up to a length; `≈` before what is approximate.
    pub(super) fn number(quantity: &Quantity, longest: usize) -> Cell {
        let decimal = quantity.decimal.clone().unwrap_or_else(|| format!("≈ {}", complex(quantity.value)));
        let text = quantity.exact.as_ref().map(|exact| pretty(exact)).filter(|text| text.chars().count() <= longest);
        match (text, &quantity.latex) {
            (Some(text), Some(latex)) if !same(&decimal, &text) => {
                Cell { text: format!("{decimal} = {text}"), latex: Some(format!("${decimal} = {latex}$")) }
            }
            _ => decimal.into(),
        }
    }

    fn optional(quantity: Option<&Quantity>, longest: usize) -> Cell {
        quantity.map_or("-".into(), |quantity| Cell::number(quantity, longest))
    }

    /// Cells in a row, with commas.
    pub(super) fn joined(cells: &[Cell]) -> Cell {
        let texts: Vec<&str> = cells.iter().map(|cell| cell.text.as_str()).collect();
        let latex: Vec<&str> = cells.iter().map(|cell| cell.latex.as_ref().unwrap_or(&cell.text).as_str()).collect();
        Cell { text: texts.join(", "), latex: Some(latex.join(", ")) }
    }
}

/// Whether a decimal is the exact form with zeros.
fn same(decimal: &str, exact: &str) -> bool {
    decimal.trim_end_matches('0').trim_end_matches('.') == exact
}

/// A formula of the scheme language as people write it.
fn pretty(formula: &str) -> String {
    formula.replace("*pi*k", "πk").replace("*pi", "π").replace("pi/", "π/").replace('*', " ")
}

/// Exact forms longer than this stand in the table of all eigenvalues only.
pub(super) const SHORT: usize = 22;

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
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    pub(super) fn new(title: &str, note: &str, head: Vec<String>, rows: Vec<Vec<Cell>>) -> Table {
        Table { title: title.to_string(), note: note.to_string(), head, rows }
    }
}

/// Every table of a report.
pub fn tables(report: &Report) -> Vec<Table> {
    let mut tables = super::regular::tables(report.regular.as_ref(), report.regular_free.as_ref());
    let all: Vec<Table> = report.all_valences.iter().flat_map(|all| [formulas(all), mask_formulas(all)]).collect();
    tables.extend(all);
    tables.extend([
        weights(report),
        overview(report),
        by_frequency(report),
        all_eigenvalues(report),
        limit_masks(report),
        tangent_masks(report),
        conditions(report),
        c1(report),
    ]);
    tables.extend(super::boundary::tables(&report.boundary));
    tables.extend(super::ranges::table(&report.ranges));
    tables.extend(report.sweep.as_ref().map(super::sweep::table));
    if !report.claims.is_empty() {
        tables.push(claims(&report.claims, "all n"));
    }
    tables.retain(|table| !table.rows.is_empty());
    tables
}

fn words(list: &[&str]) -> Vec<String> {
    list.iter().map(|word| (*word).to_string()).collect()
}

/// For which n the forms hold.
fn range(all: &AllValencesReport) -> String {
    let except = all.except.map_or(String::new(), |n| format!(" except n = {n}, where the regular rule applies"));
    format!("n ≥ {}{except}", all.from)
}

fn formulas(all: &AllValencesReport) -> Table {
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for own in &all.frequencies {
        let k = match own.k.as_str() {
            "0" => "0".to_string(),
            "n/2" => "n/2 (n even)".to_string(),
            "other" => "all others".to_string(),
            p => format!("±{p}"),
        };
        for e in &own.eigenvalues {
            let jordan = match (e.algebraic, e.jordan) {
                (1, _) => "-".to_string(),
                (_, Some(1)) => "none".to_string(),
                (_, Some(size)) => format!("size {size}"),
                (_, None) => "not decided".to_string(),
            };
            rows.push(vec![k.clone().into(), Cell::formula(&e.form), e.algebraic.to_string().into(), jordan.into()]);
        }
    }
    let identities: Vec<String> = all
        .identities
        .iter()
        .filter(|own| own.holds)
        .map(|own| format!("{}: {}.", own.claim, pretty(&own.states)))
        .collect();
    let [fixed, per_sector] = all.size;
    let size = if fixed == 0 { format!("{per_sector}n") } else { format!("{fixed} + {per_sector}n") };
    let note = format!(
        "Exact, as identities in n, for {}; the full neighbourhood has {size} points. c = cos(2π/n) and c_k = cos(2πk/n). Jordan blocks \
         are those for general n and k: at a single n two forms may be equal. {}",
        range(all),
        identities.join(" ")
    );
    let head = words(&["k", "eigenvalue", "times in block k", "Jordan block"]);
    Table::new("For every n: eigenvalues", note.trim(), head, rows)
}

fn mask_formulas(all: &AllValencesReport) -> Table {
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for weight in all.limit_mask.iter().flatten() {
        rows.push(vec!["limit".into(), weight.at.as_str().into(), Cell::formula(&weight.form), "-".into()]);
    }
    for weight in all.tangent_forms.iter().flatten() {
        rows.push(vec![
            "tangent".into(),
            weight.at.as_str().into(),
            Cell::formula(&weight.own),
            Cell::formula(&weight.next),
        ]);
    }
    let note = format!(
        "Exact, for {}. The limit mask has the weight a at each point; the tangent masks have a cos(2πs/n) + b cos(2π(s+1)/n) in sector s, \
         and the same with sines. Each was put into u S = λ u in exact arithmetic.",
        range(all)
    );
    Table::new("For every n: masks", &note, words(&["mask", "points", "a", "b"]), rows)
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
    let row = |v: &ValenceReport| {
        let weight = |name: &String| v.rule_weights.iter().find(|(own, _)| own == name).map(|(_, weight)| weight);
        let cells = names.iter().map(|name| Cell::optional(weight(name), SHORT));
        std::iter::once(v.n.to_string().into()).chain(cells).collect()
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
    let row = |v: &ValenceReport| -> Vec<Cell> {
        let mu = v.subsubdominant.as_ref();
        let class = mu.and_then(|mu| mu.class).map(CurvatureClass::words);
        vec![
            v.n.to_string().into(),
            v.size.to_string().into(),
            Cell::optional(v.subdominant.as_ref().map(|e| &e.quantity), SHORT),
            v.subdominant.as_ref().map_or("-".into(), |e| e.frequency.to_string().into()),
            Cell::optional(mu.map(|mu| &mu.shown), SHORT),
            mu.map_or("-".into(), |mu| list(&mu.frequencies).into()),
            Cell::optional(mu.and_then(|mu| mu.shown_ratio.as_ref()), SHORT),
            class.unwrap_or("-").into(),
            Cell::optional(v.curvature.cup.as_ref().and_then(|e| e.shown_ratio.as_ref()), SHORT),
            Cell::optional(v.curvature.saddle.as_ref().and_then(|e| e.shown_ratio.as_ref()), SHORT),
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
    let largest = |v: &ValenceReport, k: usize| Cell::optional(v.largest.get(k).and_then(Option::as_ref), SHORT);
    let row = |v: &ValenceReport| {
        let cells = (0..most).map(|k| largest(v, k));
        std::iter::once(v.n.to_string().into()).chain(cells).collect()
    };
    let head = std::iter::once("n".to_string()).chain((0..most).map(|k| format!("k = {k}"))).collect();
    let note = "The largest eigenvalue of each frequency k, the 1 of the constants left out; n-k has the same as k.";
    Table::new("Largest eigenvalue by frequency", note, head, report.valences.iter().map(row).collect())
}

fn all_eigenvalues(report: &Report) -> Table {
    let rows = report.valences.iter().flat_map(|v| {
        (0..=v.n / 2).take(MOST_FREQUENCIES).map(|k| {
            let own: Vec<Cell> =
                v.eigenvalues.iter().filter(|e| e.frequency == k).map(|e| eigenvalue(e, v.n)).collect();
            vec![v.n.to_string().into(), k.to_string().into(), Cell::joined(&own)]
        })
    });
    let note = "Block by block, largest modulus first. (m times) is the multiplicity in the block; a Jordan block is named with its \
                size. Where values are approximate (≈), those too near each other to be told apart count together, and \
                their structure is not decided.";
    Table::new("Eigenvalues of the blocks", note, words(&["n", "k", "eigenvalues of block k"]), rows.collect())
}

/// Longer exact forms are left to the JSON form.
const LONG: usize = 80;

fn eigenvalue(e: &EigenvalueReport, n: usize) -> Cell {
    let blocks = if e.frequency == 0 || 2 * e.frequency == n { 1 } else { 2 };
    let cell = Cell::number(&e.quantity, LONG);
    let times = e.algebraic / blocks;
    if times == 1 {
        return cell;
    }
    let remark = match e.jordan {
        Some(size) if size > 1 => format!(" ({times} times, Jordan block of size {size})"),
        _ => format!(" ({times} times)"),
    };
    Cell { text: format!("{}{remark}", cell.text), latex: cell.latex.map(|latex| format!("{latex}{remark}")) }
}

fn limit_masks(report: &Report) -> Table {
    let first = report.valences.iter().find(|v| v.limit_mask.is_some());
    let names: Vec<String> = first
        .into_iter()
        .flat_map(|v| &v.amplitudes)
        .map(|a| a.at.clone())
        .filter(|name| report.valences.iter().any(|v| limit_of(v, name).is_some_and(|weight| weight.value[0] != 0.0)))
        .collect();
    let has_centre = report.valences.iter().any(|v| centre_weight(v).is_some());
    let row = |v: &ValenceReport| {
        let own = has_centre.then(|| Cell::optional(centre_weight(v).as_ref(), SHORT));
        let cells = names.iter().map(|name| Cell::optional(limit_of(v, name), SHORT));
        std::iter::once(v.n.to_string().into()).chain(own).chain(cells).collect()
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

fn limit_of<'a>(v: &'a ValenceReport, name: &str) -> Option<&'a Quantity> {
    v.amplitudes.iter().find(|a| a.at == name)?.limit.as_ref()
}

fn tangent_masks(report: &Report) -> Table {
    let rows = report.valences.iter().flat_map(|v| {
        v.tangent_forms.iter().flatten().map(|form| {
            let (own, next) = (Cell::number(&form.own, LONG), Cell::number(&form.next, SHORT));
            vec![v.n.to_string().into(), form.at.as_str().into(), own, next]
        })
    });
    let note = "Left vectors of λ in frequencies 1 and n-1. In sector s the cosine form has the weight a cos(2πs/n) + b cos(2π(s+1)/n) \
                and the sine form the same with sines. Applied to the points at any level they give two vectors that span the tangent \
                plane; cosine x sine is the outward normal.";
    Table::new("Tangent masks", note, words(&["n", "points", "a", "b"]), rows.collect())
}

fn conditions(report: &Report) -> Table {
    let names: Vec<String> =
        report.valences.first().into_iter().flat_map(|v| &v.verdicts).map(|verdict| verdict.claim.clone()).collect();
    let cell = |v: &ValenceReport, name: &String| v.verdicts.iter().find(|own| own.claim == *name).map(verdict_word);
    let row = |v: &ValenceReport| {
        let cells = names.iter().map(|name| cell(v, name).unwrap_or("-").into());
        std::iter::once(v.n.to_string().into()).chain(cells).collect()
    };
    let note = "proved and refuted rest on exact or enclosed values. Everything else is undecided; 'seems so' and 'seems not' say \
                which way floating numbers point, 'open' that they don't.";
    let head = std::iter::once("n".to_string()).chain(names.iter().cloned()).collect();
    Table::new("Conditions", note, head, report.valences.iter().map(row).collect())
}

/// C1 for every n.
fn c1(report: &Report) -> Table {
    let row = |stretch: &Stretch| {
        vec![stretch.valences().into(), stretch.verdict.word().into(), stretch.why.join("; ").into()]
    };
    let file = report.certificate.as_ref().map_or(String::new(), |own| {
        format!(" The certificate {} can be checked by a program that shares no code with this one.", own.file)
    });
    let note = format!(
        "Limit surfaces are C1 at the extraordinary point, for generic control points: {}.{file}",
        report.c1.statement
    );
    Table::new("C1 for every n", &note, words(&["n", "C1", "why"]), report.c1.stretches.iter().map(row).collect())
}

/// A verdict in a word or two.
pub fn verdict_word(verdict: &Verdict) -> &'static str {
    match (verdict.verdict, verdict.evidence) {
        (Decision::Proved | Decision::Refuted, _) => verdict.verdict.word(),
        (Decision::Undecided, Evidence::For) => "seems so",
        (Decision::Undecided, Evidence::Against) => "seems not",
        (Decision::Undecided, Evidence::None) => "open",
    }
}

/// The claims of a scheme file; `everywhere` is said of those without a condition.
pub(super) fn claims(claims: &[ClaimCheck], everywhere: &str) -> Table {
    let rows = claims.iter().map(|claim| {
        let value = claim.equals.clone().unwrap_or("-".to_string());
        let outcome = match claim.outcome {
            Outcome::Agrees => "agrees",
            Outcome::Disagrees => "DISAGREES",
            Outcome::Undecided => "undecided",
        };
        let condition = claim.condition.clone().unwrap_or(everywhere.to_string());
        let source = if claim.source.is_empty() { "-".to_string() } else { claim.source.join(", ") };
        [claim.what.clone(), value, condition, source, outcome.to_string(), claim.seen.clone()].map(Cell::from).to_vec()
    });
    let head = words(&["claim", "value", "where", "source", "outcome", "seen"]);
    Table::new("What the literature says", "The claims of the scheme file beside this analysis.", head, rows.collect())
}
