//! Are the integer shifts of the limit function stable?
//!
//! They are exactly if the autocorrelation symbol sum_i r_i z^i is positive on the unit circle (Jia and Micchelli 1991). r is the
//! eigenvector to eigenvalue 1 of the transition operator of a(z) a(1/z)/m; with x = cos t the symbol is a polynomial on [-1, 1],
//! and Sturm's theorem counts its roots there. All exact.

use super::transition::{less, null_space};
use dashu_ratio::RBig;

/// Longer masks are left undecided.
const MOST_WEIGHTS: usize = 24;

/// Whether the shifts are stable, for a mask whose scheme converges; `None` where that is not decided.
pub(super) fn is_stable(mask: &[RBig], arity: usize) -> Option<bool> {
    let length = mask.len();
    if length > MOST_WEIGHTS {
        return None;
    }
    let mut c = vec![RBig::ZERO; 2 * length - 1];
    for (i, x) in mask.iter().enumerate() {
        for (j, y) in mask.iter().enumerate() {
            c[i + length - 1 - j] += x * y / RBig::from(arity);
        }
    }
    // r_i = sum_k c_k r_(m i - k), |k| < length and |i| <= reach
    let reach = ((length - 1) / (arity - 1)) as i64;
    let at = |i: i64, j: i64| {
        let index = arity as i64 * i - j + length as i64 - 1;
        usize::try_from(index).ok().and_then(|index| c.get(index)).cloned().unwrap_or(RBig::ZERO)
    };
    let matrix = (-reach..=reach).map(|i| (-reach..=reach).map(|j| at(i, j)).collect()).collect();
    let vectors = null_space(&less(&matrix, &RBig::ONE));
    let [r] = vectors.as_slice() else { return None };
    let total = r.iter().fold(RBig::ZERO, |sum, x| sum + x);
    if total.is_zero() {
        return None;
    }
    let half: Vec<RBig> = r[reach as usize..].iter().map(|x| x / &total).collect();
    let polynomial = in_cosine(&half);
    let low = sign_changes(&polynomial, &RBig::from(-1));
    let high = sign_changes(&polynomial, &RBig::ONE);
    let at_low = value(&polynomial, &RBig::from(-1));
    Some(low == high && !at_low.is_zero())
}

/// r_0 + 2 sum r_i cos(i t) as a polynomial in cos t.
fn in_cosine(half: &[RBig]) -> Vec<RBig> {
    let mut sum = vec![RBig::ZERO; half.len().max(1)];
    let (mut before, mut now) = (vec![RBig::ONE], vec![RBig::ZERO, RBig::ONE]);
    for (i, r) in half.iter().enumerate() {
        let factor = if i == 0 { r.clone() } else { RBig::from(2) * r };
        before.iter().enumerate().for_each(|(k, x)| sum[k] += &factor * x);
        let mut next = vec![RBig::ZERO; now.len() + 1];
        now.iter().enumerate().for_each(|(k, x)| next[k + 1] += RBig::from(2) * x);
        before.iter().enumerate().for_each(|(k, x)| next[k] -= x);
        (before, now) = (now, next);
    }
    trimmed(sum)
}

fn trimmed(mut p: Vec<RBig>) -> Vec<RBig> {
    while p.last().is_some_and(RBig::is_zero) {
        p.pop();
    }
    p
}

fn value(p: &[RBig], x: &RBig) -> RBig {
    p.iter().rev().fold(RBig::ZERO, |sum, c| sum * x + c)
}

/// The changes of sign in Sturm's chain at x.
fn sign_changes(p: &[RBig], x: &RBig) -> usize {
    let mut chain = vec![p.to_vec()];
    let mut next: Vec<RBig> = p.iter().enumerate().skip(1).map(|(k, c)| c * RBig::from(k)).collect();
    while !next.is_empty() {
        let rest = negative_remainder(&chain[chain.len() - 1], &next);
        chain.push(next);
        next = rest;
    }
    let signs: Vec<bool> = chain.iter().map(|p| value(p, x)).filter(|v| !v.is_zero()).map(|v| v > RBig::ZERO).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

fn negative_remainder(a: &[RBig], b: &[RBig]) -> Vec<RBig> {
    let mut rest = a.to_vec();
    while rest.len() >= b.len() {
        let (top, shift) = (&rest[rest.len() - 1] / &b[b.len() - 1], rest.len() - b.len());
        b.iter().enumerate().for_each(|(k, c)| rest[k + shift] -= &top * c);
        rest.pop();
    }
    trimmed(rest).into_iter().map(|x| -x).collect()
}
