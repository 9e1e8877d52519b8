//! Do the boundary files say what their papers say, and do masks and meshes follow them?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::boundary::exact::ExactHalves;
use eigenring::analysis::boundary::halves::Parity;
use eigenring::analysis::boundary::{BoundaryAnalysis, BoundaryAnalyzer};
use eigenring::analysis::places::Place;
use eigenring::analysis::verify::Verifier;
use eigenring::mesh::{
    Connectivity, Crease, FanKind, HalfEdgeMesh, Label, PolygonSoup, Tagged, Tags, edge_between, shapes,
};
use eigenring::refine::{Level, NotRefinable, Obstacle, Refinement, Refiner, Route, Row, cycle_of, most_ulps};
use eigenring::scheme::{RuleBook, Scheme, catalogue};
use eigenring::verdicts::{Decision, Evidence, Outcome, c1_up_to_boundary, check_boundary_claims};
use std::f64::consts::{PI, TAU};

const BLZ: &str = "biermann-levin-zorin-2000";

fn open(id: &str, rules: &str) -> (Scheme, RuleBook) {
    let scheme = catalogue::open(id).unwrap().unwrap();
    let book = catalogue::boundary(rules, &scheme.mesh).unwrap().unwrap();
    (scheme, book)
}

/// Every scheme with every boundary file that it names.
fn variants() -> Vec<(String, Scheme, RuleBook)> {
    let schemes = catalogue::SCHEMES.iter().map(|listed| catalogue::open(listed.id).unwrap().unwrap());
    let of = |scheme: Scheme| {
        let named = |rules: &String| {
            let book = catalogue::boundary(rules, &scheme.mesh).unwrap().unwrap();
            (format!("{} {rules}", scheme.id), scheme.clone(), book)
        };
        scheme.boundary.iter().map(named).collect::<Vec<_>>()
    };
    let all: Vec<_> = schemes.flat_map(of).collect();
    assert!(all.len() >= 8);
    all
}

fn analysed(id: &str, rules: &str, kind: FanKind) -> (BoundaryAnalysis, ExactHalves) {
    let (scheme, book) = open(id, rules);
    let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
    let analysis = analyzer.at(kind).unwrap();
    let exact = analyzer.exact(&analysis.local).unwrap_or_else(|why| panic!("{id} {rules} {kind:?}: {why}"));
    (analysis, exact)
}

fn crease(faces: usize) -> FanKind {
    FanKind::Crease { faces }
}

/// How often a rational eigenvalue is there in a part, and the size of its largest Jordan block.
fn rational(exact: &ExactHalves, text: &str, parity: Parity) -> Option<(usize, usize)> {
    let is_it =
        |words: &Option<eigenring::analysis::exact::words::Words>| words.as_ref().is_some_and(|w| w.text == text);
    let e = exact.eigenvalues.iter().find(|e| e.frequency == parity.part() && is_it(&e.exact))?;
    Some((e.algebraic.unwrap(), e.structure.unwrap().largest))
}

fn level(soup: &PolygonSoup) -> Level<f64> {
    let mesh = HalfEdgeMesh::new(soup.positions.len(), soup.faces.clone()).unwrap();
    let tags = Tags::new(&mesh, &soup.creases, &soup.corners).unwrap();
    Level { mesh, positions: soup.positions.clone(), tags }
}

/// Moves the points a little: no symmetry may hide a mistake.
fn shaken(mut soup: PolygonSoup) -> PolygonSoup {
    let mut state = 3_u64;
    for x in soup.positions.iter_mut().flatten() {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *x += 0.2 * ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5);
    }
    soup
}

fn ever(a: u32, b: u32) -> Crease {
    Crease { ends: [a, b], sharpness: f64::INFINITY }
}

/// Open meshes, and closed ones with creases, darts and corners.
fn meshes(triangles: bool) -> Vec<PolygonSoup> {
    let fans = [1, 2, 3, 5, 7].map(|k| shapes::fan(k, triangles));
    let open = [shapes::tube(3, 5, triangles), shapes::disc(5, triangles), shapes::grid(3, 2, triangles)];
    let closed = if triangles { shapes::many_valences() } else { shapes::prism(5) };
    let mesh = HalfEdgeMesh::new(closed.positions.len(), closed.faces.clone()).unwrap();
    let face = |at: usize| mesh.faces().face(at).to_vec();
    let (a, b) = (face(0), face(3));
    let tagged = [
        vec![ever(a[0], a[1])],
        vec![ever(a[0], a[1]), ever(a[1], a[2])],
        vec![ever(a[0], a[1]), ever(a[1], a[2]), ever(b[0], b[1]), ever(b[1], b[2])],
    ]
    .map(|creases| PolygonSoup { creases, corners: vec![a[1]], ..closed.clone() });
    open.into_iter().chain(fans).chain(tagged).map(shaken).collect()
}

/// The same, without creases for a scheme that turns edges.
fn meshes_for(scheme: &Scheme) -> Vec<PolygonSoup> {
    let mut meshes = meshes(scheme.mesh == "triangles");
    if !cycle_of(scheme).unwrap().keeps_edges() {
        meshes.iter_mut().for_each(|soup| soup.creases.clear());
    }
    meshes
}

/// The weights of a row by vertex.
fn weight(row: &Row<u32, f64>, vertex: u32) -> f64 {
    row.iter().find(|(own, _)| *own == vertex).map_or(0.0, |(_, weight)| *weight)
}

fn edge_row(scheme: &Scheme, book: &RuleBook, soup: &PolygonSoup, ends: [u32; 2]) -> Row<u32, f64> {
    let Level { mesh, tags, .. } = level(soup);
    let refinement = Refinement::<f64>::new(scheme, Some(book));
    let tagged = Tagged { mesh: &mesh, tags: &tags, beyond: 0.0 };
    refinement.passes()[0].edge_row(&tagged, edge_between(&mesh, ends).unwrap()).unwrap()
}

/// A strip of two rows of triangles, its middle row a crease: every vertex on it has three faces on either side but where `extra` cuts.
fn crossed(n: u32) -> PolygonSoup {
    let mut soup = shapes::grid(n as usize, 4, true);
    soup.creases = Vec::new();
    soup
}

/// Hoppe et al. 1994, table 1: the mask of a sharp edge by the kinds of its ends.
#[test]
fn sharp_edges_follow_the_table_of_hoppe_et_al() {
    let (scheme, book) = open("loop", "hoppe-1994");
    // on the boundary of a grid: 2 or 1 faces at its corners, 3 elsewhere
    let grid = crossed(6);
    let start = level(&grid);
    let faces = |v: u32| start.mesh.valence(start.mesh.vertex_edges()[v as usize]) - 1;
    let (mut seen, boundary) = ([0; 3], start.mesh.edges().filter(|h| start.mesh.is_sharp(*h)).collect::<Vec<_>>());
    for h in boundary {
        let ends = [start.mesh.origin(h), start.mesh.target(h)];
        let row = edge_row(&scheme, &book, &grid, ends);
        let irregular = ends.map(|v| faces(v) != 3);
        let wanted = match irregular {
            [true, false] => [3.0 / 8.0, 5.0 / 8.0],
            [false, true] => [5.0 / 8.0, 3.0 / 8.0],
            _ => [0.5, 0.5],
        };
        seen[irregular.iter().filter(|own| **own).count()] += 1;
        assert_eq!(ends.map(|v| weight(&row, v)), wanted, "{ends:?}");
        assert_eq!(row.len(), 2);
    }
    assert!(seen[0] > 0 && seen[1] > 0, "{seen:?}");
    // a fan of two faces: its corners have one or two, and all are special
    let row = edge_row(&scheme, &book, &shapes::fan(2, true), [0, 1]);
    assert_eq!([weight(&row, 0), weight(&row, 1)], [0.5, 0.5]);
    // a regular vertex that is tagged as a corner is special
    let corner = PolygonSoup { corners: vec![2], ..grid.clone() };
    assert_eq!([2, 3].map(|v| weight(&edge_row(&scheme, &book, &corner, [2, 3]), v)), [3.0 / 8.0, 5.0 / 8.0]);
    assert_eq!([2, 3].map(|v| weight(&edge_row(&scheme, &book, &grid, [2, 3]), v)), [0.5, 0.5]);
    // a crease inside that ends: its last edge is smooth
    let torus = shapes::torus(6, 6, true);
    let mesh = level(&torus).mesh;
    let run = |start: u32| {
        let on = |h: u32| (0..3).fold(mesh.twin(h), |h, _| mesh.turn(h));
        [start, on(start), on(on(start))].map(|h| [mesh.origin(h), mesh.target(h)])
    };
    let edges = run(mesh.vertex_edges()[0]);
    let tagged = PolygonSoup { creases: edges.map(|[a, b]| ever(a, b)).to_vec(), ..torus };
    let last = edge_row(&scheme, &book, &tagged, edges[0]);
    assert_eq!(edges[0].map(|v| weight(&last, v)), [3.0 / 8.0, 3.0 / 8.0]);
    assert_eq!(last.len(), 4);
    assert_eq!(edge_row(&scheme, &book, &tagged, edges[1]).len(), 2);
}

/// Biermann, Levin and Zorin 2000: 3/4 - gamma at the special end, gamma at the other one, with gamma = 1/2 - cos(theta)/4 on triangles and
/// 3/8 - cos(theta)/4 on quads, theta = pi/k; 1/8 or 1/16 for each of the others.
#[test]
fn edges_from_a_crease_end_have_the_weights_of_biermann_levin_and_zorin() {
    for (id, base, others) in [("loop", 0.5, (2, 1.0 / 8.0)), ("catmull-clark", 3.0 / 8.0, (4, 1.0 / 16.0))] {
        let (scheme, book) = open(id, BLZ);
        for k in 2..=8_usize {
            // around a fan whose rim is pushed away by a ring of faces: the other ends lie inside
            let start = level(&shapes::fan(k, id == "loop"));
            let fine = Refiner::new(&scheme, Some(&book)).unwrap().step(&start, Route::General).unwrap();
            let soup = PolygonSoup {
                positions: fine.positions.clone(),
                faces: fine.mesh.faces().clone(),
                creases: vec![],
                corners: vec![],
            };
            let gamma = base - (PI / k as f64).cos() / 4.0;
            let spokes = fine.mesh.around_vertex(fine.mesh.vertex_edges()[0]);
            let inner: Vec<u32> = spokes.into_iter().filter(|h| !fine.mesh.is_sharp(*h)).collect();
            assert_eq!(inner.len(), k - 1);
            for h in inner {
                let other = fine.mesh.target(h);
                let row = edge_row(&scheme, &book, &soup, [0, other]);
                assert!((weight(&row, 0) - (0.75 - gamma)).abs() < 1e-15, "{id} {k}");
                assert!((weight(&row, other) - gamma).abs() < 1e-15, "{id} {k}");
                let rest: Vec<f64> = row.iter().filter(|(v, _)| ![0, other].contains(v)).map(|(_, w)| *w).collect();
                assert!(
                    rest.len() == others.0 && rest.iter().all(|w| (w - others.1).abs() < 1e-15),
                    "{id} {k} {rest:?}"
                );
            }
        }
    }
}

/// What these weights are made for: 1/2 once in the even and once in the odd part, all else but 1 smaller, by exact numbers; and its vectors
/// are the sine and the cosine over the sector.
#[test]
fn half_is_a_double_subdominant_by_biermann_levin_and_zorin() {
    for id in ["loop", "loop-warren", "catmull-clark"] {
        let darts = [3, 4, 5, 6, 8].map(|faces| FanKind::Dart { faces });
        for kind in (2..=8).map(crease).chain(darts) {
            let (analysis, exact) = analysed(id, BLZ, kind);
            for parity in Parity::BOTH {
                assert_eq!(rational(&exact, "1/2", parity), Some((1, 1)), "{id} {kind:?}");
            }
            let level = exact.eigenvalues.iter().filter(|e| e.level == 1).count();
            assert!(level == 2 && exact.certain[1] && exact.certain[2], "{id} {kind:?}");
            assert!(analysis.tangent_masks.is_ok(), "{id} {kind:?}");
            let sectors = analysis.fan.sectors();
            let angle = if kind.is_closed() { TAU } else { PI } / f64::from(sectors);
            let dense = analysis.local.dense();
            for shape in [f64::sin as fn(f64) -> f64, f64::cos] {
                // of the faces around the centre alone: on quads the vertex across is that of a rhombus, as the mirror image wants it
                let across = 2.0 * (angle / 2.0).cos();
                let value = |label: &Label| match (label.i, label.j) {
                    (1, 0) => shape(angle * f64::from(label.sector)),
                    (1, 1) if id == "catmull-clark" => across * shape(angle * (f64::from(label.sector) + 0.5)),
                    _ => 0.0,
                };
                for (row, label) in analysis.local.labels.iter().enumerate() {
                    let near = label.i <= 1 && label.j == 0 || id == "catmull-clark" && (label.i, label.j) == (1, 1);
                    if near {
                        let image: f64 =
                            analysis.local.labels.iter().enumerate().map(|(c, own)| dense[(row, c)] * value(own)).sum();
                        assert!((image - value(label) / 2.0).abs() < 1e-14, "{id} {kind:?} {label:?}: {image}");
                    }
                }
            }
        }
        // one face: no edge leads inside, so the rule is that of cubic B-splines
        let (own, _) = analysed(id, BLZ, crease(1));
        let (cubic, _) = analysed(id, "cubic", crease(1));
        assert!((own.local.dense() - cubic.local.dense()).amax() < 1e-15, "{id}");
    }
}

/// Corners: with the angle alpha between the edges the characteristic map is the sector of that angle; where the angle is above pi a sine mode is
/// above the edges' 1/2, and without a further rule there is no tangent plane.
#[test]
fn corners_have_the_angle_that_is_set() {
    for (id, alpha, angle) in [("loop", "pi/3", PI / 3.0), ("loop", "2", 2.0), ("catmull-clark", "3*pi/4", 0.75 * PI)] {
        let (scheme, mut book) = open(id, BLZ);
        book.set("alpha", alpha).unwrap();
        book.check(&[2, 3, 4, 5], scheme.regular_valence()).unwrap();
        let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
        for faces in 1..=5 {
            let analysis = analyzer.at(FanKind::Corner { faces }).unwrap();
            let tangents = analysis.tangent_masks.as_ref().unwrap();
            assert!(tangents.eigenvalues.iter().all(|e| (e.value.re - 0.5).abs() < 1e-12), "{id} {faces}");
            // the net's angle: after the linear map that makes the two edges unit vectors at that angle
            let at = |sector: u32| tangents.net[analysis.local.index(Label { sector, i: 1, j: 0 }).unwrap()];
            let ([ax, ay], [bx, by]) = (at(0), at(faces as u32));
            let determinant = ax * by - ay * bx;
            for sector in 1..faces as u32 {
                let [x, y] = at(sector);
                // (x, y) = p a + q b
                let (p, q) = ((x * by - y * bx) / determinant, (ax * y - ay * x) / determinant);
                let place = [p + q * angle.cos(), q * angle.sin()];
                let phi = angle * f64::from(sector) / faces as f64;
                assert!((place[0] - phi.cos()).abs() < 1e-9 && (place[1] - phi.sin()).abs() < 1e-9, "{id} {faces}");
            }
        }
        let mut concave = book.clone();
        concave.set("alpha", "3*pi/2").unwrap();
        let analyzer = BoundaryAnalyzer::new(&scheme, &concave).unwrap();
        for faces in 2..=6 {
            let why = analyzer.at(FanKind::Corner { faces }).unwrap().tangent_masks.unwrap_err();
            assert!(why.starts_with("no tangent plane: the mode"), "{id} {faces}: {why}");
        }
    }
}

/// The plain rules: where sine modes pass the boundary's 1/2, and where they meet it in a Jordan block. Decided exactly.
#[test]
fn sine_modes_and_jordan_blocks_of_the_plain_rules() {
    for (id, blocks, lost) in [("loop", vec![6, 12], 7), ("catmull-clark", vec![4, 8, 12], 5)] {
        for k in 1..=12 {
            let (analysis, exact) = analysed(id, "cubic", crease(k));
            let largest = Parity::BOTH.map(|parity| rational(&exact, "1/2", parity).map_or(0, |(_, block)| block));
            assert_eq!(largest.contains(&2), blocks.contains(&k), "{id} {k}: {largest:?}");
            assert!(largest[Parity::Odd.part()] >= 1, "{id} {k}: the boundary's own");
            let above = |mode: usize| {
                let own = |(index, found): &&(usize, eigenring::analysis::boundary::modes::Mode)| {
                    found.number == mode && exact.eigenvalues[*index].re.midpoint_f64() > 0.5 + 1e-9
                };
                exact.sines.iter().any(|found| own(&found))
            };
            assert_eq!(above(2), k >= lost, "{id} {k}");
            assert_eq!(analysis.tangent_masks.is_ok(), k < lost, "{id} {k}");
            let verdict = c1_up_to_boundary(&analysis, Some(&exact));
            assert_eq!(verdict.verdict, Decision::Undecided, "{id} {k}: no theorem for a sector is applied");
            let wanted = if k < lost { Evidence::For } else { Evidence::Against };
            assert_eq!(verdict.evidence, wanted, "{id} {k}");
            if k >= lost {
                let why = verdict.why.join(" ");
                assert!(why.contains("sine mode 1") && why.contains("sine mode 2") && why.contains("exact"), "{why}");
            }
            // all modes are found, each with its value
            let c = |mode: usize| (PI * mode as f64 / k as f64).cos();
            for (index, mode) in &exact.sines {
                let found = exact.eigenvalues[*index].re.midpoint_f64();
                let c = c(mode.number);
                let wanted = match id {
                    "loop" => vec![0.375 + c / 4.0],
                    _ => [1.0, -1.0].map(|s| (5.0 + c + s * ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0).to_vec(),
                };
                assert!(wanted.iter().any(|own| (own - found).abs() < 1e-13), "{id} {k} {mode:?}");
            }
            let wanted = if id == "loop" { k - 1 } else { 2 * (k - 1) + 1 };
            assert_eq!(exact.sines.len(), wanted, "{id} {k}: {:?}", exact.sines);
            if let Some(rows) = exact.sine_rows.as_ref().filter(|_| k > 2) {
                let wanted = match id {
                    "loop" => ["3/8 + cos(pi/k)/4", "3/8 + cos(2*pi/k)/4"],
                    _ => ["x^2 - (5/8 + cos(pi/k)/8)*x + 1/16 = 0", "x^2 - (5/8 + cos(2*pi/k)/8)*x + 1/16 = 0"],
                };
                assert_eq!([1, 2].map(|mode| rows.formula(mode).unwrap()), wanted.map(String::from), "{id} {k}");
            }
        }
    }
}

/// Hoppe et al.: 5/8 along the boundary is above every sine mode, so that they have a tangent plane for many faces; with two faces
/// the sine mode and the boundary's own next value are both 3/8, each with a vector of its own.
#[test]
fn the_boundary_leads_by_hoppe_et_al() {
    for k in [1, 2, 4, 5, 6, 7, 8, 12] {
        let (analysis, exact) = analysed("loop", "hoppe-1994", crease(k));
        assert_eq!(rational(&exact, "5/8", Parity::Odd), Some((1, 1)), "{k}");
        let others = exact.eigenvalues.iter().filter(|e| e.level >= 2);
        assert!(
            others.clone().count() >= 3 && others.clone().all(|e| e.re.midpoint_f64() < 0.624),
            "{k} {:?}",
            others.map(|e| e.re.midpoint_f64()).collect::<Vec<_>>()
        );
        assert_eq!(analysis.tangent_masks.is_ok(), k != 2, "{k}");
    }
    let (analysis, exact) = analysed("loop", "hoppe-1994", crease(2));
    assert_eq!(rational(&exact, "3/8", Parity::Even), Some((2, 1)));
    assert!(analysis.tangent_masks.unwrap_err().contains("2 eigenvectors of one parity"));
    // a regular vertex is as by cubic rules
    let regular = ["hoppe-1994", "cubic"].map(|rules| analysed("loop", rules, crease(3)).0.local.dense());
    assert_eq!(regular[0], regular[1]);
}

/// At boundaries, corners and darts of 1 to 8 faces: masks applied once against deep refinement of random neighbourhoods.
#[test]
fn masks_are_what_deep_refinement_leaves() {
    for (here, scheme, book) in variants() {
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        let verifier = Verifier::new(&refiner).unwrap();
        let kinds = FanKind::each(&[1, 2, 3, 4, 5, 6, 7, 8], refiner.keeps_edges());
        assert_eq!(kinds.len(), if refiner.keeps_edges() { 22 } else { 16 });
        for kind in kinds {
            let masks = verifier.masks(Place::Fan(kind)).unwrap();
            let limit: f64 = masks.limit.as_ref().unwrap().iter().map(|(_, weight)| weight).sum();
            assert!((limit - 1.0).abs() < 1e-14, "{here} {kind:?}");
            for tangent in masks.tangents.iter().flatten() {
                assert!(tangent.iter().map(|(_, weight)| weight).sum::<f64>().abs() < 1e-12, "{here} {kind:?}");
            }
            let check = verifier.check(Place::Fan(kind), &masks, 1, 5).unwrap();
            assert!(check.agrees && check.position < 1e-12, "{here} {kind:?} {check:?}");
        }
    }
}

/// Limits from a level and from three steps later; rows sum to 1; both routes make the same points.
#[test]
fn meshes_follow_every_variant() {
    for (here, scheme, book) in variants() {
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        let verifier = Verifier::new(&refiner).unwrap();
        for (index, soup) in meshes_for(&scheme).iter().enumerate() {
            let start = level(soup);
            let levels = verifier.levels(&start, 3).unwrap();
            assert!(levels.position < 1e-12 && levels.normal < 1e-9, "{here} {index}: {levels:?}");
            let fading = |sharpness: f64| soup.creases.iter().map(move |own| Crease { sharpness, ..*own });
            for creases in [soup.creases.clone(), fading(0.4).collect(), fading(1.7).collect()] {
                let mut at = level(&PolygonSoup { creases, ..soup.clone() });
                for _ in 0..2 {
                    let rows = refiner.rows(&at.mesh, &at.tags).unwrap();
                    let sums = rows.iter().map(|row| row.iter().map(|(_, weight)| weight).sum::<f64>());
                    assert!(sums.into_iter().all(|sum| (sum - 1.0).abs() < 1e-14), "{here} {index}");
                    let (fast, slow) =
                        (refiner.step(&at, Route::Fast).unwrap(), refiner.step(&at, Route::General).unwrap());
                    assert_eq!(fast.mesh, slow.mesh);
                    for ((p, q), row) in fast.positions.iter().zip(&slow.positions).zip(&rows) {
                        for axis in 0..3 {
                            let size: f64 = row.iter().map(|(v, w)| (w * at.positions[*v as usize][axis]).abs()).sum();
                            let most = most_ulps(row.len()) * size * f64::EPSILON;
                            assert!((p[axis] - q[axis]).abs() <= most, "{here} {index}");
                        }
                    }
                    at = fast;
                }
            }
        }
    }
}

/// A mesh and its mirror image, and the same mesh with its vertices told in another order, have the same points.
#[test]
fn left_and_right_are_alike() {
    for (here, scheme, book) in variants() {
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        for soup in meshes_for(&scheme) {
            let turned: Vec<Vec<usize>> =
                soup.faces.iter().map(|face| face.iter().rev().map(|v| *v as usize).collect()).collect();
            let image = PolygonSoup { faces: eigenring::mesh::Faces::from_lists(&turned), ..soup.clone() };
            let points = [&soup, &image].map(|soup| {
                let mut points = refiner.step(&level(soup), Route::General).unwrap().positions;
                points.sort_by(|a, b| a.map(|x| (x * 1e9).round()).partial_cmp(&b.map(|x| (x * 1e9).round())).unwrap());
                points
            });
            for (p, q) in points[0].iter().zip(&points[1]) {
                assert!((0..3).all(|axis| (p[axis] - q[axis]).abs() < 1e-9), "{here}");
            }
        }
    }
}

/// While a crease ends, an edge beside it blends the rule from a crease end with the plain one.
#[test]
fn edges_beside_a_fading_crease_are_blended() {
    for (id, soup) in [("loop", shapes::torus(6, 6, true)), ("catmull-clark", shapes::torus(6, 6, false))] {
        let (scheme, book) = open(id, BLZ);
        let mesh = level(&soup).mesh;
        // two edges at vertex 0 that are neighbours: irregular sides, so that the rule from the end matters
        let [a, b] = [mesh.vertex_edges()[0], mesh.turn(mesh.vertex_edges()[0])].map(|h| mesh.target(h));
        let row = |sharpness: f64| {
            let creases = [a, b].map(|end| Crease { ends: [0, end], sharpness });
            let tags = Tags::new(&mesh, &creases, &[]).unwrap();
            let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
            refiner.rows(&mesh, &tags).unwrap()
        };
        let (none, all, some) = (row(0.0), row(1.0), row(0.3));
        let mut moved = 0;
        for point in mesh.vertices()..none.len() {
            for vertex in 0..mesh.vertices() as u32 {
                let [n, a, s] = [&none, &all, &some].map(|rows| weight(&rows[point], vertex));
                assert!((s - (0.3 * a + 0.7 * n)).abs() < 1e-15, "{id} {point} {vertex}");
                moved += usize::from((n - a).abs() > 1e-3);
            }
        }
        // more than the two crease edges
        assert!(moved > 8, "{id}: {moved}");
    }
}

#[test]
fn a_boundary_file_may_be_like_another() {
    let own = "name = \"Mine\"\nlike = \"cubic\"\n[edge.from-crease-end]\ncentre = \"3/8\"\n\"ring[0]\" = \"3/8\"\n\"ring[-1,1]\" = \"1/8\"\n";
    let book = RuleBook::parse_boundary("mine.toml", own, "triangles").unwrap();
    book.check(&[2, 3, 4], 6).unwrap();
    assert_eq!(book.all_sources(), ["hoppe-1994"]);
    // these weights are the plain rule's: nothing changes
    let scheme = catalogue::open("loop").unwrap().unwrap();
    let (_, cubic) = open("loop", "cubic");
    let matrices =
        [&book, &cubic].map(|book| BoundaryAnalyzer::new(&scheme, book).unwrap().at(crease(5)).unwrap().local.dense());
    assert_eq!(matrices[0], matrices[1]);
    let with = |old: &str, new: &str| RuleBook::parse_boundary("mine.toml", &own.replace(old, new), "triangles");
    let refused = |old: &str, new: &str, words: &[&str]| {
        let faults = with(old, new).map(|book| book.check(&[2, 3, 4], 6)).unwrap_or_else(Err).unwrap_err().to_string();
        assert!(words.iter().all(|word| faults.contains(word)), "{new}: {faults}");
    };
    refused("cubic", "cubik", &["no boundary file `cubik`", "hoppe-1994"]);
    refused("\"1/8\"", "\"1/4\"", &["[edge.from-crease-end] sum to 1.25", "2 x ring"]);
    refused("ring[0]", "ring[k]", &["doesn't pick points"]);
    refused("\"3/8\"\n\"ring[0]", "\"n/8\"\n\"ring[0]", &["`n` is not known here"]);
    refused("edge.from-crease-end", "edge.from-irregular-end", &["from-irregular-end"]);
    refused("like = \"cubic\"", "quads = 3", &["a table of rules"]);
}

/// A rule of two rings: its walks fork beside irregular vertices, and the rows are sound there; beside a boundary it is refused with the vertex.
#[test]
fn rules_of_two_rings_beside_other_special_vertices() {
    let text = "name = \"Two rings\"\nmesh = \"triangles\"\nsplit = \"1-to-4\"\nboundary = [\"cubic\"]\n[vertex]\ncentre = \"9/16\"\n\
        ring = \"3/(8*n)\"\n\"2,0\" = \"1/(32*n)\"\n\"1,1\" = \"1/(32*n)\"\n[edge]\nends = \"3/8\"\nopposite = \"1/8\"\n";
    let scheme = Scheme::parse("two", "two.toml", text).unwrap();
    let book = catalogue::boundary("cubic", "triangles").unwrap().unwrap();
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let start = level(&shaken(shapes::many_valences()));
    for row in refiner.rows(&start.mesh, &start.tags).unwrap() {
        assert!((row.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-14);
    }
    let levels = Verifier::new(&refiner).unwrap().levels(&start, 2).unwrap();
    assert!(levels.agrees, "{levels:?}");
    // straight on at an odd valence is both ways, each with half of the weight
    let vertex = |v: u32| start.mesh.vertex_edges()[v as usize];
    let refinement = Refinement::<f64>::new(&scheme, Some(&book));
    let odd = (0..start.mesh.vertices() as u32).find(|v| start.mesh.valence(vertex(*v)) == 5).unwrap();
    let beside = start.mesh.target(vertex(odd));
    let row = refinement.passes()[0].vertex_row(&start.mesh, vertex(beside)).unwrap();
    assert!(row.len() > start.mesh.valence(vertex(beside)));
    let open = level(&shapes::disc(5, true));
    let Err(NotRefinable::At(place, obstacle)) = refiner.step(&open, Route::Fast) else { panic!("refined") };
    assert_eq!((place, *obstacle), (vec![0], Obstacle::Boundary("vertex")));
}

/// What the papers say of the rules is compared with the analysis; a wrong claim is told.
#[test]
fn claims_of_boundary_files_are_compared() {
    for (here, scheme, book) in variants() {
        let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
        let mut agreeing = 0;
        for kind in FanKind::each(&[1, 2, 3, 4, 5, 6], cycle_of(&scheme).unwrap().keeps_edges()) {
            let analysis = analyzer.at(kind).unwrap();
            let verdict = c1_up_to_boundary(&analysis, None);
            for check in check_boundary_claims(&book, &analysis, &verdict).unwrap() {
                assert_ne!(check.outcome, Outcome::Disagrees, "{here} {kind:?} {check:?}");
                agreeing += usize::from(check.outcome == Outcome::Agrees);
                assert_eq!(check.outcome == Outcome::Undecided, check.what.ends_with("C1"), "{here} {check:?}");
            }
        }
        assert!(agreeing >= 5, "{here}: {agreeing}");
    }
    let wrong = "name = \"Wrong\"\nlike = \"cubic\"\n[[claims]]\nat = \"crease\"\nwhat = \"subdominant\"\nequals = \"1/2\"\nwhere = \"k > 3\"\n";
    let book = RuleBook::parse_boundary("wrong.toml", wrong, "triangles").unwrap();
    let scheme = catalogue::open("loop").unwrap().unwrap();
    let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
    let checks = |k: usize| {
        let analysis = analyzer.at(crease(k)).unwrap();
        check_boundary_claims(&book, &analysis, &c1_up_to_boundary(&analysis, None)).unwrap()
    };
    assert!(checks(3).is_empty());
    assert_eq!(checks(4)[0].outcome, Outcome::Disagrees);
    for (old, new, word) in [
        ("crease", "cone", "cone"),
        ("subdominant", "cup", "can't be about `cup`"),
        ("\"1/2\"", "\"1/n\"", "`n` is not known here"),
        ("equals = \"1/2\"\n", "", "gives no value"),
    ] {
        let faults = RuleBook::parse_boundary("wrong.toml", &wrong.replacen(old, new, 1), "triangles").unwrap_err();
        assert!(faults.to_string().contains(word), "{faults}");
    }
}
