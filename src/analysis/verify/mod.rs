//! Do the masks say what the mesh engine does?
//!
//! For each place random points on a mesh around it, refined deeply (`zoom`), against its masks applied once to the first level: the
//! limit point, the normal, and how fast rings shrink; and tangent masks against a single step, u x_1 = lambda u x_0. And on whole meshes: limits from one level against those from some steps later.
//! Everything is `f64` arithmetic with the tolerances stated: evidence, not proof.

mod zoom;

use super::limit::{LimitSurface, Limits, NoLimit, cross, dot, unit};
use super::places::{Place, PlaceMasks, Rates};
use crate::refine::{Level, Obstacle, Refiner, Route};
use zoom::Zoom;

/// How far limit points may be apart: rounding of some hundred steps on points of size 1.
pub const POSITION: f64 = 1e-12;

/// How far normals may be apart, in radians, where refinement goes deep enough to tell.
pub const NORMAL: f64 = 1e-9;

/// The most steps; and the most points of all of them.
const MOST_STEPS: usize = 500;
const MOST_POINTS: usize = 3_000_000;

/// What was seen at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// The place.
    pub place: Place,
    /// The number of steps that were made.
    pub steps: usize,
    /// The largest difference of a coordinate of the limit point.
    pub position: f64,
    /// How well tangent masks survive a step: the largest coordinate of u x_1 - lambda u x_0, over the sum of |u|, at least 1. 0 where there
    /// are none.
    pub tangent: f64,
    /// The angle between the normals, or why there is no normal.
    pub normal: Result<Angle, String>,
    /// The rates by the analysis, and as observed in the last steps.
    pub rates: Option<(Rates, Observed)>,
    /// Whether masks and refinement agree.
    pub agrees: bool,
}

/// The angle between two normals, and how large it may be: slow convergence leaves a rest. Beside a Jordan block normals converge like 1/m, and
/// the angle says nothing: the bound is infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// In radians.
    pub angle: f64,
    /// The tolerance.
    pub bound: f64,
}

impl Angle {
    /// Whether refinement went deep enough for the angle to say something.
    pub fn is_seen(&self) -> bool {
        self.bound < 0.1
    }
}

/// How fast rings were seen to shrink in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observed {
    /// Along the two tangents, the larger first.
    pub lambda: [f64; 2],
    /// Across them; `None` where nothing is left to be seen.
    pub mu: Option<f64>,
}

/// A scheme's places, ready to be checked.
pub struct Verifier<'a> {
    refiner: Refiner<'a>,
    limits: Limits<'a>,
}

impl<'a> Verifier<'a> {
    /// Prepares the masks of a refiner's scheme.
    ///
    /// # Errors
    /// When a weight has no value at the regular valence, or stencils reach too far.
    pub fn new(refiner: &Refiner<'a>) -> Result<Verifier<'a>, Obstacle> {
        Ok(Verifier { refiner: refiner.clone(), limits: Limits::new(refiner)? })
    }

    /// The masks of a place.
    ///
    /// # Errors
    /// When a weight has no value there, or the place is beyond a limit.
    pub fn masks(&self, place: Place) -> Result<PlaceMasks, Obstacle> {
        self.limits.masks(place)
    }

    /// The steps that a level is refined by before its limits are taken.
    pub fn steps_before(&self, level: &Level<f64>) -> usize {
        self.limits.steps_before(level)
    }

    /// Checks masks at a place on some random neighbourhoods; the worst of them is told.
    ///
    /// # Errors
    /// When a point can't be made.
    pub fn check(&self, place: Place, masks: &PlaceMasks, trials: u64, seed: u64) -> Result<Check, NoLimit> {
        let mut worst: Option<Check> = None;
        for trial in 0..trials.max(1) {
            let check = self.trial(place, masks, seed.wrapping_add(trial))?;
            worst = Some(match worst {
                Some(before) => before.with(check),
                None => check,
            });
        }
        worst.ok_or_else(|| NoLimit::Vertex(0, "no trial was made".to_string()))
    }

    fn trial(&self, place: Place, masks: &PlaceMasks, seed: u64) -> Result<Check, NoLimit> {
        let mut zoom = Zoom::random(&self.refiner, self.limits.reach(), place, seed)?;
        let why = |why: &String| NoLimit::Vertex(0, why.clone());
        let point = zoom.apply(masks.limit.as_ref().map_err(why)?, [0.0; 3]);
        let tangents = |zoom: &Zoom| {
            masks.tangents.as_ref().map(|masks| masks.each_ref().map(|mask| zoom.apply(mask, zoom.centre())))
        };
        let first = tangents(&zoom);
        let steps = steps_needed(masks.rates.as_ref(), zoom.points());
        let mut observed = vec![zoom.step()?];
        let tangent = match (&first, &tangents(&zoom), &masks.rates) {
            (Ok(first), Ok(second), Some(rates)) => survival(first, second, rates) / weight(masks),
            _ => 0.0,
        };
        let seen = steps_to_see(masks.rates.as_ref(), steps);
        let mut normal_seen = zoom.normal();
        for step in 1..steps {
            observed.push(zoom.step()?);
            if step < seen {
                normal_seen = zoom.normal();
            }
        }
        let position = largest_difference(point, zoom.centre());
        let expected = first.map_err(Clone::clone).and_then(|[a, b]| {
            unit(cross(a, b), 0.0).ok_or_else(|| "its tangents are parallel for these points".to_string())
        });
        let normal = expected.map(|normal| Angle {
            angle: angle(normal, normal_seen),
            bound: masks.rates.map_or(NORMAL, |rates| normal_bound(&rates, seen)),
        });
        let rates = masks.rates.map(|rates| (rates, zoom::observed(&observed)));
        let normal_agrees = normal.as_ref().map_or(true, |normal| normal.angle <= normal.bound);
        let agrees = position <= POSITION && tangent <= POSITION && normal_agrees;
        Ok(Check { place, steps, position, tangent, normal, rates, agrees })
    }

    /// The largest differences of limit points and of normals between a level and one some steps later.
    ///
    /// # Errors
    /// When the level can't be refined, or a vertex has no limit point.
    pub fn levels(&self, level: &Level<f64>, steps: usize) -> Result<Levels, NoLimit> {
        let first = self.limits.of(level, &|| ())?;
        let mut gaps = vec![gap(level, &first)];
        let mut later: Option<Level<f64>> = None;
        let mut centres = self.limits.vertices(level);
        for _ in 0..steps {
            let next = self.refiner.step_tracing(later.as_ref().unwrap_or(level), Route::Fast, &mut centres)?;
            gaps.push(gap(&next, &self.limits.of(&next, &|| ())?));
            later = Some(next);
        }
        let second = later.map(|later| self.limits.of_centres(&later, centres, &|| ())).transpose()?;
        let found = Levels::between(&first, second.as_ref().unwrap_or(&first), size(&level.positions));
        Ok(Levels { gaps, ..found })
    }
}

/// The largest distance of a vertex from its limit.
fn gap(level: &Level<f64>, limit: &LimitSurface) -> f64 {
    let distance = |(a, b): (&[f64; 3], &[f64; 3])| {
        let apart = [0, 1, 2].map(|axis| a[axis] - b[axis]);
        dot(apart, apart).sqrt()
    };
    level.positions.iter().zip(&limit.positions).map(distance).fold(0.0, worse)
}

/// Limits from a level and from a later one.
#[derive(Clone, Debug, PartialEq)]
pub struct Levels {
    /// The number of vertices compared.
    pub vertices: usize,
    /// The largest difference of a coordinate, over the size of the mesh.
    pub position: f64,
    /// The largest angle between normals.
    pub normal: f64,
    /// The number of vertices without a normal at one level or both.
    pub without_normal: usize,
    /// The largest distance of a vertex from its limit, at each level from the first to the later one: how fast the control net converges.
    pub gaps: Vec<f64>,
    /// Whether they agree.
    pub agrees: bool,
}

impl Levels {
    fn between(first: &LimitSurface, second: &LimitSurface, size: f64) -> Levels {
        let mut found =
            Levels { vertices: 0, position: 0.0, normal: 0.0, without_normal: 0, gaps: Vec::new(), agrees: true };
        for (vertex, position) in first.positions.iter().enumerate() {
            found.vertices += 1;
            found.position = worse(found.position, largest_difference(*position, second.positions[vertex]) / size);
            let normals = [first.normals[vertex], second.normals[vertex]];
            match normals.contains(&[0.0; 3]) {
                true => found.without_normal += 1,
                false => found.normal = worse(found.normal, angle(normals[0], normals[1])),
            }
        }
        found.agrees = found.position <= POSITION && found.normal <= NORMAL;
        found
    }
}

impl Check {
    /// The worse of two checks of one place.
    fn with(self, other: Check) -> Check {
        let normal = match (self.normal, other.normal) {
            (Ok(a), Ok(b)) => Ok(if a.angle.is_nan() || a.angle > b.angle { a } else { b }),
            (Err(_), Ok(known)) | (Ok(known), Err(_)) => Ok(known),
            (Err(why), Err(_)) => Err(why),
        };
        let (position, tangent) = (worse(self.position, other.position), worse(self.tangent, other.tangent));
        Check { normal, position, tangent, agrees: self.agrees && other.agrees, ..other }
    }
}

/// As many steps as it takes until the part across the tangents is lost in rounding, within bounds.
fn steps_needed(rates: Option<&Rates>, points: usize) -> usize {
    let ratio = rates.map_or(0.5, |rates| rates.mu / rates.lambda[0].min(rates.lambda[1]));
    let position = rates.map_or(0.9, |rates| rates.lambda[0].max(rates.lambda[1]));
    let until =
        |ratio: f64| if ratio < 1.0 { (libm::log(1e-15) / libm::log(ratio.max(1e-3))).ceil() } else { f64::INFINITY };
    let most = MOST_STEPS.min(MOST_POINTS / points.max(1)).max(60);
    (until(ratio).max(until(position)) as usize).clamp(60, most)
}

/// The step after which the normal is looked at: while the two tangents are not so different in length that rounding of the longer one drowns the
/// shorter.
fn steps_to_see(rates: Option<&Rates>, steps: usize) -> usize {
    let ratio = rates.map_or(1.0, |rates| rates.lambda[0].max(rates.lambda[1]) / rates.lambda[0].min(rates.lambda[1]));
    let most = 20.0 / libm::log10(ratio).max(1e-3);
    steps.min(most as usize).max(1)
}

/// What slow convergence leaves of the angle: a multiple of (mu/lambda)^m.
fn normal_bound(rates: &Rates, steps: usize) -> f64 {
    let rest = libm::pow(rates.mu / rates.lambda[0].min(rates.lambda[1]), steps as f64);
    if rates.jordan > 1 { f64::INFINITY } else { NORMAL.max(100.0 * rest) }
}

/// The largest coordinate of u x_1 - lambda u x_0 for both tangent masks.
fn survival(first: &[[f64; 3]; 2], second: &[[f64; 3]; 2], rates: &Rates) -> f64 {
    let apart = |tangent: usize| {
        let factor = rates.lambda[tangent];
        largest_difference(first[tangent].map(|x| factor * x), second[tangent])
    };
    worse(apart(0), apart(1))
}

/// The sum of |u| of the heavier tangent mask, at least 1: rounding grows with it.
fn weight(masks: &PlaceMasks) -> f64 {
    let sum = |mask: &super::places::LabelledMask| mask.iter().map(|(_, weight)| weight.abs()).sum::<f64>();
    masks.tangents.as_ref().map_or(1.0, |masks| masks.iter().map(sum).fold(1.0, f64::max))
}

fn largest_difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).abs()).fold(0.0, worse)
}

/// The larger of two differences; what is no number is worse than any.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let sine = dot(cross(a, b), cross(a, b)).sqrt();
    libm::atan2(sine, dot(a, b))
}

/// The largest coordinate, at least.
fn size(positions: &[[f64; 3]]) -> f64 {
    positions.iter().flatten().fold(f64::MIN_POSITIVE, |top, x| top.max(x.abs()))
}
