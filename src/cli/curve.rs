//! What do the commands do with a scheme for curves or a grid?
//!
//! `analyze`, `refine`, `limit` and `matrix` come here when the scheme is none for surfaces.

use super::{Failure, failure, say};
use eigenring::analysis::curve::limit::CurveLimits;
use eigenring::analysis::curve::local::LocalMatrix;
use eigenring::analysis::curve::matrix_form::{matrix_form, spline_degree};
use eigenring::analysis::curve::point::{CurvePoint, points_of_halves, points_of_mask};
use eigenring::mesh::Polygon;
use eigenring::mesh::io::curve::{CurveFormat, Style, read, write};
use eigenring::refine::curve::{CurveRefiner, MAX_REFINED, NotRefinableCurve};
use eigenring::report::curve::NoCurveReport;
use eigenring::report::write_in_pieces;
use eigenring::scheme::curve::{CurveScheme, Rules};
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::time::Instant;

impl From<NoCurveReport> for Failure {
    fn from(error: NoCurveReport) -> Failure {
        match error {
            NoCurveReport::Faults(faults) => Failure::Faults(faults),
            NoCurveReport::Words(words) => failure(words),
        }
    }
}

pub(crate) fn format_of(path: &Path) -> Result<CurveFormat, Failure> {
    CurveFormat::of_path(path).ok_or_else(|| {
        let endings: Vec<&str> = CurveFormat::ALL.into_iter().map(CurveFormat::ending).collect();
        let endings = endings.join(", .");
        failure(format!("`{}` names no format of polygons; its ending should be one of .{endings}", path.display()))
    })
}

pub(crate) fn load(path: &Path, closed: bool) -> Result<Vec<Polygon>, Failure> {
    let name = path.display();
    let format = format_of(path)?;
    match path.metadata() {
        Err(error) => return Err(failure(format!("`{name}` can't be opened: {error}"))),
        Ok(metadata) if !metadata.is_file() => return Err(failure(format!("`{name}` is not a file of polygons"))),
        Ok(metadata) => super::memory::check(u128::from(metadata.len()) * 8, &format!("reading `{name}`"), "")?,
    }
    let bytes = fs::read(path).map_err(|error| failure(format!("`{name}` can't be read: {error}")))?;
    let polygons = read(format, &bytes, closed).map_err(|wrong| failure(format!("`{name}`, {wrong}")))?;
    for (index, polygon) in polygons.iter().enumerate().filter(|(_, polygon)| polygon.coincident() > 0) {
        let count = polygon.coincident();
        say(&format!(
            "note: `{name}`: polygon {index}: {count} points coincide with the one before them; they are kept"
        ));
    }
    Ok(polygons)
}

/// Refines the polygons of a file, or pushes their points to the limit.
pub(crate) fn refine(
    scheme: &CurveScheme,
    (input, out): (&Path, &Path),
    closed: bool,
    levels: usize,
    to_limit: bool,
) -> Result<(), Failure> {
    let format = format_of(out)?;
    let polygons = load(input, closed)?;
    let rules = scheme.rules()?;
    let refiner = CurveRefiner::new(&rules);
    let limits = if to_limit { Some(CurveLimits::new(&rules).map_err(failure)?) } else { None };
    check_size(&refiner, &polygons, levels)?;
    let start = Instant::now();
    let refused = |wrong: NotRefinableCurve| refused(scheme, &rules, wrong);
    let mut refined = Vec::with_capacity(polygons.len());
    for polygon in &polygons {
        let mut points = refiner.steps(&polygon.points, polygon.closed, levels).map_err(refused)?;
        if let Some(limits) = &limits {
            points = limits.of(&points, polygon.closed).map_err(refused)?;
        }
        refined.push(Polygon { points, ..polygon.clone() });
    }
    let time = start.elapsed().as_secs_f64();
    let count: usize = refined.iter().map(|polygon| polygon.points.len()).sum();
    let before: usize = polygons.iter().map(|polygon| polygon.points.len()).sum();
    say(&format!("{}: {} polygons, {before} points become {count}, in {time:.3} s", scheme.book.title, polygons.len()));
    let style = Style { upwards: CurveFormat::of_path(input) != Some(CurveFormat::Svg) };
    write_in_pieces(out, |file| write(format, &refined, style, file))
        .map_err(|error| failure(format!("`{}` can't be written: {error}", out.display())))
}

fn check_size(refiner: &CurveRefiner, polygons: &[Polygon], levels: usize) -> Result<(), Failure> {
    let points: u128 = polygons.iter().map(|polygon| polygon.points.len() as u128).sum();
    let after = |levels: usize| (refiner.arity() as u128).saturating_pow(levels as u32).saturating_mul(points);
    let bytes = |levels: usize| after(levels).saturating_mul(24 * 2);
    let available = super::memory::available();
    let fits = |levels: usize| after(levels) <= MAX_REFINED as u128 && available.is_none_or(|all| bytes(levels) <= all);
    let most = (0..=levels).rev().find(|levels| fits(*levels)).unwrap_or(0);
    if most == levels {
        return Ok(());
    }
    let help = format!("--levels {most} fits");
    if after(levels) > MAX_REFINED as u128 {
        let message = format!("{levels} steps make {} points, more than {MAX_REFINED}", after(levels));
        return Err(failure(format!("{message}\n  help: {help}")));
    }
    super::memory::check(bytes(levels), &format!("a polygon of {} points", after(levels)), &help)
}

fn refused(scheme: &CurveScheme, rules: &Rules, wrong: NotRefinableCurve) -> Failure {
    let help = match (&wrong, rules) {
        (NotRefinableCurve::Pieces { points, .. }, _) if scheme.book.parameters.iter().any(|p| p.name == "d") => {
            format!("\n  help: --set d={} takes all of it as one piece", points.saturating_sub(1))
        }
        (NotRefinableCurve::TooFew { .. }, Rules::Mask(_, None)) => {
            "\n  help: close the polygon with --closed, or take a scheme with rules for its ends".to_string()
        }
        (NotRefinableCurve::Closed, _) => {
            "\n  help: leave --closed out, and repeat the first point at the end".to_string()
        }
        _ => String::new(),
    };
    failure(format!("{}: {wrong}{help}", scheme.book.title))
}

/// The local matrix at a marked point, or the matrix H, as text.
pub(crate) fn matrix(scheme: &CurveScheme, at: &str, full: bool) -> Result<(String, LocalMatrix), Failure> {
    let rules = scheme.rules()?;
    if at == "spline" {
        let degree = if let Rules::Mask(mask, _) = &rules { spline_degree(mask) } else { None };
        let none = || {
            failure(format!("{}: the mask is that of no binary B-spline, so it has no matrix form", scheme.book.title))
        };
        let form = matrix_form(degree.ok_or_else(none)?).map_err(|trouble| failure(trouble.to_string()))?;
        let indices = (0..form.first_half.len() as i64).collect();
        return Ok(("H".to_string(), LocalMatrix { indices, matrix: form.first_half, steps: 1 }));
    }
    let points = match &rules {
        Rules::Mask(mask, ends) => points_of_mask(mask, ends.as_ref()),
        Rules::Halves(halves) => points_of_halves(halves),
    };
    let points: Vec<CurvePoint> = points.map_err(|trouble| failure(trouble.to_string()))?;
    let known: Vec<&str> = points.iter().map(|point| point.at.name()).collect();
    let found = points.iter().find(|point| point.at.name() == at);
    let found = found
        .ok_or_else(|| failure(format!("{} has no point `{at}`; it has {}", scheme.book.title, known.join(", "))))?;
    Ok(("S".to_string(), if full { found.full.clone() } else { found.minimal.clone() }))
}

/// A rational matrix with its labels.
pub(crate) fn matrix_text(local: &LocalMatrix) -> String {
    let labels: Vec<String> = local.indices.iter().map(|index| format!("p[{index}]")).collect();
    let cell = |value: &dashu_ratio::RBig| if value.is_zero() { ".".to_string() } else { value.to_string() };
    let rows: Vec<Vec<String>> = local.matrix.iter().map(|row| row.iter().map(cell).collect()).collect();
    let longest = rows.iter().flatten().chain(&labels).map(|cell| cell.chars().count()).max().unwrap_or(1);
    let line = |head: &str, row: &[String]| {
        let cells: String = row.iter().map(|cell| format!("  {cell:>longest$}")).collect();
        format!("{head:<longest$}{cells}\n")
    };
    let mut text = line("", &labels);
    for (label, row) in labels.iter().zip(&rows) {
        let _ = write!(text, "{}", line(label, row));
    }
    text
}
