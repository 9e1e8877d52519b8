//! Which finite matrices carry a refinement step over one unit of the parameter?
//!
//! T_e[i, j] = g(m i - j + e), e = 0..m-1, on the indices 0 <= i < n that hold the support (Daubechies and Lagarias, "Two-scale difference
//! equations II", 1992). Their products hold the coefficients of the iterated mask, so their joint spectral radius is that of the scheme.

use dashu_ratio::RBig;

/// A matrix of rational numbers, by rows.
pub(crate) type Exact = Vec<Vec<RBig>>;

/// The matrices T_0, ..., T_(m-1) of a mask that starts at index 0.
pub(crate) fn transition_matrices(g: &[RBig], arity: usize) -> Vec<Exact> {
    let n = g.len().saturating_sub(1).div_ceil(arity - 1).max(1);
    let entry = |i: usize, j: usize, e: usize| {
        (arity * i + e).checked_sub(j).and_then(|index| g.get(index)).cloned().unwrap_or(RBig::ZERO)
    };
    (0..arity).map(|e| (0..n).map(|i| (0..n).map(|j| entry(i, j, e)).collect()).collect()).collect()
}

/// The largest sum of moduli over a class of indices: the norm of one step of refinement.
pub(super) fn norm(g: &[RBig], step: usize) -> RBig {
    let mut sums = vec![RBig::ZERO; step];
    for (index, value) in g.iter().enumerate() {
        sums[index % step] += if *value < RBig::ZERO { -value.clone() } else { value.clone() };
    }
    sums.into_iter().max().unwrap_or(RBig::ZERO)
}

/// The product of some of the matrices, the first digit's rightmost.
pub(super) fn product(matrices: &[Exact], digits: &[usize]) -> Exact {
    let mut result = identity(matrices[0].len());
    for digit in digits {
        result = times(&matrices[*digit], &result);
    }
    result
}

/// The identity.
pub(super) fn identity(n: usize) -> Exact {
    (0..n).map(|i| (0..n).map(|j| if i == j { RBig::ONE } else { RBig::ZERO }).collect()).collect()
}

/// The product of two matrices.
pub(super) fn times(a: &Exact, b: &Exact) -> Exact {
    let cell = |row: &[RBig], j: usize| {
        row.iter().enumerate().filter(|(_, x)| !x.is_zero()).fold(RBig::ZERO, |sum, (k, x)| sum + x * &b[k][j])
    };
    a.iter().map(|row| (0..b[0].len()).map(|j| cell(row, j)).collect()).collect()
}

/// The matrix less x on the diagonal.
pub(super) fn less(a: &Exact, x: &RBig) -> Exact {
    let mut result = a.clone();
    result.iter_mut().enumerate().for_each(|(i, row)| row[i] -= x);
    result
}

/// The vectors that the matrix maps to zero.
pub(super) fn null_space(a: &Exact) -> Vec<Vec<RBig>> {
    let n = a.first().map_or(0, Vec::len);
    let mut rows = a.clone();
    let mut pivots = Vec::new();
    for column in 0..n {
        let top = pivots.len();
        let Some(found) = (top..rows.len()).find(|row| !rows[*row][column].is_zero()) else { continue };
        rows.swap(top, found);
        let scale = rows[top][column].clone();
        rows[top].iter_mut().for_each(|x| *x /= &scale);
        let pivot = rows[top].clone();
        for (row, cells) in rows.iter_mut().enumerate().filter(|(row, _)| *row != top) {
            let factor = cells[column].clone();
            if row != top && !factor.is_zero() {
                cells.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= &factor * p);
            }
        }
        pivots.push(column);
    }
    let free = (0..n).filter(|column| !pivots.contains(column));
    let vector = |column: usize| {
        let mut v = vec![RBig::ZERO; n];
        v[column] = RBig::ONE;
        pivots.iter().enumerate().for_each(|(row, pivot)| v[*pivot] = -rows[row][column].clone());
        v
    };
    free.map(vector).collect()
}
