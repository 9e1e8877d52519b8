//! By how much do some steps of a scheme enlarge data at most?
//!
//! By the norm of the steps: the largest sum of moduli of the mask of a(z) a(z^2) ... over a coset. It is found in
//! whole numbers over a denominator.

use crate::analysis::regular::mask::{Point, Sequence, bounds};
use dashu_ratio::RBig;

/// The most steps K that norms are found for.
const MOST_STEPS: usize = 6;

/// The most products of numbers for one norm.
const MOST_PRODUCTS: usize = 20_000_000;

/// A mask of whole numbers over one denominator, on a rectangle, row by row.
struct Grid {
    width: usize,
    values: Vec<i128>,
    denominator: i128,
}

impl Grid {
    /// `None` where a number isn't rational, or too large.
    fn of(sequence: &Sequence) -> Option<Grid> {
        let (low, high) = bounds(sequence)?;
        let width = usize::try_from(high[0] - low[0] + 1).ok()?;
        let height = usize::try_from(high[1] - low[1] + 1).ok()?;
        let numbers: Vec<(Point, RBig)> =
            sequence.iter().map(|(point, value)| Some((*point, value.as_rational()?))).collect::<Option<_>>()?;
        let mut denominator = 1_i128;
        for (_, value) in &numbers {
            let own = i128::try_from(value.denominator().clone()).ok()?;
            denominator = denominator.checked_mul(own / common(denominator, own))?;
        }
        let mut values = vec![0; width * height];
        for ([x, y], value) in &numbers {
            let whole = (value * RBig::from(denominator)).numerator().clone();
            values[(y - low[1]) as usize * width + (x - low[0]) as usize] = i128::try_from(whole).ok()?;
        }
        Some(Grid { width, values, denominator })
    }

    fn height(&self) -> usize {
        self.values.len() / self.width
    }

    /// The largest sum of moduli over a coset of 2^k, in units of the denominator.
    fn sum(&self, steps: usize) -> Option<i128> {
        let m = 1_usize << steps;
        let mut sums = vec![0_i128; m * m];
        for (row, line) in self.values.chunks(self.width).enumerate() {
            for (at, value) in line.iter().enumerate() {
                let sum = &mut sums[row % m * m + at % m];
                *sum = sum.checked_add(value.checked_abs()?)?;
            }
        }
        sums.into_iter().max()
    }

    /// The mask of one step more: a(z) b(z^(2^k)).
    fn step_more(&self, one: &Grid, steps: usize) -> Option<Grid> {
        let stretch = 1 << steps;
        let taps = one.values.iter().filter(|value| **value != 0).count();
        if self.values.len().checked_mul(taps)? > MOST_PRODUCTS {
            return None;
        }
        let width = self.width + stretch * (one.width - 1);
        let height = self.height() + stretch * (one.height() - 1);
        let mut values = vec![0; width * height];
        for (at, factor) in one.values.iter().enumerate().filter(|(_, factor)| **factor != 0) {
            let (x, y) = (stretch * (at % one.width), stretch * (at / one.width));
            for (row, line) in self.values.chunks(self.width).enumerate() {
                let start = (y + row) * width + x;
                for (sum, value) in values[start..].iter_mut().zip(line) {
                    // moduli sum to at most sum(1)^(steps + 1), which fits: see `norms`
                    *sum += value * factor;
                }
            }
        }
        Some(Grid { width, values, denominator: self.denominator.checked_mul(one.denominator)? })
    }
}

fn common(mut a: i128, mut b: i128) -> i128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}

/// The norms of the first iterates, as many as there is room for.
pub fn norms(sequence: &Sequence) -> Vec<RBig> {
    let mut found = Vec::new();
    let Some(one) = Grid::of(sequence) else { return found };
    let Some(largest) = one.sum(1) else { return found };
    let mut iterated = Grid { width: one.width, values: one.values.clone(), denominator: one.denominator };
    for steps in 1..=MOST_STEPS {
        let Some(sum) = iterated.sum(steps) else { break };
        found.push(RBig::from(sum) / RBig::from(iterated.denominator));
        // no sum of moduli passes this
        if largest.checked_pow(steps as u32 + 1).is_none() {
            break;
        }
        let Some(next) = iterated.step_more(&one, steps) else { break };
        iterated = next;
    }
    found
}

#[cfg(test)]
pub(crate) mod tests {
    use super::super::lebesgue::differences;
    use super::*;
    use crate::analysis::regular::mask::Mask;
    use crate::numbers::{Field, Free};
    use crate::scheme::catalogue;
    use std::collections::BTreeMap;

    pub(crate) fn mask(id: &str) -> Sequence {
        Mask::of(&catalogue::open(id).unwrap().unwrap().with_values()).unwrap().coefficients
    }

    pub(crate) fn refined(data: &BTreeMap<Point, RBig>, mask: &Sequence) -> BTreeMap<Point, RBig> {
        let mut fine = BTreeMap::new();
        for ([x, y], value) in data {
            for ([a, b], weight) in mask {
                *fine.entry([2 * x + a, 2 * y + b]).or_insert(RBig::ZERO) += value * weight.as_rational().unwrap();
            }
        }
        fine
    }

    pub(crate) fn twice(mask: &Sequence, v: Point) -> Sequence {
        let own = differences(mask, v).unwrap().unwrap();
        own.into_iter().map(|(point, weight)| (point, weight.times(&Free::whole(2)).unwrap())).collect()
    }

    /// The norm is the largest sum of moduli that a new point is made with: seen by refining a unit.
    #[test]
    fn norms_are_those_of_refined_units() {
        for scheme in [mask("butterfly"), twice(&mask("butterfly"), [1, 0]), twice(&mask("loop"), [0, 1])] {
            let mut data: BTreeMap<Point, RBig> = [([0, 0], RBig::ONE)].into();
            for (steps, norm) in norms(&scheme).into_iter().take(3).enumerate() {
                data = refined(&data, &scheme);
                let m = 2 << steps;
                let mut sums: BTreeMap<Point, RBig> = BTreeMap::new();
                for ([x, y], value) in &data {
                    let modulus = if *value < RBig::ZERO { -value.clone() } else { value.clone() };
                    *sums.entry([x.rem_euclid(m), y.rem_euclid(m)]).or_insert(RBig::ZERO) += modulus;
                }
                assert_eq!(sums.into_values().max().unwrap(), norm);
            }
        }
    }

    /// Whole numbers that grow beyond 128 bits end the list; they don't overflow.
    #[test]
    fn large_numbers_end_the_list() {
        let huge: Sequence = [([0, 0], Free::whole(1 << 60)), ([1, 0], Free::whole(-(1 << 60)))].into();
        assert_eq!(norms(&huge).len(), 2);
        assert_eq!(norms(&Sequence::new()), vec![]);
    }
}
