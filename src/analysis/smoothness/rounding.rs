//! Which floating number lies just below or above a root or a logarithm of a rational number?
//!
//! Roots are checked by exact powers. The logarithm of `libm` is off by less than one unit in its last place; the margins are far larger.

use dashu_ratio::RBig;

/// Relative margin of logarithms.
const MARGIN: f64 = 1e-13;

/// The rational number of a finite floating one.
pub(super) fn rational(value: f64) -> Option<RBig> {
    RBig::try_from(value).ok()
}

fn power(x: &RBig, exponent: usize) -> RBig {
    (0..exponent).fold(RBig::ONE, |power, _| power * x)
}

/// A number x with x^exponent <= value, hardly smaller than the root; for values that are not negative.
pub(super) fn root_below(value: &RBig, exponent: usize) -> Option<RBig> {
    near_root(value, exponent, -MARGIN, |x| power(x, exponent) <= *value)
}

/// A number x with x^exponent >= value, hardly larger than the root; for values that are not negative.
pub(super) fn root_above(value: &RBig, exponent: usize) -> Option<RBig> {
    near_root(value, exponent, MARGIN, |x| power(x, exponent) >= *value)
}

fn near_root(value: &RBig, exponent: usize, margin: f64, fits: impl Fn(&RBig) -> bool) -> Option<RBig> {
    if exponent == 1 || value.is_zero() {
        return Some(value.clone());
    }
    let approx = libm::pow(value.to_f64().value(), 1.0 / exponent as f64);
    let guess = |scale: f64| rational(approx * (1.0 + scale * margin)).filter(|x| fits(x));
    guess(1.0).or_else(|| guess(1000.0)).or_else(|| if margin < 0.0 { Some(RBig::ZERO) } else { None })
}

/// The root itself, where it is rational.
pub(super) fn exact_root(value: &RBig, exponent: usize) -> Option<RBig> {
    let top = dashu_base::UnsignedAbs::unsigned_abs(value.numerator().clone()).nth_root(exponent);
    let root = RBig::from(top) / RBig::from(value.denominator().nth_root(exponent));
    (power(&root, exponent) == *value).then_some(root)
}

/// -log_a(value), not more; for values above zero.
pub(super) fn exponent_below(value: &RBig, arity: u32) -> f64 {
    let approx = exponent(value, arity);
    approx - MARGIN * (1.0 + approx.abs())
}

/// -log_a(value), not less; for values above zero.
pub(super) fn exponent_above(value: &RBig, arity: u32) -> f64 {
    let approx = exponent(value, arity);
    approx + MARGIN * (1.0 + approx.abs())
}

/// -log_a(value), by the logarithms of numerator and denominator where the number is beyond the range of floating ones.
fn exponent(value: &RBig, arity: u32) -> f64 {
    -libm::log(value.to_f64().value()) / libm::log(f64::from(arity))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_and_exponents_lie_on_the_side_that_is_said() {
        for (a, b) in [(2, 1), (1, 3), (9, 64), (1, 1_000_000_007)] {
            let value = RBig::from(a) / RBig::from(b);
            for exponent in 2..9 {
                let (low, high) = (root_below(&value, exponent).unwrap(), root_above(&value, exponent).unwrap());
                assert!(power(&low, exponent) <= value && value <= power(&high, exponent));
                assert!((high.to_f64().value() / low.to_f64().value() - 1.0).abs() < 1e-9);
            }
        }
        let eighth = RBig::ONE / RBig::from(8);
        assert!(exponent_below(&eighth, 2) < 3.0 && exponent_above(&eighth, 2) > 3.0);
        assert!(exponent_above(&eighth, 2) - exponent_below(&eighth, 2) < 1e-11);
        assert_eq!(exact_root(&(RBig::from(8) / RBig::from(27)), 3), Some(RBig::from(2) / RBig::from(3)));
        assert_eq!(exact_root(&RBig::from(2), 2), None);
    }
}
