//! Which eigenvectors at a vertex on a crease are waves over the sector?
//!
//! Where the new points of the centre and of the crease are made of points of the crease only, functions that vanish there are mapped to
//! such. If the rows between are the same on every spoke, then x_j = sin(j phi) on spoke j and y_j = sin((j + 1/2) phi) across face j,
//! phi = m pi/k, is mapped to a wave of the same phi: sine mode m, decided by exact rows ([`SineRows`]). A vector in floating numbers
//! is looked at as it is ([`Mode::of_vector`]): that is approximate.

use super::local::FanMatrix;
use crate::mesh::{Label, Lattice};
use crate::numbers::{Cosine, Field};
use dashu_ratio::RBig;
use std::f64::consts::PI;

/// How far values may be from a wave, relative to the largest.
const SHAPE: f64 = 1e-9;

/// The shape of a vector on the spokes: sin(j m pi/k) or cos(j m pi/k) on spoke j; at a dart 2 pi/n stands for pi/k.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mode {
    /// Whether it is the sine, which vanishes on spoke 0.
    pub sine: bool,
    /// m.
    pub number: usize,
}

impl Mode {
    /// `sine` or `cosine`.
    pub fn name(self) -> &'static str {
        if self.sine { "sine" } else { "cosine" }
    }

    /// The wave that a vector on the points of a local matrix is on the spokes, the centre being 0; approximate.
    pub fn of_vector(local: &FanMatrix, vector: &[f64]) -> Option<Mode> {
        let (fan, kind) = (local.fan, local.fan.kind());
        let at = |label: Label| local.index(label).map(|row| vector[row]);
        let spokes = (0..fan.spokes()).map(|sector| at(Label { sector, i: 1, j: 0 })).collect::<Option<Vec<f64>>>()?;
        let largest = spokes.iter().fold(0.0, |top: f64, x| top.max(x.abs()));
        let all = vector.iter().fold(0.0, |top: f64, x| top.max(x.abs()));
        if largest <= SHAPE * all || at(fan.centre())?.abs() > SHAPE * largest {
            return None;
        }
        let sectors = fan.sectors() as usize;
        let (turn, last) = if kind.is_closed() { (2.0 * PI, sectors / 2) } else { (PI, sectors) };
        let angle = |number: usize, j: usize| (number * j) as f64 * turn / sectors as f64;
        let waves = (1..=last).flat_map(|mode| [true, false].map(|sine| Mode { sine, number: mode }));
        waves.into_iter().find(|wave| {
            let shape = |j: usize| {
                if wave.sine { libm::sin(angle(wave.number, j)) } else { libm::cos(angle(wave.number, j)) }
            };
            let product: f64 = spokes.iter().enumerate().map(|(j, x)| x * shape(j)).sum();
            let square: f64 = (0..spokes.len()).map(|j| shape(j) * shape(j)).sum();
            let factor = product / square;
            square > SHAPE && spokes.iter().enumerate().all(|(j, x)| (x - factor * shape(j)).abs() <= SHAPE * largest)
        })
    }
}

/// The rows of the points between the two sharp edges around a vertex, as they act on functions that vanish on these.
#[derive(Clone, Debug)]
pub struct SineRows<F = Cosine> {
    faces: usize,
    /// A spoke's weights: of itself, of each spoke beside it.
    spoke: [F; 2],
    /// On quads: what a spoke has of each vertex across a face beside it, such a vertex of each spoke beside it, and of itself.
    across: Option<[F; 3]>,
}

impl<F: Field + PartialEq> SineRows<F> {
    /// These rows, where the matrix has them; `None` where new points of the crease use others, or the rows differ.
    pub fn of(matrix: &FanMatrix<F>) -> Option<SineRows<F>> {
        let (fan, faces) = (matrix.fan, matrix.fan.sectors());
        if fan.kind().is_closed() {
            return None;
        }
        let spoke = |sector: u32| matrix.index(Label { sector, i: 1, j: 0 });
        let spokes = (0..=faces).map(spoke).collect::<Option<Vec<usize>>>()?;
        let on_quads = fan.lattice() != Lattice::Triangles;
        let across = |sector: u32| matrix.index(Label { sector, i: 1, j: 1 });
        let across: Vec<usize> = (0..faces).filter(|_| on_quads).map(across).collect::<Option<_>>()?;
        let zero = F::whole(0);
        let entry = |row: usize, column: usize| {
            let found = matrix.rows[row].iter().find(|(own, _)| *own == column);
            found.map_or(zero.clone(), |(_, weight)| weight.clone())
        };
        let inner = &spokes[1..faces as usize];
        let between: Vec<usize> = inner.iter().chain(&across).copied().collect();
        let sharp = [matrix.index(fan.centre())?, spokes[0], spokes[faces as usize]];
        // functions that vanish on the crease stay so
        if sharp.iter().any(|row| between.iter().any(|column| entry(*row, *column) != zero)) {
            return None;
        }
        let closed = |row: &usize| {
            let near = |column: &usize| between.contains(column) || sharp.contains(column);
            matrix.rows[*row].iter().all(|(column, _)| near(column))
        };
        if !between.iter().all(closed) {
            return None;
        }
        // the middle of a list of points has all its neighbours, where any has
        let middle = inner.len() / 2;
        let own = inner.get(middle).map_or(zero.clone(), |row| entry(*row, *row));
        let beside = if inner.len() > 1 { entry(inner[middle], inner[middle - 1]) } else { zero.clone() };
        let rows = SineRows {
            faces: faces as usize,
            spoke: [own, beside],
            across: across.first().map(|first| {
                let (over, under) = match inner.first() {
                    Some(spoke) => (entry(*spoke, *first), entry(*first, *spoke)),
                    None => (zero.clone(), zero.clone()),
                };
                [over, under, entry(*first, *first)]
            }),
        };
        let wanted = |row: usize, column: usize| {
            let place = |list: &[usize], point: usize| list.iter().position(|own| *own == point);
            match (place(inner, row), place(inner, column), place(&across, row), place(&across, column)) {
                (Some(a), Some(b), ..) if a == b => rows.spoke[0].clone(),
                (Some(a), Some(b), ..) if a.abs_diff(b) == 1 => rows.spoke[1].clone(),
                // spoke s, the list's s - 1, lies between the faces s - 1 and s
                (Some(a), _, _, Some(d)) if d == a || d == a + 1 => rows.of_across(0),
                (_, Some(b), Some(d), _) if d == b || d == b + 1 => rows.of_across(1),
                (_, _, Some(c), Some(d)) if c == d => rows.of_across(2),
                _ => zero.clone(),
            }
        };
        let same = between.iter().all(|row| between.iter().all(|column| entry(*row, *column) == wanted(*row, *column)));
        same.then_some(rows)
    }

    fn of_across(&self, index: usize) -> F {
        self.across.as_ref().map_or(F::whole(0), |weights| weights[index].clone())
    }
}

impl SineRows<Cosine> {
    /// The waves with their eigenvalues, approximately: each mode once on triangles, up to twice on quads.
    pub fn values(&self, theta: &dyn Fn(&Cosine) -> Option<f64>) -> Option<Vec<(Mode, f64)>> {
        let mut values = Vec::new();
        let [a, b] = [theta(&self.spoke[0])?, theta(&self.spoke[1])?];
        for mode in 1..=self.faces {
            let wave = Mode { sine: true, number: mode };
            let phi = mode as f64 * PI / self.faces as f64;
            let own = a + 2.0 * b * libm::cos(phi);
            let Some([d, e, f]) = &self.across else {
                values.extend((mode < self.faces).then_some((wave, own)));
                continue;
            };
            let [d, e, f] = [theta(d)?, theta(e)?, theta(f)?];
            if mode == self.faces {
                values.push((wave, f));
                continue;
            }
            let half = libm::cos(phi / 2.0);
            let (trace, determinant) = (own + f, own * f - 4.0 * d * e * half * half);
            let root = (trace * trace / 4.0 - determinant).max(0.0).sqrt();
            values.extend([trace / 2.0 + root, trace / 2.0 - root].map(|value| (wave, value)));
        }
        Some(values)
    }

    /// The eigenvalue of a mode for all k, in the scheme language, where the rows' weights are rational: on quads the equation that it solves. None where
    /// there are fewer than two spokes inside: what these have of each other isn't seen.
    pub fn formula(&self, mode: usize) -> Option<String> {
        if self.faces < 3 && mode < self.faces {
            return None;
        }
        let [a, b] = [self.spoke[0].as_rational()?, self.spoke[1].as_rational()?];
        let two = RBig::from(2);
        let wave = if mode == 1 { "cos(pi/k)".to_string() } else { format!("cos({mode}*pi/k)") };
        let Some([d, e, f]) = &self.across else { return Some(linear(&a, &(&two * &b), &wave)) };
        let [d, e, f] = [d.as_rational()?, e.as_rational()?, f.as_rational()?];
        if mode == self.faces {
            return Some(f.to_string());
        }
        let pull = &two * &d * &e;
        let trace = linear(&(&a + &f), &(&two * &b), &wave);
        let determinant = linear(&(&a * &f - &pull), &(&two * &b * &f - &pull), &wave);
        Some(format!("x^2 - ({trace})*x + {determinant} = 0"))
    }
}

/// `a + b*wave`, without what is 0 or 1.
fn linear(a: &RBig, b: &RBig, wave: &str) -> String {
    if *b == RBig::ZERO {
        return a.to_string();
    }
    let (sign, size) = if *b < RBig::ZERO { ("-", -b.clone()) } else { ("+", b.clone()) };
    let factor = if *size.numerator() == 1u8.into() { String::new() } else { format!("{}*", size.numerator()) };
    let over = if *size.denominator() == 1u8.into() { String::new() } else { format!("/{}", size.denominator()) };
    format!("{a} {sign} {factor}{wave}{over}")
}
