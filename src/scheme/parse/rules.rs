//! How are rules read: positions, picked points and their weights; and are they those that the split asks for?

use super::names::in_conditions;
use super::values::quoted;
use super::{Item, Reader};
use crate::fault::{Fault, nearest};
use crate::scheme::vocabulary::{MAX_REACH, RuleKind, Vocabulary};
use crate::scheme::{Entry, Pick, Rule, RuleBook, Weights};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

/// The rules that have been read.
type Rules = BTreeMap<RuleKind, Rule>;

impl Reader<'_> {
    /// The rules among some items.
    pub(super) fn rules(&mut self, book: &RuleBook, items: &[Item], mesh: Option<&str>, boundary: bool) -> Rules {
        let mut rules = Rules::new();
        for (key, span, value) in items {
            let kind = RuleKind::ALL.iter().find(|(name, _)| name == key).map(|(_, kind)| *kind);
            if let Some(kind) = kind {
                self.rule(&mut rules, (book, mesh, boundary), kind, span, value);
            }
        }
        rules
    }

    fn rule(
        &mut self,
        rules: &mut Rules,
        (book, mesh, boundary): (&RuleBook, Option<&str>, bool),
        kind: RuleKind,
        span: &Range<usize>,
        value: &Spanned<DeValue>,
    ) {
        let DeValue::Table(table) = value.get_ref() else {
            self.wrong_type(&value.span(), "a table of positions and weights", value.get_ref());
            return;
        };
        let mut entries = Vec::new();
        let mut plain = 0;
        for (key, key_span, value) in self.in_order(table) {
            let inner = format!("{}.{key}", kind.name());
            if let Some((_, inner)) =
                RuleKind::ALL.iter().find(|(name, k)| *name == inner && k.is_boundary() == boundary)
            {
                self.rule(rules, (book, mesh, boundary), *inner, &key_span, value);
                continue;
            }
            plain += 1;
            entries.extend(self.entry(book, kind, (key, key_span, value), mesh, boundary));
        }
        if plain == 0 && table.is_empty() {
            self.faults.push(Fault::at(span.clone(), "a rule without weights", "empty").hint("leave the table out"));
        }
        if entries.len() == plain && plain > 0 {
            rules.insert(kind, Rule { kind, entries, span: span.clone() });
        }
    }

    pub(super) fn entry(
        &mut self,
        book: &RuleBook,
        kind: RuleKind,
        (key, span, value): Item,
        mesh: Option<&str>,
        boundary: bool,
    ) -> Option<Entry> {
        if kind.is_boundary() != boundary {
            let (file, other) = if boundary { ("boundary file", "scheme") } else { ("scheme file", "boundary") };
            let message = format!("a {file} can't give weights to `{key}` in [{}]", kind.name());
            self.faults.push(Fault::at(span, message, format!("this belongs in a {other} file")));
            return None;
        }
        let (name, picks) = self.picks(key, &span, kind)?;
        let Some(position) = Vocabulary::get().find(kind, mesh, name) else {
            self.unknown_position(kind, mesh, name, span);
            return None;
        };
        self.check_picks_from_end(kind, picks.as_deref(), &span);
        let mut known: BTreeSet<&str> = kind.variable().into_iter().collect();
        if !position.once {
            known.insert("j");
        }
        known.extend(book.lets.iter().map(|l| l.name.as_str()));
        known.extend(book.parameters.iter().map(|p| p.name.as_str()));
        let weights = self.cases(value.get_ref(), &value.span(), Self::weights)?;
        for weights in weights.values() {
            match weights {
                Weights::Each(placed) => self.check_names(placed, &known),
                Weights::List(list, _) => list.iter().for_each(|placed| self.check_names(placed, &known)),
            }
        }
        let decided = in_conditions(&book.parameters);
        for (condition, span) in weights.conditions() {
            self.check_condition(condition, span, &decided);
        }
        Some(Entry { position, picks, weights, span })
    }

    pub(super) fn weights(&mut self, value: &DeValue, span: &Range<usize>) -> Option<Weights> {
        let DeValue::Array(list) = value else { return self.formula(value, span).map(Weights::Each) };
        let formulas: Vec<_> = list.iter().filter_map(|item| self.formula(item.get_ref(), &item.span())).collect();
        (formulas.len() == list.len()).then_some(Weights::List(formulas, span.clone()))
    }

    /// `name[-1,1]`: the name and its indices.
    pub(super) fn picks<'a>(
        &mut self,
        key: &'a str,
        span: &Range<usize>,
        kind: RuleKind,
    ) -> Option<(&'a str, Option<Vec<Pick>>)> {
        let Some((name, rest)) = key.split_once('[') else { return Some((key.trim(), None)) };
        let pick = |word: &str| match word.trim() {
            "k" if kind == RuleKind::VertexCrease => Some(Pick::K),
            word => word.parse().ok().filter(|index: &i64| index.abs() <= 1_000_000).map(Pick::Index),
        };
        let picks = rest.trim_end().strip_suffix(']').map(|list| list.split(',').map(pick).collect::<Option<Vec<_>>>());
        if let Some(Some(picks)) = picks {
            return Some((name.trim(), Some(picks)));
        }
        let fault = Fault::at(span.clone(), format!("`{key}` doesn't pick points of a class"), "");
        self.faults.push(fault.hint("write \"ring[-1,1]\": the name, then whole numbers in brackets"));
        None
    }

    /// A rule told from an end has the edge itself (0) and those beside it (-1 and 1).
    fn check_picks_from_end(&mut self, kind: RuleKind, picks: Option<&[Pick]>, span: &Range<usize>) {
        let from_end = RuleKind::FROM_ENDS.contains(&kind) || kind == RuleKind::ThirdFromCorner;
        let most = if kind.starts(0) == 1 { 0 } else { 1 };
        let far = |pick: &Pick| !matches!(pick, Pick::Index(index) if index.abs() <= most);
        if from_end && picks.is_some_and(|picks| picks.iter().any(far)) {
            let known =
                if most == 0 { "only 0, the edge itself" } else { "0, the edge itself, and -1 and 1 beside it" };
            let message = format!("[{}] knows few points of a class", kind.name());
            self.faults.push(Fault::at(span.clone(), message, "too far").hint(format!("it knows {known}")));
        }
    }

    pub(super) fn unknown_position(&mut self, kind: RuleKind, mesh: Option<&str>, name: &str, span: Range<usize>) {
        let names: Vec<&str> = Vocabulary::get().around(kind, mesh).map(|position| position.name.as_str()).collect();
        let fault = Fault::at(span, format!("[{}] has no position `{name}`", kind.name()), "unknown position");
        let hint = match nearest(name, names.iter().copied()) {
            _ if name.contains(',') => {
                format!("an address \"i,j\" counts edges, at most {MAX_REACH} in all; around a vertex i is at least 1")
            }
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("the positions are {}; others have addresses such as \"2,0\"", quoted(&names)),
        };
        self.faults.push(fault.hint(hint));
    }

    /// The split of a step or pass.
    pub(super) fn split(&mut self, items: &[Item], mesh: Option<&str>) -> Option<String> {
        let splits: Vec<&str> = Vocabulary::get().splits.keys().map(String::as_str).collect();
        let split = self.choice(items, "split", &splits)?;
        if let Some(mesh) = mesh {
            self.check_split(items, mesh, &split);
        }
        Some(split)
    }

    fn check_split(&mut self, items: &[Item], mesh: &str, split: &str) {
        let takes = &Vocabulary::get().splits[split].meshes;
        if !takes.iter().any(|own| own == mesh) {
            let span = self.find(items, "split").map_or(0..0, |(_, span)| span);
            let fault = Fault::at(span, format!("the split `{split}` doesn't go with {mesh}"), "");
            self.faults.push(fault.hint(format!("it takes {}", takes.join(" or "))));
        }
    }

    /// The split's rules are all there, and no other.
    pub(super) fn check_births(&mut self, rules: &Rules, split: &str, span: Range<usize>) {
        let births = &Vocabulary::get().splits[split].births;
        for birth in births {
            if !rules.contains_key(birth) && self.faults.is_empty() {
                let message = format!("the split `{split}` needs a rule [{}]", birth.name());
                self.faults.push(Fault::at(span.clone(), message, "asked for by this split"));
            }
        }
        for rule in rules.values() {
            let told = if rule.kind == RuleKind::EdgeFromIrregularEnd { RuleKind::Edge } else { rule.kind };
            if !births.contains(&told) {
                let message = format!("the split `{split}` makes no point for the rule [{}]", rule.kind.name());
                self.faults.push(Fault::at(rule.span.clone(), message, "superfluous"));
            }
            for entry in &rule.entries {
                let Some(born) = entry.position.births() else { continue };
                if !births.contains(&born) || born == rule.kind || makes_each_other(rules, rule.kind, born) {
                    let message =
                        format!("`{}` has no points here: they are not made before this rule", entry.position.name);
                    self.faults.push(Fault::at(entry.span.clone(), message, format!("in [{}]", rule.kind.name())));
                }
            }
        }
    }
}

/// Whether the points of two rules are made of each other's.
fn makes_each_other(rules: &Rules, a: RuleKind, b: RuleKind) -> bool {
    let kinds = |kind: RuleKind| {
        let told = move |rule: &&Rule| {
            rule.kind == kind || (kind, rule.kind) == (RuleKind::Edge, RuleKind::EdgeFromIrregularEnd)
        };
        rules.values().filter(told).flat_map(|rule| &rule.entries).filter_map(|entry| entry.position.births())
    };
    kinds(a).any(|born| born == b) && kinds(b).any(|born| born == a)
}
