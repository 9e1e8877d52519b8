//! Are the integer shifts of the basic limit function stable?
//!
//! They are unless their Fourier transforms have a common zero t. For such a t every (t + 2 pi j)/a is another one, or a zero of the symbol.
//! So the shifts are stable exactly if (1) the polynomials of the submasks have no common zero on the unit circle, and (2) no cycle
//! w, w^a, w^(a^2), ... of roots of unity other than 1 has all the zeros r w' with r^a = 1, r not 1, w' in the cycle (Jia and Wang 1993 for a = 2).
//! The symbol is rational, so (2) is about roots of unity of one order m at a time: the cyclotomic polynomials of m d divide it for all d > 1
//! that divide a.

use crate::numbers::roots::Root;
use crate::numbers::{Enclosure, Field, Trouble, Univariate, real_root};
use crate::scheme::curve::Mask;
use dashu_ratio::RBig;
use std::cmp::Ordering;

const BITS: usize = 256;
/// Symbols of a higher degree are not looked at.
const MAX_DEGREE: usize = 60;

/// What is known of the shifts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// They are stable.
    Stable,
    /// They are not: the zeros that are common to all submasks, or those at roots of unity, are in the way.
    Unstable(&'static str),
    /// That isn't decided here.
    Undecided(&'static str),
}

/// Whether the shifts of the basic limit function of a mask whose submasks sum to 1 are stable.
///
/// # Errors
/// When numbers pass a limit.
pub fn stability(mask: &Mask) -> Result<Stability, Trouble> {
    if mask.coefficients.len() > MAX_DEGREE + 1 {
        return Ok(Stability::Undecided("the symbol's degree is too high to decide whether the shifts are stable"));
    }
    match common_zero_on_circle(mask)? {
        None => return Ok(Stability::Undecided("the submasks have common zeros on or very near the unit circle")),
        Some(true) => return Ok(Stability::Unstable("the submasks have a common zero on the unit circle")),
        Some(false) => {}
    }
    let cycle = has_cycle(mask)?;
    Ok(if cycle { Stability::Unstable("the symbol has a cycle of zeros at roots of unity") } else { Stability::Stable })
}

/// Whether the polynomials of the submasks have a common zero of modulus 1; `None` where enclosures don't tell.
fn common_zero_on_circle(mask: &Mask) -> Result<Option<bool>, Trouble> {
    let submask =
        |r: usize| Univariate::new(mask.coefficients.iter().skip(r).step_by(mask.arity as usize).cloned().collect());
    let mut common = submask(0);
    for r in 1..mask.arity as usize {
        common = common.gcd(&submask(r))?;
    }
    for sign in [1, -1] {
        if common.evaluate(&RBig::from(sign))?.is_zero() {
            return Ok(Some(true));
        }
    }
    if common.degree().is_none_or(|degree| degree == 0) {
        return Ok(Some(false));
    }
    // a zero on the circle is a zero of the reversed polynomial as well
    let reversed = Univariate::new(common.coefficients().iter().rev().cloned().collect());
    let both = common.gcd(&reversed)?;
    let parts = both.squarefree()?;
    for (part, _) in parts {
        for root in real_root::roots_of::<RBig, BITS>(&part, &|value| Ok(Enclosure::rational(value)))? {
            if !is_off_circle(&root)? {
                return Ok(None);
            }
        }
    }
    Ok(Some(false))
}

fn is_off_circle(root: &Root<BITS>) -> Result<bool, Trouble> {
    Ok(root.modulus_squared()?.compare(&Enclosure::whole(1)).is_some_and(Ordering::is_ne))
}

/// Whether for some order m > 1, prime to the arity, the cyclotomic polynomials of m d divide the symbol for all d > 1 that divide the arity.
fn has_cycle(mask: &Mask) -> Result<bool, Trouble> {
    let (a, symbol) = (mask.arity as usize, Univariate::new(mask.coefficients.clone()));
    let degree = mask.coefficients.len().saturating_sub(1);
    let divisors: Vec<usize> = (2..=a).filter(|d| a.is_multiple_of(*d)).collect();
    // Euler's function of m is at least the root of m/2
    for m in (2..=2 * degree * degree).filter(|m| greatest_common(*m, a) == 1 && totient(*m) <= degree) {
        let mut all = divisors.iter().all(|d| totient(m * d) <= degree);
        for d in &divisors {
            all = all && symbol.divided(&cyclotomic(m * d)?)?.1.is_zero();
        }
        if all {
            return Ok(true);
        }
    }
    Ok(false)
}

fn greatest_common(a: usize, b: usize) -> usize {
    if b == 0 { a } else { greatest_common(b, a % b) }
}

/// Euler's function.
fn totient(n: usize) -> usize {
    let (mut rest, mut value) = (n, n);
    for p in (2..).take_while(|p| p * p <= n) {
        if rest.is_multiple_of(p) {
            value -= value / p;
        }
        while rest.is_multiple_of(p) {
            rest /= p;
        }
    }
    if rest > 1 { value - value / rest } else { value }
}

/// The polynomial of the primitive roots of unity of order n.
fn cyclotomic(n: usize) -> Result<Univariate<RBig>, Trouble> {
    let power = |n: usize| {
        let entry = |i| RBig::from(if i == 0 { -1 } else { i64::from(i == n) });
        Univariate::new((0..=n).map(entry).collect())
    };
    let mut found = power(n);
    for d in (1..n).filter(|d| n.is_multiple_of(*d)) {
        found = found.divided(&found.gcd(&power(d))?)?.0;
    }
    found.monic()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(arity: u32, over: i64, weights: &[i64]) -> Mask {
        Mask::new(0, arity, weights.iter().map(|w| RBig::from(*w) / RBig::from(over)).collect())
    }

    #[test]
    fn cyclotomic_polynomials_are_known() {
        let ints =
            |n| cyclotomic(n).unwrap().coefficients().iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
        assert_eq!((ints(6).as_str(), ints(12).as_str(), ints(1).as_str()), ("1 -1 1", "1 0 -1 0 1", "-1 1"));
        assert_eq!([1, 2, 6, 9, 12, 105].map(totient), [1, 1, 2, 6, 4, 48]);
    }

    /// The box of width 3 satisfies a refinement equation with symbol 1 + z^3; its shifts sum with coefficients of period 3 to zero (Jia and
    /// Wang 1993 name it).
    #[test]
    fn a_box_of_width_three_has_no_stable_shifts() {
        assert_eq!(stability(&mask(2, 1, &[1, 1])).unwrap(), Stability::Stable);
        assert!(matches!(stability(&mask(2, 1, &[1, 0, 0, 1])).unwrap(), Stability::Unstable(_)));
        assert!(matches!(stability(&mask(3, 1, &[1, 0, 1, 0, 1])).unwrap(), Stability::Unstable(_)));
        assert_eq!(stability(&mask(3, 9, &[1, 3, 6, 7, 6, 3, 1])).unwrap(), Stability::Stable);
        // (1 + z)(1 + z^2)/2: the submasks are both (1 + z)/2
        assert!(matches!(stability(&mask(2, 2, &[1, 1, 1, 1])).unwrap(), Stability::Unstable(_)));
        assert_eq!(stability(&mask(2, 4, &[1, 3, 3, 1])).unwrap(), Stability::Stable);
    }
}
