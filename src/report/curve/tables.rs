//! Which tables belong to the report of a curve?

use super::model::{CurveEigenvalueReport, CurvePointReport, CurveReport, LocalReport, WeightAt};
use super::range::RangeReport;
use crate::report::{Cell, Table};

/// The table that the picture of the basic limit function follows.
pub(super) const DERIVATIVES: &str = "Limit, tangent and derivative masks";
/// The table that the picture of a curve follows.
pub(super) const CONVERGENCE: &str = "From the polygon to the curve";

/// Matrices larger than this stand in the JSON form only.
const MOST_COLUMNS: usize = 12;

/// What was analysed, in a paragraph.
pub(super) fn introduction(report: &CurveReport) -> String {
    let class = &report.classification;
    let kind = if class.interpolating { "interpolating" } else { "approximating" };
    let values: Vec<String> = report.parameters.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let parameters = if values.is_empty() { String::new() } else { format!(" Parameters: {}.", values.join(", ")) };
    let what = match (&report.mask, class.primal) {
        (None, _) => "A polygon becomes two, which share a point and make up the next polygon".to_string(),
        (Some(mask), Some(true)) => format!("Mask of {} weights, primal: vertices stay vertices", mask.len()),
        (Some(mask), Some(false)) => format!("Mask of {} weights, dual: vertices become middles of edges", mask.len()),
        (Some(mask), None) => format!("Mask of {} weights, not symmetric", mask.len()),
    };
    let ends = if class.end_rules { " Open curves have rules of their own at their ends." } else { "" };
    format!(
        "Curve scheme of arity {}, {kind}, linear, told as {}. {what}.{ends}{parameters}\n\nMatrices, eigenvalues, eigenvectors and masks \
         are exact, and their decimals correctly rounded, unless a sign ≈ says that they are approximate; distances and pictures are approximate.",
        report.arity, class.form
    )
}

fn heads(list: &[&str]) -> Vec<String> {
    list.iter().map(|word| (*word).to_string()).collect()
}

fn matrix_table(title: &str, note: &str, labels: &[String], rows: &[Vec<String>]) -> Table {
    let head = std::iter::once(String::new()).chain(labels.iter().cloned()).collect();
    let row = |(label, row): (&String, &Vec<String>)| {
        std::iter::once(Cell::from(label.clone())).chain(row.iter().map(|cell| Cell::from(cell.clone()))).collect()
    };
    Table::new(title, note, head, labels.iter().zip(rows).map(row).collect())
}

/// Every table of a report.
pub(super) fn tables(report: &CurveReport) -> Vec<Table> {
    let mut tables = vec![rules(report)];
    tables.extend(super::smoothness::table(report));
    tables.extend(report.range.as_ref().map(RangeReport::table));
    tables.extend(report.halves.iter().flat_map(halves));
    for point in &report.points {
        let at = point.at;
        if point.steps_before > 0 {
            continue;
        }
        tables.extend(local_matrix(&format!("Local matrix at the {at}"), MINIMAL, &point.minimal));
        tables.push(eigenvalues(&format!("Eigenvalues at the {at}"), &note(point), &point.minimal));
        if point.full.indices != point.minimal.indices {
            let title = format!("Eigenvalues at the {at}, full neighbourhood");
            tables.push(eigenvalues(&title, FULL, &point.full));
        }
    }
    tables.push(masks(report));
    tables.extend(report.matrix_form.iter().flat_map(|form| {
        let labels: Vec<String> = (0..=form.degree).map(|j| format!("p{j}")).collect();
        let powers: Vec<String> = (0..=form.degree).rev().map(|k| format!("u^{k}")).collect();
        let basis = Table {
            head: std::iter::once(String::new()).chain(labels.clone()).collect(),
            ..matrix_table("Basis matrix M", BASIS, &powers, &form.basis)
        };
        let half = matrix_table("H of the first half", HALF, &labels, &form.first_half);
        (form.degree < MOST_COLUMNS).then_some([basis, half]).into_iter().flatten()
    }));
    tables.extend(report.convergence.as_ref().map(|own| {
        let factor = |level: usize| match level.checked_sub(1).map(|before| own.factors[before]) {
            Some(Some(factor)) => format!("{factor:.3}"),
            _ => "-".to_string(),
        };
        let row = |(level, distance): (usize, &f64)| {
            vec![Cell::from(level.to_string()), Cell::from(format!("≈ {distance:.3e}")), Cell::from(factor(level))]
        };
        let rows = own.distances.iter().enumerate().map(row).collect();
        Table::new(CONVERGENCE, MEASURED, heads(&["level", "distance", "times smaller"]), rows)
    }));
    if !report.claims.is_empty() {
        tables.push(crate::report::tables::claims(&report.claims, "always"));
    }
    tables.retain(|table| !table.rows.is_empty());
    tables
}

const MINIMAL: &str = "On the points that decide the value there; rows are the points of the next level.";
const FULL: &str = "On all points that decide the curve around it.";
const BASIS: &str = "A segment is (u^d, ..., u, 1) M p; M comes from the splines' recurrence.";
const HALF: &str = "H = M^-1 S M with S = diag(2^-d, ..., 1/2, 1), which agrees with the mask; on a tensor-product patch the first quadrant is H G H^T.";
const MEASURED: &str = "The farthest of vertices and middles of edges from the curve, for one polygon, approximately. It falls like the square of \
    the step where the curve is smooth enough.";

fn note(point: &CurvePointReport) -> String {
    let steps = if point.steps == 1 { String::new() } else { format!(" Of {} steps together.", point.steps) };
    let basis = if point.minimal.diagonalizable {
        "There is a basis of eigenvectors: the matrix is non-defective."
    } else {
        "There is no basis of eigenvectors: the matrix is defective."
    };
    format!(
        "On the points that decide the value there. {basis}{steps} The vector of 1 is (1, ..., 1), since weights sum to 1."
    )
}

fn rules(report: &CurveReport) -> Table {
    let (Some(mask), Some(first)) = (&report.mask, report.first_index) else {
        return Table::new("Rules", "", vec![], vec![]);
    };
    let arity = i64::from(report.arity);
    let row = |r: i64| {
        let own = (first..).zip(mask).filter(|(i, weight)| (i - r).rem_euclid(arity) == 0 && weight.as_str() != "0");
        let mut terms: Vec<(i64, &String)> = own.map(|(i, weight)| ((r - i) / arity, weight)).collect();
        terms.reverse();
        let words: Vec<String> = terms.iter().map(|(j, weight)| format!("{weight} p[{}]", shifted("j", *j))).collect();
        vec![
            Cell::from(format!("p'[{}]", shifted(&format!("{arity}j"), r))),
            Cell::from(words.join(" + ").replace("+ -", "- ")),
        ]
    };
    let note = format!("The mask is ({}), from the index {first} on.", mask.join(", "));
    Table::new("Rules", &note, heads(&["new point", "made of"]), (0..arity).map(row).collect())
}

fn shifted(name: &str, by: i64) -> String {
    match by {
        0 => name.to_string(),
        by if by < 0 => format!("{name}{by}"),
        by => format!("{name}+{by}"),
    }
}

fn halves(halves: &[Vec<Vec<String>>; 2]) -> Vec<Table> {
    let labels: Vec<String> = (0..halves[0].len()).map(|j| format!("p{j}")).collect();
    let table = |title, rows| matrix_table(title, "Rows are the new points.", &labels, rows);
    let all = vec![table("First half", &halves[0]), table("Second half", &halves[1])];
    if labels.len() <= MOST_COLUMNS { all } else { vec![] }
}

fn local_matrix(title: &str, note: &str, local: &LocalReport) -> Option<Table> {
    let labels: Vec<String> = local.indices.iter().map(|j| format!("p[{j}]")).collect();
    (labels.len() <= MOST_COLUMNS).then(|| matrix_table(title, note, &labels, &local.matrix))
}

pub(super) fn value_cell(e: &CurveEigenvalueReport) -> Cell {
    let approximate = || format!("≈ {:.6}{:+.6}i", e.value[0], e.value[1]);
    let decimal = e.decimal.clone().unwrap_or_else(approximate);
    match (&e.exact, &e.latex) {
        (Some(exact), Some(latex)) if exact.len() <= 60 => {
            let plain = decimal.trim_end_matches('0').trim_end_matches('.') == exact;
            let text = if plain { exact.clone() } else { format!("{decimal} = {exact}") };
            let latex = if plain { format!("${latex}$") } else { format!("${decimal} = {latex}$") };
            Cell { text: text.replace("= roots", "of the roots"), latex: Some(latex) }
        }
        _ => decimal.into(),
    }
}

fn vector(list: &[Vec<String>]) -> Cell {
    let words: Vec<String> = list.iter().take(2).map(|v| format!("({})", v.join(", "))).collect();
    let text = words.join(", ");
    if text.is_empty() || text.len() > 90 { "-".into() } else { text.into() }
}

fn eigenvalues(title: &str, note: &str, local: &LocalReport) -> Table {
    let row = |e: &CurveEigenvalueReport| {
        let times = format!("{}, {}", e.algebraic, e.geometric);
        vec![value_cell(e), times.into(), e.jordan.to_string().into(), vector(&e.right), vector(&e.left)]
    };
    let head = heads(&["eigenvalue", "algebraic, geometric", "Jordan block", "right vectors", "left vectors"]);
    Table::new(title, note, head, local.eigenvalues.iter().map(row).collect())
}

/// A mask in words: weights with the indices of their points.
pub(super) fn mask_words(mask: &[WeightAt]) -> String {
    let exact = |own: &WeightAt| own.exact.clone().unwrap_or_else(|| format!("≈ {:.10}", own.weight));
    in_words(mask, exact)
}

/// The same in decimals where it is long, and in a count where it is very long.
pub(super) fn short_words(mask: &[WeightAt]) -> String {
    const LONGEST: usize = 160;
    let decimals = || in_words(mask, |own| format!("{:.6}", own.weight));
    let few = |words: &String| words.chars().count() <= LONGEST;
    let exact = Some(mask_words(mask)).filter(few);
    exact.or_else(|| Some(decimals()).filter(few)).unwrap_or_else(|| format!("{} weights, in the files", mask.len()))
}

fn in_words(mask: &[WeightAt], value: impl Fn(&WeightAt) -> String) -> String {
    let words: Vec<String> = mask.iter().map(|own| format!("{} p[{}]", value(own), own.index)).collect();
    words.join(" + ").replace("+ -", "- ")
}

fn masks(report: &CurveReport) -> Table {
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for point in &report.points {
        let mut push = |name: &str, mask: &Option<Vec<WeightAt>>, why: &Option<String>| {
            let words = match (mask, why) {
                (Some(mask), _) => mask_words(mask),
                (None, Some(why)) => format!("none: {why}"),
                (None, None) => return,
            };
            rows.push(vec![point.at.into(), name.into(), words.into()]);
        };
        push("limit", &point.limit_mask, &point.why_no_limit);
        push("tangent", &point.tangent_mask, &point.why_no_tangent);
        for (order, mask) in (1..).zip(&point.derivative_masks).skip(1) {
            push(&format!("derivative {order}"), &Some(mask.clone()), &None);
        }
    }
    let led = report.points.iter().filter(|point| point.steps_before > 0);
    let led: Vec<String> =
        led.map(|point| format!(" A step leads from the {} to another of these points.", point.at)).collect();
    let note = "The limit mask is the left eigenvector of 1, with sum 1; the tangent mask that of the largest eigenvalue after 1, scaled so that the \
                sum of weight times index is 1: the plain difference goes to 0 by that eigenvalue a step, its direction stays. The mask of the k-th \
                derivative, with respect to the index, holds where the curve is k times differentiable. At a middle p[0] and p[1] are the ends of the \
                edge; at an end indices count from it.";
    Table::new(DERIVATIVES, &format!("{note}{}", led.concat()), heads(&["at", "mask", "weights"]), rows)
}
