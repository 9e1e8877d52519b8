//! How do meshes come from files, and go into them?
//!
//! Bytes in, bytes out: files are opened elsewhere. [`read`] takes OBJ, PLY, OFF and STL, whole and checked, or says what is
//! wrong and where; [`write()`] makes these and binary glTF.
//!
//! | format | read | written | tags | what else |
//! |---|---|---|---|---|
//! | OBJ | polygons | polygons | creases, corners | the forms of tags: [`Format::Obj`] |
//! | PLY | polygons; text, binary of either byte order | polygons; binary, little-endian | - | - |
//! | OFF | polygons | polygons | - | - |
//! | STL | triangles; text, binary | triangles; binary, 32 bits | - | equal points are one vertex |
//! | glTF | - | triangles; binary (`.glb`), 32 bits | - | - |
//!
//! What a format can't hold, and what a reader leaves out of a file, is said in notes; nothing is left out in silence.

mod bad_file;
pub mod curve;
mod format;
mod gather;
mod left_out;
mod obj;
mod off;
mod output;
mod ply;
mod stl;
mod text;
mod write;

pub use bad_file::{BadFile, Kind, Place};
pub use format::Format;
pub use output::{Coordinates, Output};
pub use write::write;

use super::PolygonSoup;

/// What a file says.
#[derive(Clone, Debug, PartialEq)]
pub struct Read {
    /// Its points, polygons and tags. Every corner is a point, every face has three or more, all different.
    pub soup: PolygonSoup,
    /// What was left out or read in a special way, a sentence each.
    pub notes: Vec<String>,
}

/// Reads a file of a format from its bytes.
///
/// Memory grows with the bytes that are there, never with counts that they announce.
///
/// # Errors
/// The first fault that is met, where, what to do, and how many more of its kind follow.
pub fn read(format: Format, bytes: &[u8]) -> Result<Read, BadFile> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(bad_file::empty());
    }
    let read = match format {
        Format::Obj => text::check(bytes).and_then(|()| obj::read(bytes)),
        Format::Ply => ply::read(bytes),
        Format::Off => text::check(bytes).and_then(|()| off::read(bytes)),
        Format::Stl => stl::read(bytes),
        Format::Gltf => Err(bad_file::not_read()),
    };
    read.map_err(|fault| match Format::of_bytes(bytes) {
        Some(other) if other != format => fault.looks_like(other),
        _ => fault,
    })
}
