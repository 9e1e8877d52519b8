//! How are rows of a binary PLY file read?

use super::super::bad_file::{BadFile, Kind, Place};
use super::header::{Element, Header, Order, Scalar};
use super::rows::{Rows, no_room};

pub(super) struct BinaryRows<'a> {
    bytes: &'a [u8],
    /// The byte that is read next.
    at: usize,
    order: Order,
    /// The row: its element, index and first byte.
    row: Option<(&'a Element, usize, usize)>,
}

impl<'a> BinaryRows<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header, order: Order) -> BinaryRows<'a> {
        BinaryRows { bytes, at: header.end, order, row: None }
    }

    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], BadFile> {
        let Some(bytes) = self.bytes[self.at..].first_chunk::<N>() else { return Err(self.truncated()) };
        self.at += N;
        let mut bytes = *bytes;
        if self.order == Order::Big {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn here(&self) -> Place {
        self.row.map_or(Place::Whole, |(element, index, start)| Self::place(start, element, index))
    }

    fn truncated(&self) -> BadFile {
        BadFile::new(Kind::Truncated, self.here(), "the file ends here, within an element", "copy it again")
    }
}

impl<'a> Rows<'a> for BinaryRows<'a> {
    fn room(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn announce(&self, element: &Element) -> Result<(), BadFile> {
        let needed = element.count.checked_mul(element.row());
        if needed.is_some_and(|needed| needed <= self.room()) {
            return Ok(());
        }
        Err(no_room(element, self.room(), Self::place(self.at, element, 0)))
    }

    fn begin(&mut self, element: &'a Element, index: usize) -> Result<(), BadFile> {
        self.row = Some((element, index, self.at));
        Ok(())
    }

    #[inline]
    fn value(&mut self, scalar: Scalar) -> Result<f64, BadFile> {
        Ok(match scalar {
            Scalar::I8 => f64::from(i8::from_le_bytes(self.take()?)),
            Scalar::U8 => f64::from(u8::from_le_bytes(self.take()?)),
            Scalar::I16 => f64::from(i16::from_le_bytes(self.take()?)),
            Scalar::U16 => f64::from(u16::from_le_bytes(self.take()?)),
            Scalar::I32 => f64::from(i32::from_le_bytes(self.take()?)),
            Scalar::U32 => f64::from(u32::from_le_bytes(self.take()?)),
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn pass(&mut self, scalar: Scalar, count: usize) -> Result<(), BadFile> {
        match count.checked_mul(scalar.size()).filter(|bytes| *bytes <= self.room()) {
            Some(bytes) => self.at += bytes,
            None => return Err(self.truncated()),
        }
        Ok(())
    }

    fn end(&mut self) -> Result<(), BadFile> {
        Ok(())
    }

    fn mark(&self) -> usize {
        self.at
    }

    fn place(mark: usize, element: &Element, index: usize) -> Place {
        Place::Element { what: element.name.clone(), index, byte: mark }
    }

    fn rest(&mut self) -> Option<String> {
        let left = self.room();
        (left > 0).then(|| format!("left out: {left} bytes after the last element"))
    }

    fn bad_length(&self, length: f64) -> BadFile {
        BadFile::new(Kind::Syntax, self.here(), format!("{length} is no length of a list"), "make the file again")
    }
}
