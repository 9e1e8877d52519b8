//! What did a reader leave out, how often, and where first?

/// Things of a text that are left out, a kind each.
#[derive(Default)]
pub(super) struct LeftOut {
    kinds: Vec<Kind>,
}

struct Kind {
    what: &'static str,
    first: usize,
    count: usize,
}

impl LeftOut {
    /// One more of a kind, in a line.
    pub(super) fn count(&mut self, what: &'static str, line: usize) {
        match self.kinds.iter_mut().find(|kind| kind.what == what) {
            Some(kind) => kind.count += 1,
            None => self.kinds.push(Kind { what, first: line, count: 1 }),
        }
    }

    /// A sentence on each kind, in the order in which they were met.
    pub(super) fn notes(&self) -> impl Iterator<Item = String> {
        self.kinds.iter().map(|Kind { what, first, count }| match count {
            1 => format!("left out: {what} (line {first})"),
            _ => format!("left out: {what} ({count} lines, the first is {first})"),
        })
    }
}

/// Names in a sentence, the first few.
pub(super) fn named<'a>(names: impl Iterator<Item = &'a str>) -> String {
    const MOST: usize = 8;
    let names: Vec<&str> = names.collect();
    let shown: Vec<String> = names.iter().take(MOST).map(|name| super::bad_file::shown(name.as_bytes())).collect();
    let more = if names.len() > MOST { format!(" and {} more", names.len() - MOST) } else { String::new() };
    format!("{}{more}", shown.join(", "))
}
