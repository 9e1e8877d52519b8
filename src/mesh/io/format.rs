//! Which formats of mesh files are there?

use std::fmt;
use std::path::Path;

/// A format of mesh files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Wavefront OBJ. Faces keep their sizes; indices may be negative; of `v/vt/vn` only `v` is kept.
    ///
    /// Tags are lines that start with `t`, in two forms:
    ///
    /// - *Counted*, that of OpenSubdiv's shapes: `t crease 2/1/0 1 5 4.7` and `t corner 1/1/0 4 10`. The three counts say how
    ///   many indices, numbers and words follow. **Indices count from 0.** A crease lists one edge or several, two indices
    ///   each, with one sharpness for all or one for each; a corner lists vertices in the same way. A sharpness of 10 or more
    ///   means for ever, as there.
    /// - *Plain*: `t crease 2 6 4.7`, `t crease 2/6 4.7` and `t corner 5 10`. **Indices count from 1**, as those of faces, and
    ///   negative ones back from the last vertex so far. The sharpness of a crease is taken as it stands; `inf` is for ever.
    ///
    /// Corners stay for ever, whatever their sharpness above 0; a note tells of those below 10. Of several tags on one edge or
    /// vertex the last counts. Written are counted tags, and plain ones for sharpnesses of 10 and more that end.
    Obj,
    /// PLY, the polygon file format: `vertex` with `x`, `y`, `z`, and `face` with `vertex_indices` or `vertex_index`.
    Ply,
    /// OFF, the object file format of Geomview, as text.
    Off,
    /// STL: triangles that share no vertices; corners with exactly equal coordinates are read as one.
    Stl,
    /// Binary glTF 2.0 (`.glb`), written only.
    Gltf,
}

impl Format {
    /// All formats.
    pub const ALL: [Format; 5] = [Format::Obj, Format::Ply, Format::Off, Format::Stl, Format::Gltf];

    /// The format that the ending of a file's name tells, in small letters or capitals.
    pub fn of_path(path: &Path) -> Option<Format> {
        let ending = path.extension()?.to_str()?;
        Format::ALL.into_iter().find(|format| format.ending().eq_ignore_ascii_case(ending))
    }

    /// The format whose first word stands at the start of these bytes, for those that have one.
    pub fn of_bytes(bytes: &[u8]) -> Option<Format> {
        let word = bytes.split(u8::is_ascii_whitespace).find(|word| !word.is_empty())?;
        match word {
            b"ply" => Some(Format::Ply),
            b"solid" => Some(Format::Stl),
            _ if word.starts_with(b"glTF") => Some(Format::Gltf),
            _ if word.len() <= 8 && word.ends_with(b"OFF") => Some(Format::Off),
            _ => None,
        }
    }

    /// The ending of the names of such files, without a dot.
    pub fn ending(self) -> &'static str {
        match self {
            Format::Obj => "obj",
            Format::Ply => "ply",
            Format::Off => "off",
            Format::Stl => "stl",
            Format::Gltf => "glb",
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Format::Obj => "OBJ",
            Format::Ply => "PLY",
            Format::Off => "OFF",
            Format::Stl => "STL",
            Format::Gltf => "glTF",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_first_words_tell_formats() {
        let of = |name: &str| Format::of_path(Path::new(name));
        assert_eq!(
            (of("a/b.obj"), of("B.PLY"), of("x.y.Off")),
            (Some(Format::Obj), Some(Format::Ply), Some(Format::Off))
        );
        assert_eq!((of("a.glb"), of("a.gltf"), of("obj"), of("")), (Some(Format::Gltf), None, None, None));
        assert_eq!(Format::of_bytes(b"\n COFF 3 1"), Some(Format::Off));
        assert_eq!((Format::of_bytes(b"v 1 2 3"), Format::of_bytes(b" ")), (None, None));
    }
}
