//! Do limit points and normals by masks agree with each other from level to level, with splines, and with deep refinement?
#![allow(clippy::unwrap_used)]

mod shared;

use eigenring::analysis::limit::{LimitSurface, Limits};
use eigenring::mesh::{Crease, HalfEdgeMesh, PolygonSoup, shapes};
use eigenring::refine::{Level, Refiner, Route};
use eigenring::scheme::{RuleBook, Scheme};
use shared::{level, open};

/// The shape with every point moved by a little, the same each time: nothing is symmetric, nothing planar.
fn shaken(mut soup: PolygonSoup) -> PolygonSoup {
    let mut state = 0x1234_5678_9abc_def1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / (1_u64 << 24) as f64 - 0.5
    };
    soup.positions.iter_mut().flatten().for_each(|x| *x += 0.2 * random());
    soup
}

fn limit(scheme: &Scheme, book: &RuleBook, level: &Level<f64>) -> LimitSurface {
    let refiner = Refiner::new(scheme, Some(book)).unwrap();
    Limits::new(&refiner).unwrap().of(level, &|| ()).unwrap()
}

/// Limit points and normals from a level and from some steps later agree.
fn check_levels(id: &str, shape: &PolygonSoup, steps: usize, [positions, normals]: [f64; 2]) {
    let (scheme, book) = open(id);
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let first = level(shape);
    let last = (0..steps).fold(first.clone(), |at, _| refiner.step(&at, Route::Fast).unwrap());
    let (a, b) = (limit(&scheme, &book, &first), limit(&scheme, &book, &last));
    assert!(a.normals.iter().any(|n| *n != [0.0; 3]), "{id}: no normals");
    for vertex in 0..first.mesh.vertices() {
        for axis in 0..3 {
            let apart = (a.positions[vertex][axis] - b.positions[vertex][axis]).abs();
            assert!(apart < positions, "{id}: vertex {vertex} is {apart} apart");
            let apart = (a.normals[vertex][axis] - b.normals[vertex][axis]).abs();
            assert!(apart < normals, "{id}: the normals at {vertex} are {apart} apart");
        }
    }
}

fn closed(id: &str) -> Vec<PolygonSoup> {
    match id {
        "catmull-clark" => vec![shapes::many_valences(), shapes::torus(5, 6, false), shapes::prism(5), shapes::cube()],
        _ => vec![shapes::many_valences(), shapes::torus(5, 6, true), shapes::tetrahedron()],
    }
}

#[test]
fn limits_from_level_0_and_level_4_agree_on_closed_meshes() {
    for id in ["loop", "loop-warren", "catmull-clark"] {
        for shape in closed(id) {
            check_levels(id, &shaken(shape), 4, [1e-13, 1e-10]);
        }
    }
}

#[test]
fn an_interpolating_scheme_keeps_its_points_and_has_normals() {
    let (scheme, book) = open("modified-butterfly");
    let shape = shaken(shapes::many_valences());
    let surface = limit(&scheme, &book, &level(&shape));
    for (a, b) in surface.positions.iter().zip(&shape.positions) {
        assert!((0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-14));
    }
    check_levels("modified-butterfly", &shape, 2, [1e-13, 1e-10]);
}

/// Cubic B-spline values at t in [0, 1) from the knot on: of the control points -1, 0, 1, 2.
fn cubic(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [
        s * s * s / 6.0,
        (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
        (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0,
        t * t * t / 6.0,
    ]
}

/// A function on a periodic grid, smooth in no sense.
fn height(i: usize, j: usize) -> f64 {
    ((i * 7 + j * 3) % 5) as f64 + ((i * j) % 7) as f64
}

/// The limit points of level 2 of a torus of m x n, whose heights stand for a periodic function on the grid.
fn heights_of_torus(id: &str, m: usize, n: usize, triangles: bool) -> (Level<f64>, LimitSurface) {
    let (scheme, book) = open(id);
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let mut at = level(&shapes::torus(m, n, triangles));
    // parameters as coordinates: they jump once around, so they are read off old neighbours, not off the limit
    at.positions = (0..m * n).map(|v| [height(v / n, v % n), 0.0, 0.0]).collect();
    at = (0..2).fold(at, |at, _| refiner.step(&at, Route::Fast).unwrap());
    let surface = limit(&scheme, &book, &at);
    (at, surface)
}

/// The parameters of the vertices of level 2 in quarters of a grid step, from those of a grid in the plane refined the same way.
fn parameters(id: &str, m: usize, n: usize, triangles: bool) -> Vec<[i64; 2]> {
    let (scheme, _) = open(id);
    let mut at = level(&shapes::torus(m, n, triangles));
    let mut here: Vec<[i64; 2]> = (0..m * n).map(|v| [(v / n) as i64, (v % n) as i64]).collect();
    for step in 0..2 {
        let period = [(m << step) as i64, (n << step) as i64];
        // twice the mean of the points of a new point's birth place, unwrapped around the first of them
        let mean = |corners: &[u32], here: &[[i64; 2]]| {
            let first = here[corners[0] as usize];
            [0, 1].map(|axis| {
                let near = |v: &u32| {
                    let apart = (here[*v as usize][axis] - first[axis]).rem_euclid(period[axis]);
                    if 2 * apart > period[axis] { apart - period[axis] } else { apart }
                };
                2 * first[axis] + 2 * corners.iter().map(near).sum::<i64>() / corners.len() as i64
            })
        };
        let mut next: Vec<[i64; 2]> = (0..here.len() as u32).map(|v| mean(&[v], &here)).collect();
        let ends = |h: u32| {
            [at.mesh.faces().corners()[h as usize], at.mesh.faces().corners()[at.mesh.faces().next(h) as usize]]
        };
        next.extend(at.mesh.edges().map(|h| mean(&ends(h), &here)));
        if !triangles {
            next.extend(at.mesh.faces().iter().map(|face| mean(face, &here)));
        }
        let period = [2 * period[0], 2 * period[1]];
        here = next.into_iter().map(|p| [p[0].rem_euclid(period[0]), p[1].rem_euclid(period[1])]).collect();
        at = Refiner::new(&scheme, None).unwrap().step(&at, Route::Fast).unwrap();
    }
    here
}

#[test]
fn on_a_regular_grid_catmull_clark_is_the_bicubic_spline() {
    let (m, n) = (5, 6);
    let (_, surface) = heights_of_torus("catmull-clark", m, n, false);
    for (position, [a, b]) in surface.positions.iter().zip(parameters("catmull-clark", m, n, false)) {
        let (i, j) = (a as usize / 4, b as usize / 4);
        let (bi, bj) = (cubic((a % 4) as f64 / 4.0), cubic((b % 4) as f64 / 4.0));
        let mut value = 0.0;
        for (di, wi) in bi.iter().enumerate() {
            for (dj, wj) in bj.iter().enumerate() {
                value += wi * wj * height((i + di + m - 1) % m, (j + dj + n - 1) % n);
            }
        }
        assert!((position[0] - value).abs() < 1e-13, "{a} {b}: {} {value}", position[0]);
    }
}

/// The quartic box spline over the triangle of the origin, (1, 0) and (1, 1), in its barycentric coordinates u (at the origin), v, w:
/// each control point's offset with its value (the twelve polynomials: J. Stam, Evaluation of Loop subdivision surfaces, 1998,
/// which stand for the vertices of a triangle and of all triangles that touch it).
fn box_spline([u, v, w]: [f64; 3]) -> Vec<([i64; 2], f64)> {
    // of a vertex of the triangle, with own coordinate a and the others b, c
    let corner = |a: f64, b: f64, c: f64| {
        6.0 * a.powi(4)
            + 24.0 * a.powi(3) * (b + c)
            + 24.0 * a * a * (b * b + c * c)
            + 8.0 * a * (b.powi(3) + c.powi(3))
            + b.powi(4)
            + c.powi(4)
            + 60.0 * a * a * b * c
            + 36.0 * a * b * c * (b + c)
            + 6.0 * b * c * (b * b + c * c)
            + 12.0 * b * b * c * c
    };
    // of the vertex across the edge of a and b, c being the coordinate of the far vertex
    let across = |a: f64, b: f64, c: f64| {
        a.powi(4)
            + b.powi(4)
            + 6.0 * (a.powi(3) * b + a * b.powi(3))
            + 12.0 * a * a * b * b
            + 2.0 * c * (a.powi(3) + b.powi(3))
            + 6.0 * a * b * c * (a + b)
    };
    // of the vertices that only touch the corner of a, on the side of b
    let beside = |a: f64, b: f64| a.powi(4) + 2.0 * a.powi(3) * b;
    let all = [
        ([0, 0], corner(u, v, w)),
        ([1, 0], corner(v, u, w)),
        ([1, 1], corner(w, u, v)),
        ([0, -1], across(u, v, w)),
        ([2, 1], across(v, w, u)),
        ([0, 1], across(w, u, v)),
        ([-1, -1], beside(u, v)),
        ([-1, 0], beside(u, w)),
        ([2, 0], beside(v, w)),
        ([1, -1], beside(v, u)),
        ([1, 2], beside(w, u)),
        ([2, 2], beside(w, v)),
    ];
    all.into_iter().map(|(offset, value)| (offset, value / 12.0)).collect()
}

#[test]
fn on_a_regular_grid_loop_is_the_quartic_box_spline() {
    let (m, n) = (5, 6);
    let sum = |at: [f64; 3]| box_spline(at).iter().map(|(_, value)| value).sum::<f64>();
    assert!((sum([0.2, 0.3, 0.5]) - 1.0).abs() < 1e-15 && (sum([1.0, 0.0, 0.0]) - 1.0).abs() < 1e-15);
    let (_, surface) = heights_of_torus("loop", m, n, true);
    for (position, [a, b]) in surface.positions.iter().zip(parameters("loop", m, n, true)) {
        let (i, j) = (a / 4, b / 4);
        let (x, y) = ((a % 4) as f64 / 4.0, (b % 4) as f64 / 4.0);
        // above the diagonal of the cell the axes change places
        let (low, swap) = if x >= y { ([1.0 - x, x - y, y], false) } else { ([1.0 - y, y - x, x], true) };
        let at = |[di, dj]: [i64; 2]| {
            let (di, dj) = if swap { (dj, di) } else { (di, dj) };
            height((i + di).rem_euclid(m as i64) as usize, (j + dj).rem_euclid(n as i64) as usize)
        };
        let value: f64 = box_spline(low).into_iter().map(|(offset, weight)| weight * at(offset)).sum();
        assert!((position[0] - value).abs() < 1e-13, "{a} {b}: {} {value}", position[0]);
    }
}

/// The biquadratic spline at a control point: the mean of the four points that a step makes around it, by (1, 6, 1)/8 each way.
#[test]
fn on_a_regular_grid_doo_sabin_is_the_biquadratic_spline() {
    let (m, n) = (5, 6);
    for id in ["doo-sabin", "catmull-clark-biquadratic"] {
        let (scheme, book) = open(id);
        let mut at = level(&shapes::torus(m, n, false));
        at.positions = (0..m * n).map(|v| [height(v / n, v % n), 0.0, 0.0]).collect();
        let surface = limit(&scheme, &book, &at);
        for (vertex, position) in surface.positions.iter().enumerate() {
            let mut value = 0.0;
            for (di, wi) in [1.0, 6.0, 1.0].iter().enumerate() {
                for (dj, wj) in [1.0, 6.0, 1.0].iter().enumerate() {
                    value += wi * wj / 64.0 * height((vertex / n + di + m - 1) % m, (vertex % n + dj + n - 1) % n);
                }
            }
            assert!((position[0] - value).abs() < 1e-14, "{id}: {vertex}");
        }
    }
}

/// Dual: the limit of a face's middle is that of every later face of the same number; its vertices' mean tends to it.
#[test]
fn dual_limits_are_where_refinement_goes() {
    for id in ["doo-sabin", "catmull-clark-biquadratic"] {
        let (scheme, book) = open(id);
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        let shape = shaken(shapes::prism(5));
        let first = level(&shape);
        let surface = limit(&scheme, &book, &first);
        let (faces, edges) = (first.mesh.faces().len(), first.mesh.edge_count());
        let deep = (0..7).fold(first.clone(), |at, _| refiner.step(&at, Route::Fast).unwrap());
        for vertex in 0..first.mesh.vertices() {
            let face = deep.mesh.faces().face(faces + edges + vertex);
            for corner in face {
                let apart =
                    (0..3).map(|axis| (deep.positions[*corner as usize][axis] - surface.positions[vertex][axis]).abs());
                assert!(apart.fold(0.0, f64::max) < 0.02, "{id}: vertex {vertex}");
            }
            let mean = [0, 1, 2]
                .map(|axis| face.iter().map(|v| deep.positions[*v as usize][axis]).sum::<f64>() / face.len() as f64);
            assert!(
                (0..3).all(|axis| (mean[axis] - surface.positions[vertex][axis]).abs() < 1e-13),
                "{id}: vertex {vertex}"
            );
        }
    }
}

/// Creases that end leave a smooth surface: its limits are found beyond them.
#[test]
fn semi_sharp_creases_are_refined_away_first() {
    let (scheme, book) = open("loop");
    let mut shape = shaken(shapes::torus(5, 6, true));
    shape.creases = (0..6).map(|j| Crease { ends: [j, (j + 1) % 6], sharpness: 1.5 }).collect();
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let limits = Limits::new(&refiner).unwrap();
    assert_eq!(limits.steps_before(&level(&shape)), 2);
    check_levels("loop", &shape, 3, [1e-13, 1e-10]);
}

fn open_meshes(triangles: bool) -> Vec<PolygonSoup> {
    let fans = if triangles { 1..=5 } else { 1..=3 };
    let rest = [shapes::tube(3, 5, triangles), shapes::disc(5, triangles), shapes::grid(3, 3, triangles)];
    rest.into_iter().chain(fans.map(|k| shapes::fan(k, triangles))).collect()
}

/// Tubes, discs, grids, fans: on the boundary as well as inside.
#[test]
fn limits_from_level_0_and_level_4_agree_on_open_meshes() {
    for (id, triangles) in [("loop", true), ("loop-warren", true), ("catmull-clark", false)] {
        for shape in open_meshes(triangles) {
            check_levels(id, &shaken(shape), 4, [1e-13, 1e-10]);
        }
    }
}

/// Creases, a dart at each of their ends, corners where three meet.
#[test]
fn limits_agree_on_creases_darts_and_corners() {
    for (id, shape) in [
        ("loop", shapes::many_valences()),
        ("catmull-clark", shapes::prism(5)),
        ("catmull-clark", shapes::many_valences()),
    ] {
        let mesh = HalfEdgeMesh::new(shape.positions.len(), shape.faces.clone()).unwrap();
        let forever = |ends: [u32; 2]| Crease { ends, sharpness: f64::INFINITY };
        let face = |f: usize| mesh.faces().face(f).to_vec();
        let (a, b) = (face(0), face(3));
        for creases in [
            vec![forever([a[0], a[1]])],
            vec![forever([a[0], a[1]]), forever([a[1], a[2]])],
            vec![forever([a[0], a[1]]), forever([a[1], a[2]]), forever([b[0], b[1]]), forever([b[1], b[2]])],
        ] {
            let shape = shaken(PolygonSoup { creases, ..shape.clone() });
            check_levels(id, &shape, 4, [1e-13, 1e-10]);
        }
        let mut cornered = shaken(shape.clone());
        cornered.corners = vec![2];
        let (scheme, book) = open(id);
        let surface = limit(&scheme, &book, &level(&cornered));
        assert_eq!(surface.positions[2], cornered.positions[2]);
        assert!(surface.without_normal.keys().any(|why| why.contains("no tangent plane")), "a cone has none");
    }
}

/// Where plain boundaries have no tangent plane it is said: k >= 7 triangles, k >= 5 quads. One face fewer, a Jordan block at 1/2 makes
/// normals converge slowly, which is told too.
#[test]
fn a_missing_tangent_plane_is_told() {
    for (id, triangles, most) in [("loop", true, 6), ("catmull-clark", false, 4)] {
        let (scheme, book) = open(id);
        for k in 1..=most + 3 {
            let surface = limit(&scheme, &book, &level(&shaken(shapes::fan(k, triangles))));
            assert_eq!(surface.normals[0] != [0.0; 3], k <= most, "{id}: k = {k}: {:?}", surface.without_normal);
            let told =
                surface.without_normal.iter().any(|(why, (first, _))| *first == 0 && why.contains("no tangent plane"));
            assert_eq!(told, k > most, "{id}: k = {k}");
            let slow = surface.slow_normals.is_some_and(|(first, _)| first == 0);
            assert_eq!(slow, k == most || (!triangles && k == 1), "{id}: k = {k}");
        }
    }
}

/// Two tubes that share a rim share the limits there, to the bit: the crease's mask knows its own points only.
#[test]
fn limits_on_a_shared_boundary_are_the_same() {
    for (id, triangles) in [("loop", true), ("catmull-clark", false)] {
        let (scheme, book) = open(id);
        let below = shaken(shapes::tube(2, 7, triangles));
        let mut above = shapes::tube(3, 7, triangles);
        // the rim, told in another order: turned by two
        for (index, position) in above.positions.iter_mut().enumerate() {
            *position = if index < 7 { below.positions[14 + (index + 2) % 7] } else { position.map(|x| 1.5 * x + 2.0) };
        }
        let (a, b) = (limit(&scheme, &book, &level(&below)), limit(&scheme, &book, &level(&above)));
        for index in 0..7 {
            assert_eq!(a.positions[14 + (index + 2) % 7], b.positions[index], "{id}: {index}");
        }
    }
}

/// Meshes as small or as large as numbers go have normals, too.
#[test]
fn normals_do_not_depend_on_the_size_of_the_mesh() {
    let (scheme, book) = open("loop");
    let shape = shaken(shapes::tetrahedron());
    let one = limit(&scheme, &book, &level(&shape));
    for size in [2.0_f64.powi(-660), 2.0_f64.powi(660)] {
        let scaled =
            PolygonSoup { positions: shape.positions.iter().map(|p| p.map(|x| x * size)).collect(), ..shape.clone() };
        assert_eq!(limit(&scheme, &book, &level(&scaled)).normals, one.normals);
    }
}

/// A place beyond the analysis is told with its vertex.
#[test]
fn a_vertex_without_masks_is_named() {
    let (scheme, book) = open("loop");
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let wrong = Limits::new(&refiner).unwrap().of(&level(&shapes::fan(300, true)), &|| ()).unwrap_err();
    assert!(wrong.to_string().starts_with("vertex 0 has no limit point: the number of faces at a crease"), "{wrong}");
}

/// Warren's 3/(8 n) at n = 3: the cup eigenvalue 5/8 - 3/8 is 1/4, and so is that of frequency 1. Floating numbers don't decide a tie.
#[test]
fn a_tie_is_undecided() {
    let text = "name = \"Tie\"\nmesh = \"triangles\"\nsplit = \"1-to-4\"\n[vertex]\ncentre = \"5/8\"\nring = \"3/(8*n)\"\n\
        [edge]\nends = \"3/8\"\nopposite = \"1/8\"\n";
    let scheme = Scheme::parse("tie", "tie.toml", text).unwrap();
    let refiner = Refiner::new(&scheme, None).unwrap();
    let surface = Limits::new(&refiner).unwrap().of(&level(&shaken(shapes::tetrahedron())), &|| ()).unwrap();
    let told: Vec<&String> = surface.without_normal.keys().collect();
    assert!(
        told.len() == 1 && told[0].starts_with("undecided: 0.250000 of frequency 1 and 0.250000 of frequency 0"),
        "{told:?}"
    );
}
