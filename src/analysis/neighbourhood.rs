//! Which points around an extraordinary point control the limit surface there?
//!
//! The *full* neighbourhood: every point that influences the limit over the faces around the centre. A tile of the lattice
//! is influenced by whatever influences its children on the refined lattice; influence is propagated until it closes. Far from the centre
//! every tile has the same support, found once on the regular lattice; near the centre the scheme's own rows are followed,
//! at the valence asked for. The one-ring alone is invariant too, but misses eigenvalues that decide curvature (Loop, n = 3).

use crate::mesh::{Label, Lattice};
use crate::refine::{Obstacle, PatchRows, RegularStencils};
use std::collections::BTreeSet;

/// The most points that the support of a tile may have.
pub(super) const LARGEST_SUPPORT: usize = 4096;

/// An orbit of points under rotation: the label (i, j) without its sector; (0, 0) is the centre where that is a point.
pub type Orbit = (i32, i32);

/// A tile of the lattice: the unit square at (i, j), or one of the two triangles that it is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tile {
    pub(super) i: i32,
    pub(super) j: i32,
    /// The triangle away from (i, j).
    pub(super) down: bool,
}

impl Tile {
    /// The tiles that it is made of on the lattice `dilation` times as fine; where it lies at the centre, the one at the centre first.
    pub(super) fn children(self, lattice: Lattice, dilation: i32) -> Vec<Tile> {
        let (i, j) = (dilation * self.i, dilation * self.j);
        let tile = |(di, dj): (i32, i32), down: bool| Tile { i: i + di, j: j + dj, down };
        let square = (0..dilation).flat_map(|dj| (0..dilation).map(move |di| (di, dj)));
        if lattice != Lattice::Triangles {
            return square.map(|at| tile(at, false)).collect();
        }
        // the upright triangle is the half of the square below its diagonal
        let up = square.clone().filter(|(di, dj)| (di + dj < dilation) != self.down).map(|at| tile(at, false));
        let down = square.filter(|(di, dj)| (di + dj < dilation - 1) != self.down).map(|at| tile(at, true));
        up.chain(down).collect()
    }

    /// The points of the lattice in the closed tile; a dual tile has its one point in the middle.
    pub(super) fn points(self, lattice: Lattice) -> Vec<(i32, i32)> {
        let Tile { i, j, down } = self;
        match (lattice, down) {
            (Lattice::Dual, _) => vec![(i, j)],
            (Lattice::Quads, _) => vec![(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)],
            (Lattice::Triangles, false) => vec![(i, j), (i + 1, j), (i, j + 1)],
            (Lattice::Triangles, true) => vec![(i + 1, j), (i + 1, j + 1), (i, j + 1)],
        }
    }
}

/// What every valence has in common: the supports of regular tiles, propagated towards the centre as far as rows are
/// regular.
#[derive(Clone, Debug)]
pub struct Influence {
    /// For each level from fine to coarse, the orbits of that level whose rows may depend on the valence.
    near: Vec<BTreeSet<Orbit>>,
}

impl Influence {
    /// Propagates influence on the regular part of a lattice.
    ///
    /// # Errors
    /// When the stencils reach so far that the support passes a stated limit.
    pub fn of(stencils: &RegularStencils, lattice: Lattice) -> Result<Influence, Obstacle> {
        let supports = regular_supports(stencils, lattice)?;
        let extent = supports.iter().flatten().map(|(i, j)| i.abs().max(j.abs())).max().unwrap_or(0);
        let d = stencils.dilation();
        let far = stencils.clear_of_centre() + 2 * extent;
        let centre = Tile { i: 0, j: 0, down: false };
        let mut tiles: Vec<Tile> = centre.children(lattice, d)[1..].to_vec();
        let mut levels = 1;
        while tiles.iter().any(|tile| tile.i + tile.j < far) {
            tiles = tiles.iter().flat_map(|tile| tile.children(lattice, d)).collect();
            levels += 1;
        }
        let patch = crate::mesh::Patch::new(lattice, lattice.regular_valence());
        let canonical = |i: i32, j: i32| patch.point(0, i, j).orbit();
        let mut orbits = BTreeSet::new();
        for tile in &tiles {
            orbits.extend(supports[usize::from(tile.down)].iter().map(|(i, j)| canonical(tile.i + i, tile.j + j)));
        }
        let mut near = Vec::new();
        for _ in 0..levels {
            let (clear, unclear): (Vec<Orbit>, Vec<Orbit>) =
                orbits.iter().partition(|(i, j)| i + j >= stencils.clear_of_centre());
            near.push(unclear.into_iter().collect());
            orbits = clear
                .into_iter()
                .flat_map(|(i, j)| {
                    let (base_i, base_j) = stencils.base(i, j);
                    stencils.at(i, j).iter().map(move |((di, dj), _)| (base_i + di, base_j + dj))
                })
                .map(|(i, j)| canonical(i, j))
                .collect();
        }
        near.push(orbits);
        Ok(Influence { near })
    }

    /// The orbits of the full neighbourhood at a valence, in order: ring by ring, counter-clockwise within a sector; the
    /// centre, where it is a point, is left out.
    ///
    /// # Errors
    /// When a weight has no value.
    pub fn orbits(&self, rows: &PatchRows) -> Result<Vec<Orbit>, Obstacle> {
        let lattice = rows.patch.lattice;
        let Some((last, finer)) = self.near.split_last() else { return Ok(Vec::new()) };
        let mut orbits = BTreeSet::new();
        for near in finer {
            orbits.extend(near);
            orbits = sources(rows, &orbits)?;
        }
        orbits.extend(last);
        orbits.insert((0, 0));
        let mut closed = closure(rows, orbits)?;
        // a weight may be 0 on one side and rounding noise on the other: keep what the mirror sees
        let centre = |orbit: &Orbit| lattice.has_centre() && *orbit == (0, 0);
        let images: Vec<Orbit> = closed.iter().filter(|o| !centre(o)).map(|o| lattice.mirror(*o).0).collect();
        closed.extend(images);
        let closed = closure(rows, closed)?;
        let mut orbits: Vec<Orbit> =
            closed.into_iter().filter(|orbit| !lattice.has_centre() || *orbit != (0, 0)).collect();
        orbits.sort_by(|a, b| order(lattice, *a, *b));
        Ok(orbits)
    }
}

/// Ring by ring, and counter-clockwise within a ring.
pub(super) fn order(lattice: Lattice, a: Orbit, b: Orbit) -> std::cmp::Ordering {
    let ring = |(i, j): Orbit| lattice.ring(i, j);
    // counter-clockwise: the cross product of a and b, from the middle of the face where that is the centre
    let double = |(i, j): Orbit| if lattice.has_centre() { (2 * i, 2 * j) } else { (2 * i + 1, 2 * j + 1) };
    let ((ai, aj), (bi, bj)) = (double(a), double(b));
    ring(a).cmp(&ring(b)).then((aj * bi).cmp(&(bj * ai)))
}

/// The smallest set of orbits that contains these and whatever its points are made of.
///
/// # Errors
/// When a weight has no value.
pub fn closure(rows: &PatchRows, orbits: BTreeSet<Orbit>) -> Result<BTreeSet<Orbit>, Obstacle> {
    let mut closed = orbits.clone();
    let mut new = orbits;
    while !new.is_empty() {
        new = sources(rows, &new)?.difference(&closed).copied().collect();
        closed.extend(&new);
    }
    Ok(closed)
}

/// The orbits of the points that points of these orbits are made of.
fn sources(rows: &PatchRows, orbits: &BTreeSet<Orbit>) -> Result<BTreeSet<Orbit>, Obstacle> {
    let mut sources = BTreeSet::new();
    for (i, j) in orbits {
        rows.visit(Label { sector: 0, i: *i, j: *j }, |old, _| {
            sources.insert(old.orbit());
        })?;
    }
    Ok(sources)
}

/// The points that influence the limit over the tile at the origin of a regular lattice, upright and down.
pub(super) fn regular_supports(
    stencils: &RegularStencils,
    lattice: Lattice,
) -> Result<[BTreeSet<(i32, i32)>; 2], Obstacle> {
    let tile = |down: bool| Tile { i: 0, j: 0, down };
    let mut supports = [false, true].map(|down| tile(down).points(lattice).into_iter().collect::<BTreeSet<_>>());
    loop {
        let mut grown = supports.clone();
        for down in [false, true] {
            for child in tile(down).children(lattice, stencils.dilation()) {
                for (i, j) in &supports[usize::from(child.down)] {
                    let (i, j) = (child.i + i, child.j + j);
                    let (base_i, base_j) = stencils.base(i, j);
                    let sources = stencils.at(i, j).iter().map(|((di, dj), _)| (base_i + di, base_j + dj));
                    grown[usize::from(down)].extend(sources);
                }
            }
        }
        if grown.iter().any(|support| support.len() > LARGEST_SUPPORT) {
            return Err(Obstacle::Limit(format!("the stencils reach too far: more than {LARGEST_SUPPORT} points")));
        }
        if grown == supports {
            return Ok(supports);
        }
        supports = grown;
    }
}
