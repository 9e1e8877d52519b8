//! Does every claim of every scheme file agree with the analysis?
#![allow(clippy::unwrap_used)]

use eigenring::report::Study;
use eigenring::scheme::Scheme;
use eigenring::scheme::catalogue;
use eigenring::verdicts::{Decision, Outcome};

#[test]
fn the_claims_of_the_catalogue_agree() {
    let valences: Vec<usize> = (3..=12).collect();
    for listed in catalogue::SCHEMES {
        let scheme = catalogue::open(listed.id).unwrap().unwrap();
        let study = Study::of(&scheme, &valences, false, &|| ()).unwrap();
        assert_eq!(study.report.claims.len(), scheme.claims.len());
        for claim in &study.report.claims {
            assert_eq!(claim.outcome, Outcome::Agrees, "{}: {claim:?}", scheme.id);
        }
    }
}

#[test]
fn a_false_claim_is_seen() {
    let text = catalogue::scheme("loop").unwrap().text.replace("equals = \"3/8 + cos(2*pi/n)/4\"", "equals = \"1/2\"");
    let scheme = Scheme::parse("loop", "loop.toml", &text).unwrap();
    let study = Study::of(&scheme, &[3, 4, 5], false, &|| ()).unwrap();
    let outcome = |what: &str| study.report.claims.iter().find(|claim| claim.what == what).unwrap().outcome;
    assert_eq!((outcome("subdominant"), outcome("cup")), (Outcome::Disagrees, Outcome::Agrees));
}

/// Conditions on eigenvalues are decided, and those on the map where it is proved.
#[test]
fn conditions_are_decided_where_they_are_proved() {
    let scheme = catalogue::open("loop").unwrap().unwrap();
    let study = Study::of(&scheme, &[3, 5, 6], false, &|| ()).unwrap();
    for verdict in study.report.valences.iter().flat_map(|valence| &valence.verdicts) {
        assert_eq!(verdict.verdict == Decision::Undecided, verdict.value == "none", "{verdict:?}");
        assert!(!verdict.why.is_empty() && !verdict.source.is_empty());
    }
}

/// Where the exact world has no values (n is too large), conditions on eigenvalues stay undecided; C1 is decided by what is proved of all n.
#[test]
fn approximate_values_decide_nothing() {
    let scheme = catalogue::open("catmull-clark").unwrap().unwrap();
    let study = Study::of(&scheme, &[4001], false, &|| ()).unwrap();
    let valence = &study.report.valences[0];
    assert_eq!(valence.arithmetic, "approximate");
    assert!(valence.why_not_exact.as_ref().unwrap().contains("degree"));
    assert!(valence.eigenvalues.iter().all(|e| e.quantity.exact.is_none() && e.quantity.decimal.is_none()));
    for verdict in &valence.verdicts {
        let proved = ["affine invariance", "regular part", "C1"].contains(&verdict.claim.as_str());
        assert_eq!(verdict.verdict, if proved { Decision::Proved } else { Decision::Undecided }, "{}", verdict.claim);
    }
    let own = |study: &Study| study.report.valences[0].verdicts.iter().find(|own| own.claim == "C1").unwrap().clone();
    assert!(own(&study).why[0].contains("every n >= 4"));
    // a scheme that nothing is known of for all n
    let mid_edge = catalogue::open("mid-edge").unwrap().unwrap();
    assert_eq!(own(&Study::of(&mid_edge, &[4001], false, &|| ()).unwrap()).verdict, Decision::Undecided);
}

/// 3/(8n) at n = 3 ties lambda with the eigenvalue of frequency 0: floating numbers can't see it, exact ones refute the condition.
#[test]
fn a_tie_is_refuted_exactly() {
    let text =
        catalogue::scheme("loop-warren").unwrap().text.replace("[let.beta]", "[let]\nbeta = \"3/(8*n)\"\n[unused]");
    let start = text.find("[unused]").unwrap();
    let end = text.find("[vertex]").unwrap();
    let text = format!("{}{}", &text[..start], &text[end..]);
    let scheme = Scheme::parse("tie", "tie.toml", &text).unwrap_or_else(|faults| panic!("{faults}"));
    let study = Study::of(&scheme, &[3, 4], false, &|| ()).unwrap();
    let evidence = |index: usize| {
        let verdicts = &study.report.valences[index].verdicts;
        verdicts.iter().find(|verdict| verdict.claim == "C1").unwrap().evidence
    };
    assert_eq!(evidence(0), eigenring::verdicts::Evidence::Against);
    let subdominant = study.report.valences[0].verdicts.iter().find(|verdict| verdict.claim == "subdominant").unwrap();
    assert_eq!(subdominant.verdict, Decision::Refuted);
    assert!(subdominant.why[0].starts_with("a tie"), "{:?}", subdominant.why);
    let curvature = study.report.valences[0].verdicts.iter().find(|verdict| verdict.claim == "curvature").unwrap();
    assert_eq!(curvature.evidence, eigenring::verdicts::Evidence::None);
    assert_eq!(evidence(1), eigenring::verdicts::Evidence::For);
}

/// The 8-point butterfly with w = 0.13: its derivatives grow without bound on regular meshes already. No irregular valence may then be
/// said to look C1.
#[test]
fn a_scheme_that_fails_on_regular_meshes_fails_everywhere() {
    let text = r#"
name  = "Butterfly with a large tension"
mesh  = "triangles"
split = "1-to-4"

[parameters]
w8 = "0.13"

[vertex]
centre = "1"

[edge]
ends     = "1/2"
opposite = "2*w8"
wings    = "-w8"
"#;
    let scheme = Scheme::parse("butterfly", "butterfly.toml", text).unwrap_or_else(|faults| panic!("{faults}"));
    let study = Study::of(&scheme, &[4, 6, 7], false, &|| ()).unwrap();
    for valence in &study.report.valences {
        for claim in ["regular part", "C1"] {
            let verdict = valence.verdicts.iter().find(|verdict| verdict.claim == claim).unwrap();
            assert_ne!(verdict.evidence, eigenring::verdicts::Evidence::For, "{claim} at n = {}", valence.n);
        }
    }
}
