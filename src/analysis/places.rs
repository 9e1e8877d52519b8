//! Which masks hold at a vertex of a mesh?
//!
//! A place is a vertex with its surroundings: inside the mesh with n edges, on a boundary or crease with k faces on a side, at a
//! corner, or where a crease ends. The masks of a place are found once, by the same stages as a report's, and applied wherever it occurs.
//! They are approximate (f64).

use super::masks::Mask;
use super::spectra::Spectra;
use super::spectrum::{NEAR, Spectrum};
use crate::mesh::Label;
use crate::refine::Obstacle;

/// Weights on labelled points around a place.
pub type LabelledMask = Vec<(Label, f64)>;

/// The masks of a place; where there is none, the reason in words.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceMasks {
    /// The limit mask; it sums to 1.
    pub limit: Result<LabelledMask, String>,
    /// Two tangent masks, the first times the second pointing outward; each sums to 0.
    pub tangents: Result<[LabelledMask; 2], String>,
    /// The moduli by which the tangents and what is left beside them shrink in a step: lambda and mu.
    pub rates: Option<[f64; 2]>,
}

impl Spectra<'_> {
    /// The masks at an extraordinary point of a valence (dual: face).
    ///
    /// # Errors
    /// When the valence is out of range or a weight has no value there.
    pub fn masks(&self, valence: usize) -> Result<PlaceMasks, Obstacle> {
        let (local, blocks, cores, spectrum) = self.stages(valence)?;
        let one = spectrum.one().filter(|_| converges(&spectrum));
        let left = one.and_then(|one| spectrum.left_vector(&blocks, &cores, &one));
        let limit = left.and_then(|(left, _)| Mask::limit(&left, &local));
        let lambda = lambda(&spectrum);
        let tangents = lambda.and_then(|lambda| {
            let left = spectrum.left_vector(&blocks, &cores, &lambda).map(|(left, _)| left);
            left.and_then(|left| Mask::tangents(&left, &local))
                .ok_or_else(|| "a tangent mask can't be computed".to_string())
        });
        let after = |lambda: &f64| spectrum.after_subdominant().next().map(|mu| [*lambda, mu.modulus()]);
        Ok(PlaceMasks {
            limit: limit
                .map(|mask| mask.weights(&local))
                .ok_or_else(|| "the points do not converge: 1 is not the largest eigenvalue".to_string()),
            rates: tangents.as_ref().ok().and(spectrum.subdominant()).and_then(|lambda| after(&lambda.modulus())),
            tangents: tangents.map(|masks| masks.map(|mask| mask.weights(&local))),
        })
    }
}

/// Whether 1 is the largest eigenvalue, by more than floating numbers can't tell.
fn converges(spectrum: &Spectrum) -> bool {
    spectrum.after_one().next().is_none_or(|next| next.modulus() < 1.0 - NEAR)
}

/// The subdominant eigenvalue, where there is a tangent plane: of frequency 1, real and positive, and larger than all that follow.
fn lambda(spectrum: &Spectrum) -> Result<super::spectrum::Eigenvalue, String> {
    let Some(lambda) = spectrum.subdominant() else { return Err("there is no eigenvalue but 1".to_string()) };
    let value = |e: &super::spectrum::Eigenvalue| format!("{:.6} of frequency {}", e.modulus(), e.frequency);
    if !converges(spectrum) {
        return Err("the points do not converge".to_string());
    }
    if lambda.frequency != 1 {
        return Err(format!(
            "no tangent plane: the largest eigenvalue after 1, {}, is not of frequency 1",
            value(&lambda)
        ));
    }
    if !lambda.is_isolated() {
        return Err(format!("undecided: eigenvalues approximately equal at {}", value(&lambda)));
    }
    if lambda.real().is_none_or(|real| real <= 0.0) {
        return Err(format!("no tangent plane: the largest eigenvalue after 1, {}, is not positive", value(&lambda)));
    }
    match spectrum.after_subdominant().next() {
        Some(next) if next.modulus() >= lambda.modulus() - NEAR => {
            Err(format!("no tangent plane: {} does not dominate {}", value(&lambda), value(next)))
        }
        _ => Ok(lambda),
    }
}
