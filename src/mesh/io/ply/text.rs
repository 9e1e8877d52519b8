//! How are rows of a PLY file of text read?
//!
//! A row is a line.

use super::super::bad_file::{BadFile, Kind, Place, shown};
use super::super::text::{Lines, next_word, real};
use super::header::{Element, Header, Scalar};
use super::rows::{Rows, no_room};

pub(super) struct TextRows<'a> {
    lines: Lines<'a>,
    /// What is left of the row.
    row: &'a [u8],
}

impl<'a> TextRows<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header) -> TextRows<'a> {
        TextRows { lines: Lines::after(bytes, header.end, header.lines), row: &[] }
    }

    fn here(&self) -> Place {
        Place::Line(self.lines.number())
    }

    fn word(&mut self) -> Result<&'a [u8], BadFile> {
        let message = "the line has fewer values than the header announces";
        let help = "give all properties of an element on one line";
        next_word(&mut self.row)
            .ok_or_else(|| BadFile::new(Kind::Syntax, Place::Line(self.lines.number()), message, help))
    }
}

impl<'a> Rows<'a> for TextRows<'a> {
    fn room(&self) -> usize {
        self.lines.rest().len()
    }

    fn announce(&self, element: &Element) -> Result<(), BadFile> {
        let room = self.room();
        // a value and the end of its line
        let needed = if element.properties.is_empty() { 0 } else { element.count.saturating_mul(2) };
        if needed <= room.saturating_add(1) { Ok(()) } else { Err(no_room(element, room, self.here())) }
    }

    fn begin(&mut self, element: &'a Element, index: usize) -> Result<(), BadFile> {
        self.row = self.lines.take_told().ok_or_else(|| {
            let message = format!("the file ends after {index} of {} elements `{}`", element.count, element.name);
            BadFile::new(Kind::Truncated, self.here(), message, "copy it again, or correct the header")
        })?;
        Ok(())
    }

    fn value(&mut self, _: Scalar) -> Result<f64, BadFile> {
        let word = self.word()?;
        real(word).ok_or_else(|| {
            BadFile::new(
                Kind::Number,
                self.here(),
                format!("{} is not a number", shown(word)),
                "write it as in 1.5 or -2e-3",
            )
        })
    }

    fn pass(&mut self, _: Scalar, count: usize) -> Result<(), BadFile> {
        (0..count).try_for_each(|_| self.word().map(|_| ()))
    }

    fn end(&mut self) -> Result<(), BadFile> {
        let Some(word) = next_word(&mut self.row) else { return Ok(()) };
        let message = format!("the line has more values than the header announces: {} is left", shown(word));
        Err(BadFile::new(Kind::Syntax, self.here(), message, "correct the header, or the line"))
    }

    fn mark(&self) -> usize {
        self.lines.number()
    }

    fn place(mark: usize, _: &Element, _: usize) -> Place {
        Place::Line(mark)
    }

    fn rest(&mut self) -> Option<String> {
        self.lines.take_told()?;
        Some(format!("left out: what follows the last element (line {})", self.lines.number()))
    }

    fn bad_length(&self, length: f64) -> BadFile {
        BadFile::new(Kind::Syntax, self.here(), format!("{length} is no length of a list"), "write a whole number")
    }
}
