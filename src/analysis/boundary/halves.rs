//! Which symmetry has the local matrix of a fan, and what are its parts?
//!
//! S commutes with the mirror alone. So it leaves the functions alone that are the same in the mirror, and those that change
//! their sign: the *even* and the *odd* part. A point and its mirror image are one node; a point that is its own image
//! has the value 0 in every odd function. With a the point of a node and a' its image,
//!
//! > even: S_{ab} + S_{ab'},   odd: S_{ab} - S_{ab'}   (S_{ab} alone where b is its own image).

use super::super::parts::{Parts, Unit};
use crate::numbers::{Field, Trouble};
use nalgebra::DMatrix;

/// Whether a function is the same in the mirror or changes its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Parity {
    /// The same.
    Even,
    /// Its sign changes.
    Odd,
}

impl Parity {
    /// Both, in the order of the parts.
    pub const BOTH: [Parity; 2] = [Parity::Even, Parity::Odd];

    /// The parity of a part.
    pub fn of_part(part: usize) -> Parity {
        if part == 0 { Parity::Even } else { Parity::Odd }
    }

    /// The part of this parity.
    pub fn part(self) -> usize {
        usize::from(self == Parity::Odd)
    }

    /// `even` or `odd`.
    pub fn name(self) -> &'static str {
        if self == Parity::Even { "even" } else { "odd" }
    }
}

/// A point with its mirror image, by their rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MirrorNode {
    /// A point that is its own image; even part only.
    Fixed(usize),
    /// A point and its image.
    Pair(usize, usize),
}

impl MirrorNode {
    /// The first of its points.
    pub fn point(self) -> usize {
        let (MirrorNode::Fixed(point) | MirrorNode::Pair(point, _)) = self;
        point
    }

    /// The image of that, where it is another point.
    pub fn image(self) -> Option<usize> {
        if let MirrorNode::Pair(_, image) = self { Some(image) } else { None }
    }
}

impl Unit for MirrorNode {
    fn unknowns(self) -> usize {
        1
    }

    fn acts_on(self, part: usize) -> bool {
        part == 0 || self.image().is_some()
    }
}

/// The even and the odd part of a matrix.
#[derive(Clone, Debug)]
pub struct Halves<F = f64> {
    rows: Vec<Vec<(usize, F)>>,
    nodes: Vec<MirrorNode>,
}

impl<F: Field> Halves<F> {
    /// The parts of a matrix that is the same in a mirror: its rows as (column, weight) in order of the columns, and each row's image.
    pub fn of(rows: Vec<Vec<(usize, F)>>, mirror: &[usize]) -> Halves<F> {
        let node = |(point, image): (usize, &usize)| match *image {
            image if image == point => Some(MirrorNode::Fixed(point)),
            image if image > point => Some(MirrorNode::Pair(point, image)),
            _ => None,
        };
        Halves { nodes: mirror.iter().enumerate().filter_map(node).collect(), rows }
    }

    /// The weight of a column in a row.
    fn weight(&self, row: usize, column: usize) -> Option<&F> {
        let at = self.rows[row].binary_search_by_key(&column, |(column, _)| *column).ok()?;
        Some(&self.rows[row][at].1)
    }

    /// An entry of a part, for nodes that act on it.
    ///
    /// # Errors
    /// When the result is beyond its world of numbers.
    pub fn entry(&self, parity: Parity, to: MirrorNode, from: MirrorNode) -> Result<F, Trouble> {
        let zero = F::whole(0);
        let own = self.weight(to.point(), from.point()).unwrap_or(&zero);
        let image = from.image().and_then(|image| self.weight(to.point(), image)).unwrap_or(&zero);
        if parity == Parity::Even { own.plus(image) } else { own.minus(image) }
    }

    /// Every node.
    pub fn nodes(&self) -> &[MirrorNode] {
        &self.nodes
    }

    /// The nodes that act on a part.
    pub fn nodes_of(&self, parity: Parity) -> Vec<MirrorNode> {
        self.nodes.iter().copied().filter(|node| node.acts_on(parity.part())).collect()
    }

    /// The values on all points of a function that has these on the first points of nodes.
    fn spread(&self, part: usize, nodes: &[MirrorNode], values: &[f64], share: f64) -> Vec<f64> {
        let sign = if part == 0 { 1.0 } else { -1.0 };
        let mut spread = vec![0.0; self.rows.len()];
        for (node, value) in nodes.iter().zip(values) {
            match *node {
                MirrorNode::Fixed(point) => spread[point] = *value,
                MirrorNode::Pair(point, image) => {
                    (spread[point], spread[image]) = (share * value, sign * share * value);
                }
            }
        }
        spread
    }
}

/// Part 0 is the even one, part 1 the odd one.
impl Parts for Halves<f64> {
    type Node = MirrorNode;
    type Vector = Vec<f64>;

    fn count(&self) -> usize {
        Parity::BOTH.len()
    }

    fn nodes(&self) -> &[MirrorNode] {
        &self.nodes
    }

    fn feeds(&self, to: MirrorNode, from: MirrorNode) -> bool {
        let image = from.image().and_then(|image| self.weight(to.point(), image));
        self.weight(to.point(), from.point()).is_some() || image.is_some()
    }

    fn real_form(&self, part: usize, nodes: &[MirrorNode]) -> DMatrix<f64> {
        let parity = Parity::of_part(part);
        let entry = |to: usize, from: usize| self.entry(parity, nodes[to], nodes[from]).unwrap_or(f64::NAN);
        DMatrix::from_fn(nodes.len(), nodes.len(), entry)
    }

    fn right_from_real(&self, part: usize, nodes: &[MirrorNode], real: &[f64]) -> Vec<f64> {
        self.spread(part, nodes, real, 1.0)
    }

    /// A part acts on the value at a node's first point, which is half of the sum with (odd: of the difference from) that at its image.
    fn left_from_real(&self, part: usize, nodes: &[MirrorNode], real: &[f64]) -> Vec<f64> {
        self.spread(part, nodes, real, 0.5)
    }
}
