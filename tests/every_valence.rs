//! Is C1 decided at every valence as the literature has it, and as each valence by itself says?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::Analyzer;
use eigenring::proof::c1::Proofs;
use eigenring::refine;
use eigenring::scheme::{Scheme, catalogue};
use eigenring::verdicts::{Decision, EveryValence};

fn open(id: &str) -> Scheme {
    catalogue::open(id).unwrap().unwrap()
}

fn parse(text: &str) -> Scheme {
    Scheme::parse("own", "own.toml", text).unwrap_or_else(|faults| panic!("{faults}"))
}

fn every(scheme: &Scheme) -> EveryValence {
    let sums = refine::check(scheme, &[3, 4, 5, 6, 7, 8]).unwrap();
    let analyzer = Analyzer::new(scheme).unwrap();
    EveryValence::of(&Proofs::of(&analyzer), &sums, &|_| None)
}

fn only(scheme: &Scheme, valences: &[usize]) -> EveryValence {
    let sums = refine::check(scheme, valences).unwrap();
    let analyzer = Analyzer::new(scheme).unwrap();
    EveryValence::only(&Proofs::of(&analyzer), &sums, valences)
}

/// Peters and Reif (1998) for Catmull and Clark's scheme and Doo and Sabin's; Zorin (2000) for Loop's and both butterflies; Zorin and Schroeder
/// (2001), Prautzsch and Chen (2011) for the midpoint schemes. Kobbelt's schemes (1996, 2000) and that of Velho and Zorin (2001) are said to be C1
/// from numbers at some valences.
#[test]
fn schemes_are_c1_where_the_literature_says_so() {
    let by_exact_polynomials = ["loop", "loop-warren", "catmull-clark", "doo-sabin", "catmull-clark-biquadratic"];
    let by_derivatives = ["modified-butterfly", "sqrt3", "kobbelt", "four-eight"];
    for id in by_exact_polynomials.into_iter().chain(by_derivatives) {
        let found = every(&open(id));
        assert_eq!(found.statement, "proved for every n >= 3", "{id}: {found:?}");
    }
    let butterfly = every(&open("butterfly"));
    assert_eq!(butterfly.statement, "proved for n = 4..7; refuted for n = 3 and every n >= 8", "{butterfly:?}");
    // lambda tends to 1
    let mid_edge = every(&open("mid-edge"));
    assert_eq!(mid_edge.statement, "proved for n = 4..12; undecided for n = 3 and every n >= 13", "{mid_edge:?}");
}

#[test]
fn loop_by_averaging_is_c1() {
    for passes in 1..=4 {
        let mut scheme = open("loop-averaging");
        scheme.book.set("m", &passes.to_string()).unwrap();
        let found = every(&scheme);
        assert_eq!(found.statement, "proved for every n >= 3", "{passes}: {found:?}");
    }
}

#[test]
fn midpoint_schemes_are_c1() {
    for degree in 2..=9 {
        let mut scheme = open("midpoint");
        scheme.book.set("d", &degree.to_string()).unwrap();
        let found = every(&scheme);
        assert_eq!(found.statement, "proved for every n >= 3", "{degree}: {found:?}");
    }
}

/// The conditions of a valence by itself, looked at without what is said of all at once.
#[test]
fn single_valences_agree_with_what_is_said_of_all() {
    for id in ["loop", "doo-sabin", "modified-butterfly", "butterfly", "sqrt3", "kobbelt", "four-eight"] {
        let (scheme, alone) = (open(id), [13, 20, 31]);
        let said = every(&scheme);
        for n in alone {
            let holds = |own: &&eigenring::verdicts::Stretch| own.from <= n && own.to.is_none_or(|to| n <= to);
            let of_all = said.stretches.iter().find(holds).unwrap().verdict;
            assert_eq!(only(&scheme, &[n]).stretches[0].verdict, of_all, "{id} {n}");
            assert_ne!(of_all, Decision::Undecided);
        }
    }
}

/// Beyond the valences that are exact, what is proved of all decides.
#[test]
fn large_valences_are_decided_by_what_is_known_of_all() {
    assert_eq!(only(&open("loop"), &[399, 400, 401, 4001]).statement, "proved for n = 399..401 and n = 4001");
    assert_eq!(only(&open("butterfly"), &[7, 5000]).statement, "proved for n = 7; refuted for n = 5000");
}

#[test]
fn folds_are_refuted() {
    for (text, n) in
        [(include_str!("schemes/folded-triangles.toml"), 16), (include_str!("schemes/folded-corners.toml"), 3)]
    {
        let found = only(&parse(text), &[n]);
        assert_eq!(found.statement, format!("refuted for n = {n}"), "{found:?}");
        assert!(found.stretches[0].why[0].contains("the Jacobian is"), "{found:?}");
    }
}

/// A scheme that is wrong at one valence only is proved at the others; Warren's 3/(8 n) at n = 3 is an exact tie.
#[test]
fn one_bad_valence_is_found() {
    let text = catalogue::scheme("loop-warren").unwrap().text.split("[[claims]]").next().unwrap();
    let tie = text.replace("\"n == 3\" = \"3/16\"", "").replace("\"n > 3\"", "\"n >= 3\"");
    let found = every(&parse(&tie));
    assert_eq!(found.statement, "proved for every n >= 4; refuted for n = 3", "{found:?}");
    // a weight mistyped so that the sums stay: the scheme is judged as the one it is
    let slip = text.replace("\"n > 3\"", "\"n == 9\" = \"1/900\"\n\"n > 3 and n != 9\"");
    let found = every(&parse(&slip));
    assert!(found.statement.contains("refuted for n = 9"), "{found:?}");
    assert!(found.stretches.iter().all(|own| own.verdict != Decision::Undecided), "{found:?}");
}

/// Limits of the 8-point butterfly with w = 0.13 are not C1 on regular meshes: nothing may be proved.
#[test]
fn a_scheme_that_is_not_c1_on_regular_meshes_is_never_proved() {
    let text = catalogue::scheme("butterfly").unwrap().text.split("[[claims]]").next().unwrap();
    let wide = text.replace("1/16", "13/100").replace("1/8", "26/100");
    assert_ne!(wide, text);
    let found = every(&parse(&wide));
    assert!(found.stretches.iter().all(|own| own.verdict != Decision::Proved), "{found:?}");
}

/// What cancels may have no value at one n: nothing is then said of all of them.
#[test]
fn weights_without_a_value_at_some_valence_are_not_proved_for_all() {
    let text = catalogue::scheme("loop").unwrap().text.split("[[claims]]").next().unwrap();
    let beta = "beta = \"(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n\"";
    assert!(text.contains(beta));
    let with = |factor: &str| parse(&text.replace(beta, &beta.replace(")/n\"", &format!(")/n{factor}\""))));
    for factor in [
        "*(n-13)/(n-13)",
        " + 0/(n - 50)",
        " + 0*sqrt((n-20)^2 - 1/2)",
        "*(cos(52*pi/n)-1)/(cos(52*pi/n)-1)",
        " + 1/(n-200) - 1/(n-200)",
    ] {
        let found = every(&with(factor));
        assert_eq!(found.statement, "proved for n = 3..12; undecided for every n >= 13", "{factor}: {found:?}");
    }
    for factor in ["*(n+5)/(n+5)", "*(n-2)/(n-2)", "*(2*n-19)/(2*n-19)"] {
        assert_eq!(every(&with(factor)).statement, "proved for every n >= 3", "{factor}");
    }
}

/// cos(2 pi/n) is above 1/2 for n > 6; in floating numbers 10^17 swallows it, and another weight would be taken.
#[test]
fn conditions_are_not_decided_by_floating_numbers() {
    let text = catalogue::scheme("loop").unwrap().text.split("[[claims]]").next().unwrap();
    let own = "(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n";
    let side = "(10^17 + cos(2*pi/n)) - 10^17";
    let cases = format!(
        "[let.beta]\n\"n <= 6\" = \"{own}\"\n\"n > 6 and {side} > 1/2\" = \"{own}\"\n\"n > 6 and {side} <= 1/2\" = \"1/(100*n)\""
    );
    let scheme = parse(&text.replace("[let]\n", "").replace(&format!("beta = \"{own}\""), &cases));
    let found = only(&scheme, &[3, 7, 8, 12]);
    assert!(found.stretches.iter().all(|own| own.verdict != Decision::Refuted), "{found:?}");
}
