//! From which of its ends is the rule of an edge told?
//!
//! An edge may have a rule of its own near a special vertex: an irregular one inside the mesh, one that a crease passes through, a
//! corner, a dart. Where both ends are special the edge is told from each, and its point is the mean of the two. Which rules there are
//! the files say; where there is none the plain rule holds.

use super::pass::{add_scaled, collected};
use super::{Pass, Row};
use crate::mesh::Connectivity;
use crate::numbers::Field;
use crate::refine::Obstacle;
use crate::scheme::RuleBook;
use crate::scheme::vocabulary::RuleKind;

/// A rule told from an end of an edge: its kind, its count and its half-edges.
struct End<E> {
    kind: RuleKind,
    count: usize,
    starts: Vec<E>,
}

/// Whether the origin of a half-edge has a rule for the edge.
type EndRule<R, M> = fn(&R, &M, <M as Connectivity>::Edge) -> Option<End<<M as Connectivity>::Edge>>;

impl<W: Field> Pass<'_, W> {
    /// The row of the new point on an edge, by the rule from its special ends or by the plain one.
    pub(super) fn row_from_ends<M: Connectivity>(
        &self,
        mesh: &M,
        halves: [M::Edge; 2],
    ) -> Result<Row<M::Point, W>, Obstacle> {
        // a boundary that recedes is made by the rules inside
        let sharp = mesh.is_sharp(halves[0]) && !self.recedes;
        let plain = if sharp { RuleKind::EdgeCrease } else { RuleKind::Edge };
        if !self.tells_from_ends() {
            return self.apply(mesh, plain, 0, &halves);
        }
        let of_crease = [Self::dart_of_crease, Self::irregular_end_of_crease];
        let ends = |rule: EndRule<Self, M>| -> Vec<End<M::Edge>> {
            halves.iter().filter_map(|half| rule(self, mesh, *half)).collect()
        };
        let ends = match sharp {
            true => of_crease.into_iter().map(ends).find(|ends| !ends.is_empty()).unwrap_or_default(),
            false => ends(Self::end_inside),
        };
        if ends.is_empty() {
            return self.apply(mesh, plain, 0, &halves);
        }
        let share = W::whole(1).over(&W::whole(ends.len() as i64))?;
        let mut sum = Vec::new();
        for end in ends {
            let row = self.apply(mesh, end.kind, end.count, &end.starts)?;
            add_scaled(&mut sum, &row, &share)?;
        }
        collected(sum)
    }

    /// Whether there are rules from ends at all.
    fn tells_from_ends(&self) -> bool {
        self.rules().contains_key(&RuleKind::EdgeFromIrregularEnd) || self.has_rules_from_sharp_ends()
    }

    /// Whether there are rules from ends on a boundary or a crease.
    pub(super) fn has_rules_from_sharp_ends(&self) -> bool {
        self.boundary.is_some_and(RuleBook::tells_from_ends)
    }

    /// Whether a file has a rule.
    fn has(&self, kind: RuleKind) -> bool {
        self.rule(kind).is_ok()
    }

    /// The origin of a crease edge, where the crease ends there and has a rule for it.
    fn dart_of_crease<M: Connectivity>(&self, mesh: &M, half: M::Edge) -> Option<End<M::Edge>> {
        let kind = RuleKind::CreaseFromDartEnd;
        let ends = self.has(kind) && mesh.sharp_spokes(half).len() == 1 && !mesh.is_corner(half);
        ends.then(|| End { kind, count: mesh.valence(half), starts: beside(mesh, half) })
    }

    /// The origin of a crease edge, where it is a corner or has a side with an irregular number of faces, and there is a rule for it.
    fn irregular_end_of_crease<M: Connectivity>(&self, mesh: &M, half: M::Edge) -> Option<End<M::Edge>> {
        let kind = RuleKind::CreaseFromIrregularEnd;
        let irregular = self.has(kind) && (is_corner(mesh, half) || self.has_irregular_side(mesh, half));
        irregular.then(|| End { kind, count: 0, starts: vec![half] })
    }

    /// The origin of an edge inside, where it is special and there is a rule for it.
    fn end_inside<M: Connectivity>(&self, mesh: &M, half: M::Edge) -> Option<End<M::Edge>> {
        let sharp = if self.recedes { 0 } else { mesh.sharp_spokes(half).len() };
        let kind = match sharp {
            0 => None,
            1 => Some(RuleKind::EdgeFromDartEnd).filter(|_| !mesh.is_corner(half)),
            _ if is_corner(mesh, half) => Some(RuleKind::EdgeFromCornerEnd),
            _ => Some(RuleKind::EdgeFromCreaseEnd),
        };
        if let Some(kind) = kind.filter(|kind| self.has(*kind)) {
            let count = if sharp == 1 { mesh.valence(half) } else { faces_of_side(mesh, half) };
            return Some(End { kind, count, starts: beside(mesh, half) });
        }
        let kind = RuleKind::EdgeFromIrregularEnd;
        let irregular = sharp < 2 && self.has(kind) && mesh.valence(half) != self.scheme.regular_valence();
        let spokes = irregular.then(|| mesh.around_vertex(half))?;
        Some(End { kind, count: spokes.len(), starts: spokes })
    }

    /// Whether a side of a vertex on a crease has a number of faces that is not the regular one.
    fn has_irregular_side<M: Connectivity>(&self, mesh: &M, half: M::Edge) -> bool {
        let spokes = mesh.around_vertex(half);
        let regular = self.scheme.regular_valence() / 2;
        let first = spokes.iter().position(|spoke| mesh.is_sharp(*spoke)).unwrap_or(0);
        let faces = |side: &[M::Edge]| side.iter().filter(|spoke| mesh.has_face(**spoke)).count();
        let turned: Vec<M::Edge> = spokes[first..].iter().chain(&spokes[..first]).copied().collect();
        let mut sides = turned.chunk_by(|_, next| !mesh.is_sharp(*next)).map(faces);
        sides.any(|faces| faces != 0 && faces != regular)
    }
}

/// Whether the origin of a half-edge is a corner: tagged so, or the end of three creases or more.
fn is_corner<M: Connectivity>(mesh: &M, half: M::Edge) -> bool {
    mesh.is_corner(half) || mesh.sharp_spokes(half).len() > 2
}

/// A half-edge, and those beside it: counter-clockwise, clockwise.
fn beside<M: Connectivity>(mesh: &M, half: M::Edge) -> Vec<M::Edge> {
    vec![half, mesh.turn(half), mesh.turn_back(half)]
}

/// The number of faces between the two sharp edges on either side of a half-edge at its origin.
fn faces_of_side<M: Connectivity>(mesh: &M, half: M::Edge) -> usize {
    let spokes = mesh.around_vertex(half);
    let sharp = |spoke: &M::Edge| mesh.is_sharp(*spoke);
    let ahead = spokes.iter().position(sharp).unwrap_or(spokes.len());
    let behind = spokes.iter().rev().position(sharp).map_or(0, |behind| behind + 1);
    ahead + behind
}
