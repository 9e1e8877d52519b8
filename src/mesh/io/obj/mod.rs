//! What does an OBJ file say?
//!
//! Statements are lines; faces name vertices that may come later, so indices are checked at the end.

mod tags;

use super::Read;
use super::bad_file::{BadFile, Kind, Place, shown};
use super::gather::{Gather, no_vertex};
use super::left_out::LeftOut;
use super::text::{Line, Lines, coordinates, whole, words};
pub(super) use tags::FOR_EVER;
use tags::Tags;

pub(super) fn read(bytes: &[u8]) -> Result<Read, BadFile> {
    let mut reader = Reader::default();
    for line in Lines::joined(bytes) {
        reader.statement(&line)?;
    }
    reader.finish(bytes)
}

#[derive(Default)]
struct Reader {
    gather: Gather,
    tags: Tags,
    left_out: LeftOut,
    unknown: Option<String>,
}

impl Reader {
    fn statement(&mut self, line: &Line) -> Result<(), BadFile> {
        let mut words = words(&line.text);
        match words.next() {
            None => Ok(()),
            Some(b"v") => self.vertex(words, line),
            Some(keyword) if is_face(keyword) => self.face(words, line),
            Some(b"t") => {
                let told = self.tags.read(words, self.gather.vertices(), line.number, &mut self.left_out);
                told.or_else(|fault| self.gather.fault(fault))
            }
            Some(keyword) => {
                self.leave_out(keyword, line.number);
                Ok(())
            }
        }
    }

    fn vertex<'a>(&mut self, mut words: impl Iterator<Item = &'a [u8]>, line: &Line) -> Result<(), BadFile> {
        self.gather.vertex(coordinates(&mut words, || line.place()))?;
        if words.next().is_some() {
            self.left_out.count("weights or colours of vertices, after x, y and z", line.number);
        }
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>, line: &Line) -> Result<(), BadFile> {
        let vertices = self.gather.vertices();
        let corners = words.map(|word| {
            let index = word.split(|byte| *byte == b'/').next().unwrap_or(word);
            vertex_index(index, vertices, line.number)
        });
        self.gather.face(corners, || line.place())
    }

    fn leave_out(&mut self, keyword: &[u8], line: usize) {
        let known = meaning(keyword);
        if known.is_none() && self.unknown.is_none() {
            self.unknown = Some(format!("the first unknown statement is {}, in line {line}", shown(keyword)));
        }
        self.left_out.count(known.unwrap_or("unknown statements"), line);
    }

    fn finish(self, bytes: &[u8]) -> Result<Read, BadFile> {
        let vertices = self.gather.vertices();
        if self.gather.is_sound()
            && let Some((face, vertex, more)) = self.gather.first_beyond()
        {
            let place = Place::Line(line_of_face(bytes, face));
            return Err(BadFile { more, ..no_vertex(u64::from(vertex) + 1, vertices, 1, place) });
        }
        let mut soup = self.gather.finish()?;
        self.tags.check(vertices)?;
        let mut notes: Vec<String> = self.left_out.notes().chain(self.unknown).collect();
        notes.extend(self.tags.loose(&soup.faces));
        (soup.creases, soup.corners) = self.tags.finish(&mut notes);
        Ok(Read { soup, notes })
    }
}

/// Whether a statement is a face; `fo` is the word of old files.
fn is_face(keyword: &[u8]) -> bool {
    keyword == b"f" || keyword == b"fo"
}

/// The vertex, from 0, that an index from 1 or back from the last vertex means.
fn vertex_index(word: &[u8], vertices: usize, line: usize) -> Result<u32, BadFile> {
    let bad = |message: String, help| BadFile::new(Kind::Index, Place::Line(line), message, help);
    let index =
        whole(word).ok_or_else(|| bad(format!("{} is no index of a vertex", shown(word)), "write a whole number"))?;
    let from_zero = match index {
        0 => return Err(bad("there is no vertex 0".into(), "OBJ counts from 1; add 1 to all indices")),
        1.. => index - 1,
        _ => index.saturating_add(vertices as i64),
    };
    u32::try_from(from_zero).map_err(|_| no_vertex(index, vertices, 1, Place::Line(line)))
}

/// The line of a face, in a file that has been read.
fn line_of_face(bytes: &[u8], face: usize) -> usize {
    let faces = Lines::joined(bytes).filter(|line| words(&line.text).next().is_some_and(is_face));
    faces.map(|line| line.number).nth(face).unwrap_or(1)
}

/// What a statement that is left out is about.
fn meaning(keyword: &[u8]) -> Option<&'static str> {
    Some(match keyword {
        b"vt" => "texture coordinates",
        b"vn" => "normals",
        b"g" | b"o" | b"mg" => "names and groups",
        b"s" => "smoothing groups",
        b"mtllib" | b"usemtl" | b"maplib" | b"usemap" => "materials and textures",
        b"p" | b"l" => "points and lines",
        b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm" | b"trim" | b"hole"
        | b"scrv" | b"sp" | b"end" | b"con" | b"bzp" | b"bsp" | b"cdc" | b"cdp" | b"res" => {
            "free-form curves and surfaces"
        }
        b"bevel" | b"c_interp" | b"d_interp" | b"lod" | b"shadow_obj" | b"trace_obj" | b"ctech" | b"stech" => {
            "statements for display"
        }
        b"call" | b"csh" => "calls of other files and programs",
        _ => return None,
    })
}
