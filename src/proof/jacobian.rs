//! What are the Bezier points of a patch of the ring, and the Bernstein coefficients of its Jacobian?
//!
//! Tensor-product B-splines of degree 2 and 3 and the quartic box spline of three directions, each taken twice. Common positive factors are
//! dropped. The Jacobian is the determinant of the two derivatives; its coefficients are sums of determinants of differences of Bezier
//! points (Farin 2002), and where all of them are positive, so is it on the closed patch.

use super::net::{Function, Net, Pair};
use super::positive::binomial;
use crate::analysis::regular::box_spline::BoxSpline;
use crate::mesh::Lattice;
use crate::numbers::{Field, Trouble};
use crate::refine::Obstacle;
use dashu_ratio::RBig;
use std::collections::BTreeMap;

/// The Bezier points or coefficients of a patch, by their indices.
pub type Grid<T> = BTreeMap<(usize, usize), T>;

/// What the limit functions of a scheme are on a regular mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pieces {
    /// Tensor products of this degree, 2 or 3.
    Tensor(usize),
    /// Quartics on triangles.
    Quartic,
}

impl Pieces {
    /// The pieces of a box spline on a lattice, where there is a table for them.
    pub fn of(spline: &BoxSpline, lattice: Lattice) -> Option<Pieces> {
        let mut directions = spline.directions.clone();
        directions.sort_unstable();
        match (lattice, spline.bidegree()) {
            (Lattice::Quads, Some([3, 3])) => Some(Pieces::Tensor(3)),
            (Lattice::Dual, Some([2, 2])) => Some(Pieces::Tensor(2)),
            (Lattice::Triangles, None) => {
                let twice = directions.len() == 3 && directions.iter().all(|(_, times)| *times == 2);
                let steps = [[1, 0], [0, 1], [-1, 1]];
                let step = |d: &[i32; 2]| steps.contains(d) || steps.contains(&[-d[0], -d[1]]);
                (twice && directions.iter().all(|(d, _)| step(d))).then_some(Pieces::Quartic)
            }
            _ => None,
        }
    }

    /// The patches of half a sector of the ring, as their origins with a sign: -1 for a triangle turned by half a turn.
    pub fn ring(self) -> [((i32, i32), i32); 2] {
        let last = if self == Pieces::Quartic { -1 } else { 1 };
        [((1, 0), 1), ((1, 1), last)]
    }

    /// The controls of patches i..k along a direction are those from i + the first number to before k + the second.
    pub fn controls(self) -> (i32, i32) {
        match self {
            Pieces::Tensor(degree) => (-1, degree as i32 - 1),
            Pieces::Quartic => (-1, 2),
        }
    }

    /// The Bezier points of a patch, up to a common positive factor.
    ///
    /// # Errors
    /// As [`Net::at`].
    pub fn bezier(self, net: &mut Net, patch: ((i32, i32), i32)) -> Result<Grid<Pair>, Obstacle> {
        match self {
            Pieces::Tensor(degree) => tensor(net, patch.0, degree),
            Pieces::Quartic => quartic(net, patch),
        }
    }

    /// The Bernstein coefficients of the Jacobian, each up to a positive factor.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn jacobian(self, points: &Grid<Pair>) -> Result<Grid<Function>, Trouble> {
        let (first, second) = (differences(points, (1, 0))?, differences(points, (0, 1))?);
        let mut sums = Grid::new();
        for ((i, j), u) in &first {
            for ((k, l), v) in &second {
                let factor = match self {
                    Pieces::Tensor(d) => binomial(d - 1, *i) * binomial(d, *j) * binomial(d, *k) * binomial(d - 1, *l),
                    Pieces::Quartic => trinomial(*i, *j) * trinomial(*k, *l),
                };
                let determinant = u.0.times(&v.1)?.minus(&u.1.times(&v.0)?)?;
                let sum = sums.entry((i + k, j + l)).or_insert_with(|| Function::whole(0));
                *sum = sum.plus(&determinant.times(&Function::rational(&factor))?)?;
            }
        }
        Ok(sums)
    }
}

/// 3!/(i! j! (3 - i - j)!).
fn trinomial(i: usize, j: usize) -> RBig {
    binomial(3, i) * binomial(3 - i, j)
}

fn differences(points: &Grid<Pair>, (di, dj): (usize, usize)) -> Result<Grid<Pair>, Trouble> {
    let mut differences = Grid::new();
    for ((i, j), (a, b)) in points {
        if let Some((next_a, next_b)) = points.get(&(i + di, j + dj)) {
            differences.insert((*i, *j), (next_a.minus(a)?, next_b.minus(b)?));
        }
    }
    Ok(differences)
}

fn combined<'p>(terms: impl Iterator<Item = (i64, &'p Pair)>) -> Result<Pair, Trouble> {
    let mut sum = (Function::whole(0), Function::whole(0));
    for (weight, (a, b)) in terms.filter(|(weight, _)| *weight != 0) {
        let weight = Function::whole(weight);
        sum = (sum.0.plus(&a.times(&weight)?)?, sum.1.plus(&b.times(&weight)?)?);
    }
    Ok(sum)
}

/// 6 times the Bezier points of a cubic, 2 times those of a quadratic uniform B-spline.
const CUBIC: [&[i64]; 4] = [&[1, 4, 1, 0], &[0, 4, 2, 0], &[0, 2, 4, 0], &[0, 1, 4, 1]];
const QUADRATIC: [&[i64]; 3] = [&[1, 1, 0], &[0, 2, 0], &[0, 1, 1]];

fn tensor(net: &mut Net, (x, y): (i32, i32), degree: usize) -> Result<Grid<Pair>, Obstacle> {
    let rows: &[&[i64]] = if degree == 3 { &CUBIC } else { &QUADRATIC };
    let mut controls = Grid::new();
    for (i, j) in (0..=degree).flat_map(|j| (0..=degree).map(move |i| (i, j))) {
        controls.insert((i, j), net.at(x + i as i32 - 1, y + j as i32 - 1)?);
    }
    let mut points = Grid::new();
    for (p, q) in (0..=degree).flat_map(|q| (0..=degree).map(move |p| (p, q))) {
        let terms = controls.iter().map(|((i, j), value)| (rows[p][*i] * rows[q][*j], value));
        points.insert((p, q), combined(terms)?);
    }
    Ok(points)
}

/// The controls of the triangle (0, 0), (1, 0), (0, 1).
const CONTROLS: [(i32, i32); 12] =
    [(-1, 0), (0, -1), (-1, 1), (0, 0), (1, -1), (-1, 2), (0, 1), (1, 0), (2, -1), (0, 2), (1, 1), (2, 0)];

/// 24 times the Bezier points of the quartic box spline: index (i, j) of u^i v^j (1 - u - v)^(4 - i - j), then the controls' weights.
/// Its weights are those that two refinements and the limit masks give at the 15 points of the lattice of fourths.
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

fn quartic(net: &mut Net, ((x, y), sign): ((i32, i32), i32)) -> Result<Grid<Pair>, Obstacle> {
    let controls: Vec<Pair> =
        CONTROLS.iter().map(|(i, j)| net.at(x + sign * i, y + sign * j)).collect::<Result<_, _>>()?;
    let mut points = Grid::new();
    for (index, weights) in &QUARTIC {
        points.insert(*index, combined(weights.iter().copied().zip(&controls))?);
    }
    Ok(points)
}
