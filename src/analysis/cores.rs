//! Into which irreducible parts does a block fall?
//!
//! "Which point feeds which" is a directed graph on the nodes of a block; its strongly connected components are the
//! *cores*. Ordered by dependence they make every block triangular, so that the eigenvalues of a block are those of its
//! cores, of one to three unknowns in all known schemes.

use super::blocks::{Blocks, Node};
use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};

/// The cores of the blocks of one local matrix.
#[derive(Clone, Debug)]
pub struct Cores {
    /// The nodes of each core; a core depends on itself and on earlier ones only.
    pub cores: Vec<Vec<Node>>,
    /// `depends[a][b]`: whether points of core a are made, through any number of steps, of points of core b.
    depends: Vec<Vec<bool>>,
}

impl Cores {
    /// The cores of a matrix's blocks.
    pub fn of(blocks: &Blocks) -> Cores {
        let mut graph: DiGraph<Node, ()> = DiGraph::new();
        let indices: Vec<NodeIndex> = blocks.nodes.iter().map(|node| graph.add_node(*node)).collect();
        for to in &indices {
            for from in &indices {
                if blocks.feeds(graph[*to], graph[*from]) {
                    graph.add_edge(*to, *from, ());
                }
            }
        }
        let components = tarjan_scc(&graph);
        let count = components.len();
        let mut depends = vec![vec![false; count]; count];
        for (a, component) in components.iter().enumerate() {
            depends[a][a] = true;
            for b in 0..a {
                let direct =
                    component.iter().any(|to| components[b].iter().any(|from| graph.contains_edge(*to, *from)));
                if direct {
                    let below = depends[b].clone();
                    depends[a].iter_mut().zip(below).for_each(|(own, other)| *own |= other);
                }
            }
        }
        let in_order = |component: &Vec<NodeIndex>| {
            let mut component = component.clone();
            component.sort();
            component.into_iter().map(|index| graph[index]).collect()
        };
        Cores { cores: components.iter().map(in_order).collect(), depends }
    }

    /// The nodes of the core that act on a frequency: the centre acts on frequency 0 only.
    pub fn nodes(&self, core: usize, frequency: usize) -> Vec<Node> {
        self.cores[core].iter().copied().filter(|node| frequency == 0 || *node != Node::Centre).collect()
    }

    /// The nodes that the core is made of, through any number of steps: where left vectors of its eigenvalues live.
    pub fn below(&self, core: usize, frequency: usize) -> Vec<Node> {
        (0..self.cores.len())
            .filter(|other| self.depends[core][*other])
            .flat_map(|c| self.nodes(c, frequency))
            .collect()
    }

    /// The nodes that are made of the core, through any number of steps: where right vectors of its eigenvalues live.
    pub fn above(&self, core: usize, frequency: usize) -> Vec<Node> {
        (0..self.cores.len())
            .filter(|other| self.depends[*other][core])
            .flat_map(|c| self.nodes(c, frequency))
            .collect()
    }
}
