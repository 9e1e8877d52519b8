//! Is an eigenvalue that meets lambda as n tends to infinity smaller for every n?
//!
//! Frequency 0 of Catmull and Clark's scheme has one. With c = 1 - kappa t^2, kappa in 2 pi^2 [1 - pi^2 t^2/3, 1], its
//! polynomial at lambda, reduced by the one of lambda, is a power of t times something that is positive on [0, to].

use super::branch::{Branch, approx_largest, rounded};
use super::disc::{Number, all_within, between, deflated, is_positive};
use super::parts::in_order;
use crate::numbers::polynomial::Polynomial;
use crate::numbers::{C, Field, Free, N, Trouble, Univariate};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// A factor F that may have lambda as a root at t = 0, on the box [0, to].
pub struct Tie<'a> {
    /// The polynomial of lambda.
    pub branch: &'a Branch,
    /// F, in t and c.
    pub own: &'a Univariate<Free>,
    /// The end of the box.
    pub to: &'a RBig,
    /// Below lambda on the box.
    pub low: &'a RBig,
    /// Above it.
    pub high: &'a RBig,
}

impl Tie<'_> {
    /// The power of t that F(lambda) is like, if all roots of F are below lambda for t > 0 in the box: F has just one
    /// root of modulus `low` or more, F_x is positive from `least` on, F(least) < 0, and F(lambda)/t^power is
    /// positive. `boxed` encloses F on the box.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn power(&self, boxed: &Univariate<Number>) -> Result<Option<usize>, Trouble> {
        let Some(guess) = approx_largest(boxed) else { return Ok(None) };
        let margin = 1.0 / 64.0;
        let least = rounded(guess - margin, 16).min(self.low.clone());
        let root = between(&least, self.high);
        if least <= RBig::ZERO
            || boxed.evaluate(&Number::rational(&least))?.sign() != Some(Ordering::Less)
            || !is_positive(&boxed.derivative()?.evaluate(&root)?)
            || !all_within(&deflated(boxed, &root)?, &Number::rational(self.low))?
        {
            return Ok(None);
        }
        let Some((power, quotient)) = self.at_lambda()? else { return Ok(None) };
        let (pi, to) = (Number::pi(), Number::rational(self.to));
        let most = pi.square()?.times(&Number::whole(2))?;
        let part = pi.times(&to)?.square()?.over(&Number::whole(3))?;
        let kappa = most.times(&Number::whole(1).minus(&part)?)?.hull(&most);
        let values = in_order(between(&RBig::ZERO, self.to), kappa);
        let quotient = quotient.mapped(|value| value.evaluate(&values))?;
        let lambda = between(self.low, self.high);
        Ok(is_positive(&quotient.evaluate(&lambda)?).then_some(power))
    }

    /// F at a root of the branch's polynomial, kappa at the place of c: t^power times a polynomial in the root.
    fn at_lambda(&self) -> Result<Option<(usize, Univariate<Free>)>, Trouble> {
        let (t, kappa) = (Free::variable(N), Free::variable(C));
        let c = Free::whole(1).minus(&kappa.times(&t.times(&t)?)?)?;
        let own = self.own.mapped(|value| value.substituted(C, &c))?;
        let leading = self.branch.polynomial().mapped(|value| value.evaluate(&vec![c.clone(); 6]))?;
        let rest = own.divided(&leading)?.1;
        let order = |own: &Polynomial| own.coefficients_in(N).iter().position(|part| !part.is_zero());
        if rest.coefficients().iter().any(|value| order(value.denominator()) != Some(0)) {
            return Ok(None);
        }
        let Some(power) = rest.coefficients().iter().filter_map(|value| order(value.numerator())).min() else {
            return Ok(None);
        };
        let mut scale = Free::whole(1);
        for _ in 0..power {
            scale = scale.times(&t)?;
        }
        Ok(Some((power, rest.mapped(|value| value.over(&scale))?)))
    }
}
