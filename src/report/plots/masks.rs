//! Which points of the neighbourhood pull at the limit point and at its tangents, and how strongly?

use super::canvas::{Anchor, Area, At, Canvas, Marker, SMALL, TEXT, View, colours, draw, grid};
use super::fan::{Fan, edges_among};
use super::labels::{Labelled, set};
use super::{MAX_SECTORS, Picture};
use crate::analysis::Analysis;
use crate::analysis::masks::Mask;
use crate::mesh::{Label, Lattice};
use crate::refine::Obstacle;
use std::collections::{BTreeMap, BTreeSet};

/// Beyond this valence the weights' numbers would cover each other.
const MAX_NUMBERED: usize = 12;

/// The radius of the largest weight's dot.
const LARGEST: f64 = 22.0;

/// A weight below this part of the largest is shown as none.
const NOTHING: f64 = 1e-9;

pub(super) fn picture(lattice: Lattice, analyses: &[Analysis]) -> Result<Picture, Obstacle> {
    let Some(analysis) = chosen(lattice, analyses) else {
        let svg = draw(200, |_| ())?;
        return Ok(Picture { name: "masks", caption: String::new(), svg });
    };
    let tangents = analysis.tangent_masks.as_ref();
    let masks = [
        ("limit mask", analysis.limit_mask.as_ref()),
        ("tangent mask, cosine form", tangents.map(|[cosine, _]| cosine)),
        ("tangent mask, sine form", tangents.map(|[_, sine]| sine)),
    ];
    let most = masks.iter().filter_map(|(_, mask)| Some(weights((*mask)?, analysis).len())).max().unwrap_or(0);
    let layout = Layout::of(most);
    let svg = draw(layout.height, |canvas| {
        for ((title, mask), area) in masks.iter().zip(layout.panels) {
            canvas.text(title, (area.middle().0, area.y + 36), TEXT, Anchor::Middle);
            let inside = area.below(60).inset(16, 16);
            match mask {
                Some(_) if analysis.valence > MAX_SECTORS => {
                    canvas.text("too fine to draw", inside.middle(), SMALL, Anchor::Middle);
                }
                Some(mask) => draw_mask(canvas, inside, lattice, analysis, mask),
                None => canvas.text("not determined", inside.middle(), SMALL, Anchor::Middle),
            }
        }
        legend(canvas, layout.legend, layout.legend_step, analysis.valence);
    })?;
    Ok(Picture { name: "masks", caption: caption(analysis.valence), svg })
}

/// Where things stand.
struct Layout {
    height: i32,
    panels: Vec<Area>,
    legend: At,
    /// From one line of the legend to the next.
    legend_step: At,
}

impl Layout {
    /// Masks with few weights go side by side, with the legend in the fourth place; others get the whole width.
    fn of(weights: usize) -> Layout {
        if weights <= FEW {
            let panels = grid(3, 2, 0, 640);
            return Layout { height: 1280, panels, legend: (730, 850), legend_step: (0, 65) };
        }
        Layout { height: 2790, panels: grid(3, 1, 0, 900), legend: (70, 2735), legend_step: (290, 0) }
    }
}

/// How many weights a small panel holds.
const FEW: usize = 13;

fn caption(valence: usize) -> String {
    let numbers = if valence <= MAX_NUMBERED { " with the weights beside them" } else { "" };
    format!(
        "The limit mask and the two tangent masks at valence {valence}{numbers}: the area of a dot grows with the weight's \
         modulus; filled dots are positive, open squares negative, small grey dots zero."
    )
}

/// The first valence with tangent masks that is not the regular one, else the first that is not, else the first; the smallest
/// where that one is too large for numbers.
fn chosen(lattice: Lattice, analyses: &[Analysis]) -> Option<&Analysis> {
    let irregular = || analyses.iter().filter(|analysis| analysis.valence != lattice.regular_valence());
    let irregular = irregular().find(|analysis| analysis.tangent_masks.is_some()).or(irregular().next());
    let first = irregular.or(analyses.first())?;
    let smallest = analyses.iter().min_by_key(|analysis| analysis.valence)?;
    Some(if first.valence > MAX_NUMBERED && smallest.valence <= MAX_NUMBERED { smallest } else { first })
}

fn draw_mask(canvas: &mut Canvas, area: Area, lattice: Lattice, analysis: &Analysis, mask: &Mask) {
    let fan = Fan::new(lattice, analysis.valence);
    let weights = weights(mask, analysis);
    let shown = neighbourhood(lattice, analysis, &weights);
    let view = View::of(shown.iter().map(|label| fan.at(*label)), area.inset(90, 50)).at_most(230.0);
    let at = |label: &Label| view.at(fan.at(*label));
    let lines: Vec<(At, At)> = edges_among(&fan.patch, &shown).iter().map(|(a, b)| (at(a), at(b))).collect();
    for (from, to) in &lines {
        canvas.line(*from, *to, colours::PALE, 3);
    }
    let largest = weights.values().map(|weight| weight.abs()).fold(0.0, f64::max);
    let mut labelled = Vec::new();
    let mut zeros = Vec::new();
    for label in &shown {
        match weights.get(label) {
            Some(weight) => labelled.push(draw_weight(canvas, at(label), *weight, largest, analysis.valence)),
            None => {
                canvas.marker(Marker::Circle, at(label), 5, colours::GREY, None);
                zeros.push((at(label), 5));
            }
        }
    }
    set(canvas, area, &labelled, &lines, &zeros, SMALL);
}

/// The weights that are not zero.
fn weights(mask: &Mask, analysis: &Analysis) -> BTreeMap<Label, f64> {
    let all = mask.weights(&analysis.local);
    let largest = all.iter().map(|(_, weight)| weight.abs()).fold(0.0, f64::max);
    all.into_iter().filter(|(_, weight)| weight.abs() > NOTHING * largest).collect()
}

/// The points of the mask's rings, and the first ring at least.
fn neighbourhood(lattice: Lattice, analysis: &Analysis, weights: &BTreeMap<Label, f64>) -> BTreeSet<Label> {
    let patch = analysis.local.patch;
    let ring = |label: &Label| lattice.ring(label.i, label.j);
    let first = i32::from(lattice.has_centre());
    let last = weights.keys().map(ring).max().unwrap_or(first).max(first);
    let orbits =
        (first..=last).flat_map(|i| (0..=last).map(move |j| (i, j))).filter(|(i, j)| lattice.ring(*i, *j) <= last);
    let points = orbits.flat_map(|(i, j)| (0..patch.valence).map(move |sector| Label { sector, i, j }));
    points.chain(patch.centre()).collect()
}

fn draw_weight(canvas: &mut Canvas, at: At, weight: f64, largest: f64, valence: usize) -> Labelled {
    let radius = ((weight.abs() / largest).sqrt() * LARGEST).round().max(4.0) as i32;
    if weight > 0.0 {
        canvas.marker(Marker::Circle, at, radius, colours::BLUE, None);
    } else {
        let square = (radius * 9 / 10).max(5);
        canvas.marker(Marker::Square, at, square, colours::WHITE, None);
        canvas.marker(Marker::Square, at, square, colours::VERMILLION, Some(4));
    }
    let text = if valence <= MAX_NUMBERED { format!("{weight:.4}").replace('-', "−") } else { String::new() };
    Labelled { at, radius: radius.max(6), text }
}

fn legend(canvas: &mut Canvas, at: At, step: At, valence: usize) {
    let place = |number: i32| (at.0 + number * step.0, at.1 + number * step.1);
    canvas.text(&format!("n = {valence}"), (place(0).0 - 16, place(0).1), TEXT, Anchor::Left);
    canvas.marker(Marker::Circle, place(1), 16, colours::BLUE, None);
    canvas.marker(Marker::Square, place(2), 16, colours::VERMILLION, Some(4));
    canvas.marker(Marker::Circle, place(3), 5, colours::GREY, None);
    for (number, words) in [(1, "positive weight"), (2, "negative weight"), (3, "weight zero")] {
        canvas.text(words, (place(number).0 + 34, place(number).1), SMALL, Anchor::Left);
    }
}
