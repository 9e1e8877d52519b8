//! From which valence on is the order of the eigenvalues proved, or C1 refuted by it, at once?

use super::range;
use super::tail::{self, TailProof};
use crate::analysis::Analyzer;
use crate::proof::outcome::Outcome;

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
