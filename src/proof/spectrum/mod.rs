//! Is the order of the eigenvalues that C1 needs there, for every valence at once?

pub mod refutation;
