//! What is the least sum of |alpha_l| with y = sum_l alpha_l v_l?
//!
//! The norm of y whose unit ball is the hull of all v_l and -v_l. The simplex method (Dantzig) in floating point, with the inverse of the basis
//! updated; n of the v_l with the right signs are a first basis. Its results are approximate: they are suggestions that are verified exactly.

use super::transition::dot;

/// Tolerance for prices.
const PRICES: f64 = 1e-11;
/// Smaller pivots are not used.
const PIVOT: f64 = 1e-10;
/// How far sums may drift from those computed anew, and how often the method then starts again.
const DRIFT: f64 = 1e-10;
const RESTARTS: usize = 4;
/// Rounds until the method is given up.
const ROUNDS: usize = 400;

/// A basis: n vertices, and the inverse of the matrix whose columns they are.
#[derive(Clone, Debug)]
pub(super) struct Basis {
    /// The vertices' numbers.
    pub(super) vertices: Vec<usize>,
    inverse: Vec<Vec<f64>>,
}

/// An approximate representation.
#[derive(Clone, Debug)]
pub(super) struct Combination {
    /// The vertices' numbers with their coefficients.
    pub(super) terms: Vec<(usize, f64)>,
    /// The sum of the coefficients' absolute values.
    pub(super) norm: f64,
}

impl Basis {
    /// Chooses n independent vertices, the largest pivot first; `None` where they don't span the space.
    pub(super) fn new(vertices: &[Vec<f64>], n: usize) -> Option<Basis> {
        let mut rest: Vec<Vec<f64>> = vertices.to_vec();
        let mut chosen = Vec::new();
        for _ in 0..n {
            let size = |x: &Vec<f64>| dot(x, x);
            let (at, square) = (0..rest.len()).map(|l| (l, size(&rest[l]))).max_by(|x, y| x.1.total_cmp(&y.1))?;
            if square < 1e-20 {
                return None;
            }
            let pivot = rest[at].clone();
            for x in &mut rest {
                let factor = dot(x, &pivot) / square;
                x.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
            }
            chosen.push(at);
        }
        let columns: Vec<&Vec<f64>> = chosen.iter().map(|l| &vertices[*l]).collect();
        Some(Basis { inverse: inverted(&columns)?, vertices: chosen })
    }

    /// The least sum, or the first found that is at most `enough`; where rounding lets sums drift again and again, the
    /// least one seen. `None` where rounding spoils the method.
    pub(super) fn least(&self, vertices: &[Vec<f64>], y: &[f64], enough: f64) -> Option<Combination> {
        let (mut basis, mut best) = (self.clone(), None::<Combination>);
        for _ in 0..RESTARTS {
            let mut now = Stage::new(&basis, y);
            let norm = now.descend(vertices, enough)?;
            // the inverse was updated many times: the coefficients are computed anew
            basis.vertices = now.basis.iter().map(|(l, _)| *l).collect();
            let columns: Vec<&Vec<f64>> = basis.vertices.iter().map(|l| &vertices[*l]).collect();
            basis.inverse = inverted(&columns)?;
            let x: Vec<f64> = basis.inverse.iter().map(|row| dot(row, y)).collect();
            let anew: f64 = x.iter().map(|x| x.abs()).sum();
            if best.as_ref().is_none_or(|best| anew < best.norm) {
                best = Some(Combination { terms: basis.vertices.iter().copied().zip(x).collect(), norm: anew });
            }
            if (anew - norm).abs() <= DRIFT {
                break;
            }
        }
        best
    }
}

/// A corner of the set of all coefficients: a basis with signs, its coefficients, and its inverse.
struct Stage {
    basis: Vec<(usize, f64)>,
    x: Vec<f64>,
    inverse: Vec<Vec<f64>>,
}

impl Stage {
    fn new(basis: &Basis, y: &[f64]) -> Stage {
        let sign = |x: f64| if x < 0.0 { -1.0 } else { 1.0 };
        let x: Vec<f64> = basis.inverse.iter().map(|row| dot(row, y)).collect();
        let signed = |(row, x): (&Vec<f64>, &f64)| row.iter().map(|value| sign(*x) * value).collect();
        Stage {
            basis: basis.vertices.iter().zip(&x).map(|(l, x)| (*l, sign(*x))).collect(),
            inverse: basis.inverse.iter().zip(&x).map(signed).collect(),
            x: x.iter().map(|x| x.abs()).collect(),
        }
    }

    /// Goes from corner to corner until no vertex makes the sum smaller, or it is small enough; gives the sum.
    fn descend(&mut self, vertices: &[Vec<f64>], enough: f64) -> Option<f64> {
        let n = self.x.len();
        for _ in 0..ROUNDS {
            let norm: f64 = self.x.iter().sum();
            let prices: Vec<f64> = (0..n).map(|j| self.inverse.iter().map(|row| row[j]).sum()).collect();
            let offers = vertices.iter().map(|v| dot(&prices, v)).enumerate();
            let (enter, offer) = offers.max_by(|x, y| x.1.abs().total_cmp(&y.1.abs()))?;
            if norm <= enough || offer.abs() <= 1.0 + PRICES {
                return norm.is_finite().then_some(norm);
            }
            self.exchange(enter, offer.signum(), &vertices[enter])?;
        }
        None
    }

    /// Puts a vertex into the basis; of those that may leave, the one with the largest pivot does.
    fn exchange(&mut self, enter: usize, sign: f64, vertex: &[f64]) -> Option<()> {
        let direction: Vec<f64> = self.inverse.iter().map(|row| sign * dot(row, vertex)).collect();
        let may = || (0..direction.len()).filter(|i| direction[*i] > PIVOT);
        let most = may().map(|i| (self.x[i].max(0.0) + PIVOT) / direction[i]).min_by(f64::total_cmp)?;
        let near = may().filter(|i| self.x[*i].max(0.0) / direction[*i] <= most);
        let leave = near.max_by(|i, j| direction[*i].total_cmp(&direction[*j]))?;
        let step = self.x[leave].max(0.0) / direction[leave];
        let pivot: Vec<f64> = self.inverse[leave].iter().map(|value| value / direction[leave]).collect();
        for i in (0..direction.len()).filter(|i| *i != leave) {
            self.x[i] -= step * direction[i];
            self.inverse[i].iter_mut().zip(&pivot).for_each(|(value, p)| *value -= direction[i] * p);
        }
        self.inverse[leave] = pivot;
        (self.x[leave], self.basis[leave]) = (step, (enter, sign));
        Some(())
    }
}

/// The inverse of the matrix with these columns, by Gauss and Jordan with pivots.
fn inverted(columns: &[&Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = columns.len();
    let unit = |i: usize| (0..n).map(move |j| f64::from(u8::from(i == j)));
    let mut rows: Vec<Vec<f64>> = (0..n).map(|i| columns.iter().map(|c| c[i]).chain(unit(i)).collect()).collect();
    for k in 0..n {
        let at = (k..n).max_by(|i, j| rows[*i][k].abs().total_cmp(&rows[*j][k].abs()))?;
        rows.swap(k, at);
        let pivot: Vec<f64> = rows[k].iter().map(|value| value / rows[k][k]).collect();
        if !pivot.iter().all(|value| value.is_finite()) {
            return None;
        }
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[k];
            if i != k {
                row.iter_mut().zip(&pivot).for_each(|(value, p)| *value -= factor * p);
            }
        }
        rows[k] = pivot;
    }
    Some(rows.into_iter().map(|row| row[n..].to_vec()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The norms whose unit balls are known: sum of sizes, and in the plane the largest size.
    #[test]
    fn the_norm_of_a_polytope_is_that_of_its_ball() {
        let octahedron: Vec<Vec<f64>> = (0..3).map(|i| (0..3).map(|j| f64::from(u8::from(i == j))).collect()).collect();
        let basis = Basis::new(&octahedron, 3).unwrap();
        assert!((basis.least(&octahedron, &[1.0, -2.0, 0.5], 0.0).unwrap().norm - 3.5).abs() < 1e-12);
        let square = vec![vec![1.0, 1.0], vec![1.0, -1.0], vec![0.5, 0.25], vec![1.0, 0.0]];
        let basis = Basis::new(&square, 2).unwrap();
        for y in [[0.3, -0.9], [2.0, 1.0], [0.0, 0.0], [-1.0, 1.0]] {
            let found = basis.least(&square, &y, 0.0).unwrap();
            assert!((found.norm - f64::max(f64::abs(y[0]), f64::abs(y[1]))).abs() < 1e-12, "{y:?}");
            let at = |i: usize| found.terms.iter().map(|(l, alpha)| alpha * square[*l][i]).sum::<f64>();
            assert!((at(0) - y[0]).abs() < 1e-12 && (at(1) - y[1]).abs() < 1e-12);
        }
        assert!(Basis::new(&[vec![1.0, 2.0], vec![2.0, 4.0]], 2).is_none());
    }
}
