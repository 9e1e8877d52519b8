//! What are the masks and the spectrum of a tensor product?
//!
//! Products: a_{ij} = a_i b_j, limit masks likewise, and the local matrix is the Kronecker product of the factors', so that its eigenvalues
//! are all products of theirs. A grid is regular everywhere: it has no extraordinary point.

use crate::numbers::linear::Matrix;
use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// A mask on a grid: rows go with the first index.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GridMask {
    /// The index of the first row and of the first column.
    pub first: [i64; 2],
    /// The arity along each index.
    pub arity: [u32; 2],
    /// The weights.
    pub weights: Vec<Vec<RBig>>,
}

/// The product of two masks.
pub fn product_mask(a: &Mask, b: &Mask) -> GridMask {
    let row = |x: &RBig| b.coefficients.iter().map(|y| x * y).collect();
    GridMask { first: [a.first, b.first], arity: [a.arity, b.arity], weights: a.coefficients.iter().map(row).collect() }
}

/// The weights of one kind of new point, on the old points in their order along both indices.
pub fn submask(a: &Mask, b: &Mask, kind: [i64; 2]) -> Matrix<RBig> {
    let (rows, columns) = (a.submask(kind[0]), b.submask(kind[1]));
    rows.iter().map(|(_, x)| columns.iter().map(|(_, y)| x * y).collect()).collect()
}

/// The Kronecker product of two matrices.
pub fn kronecker(a: &Matrix<RBig>, b: &Matrix<RBig>) -> Matrix<RBig> {
    let rows = a.iter().flat_map(|x| b.iter().map(move |y| (x, y)));
    rows.map(|(x, y)| x.iter().flat_map(|p| y.iter().map(move |q| p * q)).collect()).collect()
}
