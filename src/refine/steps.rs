//! How is a mesh refined?
//!
//! By rows of weights, point by point, on any mesh that the scheme's split allows; where rules are compact, by gathering. Both
//! ways give the same mesh with its points in the same order, and positions that differ by rounding only:
//! within [`most_ulps`].

use super::compact::Compact;
use super::gather::{self, Coordinate, Point};
use super::{Obstacle, Refinement, Row};
use crate::mesh::{
    Birth, Connectivity, Faces, HalfEdgeMesh, MAX_CORNERS, NONE, NotAMesh, Numbering, Split, Tags, first_corner,
};
use crate::scheme::{RuleBook, Scheme};
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
    /// A vertex inside the mesh with two edges, of which a dual split would make a face of two corners.
    TwoEdges(usize),
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
            NotRefinable::Tags => f.write_str("the mesh has creases or corners; a dual split has none"),
            NotRefinable::TwoEdges(vertex) => {
                write!(f, "vertex {vertex} has two edges; a dual split would make a face of two corners of it")
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
fn standing_at(mesh: &HalfEdgeMesh, birth: Birth, obstacle: Obstacle) -> NotRefinable {
    if !matches!(obstacle, Obstacle::Boundary(_) | Obstacle::Limit(_)) {
        return obstacle.into();
    }
    let at = match birth {
        Birth::Vertex(h) | Birth::Corner(h) => vec![mesh.origin(h)],
        Birth::Edge(h) => vec![mesh.origin(h), mesh.target(h)],
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

/// A scheme with its boundary rules, ready to refine meshes.
#[derive(Clone, Debug)]
pub struct Refiner<'a> {
    scheme: &'a Scheme,
    boundary: Option<&'a RuleBook>,
    split: Split,
}

impl<'a> Refiner<'a> {
    /// A scheme, with the rules of a boundary file where there is one.
    ///
    /// # Errors
    /// When there is no topology for the scheme's split.
    pub fn new(scheme: &'a Scheme, boundary: Option<&'a RuleBook>) -> Result<Refiner<'a>, NotRefinable> {
        let split = Split::named(&scheme.split).ok_or_else(|| NotRefinable::Split(scheme.split.clone()))?;
        Ok(Refiner { scheme, boundary, split })
    }

    /// The topology of the scheme's split.
    pub fn split(&self) -> Split {
        self.split
    }

    /// The scheme.
    pub fn scheme(&self) -> &'a Scheme {
        self.scheme
    }

    /// The rules of the boundary file.
    pub fn boundary(&self) -> Option<&'a RuleBook> {
        self.boundary
    }

    /// Whether every rule of the scheme inside the mesh is compact, so that points can be gathered.
    pub fn is_compact(&self) -> bool {
        Compact::<f64>::of(&Refinement::new(self.scheme, self.boundary), &BTreeSet::new()).is_some()
    }

    /// Whether points near a boundary or crease depend on which vertices there are special: rules are told from these.
    pub fn tells_from_ends(&self) -> bool {
        self.boundary.is_some_and(RuleBook::tells_from_ends)
    }

    /// Checks that the scheme's split can be applied to a mesh.
    ///
    /// # Errors
    /// The first face that is not fit.
    pub fn fits(&self, mesh: &HalfEdgeMesh, tags: &Tags) -> Result<(), NotRefinable> {
        if self.split == Split::Dual && !tags.is_empty() {
            return Err(NotRefinable::Tags);
        }
        let two_edges = |h: &u32| mesh.valence(*h) == 2 && mesh.boundary_at(*h).is_none();
        if self.split == Split::Dual
            && let Some(vertex) = mesh.vertex_edges().iter().position(two_edges)
        {
            return Err(NotRefinable::TwoEdges(vertex));
        }
        let needed = match self.scheme.mesh.as_str() {
            "triangles" => 3,
            "quads" => 4,
            _ => return Ok(()),
        };
        if mesh.faces().same_size() == Some(needed as u32) {
            return Ok(());
        }
        let odd = mesh.faces().iter().enumerate().find(|(_, face)| face.len() != needed);
        odd.map_or(Ok(()), |(face, corners)| Err(NotRefinable::Face { face, corners: corners.len(), needed }))
    }

    /// One step.
    ///
    /// # Errors
    /// When the split can't be applied, the new mesh is too large, or a point can't be made.
    pub fn step<T: Coordinate>(&self, level: &Level<T>, route: Route) -> Result<Level<T>, NotRefinable> {
        let mut buffers = Buffers::default();
        let Refined { faces, positions } = self.last_step_in(level, route, &mut buffers)?;
        let mesh = self.split.mesh(&level.mesh, &buffers.numbering, faces);
        let tags = self.split.tags(&level.mesh, &level.tags, &mesh);
        Ok(Level { mesh, positions, tags })
    }

    /// One step after which none follows: faces and points only.
    ///
    /// # Errors
    /// As [`Refiner::step`].
    pub fn last_step<T: Coordinate>(&self, level: &Level<T>, route: Route) -> Result<Refined<T>, NotRefinable> {
        self.last_step_in(level, route, &mut Buffers::default())
    }

    /// The same, in memory that is there already.
    ///
    /// # Errors
    /// As [`Refiner::step`].
    pub fn last_step_in<T: Coordinate>(
        &self,
        level: &Level<T>,
        route: Route,
        buffers: &mut Buffers<T>,
    ) -> Result<Refined<T>, NotRefinable> {
        let positions = self.new_positions(level, route, buffers)?;
        let corners = std::mem::take(&mut buffers.corners);
        let faces = self.split.faces(&level.mesh, &buffers.numbering, corners);
        Ok(Refined { faces, positions })
    }

    /// A last step that uses its level up: what the faces don't need is given back before they are made.
    ///
    /// # Errors
    /// As [`Refiner::step`].
    pub fn finish<T: Coordinate>(&self, level: Level<T>, route: Route) -> Result<Refined<T>, NotRefinable> {
        let mut buffers = Buffers::default();
        let positions = self.new_positions(&level, route, &mut buffers)?;
        let Level { mesh, positions: old, tags } = level;
        drop((old, tags));
        Ok(Refined { faces: self.split.last_faces(mesh, buffers.numbering), positions })
    }

    /// The points of the next level; edges are numbered on the way.
    fn new_positions<T: Coordinate>(
        &self,
        level: &Level<T>,
        route: Route,
        buffers: &mut Buffers<T>,
    ) -> Result<Vec<Point<T>>, NotRefinable> {
        self.fits(&level.mesh, &level.tags)?;
        self.split.new_corners(&level.mesh)?;
        buffers.numbering = Numbering::in_buffers(&level.mesh, std::mem::take(&mut buffers.numbering));
        let numbering = &buffers.numbering;
        let count = self.split.new_vertices(&level.mesh, numbering);
        if count > MAX_CORNERS {
            return Err(NotAMesh::TooLarge.into());
        }
        let mut positions = room(std::mem::take(&mut buffers.positions), count);
        let compact = (route == Route::Fast)
            .then(|| Compact::of(&Refinement::new(self.scheme, self.boundary), &sizes(&level.mesh)))
            .flatten();
        match compact {
            Some(compact) => {
                let left = self.gather(level, numbering, &compact, &mut positions);
                self.by_rows(level, numbering, &left, &mut positions)?;
            }
            None => self.all_by_rows(level, numbering, &mut positions)?,
        }
        Ok(positions)
    }

    /// The rows of all new points, in order: how each is made of the old ones.
    ///
    /// # Errors
    /// As [`Refiner::step`].
    pub fn rows(&self, mesh: &HalfEdgeMesh, tags: &Tags) -> Result<Vec<Row<u32, f64>>, NotRefinable> {
        self.fits(mesh, tags)?;
        let numbering = Numbering::of(mesh);
        let refinement = Refinement::new(self.scheme, self.boundary);
        let row = |point| {
            let birth = self.split.birth(mesh, &numbering, point);
            refinement.row_of_birth(mesh, tags, birth).map_err(|obstacle| standing_at(mesh, birth, obstacle))
        };
        (0..self.split.new_vertices(mesh, &numbering)).map(row).collect()
    }

    fn all_by_rows<T: Coordinate>(
        &self,
        level: &Level<T>,
        numbering: &Numbering,
        positions: &mut [Point<T>],
    ) -> Result<(), NotRefinable> {
        const RUN: usize = 1024;
        positions.par_chunks_mut(RUN).enumerate().try_for_each_init(
            || Refinement::new(self.scheme, self.boundary),
            |refinement, (run, points)| {
                points.iter_mut().enumerate().try_for_each(|(at, point)| {
                    let birth = self.split.birth(&level.mesh, numbering, RUN * run + at);
                    let row = refinement.row_of_birth(&level.mesh, &level.tags, birth);
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
                || Refinement::new(self.scheme, self.boundary),
                |refinement, point| {
                    let birth = self.split.birth(&level.mesh, numbering, *point as usize);
                    let row = refinement.row_of_birth(&level.mesh, &level.tags, birth);
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
        if self.tells_from_ends() {
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
