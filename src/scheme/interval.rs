//! Which values of a parameter does `w=0..1/8` mean?
//!
//! Ends are formulas without names whose values are rational, so that they are exact.

use super::formula::{Formula, Names};
use super::{Place, Scheme};
use crate::numbers::{Laurent, Trouble};
use dashu_int::IBig;
use dashu_ratio::RBig;

/// A parameter from one value to a larger one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interval {
    /// The parameter's name.
    pub name: String,
    /// The lower end.
    pub from: RBig,
    /// The upper end.
    pub to: RBig,
}

/// Formulas without names.
struct NoNames;

impl Names<Laurent> for NoNames {
    fn value(&self, _: &str) -> Result<Laurent, Trouble> {
        Err(Trouble::Domain("a name has no value here"))
    }
}

/// The rational value of a formula without names.
fn rational(text: &str) -> Result<RBig, String> {
    let formula = Formula::parse(text.trim()).map_err(|fault| format!("`{}`: {}", text.trim(), fault.message))?;
    if let Some((name, _)) = formula.names().next() {
        return Err(format!("`{}`: an end is a number, and `{name}` is a name", text.trim()));
    }
    let value = formula.evaluate(&NoNames).map_err(|failure| format!("`{}`: {}", text.trim(), failure.trouble))?;
    value.as_constant().ok_or_else(|| format!("`{}` is not a rational number, such as 1/8 or 0.125", text.trim()))
}

impl Interval {
    /// Reads `w=0..1/8`.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &str) -> Result<Interval, String> {
        let shape = || format!("`{text}` is not of the form name=low..high, for example w=0..1/8");
        let (name, ends) = text.split_once('=').ok_or_else(shape)?;
        let (from, to) = ends.split_once("..").ok_or_else(shape)?;
        if name.trim().is_empty() || from.trim().is_empty() || to.trim().is_empty() {
            return Err(shape());
        }
        let (from, to) = (rational(from)?, rational(to)?);
        if from >= to {
            return Err(format!("`{text}` does not run upwards: {from} is not less than {to}"));
        }
        Ok(Interval { name: name.trim().to_string(), from, to })
    }

    /// The value after so many of `steps` equal steps.
    pub fn at(&self, step: usize, steps: usize) -> RBig {
        let part = RBig::from(IBig::from(step)) / RBig::from(IBig::from(steps.max(1)));
        &self.from + (&self.to - &self.from) * part
    }
}

impl Scheme {
    /// Whether a parameter may take the values of an interval.
    ///
    /// # Errors
    /// When there is no such parameter, it must be a whole number, or an end is outside its range.
    pub fn admits(&self, interval: &Interval) -> Result<(), String> {
        let name = &interval.name;
        let parameter = self.parameter(name)?;
        if parameter.integer {
            return Err(format!(
                "`{name}` must be a whole number; analyse its values one by one with --set {name}=..."
            ));
        }
        let Some((low, high)) = &parameter.range else { return Ok(()) };
        let value = |placed: &super::Placed| self.book.evaluate(placed, &Place::<f64>::at(None, 0)).ok();
        let outside = |end: f64| {
            value(low).is_some_and(|low| end < low - 1e-12) || value(high).is_some_and(|high| end > high + 1e-12)
        };
        if outside(interval.from.to_f64().value()) || outside(interval.to.to_f64().value()) {
            let (low, high) = (low.formula.text().trim(), high.formula.text().trim());
            return Err(format!("`{name}` may be from {low} to {high}, not from {} to {}", interval.from, interval.to));
        }
        Ok(())
    }
}
