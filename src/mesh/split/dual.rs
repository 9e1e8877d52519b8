//! Dual: a new point for each corner of each face. The face f becomes a face of its own corners' points, an edge inside the
//! mesh with first corner h and twin t the quad (next h, h, next t, t), a vertex inside the mesh the face of the corners
//! around it; in this order. Points keep the numbers of their corners. Edges and vertices of the boundary make no face.

use super::{Numbering, RUN, room};
use crate::mesh::half_edge::{MAX_CORNERS, NONE};
use crate::mesh::pairing::fan;
use crate::mesh::{Faces, HalfEdgeMesh};
use rayon::prelude::*;

/// Where the faces of edges and vertices start among the new corners.
struct Layout {
    /// For each vertex where its face starts, among the corners of all vertices' faces; and their number.
    starts: Vec<u32>,
    /// The number of each edge among those inside the mesh, [`NONE`] for the boundary's.
    inner: Vec<u32>,
    inner_edges: usize,
}

impl Layout {
    fn of(mesh: &HalfEdgeMesh, numbering: &Numbering) -> Layout {
        let twins = mesh.twins();
        let mut inner_edges = 0;
        let number = |h: &u32| {
            if twins[*h as usize] == NONE {
                return NONE;
            }
            inner_edges += 1;
            inner_edges - 1
        };
        let inner = numbering.first_corners().iter().map(number).collect();
        let mut starts: Vec<u32> = mesh.vertex_edges().par_iter().map(|h| valence_inside(mesh, *h)).collect();
        let mut total = 0;
        for start in &mut starts {
            (*start, total) = (total, total + *start);
        }
        starts.push(total);
        Layout { starts, inner, inner_edges: inner_edges as usize }
    }

    /// The first corner of the quad of an edge.
    fn quad(&self, mesh: &HalfEdgeMesh, edge: u32) -> u32 {
        mesh.twins().len() as u32 + 4 * self.inner[edge as usize]
    }

    /// The first corner of the faces of vertices.
    fn vertex_faces(&self, mesh: &HalfEdgeMesh) -> u32 {
        mesh.twins().len() as u32 + 4 * self.inner_edges as u32
    }
}

/// The valence of a vertex inside the mesh; 0 on the boundary.
fn valence_inside(mesh: &HalfEdgeMesh, leaving: u32) -> u32 {
    if mesh.twins()[leaving as usize] == NONE { 0 } else { fan(mesh.faces(), mesh.twins(), leaving).count() as u32 }
}

pub(super) fn new_corners(mesh: &HalfEdgeMesh) -> Option<usize> {
    // one for each corner in its face, two for each in the quads of edges, one around its vertex, less what the boundary has not
    mesh.twins().len().checked_mul(4).filter(|corners| *corners <= MAX_CORNERS)
}

pub(super) fn faces(mesh: &HalfEdgeMesh, numbering: &Numbering, buffer: Vec<u32>) -> Faces {
    let layout = Layout::of(mesh, numbering);
    let (old, twins) = (mesh.faces(), mesh.twins());
    let vertex_faces = layout.vertex_faces(mesh) as usize;
    let mut corners = room(buffer, vertex_faces + layout.starts[mesh.vertices()] as usize);
    let (of_faces, rest) = corners.split_at_mut(twins.len());
    let (of_edges, of_vertices) = rest.split_at_mut(4 * layout.inner_edges);
    of_faces.par_iter_mut().enumerate().for_each(|(h, corner)| *corner = h as u32);
    let quads = numbering.first_corners().iter().filter(|h| twins[**h as usize] != NONE);
    for (quad, h) in of_edges.as_chunks_mut::<4>().0.iter_mut().zip(quads) {
        let twin = twins[*h as usize];
        *quad = [old.next(*h), *h, old.next(twin), twin];
    }
    fill_around_vertices(mesh, &layout, of_vertices);
    with_sizes(mesh, &layout, corners)
}

/// The corners around each vertex inside the mesh, in runs of vertices.
fn fill_around_vertices(mesh: &HalfEdgeMesh, layout: &Layout, mut corners: &mut [u32]) {
    let mut jobs = Vec::new();
    for first in (0..mesh.vertices()).step_by(RUN) {
        let last = (first + RUN).min(mesh.vertices());
        let (own, others) = corners.split_at_mut((layout.starts[last] - layout.starts[first]) as usize);
        jobs.push((first..last, own));
        corners = others;
    }
    jobs.into_par_iter().for_each(|(vertices, corners)| {
        let inside = mesh.vertex_edges()[vertices].iter().filter(|h| mesh.twins()[**h as usize] != NONE);
        let around = inside.flat_map(|h| fan(mesh.faces(), mesh.twins(), *h));
        corners.iter_mut().zip(around).for_each(|(corner, h)| *corner = h);
    });
}

/// The faces, from their corners one after the other.
fn with_sizes(mesh: &HalfEdgeMesh, layout: &Layout, corners: Vec<u32>) -> Faces {
    let mut sizes = Vec::with_capacity(mesh.faces().len() + layout.inner_edges + mesh.vertices());
    sizes.extend((0..mesh.faces().len()).map(|face| mesh.faces().range(face).len() as u32));
    sizes.resize(sizes.len() + layout.inner_edges, 4);
    sizes.extend(layout.starts.windows(2).map(|pair| pair[1] - pair[0]).filter(|size| *size > 0));
    Faces::mixed(&sizes, corners)
}

pub(super) fn twins_and_leaving(mesh: &HalfEdgeMesh, numbering: &Numbering, new: &Faces) -> (Vec<u32>, Vec<u32>) {
    let layout = Layout::of(mesh, numbering);
    let twins = mesh.twins();
    let vertex_faces = layout.vertex_faces(mesh);
    let mut new_twins = vec![NONE; new.corners().len()];
    // where each corner stands in the face of its vertex
    let mut around = vec![NONE; twins.len()];
    for (at, h) in new.corners()[vertex_faces as usize..].iter().enumerate() {
        around[*h as usize] = vertex_faces + at as u32;
    }
    let mut pair = |a: u32, b: u32| {
        if a != NONE && b != NONE {
            new_twins[a as usize] = b;
            new_twins[b as usize] = a;
        }
    };
    for (edge, h) in numbering.first_corners().iter().enumerate() {
        let twin = twins[*h as usize];
        if twin == NONE {
            continue;
        }
        let quad = layout.quad(mesh, edge as u32);
        pair(quad, *h);
        pair(quad + 2, twin);
        // the faces of the ends run from the corner before to this one
        pair(quad + 1, around[mesh.faces().next(twin) as usize]);
        pair(quad + 3, around[mesh.faces().next(*h) as usize]);
    }
    let leaving = (0..twins.len() as u32).map(|point| first_of_fan(mesh, numbering, &layout, &around, point)).collect();
    (new_twins, leaving)
}

/// The half-edge that leaves the point of corner h, clockwise from all others where it lies on the boundary: counter-clockwise around the point
/// are its own face, the quad of the edge before, the face of the vertex, the quad of the edge after.
fn first_of_fan(mesh: &HalfEdgeMesh, numbering: &Numbering, layout: &Layout, around: &[u32], h: u32) -> u32 {
    let twin = mesh.twins()[h as usize];
    if around[h as usize] != NONE || twin == NONE {
        return h;
    }
    // the quad of the edge after h is clockwise from the face
    layout.quad(mesh, numbering.of_corner(h, twin)) + if h < twin { 1 } else { 3 }
}
