//! What are the values of a net of one frequency, all around the centre?
//!
//! x + i sin(2 pi k/n) y is kept as (x, y): turned and reflected by c_k alone, which gives points with a < b, too.

use crate::formula::Count;
use crate::polynomial::{C, Poly};
use crate::scheme::{Index, Lattice, Scheme};
use crate::{Refusal, beyond};

/// A value (x, y).
pub(crate) type Pair = [Poly; 2];

/// A point of a sector's half, the sectors that it is turned by, and whether it was reflected before.
pub(crate) type Place = (Index, i32, bool);

/// The place of an unfolded point; none for a centre of frequencies other than 0.
pub(crate) fn place(lattice: Lattice, (mut a, mut b): Index, k: i64) -> Option<Place> {
    let (mut sector, slant, beside) =
        (0, i32::from(lattice == Lattice::Triangles), i32::from(lattice == Lattice::Dual));
    while a < 1 - beside || b < 0 {
        if lattice != Lattice::Dual && (a, b) == (0, 0) {
            return (k == 0).then_some(((0, 0), 0, false));
        }
        sector += if b < 0 { -1 } else { 1 };
        (a, b) = if b < 0 { (-b - beside, a + slant * b) } else { (b + slant * a, -a - beside) };
    }
    // reflected in the middle of sector 0 of dual quads, elsewhere in its first spoke, and turned back
    Some(((a.max(b), a.min(b)), sector + i32::from(a < b && lattice != Lattice::Dual), a < b))
}

/// The value at a place, from the one in sector 0.
pub(crate) fn moved([x, y]: &Pair, (_, sectors, reflected): Place, k: i64) -> Pair {
    let start = [x.clone(), if reflected { y.scaled(-1) } else { y.clone() }];
    let c = &Poly::power_of(C, 1);
    let turned = |[x, y]: Pair, _| {
        let across = &(&(c * c) - &Poly::number(1)) * &y;
        match sectors > 0 {
            true => [&(c * &x) + &across, &x + &(c * &y)],
            false => [&(c * &x) - &across, &(c * &y) - &x],
        }
    };
    if k == 0 { start } else { (0..sectors.abs()).fold(start, turned) }
}

/// The sum of weighted values at places.
pub(crate) fn sum(terms: impl Iterator<Item = (Pair, Poly)>) -> Pair {
    let next = |all: Pair, (own, by): (Pair, Poly)| std::array::from_fn(|i| &all[i] + &(&own[i] * &by));
    terms.fold(Pair::default(), next)
}

/// Pairs that make up the values which the reflection allows at a point, each with the entry that tells how much of it.
pub(crate) fn basis(lattice: Lattice, (a, b): Index, k: i64) -> Vec<(Pair, usize)> {
    let (one, zero) = (Poly::number(1), Poly::default());
    match a == b || (lattice != Lattice::Dual && b == 0) {
        true if k > 0 && lattice != Lattice::Dual && b > 0 => vec![([&one + &Poly::power_of(C, 1), one], 1)],
        true => vec![([one, zero], 0)],
        false => vec![([one.clone(), zero.clone()], 0), ([zero, one], 1)],
    }
}

/// The places that S f depends on at a point, for nets f of a frequency, and their weights.
pub(crate) fn row(scheme: &Scheme, at: Index, k: i64, count: Count) -> Result<Vec<(Place, Poly)>, Refusal> {
    let row = if at == (0, 0) { scheme.centre(k, count) } else { Some(scheme.lattice.row(at)) };
    let Some(row) = row else { return beyond(format!("the rule at the extraordinary point, {count:?}")) };
    Ok(row.into_iter().filter_map(|(old, weight)| Some((place(scheme.lattice, old, k)?, weight))).collect())
}
