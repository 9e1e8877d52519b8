//! Which eigenvalues has the local matrix, and with which vectors?
//!
//! Core by core and frequency by frequency, in `f64`: everything here is approximate. Eigenvalues that floating numbers can't
//! tell apart form a cluster; its structure (one Jordan block, or several) is not decided here, and no vectors are
//! computed for it.

use super::cores::Cores;
use super::parts::Parts;
use crate::refine::Obstacle;
use nalgebra::{DMatrix, DVector, Matrix3};
use num_complex::Complex64;
use std::collections::BTreeSet;

/// Eigenvalues of different cores nearer than this are called approximately equal: well-conditioned eigenvalues of matrices
/// with entries of order 1 are right to about 1e-15. A convention.
pub const NEAR: f64 = 1e-10;

/// The most frequencies whose vectors are put into their equations for a report.
pub const MOST_TESTED: usize = 500;

/// An eigenvalue of one block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigenvalue {
    /// Its value; the imaginary part is exactly 0 where it is real. Of a cluster within one core, the mean: rounding drives
    /// equal eigenvalues apart, but moves their mean little.
    pub value: Complex64,
    /// Its frequency, 0..floor(n/2): frequencies k and n-k have the same eigenvalues. Where there is no rotation but a mirror, 0
    /// for the even part and 1 for the odd one.
    pub frequency: usize,
    /// The core that it belongs to.
    pub core: usize,
    /// How many eigenvalues of this frequency are approximately equal to it, itself included.
    pub cluster: usize,
    /// Which cluster of its frequency it belongs to.
    pub group: usize,
    /// How far the value may be off, by the estimate that clusters are told by: not a bound.
    pub approx_error: f64,
}

impl Eigenvalue {
    /// Its modulus.
    pub fn modulus(&self) -> f64 {
        modulus(self.value)
    }

    /// Whether nothing else of its frequency is near.
    pub fn is_isolated(&self) -> bool {
        self.cluster == 1
    }

    /// How often it counts in the spectrum of S: once for frequency k and once for n - k.
    pub fn multiplicity(&self, valence: usize) -> usize {
        self.cluster * if self.frequency == 0 || 2 * self.frequency == valence { 1 } else { 2 }
    }

    /// The value, if it is real.
    pub fn real(&self) -> Option<f64> {
        (self.value.im == 0.0).then_some(self.value.re)
    }
}

/// The spectrum of a local matrix.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// Every eigenvalue of the blocks 0..floor(n/2), largest modulus first, approximately equal ones in order of frequency.
    pub eigenvalues: Vec<Eigenvalue>,
    /// The number of these blocks.
    pub blocks: usize,
}

impl Spectrum {
    /// The eigenvalues of all blocks.
    ///
    /// # Errors
    /// When the eigenvalues of a core can't be computed.
    pub fn of<P: Parts>(blocks: &P, cores: &Cores<P::Node>) -> Result<Spectrum, Obstacle> {
        let mut eigenvalues = Vec::with_capacity(blocks.count() * blocks.nodes().len());
        let nodes = [0, 1].map(|k| (0..cores.cores.len()).map(|core| cores.nodes(core, k)).collect::<Vec<_>>());
        for frequency in 0..blocks.count() {
            let start = eigenvalues.len();
            for (core, nodes) in nodes[frequency.min(1)].iter().enumerate() {
                let form = blocks.real_form(frequency, nodes);
                let values = eigenvalues_of(&form)?;
                if values.iter().any(|value| !modulus(*value).is_finite()) {
                    return Err(Obstacle::Limit("an eigenvalue is too large to be computed".to_string()));
                }
                let errors = error_estimates(&form, &values)?;
                eigenvalues.extend(values.into_iter().zip(errors).map(|(value, approx_error)| Eigenvalue {
                    value,
                    frequency,
                    core,
                    cluster: 1,
                    group: 0,
                    approx_error,
                }));
            }
            find_clusters(&mut eigenvalues[start..]);
        }
        sort(&mut eigenvalues);
        Ok(Spectrum { eigenvalues, blocks: blocks.count() })
    }

    /// The eigenvalue 1 of the constants: the one of frequency 0 nearest to 1.
    pub fn one(&self) -> Option<Eigenvalue> {
        let at = self.position_of_one()?;
        Some(self.eigenvalues[at])
    }

    fn position_of_one(&self) -> Option<usize> {
        let distance = |index: &usize| modulus(self.eigenvalues[*index].value - 1.0);
        let constant = (0..self.eigenvalues.len()).filter(|index| self.eigenvalues[*index].frequency == 0);
        constant.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Every eigenvalue but the 1 of the constants, in order.
    pub fn after_one(&self) -> impl Iterator<Item = &Eigenvalue> {
        let one = self.position_of_one();
        self.eigenvalues.iter().enumerate().filter(move |(index, _)| Some(*index) != one).map(|(_, e)| e)
    }

    /// The largest eigenvalue after 1; of several with approximately the same modulus that of frequency 1, if there is one.
    pub fn subdominant(&self) -> Option<Eigenvalue> {
        let first = self.after_one().next()?;
        let mut tied = self.after_one().take_while(|e| first.modulus() - e.modulus() <= NEAR);
        Some(*tied.find(|e| e.frequency == 1).unwrap_or(first))
    }

    /// The largest eigenvalue of a frequency (of frequency 0: after 1).
    pub fn largest_of(&self, frequency: usize) -> Option<Eigenvalue> {
        self.after_one().find(|e| e.frequency == frequency).copied()
    }

    /// The eigenvalues after 1 and the subdominant one (with its cluster), in order.
    pub fn after_subdominant(&self) -> impl Iterator<Item = &Eigenvalue> {
        let first = self.subdominant();
        let skipped = move |e: &Eigenvalue| first.is_some_and(|s| s.frequency == e.frequency && s.group == e.group);
        self.after_one().filter(move |e| !skipped(e))
    }

    /// One eigenvalue for each cluster, in order.
    pub fn distinct(&self) -> Vec<Eigenvalue> {
        let mut seen = BTreeSet::new();
        self.eigenvalues.iter().filter(|e| seen.insert((e.frequency, e.group))).copied().collect()
    }

    /// A right vector: B_k y = lambda y, for an isolated real eigenvalue. The largest entry of the residual, relative to that
    /// of the vector, comes with it.
    pub fn right_vector<P: Parts>(
        &self,
        blocks: &P,
        cores: &Cores<P::Node>,
        e: &Eigenvalue,
    ) -> Option<(P::Vector, f64)> {
        if e.is_isolated() { self.only_right_vector(blocks, cores, e) } else { None }
    }

    /// A left vector: u B_k = lambda u, for an isolated real eigenvalue, with its relative residual.
    pub fn left_vector<P: Parts>(
        &self,
        blocks: &P,
        cores: &Cores<P::Node>,
        e: &Eigenvalue,
    ) -> Option<(P::Vector, f64)> {
        if e.is_isolated() { self.only_left_vector(blocks, cores, e) } else { None }
    }

    /// The same for a real eigenvalue that is known to have one right vector only: isolated, or a single Jordan block.
    pub fn only_right_vector<P: Parts>(
        &self,
        blocks: &P,
        cores: &Cores<P::Node>,
        e: &Eigenvalue,
    ) -> Option<(P::Vector, f64)> {
        let (lambda, nodes) = (e.real()?, cores.above(&self.cores_of(e), e.frequency));
        let form = blocks.real_form(e.frequency, &nodes);
        let real = null_vector(&shifted(&form, lambda))?;
        let residual = residual(&form, lambda, &real);
        Some((blocks.right_from_real(e.frequency, &nodes, &real), residual))
    }

    /// The same for a real eigenvalue that is known to have one left vector only: isolated, or a single Jordan block.
    pub fn only_left_vector<P: Parts>(
        &self,
        blocks: &P,
        cores: &Cores<P::Node>,
        e: &Eigenvalue,
    ) -> Option<(P::Vector, f64)> {
        let (lambda, nodes) = (e.real()?, cores.below(&self.cores_of(e), e.frequency));
        let form = blocks.real_form(e.frequency, &nodes).transpose();
        let real = null_vector(&shifted(&form, lambda))?;
        let residual = residual(&form, lambda, &real);
        Some((blocks.left_from_real(e.frequency, &nodes, &real), residual))
    }

    /// The cores of the eigenvalues that are approximately equal to one, its own among them.
    pub fn cores_of(&self, e: &Eigenvalue) -> Vec<usize> {
        if e.is_isolated() {
            return vec![e.core];
        }
        let own = self.eigenvalues.iter().filter(|other| (other.frequency, other.group) == (e.frequency, e.group));
        let cores: BTreeSet<usize> = own.map(|other| other.core).collect();
        cores.into_iter().collect()
    }

    /// The largest relative residual of the right and left vectors of isolated real eigenvalues, and how many vectors it was
    /// taken over: those of every frequency, or of [`MOST_TESTED`] ones evenly spread where there are more.
    pub fn approx_residual<P: Parts>(&self, blocks: &P, cores: &Cores<P::Node>) -> (f64, usize) {
        let step = self.blocks.saturating_sub(1) / MOST_TESTED + 1;
        let tested = || self.eigenvalues.iter().filter(move |e| e.frequency % step == 0 || e.frequency == 1);
        let right = tested().filter_map(|e| self.right_vector(blocks, cores, e));
        let left = tested().filter_map(|e| self.left_vector(blocks, cores, e));
        right.chain(left).fold((0.0, 0), |(worst, count), (_, residual)| (f64::max(worst, residual), count + 1))
    }
}

/// |z|, without the machine's C library.
fn modulus(z: Complex64) -> f64 {
    if z.im == 0.0 { z.re.abs() } else { z.norm_sqr().sqrt() }
}

/// Whether two eigenvalues are approximately equal.
pub fn near(a: Complex64, b: Complex64) -> bool {
    modulus(a - b) <= NEAR
}

/// A - lambda
fn shifted(a: &DMatrix<f64>, lambda: f64) -> DMatrix<f64> {
    a - DMatrix::identity(a.nrows(), a.nrows()) * lambda
}

/// How far each eigenvalue of a core may be off, by an experiment: the matrix is changed by a few units in the last place, in a
/// fixed pattern, and what moves by d may be off by some 16 d. Eigenvalues of a Jordan block of size m move by about eps^(1/m), others hardly.
/// Where no two eigenvalues of the core are so near that it matters, [`NEAR`] without the experiment.
fn error_estimates(form: &DMatrix<f64>, values: &[Complex64]) -> Result<Vec<f64>, Obstacle> {
    let loose = 8.0 * libm::pow(f64::EPSILON, 1.0 / values.len().max(1) as f64);
    let close = |(i, a): (usize, &Complex64)| values[..i].iter().any(|b| modulus(a - b) <= loose);
    if !values.iter().enumerate().any(close) {
        return Ok(vec![NEAR; values.len()]);
    }
    let scale = form.iter().fold(0.0_f64, |top, entry| top.max(entry.abs()));
    let mut state = 0x2545_F491_4F6C_DD1D_u64;
    let changed = form.map(|entry| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        let sign = if state >> 63 == 0 { 1.0 } else { -1.0 };
        entry + sign * 4.0 * f64::EPSILON * scale
    });
    let moved = eigenvalues_of(&changed)?;
    let movement = |value: &Complex64| moved.iter().map(|other| modulus(other - value)).fold(f64::INFINITY, f64::min);
    Ok(values.iter().map(|value| (64.0 * movement(value)).clamp(NEAR, loose.max(NEAR))).collect())
}

/// Joins, among the eigenvalues of one frequency, those that are approximately equal: of one core where their errors may make up for
/// their distance, of different cores where they are nearer than [`NEAR`]. Those of one core take their mean.
fn find_clusters(eigenvalues: &mut [Eigenvalue]) {
    let joined = |a: &Eigenvalue, b: &Eigenvalue| {
        let radius = if a.core == b.core { a.approx_error.max(b.approx_error) } else { NEAR };
        modulus(a.value - b.value) <= radius
    };
    for (index, e) in eigenvalues.iter_mut().enumerate() {
        e.group = index;
    }
    let apart = |(index, e): (usize, &Eigenvalue)| eigenvalues[..index].iter().all(|other| !joined(e, other));
    if eigenvalues.iter().enumerate().all(apart) {
        return;
    }
    let all: Vec<Eigenvalue> = eigenvalues.to_vec();
    let mut groups: Vec<usize> = (0..all.len()).collect();
    for a in 0..all.len() {
        for b in 0..a {
            if groups[a] != groups[b] && joined(&all[a], &all[b]) {
                let (from, to) = (groups[a], groups[b]);
                groups.iter_mut().filter(|group| **group == from).for_each(|group| *group = to);
            }
        }
    }
    for (index, e) in eigenvalues.iter_mut().enumerate() {
        let members = || all.iter().zip(&groups).filter(|(_, group)| **group == groups[index]).map(|(other, _)| other);
        let own = || members().filter(|other| other.core == e.core).map(|other| other.value);
        e.value = own().sum::<Complex64>() / own().count() as f64;
        e.approx_error = members().map(|other| other.approx_error).fold(0.0, f64::max);
        (e.cluster, e.group) = (members().count(), groups[index]);
    }
}

/// By modulus, largest first; moduli that are approximately equal in order of frequency, then of the argument.
fn sort(eigenvalues: &mut [Eigenvalue]) {
    eigenvalues.sort_by(|a, b| b.modulus().total_cmp(&a.modulus()));
    let mut start = 0;
    while start < eigenvalues.len() {
        let top = eigenvalues[start].modulus();
        let length = eigenvalues[start..].iter().take_while(|e| top - e.modulus() <= NEAR).count().max(1);
        eigenvalues[start..start + length].sort_by(|a, b| {
            a.frequency
                .cmp(&b.frequency)
                .then(b.value.re.total_cmp(&a.value.re))
                .then(b.value.im.total_cmp(&a.value.im))
        });
        start += length;
    }
}

/// The eigenvalues of a real matrix.
fn eigenvalues_of(matrix: &DMatrix<f64>) -> Result<Vec<Complex64>, Obstacle> {
    if matrix.iter().any(|entry| !entry.is_finite()) {
        return Err(Obstacle::Limit("a block of the local matrix has an entry that is not finite".to_string()));
    }
    match matrix.nrows() {
        0 => Ok(Vec::new()),
        1 => Ok(vec![Complex64::new(matrix[(0, 0)], 0.0)]),
        2 => Ok(roots_of_quadratic(matrix[(0, 0)], matrix[(0, 1)], matrix[(1, 0)], matrix[(1, 1)])),
        3 => {
            let small = Matrix3::from_iterator(matrix.iter().copied());
            let schur =
                DEFLATIONS.iter().find_map(|eps| small.try_schur(*eps, MAX_SWEEPS)).ok_or_else(no_convergence)?;
            Ok(schur.complex_eigenvalues().iter().map(|value| newton_step(&small, *value)).collect())
        }
        _ => {
            let schur = |eps: &f64| matrix.clone().try_schur(*eps, MAX_SWEEPS);
            let schur = DEFLATIONS.iter().find_map(schur).ok_or_else(no_convergence)?;
            Ok(schur.complex_eigenvalues().iter().copied().collect())
        }
    }
}

/// One step of Newton's method on the characteristic polynomial: takes the last digits that the iteration left.
fn newton_step(a: &Matrix3<f64>, x: Complex64) -> Complex64 {
    let minor = |i: usize, j: usize| a[(i, i)] * a[(j, j)] - a[(i, j)] * a[(j, i)];
    let (trace, minors, determinant) = (a.trace(), minor(0, 1) + minor(0, 2) + minor(1, 2), a.determinant());
    let value = ((x - trace) * x + minors) * x - determinant;
    let slope = (x * 3.0 - 2.0 * trace) * x + minors;
    // near a multiple root the step says nothing
    if modulus(slope) > 1e-3 { x - value / slope } else { x }
}

const MAX_SWEEPS: usize = 1_000;

/// What counts as zero below the diagonal. On Jordan blocks the iteration may never reach the first of these.
const DEFLATIONS: [f64; 4] = [f64::EPSILON, 1e-14, 1e-12, 1e-10];

fn no_convergence() -> Obstacle {
    Obstacle::Limit(format!("the eigenvalues of a core did not converge in {MAX_SWEEPS} sweeps"))
}

/// The eigenvalues of [[a, b], [c, d]], without cancellation in the larger one.
fn roots_of_quadratic(a: f64, b: f64, c: f64, d: f64) -> Vec<Complex64> {
    let (mean, half) = ((a + d) / 2.0, (a - d) / 2.0);
    let discriminant = half * half + b * c;
    if discriminant < 0.0 {
        let im = (-discriminant).sqrt();
        return vec![Complex64::new(mean, im), Complex64::new(mean, -im)];
    }
    let root = discriminant.sqrt();
    let larger = if mean >= 0.0 { mean + root } else { mean - root };
    let smaller = if larger == 0.0 { 0.0 } else { (a * d - b * c) / larger };
    vec![Complex64::new(larger, 0.0), Complex64::new(smaller, 0.0)]
}

/// A vector v, its largest entry 1, with A v = 0 for a matrix of corank 1: by Gaussian elimination with full pivoting.
fn null_vector(a: &DMatrix<f64>) -> Option<Vec<f64>> {
    let size = a.nrows();
    if size == 0 {
        return None;
    }
    let lu = a.clone().full_piv_lu();
    let u = lu.u();
    let mut v = DVector::zeros(size);
    v[size - 1] = 1.0;
    for row in (0..size - 1).rev() {
        let sum: f64 = (row + 1..size).map(|column| u[(row, column)] * v[column]).sum();
        if u[(row, row)] == 0.0 {
            return None;
        }
        v[row] = -sum / u[(row, row)];
    }
    lu.q().inv_permute_rows(&mut v);
    let largest = v.iter().fold(0.0, |top: f64, x| if x.abs() > top.abs() { *x } else { top });
    Some(v.iter().map(|x| x / largest).collect())
}

/// max |A v - lambda v| / max |v|
fn residual(a: &DMatrix<f64>, lambda: f64, v: &[f64]) -> f64 {
    let size = a.nrows();
    let row = |r: usize| (0..size).map(|c| a[(r, c)] * v[c]).sum::<f64>() - lambda * v[r];
    let largest = v.iter().fold(0.0_f64, |top, x| top.max(x.abs()));
    (0..size).map(|r| row(r).abs()).fold(0.0, f64::max) / largest
}
