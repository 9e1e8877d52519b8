//! Which two eigenvalues carry the tangents of a vertex on a crease?
//!
//! Those that grow fastest after the 1 of the constants: in order of modulus, and of one modulus by the size s of the Jordan
//! block, since lambda with a block grows like m^(s-1) lambda^m. Where floating numbers can't tell whether eigenvalues are equal,
//! exact ones are asked; where there are none, the question stays open and is said so.

use super::super::spectrum::{Eigenvalue, NEAR};
use super::masks::Stages;
use crate::mesh::FanKind;
use std::cmp::Reverse;

/// A real positive eigenvalue that grows along one vector.
#[derive(Clone, Copy)]
pub(super) struct Lead {
    pub(super) eigenvalue: Eigenvalue,
    /// The size of its Jordan block.
    pub(super) jordan: usize,
    /// Whether the block's next vector grows faster than everything but the two leading vectors.
    pub(super) next_follows: bool,
}

impl Stages<'_> {
    /// The 1 of the constants, where it is alone and larger than all else.
    pub(super) fn dominant_one(&self) -> Result<Eigenvalue, String> {
        let one = self.spectrum.one().ok_or("there is no eigenvalue 1")?;
        let next = self.spectrum.after_one().next().map_or(0.0, Eigenvalue::modulus);
        if (one.modulus() - 1.0).abs() > NEAR {
            return Err("1 is not an eigenvalue".to_string());
        }
        if !one.is_isolated() || next >= 1.0 - NEAR {
            return Err(format!("1 is not larger than all that follows, {}", short(next)));
        }
        Ok(one)
    }

    /// The eigenvalues after 1 down to the modulus of the second, one for each cluster.
    pub(super) fn contenders(&self) -> Vec<Eigenvalue> {
        let one = self.spectrum.one();
        let rest = self.spectrum.distinct().into_iter().filter(|e| Some(*e) != one);
        let rest: Vec<Eigenvalue> = rest.collect();
        let least = rest.get(1).map_or(0.0, Eigenvalue::modulus) - NEAR;
        rest.into_iter().take_while(|e| e.modulus() >= least).collect()
    }

    /// The two that grow fastest of the eigenvalues after 1, in that order.
    pub(super) fn leading_two(&self) -> Result<[Lead; 2], String> {
        let contenders = self.contenders();
        let mut leads = contenders.iter().map(|e| self.lead(e)).collect::<Result<Vec<Lead>, String>>()?;
        let same_level = |a: &Lead, b: &Lead| (a.eigenvalue.modulus() - b.eigenvalue.modulus()).abs() <= NEAR;
        // the second level, or the only one, in order of growth
        let start = usize::from(leads.len() > 1 && !same_level(&leads[0], &leads[1]));
        leads[start..].sort_by_key(|lead| Reverse(lead.jordan));
        let [first, second, others @ ..] = &leads[..] else {
            return Err("no tangent plane: there are no two eigenvalues after 1".to_string());
        };
        let known_level =
            |other: &Lead| self.exact.is_some_and(|exact| exact.are_level(&leads[start].eigenvalue, &other.eigenvalue));
        let blocks = leads[start..].iter().any(|lead| lead.jordan > 1);
        if blocks && !leads[start + 1..].iter().all(known_level) {
            return Err(format!("undecided: eigenvalues are approximately equal at {}", in_words(&second.eigenvalue)));
        }
        if start == 1 && first.jordan > 1 {
            return Err(format!("no tangent plane found: {} has a Jordan block", in_words(&first.eigenvalue)));
        }
        match others.first() {
            Some(third) if third.jordan == second.jordan => Err(self.why_third_is_level(first, second)),
            third => {
                let slower = third.is_none_or(|third| third.jordan + 1 < second.jordan);
                Ok([*first, Lead { next_follows: start == 1 && slower, ..*second }])
            }
        }
    }

    /// An eigenvalue, or cluster, as one that grows along one vector.
    fn lead(&self, e: &Eigenvalue) -> Result<Lead, String> {
        let value = in_words(e);
        if e.real().is_none_or(|value| value <= NEAR) {
            return Err(format!("no tangent plane: {value} is not real and positive"));
        }
        if e.is_isolated() {
            return Ok(Lead { eigenvalue: *e, jordan: 1, next_follows: false });
        }
        let count = e.cluster;
        match self.exact.and_then(|exact| exact.structure_at(e)) {
            None => Err(format!(
                "undecided: {count} eigenvalues are approximately equal at {value} (a Jordan block or not)"
            )),
            Some(None) => Err(format!("undecided: {count} eigenvalues at {value} are too near each other for f64")),
            Some(Some(known)) if known.geometric == 1 => {
                Ok(Lead { eigenvalue: *e, jordan: known.largest, next_follows: false })
            }
            Some(Some(known)) => {
                Err(format!("no tangent plane found: {value} has {} eigenvectors of one parity", known.geometric))
            }
        }
    }

    /// Three eigenvalues where two are needed: at a corner with many faces, a mode above those of the two boundary edges.
    fn why_third_is_level(&self, first: &Lead, second: &Lead) -> String {
        let (mode, edges) = (in_words(&first.eigenvalue), in_words(&second.eigenvalue));
        let own =
            self.along_the_boundary().is_some_and(|own| (own.modulus() - second.eigenvalue.modulus()).abs() <= NEAR);
        if own && matches!(self.fan().kind(), FanKind::Corner { .. }) {
            return format!("no tangent plane: the mode {mode} is above the {edges} of each of the two boundary edges");
        }
        format!("no tangent plane found: the second and the third eigenvalue after 1 are both {edges}, approximately")
    }

    /// The largest eigenvalue after 1 that belongs to the boundary's own points.
    pub(super) fn along_the_boundary(&self) -> Option<Eigenvalue> {
        let first = self.local.index(self.ring()[0])?;
        let own = |e: &&Eigenvalue| self.cores.cores[e.core].iter().any(|node| node.point() == first);
        self.spectrum.after_one().find(own).copied()
    }
}

/// A number in a sentence.
pub(super) fn short(value: f64) -> String {
    let text = format!("{value:.8}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

pub(super) fn in_words(e: &Eigenvalue) -> String {
    match e.real() {
        Some(value) => short(value),
        None => {
            format!("{} {} {}i", short(e.value.re), if e.value.im < 0.0 { '-' } else { '+' }, short(e.value.im.abs()))
        }
    }
}
