//! What does flatness do to eigenvalues at a boundary, and to meshes?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::boundary::flatness;
use eigenring::analysis::boundary::{BoundaryAnalysis, BoundaryAnalyzer};
use eigenring::analysis::limit::Limits;
use eigenring::analysis::places::Place;
use eigenring::analysis::verify::Verifier;
use eigenring::mesh::{Connectivity, Crease, FanKind, HalfEdgeMesh, PolygonSoup, Tags, shapes};
use eigenring::refine::{Level, Refiner, Route, fan_kinds, most_ulps};
use eigenring::scheme::{RuleBook, Scheme, catalogue};
use eigenring::verdicts::{Decision, Evidence, Outcome, c1_up_to_boundary, check_boundary_claims};
use nalgebra::DVector;
use std::f64::consts::PI;

const BLZ: &str = "biermann-levin-zorin-2000";
const FLAT: &str = "biermann-levin-zorin-2000-flat";

fn open(id: &str, rules: &str, settings: &[(&str, &str)]) -> (Scheme, RuleBook) {
    let scheme = catalogue::open(id).unwrap().unwrap();
    let mut book = catalogue::boundary(rules, &scheme.mesh).unwrap().unwrap();
    settings.iter().for_each(|(name, value)| book.set(name, value).unwrap());
    (scheme, book)
}

/// The cubic rules with a flatness at a kind of vertex.
fn cubic(id: &str, kind: &str, s: &str) -> (Scheme, RuleBook) {
    let scheme = catalogue::open(id).unwrap().unwrap();
    let text = format!("name = \"Flat\"\nlike = \"cubic\"\n[flatness]\n{kind} = \"{s}\"\n");
    let book = RuleBook::parse_boundary("flat.toml", &text, &scheme.mesh).unwrap();
    (scheme, book)
}

fn at(scheme: &Scheme, book: &RuleBook, kind: FanKind) -> BoundaryAnalysis {
    BoundaryAnalyzer::new(scheme, book).unwrap().at(kind).unwrap()
}

/// Real parts of the eigenvalues, the largest first.
fn values(analysis: &BoundaryAnalysis) -> Vec<f64> {
    let mut values: Vec<f64> = analysis.spectrum.eigenvalues.iter().map(|e| e.value.re).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

fn has(values: &[f64], wanted: f64) -> bool {
    values.iter().any(|value| (value - wanted).abs() < 1e-10)
}

fn level(soup: &PolygonSoup) -> Level<f64> {
    let mesh = HalfEdgeMesh::new(soup.positions.len(), soup.faces.clone()).unwrap();
    let tags = Tags::new(&mesh, &soup.creases, &soup.corners).unwrap();
    Level { mesh, positions: soup.positions.clone(), tags }
}

/// Moves the points a little: no symmetry may hide a mistake.
fn shaken(mut soup: PolygonSoup) -> PolygonSoup {
    let mut state = 5_u64;
    for x in soup.positions.iter_mut().flatten() {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *x += 0.4 * ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5);
    }
    soup
}

fn refiner<'a>(scheme: &'a Scheme, book: &'a RuleBook, levels: &[&Level<f64>], more: &[FanKind]) -> Refiner<'a> {
    let kinds = levels.iter().flat_map(|level| fan_kinds(&level.mesh, &level.tags)).chain(more.iter().copied());
    let flatness = flatness::of(scheme, book, kinds).unwrap();
    Refiner::new(scheme, Some(book)).unwrap().with_flatness(flatness)
}

/// The kinds at the rims of the discs that masks are verified on.
fn rim() -> Vec<FanKind> {
    (1..6).flat_map(|faces| [FanKind::Crease { faces }, FanKind::Corner { faces }]).collect()
}

/// A fan of k faces, its centre a concave corner of angle 3 pi/2, within a ring of faces; shaken.
fn concave(k: usize, triangles: bool) -> PolygonSoup {
    let mut soup = shapes::fan(k, triangles);
    soup.corners = vec![0];
    shaken(soup)
}

/// Biermann, Levin and Zorin 2000: at a concave corner sine mode 1 is above the 1/2 of the two edges, and there is no tangent plane. With flatness
/// the vectors of 1 and 1/2 keep their values, and all that the faces' points have otherwise is multiplied by 1 - s.
#[test]
fn a_concave_corner_gets_its_tangent_plane() {
    for (id, alpha) in [("loop", "3*pi/2"), ("loop", "2*pi - 1/4"), ("catmull-clark", "3*pi/2")] {
        let (scheme, plain) = open(id, BLZ, &[("alpha", alpha)]);
        let (_, flat) = open(id, FLAT, &[("alpha", alpha)]);
        let (_, none) = open(id, FLAT, &[("alpha", alpha), ("s", "0")]);
        for faces in [2, 3, 4, 6, 9] {
            let kind = FanKind::Corner { faces };
            let (before, after) = (at(&scheme, &plain, kind), at(&scheme, &flat, kind));
            assert!(
                before.tangent_masks.as_ref().unwrap_err().starts_with("no tangent plane: the mode"),
                "{id} {faces}"
            );
            assert_eq!(c1_up_to_boundary(&before, None).evidence, Evidence::Against);
            let tangents = after.tangent_masks.as_ref().unwrap_or_else(|why| panic!("{id} {faces}: {why}"));
            assert!(tangents.eigenvalues.iter().all(|e| (e.value.re - 0.5).abs() < 1e-12));
            let verdict = c1_up_to_boundary(&after, None);
            assert_eq!((verdict.verdict, verdict.evidence), (Decision::Undecided, Evidence::For));
            // S v = v/2 for the vectors of the net, with the moves and without
            for matrix in [before.local.dense(), after.local.dense()] {
                for axis in 0..2 {
                    let v = DVector::from_iterator(matrix.nrows(), tangents.net.iter().map(|point| point[axis]));
                    assert!((&matrix * &v - v.scale(0.5)).amax() < 1e-12 * v.amax(), "{id} {faces} {axis}");
                }
            }
            // the corner stays
            assert_eq!(after.limit_mask.as_ref().unwrap().len(), 1);
            assert_eq!(at(&scheme, &none, kind).local.dense(), before.local.dense());
            let claims = check_boundary_claims(&flat, &after, &verdict).unwrap();
            let outcomes: Vec<Outcome> = claims.iter().map(|claim| claim.outcome).collect();
            assert_eq!(outcomes, [Outcome::Agrees, Outcome::Agrees, Outcome::Undecided], "{id} {faces} {claims:?}");
            assert!(check_boundary_claims(&none, &before, &verdict).unwrap().is_empty());
        }
    }
    // the sine modes of Loop's edges: 1/2 - cos(alpha/k)/4 + cos(m pi/k)/4, and half of it
    let (scheme, flat) = open("loop", FLAT, &[("alpha", "3*pi/2")]);
    let (_, plain) = open("loop", BLZ, &[("alpha", "3*pi/2")]);
    for faces in [3, 5, 8] {
        let [before, after] = [&plain, &flat].map(|book| values(&at(&scheme, book, FanKind::Corner { faces })));
        for mode in 1..faces {
            let [theta, wave] = [1.5 * PI / faces as f64, mode as f64 * PI / faces as f64];
            let value = 0.5 - theta.cos() / 4.0 + wave.cos() / 4.0;
            assert!(has(&before, value) && has(&after, value / 2.0), "{faces} {mode}");
        }
    }
}

/// At the boundary of Loop's scheme with plain rules two sine modes are above the boundary's own 1/2 from k = 7 on: 3/8 + cos(m pi/k)/4. The second one
/// is damped, but that is not enough: the vector of the boundary's 1/2 is sin((j - k/2) pi/3) on spoke j, since 3/8 + cos(pi/3)/4 = 1/2, and turns back
/// for k >= 4. The plane net folds, and no tangent plane is claimed.
#[test]
fn a_crease_with_many_faces_needs_more_than_flatness() {
    let (scheme, plain) = open("loop", "cubic", &[]);
    let (_, flat) = cubic("loop", "crease", "1/4");
    for faces in [7, 8, 11] {
        let kind = FanKind::Crease { faces };
        let (before, after) = (at(&scheme, &plain, kind), at(&scheme, &flat, kind));
        assert!(before.tangent_masks.as_ref().unwrap_err().contains("not below the boundary's own 0.5"), "{faces}");
        let mode = |m: usize| 3.0 / 8.0 + (m as f64 * PI / faces as f64).cos() / 4.0;
        assert!(after.tangent_masks.as_ref().unwrap_err().contains("folds at the vertex"), "{faces}");
        let largest: Vec<f64> = values(&after).into_iter().take(3).collect();
        assert!((largest[1] - mode(1)).abs() < 1e-12 && (largest[2] - 0.5).abs() < 1e-12, "{faces} {largest:?}");
        let own = values(&after);
        assert!((2..faces).all(|m| has(&own, 0.75 * mode(m))), "{faces} {own:?}");
        // the boundary's own points stay: 1, 1/2, 1/4 and the cubic B-spline's limit mask
        assert!([1.0, 0.5, 0.25].iter().all(|value| has(&own, *value)));
        let [a, b] = [&before, &after].map(|analysis| analysis.limit_mask.as_ref().unwrap());
        assert_eq!(a.len(), 3);
        assert!(a.iter().zip(b).all(|((p, v), (q, w))| p == q && (v - w).abs() < 1e-13));
    }
    // where a Jordan block leaves no second vector there are no masks to move by
    let analyzer = BoundaryAnalyzer::new(&scheme, &flat).unwrap();
    let why = analyzer.at(FanKind::Crease { faces: 6 }).unwrap_err().to_string();
    assert!(why.contains("no flatness at a crease with 6 faces"), "{why}");
    // between regular faces nothing moves
    let regular = FanKind::Crease { faces: 3 };
    assert_eq!(at(&scheme, &flat, regular).local.dense(), at(&scheme, &plain, regular).local.dense());
}

/// Masks hold against deep refinement with the moves, at corners, creases and darts.
#[test]
fn masks_agree_with_meshes_that_are_moved() {
    let all = "[flatness]\ncrease = \"min(1/4, (k - 1)/4)\"\ncorner = \"1/2\"\ndart = \"1/3\"\n";
    for id in ["loop", "catmull-clark"] {
        let scheme = catalogue::open(id).unwrap().unwrap();
        let text = format!("name = \"Flat\"\nlike = \"{BLZ}\"\n{all}");
        let book = RuleBook::parse_boundary("flat.toml", &text, &scheme.mesh).unwrap();
        let places = [2, 4, 5, 7].map(|faces| FanKind::Crease { faces }).into_iter();
        let places = places.chain([1, 3, 5].map(|faces| FanKind::Corner { faces }));
        let places: Vec<FanKind> = places.chain([3, 5].map(|faces| FanKind::Dart { faces })).collect();
        let refiner = refiner(&scheme, &book, &[], &[places.clone(), rim()].concat());
        let verifier = Verifier::new(&refiner).unwrap();
        for kind in places {
            let masks = verifier.masks(Place::Fan(kind)).unwrap();
            assert!(masks.tangents.is_ok(), "{id} {kind:?} {:?}", masks.tangents);
            let check = verifier.check(Place::Fan(kind), &masks, 2, 11).unwrap();
            assert!(check.agrees, "{id} {kind:?} {check:?}");
        }
    }
}

/// The same at concave corners; at k = 3 and 3 pi/2 the third edge runs straight on from the first.
#[test]
fn masks_agree_at_concave_corners() {
    for id in ["loop", "catmull-clark"] {
        let (scheme, book) = open(id, FLAT, &[("alpha", "3*pi/2")]);
        let refiner = refiner(&scheme, &book, &[], &[rim(), vec![FanKind::Corner { faces: 8 }]].concat());
        let verifier = Verifier::new(&refiner).unwrap();
        for faces in [1, 2, 3, 4, 5, 8] {
            let place = Place::Fan(FanKind::Corner { faces });
            let check = verifier.check(place, &verifier.masks(place).unwrap(), 2, 3).unwrap();
            assert!(
                check.agrees && check.normal.as_ref().is_ok_and(|normal| normal.is_seen()),
                "{id} {faces} {check:?}"
            );
        }
    }
}

/// On meshes whose special vertices are neighbours limits from the first level and from later ones agree, creases with two sides among them; both
/// routes, last steps and rows make the same points.
#[test]
fn levels_and_routes_agree() {
    let text = format!(
        "name = \"Flat\"\nlike = \"{BLZ}\"\n[flatness]\ncrease = \"min(1/4, (k - 1)/4)\"\ncorner = \"1/2\"\ndart = \"1/3\"\n"
    );
    for id in ["loop", "catmull-clark"] {
        let scheme = catalogue::open(id).unwrap().unwrap();
        let triangles = id == "loop";
        let book = RuleBook::parse_boundary("flat.toml", &text, &scheme.mesh).unwrap();
        let closed = if triangles { shapes::many_valences() } else { shapes::prism(5) };
        let mesh = HalfEdgeMesh::new(closed.positions.len(), closed.faces.clone()).unwrap();
        let face = mesh.faces().face(0).to_vec();
        let ever = |a: u32, b: u32| Crease { ends: [a, b], sharpness: f64::INFINITY };
        let creases = vec![ever(face[0], face[1]), ever(face[1], face[2])];
        let mut fading = creases.clone();
        fading[1].sharpness = 1.0;
        let soups = [
            concave(3, triangles),
            concave(5, triangles),
            shaken(shapes::disc(5, triangles)),
            shaken(shapes::tube(3, 5, triangles)),
            shaken(PolygonSoup { creases: creases.clone(), corners: vec![], ..closed.clone() }),
            shaken(PolygonSoup { creases, corners: vec![face[1]], ..closed.clone() }),
            shaken(PolygonSoup { creases: fading, corners: vec![], ..closed }),
        ];
        for (index, soup) in soups.iter().enumerate() {
            let start = level(soup);
            let refiner = refiner(&scheme, &book, &[&start], &[]);
            let levels = Verifier::new(&refiner).unwrap().levels(&start, 2).unwrap();
            assert!(levels.agrees, "{id} {index} {levels:?}");
            let rows = refiner.rows(&start.mesh, &start.tags).unwrap();
            let [fast, slow] = [Route::Fast, Route::General].map(|route| refiner.step(&start, route).unwrap());
            let last = refiner.last_step(&start, Route::Fast).unwrap();
            assert_eq!((&last.positions, &last.faces), (&fast.positions, fast.mesh.faces()));
            assert_eq!(refiner.finish(start.clone(), Route::Fast).unwrap(), last);
            for ((p, q), row) in fast.positions.iter().zip(&slow.positions).zip(&rows) {
                assert!((row.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-13);
                for axis in 0..3 {
                    let product = |(v, w): &(u32, f64)| w * start.positions[*v as usize][axis];
                    let size: f64 = row.iter().map(|term| product(term).abs()).sum();
                    let most = 4.0 * most_ulps(row.len()) * size * f64::EPSILON;
                    assert!((p[axis] - q[axis]).abs() <= most, "{id} {index}");
                    assert!((p[axis] - row.iter().map(product).sum::<f64>()).abs() <= most, "{id} {index}");
                }
            }
        }
    }
}

/// The unit normal of a face.
fn normal(level: &Level<f64>, spoke: u32) -> [f64; 3] {
    let [a, b, c] = [level.mesh.origin(spoke), level.mesh.target(spoke), level.mesh.origin(level.mesh.prev(spoke))]
        .map(|vertex| level.positions[vertex as usize]);
    let [u, v] = [b, c].map(|p| [0, 1, 2].map(|axis| p[axis] - a[axis]));
    let n = [0, 1, 2].map(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    n.map(|x| x / length)
}

/// The normals of the faces around vertex 0.
fn normals(level: &Level<f64>) -> Vec<[f64; 3]> {
    let spokes = level.mesh.around_vertex(level.mesh.vertex_edges()[0]);
    spokes.into_iter().filter(|h| level.mesh.has_face(*h)).map(|h| normal(level, h)).collect()
}

/// The largest angle between a direction and these.
fn farthest(level: &Level<f64>, from: [f64; 3]) -> f64 {
    let cosine = |n: [f64; 3]| (0..3).map(|axis| n[axis] * from[axis]).sum::<f64>();
    normals(level).into_iter().map(cosine).fold(1.0_f64, f64::min).clamp(-1.0, 1.0).acos()
}

/// The largest angle between any two of them.
fn spread(level: &Level<f64>) -> f64 {
    normals(level).into_iter().map(|own| farthest(level, own)).fold(0.0, f64::max)
}

/// Around a concave corner the normals of the faces come together with flatness, towards that of the masks; without it they do not.
#[test]
fn normals_around_a_concave_corner_come_together() {
    for id in ["loop", "catmull-clark"] {
        let start = level(&concave(3, id == "loop"));
        for rules in [BLZ, FLAT] {
            let (scheme, book) = open(id, rules, &[("alpha", "3*pi/2")]);
            let refiner = refiner(&scheme, &book, &[&start], &[]);
            let step = |level: &Level<f64>| refiner.step(level, Route::Fast).unwrap();
            let coarse = (0..5).fold(start.clone(), |level, _| step(&level));
            let fine = (0..4).fold(coarse.clone(), |level, _| step(&level));
            let limit = Limits::new(&refiner).unwrap().of(&start, &|| {}).unwrap();
            let [before, after] = [&coarse, &fine].map(spread);
            assert_eq!(fine.positions[0], start.positions[0]);
            assert_eq!(limit.positions[0], start.positions[0]);
            if rules == BLZ {
                assert!(after > 0.9 * before && after > 0.3, "{id} {before} {after}");
                assert_eq!(limit.normals[0], [0.0; 3]);
                continue;
            }
            // in a step what is beside the plane shrinks by half of sine mode 1, at most 5/16, and tangents by 1/2
            let least = 1.2 * 0.625_f64.powi(4);
            let [far, near] = [&coarse, &fine].map(|level| farthest(level, limit.normals[0]));
            assert!(after < least * before && near < least * far, "{id} {before} {after} {far} {near}");
        }
    }
}

/// A file that tells none changes nothing, and masks that were not handed in are asked for.
#[test]
fn without_flatness_nothing_moves() {
    let start = level(&concave(4, true));
    let (scheme, plain) = open("loop", BLZ, &[]);
    let handed = refiner(&scheme, &plain, &[&start], &[]).step(&start, Route::Fast).unwrap();
    assert_eq!(handed, Refiner::new(&scheme, Some(&plain)).unwrap().step(&start, Route::Fast).unwrap());
    let (scheme, flat) = open("loop", FLAT, &[]);
    let without = Refiner::new(&scheme, Some(&flat)).unwrap();
    let why = without.step(&start, Route::Fast).unwrap_err().to_string();
    assert!(why.contains("masks were not handed in"), "{why}");
    // closed meshes have no boundary
    assert!(without.step(&level(&shapes::torus(4, 4, true)), Route::Fast).is_ok());
}

#[test]
fn faults_of_flatness_are_told() {
    let parse = |own: &str| {
        let text = format!("name = \"Mine\"\nlike = \"cubic\"\n[flatness]\n{own}\n");
        let book = RuleBook::parse_boundary("mine.toml", &text, "triangles");
        book.and_then(|book| book.check(&[2, 3, 5], 6).map(|_| ()))
    };
    parse("crease = \"1 - 1/(2 + cos(pi/k))\"\ndart = \"1/n\"").unwrap();
    for (own, word) in [
        ("crease = \"k/4\"", "not from 0 to 1"),
        ("crease = \"-1/2\"", "not from 0 to 1"),
        ("crease = \"1/n\"", "`n` is not known here"),
        ("cone = \"1/2\"", "cone"),
        ("corner = [1]", "corner"),
    ] {
        let faults = parse(own).unwrap_err().to_string();
        assert!(faults.contains(word), "{own}: {faults}");
    }
}
