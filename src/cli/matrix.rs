//! `matrix`: which numbers stand in the local subdivision matrix, or in one of its blocks?

use super::analyze::explain;
use super::open::{open_any, open_checked};
use super::valences::one_valence;
use super::{Failure, failure, print};
use clap::{Args, ValueEnum};
use eigenring::analysis::Analyzer;
use eigenring::analysis::blocks::Blocks;
use eigenring::analysis::local::{LocalMatrix, MAX_DENSE};
use eigenring::scheme::AnyScheme;
use eigenring::scheme::curve::CurveScheme;
use num_complex::Complex64;
use serde_json::json;
use std::fmt::Write;

/// Prints S_n, or the block B_k of it, with its labels.
#[derive(Args)]
#[command(
    after_help = "Labels: c is the centre; s:i,j is the point that lies i edges straight along spoke s and, turned \
    counter-clockwise once, j edges over. A block acts on y, where x at (s; orbit t) = y_t exp(2 pi i k s/n).\n\n\
    Examples:\n  eigenring matrix loop --valence 5\n  eigenring matrix catmull-clark -n 5 --block 1\n  \
    eigenring matrix doo-sabin -n 1000 --format mtx > doo-sabin.mtx\n  eigenring matrix b-spline --at vertex --full\n  \
    eigenring matrix b-spline --set d=4 --at spline"
)]
pub(crate) struct Matrix {
    /// A scheme of the catalogue, or the path of a scheme file
    scheme: String,
    /// The valence n
    #[arg(long, short = 'n', value_name = "N", value_parser = one_valence)]
    valence: Option<usize>,
    /// For curves: vertex, mid-edge, start or end; or spline, for H of the matrix form
    #[arg(long, value_name = "POINT", default_value = "vertex")]
    at: String,
    /// For curves: all points that decide the curve around, and not its value alone
    #[arg(long)]
    full: bool,
    /// The frequency k, 0..n-1: print the block B_k
    #[arg(long, short, value_name = "K")]
    block: Option<usize>,
    /// Set a parameter of the scheme, for example w=1/32
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// How it is printed
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Csv,
    Latex,
    Json,
    /// Matrix Market, sparse
    Mtx,
}

/// The most weights of a matrix that is printed sparsely.
const MOST_WEIGHTS: usize = 5_000_000;

/// A matrix with its labels, row by row: the entries that are not zero.
struct Labelled {
    labels: Vec<String>,
    rows: Vec<Vec<(usize, Complex64)>>,
    is_complex: bool,
}

impl Matrix {
    pub(crate) fn run(self) -> Result<(), Failure> {
        if let AnyScheme::Curve(scheme) = open_any(&self.scheme, &self.set, None)?.0 {
            return self.of_curve(&scheme);
        }
        let missing = || failure("the matrix of a scheme for surfaces needs a valence\n  help: add --valence 5");
        let valence = self.valence.ok_or_else(missing)?;
        if let Some(k) = self.block.filter(|k| *k >= valence) {
            let last = valence - 1;
            return Err(failure(format!("the blocks at n = {valence} are 0 to {last}; there is no block {k}")));
        }
        let (scheme, _) = open_checked(&self.scheme, &self.set, &[valence])?;
        let analyzer = Analyzer::new(&scheme).map_err(|obstacle| explain(&scheme, obstacle))?;
        let local = analyzer.local_matrix(valence).map_err(|obstacle| explain(&scheme, obstacle))?;
        if self.block.is_none() && self.format != Format::Mtx && local.size() > MAX_DENSE {
            let message = format!("the matrix has {} rows, more than {MAX_DENSE}", local.size());
            return Err(failure(format!(
                "{message}\n  help: print it sparsely with --format mtx, or a block with --block K"
            )));
        }
        if self.block.is_none() && local.weights() > MOST_WEIGHTS {
            let message = format!("the matrix has {} weights, more than {MOST_WEIGHTS}", local.weights());
            return Err(failure(format!("{message}\n  help: print a block with --block K")));
        }
        let matrix = match self.block {
            Some(k) => block(&local, k),
            None => whole(&local),
        };
        let name = self.block.map_or(format!("S_{valence}"), |k| format!("B_{k}"));
        print(&match self.format {
            Format::Text => text(&matrix),
            Format::Csv => csv(&matrix),
            Format::Latex => latex(&matrix, &name),
            Format::Json => json_text(&matrix, &scheme.id, Some(valence), self.block),
            Format::Mtx => market(&matrix, &name),
        })
    }
}

impl Matrix {
    fn of_curve(&self, scheme: &CurveScheme) -> Result<(), Failure> {
        if self.valence.is_some() || self.block.is_some() {
            return Err(failure(format!("{} is a scheme for curves, which have no valence", scheme.book.title)));
        }
        let (name, local) = super::curve::matrix(scheme, &self.at, self.full)?;
        let rows = local.matrix.iter().map(|row| {
            let entries = row.iter().enumerate().filter(|(_, value)| !value.is_zero());
            entries.map(|(column, value)| (column, Complex64::new(value.to_f64().value(), 0.0))).collect()
        });
        let labels = local.indices.iter().map(|index| format!("p[{index}]")).collect();
        let matrix = Labelled { labels, rows: rows.collect(), is_complex: false };
        print(&match self.format {
            Format::Text => super::curve::matrix_text(&local),
            Format::Csv => csv(&matrix),
            Format::Latex => latex(&matrix, &name),
            Format::Json => json_text(&matrix, &scheme.id, None, None),
            Format::Mtx => market(&matrix, &name),
        })
    }
}

fn whole(local: &LocalMatrix) -> Labelled {
    let label = |row: usize| {
        let label = local.label(row);
        if row == 0 && local.centre.is_some() {
            "c".to_string()
        } else {
            format!("{}:{},{}", label.sector, label.i, label.j)
        }
    };
    let row = |row: usize| local.row(row).into_iter().map(|(c, weight)| (c, Complex64::new(weight, 0.0))).collect();
    let size = local.size();
    Labelled { labels: (0..size).map(label).collect(), rows: (0..size).map(row).collect(), is_complex: false }
}

fn block(local: &LocalMatrix, k: usize) -> Labelled {
    let block = Blocks::of(local).block(k);
    let centre = (k == 0 && local.centre.is_some()).then(|| "c".to_string());
    let labels = centre.into_iter().chain(local.orbits.iter().map(|(i, j)| format!("{i},{j}"))).collect();
    let entry = |r: usize, c: usize| Some((c, block[(r, c)])).filter(|(_, value)| *value != Complex64::ZERO);
    let row = |r: usize| (0..block.ncols()).filter_map(|c| entry(r, c)).collect();
    Labelled { labels, rows: (0..block.nrows()).map(row).collect(), is_complex: k != 0 && 2 * k != local.valence() }
}

impl Labelled {
    fn dense(&self, row: usize) -> Vec<Complex64> {
        let mut dense = vec![Complex64::ZERO; self.labels.len()];
        self.rows[row].iter().for_each(|(column, value)| dense[*column] += value);
        dense
    }

    fn cell(&self, value: Complex64, decimals: usize) -> String {
        let re = format!("{:.decimals$}", value.re + 0.0);
        let im = format!("{:+.decimals$}i", value.im);
        let none = !im.contains(|c: char| c.is_ascii_digit() && c != '0');
        if self.is_complex && !none { re + &im } else { re }
    }
}

fn text(matrix: &Labelled) -> String {
    let cell = |value: Complex64| if value == Complex64::ZERO { ".".to_string() } else { matrix.cell(value, 6) };
    let rows: Vec<Vec<String>> =
        (0..matrix.labels.len()).map(|r| matrix.dense(r).into_iter().map(cell).collect()).collect();
    let longest = rows.iter().flatten().chain(&matrix.labels).map(|cell| cell.chars().count()).max().unwrap_or(1);
    let first = matrix.labels.iter().map(|label| label.chars().count()).max().unwrap_or(1);
    let line = |head: &str, row: &[String]| {
        let cells: String = row.iter().map(|cell| format!("  {cell:>longest$}")).collect();
        format!("{head:<first$}{cells}\n")
    };
    let body: String = matrix.labels.iter().zip(&rows).map(|(label, row)| line(label, row)).collect();
    line("", &matrix.labels) + &body
}

fn number(matrix: &Labelled, value: Complex64) -> String {
    if matrix.is_complex && value.im != 0.0 {
        format!("{}{:+}i", value.re, value.im)
    } else {
        (value.re + 0.0).to_string()
    }
}

fn csv(matrix: &Labelled) -> String {
    let quoted = |label: &String| format!("\"{label}\"");
    let mut text = format!("\"\",{}\n", matrix.labels.iter().map(quoted).collect::<Vec<_>>().join(","));
    for (row, label) in matrix.labels.iter().enumerate() {
        let cells: Vec<String> = matrix.dense(row).into_iter().map(|value| number(matrix, value)).collect();
        let _ = writeln!(text, "{},{}", quoted(label), cells.join(","));
    }
    text
}

fn latex(matrix: &Labelled, name: &str) -> String {
    let label = |label: &String| format!("\\scriptstyle {label}");
    let mut text =
        format!("% {name}, approximate (f64)\n\\[\n\\begin{{array}}{{r|{}}}\n", "r".repeat(matrix.labels.len()));
    let _ = writeln!(text, " & {} \\\\ \\hline", matrix.labels.iter().map(label).collect::<Vec<_>>().join(" & "));
    for (row, own) in matrix.labels.iter().enumerate() {
        let cell = |value: Complex64| if value == Complex64::ZERO { "0".to_string() } else { matrix.cell(value, 6) };
        let cells: Vec<String> = matrix.dense(row).into_iter().map(cell).collect();
        let _ = writeln!(text, "{} & {} \\\\", label(own), cells.join(" & "));
    }
    text + "\\end{array}\n\\]\n"
}

fn json_text(matrix: &Labelled, scheme: &str, n: Option<usize>, block: Option<usize>) -> String {
    let value = |value: Complex64| {
        if matrix.is_complex { json!([value.re + 0.0, value.im + 0.0]) } else { json!(value.re + 0.0) }
    };
    let rows: Vec<_> =
        (0..matrix.labels.len()).map(|row| matrix.dense(row).into_iter().map(value).collect::<Vec<_>>()).collect();
    let document =
        json!({ "format": 1, "scheme": scheme, "n": n, "block": block, "labels": matrix.labels, "rows": rows });
    format!("{document}\n")
}

fn market(matrix: &Labelled, name: &str) -> String {
    let field = if matrix.is_complex { "complex" } else { "real" };
    let size = matrix.labels.len();
    let entries: usize = matrix.rows.iter().map(Vec::len).sum();
    let mut text = format!("%%MatrixMarket matrix coordinate {field} general\n% {name}\n{size} {size} {entries}\n");
    for (row, entries) in matrix.rows.iter().enumerate() {
        for (column, value) in entries {
            let imaginary = if matrix.is_complex { format!(" {}", value.im) } else { String::new() };
            let _ = writeln!(text, "{} {} {}{imaginary}", row + 1, column + 1, value.re);
        }
    }
    text
}
