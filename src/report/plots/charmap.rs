//! What does the characteristic map's control net look like?

use super::canvas::{Anchor, Area, At, Canvas, SMALL, TEXT, View, colours, columns, draw, grid};
use super::fan::edges_among;
use super::{MapPanel, Picture, RINGS};
use crate::mesh::{Label, Lattice, Patch};
use crate::numbers::RootsOfUnity;
use crate::refine::Obstacle;
use num_complex::Complex64;
use std::collections::{BTreeMap, BTreeSet};

pub(super) fn picture(lattice: Lattice, panels: &[MapPanel], rest: &str) -> Result<Picture, Obstacle> {
    let (areas, height) = layout(panels.len(), 0);
    let svg = draw(height, |canvas| {
        for (panel, area) in panels.iter().zip(areas) {
            title(canvas, area, panel.analysis.valence);
            if panel.is_too_fine() {
                canvas.text("too fine to draw", content(area).middle(), SMALL, Anchor::Middle);
                continue;
            }
            match net(lattice, panel) {
                Some(points) => draw_net(canvas, content(area), lattice, panel.analysis.valence, &points),
                None => canvas.text("no characteristic map", content(area).middle(), SMALL, Anchor::Middle),
            }
        }
    })?;
    let caption = format!(
        "Control nets of the characteristic maps, rings 0 to {RINGS}, each valence at its own scale; the innermost ring is \
         drawn dark.{rest}"
    );
    Ok(Picture { name: "characteristic-map", caption, svg })
}

/// The panels of a picture with one for each valence, and its height; `foot` is left free below them.
pub(super) fn layout(count: usize, foot: i32) -> (Vec<Area>, i32) {
    let columns = columns(count);
    let height = if columns == 1 { 900 } else { 1200 / columns as i32 + TITLE };
    let rows = count.div_ceil(columns) as i32;
    (grid(count, columns, 0, height), rows * height + foot)
}

const TITLE: i32 = 56;

/// The title of a panel for a valence.
pub(super) fn title(canvas: &mut Canvas, area: Area, valence: usize) {
    canvas.text(&format!("n = {valence}"), (area.middle().0, area.y + 34), TEXT, Anchor::Middle);
}

/// What is left of the panel below its title.
pub(super) fn content(area: Area) -> Area {
    area.below(TITLE).inset(12, 12)
}

/// The net's points in all sectors; `None` when the map, or a part of the net, is not determined.
fn net(lattice: Lattice, panel: &MapPanel) -> Option<BTreeMap<Label, Complex64>> {
    let picture = panel.picture.as_ref()?;
    let patch = Patch::new(lattice, panel.analysis.valence);
    let roots = RootsOfUnity::new(patch.valence as usize);
    let mut points: BTreeMap<Label, Complex64> =
        patch.centre().map(|centre| (centre, Complex64::ZERO)).into_iter().collect();
    for ((i, j), point) in &picture.net {
        for sector in 0..patch.valence {
            points.insert(patch.point(sector, *i, *j), point * roots.get(i64::from(sector)));
        }
    }
    (!picture.net.is_empty() && points.values().all(|point| point.is_finite())).then_some(points)
}

fn draw_net(canvas: &mut Canvas, area: Area, lattice: Lattice, valence: usize, points: &BTreeMap<Label, Complex64>) {
    let patch = Patch::new(lattice, valence);
    let view = View::of(points.values().copied(), area);
    let labels: BTreeSet<Label> = points.keys().copied().collect();
    let inner = |label: &Label| lattice.ring(label.i, label.j) <= i32::from(lattice.has_centre());
    let (dark, light): (Vec<_>, Vec<_>) =
        edges_among(&patch, &labels).into_iter().partition(|(a, b)| inner(a) && inner(b));
    let ends = |(a, b): &(Label, Label)| -> (At, At) { (view.at(points[a]), view.at(points[b])) };
    for (from, to) in light.iter().map(ends) {
        canvas.line(from, to, colours::GREY, 2);
    }
    for (from, to) in dark.iter().map(ends) {
        canvas.line(from, to, colours::BLUE, 4);
    }
}
