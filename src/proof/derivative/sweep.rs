//! Is the Jacobian positive on every cell of the ring, and does the ring keep to its half plane?
//!
//! Data of a cell are intervals. The derivative along e lies within L r of m, if the differences along e that it
//! depends on lie within r of m; a value likewise within L_f r. Where that doesn't tell the sign of the determinant,
//! the cell is refined into its four parts by the regular rules, and differences get closer to each other.
//!
//! A value that depends on h, |h| <= the half width of a box, is a polynomial in h and a remainder: one interval for
//! each coefficient and one for the remainder. As rules are linear and have no h in them, each coefficient is
//! refined, and bounded, by itself: so the coefficients' differences shrink, too, which those of a naive enclosure
//! would not.

use super::cells::{Cell, Local, Row};
use crate::numbers::Interval;

/// The coefficients of a value a + b w: those of a, then those of b.
pub type Coefficients = [Vec<Interval>; 2];

/// What cells are tested with.
pub struct Sweep<'a> {
    /// The points and rows of cells.
    pub local: &'a Local,
    /// L for the derivatives along an axis.
    pub derivatives: f64,
    /// L_f.
    pub values: f64,
    /// The range of the power of h that each coefficient is multiplied with; of the remainder that is 1.
    pub powers: Vec<Interval>,
    /// Cells are refined so often at most.
    pub most_depth: usize,
    /// So many cells are tested at most.
    pub most_cells: usize,
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
    },
}

/// The data of a cell: for each point the coefficients of a, then those of b.
type Data = Vec<Interval>;

/// Data with what is left to show of them.
struct Task {
    cell: Cell,
    data: Data,
    jacobian: bool,
    half_plane: bool,
}

impl Sweep<'_> {
    /// Tests the cells with their points' coefficients, in order of [`Local::points`]: all parts of one size before
    /// smaller ones, so that a fold is found where it is seen first.
    pub fn run(&self, cells: &[(Cell, Vec<&Coefficients>)]) -> Swept {
        let start = |(cell, points): &(Cell, Vec<&Coefficients>)| {
            let data = points.iter().flat_map(|[a, b]| a.iter().chain(b).copied()).collect();
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
            if depth == self.most_depth || count + 4 * open.len() > self.most_cells {
                let what = if *jacobian { "the sign of the Jacobian" } else { "the half plane" };
                return Swept::Open { cell: *cell, what };
            }
            tasks = open.iter().flat_map(|task| self.parts(task)).collect();
        }
        Swept::Positive { cells: count, depth: self.most_depth }
    }

    fn parts(&self, task: &Task) -> impl Iterator<Item = Task> {
        let Task { cell, jacobian, half_plane, .. } = *task;
        let part = move |rows: &Vec<Row>| Task { cell, data: self.refined(rows, &task.data), jacobian, half_plane };
        self.local.parts.iter().map(part)
    }

    fn refined(&self, rows: &[Row], data: &Data) -> Data {
        let size = 2 * self.powers.len();
        let mut fine = vec![Interval::ZERO; rows.len() * size];
        for (row, sums) in rows.iter().zip(fine.chunks_mut(size)) {
            for (old, weight) in row {
                let values = &data[old * size..(old + 1) * size];
                sums.iter_mut().zip(values).for_each(|(sum, value)| *sum = *sum + *weight * *value);
            }
        }
        fine
    }

    /// The determinant of the derivatives over the cell.
    fn jacobian(&self, data: &Data) -> Interval {
        let [u, v] = [0, 1].map(|axis| self.derivative(data, axis));
        u[0] * v[1] - u[1] * v[0]
    }

    fn derivative(&self, data: &Data, axis: usize) -> [Interval; 2] {
        let at = |point: usize, slot: usize| data[point * 2 * self.powers.len() + slot];
        let pairs = &self.local.differences[axis];
        self.ranges(self.derivatives, |slot| hull(pairs.iter().map(|(head, tail)| at(*head, slot) - at(*tail, slot))))
    }

    /// a + b over the cell: the value's part along the axis of the sector, times a positive number.
    fn along_axis(&self, data: &Data) -> Interval {
        let size = 2 * self.powers.len();
        let half = self.powers.len();
        let sums = |slot: usize| {
            hull(self.local.values.iter().map(|point| data[point * size + slot] + data[point * size + half + slot]))
        };
        let mut range = Interval::ZERO;
        for (slot, power) in self.powers.iter().enumerate() {
            range = range + widened(sums(slot), self.values) * *power;
        }
        range
    }

    /// The ranges of a and b, from the hull of each coefficient's data.
    fn ranges(&self, lebesgue: f64, hull: impl Fn(usize) -> Interval) -> [Interval; 2] {
        [0, 1].map(|part| {
            let slots = self.powers.iter().enumerate();
            slots.fold(Interval::ZERO, |sum, (slot, power)| {
                sum + widened(hull(part * self.powers.len() + slot), lebesgue) * *power
            })
        })
    }
}

fn hull(values: impl Iterator<Item = Interval>) -> Interval {
    values.reduce(Interval::hull).unwrap_or(Interval::REALS)
}

/// What limits of data in an interval lie in: within L r of its middle m.
fn widened(data: Interval, lebesgue: f64) -> Interval {
    let reach = (Interval::point(lebesgue) * Interval::point(data.radius())).magnitude();
    match Interval::new(-reach, reach) {
        Some(around) => Interval::point(data.middle()) + around,
        None => Interval::REALS,
    }
}

#[cfg(test)]
mod tests {
    use super::super::lebesgue::{differences, lebesgue};
    use super::*;
    use crate::analysis::regular::mask::{Mask, Sequence};
    use crate::numbers::{Field, Free};
    use crate::scheme::catalogue;

    fn setting(id: &str) -> (Local, f64) {
        let scheme = catalogue::open(id).unwrap().unwrap().with_values();
        let mask: Sequence = Mask::of(&scheme).unwrap().coefficients;
        let twice = |v| -> Sequence {
            let own = differences(&mask, v).unwrap().unwrap();
            own.into_iter().map(|(point, weight)| (point, weight.times(&Free::whole(2)).unwrap())).collect()
        };
        let along = [twice([1, 0]), twice([0, 1])];
        let bound = lebesgue(&along[0], &[[0, 1], [1, -1]]).unwrap().unwrap().bound;
        let bound = Interval::around(&bound).hi();
        (Local::of(&mask, &along).unwrap().unwrap(), bound)
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

    /// Differences seven levels down, times 2^7, are close to derivatives: they lie in the enclosure of the first
    /// level, and the enclosures of both meet.
    #[test]
    fn divided_differences_of_finer_data_lie_in_the_enclosures() {
        for id in ["butterfly", "loop"] {
            let (local, derivatives) = setting(id);
            let powers = vec![Interval::point(1.0)];
            let sweep = Sweep { local: &local, derivatives, values: 2.0, powers, most_depth: 0, most_cells: 0 };
            let data = noise(2 * local.points.len());
            for path in 0..4_usize.pow(4) {
                let (mut fine, mut sign) = (data.clone(), 1.0);
                for level in 0..7 {
                    let part = path / 4_usize.pow(level % 4) % 4;
                    fine = sweep.refined(&local.parts[part], &fine);
                    sign *= if part == 3 { -1.0 } else { 1.0 };
                }
                for axis in [0, 1] {
                    let coarse = sweep.derivative(&data, axis);
                    let (head, tail) = local.differences[axis][0];
                    for slot in [0, 1] {
                        let difference = fine[2 * head + slot].middle() - fine[2 * tail + slot].middle();
                        let slope = sign * 128.0 * difference;
                        assert!(coarse[slot].lo() < slope && slope < coarse[slot].hi(), "{id} {path} {axis}");
                        let own = sweep.derivative(&fine, axis)[slot] * Interval::point(sign * 128.0);
                        assert!(own.lo() <= coarse[slot].hi() && coarse[slot].lo() <= own.hi());
                    }
                }
            }
        }
    }

    /// A map that is affine has the same Jacobian everywhere; turned over it is a fold, and through 0 it leaves the
    /// half plane.
    #[test]
    fn affine_maps_are_told_apart() {
        let (local, derivatives) = setting("butterfly");
        let powers = vec![Interval::point(1.0)];
        let sweep = Sweep { local: &local, derivatives, values: 2.0, powers, most_depth: 6, most_cells: 5000 };
        let cell = Cell { origin: [0, 0], sign: 1 };
        let run = |map: &dyn Fn(f64, f64) -> [f64; 2]| {
            let point = |[x, y]: &[i32; 2]| map(f64::from(*x), f64::from(*y)).map(|own| vec![Interval::point(own)]);
            let values: Vec<Coefficients> = local.points.iter().map(point).collect();
            sweep.run(&[(cell, values.iter().collect())])
        };
        assert!(matches!(run(&|x, y| [x + 9.0, y + 9.0]), Swept::Positive { .. }));
        assert!(matches!(run(&|x, y| [y + 9.0, x + 9.0]), Swept::Fold { .. }));
        assert!(matches!(run(&|x, y| [x - 0.3, y]), Swept::Open { .. }));
        assert!(matches!(run(&|x, _| [x + 9.0, x + 9.0]), Swept::Open { .. }));
    }
}
