//! Which tags does an OBJ file have?
//!
//! Lines that start with `t`, counted or plain: both forms are told at [`Format::Obj`](crate::mesh::io::Format::Obj).

use super::super::bad_file::{BadFile, Kind, Place, shown};
use super::super::left_out::LeftOut;
use super::super::text::{real, whole};
use super::vertex_index;
use crate::mesh::{Crease, Faces};
use std::collections::HashMap;

/// From this sharpness on a counted tag means for ever: OpenSubdiv's `SHARPNESS_INFINITE`.
pub(in crate::mesh::io) const FOR_EVER: f64 = 10.0;

/// The tags as they are read.
#[derive(Default)]
pub(super) struct Tags {
    /// Each with its line.
    creases: Vec<(Crease, usize)>,
    /// Vertices with whether they are corners, and the line.
    corners: Vec<(u32, bool, usize)>,
    fading: Option<usize>,
}

impl Tags {
    /// Reads what follows the `t`, `vertices` having been read so far.
    pub(super) fn read<'a>(
        &mut self,
        mut words: impl Iterator<Item = &'a [u8]>,
        vertices: usize,
        line: usize,
        left_out: &mut LeftOut,
    ) -> Result<(), BadFile> {
        let corner = match words.next() {
            Some(b"crease") => false,
            Some(b"corner") => true,
            _ => {
                left_out.count("tags other than creases and corners", line);
                return Ok(());
            }
        };
        let words: Vec<&[u8]> = words.collect();
        let (indices, sharpness) = match words.first().and_then(|word| counts(word)) {
            Some(counts) => counted(&words[1..], counts, line)?,
            None => plain(&words, usize::from(!corner) + 1, vertices, line)?,
        };
        if corner { self.corners(&indices, &sharpness, line) } else { self.creases(&indices, &sharpness, line) }
    }

    fn creases(&mut self, indices: &[u32], sharpness: &[f64], line: usize) -> Result<(), BadFile> {
        if indices.is_empty() || !indices.len().is_multiple_of(2) {
            return Err(bad(line, format!("a crease lists {} vertices, but needs two for each edge", indices.len())));
        }
        let sharpness = for_each(sharpness, indices.len() / 2, line)?;
        for (ends, sharpness) in indices.chunks_exact(2).zip(sharpness) {
            if ends[0] == ends[1] {
                return Err(bad(line, "both ends of a crease are the same vertex".to_string()));
            }
            self.creases.push((Crease { ends: [ends[0], ends[1]], sharpness }, line));
        }
        Ok(())
    }

    fn corners(&mut self, indices: &[u32], sharpness: &[f64], line: usize) -> Result<(), BadFile> {
        if indices.is_empty() {
            return Err(bad(line, "a corner lists no vertex".to_string()));
        }
        for (vertex, sharpness) in indices.iter().zip(for_each(sharpness, indices.len(), line)?) {
            if sharpness > 0.0 && sharpness < FOR_EVER {
                self.fading.get_or_insert(line);
            }
            self.corners.push((*vertex, sharpness > 0.0, line));
        }
        Ok(())
    }

    /// The first crease that is on no edge, with its line: reading goes on, but no mesh will be made of it.
    pub(super) fn loose(&self, faces: &Faces) -> Option<String> {
        let ordered = |a: u32, b: u32| (a.min(b), a.max(b));
        let mut loose: HashMap<(u32, u32), usize> = HashMap::new();
        for (Crease { ends: [a, b], .. }, line) in &self.creases {
            loose.entry(ordered(*a, *b)).or_insert(*line);
        }
        for face in faces.iter().filter(|_| !self.creases.is_empty()) {
            for (a, b) in face.iter().zip(face.iter().cycle().skip(1)) {
                loose.remove(&ordered(*a, *b));
            }
        }
        let ((a, b), line) = loose.iter().min_by_key(|(ends, line)| (**line, **ends))?;
        Some(format!("line {line}: a crease between vertices {a} and {b}, counted from 0, is on no edge of a face"))
    }

    /// Whether all vertices exist.
    pub(super) fn check(&self, vertices: usize) -> Result<(), BadFile> {
        let ends = self.creases.iter().flat_map(|(crease, line)| crease.ends.map(|end| (end, *line)));
        let all = ends.chain(self.corners.iter().map(|(vertex, _, line)| (*vertex, *line)));
        let beyond = || all.clone().filter(|(vertex, _)| *vertex as usize >= vertices);
        let Some((vertex, line)) = beyond().min_by_key(|(_, line)| *line) else { return Ok(()) };
        let message = format!("a tag names vertex {vertex}, counted from 0, but the file has {vertices}");
        Err(BadFile { more: beyond().count() - 1, ..bad(line, message) })
    }

    /// The creases and corners, and what is to be said of them.
    pub(super) fn finish(self, notes: &mut Vec<String>) -> (Vec<Crease>, Vec<u32>) {
        if let Some(line) = self.fading {
            let first = format!("the first in line {line}");
            notes.push(format!("corners with a sharpness below {FOR_EVER} stay corners for ever ({first})"));
        }
        let last: HashMap<u32, bool> = self.corners.iter().map(|(vertex, corner, _)| (*vertex, *corner)).collect();
        let stays = |(vertex, corner, _): &(u32, bool, usize)| *corner && last.get(vertex) == Some(&true);
        let corners = self.corners.iter().filter(|told| stays(told)).map(|(vertex, ..)| *vertex).collect();
        (self.creases.into_iter().map(|(crease, _)| crease).collect(), corners)
    }
}

/// The counts of a counted tag: indices, numbers, words.
fn counts(word: &[u8]) -> Option<[usize; 3]> {
    let mut parts = word.split(|byte| *byte == b'/').map(|part| whole(part).and_then(|n| usize::try_from(n).ok()));
    let counts = [parts.next()??, parts.next()??, parts.next()??];
    parts.next().is_none().then_some(counts)
}

/// Indices from 0, then sharpnesses.
fn counted(words: &[&[u8]], counts: [usize; 3], line: usize) -> Result<(Vec<u32>, Vec<f64>), BadFile> {
    let [indices, numbers, others] = counts;
    let told = indices.saturating_add(numbers).saturating_add(others);
    if told != words.len() {
        return Err(bad(line, format!("a tag announces {told} words, but has {}", words.len())));
    }
    if others > 0 {
        return Err(bad(line, "a crease or corner has words besides its numbers".to_string()));
    }
    let (indices, numbers) = words.split_at(indices);
    let indices = indices.iter().map(|word| index_from_zero(word, line)).collect::<Result<_, _>>()?;
    let ever = |s: f64| if s >= FOR_EVER { f64::INFINITY } else { s };
    let numbers = numbers.iter().map(|word| sharpness(word, line).map(ever)).collect::<Result<_, _>>()?;
    Ok((indices, numbers))
}

/// Indices from 1, apart or joined by a slash, then one sharpness.
fn plain(words: &[&[u8]], ends: usize, vertices: usize, line: usize) -> Result<(Vec<u32>, Vec<f64>), BadFile> {
    let Some((last, words)) = words.split_last() else {
        return Err(bad(line, "a tag has no vertices and no sharpness".to_string()));
    };
    let slashed = words.iter().flat_map(|word| word.split(|byte| *byte == b'/'));
    let indices: Vec<u32> = slashed.map(|word| vertex_index(word, vertices, line)).collect::<Result<_, _>>()?;
    if indices.len() != ends {
        let what = if ends == 1 { "a corner has one vertex" } else { "a crease has two vertices" };
        return Err(bad(
            line,
            format!("{what} and a sharpness, but {} come before the last number here", indices.len()),
        ));
    }
    Ok((indices, vec![sharpness(last, line)?]))
}

fn index_from_zero(word: &[u8], line: usize) -> Result<u32, BadFile> {
    let index = whole(word).ok_or_else(|| bad(line, format!("{} is no index of a vertex", shown(word))))?;
    u32::try_from(index).map_err(|_| bad(line, format!("there is no vertex {index}: counted tags count from 0")))
}

fn sharpness(word: &[u8], line: usize) -> Result<f64, BadFile> {
    let number = real(word).filter(|number| *number >= 0.0);
    number.ok_or_else(|| bad(line, format!("the sharpness {} is not a number of 0 or more", shown(word))))
}

/// One sharpness for each of `count` edges or vertices.
fn for_each(sharpness: &[f64], count: usize, line: usize) -> Result<Vec<f64>, BadFile> {
    match sharpness {
        [one] => Ok(vec![*one; count]),
        _ if sharpness.len() == count => Ok(sharpness.to_vec()),
        _ => Err(bad(line, format!("{} sharpnesses are told for {count} edges or vertices", sharpness.len()))),
    }
}

fn bad(line: usize, message: String) -> BadFile {
    let help = "write `t crease 2/1/0 0 1 2.5` (from 0), `t crease 1 2 2.5` (from 1) or `t corner 1/1/0 0 10`";
    BadFile::new(Kind::Tag, Place::Line(line), message, help)
}
