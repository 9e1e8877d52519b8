//! Which conditions hold for every valence, with a proof?
//!
//! The map part of C1, exactly: the characteristic map of every n >= 3 at once is regular and injective, for schemes that are
//! piecewise polynomial and whose subdominant eigenvalue and c = cos(2 pi/n) are rational functions of one parameter ([`course`]). The net's
//! values are rational functions of it ([`net`]), and so are the Bernstein coefficients of the Jacobian ([`jacobian`]); each is positive on the
//! parameter's whole range ([`positive`]).

pub mod c1;
pub mod course;
pub mod jacobian;
pub mod map;
pub mod maps;
pub mod net;
pub mod outcome;
pub mod positive;
pub mod spectrum;
