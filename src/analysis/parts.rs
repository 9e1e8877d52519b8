//! Into which parts does a local matrix fall, whatever its symmetry?
//!
//! What the stages after the symmetry need of it: under rotation the parts are the frequencies ([`super::blocks::Blocks`]),
//! under a mirror alone an even and an odd one ([`super::boundary::halves::Halves`]). A part is a real matrix on *nodes*, orbits of points under the
//! symmetry; which node feeds which is the same in all of them.

use nalgebra::DMatrix;

/// A node: an orbit of points.
pub trait Unit: Copy {
    /// The number of real unknowns that it has in a part that it acts on.
    fn unknowns(self) -> usize;
    /// Whether it has unknowns in a part.
    fn acts_on(self, part: usize) -> bool;
}

/// A local matrix as the direct sum of parts, part 0 being that of the constants.
pub trait Parts {
    /// The nodes.
    type Node: Unit;
    /// A vector on the points of the neighbourhood.
    type Vector;

    /// The number of parts.
    fn count(&self) -> usize;
    /// Every node.
    fn nodes(&self) -> &[Self::Node];
    /// Whether the points of one node are made of points of another.
    fn feeds(&self, to: Self::Node, from: Self::Node) -> bool;
    /// The real form of a part, restricted to nodes that act on it.
    fn real_form(&self, part: usize, nodes: &[Self::Node]) -> DMatrix<f64>;
    /// The vector on the points that a vector of the real form stands for.
    fn right_from_real(&self, part: usize, nodes: &[Self::Node], real: &[f64]) -> Self::Vector;
    /// The row vector on the points that a left vector of the real form stands for.
    fn left_from_real(&self, part: usize, nodes: &[Self::Node], real: &[f64]) -> Self::Vector;
}
