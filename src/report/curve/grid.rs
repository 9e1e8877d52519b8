//! What does the report of a tensor product say?
//!
//! A grid is regular everywhere: its masks are products, its eigenvalues are products, and there is no extraordinary point.

use super::{Document, NoCurveReport};
use crate::analysis::curve::local::{Extent, neighbourhood};
use crate::analysis::curve::point::{CurvePoint, IndexedWeight, Marked, points_of_mask};
use crate::analysis::curve::product::{kronecker, product_mask, submask};
use crate::analysis::curve::spectrum::spectrum;
use crate::report::model::{FORMAT, reference};
use crate::report::{Cell, Table};
use crate::scheme::curve::{CurveScheme, Mask};
use crate::scheme::grid::GridScheme;
use dashu_ratio::RBig;
use serde_json::json;
use std::fmt::Write;

/// Products with more points are told by their factors alone.
const MOST_POINTS: usize = 49;

const NO_EXTRAORDINARY: &str =
    "A grid is regular everywhere: it has no extraordinary points, and smoothness is that of the factors.";

/// The report of a tensor product.
///
/// # Errors
/// Faults of the scheme file, or what stood in the way.
pub fn grid(scheme: &GridScheme) -> Result<Document, NoCurveReport> {
    let words = |trouble: crate::numbers::Trouble| NoCurveReport::Words(trouble.to_string());
    let [a, b]: [CurveScheme; 2] = scheme.curves().map_err(NoCurveReport::Faults)?;
    let factors = [&a, &b].map(|curve| curve.mask().map_err(NoCurveReport::Faults));
    let [a_mask, b_mask] = factors;
    let (a_mask, b_mask) = (a_mask?, b_mask?);
    let points = [&a_mask, &b_mask].map(|mask| points_of_mask(mask, None).map_err(words));
    let [a_points, b_points] = points;
    let (a_points, b_points) = (a_points?, b_points?);
    let at = stays(&a_points).zip(stays(&b_points));
    let mut tables = submasks(&a_mask, &b_mask);
    let (mut eigenvalues, mut limit) = (Vec::new(), Vec::new());
    if let Some((x, y)) = at {
        tables.extend(limit_table(x, y));
        limit = products(x, y);
        let local = |mask: &Mask, point: &CurvePoint| neighbourhood(mask, &point.at.position(), Extent::Minimal);
        let (s, t) = (local(&a_mask, x).map_err(words)?.local, local(&b_mask, y).map_err(words)?.local);
        if s.indices.len() * t.indices.len() <= MOST_POINTS && s.steps == t.steps {
            for e in spectrum(&kronecker(&s.matrix, &t.matrix)).map_err(words)? {
                let exact = e.words.as_ref().map_or_else(|| format!("≈ {}", e.value), |words| words.text.clone());
                eigenvalues.push((exact, e.algebraic, e.geometric));
            }
        }
    }
    if !eigenvalues.is_empty() {
        let row = |(value, algebraic, geometric): &(String, usize, usize)| {
            vec![value.clone().into(), format!("{algebraic}, {geometric}").into()]
        };
        let head = vec!["eigenvalue".to_string(), "algebraic, geometric".to_string()];
        let note = "Of the Kronecker product of the factors' local matrices: all products of their eigenvalues.";
        tables.push(Table::new("Eigenvalues at the regular point", note, head, eigenvalues.iter().map(row).collect()));
    }
    let names = [&a, &b].map(|curve| {
        let values: Vec<String> =
            curve.book.parameters.iter().map(|p| format!("{} = {}", p.name, p.value.formula.text())).collect();
        if values.is_empty() { curve.id.clone() } else { format!("{} with {}", curve.id, values.join(", ")) }
    });
    let mask = product_mask(&a_mask, &b_mask);
    let value = json!({
        "format": FORMAT, "scheme": scheme.id, "title": scheme.book.title, "kind": "grid", "factors": names,
        "mask": super::model::words(&mask.weights), "first_index": mask.first, "arity": mask.arity,
        "eigenvalues": eigenvalues.iter().map(|(v, a, g)| json!({"exact": v, "algebraic": a, "geometric": g})).collect::<Vec<_>>(),
        "limit_mask": limit.iter().map(|([i, j], w)| json!({"index": [i, j], "exact": w.to_string()})).collect::<Vec<_>>(),
        "extraordinary": null,
    });
    let json = serde_json::to_string_pretty(&value).map_err(|error| NoCurveReport::Words(error.to_string()))?;
    let introduction = format!("Tensor product of {} and {}. {NO_EXTRAORDINARY}", names[0], names[1]);
    Ok(Document {
        scheme: scheme.id.clone(),
        title: scheme.book.title.clone(),
        terminal: terminal(scheme, &names, &tables),
        introduction,
        tables,
        sources: scheme.book.sources.iter().map(|key| reference(key)).collect(),
        pictures: Vec::new(),
        json: json + "\n",
    })
}

/// The marked point that every step brings back to itself.
fn stays(points: &[CurvePoint]) -> Option<&CurvePoint> {
    points.iter().find(|point| point.steps_before == 0 && point.at != Marked::Start)
}

fn products(x: &CurvePoint, y: &CurvePoint) -> Vec<([i64; 2], RBig)> {
    let (Ok(x), Ok(y)) = (&x.limit, &y.limit) else { return Vec::new() };
    let exact = |weight: &IndexedWeight| weight.exact.clone().unwrap_or(RBig::ZERO);
    let pair = |p: &IndexedWeight, q: &IndexedWeight| ([p.index, q.index], exact(p) * exact(q));
    x.iter().flat_map(|p| y.iter().map(move |q| pair(p, q))).collect()
}

fn limit_table(x: &CurvePoint, y: &CurvePoint) -> Option<Table> {
    let (Ok(columns), Ok(rows)) = (&y.limit, &x.limit) else { return None };
    let all = products(x, y);
    let head = std::iter::once(String::new()).chain(columns.iter().map(|w| format!("[{}]", w.index))).collect();
    let line = |(w, own): (&IndexedWeight, &[([i64; 2], RBig)])| {
        let cells = own.iter().map(|(_, weight)| Cell::from(weight.to_string()));
        std::iter::once(Cell::from(format!("[{}]", w.index))).chain(cells).collect()
    };
    let rows = rows.iter().zip(all.chunks(columns.len())).map(line).collect();
    let note = format!("At a {} along the first index and a {} along the second.", x.at.name(), y.at.name());
    Some(Table::new("Limit mask", &note, head, rows))
}

fn submasks(a: &Mask, b: &Mask) -> Vec<Table> {
    let kinds = (0..i64::from(a.arity)).flat_map(|r| (0..i64::from(b.arity)).map(move |s| [r, s]));
    let table = |kind: [i64; 2]| {
        let columns = b.submask(kind[1]);
        let head = std::iter::once(String::new()).chain(columns.iter().map(|(j, _)| format!("[{j}]"))).collect();
        let rows = submask(a, b, kind);
        let line = |((j, _), row): (&(i64, RBig), &Vec<RBig>)| {
            std::iter::once(Cell::from(format!("[{j}]"))).chain(row.iter().map(|w| Cell::from(w.to_string()))).collect()
        };
        let rows = a.submask(kind[0]).iter().zip(&rows).map(line).collect();
        let note = "Weights of old points by their indices, less those of the new point over the arity.";
        Table::new(&format!("Mask of the new points [{}, {}]", kind[0], kind[1]), note, head, rows)
    };
    kinds.map(table).collect()
}

fn terminal(scheme: &GridScheme, names: &[String; 2], tables: &[Table]) -> String {
    let mut text = format!("{} · grid, tensor product of {} and {}\n", scheme.book.title, names[0], names[1]);
    for table in tables {
        let _ = writeln!(text, "\n{}", table.title);
        let width = |column: usize| {
            let cells = table.rows.iter().map(|row| row[column].text.chars().count());
            cells.chain([table.head[column].chars().count()]).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..table.head.len()).map(width).collect();
        let line = |cells: Vec<&str>| {
            let padded = cells.iter().zip(&widths).map(|(cell, width)| format!("{cell:>width$}"));
            format!("  {}\n", padded.collect::<Vec<_>>().join("  "))
        };
        text.push_str(&line(table.head.iter().map(String::as_str).collect()));
        table.rows.iter().for_each(|row| text.push_str(&line(row.iter().map(|cell| cell.text.as_str()).collect())));
    }
    text + "\n" + NO_EXTRAORDINARY + "\n"
}
