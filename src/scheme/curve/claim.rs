//! What does the literature say about a scheme for curves?

use crate::scheme::Placed;
use crate::scheme::formula::Condition;
use std::ops::Range;

/// What a claim about a curve is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CurveQuantity {
    /// That limit curves are k times continuously differentiable.
    Continuity(u32),
    /// The largest k of C^k.
    Order,
    /// The Hoelder exponent of the basic limit function.
    Hoelder,
    /// The largest degree of polynomials that are limit curves.
    Generation,
    /// The largest degree of polynomials that are reproduced from their samples.
    Reproduction,
}

impl CurveQuantity {
    /// What `what` may say, for messages.
    pub const WORDS: &str = "`C0`, `C1`, ..., `continuity`, `hoelder`, `generation degree`, `reproduction degree`";

    /// The quantity of a claim's `what`.
    pub fn parse(what: &str) -> Option<CurveQuantity> {
        Some(match what {
            "continuity" => CurveQuantity::Order,
            "hoelder" => CurveQuantity::Hoelder,
            "generation degree" => CurveQuantity::Generation,
            "reproduction degree" => CurveQuantity::Reproduction,
            _ => {
                let digits = what.strip_prefix('C').filter(|d| d.len() <= 2 && d.chars().all(|c| c.is_ascii_digit()));
                CurveQuantity::Continuity(digits?.parse().ok()?)
            }
        })
    }

    /// Whether the claim must give a value under `equals`.
    pub fn has_value(&self) -> bool {
        !matches!(self, CurveQuantity::Continuity(_))
    }
}

/// What somebody says about a scheme for curves.
#[derive(Clone, Debug)]
pub struct CurveClaim {
    /// As written under `what`.
    pub what: String,
    /// What it is about.
    pub quantity: CurveQuantity,
    /// The values of parameters that it is made for; `None` for all.
    pub condition: Option<Condition>,
    /// The value claimed, a formula in parameters and names.
    pub equals: Option<Placed>,
    /// Who says so.
    pub sources: Vec<String>,
    /// Where it stands.
    pub span: Range<usize>,
}
