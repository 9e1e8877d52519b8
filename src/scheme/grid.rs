//! What is a tensor product of two schemes for curves?
//!
//! Rows of a grid are refined by one scheme and columns by the other; the weights are products. The factors are schemes of the
//! catalogue, with values of their parameters.

use super::curve::CurveScheme;
use super::{Place, Placed, RuleBook, catalogue};
use crate::fault::{Fault, Faults};
use crate::numbers::Laurent;
use std::ops::Range;

/// One factor of a product.
#[derive(Clone, Debug)]
pub struct Factor {
    /// A scheme of the catalogue.
    pub scheme: String,
    /// Values of its parameters.
    pub settings: Vec<(String, Placed)>,
    /// Where it is named.
    pub span: Range<usize>,
}

/// A tensor-product scheme on grids.
#[derive(Clone, Debug)]
pub struct GridScheme {
    /// Its short name: the file's name without its ending.
    pub id: String,
    /// Title, sources and parameters.
    pub book: RuleBook,
    /// The scheme along the first index of the grid, and along the second.
    pub factors: [Factor; 2],
}

impl GridScheme {
    /// The two schemes at the values of their parameters.
    ///
    /// # Errors
    /// Faults of parameters, in this file.
    pub fn curves(&self) -> Result<[CurveScheme; 2], Faults> {
        let faults = self.book.parameter_faults();
        if !faults.is_empty() {
            return Err(self.book.faults(faults));
        }
        let [first, second] = &self.factors;
        Ok([self.curve(first)?, self.curve(second)?])
    }

    fn curve(&self, factor: &Factor) -> Result<CurveScheme, Faults> {
        let wrong = |fault: Fault| self.book.faults(vec![fault]);
        let missing = || wrong(Fault::at(factor.span.clone(), format!("there is no scheme `{}`", factor.scheme), ""));
        let mut curve = catalogue::curve(&factor.scheme).ok_or_else(missing)??;
        for (name, placed) in &factor.settings {
            let value = self.book.evaluate::<Laurent>(placed, &Place::at(None, 0)).map_err(wrong)?;
            let at = |message: String| wrong(Fault::at(placed.span.clone(), message, ""));
            let value = value.as_constant().ok_or_else(|| at(format!("`{name}` is not a rational number")))?;
            curve.book.set(name, &value.to_string()).map_err(at)?;
        }
        Ok(curve)
    }
}
