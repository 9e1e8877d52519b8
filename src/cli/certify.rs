//! `certify`: are limit surfaces C1, proved for every valence?

use super::analyze::explain;
use super::certificate::write;
use super::open::open;
use super::valences::Valences;
use super::{Failure, print};
use clap::Args;
use eigenring::analysis::Analyzer;
use eigenring::proof::c1::Proofs;
use eigenring::refine;
use eigenring::scheme::Scheme;
use eigenring::verdicts::EveryValence;
use std::fmt::Write;
use std::path::PathBuf;

/// Decides whether limit surfaces are C1 at extraordinary points, for generic control points: proved, refuted, or undecided with
/// the place where the proof got stuck.
#[derive(Args)]
#[command(after_help = "Exit status 1: it is not proved at every valence asked for.\n\n\
    Examples:\n  eigenring certify loop\n  eigenring certify my-scheme.toml --set w=1/32\n  eigenring certify butterfly --valence 3..8\n  eigenring certify loop --certificate loop.json")]
pub(crate) struct Certify {
    /// A scheme of the catalogue, or the path of a scheme file
    scheme: String,
    /// Every valence at once, which is what is done where no list is given
    #[arg(long, conflicts_with = "valence")]
    all_valences: bool,
    /// These valences only: 3..12 (both included), or a list such as 3,4,7..9,50
    #[arg(long, short = 'n', value_name = "LIST")]
    valence: Option<Valences>,
    /// Set a parameter of the scheme, for example w=1/32; may be given several times
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Write a certificate for every valence, which `eigenring check` checks again
    #[arg(long, value_name = "FILE", conflicts_with = "valence")]
    certificate: Option<PathBuf>,
}

/// Valences at which rules are checked where none are asked for.
const CHECKED: std::ops::RangeInclusive<usize> = 3..=12;

impl Certify {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let scheme = open(&self.scheme, &self.set)?;
        let found = self.found(&scheme)?;
        let mut text = format!("{}\n  C1 for generic control points: {}\n", scheme.book.title, found.statement);
        for stretch in &found.stretches {
            let _ = writeln!(text, "  {}: {}; {}", stretch.valences(), stretch.verdict.word(), stretch.why.join("; "));
        }
        print(&text)?;
        if let Some(path) = self.certificate.as_ref().filter(|_| found.is_proved()) {
            print(&write(&self.scheme, &scheme, path)?)?;
        }
        if found.is_proved() { Ok(()) } else { Err(Failure::No) }
    }

    fn found(&self, scheme: &Scheme) -> Result<EveryValence, Failure> {
        let checked = self.valence.as_ref().map_or_else(|| CHECKED.collect(), |list| list.0.clone());
        let sums = refine::check(scheme, &checked)?;
        let told = |obstacle| explain(scheme, obstacle);
        let analyzer = Analyzer::new(scheme).map_err(told)?;
        let proofs = Proofs::of(&analyzer);
        match &self.valence {
            Some(list) => EveryValence::only(&proofs, &sums, &list.0).map_err(told),
            None => EveryValence::of(&proofs, &sums, &|_| None).map_err(told),
        }
    }
}
