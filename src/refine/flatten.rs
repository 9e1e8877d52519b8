//! How are the points around a vertex on a boundary moved after a step?
//!
//! Towards the plane of its tangents (Biermann, Levin and Zorin 2000, flatness): each moved point is a combination of the points on the
//! faces around the vertex. The weights come from masks, and masks from the analysis, so they are handed in as numbers. Where a point lies on
//! the faces of several such vertices, as it may after the first step, it goes to the mean of the places that these give it.

use super::pass::{add_scaled, collected};
use super::{Level, NotRefinable, Obstacle, Row, applied};
use crate::mesh::{Connectivity, FanKind, HalfEdgeMesh, Label, Tagged, Tags, sides};
use crate::refine::Coordinate;
use std::collections::{BTreeMap, BTreeSet};

/// How points move around one kind of vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Moves {
    /// The points on the faces around the vertex, itself among them.
    pub points: Vec<Label>,
    /// The points that move, by their index, each with the weights of all.
    pub rows: Vec<(usize, Vec<f64>)>,
}

/// How points move around each kind of vertex: `None` where they stay, an obstacle where it is not known.
#[derive(Clone, Debug, Default)]
pub struct Flatness {
    /// The kinds that a mesh may have.
    pub kinds: BTreeMap<FanKind, Result<Option<Moves>, Obstacle>>,
}

/// The kinds of vertices around which points of a mesh may move, in this step or once creases that end have ended.
pub fn fan_kinds(mesh: &HalfEdgeMesh, tags: &Tags) -> BTreeSet<FanKind> {
    let ever = Tagged { mesh, tags, beyond: f64::MAX };
    special(mesh, tags).flat_map(|start| sides(&ever, start)).map(|(kind, _)| kind).collect()
}

/// A half-edge that leaves each vertex that may lie on a boundary or crease.
fn special<'m>(mesh: &'m HalfEdgeMesh, tags: &'m Tags) -> impl Iterator<Item = u32> + 'm {
    let starts = mesh.vertex_edges().iter().copied();
    starts.filter(|start| !tags.is_empty() || mesh.boundary_at(*start).is_some())
}

/// The fans between boundaries and creases that never end. At a vertex with a crease that ends nothing moves until it has ended.
fn fans<'m>(mesh: &'m HalfEdgeMesh, tags: &'m Tags) -> impl Iterator<Item = (FanKind, Vec<u32>)> + 'm {
    let [any, ever] = [0.0, f64::MAX].map(|beyond| Tagged { mesh, tags, beyond });
    let ends = move |start: u32| any.sharp_spokes(start).len() > ever.sharp_spokes(start).len();
    special(mesh, tags)
        .filter(move |start| !ends(*start))
        .flat_map(move |start| sides(&Tagged { mesh, tags, beyond: f64::MAX }, start))
}

impl Flatness {
    /// How the points of a mesh that move are made of its points.
    pub(super) fn rows(&self, mesh: &HalfEdgeMesh, tags: &Tags) -> Result<BTreeMap<u32, Row<u32, f64>>, NotRefinable> {
        let mut places: BTreeMap<u32, Vec<(u32, f64)>> = BTreeMap::new();
        let mut times: BTreeMap<u32, f64> = BTreeMap::new();
        for (kind, spokes) in fans(mesh, tags) {
            let Some(moves) = self.at(kind)? else { continue };
            let points: Vec<u32> = moves.points.iter().map(|label| point_at(mesh, &spokes, *label)).collect();
            for (point, weights) in &moves.rows {
                let point = points[*point];
                places.entry(point).or_default().extend(points.iter().copied().zip(weights.iter().copied()));
                *times.entry(point).or_default() += 1.0;
            }
        }
        let mean = |(point, places): (u32, Vec<(u32, f64)>)| {
            let mut sum = Vec::new();
            add_scaled(&mut sum, &places, &(1.0 / times[&point])).map_err(Obstacle::from)?;
            Ok((point, collected(sum)?))
        };
        places.into_iter().map(mean).collect()
    }

    /// Moves the points of a level.
    pub(super) fn apply<T: Coordinate>(&self, level: &mut Level<T>) -> Result<(), NotRefinable> {
        let rows = self.rows(&level.mesh, &level.tags)?;
        let moved: Vec<_> = rows.iter().map(|(point, row)| (*point, applied(row, &level.positions))).collect();
        moved.into_iter().for_each(|(point, position)| level.positions[point as usize] = position);
        Ok(())
    }

    fn at(&self, kind: FanKind) -> Result<Option<&Moves>, NotRefinable> {
        let missing = || {
            let (name, faces) = (kind.name(), kind.faces());
            let why = "the boundary file tells a flatness, and its masks were not handed in for this vertex";
            Obstacle::Limit(format!("{why}: a {name} with {faces} faces"))
        };
        Ok(self.kinds.get(&kind).ok_or_else(missing)?.as_ref().map_err(Clone::clone)?.as_ref())
    }
}

/// The vertex at a label on the faces around a fan's centre: itself, the end of a spoke, or the corner of a quad across.
fn point_at(mesh: &HalfEdgeMesh, spokes: &[u32], label: Label) -> u32 {
    let spoke = spokes[label.sector as usize];
    match label.orbit() {
        (0, 0) => mesh.origin(spoke),
        (_, 0) => mesh.target(spoke),
        _ => mesh.target(mesh.next(spoke)),
    }
}
