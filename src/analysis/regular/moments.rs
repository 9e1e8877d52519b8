//! Which polynomials does a mask generate, and which does it reproduce?
//!
//! With the moments of each coset of the mask about a point s, m(coset, q) = sum over its gamma of a(gamma) q(gamma - s):
//!
//! - *sum rules of order k*: m(coset, q) is the same for all cosets and every polynomial q of degree below k. Then a step maps polynomials of
//!   degree below k to such; a convergent scheme generates them (Jia 1998). This does not depend on s.
//! - *reproduction of degree d*: data p(beta + tau) become p(M^-1 (alpha + tau)), for all p of degree d at most. By Taylor's formula this is
//!   m(coset, q) = q(0) for all q of degree d at most, with s = (M - I) tau. (Conti and Hormann 2011 for curves, Charina, Conti and Romani 2014
//!   for surfaces.) For degree 1, s must be the mean of every coset: the mask's first moments fix the shift tau.

use super::mask::{Mask, Point};
use crate::numbers::{Field, Free, Trouble};

/// What the moments of a mask say.
#[derive(Clone, Debug, PartialEq)]
pub struct Moments {
    /// The largest order of sum rules; 0 where cosets differ in their sums.
    pub sum_rules: usize,
    /// The largest degree of polynomials that are reproduced; `None` where constants are not.
    pub reproduction: Option<usize>,
    /// The parameter shift tau: the point beta of the lattice stands for the parameter beta + tau.
    pub shift: [Free; 2],
}

/// The sums over each coset of a(gamma) q(gamma - s), for the monomials q of a degree.
fn of_degree(mask: &Mask, s: &[Free; 2], degree: usize) -> Result<Vec<Vec<Free>>, Trouble> {
    mask.dilation.cosets().into_iter().map(|coset| of_coset(mask, coset, s, degree)).collect()
}

fn of_coset(mask: &Mask, coset: Point, s: &[Free; 2], degree: usize) -> Result<Vec<Free>, Trouble> {
    let mut moments = vec![Free::whole(0); degree + 1];
    for (gamma, weight) in mask.on_coset(coset) {
        let x = Free::whole(gamma[0].into()).minus(&s[0])?;
        let y = Free::whole(gamma[1].into()).minus(&s[1])?;
        let (xs, ys) = (powers(&x, degree)?, powers(&y, degree)?);
        for (i, moment) in moments.iter_mut().enumerate() {
            *moment = moment.plus(&weight.times(&xs[degree - i])?.times(&ys[i])?)?;
        }
    }
    Ok(moments)
}

fn powers(x: &Free, degree: usize) -> Result<Vec<Free>, Trouble> {
    let mut powers = vec![Free::whole(1)];
    for i in 0..degree {
        powers.push(powers[i].times(x)?);
    }
    Ok(powers)
}

/// The mean of the whole mask: its first moments over |det M|.
fn mean(mask: &Mask) -> Result<[Free; 2], Trouble> {
    let zero = [Free::whole(0), Free::whole(0)];
    let det = Free::whole(mask.dilation.determinant().abs().into());
    let mut sums = zero.clone();
    for coset in of_degree(mask, &zero, 1)? {
        for (sum, part) in sums.iter_mut().zip(&coset) {
            *sum = sum.plus(part)?;
        }
    }
    let [x, y] = sums;
    Ok([x.over(&det)?, y.over(&det)?])
}

/// The differences of the moments of other cosets from those of the first, for the monomials of a degree.
pub(super) fn apart(mask: &Mask, degree: usize) -> Result<Vec<Free>, Trouble> {
    let moments = of_degree(mask, &mean(mask)?, degree)?;
    let Some((first, others)) = moments.split_first() else { return Ok(vec![]) };
    others.iter().flat_map(|own| own.iter().zip(first)).map(|(a, b)| a.minus(b)).collect()
}

/// tau = (M - I)^-1 s.
fn shift(mask: &Mask, [x, y]: &[Free; 2]) -> Result<[Free; 2], Trouble> {
    let [[a, b], [c, d]] = mask.dilation.rows().map(|row| row.map(i64::from));
    let (a, d) = (a - 1, d - 1);
    let det = Free::whole(a * d - b * c);
    let combined = |p: i64, q: i64| x.times(&Free::whole(p))?.plus(&y.times(&Free::whole(q))?)?.over(&det);
    Ok([combined(d, -b)?, combined(-c, a)?])
}

impl Moments {
    /// The moments of a mask.
    ///
    /// # Errors
    /// When 1 is an eigenvalue of M, or the numbers pass a limit of size.
    pub fn of(mask: &Mask) -> Result<Moments, Trouble> {
        let s = mean(mask)?;
        let one = |q: &[Free]| q.iter().all(|value| *value == Free::whole(1));
        let (mut sum_rules, mut reproduction) = (0, None);
        // a mask with c coefficients on a coset can't have the moments of another on all degrees up to c, unless it is no mask
        for degree in 0..=mask.coefficients.len() {
            let moments = of_degree(mask, &s, degree)?;
            if moments.windows(2).any(|pair| pair[0] != pair[1]) {
                break;
            }
            sum_rules = degree + 1;
            let Some(first) = moments.first() else { break };
            let reproduced = if degree == 0 { one(first) } else { first.iter().all(Field::is_certainly_zero) };
            if reproduced && (degree == 0 || reproduction == Some(degree - 1)) {
                reproduction = Some(degree);
            }
        }
        Ok(Moments { sum_rules, reproduction, shift: shift(mask, &s)? })
    }
}
