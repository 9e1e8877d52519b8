//! Do `refine`, `limit` and `verify` do on the command line what they say, and refuse what they must?
#![allow(clippy::unwrap_used)]

use assert_cmd::Command;
use eigenring::mesh::io::{Format, Output as MeshOutput, read, write};
use eigenring::mesh::{PolygonSoup, shapes};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use tempfile::TempDir;

struct Folder(TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn file(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        fs::write(self.path(name), text).unwrap();
        self.path(name)
    }

    fn mesh(&self, name: &str, soup: &PolygonSoup) -> PathBuf {
        let mut bytes = Vec::new();
        write(Format::of_path(Path::new(name)).unwrap(), &MeshOutput::from(soup), &mut bytes).unwrap();
        self.file(name, bytes)
    }

    fn run(&self, arguments: &str) -> (i32, String, String) {
        let mut command = Command::cargo_bin("eigenring").unwrap();
        let Output { status, stdout, stderr } =
            command.current_dir(self.0.path()).args(arguments.split_whitespace()).output().unwrap();
        (status.code().unwrap(), String::from_utf8(stdout).unwrap(), String::from_utf8(stderr).unwrap())
    }

    fn read(&self, name: &str) -> PolygonSoup {
        read(Format::of_path(Path::new(name)).unwrap(), &fs::read(self.path(name)).unwrap()).unwrap().soup
    }

    /// Runs a command that must be refused with these words, and must write nothing.
    fn refused(&self, arguments: &str, words: &[&str]) {
        let before = fs::read_dir(self.0.path()).unwrap().count();
        let (code, out, err) = self.run(arguments);
        assert_eq!(code, 2, "{arguments}: {err}");
        assert!(out.is_empty() && !err.contains("panicked") && !err.contains("internal error"), "{arguments}: {err}");
        for word in words {
            assert!(err.contains(word), "{arguments}: `{word}` is not in\n{err}");
        }
        assert_eq!(fs::read_dir(self.0.path()).unwrap().count(), before, "{arguments}: a file was left behind");
    }
}

#[test]
fn refine_writes_the_mesh_and_tells_its_figures() {
    let folder = Folder::new();
    folder.mesh("cube.obj", &shapes::cube());
    let (code, out, err) = folder.run("refine catmull-clark cube.obj -o out.ply");
    assert_eq!((code, out.as_str()), (0, ""), "{err}");
    assert!(err.contains("read: 8 vertices, 12 edges, 6 faces, Euler characteristic 2\n  valences 3: 8\n"), "{err}");
    assert!(err.contains("refined: 26 vertices, 48 edges, 24 faces, Euler characteristic 2"), "{err}");
    assert!(err.contains("faces at a vertex 3: 8, 4: 18"), "{err}");
    let soup = folder.read("out.ply");
    assert_eq!((soup.positions.len(), soup.faces.len(), soup.faces.same_size()), (26, 24, Some(4)));
    // n = 3: (n-2)/n of the corner, 1/n of the mean of its neighbours and of that of the new face points
    let corner = -(1.0 / 3.0 + (1.0 / 3.0) * (1.0 / 3.0) + (1.0 / 3.0) * (1.0 / 3.0));
    assert!(soup.positions[0].iter().all(|x| (x - corner).abs() < 1e-15), "{:?}", soup.positions[0]);
    for format in ["obj", "off", "ply"] {
        let (code, _, err) = folder.run(&format!("refine catmull-clark cube.obj -o again.{format} --threads 1"));
        assert_eq!(code, 0, "{err}");
        assert_eq!(folder.read(&format!("again.{format}")), soup);
    }
}

#[test]
fn the_number_of_threads_and_of_levels_change_nothing_else() {
    let folder = Folder::new();
    folder.mesh("torus.obj", &shapes::torus(12, 14, true));
    for threads in [1, 2, 3] {
        let (code, _, err) = folder.run(&format!("refine loop torus.obj -o {threads}.ply -l 3 --threads {threads}"));
        assert_eq!(code, 0, "{err}");
    }
    let bytes = |threads: usize| fs::read(folder.path(&format!("{threads}.ply"))).unwrap();
    assert!(bytes(1) == bytes(2) && bytes(1) == bytes(3));
    assert_eq!(folder.run("refine loop torus.obj -o 0.obj -l 0").0, 0);
    assert_eq!(folder.read("0.obj"), folder.read("torus.obj"));
    assert_eq!(folder.run("refine loop torus.obj -o one.obj").0, 0);
    assert_eq!(folder.run("refine loop one.obj -o two.obj -l 2").0, 0);
    assert_eq!(folder.run("refine loop torus.obj -o three.obj -l 3").0, 0);
    let (two, three) = (folder.read("two.obj"), folder.read("three.obj"));
    assert_eq!(two.faces, three.faces, "a file between the steps changes nothing but rounding");
    let near = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-14);
    assert!(two.positions.iter().zip(&three.positions).all(near));
    let (_, _, err) = folder.run("refine loop torus.obj -o single.ply -l 3 --precision single");
    assert!(err.contains("faces"), "{err}");
    for (a, b) in folder.read("single.ply").positions.iter().zip(&folder.read("1.ply").positions) {
        assert!((0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-5 && f64::from(a[axis] as f32) == a[axis]));
    }
}

#[test]
fn limit_gives_points_normals_and_the_places_without() {
    let folder = Folder::new();
    folder.mesh("cube.obj", &shapes::cube());
    let (code, _, err) = folder.run("limit catmull-clark cube.obj -o out.obj");
    assert_eq!(code, 0, "{err}");
    // n/(n+5), 4/(n(n+5)) and 1/(n(n+5)) at n = 3 give half of the corner (Halstead, Kass and DeRose 1993)
    assert!(folder.read("out.obj").positions.iter().flatten().all(|x| (x.abs() - 0.5).abs() < 1e-15));
    let text = fs::read_to_string(folder.path("out.obj")).unwrap();
    assert_eq!(text.lines().filter(|line| line.starts_with("vn ")).count(), 8);
    // refining first changes nothing for the old vertices
    assert_eq!(folder.run("refine catmull-clark cube.obj -o deep.obj -l 3 --to-limit").0, 0);
    for (a, b) in folder.read("out.obj").positions.iter().zip(&folder.read("deep.obj").positions) {
        assert!((0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-14));
    }
    folder.mesh("fan.obj", &shapes::fan(7, true));
    let (code, _, err) = folder.run("limit loop fan.obj -o fan.ply");
    assert!(code == 0 && err.contains("no normal at vertex 0") && err.contains("no tangent plane"), "{err}");
    folder.mesh("slow.obj", &shapes::fan(6, true));
    assert!(
        folder.run("limit loop slow.obj -o slow.ply").2.contains("vertex 0: its tangents belong to a Jordan block")
    );
    // one component below, one above: the unmodified butterfly has no tangent plane at n = 8
    folder.file("butterfly.toml", BUTTERFLY);
    folder.mesh("eight.obj", &shapes::bipyramid(8));
    let (code, _, err) = folder.run("limit butterfly.toml eight.obj -o eight.ply");
    assert!(code == 0 && err.contains("no tangent plane: the largest eigenvalue after 1"), "{err}");
    folder.mesh("open.obj", &shapes::grid(2, 2, false));
    folder.refused("limit doo-sabin open.obj -o no.ply", &["vertex 0 has no limit point", "recedes"]);
}

const BUTTERFLY: &str = r#"
name = "Butterfly"
mesh = "triangles"
split = "1-to-4"
[vertex]
centre = "1"
[edge]
ends = "1/2"
opposite = "1/8"
wings = "-1/16"
"#;

#[test]
fn tags_come_from_files_and_angles_and_go_on() {
    let folder = Folder::new();
    folder.mesh("cube.obj", &shapes::cube());
    assert_eq!(folder.run("refine catmull-clark cube.obj -o sharp.obj --crease-angle 80").0, 0);
    let sharp = folder.read("sharp.obj");
    assert_eq!(sharp.positions[..8], shapes::cube().positions[..], "three creases meet at each corner");
    assert_eq!(sharp.creases.len(), 24);
    assert_eq!(folder.run("refine catmull-clark cube.obj -o smooth.obj --crease-angle 91").0, 0);
    assert!(folder.read("smooth.obj").creases.is_empty());
    let text = fs::read_to_string(folder.path("cube.obj")).unwrap();
    folder.file("tagged.obj", text.clone() + "t crease 1/2 2.5\n");
    assert_eq!(folder.run("refine catmull-clark tagged.obj -o once.obj").0, 0);
    let once = folder.read("once.obj");
    assert!(once.creases.len() == 2 && once.creases.iter().all(|crease| crease.sharpness == 1.5));
    folder.file("wrong.obj", text + "t crease 1/8 2\n");
    folder.refused("refine catmull-clark wrong.obj -o no.obj", &["no edge runs between vertices 0 and 7"]);
    folder.file("long.obj", fs::read_to_string(folder.path("cube.obj")).unwrap() + "t crease 1/2 1000\n");
    folder.refused("limit catmull-clark long.obj -o no.obj", &["of 1000 steps", "for ever (inf)"]);
    folder.refused("refine catmull-clark long.obj -o no.obj --to-limit -l 3", &["of 1000 steps", "for ever (inf)"]);
    folder.refused("verify catmull-clark --mesh long.obj --valence 3 --boundary-faces 2", &["for ever (inf)"]);
    folder.refused("verify mid-edge --boundary-faces 2", &["no masks at a boundary", "the boundary recedes"]);
    folder.refused(
        "refine doo-sabin tagged.obj -o no.obj",
        &["under this split the boundary recedes, and there are none"],
    );
    folder.mesh("fan.obj", &shapes::fan(1, true));
    assert_eq!(folder.run("refine loop fan.obj -o corner.obj --boundary corner").0, 0);
    assert_eq!(folder.read("corner.obj").positions[..3], folder.read("fan.obj").positions[..]);
}

#[test]
fn what_is_no_mesh_is_refused_or_mended_on_request() {
    let folder = Folder::new();
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\n";
    let with = |faces: &str| format!("{points}{faces}");
    folder.file("three.obj", with("f 1 2 3\nf 2 1 4\nf 1 2 5\n"));
    folder.refused(
        "refine loop three.obj -o no.obj",
        &["edge between vertices 0 and 1 has 3 faces", "--split-non-manifold"],
    );
    let (code, _, err) = folder.run("refine loop three.obj -o cut.obj --split-non-manifold");
    assert!(code == 0 && err.contains("non-manifold edges cut apart: 1"), "{err}");
    folder.file("bow.obj", with("f 1 2 3\nf 1 4 5\n"));
    folder.refused(
        "refine loop bow.obj -o no.obj",
        &["the faces around vertex 0 are not one fan", "--split-non-manifold"],
    );
    let (code, _, err) = folder.run("refine loop bow.obj -o cut.obj --split-non-manifold");
    assert!(code == 0 && err.contains("vertices split: 1"), "{err}");
    folder.file("turned.obj", with("f 1 2 3\nf 1 2 4\nf 3 4 5\n"));
    folder.refused("refine loop turned.obj -o no.obj", &["oriented against each other", "--split-non-manifold"]);
    folder.file("lonely.obj", with("f 1 2 3\nf 2 1 4\n"));
    folder.refused("refine loop lonely.obj -o no.obj", &["vertex 4 belongs to no face", "--drop-isolated"]);
    assert_eq!(folder.run("refine loop lonely.obj -o dropped.obj --drop-isolated").0, 0);
    folder.file("twice.obj", with("f 1 2 3\nf 2 1 4\nf 1 2 3\nf 3 4 5\n"));
    folder.refused("refine loop twice.obj -o no.obj", &["faces 0 and 2 have the same corners"]);
}

#[test]
fn bad_requests_are_refused_before_the_work() {
    let folder = Folder::new();
    folder.mesh("cube.obj", &shapes::cube());
    folder.file("empty.obj", "");
    folder.file("bad.obj", "v 0 0 0\nv 1 0 nan\n");
    folder.file("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n");
    folder.refused("refine catmull-clark empty.obj -o no.obj", &["empty.obj", "nothing in it"]);
    folder.refused("refine catmull-clark bad.obj -o no.obj", &["line 2"]);
    folder.refused("refine catmull-clark zero.obj -o no.obj", &["line 4"]);
    folder.refused("refine catmull-clark missing.obj -o no.obj", &["missing.obj", "can't be opened"]);
    folder.refused("refine catmull-clark . -o no.obj", &["names no format"]);
    folder.refused("refine catmull-clark cube.obj -o no.xyz", &["names no format", ".obj", ".glb"]);
    folder.refused("refine catmull-clark cube.obj -o nowhere/out.obj", &["there is no folder `nowhere`"]);
    folder.refused(
        "refine loop cube.obj -o no.obj",
        &["face 0 has 4 corners", "triangles only", "--triangulate cuts them"],
    );
    folder.refused("refine catmull-clark cube.obj -o no.obj -l 30", &["more than 2147483647", "--levels"]);
    folder.refused("refine lop cube.obj -o no.obj", &["did you mean `loop`?"]);
    folder.refused("refine catmull-clark cube.obj -o no.obj --crease-angle nan", &["from 0 to 180"]);
    folder.mesh("open.obj", &shapes::grid(2, 2, true));
    folder.refused("refine modified-butterfly open.obj -o no.obj", &["[vertex.crease]", "boundary = [\"cubic\"]"]);
    // a file that can't be written leaves the old one
    folder.file("old.glb", "old");
    folder.file("huge.obj", "v 1e300 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 4 3 2\n");
    folder.refused("refine loop huge.obj -o old.glb", &["32 bits"]);
    assert_eq!(fs::read(folder.path("old.glb")).unwrap(), b"old");
}

#[test]
fn verify_prints_its_table_and_a_verdict() {
    let folder = Folder::new();
    let (code, out, err) = folder.run("verify loop --valence 3,5 --boundary-faces 2,7 --trials 1");
    assert_eq!((code, err.as_str()), (0, ""));
    for row in [
        "n = 3",
        "n = 5",
        "boundary, k = 2",
        "boundary, k = 7",
        "corner, k = 2",
        "dart, n = 7",
        "a torus",
        "an open tube",
    ] {
        assert!(out.contains(row), "{row}");
    }
    assert!(out.contains("All 11 checks agree.") && out.contains("no tangent plane"), "{out}");
    let (code, out, _) = folder.run("verify doo-sabin --valence 3..5 --format csv");
    assert_eq!((code, out.lines().count()), (0, 1 + 3 + 3), "{out}");
    folder.mesh("own.off", &shapes::prism(6));
    let (code, out, err) = folder.run("verify catmull-clark --mesh own.off --trials 1 --boundary-faces 2");
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("own.off: limits of level 0 and level 3 agree") && out.contains("n = 6"), "{out}");
    folder.mesh("fan.obj", &shapes::fan(9, true));
    let (code, out, err) = folder.run("verify loop --mesh fan.obj --trials 1");
    assert!(code == 0 && out.contains("boundary, k = 9") && out.contains("boundary, k = 1 "), "{out} {err}");
    // coordinates whose sums overflow have no limits that agree with anything
    folder
        .file("huge.obj", "v 1e308 0 0\nv -1e308 1 0\nv 1e308 0 1\nv -1e308 1 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 4 3 2\n");
    let (code, out, _) = folder.run("verify loop --mesh huge.obj --trials 1");
    assert!(code == 1 && out.contains("DIFFER") && out.contains("1 of"), "{code} {out}");
}
