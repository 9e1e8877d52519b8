//! Is what the symbol says of regular meshes what the literature says, and what the rows of the mesh engine do?
#![allow(clippy::unwrap_used)]

use dashu_ratio::RBig;
use eigenring::analysis::Analyzer;
use eigenring::analysis::regular::box_spline::BoxSpline;
use eigenring::analysis::regular::mask::{Dilation, Mask, Point, Sequence};
use eigenring::analysis::regular::{Regular, Smoothness};
use eigenring::numbers::{Field, Free};
use eigenring::proof::c1::Proofs;
use eigenring::refine::{Refinement, RegularStencils, lattice_of};
use eigenring::report::{Study, csv, json, latex, markdown};
use eigenring::scheme::{Scheme, catalogue};
use eigenring::verdicts::{Decision, verdicts};

fn open(id: &str) -> Scheme {
    catalogue::open(id).unwrap().unwrap()
}

fn parse(text: &str) -> Scheme {
    Scheme::parse("own", "own.toml", text).unwrap_or_else(|faults| panic!("{faults}"))
}

fn regular(scheme: &Scheme) -> Regular {
    Regular::of(scheme).unwrap()
}

fn rational(above: i64, below: i64) -> Free {
    Free::rational(&(RBig::from(above) / RBig::from(below)))
}

/// The eight-point butterfly scheme of Dyn, Levin and Gregory with its tension.
const BUTTERFLY: &str = r#"
name  = "Butterfly"
mesh  = "triangles"
split = "1-to-4"
[parameters]
w = "1/16"
[vertex]
centre = "1"
[edge]
ends     = "1/2"
opposite = "2*w"
wings    = "-w"
"#;

/// Midpoints and nothing else: piecewise linear.
const LINEAR: &str = r#"
name  = "Linear"
mesh  = "triangles"
split = "1-to-4"
[vertex]
centre = "1"
[edge]
ends = "1/2"
"#;

/// The same on quads.
const BILINEAR: &str = r#"
name  = "Bilinear"
mesh  = "quads"
split = "1-to-n"
[vertex]
centre = "1"
[edge]
ends = "1/2"
[face]
corners = "1/4"
"#;

/// Corners cut by 1/2, 1/4, 1/4: two steps of the simplest scheme, which make the Zwart-Powell element (Peters and Reif 1997).
const TWO_MIDEDGE_STEPS: &str = r#"
name  = "Two mid-edge steps"
mesh  = "quads"
split = "dual"
[corner]
itself       = "1/2"
"ring[-1,1]" = "1/4"
"#;

/// Loop 1987; Catmull and Clark 1978; Doo and Sabin 1978: the splines that they generalise. The degrees: Dyn 1992, Charina, Conti, Jetter and
/// Zimmermann 2011 (B-splines and box splines reproduce linear functions and generate more).
#[test]
fn the_schemes_are_the_splines_that_they_generalise() {
    for id in ["loop", "loop-warren"] {
        let loops = regular(&open(id));
        assert_eq!(loops.factors.directions, [([1, 0], 2), ([0, 1], 2), ([1, -1], 2)]);
        let spline = loops.spline.clone().unwrap();
        assert_eq!((spline.degree(), spline.continuity(), spline.is_independent()), (4, Some(2), true));
        assert_eq!((loops.generation(), loops.moments.reproduction, loops.moments.sum_rules), (Some(3), Some(1), 4));
        assert!(matches!(loops.smoothness, Smoothness::Exactly(2, ..)));
    }
    for (id, degree, half) in [("catmull-clark", 3, 0), ("doo-sabin", 2, 1), ("catmull-clark-biquadratic", 2, 1)] {
        let tensor = regular(&open(id));
        assert_eq!(tensor.spline.clone().unwrap().bidegree(), Some([degree, degree]), "{id}");
        assert_eq!((tensor.generation(), tensor.moments.reproduction), (Some(degree), Some(1)), "{id}");
        assert_eq!(tensor.moments.shift, [rational(half, 2), rational(half, 2)], "{id}");
        assert!(matches!(tensor.smoothness, Smoothness::Exactly(r, ..) if r == degree - 1), "{id}");
    }
}

/// The submasks of the bicubic and biquadratic spline, by outer products of (1, 4, 6, 4, 1)/8 and (1, 3, 3, 1)/4.
#[test]
fn tensor_product_masks_are_outer_products() {
    for (id, mask, over, first) in [("catmull-clark", &[1, 4, 6, 4, 1][..], 8, -2), ("doo-sabin", &[1, 3, 3, 1], 4, -1)]
    {
        let own = regular(&open(id)).mask.coefficients;
        assert_eq!(own.len(), mask.len() * mask.len());
        for (i, a) in mask.iter().enumerate() {
            for (j, b) in mask.iter().enumerate() {
                assert_eq!(own[&[first + i as i32, first + j as i32]], rational(a * b, over * over), "{id} {i} {j}");
            }
        }
    }
}

#[test]
fn splines_that_are_not_smooth() {
    let linear = regular(&parse(LINEAR));
    assert_eq!(linear.factors.directions, [([1, 0], 1), ([0, 1], 1), ([1, -1], 1)]);
    assert!(linear.spline.as_ref().unwrap().name().contains("Courant"));
    assert!(matches!(linear.smoothness, Smoothness::Exactly(0, ..)));
    assert_eq!((linear.moments.sum_rules, linear.moments.reproduction), (2, Some(1)));
    let bilinear = regular(&parse(BILINEAR));
    assert_eq!(bilinear.spline.as_ref().unwrap().bidegree(), Some([1, 1]));
    assert!(matches!(bilinear.smoothness, Smoothness::Exactly(0, ..)));
}

/// Quadratic and C1 with all quadratic polynomials, though its shifts are dependent and its sum rules are of order 2 only (de Boor, Hollig and
/// Riemenschneider 1993).
#[test]
fn the_zwart_powell_element_is_seen() {
    let element = regular(&parse(TWO_MIDEDGE_STEPS));
    assert_eq!(element.factors.directions, [([1, 0], 1), ([0, 1], 1), ([1, 1], 1), ([1, -1], 1)]);
    let spline = element.spline.clone().unwrap();
    assert!(spline.name().contains("Zwart-Powell") && !spline.is_independent());
    assert_eq!((element.moments.sum_rules, element.generation(), element.moments.reproduction), (2, Some(2), Some(1)));
    assert!(matches!(element.smoothness, Smoothness::Exactly(1, ..)));
}

/// Dyn, Levin and Gregory 1990: the symbol has the three factors once each, for every tension; cubic polynomials are reproduced at 1/16 only; limits
/// are C1 at 1/16, which the difference schemes of divided differences show in two steps; not C2.
#[test]
fn the_butterfly_scheme() {
    let mut scheme = parse(BUTTERFLY);
    let fixed = regular(&scheme);
    let three = [([1, 0], 1), ([0, 1], 1), ([1, -1], 1)];
    assert_eq!((&fixed.factors.directions[..], fixed.spline.is_some()), (&three[..], false));
    assert_eq!((fixed.moments.sum_rules, fixed.moments.reproduction), (4, Some(3)));
    let Smoothness::AtLeast(1, proof) = &fixed.smoothness else { panic!("{:?}", fixed.smoothness) };
    assert!(proof.contractive.iter().all(|(taken, found)| taken.len() == 2 && found.steps == 2));
    let with_spectrum = Analyzer::new(&scheme).unwrap().regular().unwrap().clone();
    assert!(matches!(with_spectrum.smoothness, Smoothness::Exactly(1, ..)));
    scheme.leave_free("w").unwrap();
    let free = regular(&scheme);
    assert_eq!(free.factors.directions, three);
    assert_eq!((free.moments.sum_rules, free.moments.reproduction), (2, Some(1)));
    assert_eq!(free.smoothness.proved(), None);
    // the value of the paper is found, and no other
    let special = eigenring::analysis::regular::special::values_with_more(&free).unwrap();
    let [(value, there)] = &special[..] else { panic!("{special:?}") };
    assert_eq!((value.to_string(), &there.mask.coefficients), ("1/16".to_string(), &fixed.mask.coefficients));
}

/// The ten-point stencil reproduces cubic polynomials for every w (Zorin, Schroder and Sweldens 1996 take it for that), and w = 0 is the butterfly scheme.
#[test]
fn the_ten_point_stencil() {
    let mut scheme = open("modified-butterfly");
    assert_eq!(regular(&scheme).mask.coefficients, regular(&parse(BUTTERFLY)).mask.coefficients);
    scheme.leave_free("w").unwrap();
    let free = regular(&scheme);
    assert_eq!((free.moments.sum_rules, free.moments.reproduction), (4, Some(3)));
}

/// With a large tension nothing contracts, and nothing is claimed.
#[test]
fn what_does_not_contract_is_undecided() {
    let rough = regular(&parse(&BUTTERFLY.replace("1/16", "0.13")));
    assert_eq!((rough.smoothness.is(1), rough.moments.reproduction), (None, Some(1)));
    let wild = regular(&parse(&BUTTERFLY.replace("1/16", "2")));
    assert!(matches!(wild.smoothness, Smoothness::Undecided(_)));
}

/// Samples of the monomial x^a y^b at the points of the lattice, shifted.
fn sample([x, y]: [f64; 2], (a, b): (i32, i32)) -> f64 {
    x.powi(a) * y.powi(b)
}

fn monomials(degree: usize) -> impl Iterator<Item = (i32, i32)> {
    (0..=degree as i32).map(move |b| (degree as i32 - b, b))
}

/// By the definition, with the floating stencils of the mesh engine: a step takes samples of polynomials of the degree that is reproduced to samples of
/// the same polynomial on the finer lattice, and not those of one degree more; it takes polynomials below the order of the sum rules to polynomials of no higher
/// degree (differences of one order more vanish), and not those of that order.
#[test]
fn degrees_are_those_of_the_definition() {
    let own = [BUTTERFLY, LINEAR, BILINEAR, TWO_MIDEDGE_STEPS].map(parse);
    let all = catalogue::SCHEMES.iter().map(|listed| open(listed.id)).chain(own);
    for scheme in all {
        let id = scheme.book.title.clone();
        let regular = regular(&scheme);
        let stencils = RegularStencils::of(&Refinement::new(&scheme, None), lattice_of(&scheme)).unwrap();
        let tau = regular.moments.shift.each_ref().map(|own| own.as_rational().unwrap().to_f64().value());
        let at = |[i, j]: Point| [f64::from(i) + tau[0], f64::from(j) + tau[1]];
        let refined = |[i, j]: Point, monomial: (i32, i32)| -> f64 {
            let (p, q) = stencils.base(i, j);
            let old = |(di, dj): (i32, i32)| at([p + di, q + dj]);
            stencils.at(i, j).iter().map(|(offset, weight)| weight * sample(old(*offset), monomial)).sum()
        };
        let finer = f64::from(stencils.dilation());
        let points = || (-4..5).flat_map(|i| (-4..5).map(move |j| [i, j]));
        let reproduces = |degree: usize| {
            monomials(degree).all(|monomial| {
                points().all(|new| {
                    let [x, y] = at(new);
                    (refined(new, monomial) - sample([x / finer, y / finer], monomial)).abs() < 1e-9
                })
            })
        };
        let reproduced = regular.moments.reproduction.unwrap();
        assert!((0..=reproduced).all(reproduces) && !reproduces(reproduced + 1), "{id}");
        // the differences of order d + 1 along both axes and mixed
        let difference = |new: Point, monomial: (i32, i32), (a, b): (i32, i32)| -> f64 {
            let sign = |step: i32| if step % 2 == 0 { 1.0 } else { -1.0 };
            let binomial = |n: i32, k: i32| (0..k).map(|i| f64::from(n - i) / f64::from(i + 1)).product::<f64>();
            let term = |s: i32, t: i32| {
                let value = refined([new[0] + s, new[1] + t], monomial);
                sign(s + t) * binomial(a, s) * binomial(b, t) * value
            };
            (0..=a).flat_map(|s| (0..=b).map(move |t| (s, t))).map(|(s, t)| term(s, t)).sum()
        };
        let stays = |degree: usize| {
            monomials(degree).all(|monomial| {
                monomials(degree + 1).all(|order| points().all(|new| difference(new, monomial, order).abs() < 1e-7))
            })
        };
        let order = regular.moments.sum_rules;
        assert!((0..order).all(stays) && !stays(order), "{id}: order {order}");
    }
}

/// The product of a symbol's factors and kernel is the symbol.
#[test]
fn factors_multiply_to_the_symbol() {
    for scheme in catalogue::SCHEMES.iter().map(|listed| open(listed.id)).chain([parse(BUTTERFLY)]) {
        let regular = regular(&scheme);
        let mut product: Sequence = regular.factors.kernel.clone();
        for (v, times) in &regular.factors.directions {
            for _ in 0..*times {
                let mut next = Sequence::new();
                for (point, weight) in &product {
                    for step in 0..2 {
                        let place = [point[0] + step * v[0], point[1] + step * v[1]];
                        let sum = next.get(&place).map_or(weight.clone(), |own: &Free| own.plus(weight).unwrap());
                        next.insert(place, sum);
                    }
                }
                next.retain(|_, weight| !weight.is_certainly_zero());
                product = next;
            }
        }
        assert_eq!(product, regular.mask.coefficients, "{}", scheme.id);
    }
}

/// A mask of a curve from whole numbers over one denominator.
fn line(first: i32, numbers: &[i64], over: i64) -> Vec<(i32, Free)> {
    numbers.iter().enumerate().map(|(i, number)| (first + i as i32, rational(*number, over))).collect()
}

/// Ternary B-splines: the univariate symbol of degree d is 3 ((1 + z + z^2)/3)^(d+1).
#[test]
fn ternary_b_splines() {
    let mut numbers = vec![1, 1, 1];
    for degree in 1..=4_usize {
        let at = |i: usize| numbers.get(i).copied().unwrap_or(0);
        let sum = |i: usize| (i.saturating_sub(2)..=i).map(at).sum::<i64>();
        numbers = (0..numbers.len() + 2).map(sum).collect();
        let own = line(0, &numbers, 3_i64.pow(degree as u32));
        let regular = Regular::of_mask(Mask::tensor(3, &own, &own).unwrap()).unwrap();
        assert_eq!(regular.spline.clone().unwrap().bidegree(), Some([degree, degree]));
        assert_eq!((regular.moments.sum_rules, regular.moments.reproduction), (degree + 1, Some(1)));
        assert!(matches!(regular.smoothness, Smoothness::Exactly(r, ..) if r == degree - 1));
    }
}

/// Tensor products of the four-point scheme (Dyn, Gregory and Levin 1987; on quads with irregular vertices Kobbelt 1996): cubic polynomials are
/// reproduced, limits are C1. With another scheme along the second axis the weaker of both counts.
#[test]
fn tensor_products_of_curves() {
    let four_point = line(-3, &[-1, 0, 9, 16, 9, 0, -1], 16);
    let regular = Regular::of_mask(Mask::tensor(2, &four_point, &four_point).unwrap()).unwrap();
    assert_eq!((regular.moments.sum_rules, regular.moments.reproduction), (4, Some(3)));
    assert_eq!(regular.factors.directions, [([1, 0], 4), ([0, 1], 4)]);
    assert!(matches!(regular.smoothness, Smoothness::AtLeast(1, _)));
    let chaikin = line(-1, &[1, 3, 3, 1], 4);
    let mixed = Regular::of_mask(Mask::tensor(2, &four_point, &chaikin).unwrap()).unwrap();
    assert_eq!((mixed.moments.sum_rules, mixed.moments.reproduction), (3, Some(1)));
    assert_eq!(mixed.moments.shift, [rational(0, 1), rational(1, 2)]);
    assert!(matches!(mixed.smoothness, Smoothness::AtLeast(1, _)));
}

/// Without any smoothing factor: a Loop relative with points two edges away. C1 by the differences of all directions.
#[test]
fn a_scheme_without_factors() {
    let text = r#"
name  = "Odd"
mesh  = "triangles"
split = "1-to-4"
[vertex]
centre = "1 - n/17 - n/200"
ring   = "1/17"
"2,0"  = "1/200"
[edge]
ends     = "1/2 - 1/7"
opposite = "1/7"
"#;
    let odd = regular(&parse(text));
    assert!(odd.factors.directions.is_empty() && odd.spline.is_none());
    let Smoothness::AtLeast(1, proof) = &odd.smoothness else { panic!("{:?}", odd.smoothness) };
    assert!(proof.contractive.is_empty() && proof.all.as_ref().is_some_and(|(order, _)| *order == 2));
}

/// One step of the simplest scheme: midpoints of edges, on a lattice turned by 45 degrees. Two steps have 2 I but for a turn, and are the Zwart-Powell
/// element (Peters and Reif 1997), as the corner cutting above.
#[test]
fn one_mid_edge_step() {
    let half = rational(1, 2);
    // the old points with even coordinate sums, halved; their edges' midpoints: each is made of two neighbours
    let turned = Dilation::new([[1, -1], [1, 1]]).unwrap();
    let mask = Mask::new(turned, [[0, 0], [1, 0], [0, 1], [1, 1]].map(|point| (point, half.clone())));
    let element = Regular::of_mask(mask).unwrap();
    assert_eq!(element.straight.as_ref().map(|(mask, steps)| (mask.dilation, *steps)), Some((Dilation::whole(2), 2)));
    assert!(element.spline.as_ref().unwrap().name().contains("Zwart-Powell"));
    assert!(matches!(element.smoothness, Smoothness::Exactly(1, ..)));
    assert_eq!(element.moments.reproduction, Some(1));
}

/// Kobbelt's sqrt(3) scheme on regular meshes: vertex 2/3 and 1/18 for each neighbour, face 1/3 for each corner. Sum rules of
/// order 3: on either coset the second moments are those of a circle, 1 in all by Euclid's measure, while the third ones of a triangle are not 0.
fn regular_of_sqrt3() -> Regular {
    let dilation = Dilation::new([[1, -1], [1, 2]]).unwrap();
    let ring: [Point; 6] = [[1, 0], [0, 1], [-1, 1], [-1, 0], [0, -1], [1, -1]];
    let outer = ring.map(|point| (dilation.image(point), rational(1, 18)));
    let coefficients =
        ring.map(|point| (point, rational(1, 3))).into_iter().chain(outer).chain([([0, 0], rational(2, 3))]);
    Regular::of_mask(Mask::new(dilation, coefficients)).unwrap()
}

#[test]
fn the_sqrt3_scheme() {
    let regular = regular_of_sqrt3();
    assert_eq!((regular.moments.sum_rules, regular.moments.reproduction), (3, Some(1)));
    assert_eq!(regular.straight.as_ref().map(|(mask, steps)| (mask.dilation, *steps)), Some((Dilation::whole(3), 2)));
    assert!(regular.spline.is_none() && regular.factors.directions.is_empty());
    // C2: Kobbelt 2000
    let Smoothness::AtLeast(2, proof) = &regular.smoothness else { panic!("{:?}", regular.smoothness) };
    assert_eq!(proof.all.as_ref().map(|(order, found)| (*order, found.steps)), Some((3, 2)));
}

/// The zoo: 4-8 is C4 with the directions of the Zwart-Powell element twice (Velho and Zorin 2001); mid-edge is that element (Peters and Reif
/// 1997); sqrt(3) is C2 (Kobbelt 2000), of which the mask above is one step; Kobbelt's scheme of 1996 is the tensor product of the four-point scheme;
/// midpoint subdivision of degree d is the B-spline of bi-degree (d, d) (Prautzsch and Chen 2011).
#[test]
fn the_zoo_on_regular_meshes() {
    let four = |times: usize| [[1, 0], [0, 1], [1, 1], [1, -1]].map(|direction| (direction, times)).to_vec();
    for (id, times, smooth, degree) in [("four-eight", 2, 4, 6), ("mid-edge", 1, 1, 2)] {
        let own = regular(&open(id));
        assert_eq!(own.factors.directions, four(times), "{id}");
        assert_eq!(own.spline.as_ref().map(BoxSpline::degree), Some(degree), "{id}");
        assert!(matches!(own.smoothness, Smoothness::Exactly(r, ..) if r == smooth), "{id}");
    }
    let two_steps = regular(&open("sqrt3"));
    assert_eq!((two_steps.mask.dilation, two_steps.moments.sum_rules), (Dilation::whole(3), 3));
    assert_eq!(two_steps.mask.coefficients, regular_of_sqrt3().straight.unwrap().0.coefficients);
    assert_eq!(two_steps.smoothness.proved(), Some(2));
    let four_point = line(-3, &[-1, 0, 9, 16, 9, 0, -1], 16);
    let tensor = Mask::tensor(2, &four_point, &four_point).unwrap();
    assert_eq!(regular(&open("kobbelt")).mask.coefficients, tensor.coefficients);
    for degree in 2..=5_usize {
        let scheme = open("midpoint").with_value("d", &degree.to_string()).unwrap();
        let own = regular(&scheme);
        assert_eq!(own.spline.and_then(|spline| spline.bidegree()), Some([degree, degree]));
    }
}

/// Difference schemes alone, without the theorem on box splines, show the smoothness of B-splines of degrees up to 4.
#[test]
fn difference_schemes_show_what_splines_are() {
    use eigenring::analysis::regular::differences::Differences;
    for (id, smooth) in [("loop", 2), ("catmull-clark", 2), ("doo-sabin", 1)] {
        let regular = regular(&open(id));
        let mut differences = Differences::of(&regular.mask, &regular.factors).unwrap();
        assert!((0..=smooth).all(|k| differences.prove(k).unwrap().is_some()), "{id}");
        assert!(differences.prove(smooth + 1).unwrap().is_none(), "{id}: too smooth");
    }
}

/// The condition on regular meshes is decided by the symbol, and JSON, Markdown and LaTeX tell the regular part.
#[test]
fn verdicts_and_reports_tell_the_regular_part() {
    for (scheme, expected) in [
        (open("loop"), Decision::Proved),
        (open("modified-butterfly"), Decision::Proved),
        (parse(LINEAR), Decision::Refuted),
        (parse(&BUTTERFLY.replace("1/16", "0.13")), Decision::Undecided),
    ] {
        let analyzer = Analyzer::new(&scheme).unwrap();
        let analysis = analyzer.at(5).unwrap();
        let proofs = Proofs::of(&analyzer).at(5, analysis.exact.as_ref().ok());
        let found = verdicts(&analysis, &[], &proofs);
        let own = found.iter().find(|verdict| verdict.claim == "regular part").unwrap();
        assert_eq!(own.verdict, expected, "{}", scheme.book.title);
    }
    let report = Study::of(&open("loop"), &[5], false, &|| ()).unwrap().report;
    let document: serde_json::Value = serde_json::from_str(&json(&report).unwrap()).unwrap();
    let own = &document["regular"];
    assert_eq!(own["symbol"], "1/16*z1^-2*z2^-2*(1 + z1)^2*(1 + z2)^2*(z1 + z2)^2");
    assert_eq!((&own["sum_rules"], &own["reproduction_degree"]), (&4.into(), &1.into()));
    assert_eq!((&own["smoothness"]["continuity"], &own["smoothness"]["sharp"]), (&2.into(), &true.into()));
    assert_eq!(own["kernel"], "1");
    let text = markdown(&report, &[]);
    assert!(text.contains("## Regular part") && text.contains("quartic box spline of three directions (2, 2, 2)"));
    assert!(latex(&report, &[]).contains("(1 + z_1)^{2}") && csv(&report).contains("limit mask"));
}

/// Weights that are no rational numbers on regular meshes: the report says so and does without.
#[test]
fn irrational_weights_have_no_regular_part() {
    let text = LINEAR.replace("ends = \"1/2\"", "ends = \"1/2 - sqrt(2)/8\"\nopposite = \"sqrt(2)/8\"");
    let report = Study::of(&parse(&text), &[5], false, &|| ()).unwrap().report;
    assert!(report.regular.is_none() && report.why_no_regular.is_some());
    assert!(markdown(&report, &[]).contains("The regular part is not told"));
}
