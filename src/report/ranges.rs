//! For which values of a parameter do the spectral conditions hold, valence by valence?

use super::tables::{Cell, Table};
use crate::analysis::exact::ranges::{self as exact, Condition, End, Range, Ranges};
use crate::scheme::{Interval, Scheme};
use serde::Serialize;
use std::fmt::Write;

/// The decimals of ends that are not rational.
const DIGITS: usize = 10;

/// Ends whose exact form is longer than this are told by their decimals, but in JSON.
const LONGEST: usize = 90;

/// Where a condition holds at a valence.
#[derive(Clone, Debug, Serialize)]
pub struct RangeReport {
    /// The valence.
    pub n: usize,
    /// The parameter.
    pub parameter: String,
    /// The values that were looked at, as given.
    pub within: [String; 2],
    /// The condition.
    pub condition: &'static str,
    /// Where it holds, in order; null where that is not decided.
    pub intervals: Option<Vec<IntervalReport>>,
    /// Single values at which it is not decided, which are left out of the intervals.
    pub undecided_at: Vec<String>,
    /// Why it is not decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_decided: Option<String>,
}

/// An interval of values.
#[derive(Clone, Debug, Serialize)]
pub struct IntervalReport {
    /// Its lower end, to nearest.
    pub from: f64,
    /// Its upper end.
    pub to: f64,
    /// The lower end exactly.
    pub from_exact: String,
    /// The upper end exactly.
    pub to_exact: String,
    /// Whether the condition is decided to hold at either end.
    pub closed: [bool; 2],
    /// As people read it.
    #[serde(skip)]
    pub words: String,
}

/// The ranges of a scheme's conditions.
///
/// # Errors
/// When the parameter can't be treated so.
pub fn ranges(
    scheme: &Scheme,
    valences: &[usize],
    interval: &Interval,
    done: &dyn Fn(),
) -> Result<Vec<RangeReport>, String> {
    scheme.admits(interval)?;
    let forms = exact::forms(scheme, &interval.name);
    let mut reports = Vec::new();
    for n in valences {
        match exact::ranges(scheme, forms.as_ref(), *n, interval) {
            Ok(all) => reports.extend(all.iter().map(|ranges| decided(*n, interval, ranges))),
            Err(why) => reports.extend(Condition::ALL.map(|condition| {
                let blank = Ranges { condition, ranges: vec![], undecided: vec![] };
                RangeReport { intervals: None, not_decided: Some(why.clone()), ..decided(*n, interval, &blank) }
            })),
        }
        done();
    }
    Ok(reports)
}

fn decided(n: usize, interval: &Interval, ranges: &Ranges) -> RangeReport {
    RangeReport {
        n,
        parameter: interval.name.clone(),
        within: [interval.from.to_string(), interval.to.to_string()],
        condition: ranges.condition.name(),
        intervals: Some(ranges.ranges.iter().map(interval_report).collect()),
        undecided_at: ranges.undecided.iter().map(|end| end.exact.text.clone()).collect(),
        not_decided: None,
    }
}

fn interval_report(range: &Range) -> IntervalReport {
    let float = |end: &End| match &end.rational {
        Some(value) => value.to_f64().value(),
        None => end.value.midpoint_f64(),
    };
    IntervalReport {
        from: float(&range.from),
        to: float(&range.to),
        from_exact: range.from.exact.text.clone(),
        to_exact: range.to.exact.text.clone(),
        closed: range.closed,
        words: words(range),
    }
}

/// `[1/8, (1 + sqrt(5))/16 = 0.2022542486)`
fn words(range: &Range) -> String {
    let written = |end: &End| match end.rational {
        Some(_) => end.exact.text.clone(),
        None if end.exact.text.len() > LONGEST => format!("{} (rounded)", end.decimal(DIGITS)),
        None => format!("{} = {}", end.exact.text, end.decimal(DIGITS)),
    };
    if range.from.exact == range.to.exact {
        return format!("{{{}}}", written(&range.from));
    }
    let open = if range.closed[0] { '[' } else { '(' };
    let close = if range.closed[1] { ']' } else { ')' };
    format!("{open}{}, {}{close}", written(&range.from), written(&range.to))
}

impl RangeReport {
    /// The intervals as people read them.
    pub fn words(&self) -> String {
        let Some(intervals) = &self.intervals else {
            return format!("not decided: {}", self.not_decided.as_deref().unwrap_or("beyond a limit"));
        };
        let all = |i: &IntervalReport| [&i.from_exact, &i.to_exact] == [&self.within[0], &self.within[1]];
        let mut text = match intervals.as_slice() {
            [] => "nowhere".to_string(),
            [only] if all(only) && only.closed == [true, true] => "everywhere".to_string(),
            many => many.iter().map(|interval| interval.words.as_str()).collect::<Vec<_>>().join(" and "),
        };
        if !self.undecided_at.is_empty() {
            let _ = write!(text, "; not decided at {}", self.undecided_at.join(", "));
        }
        text
    }
}

/// The title of the table.
pub const TITLE: &str = "Ranges of a parameter";

/// The table of a report.
pub(super) fn table(ranges: &[RangeReport]) -> Option<Table> {
    let first = ranges.first()?;
    let note = format!(
        "Values of {} from {} to {} for which a condition holds; exact: [ and ] belong to a range, ( and ) do not. '1 dominates': \
         1 is simple and all others are smaller in modulus. 'subdominant': the largest after 1, λ, is real, positive, of \
         frequency 1, simple there and larger in modulus than all others. '|μ| ≤ λ²': the same, and no other modulus is above λ². The exact form of \
         an end that is marked (rounded) is in the JSON.",
        first.parameter, first.within[0], first.within[1]
    );
    let row = |range: &RangeReport| -> Vec<Cell> {
        let condition = range.condition.replace("mu", "μ").replace("<= lambda^2", "≤ λ²");
        [range.n.to_string(), condition, range.words().replace('*', " ")].map(Cell::from).to_vec()
    };
    let head = ["n".to_string(), "condition".to_string(), format!("{} in", first.parameter)].to_vec();
    Some(Table { title: TITLE.to_string(), note, head, rows: ranges.iter().map(row).collect() })
}

/// The ranges for a terminal.
pub fn terminal(ranges: &[RangeReport]) -> String {
    let Some(first) = ranges.first() else { return String::new() };
    let mut text = format!(
        "\nValues of {} from {} to {} for which a condition holds, exactly:\n",
        first.parameter, first.within[0], first.within[1]
    );
    for range in ranges {
        let _ = writeln!(text, "{:>6}  {:<17} {}", range.n, range.condition, range.words());
    }
    text
}
