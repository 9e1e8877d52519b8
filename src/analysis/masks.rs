//! Where is the limit point, and what are its tangents?
//!
//! A left vector u of S with u S = lambda u sees the same value at every level, up to the factor lambda: that for 1 is the
//! limit mask, those of the subdominant pair are the tangent masks (Halstead, Kass and DeRose 1993). They are applied to the
//! points of the neighbourhood at any level.

use super::blocks::ModeVector;
use super::local::LocalMatrix;
use crate::mesh::Label;
use crate::numbers::RootsOfUnity;
use num_complex::Complex64;

/// Which real part of a wave a mask takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Symmetric under the mirror that fixes spoke 0.
    Cosine,
    /// Antisymmetric under it.
    Sine,
}

/// Weights on the points of the neighbourhood: at (sector s, orbit t) the cosine form has Re(a_t w^(-k s)), the sine form
/// -Im(a_t w^(-k s)), with the amplitudes a_t.
#[derive(Clone, Debug)]
pub struct Mask {
    /// Cosine or sine.
    pub form: Form,
    /// The frequency k: 0 for the limit mask, 1 for tangent masks.
    pub frequency: usize,
    /// The weight of the centre, where that is a point.
    pub centre: Option<f64>,
    /// The amplitude of each orbit.
    pub amplitudes: Vec<Complex64>,
}

impl Mask {
    /// The limit mask from a left vector u of B_0 for the eigenvalue 1: its weights sum to 1. B_0 acts on the mean of each
    /// orbit, so that each of its n points has the weight u_t/n.
    pub fn limit(left: &ModeVector, local: &LocalMatrix) -> Option<Mask> {
        let n = local.valence() as f64;
        let sum = left.centre + left.orbits.iter().map(|value| value.re).sum::<f64>();
        let centre = local.centre.as_ref().map(|_| left.centre / sum);
        let amplitudes = left.orbits.iter().map(|value| value / (n * sum)).collect();
        (sum != 0.0).then_some(Mask { form: Form::Cosine, frequency: 0, centre, amplitudes })
    }

    /// The two tangent masks from a left vector for the subdominant eigenvalue: coefficient 1 (cosine) and 0 (sine) at the first
    /// orbit, sector 0, where it is not zero.
    pub fn tangents(left: &ModeVector, local: &LocalMatrix) -> Option<[Mask; 2]> {
        let first = first_nonzero(&left.orbits)?;
        let amplitudes: Vec<Complex64> = left.orbits.iter().map(|amplitude| amplitude / left.orbits[first]).collect();
        let centre = local.centre.as_ref().map(|_| 0.0);
        let mask = |form| Mask { form, frequency: left.frequency, centre, amplitudes: amplitudes.clone() };
        Some([mask(Form::Cosine), mask(Form::Sine)])
    }

    /// The weight at a sector of an orbit; `roots` are the n-th roots of unity.
    pub fn weight(&self, sector: u32, orbit: usize, roots: &RootsOfUnity) -> f64 {
        let wave = self.amplitudes[orbit] * roots.get(-(self.frequency as i64 * i64::from(sector)));
        match self.form {
            Form::Cosine => wave.re,
            Form::Sine => -wave.im,
        }
    }

    /// Every point of the neighbourhood whose orbit has a part in the mask, with its weight; the centre first.
    pub fn weights(&self, local: &LocalMatrix) -> Vec<(Label, f64)> {
        let roots = RootsOfUnity::new(local.valence());
        let centre =
            self.centre.filter(|weight| *weight != 0.0).map(|weight| (Label { sector: 0, i: 0, j: 0 }, weight));
        let mut weights: Vec<(Label, f64)> = centre.into_iter().collect();
        for (orbit, (i, j)) in local.orbits.iter().enumerate() {
            if self.amplitudes[orbit] != Complex64::ZERO {
                let label = |sector| Label { sector, i: *i, j: *j };
                weights.extend((0..local.patch.valence).map(|s| (label(s), self.weight(s, orbit, &roots))));
            }
        }
        weights
    }
}

/// The first entry that is not zero, against rounding.
pub(super) fn first_nonzero(values: &[Complex64]) -> Option<usize> {
    let largest = values.iter().map(|value| value.norm_sqr()).fold(0.0, f64::max);
    values.iter().position(|value| value.norm_sqr() > 1e-18 * largest)
}
