//! Are characteristic maps proved regular and injective for every valence, and is nothing wrong accepted?
#![allow(clippy::unwrap_used)]

use dashu_ratio::RBig;
use eigenring::analysis::Analyzer;
use eigenring::analysis::exact::formulas::GENERIC;
use eigenring::mesh::{Label, Lattice, Patch};
use eigenring::numbers::Field;
use eigenring::proof::course::range;
use eigenring::proof::jacobian::Pieces;
use eigenring::proof::map::{prove, verify};
use eigenring::proof::net::{Function, Net};
use eigenring::proof::outcome::Outcome;
use eigenring::proof::ring::least_radius;
use eigenring::scheme::{Scheme, catalogue};
use std::f64::consts::TAU;

const POLYNOMIAL: [&str; 5] = ["loop", "loop-warren", "catmull-clark", "doo-sabin", "catmull-clark-biquadratic"];

fn open(id: &str) -> Scheme {
    catalogue::open(id).unwrap().unwrap()
}

fn value(function: &Function, p: f64) -> f64 {
    let at = |own: &eigenring::numbers::Univariate<RBig>| {
        own.coefficients().iter().rev().fold(0.0, |sum, own| sum * p + own.to_f64().value())
    };
    at(function.numerator()) / at(function.denominator())
}

#[test]
fn maps_of_polynomial_schemes_are_proved() {
    for id in POLYNOMIAL {
        let scheme = open(id);
        let outcome = prove(&Analyzer::new(&scheme).unwrap());
        assert!(matches!(outcome, Outcome::Proved(_)), "{id}: {outcome:?}");
    }
}

#[test]
fn schemes_of_other_kinds_are_undecided() {
    for id in ["butterfly", "modified-butterfly", "sqrt3", "kobbelt"] {
        let scheme = open(id);
        assert!(matches!(prove(&Analyzer::new(&scheme).unwrap()), Outcome::Undecided { .. }), "{id}");
    }
}

/// At (1, 0) the modified butterfly has a rule of its own; Catmull and Clark's scheme has none but at the centre.
#[test]
fn rules_that_reach_into_the_ring_are_seen() {
    for (id, regular) in [("modified-butterfly", false), ("catmull-clark", true)] {
        let scheme = open(id);
        let analyzer = Analyzer::new(&scheme).unwrap();
        let (lattice, forms) = (analyzer.lattice(), analyzer.forms().unwrap());
        let net = Net::of(&scheme, lattice, forms, range(forms).unwrap().unwrap().course).unwrap();
        let pieces = if lattice == Lattice::Triangles { Pieces::Quartic } else { Pieces::Tensor(3) };
        let row = |label: Label| net.row(label).ok();
        let radius = least_radius(pieces, Patch::new(lattice, GENERIC), analyzer.clear_of_centre(), &row);
        assert_eq!(radius.unwrap() == 1, regular, "{id}");
    }
}

/// The net of all n, at one n, against the characteristic map that the analysis finds there in floating numbers by eigenvectors.
#[test]
fn the_nets_are_those_of_the_analysis() {
    for id in POLYNOMIAL {
        let scheme = open(id);
        let analyzer = Analyzer::new(&scheme).unwrap();
        let forms = analyzer.forms().unwrap();
        let course = range(forms).unwrap().unwrap().course;
        let net = Net::of(&scheme, analyzer.lattice(), forms, course.clone()).unwrap();
        for n in forms.from.max(3)..=12 {
            let analysis = analyzer.at(n).unwrap();
            let lambda = analysis.lambda.unwrap().value.re;
            let c = (TAU / n as f64).cos();
            // the parameter is c where c is the identity, lambda otherwise
            let p = if course.c == Function::variable() { c } else { lambda };
            assert!((value(&course.c, p) - c).abs() < 1e-11 && (value(&course.lambda, p) - lambda).abs() < 1e-11);
            let report = analysis.map.unwrap();
            let point = |orbit| {
                let (a, b) = &net.values()[orbit];
                let (a, b) = (value(a, p), value(b, p));
                [a + b * c, b * (TAU / n as f64).sin()]
            };
            let first = analysis.local.orbits.iter().position(|orbit| point(orbit)[0].abs() > 1e-9).unwrap();
            let scale = report.net[first].re / point(&analysis.local.orbits[first])[0];
            for (orbit, seen) in analysis.local.orbits.iter().zip(&report.net) {
                let [x, y] = point(orbit);
                assert!((x * scale - seen.re).abs() < 1e-9 && (y * scale - seen.im).abs() < 1e-9, "{id} {n} {orbit:?}");
            }
        }
    }
}

#[test]
fn a_wrong_value_is_not_accepted() {
    for id in POLYNOMIAL {
        let scheme = open(id);
        let analyzer = Analyzer::new(&scheme).unwrap();
        let forms = analyzer.forms().unwrap();
        let range = range(forms).unwrap().unwrap();
        let spline = analyzer.regular().unwrap().spline.as_ref().unwrap();
        let pieces = Pieces::of(spline, analyzer.lattice()).unwrap();
        let net = || Net::of(&scheme, analyzer.lattice(), forms, range.course.clone()).unwrap();
        let orbits: Vec<(i32, i32)> = net().values().keys().copied().collect();
        for orbit in orbits {
            let mut wrong = net();
            let (a, b) = wrong.values()[&orbit].clone();
            let slip = Function::rational(&(RBig::ONE / RBig::from(1_000_000)));
            wrong.replace(orbit, (a.plus(&slip).unwrap(), b));
            assert!(verify(&mut wrong, pieces, analyzer.lattice(), &range).unwrap().is_err(), "{id} {orbit:?}");
        }
    }
}
