//! The report as a LaTeX document that compiles as it stands (booktabs, longtable).

use super::Figure;
use super::markdown::{Parts, introduction};
use super::model::Report;
use super::tables::{Cell, Table, tables};
use std::fmt::Write;

const HEAD: &str = r"\documentclass[10pt]{article}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage[a4paper,margin=18mm]{geometry}
\usepackage{amsmath,booktabs,longtable,array,graphicx}
\setlength{\parindent}{0pt}
\setlength{\tabcolsep}{4pt}
% pictures are taken in where their files lie beside this one
\newcommand{\reportpicture}[2]{\IfFileExists{#1.png}{\begin{figure}[htbp]\centering
  \includegraphics[width=.9\textwidth]{#1.png}\caption{#2}\end{figure}}{}}
% tables that are wider than the page are made smaller
\newcommand{\fitted}[1]{\resizebox{\ifdim\width>\textwidth\textwidth\else\width\fi}{!}{#1}}
\begin{document}
";

/// The report; pictures are taken in where their PNG files lie beside the document.
pub fn latex(report: &Report, figures: &[Figure]) -> String {
    let (title, introduction, tables) = (&report.title, introduction(report), tables(report));
    Parts { title, introduction: &introduction, tables: &tables, figures, sources: &report.sources }.latex()
}

impl Parts<'_> {
    /// The document in LaTeX.
    pub(super) fn latex(&self) -> String {
        let mut text = format!("{HEAD}\\section*{{{}}}\n{}\n", escaped(self.title), escaped(self.introduction));
        for figure in self.figures {
            let _ = writeln!(text, "\\reportpicture{{{}}}{{{}}}", figure.name, escaped(&figure.caption));
        }
        for table in self.tables {
            let (title, note) = (escaped(&table.title), escaped(&table.note));
            let _ = write!(text, "\n\\subsection*{{{title}}}\n{note}\n\n{}", rows(table));
        }
        text.push_str("\n\\begin{thebibliography}{99}\n");
        for (index, source) in self.sources.iter().enumerate() {
            let _ = writeln!(text, "\\bibitem{{r{index}}} {}: {}", escaped(&source.key), escaped(&source.citation));
        }
        if self.sources.is_empty() {
            text.push_str("\\bibitem{none} no sources\n");
        }
        text.push_str("\\end{thebibliography}\n\\end{document}\n");
        text
    }
}

/// Tables of more rows than this may break across pages.
const MOST_ROWS_ON_A_PAGE: usize = 45;

/// The same where cells wrap.
const MOST_WRAPPED_ROWS: usize = 12;

/// A table with the rules of booktabs. Columns with sentences wrap.
fn rows(table: &Table) -> String {
    let longest = |column: usize| table.rows.iter().map(|row| row[column].text.chars().count()).max().unwrap_or(0);
    let count = table.head.len();
    let wide: Vec<bool> = (0..count).map(|column| longest(column) > 40).collect();
    let narrow_characters: usize = (0..count).filter(|c| !wide[*c]).map(|c| longest(c).max(6)).sum();
    let share = (0.92 - 0.0105 * narrow_characters as f64).max(0.3) / wide.iter().filter(|w| **w).count().max(1) as f64;
    let column = |wide: &bool| match wide {
        true => format!(">{{\\raggedright\\arraybackslash}}p{{{share:.2}\\textwidth}}"),
        false => "l".to_string(),
    };
    let spec: String = wide.iter().map(column).collect();
    let line = |cells: Vec<String>| format!("{} \\\\\n", cells.join(" & "));
    let cell = |cell: &Cell| cell.latex.as_deref().map_or(escaped(&cell.text), unicode);
    let body: String = table.rows.iter().map(|row| line(row.iter().map(cell).collect())).collect();
    let size = match count {
        0..=7 => "\\footnotesize",
        8..=10 => "\\scriptsize",
        _ => "\\tiny",
    };
    let head = line(table.head.iter().map(|cell| escaped(cell)).collect());
    let breaks = table.rows.len() > if wide.contains(&true) { MOST_WRAPPED_ROWS } else { MOST_ROWS_ON_A_PAGE };
    let (environment, endhead) = if breaks { ("longtable", "\\endhead\n") } else { ("tabular", "") };
    let rows = format!(
        "\\begin{{{environment}}}{{@{{}}{spec}@{{}}}}\n\\toprule\n{head}\\midrule\n{endhead}{body}\\bottomrule\n\\end{{{environment}}}"
    );
    let fitted = if breaks || wide.contains(&true) { rows } else { format!("\\fitted{{{rows}}}") };
    format!("{{{size}\\setlength{{\\tabcolsep}}{{3pt}}\n{fitted}\\par}}\n")
}

/// LaTeX with mathematical letters.
fn unicode(latex: &str) -> String {
    latex.replace('≈', "$\\approx$")
}

/// Text whose signs LaTeX would take for its own, and mathematical letters.
fn escaped(text: &str) -> String {
    text.chars().map(|c| letter(c).map_or(c.to_string(), str::to_string)).collect()
}

fn letter(c: char) -> Option<&'static str> {
    Some(match c {
        '\\' => "\\textbackslash{}",
        '{' => "\\{",
        '}' => "\\}",
        '&' => "\\&",
        '%' => "\\%",
        '$' => "\\$",
        '#' => "\\#",
        '_' => "\\_",
        '^' => "\\textasciicircum{}",
        '~' => "\\textasciitilde{}",
        '<' => "$<$",
        '>' => "$>$",
        '|' => "$|$",
        'α' => "$\\alpha$",
        'β' => "$\\beta$",
        'λ' => "$\\lambda$",
        'μ' => "$\\mu$",
        '±' => "$\\pm$",
        'π' => "$\\pi$",
        'ω' => "$\\omega$",
        '²' => "$^2$",
        '³' => "$^3$",
        '−' => "$-$",
        '·' => "$\\cdot$",
        '×' => "$\\times$",
        '≤' => "$\\le$",
        '≥' => "$\\ge$",
        '≠' => "$\\ne$",
        '≈' => "$\\approx$",
        '√' => "$\\surd$",
        'γ' => "$\\gamma$",
        'δ' => "$\\delta$",
        'θ' => "$\\theta$",
        'σ' => "$\\sigma$",
        'ρ' => "$\\rho$",
        'τ' => "$\\tau$",
        '₀' => "$_0$",
        '₁' => "$_1$",
        '₂' => "$_2$",
        _ => return None,
    })
}
