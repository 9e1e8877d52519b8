//! Between which rational numbers does cos(2 pi k/n) lie?
//!
//! Partial sums of its series are above and below it in turn. Where it is rational (Niven 1956) it is given exactly.

use dashu_int::IBig;
use dashu_ratio::RBig;

/// Bounds of pi by its first digits.
pub(crate) fn pi() -> [RBig; 2] {
    [31_415_926_535_897_932_384_626_433_832_795_i128, 31_415_926_535_897_932_384_626_433_832_796]
        .map(|digits| RBig::from(digits) / RBig::from(10_i128.pow(31)))
}

/// Bounds of cos(2 pi k/n) for 0 <= k <= n/2, where it falls as k grows: multiples of 2^-80.
pub(crate) fn cosine(k: i64, n: i64) -> [RBig; 2] {
    let exact = [(0, 2), (2, 1), (3, 0), (4, -1), (6, -2)].into_iter().find(|(twelfths, _)| 12 * k == twelfths * n);
    if let Some((_, twice)) = exact {
        return [twice, twice].map(|own| RBig::from(own) / RBig::from(2));
    }
    let series = |x: &RBig, terms: i32| {
        let next =
            |(sum, term): (RBig, RBig), i: i32| (sum + &term, -term * x * x / RBig::from((2 * i + 1) * (2 * i + 2)));
        (0..terms).fold((RBig::ZERO, RBig::ONE), next).0
    };
    let (one, [low, high]) = (RBig::from(IBig::ONE << 80), pi().map(|pi| pi * RBig::from(2 * k) / RBig::from(n)));
    [(series(&high, 30) * &one).floor(), (series(&low, 31) * &one).ceil()].map(|own| RBig::from(own) / &one)
}
