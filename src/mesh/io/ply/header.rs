//! What does the header of a PLY file announce?

use super::super::bad_file::{BadFile, Kind, Place, no_faces, shown};
use super::super::left_out::named;
use super::super::text::{Line, Lines, whole, words};

/// A header that was understood.
pub(super) struct Header {
    pub(super) body: Body,
    pub(super) elements: Vec<Element>,
    /// The number of vertices that are announced.
    pub(super) vertices: usize,
    /// The byte after the header, and its number of lines.
    pub(super) end: usize,
    pub(super) lines: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Body {
    Text,
    Binary(Order),
}

/// The order of the bytes of a number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    Little,
    Big,
}

pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
    pub(super) role: Role,
    line: usize,
}

/// What an element is to the mesh.
#[derive(Clone, Copy)]
pub(super) enum Role {
    /// The properties x, y and z.
    Vertices([usize; 3]),
    /// The property that lists the corners.
    Faces(usize),
    Other,
}

pub(super) struct Property {
    name: String,
    pub(super) shape: Shape,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    One(Scalar),
    List { count: Scalar, item: Scalar },
}

/// The types of numbers.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(word: &[u8]) -> Option<Scalar> {
        Some(match word {
            b"char" | b"int8" => Scalar::I8,
            b"uchar" | b"uint8" => Scalar::U8,
            b"short" | b"int16" => Scalar::I16,
            b"ushort" | b"uint16" => Scalar::U16,
            b"int" | b"int32" => Scalar::I32,
            b"uint" | b"uint32" => Scalar::U32,
            b"float" | b"float32" => Scalar::F32,
            b"double" | b"float64" => Scalar::F64,
            _ => return None,
        })
    }

    /// The number of bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }

    fn is_whole(self) -> bool {
        !matches!(self, Scalar::F32 | Scalar::F64)
    }
}

impl Element {
    /// The fewest bytes of a row of a binary file.
    pub(super) fn row(&self) -> usize {
        let least = |property: &Property| match property.shape {
            Shape::One(scalar) => scalar.size(),
            Shape::List { count, .. } => count.size(),
        };
        self.properties.iter().map(least).sum()
    }

    fn find(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|property| names.contains(&property.name.as_str()))
    }

    /// The properties x, y and z.
    fn axes(&self) -> Result<Role, BadFile> {
        let mut axes = [0; 3];
        for (axis, name) in axes.iter_mut().zip(["x", "y", "z"]) {
            let found = self.find(&[name]).filter(|at| matches!(self.properties[*at].shape, Shape::One(_)));
            *axis = found.ok_or_else(|| {
                syntax(self.line, format!("vertices have no number `{name}`"), "write `property float x`, y and z")
            })?;
        }
        Ok(Role::Vertices(axes))
    }

    /// The list of the corners.
    fn list(&self) -> Result<Role, BadFile> {
        let whole = |at: &usize| matches!(self.properties[*at].shape, Shape::List { item, .. } if item.is_whole());
        let list = self.find(&["vertex_indices", "vertex_index"]).filter(whole);
        list.map(Role::Faces).ok_or_else(|| {
            let help = "write `property list uchar int vertex_indices`";
            syntax(self.line, "faces have no list `vertex_indices` of whole numbers", help)
        })
    }

    /// The properties that are not read.
    fn unread(&self) -> impl Iterator<Item = &str> {
        let read = move |at: usize| match self.role {
            Role::Vertices(axes) => axes.contains(&at),
            Role::Faces(list) => list == at,
            Role::Other => false,
        };
        let unread = self.properties.iter().enumerate().filter(move |(at, _)| !read(*at));
        unread.map(|(_, property)| property.name.as_str())
    }
}

impl Header {
    /// Elements and properties that are not read, in a sentence each.
    pub(super) fn left_out(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let others = self.elements.iter().filter(|element| matches!(element.role, Role::Other) && element.count > 0);
        let others: Vec<&str> = others.map(|element| element.name.as_str()).collect();
        if !others.is_empty() {
            notes.push(format!("left out: elements {}", named(others.into_iter())));
        }
        for element in self.elements.iter().filter(|element| !matches!(element.role, Role::Other)) {
            if element.unread().next().is_some() {
                notes.push(format!("left out: of each {} {}", element.name, named(element.unread())));
            }
        }
        notes
    }

    /// Says which elements are the vertices and the faces.
    fn cast(&mut self) -> Result<(), BadFile> {
        let named = |elements: &[Element], name| elements.iter().position(|element| element.name == name);
        let missing =
            || syntax(self.lines, "no element `vertex` is announced", "write `element vertex`, and its number");
        let vertices = named(&self.elements, "vertex").ok_or_else(missing)?;
        let faces = named(&self.elements, "face").ok_or_else(no_faces)?;
        self.elements[vertices].role = self.elements[vertices].axes()?;
        self.elements[faces].role = self.elements[faces].list()?;
        self.vertices = self.elements[vertices].count;
        Ok(())
    }
}

/// Reads the header, which must be whole.
pub(super) fn read(bytes: &[u8]) -> Result<Header, BadFile> {
    let mut lines = Lines::headed(bytes);
    if lines.next().is_none_or(|line| line.text.trim_ascii() != b"ply") {
        return Err(syntax(1, "the first line is not `ply`", "check the format of the file"));
    }
    let (mut body, mut elements) = (None, Vec::new());
    while let Some(line) = lines.next() {
        let words: Vec<&[u8]> = words(&line.text).collect();
        match words[..] {
            [] | [b"comment" | b"obj_info", ..] => {}
            [b"format", name, ..] => body = Some(format(name, &line)?),
            [b"element", name, count] => elements.push(element(name, count, &line)?),
            [b"property", ref rest @ ..] => property(rest, &line, elements.last_mut())?,
            [b"end_header"] => {
                let body = body.ok_or_else(|| syntax(line.number, "no line `format` is there", "write one"))?;
                let end = bytes.len() - lines.rest().len();
                let mut header = Header { body, elements, vertices: 0, end, lines: line.number };
                header.cast()?;
                return Ok(header);
            }
            _ => return Err(unknown(&line)),
        }
    }
    let message = "the file ends within the header: there is no `end_header`";
    Err(BadFile::new(Kind::Truncated, Place::Line(lines.number()), message, "copy it again"))
}

fn format(name: &[u8], line: &Line) -> Result<Body, BadFile> {
    match name {
        b"ascii" => Ok(Body::Text),
        b"binary_little_endian" => Ok(Body::Binary(Order::Little)),
        b"binary_big_endian" => Ok(Body::Binary(Order::Big)),
        _ => {
            let message = format!("there is no format {}", shown(name));
            Err(syntax(line.number, message, "it is ascii, binary_little_endian or binary_big_endian"))
        }
    }
}

fn element(name: &[u8], count: &[u8], line: &Line) -> Result<Element, BadFile> {
    let number = whole(count).and_then(|count| usize::try_from(count).ok());
    let none = || syntax(line.number, format!("{} is no number of elements", shown(count)), "write a whole number");
    let name = String::from_utf8_lossy(name).into_owned();
    Ok(Element { name, count: number.ok_or_else(none)?, properties: Vec::new(), role: Role::Other, line: line.number })
}

fn property(words: &[&[u8]], line: &Line, element: Option<&mut Element>) -> Result<(), BadFile> {
    let named = |word: &[u8]| Scalar::named(word).ok_or_else(|| no_type(word, line));
    let (shape, name) = match words {
        [b"list", count, item, name] => (Shape::List { count: named(count)?, item: named(item)? }, name),
        [scalar, name] => (Shape::One(named(scalar)?), name),
        _ => return Err(unknown(line)),
    };
    if matches!(shape, Shape::List { count, .. } if !count.is_whole()) {
        return Err(syntax(line.number, "the length of a list is no whole number", "write `list uchar int`"));
    }
    let none = || syntax(line.number, "a property comes before any element", "write a line `element` before it");
    let name = String::from_utf8_lossy(name).into_owned();
    element.ok_or_else(none)?.properties.push(Property { name, shape });
    Ok(())
}

fn no_type(word: &[u8], line: &Line) -> BadFile {
    let help = "they are char, uchar, short, ushort, int, uint, float and double";
    syntax(line.number, format!("there is no type {}", shown(word)), help)
}

fn unknown(line: &Line) -> BadFile {
    let message = format!("{} is no line of a header", shown(line.text.trim_ascii()));
    syntax(line.number, message, "headers have `format`, `element`, `property`, `comment` and `end_header`")
}

fn syntax(line: usize, message: impl Into<String>, help: &str) -> BadFile {
    BadFile::new(Kind::Syntax, Place::Line(line), message, help)
}
