//! What shows that a joint spectral radius is not larger than q?
//!
//! Vertices v_j that span the space with T_e v_j = q sum_l alpha_l v_l and sum_l |alpha_l| <= 1: in the norm whose unit ball is their
//! balanced hull every T_e is at most q (Guglielmi and Protasov 2013). Or the norm of L steps, which is at most q^L. Checked with rational
//! numbers alone; nothing of the search is used.

use super::symbol::{norm, one_more};
use super::transition::{exact_image, transitions};
use crate::numbers::linear::null_space;
use crate::scheme::curve::Mask;
use dashu_ratio::RBig;

/// What shows an upper bound q of the joint spectral radius of a mask's transition matrices.
#[derive(Clone, Debug, PartialEq)]
pub enum Witness {
    /// The norm of so many steps is at most q to their number.
    Norm {
        /// The number of steps.
        steps: usize,
    },
    /// A polytope that every T_e takes into q times itself.
    Polytope(Polytope),
}

/// An invariant polytope.
#[derive(Clone, Debug, PartialEq)]
pub struct Polytope {
    /// Its vertices; their negatives are vertices as well.
    pub vertices: Vec<Vec<RBig>>,
    /// For each vertex, for each T_e: the coefficients alpha with the numbers of their vertices.
    pub images: Vec<Vec<Vec<(usize, RBig)>>>,
}

impl Witness {
    /// Whether it shows that the joint spectral radius of the mask's transition matrices is at most q.
    pub fn shows(&self, mask: &Mask, q: &RBig) -> bool {
        match self {
            Witness::Norm { steps } => {
                let mut all = vec![RBig::ONE];
                let (mut spacing, mut power) = (1_usize, RBig::ONE);
                for _ in 0..*steps {
                    all = one_more(&all, mask);
                    spacing = spacing.saturating_mul(mask.arity as usize);
                    power *= q;
                }
                *steps > 0 && *q >= RBig::ZERO && norm(&all, spacing) <= power
            }
            Witness::Polytope(polytope) => polytope.shows(mask, q),
        }
    }
}

impl Polytope {
    fn shows(&self, mask: &Mask, q: &RBig) -> bool {
        let matrices = transitions(mask);
        let n = matrices.first().map_or(0, Vec::len);
        let sizes = self.vertices.iter().all(|v| v.len() == n) && self.images.len() == self.vertices.len();
        if !sizes
            || self.vertices.is_empty()
            || *q < RBig::ZERO
            || !null_space(&self.vertices).is_ok_and(|kernel| kernel.is_empty())
        {
            return false;
        }
        self.vertices.iter().zip(&self.images).all(|(vertex, images)| {
            let fits = |(matrix, terms): (&Vec<Vec<RBig>>, &Vec<(usize, RBig)>)| {
                self.combined(terms, n).is_some_and(|(sum, size)| {
                    let scaled = sum.iter().map(|value| value * q);
                    size <= RBig::ONE && exact_image(matrix, vertex).into_iter().eq(scaled)
                })
            };
            images.len() == matrices.len() && matrices.iter().zip(images).all(fits)
        })
    }

    /// The combination and the sum of its coefficients' absolute values.
    fn combined(&self, terms: &[(usize, RBig)], n: usize) -> Option<(Vec<RBig>, RBig)> {
        let (mut sum, mut size) = (vec![RBig::ZERO; n], RBig::ZERO);
        for (l, alpha) in terms {
            let vertex = self.vertices.get(*l)?;
            sum.iter_mut().zip(vertex).for_each(|(sum, value)| *sum += alpha * value);
            if *alpha < RBig::ZERO { size -= alpha } else { size += alpha }
        }
        Some((sum, size))
    }
}
