//! What is the net of the characteristic map, in enclosures?
//!
//! As in [`crate::proof::net`] a value of frequency 1 is a + b w, kept as (a, b), and outside the neighbourhood f = (S
//! f)/lambda; but c, lambda and the weights are enclosed: at one valence, or over a whole interval of c.

use super::signed::Signed;
use crate::analysis::neighbourhood::Orbit;
use crate::mesh::{Label, Patch};
use crate::proof::jacobian::{ControlNet, PairOf};
use crate::proof::net::turned;
use crate::refine::Obstacle;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// The row of an orbit's new point in sector 0: old points with their weights at frequency 1.
pub type RowOf<'r, F> = dyn Fn(Orbit) -> Result<Vec<(Label, F)>, Obstacle> + 'r;

/// The net, as far as it has been asked for.
pub struct EnclosedNet<'r, F> {
    /// Where it lives.
    pub patch: Patch,
    /// cos(2 pi/n).
    pub c: F,
    /// The subdominant eigenvalue.
    pub lambda: F,
    /// The values by orbit: at first those of the full neighbourhood.
    pub values: BTreeMap<Orbit, PairOf<F>>,
    /// The scheme's rules.
    pub row: Box<RowOf<'r, F>>,
}

/// A chain of old points longer than this means that a value depends on itself outside the neighbourhood.
const LONGEST_CHAIN: usize = 64;

impl<F: Signed> EnclosedNet<'_, F> {
    fn value(&mut self, label: Label, depth: usize) -> Result<PairOf<F>, Obstacle> {
        if self.patch.centre() == Some(label) {
            return Ok((F::whole(0), F::whole(0)));
        }
        let own = match self.values.get(&label.orbit()) {
            Some(own) => own.clone(),
            None => self.made(label.orbit(), depth)?,
        };
        let (sector, n) = (i64::from(label.sector), i64::from(self.patch.valence));
        Ok(turned(own, if 2 * sector > n { sector - n } else { sector }, &self.c)?)
    }

    fn made(&mut self, orbit: Orbit, depth: usize) -> Result<PairOf<F>, Obstacle> {
        if depth > LONGEST_CHAIN {
            return Err(Obstacle::Limit("a value of the net depends on itself".to_string()));
        }
        let (a, b) = self.image(orbit, depth)?;
        let value = (a.over(&self.lambda)?, b.over(&self.lambda)?);
        self.values.insert(orbit, value.clone());
        Ok(value)
    }

    fn image(&mut self, orbit: Orbit, depth: usize) -> Result<PairOf<F>, Obstacle> {
        let mut sum = (F::whole(0), F::whole(0));
        for (old, weight) in (self.row)(orbit)? {
            let (a, b) = self.value(old, depth + 1)?;
            sum = (sum.0.plus(&a.times(&weight)?)?, sum.1.plus(&b.times(&weight)?)?);
        }
        Ok(sum)
    }

    /// S f - lambda f at every orbit that has a value: enclosures of 0.
    ///
    /// # Errors
    /// As [`ControlNet::at`].
    pub fn residuals(&mut self) -> Result<Vec<PairOf<F>>, Obstacle> {
        let mut residuals = Vec::new();
        for (orbit, (a, b)) in self.values.clone() {
            let image = self.image(orbit, 0)?;
            residuals.push((image.0.minus(&a.times(&self.lambda)?)?, image.1.minus(&b.times(&self.lambda)?)?));
        }
        Ok(residuals)
    }

    /// Whether S f = lambda f may hold at every orbit that has a value.
    ///
    /// # Errors
    /// As [`ControlNet::at`].
    pub fn may_satisfy_its_equation(&mut self) -> Result<bool, Obstacle> {
        let may_be_zero = |value: &F| value.sign().is_none_or(Ordering::is_eq);
        Ok(self.residuals()?.iter().all(|(a, b)| may_be_zero(a) && may_be_zero(b)))
    }

    /// The part of a value along the sector's axis, up to a positive factor: a + b between spokes, a + b c where the
    /// axis is that of a corner.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn along_axis(&self, (a, b): &PairOf<F>) -> Result<F, Obstacle> {
        if self.patch.lattice.has_centre() { Ok(a.plus(b)?) } else { Ok(a.plus(&b.times(&self.c)?)?) }
    }
}

impl<F: Signed> ControlNet for EnclosedNet<'_, F> {
    type Value = F;

    fn at(&mut self, i: i32, j: i32) -> Result<PairOf<F>, Obstacle> {
        let label = self.patch.point(0, i, j);
        self.value(label, 0)
    }
}
