//! Which eigenvalues and eigenvectors has a rational matrix, exactly?
//!
//! The characteristic polynomial of each core is taken apart into factors over the rationals; what is left without closed forms is
//! enclosed. Multiplicities and Jordan blocks come from exact ranks; eigenvectors of rational eigenvalues are exact.

use crate::analysis::cores::components;
use crate::analysis::exact::words::{Words, factor_in_words};
use crate::numbers::closed_form::ClosedForm;
use crate::numbers::factor::factors;
use crate::numbers::linear::{Matrix, null_space, part, product, shifted, transposed};
use crate::numbers::real_root::roots_of;
use crate::numbers::roots::Root;
use crate::numbers::{Enclosure, Extension, Field, Free, Trouble, Univariate};
use dashu_ratio::RBig;
use num_complex::Complex64;
use std::cmp::Reverse;

/// The bits of enclosures after the point.
pub const BITS: usize = 192;

/// Larger matrices are not taken apart.
pub const MAX_SIZE: usize = 64;

/// Eigenvectors are listed for matrices up to this size.
pub const MAX_WITH_VECTORS: usize = 16;

/// An eigenvalue.
#[derive(Clone, Debug)]
pub struct CurveEigenvalue {
    /// The nearest floating number.
    pub value: Complex64,
    /// The value, where it is rational.
    pub rational: Option<RBig>,
    /// The polynomial that it is a root of, where it is not rational.
    pub polynomial: Option<Univariate<RBig>>,
    /// In words.
    pub words: Option<Words>,
    /// Its real part with so many right decimals, where it is real.
    pub real: Option<Enclosure<BITS>>,
    /// The square of its modulus.
    pub modulus_squared: Enclosure<BITS>,
    /// The number of times that it counts in the characteristic polynomial.
    pub algebraic: usize,
    /// The dimension of its eigenspace.
    pub geometric: usize,
    /// The size of its largest Jordan block.
    pub jordan: usize,
    /// Right eigenvectors, where it is rational and the matrix has at most [`MAX_WITH_VECTORS`] rows: a basis, with coprime whole entries and the last that is not zero positive.
    pub right: Vec<Vec<RBig>>,
    /// Left eigenvectors, in the same way.
    pub left: Vec<Vec<RBig>>,
}

/// The spectrum, the largest modulus first.
///
/// # Errors
/// When the matrix is larger than [`MAX_SIZE`], or a polynomial can't be taken apart.
pub fn spectrum(matrix: &Matrix<RBig>) -> Result<Vec<CurveEigenvalue>, Trouble> {
    if matrix.len() > MAX_SIZE {
        return Err(Trouble::BeyondThisWorld("the local matrix is too large for exact eigenvalues"));
    }
    let mut found: Vec<(Univariate<Free>, usize)> = Vec::new();
    for core in components(matrix.len(), |from, to| !matrix[to][from].is_zero()) {
        let polynomial = Univariate::characteristic(&part(matrix, &core))?;
        let polynomial = polynomial.mapped(|value| Ok(Free::rational(value)))?;
        for (factor, multiplicity) in factors(&polynomial)? {
            match found.iter_mut().find(|(own, _)| *own == factor) {
                Some((_, own)) => *own += multiplicity,
                None => found.push((factor, multiplicity)),
            }
        }
    }
    let mut all = Vec::new();
    for (factor, multiplicity) in parted(found)? {
        all.extend(of_factor(matrix, &factor, multiplicity)?);
    }
    all.sort_by(|a, b| b.value.norm().total_cmp(&a.value.norm()).then(b.value.re.total_cmp(&a.value.re)));
    Ok(all)
}

/// Whether there is a basis of eigenvectors.
pub fn is_diagonalizable(spectrum: &[CurveEigenvalue]) -> bool {
    spectrum.iter().all(|e| e.jordan == 1)
}

/// Factors without common roots: what two of them share is a factor of its own.
fn parted(mut found: Vec<(Univariate<Free>, usize)>) -> Result<Vec<(Univariate<Free>, usize)>, Trouble> {
    let mut apart: Vec<(Univariate<Free>, usize)> = Vec::new();
    'next: while let Some((factor, times)) = found.pop() {
        if factor.degree().is_none_or(|degree| degree == 0) {
            continue;
        }
        for index in 0..apart.len() {
            let common = apart[index].0.gcd(&factor)?;
            if common.degree() == Some(0) {
                continue;
            }
            let (other, count) = apart.swap_remove(index);
            found.push((factor.divided(&common)?.0.monic()?, times));
            found.push((other.divided(&common)?.0.monic()?, count));
            found.push((common, times + count));
            continue 'next;
        }
        apart.push((factor, times));
    }
    apart.sort_by_key(|(factor, _)| Reverse(factor.degree()));
    Ok(apart)
}

/// The eigenvalues that are roots of a factor, each as many times.
fn of_factor(matrix: &Matrix<RBig>, factor: &Univariate<Free>, times: usize) -> Result<Vec<CurveEigenvalue>, Trouble> {
    let enclose = |value: &Free| value.as_rational().map(|r| Enclosure::<BITS>::rational(&r)).ok_or(NOT_RATIONAL);
    let roots = roots_of(factor, &enclose)?;
    let rational = match factor.coefficients() {
        [constant, _] => constant.negated().as_rational(),
        _ => None,
    };
    let (geometric, jordan) = match &rational {
        Some(value) => structure(matrix, value, times)?,
        None => irrational_structure(matrix, factor, times)?,
    };
    let (right, left) = match &rational {
        Some(value) if matrix.len() <= MAX_WITH_VECTORS => {
            (eigenvectors(matrix, value)?, eigenvectors(&transposed(matrix), value)?)
        }
        _ => (Vec::new(), Vec::new()),
    };
    let over_rationals = || factor.mapped(|value| value.as_rational().ok_or(NOT_RATIONAL));
    let polynomial = if rational.is_none() { Some(over_rationals()?) } else { None };
    let closed = ClosedForm::of(factor).is_some();
    let words = factor_in_words(factor, &[]);
    let eigenvalue = |(index, root): (usize, &Root<BITS>)| {
        Ok(CurveEigenvalue {
            value: Complex64::new(root.re.midpoint_f64(), root.im.midpoint_f64()),
            rational: rational.clone(),
            polynomial: polynomial.clone(),
            // with no closed form all roots share the name of their polynomial
            words: if closed { closed_words(&words, &roots, index) } else { words.first().cloned() },
            real: root.is_real().then(|| root.re.clone()),
            modulus_squared: root.modulus_squared()?,
            algebraic: times * root.count,
            geometric,
            jordan,
            right: right.clone(),
            left: left.clone(),
        })
    };
    roots.iter().enumerate().map(eigenvalue).collect()
}

/// The words of a root among the closed forms of a factor of degree 1 or 2.
fn closed_words(words: &[Words], roots: &[Root<BITS>], index: usize) -> Option<Words> {
    let key = |root: &Root<BITS>| (root.re.midpoint_f64(), root.im.midpoint_f64());
    let own = key(&roots[index]);
    let larger = roots.iter().filter(|other| key(other) > own).count();
    words.get(larger).cloned()
}

const NOT_RATIONAL: Trouble = Trouble::BeyondThisWorld("a coefficient is not rational");
const NO_STRUCTURE: Trouble = Trouble::BeyondThisWorld("the ranks don't fit the multiplicity");

/// Geometric multiplicity and largest Jordan block of an eigenvalue of an algebraic multiplicity.
fn structure<F: Field>(matrix: &Matrix<F>, value: &F, algebraic: usize) -> Result<(usize, usize), Trouble> {
    if algebraic == 1 {
        return Ok((1, 1));
    }
    let shifted = shifted(matrix, value)?;
    let geometric = null_space(&shifted)?.len();
    let (mut nullity, mut power, mut largest) = (geometric, shifted.clone(), 1);
    while nullity < algebraic && largest < algebraic {
        power = product(&power, &shifted)?;
        nullity = null_space(&power)?.len();
        largest += 1;
    }
    if nullity == algebraic { Ok((geometric, largest)) } else { Err(NO_STRUCTURE) }
}

fn irrational_structure(
    matrix: &Matrix<RBig>,
    factor: &Univariate<Free>,
    times: usize,
) -> Result<(usize, usize), Trouble> {
    if times == 1 {
        return Ok((1, 1));
    }
    let polynomial = factor.mapped(|value| value.as_rational().ok_or(NOT_RATIONAL))?;
    let lambda = Extension::root(&polynomial)?;
    let lift = |row: &Vec<RBig>| row.iter().map(|entry| Extension::constant(entry.clone())).collect();
    structure(&matrix.iter().map(lift).collect(), &lambda, times)
}

/// A left eigenvector of a simple real eigenvalue that is not rational, each entry enclosed: a root of a polynomial of the spectrum.
///
/// # Errors
/// When the root can't be followed through the elimination.
pub fn enclosed_left(matrix: &Matrix<RBig>, e: &CurveEigenvalue) -> Result<Vec<Enclosure<BITS>>, Trouble> {
    let (Some(root), Some(polynomial)) = (&e.real, &e.polynomial) else { return Err(NOT_RATIONAL) };
    let lambda = Extension::root(polynomial)?;
    let lift = |row: &Vec<RBig>| row.iter().map(|entry| Extension::constant(entry.clone())).collect();
    let lifted: Matrix<Extension<RBig>> = transposed(matrix).iter().map(lift).collect();
    let vectors = null_space(&shifted(&lifted, &lambda)?)?;
    let [vector] = vectors.as_slice() else { return Err(NO_STRUCTURE) };
    let enclosed =
        |entry: &Extension<RBig>| entry.value().mapped(|value| Ok(Enclosure::<BITS>::rational(value)))?.evaluate(root);
    vector.iter().map(enclosed).collect()
}

/// A basis of the right eigenvectors, in whole numbers.
pub fn eigenvectors(matrix: &Matrix<RBig>, value: &RBig) -> Result<Vec<Vec<RBig>>, Trouble> {
    Ok(null_space(&shifted(matrix, value)?)?.iter().map(|vector| whole(vector)).collect())
}

/// The multiple with coprime whole entries, the last that is not zero positive.
fn whole(vector: &[RBig]) -> Vec<RBig> {
    use dashu_base::{Gcd, UnsignedAbs};
    use dashu_int::UBig;
    let common = vector.iter().fold(UBig::ONE, |lcm, value| {
        let denominator = value.denominator();
        &lcm / (&lcm).gcd(denominator) * denominator
    });
    let scaled: Vec<RBig> = vector.iter().map(|value| value * RBig::from(common.clone())).collect();
    let numerators =
        scaled.iter().map(|value| value.numerator().clone().unsigned_abs()).filter(|value| !value.is_zero());
    let divisor = numerators.reduce(|a, b| (&a).gcd(&b)).unwrap_or(UBig::ONE);
    let negative = scaled.iter().rev().find(|value| !value.is_zero()).is_some_and(|value| *value < RBig::ZERO);
    let divisor = if negative { -RBig::from(divisor) } else { RBig::from(divisor) };
    scaled.into_iter().map(|value| value / &divisor).collect()
}
