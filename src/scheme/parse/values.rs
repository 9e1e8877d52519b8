//! How are the values of a scheme file read: texts, lists, formulas, conditions, tables of cases?

use super::{Item, Reader};
use crate::fault::{Fault, nearest};
use crate::scheme::formula::{Condition, Formula};
use crate::scheme::{Cases, Placed};
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// The most entries of one table: names, parameters, positions or cases.
const MAX_ENTRIES: usize = 256;

impl Reader<'_> {
    /// A table's entries in the order of the file, as many as are allowed.
    pub(super) fn in_order<'a, 'i>(&mut self, table: &'a DeTable<'i>) -> Vec<Item<'a, 'i>> {
        let mut items: Vec<Item> =
            table.iter().map(|(key, value)| (key.get_ref().as_ref(), key.span(), value)).collect();
        items.sort_by_key(|(_, span, _)| span.start);
        if items.len() > MAX_ENTRIES {
            let message = format!("a table with {} entries; the limit is {MAX_ENTRIES}", items.len());
            self.faults.push(Fault::at(items[MAX_ENTRIES].1.clone(), message, "one too many"));
            items.truncate(MAX_ENTRIES);
        }
        items
    }

    /// A table's entries in the order of the file; keys that are not known become faults.
    pub(super) fn items<'a, 'i>(&mut self, table: &'a DeTable<'i>, known: &[&str], owner: &str) -> Vec<Item<'a, 'i>> {
        let items = self.in_order(table);
        for (key, span, _) in &items {
            if !known.contains(key) {
                let fault = Fault::at(span.clone(), format!("{owner} has no key `{key}`"), "unknown key");
                self.faults.push(fault.hint(did_you_mean(key, known)));
            }
        }
        items
    }

    pub(super) fn find<'a, 'i>(&self, items: &[Item<'a, 'i>], key: &str) -> Option<(&'a DeValue<'i>, Range<usize>)> {
        items.iter().find(|(name, ..)| *name == key).map(|(_, _, value)| (value.get_ref(), value.span()))
    }

    pub(super) fn wrong_type(&mut self, span: &Range<usize>, wanted: &str, found: &DeValue) {
        let label = format!("this is {} {}", article(found.type_str()), found.type_str());
        self.faults.push(Fault::at(span.clone(), format!("{wanted} is needed here"), label));
    }

    pub(super) fn string(&mut self, value: &DeValue, span: &Range<usize>) -> Option<String> {
        if let DeValue::String(text) = value {
            return Some(text.to_string());
        }
        self.wrong_type(span, "a text in quotes", value);
        None
    }

    pub(super) fn choice(&mut self, items: &[Item], key: &str, known: &[&str]) -> Option<String> {
        let Some((value, span)) = self.find(items, key) else {
            let fault = Fault::whole(format!("the key `{key}` is missing"));
            self.faults.push(fault.hint(format!("write {key} = one of {}", quoted(known))));
            return None;
        };
        let word = self.string(value, &span)?;
        if known.contains(&word.as_str()) {
            return Some(word);
        }
        let fault = Fault::at(span, format!("there is no {key} `{word}`"), "unknown");
        self.faults.push(fault.hint(did_you_mean(&word, known)));
        None
    }

    /// A text or a list of texts, each with its place.
    pub(super) fn words(&mut self, items: &[Item], key: &str) -> Vec<(String, Range<usize>)> {
        let Some((value, span)) = self.find(items, key) else { return Vec::new() };
        match value {
            DeValue::Array(list) => {
                list.iter().filter_map(|item| Some((self.string(item.get_ref(), &item.span())?, item.span()))).collect()
            }
            _ => self.string(value, &span).map(|word| vec![(word, span)]).unwrap_or_default(),
        }
    }

    /// A formula: a text, or a number as it stands in the file.
    pub(super) fn formula(&mut self, value: &DeValue, span: &Range<usize>) -> Option<Placed> {
        let (text, start) = match value {
            DeValue::String(text) => (text.to_string(), self.start_of(span, text)),
            DeValue::Integer(_) | DeValue::Float(_) => (
                self.text[span.clone()].replace('_', ""),
                Some(span.start).filter(|_| !self.text[span.clone()].contains('_')),
            ),
            _ => {
                self.wrong_type(span, "a formula in quotes", value);
                return None;
            }
        };
        match Formula::parse(&text) {
            Ok(formula) => Some(Placed { formula, span: span.clone(), start }),
            Err(mut fault) => {
                let inner = fault.span.take().unwrap_or(0..0);
                fault.span = Some(start.map_or(span.clone(), |start| start + inner.start..start + inner.end));
                self.faults.push(fault);
                None
            }
        }
    }

    /// Where a text's first byte stands in the file, when the file holds it letter by letter.
    pub(super) fn start_of(&self, span: &Range<usize>, text: &str) -> Option<usize> {
        [1, 3]
            .into_iter()
            .map(|quotes| span.start + quotes)
            .find(|start| self.text.get(*start..start + text.len()) == Some(text) && start + text.len() < span.end)
    }

    /// A condition, from the key of a table of cases or from a claim.
    pub(super) fn condition(&mut self, text: &str, span: &Range<usize>) -> Option<Condition> {
        let start = self.start_of(span, text);
        match Condition::parse(text) {
            Ok(condition) => Some(condition),
            Err(mut fault) => {
                let inner = fault.span.take().unwrap_or(0..0);
                fault.span = Some(start.map_or(span.clone(), |start| start + inner.start..start + inner.end));
                self.faults.push(fault.hint("a condition compares, for example `n == 3` or `4 <= n <= 6 or n > 8`"));
                None
            }
        }
    }

    /// A value told once, or a table of cases.
    pub(super) fn cases<T>(
        &mut self,
        value: &DeValue,
        span: &Range<usize>,
        mut read: impl FnMut(&mut Self, &DeValue, &Range<usize>) -> Option<T>,
    ) -> Option<Cases<T>> {
        let DeValue::Table(table) = value else { return read(self, value, span).map(Cases::Always) };
        let mut cases = Vec::new();
        for (key, key_span, value) in self.in_order(table) {
            let condition = self.condition(key, &key_span);
            let told = read(self, value.get_ref(), &value.span());
            if let (Some(condition), Some(told)) = (condition, told) {
                cases.push((condition, key_span, told));
            }
        }
        if table.is_empty() {
            self.faults.push(Fault::at(span.clone(), "a table of cases has no case", "empty"));
        }
        (cases.len() == table.len() && !cases.is_empty()).then_some(Cases::When(cases))
    }
}

pub(super) fn quoted(words: &[&str]) -> String {
    words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ")
}

pub(super) fn did_you_mean(word: &str, known: &[&str]) -> String {
    match nearest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("known are {}", quoted(known)),
    }
}

pub(super) fn article(word: &str) -> &'static str {
    if word.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}
