//! Between which numbers lies the joint spectral radius of a mask's transition matrices?
//!
//! From below by the fastest product found, from above by the norm of some steps or by an invariant polytope; each upper bound has a
//! witness that is checked before it is given out.

use super::polytope::{exactly, with_slack};
use super::products::{Largest, Leader, largest, leaders, product_of, size};
use super::rounding::{exact_root, root_above, root_below};
use super::symbol::{norm, one_more};
use super::transition::{Floats, floats, transitions};
use super::witness::Witness;
use crate::numbers::Trouble;
use crate::numbers::linear::{Matrix, null_space, shifted};
use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// Larger transition matrices are not looked at: norms alone give a bound.
pub const MAX_SIZE: usize = 24;
/// The most coefficients of a mask of several steps.
const MOST_COEFFICIENTS: usize = 3000;
/// The most steps whose norms are looked at.
const MOST_STEPS: usize = 12;
/// How far, relatively, q may be above the rate of the fastest product, and the most vertices for that.
const SLACKS: [(f64, usize); 5] = [(1e-8, 60), (1e-6, 100), (1e-4, 160), (1e-3, 300), (4e-3, 600)];

/// Bounds of the joint spectral radius.
#[derive(Clone, Debug)]
pub struct Radius {
    /// Not more than it.
    pub lower: RBig,
    /// Not less than it.
    pub upper: RBig,
    /// The radius itself, where lower and upper bound are proved to be one number.
    pub exact: Option<RBig>,
    /// The product that gives the lower bound, the first matrix to be applied first; empty where none was looked at.
    pub product: Vec<usize>,
    /// What shows the upper bound.
    pub witness: Witness,
}

/// The joint spectral radius of the transition matrices of a kernel, all factors taken out before; `order` is their number.
///
/// # Errors
/// When numbers pass a limit.
pub fn radius(kernel: &Mask, order: usize) -> Result<Radius, Trouble> {
    let by_norms = norms(kernel);
    let (upper, steps) = best(&by_norms).ok_or(Trouble::BeyondThisWorld("the mask has too many weights"))?;
    // the norm of L steps is at least the sum of all coefficients over a^L, which is a^(-order L)
    let arity = RBig::from(kernel.arity);
    let least = (0..order).fold(RBig::ONE, |power, _| power / &arity);
    let plain = Radius { lower: least, upper, exact: None, product: Vec::new(), witness: Witness::Norm { steps } };
    let matrices = transitions(kernel);
    if matrices.first().is_none_or(|matrix| matrix.len() > MAX_SIZE) {
        return Ok(plain);
    }
    let near: Vec<Floats> = matrices.iter().map(floats).collect();
    let leaders = leaders(&near);
    let Some(leader) = leaders.first() else { return Ok(plain) };
    let found = largest(&product_of(&leader.word, &matrices)?)?;
    let lower = root_below(&found.lower, leader.word.len()).unwrap_or(RBig::ZERO).max(plain.lower.clone());
    let plain = Radius { lower, product: leader.word.clone(), ..plain };
    if let Some(exact) = exact(kernel, &matrices, &leaders, &found, &by_norms) {
        return Ok(exact);
    }
    let directions: Vec<Vec<f64>> = leaders.iter().flat_map(|leader| leader.directions.clone()).collect();
    for (slack, most) in SLACKS {
        let Some((q, polytope)) = with_slack(&matrices, &directions, leader.rate, slack, most) else {
            continue;
        };
        let witness = Witness::Polytope(polytope);
        if q < plain.upper && witness.shows(kernel, &q) {
            return Ok(Radius { upper: q, witness, ..plain });
        }
    }
    Ok(plain)
}

/// The norms of 1, 2, ... steps.
fn norms(kernel: &Mask) -> Vec<RBig> {
    let (mut all, mut spacing, mut found) = (vec![RBig::ONE], 1, Vec::new());
    loop {
        all = one_more(&all, kernel);
        spacing *= kernel.arity as usize;
        let large = all.len() > MOST_COEFFICIENTS || found.len() == MOST_STEPS;
        if all.is_empty() || (!found.is_empty() && large) {
            return found;
        }
        found.push(norm(&all, spacing));
    }
}

/// The best bound that norms give, with the number of steps.
fn best(norms: &[RBig]) -> Option<(RBig, usize)> {
    let bound = |(norm, steps): (&RBig, usize)| Some((root_above(norm, steps)?, steps));
    norms.iter().zip(1..).filter_map(bound).min_by(|x, y| x.0.cmp(&y.0))
}

/// The radius as the rate of a product, where that is rational and either a norm or a polytope shows it.
fn exact(
    kernel: &Mask,
    matrices: &[Matrix<RBig>],
    leaders: &[Leader],
    found: &Largest,
    norms: &[RBig],
) -> Option<Radius> {
    let leader = leaders.first()?;
    let eigenvalue = found.rational.as_ref()?;
    let q = exact_root(&size(eigenvalue), leader.word.len())?;
    let (word, done) = (leader.word.clone(), |witness: Witness, product| Radius {
        lower: q.clone(),
        upper: q.clone(),
        exact: Some(q.clone()),
        product,
        witness,
    });
    let mut power = RBig::ONE;
    for (norm, steps) in norms.iter().zip(1..) {
        power *= &q;
        if *norm <= power {
            return Some(done(Witness::Norm { steps }, word));
        }
    }
    if q.is_zero() {
        return None;
    }
    let mut directions = Vec::new();
    for other in leaders {
        let product = product_of(&other.word, matrices).ok()?;
        let rate = largest(&product).ok()?.rational?;
        if exact_root(&size(&rate), other.word.len())? == q {
            directions.push(scaled_to_one(null_space(&shifted(&product, &rate).ok()?).ok()?.first()?)?);
        }
    }
    let witness = Witness::Polytope(exactly(matrices, &directions, &q)?);
    witness.shows(kernel, &q).then(|| done(witness, word))
}

fn scaled_to_one(x: &[RBig]) -> Option<Vec<RBig>> {
    let largest = x.iter().map(size).max().filter(|largest| !largest.is_zero())?;
    Some(x.iter().map(|value| value / &largest).collect())
}
