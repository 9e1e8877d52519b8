//! What does a PLY file say?
//!
//! A header of text announces elements and their properties; rows of values follow, as text or binary. Vertices and faces are
//! read, everything else is stepped over.

mod binary;
mod header;
mod rows;
mod text;

use super::Read;
use super::bad_file::{BadFile, Kind, Place};
use super::gather::{Gather, no_vertex};
use header::{Body, Element, Header, Role, Shape};
use rows::Rows;

/// Room is made beforehand for elements of at least so many bytes.
const SHORTEST: usize = 4;

pub(super) fn read(bytes: &[u8]) -> Result<Read, BadFile> {
    let header = header::read(bytes)?;
    match header.body {
        Body::Text => body(&header, text::TextRows::new(bytes, &header)),
        Body::Binary(order) => body(&header, binary::BinaryRows::new(bytes, &header, order)),
    }
}

fn body<'a>(header: &'a Header, mut rows: impl Rows<'a>) -> Result<Read, BadFile> {
    let mut gather = Gather::default();
    for element in &header.elements {
        rows.announce(element).or_else(|fault| gather.fault(fault))?;
        match element.role {
            Role::Vertices(axes) => vertices(element, axes, &mut rows, &mut gather)?,
            Role::Faces(list) => faces(element, list, header.vertices, &mut rows, &mut gather)?,
            Role::Other => rows.step_over(element).or_else(|fault| gather.fault(fault))?,
        }
    }
    let mut notes = header.left_out();
    notes.extend(rows.rest());
    Ok(Read { soup: gather.finish()?, notes })
}

fn vertices<'a, R: Rows<'a>>(
    element: &'a Element,
    axes: [usize; 3],
    rows: &mut R,
    gather: &mut Gather,
) -> Result<(), BadFile> {
    gather.reserve(element.count.min(rows.room() / SHORTEST), 0);
    for index in 0..element.count {
        let read = vertex(element, axes, index, rows);
        gather.vertex(read)?;
    }
    Ok(())
}

fn vertex<'a, R: Rows<'a>>(
    element: &'a Element,
    axes: [usize; 3],
    index: usize,
    rows: &mut R,
) -> Result<[f64; 3], BadFile> {
    rows.begin(element, index)?;
    let mark = rows.mark();
    let mut position = [0.0; 3];
    for (at, property) in element.properties.iter().enumerate() {
        match (axes.iter().position(|axis| *axis == at), property.shape) {
            (Some(axis), Shape::One(scalar)) => position[axis] = rows.value(scalar)?,
            (_, shape) => rows.step(shape)?,
        }
    }
    rows.end()?;
    if position.iter().all(|value| value.is_finite()) {
        return Ok(position);
    }
    let help = "write coordinates as in 1.5 or -2e-3, or make the file again";
    Err(BadFile::new(Kind::Number, R::place(mark, element, index), "a coordinate is not a finite number", help))
}

fn faces<'a, R: Rows<'a>>(
    element: &'a Element,
    list: usize,
    vertices: usize,
    rows: &mut R,
    gather: &mut Gather,
) -> Result<(), BadFile> {
    gather.reserve(0, element.count.min(rows.room() / SHORTEST));
    for index in 0..element.count {
        face(element, list, index, vertices, rows, gather).or_else(|fault| gather.fault(fault))?;
    }
    Ok(())
}

fn face<'a, R: Rows<'a>>(
    element: &'a Element,
    list: usize,
    index: usize,
    vertices: usize,
    rows: &mut R,
    gather: &mut Gather,
) -> Result<(), BadFile> {
    rows.begin(element, index)?;
    let mark = rows.mark();
    let place = || R::place(mark, element, index);
    for (at, property) in element.properties.iter().enumerate() {
        match property.shape {
            Shape::List { count, item } if at == list => {
                let length = rows.length(count)?;
                let corners = (0..length).map(|_| rows.value(item).and_then(|value| corner(value, vertices, place)));
                gather.face(corners, place)?;
            }
            shape => rows.step(shape)?,
        }
    }
    rows.end()
}

/// The vertex that a value means.
fn corner(value: f64, vertices: usize, place: impl FnOnce() -> Place) -> Result<u32, BadFile> {
    if value >= 0.0 && value < vertices as f64 && value.fract() == 0.0 {
        return Ok(value as u32);
    }
    Err(no_vertex(value, vertices, 0, place()))
}
