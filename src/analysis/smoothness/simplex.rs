//! With which few weights is a point a combination of the vertices of a symmetric polytope?
//!
//! min sum |alpha_l| with sum alpha_l v_l = y, by the simplex method (Dantzig 1951) in floating point. The first n vertices are
//! multiples of the unit vectors and make the first basis. What comes out is a proposal: `polytope` bounds its error.

/// Steps before the best found so far is taken.
const STEPS: usize = 400;
const SMALL: f64 = 1e-12;

/// Weights (vertex, alpha) of y.
pub(super) fn combination(vertices: &[Vec<f64>], cross: f64, y: &[f64]) -> Vec<(usize, f64)> {
    let n = y.len();
    let mut basis: Vec<(usize, f64)> =
        y.iter().enumerate().map(|(i, x)| (i, if *x < 0.0 { -1.0 } else { 1.0 })).collect();
    let mut x: Vec<f64> = y.iter().map(|value| value.abs() / cross).collect();
    // the inverse of the basis, by rows
    let mut inverse = vec![vec![0.0; n]; n];
    (0..n).for_each(|i| inverse[i][i] = basis[i].1 / cross);
    for _ in 0..STEPS {
        let u: Vec<f64> = (0..n).map(|j| inverse.iter().map(|row| row[j]).sum()).collect();
        let price = |v: &Vec<f64>| v.iter().zip(&u).map(|(a, b)| a * b).sum::<f64>();
        let best = vertices.iter().map(price).enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let Some((enter, value)) = best.filter(|(_, value)| value.abs() > 1.0 + SMALL) else { break };
        let sign = value.signum();
        let d: Vec<f64> = inverse
            .iter()
            .map(|row| sign * row.iter().zip(&vertices[enter]).map(|(a, b)| a * b).sum::<f64>())
            .collect();
        let leaving = (0..n).filter(|i| d[*i] > SMALL).min_by(|a, b| (x[*a] / d[*a]).total_cmp(&(x[*b] / d[*b])));
        let Some(leave) = leaving else { break };
        let step = x[leave] / d[leave];
        let pivot: Vec<f64> = inverse[leave].iter().map(|value| value / d[leave]).collect();
        for i in (0..n).filter(|i| *i != leave) {
            inverse[i].iter_mut().zip(&pivot).for_each(|(a, b)| *a -= d[i] * b);
            x[i] = (x[i] - step * d[i]).max(0.0);
        }
        (inverse[leave], x[leave], basis[leave]) = (pivot, step, (enter, sign));
    }
    basis.iter().zip(&x).filter(|(_, x)| **x > 0.0).map(|((vertex, sign), x)| (*vertex, sign * x)).collect()
}
