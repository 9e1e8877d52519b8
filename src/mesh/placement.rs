//! Where on the coarse lattice is each point of the refined lattice born?
//!
//! A split puts the refined lattice onto the coarse one by a linear map about the centre, P = A P'/m: as it stands, or turned by half
//! a sector (sqrt3, mid-edge and sqrt2 splits). Where a point lands, at a vertex, the middle of an edge, the middle of a face, or near the corner of a
//! face, tells its birth. Turning splits turn left and right in turns, so that the lattice comes back to itself.

use super::{Label, Lattice, PatchEdge, Site, Split};

/// Parts that an edge is counted in: whole for halves, quarters and thirds.
const UNIT: i32 = 12;

/// Which way a split turns the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Turn {
    /// Not at all.
    None,
    /// By half a sector counter-clockwise.
    Left,
    /// By half a sector clockwise.
    Right,
}

/// How one split puts the refined lattice onto the coarse one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placement {
    /// The split.
    pub split: Split,
    /// The coarse lattice.
    pub from: Lattice,
    /// The refined one.
    pub to: Lattice,
    /// The rows of the map A, in twelfths of m.
    map: [[i32; 2]; 2],
    /// Which way it turns.
    pub turn: Turn,
    /// Whether the coarse lattice stands turned by half a sector.
    pub from_turned: bool,
}

impl Placement {
    /// How a split acts on a lattice: a turning one turns left, and back to the right where the lattice stands turned. `None` where the split
    /// can't be applied, or makes no regular lattice.
    pub fn of(split: Split, from: Lattice, from_turned: bool) -> Option<Placement> {
        let quads = from != Lattice::Triangles;
        let turn = if from_turned { Turn::Right } else { Turn::Left };
        let (to, m, turn) = match split {
            Split::OneToFour if !quads => (from, 2, Turn::None),
            Split::Keep => (from, 1, Turn::None),
            Split::Sqrt3 if !quads => (from, 3, turn),
            Split::OneToN if quads => (Lattice::Quads, 2, Turn::None),
            Split::Dual if quads => (Lattice::Dual, 2, Turn::None),
            Split::FacesToVertices if from == Lattice::Quads => (Lattice::Dual, 1, Turn::None),
            Split::FacesToVertices if from == Lattice::Dual => (Lattice::Quads, 1, Turn::None),
            Split::MidEdge if quads => (Lattice::Dual, 2, turn),
            Split::Sqrt2 if quads => (Lattice::Quads, 2, turn),
            _ => return None,
        };
        let turned = match (turn, quads) {
            (Turn::None, _) => [[1, 0], [0, 1]],
            (Turn::Left, true) => [[1, -1], [1, 1]],
            (Turn::Right, true) => [[1, 1], [-1, 1]],
            (Turn::Left, false) => [[1, -1], [1, 2]],
            (Turn::Right, false) => [[2, 1], [-1, 1]],
        };
        Some(Placement { split, from, to, map: turned.map(|row| row.map(|a| a * UNIT / m)), turn, from_turned })
    }

    /// The same turned the other way.
    #[must_use]
    pub fn mirrored(&self) -> Placement {
        let other = Placement::of(self.split, self.from, self.turn == Turn::Left).unwrap_or(*self);
        Placement { from_turned: self.from_turned, ..other }
    }

    /// The refined lattice's steps over the coarse one's, squared, and whether anything is refined: 4 for a split that halves edges, 3
    /// for sqrt3, 2 for mid-edge, 1 where points are as dense as before.
    pub fn density(&self) -> i32 {
        let [[a, b], [c, d]] = self.map;
        UNIT * UNIT / (a * d - b * c)
    }

    /// The birth of a point of the refined lattice: the site, in a sector that lies some sectors on. A half-edge that leaves the centre is told
    /// as that of the sector's spoke.
    pub(super) fn birth(&self, label: Label) -> (i32, Site) {
        let half = i32::from(!self.to.has_centre());
        // twice the refined coordinates, to be whole on the dual lattice
        let (u, v) = (2 * label.i + half, 2 * label.j + half);
        let [x, y] = self.map.map(|[a, b]| (a * u + b * v) / 2);
        let (shift, x, y) = unfold(self.from, x, y);
        let (more, site) = site(self.from, label.sector, x, y);
        (shift + more, site)
    }
}

/// A place in a sector's coordinates, in twelfths of an edge, brought to the sector that it lies in.
fn unfold(lattice: Lattice, mut x: i32, mut y: i32) -> (i32, i32, i32) {
    let mut shift = 0;
    loop {
        match lattice {
            _ if x == 0 && y == 0 => return (0, 0, 0),
            Lattice::Triangles if y < 0 => (x, y, shift) = (-y, x + y, shift - 1),
            Lattice::Triangles if x <= 0 => (x, y, shift) = (x + y, -x, shift + 1),
            Lattice::Quads | Lattice::Dual if y < 0 => (x, y, shift) = (-y, x, shift - 1),
            Lattice::Quads | Lattice::Dual if x <= 0 => (x, y, shift) = (y, -x, shift + 1),
            _ => return (shift, x, y),
        }
    }
}

/// What lies at a place of the coarse lattice, and how many sectors on.
fn site(lattice: Lattice, sector: u32, x: i32, y: i32) -> (i32, Site) {
    let offset = if lattice.has_centre() { 0 } else { UNIT / 2 };
    let (x, y) = (x - offset, y - offset);
    let (i, j) = (x.div_euclid(UNIT), y.div_euclid(UNIT));
    let from = |i: i32, j: i32, direction: u32| PatchEdge { origin: Label { sector, i, j }, direction };
    const HALF: i32 = UNIT / 2;
    let site = match (lattice, x.rem_euclid(UNIT), y.rem_euclid(UNIT)) {
        (_, 0, 0) => Site::Vertex(from(i, j, 0)),
        (Lattice::Triangles, HALF, 0) => Site::Edge(from(i + 1, j, 3)),
        (Lattice::Triangles, 0, HALF) => Site::Edge(from(i, j + 1, 4)),
        (Lattice::Triangles, HALF, HALF) => Site::Edge(from(i + 1, j, 2)),
        (Lattice::Triangles, x, _) if x < HALF => Site::Face(from(i + 1, j, 2)),
        (Lattice::Triangles, ..) => Site::Face(from(i + 1, j, 1)),
        (_, HALF, 0) => Site::Edge(from(i + 1, j, 2)),
        (_, 0, HALF) => Site::Edge(from(i, j + 1, 3)),
        (_, HALF, HALF) => Site::Face(from(i + 1, j + 1, 2)),
        // the quarter of a face that lies at one of its corners
        (_, x, y) => {
            let (right, up) = (x < HALF, y < HALF);
            let direction = match (right, up) {
                (true, true) => 0,
                (false, true) => 1,
                (false, false) => 2,
                (true, false) => 3,
            };
            let (i, j) = (i + i32::from(!right), j + i32::from(!up));
            if lattice.has_centre() && i == 0 && j > 0 {
                // on the next spoke, a quarter turn on
                return (1, Site::Corner(from(j, 0, (direction + 3) % 4)));
            }
            Site::Corner(from(i, j, direction))
        }
    };
    (0, site)
}

/// The placements of a step's splits, and of as many steps as bring the lattice back to itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cycle {
    /// One for each split, step after step.
    pub placements: Vec<Placement>,
    /// The number of steps.
    pub steps: usize,
    /// By which factor the lattice shrinks in all of them.
    pub dilation: i32,
}

/// More steps than this are not tried: every lattice here is back after two.
const MOST_STEPS: usize = 4;

impl Cycle {
    /// Finds it for a step of these splits, on triangles or on quads; `None` where the lattice doesn't come back, or is not refined.
    pub fn of(splits: &[Split], triangles: bool) -> Option<Cycle> {
        let starts: &[Lattice] = if triangles { &[Lattice::Triangles] } else { &[Lattice::Quads, Lattice::Dual] };
        (1..=MOST_STEPS).find_map(|steps| starts.iter().find_map(|start| Cycle::from(splits, *start, steps)))
    }

    /// Whether the boundary of a mesh is refined by rules of its own, and stands as it did after all steps: under splits that keep its edges or halve
    /// them, and those that turn the lattice and cut its edges in the second step.
    pub fn keeps_boundary(&self) -> bool {
        let keeps = |Placement { split, from_turned, .. }: &Placement| match split {
            Split::OneToFour | Split::OneToN => !from_turned,
            split => !split.recedes(),
        };
        self.placements.iter().all(keeps)
    }

    /// Whether edges are halved or stay in every step, so that there can be creases inside a mesh.
    pub fn keeps_edges(&self) -> bool {
        self.placements.iter().all(|placement| placement.split.keeps_edges())
    }

    fn from(splits: &[Split], start: Lattice, steps: usize) -> Option<Cycle> {
        let (mut lattice, mut turned, mut density) = (start, false, 1);
        let mut placements = Vec::new();
        for split in splits.iter().cycle().take(splits.len() * steps) {
            let placement = Placement::of(*split, lattice, turned)?;
            turned ^= placement.turn != Turn::None;
            lattice = placement.to;
            density *= placement.density();
            placements.push(placement);
        }
        let dilation = (2..=MOST_DILATION).find(|dilation| dilation * dilation == density)?;
        (lattice == start && !turned).then_some(Cycle { placements, steps, dilation })
    }

    /// The lattice that it starts from and comes back to.
    pub fn lattice(&self) -> Lattice {
        self.placements[0].from
    }
}

/// The largest dilation that is looked for.
const MOST_DILATION: i32 = 16;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Connectivity, Patch};
    use std::collections::BTreeSet;

    /// Every split on every lattice that it goes with.
    fn placements() -> Vec<Placement> {
        let mut all = Vec::new();
        for (_, split) in Split::NAMED {
            for from in [Lattice::Triangles, Lattice::Quads, Lattice::Dual] {
                all.extend([true, false].into_iter().filter_map(|left| Placement::of(split, from, left)));
            }
        }
        assert!(all.len() >= 15);
        all
    }

    /// The vertices around a site, sorted.
    fn around(patch: &Patch, site: Site) -> Vec<Label> {
        let mut points = match site {
            Site::Vertex(edge) => vec![patch.origin(edge)],
            Site::Edge(edge) => vec![patch.origin(edge), patch.target(edge)],
            Site::Face(edge) => patch.around_face(edge).iter().map(|edge| patch.origin(*edge)).collect(),
            Site::Corner(edge) => {
                let mut face: Vec<Label> = patch.around_face(edge).iter().map(|edge| patch.origin(*edge)).collect();
                face.sort_unstable();
                face.push(patch.origin(edge));
                return face;
            }
            Site::Kept(_) | Site::Third(_) => panic!("a patch has no boundary"),
        };
        points.sort_unstable();
        points
    }

    #[test]
    fn every_point_has_a_birth_of_its_own() {
        for placement in placements() {
            for n in [3, 4, 5, 6, 7] {
                let fine = Patch::new(placement.to, n);
                let coarse = Patch::new(placement.from, n);
                let first = i32::from(placement.to.has_centre());
                let labels = (0..n as u32)
                    .flat_map(|sector| (first..9).flat_map(move |i| (0..9).map(move |j| Label { sector, i, j })));
                let labels: Vec<Label> = fine.centre().into_iter().chain(labels).collect();
                let births: BTreeSet<Vec<Label>> =
                    labels.iter().map(|label| around(&coarse, coarse.birth(&placement, *label))).collect();
                assert_eq!(births.len(), labels.len(), "{placement:?}, n = {n}");
            }
        }
    }

    #[test]
    fn births_turn_with_the_patch_and_have_mirror_images() {
        for placement in placements() {
            let (fine, coarse) = (Patch::new(placement.to, 5), Patch::new(placement.from, 5));
            for (i, j) in (1..7).flat_map(|i| (0..7).map(move |j| (i, j))) {
                let label = Label { sector: 2, i, j };
                let born = around(&coarse, coarse.birth(&placement, label));
                let next = around(&coarse, coarse.birth(&placement, fine.rotated(label, 1)));
                let mut turned: Vec<Label> = born.iter().map(|point| coarse.rotated(*point, 1)).collect();
                if !matches!(coarse.birth(&placement, label), Site::Corner(_)) {
                    turned.sort_unstable();
                    assert_eq!(turned, next, "{placement:?} {label:?}");
                }
            }
        }
    }

    #[test]
    fn cycles_are_those_of_the_literature() {
        let found = |splits: &[Split], triangles| {
            Cycle::of(splits, triangles).map(|cycle| (cycle.lattice(), cycle.steps, cycle.dilation))
        };
        assert_eq!(found(&[Split::OneToFour], true), Some((Lattice::Triangles, 1, 2)));
        assert_eq!(found(&[Split::Sqrt3], true), Some((Lattice::Triangles, 2, 3)));
        assert_eq!(found(&[Split::OneToN], false), Some((Lattice::Quads, 1, 2)));
        assert_eq!(found(&[Split::Dual], false), Some((Lattice::Dual, 1, 2)));
        assert_eq!(found(&[Split::MidEdge], false), Some((Lattice::Dual, 2, 2)));
        assert_eq!(found(&[Split::Sqrt2], false), Some((Lattice::Quads, 2, 2)));
        let averages = |d: usize| [vec![Split::OneToN], vec![Split::FacesToVertices; d - 1]].concat();
        assert_eq!(found(&averages(2), false), Some((Lattice::Dual, 1, 2)));
        assert_eq!(found(&averages(3), false), Some((Lattice::Quads, 1, 2)));
        assert_eq!(found(&[Split::FacesToVertices], false), None);
        assert_eq!(found(&[Split::Keep], true), None);
    }
}
