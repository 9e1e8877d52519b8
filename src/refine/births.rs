//! How is a point of a mesh made where creases last for a fraction of a step?
//!
//! An edge of sharpness s is a crease for s >= 1 and smooth for s = 0; in between its point is s times the one and 1 - s
//! times the other. A vertex follows the rule for all its creases as far as those that end within this step last, by the mean of their
//! sharpness, and the rule without them for the rest (DeRose, Kass and Truong 1998, with the mean taken over the creases that end). So does
//! a smooth edge that has a rule from its ends, for the creases at these.

use super::pass::{add_scaled, collected};
use super::{Obstacle, Pass, Row};
use crate::mesh::{Birth, Connectivity, HalfEdgeMesh, Tagged, Tags, first_corner};

impl Pass<'_, f64> {
    /// The row of a point born on a mesh with tags.
    ///
    /// # Errors
    /// As [`Pass::row_at`].
    pub fn row_of_birth(&self, mesh: &HalfEdgeMesh, tags: &Tags, birth: Birth) -> Result<Row<u32, f64>, Obstacle> {
        let seen = |beyond: f64| Tagged { mesh, tags, beyond };
        let at_vertex = |edge: u32| {
            let spokes = mesh.around_vertex(edge).into_iter();
            spokes.map(|spoke| tags.sharpness(first_corner(mesh, spoke)))
        };
        let lasting = match birth {
            Birth::Face(edge) => return self.face_row(mesh, edge),
            Birth::Corner(edge) => return self.corner_row(mesh, edge),
            Birth::Kept(edge) => return Ok(vec![(mesh.origin(edge), 1.0)]),
            Birth::Third(edge) => return self.third_row(&seen(0.0), edge),
            Birth::Edge(edge) => lasting(std::iter::once(tags.sharpness(edge))).or_else(|| {
                let smooth = tags.sharpness(edge) == 0.0 && !mesh.is_sharp(edge);
                let told_from_ends = smooth && self.has_rules_from_sharp_ends() && !tags.creases().is_empty();
                told_from_ends.then(|| lasting([edge, mesh.twin(edge)].into_iter().flat_map(at_vertex)))?
            }),
            Birth::Vertex(edge) if tags.creases().is_empty() => return self.vertex_row(&seen(0.0), edge),
            Birth::Vertex(edge) => lasting(at_vertex(edge)),
        };
        let row = |beyond: f64| match birth {
            Birth::Vertex(edge) => self.vertex_row(&seen(beyond), edge),
            _ => self.edge_row(&seen(beyond), birth.half_edge()),
        };
        match lasting {
            None => row(0.0),
            Some(share) => mixed(&row(0.0)?, share, &row(1.0)?),
        }
    }
}

/// The mean sharpness of the creases that end within this step; `None` when they last for the whole of it.
fn lasting(sharpness: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) =
        sharpness.filter(|s| 0.0 < *s && *s <= 1.0).fold((0.0, 0), |(sum, count), s| (sum + s, count + 1));
    let mean = sum / f64::from(count.max(1));
    (count > 0 && mean < 1.0).then_some(mean)
}

/// share times one row, and the rest times the other.
fn mixed(one: &Row<u32, f64>, share: f64, other: &Row<u32, f64>) -> Result<Row<u32, f64>, Obstacle> {
    let mut sum = Vec::new();
    add_scaled(&mut sum, one, &share)?;
    add_scaled(&mut sum, other, &(1.0 - share))?;
    collected(sum)
}
