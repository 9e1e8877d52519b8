//! How smooth are limits on regular meshes? What difference schemes prove.
//!
//! Let M = m I, and let the symbol have the factor of a direction v. The differences of data along v are refined by the scheme of
//! a(z) / (1 + z^v + ... + z^((m-1)v)), the divided differences by m times that. With two directions of determinant 1 or -1:
//!
//! - if the schemes of the differences along both are contractive, limits exist and are continuous;
//! - if the schemes of the divided differences along both have limits that are C^(k-1), those of the scheme are C^k.
//!
//! (Cavaretta, Dahmen and Micchelli 1991; Dyn 1992.) A scheme is contractive exactly when some power of it has a norm below 1: the
//! largest sum of moduli over a coset of M^L Z^2 of the L times iterated mask, here in whole numbers. Other ways than scalar difference
//! schemes are not tried: what isn't shown is not decided.

use super::factors::{Factors, cross, multiplied, scaled};
use super::mask::{Mask, Point, Sequence, bounds};
use crate::numbers::{Field, Free, Trouble};
use dashu_base::{Abs, Gcd, UnsignedAbs};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use std::collections::BTreeMap;

/// The most steps of which norms are looked at.
pub const MOST_STEPS: u32 = 12;

/// The most products of numbers for one norm.
const MOST_PRODUCTS: usize = 1_500_000;

/// A mask of whole numbers over one denominator, on a rectangle, row by row.
#[derive(Clone)]
pub(super) struct Grid {
    pub(super) width: usize,
    pub(super) values: Vec<IBig>,
    pub(super) denominator: UBig,
}

impl Grid {
    /// `None` where a number isn't rational.
    pub(super) fn of(sequence: &Sequence) -> Option<Grid> {
        let (low, high) = bounds(sequence)?;
        let width = (high[0] - low[0] + 1) as usize;
        let numbers: Vec<(Point, RBig)> =
            sequence.iter().map(|(point, value)| Some((*point, value.as_rational()?))).collect::<Option<_>>()?;
        let denominator = numbers.iter().fold(UBig::ONE, |product, (_, value)| {
            let own = value.denominator();
            let shared = (&product).gcd(own);
            product / shared * own
        });
        let mut values = vec![IBig::ZERO; width * (high[1] - low[1] + 1) as usize];
        for ([x, y], value) in numbers {
            let whole = value * RBig::from(denominator.clone());
            values[(y - low[1]) as usize * width + (x - low[0]) as usize] = whole.numerator().clone();
        }
        Some(Grid { width, values, denominator })
    }

    fn height(&self) -> usize {
        self.values.len() / self.width
    }

    /// The product b(z) c(z^stretch), one step more for stretch = m^L. `None` beyond the limit of products.
    pub(super) fn times_stretched(&self, other: &Grid, stretch: usize) -> Option<Grid> {
        let taps = other.values.iter().filter(|value| !value.is_zero()).count();
        if self.values.len().checked_mul(taps)? > MOST_PRODUCTS {
            return None;
        }
        let width = self.width + stretch * (other.width - 1);
        let height = self.height() + stretch * (other.height() - 1);
        let mut values = vec![IBig::ZERO; width * height];
        for (at, factor) in other.values.iter().enumerate().filter(|(_, factor)| !factor.is_zero()) {
            let (x, y) = (stretch * (at % other.width), stretch * (at / other.width));
            for (row, line) in self.values.chunks(self.width).enumerate() {
                let start = (y + row) * width + x;
                for (sum, value) in values[start..].iter_mut().zip(line) {
                    *sum += value * factor;
                }
            }
        }
        Some(Grid { width, values, denominator: &self.denominator * &other.denominator })
    }

    /// The norm of the scheme with this mask and the dilation matrix m I.
    fn norm(&self, m: usize) -> RBig {
        let mut sums = BTreeMap::new();
        for (at, value) in self.values.iter().enumerate() {
            let coset = (at % self.width % m, at / self.width % m);
            *sums.entry(coset).or_insert(UBig::ZERO) += value.clone().abs().unsigned_abs();
        }
        RBig::from_parts(sums.into_values().max().unwrap_or_default().into(), self.denominator.clone())
    }
}

/// A number of steps whose norm is below 1, with the norm.
#[derive(Clone, Debug, PartialEq)]
pub struct Contraction {
    /// The number of steps.
    pub steps: u32,
    /// The norm of the scheme iterated so often.
    pub norm: RBig,
    /// It is below this.
    pub below: RBig,
}

/// The least number of steps after which the norm of a scheme is below 1, up to stated limits.
fn contraction(sequence: &Sequence, m: i32) -> Option<Contraction> {
    let m = m as usize;
    let one = Grid::of(sequence)?;
    let mut iterated = Grid::of(sequence)?;
    let mut stretch = m;
    for steps in 1..=MOST_STEPS {
        let norm = iterated.norm(stretch);
        if norm < RBig::ONE {
            return Some(Contraction { steps, norm, below: RBig::ONE });
        }
        iterated = iterated.times_stretched(&one, stretch)?;
        stretch = stretch.checked_mul(m)?;
    }
    None
}

/// What difference schemes prove.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Proof {
    /// The difference schemes that were shown to be contractive: their directions, with the multiplicities that were divided by, the
    /// last factor being that of the differences.
    pub contractive: Vec<(Vec<Point>, Contraction)>,
    /// The order of differences in all directions and how they shrink, where the symbol lacks factors.
    pub all: Option<(usize, Contraction)>,
}

/// Looks for proofs, each difference scheme once.
pub struct Differences<'a> {
    factors: &'a Factors,
    m: i32,
    known: BTreeMap<Vec<usize>, Option<Contraction>>,
}

impl<'a> Differences<'a> {
    /// The difference schemes of a mask; `None` for a dilation matrix other than m I.
    pub fn of(mask: &Mask, factors: &'a Factors) -> Option<Differences<'a>> {
        Some(Differences { factors, m: mask.dilation.arity()?, known: BTreeMap::new() })
    }

    /// Whether limits are shown to be C^k.
    ///
    /// # Errors
    /// When the numbers pass a limit of size.
    pub fn prove(&mut self, k: usize) -> Result<Option<Proof>, Trouble> {
        let left: Vec<usize> = self.factors.directions.iter().map(|(_, times)| *times).collect();
        self.search(&left, k)
    }

    /// The pairs of directions that are left, of determinant 1 or -1.
    fn pairs(&self, left: &[usize]) -> Vec<[usize; 2]> {
        let line = |i: usize| self.factors.directions[i].0;
        let there: Vec<usize> = (0..left.len()).filter(|i| left[*i] > 0).collect();
        let pairs = there.iter().flat_map(|i| there.iter().map(move |j| [*i, *j]));
        pairs.filter(|[i, j]| i < j && cross(line(*i), line(*j)).abs() == 1).collect()
    }

    fn search(&mut self, left: &[usize], k: usize) -> Result<Option<Proof>, Trouble> {
        'pairs: for pair in self.pairs(left) {
            let mut proof = Proof::default();
            for direction in pair {
                let mut rest = left.to_vec();
                rest[direction] -= 1;
                if k > 0 {
                    let Some(inner) = self.search(&rest, k - 1)? else { continue 'pairs };
                    proof.contractive.extend(inner.contractive);
                } else {
                    let Some(found) = self.contraction(&rest)? else { continue 'pairs };
                    proof.contractive.push((self.taken(&rest), found));
                }
            }
            proof.contractive.sort_by(|(a, _), (b, _)| a.cmp(b));
            proof.contractive.dedup();
            return Ok(Some(proof));
        }
        Ok(None)
    }

    /// The directions that were divided by.
    fn taken(&self, left: &[usize]) -> Vec<Point> {
        let all = self.factors.directions.iter().zip(left);
        all.flat_map(|((direction, times), left)| vec![*direction; times - left]).collect()
    }

    /// The contraction of the differences of divided differences, of which all directions but one were taken.
    fn contraction(&mut self, left: &[usize]) -> Result<Option<Contraction>, Trouble> {
        if let Some(known) = self.known.get(left) {
            return Ok(known.clone());
        }
        let taken = self.factors.count() - left.iter().sum::<usize>();
        let mut sequence = self.factors.kernel.clone();
        for ((direction, _), times) in self.factors.directions.iter().zip(left) {
            for _ in 0..*times {
                sequence = multiplied(&sequence, *direction, self.m)?;
            }
        }
        let divided = RBig::from(self.m).pow(taken.saturating_sub(1) as isize);
        let scale = Free::rational(&divided);
        let found = contraction(&scaled(&sequence, &scale)?, self.m);
        self.known.insert(left.to_vec(), found.clone());
        Ok(found)
    }
}
