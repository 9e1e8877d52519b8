//! What are the weights of a rule exactly, at every frequency?
//!
//! A rule that is told around the centre has weights on a whole ring of n points. The blocks see such a ring at frequency k
//! like its first point alone, with the weight sum_j g(j) w^(k j) ([`crate::numbers::PerFrequency`]): so no row is longer for
//! a larger n, and n may be left free. Formulas are brought to their exact form and read in a world of numbers.

use super::{Obstacle, Weigher};
use crate::fault::Fault;
use crate::mesh::Lattice;
use crate::numbers::{Field, Laurent, Number, PerFrequency, RingWorld, Trouble, World};
use crate::scheme::vocabulary::RuleKind;
use crate::scheme::{Entry, Pick, Place, Placed, RuleBook, Weights};
use std::cell::Cell;
use std::rc::Rc;

/// How many sectors there are around the centre.
#[derive(Clone, Debug)]
pub enum Count<F> {
    /// A number of them.
    Number,
    /// The free n: its value, and a valence whose cases are taken.
    Free {
        /// n itself.
        n: F,
        /// Conditions are decided here.
        like: usize,
    },
}

/// Points of a class by their index, each with its weight.
type Weighed<F> = Result<Vec<(usize, PerFrequency<F>)>, Obstacle>;

/// The exact weights of a scheme's rules around one centre.
pub struct ExactWeights<'w, W: World> {
    world: &'w W,
    count: Count<W::Value>,
    /// The count that tells the centre from other places.
    centre: usize,
    /// The largest n at which frequencies of a ring fall together, as far as rings have been met.
    aliases: Rc<Cell<usize>>,
}

impl<'w, W: World> ExactWeights<'w, W> {
    /// Weights around a centre with `centre` sectors on the patch; other places of the same count must not be there. `aliases`
    /// takes down the largest n at which frequencies fall together.
    pub fn new(world: &'w W, count: Count<W::Value>, centre: usize, aliases: Rc<Cell<usize>>) -> Self {
        ExactWeights { world, count, centre, aliases }
    }

    /// Whether the rule is told around the centre: a vertex, or on the dual lattice a face.
    fn is_central(&self, kind: RuleKind, count: usize, on: Lattice) -> bool {
        let told_there = match kind {
            RuleKind::Vertex | RuleKind::EdgeFromIrregularEnd => on.has_centre(),
            RuleKind::Corner | RuleKind::Face => !on.has_centre(),
            _ => false,
        };
        told_there && count == self.centre
    }

    /// Where formulas are evaluated: n stays a name where it is free.
    fn place(&self, kind: RuleKind, count: usize, central: bool) -> Place<Laurent> {
        match &self.count {
            Count::Free { like, .. } if central => {
                Place { value: Laurent::atom("n"), ..Place::at(kind.variable(), *like as i64) }
            }
            _ => Place::at(kind.variable(), count as i64),
        }
    }

    fn value(&self, book: &RuleBook, placed: &Placed, place: &Place<Laurent>) -> Result<W::Value, Obstacle> {
        let form = exact_form(book, placed, place)?;
        form.read(self.world).map_err(|trouble| unread(trouble, placed, place))
    }

    /// The ring's sum at each frequency, where its weight is a formula in j.
    fn ring(
        &self,
        book: &RuleBook,
        placed: &Placed,
        place: &Place<Laurent>,
    ) -> Result<PerFrequency<W::Value>, Obstacle> {
        let at = Place { index: Laurent::atom("j"), ..place.clone() };
        let form = exact_form(book, placed, &at)?;
        let (n, size) = match &self.count {
            Count::Number => (W::Value::whole(self.centre as i64), Some(self.centre)),
            Count::Free { n, .. } => (n.clone(), None),
        };
        let series = form.read(&RingWorld { base: self.world, size });
        let sums = series.and_then(|series| {
            self.aliases.set(self.aliases.get().max(series.aliases_up_to()));
            series.sums(&n, size)
        });
        sums.map_err(|trouble| unread(trouble, placed, place))
    }

    /// A whole ring around the centre as its first points alone: one for each walk of the class.
    fn whole_ring(&self, book: &RuleBook, entry: &Entry, place: &Place<Laurent>) -> Weighed<W::Value> {
        let walks = entry.position.walks.len();
        match book.select(&entry.weights, place)? {
            Weights::Each(placed) if walks == 1 || !book.uses_index(&placed.formula) => {
                let sum = self.ring(book, placed, place)?;
                Ok((0..walks).map(|walk| (walk, sum.clone())).collect())
            }
            Weights::Each(placed) => {
                Err(unread(Trouble::BeyondThisWorld("a ring of several kinds of points"), placed, place))
            }
            Weights::List(_, span) => {
                Err(Obstacle::Inexact(Fault::at(span.clone(), "a list of weights has no formula in n", "this list")))
            }
        }
    }

    /// Chosen points of a class around a free centre: negative indices stay negative.
    fn picked(&self, book: &RuleBook, entry: &Entry, picks: &[Pick], place: &Place<Laurent>) -> Weighed<W::Value> {
        let mut weights = Vec::new();
        for (at, pick) in picks.iter().enumerate() {
            let Pick::Index(index) = pick else { continue };
            let here = Place { index: Laurent::whole(*index), ..place.clone() };
            let value = match book.select(&entry.weights, place)? {
                Weights::Each(placed) => self.value(book, placed, &here)?,
                Weights::List(list, span) => {
                    let wrong = || Fault::at(span.clone(), "one weight for each point is needed", "this list");
                    self.value(book, list.get(at).ok_or_else(wrong)?, &here)?
                }
            };
            let start = index.rem_euclid(self.centre as i64 * entry.position.walks.len() as i64);
            weights.push((start as usize, PerFrequency::same(value)));
        }
        Ok(weights)
    }

    /// Point by point.
    fn listed(&self, book: &RuleBook, entry: &Entry, size: usize, place: &Place<Laurent>) -> Weighed<W::Value> {
        let forms = book.weights(entry, size, place).map_err(no_exact_form)?;
        let span = entry.span.clone();
        let read = |(index, form): (usize, Laurent)| match form.read(self.world) {
            Ok(value) => Ok((index, PerFrequency::same(value))),
            Err(trouble) => Err(told(trouble, span.clone(), place)),
        };
        forms.into_iter().map(read).collect()
    }
}

/// The values of formulas in enclosures, point by point: where a formula has no exact form.
pub struct EnclosedWeights;

impl<F: Number> Weigher<PerFrequency<F>> for EnclosedWeights {
    fn weights(&self, book: &RuleBook, entry: &Entry, kind: RuleKind, count: usize, _: Lattice) -> Weighed<F> {
        let place = Place::<F>::at(kind.variable(), count as i64);
        let size = crate::scheme::class_size(entry, kind, count as i64);
        let weights = book.weights(entry, size, &place).map_err(no_exact_form)?;
        Ok(weights.into_iter().map(|(index, weight)| (index, PerFrequency::same(weight))).collect())
    }
}

/// The exact form of a formula.
fn exact_form(book: &RuleBook, placed: &Placed, place: &Place<Laurent>) -> Result<Laurent, Obstacle> {
    book.evaluate(placed, place).map_err(no_exact_form)
}

/// A division by an exact zero is a fault of the file; a value that can't be held is none.
fn no_exact_form(fault: Fault) -> Obstacle {
    let wrong = [Trouble::DivisionByZero, Trouble::NegativeRoot].map(|trouble| trouble.to_string());
    if wrong.iter().any(|start| fault.message.starts_with(start)) {
        Obstacle::Fault(fault)
    } else {
        Obstacle::Inexact(fault)
    }
}

fn unread(trouble: Trouble, placed: &Placed, place: &Place<Laurent>) -> Obstacle {
    told(trouble, placed.span.clone(), place)
}

fn told(trouble: Trouble, span: std::ops::Range<usize>, place: &Place<Laurent>) -> Obstacle {
    let free = place.value == Laurent::atom("n");
    let at = match place.variable {
        Some(name) if !free => format!(" at {name} = {}", place.count),
        _ => String::new(),
    };
    no_exact_form(Fault::at(span, format!("{trouble}{at}"), "in this formula"))
}

impl<W: World> Weigher<PerFrequency<W::Value>> for ExactWeights<'_, W> {
    fn weights(&self, book: &RuleBook, entry: &Entry, kind: RuleKind, count: usize, on: Lattice) -> Weighed<W::Value> {
        let central = self.is_central(kind, count, on);
        let place = self.place(kind, count, central);
        let size = crate::scheme::class_size(entry, kind, count as i64);
        let free = matches!(self.count, Count::Free { .. });
        if !central || entry.position.once {
            return self.listed(book, entry, size, &place);
        }
        match &entry.picks {
            Some(picks) if free => self.picked(book, entry, picks, &place),
            Some(_) => self.listed(book, entry, size, &place),
            None => match self.whole_ring(book, entry, &place) {
                Err(Obstacle::Inexact(_)) if !free => self.listed(book, entry, size, &place),
                other => other,
            },
        }
    }
}
