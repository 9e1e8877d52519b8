//! Which points around a vertex on a crease control the limit surface there?
//!
//! The full neighbourhood, as in [`super::super::neighbourhood`]: every point that influences the limit over the faces around
//! the centre. Three kinds of tile have a support of a form: those in the regular part; those beside a straight crease far from the
//! centre, whose supports are the same all along it; and those near the centre. The first two are found once, by the same
//! recursion over children. Near the centre, let P be the points of level l on the faces around the centre. What lies outside of P and
//! influences the limit over these faces is, on a level so fine that the tiles at the rim have known supports, what those
//! supports have outside; on a coarser one, what outside points and those near the rim are made of.

use super::super::neighbourhood::{LARGEST_SUPPORT, Tile, order, regular_supports};
use crate::mesh::{Fan, FanKind, Label, Lattice};
use crate::refine::{FanRows, Obstacle, Refinement, RegularStencils};
use std::collections::{BTreeSet, HashMap};

/// The place along a crease that rows are read off, far from the centre.
const FAR: i32 = 64;

/// A set of points by their coordinates.
type Support = BTreeSet<(i32, i32)>;

/// What the fans of a scheme have in common: the supports of tiles far from the centre.
#[derive(Clone, Debug)]
pub struct FanInfluence {
    lattice: Lattice,
    dilation: i32,
    reach: i32,
    /// The largest coordinate of a regular support, relative to its tile.
    extent: i32,
    /// The supports of a regular tile, upright and down.
    regular: [Support; 2],
    /// Those of the tiles at the heights 0, 1, ... over a crease: i relative to the tile, j from the crease.
    beside: Vec<[Support; 2]>,
    /// The number of levels after which the rim is far from the centre.
    levels: u32,
}

impl FanInfluence {
    /// Finds the supports.
    ///
    /// # Errors
    /// When a weight has no value, a rule reaches over the boundary, or supports pass a stated limit of size.
    pub fn of(
        refinement: &Refinement<f64>,
        stencils: &RegularStencils,
        lattice: Lattice,
    ) -> Result<FanInfluence, Obstacle> {
        let regular = regular_supports(stencils, lattice)?;
        let extent = regular.iter().flatten().map(|(i, j)| i.abs().max(j.abs())).max().unwrap_or(0);
        let heights = extent + stencils.clear_of_crease();
        let far = (2 * heights).max(2 * extent + stencils.clear_of_centre()) + rim_width(extent);
        let dilation = stencils.dilation();
        let levels = (0..).find(|level| dilation.pow(*level) >= far).unwrap_or(0);
        let beside = HalfPlane::new(refinement, stencils, lattice).supports(&regular, heights)?;
        Ok(FanInfluence { lattice, dilation, reach: stencils.reach(), extent, regular, beside, levels })
    }

    /// The points of the full neighbourhood of a fan: the centre, then ring by ring, counter-clockwise from spoke 0.
    ///
    /// # Errors
    /// When a weight has no value, or a rule reaches over the boundary.
    pub fn labels(&self, rows: &FanRows) -> Result<Vec<Label>, Obstacle> {
        let mut outside = self.outside_at_the_finest(rows.patch);
        for level in (1..=self.levels).rev() {
            let mut fine = self.rim(rows.patch, level);
            fine.append(&mut outside);
            outside = sources(rows, &fine)?;
            outside.retain(|label| self.ring(*label) > self.dilation.pow(level - 1));
        }
        outside.extend(inside(rows.patch, 0, 1));
        let mut closed = closure(rows, outside)?;
        // a weight may be 0 on one side and rounding noise on the other: keep what the mirror sees
        closed.extend(closed.iter().map(|label| rows.patch.mirrored(*label)).collect::<Vec<_>>());
        let mut labels: Vec<Label> = closure(rows, closed)?.into_iter().collect();
        let key = |label: &Label| (self.ring(*label), label.sector);
        labels.sort_by(|a, b| key(a).cmp(&key(b)).then(order(self.lattice, a.orbit(), b.orbit())));
        Ok(labels)
    }

    fn ring(&self, label: Label) -> i32 {
        self.lattice.ring(label.i, label.j)
    }

    /// The points of a level on the faces around the centre that may be made of points outside of these.
    fn rim(&self, fan: Fan, level: u32) -> BTreeSet<Label> {
        let (last, width) = (self.dilation.pow(level), 2 * self.dilation * self.reach);
        let first = if last <= 2 * width { 0 } else { last - width };
        inside(fan, first, last)
    }

    /// What the tiles at the rim of the finest level have outside of the faces around the centre.
    fn outside_at_the_finest(&self, fan: Fan) -> BTreeSet<Label> {
        let last = self.dilation.pow(self.levels);
        let mut outside = BTreeSet::new();
        for sector in 0..fan.sectors() {
            for tile in rim_tiles(self.lattice, last, rim_width(self.extent)) {
                outside.extend(self.support(fan, sector, tile).into_iter().filter(|label| self.ring(*label) > last));
            }
        }
        outside
    }

    /// The support of a tile of a sector that is far from the centre.
    fn support(&self, fan: Fan, sector: u32, tile: Tile) -> Vec<Label> {
        let Tile { i, j, down } = tile;
        let beside = |i: i32, j: i32| {
            let own = self.beside[j as usize][usize::from(down)].iter();
            own.map(move |(x, y)| fan.point(0, i + x, *y))
        };
        let heights = self.beside.len() as i32;
        if sector == 0 && j < heights {
            beside(i, j).collect()
        } else if sector + 1 == fan.sectors() && i < heights {
            beside(j, i).map(|label| fan.mirrored(label)).collect()
        } else {
            let own = self.regular[usize::from(down)].iter();
            own.map(|(x, y)| fan.point(sector, i + x, j + y)).collect()
        }
    }
}

/// The number of rings of tiles whose supports reach outside.
fn rim_width(extent: i32) -> i32 {
    2 * extent + 1
}

/// The tiles of a sector within the ring `last`, but at most `width` rings from it.
fn rim_tiles(lattice: Lattice, last: i32, width: i32) -> Vec<Tile> {
    let kinds: &[bool] = if lattice == Lattice::Triangles { &[false, true] } else { &[false] };
    let tiles = (0..last).flat_map(|i| (0..last).map(move |j| (i, j)));
    let tiles = tiles.flat_map(|(i, j)| kinds.iter().map(move |down| Tile { i, j, down: *down }));
    let reaches = |tile: &Tile| tile.points(lattice).iter().map(|(i, j)| lattice.ring(*i, *j)).max().unwrap_or(0);
    tiles.filter(|tile| (last - width..=last).contains(&reaches(tile))).collect()
}

/// The points of a fan from one ring to another.
fn inside(fan: Fan, first: i32, last: i32) -> BTreeSet<Label> {
    let ring = |i: i32, j: i32| fan.lattice().ring(i, j);
    let orbits = (1..=last).flat_map(|i| (0..=last).map(move |j| (i, j)));
    let orbits: Vec<(i32, i32)> = orbits.filter(|(i, j)| (first..=last).contains(&ring(*i, *j))).collect();
    let sector = |sector: u32| orbits.iter().map(move |(i, j)| Label { sector, i: *i, j: *j });
    let mut points: BTreeSet<Label> = (0..fan.sectors()).flat_map(sector).collect();
    if !fan.kind().is_closed() {
        points.extend(orbits.iter().filter(|(_, j)| *j == 0).map(|(i, _)| Label {
            sector: fan.sectors(),
            i: *i,
            j: 0,
        }));
    }
    if first <= 0 {
        points.insert(fan.centre());
    }
    points
}

/// The points that these are made of.
fn sources(rows: &FanRows, labels: &BTreeSet<Label>) -> Result<BTreeSet<Label>, Obstacle> {
    let mut sources = BTreeSet::new();
    for label in labels {
        rows.visit(*label, |old, _| {
            sources.insert(old);
        })?;
    }
    Ok(sources)
}

/// The smallest set of points that contains these and whatever its points are made of.
fn closure(rows: &FanRows, labels: BTreeSet<Label>) -> Result<BTreeSet<Label>, Obstacle> {
    let mut closed = labels.clone();
    let mut new = labels;
    while !new.is_empty() {
        new = sources(rows, &new)?.difference(&closed).copied().collect();
        closed.extend(&new);
    }
    Ok(closed)
}

/// The rows beside a straight crease, which are the same all along it.
struct HalfPlane<'a, 's> {
    rows: FanRows<'a, 's>,
    stencils: &'a RegularStencils,
    lattice: Lattice,
    /// By the remainder of i and by j: the old points, i relative to i div d, d being the dilation.
    known: HashMap<(i32, i32), Vec<(i32, i32)>>,
}

impl<'a, 's> HalfPlane<'a, 's> {
    fn new(refinement: &'a Refinement<'s, f64>, stencils: &'a RegularStencils, lattice: Lattice) -> Self {
        let faces = lattice.regular_valence() / 2;
        let rows = FanRows::new(refinement, stencils, Fan::new(lattice, FanKind::Crease { faces }));
        HalfPlane { rows, stencils, lattice, known: HashMap::new() }
    }

    /// The old points that the new point (i, j) is made of.
    fn sources(&mut self, i: i32, j: i32) -> Result<Vec<(i32, i32)>, Obstacle> {
        let d = self.stencils.dilation();
        let (base, base_j) = self.stencils.base(i, j);
        if j >= self.stencils.clear_of_crease() {
            let own = self.stencils.at(i, j).iter();
            return Ok(own.map(|((di, dj), _)| (base + di, base_j + dj)).collect());
        }
        let key = (i.rem_euclid(d), j);
        if !self.known.contains_key(&key) {
            let row = self.rows.walked_row(Label { sector: 0, i: d * FAR + key.0, j })?;
            self.known.insert(key, row.iter().map(|(old, _)| (old.i - FAR, old.j)).collect());
        }
        Ok(self.known[&key].iter().map(|(di, dj)| (base + di, *dj)).collect())
    }

    /// The supports of the tiles at each height below `heights`: the least sets that hold the tile's points and what those
    /// of its children are made of.
    fn supports(mut self, regular: &[Support; 2], heights: i32) -> Result<Vec<[Support; 2]>, Obstacle> {
        let tile = |j: i32, down: bool| Tile { i: 0, j, down };
        let points = |j: i32| [false, true].map(|down| tile(j, down).points(self.lattice).into_iter().collect());
        let mut supports: Vec<[Support; 2]> = (0..heights).map(points).collect();
        loop {
            let mut grown = supports.clone();
            for (j, down) in (0..heights).flat_map(|j| [(j, false), (j, true)]) {
                for child in tile(j, down).children(self.lattice, self.stencils.dilation()) {
                    let kind = usize::from(child.down);
                    let own: Vec<(i32, i32)> = match supports.get(child.j as usize) {
                        Some(own) => own[kind].iter().map(|(x, y)| (child.i + x, *y)).collect(),
                        None => regular[kind].iter().map(|(x, y)| (child.i + x, child.j + y)).collect(),
                    };
                    for (x, y) in own {
                        grown[j as usize][usize::from(down)].extend(self.sources(x, y)?);
                    }
                }
            }
            if grown.iter().flatten().any(|support| support.len() > LARGEST_SUPPORT) {
                return Err(Obstacle::Limit(format!("the stencils reach too far: more than {LARGEST_SUPPORT} points")));
            }
            if grown == supports {
                return Ok(supports);
            }
            supports = grown;
        }
    }
}
