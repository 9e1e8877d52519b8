//! How is the file of a tensor product read?
//!
//! `mesh = "grid"` and `product`: two schemes for curves by their names, perhaps with values of their parameters.

use super::{GRID, Item, Reader};
use crate::fault::{Fault, Faults, nearest};
use crate::scheme::catalogue;
use crate::scheme::grid::{Factor, GridScheme};
use std::collections::BTreeSet;
use toml::Spanned;
use toml::de::DeValue;

const GRID_KEYS: [&str; 6] = ["name", "mesh", "source", "parameters", "let", "product"];

impl GridScheme {
    /// Reads the file of a tensor product: `id` is its short name, `origin` its name in messages.
    ///
    /// # Errors
    /// All faults that reading finds.
    pub fn parse(id: &str, origin: &str, text: &str) -> Result<GridScheme, Faults> {
        let mut reader = Reader::new(text);
        match reader.grid(id, origin) {
            Some(scheme) if reader.faults.is_empty() => Ok(scheme),
            _ => Err(reader.into_faults(origin)),
        }
    }
}

impl Reader<'_> {
    fn grid(&mut self, id: &str, origin: &str) -> Option<GridScheme> {
        let top = self.top()?;
        let items = self.items(top.get_ref(), &GRID_KEYS, "the file of a tensor product");
        self.choice(&items, "mesh", &[GRID]);
        let book = self.book(&items, origin, None, false)?;
        let names: Vec<String> = book.parameters.iter().map(|p| p.name.clone()).collect();
        let known: BTreeSet<&str> = names.iter().map(String::as_str).collect();
        let list = match self.find(&items, "product") {
            Some((DeValue::Array(list), _)) if list.len() == 2 => list,
            found => {
                let message = "`product` is a list of two schemes for curves";
                let fault = found.map_or(Fault::whole(message), |(_, span)| Fault::at(span, message, ""));
                self.faults.push(fault.hint("write product = [\"chaikin\", \"chaikin\"]"));
                return None;
            }
        };
        let (first, second) = (self.factor(&list[0], &known), self.factor(&list[1], &known));
        Some(GridScheme { id: id.to_string(), book, factors: [first?, second?] })
    }

    /// A name, or a table with the name under `scheme` and values of parameters.
    fn factor(&mut self, item: &Spanned<DeValue>, known: &BTreeSet<&str>) -> Option<Factor> {
        let (name, span, settings) = match item.get_ref() {
            DeValue::Table(table) => {
                let inner = self.in_order(table);
                let (name, span) = match self.find(&inner, "scheme") {
                    Some((value, span)) => (self.string(value, &span)?, span),
                    None => {
                        let fault = Fault::at(item.span(), "this factor doesn't name its scheme", "no `scheme`");
                        self.faults.push(fault.hint("write { scheme = \"b-spline\", d = \"3\" }"));
                        return None;
                    }
                };
                let others: Vec<Item> = inner.into_iter().filter(|(key, ..)| *key != "scheme").collect();
                let mut settings = Vec::new();
                for (key, _, value) in others {
                    if let Some(placed) = self.formula(value.get_ref(), &value.span()) {
                        self.check_names(&placed, known);
                        settings.push((key.to_string(), placed));
                    }
                }
                (name, span, settings)
            }
            value => (self.string(value, &item.span())?, item.span(), Vec::new()),
        };
        if catalogue::CURVES.iter().all(|listed| listed.id != name) {
            let ids = catalogue::CURVES.iter().map(|listed| listed.id);
            let hint = match nearest(&name, ids.clone()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the schemes for curves are {}", ids.collect::<Vec<_>>().join(", ")),
            };
            let fault = Fault::at(span, format!("there is no scheme for curves `{name}`"), "unknown");
            self.faults.push(fault.hint(hint));
            return None;
        }
        Some(Factor { scheme: name, settings, span })
    }
}
