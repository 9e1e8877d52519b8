//! What does a scheme do at a vertex on a boundary, on a crease, at a corner, or at a dart?
//!
//! The stages of the pipeline again, where there is no rotation but a mirror: the points that matter ([`influence`]), the
//! local matrix ([`local`]), its even and odd part ([`halves`]), cores and eigenvalues as inside ([`super::cores`],
//! [`super::spectrum`]), and masks ([`masks`]). Rules along the crease come from a boundary file. A boundary is a crease with
//! nothing beyond it: each side of a crease inside a mesh is analysed as a boundary is. Where a file tells a flatness, points are moved after each
//! step ([`flatness`]), and all stages are those of the matrix with the moves.

pub mod exact;
pub mod flatness;
pub mod halves;
pub mod influence;
mod leading;
pub mod local;
pub mod masks;
pub mod modes;

use super::cores::Cores;
use super::spectrum::Spectrum;
use crate::mesh::{Fan, FanKind, Lattice};
use crate::refine::{FanRows, Obstacle, Refinement, RegularStencils, cycle_of, lattice_of};
use crate::scheme::{RuleBook, Scheme};
use exact::ExactHalves;
use halves::{Halves, MirrorNode};
use influence::FanInfluence;
use local::FanMatrix;
use masks::{FanMask, Stages, TangentMasks};

/// The most faces around a vertex on a crease: matrices are dense here.
pub const MAX_FACES: usize = 200;

/// What the analyses of a scheme with a boundary file share.
pub struct BoundaryAnalyzer<'a> {
    refinement: Refinement<'a, f64>,
    book: &'a RuleBook,
    lattice: Lattice,
    stencils: RegularStencils,
    influence: FanInfluence,
}

/// Everything found at one kind of vertex; numbers are approximate.
#[derive(Clone, Debug)]
pub struct BoundaryAnalysis {
    /// The fan around the vertex.
    pub fan: Fan,
    /// The local matrix over the full neighbourhood.
    pub local: FanMatrix,
    /// Its even and odd part.
    pub halves: Halves,
    /// The cores of the parts.
    pub cores: Cores<MirrorNode>,
    /// The eigenvalues; the `frequency` of each is its part: see [`halves::Parity::of_part`].
    pub spectrum: Spectrum,
    /// The limit mask, or why there is none.
    pub limit_mask: Result<FanMask, String>,
    /// The tangent masks, or why there are none.
    pub tangent_masks: Result<TangentMasks, String>,
}

impl<'a> BoundaryAnalyzer<'a> {
    /// Prepares the analysis of a scheme with the rules of a boundary file.
    ///
    /// # Errors
    /// When the boundary recedes; when a weight has no value, a rule reaches over the boundary, or stencils reach too far.
    pub fn new(scheme: &'a Scheme, book: &'a RuleBook) -> Result<BoundaryAnalyzer<'a>, Obstacle> {
        if !cycle_of(scheme)?.keeps_boundary() {
            let why = "under its splits the boundary recedes, and there is no analysis there";
            return Err(Obstacle::Limit(format!("{why}: {}", scheme.split_in_words())));
        }
        let refinement = Refinement::new(scheme, Some(book));
        let lattice = lattice_of(scheme);
        let stencils = RegularStencils::of(&refinement, lattice)?;
        let influence = FanInfluence::of(&refinement, &stencils, lattice)?;
        Ok(BoundaryAnalyzer { refinement, book, lattice, stencils, influence })
    }

    /// The scheme that is analysed.
    pub fn scheme(&self) -> &'a Scheme {
        self.refinement.scheme()
    }

    /// The rules along the crease.
    pub fn book(&self) -> &'a RuleBook {
        self.book
    }

    /// The local matrix at a kind of vertex, with the flatness that the file tells.
    ///
    /// # Errors
    /// When the number of faces is out of range, a weight has no value, a rule is missing or reaches over the boundary; when there are no masks for the
    /// flatness.
    pub fn local_matrix(&self, kind: FanKind) -> Result<FanMatrix, Obstacle> {
        let plain = self.plain_matrix(kind)?;
        Ok(match self.moves_over(&plain)? {
            Some(moves) => plain.moved(&moves),
            None => plain,
        })
    }

    /// The local matrix without flatness.
    fn plain_matrix(&self, kind: FanKind) -> Result<FanMatrix, Obstacle> {
        let (name, faces) = (kind.name(), kind.faces());
        if !(kind.least_faces()..=MAX_FACES).contains(&faces) {
            let least = kind.least_faces();
            let message = format!("the number of faces at a {name} must be from {least} to {MAX_FACES}, not {faces}");
            return Err(Obstacle::Limit(message));
        }
        if kind.is_closed() && !self.refinement.cycle()?.keeps_edges() {
            let why = "edges inside a mesh are turned, so that no crease can end there";
            return Err(Obstacle::Limit(format!("under these splits {why}: {}", self.scheme().split_in_words())));
        }
        let rows = FanRows::new(&self.refinement, &self.stencils, Fan::new(self.lattice, kind));
        let labels = self.influence.labels(&rows)?;
        let row = |label| {
            let mut row = Vec::new();
            rows.visit(label, |old, weight| row.push((old, weight)))?;
            Ok(row)
        };
        let local = FanMatrix::of(rows.patch, labels, row)?;
        local.check_mirror()?;
        Ok(local)
    }

    /// What is exact at the vertex of a local matrix: eigenvalues with multiplicities and Jordan blocks, and the limit mask.
    ///
    /// # Errors
    /// Why exact numbers can't hold it.
    pub fn exact(&self, local: &FanMatrix) -> Result<ExactHalves, Obstacle> {
        if self.flatness(local.fan.kind())? > 0.0 {
            let why = "flatness moves points by masks that are known approximately";
            return Err(Obstacle::Limit(format!("{why}: exact numbers are not tried")));
        }
        ExactHalves::of(&self.scheme().with_values(), self.book, local)
    }

    /// Runs every stage at a kind of vertex.
    ///
    /// # Errors
    /// As [`BoundaryAnalyzer::local_matrix`]; when the boundary rules are not alike in the mirror, or eigenvalues can't be computed.
    pub fn at(&self, kind: FanKind) -> Result<BoundaryAnalysis, Obstacle> {
        let local = self.local_matrix(kind)?;
        let halves = Halves::of(local.rows.clone(), &local.mirror);
        let cores = Cores::of(&halves);
        let spectrum = Spectrum::of(&halves, &cores)?;
        let mut stages = Stages { local: &local, halves: &halves, cores: &cores, spectrum: &spectrum, exact: None };
        // exact numbers are asked for where floating ones can't tell a Jordan block
        let unclear = stages.contenders().iter().any(|e| !e.is_isolated());
        let exact = if unclear { self.exact(&local).ok() } else { None };
        stages.exact = exact.as_ref();
        let (limit_mask, tangent_masks) = (stages.limit_mask(), stages.tangent_masks());
        Ok(BoundaryAnalysis { fan: local.fan, local, halves, cores, spectrum, limit_mask, tangent_masks })
    }

    /// What masks are made of, for a local matrix.
    fn with_stages<T>(&self, local: &FanMatrix, make: impl Fn(&Stages) -> T) -> Result<T, Obstacle> {
        let halves = Halves::of(local.rows.clone(), &local.mirror);
        let cores = Cores::of(&halves);
        let spectrum = Spectrum::of(&halves, &cores)?;
        Ok(make(&Stages { local, halves: &halves, cores: &cores, spectrum: &spectrum, exact: None }))
    }
}
