//! What does a scheme do on regular meshes?
//!
//! There it is a mask on a lattice, and its symbol tells, exactly: which polynomials it generates and reproduces ([`moments`]), which
//! smoothing factors it has ([`factors`]), which box spline or tensor-product B-spline it is, if one ([`box_spline`]), and how smooth limits are
//! ([`differences`], [`all_differences`]). With a parameter left free it tells the values at which polynomials of higher degree are generated ([`special`]).

pub mod all_differences;
pub mod box_spline;
pub mod differences;
pub mod factors;
pub mod mask;
pub mod moments;
pub mod special;

use crate::numbers::Trouble;
use crate::refine::Obstacle;
use crate::scheme::Scheme;
use box_spline::BoxSpline;
use differences::{Differences, Grid, Proof};
use factors::Factors;
use mask::Mask;
use moments::Moments;

/// What is known of the smoothness of limits on regular meshes.
#[derive(Clone, Debug, PartialEq)]
pub enum Smoothness {
    /// Limits are C^r and, for some data, not smoother: why they are not.
    Exactly(usize, Proof, &'static str),
    /// Limits are C^r; more is not decided.
    AtLeast(usize, Proof),
    /// The scheme has no continuous limits for some data: why.
    NotContinuous(&'static str),
    /// Nothing is decided: what is missing.
    Undecided(&'static str),
}

impl Smoothness {
    /// The largest r for which limits are proved to be C^r.
    pub fn proved(&self) -> Option<usize> {
        match self {
            Smoothness::Exactly(r, ..) | Smoothness::AtLeast(r, _) => Some(*r),
            _ => None,
        }
    }

    /// Whether limits are C^k, where that is decided.
    pub fn is(&self, k: usize) -> Option<bool> {
        match self {
            Smoothness::Exactly(r, ..) => Some(k <= *r),
            Smoothness::AtLeast(r, _) => (k <= *r).then_some(true),
            Smoothness::NotContinuous(_) => Some(false),
            Smoothness::Undecided(_) => None,
        }
    }
}

/// A scheme on regular meshes. With free parameters everything holds for their general values, and smoothness is not decided.
#[derive(Clone, Debug, PartialEq)]
pub struct Regular {
    /// The mask.
    pub mask: Mask,
    /// The mask of some steps at once, with a dilation matrix m I, and their number: the mask itself and 1 where that has one; `None` where
    /// there is none.
    pub straight: Option<(Mask, u32)>,
    /// The symbol of these steps as a product.
    pub factors: Factors,
    /// The box spline that it is.
    pub spline: Option<BoxSpline>,
    /// Sum rules, reproduction, shift.
    pub moments: Moments,
    /// How smooth limits are.
    pub smoothness: Smoothness,
}

/// The largest r that is tried.
const MOST_CONTINUITY: usize = 8;

impl Regular {
    /// The regular part of a scheme.
    ///
    /// # Errors
    /// When a weight has no value, or is no rational number (function of the free parameters).
    pub fn of(scheme: &Scheme) -> Result<Regular, Obstacle> {
        Ok(Regular::of_mask(Mask::of(scheme)?)?)
    }

    /// The same of a mask.
    ///
    /// # Errors
    /// When the numbers pass a limit of size.
    pub fn of_mask(mask: Mask) -> Result<Regular, Trouble> {
        let straight = mask.straightened()?;
        let scaled = straight.as_ref().map_or(&mask, |(scaled, _)| scaled);
        let factors = Factors::of(scaled)?;
        let spline = BoxSpline::of(&factors);
        let moments = Moments::of(&mask)?;
        let smoothness = smoothness(scaled, &factors, spline.as_ref(), &moments)?;
        Ok(Regular { mask, straight, factors, spline, moments, smoothness })
    }

    /// The same where some eigenvalue at a regular vertex after 1 and 1/2 is above 1/4 in modulus, or 1/4 has a Jordan block, and the scheme is
    /// interpolating, so that its eigenfunctions are not 0 as limits: these are no quadratic polynomials up to o(|x|^2), and not C2.
    #[must_use]
    pub fn not_c2(mut self) -> Regular {
        const WHY: &str =
            "the scheme is interpolating, and eigenvalues at regular vertices make second derivatives diverge";
        if let Smoothness::AtLeast(1, proof) = self.smoothness {
            self.smoothness = Smoothness::Exactly(1, proof, WHY);
        }
        self
    }

    /// The degree of the polynomials that limits are known to include: one less than the order of the sum rules, or the box spline's order.
    /// The first is shown for schemes that converge.
    pub fn generation(&self) -> Option<usize> {
        let spline = self.spline.as_ref().map_or(0, BoxSpline::order);
        self.moments.sum_rules.max(spline).checked_sub(1)
    }
}

fn smoothness(
    mask: &Mask,
    factors: &Factors,
    spline: Option<&BoxSpline>,
    moments: &Moments,
) -> Result<Smoothness, Trouble> {
    if moments.reproduction.is_none() {
        return Ok(Smoothness::Undecided("the weights of some new points don't sum to 1"));
    }
    if mask.coefficients.values().any(|weight| weight.as_rational().is_none()) {
        return Ok(Smoothness::Undecided("a parameter is free: smoothness is decided at its values only"));
    }
    // a scheme with continuous limits has the normalised solution of its refinement equation as limit of the unit data
    if spline.is_some_and(|spline| spline.continuity().is_none()) {
        return Ok(Smoothness::NotContinuous("the box spline of its directions is not continuous"));
    }
    let Some(mut differences) = Differences::of(mask, factors) else {
        return Ok(Smoothness::Undecided("no number of steps has a multiple of the identity as dilation matrix"));
    };
    let mut best = None;
    for r in 0..=MOST_CONTINUITY {
        let Some(proof) = differences.prove(r)? else { break };
        if let Some(r) = spline.and_then(BoxSpline::continuity) {
            return Ok(Smoothness::Exactly(r, proof, "the scheme converges to the box spline, which is not smoother"));
        }
        best = Some((r, proof));
    }
    // where factors are missing
    if best.as_ref().is_none_or(|(r, _)| *r == 0) {
        best = in_all_directions(mask, moments).or(best);
    }
    Ok(match best {
        Some((r, proof)) => Smoothness::AtLeast(r, proof),
        None => Smoothness::Undecided("no difference schemes were shown to be contractive"),
    })
}

/// The largest r that the differences of all directions prove, up to stated limits.
fn in_all_directions(mask: &Mask, moments: &Moments) -> Option<(usize, Proof)> {
    let (grid, m) = (Grid::of(&mask.coefficients)?, mask.dilation.arity()?);
    let proofs = (0..moments.sum_rules.min(MOST_CONTINUITY + 1)).map_while(|r| {
        let found = all_differences::contraction(&grid, m, r)?;
        Some((r, Proof { all: Some((r + 1, found)), ..Proof::default() }))
    });
    proofs.last()
}
