//! Which masks hold at a vertex of a mesh?
//!
//! A place is a vertex with its surroundings: inside the mesh with n edges, on a boundary or crease with k faces on a side, at a
//! corner, or where a crease ends. The masks of a place are found once, by the same stages as a report's, and applied wherever it occurs.
//! They are approximate (f64).

use super::boundary::masks::TangentMasks;
use super::boundary::{BoundaryAnalysis, BoundaryAnalyzer};
use super::masks::Mask;
use super::spectra::Spectra;
use super::spectrum::{Eigenvalue, NEAR, Spectrum};
use crate::mesh::{Connectivity, FanKind, HalfEdgeMesh, Label, Lattice};
use crate::refine::{Obstacle, lattice_of};
use crate::scheme::{RuleBook, Scheme};

/// A vertex, as far as its masks are concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// Inside the mesh, with this valence; dual: the middle of a face of this many corners.
    Inside(usize),
    /// On a boundary or crease, at a corner, or where a crease ends.
    Fan(FanKind),
    /// A corner inside the mesh that fewer than two creases lead to.
    Cone,
}

/// Weights on labelled points around a place.
pub type LabelledMask = Vec<(Label, f64)>;

/// The masks of a place; where there is none, the reason in words.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceMasks {
    /// The limit mask; it sums to 1.
    pub limit: Result<LabelledMask, String>,
    /// Two tangent masks, the first times the second pointing outward; each sums to 0.
    pub tangents: Result<[LabelledMask; 2], String>,
    /// How fast tangents and what is left beside them shrink.
    pub rates: Option<Rates>,
}

/// Moduli of eigenvalues: in each step lengths shrink by these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Those of the two tangents, in order of their masks.
    pub lambda: [f64; 2],
    /// The largest of all that follow.
    pub mu: f64,
    /// The largest Jordan block among those of the tangents: with one of 2 or more, rates are approached slowly.
    pub jordan: usize,
}

/// The masks of a scheme's places.
pub struct Places<'a> {
    spectra: Spectra<'a>,
    /// Why there is none is told when somebody asks.
    boundary: Result<BoundaryAnalyzer<'a>, Obstacle>,
    lattice: Lattice,
}

impl<'a> Places<'a> {
    /// Prepares the masks of a scheme with the rules of a boundary file.
    ///
    /// # Errors
    /// When a weight has no value at the regular valence, or stencils reach too far.
    pub fn new(scheme: &'a Scheme, boundary: Option<&'a RuleBook>) -> Result<Places<'a>, Obstacle> {
        let no_rule = Obstacle::NoRule("vertex.crease");
        let boundary = boundary.ok_or(no_rule).and_then(|book| BoundaryAnalyzer::new(scheme, book));
        Ok(Places { spectra: Spectra::new(scheme)?, boundary, lattice: lattice_of(scheme) })
    }

    /// The masks of a place.
    ///
    /// # Errors
    /// When a weight has no value there, or the place is beyond a limit.
    pub fn at(&self, place: Place) -> Result<PlaceMasks, Obstacle> {
        match place {
            Place::Inside(valence) => self.spectra.masks(valence),
            Place::Fan(kind) => Ok(of_fan(&self.boundary.as_ref().map_err(Clone::clone)?.at(kind)?)),
            Place::Cone => Ok(cone()),
        }
    }

    /// How many rings the neighbourhood of an extraordinary point has.
    ///
    /// # Errors
    /// When a weight has no value.
    pub fn reach(&self) -> Result<usize, Obstacle> {
        let (orbits, _) = self.spectra.neighbourhoods(self.lattice.regular_valence() + 1)?;
        let rings = orbits.iter().map(|(i, j)| self.lattice.ring(*i, *j)).max().unwrap_or(1);
        Ok(rings.max(1) as usize)
    }
}

/// The vertex of a mesh at a label around a place whose spokes are given. Straight on is half of the regular number of turns,
/// clockwise; along the last spoke of a fan counter-clockwise, so that the way stays on the fan's side.
pub(super) fn point_at(
    mesh: &HalfEdgeMesh,
    lattice: Lattice,
    place: Place,
    spokes: &[u32],
    label: Label,
) -> Option<u32> {
    let spoke = *spokes.get(label.sector as usize)?;
    if lattice.has_centre() && label.i == 0 || label.orbit() == (0, 0) {
        return Some(mesh.origin(spoke));
    }
    let half = lattice.regular_valence() / 2;
    let last = matches!(place, Place::Fan(kind) if !kind.is_closed()) && label.sector as usize + 1 == spokes.len();
    let turned = |edge: u32, turns: usize| {
        (0..turns).fold(edge, |edge, _| if last { mesh.turn(edge) } else { mesh.turn_back(edge) })
    };
    let on = |edge: u32, steps: i32| (0..steps).fold(edge, |edge, _| turned(mesh.twin(edge), half));
    // dual: the spoke leaves the corner along the face; the ways on lead over the corner along the face's two edges
    let mut edge = match lattice {
        Lattice::Dual if label.i == 0 => return Some(mesh.target(on(mesh.prev(spoke), label.j))),
        Lattice::Dual => on(mesh.twin(spoke), label.i),
        _ => on(spoke, label.i - 1),
    };
    if label.j > 0 {
        edge = on(turned(mesh.twin(edge), half - 1), label.j - 1);
    }
    Some(mesh.target(edge))
}

/// The masks of a vertex on a crease.
fn of_fan(analysis: &BoundaryAnalysis) -> PlaceMasks {
    let chosen = |tangents: &TangentMasks, e: &Eigenvalue| {
        tangents.eigenvalues.iter().any(|own| (own.frequency, own.group) == (e.frequency, e.group))
    };
    let rates = |tangents: &TangentMasks| {
        let mu = analysis.spectrum.after_one().find(|e| !chosen(tangents, e)).map_or(0.0, Eigenvalue::modulus);
        Rates {
            lambda: tangents.eigenvalues.map(|e| e.modulus()),
            mu,
            jordan: tangents.jordan[0].max(tangents.jordan[1]),
        }
    };
    PlaceMasks {
        limit: analysis.limit_mask.clone(),
        rates: analysis.tangent_masks.as_ref().ok().map(rates),
        tangents: analysis.tangent_masks.as_ref().map(|tangents| tangents.masks.clone()).map_err(Clone::clone),
    }
}

/// The masks where a vertex stays and no rule tells what is around it.
fn cone() -> PlaceMasks {
    let centre = vec![(Label { sector: 0, i: 0, j: 0 }, 1.0)];
    let why = "a corner inside the mesh with fewer than two creases has no tangent plane".to_string();
    PlaceMasks { limit: Ok(centre), tangents: Err(why), rates: None }
}

impl Spectra<'_> {
    /// The masks at an extraordinary point of a valence (dual: face).
    ///
    /// # Errors
    /// When the valence is out of range or a weight has no value there.
    pub fn masks(&self, valence: usize) -> Result<PlaceMasks, Obstacle> {
        let (local, blocks, cores, spectrum) = self.stages(valence)?;
        let limit = || {
            if let Some(why) = why_not_convergent(&spectrum) {
                return Err(why);
            }
            let left = spectrum.one().and_then(|one| spectrum.left_vector(&blocks, &cores, &one));
            let mask = left.and_then(|(left, _)| Mask::limit(&left, &local));
            Ok(mask.ok_or("the limit mask can't be computed")?.weights(&local))
        };
        let lambda = lambda(&spectrum);
        let tangents = lambda.and_then(|lambda| {
            let left = spectrum.left_vector(&blocks, &cores, &lambda).map(|(left, _)| left);
            left.and_then(|left| Mask::tangents(&left, &local))
                .ok_or_else(|| "a tangent mask can't be computed".to_string())
        });
        let after = |lambda: Eigenvalue| {
            let mu = spectrum.after_subdominant().next().map_or(0.0, Eigenvalue::modulus);
            Rates { lambda: [lambda.modulus(); 2], mu, jordan: 1 }
        };
        Ok(PlaceMasks {
            limit: limit(),
            rates: tangents.as_ref().ok().and(spectrum.subdominant()).map(after),
            tangents: tangents.map(|masks| masks.map(|mask| mask.weights(&local))),
        })
    }
}

/// Why 1 is not known to be larger than all that follows; equal to it as far as floating numbers tell, the next leaves the question open.
fn why_not_convergent(spectrum: &Spectrum) -> Option<String> {
    let next = spectrum.after_one().next().map_or(0.0, Eigenvalue::modulus);
    match next {
        _ if next < 1.0 - NEAR => None,
        _ if next <= 1.0 + NEAR => {
            Some("undecided: 1 and the next eigenvalue are approximately equal in modulus".to_string())
        }
        _ => Some(format!("the points do not converge: there is an eigenvalue of modulus {next:.6}")),
    }
}

/// The subdominant eigenvalue, where there is a tangent plane: of frequency 1, real and positive, and larger than all that follow.
fn lambda(spectrum: &Spectrum) -> Result<Eigenvalue, String> {
    if let Some(why) = why_not_convergent(spectrum) {
        return Err(why);
    }
    let Some(lambda) = spectrum.subdominant() else { return Err("there is no eigenvalue but 1".to_string()) };
    let value = |e: &Eigenvalue| format!("{:.6} of frequency {}", e.modulus(), e.frequency);
    // of several that are near each other the one of frequency 1 is taken: another may be as large
    let rival = spectrum.after_subdominant().next().filter(|next| next.modulus() >= lambda.modulus() - NEAR);
    if let Some(rival) = rival {
        return Err(format!("undecided: {} and {} are approximately equal in modulus", value(&lambda), value(rival)));
    }
    if !lambda.is_isolated() {
        return Err(format!("undecided: eigenvalues approximately equal at {}", value(&lambda)));
    }
    if lambda.frequency != 1 {
        let why = "no tangent plane: the largest eigenvalue after 1";
        return Err(format!("{why}, {}, is not of frequency 1", value(&lambda)));
    }
    match lambda.real() {
        Some(real) if real > 0.0 => Ok(lambda),
        _ => Err(format!("no tangent plane: the largest eigenvalue after 1, {}, is not positive", value(&lambda))),
    }
}
