//! Is the Jacobian positive on every cell of the ring, and does the ring keep to its half plane?
//!
//! Data of a cell are intervals. Derivatives of the limit lie within C |y| of those of a polynomial, which are between those at the corners, y being the deviation from
//! that; so do values, with bounds of their own ([`mod@super::deviation`]). Where that doesn't tell the sign of the determinant, the cell is cut into its parts
//! by the regular rules, and deviations shrink faster than differences.
//!
//! A value that depends on t is a polynomial in t whose coefficients are intervals. As rules are linear and have no t in them, each coefficient is
//! refined, and bounded, by itself: so the coefficients' deviations shrink, too, which those of a naive enclosure would not.

use super::cells::{Cell, Local, Part};
use super::deviation::Deviation;
use crate::numbers::Interval;

/// The coefficients of a value a + b w: those of a, of b, and of its part along the axis of the sector.
pub type Coefficients = [Vec<Interval>; 3];

/// What cells are tested with.
pub struct Sweep<'a> {
    local: &'a Local,
    slopes: &'a Deviation,
    values: &'a Deviation,
    /// The range of the power of t that each coefficient is multiplied with.
    powers: Vec<Interval>,
    /// Cells are refined so often at most.
    most_depth: usize,
    /// So many cells are tested at most.
    most_cells: usize,
}

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Swept {
    /// Everything is positive.
    Positive {
        /// The number of cells that were tested.
        cells: usize,
        /// How often cells were refined.
        depth: usize,
    },
    /// The Jacobian is certainly negative on a part of this cell, after so many refinements.
    Fold {
        /// The cell of the ring.
        cell: Cell,
        /// The number of refinements.
        depth: usize,
    },
    /// It is not decided on this cell: what isn't.
    Open {
        /// The cell of the ring.
        cell: Cell,
        /// Which of both tests.
        what: &'static str,
        /// The number of cells that were tested.
        cells: usize,
    },
}

/// The data of a cell: for each point the coefficients of a, of b, and of its part along the axis.
type Data = Vec<Interval>;

/// Data with what is left to show of them.
struct Task {
    cell: Cell,
    data: Data,
    jacobian: bool,
    half_plane: bool,
}

impl<'a> Sweep<'a> {
    /// Tests of cells with these rows, and bounds of slopes and values, for values that are polynomials with these ranges of their powers; refined so often, and
    /// so many, at most.
    pub fn new(
        local: &'a Local,
        [slopes, values]: [&'a Deviation; 2],
        powers: Vec<Interval>,
        limits: (usize, usize),
    ) -> Sweep<'a> {
        Sweep { local, slopes, values, powers, most_depth: limits.0, most_cells: limits.1 }
    }

    /// Tests the cells with their points' coefficients, in order of [`Local::points`]: all parts of one size before
    /// smaller ones, so that a fold is found where it is seen first.
    pub fn run(&self, cells: &[(Cell, Vec<&Coefficients>)]) -> Swept {
        let start = |(cell, points): &(Cell, Vec<&Coefficients>)| {
            let data = points.iter().flat_map(|own| own.iter().flatten().copied()).collect();
            Task { cell: *cell, data, jacobian: true, half_plane: true }
        };
        let mut tasks: Vec<Task> = cells.iter().map(start).collect();
        let mut count = 0;
        for depth in 0..=self.most_depth {
            let mut open = Vec::new();
            for mut task in std::mem::take(&mut tasks) {
                count += 1;
                let jacobian = if task.jacobian { self.jacobian(&task.data) } else { Interval::point(1.0) };
                if jacobian.is_negative() {
                    return Swept::Fold { cell: task.cell, depth };
                }
                task.jacobian = !jacobian.is_positive();
                task.half_plane = task.half_plane && !self.along_axis(&task.data).is_positive();
                if task.jacobian || task.half_plane {
                    open.push(task);
                }
            }
            let Some(Task { cell, jacobian, .. }) = open.first() else {
                return Swept::Positive { cells: count, depth };
            };
            if depth == self.most_depth || count + self.local.parts.len() * open.len() > self.most_cells {
                let what = if *jacobian { "the sign of the Jacobian" } else { "the half plane" };
                return Swept::Open { cell: *cell, what, cells: count };
            }
            tasks = open.iter().flat_map(|task| self.parts(task)).collect();
        }
        Swept::Positive { cells: count, depth: self.most_depth }
    }

    fn parts(&self, task: &Task) -> impl Iterator<Item = Task> {
        let Task { cell, jacobian, half_plane, .. } = *task;
        let part = move |part: &Part| Task { cell, data: self.refined(part, &task.data), jacobian, half_plane };
        self.local.parts.iter().map(part)
    }

    fn refined(&self, part: &Part, data: &Data) -> Data {
        let size = 3 * self.powers.len();
        let mut fine = vec![Interval::ZERO; part.enclosed.len() * size];
        for (row, sums) in part.enclosed.iter().zip(fine.chunks_mut(size)) {
            for (old, weight) in row {
                let values = &data[old * size..(old + 1) * size];
                sums.iter_mut().zip(values).for_each(|(sum, value)| *sum = *sum + *weight * *value);
            }
        }
        fine
    }

    /// A coefficient at a point.
    fn at(&self, data: &Data, point: usize, slot: usize) -> Interval {
        data[point * 3 * self.powers.len() + slot]
    }

    /// Weights on a cell's first points, applied to a coefficient.
    fn sum(&self, weights: &[Interval], data: &Data, slot: usize) -> Interval {
        weights
            .iter()
            .enumerate()
            .fold(Interval::ZERO, |sum, (point, weight)| sum + *weight * self.at(data, point, slot))
    }

    /// A function of a coefficient over the cell: between what it is at the corners, give or take C |y|.
    fn over_cell(&self, own: &Deviation, kind: usize, data: &Data, slot: usize, size: f64) -> Interval {
        let corners = own.functions[kind].iter().map(|weights| self.sum(weights, data, slot));
        let corners = corners.reduce(Interval::hull).unwrap_or(Interval::REALS);
        widened(corners, Interval::point(own.bound) * Interval::point(size))
    }

    /// |y| of a coefficient.
    fn size_of_deviation(&self, own: &Deviation, data: &Data, slot: usize) -> f64 {
        let first = self.local.points.len() - own.units.len();
        let others = own.polynomial.iter().zip(&own.units).enumerate();
        let sizes = others.map(|(at, (weights, unit))| {
            let y = self.at(data, first + at, slot) - self.sum(weights, data, slot);
            (y / Interval::point(*unit)).magnitude()
        });
        sizes.fold(0.0, f64::max)
    }

    /// The determinant of the derivatives over the cell.
    fn jacobian(&self, data: &Data) -> Interval {
        let [u, v] = self.derivatives(data);
        u[0] * v[1] - u[1] * v[0]
    }

    /// The derivatives of a and b along both axes, over the cell.
    fn derivatives(&self, data: &Data) -> [[Interval; 2]; 2] {
        let mut ranges = [[Interval::ZERO; 2]; 2];
        for (part, (slot, power)) in (0..2).flat_map(|part| self.powers.iter().enumerate().map(move |own| (part, own)))
        {
            let slot = part * self.powers.len() + slot;
            let size = self.size_of_deviation(self.slopes, data, slot);
            for (axis, range) in ranges.iter_mut().enumerate() {
                range[part] = range[part] + self.over_cell(self.slopes, axis, data, slot, size) * *power;
            }
        }
        ranges
    }

    /// The value's part along the axis of the sector over the cell, times a positive number.
    fn along_axis(&self, data: &Data) -> Interval {
        self.powers.iter().enumerate().fold(Interval::ZERO, |range, (slot, power)| {
            let slot = 2 * self.powers.len() + slot;
            let size = self.size_of_deviation(self.values, data, slot);
            range + self.over_cell(self.values, 0, data, slot, size) * *power
        })
    }
}

/// What lies within a distance of members of an interval.
fn widened(own: Interval, reach: Interval) -> Interval {
    let reach = reach.magnitude();
    match Interval::new(-reach, reach) {
        Some(around) => own + around,
        None => Interval::REALS,
    }
}

#[cfg(test)]
mod tests {
    use super::super::cells::Tiling;
    use super::super::deviation::{What, deviation};
    use super::*;
    use crate::analysis::regular::mask::Mask;
    use crate::refine::lattice_of;
    use crate::scheme::catalogue;

    fn setting(id: &str) -> (Local, [Deviation; 2]) {
        let scheme = catalogue::open(id).unwrap().unwrap().with_values();
        let mask = Mask::of(&scheme).unwrap();
        let tiling = Tiling { lattice: lattice_of(&scheme), dilation: mask.dilation.arity().unwrap() };
        let local = Local::of(&mask.coefficients, tiling).unwrap().unwrap();
        let bounds = [What::Slopes, What::Values].map(|what| deviation(&local, what).unwrap());
        (local, bounds)
    }

    /// Numbers in [-1, 1), reproducibly.
    fn noise(count: usize) -> Data {
        let mut state = 0x2545_f491_4f6c_dd1d_u64;
        let mut next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            Interval::point(state as f64 / 2f64.powi(63) - 1.0)
        };
        (0..count).map(|_| next()).collect()
    }

    /// Slopes seven levels down, times d^7, are close to derivatives: they lie in the enclosure of the first
    /// level, and the enclosures of both meet; so do values.
    #[test]
    fn divided_differences_of_finer_data_lie_in_the_enclosures() {
        for id in ["butterfly", "loop", "catmull-clark", "doo-sabin", "kobbelt", "sqrt3", "four-eight", "mid-edge"] {
            let (local, bounds) = setting(id);
            let sweep = Sweep::new(&local, bounds.each_ref(), vec![Interval::point(1.0)], (0, 0));
            let data = noise(3 * local.points.len());
            let (coarse, values) = (sweep.derivatives(&data), sweep.along_axis(&data));
            let parts = local.parts.len();
            for path in 0..parts.pow(3) {
                let (mut fine, mut scale) = (data.clone(), 1.0);
                for level in 0..7 {
                    let part = path / parts.pow(level % 3) % parts;
                    fine = sweep.refined(&local.parts[part], &fine);
                    scale *= f64::from(local.tiling.dilation * local.parts[part].cell.sign);
                }
                let own = sweep.derivatives(&fine);
                for (axis, part) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let slope = scale * (fine[3 * (axis + 1) + part].middle() - fine[part].middle());
                    let range = coarse[axis][part];
                    assert!(range.lo() < slope && slope < range.hi(), "{id} {path} {axis}");
                    let own = own[axis][part] * Interval::point(scale);
                    assert!(own.lo() <= range.hi() && range.lo() <= own.hi(), "{id} {path} {axis}");
                }
                let value = fine[2].middle();
                assert!(values.lo() < value && value < values.hi(), "{id} {path}");
            }
        }
    }

    /// A map that is affine has the same Jacobian everywhere; turned over it is a fold, and through 0 it leaves the
    /// half plane.
    #[test]
    fn affine_maps_are_told_apart() {
        for id in ["butterfly", "kobbelt", "mid-edge"] {
            let (local, bounds) = setting(id);
            let sweep = Sweep::new(&local, bounds.each_ref(), vec![Interval::point(1.0)], (6, 5000));
            let cell = Cell { origin: [0, 0], sign: 1 };
            let run = |map: &dyn Fn(f64, f64) -> [f64; 2]| {
                let point = |[x, y]: &[i32; 2]| {
                    let [a, b] = map(f64::from(*x), f64::from(*y));
                    [a, b, a + b].map(|own| vec![Interval::point(own)])
                };
                let values: Vec<Coefficients> = local.points.iter().map(point).collect();
                sweep.run(&[(cell, values.iter().collect())])
            };
            assert!(matches!(run(&|x, y| [x + 9.0, y + 9.0]), Swept::Positive { .. }));
            assert!(matches!(run(&|x, y| [y + 9.0, x + 9.0]), Swept::Fold { .. }));
            assert!(matches!(run(&|x, y| [x - 0.3, y]), Swept::Open { .. }));
            assert!(matches!(run(&|x, _| [x + 9.0, x + 9.0]), Swept::Open { .. }));
        }
    }
}
