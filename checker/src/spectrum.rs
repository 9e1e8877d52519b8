//! Is lambda the largest eigenvalue but 1, and simple at frequency 1?
//!
//! Cores are unknowns that need each other; their zeros are in a disc if some polynomials are positive (Schur, Cohn).

use crate::certificate::{Certificate, parameter};
use crate::cosine::{cosine, pi};
use crate::formula::Count;
use crate::map::{check_eigenvector, lifted, patches};
use crate::net::{Pair, basis, moved, place, row, sum};
use crate::polynomial::{C, K, P, Poly, Ranges, T};
use crate::scheme::{Index, Scheme};
use crate::{Refusal, beyond, require};
use dashu_ratio::RBig;
use std::collections::btree_map::{BTreeMap, Entry};

/// The characteristic polynomial of a core, low to high, by the recursion of Faddeev and Le Verrier.
fn characteristic(matrix: &[Vec<Poly>], core: &[usize]) -> Vec<Poly> {
    let size = core.len();
    let (mut own, mut power) = (vec![Poly::number(1)], vec![vec![Poly::default(); size]; size]);
    for k in 1..=size {
        (0..size).for_each(|i| power[i][i] = &power[i][i] + &own[0]);
        let term = |i: usize, l: usize, j: usize| &matrix[core[i]][core[l]] * &power[l][j];
        let dot = |i, j| (0..size).fold(Poly::default(), |sum, l| &sum + &term(i, l, j));
        power = (0..size).map(|i| (0..size).map(|j| dot(i, j)).collect()).collect();
        let trace = (0..size).fold(Poly::default(), |sum, i| &sum + &power[i][i]);
        own.insert(0, trace.scaled(RBig::from(-1) / RBig::from(k)));
    }
    own
}

/// Whether all zeros have a modulus below a radius: Schur and Cohn's test.
fn is_inside(own: &[Poly], radius: &Poly, positive: &dyn Fn(&Poly) -> bool) -> bool {
    let mut own: Vec<Poly> = (0..).zip(own).map(|(i, own)| own * &radius.raised(i)).collect();
    while let [first, .., last] = &own[..] {
        if !positive(&(&(last * last) - &(first * first))) {
            return false;
        }
        let d = own.len() - 1;
        own = (0..d).map(|i| &(last * &own[i + 1]) - &(first * &own[d - 1 - i])).collect();
    }
    true
}

/// Quotient and remainder by a monic polynomial.
fn divided(own: &[Poly], by: &[Poly]) -> (Vec<Poly>, Vec<Poly>) {
    let (mut rest, mut quotient) = (own.to_vec(), vec![]);
    while rest.len() >= by.len() {
        let lead = rest.pop().unwrap_or_default();
        let shift = rest.len() + 1 - by.len();
        (0..by.len() - 1).for_each(|i| rest[shift + i] = &rest[shift + i] - &(&lead * &by[i]));
        quotient.insert(0, lead);
    }
    (quotient, rest)
}

/// The characteristic polynomials of the cores of a frequency, on all points that the ring and these points need.
fn cores(scheme: &Scheme, k: i64, count: Count) -> Result<Vec<Vec<Poly>>, Refusal> {
    let (lattice, mut rows) = (scheme.lattice, BTreeMap::new());
    let ring = patches(lattice).concat().into_iter();
    let mut open: Vec<Index> = ring.filter_map(|own| Some(place(lattice, own.0, k)?.0)).collect();
    while let Some(at) = open.pop() {
        if let Entry::Vacant(entry) = rows.entry(at) {
            open.extend(entry.insert(row(scheme, at, k, count)?).iter().map(|(old, _)| old.0));
        }
    }
    let mut unknowns = Vec::new();
    rows.keys().for_each(|at| unknowns.extend(basis(lattice, *at, k).into_iter().map(|own| (at, own))));
    let mut matrix = Vec::new();
    for (at, (_, i)) in &unknowns {
        let entry = |(column, (pair, _)): &(&Index, (Pair, usize))| {
            let near = rows[*at].iter().filter(|(old, _)| old.0 == **column);
            sum(near.map(|(old, weight)| (moved(pair, *old, k), weight.clone())))[*i].clone()
        };
        matrix.push(unknowns.iter().map(entry).collect::<Vec<Poly>>());
    }
    let size = matrix.len();
    let mut needs: Vec<Vec<bool>> =
        matrix.iter().map(|row| row.iter().map(|own| *own != Poly::default()).collect()).collect();
    for (l, i, j) in (0..size).flat_map(|l| (0..size * size).map(move |ij| (l, ij / size, ij % size))) {
        needs[i][j] |= needs[i][l] && needs[l][j];
    }
    let core = |first: usize| (0..size).filter(|j| needs[first][*j] && needs[*j][first]).collect::<Vec<usize>>();
    let cores: Vec<_> = (0..size).filter(|first| core(*first).first() == Some(first)).map(core).collect();
    Ok(cores.iter().map(|core| characteristic(&matrix, core)).collect())
}

/// The net and the eigenvalues at every valence of the claim.
pub(crate) fn check(scheme: &Scheme, certificate: &Certificate) -> Result<(), Refusal> {
    let (c, lambda, [lo, hi]) = (&certificate.c, &certificate.lambda(), certificate.range.map(parameter));
    let (one, minus, unit, all) = (RBig::ONE, RBig::from(-1), Poly::number(1), [(P, lo.clone(), hi.clone())]);
    let grows = lambda.as_number().is_some() || lambda.slope(P).is_positive(&all);
    let proper = grows && lambda.is_positive(&all) && (&unit - lambda).is_positive(&all);
    require(lo < hi && c[1].is_positive(&all) && proper, "c or lambda on the range")?;
    let at = |own: &Poly, p: &RBig| own.with(P, &Poly::number(p.clone()));
    let in_p = |own: &Poly| lifted(own, c, own.powers(C).1);
    // the parameters of these valences are from low to high; frequency 0 has 1 for constants
    let trial = |count: Count, low: &RBig, high: &RBig, last: &RBig| {
        let ends = [(low, &cosine(1, count.n)[0]), (high, last)];
        let ends = ends.map(|(p, cosine)| at(&(&c[0] - &c[1].scaled(cosine.clone())), p).as_number());
        let holds = matches!(ends, [Some(low), Some(high)] if low <= RBig::ZERO && RBig::ZERO <= high);
        let inside = lo <= *low && low <= high && *high <= hi;
        require(holds && inside, format!("{count:?}: c doesn't take the cosine's value"))?;
        let weights = row(scheme, (0, 0), 0, count)?.into_iter().fold(Poly::default(), |sum, (_, own)| &sum + &own);
        require(weights == Poly::number(1), format!("{count:?}: weights don't sum to 1"))?;
        check_eigenvector(scheme, certificate, count)
    };
    // on a box all of frequency k are below the radius, but for a simple one of frequency 0 or 1; `alike` keeps signs
    let check = |count: Count, radius: &Poly, k: i64, on: &Ranges, alike: &dyn Fn(&Poly) -> Poly| {
        let inside = |own: &[Poly]| is_inside(own, radius, &|own| alike(own).is_positive(on));
        let (cores, known) = (cores(scheme, k, count)?, [&unit, lambda].get(k as usize).copied());
        let outside: Vec<&Vec<Poly>> = cores.iter().filter(|own| !inside(own)).collect();
        let holds = match (known, &outside[..]) {
            (Some(known), [own]) => {
                let (others, rest) = divided(own, &[known.scaled(-1), unit.clone()]);
                rest.iter().all(|own| alike(own) == Poly::default()) && inside(&others)
            }
            (known, outside) => known.is_none() && outside.is_empty(),
        };
        require(holds, format!("{count:?}, frequency {k}: an eigenvalue is not seen to be small, or to be simple"))
    };
    for (n, own) in (certificate.from..).zip(&certificate.each) {
        let ([low, high], count) = (own.map(parameter), Count { n, tail: false });
        trial(count, &low, &high, &cosine(1, n)[1])?;
        let radius = at(lambda, &low);
        check(count, &radius, 1, &[(P, low, high)], &in_p)?;
        for (k, [low, high]) in (0..=n / 2).filter(|k| *k != 1).map(|k| (k, cosine(k.max(1), n))) {
            check(count, &radius, k, &[(C, low, high)], &Poly::clone)?;
        }
    }

    // all further n in t = 1/n, c = 1 - kappa t^2, where what is positive for t > 0 may go to 0 (docs/certificate.md)
    let (low, count) = (parameter(certificate.tail), Count { n: certificate.next(), tail: true });
    trial(count, &low, &hi, &one)?;
    let (radius, first, [pi, more]) = (at(lambda, &low), RBig::from(count.n), pi().map(|pi| &pi * &pi));
    let least = (&one - &more / (RBig::from(3) * &first * &first)) * pi * RBig::from(2);
    let on = [(P, low.clone(), hi.clone()), (T, RBig::ZERO, &one / first), (K, least, more * RBig::from(2))];
    let cosine = &unit - &(&Poly::power_of(K, 1) * &Poly::power_of(T, 2));
    let equation = (&c[0] - &(&c[1] * &cosine)).by_power(P);
    let lead = equation.last().filter(|own| own.as_number().is_some()).and_then(Poly::inverse);
    let Some(lead) = lead else { return beyond("an equation of p whose leading coefficient is not a number") };
    let equation: Vec<Poly> = equation.iter().map(|own| own * &lead).collect();
    let in_t = |own: &Poly| {
        let own = Poly::sum(&divided(&own.with(C, &cosine).by_power(P), &equation).1, &Poly::power_of(P, 1));
        &own * &Poly::power_of(T, -own.powers(T).0)
    };
    check(count, lambda, 0, &on, &in_t)?;
    if scheme.centre(1, count) != scheme.centre(2, count) {
        check(count, &radius, 1, &[(P, low, hi)], &in_p)?;
        return check(count, &radius, 2, &[(C, minus, one)], &Poly::clone);
    }
    // frequencies k >= 2 have the eigenvalues of frequency 1 at a smaller p, where c_k is not too small
    let slope = &(&c[0].slope(P) * &c[1]) - &(&c[1].slope(P) * &c[0]);
    require(lambda.as_number().is_none() && slope.is_positive(&all), "c and lambda are not seen to grow with p")?;
    check(count, &radius, 1, &all, &in_p)?;
    let [above, below] = c.each_ref().map(|own| at(own, &lo).as_number().unwrap_or_default());
    check(count, &radius, 2, &[(C, minus.clone(), minus.max(above / below))], &Poly::clone)
}
