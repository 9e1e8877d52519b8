//! What does a scheme do at a valence?
//!
//! The stages of the pipeline, one a file: [`local`] -> [`blocks`] -> [`cores`] -> [`spectrum`] -> [`masks`] and [`charmap`].
//! An [`Analyzer`] holds what all valences of a scheme share; [`Analyzer::at`] runs the stages for one.
//! At a vertex on a boundary or crease the symmetry is a mirror alone: [`boundary`]. What follows the symmetry is shared: [`parts`].

pub mod blocks;
pub mod boundary;
pub mod charmap;
pub mod cores;
pub mod curve;
pub mod exact;
pub mod limit;
pub mod local;
pub mod masks;
pub mod neighbourhood;
pub mod parts;
pub mod places;
pub mod regular;
pub mod smoothness;
pub mod spectra;
pub mod spectrum;
pub mod verify;

use crate::mesh::{Lattice, Patch};
use crate::refine::{Obstacle, PatchRows, Refinement, RegularStencils, check_symmetry, lattice_of};
use crate::scheme::Scheme;
use blocks::Blocks;
use charmap::{CharacteristicMap, RegularMasks, Sample, Shape};
use cores::Cores;
use exact::formulas::{AllValences, GENERIC};
use exact::{ExactAnalysis, Task};
use local::{LocalMatrix, MAX_VALENCE};
use masks::Mask;
use neighbourhood::{Influence, Orbit, closure};
use num_complex::Complex64;
use regular::Regular;
use spectra::Spectra;
use spectrum::{Eigenvalue, Spectrum};
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// What the analyses of a scheme at all valences share.
pub struct Analyzer<'a> {
    refinement: Refinement<'a, f64>,
    lattice: Lattice,
    stencils: RegularStencils,
    influence: Influence,
    regular: Option<RegularMasks>,
    regular_meshes: Result<Regular, String>,
    regular_part: RegularPart,
    forms: Result<AllValences, String>,
    exact_regular: Option<ExactAnalysis>,
}

/// The eigenvalues that Doo and Sabin's classical test compares, on the smallest invariant neighbourhood.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Classical {
    /// The largest eigenvalue of frequency 0 after 1.
    pub cup: Option<Eigenvalue>,
    /// The largest eigenvalue of frequency 2.
    pub saddle: Option<Eigenvalue>,
    /// The orbits of the smallest invariant neighbourhood, the centre's (0, 0) among them.
    pub orbits: BTreeSet<Orbit>,
}

/// The characteristic map's net and what its samples say.
#[derive(Clone, Debug)]
pub struct MapReport {
    /// The control points of sector 0, in order of the orbits.
    pub net: Vec<Complex64>,
    /// What the samples say; `None` where the scheme's regular masks are not determined.
    pub shape: Option<Shape>,
}

/// Everything found at one valence; numbers are approximate, but for those under `exact`.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// The valence n.
    pub valence: usize,
    /// The local matrix over the full neighbourhood.
    pub local: LocalMatrix,
    /// Its blocks.
    pub blocks: Blocks,
    /// The cores of the blocks.
    pub cores: Cores,
    /// The eigenvalues.
    pub spectrum: Spectrum,
    /// The subdominant eigenvalue, when it is of frequency 1, real, positive and isolated; another frequency may tie with it.
    pub lambda: Option<Eigenvalue>,
    /// The limit mask, where 1 is isolated in frequency 0.
    pub limit_mask: Option<Mask>,
    /// The tangent masks, cosine and sine form, where lambda is.
    pub tangent_masks: Option<[Mask; 2]>,
    /// The characteristic map, where lambda is.
    pub map: Option<MapReport>,
    /// The eigenvalues of the classical test.
    pub classical: Classical,
    /// What was seen at the regular valence.
    pub regular: RegularPart,
    /// What is exact or enclosed, or why nothing is.
    pub exact: Result<ExactAnalysis, String>,
}

/// What the spectrum at the regular valence says of the scheme on regular meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RegularPart {
    /// The regular valence.
    pub valence: usize,
    /// The modulus of the largest eigenvalue after 1.
    pub next_modulus: f64,
    /// The number of steps in one application of the local matrix.
    pub steps: usize,
    /// The factor by which the lattice shrinks in them, d.
    pub dilation: i32,
    /// The subdominant eigenvalue, when it is of frequency 1, real and positive; a C1 scheme has 1/d.
    pub lambda: Option<f64>,
    /// The largest modulus after 1 and the subdominant eigenvalue.
    pub rival: f64,
    /// Whether 1, then 1/d twice, then less is exactly so.
    pub exactly: Option<bool>,
    /// Whether curvature diverges at regular vertices, exactly.
    pub curvature_diverges: Option<bool>,
    /// Whether the symbol shows that limits on regular meshes are C1, or that they are not for all data ([`regular`]).
    pub c1: Option<bool>,
}

impl<'a> Analyzer<'a> {
    /// Prepares the analysis of a scheme.
    ///
    /// # Errors
    /// When a weight has no value at the regular valence, or stencils reach too far.
    pub fn new(scheme: &'a Scheme) -> Result<Analyzer<'a>, Obstacle> {
        let refinement = Refinement::new(scheme, None);
        let lattice = lattice_of(scheme);
        let stencils = RegularStencils::of(&refinement, lattice)?;
        let influence = Influence::of(&stencils, lattice)?;
        let valence = lattice.regular_valence();
        let regular_part = RegularPart::default();
        let forms = Err(String::new());
        let mut analyzer = Analyzer {
            refinement,
            lattice,
            stencils,
            influence,
            regular: None,
            regular_meshes: Regular::of(&scheme.with_values()).map_err(|obstacle| obstacle.to_string()),
            regular_part,
            forms,
            exact_regular: None,
        };
        analyzer.forms = analyzer.find_forms()?;
        let regular = analyzer.at(valence)?;
        let next_modulus = regular.spectrum.subdominant().map_or(0.0, |e| e.modulus());
        let rival = regular.spectrum.after_subdominant().next().map_or(0.0, |e| e.modulus());
        let lambda = regular.lambda.map(|e| e.value.re);
        let dilation = analyzer.stencils.dilation();
        analyzer.exact_regular = regular.exact.clone().ok();
        let exactly = analyzer.exact_regular.as_ref().and_then(|regular| one_then_twice(regular, dilation));
        let curvature_diverges = analyzer.exact_regular.as_ref().and_then(ExactAnalysis::curvature_diverges);
        let steps = analyzer.steps();
        analyzer.regular_part = RegularPart {
            valence,
            steps,
            dilation,
            next_modulus,
            lambda,
            rival,
            exactly,
            curvature_diverges,
            c1: None,
        };
        if scheme.is_interpolating() && curvature_diverges == Some(true) {
            analyzer.regular_meshes = analyzer.regular_meshes.map(Regular::not_c2);
        }
        analyzer.regular_part.c1 = analyzer.regular_meshes.as_ref().ok().and_then(|regular| regular.smoothness.is(1));
        if let (Some(limit), Some(tangents)) = (&regular.limit_mask, &regular.tangent_masks) {
            analyzer.regular = Some(RegularMasks::of(&regular.local, limit, tangents));
        }
        Ok(analyzer)
    }

    /// The scheme that is analysed.
    pub fn scheme(&self) -> &'a Scheme {
        self.refinement.scheme()
    }

    /// The lattice that the scheme lives on.
    pub fn lattice(&self) -> Lattice {
        self.lattice
    }

    /// The number of steps in one application of the local matrix: as many as bring the lattice back to itself.
    pub fn steps(&self) -> usize {
        self.refinement.cycle().map_or(1, |cycle| cycle.steps)
    }

    /// The factor by which these steps shrink the lattice.
    pub fn dilation(&self) -> i32 {
        self.stencils.dilation()
    }

    /// The distance i + j from which on a new point's row is that of a regular mesh.
    pub fn clear_of_centre(&self) -> i32 {
        self.stencils.clear_of_centre()
    }

    /// What the scheme does on regular meshes, at the values of its parameters, or why that isn't told.
    pub fn regular(&self) -> Result<&Regular, &str> {
        self.regular_meshes.as_ref().map_err(String::as_str)
    }

    /// What holds for all valences at once, or why nothing does.
    pub fn forms(&self) -> Result<&AllValences, &str> {
        self.forms.as_ref().map_err(String::as_str)
    }

    fn find_forms(&self) -> Result<Result<AllValences, String>, Obstacle> {
        if let Err(faults) = check_symmetry(self.scheme(), &[GENERIC]) {
            let why = faults.faults.first().map_or(String::new(), |fault| fault.message.clone());
            return Ok(Err(format!("{why}, at n = {GENERIC}")));
        }
        // a weight that a parameter's value makes vanish is none where the parameter is free
        let odd = self.scheme().with_odd_values();
        let found = Spectra::new(&odd).and_then(|spectra| {
            let (orbits, smallest) = spectra.neighbourhoods(GENERIC)?;
            AllValences::of(self.scheme(), self.lattice, &orbits, &smallest)
        });
        Ok(found.map_err(|obstacle| obstacle.to_string()))
    }

    fn exact(&self, valence: usize, orbits: &[Orbit]) -> Result<Result<ExactAnalysis, String>, Obstacle> {
        let forms = self.forms.as_ref().ok();
        let regular = self.exact_regular.as_ref();
        let scheme = &self.scheme().with_values();
        match (Task { scheme, lattice: self.lattice, valence, orbits, forms, regular }).run() {
            Ok(analysis) => Ok(Ok(analysis)),
            Err(fault @ Obstacle::Fault(_)) => Err(fault),
            Err(other) => Ok(Err(other.to_string())),
        }
    }

    fn rows(&self, valence: usize) -> PatchRows<'_, 'a> {
        PatchRows::new(&self.refinement, &self.stencils, Patch::new(self.lattice, valence))
    }

    /// The local matrix at a valence.
    ///
    /// # Errors
    /// When the valence is out of range or a weight has no value there.
    pub fn local_matrix(&self, valence: usize) -> Result<LocalMatrix, Obstacle> {
        self.local(&self.rows(valence), valence)
    }

    fn local(&self, rows: &PatchRows, valence: usize) -> Result<LocalMatrix, Obstacle> {
        if !(3..=MAX_VALENCE).contains(&valence) {
            return Err(Obstacle::Limit(format!("the valence must be from 3 to {MAX_VALENCE}, not {valence}")));
        }
        LocalMatrix::build(rows, &self.influence)
    }

    /// Runs every stage at a valence.
    ///
    /// # Errors
    /// When the valence is out of range or a weight has no value there.
    pub fn at(&self, valence: usize) -> Result<Analysis, Obstacle> {
        let rows = self.rows(valence);
        let local = self.local(&rows, valence)?;
        let blocks = Blocks::of(&local);
        let cores = Cores::of(&blocks);
        let spectrum = Spectrum::of(&blocks, &cores)?;
        let one = spectrum.one();
        let limit = one.and_then(|one| spectrum.left_vector(&blocks, &cores, &one));
        let limit_mask = limit.and_then(|(left, _)| Mask::limit(&left, &local));
        let is_lambda =
            |e: &Eigenvalue| e.frequency == 1 && e.is_isolated() && e.real().is_some_and(|value| value > 0.0);
        let lambda = spectrum.subdominant().filter(is_lambda);
        let left = lambda.and_then(|lambda| spectrum.left_vector(&blocks, &cores, &lambda));
        let tangent_masks = left.and_then(|(left, _)| Mask::tangents(&left, &local));
        let right = lambda.and_then(|lambda| Some((lambda, spectrum.right_vector(&blocks, &cores, &lambda)?.0)));
        let map = right.and_then(|(e, right)| CharacteristicMap::of(&rows, &local, e.value.re, &right));
        let map = map.map(|map| MapReport { net: self.net(&map, &local), shape: self.shape(&map, valence) });
        let classical = classical(&rows, &local, &cores, &spectrum)?;
        let regular = self.regular_part;
        let exact = self.exact(valence, &local.orbits)?;
        Ok(Analysis {
            exact,
            valence,
            local,
            blocks,
            cores,
            spectrum,
            lambda,
            limit_mask,
            tangent_masks,
            map,
            classical,
            regular,
        })
    }

    fn net(&self, map: &CharacteristicMap, local: &LocalMatrix) -> Vec<Complex64> {
        let point = |(i, j): &Orbit| map.control_point(crate::mesh::Label { sector: 0, i: *i, j: *j });
        local.orbits.iter().filter_map(point).collect()
    }

    fn shape(&self, map: &CharacteristicMap, valence: usize) -> Option<Shape> {
        let masks = self.regular.as_ref()?;
        let scale = CharacteristicMap::least_scale(masks);
        Shape::of(&map.samples(masks, scale)?, self.lattice, scale, valence)
    }

    /// The control points of sector 0 up to a ring, and the samples of the ring segment at a scale of at least 8, for
    /// pictures.
    ///
    /// # Errors
    /// As [`Analyzer::at`].
    pub fn picture_of_map(&self, analysis: &Analysis, rings: i32) -> Result<Option<MapPicture>, Obstacle> {
        let rows = self.rows(analysis.valence);
        let Some(lambda) = analysis.lambda else { return Ok(None) };
        let right = analysis.spectrum.right_vector(&analysis.blocks, &analysis.cores, &lambda);
        let map = right.and_then(|(right, _)| CharacteristicMap::of(&rows, &analysis.local, lambda.value.re, &right));
        let Some(map) = map else { return Ok(None) };
        let first = i32::from(self.lattice.has_centre());
        let orbits = (first..=rings).flat_map(|i| (0..=rings).map(move |j| (i, j)));
        let orbits: Vec<Orbit> = orbits.filter(|(i, j)| self.lattice.ring(*i, *j) <= rings).collect();
        let point = |(i, j): &Orbit| map.control_point(crate::mesh::Label { sector: 0, i: *i, j: *j });
        let net = orbits.iter().filter_map(|orbit| Some((*orbit, point(orbit)?))).collect();
        let samples = self.regular.as_ref().and_then(|masks| {
            let scale = CharacteristicMap::least_scale(masks).max(8);
            Some((scale, map.samples(masks, scale)?))
        });
        Ok(Some(MapPicture { net, samples }))
    }
}

/// What a picture of the characteristic map shows.
#[derive(Clone, Debug)]
pub struct MapPicture {
    /// Control points of sector 0.
    pub net: Vec<(Orbit, Complex64)>,
    /// The scale and the samples of the ring segment, where the scheme's regular masks are determined.
    pub samples: Option<(i32, Vec<Sample>)>,
}

/// Whether 1 is alone, 1/d follows twice, d being the dilation, and the rest is less; `None` where that is not decided.
fn one_then_twice(regular: &ExactAnalysis, dilation: i32) -> Option<bool> {
    let (one, next) = (regular.one?, regular.after_one().next()?.0);
    let dominates = regular.compare_moduli(one, next)? == Ordering::Greater;
    let lambda = &regular.eigenvalues[regular.lambda?];
    let rival = regular.after_subdominant().next().map(|(index, _)| regular.compare_moduli(regular.lambda?, index));
    let leads = rival.is_none_or(|order| order == Some(Ordering::Greater));
    let part = dashu_ratio::RBig::from(1) / dashu_ratio::RBig::from(dilation);
    let (low, high) = lambda.re.lo_hi();
    if low > part || high < part {
        return Some(false);
    }
    let exactly = low == high || lambda.exact.as_ref().is_some_and(|words| words.text == format!("1/{dilation}"));
    match rival {
        Some(None) => None,
        _ => exactly.then_some(dominates && leads),
    }
}

/// The orbits of the smallest invariant neighbourhood: the centre's ring and whatever it is made of.
fn smallest_invariant(rows: &PatchRows) -> Result<BTreeSet<Orbit>, Obstacle> {
    let seed: BTreeSet<Orbit> = if rows.patch.centre().is_some() { [(0, 0), (1, 0)].into() } else { [(0, 0)].into() };
    closure(rows, seed)
}

fn classical(rows: &PatchRows, local: &LocalMatrix, cores: &Cores, spectrum: &Spectrum) -> Result<Classical, Obstacle> {
    let smallest = smallest_invariant(rows)?;
    let inside = |e: &&Eigenvalue| {
        let mut orbits = cores.cores[e.core].iter().flat_map(|node| node.orbits());
        orbits.all(|t| smallest.contains(&local.orbits[t]))
    };
    let largest = |frequency: usize| spectrum.after_one().filter(inside).find(|e| e.frequency == frequency).copied();
    let saddle = largest(2);
    Ok(Classical { cup: largest(0), saddle, orbits: smallest })
}
