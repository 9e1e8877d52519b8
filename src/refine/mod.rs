//! How is each new point made from old ones?
//!
//! The one place where weights meet topology: scheme x mesh -> rows of weights. A row on the canonical patch is a row of
//! the local subdivision matrix; rows times positions are the refined mesh ([`Refiner`]).

mod births;
mod compact;
pub mod curve;
mod exact_weights;
mod gather;
pub mod grid;
mod growth;
mod names;
mod regular;
mod stencil;
mod steps;
mod symmetry;

pub use exact_weights::{Count, EnclosedWeights, ExactWeights};
pub use gather::{Coordinate, Point};
pub use growth::Counts;
pub use names::OrbitNames;
pub use regular::{CanonicalRows, FanRows, PatchRows, RegularStencils};
pub use stencil::Use;
pub use steps::{Buffers, Level, NotRefinable, Refined, Refiner, Route, applied, most_ulps};
pub use symmetry::check_symmetry;

use crate::fault::{Fault, Faults};
use crate::mesh::{Connectivity, Lattice, Site};
use crate::numbers::{Field, Number, Trouble};
use crate::scheme::vocabulary::{Arrival, Move, RuleKind, Walk};
use crate::scheme::{Entry, Place, Rule, RuleBook, RuleSum, Scheme};
use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt;
use std::rc::Rc;

/// A new point as a combination of old ones: in order of the points, none twice, none with weight zero.
pub type Row<P, W> = Vec<(P, W)>;

/// Why a new point can't be made here.
#[derive(Clone, Debug, PartialEq)]
pub enum Obstacle {
    /// A formula has no value at this valence.
    Fault(Fault),
    /// An operation on weights left their world of numbers.
    Trouble(Trouble),
    /// The rule reaches over the boundary of the mesh.
    Boundary(&'static str),
    /// The scheme, or its boundary file, has no rule for such a place.
    NoRule(&'static str),
    /// The request is beyond a stated limit, as said.
    Limit(String),
    /// A formula has a value, but not in this exact world, as said.
    Inexact(Fault),
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Obstacle::Fault(fault) | Obstacle::Inexact(fault) => f.write_str(&fault.message),
            Obstacle::Trouble(trouble) => write!(f, "{trouble}"),
            Obstacle::Boundary(rule) => write!(f, "the rule [{rule}] reaches over the boundary of the mesh"),
            Obstacle::NoRule(rule) => write!(f, "a rule [{rule}] is needed here, and there is none"),
            Obstacle::Limit(what) => f.write_str(what),
        }
    }
}

impl std::error::Error for Obstacle {}

impl From<Fault> for Obstacle {
    fn from(fault: Fault) -> Self {
        Obstacle::Fault(fault)
    }
}

impl From<Trouble> for Obstacle {
    fn from(trouble: Trouble) -> Self {
        Obstacle::Trouble(trouble)
    }
}

/// Checks a scheme as far as it can be checked before its analysis: sums, cases and values ([`Scheme::check`]) and symmetry
/// ([`check_symmetry`]), at the valences asked for.
///
/// # Errors
/// Every fault found.
pub fn check(scheme: &Scheme, valences: &[usize]) -> Result<Vec<RuleSum>, Faults> {
    match (scheme.check(valences), check_symmetry(scheme, valences)) {
        (Ok(sums), Ok(())) => Ok(sums),
        (Ok(_), Err(faults)) | (Err(faults), Ok(())) => Err(faults),
        (Err(mut faults), Err(more)) => {
            let new =
                more.faults.into_iter().filter(|fault| faults.faults.iter().all(|known| known.span != fault.span));
            faults.faults.extend(new.collect::<Vec<_>>());
            Err(faults)
        }
    }
}

/// The regular lattice that a scheme's split lives on.
pub fn lattice_of(scheme: &Scheme) -> Lattice {
    match (scheme.is_dual(), scheme.mesh.as_str()) {
        (true, _) => Lattice::Dual,
        (false, "triangles") => Lattice::Triangles,
        (false, _) => Lattice::Quads,
    }
}

/// A weight of a rule: the half-edge around its place to start from, the walk, the weight.
struct Term<'a, W> {
    start: usize,
    walk: &'a Walk,
    weight: W,
}

/// The terms of a rule at one count.
type Terms<'a, W> = Rc<Vec<Term<'a, W>>>;

/// What the weights of a rule are, in a world of numbers.
pub trait Weigher<W> {
    /// The points of a rule's entry, as indices into its class, with their weights, where the rule's count is `count`.
    ///
    /// # Errors
    /// When a weight has no value in this world.
    fn weights(
        &self,
        book: &RuleBook,
        entry: &Entry,
        kind: RuleKind,
        count: usize,
    ) -> Result<Vec<(usize, W)>, Obstacle>;
}

/// The weights are the values of the formulas, point by point.
struct ByFormula;

impl<W: Number> Weigher<W> for ByFormula {
    fn weights(
        &self,
        book: &RuleBook,
        entry: &Entry,
        kind: RuleKind,
        count: usize,
    ) -> Result<Vec<(usize, W)>, Obstacle> {
        let place = Place::<W>::at(kind.variable(), count as i64);
        let size = crate::scheme::class_size(entry, kind, count as i64);
        Ok(book.weights(entry, size, &place)?)
    }
}

/// A scheme's rules in one world of numbers, ready to be applied to a mesh.
pub struct Refinement<'a, W> {
    scheme: &'a Scheme,
    boundary: Option<&'a RuleBook>,
    weigher: Box<dyn Weigher<W> + 'a>,
    terms: RefCell<HashMap<(RuleKind, usize), Terms<'a, W>>>,
}

impl<'a, W: Number> Refinement<'a, W> {
    /// The scheme's rules, with those of a boundary file where there is one.
    pub fn new(scheme: &'a Scheme, boundary: Option<&'a RuleBook>) -> Self {
        Refinement { boundary, ..Refinement::weighed(scheme, ByFormula) }
    }
}

impl<'a, W: Field> Refinement<'a, W> {
    /// The scheme's rules, with weights from elsewhere than its formulas alone.
    pub fn weighed(scheme: &'a Scheme, weigher: impl Weigher<W> + 'a) -> Self {
        Refinement { scheme, boundary: None, weigher: Box::new(weigher), terms: RefCell::new(HashMap::new()) }
    }

    /// The same with the rules of a boundary file.
    pub fn with_boundary(self, book: &'a RuleBook) -> Self {
        Refinement { boundary: Some(book), ..self }
    }

    /// The scheme that is refined with.
    pub fn scheme(&self) -> &'a Scheme {
        self.scheme
    }

    /// The row of the point that is born at a site of the patch.
    ///
    /// # Errors
    /// When a weight has no value, or the rule reaches over a boundary.
    pub fn row_at<M>(&self, mesh: &M, site: Site) -> Result<Row<M::Point, W>, Obstacle>
    where
        M: Connectivity<Edge = crate::mesh::PatchEdge>,
    {
        match site {
            Site::Vertex(edge) => self.vertex_row(mesh, edge),
            Site::Edge(edge) => self.edge_row(mesh, edge),
            Site::Face(edge) => self.face_row(mesh, edge),
            Site::Corner(edge) => self.corner_row(mesh, edge),
        }
    }

    /// The row of the point that replaces the origin of `edge`: by the rule `[vertex]` where at most one crease ends there, by
    /// `[vertex.crease]`, told around one side, where one passes through, by `[vertex.corner]` where three or more meet or the
    /// vertex is tagged so. A boundary is a crease with nothing beyond it.
    ///
    /// # Errors
    /// As [`Refinement::row_at`].
    pub fn vertex_row<M: Connectivity>(&self, mesh: &M, edge: M::Edge) -> Result<Row<M::Point, W>, Obstacle> {
        let sharp = mesh.sharp_spokes(edge);
        if mesh.is_corner(edge) || sharp.len() > 2 {
            return self.apply(mesh, RuleKind::VertexCorner, 0, &[edge]);
        }
        let first = sharp.iter().find(|spoke| sharp.len() == 2 && mesh.has_face(**spoke));
        let Some(first) = first else {
            return self.apply(mesh, RuleKind::Vertex, mesh.valence(edge), &mesh.around_vertex(edge));
        };
        // the spokes of one side, from one crease edge to the other
        let mut spokes = mesh.around_vertex(*first);
        let faces = spokes.iter().skip(1).position(|spoke| mesh.is_sharp(*spoke)).map_or(0, |last| last + 1);
        spokes.truncate(faces + 1);
        self.apply(mesh, RuleKind::VertexCrease, faces, &spokes)
    }

    /// The row of the new point on an edge. A rule told from an irregular end is applied from each such end, and the results
    /// are averaged.
    ///
    /// # Errors
    /// As [`Refinement::row_at`].
    pub fn edge_row<M: Connectivity>(&self, mesh: &M, edge: M::Edge) -> Result<Row<M::Point, W>, Obstacle> {
        let halves = [edge, mesh.twin(edge)];
        if mesh.is_sharp(edge) {
            return self.apply(mesh, RuleKind::EdgeCrease, 0, &halves);
        }
        if self.scheme.book.rules.contains_key(&RuleKind::EdgeFromIrregularEnd) {
            let regular = self.scheme.regular_valence();
            let irregular = |half: &&M::Edge| mesh.valence(**half) != regular && mesh.sharp_spokes(**half).len() < 2;
            let ends: Vec<M::Edge> = halves.iter().filter(irregular).copied().collect();
            if !ends.is_empty() {
                return self.mean_from_ends(mesh, &ends);
            }
        }
        self.apply(mesh, RuleKind::Edge, 0, &halves)
    }

    fn mean_from_ends<M: Connectivity>(&self, mesh: &M, ends: &[M::Edge]) -> Result<Row<M::Point, W>, Obstacle> {
        let share = W::whole(1).over(&W::whole(ends.len() as i64))?;
        let mut sum = Vec::new();
        for end in ends {
            let spokes = mesh.around_vertex(*end);
            let row = self.apply(mesh, RuleKind::EdgeFromIrregularEnd, spokes.len(), &spokes)?;
            add_scaled(&mut sum, &row, &share)?;
        }
        collected(sum)
    }

    /// The row of the new point in the face to the left of `edge`.
    ///
    /// # Errors
    /// As [`Refinement::row_at`].
    pub fn face_row<M: Connectivity>(&self, mesh: &M, edge: M::Edge) -> Result<Row<M::Point, W>, Obstacle> {
        if !mesh.has_face(edge) {
            return Err(Obstacle::Boundary(RuleKind::Face.name()));
        }
        let corners = mesh.around_face(edge);
        self.apply(mesh, RuleKind::Face, corners.len(), &corners)
    }

    /// The row of the new point at the corner where `edge` leaves its origin, in the face to its left.
    ///
    /// # Errors
    /// As [`Refinement::row_at`].
    pub fn corner_row<M: Connectivity>(&self, mesh: &M, edge: M::Edge) -> Result<Row<M::Point, W>, Obstacle> {
        if !mesh.has_face(edge) {
            return Err(Obstacle::Boundary(RuleKind::Corner.name()));
        }
        let corners = mesh.around_face(edge);
        self.apply(mesh, RuleKind::Corner, corners.len(), &corners)
    }

    fn apply<M: Connectivity>(
        &self,
        mesh: &M,
        kind: RuleKind,
        count: usize,
        starts: &[M::Edge],
    ) -> Result<Row<M::Point, W>, Obstacle> {
        let mut sum = Vec::new();
        for term in self.terms(kind, count)?.iter() {
            for (edge, halvings) in self.walk(mesh, starts[term.start], term.walk, kind)? {
                let weight = (0..halvings).try_fold(term.weight.clone(), |weight, _| weight.over(&W::whole(2)))?;
                match term.walk.arrival {
                    Arrival::Origin => sum.push((mesh.origin(edge), weight)),
                    Arrival::Target => sum.push((mesh.target(edge), weight)),
                    Arrival::NewFace => add_scaled(&mut sum, &self.face_row(mesh, edge)?, &weight)?,
                    Arrival::NewEdge => add_scaled(&mut sum, &self.edge_row(mesh, edge)?, &weight)?,
                }
            }
        }
        collected(sum)
    }

    fn rule(&self, kind: RuleKind) -> Result<(&'a RuleBook, &'a Rule), Obstacle> {
        let book = if kind.is_boundary() { self.boundary } else { Some(&self.scheme.book) };
        let rule = book.and_then(|book| Some((book, book.rules.get(&kind)?)));
        rule.ok_or(Obstacle::NoRule(kind.name()))
    }

    fn terms(&self, kind: RuleKind, count: usize) -> Result<Terms<'a, W>, Obstacle> {
        if let Some(terms) = self.terms.borrow().get(&(kind, count)) {
            return Ok(Rc::clone(terms));
        }
        let (book, rule) = self.rule(kind)?;
        let mut terms = Vec::new();
        for entry in &rule.entries {
            let walks = &entry.position.walks;
            for (index, weight) in self.weigher.weights(book, entry, kind, count)? {
                terms.push(Term { start: index / walks.len(), walk: &walks[index % walks.len()], weight });
            }
        }
        terms.retain(|term| !term.weight.is_certainly_zero());
        let terms = Rc::new(terms);
        self.terms.borrow_mut().insert((kind, count), Rc::clone(&terms));
        Ok(terms)
    }

    /// Where a walk leads: half-edges, each with the number of times that the way to it has forked. A fork halves the weight.
    fn walk<M: Connectivity>(
        &self,
        mesh: &M,
        start: M::Edge,
        walk: &Walk,
        kind: RuleKind,
    ) -> Result<Vec<(M::Edge, u32)>, Obstacle> {
        let mut ends = Vec::with_capacity(walk.ways.len());
        for way in &walk.ways {
            let mut branches = vec![(start, walk.ways.len() as u32 - 1)];
            for step in way {
                self.step(mesh, &mut branches, *step, kind)?;
            }
            ends.extend(branches);
        }
        Ok(ends)
    }

    /// One move of every branch. Straight on over an irregular vertex is half of the regular number of turns, and either
    /// way round will do: the branch forks, so that left and right stay alike. A turn to the left of straight on is counted
    /// from the left, one to the right from the right.
    fn step<M: Connectivity>(
        &self,
        mesh: &M,
        branches: &mut Vec<(M::Edge, u32)>,
        step: Move,
        kind: RuleKind,
    ) -> Result<(), Obstacle> {
        let inside = |edge| if mesh.has_face(edge) { Ok(edge) } else { Err(Obstacle::Boundary(kind.name())) };
        let over = |edge| {
            let back = mesh.twin(edge);
            if mesh.boundary_at(back).is_none() { Ok(back) } else { Err(Obstacle::Boundary(kind.name())) }
        };
        let half = self.scheme.regular_valence() / 2;
        let turned = |edge, turns: usize| (0..turns).fold(edge, |edge, _| mesh.turn(edge));
        let turned_back = |edge, turns: usize| (0..turns).fold(edge, |edge, _| mesh.turn_back(edge));
        for index in 0..branches.len() {
            let (at, forks) = branches[index];
            branches[index].0 = match step {
                Move::Next => mesh.next(inside(at)?),
                Move::Prev => mesh.prev(inside(at)?),
                Move::Twin => mesh.twin(at),
                Move::Turn => mesh.turn(at),
                Move::Left => turned_back(over(at)?, half - 1),
                Move::Right => turned(over(at)?, half - 1),
                Move::On => {
                    let back = over(at)?;
                    if mesh.valence(back) != 2 * half {
                        branches[index].1 = forks + 1;
                        branches.push((turned_back(back, half), forks + 1));
                    }
                    turned(back, half)
                }
            };
        }
        if branches.len() > MOST_BRANCHES {
            return Err(Obstacle::Limit(format!("a walk forks into more than {MOST_BRANCHES} at irregular vertices")));
        }
        Ok(())
    }
}

/// The most branches of one walk.
const MOST_BRANCHES: usize = 256;

fn add_scaled<P: Copy, W: Field>(sum: &mut Vec<(P, W)>, row: &Row<P, W>, factor: &W) -> Result<(), Trouble> {
    for (point, weight) in row {
        sum.push((*point, weight.times(factor)?));
    }
    Ok(())
}

/// Weights that fall on one point add up.
fn collected<P: Copy + Ord, W: Field>(mut sum: Vec<(P, W)>) -> Result<Row<P, W>, Obstacle> {
    sum.sort_by_key(|(point, _)| *point);
    let groups = sum.chunk_by(|(a, _), (b, _)| a == b);
    let mut row: Row<P, W> = groups.map(|group| Ok((group[0].0, by_halves(group)?))).collect::<Result<_, Trouble>>()?;
    row.retain(|(_, weight)| !weight.is_certainly_zero());
    Ok(row)
}

/// A sum by halves: its rounding grows with the logarithm of the number of terms only.
fn by_halves<P, W: Field>(terms: &[(P, W)]) -> Result<W, Trouble> {
    match terms {
        [] => Ok(W::whole(0)),
        [(_, weight)] => Ok(weight.clone()),
        _ => {
            let (left, right) = terms.split_at(terms.len() / 2);
            by_halves(left)?.plus(&by_halves(right)?)
        }
    }
}
