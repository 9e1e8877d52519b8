//! What shape have the first eigenrings?
//!
//! The characteristic map (Reif 1995): the limit of the net whose control points are the right vector of the subdominant
//! eigenvalue, taken as complex numbers. The net goes on without end by f(A) = (S f)(A)/lambda, since S f = lambda f holds
//! at every label; and the points of level m are those of level 0 at labels d^m times as far out (d is the dilation, mostly 2), so that dense sampling
//! is the same net further out. Limit points and derivatives come from the scheme's own masks at the regular valence.
//! All of it is approximate.

use super::blocks::ModeVector;
use super::local::LocalMatrix;
use super::masks::{Mask, first_nonzero};
use super::neighbourhood::Orbit;
use crate::mesh::{Label, Lattice};
use crate::numbers::RootsOfUnity;
use crate::refine::PatchRows;
use num_complex::Complex64;
use std::cell::RefCell;
use std::collections::HashMap;

/// A chain of old points longer than this means that a net value depends on itself outside the neighbourhood.
const LONGEST_CHAIN: usize = 64;

/// Limit and tangent masks at a regular point, as weights of lattice offsets.
#[derive(Clone, Debug)]
pub struct RegularMasks {
    limit: Vec<((i32, i32), f64)>,
    tangents: [Vec<((i32, i32), f64)>; 2],
    extent: i32,
}

impl RegularMasks {
    /// The masks of the regular valence as offsets on the lattice.
    pub fn of(local: &LocalMatrix, limit: &Mask, tangents: &[Mask; 2]) -> RegularMasks {
        let lattice = local.patch.lattice;
        let offsets = |mask: &Mask| -> Vec<((i32, i32), f64)> {
            mask.weights(local).into_iter().map(|(label, weight)| (offset(lattice, label), weight)).collect()
        };
        let (limit, tangents) = (offsets(limit), [offsets(&tangents[0]), offsets(&tangents[1])]);
        let all = limit.iter().chain(&tangents[0]).chain(&tangents[1]);
        let extent = all.map(|((i, j), _)| i.abs().max(j.abs())).max().unwrap_or(0);
        RegularMasks { limit, tangents, extent }
    }
}

/// Where a point of the regular patch lies, in the coordinates of sector 0. On the dual lattice, as seen from the face at the
/// origin: point (i, j) of the lattice lies at (i + 1/2, j + 1/2), so the offset of corner 0 is (0, 0).
pub(super) fn offset(lattice: Lattice, label: Label) -> (i32, i32) {
    let steps = lattice.steps();
    let step = |turns: u32| steps[turns as usize % steps.len()];
    let (along, over) = (step(label.sector), step(label.sector + 1));
    let at = |a: i32, b: i32| (a * along.0 + b * over.0, a * along.1 + b * over.1);
    if lattice.has_centre() {
        return at(label.i, label.j);
    }
    let (x, y) = at(2 * label.i + 1, 2 * label.j + 1);
    ((x - 1).div_euclid(2), (y - 1).div_euclid(2))
}

/// A point of the characteristic map's image with its Jacobian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Where on the refined lattice, in sector 0.
    pub at: Orbit,
    /// The limit point, scaled with the net's level.
    pub point: Complex64,
    /// The Jacobian determinant, up to a positive factor that all samples share.
    pub jacobian: f64,
}

/// The characteristic map of a valence.
pub struct CharacteristicMap<'r, 's> {
    /// The subdominant eigenvalue lambda.
    pub lambda: f64,
    rows: &'r PatchRows<'r, 's>,
    roots: RootsOfUnity,
    net: RefCell<HashMap<Orbit, Complex64>>,
}

impl<'r, 's> CharacteristicMap<'r, 's> {
    /// The map of a right vector of frequency 1, scaled so that the first orbit's point in sector 0 lies at 1.
    pub fn of(rows: &'r PatchRows<'r, 's>, local: &LocalMatrix, lambda: f64, right: &ModeVector) -> Option<Self> {
        let first = first_nonzero(&right.orbits)?;
        let scaled = right.orbits.iter().map(|value| value / right.orbits[first]);
        let mut net: HashMap<Orbit, Complex64> = local.orbits.iter().copied().zip(scaled).collect();
        if local.centre.is_some() {
            net.insert((0, 0), Complex64::ZERO);
        }
        Some(CharacteristicMap { lambda, rows, roots: RootsOfUnity::new(local.valence()), net: RefCell::new(net) })
    }

    /// The control point at a label; `None` where the net does not determine it.
    pub fn control_point(&self, label: Label) -> Option<Complex64> {
        Some(self.in_sector_0(label.orbit(), 0)? * self.roots.get(i64::from(label.sector)))
    }

    fn in_sector_0(&self, orbit: Orbit, depth: usize) -> Option<Complex64> {
        if let Some(value) = self.net.borrow().get(&orbit) {
            return Some(*value);
        }
        if depth > LONGEST_CHAIN {
            return None;
        }
        let mut sources = Vec::new();
        self.rows.visit(Label { sector: 0, i: orbit.0, j: orbit.1 }, |old, weight| sources.push((old, weight))).ok()?;
        let mut sum = Complex64::ZERO;
        for (old, weight) in sources {
            sum += self.in_sector_0(old.orbit(), depth + 1)? * self.roots.get(i64::from(old.sector)) * weight;
        }
        let value = sum / self.lambda;
        self.net.borrow_mut().insert(orbit, value);
        Some(value)
    }

    fn applied(&self, mask: &[((i32, i32), f64)], (i, j): Orbit) -> Option<Complex64> {
        let mut sum = Complex64::ZERO;
        for ((di, dj), weight) in mask {
            sum += self.control_point(self.rows.patch.point(0, i + di, j + dj))? * weight;
        }
        Some(sum)
    }

    /// The limit point and Jacobian at a regular point of the lattice, in sector 0.
    fn sample(&self, masks: &RegularMasks, at: Orbit) -> Option<Sample> {
        let point = self.applied(&masks.limit, at)?;
        let (cosine, sine) = (self.applied(&masks.tangents[0], at)?, self.applied(&masks.tangents[1], at)?);
        Some(Sample { at, point, jacobian: (cosine.conj() * sine).im })
    }

    /// The least scale at which the ring's samples see nothing of the centre.
    pub fn least_scale(masks: &RegularMasks) -> i32 {
        (2 * masks.extent + 2).max(4).cast_unsigned().next_power_of_two().cast_signed()
    }

    /// Samples over the closed ring segment of sector 0, at the points of the lattice whose distance from the centre is from
    /// `scale` to that times the dilation; row by row from spoke 0 on, each row from the inside out.
    pub fn samples(&self, masks: &RegularMasks, scale: i32) -> Option<Vec<Sample>> {
        let lattice = self.rows.patch.lattice;
        let outer = self.rows.dilation() * scale;
        let inside = |(i, j): &Orbit| (scale..=outer).contains(&lattice.ring(*i, *j));
        let grid = (0..=outer).flat_map(|j| (0..=outer).map(move |i| (i, j)));
        grid.filter(inside).map(|at| self.sample(masks, at)).collect()
    }
}

/// What the samples say of regularity and injectivity, approximately.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// The least Jacobian over the largest: positive when all are.
    pub approx_least_jacobian: f64,
    /// How often the image of the ring's inner border turns around the origin.
    pub approx_winding: f64,
    /// The least cosine of the angle between the image of a point and the sector's axis: the map is injective when it is
    /// regular and this is positive (docs/theory.md, the half-plane test).
    pub approx_half_plane: f64,
    /// The number of samples.
    pub samples: usize,
}

impl Shape {
    /// Reads the shape off the samples of a ring segment.
    pub fn of(samples: &[Sample], lattice: Lattice, scale: i32, valence: usize) -> Option<Shape> {
        let largest = samples.iter().map(|s| s.jacobian.abs()).fold(0.0, f64::max);
        let least = samples.iter().map(|s| s.jacobian).fold(f64::INFINITY, f64::min);
        let mut border: Vec<&Sample> = samples.iter().filter(|s| lattice.ring(s.at.0, s.at.1) == scale).collect();
        border.sort_by(|a, b| (a.at.1 * b.at.0).cmp(&(b.at.1 * a.at.0)));
        let angle = |a: Complex64, b: Complex64| libm::atan2((a.conj() * b).im, (a.conj() * b).re);
        let turns: f64 = border.windows(2).map(|pair| angle(pair[0].point, pair[1].point)).sum();
        // the mirror of a sector: half-way between two spokes, or through a corner of the central face
        let axis = RootsOfUnity::new(2 * valence).get(if lattice.has_centre() { -1 } else { 0 });
        let cosine = |s: &Sample| (s.point * axis).re / s.point.norm_sqr().sqrt();
        let shape = Shape {
            approx_least_jacobian: least / largest,
            approx_winding: turns * valence as f64 / std::f64::consts::TAU,
            approx_half_plane: samples.iter().map(cosine).fold(f64::INFINITY, f64::min),
            samples: samples.len(),
        };
        (largest > 0.0 && shape.approx_half_plane.is_finite()).then_some(shape)
    }
}
