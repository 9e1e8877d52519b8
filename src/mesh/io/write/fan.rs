//! How are polygons cut into triangles?

use crate::mesh::Faces;

/// The triangles of all faces: a polygon is cut into a fan around its first corner.
pub(super) fn triangles(faces: &Faces) -> impl Iterator<Item = [u32; 3]> {
    faces.iter().flat_map(|face| face.windows(2).skip(1).map(|pair| [face[0], pair[0], pair[1]]))
}

/// The number of these triangles.
pub(super) fn count(faces: &Faces) -> usize {
    faces.corners().len() - 2 * faces.len()
}

/// What is said where there are polygons that are no triangles.
pub(super) fn note(faces: &Faces) -> Option<String> {
    let polygons = if faces.same_size() == Some(3) { 0 } else { faces.iter().filter(|face| face.len() > 3).count() };
    (polygons > 0)
        .then(|| format!("polygons are cut into triangles, each a fan around its first corner ({polygons} faces)"))
}
