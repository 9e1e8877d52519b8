//! What does a mesh look like around one vertex on a boundary or a crease?
//!
//! The canonical fan: like [`Patch`](super::Patch) without end, regular but for the centre, and computed, not stored. At a
//! *crease* vertex and at a *corner* it is a half-disc of k sectors whose boundary runs straight along the spokes 0 and k;
//! labels are those of the patch, and of sector k only the points (i, 0) of the last spoke are there. A boundary is a crease
//! with nothing beyond it: a vertex on a crease inside a mesh has such a half-disc on either side. At a *dart* it is the whole disc of
//! n sectors, and a crease runs along spoke 0 and ends at the centre.

use super::{Canonical, Connectivity, Label, Lattice, PatchEdge, Placement, Site};

/// What kind of vertex the centre is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FanKind {
    /// A vertex that the boundary, or a crease, passes through.
    Crease {
        /// The number of faces on this side.
        faces: usize,
    },
    /// A vertex of the boundary, or between two creases, that is a corner.
    Corner {
        /// The number of faces between the two.
        faces: usize,
    },
    /// A vertex inside the mesh at which one crease ends.
    Dart {
        /// The number of faces around it, its valence.
        faces: usize,
    },
}

impl FanKind {
    /// The number of faces around the centre, which is that of sectors.
    pub fn faces(self) -> usize {
        let (FanKind::Crease { faces } | FanKind::Corner { faces } | FanKind::Dart { faces }) = self;
        faces
    }

    /// The least number of faces of the kind.
    pub fn least_faces(self) -> usize {
        if self.is_closed() { 3 } else { 1 }
    }

    /// The kind in a word: `crease`, `corner` or `dart`.
    pub fn name(self) -> &'static str {
        match self {
            FanKind::Crease { .. } => "crease",
            FanKind::Corner { .. } => "corner",
            FanKind::Dart { .. } => "dart",
        }
    }

    /// Whether the faces go all the way round.
    pub fn is_closed(self) -> bool {
        matches!(self, FanKind::Dart { .. })
    }
}

/// The canonical fan of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fan {
    lattice: Lattice,
    kind: FanKind,
    sectors: u32,
}

impl Fan {
    /// The fan of a kind on a lattice whose centre is a vertex; too few faces are raised to the least number that there can
    /// be, and the dual lattice is taken for the quads that it is made of.
    pub fn new(lattice: Lattice, kind: FanKind) -> Fan {
        let lattice = if lattice.has_centre() { lattice } else { Lattice::Quads };
        let least = kind.least_faces() as u32;
        let sectors = u32::try_from(kind.faces()).unwrap_or(u32::MAX >> 1).clamp(least, u32::MAX >> 1);
        Fan { lattice, kind, sectors }
    }

    /// The lattice that it is made of.
    pub fn lattice(&self) -> Lattice {
        self.lattice
    }

    /// What kind of vertex the centre is.
    pub fn kind(&self) -> FanKind {
        self.kind
    }

    /// The number of sectors, k (at a dart n).
    pub fn sectors(&self) -> u32 {
        self.sectors
    }

    /// The number of edges at the centre.
    pub fn spokes(&self) -> u32 {
        if self.kind.is_closed() { self.sectors } else { self.sectors + 1 }
    }

    /// The centre.
    pub fn centre(&self) -> Label {
        Label { sector: 0, i: 0, j: 0 }
    }

    /// The point at coordinates (i, j) of a sector, which may reach into the sectors beside it.
    pub fn point(&self, sector: u32, i: i32, j: i32) -> Label {
        let (shift, i, j) = self.lattice.unfold(i, j);
        if i == 0 && j == 0 { self.centre() } else { Label { sector: self.shifted(sector, shift), i, j } }
    }

    fn shifted(&self, sector: u32, shift: i32) -> u32 {
        let (sector, sectors) = (i64::from(sector) + i64::from(shift), i64::from(self.sectors));
        (if self.kind.is_closed() { sector.rem_euclid(sectors) } else { sector.clamp(0, sectors) }) as u32
    }

    /// The point's mirror image under the reflection that exchanges spokes 0 and k; at a dart that which fixes spoke 0.
    pub fn mirrored(&self, label: Label) -> Label {
        if self.lattice.is_centre(label) {
            return label;
        }
        let ((i, j), shift) = self.lattice.mirror(label.orbit());
        Label { sector: self.shifted(self.sectors, -(label.sector as i32) - shift), i, j }
    }

    /// Where a split puts the point `label` of the refined fan, as on the patch; one that turns the lattice has no fans.
    pub fn birth(&self, placement: &Placement, label: Label) -> Site {
        placement.birth(label).1.mapped(|edge| {
            let at_centre = self.lattice.is_centre(edge.origin);
            if at_centre { PatchEdge { origin: self.centre(), direction: 0 } } else { edge }
        })
    }

    /// The half-edge that leaves the centre along a spoke.
    pub fn spoke(&self, spoke: u32) -> PatchEdge {
        PatchEdge { origin: self.centre(), direction: spoke }
    }

    /// The first and the last direction, counter-clockwise, of the half-edges that leave a point: across the boundary there is none.
    fn directions(&self, origin: Label) -> (u32, u32) {
        let all = self.lattice.steps().len() as u32;
        match origin {
            _ if self.lattice.is_centre(origin) => (0, self.spokes() - 1),
            Label { j: 0, sector: 0, .. } if !self.kind.is_closed() => (0, all / 2),
            Label { j: 0, sector, .. } if !self.kind.is_closed() && sector == self.sectors => (all / 2, 0),
            _ => (0, all - 1),
        }
    }

    /// The number of directions at a point, of which some may have no half-edge.
    fn round(&self, origin: Label) -> u32 {
        if self.lattice.is_centre(origin) { self.spokes() } else { self.lattice.steps().len() as u32 }
    }
}

impl Canonical for Fan {
    fn point(&self, sector: u32, i: i32, j: i32) -> Label {
        Fan::point(self, sector, i, j)
    }

    fn birth(&self, placement: &Placement, label: Label) -> Site {
        Fan::birth(self, placement, label)
    }

    fn on(&self, lattice: Lattice) -> Self {
        Fan { lattice, ..*self }
    }

    fn is_clear(&self, Label { sector, i, j }: Label, of_centre: i32, of_crease: i32) -> bool {
        let along_first = sector == 0 && j < of_crease;
        let along_last = sector + 1 >= self.sectors && i < of_crease || sector >= self.sectors;
        i + j >= of_centre && !along_first && !along_last
    }
}

impl Connectivity for Fan {
    type Edge = PatchEdge;
    type Point = Label;

    fn twin(&self, edge: PatchEdge) -> PatchEdge {
        self.lattice.twin(edge, |sector, shift| self.shifted(sector, shift))
    }

    fn turn(&self, edge: PatchEdge) -> PatchEdge {
        let (first, last) = self.directions(edge.origin);
        let next = (edge.direction + 1) % self.round(edge.origin);
        PatchEdge { direction: if edge.direction == last { first } else { next }, ..edge }
    }

    fn turn_back(&self, edge: PatchEdge) -> PatchEdge {
        let (first, last) = self.directions(edge.origin);
        let round = self.round(edge.origin);
        let previous = (edge.direction + round - 1) % round;
        PatchEdge { direction: if edge.direction == first { last } else { previous }, ..edge }
    }

    fn origin(&self, edge: PatchEdge) -> Label {
        edge.origin
    }

    fn has_face(&self, edge: PatchEdge) -> bool {
        let boundary = self.lattice.is_centre(edge.origin)
            || edge.origin.j == 0 && (edge.origin.sector == 0 || edge.origin.sector == self.sectors);
        self.kind.is_closed() || !boundary || edge.direction != self.directions(edge.origin).1
    }

    fn is_sharp(&self, edge: PatchEdge) -> bool {
        if !self.kind.is_closed() {
            return !self.has_face(edge) || !self.has_face(self.twin(edge));
        }
        let straight = edge.direction == 0 || edge.direction == self.lattice.steps().len() as u32 / 2;
        match edge.origin {
            origin if self.lattice.is_centre(origin) => edge.direction == 0,
            origin => origin.sector == 0 && origin.j == 0 && straight,
        }
    }

    fn is_corner(&self, edge: PatchEdge) -> bool {
        matches!(self.kind, FanKind::Corner { .. }) && self.lattice.is_centre(edge.origin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Split;
    use std::collections::BTreeSet;

    const KINDS: [FanKind; 9] = [
        FanKind::Crease { faces: 1 },
        FanKind::Crease { faces: 2 },
        FanKind::Crease { faces: 3 },
        FanKind::Crease { faces: 7 },
        FanKind::Corner { faces: 1 },
        FanKind::Corner { faces: 4 },
        FanKind::Dart { faces: 3 },
        FanKind::Dart { faces: 6 },
        FanKind::Dart { faces: 9 },
    ];

    fn fans() -> impl Iterator<Item = Fan> {
        let lattices = [Lattice::Triangles, Lattice::Quads];
        lattices.into_iter().flat_map(|lattice| KINDS.map(|kind| Fan::new(lattice, kind)))
    }

    /// Every half-edge within some edges of the centre, found by walking.
    fn edges(fan: &Fan, walks: usize) -> Vec<PatchEdge> {
        let mut found: Vec<PatchEdge> = fan.around_vertex(fan.spoke(0));
        for _ in 0..walks {
            let across = |edge: &PatchEdge| fan.around_vertex(fan.twin(*edge));
            let all: Vec<PatchEdge> = found.iter().flat_map(across).collect();
            all.into_iter().for_each(|edge| {
                if !found.contains(&edge) {
                    found.push(edge)
                }
            });
        }
        found
    }

    #[test]
    fn walking_keeps_the_laws_of_half_edges() {
        for fan in fans() {
            let corners = if fan.lattice() == Lattice::Triangles { 3 } else { 4 };
            for edge in edges(&fan, 3) {
                let here = format!("{fan:?} {edge:?}");
                assert_eq!(fan.twin(fan.twin(edge)), edge, "{here}");
                assert_eq!(fan.turn_back(fan.turn(edge)), edge, "{here}");
                assert_eq!(fan.prev(fan.next(edge)), edge, "{here}");
                assert!(fan.has_face(edge) || fan.has_face(fan.twin(edge)), "{here}");
                assert_eq!(fan.is_sharp(edge), fan.is_sharp(fan.twin(edge)), "{here}");
                if fan.has_face(edge) {
                    assert_eq!(fan.around_face(edge).len(), corners, "{here}");
                }
            }
        }
    }

    #[test]
    fn the_centre_has_its_faces_and_other_points_are_regular() {
        for fan in fans() {
            let closed = fan.kind().is_closed();
            let points: BTreeSet<Label> = edges(&fan, 2).iter().map(|edge| fan.origin(*edge)).collect();
            for point in points {
                let edge = *edges(&fan, 2).iter().find(|edge| fan.origin(**edge) == point).unwrap();
                let around = fan.around_vertex(edge);
                let faces = around.iter().filter(|edge| fan.has_face(**edge)).count();
                let (regular, half) = (fan.lattice().regular_valence(), fan.lattice().regular_valence() / 2);
                let sharp = fan.sharp_spokes(edge).len();
                let on_crease = point.j == 0 && (point.sector == 0 || !closed && point.sector == fan.sectors());
                let wanted = match (point == fan.centre(), closed, on_crease) {
                    (true, false, _) => (fan.sectors() as usize, 2),
                    (true, true, _) => (fan.sectors() as usize, 1),
                    (false, false, true) => (half, 2),
                    (false, true, true) => (regular, 2),
                    (false, _, false) => (regular, 0),
                };
                assert_eq!((faces, sharp), wanted, "{fan:?} {point:?}");
            }
            let next = fan.twin(fan.spoke(0));
            assert_eq!(fan.is_corner(fan.spoke(0)), matches!(fan.kind(), FanKind::Corner { .. }));
            assert!(!fan.is_corner(next));
        }
    }

    /// The mirror turns the walk around a vertex backwards.
    #[test]
    fn the_mirror_is_an_involution_that_keeps_edges() {
        for fan in fans() {
            let linked: BTreeSet<(Label, Label)> =
                edges(&fan, 3).iter().map(|edge| (fan.origin(*edge), fan.target(*edge))).collect();
            for edge in edges(&fan, 2) {
                let (a, b) = (fan.origin(edge), fan.target(edge));
                assert_eq!(fan.mirrored(fan.mirrored(a)), a, "{fan:?}");
                assert!(linked.contains(&(fan.mirrored(a), fan.mirrored(b))), "{fan:?} {a:?} {b:?}");
            }
            let far = if fan.kind().is_closed() { 0 } else { fan.sectors() };
            assert_eq!(fan.mirrored(fan.target(fan.spoke(0))), fan.point(far, 1, 0));
        }
    }

    /// Each label of the refined fan is born once, on its own kind of place: walking from the coarse edge to its midpoint and
    /// on along the same direction doubles coordinates.
    #[test]
    fn vertices_keep_their_place_on_the_finer_fan() {
        for fan in fans() {
            let split = if fan.lattice() == Lattice::Triangles { Split::OneToFour } else { Split::OneToN };
            let placement = Placement::of(split, fan.lattice(), true).unwrap();
            for edge in edges(&fan, 2) {
                let Label { sector, i, j } = fan.origin(edge);
                let doubled = Label { sector, i: 2 * i, j: 2 * j };
                let Site::Vertex(born) = fan.birth(&placement, doubled) else { panic!("{fan:?} {doubled:?}") };
                assert_eq!(fan.origin(born), fan.origin(edge));
                let midpoint = fan.target(PatchEdge { origin: doubled, direction: edge.direction });
                let Site::Edge(born) = fan.birth(&placement, midpoint) else { panic!("{fan:?} {midpoint:?}") };
                assert!(born == edge || fan.twin(born) == edge, "{fan:?} {edge:?} {born:?}");
            }
        }
    }
}
