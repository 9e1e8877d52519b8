//! How is the flatness of a boundary file read?

use super::boundary_claims::KINDS;
use super::names::in_conditions;
use super::{Item, Reader};
use crate::scheme::flatness::count_at;
use crate::scheme::{Cases, Placed, RuleBook};
use std::collections::{BTreeMap, BTreeSet};
use toml::de::DeValue;

impl Reader<'_> {
    /// The formulas of s by kind of vertex.
    pub(super) fn flatness(&mut self, items: &[Item], book: &RuleBook) -> BTreeMap<String, Cases<Placed>> {
        let Some((value, span)) = self.find(items, "flatness") else { return BTreeMap::new() };
        let DeValue::Table(table) = value else {
            self.wrong_type(&span, "a table of kinds of vertices", value);
            return BTreeMap::new();
        };
        let mut told = BTreeMap::new();
        for (kind, _, value) in self.items(table, &KINDS, "[flatness]") {
            let Some(cases) = self.cases(value.get_ref(), &value.span(), Self::formula) else { continue };
            let mut known = BTreeSet::from([count_at(kind)]);
            known.extend(book.lets.iter().map(|own| own.name.as_str()));
            known.extend(book.parameters.iter().map(|own| own.name.as_str()));
            cases.values().into_iter().for_each(|placed| self.check_names(placed, &known));
            let decided = in_conditions(&book.parameters);
            cases
                .conditions()
                .into_iter()
                .for_each(|(condition, span)| self.check_condition(condition, span, &decided));
            told.insert(kind.to_string(), cases);
        }
        told
    }
}
