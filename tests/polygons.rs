//! Do polygons come out of files and go into them as they are, and do the commands make curves of them?
#![allow(clippy::unwrap_used)]

use eigenring::mesh::Polygon;
use eigenring::mesh::io::curve::{CurveFormat, Style, read, write};
use proptest::prelude::*;
use std::fs;
use tempfile::TempDir;

fn written(format: CurveFormat, polygons: &[Polygon]) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(format, polygons, Style { upwards: true }, &mut bytes).unwrap();
    bytes
}

#[test]
fn every_format_is_read_as_it_says() {
    let triangle = |closed, dimension| Polygon {
        points: vec![[0.0, 0.0, 0.0], [1.0, 2.0, 0.0], [3.0, -0.5, 0.0]],
        closed,
        dimension,
    };
    let one = |format, text: &str, closed| read(format, text.as_bytes(), closed).unwrap();
    for (format, text, closed) in [
        (CurveFormat::Csv, "x,y\n0,0\n1,2 # a comment\n3,-.5\n", false),
        (CurveFormat::Csv, "0;0\r\n1;2\r\n3;-5e-1\r\n", false),
        (CurveFormat::Csv, "0 0\n1 2\n# between\n3 -0.5\n0 0\n", true),
        (CurveFormat::Json, "[[0,0],[1,2],[3,-0.5]]", false),
        (CurveFormat::Json, "{\"closed\": true, \"points\": [[0,0],[1,2],[3,-0.5]]}", true),
        (CurveFormat::Svg, "<svg><path d=\"M0 0L1,2 3-.5\"/></svg>", false),
        (CurveFormat::Svg, "<svg><path fill='none' d='m 0 0 l 1 2 2 -2.5 z'/></svg>", true),
        (CurveFormat::Svg, "<svg><!-- <path d=\"M 5 5 L 6 6\"/> --><polygon points=\"0,0 1,2 3,-.5\"/></svg>", true),
        (CurveFormat::Svg, "<svg><polyline id=\"x\" points='0 0 1 2 3 -.5'/></svg>", false),
    ] {
        assert_eq!(one(format, text, closed && format == CurveFormat::Csv), [triangle(closed, 2)], "{text}");
    }
    let obj = "v 0 0 0\nv 1 2 0\nv 3 -.5 0\nl 1 2 3\nl -3 -2 -1 -3\n";
    assert_eq!(one(CurveFormat::Obj, obj, false), [triangle(false, 3), triangle(true, 3)]);
    let steps = one(CurveFormat::Svg, "<svg><path d=\"M 0 0 H 2 V 3 h -1 v -1 Z M 5 5 L 6 6\"/></svg>", false);
    assert_eq!(steps[0].points, [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 3.0, 0.0], [1.0, 3.0, 0.0], [1.0, 2.0, 0.0]]);
    assert_eq!((steps.len(), steps[0].closed, steps[1].closed), (2, true, false));
    assert_eq!(one(CurveFormat::Csv, "0,0\n1,1\n\n2,2\n3,3\n", false).len(), 2);
}

proptest! {
    /// What is written is read back, number by number.
    #[test]
    fn files_come_back(points in proptest::collection::vec((-1e9f64..1e9, -1e-3f64..1e-3, -5f64..5.0), 3..9), closed: bool) {
        let points: Vec<[f64; 3]> = points.into_iter().map(|(x, y, z)| [x, y, z]).collect();
        let polygon = Polygon::new(points.clone(), closed, 3).unwrap();
        for format in [CurveFormat::Csv, CurveFormat::Json, CurveFormat::Obj] {
            let back = read(format, &written(format, std::slice::from_ref(&polygon)), closed && format == CurveFormat::Csv);
            prop_assert_eq!(&back.unwrap(), &vec![polygon.clone()]);
        }
        let flat = Polygon::new(points.iter().map(|[x, y, _]| [*x, *y, 0.0]).collect(), closed, 2).unwrap();
        let back = read(CurveFormat::Svg, &written(CurveFormat::Svg, std::slice::from_ref(&flat)), false);
        prop_assert_eq!(back.unwrap(), vec![flat]);
    }

    #[test]
    fn any_bytes_are_read_or_refused_without_a_panic(text in "[-+*/<>=\"'a-zA-Z0-9 .,\\n\\[\\]{}:]{0,80}|\\PC{0,40}") {
        for format in CurveFormat::ALL {
            let _ = read(format, text.as_bytes(), false);
            let _ = read(format, format!("<svg><path d=\"{text}\"/></svg>").as_bytes(), true);
        }
    }
}

fn run(folder: &TempDir, arguments: &[&str]) -> String {
    let mut command = assert_cmd::cargo::cargo_bin_cmd!("eigenring");
    let output = command.current_dir(folder.path()).args(arguments).output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{arguments:?}\n{message}");
    String::from_utf8(output.stdout).unwrap() + &message
}

#[test]
fn the_commands_refine_polygons() {
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("square.csv"), "0,0\n4,0\n4,4\n0,4\n").unwrap();
    run(&folder, &["refine", "chaikin", "square.csv", "--closed", "-o", "out.csv"]);
    let cut = "0,3\n1,0\n3,0\n4,1\n4,3\n3,4\n1,4\n0,1\n";
    let mut lines: Vec<String> = fs::read_to_string(path("out.csv")).unwrap().lines().map(str::to_string).collect();
    let mut expected: Vec<String> = cut.lines().map(str::to_string).collect();
    lines.sort();
    expected.sort();
    assert_eq!(lines, expected);
    // the limit of Chaikin's polygon touches the middles of its sides: here those of the refined polygon at its own vertices
    run(&folder, &["limit", "b-spline", "square.csv", "--closed", "-o", "limit.json"]);
    let limit = read(CurveFormat::Json, &fs::read(path("limit.json")).unwrap(), false).unwrap();
    assert!(limit[0].closed);
    let first = limit[0].points[0];
    assert!((first[0] - 2.0 / 3.0).abs() < 1e-15 && (first[1] - 2.0 / 3.0).abs() < 1e-15, "{first:?}");
    for ending in ["svg", "obj", "json"] {
        let out = format!("out.{ending}");
        run(&folder, &["refine", "four-point", "square.csv", "--closed", "-o", &out, "--levels", "3"]);
        let format = CurveFormat::of_path(&path(&out)).unwrap();
        let back = read(format, &fs::read(path(&out)).unwrap(), false).unwrap();
        assert_eq!((back.len(), back[0].points.len(), back[0].closed), (1, 32, true), "{ending}");
    }
}

/// The halves of a Bezier polygon are told by its points: 4 become 7, then 13, and every third lies on the curve.
#[test]
fn bezier_on_the_command_line() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.csv"), "0,0\n1,3\n2,-1\n4,2\n").unwrap();
    let lines = |name: &str| {
        fs::read_to_string(folder.path().join(name)).unwrap().lines().map(str::to_string).collect::<Vec<_>>()
    };
    run(&folder, &["refine", "bezier", "a.csv", "-o", "one.csv"]);
    run(&folder, &["refine", "bezier", "a.csv", "-o", "two.csv", "--levels", "2"]);
    run(&folder, &["refine", "bezier", "one.csv", "-o", "again.csv"]);
    assert_eq!((lines("one.csv").len(), lines("two.csv")), (7, lines("again.csv")));
    run(&folder, &["limit", "bezier", "a.csv", "-o", "limit.csv", "--levels", "2"]);
    let every_third: Vec<String> = lines("two.csv").into_iter().step_by(3).collect();
    assert_eq!(lines("limit.csv"), every_third);
}

/// A bicubic grid on the command line against Catmull and Clark's scheme on the same quads: inside they are the same.
#[test]
fn grids_agree_with_catmull_and_clark() {
    let folder = TempDir::new().unwrap();
    let at = |i: usize, j: usize| [i as f64, j as f64, ((5 * i * i + 3 * j * j + i * j) % 11) as f64];
    let line = |p: [f64; 3]| format!("{},{},{}", p[0], p[1], p[2]);
    let rows: Vec<String> = (0..5).map(|i| (0..5).map(|j| line(at(i, j))).collect::<Vec<_>>().join("\n")).collect();
    fs::write(folder.path().join("grid.csv"), rows.join("\n\n")).unwrap();
    run(&folder, &["refine", "bicubic", "grid.csv", "-o", "grid.obj"]);
    let vertices: Vec<String> = (0..25).map(|v| line(at(v / 5, v % 5)).replace(',', " ")).collect();
    let face = |v: usize| format!("f {} {} {} {}", v + 1, v + 6, v + 7, v + 2);
    let faces: Vec<String> = (0..20).filter(|v| v % 5 < 4).map(face).collect();
    fs::write(folder.path().join("mesh.obj"), format!("v {}\n{}\n", vertices.join("\nv "), faces.join("\n"))).unwrap();
    run(&folder, &["refine", "catmull-clark", "mesh.obj", "-o", "mesh-out.obj"]);
    let points = |name: &str| {
        let text = fs::read_to_string(folder.path().join(name)).unwrap();
        let own = text.lines().filter_map(|line| line.strip_prefix("v "));
        own.map(|line| line.split(' ').map(|word| word.parse().unwrap()).collect()).collect::<Vec<Vec<f64>>>()
    };
    let (grid, mesh) = (points("grid.obj"), points("mesh-out.obj"));
    assert_eq!(grid.len(), 49);
    let near = |p: &[f64], q: &[f64]| (0..3).all(|axis| (p[axis] - q[axis]).abs() < 1e-13);
    assert!(grid.iter().all(|p| mesh.iter().any(|q| near(p, q))));
    run(&folder, &["limit", "biquadratic", "grid.csv", "-o", "limit.csv"]);
}

#[test]
fn the_commands_know_curves() {
    let folder = TempDir::new().unwrap();
    let list = run(&folder, &["schemes"]);
    assert!(list.contains("On curves") && list.contains("four-point") && list.contains("bicubic"));
    assert!(run(&folder, &["schemes", "four-point"]).contains("mesh   = \"curve\""));
    run(&folder, &["new", "mine", "--like", "four-point"]);
    let told = run(&folder, &["analyze", "mine.toml", "--set", "w=1/10", "--out", "report"]);
    assert!(told.contains("mine · curve, arity 2, interpolating") && told.contains("w = 1/10"), "{told}");
    for name in ["mine.md", "mine.tex", "mine.csv", "mine.json", "stencils.svg", "limit-function.png", "curve.svg"] {
        assert!(folder.path().join("report").join(name).is_file(), "{name}");
    }
    let json: serde_json::Value =
        serde_json::from_str(&run(&folder, &["analyze", "b-spline", "--format", "json"])).unwrap();
    assert_eq!((json["kind"].as_str(), json["mask"][2].as_str()), (Some("curve"), Some("3/4")));
    assert_eq!(json["points"][0]["limit_mask"][1]["exact"].as_str(), Some("2/3"));
    let h = run(&folder, &["matrix", "b-spline", "--at", "spline"]);
    assert!(h.contains("p[1]   1/8   3/4   1/8     ."), "{h}");
    for format in ["csv", "latex", "json", "mtx"] {
        assert!(!run(&folder, &["matrix", "chaikin", "--at", "mid-edge", "--full", "--format", format]).is_empty());
    }
    let grid = run(&folder, &["analyze", "biquadratic", "--format", "md"]);
    assert!(grid.contains("no extraordinary points") && grid.contains("9/16"), "{grid}");
    // LaTeX and CSV of the same report have its tables
    assert!(run(&folder, &["analyze", "four-point", "--format", "latex"]).contains("\\section*{Four-point}"));
    assert!(
        run(&folder, &["analyze", "four-point", "--format", "csv"]).starts_with("table,row,column,value\nRules,0,")
    );
}
