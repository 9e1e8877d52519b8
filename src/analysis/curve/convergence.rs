//! How fast do the polygons come near to the curve?
//!
//! Measured on one polygon: the farthest of its vertices and middles of edges from a much finer polygon, level by level. The distance
//! falls like the square of the step for curves that are smooth enough, by 4 a step of a binary scheme.

use super::limit::CurveLimits;
use crate::refine::curve::CurveRefiner;
use crate::scheme::curve::Rules;

/// Distances, level by level.
#[derive(Clone, Debug)]
pub struct Convergence {
    /// From the polygon to the curve, approximately.
    pub approx_distances: Vec<f64>,
    /// By which factor each is smaller than the one before.
    pub approx_factors: Vec<f64>,
}

/// The levels that are looked at.
const LEVELS: usize = 5;

/// The points of the finest polygon.
const FINEST: usize = 20_000;

/// A polygon to look at: a closed one around a star, for halves an open one in zigzag.
pub fn sample(rules: &Rules) -> (Vec<[f64; 2]>, bool) {
    match rules {
        Rules::Halves(halves) => {
            let point = |j: usize| [j as f64, ((7 * j + 3) % 5) as f64];
            ((0..halves.points()).map(point).collect(), false)
        }
        Rules::Mask(_, None) => {
            let point = |j: usize| {
                let (turn, radius) =
                    (std::f64::consts::TAU * j as f64 / 7.0, [1.0, 0.6, 1.1, 0.5, 0.9, 0.7, 1.2][j % 7]);
                [radius * libm::cos(turn), radius * libm::sin(turn)]
            };
            ((0..7).map(point).collect(), true)
        }
        Rules::Mask(..) => {
            let y = [0.0, 1.4, 1.1, -0.6, -0.2, 1.2, 0.3];
            (y.iter().enumerate().map(|(j, y)| [j as f64, *y]).collect(), false)
        }
    }
}

/// The distances for the sample polygon; `None` where it can't be refined.
pub fn convergence(rules: &Rules) -> Option<Convergence> {
    let refiner = CurveRefiner::new(rules);
    let (points, closed) = sample(rules);
    let mut levels = vec![points];
    for level in 0..LEVELS {
        levels.push(refiner.step(&levels[level], closed).ok()?);
    }
    let mut fine = levels[LEVELS].clone();
    while fine.len() * refiner.arity() <= FINEST {
        fine = refiner.step(&fine, closed).ok()?;
    }
    let fine = CurveLimits::new(rules).ok()?.of(&fine, closed).ok()?;
    let approx_distances: Vec<f64> = levels.iter().map(|level| distance(level, &fine, closed)).collect();
    let factor = |pair: &[f64]| if pair[1] > 0.0 { pair[0] / pair[1] } else { f64::INFINITY };
    let approx_factors = approx_distances.windows(2).map(factor).collect();
    Some(Convergence { approx_distances, approx_factors })
}

/// The farthest of a polygon's vertices and middles from another polygon.
fn distance(polygon: &[[f64; 2]], fine: &[[f64; 2]], closed: bool) -> f64 {
    let middle = |a: &[f64; 2], b: &[f64; 2]| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    let mut probes: Vec<[f64; 2]> = polygon.to_vec();
    probes.extend(polygon.windows(2).map(|pair| middle(&pair[0], &pair[1])));
    let mut sides: Vec<[[f64; 2]; 2]> = fine.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    if let (true, Some(first), Some(last)) = (closed, polygon.first(), polygon.last()) {
        probes.push(middle(last, first));
        sides.extend(fine.last().zip(fine.first()).map(|(last, first)| [*last, *first]));
    }
    let nearest = |probe: &[f64; 2]| sides.iter().map(|side| to_side(probe, side)).fold(f64::INFINITY, f64::min);
    probes.iter().map(nearest).fold(0.0, f64::max).sqrt()
}

/// The square of the distance from a point to a side.
fn to_side(p: &[f64; 2], [a, b]: &[[f64; 2]; 2]) -> f64 {
    let (d, e) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = d[0] * d[0] + d[1] * d[1];
    let t = if square > 0.0 { ((d[0] * e[0] + d[1] * e[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    let gap = [e[0] - t * d[0], e[1] - t * d[1]];
    gap[0] * gap[0] + gap[1] * gap[1]
}
