//! Where is the limit point, and what are its tangents, exactly?
//!
//! A left vector u of a block with u B = lambda u, by elimination in the field (or in the field with lambda adjoined), put into
//! its equation before it is given out. The weight of a tangent mask at (sector s, orbit t) is
//!
//! > own_t cos(2 pi s/n) + next_t cos(2 pi (s+1)/n)
//!
//! in the cosine form, and the same with sines in the sine form: points on the spokes have `own` alone, points half-way
//! between two spokes have both alike.

use super::block::{Block, Powers, PowersOfW, Unknown, Wave};
use super::rows::Rows;
use crate::numbers::linear::{Matrix, null_space, part, shifted, transposed};
use crate::numbers::{Field, Trouble};
use std::collections::BTreeMap;

/// The weights of a mask.
#[derive(Clone, Debug)]
pub struct Mask<F> {
    /// The weight of the centre, where that is a point; zero in tangent masks.
    pub centre: Option<F>,
    /// For each orbit `own` and `next`; a limit mask has `own` alone, the weight of each point of the orbit.
    pub orbits: Vec<(F, F)>,
}

const NOT_ONE: Trouble = Trouble::BeyondThisWorld("the eigenvalue has several left vectors");

/// The left vector of an eigenvalue that has one, on all unknowns; it lives on those `below` the cores that have the eigenvalue.
pub(in crate::analysis) fn left_vector<F: Field>(
    matrix: &Matrix<F>,
    below: &[usize],
    lambda: &F,
) -> Result<Vec<F>, Trouble> {
    let own = transposed(&shifted(&part(matrix, below), lambda)?);
    let [vector] = &null_space(&own)?[..] else { return Err(NOT_ONE) };
    let mut whole = vec![F::whole(0); matrix.len()];
    below.iter().zip(vector).for_each(|(index, value)| whole[*index] = value.clone());
    check(matrix, &whole, lambda)?;
    Ok(whole)
}

/// u B = lambda u, entry by entry.
fn check<F: Field>(matrix: &Matrix<F>, u: &[F], lambda: &F) -> Result<(), Trouble> {
    for column in 0..matrix.len() {
        let mut sum = lambda.times(&u[column])?.negated();
        for (row, value) in matrix.iter().zip(u) {
            if !value.is_certainly_zero() && !row[column].is_certainly_zero() {
                sum = sum.plus(&value.times(&row[column])?)?;
            }
        }
        if F::EXACT && !sum.is_certainly_zero() {
            return Err(Trouble::BeyondThisWorld("a left vector doesn't satisfy its equation"));
        }
    }
    Ok(())
}

/// The limit mask from the block of frequency 0: the left vector of 1, its weights summing to 1. `core` are the unknowns of the core
/// that has the eigenvalue 1, and n is the number of points of an orbit.
///
/// # Errors
/// When 1 has several left vectors, or a limit of size is passed.
pub fn limit_mask<F: Field>(rows: &Rows<F>, block: &Block<F>, core: &[usize], n: &F) -> Result<Mask<F>, Trouble> {
    let vector = left_vector(&block.matrix, &block.below(core), &F::whole(1))?;
    let sum = vector.iter().try_fold(F::whole(0), |sum, value| sum.plus(value))?;
    let mut mask = Mask { centre: None, orbits: vec![(F::whole(0), F::whole(0)); rows.orbits.len()] };
    for (unknown, value) in block.unknowns.iter().zip(&vector) {
        let share = value.over(&sum)?;
        match unknown {
            Unknown::Centre => mask.centre = Some(share),
            Unknown::Value(t) => mask.orbits[*t].0 = share.over(n)?,
            _ => {}
        }
    }
    Ok(mask)
}

/// The tangent masks from the block of frequency 1 and the subdominant eigenvalue, scaled so that the first orbit with a weight has
/// own = 1 and next = 0. `lift` brings entries of the block into the field of lambda.
///
/// # Errors
/// When lambda has several left vectors, that scaling is not possible, or a limit of size is passed.
pub fn tangent_mask<F: Field, G: Field>(
    rows: &Rows<F>,
    block: &Block<F>,
    core: &[usize],
    lambda: &G,
    lift: impl Fn(&F) -> G,
) -> Result<Mask<G>, Trouble> {
    let Wave::Cosine(x) = &block.wave else { return Err(NOT_ONE) };
    let matrix: Matrix<G> = block.matrix.iter().map(|row| row.iter().map(&lift).collect()).collect();
    let vector = left_vector(&matrix, &block.below(core), lambda)?;
    let x = lift(x);
    let mut powers = PowersOfW::new(&x);
    let zero = || G::whole(0);
    let mut orbits = vec![(zero(), zero()); rows.orbits.len()];
    for (index, unknown) in block.unknowns.iter().enumerate() {
        for (orbit, sum) in amplitudes(rows, &x, &vector, index, *unknown)? {
            orbits[orbit] = powers.reduced(&sum)?;
        }
    }
    let empty = |(own, next): &&(G, G)| own.is_certainly_zero() && next.is_certainly_zero();
    let first = orbits.iter().find(|pair| !empty(pair)).cloned();
    let Some((scale, next)) = first else { return Err(NOT_ONE) };
    if G::EXACT && !next.is_certainly_zero() {
        return Err(Trouble::BeyondThisWorld("the first weight of the tangent mask is not on a spoke"));
    }
    for (own, next) in &mut orbits {
        (*own, *next) = (own.over(&scale)?, next.over(&scale)?);
    }
    Ok(Mask { centre: rows.centre.as_ref().map(|_| zero()), orbits })
}

/// What multiplies y_t in the functional, as powers of 1/w: the unknowns' equations (see [`super::block`]) solved for them.
fn amplitudes<G: Field>(
    rows: &Rows<impl Field>,
    x: &G,
    vector: &[G],
    index: usize,
    unknown: Unknown,
) -> Result<Vec<(usize, Powers<G>)>, Trouble> {
    let (one, two) = (G::whole(1), G::whole(2));
    match unknown {
        Unknown::Own(t) => {
            let (shift, value) = (rows.mirrors[t].1, &vector[index]);
            let start = shift.div_euclid(2);
            if shift % 2 == 0 {
                return Ok(vec![(t, BTreeMap::from([(start, value.clone())]))]);
            }
            // 1/(1 + w) = (1 + 1/w)/(2 + 2 x)
            let half = value.over(&two.times(&one.plus(x)?)?)?;
            Ok(vec![(t, BTreeMap::from([(start, half.clone()), (start + 1, half)]))])
        }
        Unknown::First(t, u) => {
            // (w - 1/w)^2 = 4 (x^2 - 1)
            let scale = one.over(&two.times(&two)?.times(&x.times(x)?.minus(&one)?)?)?;
            let (a, b) = (vector[index].times(&scale)?, vector[index + 1].times(&scale)?);
            let shift = rows.mirrors[t].1;
            let first = BTreeMap::from([(0, a.negated()), (2, a.clone()), (-1, b.clone()), (1, b.negated())]);
            let second = [(-2, a.clone()), (0, a.negated()), (-1, b.negated()), (1, b)];
            let second = second.map(|(exponent, value)| (exponent + shift, value));
            Ok(vec![(t, first), (u, BTreeMap::from(second))])
        }
        _ => Ok(vec![]),
    }
}
