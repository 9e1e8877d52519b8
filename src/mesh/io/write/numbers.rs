//! How are numbers written as text, so that they read back the same?

use super::super::Coordinates;
use std::fmt::{Display, LowerExp};
use std::io::{self, Write};

/// Numbers are written without an exponent from here on ...
const SMALLEST: f64 = 1e-5;
/// ... up to here.
const LARGEST: f64 = 1e16;

/// Writes a line for each of the coordinates, after a word.
pub(super) fn lines(word: &str, coordinates: Coordinates, to: &mut impl Write) -> io::Result<()> {
    match coordinates {
        Coordinates::Single(list) => list.iter().try_for_each(|[x, y, z]| line(word, [*x, *y, *z], to)),
        Coordinates::Double(list) => list.iter().try_for_each(|[x, y, z]| line(word, [*x, *y, *z], to)),
    }
}

fn line<T: Display + LowerExp + Copy + Into<f64>>(word: &str, values: [T; 3], to: &mut impl Write) -> io::Result<()> {
    to.write_all(word.as_bytes())?;
    for (axis, value) in values.into_iter().enumerate() {
        let space = if axis == 0 && word.is_empty() { "" } else { " " };
        let size = value.into().abs();
        if size == 0.0 || (SMALLEST..LARGEST).contains(&size) {
            write!(to, "{space}{value}")?;
        } else {
            write!(to, "{space}{value:e}")?;
        }
    }
    to.write_all(b"\n")
}
