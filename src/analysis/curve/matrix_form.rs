//! How does a spline's segment fall into two, in matrices?
//!
//! A segment of a uniform B-spline curve of degree d is (u^d, ..., u, 1) M p. On its first half u is halved, which is
//! S = diag(2^-d, ..., 1/2, 1), and the halves' points are H p with H = M^{-1} S M; on tensor products H G H^T (Catmull and Clark
//! 1978). M comes from the splines' recurrence, N_d(x) = x/d N_{d-1}(x) + (d + 1 - x)/d N_{d-1}(x - 1), and from no mask.

use crate::numbers::linear::{Matrix, null_space, product, transposed};
use crate::numbers::{Trouble, Univariate};
use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// The largest degree.
pub const MAX_DEGREE: usize = 30;

/// The matrices of one degree.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixForm {
    /// The basis matrix: rows are powers from u^d down, columns the points p_0 to p_d.
    pub basis: Matrix<RBig>,
    /// The diagonal of S.
    pub split: Vec<RBig>,
    /// H for the first half of the segment.
    pub first_half: Matrix<RBig>,
    /// The same for its second half, where u becomes (u + 1)/2.
    pub second_half: Matrix<RBig>,
}

/// The polynomials in u of N_d on [i, i + 1], x = i + u, for i = 0..d.
fn pieces(degree: usize) -> Result<Vec<Univariate<RBig>>, Trouble> {
    let linear = |constant: i64, slope: i64, over: usize| {
        let over = RBig::from(over as u64);
        Univariate::new(vec![RBig::from(constant) / &over, RBig::from(slope) / &over])
    };
    let mut pieces = vec![Univariate::constant(RBig::ONE)];
    for d in 1..=degree {
        let zero = Univariate::new(Vec::new());
        let at = |index: Option<usize>| index.and_then(|index| pieces.get(index)).unwrap_or(&zero);
        let mut next = Vec::with_capacity(d + 1);
        for i in 0..=d {
            let rising = linear(i as i64, 1, d).times(at(Some(i)))?;
            let falling = linear((d + 1 - i) as i64, -1, d).times(at(i.checked_sub(1)))?;
            next.push(rising.plus(&falling)?);
        }
        pieces = next;
    }
    Ok(pieces)
}

/// The inverse of a square matrix.
fn inverse(a: &Matrix<RBig>) -> Result<Matrix<RBig>, Trouble> {
    let size = a.len();
    // the null space of [A | -1] holds the columns of the inverse, one for each unit vector
    let wide: Matrix<RBig> = a
        .iter()
        .enumerate()
        .map(|(i, row)| {
            let unit = (0..size).map(|j| if i == j { -RBig::ONE } else { RBig::ZERO });
            row.iter().cloned().chain(unit).collect()
        })
        .collect();
    let columns: Matrix<RBig> = null_space(&wide)?.into_iter().map(|vector| vector[..size].to_vec()).collect();
    if columns.len() == size { Ok(transposed(&columns)) } else { Err(Trouble::DivisionByZero) }
}

/// (u + shift)/2 put for u, on coefficients from the highest power down.
fn substituted(degree: usize, shift: u64) -> Matrix<RBig> {
    // u^k becomes sum_m binom(k, m) u^m shift^(k - m)/2^k
    let mut rows = vec![vec![RBig::ZERO; degree + 1]; degree + 1];
    for k in 0..=degree {
        let mut binomial = RBig::ONE;
        for m in 0..=k {
            let power = if m < k { RBig::from(shift) } else { RBig::ONE };
            rows[degree - k][degree - m] = &binomial * power / RBig::from(2).pow(k as isize);
            binomial = binomial * RBig::from((k - m) as u64) / RBig::from((m + 1) as u64);
        }
    }
    rows
}

/// The matrices of a degree.
///
/// # Errors
/// When the degree is above [`MAX_DEGREE`].
pub fn matrix_form(degree: usize) -> Result<MatrixForm, Trouble> {
    if degree > MAX_DEGREE {
        return Err(Trouble::BeyondThisWorld("the degree is too high for the matrix form"));
    }
    // on a segment p_j is weighed by N_d(u + d - j)
    let pieces = pieces(degree)?;
    let coefficient = |power: usize, j: usize| {
        let own = pieces[degree - j].coefficients().get(power);
        own.cloned().unwrap_or(RBig::ZERO)
    };
    let basis: Matrix<RBig> =
        (0..=degree).rev().map(|power| (0..=degree).map(|j| coefficient(power, j)).collect()).collect();
    let back = inverse(&basis)?;
    // the row vector of powers at (u + shift)/2 is the row vector at u times the transpose of the substitution
    let half = |shift: u64| product(&product(&back, &transposed(&substituted(degree, shift)))?, &basis);
    let split = (0..=degree).rev().map(|power| RBig::ONE / RBig::from(2).pow(power as isize)).collect();
    let (first_half, second_half) = (half(0)?, half(1)?);
    Ok(MatrixForm { basis, split, first_half, second_half })
}

/// The matrix H of a mask: how the d + 1 points of the first half of a segment are made, where the mask has d + 2 weights.
pub fn half_of_mask(mask: &Mask) -> Matrix<RBig> {
    let size = mask.coefficients.len().saturating_sub(1) as i64;
    let first = mask.first;
    // the points p_0..p_{size-1} carry one segment; the first new index whose old points are all there begins its first half
    let start = first + size - 1;
    (0..size).map(|i| (0..size).map(|j| mask.get(start + i - 2 * j)).collect()).collect()
}

/// The degree whose B-spline a binary mask makes, found by comparing with H; `None` where it makes none.
pub fn spline_degree(mask: &Mask) -> Option<usize> {
    let degree = mask.coefficients.len().checked_sub(2).filter(|degree| (1..=MAX_DEGREE).contains(degree))?;
    let same = mask.arity == 2 && matrix_form(degree).ok()?.first_half == half_of_mask(mask);
    same.then_some(degree)
}

/// H G H^T: the net of the first quadrant of a tensor-product patch.
///
/// # Errors
/// When the shapes don't fit.
pub fn quadrant(h: &Matrix<RBig>, net: &Matrix<RBig>, k: &Matrix<RBig>) -> Result<Matrix<RBig>, Trouble> {
    if net.len() != h.len() || net.iter().any(|row| row.len() != k.len()) {
        return Err(Trouble::Domain("the net doesn't fit the matrices"));
    }
    product(&product(h, net)?, &transposed(k))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn over(denominator: i64, rows: &[&[i64]]) -> Matrix<RBig> {
        let value = |entry: &i64| RBig::from(*entry) / RBig::from(denominator);
        rows.iter().map(|row| row.iter().map(value).collect()).collect()
    }

    /// The cubic matrices as printed by Ma and others for Catmull and Clark's derivation.
    #[test]
    fn the_cubic_matrices() {
        let form = matrix_form(3).unwrap();
        assert_eq!(form.basis, over(6, &[&[-1, 3, -3, 1], &[3, -6, 3, 0], &[-3, 0, 3, 0], &[1, 4, 1, 0]]));
        assert_eq!(form.split, over(8, &[&[1, 2, 4, 8]])[0]);
        assert_eq!(form.first_half, over(8, &[&[4, 4, 0, 0], &[1, 6, 1, 0], &[0, 4, 4, 0], &[0, 1, 6, 1]]));
        assert_eq!(form.second_half, over(8, &[&[1, 6, 1, 0], &[0, 4, 4, 0], &[0, 1, 6, 1], &[0, 0, 4, 4]]));
    }

    #[test]
    fn degrees_beyond_the_limit_are_declined() {
        assert!(matrix_form(31).is_err());
        assert!(quadrant(&over(1, &[&[1]]), &over(1, &[&[1, 2]]), &over(1, &[&[1]])).is_err());
    }
}
