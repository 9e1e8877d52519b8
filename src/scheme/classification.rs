//! Of which kind is a scheme?
//!
//! As surveys classify schemes (Zorin and Schroeder 2001, for one): by the mesh, by what a step splits, by whether old points stay, and by smoothness.
//! All schemes of this format are linear and stationary: their rules say so.

use super::{Claim, Quantity, Scheme};

/// The kind of a scheme.
#[derive(Clone, Debug)]
pub struct Classification<'a> {
    /// triangles, quads or polygons.
    pub mesh: &'a str,
    /// Its split, or those of its passes, in words.
    pub split: String,
    /// Whether vertices are split (dual schemes, whose extraordinary points are faces) and not faces (primal ones).
    pub dual: bool,
    /// Whether old points stay, or limits only come near them.
    pub interpolating: bool,
    /// What the literature claims of smoothness at extraordinary points: C1, C2.
    pub smoothness: Vec<&'a Claim>,
}

impl Scheme {
    /// The kind of this scheme, whose extraordinary points are faces (`dual`) or vertices: that depends on what its splits do to the lattice.
    pub fn classification(&self, dual: bool) -> Classification<'_> {
        let smooth = |claim: &&Claim| matches!(claim.quantity, Quantity::C1 | Quantity::C2);
        Classification {
            mesh: &self.mesh,
            split: self.split_in_words(),
            dual,
            interpolating: self.is_interpolating(),
            smoothness: self.claims.iter().filter(smooth).collect(),
        }
    }
}

impl Classification<'_> {
    /// `face split` or `vertex split`, with the other word for it.
    pub fn kind_of_split(&self) -> &'static str {
        if self.dual { "vertex split (dual)" } else { "face split (primal)" }
    }

    /// `interpolating` or `approximating`.
    pub fn kind_of_points(&self) -> &'static str {
        if self.interpolating { "interpolating" } else { "approximating" }
    }

    /// The claims of smoothness, each with where it is made: `C1 where n >= 4`; nothing where there are none.
    pub fn claimed(&self) -> String {
        let words = |claim: &&Claim| match &claim.condition {
            Some(condition) => format!("{} where {}", claim.what, condition.text()),
            None => claim.what.clone(),
        };
        self.smoothness.iter().map(words).collect::<Vec<_>>().join(", ")
    }
}
