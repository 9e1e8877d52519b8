//! What are the Bezier points of a patch of the ring, and the Bernstein coefficients of its Jacobian?
//!
//! Tensor-product B-splines and the quartic box spline of three directions, each taken twice. Common positive factors
//! are dropped. The Jacobian is the determinant of the two derivatives; its coefficients are sums of determinants of
//! differences of Bezier points (Farin 2002), and where all of them are positive, so is it on the closed patch. Values
//! are of any field.

use super::b_spline::{bezier_rows, choose};
use crate::analysis::regular::box_spline::BoxSpline;
use crate::mesh::Lattice;
use crate::numbers::{Field, Trouble};
use crate::refine::Obstacle;
use std::collections::BTreeMap;

/// The Bezier points or coefficients of a patch, by their indices.
pub type Grid<T> = BTreeMap<(usize, usize), T>;

/// A patch by its origin, with a sign: -1 for a triangle turned by half a turn.
pub type PatchAt = ((i32, i32), i32);

/// A net of values a + b w, as pairs.
pub trait ControlNet {
    /// What a and b are.
    type Value: Field;

    /// The value at (i, j) in the coordinates of sector 0, which may reach into the sectors beside it.
    ///
    /// # Errors
    /// When it isn't determined, or a limit of size is passed.
    fn at(&mut self, i: i32, j: i32) -> Result<(Self::Value, Self::Value), Obstacle>;
}

/// What the limit functions of a scheme are on a regular mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pieces {
    /// Tensor products of this degree.
    Tensor(usize),
    /// Quartics on triangles.
    Quartic,
}

/// Tensor products up to this degree: all factors stay small whole numbers.
const MOST_DEGREE: usize = 15;

impl Pieces {
    /// The pieces of a box spline on a lattice, where they are of one of these kinds: at a vertex of the lattice a
    /// symmetric B-spline has an odd degree, at the middle of a face an even one.
    pub fn of(spline: &BoxSpline, lattice: Lattice) -> Option<Pieces> {
        let mut directions = spline.directions.clone();
        directions.sort_unstable();
        match (lattice, spline.bidegree()) {
            (Lattice::Triangles, None) => {
                let twice = directions.len() == 3 && directions.iter().all(|(_, times)| *times == 2);
                let steps = [[1, 0], [0, 1], [-1, 1]];
                let step = |d: &[i32; 2]| steps.contains(d) || steps.contains(&[-d[0], -d[1]]);
                (twice && directions.iter().all(|(d, _)| step(d))).then_some(Pieces::Quartic)
            }
            (Lattice::Quads | Lattice::Dual, Some([d, e])) => {
                let odd = d % 2 == 1;
                let known = d == e && (2..=MOST_DEGREE).contains(&d) && odd == (lattice == Lattice::Quads);
                known.then_some(Pieces::Tensor(d))
            }
            _ => None,
        }
    }

    /// The patches of half a sector of the innermost ring.
    pub fn ring(self) -> [PatchAt; 2] {
        let last = if self == Pieces::Quartic { -1 } else { 1 };
        [((1, 0), 1), ((1, 1), last)]
    }

    /// The controls of patches i..k along a direction are those from i + the first number to before k + the second.
    pub fn controls(self) -> (i32, i32) {
        match self {
            Pieces::Tensor(degree) => (-(degree as i32 / 2), (degree - degree / 2) as i32),
            Pieces::Quartic => (-1, 2),
        }
    }

    /// A new point at (i, j) has old points in its regular row within half of this around (i/2, j/2), in each index.
    pub fn reach(self) -> i32 {
        match self {
            Pieces::Tensor(degree) => degree as i32 + 2,
            Pieces::Quartic => 4,
        }
    }

    /// Where the controls of a patch are.
    pub fn stencil(self, ((x, y), sign): PatchAt) -> Vec<(i32, i32)> {
        match self {
            Pieces::Tensor(_) => {
                let (low, end) = self.controls();
                (y + low..=y + end).flat_map(|j| (x + low..=x + end).map(move |i| (i, j))).collect()
            }
            Pieces::Quartic => CONTROLS.iter().map(|(i, j)| (x + sign * i, y + sign * j)).collect(),
        }
    }

    /// The Bezier points of a patch, up to a common positive factor.
    ///
    /// # Errors
    /// As [`ControlNet::at`].
    pub fn bezier<N: ControlNet>(self, net: &mut N, patch: PatchAt) -> Result<Grid<PairOf<N::Value>>, Obstacle> {
        let controls: Vec<PairOf<N::Value>> =
            self.stencil(patch).into_iter().map(|(i, j)| net.at(i, j)).collect::<Result<_, _>>()?;
        match self {
            Pieces::Tensor(degree) => Ok(tensor(&controls, degree)?),
            Pieces::Quartic => Ok(quartic(&controls)?),
        }
    }

    /// The Bernstein coefficients of the Jacobian, each up to a positive factor.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn jacobian<F: Field>(self, points: &Grid<PairOf<F>>) -> Result<Grid<F>, Trouble> {
        let (first, second) = (self.derivative(points, (1, 0))?, self.derivative(points, (0, 1))?);
        let mut sums: Grid<F> = Grid::new();
        for ((i, j), u) in &first {
            for ((k, l), v) in &second {
                let determinant = u.0.times(&v.1)?.minus(&u.1.times(&v.0)?)?;
                let sum = sums.entry((i + k, j + l)).or_insert_with(|| F::whole(0));
                *sum = sum.plus(&determinant)?;
            }
        }
        Ok(sums)
    }

    /// The differences of the Bezier points along a direction, each times its Bernstein polynomial's factor.
    fn derivative<F: Field>(
        self,
        points: &Grid<PairOf<F>>,
        (di, dj): (usize, usize),
    ) -> Result<Grid<PairOf<F>>, Trouble> {
        let mut differences = Grid::new();
        for ((i, j), (a, b)) in points {
            if let Some((next_a, next_b)) = points.get(&(i + di, j + dj)) {
                let factor = F::whole(match self {
                    Pieces::Tensor(degree) => choose(degree - di, *i) * choose(degree - dj, *j),
                    Pieces::Quartic => choose(3, *i) * choose(3 - i, *j),
                });
                differences.insert((*i, *j), (next_a.minus(a)?.times(&factor)?, next_b.minus(b)?.times(&factor)?));
            }
        }
        Ok(differences)
    }
}

/// A value a + b w, as (a, b).
pub type PairOf<F> = (F, F);

fn combined<'p, F: Field + 'p>(terms: impl Iterator<Item = (i64, &'p PairOf<F>)>) -> Result<PairOf<F>, Trouble> {
    let mut sum = (F::whole(0), F::whole(0));
    for (weight, (a, b)) in terms.filter(|(weight, _)| *weight != 0) {
        let weight = F::whole(weight);
        sum = (sum.0.plus(&a.times(&weight)?)?, sum.1.plus(&b.times(&weight)?)?);
    }
    Ok(sum)
}

/// Along one direction after the other.
fn tensor<F: Field>(controls: &[PairOf<F>], degree: usize) -> Result<Grid<PairOf<F>>, Trouble> {
    let rows = bezier_rows(degree);
    let mut along = Grid::new();
    for (j, controls) in controls.chunks(degree + 1).enumerate() {
        for (p, row) in rows.iter().enumerate() {
            along.insert((p, j), combined(row.iter().copied().zip(controls))?);
        }
    }
    let mut points = Grid::new();
    for (p, q) in (0..=degree).flat_map(|q| (0..=degree).map(move |p| (p, q))) {
        let terms = rows[q].iter().enumerate().map(|(j, weight)| (*weight, &along[&(p, j)]));
        points.insert((p, q), combined(terms)?);
    }
    Ok(points)
}

/// The controls of the triangle (0, 0), (1, 0), (0, 1).
const CONTROLS: [(i32, i32); 12] =
    [(-1, 0), (0, -1), (-1, 1), (0, 0), (1, -1), (-1, 2), (0, 1), (1, 0), (2, -1), (0, 2), (1, 1), (2, 0)];

/// 24 times the Bezier points of the quartic box spline: index (i, j) of u^i v^j (1 - u - v)^(4 - i - j), then the
/// controls' weights. Its weights are those that two refinements and the limit masks give at the 15 points of the
/// lattice of fourths.
const QUARTIC: [((usize, usize), [i64; 12]); 15] = [
    ((0, 0), [2, 2, 2, 12, 2, 0, 2, 2, 0, 0, 0, 0]),
    ((1, 0), [0, 1, 1, 12, 3, 0, 3, 4, 0, 0, 0, 0]),
    ((0, 1), [1, 0, 3, 12, 1, 0, 4, 3, 0, 0, 0, 0]),
    ((2, 0), [0, 0, 0, 8, 4, 0, 4, 8, 0, 0, 0, 0]),
    ((1, 1), [0, 0, 1, 10, 1, 0, 6, 6, 0, 0, 0, 0]),
    ((0, 2), [0, 0, 4, 8, 0, 0, 8, 4, 0, 0, 0, 0]),
    ((3, 0), [0, 0, 0, 4, 3, 0, 3, 12, 1, 0, 1, 0]),
    ((2, 1), [0, 0, 0, 6, 1, 0, 6, 10, 0, 0, 1, 0]),
    ((1, 2), [0, 0, 1, 6, 0, 0, 10, 6, 0, 0, 1, 0]),
    ((0, 3), [0, 0, 3, 4, 0, 1, 12, 3, 0, 0, 1, 0]),
    ((4, 0), [0, 0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2]),
    ((3, 1), [0, 0, 0, 3, 1, 0, 4, 12, 0, 0, 3, 1]),
    ((2, 2), [0, 0, 0, 4, 0, 0, 8, 8, 0, 0, 4, 0]),
    ((1, 3), [0, 0, 1, 3, 0, 0, 12, 4, 0, 1, 3, 0]),
    ((0, 4), [0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2, 0]),
];

fn quartic<F: Field>(controls: &[PairOf<F>]) -> Result<Grid<PairOf<F>>, Trouble> {
    let point =
        |(index, weights): &((usize, usize), [i64; 12])| Ok((*index, combined(weights.iter().copied().zip(controls))?));
    QUARTIC.iter().map(point).collect()
}
