//! What does a certificate say?

use crate::polynomial::Poly;
use crate::scheme::Index;
use crate::{Refusal, beyond};
use dashu_ratio::RBig;
use serde::Deserialize;

/// The last valence that is told singly, the largest index and the most points of a net.
const MOST: (i64, i32, usize) = (20, 12, 40);

/// Parameters are told in thousandths.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Certificate {
    format: String,
    claim: String,
    /// The claim, that limit surfaces are C1 at the extraordinary point, is about every valence from this one on.
    pub(crate) from: i64,
    /// The rules of the scheme in the interior.
    pub(crate) scheme: toml::Table,
    /// That of the parameter p.
    pub(crate) range: [i32; 2],
    /// cos(2 pi/n), numerator and denominator, and the subdominant eigenvalue, over a number.
    pub(crate) c: [Poly; 2],
    lambda: (Poly, u32),
    /// The points of a sector's half, with their values.
    pub(crate) net: Vec<(Index, [Poly; 2])>,
    /// Between which parameters that of a valence lies, from the first one on.
    pub(crate) each: Vec<[i32; 2]>,
    /// Below that of any further valence.
    pub(crate) tail: i32,
}

/// A parameter.
pub(crate) fn parameter(thousandths: i32) -> RBig {
    RBig::from(thousandths) / RBig::from(1000)
}

impl Certificate {
    pub(crate) fn parse(text: &str) -> Result<Certificate, Refusal> {
        let own: Certificate = serde_json::from_str(text).or_else(beyond)?;
        let near = own.net.iter().all(|((a, b), _)| 0 <= *b && b <= a && *a <= MOST.1);
        let small = own.net.iter().flat_map(|own| &own.1).chain(&own.c).chain([&own.lambda.0]).all(Poly::is_small);
        let fits = (3..=MOST.0).contains(&own.from) && own.next() <= MOST.0 && own.lambda.1 > 0;
        let few = own.net.len() <= MOST.2 && own.format == "eigenring-certificate/1" && own.claim == "C1";
        if near && small && fits && few { Ok(own) } else { beyond("its format or claim, or numbers beyond the limits") }
    }

    /// The first valence that is not told singly.
    pub(crate) fn next(&self) -> i64 {
        self.from + self.each.len() as i64
    }

    pub(crate) fn lambda(&self) -> Poly {
        self.lambda.0.scaled(RBig::ONE / RBig::from(self.lambda.1))
    }
}
