//! Which valences does `3..12` or `3,4,7..9,50` mean?

use eigenring::analysis::local::MAX_VALENCE;
use std::str::FromStr;

/// The most valences in one run.
pub(crate) const MAX_COUNT: usize = 1_000;
/// The largest sum of the valences in one run: work and output grow with it.
pub(crate) const MAX_SUM: usize = 500_000;

/// A list of valences: in the order given, each once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Valences(pub(crate) Vec<usize>);

impl FromStr for Valences {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut valences: Vec<usize> = Vec::new();
        for part in text.split(',').map(str::trim) {
            let (first, last) = match part.split_once("..") {
                Some((first, last)) => (valence(first, text)?, valence(last, text)?),
                None => (valence(part, text)?, valence(part, text)?),
            };
            if first > last {
                return Err(format!("`{part}` runs backwards; write {last}..{first}"));
            }
            if last - first >= MAX_COUNT || valences.len() + (last - first) >= MAX_COUNT {
                return Err(format!("these are more than {MAX_COUNT} valences, the most for one run"));
            }
            valences.extend(first..=last);
        }
        let mut seen = std::collections::BTreeSet::new();
        valences.retain(|n| seen.insert(*n));
        if valences.iter().sum::<usize>() > MAX_SUM {
            return Err(format!("the valences of one run may sum to at most {MAX_SUM}"));
        }
        Ok(Valences(valences))
    }
}

/// A single valence.
pub(crate) fn one_valence(text: &str) -> Result<usize, String> {
    if text.contains(',') || text.contains("..") {
        return Err(format!("`{text}` is a list; the matrix is that of one valence"));
    }
    valence(text, text)
}

fn valence(part: &str, text: &str) -> Result<usize, String> {
    let part = part.trim();
    if part.is_empty() {
        return Err(format!("a valence is missing in `{text}`; write for example 3..12 or 3,4,7..9"));
    }
    let number: Option<u128> = part.parse().ok();
    match number {
        Some(n) if n < 3 => Err(format!("a valence is at least 3, not {n}")),
        Some(n) if n > MAX_VALENCE as u128 => Err(format!("a valence is at most {MAX_VALENCE}, not {n}")),
        Some(n) => Ok(n as usize),
        None => Err(format!("`{part}` is not a valence; write for example 3..12 or 3,4,7..9")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_ranges_are_read_and_others_refused() {
        let read = |text: &str| text.parse::<Valences>().map(|valences| valences.0);
        assert_eq!(read("3..6"), Ok(vec![3, 4, 5, 6]));
        assert_eq!(read("3,4, 7..9,50,4"), Ok(vec![3, 4, 7, 8, 9, 50]));
        for bad in [
            "",
            "12..3",
            "0",
            "1",
            "2..4",
            "1000000000",
            "3..",
            "..5",
            "x",
            "3...5",
            "3..99999",
            "-3",
            "3.5",
            ",",
            "99999999999999999999999",
        ] {
            assert!(read(bad).is_err(), "{bad}");
        }
        assert!(read("12..3").unwrap_err().contains("3..12"));
    }
}
