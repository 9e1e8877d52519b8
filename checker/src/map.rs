//! Is the map of the certificate an eigenvector's, regular and injective?
//!
//! All in polynomials of p: what is of degree e in c is multiplied by the e-th power of c's positive denominator.

use crate::certificate::{Certificate, parameter};
use crate::formula::Count;
use crate::net::{Pair, Place, basis, moved, place, row, sum};
use crate::polynomial::{C, K, P, Poly, T, U, Z, choose};
use crate::scheme::{Index, Lattice, Scheme};
use crate::{Refusal, require};
use dashu_ratio::RBig;

/// A polynomial in c and p as one in p, times the e-th power of c's denominator.
pub(crate) fn lifted(own: &Poly, [c, below]: &[Poly; 2], e: i32) -> Poly {
    let parts = (0..).zip(own.by_power(C));
    parts.fold(Poly::default(), |sum, (i, part)| &sum + &(&part * &(&c.raised(i) * &below.raised(e - i))))
}

/// The value of the net at a place.
fn at(certificate: &Certificate, place: Place) -> Result<Pair, Refusal> {
    let found = certificate.net.iter().find(|own| own.0 == place.0);
    require(found.is_some(), format!("the net has no point {:?}", place.0))?;
    Ok(found.map(|(_, value)| moved(value, place, 1)).unwrap_or_default())
}

/// S f = lambda f at every point, and the reflection.
pub(crate) fn check_eigenvector(scheme: &Scheme, certificate: &Certificate, count: Count) -> Result<(), Refusal> {
    let (c, lambda) = (&certificate.c, certificate.lambda());
    for (own, value) in &certificate.net {
        let mut holds = own.0 > 0 || scheme.lattice == Lattice::Dual;
        if let [([x, y], _)] = &basis(scheme.lattice, *own, 1)[..] {
            holds &= lifted(&(&(x * &value[1]) - &(y * &value[0])), c, 1) == Poly::default();
        }
        let mut terms = Vec::new();
        for (old, weight) in row(scheme, *own, 1, count)? {
            terms.push((at(certificate, old)?, weight));
        }
        for (image, value) in sum(terms.into_iter()).iter().zip(value) {
            let e = image.powers(C).1;
            holds &= lifted(image, c, e) == &(&lambda * &c[1].raised(e)) * value;
        }
        require(holds, format!("{count:?}: S f = lambda f doesn't hold at {own:?}, or not in the mirror"))?;
    }
    Ok(())
}

/// The controls of the triangle (0, 0), (1, 0), (0, 1).
const TRIANGLE: [Index; 12] =
    [(-1, 0), (0, -1), (-1, 1), (0, 0), (1, -1), (-1, 2), (0, 1), (1, 0), (2, -1), (0, 2), (1, 1), (2, 0)];
/// 24 times their weights in the Bezier points of u^i v^j w^(4 - i - j), as digits up to c; i counts from 0 for each j.
const QUARTIC: &str =
    "222c20220000 011c30340000 000840480000 0004303c1010 0002202c2022 103c10430000 001a10660000 0006106a0010
    0003104c0031 004800840000 001600a60010 000400880040 003401c30010 001300c40130 002202c20220";

/// The functions of u, v, written t, z, that a patch's controls are multiplied by; on triangles u + v <= 1.
fn spline(lattice: Lattice) -> Vec<(Index, Poly)> {
    let (u, v) = (Poly::power_of(T, 1), Poly::power_of(Z, 1));
    let one: &[&[i64]] = match lattice {
        Lattice::Triangles => {
            let w = &(&Poly::number(1) - &u) - &v;
            let uv = |i, j| (&u.raised(i) * &v.raised(j)).scaled(choose(4, i) * choose(4 - i, j));
            let power = |i, j| &uv(i, j) * &w.raised(4 - i - j);
            let at = (0..5).flat_map(|j| (0..5 - j).map(move |i| (i, j)));
            let powers: Vec<_> = at.zip(QUARTIC.split_whitespace()).map(|((i, j), row)| (power(i, j), row)).collect();
            let weight = |row: &str, at| row.chars().nth(at).and_then(|own| own.to_digit(13)).unwrap_or(0);
            let sum = |at| powers.iter().fold(Poly::default(), |sum, (own, row)| &sum + &own.scaled(weight(row, at)));
            return TRIANGLE.iter().enumerate().map(|(at, own)| (*own, sum(at))).collect();
        }
        Lattice::Quads => &[&[1, -3, 3, -1], &[4, 0, -6, 3], &[1, 3, 3, -3], &[0, 0, 0, 1]],
        Lattice::Dual => &[&[1, -2, 1], &[1, 2, -2], &[0, 0, 1]],
    };
    let own = |row: &[i64], of| Poly::sum(&row.iter().map(|own| Poly::number(*own)).collect::<Vec<_>>(), of);
    let both = |i: usize, j: usize| ((i as i32 - 1, j as i32 - 1), &own(one[i], &u) * &own(one[j], &v));
    (0..one.len()).flat_map(|i| (0..one.len()).map(move |j| (i, j))).map(|(i, j)| both(i, j)).collect()
}

/// The two patches of half a ring, from the one at (0, 0) by a shift; the second triangle points down.
pub(crate) fn patches(lattice: Lattice) -> [Vec<(Index, Poly)>; 2] {
    let second = |(a, b)| if lattice == Lattice::Triangles { (1 - a, 1 - b) } else { (1 + a, 1 + b) };
    let all = spline(lattice).into_iter();
    [all.clone().map(|((a, b), own)| ((1 + a, b), own)).collect(), all.map(|(at, own)| (second(at), own)).collect()]
}

/// For all p the Jacobian is positive on the patches, and these lie in the half plane around the sector's axis.
pub(crate) fn check_patches(scheme: &Scheme, certificate: &Certificate) -> Result<(), Refusal> {
    let (c, lattice, [lo, hi]) = (&certificate.c, scheme.lattice, certificate.range.map(parameter));
    // a triangle is the unit square with one side made a point: u = s (1 - r), v = s r, written kappa for s, u for r
    let (s, r) = (Poly::power_of(K, 1), Poly::power_of(U, 1));
    let square = |own: &Poly| match lattice {
        Lattice::Triangles => own.with(T, &(&s - &(&s * &r))).with(Z, &(&s * &r)),
        _ => own.clone(),
    };
    let unit = [T, Z, K, U].map(|index| (index, RBig::ZERO, RBig::ONE));
    let on = [&[(P, lo, hi)], &unit[..]].concat();
    for patch in patches(lattice) {
        let mut terms = Vec::new();
        for (own, function) in patch {
            terms.push((place(lattice, own, 1).map_or(Ok(Pair::default()), |own| at(certificate, own))?, function));
        }
        let point = sum(terms.into_iter());
        let e = point[0].powers(C).1.max(point[1].powers(C).1);
        let [x, y] = point.map(|own| lifted(&own, c, e));
        let along = if lattice != Lattice::Dual { &(&x * &c[1]) + &(&y * &(&c[1] - &c[0])) } else { x.clone() };
        let jacobian = &(&x.slope(T) * &y.slope(Z)) - &(&x.slope(Z) * &y.slope(T));
        require(square(&along).is_positive(&on), "the map is not seen in the half plane around a sector's axis")?;
        require(square(&jacobian).is_positive(&on), "the map's Jacobian is not seen to be positive")?;
    }
    Ok(())
}
