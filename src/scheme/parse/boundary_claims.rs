//! How are the claims of a boundary file read?

use super::names::in_conditions;
use super::{Item, Reader};
use crate::fault::Fault;
use crate::scheme::RuleBook;
use crate::scheme::claim::{BoundaryClaim, BoundaryQuantity};
use std::collections::BTreeSet;
use toml::Spanned;
use toml::de::DeValue;

/// The kinds of vertex that a claim may be made at, and that a flatness is told for.
pub(super) const KINDS: [&str; 3] = ["crease", "corner", "dart"];

impl Reader<'_> {
    pub(super) fn boundary_claims(&mut self, items: &[Item], book: &RuleBook) -> Vec<BoundaryClaim> {
        let Some((value, span)) = self.find(items, "claims") else { return Vec::new() };
        let DeValue::Array(list) = value else {
            self.wrong_type(&span, "a list of tables, [[claims]],", value);
            return Vec::new();
        };
        list.iter().filter_map(|item| self.boundary_claim(item, book)).collect()
    }

    fn boundary_claim(&mut self, item: &Spanned<DeValue>, book: &RuleBook) -> Option<BoundaryClaim> {
        let span = item.span();
        let DeValue::Table(table) = item.get_ref() else {
            self.wrong_type(&span, "a table", item.get_ref());
            return None;
        };
        let items = self.items(table, &["at", "what", "where", "equals", "source"], "a claim of a boundary file");
        let at = self.choice(&items, "at", &KINDS)?;
        let Some((what, what_span)) = self.find(&items, "what") else {
            self.faults.push(Fault::at(span, "the claim doesn't say `what` it is about", "add what = \"C1\""));
            return None;
        };
        let what = self.string(what, &what_span)?;
        let Some(quantity) = BoundaryQuantity::parse(&what) else {
            let fault = Fault::at(what_span, format!("a claim of a boundary file can't be about `{what}`"), "unknown");
            self.faults.push(fault.hint(format!("it can be about {}", BoundaryQuantity::WORDS)));
            return None;
        };
        let mut known: BTreeSet<&str> = BTreeSet::from([if at == "dart" { "n" } else { "k" }]);
        known.extend(book.lets.iter().map(|own| own.name.as_str()));
        known.extend(book.parameters.iter().map(|own| own.name.as_str()));
        let told = self.find(&items, "equals");
        if told.is_some() != quantity.has_value() {
            let message = if quantity.has_value() { "the claim gives no value" } else { "this claim has no value" };
            let label = if quantity.has_value() { "add equals = \"...\"" } else { "leave `equals` out" };
            self.faults.push(Fault::at(what_span, message, label));
        }
        let equals = told.and_then(|(value, span)| self.formula(value, &span));
        equals.iter().for_each(|placed| self.check_names(placed, &known));
        let condition = self.find(&items, "where").and_then(|(value, span)| {
            let text = self.string(value, &span)?;
            let condition = self.condition(&text, &span)?;
            self.check_condition(&condition, &span, &in_conditions(&book.parameters));
            Some(condition)
        });
        let sources = self.words(&items, "source").into_iter().map(|(word, _)| word).collect();
        Some(BoundaryClaim { at, what, quantity, condition, equals, sources, span })
    }
}
