//! What is to be seen of a scheme for curves?
//!
//! Its rules as stencils, the basic limit function with its derivatives, and the classic figure: control polygon, levels, limit curve.

use super::Picture;
use super::axes::ticks;
use super::canvas::{Anchor, Area, At, Canvas, Marker, SMALL, TEXT, View, WIDTH, colours, draw, text_width, wrapped};
use crate::analysis::curve::convergence::sample;
use crate::analysis::curve::limit::CurveLimits;
use crate::analysis::curve::limit_function::{LimitFunction, limit_function};
use crate::analysis::curve::point::CurvePoint;
use crate::refine::Obstacle;
use crate::refine::curve::CurveRefiner;
use crate::scheme::curve::{Mask, Rules};
use num_complex::Complex64;

/// The most derivatives that are drawn.
const MOST_DERIVATIVES: usize = 3;

/// Stencils of more points are not drawn.
const MOST_POINTS: usize = 14;

/// The pictures of a scheme for curves.
///
/// # Errors
/// When one can't be drawn.
pub fn pictures(rules: &Rules, points: &[CurvePoint]) -> Result<Vec<Picture>, Obstacle> {
    let mut pictures = Vec::new();
    if let Rules::Mask(mask, _) = rules {
        pictures.extend(stencils(mask)?);
        if let Some(function) = limit_function(mask, points, MOST_DERIVATIVES) {
            pictures.push(functions(&function)?);
        }
    }
    pictures.extend(classic(rules)?);
    Ok(pictures)
}

/// The stencil of each kind of new point.
fn stencils(mask: &Mask) -> Result<Option<Picture>, Obstacle> {
    const PANEL: i32 = 250;
    let arity = i64::from(mask.arity);
    let kinds: Vec<Vec<(i64, String)>> =
        (0..arity).map(|r| mask.submask(r).into_iter().map(|(j, weight)| (j, weight.to_string())).collect()).collect();
    let low = kinds.iter().flatten().map(|(j, _)| *j).min().unwrap_or(0);
    let high = kinds.iter().flatten().map(|(j, _)| *j).max().unwrap_or(0).max(low + 1);
    let count = (high - low + 1) as usize;
    let longest = kinds.iter().flatten().map(|(_, words)| text_width(words, SMALL)).max().unwrap_or(0);
    let spacing = (WIDTH - 200) / (count as i32).max(1);
    if count > MOST_POINTS || longest + 12 > spacing {
        return Ok(None);
    }
    let middle = f64::from(low as i32 + high as i32) / 2.0;
    let x = |index: f64| WIDTH / 2 + ((index - middle) * f64::from(spacing)).round() as i32;
    // the new point i stands at (i - (l + r)/2)/a
    let shift = mask.support().map_or(0.0, |(first, last)| (first + last) as f64 / 2.0);
    let svg = draw(PANEL * kinds.len() as i32 + 20, |canvas| {
        for (r, kind) in kinds.iter().enumerate() {
            let y = PANEL * r as i32 + 70;
            canvas.line((x(low as f64 - 0.4), y), (x(high as f64 + 0.4), y), colours::PALE, 4);
            let new = (x((r as f64 - shift) / arity as f64), y + 120);
            for (j, _) in kind {
                canvas.line((x(*j as f64), y), new, colours::GREY, 2);
            }
            for j in low..=high {
                let used = kind.iter().find(|(own, _)| *own == j);
                canvas.marker(Marker::Circle, (x(j as f64), y), 11, colours::WHITE, None);
                let colour = if used.is_some() { colours::BLACK } else { colours::GREY };
                canvas.marker(Marker::Circle, (x(j as f64), y), 11, colour, used.is_none().then_some(2));
                if let Some((_, words)) = used {
                    canvas.text(&words.replace('-', "−"), (x(j as f64), y - 38), SMALL, Anchor::Middle);
                }
            }
            canvas.marker(Marker::Square, new, 13, colours::VERMILLION, None);
        }
    })?;
    let caption = "The rules: each new point (square) as a mean of old points (discs) with their weights.".to_string();
    Ok(Some(Picture { name: "stencils", caption, svg }))
}

/// A frame with numbers along both axes.
struct Frame {
    area: Area,
    x: [f64; 2],
    y: [f64; 2],
}

impl Frame {
    fn at(&self, x: f64, y: f64) -> At {
        let across = (x - self.x[0]) / (self.x[1] - self.x[0]);
        let up = (y - self.y[0]) / (self.y[1] - self.y[0]);
        let right = self.area.x + (across * f64::from(self.area.width)).round() as i32;
        (right, self.area.y + self.area.height - (up * f64::from(self.area.height)).round() as i32)
    }

    fn draw(&self, canvas: &mut Canvas, title: &str) {
        let (left, right) = (self.area.x, self.area.x + self.area.width);
        for (value, text) in ticks(self.y[0], self.y[1]) {
            let at = self.at(self.x[0], value).1;
            canvas.line((left, at), (right, at), colours::PALE, 2);
            canvas.text(&text, (left - 14, at), SMALL, Anchor::Right);
        }
        let bottom = self.area.y + self.area.height;
        for (value, text) in ticks(self.x[0], self.x[1]) {
            let at = self.at(value, self.y[0]).0;
            canvas.line((at, bottom), (at, bottom + 8), colours::BLACK, 2);
            canvas.text(&text, (at, bottom + 28), SMALL, Anchor::Middle);
        }
        canvas.outline(&self.area.corners(), colours::BLACK, 2);
        canvas.text_upwards(title, (40, self.area.y + self.area.height / 2), TEXT);
    }
}

fn functions(function: &LimitFunction) -> Result<Picture, Obstacle> {
    const PANEL: i32 = 380;
    let titles = ["φ", "φ'", "φ''", "φ'''"];
    let ends = [function.at.first().copied().unwrap_or(0.0), function.at.last().copied().unwrap_or(1.0)];
    let svg = draw(PANEL * function.approx_values.len() as i32 + 20, |canvas| {
        for (index, (values, title)) in function.approx_values.iter().zip(titles).enumerate() {
            let low = values.iter().copied().fold(0.0, f64::min);
            let high = values.iter().copied().fold(0.0, f64::max);
            let margin = 0.06 * (high - low).max(1e-9);
            let area = Area { x: 170, y: PANEL * index as i32 + 30, width: WIDTH - 210, height: PANEL - 90 };
            let frame = Frame { area, x: ends, y: [low - margin, high + margin] };
            frame.draw(canvas, title);
            let line: Vec<At> = function.at.iter().zip(values).map(|(x, y)| frame.at(*x, *y)).collect();
            canvas.path(&line, colours::BLUE, 4);
        }
    })?;
    let derivatives = function.approx_values.len() - 1;
    let caption = match derivatives {
        0 => "The basic limit function, approximately.".to_string(),
        1 => "The basic limit function and its derivative, approximately.".to_string(),
        _ => format!(
            "The basic limit function and {derivatives} derivatives, approximately, as far as there are masks for them."
        ),
    };
    Ok(Picture { name: "limit-function", caption, svg })
}

/// Control polygon, two levels, and the limit.
fn classic(rules: &Rules) -> Result<Option<Picture>, Obstacle> {
    let refiner = CurveRefiner::new(rules);
    let (points, closed) = sample(rules);
    let Ok(limits) = CurveLimits::new(rules) else { return Ok(None) };
    let mut fine = points.clone();
    while fine.len() < 400 {
        let Ok(next) = refiner.step(&fine, closed) else { return Ok(None) };
        fine = next;
    }
    let (Ok(one), Ok(two), Ok(curve)) =
        (refiner.step(&points, closed), refiner.steps(&points, closed, 2), limits.of(&fine, closed))
    else {
        return Ok(None);
    };
    let complex = |list: &[[f64; 2]]| list.iter().map(|[x, y]| Complex64::new(*x, *y)).collect::<Vec<_>>();
    let panels = [("level 0", complex(&points)), ("level 1", complex(&one)), ("level 2", complex(&two))];
    let (curve, height) = (complex(&curve), 420);
    let width = WIDTH / 3;
    let svg = draw(height + 70, |canvas| {
        for (index, (title, polygon)) in panels.iter().enumerate() {
            let area = Area { x: index as i32 * width, y: 60, width, height }.inset(24, 16);
            let view = View::of(panels[0].1.iter().chain(&curve).copied(), area);
            let path = |list: &[Complex64]| list.iter().map(|point| view.at(*point)).collect::<Vec<At>>();
            let (line, limit) = (path(polygon), path(&curve));
            if closed {
                canvas.outline(&limit, colours::BLUE, 5);
                canvas.outline(&line, colours::VERMILLION, 2);
            } else {
                canvas.path(&limit, colours::BLUE, 5);
                canvas.path(&line, colours::VERMILLION, 2);
            }
            line.iter().for_each(|at| canvas.marker(Marker::Circle, *at, 6, colours::VERMILLION, None));
            let words = wrapped(title, width, TEXT);
            canvas.lines(&words, (index as i32 * width + width / 2, 30), TEXT, Anchor::Middle);
        }
    })?;
    let caption = "A control polygon and two levels (thin, with points), and the limit curve (thick).".to_string();
    Ok(Some(Picture { name: "curve", caption, svg }))
}
