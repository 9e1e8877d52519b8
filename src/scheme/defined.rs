//! Have the weights of a scheme values at every valence?

use super::evaluate::Place;
use super::{Placed, RuleBook, Weights};
use crate::fault::Fault;
use crate::numbers::{Laurent, Total};

impl RuleBook {
    /// Whether the weights of all rules in the interior are seen to have values at every valence whose cases are those of `count`
    /// ([`Total`]).
    ///
    /// # Errors
    /// The first operation that may have none at some valence.
    pub fn is_defined_like(&self, count: i64) -> Result<(), Fault> {
        for rule in self.all_rules().filter(|rule| rule.kind.variable() != Some("k")) {
            let atom = |name: &str| Total(Laurent::atom(name));
            let place = Place { variable: rule.kind.variable(), count, value: atom("n"), index: atom("j") };
            for entry in &rule.entries {
                let weights: Vec<&Placed> = match self.select(&entry.weights, &place)? {
                    Weights::Each(placed) => vec![placed],
                    Weights::List(list, _) => list.iter().collect(),
                };
                weights.into_iter().try_for_each(|placed| self.evaluate(placed, &place).map(|_| ()))?;
            }
        }
        Ok(())
    }
}
