//! What is left of a symbol when all factors 1 + z + ... + z^(a-1) are taken out?
//!
//! a(z) = (1 + z + ... + z^(a-1))^k b(z): k is the number of sum rules, and b the mask by which k-th differences are refined (Dyn and
//! Levin 2002, section 4). All factors must go: fewer leave eigenvalues 1/a^j that hide what b does.

use crate::analysis::curve::difference::difference;
use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// A symbol with all its factors 1 + z + ... + z^(a-1) taken out.
#[derive(Clone, Debug, PartialEq)]
pub struct Factored {
    /// How many there are: k.
    pub order: usize,
    /// What is left: the mask of k-th differences.
    pub kernel: Mask,
}

/// The mask by which m-th differences are refined; `None` where there are fewer than m sum rules.
pub fn differences(mask: &Mask, m: usize) -> Option<Mask> {
    (0..m).try_fold(mask.clone(), |mask, _| difference(&mask))
}

/// Takes out all factors; a mask of zeros has none.
pub fn factored(mask: &Mask) -> Factored {
    let (mut order, mut kernel) = (0, mask.clone());
    while let (true, Some(next)) = (!kernel.coefficients.is_empty(), difference(&kernel)) {
        (order, kernel) = (order + 1, next);
    }
    Factored { order, kernel }
}

/// The norm of L steps: the largest sum of |b_i| over i = r modulo a^L, where b is the mask of L steps.
pub fn norm(steps: &[RBig], spacing: usize) -> RBig {
    let sum = |r: usize| {
        let own = steps.iter().skip(r).step_by(spacing);
        own.fold(RBig::ZERO, |sum, value| if *value < RBig::ZERO { sum - value } else { sum + value })
    };
    (0..spacing.min(steps.len())).map(sum).max().unwrap_or(RBig::ZERO)
}

/// The coefficients of one more step: b(z) times those before with z^a for z.
pub fn one_more(before: &[RBig], mask: &Mask) -> Vec<RBig> {
    let a = mask.arity as usize;
    let Some(last) = before.len().checked_sub(1) else { return Vec::new() };
    let mut product = vec![RBig::ZERO; last * a + mask.coefficients.len()];
    for (i, x) in before.iter().enumerate().filter(|(_, x)| !x.is_zero()) {
        for (j, y) in mask.coefficients.iter().enumerate() {
            product[i * a + j] += x * y;
        }
    }
    product
}
