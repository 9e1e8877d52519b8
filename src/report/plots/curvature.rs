//! Does the curvature diverge, stay bounded, or vanish?
//!
//! It goes from level to level by the factor mu/lambda^2, where mu is the largest eigenvalue after the subdominant one (Doo and
//! Sabin 1978; Reif 1995).

use super::Picture;
use super::axes::Axes;
use super::canvas::{Anchor, Area, Canvas, Marker, SMALL, colours, draw, line_height};
use crate::analysis::Analysis;
use crate::refine::Obstacle;
use crate::verdicts::{Curvature, CurvatureClass, curvature_of};

struct Point {
    valence: usize,
    ratio: f64,
    class: CurvatureClass,
}

pub(super) fn picture(analyses: &[Analysis]) -> Result<Picture, Obstacle> {
    let points: Vec<Point> = analyses.iter().filter_map(point).collect();
    let (low, high) = scale(&points);
    let area = Area { x: 190, y: 90, width: 780, height: 560 };
    let axes = Axes::new(area, analyses.iter().map(|analysis| analysis.valence).collect(), low, high);
    let radius = if axes.spacing() >= 24.0 { 11 } else { 6 };
    let svg = draw(770, |canvas| {
        axes.draw(canvas, "|μ|/λ²");
        canvas.dashes((area.x, axes.y(1.0)), area.x + area.width, colours::BLACK, 3);
        regions(canvas, &axes);
        legend(canvas, &points);
        for point in &points {
            marker(canvas, point.class, (axes.x(point.valence), axes.y(point.ratio)), radius);
        }
    })?;
    let caption = format!(
        "The ratio |μ|/λ² against the valence n, μ being the largest eigenvalue after the subdominant one over the full \
         neighbourhood: above 1 the curvature diverges, below 1 the extraordinary point is flat; (log) says that it diverges like a power \
         of a logarithm, (reg) that it does so at the regular vertices nearby.{}",
        left_out(analyses.len() - points.len())
    );
    Ok(Picture { name: "curvature", caption, svg })
}

fn left_out(count: usize) -> String {
    match count {
        0 => String::new(),
        1 => " One valence is left out: its λ is not determined.".to_string(),
        _ => format!(" {count} valences are left out: their λ is not determined."),
    }
}

fn point(analysis: &Analysis) -> Option<Point> {
    let Curvature { ratio, class, .. } = curvature_of(analysis)?;
    Some(Point { valence: analysis.valence, ratio, class })
}

/// From below the least to above the largest of the ratios and 1; 1 keeps a fifth of the height from either end.
fn scale(points: &[Point]) -> (f64, f64) {
    let ratios = || points.iter().map(|point| point.ratio);
    let (least, largest) = (ratios().fold(1.0, f64::min), ratios().fold(1.0, f64::max));
    let room = ((largest - least) * 0.08).max(0.1);
    let (low, high) = (least - room, largest + room);
    let (below, above) = (1.0 - low, high - 1.0);
    (1.0 - below.max(above / 4.0), 1.0 + above.max(below / 4.0))
}

/// Words at the right of the frame: above 1, at 1, below 1.
fn regions(canvas: &mut Canvas, axes: &Axes) {
    let area = axes.area;
    let (x, one) = (area.x + area.width + 16, axes.y(1.0));
    let words = ["1: bounded", "curvature", "possible"].map(String::from);
    canvas.lines(&words, (x, one - line_height(SMALL)), SMALL, Anchor::Left);
    let clear = 5 * line_height(SMALL) / 2;
    canvas.text("diverges", (x, ((area.y + one) / 2).min(one - clear)), SMALL, Anchor::Left);
    canvas.text("flat", (x, ((area.y + area.height + one) / 2).max(one + clear)), SMALL, Anchor::Left);
}

fn marker(canvas: &mut Canvas, class: CurvatureClass, at: (i32, i32), radius: i32) {
    match class {
        CurvatureClass::Diverges => canvas.marker(Marker::Triangle, at, radius, colours::VERMILLION, None),
        CurvatureClass::DivergesNearby => canvas.marker(Marker::Diamond, at, radius, colours::VERMILLION, None),
        CurvatureClass::DivergesSlowly => canvas.marker(Marker::Triangle, at, radius, colours::VERMILLION, Some(4)),
        CurvatureClass::Tie => canvas.marker(Marker::Square, at, radius, colours::BLACK, Some(2)),
        CurvatureClass::Bounded | CurvatureClass::BoundedOnly => {
            canvas.marker(Marker::Square, at, radius, colours::BLUE, Some(4));
        }
        CurvatureClass::Converges => canvas.marker(Marker::Square, at, radius, colours::BLUE, None),
        CurvatureClass::Flat => canvas.marker(Marker::Circle, at, radius, colours::GREEN, None),
    }
}

/// The kinds that are there.
fn legend(canvas: &mut Canvas, points: &[Point]) {
    let all = [
        CurvatureClass::Diverges,
        CurvatureClass::DivergesSlowly,
        CurvatureClass::DivergesNearby,
        CurvatureClass::Bounded,
        CurvatureClass::Converges,
        CurvatureClass::Tie,
        CurvatureClass::Flat,
    ];
    let seen = |class: &&CurvatureClass| points.iter().any(|point| point.class.words() == class.words());
    let classes: Vec<CurvatureClass> = all.iter().filter(seen).copied().collect();
    for (index, class) in classes.into_iter().enumerate() {
        let x = 210 + 240 * index as i32;
        marker(canvas, class, (x, 40), 11);
        canvas.text(class.words(), (x + 26, 40), SMALL, Anchor::Left);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_holds_the_ratios_and_one_away_from_its_ends() {
        for ratios in [vec![], vec![1.0], vec![1.0, 2.0], vec![0.3, 0.9], vec![0.99, 5.0], vec![40.0]] {
            let point = |ratio: &f64| Point { valence: 3, ratio: *ratio, class: CurvatureClass::Tie };
            let (low, high) = scale(&ratios.iter().map(point).collect::<Vec<_>>());
            assert!(ratios.iter().all(|ratio| low < *ratio && *ratio < high));
            let part = (1.0 - low) / (high - low);
            assert!((0.19..=0.81).contains(&part), "{ratios:?} {part}");
        }
    }
}
