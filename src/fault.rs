//! What is wrong with this file, where, and what is to be done?
//!
//! A [`Fault`] points at a stretch of a file; [`Faults`] are all faults of one file together, so that its user mends them
//! in one go. They print with the line, the words underlined, and a hint.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use std::fmt;
use std::ops::Range;

/// The most faults that are printed for one file.
const MOST_PRINTED: usize = 20;

/// One thing wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What is wrong, in one line.
    pub message: String,
    /// Where: bytes of the file; `None` when it is about the file as a whole.
    pub span: Option<Range<usize>>,
    /// What stands at that place, in a few words.
    pub label: String,
    /// What to do about it.
    pub hint: Option<String>,
}

impl Fault {
    /// A fault at a place of the file.
    pub fn at(span: Range<usize>, message: impl Into<String>, label: impl Into<String>) -> Self {
        Fault { message: message.into(), span: Some(span), label: label.into(), hint: None }
    }

    /// A fault of the file as a whole.
    pub fn whole(message: impl Into<String>) -> Self {
        Fault { message: message.into(), span: None, label: String::new(), hint: None }
    }

    /// The same fault with what to do about it.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

/// All faults of one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faults {
    /// The file's name, as its user wrote it.
    pub origin: String,
    /// The file's text.
    pub text: String,
    /// What is wrong; never empty.
    pub faults: Vec<Fault>,
}

impl Faults {
    /// The faults as text for people, each with its line and a caret; `styled` with terminal colours.
    pub fn render(&self, styled: bool) -> String {
        let renderer = if styled { Renderer::styled() } else { Renderer::plain() };
        let shown: Vec<String> =
            self.faults.iter().take(MOST_PRINTED).map(|fault| self.render_one(&renderer, fault)).collect();
        let left = self.faults.len().saturating_sub(MOST_PRINTED);
        let more = if left > 0 { format!("\n\n... and {left} more") } else { String::new() };
        format!("{}{more}", shown.join("\n\n"))
    }

    fn render_one(&self, renderer: &Renderer, fault: &Fault) -> String {
        let title = Level::ERROR.primary_title(fault.message.as_str());
        let mut group = match &fault.span {
            None => Group::with_title(title).element(Level::NOTE.message(format!("in {}", self.origin))),
            Some(span) => {
                let end = span.end.min(self.text.len());
                let span = span.start.min(end)..end;
                let label = Some(fault.label.as_str()).filter(|label| !label.is_empty());
                let mark = AnnotationKind::Primary.span(span).label(label);
                title.element(Snippet::source(self.text.as_str()).path(self.origin.as_str()).annotation(mark))
            }
        };
        if let Some(hint) = &fault.hint {
            group = group.element(Level::HELP.message(hint.as_str()));
        }
        renderer.render(&[group])
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Faults {}

/// The word of a list that the user may have meant, if one is near.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let near = |other: &str| strsim::damerau_levenshtein(&word.to_lowercase(), &other.to_lowercase());
    let few = |distance: usize, other: &str| distance * 3 <= word.chars().count().max(other.chars().count());
    known
        .into_iter()
        .map(|other| (near(other), other))
        .filter(|(d, other)| few(*d, other))
        .min()
        .map(|(_, other)| other)
}
