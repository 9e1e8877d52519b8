//! Which short product of the matrices grows fastest?
//!
//! rho(T_e1 ... T_eL)^(1/L) is a lower bound of the joint spectral radius for every product. The best one is looked for in floating point
//! among all products up to a length; the bound itself is from enclosed eigenvalues of the exact product.

use super::polytope::approximate;
use super::transition::{Exact, product};
use crate::numbers::{Enclosure, Field, Univariate, roots::roots};
use nalgebra::{DMatrix, DVector};

/// Products that are looked at.
const MOST_PRODUCTS: usize = 1200;

/// A product, its growth and its leading eigenvector.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    /// The digits e, the first applied first.
    pub digits: Vec<usize>,
    /// rho^(1/L), approximate.
    pub growth: f64,
}

/// The best product found.
pub(super) fn best_product(matrices: &[Exact]) -> Candidate {
    let t: Vec<DMatrix<f64>> = matrices.iter().map(approximate).collect();
    let mut best = Candidate { digits: vec![0], growth: 0.0 };
    let mut seen = 0;
    let mut level: Vec<(Vec<usize>, DMatrix<f64>)> = vec![(Vec::new(), DMatrix::identity(t[0].nrows(), t[0].nrows()))];
    while seen + level.len() * t.len() <= MOST_PRODUCTS {
        let extend = |(digits, m): &(Vec<usize>, DMatrix<f64>)| {
            t.iter().enumerate().map(|(e, t)| ([digits.as_slice(), &[e]].concat(), t * m)).collect::<Vec<_>>()
        };
        level = level.iter().flat_map(extend).collect();
        seen += level.len();
        for (digits, m) in level.iter().filter(|(digits, _)| is_least_rotation(digits)) {
            let growth = radius(m).powf(1.0 / digits.len() as f64);
            if growth > best.growth * (1.0 + 1e-9) {
                best = Candidate { digits: digits.clone(), growth };
            }
        }
    }
    best
}

fn is_least_rotation(digits: &[usize]) -> bool {
    (1..digits.len()).all(|k| digits <= [&digits[k..], &digits[..k]].concat().as_slice())
}

/// rho(M) by repeated squaring: |M^N|^(1/N), N = 2^36.
fn radius(m: &DMatrix<f64>) -> f64 {
    let (mut power, mut log, mut weight) = (m.clone(), 0.0, 1.0);
    for _ in 0..36 {
        let size = power.amax();
        if size == 0.0 || !size.is_finite() {
            return 0.0;
        }
        power /= size;
        log += weight * libm::log(size);
        power = &power * &power;
        weight /= 2.0;
    }
    libm::exp(log)
}

/// A lower bound of the growth of a product, from enclosed eigenvalues; rounded down.
pub(super) fn certain_growth(matrices: &[Exact], digits: &[usize]) -> Option<f64> {
    let exact = product(matrices, digits);
    let enclosed: Vec<Vec<Enclosure<384>>> =
        exact.iter().map(|row| row.iter().map(Enclosure::rational).collect()).collect();
    let polynomial = Univariate::characteristic(&enclosed).ok()?;
    let found = roots(polynomial.coefficients()).ok()?;
    let squares = found.iter().filter_map(|root| root.modulus_squared().ok());
    let largest = squares.map(|square| square.lo_hi().0).max()?;
    let value = libm::pow(largest.to_f64().value() * (1.0 - 1e-15), 0.5 / digits.len() as f64) * (1.0 - 1e-14);
    (value > 0.0).then_some(value)
}

/// The leading eigenvectors along the cycle of a product: real part and imaginary part, size 1 at the start.
pub(super) fn orbit(matrices: &[Exact], candidate: &Candidate) -> Vec<Vec<f64>> {
    let t: Vec<DMatrix<f64>> = matrices.iter().map(approximate).collect();
    let n = t[0].nrows();
    let m = candidate.digits.iter().fold(DMatrix::identity(n, n), |m, e| &t[*e] * m);
    // powers of the product bring out the leading eigenvector, or plane
    let mut power = &m / m.amax().max(f64::MIN_POSITIVE);
    for _ in 0..40 {
        power = &power * &power;
        power /= power.amax().max(f64::MIN_POSITIVE);
    }
    let sizes = power.column_iter().map(|column| column.amax()).enumerate();
    let Some((column, _)) = sizes.max_by(|a, b| a.1.total_cmp(&b.1)) else { return Vec::new() };
    let start: DVector<f64> = power.column(column).into_owned();
    let mut x = &start / start.amax().max(f64::MIN_POSITIVE);
    let mut orbit = Vec::new();
    for e in &candidate.digits {
        orbit.push(x.iter().copied().collect());
        x = &t[*e] * x / candidate.growth;
    }
    orbit
}
