//! Which file lets others check a proof again?

use crate::proof::c1::Proofs;
use crate::proof::certificate::Certificate;
use crate::proof::outcome::Outcome;

/// The first valence of a certificate, and those that are tried as the first one that is told with all further ones.
const FIRST: usize = 3;
const NEXT: [usize; 4] = [4, 6, 8, 12];

/// The text of a certificate of C1 for every n >= 3, for generic control points, that the checker accepts; docs/certificate.md tells
/// what it says.
///
/// # Errors
/// Why there is none.
pub fn certificate(proofs: &Proofs) -> Result<String, String> {
    let Outcome::Proved(map) = proofs.maps_of_all() else {
        return Err(
            "certificates are of maps that are proved for every valence at once in exact arithmetic".to_string()
        );
    };
    let file = &proofs.analyzer.scheme().book.text;
    let mut why = String::new();
    for next in NEXT {
        let own =
            Certificate::of(proofs.analyzer, map, file, (FIRST, next)).map_err(|obstacle| obstacle.to_string())?;
        let own = own.to_json().map_err(|error| error.to_string())?;
        match eigenring_check::check(&own, Some(file)) {
            Ok(_) => return Ok(own),
            Err(refusal) => why = refusal.why,
        }
    }
    Err(why)
}
