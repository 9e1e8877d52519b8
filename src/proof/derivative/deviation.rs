//! How far are derivatives of a limit over a cell from those of a polynomial through some of its points, and its values?
//!
//! Let P p be the polynomial of a degree through as many of a cell's points as it takes, y = p - P p the deviation of data p from it,
//! and |y| the largest of |y_j|/w_j for positive units w. Where the rows A_i of a part i keep such polynomials, the deviation of
//! the part's data is B_i y, B_i = (1 - P) A_i. Let F be slopes, or values, at corners of the cell: affine in the place, and such that those of P A_i P p
//! are those of P p, times 1/d for slopes. Then from level to level they change by F P A_i y, and those of the limit are within C |y| of those of P p,
//!
//! > C = (r_0 + ... + r_(K-1))/(1 - n_K),
//!
//! where r_k and n_k are bounds of d^k |F P A_i B_w| and d^k |B_w| over all words w of k parts (for values without d^k). They are found on trees of words whose
//! branches end where the norm is small (docs/theory.md).

use super::cells::{BASE, Local, Part, Row};
use crate::analysis::regular::mask::Point;
use crate::numbers::Interval;
use crate::numbers::linear::null_space;
use dashu_ratio::RBig;

/// Which functions of data are enclosed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// The derivatives along both axes.
    Slopes,
    /// The values.
    Values,
}

/// The bound for one kind of function, by polynomials of one degree.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// For each kind of function (two slopes, or one value) and each corner of a cell the weights on the first points, whose number is that of the polynomials'
    /// coefficients.
    pub functions: Vec<Vec<Vec<Interval>>>,
    /// For each of the other points the weights of P on the first.
    pub polynomial: Vec<Vec<Interval>>,
    /// w, for each of the other points.
    pub units: Vec<f64>,
    /// C.
    pub bound: f64,
    /// K.
    pub steps: usize,
}

/// A row vector on deviations: for each point that polynomials are not told by a number.
type Covector = Vec<Interval>;

/// The rows of B_i, without what is 0.
type Sparse = Vec<Vec<(usize, Interval)>>;

/// A branch ends where d^k times the norm is at most this: at the first where trees have room for it, else at the second.
const SMALL: [f64; 2] = [0.5, 0.85];

/// The most products of numbers for a tree.
const MOST_PRODUCTS: usize = 60_000_000;

/// The most K.
const MOST_STEPS: usize = 64;

/// How many units are tried.
const ROUNDS: usize = 4;

/// The bound for slopes by polynomials of the largest degree, 2 or 1, that rules keep, for values by affine functions; or why there is none.
///
/// # Errors
/// In words.
pub fn deviation(local: &Local, what: What) -> Result<Deviation, &'static str> {
    let mut why = "regular rules don't reproduce affine functions";
    let degrees: &[usize] = if what == What::Slopes { &[2, 1] } else { &[1] };
    for degree in degrees {
        let polynomials = Polynomials::new(*degree);
        if !local.parts.iter().all(|part| polynomials.are_kept(local, part, what)) {
            continue;
        }
        if let Some(found) = bound(local, &polynomials, what) {
            return Ok(found);
        }
        why = "deviations from polynomials are not seen to contract faster than cells";
    }
    Err(why)
}

/// The polynomials of a degree, by their values at the first points.
struct Polynomials {
    /// The powers of x and y of each monomial.
    monomials: &'static [[u32; 2]],
    /// For each of the first points the coefficients of the polynomial that is 1 there and 0 at the others.
    basis: Vec<Vec<RBig>>,
}

impl Polynomials {
    fn new(degree: usize) -> Polynomials {
        const MONOMIALS: [[u32; 2]; 6] = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];
        let monomials = if degree == 2 { &MONOMIALS[..] } else { &MONOMIALS[..3] };
        let basis = (0..monomials.len()).map(|own| basic(monomials, own)).collect();
        Polynomials { monomials, basis }
    }

    /// The number of coefficients, which is that of the points.
    fn count(&self) -> usize {
        self.monomials.len()
    }

    /// The weights of the value at a place on the first points.
    fn value(&self, place: &[RBig; 2]) -> Vec<RBig> {
        self.applied(|powers| monomial(powers, place))
    }

    /// The weights of the derivative along an axis at a place.
    fn slope(&self, place: &[RBig; 2], axis: usize) -> Vec<RBig> {
        self.applied(|mut powers| {
            let power = powers[axis];
            powers[axis] = power.saturating_sub(1);
            monomial(powers, place) * RBig::from(power)
        })
    }

    fn applied(&self, of: impl Fn([u32; 2]) -> RBig) -> Vec<RBig> {
        let values: Vec<RBig> = self.monomials.iter().map(|powers| of(*powers)).collect();
        let sum = |own: &Vec<RBig>| own.iter().zip(&values).fold(RBig::ZERO, |sum, (a, b)| sum + a * b);
        self.basis.iter().map(sum).collect()
    }

    /// The functions at a corner of a cell.
    fn functions(&self, corner: &[RBig; 2], what: What) -> Vec<Vec<RBig>> {
        match what {
            What::Slopes => vec![self.slope(corner, 0), self.slope(corner, 1)],
            What::Values => vec![self.value(corner)],
        }
    }

    /// Whether the rows of a part make polynomials of polynomials, and have the same functions at the part's corners: slopes times 1/d and the part's sign.
    fn are_kept(&self, local: &Local, part: &Part, what: What) -> bool {
        let on_polynomials = |row: &Row<RBig>| -> Vec<RBig> {
            let mut sum = vec![RBig::ZERO; self.count()];
            for (old, weight) in row {
                for (sum, own) in sum.iter_mut().zip(self.value(&local.points[*old].map(RBig::from))) {
                    *sum += weight * own;
                }
            }
            sum
        };
        let made: Vec<Vec<RBig>> = part.rows.iter().map(on_polynomials).collect();
        let of_first = |weights: &[RBig]| -> Vec<RBig> {
            (0..self.count())
                .map(|column| {
                    weights.iter().zip(&made).fold(RBig::ZERO, |sum, (weight, row)| sum + weight * &row[column])
                })
                .collect()
        };
        let polynomial =
            local.points.iter().zip(&made).all(|(q, own)| of_first(&self.value(&q.map(RBig::from))) == *own);
        let scale = match what {
            What::Slopes => RBig::from(local.tiling.dilation * part.cell.sign),
            What::Values => RBig::ONE,
        };
        let same = |corner: &Point| {
            let fine = halves(*corner);
            let coarse = local.tiling.within(part.cell, *corner);
            let (new, old) = (self.functions(&fine, what), self.functions(&coarse, what));
            new.iter().zip(old).all(|(new, old)| of_first(new).into_iter().map(|own| own * &scale).eq(old))
        };
        polynomial && local.tiling.corners().iter().all(same)
    }

    /// The deviations of the monomials of the next degree at the points that polynomials are not told by: what data on small cells are like.
    fn next(&self, local: &Local) -> Vec<Vec<f64>> {
        let others = &local.points[self.count()..];
        let powers: &[[u32; 2]] =
            if self.count() == 3 { &[[2, 0], [1, 1], [0, 2]] } else { &[[3, 0], [2, 1], [1, 2], [0, 3]] };
        let deviation = |powers: &[u32; 2], q: &Point| {
            let at = |q: &Point| monomial(*powers, &q.map(RBig::from));
            let weights = self.value(&q.map(RBig::from));
            let own = weights.iter().zip(BASE).fold(at(q), |sum, (weight, base)| sum - weight * at(&base));
            own.to_f64().value()
        };
        powers.iter().map(|powers| others.iter().map(|q| deviation(powers, q)).collect()).collect()
    }
}

/// The coefficients of the polynomial that is 1 at one of the first points and 0 at the others.
fn basic(monomials: &[[u32; 2]], own: usize) -> Vec<RBig> {
    // (coefficients, -1) is in the kernel of the values beside a column that is 1 at the point
    let row = |(at, base): (usize, Point)| -> Vec<RBig> {
        let mut row: Vec<RBig> = monomials.iter().map(|powers| monomial(*powers, &base.map(RBig::from))).collect();
        row.push(if at == own { -RBig::ONE } else { RBig::ZERO });
        row
    };
    let rows: Vec<Vec<RBig>> = BASE.into_iter().take(monomials.len()).enumerate().map(row).collect();
    let kernel = null_space(&rows).unwrap_or_default();
    let vector = kernel.first().cloned().unwrap_or_default();
    let last = vector.last().cloned().unwrap_or(RBig::ONE);
    vector.iter().take(monomials.len()).map(|own| own / &last).collect()
}

fn monomial([a, b]: [u32; 2], [x, y]: &[RBig; 2]) -> RBig {
    let power = |x: &RBig, times: u32| (0..times).fold(RBig::ONE, |product, _| product * x);
    power(x, a) * power(y, b)
}

/// A place that is told in halves.
fn halves(place: Point) -> [RBig; 2] {
    place.map(|x| RBig::from(x) / RBig::from(2))
}

/// The bound in the best of some units.
fn bound(local: &Local, polynomials: &Polynomials, what: What) -> Option<Deviation> {
    let count = polynomials.count();
    let next = polynomials.next(local);
    let parts: Vec<Dense> = local.parts.iter().map(|part| Dense::of(part, local, count)).collect();
    let weights = |q: &Point| polynomials.value(&q.map(RBig::from));
    let polynomial: Vec<Vec<RBig>> = local.points.iter().map(weights).collect();
    let steps: Vec<Sparse> = parts.iter().map(|part| part.deviation(&polynomial)).collect();
    let corners = local.tiling.corners().iter().map(|corner| polynomials.functions(&halves(*corner), what));
    let corners: Vec<Vec<Vec<RBig>>> = corners.collect();
    let enclosed = |own: &Vec<RBig>| own.iter().map(Interval::around).collect();
    let functions =
        (0..corners[0].len()).map(|kind| corners.iter().map(|own| enclosed(&own[kind])).collect()).collect();
    let found = Deviation {
        functions,
        polynomial: polynomial[count..].iter().map(enclosed).collect(),
        units: Vec::new(),
        bound: 0.0,
        steps: 0,
    };
    let changes: Vec<Covector> =
        parts.iter().flat_map(|part| corners.iter().flatten().map(|own| part.change(own))).collect();
    let size = |own: &Deviation| {
        let size =
            |values: &Vec<f64>| values.iter().zip(&own.units).map(|(y, unit)| (y / unit).abs()).fold(0.0, f64::max);
        own.bound * next.iter().map(size).sum::<f64>()
    };
    let sums = (0..next[0].len()).map(|at| next.iter().map(|own| own[at].abs()).sum::<f64>());
    let mut units: Vec<f64> = sums.map(|sum| if sum > 0.0 { sum } else { 1.0 }).collect();
    let mut best: Option<Deviation> = None;
    for _ in 0..ROUNDS {
        let contraction = Contraction::of(local, what, &steps, &units);
        if let Some((bound, steps)) = contraction.bound(&changes, &units) {
            let own = Deviation { units: units.clone(), bound, steps, ..found.clone() };
            if best.as_ref().is_none_or(|best| size(&own) < size(best)) {
                best = Some(own);
            }
        }
        units = balanced(&steps, &units);
    }
    best
}

/// Units that the steps enlarge less: the largest of the |B_i| w, up to a factor.
fn balanced(steps: &[Sparse], units: &[f64]) -> Vec<f64> {
    const LEAST: f64 = 1e-3;
    let sum = |row: &Vec<(usize, Interval)>| row.iter().map(|(at, entry)| entry.magnitude() * units[*at]).sum::<f64>();
    let of = |at: usize| steps.iter().map(|step| sum(&step[at])).fold(0.0, f64::max);
    let new: Vec<f64> = (0..units.len()).map(of).collect();
    let largest = new.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    new.into_iter().map(|own| (own / largest).max(LEAST)).collect()
}

/// The rows of a part on the points that polynomials are not told by.
struct Dense {
    rows: Vec<Vec<RBig>>,
    /// The number of the points that polynomials are told by.
    count: usize,
}

impl Dense {
    fn of(part: &Part, local: &Local, count: usize) -> Dense {
        let dense = |row: &Row<RBig>| {
            let mut own = vec![RBig::ZERO; local.points.len() - count];
            row.iter().filter(|(old, _)| *old >= count).for_each(|(old, weight)| own[*old - count] += weight);
            own
        };
        Dense { rows: part.rows.iter().map(dense).collect(), count }
    }

    /// Weights on the part's first points, times their rows.
    fn of_first(&self, weights: &[RBig], column: usize) -> RBig {
        weights.iter().zip(&self.rows).fold(RBig::ZERO, |sum, (weight, row)| sum + weight * &row[column])
    }

    /// B_i, from the weights of P at all points.
    fn deviation(&self, polynomial: &[Vec<RBig>]) -> Sparse {
        let row = |row: usize| {
            let entry = |column: usize| &self.rows[row][column] - self.of_first(&polynomial[row], column);
            let entries = (0..self.rows[row].len()).map(|column| (column, entry(column)));
            entries
                .filter(|(_, entry)| *entry != RBig::ZERO)
                .map(|(at, entry)| (at, Interval::around(&entry)))
                .collect()
        };
        (self.count..self.rows.len()).map(row).collect()
    }

    /// F P A_i, without the scale of slopes, from the weights of F.
    fn change(&self, weights: &[RBig]) -> Covector {
        (0..self.rows[0].len()).map(|column| Interval::around(&self.of_first(weights, column))).collect()
    }
}

/// The steps of all parts, in units of w.
struct Contraction {
    steps: Vec<Sparse>,
    /// By which factor functions of data grow in a step: d for slopes, 1 for values.
    growth: f64,
}

/// Norms of c B_w, times the growth in k steps, for some covectors c and words w of k parts: branches are followed until the norm is small.
struct Tree {
    /// The largest norm after k steps, on branches that have got so far.
    reached: Vec<f64>,
    /// The largest norm of those that end there.
    ended: Vec<f64>,
}

impl Tree {
    /// Bounds of the norms for all words of k parts, k = 0, 1, ...: a word goes on from where its branch ends with at most n_(k - l).
    fn bounds(&self, whole: &[f64]) -> Vec<f64> {
        let at = |list: &[f64], k: usize| list.get(k).copied().unwrap_or(0.0);
        let bound = |k: usize| {
            let on = (1..=k).map(|l| up(at(&self.ended, l), at(whole, k - l)));
            on.fold(at(&self.reached, k), f64::max)
        };
        (0..=MOST_STEPS).map(bound).collect()
    }
}

/// A product, rounded up.
fn up(a: f64, b: f64) -> f64 {
    (Interval::point(a) * Interval::point(b)).hi()
}

impl Contraction {
    fn of(local: &Local, what: What, steps: &[Sparse], units: &[f64]) -> Contraction {
        let unit = |at: usize| Interval::point(units[at]);
        let row = |(at, row): (usize, &Vec<(usize, Interval)>)| {
            row.iter().map(|(column, entry)| (*column, *entry * unit(*column) / unit(at))).collect()
        };
        let steps = steps.iter().map(|own| own.iter().enumerate().map(row).collect()).collect();
        let growth = if what == What::Slopes { f64::from(local.tiling.dilation) } else { 1.0 };
        Contraction { steps, growth }
    }

    /// C and K, from how functions change in a step.
    fn bound(&self, changes: &[Covector], units: &[f64]) -> Option<(f64, usize)> {
        SMALL.into_iter().find_map(|small| self.bound_by(changes, units, small))
    }

    /// The same by trees whose branches end at a norm.
    fn bound_by(&self, changes: &[Covector], units: &[f64], small: f64) -> Option<(f64, usize)> {
        let size = units.len();
        let one = |at: usize| (0..size).map(|own| Interval::point(if own == at { 1.0 } else { 0.0 })).collect();
        let own = self.tree((0..size).map(one).collect(), small)?;
        // n_k needs those before it
        let mut whole = vec![1.0];
        while whole.len() <= MOST_STEPS {
            whole.push(own.bounds(&whole)[whole.len()]);
        }
        let growth = Interval::point(self.growth);
        let scaled =
            |own: &Covector| own.iter().zip(units).map(|(x, unit)| growth * *x * Interval::point(*unit)).collect();
        let changes = self.tree(changes.iter().map(scaled).collect(), small)?.bounds(&whole);
        let mut sum = Interval::ZERO;
        let mut best: Option<(f64, usize)> = None;
        for steps in 1..=MOST_STEPS {
            sum = sum + Interval::point(changes[steps - 1]);
            let bound = (sum / (Interval::point(1.0) - Interval::point(whole[steps]))).hi();
            if whole[steps] < 1.0 && best.is_none_or(|(least, _)| bound < least) {
                best = Some((bound, steps));
            }
        }
        best
    }

    /// The tree from some covectors; `None` where it is too large.
    fn tree(&self, mut alive: Vec<Covector>, small: f64) -> Option<Tree> {
        let products: usize = self.steps.iter().flatten().map(Vec::len).sum();
        let norm = |own: &Covector| own.iter().fold(Interval::ZERO, |sum, x| sum + Interval::point(x.magnitude())).hi();
        let mut tree = Tree { reached: vec![alive.iter().map(norm).fold(0.0, f64::max)], ended: vec![0.0] };
        let mut left = MOST_PRODUCTS / products.max(1);
        while !alive.is_empty() {
            left = left.checked_sub(alive.len())?;
            let (mut going, mut reached, mut ended) = (Vec::new(), 0.0_f64, 0.0_f64);
            for new in alive.iter().flat_map(|own| self.steps.iter().map(|step| self.times(own, step))) {
                let norm = norm(&new);
                reached = reached.max(norm);
                if norm <= small {
                    ended = ended.max(norm);
                } else {
                    going.push(new);
                }
            }
            tree.reached.push(reached);
            tree.ended.push(ended);
            alive = going;
        }
        Some(tree)
    }

    /// c B, times the growth.
    fn times(&self, own: &Covector, step: &Sparse) -> Covector {
        let growth = Interval::point(self.growth);
        let mut product = vec![Interval::ZERO; own.len()];
        for (factor, row) in own.iter().zip(step).filter(|(factor, _)| **factor != Interval::ZERO) {
            let factor = growth * *factor;
            row.iter().for_each(|(column, entry)| product[*column] = product[*column] + factor * *entry);
        }
        product
    }
}

#[cfg(test)]
mod tests {
    use super::super::cells::Tiling;
    use super::*;
    use crate::analysis::regular::mask::{Mask, Sequence};
    use crate::mesh::Lattice;
    use crate::numbers::{Field, Free};
    use crate::refine::lattice_of;
    use crate::scheme::catalogue;

    fn local(id: &str) -> Local {
        let scheme = catalogue::open(id).unwrap().unwrap().with_values();
        let mask = Mask::of(&scheme).unwrap();
        let tiling = Tiling { lattice: lattice_of(&scheme), dilation: mask.dilation.arity().unwrap() };
        Local::of(&mask.coefficients, tiling).unwrap().unwrap()
    }

    /// The data of a part, in floating numbers.
    fn refined(part: &Part, data: &[f64]) -> Vec<f64> {
        let value = |weight: &RBig| weight.to_f64().value();
        part.rows.iter().map(|row| row.iter().map(|(old, weight)| value(weight) * data[*old]).sum()).collect()
    }

    /// Weights times data.
    fn sum(weights: &[Interval], data: &[f64]) -> f64 {
        weights.iter().zip(data).map(|(weight, x)| weight.middle() * x).sum()
    }

    /// |y|, and the slopes along both axes at the corners.
    fn parts_of(own: &Deviation, data: &[f64]) -> (f64, Vec<Vec<f64>>) {
        let others = data[data.len() - own.units.len()..].iter().zip(&own.polynomial).zip(&own.units);
        let sizes = others.map(|((x, weights), unit)| ((x - sum(weights, data)) / unit).abs());
        let slopes = own.functions.iter().map(|kind| kind.iter().map(|weights| sum(weights, data)).collect());
        (sizes.fold(0.0, f64::max), slopes.collect())
    }

    /// Along every word of four parts (of three out of nine), from data that are 1 at one point: slopes are between those at the corners, give or take what C |y| says, and what it
    /// says for what is left of the deviation.
    #[test]
    fn slopes_move_as_far_as_is_said_and_no_further() {
        for id in ["loop", "butterfly", "catmull-clark", "doo-sabin", "mid-edge", "sqrt3"] {
            let local = local(id);
            let own = deviation(&local, What::Slopes).unwrap();
            let parts = local.parts.len();
            let steps = if parts == 4 { 4 } else { 3 };
            let mut furthest = 0.0_f64;
            for point in 0..local.points.len() {
                let unit: Vec<f64> = (0..local.points.len()).map(|at| f64::from(u8::from(at == point))).collect();
                let (size, before) = parts_of(&own, &unit);
                for word in 0..parts.pow(steps) {
                    let (mut data, mut scale) = (unit.clone(), 1.0);
                    for step in 0..steps {
                        let part = &local.parts[word / parts.pow(step) % parts];
                        data = refined(part, &data);
                        scale *= f64::from(local.tiling.dilation * part.cell.sign);
                    }
                    let (left, after) = parts_of(&own, &data);
                    for (before, after) in before.iter().zip(&after) {
                        let [low, high] = [f64::min, f64::max].map(|of| before.iter().copied().reduce(of).unwrap());
                        for slope in after.iter().map(|slope| slope * scale) {
                            let moved = (low - slope).max(slope - high);
                            assert!(moved <= own.bound * (size + left * scale.abs()) + 1e-12, "{id} {point} {word}");
                            if size > 0.0 {
                                furthest = furthest.max(moved / (own.bound * size));
                            }
                        }
                    }
                }
            }
            // data of one point are not the worst ones
            assert!(furthest > 0.02, "{id}: {furthest}");
        }
    }

    /// Splines of low degree and interpolating schemes keep quadratic functions' slopes.
    #[test]
    fn polynomials_are_told_by_the_first_points() {
        let quadratic = Polynomials::new(2);
        for (at, base) in BASE.into_iter().enumerate() {
            let value = quadratic.value(&base.map(RBig::from));
            assert!(value.iter().enumerate().all(|(own, x)| *x == RBig::from(i32::from(own == at))));
        }
        for (id, count) in [("loop", 6), ("catmull-clark", 6), ("doo-sabin", 6), ("butterfly", 6), ("kobbelt", 6)] {
            assert_eq!(deviation(&local(id), What::Slopes).unwrap().polynomial[0].len(), count, "{id}");
            assert_eq!(deviation(&local(id), What::Values).unwrap().polynomial[0].len(), 3, "{id}");
        }
    }

    fn values_of(mask: &[([i32; 2], i64)], over: i64, lattice: Lattice) -> Result<Deviation, &'static str> {
        let weight = |(at, own): &([i32; 2], i64)| (*at, Free::rational(&(RBig::from(*own) / RBig::from(over))));
        let mask: Sequence = mask.iter().map(weight).collect();
        deviation(&Local::of(&mask, Tiling { lattice, dilation: 2 }).unwrap().unwrap(), What::Values)
    }

    /// Some masks move affine functions, others wiggle.
    #[test]
    fn what_is_not_smooth_or_not_affine_has_no_bounds() {
        let hat = [([0, 0], 2), ([1, 0], 1), ([0, 1], 1), ([-1, 0], 1), ([0, -1], 1), ([1, -1], 1), ([-1, 1], 1)];
        let moved = hat.map(|([x, y], weight)| ([x + 1, y], weight));
        assert!(values_of(&moved, 2, Lattice::Triangles).unwrap_err().contains("affine"));
        // the constant spline
        let constant = [([0, 0], 1), ([1, 0], 1), ([0, 1], 1), ([1, 1], 1)];
        assert!(values_of(&constant, 1, Lattice::Dual).unwrap_err().contains("affine"));
        let mut scheme = catalogue::open("butterfly").unwrap().unwrap();
        scheme.book.set("w", "1/4").unwrap();
        let mask = Mask::of(&scheme.with_values()).unwrap();
        let tiling = Tiling { lattice: Lattice::Triangles, dilation: 2 };
        let local = Local::of(&mask.coefficients, tiling).unwrap().unwrap();
        assert!(deviation(&local, What::Slopes).unwrap_err().contains("contract"));
    }
}
