//! Does the orbit of the fastest direction close to a polytope?
//!
//! The images of a vertex under T_e/q are vertices as well, unless they lie inside; when no new ones come, T_e is at most q in the norm of the
//! polytope (Guglielmi and Protasov 2013). With q equal to the candidate's rate this is done with rational numbers and shows that the
//! candidate is the fastest product. With q a little above, it is done in floating point; then vertices are rounded, and the small rest of
//! each equation is written in n of the vertices exactly and added.

use super::simplex::Basis;
use super::transition::{Floats, dot, exact_image, floats, image};
use super::witness::Polytope;
use crate::numbers::linear::{Matrix, null_space, transposed};
use dashu_base::BitTest;
use dashu_ratio::RBig;

/// What an exact polytope's nearly tight points are told apart by.
const SLACK: f64 = 1e-9;
/// What is nearer to the boundary than this counts as inside while searching.
const NEAR: f64 = 1e-10;
/// Vertices are rounded to multiples of 2^-50.
const GRID: f64 = (1_u64 << 50) as f64;
/// Directions that the orbit doesn't reach get vertices of size 1/SMALL.
const SMALL: i64 = 32;
/// The most vertices of an exact polytope, and the most bits of their numbers.
const EXACT_VERTICES: usize = 60;
const EXACT_BITS: usize = 3000;

/// The polytope of T_e/q, from these directions on; `None` where it has more than `most` vertices.
fn closed(scaled: &[Floats], directions: &[Vec<f64>], most: usize) -> Option<Vec<Vec<f64>>> {
    let n = scaled.first().map_or(0, Vec::len);
    let mut vertices = spanning(scaled, directions, n);
    let mut at = 0;
    let basis = Basis::new(&vertices, n)?;
    while at < vertices.len() {
        for matrix in scaled {
            let y = image(matrix, &vertices[at]);
            if basis.least(&vertices, &y, 1.0 - NEAR)?.norm > 1.0 + NEAR {
                vertices.push(y);
            }
        }
        at += 1;
        if vertices.len() > most {
            return None;
        }
    }
    Some(vertices)
}

/// The part of x that is orthogonal to orthonormal vectors.
fn rest(x: &[f64], orthonormal: &[Vec<f64>]) -> Vec<f64> {
    let mut x = x.to_vec();
    for own in orthonormal.iter().chain(orthonormal) {
        let factor = dot(&x, own);
        x.iter_mut().zip(own).for_each(|(x, own)| *x -= factor * own);
    }
    x
}

/// Points of the orbit that span what the orbit spans, and small unit vectors for what it doesn't.
fn spanning(scaled: &[Floats], directions: &[Vec<f64>], n: usize) -> Vec<Vec<f64>> {
    let (mut found, mut orthonormal): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (directions.to_vec(), Vec::new());
    let adds = |x: &[f64], orthonormal: &mut Vec<Vec<f64>>| {
        let new = rest(x, orthonormal);
        let size = libm::sqrt(dot(&new, &new));
        let adds = size > 1e-4 * libm::sqrt(dot(x, x));
        if adds {
            orthonormal.push(new.iter().map(|value| value / size).collect());
        }
        adds
    };
    for x in directions {
        adds(x, &mut orthonormal);
    }
    let mut at = 0;
    while at < found.len() && orthonormal.len() < n {
        for matrix in scaled {
            let y = image(matrix, &found[at]);
            if adds(&y, &mut orthonormal) {
                found.push(y);
            }
        }
        at += 1;
    }
    for i in 0..n {
        let unit: Vec<f64> = (0..n).map(|j| f64::from(u8::from(i == j)) / SMALL as f64).collect();
        if adds(&unit, &mut orthonormal) {
            found.push(unit);
        }
    }
    found
}

/// The matrices as floating numbers over a rate.
fn over(matrices: &[Matrix<RBig>], rate: f64) -> Vec<Floats> {
    let scaled = |matrix: Floats| matrix.iter().map(|row| row.iter().map(|x| x / rate).collect()).collect();
    matrices.iter().map(|matrix| scaled(floats(matrix))).collect()
}

/// The vertices for a rate that is above the radius, rounded; `None` where there are more than `most`.
pub(super) fn vertices_for(
    matrices: &[Matrix<RBig>],
    directions: &[Vec<f64>],
    rate: f64,
    most: usize,
) -> Option<Vec<Vec<RBig>>> {
    let vertices = closed(&over(matrices, rate), directions, most)?;
    let rounded = |x: &f64| RBig::try_from(libm::round(x * GRID) / GRID).ok();
    vertices.iter().map(|v| v.iter().map(rounded).collect()).collect()
}

/// The equations that show the bound q by these vertices; `None` where they don't. `enough` ends the search for coefficients.
pub(super) fn with_images(
    matrices: &[Matrix<RBig>],
    vertices: &[Vec<RBig>],
    q: &RBig,
    enough: f64,
) -> Option<Polytope> {
    let near = |v: &[RBig]| -> Vec<f64> { v.iter().map(|value| value.to_f64().value()).collect() };
    let approx: Vec<Vec<f64>> = vertices.iter().map(|v| near(v)).collect();
    let basis = Basis::new(&approx, matrices.first()?.len())?;
    let corner = Corner::new(vertices, &basis.vertices)?;
    let of_image = |matrix: &Matrix<RBig>, vertex: &Vec<RBig>| {
        let y: Vec<RBig> = exact_image(matrix, vertex).into_iter().map(|value| value / q).collect();
        let found = basis.least(&approx, &near(&y), enough)?;
        corner.completed(vertices, &y, &found.terms)
    };
    let images = vertices
        .iter()
        .map(|vertex| matrices.iter().map(|matrix| of_image(matrix, vertex)).collect::<Option<Vec<_>>>())
        .collect::<Option<Vec<_>>>()?;
    Some(Polytope { vertices: vertices.to_vec(), images })
}

/// A polytope for the rate times 1 + slack, which shows a bound q above that by a quarter of the slack; `None` where it doesn't
/// close or the check fails.
pub(super) fn with_slack(
    matrices: &[Matrix<RBig>],
    directions: &[Vec<f64>],
    rate: f64,
    slack: f64,
    most: usize,
) -> Option<(RBig, Polytope)> {
    let rate = rate * (1.0 + slack);
    let vertices = vertices_for(matrices, directions, rate, most)?;
    let q = RBig::try_from(rate * (1.0 + slack / 4.0)).ok()?;
    let polytope = with_images(matrices, &vertices, &q, 1.0 - slack)?;
    Some((q, polytope))
}

/// n vertices that are a basis, and its inverse.
struct Corner {
    vertices: Vec<usize>,
    inverse: Matrix<RBig>,
}

impl Corner {
    fn new(exact: &[Vec<RBig>], vertices: &[usize]) -> Option<Corner> {
        let n = vertices.len();
        let columns = transposed(&vertices.iter().map(|l| exact[*l].clone()).collect());
        let solved = (0..n).map(|j| {
            let unit: Vec<RBig> = (0..n).map(|i| if i == j { RBig::ONE } else { RBig::ZERO }).collect();
            solution(&columns, &unit)
        });
        let inverse = transposed(&solved.collect::<Option<Vec<_>>>()?);
        Some(Corner { vertices: vertices.to_vec(), inverse })
    }

    /// Approximate coefficients of y, completed to exact ones; `None` where the sum of their sizes is above 1.
    fn completed(&self, exact: &[Vec<RBig>], y: &[RBig], terms: &[(usize, f64)]) -> Option<Vec<(usize, RBig)>> {
        let (mut rest, mut all) = (y.to_vec(), std::collections::BTreeMap::new());
        for (l, alpha) in terms {
            let alpha = RBig::try_from(*alpha).ok()?;
            rest.iter_mut().zip(&exact[*l]).for_each(|(rest, value)| *rest -= &alpha * value);
            *all.entry(*l).or_insert(RBig::ZERO) += alpha;
        }
        for (l, alpha) in self.vertices.iter().zip(exact_image(&self.inverse, &rest)) {
            *all.entry(*l).or_insert(RBig::ZERO) += alpha;
        }
        all.retain(|_, alpha| !alpha.is_zero());
        (sum_of_sizes(all.values()) <= RBig::ONE).then(|| all.into_iter().collect())
    }
}

fn sum_of_sizes<'a>(values: impl Iterator<Item = &'a RBig>) -> RBig {
    values.fold(RBig::ZERO, |sum, x| if *x < RBig::ZERO { sum - x } else { sum + x })
}

/// The x with A x = y; `None` where there is not just one.
fn solution(columns: &Matrix<RBig>, y: &[RBig]) -> Option<Vec<RBig>> {
    let with_right: Matrix<RBig> = columns.iter().zip(y).map(|(row, y)| [row.as_slice(), &[-y]].concat()).collect();
    let mut kernel = null_space(&with_right).ok()?;
    let mut only = kernel.pop().filter(|_| kernel.is_empty())?;
    let scale = only.pop().filter(|value| !value.is_zero())?;
    Some(only.into_iter().map(|value| value / &scale).collect())
}

/// A polytope that shows the bound q by vertices that are not rounded; `None` where it doesn't close, as when q is below the radius.
pub(super) fn exactly(matrices: &[Matrix<RBig>], directions: &[Vec<RBig>], q: &RBig) -> Option<Polytope> {
    let n = matrices.first()?.len();
    let near = |v: &[RBig]| -> Vec<f64> { v.iter().map(|value| value.to_f64().value()).collect() };
    let mut exact = exact_spanning(matrices, directions, q, n);
    let mut vertices: Vec<Vec<f64>> = exact.iter().map(|v| near(v)).collect();
    let basis = Basis::new(&vertices, n)?;
    let mut images = Vec::new();
    while images.len() < exact.len() {
        let mut own = Vec::new();
        for matrix in matrices {
            let y: Vec<RBig> = exact_image(matrix, &exact[images.len()]).into_iter().map(|value| value / q).collect();
            let inside = inside(&basis, &vertices, &exact, &y);
            own.push(inside.unwrap_or_else(|| vec![(exact.len(), RBig::ONE)]));
            if own.last().is_some_and(|terms| terms.iter().any(|(l, _)| *l == exact.len())) {
                vertices.push(near(&y));
                exact.push(y);
            }
        }
        images.push(own);
        let large = exact.last()?.iter().any(|value| value.denominator().bit_len() > EXACT_BITS);
        if exact.len() > EXACT_VERTICES || large {
            return None;
        }
    }
    Some(Polytope { vertices: exact, images })
}

/// The exact coefficients of a point in the polytope; `None` where it is outside or no basis shows that it isn't.
fn inside(basis: &Basis, vertices: &[Vec<f64>], exact: &[Vec<RBig>], y: &[RBig]) -> Option<Vec<(usize, RBig)>> {
    let near: Vec<f64> = y.iter().map(|value| value.to_f64().value()).collect();
    let found = basis.least(vertices, &near, 1.0 - SLACK)?;
    if found.norm > 1.0 + SLACK {
        return None;
    }
    let columns = transposed(&found.terms.iter().map(|(l, _)| exact[*l].clone()).collect());
    let alpha = solution(&columns, y)?;
    let terms = found.terms.iter().map(|(l, _)| *l).zip(alpha).filter(|(_, alpha)| !alpha.is_zero()).collect();
    let fits = |terms: &Vec<(usize, RBig)>| sum_of_sizes(terms.iter().map(|(_, alpha)| alpha)) <= RBig::ONE;
    Some(terms).filter(fits)
}

/// The directions, points of their orbits that enlarge the span, and small unit vectors for what is missing.
fn exact_spanning(matrices: &[Matrix<RBig>], directions: &[Vec<RBig>], q: &RBig, n: usize) -> Vec<Vec<RBig>> {
    let rank = |found: &Vec<Vec<RBig>>| null_space(found).map_or(0, |kernel| n - kernel.len());
    let (mut found, mut at) = (directions.to_vec(), 0);
    let add = |found: &mut Vec<Vec<RBig>>, y: Vec<RBig>| {
        let before = rank(found);
        found.push(y);
        if rank(found) == before {
            found.pop();
        }
    };
    while at < found.len() && rank(&found) < n {
        for matrix in matrices {
            let y = exact_image(matrix, &found[at]).into_iter().map(|value| value / q).collect();
            add(&mut found, y);
        }
        at += 1;
    }
    for i in (0..n).filter(|_| rank(&found) < n).collect::<Vec<_>>() {
        let unit = (0..n).map(|j| if i == j { RBig::ONE / RBig::from(SMALL) } else { RBig::ZERO }).collect();
        add(&mut found, unit);
    }
    found
}
