//! Which points are neighbours?
//!
//! All kinds of mesh share one way of walking, over half-edges ([`Connectivity`]): a mesh of polygons ([`HalfEdgeMesh`]),
//! the canonical patch around one extraordinary point, which extends as far as anybody walks ([`Patch`]), and that around a
//! vertex on a boundary or crease ([`Fan`]).

mod disc;
mod faces;
mod fan;
mod half_edge;
pub mod io;
mod linked;
mod pairing;
mod patch;
mod placement;
mod polygon;
mod repair;
pub mod shapes;
mod sides;
mod soup;
mod split;
mod tags;
mod triangulate;

pub use disc::disc;
pub use faces::{Faces, Sides};
pub use fan::{Fan, FanKind};
pub use half_edge::{HalfEdgeMesh, MAX_CORNERS, NONE};
pub use linked::{LinkedMesh, NoCut};
pub use pairing::NotAMesh;
pub use patch::{Canonical, Label, Lattice, Patch, PatchEdge, Site};
pub use placement::{Cycle, Placement, Turn};
pub use polygon::{NotAPolygon, Polygon};
pub use repair::{Dropped, Repair, drop_isolated, split_non_manifold};
pub use sides::sides;
pub use soup::{Crease, PolygonSoup};
pub use split::{Becoming, Birth, Centre, Numbering, Split};
pub use tags::{BadTag, Tagged, Tags, edge_between, first_corner};
pub use triangulate::triangulate;

/// A mesh seen through its half-edges. The half-edge h leaves `origin(h)` along an edge; the face to its left is its own.
/// Where there is no face the half-edge still exists, and `next` follows the boundary.
pub trait Connectivity {
    /// A half-edge.
    type Edge: Copy + Eq + std::fmt::Debug;
    /// A vertex.
    type Point: Copy + Ord + std::fmt::Debug;

    /// The other half of the edge.
    fn twin(&self, edge: Self::Edge) -> Self::Edge;
    /// The next half-edge that leaves the same vertex, counter-clockwise.
    fn turn(&self, edge: Self::Edge) -> Self::Edge;
    /// The previous one, clockwise.
    fn turn_back(&self, edge: Self::Edge) -> Self::Edge;
    /// The vertex that the half-edge leaves.
    fn origin(&self, edge: Self::Edge) -> Self::Point;
    /// Whether there is a face to the left.
    fn has_face(&self, edge: Self::Edge) -> bool;

    /// Whether the two sides of the edge don't see each other: it is a crease, or the boundary.
    fn is_sharp(&self, edge: Self::Edge) -> bool {
        !self.has_face(edge) || !self.has_face(self.twin(edge))
    }

    /// Whether the vertex that the half-edge leaves is tagged as a corner.
    fn is_corner(&self, _: Self::Edge) -> bool {
        false
    }

    /// The half-edges that leave the origin of `edge` along creases and the boundary, counter-clockwise from it.
    fn sharp_spokes(&self, edge: Self::Edge) -> Vec<Self::Edge> {
        self.around_vertex(edge).into_iter().filter(|spoke| self.is_sharp(*spoke)).collect()
    }

    /// The vertex that the half-edge leads to.
    fn target(&self, edge: Self::Edge) -> Self::Point {
        self.origin(self.twin(edge))
    }

    /// The next half-edge along the face to the left.
    fn next(&self, edge: Self::Edge) -> Self::Edge {
        self.turn_back(self.twin(edge))
    }

    /// The previous half-edge along the face to the left.
    fn prev(&self, edge: Self::Edge) -> Self::Edge {
        self.twin(self.turn(edge))
    }

    /// The half-edges that leave the origin of `edge`, counter-clockwise from it.
    fn around_vertex(&self, edge: Self::Edge) -> Vec<Self::Edge> {
        orbit(edge, |edge| self.turn(edge))
    }

    /// The half-edges of the face to the left of `edge`, counter-clockwise from it.
    fn around_face(&self, edge: Self::Edge) -> Vec<Self::Edge> {
        orbit(edge, |edge| self.next(edge))
    }

    /// The number of edges at the origin of `edge`.
    fn valence(&self, edge: Self::Edge) -> usize {
        let (mut count, mut at) = (1, self.turn(edge));
        while at != edge {
            count += 1;
            at = self.turn(at);
        }
        count
    }

    /// The half-edge at the origin of `edge` that has no face to its left, if the vertex lies on the boundary.
    fn boundary_at(&self, edge: Self::Edge) -> Option<Self::Edge> {
        self.around_vertex(edge).into_iter().find(|edge| !self.has_face(*edge))
    }
}

fn orbit<E: Copy + Eq>(start: E, step: impl Fn(E) -> E) -> Vec<E> {
    let mut orbit = vec![start];
    let mut at = step(start);
    while at != start {
        orbit.push(at);
        at = step(at);
    }
    orbit
}
