//! What are the lines, words and numbers of a text?

use super::bad_file::{BadFile, Kind, Place, shown};
use std::borrow::Cow;

/// A line of a text, without its end.
pub(super) struct Line<'a> {
    /// Counted from 1; where lines are joined, that of the first.
    pub(super) number: usize,
    pub(super) text: Cow<'a, [u8]>,
}

impl Line<'_> {
    pub(super) fn place(&self) -> Place {
        Place::Line(self.number)
    }
}

/// The lines of a text, ended by line feeds, or by carriage returns where there are no line feeds.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    end: u8,
    /// Lines that have been taken.
    number: usize,
    joined: bool,
}

impl<'a> Lines<'a> {
    /// Lines as they stand.
    pub(super) fn new(bytes: &'a [u8]) -> Lines<'a> {
        let rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let end = if rest.contains(&b'\n') || !rest.contains(&b'\r') { b'\n' } else { b'\r' };
        Lines { rest, end, number: 0, joined: false }
    }

    /// Lines of which those that end with a backslash go on in the next, unless they have a comment.
    pub(super) fn joined(bytes: &'a [u8]) -> Lines<'a> {
        Lines { joined: true, ..Lines::new(bytes) }
    }

    /// Lines ended by line feeds or carriage returns, as the first one is, of a header before binary data.
    pub(super) fn headed(bytes: &'a [u8]) -> Lines<'a> {
        let end = bytes.iter().copied().find(|byte| *byte == b'\n' || *byte == b'\r').unwrap_or(b'\n');
        let feeds = end == b'\n' || bytes.windows(2).find(|pair| pair[0] == b'\r').is_some_and(|pair| pair[1] == b'\n');
        Lines { rest: bytes, end: if feeds { b'\n' } else { b'\r' }, number: 0, joined: false }
    }

    /// The lines from a byte on, before which there are `number` lines.
    pub(super) fn after(bytes: &'a [u8], start: usize, number: usize) -> Lines<'a> {
        Lines { number, ..Lines::new(&bytes[start..]) }
    }

    /// The number of the last line that was taken.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// What has not been taken.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next line that says something.
    pub(super) fn next_told(&mut self) -> Option<Line<'a>> {
        self.find(|line| words(&line.text).next().is_some())
    }

    /// The same, of lines as they stand.
    pub(super) fn take_told(&mut self) -> Option<&'a [u8]> {
        while !self.rest.is_empty() {
            let line = self.take_line();
            if words(line).next().is_some() {
                return Some(line);
            }
        }
        None
    }

    fn take_line(&mut self) -> &'a [u8] {
        self.number += 1;
        let (line, rest) = match self.rest.iter().position(|byte| *byte == self.end) {
            Some(at) => (&self.rest[..at], &self.rest[at + 1..]),
            None => (self.rest, &self.rest[self.rest.len()..]),
        };
        self.rest = rest;
        line
    }

    fn join(&mut self, start: &'a [u8]) -> Cow<'a, [u8]> {
        let mut whole = start.to_vec();
        let mut last = start;
        while let Some(end) = continued(last) {
            whole.truncate(whole.len() - (last.len() - end));
            whole.push(b' ');
            last = if self.rest.is_empty() { &[] } else { self.take_line() };
            whole.extend_from_slice(last);
        }
        Cow::Owned(whole)
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        let text = self.take_line();
        let number = self.number;
        let joins = self.joined && continued(text).is_some();
        Some(Line { number, text: if joins { self.join(text) } else { Cow::Borrowed(text) } })
    }
}

/// Where the backslash stands at which a line goes on in the next one.
fn continued(line: &[u8]) -> Option<usize> {
    let text = line.strip_suffix(b"\r").unwrap_or(line);
    let at = text.len().checked_sub(1)?;
    (text[at] == b'\\' && !text.contains(&b'#')).then_some(at)
}

/// The words of a line, up to a comment.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).take_while(|word| word[0] != b'#')
}

/// Takes a word off the start of a line.
pub(super) fn next_word<'a>(line: &mut &'a [u8]) -> Option<&'a [u8]> {
    let text = line.trim_ascii_start();
    let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
    let word;
    (word, *line) = text.split_at(end);
    (!word.is_empty()).then_some(word)
}

/// A whole number.
pub(super) fn whole(word: &[u8]) -> Option<i64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A number, perhaps not a finite one, to its last digit.
pub(super) fn real(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// The three coordinates at the start of these words.
pub(super) fn coordinates<'a>(
    words: &mut impl Iterator<Item = &'a [u8]>,
    place: impl Fn() -> Place,
) -> Result<[f64; 3], BadFile> {
    let mut position = [0.0; 3];
    for (axis, value) in position.iter_mut().enumerate() {
        let word = words.next().ok_or_else(|| too_few(axis, place()))?;
        *value = real(word).filter(|value| value.is_finite()).ok_or_else(|| no_coordinate(word, place()))?;
    }
    Ok(position)
}

fn too_few(found: usize, place: Place) -> BadFile {
    let message =
        format!("a vertex needs three coordinates, but {found} {} here", if found == 1 { "is" } else { "are" });
    BadFile::new(Kind::Number, place, message, "give x, y and z on one line")
}

fn no_coordinate(word: &[u8], place: Place) -> BadFile {
    let message = format!("the coordinate {} is not a finite number", shown(word));
    BadFile::new(Kind::Number, place, message, "write it as in 1.5 or -2e-3, with a point and no comma")
}

/// Whether bytes are text at all.
///
/// # Errors
/// The line of the first byte of 0.
pub(super) fn check(bytes: &[u8]) -> Result<(), BadFile> {
    if !bytes.contains(&0) {
        return Ok(());
    }
    let before = bytes.iter().take_while(|byte| **byte != 0);
    let line = 1 + before.filter(|byte| **byte == b'\n').count();
    let (message, help) = if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        ("the text is in UTF-16", "save it as UTF-8")
    } else {
        ("a byte of 0 stands here: this is no text", "check the format, and how the file was copied")
    };
    Err(BadFile::new(Kind::NotText, Place::Line(line), message, help))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(lines: Lines) -> Vec<(usize, String)> {
        lines.map(|line| (line.number, String::from_utf8_lossy(&line.text).into_owned())).collect()
    }

    #[test]
    fn lines_end_and_go_on_as_they_should() {
        let pairs = |list: &[(usize, &str)]| list.iter().map(|(n, t)| (*n, t.to_string())).collect::<Vec<_>>();
        assert_eq!(all(Lines::new(b"\xef\xbb\xbfa\n\nb")), pairs(&[(1, "a"), (2, ""), (3, "b")]));
        assert_eq!(all(Lines::new(b"a\rb\r")), pairs(&[(1, "a"), (2, "b")]));
        assert_eq!(all(Lines::joined(b"a\\\nb\\\r\nc\nd")), pairs(&[(1, "a b c"), (4, "d")]));
        assert_eq!(all(Lines::joined(b"# a\\\nb\\")), pairs(&[(1, "# a\\"), (2, "b ")]));
        assert_eq!(all(Lines::joined(b"\\\n\\\n\\\n")), pairs(&[(1, "   ")]));
    }
}
