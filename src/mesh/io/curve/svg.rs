//! What do the paths of an SVG file say?
//!
//! Straight lines only: a curved piece has no control polygon here, and is refused.

use super::super::bad_file::{BadFile, Kind, Place, shown};
use super::Told;

pub(super) fn read(bytes: &[u8]) -> Result<Vec<Told>, BadFile> {
    let text = String::from_utf8_lossy(bytes);
    let text = without_comments(&text);
    let mut all = Vec::new();
    for (start, tag) in tags(&text) {
        let place = Place::Line(1 + text[..start].matches('\n').count());
        let name = tag.split(|c: char| c.is_whitespace() || c == '/').next().unwrap_or_default();
        let found = match name {
            "path" => attribute(tag, "d").map(|data| path(data, &place)).transpose()?,
            "polyline" | "polygon" => {
                let list = attribute(tag, "points").map(|data| list(data, name == "polygon", &place)).transpose()?;
                list.map(|told| vec![told])
            }
            _ => None,
        };
        all.extend(found.into_iter().flatten());
    }
    Ok(all)
}

/// The text with comments blanked out, so that places stay.
fn without_comments(text: &str) -> String {
    let mut rest = text;
    let mut kept = String::with_capacity(text.len());
    while let Some(start) = rest.find("<!--") {
        let end = rest[start..].find("-->").map_or(rest.len(), |end| start + end + 3);
        kept.push_str(&rest[..start]);
        kept.extend(rest[start..end].chars().map(|c| if c == '\n' { '\n' } else { ' ' }));
        rest = &rest[end..];
    }
    kept + rest
}

/// The inside of each tag with its place.
fn tags(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.match_indices('<').filter_map(|(start, _)| {
        let inside = &text[start + 1..];
        Some((start, &inside[..inside.find('>')?]))
    })
}

/// The value of an attribute.
fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    for (at, _) in tag.match_indices(name) {
        let before = tag[..at].chars().next_back();
        let after = tag[at + name.len()..].trim_start();
        if let (true, Some(value)) = (before.is_some_and(char::is_whitespace), after.strip_prefix('=')) {
            let value = value.trim_start();
            let quote = value.chars().next().filter(|c| *c == '"' || *c == '\'')?;
            return value[1..].split(quote).next();
        }
    }
    None
}

fn list(data: &str, closed: bool, place: &Place) -> Result<Told, BadFile> {
    let numbers = Scanner { rest: data, place }.numbers()?;
    let mut told = Told { closed, ..Told::default() };
    if numbers.len() % 2 != 0 {
        let message = format!("{} numbers don't make points of two", numbers.len());
        return Err(BadFile::new(Kind::Number, place.clone(), message, "write points=\"0,0 1,2\""));
    }
    numbers.chunks(2).try_for_each(|pair| told.push(pair, place))?;
    Ok(told)
}

struct Scanner<'a> {
    rest: &'a str,
    place: &'a Place,
}

impl Scanner<'_> {
    fn skip(&mut self) {
        self.rest = self.rest.trim_start_matches(|c: char| c.is_whitespace() || c == ',');
    }

    /// The next letter, if one stands here.
    fn letter(&mut self) -> Option<char> {
        self.skip();
        let letter = self.rest.chars().next().filter(char::is_ascii_alphabetic)?;
        self.rest = &self.rest[1..];
        Some(letter)
    }

    fn number(&mut self) -> Result<Option<f64>, BadFile> {
        self.skip();
        if self.rest.is_empty() || self.rest.starts_with(|c: char| c.is_ascii_alphabetic()) {
            return Ok(None);
        }
        let bytes = self.rest.as_bytes();
        let mut end = usize::from(matches!(bytes.first(), Some(b'-' | b'+')));
        let (mut point, mut exponent) = (false, false);
        while let Some(byte) = bytes.get(end) {
            match byte {
                b'0'..=b'9' => {}
                b'.' if !point && !exponent => point = true,
                b'e' | b'E' if !exponent => exponent = true,
                b'-' | b'+' if matches!(bytes[end - 1], b'e' | b'E') => {}
                _ => break,
            }
            end += 1;
        }
        let word = self.rest.get(..end).unwrap_or_default();
        let value = word.parse::<f64>().map_err(|_| {
            let message = format!("{} is not a number", shown(self.rest.as_bytes()));
            BadFile::new(Kind::Number, self.place.clone(), message, "write coordinates as in 1.5 or -2e-3")
        })?;
        self.rest = &self.rest[end..];
        Ok(Some(value))
    }

    fn numbers(mut self) -> Result<Vec<f64>, BadFile> {
        let mut all = Vec::new();
        while let Some(value) = self.number()? {
            all.push(value);
        }
        self.skip();
        match self.rest {
            "" => Ok(all),
            rest => {
                let message = format!("{} is not a number", shown(rest.as_bytes()));
                Err(BadFile::new(Kind::Number, self.place.clone(), message, "write points=\"0,0 1,2\""))
            }
        }
    }
}

fn path(data: &str, place: &Place) -> Result<Vec<Told>, BadFile> {
    let syntax = |message: String| {
        let help = "paths are made of M, L, H, V and Z, as in d=\"M 0 0 L 1 2 L 3 0 Z\"";
        BadFile::new(Kind::Syntax, place.clone(), message, help)
    };
    let mut scanner = Scanner { rest: data, place };
    let (mut all, mut own) = (Vec::new(), Told::default());
    let (mut at, mut start) = ([0.0, 0.0], [0.0, 0.0]);
    while let Some(letter) = scanner.letter() {
        let relative = letter.is_ascii_lowercase();
        let kind = letter.to_ascii_uppercase();
        if !"MLHVZ".contains(kind) {
            return Err(syntax(format!("the path has a piece `{letter}`, which is no straight line")));
        }
        if kind == 'Z' {
            own.closed = true;
            all.push(std::mem::take(&mut own));
            at = start;
            continue;
        }
        let mut first = true;
        while let Some(value) = scanner.number()? {
            let base = if relative { at } else { [0.0, 0.0] };
            let new = match kind {
                'H' => [base[0] + value, at[1]],
                'V' => [at[0], base[1] + value],
                _ => {
                    let y = scanner.number()?.ok_or_else(|| syntax(format!("a point after `{letter}` has no y")))?;
                    [base[0] + value, base[1] + y]
                }
            };
            if kind == 'M' && first {
                if !own.points.is_empty() {
                    all.push(std::mem::take(&mut own));
                }
                start = new;
            } else if own.points.is_empty() {
                // a piece after Z goes on from the start of the one before
                own.push(&at, place)?;
            }
            own.push(&new, place)?;
            (at, first) = (new, false);
        }
        if first {
            return Err(syntax(format!("no point follows `{letter}`")));
        }
    }
    scanner.skip();
    if !scanner.rest.is_empty() {
        return Err(syntax(format!("{} starts no piece of a path", shown(scanner.rest.as_bytes()))));
    }
    if !own.points.is_empty() {
        all.push(own);
    }
    Ok(all)
}
