//! What would a person like to see?
//!
//! The report of a scheme: its [`model`] is plain data, from which tables, pictures and files are made. Committed output
//! must not see the machine: no time, no path, no order that depends on hashing.

pub mod boundary;
mod certificate;
mod csv;
pub mod curve;
mod files;
pub mod formulas;
mod latex;
mod markdown;
pub mod model;
pub mod plots;
pub mod ranges;
pub mod regular;
mod study;
pub mod sweep;
mod tables;
mod terminal;

pub use certificate::certificate;
pub use csv::csv;
pub use files::{write_all_whole, write_in_pieces, write_whole};
pub use latex::latex;
pub use markdown::markdown;
pub use model::Report;
pub use plots::{Picture, pictures, png, sweep_picture};
pub use study::{ATLAS, DIGITS, MAX_DIGITS, NoReport, Study, atlas};
pub use tables::{Cell, Table, tables, verdict_word};
pub use terminal::terminal;

/// A picture's place in a document.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The stem of its file.
    pub name: String,
    /// What is seen.
    pub caption: String,
    /// The title of the table that it follows.
    pub belongs_to: &'static str,
}

impl Figure {
    /// Where a picture goes.
    pub fn of(picture: &Picture) -> Figure {
        let belongs_to = match picture.name {
            "eigenvalues" => "Largest eigenvalue by frequency",
            "curvature" => "Subdominant eigenvalues and curvature",
            "masks" => "Tangent masks",
            "sweep" => sweep::TITLE,
            _ => "Conditions",
        };
        Figure { name: picture.name.to_string(), caption: picture.caption.clone(), belongs_to }
    }
}

/// The report as JSON, by the contract of the README.
///
/// # Errors
/// When a number is not finite, which the analysis excludes.
pub fn json(report: &Report) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(report).map(|text| text + "\n")
}

/// The report's texts as (file name, text): Markdown, LaTeX, CSV and JSON, and the certificate where there is one.
///
/// # Errors
/// As [`json`].
pub fn texts(report: &Report, figures: &[Figure]) -> Result<Vec<(String, String)>, serde_json::Error> {
    let name = |ending: &str| format!("{}.{ending}", report.scheme);
    let mut texts = vec![
        (name("md"), markdown(report, figures)),
        (name("tex"), latex(report, figures)),
        (name("csv"), csv(report)),
        (name("json"), json(report)?),
    ];
    texts.extend(report.certificate.iter().map(|own| (own.file.clone(), own.text.clone())));
    Ok(texts)
}
