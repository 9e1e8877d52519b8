//! What are the linear and quadratic factors of a polynomial over the field of the free world?
//!
//! By Gauss's lemma they are those over the ring of polynomials with whole coefficients. Whole numbers for the
//! indeterminates, so large that the coefficients of any factor are their digits, leave a polynomial in one unknown with
//! whole coefficients; its factors come from `numbers::hensel`, and those that are real are told by exact division. The
//! digits are long enough by Gelfond's bound (1960) of the height of a factor, so that none is missed.

use crate::numbers::Trouble;
use crate::numbers::free::Free;
use crate::numbers::hensel::{Lifted, lifted};
use crate::numbers::kronecker::{Substitution, height_bits};
use crate::numbers::polynomial::{Polynomial, SLOTS, TOO_LARGE, UNKNOWN};
use crate::numbers::univariate::Univariate;
use dashu_base::{BitTest, RemEuclid};
use dashu_int::IBig;
use dashu_ratio::RBig;
use std::cmp::Reverse;

/// The largest degree that is taken apart.
const MAX_DEGREE: usize = 40;
/// The most bits, times the square of the degree.
const MAX_WORK: usize = 1 << 22;
/// How many substitutions are tried.
const ATTEMPTS: usize = 6;

/// Monic factors with their multiplicities, by ascending degree: all linear ones and all irreducible quadratic ones; what
/// is left of each multiplicity stays whole, and is irreducible if of degree 3. With the leading coefficient their product
/// is `p`.
///
/// # Errors
/// When `p` is zero or too large.
pub fn factors(p: &Univariate<Free>) -> Result<Vec<(Univariate<Free>, usize)>, Trouble> {
    let cleared = cleared(p)?;
    let zeros = cleared.monomial_part()[UNKNOWN];
    let rest = cleared.divided_exactly(&Polynomial::power_of_variable(UNKNOWN, zeros)).ok_or(TOO_LARGE)?;
    let mut all = Vec::new();
    if zeros > 0 {
        all.push((Polynomial::variable(UNKNOWN), usize::from(zeros)));
    }
    for (part, multiplicity) in rest.squarefree_in(UNKNOWN)? {
        all.extend(split(&part, UNKNOWN)?.into_iter().map(|factor| (factor, multiplicity)));
    }
    all.sort_by_cached_key(|(factor, _)| (factor.degree_in(UNKNOWN), factor.clone()));
    all.into_iter().map(|(factor, multiplicity)| Ok((monic(&factor)?, multiplicity))).collect()
}

/// The multiple of p by the least common denominator of its coefficients made monic, as a polynomial in all.
fn cleared(p: &Univariate<Free>) -> Result<Polynomial, Trouble> {
    let monic = p.monic()?;
    if monic.degree().ok_or(Trouble::Domain("zero has no factors"))? > MAX_DEGREE {
        return Err(TOO_LARGE);
    }
    let mut common = Polynomial::whole(1);
    for coefficient in monic.coefficients() {
        let shared = common.gcd(coefficient.denominator())?;
        common = common.times(&coefficient.denominator().divided_exactly(&shared).ok_or(TOO_LARGE)?)?;
    }
    let lift = |coefficient: &Free| {
        let factor = common.divided_exactly(coefficient.denominator()).ok_or(TOO_LARGE)?;
        coefficient.numerator().times(&factor)
    };
    let coefficients = monic.coefficients().iter().map(lift).collect::<Result<Vec<_>, _>>()?;
    Ok(Polynomial::from_coefficients_in(UNKNOWN, &coefficients)?.primitive())
}

fn monic(factor: &Polynomial) -> Result<Univariate<Free>, Trouble> {
    let coefficients = factor.coefficients_in(UNKNOWN);
    let leading = coefficients.last().ok_or(TOO_LARGE)?;
    let quotients = coefficients.iter().map(|c| Free::new(c, leading));
    Ok(Univariate::new(quotients.collect::<Result<_, _>>()?))
}

/// The factors of degree 1 and 2 in one indeterminate of a squarefree polynomial that has no factor without it, and the
/// rest.
fn split(p: &Polynomial, main: usize) -> Result<Vec<Polynomial>, Trouble> {
    if p.degree_in(main) < 2 {
        return Ok(if p.degree_in(main) == 0 { Vec::new() } else { vec![p.clone()] });
    }
    let others = (0..SLOTS).filter(|index| *index != main && p.mentions(*index));
    for index in others {
        let content = p.content_in(index)?;
        if content.mentions(main) {
            let mut all = split(&content, main)?;
            all.extend(split(&p.divided_exactly(&content).ok_or(TOO_LARGE)?, main)?);
            return Ok(all);
        }
    }
    search(p, main)
}

/// The same where every factor has all indeterminates.
fn search(p: &Polynomial, main: usize) -> Result<Vec<Polynomial>, Trouble> {
    for attempt in 0..ATTEMPTS {
        let images = Images::new(p, main, attempt)?;
        if p.degree_in(main).pow(2).saturating_mul(images.bits) > MAX_WORK {
            return Err(TOO_LARGE);
        }
        if let Some(lifted) = lifted(&images.coefficients, images.bits + 20) {
            return Search { images, rest: p.primitive(), found: Vec::new() }.run(&lifted);
        }
    }
    Err(TOO_LARGE)
}

/// A polynomial with numbers for all indeterminates but one.
struct Images {
    main: usize,
    substitution: Substitution,
    coefficients: Vec<IBig>,
    /// No coefficient of a factor, scaled to the leading coefficient of the polynomial, has more bits.
    bits: usize,
}

impl Images {
    fn new(p: &Polynomial, main: usize, attempt: usize) -> Result<Self, Trouble> {
        let parts = p.primitive().coefficients_in(main);
        let leading = parts.last().ok_or(TOO_LARGE)?;
        // A factor with that leading coefficient divides this product.
        let product = p.primitive().times(leading)?;
        let degrees: [usize; SLOTS] = std::array::from_fn(|index| product.degree_in(index));
        let height = height_bits(product.terms()) + product.content().numerator().bit_len();
        let bits = height + 3 * degrees.iter().sum::<usize>() / 2 + 1;
        let mut others = degrees;
        others[main] = 0;
        let substitution = Substitution::new(bits, &others, attempt)?;
        let value = |part: &Polynomial| substitution.value(part.terms()) * part.content().numerator();
        let coefficients = parts.iter().map(value).collect();
        Ok(Images { main, bits: substitution.value_bits(bits), coefficients, substitution })
    }

    /// The polynomial whose image, scaled to the leading coefficient, has these lower coefficients modulo the modulus.
    fn factor(&self, low: &[IBig], modulus: &IBig) -> Option<Polynomial> {
        let leading = self.coefficients.last()?;
        let balanced = low.iter().map(|c| balanced(&(c * leading), modulus)).collect::<Vec<_>>();
        if balanced.iter().any(|c| c.bit_len() > self.bits) {
            return None;
        }
        let all = balanced.into_iter().chain([leading.clone()]);
        let digits = all.map(|value| self.substitution.polynomial(value)).collect::<Option<Vec<_>>>()?;
        let candidate = Polynomial::from_coefficients_in(self.main, &digits).ok()?;
        let content = candidate.content_in(self.main).ok()?;
        Some(candidate.divided_exactly(&content)?.primitive())
    }
}

/// The residue of least magnitude.
fn balanced(value: &IBig, modulus: &IBig) -> IBig {
    let residue = IBig::from(value.rem_euclid(modulus));
    if &residue + &residue > *modulus { residue - modulus } else { residue }
}

/// The factors found so far and what is left.
struct Search {
    images: Images,
    rest: Polynomial,
    found: Vec<Polynomial>,
}

impl Search {
    fn run(mut self, lifted: &Lifted) -> Result<Vec<Polynomial>, Trouble> {
        let open = |search: &mut Search, low: &[IBig]| !search.takes(low, &lifted.modulus);
        let linear: Vec<&IBig> = lifted.linear.iter().filter(|w| open(&mut self, std::slice::from_ref(*w))).collect();
        for low in &lifted.quadratic {
            self.takes(low, &lifted.modulus);
        }
        self.takes_pairs(linear, &lifted.modulus);
        if self.rest.mentions(self.images.main) {
            self.found.push(self.rest);
        }
        Ok(self.found)
    }

    /// A quadratic factor may be the product of two linear ones modulo the modulus.
    fn takes_pairs(&mut self, mut linear: Vec<&IBig>, modulus: &IBig) {
        while let Some(v) = linear.pop() {
            let partner = linear.iter().position(|w| self.takes(&[v * *w, v + *w], modulus));
            if let Some(index) = partner {
                linear.remove(index);
            }
        }
    }

    /// Splits a factor off, if it is one and a rest stays that need not be irreducible.
    fn takes(&mut self, low: &[IBig], modulus: &IBig) -> bool {
        if self.rest.degree_in(self.images.main) <= low.len() {
            return false;
        }
        let Some(factor) = self.images.factor(low, modulus) else { return false };
        let Some(rest) = self.rest.divided_exactly(&factor) else { return false };
        self.rest = rest;
        self.found.push(factor);
        true
    }
}

/// The content and primitive factors with multiplicities, in a fixed order; their product is `p`. Factors of degree above
/// 2 in every indeterminate may stay together, and so may all that are too large to take apart.
pub fn polynomial_factors(p: &Polynomial) -> (RBig, Vec<(Polynomial, usize)>) {
    let whole = if p.as_constant().is_some() { Vec::new() } else { vec![(p.primitive(), 1)] };
    let squarefree = p.squarefree_factors().unwrap_or(whole);
    let mut all = Vec::new();
    for (part, multiplicity) in squarefree {
        let pieces = pieces(&part).unwrap_or_else(|_| vec![part.clone()]);
        all.extend(pieces.into_iter().map(|piece| (piece, multiplicity)));
    }
    all.sort_by_cached_key(|(factor, _)| {
        (factor.total_degree(), factor.len(), Reverse(factor.monomial_part()), factor.clone())
    });
    (p.content().clone(), all)
}

fn pieces(p: &Polynomial) -> Result<Vec<Polynomial>, Trouble> {
    let present = (0..SLOTS).filter(|index| p.mentions(*index));
    let Some(main) = present.min_by_key(|index| p.degree_in(*index)) else { return Ok(Vec::new()) };
    let content = p.content_in(main)?;
    let mut all = split(&p.divided_exactly(&content).ok_or(TOO_LARGE)?, main)?;
    all.extend(pieces(&content)?);
    Ok(all)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::numbers::Field;
    use crate::numbers::polynomial::tests::{polynomial, ratio, small, whole};
    use proptest::prelude::*;

    pub(crate) fn number(a: i64, b: i64) -> Free {
        Free::rational(&ratio(a, b))
    }

    pub(crate) fn sum(a: &Free, b: &Free) -> Free {
        a.plus(b).unwrap()
    }

    pub(crate) fn product(a: &Free, b: &Free) -> Free {
        a.times(b).unwrap()
    }

    pub(crate) fn monic_of(low: &[Free]) -> Univariate<Free> {
        Univariate::new(low.iter().cloned().chain([Free::whole(1)]).collect())
    }

    fn multiplied(all: &[(Univariate<Free>, usize)]) -> Univariate<Free> {
        let one = Univariate::constant(Free::whole(1));
        all.iter().fold(one, |all, (p, m)| all.times(&p.power(*m).unwrap()).unwrap())
    }

    fn sorted(mut all: Vec<(Univariate<Free>, usize)>) -> Vec<(Univariate<Free>, usize)> {
        all.sort_by_key(|(p, m)| (p.degree(), *m, format!("{p:?}")));
        all
    }

    #[track_caller]
    fn come_back(all: Vec<(Univariate<Free>, usize)>) {
        assert_eq!(sorted(factors(&multiplied(&all)).unwrap()), sorted(all));
    }

    /// lambda^2 - (5 + x)/8 lambda + 1/16
    pub(crate) fn catmull_clark() -> Univariate<Free> {
        let middle = product(&sum(&Free::whole(5), &Free::variable(2)), &number(-1, 8));
        monic_of(&[number(1, 16), middle])
    }

    /// lambda^2 - (3 n - 7)/(4 n) lambda + (n^2 - 3 n)/(16 n^2)
    pub(crate) fn catmull_clark_centre() -> Univariate<Free> {
        let over_n = |p: Polynomial, d: i64| Free::new(&p, &polynomial(&[(d, 1, 0)])).unwrap();
        monic_of(&[over_n(polynomial(&[(1, 1, 0), (-3, 0, 0)]), 16), over_n(polynomial(&[(-3, 1, 0), (7, 0, 0)]), 4)])
    }

    #[test]
    fn catmull_clark_blocks_come_apart() {
        come_back(vec![(catmull_clark(), 1), (monic_of(&[number(-1, 8)]), 2), (monic_of(&[number(-1, 16)]), 1)]);
        come_back(vec![(catmull_clark_centre(), 1), (monic_of(&[Free::whole(-1)]), 1)]);
        come_back(vec![(catmull_clark(), 2), (catmull_clark_centre(), 1), (monic_of(&[Free::whole(0)]), 3)]);
    }

    #[test]
    fn quadratics_with_rational_roots_come_apart() {
        let (c, n) = (Free::variable(1), Free::variable(0));
        let root = Free::whole(1).over(&sum(&n, &c)).unwrap();
        let other = c.over(&product(&n, &sum(&n, &Free::whole(5)))).unwrap();
        come_back(vec![(monic_of(std::slice::from_ref(&root)), 1), (monic_of(std::slice::from_ref(&other)), 1)]);
        come_back(vec![(monic_of(&[root]), 2), (monic_of(&[other]), 1), (catmull_clark(), 1)]);
    }

    #[test]
    fn irreducible_rests_stay_whole() {
        let c = Free::variable(1);
        let cubic = monic_of(&[c.clone(), number(1, 2), c.clone()]);
        come_back(vec![(cubic.clone(), 1)]);
        come_back(vec![(cubic.clone(), 1), (catmull_clark(), 1), (monic_of(&[number(-1, 4)]), 1)]);
        let quintic = monic_of(&[c, Free::whole(1), Free::whole(0), Free::whole(0), Free::whole(0)]);
        come_back(vec![(quintic, 2)]);
        come_back(vec![(monic_of(&[Free::whole(1), Free::whole(0), Free::whole(0), Free::whole(0)]), 1)]);
    }

    #[test]
    fn products_of_quadratics_come_apart() {
        let (c, x) = (Free::variable(1), Free::variable(2));
        let first = monic_of(&[sum(&c, &number(1, 3)), product(&c, &x)]);
        let second = monic_of(&[product(&x, &x), sum(&x, &number(-2, 5))]);
        come_back(vec![(first, 1), (second.clone(), 1)]);
        come_back(vec![(second.at_negative(), 1), (second, 1)]);
    }

    #[test]
    fn rational_coefficients_come_apart() {
        let roots = [(1, 2), (1, 4), (1, 8), (-3, 7), (22, 5)];
        let mut all: Vec<_> = roots.iter().map(|(a, b)| (monic_of(&[number(*a, *b)]), 1)).collect();
        all.push((monic_of(&[number(1, 3), Free::whole(1)]), 1));
        come_back(all);
    }

    #[test]
    fn hostile_input_ends() {
        assert!(factors(&Univariate::new(Vec::new())).is_err());
        assert_eq!(factors(&Univariate::constant(Free::variable(0))), Ok(Vec::new()));
        assert_eq!(factors(&monic_of(&vec![Free::whole(1); 60])), Err(TOO_LARGE));
        let wild = (0..6).fold(whole(1), |sum, i| sum.plus(&Polynomial::variable(i)).unwrap()).power(4).unwrap();
        assert!(factors(&monic_of(&vec![Free::polynomial(wild); 8])).is_err());
    }

    #[test]
    fn polynomials_come_apart_for_print() {
        let p = polynomial(&[(1, 2, 0), (10, 1, 0), (9, 0, 0)]);
        let linear = |a: i64| (polynomial(&[(1, 1, 0), (a, 0, 0)]), 1);
        assert_eq!(polynomial_factors(&p), (RBig::ONE, vec![linear(1), linear(9)]));
        let power = polynomial(&[(9, 0, 0), (12, 0, 1), (4, 0, 2)]).scaled(&ratio(1, 64));
        assert_eq!(polynomial_factors(&power), (ratio(1, 64), vec![(polynomial(&[(3, 0, 0), (2, 0, 1)]), 2)]));
        assert_eq!(polynomial_factors(&whole(0)), (RBig::ZERO, Vec::new()));
        assert_eq!(polynomial_factors(&whole(-3)), (ratio(-3, 1), Vec::new()));
    }

    proptest! {
        #[test]
        fn factors_multiply_back(f in small(), g in small(), h in small()) {
            let p = f.times(&g).unwrap().times(&h).unwrap().times(&h).unwrap();
            let (content, all) = polynomial_factors(&p);
            let back = all.iter().fold(Polynomial::constant(content), |product, (factor, m)| {
                product.times(&factor.power(*m).unwrap()).unwrap()
            });
            prop_assert_eq!(back, p);
        }

        #[test]
        fn random_factors_come_back(a in small(), b in small(), d in small(), e in small()) {
            let over = |p: &Polynomial| Free::new(p, &polynomial(&[(1, 1, 0), (2, 0, 0)])).unwrap();
            let (p, q) = (monic_of(&[over(&a), over(&b)]), monic_of(&[over(&d)]));
            let r = monic_of(&[over(&e), Free::whole(1)]);
            let all = p.times(&q).unwrap().times(&r).unwrap();
            let found = factors(&all).unwrap();
            prop_assert_eq!(multiplied(&found), all);
            prop_assert!(found.iter().all(|(factor, _)| factor.degree() <= Some(2)));
            for (factor, _) in found.iter().filter(|(factor, _)| factor.degree() == Some(2)) {
                let [w, u, _] = factor.coefficients() else { continue };
                let discriminant = product(u, u).minus(&product(&Free::whole(4), w)).unwrap();
                let under = discriminant.numerator().times(discriminant.denominator()).unwrap();
                prop_assert!(crate::numbers::gcd::square_part(&under).1 != Polynomial::whole(1));
            }
        }
    }
}
