//! What does the scheme do at boundaries, creases, corners and darts?

use super::model::{PointReport, Quantity, ResidualReport, WeightReport};
use super::tables::{Cell, Table};
use super::{NoReport, csv::quoted};
use crate::analysis::boundary::exact::ExactHalves;
use crate::analysis::boundary::halves::Parity;
use crate::analysis::boundary::masks::{FanMask, TangentMasks};
use crate::analysis::boundary::modes::Mode;
use crate::analysis::boundary::{BoundaryAnalysis, BoundaryAnalyzer};
use crate::analysis::exact::{ExactEigenvalue, ExactWeight};
use crate::analysis::spectrum::Eigenvalue;
use crate::mesh::{FanKind, Label};
use crate::refine::{Obstacle, OrbitNames, Refinement, cycle_of, lattice_of};
use crate::scheme::{RuleBook, Scheme, catalogue};
use crate::verdicts::{
    ClaimCheck, Decision, Evidence, Outcome, Verdict, bound, c1_up_to_boundary, check_boundary_claims,
};
use serde::Serialize;
use std::collections::BTreeSet;
use std::fmt::Write;

/// The most eigenvalues of a part that a table lists.
const MOST_EIGENVALUES: usize = 8;

/// The most weights of a mask that a table lists.
const MOST_WEIGHTS: usize = 16;

/// The report of one kind of vertex.
#[derive(Clone, Debug, Serialize)]
pub struct BoundaryReport {
    /// crease, corner or dart.
    pub kind: &'static str,
    /// The boundary file whose rules are taken.
    pub variant: String,
    /// Whose rules these are.
    pub source: Vec<String>,
    /// The number of faces: k, at a dart n.
    pub faces: usize,
    /// The s by which points around the vertex are moved towards its tangent plane after a step, where they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flatness: Option<f64>,
    /// The size of the full neighbourhood.
    pub size: usize,
    /// Refinement steps in one application of the matrix.
    pub steps: u32,
    /// The factor by which these steps shrink the lattice.
    pub dilation: u32,
    /// Every eigenvalue, largest modulus first.
    pub eigenvalues: Vec<ParityReport>,
    /// `exact` or `approximate`: that of eigenvalues and of the limit mask. All else is approximate.
    pub arithmetic: &'static str,
    /// Why it is not exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why_not_exact: Option<String>,
    /// Weights of the limit mask.
    pub limit_mask: Option<Vec<WeightReport>>,
    /// Weights of the two tangent masks.
    pub tangent_masks: Option<[Vec<WeightReport>; 2]>,
    /// The eigenvalues that these belong to.
    pub tangent_eigenvalues: Option<[ParityReport; 2]>,
    /// The control net of the characteristic map.
    pub characteristic_map: Option<Vec<PointReport>>,
    /// Why a mask is not there.
    pub why_not: Vec<String>,
    /// Whether the surface is C1 up to the boundary.
    pub verdict: Verdict,
    /// What the boundary file claims for this vertex, compared with the analysis.
    pub claims: Vec<ClaimCheck>,
    /// A power of ten above the approximate residuals of all right and left vectors that were computed, and their number.
    pub residual: ResidualReport,
}

/// An eigenvalue of one part, or a cluster of approximately equal ones.
#[derive(Clone, Debug, Serialize)]
pub struct ParityReport {
    /// The value.
    #[serde(flatten)]
    pub quantity: Quantity,
    /// even or odd under the mirror.
    pub parity: &'static str,
    /// How often it counts.
    pub algebraic: usize,
    /// The dimension of its eigenspace; null where approximately equal eigenvalues can't be told apart.
    pub geometric: Option<usize>,
    /// The size of its largest Jordan block; null likewise.
    pub jordan: Option<usize>,
    /// The wave over the sector that its eigenvector is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mode: Option<ModeReport>,
}

/// A wave over the sector.
#[derive(Clone, Debug, Serialize)]
pub struct ModeReport {
    /// sine or cosine.
    pub wave: &'static str,
    /// m: the wave is sin(j m pi/k) or cos(j m pi/k) on spoke j; at a dart 2 pi/n stands for pi/k.
    pub number: usize,
    /// `exact` where exact rows show it, else `approximate`: so looks the vector in floating numbers.
    pub arithmetic: &'static str,
    /// Its eigenvalue for all k, or the equation that it solves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub formula: Option<String>,
}

/// A boundary file under its name.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Its name, as it was asked for.
    pub name: String,
    /// Its rules.
    pub book: RuleBook,
}

impl Variant {
    /// The boundary files that a scheme names, the default first.
    ///
    /// # Errors
    /// When the scheme names none; faults of the files.
    pub fn all_of(scheme: &Scheme) -> Result<Vec<Variant>, NoReport> {
        let open = |name: &String| {
            let book = catalogue::boundary(name, &scheme.mesh).ok_or_else(|| no_boundary_file(scheme))?;
            Ok(Variant { name: name.clone(), book: book.map_err(NoReport::Faults)? })
        };
        if scheme.boundary.is_empty() {
            Err(no_boundary_file(scheme))
        } else {
            scheme.boundary.iter().map(open).collect()
        }
    }
}

/// What is said where there are no rules to be taken.
pub fn no_boundary_file(scheme: &Scheme) -> NoReport {
    let why = if cycle_of(scheme).is_ok_and(|cycle| cycle.keeps_boundary()) {
        "the scheme names no boundary file, whose rules the analysis at a boundary takes: add for example boundary = [\"cubic\"] to the \
         scheme file"
            .to_string()
    } else {
        format!("under its splits the boundary recedes, and there is no analysis there: {}", scheme.split_in_words())
    };
    NoReport::Obstacle(Obstacle::Limit(why))
}

/// The reports at these numbers of faces: crease and corner, and from three faces on the dart, with each of the boundary files; those of one
/// kind of vertex stand side by side.
///
/// # Errors
/// Faults of the files, or what stood in the way.
pub fn boundary(
    scheme: &Scheme,
    variants: &[Variant],
    faces: &[usize],
    digits: usize,
    done: &dyn Fn(),
) -> Result<Vec<BoundaryReport>, NoReport> {
    let names = OrbitNames::of(&Refinement::<f64>::new(scheme, None), lattice_of(scheme));
    let mut counts = faces.to_vec();
    counts.push(scheme.regular_valence() / 2);
    let mut analyzers = Vec::new();
    for variant in variants {
        variant.book.check(&counts, scheme.regular_valence()).map_err(NoReport::Faults)?;
        let analyzer = BoundaryAnalyzer::new(scheme, &variant.book);
        let analyzer = analyzer.map_err(|obstacle| NoReport::of(scheme)(by_rules(variant, obstacle)))?;
        analyzers.push((variant, analyzer));
    }
    let mut reports = Vec::new();
    let creases_inside = cycle_of(scheme).map_err(NoReport::of(scheme))?.keeps_edges();
    for kind in FanKind::each(faces, creases_inside) {
        for (variant, analyzer) in &analyzers {
            let analysis = analyzer.at(kind).map_err(|obstacle| NoReport::of(scheme)(by_rules(variant, obstacle)))?;
            let exact = analyzer.exact(&analysis.local);
            let mut own = report(variant, &analysis, exact, &names, digits);
            let claims = check_boundary_claims(&variant.book, &analysis, &own.verdict);
            let s = analyzer.flatness(kind).map_err(NoReport::of(scheme))?;
            own.flatness = (s > 0.0).then_some(s);
            own.claims = claims.map_err(|fault| NoReport::Faults(variant.book.faults(vec![fault])))?;
            reports.push(own);
        }
        done();
    }
    Ok(reports)
}

/// What stands in the way, with the boundary file that lacks a rule.
fn by_rules(variant: &Variant, obstacle: Obstacle) -> Obstacle {
    match obstacle {
        Obstacle::NoRule(_) => Obstacle::Limit(format!("by the rules `{}`: {obstacle}", variant.name)),
        other => other,
    }
}

fn report(
    variant: &Variant,
    analysis: &BoundaryAnalysis,
    exact: Result<ExactHalves, Obstacle>,
    names: &OrbitNames,
    digits: usize,
) -> BoundaryReport {
    let (residual, vectors) = analysis.spectrum.approx_residual(&analysis.halves, &analysis.cores);
    let tangents = analysis.tangent_masks.as_ref().ok();
    let (known, why_not_exact) = match exact {
        Ok(exact) => (Some(exact), None),
        Err(why) => (None, Some(why.to_string())),
    };
    let spell = |mask: &FanMask| mask.iter().map(|(label, weight)| spelled(analysis, names, *label, *weight)).collect();
    BoundaryReport {
        kind: analysis.fan.kind().name(),
        variant: variant.name.clone(),
        source: variant.book.all_sources(),
        faces: analysis.fan.sectors() as usize,
        flatness: None,
        size: analysis.local.size(),
        steps: 1,
        dilation: 2,
        eigenvalues: match &known {
            Some(exact) => exact_eigenvalues(analysis, exact, digits),
            None => {
                let with_mode = |e: &Eigenvalue| ParityReport { mode: seen(analysis, e), ..approximate_eigenvalue(e) };
                analysis.spectrum.distinct().iter().map(with_mode).collect()
            }
        },
        verdict: c1_up_to_boundary(analysis, known.as_ref()),
        claims: vec![],
        arithmetic: if known.is_some() { "exact" } else { "approximate" },
        why_not_exact,
        limit_mask: analysis.limit_mask.as_ref().ok().map(|mask| {
            let known = known.as_ref().and_then(|exact| exact.limit_mask.as_ref());
            mask.iter()
                .map(|(label, weight)| {
                    let own = known.and_then(|mask| mask.iter().find(|(point, _)| point == label));
                    let plain = spelled(analysis, names, *label, *weight);
                    own.map_or(plain.clone(), |(_, own)| with_exact(plain, own, digits))
                })
                .collect()
        }),
        tangent_masks: tangents.map(|own| own.masks.each_ref().map(spell)),
        tangent_eigenvalues: tangents.map(|own| tangent_eigenvalues(own, known.as_ref(), digits)),
        characteristic_map: tangents.map(|own| net(analysis, own)),
        why_not: [analysis.limit_mask.as_ref().err(), analysis.tangent_masks.as_ref().err()]
            .into_iter()
            .flatten()
            .cloned()
            .collect(),
        residual: ResidualReport { bound: bound(residual), vectors },
    }
}

fn exact_eigenvalue(e: &ExactEigenvalue, digits: usize) -> ParityReport {
    ParityReport {
        quantity: Quantity::of_eigenvalue(e, digits),
        parity: Parity::of_part(e.frequency).name(),
        algebraic: e.algebraic.unwrap_or(0),
        geometric: e.structure.map(|structure| structure.geometric),
        jordan: e.structure.map(|structure| structure.largest),
        mode: None,
    }
}

/// Exact eigenvalues with the waves that their vectors are: exactly so, or as seen in floating numbers.
fn exact_eigenvalues(analysis: &BoundaryAnalysis, exact: &ExactHalves, digits: usize) -> Vec<ParityReport> {
    let mut reports: Vec<ParityReport> = exact.eigenvalues.iter().map(|e| exact_eigenvalue(e, digits)).collect();
    for e in analysis.spectrum.distinct() {
        let own = exact.eigenvalue_at(&e).and_then(|own| exact.eigenvalues.iter().position(|e| std::ptr::eq(e, own)));
        if let Some(at) = own {
            reports[at].mode = seen(analysis, &e);
        }
    }
    for (at, mode) in &exact.sines {
        let formula = exact.sine_rows.as_ref().and_then(|rows| rows.formula(mode.number));
        reports[*at].mode = Some(ModeReport { wave: mode.name(), number: mode.number, arithmetic: "exact", formula });
    }
    reports
}

/// The wave that an eigenvector is as far as floating numbers tell.
fn seen(analysis: &BoundaryAnalysis, e: &Eigenvalue) -> Option<ModeReport> {
    let (vector, _) = analysis.spectrum.right_vector(&analysis.halves, &analysis.cores, e)?;
    let mode = Mode::of_vector(&analysis.local, &vector)?;
    Some(ModeReport { wave: mode.name(), number: mode.number, arithmetic: "approximate", formula: None })
}

fn approximate_eigenvalue(e: &Eigenvalue) -> ParityReport {
    ParityReport {
        quantity: Quantity::approximate([e.value.re + 0.0, e.value.im + 0.0]),
        parity: Parity::of_part(e.frequency).name(),
        algebraic: e.cluster,
        geometric: e.is_isolated().then_some(1),
        jordan: e.is_isolated().then_some(1),
        mode: None,
    }
}

/// The eigenvalues of the tangents, exact where they are known so.
fn tangent_eigenvalues(own: &TangentMasks, exact: Option<&ExactHalves>, digits: usize) -> [ParityReport; 2] {
    let report = |axis: usize| {
        let e = &own.eigenvalues[axis];
        let known = exact.and_then(|exact| exact.eigenvalue_at(e)).map(|e| exact_eigenvalue(e, digits));
        known.unwrap_or_else(|| ParityReport { jordan: Some(own.jordan[axis]), ..approximate_eigenvalue(e) })
    };
    [report(0), report(1)]
}

fn spelled(analysis: &BoundaryAnalysis, names: &OrbitNames, label: Label, weight: f64) -> WeightReport {
    let is_centre = label == analysis.fan.centre();
    WeightReport {
        at: if is_centre { "centre".to_string() } else { names.name(label.orbit()) },
        sector: (!is_centre).then_some(label.sector),
        orbit: (!is_centre).then_some([label.i, label.j]),
        weight: weight + 0.0,
        decimal: None,
        exact: None,
        latex: None,
    }
}

fn with_exact(weight: WeightReport, own: &ExactWeight, digits: usize) -> WeightReport {
    WeightReport {
        weight: own.value.midpoint_f64() + 0.0,
        decimal: own.value.decimal(digits),
        exact: own.exact.as_ref().map(|words| words.text.clone()),
        latex: own.exact.as_ref().map(|words| words.latex.clone()),
        ..weight
    }
}

fn net(analysis: &BoundaryAnalysis, own: &TangentMasks) -> Vec<PointReport> {
    let points = analysis.local.labels.iter().zip(&own.net);
    points.map(|(Label { sector, i, j }, xy)| PointReport { sector: *sector, orbit: [*i, *j], xy: *xy }).collect()
}

/// The tables of a report.
pub(super) fn tables(reports: &[BoundaryReport]) -> Vec<Table> {
    if reports.is_empty() {
        return vec![];
    }
    let mut tables = vec![overview(reports), masks(reports), eigenvalues(reports)];
    tables.extend(reports.iter().any(|own| !own.claims.is_empty()).then(|| claims(reports)));
    tables
}

fn claims(reports: &[BoundaryReport]) -> Table {
    let row = |at: usize, claim: &ClaimCheck| {
        let value = claim.equals.clone().unwrap_or_default();
        let cells = [claim.what.clone(), value, in_words(claim.outcome).to_string(), claim.seen.clone()];
        (at, cells.into_iter().map(Cell::from).collect::<Vec<Cell>>())
    };
    let rows = reports.iter().enumerate().flat_map(|(at, own)| own.claims.iter().map(move |claim| row(at, claim)));
    let note = "What boundary files claim, with their sources, compared with what was found at each vertex (to 1e-12; approximate).";
    let title = ("Claims of boundary files", note.to_string());
    table(reports, title, &["claim", "value", "outcome", "seen"], rows)
}

fn in_words(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Agrees => "agrees",
        Outcome::Disagrees => "disagrees",
        Outcome::Undecided => "undecided",
    }
}

/// The names of the boundary files, in order.
fn variants(reports: &[BoundaryReport]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for own in reports {
        if !names.contains(&own.variant.as_str()) {
            names.push(&own.variant);
        }
    }
    names
}

/// A table with the columns `vertex` and `k`, and with `rules` where boundary files stand side by side.
fn table(
    reports: &[BoundaryReport],
    (title, note): (&str, String),
    head: &[&str],
    rows: impl Iterator<Item = (usize, Vec<Cell>)>,
) -> Table {
    let several = variants(reports).len() > 1;
    let place = |own: &BoundaryReport| -> Vec<Cell> {
        let rules = several.then(|| own.variant.as_str().into());
        [own.kind.into(), own.faces.to_string().into()].into_iter().chain(rules).collect()
    };
    let rules = if several { &["rules"][..] } else { &[] };
    let head = ["vertex", "k"].iter().chain(rules).chain(head).map(|word| (*word).to_string()).collect();
    let rows = rows.map(|(at, cells)| place(&reports[at]).into_iter().chain(cells).collect()).collect();
    Table { title: title.to_string(), note, head, rows }
}

/// The title of the first table.
pub const TITLE: &str = "At a boundary";

fn overview(reports: &[BoundaryReport]) -> Table {
    let names = variants(reports);
    let files = if names.len() > 1 { "Boundary files" } else { "Boundary file" };
    let note = format!(
        "{files}: {}. A boundary is a crease with nothing beyond it; k is the number of faces on one side of it, at a corner those \
         between its two edges, at a dart all around the vertex at which a crease ends. The largest eigenvalues after 1, over the full \
         neighbourhood of the size given, with their parity under the mirror and the wave over the sector that the vector is: sine mode m is sin(j m pi/k) \
         on spoke j. The masks and whether there is a tangent plane are approximate: the \
         characteristic map is looked at by its control net around the vertex.",
        names.join(", ")
    );
    let row = |(at, own): (usize, &BoundaryReport)| {
        let rest = own.after_one();
        let leading: Vec<Cell> = rest.take(3).map(eigenvalue).collect();
        let c1 = in_short(&own.verdict);
        (at, vec![own.size.to_string().into(), Cell::joined(&leading), own.tangent_plane().into(), c1.into()])
    };
    let head = ["size", "largest eigenvalues after 1", "tangent plane", "C1 up to the boundary"];
    table(reports, (TITLE, note), &head, reports.iter().enumerate().map(row))
}

/// `undecided (evidence for)`
fn in_short(verdict: &Verdict) -> String {
    match (verdict.verdict, verdict.evidence) {
        (Decision::Proved, _) => "proved".to_string(),
        (Decision::Refuted, _) => "refuted".to_string(),
        (Decision::Undecided, Evidence::For) => "undecided (evidence for)".to_string(),
        (Decision::Undecided, Evidence::Against) => "undecided (evidence against)".to_string(),
        (Decision::Undecided, Evidence::None) => "undecided".to_string(),
    }
}

impl BoundaryReport {
    /// The eigenvalues without the 1 of the constants, which is even and comes first.
    fn after_one(&self) -> impl Iterator<Item = &ParityReport> {
        let is_one = |e: &ParityReport| (e.quantity.value[0] - 1.0).abs() < 1e-9 && e.parity == "even";
        let one = self.eigenvalues.iter().position(is_one);
        self.eigenvalues.iter().enumerate().filter(move |(at, _)| Some(*at) != one).map(|(_, e)| e)
    }

    /// Whether there is a tangent plane, or why not.
    fn tangent_plane(&self) -> String {
        let slowly = |e: &ParityReport| e.jordan.is_some_and(|size| size > 1);
        let flat = self.flatness.map_or(String::new(), |s| format!("; flatness s = {s}"));
        let plane = match (&self.tangent_eigenvalues, self.why_not.last()) {
            (Some(own), _) if own.iter().any(slowly) => "yes; a Jordan block makes normals converge slowly".to_string(),
            (Some(_), _) => "yes".to_string(),
            (None, Some(why)) => why.clone(),
            (None, None) => "-".to_string(),
        };
        plane + &flat
    }
}

/// A value with its parity and its Jordan block.
fn eigenvalue(e: &ParityReport) -> Cell {
    let cell = Cell::number(&e.quantity, super::tables::SHORT);
    let times = if e.algebraic > 1 { format!(", {} times", e.algebraic) } else { String::new() };
    let block = match e.jordan {
        Some(size) if size > 1 => format!(", Jordan block of size {size}"),
        _ => String::new(),
    };
    let mode = e.mode.as_ref().map_or(String::new(), |mode| format!(", {} mode {}", mode.wave, mode.number));
    let remark = format!(" ({}{mode}{times}{block})", e.parity);
    Cell { text: format!("{}{remark}", cell.text), latex: cell.latex.map(|latex| format!("{latex}{remark}")) }
}

fn masks(reports: &[BoundaryReport]) -> Table {
    let note = "Left vectors, applied to the points at any level. Edge neighbours (ring) are counted from spoke 0, counter-clockwise. The limit mask \
                sums to 1. The first tangent runs along the crease, towards spoke 0; first x second is the outward normal; the largest weight of each \
                is 1 or -1. Longer masks are cut short here and whole in the JSON form.";
    let row = |at: usize, name: &str, mask: &[WeightReport]| (at, vec![name.into(), weights(mask).into()]);
    let rows = reports.iter().enumerate().flat_map(|(at, own)| {
        let limit = own.limit_mask.iter().map(move |mask| row(at, "limit", mask));
        let tangents = own.tangent_masks.iter().flatten().zip(["first tangent", "second tangent"]);
        limit.chain(tangents.map(move |(mask, name)| row(at, name, mask)))
    });
    table(reports, ("Masks at a boundary", note.to_string()), &["mask", "weights"], rows)
}

/// `centre 2/3, ring[0] 1/6, ring[3] 1/6`
fn weights(mask: &[WeightReport]) -> String {
    let shown = mask.iter().take(MOST_WEIGHTS).map(|weight| {
        let place = weight.sector.map_or(weight.at.clone(), |sector| format!("{}[{sector}]", weight.at));
        let exact = weight.exact.clone().filter(|text| text.chars().count() <= super::tables::SHORT);
        let value = exact.unwrap_or_else(|| weight.decimal.clone().unwrap_or_else(|| short(weight.weight)));
        format!("{place} {value}")
    });
    let more =
        if mask.len() > MOST_WEIGHTS { format!(", and {} more", mask.len() - MOST_WEIGHTS) } else { String::new() };
    shown.collect::<Vec<_>>().join(", ") + &more
}

/// A few digits; approximate.
fn short(value: f64) -> String {
    let text = format!("{value:.6}");
    format!("≈ {}", text.trim_end_matches('0').trim_end_matches('.'))
}

fn eigenvalues(reports: &[BoundaryReport]) -> Table {
    let row = |at: usize, own: &BoundaryReport, parity: Parity| -> (usize, Vec<Cell>) {
        let of_part: Vec<&ParityReport> = own.eigenvalues.iter().filter(|e| e.parity == parity.name()).collect();
        let mut cells: Vec<Cell> = of_part.iter().take(MOST_EIGENVALUES).map(|e| eigenvalue_of_part(e)).collect();
        if of_part.len() > MOST_EIGENVALUES {
            cells.push("...".into());
        }
        (at, vec![parity.name().into(), Cell::joined(&cells)])
    };
    let rows = reports.iter().enumerate().flat_map(|(at, own)| Parity::BOTH.map(|parity| row(at, own, parity)));
    let note = "Largest modulus first. The mirror exchanges the two sides; a function is even if it is the same in the mirror, odd if its sign changes.";
    let note = format!("{note}{}", formulas_of_modes(reports));
    table(reports, ("Eigenvalues at a boundary", note), &["part", "eigenvalues"], rows)
}

/// ` Sine modes for all k: ...`, where there are such.
fn formulas_of_modes(reports: &[BoundaryReport]) -> String {
    let modes =
        reports.iter().flat_map(|own| own.eigenvalues.iter().filter_map(move |e| Some((own, e.mode.as_ref()?))));
    let firsts = modes.filter(|(_, mode)| mode.number == 1 && mode.arithmetic == "exact");
    let formulas: BTreeSet<String> = firsts
        .filter_map(|(own, mode)| Some(format!("{} (rules `{}`)", mode.formula.as_ref()?, own.variant)))
        .collect();
    match formulas.len() {
        0 => String::new(),
        _ => format!(
            " Sine mode 1 has for all k the eigenvalue {}; mode m has m pi for pi.",
            formulas.into_iter().collect::<Vec<_>>().join(", ")
        ),
    }
}

fn eigenvalue_of_part(e: &ParityReport) -> Cell {
    let cell = eigenvalue(e);
    let plain = |text: String| text.replace(&format!(" ({})", e.parity), "").replace(&format!("({}, ", e.parity), "(");
    Cell { text: plain(cell.text), latex: cell.latex.map(plain) }
}

/// The numbers as one tidy table.
pub fn boundary_csv(reports: &[BoundaryReport]) -> String {
    let mut text = "kind,faces,rules,quantity,at,parity,sector,i,j,value,imaginary\n".to_string();
    for own in reports {
        let place = format!("{},{},{}", own.kind, own.faces, quoted(&own.variant));
        let _ = writeln!(text, "{place},size,,,,,,{},", own.size);
        if let Some(s) = own.flatness {
            let _ = writeln!(text, "{place},flatness,,,,,,{s},");
        }
        for e in &own.eigenvalues {
            for _ in 0..e.algebraic {
                let [re, im] = e.quantity.value;
                let _ = writeln!(text, "{place},eigenvalue,,{},,,,{re},{im}", e.parity);
            }
        }
        let limit = own.limit_mask.iter().map(|mask| ("limit mask", mask));
        let tangents =
            ["first tangent mask", "second tangent mask"].into_iter().zip(own.tangent_masks.iter().flatten());
        for (name, weight) in limit.chain(tangents).flat_map(|(name, mask)| mask.iter().map(move |w| (name, w))) {
            let sector = weight.sector.map_or(String::new(), |sector| sector.to_string());
            let (i, j) = weight.orbit.map_or((String::new(), String::new()), |[i, j]| (i.to_string(), j.to_string()));
            let _ = writeln!(text, "{place},{name},{},,{sector},{i},{j},{},", quoted(&weight.at), weight.weight);
        }
    }
    text
}

/// The numbers for a terminal.
pub fn terminal(reports: &[BoundaryReport]) -> String {
    let names = variants(reports);
    let [first, ..] = names[..] else { return String::new() };
    let width = if names.len() > 1 { names.iter().map(|name| name.len() + 1).max().unwrap_or(0) } else { 0 };
    let by = if names.len() > 1 { "several rules side by side".to_string() } else { format!("the rules `{first}`") };
    let mut text = format!(
        "\nAt a boundary, by {by}; the two largest eigenvalues after 1, with their parity:\n{:>8} {:>4} {:width$}{:>6} {:>28} {:>28}  tangent plane\n",
        "", "k", "", "points", "", ""
    );
    for own in reports {
        let rest = own.after_one();
        let mut leading = rest.map(|e| {
            let [re, im] = e.quantity.value;
            let value = if im == 0.0 { format!("{re:.10}") } else { format!("{re:.4}{im:+.4}i") };
            let mode = e.mode.as_ref().map_or(String::new(), |mode| format!(" {} {}", mode.wave, mode.number));
            format!("{value} {:<4}{mode:<10}", e.parity)
        });
        let mut next = || leading.next().unwrap_or("-".to_string());
        let (a, b) = (next(), next());
        let plane = own.tangent_plane().replacen("no tangent plane: ", "no: ", 1).replacen(
            "no tangent plane found: ",
            "none found: ",
            1,
        );
        let rules = if width > 0 { own.variant.as_str() } else { "" };
        let _ =
            writeln!(text, "{:>8} {:>4} {rules:<width$}{:>6} {a:>28} {b:>28}  {plane}", own.kind, own.faces, own.size);
    }
    for own in reports {
        for claim in own.claims.iter().filter(|claim| claim.outcome == Outcome::Disagrees) {
            let _ = writeln!(
                text,
                "claim '{}' of `{}` disagrees at {} faces: {}",
                claim.what, own.variant, own.faces, claim.seen
            );
        }
    }
    text
}
