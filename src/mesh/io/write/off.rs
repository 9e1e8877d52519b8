//! How is an OFF file written?

use super::super::Output;
use super::numbers::lines;
use std::io::{self, Write};

pub(super) fn write(output: &Output, to: &mut impl Write) -> io::Result<Vec<String>> {
    writeln!(to, "OFF\n{} {} 0", output.positions.len(), output.faces.len())?;
    lines("", output.positions, to)?;
    for face in output.faces.iter() {
        write!(to, "{}", face.len())?;
        face.iter().try_for_each(|corner| write!(to, " {corner}"))?;
        to.write_all(b"\n")?;
    }
    let note = "normals are left out of OFF files".to_string();
    Ok(output.normals.map(|_| note).into_iter().collect())
}
