//! `refine` and `limit` with a tensor product: what becomes of this grid of points?

use super::curve::{format_of, load};
use super::mesh_file::save;
use super::{Failure, failure, say};
use eigenring::analysis::curve::limit::CurveLimits;
use eigenring::mesh::io::curve::{CurveFormat, Style, write};
use eigenring::mesh::io::{Format, Output};
use eigenring::mesh::{Faces, Polygon};
use eigenring::refine::curve::{CurveRefiner, MAX_REFINED};
use eigenring::refine::grid::{Grid, along_both, step};
use eigenring::report::write_in_pieces;
use eigenring::scheme::grid::GridScheme;
use std::path::Path;

/// Refines the grid of a file, whose polygons are its rows, or pushes its points to the limit. A mesh format gets its faces.
pub(crate) fn refine(
    scheme: &GridScheme,
    (input, out): (&Path, &Path),
    levels: usize,
    to_limit: bool,
) -> Result<(), Failure> {
    let title = &scheme.book.title;
    let mut grid: Grid = load(input, false)?.into_iter().map(|polygon| polygon.points).collect();
    if grid.len() < 2 || grid.iter().any(|row| row.len() != grid[0].len()) {
        let message =
            format!("`{}` is no grid: its polygons are the rows, two or more of the same length", input.display());
        return Err(failure(format!("{message}\n  help: in a CSV file leave an empty line between two rows")));
    }
    let [a, b] = scheme.curves()?;
    let (a, b) = (a.rules()?, b.rules()?);
    let refiners = [CurveRefiner::new(&a), CurveRefiner::new(&b)];
    let wrong = |wrong: eigenring::refine::curve::NotRefinableCurve| failure(format!("{title}: {wrong}"));
    for made in 0..levels {
        let next = grid.len() * refiners[0].arity() * grid[0].len() * refiners[1].arity();
        if next > MAX_REFINED {
            return Err(failure(format!(
                "{levels} steps make more than {MAX_REFINED} points\n  help: --levels {made} fits"
            )));
        }
        grid = step(&grid, [&refiners[0], &refiners[1]]).map_err(wrong)?;
    }
    if to_limit {
        let limits = [CurveLimits::new(&a).map_err(failure)?, CurveLimits::new(&b).map_err(failure)?];
        let of = |limits: &CurveLimits, points: &[[f64; 3]]| limits.of(points, false);
        grid = along_both(&grid, &|row| of(&limits[1], row), &|column| of(&limits[0], column)).map_err(wrong)?;
    }
    say(&format!("{title}: {} x {} points", grid.len(), grid[0].len()));
    if Format::of_path(out).is_some() { save_mesh(out, &grid) } else { save_rows(input, out, grid) }
}

fn save_mesh(out: &Path, grid: &Grid) -> Result<(), Failure> {
    let columns = grid[0].len();
    let positions: Vec<[f64; 3]> = grid.concat();
    if positions.len() > eigenring::mesh::MAX_CORNERS / 4 {
        return Err(failure("the grid has too many points for a mesh\n  help: write it as CSV"));
    }
    let corner = |row: usize, column: usize| (row * columns + column) as u32;
    let quads = (1..grid.len()).flat_map(|row| (1..columns).map(move |column| (row, column)));
    let corners = quads.flat_map(|(row, column)| {
        [corner(row - 1, column - 1), corner(row, column - 1), corner(row, column), corner(row - 1, column)]
    });
    let faces = Faces::same(4, corners.collect());
    save(out, &Output::new(positions.as_slice(), &faces))
}

fn save_rows(input: &Path, out: &Path, grid: Grid) -> Result<(), Failure> {
    let rows: Vec<Polygon> = grid.into_iter().map(|points| Polygon { points, closed: false, dimension: 3 }).collect();
    let style = Style { upwards: CurveFormat::of_path(input) != Some(CurveFormat::Svg) };
    let format = format_of(out)?;
    write_in_pieces(out, |file| write(format, &rows, style, file))
        .map_err(|error| failure(format!("`{}` can't be written: {error}", out.display())))
}
