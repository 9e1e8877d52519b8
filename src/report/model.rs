//! What does a report say?
//!
//! Everything that tables, pictures and other programs read, as plain data; as JSON it is the contract of the README
//! (`"format": 1`). Lists are in a fixed order and floats print shortest: the same input gives the same bytes.

use super::boundary::BoundaryReport;
use super::certificate;
use super::formulas::{AllValencesReport, all_valences};
use super::ranges::RangeReport;
use super::regular::{RegularReport, regular_report, with_parameters_free};
use super::sweep::Sweep;
use crate::analysis::exact::words::Words;
use crate::analysis::exact::{Arithmetic, ExactAnalysis, ExactEigenvalue, ExactWeight, Value};
use crate::analysis::masks::Mask;
use crate::analysis::spectrum::Eigenvalue;
use crate::analysis::{Analysis, Analyzer};
use crate::mesh::Label;
use crate::proof::c1::Proofs;
use crate::refine::{Obstacle, OrbitNames, Refinement};
use crate::scheme::{RuleSum, Scheme, catalogue};
use crate::verdicts::{
    ClaimCheck, Curvature, CurvatureClass, EveryValence, Verdict, bound, check_claims, curvature_of, verdicts,
};
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
    /// What the scheme does on regular meshes; null where its weights there are no rational numbers.
    pub regular: Option<RegularReport>,
    /// Why that is so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why_no_regular: Option<String>,
    /// The regular part with parameters left free, where there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regular_free: Option<RegularReport>,
    /// What holds for every n; null where there are no closed forms in n.
    pub all_valences: Option<AllValencesReport>,
    /// Why there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why_no_formulas: Option<String>,
    /// Whether limit surfaces are C1, for every n.
    pub c1: EveryValence,
    /// The certificate that this is proved; null where there is none.
    pub certificate: Option<CertificateReport>,
    /// One entry for each valence asked for.
    pub valences: Vec<ValenceReport>,
    /// What the literature says, beside the analysis.
    pub claims: Vec<ClaimCheck>,
    /// The leading eigenvalues against a parameter, where that is asked for.
    #[serde(skip)]
    pub sweep: Option<Sweep>,
    /// Where conditions hold as a parameter changes, where that is asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ranges: Vec<RangeReport>,
    /// What was found at boundaries, creases, corners and darts, where that is asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub boundary: Vec<BoundaryReport>,
}

/// A certificate that others can check.
#[derive(Clone, Debug, Serialize)]
pub struct CertificateReport {
    /// Its file, beside the report.
    pub file: String,
    /// Its text.
    #[serde(skip)]
    pub text: String,
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
    /// Whether new points are linear in the old ones.
    pub linear: bool,
    /// What the scheme file claims of smoothness at extraordinary points.
    pub claimed_smoothness: Option<String>,
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
    /// `exact`: equality is decided; `enclosed`: unequal values are told apart; `approximate`: no value here has an error bound.
    pub arithmetic: &'static str,
    /// Why it is not exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why_not_exact: Option<String>,
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
    /// The same by orbit, in the form own cos(2 pi s/n) + next cos(2 pi (s+1)/n) for sector s (with sines in the second).
    pub tangent_forms: Option<Vec<FormReport>>,
    /// The control net of the characteristic map.
    pub characteristic_map: Option<Vec<PointReport>>,
    /// A power of ten above the approximate residuals of all right and left vectors that were computed, and their number.
    pub residual: ResidualReport,
    /// The conditions.
    pub verdicts: Vec<Verdict>,
    /// The weights of the rule at the extraordinary point: of the vertex (or corner) rule, on old points.
    #[serde(skip)]
    pub rule_weights: Vec<(String, Quantity)>,
    /// The largest eigenvalue of each frequency, the 1 of the constants left out, for tables.
    #[serde(skip)]
    pub largest: Vec<Option<Quantity>>,
    /// Amplitudes of the masks by orbit, for tables.
    #[serde(skip)]
    pub amplitudes: Vec<AmplitudeReport>,
}

/// A number as tables show it.
#[derive(Clone, Debug, Serialize)]
pub struct Quantity {
    /// Real and imaginary part, approximately.
    pub value: [f64; 2],
    /// The value with the digits asked for, all of them right; null where it is approximate.
    pub decimal: Option<String>,
    /// The value at this n, in the scheme language; null where arithmetic is not exact.
    pub exact: Option<String>,
    /// The value for all n; null likewise, or where there is no such form.
    pub formula: Option<String>,
    /// The exact value in LaTeX.
    #[serde(skip)]
    pub latex: Option<String>,
}

impl Quantity {
    pub(super) fn approximate(value: [f64; 2]) -> Quantity {
        Quantity { value, decimal: None, exact: None, formula: None, latex: None }
    }

    fn of(value: &Value, exact: Option<&Words>, digits: usize) -> Quantity {
        Quantity {
            value: [value.midpoint_f64() + 0.0, 0.0],
            decimal: value.decimal(digits),
            exact: exact.map(|words| words.text.clone()),
            formula: None,
            latex: exact.map(|words| words.latex.clone()),
        }
    }

    pub(super) fn of_eigenvalue(e: &ExactEigenvalue, digits: usize) -> Quantity {
        let part = |value: &Value| value.midpoint_f64() + 0.0;
        let decimal = match (e.is_real(), e.re.decimal(digits), e.im.abs().decimal(digits)) {
            (true, re, _) => re,
            (false, Some(re), Some(im)) if part(&e.im) < 0.0 => Some(format!("{re} - {im}i")),
            (false, Some(re), Some(im)) => Some(format!("{re} + {im}i")),
            _ => None,
        };
        Quantity {
            value: [part(&e.re), part(&e.im)],
            decimal,
            exact: e.exact.as_ref().map(|words| words.text.clone()),
            formula: e.formula.as_ref().map(|words| words.text.clone()),
            latex: e.exact.as_ref().map(|words| words.latex.clone()),
        }
    }
}

/// One eigenvalue of one frequency, or a cluster of approximately equal ones.
#[derive(Clone, Debug, Serialize)]
pub struct EigenvalueReport {
    /// The value.
    #[serde(flatten)]
    pub quantity: Quantity,
    /// 0..floor(n/2); frequencies k and n-k are one entry.
    pub frequency: usize,
    /// How often it counts, frequencies k and n-k together.
    pub algebraic: usize,
    /// The dimension of its eigenspace; null where approximately equal eigenvalues can't be told apart.
    pub geometric: Option<usize>,
    /// The size of its largest Jordan block; null likewise.
    pub jordan: Option<usize>,
}

/// The subdominant eigenvalue.
#[derive(Clone, Debug, Serialize)]
pub struct SubdominantReport {
    /// The value.
    #[serde(flatten)]
    pub quantity: Quantity,
    /// Its frequency.
    pub frequency: usize,
    /// How often it counts.
    pub multiplicity: usize,
}

/// What follows the subdominant eigenvalue.
#[derive(Clone, Debug, Serialize)]
pub struct SubsubdominantReport {
    /// The largest modulus.
    pub modulus: f64,
    /// The first eigenvalue of that modulus, exactly.
    pub exact: Option<String>,
    /// The frequencies that have it.
    pub frequencies: Vec<usize>,
    /// modulus / lambda^2.
    pub ratio: Option<f64>,
    /// The size of the largest Jordan block; null where arithmetic is not exact.
    pub jordan: Option<usize>,
    /// The modulus for tables.
    #[serde(skip)]
    pub shown: Quantity,
    /// modulus / lambda^2 for tables.
    #[serde(skip)]
    pub shown_ratio: Option<Quantity>,
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
    /// As [`Quantity::exact`].
    pub exact: Option<String>,
    /// As [`Quantity::formula`].
    pub formula: Option<String>,
    /// The ratio for tables.
    #[serde(skip)]
    pub shown_ratio: Option<Quantity>,
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
    /// The weight with the digits asked for, where all of them are right.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decimal: Option<String>,
    /// The weight at this n, in the scheme language.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact: Option<String>,
    /// The same in LaTeX.
    #[serde(skip)]
    pub latex: Option<String>,
}

/// The tangent masks' weights on an orbit.
#[derive(Clone, Debug, Serialize)]
pub struct FormReport {
    /// The position's name, or its address.
    pub at: String,
    /// The orbit.
    pub orbit: [i32; 2],
    /// What multiplies cos(2 pi s/n).
    pub own: Quantity,
    /// What multiplies cos(2 pi (s+1)/n).
    pub next: Quantity,
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

/// The amplitudes of the limit mask on an orbit.
#[derive(Clone, Debug)]
pub struct AmplitudeReport {
    /// The orbit's name.
    pub at: String,
    /// Its weight in the limit mask.
    pub limit: Option<Quantity>,
}

impl Report {
    /// Assembles the report of analyses. `sums` are what the check of the scheme file found; numbers are shown with `digits` decimals.
    ///
    /// # Errors
    /// When a claimed value can't be computed.
    pub fn new(
        scheme: &Scheme,
        analyzer: &Analyzer,
        analyses: Vec<Analysis>,
        sums: &[RuleSum],
        digits: usize,
    ) -> Result<Report, Obstacle> {
        let names = OrbitNames::of(&Refinement::<f64>::new(scheme, None), analyzer.lattice());
        let proofs = Proofs::of(analyzer);
        let mut judged: Vec<(Analysis, Vec<Verdict>)> = analyses
            .into_iter()
            .map(|analysis| {
                let found = verdicts(&analysis, sums, &proofs.at(analysis.valence, analysis.exact.as_ref().ok()));
                (analysis, found)
            })
            .collect();
        let known = |n: usize| judged.iter().find(|(analysis, _)| analysis.valence == n).map(|(_, own)| own.clone());
        let c1 = EveryValence::of(&proofs, sums, &known);
        judged.iter_mut().for_each(|(analysis, own)| c1.settle(analysis.valence, own));
        let text = if c1.is_proved() { certificate(&proofs).ok() } else { None };
        let claims = check_claims(scheme, &judged, &|name| names.orbit(name))?;
        let valences: Vec<ValenceReport> =
            judged.iter().map(|(analysis, verdicts)| valence_report(analysis, verdicts, &names, digits)).collect();
        let keys = references(scheme, &valences, &claims);
        Ok(Report {
            format: FORMAT,
            scheme: scheme.id.clone(),
            title: scheme.book.title.clone(),
            kind: "surface",
            classification: Classification {
                mesh: scheme.mesh.clone(),
                split: scheme.split_in_words(),
                dual: !analyzer.lattice().has_centre(),
                interpolating: scheme.is_interpolating(),
                regular_valence: scheme.regular_valence(),
                linear: true,
                claimed_smoothness: Some(scheme.classification(false).claimed()).filter(|words| !words.is_empty()),
            },
            parameters: scheme
                .book
                .parameters
                .iter()
                .map(|p| (p.name.clone(), p.value.formula.text().to_string()))
                .collect(),
            sources: keys,
            regular: analyzer.regular().ok().map(regular_report),
            why_no_regular: analyzer.regular().err().map(str::to_string),
            regular_free: with_parameters_free(scheme).as_ref().map(regular_report),
            all_valences: analyzer.forms().ok().map(|forms| all_valences(forms, &names)),
            why_no_formulas: analyzer.forms().err().map(str::to_string),
            c1,
            certificate: text.map(|text| CertificateReport { file: certificate_file(&scheme.id), text }),
            valences,
            claims,
            sweep: None,
            ranges: vec![],
            boundary: vec![],
        })
    }
}

impl Report {
    /// The name of the certificate's file, whether there is one or not.
    pub fn certificate_file(&self) -> String {
        certificate_file(&self.scheme)
    }

    /// Adds what was found at boundaries, with its sources.
    pub fn add_boundary(&mut self, found: Vec<BoundaryReport>) {
        for key in found.iter().flat_map(|own| &own.source) {
            if self.sources.iter().all(|known| known.key != *key) {
                self.sources.push(reference(key));
            }
        }
        self.boundary = found;
    }
}

fn certificate_file(scheme: &str) -> String {
    format!("{scheme}.certificate.json")
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
    keys.into_iter().map(|key| reference(key)).collect()
}

pub(super) fn reference(key: &str) -> Reference {
    let citation = catalogue::sources().get(key).map_or(key.to_string(), catalogue::Source::citation);
    Reference { key: key.to_string(), citation }
}

fn valence_report(analysis: &Analysis, verdicts: &[Verdict], names: &OrbitNames, digits: usize) -> ValenceReport {
    let n = analysis.valence;
    let (residual, vectors) = analysis.spectrum.approx_residual(&analysis.blocks, &analysis.cores);
    let forms = tangent_forms(analysis, names, digits);
    ValenceReport {
        n,
        size: analysis.local.size(),
        steps: analysis.regular.steps as u32,
        dilation: analysis.regular.dilation.unsigned_abs(),
        eigenvalues: eigenvalues(analysis, digits),
        arithmetic: match told_apart(analysis).map(|exact| exact.arithmetic) {
            Some(Arithmetic::Exact) => "exact",
            Some(Arithmetic::Enclosed) => "enclosed",
            None => "approximate",
        },
        why_not_exact: match &analysis.exact {
            Ok(_) if told_apart(analysis).is_none() => Some("enclosures do not tell all eigenvalues apart".to_string()),
            Ok(exact) => exact.why_enclosed.clone(),
            Err(why) => Some(why.clone()),
        },
        subdominant: subdominant_report(analysis, digits),
        subsubdominant: subsubdominant_report(analysis, digits),
        curvature: CurvatureReport {
            cup: analysis.classical.cup.map(|e| classical_report(analysis, &e, digits)),
            saddle: analysis.classical.saddle.map(|e| classical_report(analysis, &e, digits)),
        },
        limit_mask: limit_report(analysis, names, digits),
        tangent_masks: analysis
            .tangent_masks
            .as_ref()
            .map(|masks| masks.each_ref().map(|m| mask_report(m, analysis, names))),
        tangent_forms: forms,
        characteristic_map: net_report(analysis),
        residual: ResidualReport { bound: bound(residual), vectors },
        verdicts: verdicts.to_vec(),
        rule_weights: rule_weights(analysis, names, digits),
        largest: largest_by_frequency(analysis, digits),
        amplitudes: amplitudes(analysis, names, digits),
    }
}

/// The exact analysis, where it tells all eigenvalues apart.
fn told_apart(analysis: &Analysis) -> Option<&ExactAnalysis> {
    let exact = analysis.exact.as_ref().ok()?;
    exact.eigenvalues.iter().all(|e| e.algebraic.is_some()).then_some(exact)
}

fn eigenvalues(analysis: &Analysis, digits: usize) -> Vec<EigenvalueReport> {
    let n = analysis.valence;
    let Some(exact) = told_apart(analysis) else {
        return analysis.spectrum.distinct().iter().map(|e| eigenvalue_report(e, n)).collect();
    };
    let report = |e: &ExactEigenvalue| {
        let blocks = if e.frequency == 0 || 2 * e.frequency == n { 1 } else { 2 };
        EigenvalueReport {
            quantity: Quantity::of_eigenvalue(e, digits),
            frequency: e.frequency,
            algebraic: blocks * e.algebraic.unwrap_or(0),
            geometric: e.structure.map(|structure| blocks * structure.geometric),
            jordan: e.structure.map(|structure| structure.largest),
        }
    };
    exact.eigenvalues.iter().map(report).collect()
}

fn subdominant_report(analysis: &Analysis, digits: usize) -> Option<SubdominantReport> {
    let e = analysis.spectrum.subdominant()?;
    let exact = told_apart(analysis).and_then(|exact| Some(&exact.eigenvalues[exact.subdominant?]));
    let quantity = exact.map_or(Quantity::approximate(pair(e.value)), |e| Quantity::of_eigenvalue(e, digits));
    let frequency = exact.map_or(e.frequency, |e| e.frequency);
    let multiplicity = match exact.and_then(|e| e.algebraic) {
        Some(times) if frequency == 0 || 2 * frequency == analysis.valence => times,
        Some(times) => 2 * times,
        None => e.multiplicity(analysis.valence),
    };
    Some(SubdominantReport { quantity, frequency, multiplicity })
}

fn classical_report(analysis: &Analysis, e: &Eigenvalue, digits: usize) -> ClassicalReport {
    let lambda = analysis.lambda.map(|e| e.value.re);
    let own = told_apart(analysis).and_then(|exact| {
        let index = exact.largest_within(e.frequency, &analysis.classical.orbits)?;
        Some((exact, index, &exact.eigenvalues[index]))
    });
    ClassicalReport {
        value: own
            .filter(|(_, _, own)| own.is_real())
            .map_or(e.real().unwrap_or(e.modulus()), |(_, _, own)| own.re.midpoint_f64()),
        ratio: lambda.map(|lambda| e.modulus() / (lambda * lambda)),
        exact: own.and_then(|(_, _, own)| own.exact.as_ref()).map(|words| words.text.clone()),
        formula: own.and_then(|(_, _, own)| own.formula.as_ref()).map(|words| words.text.clone()),
        shown_ratio: match (own, lambda) {
            (Some((exact, index, _)), Some(_)) => ratio_to_square(exact, index, digits),
            (None, Some(lambda)) => Some(Quantity::approximate([e.modulus() / (lambda * lambda), 0.0])),
            _ => None,
        },
    }
}

/// |e|/lambda^2, where lambda is determined; exactly 1 where that is known.
fn ratio_to_square(exact: &ExactAnalysis, index: usize, digits: usize) -> Option<Quantity> {
    let lambda = &exact.eigenvalues[exact.lambda?];
    if exact.against_square.get(index).copied().flatten() == Some(std::cmp::Ordering::Equal) {
        let one = Words { text: "1".to_string(), latex: "1".to_string() };
        return Some(Quantity::of(&Value::exact_whole(1), Some(&one), digits));
    }
    let modulus = exact.eigenvalues[index].modulus_squared.sqrt().ok()?;
    let ratio = crate::numbers::Field::over(&modulus, &lambda.modulus_squared).ok()?;
    Some(Quantity::of(&ratio, None, digits))
}

fn largest_by_frequency(analysis: &Analysis, digits: usize) -> Vec<Option<Quantity>> {
    let mut largest = vec![None; analysis.valence / 2 + 1];
    if let Some(exact) = told_apart(analysis) {
        for (_, e) in exact.after_one() {
            largest[e.frequency].get_or_insert_with(|| Quantity::of_eigenvalue(e, digits));
        }
        return largest;
    }
    for e in analysis.spectrum.after_one() {
        largest[e.frequency].get_or_insert_with(|| Quantity::approximate(pair(e.value)));
    }
    largest
}

/// Without negative zeros.
fn pair(value: Complex64) -> [f64; 2] {
    [value.re + 0.0, value.im + 0.0]
}

fn eigenvalue_report(e: &Eigenvalue, n: usize) -> EigenvalueReport {
    EigenvalueReport {
        quantity: Quantity::approximate(pair(e.value)),
        frequency: e.frequency,
        algebraic: e.multiplicity(n),
        geometric: e.is_isolated().then(|| e.multiplicity(n)),
        jordan: e.is_isolated().then_some(1),
    }
}

fn subsubdominant_report(analysis: &Analysis, digits: usize) -> Option<SubsubdominantReport> {
    let class = curvature_of(analysis).map(|Curvature { class, .. }| class);
    let lambda = analysis.lambda.map(|e| e.value.re);
    let over_square = |modulus: f64| lambda.map(|lambda| modulus / (lambda * lambda));
    if let Some(exact) = told_apart(analysis) {
        let (index, first) = exact.after_subdominant().next()?;
        let tied: Vec<_> = exact.after_subdominant().filter(|(_, e)| e.level == first.level).collect();
        let mut frequencies: Vec<usize> = tied.iter().map(|(_, e)| e.frequency).collect();
        frequencies.dedup();
        let jordan: Option<Vec<usize>> = tied.iter().map(|(_, e)| Some(e.structure?.largest)).collect();
        let modulus = first.modulus_squared.sqrt().ok()?;
        let positive = first.is_real() && first.re.sign() == Some(std::cmp::Ordering::Greater);
        let shown = Quantity::of(&modulus, first.exact.as_ref().filter(|_| positive), digits);
        return Some(SubsubdominantReport {
            modulus: shown.value[0],
            exact: first.exact.as_ref().map(|words| words.text.clone()),
            frequencies,
            ratio: over_square(shown.value[0]),
            jordan: jordan.and_then(|sizes| sizes.into_iter().max()),
            shown,
            shown_ratio: ratio_to_square(exact, index, digits),
            class,
        });
    }
    let first = analysis.spectrum.after_subdominant().next()?;
    let modulus = first.modulus();
    let tied = analysis.spectrum.after_subdominant().take_while(|e| modulus - e.modulus() <= first.approx_error);
    let mut frequencies: Vec<usize> = tied.map(|e| e.frequency).collect();
    frequencies.sort_unstable();
    frequencies.dedup();
    let ratio = over_square(modulus);
    Some(SubsubdominantReport {
        modulus,
        exact: None,
        frequencies,
        ratio,
        jordan: None,
        shown: Quantity::approximate([modulus, 0.0]),
        shown_ratio: ratio.map(|ratio| Quantity::approximate([ratio, 0.0])),
        class,
    })
}

/// The limit mask; its weights exact where they are known so.
fn limit_report(analysis: &Analysis, names: &OrbitNames, digits: usize) -> Option<Vec<WeightReport>> {
    let mut weights = mask_report(analysis.limit_mask.as_ref()?, analysis, names);
    for weight in &mut weights {
        let orbit = weight.orbit.map(|[i, j]| (i, j));
        if let Some(own) = exact_limit(analysis, orbit) {
            weight.weight = own.value.midpoint_f64() + 0.0;
            weight.decimal = own.value.decimal(digits);
            weight.exact = own.exact.as_ref().map(|words| words.text.clone());
            weight.latex = own.exact.as_ref().map(|words| words.latex.clone());
        }
    }
    weights.retain(|weight| weight.weight != 0.0);
    Some(weights)
}

/// The exact weight of an orbit, or (`None`) the centre, in the limit mask.
fn exact_limit(analysis: &Analysis, orbit: Option<(i32, i32)>) -> Option<&ExactWeight> {
    let exact = analysis.exact.as_ref().ok()?;
    let mask = exact.limit_mask.as_ref()?;
    let Some(orbit) = orbit else { return mask.centre.as_ref() };
    let index = exact.orbits.iter().position(|own| *own == orbit)?;
    Some(&mask.orbits[index].0)
}

/// The tangent masks by orbit: exact, or from the approximate amplitudes a = own + next w^-1.
fn tangent_forms(analysis: &Analysis, names: &OrbitNames, digits: usize) -> Option<Vec<FormReport>> {
    let turn = std::f64::consts::TAU / analysis.valence as f64;
    let exact = analysis.exact.as_ref().ok().and_then(|exact| exact.tangent_mask.as_ref());
    let masks = analysis.tangent_masks.as_ref()?;
    let form = |t: usize| {
        let (i, j) = analysis.local.orbits[t];
        let (own, next) = match exact {
            Some(mask) => {
                let quantity = |weight: &ExactWeight| Quantity::of(&weight.value, weight.exact.as_ref(), digits);
                (quantity(&mask.orbits[t].0), quantity(&mask.orbits[t].1))
            }
            None => {
                let amplitude = masks[0].amplitudes[t];
                let next = -amplitude.im / libm::sin(turn);
                let own = amplitude.re - next * libm::cos(turn);
                (Quantity::approximate([own + 0.0, 0.0]), Quantity::approximate([next + 0.0, 0.0]))
            }
        };
        FormReport { at: names.name((i, j)), orbit: [i, j], own, next }
    };
    let all = (0..analysis.local.orbits.len()).map(form);
    Some(all.filter(|form| form.own.value[0].abs() > 1e-12 || form.next.value[0].abs() > 1e-12).collect())
}

fn mask_report(mask: &Mask, analysis: &Analysis, names: &OrbitNames) -> Vec<WeightReport> {
    let report = |(label, weight): (Label, f64)| {
        let is_centre = analysis.local.patch.centre() == Some(label);
        WeightReport {
            at: if is_centre { "centre".to_string() } else { names.name(label.orbit()) },
            sector: (!is_centre).then_some(label.sector),
            orbit: (!is_centre).then_some([label.i, label.j]),
            weight: weight + 0.0,
            decimal: None,
            exact: None,
            latex: None,
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
fn rule_weights(analysis: &Analysis, names: &OrbitNames, digits: usize) -> Vec<(String, Quantity)> {
    let local = &analysis.local;
    let quantity = |label: Label, weight: f64| {
        let exact = analysis.exact.as_ref().ok().and_then(|exact| exact.rule.iter().find(|(own, _)| *own == label));
        exact.map_or(Quantity::approximate([weight, 0.0]), |(_, own)| {
            Quantity::of(&own.value, own.exact.as_ref(), digits)
        })
    };
    if let Some(centre) = &local.centre {
        let own = centre.iter().find(|entry| entry.orbit.is_none());
        let own = own.map(|entry| ("centre".to_string(), quantity(Label { sector: 0, i: 0, j: 0 }, entry.weight)));
        let rings = (0..local.orbits.len()).filter_map(|orbit| {
            let (entry, (i, j)) = (centre.iter().find(|entry| entry.orbit == Some(orbit))?, local.orbits[orbit]);
            Some((names.name((i, j)), quantity(Label { sector: entry.sector, i, j }, entry.weight)))
        });
        return own.into_iter().chain(rings).collect();
    }
    let Some(first) = local.rows.first() else { return Vec::new() };
    let half = first.iter().filter(|entry| entry.orbit == Some(0) && 2 * entry.sector as usize <= analysis.valence);
    let mut weights: Vec<(u32, f64)> = half.map(|entry| (entry.sector, entry.weight)).collect();
    weights.sort_by_key(|(sector, _)| *sector);
    let named = |(sector, weight)| (format!("ring[{sector}]"), quantity(Label { sector, i: 0, j: 0 }, weight));
    weights.into_iter().map(named).collect()
}

fn amplitudes(analysis: &Analysis, names: &OrbitNames, digits: usize) -> Vec<AmplitudeReport> {
    let limit = |t: usize| {
        let approximate = analysis.limit_mask.as_ref().map(|mask| [mask.amplitudes[t].re + 0.0, 0.0]);
        let exact = exact_limit(analysis, Some(analysis.local.orbits[t]));
        exact.map(|own| Quantity::of(&own.value, own.exact.as_ref(), digits)).or(approximate.map(Quantity::approximate))
    };
    let row = |t: usize| AmplitudeReport { at: names.name(analysis.local.orbits[t]), limit: limit(t) };
    (0..analysis.local.orbits.len()).map(row).collect()
}

/// The centre's weight in the limit mask, for tables.
pub(super) fn centre_weight(v: &ValenceReport) -> Option<Quantity> {
    let weight = v.limit_mask.as_ref()?.iter().find(|weight| weight.orbit.is_none())?;
    Some(Quantity {
        value: [weight.weight, 0.0],
        decimal: weight.decimal.clone(),
        exact: weight.exact.clone(),
        formula: None,
        latex: weight.latex.clone(),
    })
}
