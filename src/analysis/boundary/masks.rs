//! Where is the limit of a vertex on a crease, and has the surface a tangent plane there?
//!
//! A left vector of 1 is the limit mask. Let lambda_1 and lambda_2 be the two largest eigenvalues after 1: where they are real, positive,
//! and larger in modulus than all that follows, their left vectors are tangent masks: x_m = limit + sum_i
//! lambda_i^m (l_i x_0) r_i + smaller terms. They need not be equal. The faces around the vertex have, more and more exactly, the shape of the
//! plane control net (r_1, r_2), one factor stretched: where that net's faces around the centre are all turned counter-clockwise,
//! the normals of these faces converge to that of the plane of the two tangents. An eigenvalue with a single Jordan block of size s
//! grows like m^(s-1) lambda^m, again with one left and one right vector; whether a block is there exact numbers decide. Where r_2 vanishes
//! its next generalised vector, which has the same tangent, shows: the net is (r_1, m r_2/lambda_2 + g_2), m large.

use super::super::cores::Cores;
use super::super::spectrum::{Eigenvalue, NEAR, Spectrum};
use super::exact::ExactHalves;
use super::halves::{Halves, MirrorNode, Parity};
use super::leading::{Lead, in_words};
use super::local::FanMatrix;
use crate::mesh::{Fan, Label, Lattice};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Weights, relative to the largest, that rounding alone may have made.
const ROUNDING: f64 = 1e-14;

/// Determinants, relative to the largest product, that are taken for 0.
const FLAT: f64 = 1e-9;

/// Singular values that are taken for 0 where exact numbers say that there is one.
const SINGULAR: f64 = 1e-9;

/// The most sweeps of a singular value decomposition.
const MAX_SWEEPS: usize = 1_000;

/// A number of steps after which a Jordan block shows its shape.
const MANY_STEPS: f64 = 1e4;

/// Points of the fan, each with a weight.
pub type FanMask = Vec<(Label, f64)>;

/// The two tangent masks of a vertex.
#[derive(Clone, Debug)]
pub struct TangentMasks {
    /// The masks; the largest weight of each is 1 or -1. The first tangent runs along the crease towards spoke 0, as far as there is such
    /// a direction, and first x second is the outward normal of a surface whose faces are counter-clockwise.
    pub masks: [FanMask; 2],
    /// The eigenvalue of each.
    pub eigenvalues: [Eigenvalue; 2],
    /// The size of its Jordan block: 1 where there is none. With a block normals converge slowly, like 1/m.
    pub jordan: [usize; 2],
    /// The points of the characteristic map: for each point of the neighbourhood the values of the two right vectors (eigenvectors,
    /// where there is a Jordan block).
    pub net: Vec<[f64; 2]>,
}

/// What masks are made of.
pub(super) struct Stages<'a> {
    pub(super) local: &'a FanMatrix,
    pub(super) halves: &'a Halves,
    pub(super) cores: &'a Cores<MirrorNode>,
    pub(super) spectrum: &'a Spectrum,
    pub(super) exact: Option<&'a ExactHalves>,
}

/// A leading eigenvalue with its vectors on all points: x_m has the part m^(s-1) lambda^m c (left x) right with some c > 0.
struct Pair {
    lead: Lead,
    left: Vec<f64>,
    right: Vec<f64>,
    /// Where there is a block and it matters, a vector with (S - lambda) next = right.
    next: Option<Vec<f64>>,
}

impl Pair {
    fn turned(&mut self) {
        let next = self.next.iter_mut().flatten();
        self.left.iter_mut().chain(&mut self.right).chain(next).for_each(|value| *value = -*value);
    }

    /// What the pair looks like after many steps, up to a factor.
    fn shape(&self) -> Vec<f64> {
        let Some(next) = &self.next else { return self.right.clone() };
        let own = largest(&self.right).abs() * largest(next).abs().recip();
        self.right.iter().zip(next).map(|(r, g)| r + g * own / MANY_STEPS).collect()
    }
}

impl Stages<'_> {
    /// The limit mask, its weights summing to 1; or why there is none.
    pub(super) fn limit_mask(&self) -> Result<FanMask, String> {
        let one = self.dominant_one().map_err(|why| format!("no limit mask: {why}"))?;
        let vector = self.spectrum.left_vector(self.halves, self.cores, &one).map(|(left, _)| left);
        let left = vector.ok_or("no limit mask: the left vector of 1 was not found")?;
        let sum: f64 = left.iter().sum();
        Ok(self.weights(&left, sum))
    }

    /// The weights that are not 0, divided by a scale.
    fn weights(&self, left: &[f64], scale: f64) -> FanMask {
        let least = ROUNDING * largest(left).abs();
        let weights = self.local.labels.iter().zip(left).filter(|(_, weight)| weight.abs() > least);
        weights.map(|(label, weight)| (*label, weight / scale)).collect()
    }

    /// The tangent masks, or why there are none.
    pub(super) fn tangent_masks(&self) -> Result<TangentMasks, String> {
        self.dominant_one().map_err(|why| format!("no tangent plane: {why}"))?;
        let [mut a, mut b] = self.leading_two()?;
        if !self.is_along(&a) && self.is_along(&b) {
            (a, b) = (b, a);
        }
        let (mut first, mut second) = (self.pair(a)?, self.pair(b)?);
        if self.ahead(&first) < 0.0 {
            first.turned();
        }
        match self.orientation(&first, &second) {
            Orientation::CounterClockwise => {}
            Orientation::Clockwise => second.turned(),
            Orientation::Neither => return Err(self.why_it_folds(&first, &second)),
        }
        let scaled = |pair: &Pair| self.weights(&pair.left, largest(&pair.left).abs());
        Ok(TangentMasks {
            masks: [scaled(&first), scaled(&second)],
            eigenvalues: [a.eigenvalue, b.eigenvalue],
            jordan: [a.jordan, b.jordan],
            net: first.right.iter().zip(&second.right).map(|(x, y)| [x + 0.0, y + 0.0]).collect(),
        })
    }

    /// How far the edge neighbour on spoke 0 lies in the direction of a tangent; where it does not, the farthest point.
    fn ahead(&self, pair: &Pair) -> f64 {
        let shape = pair.shape();
        let own = self.value(&shape, self.ring()[0]);
        if own.abs() > FLAT * largest(&shape).abs() { own } else { largest(&shape) }
    }

    /// The vectors of a leading eigenvalue, turned so that what they leave of a function has its sign.
    fn pair(&self, lead: Lead) -> Result<Pair, String> {
        let e = &lead.eigenvalue;
        let none = || format!("no tangent plane found: no vectors for {}", in_words(e));
        let (mut left, _) = self.spectrum.only_left_vector(self.halves, self.cores, e).ok_or_else(none)?;
        let (right, _) = self.spectrum.only_right_vector(self.halves, self.cores, e).ok_or_else(none)?;
        let chain = self.chain(&lead, &right).ok_or_else(none)?;
        let product = dot(&left, chain.last().unwrap_or(&right));
        if product.is_nan() || product.abs() <= NEAR * largest(&left).abs() * largest(&right).abs() {
            return Err(none());
        }
        if product < 0.0 {
            left.iter_mut().for_each(|value| *value = -*value);
        }
        Ok(Pair { lead, left, right, next: chain.into_iter().next().filter(|_| lead.next_follows) })
    }

    /// The generalised vectors of a Jordan block after the eigenvector: (S - lambda) g = the one before. With the last of them,
    /// (S - lambda)^(s-1) is right left/(left last).
    fn chain(&self, lead: &Lead, right: &[f64]) -> Option<Vec<Vec<f64>>> {
        let mut chain: Vec<Vec<f64>> = Vec::new();
        if lead.jordan == 1 {
            return Some(chain);
        }
        let (lambda, size) = (lead.eigenvalue.value.re, self.local.size());
        let shifted = self.local.dense() - DMatrix::identity(size, size) * lambda;
        let svd = shifted.try_svd(true, true, f64::EPSILON, MAX_SWEEPS)?;
        for _ in 1..lead.jordan {
            let before = DVector::from_column_slice(chain.last().map_or(right, Vec::as_slice));
            chain.push(svd.solve(&before, SINGULAR).ok()?.as_slice().to_vec());
        }
        Some(chain)
    }

    /// Whether the eigenvector runs along the crease: it differs on the spokes 0 and k. At a dart it is the same on either side
    /// of spoke 0.
    fn is_along(&self, lead: &Lead) -> bool {
        let along = if self.fan().kind().is_closed() { Parity::Even } else { Parity::Odd };
        Parity::of_part(lead.eigenvalue.frequency) == along
    }

    pub(super) fn fan(&self) -> Fan {
        self.local.fan
    }

    /// The edge neighbours of the centre, counter-clockwise.
    pub(super) fn ring(&self) -> Vec<Label> {
        (0..self.fan().spokes()).map(|sector| Label { sector, i: 1, j: 0 }).collect()
    }

    fn value(&self, vector: &[f64], label: Label) -> f64 {
        self.local.index(label).map_or(0.0, |index| vector[index])
    }

    /// The points of the faces around the centre without itself, counter-clockwise.
    pub(super) fn rim(&self) -> Vec<Label> {
        let (spokes, sectors) = (self.ring(), self.fan().sectors() as usize);
        if self.fan().lattice() == Lattice::Triangles {
            return spokes;
        }
        let across = |sector: usize| (sector < sectors).then_some(Label { sector: sector as u32, i: 1, j: 1 });
        spokes.into_iter().enumerate().flat_map(|(sector, spoke)| [Some(spoke), across(sector)]).flatten().collect()
    }

    /// The rim seen from the centre in the plane of two eigenvectors, each scaled so that its largest value is 1.
    fn plane_rim(&self, pairs: [&Pair; 2]) -> Vec<[f64; 2]> {
        let [x, y] = pairs.map(|pair| {
            let shape = pair.shape();
            let centre = self.value(&shape, self.fan().centre());
            let edges: Vec<f64> = self.rim().iter().map(|label| self.value(&shape, *label) - centre).collect();
            let scale = largest(&edges).abs();
            edges.iter().map(|edge| if scale == 0.0 { 0.0 } else { edge / scale }).collect::<Vec<f64>>()
        });
        x.into_iter().zip(y).map(|(x, y)| [x, y]).collect()
    }

    /// Which way the faces around the centre turn, if all turn the same way, and that once.
    fn orientation(&self, first: &Pair, second: &Pair) -> Orientation {
        let rim = self.plane_rim([first, second]);
        let next = rim[1..].iter().chain(self.fan().kind().is_closed().then_some(&rim[0]));
        let turns: Vec<(f64, f64)> = rim.iter().zip(next).map(|(a, b)| turn(*a, *b)).collect();
        let total: f64 = turns.iter().map(|(_, angle)| angle.abs()).sum();
        let once = if self.fan().kind().is_closed() { (total - TAU).abs() < 1e-6 } else { total < TAU };
        match (once, turns.iter().all(|(sine, _)| *sine > FLAT), turns.iter().all(|(sine, _)| *sine < -FLAT)) {
            (true, true, _) => Orientation::CounterClockwise,
            (true, _, true) => Orientation::Clockwise,
            _ => Orientation::Neither,
        }
    }

    /// Two eigenvectors whose net has no right shape: in known schemes because both vanish along the boundary, whose own
    /// eigenvalue comes later.
    fn why_it_folds(&self, first: &Pair, second: &Pair) -> String {
        let mut modes = [&first.lead.eigenvalue, &second.lead.eigenvalue];
        modes.sort_by(|a, b| b.modulus().total_cmp(&a.modulus()));
        let [a, b] = modes.map(in_words);
        let ends = [self.ring()[0], Label { sector: self.fan().sectors(), i: 1, j: 0 }];
        let vanishes = |pair: &Pair| {
            let least = FLAT * largest(&pair.right).abs();
            ends.iter().all(|end| self.value(&pair.right, *end).abs() <= least)
        };
        let boundary = self.along_the_boundary();
        match boundary {
            Some(own) if !self.fan().kind().is_closed() && vanishes(first) && vanishes(second) => format!(
                "no tangent plane: two modes that vanish along the boundary, {a} and {b}, are not below the boundary's own {}",
                in_words(&own)
            ),
            _ => format!("no tangent plane found: the characteristic map of {a} and {b} folds at the vertex"),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Orientation {
    CounterClockwise,
    Clockwise,
    Neither,
}

/// The determinant of two edges and the angle between them.
fn turn([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> (f64, f64) {
    let sine = ax * by - ay * bx;
    (sine, libm::atan2(sine, ax * bx + ay * by))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The entry of the largest modulus.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |top: f64, value| if value.abs() > top.abs() { *value } else { top })
}
