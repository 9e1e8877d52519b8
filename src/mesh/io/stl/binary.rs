//! What does a binary STL file say?
//!
//! 80 bytes of anything, the number of facets, and 50 bytes each: a normal, three points, and two bytes of attributes; all
//! little-endian, numbers of 32 bits.

use super::super::Read;
use super::super::bad_file::{BadFile, Kind, Place};
use super::weld::Weld;

/// The bytes before the first facet.
pub(in crate::mesh::io) const HEAD: usize = 84;
/// The bytes of a facet.
const FACET: usize = 50;

/// Whether a file has the size that it announces.
pub(super) fn fits(bytes: &[u8]) -> bool {
    announced(bytes).is_some_and(|facets| size(facets) == bytes.len() as u64)
}

pub(super) fn read(bytes: &[u8]) -> Result<Read, BadFile> {
    if !fits(bytes) {
        return Err(wrong_size(bytes));
    }
    let mut weld = Weld::default();
    let mut attributes = 0;
    for (index, facet) in bytes[HEAD..].chunks_exact(FACET).enumerate() {
        let place = || Place::Element { what: "facet".into(), index, byte: HEAD + index * FACET };
        let points = [point(facet, 12), point(facet, 24), point(facet, 36)];
        if points.as_flattened().iter().all(|value| value.is_finite()) {
            weld.triangle(points, place)?;
        } else {
            let message = "a coordinate is not a finite number";
            weld.fault(BadFile::new(Kind::Number, place(), message, "take the facet out, or make the file again"))?;
        }
        attributes += usize::from(facet[48..] != [0, 0]);
    }
    let note = format!("left out: attributes, perhaps colours ({attributes} facets)");
    Ok(Read { soup: weld.finish()?, notes: if attributes > 0 { vec![note] } else { Vec::new() } })
}

fn announced(bytes: &[u8]) -> Option<u32> {
    bytes.get(80..84)?.try_into().ok().map(u32::from_le_bytes)
}

fn size(facets: u32) -> u64 {
    HEAD as u64 + u64::from(facets) * FACET as u64
}

fn point(facet: &[u8], at: usize) -> [f64; 3] {
    let value = |at: usize| f64::from(f32::from_le_bytes([facet[at], facet[at + 1], facet[at + 2], facet[at + 3]]));
    [value(at), value(at + 4), value(at + 8)]
}

fn wrong_size(bytes: &[u8]) -> BadFile {
    let message = match announced(bytes) {
        None => format!("a binary STL file has at least {HEAD} bytes, but this has {}", bytes.len()),
        Some(facets) => {
            format!("{facets} facets are announced, which take {} bytes, but there are {}", size(facets), bytes.len())
        }
    };
    BadFile::new(Kind::Truncated, Place::Whole, message, "copy it again; a file of text starts with `solid`")
}
