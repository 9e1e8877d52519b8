//! How smooth are the limit curves of a mask, exactly?
//!
//! With all factors of the symbol taken out ([`symbol`]) the kernel's transition matrices ([`transition`]) have a joint spectral radius rho
//! ([`radius`]), and limit curves have every Hölder exponent below -log_a rho; if the shifts are stable ([`stability`]) none above
//! (Daubechies and Lagarias 1992; Rioul 1992; Dyn and Levin 2002). Bounds are exact rational numbers with a witness ([`witness`]).

pub mod attained;
mod polytope;
mod products;
pub mod radius;
pub mod range;
pub mod reproduction;
mod rounding;
mod simplex;
pub mod stability;
pub mod symbol;
pub mod transition;
pub mod witness;

use crate::scheme::curve::Mask;
use dashu_ratio::RBig;
use radius::Radius;
use rounding::{exponent_above, exponent_below};
use stability::Stability;

/// How smooth the limit curves of a mask are.
#[derive(Clone, Debug)]
pub struct Smoothness {
    /// The number of factors 1 + z + ... + z^(a-1) of the symbol: the order of the sum rules.
    pub order: usize,
    /// The mask of differences of this order.
    pub kernel: Mask,
    /// Polynomials up to this degree come back, with the parameter shift; of those up to `order` - 1, which the scheme makes.
    pub reproduction_degree: usize,
    /// The parameter shift tau = a'(1)/a.
    pub shift: RBig,
    /// Bounds of the joint spectral radius of its transition matrices, with a witness.
    pub radius: Radius,
    /// Whether integer shifts of the basic limit function are stable.
    pub stability: Stability,
    /// All limit curves have every Hölder exponent below this; `None` where convergence is not shown.
    pub lower: Option<f64>,
    /// The basic limit function has no exponent above this; `None` where the shifts are not known to be stable.
    pub upper: Option<f64>,
    /// The exponent in words of the scheme language, with `log_a`; where the radius is known exactly and `upper` holds.
    pub exact: Option<String>,
    /// The largest m for which C^m is proved.
    pub continuity: Option<usize>,
    /// The smallest m for which C^m is refuted.
    pub refuted: Option<usize>,
    /// Whether the exponent is attained, where that is decided: a whole one in the sense of a Lipschitz continuous derivative.
    pub attained: Option<bool>,
    /// What this rests on, in sentences.
    pub why: Vec<String>,
}

/// How smooth the limit curves of a mask are.
///
/// # Errors
/// In words: which submask doesn't sum to 1, or which limit is passed.
pub fn smoothness(mask: &Mask) -> Result<Smoothness, String> {
    let sums = mask.coset_sums();
    if let Some((r, sum)) = sums.iter().enumerate().find(|(_, sum)| **sum != RBig::ONE) {
        return Err(format!(
            "the weights of the new points i = {r} modulo {} sum to {sum}, not to 1: there is no limit",
            mask.arity
        ));
    }
    let words = |trouble: crate::numbers::Trouble| trouble.to_string();
    let symbol::Factored { order, kernel } = symbol::factored(mask);
    let radius = radius::radius(&kernel, order).map_err(words)?;
    let stability = stability::stability(mask).map_err(words)?;
    let a = mask.arity;
    let stable = stability == Stability::Stable;
    let exact = radius.exact.as_ref().filter(|rho| stable && !rho.is_zero());
    let whole = exact.and_then(|rho| whole_power(rho, a));
    let lower =
        (radius.upper < RBig::ONE).then(|| whole.map_or_else(|| exponent_below(&radius.upper, a), |m| m as f64));
    let upper = stable.then(|| whole.map_or_else(|| exponent_above(&radius.lower, a), |m| m as f64));
    let attained = match whole {
        Some(m) => attained::whole_exponent(mask, m, stable, &radius.product).map_err(words)?,
        // a witness for rho itself bounds all products
        None => exact.map(|_| true),
    };
    Ok(Smoothness {
        why: why(order, &radius, stability, lower.is_some()),
        exact: exact.map(|rho| in_words(rho, a, whole)),
        continuity: (0..=order).take_while(|m| &radius.upper * &power(a, *m) < RBig::ONE).last(),
        refuted: (0..=order).find(|m| stable && &radius.lower * &power(a, *m) >= RBig::ONE),
        reproduction_degree: reproduction::reproduction_degree(mask, order.saturating_sub(1)),
        shift: reproduction::shift(mask),
        order,
        kernel,
        radius,
        stability,
        lower,
        upper,
        attained,
    })
}

fn power(a: u32, m: usize) -> RBig {
    (0..m).fold(RBig::ONE, |power, _| power * RBig::from(a))
}

/// The m with rho = a^(-m).
fn whole_power(rho: &RBig, a: u32) -> Option<usize> {
    let mut reached = (0.., rho.clone());
    loop {
        let m = reached.0.next()?;
        if reached.1 >= RBig::ONE {
            return (reached.1 == RBig::ONE).then_some(m);
        }
        reached.1 *= RBig::from(a);
    }
}

fn in_words(rho: &RBig, a: u32, whole: Option<usize>) -> String {
    whole.map_or_else(|| format!("log_{a}({})", RBig::ONE / rho), |m| m.to_string())
}

fn why(order: usize, radius: &Radius, stability: Stability, converges: bool) -> Vec<String> {
    let mut lines =
        vec![format!("the symbol has {order} factor{} 1 + z + ... + z^(a-1)", if order == 1 { "" } else { "s" })];
    if radius.product.is_empty() {
        lines.push(
            "the transition matrices are too large for products: bounds come from norms and from the order".to_string(),
        );
    } else {
        let word: Vec<String> = radius.product.iter().map(|e| format!("T_{e}")).collect();
        lines.push(format!("the fastest product found is {}", word.join(" then ")));
    }
    lines.push(match &radius.witness {
        witness::Witness::Norm { steps } => {
            format!("the norm of {steps} step{} bounds the radius from above", if *steps == 1 { "" } else { "s" })
        }
        witness::Witness::Polytope(polytope) => format!(
            "an invariant polytope with {} pairs of vertices bounds the radius from above",
            polytope.vertices.len()
        ),
    });
    if radius.lower >= RBig::ONE {
        lines.push("the radius is 1 or more: the differences do not shrink, the scheme does not converge".to_string());
    } else if !converges {
        lines.push("the bound of the radius is not below 1: convergence is not decided".to_string());
    }
    match stability {
        Stability::Stable => lines
            .push("the integer shifts are stable: the radius gives an upper bound of the exponent as well".to_string()),
        Stability::Unstable(why) | Stability::Undecided(why) => {
            lines.push(format!("{why}: the radius gives a lower bound of the exponent only"))
        }
    }
    lines
}
