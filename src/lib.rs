//! Eigenring
pub mod analysis;
pub mod fault;
pub mod mesh;
pub mod numbers;
pub mod refine;
pub mod report;
pub mod scheme;
pub mod verdicts;
