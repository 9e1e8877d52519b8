//! Are characteristic maps of schemes whose limits are no polynomials proved regular and injective, and folds refuted?
#![allow(clippy::unwrap_used)]

use dashu_ratio::RBig;
use eigenring::analysis::Analyzer;
use eigenring::analysis::exact::Value;
use eigenring::numbers::Field;
use eigenring::proof::course::range;
use eigenring::proof::derivative::cells::{Cell, Local};
use eigenring::proof::derivative::{DerivativeProof, Engine, prove, prove_at};
use eigenring::proof::net::{Function, Net as NetOfAll};
use eigenring::proof::outcome::{Outcome, Valences};
use eigenring::scheme::{Scheme, catalogue};

fn open(id: &str) -> Scheme {
    catalogue::open(id).unwrap().unwrap()
}

fn proved(scheme: &Scheme, valences: &[Valences]) -> Vec<DerivativeProof> {
    let analyzer = Analyzer::new(scheme).unwrap();
    let one = |valences: &Valences| match prove(&analyzer, *valences) {
        Outcome::Proved(proof) => {
            assert_eq!(proof.valences, *valences);
            proof
        }
        other => panic!("{valences}: {other:?}"),
    };
    valences.iter().map(one).collect()
}

/// Zorin (2000): the characteristic maps of the butterfly scheme are regular and injective for n = 4..7.
#[test]
fn butterfly_from_4_to_7() {
    proved(&open("butterfly"), &[4, 5, 6, 7].map(Valences::At));
}

/// The eigenvalue of the map isn't subdominant there (Zorin 2000), or has a Jordan block (n = 3).
#[test]
fn butterfly_elsewhere_has_no_map() {
    let scheme = open("butterfly");
    let analyzer = Analyzer::new(&scheme).unwrap();
    for n in [3, 8, 9, 16] {
        assert!(matches!(prove(&analyzer, Valences::At(n)), Outcome::Undecided { .. }), "{n}");
    }
}

/// Zorin (2000): the modified butterfly scheme is C1 at every valence.
#[test]
fn modified_butterfly_valence_by_valence() {
    let valences: Vec<Valences> = (3..=8).chain([30]).map(Valences::At).collect();
    proved(&open("modified-butterfly"), &valences);
}

#[test]
fn modified_butterfly_at_every_valence() {
    let proofs = proved(&open("modified-butterfly"), &[Valences::From(3)]);
    // lists of weights, and the regular valence
    assert_eq!(proofs[0].singles, [3, 4, 6]);
}

/// What Bezier points prove as well.
#[test]
fn loop_by_enclosed_derivatives() {
    let scheme = open("loop");
    proved(&scheme, &[3, 6, 30].map(Valences::At));
    proved(&scheme, &[Valences::From(3)]);
}

#[test]
fn other_schemes_are_undecided() {
    for id in ["catmull-clark", "sqrt3", "kobbelt"] {
        let scheme = open(id);
        let analyzer = Analyzer::new(&scheme).unwrap();
        assert!(matches!(prove(&analyzer, Valences::At(5)), Outcome::Undecided { .. }), "{id}");
    }
}

/// The rules of Zorin, Schroeder and Sweldens with another first wave: the ring's sum of frequency 1 is 4/5.
const FOLDED: &str = r#"
name   = "Folded"
mesh   = "triangles"
split  = "1-to-4"
[vertex]
centre = "1"
[edge]
ends     = "1/2"
opposite = "1/8"
wings    = "-1/16"
[edge.from-irregular-end]
centre = "3/4"
[edge.from-irregular-end.ring]
"n >= 3" = "(1/4 + (8/5)*cos(2*pi*j/n) + cos(4*pi*j/n)/2)/n"
"#;

#[test]
fn a_fold_is_refuted() {
    let scheme = Scheme::parse("own", "own.toml", FOLDED).unwrap();
    let analyzer = Analyzer::new(&scheme).unwrap();
    assert!(matches!(prove(&analyzer, Valences::At(16)), Outcome::Refuted { .. }));
    assert!(matches!(prove(&analyzer, Valences::From(5)), Outcome::Refuted { .. }));
}

/// The Jacobian of the folded scheme at n = 16 by finite differences of the net 64 times as fine: it changes sign.
/// That of the modified butterfly doesn't.
#[test]
fn differences_of_finer_nets_see_the_fold() {
    for (scheme, folded) in
        [(Scheme::parse("own", "own.toml", FOLDED).unwrap(), true), (open("modified-butterfly"), false)]
    {
        let analyzer = Analyzer::new(&scheme).unwrap();
        let analysis = analyzer.at(16).unwrap().exact.unwrap();
        let engine = Engine::of(&analyzer).unwrap().unwrap();
        let mut net = engine.net(16, &analysis).unwrap().unwrap();
        let mut signs = [false, false];
        for (i, j) in (0..32).flat_map(|i| (0..=i).map(move |j| (i, j))).filter(|(i, j)| (16..32).contains(&(i + j))) {
            let mut at = |i, j| net.at(i, j).map(|(a, b)| [a.midpoint_f64(), b.midpoint_f64()]).unwrap();
            let (o, u, v) = (at(i, j), at(i + 1, j), at(i, j + 1));
            let determinant = (u[0] - o[0]) * (v[1] - o[1]) - (u[1] - o[1]) * (v[0] - o[0]);
            signs[usize::from(determinant > 0.0)] = true;
        }
        assert_eq!(signs, [folded, true]);
    }
}

#[test]
fn a_tampered_net_is_not_accepted() {
    for (id, n) in [("butterfly", 5), ("modified-butterfly", 7)] {
        let scheme = open(id);
        let analyzer = Analyzer::new(&scheme).unwrap();
        let analysis = analyzer.at(n).unwrap().exact.unwrap();
        let engine = Engine::of(&analyzer).unwrap().unwrap();
        let net = || engine.net(n, &analysis).unwrap().unwrap();
        assert!(matches!(engine.verify(n, &mut net()).unwrap(), Outcome::Proved(_)));
        assert!(matches!(prove_at(&analyzer, n, &analysis), Outcome::Proved(_)));
        let orbits: Vec<(i32, i32)> = net().values().keys().copied().collect();
        for orbit in orbits {
            let mut wrong = net();
            let (a, b) = wrong.values()[&orbit].clone();
            let slip = Value::rational(&(RBig::ONE / RBig::from(1_000_000)));
            wrong.replace(orbit, (a.plus(&slip).unwrap(), b));
            assert!(matches!(engine.verify(n, &mut wrong).unwrap(), Outcome::Undecided { .. }), "{id} {orbit:?}");
        }
    }
}

/// The net at one valence by elimination in enclosures, against the one of all valences, which is rational in c, there.
#[test]
fn two_ways_to_the_net_agree() {
    let scheme = open("modified-butterfly");
    let analyzer = Analyzer::new(&scheme).unwrap();
    let engine = Engine::of(&analyzer).unwrap().unwrap();
    let forms = analyzer.forms().unwrap();
    let mut all = NetOfAll::of(&scheme, analyzer.lattice(), forms, range(forms).unwrap().unwrap().course).unwrap();
    for n in [5, 7, 12] {
        let analysis = analyzer.at(n).unwrap().exact.unwrap();
        let mut net = engine.net(n, &analysis).unwrap().unwrap();
        let c = net.c.clone();
        let value = |function: &Function| {
            let at = |own: &eigenring::numbers::Univariate<RBig>| {
                own.mapped(|x| Ok(Value::rational(x))).unwrap().evaluate(&c).unwrap()
            };
            at(function.numerator()).over(&at(function.denominator())).unwrap()
        };
        let (start, scale) = (all.at(1, 0).unwrap(), net.at(1, 0).unwrap());
        let scale = scale.0.over(&value(&start.0)).unwrap();
        for (i, j) in [(1, 1), (2, 1), (4, 0), (3, 5), (7, -2), (-1, 6), (9, 4)] {
            let ((a, b), (u, v)) = (all.at(i, j).unwrap(), net.at(i, j).unwrap());
            let close = |x: &Value, y: &Function| {
                let difference = x.minus(&value(y).times(&scale).unwrap()).unwrap();
                difference.contains(&RBig::ZERO) && difference.width() < RBig::ONE / RBig::from(10).pow(80)
            };
            assert!(close(&u, &a) && close(&v, &b), "{n} ({i}, {j})");
        }
    }
}

/// The butterfly's weights reproduce cubic polynomials: data of one on a cell's points are refined to its values on
/// the parts' points.
#[test]
fn rows_of_cells_reproduce_cubics() {
    let scheme = open("butterfly");
    let analyzer = Analyzer::new(&scheme).unwrap();
    let engine = Engine::of(&analyzer).unwrap().unwrap();
    let local: &Local = engine.local();
    let cubic =
        |x: f64, y: f64| 1.0 + 2.0 * x - y + x * x - 3.0 * x * y + x * x * x - 2.0 * x * y * y + 0.5 * y * y * y;
    for (part, rows) in Cell::PARTS.iter().zip(&local.parts) {
        for (q, row) in local.points.iter().zip(rows) {
            let [x, y] = part.point(*q);
            let sum: f64 = row
                .iter()
                .map(|(old, weight)| {
                    let [x, y] = local.points[*old];
                    weight.middle() * cubic(f64::from(x), f64::from(y))
                })
                .sum();
            assert!((sum - cubic(0.5 * f64::from(x), 0.5 * f64::from(y))).abs() < 1e-10, "{part:?} {q:?}");
        }
    }
}
