//! Are the characteristic maps of a valence, or of all from one on, proved to be regular and injective?
//!
//! For every valence at once in exact arithmetic ([`super::map`]), or else by enclosed derivatives ([`super::derivative`]).

use super::derivative::{DerivativeProof, Engine};
use super::map::{self, MapProof};
use super::outcome::Outcome;
use crate::analysis::Analyzer;
use crate::analysis::exact::{ExactAnalysis, Value};
use crate::refine::Obstacle;
use dashu_ratio::RBig;
use std::cell::OnceCell;

/// What is proved of a scheme's characteristic maps.
pub struct Maps<'p, 's> {
    analyzer: &'p Analyzer<'s>,
    every: Outcome<MapProof>,
    engine: OnceCell<Result<Engine, String>>,
}

impl<'p, 's> Maps<'p, 's> {
    /// Tries to prove the maps of all valences exactly.
    pub fn of(analyzer: &'p Analyzer<'s>) -> Maps<'p, 's> {
        Maps { analyzer, every: map::prove(analyzer), engine: OnceCell::new() }
    }

    /// What was proved for all valences exactly.
    pub fn every(&self) -> &Outcome<MapProof> {
        &self.every
    }

    /// Whether the map of a valence is regular and injective, and how that is known, in words. `exact` tells which eigenvalue is lambda.
    pub fn at(&self, n: usize, exact: Option<&ExactAnalysis>) -> Outcome<String> {
        let Some(exact) = exact else { return Outcome::stuck("no eigenvalue has an error bound at this valence") };
        first_of([
            &|| match &self.every {
                Outcome::Proved(proof) if !proof.valences.hold(n) => {
                    Outcome::stuck(format!("the map is proved for {} only", proof.valences))
                }
                Outcome::Proved(proof) if !is_of_lambda(exact, &|value| proof.range.may_be_lambda(n, value)) => {
                    Outcome::stuck("that the map proved is that of lambda is not seen")
                }
                every => every.clone().map(|proof| proof.to_string()),
            },
            &|| self.by_engine(|engine| engine.at(n, exact)).map(|proof| proof.to_string()),
        ])
    }

    /// Whether the maps of all valences from `first` on are, or from a later one on: that valence, and how it is known. They belong to the
    /// largest real root of [`crate::analysis::exact::formulas::AllValences::subdominant`].
    pub fn from(&self, first: usize) -> Outcome<(usize, String)> {
        first_of([
            &|| one_by_one(self.every.clone().map(|proof| (proof.valences.first().max(first), proof.to_string()))),
            &|| {
                one_by_one(
                    self.by_engine(|engine| engine.from(self.analyzer, first)).map(|proof| (first, proof.to_string())),
                )
            },
        ])
    }

    fn by_engine(
        &self,
        attempt: impl Fn(&Engine) -> Result<Outcome<DerivativeProof>, Obstacle>,
    ) -> Outcome<DerivativeProof> {
        let made = || Engine::of(self.analyzer).unwrap_or_else(|obstacle| Err(obstacle.to_string()));
        match self.engine.get_or_init(made) {
            Ok(engine) => attempt(engine).unwrap_or_else(|obstacle| Outcome::stuck(obstacle.to_string())),
            Err(why) => Outcome::stuck(why.clone()),
        }
    }
}

/// What refutes the map of one valence decides nothing for all others.
fn one_by_one<P>(outcome: Outcome<P>) -> Outcome<P> {
    match outcome {
        Outcome::Refuted { witness } => Outcome::stuck(witness),
        other => other,
    }
}

/// The first way that decides; else what each of them got stuck at.
fn first_of<P>(ways: [&dyn Fn() -> Outcome<P>; 2]) -> Outcome<P> {
    let mut stuck: Vec<String> = Vec::new();
    for way in ways {
        match way() {
            Outcome::Undecided { at } if stuck.contains(&at) => {}
            Outcome::Undecided { at } => stuck.push(at),
            decided => return decided,
        }
    }
    Outcome::stuck(stuck.join("; "))
}

/// Whether the eigenvalue of a proof is lambda: it is one of frequency 1, and no other there can have its value.
fn is_of_lambda(exact: &ExactAnalysis, may_be: &dyn Fn(&Value) -> bool) -> bool {
    let own = |index: &usize| exact.eigenvalues[*index].frequency == 1;
    let may_be = |index: &usize| {
        let e = &exact.eigenvalues[*index];
        e.im.contains(&RBig::ZERO) && may_be(&e.re)
    };
    let found: Vec<usize> = (0..exact.eigenvalues.len()).filter(|index| own(index) && may_be(index)).collect();
    exact.lambda.is_some_and(|lambda| found == [lambda])
}
