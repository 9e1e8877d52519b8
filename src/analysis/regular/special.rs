//! At which values of a parameter does a scheme do more with polynomials than in general?
//!
//! With one parameter left free the moments of the cosets are functions of it. Those of the first degree at which cosets differ agree where
//! all differences vanish: at the common roots of their numerators, of which the rational ones are looked at.

use super::Regular;
use super::mask::Mask;
use super::moments::apart;
use crate::numbers::factor::polynomial_factors;
use crate::numbers::polynomial::Polynomial;
use crate::numbers::{FIRST_PARAMETER, Trouble};
use dashu_ratio::RBig;

/// The rational values of the one free parameter at which the order of the sum rules is higher, in order, with the scheme there.
///
/// # Errors
/// When the numbers pass a limit of size.
pub fn values_with_more(general: &Regular) -> Result<Vec<(RBig, Regular)>, Trouble> {
    if general.mask.parameters.len() != 1 {
        return Ok(vec![]);
    }
    let mut common = Polynomial::whole(0);
    for difference in apart(&general.mask, general.moments.sum_rules)? {
        common = common.gcd(difference.numerator())?;
    }
    let (_, factors) = polynomial_factors(&common);
    let mut values: Vec<RBig> = factors.iter().filter_map(|(factor, _)| root(factor)).collect();
    values.sort();
    let at = |value: RBig| {
        let of = |mask: &Mask| {
            let coefficients = mask.coefficients.iter();
            let all: Result<Vec<_>, Trouble> =
                coefficients.map(|(point, weight)| Ok((*point, weight.at(FIRST_PARAMETER, &value)?))).collect();
            Ok::<Mask, Trouble>(Mask::new(mask.dilation, all?))
        };
        // a weight may have a pole there
        let regular = of(&general.mask).and_then(Regular::of_mask).ok()?;
        Some((value, regular))
    };
    Ok(values.into_iter().filter_map(at).collect())
}

/// The root of a linear polynomial in the parameter.
fn root(factor: &Polynomial) -> Option<RBig> {
    match &factor.coefficients_in(FIRST_PARAMETER)[..] {
        [constant, slope] => Some(-constant.as_constant()? / slope.as_constant()?),
        _ => None,
    }
}
