//! Are exact values exact: the literature's closed forms, multiplicities, Jordan blocks, ties, and the limits of the exact world?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::Analyzer;
use eigenring::analysis::exact::{Arithmetic, ExactAnalysis};
use eigenring::numbers::{Field, Trouble};
use eigenring::report::Study;
use eigenring::report::model::{Quantity, Report};
use eigenring::scheme::formula::{Formula, Names};
use eigenring::scheme::{Scheme, catalogue};
use eigenring::verdicts::{CurvatureClass, Decision};

/// n and k as numbers.
struct At {
    n: usize,
    k: usize,
}

impl Names<f64> for At {
    fn value(&self, name: &str) -> Result<f64, Trouble> {
        match name {
            "n" => Ok(f64::whole(self.n as i64)),
            "k" => Ok(f64::whole(self.k as i64)),
            _ => Err(Trouble::Domain("no such name")),
        }
    }
}

fn value(formula: &str, n: usize, k: usize) -> f64 {
    Formula::parse(formula)
        .unwrap_or_else(|fault| panic!("{formula}: {}", fault.message))
        .evaluate(&At { n, k })
        .unwrap()
}

fn open(id: &str) -> Scheme {
    catalogue::open(id).unwrap().unwrap()
}

fn report(scheme: &Scheme, valences: &[usize]) -> Report {
    Study::of(scheme, valences, false, &|| ()).unwrap().report
}

fn loop_with(beta: &str) -> Scheme {
    let text = catalogue::scheme("loop").unwrap().text.replace("(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n", beta);
    let text = text.split("[[claims]]").next().unwrap().to_string();
    Scheme::parse("own", "own.toml", &text).unwrap_or_else(|faults| panic!("{faults}"))
}

/// Published closed forms (Loop 1987; Ball and Storry 1988; Doo and Sabin 1978), as strings of the report.
#[test]
fn closed_forms_are_printed_as_the_literature_prints_them() {
    let forms = |id: &str, k: &str| -> Vec<String> {
        let report = report(&open(id), &[5]);
        let all = report.all_valences.unwrap();
        let own = all.frequencies.iter().find(|own| own.k == k).unwrap();
        own.eigenvalues.iter().map(|e| e.form.formula.clone()).collect()
    };
    let has = |id: &str, k: &str, form: &str| {
        let all = forms(id, k);
        assert!(all.iter().any(|own| own == form), "{id} {k}: {all:?}");
    };
    has("loop", "other", "3/8 + cos(2*pi*k/n)/4");
    has("loop", "0", "(3/8 + cos(2*pi/n)/4)^2");
    has("loop-warren", "0", "1/4");
    let root = "sqrt((cos(2*pi*k/n) + 1)*(cos(2*pi*k/n) + 9))";
    has("catmull-clark", "other", &format!("(5 + cos(2*pi*k/n) + {root})/16"));
    has("catmull-clark", "other", &format!("(5 + cos(2*pi*k/n) - {root})/16"));
    has("catmull-clark", "0", "(3*n - 7 + sqrt(5*n^2 - 30*n + 49))/(8*n)");
    has("catmull-clark", "0", "(3*n - 7 - sqrt(5*n^2 - 30*n + 49))/(8*n)");
    has("doo-sabin", "1", "1/2");
    has("doo-sabin", "other", "1/4");
    has("catmull-clark-biquadratic", "other", "1/2 + cos(2*pi*k/n)/4");
    has("modified-butterfly", "1", "1/2");
    has("modified-butterfly", "2", "1/4");
}

/// Every form for all n, put in at n and k, is an eigenvalue of that block as often as it says; and all eigenvalues are told so.
#[test]
fn forms_for_all_n_are_the_eigenvalues_at_each_n() {
    // schemes with roots of polynomials that have no radicals
    let mut unsaid = 0;
    for listed in catalogue::SCHEMES {
        let report = report(&open(listed.id), &(3..=16).collect::<Vec<_>>());
        let all = report.all_valences.unwrap();
        if all.frequencies.iter().flat_map(|own| &own.eigenvalues).any(|e| e.form.formula.starts_with("root")) {
            unsaid += 1;
            continue;
        }
        for v in report.valences.iter().filter(|v| v.n >= all.from && all.except != Some(v.n)) {
            for k in 0..=v.n / 2 {
                let kind = [k.to_string(), if 2 * k == v.n { "n/2".into() } else { "other".to_string() }];
                let own = kind.iter().find_map(|kind| all.frequencies.iter().find(|own| own.k == *kind)).unwrap();
                let blocks = if k == 0 || 2 * k == v.n { 1 } else { 2 };
                let spread = |value: f64, times: usize| std::iter::repeat_n(value, times);
                let formed = own.eigenvalues.iter().flat_map(|e| spread(value(&e.form.formula, v.n, k), e.algebraic));
                let found = v.eigenvalues.iter().filter(|e| e.frequency == k);
                let found = found.flat_map(|e| spread(e.quantity.value[0], e.algebraic / blocks));
                let (mut formed, mut found): (Vec<f64>, Vec<f64>) = (formed.collect(), found.collect());
                formed.sort_by(f64::total_cmp);
                found.sort_by(f64::total_cmp);
                assert_eq!(formed.len(), found.len(), "{} n = {} k = {k}", listed.id, v.n);
                for (a, b) in formed.iter().zip(&found) {
                    assert!((a - b).abs() < 1e-14, "{} n = {} k = {k}: {formed:?} {found:?}", listed.id, v.n);
                }
            }
        }
    }
    assert!(unsaid <= 4);
}

/// The traces of S and S^2, from the dense matrix in f64, are the sums of the exact eigenvalues and their squares, each with its
/// multiplicity: another way to the same numbers. The strings say the same as the numbers.
#[test]
fn exact_eigenvalues_add_up_to_the_traces() {
    for listed in catalogue::SCHEMES {
        let scheme = open(listed.id);
        let analyzer = Analyzer::new(&scheme).unwrap();
        for n in 3..=13 {
            let analysis = analyzer.at(n).unwrap();
            let dense = analysis.local.dense().unwrap();
            let exact = analysis.exact.as_ref().unwrap();
            if exact.arithmetic != Arithmetic::Exact {
                // cores of ten unknowns are too large for some fields
                assert!(["kobbelt", "four-eight"].contains(&listed.id), "{} n = {n}", listed.id);
                continue;
            }
            let (mut sum, mut squares, mut count) = (0.0, 0.0, 0);
            for e in &exact.eigenvalues {
                let times = e.algebraic.unwrap() * if e.frequency == 0 || 2 * e.frequency == n { 1 } else { 2 };
                let x = e.re.midpoint_f64();
                let y = e.im.midpoint_f64();
                let words = &e.exact.as_ref().unwrap().text;
                // a root of a polynomial that has no radicals is told by the polynomial
                if e.is_real() && !words.starts_with("root") {
                    assert!((value(words, n, 0) - x).abs() < 1e-13, "{} n = {n}: {words} is not {x}", listed.id);
                }
                if let Some(formula) =
                    e.formula.as_ref().filter(|formula| e.is_real() && !formula.text.starts_with("root"))
                {
                    assert!(
                        (value(&formula.text, n, 0) - x).abs() < 1e-13,
                        "{} n = {n}: {} is not {x}",
                        listed.id,
                        formula.text
                    );
                }
                let times_f64 = times as f64;
                (sum, squares, count) = (sum + times_f64 * x, squares + times_f64 * (x * x - y * y), count + times);
            }
            assert_eq!(count, dense.nrows());
            assert!((sum - dense.trace()).abs() < 1e-12, "{} n = {n}", listed.id);
            assert!((squares - (&dense * &dense).trace()).abs() < 1e-12, "{} n = {n}", listed.id);
        }
    }
}

/// u S = u and u S = lambda u in f64, with the exact masks, on the dense matrix; and the formulas for all n say the same.
#[test]
fn exact_masks_survive_a_step() {
    for listed in catalogue::SCHEMES {
        let scheme = open(listed.id);
        let report = report(&scheme, &(3..=12).collect::<Vec<_>>());
        let analyzer = Analyzer::new(&scheme).unwrap();
        for v in &report.valences {
            let (Some(limit_mask), Some(forms)) = (&v.limit_mask, &v.tangent_forms) else {
                assert!(["butterfly", "mid-edge"].contains(&listed.id), "{} n = {}", listed.id, v.n);
                continue;
            };
            let told = |q: &Quantity| q.exact.as_ref().is_some_and(|words| !words.starts_with("root"));
            if !forms.iter().all(|form| told(&form.own) && told(&form.next)) {
                assert!(!["loop", "catmull-clark", "doo-sabin", "sqrt3"].contains(&listed.id));
                continue;
            }
            let analysis = analyzer.at(v.n).unwrap();
            let local = &analysis.local;
            let dense = local.dense().unwrap();
            let turn = std::f64::consts::TAU / v.n as f64;
            let mut limit = vec![0.0; dense.nrows()];
            let mut tangents = [limit.clone(), limit.clone()];
            for row in 0..dense.nrows() {
                let label = local.label(row);
                let centre = local.patch.centre() == Some(label);
                let at =
                    |orbit: Option<[i32; 2]>| if centre { orbit.is_none() } else { orbit == Some([label.i, label.j]) };
                let own = limit_mask.iter().find(|w| at(w.orbit) && (centre || w.sector == Some(label.sector)));
                limit[row] = own.map_or(0.0, |w| w.exact.as_ref().map_or(f64::NAN, |text| value(text, v.n, 0)));
                let form = forms.iter().find(|form| at(Some(form.orbit)) && !centre);
                let part = |q: &Quantity| value(q.exact.as_ref().unwrap(), v.n, 0);
                let (own, next) = form.map_or((0.0, 0.0), |form| (part(&form.own), part(&form.next)));
                let s = f64::from(label.sector) * turn;
                tangents[0][row] = own * s.cos() + next * (s + turn).cos();
                tangents[1][row] = own * s.sin() + next * (s + turn).sin();
            }
            let lambda = v.subdominant.as_ref().unwrap().quantity.value[0];
            let [cosine, sine] = &tangents;
            for (u, factor) in [(&limit, 1.0), (cosine, lambda), (sine, lambda)] {
                for column in 0..dense.ncols() {
                    let image: f64 = (0..dense.nrows()).map(|row| u[row] * dense[(row, column)]).sum();
                    assert!((image - factor * u[column]).abs() < 1e-13, "{} n = {}", listed.id, v.n);
                }
            }
            assert!((limit.iter().sum::<f64>() - 1.0).abs() < 1e-13);
        }
    }
}

/// The limit masks of Catmull-Clark (Halstead, Kass and DeRose 1993) and of Loop's scheme (1/(1 + 8 n beta/3) at the centre), as
/// functions of n.
#[test]
fn limit_masks_for_every_n_are_the_published_ones() {
    let weights = |id: &str| report(&open(id), &[5]).all_valences.unwrap().limit_mask.unwrap();
    let form = |id: &str, at: &str| weights(id).into_iter().find(|w| w.at == at).unwrap().form.formula;
    assert_eq!(form("catmull-clark", "centre"), "n/(n + 5)");
    assert_eq!(form("catmull-clark", "ring"), "4/(n*(n + 5))");
    assert_eq!(form("catmull-clark", "diagonals"), "1/(n*(n + 5))");
    assert_eq!(form("doo-sabin", "ring"), "1/n");
    for n in 3..30 {
        let lambda = 3.0 / 8.0 + (std::f64::consts::TAU / n as f64).cos() / 4.0;
        let centre = 1.0 / (1.0 + 8.0 * (5.0 / 8.0 - lambda * lambda) / 3.0);
        assert!((value(&form("loop", "centre"), n, 0) - centre).abs() < 1e-14);
        assert!((value(&form("loop", "ring"), n, 0) - (1.0 - centre) / n as f64).abs() < 1e-14);
    }
}

fn exact_at(scheme: &Scheme, n: usize) -> ExactAnalysis {
    Analyzer::new(scheme).unwrap().at(n).unwrap().exact.unwrap()
}

/// Doo-Sabin has Jordan blocks of size 2 at 1/4 in frequencies 2..n-2 except n/2, for n >= 5, and no others.
#[test]
fn the_jordan_blocks_of_doo_sabin() {
    let scheme = open("doo-sabin");
    for n in 3..=14 {
        for e in exact_at(&scheme, n).eigenvalues {
            let doubled = n >= 5 && e.frequency >= 2 && 2 * e.frequency != n && e.exact.unwrap().text == "1/4";
            let structure = e.structure.unwrap();
            assert_eq!(structure.largest, if doubled { 2 } else { 1 }, "n = {n} k = {}", e.frequency);
            assert_eq!(structure.geometric + usize::from(doubled), e.algebraic.unwrap(), "n = {n} k = {}", e.frequency);
        }
    }
    let all = report(&scheme, &[5]).all_valences.unwrap();
    let of = |k: &str| {
        let own = all.frequencies.iter().find(|own| own.k == k).unwrap();
        own.eigenvalues.iter().find(|e| e.form.formula == "1/4").unwrap().jordan
    };
    assert_eq!((of("other"), of("n/2"), of("1")), (Some(2), Some(1), Some(1)));
}

/// What curvature does: the literature's cases, decided.
#[test]
fn curvature_is_decided() {
    use CurvatureClass::{BoundedOnly, Converges, Diverges, DivergesNearby, DivergesSlowly, Flat};
    let cases: [(&str, &[(usize, CurvatureClass)]); 5] = [
        ("loop", &[(3, Diverges), (4, BoundedOnly), (5, BoundedOnly), (6, Converges), (7, Diverges)]),
        ("catmull-clark", &[(3, Flat), (4, Converges), (5, Diverges)]),
        ("doo-sabin", &[(3, BoundedOnly), (4, BoundedOnly), (5, DivergesSlowly), (8, DivergesSlowly)]),
        ("loop-warren", &[(4, Diverges), (6, Converges)]),
        ("modified-butterfly", &[(5, DivergesNearby), (6, DivergesSlowly), (7, DivergesNearby)]),
    ];
    for (id, expected) in cases {
        let scheme = open(id);
        let analyzer = Analyzer::new(&scheme).unwrap();
        for (n, class) in expected {
            let curvature = eigenring::verdicts::curvature_of(&analyzer.at(*n).unwrap()).unwrap();
            assert!(curvature.proved && curvature.class == *class, "{id} n = {n}: {curvature:?}");
        }
    }
}

/// Loop: cup = lambda^2 as an identity in n; n = 3 has 1/8 in frequencies 0 and 1 of the outer ring, so the ratio is 2 there.
#[test]
fn loops_cup_ratio_is_one_for_every_n() {
    let report = report(&open("loop"), &[3]);
    let all = report.all_valences.unwrap();
    let cup = all.identities.iter().find(|identity| identity.claim == "cup ratio").unwrap();
    assert!(cup.holds && all.from == 3 && all.except.is_none(), "{cup:?}");
    let mu = report.valences[0].subsubdominant.as_ref().unwrap();
    assert_eq!((mu.exact.as_deref(), mu.frequencies.as_slice(), mu.ratio), (Some("1/8"), &[0, 1][..], Some(2.0)));
    let warren = self::report(&open("loop-warren"), &[3, 4]);
    let cup = |index: usize| warren.valences[index].curvature.cup.as_ref().unwrap().exact.clone().unwrap();
    assert_eq!((cup(0), cup(1)), ("1/16".to_string(), "1/4".to_string()));
    assert!(
        !warren.all_valences.unwrap().identities.iter().any(|identity| identity.claim == "cup ratio" && identity.holds)
    );
}

/// (5 + sqrt(5))/16 from the published digits of sqrt(5) (OEIS A002163).
#[test]
fn as_many_digits_as_asked_are_right() {
    let study = Study::with_digits(&open("loop"), &[5], 40, false, &|| ()).unwrap();
    let lambda = study.report.valences[0].subdominant.as_ref().unwrap().quantity.decimal.clone().unwrap();
    assert_eq!(lambda, "0.4522542485937368560255733542957047647150");
    let study = Study::with_digits(&open("catmull-clark"), &[3], 100, false, &|| ()).unwrap();
    assert_eq!(study.report.valences[0].subdominant.as_ref().unwrap().quantity.decimal.as_ref().unwrap().len(), 102);
}

/// Square roots of rational numbers and cosines of other angles are adjoined; what can't be is enclosed, and says so.
#[test]
fn roots_are_adjoined_or_enclosed() {
    for (beta, exact) in [
        ("sqrt(2)/(16*n)", true),
        ("cos(pi/5)/(4*n)", true),
        ("sqrt(6)*sqrt(3/8)/(16*n)", true),
        ("sqrt(5)/(16*n)", true),
        ("sqrt(1 + cos(2*pi/n))/(16*n)", false),
        ("pi/(16*n)", false),
    ] {
        let scheme = loop_with(beta);
        let analysis = exact_at(&scheme, 5);
        assert_eq!(analysis.arithmetic == Arithmetic::Exact, exact, "{beta}");
        assert_eq!(analysis.why_enclosed.is_none(), exact);
        let next = &analysis.eigenvalues[analysis.subdominant.unwrap()];
        assert!(analysis.one.is_some() && next.re.midpoint_f64() < 0.9, "{beta}: 1 is told from the rest");
        let cup = 5.0 / 8.0 - 5.0 * value(beta, 5, 0);
        let near = |e: &&eigenring::analysis::exact::ExactEigenvalue| (e.re.midpoint_f64() - cup).abs() < 1e-14;
        let found = analysis.eigenvalues.iter().find(near).unwrap_or_else(|| panic!("{beta}"));
        match &found.exact {
            Some(words) => assert!((value(&words.text, 5, 0) - cup).abs() < 1e-13, "{}", words.text),
            None => assert!(!exact && found.algebraic == Some(1)),
        }
    }
}

/// A divisor that is zero exactly, though not in floating numbers, is a fault that names the n and the formula.
#[test]
fn division_by_an_exact_zero_is_a_fault() {
    let scheme = loop_with("1/16 + (2*cos(2*pi/n)^2 - 1)/(4*cos(2*pi/n)^2 - 2)/1000");
    assert!(Study::of(&scheme, &[5], false, &|| ()).is_ok());
    let error = Study::of(&scheme, &[8], false, &|| ()).unwrap_err().to_string();
    assert!(error.contains("division by zero at n = 8") && error.contains("own.toml"), "{error}");
}

/// A value whose exact form explodes stops at a stated limit: the report says so, and nothing exact is claimed.
#[test]
fn exploding_values_stop_at_a_limit() {
    let factors: Vec<String> = (1..60).map(|i| format!("(1 + cos(2*pi*{i}/n))^9")).collect();
    let scheme = loop_with(&format!("1/16 + 0*n + 1/(10^300 + {})", factors.join("*")));
    let report = report(&scheme, &[5]);
    assert!(report.all_valences.is_none());
    let why = report.why_no_formulas.unwrap();
    assert!(why.contains("too large") || why.contains("not a small whole number"), "{why}");
}

/// Beyond a stated degree of the field eigenvalues are enclosed: still told apart, and conditions still decided.
#[test]
fn large_valences_are_enclosed() {
    let report = report(&open("catmull-clark"), &[48, 127]);
    let [exact, enclosed] = &report.valences[..] else { panic!("two valences") };
    assert_eq!((exact.arithmetic, enclosed.arithmetic), ("exact", "enclosed"));
    let verdict = |claim: &str| enclosed.verdicts.iter().find(|v| v.claim == claim).unwrap().verdict;
    assert_eq!(verdict("subdominant"), Decision::Proved);
    assert_eq!(verdict("curvature"), Decision::Refuted);
    let lambda = enclosed.subdominant.as_ref().unwrap();
    assert!(lambda.quantity.decimal.is_some() && lambda.quantity.exact.is_none());
    let c = (std::f64::consts::TAU / 127.0).cos();
    assert!((lambda.quantity.value[0] - (5.0 + c + ((c + 1.0) * (c + 9.0)).sqrt()) / 16.0).abs() < 1e-15);
}
