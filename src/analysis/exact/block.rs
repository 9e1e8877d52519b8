//! What is the block of one frequency, in real numbers?
//!
//! B_k acts on the values y_t of the orbits; its entries are sums of powers of w = exp(2 pi i k/n). The mirror sends
//! y_t to w^shift conj(y_t'), t' being the mirror image; what it leaves fixed is a real space of the same dimension, and B_k keeps it.
//! Its unknowns are a, b with
//!
//! > y_t = a w^(shift/2), for an orbit that is its own image and an even shift; y_t = a w^((shift-1)/2) (1 + w) for an odd one;
//! > y_t = a + b w, y_t' = w^shift conj(y_t), for two orbits that are images of each other,
//!
//! and the entries are polynomials in x = cos(2 pi k/n) with the weights: w^m = U_{m-1}(x) w - U_{m-2}(x), with Chebyshev's
//! polynomials of the second kind. Where w is 1 or -1 everything is real as it stands, and the unknowns are the y_t.

use super::rows::{Entry, Rows};
use crate::analysis::cores::components;
use crate::numbers::linear::Matrix;
use crate::numbers::{Field, Trouble};
use std::collections::BTreeMap;

/// What w = exp(2 pi i k/n) is.
#[derive(Clone, Debug, PartialEq)]
pub enum Wave<F> {
    /// 1: frequency 0.
    One,
    /// -1: frequency n/2.
    MinusOne,
    /// Neither; cos(2 pi k/n) is this.
    Cosine(F),
}

/// One unknown of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// The value at the centre.
    Centre,
    /// y_t, where w is 1 or -1.
    Value(usize),
    /// a of an orbit that is its own mirror image.
    Own(usize),
    /// a of a pair of mirror images.
    First(usize, usize),
    /// b of that pair.
    Second(usize, usize),
}

impl Unknown {
    /// The orbits that it stands for.
    pub fn orbits(self) -> Vec<usize> {
        match self {
            Unknown::Centre => vec![],
            Unknown::Value(t) | Unknown::Own(t) => vec![t],
            Unknown::First(t, u) | Unknown::Second(t, u) => vec![t, u],
        }
    }
}

/// The block of one frequency.
#[derive(Clone, Debug)]
pub struct Block<F> {
    /// What rows and columns stand for.
    pub unknowns: Vec<Unknown>,
    /// Its entries.
    pub matrix: Matrix<F>,
    /// The frequency's w.
    pub wave: Wave<F>,
    /// The unknowns of each core; a core depends on itself and on earlier ones only.
    pub cores: Vec<Vec<usize>>,
}

/// A sum of powers of w, by exponent.
pub type Powers<F> = BTreeMap<i64, F>;

impl<F: Field> Block<F> {
    /// The block of the frequencies +-p, or (`None`) of those that no weight tells apart.
    ///
    /// # Errors
    /// When a limit of size is passed, or the rows are not alike in the mirror.
    pub fn of(rows: &Rows<F>, p: Option<usize>, wave: Wave<F>) -> Result<Block<F>, Trouble> {
        let (unknowns, matrix) = match &wave {
            Wave::Cosine(x) => mirrored(rows, p, x)?,
            Wave::One => plain(rows, p, 1)?,
            Wave::MinusOne => plain(rows, p, -1)?,
        };
        let cores = components(unknowns.len(), |to, from| !matrix[to][from].is_certainly_zero());
        Ok(Block { unknowns, matrix, wave, cores })
    }

    /// The unknowns that these are made of through any number of steps, themselves among them, in order.
    pub fn below(&self, start: &[usize]) -> Vec<usize> {
        let mut found = vec![false; self.unknowns.len()];
        let mut new: Vec<usize> = start.to_vec();
        while let Some(row) = new.pop() {
            if !std::mem::replace(&mut found[row], true) {
                new.extend((0..found.len()).filter(|from| !self.matrix[row][*from].is_certainly_zero()));
            }
        }
        (0..found.len()).filter(|index| found[*index]).collect()
    }
}

fn plain<F: Field>(rows: &Rows<F>, p: Option<usize>, w: i64) -> Result<(Vec<Unknown>, Matrix<F>), Trouble> {
    let centre = if w == 1 { rows.centre.as_ref() } else { None };
    let first = centre.map(|row| (Unknown::Centre, row));
    let others = rows.rows.iter().enumerate().map(|(t, row)| (Unknown::Value(t), row));
    let all: Vec<(Unknown, &Vec<Entry<F>>)> = first.into_iter().chain(others).collect();
    let unknowns: Vec<Unknown> = all.iter().map(|(unknown, _)| *unknown).collect();
    let mut matrix = Vec::with_capacity(all.len());
    for (_, row) in &all {
        let mut line = vec![F::whole(0); unknowns.len()];
        for entry in *row {
            let column = entry.orbit.map_or(Unknown::Centre, Unknown::Value);
            let Some(column) = unknowns.iter().position(|own| *own == column) else { continue };
            let weight = entry.weight.value(p);
            let odd = w == -1 && entry.sector.rem_euclid(2) == 1;
            line[column] = if odd { line[column].minus(weight)? } else { line[column].plus(weight)? };
        }
        matrix.push(line);
    }
    Ok((unknowns, matrix))
}

fn mirrored<F: Field>(rows: &Rows<F>, p: Option<usize>, x: &F) -> Result<(Vec<Unknown>, Matrix<F>), Trouble> {
    let mut unknowns = Vec::new();
    for (t, (image, _)) in rows.mirrors.iter().enumerate() {
        match image {
            u if *u == t => unknowns.push(Unknown::Own(t)),
            u if *u > t => unknowns.extend([Unknown::First(t, *u), Unknown::Second(t, *u)]),
            _ => {}
        }
    }
    let mut powers_of_w = PowersOfW::new(x);
    let mut matrix = vec![vec![F::whole(0); unknowns.len()]; unknowns.len()];
    for (column, unknown) in unknowns.iter().enumerate() {
        let values = values(rows, *unknown);
        for (row, to) in unknowns.iter().enumerate() {
            match *to {
                Unknown::Own(t) => {
                    let shift = rows.mirrors[t].1;
                    let image = image(&rows.rows[t], p, &values, -shift.div_euclid(2))?;
                    let (a, b) = powers_of_w.reduced(&image)?;
                    let rest = if shift % 2 == 0 { b } else { a.minus(&b)? };
                    if F::EXACT && !rest.is_certainly_zero() {
                        return Err(Trouble::BeyondThisWorld("the rows are not alike in the mirror"));
                    }
                    matrix[row][column] = a;
                }
                Unknown::First(t, _) => {
                    let image = image(&rows.rows[t], p, &values, 0)?;
                    (matrix[row][column], matrix[row + 1][column]) = powers_of_w.reduced(&image)?;
                }
                _ => {}
            }
        }
    }
    Ok((unknowns, matrix))
}

/// The values y of one unknown set to 1: for each orbit the exponents of w that add up to it.
fn values<F>(rows: &Rows<F>, unknown: Unknown) -> Vec<(usize, Vec<i64>)> {
    let shift = |t: usize| rows.mirrors[t].1;
    match unknown {
        Unknown::Own(t) if shift(t) % 2 == 0 => vec![(t, vec![shift(t) / 2])],
        Unknown::Own(t) => vec![(t, vec![shift(t).div_euclid(2), shift(t).div_euclid(2) + 1])],
        Unknown::First(t, u) => vec![(t, vec![0]), (u, vec![shift(t)])],
        Unknown::Second(t, u) => vec![(t, vec![1]), (u, vec![shift(t) - 1])],
        Unknown::Centre | Unknown::Value(_) => vec![],
    }
}

/// The value that a row gives, times w^turn.
fn image<F: Field>(
    row: &[Entry<F>],
    p: Option<usize>,
    values: &[(usize, Vec<i64>)],
    turn: i64,
) -> Result<Powers<F>, Trouble> {
    let mut image = Powers::new();
    for entry in row {
        for (orbit, exponents) in values {
            if entry.orbit != Some(*orbit) {
                continue;
            }
            for exponent in exponents {
                let sum = image.entry(entry.sector + exponent + turn).or_insert_with(|| F::whole(0));
                *sum = sum.plus(entry.weight.value(p))?;
            }
        }
    }
    Ok(image)
}

/// The powers of w as a + b w, over the field of x = (w + 1/w)/2.
pub struct PowersOfW<F> {
    x: F,
    /// U_{-1} = 0, U_0 = 1, U_1 = 2 x, ...
    second_kind: Vec<F>,
}

impl<F: Field> PowersOfW<F> {
    /// The powers of the w with this real part.
    pub fn new(x: &F) -> Self {
        PowersOfW { x: x.clone(), second_kind: vec![F::whole(0), F::whole(1)] }
    }

    /// U_m for any whole m: U_{-m} = -U_{m-2}.
    fn second_kind(&mut self, m: i64) -> Result<F, Trouble> {
        if m < -1 {
            return Ok(self.second_kind(-m - 2)?.negated());
        }
        let index = (m + 1) as usize;
        while self.second_kind.len() <= index {
            let last = self.second_kind.len() - 1;
            let next =
                self.second_kind[last].times(&self.x)?.times(&F::whole(2))?.minus(&self.second_kind[last - 1])?;
            self.second_kind.push(next);
        }
        Ok(self.second_kind[index].clone())
    }

    /// A sum of powers as (a, b) with value a + b w.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn reduced(&mut self, sum: &Powers<F>) -> Result<(F, F), Trouble> {
        let (mut a, mut b) = (F::whole(0), F::whole(0));
        for (m, value) in sum {
            b = b.plus(&value.times(&self.second_kind(m - 1)?)?)?;
            a = a.minus(&value.times(&self.second_kind(m - 2)?)?)?;
        }
        Ok((a, b))
    }
}
