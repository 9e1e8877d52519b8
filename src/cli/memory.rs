//! Is there enough memory for what is asked?

use super::{Failure, failure};
use sysinfo::System;

/// Checks that so many bytes can be had; `what` needs them, and `help` says what to do otherwise.
pub(crate) fn check(bytes: u128, what: &str, help: &str) -> Result<(), Failure> {
    let Some(available) = available().filter(|available| bytes > *available) else { return Ok(()) };
    let message = format!("{what} needs about {}, and there are {}", size(bytes), size(available));
    Err(failure(if help.is_empty() { message } else { format!("{message}\n  help: {help}") }))
}

/// The bytes of memory that can be had, where the system tells.
pub(crate) fn available() -> Option<u128> {
    let mut system = System::new();
    system.refresh_memory();
    Some(u128::from(system.available_memory())).filter(|bytes| *bytes > 0)
}

/// Bytes in words.
pub(crate) fn size(bytes: u128) -> String {
    const UNITS: [(&str, u128); 4] = [("TiB", 1 << 40), ("GiB", 1 << 30), ("MiB", 1 << 20), ("KiB", 1 << 10)];
    let unit = UNITS.into_iter().find(|(_, unit)| bytes >= *unit);
    unit.map_or(format!("{bytes} bytes"), |(name, unit)| format!("{:.1} {name}", bytes as f64 / unit as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_there_is_is_refused_in_words() {
        assert!(check(1, "nothing", "").is_ok());
        let refused = check(u128::MAX / 4, "all", "ask for less").unwrap_err().to_string();
        assert!(
            refused.contains("all needs about") && refused.contains("TiB") && refused.contains("help: ask for less")
        );
        assert_eq!((size(12), size(3 << 29), size(5 << 40)), ("12 bytes".into(), "1.5 GiB".into(), "5.0 TiB".into()));
    }
}
