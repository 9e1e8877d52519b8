//! How do polygons become triangles?
//!
//! A quad by its shorter diagonal, a larger polygon by the diagonals from the corner from which they are shortest in sum; ties go to the first. Points
//! and tags stay as they are.

use super::{Faces, PolygonSoup};

/// Cuts every face with more than three corners into triangles; says how many there were.
pub fn triangulate(mut soup: PolygonSoup) -> (PolygonSoup, usize) {
    let large = soup.faces.iter().filter(|face| face.len() > 3).count();
    if large > 0 {
        let mut corners = Vec::with_capacity(3 * soup.faces.corners().len());
        for face in soup.faces.iter() {
            let start = apex(face, &soup.positions);
            let from = |index: usize| face[(start + index) % face.len()];
            corners.extend((1..face.len() - 1).flat_map(|index| [from(0), from(index), from(index + 1)]));
        }
        soup.faces = Faces::same(3, corners);
    }
    (soup, large)
}

/// The corner that the diagonals leave.
fn apex(face: &[u32], positions: &[[f64; 3]]) -> usize {
    let n = face.len();
    let point = |index: usize| positions.get(face[index % n] as usize).copied().unwrap_or_default();
    let length = |a: [f64; 3], b: [f64; 3]| (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt();
    let sum = |start: usize| (2..n - 1).map(|step| length(point(start), point(start + step))).sum::<f64>();
    let sums: Vec<f64> = (0..if n > 3 { n } else { 1 }).map(sum).collect();
    (0..sums.len()).min_by(|a, b| sums[*a].total_cmp(&sums[*b]).then(a.cmp(b))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{HalfEdgeMesh, shapes};

    #[test]
    fn triangles_fill_the_polygons_by_short_diagonals() {
        for shape in [shapes::cube(), shapes::prism(7), shapes::torus(4, 5, false), shapes::tetrahedron()] {
            let (edges, corners) = {
                let mesh = HalfEdgeMesh::new(shape.positions.len(), shape.faces.clone()).unwrap();
                (mesh.edge_count(), mesh.twins().len())
            };
            let large = shape.faces.iter().filter(|face| face.len() > 3).count();
            let faces = shape.faces.len();
            let (cut, counted) = triangulate(shape);
            let mesh = HalfEdgeMesh::new(cut.positions.len(), cut.faces.clone()).unwrap();
            assert_eq!(counted, large);
            assert!(mesh.is_closed() && mesh.faces().same_size() == Some(3));
            assert_eq!(mesh.faces().len(), corners - 2 * faces);
            assert_eq!(mesh.edge_count(), edges + corners - 3 * faces);
        }
        let kite = PolygonSoup {
            positions: vec![[0.0, 0.0, 0.0], [9.0, -1.0, 0.0], [18.0, 0.0, 0.0], [9.0, 1.0, 0.0]],
            faces: Faces::from_lists(&[vec![0_usize, 1, 2, 3]]),
            creases: vec![],
            corners: vec![],
        };
        let (cut, _) = triangulate(kite);
        assert!(cut.faces.iter().all(|face| face.contains(&1) && face.contains(&3)), "{:?}", cut.faces);
    }
}
