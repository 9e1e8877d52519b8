//! How do the leading eigenvalues and their ratio run against a parameter?
//!
//! One frame each for |lambda|, |mu| and |mu|/lambda^2; a line for each valence, told by colour and marker.

use super::Picture;
use super::axes::ticks;
use super::canvas::{Anchor, Area, At, Canvas, Marker, SMALL, TEXT, colours, draw, text_width};
use crate::refine::Obstacle;
use crate::report::sweep::{Sweep, SweepPoint};
use plotters::style::RGBColor;

/// The markers and colours of the valences.
const STYLES: [(Marker, RGBColor); 10] = [
    (Marker::Circle, colours::BLUE),
    (Marker::Square, colours::VERMILLION),
    (Marker::Triangle, colours::GREEN),
    (Marker::Diamond, colours::ORANGE),
    (Marker::Cross, colours::BLACK),
    (Marker::Square, colours::BLUE),
    (Marker::Triangle, colours::VERMILLION),
    (Marker::Diamond, colours::GREEN),
    (Marker::Cross, colours::ORANGE),
    (Marker::Circle, colours::GREY),
];

/// Markers stand this far apart along a line, at least.
const MARKER_SPACING: i32 = 110;

const HEIGHT: i32 = 400;
const TOP: i32 = 140;

/// A frame: what is drawn in it.
struct Panel {
    title: &'static str,
    area: Area,
    low: f64,
    high: f64,
    /// The ends of the parameter.
    ends: (f64, f64),
}

/// The picture of a sweep.
///
/// # Errors
/// When it can't be drawn.
pub fn picture(sweep: &Sweep) -> Result<Picture, Obstacle> {
    let valences: Vec<usize> = sweep.valences();
    let shown = &valences[..valences.len().min(STYLES.len())];
    let values: [fn(&SweepPoint) -> Option<f64>; 3] = [|p| Some(p.lambda), |p| Some(p.mu), |p| p.ratio];
    let titles = ["|λ|", "|μ|", "|μ|/λ²"];
    let svg = draw(TOP + 3 * HEIGHT + 70, |canvas| {
        legend(canvas, shown);
        for (index, (value, title)) in values.into_iter().zip(titles).enumerate() {
            let panel = Panel::of(sweep, shown, value, title, index);
            panel.frame(canvas, index == 2);
            for (style, n) in shown.iter().enumerate() {
                panel.line(canvas, sweep, *n, value, STYLES[style]);
            }
        }
        let middle = AREA_X + AREA_WIDTH / 2;
        canvas.text(&sweep.request.interval.name, (middle, TOP + 3 * HEIGHT + 36), TEXT, Anchor::Middle);
    })?;
    let rest = match valences.len() {
        count if count > shown.len() => format!(" Shown are the first {} of {count} valences.", shown.len()),
        _ => String::new(),
    };
    let caption = format!(
        "The largest moduli after 1 and their ratio against {}, approximately, a line for each valence n; the ratio is drawn \
         where λ is real, positive, of frequency 1 and isolated.{}{rest}",
        sweep.request.interval.name,
        sweep.what_is_left_out()
    );
    Ok(Picture { name: "sweep", caption, svg })
}

const AREA_X: i32 = 190;
const AREA_WIDTH: i32 = 970;

impl Panel {
    fn of(
        sweep: &Sweep,
        shown: &[usize],
        value: fn(&SweepPoint) -> Option<f64>,
        title: &'static str,
        index: usize,
    ) -> Panel {
        let own = sweep.points.iter().filter(|point| shown.contains(&point.n)).filter_map(value);
        let (low, high) = own.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let room = ((high - low) * 0.08).max(0.01 * high.abs()).max(1e-3);
        let area = Area { x: AREA_X, y: TOP + index as i32 * HEIGHT, width: AREA_WIDTH, height: HEIGHT - 70 };
        let interval = &sweep.request.interval;
        let ends = (interval.from.to_f64().value(), interval.to.to_f64().value());
        Panel { title, area, low: (low - room).max(0.0), high: high + room, ends }
    }

    fn at(&self, parameter: f64, value: f64) -> At {
        let across = (parameter - self.ends.0) / (self.ends.1 - self.ends.0);
        let up = (value - self.low) / (self.high - self.low);
        let x = self.area.x + (across * f64::from(self.area.width)).round() as i32;
        (x, self.area.y + self.area.height - (up * f64::from(self.area.height)).round() as i32)
    }

    fn frame(&self, canvas: &mut Canvas, numbered: bool) {
        let Area { x, y, width, height } = self.area;
        let (right, bottom) = (x + width, y + height);
        let mut widest = 0;
        for (value, text) in ticks(self.low, self.high) {
            let at = self.at(self.ends.0, value).1;
            canvas.line((x, at), (right, at), colours::PALE, 2);
            canvas.text(&text, (x - 14, at), SMALL, Anchor::Right);
            widest = widest.max(text_width(&text, SMALL));
        }
        for (value, text) in ticks(self.ends.0, self.ends.1) {
            let at = self.at(value, self.low).0;
            canvas.line((at, bottom), (at, bottom + 8), colours::BLACK, 2);
            if numbered {
                canvas.text(&text, (at, bottom + 28), SMALL, Anchor::Middle);
            }
        }
        if self.low < 1.0 && 1.0 < self.high && self.title.contains('²') {
            canvas.dashes((x, self.at(self.ends.0, 1.0).1), right, colours::BLACK, 3);
        }
        canvas.outline(&self.area.corners(), colours::BLACK, 2);
        canvas.text_upwards(self.title, (x - 14 - widest - 36, y + height / 2), TEXT);
    }

    /// The line of a valence; it breaks where values are missing.
    fn line(
        &self,
        canvas: &mut Canvas,
        sweep: &Sweep,
        n: usize,
        value: fn(&SweepPoint) -> Option<f64>,
        (marker, colour): (Marker, RGBColor),
    ) {
        let step = (self.ends.1 - self.ends.0) / sweep.request.steps as f64;
        let mut pieces: Vec<Vec<At>> = Vec::new();
        let mut before = f64::NEG_INFINITY;
        for (parameter, value) in sweep.of_valence(n).filter_map(|p| Some((p.value.to_f64().value(), value(p)?))) {
            if parameter - before > 1.5 * step {
                pieces.push(Vec::new());
            }
            before = parameter;
            if let Some(piece) = pieces.last_mut() {
                piece.push(self.at(parameter, value));
            }
        }
        let start = self.area.x - MARKER_SPACING + (n % 5) as i32 * MARKER_SPACING / 5;
        let mut last = start;
        for piece in &pieces {
            if piece.len() > 1 {
                canvas.path(piece, colour, 4);
            }
            for at in piece.iter().filter(|at| piece.len() == 1 || at.0 - start >= MARKER_SPACING) {
                if at.0 - last >= MARKER_SPACING || piece.len() == 1 {
                    let outline = (marker == Marker::Cross).then_some(4);
                    canvas.marker(marker, *at, 9, colour, outline);
                    last = at.0;
                }
            }
        }
    }
}

fn legend(canvas: &mut Canvas, shown: &[usize]) {
    let (mut x, mut y) = (AREA_X, if shown.len() > 6 { 40 } else { 85 });
    for (style, n) in shown.iter().enumerate() {
        let (marker, colour) = STYLES[style];
        let text = format!("n = {n}");
        if x + 90 + text_width(&text, SMALL) > AREA_X + AREA_WIDTH {
            (x, y) = (AREA_X, y + 50);
        }
        canvas.line((x, y), (x + 50, y), colour, 4);
        canvas.marker(marker, (x + 25, y), 9, colour, (marker == Marker::Cross).then_some(4));
        canvas.text(&text, (x + 62, y), SMALL, Anchor::Left);
        x += 62 + text_width(&text, SMALL) + 40;
    }
}
