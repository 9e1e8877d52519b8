//! How does one whole number stand for a polynomial in several indeterminates?
//!
//! Each indeterminate becomes a whole number, far larger than the powers of the next, so that the coefficients are the
//! digits (balanced about 0) of the value. A question about polynomials becomes one about whole numbers, and an answer is
//! read off the digits (after Kronecker's substitution: von zur Gathen & Gerhard, Modern Computer Algebra, section 8.4).

use crate::numbers::Trouble;
use crate::numbers::polynomial::{Exponents, MAX_BITS, MAX_TERMS, Polynomial, SLOTS, TOO_LARGE, Term};
use dashu_base::{BitTest, DivRemEuclid};
use dashu_int::IBig;
use dashu_ratio::RBig;

/// The most bits of a value.
const MAX_VALUE_BITS: usize = 1 << 19;

/// The bits of the largest coefficient of the primitive part.
pub(crate) fn height_bits(terms: &[Term]) -> usize {
    terms.iter().map(|(_, coefficient)| coefficient.bit_len()).max().unwrap_or(0)
}

/// A substitution.
pub(crate) struct Substitution {
    /// What each indeterminate becomes, the last the smallest; none where it does not occur.
    bases: [Option<IBig>; SLOTS],
    /// How many exponents of each indeterminate have a digit.
    widths: [usize; SLOTS],
}

impl Substitution {
    /// Coefficients of so many bits with their sign, for exponents up to those given. Each base exceeds the powers of the
    /// next without being one: as powers of one base, coprime polynomials such as `n + c` and `n - c^2` would share it.
    ///
    /// # Errors
    /// When the values would be too large.
    pub(crate) fn new(bits: usize, degrees: &[usize; SLOTS], attempt: usize) -> Result<Self, Trouble> {
        let widths = degrees.map(|degree| degree.saturating_add(1));
        let mut bits = bits + 1;
        let mut bases = [const { None }; SLOTS];
        for index in (0..SLOTS).rev().filter(|index| widths[*index] > 1) {
            let next = bits.saturating_mul(widths[index]).saturating_add(2);
            if next > MAX_VALUE_BITS {
                return Err(TOO_LARGE);
            }
            bases[index] = Some((IBig::ONE << bits) + IBig::from(27 + 58 * attempt + 10 * index));
            bits = next + widths[index];
        }
        Ok(Substitution { bases, widths })
    }

    /// More than the number of bits of any value whose digits are in range, where the coefficients have so many bits.
    pub(crate) fn value_bits(&self, bits: usize) -> usize {
        let outermost = self.bases.iter().zip(&self.widths).find_map(|(base, width)| Some((base.as_ref()?, width)));
        outermost.map_or(bits + 1, |(base, width)| base.bit_len() * width + 1)
    }

    /// The value of a sum of terms.
    pub(crate) fn value(&self, terms: &[Term]) -> IBig {
        self.value_from(0, terms)
    }

    fn value_from(&self, index: usize, terms: &[Term]) -> IBig {
        let Some(base) = self.bases.get(index) else {
            return terms.first().map_or(IBig::ZERO, |(_, coefficient)| coefficient.clone());
        };
        let Some(base) = base else { return self.value_from(index + 1, terms) };
        let (mut sum, mut power) = (IBig::ZERO, 0);
        for part in terms.chunk_by(|(p, _), (q, _)| p[index] == q[index]).rev() {
            let exponent = part.first().map_or(0, |(exponents, _)| usize::from(exponents[index]));
            if !sum.is_zero() {
                sum *= base.pow(power - exponent);
            }
            sum += self.value_from(index + 1, part);
            power = exponent;
        }
        sum * base.pow(power)
    }

    /// The polynomial whose value this is, if there is one with digits in range.
    pub(crate) fn polynomial(&self, value: IBig) -> Option<Polynomial> {
        let mut terms = Vec::new();
        self.read(0, value, &mut [0; SLOTS], &mut terms)?;
        Some(Polynomial::of_terms(RBig::ONE, terms))
    }

    fn read(&self, index: usize, mut value: IBig, at: &mut Exponents, terms: &mut Vec<Term>) -> Option<()> {
        let Some(base) = self.bases.get(index) else {
            if value.is_zero() {
                return Some(());
            }
            terms.push((*at, value));
            return (terms.len() <= MAX_TERMS && terms.last()?.1.bit_len() <= MAX_BITS).then_some(());
        };
        let Some(base) = base else { return self.read(index + 1, value, at, terms) };
        for exponent in 0..self.widths[index] {
            if value.is_zero() {
                break;
            }
            let digit = take_digit(&mut value, base);
            if !digit.is_zero() {
                at[index] = u16::try_from(exponent).ok()?;
                self.read(index + 1, digit, at, terms)?;
            }
        }
        at[index] = 0;
        value.is_zero().then_some(())
    }
}

/// Splits off the lowest balanced digit.
fn take_digit(value: &mut IBig, base: &IBig) -> IBig {
    let (mut quotient, digit) = (&*value).div_rem_euclid(base);
    let mut digit = IBig::from(digit);
    if &digit + &digit > *base {
        digit -= base;
        quotient += IBig::ONE;
    }
    *value = quotient;
    digit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::polynomial::tests::{polynomial, small};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn digits_are_the_coefficients(p in small()) {
            let degrees = std::array::from_fn(|index| p.degree_in(index));
            let substitution = Substitution::new(height_bits(p.terms()) + 2, &degrees, 0).unwrap();
            let back = substitution.polynomial(substitution.value(p.terms())).unwrap();
            prop_assert_eq!(back, p.primitive());
        }
    }

    #[test]
    fn values_have_a_largest_size() {
        let p = polynomial(&[(1, 200, 200)]);
        let degrees = std::array::from_fn(|index| p.degree_in(index));
        assert!(Substitution::new(99, &degrees, 0).is_err());
        assert!(Substitution::new(9, &[usize::MAX - 1; SLOTS], 0).is_err());
    }
}
