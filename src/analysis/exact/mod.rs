//! What is exact in the analysis of one valence, and what holds for all?
//!
//! At one valence the weights are numbers of a field Q(2 cos(2 pi/N)), or, where they are not or the field is too large, are
//! enclosed; the same stages run in either: [`rows`], [`block`], [`spectrum`] with [`jordan`], [`masks`]. With n left free they run in rational
//! functions: [`formulas`]. What leaves these stages no longer knows its field: enclosures and closed forms in words ([`ExactAnalysis`]).

pub mod block;
pub mod curvature;
pub mod formulas;
pub mod jordan;
pub mod masks;
pub mod ranges;
pub mod rows;
pub mod spectrum;
pub mod split;
pub mod words;

use crate::analysis::neighbourhood::Orbit;
use crate::fault::Fault;
use crate::mesh::{Label, Lattice, Patch};
use crate::numbers::real_root::{Embedding, RealRoot};
use crate::numbers::{
    AtValence, Cosine, EnclosedWorld, Enclosure, Extension, Field, PerFrequency, Trouble, Univariate, World,
};
use crate::refine::{Count, EnclosedWeights, ExactWeights, Obstacle, Refinement, cycle_of};
use crate::scheme::Scheme;
use block::{Block, Wave};
use dashu_ratio::RBig;
use formulas::{AllValences, indeterminates};
use jordan::Structure;
use masks::{Mask, limit_mask, tangent_mask};
use rows::Rows;
use spectrum::{Eigenvalue, Spectrum};
use split::{Hint, pieces};
use std::cell::Cell;
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::rc::Rc;
use words::{Described, Words};

/// The bits after the point that values are enclosed with.
pub const BITS: usize = 384;

/// The largest valence whose spectrum is enclosed; beyond it only what holds for all valences is exact.
pub const MAX_ENCLOSED: usize = 400;

/// How values are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// Equality is decided.
    Exact,
    /// Values are enclosed: unequal ones are told apart.
    Enclosed,
}

/// A real number enclosed.
pub type Value = Enclosure<BITS>;

/// An eigenvalue of one frequency.
#[derive(Clone, Debug)]
pub struct ExactEigenvalue {
    /// 0..floor(n/2).
    pub frequency: usize,
    /// Its real part.
    pub re: Value,
    /// Its imaginary part; exactly 0 where it is real.
    pub im: Value,
    /// The square of its modulus.
    pub modulus_squared: Value,
    /// Its multiplicity in this frequency's block, where it is decided.
    pub algebraic: Option<usize>,
    /// Its eigenvectors and Jordan blocks in this frequency's block, where they are decided.
    pub structure: Option<Structure>,
    /// Eigenvalues of the same modulus have the same level; levels count from the largest modulus on.
    pub level: usize,
    /// The orbits of the cores that have it; the centre is none.
    pub orbits: Vec<Vec<usize>>,
    /// The value at this n.
    pub exact: Option<Words>,
    /// The value for all n.
    pub formula: Option<Words>,
}

impl ExactEigenvalue {
    /// Whether it is real.
    pub fn is_real(&self) -> bool {
        self.im.sign() == Some(Ordering::Equal)
    }
}

/// A weight of a mask.
#[derive(Clone, Debug)]
pub struct ExactWeight {
    /// The weight, enclosed.
    pub value: Value,
    /// The weight in words.
    pub exact: Option<Words>,
}

/// A mask as [`Mask`], in words and enclosures.
#[derive(Clone, Debug)]
pub struct ExactMask {
    /// The weight of the centre, where that is a point.
    pub centre: Option<ExactWeight>,
    /// For each orbit `own` and `next`.
    pub orbits: Vec<(ExactWeight, ExactWeight)>,
}

/// Everything exact at one valence.
#[derive(Clone, Debug)]
pub struct ExactAnalysis {
    /// How values are known.
    pub arithmetic: Arithmetic,
    /// Why values are enclosed and not exact.
    pub why_enclosed: Option<String>,
    /// The orbits that the analysis is made on.
    pub orbits: Vec<Orbit>,
    /// By level, then by frequency.
    pub eigenvalues: Vec<ExactEigenvalue>,
    /// For each level whether its moduli are known to be equal, and to be smaller than those before.
    pub certain: Vec<bool>,
    /// The 1 of the constants.
    pub one: Option<usize>,
    /// The subdominant eigenvalue.
    pub subdominant: Option<usize>,
    /// The subdominant eigenvalue where it is real, positive, of frequency 1 and simple there.
    pub lambda: Option<usize>,
    /// |e| against lambda^2, for every eigenvalue e.
    pub against_square: Vec<Option<Ordering>>,
    /// The row of the new centre (dual: of the new corner 0): the old points' labels with their weights.
    pub rule: Vec<(Label, ExactWeight)>,
    /// The limit mask.
    pub limit_mask: Option<ExactMask>,
    /// The tangent masks.
    pub tangent_mask: Option<ExactMask>,
    /// Whether curvature converges where |mu| = lambda^2 without a Jordan block.
    pub converges: Option<bool>,
}

impl ExactAnalysis {
    /// Every eigenvalue but the 1 of the constants.
    pub fn after_one(&self) -> impl Iterator<Item = (usize, &ExactEigenvalue)> {
        self.eigenvalues.iter().enumerate().filter(|(index, _)| Some(*index) != self.one)
    }

    /// The eigenvalues after 1 and the subdominant one.
    pub fn after_subdominant(&self) -> impl Iterator<Item = (usize, &ExactEigenvalue)> {
        self.after_one().filter(|(index, _)| Some(*index) != self.subdominant)
    }

    /// The largest eigenvalue of a frequency after 1 among those of cores within some orbits, where it is told apart from others.
    pub fn largest_within(&self, frequency: usize, orbits: &BTreeSet<Orbit>) -> Option<usize> {
        let inside = |core: &Vec<usize>| core.iter().all(|t| orbits.contains(&self.orbits[*t]));
        let own = |e: &ExactEigenvalue| e.frequency == frequency && e.orbits.iter().any(inside);
        let mut own = self.after_one().filter(|(_, e)| own(e));
        let (index, e) = own.next()?;
        let clear = self.certain[e.level] || own.next().is_none_or(|(_, other)| other.level != e.level);
        clear.then_some(index)
    }

    /// Whether curvature diverges by these eigenvalues: |mu| > lambda^2, or equality with a Jordan block.
    pub fn curvature_diverges(&self) -> Option<bool> {
        let (first, e) = self.after_subdominant().next()?;
        match self.against_square.get(first).copied().flatten().filter(|_| self.certain[e.level])? {
            Ordering::Less => Some(false),
            Ordering::Greater => Some(true),
            Ordering::Equal => {
                let tied = self.after_subdominant().filter(|(_, other)| other.level == e.level);
                let sizes: Option<Vec<usize>> = tied.map(|(_, own)| Some(own.structure?.largest)).collect();
                Some(sizes?.iter().any(|size| *size > 1))
            }
        }
    }

    /// The order of the moduli of two eigenvalues, where it is known.
    pub fn compare_moduli(&self, a: usize, b: usize) -> Option<Ordering> {
        let (low, high) = (self.eigenvalues[a].level, self.eigenvalues[b].level);
        match low.cmp(&high) {
            Ordering::Equal if self.certain[low] => Some(Ordering::Equal),
            Ordering::Equal if a == b => Some(Ordering::Equal),
            Ordering::Equal => None,
            order => Some(order.reverse()),
        }
    }
}

/// What one valence needs to be analysed exactly.
pub struct Task<'a> {
    /// The scheme.
    pub scheme: &'a Scheme,
    /// Its lattice.
    pub lattice: Lattice,
    /// The valence.
    pub valence: usize,
    /// The orbits of the full neighbourhood.
    pub orbits: &'a [Orbit],
    /// The forms for all valences, where there are any.
    pub forms: Option<&'a AllValences>,
    /// The analysis at the regular valence, once it is made.
    pub regular: Option<&'a ExactAnalysis>,
}

impl Task<'_> {
    /// Runs the exact stages, or the enclosed ones where the exact ones can't.
    ///
    /// # Errors
    /// A division by an exact zero, as a fault; else why neither arithmetic holds the values.
    pub fn run(&self) -> Result<ExactAnalysis, Obstacle> {
        let why = match self.run_exactly() {
            Err(Obstacle::Inexact(fault)) => fault.message,
            Err(Obstacle::Trouble(trouble)) => trouble.to_string(),
            Err(Obstacle::Limit(limit)) => limit,
            other => return other,
        };
        if self.valence > MAX_ENCLOSED {
            return Err(Obstacle::Inexact(Fault::whole(format!(
                "{why}; beyond n = {MAX_ENCLOSED} eigenvalues are not enclosed"
            ))));
        }
        let mut analysis = self.run_enclosed()?;
        analysis.why_enclosed = Some(why);
        Ok(analysis)
    }

    /// The centre's count, where its ring is to be summed at once: at the regular valence every place looks like the centre.
    fn centre(&self) -> usize {
        if self.valence == self.scheme.regular_valence() { usize::MAX } else { self.valence }
    }

    fn refinement<'w, W: World>(&'w self, world: &'w W) -> Refinement<'w, PerFrequency<W::Value>> {
        let aliases = Rc::new(Cell::new(0));
        Refinement::weighed(self.scheme, ExactWeights::new(world, Count::Number, self.centre(), aliases))
    }

    fn rows<W: World>(&self, world: &W) -> Result<Rows<W::Value>, Obstacle> {
        Rows::of(&self.refinement(world), Patch::new(self.lattice, self.valence), self.orbits)
    }

    /// Whether curvature converges where |mu| = lambda^2 without a Jordan block.
    fn converges<F: Field>(
        &self,
        rows: &Rows<F>,
        spectrum: &Spectrum<F, BITS>,
        lambda: &Eigenvalue,
        tied: &[&Eigenvalue],
        embedding: Embedding<F, BITS>,
    ) -> Result<Option<bool>, Obstacle> {
        let n = self.valence;
        let twice = |e: &&Eigenvalue| if e.frequency == 0 || 2 * e.frequency == n { 1 } else { 2 };
        let count: usize = tied.iter().map(|e| twice(e) * e.algebraic.unwrap_or(0)).sum();
        let dilation = i64::from(cycle_of(self.scheme)?.dilation);
        let part = Univariate::new(vec![F::whole(-1).over(&F::whole(dilation))?, F::whole(1)]);
        if n == self.lattice.regular_valence() && count == 3 && *spectrum.polynomial(lambda) == part {
            let Some(world) = AtValence::new(n as u64) else { return Ok(None) };
            if curvature::generates_quadratics(&self.refinement(&world), self.lattice)? {
                return Ok(Some(true));
            }
        }
        let Some(regular) = self.regular else { return Ok(None) };
        let world = EnclosedWorld::<BITS>;
        let refinement = self.refinement(&world);
        let around = curvature::Surroundings { patch: Patch::new(self.lattice, n), refinement: &refinement, regular };
        curvature::converges(rows, spectrum, lambda, tied, embedding, &around)
    }

    fn run_exactly(&self) -> Result<ExactAnalysis, Obstacle> {
        let mut order = self.valence as u64;
        loop {
            let large = || Obstacle::Inexact(Fault::whole(TOO_LARGE_A_FIELD));
            let world = AtValence::new(order).ok_or_else(large)?;
            match self.rows(&world) {
                Err(Obstacle::Inexact(_)) if world.needed() > order => order = world.needed(),
                Err(other) => return Err(other),
                Ok(rows) => return self.exactly(&world, rows),
            }
        }
    }

    fn exactly(&self, world: &AtValence, rows: Rows<Cosine>) -> Result<ExactAnalysis, Obstacle> {
        let theta = world.field().theta::<BITS>()?;
        let embedding = |value: &Cosine| value.enclosed(&theta);
        let cosine = |k: usize| {
            let turns = RBig::from(k) / RBig::from(self.valence);
            world.field().cosine(&turns).ok_or(Trouble::BeyondThisWorld("the field lacks a cosine"))
        };
        let hints = self.hints(&cosine)?;
        let split =
            |k: usize, polynomial: &Univariate<Cosine>| pieces(polynomial, hints.get(k).map_or(&[], Vec::as_slice));
        let mut analysis = self.analyse(rows, Arithmetic::Exact, &cosine, &split, &embedding, &hints)?;
        analysis.rule = self.rule(world, &embedding)?;
        Ok(analysis)
    }

    /// The row of the new centre, point by point.
    fn rule<W: World<Value: Described>>(
        &self,
        world: &W,
        embedding: Embedding<W::Value, BITS>,
    ) -> Result<Vec<(Label, ExactWeight)>, Obstacle> {
        let aliases = Rc::new(Cell::new(0));
        let weights = ExactWeights::new(world, Count::Number, usize::MAX, aliases);
        let refinement: Refinement<PerFrequency<W::Value>> = Refinement::weighed(self.scheme, weights);
        let patch = Patch::new(self.lattice, self.valence);
        let row = refinement.row(&patch, Label { sector: 0, i: 0, j: 0 })?;
        let weight =
            |value: &W::Value| Ok::<_, Trouble>(ExactWeight { value: embedding(value)?, exact: value.in_words() });
        row.iter().map(|(label, value)| Ok((*label, weight(&value.general)?))).collect()
    }

    /// The factors that the forms for all valences have at this one, by frequency.
    fn hints(&self, cosine: &dyn Fn(usize) -> Result<Cosine, Trouble>) -> Result<Vec<Vec<Hint>>, Obstacle> {
        let Some(forms) = self.forms.filter(|forms| forms.holds_at(self.valence)) else { return Ok(vec![]) };
        let values: Option<Vec<RBig>> = forms.parameters.iter().map(|name| self.scheme.rational_value(name)).collect();
        let Some(values) = values else { return Ok(vec![]) };
        let parameters: Vec<Cosine> = values.iter().map(Cosine::rational).collect();
        let c = cosine(1)?;
        let approx = |k: usize| libm::cos(std::f64::consts::TAU * k as f64 / self.valence as f64);
        let approx_parameters: Vec<f64> =
            parameters.iter().map(|value| value.as_rational().map_or(0.0, |value| value.to_f64().value())).collect();
        let mut hints = Vec::new();
        for k in 0..=self.valence / 2 {
            let values = indeterminates(self.valence, c.clone(), cosine(k)?, &parameters);
            let own = forms.forms_of(self.valence, k).map_or(&[][..], |own| &own.forms);
            let hint = |form: &formulas::Form| {
                let polynomial = formulas::at(&form.polynomial, &values).ok()?;
                let approx = indeterminates(self.valence, approx(1), approx(k), &approx_parameters);
                Some(Hint { polynomial, form: form.polynomial.clone(), approx, parameters: forms.parameters.clone() })
            };
            hints.push(own.iter().filter_map(hint).collect());
        }
        Ok(hints)
    }

    fn run_enclosed(&self) -> Result<ExactAnalysis, Obstacle> {
        let world = EnclosedWorld::<BITS>;
        let rows = match self.rows(&world) {
            Err(Obstacle::Inexact(_)) => {
                let refinement = Refinement::weighed(self.scheme, EnclosedWeights);
                Rows::of(&refinement, Patch::new(self.lattice, self.valence), self.orbits)?
            }
            rows => rows?,
        };
        let cosine = |k: usize| {
            let turns = RBig::from(k) / RBig::from(self.valence);
            world.cos(&crate::numbers::Angle::fixed(turns))
        };
        let split = |_: usize, polynomial: &Univariate<Value>| Ok(vec![(polynomial.clone(), 1)]);
        self.analyse(rows, Arithmetic::Enclosed, &cosine, &split, &|value: &Value| Ok(value.clone()), &[])
    }

    fn analyse<F: Described>(
        &self,
        rows: Rows<F>,
        arithmetic: Arithmetic,
        cosine: &dyn Fn(usize) -> Result<F, Trouble>,
        split: spectrum::Splitter<F>,
        embedding: Embedding<F, BITS>,
        hints: &[Vec<Hint>],
    ) -> Result<ExactAnalysis, Obstacle> {
        let n = self.valence;
        let block = |k: usize| {
            let wave = match k {
                0 => Wave::One,
                k if 2 * k == n => Wave::MinusOne,
                k => Wave::Cosine(cosine(k)?),
            };
            Block::of(&rows, Some(k), wave)
        };
        let blocks = (0..=n / 2).map(block).collect::<Result<_, Trouble>>()?;
        let spectrum = Spectrum::of(blocks, split, embedding)?;
        let eigenvalues = spectrum.eigenvalues.iter().map(|e| described(&spectrum, e, embedding, hints));
        let mut analysis = ExactAnalysis {
            arithmetic,
            why_enclosed: None,
            orbits: rows.orbits.clone(),
            eigenvalues: eigenvalues.collect::<Result<_, _>>()?,
            certain: spectrum.certain.clone(),
            one: one_of(&spectrum),
            subdominant: None,
            lambda: None,
            against_square: vec![],
            rule: vec![],
            limit_mask: None,
            tangent_mask: None,
            converges: None,
        };
        if analysis.one.is_none() {
            return Err(Obstacle::Inexact(Fault::whole(NO_ONE)));
        }
        analysis.subdominant = subdominant(&analysis);
        analysis.lambda = analysis.subdominant.filter(|index| is_lambda(&analysis.eigenvalues[*index]));
        let tie = |order: &Option<Ordering>| *order == Some(Ordering::Equal);
        analysis.limit_mask = analysis.one.and_then(|one| limit(&rows, &spectrum, one, n, embedding));
        if let Some(index) = analysis.lambda {
            let e = &spectrum.eigenvalues[index];
            analysis.against_square = against_square(&spectrum, e, embedding)?;
            analysis.tangent_mask = tangents(&rows, &spectrum, e, embedding);
            let tied: Vec<usize> =
                (0..analysis.eigenvalues.len()).filter(|e| tie(&analysis.against_square[*e])).collect();
            if F::EXACT && bounded_at_one(&analysis, &tied) {
                let tied: Vec<&Eigenvalue> = tied.iter().map(|index| &spectrum.eigenvalues[*index]).collect();
                analysis.converges = self.converges(&rows, &spectrum, e, &tied, embedding).unwrap_or(None);
            }
        }
        Ok(analysis)
    }
}

/// Whether |mu| = lambda^2 exactly, and no eigenvalue of that modulus has a Jordan block.
fn bounded_at_one(analysis: &ExactAnalysis, tied: &[usize]) -> bool {
    let plain = |index: &usize| analysis.eigenvalues[*index].structure.is_some_and(|structure| structure.largest == 1);
    let first = analysis.after_subdominant().next();
    first.is_some_and(|(index, e)| tied.contains(&index) && analysis.certain[e.level]) && tied.iter().all(plain)
}

const NO_ONE: &str = "1 is not known to be an eigenvalue: the weights don't sum to 1 exactly, or 1 is not simple";

pub(in crate::analysis) const TOO_LARGE_A_FIELD: &str = "the field of the cosines has too large a degree";

pub(in crate::analysis) fn described<F: Described>(
    spectrum: &Spectrum<F, BITS>,
    e: &Eigenvalue,
    embedding: Embedding<F, BITS>,
    hints: &[Vec<Hint>],
) -> Result<ExactEigenvalue, Trouble> {
    let (root, block) = (spectrum.root(e), &spectrum.blocks[e.frequency]);
    let orbits = |core: &usize| block.cores[*core].iter().flat_map(|index| block.unknowns[*index].orbits()).collect();
    let factor = &spectrum.factors[e.factor];
    let hints = hints.get(e.frequency).map_or(&[][..], Vec::as_slice);
    Ok(ExactEigenvalue {
        frequency: e.frequency,
        re: root.re.clone(),
        im: root.im.clone(),
        modulus_squared: spectrum.modulus_squared(e, embedding)?.value,
        algebraic: e.algebraic,
        structure: e.structure,
        level: e.level,
        orbits: e.cores.iter().map(orbits).collect(),
        exact: F::root_in_words(&factor.polynomial, &factor.roots, e.root),
        formula: F::form_in_words(hints, &factor.polynomial, root, e.frequency),
    })
}

/// The eigenvalue 1 of frequency 0, where it is certain: exactly 1, or (enclosed) the only one near it.
fn one_of<F: Field>(spectrum: &Spectrum<F, BITS>) -> Option<usize> {
    let one = Univariate::new(vec![F::whole(-1), F::whole(1)]);
    let holds = |e: &Eigenvalue| {
        let root = spectrum.root(e);
        let near = root.re.contains(&RBig::ONE) && root.im.sign().is_none_or(Ordering::is_eq);
        if F::EXACT { *spectrum.polynomial(e) == one } else { near && e.algebraic == Some(1) }
    };
    spectrum.eigenvalues.iter().position(|e| e.frequency == 0 && holds(e))
}

/// The first after 1; of several of the same modulus that of frequency 1, if there is one.
fn subdominant(analysis: &ExactAnalysis) -> Option<usize> {
    let (first, e) = analysis.after_one().next()?;
    let mut tied = analysis.after_one().filter(|(_, other)| other.level == e.level);
    Some(tied.find(|(_, other)| other.frequency == 1).map_or(first, |(index, _)| index))
}

fn is_lambda(e: &ExactEigenvalue) -> bool {
    e.frequency == 1 && e.is_real() && e.re.sign() == Some(Ordering::Greater) && e.algebraic == Some(1)
}

/// |e| against lambda^2 for every e, by the squares of both.
fn against_square<F: Field>(
    spectrum: &Spectrum<F, BITS>,
    lambda: &Eigenvalue,
    embedding: Embedding<F, BITS>,
) -> Result<Vec<Option<Ordering>>, Trouble> {
    let fourth: RealRoot<F, BITS> = spectrum.modulus_squared(lambda, embedding)?.squared()?;
    let mut known: Vec<((usize, usize), Option<Ordering>)> = Vec::new();
    let mut found = Vec::with_capacity(spectrum.eigenvalues.len());
    for e in &spectrum.eigenvalues {
        let key = (e.factor, e.root);
        let before = known.iter().find(|(own, _)| *own == key).map(|(_, order)| *order);
        let order = match before {
            Some(order) => order,
            None => spectrum.modulus_squared(e, embedding)?.compare(&fourth, embedding)?,
        };
        known.push((key, order));
        found.push(order);
    }
    Ok(found)
}

fn limit<F: Described>(
    rows: &Rows<F>,
    spectrum: &Spectrum<F, BITS>,
    one: usize,
    n: usize,
    embedding: Embedding<F, BITS>,
) -> Option<ExactMask> {
    let e = &spectrum.eigenvalues[one];
    let block = &spectrum.blocks[0];
    let [core] = e.cores[..] else { return None };
    let mask = if F::EXACT && e.algebraic == Some(1) {
        limit_mask(rows, block, &block.cores[core], &F::whole(n as i64)).ok()?
    } else {
        return None;
    };
    let weight = |value: &F| Some(ExactWeight { value: embedding(value).ok()?, exact: value.in_words() });
    in_words(&mask, weight)
}

fn in_words<F>(mask: &Mask<F>, weight: impl Fn(&F) -> Option<ExactWeight>) -> Option<ExactMask> {
    let centre = match &mask.centre {
        Some(value) => Some(weight(value)?),
        None => None,
    };
    let orbits = mask.orbits.iter().map(|(own, next)| Some((weight(own)?, weight(next)?))).collect::<Option<_>>()?;
    Some(ExactMask { centre, orbits })
}

fn tangents<F: Described>(
    rows: &Rows<F>,
    spectrum: &Spectrum<F, BITS>,
    e: &Eigenvalue,
    embedding: Embedding<F, BITS>,
) -> Option<ExactMask> {
    let ([core], true) = (&e.cores[..], F::EXACT) else { return None };
    let block = &spectrum.blocks[1];
    let core = &block.cores[*core];
    let factor = &spectrum.factors[e.factor];
    if let [constant, _] = factor.polynomial.coefficients() {
        let mask = tangent_mask(rows, block, core, &constant.negated(), F::clone).ok()?;
        return in_words(&mask, |value| Some(ExactWeight { value: embedding(value).ok()?, exact: value.in_words() }));
    }
    let lambda = Extension::root(&factor.polynomial).ok()?;
    let mask = tangent_mask(rows, block, core, &lambda, |value| Extension::constant(value.clone())).ok()?;
    let root = spectrum.root(e);
    in_words(&mask, |value| {
        let mut sum = Value::whole(0);
        for coefficient in value.value().coefficients().iter().rev() {
            sum = sum.times(&root.re).ok()?.plus(&embedding(coefficient).ok()?).ok()?;
        }
        let exact = F::extension_in_words(value.value(), &factor.polynomial, &factor.roots, e.root);
        Some(ExactWeight { value: sum, exact })
    })
}
