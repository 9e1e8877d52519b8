//! Which data has the report of a scheme for curves?

use super::NoCurveReport;
use super::range::RangeReport;
use super::smoothness::{SmoothnessReport, facts, of_mask};
use crate::analysis::curve::convergence::convergence;
use crate::analysis::curve::difference::sum_rules;
use crate::analysis::curve::local::LocalMatrix;
use crate::analysis::curve::matrix_form::{matrix_form, spline_degree};
use crate::analysis::curve::point::{CurvePoint, IndexedWeight, MaskOf};
use crate::analysis::curve::spectrum::{CurveEigenvalue, is_diagonalizable};
use crate::numbers::enclosure::rational_decimal;
use crate::report::model::{FORMAT, Reference, reference};
use crate::scheme::curve::{CurveScheme, Mask, Rules};
use crate::verdicts::{ClaimCheck, check_curve_claims};
use dashu_ratio::RBig;
use serde::Serialize;
use std::collections::BTreeMap;

/// The report of a scheme for curves.
#[derive(Clone, Debug, Serialize)]
pub struct CurveReport {
    /// The version of the contract.
    pub format: u32,
    /// The scheme's short name.
    pub scheme: String,
    /// What it is called.
    pub title: String,
    /// `curve`.
    pub kind: &'static str,
    /// What kind of scheme it is.
    pub classification: CurveClass,
    /// The values of its parameters, as written.
    pub parameters: BTreeMap<String, String>,
    /// Whose it is.
    pub sources: Vec<Reference>,
    /// The weights of the mask; null for a scheme of halves.
    pub mask: Option<Vec<String>>,
    /// The index of the first of them.
    pub first_index: Option<i64>,
    /// New points for each old one.
    pub arity: u32,
    /// The factors 1 + z + ... + z^(a-1) of the symbol.
    pub sum_rules: Option<usize>,
    /// The matrices of both halves, for a scheme of halves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub halves: Option<[Vec<Vec<String>>; 2]>,
    /// The matrix form, for B-splines of arity 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matrix_form: Option<MatrixFormReport>,
    /// How smooth limit curves are; null where there are none, or it is not known.
    pub smoothness: Option<SmoothnessReport>,
    /// Why it is null.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why_no_smoothness: Option<String>,
    /// The largest degree of polynomials that are made, if the scheme converges.
    pub generation_degree: Option<usize>,
    /// The largest degree of polynomials that come back from their samples.
    pub reproduction_degree: Option<usize>,
    /// What is known on an interval of a parameter, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<RangeReport>,
    /// The marked points.
    pub points: Vec<CurvePointReport>,
    /// How fast polygons come near to the curve.
    pub convergence: Option<ConvergenceReport>,
    /// What the literature says, beside the analysis.
    pub claims: Vec<ClaimCheck>,
}

/// How a scheme for curves is classified.
#[derive(Clone, Debug, Serialize)]
pub struct CurveClass {
    /// The form in which the file tells it.
    pub form: &'static str,
    /// Whether vertices stay vertices; false where they become middles of edges, null where neither holds.
    pub primal: Option<bool>,
    /// Whether old points stay.
    pub interpolating: bool,
    /// Whether the mask is the same from both ends.
    pub symmetric: bool,
    /// Whether there are rules for the ends of open curves.
    pub end_rules: bool,
}

/// The matrices of spline subdivision.
#[derive(Clone, Debug, Serialize)]
pub struct MatrixFormReport {
    /// The degree.
    pub degree: usize,
    /// M, rows from the highest power down.
    pub basis: Vec<Vec<String>>,
    /// The diagonal of S.
    pub split: Vec<String>,
    /// H = M^-1 S M, of the first half.
    pub first_half: Vec<Vec<String>>,
    /// The same of the second half.
    pub second_half: Vec<Vec<String>>,
}

/// A marked point.
#[derive(Clone, Debug, Serialize)]
pub struct CurvePointReport {
    /// `vertex`, `mid-edge`, `start` or `end`.
    pub at: &'static str,
    /// Refinement steps in one application of the matrix.
    pub steps: u32,
    /// Steps before the matrix applies.
    pub steps_before: u32,
    /// The local matrix on the points that decide the value.
    pub minimal: LocalReport,
    /// The local matrix on the points that decide the curve around it.
    pub full: LocalReport,
    /// The limit mask.
    pub limit_mask: Option<Vec<WeightAt>>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why_no_limit: Option<String>,
    /// The tangent mask, scaled so that the sum of weight times index is 1.
    pub tangent_mask: Option<Vec<WeightAt>>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why_no_tangent: Option<String>,
    /// Masks of the first, second, ... derivative, with respect to the index.
    pub derivative_masks: Vec<Vec<WeightAt>>,
}

/// A local matrix with its eigenvalues.
#[derive(Clone, Debug, Serialize)]
pub struct LocalReport {
    /// The number of points.
    pub size: usize,
    /// Their indices.
    pub indices: Vec<i64>,
    /// The rows.
    pub matrix: Vec<Vec<String>>,
    /// The eigenvalues, the largest modulus first.
    pub eigenvalues: Vec<CurveEigenvalueReport>,
    /// Whether there is a basis of eigenvectors.
    pub diagonalizable: bool,
}

/// An eigenvalue of a local matrix.
#[derive(Clone, Debug, Serialize)]
pub struct CurveEigenvalueReport {
    /// Real and imaginary part.
    pub value: [f64; 2],
    /// With the digits asked for, where it is real.
    pub decimal: Option<String>,
    /// In the scheme language.
    pub exact: Option<String>,
    /// Multiplicity in the characteristic polynomial.
    pub algebraic: usize,
    /// Dimension of the eigenspace.
    pub geometric: usize,
    /// Size of the largest Jordan block.
    pub jordan: usize,
    /// Right eigenvectors, where it is rational.
    pub right: Vec<Vec<String>>,
    /// Left eigenvectors, where it is rational.
    pub left: Vec<Vec<String>>,
    /// In LaTeX.
    #[serde(skip)]
    pub latex: Option<String>,
}

/// A weight of a mask.
#[derive(Clone, Debug, Serialize)]
pub struct WeightAt {
    /// The index of its point.
    pub index: i64,
    /// The nearest floating number.
    pub weight: f64,
    /// With the digits asked for.
    pub decimal: Option<String>,
    /// Exactly; null where it is irrational.
    pub exact: Option<String>,
}

/// Distances from polygons to the curve.
#[derive(Clone, Debug, Serialize)]
pub struct ConvergenceReport {
    /// Level by level.
    pub distances: Vec<f64>,
    /// By which factor each is smaller than the one before; null where a distance is zero.
    pub factors: Vec<Option<f64>>,
}

pub(super) fn words(matrix: &[Vec<RBig>]) -> Vec<Vec<String>> {
    matrix.iter().map(|row| row.iter().map(RBig::to_string).collect()).collect()
}

impl CurveReport {
    /// Assembles the report.
    pub(super) fn new(
        scheme: &CurveScheme,
        rules: &Rules,
        points: &[CurvePoint],
        digits: usize,
    ) -> Result<CurveReport, NoCurveReport> {
        let mask = if let Rules::Mask(mask, _) = rules { Some(mask) } else { None };
        let halves = if let Rules::Halves(h) = rules { Some([words(&h.first), words(&h.second)]) } else { None };
        let claimed = scheme.claims.iter().flat_map(|claim| &claim.sources);
        let mut keys: Vec<&String> = Vec::new();
        for key in scheme.book.sources.iter().chain(claimed) {
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
        let parameters = scheme.book.parameters.iter();
        let found = mask.map(of_mask);
        let facts = found.as_ref().map(facts).unwrap_or_default();
        let claims = check_curve_claims(scheme, &facts);
        let claims = claims.map_err(|fault| NoCurveReport::Faults(scheme.book.faults(vec![fault])))?;
        Ok(CurveReport {
            format: FORMAT,
            scheme: scheme.id.clone(),
            title: scheme.book.title.clone(),
            kind: "curve",
            classification: classified(scheme, rules),
            parameters: parameters.map(|p| (p.name.clone(), p.value.formula.text().to_string())).collect(),
            sources: keys.into_iter().map(|key| reference(key)).collect(),
            mask: mask.map(|mask| mask.coefficients.iter().map(RBig::to_string).collect()),
            first_index: mask.map(|mask| mask.first),
            arity: mask.map_or(2, |mask| mask.arity),
            sum_rules: mask.map(sum_rules),
            halves,
            matrix_form: mask.and_then(matrices),
            smoothness: found.as_ref().and_then(|found| found.as_ref().ok()).map(SmoothnessReport::of),
            why_no_smoothness: found.and_then(Result::err).map(|none| none.why),
            generation_degree: facts.generation,
            reproduction_degree: facts.reproduction,
            claims,
            range: None,
            points: points.iter().map(|point| point_report(point, digits)).collect(),
            convergence: convergence(rules).map(|found| ConvergenceReport {
                distances: found.approx_distances.iter().map(|distance| rounded(*distance)).collect(),
                factors: found.approx_factors.iter().map(|f| f.is_finite().then(|| rounded(*f))).collect(),
            }),
        })
    }
}

/// Four significant digits: more would see the machine.
fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

fn classified(scheme: &CurveScheme, rules: &Rules) -> CurveClass {
    let mut class =
        CurveClass { form: scheme.form_word(), primal: None, interpolating: false, symmetric: false, end_rules: false };
    if let Rules::Mask(mask, ends) = rules {
        let (first, last) = mask.support().unwrap_or((0, 0));
        let arity = i64::from(mask.arity);
        let at = (first + last).rem_euclid(2);
        class.symmetric = mask.is_symmetric();
        class.primal = class.symmetric.then_some(at == 0);
        let centre = (first + last).div_euclid(2);
        let stays = |i: i64| (i - centre).rem_euclid(arity) == 0;
        let old = mask.terms().filter(|(i, value)| stays(*i) && !value.is_zero()).count();
        class.interpolating = at == 0 && old == 1 && mask.get(centre) == RBig::ONE;
        class.end_rules = ends.is_some();
    }
    class
}

fn matrices(mask: &Mask) -> Option<MatrixFormReport> {
    let degree = spline_degree(mask)?;
    let form = matrix_form(degree).ok()?;
    Some(MatrixFormReport {
        degree,
        basis: words(&form.basis),
        split: form.split.iter().map(RBig::to_string).collect(),
        first_half: words(&form.first_half),
        second_half: words(&form.second_half),
    })
}

fn point_report(point: &CurvePoint, digits: usize) -> CurvePointReport {
    let list = |mask: &MaskOf| mask.as_ref().ok().map(|mask| weights(mask, digits));
    CurvePointReport {
        at: point.at.name(),
        steps: point.minimal.steps,
        steps_before: point.steps_before,
        minimal: local(&point.minimal, &point.minimal_spectrum, digits),
        full: local(&point.full, &point.full_spectrum, digits),
        limit_mask: list(&point.limit),
        why_no_limit: point.limit.as_ref().err().cloned(),
        tangent_mask: list(&point.tangent),
        why_no_tangent: point.tangent.as_ref().err().cloned(),
        derivative_masks: point.derivatives.iter().map(|mask| weights(mask, digits)).collect(),
    }
}

fn weights(mask: &[IndexedWeight], digits: usize) -> Vec<WeightAt> {
    let weight = |own: &IndexedWeight| WeightAt {
        index: own.index,
        weight: own.value,
        decimal: own.exact.as_ref().map(|exact| rational_decimal(exact, digits)),
        exact: own.exact.as_ref().map(RBig::to_string),
    };
    mask.iter().map(weight).collect()
}

fn local(local: &LocalMatrix, spectrum: &[CurveEigenvalue], digits: usize) -> LocalReport {
    let eigenvalue = |e: &CurveEigenvalue| CurveEigenvalueReport {
        value: [e.value.re + 0.0, e.value.im + 0.0],
        decimal: match &e.rational {
            Some(value) => Some(rational_decimal(value, digits)),
            None => e.real.as_ref().and_then(|real| real.decimal(digits)),
        },
        exact: e.words.as_ref().map(|words| words.text.clone()),
        algebraic: e.algebraic,
        geometric: e.geometric,
        jordan: e.jordan,
        right: words(&e.right),
        left: words(&e.left),
        latex: e.words.as_ref().map(|words| words.latex.clone()),
    };
    LocalReport {
        size: local.indices.len(),
        indices: local.indices.clone(),
        matrix: words(&local.matrix),
        eigenvalues: spectrum.iter().map(eigenvalue).collect(),
        diagonalizable: is_diagonalizable(spectrum),
    }
}
