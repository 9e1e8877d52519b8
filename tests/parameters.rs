//! Are functions of a parameter, sweeps and ranges what can be worked out by hand?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::Analyzer;
use eigenring::analysis::exact::words::form_in_words;
use eigenring::numbers::closed_form::ClosedForm;
use eigenring::report::ranges::{RangeReport, ranges};
use eigenring::report::sweep::{Sweep, SweepRequest, sweep_csv};
use eigenring::scheme::{Interval, Scheme, catalogue};
use std::f64::consts::TAU;

/// Loop's scheme with parameters, a vertex rule and an edge rule.
fn loop_like(parameters: &str, centre: &str, ring: &str, ends: &str, opposite: &str) -> Scheme {
    let text = format!(
        "name = \"Own\"\nmesh = \"triangles\"\nsplit = \"1-to-4\"\n[parameters]\n{parameters}\n[vertex]\ncentre = \
         \"{centre}\"\nring = \"{ring}\"\n[edge]\nends = \"{ends}\"\nopposite = \"{opposite}\"\n"
    );
    Scheme::parse("own", "own.toml", &text).unwrap_or_else(|faults| panic!("{faults}"))
}

fn free_beta() -> Scheme {
    loop_like("beta = \"1/16\"", "1 - n*beta", "beta", "3/8", "1/8")
}

/// Every form for all n, in words.
fn forms(scheme: &Scheme) -> Vec<String> {
    let analyzer = Analyzer::new(scheme).unwrap();
    let all = analyzer.forms().unwrap();
    let forms = all.frequencies.iter().flat_map(|frequency| &frequency.forms);
    let words = forms.filter_map(|form| ClosedForm::of(&form.polynomial)).flatten();
    words.map(|form| form_in_words(&form, &all.parameters).text).collect()
}

fn of(ranges: &[RangeReport], n: usize, condition: &str) -> String {
    let found = ranges.iter().find(|range| range.n == n && range.condition == condition);
    found.unwrap_or_else(|| panic!("no {condition} at {n}")).words()
}

#[test]
fn eigenvalues_are_functions_of_parameters() {
    let mut scheme = free_beta();
    scheme.leave_free("beta").unwrap();
    let found = forms(&scheme);
    assert!(found.contains(&"(5 - 8*n*beta)/8".to_string()), "{found:?}");

    let mut two = loop_like("beta = \"1/16\"\nw = \"0\"", "1 - n*beta", "beta", "3/8 + w/2", "1/8 - w/2");
    two.leave_free("beta").unwrap();
    two.leave_free("w").unwrap();
    let found = forms(&two);
    assert!(found.contains(&"(5 - 8*n*beta - 4*w)/8".to_string()), "{found:?}");
    assert!(found.contains(&"1/8 - w/2".to_string()), "{found:?}");
    // the forms have the numbers of the analysis at a value
    let analyzer = Analyzer::new(&two).unwrap();
    let exact = analyzer.at(9).unwrap().exact.unwrap();
    let formulas: Vec<&str> =
        exact.eigenvalues.iter().filter_map(|e| e.formula.as_ref()).map(|words| words.text.as_str()).collect();
    assert!(formulas.iter().all(|formula| !formula.contains('?')), "{formulas:?}");
    assert!(formulas.contains(&"(5 - 8*n*beta - 4*w)/8"), "{formulas:?}");
}

/// Its default is 0, where the stencil is smaller.
#[test]
fn a_parameter_whose_weights_vanish_at_its_value_is_free_all_the_same() {
    let mut scheme = catalogue::open("modified-butterfly").unwrap().unwrap();
    scheme.leave_free("w").unwrap();
    let found = forms(&scheme);
    assert!(found.contains(&"1/8 + 4*w".to_string()), "{found:?}");
}

#[test]
fn parameters_that_cannot_be_free_are_refused() {
    let mut scheme = loop_like(
        "tension = \"0\"\na = \"0\"\nb = \"0\"\nsteps = { default = \"1\", integer = true }",
        "5/8 + 0*a*b",
        "3/(8*n)",
        "3/8 + 0*tension*steps",
        "1/8",
    );
    assert!(scheme.leave_free("tenson").unwrap_err().contains("did you mean `tension`?"));
    assert!(scheme.leave_free("steps").unwrap_err().contains("whole number"));
    scheme.leave_free("a").unwrap();
    scheme.leave_free("b").unwrap();
    scheme.leave_free("a").unwrap();
    assert!(scheme.leave_free("tension").unwrap_err().contains("at most 2"));
    assert_eq!(scheme.free_parameters(), ["a", "b"]);
}

#[test]
fn intervals_are_read_and_others_refused() {
    let interval = Interval::parse(" w = -1/8 .. 0.25").unwrap();
    assert_eq!(
        (interval.name.as_str(), interval.from.to_string(), interval.to.to_string()),
        ("w", "-1/8".into(), "1/4".into())
    );
    assert_eq!(interval.at(1, 3).to_string(), "0");
    for (text, word) in [
        ("w", "name=low..high"),
        ("w=1", "name=low..high"),
        ("=0..1", "name=low..high"),
        ("w=..1", "name=low..high"),
        ("w=1..0", "upwards"),
        ("w=1..1", "upwards"),
        ("w=0..v", "`v` is a name"),
        ("w=0..1/0", "division by zero"),
        ("w=0..sqrt(2)", "not a rational number"),
        ("w=0..pi", "not a rational number"),
    ] {
        assert!(Interval::parse(text).unwrap_err().contains(word), "{text}: {:?}", Interval::parse(text));
    }
    assert_eq!(SweepRequest::parse("w=0..1:10").unwrap().steps, 10);
    assert_eq!(SweepRequest::parse("w=0..1").unwrap().steps, 64);
    for text in ["w=0..1:0", "w=0..1:x", "w=0..1:-1", "w=0..1:1000000"] {
        assert!(SweepRequest::parse(text).unwrap_err().contains("number of steps"), "{text}");
    }
}

/// Loop with 5/8 - n beta in frequency 0 and 3/8 + cos(2 pi k/n)/4 in the others, and beta and 1/8 elsewhere.
#[test]
fn a_sweep_has_the_values_by_hand() {
    let request = SweepRequest::parse("beta=0..1/8:16").unwrap();
    let sweep = Sweep::of(&free_beta(), &[5, 9], &request).unwrap();
    assert_eq!((sweep.points.len(), sweep.left_out), (34, 0));
    for point in &sweep.points {
        let beta = point.value.to_f64().value();
        let n = point.n as f64;
        let wave = |k: usize| 3.0 / 8.0 + libm::cos(TAU * k as f64 / n) / 4.0;
        let cup = (5.0 / 8.0 - n * beta).abs();
        let mut moduli: Vec<(f64, usize)> = (1..=point.n / 2).map(|k| (wave(k), k)).collect();
        moduli.extend([(cup, 0), (0.125, 1), (beta, 1)]);
        moduli.sort_by(|a, b| b.0.total_cmp(&a.0));
        assert!((point.lambda - moduli[0].0).abs() < 1e-12 && (point.mu - moduli[1].0).abs() < 1e-12, "{point:?}");
        if moduli[0].0 - moduli[1].0 > 1e-9 {
            assert_eq!((point.frequency, point.ratio.is_some()), (moduli[0].1, moduli[0].1 == 1), "{point:?}");
        }
    }
    assert_eq!(sweep_csv(&sweep).lines().count(), 35);
}

#[test]
fn values_without_weights_are_left_out_and_long_sweeps_refused() {
    let scheme = loop_like("w = \"1\"", "5/8 + 0/(w - 1/2)", "3/(8*n)", "3/8", "1/8");
    let sweep = Sweep::of(&scheme, &[5], &SweepRequest::parse("w=0..1:2").unwrap()).unwrap();
    assert_eq!((sweep.points.len(), sweep.left_out), (2, 1));
    let long = Sweep::of(&scheme, &[5, 6], &SweepRequest::parse("w=0..1:10000").unwrap());
    assert!(long.unwrap_err().contains("fewer steps"));
    let many = Sweep::of(&scheme, &[100_000], &SweepRequest::parse("w=0..1").unwrap());
    assert!(many.unwrap_err().contains("fewer valences"));
    assert!(
        Sweep::of(&scheme, &[5], &SweepRequest::parse("v=0..1").unwrap()).unwrap_err().contains("no parameter `v`")
    );
}

/// `subdominant` holds for |5/8 - n beta| < lambda and |beta| < lambda with lambda = 3/8 + cos(2 pi/n)/4, and |mu| <= lambda^2 for
/// |5/8 - n beta| <= lambda^2 and |beta| <= lambda^2, where the other frequencies let it.
#[test]
fn the_ranges_of_a_free_beta_are_those_by_hand() {
    let interval = Interval::parse("beta=0..1/4").unwrap();
    let found = ranges(&free_beta(), &[3, 4, 5, 7, 8, 12], &interval, &|| ()).unwrap();
    for (n, subdominant, bounded) in [
        (3, "(1/8, 1/4)", "nowhere"),
        (4, "(1/16, 1/4)", "[31/256, 9/64]"),
        (
            5,
            "(1/20 - cos(2*pi/5)/20 = 0.0345491503, 1/5 + cos(2*pi/5)/20 = 0.2154508497)",
            "[3/32 - cos(2*pi/5)/32 = 0.0840932189, 5/32 + cos(2*pi/5)/32 = 0.1659067811]",
        ),
        (8, "(1/32 - cos(pi/4)/32 = 0.0091529131, 1/8 + cos(pi/4)/32 = 0.1470970869)", "nowhere"),
        (12, "(1/48 - cos(pi/6)/48 = 0.0027911374, 1/12 + cos(pi/6)/48 = 0.1013755292)", "nowhere"),
    ] {
        assert_eq!(of(&found, n, "subdominant"), subdominant, "n = {n}");
        assert_eq!(of(&found, n, "|mu| <= lambda^2"), bounded, "n = {n}");
    }
    // |5/8 - 7 beta| < 1
    assert_eq!(of(&found, 7, "1 dominates"), "[0, 13/56)");
    assert_eq!(of(&found, 3, "1 dominates"), "everywhere");
    for range in &found {
        assert!(range.undecided_at.is_empty() && range.not_decided.is_none(), "{range:?}");
    }
}

/// Ends, samples inside and outside: the approximate analysis says the same, away from the ends.
#[test]
fn ranges_agree_with_sweeps() {
    let edge = || loop_like("w = \"0\"", "5/8", "3/(8*n)", "3/8 + w/2", "1/8 - w/2");
    let butterfly = catalogue::open("modified-butterfly").unwrap().unwrap();
    for (scheme, text) in [(edge(), "w=-1/4..1/4"), (free_beta(), "beta=-1/8..3/8"), (butterfly, "w=-1/4..1/4")] {
        let valences = [3, 4, 5, 6, 7, 9];
        let found = ranges(&scheme, &valences, &Interval::parse(text).unwrap(), &|| ()).unwrap();
        let sweep = Sweep::of(&scheme, &valences, &SweepRequest::parse(&format!("{text}:53")).unwrap()).unwrap();
        let mut seen = 0;
        for point in &sweep.points {
            let value = point.value.to_f64().value();
            for (condition, margin, holds) in [
                ("1 dominates", (1.0 - point.lambda).abs(), point.lambda < 1.0),
                ("subdominant", point.lambda - point.mu, point.ratio.is_some()),
                (
                    "|mu| <= lambda^2",
                    (point.lambda - point.mu).min((point.ratio.unwrap_or(9.0) - 1.0).abs()),
                    point.ratio.is_some_and(|ratio| ratio < 1.0),
                ),
            ] {
                let range = found.iter().find(|range| range.n == point.n && range.condition == condition).unwrap();
                let Some(intervals) = &range.intervals else { panic!("{range:?}") };
                if margin > 1e-9 {
                    let inside = intervals.iter().any(|i| i.from <= value && value <= i.to);
                    assert_eq!(inside, holds, "{text} {condition}: {point:?} {range:?}");
                    seen += 1;
                }
            }
        }
        assert!(seen > 500, "{seen}");
    }
}

/// An end that is a multiple of a single cosine, and one at which a modulus that doesn't matter ties.
#[test]
fn ends_may_be_single_cosines() {
    let scheme = loop_like("w = \"1/8\"", "5/8 - n*w", "3/(8*n) + w", "3/8", "1/8");
    let found = ranges(&scheme, &[5], &Interval::parse("w=-1/4..1/4").unwrap(), &|| ()).unwrap();
    // |1/4 - 5 w| < 3/8 + cos(2 pi/5)/4
    let lambda = "-1/40 - cos(2*pi/5)/20 = -0.0404508497, 1/8 + cos(2*pi/5)/20 = 0.1404508497";
    assert_eq!(of(&found, 5, "subdominant"), format!("({lambda})"));
    let shifted = loop_like("w = \"1/8\"", "5/8 - n*(w - 1/40)", "3/(8*n) + w - 1/40", "3/8", "1/8");
    let found = ranges(&shifted, &[5], &Interval::parse("w=-1/4..1/10").unwrap(), &|| ()).unwrap();
    assert_eq!(of(&found, 5, "subdominant"), "(-cos(2*pi/5)/20 = -0.0154508497, 1/10]");
}

/// A square of the parameter in a weight: an end that is a square root.
#[test]
fn ends_may_be_square_roots() {
    let scheme = loop_like("t = \"1/4\"", "1 - n*t^2", "t^2", "3/8", "1/8");
    let found = ranges(&scheme, &[4], &Interval::parse("t=0..1/2").unwrap(), &|| ()).unwrap();
    // |5/8 - 4 t^2| <= 9/64: t from sqrt(31)/16, and t^2 <= 9/64
    assert_eq!(of(&found, 4, "|mu| <= lambda^2"), "[sqrt(31)/16 = 0.3479852727, 3/8]");
}

/// At a pole nothing holds; a case that depends on the parameter is not decided.
#[test]
fn poles_are_left_out_and_what_is_beyond_is_told() {
    let scheme = loop_like("w = \"0\"", "5/8 + 0*w", "3/(8*n)", "3/8", "1/8");
    let found = ranges(&scheme, &[5], &Interval::parse("w=0..1").unwrap(), &|| ()).unwrap();
    assert_eq!(of(&found, 5, "1 dominates"), "everywhere");

    // 1 - 5 b and b with b = 1/(1000 (2 w - 1)) + 3/40: a pole at w = 1/2
    let b = "(3/(8*n) + 1/(1000*(2*w - 1)))";
    let pole = loop_like("w = \"0\"", &format!("1 - n*{b}"), b, "3/8", "1/8");
    let found = ranges(&pole, &[5], &Interval::parse("w=1/4..3/4").unwrap(), &|| ()).unwrap();
    let words = of(&found, 5, "1 dominates");
    assert!(words.starts_with("[1/4, ") && words.ends_with(", 3/4]") && words.contains(") and ("), "{words}");
    let far = ranges(&free_beta(), &[100], &Interval::parse("beta=0..1").unwrap(), &|| ()).unwrap();
    assert!(of(&far, 100, "subdominant").starts_with("not decided: "));
}
