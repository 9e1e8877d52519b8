//! How large are the eigenvalues, by frequency, as the valence grows?

use super::Picture;
use super::axes::Axes;
use super::canvas::{Anchor, Area, At, Canvas, Marker, SMALL, colours, draw, text_width};
use crate::analysis::Analysis;
use crate::analysis::spectrum::Eigenvalue;
use crate::refine::Obstacle;
use plotters::style::RGBColor;
use std::collections::BTreeSet;

/// The markers of the frequencies 0, 1, 2, 3, and 4 and more.
const MARKERS: [(&str, Marker, RGBColor); 5] = [
    ("0", Marker::Circle, colours::BLACK),
    ("1", Marker::Square, colours::BLUE),
    ("2", Marker::Triangle, colours::VERMILLION),
    ("3", Marker::Diamond, colours::GREEN),
    ("4 and more", Marker::Cross, colours::ORANGE),
];

/// Where valences lie nearer than this, markers of different frequencies are not set side by side.
const ROOM_FOR_ALL: f64 = 60.0;

pub(super) fn picture(analyses: &[Analysis]) -> Result<Picture, Obstacle> {
    let area = Area { x: 160, y: 90, width: 1000, height: 620 };
    let axes = Axes::new(area, analyses.iter().map(|analysis| analysis.valence).collect(), 0.0, top(analyses));
    let side_by_side = axes.spacing() >= ROOM_FOR_ALL;
    let svg = draw(830, |canvas| {
        if side_by_side {
            bands(canvas, &axes, analyses);
        }
        axes.draw(canvas, "|eigenvalue|");
        legend(canvas, 40);
        let points: Vec<At> = analyses.iter().filter_map(|analysis| lambda_at(&axes, analysis)).collect();
        canvas.path(&points, colours::BLUE, 2);
        // frequency 1 last: it is on top
        for class in [4, 3, 2, 0, 1] {
            markers(canvas, &axes, analyses, class);
        }
    })?;
    let aside = if side_by_side { "; markers of one valence are set side by side" } else { "" };
    let caption = format!(
        "Moduli of the eigenvalues of the local subdivision matrix against the valence n, by frequency{aside}. \
         The line joins λ, the largest after the 1 of the constants."
    );
    Ok(Picture { name: "eigenvalues", caption, svg })
}

/// The upper end of the scale: just above 1, or above what is larger.
fn top(analyses: &[Analysis]) -> f64 {
    let all = analyses.iter().flat_map(|analysis| &analysis.spectrum.eigenvalues);
    all.map(|e| e.modulus() * 1.05).fold(1.05, f64::max)
}

fn class(e: &Eigenvalue) -> usize {
    e.frequency.min(MARKERS.len() - 1)
}

fn radius(axes: &Axes) -> i32 {
    match axes.spacing() {
        spacing if spacing >= 36.0 => 9,
        spacing if spacing >= 12.0 => 6,
        _ => 4,
    }
}

fn at(axes: &Axes, valence: usize, e: &Eigenvalue) -> At {
    let aside = if axes.spacing() >= ROOM_FOR_ALL { (axes.spacing().min(120.0) / 5.5) as i32 } else { 0 };
    (axes.x(valence) + aside * (class(e) as i32 - 2), axes.y(e.modulus()))
}

fn lambda_at(axes: &Axes, analysis: &Analysis) -> Option<At> {
    analysis.spectrum.subdominant().map(|lambda| at(axes, analysis.valence, &lambda))
}

/// The markers of a class of frequencies; where they would cover each other, one stands for all.
fn markers(canvas: &mut Canvas, axes: &Axes, analyses: &[Analysis], of: usize) {
    let radius = radius(axes);
    let cell = if radius > 4 { 2 } else { 7 };
    let mut taken = BTreeSet::new();
    for analysis in analyses {
        for e in analysis.spectrum.eigenvalues.iter().filter(|e| class(e) == of) {
            let at = at(axes, analysis.valence, e);
            if taken.insert((at.0 / cell, at.1 / cell)) {
                marker(canvas, of, at, radius);
            }
        }
    }
}

fn marker(canvas: &mut Canvas, class: usize, at: At, radius: i32) {
    let (_, marker, colour) = MARKERS[class];
    let outline = if radius > 4 { 3 } else { 2 };
    match marker {
        Marker::Square | Marker::Diamond => canvas.marker(marker, at, radius * 9 / 10, colour, Some(outline)),
        Marker::Cross => canvas.marker(marker, at, radius * 4 / 5, colour, Some(outline)),
        _ => canvas.marker(marker, at, radius * 9 / 10, colour, None),
    }
}

/// Every other valence stands on a faint band.
fn bands(canvas: &mut Canvas, axes: &Axes, analyses: &[Analysis]) {
    let half = (axes.spacing() / 2.0) as i32;
    for valence in analyses.iter().map(|analysis| analysis.valence).filter(|valence| valence % 2 == 0) {
        let x = axes.x(valence) - half;
        let band = Area { x, width: 2 * half, ..axes.area };
        canvas.polygon(&band.corners(), colours::FAINT);
    }
}

fn legend(canvas: &mut Canvas, y: i32) {
    let mut x = 160;
    canvas.text("frequency", (x, y), SMALL, Anchor::Left);
    x += text_width("frequency", SMALL) + 40;
    for (class, (name, _, _)) in MARKERS.iter().enumerate() {
        marker(canvas, class, (x, y), 11);
        canvas.text(name, (x + 26, y), SMALL, Anchor::Left);
        x += 26 + text_width(name, SMALL) + 52;
    }
    canvas.line((x, y), (x + 50, y), colours::BLUE, 2);
    canvas.text("λ", (x + 64, y), SMALL, Anchor::Left);
}
