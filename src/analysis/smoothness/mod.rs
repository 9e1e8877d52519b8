//! How smooth are the limit curves of a mask?
//!
//! All factors sigma(z) are taken out of the symbol; with rho the joint spectral radius of what is left, the Hoelder exponent of the limit
//! function is -log_m rho where its integer shifts are stable, and at least that where not (Daubechies and Lagarias 1992; Dyn and Levin 2002).
//! A product of transition matrices bounds rho from below, a norm or an invariant polytope from above.

mod candidate;
mod polytope;
mod simplex;
mod stable;
mod symbol;
mod transition;

pub use polytope::{Combination, Polytope};
pub use symbol::{Symbol, reproduction_degree, shift};

use crate::scheme::curve::Mask;
use candidate::{best_product, certain_growth, orbit};
use dashu_ratio::RBig;
use serde::Serialize;
use std::fmt;
use transition::{Exact, less, norm, null_space, product, times, transition_matrices};

/// Longer masks are refused.
pub const MOST_WEIGHTS: usize = 64;
/// Numerators and denominators of more bits are refused.
const MOST_BITS: usize = 512;
/// The iterates of which the norm is looked at.
const ITERATES: usize = 3;
/// By how much the polytope may grow beyond the candidate, tried in this order.
const SLACKS: [f64; 5] = [0.0, 1e-7, 1e-4, 1e-3, 5e-3];

/// Why there is no limit curve to speak of.
#[derive(Clone, Debug, PartialEq)]
pub enum NoLimit {
    /// A sum of weights over a class of indices modulo the arity is not 1.
    SumRule(String),
    /// A product of difference matrices doesn't shrink: its digits, and its growth per step at the least.
    Diverges(Vec<usize>, f64),
    /// Whether differences shrink was not decided.
    Undecided,
    /// A limit of size is passed.
    Limit(String),
}

impl fmt::Display for NoLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoLimit::SumRule(sums) => {
                write!(f, "the new points' weights must sum to 1, but the sums are {sums}: the scheme has no limit")
            }
            NoLimit::Diverges(digits, growth) => {
                write!(f, "differences don't shrink: the product T{digits:?} grows by {growth:.6} or more in a step")
            }
            NoLimit::Undecided => f.write_str("it was not decided whether differences shrink"),
            NoLimit::Limit(what) => f.write_str(what),
        }
    }
}

/// The Hoelder exponent: an interval that certainly holds it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Exponent {
    /// At least this; rounded down.
    pub lower: f64,
    /// At most this, rounded up; `None` where the shifts are not known to be stable.
    pub upper: Option<f64>,
    /// Whether the exponent itself is a Hoelder exponent (an integer: that of a Lipschitz condition), where that is known.
    pub attained: Option<bool>,
    /// The exponent in words where it is known exactly, such as `2` or `log_3 11`.
    pub exact: Option<String>,
}

/// What bounds the joint spectral radius from above.
#[derive(Clone, Debug)]
pub enum Witness {
    /// The norm of this iterate.
    Norm(usize),
    /// A polytope.
    Polytope(Box<Polytope>),
}

/// What is known about the limit curves of a mask.
#[derive(Clone, Debug)]
pub struct Smoothness {
    /// The largest l for which limit curves are known to be C^l.
    pub continuity: u32,
    /// Whether they are known not to be C^(continuity + 1).
    pub no_more: bool,
    /// The Hoelder exponent.
    pub hoelder: Exponent,
    /// Polynomials up to this degree are made by the scheme.
    pub generation_degree: usize,
    /// Polynomials up to this degree come back, with the parameter shift.
    pub reproduction_degree: usize,
    /// The parameter shift tau = a'(1)/m.
    pub shift: RBig,
    /// Whether the integer shifts of the limit function are stable, where that is decided.
    pub stable: Option<bool>,
    /// rho(T_e1 ... T_eL)^(1/L) of these digits bounds the joint spectral radius from below.
    pub product: Vec<usize>,
    /// The joint spectral radius of the differences of order `generation_degree + 1`: lower and upper bound.
    pub radius: (f64, f64),
    /// The proof of the upper bound.
    pub witness: Witness,
    /// Short sentences that tell how this is known.
    pub why: Vec<String>,
}

/// Bounds of a joint spectral radius.
struct Radius {
    digits: Vec<usize>,
    low: f64,
    high: f64,
    /// rho^L, where it is known exactly.
    exact: Option<(RBig, usize)>,
    witness: Witness,
}

/// The smoothness of the limit curves of a mask.
///
/// # Errors
/// When the scheme doesn't converge, that is not decided, or the mask is beyond the stated limits.
pub fn smoothness(mask: &Mask) -> Result<Smoothness, NoLimit> {
    check_limits(mask)?;
    let sums = mask.coset_sums();
    if sums.iter().any(|sum| *sum != RBig::ONE) {
        let words: Vec<String> = sums.iter().map(ToString::to_string).collect();
        return Err(NoLimit::SumRule(words.join(", ")));
    }
    let symbol = Symbol::of(mask);
    let arity = symbol.arity;
    let order = symbol.factors();
    let matrices = transition_matrices(symbol.kernel(), arity);
    let radius = bounds(symbol.kernel(), &matrices, arity)?;
    if radius.high >= 1.0 {
        let certain = radius.low >= 1.0 || radius.exact.as_ref().is_some_and(|(power, _)| *power >= RBig::ONE);
        return Err(if certain { NoLimit::Diverges(radius.digits, radius.low) } else { NoLimit::Undecided });
    }
    let stable = stable::is_stable(&mask.coefficients, arity);
    let base = libm::log(arity as f64);
    let lower = (-libm::log(radius.high) / base) * (1.0 - 1e-14);
    let upper = (-libm::log(radius.low) / base) * (1.0 + 1e-14);
    let exact = radius.exact.as_ref().map(|(power, length)| words(power, *length, arity));
    let whole = exact.as_ref().and_then(|words| words.parse::<u32>().ok());
    // rho < m^-l makes C^l
    let continuity = (1..=order as u32).take_while(|l| below(&radius, arity, *l)).last().unwrap_or(0);
    let above = i32::try_from(continuity + 1).map_or(0.0, |l| (arity as f64).powi(-l));
    let reached = radius.low > above * (1.0 + 1e-14) || whole == Some(continuity + 1);
    let mut why = vec![format!("the symbol has {order} factors (1 + ... + z^{})", arity - 1)];
    why.push(match &radius.witness {
        Witness::Norm(iterate) => {
            format!("the norm of iterate {iterate} of the differences of order {order} bounds the radius")
        }
        Witness::Polytope(polytope) => {
            format!("an invariant polytope with {} vertices and their negatives bounds it", polytope.vertices.len())
        }
    });
    why.push(format!("the product T{:?} bounds it from below", radius.digits));
    if stable != Some(true) {
        why.push("the integer shifts are not known to be stable: the exponent is bounded from below only".into());
    }
    let sure = stable == Some(true);
    let attained = attained(&symbol, &radius, whole).filter(|attained| *attained || sure);
    let bounds = whole.map_or((lower, upper), |whole| (f64::from(whole), f64::from(whole)));
    let hoelder = Exponent {
        lower: bounds.0,
        upper: sure.then_some(bounds.1),
        attained: attained.filter(|_| sure),
        exact: exact.filter(|_| sure),
    };
    Ok(Smoothness {
        continuity,
        no_more: sure && reached,
        hoelder,
        generation_degree: order - 1,
        reproduction_degree: reproduction_degree(mask, order - 1),
        shift: shift(mask),
        stable,
        product: radius.digits,
        radius: (radius.low, radius.high),
        witness: radius.witness,
        why,
    })
}

fn check_limits(mask: &Mask) -> Result<(), NoLimit> {
    let length = mask.coefficients.len();
    if length > MOST_WEIGHTS {
        let text = format!("smoothness is looked for with up to {MOST_WEIGHTS} weights, and the mask has {length}");
        return Err(NoLimit::Limit(text));
    }
    if !(2..=16).contains(&mask.arity) {
        return Err(NoLimit::Limit(format!("the arity must be from 2 to 16, not {}", mask.arity)));
    }
    use dashu_base::BitTest;
    let long = |value: &RBig| value.numerator().bit_len().max(value.denominator().bit_len()) > MOST_BITS;
    if mask.coefficients.iter().any(long) {
        return Err(NoLimit::Limit(format!("a weight has more than {MOST_BITS} bits")));
    }
    Ok(())
}

/// Whether rho < m^-l is known.
fn below(radius: &Radius, arity: usize, l: u32) -> bool {
    match &radius.exact {
        Some((power, length)) => {
            let due = (0..l as usize * length).fold(RBig::ONE, |x, _| x / RBig::from(arity));
            *power < due
        }
        None => i32::try_from(l).is_ok_and(|l| radius.high < (arity as f64).powi(-l) * (1.0 - 1e-14)),
    }
}

fn bounds(kernel: &[RBig], matrices: &[Exact], arity: usize) -> Result<Radius, NoLimit> {
    if let Some(found) = by_norm(kernel, matrices, arity) {
        return Ok(found);
    }
    let best = best_product(matrices);
    let low = certain_growth(matrices, &best.digits).ok_or(NoLimit::Undecided)?;
    let start = orbit(matrices, &best);
    for slack in SLACKS {
        if let Some(found) = polytope::polytope(matrices, &start, best.growth, slack) {
            let high = found.bound;
            if high > best.growth * (1.0 + slack + 1e-6) {
                continue;
            }
            return Ok(Radius {
                digits: best.digits,
                low,
                high,
                exact: None,
                witness: Witness::Polytope(Box::new(found)),
            });
        }
    }
    // the norm of an iterate is a bound at any rate
    let (high, iterate) = (1..=ITERATES)
        .map(|iterate| (norm_of_iterate(kernel, arity, iterate).to_f64().value().powf(1.0 / iterate as f64), iterate))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .ok_or(NoLimit::Undecided)?;
    Ok(Radius { digits: best.digits, low, high: high * (1.0 + 1e-14), exact: None, witness: Witness::Norm(iterate) })
}

/// The norm of an iterate that is an eigenvalue of a product of as many matrices: then both are rho^L.
fn by_norm(kernel: &[RBig], matrices: &[Exact], arity: usize) -> Option<Radius> {
    for iterate in 1..=ITERATES {
        let count = arity.pow(iterate as u32);
        if count > 64 {
            break;
        }
        let bound = norm_of_iterate(kernel, arity, iterate);
        for number in 0..count {
            let digits: Vec<usize> = (0..iterate).map(|k| number / arity.pow(k as u32) % arity).collect();
            let matrix = product(matrices, &digits);
            let is_eigenvalue = |x: &RBig| !null_space(&less(&matrix, x)).is_empty();
            if is_eigenvalue(&bound) || is_eigenvalue(&-bound.clone()) {
                let root = libm::pow(bound.to_f64().value(), 1.0 / iterate as f64);
                let (low, high) = (root * (1.0 - 1e-14), root * (1.0 + 1e-14));
                let exact = Some((bound, iterate));
                return Some(Radius { digits, low, high, exact, witness: Witness::Norm(iterate) });
            }
        }
    }
    None
}

fn norm_of_iterate(kernel: &[RBig], arity: usize, iterate: usize) -> RBig {
    let mut mask = kernel.to_vec();
    for _ in 1..iterate {
        let mut longer = vec![RBig::ZERO; (mask.len() - 1) * arity + kernel.len()];
        for (i, x) in mask.iter().enumerate() {
            kernel.iter().enumerate().for_each(|(k, y)| longer[arity * i + k] += x * y);
        }
        mask = longer;
    }
    norm(&mask, arity.pow(iterate as u32))
}

/// -log_m of the L-th root of a rational number.
fn words(power: &RBig, length: usize, arity: usize) -> String {
    let mut whole = RBig::ONE;
    for l in 0..=64 {
        if (0..length).fold(RBig::ONE, |x, _| x * &whole) == *power {
            return l.to_string();
        }
        whole /= RBig::from(arity);
    }
    let inverse = RBig::ONE / power;
    let argument = if inverse.is_int() { inverse.to_string() } else { format!("({inverse})") };
    if length == 1 { format!("log_{arity} {argument}") } else { format!("log_{arity} {argument} / {length}") }
}

/// Whether an exactly known exponent is attained: for an integer l, whether products of the l-th divided differences stay bounded.
fn attained(symbol: &Symbol, radius: &Radius, whole: Option<u32>) -> Option<bool> {
    let Some(l) = whole else { return radius.exact.is_some().then_some(true) };
    let mask = symbol.differences.get(l as usize)?;
    let scale = (0..l).fold(RBig::ONE, |x, _| x * RBig::from(symbol.arity));
    let scaled: Vec<RBig> = mask.iter().map(|x| x * &scale).collect();
    if norm(&scaled, symbol.arity) <= RBig::ONE {
        return Some(true);
    }
    let has_block = |matrix: &Exact| {
        let zero = less(matrix, &RBig::ONE);
        null_space(&times(&zero, &zero)).len() > null_space(&zero).len()
    };
    transition_matrices(&scaled, symbol.arity).iter().any(has_block).then_some(false)
}

#[cfg(test)]
mod tests;
