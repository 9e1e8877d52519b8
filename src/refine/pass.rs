//! How is a new point made from old ones by the rules of one pass?
//!
//! Rules are told around a place and name points by walks: a row is the weights of a rule with the points that its walks lead to. They are
//! the same rules on the canonical patch and on a mesh of polygons.

use super::{Obstacle, Row};
use crate::mesh::{Connectivity, Lattice, PatchEdge, Site, Split};
use crate::numbers::{Field, Number, Trouble};
use crate::scheme::vocabulary::{Arrival, Move, RuleKind, Walk};
use crate::scheme::{Entry, PassRules, Place, Rule, RuleBook, Scheme};
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// A weight of a rule: the half-edge around its place to start from, the walk, the weight.
pub(super) struct Term<'a, W> {
    pub(super) start: usize,
    pub(super) walk: &'a Walk,
    pub(super) weight: W,
}

/// The terms of a rule at one count.
pub(super) type Terms<'a, W> = Rc<Vec<Term<'a, W>>>;

/// What the weights of a rule are, in a world of numbers.
pub trait Weigher<W> {
    /// The points of a rule's entry, as indices into its class, with their weights, where the rule's count is `count`, in a pass that starts
    /// from a lattice.
    ///
    /// # Errors
    /// When a weight has no value in this world.
    fn weights(
        &self,
        book: &RuleBook,
        entry: &Entry,
        kind: RuleKind,
        count: usize,
        on: Lattice,
    ) -> Result<Vec<(usize, W)>, Obstacle>;
}

/// The weights are the values of the formulas, point by point.
pub(super) struct ByFormula;

impl<W: Number> Weigher<W> for ByFormula {
    fn weights(
        &self,
        book: &RuleBook,
        entry: &Entry,
        kind: RuleKind,
        count: usize,
        _: Lattice,
    ) -> Result<Vec<(usize, W)>, Obstacle> {
        let place = Place::<W>::at(kind.variable(), count as i64);
        let size = crate::scheme::class_size(entry, kind, count as i64);
        Ok(book.weights(entry, size, &place)?)
    }
}

/// The rules of one pass in one world of numbers.
pub struct Pass<'a, W> {
    pub(super) scheme: &'a Scheme,
    told: PassRules<'a>,
    pub(super) boundary: Option<&'a RuleBook>,
    weigher: Rc<dyn Weigher<W> + 'a>,
    /// Whether the boundary recedes in a step: rules inside the mesh hold on it, too, as far as they don't reach over it.
    pub(super) recedes: bool,
    /// The lattice that it starts from, where it is applied to the canonical patch.
    on: Lattice,
    terms: RefCell<HashMap<(RuleKind, usize), Terms<'a, W>>>,
}

impl<'a, W: Number> Pass<'a, W> {
    /// The rules of a pass of a scheme, with those of a boundary file where there is one.
    pub fn new(scheme: &'a Scheme, told: PassRules<'a>, boundary: Option<&'a RuleBook>) -> Self {
        Pass { boundary, ..Pass::weighed(scheme, told, Rc::new(ByFormula)) }
    }
}

impl<'a, W: Field> Pass<'a, W> {
    /// The rules of a pass, with weights from elsewhere than its formulas alone.
    pub(super) fn weighed(scheme: &'a Scheme, told: PassRules<'a>, weigher: Rc<dyn Weigher<W> + 'a>) -> Self {
        let on = if scheme.mesh == "triangles" { Lattice::Triangles } else { Lattice::Quads };
        let splits = scheme.passes();
        let recedes = splits.iter().any(|pass| Split::named(pass.split).is_some_and(Split::recedes));
        Pass { scheme, told, boundary: None, weigher, recedes, on, terms: RefCell::new(HashMap::new()) }
    }

    /// The same on a lattice.
    pub(super) fn on(self, lattice: Lattice) -> Self {
        Pass { on: lattice, ..self }
    }

    /// The same with the rules of a boundary file.
    pub(super) fn with_boundary(self, book: &'a RuleBook) -> Self {
        Pass { boundary: Some(book), ..self }
    }

    /// The scheme that it belongs to.
    pub fn scheme(&self) -> &'a Scheme {
        self.scheme
    }

    /// Whether its split is one of those that new points are gathered for.
    pub(super) fn is_gathered(&self) -> bool {
        matches!(Split::named(self.told.split), Some(Split::OneToFour | Split::OneToN | Split::Dual))
    }

    /// Its rules inside the mesh.
    pub fn rules(&self) -> &'a BTreeMap<RuleKind, Rule> {
        self.told.rules
    }

    /// The row of the point that is born at a site of the patch.
    ///
    /// # Errors
    /// When a weight has no value, or the rule reaches over a boundary.
    pub fn row_at<M>(&self, mesh: &M, site: Site) -> Result<Row<M::Point, W>, Obstacle>
    where
        M: Connectivity<Edge = PatchEdge>,
    {
        match site {
            Site::Vertex(edge) => self.vertex_row(mesh, edge),
            Site::Edge(edge) => self.edge_row(mesh, edge),
            Site::Face(edge) => self.face_row(mesh, edge),
            Site::Corner(edge) => self.corner_row(mesh, edge),
            Site::Kept(edge) => Ok(vec![(mesh.origin(edge), W::whole(1))]),
            Site::Third(edge) => self.third_row(mesh, edge),
        }
    }

    /// The row of the point that replaces the origin of `edge`: by the rule `[vertex]` where at most one crease ends there, by
    /// `[vertex.crease]`, told around one side, where one passes through, by `[vertex.corner]` where three or more meet or the
    /// vertex is tagged so. A boundary is a crease with nothing beyond it.
    ///
    /// # Errors
    /// As [`Pass::row_at`].
    pub fn vertex_row<M: Connectivity>(&self, mesh: &M, edge: M::Edge) -> Result<Row<M::Point, W>, Obstacle> {
        let sharp = if self.recedes { Vec::new() } else { mesh.sharp_spokes(edge) };
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

    /// The row of the new point on an edge. A rule told from a special end is applied from each such end, and the results
    /// are averaged.
    ///
    /// # Errors
    /// As [`Pass::row_at`].
    pub fn edge_row<M: Connectivity>(&self, mesh: &M, edge: M::Edge) -> Result<Row<M::Point, W>, Obstacle> {
        self.row_from_ends(mesh, [edge, mesh.twin(edge)])
    }

    /// The row of the new point in the face to the left of `edge`.
    ///
    /// # Errors
    /// As [`Pass::row_at`].
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
    /// As [`Pass::row_at`].
    pub fn corner_row<M: Connectivity>(&self, mesh: &M, edge: M::Edge) -> Result<Row<M::Point, W>, Obstacle> {
        if !mesh.has_face(edge) {
            return Err(Obstacle::Boundary(RuleKind::Corner.name()));
        }
        let corners = mesh.around_face(edge);
        self.apply(mesh, RuleKind::Corner, corners.len(), &corners)
    }

    /// The row of the new point on an edge of the boundary, at the third that is nearer to the origin of `edge`: told around the boundary's two
    /// half-edges there, the one to the far end first; from a corner by a rule of its own, where there is one.
    ///
    /// # Errors
    /// As [`Pass::row_at`].
    pub fn third_row<M: Connectivity>(&self, mesh: &M, edge: M::Edge) -> Result<Row<M::Point, W>, Obstacle> {
        if mesh.is_corner(edge) && self.rule(RuleKind::ThirdFromCorner).is_ok() {
            return self.apply(mesh, RuleKind::ThirdFromCorner, 0, &[edge]);
        }
        let beyond = if mesh.has_face(edge) { mesh.turn_back(edge) } else { mesh.turn(edge) };
        self.apply(mesh, RuleKind::CreaseThird, 0, &[edge, beyond])
    }

    pub(super) fn apply<M: Connectivity>(
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

    pub(super) fn rule(&self, kind: RuleKind) -> Result<(&'a RuleBook, &'a Rule), Obstacle> {
        let rule = if kind.is_boundary() {
            self.boundary.and_then(|book| book.told(kind))
        } else {
            self.rules().get(&kind).map(|rule| (&self.scheme.book, rule))
        };
        rule.ok_or(Obstacle::NoRule(kind.name()))
    }

    pub(super) fn terms(&self, kind: RuleKind, count: usize) -> Result<Terms<'a, W>, Obstacle> {
        if let Some(terms) = self.terms.borrow().get(&(kind, count)) {
            return Ok(Rc::clone(terms));
        }
        let (book, rule) = self.rule(kind)?;
        let mut terms = Vec::new();
        for entry in &rule.entries {
            let walks = &entry.position.walks;
            for (index, weight) in self.weigher.weights(book, entry, kind, count, self.on)? {
                terms.push(Term { start: index / walks.len(), walk: &walks[index % walks.len()], weight });
            }
        }
        terms.retain(|term| !term.weight.is_certainly_zero());
        let terms = Rc::new(terms);
        self.terms.borrow_mut().insert((kind, count), Rc::clone(&terms));
        Ok(terms)
    }

    /// Where a walk leads: half-edges, each with the number of times that the way to it has forked. A fork halves the weight.
    pub(super) fn walk<M: Connectivity>(
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
    pub(super) fn step<M: Connectivity>(
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

pub(super) fn add_scaled<P: Copy, W: Field>(sum: &mut Vec<(P, W)>, row: &Row<P, W>, factor: &W) -> Result<(), Trouble> {
    for (point, weight) in row {
        sum.push((*point, weight.times(factor)?));
    }
    Ok(())
}

/// Weights that fall on one point add up.
pub(super) fn collected<P: Copy + Ord, W: Field>(mut sum: Vec<(P, W)>) -> Result<Row<P, W>, Obstacle> {
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
