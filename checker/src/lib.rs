//! Does a certificate prove what it says of a subdivision scheme?
//!
//! A certificate (docs/certificate.md) claims C1 at extraordinary points of every valence from one on. It is verified
//! from the scheme's rules in rational arithmetic, without search or code of the prover; what can't be isn't accepted.

mod certificate;
mod cosine;
mod formula;
mod map;
mod net;
mod polynomial;
mod scheme;
mod spectrum;

use std::io::Read;

/// The longest file, in bytes.
pub const MAX_BYTES: usize = 65_536;

/// Why a certificate is not accepted. That says nothing against its scheme.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// Of programs: 1 rejected, an obligation is not seen to hold; 2 not checkable here, or not readable.
    pub status: u8,
    /// What is wrong.
    pub why: String,
}

fn beyond<T>(why: impl std::fmt::Display) -> Result<T, Refusal> {
    Err(Refusal { status: 2, why: format!("not checkable: {why}") })
}

fn require(holds: bool, why: impl std::fmt::Display) -> Result<(), Refusal> {
    if holds { Ok(()) } else { Err(Refusal { status: 1, why: format!("rejected: {why}") }) }
}

/// The text of a file; of one that is too long, too much.
pub fn read(path: &std::path::Path) -> Result<String, Refusal> {
    let mut text = String::new();
    let file = std::fs::File::open(path).and_then(|file| file.take(MAX_BYTES as u64 + 1).read_to_string(&mut text));
    file.map(|_| text).or_else(|error| beyond(format!("{}: {error}", path.display())))
}

/// The first valence that a certificate proves its claim from, for the rules of this very scheme file if one is given.
pub fn check(certificate: &str, scheme: Option<&str>) -> Result<i64, Refusal> {
    if certificate.len().max(scheme.map_or(0, str::len)) > MAX_BYTES {
        return beyond(format!("a file has more than {MAX_BYTES} bytes"));
    }
    let certificate = certificate::Certificate::parse(certificate)?;
    if let Some(text) = scheme {
        let mut file: toml::Table = text.parse().or_else(|error| beyond(format!("the scheme's file: {error}")))?;
        let _ = ["name", "source", "boundary", "claims"].map(|key| file.remove(key));
        require(file == certificate.scheme, "it is about another scheme than that of the file")?;
    }
    let scheme = scheme::Scheme::new(certificate.scheme.clone())?;
    spectrum::check(&scheme, &certificate)?;
    map::check_patches(&scheme, &certificate)?;
    Ok(certificate.from)
}
