//! How is a PLY file written?
//!
//! Binary and little-endian, in the precision of the positions and normals.

use super::super::{Coordinates, Output};
use std::io::{self, Write};

pub(super) fn write(output: &Output, to: &mut impl Write) -> io::Result<Vec<String>> {
    let longest = output.faces.iter().map(<[u32]>::len).max().unwrap_or(0);
    let short = u8::try_from(longest).is_ok();
    header(output, if short { "uchar" } else { "uint" }, to)?;
    for index in 0..output.positions.len() {
        numbers(output.positions, index, to)?;
        output.normals.map_or(Ok(()), |normals| numbers(normals, index, to))?;
    }
    for face in output.faces.iter() {
        if short {
            to.write_all(&[face.len() as u8])?
        } else {
            to.write_all(&(face.len() as u32).to_le_bytes())?
        }
        face.iter().try_for_each(|corner| to.write_all(&corner.to_le_bytes()))?;
    }
    Ok(Vec::new())
}

fn header(output: &Output, length: &str, to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "ply\nformat binary_little_endian 1.0\nelement vertex {}", output.positions.len())?;
    properties(output.positions, ["x", "y", "z"], to)?;
    output.normals.map_or(Ok(()), |normals| properties(normals, ["nx", "ny", "nz"], to))?;
    // indices are below 2^31: `int` is what most programs read
    writeln!(to, "element face {}\nproperty list {length} int vertex_indices\nend_header", output.faces.len())
}

fn properties(coordinates: Coordinates, names: [&str; 3], to: &mut impl Write) -> io::Result<()> {
    let scalar = if matches!(coordinates, Coordinates::Single(_)) { "float" } else { "double" };
    names.iter().try_for_each(|name| writeln!(to, "property {scalar} {name}"))
}

fn numbers(coordinates: Coordinates, index: usize, to: &mut impl Write) -> io::Result<()> {
    match coordinates {
        Coordinates::Single(list) => list[index].iter().try_for_each(|value| to.write_all(&value.to_le_bytes())),
        Coordinates::Double(list) => list[index].iter().try_for_each(|value| to.write_all(&value.to_le_bytes())),
    }
}
