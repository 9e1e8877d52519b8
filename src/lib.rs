//! Eigenring analyses subdivision schemes near their extraordinary points.
//!
//! **A scheme is data; everything else reads it.** The pipeline, one stage a module:
//!
//! 1. [`scheme`]: a short TOML file says which mesh, which split, and the weights as formulas in the valence n.
//! 2. [`refine`]: weights meet topology ([`mesh`]): how is each new point made from old ones?
//! 3. [`analysis`]: the local subdivision matrix at a valence ([`analysis::local`]), its blocks by the discrete Fourier transform
//!    ([`analysis::blocks`]), their eigenvalues ([`analysis::spectrum`]), limit and tangent masks ([`analysis::masks`]), and the
//!    characteristic map ([`analysis::charmap`]); at a boundary or crease the same by a mirror alone ([`analysis::boundary`]).
//! 4. [`proof`]: what holds for every valence at once?
//! 5. [`verdicts`]: what follows, and from which theorem?
//! 6. [`report`]: tables and pictures.
//!
//! Curves have the same pipeline in small: [`scheme::curve`], [`refine::curve`], [`analysis::curve`], [`report::curve`].
//!
//! The same rules refine real meshes: [`mesh::io`] reads one, [`mesh::HalfEdgeMesh`] holds it, [`refine::Refiner`] refines it,
//! [`analysis::limit`] pushes it to the limit by the masks, and [`analysis::verify`] checks these against it.
//!
//! ```
//! use eigenring::analysis::Analyzer;
//! use eigenring::proof::c1::Proofs;
//! use eigenring::refine;
//! use eigenring::scheme::Scheme;
//! use eigenring::verdicts::{Decision, verdicts};
//!
//! let text = r#"
//!     name  = "Loop"
//!     mesh  = "triangles"
//!     split = "1-to-4"
//!     [let]
//!     beta = "(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n"
//!     [vertex]
//!     centre = "1 - n*beta"
//!     ring   = "beta"
//!     [edge]
//!     ends     = "3/8"
//!     opposite = "1/8"
//! "#;
//! let scheme = Scheme::parse("loop", "loop.toml", text)?;
//! let sums = refine::check(&scheme, &[5])?;               // every fault of the file, if there is one
//!
//! let analyzer = Analyzer::new(&scheme)?;
//! let analysis = analyzer.at(5)?;
//! assert_eq!(analysis.local.size(), 1 + 3 * 5);           // the full neighbourhood
//!
//! let lambda = analysis.spectrum.subdominant().ok_or("no eigenvalue")?;
//! assert_eq!(lambda.frequency, 1);
//! assert!((lambda.value.re - (5.0 + 5_f64.sqrt()) / 16.0).abs() < 1e-15);
//!
//! let mask = analysis.limit_mask.as_ref().ok_or("no limit mask")?;
//! let sum: f64 = mask.weights(&analysis.local).iter().map(|(_, weight)| weight).sum();
//! assert!((sum - 1.0).abs() < 1e-15);
//!
//! let proofs = Proofs::of(&analyzer);                     // characteristic maps of every valence, proved regular and injective
//! let found = verdicts(&analysis, &sums, &proofs.at(5, analysis.exact.as_ref().ok()));
//! let c1 = found.iter().find(|verdict| verdict.claim == "C1").ok_or("no verdict")?;
//! assert_eq!(c1.verdict, Decision::Proved);               // or refuted, or undecided: `why` tells
//!
//! // the same scheme on a mesh: a step, and the limit of its vertices
//! use eigenring::analysis::limit::Limits;
//! use eigenring::mesh::{HalfEdgeMesh, Tags, shapes};
//! use eigenring::refine::{Level, Refiner, Route};
//!
//! let shape = shapes::tetrahedron();
//! let mesh = HalfEdgeMesh::new(shape.positions.len(), shape.faces)?;
//! let level = Level { mesh, positions: shape.positions, tags: Tags::default() };
//! let refiner = Refiner::new(&scheme, None)?;
//! let finer = refiner.step(&level, Route::Fast)?;
//! assert_eq!((finer.mesh.vertices(), finer.mesh.faces().len()), (4 + 6, 4 * 4));
//! let limits = Limits::new(&refiner)?;
//! let (here, there) = (limits.of(&level, &|| ())?, limits.of(&finer, &|| ())?);
//! assert!((here.positions[0][0] - there.positions[0][0]).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! All numbers are approximate (`f64`) unless they are said to be proved. The theory, with sources, is in `docs/theory.md`.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod analysis;
pub mod fault;
pub mod mesh;
pub mod numbers;
pub mod proof;
pub mod refine;
pub mod report;
pub mod scheme;
pub mod verdicts;
