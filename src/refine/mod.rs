//! How is each new point made from old ones?
//!
//! The one place where weights meet topology: scheme x mesh -> rows of weights. A row on the canonical patch is a row of
//! the local subdivision matrix; rows times positions are the refined mesh ([`Refiner`]).

mod births;
mod compact;
pub mod curve;
mod ends;
mod exact_weights;
mod flatten;
mod gather;
pub mod grid;
mod growth;
mod names;
mod pass;
mod refiner;
mod regular;
mod stencil;
mod steps;
mod symmetry;

pub use exact_weights::{Count, EnclosedWeights, ExactWeights};
pub use flatten::{Flatness, Moves, fan_kinds};
pub use gather::{Coordinate, Point};
pub use growth::Counts;
pub use names::OrbitNames;
pub use pass::{Pass, Weigher};
pub use refiner::{Chain, Refiner};
pub use regular::{CanonicalRows, FanRows, PatchRows, RegularStencils};
pub use stencil::Use;
pub use steps::{Buffers, Level, NotRefinable, Refined, Route, applied, most_ulps};
pub use symmetry::check_symmetry;

use crate::fault::{Fault, Faults};
use crate::mesh::{Canonical, Cycle, Label, Lattice, Placement, Split};
use crate::numbers::{Field, Number, Trouble};
use crate::scheme::{PassRules, RuleBook, RuleSum, Scheme};
use std::fmt;
use std::rc::Rc;

/// A new point as a combination of old ones: in order of the points, none twice, none with weight zero.
pub type Row<P, W> = Vec<(P, W)>;

/// Why a new point can't be made here.
#[derive(Clone, Debug, PartialEq)]
pub enum Obstacle {
    /// A formula has no value at this valence.
    Fault(Fault),
    /// An operation on weights left their world of numbers.
    Trouble(Trouble),
    /// The rule reaches over the boundary of the mesh.
    Boundary(&'static str),
    /// The scheme, or its boundary file, has no rule for such a place.
    NoRule(&'static str),
    /// The request is beyond a stated limit, as said.
    Limit(String),
    /// A formula has a value, but not in this exact world, as said.
    Inexact(Fault),
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Obstacle::Fault(fault) | Obstacle::Inexact(fault) => f.write_str(&fault.message),
            Obstacle::Trouble(trouble) => write!(f, "{trouble}"),
            Obstacle::Boundary(rule) => write!(f, "the rule [{rule}] reaches over the boundary of the mesh"),
            Obstacle::NoRule(rule) => write!(f, "a rule [{rule}] is needed here, and there is none"),
            Obstacle::Limit(what) => f.write_str(what),
        }
    }
}

impl std::error::Error for Obstacle {}

impl From<Fault> for Obstacle {
    fn from(fault: Fault) -> Self {
        Obstacle::Fault(fault)
    }
}

impl From<Trouble> for Obstacle {
    fn from(trouble: Trouble) -> Self {
        Obstacle::Trouble(trouble)
    }
}

/// Checks a scheme as far as it can be checked before its analysis: sums, cases and values ([`Scheme::check`]) and symmetry
/// ([`check_symmetry`]), at the valences asked for.
///
/// # Errors
/// Every fault found.
pub fn check(scheme: &Scheme, valences: &[usize]) -> Result<Vec<RuleSum>, Faults> {
    match (scheme.check(valences), check_symmetry(scheme, valences)) {
        (Ok(sums), Ok(())) => Ok(sums),
        (Ok(_), Err(faults)) | (Err(faults), Ok(())) => Err(faults),
        (Err(mut faults), Err(more)) => {
            let new =
                more.faults.into_iter().filter(|fault| faults.faults.iter().all(|known| known.span != fault.span));
            faults.faults.extend(new.collect::<Vec<_>>());
            Err(faults)
        }
    }
}

/// How the splits of a scheme bring its regular lattice back to itself.
///
/// # Errors
/// When there is no topology for a split, or the lattice does not come back, or is not refined.
pub fn cycle_of(scheme: &Scheme) -> Result<Cycle, Obstacle> {
    let named = |pass: &PassRules| {
        Split::named(pass.split).ok_or_else(|| Obstacle::Limit(format!("the split {} can't be applied", pass.split)))
    };
    let splits: Vec<Split> = scheme.passes().iter().map(named).collect::<Result<_, _>>()?;
    Cycle::of(&splits, scheme.mesh == "triangles").ok_or_else(|| {
        let words = "these splits do not refine the regular lattice and bring it back to itself";
        Obstacle::Limit(format!("{words}: {}", scheme.split_in_words()))
    })
}

/// The regular lattice that a scheme lives on; triangles or quads where there is none.
pub fn lattice_of(scheme: &Scheme) -> Lattice {
    let plain = if scheme.mesh == "triangles" { Lattice::Triangles } else { Lattice::Quads };
    cycle_of(scheme).map_or(plain, |cycle| cycle.lattice())
}

/// Whether the extraordinary points of a scheme are faces: those of dual schemes.
pub fn is_dual(scheme: &Scheme) -> bool {
    !lattice_of(scheme).has_centre()
}

/// A scheme's rules in one world of numbers, ready to be applied to the canonical patch: the passes of as many steps as bring the
/// lattice back to itself.
pub struct Refinement<'a, W> {
    scheme: &'a Scheme,
    passes: Vec<Pass<'a, W>>,
    cycle: Result<Cycle, Obstacle>,
}

impl<'a, W: Number> Refinement<'a, W> {
    /// The scheme's rules, with those of a boundary file where there is one.
    pub fn new(scheme: &'a Scheme, boundary: Option<&'a RuleBook>) -> Self {
        let refinement = Refinement::weighed(scheme, pass::ByFormula);
        match boundary {
            Some(book) => refinement.with_boundary(book),
            None => refinement,
        }
    }
}

impl<'a, W: Field> Refinement<'a, W> {
    /// The scheme's rules, with weights from elsewhere than its formulas alone.
    pub fn weighed(scheme: &'a Scheme, weigher: impl Weigher<W> + 'a) -> Self {
        let cycle = cycle_of(scheme);
        let weigher: Rc<dyn Weigher<W> + 'a> = Rc::new(weigher);
        let told = scheme.passes();
        let placements = cycle.as_ref().map_or(&[][..], |cycle| &cycle.placements);
        let passes = told.iter().cycle().zip(placements);
        let pass = |(told, placement): (&PassRules<'a>, &Placement)| {
            Pass::weighed(scheme, *told, Rc::clone(&weigher)).on(placement.from)
        };
        Refinement { scheme, passes: passes.map(pass).collect(), cycle }
    }

    /// The same with the rules of a boundary file.
    pub fn with_boundary(self, book: &'a RuleBook) -> Self {
        let passes = self.passes.into_iter().map(|pass| pass.with_boundary(book)).collect();
        Refinement { passes, ..self }
    }

    /// The scheme that is refined with.
    pub fn scheme(&self) -> &'a Scheme {
        self.scheme
    }

    /// How its splits bring the lattice back to itself.
    ///
    /// # Errors
    /// As [`cycle_of`].
    pub fn cycle(&self) -> Result<&Cycle, Obstacle> {
        self.cycle.as_ref().map_err(Clone::clone)
    }

    /// Its passes, those of all steps of the cycle.
    pub fn passes(&self) -> &[Pass<'a, W>] {
        &self.passes
    }

    /// The row of the point `label` of the refined patch: how it is made of the points of the coarse one, through all passes.
    ///
    /// # Errors
    /// When a weight has no value, or a rule reaches over a boundary.
    pub fn row<M: Canonical>(&self, mesh: &M, label: Label) -> Result<Row<Label, W>, Obstacle> {
        let cycle = self.cycle()?;
        let mut row = vec![(label, W::whole(1))];
        for (pass, placement) in self.passes.iter().zip(&cycle.placements).rev() {
            let mesh = mesh.before(placement);
            let born = |label: Label| pass.row_at(&mesh, mesh.birth(placement, label));
            row = match row.as_slice() {
                [(only, weight)] if *weight == W::whole(1) => born(*only)?,
                several => {
                    let mut sum = Vec::new();
                    for (label, weight) in several {
                        pass::add_scaled(&mut sum, &born(*label)?, weight)?;
                    }
                    pass::collected(sum)?
                }
            };
        }
        Ok(row)
    }
}
