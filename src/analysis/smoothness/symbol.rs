//! Which polynomials does a mask make and keep, and what is left of it when all its factors are taken out?
//!
//! a(z) = sigma(z)^k b(z) with sigma(z) = 1 + z + ... + z^(m-1), m the arity: b is the mask of differences of order k, and polynomials
//! of degree k - 1 are made by a convergent scheme. Reproduction with parameter shift tau = a'(1)/m as in Conti and Hormann, "Polynomial
//! reproduction for univariate subdivision schemes of any arity" (2011).

use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// A mask and its difference masks.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// The arity m.
    pub arity: usize,
    /// The masks of differences of order 0, 1, ..., k, from index 0 on; the last has no further factor.
    pub differences: Vec<Vec<RBig>>,
}

impl Symbol {
    /// Takes out sigma(z) as often as it divides.
    pub fn of(mask: &Mask) -> Symbol {
        let arity = mask.arity as usize;
        let mut differences = vec![mask.coefficients.clone()];
        while let Some(next) = differences.last().and_then(|last| without_factor(last, arity)) {
            differences.push(next);
        }
        Symbol { arity, differences }
    }

    /// How often sigma(z) divides.
    pub fn factors(&self) -> usize {
        self.differences.len() - 1
    }

    /// The mask of differences of the highest order.
    pub fn kernel(&self) -> &[RBig] {
        &self.differences[self.factors()]
    }
}

/// The quotient by 1 + z + ... + z^(m-1), where there is no remainder.
fn without_factor(mask: &[RBig], arity: usize) -> Option<Vec<RBig>> {
    let length = (mask.len() + 1).checked_sub(arity).filter(|length| *length > 0)?;
    let mut rest = mask.to_vec();
    let mut quotient = Vec::with_capacity(length);
    for start in 0..length {
        let value = rest[start].clone();
        rest[start..start + arity].iter_mut().for_each(|slot| *slot -= &value);
        quotient.push(value);
    }
    rest.iter().all(RBig::is_zero).then_some(quotient)
}

/// The parameter shift tau = a'(1)/m.
pub fn shift(mask: &Mask) -> RBig {
    mask.terms().map(|(i, value)| RBig::from(i) * value).fold(RBig::ZERO, |sum, term| sum + term)
        / RBig::from(mask.arity)
}

/// The degree up to which polynomials come back, at most `most`: a^(k)(1) = m tau (tau - 1) ... (tau - k + 1).
pub fn reproduction_degree(mask: &Mask, most: usize) -> usize {
    let tau = shift(mask);
    let derivative = |k: i64| {
        let terms = mask.terms().map(|(i, value)| (0..k).fold(value.clone(), |product, l| product * RBig::from(i - l)));
        terms.fold(RBig::ZERO, |sum, term| sum + term)
    };
    let due = |k: i64| (0..k).fold(RBig::from(mask.arity), |product, l| product * (&tau - RBig::from(l)));
    (1..=most).take_while(|k| derivative(*k as i64) == due(*k as i64)).count()
}
