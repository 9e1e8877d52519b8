//! What does the literature say about a scheme?
//!
//! A claim of a scheme file names a quantity or a property, where it holds, its value and its source. Claims are data:
//! [`crate::verdicts`] compares them with the analysis.

use super::Placed;
use super::formula::Condition;
use std::ops::Range;

/// What a claim is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The subdominant eigenvalue.
    Subdominant,
    /// The largest eigenvalue of frequency 0 after 1 (Doo and Sabin's cup).
    Cup,
    /// The largest eigenvalue of frequency 2 (Doo and Sabin's saddle).
    Saddle,
    /// |mu|/lambda^2 over the full neighbourhood.
    CurvatureRatio,
    /// The weight of each point of a class in the limit mask.
    Limit(String),
    /// That limit surfaces are C1 for generic control points.
    C1,
    /// That limit surfaces are not C1 for generic control points.
    NotC1,
    /// That limit surfaces are C2 for generic control points.
    C2,
}

impl Quantity {
    /// The quantity of a claim's `what`.
    pub fn parse(what: &str) -> Option<Quantity> {
        Some(match what {
            "subdominant" => Quantity::Subdominant,
            "cup" => Quantity::Cup,
            "saddle" => Quantity::Saddle,
            "curvature ratio" => Quantity::CurvatureRatio,
            "C1" => Quantity::C1,
            "not C1" => Quantity::NotC1,
            "C2" => Quantity::C2,
            _ => Quantity::Limit(what.strip_prefix("limit ")?.to_string()),
        })
    }

    /// What `what` may say, for messages.
    pub const WORDS: &str = "`subdominant`, `cup`, `saddle`, `curvature ratio`, `limit POSITION`, `C1`, `not C1`, `C2`";

    /// Whether the claim must give a value under `equals`.
    pub fn has_value(&self) -> bool {
        !matches!(self, Quantity::C1 | Quantity::NotC1 | Quantity::C2)
    }
}

/// What somebody says about a scheme.
#[derive(Clone, Debug)]
pub struct Claim {
    /// As written under `what`.
    pub what: String,
    /// What it is about.
    pub quantity: Quantity,
    /// The valences that it is about; `None` for all.
    pub condition: Option<Condition>,
    /// The value claimed, a formula in n, parameters and names.
    pub equals: Option<Placed>,
    /// Who says so.
    pub sources: Vec<String>,
    /// Where it stands.
    pub span: Range<usize>,
}

/// What a claim of a boundary file is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundaryQuantity {
    /// The largest eigenvalue after 1.
    Subdominant,
    /// The next one, which may be equal to it.
    Second,
    /// The weight of the vertex itself in its limit mask.
    LimitCentre,
    /// That limit surfaces are C1 up to the boundary for generic control points.
    C1,
}

impl BoundaryQuantity {
    /// The quantity of a claim's `what`.
    pub fn parse(what: &str) -> Option<BoundaryQuantity> {
        match what {
            "subdominant" => Some(BoundaryQuantity::Subdominant),
            "second" => Some(BoundaryQuantity::Second),
            "limit centre" => Some(BoundaryQuantity::LimitCentre),
            "C1" => Some(BoundaryQuantity::C1),
            _ => None,
        }
    }

    /// What `what` may say, for messages.
    pub const WORDS: &str = "`subdominant`, `second`, `limit centre`, `C1`";

    /// Whether the claim must give a value under `equals`.
    pub fn has_value(self) -> bool {
        self != BoundaryQuantity::C1
    }
}

/// What somebody says about a boundary file at a kind of vertex.
#[derive(Clone, Debug)]
pub struct BoundaryClaim {
    /// crease, corner or dart.
    pub at: String,
    /// As written under `what`.
    pub what: String,
    /// What it is about.
    pub quantity: BoundaryQuantity,
    /// The numbers of faces that it is about; `None` for all.
    pub condition: Option<Condition>,
    /// The value claimed, a formula in k (at a dart n), parameters and names.
    pub equals: Option<Placed>,
    /// Who says so.
    pub sources: Vec<String>,
    /// Where it stands.
    pub span: Range<usize>,
}
