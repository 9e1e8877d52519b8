//! How are polynomials in one unknown over a field of numbers computed with?
//!
//! Characteristic polynomials by Berkowitz (1984), which divides by nothing and skips what is zero; greatest common
//! divisors and resultants by Euclid; repeated factors by Yun (1976).

use crate::numbers::{Field, Trouble};

/// A polynomial in one unknown; the coefficients low to high, without zeros at the end.
#[derive(Clone, Debug, PartialEq)]
pub struct Univariate<F>(Vec<F>);

impl<F: Field> Univariate<F> {
    /// The polynomial with these coefficients, low to high.
    pub fn new(mut coefficients: Vec<F>) -> Self {
        while coefficients.last().is_some_and(F::is_certainly_zero) {
            coefficients.pop();
        }
        Univariate(coefficients)
    }

    /// A constant.
    pub fn constant(value: F) -> Self {
        Univariate::new(vec![value])
    }

    /// The degree; none for zero.
    pub fn degree(&self) -> Option<usize> {
        self.0.len().checked_sub(1)
    }

    /// The coefficients, low to high; the last is not zero.
    pub fn coefficients(&self) -> &[F] {
        &self.0
    }

    /// The coefficient of the highest power; none for zero.
    pub fn leading(&self) -> Option<&F> {
        self.0.last()
    }

    /// Whether this is zero.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// `self + other`
    ///
    /// # Errors
    /// When a coefficient is beyond its world.
    pub fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        let (long, short) = if self.0.len() < other.0.len() { (other, self) } else { (self, other) };
        let mut sum = long.0.clone();
        for (slot, value) in sum.iter_mut().zip(&short.0) {
            *slot = slot.plus(value)?;
        }
        Ok(Univariate::new(sum))
    }

    /// `self - other`
    ///
    /// # Errors
    /// When a coefficient is beyond its world.
    pub fn minus(&self, other: &Self) -> Result<Self, Trouble> {
        self.plus(&Univariate(other.0.iter().map(F::negated).collect()))
    }

    /// `self * other`
    ///
    /// # Errors
    /// When a coefficient is beyond its world.
    pub fn times(&self, other: &Self) -> Result<Self, Trouble> {
        if self.is_zero() || other.is_zero() {
            return Ok(Univariate(Vec::new()));
        }
        let mut product = vec![F::whole(0); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            add_multiple(&mut product[i..], &other.0, a)?;
        }
        Ok(Univariate::new(product))
    }

    /// `self ^ exponent`
    ///
    /// # Errors
    /// When a coefficient is beyond its world.
    pub fn power(&self, exponent: usize) -> Result<Self, Trouble> {
        (0..exponent).try_fold(Univariate::constant(F::whole(1)), |power, _| power.times(self))
    }

    /// `factor * self`
    ///
    /// # Errors
    /// When a coefficient is beyond its world.
    pub fn scaled(&self, factor: &F) -> Result<Self, Trouble> {
        Ok(Univariate::new(self.0.iter().map(|value| value.times(factor)).collect::<Result<_, _>>()?))
    }

    /// The quotient and the remainder of the division by `other`.
    ///
    /// # Errors
    /// When `other` is zero, or a coefficient is beyond its world.
    pub fn divided(&self, other: &Self) -> Result<(Self, Self), Trouble> {
        let leading = other.leading().ok_or(Trouble::DivisionByZero)?;
        let mut rest = self.0.clone();
        let mut quotient = Vec::new();
        while rest.len() >= other.0.len() {
            let Some(factor) = rest.pop().map(|highest| highest.over(leading)).transpose()? else { break };
            let start = rest.len() + 1 - other.0.len();
            add_multiple(&mut rest[start..], &other.0[..other.0.len() - 1], &factor.negated())?;
            quotient.push(factor);
        }
        quotient.reverse();
        Ok((Univariate::new(quotient), Univariate::new(rest)))
    }

    /// The multiple with leading coefficient 1; zero stays zero.
    ///
    /// # Errors
    /// When a coefficient is beyond its world.
    pub fn monic(&self) -> Result<Self, Trouble> {
        let Some((leading, lower)) = self.0.split_last() else { return Ok(self.clone()) };
        let one = F::whole(1);
        if *leading == one {
            return Ok(self.clone());
        }
        let mut coefficients = lower.iter().map(|value| value.over(leading)).collect::<Result<Vec<_>, _>>()?;
        coefficients.push(one);
        Ok(Univariate(coefficients))
    }

    /// The greatest common divisor, monic; zero if both are zero.
    ///
    /// # Errors
    /// When a coefficient is beyond its world.
    pub fn gcd(&self, other: &Self) -> Result<Self, Trouble> {
        let (mut a, mut b) = (self.monic()?, other.monic()?);
        while !b.is_zero() {
            let rest = a.divided(&b)?.1.monic()?;
            (a, b) = (b, rest);
        }
        Ok(a)
    }

    /// The derivative.
    ///
    /// # Errors
    /// When a coefficient is beyond its world.
    pub fn derivative(&self) -> Result<Self, Trouble> {
        let factors = (0i64..).map(F::whole);
        let terms = self.0.iter().zip(factors).skip(1).map(|(value, factor)| value.times(&factor));
        Ok(Univariate::new(terms.collect::<Result<_, _>>()?))
    }

    /// The value at a number.
    ///
    /// # Errors
    /// When it is beyond its world.
    pub fn evaluate(&self, at: &F) -> Result<F, Trouble> {
        self.0.iter().rev().try_fold(F::whole(0), |sum, value| sum.times(at)?.plus(value))
    }

    /// The polynomial with the images of the coefficients.
    ///
    /// # Errors
    /// When a coefficient has none.
    pub fn mapped<G: Field>(&self, image: impl Fn(&F) -> Result<G, Trouble>) -> Result<Univariate<G>, Trouble> {
        Ok(Univariate::new(self.0.iter().map(image).collect::<Result<_, _>>()?))
    }

    /// p(x^2)
    pub fn composed_with_square(&self) -> Self {
        let spread = self.0.iter().flat_map(|value| [value.clone(), F::whole(0)]);
        Univariate::new(spread.collect())
    }

    /// p(-x)
    pub fn at_negative(&self) -> Self {
        let signed = self.0.iter().enumerate();
        Univariate(signed.map(|(i, value)| if i % 2 == 1 { value.negated() } else { value.clone() }).collect())
    }

    /// Coprime monic polynomials without repeated factors, by ascending multiplicity; with the leading coefficient, the
    /// product of their powers is this. Zero and constants have none.
    ///
    /// # Errors
    /// When a coefficient is beyond its world.
    pub fn squarefree(&self) -> Result<Vec<(Self, usize)>, Trouble> {
        let p = self.monic()?;
        let derivative = p.derivative()?;
        let repeated = p.gcd(&derivative)?;
        let mut factors = Vec::new();
        if repeated.is_zero() {
            return Ok(factors);
        }
        let (mut b, mut c) = (p.divided(&repeated)?.0, derivative.divided(&repeated)?.0);
        for multiplicity in 1..=p.0.len() {
            if b.0.len() <= 1 {
                break;
            }
            let d = c.minus(&b.derivative()?)?;
            let factor = b.gcd(&d)?;
            (b, c) = (b.divided(&factor)?.0, d.divided(&factor)?.0);
            if factor.0.len() > 1 {
                factors.push((factor, multiplicity));
            }
        }
        Ok(factors)
    }

    /// The resultant: zero exactly where both have a common root. That of zero and anything is zero.
    ///
    /// # Errors
    /// When a coefficient is beyond its world.
    pub fn resultant(&self, other: &Self) -> Result<F, Trouble> {
        let (mut a, mut b, mut factor) = (self.clone(), other.clone(), F::whole(1));
        loop {
            let (Some(m), Some(n), Some(leading)) = (a.degree(), b.degree(), b.leading()) else {
                return Ok(F::whole(0));
            };
            if n == 0 {
                return factor.times(&raised(leading, m)?);
            }
            let rest = a.divided(&b)?.1;
            let Some(k) = rest.degree() else { return Ok(F::whole(0)) };
            factor = factor.times(&raised(leading, m - k)?)?;
            if m % 2 == 1 && n % 2 == 1 {
                factor = factor.negated();
            }
            (a, b) = (b, rest);
        }
    }

    /// det(x - A) of a square matrix, by its rows.
    ///
    /// # Errors
    /// When the matrix is not square, or a coefficient is beyond its world.
    pub fn characteristic(matrix: &[Vec<F>]) -> Result<Self, Trouble> {
        if matrix.iter().any(|row| row.len() != matrix.len()) {
            return Err(Trouble::Domain("the matrix is not square"));
        }
        let mut high_first = vec![F::whole(1)];
        for size in 0..matrix.len() {
            high_first = bordered(matrix, size, &high_first)?;
        }
        high_first.reverse();
        Ok(Univariate(high_first))
    }
}

fn raised<F: Field>(base: &F, exponent: usize) -> Result<F, Trouble> {
    (0..exponent).try_fold(F::whole(1), |power, _| power.times(base))
}

/// Adds a multiple of the values to the slots, from the first on.
fn add_multiple<F: Field>(slots: &mut [F], values: &[F], factor: &F) -> Result<(), Trouble> {
    if factor.is_certainly_zero() {
        return Ok(());
    }
    for (slot, value) in slots.iter_mut().zip(values) {
        if !value.is_certainly_zero() {
            *slot = slot.plus(&factor.times(value)?)?;
        }
    }
    Ok(())
}

/// The sum of the products.
fn dot<F: Field>(a: &[F], b: &[F]) -> Result<F, Trouble> {
    let mut sum = F::whole(0);
    for (x, y) in a.iter().zip(b).filter(|(x, y)| !x.is_certainly_zero() && !y.is_certainly_zero()) {
        sum = sum.plus(&x.times(y)?)?;
    }
    Ok(sum)
}

/// The characteristic polynomial of the leading block with one more row and column, high to low: Berkowitz's product
/// with the Toeplitz matrix of 1, -a, -R C, -R A C, -R A^2 C, ...
fn bordered<F: Field>(matrix: &[Vec<F>], size: usize, inner: &[F]) -> Result<Vec<F>, Trouble> {
    let row = &matrix[size][..size];
    let mut column: Vec<F> = matrix[..size].iter().map(|row| row[size].clone()).collect();
    let mut toeplitz = vec![F::whole(1), matrix[size][size].negated()];
    while toeplitz.len() < size + 2 {
        toeplitz.push(dot(row, &column)?.negated());
        column = matrix[..size].iter().map(|row| dot(row, &column)).collect::<Result<_, _>>()?;
    }
    let mut product = vec![F::whole(0); size + 2];
    for (i, value) in inner.iter().enumerate() {
        add_multiple(&mut product[i..], &toeplitz, value)?;
    }
    Ok(product)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::free::Free;
    use crate::numbers::free::tests::fraction;
    use crate::numbers::polynomial::tests::ratio;
    use proptest::prelude::*;

    fn of(values: &[i64]) -> Univariate<Free> {
        Univariate::new(values.iter().map(|value| Free::whole(*value)).collect())
    }

    fn small() -> impl Strategy<Value = Univariate<Free>> {
        proptest::collection::vec(-4i64..5, 0..5).prop_map(|values| of(&values))
    }

    proptest! {
        #[test]
        fn division_and_divisors(f in small(), g in small(), h in small()) {
            let (a, b) = (f.times(&h).unwrap(), g.times(&h).unwrap());
            if !b.is_zero() {
                let (quotient, rest) = f.divided(&b).unwrap();
                prop_assert_eq!(quotient.times(&b).unwrap().plus(&rest).unwrap(), f);
                prop_assert!(rest.degree() < b.degree());
                let divisor = a.gcd(&b).unwrap();
                prop_assert!(a.divided(&divisor).unwrap().1.is_zero());
                prop_assert!(divisor.divided(&h).unwrap().1.is_zero());
                let common = divisor.degree() > Some(0);
                prop_assert_eq!(a.resultant(&b).unwrap().is_certainly_zero(), common || a.is_zero());
            }
        }

        #[test]
        fn squarefree_parts_multiply_back(f in small(), g in small()) {
            let p = f.times(&g.power(2).unwrap()).unwrap();
            let parts = p.squarefree().unwrap();
            let one = Univariate::constant(p.leading().cloned().unwrap_or(Free::whole(0)));
            let product = parts.iter().fold(one, |all, (q, m)| all.times(&q.power(*m).unwrap()).unwrap());
            prop_assert_eq!(product, p);
        }

        #[test]
        fn characteristic_polynomials_of_triangles(d in proptest::collection::vec(-4i64..5, 4), u in fraction()) {
            let entry = |i: usize, j: usize| match i.cmp(&j) {
                std::cmp::Ordering::Equal => Free::whole(d[i]),
                std::cmp::Ordering::Less => u.clone(),
                std::cmp::Ordering::Greater => Free::whole(0),
            };
            let matrix: Vec<Vec<Free>> = (0..4).map(|i| (0..4).map(|j| entry(i, j)).collect()).collect();
            let product = d.iter().fold(of(&[1]), |all, root| all.times(&of(&[-root, 1])).unwrap());
            prop_assert_eq!(Univariate::characteristic(&matrix).unwrap(), product);
        }
    }

    #[test]
    fn a_full_matrix() {
        let rows = [[2, -1, 3], [4, 0, 5], [-2, 7, 1]];
        let matrix: Vec<Vec<Free>> = rows.iter().map(|row| row.map(Free::whole).to_vec()).collect();
        assert_eq!(Univariate::characteristic(&matrix), Ok(of(&[-28, -23, -3, 1])));
        assert_eq!(Univariate::<Free>::characteristic(&[]), Ok(of(&[1])));
        assert!(Univariate::characteristic(&matrix[..2]).is_err());
    }

    #[test]
    fn small_operations() {
        let p = of(&[1, 2, 3]);
        assert_eq!(p.composed_with_square(), of(&[1, 0, 2, 0, 3]));
        assert_eq!(p.at_negative(), of(&[1, -2, 3]));
        assert_eq!(p.derivative(), Ok(of(&[2, 6])));
        assert_eq!(p.evaluate(&Free::rational(&ratio(1, 3))), Ok(Free::whole(2)));
        assert_eq!(p.monic().unwrap().leading(), Some(&Free::whole(1)));
        assert_eq!(p.divided(&of(&[])), Err(Trouble::DivisionByZero));
        assert_eq!(of(&[-1, 0, 1]).resultant(&of(&[-2, 1])), Ok(Free::whole(3)));
        assert_eq!(p.mapped(|value| value.at(0, &ratio(1, 1))), Ok(p.clone()));
        assert!(of(&[0, 0]).squarefree().unwrap().is_empty());
    }
}
