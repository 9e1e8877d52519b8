//! Into which factors does a characteristic polynomial fall at one valence?
//!
//! By the forms for all n, put in at this n; by x - 1; by rational roots and quadratic factors where coefficients are rational; and into
//! parts without multiple roots. Each factor is divided out exactly.

use crate::numbers::factor::factors;
use crate::numbers::{Cosine, Field, Free, Trouble, Univariate};

/// A factor that is known beforehand, with the form for all n that it comes from.
pub struct Hint {
    /// At this valence and frequency.
    pub polynomial: Univariate<Cosine>,
    /// For all.
    pub form: Univariate<Free>,
    /// The indeterminates' values, approximately.
    pub approx: Vec<f64>,
    /// The names of the free parameters.
    pub parameters: Vec<String>,
}

/// Splits a monic polynomial: by factors known beforehand (x - 1 among them), by rational roots, into parts without multiple roots.
///
/// # Errors
/// When a limit of size is passed.
pub fn pieces(polynomial: &Univariate<Cosine>, hints: &[Hint]) -> Result<Vec<(Univariate<Cosine>, usize)>, Trouble> {
    let one = Univariate::new(vec![Cosine::whole(-1), Cosine::whole(1)]);
    let mut found: Vec<(Univariate<Cosine>, usize)> = Vec::new();
    let mut rest = polynomial.clone();
    for known in hints.iter().map(|hint| &hint.polynomial).chain([&one]) {
        let mut times = 0;
        while rest.degree() >= known.degree() {
            let (quotient, remainder) = rest.divided(known)?;
            if remainder.degree().is_some() {
                break;
            }
            (rest, times) = (quotient, times + 1);
        }
        for (piece, own) in refined(known)? {
            if times > 0 {
                found.push((piece, own * times));
            }
        }
    }
    for (piece, times) in rest.squarefree()? {
        for (piece, own) in refined(&piece)? {
            found.push((piece, own * times));
        }
    }
    Ok(found)
}

/// The factors over the rational numbers, where the coefficients are such; else the parts without multiple roots.
fn refined(polynomial: &Univariate<Cosine>) -> Result<Vec<(Univariate<Cosine>, usize)>, Trouble> {
    if polynomial.degree().is_none_or(|degree| degree <= 1) {
        return Ok(polynomial
            .degree()
            .filter(|degree| *degree == 1)
            .map(|_| (polynomial.clone(), 1))
            .into_iter()
            .collect());
    }
    let rational: Option<Vec<Free>> =
        polynomial.coefficients().iter().map(|value| Some(Free::rational(&value.as_rational()?))).collect();
    let Some(rational) = rational else { return polynomial.squarefree() };
    let back = |(factor, times): (Univariate<Free>, usize)| {
        let coefficients =
            factor.coefficients().iter().map(|value| Cosine::rational(&value.as_rational().unwrap_or_default()));
        (Univariate::new(coefficients.collect()), times)
    };
    Ok(factors(&Univariate::new(rational))?.into_iter().map(back).collect())
}
