//! What does a scheme for curves do at a point?
//!
//! As at an extraordinary point of a surface: a local matrix, its spectrum, limit and tangent masks; here all in rational numbers. The
//! points are the vertices and the middles of edges, which the scheme repeats itself around, and the ends of open curves.

pub mod convergence;
pub mod difference;
pub mod limit;
pub mod limit_function;
pub mod local;
pub mod matrix_form;
pub mod point;
pub mod product;
pub mod spectrum;
