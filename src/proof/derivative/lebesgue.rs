//! How far can limits of bounded data go?
//!
//! The mask of a scheme D that keeps constants, in whole numbers over a denominator, and those of its differences G_j
//! along directions that span the lattice. L bounds |D^k p| for |p| <= 1 at every level k from K on, so it bounds the
//! Lebesgue sum of the limits' basic functions: the sum of |phi(x - beta)| is at most L. It is a rational number,
//! found in whole numbers; docs/theory.md derives it.

use super::norms::norms;
use crate::analysis::regular::factors::divided;
use crate::analysis::regular::mask::{Point, Sequence};
use crate::numbers::Trouble;
use dashu_ratio::RBig;
use std::collections::BTreeMap;

/// L and how it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Lebesgue {
    /// L.
    pub bound: RBig,
    /// K.
    pub steps: usize,
    /// g_1, ..., g_K: the larger of the norms of G_j^k.
    pub contractions: Vec<RBig>,
    /// The norm of D^K.
    pub norm: RBig,
    /// A new point is so far at most from some old one, weighed by its row and told in steps along the directions.
    pub kappa: RBig,
}

/// The mask of the differences along v: z^v a(z)/(1 + z^v); `None` where a lacks the factor.
///
/// # Errors
/// When the numbers pass a limit of size.
pub fn differences(mask: &Sequence, v: Point) -> Result<Option<Sequence>, Trouble> {
    let moved = |quotient: Sequence| -> Sequence {
        quotient.into_iter().map(|([x, y], weight)| ([x + v[0], y + v[1]], weight)).collect()
    };
    Ok(divided(mask, v, 2)?.map(moved))
}

/// L of a scheme whose differences along each of these directions are refined by a scheme of their own; they come
/// after 0 in the order of points, and two of them have determinant 1 or -1. `None` where a mask lacks a factor, or
/// no number of steps within limits contracts.
///
/// # Errors
/// When the numbers pass a limit of size.
pub fn lebesgue(mask: &Sequence, directions: &[Point]) -> Result<Option<Lebesgue>, Trouble> {
    let mut own = norms(mask);
    let mut contractions: Vec<RBig> = Vec::new();
    for (index, direction) in directions.iter().enumerate() {
        let Some(scheme) = differences(mask, *direction)? else { return Ok(None) };
        let found = norms(&scheme);
        contractions = match index {
            0 => found,
            _ => contractions.into_iter().zip(found).map(|(a, b)| a.max(b)).collect(),
        };
    }
    let steps = own.len().min(contractions.len());
    own.truncate(steps);
    contractions.truncate(steps);
    let (Some(norm), Some(last)) = (own.pop(), contractions.last().cloned()) else { return Ok(None) };
    let Some(kappa) = kappa(mask, directions) else { return Ok(None) };
    if last >= RBig::ONE {
        return Ok(None);
    }
    // g_(q K + i) <= g_K^q g_i, with g_0 = 1
    let first = contractions[..steps - 1].iter().fold(RBig::ONE, |sum, own| sum + own);
    let tail = &last * first / (RBig::ONE - &last);
    let bound = &norm + RBig::from(2) * &kappa * tail;
    Ok(Some(Lebesgue { bound, steps, contractions, norm, kappa }))
}

/// The largest over the cosets of the least weighed distance of a new point's row from one of its old points; `None`
/// where a row doesn't sum to 1.
fn kappa(mask: &Sequence, directions: &[Point]) -> Option<RBig> {
    let mut largest = RBig::ZERO;
    for coset in [[0, 0], [1, 0], [0, 1], [1, 1]] {
        let mut row: BTreeMap<Point, RBig> = BTreeMap::new();
        for (alpha, weight) in mask {
            let (x, y) = (coset[0] - alpha[0], coset[1] - alpha[1]);
            if x % 2 == 0 && y % 2 == 0 {
                row.insert([x / 2, y / 2], weight.as_rational()?);
            }
        }
        if row.values().fold(RBig::ZERO, |sum, own| sum + own) != RBig::ONE {
            return None;
        }
        let modulus = |weight: &RBig| if *weight < RBig::ZERO { -weight.clone() } else { weight.clone() };
        let mut least: Option<RBig> = None;
        for from in row.keys() {
            let mut sum = RBig::ZERO;
            for (to, weight) in &row {
                sum += modulus(weight) * RBig::from(distance([to[0] - from[0], to[1] - from[1]], directions)?);
            }
            least = Some(least.map_or(sum.clone(), |own| own.min(sum)));
        }
        largest = largest.max(least?);
    }
    Some(largest)
}

/// The number of steps along two of the directions that lead to a point, the least over the pairs that span the
/// lattice.
fn distance(point: Point, directions: &[Point]) -> Option<i32> {
    let pairs = directions.iter().enumerate().flat_map(|(i, u)| directions[i + 1..].iter().map(move |v| (*u, *v)));
    let steps = pairs.filter_map(|([a, b], [c, d])| {
        let det = a * d - b * c;
        let (x, y) = (point[0] * d - point[1] * c, a * point[1] - b * point[0]);
        (det.abs() == 1).then_some(x.abs() + y.abs())
    });
    steps.min()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::derivative::norms::tests::{mask, refined, twice};

    /// Differences of refined data are refined differences.
    #[test]
    fn differences_are_refined_by_a_scheme_of_their_own() {
        let along = |data: &BTreeMap<Point, RBig>, v: Point| {
            let mut differences: BTreeMap<Point, RBig> = BTreeMap::new();
            for ([x, y], value) in data {
                *differences.entry([x - v[0], y - v[1]]).or_insert(RBig::ZERO) += value;
                *differences.entry([*x, *y]).or_insert(RBig::ZERO) -= value;
            }
            differences.retain(|_, value| !value.is_zero());
            differences
        };
        let data: BTreeMap<Point, RBig> = [([0, 0], 3), ([2, -1], 5), ([1, 1], -2)].map(|(p, v)| (p, v.into())).into();
        for v in [[1, 0], [0, 1], [1, -1]] {
            let own = differences(&mask("butterfly"), v).unwrap().unwrap();
            let mut refined_differences = refined(&along(&data, v), &own);
            refined_differences.retain(|_, value| !value.is_zero());
            assert_eq!(along(&refined(&data, &mask("butterfly")), v), refined_differences);
        }
    }

    /// A spline's derivatives are convex combinations of differences: L is 1, and bounds found are not below it.
    /// Norms at every level are at most L.
    #[test]
    fn bounds_hold_at_every_level() {
        let sides = [[0, 1], [1, -1]];
        let spline = lebesgue(&twice(&mask("loop"), [1, 0]), &sides).unwrap().unwrap();
        assert!(spline.norm == RBig::ONE && spline.bound > RBig::ONE && spline.bound < RBig::from(2));
        let own = twice(&mask("butterfly"), [1, 0]);
        let found = lebesgue(&own, &sides).unwrap().unwrap();
        assert!(norms(&own).iter().all(|norm| *norm <= found.bound));
        assert!(found.bound > RBig::from(2) && found.bound < RBig::from(6));
    }

    #[test]
    fn masks_that_lack_a_factor_have_none() {
        assert_eq!(differences(&mask("loop"), [1, 1]).unwrap(), None);
        assert!(lebesgue(&mask("butterfly"), &[[1, 1], [1, 0]]).unwrap().is_none());
    }
}
