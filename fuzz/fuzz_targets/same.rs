//! Does what a reader takes come back when it is written and read again, and can the rest of the program take it?

use eigenring::mesh::io::{Format, Output, read, write};
use eigenring::mesh::{HalfEdgeMesh, PolygonSoup, drop_isolated, split_non_manifold};

/// Panics if not.
pub fn back(format: Format, bytes: &[u8]) {
    let soup = match read(format, bytes) {
        Ok(read) => read.soup,
        Err(fault) => {
            let text = fault.to_string();
            assert!(!fault.help.is_empty() && text.len() < 1000, "{text}");
            assert!(fault.line().is_none_or(|line| line <= bytes.len() + 1));
            return;
        }
    };
    assert!(soup.positions.as_flattened().iter().all(|x| x.is_finite()));
    let narrow = soup.positions.as_flattened().iter().all(|x| f64::from(*x as f32) == *x);
    if format == Format::Stl && !narrow {
        return;
    }
    let mut again = Vec::new();
    let notes = write(format, &Output::from(&soup), &mut again).expect("what was read can be written");
    assert!(notes.is_empty());
    let read = read(format, &again).expect("what was written can be read");
    assert!(read.notes.is_empty() && read.soup == soup);
    mend(soup);
}

/// What was read can be made a mesh.
fn mend(soup: PolygonSoup) {
    let (soup, _) = split_non_manifold(soup).expect("sound faces");
    let (soup, _) = drop_isolated(soup).expect("sound faces");
    HalfEdgeMesh::new(soup.positions.len(), soup.faces).expect("a mesh").validate().expect("its relations");
}
