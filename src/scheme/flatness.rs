//! How far are the points around a vertex on a boundary moved towards its tangent plane?
//!
//! After a step the points x around a vertex become (1 - s) x + s (a_0 x_0 + a_1 x_1 + a_2 x_2) (Biermann, Levin and Zorin
//! 2000, flatness). A boundary file tells s for each kind of vertex; the vectors are found by the analysis
//! ([`crate::analysis::boundary::flatness`]).

use super::evaluate::Place;
use super::{Placed, RuleBook};
use crate::fault::Fault;

impl RuleBook {
    /// The formula of s at a kind of vertex (crease, corner or dart) with so many faces, with the file that tells it and the
    /// place that it is evaluated at; `None` where no file tells any.
    ///
    /// # Errors
    /// When no case holds, or a condition has no value.
    pub fn flatness(&self, kind: &str, faces: usize) -> Result<Option<(&RuleBook, &Placed)>, Fault> {
        match (self.flatness.get(kind), &self.like) {
            (Some(cases), _) => {
                let place = Place::<f64>::at(Some(count_at(kind)), faces as i64);
                Ok(Some((self, self.select(cases, &place)?)))
            }
            (None, Some(like)) => like.flatness(kind, faces),
            (None, None) => Ok(None),
        }
    }

    /// Whether a file tells any flatness.
    pub fn tells_flatness(&self) -> bool {
        !self.flatness.is_empty() || self.like.as_ref().is_some_and(|like| like.tells_flatness())
    }

    /// Each s is from 0 to 1 at the counts asked for.
    pub(super) fn flatness_faults(&self, counts: &[usize]) -> Vec<Fault> {
        let least = |kind: &str| if kind == "dart" { 3 } else { 1 };
        let wrong = |(kind, faces): (&String, usize)| {
            let (book, placed) = self.flatness(kind, faces).transpose()?.ok()?;
            let place = Place::<f64>::at(Some(count_at(kind)), faces as i64);
            match book.evaluate(placed, &place) {
                Ok(s) if (0.0..=1.0).contains(&s) => None,
                Ok(s) => {
                    let message = format!("s = {s} at {} = {faces} is not from 0 to 1", count_at(kind));
                    Some(Fault::at(placed.span.clone(), message, format!("the flatness at a {kind}")))
                }
                Err(fault) => Some(fault),
            }
        };
        let missing = |(kind, faces): (&String, usize)| self.flatness(kind, faces).err();
        let asked = self.flatness.keys().flat_map(|kind| counts.iter().map(move |faces| (kind, *faces)));
        let asked: Vec<(&String, usize)> = asked.filter(|(kind, faces)| *faces >= least(kind)).collect();
        let faults = asked.iter().flat_map(|at| [missing(*at), wrong(*at)]);
        faults.flatten().collect()
    }
}

/// What the number of faces is called in formulas.
pub(crate) fn count_at(kind: &str) -> &'static str {
    if kind == "dart" { "n" } else { "k" }
}
