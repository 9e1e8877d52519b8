//! Which conditions hold for every valence, with a proof?
//!
//! The map part of C1, exactly: the characteristic map of every n >= 3 at once is regular and injective, for schemes
//! that are piecewise polynomial and whose subdominant eigenvalue and c = cos(2 pi/n) are rational functions of one
//! parameter ([`course`]). The net's values are rational functions of it ([`net`]), and so are the Bernstein
//! coefficients of the Jacobian ([`jacobian`]); each is positive on the parameter's whole range ([`positive`]).
//!
//! Others by enclosed derivatives ([`derivative`]), at single valences ([`valence`]), and over boxes of c that cover all of them ([`family`]).
//!
//! The order of the eigenvalues, and what excludes C1: [`spectrum`]. Together: [`c1`].

pub mod b_spline;
pub mod c1;
pub mod certificate;
pub mod course;
pub mod derivative;
pub mod enclosed_net;
pub mod family;
pub mod jacobian;
pub mod kernel;
pub mod map;
pub mod maps;
pub mod net;
pub mod outcome;
pub mod positive;
pub mod ring;
pub mod signed;
pub mod spectrum;
pub mod valence;
