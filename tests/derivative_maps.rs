//! Are characteristic maps of schemes whose limits are no polynomials proved regular and injective, and folds refuted?
#![allow(clippy::unwrap_used)]

use dashu_ratio::RBig;
use eigenring::analysis::Analyzer;
use eigenring::analysis::exact::Value;
use eigenring::mesh::Lattice;
use eigenring::numbers::Field;
use eigenring::proof::course::range;
use eigenring::proof::derivative::cells::{Cell, Local, Tiling};
use eigenring::proof::derivative::{DerivativeProof, Engine, prove, prove_at};
use eigenring::proof::family::CosineBox;
use eigenring::proof::net::{Function, Net as NetOfAll};
use eigenring::proof::outcome::{Outcome, Valences};
use eigenring::scheme::{Scheme, catalogue};
use std::collections::BTreeSet;

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
    let singles: Vec<usize> = proofs[0].boxes.iter().filter_map(|own| own.only).collect();
    assert_eq!(singles, [3, 4, 6]);
    covers(&proofs[0], 5);
}

/// The boxes of c hold that of every n from one on that has none of its own.
fn covers(proof: &DerivativeProof, from: usize) {
    let cosines = (from..200).map(|n| (std::f64::consts::TAU / n as f64).cos()).chain([1.0]);
    for c in cosines {
        let holds = |own: &CosineBox| own.only.is_none() && own.c.lo() <= c && c <= own.c.hi();
        assert!(proof.boxes.iter().any(holds), "{c}");
    }
}

/// What Bezier points prove as well.
#[test]
fn polynomial_schemes_by_enclosed_derivatives() {
    for id in ["loop", "loop-warren", "catmull-clark", "doo-sabin", "catmull-clark-biquadratic", "midpoint"] {
        let scheme = open(id);
        proved(&scheme, &[3, 5, 6, 30].map(Valences::At));
        covers(&proved(&scheme, &[Valences::From(3)])[0], 4);
    }
}

/// Kobbelt's schemes, on triangles in two steps with dilation 3 and on quads, and 4-8 subdivision, in two steps with dilation 2.
#[test]
fn schemes_of_other_lattices_and_limits() {
    for id in ["sqrt3", "kobbelt", "four-eight"] {
        let scheme = open(id);
        proved(&scheme, &[3, 4, 5, 6, 7, 12].map(Valences::At));
        covers(&proved(&scheme, &[Valences::From(3)])[0], 5);
    }
}

/// The eigenvalue of the simplest scheme tends to 1: there is no map at the end of the range of c. At n = 3 it is not simple.
#[test]
fn mid_edge_valence_by_valence() {
    let scheme = open("mid-edge");
    proved(&scheme, &[4, 5, 6, 12].map(Valences::At));
    let analyzer = Analyzer::new(&scheme).unwrap();
    for valences in [Valences::At(3), Valences::From(4)] {
        assert!(matches!(prove(&analyzer, valences), Outcome::Undecided { .. }), "{valences}");
    }
}

/// The rules of Zorin, Schroeder and Sweldens with another first wave: the ring's sum of frequency 1 is 4/5.
const FOLDED: &str = include_str!("schemes/folded-triangles.toml");

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

/// The butterfly's weights reproduce cubic polynomials, on quads so do Kobbelt's: data of one on a cell's points are refined to its values on
/// the parts' points.
#[test]
fn rows_of_cells_reproduce_cubics() {
    for id in ["butterfly", "kobbelt"] {
        let scheme = open(id);
        let analyzer = Analyzer::new(&scheme).unwrap();
        let engine = Engine::of(&analyzer).unwrap().unwrap();
        let local: &Local = engine.local();
        let cubic = |[x, y]: [RBig; 2]| {
            let whole = |value: i32| RBig::from(value);
            whole(1) + &x * whole(2) - &y + &x * &x - &x * &y * whole(3) + &x * &x * &x - &x * &y * &y * whole(2)
        };
        assert_eq!(local.parts.len(), 4);
        for part in &local.parts {
            for (q, row) in local.points.iter().zip(&part.rows) {
                let value = |old: usize| cubic(local.points[old].map(RBig::from));
                let sum = row.iter().fold(RBig::ZERO, |sum, (old, weight)| sum + weight * value(*old));
                assert_eq!(sum, cubic(local.tiling.position(part.cell.point(*q))), "{id} {q:?}");
            }
        }
    }
}

/// The parts of cells fill them, and those of a ring the next one.
#[test]
fn parts_of_a_ring_are_the_next_one() {
    for (lattice, dilation) in
        [(Lattice::Triangles, 2), (Lattice::Triangles, 3), (Lattice::Quads, 2), (Lattice::Dual, 2), (Lattice::Quads, 3)]
    {
        let tiling = Tiling { lattice, dilation };
        assert_eq!(tiling.parts().len() as i32, dilation * dilation);
        let half = |cell: &Cell| {
            // told by the corner sum, both halves of the sector are mirror images
            let [x, y] = cell.origin;
            Cell { origin: [x.max(y), x.min(y)], ..*cell }
        };
        let parts = tiling.ring(4).into_iter().flat_map(|cell| {
            let part = move |part: Cell| Cell {
                origin: [0, 1].map(|axis| dilation * cell.origin[axis] + cell.sign * part.origin[axis]),
                sign: cell.sign * part.sign,
            };
            tiling.parts().into_iter().map(part).collect::<Vec<_>>()
        });
        let finer: BTreeSet<Cell> = parts.map(|cell| half(&cell)).collect();
        let next: BTreeSet<Cell> = tiling.ring(4 * dilation).into_iter().collect();
        assert_eq!(finer, next, "{tiling:?}");
    }
}
