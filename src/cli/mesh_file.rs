//! How does a mesh come from a file, and go into one?

use super::{Failure, failure, say};
use clap::{Args, ValueEnum};
use eigenring::mesh::io::{Format, Output, read, write};
use eigenring::mesh::{
    Connectivity, Crease, Faces, HalfEdgeMesh, NotAMesh, PolygonSoup, Tags, drop_isolated, split_non_manifold,
    triangulate,
};
use eigenring::report::write_in_pieces;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// What is done with a mesh as it is read.
#[derive(Args, Clone, Debug)]
pub(crate) struct Reading {
    /// Cut edges with more than two faces, or with faces of opposite orientation, and vertices where surfaces only touch
    #[arg(long)]
    split_non_manifold: bool,
    /// Drop vertices that belong to no face
    #[arg(long)]
    drop_isolated: bool,
    /// Cut faces with more than three corners into triangles, by short diagonals
    #[arg(long)]
    triangulate: bool,
    /// Make every edge a crease whose faces meet at this angle or more, in degrees; 0 is flat
    #[arg(long, value_name = "DEGREES", value_parser = angle)]
    crease_angle: Option<f64>,
    /// What the boundary does at vertices of one face: a smooth curve runs through them, or they are corners
    #[arg(long, value_enum, default_value = "smooth")]
    boundary: Boundary,
}

/// How a boundary behaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Boundary {
    /// A smooth curve everywhere
    Smooth,
    /// Vertices of one face stay where they are
    Corner,
}

fn angle(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(angle) if (0.0..=180.0).contains(&angle) => Ok(angle),
        _ => Err("an angle from 0 to 180 degrees is needed".to_string()),
    }
}

/// A mesh with its points and tags.
pub(crate) struct Loaded {
    pub(crate) mesh: HalfEdgeMesh,
    pub(crate) positions: Vec<[f64; 3]>,
    pub(crate) tags: Tags,
}

impl Reading {
    /// Reads a mesh file and makes a mesh of it.
    pub(crate) fn load(&self, path: &Path) -> Result<Loaded, Failure> {
        let mut soup = self.mended(soup(path)?, path)?;
        let mesh = HalfEdgeMesh::new(soup.positions.len(), std::mem::replace(&mut soup.faces, no_faces()))
            .map_err(|wrong| not_a_mesh(path, &wrong))?;
        let mut creases = self.crease_angle.map_or(Vec::new(), |angle| sharp_edges(&mesh, &soup.positions, angle));
        // what the file says of an edge counts more than its angle
        creases.append(&mut soup.creases);
        let tags = Tags::new(&mesh, &creases, &soup.corners);
        let tags = tags.map_err(|wrong| failure(format!("{}: {wrong}", path.display())))?;
        let tags = if self.boundary == Boundary::Corner { tags.with_boundary_corners(&mesh) } else { tags };
        Ok(Loaded { mesh, positions: soup.positions, tags })
    }

    fn mended(&self, mut soup: PolygonSoup, path: &Path) -> Result<PolygonSoup, Failure> {
        if self.split_non_manifold {
            let (split, repair) = split_non_manifold(soup).map_err(|wrong| not_a_mesh(path, &wrong))?;
            let (edges, vertices) = (repair.edges_cut, repair.vertices_split);
            if edges + vertices > 0 {
                say(&format!("note: non-manifold edges cut apart: {edges}; vertices split: {vertices}"));
            }
            soup = split;
        }
        if self.drop_isolated {
            let (kept, dropped) = drop_isolated(soup).map_err(|wrong| not_a_mesh(path, &wrong))?;
            if dropped.vertices > 0 {
                say(&format!("note: {} vertices without a face were dropped", dropped.vertices));
            }
            soup = kept;
        }
        let small = soup.faces.iter().position(|face| face.len() < 3);
        if let Some(face) = small.filter(|_| self.triangulate) {
            return Err(not_a_mesh(path, &NotAMesh::Face(face)));
        }
        if self.triangulate {
            let (cut, large) = triangulate(soup);
            if large > 0 {
                say(&format!("note: {large} faces were cut into triangles"));
            }
            soup = cut;
        }
        Ok(soup)
    }
}

fn no_faces() -> Faces {
    Faces::same(3, Vec::new())
}

fn not_a_mesh(path: &Path, wrong: &NotAMesh) -> Failure {
    let help = match wrong {
        NotAMesh::Edge { .. } | NotAMesh::Orientation { .. } | NotAMesh::Vertex(_) | NotAMesh::Twice(_) => {
            "\n  help: --split-non-manifold cuts the surface apart there"
        }
        NotAMesh::Isolated(_) => "\n  help: --drop-isolated leaves such vertices out",
        _ => "",
    };
    failure(format!("{} is not a manifold mesh: {wrong} (counted from 0){help}", path.display()))
}

fn format_of(path: &Path) -> Result<Format, Failure> {
    Format::of_path(path).ok_or_else(|| {
        let endings: Vec<&str> = Format::ALL.into_iter().map(Format::ending).collect();
        let endings = endings.join(", .");
        failure(format!("`{}` names no format of mesh files; its ending should be one of .{endings}", path.display()))
    })
}

fn soup(path: &Path) -> Result<PolygonSoup, Failure> {
    let format = format_of(path)?;
    let name = path.display();
    match path.metadata() {
        Err(error) => return Err(failure(format!("`{name}` can't be opened: {error}"))),
        Ok(metadata) if metadata.is_dir() => return Err(failure(format!("`{name}` is a directory"))),
        Ok(metadata) if !metadata.is_file() => {
            return Err(failure(format!("`{name}` is not a file but a pipe or a device; a mesh file is needed")));
        }
        Ok(metadata) => super::memory::check(u128::from(metadata.len()) * 2, &format!("reading `{name}`"), "")?,
    }
    let bytes = fs::read(path).map_err(|error| failure(format!("`{name}` can't be read: {error}")))?;
    let found = read(format, &bytes).map_err(|wrong| failure(format!("`{name}`, {wrong}")))?;
    found.notes.iter().for_each(|note| say(&format!("note: `{name}`: {note}")));
    Ok(found.soup)
}

/// Writes a mesh, whole or not at all.
pub(crate) fn save(path: &Path, output: &Output) -> Result<(), Failure> {
    let format = format_of(path)?;
    let notes = write_in_pieces(path, |file| write(format, output, file))
        .map_err(|error| failure(format!("`{}` can't be written: {error}", path.display())))?;
    notes.iter().for_each(|note| say(&format!("note: `{}`: {note}", path.display())));
    Ok(())
}

/// Checks that a file can be written there, before the work.
pub(crate) fn check_destination(path: &Path) -> Result<(), Failure> {
    format_of(path)?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    match folder {
        Some(folder) if !folder.is_dir() => Err(failure(format!("there is no folder `{}`", folder.display()))),
        _ if path.is_dir() => Err(failure(format!("`{}` is a directory", path.display()))),
        _ => Ok(()),
    }
}

/// The tags of a mesh as a file tells them.
pub(crate) fn creases_of(mesh: &HalfEdgeMesh, tags: &Tags) -> Vec<Crease> {
    let crease = |(edge, sharpness): &(u32, f64)| Crease {
        ends: [mesh.origin(*edge), mesh.target(*edge)],
        sharpness: *sharpness,
    };
    tags.creases().iter().map(crease).collect()
}

/// The edges whose faces meet at an angle or more, as creases for ever.
fn sharp_edges(mesh: &HalfEdgeMesh, positions: &[[f64; 3]], degrees: f64) -> Vec<Crease> {
    let normals: Vec<[f64; 3]> = mesh.faces().iter().map(|face| newell(face, positions)).collect();
    let angle = |h: u32| {
        let (a, b) = (normals[mesh.faces().face_of(h) as usize], normals[mesh.faces().face_of(mesh.twin(h)) as usize]);
        let dot: f64 = (0..3).map(|axis| a[axis] * b[axis]).sum();
        libm::acos(dot.clamp(-1.0, 1.0)).to_degrees()
    };
    let inside = mesh.edges().filter(|h| !mesh.is_sharp(*h));
    let sharp = inside.filter(|h| angle(*h) >= degrees);
    sharp.map(|h| Crease { ends: [mesh.origin(h), mesh.target(h)], sharpness: f64::INFINITY }).collect()
}

/// The unit normal of a polygon, planar or nearly so.
fn newell(face: &[u32], positions: &[[f64; 3]]) -> [f64; 3] {
    let mut normal = [0.0; 3];
    for (a, b) in face.iter().zip(face.iter().cycle().skip(1)) {
        let (p, q) = (positions[*a as usize], positions[*b as usize]);
        let part = |next: usize, last: usize| (p[next] - q[next]) * (p[last] + q[last]);
        normal = [normal[0] + part(1, 2), normal[1] + part(2, 0), normal[2] + part(0, 1)];
    }
    let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 { normal.map(|x| x / length) } else { normal }
}

/// Vertices, edges, faces, Euler characteristic and valences of a mesh.
pub(crate) fn statistics(what: &str, mesh: &HalfEdgeMesh) -> String {
    let (mut inside, mut boundary): (BTreeMap<usize, usize>, BTreeMap<usize, usize>) = Default::default();
    for h in mesh.vertex_edges() {
        let histogram = if mesh.boundary_at(*h).is_some() { &mut boundary } else { &mut inside };
        *histogram.entry(mesh.valence(*h)).or_default() += 1;
    }
    let text = counts(what, mesh.vertices(), mesh.edge_count(), mesh.faces().len());
    let on_boundary =
        if boundary.is_empty() { String::new() } else { format!("; on the boundary {}", histogram(&boundary)) };
    format!("{text}\n  valences {}{on_boundary}", histogram(&inside))
}

/// The same of faces that no mesh was made of: told by the number of faces at each vertex, which is the valence inside.
pub(crate) fn statistics_of_faces(what: &str, vertices: usize, edges: usize, faces: &Faces) -> String {
    let mut at_vertex = vec![0_u32; vertices];
    faces.corners().iter().for_each(|vertex| at_vertex[*vertex as usize] += 1);
    let mut numbers = BTreeMap::new();
    at_vertex.iter().for_each(|count| *numbers.entry(*count as usize).or_insert(0) += 1);
    format!("{}\n  faces at a vertex {}", counts(what, vertices, edges, faces.len()), histogram(&numbers))
}

fn counts(what: &str, vertices: usize, edges: usize, faces: usize) -> String {
    let euler = vertices as i64 - edges as i64 + faces as i64;
    format!("{what}: {vertices} vertices, {edges} edges, {faces} faces, Euler characteristic {euler}")
}

fn histogram(counts: &BTreeMap<usize, usize>) -> String {
    const SHOWN: usize = 12;
    let shown: Vec<String> = counts.iter().take(SHOWN).map(|(valence, count)| format!("{valence}: {count}")).collect();
    let more =
        if counts.len() > SHOWN { format!(", and {} more valences", counts.len() - SHOWN) } else { String::new() };
    if shown.is_empty() { "none".to_string() } else { shown.join(", ") + &more }
}
