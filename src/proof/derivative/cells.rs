//! On which points does a limit over a triangle depend, and how are those of its four parts made?
//!
//! A cell is a triangle of the lattice: its origin o, and a sign that is -1 for one turned by half a turn; its points
//! are o + sign q for the q of a finite set, the closure of a seed under the rows of its four parts. Masks are the
//! same after half a turn, so that all cells share these rows.

use crate::analysis::regular::mask::{Point, Sequence};
use crate::numbers::{Interval, Trouble};
use std::collections::{BTreeMap, BTreeSet};

/// A triangle of the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cell {
    /// The corner that it is told from.
    pub origin: Point,
    /// 1, or -1 where the other corners are o - (1, 0) and o - (0, 1).
    pub sign: i32,
}

/// The most points that a cell may have.
const MOST_POINTS: usize = 400;

impl Cell {
    /// The parts of the cell at 0 on the lattice that is twice as fine.
    pub const PARTS: [Cell; 4] = [
        Cell { origin: [0, 0], sign: 1 },
        Cell { origin: [1, 0], sign: 1 },
        Cell { origin: [0, 1], sign: 1 },
        Cell { origin: [1, 1], sign: -1 },
    ];

    /// The point of a cell for q.
    pub fn point(self, [x, y]: Point) -> Point {
        [self.origin[0] + self.sign * x, self.origin[1] + self.sign * y]
    }

    /// The cells of half a sector between the rings `scale` and 2 `scale`: the mirror gives the others.
    pub fn ring(scale: i32) -> Vec<Cell> {
        let mut cells = Vec::new();
        for (a, b) in (0..2 * scale).flat_map(|a| (0..=a).map(move |b| (a, b))) {
            if (scale..2 * scale).contains(&(a + b)) {
                cells.push(Cell { origin: [a, b], sign: 1 });
            }
            if (scale..2 * scale).contains(&(a + b + 1)) {
                cells.push(Cell { origin: [a + 1, b + 1], sign: -1 });
            }
        }
        cells
    }
}

/// An old point by its index, and its weight.
pub type Row = Vec<(usize, Interval)>;

/// What all cells have in common.
pub struct Local {
    /// The points q.
    pub points: Vec<Point>,
    /// For each part the rows of its points.
    pub parts: [Vec<Row>; 4],
    /// The points that limits over the cell depend on.
    pub values: Vec<usize>,
    /// The differences that the derivatives along (1, 0) and (0, 1) depend on: the index of q + e and that of q.
    pub differences: [Vec<(usize, usize)>; 2],
}

/// The axes e that derivatives are taken along.
pub const AXES: [Point; 2] = [[1, 0], [0, 1]];

impl Local {
    /// The points and rows for a mask and the masks of its differences along the axes; `None` where there are too
    /// many points.
    ///
    /// # Errors
    /// When a weight is no number.
    pub fn of(mask: &Sequence, along: &[Sequence; 2]) -> Result<Option<Local>, Trouble> {
        let values = closure(mask, [0, 0], [[0, 0]].into());
        let [first, second] = [0, 1].map(|axis| closure(&along[axis], AXES[axis], [[0, 0]].into()));
        let (Some(values), Some(first), Some(second)) = (values, first, second) else { return Ok(None) };
        let ends = |of: &BTreeSet<Point>, [x, y]: Point| -> Vec<(Point, Point)> {
            of.iter().map(|q| ([q[0] + x, q[1] + y], *q)).collect()
        };
        let pairs = [ends(&first, AXES[0]), ends(&second, AXES[1])];
        let mut seed = values.clone();
        seed.extend(pairs.iter().flatten().flat_map(|(head, tail)| [*head, *tail]));
        let Some(points) = closure(mask, [0, 0], seed) else { return Ok(None) };
        let points: Vec<Point> = points.into_iter().collect();
        let index: BTreeMap<Point, usize> = points.iter().enumerate().map(|(index, q)| (*q, index)).collect();
        let mut weights = BTreeMap::new();
        for (alpha, weight) in mask {
            let value = weight.as_rational().ok_or(Trouble::BeyondThisWorld("a weight of the mask is no number"))?;
            weights.insert(*alpha, Interval::around(&value));
        }
        let row = |part: &Cell, q: Point| -> Row {
            let old = |(alpha, weight): (&Point, &Interval)| {
                halved(part.point(q), *alpha).and_then(|old| Some((*index.get(&old)?, *weight)))
            };
            weights.iter().filter_map(old).collect()
        };
        let parts = Cell::PARTS.map(|part| points.iter().map(|q| row(&part, *q)).collect());
        let at = |q: &Point| index.get(q).copied();
        Ok(Some(Local {
            values: values.iter().filter_map(at).collect(),
            differences: pairs
                .map(|pairs| pairs.iter().filter_map(|(head, tail)| Some((at(head)?, at(tail)?))).collect()),
            points,
            parts,
        }))
    }

    /// The largest distance of a point from its cell's origin, in edges.
    pub fn extent(&self) -> i32 {
        self.points.iter().map(|[x, y]| x.abs().max(y.abs()).max((x + y).abs())).max().unwrap_or(0)
    }
}

/// (alpha - a)/2, where it is a point.
fn halved([x, y]: Point, [a, b]: Point) -> Option<Point> {
    let (x, y) = (x - a, y - b);
    (x % 2 == 0 && y % 2 == 0).then_some([x / 2, y / 2])
}

/// The least set with this seed that holds whatever the points of its four parts are made of. Where the data are
/// differences along e, half a turn sends the one at q to the one at -q - e.
fn closure(mask: &Sequence, e: Point, seed: BTreeSet<Point>) -> Option<BTreeSet<Point>> {
    let (mut closed, mut new) = (seed.clone(), seed);
    while !new.is_empty() {
        let mut found = BTreeSet::new();
        for (part, q) in Cell::PARTS.iter().flat_map(|part| new.iter().map(move |q| (part, *q))) {
            let turned = if part.sign > 0 { q } else { [q[0] + e[0], q[1] + e[1]] };
            found.extend(mask.keys().filter_map(|alpha| halved(part.point(turned), *alpha)));
        }
        new = found.difference(&closed).copied().collect();
        closed.extend(&new);
        if closed.len() > MOST_POINTS {
            return None;
        }
    }
    Some(closed)
}
