//! At which valences are limit surfaces C1?
//!
//! The first ones are judged one by one ([`super::verdicts`]), the others by one proof for all of them ([`crate::proof::c1::Proofs::tail`]).

use super::{C1, Decision, Verdict, says, verdicts};
use crate::proof::c1::Proofs;
use crate::proof::outcome::Outcome;
use crate::refine::Obstacle;
use crate::scheme::RuleSum;
use serde::Serialize;

/// Valences one after the other with the same answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stretch {
    /// The first.
    pub from: usize,
    /// The last; null where every one from the first on is meant.
    pub to: Option<usize>,
    /// Whether limit surfaces are C1 there, for generic control points.
    pub verdict: Decision,
    /// Reasons.
    pub why: Vec<String>,
}

/// The answer for every valence, or for those asked for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EveryValence {
    /// The answer in a sentence: "proved for every n >= 3".
    pub statement: String,
    /// In order; for every valence without gaps, from n = 3 on.
    pub stretches: Vec<Stretch>,
}

/// So many valences are looked at one by one where no proof speaks of all from one on.
const LAST_SINGLE: usize = 12;

impl EveryValence {
    /// Decides every valence. `known` gives verdicts that were found already.
    pub fn of(proofs: &Proofs, sums: &[RuleSum], known: &dyn Fn(usize) -> Option<Vec<Verdict>>) -> EveryValence {
        let last = stretch_of(proofs, sums);
        let mut stretches = singles(proofs, sums, &(3..last.from).collect::<Vec<_>>(), known);
        stretches.push(last);
        EveryValence::told(stretches)
    }

    /// Decides these valences, one by one; where that leaves one open, by what is known of all from one on.
    pub fn only(proofs: &Proofs, sums: &[RuleSum], valences: &[usize]) -> EveryValence {
        let stretches = singles(proofs, sums, valences, &|_| None);
        if stretches.iter().all(|own| own.verdict != Decision::Undecided) {
            return EveryValence::told(stretches);
        }
        let (last, mut settled) = (stretch_of(proofs, sums), Vec::new());
        for n in valences.iter().copied() {
            let own = stretches.iter().find(|own| own.from <= n && own.to >= Some(n));
            let own = own.filter(|own| own.verdict != Decision::Undecided || !last.decides(n)).unwrap_or(&last);
            push(&mut settled, Stretch { from: n, to: Some(n), ..own.clone() });
        }
        EveryValence::told(settled)
    }

    /// Where C1 is not decided at a valence by itself, but is for all from one on, it is decided there, too.
    pub fn settle(&self, n: usize, verdicts: &mut [Verdict]) {
        let Some(last) = self.stretches.last().filter(|last| last.decides(n)) else { return };
        for own in verdicts.iter_mut().filter(|own| own.claim == C1 && own.verdict == Decision::Undecided) {
            own.verdict = last.verdict;
            own.evidence = says(last.verdict == Decision::Proved);
            own.why.clone_from(&last.why);
        }
    }

    fn told(stretches: Vec<Stretch>) -> EveryValence {
        EveryValence { statement: statement(&stretches), stretches }
    }

    /// Whether the answer is "proved" everywhere.
    pub fn is_proved(&self) -> bool {
        self.stretches.iter().all(|stretch| stretch.verdict == Decision::Proved)
    }
}

/// What is known of all valences from one on.
fn stretch_of(proofs: &Proofs, sums: &[RuleSum]) -> Stretch {
    let tail = proofs.tail(sums.iter().all(|sum| sum.identity));
    let (from, verdict, why) = match tail.c1 {
        Outcome::Proved(how) => (tail.from, Decision::Proved, how),
        Outcome::Refuted { witness } => (tail.from, Decision::Refuted, witness),
        Outcome::Undecided { at } => (LAST_SINGLE + 1, Decision::Undecided, at),
    };
    Stretch { from, to: None, verdict, why: vec![why] }
}

fn singles(
    proofs: &Proofs,
    sums: &[RuleSum],
    valences: &[usize],
    known: &dyn Fn(usize) -> Option<Vec<Verdict>>,
) -> Vec<Stretch> {
    let mut stretches: Vec<Stretch> = Vec::new();
    for n in valences.iter().copied() {
        let found = known(n).map_or_else(|| judged(proofs, sums, n), Ok);
        let (verdict, why) = match found.map(|own| own.into_iter().find(|own| own.claim == C1)) {
            Ok(Some(own)) => (own.verdict, own.why),
            Ok(None) => continue,
            Err(obstacle) => (Decision::Undecided, vec![format!("there is no analysis: {obstacle}")]),
        };
        push(&mut stretches, Stretch { from: n, to: Some(n), verdict, why });
    }
    stretches
}

fn judged(proofs: &Proofs, sums: &[RuleSum], n: usize) -> Result<Vec<Verdict>, Obstacle> {
    let analysis = proofs.analyzer.at(n)?;
    Ok(verdicts(&analysis, sums, &proofs.at(n, analysis.exact.as_ref().ok())))
}

/// Adds a valence to the last stretch, if it comes next and that says the same.
fn push(stretches: &mut Vec<Stretch>, own: Stretch) {
    match stretches.last_mut() {
        Some(last) if last.is_before(&own) && last.verdict == own.verdict && last.why == own.why => last.to = own.to,
        _ => stretches.push(own),
    }
}

impl Stretch {
    /// Its valences in words.
    pub fn valences(&self) -> String {
        match self.to {
            Some(to) if to == self.from => format!("n = {to}"),
            Some(to) => format!("n = {}..{to}", self.from),
            None => format!("every n >= {}", self.from),
        }
    }

    /// Whether it decides a valence among all from one on.
    fn decides(&self, n: usize) -> bool {
        self.to.is_none() && self.from <= n && self.verdict != Decision::Undecided
    }

    fn is_before(&self, next: &Stretch) -> bool {
        self.to.is_some_and(|to| to + 1 == next.from)
    }
}

fn statement(stretches: &[Stretch]) -> String {
    let told = [Decision::Proved, Decision::Refuted, Decision::Undecided].into_iter().filter_map(|verdict| {
        let own = joined(stretches.iter().filter(|stretch| stretch.verdict == verdict));
        let valences: Vec<String> = own.iter().map(Stretch::valences).collect();
        (!own.is_empty()).then(|| format!("{} for {}", verdict.word(), valences.join(" and ")))
    });
    told.collect::<Vec<_>>().join("; ")
}

/// Neighbours as one.
fn joined<'s>(stretches: impl Iterator<Item = &'s Stretch>) -> Vec<Stretch> {
    let mut joined: Vec<Stretch> = Vec::new();
    for stretch in stretches {
        match joined.last_mut() {
            Some(last) if last.is_before(stretch) => last.to = stretch.to,
            _ => joined.push(stretch.clone()),
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stretch(from: usize, to: Option<usize>, verdict: Decision, why: &str) -> Stretch {
        Stretch { from, to, verdict, why: vec![why.to_string()] }
    }

    #[test]
    fn statements_join_neighbours() {
        use Decision::{Proved, Refuted, Undecided};
        let say = |stretches: &[Stretch]| statement(stretches);
        assert_eq!(say(&[stretch(3, Some(4), Proved, "a"), stretch(5, None, Proved, "b")]), "proved for every n >= 3");
        let butterfly = [
            stretch(3, Some(3), Refuted, "a"),
            stretch(4, Some(7), Proved, "b"),
            stretch(8, Some(8), Refuted, "c"),
            stretch(9, None, Refuted, "d"),
        ];
        assert_eq!(say(&butterfly), "proved for n = 4..7; refuted for n = 3 and every n >= 8");
        let open = [stretch(3, Some(3), Proved, "a"), stretch(4, None, Undecided, "b")];
        assert_eq!(say(&open), "proved for n = 3; undecided for every n >= 4");
    }
}
