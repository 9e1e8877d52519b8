//! What do proofs say of C1, at a valence and at every valence from one on?
//!
//! Reif's conditions (1995): the order of the eigenvalues, the characteristic map ([`super::maps`]), and the regular part by its
//! symbol ([`crate::analysis::regular`]). What excludes C1 is told by [`super::spectrum::refutation`].

use super::map::MapProof;
use super::maps::Maps;
use super::outcome::Outcome;
use super::spectrum::order::at_once;
use super::spectrum::refutation::{against_c1, is_effective};
use crate::analysis::Analyzer;
use crate::analysis::exact::ExactAnalysis;
use crate::analysis::exact::formulas::GENERIC;

/// What is proved of a scheme, whatever the valence.
pub struct Proofs<'p, 's> {
    /// The scheme's analysis.
    pub analyzer: &'p Analyzer<'s>,
    maps: Maps<'p, 's>,
    effective: bool,
}

/// What is proved of C1 at every valence from one on.
#[derive(Clone, Debug, PartialEq)]
pub struct Tail {
    /// That valence.
    pub from: usize,
    /// Whether limit surfaces are C1 there, for generic control points, and how that is known.
    pub c1: Outcome<String>,
}

/// What proofs say at a valence.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Whether the characteristic map is regular and injective, and how that is known.
    pub map: Outcome<String>,
    /// Why limits are not C1, where the spectrum excludes it.
    pub against_c1: Option<String>,
}

impl<'p, 's> Proofs<'p, 's> {
    /// Tries what can be proved at once.
    pub fn of(analyzer: &'p Analyzer<'s>) -> Proofs<'p, 's> {
        Proofs { analyzer, maps: Maps::of(analyzer), effective: is_effective(analyzer) }
    }

    /// What is proved exactly of the characteristic maps of all valences at once.
    pub fn maps_of_all(&self) -> &Outcome<MapProof> {
        self.maps.every()
    }

    /// What is proved at a valence, whose exact analysis this is.
    pub fn at(&self, n: usize, exact: Option<&ExactAnalysis>) -> Found {
        let against_c1 = exact.and_then(|exact| against_c1(exact, n, self.effective));
        Found { map: self.maps.at(n, exact), against_c1 }
    }

    /// What is proved at every valence from one on. `affine` tells whether the weights of every rule sum to 1 at every valence.
    pub fn tail(&self, affine: bool) -> Tail {
        self.attempt(affine).unwrap_or_else(|at| Tail { from: 3, c1: Outcome::stuck(at) })
    }

    fn attempt(&self, affine: bool) -> Result<Tail, String> {
        let defined = self.analyzer.scheme().with_values().book.is_defined_like(GENERIC as i64);
        defined.map_err(|fault| format!("weights are not seen to have values at every n, {}", fault.label))?;
        let (from, except, order) = at_once(self.analyzer, self.effective);
        let clear = |from: usize| from.max(except.map_or(3, |n| n + 1));
        let tail = match order {
            Outcome::Proved(tail) => tail,
            Outcome::Refuted { witness } => return Ok(Tail { from: clear(from), c1: Outcome::Refuted { witness } }),
            Outcome::Undecided { at } => return Err(at),
        };
        if !affine {
            return Err("the weights are not shown to sum to 1".to_string());
        }
        if self.analyzer.regular()?.smoothness.is(1) != Some(true) {
            return Err("limits on regular meshes are not proved to be C1".to_string());
        }
        if self.analyzer.forms()?.subdominant.as_ref() != Some(&tail.polynomial) {
            return Err("the eigenvalue that leads is not seen to be that of the map".to_string());
        }
        match self.maps.from(tail.from) {
            Outcome::Proved((first, map)) => {
                let order = format!("the order of the eigenvalues is proved for every n >= {} at once", tail.from);
                let c1 = format!("every condition of Reif's theorem is proved: {order}, the characteristic map {map}");
                Ok(Tail { from: clear(first), c1: Outcome::Proved(c1) })
            }
            Outcome::Refuted { witness: at } | Outcome::Undecided { at } => Err(at),
        }
    }
}
