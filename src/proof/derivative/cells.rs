//! On which points does a limit over a tile of the lattice depend, and how are those of its parts made?
//!
//! A cell is a tile: a triangle, or a square, whose corners are points, or on the dual lattice a square around a point. It is told by its
//! origin o and a sign, which is -1 for a triangle that is turned by half a turn; its points are o + sign q for the q of a finite set, the closure
//! of a seed under the rows of its parts. Masks on triangles are the same after half a turn, so that all cells share these rows.

use crate::analysis::regular::mask::{Point, Sequence};
use crate::mesh::Lattice;
use crate::numbers::{Interval, Trouble};
use crate::proof::valence::source;
use dashu_ratio::RBig;
use std::collections::{BTreeMap, BTreeSet};

/// A tile of the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cell {
    /// The point that it is told from.
    pub origin: Point,
    /// 1, or -1 where the other corners of a triangle are o - (1, 0) and o - (0, 1).
    pub sign: i32,
}

impl Cell {
    /// The point of a cell for q.
    pub fn point(self, [x, y]: Point) -> Point {
        [self.origin[0] + self.sign * x, self.origin[1] + self.sign * y]
    }
}

/// How a lattice is cut into cells, and these into parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiling {
    /// The lattice.
    pub lattice: Lattice,
    /// How many times the lattice of the parts is as fine.
    pub dilation: i32,
}

impl Tiling {
    /// The parts of the cell at 0.
    pub fn parts(self) -> Vec<Cell> {
        let d = self.dilation;
        let places = (0..d).flat_map(|y| (0..d).map(move |x| [x, y]));
        match self.lattice {
            Lattice::Triangles => triangles(places, 0, d).collect(),
            _ => places.map(|origin| Cell { origin, sign: 1 }).collect(),
        }
    }

    /// The cells of half a sector between the rings s and d s, where d is the dilation: the mirror gives the others.
    pub fn ring(self, s: i32) -> Vec<Cell> {
        let last = self.dilation * s;
        let places = (0..last).flat_map(|x| (0..=x).map(move |y| [x, y]));
        match self.lattice {
            Lattice::Triangles => triangles(places, s, last).collect(),
            _ => places.filter(|[x, _]| *x >= s).map(|origin| Cell { origin, sign: 1 }).collect(),
        }
    }

    /// The corners of the cell at 0, in halves of an edge, from the point 0.
    pub fn corners(self) -> &'static [Point] {
        match self.lattice {
            Lattice::Triangles => &[[0, 0], [2, 0], [0, 2]],
            Lattice::Quads => &[[0, 0], [2, 0], [0, 2], [2, 2]],
            Lattice::Dual => &[[-1, -1], [1, -1], [-1, 1], [1, 1]],
        }
    }

    /// Where a corner of a part, told as [`Tiling::corners`], lies in the cell at 0.
    pub fn within(self, part: Cell, corner: Point) -> [RBig; 2] {
        let half = if self.lattice.has_centre() { RBig::ZERO } else { RBig::ONE / RBig::from(2) };
        [0, 1].map(|axis| {
            let place = RBig::from(part.origin[axis]) + RBig::from(part.sign * corner[axis]) / RBig::from(2);
            (place + &half) / RBig::from(self.dilation) - &half
        })
    }

    /// Where the fine point at `place` lies on the coarse lattice, along each axis.
    pub fn position(self, place: Point) -> [RBig; 2] {
        let half = if self.lattice.has_centre() { RBig::ZERO } else { RBig::ONE / RBig::from(2) };
        place.map(|x| (RBig::from(x) + &half) / RBig::from(self.dilation) - &half)
    }
}

/// Both triangles of the squares at these places, as far as they lie between two rings.
fn triangles(places: impl Iterator<Item = Point>, first: i32, last: i32) -> impl Iterator<Item = Cell> {
    places.flat_map(move |[x, y]| {
        let own = (first..last).contains(&(x + y)).then_some(Cell { origin: [x, y], sign: 1 });
        let other = (first..last).contains(&(x + y + 1)).then_some(Cell { origin: [x + 1, y + 1], sign: -1 });
        own.into_iter().chain(other)
    })
}

/// An old point by its index, and its weight.
pub type Row<W> = Vec<(usize, W)>;

/// A part of a cell.
pub struct Part {
    /// Where it lies, for the cell at 0.
    pub cell: Cell,
    /// The rows of its points.
    pub rows: Vec<Row<RBig>>,
    /// The same in intervals.
    pub enclosed: Vec<Row<Interval>>,
}

/// What all cells have in common.
pub struct Local {
    /// How the lattice is cut.
    pub tiling: Tiling,
    /// The points q; the first are [`BASE`].
    pub points: Vec<Point>,
    /// The parts of a cell.
    pub parts: Vec<Part>,
}

/// The points that quadratic functions are told by; the first three tell affine ones.
pub const BASE: [Point; 6] = [[0, 0], [1, 0], [0, 1], [1, 1], [-1, 0], [0, -1]];

/// The most points that a cell may have.
const MOST_POINTS: usize = 200;

impl Local {
    /// The points and rows for a mask of rational numbers; `None` where there are too many points.
    ///
    /// # Errors
    /// When a weight is no number.
    pub fn of(mask: &Sequence, tiling: Tiling) -> Result<Option<Local>, Trouble> {
        let Some(closed) = closure(mask, tiling, BASE.into()) else { return Ok(None) };
        let points: Vec<Point> =
            BASE.into_iter().chain(closed.into_iter().filter(|point| !BASE.contains(point))).collect();
        let index: BTreeMap<Point, usize> = points.iter().enumerate().map(|(index, q)| (*q, index)).collect();
        let mut weights = BTreeMap::new();
        for (alpha, weight) in mask {
            let value = weight.as_rational().ok_or(Trouble::BeyondThisWorld("a weight of the mask is no number"))?;
            weights.insert(*alpha, value);
        }
        let row = |place: Point| -> Row<RBig> {
            let old = |(alpha, weight): (&Point, &RBig)| {
                Some((*index.get(&source(place, *alpha, tiling.dilation)?)?, weight.clone()))
            };
            weights.iter().filter_map(old).collect()
        };
        let enclosed = |row: &Row<RBig>| row.iter().map(|(old, weight)| (*old, Interval::around(weight))).collect();
        let part = |cell: Cell| {
            let rows: Vec<Row<RBig>> = points.iter().map(|q| row(cell.point(*q))).collect();
            Part { cell, enclosed: rows.iter().map(enclosed).collect(), rows }
        };
        let parts = tiling.parts().into_iter().map(part).collect();
        Ok(Some(Local { tiling, points, parts }))
    }

    /// The largest distance of a point from its cell's origin, in edges.
    pub fn extent(&self) -> i32 {
        self.points.iter().map(|[x, y]| x.abs().max(y.abs()).max((x + y).abs())).max().unwrap_or(0)
    }
}

/// The least set with this seed that holds whatever the points of its parts are made of.
fn closure(mask: &Sequence, tiling: Tiling, seed: BTreeSet<Point>) -> Option<BTreeSet<Point>> {
    let parts = tiling.parts();
    let (mut closed, mut new) = (seed.clone(), seed);
    while !new.is_empty() {
        let mut found = BTreeSet::new();
        for place in parts.iter().flat_map(|part| new.iter().map(|q| part.point(*q))) {
            found.extend(mask.keys().filter_map(|alpha| source(place, *alpha, tiling.dilation)));
        }
        new = found.difference(&closed).copied().collect();
        closed.extend(&new);
        if closed.len() > MOST_POINTS {
            return None;
        }
    }
    Some(closed)
}
