//! How is a number drawn against the valence?
//!
//! A frame with whole valences below and a scale at the left.

use super::canvas::{Anchor, Area, At, Canvas, SMALL, TEXT, colours, text_width};

/// The frame of a diagram.
pub(super) struct Axes {
    pub(super) area: Area,
    /// In order, each once.
    valences: Vec<usize>,
    first: usize,
    last: usize,
    low: f64,
    high: f64,
}

/// The room for one tick below the frame.
const TICK_WIDTH: i32 = 64;

impl Axes {
    /// A frame for these valences and values from `low` to `high`.
    pub(super) fn new(area: Area, mut valences: Vec<usize>, low: f64, high: f64) -> Axes {
        valences.sort_unstable();
        valences.dedup();
        let (first, last) = (valences.first().copied().unwrap_or(0), valences.last().copied().unwrap_or(0));
        Axes { area, valences, first, last, low, high }
    }

    /// The distance from a valence to the next.
    pub(super) fn spacing(&self) -> f64 {
        f64::from(self.area.width) / (self.last - self.first + 1) as f64
    }

    /// Where a valence stands.
    pub(super) fn x(&self, valence: usize) -> i32 {
        self.area.x + (((valence - self.first) as f64 + 0.5) * self.spacing()).round() as i32
    }

    /// Where a value stands.
    pub(super) fn y(&self, value: f64) -> i32 {
        let part = (value - self.low) / (self.high - self.low);
        self.area.y + self.area.height - (part * f64::from(self.area.height)).round() as i32
    }

    /// Draws frame, ticks and titles.
    pub(super) fn draw(&self, canvas: &mut Canvas, title: &str) {
        let Area { x, y, width, height } = self.area;
        let (right, bottom) = (x + width, y + height);
        let mut widest = 0;
        for (value, text) in ticks(self.low, self.high) {
            let at = self.y(value);
            canvas.line((x, at), (right, at), colours::PALE, 2);
            canvas.line((x - 8, at), (x, at), colours::BLACK, 2);
            canvas.text(&text, (x - 14, at), SMALL, Anchor::Right);
            widest = widest.max(text_width(&text, SMALL));
        }
        for valence in self.valence_ticks() {
            let at = self.x(valence);
            canvas.line((at, bottom), (at, bottom + 8), colours::BLACK, 2);
            canvas.text(&valence.to_string(), (at, bottom + 28), SMALL, Anchor::Middle);
        }
        let corners: [At; 4] = [(x, y), (right, y), (right, bottom), (x, bottom)];
        canvas.outline(&corners, colours::BLACK, 2);
        canvas.text("valence n", (x + width / 2, bottom + 76), TEXT, Anchor::Middle);
        canvas.text_upwards(title, (x - 14 - widest - 36, y + height / 2), TEXT);
    }

    /// Every valence, if there is room; else multiples of a round number.
    fn valence_ticks(&self) -> Vec<usize> {
        let roomy = |ticks: &Vec<usize>| ticks.windows(2).all(|pair| self.x(pair[1]) - self.x(pair[0]) >= TICK_WIDTH);
        let rounds = (0..6).flat_map(|zeros| [1, 2, 5].map(|digit| digit * 10_usize.pow(zeros)));
        let multiples = |step: usize| (self.first..=self.last).filter(move |n| n % step == 0).collect();
        std::iter::once(self.valences.clone()).chain(rounds.map(multiples)).find(roomy).unwrap_or_default()
    }
}

/// Four to nine round values from `low` to `high`, with their digits.
pub(super) fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    let (mut step, mut decimals) = (1e-6, 6_usize);
    for factor in [2.0, 2.5, 2.0].into_iter().cycle().take(45) {
        if (high - low) / step <= 8.0 {
            break;
        }
        step *= factor;
        decimals = if step < 0.99e-5 {
            6
        } else {
            (0..6).find(|d| step * f64::from(10_i32.pow(*d)) > 0.99).unwrap_or(6) as usize
        };
    }
    let first = (low / step).ceil() as i64;
    let all = (first..).map(|number| number as f64 * step).take_while(|value| *value <= high + step * 1e-6);
    all.map(|value| (value, format!("{value:.decimals$}"))).take(12).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(low: f64, high: f64) -> Vec<String> {
        ticks(low, high).into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(texts(0.0, 1.05), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(texts(0.9, 1.1), ["0.90", "0.95", "1.00", "1.05", "1.10"]);
        assert_eq!(texts(0.0, 40.0), ["0", "5", "10", "15", "20", "25", "30", "35", "40"]);
        assert_eq!(texts(0.5, 2.2), ["0.5", "1.0", "1.5", "2.0"]);
    }

    #[test]
    fn valences_are_thinned_where_they_crowd() {
        let area = Area { x: 100, y: 0, width: 1000, height: 500 };
        let ticks = |valences: Vec<usize>| Axes::new(area, valences, 0.0, 1.0).valence_ticks();
        assert_eq!(ticks(vec![5]), [5]);
        assert_eq!(ticks(vec![3, 60]), [3, 60]);
        assert_eq!(ticks((3..=12).collect()), (3..=12).collect::<Vec<_>>());
        assert_eq!(ticks((3..=60).collect()), [5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60]);
        assert_eq!(ticks((3..=1002).collect()), [100, 200, 300, 400, 500, 600, 700, 800, 900, 1000]);
    }
}
