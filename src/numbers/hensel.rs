//! Which linear and quadratic factors can a polynomial with whole coefficients have?
//!
//! Its factors modulo a small prime, by trial, lifted to a high power of the prime by Newton's iteration (Hensel lifting:
//! von zur Gathen & Gerhard, Modern Computer Algebra, chapter 15). A factor over Q is, modulo that power, one of them or
//! the product of two linear ones.

use dashu_base::{ExtendedGcd, RemEuclid};
use dashu_int::{IBig, UBig};

/// Small enough for trial, large enough to keep most polynomials squarefree.
const PRIMES: [i64; 24] =
    [29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83, 89, 97, 101, 103, 107, 109, 113, 127, 131, 137];

/// Monic factors modulo a number, by the coefficients below the leading 1, low to high.
pub(crate) struct Lifted {
    pub(crate) modulus: IBig,
    pub(crate) linear: Vec<IBig>,
    pub(crate) quadratic: Vec<[IBig; 2]>,
}

/// All linear and quadratic factors modulo a number of more than so many bits; none where no small prime keeps the degree
/// and the roots apart. The coefficients low to high.
pub(crate) fn lifted(coefficients: &[IBig], bits: usize) -> Option<Lifted> {
    let images = PRIMES.iter().map(|p| (*p, coefficients.iter().map(|c| residue(c, *p)).collect::<Vec<_>>()));
    let (prime, image) = images.into_iter().find(|(p, image)| is_squarefree(image, *p))?;
    let (linear, quadratic) = small_factors(image, prime);
    let mut moduli = vec![IBig::from(prime)];
    while let Some(last) = moduli.last().filter(|last| dashu_base::BitTest::bit_len(*last) <= bits) {
        moduli.push(last * last);
    }
    let lift = |low: Vec<i64>| raised(coefficients, low.into_iter().map(IBig::from).collect(), &moduli);
    let linear = linear.into_iter().map(|c| lift(vec![c])?.pop()).collect::<Option<_>>()?;
    let quadratic = quadratic.into_iter().map(|low| lift(low.to_vec())?.try_into().ok()).collect::<Option<_>>()?;
    Some(Lifted { modulus: moduli.pop()?, linear, quadratic })
}

fn residue(value: &IBig, prime: i64) -> i64 {
    i64::try_from(value.rem_euclid(&IBig::from(prime))).unwrap_or(0)
}

fn inverse(value: i64, prime: i64) -> i64 {
    (1..prime).find(|candidate| value * candidate % prime == 1).unwrap_or(0)
}

/// Whether the polynomial has its degree and no repeated factor modulo the prime.
fn is_squarefree(image: &[i64], prime: i64) -> bool {
    if image.last().is_none_or(|leading| *leading == 0) {
        return false;
    }
    let derivative = (0i64..).zip(image).skip(1).map(|(i, c)| i * c % prime).collect();
    let (mut a, mut b) = (image.to_vec(), trimmed(derivative));
    while !b.is_empty() {
        (a, b) = (b.clone(), remainder(a, &b, prime));
    }
    a.len() == 1
}

fn trimmed(mut p: Vec<i64>) -> Vec<i64> {
    while p.last() == Some(&0) {
        p.pop();
    }
    p
}

fn remainder(mut a: Vec<i64>, b: &[i64], prime: i64) -> Vec<i64> {
    let unit = inverse(b.last().copied().unwrap_or(0), prime);
    while a.len() >= b.len() {
        let factor = a.last().map_or(0, |leading| leading * unit % prime);
        let start = a.len() - b.len();
        for (slot, value) in a[start..].iter_mut().zip(b) {
            *slot = (*slot + (prime - factor) * value) % prime;
        }
        a.pop();
    }
    trimmed(a)
}

/// The quotient by x^2 + u x + w (or, with `low` = [w], by x + w), if it divides.
fn divided(p: &[i64], low: &[i64], prime: i64) -> Option<Vec<i64>> {
    let mut rest = p.to_vec();
    for top in (low.len()..p.len()).rev() {
        let factor = prime - rest[top];
        for (slot, value) in rest[top - low.len()..top].iter_mut().zip(low) {
            *slot = (*slot + factor * value) % prime;
        }
    }
    rest[..low.len()].iter().all(|value| *value == 0).then(|| rest.split_off(low.len()))
}

/// The monic linear and irreducible quadratic factors of a squarefree polynomial.
fn small_factors(mut p: Vec<i64>, prime: i64) -> (Vec<i64>, Vec<[i64; 2]>) {
    let (mut linear, mut quadratic) = (Vec::new(), Vec::new());
    for w in 0..prime {
        if let Some(rest) = divided(&p, &[w], prime).filter(|_| p.len() > 1) {
            linear.push(w);
            p = rest;
        }
    }
    let candidates = (0..prime * prime).map(|code| [code / prime, code % prime]);
    for low in candidates {
        if p.len() < 5 {
            break;
        }
        if let Some(rest) = divided(&p, &low, prime) {
            quadratic.push(low);
            p = rest;
        }
    }
    if let [w, u, leading] = p.as_slice() {
        let unit = inverse(*leading, prime);
        quadratic.push([w * unit % prime, u * unit % prime]);
    }
    (linear, quadratic)
}

/// A factor modulo the first of the moduli, each the square of the one before, lifted to the last.
fn raised(coefficients: &[IBig], mut low: Vec<IBig>, moduli: &[IBig]) -> Option<Vec<IBig>> {
    for pair in moduli.windows(2) {
        let [coarse, fine] = pair else { break };
        let (quotient, rest) = split(coefficients.iter().map(|c| reduced(c, fine)).collect(), &low, fine);
        let (_, cofactor) = split(quotient, &low, fine);
        let correction = product(&rest, &unit(&cofactor, &low, coarse)?, &low, fine);
        low = low.iter().zip(&correction).map(|(c, more)| reduced(&(c + more), fine)).collect();
    }
    Some(low)
}

fn reduced(value: &IBig, modulus: &IBig) -> IBig {
    IBig::from(value.rem_euclid(modulus))
}

/// Quotient and remainder by the monic polynomial with these lower coefficients.
fn split(mut p: Vec<IBig>, low: &[IBig], modulus: &IBig) -> (Vec<IBig>, Vec<IBig>) {
    for top in (low.len()..p.len()).rev() {
        let factor = p[top].clone();
        for (i, value) in low.iter().enumerate() {
            let slot = top - low.len() + i;
            p[slot] = reduced(&(&p[slot] - &factor * value), modulus);
        }
    }
    p.resize(p.len().max(low.len()), IBig::ZERO);
    let quotient = p.split_off(low.len());
    (quotient, p)
}

/// The product modulo the monic polynomial.
fn product(a: &[IBig], b: &[IBig], low: &[IBig], modulus: &IBig) -> Vec<IBig> {
    let mut all = vec![IBig::ZERO; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            all[i + j] += x * y;
        }
    }
    split(all.iter().map(|value| reduced(value, modulus)).collect(), low, modulus).1
}

/// The inverse of a + b x modulo x^2 + u x + w: its conjugate a - u b - b x over its norm.
fn unit(value: &[IBig], low: &[IBig], modulus: &IBig) -> Option<Vec<IBig>> {
    let (conjugate, norm) = match (value, low) {
        ([a, b], [w, u]) => (vec![a - u * b, -b], a * a - u * a * b + w * b * b),
        ([a], [_]) => (vec![IBig::ONE], a.clone()),
        _ => return None,
    };
    let norm = norm.rem_euclid(modulus);
    if norm.is_zero() {
        return None;
    }
    let (divisor, inverse, _) = norm.gcd_ext(UBig::try_from(modulus.clone()).ok()?);
    divisor.is_one().then(|| conjugate.iter().map(|c| reduced(&(c * &inverse), modulus)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_found_and_lifted() {
        // (3 x + 7) (x^2 + 1000 x + 123) (x^3 + x + 5)
        let (a, b, c) = ([7, 3], [123, 1000, 1], [5, 1, 0, 1]);
        let mut p = vec![IBig::ZERO; 7];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                for (k, z) in c.iter().enumerate() {
                    p[i + j + k] += IBig::from(x * y * z);
                }
            }
        }
        let lifted = lifted(&p, 100).unwrap();
        let is_first = |w: &IBig| reduced(&(w * IBig::from(3)), &lifted.modulus) == IBig::from(7);
        assert!(lifted.linear.iter().any(is_first));
        for low in lifted.quadratic.iter().map(|low| low.to_vec()).chain(lifted.linear.iter().map(|w| vec![w.clone()]))
        {
            let image = p.iter().map(|c| reduced(c, &lifted.modulus)).collect();
            assert!(split(image, &low, &lifted.modulus).1.iter().all(IBig::is_zero));
        }
    }

    #[test]
    fn squares_are_refused() {
        let p: Vec<IBig> = [1, 2, 1].map(IBig::from).to_vec();
        assert!(lifted(&p, 10).is_none());
    }
}
