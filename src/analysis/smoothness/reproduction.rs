//! Which polynomials come back from their samples?
//!
//! With the parameter shift tau = a'(1)/m, m the arity, those up to the degree d with a^(k)(1) = m tau (tau - 1) ... (tau - k + 1), k <= d, that the
//! scheme makes (Conti and Hormann, "Polynomial reproduction for univariate subdivision schemes of any arity", 2011).

use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

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
