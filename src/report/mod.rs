//! What would a person like to see?

pub mod plots;
