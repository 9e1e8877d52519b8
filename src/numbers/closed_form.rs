//! How are the roots of a linear or quadratic factor written?
//!
//! As the literature writes them: `(3/8 + c/4)^2`, `4/(n*(n + 5))`, `(5 + c_k + sqrt((c_k + 1)*(c_k + 9)))/16`. Terms
//! stand by ascending degree, in the valence by descending degree; denominators are products.

use crate::numbers::factor::polynomial_factors;
use crate::numbers::free::Free;
use crate::numbers::gcd::{rational_root, square_part};
use crate::numbers::notation::Shown;
use crate::numbers::polynomial::{Exponents, Polynomial, TOO_LARGE, total};
use crate::numbers::univariate::Univariate;
use crate::numbers::{Field, Trouble};
use dashu_base::{Gcd, Sign, UnsignedAbs};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use std::cmp::Reverse;

/// A root of a linear or quadratic polynomial over the free world.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[expect(clippy::large_enum_variant, reason = "few are held at a time")]
pub enum ClosedForm {
    /// A rational function.
    Rational(Free),
    /// `mean + scale * sqrt(radicand)`, or with minus.
    Root {
        /// Half the sum of the two roots.
        mean: Free,
        /// The factor of the square root; its leading coefficient is positive.
        scale: Free,
        /// A polynomial that is no square, as far as it could be taken apart.
        radicand: Free,
        /// Whether the square root is added.
        positive: bool,
    },
}

impl ClosedForm {
    /// The roots of a polynomial of degree 1 or 2, of a double root one; that with the added square root first. None for
    /// other degrees, or when they are too large.
    pub fn of(factor: &Univariate<Free>) -> Option<Vec<ClosedForm>> {
        match factor.monic().ok()?.coefficients() {
            [constant, _] => Some(vec![ClosedForm::Rational(constant.negated())]),
            [constant, linear, _] => quadratic(constant, linear).ok(),
            _ => None,
        }
    }

    /// The formula with + - * / ^ ( ) and sqrt, the indeterminates by these names.
    pub fn text(&self, names: &[&str]) -> String {
        self.shown(names).text()
    }

    /// The formula in LaTeX, the indeterminates by these names.
    pub fn latex(&self, names: &[&str]) -> String {
        self.shown(names).latex()
    }

    fn shown(&self, names: &[&str]) -> Shown {
        match self {
            ClosedForm::Rational(value) => shown_free(value, names),
            ClosedForm::Root { mean, scale, radicand, positive } => {
                let root = Shown::Root(Box::new(shown_radicand(radicand, names)));
                shown_root(mean, scale, &root, *positive, names).unwrap_or(root)
            }
        }
    }
}

/// The formula of a rational function with + - * / ^ ( ), the indeterminates by these names.
pub fn free_text(value: &Free, names: &[&str]) -> String {
    shown_free(value, names).text()
}

/// The formula of a rational function in LaTeX, the indeterminates by these names.
pub fn free_latex(value: &Free, names: &[&str]) -> String {
    shown_free(value, names).latex()
}

/// The roots of x^2 + linear x + constant.
fn quadratic(constant: &Free, linear: &Free) -> Result<Vec<ClosedForm>, Trouble> {
    let half = Free::rational(&RBig::from_parts(IBig::ONE, UBig::from(2u8)));
    let mean = linear.times(&half)?.negated();
    let quarter = mean.times(&mean)?.minus(constant)?;
    let (s, d) = square_part(&quarter.numerator().times(quarter.denominator())?);
    let scale = Free::new(&s, quarter.denominator())?;
    if d.is_zero() {
        return Ok(vec![ClosedForm::Rational(mean)]);
    }
    if d == Polynomial::whole(1) {
        let roots = [mean.plus(&scale)?, mean.minus(&scale)?];
        return Ok(roots.map(ClosedForm::Rational).to_vec());
    }
    let radicand = Free::polynomial(d);
    let root = |positive| {
        let (mean, scale, radicand) = (mean.clone(), scale.clone(), radicand.clone());
        ClosedForm::Root { mean, scale, radicand, positive }
    };
    Ok(vec![root(true), root(false)])
}

/// In which order the terms of a sum stand.
#[derive(Clone, Copy, PartialEq)]
enum Order {
    /// By descending degree in the valence, then by ascending total degree.
    Usual,
    /// By descending total degree.
    Descending,
}

fn ordered(p: &Polynomial, order: Order) -> Vec<(Exponents, RBig)> {
    let scaled = p.terms().iter().map(|(exponents, c)| (*exponents, RBig::from(c.clone()) * p.content()));
    let mut terms: Vec<_> = scaled.collect();
    terms.sort_by_key(|(exponents, _)| match order {
        Order::Usual => (Reverse(exponents[0]), total(exponents), Reverse(*exponents)),
        Order::Descending => (Reverse(0), usize::MAX - total(exponents), Reverse(*exponents)),
    });
    terms
}

fn number(value: &UBig) -> Shown {
    Shown::Atom(value.to_string())
}

fn shown_variable(index: usize, exponent: usize, names: &[&str]) -> Shown {
    let name = names.get(index).map_or_else(|| format!("x{index}"), |name| name.to_string());
    Shown::Atom(name).power(exponent)
}

/// A term without its sign.
fn shown_term(exponents: &Exponents, coefficient: &RBig, names: &[&str]) -> Shown {
    let (numerator, denominator) = (coefficient.numerator().unsigned_abs(), coefficient.denominator());
    let powers = exponents.iter().enumerate().filter(|(_, e)| **e > 0);
    let mut factors: Vec<_> = powers.map(|(index, e)| shown_variable(index, usize::from(*e), names)).collect();
    if factors.is_empty() || !numerator.is_one() {
        factors.insert(0, number(&numerator));
    }
    Shown::product(factors).over((!denominator.is_one()).then(|| number(denominator)))
}

fn summands(p: &Polynomial, order: Order, names: &[&str]) -> Vec<(bool, Shown)> {
    let terms = ordered(p, order);
    terms.iter().map(|(e, c)| (c.sign() == Sign::Negative, shown_term(e, c, names))).collect()
}

fn expanded(p: &Polynomial, order: Order, names: &[&str]) -> Shown {
    Shown::sum(summands(p, order, names))
}

/// The factors of a polynomial, each with a first term that is positive, apart from the content with its sign.
fn signed_factors(p: &Polynomial, order: Order) -> (RBig, Vec<(Polynomial, usize)>) {
    let (mut content, mut factors) = polynomial_factors(p);
    for (factor, multiplicity) in &mut factors {
        if ordered(factor, order).first().is_some_and(|(_, c)| c.sign() == Sign::Negative) {
            *factor = factor.negated();
            content = if *multiplicity % 2 == 1 { -content } else { content };
        }
    }
    (content, factors)
}

fn shown_factors(factors: &[(Polynomial, usize)], order: Order, names: &[&str]) -> Vec<Shown> {
    factors.iter().map(|(factor, m)| expanded(factor, order, names).power(*m)).collect()
}

/// Gives a negative sign to a factor that has a term to stand first without it.
fn absorbed((content, mut factors): (RBig, Vec<(Polynomial, usize)>)) -> (RBig, Vec<(Polynomial, usize)>) {
    let mixed = |p: &Polynomial| p.terms().iter().any(|(_, c)| c.sign() == Sign::Negative);
    let turns = |(p, m): &&mut (Polynomial, usize)| *m % 2 == 1 && mixed(p);
    match factors.iter_mut().find(turns).filter(|_| content.sign() == Sign::Negative) {
        Some((factor, _)) => *factor = factor.negated(),
        None => return (content, factors),
    }
    (-content, factors)
}

/// A product with whole content, and its sign.
fn factored(p: &Polynomial, order: Order, names: &[&str]) -> (bool, Shown) {
    let signed = signed_factors(p, order);
    let (content, factors) = if order == Order::Descending { absorbed(signed) } else { signed };
    let mut shown = shown_factors(&factors, order, names);
    let size = content.numerator().unsigned_abs();
    if !size.is_one() {
        shown.insert(0, number(&size));
    }
    (content.sign() == Sign::Negative, Shown::product(shown))
}

fn shown_radicand(radicand: &Free, names: &[&str]) -> Shown {
    let p = radicand.numerator();
    if polynomial_factors(p).1.iter().map(|(_, m)| m).sum::<usize>() < 2 {
        return expanded(p, Order::Descending, names);
    }
    let (negative, product) = factored(p, Order::Descending, names);
    product.signed(negative)
}

fn shown_free(value: &Free, names: &[&str]) -> Shown {
    let (numerator, denominator) = (value.numerator(), value.denominator());
    if let Some(power) = value.as_polynomial().and_then(|p| shown_power(p, names)) {
        return power;
    }
    if value.as_polynomial().is_some_and(|p| p.len() < 2 || !p.mentions(0)) {
        let product = factored_fraction(numerator, None, names);
        let sum = expanded(numerator, Order::Usual, names);
        return if numerator.len() > 2 { shorter(sum, product) } else { sum };
    }
    let below = whole_denominator(numerator, denominator);
    let product = factored_fraction(numerator, Some(denominator), names);
    let whole = numerator.scaled(&RBig::from(numerator.content().denominator().clone()));
    if whole.len() < 2 {
        return product;
    }
    shorter(expanded(&whole, Order::Usual, names).over(shown_denominator(&below, names)), product)
}

/// The shorter of two; the second only if it is really shorter.
fn shorter(first: Shown, second: Shown) -> Shown {
    if second.text().len() < first.text().len() { second } else { first }
}

/// The denominator times that of the numerator's content.
fn whole_denominator(numerator: &Polynomial, denominator: &Polynomial) -> Polynomial {
    denominator.scaled(&RBig::from(numerator.content().denominator().clone()))
}

/// A product below a line, if it is not 1; its sign must be positive.
fn shown_denominator(p: &Polynomial, names: &[&str]) -> Option<Shown> {
    if *p == Polynomial::whole(1) {
        return None;
    }
    let (negative, product) = factored(p, Order::Usual, names);
    Some(product.signed(negative))
}

/// A quotient of products, the sign in front.
fn factored_fraction(numerator: &Polynomial, denominator: Option<&Polynomial>, names: &[&str]) -> Shown {
    let one = Polynomial::whole(1);
    let whole = numerator.scaled(&RBig::from(numerator.content().denominator().clone()));
    let below = whole_denominator(numerator, denominator.unwrap_or(&one));
    let (negative, above) = factored(&whole, Order::Usual, names);
    if below == one {
        return above.signed(negative);
    }
    let (turned, below) = factored(&below, Order::Usual, names);
    above.over(Some(below)).signed(negative != turned)
}

/// A sum of at least three terms that is the power of a polynomial with rational coefficients.
fn shown_power(p: &Polynomial, names: &[&str]) -> Option<Shown> {
    let (content, factors) = signed_factors(p, Order::Usual);
    let [(base, exponent)] = factors.as_slice() else { return None };
    if p.len() < 3 || *exponent < 2 {
        return None;
    }
    let scale = rational_power_root(&content, *exponent)?;
    Some(shown_free(&Free::polynomial(base.scaled(&scale)), names).power(*exponent))
}

/// The root of a small rational number by repeated square roots or by trial.
fn rational_power_root(value: &RBig, exponent: usize) -> Option<RBig> {
    if exponent.is_multiple_of(2) {
        return rational_power_root(&rational_root(value)?, exponent / 2);
    }
    if exponent == 1 || value.is_one() {
        return Some(value.clone());
    }
    let whole_root = |size: UBig| {
        let root = size.nth_root(exponent);
        (root.pow(exponent) == size).then_some(root)
    };
    let numerator = whole_root(value.numerator().unsigned_abs())?;
    let root = RBig::from_parts(numerator.into(), whole_root(value.denominator().clone())?);
    Some(if value.sign() == Sign::Negative { -root } else { root })
}

/// `mean + scale * root` over the least common denominator.
fn shown_root(mean: &Free, scale: &Free, root: &Shown, plus: bool, names: &[&str]) -> Result<Shown, Trouble> {
    let (p, q) = (mean.numerator().content().denominator(), scale.numerator().content().denominator());
    let (left, right) = (mean.denominator(), scale.denominator());
    let shared = left.gcd(right)?;
    let below = left.times(&right.divided_exactly(&shared).ok_or(TOO_LARGE)?)?;
    let below = below.scaled(&RBig::from(p * (q / p.gcd(q))));
    let whole = Free::polynomial(below.clone());
    let (sum, factor) = (mean.times(&whole)?, scale.times(&whole)?);
    let mut terms = summands(sum.numerator(), Order::Usual, names);
    let (negative, product) = factored(factor.numerator(), Order::Usual, names);
    let scaled = if *factor.numerator() == Polynomial::whole(1) { Vec::new() } else { vec![product] };
    let flat = scaled.into_iter().flat_map(|shown| match shown {
        Shown::Product(factors) => factors,
        other => vec![other],
    });
    let summand = (plus == negative, Shown::product(flat.chain([root.clone()]).collect()));
    let below = shown_denominator(&below, names);
    if terms.is_empty() {
        return Ok(summand.1.over(below).signed(summand.0));
    }
    terms.push(summand);
    Ok(Shown::sum(terms).over(below))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::factor::tests::{catmull_clark, monic_of, number, sum};
    use crate::numbers::polynomial::tests::{polynomial, ratio};

    const NAMES: [&str; 5] = ["n", "c", "c_k", "w", "v"];

    fn free(a: Polynomial, b: Polynomial) -> Free {
        Free::new(&a, &b).unwrap()
    }

    /// The sum of coefficient * n^i * c^j over a number.
    fn shown(terms: &[(i64, u16, u16)], over: i64) -> String {
        free_text(&free(polynomial(terms), Polynomial::whole(over)), &NAMES)
    }

    #[test]
    fn polynomials_stand_as_in_the_literature() {
        assert_eq!(shown(&[(3, 0, 0), (2, 0, 1)], 8), "3/8 + c/4");
        assert_eq!(shown(&[(9, 0, 0), (12, 0, 1), (4, 0, 2)], 64), "(3/8 + c/4)^2");
        assert_eq!(shown(&[(1, 0, 0), (-2, 0, 1), (1, 0, 2)], 2), "(1 - c)^2/2");
        assert_eq!(shown(&[(3, 1, 0), (-7, 0, 0)], 8), "(3*n - 7)/8");
        assert_eq!(shown(&[(-3, 1, 0), (7, 0, 0)], 8), "(7 - 3*n)/8");
        assert_eq!(shown(&[(1, 2, 0), (-3, 1, 0)], 1), "n^2 - 3*n");
        assert_eq!(shown(&[(1, 2, 0), (-3, 1, 0)], 8), "n*(n - 3)/8");
        assert_eq!(shown(&[(-1, 0, 0)], 8), "-1/8");
        assert_eq!(shown(&[(-1, 0, 1)], 8), "-c/8");
        assert_eq!(shown(&[(1, 0, 0), (-1, 0, 1)], 1), "1 - c");
        assert_eq!(shown(&[], 1), "0");
        let long = free(polynomial(&[(3, 0, 0), (2, 0, 1)]), Polynomial::whole(8));
        assert_eq!(free_text(&long, &["n", "cos(2*pi/n)"]), "3/8 + cos(2*pi/n)/4");
        assert_eq!(free_text(&Free::variable(5), &NAMES), "x5");
    }

    #[test]
    fn quotients_stand_as_in_the_literature() {
        let text =
            |a: &[(i64, u16, u16)], b: &[(i64, u16, u16)]| free_text(&free(polynomial(a), polynomial(b)), &NAMES);
        assert_eq!(text(&[(1, 1, 0)], &[(1, 1, 0), (5, 0, 0)]), "n/(n + 5)");
        assert_eq!(text(&[(4, 0, 0)], &[(1, 2, 0), (5, 1, 0)]), "4/(n*(n + 5))");
        assert_eq!(text(&[(1, 0, 0)], &[(1, 2, 0), (5, 1, 0)]), "1/(n*(n + 5))");
        assert_eq!(text(&[(1, 0, 0)], &[(2, 0, 0), (2, 0, 1)]), "1/(2*(1 + c))");
        assert_eq!(text(&[(3, 1, 0), (-7, 0, 0)], &[(4, 1, 0)]), "(3*n - 7)/(4*n)");
        assert_eq!(text(&[(-1, 0, 0)], &[(1, 0, 1), (-1, 0, 0)]), "1/(1 - c)");
        let value = free(polynomial(&[(1, 0, 0)]), polynomial(&[(2, 0, 0), (2, 0, 1)]));
        assert_eq!(free_latex(&value, &NAMES), "\\frac{1}{2 (1 + c)}");
    }

    #[test]
    fn roots_stand_as_in_the_literature() {
        let roots = ClosedForm::of(&catmull_clark()).unwrap();
        let texts: Vec<_> = roots.iter().map(|root| root.text(&NAMES)).collect();
        let expected = ["(5 + c_k + sqrt((c_k + 1)*(c_k + 9)))/16", "(5 + c_k - sqrt((c_k + 1)*(c_k + 9)))/16"];
        assert_eq!(texts, expected);
        let latex = "\\frac{5 + c_k + \\sqrt{(c_k + 1) (c_k + 9)}}{16}";
        assert_eq!(roots[0].latex(&NAMES), latex);
    }

    #[test]
    fn roots_in_the_valence_stand_as_in_the_literature() {
        // The roots have the sum (3 n - 7)/(4 n) and the product ((3 n - 7)^2 - (5 n^2 - 30 n + 49))/(64 n^2).
        let middle = free(polynomial(&[(-3, 1, 0), (7, 0, 0)]), polynomial(&[(4, 1, 0)]));
        let constant = free(polynomial(&[(4, 2, 0), (-12, 1, 0)]), polynomial(&[(64, 2, 0)]));
        let roots = ClosedForm::of(&monic_of(&[constant, middle])).unwrap();
        assert_eq!(roots[0].text(&NAMES), "(3*n - 7 + sqrt(5*n^2 - 30*n + 49))/(8*n)");
        assert_eq!(roots[1].text(&NAMES), "(3*n - 7 - sqrt(5*n^2 - 30*n + 49))/(8*n)");
        assert_eq!(roots[1].latex(&NAMES), "\\frac{3 n - 7 - \\sqrt{5 n^2 - 30 n + 49}}{8 n}");
    }

    #[test]
    fn numbers_and_rational_roots() {
        let golden = ClosedForm::of(&monic_of(&[number(-1, 1), number(-1, 1)])).unwrap();
        assert_eq!(golden[0].text(&NAMES), "(1 + sqrt(5))/2");
        let pure = ClosedForm::of(&monic_of(&[number(-1, 2), number(0, 1)])).unwrap();
        assert_eq!((pure[0].text(&NAMES), pure[1].text(&NAMES)), ("sqrt(2)/2".into(), "-sqrt(2)/2".into()));
        let c = Free::variable(1);
        let linear = ClosedForm::of(&monic_of(&[sum(&number(-3, 8), &c.times(&number(-1, 4)).unwrap())])).unwrap();
        assert_eq!(linear[0].text(&NAMES), "3/8 + c/4");
        let rational = ClosedForm::of(&monic_of(&[c.negated().times(&c).unwrap(), number(0, 1)])).unwrap();
        assert_eq!(rational[1].text(&NAMES), "-c");
        assert_eq!(ClosedForm::of(&monic_of(&[number(1, 4), number(1, 1)])).unwrap().len(), 1);
        assert_eq!(ClosedForm::of(&monic_of(&[])), None);
        let scaled = ClosedForm::of(&monic_of(&[number(-12, 1).times(&c).unwrap(), number(2, 3)])).unwrap();
        assert_eq!(scaled[0].text(&NAMES), "(sqrt(108*c + 1) - 1)/3");
        let signs = polynomial(&[(4, 0, 0), (20, 0, 1), (-75, 0, 2)]);
        assert_eq!(shown_radicand(&Free::polynomial(signs), &NAMES).text(), "(2 - 5*c)*(15*c + 2)");
        assert_eq!(rational_power_root(&ratio(-8, 27), 3), Some(ratio(-2, 3)));
    }
}
