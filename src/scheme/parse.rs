//! How is a scheme file read?
//!
//! TOML 1.0 with places kept. Every fault is collected and reading goes on, so that a user sees all of them at once. The
//! keys are listed in [`KEYS`]; the README's table says what they mean, and a test holds the two together.

use super::claim::{Claim, Quantity};
use super::evaluate::{MAX_LET_DEPTH, Place};
use super::formula::{Condition, Formula};
use super::vocabulary::{MAX_REACH, RuleKind, Vocabulary};
use super::{Cases, Entry, Let, Parameter, Pick, Placed, Rule, RuleBook, Scheme, Weights, catalogue};
use crate::fault::{Fault, Faults, nearest};
use crate::numbers::Function;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The largest file that is read.
pub const MAX_FILE_BYTES: usize = 1 << 16;

/// The most entries of one table: names, parameters, positions or cases.
const MAX_ENTRIES: usize = 256;

/// After this many faults no more hints are looked for.
const MOST_HINTED: usize = 50;

/// Every key of a scheme file and of a boundary file, as the README's table lists them.
pub const KEYS: [&str; 22] = [
    "name",
    "mesh",
    "split",
    "source",
    "boundary",
    "parameters",
    "parameters.*.default",
    "parameters.*.means",
    "parameters.*.range",
    "parameters.*.integer",
    "let",
    "vertex",
    "edge",
    "edge.from-irregular-end",
    "face",
    "corner",
    "claims",
    "claims.what",
    "claims.where",
    "claims.equals",
    "claims.source",
    "vertex.crease, vertex.corner, edge.crease",
];

const SCHEME_KEYS: [&str; 11] =
    ["name", "mesh", "split", "source", "boundary", "parameters", "let", "vertex", "edge", "face", "corner"];
const BOUNDARY_KEYS: [&str; 6] = ["name", "source", "parameters", "let", "vertex", "edge"];
const MESHES: [&str; 3] = ["triangles", "quads", "polygons"];

type Item<'a, 'i> = (&'a str, Range<usize>, &'a Spanned<DeValue<'i>>);

impl Scheme {
    /// Reads a scheme file: `id` is its short name, `origin` its name in messages.
    ///
    /// # Errors
    /// All faults that reading finds. Sums, cases and symmetry are checked after: [`Scheme::check`],
    /// [`crate::refine::check_symmetry`].
    pub fn parse(id: &str, origin: &str, text: &str) -> Result<Scheme, Faults> {
        let mut reader = Reader::new(text);
        let scheme = reader.scheme(id, origin);
        match scheme {
            Some(scheme) if reader.faults.is_empty() => Ok(scheme),
            _ => Err(reader.into_faults(origin)),
        }
    }

    /// Sets a parameter, as `--set name=value` does.
    ///
    /// # Errors
    /// Why it can't be set, in words.
    pub fn set(&mut self, name: &str, given: &str) -> Result<(), String> {
        let known: Vec<String> = self.book.parameters.iter().map(|p| p.name.clone()).collect();
        let Some(parameter) = self.book.parameters.iter_mut().find(|p| p.name == name) else {
            return Err(match known.as_slice() {
                [] => format!("{} has no parameters, so `{name}` can't be set", self.book.title),
                _ => format!("{} has no parameter `{name}`; it has {}", self.book.title, known.join(", ")),
            });
        };
        let formula = Formula::parse(given).map_err(|fault| format!("`{name}={given}`: {}", fault.message))?;
        if let Some((used, _)) = formula.names().next() {
            return Err(format!("`{name}={given}`: a parameter's value is a number, and `{used}` is a name"));
        }
        let value = Placed { formula, span: parameter.span.clone(), start: None };
        parameter.value = value.clone();
        let evaluated = self.book.evaluate::<f64>(&value, &Place::at(None, 0));
        evaluated.map(|_| ()).map_err(|fault| format!("`{name}={given}`: {}", fault.message))
    }
}

impl RuleBook {
    /// Reads a boundary file for one kind of mesh.
    ///
    /// # Errors
    /// All its faults.
    pub fn parse_boundary(origin: &str, text: &str, mesh: &str) -> Result<RuleBook, Faults> {
        let mut reader = Reader::new(text);
        let book = reader.boundary(origin, mesh);
        match book {
            Some(book) if reader.faults.is_empty() => Ok(book),
            _ => Err(reader.into_faults(origin)),
        }
    }
}

struct Reader<'t> {
    text: &'t str,
    faults: Vec<Fault>,
    /// Names under [let] and [parameters] whose own formulas are at fault: not unknown where they are used.
    broken: BTreeSet<String>,
}

impl<'t> Reader<'t> {
    fn new(text: &'t str) -> Self {
        Reader { text, faults: Vec::new(), broken: BTreeSet::new() }
    }

    fn into_faults(mut self, origin: &str) -> Faults {
        if self.faults.is_empty() {
            self.faults.push(Fault::whole("the file is not a scheme"));
        }
        self.faults.sort_by_key(|fault| fault.span.as_ref().map_or(0, |span| span.start));
        Faults { origin: origin.to_string(), text: self.text.to_string(), faults: self.faults }
    }

    /// The file's top table; `None` when it can't be read as TOML.
    fn top(&mut self) -> Option<Spanned<DeTable<'t>>> {
        if self.text.len() > MAX_FILE_BYTES {
            let message = format!("the file has {} bytes; the limit is {MAX_FILE_BYTES}", self.text.len());
            self.faults.push(Fault::whole(message));
            return None;
        }
        let (table, errors) = DeTable::parse_recoverable(self.text);
        for error in &errors {
            let span = error.span().unwrap_or(0..0);
            self.faults.push(Fault::at(span, error.message().trim().to_string(), "not TOML"));
        }
        errors.is_empty().then_some(table)
    }

    fn scheme(&mut self, id: &str, origin: &str) -> Option<Scheme> {
        let top = self.top()?;
        let known: Vec<&str> = SCHEME_KEYS.iter().copied().chain(["claims"]).collect();
        let items = self.items(top.get_ref(), &known, "a scheme file");
        let mesh = self.choice(&items, "mesh", &MESHES);
        let vocabulary = Vocabulary::get();
        let splits: Vec<&str> = vocabulary.splits.keys().map(String::as_str).collect();
        let split = self.choice(&items, "split", &splits);
        if let (Some(mesh), Some(split)) = (&mesh, &split) {
            self.check_split(&items, mesh, split);
        }
        let boundary = self.words(&items, "boundary");
        for (name, span) in &boundary {
            if !catalogue::BOUNDARIES.iter().any(|listed| listed.id == name) {
                let names: Vec<&str> = catalogue::BOUNDARIES.iter().map(|listed| listed.id).collect();
                let fault = Fault::at(span.clone(), format!("there is no boundary file `{name}`"), "unknown");
                self.faults.push(fault.hint(format!("the boundary files are {}", names.join(", "))));
            }
        }
        let book = self.book(&items, origin, mesh.as_deref(), false)?;
        if let (Some(split), Some((_, span))) = (&split, self.find(&items, "split")) {
            self.check_births(&book, split, span);
        }
        let claims = self.claims(&items, &book);
        let boundary = boundary.into_iter().map(|(name, _)| name).collect();
        Some(Scheme { id: id.to_string(), book, mesh: mesh?, split: split?, boundary, claims })
    }

    fn boundary(&mut self, origin: &str, mesh: &str) -> Option<RuleBook> {
        let top = self.top()?;
        let items = self.items(top.get_ref(), &BOUNDARY_KEYS, "a boundary file");
        self.book(&items, origin, Some(mesh), true)
    }

    fn book(&mut self, items: &[Item], origin: &str, mesh: Option<&str>, boundary: bool) -> Option<RuleBook> {
        let title = self.find(items, "name").and_then(|(value, span)| self.string(value, &span));
        if title.is_none() && self.find(items, "name").is_none() {
            self.faults.push(Fault::whole("the key `name` is missing").hint("write name = \"My scheme\""));
        }
        let sources = self.words(items, "source").into_iter().map(|(word, _)| word).collect();
        let parameters = self.parameters(items);
        let mut lets = self.lets(items);
        self.check_lets(&mut lets, &parameters);
        let mut book = RuleBook {
            origin: origin.to_string(),
            text: self.text.to_string(),
            title: title.unwrap_or_default(),
            sources,
            parameters,
            lets,
            rules: BTreeMap::new(),
            quads_only: mesh == Some("quads"),
        };
        for (key, span, value) in items {
            let kind = RuleKind::ALL.iter().find(|(name, _)| name == key).map(|(_, kind)| *kind);
            if let Some(kind) = kind {
                self.rule(&mut book, kind, span, value, mesh, boundary);
            }
        }
        Some(book)
    }

    // ---- values ---------------------------------------------------------------------------------------------------

    /// A table's entries in the order of the file, as many as are allowed.
    fn in_order<'a, 'i>(&mut self, table: &'a DeTable<'i>) -> Vec<Item<'a, 'i>> {
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
    fn items<'a, 'i>(&mut self, table: &'a DeTable<'i>, known: &[&str], owner: &str) -> Vec<Item<'a, 'i>> {
        let items = self.in_order(table);
        for (key, span, _) in &items {
            if !known.contains(key) {
                let fault = Fault::at(span.clone(), format!("{owner} has no key `{key}`"), "unknown key");
                self.faults.push(fault.hint(did_you_mean(key, known)));
            }
        }
        items
    }

    fn find<'a, 'i>(&self, items: &[Item<'a, 'i>], key: &str) -> Option<(&'a DeValue<'i>, Range<usize>)> {
        items.iter().find(|(name, ..)| *name == key).map(|(_, _, value)| (value.get_ref(), value.span()))
    }

    fn wrong_type(&mut self, span: &Range<usize>, wanted: &str, found: &DeValue) {
        let label = format!("this is {} {}", article(found.type_str()), found.type_str());
        self.faults.push(Fault::at(span.clone(), format!("{wanted} is needed here"), label));
    }

    fn string(&mut self, value: &DeValue, span: &Range<usize>) -> Option<String> {
        if let DeValue::String(text) = value {
            return Some(text.to_string());
        }
        self.wrong_type(span, "a text in quotes", value);
        None
    }

    fn choice(&mut self, items: &[Item], key: &str, known: &[&str]) -> Option<String> {
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
    fn words(&mut self, items: &[Item], key: &str) -> Vec<(String, Range<usize>)> {
        let Some((value, span)) = self.find(items, key) else { return Vec::new() };
        match value {
            DeValue::Array(list) => {
                list.iter().filter_map(|item| Some((self.string(item.get_ref(), &item.span())?, item.span()))).collect()
            }
            _ => self.string(value, &span).map(|word| vec![(word, span)]).unwrap_or_default(),
        }
    }

    /// A formula: a text, or a number as it stands in the file.
    fn formula(&mut self, value: &DeValue, span: &Range<usize>) -> Option<Placed> {
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
    fn start_of(&self, span: &Range<usize>, text: &str) -> Option<usize> {
        [1, 3]
            .into_iter()
            .map(|quotes| span.start + quotes)
            .find(|start| self.text.get(*start..start + text.len()) == Some(text) && start + text.len() < span.end)
    }

    /// A condition, from the key of a table of cases or from a claim.
    fn condition(&mut self, text: &str, span: &Range<usize>) -> Option<Condition> {
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
    fn cases<T>(
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

    // ---- parameters and names -----------------------------------------------------------------------------------

    fn parameters(&mut self, items: &[Item]) -> Vec<Parameter> {
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

    fn parameter(&mut self, (name, span, value): Item) -> Option<Parameter> {
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
        Some(Parameter { name: name.to_string(), value, means, range, integer, span })
    }

    /// `"lo..hi"`, both included.
    fn range(&mut self, value: &DeValue, span: &Range<usize>) -> Option<(Placed, Placed)> {
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

    fn lets(&mut self, items: &[Item]) -> Vec<Let> {
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
    fn check_lets(&mut self, lets: &mut [Let], parameters: &[Parameter]) {
        for parameter in parameters {
            if lets.iter().any(|l| l.name == parameter.name) {
                let message = format!("`{}` is both a parameter and a name under [let]", parameter.name);
                self.faults.push(Fault::at(parameter.span.clone(), message, "defined twice"));
            }
        }
        let mut known: BTreeSet<&str> = BTreeSet::from(["n", "k", "j"]);
        known.extend(lets.iter().map(|l| l.name.as_str()));
        known.extend(parameters.iter().map(|p| p.name.as_str()));
        for placed in lets.iter().flat_map(|l| l.value.values()) {
            self.check_names(placed, &known);
        }
        let decided = in_conditions(parameters);
        for (condition, span) in lets.iter().flat_map(|l| conditions(&l.value)) {
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
    fn check_circles(&mut self, lets: &[Let]) {
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

    fn check_new_name(&mut self, name: &str, span: &Range<usize>) {
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

    fn check_names(&mut self, placed: &Placed, known: &BTreeSet<&str>) {
        for (name, inner) in placed.formula.names() {
            if !known.contains(name) {
                self.unknown_name(name, placed.place(inner), known);
            }
        }
    }

    fn check_condition(&mut self, condition: &Condition, span: &Range<usize>, known: &BTreeSet<&str>) {
        for (name, inner) in condition.names() {
            if !known.contains(name) {
                let start = self.start_of(span, condition.text());
                let place = start.map_or(span.clone(), |start| start + inner.start..start + inner.end);
                self.unknown_name(name, place, known);
            }
        }
    }

    fn unknown_name(&mut self, name: &str, span: Range<usize>, known: &BTreeSet<&str>) {
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

    // ---- rules --------------------------------------------------------------------------------------------------

    fn rule(
        &mut self,
        book: &mut RuleBook,
        kind: RuleKind,
        span: &Range<usize>,
        value: &Spanned<DeValue>,
        mesh: Option<&str>,
        boundary: bool,
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
                self.rule(book, *inner, &key_span, value, mesh, boundary);
                continue;
            }
            plain += 1;
            entries.extend(self.entry(book, kind, (key, key_span, value), mesh, boundary));
        }
        if plain == 0 && table.is_empty() {
            self.faults.push(Fault::at(span.clone(), "a rule without weights", "empty").hint("leave the table out"));
        }
        if entries.len() == plain && plain > 0 {
            book.rules.insert(kind, Rule { kind, entries, span: span.clone() });
        }
    }

    fn entry(
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
        for (condition, span) in conditions(&weights) {
            self.check_condition(condition, span, &decided);
        }
        Some(Entry { position, picks, weights, span })
    }

    fn weights(&mut self, value: &DeValue, span: &Range<usize>) -> Option<Weights> {
        let DeValue::Array(list) = value else { return self.formula(value, span).map(Weights::Each) };
        let formulas: Vec<_> = list.iter().filter_map(|item| self.formula(item.get_ref(), &item.span())).collect();
        (formulas.len() == list.len()).then_some(Weights::List(formulas, span.clone()))
    }

    /// `name[-1,1]`: the name and its indices.
    fn picks<'a>(&mut self, key: &'a str, span: &Range<usize>, kind: RuleKind) -> Option<(&'a str, Option<Vec<Pick>>)> {
        let Some((name, rest)) = key.split_once('[') else { return Some((key.trim(), None)) };
        let pick = |word: &str| match word.trim() {
            "k" if kind.variable() == Some("k") => Some(Pick::K),
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

    fn unknown_position(&mut self, kind: RuleKind, mesh: Option<&str>, name: &str, span: Range<usize>) {
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

    fn check_split(&mut self, items: &[Item], mesh: &str, split: &str) {
        let takes = &Vocabulary::get().splits[split].meshes;
        if !takes.iter().any(|own| own == mesh) {
            let span = self.find(items, "split").map_or(0..0, |(_, span)| span);
            let fault = Fault::at(span, format!("the split `{split}` doesn't go with {mesh}"), "");
            self.faults.push(fault.hint(format!("it takes {}", takes.join(" or "))));
        }
    }

    /// The split's rules are all there, and no other.
    fn check_births(&mut self, book: &RuleBook, split: &str, span: Range<usize>) {
        let births = &Vocabulary::get().splits[split].births;
        for birth in births {
            if !book.rules.contains_key(birth) && self.faults.is_empty() {
                let message = format!("the split `{split}` needs a rule [{}]", birth.name());
                self.faults.push(Fault::at(span.clone(), message, "asked for by this split"));
            }
        }
        for rule in book.rules.values() {
            let told = if rule.kind == RuleKind::EdgeFromIrregularEnd { RuleKind::Edge } else { rule.kind };
            if !births.contains(&told) {
                let message = format!("the split `{split}` makes no point for the rule [{}]", rule.kind.name());
                self.faults.push(Fault::at(rule.span.clone(), message, "superfluous"));
            }
            for entry in &rule.entries {
                let Some(born) = entry.position.births() else { continue };
                if !births.contains(&born) || born == rule.kind {
                    let message =
                        format!("`{}` has no points here: they are not made before this rule", entry.position.name);
                    self.faults.push(Fault::at(entry.span.clone(), message, format!("in [{}]", rule.kind.name())));
                }
            }
        }
    }

    // ---- claims -------------------------------------------------------------------------------------------------

    fn claims(&mut self, items: &[Item], book: &RuleBook) -> Vec<Claim> {
        let Some((value, span)) = self.find(items, "claims") else { return Vec::new() };
        let DeValue::Array(list) = value else {
            self.wrong_type(&span, "a list of tables, [[claims]],", value);
            return Vec::new();
        };
        list.iter().filter_map(|item| self.claim(item, book)).collect()
    }

    fn claim(&mut self, item: &Spanned<DeValue>, book: &RuleBook) -> Option<Claim> {
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

/// The names that conditions may use: counts and parameters.
fn in_conditions(parameters: &[Parameter]) -> BTreeSet<&str> {
    ["n", "k"].into_iter().chain(parameters.iter().map(|p| p.name.as_str())).collect()
}

fn conditions<T>(cases: &Cases<T>) -> Vec<(&Condition, &Range<usize>)> {
    match cases {
        Cases::Always(_) => Vec::new(),
        Cases::When(cases) => cases.iter().map(|(condition, span, _)| (condition, span)).collect(),
    }
}

fn quoted(words: &[&str]) -> String {
    words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ")
}

fn did_you_mean(word: &str, known: &[&str]) -> String {
    match nearest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("known are {}", quoted(known)),
    }
}

fn article(word: &str) -> &'static str {
    if word.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}
