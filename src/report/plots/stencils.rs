//! How does a scheme make its new points?
//!
//! Its rules as papers draw them: the old points with their weights, around the new one. Points come from the walks of the
//! vocabulary, weights from the formulas of the scheme file.

use super::Picture;
use super::canvas::{Anchor, Area, At, Canvas, Marker, SMALL, TEXT, View, colours, draw, grid, line_height, wrapped};
use super::fan::{Fan, edges_among, leaving};
use super::formulas::{Formulas, Weight};
use super::labels::{Labelled, set};
use crate::analysis::Analyzer;
use crate::mesh::{Connectivity, Label, Lattice, PatchEdge};
use crate::refine::{Obstacle, Pass, Refinement, Use};
use crate::scheme::vocabulary::{Arrival, RuleKind};
use num_complex::Complex64;
use std::collections::{BTreeMap, BTreeSet};

/// The count that rules around irregular places are shown at.
const IRREGULAR: usize = 5;

/// A point of a stencil: an old one, or one that the step has made before, by the old points that it lies between.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Spot {
    Old(Label),
    Born(Vec<Label>),
}

/// A rule laid out.
struct Panel {
    title: String,
    fan: Fan,
    new: Complex64,
    spots: BTreeMap<Spot, Vec<Weight>>,
    /// The points that walks pass.
    passed: BTreeSet<Label>,
}

pub(super) fn picture(analyzer: &Analyzer) -> Result<Picture, Obstacle> {
    let refinement: Refinement<f64> = Refinement::new(analyzer.scheme(), None);
    let mut formulas = Formulas::new(&analyzer.scheme().book);
    let mut panels = Vec::new();
    let passes = refinement.passes();
    let several = analyzer.scheme().book.passes.len() > 1;
    let mut number = 0;
    // one panel for each rule that is told in the file, however often its pass is made
    for (index, pass) in passes.iter().enumerate() {
        if passes[..index].iter().any(|before| std::ptr::eq(before.rules(), pass.rules())) {
            continue;
        }
        number += 1;
        let prefix = if several { format!("pass {number}: ") } else { String::new() };
        for kind in pass.rules().keys().filter(|kind| !kind.is_boundary()) {
            panels.extend(panel(analyzer.lattice(), *kind, pass, &prefix, &mut formulas)?);
        }
    }
    let notes: Vec<String> = formulas.notes().iter().flat_map(|note| wrapped(note, 1080, SMALL)).collect();
    let layout = Layout::of(panels.len(), notes.len());
    let svg = draw(layout.height, |canvas| {
        for (panel, area) in panels.iter().zip(&layout.panels) {
            draw_panel(canvas, *area, panel);
        }
        legend(canvas, &layout, panels.iter().any(Panel::has_born));
        canvas.lines(&notes, (60, layout.notes), SMALL, Anchor::Left);
    })?;
    Ok(Picture { name: "stencils", caption: caption(analyzer), svg })
}

/// Where things stand.
struct Layout {
    panels: Vec<Area>,
    legend: At,
    /// From one line of the legend to the next.
    legend_step: At,
    notes: i32,
    height: i32,
}

impl Layout {
    /// Panels in two columns, then the notes; the legend in the place left free by the panels, or else below them.
    fn of(panels: usize, notes: usize) -> Layout {
        let (columns, height) = if panels == 1 { (1, 700) } else { (2, 600) };
        let foot = height * panels.div_ceil(columns) as i32;
        let free = grid(panels + 1, columns, 0, height).pop().filter(|area| area.y < foot);
        let (legend, legend_step, notes_top) = match free {
            Some(area) => ((area.x + 90, area.y + 200), (0, 70), foot + 26),
            None => ((80, foot + 40), (250, 0), foot + 116),
        };
        let end = notes_top + notes as i32 * line_height(SMALL);
        Layout { panels: grid(panels, columns, 0, height), legend, legend_step, notes: notes_top, height: end }
    }
}

fn caption(analyzer: &Analyzer) -> String {
    let title = &analyzer.scheme().book.title;
    format!("The rules of the scheme \"{title}\": the weights of the old points (dots) in the new point (open square).")
}

/// The half-edges around the place that a rule is told around, with its layout and the new point in it.
fn place(lattice: Lattice, kind: RuleKind) -> Option<(Fan, Vec<PatchEdge>, Complex64, String)> {
    // all rules but those of corners are shown around a vertex
    let lattice = if kind == RuleKind::Corner || lattice.has_centre() { lattice } else { Lattice::Quads };
    let regular = lattice.regular_valence();
    let irregular = matches!(kind, RuleKind::Vertex | RuleKind::EdgeFromIrregularEnd | RuleKind::Corner);
    let fan = Fan::new(lattice, if irregular { IRREGULAR } else { regular });
    let patch = fan.patch;
    if let RuleKind::Corner = kind {
        let corners = patch.around_face(patch.edge(patch.point(0, 0, 0), 2));
        // nearer to its corner than to the middle of the face, which is the origin
        let new = fan.at(patch.origin(corners[0])) * 0.55;
        return Some((fan, corners, new, format!("corner of a face with n = {IRREGULAR}")));
    }
    let edge = patch.edge(patch.centre()?, 0);
    let half = fan.mean(&[patch.origin(edge), patch.target(edge)]);
    let (starts, new, title) = match kind {
        RuleKind::Vertex => (patch.around_vertex(edge), Complex64::ZERO, format!("vertex, n = {IRREGULAR}")),
        RuleKind::Edge => (vec![edge, patch.twin(edge)], half, "edge".to_string()),
        RuleKind::EdgeFromIrregularEnd => {
            (patch.around_vertex(edge), half, format!("edge at an irregular end, n = {IRREGULAR}"))
        }
        RuleKind::Face => {
            let corners = patch.around_face(edge);
            let labels: Vec<Label> = corners.iter().map(|corner| patch.origin(*corner)).collect();
            (corners, fan.mean(&labels), format!("face, n = {}", labels.len()))
        }
        _ => return None,
    };
    Some((fan, starts, new, title))
}

fn panel(
    lattice: Lattice,
    kind: RuleKind,
    pass: &Pass<f64>,
    prefix: &str,
    formulas: &mut Formulas,
) -> Result<Option<Panel>, Obstacle> {
    let Some((fan, starts, new, title)) = place(lattice, kind) else { return Ok(None) };
    let weights = formulas.weights_of(pass.rules().get(&kind), kind, starts.len(), &title)?;
    let mut panel =
        Panel { title: format!("{prefix}{title}"), fan, new, spots: BTreeMap::new(), passed: BTreeSet::new() };
    panel.pass(&starts);
    for used in pass.uses(&panel.fan.patch, kind, &starts)? {
        if let Some(weight) = weights.get(&(used.entry, used.index)) {
            panel.add(&used, weight.clone());
        }
    }
    Ok(Some(panel))
}

impl Panel {
    fn has_born(&self) -> bool {
        self.spots.keys().any(|spot| matches!(spot, Spot::Born(_)))
    }

    fn pass(&mut self, edges: &[PatchEdge]) {
        let patch = self.fan.patch;
        self.passed.extend(edges.iter().flat_map(|edge| [patch.origin(*edge), patch.target(*edge)]));
    }

    fn add(&mut self, used: &Use<PatchEdge>, weight: Weight) {
        let patch = self.fan.patch;
        let Some(last) = used.path.last().copied() else { return };
        let spot = match used.arrival {
            Arrival::Origin => Spot::Old(patch.origin(last)),
            Arrival::Target => Spot::Old(patch.target(last)),
            Arrival::NewEdge => born(vec![patch.origin(last), patch.target(last)]),
            Arrival::NewFace => born(patch.around_face(last).iter().map(|edge| patch.origin(*edge)).collect()),
        };
        self.pass(&used.path);
        if let Spot::Born(between) = &spot {
            self.passed.extend(between);
        }
        self.spots.entry(spot).or_default().push(weight);
    }

    fn at(&self, spot: &Spot) -> Complex64 {
        match spot {
            Spot::Old(label) => self.fan.at(*label),
            Spot::Born(between) => self.fan.mean(between),
        }
    }

    /// The edges between the points passed, and the first part of those that lead away from them.
    fn lines(&self) -> (Vec<[Complex64; 2]>, Vec<[Complex64; 2]>) {
        let place = |label: Label| self.fan.at(label);
        let inner = edges_among(&self.fan.patch, &self.passed).into_iter().map(|(a, b)| [place(a), place(b)]).collect();
        let away = self.passed.iter().flat_map(|label| leaving(&self.fan.patch, *label));
        let ends = away.map(|edge| (self.fan.patch.origin(edge), self.fan.patch.target(edge)));
        let stub = |(a, b): (Label, Label)| [place(a), place(a) + (place(b) - place(a)) * 0.4];
        let stubs = ends.filter(|(_, b)| !self.passed.contains(b)).map(stub).collect();
        (inner, stubs)
    }
}

fn born(mut between: Vec<Label>) -> Spot {
    between.sort_unstable();
    Spot::Born(between)
}

fn draw_panel(canvas: &mut Canvas, area: Area, panel: &Panel) {
    canvas.text(&panel.title, (area.middle().0, area.y + 40), TEXT, Anchor::Middle);
    let inside = area.below(70).inset(10, 10);
    let (inner, stubs) = panel.lines();
    let view = View::of(inner.iter().chain(&stubs).flatten().copied(), inside.inset(44, 20)).at_most(230.0);
    let seen =
        |lines: &[[Complex64; 2]]| -> Vec<(At, At)> { lines.iter().map(|[a, b]| (view.at(*a), view.at(*b))).collect() };
    let (inner, stubs) = (seen(&inner), seen(&stubs));
    for (from, to) in &stubs {
        canvas.line(*from, *to, colours::PALE, 2);
    }
    for (from, to) in &inner {
        canvas.line(*from, *to, colours::GREY, 2);
    }
    let new = view.at(panel.new);
    draw_new(canvas, new);
    let labelled: Vec<Labelled> =
        panel.spots.iter().map(|(spot, weights)| draw_spot(canvas, view.at(panel.at(spot)), spot, weights)).collect();
    let lines: Vec<(At, At)> = inner.into_iter().chain(stubs).collect();
    set(canvas, inside, &labelled, &lines, &[(new, 18)], 34);
}

fn draw_new(canvas: &mut Canvas, at: At) {
    canvas.marker(Marker::Square, at, 18, colours::WHITE, None);
    canvas.marker(Marker::Square, at, 18, colours::VERMILLION, Some(4));
}

fn draw_spot(canvas: &mut Canvas, at: At, spot: &Spot, weights: &[Weight]) -> Labelled {
    match spot {
        Spot::Old(_) => canvas.marker(Marker::Circle, at, 10, colours::BLACK, None),
        Spot::Born(_) => {
            canvas.marker(Marker::Diamond, at, 10, colours::WHITE, None);
            canvas.marker(Marker::Diamond, at, 10, colours::BLUE, Some(4));
        }
    }
    Labelled { at, radius: 14, text: weights.join(" + ").replace("+ −", "− ") }
}

fn legend(canvas: &mut Canvas, layout: &Layout, born: bool) {
    let (start, step) = (layout.legend, layout.legend_step);
    let place = |number: i32| (start.0 + step.0 * number, start.1 + step.1 * number);
    canvas.marker(Marker::Circle, place(0), 10, colours::BLACK, None);
    draw_new(canvas, place(1));
    if born {
        canvas.marker(Marker::Diamond, place(2), 10, colours::BLUE, Some(4));
    }
    let words = [(0, "old point"), (1, "new point"), (2, "made earlier in the same step")];
    for (number, words) in words.into_iter().take(if born { 3 } else { 2 }) {
        canvas.text(words, (place(number).0 + 34, place(number).1), SMALL, Anchor::Left);
    }
}
