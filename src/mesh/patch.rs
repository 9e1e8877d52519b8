//! What does a mesh look like around one extraordinary point?
//!
//! The canonical patch: n sectors around a centre, regular everywhere else, without end. Nothing is stored; a point is its
//! label (sector, i, j), and walking is arithmetic. In sector s the point (i, j) lies i edges straight along spoke s from
//! the centre and, turned counter-clockwise once, j edges over (i >= 1, j >= 0; the centre is (0, 0)). On the dual lattice the
//! centre is a face with n corners: (i, j) lies i and j edges beyond its corner s (i, j >= 0). Labels are unfolded into
//! the neighbouring sector where they leave their own.

use super::{Connectivity, Placement};

/// The three regular lattices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lattice {
    /// Triangles, six around a vertex; the centre is a vertex.
    Triangles,
    /// Quads, four around a vertex; the centre is a vertex.
    Quads,
    /// Quads, four around a vertex; the centre is a face.
    Dual,
}

impl Lattice {
    /// The valence at which the patch is regular.
    pub fn regular_valence(self) -> usize {
        if self == Lattice::Triangles { 6 } else { 4 }
    }

    /// The number of corners of its faces.
    pub fn face_corners(self) -> usize {
        if self == Lattice::Triangles { 3 } else { 4 }
    }

    /// The unit steps in a sector's coordinates, counter-clockwise from its spoke.
    pub fn steps(self) -> &'static [(i32, i32)] {
        match self {
            Lattice::Triangles => &[(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)],
            Lattice::Quads | Lattice::Dual => &[(1, 0), (0, 1), (-1, 0), (0, -1)],
        }
    }

    /// The ring around the centre that a label lies on.
    pub fn ring(self, i: i32, j: i32) -> i32 {
        if self == Lattice::Triangles { i + j } else { i.max(j) }
    }

    /// Whether the centre is a vertex, and so a point of its own.
    pub fn has_centre(self) -> bool {
        self != Lattice::Dual
    }

    /// The mirror image of the orbit (i, j) under the reflection that fixes spoke 0, and how many sectors it is shifted by:
    /// sector s goes to sector -s - shift.
    pub fn mirror(self, (i, j): (i32, i32)) -> ((i32, i32), i32) {
        match self {
            Lattice::Dual => ((j, i), 0),
            _ if j == 0 => ((i, j), 0),
            _ => ((j, i), 1),
        }
    }

    /// The label of a point given in the coordinates of a sector, as (shift of sector, i, j): unfolded until canonical.
    pub(super) fn unfold(self, mut i: i32, mut j: i32) -> (i32, i32, i32) {
        let mut shift = 0;
        loop {
            match self {
                _ if self.has_centre() && i == 0 && j == 0 => return (0, 0, 0),
                Lattice::Triangles if j < 0 => (i, j, shift) = (-j, i + j, shift - 1),
                Lattice::Triangles if i <= 0 => (i, j, shift) = (i + j, -i, shift + 1),
                Lattice::Quads if j < 0 => (i, j, shift) = (-j, i, shift - 1),
                Lattice::Quads if i <= 0 => (i, j, shift) = (j, -i, shift + 1),
                Lattice::Dual if j < 0 => (i, j, shift) = (-1 - j, i, shift - 1),
                Lattice::Dual if i < 0 => (i, j, shift) = (j, -1 - i, shift + 1),
                _ => return (shift, i, j),
            }
        }
    }

    /// Whether this label is that of a centre that is a point.
    pub(super) fn is_centre(self, label: Label) -> bool {
        self.has_centre() && label.i == 0 && label.j == 0
    }

    /// The other half of an edge; `shifted` names the sector some sectors on.
    pub(super) fn twin(self, edge: PatchEdge, shifted: impl Fn(u32, i32) -> u32) -> PatchEdge {
        let PatchEdge { origin, direction } = edge;
        let directions = self.steps().len() as i64;
        if self.is_centre(origin) {
            return PatchEdge { origin: Label { sector: direction, i: 1, j: 0 }, direction: directions as u32 / 2 };
        }
        let (di, dj) = self.steps()[direction as usize];
        let (shift, i, j) = self.unfold(origin.i + di, origin.j + dj);
        if self.has_centre() && i == 0 && j == 0 {
            return PatchEdge { origin: Label { sector: 0, i, j }, direction: origin.sector };
        }
        let back = (i64::from(direction) + directions / 2 - i64::from(shift)).rem_euclid(directions) as u32;
        PatchEdge { origin: Label { sector: shifted(origin.sector, shift), i, j }, direction: back }
    }
}

/// A point of the patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label {
    /// 0..n; 0 for the centre.
    pub sector: u32,
    /// Edges along the sector's spoke.
    pub i: i32,
    /// Edges over.
    pub j: i32,
}

impl Label {
    /// The point itself, without its sector.
    pub fn orbit(self) -> (i32, i32) {
        (self.i, self.j)
    }
}

/// A half-edge of the patch: the point that it leaves and its direction, an index into [`Lattice::steps`] in the sector's
/// coordinates; at a centre that is a vertex the direction is the spoke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PatchEdge {
    pub(super) origin: Label,
    pub(super) direction: u32,
}

/// The place of the coarse patch that a point of the refined patch is born at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Site {
    /// At a vertex: a half-edge that leaves it.
    Vertex(PatchEdge),
    /// On an edge: one of its halves.
    Edge(PatchEdge),
    /// In a face: one of its half-edges.
    Face(PatchEdge),
    /// At a corner: the half-edge of the face that leaves it.
    Corner(PatchEdge),
    /// At a vertex that stays where it is: a half-edge that leaves it.
    Kept(PatchEdge),
    /// On an edge of the boundary, at the third that is nearer to the vertex that this half-edge leaves.
    Third(PatchEdge),
}

impl Site {
    /// The same told by another half-edge.
    #[must_use]
    pub(super) fn mapped(self, f: impl FnOnce(PatchEdge) -> PatchEdge) -> Site {
        match self {
            Site::Vertex(edge) => Site::Vertex(f(edge)),
            Site::Edge(edge) => Site::Edge(f(edge)),
            Site::Face(edge) => Site::Face(f(edge)),
            Site::Corner(edge) => Site::Corner(f(edge)),
            Site::Kept(edge) => Site::Kept(f(edge)),
            Site::Third(edge) => Site::Third(f(edge)),
        }
    }
}

/// A mesh that is arithmetic on labels, around one vertex or face.
pub trait Canonical: Connectivity<Edge = PatchEdge, Point = Label> {
    /// The point at coordinates (i, j) of a sector, which may reach into the sectors beside it.
    fn point(&self, sector: u32, i: i32, j: i32) -> Label;
    /// Where a split puts the point `label` of the refined mesh.
    fn birth(&self, placement: &Placement, label: Label) -> Site;
    /// The same around the centre on the lattice that a split starts from, as it stands.
    #[must_use]
    fn before(&self, placement: &Placement) -> Self;
    /// Whether a point is as far from the centre and from every crease as said, in edges.
    fn is_clear(&self, label: Label, of_centre: i32, of_crease: i32) -> bool;
}

impl Canonical for Patch {
    fn point(&self, sector: u32, i: i32, j: i32) -> Label {
        Patch::point(self, sector, i, j)
    }

    fn birth(&self, placement: &Placement, label: Label) -> Site {
        Patch::birth(self, placement, label)
    }

    fn before(&self, placement: &Placement) -> Self {
        Patch { lattice: placement.from, ..*self }
    }

    fn is_clear(&self, label: Label, of_centre: i32, _: i32) -> bool {
        label.i + label.j >= of_centre
    }
}

/// The canonical patch of a valence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patch {
    /// The lattice that it is made of.
    pub lattice: Lattice,
    /// The number of sectors, n.
    pub valence: u32,
}

impl Patch {
    /// The patch with `valence` sectors; a valence below 3 is raised to 3.
    pub fn new(lattice: Lattice, valence: usize) -> Self {
        Patch { lattice, valence: u32::try_from(valence).unwrap_or(u32::MAX).max(3) }
    }

    /// The centre, where it is a point.
    pub fn centre(&self) -> Option<Label> {
        self.lattice.has_centre().then_some(Label { sector: 0, i: 0, j: 0 })
    }

    fn is_centre(&self, label: Label) -> bool {
        self.lattice.is_centre(label)
    }

    /// The point at coordinates (i, j) of a sector, which may reach into the sectors beside it.
    pub fn point(&self, sector: u32, i: i32, j: i32) -> Label {
        let (shift, i, j) = self.lattice.unfold(i, j);
        if self.lattice.has_centre() && i == 0 && j == 0 {
            return Label { sector: 0, i: 0, j: 0 };
        }
        Label { sector: self.shifted(sector, shift), i, j }
    }

    fn shifted(&self, sector: u32, shift: i32) -> u32 {
        (i64::from(sector) + i64::from(shift)).rem_euclid(i64::from(self.valence)) as u32
    }

    /// The point's mirror image under the reflection that fixes spoke 0 (dual: corner 0).
    pub fn mirrored(&self, label: Label) -> Label {
        if self.is_centre(label) {
            return label;
        }
        let ((i, j), shift) = self.lattice.mirror(label.orbit());
        Label { sector: self.shifted(0, -(label.sector as i32) - shift), i, j }
    }

    /// The point turned by a number of sectors.
    pub fn rotated(&self, label: Label, sectors: i32) -> Label {
        self.moved(label, sectors)
    }

    /// The half-edge that leaves a point in a direction of its sector's coordinates, or along a spoke of the centre.
    pub fn edge(&self, origin: Label, direction: u32) -> PatchEdge {
        PatchEdge { origin, direction }
    }

    /// Where a split puts the point `label` of the refined patch.
    pub fn birth(&self, placement: &Placement, label: Label) -> Site {
        let (shift, site) = placement.birth(label);
        site.mapped(|edge| match self.centre() {
            Some(centre) if self.is_centre(edge.origin) => {
                PatchEdge { origin: centre, direction: self.shifted(edge.origin.sector, shift) }
            }
            _ => PatchEdge { origin: self.moved(edge.origin, shift), ..edge },
        })
    }

    fn moved(&self, label: Label, sectors: i32) -> Label {
        if self.is_centre(label) { label } else { Label { sector: self.shifted(label.sector, sectors), ..label } }
    }
}

impl Connectivity for Patch {
    type Edge = PatchEdge;
    type Point = Label;

    fn twin(&self, edge: PatchEdge) -> PatchEdge {
        self.lattice.twin(edge, |sector, shift| self.shifted(sector, shift))
    }

    fn turn(&self, edge: PatchEdge) -> PatchEdge {
        let around = if self.is_centre(edge.origin) { self.valence } else { self.lattice.steps().len() as u32 };
        PatchEdge { direction: (edge.direction + 1) % around, ..edge }
    }

    fn turn_back(&self, edge: PatchEdge) -> PatchEdge {
        let around = if self.is_centre(edge.origin) { self.valence } else { self.lattice.steps().len() as u32 };
        PatchEdge { direction: (edge.direction + around - 1) % around, ..edge }
    }

    fn origin(&self, edge: PatchEdge) -> Label {
        edge.origin
    }

    fn has_face(&self, _: PatchEdge) -> bool {
        true
    }

    fn valence(&self, edge: PatchEdge) -> usize {
        if self.is_centre(edge.origin) { self.valence as usize } else { self.lattice.steps().len() }
    }

    fn boundary_at(&self, _: PatchEdge) -> Option<PatchEdge> {
        None
    }

    fn is_sharp(&self, _: PatchEdge) -> bool {
        false
    }

    fn sharp_spokes(&self, _: PatchEdge) -> Vec<PatchEdge> {
        Vec::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every half-edge that leaves a point within two rings.
    fn edges(patch: Patch) -> Vec<PatchEdge> {
        let centre = patch.centre().map(|centre| (0..patch.valence).map(move |spoke| patch.edge(centre, spoke)));
        let mut edges: Vec<PatchEdge> = centre.into_iter().flatten().collect();
        let first = if patch.lattice.has_centre() { 1 } else { 0 };
        for sector in 0..patch.valence {
            for (i, j) in (first..4).flat_map(|i| (0..3).map(move |j| (i, j))) {
                edges.extend((0..patch.lattice.steps().len() as u32).map(|d| patch.edge(Label { sector, i, j }, d)));
            }
        }
        edges
    }

    #[test]
    fn walking_keeps_the_laws_of_half_edges() {
        for lattice in [Lattice::Triangles, Lattice::Quads, Lattice::Dual] {
            for valence in [3, 4, 5, 6, 9] {
                let patch = Patch::new(lattice, valence);
                let corners = if lattice == Lattice::Triangles { 3 } else { 4 };
                let mut centre_faces = 0;
                for edge in edges(patch) {
                    let here = format!("{lattice:?} {valence} {edge:?}");
                    assert_eq!(patch.twin(patch.twin(edge)), edge, "{here}");
                    assert_ne!(patch.origin(edge), patch.target(edge), "{here}");
                    assert_eq!(patch.prev(patch.next(edge)), edge, "{here}");
                    assert_eq!(patch.turn_back(patch.turn(edge)), edge, "{here}");
                    assert_eq!(patch.around_vertex(edge).len(), patch.valence(edge), "{here}");
                    let face = patch.around_face(edge);
                    let central =
                        lattice == Lattice::Dual && face.iter().all(|edge| patch.origin(*edge).orbit() == (0, 0));
                    centre_faces += usize::from(central);
                    assert_eq!(face.len(), if central { valence } else { corners }, "{here}");
                    let mirrored = patch.mirrored(patch.mirrored(patch.origin(edge)));
                    assert_eq!(mirrored, patch.origin(edge), "{here}");
                }
                assert_eq!(centre_faces, if lattice == Lattice::Dual { valence } else { 0 });
            }
        }
    }

    #[test]
    fn a_mirror_image_keeps_neighbours() {
        for lattice in [Lattice::Triangles, Lattice::Quads, Lattice::Dual] {
            let patch = Patch::new(lattice, 5);
            for edge in edges(patch) {
                let (a, b) = (patch.mirrored(patch.origin(edge)), patch.mirrored(patch.target(edge)));
                let spokes = if patch.is_centre(a) { patch.valence } else { lattice.steps().len() as u32 };
                let neighbours: Vec<Label> = (0..spokes).map(|d| patch.target(patch.edge(a, d))).collect();
                assert!(neighbours.contains(&b), "{lattice:?} {edge:?}");
            }
        }
    }

    #[test]
    fn at_the_regular_valence_the_patch_is_the_lattice() {
        for lattice in [Lattice::Triangles, Lattice::Quads, Lattice::Dual] {
            let patch = Patch::new(lattice, lattice.regular_valence());
            for edge in edges(patch) {
                assert_eq!(patch.valence(edge), lattice.regular_valence());
                let corners = if lattice == Lattice::Triangles { 3 } else { 4 };
                assert_eq!(patch.around_face(edge).len(), corners);
            }
        }
    }

    #[test]
    fn a_new_point_lies_between_the_points_of_its_birth_place() {
        let patch = Patch::new(Lattice::Quads, 5);
        let placement = Placement::of(crate::mesh::Split::OneToN, Lattice::Quads, false).unwrap();
        let double = |label: Label| patch.point(label.sector, 2 * label.i, 2 * label.j);
        for edge in edges(patch) {
            let fine = patch.origin(edge);
            match patch.birth(&placement, fine) {
                Site::Vertex(at) => assert_eq!(double(patch.origin(at)), fine),
                Site::Edge(at) => {
                    let (a, b) = (double(patch.origin(at)), double(patch.target(at)));
                    let neighbours: Vec<Label> =
                        patch.around_vertex(patch.edge(fine, 0)).iter().map(|e| patch.target(*e)).collect();
                    assert!(neighbours.contains(&a) && neighbours.contains(&b), "{fine:?}");
                }
                Site::Face(at) => assert_eq!(patch.around_face(at).len(), 4),
                other => panic!("{other:?}"),
            }
        }
    }
}
