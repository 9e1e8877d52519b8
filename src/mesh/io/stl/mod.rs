//! What does an STL file say?
//!
//! Triangles, each with its own three points: those with exactly equal coordinates are welded to one vertex. A binary file is
//! one whose size is that of the triangles which it announces, whatever words stand at its start.

mod binary;
mod text;
mod weld;

pub(super) use binary::HEAD;

use super::Read;
use super::bad_file::BadFile;

pub(super) fn read(bytes: &[u8]) -> Result<Read, BadFile> {
    let solid = bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    if solid && !binary::fits(bytes) && !bytes.contains(&0) { text::read(bytes) } else { binary::read(bytes) }
}
