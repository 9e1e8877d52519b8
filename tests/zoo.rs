//! Do the schemes of several passes, of turning splits and of long stencils do what the literature says of them?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::Analyzer;
use eigenring::analysis::places::Place;
use eigenring::analysis::verify::Verifier;
use eigenring::mesh::{Connectivity, HalfEdgeMesh, Label, Lattice, Patch, PolygonSoup, Tags, shapes, triangulate};
use eigenring::refine::{Level, NotRefinable, Refinement, Refiner, Route, cycle_of, lattice_of};
use eigenring::scheme::{Scheme, catalogue};
use std::collections::BTreeMap;

fn open(id: &str) -> Scheme {
    catalogue::open(id).unwrap().unwrap()
}

fn with(id: &str, name: &str, value: &str) -> Scheme {
    let mut scheme = open(id);
    scheme.set(name, value).unwrap();
    scheme
}

fn level(shape: PolygonSoup) -> Level<f64> {
    let mesh = HalfEdgeMesh::new(shape.positions.len(), shape.faces).unwrap();
    Level { mesh, positions: shape.positions, tags: Tags::default() }
}

/// The shape with every point moved by a little, the same each time.
fn shaken(mut soup: PolygonSoup) -> PolygonSoup {
    let mut state = 0x1234_5678_9abc_def1_u64;
    soup.positions.iter_mut().flatten().for_each(|x| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *x += 0.2 * ((state >> 40) as f64 / (1_u64 << 24) as f64 - 0.5);
    });
    soup
}

/// Closed meshes of mixed valences that a scheme's splits take.
fn closed(scheme: &Scheme) -> Vec<Level<f64>> {
    let shapes = match scheme.mesh.as_str() {
        "triangles" => vec![shapes::many_valences(), shapes::tetrahedron(), shapes::torus(4, 5, true)],
        "quads" => vec![shapes::cube(), shapes::torus(4, 5, false), tripod()],
        _ => vec![shapes::many_valences(), shapes::prism(5), shapes::torus(4, 5, false)],
    };
    shapes.into_iter().map(|shape| level(shaken(shape))).collect()
}

/// Quads around vertices of valences 3, 4 and 5: a prism whose faces are split once.
fn tripod() -> PolygonSoup {
    let scheme = open("catmull-clark");
    let refiner = Refiner::new(&scheme, None).unwrap();
    let fine = refiner.step(&level(shapes::prism(5)), Route::Fast).unwrap();
    PolygonSoup { positions: fine.positions, faces: fine.mesh.faces().clone(), creases: vec![], corners: vec![] }
}

fn largest_difference(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// Each point of one list is a point of the other.
fn same_points(a: &[[f64; 3]], b: &[[f64; 3]]) -> bool {
    let sorted = |points: &[[f64; 3]]| {
        let mut points: Vec<[i64; 3]> = points.iter().map(|p| p.map(|x| (x * 1e9).round() as i64)).collect();
        points.sort_unstable();
        points
    };
    let apart = |(p, q): (&[i64; 3], &[i64; 3])| (0..3).all(|axis| (p[axis] - q[axis]).abs() <= 2);
    a.len() == b.len() && sorted(a).iter().zip(&sorted(b)).all(apart)
}

#[test]
fn the_midpoint_scheme_of_degree_2_is_catmull_and_clarks_biquadratic_one() {
    let (midpoint, biquadratic) = (with("midpoint", "d", "2"), open("catmull-clark-biquadratic"));
    for start in closed(&midpoint) {
        let a = Refiner::new(&midpoint, None).unwrap().step(&start, Route::General).unwrap();
        let b = Refiner::new(&biquadratic, None).unwrap().step(&start, Route::General).unwrap();
        assert!(same_points(&a.positions, &b.positions));
        assert_eq!((a.mesh.faces().len(), a.mesh.edge_count()), (b.mesh.faces().len(), b.mesh.edge_count()));
    }
    for n in 3..=9 {
        let eigenvalues = |scheme: &Scheme| {
            let exact = Analyzer::new(scheme).unwrap().at(n).unwrap().exact.unwrap();
            let own = |e: &eigenring::analysis::exact::ExactEigenvalue| {
                (
                    e.frequency,
                    e.exact.as_ref().unwrap().text.clone(),
                    e.algebraic,
                    e.structure.as_ref().unwrap().largest,
                )
            };
            exact.eigenvalues.iter().map(own).collect::<Vec<_>>()
        };
        assert_eq!(eigenvalues(&midpoint), eigenvalues(&biquadratic), "n = {n}");
    }
}

#[test]
fn one_average_on_triangles_is_loops_scheme_with_warrens_weights() {
    let (averaging, warren) = (open("loop-averaging"), open("loop-warren"));
    for start in closed(&averaging) {
        let a = Refiner::new(&averaging, None).unwrap().step(&start, Route::Fast).unwrap();
        let b = Refiner::new(&warren, None).unwrap().step(&start, Route::Fast).unwrap();
        // an edge point next to an irregular vertex is averaged with six neighbours all the same
        assert!(largest_difference(&a.positions, &b.positions) < 1e-14);
        assert_eq!(a.mesh.faces().len(), b.mesh.faces().len());
    }
}

type Symbol = BTreeMap<(i32, i32), f64>;

fn times(a: &Symbol, b: &Symbol) -> Symbol {
    let mut product = Symbol::new();
    for ((i, j), x) in a {
        for ((k, l), y) in b {
            *product.entry((i + k, j + l)).or_insert(0.0) += x * y;
        }
    }
    product
}

/// A product of factors (1 + z^v)/2 times 4, v among the directions, each so many times.
fn box_spline(directions: &[((i32, i32), usize)]) -> Symbol {
    let mut symbol = Symbol::from([((0, 0), 4.0)]);
    for (direction, times_over) in directions {
        for _ in 0..*times_over {
            symbol = times(&symbol, &Symbol::from([((0, 0), 0.5), (*direction, 0.5)]));
        }
    }
    symbol
}

/// The mask at the regular valence, moved so that its least exponents are 0: the weight of old point p in new point q at q - d p.
fn regular_mask(scheme: &Scheme) -> Symbol {
    let (refinement, lattice) = (Refinement::<f64>::new(scheme, None), lattice_of(scheme));
    let dilation = refinement.cycle().unwrap().dilation;
    let patch = Patch::new(lattice, lattice.regular_valence());
    let mut mask = Symbol::new();
    for (i, j) in (0..dilation).flat_map(|i| (0..dilation).map(move |j| (96 * dilation + i, 96 * dilation + j))) {
        for (old, weight) in refinement.row(&patch, Label { sector: 0, i, j }).unwrap() {
            assert_eq!(old.sector, 0);
            *mask.entry((i - dilation * old.i, j - dilation * old.j)).or_insert(0.0) += weight;
        }
    }
    moved(mask)
}

fn moved(symbol: Symbol) -> Symbol {
    let kept: Symbol = symbol.into_iter().filter(|(_, x)| x.abs() > 1e-14).collect();
    let least = |axis: fn(&(i32, i32)) -> i32| kept.keys().map(axis).min().unwrap();
    let (i, j) = (least(|at| at.0), least(|at| at.1));
    kept.into_iter().map(|(at, x)| ((at.0 - i, at.1 - j), x)).collect()
}

fn assert_same(a: &Symbol, b: &Symbol, of: &str) {
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>(), "{of}");
    for (at, x) in a {
        assert!((x - b[at]).abs() < 1e-13, "{of}: {x} and {} at {at:?}", b[at]);
    }
}

/// On regular meshes the families are box splines: degree d in both directions; m + 1 times the three directions; the
/// Zwart-Powell element and its square.
#[test]
fn regular_masks_are_those_of_box_splines() {
    let [e1, e2, both, cross] = [(1, 0), (0, 1), (1, 1), (1, -1)];
    for d in 2..=9 {
        let scheme = with("midpoint", "d", &d.to_string());
        let expected = moved(box_spline(&[(e1, d + 1), (e2, d + 1)]));
        assert_same(&regular_mask(&scheme), &expected, &format!("midpoint {d}"));
    }
    for m in 1..=4 {
        let scheme = with("loop-averaging", "m", &m.to_string());
        // in these coordinates the third direction is that of the edge from (1, 0) to (0, 1)
        let expected = moved(box_spline(&[(e1, m + 1), (e2, m + 1), (cross, m + 1)]));
        assert_same(&regular_mask(&scheme), &expected, &format!("averaging {m}"));
    }
    assert_same(
        &regular_mask(&open("mid-edge")),
        &moved(box_spline(&[(e1, 1), (e2, 1), (both, 1), (cross, 1)])),
        "mid-edge",
    );
    assert_same(
        &regular_mask(&open("four-eight")),
        &moved(box_spline(&[(e1, 2), (e2, 2), (both, 2), (cross, 2)])),
        "4-8",
    );
}

/// A Jordan block of three at 1/4 in frequency 0, at every valence and the regular one.
#[test]
fn butterfly_has_a_jordan_block_of_three() {
    let scheme = open("butterfly");
    let analyzer = Analyzer::new(&scheme).unwrap();
    for n in 3..=12 {
        let exact = analyzer.at(n).unwrap().exact.unwrap();
        let quarter = |e: &&eigenring::analysis::exact::ExactEigenvalue| {
            e.frequency == 0 && e.exact.as_ref().is_some_and(|words| words.text == "1/4")
        };
        let found = exact.eigenvalues.iter().find(quarter).unwrap();
        assert_eq!(found.structure.as_ref().unwrap().largest, 3, "n = {n}");
    }
    // at n = 8 frequency 2 overtakes
    let eight = analyzer.at(8).unwrap();
    assert_eq!(eight.spectrum.subdominant().unwrap().frequency, 2);
    assert!(eight.lambda.is_none());
    let first = eight.spectrum.largest_of(1).unwrap().modulus();
    assert!(first < eight.spectrum.subdominant().unwrap().modulus() - 1e-3);
}

#[test]
fn mid_edge_at_valence_3_has_a_jordan_block() {
    let scheme = open("mid-edge");
    let exact = Analyzer::new(&scheme).unwrap().at(3).unwrap().exact.unwrap();
    let first = exact.eigenvalues.iter().find(|e| e.frequency == 1).unwrap();
    assert_eq!(first.exact.as_ref().unwrap().text, "1/4");
    assert!(first.structure.as_ref().unwrap().largest >= 2);
}

#[test]
fn steps_and_dilations_are_found() {
    let found = |id: &str| {
        let cycle = cycle_of(&open(id)).unwrap();
        (cycle.steps, cycle.dilation, cycle.lattice())
    };
    assert_eq!(found("loop"), (1, 2, Lattice::Triangles));
    assert_eq!(found("sqrt3"), (2, 3, Lattice::Triangles));
    assert_eq!(found("mid-edge"), (2, 2, Lattice::Dual));
    assert_eq!(found("four-eight"), (2, 2, Lattice::Quads));
    assert_eq!(found("midpoint"), (1, 2, Lattice::Quads));
    assert_eq!(found("kobbelt"), (1, 2, Lattice::Quads));
    let scheme = open("sqrt3");
    let report = eigenring::report::Study::of(&scheme, &[5], false, &|| ()).unwrap().report;
    assert_eq!((report.valences[0].steps, report.valences[0].dilation), (2, 3));
}

/// Around a vertex of any valence with regular vertices beside it, Kobbelt's rules give a face's point by the four-point rule along either
/// of its directions: the virtual point is made for it.
#[test]
fn kobbelts_face_points_are_the_same_both_ways() {
    let scheme = open("kobbelt");
    let refinement = Refinement::<f64>::new(&scheme, None);
    let pass = &refinement.passes()[0];
    for n in [3, 5, 6, 7, 8] {
        let patch = Patch::new(Lattice::Quads, n);
        let start = patch.edge(patch.centre().unwrap(), 0);
        let face = patch.around_face(start);
        let edge_point = |edge| pass.edge_row(&patch, edge).unwrap();
        let across = |edge| {
            let over = patch.next(patch.next(patch.twin(edge)));
            [edge_point(edge), edge_point(over)]
        };
        let way = |from: usize| {
            let mut sum: BTreeMap<Label, f64> = BTreeMap::new();
            for side in [from, from + 2] {
                let [near, far] = across(face[side]);
                near.iter().for_each(|(label, weight)| *sum.entry(*label).or_insert(0.0) += weight * 9.0 / 16.0);
                far.iter().for_each(|(label, weight)| *sum.entry(*label).or_insert(0.0) -= weight / 16.0);
            }
            sum.retain(|_, weight| weight.abs() > 1e-15);
            sum
        };
        let (one, other) = (way(0), way(1));
        let row = pass.face_row(&patch, start).unwrap();
        assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>(), "n = {n}");
        for ((label, weight), mean) in one.iter().zip(row.iter().filter(|(_, weight)| weight.abs() > 1e-15)) {
            assert!((weight - other[label]).abs() < 1e-15 && (weight - mean.1).abs() < 1e-15, "n = {n} {label:?}");
        }
    }
}

/// Every scheme on closed meshes: limits of level 0 and of later levels are the same, and masks agree with deep refinement.
#[test]
fn masks_of_every_scheme_hold_on_meshes() {
    let families =
        [("midpoint", "d", "2"), ("midpoint", "d", "4"), ("midpoint", "d", "5"), ("loop-averaging", "m", "2")];
    let schemes = catalogue::SCHEMES.iter().map(|listed| open(listed.id));
    for scheme in schemes.chain(families.map(|(id, name, value)| with(id, name, value))) {
        let refiner = Refiner::new(&scheme, None).unwrap();
        let verifier = Verifier::new(&refiner).unwrap();
        for start in closed(&scheme) {
            let found = verifier.levels(&start, 2).unwrap();
            assert!(found.agrees, "{}: {found:?}", scheme.id);
        }
        for n in [3, 5, 7] {
            let place = Place::Inside(n);
            let masks = verifier.masks(place).unwrap();
            let check = verifier.check(place, &masks, 1, 7).unwrap();
            assert!(check.agrees, "{} n = {n}: {check:?}", scheme.id);
        }
    }
}

/// The composed rows of a step are what refining does, pass after pass.
#[test]
fn rows_of_a_step_are_the_product_of_those_of_its_passes() {
    for scheme in [with("midpoint", "d", "4"), with("loop-averaging", "m", "3"), open("sqrt3"), open("four-eight")] {
        let refiner = Refiner::new(&scheme, None).unwrap();
        for start in closed(&scheme) {
            let fine = refiner.step(&start, Route::Fast).unwrap();
            let rows = refiner.rows(&start.mesh, &start.tags).unwrap();
            let applied: Vec<[f64; 3]> =
                rows.iter().map(|row| eigenring::refine::applied(row, &start.positions)).collect();
            assert!(largest_difference(&applied, &fine.positions) < 1e-13, "{}", scheme.id);
            assert!(rows.iter().all(|row| (row.iter().map(|(_, w)| w).sum::<f64>() - 1.0).abs() < 1e-13));
            assert!(fine.mesh.validate().is_ok());
        }
    }
}

#[test]
fn meshes_that_a_split_cannot_take_are_refused() {
    let refused = |id: &str, shape: PolygonSoup| {
        let scheme = open(id);
        Refiner::new(&scheme, None).unwrap().step(&level(shape), Route::Fast).unwrap_err()
    };
    assert_eq!(refused("sqrt3", shapes::cube()), NotRefinable::Face { face: 0, corners: 4, needed: 3 });
    assert_eq!(refused("kobbelt", shapes::tetrahedron()), NotRefinable::Face { face: 0, corners: 3, needed: 4 });
    // without rules for the boundary
    assert!(matches!(refused("sqrt3", shapes::tube(3, 4, true)), NotRefinable::Boundary(_)));
    assert!(matches!(refused("four-eight", shapes::tube(3, 4, false)), NotRefinable::Boundary(_)));
    // cut into triangles it is taken
    let scheme = open("sqrt3");
    let cut = triangulate(shapes::cube()).0;
    assert_eq!(Refiner::new(&scheme, None).unwrap().step(&level(cut), Route::Fast).unwrap().mesh.faces().len(), 36);
}

/// On an open mesh the boundary recedes under dual and mid-edge splits, and what is left is a mesh.
#[test]
fn boundaries_recede_under_dual_splits() {
    for (id, shape) in [("mid-edge", shapes::tube(4, 6, false)), ("midpoint", shapes::tube(6, 8, false))] {
        let scheme = open(id);
        let refiner = Refiner::new(&scheme, None).unwrap();
        let mut at = level(shape);
        for _ in 0..3 {
            at = refiner.step(&at, Route::Fast).unwrap();
            at.mesh.validate().unwrap();
            assert!(!at.mesh.is_closed());
        }
        // affine maps go through: points of a plane stay in it
        let flat = at.positions.iter().all(|p| p.iter().all(|x| x.is_finite()));
        assert!(flat, "{id}");
    }
}

/// Along a boundary sqrt3 leaves points alone in every other step and cuts edges into three in the next: two steps are one of the ternary cubic
/// B-spline, whose mask is (1, 4, 10, 16, 19, 16, 10, 4, 1)/27. 4-8 halves them: the binary one, (1, 4, 6, 4, 1)/8.
#[test]
fn the_boundary_is_a_cubic_spline_every_second_step() {
    for (id, rules, triangles, mask) in [
        ("sqrt3", "thirds", true, &[1.0, 4.0, 10.0, 16.0, 19.0, 16.0, 10.0, 4.0, 1.0].map(|w| w / 27.0)[..]),
        ("four-eight", "cubic", false, &[1.0, 4.0, 6.0, 4.0, 1.0].map(|w| w / 8.0)[..]),
    ] {
        for shape in [shapes::tube(4, 5, triangles), shapes::disc(5, triangles)] {
            boundary_is_a_spline(id, rules, shape, mask);
        }
    }
}

/// `mask` is that of a symmetric scheme of the arity with which the boundary's edges are cut, about its middle.
fn boundary_is_a_spline(id: &str, rules: &str, shape: PolygonSoup, mask: &[f64]) {
    let scheme = open(id);
    let book = catalogue::boundary(rules, &scheme.mesh).unwrap().unwrap();
    let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
    let (arity, middle) = ((mask.len() - 1) / 4 + 1, (mask.len() / 2) as i64);
    let start = level(shaken(shape));
    let rings = |at: &Level<f64>| {
        // the boundary's curves, each from its lowest vertex on
        let mesh = &at.mesh;
        let next = |vertex: u32| mesh.target(mesh.vertex_edges()[vertex as usize]);
        let on = |vertex: &u32| mesh.boundary_at(mesh.vertex_edges()[*vertex as usize]).is_some();
        let mut left: Vec<u32> = (0..mesh.vertices() as u32).filter(on).collect();
        let mut rings: Vec<Vec<u32>> = Vec::new();
        while let Some(first) = left.first().copied() {
            let mut ring = vec![first];
            while next(ring[ring.len() - 1]) != first {
                ring.push(next(ring[ring.len() - 1]));
            }
            left.retain(|vertex| !ring.contains(vertex));
            rings.push(ring);
        }
        rings
    };
    let one = refiner.step(&start, Route::Fast).unwrap();
    let before = rings(&start);
    assert_eq!(rings(&one), before);
    assert!(before.iter().flatten().all(|v| one.positions[*v as usize] == start.positions[*v as usize]));
    let two = refiner.step(&one, Route::Fast).unwrap();
    two.mesh.validate().unwrap();
    assert_eq!(two.mesh.euler_characteristic(), start.mesh.euler_characteristic());
    let after = rings(&two);
    assert_eq!(after.len(), before.len());
    for (old, new) in before.iter().zip(&after) {
        assert_eq!(new.len(), arity * old.len());
        let m = old.len() as i64;
        for (at, vertex) in (0..).zip(new) {
            for axis in 0..3 {
                // p'_i is the sum of mask[i - arity j] p_j
                let own = (-m..2 * m).filter_map(|j| {
                    let weight = mask.get(usize::try_from(at - arity as i64 * j + middle).ok()?)?;
                    Some(weight * start.positions[old[j.rem_euclid(m) as usize] as usize][axis])
                });
                let expected: f64 = own.sum();
                assert!((two.positions[*vertex as usize][axis] - expected).abs() < 1e-14, "{id}");
            }
        }
    }
    // new vertices on the boundary are regular
    let faces = |v: &u32| two.mesh.valence(two.mesh.vertex_edges()[*v as usize]) - 1;
    let new = after.iter().flat_map(|ring| ring.iter().enumerate().filter(|(at, _)| at % arity != 0));
    assert!(new.map(|(_, vertex)| faces(vertex)).all(|count| count == scheme.regular_valence() / 2));
}
