//! Which vector does a singular matrix send to zero, in enclosures?
//!
//! Elimination with complete pivoting. Once all but one row have a pivot that is certainly not 0, the rank is at least
//! one less than the size; a matrix that is known to be singular then has just one null vector up to a factor, and its
//! component at the column left over is not 0: else the pivots' rows would make all of it 0. Set to 1, the pivots' rows
//! determine the others.

use super::signed::Signed;
use crate::numbers::Trouble;
use crate::numbers::linear::Matrix;
use std::cmp::Ordering;

/// The null vector of a square matrix that is known to be singular, with one component 1.
///
/// # Errors
/// When a pivot isn't certainly different from 0, or a limit of size is passed.
pub fn null_vector<F: Signed>(matrix: &Matrix<F>) -> Result<Vec<F>, Trouble> {
    let size = matrix.len();
    let mut rows = matrix.clone();
    let mut columns: Vec<usize> = (0..size).collect();
    for at in 0..size.saturating_sub(1) {
        let (row, column) = largest(&rows, &columns, at).ok_or(NO_PIVOT)?;
        rows.swap(at, row);
        columns.swap(at, column);
        let pivot = rows[at].clone();
        for row in rows.iter_mut().skip(at + 1).filter(|row| !row[columns[at]].is_certainly_zero()) {
            let factor = row[columns[at]].over(&pivot[columns[at]])?;
            for column in &columns[at..] {
                if !pivot[*column].is_certainly_zero() {
                    row[*column] = row[*column].minus(&factor.times(&pivot[*column])?)?;
                }
            }
        }
    }
    let mut vector = vec![F::whole(1); size];
    for at in (0..size.saturating_sub(1)).rev() {
        let mut sum = F::whole(0);
        for column in &columns[at + 1..] {
            sum = sum.plus(&rows[at][*column].times(&vector[*column])?)?;
        }
        vector[columns[at]] = sum.negated().over(&rows[at][columns[at]])?;
    }
    Ok(vector)
}

const NO_PIVOT: Trouble = Trouble::BeyondThisWorld("enclosures don't show that lambda has just one vector");

/// The place of the largest entry that is certainly not 0, among the rows and columns that have no pivot yet.
fn largest<F: Signed>(rows: &Matrix<F>, columns: &[usize], from: usize) -> Option<(usize, usize)> {
    let places = (from..rows.len()).flat_map(|row| (from..columns.len()).map(move |column| (row, column)));
    let entry = |(row, column): (usize, usize)| &rows[row][columns[column]];
    let certain = places.filter(|place| entry(*place).sign().is_some_and(Ordering::is_ne));
    certain.max_by(|a, b| entry(*a).approx().abs().total_cmp(&entry(*b).approx().abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::{Enclosure, Field};

    fn matrix(entries: &[[i64; 3]; 3]) -> Matrix<Enclosure<64>> {
        entries.iter().map(|row| row.iter().map(|value| Enclosure::whole(*value)).collect()).collect()
    }

    #[test]
    fn the_vector_is_sent_to_zero() {
        let singular = matrix(&[[1, 2, 3], [4, 5, 6], [7, 8, 9]]);
        let vector = null_vector(&singular).unwrap();
        // (1, -2, 1), with one component 1
        for (a, b) in [(0, 1), (2, 1)] {
            let ratio = vector[a].over(&vector[b]).unwrap().midpoint_f64();
            assert!((ratio + 0.5).abs() < 1e-15, "{vector:?}");
        }
    }

    #[test]
    fn a_matrix_of_smaller_rank_is_refused() {
        assert!(null_vector(&matrix(&[[1, 2, 3], [2, 4, 6], [3, 6, 9]])).is_err());
    }
}
