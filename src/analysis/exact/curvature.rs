//! Where |mu| = lambda^2 without a Jordan block, does curvature converge?
//!
//! It is bounded then, and converges only if all eigenfunctions of that modulus are quadratic polynomials in the
//! characteristic map psi (Peters and Reif 2008, chapter 7): c |psi|^2 in frequency 0, c psi^2 in frequency 2, nothing in others.
//! Refuted by two points of the ring where an eigenfunction, enclosed, is no such multiple. Shown at the regular valence where
//! the stencils take quadratic polynomials to quadratic polynomials: then these make up the eigenspace of 1/4.

use super::block::{Block, Unknown};
use super::rows::Rows;
use super::spectrum::{Eigenvalue, Spectrum};
use super::{BITS, ExactAnalysis, Value};
use crate::analysis::charmap::offset;
use crate::analysis::neighbourhood::Orbit;
use crate::mesh::{Label, Lattice, Patch};
use crate::numbers::linear::{Matrix, null_space, shifted};
use crate::numbers::real_root::Embedding;
use crate::numbers::{Angle, EnclosedWorld, Extension, Field, PerFrequency, Trouble, Univariate, World};
use crate::refine::{Obstacle, Refinement};
use dashu_ratio::RBig;
use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::HashMap;

/// A complex number, enclosed.
#[derive(Clone, Debug)]
struct Complex {
    re: Value,
    im: Value,
}

impl Complex {
    fn zero() -> Complex {
        Complex { re: Value::whole(0), im: Value::whole(0) }
    }

    /// exp(2 pi i turns)
    fn root(turns: &RBig) -> Result<Complex, Trouble> {
        let angle = Angle::fixed(turns.clone());
        Ok(Complex { re: EnclosedWorld::<BITS>.cos(&angle)?, im: EnclosedWorld::<BITS>.sin(&angle)? })
    }

    fn plus(&self, other: &Complex) -> Result<Complex, Trouble> {
        Ok(Complex { re: self.re.plus(&other.re)?, im: self.im.plus(&other.im)? })
    }

    fn minus(&self, other: &Complex) -> Result<Complex, Trouble> {
        Ok(Complex { re: self.re.minus(&other.re)?, im: self.im.minus(&other.im)? })
    }

    fn times(&self, other: &Complex) -> Result<Complex, Trouble> {
        let re = self.re.times(&other.re)?.minus(&self.im.times(&other.im)?)?;
        let im = self.re.times(&other.im)?.plus(&self.im.times(&other.re)?)?;
        Ok(Complex { re, im })
    }

    fn scaled(&self, factor: &Value) -> Result<Complex, Trouble> {
        Ok(Complex { re: self.re.times(factor)?, im: self.im.times(factor)? })
    }

    fn conjugate(&self) -> Complex {
        Complex { re: self.re.clone(), im: self.im.negated() }
    }

    fn is_certainly_not_zero(&self) -> bool {
        [&self.re, &self.im].iter().any(|part| part.sign().is_some_and(Ordering::is_ne))
    }
}

/// The canonical patch of a valence with its rows, enclosed, and the limit mask of regular points.
pub struct Surroundings<'a, 's> {
    /// The patch.
    pub patch: Patch,
    /// The rows, enclosed.
    pub refinement: &'a Refinement<'s, PerFrequency<Value>>,
    /// The analysis at the regular valence.
    pub regular: &'a ExactAnalysis,
}

/// An eigenfunction by its control points, the values of one eigenvector at every label.
struct Net<'a, 's> {
    around: &'a Surroundings<'a, 's>,
    frequency: usize,
    eigenvalue: Complex,
    values: RefCell<HashMap<Orbit, Complex>>,
}

/// A chain of old points longer than this means that a value depends on itself.
const LONGEST_CHAIN: usize = 64;

impl Net<'_, '_> {
    fn at(&self, label: Label) -> Result<Complex, Obstacle> {
        let turns = RBig::from(self.frequency * label.sector as usize) / RBig::from(self.around.patch.valence);
        Ok(self.in_sector_0(label.orbit(), 0)?.times(&Complex::root(&turns)?)?)
    }

    fn in_sector_0(&self, orbit: Orbit, depth: usize) -> Result<Complex, Obstacle> {
        if let Some(value) = self.values.borrow().get(&orbit) {
            return Ok(value.clone());
        }
        if depth > LONGEST_CHAIN {
            return Err(Obstacle::Limit("an eigenvector depends on itself".to_string()));
        }
        let patch = &self.around.patch;
        let row = self.around.refinement.row(patch, Label { sector: 0, i: orbit.0, j: orbit.1 })?;
        let mut sum = Complex::zero();
        for (old, weight) in row {
            let turns = RBig::from(self.frequency * old.sector as usize) / RBig::from(patch.valence);
            let value = self.in_sector_0(old.orbit(), depth + 1)?.times(&Complex::root(&turns)?)?;
            sum = sum.plus(&value.scaled(weight.value(Some(self.frequency)))?)?;
        }
        // divided by the eigenvalue z: times its conjugate over |z|^2
        let z = &self.eigenvalue;
        let square = z.re.square()?.plus(&z.im.square()?)?;
        let product = sum.times(&z.conjugate())?;
        let value = Complex { re: product.re.over(&square)?, im: product.im.over(&square)? };
        self.values.borrow_mut().insert(orbit, value.clone());
        Ok(value)
    }

    /// The eigenfunction at a regular point of sector 0.
    fn limit(&self, mask: &[(Orbit, Value)], (i, j): Orbit) -> Result<Complex, Obstacle> {
        let mut sum = Complex::zero();
        for ((di, dj), weight) in mask {
            let value = self.at(self.around.patch.point(0, i + di, j + dj))?;
            sum = sum.plus(&value.scaled(weight)?)?;
        }
        Ok(sum)
    }
}

/// Whether curvature converges, `tied` being all eigenvalues with |mu| = lambda^2; `None` where it is not decided.
///
/// # Errors
/// When a limit of size is passed.
pub fn converges<F: Field>(
    rows: &Rows<F>,
    spectrum: &Spectrum<F, BITS>,
    lambda: &Eigenvalue,
    tied: &[&Eigenvalue],
    embedding: Embedding<F, BITS>,
    around: &Surroundings,
) -> Result<Option<bool>, Obstacle> {
    let nets = |e: &Eigenvalue| nets(rows, spectrum, e, embedding, around);
    let mask = limit_offsets(around);
    let extent = mask.iter().map(|((i, j), _)| i.abs().max(j.abs())).max().unwrap_or(0);
    let scale = (2 * extent + 2).max(4);
    let places = [(scale, 0), (scale, scale / 2), (scale + 1, 1), (2 * scale - 1, scale / 2), (2 * scale, 0)];
    let Some(psi) = nets(lambda)?.into_iter().next() else { return Ok(None) };
    let limits = |net: &Net| places.iter().map(|place| net.limit(&mask, *place)).collect::<Result<Vec<_>, Obstacle>>();
    let psi = limits(&psi)?;
    for e in tied {
        let model = model(around.patch.valence as usize, e, spectrum, &psi)?;
        for net in nets(e)? {
            let Some(model) = &model else { continue };
            if is_no_multiple(&limits(&net)?, model) {
                return Ok(Some(false));
            }
        }
    }
    Ok(None)
}

/// What the eigenfunction must be a multiple of, at the places of psi; all zero where none will do. `None` where several
/// quadratic polynomials have this frequency.
fn model<F: Field>(
    n: usize,
    e: &Eigenvalue,
    spectrum: &Spectrum<F, BITS>,
    psi: &[Complex],
) -> Result<Option<Vec<Complex>>, Trouble> {
    let root = spectrum.root(e);
    let positive = root.is_real() && root.re.sign() == Some(Ordering::Greater);
    let image = |z: &Complex| match e.frequency {
        _ if !positive => Ok(Complex::zero()),
        0 => z.times(&z.conjugate()),
        1 if n == 3 => z.conjugate().times(&z.conjugate()),
        2 => z.times(z),
        _ => Ok(Complex::zero()),
    };
    if e.frequency == 2 && n == 4 {
        return Ok(None);
    }
    Ok(Some(psi.iter().map(image).collect::<Result<_, _>>()?))
}

/// Whether some f(P) m(Q) - f(Q) m(P) is certainly not zero; or some f(P), for a model that vanishes.
fn is_no_multiple(values: &[Complex], model: &[Complex]) -> bool {
    let vanishes = model.iter().all(|m| m.re.is_certainly_zero() && m.im.is_certainly_zero());
    if vanishes {
        return values.iter().any(Complex::is_certainly_not_zero);
    }
    let apart = |(p, q): (usize, usize)| {
        let left = values[p].times(&model[q]);
        let right = values[q].times(&model[p]);
        left.and_then(|left| left.minus(&right?)).is_ok_and(|difference| difference.is_certainly_not_zero())
    };
    (1..values.len()).any(|q| apart((0, q)))
}

/// The limit mask of regular points as offsets on the lattice.
fn limit_offsets(around: &Surroundings) -> Vec<(Orbit, Value)> {
    let (lattice, n) = (around.patch.lattice, around.patch.lattice.regular_valence());
    let Some(mask) = &around.regular.limit_mask else { return vec![] };
    let mut offsets: Vec<(Orbit, Value)> = mask.centre.iter().map(|weight| ((0, 0), weight.value.clone())).collect();
    for ((i, j), (own, _)) in around.regular.orbits.iter().zip(&mask.orbits) {
        if own.value.is_certainly_zero() {
            continue;
        }
        let place = |sector: usize| offset(lattice, Label { sector: sector as u32, i: *i, j: *j });
        offsets.extend((0..n).map(|sector| (place(sector), own.value.clone())));
    }
    offsets
}

/// The eigenfunctions of an eigenvalue.
fn nets<'a, 's, F: Field>(
    rows: &Rows<F>,
    spectrum: &Spectrum<F, BITS>,
    e: &Eigenvalue,
    embedding: Embedding<F, BITS>,
    around: &'a Surroundings<'a, 's>,
) -> Result<Vec<Net<'a, 's>>, Obstacle> {
    let block = &spectrum.blocks[e.frequency];
    let root = spectrum.root(e);
    if !root.is_real() {
        return Ok(vec![]);
    }
    let mut nets = Vec::new();
    for vector in right_vectors(block, spectrum.polynomial(e), &root.re, embedding)? {
        let values = RefCell::new(values(rows, block, &vector, e.frequency, around)?);
        let eigenvalue = Complex { re: root.re.clone(), im: root.im.clone() };
        nets.push(Net { around, frequency: e.frequency, eigenvalue, values });
    }
    Ok(nets)
}

/// A basis of the right vectors of a real root, enclosed.
fn right_vectors<F: Field>(
    block: &Block<F>,
    polynomial: &Univariate<F>,
    root: &Value,
    embedding: Embedding<F, BITS>,
) -> Result<Vec<Vec<Value>>, Trouble> {
    if let [constant, _] = polynomial.coefficients() {
        let vectors = null_space(&shifted(&block.matrix, &constant.negated())?)?;
        return vectors.iter().map(|vector| vector.iter().map(embedding).collect()).collect();
    }
    let lift = |row: &Vec<F>| row.iter().map(|entry| Extension::constant(entry.clone())).collect();
    let matrix: Matrix<Extension<F>> = block.matrix.iter().map(lift).collect();
    let value = |element: &Extension<F>| {
        let coefficients = element.value().coefficients().iter().rev();
        coefficients.map(embedding).try_fold(Value::whole(0), |sum, next| sum.times(root)?.plus(&next?))
    };
    let vectors = null_space(&shifted(&matrix, &Extension::root(polynomial)?)?)?;
    vectors.iter().map(|vector| vector.iter().map(value).collect()).collect()
}

/// The values of a vector of the block at the orbits, in sector 0 (see [`super::block`]).
fn values<F: Field>(
    rows: &Rows<F>,
    block: &Block<F>,
    vector: &[Value],
    frequency: usize,
    around: &Surroundings,
) -> Result<HashMap<Orbit, Complex>, Trouble> {
    let power = |m: i64| {
        let turns = RBig::from(m * frequency as i64) / RBig::from(around.patch.valence);
        Complex::root(&turns)
    };
    let mut values = HashMap::new();
    if rows.centre.is_some() {
        values.insert((0, 0), Complex::zero());
    }
    for (index, unknown) in block.unknowns.iter().enumerate() {
        let real = Complex { re: vector[index].clone(), im: Value::whole(0) };
        match *unknown {
            Unknown::Centre => {
                values.insert((0, 0), real);
            }
            Unknown::Value(t) => {
                values.insert(rows.orbits[t], real);
            }
            Unknown::Own(t) => {
                let shift = rows.mirrors[t].1;
                let unit = power(shift.div_euclid(2))?;
                let unit = if shift % 2 == 0 { unit } else { unit.plus(&power(shift.div_euclid(2) + 1)?)? };
                values.insert(rows.orbits[t], unit.times(&real)?);
            }
            Unknown::First(t, u) => {
                let second = Complex { re: vector[index + 1].clone(), im: Value::whole(0) };
                let z = real.plus(&second.times(&power(1)?)?)?;
                values.insert(rows.orbits[u], z.conjugate().times(&power(rows.mirrors[t].1)?)?);
                values.insert(rows.orbits[t], z);
            }
            Unknown::Second(..) => {}
        }
    }
    Ok(values)
}

/// The place that regular stencils are read at, far from the centre.
const FAR: i32 = 64;

/// Whether the stencils of the regular lattice take quadratic polynomials to such: the moments up to the second of the old points
/// about the new one are the same for all remainders of its label. Then lambda^2 has x^2, xy and y^2 as eigenfunctions.
///
/// # Errors
/// When a weight has no value.
pub fn generates_quadratics<F: Field>(
    refinement: &Refinement<PerFrequency<F>>,
    lattice: Lattice,
) -> Result<bool, Obstacle> {
    let patch = Patch::new(lattice, lattice.regular_valence());
    let mut first: Option<Vec<F>> = None;
    let d = refinement.cycle()?.dilation;
    let remainders = (0..d).flat_map(|i| (0..d).map(move |j| (i, j)));
    for (i, j) in remainders.map(|(i, j)| (d * FAR + i, d * FAR + j)) {
        let row = refinement.row(&patch, Label { sector: 0, i, j })?;
        let mut moments = vec![F::whole(0); 6];
        for (old, weight) in row {
            // the distances times the dilation
            let (x, y) = (i64::from(d * old.i - i), i64::from(d * old.j - j));
            for (moment, factor) in moments.iter_mut().zip([1, x, y, x * x, x * y, y * y]) {
                *moment = moment.plus(&weight.general.times(&F::whole(factor))?)?;
            }
        }
        match &first {
            Some(before) if *before != moments => return Ok(false),
            _ => first = Some(moments),
        }
    }
    Ok(true)
}
