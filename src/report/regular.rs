//! What does the report say of regular meshes?
//!
//! The mask and its symbol, sum rules, polynomials, the spline, smoothness: of the scheme at the values of its parameters, and once more with
//! the parameters left free.

use super::tables::{Cell, Table};
use crate::analysis::exact::words::{Words, free_in_words};
use crate::analysis::regular::box_spline::BoxSpline;
use crate::analysis::regular::differences::{Contraction, Proof};
use crate::analysis::regular::factors::Factors;
use crate::analysis::regular::mask::{Mask, Point, Sequence, bounds};
use crate::analysis::regular::special::values_with_more;
use crate::analysis::regular::{Regular, Smoothness};
use crate::numbers::{Field, Free, MOST_PARAMETERS};
use crate::scheme::Scheme;
use dashu_base::{Gcd, UnsignedAbs};
use dashu_int::UBig;
use dashu_ratio::RBig;
use serde::Serialize;

/// The scheme on regular meshes; exact.
#[derive(Clone, Debug, Serialize)]
pub struct RegularReport {
    /// The parameters that are left free, in which everything is a function and holds for general values.
    pub free: Vec<String>,
    /// The rows of the dilation matrix.
    pub dilation: [Point; 2],
    /// The coefficients of the mask on a rectangle.
    pub mask: RegularMaskReport,
    /// The symbol as a product, in z1 and z2.
    pub symbol: String,
    /// The symbol is that of so many steps at once, whose dilation matrix is m I.
    pub steps: u32,
    /// The stencil of each kind of new points.
    pub submasks: Vec<SubmaskReport>,
    /// The order of the sum rules.
    pub sum_rules: usize,
    /// The degree of polynomials that limits include.
    pub generation_degree: Option<usize>,
    /// The degree of polynomials whose samples are reproduced.
    pub reproduction_degree: Option<usize>,
    /// The point beta of the lattice stands for the parameter beta + shift.
    pub shift: [String; 2],
    /// Smoothing factors.
    pub factors: Vec<FactorReport>,
    /// What is left of the symbol, without number and monomial; `1` for box splines.
    pub kernel: String,
    /// The box spline or tensor-product B-spline that limits are.
    pub spline: Option<SplineReport>,
    /// How smooth limits are.
    pub smoothness: SmoothnessReport,
    /// Values of the one free parameter at which the order of the sum rules is higher.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub special: Vec<SpecialReport>,
    /// The symbol in LaTeX.
    #[serde(skip)]
    pub latex: String,
    /// The mask over one denominator, for tables; `None` where it has free parameters.
    #[serde(skip)]
    pub over: Option<(Vec<Vec<String>>, String)>,
}

/// The scheme at a special value of its parameter.
#[derive(Clone, Debug, Serialize)]
pub struct SpecialReport {
    /// The value.
    pub value: String,
    /// The order of the sum rules.
    pub sum_rules: usize,
    /// The degree of polynomials whose samples are reproduced.
    pub reproduction_degree: Option<usize>,
    /// Limits are proved to be C^r for this r.
    pub continuity: Option<usize>,
}

/// The coefficients of a mask.
#[derive(Clone, Debug, Serialize)]
pub struct RegularMaskReport {
    /// The point of the first coefficient.
    pub first: Point,
    /// Row by row; from left to right the first coordinate grows, from row to row the second.
    pub rows: Vec<Vec<String>>,
}

/// The stencil of the new points of a coset.
#[derive(Clone, Debug, Serialize)]
pub struct SubmaskReport {
    /// The new point.
    pub coset: Point,
    /// Old points with their weights.
    pub weights: Vec<OldPoint>,
}

/// An old point of a stencil.
#[derive(Clone, Debug, Serialize)]
pub struct OldPoint {
    /// The point.
    pub point: Point,
    /// Its weight.
    pub weight: String,
}

/// A smoothing factor.
#[derive(Clone, Debug, Serialize)]
pub struct FactorReport {
    /// The direction v of 1 + z^v (for M = m I: the sum of z^(iv), i below m).
    pub direction: Point,
    /// How often it divides the symbol.
    pub times: usize,
}

/// A box spline.
#[derive(Clone, Debug, Serialize)]
pub struct SplineReport {
    /// What it is called.
    pub name: String,
    /// The total degree of its pieces.
    pub degree: usize,
    /// The degrees of a tensor product.
    pub bidegree: Option<[usize; 2]>,
    /// Whether its shifts are linearly independent.
    pub independent: bool,
}

/// How smooth limits are.
#[derive(Clone, Debug, Serialize)]
pub struct SmoothnessReport {
    /// Limits are proved to be C^r for this r.
    pub continuity: Option<usize>,
    /// Limits are proved not to be C^(r+1) for all data (not continuous where there is no r).
    pub sharp: bool,
    /// Why, or what is missing.
    pub why: String,
    /// The difference schemes that were shown to be contractive.
    pub contractive: Vec<ContractiveReport>,
}

/// A contractive difference scheme.
#[derive(Clone, Debug, Serialize)]
pub struct ContractiveReport {
    /// The directions whose factors were divided by; the differences are those of divided differences of one order less. None where the
    /// differences are those of all directions.
    pub directions: Vec<Point>,
    /// The order of the differences.
    pub order: usize,
    /// After so many steps ...
    pub steps: u32,
    /// ... the norm is this (a decimal that is a little larger, where it is a long fraction) ...
    pub norm: String,
    /// ... below this, which is what the theorem asks.
    pub below: String,
}

/// The regular part of a scheme whose parameters are left free; `None` without parameters, or where there is no such form.
pub fn with_parameters_free(scheme: &Scheme) -> Option<Regular> {
    let mut free = scheme.with_values();
    let names: Vec<String> = scheme.book.parameters.iter().filter(|p| !p.integer).map(|p| p.name.clone()).collect();
    for name in names.iter().filter(|name| !scheme.book.conditions_depend_on(name)).take(MOST_PARAMETERS) {
        free.leave_free(name).ok()?;
    }
    if free.free_parameters().is_empty() { None } else { Regular::of(&free).ok() }
}

/// The report of a regular part.
pub fn regular_report(regular: &Regular) -> RegularReport {
    let mask = &regular.mask;
    let written = |value: &Free| free_in_words(value, &mask.parameters).text;
    let submask = |coset: Point| SubmaskReport {
        coset,
        weights: mask.stencil(coset).into_iter().map(|(point, w)| OldPoint { point, weight: written(w) }).collect(),
    };
    let (straight, steps) = regular.straight.as_ref().map_or((mask, 1), |(straight, steps)| (straight, *steps));
    let Product { symbol, kernel } = Product::of(&regular.factors, straight);
    RegularReport {
        free: mask.parameters.clone(),
        dilation: mask.dilation.rows(),
        mask: RegularMaskReport {
            first: bounds(&mask.coefficients).map_or([0, 0], |(low, _)| low),
            rows: on_rectangle(&mask.coefficients, &written),
        },
        symbol: symbol.text,
        steps,
        latex: symbol.latex,
        submasks: mask.dilation.cosets().into_iter().map(submask).collect(),
        sum_rules: regular.moments.sum_rules,
        generation_degree: regular.generation(),
        reproduction_degree: regular.moments.reproduction,
        shift: regular.moments.shift.each_ref().map(written),
        factors: regular
            .factors
            .directions
            .iter()
            .map(|(direction, times)| FactorReport { direction: *direction, times: *times })
            .collect(),
        kernel: kernel.text,
        spline: regular.spline.as_ref().map(spline_report),
        smoothness: smoothness_report(regular),
        special: special(regular),
        over: over_one_denominator(&mask.coefficients),
    }
}

fn special(regular: &Regular) -> Vec<SpecialReport> {
    let report = |(value, own): (RBig, Regular)| SpecialReport {
        value: value.to_string(),
        sum_rules: own.moments.sum_rules,
        reproduction_degree: own.moments.reproduction,
        continuity: own.smoothness.proved(),
    };
    values_with_more(regular).unwrap_or_default().into_iter().map(report).collect()
}

fn spline_report(spline: &BoxSpline) -> SplineReport {
    SplineReport {
        name: spline.name(),
        degree: spline.degree(),
        bidegree: spline.bidegree(),
        independent: spline.is_independent(),
    }
}

fn smoothness_report(regular: &Regular) -> SmoothnessReport {
    let (sharp, why, proof) = match &regular.smoothness {
        Smoothness::Exactly(_, proof, why) => (true, format!("contractive difference schemes; {why}"), Some(proof)),
        Smoothness::AtLeast(_, proof) => (false, "contractive difference schemes".to_string(), Some(proof)),
        Smoothness::NotContinuous(why) => (true, (*why).to_string(), None),
        Smoothness::Undecided(why) => (false, (*why).to_string(), None),
    };
    let contractive = |proof: &Proof| {
        let report = |directions: &[Point], order: usize, found: &Contraction| ContractiveReport {
            directions: directions.to_vec(),
            order,
            steps: found.steps,
            norm: rounded_up(found),
            below: found.below.to_string(),
        };
        let own = proof.contractive.iter().map(|(directions, found)| report(directions, directions.len(), found));
        own.chain(proof.all.iter().map(|(order, found)| report(&[], *order, found))).collect()
    };
    let continuity = regular.smoothness.proved();
    SmoothnessReport { continuity, sharp, why, contractive: proof.map_or(vec![], contractive) }
}

/// The coefficients row by row on the least rectangle.
fn on_rectangle(sequence: &Sequence, written: &dyn Fn(&Free) -> String) -> Vec<Vec<String>> {
    let Some((low, high)) = bounds(sequence) else { return vec![] };
    let cell = |point: Point| sequence.get(&point).map_or("0".to_string(), written);
    (low[1]..=high[1]).map(|y| (low[0]..=high[0]).map(|x| cell([x, y])).collect()).collect()
}

/// The rational coefficients as whole numbers over one denominator, with that.
fn over_one_denominator(sequence: &Sequence) -> Option<(Vec<Vec<String>>, String)> {
    let mut denominator = UBig::ONE;
    for value in sequence.values() {
        let own = value.as_rational()?.denominator().clone();
        denominator = &denominator / (&denominator).gcd(&own) * own;
    }
    let scale = RBig::from(denominator.clone());
    let whole = |value: &Free| value.as_rational().map_or(String::new(), |value| (value * &scale).to_string());
    Some((on_rectangle(sequence, &whole), denominator.to_string()))
}

/// The symbol written as number, monomial, smoothing factors and kernel; factors and kernel are polynomials without a monomial in them.
struct Product {
    symbol: Words,
    kernel: Words,
}

impl Product {
    fn of(factors: &Factors, mask: &Mask) -> Product {
        let arity = mask.dilation.arity().unwrap_or(1);
        let low = bounds(&factors.kernel).map_or([0, 0], |(low, _)| low);
        let content = content(&factors.kernel);
        let scale = content.as_ref().map_or(Free::whole(1), Free::rational);
        let bare = factors.kernel.iter().filter_map(|([x, y], value)| {
            let value = value.over(&scale).ok()?;
            Some(([x - low[0], y - low[1]], value))
        });
        let kernel = polynomial(&bare.collect(), &mask.parameters);
        // 1 + z1/z2 is (z1 + z2)/z2
        let mut power = low;
        let mut written = Vec::new();
        for (v, times) in &factors.directions {
            let start = [0, (1 - arity) * v[1].min(0)];
            power[1] -= start[1] * *times as i32;
            let terms = (0..arity).map(|step| ([start[0] + step * v[0], start[1] + step * v[1]], Free::whole(1)));
            let sum = polynomial(&terms.collect(), &[]);
            let exponent = if *times > 1 { times.to_string() } else { String::new() };
            written.push(parenthesized(&sum, &exponent));
        }
        if kernel.text != "1" {
            written.push(parenthesized(&kernel, ""));
        }
        let number = free_in_words(&scale, &[]);
        let front = [number, monomial(power)].into_iter().filter(|words| !words.text.is_empty() && words.text != "1");
        let all: Vec<Words> = front.chain(written).collect();
        let text = all.iter().map(|words| words.text.as_str()).collect::<Vec<_>>().join("*");
        let latex = all.iter().map(|words| words.latex.as_str()).collect::<Vec<_>>().join("\\,");
        Product { symbol: Words { text, latex }, kernel }
    }
}

fn parenthesized(sum: &Words, exponent: &str) -> Words {
    let (text, latex) = match exponent {
        "" => (String::new(), String::new()),
        _ => (format!("^{exponent}"), format!("^{{{exponent}}}")),
    };
    Words { text: format!("({}){text}", sum.text), latex: format!("({}){latex}", sum.latex) }
}

/// z^v in words; nothing for 1.
fn monomial(v: Point) -> Words {
    let (mut text, mut latex) = (vec![], String::new());
    for (name, exponent) in [("1", v[0]), ("2", v[1])] {
        match exponent {
            0 => {}
            1 => {
                text.push(format!("z{name}"));
                latex.push_str(&format!("z_{name}"));
            }
            _ => {
                text.push(format!("z{name}^{exponent}"));
                latex.push_str(&format!("z_{name}^{{{exponent}}}"));
            }
        }
    }
    Words { text: text.join("*"), latex }
}

/// A polynomial in words.
fn polynomial(sequence: &Sequence, parameters: &[String]) -> Words {
    let mut sum = Words { text: String::new(), latex: String::new() };
    let mut terms: Vec<_> = sequence.iter().collect();
    terms.sort_by_key(|([x, y], _)| (x + y, -x));
    for (point, value) in terms {
        let negative = free_in_words(value, parameters).text.starts_with('-');
        let modulus = if negative { value.negated() } else { value.clone() };
        let term = term(&modulus, &monomial(*point), parameters);
        let sign = match (sum.text.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        sum.text.push_str(&format!("{sign}{}", term.text));
        sum.latex.push_str(&format!("{sign}{}", term.latex));
    }
    sum
}

/// A coefficient times a monomial.
fn term(value: &Free, monomial: &Words, parameters: &[String]) -> Words {
    let number = free_in_words(value, parameters);
    if *value == Free::whole(1) && !monomial.text.is_empty() {
        return monomial.clone();
    }
    let number = if number.text.contains(' ') { parenthesized(&number, "") } else { number };
    let times = if monomial.text.is_empty() { "" } else { "*" };
    Words { text: format!("{}{times}{}", number.text, monomial.text), latex: number.latex + &monomial.latex }
}

/// The positive rational number by which rational coefficients become whole without a common divisor; `None` with parameters.
fn content(sequence: &Sequence) -> Option<RBig> {
    let (mut above, mut below) = (UBig::ZERO, UBig::ONE);
    for value in sequence.values() {
        let value = value.as_rational()?;
        let own = value.numerator().clone().unsigned_abs();
        above = if above.is_zero() { own } else { above.gcd(own) };
        let own = value.denominator().clone();
        below = &below / (&below).gcd(&own) * own;
    }
    Some(RBig::from_parts(above.into(), below))
}

impl RegularReport {
    /// The smoothness in a few words.
    pub fn smoothness_in_words(&self) -> String {
        let own = &self.smoothness;
        match (own.continuity, own.sharp) {
            (Some(r), true) => format!("C{r}, not C{}", r + 1),
            (Some(r), false) => format!("at least C{r}"),
            (None, true) => "not continuous".to_string(),
            (None, false) => "not decided".to_string(),
        }
    }

    /// The norms of the difference schemes.
    fn norms(&self) -> String {
        let own = self.smoothness.contractive.iter().map(|scheme| {
            let directions: Vec<String> = scheme.directions.iter().map(|v| place(*v)).collect();
            let directions = directions.join(" and ");
            let after = format!("norm {} after {}", scheme.norm, steps(scheme.steps));
            match scheme.directions.is_empty() {
                true => format!("all differences of order {}: {after}, below {}", scheme.order, scheme.below),
                false => format!("divided by the factors of {directions}: {after}"),
            }
        });
        own.collect::<Vec<_>>().join("; ")
    }
}

/// A norm in full, or, where that is long, rounded up to six decimals if it stays below.
fn rounded_up(found: &Contraction) -> String {
    let (exact, million) = (found.norm.to_string(), RBig::from(1_000_000));
    let up = RBig::from((&found.norm * &million).ceil()) / million;
    if exact.len() <= 12 || up >= found.below { exact } else { format!("{:.6}", up.to_f64().value()) }
}

fn steps(number: u32) -> String {
    if number == 1 { "one step".to_string() } else { format!("{number} steps") }
}

fn place([x, y]: Point) -> String {
    format!("({x}, {y})")
}

fn degree(degree: Option<usize>) -> String {
    degree.map_or("not even constants".to_string(), |degree| format!("up to degree {degree}"))
}

/// Kernels with more letters than this are left to the JSON form.
const LONGEST: usize = 700;

/// The rows of the table for one regular part.
fn rows(report: &RegularReport) -> Vec<Vec<Cell>> {
    let cell = |name: &str, text: String| vec![Cell::from(name), Cell::from(text)];
    let mut rows = vec![];
    if report.symbol.len() <= LONGEST {
        let text = report.symbol.replace('*', " ");
        let latex = Some(format!("$\\displaystyle {}$", report.latex));
        let name = if report.steps == 1 {
            "symbol a(z1, z2)".to_string()
        } else {
            format!("symbol of {} steps", report.steps)
        };
        rows.push(vec![name.into(), Cell { text, latex }]);
    }
    let independent = |spline: &SplineReport| match spline.independent {
        true => "its shifts are linearly independent",
        false => "its shifts are linearly dependent",
    };
    if let Some(spline) = &report.spline {
        rows.push(cell("spline", format!("{}; {}", spline.name, independent(spline))));
    }
    rows.push(cell("sum rules", format!("of order {}", report.sum_rules)));
    let known = report.spline.is_some() || report.smoothness.continuity.is_some();
    let generated = degree(report.generation_degree) + if known { "" } else { ", if the scheme converges" };
    rows.push(cell("polynomials generated", generated));
    rows.push(cell("polynomials reproduced", degree(report.reproduction_degree)));
    let shift = &report.shift;
    rows.push(cell("parameters of the points", format!("lattice + ({}, {})", shift[0], shift[1])));
    for own in &report.special {
        let smooth = own.continuity.map_or(String::new(), |r| format!(", limits at least C{r}"));
        let reproduced = degree(own.reproduction_degree);
        let what = format!("sum rules of order {}, polynomials reproduced {reproduced}{smooth}", own.sum_rules);
        rows.push(cell(&format!("{} = {}", report.free.join(""), own.value), what));
    }
    rows.push(cell("smoothness", report.smoothness_in_words()));
    rows.push(cell("by", report.smoothness.why.clone()));
    if !report.smoothness.contractive.is_empty() {
        rows.push(cell("difference schemes", report.norms()));
    }
    for submask in report.submasks.iter().filter(|own| report.free.is_empty() && own.weights.len() <= 16) {
        rows.push(cell(&format!("new point {}", place(submask.coset)), stencil(submask)));
    }
    rows
}

/// A stencil, points of the same weight together.
fn stencil(submask: &SubmaskReport) -> String {
    let mut groups: Vec<(&str, Vec<String>)> = vec![];
    for OldPoint { point, weight } in &submask.weights {
        match groups.iter_mut().find(|(own, _)| own == weight) {
            Some((_, points)) => points.push(place(*point)),
            None => groups.push((weight, vec![place(*point)])),
        }
    }
    let written = groups.iter().map(|(weight, points)| format!("{weight} at {}", points.join(" ")));
    written.collect::<Vec<_>>().join("; ")
}

/// The title of the main table.
pub const TITLE: &str = "Regular part";

/// The tables: what is known, the mask, and what is known for every value of the parameters.
pub(super) fn tables(report: Option<&RegularReport>, free: Option<&RegularReport>) -> Vec<Table> {
    let Some(report) = report else { return vec![] };
    let head = |words: [&str; 2]| words.map(str::to_string).to_vec();
    let note = "The scheme on regular meshes, exactly: a new point alpha is made of the old points beta with the weights a(alpha - M beta), and \
                the symbol is the sum of a(alpha) z^alpha. Coordinates are those of a sector: (1, 0) and (0, 1) are two edges at a vertex, and on triangles \
                (-1, 1) is the third direction. Sum rules of order k: a step takes polynomials of degree below k to such, and limits include them all. Reproduced are \
                polynomials whose samples at the parameters of the points give samples of the same polynomial. Smoothness is that of all limits; the \
                difference schemes have the symbol divided by smoothing factors.";
    let mut tables = vec![Table {
        title: TITLE.to_string(),
        note: note.to_string(),
        head: head(["property", "value"]),
        rows: rows(report),
    }];
    tables.extend(mask_table(report));
    if let Some(free) = free {
        let names = free.free.join(" and ");
        tables.push(Table {
            title: format!("Regular part for general {names}"),
            note: format!("The same with {names} left free; single values may have more."),
            head: head(["property", "value"]),
            // smoothness is decided at single values only
            rows: rows(free).into_iter().filter(|row| !["smoothness", "by"].contains(&row[0].text.as_str())).collect(),
        });
    }
    tables
}

/// Masks wider than this are left to the JSON form.
const WIDEST: usize = 15;

fn mask_table(report: &RegularReport) -> Option<Table> {
    let (whole, denominator) = report.over.as_ref().filter(|(rows, _)| rows.iter().all(|row| row.len() <= WIDEST))?;
    let first = report.mask.first;
    let width = whole.first()?.len();
    let head = std::iter::once("j \\ i".to_string()).chain((0..width).map(|x| (first[0] + x as i32).to_string()));
    let line = |(y, row): (usize, &Vec<String>)| {
        let shown = row.iter().map(|value| if value == "0" { "".into() } else { Cell::from(value.as_str()) });
        std::iter::once((first[1] + y as i32).to_string().into()).chain(shown).collect::<Vec<Cell>>()
    };
    let mut rows: Vec<Vec<Cell>> = whole.iter().enumerate().map(line).collect();
    rows.reverse();
    Some(Table {
        title: "Mask on regular meshes".to_string(),
        note: format!("The coefficients a(i, j) times {denominator}; empty ones are 0."),
        head: head.collect(),
        rows,
    })
}

/// The regular part in a line or two, for a terminal.
pub(super) fn terminal(report: &RegularReport) -> String {
    let spline = report.spline.as_ref().map_or(String::new(), |spline| format!(" {},", spline.name));
    let bare = |degree: Option<usize>| degree.map_or("none".to_string(), |degree| degree.to_string());
    format!(
        "On regular meshes:{spline} {};\nsum rules of order {}, polynomials generated to degree {}, reproduced to degree {}.\n",
        report.smoothness_in_words(),
        report.sum_rules,
        bare(report.generation_degree),
        bare(report.reproduction_degree)
    )
}
