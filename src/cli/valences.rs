//! Which valences, or numbers of faces, does `3..12` or `3,4,7..9,50` mean?

use eigenring::analysis::boundary::MAX_FACES;
use eigenring::analysis::local::MAX_VALENCE;
use std::str::FromStr;

/// The most valences in one run.
pub(crate) const MAX_COUNT: usize = 1_000;
/// The largest sum of the valences in one run: work and output grow with it.
pub(crate) const MAX_SUM: usize = 500_000;

/// The same for numbers of faces at a boundary, where matrices are dense.
pub(crate) const MAX_SUM_OF_FACES: usize = 2_000;

/// A list of valences: in the order given, each once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Valences(pub(crate) Vec<usize>);

/// A list of numbers of faces at a boundary vertex.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Faces(pub(crate) Vec<usize>);

/// What is listed, and within which bounds.
struct Kind {
    name: &'static str,
    names: &'static str,
    example: &'static str,
    least: usize,
    most: usize,
    most_sum: usize,
}

const VALENCE: Kind =
    Kind { name: "valence", names: "valences", example: "3..12", least: 3, most: MAX_VALENCE, most_sum: MAX_SUM };

const FACES: Kind = Kind {
    name: "number of faces",
    names: "numbers of faces",
    example: "1..8",
    least: 1,
    most: MAX_FACES,
    most_sum: MAX_SUM_OF_FACES,
};

impl FromStr for Valences {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        list(text, &VALENCE).map(Valences)
    }
}

impl FromStr for Faces {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        list(text, &FACES).map(Faces)
    }
}

fn list(text: &str, kind: &Kind) -> Result<Vec<usize>, String> {
    let mut numbers: Vec<usize> = Vec::new();
    for part in text.split(',').map(str::trim) {
        let (first, last) = match part.split_once("..") {
            Some((first, last)) => (number(first, text, kind)?, number(last, text, kind)?),
            None => (number(part, text, kind)?, number(part, text, kind)?),
        };
        if first > last {
            return Err(format!("`{part}` runs backwards; write {last}..{first}"));
        }
        if last - first >= MAX_COUNT || numbers.len() + (last - first) >= MAX_COUNT {
            return Err(format!("these are more than {MAX_COUNT} {}, the most for one run", kind.names));
        }
        numbers.extend(first..=last);
    }
    let mut seen = std::collections::BTreeSet::new();
    numbers.retain(|n| seen.insert(*n));
    if numbers.iter().sum::<usize>() > kind.most_sum {
        return Err(format!("the {} of one run may sum to at most {}", kind.names, kind.most_sum));
    }
    Ok(numbers)
}

/// A single valence.
pub(crate) fn one_valence(text: &str) -> Result<usize, String> {
    if text.contains(',') || text.contains("..") {
        return Err(format!("`{text}` is a list; the matrix is that of one valence"));
    }
    number(text, text, &VALENCE)
}

fn number(part: &str, text: &str, kind: &Kind) -> Result<usize, String> {
    let (part, Kind { name, example, least, most, .. }) = (part.trim(), kind);
    if part.is_empty() {
        return Err(format!("a {name} is missing in `{text}`; write for example {example} or 3,4,7..9"));
    }
    let number: Option<u128> = part.parse().ok();
    match number {
        Some(n) if n < *least as u128 => Err(format!("a {name} is at least {least}, not {n}")),
        Some(n) if n > *most as u128 => Err(format!("a {name} is at most {most}, not {n}")),
        Some(n) => Ok(n as usize),
        None => Err(format!("`{part}` is not a {name}; write for example {example} or 3,4,7..9")),
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

    #[test]
    fn numbers_of_faces_start_at_one() {
        let read = |text: &str| text.parse::<Faces>().map(|faces| faces.0);
        assert_eq!(read("1..3,8"), Ok(vec![1, 2, 3, 8]));
        for (bad, words) in
            [("0", "at least 1"), ("201", "at most 200"), ("1..", "missing"), ("1..200", "sum to at most")]
        {
            assert!(read(bad).is_err_and(|why| why.contains(words)), "{bad}");
        }
    }
}
