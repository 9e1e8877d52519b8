//! Which eigenvalues has a scheme at a valence, and nothing else?
//!
//! The first stages of the pipeline alone, in `f64`: for tables over many values of a parameter, and for the orbits of a
//! neighbourhood.

use super::blocks::Blocks;
use super::cores::Cores;
use super::local::{LocalMatrix, MAX_VALENCE};
use super::neighbourhood::{Influence, Orbit};
use super::smallest_invariant;
use super::spectrum::Spectrum;
use crate::mesh::{Lattice, Patch};
use crate::refine::{Obstacle, PatchRows, Refinement, RegularStencils, lattice_of};
use crate::scheme::Scheme;

/// What the spectra of a scheme at all valences share.
pub struct Spectra<'a> {
    refinement: Refinement<'a, f64>,
    lattice: Lattice,
    stencils: RegularStencils,
    influence: Influence,
}

impl<'a> Spectra<'a> {
    /// Prepares them.
    ///
    /// # Errors
    /// When a weight has no value at the regular valence, or stencils reach too far.
    pub fn new(scheme: &'a Scheme) -> Result<Spectra<'a>, Obstacle> {
        let refinement = Refinement::new(scheme, None);
        let lattice = lattice_of(scheme);
        let stencils = RegularStencils::of(&refinement, lattice)?;
        let influence = Influence::of(&stencils, lattice)?;
        Ok(Spectra { refinement, lattice, stencils, influence })
    }

    /// The lattice that the scheme lives on.
    pub fn lattice(&self) -> Lattice {
        self.lattice
    }

    fn rows(&self, valence: usize) -> PatchRows<'_, 'a> {
        PatchRows::new(&self.refinement, &self.stencils, Patch::new(self.lattice, valence))
    }

    /// The orbits of the full neighbourhood at a valence, and which of them make up the smallest invariant one.
    ///
    /// # Errors
    /// When a weight has no value.
    pub fn neighbourhoods(&self, valence: usize) -> Result<(Vec<Orbit>, Vec<usize>), Obstacle> {
        let rows = self.rows(valence);
        let (orbits, smallest) = (self.influence.orbits(&rows)?, smallest_invariant(&rows)?);
        let inside = (0..orbits.len()).filter(|t| smallest.contains(&orbits[*t])).collect();
        Ok((orbits, inside))
    }

    /// The spectrum at a valence.
    ///
    /// # Errors
    /// When the valence is out of range or a weight has no value there.
    pub fn at(&self, valence: usize) -> Result<Spectrum, Obstacle> {
        Ok(self.stages(valence)?.3)
    }

    /// The local matrix with its blocks, cores and spectrum.
    pub(super) fn stages(&self, valence: usize) -> Result<Stages, Obstacle> {
        if !(3..=MAX_VALENCE).contains(&valence) {
            return Err(Obstacle::Limit(format!("the valence must be from 3 to {MAX_VALENCE}, not {valence}")));
        }
        let local = LocalMatrix::build(&self.rows(valence), &self.influence)?;
        let blocks = Blocks::of(&local);
        let cores = Cores::of(&blocks);
        let spectrum = Spectrum::of(&blocks, &cores)?;
        Ok((local, blocks, cores, spectrum))
    }
}

/// What the first stages of the pipeline give.
pub(super) type Stages = (LocalMatrix, Blocks, Cores, Spectrum);
