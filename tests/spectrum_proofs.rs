//! Is the order of the eigenvalues proved where it holds, refuted where it fails, and is nothing wrong accepted?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::Analyzer;
use eigenring::proof::spectrum::refutation::{against_c1, is_effective};
use eigenring::scheme::{Scheme, catalogue};

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

/// Loop's scheme with another sum of the weights at the vertex; the regular valence keeps its own.
fn loop_with(total: &str) -> Scheme {
    let beta = "[let]\nbeta = \"(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n\"";
    with("loop", &[(beta, &format!("[let.beta]\n\"n == 6\" = \"1/16\"\n\"n != 6\" = \"({total})/n\""))])
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
