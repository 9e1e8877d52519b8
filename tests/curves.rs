//! Does what is said of curves hold: forms agree, masks and spectra are those that are printed, refining does what masks promise?
#![allow(clippy::unwrap_used)]

use dashu_ratio::RBig;
use eigenring::analysis::curve::convergence::{convergence, sample};
use eigenring::analysis::curve::difference::{difference, sum_rules};
use eigenring::analysis::curve::limit::CurveLimits;
use eigenring::analysis::curve::local::{Extent, neighbourhood};
use eigenring::analysis::curve::matrix_form::{half_of_mask, matrix_form, quadrant, spline_degree};
use eigenring::analysis::curve::point::{CurvePoint, Marked, points_of_halves, points_of_mask};
use eigenring::analysis::curve::product::{kronecker, product_mask, submask};
use eigenring::analysis::curve::spectrum::{is_diagonalizable, spectrum};
use eigenring::refine::curve::CurveRefiner;
use eigenring::scheme::catalogue;
use eigenring::scheme::curve::{CurveScheme, Ends, Mask, Rules};
use proptest::prelude::*;

fn ratio(a: i64, b: i64) -> RBig {
    RBig::from(a) / RBig::from(b)
}

fn over(denominator: i64, weights: &[i64]) -> Vec<RBig> {
    weights.iter().map(|w| ratio(*w, denominator)).collect()
}

/// A scheme of the catalogue with parameters set.
fn scheme(id: &str, settings: &[(&str, &str)]) -> CurveScheme {
    let mut scheme = catalogue::curve(id).unwrap_or_else(|| panic!("{id}")).unwrap_or_else(|faults| panic!("{faults}"));
    settings.iter().for_each(|(name, value)| scheme.book.set(name, value).unwrap());
    scheme
}

fn mask(id: &str, settings: &[(&str, &str)]) -> Mask {
    scheme(id, settings).mask().unwrap_or_else(|faults| panic!("{faults}"))
}

fn rules(id: &str, settings: &[(&str, &str)]) -> Rules {
    scheme(id, settings).rules().unwrap_or_else(|faults| panic!("{faults}"))
}

/// A scheme of one's own.
fn told(body: &str) -> CurveScheme {
    let text = format!("name = \"Own\"\nmesh = \"curve\"\n{body}");
    CurveScheme::parse("own", "own.toml", &text).unwrap_or_else(|faults| panic!("{faults}"))
}

fn point(points: &[CurvePoint], at: Marked) -> &CurvePoint {
    points.iter().find(|point| point.at == at).unwrap()
}

fn weights(mask: &[eigenring::analysis::curve::point::IndexedWeight]) -> Vec<(i64, RBig)> {
    mask.iter().map(|w| (w.index, w.exact.clone().unwrap())).collect()
}

fn listed(denominator: i64, weights: &[(i64, i64)]) -> Vec<(i64, RBig)> {
    weights.iter().map(|(index, w)| (*index, ratio(*w, denominator))).collect()
}

fn eigenvalues(point: &[eigenring::analysis::curve::spectrum::CurveEigenvalue]) -> Vec<(String, usize, usize)> {
    point.iter().map(|e| (e.rational.as_ref().map_or("-".into(), RBig::to_string), e.algebraic, e.jordan)).collect()
}

// ---- the catalogue ----

#[test]
fn every_curve_of_the_catalogue_has_weights_and_cites_known_sources() {
    for entry in catalogue::CURVES {
        let scheme = scheme(entry.id, &[]);
        scheme.rules().unwrap_or_else(|faults| panic!("{faults}"));
        for source in scheme.book.sources.iter().chain(scheme.claims.iter().flat_map(|claim| &claim.sources)) {
            assert!(catalogue::sources().contains_key(source), "{}: {source}", entry.id);
        }
    }
    for entry in catalogue::GRIDS {
        let grid = catalogue::grid(entry.id).unwrap().unwrap_or_else(|faults| panic!("{faults}"));
        grid.curves().unwrap_or_else(|faults| panic!("{faults}"));
    }
}

/// The masks as the founding documents and the papers print them.
#[test]
fn masks_are_those_that_are_printed() {
    assert_eq!(mask("chaikin", &[]).coefficients, over(4, &[1, 3, 3, 1]));
    assert_eq!(mask("b-spline", &[]), Mask::new(-2, 2, over(8, &[1, 4, 6, 4, 1])));
    assert_eq!(mask("b-spline", &[("d", "2")]).coefficients, over(4, &[1, 3, 3, 1]));
    assert_eq!(mask("b-spline", &[("d", "1")]), Mask::new(-1, 2, over(2, &[1, 2, 1])));
    assert_eq!(mask("four-point", &[]), Mask::new(-3, 2, over(16, &[-1, 0, 9, 16, 9, 0, -1])));
    let six = over(256, &[3, 0, -25, 0, 150, 256, 150, 0, -25, 0, 3]);
    assert_eq!(mask("six-point", &[]), Mask::new(-5, 2, six));
    let eight = [-5, 0, 49, 0, -245, 0, 1225, 2048, 1225, 0, -245, 0, 49, 0, -5];
    assert_eq!(mask("deslauriers-dubuc", &[]), Mask::new(-7, 2, over(2048, &eight)));
    // at mu = 1/11 over 99: Hassan and others
    let ternary = over(198, &[-8, -14, 0, 68, 152, 198, 152, 68, 0, -14, -8]);
    assert_eq!(mask("ternary-four-point", &[]), Mask::new(-5, 3, ternary));
    let cubic = over(27, &[1, 4, 10, 16, 19, 16, 10, 4, 1]);
    assert_eq!(mask("ternary-b-spline", &[]), Mask::new(-4, 3, cubic));
    let linear = over(4, &[1, 2, 3, 4, 3, 2, 1]);
    assert_eq!(mask("quaternary-b-spline", &[("d", "1")]).coefficients, linear);
    let third = over(3, &[1, 2, 2, 1]);
    assert_eq!(mask("corner-cutting", &[]).coefficients, third);
    assert_eq!(mask("corner-cutting", &[("alpha", "1/4"), ("beta", "1/4")]), mask("chaikin", &[]));
}

/// De Casteljau's halves of a cubic at 1/2, as printed.
#[test]
fn bezier_splits_as_printed() {
    let Rules::Halves(halves) = rules("bezier", &[]) else { panic!() };
    let left = [over(8, &[8, 0, 0, 0]), over(8, &[4, 4, 0, 0]), over(8, &[2, 4, 2, 0]), over(8, &[1, 3, 3, 1])];
    let right = [over(8, &[1, 3, 3, 1]), over(8, &[0, 2, 4, 2]), over(8, &[0, 0, 4, 4]), over(8, &[0, 0, 0, 8])];
    assert_eq!((halves.first, halves.second), (left.to_vec(), right.to_vec()));
}

/// Every claim of every file that is made for the default values agrees; so do those of other values.
#[test]
fn claims_of_the_catalogue_agree() {
    let mut seen = 0;
    let mut agree = |id: &str, settings: &[(&str, &str)]| {
        let scheme = scheme(id, settings);
        let document = eigenring::report::curve::curve(&scheme, None, 10, false).unwrap();
        let json: serde_json::Value = serde_json::from_str(&document.json).unwrap();
        for (claim, told) in json["claims"].as_array().unwrap().iter().zip(&scheme.claims) {
            let expected = if scheme.claim_is_made(told).unwrap() { "agrees" } else { "undecided" };
            assert_eq!(claim["outcome"], expected, "{id} {settings:?}: {claim}");
            seen += usize::from(expected == "agrees");
        }
    };
    catalogue::CURVES.iter().for_each(|listed| agree(listed.id, &[]));
    (1..=8).for_each(|d| agree("b-spline", &[("d", &d.to_string())]));
    ["1/100", "1/32", "1/10", "3/20", "19/100"].iter().for_each(|w| agree("four-point", &[("w", w)]));
    ["3/40", "1/12", "1/10"].iter().for_each(|mu| agree("ternary-four-point", &[("mu", mu)]));
    assert!(seen > 60, "{seen}");
}

/// Published exponents: Dyn and Levin 2002; Hechler, Moessner and Reif 2009; Hassan and others 2002.
#[test]
fn the_report_tells_smoothness() {
    let told = |id: &str, settings: &[(&str, &str)]| -> serde_json::Value {
        serde_json::from_str(&eigenring::report::curve::curve(&scheme(id, settings), None, 10, false).unwrap().json)
            .unwrap()
    };
    let four = told("four-point", &[("w", "1/16")]);
    assert_eq!((&four["smoothness"]["continuity"], &four["smoothness"]["hoelder"]["exact"]), (&1.into(), &"2".into()));
    assert_eq!(four["smoothness"]["hoelder"]["attained"], false);
    let chaikin = told("chaikin", &[]);
    assert_eq!((&chaikin["smoothness"]["continuity"], &chaikin["generation_degree"]), (&1.into(), &2.into()));
    for (id, name, value, exponent) in [
        ("four-point", "w", "1/32", 1.228_447),
        ("four-point", "w", "1/10", 1.583_705),
        ("four-point", "w", "3/20", 1.222_856),
        ("six-point", "theta", "3/256", 2.830_075),
        ("ternary-four-point", "mu", "1/11", 2.182_658),
    ] {
        let own = told(id, &[(name, value)]);
        let hoelder = &own["smoothness"]["hoelder"];
        let (low, high) = (hoelder["lower"].as_f64().unwrap(), hoelder["upper"].as_f64().unwrap());
        assert!(low - 6e-7 <= exponent && exponent <= high + 6e-7 && high - low < 1e-5, "{id} {value}: {low} {high}");
    }
    let wild = told("four-point", &[("w", "1/2")]);
    assert!(wild["smoothness"].is_null() && wild["why_no_smoothness"].is_string());
}

// ---- the forms of a file agree ----

#[test]
fn mask_symbol_and_average_agree() {
    let same = |a: &str, b: &str| {
        let (a, b) = (told(a).mask().unwrap(), told(b).mask().unwrap());
        assert_eq!(a.starting_at(0), b.starting_at(0));
        a == b
    };
    assert!(same("mask = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"]\nfirst = -2", "average = [\"0\", \"1/2\", \"1/2\"]"));
    assert!(same("mask = [\"1/8\", \"1/2\", \"3/4\", \"1/2\", \"1/8\"]", "average = [\"1/4\", \"1/2\", \"1/4\"]"));
    assert!(same("mask = \"binom(4, j)/8\"\ntaps = 5", "symbol = \"(1 + z)^4/8/z^2\""));
    assert!(same("mask = \"binom(4, i)/8\"\ntaps = 5\nfirst = 0", "symbol = \"(1 + z)^4/8\""));
    let four = "mask = [\"-1/16\", \"0\", \"9/16\", \"1\", \"9/16\", \"0\", \"-1/16\"]";
    assert!(same(four, "average = [\"-2/16\", \"5/16\", \"10/16\", \"5/16\", \"-2/16\"]\naveraged = \"midpoints\""));
    // the symbol of the four-point scheme (Dyn 1992): (1 + z)^4 (-1 + 4 z - z^2)/(16 z^3)
    assert!(same(four, "symbol = \"(1 + z)^4*(-1 + 4*z - z^2)/(16*z^3)\""));
}

#[test]
fn families_agree_with_their_members() {
    for m in 1..=8 {
        let (m, d) = (m.to_string(), (m + 1).to_string());
        let spline = mask("b-spline", &[("d", &d)]);
        assert_eq!(mask("lane-riesenfeld", &[("m", &m)]).coefficients, spline.coefficients);
    }
    assert_eq!(mask("deslauriers-dubuc", &[("N", "2")]), mask("four-point", &[]));
    assert_eq!(mask("deslauriers-dubuc", &[("N", "3")]), mask("six-point", &[]));
    assert_eq!(mask("deslauriers-dubuc", &[("N", "1")]), mask("b-spline", &[("d", "1")]));
    assert_eq!(mask("six-point", &[("theta", "0")]), mask("four-point", &[]));
}

/// The weights of the Deslauriers-Dubuc schemes by Lagrange's formula at 1/2.
#[test]
fn deslauriers_and_dubuc_interpolate_polynomials() {
    for n in 1..=8_i64 {
        let own = mask("deslauriers-dubuc", &[("N", &n.to_string())]);
        let nodes: Vec<i64> = (1 - n..=n).collect();
        for j in &nodes {
            let others = nodes.iter().filter(|i| *i != j);
            let weight = others.fold(RBig::ONE, |w, i| w * (ratio(1, 2) - RBig::from(*i)) / RBig::from(j - i));
            assert_eq!(own.get(1 - 2 * j), weight, "N = {n}, j = {j}");
        }
    }
}

// ---- local matrices ----

/// The example of the founding documents: the cubic B-spline on (L, C, R).
#[test]
fn the_cubic_b_spline_comes_out_as_printed() {
    let points = points_of_mask(&mask("b-spline", &[]), None).unwrap();
    let vertex = point(&points, Marked::Vertex);
    assert_eq!(vertex.minimal.indices, [-1, 0, 1]);
    assert_eq!(vertex.minimal.matrix, [over(8, &[4, 4, 0]), over(8, &[1, 6, 1]), over(8, &[0, 4, 4])]);
    let simple = |values: &[&str]| values.iter().map(|v| ((*v).to_string(), 1, 1)).collect::<Vec<_>>();
    assert_eq!(eigenvalues(&vertex.minimal_spectrum), simple(&["1", "1/2", "1/4"]));
    let right: Vec<Vec<RBig>> = vertex.minimal_spectrum.iter().map(|e| e.right[0].clone()).collect();
    assert_eq!(right, [over(1, &[1, 1, 1]), over(1, &[-1, 0, 1]), over(1, &[2, -1, 2])]);
    assert!(is_diagonalizable(&vertex.minimal_spectrum));
    assert_eq!(weights(vertex.limit.as_ref().unwrap()), listed(6, &[(-1, 1), (0, 4), (1, 1)]));
    assert_eq!(weights(vertex.tangent.as_ref().unwrap()), listed(2, &[(-1, -1), (1, 1)]));
    assert_eq!(weights(&vertex.derivatives[1]), listed(1, &[(-1, 1), (0, -2), (1, 1)]));
    // the full matrix: five points, 1/8 twice more
    assert_eq!(vertex.full.indices, [-2, -1, 0, 1, 2]);
    let full: Vec<(String, usize)> = eigenvalues(&vertex.full_spectrum).into_iter().map(|(v, a, _)| (v, a)).collect();
    assert_eq!(full, [("1".into(), 1), ("1/2".into(), 1), ("1/4".into(), 1), ("1/8".into(), 2)]);
    // between two vertices the curve is (1, 23, 23, 1)/48
    let middle = point(&points, Marked::MidEdge);
    assert_eq!((middle.steps_before, middle.minimal.steps), (1, 1));
    assert_eq!(weights(middle.limit.as_ref().unwrap()), listed(48, &[(-1, 1), (0, 23), (1, 23), (2, 1)]));
}

/// Chaikin's scheme is dual: middles of edges stay, vertices become middles. Its curve touches the middles of the sides.
#[test]
fn chaikin_touches_the_middles_of_its_sides() {
    let points = points_of_mask(&mask("chaikin", &[]), None).unwrap();
    let middle = point(&points, Marked::MidEdge);
    assert_eq!(weights(middle.limit.as_ref().unwrap()), listed(2, &[(0, 1), (1, 1)]));
    assert_eq!(weights(middle.tangent.as_ref().unwrap()), listed(1, &[(0, -1), (1, 1)]));
    let vertex = point(&points, Marked::Vertex);
    assert_eq!(vertex.steps_before, 1);
    assert_eq!(weights(vertex.limit.as_ref().unwrap()), listed(8, &[(-1, 1), (0, 6), (1, 1)]));
    assert_eq!(weights(vertex.tangent.as_ref().unwrap()), listed(2, &[(-1, -1), (1, 1)]));
}

/// The four-point scheme has a Jordan block of 1/4 (Dyn, Gregory and Levin 1987), so that curvatures grow without bound.
#[test]
fn the_four_point_scheme_has_a_jordan_block() {
    let points = points_of_mask(&mask("four-point", &[]), None).unwrap();
    let vertex = point(&points, Marked::Vertex);
    let found = eigenvalues(&vertex.minimal_spectrum);
    assert_eq!(found, [("1".into(), 1, 1), ("1/2".into(), 1, 1), ("1/4".into(), 2, 2), ("1/8".into(), 1, 1)]);
    assert_eq!(weights(vertex.limit.as_ref().unwrap()), listed(1, &[(0, 1)]));
    assert_eq!(weights(vertex.tangent.as_ref().unwrap()), listed(12, &[(-2, 1), (-1, -8), (1, 8), (2, -1)]));
    assert_eq!(vertex.derivatives.len(), 1);
    let other = points_of_mask(&mask("four-point", &[("w", "1/32")]), None).unwrap();
    assert!(is_diagonalizable(&point(&other, Marked::Vertex).minimal_spectrum));
}

/// A ternary scheme: vertices and middles both stay. Derivatives of cubic splines are the same whatever the arity.
#[test]
fn binary_and_ternary_splines_have_the_same_masks() {
    for d in ["1", "2", "3", "4", "5", "6"] {
        let at = |id| points_of_mask(&mask(id, &[("d", d)]), None).unwrap();
        let (two, three, four) = (at("b-spline"), at("ternary-b-spline"), at("quaternary-b-spline"));
        for marked in [Marked::Vertex, Marked::MidEdge] {
            let of = |points: &[CurvePoint]| weights(point(points, marked).limit.as_ref().unwrap());
            // the index of p_0 may be another where neither a vertex nor a middle is the middle of the mask
            let plain = |list: Vec<(i64, RBig)>| list.into_iter().map(|(_, w)| w).collect::<Vec<_>>();
            assert_eq!(plain(of(&two)), plain(of(&three)), "{d} {marked:?}");
            assert_eq!(plain(of(&two)), plain(of(&four)), "{d} {marked:?}");
        }
    }
}

#[test]
fn ends_of_open_curves() {
    let start = |id| {
        let Rules::Mask(mask, Some(ends)) = rules(id, &[]) else { panic!() };
        point(&points_of_mask(&mask, Some(&ends)).unwrap(), Marked::Start).clone()
    };
    let natural = start("cubic-b-spline-natural");
    assert_eq!(natural.full.matrix, [over(8, &[8, 0, 0]), over(8, &[4, 4, 0]), over(8, &[1, 6, 1])]);
    assert_eq!(weights(natural.limit.as_ref().unwrap()), listed(1, &[(0, 1)]));
    assert_eq!(weights(natural.tangent.as_ref().unwrap()), listed(1, &[(0, -1), (1, 1)]));
    // no eigenvalue 1/4: the curvature at the end is zero
    assert!(eigenvalues(&natural.full_spectrum).iter().all(|(value, ..)| value != "1/4"));
    let clamped = start("cubic-b-spline-clamped");
    assert_eq!(weights(clamped.limit.as_ref().unwrap()), listed(1, &[(0, 1)]));
    assert_eq!(weights(clamped.tangent.as_ref().unwrap()), listed(1, &[(0, -1), (1, 1)]));
    assert!(eigenvalues(&clamped.full_spectrum).iter().any(|(value, ..)| value == "1/4"));
}

#[test]
fn bezier_curves_end_in_their_polygons() {
    for d in ["1", "2", "3", "5", "8"] {
        let Rules::Halves(halves) = rules("bezier", &[("d", d), ("t", "1/3")]) else { panic!() };
        for own in points_of_halves(&halves).unwrap() {
            assert_eq!(weights(own.limit.as_ref().unwrap()), listed(1, &[(0, 1)]));
            assert_eq!(weights(own.tangent.as_ref().unwrap()), listed(1, &[(0, -1), (1, 1)]));
        }
        let start = &points_of_halves(&halves).unwrap()[0];
        let powers: Vec<RBig> = (0..=d.parse().unwrap()).map(|k| RBig::ONE / RBig::from(3).pow(k)).collect();
        let found: Vec<RBig> = start.full_spectrum.iter().map(|e| e.rational.clone().unwrap()).collect();
        assert_eq!(found, powers);
    }
}

// ---- equations ----

/// S V = V Lambda, U S = Lambda U, exactly, for every rational eigenvalue of every scheme; multiplicities add up to the size.
#[test]
fn eigenvectors_fulfil_their_equations() {
    for entry in catalogue::CURVES {
        let points = match rules(entry.id, &[]) {
            Rules::Mask(mask, ends) => points_of_mask(&mask, ends.as_ref()).unwrap(),
            Rules::Halves(halves) => points_of_halves(&halves).unwrap(),
        };
        for own in points {
            for (local, spectrum) in [(&own.minimal, &own.minimal_spectrum), (&own.full, &own.full_spectrum)] {
                let size = local.indices.len();
                assert_eq!(spectrum.iter().map(|e| e.algebraic).sum::<usize>(), size, "{}", entry.id);
                for e in spectrum {
                    let Some(value) = &e.rational else { continue };
                    assert_eq!(e.right.len(), e.geometric, "{}", entry.id);
                    for v in &e.right {
                        for (row, x) in local.matrix.iter().zip(v) {
                            let image = row.iter().zip(v).fold(RBig::ZERO, |sum, (a, b)| sum + a * b);
                            assert_eq!(image, value * x);
                        }
                    }
                    for u in &e.left {
                        for column in 0..size {
                            let image =
                                (0..size).fold(RBig::ZERO, |sum, row| sum + &u[row] * &local.matrix[row][column]);
                            assert_eq!(image, value * &u[column]);
                        }
                    }
                }
            }
        }
    }
}

/// The mask of the k-th derivative takes polynomials of lower degree to 0, and the k-th power of the index to k!.
#[test]
fn derivative_masks_differentiate() {
    let mut seen = 0;
    for entry in catalogue::CURVES {
        let Rules::Mask(mask, None) = rules(entry.id, &[]) else { continue };
        for own in points_of_mask(&mask, None).unwrap() {
            let u = own.at.position();
            for (k, derivative) in (1_usize..).zip(&own.derivatives) {
                let moment = |l: usize| {
                    let list = weights(derivative);
                    list.iter().fold(RBig::ZERO, |sum, (j, w)| sum + w * (RBig::from(*j) - &u).pow(l as isize))
                };
                assert!((0..k).all(|l| moment(l).is_zero()), "{} {k}", entry.id);
                assert_eq!(moment(k), RBig::from((1..=k).product::<usize>()), "{} {k}", entry.id);
                seen += 1;
            }
        }
    }
    assert!(seen > 20, "{seen}");
}

/// A scheme whose largest eigenvalue after 1 is irrational: its tangent mask is enclosed, and fulfils its equation.
#[test]
fn irrational_tangents_fulfil_their_equation() {
    // symmetric, six weights: on the four points of a middle 1, and the roots of x^2 - 3/8 x - 1/16 and of a linear factor
    let mut irrational = 0;
    for (a, b) in [(1, 3), (2, 3), (-1, 5), (1, 5), (-2, 7), (3, 1)] {
        let c = 16 - a - b;
        let list = [a, b, c, c, b, a].map(|w| format!("\"{w}/16\"")).join(", ");
        let Ok(own) = told(&format!("mask = [{list}]\nfirst = -3")).mask() else { continue };
        let points = points_of_mask(&own, None).unwrap();
        let middle = point(&points, Marked::MidEdge);
        let Ok(tangent) = &middle.tangent else { continue };
        let lambda = &middle.minimal_spectrum[1];
        if lambda.rational.is_some() {
            continue;
        }
        irrational += 1;
        let local = &middle.minimal;
        let at = |index: i64| tangent.iter().find(|w| w.index == index).map_or(0.0, |w| w.value);
        for (column, index) in local.indices.iter().enumerate() {
            let image: f64 =
                local.indices.iter().zip(&local.matrix).map(|(i, row)| at(*i) * row[column].to_f64().value()).sum();
            assert!((image - lambda.value.re * at(*index)).abs() < 1e-13);
        }
        let first: f64 = tangent.iter().map(|w| w.value * (w.index as f64 - 0.5)).sum();
        assert!((first - 1.0).abs() < 1e-13);
    }
    assert!(irrational > 0);
}

/// A limit mask takes the same value from any level: w S = w, and the values at vertices sum to 1 with right moments for splines.
#[test]
fn limit_masks_agree_with_deep_refinement() {
    for entry in catalogue::CURVES {
        let own = rules(entry.id, &[]);
        let Rules::Mask(mask, None) = &own else { continue };
        let refiner = CurveRefiner::new(&own);
        let points: Vec<[f64; 2]> = sample(&own).0;
        let limits = CurveLimits::new(&own).unwrap().of(&points, true).unwrap();
        let levels = if mask.arity == 2 { 12 } else { 6 };
        let fine = refiner.steps(&points, true, levels).unwrap();
        // p_0 stands for the parameter c, and at a level m the point i for (i + c)/a^m
        let (first, last) = mask.support().unwrap();
        let c = (first + last) as f64 / (2.0 * f64::from(mask.arity - 1));
        let at = (c * f64::from(mask.arity).powi(levels as i32) - c).round() as i64;
        let near = fine[at.rem_euclid(fine.len() as i64) as usize];
        let gap = (0..2).map(|axis| (near[axis] - limits[0][axis]).abs()).fold(0.0, f64::max);
        assert!(gap < 0.01, "{}: {gap}", entry.id);
    }
}

/// The differences of refined points are the refined differences.
#[test]
fn differences_are_refined_by_their_own_mask() {
    for (id, rules_of_sum) in
        [("chaikin", 3), ("b-spline", 4), ("four-point", 4), ("six-point", 6), ("ternary-b-spline", 4)]
    {
        let own = mask(id, &[]);
        assert_eq!(sum_rules(&own), rules_of_sum, "{id}");
        let b = difference(&own).unwrap();
        let (arity, p) =
            (i64::from(own.arity), |j: i64| RBig::from(j * j * j - 7 * j * j + 3) / RBig::from(1 + j.rem_euclid(5)));
        let refined = |mask: &Mask, p: &dyn Fn(i64) -> RBig, i: i64| {
            (-40..40).fold(RBig::ZERO, |sum, j| sum + mask.get(i - arity * j) * p(j))
        };
        let d = |j: i64| p(j + 1) - p(j);
        for i in -6..7 {
            assert_eq!(refined(&own, &p, i + 1) - refined(&own, &p, i), refined(&b, &d, i), "{id} {i}");
        }
    }
}

/// The eigenvalues of a window are 1 and those of the differences.
#[test]
fn the_spectrum_agrees_with_that_of_the_differences() {
    for id in ["b-spline", "four-point", "six-point", "ternary-four-point", "corner-cutting"] {
        let own = mask(id, &[]);
        let b = difference(&own).unwrap();
        let full = |mask: &Mask| neighbourhood(mask, &RBig::ZERO, Extent::Full).unwrap().local;
        let local = full(&own);
        let indices = &local.indices[..local.indices.len() - 1];
        // the same window of the difference mask, one point shorter; only where one step brings a vertex back
        if local.steps != 1 {
            continue;
        }
        let shift = own.first + own.support().unwrap().1;
        let offset = if shift % 2 == 0 { shift / 2 } else { continue };
        let arity = i64::from(own.arity);
        let matrix = indices.iter().map(|i| indices.iter().map(|j| b.get(i + offset - arity * j)).collect()).collect();
        let list = |m: &Vec<Vec<RBig>>| {
            let mut all: Vec<String> = Vec::new();
            for e in spectrum(m).unwrap() {
                all.extend(vec![format!("{:.12}{:+.12}", e.value.re, e.value.im); e.algebraic]);
            }
            all.sort();
            all
        };
        let mut of_differences = list(&matrix);
        of_differences.push(format!("{:.12}{:+.12}", 1.0, 0.0));
        of_differences.sort();
        assert_eq!(list(&local.matrix), of_differences, "{id}");
    }
}

// ---- matrix form ----

#[test]
fn the_matrix_form_agrees_with_the_masks_for_every_degree() {
    for d in 1..=12_usize {
        let own = mask("b-spline", &[("d", &d.to_string())]);
        let form = matrix_form(d).unwrap();
        assert_eq!(form.first_half, half_of_mask(&own), "{d}");
        assert_eq!(spline_degree(&own), Some(d));
        // the second half is the first, one new point further on
        let start = own.first + d as i64;
        let row = |i: i64| (0..=d as i64).map(|j| own.get(start + 1 + i - 2 * j)).collect::<Vec<_>>();
        assert_eq!(form.second_half, (0..=d as i64).map(row).collect::<Vec<_>>(), "{d}");
    }
    assert_eq!(spline_degree(&mask("four-point", &[])), None);
    assert_eq!(spline_degree(&mask("corner-cutting", &[])), None);
}

/// H G H^T reads off the face, edge and vertex points of Catmull and Clark, as their masks make them.
#[test]
fn tensor_patches_split_into_quadrants() {
    let h = matrix_form(3).unwrap().first_half;
    let net: Vec<Vec<RBig>> =
        (0..4).map(|i| (0..4).map(|j| ratio((3 * i * i + 5 * j + i * j) % 11, 1)).collect()).collect();
    let quadrant = quadrant(&h, &net, &h).unwrap();
    let g = |i: usize, j: usize| net[i][j].clone();
    let mean = |list: &[RBig]| list.iter().fold(RBig::ZERO, |sum, x| sum + x) / RBig::from(list.len());
    let face = |i: usize, j: usize| mean(&[g(i, j), g(i + 1, j), g(i, j + 1), g(i + 1, j + 1)]);
    assert_eq!(quadrant[0][0], face(0, 0));
    assert_eq!(quadrant[1][0], mean(&[g(1, 0), g(1, 1), face(0, 0), face(1, 0)]));
    let edges = mean(&[
        mean(&[g(1, 1), g(0, 1)]),
        mean(&[g(1, 1), g(2, 1)]),
        mean(&[g(1, 1), g(1, 0)]),
        mean(&[g(1, 1), g(1, 2)]),
    ]);
    let faces = mean(&[face(0, 0), face(1, 0), face(0, 1), face(1, 1)]);
    assert_eq!(quadrant[1][1], (faces + ratio(2, 1) * edges + g(1, 1)) / ratio(4, 1));
}

// ---- tensor products ----

#[test]
fn tensor_products_as_printed() {
    let of = |id: &str| {
        let [a, b] = catalogue::grid(id).unwrap().unwrap().curves().unwrap();
        (a.mask().unwrap(), b.mask().unwrap())
    };
    let rows = |denominator, rows: &[&[i64]]| rows.iter().map(|row| over(denominator, row)).collect::<Vec<_>>();
    let (a, b) = of("biquadratic");
    for (kind, expected) in
        [([0, 0], [[9, 3], [3, 1]]), ([0, 1], [[3, 9], [1, 3]]), ([1, 0], [[3, 1], [9, 3]]), ([1, 1], [[1, 3], [3, 9]])]
    {
        assert_eq!(submask(&a, &b, kind), rows(16, &[&expected[0], &expected[1]]), "{kind:?}");
    }
    let (a, b) = of("bicubic");
    assert_eq!(submask(&a, &b, [0, 0]), rows(64, &[&[1, 6, 1], &[6, 36, 6], &[1, 6, 1]]));
    assert_eq!(submask(&a, &b, [0, 1]), rows(16, &[&[1, 1], &[6, 6], &[1, 1]]));
    assert_eq!(submask(&a, &b, [1, 0]), rows(16, &[&[1, 6, 1], &[1, 6, 1]]));
    assert_eq!(submask(&a, &b, [1, 1]), rows(4, &[&[1, 1], &[1, 1]]));
    let sum = product_mask(&a, &b).weights.concat().iter().fold(RBig::ZERO, |sum, w| sum + w);
    assert_eq!(sum, ratio(4, 1));
}

/// The regular vertex of a bicubic net: eigenvalues are products, as those of Catmull and Clark's scheme at valence 4.
#[test]
fn the_spectrum_of_a_product_is_the_product_of_spectra() {
    let local = neighbourhood(&mask("b-spline", &[]), &RBig::ZERO, Extent::Minimal).unwrap().local.matrix;
    let found = spectrum(&kronecker(&local, &local)).unwrap();
    let list: Vec<(String, usize)> =
        found.iter().map(|e| (e.rational.clone().unwrap().to_string(), e.algebraic)).collect();
    let expected = [("1", 1), ("1/2", 2), ("1/4", 3), ("1/8", 2), ("1/16", 1)];
    assert_eq!(list, expected.map(|(value, count)| (value.to_string(), count)));
}

// ---- refinement ----

/// Two halves' union is the polygon of the next level, and each half is a Bezier polygon of its part of the curve.
#[test]
fn the_halves_of_a_bezier_polygon_make_up_the_next() {
    let refiner = CurveRefiner::new(&rules("bezier", &[]));
    let points = [[0.0, 0.0], [1.0, 3.0], [2.0, -1.0], [4.0, 2.0]];
    let once = refiner.step(&points, false).unwrap();
    assert_eq!(once.len(), 7);
    let [left, right] = [&once[..4], &once[3..]].map(|half| refiner.step(half, false).unwrap());
    let twice = refiner.step(&once, false).unwrap();
    assert_eq!([&left[..], &right[1..]].concat(), twice);
    // the middle of the curve by Bernstein's polynomials
    assert_eq!(once[3], [(0.0 + 3.0 + 6.0 + 4.0) / 8.0, (0.0 + 9.0 - 3.0 + 2.0) / 8.0]);
}

/// The distance of polygon and curve falls by 4 a step of a binary scheme, by 9 of a ternary one.
#[test]
fn polygons_converge_with_the_square_of_the_step() {
    for (id, factor) in [
        ("bezier", 4.0),
        ("chaikin", 4.0),
        ("b-spline", 4.0),
        ("cubic-b-spline-natural", 4.0),
        ("cubic-b-spline-clamped", 4.0),
        ("ternary-b-spline", 9.0),
        ("quaternary-b-spline", 16.0),
        ("six-point", 4.0),
    ] {
        let found = convergence(&rules(id, &[])).unwrap();
        let last = found.approx_factors.last().unwrap();
        assert!((last / factor - 1.0).abs() < 0.1, "{id}: {:?}", found.approx_factors);
    }
}

/// A clamped cubic spline of six points against knot insertion told in another way: its curve by de Boor's algorithm.
#[test]
fn clamped_ends_agree_with_de_boor() {
    let own = rules("cubic-b-spline-clamped", &[]);
    let points = [[0.0], [2.0], [-1.0], [4.0], [1.0], [3.0], [5.0]];
    let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 4.0];
    let de_boor = |x: f64| {
        let k = (3..7).rev().find(|k| knots[*k] <= x).unwrap();
        let mut d: Vec<f64> = (0..4).map(|j| points[j + k - 3][0]).collect();
        for r in 1..4 {
            for j in (r..4).rev() {
                let (low, high) = (knots[j + k - 3], knots[j + 1 + k - r]);
                let t = (x - low) / (high - low);
                d[j] = (1.0 - t) * d[j - 1] + t * d[j];
            }
        }
        d[3]
    };
    let refiner = CurveRefiner::new(&own);
    let fine = refiner.steps(&points, false, 6).unwrap();
    let limits = CurveLimits::new(&own).unwrap().of(&fine, false).unwrap();
    assert_eq!(limits.len(), 4 * 64 + 3);
    // the point of index j >= 2 stands for the parameter (j - 1)/64
    for (j, limit) in limits.iter().enumerate().take(limits.len() - 2).skip(2) {
        let x = (j - 1) as f64 / 64.0;
        assert!((limit[0] - de_boor(x)).abs() < 1e-12, "{j}");
    }
    assert_eq!((limits[0][0], limits[limits.len() - 1][0]), (0.0, 5.0));
}

/// Without rules at ends an open polygon keeps what is decided: Chaikin's cut corners.
#[test]
fn open_polygons_without_end_rules_keep_what_is_decided() {
    let refiner = CurveRefiner::new(&rules("chaikin", &[]));
    let refined = refiner.step(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]], false).unwrap();
    assert_eq!(refined, [[1.0, 0.0], [3.0, 0.0], [4.0, 1.0], [4.0, 3.0]]);
    let four = CurveRefiner::new(&rules("four-point", &[]));
    assert!(four.step(&[[0.0]; 2], false).unwrap_err().to_string().contains("at least 3"));
    assert!(four.step(&[[0.0], [1.0], [2.0], [3.0]], false).unwrap().contains(&[1.5]));
}

/// A grid is refined by products of weights: the double sum over the product mask, point by point.
#[test]
fn grids_are_refined_by_products() {
    let [a, b] = [rules("b-spline", &[]), rules("chaikin", &[])];
    let grid: Vec<Vec<[f64; 3]>> =
        (0..5).map(|i| (0..4).map(|j| [i as f64, j as f64, ((3 * i * i + 5 * j) % 7) as f64]).collect()).collect();
    let refined = eigenring::refine::grid::step(&grid, [&CurveRefiner::new(&a), &CurveRefiner::new(&b)]).unwrap();
    let (Rules::Mask(a, _), Rules::Mask(b, _)) = (&a, &b) else { panic!() };
    // the first new points that are all there: cubic from index 1 to 7, quadratic from 0 to 5
    assert_eq!((refined.len(), refined[0].len()), (7, 6));
    for (i, row) in (1_i64..).zip(&refined) {
        for (j, point) in (0_i64..).zip(row) {
            let mut sum = [0.0; 3];
            for (k, old) in (0_i64..).zip(&grid) {
                for (m, own) in (0_i64..).zip(old) {
                    let weight = (a.get(i - 2 * k) * b.get(j - 2 * m)).to_f64().value();
                    (0..3).for_each(|axis| sum[axis] += weight * own[axis]);
                }
            }
            assert!((0..3).all(|axis| (sum[axis] - point[axis]).abs() < 1e-14), "{i} {j}");
        }
    }
}

proptest! {
    /// Refining reproduces constants, and linear functions of the index up to the shift of the scheme; the closed and the open way
    /// agree inside.
    #[test]
    fn refining_reproduces_constants_and_lines(which in 0..catalogue::CURVES.len(), slope in -8i32..9, height in -8i32..9, count in 14usize..40) {
        let id = catalogue::CURVES[which].id;
        let own = rules(id, &[]);
        let Rules::Mask(mask, None) = &own else { return Ok(()) };
        let refiner = CurveRefiner::new(&own);
        let line: Vec<[f64; 2]> = (0..count).map(|j| [f64::from(height), f64::from(slope) * j as f64]).collect();
        let open = refiner.step(&line, false).unwrap();
        prop_assert!(open.iter().all(|p| (p[0] - f64::from(height)).abs() < 1e-12));
        if sum_rules(mask) >= 2 {
            let steps: Vec<f64> = open.windows(2).map(|pair| pair[1][1] - pair[0][1]).collect();
            let expected = f64::from(slope) / f64::from(mask.arity);
            prop_assert!(steps.iter().all(|step| (step - expected).abs() < 1e-10), "{} {:?}", id, steps);
        }
        let closed = refiner.step(&line, true).unwrap();
        prop_assert_eq!(closed.len(), count * mask.arity as usize);
        let found = closed.windows(open.len()).any(|part| part == &open[..]);
        prop_assert!(found || open.len() > closed.len(), "{}", id);
    }

    /// Any symmetric mask with both sums right is the same as mask, as symbol and backwards.
    #[test]
    fn any_mask_is_the_same_as_its_symbol(list in proptest::collection::vec(-20i64..21, 2..9)) {
        let mut weights: Vec<i64> = list.clone();
        let sums = |w: &[i64], r: usize| w.iter().skip(r).step_by(2).sum::<i64>();
        weights[0] += 16 - sums(&list, 0);
        weights[1] += 16 - sums(&list, 1);
        let quoted: Vec<String> = weights.iter().map(|w| format!("\"{w}/16\"")).collect();
        let powers: Vec<String> = weights.iter().enumerate().map(|(i, w)| format!("({w}/16)*z^{i}")).collect();
        let a = told(&format!("mask = [{}]\nfirst = 0", quoted.join(", "))).mask().unwrap();
        let b = told(&format!("symbol = \"{}\"", powers.join(" + "))).mask().unwrap();
        prop_assert_eq!(&a, &b);
        let ends: Option<&Ends> = None;
        if let Ok(points) = points_of_mask(&a, ends) {
            for own in &points {
                // row sums are 1, so 1 is an eigenvalue with the vector (1, ..., 1)
                prop_assert!(own.full.matrix.iter().all(|row| row.iter().fold(RBig::ZERO, |s, w| s + w) == RBig::ONE));
            }
        }
    }
}
