//! What do proofs say of C1 at a valence?
//!
//! Reif's conditions (1995) on the characteristic map by [`super::maps`], and what excludes C1 by [`super::spectrum::refutation`].

use super::maps::Maps;
use super::outcome::Outcome;
use super::spectrum::refutation::{against_c1, is_effective};
use crate::analysis::Analyzer;
use crate::analysis::exact::ExactAnalysis;

/// What is proved of a scheme, whatever the valence.
#[derive(Clone, Debug)]
pub struct Proofs {
    maps: Maps,
    effective: bool,
}

/// What proofs say at a valence.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Whether the characteristic map is regular and injective, and how that is known.
    pub map: Outcome<String>,
    /// Why limits are not C1, where the spectrum excludes it.
    pub against_c1: Option<String>,
}

impl Proofs {
    /// Tries what can be proved at once.
    pub fn of(analyzer: &Analyzer) -> Proofs {
        Proofs { maps: Maps::of(analyzer), effective: is_effective(analyzer) }
    }

    /// What is proved at a valence, whose exact analysis this is.
    pub fn at(&self, n: usize, exact: Option<&ExactAnalysis>) -> Found {
        let against_c1 = exact.and_then(|exact| against_c1(exact, n, self.effective));
        Found { map: self.maps.at(n, exact), against_c1 }
    }
}
