//! Which mesh is a canonical patch, out to some rings?

use super::{Connectivity, Faces, Label, Lattice, PatchEdge};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// The faces of a patch or fan whose corners lie within some rings of the centre, and the labels of their vertices. The centre comes first;
/// dual: the central face, and its corners in order. `spoke` leaves the centre (dual: corner 0, along the central face).
pub fn disc<M>(patch: &M, lattice: Lattice, spoke: PatchEdge, rings: i32) -> (Vec<Label>, Faces)
where
    M: Connectivity<Edge = PatchEdge, Point = Label>,
{
    let within = |label: Label| lattice.ring(label.i, label.j) <= rings;
    let mut numbers: BTreeMap<Label, usize> = BTreeMap::new();
    let mut labels = Vec::new();
    let (mut faces, mut met) = (Vec::new(), BTreeSet::new());
    let mut waiting = VecDeque::from([spoke]);
    while let Some(edge) = waiting.pop_front() {
        if !patch.has_face(edge) {
            continue;
        }
        let around = patch.around_face(edge);
        let corners: Vec<Label> = around.iter().map(|edge| patch.origin(*edge)).collect();
        let mut name = corners.clone();
        name.sort_unstable();
        if !corners.iter().all(|label| within(*label)) || !met.insert(name) {
            continue;
        }
        let mut number = |label: &Label| {
            *numbers.entry(*label).or_insert_with(|| {
                labels.push(*label);
                labels.len() - 1
            })
        };
        faces.push(corners.iter().map(&mut number).collect::<Vec<usize>>());
        waiting.extend(around.iter().map(|edge| patch.twin(*edge)));
    }
    (labels, Faces::from_lists(&faces))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Fan, FanKind, HalfEdgeMesh, Patch};

    #[test]
    fn discs_have_the_vertices_that_their_rings_count() {
        for n in [3, 5, 6, 9] {
            for (lattice, rings, vertices) in
                [(Lattice::Triangles, 3, 1 + 6 * n), (Lattice::Quads, 3, 1 + 12 * n), (Lattice::Dual, 2, 9 * n)]
            {
                let patch = Patch::new(lattice, n);
                let spoke = match patch.centre() {
                    Some(centre) => patch.edge(centre, 0),
                    None => patch.edge(Label { sector: 0, i: 0, j: 0 }, 2),
                };
                let (labels, faces) = disc(&patch, lattice, spoke, rings);
                assert_eq!(labels.len(), vertices, "{lattice:?} {n}");
                let mesh = HalfEdgeMesh::new(labels.len(), faces).unwrap();
                let first = mesh.vertex_edges()[0];
                assert_eq!(mesh.euler_characteristic(), 1);
                match patch.centre() {
                    Some(centre) => assert!(labels[0] == centre && mesh.valence(first) == n),
                    None => assert_eq!(mesh.faces().face(0), (0..n as u32).collect::<Vec<_>>()),
                }
            }
        }
        for k in [1, 2, 5] {
            let fan = Fan::new(Lattice::Triangles, FanKind::Crease { faces: k });
            let (labels, faces) = disc(&fan, Lattice::Triangles, fan.spoke(0), 3);
            assert_eq!(labels.len(), 1 + 6 * k + 3);
            let mesh = HalfEdgeMesh::new(labels.len(), faces).unwrap();
            assert!(mesh.boundary_at(mesh.vertex_edges()[0]).is_some() && mesh.euler_characteristic() == 1);
        }
    }
}
