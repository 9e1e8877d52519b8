//! Is the map of every valence regular and injective, at once?
//!
//! On boxes of c that cover all from one on ([`crate::proof::family`]). A box on which cells are not decided is halved. Valences that the
//! forms leave out are looked at one by one.

use super::sweep::Swept;
use super::{DerivativeProof, Engine, NO_RING};
use crate::analysis::Analyzer;
use crate::numbers::Interval;
use crate::proof::family::taylor::Taylor;
use crate::proof::family::{Family, Open};
use crate::proof::outcome::{Outcome, Valences};
use crate::refine::Obstacle;

/// How often cells are refined on one box, at most.
const DEPTH: usize = 9;

/// The number of cells on a box: few on wide ones, whose halves are decided with less.
fn most_cells(radius: f64) -> usize {
    (500.0 / radius).clamp(1_000.0, 20_000.0) as usize
}

/// The most cells on all boxes.
const MOST_CELLS: usize = 30_000;

/// The largest valence that is looked at by itself where a box shows a fold, if all from a smaller one on are asked for.
const MOST_LOOKED_AT: f64 = 32.0;

impl Engine {
    /// The maps of every valence from one on.
    ///
    /// # Errors
    /// When a weight has no value, or a limit of size is passed.
    pub fn from(&self, analyzer: &Analyzer, first: usize) -> Result<Outcome<DerivativeProof>, Obstacle> {
        let first = first.max(3);
        let family = match Family::of(analyzer, &self.scheme)? {
            Ok(family) => family,
            Err(why) => return Ok(Outcome::stuck(why)),
        };
        let Some(scale) = self.scale(None)? else { return Ok(Outcome::stuck(NO_RING)) };
        let mut proof = self.proof(Valences::From(first), scale);
        let from = family.from().max(first);
        for n in (first..from).chain(family.except().filter(|n| *n >= from)) {
            match self.analysed(analyzer, n)? {
                Outcome::Proved(own) => proof.take(own),
                Outcome::Undecided { at } => return Ok(Outcome::stuck(format!("n = {n}: {at}"))),
                refuted => return Ok(refuted),
            }
        }
        let mut left = MOST_CELLS;
        let cover = family.cover(from, |net| {
            let split = |value: &Taylor| value.terms().to_vec();
            let limits = (DEPTH, most_cells(net.c.terms()[1].magnitude()));
            match self.swept(net, scale, split, Taylor::powers(), limits)? {
                Swept::Positive { cells, depth } => {
                    (proof.cells, proof.depth) = (proof.cells + cells, proof.depth.max(depth));
                    Ok(())
                }
                Swept::Fold { .. } => Err(Open { why: "the Jacobian is negative".to_string(), for_good: true }),
                Swept::Open { what, cells, .. } => {
                    left = left.saturating_sub(cells);
                    Err(Open { why: what.to_string(), for_good: left == 0 })
                }
            }
        });
        match cover {
            Ok(boxes) => {
                proof.boxes.extend(boxes);
                Ok(Outcome::Proved(proof))
            }
            Err((c, why)) => {
                // a fold on a box refutes nothing until it is seen at one valence
                let seen = valence_near(c).map(|n| self.analysed(analyzer, n.max(first))).transpose()?;
                let refuted = seen.filter(|seen| matches!(seen, Outcome::Refuted { .. }));
                Ok(refuted.unwrap_or(Outcome::stuck(format!("{why}, for c from {} to {}", c.lo(), c.hi()))))
            }
        }
    }
}

impl DerivativeProof {
    /// Takes in a proof at one valence.
    fn take(&mut self, own: DerivativeProof) {
        (self.cells, self.depth) = (self.cells + own.cells, self.depth.max(own.depth));
        self.scale = self.scale.max(own.scale);
        self.boxes.extend(own.boxes);
    }
}

/// A valence whose c is near the low end of an interval, or a smaller one that is looked at faster: a guess, which is then looked
/// at by itself.
fn valence_near(c: Interval) -> Option<usize> {
    let n = std::f64::consts::TAU / libm::acos(c.lo());
    (n >= 3.0).then(|| n.min(MOST_LOOKED_AT).ceil() as usize)
}
