//! What the tests of meshes share: schemes with their boundary rules, and shapes as levels.

use eigenring::mesh::{HalfEdgeMesh, PolygonSoup, Tags};
use eigenring::refine::Level;
use eigenring::scheme::{RuleBook, Scheme, catalogue};

/// A scheme of the catalogue, with the cubic boundary rules.
pub(crate) fn open(id: &str) -> (Scheme, RuleBook) {
    let scheme = catalogue::open(id).unwrap().unwrap();
    let book = catalogue::boundary("cubic", &scheme.mesh).unwrap().unwrap();
    (scheme, book)
}

/// A shape as a first level.
pub(crate) fn level(soup: &PolygonSoup) -> Level<f64> {
    let mesh = HalfEdgeMesh::new(soup.positions.len(), soup.faces.clone()).unwrap();
    let tags = Tags::new(&mesh, &soup.creases, &soup.corners).unwrap();
    Level { mesh, positions: soup.positions.clone(), tags }
}
