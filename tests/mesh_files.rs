//! Do mesh files come back as they were written, do other programs' readers agree, and is every faulty file refused with its
//! line and what to do?
#![allow(clippy::unwrap_used)]

use eigenring::mesh::io::{BadFile, Format, Kind, Output, Place, Read, read, write};
use eigenring::mesh::{Crease, Faces, PolygonSoup};
use proptest::prelude::*;
use std::io::Cursor;

/// The corners of the unit cube, corner i at the binary digits of i, and its faces.
const CUBE: [[usize; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

fn cube() -> PolygonSoup {
    let digit = |i: usize, place: usize| (i >> place & 1) as f64;
    let positions = (0..8).map(|i| [digit(i, 0), digit(i, 1), digit(i, 2)]).collect();
    PolygonSoup { positions, faces: Faces::from_lists(&CUBE), creases: Vec::new(), corners: Vec::new() }
}

/// A quad, a triangle and a pentagon, with tags.
fn mixed() -> PolygonSoup {
    let positions = (0..8).map(|i| [f64::from(i), 0.1 * f64::from(i), -1.0 / f64::from(i + 1)]).collect();
    let faces = Faces::from_lists(&[vec![0, 1, 2, 3], vec![3, 2, 4], vec![4, 5, 6, 7, 0]]);
    let crease = |a, b, sharpness| Crease { ends: [a, b], sharpness };
    let creases = vec![crease(2, 3, 1.5), crease(4, 2, f64::INFINITY), crease(0, 3, 12.25), crease(5, 6, 0.0)];
    PolygonSoup { positions, faces, creases, corners: vec![7, 1] }
}

fn written(format: Format, output: &Output) -> (Vec<u8>, Vec<String>) {
    let mut bytes = Vec::new();
    let notes = write(format, output, &mut bytes).unwrap();
    (bytes, notes)
}

fn refusal(format: Format, bytes: &[u8]) -> BadFile {
    read(format, bytes).unwrap_err()
}

// what is written is read

#[test]
fn polygons_and_tags_come_back() {
    for soup in [cube(), mixed()] {
        for format in [Format::Obj, Format::Ply, Format::Off] {
            let (bytes, notes) = written(format, &Output::from(&soup));
            let Read { soup: back, notes: said } = read(format, &bytes).unwrap();
            assert_eq!((&back.positions, &back.faces, said), (&soup.positions, &soup.faces, vec![]), "{format}");
            let tagged = !soup.creases.is_empty();
            assert_eq!(notes.len(), usize::from(tagged && format != Format::Obj), "{format}: {notes:?}");
            if format == Format::Obj {
                assert_eq!(back, soup);
            }
        }
    }
}

#[test]
fn stl_holds_the_triangles_of_fans() {
    let (bytes, notes) = written(Format::Stl, &Output::from(&cube()));
    assert_eq!(bytes.len(), 84 + 12 * 50);
    assert!(notes.len() == 1 && notes[0].contains("6 faces"), "{notes:?}");
    let soup = read(Format::Stl, &bytes).unwrap().soup;
    assert_eq!((soup.positions.len(), soup.faces.len()), (8, 12));
    let point = |corner: &u32| soup.positions[*corner as usize];
    for (face, quad) in CUBE.iter().enumerate() {
        for (half, corners) in [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]].into_iter().enumerate() {
            let found: Vec<[f64; 3]> = soup.faces.face(2 * face + half).iter().map(point).collect();
            assert_eq!(found, corners.map(|corner| cube().positions[corner]));
        }
    }
    let (_, notes) = written(Format::Stl, &Output::from(&mixed()));
    assert!(["triangles", "rounded", "creases"].iter().all(|word| notes.join("\n").contains(word)), "{notes:?}");
}

#[test]
fn stl_leaves_out_triangles_that_collapse() {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1e-60, 0.0, 0.0]];
    let faces = Faces::from_lists(&[[0, 1, 2], [0, 3, 1], [1, 0, 3], [3, 1, 0]]);
    let (bytes, notes) = written(Format::Stl, &Output::new(positions.as_slice(), &faces));
    assert_eq!(read(Format::Stl, &bytes).unwrap().soup.faces.len(), 1);
    assert!(notes.iter().any(|note| note.starts_with("3 triangles with two corners")), "{notes:?}");
}

#[test]
fn numbers_are_written_as_short_as_they_can_be() {
    let faces = Faces::from_lists(&[[0, 1, 2]]);
    let doubles = [[0.1, -0.0, 100.0], [1e-7, -2.5e-300, 1e20], [0.3, 1.0 / 3.0, 5e-324]];
    let (bytes, _) = written(Format::Obj, &Output::new(doubles.as_slice(), &faces));
    let lines = "v 0.1 -0 100\nv 1e-7 -2.5e-300 1e20\nv 0.3 0.3333333333333333 5e-324\nf 1 2 3\n";
    assert_eq!(String::from_utf8(bytes).unwrap(), lines);
    let singles = doubles.map(|point| point.map(|value: f64| value.clamp(-1e30, 1e30) as f32));
    let (bytes, _) = written(Format::Off, &Output::new(singles.as_slice(), &faces));
    assert_eq!(String::from_utf8(bytes).unwrap(), "OFF\n3 1 0\n0.1 -0 100\n1e-7 -0 1e20\n0.3 0.33333334 0\n3 0 1 2\n");
}

#[test]
fn what_no_file_can_hold_is_not_written() {
    let triangle = Faces::from_lists(&[[0, 1, 2]]);
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let far = [[1e300, 0.0, 0.0], points[1], points[2]];
    let none = [[f64::NAN, 0.0, 0.0], points[1], points[2]];
    let beyond = Faces::from_lists(&[[0, 1, 3]]);
    let flat = Faces::from_lists(&[[0, 1]]);
    let empty = Faces::same(3, Vec::new());
    let crease = |a, sharpness| [Crease { ends: [a, 1], sharpness }];
    let (loose, fuzzy) = (crease(7, 1.0), crease(0, f64::NAN));
    let sound = Output::new(points.as_slice(), &triangle);
    let cases = [
        (Format::Ply, Output::new(none.as_slice(), &triangle), "vertex 0 is not a finite number"),
        (Format::Stl, Output::new(far.as_slice(), &triangle), "of 32 bits"),
        (Format::Gltf, Output::new(far.as_slice(), &triangle), "of 32 bits"),
        (Format::Off, Output::new(points.as_slice(), &beyond), "vertex 3"),
        (Format::Obj, Output::new(points.as_slice(), &flat), "fewer than three"),
        (Format::Gltf, Output::new(points.as_slice(), &empty), "without faces"),
        (Format::Ply, sound.normals(&points[..2]), "one normal for each"),
        (Format::Obj, sound.normals(none.as_slice()), "the normal of vertex 0"),
        (Format::Obj, sound.tags(&loose, &[]), "vertex 7"),
        (Format::Obj, sound.tags(&fuzzy, &[]), "no sharpness"),
        (Format::Obj, sound.tags(&[], &[3]), "vertex 3"),
    ];
    for (format, output, words) in cases {
        let mut bytes = Vec::new();
        let error = write(format, &output, &mut bytes).unwrap_err();
        assert!(error.to_string().contains(words), "{format}: {error}");
        assert!(bytes.is_empty(), "{format}: {words}");
    }
}

// other programs' readers agree

#[test]
fn others_read_what_is_written() {
    let soup = mixed();
    let normals = vec![[0.0, 0.0, 1.0]; 8];
    let output = Output::from(&soup).normals(normals.as_slice());

    let (bytes, _) = written(Format::Obj, &output);
    let options = tobj::LoadOptions::default();
    let (models, _) = tobj::load_obj_buf(&mut Cursor::new(bytes), &options, |_| Ok(Default::default())).unwrap();
    let mesh = &models[0].mesh;
    assert_eq!(mesh.positions, soup.positions.as_flattened());
    assert_eq!((mesh.indices.as_slice(), &mesh.face_arities), (soup.faces.corners(), &vec![4, 3, 5]));
    assert_eq!(mesh.normals.len(), 24);

    let (bytes, _) = written(Format::Ply, &output);
    let parser = ply_rs_bw::parser::Parser::<ply_rs_bw::ply::DefaultElement>::new();
    let ply = parser.read_ply(&mut Cursor::new(bytes)).unwrap();
    use ply_rs_bw::ply::Property::{Double, ListInt};
    for (vertex, position) in ply.payload["vertex"].iter().zip(&soup.positions) {
        assert_eq!([&vertex["x"], &vertex["y"], &vertex["z"]].map(Clone::clone), position.map(Double));
        assert_eq!(vertex["nz"], Double(1.0));
    }
    let lists = soup.faces.iter().map(|face| ListInt(face.iter().map(|corner| *corner as i32).collect()));
    assert!(ply.payload["face"].iter().map(|face| face["vertex_indices"].clone()).eq(lists));

    let (bytes, _) = written(Format::Stl, &output);
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).unwrap();
    assert_eq!((mesh.vertices.len(), mesh.faces.len()), (8, 2 + 1 + 3));
}

#[test]
fn a_glb_file_says_what_was_given() {
    let soup = cube();
    let normals: Vec<[f32; 3]> = (0..8).map(|i| if i < 4 { [0.0, 0.0, -1.0] } else { [0.0, 0.0, 1.0] }).collect();
    let (bytes, notes) = written(Format::Gltf, &Output::from(&soup).normals(normals.as_slice()));
    assert!(notes.len() == 1 && notes[0].contains("6 faces"), "{notes:?}");
    let gltf = gltf::Gltf::from_slice(&bytes).unwrap();
    let blob = gltf.blob.as_deref().unwrap();
    let primitive = gltf.meshes().next().unwrap().primitives().next().unwrap();
    assert_eq!(primitive.mode(), gltf::mesh::Mode::Triangles);
    let reader = primitive.reader(|_| Some(blob));
    let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
    assert!(positions.iter().zip(&soup.positions).all(|(found, given)| found.map(f64::from) == *given));
    assert!(positions.len() == 8 && reader.read_normals().unwrap().eq(normals));
    let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
    assert_eq!(indices[..6], [0, 2, 3, 0, 3, 1]);
    assert_eq!(indices.len(), 36);
    let bounds = primitive.bounding_box();
    assert_eq!((bounds.min, bounds.max), ([0.0; 3], [1.0; 3]));
}

// what is read

#[test]
fn obj_is_read_as_it_is_written_by_others() {
    let text = "\u{feff}# a pyramid \\\nmtllib stone.mtl\no pyramid\r\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 # a comment\nv 0 1 0\nvt 0 0\nvt 1 0\n\
                vn 0 0 1\nusemtl stone\ns off\nf 4/1/1 3/2/1 2//1 1/1\nv .5 5e-1 +1\nf -1 \\\n  1 \\\n 2\nf 2 3 5\nfo 3 4 5\nf 4 1 5\n\
                l 1 2\np 1\ncurv 0 1 2\nwiggle 3\nwobble 4\nt crease 2/1/0 0 1 2.5\nt crease 4/1/0 1 2 2 3 10\nt crease 4/2/0 0 4 1 4 1 0.5\n\
                t crease 1/2 3\nt crease -1 4 inf\nt corner 1/1/0 4 3.5\nt corner 2/2/0 0 1 10 0\nt corner 3 12\nt hole 1/0/0 0\n";
    let Read { soup, notes } = read(Format::Obj, text.as_bytes()).unwrap();
    assert_eq!(soup.positions[4], [0.5, 0.5, 1.0]);
    assert_eq!(
        soup.faces,
        Faces::from_lists(&[vec![3, 2, 1, 0], vec![4, 0, 1], vec![1, 2, 4], vec![2, 3, 4], vec![3, 0, 4]])
    );
    let told: Vec<([u32; 2], f64)> = soup.creases.iter().map(|crease| (crease.ends, crease.sharpness)).collect();
    let ever = f64::INFINITY;
    let expected =
        [([0, 1], 2.5), ([1, 2], ever), ([2, 3], ever), ([0, 4], 1.0), ([1, 4], 0.5), ([0, 1], 3.0), ([4, 3], ever)];
    assert_eq!(told, expected);
    assert_eq!(soup.corners, [4, 0, 2]);
    let expected = [
        ("materials and textures", "2 lines, the first is 2"),
        ("names and groups", "line 3"),
        ("weights or colours", "line 5"),
        ("texture coordinates", "2 lines, the first is 8"),
        ("normals", "line 10"),
        ("smoothing", "line 12"),
        ("points and lines", "2 lines, the first is 21"),
        ("free-form", "line 23"),
        ("unknown statements", "2 lines, the first is 24"),
        ("tags other than creases", "line 34"),
        ("`wiggle`", "line 24"),
        ("below 10", "line 31"),
    ];
    assert_eq!(notes.len(), expected.len(), "{notes:#?}");
    for (note, (what, place)) in notes.iter().zip(expected) {
        assert!(note.contains(what) && note.contains(place), "{note} | {what} | {place}");
    }
}

#[test]
fn a_corner_taken_back_is_none() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let text = format!("{triangle}t corner 1/1/0 1 10\nt corner 1/1/0 2 10\nt corner 1/1/0 1 0\n");
    assert_eq!(read(Format::Obj, text.as_bytes()).unwrap().soup.corners, [2]);
}

/// A PLY file of one element type more than is read, in any of the three forms.
fn ply(format: &str) -> Vec<u8> {
    let header = format!(
        "ply\r\nformat {format} 1.0\r\ncomment made by hand\r\nelement camera 2\r\nproperty list uchar short zoom\r\n\
         element vertex 4\r\nproperty uchar red\r\nproperty float x\r\nproperty double y\r\nproperty short z\r\n\
         element face 2\r\nproperty float quality\r\nproperty list uint8 uint vertex_index\r\nproperty list ushort char marks\r\nend_header\r\n"
    );
    let mut bytes = header.into_bytes();
    let zooms: [&[i16]; 2] = [&[5, 6], &[]];
    let vertices = [(255, 0.5_f32, 0.1_f64, -3_i16), (0, 1.5, 0.2, 300), (7, -2.0, 0.3, 0), (1, 0.0, 1e300, 9)];
    let faces: [(&[u32], &[i8]); 2] = [(&[0, 1, 2], &[-1, 5]), (&[3, 2, 1, 0], &[])];
    if format == "ascii" {
        bytes.extend(b"2 5 6\n0\n");
        vertices.iter().for_each(|(red, x, y, z)| bytes.extend(format!("{red} {x} {y} {z}\r\n").bytes()));
        bytes.extend(b"0.25 3 0 1 2 2 -1 5\n\n1 4 3 2 1 0 0\n");
        return bytes;
    }
    let mut put = |value: &[u8]| {
        let big = format == "binary_big_endian";
        bytes.extend(if big { value.iter().rev().copied().collect() } else { value.to_vec() });
    };
    for zoom in zooms {
        put(&[zoom.len() as u8]);
        zoom.iter().for_each(|value| put(&value.to_le_bytes()));
    }
    for (red, x, y, z) in vertices {
        put(&[red]);
        put(&x.to_le_bytes());
        put(&y.to_le_bytes());
        put(&z.to_le_bytes());
    }
    for (corners, marks) in faces {
        put(&1_f32.to_le_bytes());
        put(&[corners.len() as u8]);
        corners.iter().for_each(|value| put(&value.to_le_bytes()));
        put(&(marks.len() as u16).to_le_bytes());
        marks.iter().for_each(|value| put(&value.to_le_bytes()));
    }
    bytes
}

#[test]
fn ply_is_read_in_all_of_its_forms() {
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let Read { soup, notes } = read(Format::Ply, &ply(format)).unwrap();
        assert_eq!(
            soup.positions,
            [[0.5, 0.1, -3.0], [1.5, 0.2, 300.0], [-2.0, 0.3, 0.0], [0.0, 1e300, 9.0]],
            "{format}"
        );
        assert_eq!(soup.faces, Faces::from_lists(&[vec![0, 1, 2], vec![3, 2, 1, 0]]), "{format}");
        let told = ["elements `camera`", "of each vertex `red`", "of each face `quality`, `marks`"];
        assert!(notes.len() == 3 && notes.iter().zip(told).all(|(note, words)| note.ends_with(words)), "{notes:?}");
        let mut more = ply(format);
        more.extend(b"more");
        let notes = read(Format::Ply, &more).unwrap().notes;
        assert!(notes[3].contains(if format == "ascii" { "line 25" } else { "4 bytes" }), "{notes:?}");
    }
}

#[test]
fn every_cut_of_a_ply_file_is_refused() {
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let whole = ply(format);
        // the last value of a text may lose its last digit, or its end of line, and still be one
        let last = whole.len() - if format == "ascii" { 2 } else { 0 };
        for end in 0..last {
            assert!(read(Format::Ply, &whole[..end]).is_err(), "{format}, {end} of {} bytes", whole.len());
        }
    }
}

#[test]
fn off_is_read_with_its_variants() {
    let triangle = Faces::from_lists(&[[0, 1, 2]]);
    let cases: [(&str, &[&str]); 6] = [
        ("OFF\n# three\n3 1 0\n\n0 0 0\n1 0 0 # second\n0 1 0\n3 0 1 2\n", &[]),
        ("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3  0 1 2 255 0 0\n", &["colours of faces (line 5)"]),
        ("OFF3 1\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2", &[]),
        (
            "COFF\n3 1 3\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n",
            &["colours", "3 lines, the first is 3"],
        ),
        ("STCNOFF\r3 1 3\r0 0 0\r1 0 0\r0 1 0\r3 0 1 2\r", &[]),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n", &["what follows the last face (line 7)"]),
    ];
    for (text, words) in cases {
        let Read { soup, notes } = read(Format::Off, text.as_bytes()).unwrap();
        assert_eq!((soup.positions, soup.faces), (vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], triangle.clone()));
        assert_eq!(notes.len(), usize::from(!words.is_empty()), "{text}: {notes:?}");
        assert!(words.iter().all(|word| notes[0].contains(word)), "{text}: {notes:?}");
    }
}

/// A tetrahedron of text, without its end.
const SOLID: &str = "solid of four faces\nFACET NORMAL 0 0 -1\n outer loop\n  vertex 0 0 0\n  vertex 0 1 0\n  vertex 1 0 0\n endloop\nendfacet\n\
     facet normal 0 -1 0\n outer loop\n vertex -0.0 0 0\n vertex 1 0 0\n vertex 0 0 0.1\n endloop\nendfacet\n";

/// The same in binary, with an attribute on the second facet.
fn solid() -> Vec<u8> {
    let mut bytes = b"solid, which a binary file should not say".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(2_u32.to_le_bytes());
    let facets: [[f32; 12]; 2] =
        [[0., 0., -1., 0., 0., 0., 0., 1., 0., 1., 0., 0.], [0., -1., 0., -0., 0., 0., 1., 0., 0., 0., 0., 0.125]];
    for (facet, attribute) in facets.iter().zip([0_u16, 7]) {
        facet.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
        bytes.extend(attribute.to_le_bytes());
    }
    bytes
}

#[test]
fn stl_points_are_welded() {
    let text = format!("{SOLID}endsolid\nsolid 2\nendsolid 2\n");
    let Read { soup, notes } = read(Format::Stl, text.as_bytes()).unwrap();
    assert_eq!(soup.positions, [[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.1]]);
    assert_eq!(soup.faces, Faces::from_lists(&[[0, 1, 2], [0, 2, 3]]));
    assert!(notes.len() == 1 && notes[0].contains("line 17"), "{notes:?}");
    let Read { soup, notes } = read(Format::Stl, &solid()).unwrap();
    assert_eq!(soup.positions[3], [0.0, 0.0, 0.125]);
    assert_eq!(soup.faces, Faces::from_lists(&[[0, 1, 2], [0, 2, 3]]));
    assert!(notes.len() == 1 && notes[0].contains("attributes") && notes[0].contains("(1 facets)"), "{notes:?}");
}

// what is refused

/// A case: its name, the file, the kind of the fault, its line (0 where there is none), words of the message.
type Case<'a> = (&'a str, &'a [u8], Kind, usize, &'a [&'a str]);

fn hold(format: Format, cases: &[Case]) {
    let wrong: Vec<String> = cases.iter().filter_map(|case| complaint(format, case)).collect();
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), cases.len(), wrong.join("\n"));
}

fn complaint(format: Format, (name, bytes, kind, line, words): &Case) -> Option<String> {
    let fault = match read(format, bytes) {
        Ok(read) => return Some(format!("== {name}: was read as {read:?}")),
        Err(fault) => fault,
    };
    let text = fault.to_string();
    let mut wrong: Vec<String> =
        words.iter().filter(|word| !text.contains(**word)).map(|word| format!("no `{word}`")).collect();
    if fault.kind != *kind {
        wrong.push(format!("{:?}", fault.kind));
    }
    if fault.line().unwrap_or(0) != *line {
        wrong.push(format!("line {:?}", fault.line()));
    }
    if fault.help.is_empty() || text.len() > 400 {
        wrong.push("no help, or too much".to_string());
    }
    (!wrong.is_empty()).then(|| format!("== {name}: {}\n   {text}", wrong.join("; ")))
}

#[test]
fn files_of_nothing_and_of_other_formats() {
    for format in Format::ALL {
        assert_eq!(refusal(format, b"").kind, Kind::Empty);
        assert_eq!(refusal(format, b" \n\r\n").kind, Kind::Empty);
        let message = refusal(format, &b"\x7fELF\x02\x01\x01\0\0\0\0".repeat(30)).to_string();
        assert!(message.len() < 300, "{message}");
    }
    assert_eq!(refusal(Format::Gltf, b"glTF").kind, Kind::NotRead);
    for (format, bytes, other) in [
        (Format::Obj, ply("ascii"), "PLY"),
        (Format::Off, ply("binary_big_endian"), "PLY"),
        (Format::Ply, SOLID.into(), "STL"),
        (Format::Stl, b"OFF\n3 1 0\n".to_vec(), "OFF"),
        (Format::Ply, written(Format::Gltf, &Output::from(&cube())).0, "glTF"),
    ] {
        let message = refusal(format, &bytes).to_string();
        assert!(message.contains(&format!("the file starts as {other} does")), "{message}");
    }
}

#[test]
fn faults_of_obj_files() {
    let huge = format!("v 0 0 0\nf{}\n", " 1".repeat(70_000));
    let long = format!("v 0 0 {}\n", "9".repeat(5_000));
    let head = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let with = |rest: &str| format!("{head}{rest}").into_bytes();
    hold(
        Format::Obj,
        &[
            ("no faces", head.as_bytes(), Kind::NoFaces, 0, &["no face"]),
            ("only a comment", b"# nothing", Kind::NoFaces, 0, &["no face"]),
            ("curves only", &with("l 1 2\n"), Kind::NoFaces, 0, &["lines"]),
            ("two coordinates", b"v 1 2\n", Kind::Number, 1, &["three coordinates", "2 are here", "x, y and z"]),
            ("a word", b"v 1 2 x\nv 1 2 y\nv 1 2\nf 1 2 3\n", Kind::Number, 1, &["`x`", "2 more"]),
            ("a comma", b"\nv 1 2 3,5\n", Kind::Number, 2, &["`3,5`", "no comma"]),
            ("not a number", b"v 0 0 nan\n", Kind::Number, 1, &["`nan`", "not a finite number"]),
            ("infinity", b"v 0 inf 0\n", Kind::Number, 1, &["`inf`"]),
            ("too large", b"v 1e400 0 0\n", Kind::Number, 1, &["`1e400`"]),
            ("many digits", long.replace('9', "9e").as_bytes(), Kind::Number, 1, &["`9e9e", "..."]),
            ("index 0", &with("f 0 1 2\n"), Kind::Index, 4, &["no vertex 0", "counts from 1"]),
            (
                "beyond the end",
                &with("f 1 2 3\nf 1 2 \\\n 3\nf 1 2 9\nf 8 1 2\n"),
                Kind::Index,
                7,
                &["no vertex 9", "has 3", "one more"],
            ),
            ("beyond at the first corner", &with("f 1 2 3\nf 9 1 2\n"), Kind::Index, 5, &["no vertex 9"]),
            ("before the start", &with("f 1 2 -4\n"), Kind::Index, 4, &["no vertex -4"]),
            ("a huge index", &with("f 1 2 99999999999\n"), Kind::Index, 4, &["99999999999"]),
            (
                "beyond whole numbers",
                &with("f 1 2 99999999999999999999\n"),
                Kind::Index,
                4,
                &["`99999999999999999999` is no index"],
            ),
            ("the least number", &with("f 1 2 -9223372036854775808\n"), Kind::Index, 4, &["-9223372036854775808"]),
            ("a word for an index", &with("f 1 2 three\n"), Kind::Index, 4, &["`three`"]),
            ("an empty index", &with("f 1 2 /3\n"), Kind::Index, 4, &["`` is no index"]),
            ("two corners", &with("f 1 2\n"), Kind::Face, 4, &["2 corners", "three or more"]),
            ("no corners", &with("f\n"), Kind::Face, 4, &["0 corners"]),
            ("a corner twice", &with("f 1 2 1\nf 1 2 3\nf 1 2 2 3\n"), Kind::Face, 4, &["a corner twice", "one more"]),
            ("twice by other names", &with("f 1 2 -3\n"), Kind::Face, 4, &["a corner twice"]),
            ("a huge face of one corner", huge.as_bytes(), Kind::Face, 2, &["a corner twice"]),
            ("binary", b"v 0 0 0\nv \0\x01", Kind::NotText, 2, &["byte of 0", "no text"]),
            ("UTF-16", b"\xff\xfev\0 \0", Kind::NotText, 1, &["UTF-16", "UTF-8"]),
            ("not UTF-8", b"v \xff\xfe 0 0\n", Kind::Number, 1, &["not a finite number"]),
            ("control characters", b"v \x1b[31m 0 0\n", Kind::Number, 1, &["\\u{1b}[31m"]),
        ],
    );
}

#[test]
fn only_faults_of_the_same_kind_are_counted() {
    let fault =
        refusal(Format::Obj, b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nv x 0 0\nf 1 2 0\nf 1\nf 1 2 1\nt crease 1 2\n");
    assert_eq!((fault.kind, fault.line(), fault.more), (Kind::Face, Some(4), 2));
}

#[test]
fn faults_of_tags() {
    let with = |rest: &str| format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n{rest}").into_bytes();
    hold(
        Format::Obj,
        &[
            (
                "too few words",
                &with("t crease 2/1/0 0 1\n"),
                Kind::Tag,
                5,
                &["announces 3 words, but has 2", "t crease 2/1/0"],
            ),
            ("too many words", &with("t crease 2/1/0 0 1 2 3\n"), Kind::Tag, 5, &["announces 3 words, but has 4"]),
            (
                "huge counts",
                &with("t crease 9223372036854775807/9223372036854775807/3 0\n"),
                Kind::Tag,
                5,
                &["announces"],
            ),
            ("three ends", &with("t crease 3/1/0 0 1 2 1\n"), Kind::Tag, 5, &["lists 3 vertices"]),
            ("no ends", &with("t crease 0/1/0 1\n"), Kind::Tag, 5, &["lists 0 vertices"]),
            ("no sharpness", &with("t crease 2/0/0 0 1\n"), Kind::Tag, 5, &["0 sharpnesses"]),
            ("sharpnesses for no edge", &with("t crease 2/2/0 0 1 1 1\n"), Kind::Tag, 5, &["2 sharpnesses"]),
            ("words", &with("t crease 2/1/1 0 1 1 x\n"), Kind::Tag, 5, &["words"]),
            ("less than nothing", &with("t crease 2/1/0 0 1 -1\n"), Kind::Tag, 5, &["`-1`", "0 or more"]),
            ("not a number", &with("t crease 1 2 nan\n"), Kind::Tag, 5, &["`nan`"]),
            ("the same ends", &with("t crease 2/1/0 1 1 1\n"), Kind::Tag, 5, &["same vertex"]),
            ("a negative end", &with("t crease 2/1/0 -1 1 1\n"), Kind::Tag, 5, &["-1", "from 0"]),
            (
                "an end beyond",
                &with("t corner 1/1/0 4 1\nt crease 2/1/0 0 3 1\n"),
                Kind::Tag,
                5,
                &["vertex 4", "has 3", "one more"],
            ),
            ("a plain end of 0", &with("t crease 0 1 1\n"), Kind::Index, 5, &["counts from 1"]),
            ("a plain end beyond", &with("t crease 1 4 1\n"), Kind::Tag, 5, &["vertex 3, counted from 0"]),
            ("three plain ends", &with("t crease 1 2 3 1\n"), Kind::Tag, 5, &["3 come before"]),
            ("a plain corner of two", &with("t corner 1 2 3\n"), Kind::Tag, 5, &["one vertex"]),
            ("nothing", &with("t crease\n"), Kind::Tag, 5, &["no vertices"]),
            ("a corner of nothing", &with("t corner 0/1/0 1\n"), Kind::Tag, 5, &["no vertex"]),
        ],
    );
}

#[test]
fn faults_of_off_files() {
    hold(
        Format::Off,
        &[
            ("only a comment", b"# nothing", Kind::Syntax, 1, &["no word OFF"]),
            ("another word", b"\nFOO\n3 1 0\n", Kind::Syntax, 2, &["`FOO`"]),
            ("four dimensions", b"4OFF\n", Kind::NotRead, 1, &["`4OFF`"]),
            ("binary", b"OFF BINARY\n1", Kind::NotRead, 1, &["binary"]),
            ("no counts", b"OFF\n", Kind::Syntax, 1, &["numbers of vertices"]),
            ("one count", b"OFF\n3\n", Kind::Syntax, 2, &["numbers of vertices"]),
            ("a negative count", b"OFF\n3 -1 0\n", Kind::Syntax, 2, &["numbers of vertices"]),
            (
                "billions",
                b"OFF\n9000000000 9000000000 0\n0 0 0\n",
                Kind::Truncated,
                3,
                &["after 1 of 9000000000 vertices"],
            ),
            ("the most", b"OFF\n9223372036854775807 1 0\n0 0 0\n", Kind::Truncated, 3, &["after 1 of"]),
            (
                "too few faces",
                b"OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                Kind::Truncated,
                6,
                &["after 1 of 2 faces"],
            ),
            ("no faces", b"OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", Kind::NoFaces, 0, &["no face"]),
            ("two coordinates", b"OFF\n1 1 0\n0 0\n3 0 1 2\n", Kind::Number, 3, &["2 are here"]),
            (
                "an index beyond",
                b"OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n3 0 1 -1\n",
                Kind::Index,
                6,
                &["no vertex 3", "from 0", "one more"],
            ),
            (
                "corners missing",
                b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n",
                Kind::Face,
                6,
                &["announces 4 corners, but has 3"],
            ),
            (
                "billions of corners",
                b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9999999999 0 1 2\n",
                Kind::Face,
                6,
                &["but has 3"],
            ),
            ("an edge", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", Kind::Face, 6, &["2 corners"]),
            (
                "no number of corners",
                b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3.0 0 1 2\n",
                Kind::Syntax,
                6,
                &["number of its corners"],
            ),
            ("not text", b"OFF\n3 1 0\n\0", Kind::NotText, 3, &["no text"]),
        ],
    );
}

#[test]
fn faults_of_ply_headers() {
    let head = |lines: &str| format!("ply\n{lines}end_header\n0 0 0\n").into_bytes();
    let vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    let face = "element face 1\nproperty list uchar int vertex_indices\n";
    let with = |lines: &str| head(&format!("format ascii 1.0\n{lines}"));
    let all = |format: &str, vertices: &str, faces: &str| {
        let (vertex, face) = (
            vertex.replace("vertex 1", &format!("vertex {vertices}")),
            face.replace("face 1", &format!("face {faces}")),
        );
        head(&format!("format {format} 1.0\n{vertex}{face}"))
    };
    let (little, billions) = ("binary_little_endian", "9000000000");
    hold(
        Format::Ply,
        &[
            ("not ply", b"plyy\n", Kind::Syntax, 1, &["not `ply`"]),
            ("no end", b"ply\nformat ascii 1.0\n", Kind::Truncated, 2, &["no `end_header`"]),
            ("no format", &head(vertex), Kind::Syntax, 6, &["no line `format`"]),
            ("another format", &head("format binary 1.0\n"), Kind::Syntax, 2, &["no format `binary`", "ascii"]),
            ("an unknown line", &with("elements 3\n"), Kind::Syntax, 3, &["`elements 3`"]),
            (
                "an unknown type",
                &with("element vertex 1\nproperty half x\n"),
                Kind::Syntax,
                4,
                &["no type `half`", "float"],
            ),
            ("a list without end", &with("element vertex 1\nproperty list x\n"), Kind::Syntax, 4, &["no type `list`"]),
            (
                "a list of broken length",
                &with("element vertex 1\nproperty list float int x\n"),
                Kind::Syntax,
                4,
                &["no whole number"],
            ),
            ("a property of nothing", &with("property float x\n"), Kind::Syntax, 3, &["before any element"]),
            ("a negative count", &with("element vertex -1\n"), Kind::Syntax, 3, &["`-1`"]),
            (
                "a count beyond numbers",
                &with("element vertex 99999999999999999999\n"),
                Kind::Syntax,
                3,
                &["no number of elements"],
            ),
            ("no vertices", &with(face), Kind::Syntax, 5, &["no element `vertex`"]),
            ("no faces", &with(vertex), Kind::NoFaces, 0, &["no face"]),
            (
                "no z",
                &with(&format!("{}{face}", vertex.replace("float z", "float w"))),
                Kind::Syntax,
                3,
                &["no number `z`"],
            ),
            (
                "z is a list",
                &with(&format!("{}{face}", vertex.replace("float z", "list uchar float z"))),
                Kind::Syntax,
                3,
                &["no number `z`"],
            ),
            (
                "faces without a list",
                &with(&format!("{vertex}element face 1\nproperty int a\n")),
                Kind::Syntax,
                7,
                &["`vertex_indices`"],
            ),
            (
                "broken indices",
                &with(&format!("{vertex}{}", face.replace("int", "float"))),
                Kind::Syntax,
                7,
                &["whole numbers"],
            ),
            (
                "billions of vertices, text",
                &all("ascii", billions, "1"),
                Kind::Truncated,
                9,
                &[billions, "only 6 bytes"],
            ),
            ("billions of faces, text", &all("ascii", "1", billions), Kind::Truncated, 10, &[billions, "only 0 bytes"]),
            (
                "billions of vertices, binary",
                &all(little, billions, "1"),
                Kind::Truncated,
                0,
                &[billions, "vertex 0", "only 6 bytes"],
            ),
            (
                "the most vertices, binary",
                &all(little, "9223372036854775807", "1"),
                Kind::Truncated,
                0,
                &["only 6 bytes"],
            ),
            ("billions of faces, binary", &all(little, "0", billions), Kind::Truncated, 0, &[billions, "face 0"]),
            (
                "billions of nothing",
                &with(&format!("element void {billions}\n{vertex}{face}")),
                Kind::Truncated,
                11,
                &["only 0 bytes"],
            ),
        ],
    );
}

#[test]
fn faults_of_ply_rows() {
    let head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let with = |rows: &str| format!("{head}{rows}").into_bytes();
    let rows = "0 0 0\n1 0 0\n0 1 0\n";
    let ended = |row: &str| with(&format!("{rows}{row}\n"));
    hold(
        Format::Ply,
        &[
            ("a vertex missing", &with("0 0 0\n1 0 0\n"), Kind::Truncated, 11, &["after 2 of 3", "`vertex`"]),
            ("the faces missing", &with(rows), Kind::Truncated, 12, &["`face`"]),
            ("a coordinate missing", &with("0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), Kind::Syntax, 11, &["fewer values"]),
            ("a value too many", &with("0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n"), Kind::Syntax, 11, &["more values", "`0`"]),
            ("a word", &with("0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n"), Kind::Number, 11, &["`x`"]),
            (
                "not a number",
                &with("0 0 0\n1 nan 0\n0 1 inf\n3 0 1 2\n"),
                Kind::Number,
                11,
                &["not a finite number", "one more"],
            ),
            ("a corner missing", &ended("4 0 1 2"), Kind::Syntax, 13, &["fewer values"]),
            ("a corner beyond", &ended("3 0 1 3"), Kind::Index, 13, &["no vertex 3", "has 3", "from 0"]),
            ("a negative corner", &ended("3 0 1 -1"), Kind::Index, 13, &["no vertex -1"]),
            ("half a corner", &ended("3 0 1 1.5"), Kind::Index, 13, &["no vertex 1.5"]),
            ("a corner twice", &ended("3 0 1 1"), Kind::Face, 13, &["a corner twice"]),
            ("an edge", &ended("2 0 1"), Kind::Face, 13, &["2 corners"]),
            ("a negative length", &ended("-3 0 1 2"), Kind::Syntax, 13, &["-3 is no length"]),
            ("a huge length", &ended("4000000000 0 1 2"), Kind::Syntax, 13, &["fewer values"]),
        ],
    );
}

#[test]
fn faults_of_binary_files_name_their_elements() {
    let soup = cube();
    let (mut sound, _) = written(Format::Ply, &Output::from(&soup));
    let rows = sound.len() - 6 * 17;
    sound[rows + 17 + 5] = 9;
    let fault = refusal(Format::Ply, &sound);
    assert_eq!(
        (fault.kind, &fault.place),
        (Kind::Index, &Place::Element { what: "face".into(), index: 1, byte: rows + 17 })
    );
    assert!(fault.to_string().starts_with("face 1 (counted from 0), at byte "), "{fault}");
    let (mut sound, _) = written(Format::Ply, &Output::from(&soup));
    let third = rows - 8 * 24 + 3 * 24;
    sound[third..third + 8].copy_from_slice(&f64::NAN.to_le_bytes());
    let fault = refusal(Format::Ply, &sound);
    assert_eq!(
        (fault.kind, &fault.place),
        (Kind::Number, &Place::Element { what: "vertex".into(), index: 3, byte: third })
    );
    let (mut sound, _) = written(Format::Ply, &Output::from(&soup));
    sound[rows] = 255;
    assert_eq!(refusal(Format::Ply, &sound).kind, Kind::Truncated);

    let sound = solid();
    for length in 1..sound.len() {
        assert!(read(Format::Stl, &sound[..length]).is_err(), "{length}");
    }
    let mut many = sound.clone();
    many[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let fault = refusal(Format::Stl, &many);
    assert!(fault.kind == Kind::Truncated && fault.message.contains("4294967295 facets"), "{fault}");
    let mut flat = sound.clone();
    flat.copy_within(84 + 50 + 24..84 + 50 + 36, 84 + 50 + 36);
    let fault = refusal(Format::Stl, &flat);
    assert_eq!((fault.kind, fault.place), (Kind::Face, Place::Element { what: "facet".into(), index: 1, byte: 134 }));
    let mut infinite = sound;
    infinite[84 + 12..84 + 16].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert_eq!(refusal(Format::Stl, &infinite).kind, Kind::Number);
}

#[test]
fn faults_of_stl_files_of_text() {
    let with = |from: &str, to: &str| {
        assert!(SOLID.contains(from));
        format!("{}endsolid\n", SOLID.replacen(from, to, 1)).into_bytes()
    };
    hold(
        Format::Stl,
        &[
            ("no facets", b"solid\nendsolid\n", Kind::NoFaces, 0, &["no face"]),
            ("no end", SOLID.as_bytes(), Kind::Truncated, 15, &["no `endsolid`"]),
            ("a point missing", &with("  vertex 0 1 0\n", ""), Kind::Face, 2, &["2 vertices", "three"]),
            ("a point too many", &with("vertex 0 1 0", "vertex 0 1 0\nvertex 0 1 1"), Kind::Face, 2, &["4 vertices"]),
            ("a degenerate facet", &with("vertex 0 1 0", "vertex 0 -0 0"), Kind::Face, 2, &["same point"]),
            ("a coordinate missing", &with("vertex 0 1 0", "vertex 0 1"), Kind::Number, 5, &["2 are here"]),
            ("a word", &with("vertex 0 1 0", "vertex 0 1 o"), Kind::Number, 5, &["`o`"]),
            ("an unknown word", &with("endloop", "endlop"), Kind::Syntax, 7, &["`endlop`", "endfacet"]),
            ("a facet within a facet", &with("endfacet\n", ""), Kind::Syntax, 8, &["`facet`"]),
            ("a point outside", &with("endfacet\n", "endfacet\nvertex 0 0 0\n"), Kind::Syntax, 9, &["`vertex`"]),
            ("too short", b"stl", Kind::Truncated, 0, &["at least 84 bytes", "but this has 3"]),
        ],
    );
}

// large and random

#[test]
fn a_million_faces_are_read_and_written() {
    const WIDE: u32 = 1000;
    let positions: Vec<[f32; 3]> =
        (0..(WIDE + 1) * (WIDE + 1)).map(|i| [(i % (WIDE + 1)) as f32, (i / (WIDE + 1)) as f32, 0.5]).collect();
    let quad = |i: u32| {
        let at = i / WIDE * (WIDE + 1) + i % WIDE;
        [at, at + 1, at + WIDE + 2, at + WIDE + 1]
    };
    let faces = Faces::same(4, (0..WIDE * WIDE).flat_map(quad).collect());
    let doubles: Vec<[f64; 3]> = positions.iter().map(|point| point.map(f64::from)).collect();
    for format in [Format::Obj, Format::Ply, Format::Off] {
        let (bytes, notes) = written(format, &Output::new(positions.as_slice(), &faces));
        let soup = read(format, &bytes).unwrap().soup;
        assert!(notes.is_empty() && soup.positions == doubles && soup.faces == faces, "{format}");
    }
    let (bytes, _) = written(Format::Stl, &Output::new(positions.as_slice(), &faces));
    let soup = read(Format::Stl, &bytes).unwrap().soup;
    assert_eq!((soup.positions.len(), soup.faces.len()), (positions.len(), 2 * faces.len()));
}

#[test]
fn a_face_may_have_more_corners_than_16_bits_count() {
    let count = 70_000;
    let positions: Vec<[f64; 3]> = (0..count).map(|i| [f64::from(i), 0.0, 0.0]).collect();
    let faces = Faces::same(count as u32, (0..count as u32).collect());
    for format in [Format::Obj, Format::Ply, Format::Off] {
        let (bytes, _) = written(format, &Output::new(positions.as_slice(), &faces));
        assert_eq!(read(format, &bytes).unwrap().soup.faces, faces, "{format}");
    }
}

fn finite() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>().prop_filter("finite", |x| x.is_finite()), -10.0..10.0, any::<i8>().prop_map(f64::from)]
}

/// Points, faces on them, and tags.
fn soups() -> impl Strategy<Value = PolygonSoup> {
    prop::collection::vec([finite(), finite(), finite()], 3..30).prop_flat_map(|positions| {
        let all: Vec<usize> = (0..positions.len()).collect();
        let end = 0..positions.len() as u32;
        let face = prop::sample::subsequence(all, 3..=positions.len().min(7)).prop_shuffle();
        let crease = (end.clone(), end.clone(), prop_oneof![0.0..20.0, Just(f64::INFINITY), Just(10.0)]);
        let crease = crease.prop_filter("two ends", |(a, b, _)| a != b);
        let creases =
            prop::collection::vec(crease.prop_map(|(a, b, sharpness)| Crease { ends: [a, b], sharpness }), 0..5);
        let corners = prop::collection::vec(end, 0..4);
        (Just(positions), prop::collection::vec(face, 1..20), creases, corners).prop_map(
            |(positions, faces, creases, corners)| PolygonSoup {
                positions,
                faces: Faces::from_lists(&faces),
                creases,
                corners,
            },
        )
    })
}

/// Bits, so that -0 and 0 are told apart.
fn bits(positions: &[[f64; 3]]) -> Vec<[u64; 3]> {
    positions.iter().map(|point| point.map(f64::to_bits)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_polygons_come_back(soup in soups()) {
        for format in [Format::Obj, Format::Ply, Format::Off] {
            let (bytes, _) = written(format, &Output::from(&soup));
            let Read { soup: back, notes } = read(format, &bytes).unwrap();
            prop_assert_eq!(bits(&back.positions), bits(&soup.positions));
            prop_assert_eq!(&back.faces, &soup.faces);
            prop_assert!(notes.iter().all(|note| note.contains("is on no edge")), "{notes:?}");
            if format == Format::Obj {
                prop_assert_eq!(back, soup.clone());
            }
        }
    }

    #[test]
    fn numbers_of_32_bits_come_back_as_such(raw in prop::collection::vec(any::<[f32; 3]>(), 3..20)) {
        let points: Vec<[f32; 3]> = raw.into_iter().map(|point| point.map(|x| if x.is_finite() { x } else { 1.5 })).collect();
        let faces = Faces::from_lists(&[[0, 1, 2]]);
        for format in [Format::Obj, Format::Ply, Format::Off] {
            let (bytes, _) = written(format, &Output::new(points.as_slice(), &faces));
            let back = read(format, &bytes).unwrap().soup.positions;
            let same = back.iter().zip(&points).all(|(back, given)| back.map(|x| (x as f32).to_bits()) == given.map(f32::to_bits));
            prop_assert!(same && back.len() == points.len());
        }
    }

    /// A stand-in for the fuzz targets: sound files with bytes changed, cut out, doubled or put in are read or refused, and what is
    /// read is written and read back the same.
    #[test]
    fn mutated_files_are_read_or_refused(
        which in 0_usize..9,
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0_u8..5, any::<u8>(), 1_usize..20), 0..6),
    ) {
        let mut bytes = seed(which);
        for (at, kind, byte, length) in edits {
            let at = at.index(bytes.len() + 1);
            let end = (at + length).min(bytes.len());
            match kind {
                0 if at < bytes.len() => bytes[at] = byte,
                1 => drop(bytes.drain(at..end)),
                2 => bytes.extend_from_within(at..end),
                3 => bytes.insert(at, byte),
                _ => bytes.insert(at, b"0123456789-./ \n#e"[usize::from(byte) % 17]),
            }
        }
        for format in [Format::Obj, Format::Ply, Format::Off, Format::Stl] {
            let Ok(Read { soup, .. }) = read(format, &bytes) else { continue };
            let mut again = Vec::new();
            // coordinates beyond 32 bits, and triangles that collapse there, are no STL
            let Ok(_) = write(format, &Output::from(&soup), &mut again) else {
                prop_assert_eq!(format, Format::Stl);
                continue
            };
            let back = read(format, &again).unwrap().soup;
            if format != Format::Stl {
                prop_assert_eq!(bits(&back.positions), bits(&soup.positions));
                prop_assert_eq!(back.faces, soup.faces);
                prop_assert_eq!((back.creases, back.corners), (soup.creases, soup.corners));
            }
        }
    }
}

/// Sound files to start from.
fn seed(which: usize) -> Vec<u8> {
    let output = Output::from;
    match which {
        0 => written(Format::Obj, &output(&mixed())).0,
        1 => written(Format::Ply, &output(&mixed())).0,
        2 => written(Format::Off, &output(&mixed())).0,
        3 => written(Format::Stl, &output(&mixed())).0,
        4 => ply("ascii"),
        5 => ply("binary_big_endian"),
        6 => format!("{SOLID}endsolid\n").into_bytes(),
        7 => solid(),
        _ => b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 \\\n-2 -1\nt crease 1/2 3\nt corner 1/1/0 1 2\n".to_vec(),
    }
}
