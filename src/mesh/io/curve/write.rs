//! How are polygons written?

use super::CurveFormat;
use crate::mesh::Polygon;
use std::io::{self, Write};

/// How a picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// Whether y points upwards, as in mathematics: SVG's own points down.
    pub upwards: bool,
}

/// Writes polygons in a format. SVG has the first two coordinates.
///
/// # Errors
/// Those of the writer.
pub fn write(format: CurveFormat, polygons: &[Polygon], style: Style, to: &mut impl Write) -> io::Result<()> {
    match format {
        CurveFormat::Csv => csv(polygons, to),
        CurveFormat::Json => json(polygons, to),
        CurveFormat::Svg => svg(polygons, style, to),
        CurveFormat::Obj => obj(polygons, to),
    }
}

fn csv(polygons: &[Polygon], to: &mut impl Write) -> io::Result<()> {
    for (index, polygon) in polygons.iter().enumerate() {
        if index > 0 {
            writeln!(to)?;
        }
        for [x, y, z] in &polygon.points {
            if polygon.dimension == 2 { writeln!(to, "{x},{y}")? } else { writeln!(to, "{x},{y},{z}")? }
        }
    }
    Ok(())
}

fn json(polygons: &[Polygon], to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "[")?;
    for (index, polygon) in polygons.iter().enumerate() {
        write!(to, "  {{ \"closed\": {}, \"points\": [", polygon.closed)?;
        for (number, [x, y, z]) in polygon.points.iter().enumerate() {
            let comma = if number > 0 { ", " } else { "" };
            if polygon.dimension == 2 {
                write!(to, "{comma}[{x}, {y}]")?
            } else {
                write!(to, "{comma}[{x}, {y}, {z}]")?
            }
        }
        writeln!(to, "] }}{}", if index + 1 < polygons.len() { "," } else { "" })?;
    }
    writeln!(to, "]")
}

fn svg(polygons: &[Polygon], style: Style, to: &mut impl Write) -> io::Result<()> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in polygons.iter().flat_map(|polygon| &polygon.points) {
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    let size = (high[0] - low[0]).max(high[1] - low[1]).max(f64::MIN_POSITIVE);
    let margin = 0.05 * size;
    let top = if style.upwards { -high[1] } else { low[1] };
    writeln!(
        to,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{} {} {} {}\">",
        low[0] - margin,
        top - margin,
        high[0] - low[0] + 2.0 * margin,
        high[1] - low[1] + 2.0 * margin
    )?;
    let flip = if style.upwards { " transform=\"scale(1,-1)\"" } else { "" };
    writeln!(to, "<g fill=\"none\" stroke=\"black\" stroke-width=\"{}\"{flip}>", 0.004 * size)?;
    for polygon in polygons {
        write!(to, "<path d=\"")?;
        for (index, [x, y, _]) in polygon.points.iter().enumerate() {
            write!(to, "{}{x} {y}", if index == 0 { "M" } else { " L" })?;
        }
        writeln!(to, "{}\"/>", if polygon.closed { " Z" } else { "" })?;
    }
    writeln!(to, "</g>\n</svg>")
}

fn obj(polygons: &[Polygon], to: &mut impl Write) -> io::Result<()> {
    let mut first = 1;
    for polygon in polygons {
        for [x, y, z] in &polygon.points {
            writeln!(to, "v {x} {y} {z}")?;
        }
        write!(to, "l")?;
        for index in 0..polygon.points.len() {
            write!(to, " {}", first + index)?;
        }
        writeln!(to, "{}", if polygon.closed { format!(" {first}") } else { String::new() })?;
        first += polygon.points.len();
    }
    Ok(())
}
