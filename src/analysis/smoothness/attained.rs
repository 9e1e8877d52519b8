//! Is the exponent attained?
//!
//! Where products of L kernel matrices stay below a constant times rho^L, k-th differences do too, which says just that a function has an
//! exponent that isn't whole. For a whole exponent m they must do so for the mask of m-th differences (then the derivative of order m - 1 is Lipschitz
//! continuous); a Jordan block of an eigenvalue of modulus a^(-m L) in a product of L of its matrices shows that they don't (Rioul 1992).

use super::products::product_of;
use super::symbol::{differences, norm, one_more};
use super::transition::transitions;
use crate::numbers::Trouble;
use crate::numbers::linear::{null_space, product, shifted};
use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// Steps whose norm is looked at.
const STEPS: usize = 6;

/// Whether the whole exponent m is attained; `stable` tells whether the shifts are known to be stable, `word` is the fastest product.
///
/// # Errors
/// When numbers pass a limit.
pub fn whole_exponent(mask: &Mask, m: usize, stable: bool, word: &[usize]) -> Result<Option<bool>, Trouble> {
    let Some(own) = differences(mask, m) else { return Ok(None) };
    let rate = (0..m).fold(RBig::ONE, |power, _| power / RBig::from(mask.arity));
    let (mut all, mut spacing, mut power) = (vec![RBig::ONE], 1, RBig::ONE);
    for _ in 0..STEPS {
        (all, spacing, power) = (one_more(&all, &own), spacing * mask.arity as usize, power * &rate);
        if norm(&all, spacing) <= power {
            return Ok(Some(true));
        }
    }
    if !stable {
        return Ok(None);
    }
    let matrices = transitions(&own);
    let singles = (0..matrices.len()).map(|e| vec![e]);
    for word in singles.chain([word.to_vec()]).filter(|word| !word.is_empty()) {
        let step = product_of(&word, &matrices)?;
        let power = word.iter().fold(RBig::ONE, |power, _| power * &rate);
        for eigenvalue in [power.clone(), -power] {
            let once = shifted(&step, &eigenvalue)?;
            if null_space(&product(&once, &once)?)?.len() > null_space(&once)?.len() {
                return Ok(Some(false));
            }
        }
    }
    Ok(None)
}
