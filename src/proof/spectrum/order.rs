//! At which valences is the order of the eigenvalues proved, or C1 refuted by it?
//!
//! Every n >= 3 is one of: a single one, decided by the exact analysis, or one of all from some n on, decided at once.

use super::range;
use super::refutation::{against_c1, is_effective};
use super::tail::{self, TailProof};
use crate::analysis::Analyzer;
use crate::analysis::exact::ExactAnalysis;
use crate::proof::outcome::{Outcome, Valences};
use std::cmp::Ordering;

/// How the order was proved.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// By the exact analysis of one valence.
    Single,
    /// At once.
    AtOnce(Box<TailProof>),
}

/// What is known of the order at every n >= 3. Refuted is C1, for generic data, where the order excludes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Orders {
    /// Single valences first; then all from one on. The first entry that has a valence is about it.
    pub parts: Vec<(Valences, Outcome<Order>)>,
}

impl Orders {
    /// What is known at a valence.
    pub fn at(&self, n: usize) -> Outcome<&Order> {
        match self.parts.iter().find(|(valences, _)| valences.hold(n)) {
            Some((_, Outcome::Proved(order))) => Outcome::Proved(order),
            Some((_, Outcome::Refuted { witness })) => Outcome::Refuted { witness: witness.clone() },
            Some((_, Outcome::Undecided { at })) => Outcome::stuck(at.clone()),
            None => Outcome::stuck(format!("n = {n} is not looked at")),
        }
    }

    /// Whether the order is proved for every n >= 3.
    pub fn hold_everywhere(&self) -> bool {
        self.parts.iter().all(|(_, outcome)| matches!(outcome, Outcome::Proved(_)))
    }

    /// The proof for all valences from one on, if there is one.
    pub fn tail(&self) -> Option<&TailProof> {
        self.parts.iter().find_map(|(_, outcome)| match outcome {
            Outcome::Proved(Order::AtOnce(tail)) => Some(tail.as_ref()),
            _ => None,
        })
    }
}

/// What is known of all valences from one on at once: the first of them, one that is left out, and the answer; from n = 3 on
/// where there is none.
pub fn at_once(analyzer: &Analyzer, effective: bool) -> (usize, Option<usize>, Outcome<TailProof>) {
    let forms = match analyzer.forms() {
        Ok(forms) => forms,
        Err(why) => return (3, None, Outcome::stuck(why)),
    };
    let stuck = match tail::prove(forms) {
        Ok(Ok(tail)) => return (tail.from, tail.except, Outcome::Proved(tail)),
        Ok(Err(why)) => why,
        Err(trouble) => trouble.to_string(),
    };
    match range::against_c1(forms) {
        Ok(Some((from, witness))) if effective => (from, None, Outcome::Refuted { witness }),
        _ => (3, None, Outcome::stuck(stuck)),
    }
}

/// Decides what can be decided. Where nothing is known for all valences from one on, no single ones are looked at.
pub fn prove(analyzer: &Analyzer) -> Orders {
    let (from, except, at_once) = at_once(analyzer, is_effective(analyzer));
    let single = if matches!(at_once, Outcome::Undecided { .. }) { 3..3 } else { 3..from };
    let mut parts: Vec<_> = single.chain(except).map(|n| (Valences::At(n), at(analyzer, n))).collect();
    parts.push((Valences::From(from), at_once.map(|tail| Order::AtOnce(Box::new(tail)))));
    Orders { parts }
}

/// What the exact analysis of a valence says.
fn at(analyzer: &Analyzer, n: usize) -> Outcome<Order> {
    let exact = match analyzer.at(n).map(|analysis| analysis.exact) {
        Ok(Ok(exact)) => exact,
        Ok(Err(why)) => return Outcome::stuck(why),
        Err(obstacle) => return Outcome::stuck(obstacle.to_string()),
    };
    match (against_c1(&exact, n, is_effective(analyzer)), misses(&exact)) {
        (Some(witness), _) => Outcome::Refuted { witness },
        (None, None) => Outcome::Proved(Order::Single),
        (None, Some(why)) => Outcome::stuck(why),
    }
}

/// What the order at a valence misses, if anything.
pub fn misses(exact: &ExactAnalysis) -> Option<&'static str> {
    let leads = |first: usize, mut others: Box<dyn Iterator<Item = usize> + '_>| {
        others.all(|other| exact.compare_moduli(first, other) == Some(Ordering::Greater))
    };
    let Some(one) = exact.one.filter(|one| exact.eigenvalues[*one].algebraic == Some(1)) else {
        return Some("1 is not seen to be simple");
    };
    if !leads(one, Box::new(exact.after_one().map(|(index, _)| index))) {
        return Some("1 is not seen to be larger than all others");
    }
    let Some(lambda) = exact.lambda else {
        return Some("no real, positive, simple eigenvalue of frequency 1 is seen to lead after 1");
    };
    let others = exact.after_one().map(|(index, _)| index).filter(|index| *index != lambda);
    (!leads(lambda, Box::new(others))).then_some("lambda is not seen to be larger than all others after 1")
}
