//! Which file lets others check a proof again?

use super::analyze::explain;
use super::open::text;
use super::{Failure, failure};
use eigenring::analysis::Analyzer;
use eigenring::proof::certificate::Certificate;
use eigenring::proof::map::prove;
use eigenring::proof::outcome::Outcome;
use eigenring::report::write_whole;
use eigenring::scheme::Scheme;
use std::path::Path;

/// The first valence of a certificate, and those that are tried as the first one that is told with all further ones.
const FIRST: usize = 3;
const NEXT: [usize; 4] = [4, 6, 8, 12];

/// Writes the certificate of a scheme that was opened by its name, if there is one that the checker accepts.
pub(crate) fn write(name: &str, scheme: &Scheme, path: &Path) -> Result<String, Failure> {
    let told = |obstacle| explain(scheme, obstacle);
    let (file, analyzer) = (text(name)?, Analyzer::new(scheme).map_err(told)?);
    let Outcome::Proved(map) = prove(&analyzer) else {
        return Err(failure(
            "certificates are of maps that are proved exactly for every valence at once, and this one is not",
        ));
    };
    let mut why = String::new();
    for next in NEXT {
        let own = Certificate::of(&analyzer, &map, &file, (FIRST, next)).map_err(told)?;
        let own = own.to_json().map_err(|error| failure(error.to_string()))?;
        match eigenring_check::check(&own, Some(&file)) {
            Ok(from) => {
                let written = write_whole(path, own.as_bytes());
                written.map_err(|error| failure(format!("{}: {error}", path.display())))?;
                return Ok(format!("{}: a certificate for every n >= {from}, checked\n", path.display()));
            }
            Err(refusal) => why = refusal.why,
        }
    }
    Err(failure(format!("there is no certificate that the checker accepts; {why}")))
}
