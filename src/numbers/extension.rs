//! What are numbers made of a root of a polynomial?
//!
//! F(x)/f: polynomials modulo a square-free f, so that x stands for any one root of f. Where f is not irreducible, an
//! element may be zero at some roots and not at others: dividing by it is refused, and the factor of f that it found is kept,
//! so that the question can be asked again for each part (the D5 principle: Della Dora, Dicrescenzo and Duval 1985).

use super::{Field, Trouble, Univariate};
use dashu_ratio::RBig;
use std::cell::RefCell;
use std::rc::Rc;

/// The polynomial that an extension is made with.
#[derive(Debug, PartialEq)]
struct Modulus<F> {
    polynomial: Univariate<F>,
    /// A proper factor, once one was found.
    split: RefCell<Option<Univariate<F>>>,
}

/// A polynomial in a root of f, of smaller degree than f. Elements of the field itself belong to every extension.
#[derive(Clone, Debug, PartialEq)]
pub struct Extension<F> {
    modulus: Option<Rc<Modulus<F>>>,
    value: Univariate<F>,
}

/// Said where f falls into parts.
const SPLITS: Trouble = Trouble::BeyondThisWorld("the polynomial of this root falls into factors");

impl<F: Field> Extension<F> {
    /// The root of f itself.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn root(polynomial: &Univariate<F>) -> Result<Self, Trouble> {
        let x = Univariate::new(vec![F::whole(0), F::whole(1)]);
        let modulus = Modulus { polynomial: polynomial.clone(), split: RefCell::new(None) };
        Extension { modulus: Some(Rc::new(modulus)), value: x }.reduced()
    }

    /// An element of the field.
    pub fn constant(value: F) -> Self {
        Extension { modulus: None, value: Univariate::new(vec![value]) }
    }

    /// The polynomial in the root.
    pub fn value(&self) -> &Univariate<F> {
        &self.value
    }

    /// The proper factor of f that a division found.
    pub fn split(&self) -> Option<Univariate<F>> {
        self.modulus.as_ref()?.split.borrow().clone()
    }

    fn shared(&self, other: &Self) -> Option<Rc<Modulus<F>>> {
        self.modulus.clone().or_else(|| other.modulus.clone())
    }

    fn reduced(self) -> Result<Self, Trouble> {
        let Some(modulus) = &self.modulus else { return Ok(self) };
        if self.value.degree() < modulus.polynomial.degree() {
            return Ok(self);
        }
        let value = self.value.divided(&modulus.polynomial)?.1;
        Ok(Extension { value, ..self })
    }

    fn inverse(&self) -> Result<Self, Trouble> {
        let one = Univariate::new(vec![F::whole(1)]);
        let constant = |value: &F| Ok(Extension::constant(F::whole(1).over(value)?));
        match (self.value.coefficients(), &self.modulus) {
            ([], _) => Err(Trouble::DivisionByZero),
            ([value], _) => constant(value),
            (_, None) => Err(SPLITS),
            (_, Some(modulus)) => {
                let (mut r0, mut r1) = (modulus.polynomial.clone(), self.value.clone());
                let (mut s0, mut s1) = (Univariate::new(vec![]), one);
                while r1.degree().is_some_and(|degree| degree > 0) {
                    let (quotient, rest) = r0.divided(&r1)?;
                    let next = s0.minus(&quotient.times(&s1)?)?;
                    (r0, r1, s0, s1) = (r1, rest, s1, next);
                }
                let Some(unit) = r1.coefficients().first() else {
                    modulus.split.replace(Some(r0.monic()?));
                    return Err(SPLITS);
                };
                let value = s1.scaled(&F::whole(1).over(unit)?)?;
                Extension { modulus: self.modulus.clone(), value }.reduced()
            }
        }
    }
}

impl<F: Field> Field for Extension<F> {
    const EXACT: bool = F::EXACT;

    fn rational(value: &RBig) -> Self {
        Extension::constant(F::rational(value))
    }

    fn negated(&self) -> Self {
        let value = Univariate::new(self.value.coefficients().iter().map(F::negated).collect());
        Extension { modulus: self.modulus.clone(), value }
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        Ok(Extension { modulus: self.shared(other), value: self.value.plus(&other.value)? })
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        Extension { modulus: self.shared(other), value: self.value.times(&other.value)? }.reduced()
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        self.times(&other.inverse()?)
    }

    fn is_certainly_zero(&self) -> bool {
        self.value.degree().is_none()
    }
}
