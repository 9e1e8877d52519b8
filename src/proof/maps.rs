//! Is the characteristic map of a valence proved to be regular and injective?
//!
//! By the first way that gets there: for every valence at once in exact arithmetic ([`super::map`]).

use super::map::{self, MapProof};
use super::outcome::Outcome;
use crate::analysis::Analyzer;
use crate::analysis::exact::ExactAnalysis;
use dashu_ratio::RBig;

/// What is proved of a scheme's characteristic maps.
#[derive(Clone, Debug)]
pub struct Maps {
    every: Outcome<MapProof>,
}

impl Maps {
    /// Tries to prove the maps of all valences.
    pub fn of(analyzer: &Analyzer) -> Maps {
        Maps { every: map::prove(analyzer) }
    }

    /// What was proved for all valences.
    pub fn every(&self) -> &Outcome<MapProof> {
        &self.every
    }

    /// Whether the map of a valence is regular and injective, and how that is known, in words. `exact` tells which eigenvalue is lambda.
    pub fn at(&self, n: usize, exact: Option<&ExactAnalysis>) -> Outcome<String> {
        match &self.every {
            Outcome::Proved(proof) if !proof.valences.hold(n) => {
                Outcome::stuck(format!("the map is proved for {} only", proof.valences))
            }
            Outcome::Proved(proof) if exact.is_some_and(|exact| is_of_lambda(proof, n, exact)) => {
                Outcome::Proved(format!(
                    "for {} at once, in exact arithmetic: {} rational functions of degree at most {} are positive",
                    proof.valences, proof.functions, proof.degree
                ))
            }
            Outcome::Proved(_) => Outcome::stuck("that the map proved is that of lambda is not seen"),
            Outcome::Refuted { witness } => Outcome::Refuted { witness: witness.clone() },
            Outcome::Undecided { at } => Outcome::stuck(at.clone()),
        }
    }
}

/// Whether the eigenvalue of the proof is lambda: it is one of frequency 1, and no other there can have its value.
fn is_of_lambda(proof: &MapProof, n: usize, exact: &ExactAnalysis) -> bool {
    let own = |index: &usize| exact.eigenvalues[*index].frequency == 1;
    let may_be = |index: &usize| {
        let e = &exact.eigenvalues[*index];
        e.im.contains(&RBig::ZERO) && proof.range.may_be_lambda(n, &e.re)
    };
    let found: Vec<usize> = (0..exact.eigenvalues.len()).filter(|index| own(index) && may_be(index)).collect();
    exact.lambda.is_some_and(|lambda| found == [lambda])
}
