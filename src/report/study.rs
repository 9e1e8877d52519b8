//! From a scheme and a list of valences to its report, in one call.

use super::plots::{Picture, pictures};
use super::{Figure, Report, texts};
use crate::analysis::Analyzer;
use crate::fault::Faults;
use crate::refine::{self, Obstacle};
use crate::scheme::{Scheme, catalogue};
use std::fmt;

/// A report with its pictures.
#[derive(Clone, Debug)]
pub struct Study {
    /// The report.
    pub report: Report,
    /// The pictures.
    pub pictures: Vec<Picture>,
}

/// Why there is no report.
#[derive(Clone, Debug, PartialEq)]
pub enum NoReport {
    /// Faults of the scheme file.
    Faults(Faults),
    /// Anything else.
    Obstacle(Obstacle),
}

impl fmt::Display for NoReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoReport::Faults(faults) => write!(f, "{faults}"),
            NoReport::Obstacle(obstacle) => write!(f, "{obstacle}"),
        }
    }
}

impl std::error::Error for NoReport {}

impl From<Obstacle> for NoReport {
    fn from(obstacle: Obstacle) -> Self {
        NoReport::Obstacle(obstacle)
    }
}

impl NoReport {
    /// Faults keep their place in the scheme file.
    pub(super) fn of(scheme: &Scheme) -> impl Fn(Obstacle) -> NoReport + '_ {
        |obstacle| match obstacle {
            Obstacle::Fault(fault) => NoReport::Faults(scheme.book.faults(vec![fault])),
            other => NoReport::Obstacle(other),
        }
    }
}

impl Study {
    /// Checks the scheme, analyses it at the valences, judges the conditions and draws the pictures (if wanted). `done` is
    /// called after each valence.
    ///
    /// # Errors
    /// Faults of the scheme file, or what stood in the way.
    pub fn of(scheme: &Scheme, valences: &[usize], draw: bool, done: &dyn Fn()) -> Result<Study, NoReport> {
        Study::with_digits(scheme, valences, DIGITS, draw, done)
    }

    /// The same with another number of decimals, up to [`MAX_DIGITS`].
    ///
    /// # Errors
    /// As [`Study::of`].
    pub fn with_digits(
        scheme: &Scheme,
        valences: &[usize],
        digits: usize,
        draw: bool,
        done: &dyn Fn(),
    ) -> Result<Study, NoReport> {
        let place = NoReport::of(scheme);
        let sums = refine::check(scheme, valences).map_err(NoReport::Faults)?;
        let analyzer = Analyzer::new(scheme).map_err(&place)?;
        let mut analyses = Vec::with_capacity(valences.len());
        for valence in valences {
            analyses.push(analyzer.at(*valence).map_err(&place)?);
            done();
        }
        let pictures = if draw { pictures(&analyzer, &analyses).map_err(&place)? } else { Vec::new() };
        let report = Report::new(scheme, &analyzer, analyses, &sums, digits.min(MAX_DIGITS)).map_err(&place)?;
        Ok(Study { report, pictures })
    }

    /// Where the pictures go in a document.
    pub fn figures(&self) -> Vec<Figure> {
        self.pictures.iter().map(Figure::of).collect()
    }
}

/// The decimals of a report, unless others are asked for.
pub const DIGITS: usize = 10;

/// The most decimals: values are enclosed a little more narrowly.
pub const MAX_DIGITS: usize = 100;

/// The schemes whose reports are committed under `reports/atlas/`.
pub const ATLAS: [&str; 5] = ["loop", "loop-warren", "catmull-clark", "doo-sabin", "catmull-clark-biquadratic"];

/// The committed files of one of them, for n = 3..12: Markdown, JSON and SVG.
///
/// # Errors
/// Why the report can't be made; a name that the catalogue doesn't have among them.
pub fn atlas(id: &str) -> Result<Vec<(String, String)>, Box<dyn std::error::Error>> {
    let scheme = catalogue::open(id).ok_or_else(|| format!("there is no scheme `{id}`"))??;
    let study = Study::of(&scheme, &(3..=12).collect::<Vec<_>>(), true, &|| ())?;
    let mut files = texts(&study.report, &study.figures())?;
    files.retain(|(name, _)| name.ends_with(".md") || name.ends_with(".json"));
    files.extend(study.pictures.iter().map(|picture| (format!("{}.svg", picture.name), picture.svg.clone())));
    Ok(files)
}
