//! What can an attempt at a proof come to?
//!
//! Proved, or refuted by a certified witness, or neither. That a proof was not found refutes nothing.

use std::fmt;

/// The valences that a statement is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Valences {
    /// This one.
    At(usize),
    /// Every one from this one on.
    From(usize),
}

impl Valences {
    /// The first of them.
    pub fn first(self) -> usize {
        match self {
            Valences::At(n) | Valences::From(n) => n,
        }
    }

    /// Whether a valence is among them.
    pub fn hold(self, n: usize) -> bool {
        match self {
            Valences::At(own) => n == own,
            Valences::From(first) => n >= first,
        }
    }
}

impl fmt::Display for Valences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Valences::At(n) => write!(f, "n = {n}"),
            Valences::From(n) => write!(f, "every n >= {n}"),
        }
    }
}

/// What an attempt came to; `P` tells how it was proved.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome<P> {
    /// It holds.
    Proved(P),
    /// It does not hold.
    Refuted {
        /// What is certainly against it, by exact or enclosed numbers.
        witness: String,
    },
    /// It is not decided.
    Undecided {
        /// Where the attempt got stuck, and what is missing.
        at: String,
    },
}

impl<P> Outcome<P> {
    /// An attempt that got stuck.
    pub fn stuck(at: impl Into<String>) -> Self {
        Outcome::Undecided { at: at.into() }
    }

    /// The same with another account of the proof.
    pub fn map<Q>(self, told: impl FnOnce(P) -> Q) -> Outcome<Q> {
        match self {
            Outcome::Proved(proof) => Outcome::Proved(told(proof)),
            Outcome::Refuted { witness } => Outcome::Refuted { witness },
            Outcome::Undecided { at } => Outcome::Undecided { at },
        }
    }
}
