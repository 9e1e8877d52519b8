//! How is a mesh written?

mod fan;
mod glb;
mod numbers;
mod obj;
mod off;
mod ply;
mod stl;

use super::{Format, Output};
use std::io::{self, Write};

/// Writes a mesh in a format. Vertices and faces keep their order; `to` is written in small pieces, so it should have a
/// buffer.
///
/// Numbers in text are the shortest that read back as the same number of the precision at hand: positions of 64 bits come back
/// bit for bit, and those of 32 bits do as numbers of 32 bits. Binary PLY keeps the precision; STL and glTF have 32 bits.
///
/// Returned are notes on what the format can't hold.
///
/// # Errors
/// Those of `to`; and [`io::ErrorKind::InvalidInput`], before anything is written, for what no file of the format can hold.
pub fn write(format: Format, output: &Output, to: &mut impl Write) -> io::Result<Vec<String>> {
    let in_single = matches!(format, Format::Stl | Format::Gltf);
    output.check(in_single)?;
    let mut notes = match format {
        Format::Obj => obj::write(output, to),
        Format::Ply => ply::write(output, to),
        Format::Off => off::write(output, to),
        Format::Stl => stl::write(output, to),
        Format::Gltf => glb::write(output, to),
    }?;
    if format != Format::Obj {
        notes.extend(output.tags_left_out());
    }
    if in_single && output.positions.lose_digits() {
        notes.push(format!("coordinates are rounded to 32 bits, which is what {format} holds"));
    }
    Ok(notes)
}
