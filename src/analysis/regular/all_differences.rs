//! How smooth are limits where the symbol lacks factors? What the differences of all directions prove.
//!
//! Let M = m I and sum rules of order k = r + 1 hold. A difference of order k of the points that L steps make vanishes on polynomials of degree
//! below k, so it is a sum of differences of order k of the old points. Let q be the largest sum of the moduli of its coefficients. If
//! q < m^(-rL), limits are C^r (Cavaretta, Dahmen and Micchelli 1991, Dyn 1992): divided differences of order r converge uniformly. The
//! coefficients are not unique; those of the least sum of squares are taken, in whole numbers over one denominator, and put into the equation.

use super::differences::{Contraction, Grid};
use super::mask::Point;
use dashu_base::{Abs, UnsignedAbs};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use std::collections::BTreeMap;

/// The most steps of which differences are looked at.
const MOST_STEPS: u32 = 4;

/// The most points of a window, and the most differences of new points.
const MOST_POINTS: usize = 64;
const MOST_NEW: usize = 1500;

/// A difference or functional by its weights at points.
type Functional = BTreeMap<Point, IBig>;

/// The differences of order k along the axes, mixed ones among them.
fn differences(k: usize) -> Vec<Functional> {
    let signed = |n: usize, i: usize| {
        let binomial = (0..i).fold(IBig::ONE, |product, j| product * (n - j) / (j + 1));
        if (n - i).is_multiple_of(2) { binomial } else { -binomial }
    };
    let along = |a: usize, b: usize| {
        let points = (0..=a).flat_map(|s| (0..=b).map(move |t| (s, t)));
        points.map(|(s, t)| ([s as i32, t as i32], signed(a, s) * signed(b, t))).collect()
    };
    (0..=k).map(|b| along(k - b, b)).collect()
}

/// The differences of the points that the iterated mask makes, as functionals of the old points, each moved to the origin.
fn of_new_points(iterated: &Grid, stretch: i32, difference: &Functional) -> Vec<Functional> {
    let mut all: BTreeMap<Point, Functional> = BTreeMap::new();
    for (at, value) in iterated.values.iter().enumerate().filter(|(_, value)| !value.is_zero()) {
        let (x, y) = ((at % iterated.width) as i32, (at / iterated.width) as i32);
        for ([s, t], sign) in difference {
            let (u, v) = (x - s, y - t);
            let coset = [u.rem_euclid(stretch), v.rem_euclid(stretch)];
            let old = [-u.div_euclid(stretch), -v.div_euclid(stretch)];
            *all.entry(coset).or_default().entry(old).or_insert(IBig::ZERO) += value * sign;
        }
    }
    all.into_values().map(at_the_origin).collect()
}

fn at_the_origin(mut functional: Functional) -> Functional {
    functional.retain(|_, value| !value.is_zero());
    let least = |axis: usize| functional.keys().map(|point| point[axis]).min().unwrap_or(0);
    let (x, y) = (least(0), least(1));
    functional.into_iter().map(|([i, j], value)| ([i - x, j - y], value)).collect()
}

/// The differences of order k inside a rectangle, and what expresses functionals by them.
struct Window {
    height: i32,
    /// By the index of their points.
    placed: Vec<Vec<(usize, IBig)>>,
    /// The inverse of D D^T + P P^T times its determinant: D has the differences as columns, P the monomials of degree below k.
    inverse: Vec<Vec<IBig>>,
    determinant: IBig,
}

impl Window {
    fn new([width, height]: Point, k: usize) -> Window {
        let points: Vec<Point> = (0..width).flat_map(|x| (0..height).map(move |y| [x, y])).collect();
        let inside = |[x, y]: Point| (x < width && y < height).then_some((x * height + y) as usize);
        let mut placed = Vec::new();
        for difference in differences(k) {
            for [x, y] in &points {
                let own = difference.iter().map(|([s, t], sign)| Some((inside([x + s, y + t])?, sign.clone())));
                placed.extend(own.collect::<Option<Vec<_>>>());
            }
        }
        let mut gram = vec![vec![IBig::ZERO; points.len()]; points.len()];
        let power = |base: i32, exponent: usize| IBig::from(base).pow(exponent);
        let monomials = (0..k).flat_map(|d| (0..=d).map(move |b| (d - b, b)));
        let monomials =
            monomials.map(|(a, b)| points.iter().map(|[x, y]| power(*x, a) * power(*y, b)).enumerate().collect());
        for vector in placed.iter().cloned().chain(monomials) {
            let vector: Vec<(usize, IBig)> = vector;
            for (i, x) in &vector {
                for (j, y) in &vector {
                    gram[*i][*j] += x * y;
                }
            }
        }
        let (inverse, determinant) = inverse(gram);
        Window { height, placed, inverse, determinant }
    }

    /// The sum of the moduli of the coefficients of a functional in the differences, times the determinant; `None` where it is no sum of them.
    fn size(&self, functional: &Functional) -> Option<UBig> {
        let index = |[x, y]: Point| (x * self.height + y) as usize;
        let y: Vec<IBig> = self
            .inverse
            .iter()
            .map(|row| functional.iter().map(|(point, value)| &row[index(*point)] * value).sum())
            .collect();
        let (mut size, mut sum) = (UBig::ZERO, vec![IBig::ZERO; y.len()]);
        for difference in &self.placed {
            let coefficient: IBig = difference.iter().map(|(at, sign)| sign * &y[*at]).sum();
            difference.iter().for_each(|(at, sign)| sum[*at] += sign * &coefficient);
            size += coefficient.abs().unsigned_abs();
        }
        functional.iter().for_each(|(point, value)| sum[index(*point)] -= &self.determinant * value);
        sum.iter().all(IBig::is_zero).then_some(size)
    }
}

/// The inverse of a positive definite matrix times its determinant, and that, without fractions (Bareiss 1968).
fn inverse(matrix: Vec<Vec<IBig>>) -> (Vec<Vec<IBig>>, IBig) {
    let size = matrix.len();
    let unit = |i: usize| (0..size).map(move |j| if i == j { IBig::ONE } else { IBig::ZERO });
    let mut rows: Vec<Vec<IBig>> =
        matrix.into_iter().enumerate().map(|(i, row)| row.into_iter().chain(unit(i)).collect()).collect();
    let mut before = IBig::ONE;
    for pivot in 0..size {
        let own = rows[pivot].clone();
        for (i, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != pivot) {
            let factor = row[pivot].clone();
            debug_assert!(i < size);
            for (entry, above) in row.iter_mut().zip(&own) {
                *entry = (&*entry * &own[pivot] - &factor * above) / &before;
            }
        }
        before = own[pivot].clone();
    }
    (rows.into_iter().map(|row| row[size..].to_vec()).collect(), before)
}

/// The largest sum of moduli for the differences of order k after a number of steps with this iterated mask; `None` beyond stated limits, or where
/// differences of new points are no sums of old ones.
fn norm(iterated: &Grid, stretch: i32, k: usize) -> Option<RBig> {
    if (stretch * stretch) as usize * (k + 1) > MOST_NEW {
        return None;
    }
    let mut windows: BTreeMap<Point, Window> = BTreeMap::new();
    let mut largest = RBig::ZERO;
    for difference in differences(k) {
        for functional in of_new_points(iterated, stretch, &difference) {
            let extent = |axis: usize| functional.keys().map(|point| point[axis]).max().unwrap_or(0).max(k as i32) + 1;
            let shape = [extent(0), extent(1)];
            if (shape[0] * shape[1]) as usize > MOST_POINTS {
                return None;
            }
            let window = windows.entry(shape).or_insert_with(|| Window::new(shape, k));
            let size = RBig::from(window.size(&functional)?) / RBig::from(window.determinant.clone());
            largest = largest.max(size);
        }
    }
    Some(largest / RBig::from(iterated.denominator.clone()))
}

/// The least number of steps after which the differences of order r + 1 show that limits are C^r, up to stated limits.
pub(super) fn contraction(mask: &Grid, m: i32, r: usize) -> Option<Contraction> {
    let mut iterated = mask.clone();
    let mut stretch = m;
    for steps in 1..=MOST_STEPS {
        let norm = norm(&iterated, stretch, r + 1)?;
        let below = RBig::ONE / RBig::from(stretch).pow(r as isize);
        if norm < below {
            return Some(Contraction { steps, norm, below });
        }
        iterated = iterated.times_stretched(mask, stretch as usize)?;
        stretch = stretch.checked_mul(m)?;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::regular::mask::Mask;
    use crate::scheme::{Scheme, catalogue};

    fn shown(scheme: &Scheme, r: usize) -> bool {
        contraction(&Grid::of(&Mask::of(scheme).unwrap().coefficients).unwrap(), 2, r).is_some()
    }

    /// The splines are as smooth as they are and no smoother; the butterfly scheme is C1 and not C2 (Zorin 2000), which takes more steps than are tried.
    #[test]
    fn differences_show_what_is_known_and_no_more() {
        let all = [("loop", 2, 3), ("catmull-clark", 2, 3), ("doo-sabin", 1, 2), ("modified-butterfly", 0, 2)];
        for (id, smooth, too_smooth) in all {
            let scheme = catalogue::open(id).unwrap().unwrap();
            assert!((0..=smooth).all(|r| shown(&scheme, r)), "{id}");
            assert!(!shown(&scheme, too_smooth), "{id}: too smooth");
        }
    }

    /// Midpoints alone: piecewise linear limits.
    #[test]
    fn what_is_not_c1_is_not_shown_to_be() {
        let text = "name = \"Linear\"\nmesh = \"triangles\"\nsplit = \"1-to-4\"\n[vertex]\ncentre = \"1\"\n[edge]\nends = \"1/2\"\n";
        let scheme = Scheme::parse("own", "own.toml", text).unwrap();
        assert!(shown(&scheme, 0) && !shown(&scheme, 1));
    }

    #[test]
    fn an_inverse_times_its_matrix_is_the_determinant() {
        let rows = [[4, 1, 2], [1, 5, 3], [2, 3, 6]].map(|row| row.map(IBig::from).to_vec()).to_vec();
        let (inverse, determinant) = inverse(rows.clone());
        assert_eq!(determinant, IBig::from(70));
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let sum: IBig = rows[i].iter().zip(&inverse).map(|(a, b)| a * &b[j]).sum();
            assert_eq!(sum, if i == j { determinant.clone() } else { IBig::ZERO });
        }
    }
}
