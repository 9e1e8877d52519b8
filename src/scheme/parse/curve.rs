//! How is the file of a scheme for curves read?
//!
//! `mesh = "curve"` and one of the four forms: `mask`, `symbol`, `average` or `halves`.

use super::{CURVE, Item, Reader};
use crate::fault::{Fault, Faults};
use crate::scheme::curve::{CurveClaim, CurveQuantity, CurveScheme, EndRules, Form, Told};
use crate::scheme::{Placed, RuleBook};
use std::collections::BTreeSet;
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

const CURVE_KEYS: [&str; 15] = [
    "name",
    "mesh",
    "source",
    "parameters",
    "let",
    "arity",
    "mask",
    "taps",
    "first",
    "symbol",
    "average",
    "averaged",
    "halves",
    "points",
    "ends",
];
const FORMS: [&str; 4] = ["mask", "symbol", "average", "halves"];
/// The keys that go with one form only.
const GO_WITH: [(&str, &[&str]); 5] = [
    ("first", &["mask"]),
    ("taps", &["mask", "average"]),
    ("averaged", &["average"]),
    ("points", &["halves"]),
    ("ends", &["mask", "symbol", "average"]),
];

impl CurveScheme {
    /// Reads the file of a scheme for curves: `id` is its short name, `origin` its name in messages.
    ///
    /// # Errors
    /// All faults that reading finds. Sums and limits are checked by [`CurveScheme::rules`].
    pub fn parse(id: &str, origin: &str, text: &str) -> Result<CurveScheme, Faults> {
        let mut reader = Reader::new(text);
        reader.counts = &["i", "j", "z"];
        match reader.curve(id, origin) {
            Some(scheme) if reader.faults.is_empty() => Ok(scheme),
            _ => Err(reader.into_faults(origin)),
        }
    }
}

impl Reader<'_> {
    fn curve(&mut self, id: &str, origin: &str) -> Option<CurveScheme> {
        let top = self.top()?;
        let known: Vec<&str> = CURVE_KEYS.iter().copied().chain(["claims"]).collect();
        let items = self.items(top.get_ref(), &known, "the file of a scheme for curves");
        self.choice(&items, "mesh", &[CURVE]);
        let plain: Vec<Item> = items.iter().filter(|(key, ..)| CURVE_KEYS.contains(key)).cloned().collect();
        let book = self.book(&plain, origin, None, false)?;
        for parameter in book.parameters.iter().filter(|p| ["i", "z"].contains(&p.name.as_str())) {
            let message = format!("`{}` already has a meaning in formulas of curves", parameter.name);
            self.faults.push(Fault::at(parameter.span.clone(), message, "reserved").hint("choose another name"));
        }
        let arity = self.placed(&items, "arity", &book, &[]);
        let form = self.form(&items, &book);
        if let (Some((_, span)), Some(Form::Average { .. } | Form::Halves { .. })) = (self.find(&items, "arity"), &form)
        {
            let fault = Fault::at(span, "this form has the arity 2 by itself", "superfluous");
            self.faults.push(fault.hint("leave `arity` out, or tell the scheme as a mask"));
        }
        let ends = self.end_rules(&items, &book);
        let claims = self.curve_claims(&items, &book);
        Some(CurveScheme { id: id.to_string(), book, arity, form: form?, ends, claims })
    }

    /// The one form that the file tells.
    fn form(&mut self, items: &[Item], book: &RuleBook) -> Option<Form> {
        let told: Vec<&Item> = items.iter().filter(|(key, ..)| FORMS.contains(key)).collect();
        let [(form, span, _)] = told.as_slice() else {
            let fault = match told.last() {
                None => Fault::whole(
                    "the file tells no weights: one of `mask`, `symbol`, `average` and `halves` is missing",
                ),
                Some((key, span, _)) => Fault::at(span.clone(), format!("`{key}` tells the weights a second time"), ""),
            };
            self.faults.push(fault.hint("write one of them, such as mask = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"]"));
            return None;
        };
        for (key, forms) in GO_WITH {
            let misplaced = self.find(items, key).filter(|_| !forms.contains(form));
            if misplaced.is_some() {
                let place =
                    items.iter().find(|(own, ..)| *own == key).map_or(span.clone(), |(_, span, _)| span.clone());
                let message = format!("`{key}` does not go with `{form}`");
                self.faults.push(Fault::at(place, message, "").hint(format!("it goes with {}", forms.join(", "))));
            }
        }
        match *form {
            "mask" => {
                let told = self.told(items, "mask", book);
                let first = self.placed(items, "first", book, &[]);
                Some(Form::Mask(told?, first))
            }
            "symbol" => self.placed(items, "symbol", book, &["z"]).map(Form::Symbol),
            "average" => {
                let weights = self.told(items, "average", book);
                let averaged = self.find(items, "averaged").is_some();
                let which = averaged.then(|| self.choice(items, "averaged", &["all", "midpoints"])).flatten();
                Some(Form::Average { weights: weights?, midpoints_only: which.as_deref() == Some("midpoints") })
            }
            _ => self.halves(items, book),
        }
    }

    fn halves(&mut self, items: &[Item], book: &RuleBook) -> Option<Form> {
        let (value, span) = self.find(items, "halves")?;
        let points = self.placed(items, "points", book, &[]);
        if self.find(items, "points").is_none() {
            let fault = Fault::at(span.clone(), "halves need the number of points of the polygon", "no `points`");
            self.faults.push(fault.hint("write points = \"d + 1\""));
        }
        let list = match value {
            DeValue::Array(list) if list.len() == 2 => list,
            _ => {
                let fault = Fault::at(span, "`halves` is a list of two formulas in i and j", "");
                self.faults.push(
                    fault.hint("the weight of the old point j in the new point i, of the first half and of the second"),
                );
                return None;
            }
        };
        let mut read = |item: &Spanned<DeValue>| self.formula_in(item.get_ref(), &item.span(), book, &["i", "j"]);
        let (first, second) = (read(&list[0]), read(&list[1]));
        Some(Form::Halves { halves: [first?, second?], points: points? })
    }

    /// A list of formulas, or one formula in i or j with `taps`.
    fn told(&mut self, items: &[Item], key: &str, book: &RuleBook) -> Option<Told> {
        let (value, span) = self.find(items, key)?;
        let taps = self.placed(items, "taps", book, &[]);
        if let DeValue::Array(list) = value {
            let read = |item: &Spanned<DeValue>| self.formula_in(item.get_ref(), &item.span(), book, &[]);
            let weights: Vec<Option<Placed>> = list.iter().map(read).collect();
            if list.is_empty() {
                self.faults.push(Fault::at(span.clone(), format!("the list `{key}` has no weight"), "empty"));
            }
            if let (Some(_), Some((_, place))) = (taps, self.find(items, "taps")) {
                let fault = Fault::at(place, "a list tells by itself how many weights there are", "superfluous");
                self.faults.push(fault.hint("leave `taps` out, or write one formula in j"));
            }
            return weights.into_iter().collect::<Option<Vec<_>>>().map(|list| Told::List(list, span));
        }
        let formula = self.formula_in(value, &span, book, &["i", "j"]);
        if self.find(items, "taps").is_none() {
            let fault = Fault::at(span, "one formula for all weights needs their number", "no `taps`");
            self.faults
                .push(fault.hint("write taps = \"d + 2\"; j then runs from 0 to d + 1. Or give a list of weights"));
        }
        Some(Told::Each(formula?, taps?))
    }

    /// A formula under a key, in which parameters, `[let]` names and the indices named may stand.
    fn placed(&mut self, items: &[Item], key: &str, book: &RuleBook, indices: &[&str]) -> Option<Placed> {
        let (value, span) = self.find(items, key)?;
        self.formula_in(value, &span, book, indices)
    }

    fn formula_in(
        &mut self,
        value: &DeValue,
        span: &Range<usize>,
        book: &RuleBook,
        indices: &[&str],
    ) -> Option<Placed> {
        let placed = self.formula(value, span)?;
        let own = book.parameters.iter().map(|p| p.name.as_str()).chain(book.lets.iter().map(|l| l.name.as_str()));
        let known: BTreeSet<&str> = indices.iter().copied().chain(own).collect();
        self.check_names(&placed, &known);
        Some(placed)
    }

    fn end_rules(&mut self, items: &[Item], book: &RuleBook) -> Option<EndRules> {
        let (value, span) = self.find(items, "ends")?;
        let DeValue::Table(table) = value else {
            self.wrong_type(&span, "a table, [ends],", value);
            return None;
        };
        let inner = self.items(table, &["rules", "then"], "[ends]");
        let then = self.placed(&inner, "then", book, &[]);
        let Some((DeValue::Array(list), _)) = self.find(&inner, "rules") else {
            let fault = Fault::at(span, "[ends] needs a list of rules", "no list `rules`");
            self.faults.push(fault.hint("write rules = [[\"1\"]]: the first new point is the first old one"));
            return None;
        };
        let mut rules = Vec::new();
        for row in list {
            let DeValue::Array(weights) = row.get_ref() else {
                self.wrong_type(&row.span(), "a list of weights", row.get_ref());
                continue;
            };
            let read = weights.iter().map(|item| self.formula_in(item.get_ref(), &item.span(), book, &[]));
            let weights: Vec<Placed> = read.collect::<Vec<_>>().into_iter().flatten().collect();
            rules.push((weights, row.span()));
        }
        Some(EndRules { rules, then })
    }

    fn curve_claims(&mut self, items: &[Item], book: &RuleBook) -> Vec<CurveClaim> {
        let Some((value, span)) = self.find(items, "claims") else { return Vec::new() };
        let DeValue::Array(list) = value else {
            self.wrong_type(&span, "a list of tables, [[claims]],", value);
            return Vec::new();
        };
        list.iter().filter_map(|item| self.curve_claim(item, book)).collect()
    }

    fn curve_claim(&mut self, item: &Spanned<DeValue>, book: &RuleBook) -> Option<CurveClaim> {
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
        let Some(quantity) = CurveQuantity::parse(&what) else {
            let fault = Fault::at(what_span, format!("a claim about a curve can't be about `{what}`"), "unknown");
            self.faults.push(fault.hint(format!("it can be about {}", CurveQuantity::WORDS)));
            return None;
        };
        let equals = self.placed(&items, "equals", book, &[]);
        if self.find(&items, "equals").is_some() != quantity.has_value() {
            let message = if quantity.has_value() { "the claim gives no value" } else { "this claim has no value" };
            let label = if quantity.has_value() { "add equals = \"...\"" } else { "leave `equals` out" };
            self.faults.push(Fault::at(what_span, message, label));
        }
        let condition = self.find(&items, "where").and_then(|(value, span)| {
            let text = self.string(value, &span)?;
            let condition = self.condition(&text, &span)?;
            let known = book.parameters.iter().map(|p| p.name.as_str()).collect();
            self.check_condition(&condition, &span, &known);
            Some(condition)
        });
        let sources = self.words(&items, "source").into_iter().map(|(word, _)| word).collect();
        Some(CurveClaim { what, quantity, condition, equals, sources, span })
    }
}
