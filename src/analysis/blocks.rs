//! Which symmetry has the local matrix, and what are its blocks?
//!
//! S commutes with rotation, so it leaves the functions of each frequency k = 0..n-1 alone: those with
//!
//! > x at (sector s, orbit t) = y_t w^(k s),   w = exp(2 pi i/n),
//!
//! and acts on them as the block B_k, with entries (B_k)_{tu} = sum_d S_{(0,t),(d,u)} w^(k d). The centre belongs to
//! B_0, where y_t is the common value of the orbit. B_{n-k} is the complex conjugate of B_k.
//!
//! S also commutes with the mirror that fixes spoke 0. With y_t = w^(k shift_t/2) z_t the mirror becomes complex conjugation
//! together with the exchange of mirror orbits, so the z of a self-mirrored orbit may be taken real and those of a
//! mirrored pair conjugate: B_k is similar to a *real* matrix of the same size, on *nodes* ([`Node`]).

use super::local::{Entry, LocalMatrix};
use super::neighbourhood::Orbit;
use super::parts::{Parts, Unit};
use crate::numbers::{RootsOfUnity, sum};
use nalgebra::DMatrix;
use num_complex::Complex64;
use rustfft::FftPlannerScalar;

/// Up to this many terms a sum over the ring is added up for each frequency; beyond, all frequencies come from one FFT. A
/// tuning, with one more reason: the FFT takes its twiddles from the machine's C library, and committed reports, of small
/// valences, must not see the machine.
const FEW_TERMS: usize = 64;

/// A unit of the real form of the blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Node {
    /// The centre; frequency 0 only. One real unknown.
    Centre,
    /// An orbit that is its own mirror image. One real unknown.
    Fixed(usize),
    /// An orbit and its mirror image: two real unknowns a, b with z = a + i b and a - i b.
    Pair(usize, usize),
}

impl Unit for Node {
    fn unknowns(self) -> usize {
        if let Node::Pair(..) = self { 2 } else { 1 }
    }

    fn acts_on(self, part: usize) -> bool {
        part == 0 || self != Node::Centre
    }
}

impl Node {
    /// The orbits that it is made of.
    pub fn orbits(self) -> impl Iterator<Item = usize> {
        let (first, second) = match self {
            Node::Centre => (None, None),
            Node::Fixed(orbit) => (Some(orbit), None),
            Node::Pair(orbit, mirror) => (Some(orbit), Some(mirror)),
        };
        first.into_iter().chain(second)
    }
}

/// One entry of every block.
#[derive(Clone, Debug)]
enum Wave {
    Zero,
    /// Few terms: (sector, weight).
    Sum(Vec<(u32, f64)>),
    /// Its value at each frequency.
    Table(Vec<Complex64>),
}

/// The blocks B_0..B_{n-1} of a local matrix.
#[derive(Clone, Debug)]
pub struct Blocks {
    /// The orbits that rows and columns stand for; in B_0 the centre comes first.
    pub orbits: Vec<Orbit>,
    /// The units of the real form, the centre first where it is a point.
    pub nodes: Vec<Node>,
    valence: usize,
    /// The 2n-th roots of unity.
    roots: RootsOfUnity,
    /// The mirror's shift of each orbit, in sectors.
    shifts: Vec<i32>,
    waves: Vec<Vec<Wave>>,
    /// Row of the centre in B_0: its own weight, then that of each orbit as a whole.
    centre_row: Option<Vec<f64>>,
    /// The centre's weight in each orbit's row.
    centre_column: Vec<f64>,
}

impl Blocks {
    /// The blocks of a local matrix.
    pub fn of(local: &LocalMatrix) -> Blocks {
        let (n, lattice) = (local.valence(), local.patch.lattice);
        let orbits = local.orbits.clone();
        let mirrors: Vec<(usize, i32)> = (0..orbits.len())
            .map(|t| {
                let (mirror, shift) = lattice.mirror(orbits[t]);
                (orbits.iter().position(|own| *own == mirror).unwrap_or(t), shift)
            })
            .collect();
        let pairs = mirrors.iter().enumerate().filter(|(t, (mirror, _))| t <= mirror);
        let node = |(t, (mirror, _)): (usize, &(usize, i32))| {
            if t == *mirror { Node::Fixed(t) } else { Node::Pair(t, *mirror) }
        };
        let centre = local.centre.as_ref().map(|_| Node::Centre);
        let mut planner = FftPlannerScalar::new();
        Blocks {
            nodes: centre.into_iter().chain(pairs.map(node)).collect(),
            valence: n,
            roots: RootsOfUnity::new(2 * n),
            shifts: mirrors.iter().map(|(_, shift)| *shift).collect(),
            waves: local.rows.iter().map(|row| waves(row, orbits.len(), n, &mut planner)).collect(),
            centre_row: local.centre.as_ref().map(|row| centre_row(row, orbits.len())),
            centre_column: local.rows.iter().map(|row| centre_weight(row)).collect(),
            orbits,
        }
    }

    /// The valence n.
    pub fn valence(&self) -> usize {
        self.valence
    }

    /// The block B_k, complex, in the normalisation above. B_0 has the centre as its first row and column.
    pub fn block(&self, k: usize) -> DMatrix<Complex64> {
        let offset = usize::from(k == 0 && self.centre_row.is_some());
        let size = self.orbits.len() + offset;
        DMatrix::from_fn(size, size, |row, column| match (row.checked_sub(offset), column.checked_sub(offset)) {
            (Some(t), Some(u)) => self.entry(t, u, k),
            (Some(t), None) => Complex64::new(self.centre_column[t], 0.0),
            (None, column) => Complex64::new(self.centre_weight_of(column), 0.0),
        })
    }

    fn centre_weight_of(&self, orbit: Option<usize>) -> f64 {
        self.centre_row.as_ref().map_or(0.0, |row| row[orbit.map_or(0, |u| u + 1)])
    }

    /// (B_k)_{tu}
    fn entry(&self, t: usize, u: usize, k: usize) -> Complex64 {
        match &self.waves[t][u] {
            Wave::Zero => Complex64::ZERO,
            Wave::Table(table) => table[k],
            Wave::Sum(terms) => terms.iter().map(|(d, weight)| self.root(2 * k as i64 * i64::from(*d)) * weight).sum(),
        }
    }

    /// exp(2 pi i m/(2n))
    fn root(&self, m: i64) -> Complex64 {
        self.roots.get(m)
    }

    /// w^(k shift_t/2): what takes the real form's z_t to y_t.
    pub fn phase(&self, t: usize, k: usize) -> Complex64 {
        self.root(k as i64 * i64::from(self.shifts[t]))
    }

    /// The value z at the first orbit of `to` that comes from z = unit at the first orbit of `from`, its conjugate at the
    /// second.
    fn image(&self, k: usize, to: Node, from: Node, unit: Complex64) -> Complex64 {
        let row = |t: usize, u: usize| self.entry(t, u, k) * self.phase(u, k) * self.phase(t, k).conj();
        match (to, from) {
            (Node::Centre, Node::Centre) => Complex64::new(self.centre_weight_of(None), 0.0) * unit,
            (Node::Centre, Node::Fixed(u)) => Complex64::new(self.centre_weight_of(Some(u)), 0.0) * unit,
            (Node::Centre, Node::Pair(u, v)) => {
                unit * self.centre_weight_of(Some(u)) + unit.conj() * self.centre_weight_of(Some(v))
            }
            (Node::Fixed(t) | Node::Pair(t, _), Node::Centre) => unit * self.centre_column[t],
            (Node::Fixed(t) | Node::Pair(t, _), Node::Fixed(u)) => row(t, u) * unit,
            (Node::Fixed(t) | Node::Pair(t, _), Node::Pair(u, v)) => row(t, u) * unit + row(t, v) * unit.conj(),
        }
    }

    /// The local matrix again, from its blocks: S_{(0,t),(d,u)} = (1/n) sum_k (B_k)_{tu} w^(-k d). Row t, then sector d, then
    /// orbit u; the centre's row and column are those of B_0.
    pub fn rebuilt_rows(&self) -> Vec<Vec<Vec<f64>>> {
        let n = self.valence;
        let blocks: Vec<DMatrix<Complex64>> = (0..n).map(|k| self.block(k)).collect();
        let offset = usize::from(self.centre_row.is_some());
        let at = |t: usize, u: usize, d: usize| {
            let term = |k: usize| {
                let shift = if k == 0 { offset } else { 0 };
                blocks[k][(t + shift, u + shift)] * self.root(-2 * (k * d) as i64)
            };
            (0..n).map(term).sum::<Complex64>().re / n as f64
        };
        let orbits = self.orbits.len();
        (0..orbits).map(|t| (0..n).map(|d| (0..orbits).map(|u| at(t, u, d)).collect()).collect()).collect()
    }
}

/// The parts are the frequencies 0..floor(n/2): those of k and n-k are conjugate.
impl Parts for Blocks {
    type Node = Node;
    type Vector = ModeVector;

    fn count(&self) -> usize {
        self.valence / 2 + 1
    }

    fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    fn feeds(&self, to: Node, from: Node) -> bool {
        match (to, from) {
            (Node::Centre, Node::Centre) => self.centre_weight_of(None) != 0.0,
            (Node::Centre, _) => from.orbits().any(|u| self.centre_weight_of(Some(u)) != 0.0),
            (_, Node::Centre) => to.orbits().any(|t| self.centre_column[t] != 0.0),
            _ => to.orbits().any(|t| from.orbits().any(|u| !matches!(self.waves[t][u], Wave::Zero))),
        }
    }

    /// The real form of B_k, restricted to some nodes. The centre may be among them at k = 0 only.
    fn real_form(&self, k: usize, nodes: &[Node]) -> DMatrix<f64> {
        let size = nodes.iter().map(|node| node.unknowns()).sum();
        let mut real = DMatrix::zeros(size, size);
        let mut row = 0;
        for to in nodes {
            let mut column = 0;
            for from in nodes {
                for (c, unit) in units(*from).into_iter().enumerate() {
                    let image = self.image(k, *to, *from, unit);
                    real[(row, column + c)] = image.re;
                    if to.unknowns() == 2 {
                        real[(row + 1, column + c)] = image.im;
                    }
                }
                column += from.unknowns();
            }
            row += to.unknowns();
        }
        real
    }

    /// The complex vector y (the centre's value first, then one for each orbit) of a vector of the real form.
    fn right_from_real(&self, k: usize, nodes: &[Node], real: &[f64]) -> ModeVector {
        let mut vector = ModeVector { frequency: k, centre: 0.0, orbits: vec![Complex64::ZERO; self.orbits.len()] };
        let mut at = 0;
        for node in nodes {
            match *node {
                Node::Centre => vector.centre = real[at],
                Node::Fixed(t) => vector.orbits[t] = self.phase(t, k) * real[at],
                Node::Pair(t, u) => {
                    let z = Complex64::new(real[at], real[at + 1]);
                    vector.orbits[t] = self.phase(t, k) * z;
                    vector.orbits[u] = self.phase(u, k) * z.conj();
                }
            }
            at += node.unknowns();
        }
        vector
    }

    /// The row vector u with u B_k = lambda u of a left vector of the real form.
    fn left_from_real(&self, k: usize, nodes: &[Node], real: &[f64]) -> ModeVector {
        let mut vector = ModeVector { frequency: k, centre: 0.0, orbits: vec![Complex64::ZERO; self.orbits.len()] };
        let mut at = 0;
        for node in nodes {
            match *node {
                Node::Centre => vector.centre = real[at],
                Node::Fixed(t) => vector.orbits[t] = self.phase(t, k).conj() * real[at],
                Node::Pair(t, u) => {
                    let half = Complex64::new(real[at], -real[at + 1]) / 2.0;
                    vector.orbits[t] = self.phase(t, k).conj() * half;
                    vector.orbits[u] = self.phase(u, k).conj() * half.conj();
                }
            }
            at += node.unknowns();
        }
        vector
    }
}

/// A vector of one frequency. A right vector has the value `orbits[t]` w^(k s) at (sector s, orbit t) and `centre` at the
/// centre. A left vector u of B_k has the entries u_t w^(-k s)/n there, and u_centre at the centre.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeVector {
    /// k.
    pub frequency: usize,
    /// The value at the centre, where that is a point; zero for k other than 0.
    pub centre: f64,
    /// The value of each orbit in sector 0.
    pub orbits: Vec<Complex64>,
}

fn units(node: Node) -> Vec<Complex64> {
    let units = [Complex64::ONE, Complex64::I];
    units[..node.unknowns()].to_vec()
}

fn centre_weight(row: &[Entry]) -> f64 {
    sum(row.iter().filter(|entry| entry.orbit.is_none()).map(|entry| entry.weight))
}

fn centre_row(row: &[Entry], orbits: usize) -> Vec<f64> {
    let of = |orbit: Option<usize>| sum(row.iter().filter(|entry| entry.orbit == orbit).map(|entry| entry.weight));
    std::iter::once(of(None)).chain((0..orbits).map(|orbit| of(Some(orbit)))).collect()
}

fn waves(row: &[Entry], orbits: usize, n: usize, planner: &mut FftPlannerScalar<f64>) -> Vec<Wave> {
    let mut terms: Vec<Vec<(u32, f64)>> = vec![Vec::new(); orbits];
    for entry in row {
        if let Some(orbit) = entry.orbit {
            terms[orbit].push((entry.sector, entry.weight));
        }
    }
    terms
        .into_iter()
        .map(|terms| match terms.len() {
            0 => Wave::Zero,
            count if count <= FEW_TERMS => Wave::Sum(terms),
            _ => Wave::Table(transformed(&terms, n, planner)),
        })
        .collect()
}

/// sum_d weight_d w^(k d) for every k.
fn transformed(terms: &[(u32, f64)], n: usize, planner: &mut FftPlannerScalar<f64>) -> Vec<Complex64> {
    let mut table = vec![Complex64::ZERO; n];
    for (sector, weight) in terms {
        table[*sector as usize] += weight;
    }
    planner.plan_fft_inverse(n).process(&mut table);
    table
}
