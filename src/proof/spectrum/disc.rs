//! Do all roots of a polynomial lie in an open disc, for every polynomial of a box?
//!
//! Schur (1918) and Cohn (1922), as a recursion: all roots of a monic p of degree d lie in |z| < 1 exactly when
//! |p(0)| < 1 and those of the polynomial with coefficients (a_i - a_0 a_(d-i))/(1 - a_0^2), i = 1..d, do. In
//! enclosures the strict signs hold for every polynomial that is enclosed.

use crate::numbers::{Enclosure, Field, Trouble, Univariate};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// A real number enclosed.
pub type Number = Enclosure<128>;

/// The enclosure of all numbers between two rational ones.
pub fn between(low: &RBig, high: &RBig) -> Number {
    Number::rational(low).hull(&Number::rational(high))
}

/// Whether a number is certainly positive.
pub fn is_positive(value: &Number) -> bool {
    value.sign() == Some(Ordering::Greater)
}

/// Whether a number is certainly negative.
pub fn is_negative(value: &Number) -> bool {
    value.sign() == Some(Ordering::Less)
}

/// Whether all roots of these monic polynomials have a modulus below a positive radius; `false` may mean that it was
/// not seen.
///
/// # Errors
/// When a number passes its limit of size.
pub fn all_within(polynomial: &Univariate<Number>, radius: &Number) -> Result<bool, Trouble> {
    let Some((_, lower)) = polynomial.coefficients().split_last() else { return Ok(false) };
    // p(r z)/r^d
    let (mut scaled, mut power) = (vec![Number::whole(1)], Number::whole(1));
    for value in lower.iter().rev() {
        power = power.times(radius)?;
        scaled.push(value.over(&power)?);
    }
    scaled.reverse();
    let one = Number::whole(1);
    while scaled.len() > 1 {
        let (first, last) = (scaled[0].clone(), scaled.len() - 1);
        let rest = one.minus(&first.square()?)?;
        if !is_positive(&rest) {
            return Ok(false);
        }
        let step = |i: usize| scaled[i].minus(&first.times(&scaled[last - i])?)?.over(&rest);
        let mut next = (1..last).map(step).collect::<Result<Vec<_>, _>>()?;
        next.push(one.clone());
        scaled = next;
    }
    Ok(true)
}

/// p/(x - root) for a monic p with this root, by Horner's rule.
///
/// # Errors
/// When a number passes its limit of size.
pub fn deflated(polynomial: &Univariate<Number>, root: &Number) -> Result<Univariate<Number>, Trouble> {
    let (mut quotient, mut sum) = (Vec::new(), Number::whole(0));
    for value in polynomial.coefficients().iter().skip(1).rev() {
        sum = sum.times(root)?.plus(value)?;
        quotient.push(sum.clone());
    }
    quotient.reverse();
    Ok(Univariate::new(quotient))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn tenth(value: i64) -> Number {
        Number::rational(&(RBig::from(value) / RBig::from(10)))
    }

    /// The product of x - a and x^2 - 2 b x + b^2 + c^2.
    fn with_roots(real: &[i64], pairs: &[(i64, i64)]) -> Univariate<Number> {
        let one = Number::whole(1);
        let linear = real.iter().map(|a| Univariate::new(vec![tenth(-a), one.clone()]));
        let size = |b: i64, c: i64| tenth(b).square().unwrap().plus(&tenth(c).square().unwrap()).unwrap();
        let quadratic = pairs.iter().map(|(b, c)| Univariate::new(vec![size(*b, *c), tenth(-2 * b), one.clone()]));
        linear.chain(quadratic).fold(Univariate::constant(one.clone()), |all, own| all.times(&own).unwrap())
    }

    proptest! {
        /// Roots are known: the answer is that of their moduli, unless one lies on the circle.
        #[test]
        fn roots_within_and_without(
            real in proptest::collection::vec(-9i64..10, 0..3),
            pairs in proptest::collection::vec((-7i64..8, 1i64..8), 0..3),
            radius in 1i64..10,
        ) {
            let squares: Vec<i64> = real.iter().map(|a| a * a).chain(pairs.iter().map(|(b, c)| b * b + c * c)).collect();
            prop_assume!(squares.iter().all(|own| *own != radius * radius));
            let inside = squares.iter().all(|own| *own < radius * radius);
            prop_assert_eq!(all_within(&with_roots(&real, &pairs), &tenth(radius)).unwrap(), inside);
        }
    }

    #[test]
    fn a_root_on_the_circle_is_not_within_and_a_box_is_as_large_as_its_largest() {
        assert!(!all_within(&with_roots(&[5], &[]), &tenth(5)).unwrap());
        assert!(!all_within(&with_roots(&[1], &[(3, 4)]), &tenth(5)).unwrap());
        let root = between(&(RBig::ONE / RBig::from(4)), &(RBig::ONE / RBig::from(2)));
        let boxed = Univariate::new(vec![root.negated(), Number::whole(1)]);
        assert!(all_within(&boxed, &tenth(6)).unwrap() && !all_within(&boxed, &tenth(5)).unwrap());
    }

    #[test]
    fn a_quotient_by_a_root_has_the_others() {
        let rest = deflated(&with_roots(&[8, 2], &[(1, 1)]), &tenth(8)).unwrap();
        assert!(all_within(&rest, &tenth(3)).unwrap() && !all_within(&rest, &tenth(1)).unwrap());
    }
}
