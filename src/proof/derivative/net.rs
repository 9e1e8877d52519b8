//! What is the net of the characteristic map at one valence, enclosed?
//!
//! The values a + b w of [`crate::proof::net`], at a number n: c and lambda are enclosed with many bits. On the full
//! neighbourhood they are the one vector with B_1 v = lambda v, by elimination; all others follow from f = (S
//! f)/lambda.

use crate::analysis::exact::block::{Block, Unknown, Wave};
use crate::analysis::exact::rows::Rows;
use crate::analysis::exact::{ExactAnalysis, Value};
use crate::analysis::neighbourhood::Orbit;
use crate::mesh::{Label, Lattice, Patch};
use crate::numbers::linear::{Matrix, part, shifted};
use crate::numbers::{Angle, EnclosedWorld, Field, Interval, PerFrequency, Trouble, World};
use crate::refine::{Count, EnclosedWeights, ExactWeights, Obstacle, Refinement};
use crate::scheme::Scheme;
use dashu_ratio::RBig;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// A value a + b w, enclosed.
pub type Pair = (Value, Value);

/// The net, as far as it has been asked for.
pub struct Net<'a> {
    /// cos(2 pi/n).
    pub c: Value,
    /// The eigenvalue.
    pub lambda: Value,
    patch: Patch,
    refinement: Refinement<'a, PerFrequency<Value>>,
    values: BTreeMap<Orbit, Pair>,
}

static WORLD: EnclosedWorld<{ crate::analysis::exact::BITS }> = EnclosedWorld;

/// A chain of old points longer than this means that a value depends on itself outside the neighbourhood.
const LONGEST_CHAIN: usize = 64;

impl<'a> Net<'a> {
    /// The net of a scheme with numbers for its parameters, for the subdominant eigenvalue that its exact analysis
    /// found at n; else why there is none.
    ///
    /// # Errors
    /// When a weight has no value, or lambda is not seen to have just one vector of frequency 1.
    pub fn of(
        scheme: &'a Scheme,
        lattice: Lattice,
        n: usize,
        analysis: &ExactAnalysis,
    ) -> Result<Result<Net<'a>, String>, Obstacle> {
        let Some(lambda) = analysis.lambda else {
            return Ok(Err("the subdominant eigenvalue is not known to be positive, of frequency 1 and simple".into()));
        };
        let lambda = analysis.eigenvalues[lambda].re.clone();
        let below_one = Value::whole(1).minus(&lambda)?;
        if [&lambda, &below_one].iter().any(|own| own.sign() != Some(std::cmp::Ordering::Greater)) {
            return Ok(Err("the subdominant eigenvalue is not seen to be between 0 and 1".into()));
        }
        let patch = Patch::new(lattice, n);
        // at the regular valence every place looks like the centre: no ring is summed
        let centre = if n == scheme.regular_valence() { usize::MAX } else { n };
        let weights = ExactWeights::new(&WORLD, Count::Number, centre, Rc::new(Cell::new(0)));
        let mut refinement = Refinement::weighed(scheme, weights);
        let rows = match Rows::of(&refinement, patch, &analysis.orbits) {
            Err(Obstacle::Inexact(_)) => {
                refinement = Refinement::weighed(scheme, EnclosedWeights);
                Rows::of(&refinement, patch, &analysis.orbits)?
            }
            rows => rows?,
        };
        let c = WORLD.cos(&Angle::fixed(RBig::ONE / RBig::from(n)))?;
        let values = eigenvector(&rows, &c, &lambda)?;
        Ok(Ok(Net { c, lambda, patch, refinement, values }))
    }

    /// The value at (i, j) in the coordinates of sector 0, which may reach into the sectors beside it.
    ///
    /// # Errors
    /// As [`Net::of`].
    pub fn at(&mut self, i: i32, j: i32) -> Result<Pair, Obstacle> {
        self.value(self.patch.point(0, i, j), 0)
    }

    /// The same as intervals of floating-point numbers.
    ///
    /// # Errors
    /// As [`Net::of`].
    pub fn interval_at(&mut self, i: i32, j: i32) -> Result<[Interval; 2], Obstacle> {
        let (a, b) = self.at(i, j)?;
        Ok([Interval::enclosing(&a), Interval::enclosing(&b)])
    }

    /// The values that have been asked for, by orbit.
    pub fn values(&self) -> &BTreeMap<Orbit, Pair> {
        &self.values
    }

    /// Puts another value in place of one, for tests of what is refused.
    pub fn replace(&mut self, orbit: Orbit, value: Pair) {
        self.values.insert(orbit, value);
    }

    /// Whether S f = lambda f may hold at every orbit that has a value: enclosures of both sides meet.
    ///
    /// # Errors
    /// As [`Net::of`].
    pub fn may_satisfy_its_equation(&mut self) -> Result<bool, Obstacle> {
        for (orbit, (a, b)) in self.values.clone() {
            let (image_a, image_b) = self.image(orbit, 0)?;
            if !image_a.overlaps(&a.times(&self.lambda)?) || !image_b.overlaps(&b.times(&self.lambda)?) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn value(&mut self, label: Label, depth: usize) -> Result<Pair, Obstacle> {
        if self.patch.centre() == Some(label) {
            return Ok((Value::whole(0), Value::whole(0)));
        }
        let own = match self.values.get(&label.orbit()) {
            Some(own) => own.clone(),
            None => {
                if depth > LONGEST_CHAIN {
                    return Err(Obstacle::Limit("a value of the net depends on itself".to_string()));
                }
                let (a, b) = self.image(label.orbit(), depth)?;
                let own = (a.over(&self.lambda)?, b.over(&self.lambda)?);
                self.values.insert(label.orbit(), own.clone());
                own
            }
        };
        let (sector, n) = (i64::from(label.sector), i64::from(self.patch.valence));
        Ok(turned(own, if 2 * sector > n { sector - n } else { sector }, &self.c)?)
    }

    /// S f at an orbit's point in sector 0, from the scheme's own rules.
    fn image(&mut self, (i, j): Orbit, depth: usize) -> Result<Pair, Obstacle> {
        let mut sum = (Value::whole(0), Value::whole(0));
        for (old, weight) in self.refinement.row(&self.patch, Label { sector: 0, i, j })? {
            let (weight, (a, b)) = (weight.value(Some(1)).clone(), self.value(old, depth + 1)?);
            sum = (sum.0.plus(&a.times(&weight)?)?, sum.1.plus(&b.times(&weight)?)?);
        }
        Ok(sum)
    }
}

/// A value times a power of w: w (a + b w) = -b + (a + 2 c b) w.
fn turned((mut a, mut b): Pair, by: i64, c: &Value) -> Result<Pair, Trouble> {
    let twice = c.times(&Value::whole(2))?;
    for _ in 0..by.abs() {
        (a, b) = match by > 0 {
            true => (b.negated(), a.plus(&twice.times(&b)?)?),
            false => (twice.times(&a)?.plus(&b)?, a.negated()),
        };
    }
    Ok((a, b))
}

/// The values on the orbits, scaled so that one of them is 1 or -1.
fn eigenvector(rows: &Rows<Value>, c: &Value, lambda: &Value) -> Result<BTreeMap<Orbit, Pair>, Trouble> {
    let block = Block::of(rows, Some(1), Wave::Cosine(c.clone()))?;
    let all: Vec<usize> = (0..block.matrix.len()).collect();
    let vector = kernel(shifted(&part(&block.matrix, &all), lambda)?)?;
    let mut values = BTreeMap::new();
    for (index, unknown) in block.unknowns.iter().enumerate() {
        let own = vector[index].clone();
        match *unknown {
            Unknown::Own(t) => {
                let shift = rows.mirrors[t].1;
                let start = if shift % 2 == 0 { (own, Value::whole(0)) } else { (own.clone(), own) };
                values.insert(rows.orbits[t], turned(start, shift.div_euclid(2), c)?);
            }
            Unknown::First(t, u) => {
                let (shift, next) = (rows.mirrors[t].1, vector[index + 1].clone());
                // the conjugate of a + b w is (a + 2 c b) - b w
                let other = own.plus(&c.times(&Value::whole(2))?.times(&next)?)?;
                values.insert(rows.orbits[u], turned((other, next.negated()), shift, c)?);
                values.insert(rows.orbits[t], (own, next));
            }
            _ => {}
        }
    }
    // the sector's axis is where a + b is positive
    let first = rows.orbits.iter().filter_map(|orbit| values.get(orbit)).find_map(|(a, b)| a.plus(b).ok()?.sign());
    if first == Some(std::cmp::Ordering::Less) {
        values.values_mut().for_each(|(a, b)| (*a, *b) = (a.negated(), b.negated()));
    }
    Ok(values)
}

/// The kernel of a matrix that is known to be singular, with one entry 1. All pivots but the last are certainly not
/// 0: so the true matrix has rank m - 1, its kernel is spanned by one vector, and the equations that are left hold
/// for it.
fn kernel(mut matrix: Matrix<Value>) -> Result<Vec<Value>, Trouble> {
    let size = matrix.len();
    let mut columns: Vec<usize> = (0..size).collect();
    for step in 0..size.saturating_sub(1) {
        let places = (step..size).flat_map(|row| (step..size).map(move |at| (row, at)));
        let modulus = |row: usize, at: usize| matrix[row][columns[at]].midpoint_f64().abs();
        let best = places.max_by(|(i, s), (j, t)| modulus(*i, *s).total_cmp(&modulus(*j, *t)));
        let Some((row, at)) = best else { break };
        matrix.swap(step, row);
        columns.swap(step, at);
        let pivot = matrix[step][columns[step]].clone();
        if pivot.contains(&RBig::ZERO) {
            return Err(Trouble::BeyondThisWorld("lambda is not seen to have just one vector of frequency 1"));
        }
        let own = matrix[step].clone();
        for line in &mut matrix[step + 1..] {
            if line[columns[step]].is_certainly_zero() {
                continue;
            }
            let factor = line[columns[step]].over(&pivot)?;
            for column in &columns[step..] {
                line[*column] = line[*column].minus(&factor.times(&own[*column])?)?;
            }
        }
    }
    let mut vector = vec![Value::whole(1); size];
    for step in (0..size.saturating_sub(1)).rev() {
        let mut sum = Value::whole(0);
        for column in &columns[step + 1..] {
            sum = sum.minus(&matrix[step][*column].times(&vector[*column])?)?;
        }
        vector[columns[step]] = sum.over(&matrix[step][columns[step]])?;
    }
    Ok(vector)
}
