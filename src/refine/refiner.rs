//! How is a mesh refined by a scheme whose step has several passes?
//!
//! Pass after pass. Each is refined in its own way; a [`Chain`] knows the meshes of some steps without any position, and how the points of the
//! last are made of those of the first. Where a boundary file tells a flatness, points are moved after the last pass ([`super::flatten`]).

use super::gather::Coordinate;
use super::pass::{add_scaled, collected};
use super::steps::{PassRefiner, standing_at};
use super::{Buffers, Counts, Flatness, Level, NotRefinable, Obstacle, Pass, Refined, Route, Row};
use crate::mesh::{Centre, Cycle, HalfEdgeMesh, Numbering, Split, Tags};
use crate::scheme::{RuleBook, Scheme};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A scheme with its boundary rules, ready to refine meshes.
#[derive(Clone, Debug)]
pub struct Refiner<'a> {
    scheme: &'a Scheme,
    boundary: Option<&'a RuleBook>,
    passes: Vec<PassRefiner<'a>>,
    cycle: Cycle,
    /// How points around special vertices are moved after a step, where the boundary file says that they are.
    flatness: Option<Arc<Flatness>>,
}

impl<'a> Refiner<'a> {
    /// A scheme, with the rules of a boundary file where there is one.
    ///
    /// # Errors
    /// When there is no topology for the scheme's splits, or they don't refine.
    pub fn new(scheme: &'a Scheme, boundary: Option<&'a RuleBook>) -> Result<Refiner<'a>, NotRefinable> {
        let told = scheme.passes().into_iter();
        let passes = told.map(|told| PassRefiner::new(scheme, told, boundary)).collect::<Result<_, _>>()?;
        let cycle = super::cycle_of(scheme)?;
        let flatness = boundary.filter(|book| book.tells_flatness()).map(|_| Arc::default());
        Ok(Refiner { scheme, boundary, passes, cycle, flatness })
    }

    /// The same with the flatness that the boundary file tells, for the kinds of vertices that meshes will have
    /// ([`crate::analysis::boundary::flatness::of`]); where the file tells none, nothing is moved.
    #[must_use]
    pub fn with_flatness(self, flatness: Flatness) -> Refiner<'a> {
        Refiner { flatness: self.flatness.map(|_| Arc::new(flatness)), ..self }
    }

    /// Whether points of a mesh may be moved after a step.
    pub fn moves_points(&self, mesh: &HalfEdgeMesh, tags: &Tags) -> bool {
        self.flatness.is_some() && !(tags.is_empty() && mesh.is_closed())
    }

    /// How points of a mesh that a step has made are moved.
    fn moved(&self, mesh: &HalfEdgeMesh, tags: &Tags) -> Result<BTreeMap<u32, Row<u32, f64>>, NotRefinable> {
        self.flatness.as_ref().map_or(Ok(BTreeMap::new()), |flatness| flatness.rows(mesh, tags))
    }

    /// The scheme.
    pub fn scheme(&self) -> &'a Scheme {
        self.scheme
    }

    /// The rules of the boundary file.
    pub fn boundary(&self) -> Option<&'a RuleBook> {
        self.boundary
    }

    /// The splits of a step.
    pub fn splits(&self) -> impl Iterator<Item = Split> {
        self.passes.iter().map(|pass| pass.split)
    }

    /// Whether extraordinary points are faces.
    pub fn is_dual(&self) -> bool {
        !self.cycle.lattice().has_centre()
    }

    /// The number of steps that bring the regular lattice back to itself.
    pub fn steps_of_cycle(&self) -> usize {
        self.cycle.steps
    }

    /// Whether the boundary recedes.
    pub fn recedes(&self) -> bool {
        self.splits().any(Split::recedes)
    }

    /// Whether the boundary is refined by rules of its own, and stands as it did after the steps of a cycle.
    pub fn keeps_boundary(&self) -> bool {
        self.cycle.keeps_boundary()
    }

    /// Whether edges are halved or stay in every step, so that there can be creases inside a mesh.
    pub fn keeps_edges(&self) -> bool {
        self.cycle.keeps_edges()
    }

    /// Whether points near a boundary or crease depend on which vertices there are special: rules are told from these.
    pub fn tells_from_ends(&self) -> bool {
        self.boundary.is_some_and(RuleBook::tells_from_ends)
    }

    /// Whether every rule of the scheme inside the mesh is compact, so that points can be gathered.
    pub fn is_compact(&self) -> bool {
        matches!(self.passes.as_slice(), [pass] if pass.is_compact())
    }

    /// The parts of a mesh with these tags after a step.
    pub fn counts_after(&self, counts: Counts, tags: &Tags) -> Counts {
        self.splits().map(|split| split.at(tags)).fold(counts, Counts::after)
    }

    /// The most bytes that are in use at one time during a step.
    pub fn bytes_of_step<T: Coordinate>(&self, mut counts: Counts) -> u128 {
        let mut most = 0;
        for split in self.splits() {
            most = most.max(counts.bytes_of_step::<T>(split));
            counts = counts.after(split);
        }
        most
    }

    /// Checks that a step can be applied to a mesh.
    ///
    /// # Errors
    /// The first face that is not fit.
    pub fn fits(&self, mesh: &HalfEdgeMesh, tags: &Tags) -> Result<(), NotRefinable> {
        let needed = match self.scheme.mesh.as_str() {
            "triangles" => 3,
            "quads" => 4,
            _ => return self.passes.iter().take(1).try_for_each(|pass| pass.fits(mesh, tags)),
        };
        let odd = mesh.faces().iter().enumerate().find(|(_, face)| face.len() != needed);
        match odd.filter(|_| mesh.faces().same_size() != Some(needed as u32)) {
            Some((face, corners)) => Err(NotRefinable::Face { face, corners: corners.len(), needed }),
            None => self.passes.iter().take(1).try_for_each(|pass| pass.fits(mesh, tags)),
        }
    }

    /// One step.
    ///
    /// # Errors
    /// When a split can't be applied, the new mesh is too large, or a point can't be made.
    pub fn step<T: Coordinate>(&self, level: &Level<T>, route: Route) -> Result<Level<T>, NotRefinable> {
        self.step_tracing(level, route, &mut [])
    }

    /// One step, in which some vertices and faces are followed: what they become, `None` where nothing.
    ///
    /// # Errors
    /// As [`Refiner::step`].
    pub fn step_tracing<T: Coordinate>(
        &self,
        level: &Level<T>,
        route: Route,
        centres: &mut [Option<Centre>],
    ) -> Result<Level<T>, NotRefinable> {
        self.fits(&level.mesh, &level.tags)?;
        let mut at = Cow::Borrowed(level);
        for pass in &self.passes {
            if !centres.is_empty() {
                let becoming = pass.split.at(&at.tags).becoming(&at.mesh);
                centres.iter_mut().for_each(|centre| *centre = centre.and_then(|own| becoming.of(own)));
            }
            at = Cow::Owned(pass.step(&at, route)?);
        }
        let mut made = at.into_owned();
        if let Some(flatness) = &self.flatness {
            flatness.apply(&mut made)?;
        }
        Ok(made)
    }

    /// A step whose mesh is needed to move points, but not afterwards.
    fn moved_step<T: Coordinate>(&self, level: &Level<T>, route: Route) -> Result<Refined<T>, NotRefinable> {
        let Level { mesh, positions, .. } = self.step(level, route)?;
        Ok(Refined { faces: mesh.faces().clone(), positions })
    }

    /// The level before the last pass.
    fn before_last<'l, T: Coordinate>(
        &self,
        level: &'l Level<T>,
        route: Route,
    ) -> Result<Cow<'l, Level<T>>, NotRefinable> {
        self.fits(&level.mesh, &level.tags)?;
        let mut at = Cow::Borrowed(level);
        for pass in &self.passes[..self.passes.len() - 1] {
            at = Cow::Owned(pass.step(&at, route)?);
        }
        Ok(at)
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
        if self.moves_points(&level.mesh, &level.tags) {
            return self.moved_step(level, route);
        }
        let before = self.before_last(level, route)?;
        self.last_pass().last_step_in(&before, route, buffers)
    }

    /// A last step that uses its level up: what the faces don't need is given back before they are made.
    ///
    /// # Errors
    /// As [`Refiner::step`].
    pub fn finish<T: Coordinate>(&self, level: Level<T>, route: Route) -> Result<Refined<T>, NotRefinable> {
        if self.moves_points(&level.mesh, &level.tags) {
            return self.moved_step(&level, route);
        }
        if self.passes.len() == 1 {
            self.fits(&level.mesh, &level.tags)?;
            return self.last_pass().finish(level, route);
        }
        let before = self.before_last(&level, route)?.into_owned();
        drop(level);
        self.last_pass().finish(before, route)
    }

    fn last_pass(&self) -> &PassRefiner<'a> {
        &self.passes[self.passes.len() - 1]
    }

    /// The rows of all new points of a step, in order: how each is made of the old ones.
    ///
    /// # Errors
    /// As [`Refiner::step`].
    pub fn rows(&self, mesh: &HalfEdgeMesh, tags: &Tags) -> Result<Vec<Row<u32, f64>>, NotRefinable> {
        self.fits(mesh, tags)?;
        let chain = self.chain(mesh, tags, 1)?;
        (0..chain.mesh.vertices() as u32).map(|point| chain.row(point)).collect()
    }

    /// The meshes of some steps.
    ///
    /// # Errors
    /// When a split can't be applied, or the new mesh is too large.
    pub fn chain(&self, mesh: &HalfEdgeMesh, tags: &Tags, steps: usize) -> Result<Chain<'a>, NotRefinable> {
        let mut chain = Chain { links: Vec::new(), mesh: mesh.clone(), tags: tags.clone() };
        for (index, pass) in self.passes.iter().cycle().take(self.passes.len() * steps).enumerate() {
            let split = pass.split.at(&chain.tags);
            split.new_corners(&chain.mesh)?;
            let numbering = split.numbering(&chain.mesh, Numbering::default());
            let faces = split.faces(&chain.mesh, &numbering, Vec::new());
            let mesh = split.mesh(&chain.mesh, &numbering, faces)?;
            let tags = split.tags(&chain.mesh, &chain.tags, &mesh);
            let old = (std::mem::replace(&mut chain.mesh, mesh), std::mem::replace(&mut chain.tags, tags));
            let last = (index + 1) % self.passes.len() == 0;
            let moved = if last { self.moved(&chain.mesh, &chain.tags)? } else { BTreeMap::new() };
            chain.links.push(Link { split, rules: pass.rules(), mesh: old.0, tags: old.1, numbering, moved });
        }
        Ok(chain)
    }
}

/// One pass of a chain, with the mesh that it starts from.
struct Link<'a> {
    split: Split,
    rules: Pass<'a, f64>,
    mesh: HalfEdgeMesh,
    tags: Tags,
    numbering: Numbering,
    /// The points of the next mesh that are moved once they are made.
    moved: BTreeMap<u32, Row<u32, f64>>,
}

/// The meshes of some steps, without positions.
pub struct Chain<'a> {
    links: Vec<Link<'a>>,
    /// The last mesh.
    pub mesh: HalfEdgeMesh,
    /// Its tags.
    pub tags: Tags,
}

impl Chain<'_> {
    /// How a point of the last mesh is made of those of the first.
    ///
    /// # Errors
    /// When a point can't be made.
    pub fn row(&self, point: u32) -> Result<Row<u32, f64>, NotRefinable> {
        let mut row = vec![(point, 1.0)];
        for (index, link) in self.links.iter().enumerate().rev() {
            let born = |point: u32| {
                let birth = link.split.birth(&link.mesh, &link.numbering, point as usize);
                let row = link.rules.row_of_birth(&link.mesh, &link.tags, birth);
                // vertices of meshes between are nobody's
                row.map_err(|o| if index == 0 { standing_at(&link.mesh, birth, o) } else { o.into() })
            };
            if !link.moved.is_empty() {
                let own = |point: u32| link.moved.get(&point).cloned().unwrap_or_else(|| vec![(point, 1.0)]);
                row = composed(row, |point| Ok(own(point)))?;
            }
            row = composed(row, born)?;
        }
        Ok(row)
    }

    /// What a vertex or face of the first mesh becomes in the last.
    pub fn becomes(&self, centre: Centre) -> Option<Centre> {
        self.links.iter().try_fold(centre, |centre, link| link.split.becoming(&link.mesh).of(centre))
    }

    /// The point on an edge of the first mesh, as the first pass numbers it; `None` where the splits are not such that a point of an edge
    /// stays where it is.
    pub fn point_on_edge(&self, first_corner: u32) -> Option<u32> {
        let [link, rest @ ..] = self.links.as_slice() else { return None };
        let stays = rest.iter().all(|link| link.split == Split::Keep);
        let on_edges = matches!(link.split, Split::OneToFour | Split::OneToN) && stays;
        on_edges.then(|| link.mesh.vertices() as u32 + link.numbering.of_first(first_corner))
    }
}

/// A row of points each of which is a row itself.
fn composed(
    row: Row<u32, f64>,
    of: impl Fn(u32) -> Result<Row<u32, f64>, NotRefinable>,
) -> Result<Row<u32, f64>, NotRefinable> {
    if let [(only, 1.0)] = row.as_slice() {
        return of(*only);
    }
    let mut sum = Vec::new();
    for (point, weight) in &row {
        add_scaled(&mut sum, &of(*point)?, weight).map_err(Obstacle::from)?;
    }
    Ok(collected(sum)?)
}
