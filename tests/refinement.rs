//! Does a step of refinement make the mesh that it should, by both routes, with creases and boundaries?
#![allow(clippy::unwrap_used)]

mod shared;

use eigenring::mesh::{
    Connectivity, Crease, Faces, HalfEdgeMesh, LinkedMesh, PolygonSoup, Tags, edge_between, first_corner, shapes,
};
use eigenring::refine::{Level, NotRefinable, Refiner, Route, most_ulps};
use eigenring::scheme::{Scheme, catalogue};
use shared::{level, open};
use std::collections::BTreeMap;

fn triangle_shapes() -> Vec<PolygonSoup> {
    let discs = [3, 4, 5, 8].map(|n| shapes::disc(n, true));
    let fans = [1, 2, 3, 4, 7].map(|k| shapes::fan(k, true));
    let closed = [shapes::tetrahedron(), shapes::many_valences(), shapes::torus(4, 5, true)];
    let open = [shapes::tube(3, 5, true), shapes::grid(3, 2, true)];
    closed.into_iter().chain(open).chain(discs).chain(fans).collect()
}

fn polygon_shapes() -> Vec<PolygonSoup> {
    let discs = [3, 5, 6].map(|n| shapes::disc(n, false));
    let quads = [shapes::cube(), shapes::torus(4, 5, false), shapes::tube(3, 5, false), shapes::grid(3, 2, false)];
    let mixed = [shapes::prism(3), shapes::prism(7), shapes::prism(70), shapes::many_valences()];
    let fans = [1, 2, 3, 4].map(|k| shapes::fan(k, false));
    quads.into_iter().chain(mixed).chain(discs).chain(fans).collect()
}

/// Every scheme of the catalogue with shapes that it refines; those without boundary rules get closed ones.
fn cases() -> Vec<(&'static str, Vec<PolygonSoup>)> {
    let closed = |shapes: Vec<PolygonSoup>| {
        shapes
            .into_iter()
            .filter(|soup| HalfEdgeMesh::new(soup.positions.len(), soup.faces.clone()).unwrap().is_closed())
            .collect()
    };
    vec![
        ("loop", triangle_shapes()),
        ("loop-warren", triangle_shapes()),
        ("modified-butterfly", closed(triangle_shapes())),
        ("catmull-clark", polygon_shapes()),
        ("doo-sabin", polygon_shapes()),
        ("catmull-clark-biquadratic", polygon_shapes()),
    ]
}

/// Twins by arithmetic are the twins that a search for them finds, at each of three steps.
#[test]
fn the_new_mesh_is_the_one_that_its_faces_make() {
    for (id, shapes) in cases() {
        let (scheme, book) = open(id);
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        for (index, shape) in shapes.iter().enumerate() {
            let mut at = level(shape);
            for step in 0..3 {
                let last = refiner.finish(at.clone(), Route::Fast).unwrap();
                at = refiner.step(&at, Route::Fast).unwrap();
                assert!(last.faces == *at.mesh.faces() && last.positions == at.positions, "{id} {index} {step}");
                at.mesh.validate().unwrap_or_else(|wrong| panic!("{id} {index} {step}: {wrong}"));
                let found = HalfEdgeMesh::new(at.mesh.vertices(), at.mesh.faces().clone()).unwrap();
                assert_eq!(found.twins(), at.mesh.twins(), "{id}, shape {index}, step {step}");
                for (vertex, h) in at.mesh.vertex_edges().iter().enumerate() {
                    let boundary = at.mesh.boundary_at(*h);
                    assert!(boundary.is_none_or(|edge| at.mesh.turn(edge) == *h), "{id}: the fan of {vertex}");
                }
                if at.mesh.faces().len() > 3000 {
                    break;
                }
            }
        }
    }
}

/// Loop: n + e vertices and 4 f faces; Catmull-Clark: n + e + f and 2 e on closed meshes (and one for each corner on all); dual: a
/// vertex for each corner, a face for each face, edge and vertex.
#[test]
fn vertices_edges_and_faces_count_as_the_documents_state() {
    for (id, shapes) in cases() {
        let (scheme, book) = open(id);
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        for shape in &shapes {
            let old = level(shape);
            let new = refiner.step(&old, Route::Fast).unwrap();
            let (n, e, f) = (old.mesh.vertices(), old.mesh.edge_count(), old.mesh.faces().len());
            let corners = old.mesh.faces().corners().len();
            let counts = (new.mesh.vertices(), new.mesh.faces().len());
            match scheme.split.as_str() {
                "1-to-4" => assert_eq!(counts, (n + e, 4 * f)),
                "1-to-n" => assert_eq!(counts, (n + e + f, corners)),
                _ if old.mesh.is_closed() => assert_eq!(counts, (corners, f + e + n)),
                _ => assert_eq!(counts.0, corners),
            }
            if scheme.split == "1-to-n" && old.mesh.is_closed() {
                assert_eq!(counts.1, 2 * e);
            }
            assert_eq!(new.mesh.euler_characteristic(), old.mesh.euler_characteristic(), "{id}");
            assert_eq!(new.positions.len(), new.mesh.vertices());
        }
    }
}

/// After one Catmull-Clark step all faces are quads; valences of old vertices stay, and so does the number of extraordinary points.
#[test]
fn catmull_clark_makes_quads_and_keeps_extraordinary_points() {
    let (scheme, book) = open("catmull-clark");
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let extraordinary = |mesh: &HalfEdgeMesh| {
        mesh.vertex_edges().iter().filter(|h| mesh.boundary_at(**h).is_none() && mesh.valence(**h) != 4).count()
    };
    for shape in polygon_shapes() {
        let old = level(&shape);
        let once = refiner.step(&old, Route::Fast).unwrap();
        assert_eq!(once.mesh.faces().same_size(), Some(4));
        let twice = refiner.step(&once, Route::Fast).unwrap();
        assert_eq!(extraordinary(&once.mesh), extraordinary(&twice.mesh));
        for vertex in 0..old.mesh.vertices() {
            let valence = |level: &Level<f64>| level.mesh.valence(level.mesh.vertex_edges()[vertex]);
            assert_eq!(valence(&old), valence(&once));
            assert_eq!(valence(&once), valence(&twice));
        }
    }
}

/// sum |w p| of every row, axis by axis: the scale that rounding is measured by.
fn scales(refiner: &Refiner, level: &Level<f64>) -> Vec<([f64; 3], f64)> {
    let rows = refiner.rows(&level.mesh, &level.tags).unwrap();
    let scale = |axis: usize, row: &[(u32, f64)]| {
        row.iter().map(|(point, weight)| (weight * level.positions[*point as usize][axis]).abs()).sum::<f64>()
    };
    rows.iter().map(|row| ([0, 1, 2].map(|axis| scale(axis, row)), most_ulps(row.len()))).collect()
}

#[test]
fn both_routes_give_the_same_mesh_and_positions_to_rounding() {
    for (id, mut shapes) in cases() {
        let (scheme, book) = open(id);
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        if scheme.split != "dual" {
            shapes.extend(creased(&scheme));
        }
        for (index, shape) in shapes.iter().enumerate() {
            let mut at = level(shape);
            for step in 0..2 {
                let (fast, rows) =
                    (refiner.step(&at, Route::Fast).unwrap(), refiner.step(&at, Route::General).unwrap());
                assert!(fast.mesh == rows.mesh && fast.tags == rows.tags, "{id}, shape {index}, step {step}");
                let single = Level {
                    mesh: at.mesh.clone(),
                    positions: at.positions.iter().map(|p| p.map(|x| x as f32)).collect(),
                    tags: at.tags.clone(),
                };
                let same =
                    Level { positions: single.positions.iter().map(|p| p.map(f64::from)).collect(), ..at.clone() };
                let (exact, single) =
                    (refiner.step(&same, Route::General).unwrap(), refiner.step(&single, Route::Fast).unwrap());
                for (point, (scale, ulps)) in scales(&refiner, &at).iter().enumerate() {
                    for (axis, scale) in scale.iter().enumerate() {
                        let apart = (fast.positions[point][axis] - rows.positions[point][axis]).abs();
                        assert!(apart <= ulps * f64::EPSILON * scale, "{id}, shape {index}, point {point}: {apart}");
                        let apart = (f64::from(single.positions[point][axis]) - exact.positions[point][axis]).abs();
                        let bound = 1.01 * ulps * f64::from(f32::EPSILON) * scale + 1e-300;
                        assert!(apart <= bound, "{id}, shape {index}, point {point} in f32: {apart}");
                    }
                }
                at = fast;
            }
        }
    }
}

/// Shapes with creases for ever, for a while and for a fraction of a step, a dart, and a corner.
fn creased(scheme: &Scheme) -> Vec<PolygonSoup> {
    let mut shape = if scheme.mesh == "triangles" { shapes::many_valences() } else { shapes::prism(7) };
    let ends: Vec<[u32; 2]> = shape.faces.iter().map(|face| [face[0], face[1]]).collect();
    let sharpness = [f64::INFINITY, 2.0, 0.5, 1.25, f64::INFINITY];
    shape.creases = ends.into_iter().zip(sharpness).map(|(ends, sharpness)| Crease { ends, sharpness }).collect();
    shape.corners = vec![5];
    vec![shape]
}

/// The threads share out the work, and never the sums.
#[test]
fn positions_are_the_same_to_the_bit_for_any_number_of_threads() {
    for (id, shape) in [
        ("loop", shapes::torus(10, 12, true)),
        ("catmull-clark", shapes::prism(9)),
        ("doo-sabin", shapes::prism(9)),
        ("modified-butterfly", shapes::many_valences()),
    ] {
        let (scheme, book) = open(id);
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        for route in [Route::Fast, Route::General] {
            let refined = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| (0..4).fold(level(&shape), |at, _| refiner.step(&at, route).unwrap()))
            };
            let one = refined(1);
            assert!(one.mesh.vertices() > 1000, "enough to share");
            assert!(refined(2) == one && refined(5) == one, "{id} {route:?}");
        }
    }
}

fn affine(p: [f64; 3]) -> [f64; 3] {
    [
        0.5 * p[0] - 1.5 * p[1] + 0.25 * p[2] + 3.0,
        1.25 * p[0] + 0.75 * p[1] - p[2] - 2.0,
        -0.5 * p[0] + p[1] + 2.0 * p[2] + 1.0,
    ]
}

#[test]
fn an_affine_map_commutes_with_refinement() {
    for (id, shapes) in cases() {
        let (scheme, book) = open(id);
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        for shape in &shapes {
            let at = level(shape);
            let moved = Level { positions: at.positions.iter().map(|p| affine(*p)).collect(), ..at.clone() };
            let (after, before) = (refiner.step(&at, Route::Fast).unwrap(), refiner.step(&moved, Route::Fast).unwrap());
            for (a, b) in after.positions.iter().zip(&before.positions) {
                assert!((0..3).all(|axis| (affine(*a)[axis] - b[axis]).abs() < 1e-13), "{id}: {a:?}");
            }
        }
    }
}

/// The points of a mesh told apart by their values alone, to far below their distances.
fn as_set(level: &Level<f64>) -> BTreeMap<[i64; 3], usize> {
    let mut set = BTreeMap::new();
    for position in &level.positions {
        *set.entry(position.map(|x| (x * 1e9).round() as i64)).or_insert(0) += 1;
    }
    set
}

#[test]
fn a_relabelling_changes_nothing_but_order() {
    for (id, shapes) in cases() {
        let (scheme, book) = open(id);
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        for (index, shape) in shapes.iter().enumerate() {
            // an offset keeps values off the places where rounding goes either way
            let positions: Vec<[f64; 3]> = shape
                .positions
                .iter()
                .enumerate()
                .map(|(i, p)| {
                    [p[0] + 1e-3 * i as f64 + 1.234_567_890_12e-4, p[1] + 2.345_678_912_3e-4, p[2] + 3.456_789_123_4e-4]
                })
                .collect();
            let shape = PolygonSoup { positions, ..shape.clone() };
            let count = shape.positions.len();
            let renamed = |vertex: u32| (count - 1 - vertex as usize) as u32;
            let faces: Vec<Vec<usize>> = shape
                .faces
                .iter()
                .collect::<Vec<_>>()
                .into_iter()
                .rev()
                .map(|face| {
                    let mut face: Vec<usize> = face.iter().map(|v| renamed(*v) as usize).collect();
                    face.rotate_left(1);
                    face
                })
                .collect();
            let positions = shape.positions.iter().rev().copied().collect();
            let other = PolygonSoup { positions, faces: Faces::from_lists(&faces), creases: vec![], corners: vec![] };
            let refined = |soup: &PolygonSoup| {
                refiner.step(&refiner.step(&level(soup), Route::Fast).unwrap(), Route::Fast).unwrap()
            };
            assert_eq!(as_set(&refined(&shape)), as_set(&refined(&other)), "{id}, shape {index}");
        }
    }
}

/// A renamed copy of a file goes the same way as the file of the catalogue: told by its rules, not by its name.
#[test]
fn a_renamed_copy_takes_the_same_route() {
    for id in ["loop", "catmull-clark", "doo-sabin"] {
        let listed = catalogue::scheme(id).unwrap();
        let renamed = listed.text.replacen("name ", "name = \"Mine\"\n# ", 1);
        let copy = Scheme::parse("mine", "mine.toml", &renamed).unwrap();
        let (scheme, book) = open(id);
        let (own, other) = (Refiner::new(&copy, Some(&book)).unwrap(), Refiner::new(&scheme, Some(&book)).unwrap());
        assert!(own.is_compact() && other.is_compact(), "{id}");
        let shape = if id == "loop" { shapes::many_valences() } else { shapes::prism(7) };
        assert_eq!(own.step(&level(&shape), Route::Fast).unwrap(), other.step(&level(&shape), Route::Fast).unwrap());
    }
    let (butterfly, _) = open("modified-butterfly");
    assert!(!Refiner::new(&butterfly, None).unwrap().is_compact());
}

#[test]
fn a_boundary_depends_on_its_own_points_only() {
    for (id, triangles) in [("loop", true), ("catmull-clark", false)] {
        let (scheme, book) = open(id);
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        // two tubes that share a rim: below and above it
        let below = shapes::tube(2, 7, triangles);
        let mut above = shapes::tube(3, 7, triangles);
        let rim = below.positions[14..21].to_vec();
        for (index, position) in above.positions.iter_mut().enumerate() {
            *position =
                if index < 7 { rim[index] } else { [1.5 * position[0] + 0.3, position[1] - 0.2, position[2] + 2.5] };
        }
        let refined = |shape: &PolygonSoup| (0..3).fold(level(shape), |at, _| refiner.step(&at, Route::Fast).unwrap());
        let on_boundary = |level: &Level<f64>| {
            let at =
                level.mesh.vertex_edges().iter().enumerate().filter(|(_, h)| level.mesh.boundary_at(**h).is_some());
            at.map(|(vertex, _)| level.positions[vertex].map(f64::to_bits)).collect::<std::collections::BTreeSet<_>>()
        };
        let (a, b) = (on_boundary(&refined(&below)), on_boundary(&refined(&above)));
        assert_eq!(a.intersection(&b).count(), 7 * 8, "{id}: every point of the shared rim, to the bit");
    }
}

/// The largest difference of a coordinate.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(&b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// Creases by the cubic rules: (1/8, 3/4, 1/8) and (1/2, 1/2), and by the fraction where they end within a step.
#[test]
fn creases_last_for_their_sharpness() {
    let (scheme, book) = open("loop");
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let smooth_shape = shapes::torus(4, 5, true);
    let with = |sharpness: f64| {
        let mut shape = smooth_shape.clone();
        // a closed crease along one ring: vertices 0..5
        shape.creases = (0..5).map(|j| Crease { ends: [j, (j + 1) % 5], sharpness }).collect();
        refiner.step(&level(&shape), Route::Fast).unwrap()
    };
    let (smooth, sharp) = (refiner.step(&level(&smooth_shape), Route::Fast).unwrap(), with(f64::INFINITY));
    let p = &smooth_shape.positions;
    let vertex = [0, 1, 2].map(|axis| 0.75 * p[1][axis] + 0.125 * (p[0][axis] + p[2][axis]));
    let edge = [0, 1, 2].map(|axis| 0.5 * (p[0][axis] + p[1][axis]));
    let at = level(&smooth_shape).mesh;
    let first = edge_between(&at, [0, 1]).map(|edge| first_corner(&at, edge)).unwrap();
    let on_edge = p.len() + at.edges().position(|edge| edge == first).unwrap();
    assert!(apart(sharp.positions[1], vertex) < 1e-15 && apart(sharp.positions[on_edge], edge) < 1e-15);
    let parts = [(0.25, 0.25), (0.5, 0.5), (1.0, 1.0), (1.5, 1.0)];
    for (sharpness, share) in parts {
        let mixed = with(sharpness);
        for (index, position) in mixed.positions.iter().enumerate() {
            let (a, b) = (sharp.positions[index], smooth.positions[index]);
            let wanted = [0, 1, 2].map(|axis| share * a[axis] + (1.0 - share) * b[axis]);
            assert!(apart(*position, wanted) < 1e-14, "sharpness {sharpness}, point {index}");
        }
    }
    assert_eq!(with(1.0).tags, Tags::default());
    assert_eq!(with(1.5).tags.creases().len(), 10);
    assert!(with(1.5).tags.creases().iter().all(|(_, sharpness)| *sharpness == 0.5));
    assert!(with(f64::INFINITY).tags.creases().iter().all(|(_, sharpness)| sharpness.is_infinite()));
}

/// Where one crease ends, a vertex is smooth (a dart); where three meet, it stays.
#[test]
fn darts_are_smooth_and_three_creases_make_a_corner() {
    let (scheme, book) = open("loop");
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let shape = shapes::many_valences();
    let smooth = refiner.step(&level(&shape), Route::Fast).unwrap();
    let tagged = |ends: &[[u32; 2]]| {
        let creases = ends.iter().map(|ends| Crease { ends: *ends, sharpness: f64::INFINITY }).collect();
        refiner.step(&level(&PolygonSoup { creases, ..shape.clone() }), Route::Fast).unwrap()
    };
    let neighbours: Vec<u32> = {
        let at = level(&shape);
        at.mesh.around_vertex(at.mesh.vertex_edges()[5]).iter().map(|h| at.mesh.target(*h)).collect()
    };
    let dart = tagged(&[[5, neighbours[0]]]);
    assert!(apart(dart.positions[5], smooth.positions[5]) < 1e-15);
    let corner = tagged(&[[5, neighbours[0]], [5, neighbours[2]], [5, neighbours[3]]]);
    assert_eq!(corner.positions[5], shape.positions[5]);
    assert_ne!(smooth.positions[5], shape.positions[5]);
    let boundary_corner = level(&shapes::fan(1, true));
    let tags = Tags::default().with_boundary_corners(&boundary_corner.mesh);
    assert_eq!(tags.corners(), [0, 1, 2], "--boundary corner keeps the corners of a single triangle");
    let new = refiner.step(&Level { tags, ..boundary_corner.clone() }, Route::Fast).unwrap();
    assert_eq!(new.positions[..3], boundary_corner.positions[..]);
}

#[test]
fn meshes_that_a_split_cannot_take_are_refused() {
    let (scheme, book) = open("loop");
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let mut faces: Vec<Vec<usize>> = vec![vec![0, 1, 2], vec![0, 2, 3, 4]];
    let positions = vec![[0.0; 3]; 5];
    let refused = |faces: &[Vec<usize>]| {
        let mesh = HalfEdgeMesh::from_faces(5, faces).unwrap();
        refiner.step(&Level { mesh, positions: positions.clone(), tags: Tags::default() }, Route::Fast).unwrap_err()
    };
    assert_eq!(refused(&faces), NotRefinable::Face { face: 1, corners: 4, needed: 3 });
    faces.swap(0, 1);
    assert_eq!(refused(&faces), NotRefinable::Face { face: 0, corners: 4, needed: 3 });
    let (dual, _) = open("doo-sabin");
    let mut shape = shapes::cube();
    shape.corners = vec![0];
    assert_eq!(Refiner::new(&dual, None).unwrap().step(&level(&shape), Route::Fast).unwrap_err(), NotRefinable::Tags);
    let (butterfly, _) = open("modified-butterfly");
    let open_mesh = level(&shapes::grid(2, 2, true));
    let wrong = Refiner::new(&butterfly, None).unwrap().step(&open_mesh, Route::Fast).unwrap_err();
    assert!(wrong.to_string().contains("[vertex.crease]"), "{wrong}");
}

/// A polygon of 64 corners, the sum over which loses digits in 32 bits, and one of a thousand: faces have no largest size.
#[test]
fn large_faces_stay_within_their_bound() {
    let (scheme, book) = open("catmull-clark");
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    for n in [64, 1000] {
        let mut soup = shapes::prism(n);
        for (index, position) in soup.positions.iter_mut().enumerate() {
            *position = position.map(|x| f64::from((x + 3.0) as f32));
            position[2] = if index % n == 0 { 1.0 } else { f64::from(1.01 * 2.0_f32.powi(-24)) };
        }
        let double = level(&soup);
        let positions = soup.positions.iter().map(|p| p.map(|x| x as f32)).collect();
        let single = Level { mesh: double.mesh.clone(), positions, tags: Tags::default() };
        let (exact, single) =
            (refiner.step(&double, Route::General).unwrap(), refiner.step(&single, Route::Fast).unwrap());
        for (point, (scale, ulps)) in scales(&refiner, &double).iter().enumerate() {
            for (axis, scale) in scale.iter().enumerate() {
                let apart = (f64::from(single.positions[point][axis]) - exact.positions[point][axis]).abs();
                assert!(apart <= 1.01 * ulps * f64::from(f32::EPSILON) * scale, "{n}, point {point}: {apart}");
            }
        }
    }
}

/// A cube with a vertex of two edges: primal splits take it, a dual one would make a face of two corners.
#[test]
fn a_vertex_of_two_edges_is_refined_or_refused() {
    let cube = shapes::cube();
    let mut cut = LinkedMesh::from(&level(&cube).mesh);
    cut.split_edge(0).unwrap();
    let mesh = HalfEdgeMesh::new(9, cut.faces()).unwrap();
    let mut positions = cube.positions;
    positions.push([0.3, 1.1, -0.9]);
    let at = Level { mesh, positions, tags: Tags::default() };
    let (scheme, book) = open("catmull-clark");
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let (fast, rows) = (refiner.step(&at, Route::Fast).unwrap(), refiner.step(&at, Route::General).unwrap());
    fast.mesh.validate().unwrap();
    assert!(fast.mesh == rows.mesh && fast.positions.iter().zip(&rows.positions).all(|(a, b)| apart(*a, *b) < 1e-14));
    let (dual, _) = open("doo-sabin");
    let refused = Refiner::new(&dual, None).unwrap().step(&at, Route::Fast).unwrap_err();
    assert_eq!(refused, NotRefinable::TwoEdges(8));
}

/// Valences beyond the tables, and more than a thousand.
#[test]
fn a_vertex_of_a_thousand_edges_is_refined() {
    for (id, triangles) in [("loop", true), ("catmull-clark", false), ("doo-sabin", false)] {
        let (scheme, book) = open(id);
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        let at = level(&shapes::disc(1000, triangles));
        let new = refiner.step(&at, Route::Fast).unwrap();
        let rows = refiner.rows(&at.mesh, &at.tags).unwrap();
        assert!(rows.iter().any(|row| row.len() > 1000) || id == "doo-sabin");
        let centre = &rows[0];
        let sum: f64 = centre.iter().map(|(_, weight)| weight).sum();
        assert!((sum - 1.0).abs() < 1e-13);
        let slow = refiner.step(&at, Route::General).unwrap();
        assert_eq!(new.mesh, slow.mesh);
        for (a, b) in new.positions.iter().zip(&slow.positions) {
            assert!(apart(*a, *b) < 1e-12, "{id}");
        }
    }
}

/// A face as a cycle of names, from its least on.
fn cycle(mut names: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    let least = (0..names.len()).min_by_key(|at| &names[*at]).unwrap();
    names.rotate_left(least);
    names
}

/// New vertices by where they are born: the vertex, both ends of the edge, all corners of the face, in order.
fn named_faces(faces: &Faces, names: &[Vec<u32>]) -> Vec<Vec<Vec<u32>>> {
    let mut cycles: Vec<_> =
        faces.iter().map(|face| cycle(face.iter().map(|v| names[*v as usize].clone()).collect())).collect();
    cycles.sort();
    cycles
}

fn sorted(mut name: Vec<u32>) -> Vec<u32> {
    name.sort_unstable();
    name
}

/// The names of the points that a step makes.
fn birth_names(mesh: &HalfEdgeMesh, with_faces: bool) -> Vec<Vec<u32>> {
    let mut names: Vec<Vec<u32>> = (0..mesh.vertices() as u32).map(|vertex| vec![vertex]).collect();
    names.extend(mesh.edges().map(|h| sorted(vec![mesh.origin(h), mesh.target(h)])));
    names.extend(mesh.faces().iter().filter(|_| with_faces).map(|face| sorted(face.to_vec())));
    names
}

/// Splits every edge; gives the names of all vertices, and for each old face the half-edges that lead to its new vertices.
fn split_all_edges(mesh: &mut LinkedMesh) -> (Vec<Vec<u32>>, Vec<Vec<u32>>) {
    let (vertices, edges, faces) = (mesh.vertices(), mesh.half_edges() as u32, mesh.face_edges().to_vec());
    let mut names: Vec<Vec<u32>> = (0..vertices as u32).map(|vertex| vec![vertex]).collect();
    for h in (0..edges).step_by(2) {
        names.push(sorted(vec![mesh.origin(h), mesh.target(h)]));
        mesh.split_edge(h).unwrap();
    }
    let leads_to_new = |h: &u32| mesh.target(*h) as usize >= vertices;
    let around = faces.iter().map(|h| mesh.around_face(*h).into_iter().filter(leads_to_new).collect());
    (names, around.collect())
}

#[test]
fn loop_by_splitting_edges_and_faces_gives_the_same_connectivity() {
    let (scheme, book) = open("loop");
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    for shape in triangle_shapes() {
        let at = level(&shape);
        let mut cut = LinkedMesh::from(&at.mesh);
        let (names, around) = split_all_edges(&mut cut);
        for edges in around {
            // between the middles of neighbouring edges, three times around
            for (h, g) in [(edges[0], edges[1]), (edges[1], edges[2]), (edges[2], edges[0])] {
                let h = if cut.face(h) == cut.face(g) { h } else { last_to(&cut, g, cut.target(h)) };
                cut.split_face(h, g).unwrap();
            }
        }
        cut.validate().unwrap();
        let new = refiner.step(&at, Route::Fast).unwrap();
        assert_eq!(named_faces(&cut.faces(), &names), named_faces(new.mesh.faces(), &birth_names(&at.mesh, false)));
    }
}

/// The half-edge in the face of g that leads to a vertex.
fn last_to(mesh: &LinkedMesh, g: u32, vertex: u32) -> u32 {
    mesh.around_face(g).into_iter().find(|h| mesh.target(*h) == vertex).unwrap()
}

#[test]
fn catmull_clark_by_splitting_edges_and_faces_gives_the_same_connectivity() {
    let (scheme, book) = open("catmull-clark");
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    for shape in polygon_shapes() {
        let at = level(&shape);
        let mut cut = LinkedMesh::from(&at.mesh);
        let (mut names, around) = split_all_edges(&mut cut);
        for (face, edges) in around.iter().enumerate() {
            // an edge across the first corner, a vertex on it, and from there to all other middles
            let across = cut.split_face(edges[0], edges[1]).unwrap();
            cut.split_edge(across).unwrap();
            names.push(sorted(at.mesh.faces().face(face).to_vec()));
            let middle = cut.target(across);
            for g in &edges[2..] {
                let h = last_to(&cut, *g, middle);
                cut.split_face(h, *g).unwrap();
            }
        }
        cut.validate().unwrap();
        let new = refiner.step(&at, Route::Fast).unwrap();
        assert_eq!(named_faces(&cut.faces(), &names), named_faces(new.mesh.faces(), &birth_names(&at.mesh, true)));
    }
}
