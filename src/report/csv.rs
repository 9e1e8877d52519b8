//! The report as one tidy CSV table: a row for each number.

use super::model::{Report, ValenceReport, WeightReport};
use std::fmt::Write;

const HEAD: &str = "n,quantity,at,frequency,sector,i,j,value,imaginary\n";

/// Every number of the report. Empty cells where a column doesn't apply.
pub fn csv(report: &Report) -> String {
    let mut text = HEAD.to_string();
    for valence in &report.valences {
        push_valence(&mut text, valence);
    }
    text
}

fn push_valence(text: &mut String, v: &ValenceReport) {
    let n = v.n;
    let _ = writeln!(text, "{n},size,,,,,,{},", v.size);
    for (name, weight) in &v.rule_weights {
        let _ = writeln!(text, "{n},rule weight,{},,,,,{},", quoted(name), weight.value[0]);
    }
    for e in &v.eigenvalues {
        let value = e.quantity.value;
        for _ in 0..e.algebraic {
            let _ = writeln!(text, "{n},eigenvalue,,{},,,,{},{}", e.frequency, value[0], value[1]);
        }
    }
    if let Some(mu) = &v.subsubdominant {
        let _ = writeln!(text, "{n},subsubdominant modulus,,,,,,{},", mu.modulus);
        if let Some(ratio) = mu.ratio {
            let _ = writeln!(text, "{n},curvature ratio,,,,,,{ratio},");
        }
    }
    for (name, k, e) in [("cup", 0, &v.curvature.cup), ("saddle", 2, &v.curvature.saddle)] {
        if let Some(e) = e {
            let _ = writeln!(text, "{n},{name},,{k},,,,{},", e.value);
        }
    }
    push_mask(text, n, "limit mask", v.limit_mask.as_deref());
    if let Some([cosine, sine]) = &v.tangent_masks {
        push_mask(text, n, "tangent mask cosine", Some(cosine));
        push_mask(text, n, "tangent mask sine", Some(sine));
    }
    for point in v.characteristic_map.iter().flatten() {
        let ([i, j], [x, y]) = (point.orbit, point.xy);
        let _ = writeln!(text, "{n},characteristic map,,1,{},{i},{j},{x},{y}", point.sector);
    }
}

fn push_mask(text: &mut String, n: usize, quantity: &str, mask: Option<&[WeightReport]>) {
    for weight in mask.into_iter().flatten() {
        let sector = weight.sector.map_or(String::new(), |sector| sector.to_string());
        let (i, j) = weight.orbit.map_or((String::new(), String::new()), |[i, j]| (i.to_string(), j.to_string()));
        let _ = writeln!(text, "{n},{quantity},{},,{sector},{i},{j},{},", quoted(&weight.at), weight.weight);
    }
}

/// A cell with a comma or a quote in it, by RFC 4180.
pub(super) fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell.to_string() }
}
