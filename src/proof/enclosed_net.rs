//! What is the net of the characteristic map, in enclosures?
//!
//! As in [`super::net`] a value of frequency 1 is a + b w, kept as (a, b), and outside the neighbourhood f = (S
//! f)/lambda; but c, lambda and the weights are enclosed: at one valence, or over a whole interval of c.

use super::jacobian::PairOf;
use super::net::turned;
use super::signed::Signed;
use crate::analysis::neighbourhood::Orbit;
use crate::mesh::{Label, Patch};
use crate::refine::Obstacle;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::rc::Rc;

/// The row of an orbit's new point in sector 0: old points with their weights at frequency 1.
pub type RowOf<'r, F> = dyn Fn(Orbit) -> Result<Vec<(Label, F)>, Obstacle> + 'r;

/// The net, as far as it has been asked for. The first value that is seen on one side of the sector's axis is on the
/// positive one.
pub struct EnclosedNet<'r, F> {
    /// cos(2 pi/n).
    pub c: F,
    /// The subdominant eigenvalue.
    pub lambda: F,
    patch: Patch,
    values: BTreeMap<Orbit, PairOf<F>>,
    row: Box<RowOf<'r, F>>,
    /// The rows that have been asked for.
    rows: BTreeMap<Orbit, Rc<Vec<(Label, F)>>>,
}

/// A chain of old points longer than this means that a value depends on itself outside the neighbourhood.
const LONGEST_CHAIN: usize = 64;

impl<'r, F: Signed> EnclosedNet<'r, F> {
    /// The net with these values on the full neighbourhood, or their negatives; `row` has the scheme's rules.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn new(
        patch: Patch,
        c: F,
        lambda: F,
        values: BTreeMap<Orbit, PairOf<F>>,
        row: Box<RowOf<'r, F>>,
    ) -> Result<Self, Obstacle> {
        let mut net = EnclosedNet { c, lambda, patch, values, row, rows: BTreeMap::new() };
        let sides: Vec<F> = net.values.values().map(|pair| net.along_axis(pair)).collect::<Result<_, _>>()?;
        let first = sides.iter().filter_map(F::sign).find(|side| side.is_ne());
        if first == Some(Ordering::Less) {
            net.values.values_mut().for_each(|(a, b)| (*a, *b) = (a.negated(), b.negated()));
        }
        Ok(net)
    }

    /// The value at (i, j) in the coordinates of sector 0, which may reach into the sectors beside it.
    ///
    /// # Errors
    /// When a row isn't known, or a limit of size is passed.
    pub fn at(&mut self, i: i32, j: i32) -> Result<PairOf<F>, Obstacle> {
        self.value(self.patch.point(0, i, j), 0)
    }

    /// The values that have been asked for, by orbit; at first those of the full neighbourhood.
    pub fn values(&self) -> &BTreeMap<Orbit, PairOf<F>> {
        &self.values
    }

    /// Puts another value in place of one, for tests of what is refused.
    pub fn replace(&mut self, orbit: Orbit, value: PairOf<F>) {
        self.values.insert(orbit, value);
    }

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
        let row = match self.rows.get(&orbit) {
            Some(row) => Rc::clone(row),
            None => Rc::new((self.row)(orbit)?),
        };
        for (old, weight) in row.iter() {
            let (a, b) = self.value(*old, depth + 1)?;
            sum = (sum.0.plus(&a.times(weight)?)?, sum.1.plus(&b.times(weight)?)?);
        }
        self.rows.insert(orbit, row);
        Ok(sum)
    }

    /// Whether S f = lambda f may hold at every orbit that has a value: enclosures of S f - lambda f don't exclude 0.
    ///
    /// # Errors
    /// As [`EnclosedNet::at`].
    pub fn may_satisfy_its_equation(&mut self) -> Result<bool, Obstacle> {
        let may_be_zero = |value: &F| value.sign().is_none_or(Ordering::is_eq);
        for (orbit, (a, b)) in self.values.clone() {
            let image = self.image(orbit, 0)?;
            let (a, b) = (image.0.minus(&a.times(&self.lambda)?)?, image.1.minus(&b.times(&self.lambda)?)?);
            if !may_be_zero(&a) || !may_be_zero(&b) {
                return Ok(false);
            }
        }
        Ok(true)
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
