//! Which conditions hold at one value of the parameter?
//!
//! At a rational value by the exact analysis of the scheme with that value; at another by enclosures, and where these don't tell, by the
//! exact analysis, if the value can be written.

use super::candidates::Candidate;
use crate::analysis::exact::formulas::AllValences;
use crate::analysis::exact::words::Words;
use crate::analysis::exact::{Arithmetic, BITS, ExactAnalysis, Task, Value};
use crate::analysis::neighbourhood::Orbit;
use crate::analysis::spectra::Spectra;
use crate::numbers::{Angle, EnclosedParameter, Univariate, World};
use crate::refine::{Obstacle, lattice_of};
use crate::scheme::{Place, Scheme};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// Whether each of [`super::Condition::ALL`] holds, where that is decided.
pub(super) type Decided = [Option<bool>; 3];

/// What decides at one valence.
pub(super) struct Decider<'a> {
    /// The scheme with the parameter left free.
    pub(super) scheme: &'a Scheme,
    /// The orbits of the full neighbourhood where no weight vanishes by chance.
    pub(super) orbits: &'a [Orbit],
    /// The forms for all valences with the parameter left free, where there are any.
    pub(super) forms: Option<&'a AllValences>,
    /// The parameter.
    pub(super) name: &'a str,
    /// The valence.
    pub(super) n: usize,
}

impl Decider<'_> {
    /// The task with the parameter left free.
    pub(super) fn task(&self) -> Task<'_> {
        let lattice = lattice_of(self.scheme);
        Task { scheme: self.scheme, lattice, valence: self.n, orbits: self.orbits, forms: self.forms, regular: None }
    }

    /// What holds at a rational value between the candidates; everything must be decided there.
    pub(super) fn sample(&self, value: &RBig) -> Result<Decided, String> {
        let decided =
            self.written(&value.to_string()).map_err(|obstacle| format!("at {} = {value}: {obstacle}", self.name))?;
        if decided.contains(&None) {
            return Err(format!("at {} = {value} exact numbers don't tell which moduli are equal", self.name));
        }
        Ok(decided)
    }

    /// What holds at a rational value; where a weight has no value, nothing does.
    pub(super) fn at_rational(&self, value: &RBig) -> Decided {
        self.at_words(&value.to_string())
    }

    fn at_words(&self, value: &str) -> Decided {
        match self.written(value) {
            Ok(decided) => decided,
            Err(Obstacle::Fault(_)) => [Some(false); 3],
            Err(_) => [None; 3],
        }
    }

    /// What holds at a candidate.
    pub(super) fn at_candidate(&self, candidate: &Candidate) -> Decided {
        if let Some(value) = candidate.rational() {
            return self.at_rational(&value);
        }
        let enclosed = self.enclosed(&candidate.value).unwrap_or([None; 3]);
        let Words { text, .. } = candidate.end().exact;
        if !enclosed.contains(&None) || candidate.polynomial.degree() > Some(2) {
            return enclosed;
        }
        // a formula that does not say the value would decide about another one
        if !self.says(&text, &candidate.value) {
            return enclosed;
        }
        let written = self.at_words(&text);
        [0, 1, 2].map(|which| enclosed[which].or(written[which]))
    }

    /// Whether a formula has this value, as far as floating numbers tell.
    fn says(&self, text: &str, value: &Value) -> bool {
        let Ok(scheme) = self.scheme.with_value(self.name, text) else { return false };
        let Ok(parameter) = scheme.parameter(self.name) else { return false };
        let found = scheme.book.evaluate(&parameter.value, &Place::<f64>::at(None, 0));
        found.is_ok_and(|found| (found - value.midpoint_f64()).abs() < 1e-9)
    }

    /// By the exact analysis, the value being a formula.
    fn written(&self, value: &str) -> Result<Decided, Obstacle> {
        let scheme = self.scheme.with_value(self.name, value).map_err(Obstacle::Limit)?;
        let (orbits, _) = Spectra::new(&scheme)?.neighbourhoods(self.n)?;
        let task = Task { scheme: &scheme, orbits: &orbits, ..self.task() };
        Ok(decided(&task.run()?))
    }

    /// By enclosures, the value being enclosed.
    fn enclosed(&self, value: &Value) -> Result<Decided, Obstacle> {
        let world = EnclosedParameter::<BITS> { name: self.name, value };
        let task = self.task();
        let rows = task.rows(&world)?;
        let cosine = |k: usize| world.cos(&Angle::fixed(RBig::from(k) / RBig::from(self.n)));
        let split = |_: usize, polynomial: &Univariate<Value>| Ok(vec![(polynomial.clone(), 1)]);
        let itself = |value: &Value| Ok(value.clone());
        Ok(decided(&task.analyse(rows, Arithmetic::Enclosed, &cosine, &split, &itself, &[])?))
    }
}

/// All of them, or the first that fails; `None` where one is not known and none fails.
fn all(conditions: impl Iterator<Item = Option<bool>>) -> Option<bool> {
    let mut known = Some(true);
    for condition in conditions {
        match condition {
            Some(false) => return Some(false),
            Some(true) => {}
            None => known = None,
        }
    }
    known
}

fn decided(analysis: &ExactAnalysis) -> Decided {
    let larger = |a: usize, b: usize| analysis.compare_moduli(a, b).map(|order| order == Ordering::Greater);
    let one = analysis.one.and_then(|one| {
        let simple = analysis.eigenvalues[one].algebraic.map(|count| count == 1);
        all(analysis.after_one().map(|(index, _)| larger(one, index)).chain([simple]))
    });
    let exact = analysis.arithmetic == Arithmetic::Exact;
    let Some(lambda) = analysis.lambda.filter(|_| analysis.one.is_some()) else {
        // enclosed numbers may only not have told it
        let not = if exact && analysis.one.is_some() { Some(false) } else { None };
        return [one, not, not];
    };
    // a second 1 of frequency 0 is one of the others
    let second = analysis.one.filter(|one| analysis.eigenvalues[*one].algebraic != Some(1));
    let others: Vec<usize> = analysis.after_subdominant().map(|(index, _)| index).chain(second).collect();
    let subdominant = all(others.iter().map(|index| larger(lambda, *index)));
    let at_most = |index: &usize| {
        let order: Option<Ordering> = analysis.against_square.get(*index).copied().flatten();
        order.map(|order| order != Ordering::Greater)
    };
    let bounded = all(others.iter().map(at_most).chain([subdominant]));
    [one, subdominant, bounded]
}
