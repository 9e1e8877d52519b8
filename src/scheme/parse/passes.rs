//! How are the passes of a step read?

use super::{Item, Reader};
use crate::fault::Fault;
use crate::scheme::vocabulary::RuleKind;
use crate::scheme::{MOST_PASSES, Pass, RuleBook};
use std::collections::BTreeSet;
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

const PASS_KEYS: [&str; 6] = ["split", "repeat", "vertex", "edge", "face", "corner"];

impl Reader<'_> {
    /// The tables `[[pass]]`.
    pub(super) fn passes(
        &mut self,
        book: &RuleBook,
        value: &DeValue,
        span: &Range<usize>,
        mesh: Option<&str>,
    ) -> Vec<Pass> {
        let DeValue::Array(list) = value else {
            self.wrong_type(span, "a list of tables, [[pass]],", value);
            return Vec::new();
        };
        if list.is_empty() || list.len() > MOST_PASSES {
            let message = format!("a step has 1 to {MOST_PASSES} passes, not {}", list.len());
            self.faults.push(Fault::at(span.clone(), message, "these passes"));
            return Vec::new();
        }
        list.iter().filter_map(|item| self.pass(book, item, mesh)).collect()
    }

    fn pass(&mut self, book: &RuleBook, item: &Spanned<DeValue>, mesh: Option<&str>) -> Option<Pass> {
        let span = item.span();
        let DeValue::Table(table) = item.get_ref() else {
            self.wrong_type(&span, "a table", item.get_ref());
            return None;
        };
        let items = self.items(table, &PASS_KEYS, "a pass");
        if self.find(&items, "split").is_none() {
            let fault = Fault::at(span, "this pass has no `split`", "");
            self.faults.push(fault.hint("write split = \"keep\" where faces stay as they are"));
            return None;
        }
        let split = self.split(&items, mesh);
        let repeat = self.find(&items, "repeat").and_then(|(value, span)| self.formula(value, &span));
        if let Some(placed) = &repeat {
            let known: BTreeSet<&str> = book.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
            self.check_names(placed, &known);
        }
        let rules = self.rules(book, &items, mesh, false);
        let split = split?;
        let (_, at) = self.find(&items, "split")?;
        self.check_births(&rules, &split, at);
        Some(Pass { split, rules, repeat, span })
    }

    /// A step of several passes has its splits and rules in them.
    pub(super) fn nothing_beside_passes(&mut self, items: &[Item]) {
        for (key, span, _) in items {
            if *key == "split" || RuleKind::ALL.iter().any(|(name, _)| name == key) {
                let message = format!("`{key}` stands beside [[pass]]");
                let fault = Fault::at(span.clone(), message, "told for the whole step");
                self.faults.push(fault.hint("a step of several passes has a split and rules in each of them"));
            }
        }
    }
}
