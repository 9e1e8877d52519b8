//! What are the weights of a rule at this valence, in this world of numbers?

use super::formula::{Condition, Failure, Formula, Names};
use super::{BoundaryClaim, Cases, Claim, Entry, Pick, Placed, RuleBook, Scheme, Weights};
use crate::fault::Fault;
use crate::numbers::{Enclosure, Laurent, Number, Trouble};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;

/// The deepest chain of `[let]` names.
pub(super) const MAX_LET_DEPTH: usize = 32;

/// The place that formulas are evaluated at: its count, if it has one, and the index of the point in its class.
#[derive(Clone, Debug)]
pub struct Place<W> {
    /// `n` or `k`, whichever the rule is told with.
    pub variable: Option<&'static str>,
    /// The count at which conditions are decided.
    pub count: i64,
    /// The value of the variable.
    pub value: W,
    /// The value of `j`.
    pub index: W,
}

impl<W: Number> Place<W> {
    /// A vertex with n edges, or a face with n corners.
    pub fn at(variable: Option<&'static str>, count: i64) -> Self {
        Place { variable, count, value: W::whole(count), index: W::whole(0) }
    }
}

/// The bits of numbers in conditions that the exact world has not.
const BITS: usize = 256;

struct Scope<'a, W> {
    book: &'a RuleBook,
    place: &'a Place<W>,
    depth: usize,
    /// The innermost fault, when a name's own formula has no value.
    inner: &'a RefCell<Option<Fault>>,
    /// The values of names that are known already.
    known: &'a RefCell<BTreeMap<String, W>>,
}

impl<'a, W> Scope<'a, W> {
    fn new(
        book: &'a RuleBook,
        place: &'a Place<W>,
        inner: &'a RefCell<Option<Fault>>,
        known: &'a RefCell<BTreeMap<String, W>>,
    ) -> Self {
        Scope { book, place, depth: 0, inner, known }
    }
}

impl<W: Number> Names<W> for Scope<'_, W> {
    fn value(&self, name: &str) -> Result<W, Trouble> {
        if Some(name) == self.place.variable {
            return Ok(self.place.value.clone());
        }
        if name == "j" {
            return Ok(self.place.index.clone());
        }
        if let Some(value) = self.known.borrow().get(name) {
            return Ok(value.clone());
        }
        let deeper = Scope { depth: self.depth + 1, ..*self };
        let placed = if let Some(parameter) = self.book.parameters.iter().find(|p| p.name == name) {
            if let Some(value) = parameter.free.then(|| W::indeterminate(name)).flatten() {
                return Ok(value);
            }
            &parameter.value
        } else if let Some(named) = self.book.lets.iter().find(|named| named.name == name) {
            self.book.select(&named.value, self.place).map_err(|fault| self.keep(fault))?
        } else {
            return Err(Trouble::Domain(match name {
                "n" => "`n` has no value here: this rule is not told around a vertex or a face",
                "k" => "`k` has no value here: it counts the faces of a boundary vertex",
                _ => "this name has no value",
            }));
        };
        if self.depth >= MAX_LET_DEPTH {
            return Err(Trouble::Domain("names refer to each other too deeply"));
        }
        let value: Result<W, Failure> = placed.formula.evaluate(&deeper);
        let value = value.map_err(|failure| self.keep(self.book.fault(placed, failure, self.place)))?;
        self.known.borrow_mut().insert(name.to_string(), value.clone());
        Ok(value)
    }
}

impl<W: Number> Scope<'_, W> {
    /// Keeps the innermost fault, for its place; the trouble itself travels on.
    fn keep(&self, fault: Fault) -> Trouble {
        self.inner.borrow_mut().get_or_insert(fault);
        Trouble::Domain("the value of this name is missing")
    }
}

impl RuleBook {
    /// The value of a formula of this file at a place.
    ///
    /// # Errors
    /// The fault, at the operation that has no value.
    pub fn evaluate<W: Number>(&self, placed: &Placed, place: &Place<W>) -> Result<W, Fault> {
        let (inner, known) = (RefCell::new(None), RefCell::new(BTreeMap::new()));
        let value = placed.formula.evaluate(&Scope::new(self, place, &inner, &known));
        value.map_err(|failure| inner.take().unwrap_or_else(|| self.fault(placed, failure, place)))
    }

    fn fault<W>(&self, placed: &Placed, failure: Failure, place: &Place<W>) -> Fault {
        let where_ = place.variable.map_or(String::new(), |name| format!(" at {name} = {}", place.count));
        let shown = &placed.formula.text()[failure.span.clone()];
        Fault::at(placed.place(failure.span), format!("{}{where_}", failure.trouble), format!("in `{shown}`"))
    }

    /// Whether a condition holds at a count, decided exactly where the exact world has its sides, else by enclosures.
    ///
    /// # Errors
    /// When a side has no value, or enclosures don't tell.
    pub(super) fn holds(
        &self,
        condition: &Condition,
        span: &Range<usize>,
        variable: Option<&'static str>,
        count: i64,
    ) -> Result<bool, Fault> {
        let inner = RefCell::new(None);
        let (exact, known) = (Place::<Laurent>::at(variable, count), RefCell::new(BTreeMap::new()));
        if let Ok(holds) = condition.holds(&Scope::new(self, &exact, &inner, &known)) {
            return Ok(holds);
        }
        let (enclosed, known) = (Place::<Enclosure<BITS>>::at(variable, count), RefCell::new(BTreeMap::new()));
        let holds = condition.holds(&Scope::new(self, &enclosed, &inner, &known));
        holds.map_err(|failure| {
            let at = variable.map_or(String::new(), |name| format!(" at {name} = {count}"));
            Fault::at(span.clone(), format!("{}{at}", failure.trouble), "in this condition")
        })
    }

    /// The case that holds at a place.
    ///
    /// # Errors
    /// When no condition holds, or one has no value.
    pub fn select<'a, T, W>(&self, cases: &'a Cases<T>, place: &Place<W>) -> Result<&'a T, Fault> {
        let cases = match cases {
            Cases::Always(value) => return Ok(value),
            Cases::When(cases) => cases,
        };
        for (condition, span, value) in cases {
            if self.holds(condition, span, place.variable, place.count)? {
                return Ok(value);
            }
        }
        let span = cases.first().map_or(0..0, |(_, span, _)| span.clone());
        let at = place.variable.map_or(String::new(), |name| format!(" {name} = {}", place.count));
        Err(Fault::at(span, format!("no case holds at{at}"), "the first of the cases").hint("cover every valence"))
    }

    /// Whether a formula depends on the index `j`, perhaps through names.
    pub(crate) fn uses_index(&self, formula: &Formula) -> bool {
        let indexed = |name: &str| name == "j" || self.lets.iter().any(|l| l.name == name && l.uses_index);
        formula.names().any(|(name, _)| indexed(name))
    }

    /// The points of a class of `size` that an entry means, each with its weight.
    ///
    /// # Errors
    /// When a weight has no value, a list has another length, or an index is out of range.
    pub fn weights<W: Number>(&self, entry: &Entry, size: usize, place: &Place<W>) -> Result<Vec<(usize, W)>, Fault> {
        let indices = self.indices(entry, size, place)?;
        match self.select(&entry.weights, place)? {
            Weights::List(formulas, span) => {
                if formulas.len() != indices.len() {
                    return Err(self.wrong_length(formulas.len(), indices.len(), span, entry, place));
                }
                let values = formulas.iter().map(|formula| self.evaluate(formula, place));
                indices.into_iter().zip(values).map(|(index, value)| Ok((index, value?))).collect()
            }
            Weights::Each(formula) if self.uses_index(&formula.formula) => indices
                .into_iter()
                .map(|index| {
                    let at = Place { index: W::whole(index as i64), ..place.clone() };
                    Ok((index, self.evaluate(formula, &at)?))
                })
                .collect(),
            Weights::Each(formula) => {
                let value = self.evaluate(formula, place)?;
                Ok(indices.into_iter().map(|index| (index, value.clone())).collect())
            }
        }
    }

    fn indices<W>(&self, entry: &Entry, size: usize, place: &Place<W>) -> Result<Vec<usize>, Fault> {
        let Some(picks) = &entry.picks else { return Ok((0..size).collect()) };
        let cyclic = !entry.position.is_open();
        let index = |pick: &Pick| {
            let index = if let Pick::Index(index) = pick { *index } else { place.count };
            if cyclic {
                Some(index.rem_euclid(size as i64))
            } else {
                (0..size as i64).contains(&index).then_some(index)
            }
        };
        let outside =
            || Fault::at(entry.span.clone(), format!("an index is outside 0..{}", size.saturating_sub(1)), "");
        picks.iter().map(|pick| index(pick).map(|index| index as usize).ok_or_else(outside)).collect()
    }

    fn wrong_length<W>(
        &self,
        given: usize,
        wanted: usize,
        span: &Range<usize>,
        entry: &Entry,
        place: &Place<W>,
    ) -> Fault {
        let at = place.variable.map_or(String::new(), |name| format!(" at {name} = {}", place.count));
        let message = format!("{given} weights for {wanted} points of `{}`{at}", entry.position.name);
        Fault::at(span.clone(), message, format!("{given} weights"))
            .hint("give one weight for each point, or one formula in j")
    }
}

impl RuleBook {
    /// Whether a claim of a boundary file is made for a number of faces, which its condition calls `variable`.
    ///
    /// # Errors
    /// When its condition has no value there.
    pub fn is_claimed_at(&self, claim: &BoundaryClaim, variable: &'static str, faces: usize) -> Result<bool, Fault> {
        let Some(condition) = &claim.condition else { return Ok(true) };
        self.holds(condition, &claim.span, Some(variable), faces as i64)
    }
}

impl Scheme {
    /// Whether a claim is made for a valence.
    ///
    /// # Errors
    /// When its condition has no value there.
    pub fn claim_is_made_at(&self, claim: &Claim, valence: usize) -> Result<bool, Fault> {
        let Some(condition) = &claim.condition else { return Ok(true) };
        self.book.holds(condition, &claim.span, Some("n"), valence as i64)
    }
}
