//! What does an STL file of text say?

use super::super::bad_file::{BadFile, Kind, Place, shown};
use super::super::left_out::LeftOut;
use super::super::text::{Line, Lines, coordinates, words};
use super::super::{Read, text};
use super::weld::Weld;

pub(super) fn read(bytes: &[u8]) -> Result<Read, BadFile> {
    text::check(bytes)?;
    let mut reader = Reader::default();
    let mut lines = Lines::new(bytes);
    while let Some(line) = lines.next_told() {
        reader.statement(&line)?;
    }
    if reader.open {
        reader.weld.fault(truncated(&lines))?;
    }
    Ok(Read { soup: reader.weld.finish()?, notes: reader.left_out.notes().collect() })
}

#[derive(Default)]
struct Reader {
    weld: Weld,
    left_out: LeftOut,
    /// The line of the facet that is being read, and its points so far.
    facet: Option<usize>,
    points: Vec<Result<[f64; 3], BadFile>>,
    /// Whether a solid has begun and not ended; and how many have begun.
    open: bool,
    solids: usize,
}

impl Reader {
    fn statement(&mut self, line: &Line) -> Result<(), BadFile> {
        let mut words = words(&line.text);
        let keyword = words.next().unwrap_or_default().to_ascii_lowercase();
        match (keyword.as_slice(), self.facet) {
            (b"solid", None) => self.solid(line),
            (b"facet", None) if self.open => self.facet = Some(line.number),
            (b"outer" | b"endloop", Some(_)) => {}
            (b"vertex", Some(_)) => self.points.push(coordinates(&mut words, || line.place())),
            (b"endfacet", Some(start)) => return self.end_facet(start),
            (b"endsolid", None) if self.open => self.open = false,
            _ => return self.weld.fault(out_of_place(&keyword, line)),
        }
        Ok(())
    }

    fn solid(&mut self, line: &Line) {
        self.open = true;
        self.solids += 1;
        if self.solids > 1 {
            self.left_out.count("that solids after the first are parts of their own", line.number);
        }
    }

    fn end_facet(&mut self, start: usize) -> Result<(), BadFile> {
        self.facet = None;
        let count = self.points.len();
        let points: Result<Vec<[f64; 3]>, BadFile> = self.points.drain(..).collect();
        match points.map(<[[f64; 3]; 3]>::try_from) {
            Ok(Ok(points)) => self.weld.triangle(points, || Place::Line(start)),
            Ok(Err(_)) => {
                let message = format!("a facet has {count} vertices, but needs three");
                self.weld.fault(BadFile::new(Kind::Face, Place::Line(start), message, "mend it, or take it out"))
            }
            Err(fault) => self.weld.fault(fault),
        }
    }
}

fn out_of_place(keyword: &[u8], line: &Line) -> BadFile {
    let message = format!("{} has no place here", shown(keyword));
    let help =
        "a facet is `facet normal`, `outer loop`, three lines `vertex x y z`, `endloop`, `endfacet`, within a `solid`";
    BadFile::new(Kind::Syntax, line.place(), message, help)
}

fn truncated(lines: &Lines) -> BadFile {
    let message = "the file ends within a solid: there is no `endsolid`";
    BadFile::new(Kind::Truncated, Place::Line(lines.number()), message, "copy it again, or add the end")
}
