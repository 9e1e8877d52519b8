//! Which rows do scheme files make: cases, rules told from an irregular end, points that the same step has made,
//! boundaries, addresses?
#![allow(clippy::unwrap_used)]

use eigenring::mesh::{Connectivity, HalfEdgeMesh, Label, Lattice, Patch, Tagged, Tags};
use eigenring::refine::{Obstacle, Refinement, Row};
use eigenring::scheme::{Scheme, catalogue};

fn open(id: &str) -> Scheme {
    catalogue::open(id).unwrap().unwrap()
}

fn row_on(scheme: &Scheme, patch: Patch, label: Label) -> Row<Label, f64> {
    Refinement::new(scheme, None).row(&patch, label).unwrap()
}

fn weight(row: &Row<Label, f64>, sector: u32, i: i32, j: i32) -> f64 {
    row.iter().find(|(label, _)| *label == Label { sector, i, j }).map_or(0.0, |(_, weight)| *weight)
}

const CENTRE: (u32, i32, i32) = (0, 0, 0);

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-15
}

#[test]
fn modified_butterfly_takes_its_cases_from_an_irregular_end() {
    let scheme = open("modified-butterfly");
    let edge = Label { sector: 0, i: 1, j: 0 };
    let ring = |n: usize| {
        let row = row_on(&scheme, Patch::new(Lattice::Triangles, n), edge);
        assert!(near(weight(&row, CENTRE.0, CENTRE.1, CENTRE.2), 0.75), "n = {n}");
        (0..n as u32).map(|sector| weight(&row, sector, 1, 0)).collect::<Vec<f64>>()
    };
    let all = |found: Vec<f64>, wanted: &[f64]| found.iter().zip(wanted).all(|(a, b)| near(*a, *b));
    assert!(all(ring(3), &[5.0 / 12.0, -1.0 / 12.0, -1.0 / 12.0]));
    assert!(all(ring(4), &[3.0 / 8.0, 0.0, -1.0 / 8.0, 0.0]));
    let sqrt5 = 5.0_f64.sqrt();
    let (c1, c2) = ((sqrt5 - 1.0) / 4.0, (-sqrt5 - 1.0) / 4.0);
    let (far, near_) = ((0.25 + c2 + c1 / 2.0) / 5.0, (0.25 + c1 + c2 / 2.0) / 5.0);
    assert!(all(ring(5), &[0.35, near_, far, far, near_]));
    let regular = row_on(&scheme, Patch::new(Lattice::Triangles, 6), edge);
    assert_eq!(regular.len(), 8, "between regular ends the eight-point stencil, tension 0");
    assert!(near(weight(&regular, 0, 1, 0), 0.5) && near(weight(&regular, 0, 1, 1), -1.0 / 16.0));
}

/// Ends of valence 5 and 5 on a mesh: the results of both are averaged.
#[test]
fn between_two_irregular_ends_the_results_are_averaged() {
    // an icosahedron: every vertex has valence 5
    let faces: [[usize; 3]; 20] = [
        [0, 1, 2],
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 5],
        [0, 5, 1],
        [1, 6, 2],
        [2, 6, 7],
        [2, 7, 3],
        [3, 7, 8],
        [3, 8, 4],
        [4, 8, 9],
        [4, 9, 5],
        [5, 9, 10],
        [5, 10, 1],
        [1, 10, 6],
        [11, 7, 6],
        [11, 8, 7],
        [11, 9, 8],
        [11, 10, 9],
        [11, 6, 10],
    ];
    let faces: Vec<Vec<usize>> = faces.iter().map(|face| face.to_vec()).collect();
    let mesh = HalfEdgeMesh::from_faces(12, &faces).unwrap();
    let scheme = open("modified-butterfly");
    let refinement = Refinement::<f64>::new(&scheme, None);
    for edge in mesh.edges() {
        let row = refinement.passes()[0].edge_row(&mesh, edge).unwrap();
        let at = |point: u32| row.iter().find(|(own, _)| *own == point).map_or(0.0, |(_, weight)| *weight);
        assert!((row.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-15);
        for end in [mesh.origin(edge), mesh.target(edge)] {
            assert!(near(at(end), (0.75 + 0.35) / 2.0));
        }
    }
}

#[test]
fn catmull_clark_in_three_steps_gives_the_known_masks() {
    let scheme = open("catmull-clark");
    let regular = Patch::new(Lattice::Quads, 4);
    let row = row_on(&scheme, regular, Label { sector: 0, i: 0, j: 0 });
    assert!(near(weight(&row, 0, 0, 0), 36.0 / 64.0) && near(weight(&row, 1, 1, 0), 6.0 / 64.0));
    assert!(near(weight(&row, 2, 1, 1), 1.0 / 64.0) && row.len() == 9);
    let edge = row_on(&scheme, regular, Label { sector: 0, i: 1, j: 0 });
    assert!(near(weight(&edge, 0, 0, 0), 6.0 / 16.0) && near(weight(&edge, 1, 1, 0), 1.0 / 16.0) && edge.len() == 6);
    for n in 3..9 {
        // v' = ((n-3) v + 2 E + F)/n, E the mean of the edges' midpoints, F that of the new face points
        let row = row_on(&scheme, Patch::new(Lattice::Quads, n), Label { sector: 0, i: 0, j: 0 });
        let m = n as f64;
        assert!((weight(&row, 0, 0, 0) - ((m - 3.0) + 1.0 + 0.25) / m).abs() < 1e-15, "n = {n}");
        assert!(near(weight(&row, 1, 1, 0), (1.0 / m + 0.5 / m) / m), "n = {n}");
        assert!(near(weight(&row, 1, 1, 1), 0.25 / m / m), "n = {n}");
    }
}

#[test]
fn loop_with_the_cubic_boundary_makes_rows_on_a_mesh() {
    let fan = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1], [1, 5, 2]].map(|face| face.to_vec());
    let mesh = HalfEdgeMesh::from_faces(6, &fan).unwrap();
    let (scheme, boundary) = (open("loop"), catalogue::boundary("cubic", "triangles").unwrap().unwrap());
    assert_eq!(scheme.boundary[0], "cubic");
    boundary.check(&[1, 2, 3], 6).unwrap();
    let refinement = Refinement::<f64>::new(&scheme, Some(&boundary));
    let rows: Vec<_> =
        mesh.vertex_edges().iter().map(|edge| refinement.passes()[0].vertex_row(&mesh, *edge).unwrap()).collect();
    assert_eq!(rows[0].len(), 5, "an interior vertex of valence 4");
    assert_eq!(rows[1], [(1, 0.75), (4, 0.125), (5, 0.125)], "a boundary vertex of three faces");
    assert_eq!(rows[5], [(1, 0.125), (2, 0.125), (5, 0.75)], "a boundary vertex of one face");
    let tags = Tags::new(&mesh, &[], &[5]).unwrap();
    let tagged = Tagged { mesh: &mesh, tags: &tags, beyond: 0.0 };
    let corner = refinement.passes()[0].vertex_row(&tagged, mesh.vertex_edges()[5]).unwrap();
    assert_eq!(corner, [(5, 1.0)]);
    let (mut inside, mut border) = (0, 0);
    for edge in mesh.edges() {
        let row = refinement.passes()[0].edge_row(&mesh, edge).unwrap();
        assert_eq!(row.iter().map(|(_, weight)| weight).sum::<f64>(), 1.0);
        let weights: Vec<f64> = row.iter().map(|(_, weight)| *weight).collect();
        match weights.len() {
            2 => border += i32::from(weights == [0.5, 0.5]),
            _ => inside += i32::from(weights.len() == 4),
        }
    }
    assert_eq!((inside, border), (5, 5));
    let without = Refinement::<f64>::new(&scheme, None).passes()[0].vertex_row(&mesh, mesh.vertex_edges()[1]);
    assert_eq!(without, Err(Obstacle::NoRule("vertex.crease")));
}

/// A two-ring vertex stencil on triangles by addresses: every label gets the weight of its class, picks add up.
#[test]
fn addresses_reach_the_second_ring() {
    let text = r#"
name = "Two rings"
mesh = "triangles"
split = "1-to-4"
[vertex]
centre = "1 - 7/16"
ring = "3/(8*n)"
"2,0" = "1/(32*n)"
"1,1" = "1/(32*n)"
[edge]
ends = "3/8"
opposite = "1/8"
"#;
    let scheme = Scheme::parse("two-ring", "two-ring.toml", text).unwrap_or_else(|faults| panic!("{faults}"));
    eigenring::refine::check(&scheme, &[3, 5, 6, 9]).unwrap_or_else(|faults| panic!("{faults}"));
    for n in [3, 5, 6, 9] {
        let row = row_on(&scheme, Patch::new(Lattice::Triangles, n), Label { sector: 0, i: 0, j: 0 });
        assert_eq!(row.len(), 1 + 3 * n);
        for sector in 0..n as u32 {
            assert!(near(weight(&row, sector, 2, 0), 1.0 / 32.0 / n as f64));
            assert!(near(weight(&row, sector, 1, 1), 1.0 / 32.0 / n as f64));
        }
    }
}
