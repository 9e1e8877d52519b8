//! `analyze`: what does this scheme do, at these valences?

use super::open::{BoundaryRules, open_any};
use super::valences::{Faces, Valences};
use super::{Failure, failure, print};
use clap::{Args, ValueEnum};
use eigenring::refine::Obstacle;
use eigenring::report::boundary::{self, Variant};
use eigenring::report::curve::{self, Document};
use eigenring::report::ranges;
use eigenring::report::sweep::{self, Sweep, SweepRequest};
use eigenring::report::{self, NoReport, Picture, Report, Study};
use eigenring::scheme::{AnyScheme, Interval, Scheme};
use indicatif::{ProgressBar, ProgressStyle};
use std::fs;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  eigenring analyze loop --valence 3..12
  eigenring analyze my-scheme.toml --valence 3,4,7..9,50 --out my-report
  eigenring analyze modified-butterfly --set w=1/64 --format md
  eigenring analyze catmull-clark --valence 5 --boundary 1..6 --format json | less
  eigenring analyze loop --boundary 1..8 --boundary-rules all
  eigenring analyze four-point --set w=1/16
  eigenring analyze bicubic";

/// Analyses a scheme and writes its report: Markdown, LaTeX, CSV, JSON, and pictures as SVG and PNG.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Analyze {
    /// A scheme of the catalogue, or the path of a scheme file
    scheme: String,
    /// Valences: 3..12 (both included), or a list such as 3,4,7..9,50 [default: 3..12]
    #[arg(long, short = 'n', value_name = "LIST")]
    valence: Option<Valences>,
    /// Set a parameter of the scheme, for example w=1/32; may be given several times
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Leave a parameter free in what is exact: eigenvalues as functions of it; one or two, such as w,v
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    symbolic: Vec<String>,
    /// Tabulate and plot lambda, mu and their ratio against a parameter: w=0..1/8, or with a number of steps w=0..1/8:32
    #[arg(long, value_name = "NAME=LOW..HIGH", value_parser = SweepRequest::parse)]
    sweep: Option<SweepRequest>,
    /// Find the values of a parameter for which spectral conditions hold, exactly: w=0..1/4
    #[arg(long, value_name = "NAME=LOW..HIGH", value_parser = Interval::parse)]
    range: Option<Interval>,
    /// For curves, the claim that --range looks at: C0, C1, C2, ... [default: C1]
    #[arg(long, value_name = "CLAIM", requires = "range", value_parser = continuity)]
    claim: Option<usize>,
    /// Add what the scheme does at boundaries, creases, corners and darts, for these numbers of faces: 1..8, or a list
    #[arg(long, value_name = "LIST")]
    boundary: Option<Faces>,
    #[command(flatten)]
    rules: BoundaryRules,
    /// The folder that the report is written into [default: reports/SCHEME]
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one form of the report on standard output and write no files
    #[arg(long, value_enum, conflicts_with_all = ["out", "no_pictures"])]
    format: Option<Format>,
    /// Write no pictures
    #[arg(long)]
    no_pictures: bool,
    /// The number of decimals; those of exact and enclosed numbers are all right
    #[arg(long, default_value_t = report::DIGITS as u16, value_parser = clap::value_parser!(u16).range(1..=report::MAX_DIGITS as i64))]
    digits: u16,
}

/// The forms of a report.
#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Json,
    Csv,
    Md,
    Latex,
}

impl Analyze {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let (scheme, variants) = open_any(&self.scheme, &self.set, Some(&self.rules))?;
        match scheme {
            AnyScheme::Surface(scheme) => self.surface(*scheme, variants),
            AnyScheme::Curve(scheme) => {
                self.only_for_surfaces("curves")?;
                let range = |interval: &Interval| {
                    let found = curve::range::range(&scheme, interval, self.claim.unwrap_or(1));
                    found.map_err(|why| failure(format!("{}: {why}", scheme.book.title)))
                };
                let range = self.range.as_ref().map(range).transpose()?;
                let draw = !self.no_pictures && self.format.is_none();
                self.document(&curve::curve(&scheme, range, self.digits.into(), draw)?)
            }
            AnyScheme::Grid(scheme) => {
                self.only_for_surfaces("grids")?;
                self.document(&curve::grid(&scheme)?)
            }
        }
    }

    /// Options that make no sense for other schemes are refused.
    fn only_for_surfaces(&self, kind: &str) -> Result<(), Failure> {
        let asked = [
            ("--symbolic", !self.symbolic.is_empty()),
            ("--sweep", self.sweep.is_some()),
            ("--range", self.range.is_some() && kind == "grids"),
            ("--boundary", self.boundary.is_some()),
            ("--valence", self.valence.is_some()),
        ];
        match asked.iter().find(|(_, asked)| *asked) {
            Some((option, _)) => Err(failure(format!("{option} is for surfaces; this is a scheme for {kind}"))),
            None => Ok(()),
        }
    }

    /// Prints or writes the report of a curve or a grid.
    fn document(&self, document: &Document) -> Result<(), Failure> {
        match self.format {
            Some(Format::Json) => print(&document.json),
            Some(Format::Csv) => print(&document.csv()),
            Some(Format::Md) => print(&document.markdown()),
            Some(Format::Latex) => print(&document.latex()),
            None => {
                let folder = self.out.clone().unwrap_or_else(|| Path::new("reports").join(&document.scheme));
                let texts = document.texts().into_iter().map(|(name, text)| (name, text.into_bytes())).collect();
                let written = write_files(texts, &document.pictures, &folder)?;
                print(&format!("{}\n{}", document.terminal, files_line(&folder, &written)))
            }
        }
    }

    fn surface(self, mut scheme: Scheme, variants: Vec<Variant>) -> Result<(), Failure> {
        if self.claim.is_some() {
            return Err(failure("--claim is for curves; this is a scheme for surfaces".to_string()));
        }
        let valences = self.valence.as_ref().map_or_else(|| (3..=12).collect(), |list| list.0.clone());
        self.symbolic.iter().try_for_each(|name| scheme.leave_free(name.trim())).map_err(failure)?;
        let draw = !self.no_pictures && self.format.is_none();
        let bar = progress_bar(&valences);
        let bar = if bar.is_hidden() { spinner("analysing, and deciding C1 for every valence") } else { bar };
        let study = Study::with_digits(&scheme, &valences, self.digits.into(), draw, &|| bar.inc(1));
        bar.finish_and_clear();
        let study = study.map_err(|error| explain(&scheme, error))?;
        let mut study = study;
        if let Some(request) = &self.sweep {
            add_sweep(&mut study, &scheme, &valences, request, draw)?;
        }
        if let Some(interval) = &self.range {
            let bar = progress_bar(&valences);
            let found = ranges::ranges(&scheme, &valences, interval, &|| bar.inc(1));
            bar.finish_and_clear();
            study.report.ranges = found.map_err(failure)?;
        }
        if let Some(faces) = &self.boundary {
            let bar = progress_bar(&faces.0);
            if variants.is_empty() && self.rules.are_none() {
                return Err(failure(
                    "--boundary needs boundary rules, and --boundary-rules none takes none".to_string(),
                ));
            } else if variants.is_empty() {
                return Err(explain(&scheme, boundary::no_boundary_file(&scheme)));
            }
            let found = boundary::boundary(&scheme, &variants, &faces.0, self.digits.into(), &|| bar.inc(1));
            bar.finish_and_clear();
            study.report.add_boundary(found.map_err(|error| explain(&scheme, error))?);
        }
        match self.format {
            Some(format) => print(&one_form(&study.report, format)?),
            None => {
                let folder = self.out.unwrap_or_else(|| Path::new("reports").join(&scheme.id));
                let written = write(&study, &folder)?;
                let sweep = study.report.sweep.as_ref().map_or(String::new(), sweep::terminal);
                let added =
                    boundary::terminal(&study.report.boundary) + &ranges::terminal(&study.report.ranges) + &sweep;
                print(&format!("{}{added}\n{}", report::terminal(&study.report), files_line(&folder, &written)))
            }
        }
    }
}

/// The sweep with its picture.
fn add_sweep(
    study: &mut Study,
    scheme: &Scheme,
    valences: &[usize],
    request: &SweepRequest,
    draw: bool,
) -> Result<(), Failure> {
    let sweep = Sweep::of(scheme, valences, request).map_err(failure)?;
    if draw {
        study.pictures.push(report::sweep_picture(&sweep).map_err(|obstacle| explain(scheme, obstacle))?);
    }
    study.report.sweep = Some(sweep);
    Ok(())
}

/// A sign on a terminal that work goes on.
pub(crate) fn spinner(words: &'static str) -> ProgressBar {
    let spinner = ProgressBar::new_spinner().with_message(words);
    spinner.enable_steady_tick(std::time::Duration::from_millis(120));
    spinner
}

/// A bar on a terminal, when the work takes long enough to ask for one.
fn progress_bar(valences: &[usize]) -> ProgressBar {
    if valences.iter().sum::<usize>() < 500 {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(valences.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} valences, {eta} left") {
        bar.set_style(style);
    }
    bar
}

/// What stood in the way, in words; faults with their place in the scheme file.
pub(crate) fn explain(scheme: &Scheme, error: impl Into<NoReport>) -> Failure {
    match error.into() {
        NoReport::Faults(faults) => Failure::Faults(faults),
        NoReport::Obstacle(Obstacle::Fault(fault)) => Failure::Faults(scheme.book.faults(vec![fault])),
        NoReport::Obstacle(other) => failure(format!("{}: {other}", scheme.book.title)),
    }
}

fn one_form(report: &Report, format: Format) -> Result<String, Failure> {
    Ok(match format {
        Format::Json => report::json(report).map_err(|error| failure(error.to_string()))?,
        Format::Csv => one_csv(report),
        Format::Md => report::markdown(report, &[]),
        Format::Latex => report::latex(report, &[]),
    })
}

/// One table: that of the sweep or of the boundary, where one is asked for.
fn one_csv(report: &Report) -> String {
    match &report.sweep {
        Some(sweep) => sweep::sweep_csv(sweep),
        None if !report.boundary.is_empty() => boundary::boundary_csv(&report.boundary),
        None => report::csv(report),
    }
}

/// Writes every file of the report; gives their names.
fn write(study: &Study, folder: &Path) -> Result<Vec<String>, Failure> {
    let pictures = &study.pictures;
    let texts = report::texts(&study.report, &study.figures()).map_err(|error| failure(error.to_string()))?;
    let mut files: Vec<(String, Vec<u8>)> = texts.into_iter().map(|(name, text)| (name, text.into_bytes())).collect();
    if let Some(sweep) = &study.report.sweep {
        files.push(("sweep.csv".to_string(), sweep::sweep_csv(sweep).into_bytes()));
    }
    if !study.report.boundary.is_empty() {
        files.push(("boundary.csv".to_string(), boundary::boundary_csv(&study.report.boundary).into_bytes()));
    }
    let written = write_files(files, pictures, folder)?;
    let stale = folder.join(study.report.certificate_file());
    if study.report.certificate.is_none() && stale.is_file() {
        let trouble =
            |error| failure(format!("`{}` is an old certificate and can't be removed: {error}", stale.display()));
        fs::remove_file(&stale).map_err(trouble)?;
    }
    Ok(written)
}

/// Writes texts, and pictures as SVG and PNG, into a folder; gives their names.
fn write_files(mut files: Vec<(String, Vec<u8>)>, pictures: &[Picture], folder: &Path) -> Result<Vec<String>, Failure> {
    for (picture, png) in pictures.iter().zip(painted(pictures)) {
        let png = png.map_err(|error| failure(format!("the picture {}: {error}", picture.name)))?;
        files.push((format!("{}.svg", picture.name), picture.svg.clone().into_bytes()));
        files.push((format!("{}.png", picture.name), png));
    }
    let trouble =
        |what: &Path, error: std::io::Error| failure(format!("`{}` can't be written: {error}", what.display()));
    fs::create_dir_all(folder).map_err(|error| trouble(folder, error))?;
    let placed: Vec<(PathBuf, &[u8])> = files.iter().map(|(name, bytes)| (folder.join(name), &bytes[..])).collect();
    report::write_all_whole(&placed).map_err(|(path, error)| trouble(&path, error))?;
    Ok(files.into_iter().map(|(name, _)| name).collect())
}

/// The pictures as PNG, side by side on as many threads.
fn painted(pictures: &[Picture]) -> Vec<Result<Vec<u8>, String>> {
    std::thread::scope(|scope| {
        let threads: Vec<_> = pictures.iter().map(|picture| scope.spawn(|| report::png(&picture.svg))).collect();
        let painted = threads.into_iter().map(|thread| thread.join());
        painted.map(|result| result.unwrap_or_else(|_| Err("it could not be painted".to_string()))).collect()
    })
}

fn files_line(folder: &Path, names: &[String]) -> String {
    let mut text = format!("Written to {}:\n ", folder.display());
    let mut length = 1;
    for name in names {
        if length + name.len() + 1 > 78 {
            text.push_str("\n ");
            length = 1;
        }
        text.push(' ');
        text.push_str(name);
        length += name.len() + 1;
    }
    text + "\n"
}

/// The m of `Cm`.
fn continuity(text: &str) -> Result<usize, String> {
    let m = text.strip_prefix('C').and_then(|m| m.parse().ok()).filter(|m| *m <= 16);
    m.ok_or_else(|| format!("`{text}` is not a claim of continuity from C0 to C16"))
}
