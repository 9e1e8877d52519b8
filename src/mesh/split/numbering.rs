//! Which number has an edge?
//!
//! Edges are numbered in the order of their first corners. Runs of corners are counted first, so that each run knows where
//! its numbers start and all can be filled at once.

use super::RUN;
use crate::mesh::HalfEdgeMesh;
use rayon::prelude::*;

/// The numbers of a mesh's edges.
#[derive(Clone, Debug, Default)]
pub struct Numbering {
    /// For each first corner the number of its edge; other entries mean nothing.
    number: Vec<u32>,
    /// The first corner of each edge.
    first: Vec<u32>,
    edges: usize,
    /// The faces that a receding boundary leaves, or that have new points, where not all; the edges where it parts faces.
    kept: Option<Vec<u32>>,
    /// The first corners of the boundary's edges that are cut.
    cut: Vec<u32>,
}

impl Numbering {
    /// Numbers the edges of a mesh.
    pub fn of(mesh: &HalfEdgeMesh) -> Numbering {
        Numbering::in_buffers(mesh, Numbering::default())
    }

    /// The same, in the memory of a numbering that is done with.
    pub fn in_buffers(mesh: &HalfEdgeMesh, old: Numbering) -> Numbering {
        let twins = mesh.twins();
        let run = 4 * RUN;
        let is_first = |at: usize, twin: &u32| u32::from((at as u32) < *twin);
        let count = |(index, twins): (usize, &[u32])| {
            twins.iter().enumerate().map(|(at, twin)| is_first(index * run + at, twin)).sum::<u32>()
        };
        let counts: Vec<u32> = twins.par_chunks(run).enumerate().map(count).collect();
        let mut number = super::room(old.number, twins.len());
        let mut first = super::room(old.first, counts.iter().sum::<u32>() as usize);
        let mut rest = first.as_mut_slice();
        let mut jobs = Vec::with_capacity(counts.len());
        let mut start = 0;
        for (index, (number, twins)) in number.chunks_mut(run).zip(twins.chunks(run)).enumerate() {
            let (own, others) = rest.split_at_mut(counts[index] as usize);
            jobs.push((index * run, start, number, twins, own));
            rest = others;
            start += counts[index];
        }
        jobs.into_par_iter().for_each(|(corner, start, number, twins, first)| {
            let mut met = 0;
            for (at, (number, twin)) in number.iter_mut().zip(twins).enumerate() {
                *number = start + met as u32;
                if is_first(corner + at, twin) == 1 {
                    first[met] = (corner + at) as u32;
                    met += 1;
                }
            }
        });
        Numbering { number, edges: first.len(), first, kept: None, cut: Vec::new() }
    }

    /// The same with a list of what a receding boundary leaves.
    pub(super) fn keeping(self, kept: Vec<u32>) -> Numbering {
        Numbering { kept: Some(kept), ..self }
    }

    /// The same with the boundary's edges that are cut, by their first corners.
    pub(super) fn cutting(self, cut: Vec<u32>) -> Numbering {
        Numbering { cut, ..self }
    }

    /// The first corners of the boundary's edges that are cut.
    pub(super) fn cut(&self) -> &[u32] {
        &self.cut
    }

    /// The faces that a receding boundary leaves, or that have new points, where not all; the edges where it parts faces.
    pub(super) fn kept(&self) -> Option<&[u32]> {
        self.kept.as_deref()
    }

    /// The number of edges.
    pub fn edges(&self) -> usize {
        self.edges
    }

    /// Gives back the memory of the first corners, once all points are made: faces need the numbers alone.
    pub(super) fn without_first_corners(self) -> Numbering {
        Numbering { first: Vec::new(), ..self }
    }

    /// The number of the edge with this first corner.
    #[inline]
    pub fn of_first(&self, first_corner: u32) -> u32 {
        self.number[first_corner as usize]
    }

    /// The number of the edge of a corner whose twin is given.
    #[inline]
    pub fn of_corner(&self, corner: u32, twin: u32) -> u32 {
        self.number[corner.min(twin) as usize]
    }

    /// The first corner of each edge, in the order of the edges.
    pub fn first_corners(&self) -> &[u32] {
        &self.first
    }
}
