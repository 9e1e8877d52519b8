//! What does a report say?
//!
//! Everything that tables, pictures and other programs read, as plain data; as JSON it is the contract of the README
//! (`"format": 1`). Lists are in a fixed order and floats print shortest: the same input gives the same bytes.

use crate::analysis::masks::Mask;
use crate::analysis::spectrum::Eigenvalue;
use crate::analysis::{Analysis, Analyzer};
use crate::mesh::Label;
use crate::refine::{Obstacle, OrbitNames, Refinement};
use crate::scheme::{RuleSum, Scheme, catalogue};
use crate::verdicts::{ClaimCheck, CurvatureClass, Verdict, bound, check_claims, curvature_class, verdicts};
use num_complex::Complex64;
use serde::Serialize;
use std::collections::BTreeMap;

/// The version of the JSON contract.
pub const FORMAT: u32 = 1;

/// The report of a scheme.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// [`FORMAT`].
    pub format: u32,
    /// The scheme's short name.
    pub scheme: String,
    /// What it is called.
    pub title: String,
    /// `surface`.
    pub kind: &'static str,
    /// What it is made of.
    pub classification: Classification,
    /// The values of its parameters, as written.
    pub parameters: BTreeMap<String, String>,
    /// Whose it is.
    pub sources: Vec<Reference>,
    /// One entry for each valence asked for.
    pub valences: Vec<ValenceReport>,
    /// What the literature says, beside the analysis.
    pub claims: Vec<ClaimCheck>,
}

/// How schemes are classified.
#[derive(Clone, Debug, Serialize)]
pub struct Classification {
    /// triangles, quads or polygons.
    pub mesh: String,
    /// The split.
    pub split: String,
    /// Whether extraordinary points are faces.
    pub dual: bool,
    /// Whether old points stay.
    pub interpolating: bool,
    /// The regular valence.
    pub regular_valence: usize,
}

/// A work of the bibliography.
#[derive(Clone, Debug, Serialize)]
pub struct Reference {
    /// Its key.
    pub key: String,
    /// Authors, title, place and year; the key again where the bibliography doesn't have it.
    pub citation: String,
}

/// The report of one valence.
#[derive(Clone, Debug, Serialize)]
pub struct ValenceReport {
    /// The valence.
    pub n: usize,
    /// The size of the full neighbourhood.
    pub size: usize,
    /// Refinement steps in one application of the matrix.
    pub steps: u32,
    /// The factor by which these steps shrink the lattice.
    pub dilation: u32,
    /// Every eigenvalue, largest modulus first.
    pub eigenvalues: Vec<EigenvalueReport>,
    /// `approximate`: no value here has an error bound.
    pub arithmetic: &'static str,
    /// The largest eigenvalue after 1.
    pub subdominant: Option<SubdominantReport>,
    /// The largest modulus after 1 and the subdominant eigenvalue.
    pub subsubdominant: Option<SubsubdominantReport>,
    /// Doo and Sabin's eigenvalues.
    pub curvature: CurvatureReport,
    /// Weights of the limit mask.
    pub limit_mask: Option<Vec<WeightReport>>,
    /// Weights of the two tangent masks.
    pub tangent_masks: Option<[Vec<WeightReport>; 2]>,
    /// The control net of the characteristic map.
    pub characteristic_map: Option<Vec<PointReport>>,
    /// A power of ten above the approximate residuals of all right and left vectors that were computed, and their number.
    pub residual: ResidualReport,
    /// The conditions.
    pub verdicts: Vec<Verdict>,
    /// The weights of the rule at the extraordinary point: of the vertex (or corner) rule, on old points.
    #[serde(skip)]
    pub rule_weights: Vec<(String, f64)>,
    /// The largest eigenvalue of each frequency, the 1 of the constants left out, for tables.
    #[serde(skip)]
    pub largest: Vec<Option<[f64; 2]>>,
    /// Amplitudes of the masks by orbit, for tables.
    #[serde(skip)]
    pub amplitudes: Vec<AmplitudeReport>,
}

/// One cluster of eigenvalues of one frequency.
#[derive(Clone, Debug, Serialize)]
pub struct EigenvalueReport {
    /// Real and imaginary part.
    pub value: [f64; 2],
    /// 0..floor(n/2); frequencies k and n-k are one entry.
    pub frequency: usize,
    /// How often it counts, frequencies k and n-k together.
    pub algebraic: usize,
    /// The dimension of its eigenspace; null where approximately equal eigenvalues can't be told apart.
    pub geometric: Option<usize>,
    /// The size of its largest Jordan block; null likewise.
    pub jordan: Option<usize>,
    /// The value at this n, in the scheme language; null while arithmetic is approximate.
    pub exact: Option<String>,
    /// The value for all n; null likewise.
    pub formula: Option<String>,
}

/// The subdominant eigenvalue.
#[derive(Clone, Debug, Serialize)]
pub struct SubdominantReport {
    /// Real and imaginary part.
    pub value: [f64; 2],
    /// Its frequency.
    pub frequency: usize,
    /// How often it counts.
    pub multiplicity: usize,
    /// As [`EigenvalueReport::exact`].
    pub exact: Option<String>,
    /// As [`EigenvalueReport::formula`].
    pub formula: Option<String>,
}

/// What follows the subdominant eigenvalue.
#[derive(Clone, Debug, Serialize)]
pub struct SubsubdominantReport {
    /// The largest modulus.
    pub modulus: f64,
    /// The frequencies that have it, approximately.
    pub frequencies: Vec<usize>,
    /// modulus / lambda^2.
    pub ratio: Option<f64>,
    /// The size of the largest Jordan block; null while arithmetic is approximate.
    pub jordan: Option<usize>,
    /// What the ratio says of curvature, for tables; `None` where lambda doesn't dominate.
    #[serde(skip)]
    pub class: Option<CurvatureClass>,
}

/// The eigenvalues of the classical test.
#[derive(Clone, Debug, Serialize)]
pub struct CurvatureReport {
    /// Frequency 0.
    pub cup: Option<ClassicalReport>,
    /// Frequency 2.
    pub saddle: Option<ClassicalReport>,
}

/// An eigenvalue of the classical test.
#[derive(Clone, Debug, Serialize)]
pub struct ClassicalReport {
    /// Its modulus, with the sign if it is real.
    pub value: f64,
    /// |value| / lambda^2.
    pub ratio: Option<f64>,
    /// As [`EigenvalueReport::exact`].
    pub exact: Option<String>,
}

/// A weight of a mask.
#[derive(Clone, Debug, Serialize)]
pub struct WeightReport {
    /// The position's name, or its address.
    pub at: String,
    /// The sector; absent at the centre.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sector: Option<u32>,
    /// The orbit; absent at the centre.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orbit: Option<[i32; 2]>,
    /// The weight.
    pub weight: f64,
}

/// A control point of the characteristic map.
#[derive(Clone, Debug, Serialize)]
pub struct PointReport {
    /// The sector.
    pub sector: u32,
    /// The orbit.
    pub orbit: [i32; 2],
    /// Its place.
    pub xy: [f64; 2],
}

/// What the equations of the eigenvectors left over.
#[derive(Clone, Debug, Serialize)]
pub struct ResidualReport {
    /// As `< 1e-14`.
    pub bound: String,
    /// The number of vectors.
    pub vectors: usize,
}

/// The amplitudes of the masks on an orbit.
#[derive(Clone, Debug)]
pub struct AmplitudeReport {
    /// The orbit's name.
    pub at: String,
    /// Its weight in the limit mask.
    pub limit: Option<f64>,
    /// Modulus r and phase: the tangent masks' weights in sector s are r cos(2 pi (s + phase)/n) and r sin(...).
    pub tangent: Option<(f64, f64)>,
}

impl Report {
    /// Assembles the report of analyses. `sums` are what the check of the scheme file found.
    ///
    /// # Errors
    /// When a claimed value can't be computed.
    pub fn new(
        scheme: &Scheme,
        analyzer: &Analyzer,
        analyses: Vec<Analysis>,
        sums: &[RuleSum],
    ) -> Result<Report, Obstacle> {
        let names = OrbitNames::of(&Refinement::<f64>::new(scheme, None), analyzer.lattice());
        let judged: Vec<(Analysis, Vec<Verdict>)> = analyses
            .into_iter()
            .map(|analysis| {
                let found = verdicts(&analysis, sums);
                (analysis, found)
            })
            .collect();
        let claims = check_claims(scheme, &judged, &|name| names.orbit(name))?;
        let valences: Vec<ValenceReport> =
            judged.iter().map(|(analysis, verdicts)| valence_report(analysis, verdicts, &names)).collect();
        let keys = references(scheme, &valences, &claims);
        Ok(Report {
            format: FORMAT,
            scheme: scheme.id.clone(),
            title: scheme.book.title.clone(),
            kind: "surface",
            classification: Classification {
                mesh: scheme.mesh.clone(),
                split: scheme.split.clone(),
                dual: scheme.is_dual(),
                interpolating: scheme.is_interpolating(),
                regular_valence: scheme.regular_valence(),
            },
            parameters: scheme
                .book
                .parameters
                .iter()
                .map(|p| (p.name.clone(), p.value.formula.text().to_string()))
                .collect(),
            sources: keys,
            valences,
            claims,
        })
    }
}

/// Every source that is mentioned, the scheme's own first.
fn references(scheme: &Scheme, valences: &[ValenceReport], claims: &[ClaimCheck]) -> Vec<Reference> {
    let judged = valences.iter().flat_map(|valence| &valence.verdicts).flat_map(|verdict| &verdict.source);
    let claimed = claims.iter().flat_map(|claim| &claim.source);
    let mut keys: Vec<&String> = Vec::new();
    for key in scheme.book.sources.iter().chain(claimed).chain(judged) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    let citation = |key: &String| catalogue::sources().get(key).map_or(key.clone(), catalogue::Source::citation);
    keys.into_iter().map(|key| Reference { key: key.clone(), citation: citation(key) }).collect()
}

fn valence_report(analysis: &Analysis, verdicts: &[Verdict], names: &OrbitNames) -> ValenceReport {
    let n = analysis.valence;
    let lambda = analysis.lambda.map(|e| e.value.re);
    let (residual, vectors) = analysis.spectrum.approx_residual(&analysis.blocks, &analysis.cores);
    let classical = |e: Option<Eigenvalue>| {
        e.map(|e| ClassicalReport {
            value: e.real().unwrap_or(e.modulus()),
            ratio: lambda.map(|lambda| e.modulus() / (lambda * lambda)),
            exact: None,
        })
    };
    ValenceReport {
        n,
        size: analysis.local.size(),
        steps: 1,
        dilation: 2,
        eigenvalues: analysis.spectrum.distinct().iter().map(|e| eigenvalue_report(e, n)).collect(),
        arithmetic: "approximate",
        subdominant: analysis.spectrum.subdominant().map(|e| SubdominantReport {
            value: pair(e.value),
            frequency: e.frequency,
            multiplicity: e.multiplicity(n),
            exact: None,
            formula: None,
        }),
        subsubdominant: subsubdominant_report(analysis),
        curvature: CurvatureReport {
            cup: classical(analysis.classical.cup),
            saddle: classical(analysis.classical.saddle),
        },
        limit_mask: analysis.limit_mask.as_ref().map(|mask| mask_report(mask, analysis, names)),
        tangent_masks: analysis
            .tangent_masks
            .as_ref()
            .map(|masks| masks.each_ref().map(|m| mask_report(m, analysis, names))),
        characteristic_map: net_report(analysis),
        residual: ResidualReport { bound: bound(residual), vectors },
        verdicts: verdicts.to_vec(),
        rule_weights: rule_weights(analysis, names),
        largest: largest_by_frequency(analysis),
        amplitudes: amplitudes(analysis, names),
    }
}

fn largest_by_frequency(analysis: &Analysis) -> Vec<Option<[f64; 2]>> {
    let mut largest = vec![None; analysis.valence / 2 + 1];
    for e in analysis.spectrum.after_one() {
        largest[e.frequency].get_or_insert(pair(e.value));
    }
    largest
}

/// Without negative zeros.
fn pair(value: Complex64) -> [f64; 2] {
    [value.re + 0.0, value.im + 0.0]
}

fn eigenvalue_report(e: &Eigenvalue, n: usize) -> EigenvalueReport {
    EigenvalueReport {
        value: pair(e.value),
        frequency: e.frequency,
        algebraic: e.multiplicity(n),
        geometric: e.is_isolated().then(|| e.multiplicity(n)),
        jordan: e.is_isolated().then_some(1),
        exact: None,
        formula: None,
    }
}

fn subsubdominant_report(analysis: &Analysis) -> Option<SubsubdominantReport> {
    let first = analysis.spectrum.after_subdominant().next()?;
    let modulus = first.modulus();
    let tied = analysis.spectrum.after_subdominant().take_while(|e| modulus - e.modulus() <= first.approx_error);
    let mut frequencies: Vec<usize> = tied.map(|e| e.frequency).collect();
    frequencies.sort_unstable();
    frequencies.dedup();
    let lambda = analysis.lambda.map(|e| e.value.re);
    let ratio = lambda.map(|lambda| modulus / (lambda * lambda));
    let class = curvature_class(analysis).map(|(_, class)| class);
    Some(SubsubdominantReport { modulus, frequencies, ratio, jordan: None, class })
}

fn mask_report(mask: &Mask, analysis: &Analysis, names: &OrbitNames) -> Vec<WeightReport> {
    let report = |(label, weight): (Label, f64)| {
        let is_centre = analysis.local.patch.centre() == Some(label);
        WeightReport {
            at: if is_centre { "centre".to_string() } else { names.name(label.orbit()) },
            sector: (!is_centre).then_some(label.sector),
            orbit: (!is_centre).then_some([label.i, label.j]),
            weight: weight + 0.0,
        }
    };
    mask.weights(&analysis.local).into_iter().map(report).collect()
}

fn net_report(analysis: &Analysis) -> Option<Vec<PointReport>> {
    let net = &analysis.map.as_ref()?.net;
    let roots = crate::numbers::RootsOfUnity::new(analysis.valence);
    let points = (0..analysis.local.patch.valence).flat_map(|sector| {
        let turn = roots.get(i64::from(sector));
        let orbits = analysis.local.orbits.iter().zip(net);
        orbits.map(move |((i, j), point)| PointReport { sector, orbit: [*i, *j], xy: pair(point * turn) })
    });
    Some(points.collect())
}

/// The weights that the new extraordinary point (dual: the new corner 0) takes from old points. A ring of equal weights is one
/// entry; a corner rule's weights have one each, up to the opposite corner.
fn rule_weights(analysis: &Analysis, names: &OrbitNames) -> Vec<(String, f64)> {
    let local = &analysis.local;
    if let Some(centre) = &local.centre {
        let own = centre.iter().find(|entry| entry.orbit.is_none()).map(|entry| ("centre".to_string(), entry.weight));
        let rings = (0..local.orbits.len()).filter_map(|orbit| {
            let entry = centre.iter().find(|entry| entry.orbit == Some(orbit))?;
            Some((names.name(local.orbits[orbit]), entry.weight))
        });
        return own.into_iter().chain(rings).collect();
    }
    let Some(first) = local.rows.first() else { return Vec::new() };
    let half = first.iter().filter(|entry| entry.orbit == Some(0) && 2 * entry.sector as usize <= analysis.valence);
    let mut weights: Vec<(u32, f64)> = half.map(|entry| (entry.sector, entry.weight)).collect();
    weights.sort_by_key(|(sector, _)| *sector);
    weights.into_iter().map(|(sector, weight)| (format!("ring[{sector}]"), weight)).collect()
}

fn amplitudes(analysis: &Analysis, names: &OrbitNames) -> Vec<AmplitudeReport> {
    let limit = |orbit: usize| analysis.limit_mask.as_ref().map(|mask| mask.amplitudes[orbit].re + 0.0);
    let tangent = |orbit: usize| {
        let amplitude = analysis.tangent_masks.as_ref()?[0].amplitudes[orbit];
        let turns = -libm::atan2(amplitude.im, amplitude.re) / std::f64::consts::TAU;
        Some((amplitude.norm_sqr().sqrt(), turns * analysis.valence as f64 + 0.0))
    };
    let row = |orbit: usize| AmplitudeReport {
        at: names.name(analysis.local.orbits[orbit]),
        limit: limit(orbit),
        tangent: tangent(orbit),
    };
    (0..analysis.local.orbits.len()).map(row).collect()
}
