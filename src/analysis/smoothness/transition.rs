//! How does one step act on so few points that they make the next ones by themselves?
//!
//! Let b_0, ..., b_N be a mask of arity a and n = max(1, ceil(N/(a-1))). Then n neighbouring points decide n + a - 1 neighbouring ones of
//! the next level, and T_e takes them to those from the e-th on: (T_e)_{ij} = b_{i + e + N - a + 1 - a j}, e = 0, ..., a - 1. Every row of L steps
//! is a row of a product of L of these matrices, and every product is made of such rows; so the norms grow alike (Daubechies and Lagarias 1992).

use crate::numbers::linear::Matrix;
use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// The transition matrices T_0, ..., T_{a-1}.
pub fn transitions(mask: &Mask) -> Vec<Matrix<RBig>> {
    let a = i64::from(mask.arity);
    let last = mask.coefficients.len() as i64 - 1;
    let size = ((last + a - 2) / (a - 1)).max(1);
    let entry = |e: i64, i: i64, j: i64| mask.get(mask.first + i + e + last - a + 1 - a * j);
    let matrix = |e: i64| (0..size).map(|i| (0..size).map(|j| entry(e, i, j)).collect()).collect();
    (0..a).map(matrix).collect()
}

/// A matrix of floating numbers, row by row.
pub type Floats = Vec<Vec<f64>>;

/// The nearest floating numbers.
pub fn floats(matrix: &Matrix<RBig>) -> Floats {
    matrix.iter().map(|row| row.iter().map(|value| value.to_f64().value()).collect()).collect()
}

/// A matrix times a vector.
pub fn image(matrix: &Floats, x: &[f64]) -> Vec<f64> {
    matrix.iter().map(|row| dot(row, x)).collect()
}

/// The sum of products.
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// A matrix times a vector, exactly.
pub fn exact_image(matrix: &Matrix<RBig>, x: &[RBig]) -> Vec<RBig> {
    let entry = |row: &Vec<RBig>| {
        let used = row.iter().zip(x).filter(|(r, x)| !r.is_zero() && !x.is_zero());
        used.fold(RBig::ZERO, |sum, (r, x)| sum + r * x)
    };
    matrix.iter().map(entry).collect()
}
