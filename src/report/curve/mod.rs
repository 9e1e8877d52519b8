//! What does the report of a scheme for curves say?
//!
//! The same form as for a surface: plain data, tables, pictures, and one JSON document by the README's contract, with `"kind": "curve"`.

mod document;
mod grid;
mod model;
pub mod range;
mod smoothness;
mod tables;
mod terminal;

pub use document::Document;
pub use grid::grid;
pub use model::{CurvePointReport, CurveReport, WeightAt};
pub use smoothness::SmoothnessReport;

use range::RangeReport;

use super::plots::curve_pictures;
use crate::analysis::curve::point::{points_of_halves, points_of_mask};
use crate::fault::Faults;
use crate::scheme::curve::{CurveScheme, Rules};

/// Why there is no report.
#[derive(Clone, Debug)]
pub enum NoCurveReport {
    /// Faults of the scheme file.
    Faults(Faults),
    /// Anything else, in words.
    Words(String),
}

/// The report of a scheme for curves, with what is known on an interval of a parameter if that was looked at, and with its pictures if they are
/// wanted.
///
/// # Errors
/// Faults of the scheme file, or what stood in the way.
pub fn curve(
    scheme: &CurveScheme,
    range: Option<RangeReport>,
    digits: usize,
    draw: bool,
) -> Result<Document, NoCurveReport> {
    let rules = scheme.rules().map_err(NoCurveReport::Faults)?;
    let points = match &rules {
        Rules::Mask(mask, ends) => points_of_mask(mask, ends.as_ref()),
        Rules::Halves(halves) => points_of_halves(halves),
    };
    let points = points.map_err(|trouble| NoCurveReport::Words(trouble.to_string()))?;
    let report = CurveReport { range, ..CurveReport::new(scheme, &rules, &points, digits)? };
    let pictures = if draw { curve_pictures(&rules, &points) } else { Ok(Vec::new()) };
    let pictures = pictures.map_err(|obstacle| NoCurveReport::Words(obstacle.to_string()))?;
    document::of_curve(&report, pictures)
}
