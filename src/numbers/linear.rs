//! Which vectors does a matrix over a field send to zero?
//!
//! Gaussian elimination without rounding: ranks and null spaces are exact, or the world says why not.

use super::{Field, Trouble};

/// A matrix by its rows.
pub type Matrix<F> = Vec<Vec<F>>;

/// The product of two matrices.
///
/// # Errors
/// When the field's limits are passed.
pub fn product<F: Field>(a: &Matrix<F>, b: &Matrix<F>) -> Result<Matrix<F>, Trouble> {
    let columns = b.first().map_or(0, Vec::len);
    let entry = |row: &Vec<F>, column: usize| {
        let mut sum = F::whole(0);
        for (x, other) in row.iter().zip(b) {
            if !x.is_certainly_zero() && !other[column].is_certainly_zero() {
                sum = sum.plus(&x.times(&other[column])?)?;
            }
        }
        Ok(sum)
    };
    a.iter().map(|row| (0..columns).map(|column| entry(row, column)).collect()).collect()
}

/// The matrix with rows and columns exchanged.
pub fn transposed<F: Field>(a: &Matrix<F>) -> Matrix<F> {
    let columns = a.first().map_or(0, Vec::len);
    (0..columns).map(|column| a.iter().map(|row| row[column].clone()).collect()).collect()
}

/// A - x, on the diagonal.
///
/// # Errors
/// When the field's limits are passed.
pub fn shifted<F: Field>(a: &Matrix<F>, x: &F) -> Result<Matrix<F>, Trouble> {
    let mut shifted = a.clone();
    for (index, row) in shifted.iter_mut().enumerate() {
        row[index] = row[index].minus(x)?;
    }
    Ok(shifted)
}

/// The rows and columns of some indices.
pub fn part<F: Field>(a: &Matrix<F>, indices: &[usize]) -> Matrix<F> {
    indices.iter().map(|row| indices.iter().map(|column| a[*row][*column].clone()).collect()).collect()
}

/// A basis of the vectors v with A v = 0; their number is the columns' less the rank.
///
/// # Errors
/// When a pivot can't be divided by, or the field's limits are passed.
pub fn null_space<F: Field>(a: &Matrix<F>) -> Result<Vec<Vec<F>>, Trouble> {
    let columns = a.first().map_or(0, Vec::len);
    let mut rows = a.clone();
    let mut pivots: Vec<usize> = Vec::new();
    for column in 0..columns {
        let at = pivots.len();
        let Some(found) = (at..rows.len()).find(|row| !rows[*row][column].is_certainly_zero()) else { continue };
        rows.swap(at, found);
        eliminate(&mut rows, at, column)?;
        pivots.push(column);
    }
    let free = (0..columns).filter(|column| !pivots.contains(column));
    let vector = |column: usize| {
        let mut vector = vec![F::whole(0); columns];
        vector[column] = F::whole(1);
        for (row, pivot) in pivots.iter().enumerate() {
            vector[*pivot] = rows[row][column].negated();
        }
        vector
    };
    Ok(free.map(vector).collect())
}

/// Makes the pivot 1 and the rest of its column 0.
fn eliminate<F: Field>(rows: &mut [Vec<F>], at: usize, column: usize) -> Result<(), Trouble> {
    let inverse = F::whole(1).over(&rows[at][column])?;
    for entry in rows[at].iter_mut().skip(column) {
        if !entry.is_certainly_zero() {
            *entry = entry.times(&inverse)?;
        }
    }
    let pivot = rows[at].clone();
    for (index, row) in rows.iter_mut().enumerate() {
        if index == at || row[column].is_certainly_zero() {
            continue;
        }
        let factor = row[column].clone();
        for (entry, own) in row.iter_mut().zip(&pivot).skip(column) {
            if !own.is_certainly_zero() {
                *entry = entry.minus(&factor.times(own)?)?;
            }
        }
    }
    Ok(())
}
