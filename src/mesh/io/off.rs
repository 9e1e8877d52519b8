//! What does an OFF file say?
//!
//! `OFF`, the numbers of vertices, faces and edges, then a line for each vertex and each face. Letters before `OFF` announce
//! texture coordinates (ST), colours (C) and normals (N), which follow the coordinates.

use super::Read;
use super::bad_file::{BadFile, Kind, Place, shown};
use super::gather::{Gather, no_vertex};
use super::left_out::LeftOut;
use super::text::{Line, Lines, coordinates, whole, words};

/// The fewest bytes of a vertex or a face: `0 0 0` and an end of line.
const SHORTEST: usize = 6;

pub(super) fn read(bytes: &[u8]) -> Result<Read, BadFile> {
    let mut lines = Lines::new(bytes);
    let [vertices, faces] = head(&mut lines)?;
    let mut reader = Reader { gather: Gather::default(), left_out: LeftOut::default() };
    let room = lines.rest().len() / SHORTEST;
    reader.gather.reserve(vertices.min(room), faces.min(room));
    for index in 0..vertices {
        match lines.next_told() {
            Some(line) => reader.vertex(&line)?,
            None => reader.gather.fault(truncated(&lines, index, vertices, "vertices"))?,
        }
    }
    for index in 0..faces {
        match lines.next_told() {
            Some(line) => reader.face(&line, vertices)?,
            None => reader.gather.fault(truncated(&lines, index, faces, "faces"))?,
        }
    }
    if let Some(line) = lines.next_told() {
        reader.left_out.count("what follows the last face", line.number);
    }
    Ok(Read { soup: reader.gather.finish()?, notes: reader.left_out.notes().collect() })
}

struct Reader {
    gather: Gather,
    left_out: LeftOut,
}

impl Reader {
    fn vertex(&mut self, line: &Line) -> Result<(), BadFile> {
        let mut words = words(&line.text);
        self.gather.vertex(coordinates(&mut words, || line.place()))?;
        if words.next().is_some() {
            self.left_out.count("normals, colours or texture coordinates of vertices, after x, y and z", line.number);
        }
        Ok(())
    }

    fn face(&mut self, line: &Line, vertices: usize) -> Result<(), BadFile> {
        let mut words = words(&line.text);
        let size = words.next().and_then(whole).and_then(|size| usize::try_from(size).ok());
        let Some(size) = size else {
            return self.gather.fault(syntax(line, "a face starts with the number of its corners", "write `3 0 1 2`"));
        };
        let mut missing = 0;
        let corners = (0..size).map_while(|index| {
            let word = words.next();
            missing = if word.is_none() { size - index } else { 0 };
            word.map(|word| index_from_zero(word, vertices, line))
        });
        self.gather.face(corners, || line.place())?;
        if missing > 0 {
            let message = format!("a face announces {size} corners, but has {}", size - missing);
            return self.gather.fault(BadFile::new(
                Kind::Face,
                line.place(),
                message,
                "give one index for each corner",
            ));
        }
        if words.next().is_some() {
            self.left_out.count("colours of faces", line.number);
        }
        Ok(())
    }
}

/// The numbers of vertices and faces.
fn head(lines: &mut Lines) -> Result<[usize; 2], BadFile> {
    let none = || BadFile::new(Kind::Syntax, Place::Line(1), "there is no word OFF", "start the file with a line OFF");
    let line = lines.next_told().ok_or_else(none)?;
    let first = words(&line.text).next().unwrap_or_default();
    let at = first.windows(3).position(|word| word == b"OFF").ok_or_else(|| not_off(&line))?;
    if !matches!(&first[..at], b"" | b"C" | b"N" | b"CN" | b"ST" | b"STC" | b"STN" | b"STCN") {
        let message = format!("{} announces other than three coordinates", shown(first));
        return Err(BadFile::new(Kind::NotRead, line.place(), message, "write x, y and z alone, and OFF at the start"));
    }
    // some files have the numbers in the first line, even without a space
    let same = [&first[at + 3..]].into_iter().filter(|rest| !rest.is_empty()).chain(words(&line.text).skip(1));
    let same: Vec<&[u8]> = same.collect();
    if same.first().is_some_and(|word| word.eq_ignore_ascii_case(b"BINARY")) {
        return Err(BadFile::new(Kind::NotRead, line.place(), "this OFF file is binary", "save it as text, or as PLY"));
    }
    if !same.is_empty() {
        return counts(&same, &line);
    }
    let next = lines.next_told().ok_or_else(|| counts_missing(&line))?;
    counts(&words(&next.text).collect::<Vec<_>>(), &next)
}

fn counts(words: &[&[u8]], line: &Line) -> Result<[usize; 2], BadFile> {
    let count = |at: usize| words.get(at).and_then(|word| whole(word)).and_then(|count| usize::try_from(count).ok());
    match (count(0), count(1)) {
        (Some(vertices), Some(faces)) if words.len() <= 3 => Ok([vertices, faces]),
        _ => Err(counts_missing(line)),
    }
}

fn counts_missing(line: &Line) -> BadFile {
    let help = "write them after OFF, as in `8 6 12`";
    syntax(line, "the numbers of vertices, faces and edges are needed", help)
}

fn not_off(line: &Line) -> BadFile {
    let first = words(&line.text).next().unwrap_or_default();
    syntax(line, &format!("the first word is {}, not OFF", shown(first)), "start the file with a line OFF")
}

fn syntax(line: &Line, message: &str, help: &str) -> BadFile {
    BadFile::new(Kind::Syntax, line.place(), message, help)
}

fn index_from_zero(word: &[u8], vertices: usize, line: &Line) -> Result<u32, BadFile> {
    let bad =
        || BadFile::new(Kind::Index, line.place(), format!("{} is no index", shown(word)), "write a whole number");
    let index = whole(word).ok_or_else(bad)?;
    let known = u32::try_from(index).ok().filter(|index| (*index as usize) < vertices);
    known.ok_or_else(|| no_vertex(index, vertices, 0, line.place()))
}

fn truncated(lines: &Lines, found: usize, announced: usize, what: &str) -> BadFile {
    let message = format!("the file ends after {found} of {announced} {what}");
    let help = "copy it again, or correct the numbers after OFF";
    BadFile::new(Kind::Truncated, Place::Line(lines.number()), message, help)
}
