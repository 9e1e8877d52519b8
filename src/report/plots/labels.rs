//! Where does the weight of a point stand, so that it covers nothing?
//!
//! Each word in turn takes the best of the places around its point: free of markers and of words set before, off the lines if
//! possible, rather outwards than inwards.

use super::canvas::{Anchor, Area, At, Canvas, colours, text_width};

/// A point with the word that belongs to it.
pub(super) struct Labelled {
    pub(super) at: At,
    pub(super) radius: i32,
    pub(super) text: String,
}

/// The places tried, as directions from the point; outward ones are preferred by their cosine.
const DIRECTIONS: [(i32, i32); 16] = [
    (10, 0),
    (-10, 0),
    (0, -10),
    (0, 10),
    (8, -10),
    (-8, -10),
    (8, 10),
    (-8, 10),
    (10, -5),
    (10, 5),
    (-10, -5),
    (-10, 5),
    (4, -10),
    (-4, -10),
    (4, 10),
    (-4, 10),
];

#[derive(Clone, Copy)]
struct Block {
    low: At,
    high: At,
}

impl Block {
    fn around(at: At, half_width: i32, half_height: i32) -> Block {
        Block { low: (at.0 - half_width, at.1 - half_height), high: (at.0 + half_width, at.1 + half_height) }
    }

    fn overlap(&self, other: &Block) -> i64 {
        let width = self.high.0.min(other.high.0) - self.low.0.max(other.low.0);
        let height = self.high.1.min(other.high.1) - self.low.1.max(other.low.1);
        i64::from(width.max(0)) * i64::from(height.max(0))
    }

    fn corners(&self) -> [At; 4] {
        [self.low, (self.high.0, self.low.1), self.high, (self.low.0, self.high.1)]
    }

    fn size(&self) -> i64 {
        self.overlap(self)
    }

    /// How far it is from a marker, along the axes.
    fn gap(&self, at: At, radius: i32) -> i32 {
        let beyond = |low: i32, high: i32, x: i32| (low - x).max(x - high).max(0);
        (beyond(self.low.0, self.high.0, at.0).max(beyond(self.low.1, self.high.1, at.1)) - radius).max(0)
    }

    /// How many of 40 points along a line it covers.
    fn covers(&self, (from, to): &(At, At)) -> i64 {
        let between = |a: i32, b: i32, step: i32| a + (b - a) * step / 40;
        let inside = |step: &i32| {
            let (x, y) = (between(from.0, to.0, *step), between(from.1, to.1, *step));
            (self.low.0..=self.high.0).contains(&x) && (self.low.1..=self.high.1).contains(&y)
        };
        (0..=40).filter(inside).count() as i64
    }
}

/// Sets the words in an area; `lines` are those of the mesh, `markers` further things not to cover.
pub(super) fn set(
    canvas: &mut Canvas,
    area: Area,
    points: &[Labelled],
    lines: &[(At, At)],
    markers: &[(At, i32)],
    size: i32,
) {
    let whole = Block { low: (area.x, area.y), high: (area.x + area.width, area.y + area.height) };
    let own = points.iter().map(|point| (point.at, point.radius));
    let markers: Vec<(At, i32)> = markers.iter().copied().chain(own).collect();
    let mut taken: Vec<Block> = markers.iter().map(|(at, radius)| Block::around(*at, radius + 2, radius + 2)).collect();
    for point in points.iter().filter(|point| !point.text.is_empty()) {
        let block = best(point, &Surroundings { whole, taken: &taken, markers: &markers, lines }, size);
        let at = ((block.low.0 + block.high.0) / 2, (block.low.1 + block.high.1) / 2);
        let words = Block { low: (block.low.0 + size / 5, block.low.1), high: (block.high.0 - size / 5, block.high.1) };
        canvas.veil(&words.corners(), colours::WHITE, 0.75);
        canvas.text(&point.text, at, size, Anchor::Middle);
        taken.push(block);
    }
}

/// What a word should keep clear of, and the area that it should stay in.
struct Surroundings<'a> {
    whole: Block,
    taken: &'a [Block],
    markers: &'a [(At, i32)],
    lines: &'a [(At, At)],
}

impl Surroundings<'_> {
    /// How bad it is to set the word of a point there.
    fn cost(&self, point: &Labelled, block: &Block, size: i32) -> i64 {
        let hidden: i64 = self.taken.iter().map(|other| block.overlap(other)).sum();
        let outside = block.size() - block.overlap(&self.whole);
        let crossed: i64 = self.lines.iter().map(|line| block.covers(line)).sum();
        let own = block.gap(point.at, point.radius);
        // a reader gives a word to the nearest point
        let rivals =
            self.markers.iter().filter(|(at, radius)| *at != point.at && block.gap(*at, *radius) < own + 8).count();
        200 * (hidden + 4 * outside) / i64::from(size) + 40 * crossed + 250 * rivals as i64 + 3 * i64::from(own)
    }

    fn middle(&self) -> At {
        ((self.whole.low.0 + self.whole.high.0) / 2, (self.whole.low.1 + self.whole.high.1) / 2)
    }
}

fn best(point: &Labelled, around: &Surroundings, size: i32) -> Block {
    // words side by side keep a distance
    let half = (text_width(&point.text, size) / 2 + size / 5, size * 11 / 20);
    let outward = (point.at.0 - around.middle().0, point.at.1 - around.middle().1);
    let length = f64::from(outward.0 * outward.0 + outward.1 * outward.1).sqrt().max(1.0) as i32;
    let tried = [4, 14, 26].into_iter().flat_map(|gap| DIRECTIONS.iter().map(move |direction| (gap, *direction)));
    let place = |(gap, (dx, dy)): (i32, (i32, i32))| {
        let (x, y) = (dx * (point.radius + gap + half.0) / 10, dy * (point.radius + gap + half.1) / 10);
        let block = Block::around((point.at.0 + x, point.at.1 + y), half.0, half.1);
        let inward = i64::from(20 - 2 * (dx * outward.0 + dy * outward.1) / length);
        (around.cost(point, &block, size) + 3 * inward, block)
    };
    tried.map(place).min_by_key(|(cost, _)| *cost).map_or(Block::around(point.at, half.0, half.1), |(_, block)| block)
}
