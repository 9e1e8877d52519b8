//! How is an OBJ file written?

use super::super::obj::FOR_EVER;
use super::super::output::{Output, refused};
use super::numbers::lines;
use crate::mesh::Crease;
use std::io::{self, Write};

pub(super) fn write(output: &Output, to: &mut impl Write) -> io::Result<Vec<String>> {
    let none = |crease: &&Crease| crease.sharpness.is_nan() || crease.sharpness < 0.0;
    if let Some(crease) = output.creases.iter().find(none) {
        let [a, b] = crease.ends;
        return Err(refused(format!("the crease between vertices {a} and {b} has no sharpness of 0 or more")));
    }
    lines("v", output.positions, to)?;
    if let Some(normals) = output.normals {
        lines("vn", normals, to)?;
    }
    for face in output.faces.iter() {
        to.write_all(b"f")?;
        for corner in face {
            let index = corner + 1;
            if output.normals.is_some() { write!(to, " {index}//{index}")? } else { write!(to, " {index}")? }
        }
        to.write_all(b"\n")?;
    }
    output.creases.iter().try_for_each(|told| crease(told, to))?;
    output.corners.iter().try_for_each(|vertex| writeln!(to, "t corner 1/1/0 {vertex} {FOR_EVER}"))?;
    Ok(Vec::new())
}

/// A counted tag where that means the same, else a plain one.
fn crease(Crease { ends: [a, b], sharpness }: &Crease, to: &mut impl Write) -> io::Result<()> {
    if sharpness.is_infinite() {
        writeln!(to, "t crease 2/1/0 {a} {b} {FOR_EVER}")
    } else if *sharpness < FOR_EVER {
        writeln!(to, "t crease 2/1/0 {a} {b} {sharpness}")
    } else {
        writeln!(to, "t crease {} {} {sharpness}", a + 1, b + 1)
    }
}
