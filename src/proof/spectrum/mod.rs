//! Is the order of the eigenvalues that C1 needs there, for every valence?
//!
//! It is: 1 simple and larger than all others, then lambda, real, positive, once in each of the frequencies 1 and n -
//! 1, and larger than all others. A few valences are decided one by one by the exact analysis ([`crate::verdicts`]), all from some n on at
//! once ([`order`], [`tail`]). Where another order excludes C1, it is refuted ([`refutation`], [`range`]).

pub mod branch;
pub mod disc;
pub mod order;
pub mod parts;
pub mod range;
pub mod refutation;
pub mod tail;
pub mod tie;
