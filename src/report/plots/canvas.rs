//! How is a picture drawn?
//!
//! Shapes and words on a sheet [`WIDTH`] units wide, which are 8 cm in print. Coordinates are whole numbers, so that
//! the same picture has the same bytes on every machine. The width of words is estimated: the reader's font is not known.

use crate::refine::Obstacle;
use num_complex::Complex64;
use plotters::prelude::{DrawingBackend, IntoFont, RGBColor, SVGBackend, ShapeStyle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontFamily, FontTransform, TextStyle};

/// The width of every picture.
pub(super) const WIDTH: i32 = 1200;
/// The size of titles and labels: 7 points in print.
pub(super) const TEXT: i32 = 36;
/// The size of numbers and notes: 5.5 points in print.
pub(super) const SMALL: i32 = 30;

/// The colours of Okabe and Ito, which the colour-blind can tell apart, and some greys.
pub(super) mod colours {
    use plotters::style::RGBColor;
    pub(in super::super) const BLACK: RGBColor = RGBColor(0, 0, 0);
    pub(in super::super) const GREY: RGBColor = RGBColor(130, 130, 130);
    pub(in super::super) const PALE: RGBColor = RGBColor(215, 215, 215);
    pub(in super::super) const FAINT: RGBColor = RGBColor(242, 242, 242);
    pub(in super::super) const WHITE: RGBColor = RGBColor(255, 255, 255);
    pub(in super::super) const BLUE: RGBColor = RGBColor(0, 114, 178);
    pub(in super::super) const VERMILLION: RGBColor = RGBColor(213, 94, 0);
    pub(in super::super) const GREEN: RGBColor = RGBColor(0, 158, 115);
    pub(in super::super) const ORANGE: RGBColor = RGBColor(230, 159, 0);
}

/// A place on the sheet, from its upper left corner.
pub(super) type At = (i32, i32);

/// Where a word stands from its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Left,
    Middle,
    Right,
}

/// A shape that stands for a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
}

/// Part of the sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    pub(super) x: i32,
    pub(super) y: i32,
    pub(super) width: i32,
    pub(super) height: i32,
}

impl Area {
    /// What is left of it inside margins at the sides, and above and below.
    pub(super) fn inset(self, side: i32, end: i32) -> Area {
        Area { x: self.x + side, y: self.y + end, width: self.width - 2 * side, height: self.height - 2 * end }
    }

    /// What is left of it below a title.
    pub(super) fn below(self, title: i32) -> Area {
        Area { y: self.y + title, height: self.height - title, ..self }
    }

    pub(super) fn middle(self) -> At {
        (self.x + self.width / 2, self.y + self.height / 2)
    }

    pub(super) fn corners(self) -> [At; 4] {
        let (right, bottom) = (self.x + self.width, self.y + self.height);
        [(self.x, self.y), (right, self.y), (right, bottom), (self.x, bottom)]
    }
}

/// Panels side by side, row by row, the last row from the left.
pub(super) fn grid(count: usize, columns: usize, top: i32, height: i32) -> Vec<Area> {
    let width = WIDTH / columns as i32;
    let area = |index: usize| {
        let (column, row) = ((index % columns) as i32, (index / columns) as i32);
        Area { x: column * width, y: top + row * height, width, height }
    };
    (0..count).map(area).collect()
}

/// How many columns show a number of small panels best.
pub(super) fn columns(count: usize) -> usize {
    match count {
        0 | 1 => 1,
        2 | 4 => 2,
        3 | 5..=9 => 3,
        _ => 4,
    }
}

/// The sheet.
pub(super) struct Canvas<'a> {
    backend: SVGBackend<'a>,
    trouble: Option<String>,
}

/// A picture of a height, drawn on white.
pub(super) fn draw(height: i32, content: impl FnOnce(&mut Canvas)) -> Result<String, Obstacle> {
    let mut svg = String::new();
    let size = (WIDTH.unsigned_abs(), height.unsigned_abs());
    let mut canvas = Canvas { backend: SVGBackend::with_string(&mut svg, size), trouble: None };
    canvas.polygon(&Area { x: 0, y: 0, width: WIDTH, height }.corners(), colours::WHITE);
    content(&mut canvas);
    let presented = canvas.backend.present();
    canvas.keep(presented);
    let trouble = canvas.trouble.take();
    drop(canvas);
    trouble.map_or(Ok(svg), |trouble| Err(Obstacle::Limit(trouble)))
}

impl Canvas<'_> {
    /// Trouble is kept until the picture is done: drawing into memory has none.
    fn keep<E: std::fmt::Display>(&mut self, result: Result<(), E>) {
        if let Err(error) = result {
            self.trouble.get_or_insert(format!("a picture could not be drawn: {error}"));
        }
    }

    /// A line through points.
    pub(super) fn path(&mut self, points: &[At], colour: RGBColor, width: u32) {
        let style = ShapeStyle { color: colour.to_rgba(), filled: false, stroke_width: width };
        let drawn = self.backend.draw_path(points.iter().copied(), &style);
        self.keep(drawn);
    }

    /// A line from one point to another.
    pub(super) fn line(&mut self, from: At, to: At, colour: RGBColor, width: u32) {
        let style = ShapeStyle { color: colour.to_rgba(), filled: false, stroke_width: width };
        let drawn = self.backend.draw_line(from, to, &style);
        self.keep(drawn);
    }

    /// A level line of dashes.
    pub(super) fn dashes(&mut self, from: At, to: i32, colour: RGBColor, width: u32) {
        for x in (from.0..to).step_by(24) {
            self.line((x, from.1), ((x + 14).min(to), from.1), colour, width);
        }
    }

    /// A closed line.
    pub(super) fn outline(&mut self, points: &[At], colour: RGBColor, width: u32) {
        // one side more than closed, so that the first corner is mitred as well
        let closed: Vec<At> = points.iter().chain(points.iter().take(2)).copied().collect();
        self.path(&closed, colour, width);
    }

    /// A filled polygon.
    pub(super) fn polygon(&mut self, points: &[At], colour: RGBColor) {
        self.veil(points, colour, 1.0);
    }

    /// A filled polygon that is seen through.
    pub(super) fn veil(&mut self, points: &[At], colour: RGBColor, opacity: f64) {
        let style = ShapeStyle { color: colour.mix(opacity), filled: true, stroke_width: 0 };
        let drawn = self.backend.fill_polygon(points.iter().copied(), &style);
        self.keep(drawn);
    }

    fn circle(&mut self, at: At, radius: i32, colour: RGBColor, filled: bool, width: u32) {
        let style = ShapeStyle { color: colour.to_rgba(), filled, stroke_width: width };
        let drawn = self.backend.draw_circle(at, radius.unsigned_abs(), &style, filled);
        self.keep(drawn);
    }

    /// A marker: filled, or an outline of a width.
    pub(super) fn marker(&mut self, marker: Marker, at: At, radius: i32, colour: RGBColor, outline: Option<u32>) {
        let ((x, y), r) = (at, radius);
        let square = 9 * r / 10;
        let corners: &[At] = match marker {
            Marker::Circle => return self.circle(at, r, colour, outline.is_none(), outline.unwrap_or(0)),
            Marker::Cross => {
                let width = outline.unwrap_or(3);
                self.line((x - r, y - r), (x + r, y + r), colour, width);
                return self.line((x - r, y + r), (x + r, y - r), colour, width);
            }
            Marker::Square => &Area { x: x - square, y: y - square, width: 2 * square, height: 2 * square }.corners(),
            Marker::Triangle => &[(x, y - r - r / 6), (x + r + r / 10, y + 3 * r / 4), (x - r - r / 10, y + 3 * r / 4)],
            Marker::Diamond => &[(x, y - r - r / 5), (x + r + r / 5, y), (x, y + r + r / 5), (x - r - r / 5, y)],
        };
        match outline {
            Some(width) => self.outline(corners, colour, width),
            None => self.polygon(corners, colour),
        }
    }

    /// A word; its middle line goes through `at`.
    pub(super) fn text(&mut self, text: &str, at: At, size: i32, anchor: Anchor) {
        self.set(text, at, size, anchor, FontTransform::None);
    }

    /// A word that is read from below.
    pub(super) fn text_upwards(&mut self, text: &str, at: At, size: i32) {
        self.set(text, at, size, Anchor::Middle, FontTransform::Rotate270);
    }

    fn set(&mut self, text: &str, at: At, size: i32, anchor: Anchor, transform: FontTransform) {
        let horizontal = match anchor {
            Anchor::Left => HPos::Left,
            Anchor::Middle => HPos::Center,
            Anchor::Right => HPos::Right,
        };
        // the backend takes sizes in units of 1.24
        let font = (FontFamily::SansSerif, f64::from(size) * 1.24).into_font().transform(transform);
        let style = TextStyle::from(font).color(&colours::BLACK).pos(Pos::new(horizontal, VPos::Center));
        let drawn = self.backend.draw_text(text, &style, at);
        self.keep(drawn);
    }

    /// Lines of text, the first with its middle at `at`, each spaced from the last.
    pub(super) fn lines(&mut self, lines: &[String], at: At, size: i32, anchor: Anchor) {
        for (number, line) in (0..).zip(lines) {
            self.text(line, (at.0, at.1 + number * line_height(size)), size, anchor);
        }
    }
}

/// From one line of text to the next.
pub(super) fn line_height(size: i32) -> i32 {
    size * 27 / 20
}

/// The estimated width of a word.
pub(super) fn text_width(text: &str, size: i32) -> i32 {
    let hundredths = |letter: char| match letter {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | ' ' | 'ι' => 28,
        'f' | 't' | 'r' | '(' | ')' | '-' | '·' | '/' => 38,
        '₀'..='₉' | '²' | '³' | '⁰'..='⁹' => 42,
        'm' | 'w' | 'W' | 'M' | '…' => 88,
        'A'..='Z' | '−' | '+' | '=' | '≤' | '≥' | '≠' | '<' | '>' | '≈' | 'ω' => 66,
        _ => 58,
    };
    text.chars().map(hundredths).sum::<i32>() * size / 100
}

/// A text in lines of at most a width, broken between words; lines after the first are indented.
pub(super) fn wrapped(text: &str, width: i32, size: i32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if text_width(line, size) + text_width(word, size) + size / 2 <= width => {
                line.push(' ');
                line.push_str(word);
            }
            // a space that is kept at the start of a line
            Some(_) => lines.push(format!("\u{a0}\u{a0}\u{a0}{word}")),
            None => lines.push(word.to_string()),
        }
    }
    lines
}

/// A window onto the plane: equal scales, the second axis upwards.
pub(super) struct View {
    scale: f64,
    middle: Complex64,
    to: At,
}

impl View {
    /// Shows all of the points in an area.
    pub(super) fn of(points: impl Iterator<Item = Complex64>, area: Area) -> View {
        let mut low = Complex64::new(f64::INFINITY, f64::INFINITY);
        let mut high = -low;
        for point in points {
            low = Complex64::new(low.re.min(point.re), low.im.min(point.im));
            high = Complex64::new(high.re.max(point.re), high.im.max(point.im));
        }
        let scale = (f64::from(area.width) / (high.re - low.re)).min(f64::from(area.height) / (high.im - low.im));
        let scale = if scale.is_finite() && scale > 0.0 { scale } else { 1.0 };
        View { scale, middle: (low + high) / 2.0, to: area.middle() }
    }

    /// With a scale of at most so many units.
    pub(super) fn at_most(self, scale: f64) -> View {
        View { scale: self.scale.min(scale), ..self }
    }

    /// Where a point of the plane is seen.
    pub(super) fn at(&self, point: Complex64) -> At {
        let from_middle = (point - self.middle) * self.scale;
        (self.to.0 + from_middle.re.round() as i32, self.to.1 - from_middle.im.round() as i32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_broken_between_words_and_keep_all_of_them() {
        let text = "one two three four five six seven eight nine ten";
        let lines = wrapped(text, 200, SMALL);
        assert!(lines.len() > 2);
        assert!(lines.iter().all(|line| text_width(line, SMALL) <= 200 + SMALL * 2));
        assert_eq!(lines.join(" ").replace('\u{a0}', ""), text);
    }

    #[test]
    fn a_view_keeps_its_points_inside() {
        let area = Area { x: 10, y: 20, width: 100, height: 50 };
        let points = [Complex64::new(-1.0, 2.0), Complex64::new(3.0, 4.0)];
        let view = View::of(points.into_iter(), area);
        for (x, y) in points.map(|point| view.at(point)) {
            assert!((10..=110).contains(&x) && (20..=70).contains(&y), "{x} {y}");
        }
    }

    #[test]
    fn a_view_of_one_point_shows_it_in_the_middle() {
        let area = Area { x: 0, y: 0, width: 100, height: 60 };
        assert_eq!(View::of([Complex64::ONE].into_iter(), area).at(Complex64::ONE), (50, 30));
    }
}
