//! Is every weight of a curve a polynomial of degree 1 at most in a parameter?
//!
//! As an identity: with the parameter left free, a weight f(w) is compared with f(0) + (f(1) - f(0)) w.

use super::forms::{indexed, nowhere};
use super::{CurveScheme, Form, Told};
use crate::fault::Fault;
use crate::numbers::{Field, Laurent};
use crate::scheme::{Place, Placed};

impl CurveScheme {
    /// Whether the weights, and not the number or the place of them, depend on a parameter, and by polynomials of degree 1 at most. A scheme of
    /// halves has no mask, and is not.
    ///
    /// # Errors
    /// When a weight has no value.
    pub fn is_affine_in(&self, name: &str) -> Result<bool, Fault> {
        let at = |value: &str| {
            let mut scheme = self.clone();
            scheme.book.set(name, value).map_err(Fault::whole)?;
            Ok(scheme)
        };
        let mut free = self.clone();
        free.book.parameters.iter_mut().filter(|parameter| parameter.name == name).for_each(|own| own.free = true);
        let (none, one) = (at("0")?, at("1")?);
        let told = |placed: &Placed| placed.formula.names().any(|(used, _)| used == name);
        if self.shape().into_iter().any(told) {
            return Ok(false);
        }
        let weights = [&free, &none, &one].map(CurveScheme::formal_weights);
        let [Ok(Some(free)), Ok(Some(none)), Ok(Some(one))] = weights else {
            return weights.into_iter().find_map(Result::err).map_or(Ok(false), Err);
        };
        let w = Laurent::atom(name);
        let is_affine = |((f, a), b): ((&Laurent, &Laurent), &Laurent)| {
            let line = b.minus(a).and_then(|slope| slope.times(&w)).and_then(|rest| a.plus(&rest));
            line.is_ok_and(|line| line == *f)
        };
        Ok(free.len() == none.len() && free.iter().zip(&none).zip(&one).all(is_affine))
    }

    /// The formulas that say how many weights there are, and where.
    fn shape(&self) -> Vec<&Placed> {
        fn of(told: &Told) -> Option<&Placed> {
            if let Told::Each(_, taps) = told { Some(taps) } else { None }
        }
        let own = match &self.form {
            Form::Mask(told, first) => [of(told), first.as_ref()],
            Form::Average { weights, .. } => [of(weights), None],
            _ => [None, None],
        };
        own.into_iter().flatten().chain(&self.arity).collect()
    }

    /// The weights, or the symbol, with free parameters as names; `None` for halves.
    fn formal_weights(&self) -> Result<Option<Vec<Laurent>>, Fault> {
        let told = match &self.form {
            Form::Mask(told, _) | Form::Average { weights: told, .. } => told,
            Form::Symbol(symbol) => {
                let place =
                    Place { variable: Some("z"), count: 0, value: Laurent::atom("z"), index: Laurent::whole(0) };
                return Ok(Some(vec![self.book.evaluate(symbol, &place)?]));
            }
            Form::Halves { .. } => return Ok(None),
        };
        let weights: Result<Vec<Laurent>, Fault> = match told {
            Told::List(list, _) => list.iter().map(|placed| self.book.evaluate(placed, &nowhere())).collect(),
            Told::Each(formula, taps) => {
                let count = self.whole(taps, 1..super::MAX_TAPS as i64 + 1, "the number of weights")?;
                (0..count).map(|j| self.book.evaluate(formula, &indexed(j, j))).collect()
            }
        };
        weights.map(Some)
    }
}
