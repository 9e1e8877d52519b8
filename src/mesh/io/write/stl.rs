//! How is an STL file written?
//!
//! Binary, with the normals of the triangles. A triangle two of whose corners are the same point in 32 bits is left out: no
//! reader could weld it.

use super::super::output::{Output, refused};
use super::super::stl::HEAD;
use super::fan;
use std::io::{self, Write};

/// The bytes before the number of facets. They must not start with `solid`, as a file of text does.
const TITLE: &[u8] = b"binary STL";

pub(super) fn write(output: &Output, to: &mut impl Write) -> io::Result<Vec<String>> {
    let facets = || {
        let all =
            fan::triangles(output.faces).map(|corners| corners.map(|corner| output.positions.single(corner as usize)));
        all.filter(|[a, b, c]| a != b && b != c && c != a)
    };
    let count = facets().count();
    if count == 0 {
        return Err(refused("every triangle has two corners at the same point in 32 bits, which is what STL holds"));
    }
    let announced = u32::try_from(count).map_err(|_| refused(format!("STL can't hold {count} triangles")))?;
    let mut head = [0; HEAD];
    head[..TITLE.len()].copy_from_slice(TITLE);
    head[HEAD - 4..].copy_from_slice(&announced.to_le_bytes());
    to.write_all(&head)?;
    facets().try_for_each(|corners| facet(corners, to))?;
    let mut notes: Vec<String> = fan::note(output.faces).into_iter().collect();
    let lost = fan::count(output.faces) - count;
    if lost > 0 {
        notes.push(format!("{lost} triangles with two corners at the same point in 32 bits are left out"));
    }
    if output.normals.is_some() {
        notes.push("normals of vertices are left out: STL has those of triangles".to_string());
    }
    Ok(notes)
}

fn facet(corners: [[f32; 3]; 3], to: &mut impl Write) -> io::Result<()> {
    let normal = normal(corners);
    let numbers = normal.into_iter().chain(corners.into_iter().flatten());
    numbers.into_iter().try_for_each(|value| to.write_all(&value.to_le_bytes()))?;
    to.write_all(&[0, 0])
}

/// The direction from which the corners go counter-clockwise, of length 1; 0 where they lie on a line.
fn normal(corners: [[f32; 3]; 3]) -> [f32; 3] {
    let [a, b, c] = corners.map(|point| point.map(f64::from));
    let [u, v] = [b, c].map(|end| [end[0] - a[0], end[1] - a[1], end[2] - a[2]]);
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = cross.iter().map(|x| x * x).sum::<f64>().sqrt();
    cross.map(|x| if length > 0.0 { (x / length) as f32 } else { 0.0 })
}
