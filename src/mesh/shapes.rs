//! Which meshes are good to try things on?
//!
//! Named shapes, closed and open, of triangles, quads and polygons, with vertices of many valences; faces are counter-clockwise seen
//! from outside (discs and grids: from above).

use super::{Faces, PolygonSoup};

fn soup(positions: Vec<[f64; 3]>, faces: &[Vec<usize>]) -> PolygonSoup {
    PolygonSoup { positions, faces: Faces::from_lists(faces), creases: Vec::new(), corners: Vec::new() }
}

/// A point on a circle of radius r at height z: the m-th of n.
fn on_circle(m: usize, n: usize, r: f64, z: f64) -> [f64; 3] {
    let angle = std::f64::consts::TAU * m as f64 / n as f64;
    [r * libm::cos(angle), r * libm::sin(angle), z]
}

/// A tetrahedron: four vertices of valence 3.
pub fn tetrahedron() -> PolygonSoup {
    let positions = vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    soup(positions, &[vec![0, 1, 2], vec![0, 2, 3], vec![0, 3, 1], vec![3, 2, 1]])
}

/// A cube of quads: eight vertices of valence 3.
pub fn cube() -> PolygonSoup {
    let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 1.0 } else { -1.0 });
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    soup((0..8).map(corner).collect(), &faces.map(|face| face.to_vec()))
}

/// A double pyramid over a polygon of n corners: the apexes have valence n, the others 4. Its last two vertices are the apexes.
pub fn bipyramid(n: usize) -> PolygonSoup {
    let mut positions: Vec<[f64; 3]> = (0..n).map(|m| on_circle(m, n, 1.0, 0.0)).collect();
    positions.extend([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]);
    let sides = |m: usize| [vec![m, (m + 1) % n, n], vec![(m + 1) % n, m, n + 1]];
    soup(positions, &(0..n).flat_map(sides).collect::<Vec<_>>())
}

/// A closed mesh of triangles with vertices of every valence from 3 to 9: a double pyramid with vertices put into some of its faces.
pub fn many_valences() -> PolygonSoup {
    let mut mesh = bipyramid(5);
    let mut faces: Vec<Vec<usize>> = mesh.faces.iter().map(|f| f.iter().map(|v| *v as usize).collect()).collect();
    for face in [0, 1, 2, 8, 10] {
        let centre = mesh.positions.len();
        let corners = faces[face].clone();
        let mean = |axis: usize| corners.iter().map(|v| mesh.positions[*v][axis]).sum::<f64>() / 3.0;
        let position = [0, 1, 2].map(|axis| 1.2 * mean(axis));
        mesh.positions.push(position);
        faces[face] = vec![corners[0], corners[1], centre];
        faces.extend([vec![corners[1], corners[2], centre], vec![corners[2], corners[0], centre]]);
    }
    soup(mesh.positions, &faces)
}

/// A prism over a polygon of n corners: two n-gons and n quads.
pub fn prism(n: usize) -> PolygonSoup {
    let positions = [-1.0, 1.0].into_iter().flat_map(|z| (0..n).map(move |m| on_circle(m, n, 1.0, z))).collect();
    let mut faces: Vec<Vec<usize>> = vec![(0..n).rev().collect(), (n..2 * n).collect()];
    faces.extend((0..n).map(|m| vec![m, (m + 1) % n, n + (m + 1) % n, n + m]));
    soup(positions, &faces)
}

/// A torus of m rings of n quads each, split into triangles if so wished: regular everywhere. m and n are at least 3.
pub fn torus(m: usize, n: usize, triangles: bool) -> PolygonSoup {
    let vertex = |i: usize, j: usize| i % m * n + j % n;
    let position = |i: usize, j: usize| {
        let [r, z, _] = on_circle(j, n, 1.0, 0.0);
        on_circle(i, m, 3.0 + r, z)
    };
    let positions = (0..m).flat_map(|i| (0..n).map(move |j| position(i, j))).collect();
    let quad = |i: usize, j: usize| [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
    let quads = (0..m).flat_map(|i| (0..n).map(move |j| quad(i, j)));
    soup(positions, &cut(quads, triangles))
}

/// An open tube of m rings of n quads each, split into triangles if so wished.
pub fn tube(m: usize, n: usize, triangles: bool) -> PolygonSoup {
    let vertex = |i: usize, j: usize| i * n + j % n;
    let positions = (0..=m).flat_map(|i| (0..n).map(move |j| on_circle(j, n, 1.0, i as f64))).collect();
    let quad = |i: usize, j: usize| [vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)];
    let quads = (0..m).flat_map(|i| (0..n).map(move |j| quad(i, j)));
    soup(positions, &cut(quads, triangles))
}

/// A rectangle of m x n quads in the plane z = 0, split into triangles if so wished.
pub fn grid(m: usize, n: usize, triangles: bool) -> PolygonSoup {
    let vertex = |i: usize, j: usize| i * (n + 1) + j;
    let positions = (0..=m).flat_map(|i| (0..=n).map(move |j| [i as f64, j as f64, 0.0])).collect();
    let quad = |i: usize, j: usize| [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
    let quads = (0..m).flat_map(|i| (0..n).map(move |j| quad(i, j)));
    soup(positions, &cut(quads, triangles))
}

fn cut(quads: impl Iterator<Item = [usize; 4]>, triangles: bool) -> Vec<Vec<usize>> {
    let pieces = |[a, b, c, d]: [usize; 4]| {
        if triangles { vec![vec![a, b, c], vec![a, c, d]] } else { vec![vec![a, b, c, d]] }
    };
    quads.flat_map(pieces).collect()
}

/// A disc of n triangles around a vertex of valence n, or of n quads; the centre is vertex 0.
pub fn disc(n: usize, triangles: bool) -> PolygonSoup {
    let mut positions = vec![[0.0, 0.0, 0.5]];
    if triangles {
        positions.extend((0..n).map(|m| on_circle(m, n, 1.0, 0.0)));
        let faces: Vec<Vec<usize>> = (0..n).map(|m| vec![0, 1 + m, 1 + (m + 1) % n]).collect();
        return soup(positions, &faces);
    }
    positions.extend((0..2 * n).map(|m| on_circle(m, 2 * n, 1.0, 0.0)));
    let faces: Vec<Vec<usize>> = (0..n).map(|m| vec![0, 1 + 2 * m, 2 + 2 * m, 1 + (2 * m + 2) % (2 * n)]).collect();
    soup(positions, &faces)
}

/// A fan of k triangles, or quads, around vertex 0, which lies on the boundary.
pub fn fan(k: usize, triangles: bool) -> PolygonSoup {
    let at = |m: usize, r: f64| on_circle(m, 4 * k, r, 0.2 * (m % 3) as f64);
    let mut positions = vec![[0.0, 0.0, 0.0]];
    if triangles {
        positions.extend((0..=k).map(|m| at(2 * m, 1.0)));
        return soup(positions, &(0..k).map(|m| vec![0, m + 1, m + 2]).collect::<Vec<_>>());
    }
    positions.extend((0..=2 * k).map(|m| at(m, if m % 2 == 0 { 1.0 } else { 1.4 })));
    soup(positions, &(0..k).map(|m| vec![0, 2 * m + 1, 2 * m + 2, 2 * m + 3]).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Connectivity, HalfEdgeMesh};

    fn mesh(soup: &PolygonSoup) -> HalfEdgeMesh {
        let mesh = HalfEdgeMesh::new(soup.positions.len(), soup.faces.clone()).unwrap();
        mesh.validate().unwrap();
        mesh
    }

    /// Six times the volume that a closed mesh encloses; positive where faces are counter-clockwise from outside.
    fn volume(soup: &PolygonSoup) -> f64 {
        let p = |v: u32| soup.positions[v as usize];
        let det = |[a, b, c]: [[f64; 3]; 3]| {
            a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        let fan =
            |face: &[u32]| (1..face.len() - 1).map(|i| det([p(face[0]), p(face[i]), p(face[i + 1])])).sum::<f64>();
        soup.faces.iter().map(fan).sum()
    }

    #[test]
    fn closed_shapes_are_closed_and_look_outward() {
        let shapes =
            [tetrahedron(), cube(), bipyramid(5), many_valences(), prism(7), torus(5, 4, true), torus(5, 4, false)];
        for (index, shape) in shapes.iter().enumerate() {
            let mesh = mesh(shape);
            assert!(mesh.is_closed() && volume(shape) > 0.0, "shape {index}");
            assert_eq!(mesh.euler_characteristic(), if index < 5 { 2 } else { 0 }, "shape {index}");
        }
    }

    #[test]
    fn open_shapes_have_the_boundaries_that_they_should() {
        for triangles in [true, false] {
            for (shape, euler) in [
                (tube(3, 5, triangles), 0),
                (grid(2, 3, triangles), 1),
                (disc(7, triangles), 1),
                (fan(4, triangles), 1),
            ] {
                let mesh = mesh(&shape);
                assert_eq!((mesh.is_closed(), mesh.euler_characteristic()), (false, euler));
            }
        }
    }

    #[test]
    fn many_valences_has_all_from_3_to_9() {
        let mesh = mesh(&many_valences());
        let mut valences: Vec<usize> = mesh.vertex_edges().iter().map(|h| mesh.valence(*h)).collect();
        valences.sort_unstable();
        valences.dedup();
        assert_eq!(valences, [3, 4, 5, 6, 7, 8, 9]);
    }
}
