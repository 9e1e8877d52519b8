//! Which names do formulas know: parameters and `[let]`?

use super::{Item, Reader};
use crate::fault::{Fault, nearest};
use crate::numbers::Function;
use crate::scheme::evaluate::MAX_LET_DEPTH;
use crate::scheme::formula::{Condition, Formula};
use crate::scheme::{Let, Parameter, Placed};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use toml::de::DeValue;

/// After this many faults no more hints are looked for.
const MOST_HINTED: usize = 50;

impl Reader<'_> {
    pub(super) fn parameters(&mut self, items: &[Item]) -> Vec<Parameter> {
        let Some((value, span)) = self.find(items, "parameters") else { return Vec::new() };
        let DeValue::Table(table) = value else {
            self.wrong_type(&span, "a table", value);
            return Vec::new();
        };
        let items = self.in_order(table);
        let mut parameters = Vec::new();
        for item in items {
            let name = item.0.to_string();
            match self.parameter(item) {
                Some(parameter) => parameters.push(parameter),
                None => drop(self.broken.insert(name)),
            }
        }
        parameters
    }

    pub(super) fn parameter(&mut self, (name, span, value): Item) -> Option<Parameter> {
        self.check_new_name(name, &span);
        let at = value.span();
        let DeValue::Table(table) = value.get_ref() else {
            let value = self.formula(value.get_ref(), &at)?;
            self.check_names(&value, &BTreeSet::new());
            return Some(Parameter {
                name: name.to_string(),
                value,
                means: String::new(),
                range: None,
                integer: false,
                free: false,
                span,
            });
        };
        let items = self.items(table, &["default", "means", "range", "integer"], "a parameter");
        let Some((default, default_span)) = self.find(&items, "default") else {
            self.faults.push(Fault::at(at, format!("the parameter `{name}` has no default"), "add default = \"...\""));
            return None;
        };
        let means = self.find(&items, "means").and_then(|(v, s)| self.string(v, &s)).unwrap_or_default();
        let integer = self.find(&items, "integer");
        let range = self.find(&items, "range").or_else(|| integer.clone().filter(|(v, _)| !v.is_bool()));
        let range = range.and_then(|(v, s)| self.range(v, &s));
        let integer = integer.is_some_and(|(v, _)| v.as_bool().unwrap_or(true));
        let value = self.formula(default, &default_span)?;
        self.check_names(&value, &BTreeSet::new());
        Some(Parameter { name: name.to_string(), value, means, range, integer, free: false, span })
    }

    /// `"lo..hi"`, both included.
    pub(super) fn range(&mut self, value: &DeValue, span: &Range<usize>) -> Option<(Placed, Placed)> {
        let text = self.string(value, span)?;
        let Some((low, high)) = text.split_once("..") else {
            let fault = Fault::at(span.clone(), "a range is written \"low..high\"", "no `..` here");
            self.faults.push(fault);
            return None;
        };
        let mut end = |part: &str| match Formula::parse(part) {
            Ok(formula) => Some(Placed { formula, span: span.clone(), start: None }),
            Err(fault) => {
                self.faults.push(Fault::at(span.clone(), fault.message, "in this range"));
                None
            }
        };
        let (low, high) = (end(low)?, end(high)?);
        self.check_names(&low, &BTreeSet::new());
        self.check_names(&high, &BTreeSet::new());
        Some((low, high))
    }

    pub(super) fn lets(&mut self, items: &[Item]) -> Vec<Let> {
        let Some((value, span)) = self.find(items, "let") else { return Vec::new() };
        let DeValue::Table(table) = value else {
            self.wrong_type(&span, "a table", value);
            return Vec::new();
        };
        let mut lets = Vec::new();
        for (name, span, value) in self.in_order(table) {
            self.check_new_name(name, &span);
            let told = self.cases(value.get_ref(), &value.span(), Self::formula);
            if told.is_none() {
                self.broken.insert(name.to_string());
            }
            lets.extend(told.map(|value| Let { name: name.to_string(), value, uses_index: false }));
        }
        lets
    }

    /// Names are known and don't go round in circles; says which of them depend on `j`.
    pub(super) fn check_lets(&mut self, lets: &mut [Let], parameters: &[Parameter]) {
        for parameter in parameters {
            if lets.iter().any(|l| l.name == parameter.name) {
                let message = format!("`{}` is both a parameter and a name under [let]", parameter.name);
                self.faults.push(Fault::at(parameter.span.clone(), message, "defined twice"));
            }
        }
        let mut known: BTreeSet<&str> = self.counts.iter().copied().collect();
        known.extend(lets.iter().map(|l| l.name.as_str()));
        known.extend(parameters.iter().map(|p| p.name.as_str()));
        for placed in lets.iter().flat_map(|l| l.value.values()) {
            self.check_names(placed, &known);
        }
        let decided = in_conditions(parameters);
        for (condition, span) in lets.iter().flat_map(|l| l.value.conditions()) {
            self.check_condition(condition, span, &decided);
        }
        self.check_circles(lets);
        for _ in 0..lets.len() {
            let indexed: BTreeSet<String> = lets.iter().filter(|l| l.uses_index).map(|l| l.name.clone()).collect();
            for own in lets.iter_mut() {
                let values = own.value.values();
                let mut names = values.iter().flat_map(|placed| placed.formula.names());
                own.uses_index |= names.any(|(name, _)| name == "j" || indexed.contains(name));
            }
        }
    }

    /// The names don't refer to each other in circles, nor too deeply.
    pub(super) fn check_circles(&mut self, lets: &[Let]) {
        let mut depth: BTreeMap<&str, usize> = lets.iter().map(|l| (l.name.as_str(), 0)).collect();
        for _ in 0..=lets.len() {
            for own in lets {
                let inner = own.value.values().into_iter().flat_map(|placed| placed.formula.names());
                let below = inner.filter_map(|(name, _)| depth.get(name)).max();
                let now = below.map_or(0, |below| below + 1);
                depth.insert(own.name.as_str(), now);
            }
        }
        let at = |own: &Let| depth[own.name.as_str()];
        let span = |own: &Let| own.value.values()[0].span.clone();
        if let Some(own) = lets.iter().find(|own| at(own) >= lets.len()) {
            let message = format!("the names under [let] go round in a circle at `{}`", own.name);
            let fault = Fault::at(span(own), message, "");
            self.faults.push(fault.hint("a name may use others, but not, through them, itself"));
        } else if let Some(own) = lets.iter().find(|own| at(own) >= MAX_LET_DEPTH) {
            let message = format!("the names under [let] refer to each other more than {MAX_LET_DEPTH} deep");
            self.faults.push(Fault::at(span(own), message, "too deep"));
        }
    }

    pub(super) fn check_new_name(&mut self, name: &str, span: &Range<usize>) {
        let reserved = ["n", "k", "j", "pi", "and", "or"];
        let letters = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !letters {
            let fault = Fault::at(span.clone(), format!("`{name}` can't be a name in formulas"), "");
            self.faults.push(fault.hint("a name is made of letters, digits and _"));
        } else if reserved.contains(&name) || Function::ALL.iter().any(|(function, ..)| *function == name) {
            let fault = Fault::at(span.clone(), format!("`{name}` already has a meaning in formulas"), "reserved");
            self.faults.push(fault.hint("choose another name"));
        }
    }

    pub(super) fn check_names(&mut self, placed: &Placed, known: &BTreeSet<&str>) {
        for (name, inner) in placed.formula.names() {
            if !known.contains(name) {
                self.unknown_name(name, placed.place(inner), known);
            }
        }
    }

    pub(super) fn check_condition(&mut self, condition: &Condition, span: &Range<usize>, known: &BTreeSet<&str>) {
        for (name, inner) in condition.names() {
            if !known.contains(name) {
                let start = self.start_of(span, condition.text());
                let place = start.map_or(span.clone(), |start| start + inner.start..start + inner.end);
                self.unknown_name(name, place, known);
            }
        }
    }

    pub(super) fn unknown_name(&mut self, name: &str, span: Range<usize>, known: &BTreeSet<&str>) {
        if self.broken.contains(name) {
            return;
        }
        let fault = Fault::at(span, format!("the name `{name}` is not known here"), "unknown name");
        if self.faults.len() >= MOST_HINTED {
            self.faults.push(fault);
            return;
        }
        let functions = Function::ALL.iter().map(|(function, ..)| *function);
        let hint = match nearest(name, known.iter().copied().chain(functions).chain(["pi"])) {
            _ if name == "n" => {
                "this rule is told from no vertex; [edge.from-irregular-end] has n, the valence of that end".to_string()
            }
            Some(near) => format!("did you mean `{near}`?"),
            None if known.is_empty() => "only numbers and pi have a value here".to_string(),
            None => format!("known here: pi, {}", known.iter().copied().collect::<Vec<_>>().join(", ")),
        };
        self.faults.push(fault.hint(hint));
    }
}

/// The names that conditions may use: counts and parameters.
pub(super) fn in_conditions(parameters: &[Parameter]) -> BTreeSet<&str> {
    ["n", "k"].into_iter().chain(parameters.iter().map(|p| p.name.as_str())).collect()
}
