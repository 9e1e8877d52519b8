//! How are the differences of neighbouring points refined?
//!
//! By the mask b with b(z) = a(z) z^{a-1}/(1 + z + ... + z^{a-1}), where the sum rule holds: D S_a = S_b D with (D p)_j = p_{j+1} - p_j
//! (Dyn and Levin 2002, section 4).

use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// The mask of differences; `None` where the sums of the submasks differ.
pub fn difference(mask: &Mask) -> Option<Mask> {
    let arity = mask.arity as usize;
    let sums = mask.coset_sums();
    if mask.coefficients.len() < arity || sums.iter().any(|sum| *sum != sums[0]) {
        return None;
    }
    let size = mask.coefficients.len() - (arity - 1);
    let mut quotient: Vec<RBig> = Vec::with_capacity(size);
    for index in 0..size {
        let before = &quotient[index.saturating_sub(arity - 1)..];
        let value = before.iter().fold(mask.coefficients[index].clone(), |rest, value| rest - value);
        quotient.push(value);
    }
    Some(Mask::new(mask.first + arity as i64 - 1, mask.arity, quotient))
}

/// How often differences can be taken: the number of factors 1 + z + ... + z^{a-1} of the symbol, which is the number of sum rules.
pub fn sum_rules(mask: &Mask) -> usize {
    std::iter::successors(Some(mask.clone()), difference).take(mask.coefficients.len() + 1).count() - 1
}
