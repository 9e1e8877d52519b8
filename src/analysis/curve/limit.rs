//! Where do the points of a polygon end?
//!
//! By the limit mask at vertices: inside, around closed polygons, and near the ends of open ones through powers of the local matrix at
//! the end, until a point has only regular neighbours. A scheme of halves has limits at the ends of its pieces.

use super::local::{Extent, LocalMatrix, at_end, end_row, neighbourhood};
use super::point::{IndexedWeight, Marked, MaskOf, points_of_halves, points_of_mask};
use crate::refine::curve::NotRefinableCurve;
use crate::scheme::curve::{Ends, Mask, Rules};
use dashu_ratio::RBig;

/// The limits of a scheme's points.
#[derive(Clone, Debug)]
pub struct CurveLimits {
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Weights of the points around a vertex, and rows for the first points of an open polygon.
    Mask { vertex: Vec<(i64, f64)>, ends: Option<Vec<Vec<f64>>> },
    /// Weights at the start and, counted from the end, at the end of a piece.
    Halves { start: Vec<(i64, f64)>, end: Vec<(i64, f64)>, sides: usize },
}

fn floats(mask: &[IndexedWeight]) -> Vec<(i64, f64)> {
    mask.iter().map(|weight| (weight.index, weight.value)).collect()
}

impl CurveLimits {
    /// The limits of a scheme.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub fn new(rules: &Rules) -> Result<CurveLimits, String> {
        let words = |trouble: crate::numbers::Trouble| trouble.to_string();
        match rules {
            Rules::Halves(halves) => {
                let points = points_of_halves(halves).map_err(words)?;
                let mask = |at: Marked| -> MaskOf {
                    let found = points.iter().find(|point| point.at == at).map(|point| point.limit.clone());
                    found.unwrap_or(Err("there is no such point".to_string()))
                };
                let (start, end) = (floats(&mask(Marked::Start)?), floats(&mask(Marked::End)?));
                Ok(CurveLimits { kind: Kind::Halves { start, end, sides: halves.points() - 1 } })
            }
            Rules::Mask(mask, ends) => {
                let points = points_of_mask(mask, ends.as_ref()).map_err(words)?;
                let of = |at: Marked| points.iter().find(|point| point.at == at).map(|point| point.limit.clone());
                let vertex = of(Marked::Vertex).unwrap_or(Err("there is no vertex".to_string()))?;
                let rows = match (ends, of(Marked::Start)) {
                    (Some(ends), Some(start)) => Some(end_rows(mask, ends, &vertex, &start?)?),
                    _ => None,
                };
                Ok(CurveLimits { kind: Kind::Mask { vertex: floats(&vertex), ends: rows } })
            }
        }
    }

    /// The limits of the points of a polygon: of all of them where it is closed or has rules for its ends, else of those whose
    /// neighbours are all there; of a scheme of halves those at the ends of pieces.
    ///
    /// # Errors
    /// When the polygon has too few points.
    pub fn of<const D: usize>(&self, points: &[[f64; D]], closed: bool) -> Result<Vec<[f64; D]>, NotRefinableCurve> {
        let count = points.len() as i64;
        match &self.kind {
            Kind::Mask { vertex, .. } if closed => {
                Ok((0..count).map(|k| mean(vertex, |j| (k + j).rem_euclid(count) as usize, points)).collect())
            }
            Kind::Mask { vertex, ends: None } => {
                let (low, high) = reach(vertex);
                let found: Vec<[f64; D]> =
                    (-low..count - high).map(|k| mean(vertex, |j| (k + j) as usize, points)).collect();
                let needed = (high - low + 1) as usize;
                if found.is_empty() {
                    Err(NotRefinableCurve::TooFew { points: points.len(), needed })
                } else {
                    Ok(found)
                }
            }
            Kind::Mask { vertex, ends: Some(rows) } => {
                let longest = rows.iter().map(Vec::len).max().unwrap_or(0);
                let needed = longest.max(2 * rows.len());
                if points.len() < needed {
                    return Err(NotRefinableCurve::TooFew { points: points.len(), needed });
                }
                let special = rows.len() as i64;
                let at = |k: i64| {
                    let (own, back) = if k < special { (k, false) } else { (count - 1 - k, true) };
                    if own >= special {
                        return mean(vertex, |j| (k + j) as usize, points);
                    }
                    let row: Vec<(i64, f64)> = (0..).zip(rows[own as usize].iter().copied()).collect();
                    mean(&row, |j| if back { (count - 1 - j) as usize } else { j as usize }, points)
                };
                Ok((0..count).map(at).collect())
            }
            Kind::Halves { start, end, sides } => {
                if closed {
                    return Err(NotRefinableCurve::Closed);
                }
                if points.len() < 2 || !(points.len() - 1).is_multiple_of(*sides) {
                    return Err(NotRefinableCurve::Pieces { points: points.len(), sides: *sides });
                }
                let starts = (0..points.len() - 1).step_by(*sides);
                let mut found: Vec<[f64; D]> = starts.map(|s| mean(start, |j| s + j as usize, points)).collect();
                found.push(mean(end, |j| points.len() - 1 - j as usize, points));
                Ok(found)
            }
        }
    }
}

fn reach(mask: &[(i64, f64)]) -> (i64, i64) {
    let low = mask.iter().map(|(j, _)| *j).min().unwrap_or(0);
    let high = mask.iter().map(|(j, _)| *j).max().unwrap_or(0);
    (low.min(0), high.max(0))
}

fn mean<const D: usize>(mask: &[(i64, f64)], index: impl Fn(i64) -> usize, points: &[[f64; D]]) -> [f64; D] {
    let mut sum = [0.0; D];
    for (j, weight) in mask {
        let point = &points[index(*j)];
        for axis in 0..D {
            sum[axis] += weight * point[axis];
        }
    }
    sum
}

/// Rows for the first points of an open polygon: the point k is followed as it is refined until its neighbours are regular, or it stays
/// where it is; then the limit mask applies.
fn end_rows(
    mask: &Mask,
    ends: &Ends,
    vertex: &[IndexedWeight],
    start: &[IndexedWeight],
) -> Result<Vec<Vec<f64>>, String> {
    const MOST_STEPS: usize = 64;
    let words = |trouble: crate::numbers::Trouble| trouble.to_string();
    let around = neighbourhood(mask, &RBig::ZERO, Extent::Full).map_err(words)?;
    let sum = mask.support().map_or(0, |(first, last)| first + last);
    if around.steps_before != 0 || sum % 2 != 0 {
        return Err(
            "limits of open curves with rules at their ends need a mask whose vertices stay vertices".to_string()
        );
    }
    let reach = around.indices.iter().map(|j| j.abs()).max().unwrap_or(0);
    // from this point on every neighbour's neighbours are made by the mask
    let regular = ends.rules.len() as i64 + reach;
    let own: LocalMatrix = at_end(mask, ends).map_err(words)?;
    let size = (own.indices.len() as i64).max(2 * regular + 2 * reach + 2);
    let matrix: Vec<Vec<(i64, RBig)>> = (0..size as usize).map(|r| end_row(mask, ends, r)).collect();
    let next = |k: i64| (ends.rules.len() as i64 + i64::from(mask.arity) * k + sum / 2 - ends.then).max(0);
    let exact = |weight: &IndexedWeight| weight.exact.clone().ok_or("a limit mask is not rational".to_string());
    let mut rows = Vec::new();
    for k in 0..regular {
        let (mut at, mut steps) = (k, 0);
        while at < regular && next(at) != at && steps < MOST_STEPS {
            (at, steps) = (next(at), steps + 1);
        }
        if at < regular && next(at) != at {
            return Err("near its end a point of an open curve neither stays nor moves inside".to_string());
        }
        // the mask of the end is the same at every level
        let (last, shift, back) = if at < regular { (start, 0, 0) } else { (vertex, at, steps) };
        let mut row: Vec<(i64, RBig)> =
            last.iter().map(|w| Ok((w.index + shift, exact(w)?))).collect::<Result<_, String>>()?;
        for _ in 0..back {
            row = before(&row, &matrix).ok_or("the neighbourhood of the end is too small")?;
        }
        rows.push(row);
    }
    Ok(rows.into_iter().map(|row| dense(&row)).collect())
}

/// A row of weights on the refined points as one on the points before.
fn before(row: &[(i64, RBig)], matrix: &[Vec<(i64, RBig)>]) -> Option<Vec<(i64, RBig)>> {
    let mut sum: std::collections::BTreeMap<i64, RBig> = Default::default();
    for (r, weight) in row {
        for (j, own) in matrix.get(usize::try_from(*r).ok()?)? {
            *sum.entry(*j).or_insert(RBig::ZERO) += weight * own;
        }
    }
    Some(sum.into_iter().filter(|(_, weight)| !weight.is_zero()).collect())
}

fn dense(row: &[(i64, RBig)]) -> Vec<f64> {
    let length = row.iter().map(|(j, _)| j + 1).max().unwrap_or(0).max(0) as usize;
    let mut weights = vec![0.0; length];
    for (j, weight) in row {
        if let Some(slot) = usize::try_from(*j).ok().and_then(|j| weights.get_mut(j)) {
            *slot += weight.to_f64().value();
        }
    }
    weights
}
