//! Which of two real algebraic numbers is larger, or are they equal?
//!
//! A number is told by a polynomial over the field at hand and an enclosure that holds just one of its roots. Disjoint
//! enclosures decide; where they overlap, equality is decided by algebra: both numbers are one root of the greatest common
//! divisor of their polynomials, or they are not equal.

use super::roots::{Root, roots};
use super::{Enclosure, Field, Trouble, Univariate};
use std::cmp::Ordering;

/// The enclosure of an element of the field.
pub type Embedding<'a, F, const BITS: usize> = &'a dyn Fn(&F) -> Result<Enclosure<BITS>, Trouble>;

/// A real number: the only root of `polynomial` in `value`. Without a polynomial only the enclosure is known.
#[derive(Clone, Debug)]
pub struct RealRoot<F, const BITS: usize> {
    /// A polynomial that has the number as a root.
    pub polynomial: Option<Univariate<F>>,
    /// The number, enclosed.
    pub value: Enclosure<BITS>,
}

impl<F: Field, const BITS: usize> RealRoot<F, BITS> {
    /// An element of the field.
    ///
    /// # Errors
    /// When it is too large to be enclosed.
    pub fn element(value: &F, embedding: Embedding<F, BITS>) -> Result<Self, Trouble> {
        let polynomial = Univariate::new(vec![value.negated(), F::whole(1)]);
        Ok(RealRoot { polynomial: Some(polynomial), value: embedding(value)? })
    }

    /// Its square: the roots of f(x) f(-x), a polynomial in x^2 (Graeffe).
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn squared(&self) -> Result<Self, Trouble> {
        let polynomial = match &self.polynomial {
            Some(polynomial) if F::EXACT => Some(of_squares(polynomial)?),
            _ => None,
        };
        Ok(RealRoot { polynomial, value: self.value.square()? })
    }

    /// Order; `None` where enclosures and algebra don't tell.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn compare(&self, other: &Self, embedding: Embedding<F, BITS>) -> Result<Option<Ordering>, Trouble> {
        if let Some(order) = self.value.compare(&other.value) {
            return Ok(Some(order));
        }
        let (Some(f), Some(g), true) = (&self.polynomial, &other.polynomial, F::EXACT) else { return Ok(None) };
        let common = f.gcd(g)?;
        if !self.is_root_of(&common, f, embedding)? || !other.is_root_of(&common, g, embedding)? {
            return Ok(None);
        }
        let both = self.value.hull(&other.value);
        let near = |root: &&Root<BITS>| root.re.overlaps(&both) && root.im.sign().is_none_or(Ordering::is_eq);
        let found = roots_of(&common, embedding)?;
        let mut near = found.iter().filter(near);
        let single = near.next().is_some_and(|root| root.count == 1) && near.next().is_none();
        Ok(single.then_some(Ordering::Equal))
    }

    /// Whether the number is certainly a root of a divisor of its polynomial: the cofactor has none here.
    fn is_root_of(
        &self,
        divisor: &Univariate<F>,
        own: &Univariate<F>,
        embedding: Embedding<F, BITS>,
    ) -> Result<bool, Trouble> {
        if divisor.degree().is_none_or(|degree| degree == 0) {
            return Ok(false);
        }
        let cofactor = own.divided(divisor)?.0;
        let mut value = Enclosure::whole(0);
        for coefficient in cofactor.coefficients().iter().rev() {
            value = value.times(&self.value)?.plus(&embedding(coefficient)?)?;
        }
        Ok(value.sign().is_some_and(Ordering::is_ne))
    }
}

/// The monic polynomial whose roots are the squares of this one's, made square-free.
///
/// # Errors
/// When a limit of size is passed.
pub fn of_squares<F: Field>(polynomial: &Univariate<F>) -> Result<Univariate<F>, Trouble> {
    let product = polynomial.times(&polynomial.at_negative())?;
    let even = product.coefficients().iter().step_by(2).cloned().collect();
    let squares = Univariate::new(even).monic()?;
    let repeated = squares.gcd(&squares.derivative()?)?;
    if repeated.degree() == Some(0) { Ok(squares) } else { squares.divided(&repeated)?.0.monic() }
}

/// The roots of a polynomial over the field.
///
/// # Errors
/// When they can't be enclosed.
pub fn roots_of<F: Field, const BITS: usize>(
    polynomial: &Univariate<F>,
    embedding: Embedding<F, BITS>,
) -> Result<Vec<Root<BITS>>, Trouble> {
    let coefficients: Vec<Enclosure<BITS>> =
        polynomial.coefficients().iter().map(embedding).collect::<Result<_, _>>()?;
    roots(&coefficients)
}
