//! `certify`: are limit surfaces C1, proved for every valence?

use super::analyze::{explain, spinner};
use super::open::open;
use super::valences::Valences;
use super::{Failure, failure, print, say};
use clap::Args;
use eigenring::analysis::Analyzer;
use eigenring::proof::c1::Proofs;
use eigenring::refine;
use eigenring::report::{certificate, write_whole};
use eigenring::verdicts::EveryValence;
use std::fmt::Write;
use std::path::{Path, PathBuf};

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
    /// Write a certificate for every valence, which `eigenring check` checks again; of schemes of a single pass without
    /// parameters whose maps are proved by exact polynomials
    #[arg(long, value_name = "FILE", conflicts_with = "valence")]
    certificate: Option<PathBuf>,
}

/// Valences at which rules are checked where none are asked for.
const CHECKED: std::ops::RangeInclusive<usize> = 3..=12;

impl Certify {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let scheme = open(&self.scheme, &self.set)?;
        let checked = self.valence.as_ref().map_or_else(|| CHECKED.collect(), |list| list.0.clone());
        let sums = refine::check(&scheme, &checked)?;
        let analyzer = Analyzer::new(&scheme).map_err(|obstacle| explain(&scheme, obstacle))?;
        let busy = spinner("deciding C1");
        let proofs = Proofs::of(&analyzer);
        let found = match &self.valence {
            Some(list) => EveryValence::only(&proofs, &sums, &list.0),
            None => EveryValence::of(&proofs, &sums, &|_| None),
        };
        busy.finish_and_clear();
        print(&in_words(&scheme.book.title, &found))?;
        if !found.is_proved() {
            if let Some(path) = &self.certificate {
                say(&format!("no certificate is written to {}: C1 is not proved for every n >= 3", path.display()));
            }
            return Err(Failure::No);
        }
        self.certificate.as_ref().map_or(Ok(()), |path| write(&proofs, path))
    }
}

fn in_words(title: &str, found: &EveryValence) -> String {
    let mut text = format!("{title}\n  C1 for generic control points: {}\n", found.statement);
    for stretch in &found.stretches {
        let _ = writeln!(text, "  {}: {}; {}", stretch.valences(), stretch.verdict.word(), stretch.why.join("; "));
    }
    text
}

/// Writes the certificate, if there is one that the checker accepts.
fn write(proofs: &Proofs, path: &Path) -> Result<(), Failure> {
    let text = certificate(proofs)
        .map_err(|why| failure(format!("it is proved, but there is no certificate of it: {why}")))?;
    write_whole(path, text.as_bytes()).map_err(|error| failure(format!("{}: {error}", path.display())))?;
    print(&format!("  {}: a certificate for every n >= 3, checked\n", path.display()))
}
