//! Do schemes that somebody writes from nothing but the README go through, and come out as designed?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::{Analysis, Analyzer};
use eigenring::refine;
use eigenring::scheme::Scheme;

fn analyses(text: &str) -> Vec<Analysis> {
    let scheme = Scheme::parse("own", "own.toml", text).unwrap_or_else(|faults| panic!("{faults}"));
    let valences: Vec<usize> = (3..=12).collect();
    let sums = refine::check(&scheme, &valences).unwrap_or_else(|faults| panic!("{faults}"));
    assert!(sums.iter().all(|sum| sum.identity), "every sum is an identity: {sums:?}");
    let analyzer = Analyzer::new(&scheme).unwrap();
    valences.iter().map(|n| analyzer.at(*n).unwrap()).collect()
}

/// Loop with beta chosen so that the eigenvalue of frequency 0 is lambda^2/2.
#[test]
fn a_loop_relative_with_half_the_cup() {
    let text = r#"
name  = "Loop with half the cup"
mesh  = "triangles"
split = "1-to-4"

[let]
lambda = "3/8 + cos(2*pi/n)/4"
beta   = "(5/8 - lambda^2/2)/n"

[vertex]
centre = "1 - n*beta"
ring   = "beta"

[edge]
ends     = "3/8"
opposite = "1/8"
"#;
    for analysis in analyses(text) {
        let lambda = analysis.lambda.unwrap().value.re;
        let cup = analysis.classical.cup.unwrap().value.re;
        assert!((cup - lambda * lambda / 2.0).abs() < 1e-15, "n = {}", analysis.valence);
    }
}

/// A Loop relative whose edge rule at an irregular end makes lambda 1/2 at every valence.
#[test]
fn a_loop_relative_with_lambda_one_half() {
    let text = r#"
name  = "Loop with lambda 1/2"
mesh  = "triangles"
split = "1-to-4"

[let]
beta = "3/(8*n)"

[vertex]
centre = "1 - n*beta"
ring   = "beta"

[edge]
ends     = "3/8"
opposite = "1/8"

[edge.from-irregular-end]
centre       = "1/4 + cos(2*pi/n)/4"
"ring[0]"    = "1/2 - cos(2*pi/n)/4"
"ring[-1,1]" = "1/8"
"#;
    for analysis in analyses(text) {
        let lambda = analysis.spectrum.largest_of(1).unwrap();
        assert!((lambda.value.re - 0.5).abs() < 1e-15, "n = {}", analysis.valence);
    }
}

/// A Catmull-Clark variant with other vertex weights: v' = (1 - 2a) v + a (mean of the old ring) + a (mean of new faces).
#[test]
fn a_catmull_clark_variant() {
    let text = r#"
name  = "Catmull-Clark with a parameter"
mesh  = "polygons"
split = "1-to-n"

[parameters]
a = { default = "1/4", means = "share of each mean", range = "0..1/2" }

[face]
corners = "1/n"

[edge]
ends        = "1/4"
"new faces" = "1/4"

[vertex]
centre      = "1 - 2*a"
ring        = "a/n"
"new faces" = "a/n"
"#;
    for analysis in analyses(text) {
        // frequency 1 doesn't see the vertex rule: lambda is Catmull and Clark's
        let c = (std::f64::consts::TAU / analysis.valence as f64).cos();
        let expected = (5.0 + c + ((c + 1.0) * (c + 9.0)).sqrt()) / 16.0;
        assert!((analysis.spectrum.largest_of(1).unwrap().value.re - expected).abs() < 1e-14);
        assert!(analysis.limit_mask.is_some());
    }
}

/// Schemes with addresses have cores of many unknowns, whose small eigenvalues lie near each other: none may be counted twice, and none be
/// blurred. (All true eigenvalues of these come from traces of the dense matrix.)
#[test]
fn eigenvalues_of_large_cores_are_counted_once_and_not_blurred() {
    let two_rings = r#"
name  = "Loop with a second ring"
mesh  = "triangles"
split = "1-to-4"

[parameters]
u = "1/64"

[let]
beta = "3/(8*n)"

[vertex]
centre = "5/8"
ring   = "beta"
"2,0"  = "-u"
"1,1"  = "u"

[edge]
ends     = "3/8"
opposite = "1/8"
"#;
    let wide_corner = r#"
name  = "Doo-Sabin with a wider corner"
mesh  = "polygons"
split = "dual"

[parameters]
u = "1/64"

[corner]
itself = "1/4"
ring   = "(3 + 2*cos(2*pi*j/n))/(4*n)"
"1,1"  = "-u"
"1,0"  = "u/2"
"0,1"  = "u/2"
"#;
    for text in [two_rings, wide_corner] {
        for analysis in analyses(text) {
            let (n, spectrum) = (analysis.valence, &analysis.spectrum);
            let counted: usize = spectrum.distinct().iter().map(|e| e.multiplicity(n)).sum();
            assert_eq!(counted, analysis.local.size(), "n = {n}");
            let s = analysis.local.dense().unwrap();
            let mut power = s.clone();
            for p in 1..=6 {
                let sum: f64 = spectrum.distinct().iter().map(|e| e.value.powi(p).re * e.multiplicity(n) as f64).sum();
                assert!((power.trace() - sum).abs() < 1e-9, "n = {n}, p = {p}: {} and {sum}", power.trace());
                power = &power * &s;
            }
        }
    }
    // the block of frequency 0 at n = 5 has 1, 0.26422... and 0.125 apart
    let five = analyses(wide_corner).into_iter().find(|analysis| analysis.valence == 5).unwrap();
    let mu = five.spectrum.largest_of(0).unwrap();
    assert!(mu.is_isolated() && (mu.value.re - 0.26422).abs() < 1e-5, "{mu:?}");
}

/// A sum that is 1 at one valence only is never called an identity: the weights of picked points see j, and j may see n.
#[test]
fn a_sum_that_holds_at_one_valence_is_no_identity() {
    let text = r#"
name  = "Right at five only"
mesh  = "polygons"
split = "dual"

[corner]
itself       = "1 - (3*n - 5)/256"
"ring[-1,1]" = "j*(n - j)/256"
"#;
    let scheme = Scheme::parse("own", "own.toml", text).unwrap_or_else(|faults| panic!("{faults}"));
    match scheme.check(&[5]) {
        Ok(sums) => assert!(sums.iter().all(|sum| !sum.identity), "{sums:?}"),
        Err(faults) => assert!(faults.to_string().contains("sum to"), "{faults}"),
    }
    let boundary = "name = \"Right at one face\"\n[vertex.crease]\ncentre = \"1/2\"\nring = \"1/4\"\n";
    let book = eigenring::scheme::RuleBook::parse_boundary("own.toml", boundary, "triangles").unwrap();
    assert!(book.check(&[1, 2], 6).unwrap_err().to_string().contains("at k = 2"));
    assert!(book.check(&[1], 1).unwrap().iter().all(|sum| !sum.identity));
}
