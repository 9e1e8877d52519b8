//! What is the value of a formula for every valence at once?
//!
//! The free world: n, c = cos(2 pi/n), c_k = cos(2 pi k/n) and up to two parameters are indeterminates of rational functions.
//! An equality shown here holds wherever both sides are defined; cos(2 pi p/n) = T_p(c), Chebyshev's polynomial.

use super::free::Free;
use super::world::{Angle, World, rational_cosine, square_part};
use super::{Field, Trouble};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// The index of n among the indeterminates.
pub const N: usize = 0;
/// The index of c = cos(2 pi/n).
pub const C: usize = 1;
/// The index of c_k = cos(2 pi k/n).
pub const C_K: usize = 2;
/// The index of the first parameter; the second follows.
pub const FIRST_PARAMETER: usize = 3;
/// The most parameters that may be left free.
pub const MOST_PARAMETERS: usize = 2;

/// The world of all valences, with these parameters left free.
#[derive(Clone, Debug, Default)]
pub struct FreeWorld {
    /// The parameters that stand for themselves.
    pub parameters: Vec<String>,
}

const NO_FORMULA: Trouble =
    Trouble::BeyondThisWorld("closed forms for all n are made of cos(2*pi*p/n) with whole p, and of n");

/// T_p(x), Chebyshev's polynomial of the first kind: cos(p t) for x = cos(t).
///
/// # Errors
/// When it passes the field's limits.
pub fn chebyshev<F: Field>(p: usize, x: &F) -> Result<F, Trouble> {
    let (mut before, mut now) = (x.clone(), F::whole(1));
    for _ in 0..p {
        let next = now.times(x)?.times(&F::whole(2))?.minus(&before)?;
        (before, now) = (now, next);
    }
    Ok(now)
}

impl World for FreeWorld {
    type Value = Free;

    fn name(&self, name: &str) -> Result<Free, Trouble> {
        if name == "n" {
            return Ok(Free::variable(N));
        }
        let index = self.parameters.iter().position(|own| own == name);
        index.map(|index| Free::variable(FIRST_PARAMETER + index)).ok_or(Trouble::Domain("this name has no value here"))
    }

    fn cos(&self, angle: &Angle) -> Result<Free, Trouble> {
        let whole = angle.per_n.is_int() && angle.per_j.is_zero() && angle.per_jn.is_zero();
        let p = if whole { i64::try_from(angle.per_n.numerator().clone()).ok() } else { None };
        let p = p.filter(|p| p.abs() <= 64).ok_or(NO_FORMULA)?.unsigned_abs() as usize;
        let cosine = rational_cosine(&angle.constant).ok_or(NO_FORMULA)?;
        if p != 0 && &cosine * &cosine != RBig::ONE {
            return Err(NO_FORMULA);
        }
        chebyshev(p, &Free::variable(C))?.times(&Free::rational(&cosine))
    }

    fn sin(&self, angle: &Angle) -> Result<Free, Trouble> {
        let quarter = RBig::from_parts(IBig::ONE, UBig::from(4_u8));
        self.cos(&Angle { constant: &angle.constant - quarter, ..angle.clone() })
    }

    fn sqrt(&self, radicand: &Free) -> Result<Free, Trouble> {
        let irrational = Trouble::BeyondThisWorld("closed forms for all n hold no square root of a weight");
        let (square, free) = square_part(&radicand.as_rational().ok_or(irrational.clone())?)?;
        if free == 1 || square.is_zero() { Ok(Free::rational(&square)) } else { Err(irrational) }
    }
}
