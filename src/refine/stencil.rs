//! Which points does a rule use?
//!
//! The walks of a rule without its weights, for those who want to show a rule: each point that it gives a weight to, and the
//! half-edges that lead there.

use super::{Obstacle, Pass};
use crate::mesh::Connectivity;
use crate::numbers::Field;
use crate::scheme::class_size;
use crate::scheme::vocabulary::{Arrival, RuleKind};

/// A point that a rule uses.
#[derive(Clone, Debug)]
pub struct Use<E> {
    /// The row of the rule that names the point's class, an index into its entries.
    pub entry: usize,
    /// The point's index in its class, `j`.
    pub index: usize,
    /// The point that the last half-edge stands for.
    pub arrival: Arrival,
    /// The half-edge that the walk starts from, and where each of its moves leads (the first way, where there are two).
    pub path: Vec<E>,
}

impl<W: Field> Pass<'_, W> {
    /// Every point of the classes that a rule names, told around the half-edges `starts` of its place. Points that a row
    /// does not pick are among them.
    ///
    /// # Errors
    /// When the scheme has no such rule, or it reaches over a boundary.
    pub fn uses<M: Connectivity>(
        &self,
        mesh: &M,
        kind: RuleKind,
        starts: &[M::Edge],
    ) -> Result<Vec<Use<M::Edge>>, Obstacle> {
        let (_, rule) = self.rule(kind)?;
        let mut uses = Vec::new();
        for (entry, row) in rule.entries.iter().enumerate() {
            let walks = &row.position.walks;
            for index in 0..class_size(row, kind, starts.len() as i64) {
                let (Some(start), walk) = (starts.get(index / walks.len()), &walks[index % walks.len()]) else { break };
                let mut path = vec![*start];
                let mut branches = vec![(*start, 0)];
                for step in walk.ways.first().into_iter().flatten() {
                    self.step(mesh, &mut branches, *step, kind)?;
                    path.push(branches[0].0);
                }
                uses.push(Use { entry, index, arrival: walk.arrival, path });
            }
        }
        Ok(uses)
    }
}
