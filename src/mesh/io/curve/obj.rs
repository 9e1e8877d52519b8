//! What do the lines of an OBJ file say?

use super::super::bad_file::{BadFile, Kind, Place, shown};
use super::super::text::{Lines, coordinates, whole, words};
use super::Told;

pub(super) fn read(bytes: &[u8]) -> Result<Vec<Told>, BadFile> {
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut lines: Vec<(usize, Vec<i64>)> = Vec::new();
    for line in Lines::joined(bytes) {
        let mut words = words(&line.text);
        match words.next() {
            Some(b"v") => vertices.push(coordinates(&mut words, || line.place())?),
            Some(b"l") => {
                let count = vertices.len() as i64;
                let index = |word: &[u8]| {
                    let own = word.split(|byte| *byte == b'/').next().unwrap_or(word);
                    let index = whole(own).filter(|index| *index != 0).ok_or_else(|| {
                        let message = format!("{} is no index of a vertex", shown(word));
                        BadFile::new(Kind::Index, line.place(), message, "indices count from 1")
                    })?;
                    Ok(if index < 0 { count + index } else { index - 1 })
                };
                lines.push((line.number, words.map(index).collect::<Result<_, BadFile>>()?));
            }
            _ => {}
        }
    }
    lines.into_iter().map(|(number, line)| told(&vertices, number, &line)).collect()
}

fn told(vertices: &[[f64; 3]], number: usize, line: &[i64]) -> Result<Told, BadFile> {
    let mut own = Told::default();
    let closed = line.len() > 2 && line.first() == line.last();
    for index in &line[..line.len() - usize::from(closed)] {
        let vertex = usize::try_from(*index).ok().and_then(|index| vertices.get(index)).ok_or_else(|| {
            let message = format!("there is no vertex {}; the file has {}", index + 1, vertices.len());
            BadFile::new(Kind::Index, Place::Line(number), message, "indices count from 1")
        })?;
        own.push(vertex, &Place::Line(number))?;
    }
    own.closed = closed;
    // an OBJ file has three coordinates, whatever the curve
    own.dimension = 3;
    Ok(own)
}
