//! Which points decide the curve near a parameter, and how do they go over into those of the next level?
//!
//! The basic limit function of the mask a_l, ..., a_r of arity a lives on [l/(a-1), r/(a-1)], so that the curve near x is made of the
//! p_j with x - r/(a-1) <= j <= x - l/(a-1), and its value at x of those strictly between. One step takes the points around x into those
//! around a x (Warren and Weimer 2002, chapter 3). The point p_j stands for the parameter j + c with c = (l + r)/(2 (a - 1)).

use crate::numbers::Trouble;
use crate::numbers::linear::{Matrix, product};
use crate::scheme::curve::{Ends, Mask};
use dashu_int::IBig;
use dashu_ratio::RBig;

/// The most points of a local matrix.
pub const MAX_POINTS: usize = 1100;

/// The local matrix at a point that some steps bring back to itself.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalMatrix {
    /// The indices of the points, rows and columns; at an end of an open curve counted from 0.
    pub indices: Vec<i64>,
    /// Row by row: how the points of the next level are made.
    pub matrix: Matrix<RBig>,
    /// The refinement steps in one application.
    pub steps: u32,
}

/// A parameter of a curve with what leads from the points around it to a local matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Neighbourhood {
    /// The indices of the points around the parameter.
    pub indices: Vec<i64>,
    /// What takes them to the points of the local matrix: some steps, or the identity.
    pub before: Matrix<RBig>,
    /// The steps before.
    pub steps_before: u32,
    /// The local matrix.
    pub local: LocalMatrix,
}

/// Which points are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Those that decide the value at the point.
    Minimal,
    /// Those that decide the curve around the point.
    Full,
}

/// The parameter that a position stands for: 0 is the vertex p_0, 1/2 the middle of the edge from p_0 to p_1.
pub fn parameter(mask: &Mask, position: &RBig) -> RBig {
    let (first, last) = mask.support().unwrap_or((0, 0));
    position + RBig::from(first + last) / RBig::from(2 * (i64::from(mask.arity) - 1))
}

fn small(value: IBig) -> i64 {
    i64::try_from(value).unwrap_or(i64::MAX)
}

/// The indices of the points around a parameter.
fn window(mask: &Mask, x: &RBig, extent: Extent) -> Vec<i64> {
    let (first, last) = mask.support().unwrap_or((0, 0));
    let reach = |i: i64| x - RBig::from(i) / RBig::from(i64::from(mask.arity) - 1);
    let (low, high) = (reach(last), reach(first));
    let strict = (small(low.floor()) + 1)..=(small(high.ceil()) - 1);
    if extent == Extent::Minimal && !strict.is_empty() {
        return strict.collect();
    }
    (small(low.ceil())..=small(high.floor())).collect()
}

/// How the points around a x are made of those around x.
fn step(mask: &Mask, rows: &[i64], columns: &[i64]) -> Matrix<RBig> {
    let arity = i64::from(mask.arity);
    rows.iter().map(|i| columns.iter().map(|j| mask.get(i - arity * j)).collect()).collect()
}

fn identity(size: usize) -> Matrix<RBig> {
    let entry = |i, j| if i == j { RBig::ONE } else { RBig::ZERO };
    (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
}

/// The neighbourhood of a position, which must be a whole number of halves: some steps lead to a point that later ones bring back to
/// itself.
///
/// # Errors
/// When there are more than [`MAX_POINTS`].
pub fn neighbourhood(mask: &Mask, position: &RBig, extent: Extent) -> Result<Neighbourhood, Trouble> {
    let arity = RBig::from(mask.arity);
    let mut parameters = vec![parameter(mask, position)];
    // the fractional part, over twice the arity less 1, comes back after two steps at most, and one before
    let (start, period) = loop {
        let next = parameters.last().map_or(RBig::ZERO, |x| x * &arity);
        let back = parameters.iter().position(|x| (&next - x).is_int());
        parameters.push(next);
        if let Some(start) = back {
            break (start, parameters.len() - 1 - start);
        }
    };
    let windows: Vec<Vec<i64>> = parameters.iter().map(|x| window(mask, x, extent)).collect();
    if windows.iter().any(|window| window.len() > MAX_POINTS || window.is_empty()) {
        return Err(Trouble::BeyondThisWorld("the local matrix has too many points"));
    }
    let between = |from: usize, to: usize| {
        (from..to).try_fold(identity(windows[from].len()), |product_so_far, level| {
            product(&step(mask, &windows[level + 1], &windows[level]), &product_so_far)
        })
    };
    // indices count from the vertex at the point, or before it
    let c = parameter(mask, &RBig::ZERO);
    let own = small((&parameters[start] - c).floor());
    let local = LocalMatrix {
        indices: windows[start].iter().map(|index| index - own).collect(),
        matrix: between(start, start + period)?,
        steps: period as u32,
    };
    Ok(Neighbourhood { indices: windows[0].clone(), before: between(0, start)?, steps_before: start as u32, local })
}

/// How new points at the end of an open curve are made: row r of the new point r, of the old points counted from the end.
pub fn end_row(mask: &Mask, ends: &Ends, r: usize) -> Vec<(i64, RBig)> {
    match ends.rules.get(r) {
        Some(rule) => (0..).zip(rule.iter().cloned()).filter(|(_, weight)| !weight.is_zero()).collect(),
        None => {
            let i = ends.then + (r - ends.rules.len()) as i64;
            let shift = i.div_euclid(i64::from(mask.arity));
            let row = mask.submask(i.rem_euclid(i64::from(mask.arity)));
            row.into_iter().map(|(j, weight)| (j + shift, weight)).collect()
        }
    }
}

/// The local matrix at the end of an open curve: of the points that decide the curve near its end.
///
/// # Errors
/// When there are more than [`MAX_POINTS`].
pub fn at_end(mask: &Mask, ends: &Ends) -> Result<LocalMatrix, Trouble> {
    let reach = |r: usize| end_row(mask, ends, r).iter().map(|(j, _)| *j).max().unwrap_or(0);
    // beyond the rules of the end, each new point lies nearer to the end than the old ones that it is made of, from some index on
    let regular = ends.rules.len() + mask.coefficients.len() + ends.then.unsigned_abs() as usize;
    let size = 1 + (0..=2 * regular).rev().find(|r| reach(*r) >= *r as i64).unwrap_or(0);
    if size > MAX_POINTS {
        return Err(Trouble::BeyondThisWorld("the local matrix at the end has too many points"));
    }
    let row = |r: usize| {
        let mut row = vec![RBig::ZERO; size];
        for (j, weight) in end_row(mask, ends, r) {
            if let Some(slot) = usize::try_from(j).ok().and_then(|j| row.get_mut(j)) {
                *slot = weight;
            }
        }
        row
    };
    Ok(LocalMatrix { indices: (0..size as i64).collect(), matrix: (0..size).map(row).collect(), steps: 1 })
}
