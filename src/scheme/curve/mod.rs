//! What is a subdivision scheme for curves?
//!
//! A mask of weights on the line, told by a file in one of four forms: as the mask itself, as its symbol, as a split at midpoints and
//! an average, or as the two halves of a polygon (de Casteljau). Whatever the form, [`CurveScheme::rules`] gives exact weights.
//! The forms are those of Dyn and Levin ("Subdivision schemes in geometric modelling", 2002) and Lane and Riesenfeld (1980).

mod affine;
mod claim;
mod ends;
mod forms;
mod halves;
mod mask;

pub use claim::{CurveClaim, CurveQuantity};
pub use ends::Ends;
pub use halves::Halves;
pub use mask::Mask;

use super::{Placed, RuleBook};
use crate::fault::{Fault, Faults};
use std::ops::Range;

/// The largest number of new points for an old one.
pub const MAX_ARITY: u32 = 16;

/// The most weights of a mask.
pub const MAX_TAPS: usize = 512;

/// The farthest index of a mask from 0.
pub const MAX_OFFSET: i64 = 10_000;

/// The most points of a polygon that is halved.
pub const MAX_HALVES: usize = 64;

/// A list of weights: a formula for each, or one formula in j for so many.
#[derive(Clone, Debug)]
pub enum Told {
    /// A formula for each weight.
    List(Vec<Placed>, Range<usize>),
    /// One formula, in which `j` is the index from 0, and the number of weights.
    Each(Placed, Placed),
}

impl Told {
    /// Where it stands in the file.
    pub fn span(&self) -> Range<usize> {
        match self {
            Told::List(_, span) => span.clone(),
            Told::Each(formula, _) => formula.span.clone(),
        }
    }
}

/// The form in which a file tells a scheme.
#[derive(Clone, Debug)]
pub enum Form {
    /// The mask, and its first index; centred where that is left out.
    Mask(Told, Option<Placed>),
    /// The symbol, a formula in z.
    Symbol(Placed),
    /// Split at midpoints, then average by weights that are centred.
    Average {
        /// The averaging weights.
        weights: Told,
        /// Whether only the midpoints are averaged, and old points stay.
        midpoints_only: bool,
    },
    /// Two polygons of as many points take the place of one: formulas in i (the new point) and j (the old one).
    Halves {
        /// The weights of the first half and of the second.
        halves: [Placed; 2],
        /// The number of points of the polygon.
        points: Placed,
    },
}

/// The rules at the ends of an open curve as a file tells them.
#[derive(Clone, Debug)]
pub struct EndRules {
    /// The weights of the first new points, told from the end on.
    pub rules: Vec<(Vec<Placed>, Range<usize>)>,
    /// The index of the first new point that the mask makes after them; the first that can be made, where that is left out.
    pub then: Option<Placed>,
}

/// A subdivision scheme for curves.
#[derive(Clone, Debug)]
pub struct CurveScheme {
    /// Its short name: the file's name without its ending.
    pub id: String,
    /// Title, sources, parameters and named formulas; a curve has no rules on meshes.
    pub book: RuleBook,
    /// How many new points come for an old one.
    pub arity: Option<Placed>,
    /// How it is told.
    pub form: Form,
    /// What is done at the ends of an open curve.
    pub ends: Option<EndRules>,
    /// What the literature says about it.
    pub claims: Vec<CurveClaim>,
}

/// The exact weights of a scheme at the values of its parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rules {
    /// A mask, everywhere the same, perhaps with rules at ends.
    Mask(Mask, Option<Ends>),
    /// Two matrices that halve a polygon.
    Halves(Halves),
}

impl CurveScheme {
    /// The exact weights, checked: parameters in their ranges, sums of 1, limits of size.
    ///
    /// # Errors
    /// Every fault found.
    pub fn rules(&self) -> Result<Rules, Faults> {
        let faults: Vec<Fault> = self.book.parameter_faults();
        if !faults.is_empty() {
            return Err(self.book.faults(faults));
        }
        self.exact_rules().map_err(|faults| self.book.faults(faults))
    }

    /// The mask.
    ///
    /// # Errors
    /// As [`CurveScheme::rules`]; also where the scheme halves polygons and has no mask.
    pub fn mask(&self) -> Result<Mask, Faults> {
        match self.rules()? {
            Rules::Mask(mask, _) => Ok(mask),
            Rules::Halves(_) => Err(self.book.faults(vec![Fault::whole("a scheme of halves has no mask")])),
        }
    }

    /// Whether a claim is made for the values of the parameters.
    ///
    /// # Errors
    /// When its condition has no value.
    pub fn claim_is_made(&self, claim: &CurveClaim) -> Result<bool, Fault> {
        let Some(condition) = &claim.condition else { return Ok(true) };
        self.book.holds(condition, &claim.span, None, 0)
    }

    /// The word for its form, for people.
    pub fn form_word(&self) -> &'static str {
        match self.form {
            Form::Mask(..) => "mask",
            Form::Symbol(_) => "symbol",
            Form::Average { .. } => "split and average",
            Form::Halves { .. } => "halves",
        }
    }
}
