//! Does a certificate prove what it claims?

use super::open::text;
use super::{Failure, failure, print};
use clap::Args;
use eigenring_check::{check, read};
use std::path::PathBuf;

/// Checks a certificate of C1 again, by a program that shares no code with the prover: rules, eigenvalues and
/// characteristic maps, in rational arithmetic. What it can't check it doesn't accept, which says nothing against a
/// scheme.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  eigenring check loop.json\n  eigenring check loop.json --scheme my-scheme.toml\n\n\
                        Exit status: 0 accepted, 1 rejected, 2 not checkable or not readable."
)]
pub(crate) struct Check {
    /// The certificate's file
    certificate: PathBuf,
    /// The scheme that it has to be about: a scheme of the catalogue, or the path of a scheme file
    #[arg(long, value_name = "SCHEME")]
    scheme: Option<String>,
}

impl Check {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let scheme = self.scheme.as_deref().map(text).transpose()?;
        match read(&self.certificate).and_then(|own| check(&own, scheme.as_deref())) {
            Ok(from) => print(&format!(
                "accepted: limits are C1 at extraordinary points, for generic control points and every n >= {from}\n"
            )),
            Err(refusal) if refusal.status == 1 => {
                print(&format!("{}\n", refusal.why))?;
                Err(Failure::No)
            }
            Err(_) if self.certificate.metadata().is_ok_and(|own| own.is_file() && own.len() == 0) => {
                Err(failure(format!("`{}` is empty: no certificate", self.certificate.display())))
            }
            Err(refusal) => {
                let path = self.certificate.display().to_string();
                let told = refusal.why.contains(&path);
                Err(failure(if told { refusal.why } else { format!("`{path}`: {}", refusal.why) }))
            }
        }
    }
}
