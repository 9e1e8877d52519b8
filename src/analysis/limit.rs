//! Where does each vertex of a mesh go in the limit, and which way does the surface face there?
//!
//! The limit mask of its place gives the point, the tangent masks the normal (Halstead, Kass and DeRose 1993): at vertices inside
//! the mesh, on boundaries and creases, at corners and darts. Masks come from the analysis, at each place that the mesh has. A mask holds where the
//! mesh is like the canonical patch as far as the rules of its points look: where rules are compact and the mask lies on the faces around the vertex,
//! these alone must be regular; else so must all vertices around it, out to the reach of the neighbourhood. Where
//! they are not, and while creases that end are there, the mesh is refined first, and vertices are followed: to vertices, or to faces. So is a mesh
//! with boundaries or creases where rules near these are told from their special vertices, or points around these are moved: after a step
//! these are no neighbours.

use super::places::{LabelledMask, Place, PlaceMasks, Places, point_at};
use crate::mesh::{Centre, Connectivity, Cycle, HalfEdgeMesh, Lattice, Split, Tagged, sides};
use crate::refine::{Level, NotRefinable, Obstacle, Refiner, Route, cycle_of, lattice_of};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Limit points and normals of a mesh's vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LimitSurface {
    /// The limit points.
    pub positions: Vec<[f64; 3]>,
    /// Unit normals, the outward ones where faces are counter-clockwise from outside; zero where there is none. Where several sides of creases meet, the
    /// mean of their normals.
    pub normals: Vec<[f64; 3]>,
    /// Why vertices have no normal: the first of them, and how many.
    pub without_normal: BTreeMap<String, (u32, usize)>,
    /// Vertices whose tangents belong to a Jordan block: the first of them, and how many. There is a tangent plane, but the nets come near to it
    /// like 1/m only.
    pub slow_normals: Option<(u32, usize)>,
}

/// Why a mesh has no limit points.
#[derive(Clone, Debug, PartialEq)]
pub enum NoLimit {
    /// It can't be refined.
    Refinement(NotRefinable),
    /// A vertex has none.
    Vertex(u32, String),
}

impl fmt::Display for NoLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoLimit::Refinement(wrong) => write!(f, "{wrong}"),
            NoLimit::Vertex(vertex, why) => write!(f, "vertex {vertex} has no limit point: {why}"),
        }
    }
}

impl std::error::Error for NoLimit {}

impl From<NotRefinable> for NoLimit {
    fn from(wrong: NotRefinable) -> Self {
        NoLimit::Refinement(wrong)
    }
}

impl From<Obstacle> for NoLimit {
    fn from(obstacle: Obstacle) -> Self {
        NoLimit::Refinement(obstacle.into())
    }
}

/// One side of a vertex, all round where no crease divides it: its place, and the half-edges that leave it, counter-clockwise.
#[derive(Clone, Debug)]
struct Sector {
    place: Place,
    spokes: Vec<u32>,
}

/// A scheme, ready to push meshes to the limit.
pub struct Limits<'a> {
    refiner: Refiner<'a>,
    lattice: Lattice,
    places: Places<'a>,
    /// Whether masks look at the faces around a vertex only.
    near: bool,
    /// How many rings of vertices must be regular otherwise.
    reach: usize,
    /// The steps after which irregular vertices (dual: faces) are so far apart, wherever they are.
    steps_apart: usize,
}

impl<'a> Limits<'a> {
    /// Prepares the masks of a refiner's scheme.
    ///
    /// # Errors
    /// When a weight has no value at the regular valence, or stencils reach too far.
    pub fn new(refiner: &Refiner<'a>) -> Result<Limits<'a>, Obstacle> {
        let lattice = lattice_of(refiner.scheme());
        let places = Places::new(refiner.scheme(), refiner.boundary())?;
        let reach = places.reach()?;
        let cycle = cycle_of(refiner.scheme())?;
        let (near, steps_apart) = (refiner.is_compact(), steps_apart(reach, &cycle));
        Ok(Limits { refiner: refiner.clone(), lattice, places, near, reach, steps_apart })
    }

    /// The masks of a place.
    ///
    /// # Errors
    /// When a weight has no value there, or the place is beyond a limit.
    pub fn masks(&self, place: Place) -> Result<PlaceMasks, Obstacle> {
        self.places.at(place)
    }

    /// How many rings of vertices masks may look at.
    pub fn reach(&self) -> usize {
        self.reach
    }

    /// The steps that a level is refined by before its masks are applied.
    pub fn steps_before(&self, level: &Level<f64>) -> usize {
        let ending = level.tags.most_steps().ceil() as usize;
        let dual = self.refiner.is_dual();
        let sizes = usize::from(!dual && level.mesh.faces().same_size() != Some(self.lattice.face_corners() as u32));
        let apart = if self.near || (!dual && self.all_apart(level)) { 0 } else { self.steps_apart };
        let special = self.refiner.tells_from_ends() && !(level.tags.is_empty() && level.mesh.is_closed());
        // points on the faces of two vertices that are moved must not be the same
        let flat = usize::from(self.refiner.moves_points(&level.mesh, &level.tags));
        let first = ending.max(sizes).max(usize::from(special && self.near)).max(flat);
        let steps = first.saturating_add(apart + usize::from(dual));
        // masks on a boundary hold where it stands as it did, not where its edges are still to be cut
        let turning = self.refiner.splits().any(Split::cuts_in_turns) && self.refiner.steps_of_cycle() == 2;
        let cut = turning && !level.mesh.is_closed();
        steps.saturating_add(usize::from(cut && (steps % 2 == 1) != level.tags.are_turned()))
    }

    /// Whether every vertex, and whatever is special, is alone as far as the masks reach.
    fn all_apart(&self, level: &Level<f64>) -> bool {
        let (regular, reach) = (self.lattice.regular_valence(), self.reach);
        let special = |vertex: u32| {
            let start = level.mesh.vertex_edges()[vertex as usize];
            level.mesh.valence(start) != regular || level.mesh.boundary_at(start).is_some()
        };
        let special: Vec<bool> = (0..level.mesh.vertices() as u32).into_par_iter().map(special).collect();
        let alone =
            |vertex: u32| around(&level.mesh, vertex, reach).iter().all(|v| *v == vertex || !special[*v as usize]);
        level.tags.is_empty() && (0..level.mesh.vertices() as u32).into_par_iter().all(alone)
    }

    /// The limit points and normals of a level's vertices; `done` is called for each step that it is refined by first.
    ///
    /// # Errors
    /// When the level can't be refined, or a vertex has no limit point.
    pub fn of(&self, level: &Level<f64>, done: &dyn Fn()) -> Result<LimitSurface, NoLimit> {
        self.of_centres(level, self.vertices(level), done)
    }

    /// The vertices of a level.
    pub fn vertices(&self, level: &Level<f64>) -> Vec<Option<Centre>> {
        (0..level.mesh.vertices() as u32).map(|vertex| Some(Centre::Vertex(vertex))).collect()
    }

    /// The limit points and normals of some vertices and faces of a level; `done` is called for each step that it is refined by first.
    ///
    /// # Errors
    /// When the level can't be refined, or one has no limit point.
    pub fn of_centres(
        &self,
        level: &Level<f64>,
        mut centres: Vec<Option<Centre>>,
        done: &dyn Fn(),
    ) -> Result<LimitSurface, NoLimit> {
        let mut refined: Option<Level<f64>> = None;
        for _ in 0..self.steps_before(level) {
            refined = Some(self.refiner.step_tracing(refined.as_ref().unwrap_or(level), Route::Fast, &mut centres)?);
            if let Some(gone) = centres.iter().position(Option::is_none) {
                let why = "it lies on the boundary, which recedes under a dual split, or too near to it".to_string();
                return Err(NoLimit::Vertex(gone as u32, why));
            }
            done();
        }
        let at = refined.as_ref().unwrap_or(level);
        self.at_sectors(at, centres.len(), |index| match centres[index] {
            Some(Centre::Vertex(vertex)) => sectors(at, vertex),
            Some(Centre::Face(face)) => vec![central_face(&at.mesh, face as usize)],
            None => vec![],
        })
    }

    fn at_sectors(
        &self,
        at: &Level<f64>,
        count: usize,
        sectors: impl Fn(usize) -> Vec<Sector> + Sync,
    ) -> Result<LimitSurface, NoLimit> {
        let collect = |mut places: BTreeSet<Place>, index: usize| {
            places.extend(sectors(index).into_iter().map(|sector| sector.place));
            places
        };
        let join = |mut a: BTreeSet<Place>, mut b: BTreeSet<Place>| {
            a.append(&mut b);
            a
        };
        let places = (0..count).into_par_iter().fold(BTreeSet::new, collect).reduce(BTreeSet::new, join);
        let masks = |place| match self.places.at(place) {
            // beyond a limit of the analysis: told with the vertex
            Err(Obstacle::Limit(why)) => {
                Ok((place, PlaceMasks { limit: Err(why.clone()), tangents: Err(why), rates: None }))
            }
            masks => Ok((place, masks?)),
        };
        let masks = places.into_iter().map(masks).collect::<Result<_, Obstacle>>()?;
        let masked = Masked { at, lattice: self.lattice, masks, near: self.near };
        masked.surface(count, sectors)
    }
}

/// In each step distances grow by the dilation's root; vertices start an edge apart, the middles of faces half of one.
fn steps_apart(reach: usize, cycle: &Cycle) -> usize {
    let distance = if cycle.lattice().has_centre() { reach } else { 2 * (reach + 2) };
    let (mut steps, mut square) = (0, 1.0);
    while square <= (distance * distance) as f64 {
        square *= libm::pow(f64::from(cycle.dilation), 2.0 / cycle.steps as f64);
        steps += 1;
    }
    steps
}

/// A level with the masks of its places.
struct Masked<'m> {
    at: &'m Level<f64>,
    lattice: Lattice,
    masks: BTreeMap<Place, PlaceMasks>,
    /// Whether the surroundings are taken as they are, so that masks must lie on the faces around the vertex.
    near: bool,
}

/// A limit point, and the normal or why there is none.
type PointAndNormal = ([f64; 3], Result<[f64; 3], String>);

/// Vertices are taken in runs of this many. A tuning.
const RUN: usize = 4096;

/// What is said of the vertices of a run.
#[derive(Default)]
struct Said {
    without_normal: BTreeMap<String, (u32, usize)>,
    slow_normals: Option<(u32, usize)>,
}

/// Some vertices: the first, and how many.
fn joined(a: Option<(u32, usize)>, b: Option<(u32, usize)>) -> Option<(u32, usize)> {
    match (a, b) {
        (Some((first, count)), Some((other, more))) => Some((first.min(other), count + more)),
        (one, other) => one.or(other),
    }
}

impl Masked<'_> {
    fn is_slow(&self, place: Place) -> bool {
        self.masks[&place].rates.is_some_and(|rates| rates.jordan > 1)
    }

    fn surface(&self, count: usize, sectors: impl Fn(usize) -> Vec<Sector> + Sync) -> Result<LimitSurface, NoLimit> {
        let (mut positions, mut normals) = (vec![[0.0; 3]; count], vec![[0.0; 3]; count]);
        let runs = positions.par_chunks_mut(RUN).zip(normals.par_chunks_mut(RUN)).enumerate();
        let said = runs.map(|(run, (positions, normals))| {
            let mut said = Said::default();
            for (at, (position, normal)) in positions.iter_mut().zip(normals).enumerate() {
                let vertex = (run * RUN + at) as u32;
                let sectors = sectors(vertex as usize);
                let found = self.point(&sectors).map_err(|why| NoLimit::Vertex(vertex, why))?;
                *position = found.0;
                match found.1 {
                    Ok(found) => *normal = found,
                    Err(why) => said.without_normal.entry(why).or_insert((vertex, 0)).1 += 1,
                }
                if sectors.iter().any(|sector| self.is_slow(sector.place)) {
                    said.slow_normals = joined(said.slow_normals, Some((vertex, 1)));
                }
            }
            Ok(said)
        });
        let said: Vec<Said> = said.collect::<Result<_, NoLimit>>()?;
        let mut surface = LimitSurface { positions, normals, ..LimitSurface::default() };
        for said in said {
            surface.slow_normals = joined(surface.slow_normals, said.slow_normals);
            for (why, (first, count)) in said.without_normal {
                surface.without_normal.entry(why).or_insert((first, 0)).1 += count;
            }
        }
        Ok(surface)
    }

    /// A limit point, and the normal or why there is none.
    fn point(&self, sectors: &[Sector]) -> Result<PointAndNormal, String> {
        let first = sectors.first().ok_or("it belongs to no face")?;
        let limit = self.masks[&first.place].limit.as_ref().map_err(Clone::clone)?;
        let position = self.sum(first, limit, [0.0; 3])?;
        let mut normal = [0.0; 3];
        for sector in sectors {
            match self.normal(sector) {
                Ok(own) => normal = [0, 1, 2].map(|axis| normal[axis] + own[axis]),
                Err(why) => return Ok((position, Err(why))),
            }
        }
        Ok((position, unit(normal, 1e-12).ok_or_else(|| "the normals of its sides cancel out".to_string())))
    }

    fn normal(&self, sector: &Sector) -> Result<[f64; 3], String> {
        let tangents = self.masks[&sector.place].tangents.as_ref().map_err(Clone::clone)?;
        let origin = self.at.positions[self.at.mesh.origin(sector.spokes[0]) as usize];
        let [a, b] = [&tangents[0], &tangents[1]].map(|mask| self.sum(sector, mask, origin).map(scaled));
        let (a, b) = (a?, b?);
        unit(cross(a, b), 1e-12).ok_or_else(|| "its tangents are parallel or zero for these points".to_string())
    }

    /// A mask applied to the points around a sector's vertex, less an origin.
    fn sum(&self, sector: &Sector, mask: &LabelledMask, origin: [f64; 3]) -> Result<[f64; 3], String> {
        // added up in order of size, as rows are: a boundary's limits don't know which mesh it belongs to
        let mut products: [Vec<f64>; 3] = Default::default();
        for (label, weight) in mask {
            if self.near && self.lattice.ring(label.i, label.j) > 1 {
                return Err("its mask reaches beyond the faces around it, although the rules are compact".to_string());
            }
            let point = point_at(&self.at.mesh, self.lattice, sector.place, &sector.spokes, *label);
            let position = self.at.positions[point.ok_or("its mask reaches beyond the face")? as usize];
            products.iter_mut().enumerate().for_each(|(axis, own)| own.push(weight * (position[axis] - origin[axis])));
        }
        Ok(products.map(|mut own| {
            own.sort_unstable_by(f64::total_cmp);
            own.iter().sum()
        }))
    }
}

/// The corners of a face as the spokes of its middle.
fn central_face(mesh: &HalfEdgeMesh, face: usize) -> Sector {
    let range = mesh.faces().range(face);
    Sector { place: Place::Inside(range.len()), spokes: range.map(|h| h as u32).collect() }
}

/// The sides of a vertex.
fn sectors(at: &Level<f64>, vertex: u32) -> Vec<Sector> {
    let start = at.mesh.vertex_edges()[vertex as usize];
    let tagged = Tagged { mesh: &at.mesh, tags: &at.tags, beyond: 0.0 };
    if at.tags.is_empty() && at.mesh.twins()[start as usize] != crate::mesh::NONE {
        let spokes = at.mesh.around_vertex(start);
        return vec![Sector { place: Place::Inside(spokes.len()), spokes }];
    }
    let fans = sides(&tagged, start);
    if !fans.is_empty() {
        return fans.into_iter().map(|(kind, spokes)| Sector { place: Place::Fan(kind), spokes }).collect();
    }
    let sharp = tagged.sharp_spokes(start);
    let spokes = tagged.around_vertex(sharp.first().copied().unwrap_or(start));
    let place = if tagged.is_corner(start) { Place::Cone } else { Place::Inside(spokes.len()) };
    vec![Sector { place, spokes }]
}

/// The vertices within some rings of faces around one.
fn around(mesh: &HalfEdgeMesh, vertex: u32, rings: usize) -> BTreeSet<u32> {
    let mut all = BTreeSet::from([vertex]);
    let mut newest = vec![vertex];
    for _ in 0..rings {
        let starts = newest.iter().map(|vertex| mesh.vertex_edges()[*vertex as usize]);
        let spokes = starts.flat_map(|start| mesh.around_vertex(start)).filter(|spoke| mesh.has_face(*spoke));
        let corners: Vec<u32> =
            spokes.flat_map(|spoke| mesh.faces().face(mesh.faces().face_of(spoke) as usize).to_vec()).collect();
        newest = corners.into_iter().filter(|vertex| all.insert(*vertex)).collect();
    }
    all
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A vector over its largest entry: what follows neither underflows nor overflows.
pub(super) fn scaled(v: [f64; 3]) -> [f64; 3] {
    let largest = v.iter().fold(0.0_f64, |top, x| top.max(x.abs()));
    if largest > 0.0 { v.map(|x| x / largest) } else { v }
}

/// The vector over its length, where that is larger than a bound.
pub(super) fn unit(v: [f64; 3], least: f64) -> Option<[f64; 3]> {
    let length = dot(v, v).sqrt();
    (length > least).then(|| v.map(|x| x / length))
}
