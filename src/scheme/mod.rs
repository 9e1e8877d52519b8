//! What is a subdivision scheme?
//!
//! A short TOML file: which mesh, which split, and the weights as formulas in the valence. Nothing else defines a scheme;
//! the built-in ones are such files too ([`catalogue`]). A scheme knows positions by name and does not know meshes: weights
//! meet topology in [`crate::refine`].

mod any;
pub mod catalogue;
mod check;
mod claim;
mod classification;
pub mod curve;
mod defined;
mod evaluate;
mod flatness;
pub mod formula;
pub mod grid;
mod interval;
mod parameters;
mod parse;
pub mod vocabulary;

pub use any::AnyScheme;
pub(crate) use check::class_size;
pub use check::{RuleSum, SUM_TOLERANCE};
pub use claim::{BoundaryClaim, BoundaryQuantity, Claim, Quantity};
pub use classification::Classification;
pub use evaluate::Place;
pub use interval::Interval;
pub use parse::{KEYS, MAX_FILE_BYTES};

use crate::fault::{Fault, Faults};
use formula::{Condition, Formula};
use std::collections::BTreeMap;
use std::ops::Range;
use vocabulary::{Position, RuleKind};

/// A formula with its place in the file.
#[derive(Clone, Debug)]
pub struct Placed {
    /// The formula.
    pub formula: Formula,
    /// The bytes of the file that hold it, quotes included.
    pub span: Range<usize>,
    /// Where its text starts in the file; `None` when escapes stand between text and file.
    pub start: Option<usize>,
}

impl Placed {
    /// Bytes of the formula as bytes of the file.
    pub fn place(&self, inner: Range<usize>) -> Range<usize> {
        self.start.map_or(self.span.clone(), |start| start + inner.start..start + inner.end)
    }
}

/// Something told once, or case by case.
#[derive(Clone, Debug)]
pub enum Cases<T> {
    /// The same in every case.
    Always(T),
    /// Told by conditions, of which exactly one holds.
    When(Vec<(Condition, Range<usize>, T)>),
}

impl<T> Cases<T> {
    /// What is told, case by case.
    pub fn values(&self) -> Vec<&T> {
        match self {
            Cases::Always(value) => vec![value],
            Cases::When(cases) => cases.iter().map(|(_, _, value)| value).collect(),
        }
    }

    /// The conditions of the cases, each with its place.
    pub fn conditions(&self) -> Vec<(&Condition, &Range<usize>)> {
        match self {
            Cases::Always(_) => Vec::new(),
            Cases::When(cases) => cases.iter().map(|(condition, span, _)| (condition, span)).collect(),
        }
    }
}

/// The weights of a class of points.
#[derive(Clone, Debug)]
pub enum Weights {
    /// One formula for each of them, in which `j` is the point's index.
    Each(Placed),
    /// A formula for every point.
    List(Vec<Placed>, Range<usize>),
}

/// An index into a class of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pick {
    /// A number; negative ones count from the end.
    Index(i64),
    /// The last one at a boundary vertex with k faces.
    K,
}

/// One row of a rule: a class of points, perhaps some of them only, with their weights.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The class.
    pub position: Position,
    /// The points of the class that are meant; `None` for all.
    pub picks: Option<Vec<Pick>>,
    /// Their weights.
    pub weights: Cases<Weights>,
    /// Where it stands.
    pub span: Range<usize>,
}

/// How a new point is made.
#[derive(Clone, Debug)]
pub struct Rule {
    /// What it is told around.
    pub kind: RuleKind,
    /// Its rows, in the file's order.
    pub entries: Vec<Entry>,
    /// Where its table starts.
    pub span: Range<usize>,
}

/// A number that the user may choose.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name in formulas.
    pub name: String,
    /// Its value: the default, or what was set.
    pub value: Placed,
    /// What it means, in words.
    pub means: String,
    /// The least and the greatest value allowed.
    pub range: Option<(Placed, Placed)>,
    /// Whether it must be a whole number.
    pub integer: bool,
    /// Whether it stands for itself where numbers are exact; approximate numbers take its value all the same.
    pub free: bool,
    /// Where it stands.
    pub span: Range<usize>,
}

/// A named formula.
#[derive(Clone, Debug)]
pub struct Let {
    /// Its name in other formulas.
    pub name: String,
    /// What it stands for.
    pub value: Cases<Placed>,
    /// Whether it depends on the index `j`, perhaps through other names.
    pub uses_index: bool,
}

/// One pass of a step of several: its split and rules.
#[derive(Clone, Debug)]
pub struct Pass {
    /// The split, a name of the vocabulary.
    pub split: String,
    /// Its rules.
    pub rules: BTreeMap<RuleKind, Rule>,
    /// How often it is made; once where nothing is said.
    pub repeat: Option<Placed>,
    /// Where its table starts.
    pub span: Range<usize>,
}

/// The most passes of one step.
pub const MOST_PASSES: usize = 32;

/// What one pass of a step is: its split and rules.
#[derive(Clone, Copy, Debug)]
pub struct PassRules<'a> {
    /// The split, a name of the vocabulary.
    pub split: &'a str,
    /// Its rules.
    pub rules: &'a BTreeMap<RuleKind, Rule>,
}

/// The rules of one file with the names that they use.
#[derive(Clone, Debug)]
pub struct RuleBook {
    /// The file's name, for messages.
    pub origin: String,
    /// The file's text.
    pub text: String,
    /// What the scheme is called.
    pub title: String,
    /// Keys of `schemes/sources.toml`, or words.
    pub sources: Vec<String>,
    /// Numbers that the user may choose.
    pub parameters: Vec<Parameter>,
    /// Named formulas.
    pub lets: Vec<Let>,
    /// The rules, where a step is one pass.
    pub rules: BTreeMap<RuleKind, Rule>,
    /// The passes of a step of several.
    pub passes: Vec<Pass>,
    /// The boundary file whose rules hold where this one has none.
    pub like: Option<Box<RuleBook>>,
    /// The number of corners of every face that a rule is told around, where it is the same for all.
    pub face_corners: Option<i64>,
    /// The flatness s of a boundary file by kind of vertex: crease, corner, dart.
    pub flatness: BTreeMap<String, Cases<Placed>>,
    /// What is said of a boundary file; what is said of a scheme are [`Scheme::claims`].
    pub claims: Vec<BoundaryClaim>,
}

impl RuleBook {
    /// The rules of all passes.
    pub fn all_rules(&self) -> impl Iterator<Item = &Rule> {
        self.rules.values().chain(self.passes.iter().flat_map(|pass| pass.rules.values()))
    }

    /// The rule of a kind, with the file that tells it: this one, or that which it is like.
    pub fn told(&self, kind: RuleKind) -> Option<(&RuleBook, &Rule)> {
        let own = self.rules.get(&kind).map(|rule| (self, rule));
        own.or_else(|| self.like.as_ref().and_then(|like| like.told(kind)))
    }

    /// The sources of this file and of that which it is like, each once.
    pub fn all_sources(&self) -> Vec<String> {
        let mut all = self.sources.clone();
        let more = self.like.as_ref().map_or(vec![], |like| like.all_sources());
        all.extend(more.into_iter().filter(|source| !self.sources.contains(source)));
        all
    }

    /// Whether rules for edges are told from their ends on a boundary or crease: then vertices there look at their neighbours.
    pub fn tells_from_ends(&self) -> bool {
        RuleKind::FROM_ENDS.iter().any(|kind| self.told(*kind).is_some())
    }

    /// The faults as an error about this file.
    pub fn faults(&self, faults: Vec<Fault>) -> Faults {
        Faults { origin: self.origin.clone(), text: self.text.clone(), faults }
    }
}

/// A subdivision scheme.
#[derive(Clone, Debug)]
pub struct Scheme {
    /// Its short name: the file's name without its ending.
    pub id: String,
    /// Its rules.
    pub book: RuleBook,
    /// The kind of mesh: triangles, quads or polygons.
    pub mesh: String,
    /// The split, a name of the vocabulary; empty where a step has several passes, each with its own.
    pub split: String,
    /// The boundary files that go with it; the first is the default.
    pub boundary: Vec<String>,
    /// What the literature says about it.
    pub claims: Vec<Claim>,
}

impl Scheme {
    /// The valence at which the scheme is regular: 6 on triangles, 4 on quads.
    pub fn regular_valence(&self) -> usize {
        if self.mesh == "triangles" { 6 } else { 4 }
    }

    /// The passes of one step, in order, each as often as it is made.
    pub fn passes(&self) -> Vec<PassRules<'_>> {
        if self.book.passes.is_empty() {
            return vec![PassRules { split: &self.split, rules: &self.book.rules }];
        }
        let of = |pass| std::iter::repeat_n(pass, self.book.repeats(pass).min(MOST_PASSES));
        let all = self.book.passes.iter().flat_map(of).take(MOST_PASSES);
        all.map(|pass| PassRules { split: &pass.split, rules: &pass.rules }).collect()
    }

    /// The split, or those of the passes: `1-to-n, then 2 x faces-to-vertices`.
    pub fn split_in_words(&self) -> String {
        let passes = self.passes();
        let runs = passes.chunk_by(|a, b| a.split == b.split);
        let words = runs.map(|run| match run {
            [one] => one.split.to_string(),
            _ => format!("{} x {}", run.len(), run[0].split),
        });
        words.collect::<Vec<_>>().join(", then ")
    }

    /// Whether the scheme keeps the points of the coarse mesh: its vertex rule is the vertex itself.
    pub fn is_interpolating(&self) -> bool {
        // passes after the first move what it keeps
        let rules = if self.book.passes.len() > 1 { None } else { self.passes().first().map(|pass| pass.rules) };
        rules.and_then(|rules| rules.get(&RuleKind::Vertex)).is_some_and(|rule| {
            let [entry] = rule.entries.as_slice() else { return false };
            let one = |weights: &&Weights| matches!(weights, Weights::Each(formula) if formula.formula.text() == "1");
            entry.position.name == "centre" && entry.weights.values().iter().all(one)
        })
    }
}
