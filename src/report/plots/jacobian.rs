//! Is the characteristic map regular?
//!
//! It is where its Jacobian is positive. The samples of the closed ring segment, in all sectors; a cell shows the least of
//! its samples.

use super::canvas::{Anchor, Area, At, Canvas, SMALL, View, colours, draw, text_width};
use super::charmap::{content, layout, title};
use super::{MapPanel, Picture};
use crate::analysis::charmap::Sample;
use crate::mesh::{Lattice, Patch};
use crate::numbers::RootsOfUnity;
use crate::refine::Obstacle;
use num_complex::Complex64;
use plotters::style::RGBColor;
use std::collections::BTreeMap;

/// The shades of positive values, least first, in equal steps up to the largest.
const SHADES: [RGBColor; 5] = [
    RGBColor(214, 232, 244),
    RGBColor(166, 206, 229),
    RGBColor(107, 174, 214),
    RGBColor(44, 135, 190),
    RGBColor(0, 90, 150),
];

/// The samples of sector 0 from one distance to the dilation times that, shown by cells that are `step` samples wide.
struct Ring<'a> {
    samples: &'a [Sample],
    /// The outer distance.
    outer: i32,
    step: i32,
}

/// A cell: its corners in the plane of sector 0, and its shade.
struct Cell {
    corners: Vec<Complex64>,
    shade: Option<usize>,
}

pub(super) fn picture(lattice: Lattice, panels: &[MapPanel], rest: &str) -> Result<Picture, Obstacle> {
    let (areas, height) = layout(panels.len(), 90);
    let svg = draw(height, |canvas| {
        for (panel, area) in panels.iter().zip(areas) {
            title(canvas, area, panel.analysis.valence);
            match panel.picture.as_ref().and_then(|picture| picture.samples.as_ref()) {
                Some((scale, samples)) => {
                    let valence = panel.analysis.valence;
                    let outer = samples.iter().map(|sample| lattice.ring(sample.at.0, sample.at.1)).max().unwrap_or(0);
                    let ring = Ring { samples, outer, step: step(*scale, panels.len(), valence) };
                    draw_ring(canvas, content(area), lattice, valence, &ring);
                }
                None => words(canvas, content(area), panel),
            }
        }
        legend(canvas, height - 50);
    })?;
    let caption = format!(
        "The image of the characteristic map's ring, shaded by its Jacobian determinant relative to the largest of the \
         valence, at samples (approximate). A cell shows the least of its samples; where that is not positive, the map is not regular.{rest}"
    );
    Ok(Picture { name: "jacobian", caption, svg })
}

/// How many samples a cell is wide: small panels, and those with many sectors, have large cells.
fn step(scale: i32, panels: usize, valence: usize) -> i32 {
    let cells = match (panels, valence) {
        (_, 25..) => 2,
        (5.., _) => 4,
        _ => 8,
    };
    (scale / cells).max(1)
}

fn words(canvas: &mut Canvas, area: Area, panel: &MapPanel) {
    let (first, second) = match &panel.picture {
        _ if panel.is_too_fine() => ("too fine", "to draw"),
        Some(_) => ("no regular", "tangent masks"),
        None => ("no characteristic", "map"),
    };
    let (x, y) = area.middle();
    canvas.text(first, (x, y - 20), SMALL, Anchor::Middle);
    canvas.text(second, (x, y + 20), SMALL, Anchor::Middle);
}

fn draw_ring(canvas: &mut Canvas, area: Area, lattice: Lattice, valence: usize, ring: &Ring) {
    let patch = Patch::new(lattice, valence);
    let roots = RootsOfUnity::new(patch.valence as usize);
    let turned = |point: Complex64, sector: u32| point * roots.get(i64::from(sector));
    let all = ring.samples.iter().flat_map(|sample| (0..patch.valence).map(move |sector| turned(sample.point, sector)));
    let view = View::of(all, area);
    let (regular, others): (Vec<Cell>, Vec<Cell>) =
        cells(lattice, &roots, ring).into_iter().partition(|cell| cell.shade.is_some());
    for cell in regular.iter().chain(&others) {
        for sector in 0..patch.valence {
            let corners: Vec<At> = cell.corners.iter().map(|point| view.at(turned(*point, sector))).collect();
            draw_cell(canvas, &corners, cell.shade);
        }
    }
}

fn draw_cell(canvas: &mut Canvas, corners: &[At], shade: Option<usize>) {
    match shade {
        Some(shade) => canvas.polygon(&grown(corners), SHADES[shade]),
        None => {
            canvas.polygon(corners, colours::VERMILLION);
            canvas.outline(corners, colours::BLACK, 2);
        }
    }
}

/// A polygon with its sides a little further out: no seams are seen between neighbours.
fn grown(corners: &[At]) -> Vec<At> {
    let points: Vec<Complex64> = corners.iter().map(|(x, y)| Complex64::new(f64::from(*x), f64::from(*y))).collect();
    let count = points.len();
    let area: f64 = (0..count).map(|k| (points[k].conj() * points[(k + 1) % count]).im).sum();
    // across the side that leaves a corner, of length 1
    let outward = |k: usize| {
        let side = points[(k + 1) % count] - points[k];
        Complex64::new(side.im, -side.re) * area.signum() / side.norm_sqr().sqrt().max(1.0)
    };
    let moved = |k: usize| {
        let (before, after) = (outward((k + count - 1) % count), outward(k));
        let mitre = (before + after) / (1.0 + (before.conj() * after).re).max(0.4);
        let point = points[k] + mitre;
        (point.re.round() as i32, point.im.round() as i32)
    };
    (0..count).map(moved).collect()
}

/// The cells of sector 0 and those between it and sector 1, row by row.
fn cells(lattice: Lattice, roots: &RootsOfUnity, ring: &Ring) -> Vec<Cell> {
    let by_place: BTreeMap<(i32, i32), &Sample> = ring.samples.iter().map(|sample| (sample.at, sample)).collect();
    let largest = ring.samples.iter().map(|sample| sample.jacobian.abs()).fold(0.0, f64::max);
    let at = |(i, j): (i32, i32)| match by_place.get(&(i, j)) {
        // beyond the corner of a central face lies the next sector
        None if i == -1 && !lattice.has_centre() => by_place.get(&(j, 0)).map(|s| (s.point * roots.get(1), s.jacobian)),
        sample => sample.map(|s| (s.point, s.jacobian)),
    };
    let between = if lattice.has_centre() { None } else { Some((-1, 1)) };
    let columns = (0..ring.outer).step_by(ring.step as usize).map(|i| (i, ring.step));
    let squares = between
        .into_iter()
        .chain(columns)
        .flat_map(|column| (0..ring.outer).step_by(ring.step as usize).map(move |j| (column, (j, ring.step))));
    let mut cells = Vec::new();
    for (corners, inside) in squares.flat_map(|(column, row)| shapes(lattice, column, row)) {
        let Some(corners) = corners.into_iter().map(|place| Some(at(place)?.0)).collect::<Option<Vec<_>>>() else {
            continue;
        };
        let least = inside.into_iter().filter_map(at).map(|(_, jacobian)| jacobian).fold(f64::INFINITY, f64::min);
        cells.push(Cell { corners, shade: shade(least, largest) });
    }
    cells
}

/// Places on the lattice.
type Places = Vec<(i32, i32)>;

/// The cells on a rectangle of the lattice, given by start and length in each coordinate: their corners, and all of the
/// places in them.
fn shapes(lattice: Lattice, (i, width): (i32, i32), (j, height): (i32, i32)) -> Vec<(Places, Places)> {
    let all = || (0..=height).flat_map(move |dj| (0..=width).map(move |di| (di, dj)));
    let placed = |within: &dyn Fn(i32) -> bool| -> Places {
        all().filter(|(di, dj)| within(di + dj)).map(|(di, dj)| (i + di, j + dj)).collect()
    };
    let [a, b, c, d] = [(i, j), (i + width, j), (i + width, j + height), (i, j + height)];
    match lattice {
        Lattice::Triangles => {
            vec![(vec![a, b, d], placed(&|sum| sum <= width)), (vec![b, c, d], placed(&|sum| sum >= width))]
        }
        _ => vec![(vec![a, b, c, d], placed(&|_| true))],
    }
}

/// `None` for a value that is not positive.
fn shade(value: f64, largest: f64) -> Option<usize> {
    let steps = SHADES.len();
    (value > 0.0).then(|| ((value / largest * steps as f64) as usize).min(steps - 1))
}

fn legend(canvas: &mut Canvas, y: i32) {
    let mut x = 60;
    canvas.text("Jacobian: 0", (x, y), SMALL, Anchor::Left);
    x += text_width("Jacobian: 0", SMALL) + 16;
    for shade in 0..SHADES.len() {
        draw_cell(canvas, &square(x, y), Some(shade));
        x += 44;
    }
    canvas.text("largest", (x + 16, y), SMALL, Anchor::Left);
    x += 16 + text_width("largest", SMALL) + 90;
    draw_cell(canvas, &square(x, y), None);
    canvas.text("not positive", (x + 60, y), SMALL, Anchor::Left);
}

fn square(x: i32, y: i32) -> [At; 4] {
    [(x, y - 20), (x + 44, y - 20), (x + 44, y + 20), (x, y + 20)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cells_of_a_ring_fill_it() {
        // the identity on the regular lattices
        for (lattice, valence, area) in
            [(Lattice::Quads, 4, 12.0), (Lattice::Dual, 4, 14.0), (Lattice::Triangles, 6, 12.0 * 3.0_f64.sqrt() / 4.0)]
        {
            let samples = identity(lattice, valence);
            for step in [1, 2] {
                let ring = Ring { samples: &samples, outer: 4, step };
                let cells = cells(lattice, &RootsOfUnity::new(valence), &ring);
                let total: f64 = cells.iter().map(|cell| size(&cell.corners)).sum();
                assert!((total - area).abs() < 1e-12, "{lattice:?} {step} {total}");
                let bad = cells.iter().filter(|cell| cell.shade.is_none()).count();
                assert!(bad > 0 && bad < cells.len(), "a value that is not positive is seen at every step");
            }
        }
    }

    fn identity(lattice: Lattice, valence: usize) -> Vec<Sample> {
        let fan = super::super::fan::Fan::new(lattice, valence);
        let grid = (0..=4).flat_map(|j| (0..=4).map(move |i| (i, j)));
        let inside = grid.filter(|(i, j)| (2..=4).contains(&lattice.ring(*i, *j)));
        let sample = |at: (i32, i32)| Sample {
            at,
            point: fan.at(crate::mesh::Label { sector: 0, i: at.0, j: at.1 }),
            jacobian: if at == (3, 1) { 0.0 } else { 1.0 },
        };
        inside.map(sample).collect()
    }

    fn size(corners: &[Complex64]) -> f64 {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| (a.conj() * b).im).sum::<f64>() / 2.0
    }
}
