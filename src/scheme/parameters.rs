//! Which parameters of a scheme are numbers, and which are left free?
//!
//! A parameter that is left free stands for itself where numbers are exact, as n does; approximate numbers, and the exact ones at a
//! single valence, take its value.

use super::formula::Formula;
use super::{Parameter, Place, Placed, Scheme};
use crate::fault::nearest;
use crate::numbers::{Laurent, MOST_PARAMETERS};
use dashu_ratio::RBig;

impl Scheme {
    /// The parameter of a name.
    ///
    /// # Errors
    /// That there is none, with the nearest name that there is.
    pub fn parameter(&self, name: &str) -> Result<&Parameter, String> {
        let known: Vec<&str> = self.book.parameters.iter().map(|p| p.name.as_str()).collect();
        self.book.parameters.iter().find(|p| p.name == name).ok_or_else(|| {
            let title = &self.book.title;
            if known.is_empty() {
                return format!("{title} has no parameters, so there is no `{name}`");
            }
            let hint = match nearest(name, known.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("it has {}", known.join(", ")),
            };
            format!("{title} has no parameter `{name}`\n  help: {hint}")
        })
    }

    /// Leaves a parameter free.
    ///
    /// # Errors
    /// When there is no such parameter, it must be a whole number, or too many are free.
    pub fn leave_free(&mut self, name: &str) -> Result<(), String> {
        if self.parameter(name)?.integer {
            return Err(format!("`{name}` must be a whole number, so it can't be left free\n  help: give it a value"));
        }
        if !self.free_parameters().contains(&name) && self.free_parameters().len() >= MOST_PARAMETERS {
            return Err(format!("at most {MOST_PARAMETERS} parameters may be left free, and `{name}` is one more"));
        }
        self.book.parameters.iter_mut().filter(|p| p.name == name).for_each(|p| p.free = true);
        Ok(())
    }

    /// The names of the parameters that are left free, in the file's order.
    pub fn free_parameters(&self) -> Vec<&str> {
        self.book.parameters.iter().filter(|p| p.free).map(|p| p.name.as_str()).collect()
    }

    /// The scheme with every parameter at its value.
    #[must_use]
    pub fn with_values(&self) -> Scheme {
        let mut scheme = self.clone();
        scheme.book.parameters.iter_mut().for_each(|p| p.free = false);
        scheme
    }

    /// The scheme with another value for a parameter: a formula without names.
    ///
    /// # Errors
    /// When it is not such a formula; its value is not looked at.
    pub fn with_value(&self, name: &str, value: &str) -> Result<Scheme, String> {
        let formula = Formula::parse(value).map_err(|fault| fault.message)?;
        let mut scheme = self.clone();
        for parameter in scheme.book.parameters.iter_mut().filter(|p| p.name == name) {
            parameter.value = Placed { formula: formula.clone(), span: parameter.span.clone(), start: None };
            parameter.free = false;
        }
        Ok(scheme)
    }

    /// The value of a parameter, if it is rational.
    pub fn rational_value(&self, name: &str) -> Option<RBig> {
        let parameter = self.book.parameters.iter().find(|p| p.name == name)?;
        self.book.evaluate(&parameter.value, &Place::<Laurent>::at(None, 0)).ok()?.as_constant()
    }

    /// The scheme with free parameters at numbers near their values that no weight is made for: no weight vanishes there that
    /// does not vanish everywhere, as far as chance tells.
    pub(crate) fn with_odd_values(&self) -> Scheme {
        let mut scheme = self.with_values();
        for (index, name) in self.free_parameters().into_iter().enumerate() {
            let parameter = scheme.book.parameters.iter().find(|p| p.name == name);
            let value = parameter.and_then(|p| self.book.evaluate(&p.value, &Place::<f64>::at(None, 0)).ok());
            let odd = format!("{:?}", value.unwrap_or(0.0) + 0.000_123_456_7 * (index as f64 + 1.376));
            scheme = scheme.with_value(name, &odd).unwrap_or(scheme);
        }
        scheme
    }
}

impl super::RuleBook {
    /// Whether a condition of a case depends on a parameter, perhaps through names.
    pub(crate) fn conditions_depend_on(&self, parameter: &str) -> bool {
        let mut dependent = vec![parameter.to_string()];
        for _ in 0..self.lets.len() {
            for named in self.lets.iter().filter(|named| !dependent.contains(&named.name)).collect::<Vec<_>>() {
                let formulas = named.value.values().into_iter().flat_map(|placed| placed.formula.names());
                let conditions = named.value.conditions().into_iter().flat_map(|(condition, _)| condition.names());
                if formulas.chain(conditions).any(|(name, _)| dependent.iter().any(|own| own == name)) {
                    dependent.push(named.name.clone());
                }
            }
        }
        self.condition_names().iter().any(|name| dependent.contains(name))
    }
}
