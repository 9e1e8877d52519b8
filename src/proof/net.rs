//! What is the net of the characteristic map, for every valence at once?
//!
//! A value of frequency 1 is a + b w with w = exp(2 pi i/n), kept as (a, b); with w^2 = 2 c w - 1 a turn by a sector is
//! (a, b) -> (-b, a + 2 c b). No sine stands in it, so that n enters through c = cos(2 pi/n) alone, and c = 1, the limit of large n, is no
//! special value. Since a + b w has the real coordinates a + b c and b sin(2 pi/n), the determinant of two pairs has the sign of that of the points.

use super::jacobian::{ControlNet, PairOf};
use super::positive::{Interval, is_positive};
use crate::analysis::exact::block::{Block, Unknown, Wave};
use crate::analysis::exact::formulas::{AllValences, GENERIC};
use crate::analysis::exact::rows::Rows;
use crate::analysis::neighbourhood::Orbit;
use crate::mesh::{Label, Lattice, Patch};
use crate::numbers::linear::{null_space, part, shifted};
use crate::numbers::{C, Field, Free, FreeWorld, N, PerFrequency, Quotient, Trouble, Univariate};
use crate::refine::{Count, ExactWeights, Obstacle, Refinement};
use crate::scheme::Scheme;
use dashu_base::{Gcd, UnsignedAbs};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// A rational function of the parameter p.
pub type Function = Quotient<RBig>;

/// A value a + b w.
pub type Pair = PairOf<Function>;

/// How c and lambda depend on the parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// c = cos(2 pi/n).
    pub c: Function,
    /// The subdominant eigenvalue.
    pub lambda: Function,
}

/// The net, as far as it has been asked for.
pub struct Net<'a> {
    /// The parametrisation that it is made for.
    pub course: Course,
    patch: Patch,
    refinement: Refinement<'a, PerFrequency<Free>>,
    values: BTreeMap<Orbit, Pair>,
}

/// The world of n and c; parameters have their values.
static WORLD: FreeWorld = FreeWorld { parameters: Vec::new() };

/// A chain of old points longer than this means that a value depends on itself outside the neighbourhood.
const LONGEST_CHAIN: usize = 64;

impl<'a> Net<'a> {
    /// The net of a scheme; `forms` are what holds for all valences.
    ///
    /// # Errors
    /// When a weight of frequency 1 depends on n in other ways than through c, lambda has not just one eigenvector there, or a limit of size is passed.
    pub fn of(scheme: &'a Scheme, lattice: Lattice, forms: &AllValences, course: Course) -> Result<Net<'a>, Obstacle> {
        let count = Count::Free { n: Free::variable(N), like: GENERIC };
        let weights = ExactWeights::new(&WORLD, count, GENERIC, Rc::new(Cell::new(0)));
        let refinement = Refinement::weighed(scheme, weights);
        let values = eigenvector(forms, &course)?;
        Ok(Net { course, patch: Patch::new(lattice, GENERIC), refinement, values })
    }

    /// The value at (i, j) in the coordinates of sector 0, which may reach into the sectors beside it.
    ///
    /// # Errors
    /// As [`Net::of`].
    pub fn at(&mut self, i: i32, j: i32) -> Result<Pair, Obstacle> {
        self.value(self.patch.point(0, i, j), 0)
    }

    /// The values that have been asked for, by orbit.
    pub fn values(&self) -> &BTreeMap<Orbit, Pair> {
        &self.values
    }

    fn value(&mut self, label: Label, depth: usize) -> Result<Pair, Obstacle> {
        if self.patch.centre() == Some(label) {
            return Ok((Function::whole(0), Function::whole(0)));
        }
        let own = match self.values.get(&label.orbit()) {
            Some(own) => own.clone(),
            None => self.made(label.orbit(), depth)?,
        };
        Ok(turned(own, sectors(label), &self.course.c)?)
    }

    /// f = (S f)/lambda.
    fn made(&mut self, orbit: Orbit, depth: usize) -> Result<Pair, Obstacle> {
        if depth > LONGEST_CHAIN {
            return Err(Obstacle::Limit("a value of the net depends on itself".to_string()));
        }
        let (a, b) = self.image(orbit, depth)?;
        let value = (a.over(&self.course.lambda)?, b.over(&self.course.lambda)?);
        self.values.insert(orbit, value.clone());
        Ok(value)
    }

    /// S f at an orbit's point in sector 0, from the scheme's own rules.
    fn image(&mut self, (i, j): Orbit, depth: usize) -> Result<Pair, Obstacle> {
        let mut sum = (Function::whole(0), Function::whole(0));
        for (old, weight) in self.row(Label { sector: 0, i, j })? {
            let weight = in_parameter(&weight, &self.course.c)?;
            let (a, b) = self.value(old, depth + 1)?;
            sum = (sum.0.plus(&a.times(&weight)?)?, sum.1.plus(&b.times(&weight)?)?);
        }
        Ok(sum)
    }

    /// Whether S f = lambda f holds at every orbit that has a value.
    ///
    /// # Errors
    /// As [`Net::of`].
    pub fn satisfies_its_equation(&mut self) -> Result<bool, Obstacle> {
        for (orbit, (a, b)) in self.values.clone() {
            let (image_a, image_b) = self.image(orbit, 0)?;
            let lambda = &self.course.lambda;
            if image_a != a.times(lambda)? || image_b != b.times(lambda)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The row of a new point at frequency 1.
    ///
    /// # Errors
    /// As [`Net::of`].
    pub fn row(&self, label: Label) -> Result<Vec<(Label, Free)>, Obstacle> {
        let row = self.refinement.row(&self.patch, label)?;
        Ok(row.into_iter().map(|(old, weight)| (old, weight.value(Some(1)).clone())).collect())
    }

    /// Whether the values, c and lambda have no pole in an interval.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn has_no_pole(&self, on: &Interval) -> Result<bool, Trouble> {
        let values = self.values.values().flat_map(|(a, b)| [a, b]).chain([&self.course.c, &self.course.lambda]);
        for value in values {
            let below = value.denominator();
            if !is_positive(&below.times(below)?, on) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Puts another value in place of one, for tests of what is refused.
    pub fn replace(&mut self, orbit: Orbit, value: Pair) {
        self.values.insert(orbit, value);
    }
}

impl ControlNet for Net<'_> {
    type Value = Function;

    fn at(&mut self, i: i32, j: i32) -> Result<Pair, Obstacle> {
        Net::at(self, i, j)
    }
}

fn sectors(label: Label) -> i64 {
    let (sector, n) = (i64::from(label.sector), GENERIC as i64);
    if 2 * sector > n { sector - n } else { sector }
}

/// A value times a power of w.
///
/// # Errors
/// When a limit of size is passed.
pub fn turned<F: Field>((mut a, mut b): PairOf<F>, by: i64, c: &F) -> Result<PairOf<F>, Trouble> {
    let twice = c.times(&F::whole(2))?;
    for _ in 0..by.abs() {
        (a, b) = match by > 0 {
            true => (b.negated(), a.plus(&twice.times(&b)?)?),
            false => (twice.times(&a)?.plus(&b)?, a.negated()),
        };
    }
    Ok((a, b))
}

/// A function whose products with all of these are polynomials with whole coefficients and without a common factor, and which is positive at a
/// parameter.
///
/// # Errors
/// When a limit of size is passed, or the parameter is a zero or a pole.
pub fn polynomial_scale<'f, I>(functions: impl Fn() -> I, at: &RBig) -> Result<Function, Trouble>
where
    I: Iterator<Item = &'f Function>,
{
    let (mut above, mut below) = (Univariate::constant(RBig::ONE), Univariate::new(vec![]));
    for own in functions() {
        if !above.divided(own.denominator())?.1.is_zero() {
            let common = above.gcd(own.denominator())?;
            above = above.times(&own.denominator().divided(&common)?.0)?;
        }
        if below.degree() != Some(0) && !own.numerator().is_zero() {
            below = below.gcd(own.numerator())?;
        }
    }
    let scale = Function::of(above, below)?;
    let scaled: Vec<Function> = functions().map(|own| own.times(&scale)).collect::<Result<_, _>>()?;
    let (numerators, denominators) = content(&scaled)?;
    let sign = scale.evaluate(at, RBig::clone)?.signum();
    scale.times(&Function::rational(&(sign * RBig::from(denominators) / RBig::from(numerators))))
}

/// The greatest common divisor of all coefficients' numerators, the least common multiple of their denominators.
///
/// # Errors
/// When all are 0.
pub fn content<'f>(functions: impl IntoIterator<Item = &'f Function>) -> Result<(IBig, IBig), Trouble> {
    let (mut numerators, mut denominators) = (UBig::ZERO, UBig::ONE);
    for value in functions.into_iter().flat_map(|own| own.numerator().coefficients()) {
        let above = value.numerator().unsigned_abs();
        numerators = if numerators.is_zero() { above } else { numerators.gcd(above) };
        denominators = &denominators / (&denominators).gcd(value.denominator()) * value.denominator();
    }
    if numerators.is_zero() { Err(Trouble::DivisionByZero) } else { Ok((numerators.into(), denominators.into())) }
}

/// A weight as a function of p.
fn in_parameter(weight: &Free, c: &Function) -> Result<Function, Trouble> {
    if (0..6).any(|index| index != C && weight.mentions(index)) {
        return Err(Trouble::BeyondThisWorld("a weight of frequency 1 depends on n or a parameter"));
    }
    let mut values = vec![Function::whole(0); 6];
    values[C] = c.clone();
    weight.evaluate(&values)
}

/// The values on the full neighbourhood: the one vector v with B_1 v = lambda v, scaled so that the first one that is not 0 is a positive number.
fn eigenvector(forms: &AllValences, course: &Course) -> Result<BTreeMap<Orbit, Pair>, Trouble> {
    let block = Block::of(&forms.rows, Some(1), Wave::Cosine(Free::variable(C)))?;
    let entry = |value: &Free| in_parameter(value, &course.c);
    let matrix: Vec<Vec<Function>> =
        block.matrix.iter().map(|row| row.iter().map(entry).collect()).collect::<Result<_, _>>()?;
    let all: Vec<usize> = (0..matrix.len()).collect();
    let kernel = null_space(&shifted(&part(&matrix, &all), &course.lambda)?)?;
    let [vector] = &kernel[..] else {
        return Err(Trouble::BeyondThisWorld("the subdominant eigenvalue has not just one vector of frequency 1"));
    };
    let zero = Trouble::BeyondThisWorld("the vector is zero");
    let scale = vector.iter().find(|value| !value.is_certainly_zero()).ok_or(zero)?;
    let scaled: Vec<Function> = vector.iter().map(|value| value.over(scale)).collect::<Result<_, _>>()?;
    placed(&block.unknowns, &scaled, &forms.rows, &course.c)
}

/// The values of the orbits, from those of the unknowns of the block of frequency 1.
///
/// # Errors
/// When a limit of size is passed.
pub fn placed<F: Field, G>(
    unknowns: &[Unknown],
    vector: &[F],
    rows: &Rows<G>,
    c: &F,
) -> Result<BTreeMap<Orbit, PairOf<F>>, Trouble> {
    let nothing = F::whole(0);
    let mut values = BTreeMap::new();
    for (index, unknown) in unknowns.iter().enumerate() {
        let own = vector[index].clone();
        match *unknown {
            Unknown::Own(t) => {
                let shift = rows.mirrors[t].1;
                let start = if shift % 2 == 0 { (own, nothing.clone()) } else { (own.clone(), own) };
                values.insert(rows.orbits[t], turned(start, shift.div_euclid(2), c)?);
            }
            Unknown::First(t, u) => {
                let (shift, next) = (rows.mirrors[t].1, vector[index + 1].clone());
                // the conjugate of a + b w is a + b/w = (a + 2 c b) - b w
                let other = own.plus(&c.times(&F::whole(2))?.times(&next)?)?;
                let image = turned((other, next.negated()), shift, c)?;
                values.insert(rows.orbits[t], (own, next));
                values.insert(rows.orbits[u], image);
            }
            _ => {}
        }
    }
    Ok(values)
}
