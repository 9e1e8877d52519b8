//! What does a tensor product make of a grid of points?
//!
//! Every row is refined by the second scheme, then every column by the first; the order does not matter.

use super::curve::{CurveRefiner, NotRefinableCurve};

/// A rectangular grid of points, row by row; open along both indices.
pub type Grid = Vec<Vec<[f64; 3]>>;

/// What makes a line of points of another.
pub type Making<'a, E> = &'a dyn Fn(&[[f64; 3]]) -> Result<Vec<[f64; 3]>, E>;

/// Rows and columns exchanged. Rows of unequal length are cut to the shortest.
pub fn transposed(grid: &Grid) -> Grid {
    let columns = grid.iter().map(Vec::len).min().unwrap_or(0);
    (0..columns).map(|column| grid.iter().map(|row| row[column]).collect()).collect()
}

/// One step.
///
/// # Errors
/// When a row or a column has too few points.
pub fn step(grid: &Grid, schemes: [&CurveRefiner; 2]) -> Result<Grid, NotRefinableCurve> {
    along_both(grid, &|row| schemes[1].step(row, false), &|column| schemes[0].step(column, false))
}

/// What one makes of each row, and then another of each column.
///
/// # Errors
/// Those of the two.
pub fn along_both<E>(grid: &Grid, of_row: Making<E>, of_column: Making<E>) -> Result<Grid, E> {
    let rows: Grid = grid.iter().map(|row| of_row(row)).collect::<Result<_, E>>()?;
    let columns: Grid = transposed(&rows).iter().map(|column| of_column(column)).collect::<Result<_, E>>()?;
    Ok(transposed(&columns))
}
