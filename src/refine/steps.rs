//! How is a mesh refined?
//!
//! By rows of weights, point by point, on any mesh that the scheme's split allows; where rules are compact, by gathering. Both
//! ways give the same mesh with its points in the same order, and positions that differ by rounding only:
//! within [`most_ulps`].

use super::compact::Compact;
use super::gather::{self, Coordinate, Point};
use super::{Obstacle, Pass, Row};
use crate::mesh::{
    Birth, Connectivity, Faces, HalfEdgeMesh, MAX_CORNERS, NONE, NotAMesh, Numbering, Split, Tags, first_corner,
};
use crate::scheme::{PassRules, RuleBook, Scheme};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::fmt;

/// How far positions of the two routes may be apart, in units in the last place of the sum of |w p| over a point's row of this many
/// weights: half a unit for each sum, and some for the products and for points that the same step has made.
pub fn most_ulps(weights: usize) -> f64 {
    8.0 + weights as f64 / 2.0
}

/// A mesh with its points and tags.
#[derive(Clone, Debug, PartialEq)]
pub struct Level<T> {
    /// Its connectivity.
    pub mesh: HalfEdgeMesh,
    /// The points of its vertices.
    pub positions: Vec<Point<T>>,
    /// Its creases and corners.
    pub tags: Tags,
}

/// Faces and points of a last step, of which no mesh is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Refined<T> {
    /// The faces.
    pub faces: Faces,
    /// The points of the vertices.
    pub positions: Vec<Point<T>>,
}

/// How new points are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Route {
    /// By gathering where the scheme's rules are compact, else by rows.
    #[default]
    Fast,
    /// By rows everywhere.
    General,
}

/// Why a mesh can't be refined with a scheme.
#[derive(Clone, Debug, PartialEq)]
pub enum NotRefinable {
    /// A face with a number of corners that the scheme's meshes don't have.
    Face {
        /// The face.
        face: usize,
        /// Its number of corners.
        corners: usize,
        /// The number that is needed.
        needed: usize,
    },
    /// Creases or corners under a split that has none.
    Tags,
    /// Creases under a split that refines the boundary alone by rules of its own.
    Creases(String),
    /// A vertex inside the mesh with two edges, of which a split would make a face of two corners.
    TwoEdges(usize),
    /// A mesh with a boundary, under a split that has no rule for it.
    Boundary(String),
    /// A boundary that recedes, and leaves faces that make no mesh.
    Receding(NotAMesh),
    /// A split that there is no topology for.
    Split(String),
    /// The new mesh is too large.
    Mesh(NotAMesh),
    /// A point that can't be made.
    Obstacle(Obstacle),
    /// The same because of its surroundings: at a vertex, or at the edge or in the face of these vertices.
    At(Vec<u32>, Box<Obstacle>),
}

impl fmt::Display for NotRefinable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotRefinable::Face { face, corners, needed } => {
                let kind = if *needed == 3 { "triangles" } else { "quads" };
                write!(f, "face {face} has {corners} corners; the scheme refines {kind} only")
            }
            NotRefinable::Tags => f.write_str(
                "the mesh has creases or corners; under this split the boundary recedes, and there are none",
            ),
            NotRefinable::Creases(name) => write!(
                f,
                "the mesh has creases; the split {name} turns edges, and has rules for those of the boundary alone"
            ),
            NotRefinable::TwoEdges(vertex) => {
                write!(f, "vertex {vertex} has two edges; the split would make a face of two corners of it")
            }
            NotRefinable::Boundary(name) => {
                write!(f, "the mesh has a boundary, and the split {name} has no rules for one")
            }
            NotRefinable::Receding(wrong) => {
                write!(f, "under this split the boundary recedes, and the faces that are left make no mesh: {wrong}")
            }
            NotRefinable::Split(name) => write!(f, "the split {name} can't be applied to meshes"),
            NotRefinable::Mesh(wrong) => write!(f, "{wrong}"),
            NotRefinable::Obstacle(obstacle) => write!(f, "{obstacle}"),
            NotRefinable::At(vertices, obstacle) => {
                let place = match vertices.as_slice() {
                    [_] => "vertex",
                    [_, _] => "the edge of vertices",
                    _ => "the face of vertices",
                };
                let names: Vec<String> = vertices.iter().map(u32::to_string).collect();
                write!(f, "{obstacle}, at {place} {}", names.join(", "))
            }
        }
    }
}

impl std::error::Error for NotRefinable {}

impl From<Obstacle> for NotRefinable {
    fn from(obstacle: Obstacle) -> Self {
        NotRefinable::Obstacle(obstacle)
    }
}

/// What stands in the way of a point of a mesh; where its surroundings do, with the place.
pub(super) fn standing_at(mesh: &HalfEdgeMesh, birth: Birth, obstacle: Obstacle) -> NotRefinable {
    if !matches!(obstacle, Obstacle::Boundary(_) | Obstacle::Limit(_)) {
        return obstacle.into();
    }
    let at = match birth {
        Birth::Vertex(h) | Birth::Corner(h) | Birth::Kept(h) => vec![mesh.origin(h)],
        Birth::Edge(h) | Birth::Third(h) => vec![mesh.origin(h), mesh.target(h)],
        Birth::Face(h) => mesh.around_face(h).into_iter().map(|h| mesh.origin(h)).collect(),
    };
    NotRefinable::At(at, Box::new(obstacle))
}

impl From<NotAMesh> for NotRefinable {
    fn from(wrong: NotAMesh) -> Self {
        NotRefinable::Mesh(wrong)
    }
}

/// The memory of what a last step made and is done with, for the next one.
#[derive(Debug, Default)]
pub struct Buffers<T> {
    numbering: Numbering,
    corners: Vec<u32>,
    positions: Vec<Point<T>>,
}

impl<T: Coordinate> Buffers<T> {
    /// Takes the memory of a last step that is done with.
    pub fn take(&mut self, refined: Refined<T>) {
        self.corners = refined.faces.into_corners();
        self.positions = refined.positions;
    }
}

/// One pass of a scheme's step with its boundary rules.
#[derive(Clone, Debug)]
pub(super) struct PassRefiner<'a> {
    scheme: &'a Scheme,
    told: PassRules<'a>,
    boundary: Option<&'a RuleBook>,
    pub(super) split: Split,
}

impl<'a> PassRefiner<'a> {
    /// A pass, with the rules of a boundary file where there is one.
    ///
    /// # Errors
    /// When there is no topology for its split.
    pub(super) fn new(
        scheme: &'a Scheme,
        told: PassRules<'a>,
        boundary: Option<&'a RuleBook>,
    ) -> Result<PassRefiner<'a>, NotRefinable> {
        let split = Split::named(told.split).ok_or_else(|| NotRefinable::Split(told.split.to_string()))?;
        Ok(PassRefiner { scheme, told, boundary, split })
    }

    /// Its rules.
    pub(super) fn rules(&self) -> Pass<'a, f64> {
        Pass::new(self.scheme, self.told, self.boundary)
    }

    /// Whether every rule inside the mesh is compact, so that points can be gathered.
    pub(super) fn is_compact(&self) -> bool {
        Compact::<f64>::of(&self.rules(), &BTreeSet::new()).is_some()
    }

    /// Checks that the split can be applied to a mesh.
    ///
    /// # Errors
    /// The first face that is not fit.
    pub(super) fn fits(&self, mesh: &HalfEdgeMesh, tags: &Tags) -> Result<(), NotRefinable> {
        let name = || self.told.split.to_string();
        if self.split.recedes() && !tags.is_empty() {
            return Err(NotRefinable::Tags);
        }
        if !self.split.keeps_edges() && !tags.creases().is_empty() {
            return Err(NotRefinable::Creases(name()));
        }
        let without = self.split.cuts_in_turns() && self.boundary.is_none();
        let between = tags.are_turned() && matches!(self.split, Split::OneToFour | Split::OneToN);
        if (without || between) && !mesh.is_closed() {
            return Err(NotRefinable::Boundary(name()));
        }
        let two_edges = |h: &u32| mesh.valence(*h) == 2 && mesh.boundary_at(*h).is_none();
        if self.split.makes_faces_of_vertices()
            && let Some(vertex) = mesh.vertex_edges().iter().position(two_edges)
        {
            return Err(NotRefinable::TwoEdges(vertex));
        }
        Ok(())
    }

    /// One step.
    ///
    /// # Errors
    /// When the split can't be applied, the new mesh is too large, or a point can't be made.
    pub(super) fn step<T: Coordinate>(&self, level: &Level<T>, route: Route) -> Result<Level<T>, NotRefinable> {
        let mut buffers = Buffers::default();
        let Refined { faces, positions } = self.last_step_in(level, route, &mut buffers)?;
        let mesh =
            self.split.at(&level.tags).mesh(&level.mesh, &buffers.numbering, faces).map_err(NotRefinable::Receding)?;
        let tags = self.split.at(&level.tags).tags(&level.mesh, &level.tags, &mesh);
        Ok(Level { mesh, positions, tags })
    }

    /// One step after which none follows, faces and points only, in memory that is there already.
    ///
    /// # Errors
    /// As [`PassRefiner::step`].
    pub(super) fn last_step_in<T: Coordinate>(
        &self,
        level: &Level<T>,
        route: Route,
        buffers: &mut Buffers<T>,
    ) -> Result<Refined<T>, NotRefinable> {
        let positions = self.new_positions(level, route, buffers)?;
        let corners = std::mem::take(&mut buffers.corners);
        let faces = self.split.at(&level.tags).faces(&level.mesh, &buffers.numbering, corners);
        Ok(Refined { faces, positions })
    }

    /// A last step that uses its level up: what the faces don't need is given back before they are made.
    ///
    /// # Errors
    /// As [`PassRefiner::step`].
    pub(super) fn finish<T: Coordinate>(&self, level: Level<T>, route: Route) -> Result<Refined<T>, NotRefinable> {
        let mut buffers = Buffers::default();
        let positions = self.new_positions(&level, route, &mut buffers)?;
        let split = self.split.at(&level.tags);
        let Level { mesh, positions: old, tags } = level;
        drop((old, tags));
        Ok(Refined { faces: split.last_faces(mesh, buffers.numbering), positions })
    }

    /// The points of the next level; edges are numbered on the way.
    fn new_positions<T: Coordinate>(
        &self,
        level: &Level<T>,
        route: Route,
        buffers: &mut Buffers<T>,
    ) -> Result<Vec<Point<T>>, NotRefinable> {
        self.fits(&level.mesh, &level.tags)?;
        self.split.at(&level.tags).new_corners(&level.mesh)?;
        buffers.numbering = self.split.at(&level.tags).numbering(&level.mesh, std::mem::take(&mut buffers.numbering));
        let numbering = &buffers.numbering;
        let count = self.split.at(&level.tags).new_vertices(&level.mesh, numbering);
        if count > MAX_CORNERS {
            return Err(NotAMesh::TooLarge.into());
        }
        let mut positions = room(std::mem::take(&mut buffers.positions), count);
        let compact = (route == Route::Fast).then(|| Compact::of(&self.rules(), &sizes(&level.mesh))).flatten();
        match compact {
            Some(compact) => {
                let left = self.gather(level, numbering, &compact, &mut positions);
                self.by_rows(level, numbering, &left, &mut positions)?;
            }
            None => self.all_by_rows(level, numbering, &mut positions)?,
        }
        Ok(positions)
    }

    fn all_by_rows<T: Coordinate>(
        &self,
        level: &Level<T>,
        numbering: &Numbering,
        positions: &mut [Point<T>],
    ) -> Result<(), NotRefinable> {
        const RUN: usize = 1024;
        positions.par_chunks_mut(RUN).enumerate().try_for_each_init(
            || self.rules(),
            |rules, (run, points)| {
                points.iter_mut().enumerate().try_for_each(|(at, point)| {
                    let birth = self.split.at(&level.tags).birth(&level.mesh, numbering, RUN * run + at);
                    let row = rules.row_of_birth(&level.mesh, &level.tags, birth);
                    *point = applied(&row.map_err(|o| standing_at(&level.mesh, birth, o))?, &level.positions);
                    Ok(())
                })
            },
        )
    }

    /// Some points by rows.
    fn by_rows<T: Coordinate>(
        &self,
        level: &Level<T>,
        numbering: &Numbering,
        points: &[u32],
        positions: &mut [Point<T>],
    ) -> Result<(), NotRefinable> {
        let made: Vec<(u32, Point<T>)> = points
            .par_iter()
            .map_init(
                || self.rules(),
                |rules, point| {
                    let birth = self.split.at(&level.tags).birth(&level.mesh, numbering, *point as usize);
                    let row = rules.row_of_birth(&level.mesh, &level.tags, birth);
                    let row = row.map_err(|o| standing_at(&level.mesh, birth, o))?;
                    Ok((*point, applied(&row, &level.positions)))
                },
            )
            .collect::<Result<_, NotRefinable>>()?;
        made.iter().for_each(|(point, position)| positions[*point as usize] = *position);
        Ok(())
    }

    /// Gathers what is plain; gives the points that are left to the rows.
    fn gather<T: Coordinate>(
        &self,
        level: &Level<T>,
        numbering: &Numbering,
        compact: &Compact<T>,
        positions: &mut [Point<T>],
    ) -> Vec<u32> {
        let (mesh, old) = (&level.mesh, &level.positions);
        if self.split == Split::Dual {
            gather::corner_points(mesh, old, &compact.corner, positions);
            let large = |face: &[u32]| compact.corner.get(face.len()).is_none_or(Option::is_none);
            return corners_of(mesh, large);
        }
        let (at_vertices, rest) = positions.split_at_mut(mesh.vertices());
        let (at_edges, in_faces) = rest.split_at_mut(numbering.edges());
        gather::face_points(mesh, old, &compact.face, in_faces);
        gather::edge_points(mesh, numbering, old, in_faces, &compact.edge, at_edges);
        let mut left = gather::vertex_points(mesh, old, in_faces, &compact.vertex, at_vertices);
        self.leave_special(level, numbering, &mut left);
        self.leave_large_faces(mesh, numbering, compact, &mut left);
        left.sort_unstable();
        left.dedup();
        left
    }

    /// The points of the boundary and of creases.
    fn leave_special<T>(&self, level: &Level<T>, numbering: &Numbering, left: &mut Vec<u32>) {
        let (mesh, on_edges) = (&level.mesh, level.mesh.vertices() as u32);
        let boundary = (0..mesh.twins().len()).filter(|h| mesh.twins()[*h] == NONE);
        left.extend(boundary.flat_map(|h| [mesh.faces().corners()[h], on_edges + numbering.of_first(h as u32)]));
        for (edge, _) in level.tags.creases() {
            left.extend([mesh.origin(*edge), mesh.target(*edge), on_edges + numbering.of_first(*edge)]);
        }
        left.extend(level.tags.corners());
        if self.boundary.is_some_and(RuleBook::tells_from_ends) {
            left.extend(self.edges_at_sharp_vertices(level).map(|edge| on_edges + numbering.of_first(edge)));
        }
    }

    /// The edges at every vertex that a boundary or a crease leads to, or that is a corner, by their first corners.
    fn edges_at_sharp_vertices<T>(&self, level: &Level<T>) -> impl Iterator<Item = u32> {
        let (mesh, tags) = (&level.mesh, &level.tags);
        let boundary = (0..mesh.twins().len()).filter(|h| mesh.twins()[*h] == NONE);
        let mut vertices: Vec<u32> = boundary.flat_map(|h| [h as u32, mesh.twin(h as u32)]).collect();
        vertices.extend(tags.creases().iter().flat_map(|(edge, _)| [*edge, mesh.twin(*edge)]));
        vertices.extend(tags.corners().iter().map(|vertex| mesh.vertex_edges()[*vertex as usize]));
        let spokes = vertices.into_iter().flat_map(|h| mesh.around_vertex(h));
        spokes.map(|spoke| first_corner(mesh, spoke)).collect::<Vec<u32>>().into_iter()
    }

    /// The points of faces that have no weight in the table, and those of their edges and vertices, which may be made of them.
    fn leave_large_faces<T>(
        &self,
        mesh: &HalfEdgeMesh,
        numbering: &Numbering,
        compact: &Compact<T>,
        left: &mut Vec<u32>,
    ) {
        if self.split != Split::OneToN || mesh.faces().same_size() == Some(4) {
            return;
        }
        let on_edges = mesh.vertices() as u32;
        let in_faces = on_edges + numbering.edges() as u32;
        for h in corners_of(mesh, |face| compact.face.get(face.len()).is_none_or(Option::is_none)) {
            let number = numbering.of_corner(h, mesh.twins()[h as usize]);
            left.extend([mesh.faces().corners()[h as usize], on_edges + number, in_faces + mesh.faces().face_of(h)]);
        }
    }
}

/// The numbers of corners of a mesh's faces.
fn sizes(mesh: &HalfEdgeMesh) -> BTreeSet<usize> {
    match mesh.faces().same_size() {
        Some(size) => BTreeSet::from([size as usize]),
        None => mesh.faces().iter().map(<[u32]>::len).collect(),
    }
}

/// The corners of the faces for which `wanted` holds.
fn corners_of(mesh: &HalfEdgeMesh, wanted: impl Fn(&[u32]) -> bool) -> Vec<u32> {
    if mesh.faces().same_size() == Some(4) && !wanted(&[0; 4]) {
        return Vec::new();
    }
    let faces = (0..mesh.faces().len()).filter(|face| wanted(mesh.faces().face(*face)));
    faces.flat_map(|face| mesh.faces().range(face)).map(|corner| corner as u32).collect()
}

/// Room for this many points: the buffer, or fresh memory.
fn room<T: Coordinate>(mut buffer: Vec<Point<T>>, length: usize) -> Vec<Point<T>> {
    let zero = [T::default(); 3];
    if buffer.capacity() < length {
        return vec![zero; length];
    }
    buffer.resize(length, zero);
    buffer
}

/// Row times positions, in f64. Products are added up in order of their size, so that the result does not know how vertices are
/// numbered: two meshes that share a boundary get the same points there.
pub fn applied<T: Coordinate>(row: &Row<u32, f64>, positions: &[Point<T>]) -> Point<T> {
    let mut products: Vec<f64> = Vec::with_capacity(row.len());
    [0, 1, 2].map(|axis| {
        products.clear();
        products.extend(row.iter().map(|(point, weight)| weight * positions[*point as usize][axis].to_f64()));
        products.sort_unstable_by(f64::total_cmp);
        T::from_f64(products.iter().sum())
    })
}
