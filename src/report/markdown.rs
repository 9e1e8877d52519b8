//! The report as Markdown.

use super::Figure;
use super::model::{Reference, Report, ValenceReport};
use super::tables::{Table, tables};
use std::fmt::Write;

/// The report; pictures are linked by file name where they are given.
pub fn markdown(report: &Report, figures: &[Figure]) -> String {
    let (title, introduction, tables) = (&report.title, introduction(report), tables(report));
    let parts = Parts { title, introduction: &introduction, tables: &tables, figures, sources: &report.sources };
    parts.markdown(&format!("\n## The conditions\n\n{}", conditions(report)))
}

/// What a document is made of, whatever the kind of scheme.
pub(super) struct Parts<'a> {
    pub(super) title: &'a str,
    pub(super) introduction: &'a str,
    pub(super) tables: &'a [Table],
    pub(super) figures: &'a [Figure],
    pub(super) sources: &'a [Reference],
}

impl Parts<'_> {
    /// The document in Markdown, with a part before the sources.
    pub(super) fn markdown(&self, conditions: &str) -> String {
        let mut text = format!("# {}\n\n{}\n", self.title, self.introduction);
        for figure in self.figures.iter().filter(|figure| figure.name == "stencils") {
            push_figure(&mut text, figure);
        }
        for table in self.tables {
            let _ = write!(text, "\n## {}\n\n{}\n\n{}", table.title, escaped(&table.note), rows(table));
            for figure in self.figures.iter().filter(|figure| figure.belongs_to == table.title) {
                push_figure(&mut text, figure);
            }
        }
        text.push_str(conditions);
        text.push_str("\n## Sources\n\n");
        for source in self.sources {
            let _ = writeln!(text, "- **{}**: {}", source.key, escaped(&source.citation));
        }
        text
    }
}

/// What was analysed, in a paragraph.
pub(super) fn introduction(report: &Report) -> String {
    let class = &report.classification;
    let place = if class.dual { "face with n corners" } else { "vertex with n edges" };
    let kind = if class.interpolating { "interpolating" } else { "approximating" };
    let values: Vec<String> = report.parameters.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let parameters = if values.is_empty() { String::new() } else { format!(" Parameters: {}.", values.join(", ")) };
    let residuals: Vec<&str> = report.valences.iter().map(|v| v.residual.bound.as_str()).collect();
    let vectors: usize = report.valences.iter().map(|v| v.residual.vectors).sum();
    let worst = residuals.iter().max_by_key(|bound| exponent(bound)).copied().unwrap_or("-");
    format!(
        "Mesh: {}. Split: {}. {} scheme, linear; regular at n = {}. Analysed at an extraordinary {place}, over the full \
         neighbourhood: every point that influences the limit surface over the faces around the centre.{parameters}\n\n\
         {} As a check of the approximate numbers, {vectors} right and left eigenvectors were put into their equations; the \
         residuals, relative to the vectors, are {worst}.",
        class.mesh,
        class.split,
        capitalised(kind),
        class.regular_valence,
        arithmetic(report),
    )
}

/// How the numbers are known.
fn arithmetic(report: &Report) -> String {
    let mut text = "Eigenvalues, masks and ratios are exact, and their decimals correctly rounded, unless a sign ≈ says that they are \
                    approximate (f64, no error bound); characteristic maps and what is drawn are approximate."
        .to_string();
    for kind in ["enclosed", "approximate"] {
        let those: Vec<&ValenceReport> = report.valences.iter().filter(|v| v.arithmetic == kind).collect();
        if let Some(first) = those.first() {
            let shown: Vec<String> = those.iter().take(8).map(|v| v.n.to_string()).collect();
            let more = if those.len() > shown.len() { ", ..." } else { "" };
            let why = first.why_not_exact.clone().unwrap_or_default();
            let _ = write!(text, " At n = {}{more} numbers are {kind}: {why}.", shown.join(", "));
        }
    }
    if let Some(why) = &report.why_no_regular {
        let _ = write!(text, " The regular part is not told: {why}.");
    }
    if let Some(why) = &report.why_no_formulas {
        let _ = write!(text, " There are no closed forms for all n: {why}.");
    }
    text
}

fn exponent(bound: &str) -> i32 {
    bound.rsplit("1e").next().and_then(|digits| digits.parse().ok()).unwrap_or(1)
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn push_figure(text: &mut String, figure: &Figure) {
    let _ = write!(text, "\n![{}]({}.svg)\n\n*{}*\n", figure.name, figure.name, escaped(&figure.caption));
}

/// The table's rows in Markdown's form, columns padded so that the text reads well as it stands.
fn rows(table: &Table) -> String {
    let head: Vec<String> = table.head.iter().map(|cell| escaped(cell)).collect();
    let body = table.rows.iter().map(|row| row.iter().map(|cell| escaped(&cell.text)).collect());
    let cells: Vec<Vec<String>> = std::iter::once(head).chain(body).collect();
    let width = |column: usize| cells.iter().map(|row| row[column].chars().count()).max().unwrap_or(0).max(3);
    let widths: Vec<usize> = (0..table.head.len()).map(width).collect();
    let line = |row: &Vec<String>| {
        let padded = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}"));
        format!("| {} |\n", padded.collect::<Vec<_>>().join(" | "))
    };
    let rule = widths.iter().map(|width| "-".repeat(*width)).collect::<Vec<_>>().join(" | ");
    let body: String = cells[1..].iter().map(line).collect();
    format!("{}| {rule} |\n{body}", line(&cells[0]))
}

/// Text whose signs Markdown would take for its own.
fn escaped(text: &str) -> String {
    text.replace('|', "\\|").replace('*', "\\*").replace('_', "\\_").replace('<', "&lt;")
}

/// Each condition in words, with what is missing and its sources.
fn conditions(report: &Report) -> String {
    let mut text = String::new();
    let Some(first) = report.valences.first() else { return text };
    for (index, verdict) in first.verdicts.iter().enumerate() {
        let _ =
            writeln!(text, "- **{}**: {}. [{}]", verdict.claim, escaped(&verdict.states), verdict.source.join(", "));
        for valence in &report.valences {
            let Some(own) = valence.verdicts.get(index) else { continue };
            let _ = writeln!(text, "  - n = {}: {}; {}", valence.n, escaped(&own.value), escaped(&own.why.join("; ")));
        }
    }
    text
}
