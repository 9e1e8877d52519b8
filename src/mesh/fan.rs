//! What does a mesh look like around one vertex on a boundary or a crease?
//!
//! The canonical fan: like [`Patch`](super::Patch) without end, regular but for the centre, and computed, not stored. At a
//! *crease* vertex and at a *corner* it is a half-disc of k sectors whose boundary runs straight along the spokes 0 and k;
//! labels are those of the patch, and of sector k only the points (i, 0) of the last spoke are there. A boundary is a crease
//! with nothing beyond it: a vertex on a crease inside a mesh has such a half-disc on either side. At a *dart* it is the whole disc of
//! n sectors, and a crease runs along spoke 0 and ends at the centre.
//!
//! Splits that turn the lattice leave a *turned* half-disc in between: its boundary runs along the diagonals i = j of the sectors 0 and k, of which
//! only the halves between them are there. It bisects the faces there, and its edges lead from (m, m) to (m + 1, m + 1).

use super::{Canonical, Connectivity, Label, Lattice, PatchEdge, Placement, Site, Split, Turn};

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
    /// The kinds with these numbers of faces, as far as there are such: creases, corners, and darts where creases can run inside a mesh.
    pub fn each(faces: &[usize], creases_inside: bool) -> Vec<FanKind> {
        let mut kinds: Vec<FanKind> = faces.iter().map(|faces| FanKind::Crease { faces: *faces }).collect();
        kinds.extend(faces.iter().map(|faces| FanKind::Corner { faces: *faces }));
        if creases_inside {
            kinds.extend(faces.iter().map(|faces| FanKind::Dart { faces: *faces }));
        }
        kinds.retain(|kind| kind.faces() >= kind.least_faces());
        kinds
    }

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
    /// Whether the lattice stands turned by half a sector.
    turned: bool,
}

impl Fan {
    /// The fan of a kind on a lattice whose centre is a vertex; too few faces are raised to the least number that there can
    /// be, and the dual lattice is taken for the quads that it is made of.
    pub fn new(lattice: Lattice, kind: FanKind) -> Fan {
        let lattice = if lattice.has_centre() { lattice } else { Lattice::Quads };
        let least = kind.least_faces() as u32;
        let sectors = u32::try_from(kind.faces()).unwrap_or(u32::MAX >> 1).clamp(least, u32::MAX >> 1);
        Fan { lattice, kind, sectors, turned: false }
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
        self.sectors + u32::from(!self.kind.is_closed()) + u32::from(self.turned)
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

    /// A sector some sectors on; on a turned fan k + 1 stands for all beyond the last.
    fn shifted(&self, sector: u32, shift: i32) -> u32 {
        let (sector, sectors) = (i64::from(sector) + i64::from(shift), i64::from(self.sectors));
        let last = sectors + i64::from(self.turned);
        (if self.kind.is_closed() { sector.rem_euclid(sectors) } else { sector.clamp(0, last) }) as u32
    }

    /// The point's mirror image under the reflection that exchanges spokes 0 and k; at a dart that which fixes spoke 0. Not for turned fans.
    pub fn mirrored(&self, label: Label) -> Label {
        if self.lattice.is_centre(label) {
            return label;
        }
        let ((i, j), shift) = self.lattice.mirror(label.orbit());
        Label { sector: self.shifted(self.sectors, -(label.sector as i32) - shift), i, j }
    }

    /// Where a split puts the point `label` of the refined fan. On the boundary, a split that turns the lattice leaves points where they are; the
    /// one that turns it back puts a new point on an edge, or two at its thirds, in place of those of the faces that the boundary bisects.
    pub fn birth(&self, placement: &Placement, label: Label) -> Site {
        // turned the other way: so the sectors of a turned fan are counted from 0
        let (shift, site) = placement.mirrored().birth(label);
        let site = site.mapped(|edge| {
            let Label { sector, i, j } = edge.origin;
            let sector = self.shifted(sector, shift);
            if i == 0 && j == 0 { self.spoke(0) } else { PatchEdge { origin: Label { sector, i, j }, ..edge } }
        });
        match site {
            Site::Vertex(PatchEdge { origin, .. }) => {
                let direction = self.leaving(origin).next().unwrap_or(0);
                let edge = PatchEdge { origin, direction };
                let kept = placement.turn == Turn::Left && self.on_boundary(origin);
                if kept { Site::Kept(edge) } else { Site::Vertex(edge) }
            }
            Site::Face(edge) if self.turned => self.birth_in_face(placement.split, edge),
            site => site,
        }
    }

    /// Where a split of a turned fan puts the point of a face, which the boundary may bisect. Of the two triangles between (m, m) and
    /// (m + 1, m + 1), the one at (m, m) is told by the half-edge from (m + 1, m) to (m, m + 1).
    fn birth_in_face(&self, split: Split, edge: PatchEdge) -> Site {
        let Label { sector, i, j } = edge.origin;
        let m = match self.lattice {
            Lattice::Triangles => i - 1,
            _ => i.min(j) - 1,
        };
        let diagonal = match self.lattice {
            Lattice::Triangles => j == m,
            _ => i == j,
        };
        if !diagonal || (sector != 0 && sector != self.sectors) {
            return Site::Face(edge);
        }
        let [near, far] = [self.along_boundary(sector, m), self.twin(self.along_boundary(sector, m))];
        match split {
            Split::Sqrt3 => Site::Third(if edge.direction == 2 { near } else { far }),
            _ => Site::Edge(near),
        }
    }

    /// The half-edge of a turned fan from (m, m) to (m + 1, m + 1) of its first or last sector.
    fn along_boundary(&self, sector: u32, m: i32) -> PatchEdge {
        let (first, all) = (sector == 0, self.lattice.steps().len() as u32);
        match m {
            0 => self.spoke(if first { 0 } else { self.sectors + 1 }),
            _ => PatchEdge { origin: Label { sector, i: m, j: m }, direction: all },
        }
    }

    /// The half-edge that leaves the centre along a spoke.
    pub fn spoke(&self, spoke: u32) -> PatchEdge {
        PatchEdge { origin: self.centre(), direction: spoke }
    }

    /// Whether a point lies on the boundary; at a dart there is none.
    fn on_boundary(&self, origin: Label) -> bool {
        let Label { sector, i, j } = origin;
        let along = if self.turned { i == j } else { j == 0 };
        !self.kind.is_closed() && (self.lattice.is_centre(origin) || along && (sector == 0 || sector == self.sectors))
    }

    /// Whether a point of the lattice is there on a turned fan.
    fn holds(&self, label: Label) -> bool {
        let Label { sector, i, j } = label;
        let (before, beyond) = (sector == 0 && j < i, sector == self.sectors && j > i || sector > self.sectors);
        self.lattice.is_centre(label) || !before && !beyond
    }

    /// The directions of the half-edges that leave a point, counter-clockwise; at the boundary from the first that has a face to its left. On a turned
    /// fan the directions after those of the lattice lead along the boundary, away from the centre and towards it.
    fn leaving(&self, origin: Label) -> impl Iterator<Item = u32> + Clone {
        let (fan, all) = (*self, self.lattice.steps().len() as u32);
        let half = all / 2;
        let (first, between, last) = match (self.lattice.is_centre(origin), self.on_boundary(origin), self.turned) {
            (true, ..) => (None, 0..self.spokes(), None),
            (_, false, _) => (None, 0..all, None),
            (_, true, false) if origin.sector == 0 => (None, 0..half + 1, None),
            (_, true, false) => (None, half..all + 1, None),
            (_, true, true) if origin.sector == 0 => (Some(all), 1..half + 1, Some(all + 1)),
            (_, true, true) => (Some(all + 1), half + 1..all + 1, Some(all)),
        };
        let centre = self.lattice.is_centre(origin);
        let there = move |direction: &u32| {
            let (di, dj) = fan.lattice.steps()[*direction as usize % all as usize];
            centre || !fan.turned || fan.holds(fan.point(origin.sector, origin.i + di, origin.j + dj))
        };
        let between = between.map(move |direction| if centre { direction } else { direction % all }).filter(there);
        first.into_iter().chain(between).chain(last)
    }

    /// The other half of an edge along the boundary of a turned fan.
    fn twin_along_boundary(&self, PatchEdge { origin, direction }: PatchEdge) -> Option<PatchEdge> {
        let Label { sector, i, j } = origin;
        let back = self.lattice.steps().len() as u32 + 1;
        let ends = |sector: u32, m: i32| PatchEdge { origin: Label { sector, i: m, j: m }, direction: back };
        match self.lattice.is_centre(origin) {
            true if direction == 0 => Some(ends(0, 1)),
            true if direction == self.sectors + 1 => Some(ends(self.sectors, 1)),
            false if direction + 1 == back => Some(ends(sector, i + 1)),
            false if direction == back => Some(self.along_boundary(sector, j - 1)),
            _ => None,
        }
    }
}

impl Canonical for Fan {
    fn point(&self, sector: u32, i: i32, j: i32) -> Label {
        Fan::point(self, sector, i, j)
    }

    fn birth(&self, placement: &Placement, label: Label) -> Site {
        Fan::birth(self, placement, label)
    }

    fn before(&self, placement: &Placement) -> Self {
        Fan { lattice: placement.from, turned: placement.from_turned, ..*self }
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
        let along = if self.turned { self.twin_along_boundary(edge) } else { None };
        along.unwrap_or_else(|| self.lattice.twin(edge, |sector, shift| self.shifted(sector, shift)))
    }

    fn turn(&self, edge: PatchEdge) -> PatchEdge {
        let mut all = self.leaving(edge.origin);
        let next = all.clone().skip_while(|own| *own != edge.direction).nth(1);
        PatchEdge { direction: next.or_else(|| all.next()).unwrap_or(edge.direction), ..edge }
    }

    fn turn_back(&self, edge: PatchEdge) -> PatchEdge {
        let all = self.leaving(edge.origin);
        let previous = all.clone().take_while(|own| *own != edge.direction).last();
        PatchEdge { direction: previous.or_else(|| all.last()).unwrap_or(edge.direction), ..edge }
    }

    fn origin(&self, edge: PatchEdge) -> Label {
        edge.origin
    }

    fn has_face(&self, edge: PatchEdge) -> bool {
        !self.on_boundary(edge.origin) || self.leaving(edge.origin).last() != Some(edge.direction)
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

    fn keeps_the_laws(fan: &Fan, edge: PatchEdge) {
        let here = format!("{fan:?} {edge:?}");
        assert_eq!(fan.twin(fan.twin(edge)), edge, "{here}");
        assert_eq!(fan.turn_back(fan.turn(edge)), edge, "{here}");
        assert_eq!(fan.prev(fan.next(edge)), edge, "{here}");
        assert!(fan.has_face(edge) || fan.has_face(fan.twin(edge)), "{here}");
    }

    #[test]
    fn walking_keeps_the_laws_of_half_edges() {
        for fan in fans() {
            let corners = if fan.lattice() == Lattice::Triangles { 3 } else { 4 };
            for edge in edges(&fan, 3) {
                let here = format!("{fan:?} {edge:?}");
                keeps_the_laws(&fan, edge);
                assert_eq!(fan.is_sharp(edge), fan.is_sharp(fan.twin(edge)), "{here}");
                if fan.has_face(edge) {
                    assert_eq!(fan.around_face(edge).len(), corners, "{here}");
                }
            }
        }
    }

    /// Turned half-discs, with as many faces more as the boundary bisects.
    fn turned_fans() -> impl Iterator<Item = Fan> {
        let splits = [(Lattice::Triangles, Split::Sqrt3), (Lattice::Quads, Split::Sqrt2)];
        splits.into_iter().flat_map(|(lattice, split)| {
            let placement = Placement::of(split, lattice, true).unwrap();
            let open = KINDS.into_iter().filter(|kind| !kind.is_closed());
            open.map(move |kind| Fan::new(lattice, kind).before(&placement))
        })
    }

    /// Faces at the boundary are triangles, others those of the lattice; the centre has one more than the fan that isn't turned.
    #[test]
    fn walking_keeps_the_laws_of_half_edges_on_turned_fans() {
        for fan in turned_fans() {
            let (mut bisected, mut inside) = (0, 0);
            for edge in edges(&fan, 3) {
                let here = format!("{fan:?} {edge:?}");
                keeps_the_laws(&fan, edge);
                if fan.has_face(edge) {
                    let face = fan.around_face(edge);
                    let at_boundary = face.iter().any(|edge| !fan.has_face(fan.twin(*edge)));
                    assert_eq!(face.len(), if at_boundary { 3 } else { fan.lattice().face_corners() }, "{here}");
                    (bisected, inside) = (bisected + usize::from(at_boundary), inside + usize::from(!at_boundary));
                }
            }
            assert!(bisected > 0 && (inside > 0 || fan.sectors() == 1), "{fan:?}");
            let around = fan.around_vertex(fan.spoke(0));
            assert_eq!(around.iter().filter(|edge| fan.has_face(**edge)).count() as u32, fan.sectors() + 1);
            assert_eq!(fan.sharp_spokes(fan.spoke(0)).len(), 2, "{fan:?}");
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
            let placement = Placement::of(split, fan.lattice(), false).unwrap();
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
