//! Does deep refinement of real meshes agree with the masks, and does the check see a wrong one?
#![allow(clippy::unwrap_used)]

mod shared;

use eigenring::analysis::places::{Place, PlaceMasks};
use eigenring::analysis::verify::{Check, Verifier};
use eigenring::mesh::{FanKind, shapes};
use eigenring::refine::Refiner;
use eigenring::scheme::{Scheme, catalogue};
use shared::{level, open};

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
            assert!(check.agrees, "{id}: {check:?}");
            assert!(check.normal.as_ref().unwrap().bound <= 1e-9 || n == 9, "{id}: {check:?}");
            let (rates, seen) = check.rates.unwrap();
            for (a, b) in rates.lambda.iter().zip(seen.lambda) {
                assert!((a - b).abs() < 1e-6, "{id} {n}: {rates:?} {seen:?}");
            }
            // with blocks or several modes of one modulus mu is neared slowly
            assert!((rates.mu - seen.mu.unwrap()).abs() < 0.01, "{id} {n}: {rates:?} {seen:?}");
        }
    }
}

#[test]
fn masks_agree_with_deep_refinement_on_boundaries_corners_and_darts() {
    for (id, most) in [("loop", 5), ("loop-warren", 5), ("catmull-clark", 3)] {
        // at one quad and at corners of two there are Jordan blocks
        let least = if id == "catmull-clark" { 2 } else { 1 };
        let fans = (least..=most)
            .flat_map(|faces| [FanKind::Crease { faces }, FanKind::Corner { faces: faces.min(3 - least) }]);
        let darts = [3, 4, 5, 6].map(|faces| FanKind::Dart { faces });
        for kind in fans.chain(darts) {
            let check = check(id, Place::Fan(kind));
            assert!(check.agrees && check.normal.is_ok(), "{id}: {check:?}");
            assert!(check.normal.as_ref().unwrap().angle <= 1e-9, "{id}: {check:?}");
        }
    }
}

/// Jordan blocks at 1/2: tangent masks survive a step, normals come nearer like 1/m.
#[test]
fn tangents_in_a_jordan_block_survive_a_step() {
    let crease = |faces| Place::Fan(FanKind::Crease { faces });
    let corner = |faces| Place::Fan(FanKind::Corner { faces });
    for (id, place) in
        [("loop", crease(6)), ("loop", corner(3)), ("catmull-clark", crease(4)), ("catmull-clark", corner(2))]
    {
        let check = check(id, place);
        assert!(check.agrees && check.rates.unwrap().0.jordan == 2, "{id}: {check:?}");
        assert!(check.normal.unwrap().bound.is_infinite() && check.tangent < 1e-14);
    }
}

#[test]
fn where_there_is_no_tangent_plane_the_limit_point_is_checked_all_the_same() {
    for (id, faces) in [("loop", 7), ("catmull-clark", 5)] {
        let check = check(id, Place::Fan(FanKind::Crease { faces }));
        assert!(check.agrees && check.normal.unwrap_err().contains("no tangent plane"), "{id}");
    }
}

/// A weight that is off by 1e-9, in the limit mask or in a tangent mask, is seen; so is a normal that points inward.
#[test]
fn a_wrong_mask_is_seen() {
    let places = [
        Place::Inside(5),
        Place::Inside(6),
        Place::Inside(9),
        Place::Fan(FanKind::Crease { faces: 3 }),
        Place::Fan(FanKind::Dart { faces: 5 }),
    ];
    for (id, place) in ["loop", "catmull-clark"].into_iter().flat_map(|id| places.map(|place| (id, place))) {
        let (scheme, book) = open(id);
        let verifier = Verifier::new(&Refiner::new(&scheme, Some(&book)).unwrap()).unwrap();
        let masks = verifier.masks(place).unwrap();
        let sees = |masks: &PlaceMasks| !verifier.check(place, masks, 1, 3).unwrap().agrees;
        assert!(!sees(&masks), "{id} {place:?}");
        for index in 0..masks.limit.as_ref().unwrap().len() {
            let mut wrong = masks.clone();
            wrong.limit.as_mut().unwrap()[index].1 += 1e-9;
            assert!(sees(&wrong), "{id} {place:?}: limit weight {index}");
        }
        for (tangent, index) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let mut wrong = masks.clone();
            let mask = &mut wrong.tangents.as_mut().unwrap()[tangent];
            let Some(entry) = mask.get_mut(index) else { continue };
            entry.1 += 1e-9;
            assert!(sees(&wrong), "{id} {place:?}: weight {index} of tangent {tangent}");
        }
        let mut exchanged = masks.clone();
        exchanged.tangents.as_mut().unwrap().swap(0, 1);
        assert!(sees(&exchanged), "{id} {place:?}: the normal points inward");
    }
}

#[test]
fn limits_of_meshes_are_compared() {
    let (scheme, book) = open("catmull-clark");
    let verifier = Verifier::new(&Refiner::new(&scheme, Some(&book)).unwrap()).unwrap();
    for soup in [shapes::prism(5), shapes::tube(3, 5, false)] {
        let level = level(&soup);
        let levels = verifier.levels(&level, 3).unwrap();
        assert!(levels.agrees && levels.vertices == level.mesh.vertices(), "{levels:?}");
        // the net of a spline converges quadratically in the size of its faces
        let ratio = levels.gaps[2] / levels.gaps[3];
        assert!(levels.gaps.len() == 4 && (3.0..5.0).contains(&ratio), "{levels:?}");
    }
}

/// Tangents of different length: 0.5 and 0.3 at a boundary of two faces, with mu near the smaller one.
#[test]
fn tangents_of_very_different_length_are_told_apart() {
    let text = "name = \"Mine\"\nmesh = \"triangles\"\nsplit = \"1-to-4\"\n[vertex]\ncentre = \"1 - n/16\"\nring = \"1/16\"\n\
        [edge]\nends = \"3/10\"\nopposite = \"1/5\"\n";
    let scheme = Scheme::parse("mine", "mine.toml", text).unwrap();
    let book = catalogue::boundary("cubic", "triangles").unwrap().unwrap();
    let verifier = Verifier::new(&Refiner::new(&scheme, Some(&book)).unwrap()).unwrap();
    let place = Place::Fan(FanKind::Crease { faces: 2 });
    let masks = verifier.masks(place).unwrap();
    for seed in 1..=6 {
        let check = verifier.check(place, &masks, 1, seed).unwrap();
        assert!(check.agrees && check.normal.as_ref().unwrap().is_seen(), "{check:?}");
    }
}
