//! How are rows of values read, as text or binary?

use super::super::bad_file::{BadFile, Kind, Place};
use super::header::{Element, Scalar, Shape};

/// The rows of a PLY file, in order.
pub(super) trait Rows<'a> {
    /// The bytes that are left.
    fn room(&self) -> usize;
    /// Whether what is left can hold the rows of an element.
    fn announce(&self, element: &Element) -> Result<(), BadFile>;
    /// Starts the row of an index of an element.
    fn begin(&mut self, element: &'a Element, index: usize) -> Result<(), BadFile>;
    /// The next value of the row.
    fn value(&mut self, scalar: Scalar) -> Result<f64, BadFile>;
    /// Steps over values of the row.
    fn pass(&mut self, scalar: Scalar, count: usize) -> Result<(), BadFile>;
    /// Ends the row.
    fn end(&mut self) -> Result<(), BadFile>;
    /// Where the row is: what [`Rows::place`] makes a place of.
    fn mark(&self) -> usize;
    /// The place of a row.
    fn place(mark: usize, element: &Element, index: usize) -> Place;
    /// A note on what follows the last row.
    fn rest(&mut self) -> Option<String>;
    /// A length that makes no sense.
    fn bad_length(&self, length: f64) -> BadFile;

    /// The length of a list.
    fn length(&mut self, count: Scalar) -> Result<usize, BadFile> {
        let length = self.value(count)?;
        let sound = length >= 0.0 && length.fract() == 0.0 && length <= f64::from(u32::MAX);
        if sound { Ok(length as usize) } else { Err(self.bad_length(length)) }
    }

    /// Steps over a property.
    fn step(&mut self, shape: Shape) -> Result<(), BadFile> {
        match shape {
            Shape::One(scalar) => self.pass(scalar, 1),
            Shape::List { count, item } => {
                let length = self.length(count)?;
                self.pass(item, length)
            }
        }
    }

    /// Steps over all rows of an element.
    fn step_over(&mut self, element: &'a Element) -> Result<(), BadFile> {
        if element.properties.is_empty() {
            return Ok(());
        }
        for index in 0..element.count {
            self.begin(element, index)?;
            element.properties.iter().try_for_each(|property| self.step(property.shape))?;
            self.end()?;
        }
        Ok(())
    }
}

/// More elements are announced than there is room for.
pub(super) fn no_room(element: &Element, room: usize, place: Place) -> BadFile {
    let (count, name) = (element.count, &element.name);
    let message = format!("the header announces {count} elements `{name}`, but only {room} bytes are left for them");
    BadFile::new(Kind::Truncated, place, message, "copy the file again, or correct its header")
}
