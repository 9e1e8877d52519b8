//! In which norm does every transition matrix shrink by q?
//!
//! The invariant polytope method (Guglielmi and Protasov, "Exact computation of joint spectral characteristics of linear operators",
//! 2013): the hull of the points and their negatives that come from a leading eigenvector, and of a small cross, which makes it
//! full-dimensional. Built in floating point; then the error of each combination is bounded and charged to the cross, so that the
//! bound holds for the exact matrices whatever the construction did.

use super::simplex::combination;
use super::transition::Exact;
use nalgebra::DMatrix;

/// Polytopes with more vertices are given up.
const MOST_VERTICES: usize = 400;
/// The size of the cross; the leading eigenvector has size 1.
const CROSS: f64 = 1.0 / 64.0;
/// Bounds the relative error of one operation in floating point, twice over.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Digit, vertex, and the weights of vertices that its image is made of.
pub type Combination = (usize, usize, Vec<(usize, f64)>);

/// A symmetric polytope with all T_e v_j in `bound` times itself.
#[derive(Clone, Debug)]
pub struct Polytope {
    /// The vertices; their negatives belong to it. The first n are `cross` times the unit vectors.
    pub vertices: Vec<Vec<f64>>,
    /// The size of the cross.
    pub cross: f64,
    /// The joint spectral radius is at most this.
    pub bound: f64,
    /// (e, j, weights): T_e v_j = sum alpha_l v_l + r with sum |alpha_l| + |r|_1/cross <= bound.
    pub combinations: Vec<Combination>,
}

/// The polytope of the eigenvectors `start` at the bound q (1 + slack); `None` where it doesn't close.
pub(super) fn polytope(matrices: &[Exact], start: &[Vec<f64>], q: f64, slack: f64) -> Option<Polytope> {
    let t: Vec<DMatrix<f64>> = matrices.iter().map(approximate).collect();
    let n = matrices[0].len();
    let unit = |i: usize| (0..n).map(|k| if k == i { CROSS } else { 0.0 }).collect::<Vec<f64>>();
    let mut vertices: Vec<Vec<f64>> = (0..n).map(unit).collect();
    vertices.extend(start.iter().cloned());
    let goal = q * (1.0 + slack);
    let mut next = 0;
    while next < vertices.len() {
        for matrix in &t {
            let y: Vec<f64> = applied(matrix, &vertices[next]).iter().map(|x| x / goal).collect();
            let cost: f64 = combination(&vertices, CROSS, &y).iter().map(|(_, alpha)| alpha.abs()).sum();
            if cost > 1.0 + 1e-10 {
                vertices.push(y);
            }
            if vertices.len() > MOST_VERTICES || !cost.is_finite() {
                return None;
            }
        }
        next += 1;
    }
    let mut found = Polytope { vertices, cross: CROSS, bound: 0.0, combinations: Vec::new() };
    for (e, matrix) in t.iter().enumerate() {
        for j in 0..found.vertices.len() {
            let y = applied(matrix, &found.vertices[j]);
            let weights = combination(&found.vertices, CROSS, &y);
            found.bound = found.bound.max(charge(matrix, &found, j, &weights));
            found.combinations.push((e, j, weights));
        }
    }
    found.bound.is_finite().then_some(found)
}

/// An upper bound of sum |alpha_l| + |T v_j - sum alpha_l v_l|_1/cross, all roundings included.
fn charge(matrix: &DMatrix<f64>, polytope: &Polytope, j: usize, weights: &[(usize, f64)]) -> f64 {
    let n = matrix.nrows();
    let v = &polytope.vertices[j];
    let mut rest = 0.0;
    for i in 0..n {
        let own = (0..n).map(|k| matrix[(i, k)] * v[k]);
        let others = weights.iter().map(|(l, alpha)| -alpha * polytope.vertices[*l][i]);
        let (sum, size) = own.chain(others).fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()));
        let terms = (n + weights.len() + 3) as f64;
        rest += f64::abs(sum) + terms * ROUNDING * size + f64::MIN_POSITIVE * terms;
    }
    let total = weights.iter().map(|(_, alpha)| alpha.abs()).sum::<f64>() + rest / polytope.cross;
    total * (1.0 + (2 * n + 8) as f64 * ROUNDING)
}

/// The nearest matrix of floating point.
pub(super) fn approximate(matrix: &Exact) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.len(), matrix.len(), |i, j| matrix[i][j].to_f64().value())
}

fn applied(matrix: &DMatrix<f64>, v: &[f64]) -> Vec<f64> {
    (0..v.len()).map(|i| (0..v.len()).map(|k| matrix[(i, k)] * v[k]).sum()).collect()
}
