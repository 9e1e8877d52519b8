//! Where is the limit of a vertex on a crease, and has the surface a tangent plane there?
//!
//! A left vector of 1 is the limit mask. Let lambda_1 and lambda_2 be the two largest eigenvalues after 1: where they are real, positive,
//! each alone in its part, and larger in modulus than all that follows, their left vectors are tangent masks: x_m = limit + sum_i
//! lambda_i^m (l_i x_0) r_i + smaller terms. They need not be equal. The faces around the vertex have, more and more exactly, the shape of the
//! plane control net (r_1, r_2), one factor stretched: where that net's faces around the centre are all turned counter-clockwise,
//! the normals of these faces converge to that of the plane of the two tangents.

use super::super::cores::Cores;
use super::super::spectrum::{Eigenvalue, NEAR, Spectrum};
use super::exact::ExactHalves;
use super::halves::{Halves, MirrorNode, Parity};
use super::local::FanMatrix;
use crate::mesh::{Fan, Label};
use std::f64::consts::TAU;

/// Weights, relative to the largest, that rounding alone may have made.
const ROUNDING: f64 = 1e-14;

/// Determinants, relative to the largest product, that are taken for 0.
const FLAT: f64 = 1e-9;

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
    /// The points of the characteristic map: for each point of the neighbourhood the values of the two right vectors.
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

/// An eigenvalue with its vectors on all points, their product 1.
struct Pair {
    eigenvalue: Eigenvalue,
    left: Vec<f64>,
    right: Vec<f64>,
}

impl Pair {
    fn turned(&mut self) {
        self.left.iter_mut().chain(&mut self.right).for_each(|value| *value = -*value);
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

    /// The 1 of the constants, where it is alone and larger than all else.
    fn dominant_one(&self) -> Result<Eigenvalue, String> {
        let one = self.spectrum.one().ok_or("there is no eigenvalue 1")?;
        let next = self.spectrum.after_one().next().map_or(0.0, Eigenvalue::modulus);
        if (one.modulus() - 1.0).abs() > NEAR {
            return Err("1 is not an eigenvalue".to_string());
        }
        if !one.is_isolated() || next >= 1.0 - NEAR {
            return Err(format!("1 is not larger than all that follows, {}", short(next)));
        }
        Ok(one)
    }

    /// The weights that are not 0, divided by a scale.
    fn weights(&self, left: &[f64], scale: f64) -> FanMask {
        let least = ROUNDING * largest(left).abs();
        let weights = self.local.labels.iter().zip(left).filter(|(_, weight)| weight.abs() > least);
        weights.map(|(label, weight)| (*label, weight / scale)).collect()
    }

    /// The tangent masks, or why there are none.
    pub(super) fn tangent_masks(&self) -> Result<TangentMasks, String> {
        let eigenvalues = self.leading_two()?;
        let mut pairs = eigenvalues.map(|e| self.pair(e));
        let first_along = pairs.iter().position(|pair| pair.as_ref().is_ok_and(|pair| self.is_along(pair)));
        if first_along == Some(1) {
            pairs.reverse();
        }
        let [first, second] = pairs;
        let (mut first, mut second) = (first?, second?);
        let ahead = self.value(&first.right, self.ring()[0]);
        if if ahead == 0.0 { largest(&first.right) } else { ahead } < 0.0 {
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
            eigenvalues: [first.eigenvalue, second.eigenvalue],
            net: first.right.iter().zip(&second.right).map(|(x, y)| [x + 0.0, y + 0.0]).collect(),
        })
    }

    /// The two largest eigenvalues after 1, where a tangent plane may come from them.
    fn leading_two(&self) -> Result<[Eigenvalue; 2], String> {
        self.dominant_one().map_err(|why| format!("no tangent plane: {why}"))?;
        let mut rest = self.spectrum.after_one();
        let (Some(first), Some(second)) = (rest.next(), rest.next()) else {
            return Err("no tangent plane: there are no two eigenvalues after 1".to_string());
        };
        for e in [first, second] {
            if !e.is_isolated() {
                return Err(self.why_not_alone(e));
            }
            if e.real().is_none_or(|value| value <= NEAR) {
                return Err(format!("no tangent plane: {} is not real and positive", in_words(e)));
            }
        }
        match rest.next() {
            Some(third) if second.modulus() - third.modulus() <= NEAR => Err(self.why_third_is_level(second, third)),
            _ => Ok([*first, *second]),
        }
    }

    /// Several eigenvalues of one part are approximately equal: exact numbers know whether they are a Jordan block.
    fn why_not_alone(&self, e: &Eigenvalue) -> String {
        let value = in_words(e);
        let Some(known) = self.exact.and_then(|exact| exact.structure_at(e)) else {
            return format!(
                "undecided: {} eigenvalues are approximately equal at {value} (a Jordan block or not)",
                e.cluster
            );
        };
        match known {
            Some(structure) if structure.largest > 1 => {
                format!("no tangent plane: {value} has a Jordan block of size {}", structure.largest)
            }
            Some(_) => format!("no tangent plane: {value} is an eigenvalue {} times in its part", e.cluster),
            None => {
                format!("undecided: {} different eigenvalues at {value} are too near each other for f64", e.cluster)
            }
        }
    }

    fn why_third_is_level(&self, second: &Eigenvalue, third: &Eigenvalue) -> String {
        let (second, third) = (in_words(second), in_words(third));
        format!(
            "no tangent plane found: the third eigenvalue {third} is approximately as large as the second, {second}"
        )
    }

    fn pair(&self, eigenvalue: Eigenvalue) -> Result<Pair, String> {
        let none = || format!("no tangent plane found: no vectors for {}", in_words(&eigenvalue));
        let (left, _) = self.spectrum.left_vector(self.halves, self.cores, &eigenvalue).ok_or_else(none)?;
        let (right, _) = self.spectrum.right_vector(self.halves, self.cores, &eigenvalue).ok_or_else(none)?;
        let product: f64 = left.iter().zip(&right).map(|(l, r)| l * r).sum();
        if product.abs() <= NEAR * largest(&left).abs() * largest(&right).abs() {
            return Err(none());
        }
        Ok(Pair { eigenvalue, left: left.into_iter().map(|value| value / product).collect(), right })
    }

    /// Whether the eigenvector runs along the crease: it differs on the spokes 0 and k. At a dart it is the same on either side
    /// of spoke 0.
    fn is_along(&self, pair: &Pair) -> bool {
        let along = if self.fan().kind().is_closed() { Parity::Even } else { Parity::Odd };
        Parity::of_part(pair.eigenvalue.frequency) == along
    }

    fn fan(&self) -> Fan {
        self.local.fan
    }

    /// The edge neighbours of the centre, counter-clockwise.
    fn ring(&self) -> Vec<Label> {
        (0..self.fan().spokes()).map(|sector| Label { sector, i: 1, j: 0 }).collect()
    }

    fn value(&self, vector: &[f64], label: Label) -> f64 {
        self.local.index(label).map_or(0.0, |index| vector[index])
    }

    /// The edges from the centre in the plane of two eigenvectors, each scaled so that its largest is 1.
    fn spokes(&self, pairs: [&Pair; 2]) -> Vec<[f64; 2]> {
        let [x, y] = pairs.map(|pair| {
            let centre = self.value(&pair.right, self.fan().centre());
            let edges: Vec<f64> = self.ring().iter().map(|label| self.value(&pair.right, *label) - centre).collect();
            let scale = largest(&edges).abs();
            edges.iter().map(|edge| if scale == 0.0 { 0.0 } else { edge / scale }).collect::<Vec<f64>>()
        });
        x.into_iter().zip(y).map(|(x, y)| [x, y]).collect()
    }

    /// Which way the faces around the centre turn, if all turn the same way, and that once.
    fn orientation(&self, first: &Pair, second: &Pair) -> Orientation {
        let spokes = self.spokes([first, second]);
        let next = spokes[1..].iter().chain(self.fan().kind().is_closed().then_some(&spokes[0]));
        let turns: Vec<(f64, f64)> = spokes.iter().zip(next).map(|(a, b)| turn(*a, *b)).collect();
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
        let mut modes = [&first.eigenvalue, &second.eigenvalue];
        modes.sort_by(|a, b| b.modulus().total_cmp(&a.modulus()));
        let [a, b] = modes.map(in_words);
        let ends = [self.ring()[0], Label { sector: self.fan().sectors(), i: 1, j: 0 }];
        let vanishes = |pair: &Pair| ends.iter().all(|end| self.value(&pair.right, *end) == 0.0);
        let boundary = self.along_the_boundary();
        match boundary {
            Some(own) if !self.fan().kind().is_closed() && vanishes(first) && vanishes(second) => format!(
                "no tangent plane: two modes that vanish along the boundary, {a} and {b}, are above the boundary's {}",
                in_words(&own)
            ),
            _ => format!("no tangent plane found: the characteristic map of {a} and {b} folds at the vertex"),
        }
    }

    /// The largest eigenvalue after 1 that belongs to the boundary's own points.
    fn along_the_boundary(&self) -> Option<Eigenvalue> {
        let first = self.local.index(self.ring()[0])?;
        let own = |e: &&Eigenvalue| self.cores.cores[e.core].iter().any(|node| node.point() == first);
        self.spectrum.after_one().find(own).copied()
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

/// The entry of the largest modulus.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |top: f64, value| if value.abs() > top.abs() { *value } else { top })
}

/// A number in a sentence.
fn short(value: f64) -> String {
    let text = format!("{value:.8}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

fn in_words(e: &Eigenvalue) -> String {
    match e.real() {
        Some(value) => short(value),
        None => {
            format!("{} {} {}i", short(e.value.re), if e.value.im < 0.0 { '-' } else { '+' }, short(e.value.im.abs()))
        }
    }
}
