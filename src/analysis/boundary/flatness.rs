//! How are the points around a vertex moved towards its tangent plane, and what does that do to the local matrix?
//!
//! After a step a point x on the faces around the vertex becomes (1 - s) x + s (a_0 x_0 + a_1 x_1 + a_2 x_2) (Biermann, Levin and Zorin 2000,
//! flatness): x_0, x_1, x_2 are the right vectors of the limit point and of two tangents, a_i = l_i p what their left vectors find. With P = sum_i
//! x_i l_i, the local matrix S becomes (I + s E (P - I)) S, E being the points that move. Eigenvectors x_i keep their eigenvalues, since
//! P x_i = x_i, and the others are multiplied by 1 - s where all points move that feed each other.
//!
//! The tangents are those that the surface is to have, though others may be larger: at a corner those of its two edges, at a crease that along it and
//! the largest of the other parity, at a dart the largest of each parity. Points of a crease stay where they are, at creases and at
//! corners: they belong to the faces on both of its sides, and its curve depends on its own points alone.

use super::BoundaryAnalyzer;
use super::halves::Parity;
use super::leading::in_words;
use super::local::FanMatrix;
use super::masks::Stages;
use crate::analysis::spectrum::{Eigenvalue, NEAR};
use crate::mesh::{FanKind, Label, Lattice};
use crate::refine::{Flatness, Moves, Obstacle};
use crate::scheme::{Place, RuleBook, Scheme};
use std::collections::BTreeSet;

/// Weights of masks, relative to the largest, that rounding alone may have made.
const ROUNDING: f64 = 1e-12;

/// How the points around vertices of these kinds move, as a boundary file says: what a [`crate::refine::Refiner`] needs to know.
///
/// # Errors
/// When there is no analysis at the scheme's boundaries.
pub fn of(scheme: &Scheme, book: &RuleBook, kinds: impl IntoIterator<Item = FanKind>) -> Result<Flatness, Obstacle> {
    let kinds: BTreeSet<FanKind> = kinds.into_iter().collect();
    if !book.tells_flatness() || kinds.is_empty() {
        return Ok(Flatness::default());
    }
    let analyzer = BoundaryAnalyzer::new(scheme, book)?;
    // steps make vertices on creases between regular faces
    let made = FanKind::Crease { faces: scheme.regular_valence() / 2 };
    Ok(Flatness { kinds: kinds.into_iter().chain([made]).map(|kind| (kind, analyzer.moves(kind))).collect() })
}

impl BoundaryAnalyzer<'_> {
    /// The s of a kind of vertex; 0 where no file tells any, and on a crease between regular faces.
    ///
    /// # Errors
    /// When it has no value, or is not from 0 to 1.
    pub fn flatness(&self, kind: FanKind) -> Result<f64, Obstacle> {
        let (name, faces) = (kind.name(), kind.faces());
        let regular = FanKind::Crease { faces: self.scheme().regular_valence() / 2 };
        let Some((book, placed)) = self.book().flatness(name, faces)?.filter(|_| kind != regular) else {
            return Ok(0.0);
        };
        let variable = if kind.is_closed() { "n" } else { "k" };
        let s: f64 = book.evaluate(placed, &Place::at(Some(variable), faces as i64))?;
        let wrong = || Obstacle::Limit(format!("the flatness at a {name} with {faces} faces, {s}, is not from 0 to 1"));
        if (0.0..=1.0).contains(&s) { Ok(s) } else { Err(wrong()) }
    }

    /// How the points around a kind of vertex move; `None` where they stay.
    ///
    /// # Errors
    /// As [`BoundaryAnalyzer::local_matrix`]; when there are no such masks, or they look beyond the faces around the vertex.
    pub fn moves(&self, kind: FanKind) -> Result<Option<Moves>, Obstacle> {
        if self.flatness(kind)? == 0.0 { Ok(None) } else { self.moves_over(&self.plain_matrix(kind)?) }
    }

    /// The same, from the matrix of the step without them.
    pub(super) fn moves_over(&self, plain: &FanMatrix) -> Result<Option<Moves>, Obstacle> {
        let kind = plain.fan.kind();
        let s = self.flatness(kind)?;
        // at a single triangle every point stays
        if s == 0.0 || (!kind.is_closed() && kind.faces() == 1 && plain.fan.lattice() == Lattice::Triangles) {
            return Ok(None);
        }
        let moves = self.with_stages(plain, |stages| stages.moves(s))?;
        let at = format!("at a {} with {} faces", kind.name(), kind.faces());
        moves.map(Some).map_err(|why| Obstacle::Limit(format!("there is no flatness {at}: {why}")))
    }
}

impl Stages<'_> {
    /// The moves with this s, or why there are none.
    fn moves(&self, s: f64) -> Result<Moves, String> {
        let points: Vec<Label> = [self.fan().centre()].into_iter().chain(self.rim()).collect();
        let at: Option<Vec<usize>> = points.iter().map(|label| self.local.index(*label)).collect();
        let at = at.ok_or("a point on the faces is not in the neighbourhood")?;
        let one = self.spectrum.one().ok_or("there is no eigenvalue 1")?;
        let [along, across] = self.tangents_of_the_surface()?;
        let pairs = [one, along, across].map(|e| self.dual_pair(&e, &at));
        let pairs = pairs.into_iter().collect::<Result<Vec<_>, String>>()?;
        let row = |to: usize| -> Vec<f64> {
            let planar = |from: usize| pairs.iter().map(|(right, left)| right[to] * left[from]).sum::<f64>();
            let own = |from: usize| if from == to { 1.0 - s } else { 0.0 };
            (0..at.len()).map(|from| own(from) + s * planar(from)).collect()
        };
        let stays = |label: &Label| {
            let ends = [0, self.fan().sectors()].contains(&label.sector) && label.j == 0;
            !self.fan().kind().is_closed() && (*label == self.fan().centre() || ends)
        };
        let rows = (0..points.len()).filter(|index| !stays(&points[*index])).map(|index| (index, row(index)));
        Ok(Moves { rows: rows.collect(), points })
    }

    /// The eigenvalues of the tangents that the surface is to have.
    fn tangents_of_the_surface(&self) -> Result<[Eigenvalue; 2], String> {
        let first = self.local.index(self.ring()[0]);
        let own = |e: &Eigenvalue| self.cores.cores[e.core].iter().any(|node| Some(node.point()) == first);
        let of_boundary = |parity: Parity| match self.fan().kind() {
            FanKind::Corner { .. } => true,
            FanKind::Crease { .. } => parity == Parity::Odd,
            FanKind::Dart { .. } => false,
        };
        let largest = |parity: Parity| {
            let in_part = self.spectrum.after_one().filter(|e| e.frequency == parity.part());
            in_part.copied().find(|e| !of_boundary(parity) || own(e))
        };
        let tangent = |parity: Parity| {
            let e = largest(parity).ok_or(format!("there is no {} tangent", parity.name()))?;
            match e.real() {
                Some(value) if value > NEAR && e.is_isolated() => Ok(e),
                Some(value) if value > NEAR => Err(format!("eigenvalues are approximately equal at {}", in_words(&e))),
                _ => Err(format!("{} is not positive", in_words(&e))),
            }
        };
        Ok([tangent(Parity::Odd)?, tangent(Parity::Even)?])
    }

    /// The right and the left vector of a simple eigenvalue on some points, their product being 1.
    fn dual_pair(&self, e: &Eigenvalue, at: &[usize]) -> Result<(Vec<f64>, Vec<f64>), String> {
        let none = || format!("no vectors for {}", in_words(e));
        let (right, _) = self.spectrum.right_vector(self.halves, self.cores, e).ok_or_else(none)?;
        let (left, _) = self.spectrum.left_vector(self.halves, self.cores, e).ok_or_else(none)?;
        let largest = left.iter().fold(0.0, |top: f64, weight| top.max(weight.abs()));
        let beyond = |(index, weight): (usize, &f64)| weight.abs() > ROUNDING * largest && !at.contains(&index);
        if left.iter().enumerate().any(beyond) {
            return Err(format!("the mask of {} looks beyond the faces around the vertex", in_words(e)));
        }
        let [right, left] = [right, left].map(|vector| at.iter().map(|index| vector[*index]).collect::<Vec<f64>>());
        let product: f64 = right.iter().zip(&left).map(|(r, l)| r * l).sum();
        // a Jordan block, or one that rounding can't tell from it
        if product.is_nan() || product.abs() <= NEAR {
            return Err(none());
        }
        Ok((right, left.into_iter().map(|weight| weight / product).collect()))
    }
}

impl FanMatrix {
    /// The matrix of a step after which points are moved.
    pub(super) fn moved(self, moves: &Moves) -> FanMatrix {
        let at: Vec<usize> = moves.points.iter().filter_map(|label| self.index(*label)).collect();
        let mut rows = self.rows.clone();
        for (point, weights) in &moves.rows {
            let mut sum = vec![0.0; self.size()];
            for (from, weight) in at.iter().zip(weights) {
                self.rows[*from].iter().for_each(|(column, own)| sum[*column] += weight * own);
            }
            rows[at[*point]] = sum.into_iter().enumerate().filter(|(_, weight)| *weight != 0.0).collect();
        }
        FanMatrix { rows, ..self }
    }
}
