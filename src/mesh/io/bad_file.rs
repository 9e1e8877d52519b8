//! What is wrong with a mesh file, where, and what is to be done about it?

use super::Format;
use std::fmt;

/// The first fault of a mesh file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadFile {
    /// What kind of fault.
    pub kind: Kind,
    /// Where.
    pub place: Place,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: String,
    /// How many more faults of this kind were met after it.
    pub more: usize,
}

/// Kinds of faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// The file has nothing in it.
    Empty,
    /// Files of this format are not read, or not in this variety.
    NotRead,
    /// Bytes that are not text, in a format that is.
    NotText,
    /// The head of the file, or a statement, is not as the format wants it.
    Syntax,
    /// The file ends too early, or announces what its size can't hold.
    Truncated,
    /// A coordinate that is not a finite number.
    Number,
    /// An index that is none, or of no vertex.
    Index,
    /// A face with fewer than three corners, or with one twice.
    Face,
    /// A crease or corner that is not told as it should be.
    Tag,
    /// More than can be numbered.
    TooLarge,
    /// There is no face.
    NoFaces,
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    Whole,
    /// A line, counted from 1.
    Line(usize),
    /// An element of a binary file.
    Element {
        /// What it is: `vertex`, `face`, `facet`, or as the file says.
        what: String,
        /// Which of these, counted from 0.
        index: usize,
        /// The byte of the file at which it starts, or at which reading stopped.
        byte: usize,
    },
}

impl BadFile {
    pub(super) fn new(kind: Kind, place: Place, message: impl Into<String>, help: impl Into<String>) -> BadFile {
        BadFile { kind, place, message: message.into(), help: help.into(), more: 0 }
    }

    /// The line of the fault, in a file of text.
    pub fn line(&self) -> Option<usize> {
        if let Place::Line(line) = self.place { Some(line) } else { None }
    }

    /// Whether what follows can't be read after it.
    pub(super) fn is_fatal(&self) -> bool {
        matches!(self.kind, Kind::Syntax | Kind::Truncated | Kind::TooLarge)
    }

    pub(super) fn looks_like(mut self, other: Format) -> BadFile {
        self.help = format!("the file starts as {other} does: give it the ending `.{}`", other.ending());
        self
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Whole => write!(f, "the file"),
            Place::Line(line) => write!(f, "line {line}"),
            Place::Element { what, index, byte } => write!(f, "{what} {index} (counted from 0), at byte {byte}"),
        }
    }
}

impl fmt::Display for BadFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)?;
        match self.more {
            0 => {}
            1 => write!(f, ", and one more fault of this kind")?,
            more => write!(f, ", and {more} more faults of this kind")?,
        }
        write!(f, "; {}", self.help)
    }
}

impl std::error::Error for BadFile {}

/// Bytes of a file as they can be shown: printable, and not too long.
pub(super) fn shown(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    let cut = &word[..word.len().min(LONGEST)];
    let dots = if word.len() > LONGEST { "..." } else { "" };
    format!("`{}{dots}`", String::from_utf8_lossy(cut).escape_debug())
}

pub(super) fn empty() -> BadFile {
    BadFile::new(Kind::Empty, Place::Whole, "there is nothing in it", "check how it was made or copied")
}

pub(super) fn not_read() -> BadFile {
    let help = "convert it to OBJ, PLY, OFF or STL with another program";
    BadFile::new(Kind::NotRead, Place::Whole, "glTF files are written, but not read", help)
}

pub(super) fn no_faces() -> BadFile {
    let help = "a mesh needs faces: points, lines and free-form surfaces alone don't make one";
    BadFile::new(Kind::NoFaces, Place::Whole, "there is no face in it", help)
}
