//! How large does a mesh become, and how much memory does that take?
//!
//! Known before the first step: each split turns vertices, edges and faces into so many of each.

use super::Coordinate;
use crate::mesh::{HalfEdgeMesh, MAX_CORNERS, Split};

/// The parts of a mesh, counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Vertices.
    pub vertices: u128,
    /// Edges.
    pub edges: u128,
    /// Faces.
    pub faces: u128,
    /// Corners of faces.
    pub corners: u128,
}

impl Counts {
    /// Those of a mesh.
    pub fn of(mesh: &HalfEdgeMesh) -> Counts {
        let [vertices, edges, faces, corners] =
            [mesh.vertices(), mesh.edge_count(), mesh.faces().len(), mesh.twins().len()].map(|count| count as u128);
        Counts { vertices, edges, faces, corners }
    }

    /// Those after a step, as far as 32 bits number them: beyond, counts stay. Where a boundary recedes, an
    /// upper bound.
    #[must_use]
    pub fn after(self, split: Split) -> Counts {
        if !self.can_be_numbered() {
            return self;
        }
        let Counts { vertices, edges, faces, corners } = self;
        // each edge of the boundary has one corner, each other one two
        let boundary = (2 * edges).saturating_sub(corners);
        match split {
            Split::OneToFour => Counts {
                vertices: vertices + edges,
                edges: 2 * edges + corners,
                faces: 4 * faces,
                corners: 4 * corners,
            },
            Split::OneToN => Counts {
                vertices: vertices + edges + faces,
                edges: 2 * edges + corners,
                faces: corners,
                corners: 4 * corners,
            },
            Split::Dual => {
                Counts { vertices: corners, edges: 2 * corners, faces: vertices + edges + faces, corners: 4 * corners }
            }
            Split::Sqrt3 => {
                Counts { vertices: vertices + faces, edges: edges + corners, faces: corners, corners: 3 * corners }
            }
            Split::Sqrt3Thirds => Counts {
                vertices: vertices + faces + boundary,
                edges: edges + corners + boundary,
                faces: corners,
                corners: 3 * corners,
            },
            Split::Sqrt2 => {
                Counts { vertices: vertices + faces, edges: 2 * edges, faces: edges, corners: 4 * edges - boundary }
            }
            Split::Sqrt2Halves => {
                let inside = edges.saturating_sub(boundary);
                Counts { vertices: vertices + faces, edges: corners, faces: inside, corners: 4 * inside }
            }
            Split::MidEdge => Counts { vertices: edges, edges: corners, faces: faces + vertices, corners: 2 * corners },
            Split::FacesToVertices => Counts { vertices: faces, edges, faces: vertices, corners },
            Split::Keep => self,
        }
    }

    /// Whether 32 bits number its corners.
    pub fn can_be_numbered(self) -> bool {
        self.corners <= MAX_CORNERS as u128 && self.vertices <= MAX_CORNERS as u128
    }

    /// The bytes of its faces and points.
    pub fn bytes_of_faces<T: Coordinate>(self) -> u128 {
        4 * self.corners + 3 * size_of::<T>() as u128 * self.vertices
    }

    /// The bytes of its mesh and points: twins, and a half-edge for each vertex, besides.
    pub fn bytes_of_mesh<T: Coordinate>(self) -> u128 {
        self.bytes_of_faces::<T>() + 4 * self.corners + 4 * self.vertices
    }

    /// The bytes of limit points and normals.
    pub fn bytes_of_limit(self) -> u128 {
        2 * 3 * size_of::<f64>() as u128 * self.vertices
    }

    /// The most bytes that are in use at one time during a step: the old mesh, the numbers of its edges, and the new mesh and points.
    pub fn bytes_of_step<T: Coordinate>(self, split: Split) -> u128 {
        let numbering = 4 * self.corners + 4 * self.edges;
        self.bytes_of_mesh::<T>() + numbering + self.after(split).bytes_of_mesh::<T>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Numbering, Tags, shapes};

    #[test]
    fn counts_are_those_of_the_meshes_that_splits_make() {
        let shapes = [shapes::torus(4, 5, true), shapes::many_valences(), shapes::tube(3, 4, true), shapes::prism(7)];
        for (index, shape) in shapes.iter().enumerate() {
            for (name, plain) in Split::NAMED {
                let mut mesh = HalfEdgeMesh::new(shape.positions.len(), shape.faces.clone()).unwrap();
                let mut tags = Tags::default();
                let triangles = matches!(plain, Split::OneToFour | Split::Sqrt3);
                if (triangles && index == 3) || (plain.recedes() && !mesh.is_closed()) {
                    continue;
                }
                for step in 0..4 {
                    let split = plain.at(&tags);
                    assert_eq!(split != plain, plain.cuts_in_turns() && !mesh.is_closed() && step % 2 == 1, "{name}");
                    let expected = Counts::of(&mesh).after(split);
                    let numbering = split.numbering(&mesh, Numbering::default());
                    assert_eq!(split.new_vertices(&mesh, &numbering) as u128, expected.vertices, "{name}");
                    let faces = split.faces(&mesh, &numbering, Vec::new());
                    let new = split.mesh(&mesh, &numbering, faces).unwrap();
                    tags = split.tags(&mesh, &tags, &new);
                    assert_eq!(Counts::of(&new), expected, "{name}, shape {index}, step {step}");
                    mesh = new;
                }
            }
        }
    }
}
