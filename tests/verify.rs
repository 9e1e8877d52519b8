//! Does deep refinement of real meshes agree with the masks, and does the check see a wrong one?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::places::Place;
use eigenring::analysis::verify::{Check, Verifier};
use eigenring::mesh::FanKind;
use eigenring::refine::Refiner;
use eigenring::scheme::{RuleBook, Scheme, catalogue};

fn open(id: &str) -> (Scheme, RuleBook) {
    let scheme = catalogue::open(id).unwrap().unwrap();
    let book = catalogue::boundary("cubic", &scheme.mesh).unwrap().unwrap();
    (scheme, book)
}

fn check(id: &str, place: Place) -> Check {
    let (scheme, book) = open(id);
    let verifier = Verifier::new(&Refiner::new(&scheme, Some(&book)).unwrap()).unwrap();
    let masks = verifier.masks(place).unwrap();
    verifier.check(place, &masks, 2, 7).unwrap()
}

#[test]
fn masks_agree_with_deep_refinement_inside() {
    for id in ["loop", "loop-warren", "catmull-clark", "doo-sabin", "catmull-clark-biquadratic", "modified-butterfly"] {
        for n in [3, 4, 5, 6, 7, 9] {
            let check = check(id, Place::Inside(n));
            eprintln!("{id} {n} {check:?}");
            assert!(check.agrees, "{id}: {check:?}");
            assert!(check.normal.as_ref().unwrap().bound <= 1e-9 || n == 9, "{id}: {check:?}");
            let (rates, seen) = check.rates.unwrap();
            for (a, b) in rates.lambda.iter().zip(seen.lambda) {
                assert!((a - b).abs() < 1e-6, "{id} {n}: {rates:?} {seen:?}");
            }
        }
    }
}

#[test]
fn masks_agree_with_deep_refinement_on_boundaries_corners_and_darts() {
    for (id, most) in [("loop", 5), ("loop-warren", 5), ("catmull-clark", 3)] {
        let fans = (1..=most).flat_map(|faces| [FanKind::Crease { faces }, FanKind::Corner { faces: faces.min(2) }]);
        let darts = [3, 4, 5, 6].map(|faces| FanKind::Dart { faces });
        for kind in fans.chain(darts) {
            let check = check(id, Place::Fan(kind));
            eprintln!("{id} {kind:?} {check:?}");
            assert!(check.agrees && check.normal.is_ok(), "{id}: {check:?}");
        }
    }
}
