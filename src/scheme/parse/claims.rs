//! How are claims read?

use super::names::in_conditions;
use super::{Item, Reader};
use crate::fault::Fault;
use crate::scheme::RuleBook;
use crate::scheme::claim::{Claim, Quantity};
use crate::scheme::vocabulary::{RuleKind, Vocabulary};
use std::collections::BTreeSet;
use toml::Spanned;
use toml::de::DeValue;

impl Reader<'_> {
    pub(super) fn claims(&mut self, items: &[Item], book: &RuleBook) -> Vec<Claim> {
        let Some((value, span)) = self.find(items, "claims") else { return Vec::new() };
        let DeValue::Array(list) = value else {
            self.wrong_type(&span, "a list of tables, [[claims]],", value);
            return Vec::new();
        };
        list.iter().filter_map(|item| self.claim(item, book)).collect()
    }

    pub(super) fn claim(&mut self, item: &Spanned<DeValue>, book: &RuleBook) -> Option<Claim> {
        let span = item.span();
        let DeValue::Table(table) = item.get_ref() else {
            self.wrong_type(&span, "a table", item.get_ref());
            return None;
        };
        let items = self.items(table, &["what", "where", "equals", "source"], "a claim");
        let Some((what, what_span)) = self.find(&items, "what") else {
            self.faults.push(Fault::at(span, "the claim doesn't say `what` it is about", "add what = \"C1\""));
            return None;
        };
        let what = self.string(what, &what_span)?;
        let Some(quantity) = Quantity::parse(&what) else {
            let fault = Fault::at(what_span, format!("a claim can't be about `{what}`"), "unknown");
            self.faults.push(fault.hint(format!("it can be about {}", Quantity::WORDS)));
            return None;
        };
        if let Quantity::Limit(position) = &quantity {
            let dual = book.rules.contains_key(&RuleKind::Corner);
            let kind = if dual { RuleKind::Corner } else { RuleKind::Vertex };
            if Vocabulary::get().find(kind, None, position).is_none() {
                self.unknown_position(kind, None, position, what_span);
                return None;
            }
        }
        let mut known: BTreeSet<&str> = BTreeSet::from(["n"]);
        known.extend(book.lets.iter().map(|l| l.name.as_str()));
        known.extend(book.parameters.iter().map(|p| p.name.as_str()));
        let equals = self.find(&items, "equals").and_then(|(v, s)| self.formula(v, &s));
        if let Some(placed) = &equals {
            self.check_names(placed, &known);
        }
        if equals.is_some() != quantity.has_value() && self.find(&items, "equals").is_some() != quantity.has_value() {
            let message = if quantity.has_value() { "the claim gives no value" } else { "this claim has no value" };
            let label = if quantity.has_value() { "add equals = \"...\"" } else { "leave `equals` out" };
            self.faults.push(Fault::at(what_span, message, label));
        }
        let condition = self.find(&items, "where").and_then(|(value, span)| {
            let text = self.string(value, &span)?;
            let condition = self.condition(&text, &span)?;
            self.check_condition(&condition, &span, &in_conditions(&book.parameters));
            Some(condition)
        });
        let sources = self.words(&items, "source").into_iter().map(|(word, _)| word).collect();
        Some(Claim { what, quantity, condition, equals, sources, span })
    }
}
