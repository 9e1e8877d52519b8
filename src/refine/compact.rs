//! Which rules are compact: one weight for a whole class of near neighbours?
//!
//! Told by which positions a rule uses, never by the scheme's name: at a vertex itself, its ring, its diagonals, the new face
//! points around it; at an edge its ends, the vertices across, the other vertices of its quads, the new face points beside it; at a
//! face its corners; at a corner any weights of the face's corners. All else goes the general way.

use super::Pass;
use super::gather::{AtEdge, AtVertex, Coordinate};
use super::pass::{Term, Terms};
use crate::scheme::vocabulary::{Arrival, Move, RuleKind};
use std::collections::BTreeSet;

/// Valences, and sizes of faces under dual splits, up to this have a place in the tables; other faces whatever their size.
const TABLE: usize = 64;

/// The weights of a scheme's interior rules, by valence.
#[derive(Clone, Debug)]
pub(super) struct Compact<T> {
    pub(super) vertex: Vec<Option<AtVertex<T>>>,
    pub(super) edge: AtEdge<T>,
    pub(super) face: Vec<Option<T>>,
    pub(super) corner: Vec<Option<Vec<T>>>,
}

/// How a walk of a compact rule starts and ends.
type Class = (&'static [Move], Arrival);

const CENTRE: Class = (&[], Arrival::Origin);
const RING: Class = (&[], Arrival::Target);
const ACROSS: Class = (&[Move::Next], Arrival::Target);
const BEFORE: Class = (&[Move::Prev], Arrival::Origin);
const NEW_FACE: Class = (&[], Arrival::NewFace);

impl<T: Coordinate> Compact<T> {
    /// The tables, where every rule of the scheme inside the mesh is compact; that of faces for these sizes.
    pub(super) fn of(pass: &Pass<f64>, sizes: &BTreeSet<usize>) -> Option<Compact<T>> {
        let rules = pass.rules();
        if !pass.is_gathered() {
            return None;
        }
        let has = |kind| rules.contains_key(&kind);
        if has(RuleKind::EdgeFromIrregularEnd) {
            return None;
        }
        let edge = if has(RuleKind::Edge) { at_edge(pass)? } else { AtEdge::default() };
        let vertex: Vec<_> = (0..=TABLE).map(|n| at_vertex(pass, n)).collect();
        let largest = sizes.last().copied().unwrap_or(4).max(4);
        let wanted = |n: &usize| *n == 4 || sizes.contains(n);
        let face: Vec<_> = (0..=largest).map(|n| Some(n).filter(wanted).and_then(|n| at_face(pass, n))).collect();
        let corner: Vec<_> = (0..=TABLE).map(|n| at_corner(pass, n)).collect();
        let regular = pass.scheme().regular_valence();
        let missing = (has(RuleKind::Vertex) && vertex[regular].is_none())
            || (has(RuleKind::Face) && face[4].is_none())
            || (has(RuleKind::Corner) && corner[4].is_none());
        (!missing).then_some(Compact { vertex, edge, face, corner })
    }
}

/// The weights of the terms of a rule, class by class: `None` when a term is of no class, or the points of a class differ.
fn by_class<const N: usize>(terms: &[Term<f64>], classes: [(Class, usize); N]) -> Option<[f64; N]> {
    let mut weights = [0.0; N];
    let mut counted = 0;
    for (index, (class, size)) in classes.iter().enumerate() {
        let of_class = |term: &&Term<f64>| match term.walk.ways.as_slice() {
            [way] => (way.as_slice(), term.walk.arrival) == *class,
            _ => false,
        };
        let mut by_start = vec![0.0; *size];
        for term in terms.iter().filter(of_class) {
            *by_start.get_mut(term.start)? += term.weight;
            counted += 1;
        }
        weights[index] = by_start.first().copied().unwrap_or(0.0);
        if by_start.iter().any(|weight| *weight != weights[index]) {
            return None;
        }
    }
    (counted == terms.len()).then_some(weights)
}

/// The terms of a rule, where its scheme has it and the count is one of a mesh.
fn told<'a>(pass: &Pass<'a, f64>, kind: RuleKind, n: usize, least: usize) -> Option<Terms<'a, f64>> {
    if n < least { None } else { pass.terms(kind, n).ok() }
}

fn at_vertex<T: Coordinate>(pass: &Pass<f64>, n: usize) -> Option<AtVertex<T>> {
    let terms = told(pass, RuleKind::Vertex, n, 2)?;
    let classes = [(CENTRE, 1), (RING, n), (ACROSS, n), (NEW_FACE, n)];
    let [centre, ring, diagonals, faces] = by_class(&terms, classes)?.map(T::from_f64);
    Some(AtVertex { centre, ring, diagonals, faces })
}

fn at_edge<T: Coordinate>(pass: &Pass<f64>) -> Option<AtEdge<T>> {
    let terms = pass.terms(RuleKind::Edge, 0).ok()?;
    let triangles = pass.scheme().mesh == "triangles";
    let classes = [(CENTRE, 2), (ACROSS, 2), (BEFORE, 2), (NEW_FACE, 2)];
    let [ends, across, before, faces] = by_class(&terms, classes)?;
    // on triangles the vertex across is the one before; on quads both others must count alike
    let (opposite, sides) = if triangles { (across + before, 0.0) } else { (0.0, across) };
    if !triangles && across != before {
        return None;
    }
    let [ends, opposite, sides, faces] = [ends, opposite, sides, faces].map(T::from_f64);
    Some(AtEdge { ends, opposite, sides, faces })
}

fn at_face<T: Coordinate>(pass: &Pass<f64>, n: usize) -> Option<T> {
    let terms = told(pass, RuleKind::Face, n, 3)?;
    let [corners] = by_class(&terms, [(CENTRE, n)])?;
    Some(T::from_f64(corners))
}

fn at_corner<T: Coordinate>(pass: &Pass<f64>, n: usize) -> Option<Vec<T>> {
    let terms = told(pass, RuleKind::Corner, n, 3)?;
    let mut weights = vec![0.0; n];
    for term in terms.iter() {
        let own = matches!(term.walk.ways.as_slice(), [way] if way.is_empty()) && term.walk.arrival == Arrival::Origin;
        *weights.get_mut(term.start).filter(|_| own)? += term.weight;
    }
    Some(weights.into_iter().map(T::from_f64).collect())
}
