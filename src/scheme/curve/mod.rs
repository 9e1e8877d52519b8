//! What is a subdivision scheme for curves?
//!
//! A mask of weights on the line. A file may tell it as a mask, as a symbol, as split + average, or as halves.

mod mask;

pub use mask::Mask;
