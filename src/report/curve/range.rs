//! For which values of a parameter is the limit curve C^m?
//!
//! Between two values of a parameter that weights depend on by polynomials of degree 1 ([`CurveScheme::is_affine_in`]), by pieces: proved with one
//! polytope that serves both ends, refuted by one product on all of it, or undecided ([`range`](crate::analysis::smoothness::range)).

use crate::analysis::smoothness::range::{Finding, continuity_between};
use crate::report::{Cell, Table};
use crate::scheme::Interval;
use crate::scheme::curve::CurveScheme;
use dashu_ratio::RBig;
use serde::Serialize;
use std::fmt::Write;

/// Undecided pieces are not wider than this part of the interval.
const PARTS: u32 = 512;

/// Values of a parameter with what is known there, ends included.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Piece {
    /// The lower end, exactly.
    pub from: String,
    /// The upper end, exactly.
    pub to: String,
    /// `proved`, `refuted` or `undecided`.
    pub verdict: &'static str,
}

/// The pieces of an interval, neighbours with the same verdict joined.
#[derive(Clone, Debug, Serialize)]
pub struct RangeReport {
    /// The parameter.
    pub parameter: String,
    /// The claim: C0, C1, ...
    pub claim: String,
    /// What is known, from the lower end to the upper one.
    pub pieces: Vec<Piece>,
}

/// Looks at an interval of values.
///
/// # Errors
/// In words: when weights depend on the parameter otherwise, or masks have no limits or are too large.
pub fn range(scheme: &CurveScheme, interval: &Interval, m: usize) -> Result<RangeReport, String> {
    let name = &interval.name;
    let parameters = &scheme.book.parameters;
    match parameters.iter().find(|parameter| parameter.name == *name) {
        None if parameters.is_empty() => return Err("it has no parameter".to_string()),
        None => {
            let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name.as_str()).collect();
            return Err(format!("there is no parameter `{name}`; it has {}", names.join(", ")));
        }
        Some(own) if own.integer => return Err(format!("`{name}` takes whole numbers only, and has no range")),
        Some(_) => {}
    }
    if !scheme.is_affine_in(name).map_err(|fault| fault.message)? {
        return Err(format!("the weights do not depend on `{name}` by polynomials of degree 1, which ranges need"));
    }
    let mask = |value: &RBig| {
        let mut at = scheme.clone();
        at.book.set(name, &value.to_string())?;
        at.mask().map_err(|faults| faults.to_string())
    };
    let width = RBig::ONE / RBig::from(PARTS);
    let found = continuity_between(&mask(&interval.from)?, &mask(&interval.to)?, m, &width)?;
    let mut pieces: Vec<(RBig, RBig, &'static str)> = Vec::new();
    for piece in found {
        let verdict = match piece.finding {
            Finding::Proved { .. } => "proved",
            Finding::Refuted(_) => "refuted",
            Finding::Undecided => "undecided",
        };
        match pieces.last_mut() {
            Some((_, to, last)) if *last == verdict => *to = piece.to,
            _ => pieces.push((piece.from, piece.to, verdict)),
        }
    }
    let value = |t: &RBig| (&interval.from + (&interval.to - &interval.from) * t).to_string();
    let told = |(from, to, verdict): (RBig, RBig, &'static str)| Piece { from: value(&from), to: value(&to), verdict };
    let pieces = pieces.into_iter().map(told).collect();
    Ok(RangeReport { parameter: name.clone(), claim: format!("C{m}"), pieces })
}

impl RangeReport {
    fn question(&self) -> String {
        format!("Where in {} are limits {}?", self.parameter, self.claim)
    }

    /// The pieces as lines for a terminal.
    pub(super) fn terminal(&self) -> String {
        let mut text = format!("{}\n", self.question());
        for Piece { from, to, verdict } in &self.pieces {
            let (low, high) = (decimal(from), decimal(to));
            let _ = writeln!(text, "  {} from {from} to {to}  ({low:.6} to {high:.6})  {verdict}", self.parameter);
        }
        text
    }

    /// The pieces as a table.
    pub(super) fn table(&self) -> Table {
        let head = ["from", "to", "decimal", "verdict"].map(String::from).to_vec();
        let row = |piece: &Piece| {
            let range = format!("{:.6} to {:.6}", decimal(&piece.from), decimal(&piece.to));
            [piece.from.clone(), piece.to.clone(), range, piece.verdict.to_string()].map(Cell::from).to_vec()
        };
        Table::new(&self.question(), NOTE, head, self.pieces.iter().map(row).collect())
    }
}

const NOTE: &str = "Ends belong to their pieces. Proved: one norm in which the difference scheme contracts serves all values of the piece; refuted: one \
                    product of its matrices grows on all of it.";

fn decimal(text: &str) -> f64 {
    text.parse::<RBig>().map_or(0.0, |value| value.to_f64().value())
}
