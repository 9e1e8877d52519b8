//! By which mask are points made far from every extraordinary point?
//!
//! There a step is (S f)(alpha) = sum over beta of a(alpha - M beta) f(beta): one finite sequence a on the lattice Z^2, the mask, and the
//! dilation matrix M (Cavaretta, Dahmen and Micchelli 1991). The symbol a(z) = sum of a(alpha) z^alpha has the mask as coefficients;
//! the new points of one coset of M Z^2 share a submask, the stencil that papers draw.

use crate::mesh::{Label, Patch};
use crate::numbers::{Field, Free, FreeWorld, PerFrequency, Trouble};
use crate::refine::{Count, ExactWeights, Obstacle, Refinement, lattice_of};
use crate::scheme::Scheme;
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// A point of the lattice Z^2, in the coordinates of a sector of [`crate::mesh::Lattice`].
pub type Point = [i32; 2];

/// A finite sequence on the lattice, or the Laurent polynomial with these coefficients; none of them is 0.
pub type Sequence = BTreeMap<Point, Free>;

/// A dilation matrix: whole entries, and a determinant other than 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dilation([[i32; 2]; 2]);

impl Dilation {
    /// The matrix with these rows; `None` where its determinant is 0.
    pub fn new(rows: [[i32; 2]; 2]) -> Option<Dilation> {
        let dilation = Dilation(rows);
        (dilation.determinant() != 0).then_some(dilation)
    }

    /// The matrix m I, for steps that make m points from one along each edge; m is raised to 1.
    pub fn whole(m: i32) -> Dilation {
        Dilation([[m.max(1), 0], [0, m.max(1)]])
    }

    /// The rows.
    pub fn rows(self) -> [[i32; 2]; 2] {
        self.0
    }

    /// The determinant.
    pub fn determinant(self) -> i32 {
        let [[a, b], [c, d]] = self.0;
        a * d - b * c
    }

    /// The m of m I, for m from 2 on.
    pub fn arity(self) -> Option<i32> {
        let [[a, b], [c, d]] = self.0;
        (a == d && b == 0 && c == 0 && a >= 2).then_some(a)
    }

    /// The matrices m I and R with M = m R and det R = 1 or -1, told by m and R; `None` where M is no such product.
    pub fn turned(self) -> Option<(i32, Dilation)> {
        let m = self.determinant().abs().isqrt();
        let whole = m * m == self.determinant().abs() && self.0.iter().flatten().all(|entry| entry % m == 0);
        whole.then(|| (m, Dilation(self.0.map(|row| row.map(|entry| entry / m)))))
    }

    /// M N
    fn times(self, other: Dilation) -> Dilation {
        let [[a, b], [c, d]] = other.0;
        let ([u, v], [x, y]) = (self.image([a, c]), self.image([b, d]));
        Dilation([[u, x], [v, y]])
    }

    /// M p.
    pub fn image(self, [x, y]: Point) -> Point {
        let [[a, b], [c, d]] = self.0;
        [a * x + b * y, c * x + d * y]
    }

    /// The representative of a point's coset: p - M floor(M^-1 p).
    pub fn representative(self, [x, y]: Point) -> Point {
        let ([[a, b], [c, d]], det) = (self.0, self.determinant());
        // a floor of v/det for either sign of det
        let floor = |v: i32| (v * det.signum()).div_euclid(det.abs());
        let [u, v] = self.image([floor(d * x - b * y), floor(a * y - c * x)]);
        [x - u, y - v]
    }

    /// One representative of each coset of M Z^2, in order; there are |det M|.
    pub fn cosets(self) -> Vec<Point> {
        let size = self.determinant().abs();
        let points = (0..size).flat_map(|x| (0..size).map(move |y| [x, y]));
        let all: BTreeSet<Point> = points.map(|point| self.representative(point)).collect();
        all.into_iter().collect()
    }
}

/// The mask of a scheme on its regular lattice.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    /// The dilation matrix.
    pub dilation: Dilation,
    /// The coefficients; with free parameters they are functions of these.
    pub coefficients: Sequence,
    /// The names of the free parameters.
    pub parameters: Vec<String>,
}

/// The most steps after which a dilation matrix is looked at.
const MOST_STEPS: u32 = 2;

/// The place that rows are read at, far from every sector's edge; more than twice the longest walk of a rule.
const FAR: i32 = 64;

impl Mask {
    /// The mask of a scheme, exactly. Parameters that are left free stay so.
    ///
    /// # Errors
    /// When a weight has no value, or is no rational number (function of the free parameters).
    pub fn of(scheme: &Scheme) -> Result<Mask, Obstacle> {
        let parameters: Vec<String> = scheme.free_parameters().into_iter().map(str::to_string).collect();
        let world = FreeWorld { parameters: parameters.clone() };
        // at the regular valence every place looks like the centre: no ring is summed
        let weights = ExactWeights::new(&world, Count::Number, usize::MAX, Rc::new(Cell::new(0)));
        let refinement: Refinement<PerFrequency<Free>> = Refinement::weighed(scheme, weights);
        let lattice = lattice_of(scheme);
        let patch = Patch::new(lattice, lattice.regular_valence());
        // of as many steps as bring the lattice back
        let dilation = Dilation::whole(refinement.cycle()?.dilation);
        let coefficients = coefficients(dilation, |[i, j]| {
            let row = refinement.row(&patch, Label { sector: 0, i, j })?;
            Ok(row.into_iter().map(|(old, weight)| ([old.i, old.j], weight.general)).collect())
        })?;
        Ok(Mask { dilation, coefficients, parameters })
    }

    /// A mask from its coefficients; zeros are dropped.
    pub fn new(dilation: Dilation, coefficients: impl IntoIterator<Item = (Point, Free)>) -> Mask {
        let coefficients = coefficients.into_iter().filter(|(_, weight)| !weight.is_certainly_zero()).collect();
        Mask { dilation, coefficients, parameters: vec![] }
    }

    /// The tensor product of two masks of curves with the same arity m, each by its coefficients.
    ///
    /// # Errors
    /// When the numbers pass a limit of size.
    pub fn tensor(m: i32, first: &[(i32, Free)], second: &[(i32, Free)]) -> Result<Mask, Trouble> {
        let pairs = first.iter().flat_map(|(i, a)| second.iter().map(move |(j, b)| Ok(([*i, *j], a.times(b)?))));
        Ok(Mask::new(Dilation::whole(m), pairs.collect::<Result<Vec<_>, Trouble>>()?))
    }

    /// The mask of this step after another: a(z) b(z^M), with the dilation matrix M N.
    ///
    /// # Errors
    /// When the numbers pass a limit of size.
    pub fn after(&self, other: &Mask) -> Result<Mask, Trouble> {
        let mut product = Sequence::new();
        for (alpha, a) in &self.coefficients {
            for (beta, b) in &other.coefficients {
                let [x, y] = self.dilation.image(*beta);
                add(&mut product, [alpha[0] + x, alpha[1] + y], &a.times(b)?)?;
            }
        }
        let dilation = self.dilation.times(other.dilation);
        Ok(Mask { dilation, coefficients: product, parameters: self.parameters.clone() })
    }

    /// The mask of the least number of steps whose dilation matrix is m R with R of determinant 1 or -1, read with m I, and that number.
    /// This is the same scheme with the new points named anew, if the mask is the same after R, up to a translation; `None` where it isn't, or no
    /// such number is found.
    ///
    /// # Errors
    /// When the numbers pass a limit of size.
    pub fn straightened(&self) -> Result<Option<(Mask, u32)>, Trouble> {
        let mut iterated = self.clone();
        for steps in 1..=MOST_STEPS {
            if let Some((m, turn)) = iterated.dilation.turned().filter(|(m, _)| *m >= 2) {
                let own = iterated.is_invariant_under(turn);
                return Ok(own.then(|| (Mask { dilation: Dilation::whole(m), ..iterated }, steps)));
            }
            iterated = self.after(&iterated)?;
        }
        Ok(None)
    }

    /// Whether a(R p + t) = a(p) for some t.
    fn is_invariant_under(&self, turn: Dilation) -> bool {
        let image: Sequence =
            self.coefficients.iter().map(|(point, weight)| (turn.image(*point), weight.clone())).collect();
        let (Some((low, _)), Some((from, _))) = (bounds(&self.coefficients), bounds(&image)) else { return false };
        let moved = |[x, y]: Point| [x - from[0] + low[0], y - from[1] + low[1]];
        image.into_iter().map(|(point, weight)| (moved(point), weight)).collect::<Sequence>() == self.coefficients
    }

    /// The coefficients on the coset of a representative.
    pub fn on_coset(&self, representative: Point) -> impl Iterator<Item = (Point, &Free)> {
        let own = move |point: &Point| self.dilation.representative(*point) == representative;
        self.coefficients.iter().filter(move |(point, _)| own(point)).map(|(point, weight)| (*point, weight))
    }

    /// The submask of a coset: the old points that the new point at its representative is made of, with their weights.
    pub fn stencil(&self, representative: Point) -> Vec<(Point, &Free)> {
        let [[a, b], [c, d]] = self.dilation.rows();
        let det = self.dilation.determinant();
        let old = |[x, y]: Point| {
            // M^-1 (representative - alpha), which is whole
            let (x, y) = (representative[0] - x, representative[1] - y);
            [(d * x - b * y) / det, (a * y - c * x) / det]
        };
        let mut stencil: Vec<_> = self.on_coset(representative).map(|(alpha, weight)| (old(alpha), weight)).collect();
        stencil.sort_by_key(|(point, _)| *point);
        stencil
    }
}

/// The coefficients of a mask from the rows of new points: `row` gives the old points with their weights.
fn coefficients(
    dilation: Dilation,
    row: impl Fn(Point) -> Result<Vec<(Point, Free)>, Obstacle>,
) -> Result<Sequence, Obstacle> {
    let base = dilation.image([FAR, FAR]);
    let mut sequence = Sequence::new();
    for coset in dilation.cosets() {
        let new = [base[0] + coset[0], base[1] + coset[1]];
        for (old, weight) in row(new)? {
            let [x, y] = dilation.image(old);
            add(&mut sequence, [new[0] - x, new[1] - y], &weight)?;
        }
    }
    Ok(sequence)
}

/// Adds to a coefficient; one that becomes 0 goes.
pub(super) fn add(sequence: &mut Sequence, point: Point, weight: &Free) -> Result<(), Trouble> {
    let sum = sequence.get(&point).map_or(Ok(weight.clone()), |own| own.plus(weight))?;
    if sum.is_certainly_zero() {
        sequence.remove(&point);
    } else {
        sequence.insert(point, sum);
    }
    Ok(())
}

/// The least and the largest coordinates of a sequence; `None` for the empty one.
pub fn bounds(sequence: &Sequence) -> Option<(Point, Point)> {
    let least = |axis: usize| sequence.keys().map(|point| point[axis]).min();
    let largest = |axis: usize| sequence.keys().map(|point| point[axis]).max();
    Some(([least(0)?, least(1)?], [largest(0)?, largest(1)?]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosets_of_the_dilation_matrices_of_the_field() {
        // dyadic, ternary, quincunx, sqrt3 (both ways round), 2I with a turn
        let matrices = [
            [[2, 0], [0, 2]],
            [[3, 0], [0, 3]],
            [[1, 1], [1, -1]],
            [[1, -1], [1, 1]],
            [[1, 2], [-2, -1]],
            [[2, 1], [-1, 1]],
            [[0, -2], [2, 0]],
        ];
        for rows in matrices {
            let dilation = Dilation::new(rows).unwrap();
            let cosets = dilation.cosets();
            assert_eq!(cosets.len() as i32, dilation.determinant().abs(), "{rows:?}");
            assert!(cosets.contains(&[0, 0]));
            for point in (-7..7).flat_map(|x| (-7..7).map(move |y| [x, y])) {
                let own = dilation.representative(point);
                assert!(cosets.contains(&own), "{rows:?} {point:?}");
                let [x, y] = dilation.image(point);
                assert_eq!(dilation.representative([x + 5, y - 3]), dilation.representative([5, -3]), "{rows:?}");
            }
        }
        assert_eq!(Dilation::new([[1, 2], [2, 4]]), None);
    }
}
