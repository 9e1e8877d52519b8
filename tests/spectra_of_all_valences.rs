//! Is the order of the eigenvalues proved for every valence where it holds, refuted where it excludes C1, and is nothing
//! wrong accepted?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::Analyzer;
use eigenring::analysis::exact::ExactAnalysis;
use eigenring::analysis::spectra::Spectra;
use eigenring::proof::outcome::{Outcome, Valences};
use eigenring::proof::spectrum::order::at_once;
use eigenring::proof::spectrum::refutation::{against_c1, is_effective};
use eigenring::proof::spectrum::tail::TailProof;
use eigenring::scheme::{Scheme, catalogue};
use proptest::prelude::*;
use std::cmp::Ordering;

/// Proved for every n, as in the literature: Zorin (2000), Peters and Reif (1998), Zorin and Schroeder (2001).
const C1: [&str; 7] = [
    "loop",
    "loop-warren",
    "catmull-clark",
    "doo-sabin",
    "catmull-clark-biquadratic",
    "modified-butterfly",
    "midpoint",
];

fn open(id: &str) -> Scheme {
    catalogue::open(id).unwrap().unwrap()
}

/// A scheme of the catalogue with other words in its file, without claims.
fn with(id: &str, changes: &[(&str, &str)]) -> Scheme {
    let mut text = catalogue::scheme(id).unwrap().text.split("[[claims]]").next().unwrap().to_string();
    for (old, new) in changes {
        assert!(text.contains(old), "{id}: {old}");
        text = text.replace(old, new);
    }
    Scheme::parse("own", "own.toml", &text).unwrap_or_else(|faults| panic!("{faults}"))
}

/// Loop's scheme with another sum of the weights at the vertex, but for n = 6: frequency 0 has 5/8 less this, frequency k
/// has 3/8 + c_k/4.
fn loop_with(total: &str) -> Scheme {
    let beta = "[let]\nbeta = \"(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n\"";
    with("loop", &[(beta, &format!("[let.beta]\n\"n == 6\" = \"1/16\"\n\"n != 6\" = \"({total})/n\""))])
}

/// A dual scheme on polygons whose frequency 1 has the eigenvalue `first`, and all from 2 on `others`; 1/4 follows.
fn dual_with(first: &str, others: &str) -> Scheme {
    let ring = format!("(1 - ({others}) + 2*(({first}) - ({others}))*cos(2*pi*j/n))/n");
    let own = [("\"(3 + 2*cos(2*pi*j/n))/(4*n)\"", format!("\"{ring}\"")), ("\"1/4\"", format!("\"{others}\""))];
    let changes: Vec<(&str, &str)> = own.iter().map(|(old, new)| (*old, new.as_str())).collect();
    with("doo-sabin", &changes)
}

/// How the order was proved.
#[derive(Clone, Debug, PartialEq)]
enum Order {
    /// By the exact analysis of one valence.
    Single,
    /// At once.
    AtOnce(Box<TailProof>),
}

/// What is known of the order at every n >= 3. Refuted is C1, for generic data, where the order excludes it.
#[derive(Clone, Debug, PartialEq)]
struct Orders {
    /// Single valences first; then all from one on. The first entry that has a valence is about it.
    parts: Vec<(Valences, Outcome<Order>)>,
}

impl Orders {
    /// What is known at a valence.
    fn at(&self, n: usize) -> Outcome<&Order> {
        match self.parts.iter().find(|(valences, _)| valences.hold(n)) {
            Some((_, Outcome::Proved(order))) => Outcome::Proved(order),
            Some((_, Outcome::Refuted { witness })) => Outcome::Refuted { witness: witness.clone() },
            Some((_, Outcome::Undecided { at })) => Outcome::stuck(at.clone()),
            None => Outcome::stuck(format!("n = {n} is not looked at")),
        }
    }

    /// Whether the order is proved for every n >= 3.
    fn hold_everywhere(&self) -> bool {
        self.parts.iter().all(|(_, outcome)| matches!(outcome, Outcome::Proved(_)))
    }

    /// The proof for all valences from one on, if there is one.
    fn tail(&self) -> Option<&TailProof> {
        self.parts.iter().find_map(|(_, outcome)| match outcome {
            Outcome::Proved(Order::AtOnce(tail)) => Some(tail.as_ref()),
            _ => None,
        })
    }
}

/// Decides what can be decided, by a second judgement beside that of the verdicts. Where nothing is known for all valences from one on, no single ones are looked at.
fn prove(analyzer: &Analyzer) -> Orders {
    let (from, except, at_once) = at_once(analyzer, is_effective(analyzer));
    let single = if matches!(at_once, Outcome::Undecided { .. }) { 3..3 } else { 3..from };
    let mut parts: Vec<_> = single.chain(except).map(|n| (Valences::At(n), at(analyzer, n))).collect();
    parts.push((Valences::From(from), at_once.map(|tail| Order::AtOnce(Box::new(tail)))));
    Orders { parts }
}

/// What the exact analysis of a valence says.
fn at(analyzer: &Analyzer, n: usize) -> Outcome<Order> {
    let exact = match analyzer.at(n).map(|analysis| analysis.exact) {
        Ok(Ok(exact)) => exact,
        Ok(Err(why)) => return Outcome::stuck(why),
        Err(obstacle) => return Outcome::stuck(obstacle.to_string()),
    };
    match (against_c1(&exact, n, is_effective(analyzer)), misses(&exact)) {
        (Some(witness), _) => Outcome::Refuted { witness },
        (None, None) => Outcome::Proved(Order::Single),
        (None, Some(why)) => Outcome::stuck(why),
    }
}

/// What the order at a valence misses, if anything.
fn misses(exact: &ExactAnalysis) -> Option<&'static str> {
    let leads = |first: usize, mut others: Box<dyn Iterator<Item = usize> + '_>| {
        others.all(|other| exact.compare_moduli(first, other) == Some(Ordering::Greater))
    };
    let Some(one) = exact.one.filter(|one| exact.eigenvalues[*one].algebraic == Some(1)) else {
        return Some("1 is not seen to be simple");
    };
    if !leads(one, Box::new(exact.after_one().map(|(index, _)| index))) {
        return Some("1 is not seen to be larger than all others");
    }
    let Some(lambda) = exact.lambda else {
        return Some("no real, positive, simple eigenvalue of frequency 1 is seen to lead after 1");
    };
    let others = exact.after_one().map(|(index, _)| index).filter(|index| *index != lambda);
    (!leads(lambda, Box::new(others))).then_some("lambda is not seen to be larger than all others after 1")
}

fn orders(scheme: &Scheme) -> Orders {
    prove(&Analyzer::new(scheme).unwrap())
}

fn is_proved(orders: &Orders, n: usize) -> bool {
    matches!(orders.at(n), Outcome::Proved(_))
}

fn is_refuted(orders: &Orders, n: usize) -> bool {
    matches!(orders.at(n), Outcome::Refuted { .. })
}

#[test]
fn the_order_of_known_schemes_is_proved_for_every_valence() {
    for id in C1 {
        let found = orders(&open(id));
        assert!(found.hold_everywhere(), "{id}: {found:?}");
        assert!((3..200).all(|n| is_proved(&found, n)), "{id}: {found:?}");
        assert!(matches!(found.parts.last(), Some((Valences::From(n), _)) if *n <= 5), "{id}: {found:?}");
    }
}

/// Only of Catmull and Clark's rules of degree 3 the frequencies 0 and 1 have eigenvalues that meet: (3 + sqrt 5)/8.
#[test]
fn frequency_0_meets_lambda_at_infinity_where_it_does() {
    for id in C1 {
        let found = orders(&open(id));
        assert_eq!(found.tail().unwrap().tie_at_infinity.is_some(), id == "catmull-clark", "{id}");
    }
}

/// The midpoint schemes of other degrees.
#[test]
fn midpoint_schemes_of_low_degree_are_proved() {
    for d in ["2", "4", "5"] {
        let found = orders(&open("midpoint").with_value("d", d).unwrap());
        assert!(found.hold_everywhere(), "{d}: {found:?}");
    }
}

/// What a tail says against the exact analysis, which shares no step with it but the rows, and against floating numbers.
#[test]
fn tails_agree_with_other_ways() {
    for id in C1 {
        let scheme = open(id);
        let analyzer = Analyzer::new(&scheme).unwrap();
        let found = prove(&analyzer);
        let tail = found.tail().unwrap();
        for n in [tail.from, 12, 20] {
            let exact = analyzer.at(n).unwrap().exact.unwrap();
            assert_eq!(misses(&exact), None, "{id} {n}");
            let (least, most) = exact.eigenvalues[exact.lambda.unwrap()].re.lo_hi();
            assert!(tail.low < least && most < tail.high, "{id} {n}");
        }
        let spectra = Spectra::new(&scheme).unwrap();
        for n in [50, 101] {
            let spectrum = spectra.at(n).unwrap();
            let lambda = spectrum.subdominant().unwrap();
            assert!(lambda.frequency == 1 && lambda.is_isolated() && lambda.multiplicity(n) == 2, "{id} {n}");
            let value = lambda.real().unwrap();
            assert!(tail.low.to_f64().value() < value && value < tail.high.to_f64().value(), "{id} {n}");
            assert!(spectrum.after_subdominant().all(|e| e.modulus() < value - 1e-9), "{id} {n}");
            let tops = |k: usize| spectrum.largest_of(k).and_then(|e| e.real());
            let from = tail.increases_from.as_ref().map(|from| from.to_f64().value());
            for k in 2..n / 2 {
                let cosine = |k: usize| (std::f64::consts::TAU * k as f64 / n as f64).cos();
                if from.is_some_and(|from| cosine(k) > from) {
                    assert!(tops(k).unwrap() < tops(k - 1).unwrap(), "{id} {n} {k}");
                } else {
                    assert!(spectrum.largest_of(k).unwrap().modulus() < tail.low.to_f64().value(), "{id} {n} {k}");
                }
            }
        }
    }
}

/// Zorin (2000): Dyn, Levin and Gregory's scheme is C1 at 4 <= n <= 7 only.
#[test]
fn the_butterfly_is_refuted_from_8_on() {
    let found = orders(&open("butterfly"));
    assert!(is_refuted(&found, 3) && (4..=7).all(|n| is_proved(&found, n)), "{found:?}");
    assert!((8..300).all(|n| is_refuted(&found, n)), "{found:?}");
    assert!(matches!(found.parts.last(), Some((Valences::From(8), Outcome::Refuted { .. }))), "{found:?}");
}

/// Warren (1995) has a weight of its own at n = 3: with 3/(8 n) frequency 0 ties with frequency 1, both 1/4.
#[test]
fn a_tie_at_one_valence_is_seen_there() {
    let found = orders(&with("loop-warren", &[("\"n == 3\" = \"3/16\"", ""), ("\"n > 3\"", "\"n >= 3\"")]));
    assert!(is_refuted(&found, 3) && (4..100).all(|n| is_proved(&found, n)), "{found:?}");
}

/// A weight that is wrong at n = 9 only.
#[test]
fn a_wrong_weight_at_one_valence_is_seen_there() {
    let beta = "[let]\nbeta = \"(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n\"";
    let own = "[let.beta]\n\"n == 9\" = \"13/90\"\n\"n != 9\" = \"(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n\"";
    let found = orders(&with("loop", &[(beta, own)]));
    assert!(is_refuted(&found, 9), "{found:?}");
    assert!((3..100).all(|n| n == 9 || is_proved(&found, n)), "{found:?}");
}

/// 5/8 - 13/10 = -27/40 is larger in modulus than all 3/8 + c/4; 5/8 - 1/100 is up to n = 22: cos(2 pi/22) < 24/25.
#[test]
fn frequency_0_leads_at_all_valences_or_at_the_first() {
    let large = orders(&loop_with("13/10"));
    assert!((3..300).all(|n| is_refuted(&large, n) == (n != 6)) && is_proved(&large, 6), "{large:?}");
    let small = orders(&loop_with("1/100"));
    let is_right = |n: usize| if n < 23 && n != 6 { is_refuted(&small, n) } else { is_proved(&small, n) };
    assert!((3..300).all(is_right), "{small:?}");
}

/// 5/8 - x/(4 n^2) is below 5/8 - (1 - c)/4 for every n exactly if x >= 2 pi^2 = 19.739...
#[test]
fn a_tie_at_infinity_is_decided_by_its_second_term() {
    let found = orders(&loop_with("5/n^2"));
    assert!(found.hold_everywhere() && found.tail().unwrap().tie_at_infinity == Some(2), "{found:?}");
    let found = orders(&loop_with("(49/10)/n^2"));
    assert!((20..300).all(|n| !is_proved(&found, n)), "{found:?}");
}

/// All frequencies from 2 on are alike: with frequency 1, or larger; at n = 3 there are none.
#[test]
fn an_eigenvalue_that_does_not_depend_on_its_frequency_is_no_proof() {
    for (first, others) in [("1/3", "1/3"), ("1/3", "2/5")] {
        let found = orders(&dual_with(first, others));
        assert!((4..100).all(|n| !is_proved(&found, n)), "{first} {others}: {found:?}");
    }
    let found = orders(&dual_with("2/5", "1/3"));
    assert!(found.hold_everywhere(), "{found:?}");
}

/// The shifts of mid-edge's box spline are dependent, and at n = 3 lambda has a Jordan block: undecided there.
#[test]
fn mid_edge_is_proved_but_at_3() {
    let found = orders(&open("mid-edge"));
    assert!(matches!(found.at(3), Outcome::Undecided { .. }), "{found:?}");
    assert!(matches!(found.at(4), Outcome::Proved(Order::AtOnce(_))), "{found:?}");
    assert!(found.tail().unwrap().high > dashu_ratio::RBig::ONE);
}

fn reasons(scheme: &Scheme, valences: impl IntoIterator<Item = usize>) -> Vec<Option<String>> {
    let analyzer = Analyzer::new(scheme).unwrap();
    let effective = is_effective(&analyzer);
    let reason = |n: usize| against_c1(analyzer.at(n).unwrap().exact.as_ref().unwrap(), n, effective);
    valences.into_iter().map(reason).collect()
}

/// Zorin (2000): Dyn, Levin and Gregory's scheme is C1 at 4 <= n <= 7 only.
#[test]
fn the_butterfly_is_refuted_where_the_literature_says_so() {
    let found = reasons(&open("butterfly"), 3..=12);
    let starts = |n: usize, words: &str| found[n - 3].as_ref().is_some_and(|reason| reason.starts_with(words));
    assert!(starts(3, "frequency 0 leads: after 1 its 1/4 with a Jordan block of size 3"), "{:?}", found[0]);
    assert!((4..=7).all(|n| found[n - 3].is_none()), "{found:?}");
    assert!((8..=12).all(|n| starts(n, "frequency 2 leads")), "{found:?}");
}

/// Warren (1995) has a weight of its own at n = 3: with 3/(8 n) frequency 0 ties with frequency 1, both 1/4.
#[test]
fn a_tie_is_refuted_and_its_cure_is_not() {
    let tie = with("loop-warren", &[("\"n == 3\" = \"3/16\"", ""), ("\"n > 3\"", "\"n >= 3\"")]);
    let found = reasons(&tie, 3..=5);
    assert!(found[0].as_ref().unwrap().starts_with("a tie: after 1 lead 1/4 of frequency 0 and 1/4 of frequency 1"));
    assert_eq!(found[1..], [None, None]);
    assert_eq!(reasons(&open("loop-warren"), 3..=5), [None, None, None]);
}

/// The centre's eigenvalue is 5/8 - n beta: .615 at n = 8 against .5518, -.675 at n = 20 against .6128.
#[test]
fn frequency_0_is_seen_to_lead_where_weights_are_too_small_or_too_large() {
    for (total, n) in [("1/100", 8), ("13/10", 20)] {
        let found = reasons(&loop_with(total), [n]);
        assert!(found[0].as_ref().is_some_and(|reason| reason.starts_with("frequency 0 leads")), "{found:?}");
    }
    assert_eq!(reasons(&open("loop"), [8, 20]), [None, None]);
}

/// Where eigenvectors may have the limit 0, nothing is refuted: the shifts of mid-edge's box spline are dependent.
#[test]
fn nothing_is_refuted_where_eigenvectors_may_be_ineffective() {
    let scheme = open("mid-edge");
    assert!(!is_effective(&Analyzer::new(&scheme).unwrap()));
    let butterfly = open("butterfly");
    let analysis = Analyzer::new(&butterfly).unwrap().at(8).unwrap();
    assert_eq!(against_c1(analysis.exact.as_ref().unwrap(), 8, false), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Not C1 but at n = 6: |5/8 - total| >= 5/8 is larger than all of frequency 1.
    #[test]
    fn weights_that_are_too_large_or_negative_are_never_accepted(above in 1_i64..40, below in 1_i64..9, sign in 0..2) {
        let total = if sign == 0 { format!("5/4 + {above}/{}", 40 * below) } else { format!("-{above}/{}", 40 * below) };
        let found = orders(&loop_with(&total));
        prop_assert!((3..40).filter(|n| *n != 6).all(|n| !is_proved(&found, n)), "{found:?}");
    }

    /// Not C1 from n = 4 on: those of frequencies from 2 on are at least as large as that of frequency 1.
    #[test]
    fn frequencies_from_2_on_that_lead_are_never_accepted(first in -40_i64..41, more in 0_i64..41) {
        let others = (first.abs() + more).clamp(11, 39);
        prop_assume!(first.abs() <= others);
        let found = orders(&dual_with(&format!("{first}/40"), &format!("{others}/40")));
        prop_assert!((4..40).all(|n| !is_proved(&found, n)), "{found:?}");
    }
}
