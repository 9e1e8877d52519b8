//! `eigenring-check CERTIFICATE [SCHEME]`: exit status 0 accepted, 1 rejected, 2 not checkable or not readable.

use eigenring_check::{check, read};
use std::io::Write;

fn main() -> std::process::ExitCode {
    let texts: Result<Vec<String>, _> = std::env::args().skip(1).map(|path| read(path.as_ref())).collect();
    let checked = texts.and_then(|own| check(own.first().map_or("", |own| own), own.get(1).map(|own| own.as_str())));
    let accepted = |from| (format!("accepted: C1 for every n >= {from}"), 0);
    let (words, status) = checked.map_or_else(|own| (own.why, own.status), accepted);
    let _ = writeln!(std::io::stdout(), "{words}");
    status.into()
}
