//! What are the points around the centre called?
//!
//! By the scheme file's names of positions where there is one (`ring`, `diagonals`), else by their address (`2,0`).

use super::Refinement;
use crate::mesh::{Label, Lattice, Patch};
use crate::numbers::Field;
use crate::scheme::vocabulary::{Arrival, RuleKind, Vocabulary};
use std::collections::BTreeMap;

/// The names of orbits around the centre of the patch.
#[derive(Clone, Debug)]
pub struct OrbitNames {
    names: BTreeMap<(i32, i32), String>,
}

impl OrbitNames {
    /// The names that the vocabulary has for points around an extraordinary point of this scheme.
    pub fn of<W: Field>(refinement: &Refinement<W>, lattice: Lattice) -> OrbitNames {
        let kind = if lattice == Lattice::Dual { RuleKind::Corner } else { RuleKind::Vertex };
        let patch = Patch::new(lattice, 5);
        let start = match patch.centre() {
            Some(centre) => patch.edge(centre, 0),
            // the half-edge of the central face that leaves corner 0
            None => patch.edge(Label { sector: 0, i: 0, j: 0 }, 2),
        };
        let mut names = BTreeMap::new();
        let Some(pass) = refinement.passes().first() else { return OrbitNames { names } };
        for position in Vocabulary::get().around(kind, Some(&refinement.scheme().mesh)) {
            for walk in position.walks.iter().filter(|_| !position.once) {
                let Ok(branches) = pass.walk(&patch, start, walk, kind) else { continue };
                let [(edge, _)] = branches[..] else { continue };
                let point = match walk.arrival {
                    Arrival::Origin => crate::mesh::Connectivity::origin(&patch, edge),
                    Arrival::Target => crate::mesh::Connectivity::target(&patch, edge),
                    Arrival::NewFace | Arrival::NewEdge => continue,
                };
                names.entry(point.orbit()).or_insert_with(|| position.name.clone());
            }
        }
        OrbitNames { names }
    }

    /// The name of an orbit.
    pub fn name(&self, orbit: (i32, i32)) -> String {
        self.names.get(&orbit).cloned().unwrap_or_else(|| format!("{},{}", orbit.0, orbit.1))
    }

    /// The orbit of a name or an address.
    pub fn orbit(&self, name: &str) -> Option<(i32, i32)> {
        let named = self.names.iter().find(|(_, own)| *own == name).map(|(orbit, _)| *orbit);
        named.or_else(|| {
            let (i, j) = name.split_once(',')?;
            Some((i.trim().parse().ok()?, j.trim().parse().ok()?))
        })
    }
}
