//! Which product of transition matrices grows fastest?
//!
//! For every product P of L matrices, the joint spectral radius is at least rho(P)^(1/L) (Daubechies and Lagarias 1992). The products of few
//! matrices are compared in floating point; the best one's radius is enclosed by the roots of its characteristic polynomial.

use super::transition::{Floats, image};
use crate::numbers::linear::{Matrix, product};
use crate::numbers::roots::Root;
use crate::numbers::{Enclosure, Field, Trouble, Univariate, real_root};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// How exactly radii are enclosed: 2^-BITS.
const BITS: usize = 256;
/// Squarings of a product until its largest eigenvalue is all that is left.
const SQUARINGS: usize = 40;
/// About so many multiplications are spent on looking at products.
const WORK: usize = 40_000_000;
/// Products with radii that are nearer than this, relatively, count as equally fast.
const TIE: f64 = 1e-10;

/// A product of transition matrices that grows fast.
#[derive(Clone, Debug)]
pub(super) struct Leader {
    /// Which matrices, the first to be applied first.
    pub(super) word: Vec<usize>,
    /// The radius of the product, to the power of one over its length, approximately.
    pub(super) rate: f64,
    /// Vectors that span what grows fastest, approximately.
    pub(super) directions: Vec<Vec<f64>>,
}

/// The fastest products among those of few matrices: the shortest one of them, and others that are as fast.
pub(super) fn leaders(matrices: &[Floats]) -> Vec<Leader> {
    let n = matrices.first().map_or(0, Vec::len);
    let most = (WORK / (SQUARINGS * n.pow(3)).max(1)).clamp(matrices.len(), 3000);
    let mut found: Vec<Leader> = Vec::new();
    let (mut words, mut seen) = (vec![(Vec::new(), unit(n))], 0);
    while seen + words.len() * matrices.len() <= most {
        words = words.iter().flat_map(|(word, p)| longer(word, p, matrices)).collect();
        seen += words.len();
        for (word, p) in words.iter().filter(|(word, _)| is_first_rotation(word)) {
            let (log, power) = growth(p);
            let rate = libm::exp(log / word.len() as f64);
            let best = found.first().map_or(0.0, |leader| leader.rate);
            if rate > best * (1.0 + TIE) {
                found.clear();
            }
            if rate >= best * (1.0 - TIE) && found.len() < 2 * matrices.len() {
                found.push(Leader { word: word.clone(), rate, directions: directions(&power) });
            }
        }
    }
    found
}

fn unit(n: usize) -> Floats {
    (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect()
}

fn times(a: &Floats, b: &Floats) -> Floats {
    let columns: Floats = (0..b.len()).map(|j| b.iter().map(|row| row[j]).collect()).collect();
    a.iter().map(|row| image(&columns, row)).collect()
}

fn longer(word: &[usize], p: &Floats, matrices: &[Floats]) -> Vec<(Vec<usize>, Floats)> {
    let one = |(e, matrix): (usize, &Floats)| ([word, &[e]].concat(), times(matrix, p));
    matrices.iter().enumerate().map(one).collect()
}

/// Whether a word is smaller than all its rotations: those and powers tell nothing new.
fn is_first_rotation(word: &[usize]) -> bool {
    (1..word.len()).all(|k| word < [&word[k..], &word[..k]].concat().as_slice())
}

/// The logarithm of the radius, and a high power scaled to size 1.
fn growth(p: &Floats) -> (f64, Floats) {
    let (mut power, mut log, mut share) = (p.clone(), 0.0, 1.0);
    for _ in 0..SQUARINGS {
        let size = power.iter().flatten().fold(0.0_f64, |size, value| size.max(value.abs()));
        if size == 0.0 {
            return (f64::NEG_INFINITY, power);
        }
        log += share * libm::log(size);
        share /= 2.0;
        power.iter_mut().flatten().for_each(|value| *value /= size);
        power = times(&power, &power);
    }
    (log, power)
}

/// The largest column of a matrix, and another that isn't parallel, scaled to size 1.
fn directions(power: &Floats) -> Vec<Vec<f64>> {
    let mut columns: Vec<Vec<f64>> = (0..power.len()).map(|j| power.iter().map(|row| row[j]).collect()).collect();
    let mut found = Vec::new();
    for _ in 0..2 {
        let size = |column: &Vec<f64>| column.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
        let Some(largest) = columns.iter().max_by(|x, y| size(x).total_cmp(&size(y))).cloned() else { break };
        let scale = size(&largest);
        if scale < if found.is_empty() { 1e-300 } else { 1e-3 } {
            break;
        }
        let square = super::transition::dot(&largest, &largest);
        for column in &mut columns {
            let factor = super::transition::dot(column, &largest) / square;
            column.iter_mut().zip(&largest).for_each(|(value, own)| *value = (*value - factor * own) / scale);
        }
        found.push(largest.iter().map(|value| value / scale).collect());
    }
    found
}

/// The product of a word's matrices.
///
/// # Errors
/// When the field's limits are passed.
pub(super) fn product_of(word: &[usize], matrices: &[Matrix<RBig>]) -> Result<Matrix<RBig>, Trouble> {
    let n = matrices.first().map_or(0, Vec::len);
    let entry = |i, j| if i == j { RBig::ONE } else { RBig::ZERO };
    let unit: Matrix<RBig> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    word.iter().try_fold(unit, |so_far, e| product(&matrices[*e], &so_far))
}

/// The largest modulus of an eigenvalue.
#[derive(Clone, Debug)]
pub(super) struct Largest {
    /// Not more than it.
    pub(super) lower: RBig,
    /// The eigenvalue of this modulus, where it is rational.
    pub(super) rational: Option<RBig>,
}

/// The largest modulus of an eigenvalue of a matrix, enclosed.
///
/// # Errors
/// When the matrix or its numbers are too large.
pub(super) fn largest(matrix: &Matrix<RBig>) -> Result<Largest, Trouble> {
    let polynomial = Univariate::characteristic(matrix)?;
    let parts = polynomial.squarefree()?;
    let (mut lower, mut rational, mut upper) = (RBig::ZERO, None, RBig::ZERO);
    for (part, _) in &parts {
        for root in real_root::roots_of::<RBig, BITS>(part, &|value| Ok(Enclosure::rational(value)))? {
            let (low, high) = root.modulus_squared()?.sqrt()?.lo_hi();
            let exact = rational_root(part, &root);
            if exact.is_some() && high > upper {
                rational = exact;
            } else if high > upper && low > upper {
                rational = None;
            }
            lower = lower.max(low);
            upper = upper.max(high);
        }
    }
    let rational = rational.filter(|value| size(value) >= lower);
    if let Some(value) = &rational {
        lower = lower.max(size(value));
    }
    Ok(Largest { lower, rational })
}

/// The absolute value.
pub(super) fn size(value: &RBig) -> RBig {
    if *value < RBig::ZERO { -value } else { value.clone() }
}

/// The root, where it is rational: times the leading coefficient it is whole, once all coefficients are.
fn rational_root(polynomial: &Univariate<RBig>, root: &Root<BITS>) -> Option<RBig> {
    if !root.is_real() {
        return None;
    }
    let common = polynomial.coefficients().iter().fold(UBig::ONE, |m, c| {
        let d = c.denominator();
        &m / dashu_base::Gcd::gcd(&m, d) * d
    });
    let leading = polynomial.leading()? * RBig::from(common);
    let (low, high) = root.re.lo_hi();
    let middle = (low + high) / RBig::from(2);
    let whole: IBig = (middle * &leading + RBig::ONE / RBig::from(2)).floor();
    let value = RBig::from(whole) / leading;
    polynomial.evaluate(&value).ok()?.is_zero().then_some(value)
}
