//! Into which irreducible parts does a block fall?
//!
//! "Which point feeds which" is a directed graph on the nodes of a block; its strongly connected components are the
//! *cores*. Ordered by dependence they make every block triangular, so that the eigenvalues of a block are those of its
//! cores, of one to three unknowns in all known schemes.

use super::blocks::Node;
use super::parts::{Parts, Unit};
use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};

/// The cores of the blocks of one local matrix.
#[derive(Clone, Debug)]
pub struct Cores<N = Node> {
    /// The nodes of each core; a core depends on itself and on earlier ones only.
    pub cores: Vec<Vec<N>>,
    /// `depends[a][b]`: whether points of core a are made, through any number of steps, of points of core b.
    depends: Vec<Vec<bool>>,
}

impl<N: Unit> Cores<N> {
    /// The cores of a matrix's blocks.
    pub fn of(blocks: &impl Parts<Node = N>) -> Cores<N> {
        let nodes = blocks.nodes();
        let feeds = |to: usize, from: usize| blocks.feeds(nodes[to], nodes[from]);
        let components = components(nodes.len(), feeds);
        let count = components.len();
        let mut depends = vec![vec![false; count]; count];
        for (a, component) in components.iter().enumerate() {
            depends[a][a] = true;
            for b in 0..a {
                let direct = component.iter().any(|to| components[b].iter().any(|from| feeds(*to, *from)));
                if direct {
                    let below = depends[b].clone();
                    depends[a].iter_mut().zip(below).for_each(|(own, other)| *own |= other);
                }
            }
        }
        let cores = components.iter().map(|component| component.iter().map(|index| nodes[*index]).collect());
        Cores { cores: cores.collect(), depends }
    }

    /// The nodes of the core that act on a part: the centre acts on frequency 0 only.
    pub fn nodes(&self, core: usize, part: usize) -> Vec<N> {
        self.cores[core].iter().copied().filter(|node| node.acts_on(part)).collect()
    }

    /// The nodes that the cores are made of, through any number of steps: where left vectors of their eigenvalues live.
    pub fn below(&self, cores: &[usize], part: usize) -> Vec<N> {
        let depends = |other: &usize| cores.iter().any(|core| self.depends[*core][*other]);
        (0..self.cores.len()).filter(depends).flat_map(|c| self.nodes(c, part)).collect()
    }

    /// The nodes that are made of the cores, through any number of steps: where right vectors of their eigenvalues live.
    pub fn above(&self, cores: &[usize], part: usize) -> Vec<N> {
        let depends = |other: &usize| cores.iter().any(|core| self.depends[*other][*core]);
        (0..self.cores.len()).filter(depends).flat_map(|c| self.nodes(c, part)).collect()
    }
}

/// The strongly connected components of the graph in which `to` depends on `from`, each in order; a component depends on
/// itself and on earlier ones only.
pub fn components(size: usize, feeds: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut graph: DiGraph<(), ()> = DiGraph::new();
    let indices: Vec<NodeIndex> = (0..size).map(|_| graph.add_node(())).collect();
    for (to, row) in indices.iter().enumerate() {
        for (from, column) in indices.iter().enumerate() {
            if feeds(to, from) {
                graph.add_edge(*row, *column, ());
            }
        }
    }
    let in_order = |component: Vec<NodeIndex>| {
        let mut component: Vec<usize> = component.into_iter().map(NodeIndex::index).collect();
        component.sort_unstable();
        component
    };
    tarjan_scc(&graph).into_iter().map(in_order).collect()
}
