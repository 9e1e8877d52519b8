//! How is a scheme file read?
//!
//! TOML 1.0 with places kept. Every fault is collected and reading goes on, so that a user sees all of them at once. The
//! keys are listed in [`KEYS`]; the README's table says what they mean, and a test holds the two together.

mod boundary_claims;
mod claims;
mod curve;
mod flatness;
mod grid;
mod names;
mod passes;
mod rules;
mod values;

use super::evaluate::Place;
use super::formula::Formula;
use super::{Placed, RuleBook, Scheme, catalogue};
use crate::fault::{Fault, Faults};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The largest file that is read.
pub const MAX_FILE_BYTES: usize = 1 << 16;

/// Every key of a scheme file and of a boundary file, as the README's table lists them.
pub const KEYS: [&str; 44] = [
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
    "pass",
    "pass.repeat",
    "claims",
    "claims.what",
    "claims.where",
    "claims.equals",
    "claims.source",
    "vertex.crease, vertex.corner, edge.crease",
    "edge.crease.from-irregular-end, edge.crease.from-dart-end",
    "edge.crease.third, edge.crease.third.from-corner-end",
    "edge.from-crease-end, edge.from-corner-end, edge.from-dart-end",
    "like",
    "triangles, quads",
    "flatness",
    "claims.at",
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
    "ends.rules",
    "ends.then",
    "product",
];

const SCHEME_KEYS: [&str; 12] =
    ["name", "mesh", "split", "source", "boundary", "parameters", "let", "vertex", "edge", "face", "corner", "pass"];
const BOUNDARY_KEYS: [&str; 11] =
    ["name", "source", "like", "parameters", "let", "vertex", "edge", ON_TRIANGLES, ON_QUADS, "flatness", "claims"];
/// The tables of a boundary file for one kind of mesh only.
const ON_TRIANGLES: &str = "triangles";
const ON_QUADS: &str = "quads";
const MESHES: [&str; 3] = ["triangles", "quads", "polygons"];
/// What stands under `mesh` in a file of a scheme for curves.
const CURVE: &str = "curve";
/// What stands under `mesh` in a file of a tensor product.
const GRID: &str = "grid";

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
        self.book.set(name, given)
    }
}

impl RuleBook {
    /// Whether this file, or that which it is like, has a parameter of this name.
    pub fn has_parameter(&self, name: &str) -> bool {
        let own = self.parameters.iter().any(|own| own.name == name);
        own || self.like.as_ref().is_some_and(|like| like.has_parameter(name))
    }

    /// Sets a parameter of this file, or of that which it is like; of both where both have it.
    ///
    /// # Errors
    /// Why it can't be set, in words.
    pub fn set(&mut self, name: &str, given: &str) -> Result<(), String> {
        if let Some(like) = self.like.as_mut().filter(|like| like.has_parameter(name)) {
            like.set(name, given)?;
            if self.parameters.iter().all(|own| own.name != name) {
                return Ok(());
            }
        }
        let known: Vec<String> = self.parameters.iter().map(|p| p.name.clone()).collect();
        let Some(parameter) = self.parameters.iter_mut().find(|p| p.name == name) else {
            return Err(match known.as_slice() {
                [] => format!("{} has no parameters, so `{name}` can't be set", self.title),
                _ => format!("{} has no parameter `{name}`; it has {}", self.title, known.join(", ")),
            });
        };
        let formula = Formula::parse(given).map_err(|fault| format!("`{name}={given}`: {}", fault.message))?;
        if let Some((used, _)) = formula.names().next() {
            return Err(format!("`{name}={given}`: a parameter's value is a number, and `{used}` is a name"));
        }
        let value = Placed { formula, span: parameter.span.clone(), start: None };
        parameter.value = value.clone();
        let evaluated = self.evaluate::<f64>(&value, &Place::at(None, 0));
        evaluated.map(|_| ()).map_err(|fault| format!("`{name}={given}`: {}", fault.message))
    }

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
    /// Counts and indices that names under [let] may use.
    counts: &'static [&'static str],
}

impl<'t> Reader<'t> {
    fn new(text: &'t str) -> Self {
        Reader { text, faults: Vec::new(), broken: BTreeSet::new(), counts: &["n", "k", "j"] }
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
        let several = self.find(&items, "pass");
        let split = if several.is_some() { Some(String::new()) } else { self.split(&items, mesh.as_deref()) };
        let boundary = self.words(&items, "boundary");
        for (name, span) in &boundary {
            if !catalogue::BOUNDARIES.iter().any(|listed| listed.id == name) {
                self.no_boundary_file(name, span.clone());
            }
        }
        let mut book = self.book(&items, origin, mesh.as_deref(), false)?;
        if let Some((list, span)) = several {
            self.nothing_beside_passes(&items);
            book.passes = self.passes(&book, list, &span, mesh.as_deref());
            // on quads and polygons later passes meet whatever faces the first ones make; triangles become triangles
            book.face_corners = book.face_corners.filter(|corners| *corners == 3);
        } else if let (Some(split), Some((_, span))) = (&split, self.find(&items, "split")) {
            self.check_births(&book.rules, split, span);
        }
        let claims = self.claims(&items, &book);
        let boundary = boundary.into_iter().map(|(name, _)| name).collect();
        Some(Scheme { id: id.to_string(), book, mesh: mesh?, split: split?, boundary, claims })
    }

    fn boundary(&mut self, origin: &str, mesh: &str) -> Option<RuleBook> {
        let top = self.top()?;
        let mut items = self.items(top.get_ref(), &BOUNDARY_KEYS, "a boundary file");
        for (key, holds) in [(ON_TRIANGLES, mesh == "triangles"), (ON_QUADS, mesh != "triangles")] {
            match self.find(&items, key) {
                Some((DeValue::Table(table), _)) if holds => {
                    items.extend(self.items(table, &["vertex", "edge"], "rules for one mesh"));
                }
                None | Some((DeValue::Table(_), _)) => {}
                Some((value, span)) => self.wrong_type(&span, "a table of rules", value),
            }
        }
        let like = self.like(&items, mesh);
        let book = self.book(&items, origin, Some(mesh), true)?;
        let flatness = self.flatness(&items, &book);
        let claims = self.boundary_claims(&items, &book);
        Some(RuleBook { like, flatness, claims, ..book })
    }

    /// The boundary file of the catalogue that another one is like.
    fn like(&mut self, items: &[Item], mesh: &str) -> Option<Box<RuleBook>> {
        let (value, span) = self.find(items, "like")?;
        let name = self.string(value, &span)?;
        match catalogue::boundary(&name, mesh) {
            Some(Ok(book)) => return Some(Box::new(book)),
            Some(Err(_)) => self.faults.push(Fault::at(span, format!("the boundary file `{name}` has faults"), "")),
            None => self.no_boundary_file(&name, span),
        }
        None
    }

    fn no_boundary_file(&mut self, name: &str, span: Range<usize>) {
        let names: Vec<&str> = catalogue::BOUNDARIES.iter().map(|listed| listed.id).collect();
        let fault = Fault::at(span, format!("there is no boundary file `{name}`"), "unknown");
        self.faults.push(fault.hint(format!("the boundary files are {}", names.join(", "))));
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
            passes: Vec::new(),
            face_corners: match mesh {
                Some("triangles") => Some(3),
                Some("quads") => Some(4),
                _ => None,
            },
            like: None,
            flatness: BTreeMap::new(),
            claims: vec![],
        };
        book.rules = self.rules(&book, items, mesh, boundary);
        Some(book)
    }
}
