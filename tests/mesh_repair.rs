//! Do polygons that are no mesh become one by cutting, and nothing but cutting?
#![allow(clippy::unwrap_used)]

use eigenring::mesh::{
    Connectivity, Crease, Dropped, Faces, HalfEdgeMesh, NONE, NotAMesh, PolygonSoup, Repair, Tags, drop_isolated,
    edge_between, first_corner, split_non_manifold,
};
use proptest::prelude::*;
use std::collections::{HashMap, HashSet};

/// Polygons on points that are told apart by their place.
fn soup(vertices: usize, faces: &[Vec<usize>]) -> PolygonSoup {
    let positions = (0..vertices).map(|i| [i as f64, 0.0, 0.0]).collect();
    PolygonSoup { positions, faces: Faces::from_lists(faces), creases: Vec::new(), corners: Vec::new() }
}

fn split(soup: &PolygonSoup) -> (PolygonSoup, Repair) {
    split_non_manifold(soup.clone()).unwrap()
}

fn mesh(soup: &PolygonSoup) -> Result<HalfEdgeMesh, NotAMesh> {
    HalfEdgeMesh::new(soup.positions.len(), soup.faces.clone())
}

/// Of each vertex the one it came from.
fn origin(soup: &PolygonSoup) -> Vec<usize> {
    soup.positions.iter().map(|point| point[0] as usize).collect()
}

const TETRAHEDRON: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

#[test]
fn a_bow_tie_comes_apart() {
    let (cut, repair) = split(&soup(5, &[vec![0, 1, 2], vec![0, 3, 4]]));
    assert_eq!(repair, Repair { edges_cut: 0, vertices_split: 1 });
    assert_eq!(cut.faces, Faces::from_lists(&[[0, 1, 2], [5, 3, 4]]));
    assert_eq!(origin(&cut), [0, 1, 2, 3, 4, 0]);
}

#[test]
fn pages_of_a_book_come_apart_and_keep_their_tags() {
    let mut book = soup(5, &[vec![0, 1, 2], vec![1, 0, 3], vec![0, 1, 4]]);
    let crease = |a, b, sharpness| Crease { ends: [a, b], sharpness };
    book.creases = vec![crease(1, 0, 2.0), crease(1, 2, 3.0)];
    book.corners = vec![4, 0];
    let (cut, repair) = split(&book);
    assert_eq!(repair, Repair { edges_cut: 1, vertices_split: 2 });
    assert_eq!(cut.faces, Faces::from_lists(&[[0, 1, 2], [5, 6, 3], [7, 8, 4]]));
    assert_eq!(origin(&cut)[5..], [1, 0, 0, 1]);
    assert_eq!(cut.creases, [crease(1, 0, 2.0), crease(5, 6, 2.0), crease(8, 7, 2.0), crease(1, 2, 3.0)]);
    assert_eq!(cut.corners, [4, 0, 6, 7]);
    assert!(mesh(&cut).is_ok());
}

#[test]
fn a_flap_comes_off_and_leaves_the_surface_closed() {
    let faces: Vec<Vec<usize>> = TETRAHEDRON.iter().map(|face| face.to_vec()).chain([vec![0, 1, 4]]).collect();
    let (cut, repair) = split(&soup(5, &faces));
    assert_eq!(repair, Repair { edges_cut: 1, vertices_split: 2 });
    let mesh = mesh(&cut).unwrap();
    assert!(mesh.twins()[..12].iter().all(|twin| *twin != NONE), "the tetrahedron is closed again");
    assert!(mesh.twins()[12..].iter().all(|twin| *twin == NONE));
}

#[test]
fn faces_on_the_same_corners_come_apart() {
    let (cut, repair) = split(&soup(3, &[vec![0, 1, 2], vec![1, 2, 0]]));
    assert_eq!(repair, Repair { edges_cut: 3, vertices_split: 3 });
    assert_eq!(cut.faces, Faces::from_lists(&[[0, 1, 2], [3, 4, 5]]));
    assert_eq!(origin(&cut)[3..], [1, 2, 0]);
}

#[test]
fn a_strip_with_one_side_is_cut_once() {
    let strip: Vec<Vec<usize>> = vec![vec![0, 1, 3, 2], vec![2, 3, 5, 4], vec![4, 5, 0, 1]];
    let (cut, repair) = split(&soup(6, &strip));
    assert_eq!(repair, Repair { edges_cut: 1, vertices_split: 2 });
    let mesh = mesh(&cut).unwrap();
    assert_eq!((mesh.vertices(), mesh.euler_characteristic()), (8, 1));
}

#[test]
fn what_is_a_mesh_is_left_alone() {
    let mut whole = soup(4, &TETRAHEDRON.map(|face| face.to_vec()));
    whole.creases = vec![Crease { ends: [3, 1], sharpness: 0.5 }];
    whole.corners = vec![2, 2];
    assert_eq!(split(&whole), (whole.clone(), Repair::default()));
    assert_eq!(drop_isolated(whole.clone()).unwrap(), (whole, Dropped::default()));
}

#[test]
fn isolated_vertices_are_dropped_with_their_tags() {
    let mut loose = soup(6, &[vec![5, 1, 3]]);
    loose.creases = vec![Crease { ends: [5, 3], sharpness: 2.0 }, Crease { ends: [0, 1], sharpness: 1.0 }];
    loose.corners = vec![2, 3, 9];
    let (kept, dropped) = drop_isolated(loose).unwrap();
    assert_eq!(dropped, Dropped { vertices: 3, tags: 3 });
    assert_eq!((origin(&kept), kept.faces.corners()), (vec![1, 3, 5], [2, 0, 1].as_slice()));
    assert_eq!((kept.creases, kept.corners), (vec![Crease { ends: [2, 1], sharpness: 2.0 }], vec![1]));
}

#[test]
fn faces_that_no_cut_mends_are_named() {
    let refused = |faces: &[Vec<usize>]| split_non_manifold(soup(3, faces)).unwrap_err();
    assert_eq!(refused(&[vec![0, 1, 2], vec![0, 1]]), NotAMesh::Face(1));
    assert_eq!(refused(&[vec![0, 1, 0, 2]]), NotAMesh::Face(0));
    assert_eq!(refused(&[vec![0, 1, 7]]), NotAMesh::Corner(0, 7));
    assert_eq!(drop_isolated(soup(3, &[vec![0, 1, 7]])).unwrap_err(), NotAMesh::Corner(0, 7));
}

/// Few points and many faces: hardly ever a mesh.
fn tangles() -> impl Strategy<Value = PolygonSoup> {
    (3_usize..9).prop_flat_map(|vertices| {
        let all: Vec<usize> = (0..vertices).collect();
        let face = prop::sample::subsequence(all, 3..=vertices.min(5)).prop_shuffle();
        let end = 0..vertices as u32;
        let crease = (end.clone(), end.clone(), 0.5..4.0).prop_filter("two ends", |(a, b, _)| a != b);
        let crease = crease.prop_map(|(a, b, sharpness)| Crease { ends: [a, b], sharpness });
        let tags = (prop::collection::vec(crease, 0..6), prop::collection::vec(end, 0..4));
        (prop::collection::vec(face, 1..12), tags).prop_map(move |(faces, (creases, corners))| {
            let on_edge = |crease: &Crease| {
                let [a, b] = crease.ends.map(|end| end as usize);
                faces.iter().any(|face| edges(face).any(|[c, d]| [c, d] == [a, b] || [d, c] == [a, b]))
            };
            PolygonSoup { creases: creases.into_iter().filter(on_edge).collect(), corners, ..soup(vertices, &faces) }
        })
    })
}

fn edges(face: &[usize]) -> impl Iterator<Item = [usize; 2]> {
    (0..face.len()).map(|i| [face[i], face[(i + 1) % face.len()]])
}

fn lists(faces: &Faces) -> Vec<Vec<usize>> {
    faces.iter().map(|face| face.iter().map(|corner| *corner as usize).collect()).collect()
}

/// Fans counted in another way: the faces at a vertex are joined where they share an edge that has one face on each side.
fn fans(faces: &[Vec<usize>], vertex: usize) -> usize {
    let mut directed: HashMap<[usize; 2], usize> = HashMap::new();
    faces.iter().flat_map(|face| edges(face)).for_each(|edge| *directed.entry(edge).or_default() += 1);
    let sound = |a: usize, b: usize| directed.get(&[a, b]) == Some(&1) && directed.get(&[b, a]) == Some(&1);
    let at: Vec<&Vec<usize>> = faces.iter().filter(|face| face.contains(&vertex)).collect();
    let spokes = |face: &[usize]| -> HashSet<usize> {
        let around = edges(face).filter(|edge| edge.contains(&vertex)).flatten();
        around.filter(|end| *end != vertex && sound(*end, vertex)).collect()
    };
    let mut groups: Vec<HashSet<usize>> = Vec::new();
    let mut alone = 0;
    for face in at {
        let mut group = spokes(face);
        alone += usize::from(group.is_empty());
        let (joined, apart): (Vec<_>, Vec<_>) = groups.into_iter().partition(|other| !other.is_disjoint(&group));
        group.extend(joined.into_iter().flatten());
        groups = apart;
        groups.extend(Some(group).filter(|group| !group.is_empty()));
    }
    groups.len() + alone
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn any_polygons_become_a_mesh(tangle in tangles()) {
        let (cut, repair) = split(&tangle);
        let origin = origin(&cut);
        let vertices = tangle.positions.len();
        prop_assert_eq!(&cut.positions[..vertices], tangle.positions.as_slice());

        // the same faces, and a vertex for each fan
        let faces = lists(&tangle.faces);
        let back: Vec<Vec<usize>> = lists(&cut.faces).iter().map(|face| face.iter().map(|v| origin[*v]).collect()).collect();
        prop_assert_eq!(&back, &faces);
        for vertex in 0..vertices {
            let copies = origin.iter().filter(|from| **from == vertex).count();
            prop_assert_eq!(copies, fans(&faces, vertex).max(1));
        }
        let several = (0..vertices).filter(|vertex| origin[vertices..].contains(vertex)).count();
        prop_assert_eq!(repair.vertices_split, several);

        // a mesh, which is left alone
        let (cut, _) = drop_isolated(cut).unwrap();
        let mesh = mesh(&cut).unwrap();
        mesh.validate().unwrap();
        prop_assert_eq!(split(&cut), (cut.clone(), Repair::default()));

        // tags where they were, and nowhere else
        let origin = self::origin(&cut);
        let tags = Tags::new(&mesh, &cut.creases, &cut.corners).unwrap();
        for edge in mesh.edges() {
            let ends = [mesh.faces().corners()[edge as usize], mesh.faces().corners()[mesh.faces().next(edge) as usize]];
            let [a, b] = ends.map(|end| origin[end as usize] as u32);
            let on = |creases: &[Crease], [a, b]: [u32; 2]| {
                let last = creases.iter().rev().find(|crease| crease.ends == [a, b] || crease.ends == [b, a]);
                last.map_or(0.0, |crease| crease.sharpness)
            };
            let told = on(&tangle.creases, [a, b]);
            prop_assert_eq!(on(&cut.creases, ends), told);
            // the boundary is sharp without a tag
            let found = tags.sharpness(first_corner(&mesh, edge_between(&mesh, ends).unwrap()));
            prop_assert_eq!(found, if mesh.is_sharp(edge) { 0.0 } else { told });
        }
        for (vertex, from) in origin.iter().enumerate() {
            prop_assert_eq!(tags.corners().contains(&(vertex as u32)), tangle.corners.contains(&(*from as u32)));
        }
    }
}
