//! What can be proved of a scheme for every valence at once?

use super::analyze::explain;
use super::open::open;
use super::{Failure, print};
use clap::Args;
use eigenring::analysis::Analyzer;
use eigenring::proof::map::{MapProof, prove};
use eigenring::proof::outcome::Outcome;
use eigenring::refine;
use std::fmt::Write;

/// Proves what can be proved for every valence at once: so far that the characteristic map is regular and injective. The order of the eigenvalues,
/// which C1 needs as well, is decided by `analyze` at each valence and not yet for all of them.
#[derive(Args)]
#[command(after_help = "Examples:\n  eigenring certify loop\n  eigenring certify my-scheme.toml --set w=1/32")]
pub(crate) struct Certify {
    /// A scheme of the catalogue, or the path of a scheme file
    scheme: String,
    /// Set a parameter of the scheme, for example w=1/32; may be given several times
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
}

impl Certify {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let scheme = open(&self.scheme, &self.set)?;
        let valences: Vec<usize> = (3..=12).collect();
        refine::check(&scheme, &valences)?;
        let analyzer = Analyzer::new(&scheme).map_err(|obstacle| explain(&scheme, obstacle))?;
        let mut text = format!("{}, every valence at once\n", scheme.book.title);
        let _ = match prove(&analyzer) {
            Outcome::Proved(MapProof { valences, functions, degree, .. }) => writeln!(
                text,
                "  characteristic map: proved regular and injective for {valences}, in exact arithmetic\n    \
                 ({functions} rational functions of degree at most {degree} are positive on an interval)"
            ),
            Outcome::Refuted { witness } => writeln!(text, "  characteristic map: refuted; {witness}"),
            Outcome::Undecided { at } => writeln!(text, "  characteristic map: undecided; {at}"),
        };
        text.push_str(
            "  C1: undecided; that the subdominant eigenvalue leads at every n is not proved yet, `eigenring analyze` decides it at each\n",
        );
        print(&text)
    }
}
