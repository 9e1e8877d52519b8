//! What does the basic limit function of a mask look like, and its derivatives?
//!
//! The limit of the polygon that is 1 at one point and 0 at all others; every limit curve is sum_j p_j phi(x - j). It is refined some
//! times and pushed to the limit by masks; derivatives come from the masks of derivatives, times a^k a step. All values are approximate.

use super::local::parameter;
use super::point::{CurvePoint, Marked};
use crate::refine::curve::{Row, rows_of};
use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// Samples of the function and of its derivatives.
#[derive(Clone, Debug)]
pub struct LimitFunction {
    /// Where, counted from the point that is 1; equally spaced.
    pub at: Vec<f64>,
    /// Values of the function, of its first derivative, and so on.
    pub approx_values: Vec<Vec<f64>>,
}

/// At least so many samples.
const SAMPLES: usize = 600;

/// Samples of the basic limit function and of as many derivatives as are asked for and have masks.
pub fn limit_function(mask: &Mask, points: &[CurvePoint], derivatives: usize) -> Option<LimitFunction> {
    let vertex = points.iter().find(|point| point.at == Marked::Vertex)?;
    let limit = vertex.limit.as_ref().ok()?;
    let rows = rows_of(mask);
    let arity = rows.len() as i64;
    let (mut first, mut values, mut scale) = (0_i64, vec![1.0], 1.0_f64);
    while values.len() < SAMPLES {
        (first, values) = refined(mask, &rows, first, &values);
        scale *= arity as f64;
    }
    // beyond its ends the function is zero: the masks reach into it from there
    let reach = points.iter().flat_map(|p| &p.minimal.indices).map(|j| j.abs()).max().unwrap_or(0) + 1;
    let c = parameter(mask, &RBig::ZERO).to_f64().value();
    let indices: Vec<i64> = (first - reach..first + values.len() as i64 + reach).collect();
    let value = |i: i64| usize::try_from(i - first).ok().and_then(|i| values.get(i)).copied().unwrap_or(0.0);
    let applied = |weights: &[super::point::IndexedWeight], factor: f64| {
        let at = |i: &i64| factor * weights.iter().map(|w| w.value * value(i + w.index)).sum::<f64>();
        indices.iter().map(at).collect::<Vec<f64>>()
    };
    let mut approx_values = vec![applied(limit, 1.0)];
    for (order, weights) in (1..).zip(vertex.derivatives.iter().take(derivatives)) {
        approx_values.push(applied(weights, scale.powi(order)));
    }
    let at = indices.iter().map(|i| (*i as f64 + c) / scale - c).collect();
    Some(LimitFunction { at, approx_values })
}

/// One step on values that are zero elsewhere.
fn refined(mask: &Mask, rows: &[Row], first: i64, values: &[f64]) -> (i64, Vec<f64>) {
    let arity = rows.len() as i64;
    let (low, high) = mask.support().unwrap_or((0, 0));
    let (from, to) = (arity * first + low, arity * (first + values.len() as i64 - 1) + high);
    let old = |j: i64| usize::try_from(j - first).ok().and_then(|j| values.get(j)).copied().unwrap_or(0.0);
    let new = |i: i64| {
        let row = &rows[i.rem_euclid(arity) as usize];
        let start = i.div_euclid(arity) + row.start;
        (start..).zip(&row.weights).map(|(j, weight)| weight * old(j)).sum()
    };
    (from, (from..=to).map(new).collect())
}
