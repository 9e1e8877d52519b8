//! Which eigenvalues has the local matrix of a fan, exactly, and with which Jordan blocks?
//!
//! The even and the odd part in a field of cosines (rational numbers, for rules without cosines), through the same stages as the
//! blocks of an extraordinary vertex: characteristic polynomials of cores, their factors, roots enclosed, Jordan blocks by
//! exact ranks. The limit mask comes with it.

use super::super::cores::components;
use super::super::exact::block::{Block, Unknown, Wave};
use super::super::exact::jordan::Structure;
use super::super::exact::masks::left_vector;
use super::super::exact::spectrum::Spectrum;
use super::super::exact::split::pieces;
use super::super::exact::words::Described;
use super::super::exact::{BITS, ExactEigenvalue, ExactWeight, TOO_LARGE_A_FIELD, described};
use super::super::spectrum::{Eigenvalue, NEAR};
use super::halves::{Halves, Parity};
use super::local::FanMatrix;
use super::modes::{Mode, SineRows};
use crate::fault::Fault;
use crate::mesh::Label;
use crate::numbers::real_root::Embedding;
use crate::numbers::{AtValence, Cosine, Field, PerFrequency, Trouble, Univariate};
use crate::refine::{Count, ExactWeights, Obstacle, Refinement};
use crate::scheme::{RuleBook, Scheme};
use std::cell::Cell;
use std::rc::Rc;

/// The most faces that exact numbers are used for: beyond it characteristic polynomials grow too long.
pub const MAX_EXACT: usize = 24;

/// What is exact at a vertex on a crease.
#[derive(Clone, Debug)]
pub struct ExactHalves {
    /// Every eigenvalue, by level, then by part; `frequency` is the part and `orbits` are the points of cores.
    pub eigenvalues: Vec<ExactEigenvalue>,
    /// For each level whether its moduli are known to be equal, and to be smaller than those before.
    pub certain: Vec<bool>,
    /// The limit mask.
    pub limit_mask: Option<Vec<(Label, ExactWeight)>>,
    /// The sine modes: the eigenvalue's index and the wave, where exact rows show that there are such.
    pub sines: Vec<(usize, Mode)>,
    /// The rows that these come from.
    pub sine_rows: Option<SineRows>,
}

impl ExactHalves {
    /// The exact analysis on the points of a local matrix.
    ///
    /// # Errors
    /// Why exact numbers can't hold it.
    pub fn of(scheme: &Scheme, book: &RuleBook, local: &FanMatrix) -> Result<ExactHalves, Obstacle> {
        let fan = local.fan;
        if fan.sectors() as usize > MAX_EXACT {
            return Err(Obstacle::Limit(format!("beyond {MAX_EXACT} faces exact numbers are not tried")));
        }
        let mut order = if fan.kind().is_closed() { u64::from(fan.sectors()) } else { 1 };
        loop {
            let large = || Obstacle::Inexact(Fault::whole(TOO_LARGE_A_FIELD));
            let world = AtValence::new(order).ok_or_else(large)?;
            match matrix(scheme, book, &world, local) {
                Err(Obstacle::Inexact(_)) if world.needed() > order => order = world.needed(),
                Err(other) => return Err(other),
                Ok(matrix) => return analyse(&world, &matrix),
            }
        }
    }

    /// The structure of the eigenvalues that an approximate one, or a cluster of such, stands for: `None` where there are none,
    /// `Some(None)` where they are several different ones.
    pub fn structure_at(&self, e: &Eigenvalue) -> Option<Option<Structure>> {
        let mut near = self.near(e);
        let first = near.next()?;
        Some(if near.next().is_none() { first.structure } else { None })
    }

    /// The eigenvalue that an approximate one, or a cluster of such, stands for; `None` where that are several.
    pub fn eigenvalue_at(&self, e: &Eigenvalue) -> Option<&ExactEigenvalue> {
        let mut near = self.near(e);
        near.next().filter(|_| near.next().is_none())
    }

    /// Whether two approximate eigenvalues are of one modulus.
    pub fn are_level(&self, a: &Eigenvalue, b: &Eigenvalue) -> bool {
        let level = |e: &Eigenvalue| self.near(e).next().map(|e| e.level);
        level(a).is_some_and(|own| level(b) == Some(own) && self.certain[own])
    }

    /// The eigenvalue of a sine mode, which has this value: odd modes are even in the mirror. Exact eigenvalues of a part are so far apart
    /// that only one can be meant, or it is left open.
    fn the_one_at(&self, mode: Mode, value: f64) -> Option<(usize, Mode)> {
        let part = if mode.number % 2 == 1 { Parity::Even } else { Parity::Odd }.part();
        let own = self.eigenvalues.iter().enumerate().filter(|(_, e)| e.frequency == part && e.is_real());
        let mut near = own.filter(|(_, e)| (e.re.midpoint_f64() - value).abs() <= NEAR);
        let found = near.next().map(|(index, _)| (index, mode));
        if near.next().is_some() { None } else { found }
    }

    /// The sine mode that an eigenvalue belongs to.
    pub fn sine_of(&self, index: usize) -> Option<Mode> {
        self.sines.iter().find(|(own, _)| *own == index).map(|(_, mode)| *mode)
    }

    fn near(&self, e: &Eigenvalue) -> impl Iterator<Item = &ExactEigenvalue> {
        let (value, part, radius) = (e.value, e.frequency, e.approx_error.max(NEAR));
        let distance = move |own: &ExactEigenvalue| {
            let (re, im) = (own.re.midpoint_f64() - value.re, own.im.midpoint_f64() - value.im);
            re.abs().max(im.abs())
        };
        self.eigenvalues.iter().filter(move |own| own.frequency == part && distance(own) <= radius)
    }
}

/// The local matrix in exact numbers.
fn matrix(
    scheme: &Scheme,
    book: &RuleBook,
    world: &AtValence,
    local: &FanMatrix,
) -> Result<FanMatrix<Cosine>, Obstacle> {
    // every place is told point by point: no count is the centre's alone
    let weights = ExactWeights::new(world, Count::Number, usize::MAX, Rc::new(Cell::new(0)));
    let refinement: Refinement<PerFrequency<Cosine>> = Refinement::weighed(scheme, weights).with_boundary(book);
    let fan = local.fan;
    let row = |label: Label| {
        let row = refinement.row(&fan, label)?;
        Ok(row.into_iter().map(|(old, weight)| (old, weight.general)).collect())
    };
    FanMatrix::of(fan, local.labels.clone(), row)
}

/// The block of a part, on the first point of each of its nodes.
fn block(halves: &Halves<Cosine>, parity: Parity) -> Result<Block<Cosine>, Trouble> {
    let nodes = halves.nodes_of(parity);
    let row = |to: &_| nodes.iter().map(|from| halves.entry(parity, *to, *from)).collect::<Result<Vec<_>, Trouble>>();
    let matrix = nodes.iter().map(row).collect::<Result<Vec<_>, Trouble>>()?;
    let cores = components(nodes.len(), |to, from| !matrix[to][from].is_certainly_zero());
    let unknowns = nodes.iter().map(|node| Unknown::Value(node.point())).collect();
    Ok(Block { unknowns, matrix, wave: Wave::One, cores })
}

fn analyse(world: &AtValence, matrix: &FanMatrix<Cosine>) -> Result<ExactHalves, Obstacle> {
    let parts = Halves::of(matrix.rows.clone(), &matrix.mirror);
    let blocks = Parity::BOTH.map(|parity| block(&parts, parity));
    let blocks = blocks.into_iter().collect::<Result<Vec<_>, Trouble>>()?;
    let theta = world.field().theta::<BITS>()?;
    let embedding = |value: &Cosine| value.enclosed(&theta);
    let split = |_: usize, polynomial: &Univariate<Cosine>| pieces(polynomial, &[]);
    let spectrum = Spectrum::of(blocks, &split, &embedding)?;
    let eigenvalues = spectrum.eigenvalues.iter().map(|e| described(&spectrum, e, &embedding, &[]));
    let mut halves = ExactHalves {
        eigenvalues: eigenvalues.collect::<Result<_, _>>()?,
        certain: spectrum.certain.clone(),
        limit_mask: limit_mask(&spectrum, matrix, &embedding),
        sines: vec![],
        sine_rows: SineRows::of(matrix),
    };
    let number = |weight: &Cosine| Some(embedding(weight).ok()?.midpoint_f64());
    let waves = halves.sine_rows.as_ref().and_then(|rows| rows.values(&number)).unwrap_or_default();
    halves.sines = waves.into_iter().filter_map(|(mode, value)| halves.the_one_at(mode, value)).collect();
    Ok(halves)
}

/// The left vector of 1 in the even part, where 1 is simple: half of the value at a node stands for each of two points.
fn limit_mask(
    spectrum: &Spectrum<Cosine, BITS>,
    matrix: &FanMatrix<Cosine>,
    embedding: Embedding<Cosine, BITS>,
) -> Option<Vec<(Label, ExactWeight)>> {
    let (block, one) = (&spectrum.blocks[Parity::Even.part()], Cosine::whole(1));
    let polynomial = Univariate::new(vec![Cosine::whole(-1), one.clone()]);
    let is_one = |e: &&_| -> bool {
        let e: &super::super::exact::spectrum::Eigenvalue = e;
        e.frequency == Parity::Even.part() && *spectrum.polynomial(e) == polynomial
    };
    let e = spectrum.eigenvalues.iter().find(is_one).filter(|e| e.algebraic == Some(1))?;
    let own: Vec<usize> = e.cores.iter().flat_map(|core| block.cores[*core].iter().copied()).collect();
    let left = left_vector(&block.matrix, &block.below(&own), &one).ok()?;
    let sum = left.iter().try_fold(Cosine::whole(0), |sum, weight| sum.plus(weight)).ok()?;
    let mut mask = Vec::new();
    for (unknown, weight) in block.unknowns.iter().zip(&left).filter(|(_, weight)| !weight.is_certainly_zero()) {
        let point = *unknown.orbits().first()?;
        let points: &[usize] = if matrix.mirror[point] == point { &[point] } else { &[point, matrix.mirror[point]] };
        let share = weight.over(&sum).ok()?.over(&Cosine::whole(points.len() as i64)).ok()?;
        for point in points {
            let weight = ExactWeight { value: embedding(&share).ok()?, exact: share.in_words() };
            mask.push((*point, weight));
        }
    }
    mask.sort_by_key(|(point, _)| *point);
    Some(mask.into_iter().map(|(point, weight)| (matrix.labels[point], weight)).collect())
}
