//! Which eigenvalues has the local matrix, exactly?
//!
//! They are the roots of the characteristic polynomials of the cores, frequency by frequency. The polynomials are brought to
//! factors that share no roots, so that equal eigenvalues are known by their factor, and roots are enclosed so narrowly that
//! unequal ones part. In enclosed arithmetic a polynomial is its own factor, and eigenvalues whose enclosures overlap are
//! not told apart.

use super::block::Block;
use super::jordan::{Answer, Structure, structure};
use crate::numbers::linear::part;
use crate::numbers::real_root::{Embedding, RealRoot, roots_of};
use crate::numbers::roots::Root;
use crate::numbers::{Field, Trouble, Univariate};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// A polynomial with eigenvalues as roots; no other factor shares a root with it, where arithmetic is exact.
#[derive(Clone, Debug)]
pub struct Factor<F, const BITS: usize> {
    /// Monic and without multiple roots.
    pub polynomial: Univariate<F>,
    /// Its roots.
    pub roots: Vec<Root<BITS>>,
}

/// An eigenvalue of one frequency.
#[derive(Clone, Debug)]
pub struct Eigenvalue {
    /// 0..floor(n/2).
    pub frequency: usize,
    /// An index into [`Spectrum::factors`].
    pub factor: usize,
    /// An index into the factor's roots.
    pub root: usize,
    /// Its multiplicity in this frequency's block; `None` where enclosures don't part it from others.
    pub algebraic: Option<usize>,
    /// Its eigenvectors and Jordan blocks in this frequency's block, where they are decided.
    pub structure: Option<Structure>,
    /// The cores that have it.
    pub cores: Vec<usize>,
    /// Eigenvalues of the same modulus have the same level; levels count from the largest modulus on.
    pub level: usize,
}

/// The spectrum at one valence.
pub struct Spectrum<F, const BITS: usize> {
    /// The factors of the characteristic polynomials.
    pub factors: Vec<Factor<F, BITS>>,
    /// By level, then by frequency.
    pub eigenvalues: Vec<Eigenvalue>,
    /// The blocks of the frequencies 0..floor(n/2).
    pub blocks: Vec<Block<F>>,
    /// Whether the eigenvalues of each level are known to be smaller than those before, and each level's to be equal in modulus.
    pub certain: Vec<bool>,
}

/// The multiplicities with which factors make up a polynomial.
type Pieces<F> = Vec<(Univariate<F>, usize)>;

/// Splits a monic polynomial into factors without multiple roots.
pub type Splitter<'a, F> = &'a dyn Fn(usize, &Univariate<F>) -> Result<Pieces<F>, Trouble>;

/// More rounds than this a factor can't fall apart.
const MOST_ROUNDS: usize = 16;

impl<F: Field, const BITS: usize> Spectrum<F, BITS> {
    /// The spectrum of the blocks of the frequencies 0..floor(n/2). `split` splits the polynomial of a core of a frequency as far as
    /// it can.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn of(blocks: Vec<Block<F>>, split: Splitter<F>, embedding: Embedding<F, BITS>) -> Result<Self, Trouble> {
        let mut pieces: Vec<Vec<Pieces<F>>> = Vec::with_capacity(blocks.len());
        for (k, block) in blocks.iter().enumerate() {
            let of_core = |core: &Vec<usize>| split(k, &Univariate::characteristic(&part(&block.matrix, core))?);
            pieces.push(block.cores.iter().map(of_core).collect::<Result<_, Trouble>>()?);
        }
        let mut base = Base { factors: Vec::new(), embedding };
        for (piece, _) in pieces.iter().flatten().flatten() {
            base.insert(piece)?;
        }
        for _ in 0..MOST_ROUNDS {
            let mut eigenvalues = Vec::new();
            for (k, of_cores) in pieces.iter().enumerate() {
                eigenvalues.extend(base.eigenvalues(k, of_cores)?);
            }
            match decide_structures(&blocks, &base.factors, &mut eigenvalues)? {
                None => {
                    return Spectrum { factors: base.factors, eigenvalues, blocks, certain: vec![] }.ordered(embedding);
                }
                Some(factor) => base.insert(&factor)?,
            }
        }
        Err(Trouble::BeyondThisWorld("the factors of the characteristic polynomials don't settle"))
    }

    /// The enclosure of an eigenvalue.
    pub fn root(&self, e: &Eigenvalue) -> &Root<BITS> {
        &self.factors[e.factor].roots[e.root]
    }

    /// The polynomial of an eigenvalue.
    pub fn polynomial(&self, e: &Eigenvalue) -> &Univariate<F> {
        &self.factors[e.factor].polynomial
    }

    /// The square of an eigenvalue's modulus, as a real number.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn modulus_squared(&self, e: &Eigenvalue, embedding: Embedding<F, BITS>) -> Result<RealRoot<F, BITS>, Trouble> {
        let (root, polynomial) = (self.root(e), self.polynomial(e));
        if root.is_real() {
            let polynomial = F::EXACT.then(|| polynomial.clone());
            return RealRoot { polynomial, value: root.re.clone() }.squared();
        }
        match polynomial.coefficients() {
            // z and its conjugate are the roots: |z|^2 is the constant term
            [constant, _, _] if F::EXACT => RealRoot::element(constant, embedding),
            _ => Ok(RealRoot { polynomial: None, value: root.modulus_squared()? }),
        }
    }

    /// Sorts by modulus and frequency and finds the levels.
    fn ordered(mut self, embedding: Embedding<F, BITS>) -> Result<Self, Trouble> {
        let mut moduli: Vec<(RealRoot<F, BITS>, Eigenvalue)> = Vec::with_capacity(self.eigenvalues.len());
        for e in std::mem::take(&mut self.eigenvalues) {
            moduli.push((self.modulus_squared(&e, embedding)?, e));
        }
        let by_value = |a: &RealRoot<F, BITS>, b: &RealRoot<F, BITS>| {
            let narrow = b.value.lo_hi().0.cmp(&a.value.lo_hi().0);
            a.value.compare(&b.value).map_or(narrow, Ordering::reverse)
        };
        moduli.sort_by(|(a, e), (b, f)| by_value(a, b).then(e.frequency.cmp(&f.frequency)));
        let tops = suffix_maxima(moduli.iter().map(|(modulus, _)| modulus.value.lo_hi().1).collect());
        let mut level = 0;
        let mut certain = vec![true];
        let mut least = moduli.first().map(|(modulus, _)| modulus.value.lo_hi().0);
        for index in 1..moduli.len() {
            let ((a, e), (b, f)) = (&moduli[index - 1], &moduli[index]);
            let bottom = b.value.lo_hi().0;
            if least.as_ref().is_some_and(|least| tops[index] < *least) {
                // everything from here on is smaller than everything before
                level += 1;
                certain.push(true);
            } else {
                let known = is_certain(&self.factors[e.factor].polynomial);
                let same = known && (e.factor, e.root) == (f.factor, f.root) || self.are_conjugate(e, f);
                let equal = same || a.compare(b, embedding)? == Some(Ordering::Equal);
                certain[level] &= equal;
            }
            least = least.map(|least| least.min(bottom));
            moduli[index].1.level = level;
        }
        self.eigenvalues = moduli.into_iter().map(|(_, e)| e).collect();
        self.eigenvalues.sort_by_key(|e| (e.level, e.frequency));
        self.certain = certain;
        Ok(self)
    }

    fn are_conjugate(&self, e: &Eigenvalue, f: &Eigenvalue) -> bool {
        let (a, b) = (self.root(e), self.root(f));
        e.factor == f.factor && F::EXACT && a.re == b.re && a.im == b.im.negated()
    }
}

/// Factors that share no roots.
struct Base<'a, F, const BITS: usize> {
    factors: Vec<Factor<F, BITS>>,
    embedding: Embedding<'a, F, BITS>,
}

impl<F: Field, const BITS: usize> Base<'_, F, BITS> {
    /// Adds a polynomial without multiple roots, splitting what it has in common with others.
    fn insert(&mut self, polynomial: &Univariate<F>) -> Result<(), Trouble> {
        if polynomial.degree().is_none_or(|degree| degree == 0) {
            return Ok(());
        }
        if self.factors.iter().any(|own| own.polynomial == *polynomial) {
            return Ok(());
        }
        let roots = roots_of(polynomial, self.embedding)?;
        if F::EXACT {
            for index in 0..self.factors.len() {
                if !overlap(&self.factors[index].roots, &roots) {
                    continue;
                }
                let common = self.factors[index].polynomial.gcd(polynomial)?;
                if common.degree() == Some(0) {
                    continue;
                }
                let old = self.factors.remove(index).polynomial;
                let rest = old.divided(&common)?.0.monic()?;
                let own = polynomial.divided(&common)?.0.monic()?;
                self.insert(&common)?;
                self.insert(&rest)?;
                return self.insert(&own);
            }
        }
        self.factors.push(Factor { polynomial: polynomial.clone(), roots });
        Ok(())
    }

    /// The factors that make up a piece.
    fn factors_of(&self, piece: &Univariate<F>) -> Result<Vec<usize>, Trouble> {
        if let Some(index) = self.factors.iter().position(|own| own.polynomial == *piece) {
            return Ok(vec![index]);
        }
        let mut found = Vec::new();
        for (index, factor) in self.factors.iter().enumerate() {
            if factor.polynomial.degree() <= piece.degree() && piece.divided(&factor.polynomial)?.1.degree().is_none() {
                found.push(index);
            }
        }
        Ok(found)
    }

    /// The eigenvalues of one frequency, from the pieces of its cores.
    fn eigenvalues(&self, frequency: usize, cores: &[Pieces<F>]) -> Result<Vec<Eigenvalue>, Trouble> {
        let mut found: Vec<Eigenvalue> = Vec::new();
        for (core, pieces) in cores.iter().enumerate() {
            for (piece, multiplicity) in pieces {
                for factor in self.factors_of(piece)? {
                    for (root, own) in self.factors[factor].roots.iter().enumerate() {
                        let times = multiplicity * own.count;
                        add(&mut found, frequency, (factor, root), times, core);
                    }
                }
            }
        }
        if !F::EXACT {
            self.leave_open(&mut found);
        }
        Ok(found)
    }

    /// Enclosures that overlap may hold one number or several.
    fn leave_open(&self, found: &mut [Eigenvalue]) {
        let root = |e: &Eigenvalue| &self.factors[e.factor].roots[e.root];
        let all: Vec<Eigenvalue> = found.to_vec();
        for (index, e) in found.iter_mut().enumerate() {
            if e.algebraic != Some(1) && !is_certain(&self.factors[e.factor].polynomial) {
                e.algebraic = None;
            }
            let meets =
                |(other, f): (usize, &Eigenvalue)| other != index && overlap(&[root(e).clone()], &[root(f).clone()]);
            if root(e).count > 1 || all.iter().enumerate().any(meets) {
                e.algebraic = None;
            }
        }
    }
}

fn add(found: &mut Vec<Eigenvalue>, frequency: usize, (factor, root): (usize, usize), times: usize, core: usize) {
    match found.iter_mut().find(|e| (e.factor, e.root) == (factor, root)) {
        Some(e) => {
            e.algebraic = e.algebraic.map(|own| own + times);
            if !e.cores.contains(&core) {
                e.cores.push(core);
            }
        }
        None => found.push(Eigenvalue {
            frequency,
            factor,
            root,
            algebraic: Some(times),
            structure: None,
            cores: vec![core],
            level: 0,
        }),
    }
}

/// For each place the largest from there on.
fn suffix_maxima(mut values: Vec<RBig>) -> Vec<RBig> {
    for index in (1..values.len()).rev() {
        if values[index] > values[index - 1] {
            values[index - 1] = values[index].clone();
        }
    }
    values
}

/// Whether the coefficients are numbers, and no intervals: then equal polynomials have equal roots.
fn is_certain<F: Field>(polynomial: &Univariate<F>) -> bool {
    let point = |value: &F| value.minus(value).is_ok_and(|difference| difference.is_certainly_zero());
    F::EXACT || polynomial.coefficients().iter().all(point)
}

fn overlap<const BITS: usize>(a: &[Root<BITS>], b: &[Root<BITS>]) -> bool {
    a.iter().any(|x| b.iter().any(|y| x.re.overlaps(&y.re) && x.im.overlaps(&y.im)))
}

/// Decides the structure of every eigenvalue; a factor that falls apart is given back.
fn decide_structures<F: Field, const BITS: usize>(
    blocks: &[Block<F>],
    factors: &[Factor<F, BITS>],
    eigenvalues: &mut [Eigenvalue],
) -> Result<Option<Univariate<F>>, Trouble> {
    let mut known: Vec<(usize, usize, Structure)> = Vec::new();
    for e in eigenvalues {
        e.structure = match e.algebraic {
            Some(1) => Some(Structure { geometric: 1, largest: 1 }),
            Some(algebraic) if F::EXACT => {
                let before = known.iter().find(|(k, factor, _)| (*k, *factor) == (e.frequency, e.factor));
                if let Some((_, _, found)) = before {
                    Some(*found)
                } else {
                    match structure(&blocks[e.frequency], &e.cores, &factors[e.factor].polynomial, algebraic)? {
                        Answer::Structure(found) => {
                            known.push((e.frequency, e.factor, found));
                            Some(found)
                        }
                        Answer::Splits(factor) => return Ok(Some(factor)),
                    }
                }
            }
            _ => None,
        };
    }
    Ok(None)
}
