//! Where is the curve at a marked point, what is its tangent, and what are its derivatives?
//!
//! The limit mask is the left eigenvector of 1, scaled to the sum 1; the mask of the k-th derivative that of a^{-k}, scaled so that
//! sum_j w_j (j - u)^k = k!, where u is the point's own index. The tangent mask belongs to the largest eigenvalue after 1, whatever it is:
//! the plain difference goes to 0 by this factor, its direction stays (Halstead, Kass and DeRose 1993).

use super::local::{Extent, LocalMatrix, Neighbourhood, at_end, neighbourhood};
use super::spectrum::{BITS, CurveEigenvalue, eigenvectors, enclosed_left, spectrum};
use crate::numbers::linear::transposed;
use crate::numbers::{Enclosure, Field, Trouble};
use crate::scheme::curve::{Ends, Halves, Mask};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// Masks of derivatives up to this order are looked for.
const MOST_DERIVATIVES: usize = 8;

/// A point that a scheme is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marked {
    /// The vertex p_0.
    Vertex,
    /// The middle of the edge from p_0 to p_1.
    MidEdge,
    /// The first end of an open curve.
    Start,
    /// Its last end, where it is not the mirror image of the first; indices are counted back from it.
    End,
}

impl Marked {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Marked::Vertex => "vertex",
            Marked::MidEdge => "mid-edge",
            Marked::Start => "start",
            Marked::End => "end",
        }
    }

    /// Its index among the points.
    pub fn position(self) -> RBig {
        if self == Marked::MidEdge { RBig::ONE / RBig::from(2) } else { RBig::ZERO }
    }
}

/// A weight of a mask.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexedWeight {
    /// The index of the point.
    pub index: i64,
    /// The nearest floating number.
    pub value: f64,
    /// The weight, where it is rational.
    pub exact: Option<RBig>,
}

/// A mask, or why there is none.
pub type MaskOf = Result<Vec<IndexedWeight>, String>;

/// What a scheme does at a marked point.
#[derive(Clone, Debug)]
pub struct CurvePoint {
    /// Which point.
    pub at: Marked,
    /// Steps that lead to a point which later ones bring back to itself: 1 at the vertices of Chaikin's scheme.
    pub steps_before: u32,
    /// The points that decide the value.
    pub minimal: LocalMatrix,
    /// The eigenvalues on them.
    pub minimal_spectrum: Vec<CurveEigenvalue>,
    /// The points that decide the curve around it.
    pub full: LocalMatrix,
    /// The eigenvalues on them.
    pub full_spectrum: Vec<CurveEigenvalue>,
    /// The limit mask.
    pub limit: MaskOf,
    /// The tangent mask.
    pub tangent: MaskOf,
    /// Masks of derivatives, from the first on, as far as the eigenvalues are 1, 1/a, 1/a^2, ... and no others come between.
    pub derivatives: Vec<Vec<IndexedWeight>>,
}

/// Every marked point of a mask: a vertex, the middle of an edge, and the end of an open curve where there are rules for it.
///
/// # Errors
/// When a local matrix is too large.
pub fn points_of_mask(mask: &Mask, ends: Option<&Ends>) -> Result<Vec<CurvePoint>, Trouble> {
    let mut points = Vec::new();
    for at in [Marked::Vertex, Marked::MidEdge] {
        let minimal = neighbourhood(mask, &at.position(), Extent::Minimal)?;
        let full = neighbourhood(mask, &at.position(), Extent::Full)?;
        points.push(point(at, minimal, full.local, i64::from(mask.arity).into())?);
    }
    if let Some(ends) = ends {
        points.push(at_itself(Marked::Start, at_end(mask, ends)?, i64::from(mask.arity).into())?);
    }
    Ok(points)
}

/// Both ends of a polygon that is halved.
///
/// # Errors
/// When a matrix is too large.
pub fn points_of_halves(halves: &Halves) -> Result<Vec<CurvePoint>, Trouble> {
    let local = |matrix| LocalMatrix { indices: (0..halves.points() as i64).collect(), matrix, steps: 1 };
    let back = |matrix: &Vec<Vec<RBig>>| {
        matrix.iter().rev().map(|row| row.iter().rev().cloned().collect()).collect::<Vec<Vec<RBig>>>()
    };
    let shrink = |local: &LocalMatrix| Ok::<_, Trouble>(RBig::ONE / subdominant_of(&spectrum(&local.matrix)?));
    let (start, end) = (local(halves.first.clone()), local(back(&halves.second)));
    let (a, b) = (shrink(&start)?, shrink(&end)?);
    Ok(vec![at_itself(Marked::Start, start, a)?, at_itself(Marked::End, end, b)?])
}

/// The largest rational eigenvalue below 1, or 1/2.
fn subdominant_of(spectrum: &[CurveEigenvalue]) -> RBig {
    let below =
        spectrum.iter().filter_map(|e| e.rational.clone()).filter(|value| *value < RBig::ONE && !value.is_zero());
    below.max().unwrap_or(RBig::ONE / RBig::from(2))
}

/// A point that every step brings back to itself, with one neighbourhood for all.
fn at_itself(at: Marked, local: LocalMatrix, dilation: RBig) -> Result<CurvePoint, Trouble> {
    let size = local.indices.len();
    let unit = |i: usize| (0..size).map(|j| if i == j { RBig::ONE } else { RBig::ZERO }).collect();
    let before = (0..size).map(unit).collect();
    let whole = Neighbourhood { indices: local.indices.clone(), before, steps_before: 0, local: local.clone() };
    point(at, whole, local, dilation)
}

fn point(at: Marked, minimal: Neighbourhood, full: LocalMatrix, dilation: RBig) -> Result<CurvePoint, Trouble> {
    let own = spectrum(&minimal.local.matrix)?;
    let limit = limit_mask(&minimal, &own);
    let tangent = tangent_mask(&minimal, &own, &at.position());
    let derivatives = derivative_masks(&minimal, &own, &at.position(), &dilation);
    Ok(CurvePoint {
        at,
        steps_before: minimal.steps_before,
        minimal: minimal.local,
        minimal_spectrum: own,
        full_spectrum: spectrum(&full.matrix)?,
        full,
        limit,
        tangent,
        derivatives,
    })
}

/// A left vector on the local matrix as weights of the points around the marked point itself.
fn pulled_back(neighbourhood: &Neighbourhood, left: &[RBig]) -> Vec<RBig> {
    let column = |j: usize| {
        let terms = left.iter().zip(&neighbourhood.before);
        terms.fold(RBig::ZERO, |sum, (weight, row)| sum + weight * &row[j])
    };
    (0..neighbourhood.indices.len()).map(column).collect()
}

/// The left eigenvector of a rational eigenvalue.
fn left_vector(neighbourhood: &Neighbourhood, e: &CurveEigenvalue) -> Option<Vec<RBig>> {
    let listed = e.left.first().cloned();
    let found =
        || eigenvectors(&transposed(&neighbourhood.local.matrix), e.rational.as_ref()?).ok()?.into_iter().next();
    listed.or_else(found)
}

/// sum_j w_j (j - u)^k
fn moment(indices: &[i64], weights: &[RBig], position: &RBig, order: usize) -> RBig {
    let terms = indices.iter().zip(weights);
    terms.fold(RBig::ZERO, |sum, (j, weight)| sum + weight * (RBig::from(*j) - position).pow(order as isize))
}

fn scaled(neighbourhood: &Neighbourhood, weights: &[RBig], factor: &RBig) -> Vec<IndexedWeight> {
    let pairs = neighbourhood.indices.iter().zip(weights).filter(|(_, weight)| !weight.is_zero());
    pairs
        .map(|(index, weight)| {
            let exact = weight * factor;
            IndexedWeight { index: *index, value: exact.to_f64().value(), exact: Some(exact) }
        })
        .collect()
}

fn limit_mask(neighbourhood: &Neighbourhood, spectrum: &[CurveEigenvalue]) -> MaskOf {
    let one = spectrum.iter().find(|e| e.rational == Some(RBig::ONE));
    let one = one.ok_or("1 is no eigenvalue")?;
    if one.algebraic != 1 {
        return Err(format!(
            "the eigenvalue 1 is {}-fold: the scheme does not converge to continuous curves",
            one.algebraic
        ));
    }
    if let Some(other) = spectrum.iter().find(|e| e.rational != Some(RBig::ONE) && !is_below(e, &RBig::ONE)) {
        let words = other.words.as_ref().map_or(String::new(), |words| words.text.clone());
        return Err(format!("the eigenvalue {words} is not smaller than 1 in modulus: the scheme does not converge"));
    }
    let left = left_vector(neighbourhood, one).ok_or("there is no left eigenvector")?;
    let weights = pulled_back(neighbourhood, &left);
    let sum = weights.iter().fold(RBig::ZERO, |sum, weight| sum + weight);
    if sum.is_zero() {
        Err("the left eigenvector sums to 0".into())
    } else {
        Ok(scaled(neighbourhood, &weights, &(RBig::ONE / sum)))
    }
}

/// Whether the modulus is certainly below a positive number.
fn is_below(e: &CurveEigenvalue, bound: &RBig) -> bool {
    match &e.rational {
        Some(value) => value < bound && *value > -bound,
        None => e.modulus_squared.lo_hi().1 < bound * bound,
    }
}

fn tangent_mask(neighbourhood: &Neighbourhood, spectrum: &[CurveEigenvalue], position: &RBig) -> MaskOf {
    let mut after = spectrum.iter().filter(|e| e.rational != Some(RBig::ONE));
    let lambda = after.next().ok_or("there is no eigenvalue after 1")?;
    if lambda.value.norm() == 0.0 {
        return Err("every eigenvalue after 1 is zero: the curve is decided by one point".into());
    }
    if lambda.algebraic != 1 {
        return Err(format!("the largest eigenvalue after 1 is {}-fold", lambda.algebraic));
    }
    let root = lambda.modulus_squared.lo_hi().0;
    let apart = |e: &CurveEigenvalue| match (&e.rational, &lambda.rational) {
        (Some(value), Some(own)) => value * value < own * own,
        _ => e.modulus_squared.lo_hi().1 < root,
    };
    if !after.all(apart) {
        return Err("two eigenvalues share the largest modulus after 1, so that tangents turn from step to step".into());
    }
    if let Some(left) = left_vector(neighbourhood, lambda) {
        let weights = pulled_back(neighbourhood, &left);
        let first = moment(&neighbourhood.indices, &weights, position, 1);
        let factor = if first.is_zero() { RBig::ONE } else { RBig::ONE / first };
        return Ok(scaled(neighbourhood, &weights, &factor));
    }
    if lambda.real.is_none() {
        return Err("the largest eigenvalues after 1 are a complex pair".into());
    }
    let left = enclosed_left(&neighbourhood.local.matrix, lambda).map_err(|trouble| trouble.to_string())?;
    enclosed_weights(neighbourhood, &left, position).map_err(|trouble| trouble.to_string())
}

/// The tangent mask of an irrational eigenvalue: enclosed, and given by the middles.
fn enclosed_weights(
    neighbourhood: &Neighbourhood,
    left: &[Enclosure<BITS>],
    position: &RBig,
) -> Result<Vec<IndexedWeight>, Trouble> {
    let mut weights = vec![Enclosure::<BITS>::whole(0); neighbourhood.indices.len()];
    let mut first = Enclosure::<BITS>::whole(0);
    for (j, weight) in weights.iter_mut().enumerate() {
        for (own, row) in left.iter().zip(&neighbourhood.before) {
            *weight = weight.plus(&own.times(&Enclosure::rational(&row[j]))?)?;
        }
        let index = RBig::from(neighbourhood.indices[j]) - position;
        first = first.plus(&weight.times(&Enclosure::rational(&index))?)?;
    }
    let scale = |weight: &Enclosure<BITS>| {
        if first.sign() == Some(Ordering::Equal) { Ok(weight.clone()) } else { weight.over(&first) }
    };
    let pairs = neighbourhood.indices.iter().zip(&weights);
    pairs
        .map(|(index, weight)| Ok(IndexedWeight { index: *index, value: scale(weight)?.midpoint_f64(), exact: None }))
        .collect()
}

fn derivative_masks(
    neighbourhood: &Neighbourhood,
    spectrum: &[CurveEigenvalue],
    position: &RBig,
    dilation: &RBig,
) -> Vec<Vec<IndexedWeight>> {
    let mut masks = Vec::new();
    let mut factorial = RBig::ONE;
    for order in 1..neighbourhood.local.indices.len().min(MOST_DERIVATIVES + 1) {
        factorial *= RBig::from(order as u64);
        let value = |k: usize| RBig::ONE / dilation.pow((k as u32 * neighbourhood.local.steps) as isize);
        let powers: Vec<RBig> = (0..=order).map(value).collect();
        let expected = |e: &CurveEigenvalue| e.rational.as_ref().is_some_and(|own| powers.contains(own));
        let own = spectrum.iter().filter(|e| expected(e));
        let simple = own.clone().count() == order + 1 && own.clone().all(|e| e.algebraic == 1);
        if !simple || spectrum.iter().any(|e| !expected(e) && !is_below(e, &powers[order])) {
            break;
        }
        let mut found = own.filter(|e| e.rational.as_ref() == Some(&powers[order]));
        let Some(left) = found.find_map(|e| left_vector(neighbourhood, e)) else { break };
        let weights = pulled_back(neighbourhood, &left);
        let moment = moment(&neighbourhood.indices, &weights, position, order);
        if moment.is_zero() {
            break;
        }
        masks.push(scaled(neighbourhood, &weights, &(&factorial / moment)));
    }
    masks
}
