//! Which box spline is this?
//!
//! A mask whose symbol is a monomial times smoothing factors alone belongs to the box spline of their directions (Cavaretta, Dahmen and Micchelli 1991).
//! With N directions, counted with their multiplicities, and rho the number of them whose removal leaves a set that no longer spans the plane at the least, it is
//! piecewise polynomial of degree N - 2, C^(rho-2) and not smoother, and its shifts span all polynomials of degree rho - 1. Its shifts are linearly
//! independent exactly when every basis among the directions has determinant 1 or -1; then they are stable. (de Boor, Hoellig and Riemenschneider 1993.)

use super::factors::{Factors, cross};
use super::mask::Point;

/// A box spline by its directions, with their multiplicities.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoxSpline {
    /// The directions, shortest first; no two are parallel.
    pub directions: Vec<(Point, usize)>,
}

impl BoxSpline {
    /// The box spline of a symbol, if that has no other factors and the directions span the plane.
    pub fn of(factors: &Factors) -> Option<BoxSpline> {
        let spans = factors.directions.len() >= 2 && factors.kernel.len() == 1;
        spans.then(|| BoxSpline { directions: factors.directions.clone() })
    }

    fn count(&self) -> usize {
        self.directions.iter().map(|(_, times)| times).sum()
    }

    /// The least number of directions whose removal leaves a set that doesn't span: all but those along one line.
    pub fn order(&self) -> usize {
        self.count() - self.directions.iter().map(|(_, times)| *times).max().unwrap_or(0)
    }

    /// The total degree of its polynomial pieces.
    pub fn degree(&self) -> usize {
        self.count() - 2
    }

    /// The degrees along the two directions of a tensor product.
    pub fn bidegree(&self) -> Option<[usize; 2]> {
        match self.directions[..] {
            [([1, 0], p), ([0, 1], q)] => Some([p - 1, q - 1]),
            _ => None,
        }
    }

    /// The largest r for which it is C^r; `None` where it is not continuous.
    pub fn continuity(&self) -> Option<usize> {
        self.order().checked_sub(2)
    }

    /// Whether its shifts are linearly independent.
    pub fn is_independent(&self) -> bool {
        let lines = self.directions.iter().map(|(direction, _)| *direction);
        lines.clone().all(|u| lines.clone().all(|v| u == v || cross(u, v).abs() == 1))
    }

    /// What it is called.
    pub fn name(&self) -> String {
        if let Some([p, q]) = self.bidegree() {
            let own = if p == q { prefixed("bi", p).map(|word| format!("{word} ")) } else { None };
            return format!("{}tensor-product B-spline of bi-degree ({p}, {q})", own.unwrap_or_default());
        }
        let times: Vec<String> = self.directions.iter().map(|(_, times)| times.to_string()).collect();
        let (lines, times) = (self.directions.len(), times.join(", "));
        let special = match (lines, times.as_str(), self.is_independent()) {
            (3, "1, 1, 1", true) => ", Courant's hat function",
            (4, "1, 1, 1, 1", false) if self.is_zwart_powell() => ", the Zwart-Powell element",
            _ => "",
        };
        let degree = prefixed("", self.degree()).unwrap_or(format!("degree-{}", self.degree()));
        let lines = ["two", "three", "four"].get(lines - 2).map_or(lines.to_string(), |word| (*word).to_string());
        format!("{degree} box spline of {lines} directions ({times}){special}")
    }

    /// Whether the directions are (1, 0), (0, 1), (1, 1), (1, -1) in some basis of the lattice: the determinants are 1, but for one
    /// pair, where it is 2.
    fn is_zwart_powell(&self) -> bool {
        let lines: Vec<Point> = self.directions.iter().map(|(direction, _)| *direction).collect();
        let pairs = (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j)));
        let dets: Vec<i32> = pairs.map(|(i, j)| cross(lines[i], lines[j]).abs()).collect();
        dets.iter().filter(|det| **det == 1).count() == 5 && dets.contains(&2)
    }
}

/// The word for a degree.
fn prefixed(prefix: &str, degree: usize) -> Option<String> {
    let words = ["constant", "linear", "quadratic", "cubic", "quartic", "quintic"];
    words.get(degree).map(|word| format!("{prefix}{word}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spline(directions: &[(Point, usize)]) -> BoxSpline {
        BoxSpline { directions: directions.to_vec() }
    }

    /// de Boor, Hoellig and Riemenschneider 1993: the examples of the field.
    #[test]
    fn known_box_splines() {
        let bicubic = spline(&[([1, 0], 4), ([0, 1], 4)]);
        assert_eq!((bicubic.continuity(), bicubic.order(), bicubic.is_independent()), (Some(2), 4, true));
        assert_eq!(bicubic.name(), "bicubic tensor-product B-spline of bi-degree (3, 3)");
        let hat = spline(&[([1, 0], 1), ([0, 1], 1), ([1, 1], 1)]);
        assert_eq!((hat.continuity(), hat.degree(), hat.is_independent()), (Some(0), 1, true));
        let quartic = spline(&[([1, 0], 2), ([0, 1], 2), ([1, -1], 2)]);
        assert_eq!((quartic.continuity(), quartic.degree(), quartic.order()), (Some(2), 4, 4));
        let zwart_powell = spline(&[([1, 0], 1), ([0, 1], 1), ([1, 1], 1), ([1, -1], 1)]);
        assert_eq!((zwart_powell.continuity(), zwart_powell.degree()), (Some(1), 2));
        assert!(!zwart_powell.is_independent() && zwart_powell.name().contains("Zwart-Powell"));
        let steps = spline(&[([1, 0], 1), ([0, 1], 3)]);
        assert_eq!((steps.continuity(), steps.bidegree()), (None, Some([0, 2])));
    }
}
