//! Is every wrong file of a scheme for curves, and every wrong polygon, met with exit status 2, a place and a way out?
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;
use std::time::Duration;
use tempfile::TempDir;

const PATIENCE: Duration = Duration::from_secs(20);

fn told(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = assert_cmd::cargo::cargo_bin_cmd!("eigenring");
    let output = command.current_dir(folder).args(arguments).timeout(PATIENCE).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// What is wrong with a refusal: the command must end with status 2, say every one of the words, and leave nothing behind.
fn complaint(folder: &Path, arguments: &[&str], words: &[&str]) -> Option<String> {
    let count = || fs::read_dir(folder).unwrap().count();
    let before = count();
    let (status, out, message) = told(folder, arguments);
    let sound = (status, out.as_str(), count()) == (Some(2), "", before);
    let missing: Vec<&&str> = words.iter().filter(|word| !message.contains(**word)).collect();
    let sound = sound && missing.is_empty() && !message.contains("internal error") && message.len() < 20_000;
    (!sound).then(|| format!("{arguments:?} {status:?}: no word of {missing:?}\n{message}"))
}

fn refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    let wrong = complaint(folder, arguments, words);
    assert!(wrong.is_none(), "{}", wrong.unwrap());
}

#[test]
fn bad_files_of_curves() {
    let folder = TempDir::new().unwrap();
    let long = format!("mask = \"1/50000\"\ntaps = {}", 100_000);
    // what stands in the file after name and mesh, and words of the message; lines count from 3
    let cases: &[(&str, &[&str])] = &[
        (
            "mask = [\"1/4\", \"3/4\", \"3/4\", \"1/8\"]",
            &["mine.toml:3", "index 0 modulo 2 sum to 7/8", "can't converge", "^"],
        ),
        ("mask = [\"1/2\", \"1/2\"]", &["index 0 modulo 2 sum to 1/2", "index 1 modulo 2 sum to 1/2"]),
        ("arity = 1\nmask = [\"1\"]", &["mine.toml:3", "the arity must be a whole number from 2 to 16", "this is 1"]),
        ("arity = 17\nmask = [\"1\"]", &["from 2 to 16"]),
        ("arity = \"5/2\"\nmask = [\"1\"]", &["from 2 to 16", "5/2"]),
        (&long, &["mine.toml:4", "from 1 to 512", "100000"]),
        ("mask = [\"1\", \"1\"]\nfirst = \"1/2\"", &["mine.toml:4", "the first index must be a whole number"]),
        ("mask = [\"1\", \"1\"]\nfirst = 10000000", &["the first index must be a whole number from -10000 to 10000"]),
        ("mask = [\"1\", \"1\"]\nsymbol = \"1 + z\"", &["mine.toml:4", "tells the weights a second time"]),
        ("symbol = \"1 + z\"\nfirst = 0", &["`first` does not go with `symbol`", "it goes with mask"]),
        ("symbol = \"1/(1 - z)\"", &["no", "sum of powers of z"]),
        ("symbol = \"1 + q\"", &["the name `q` is not known"]),
        ("symbol = \"z^60*z^60*z^60*(1 + z)\"", &["too large"]),
        ("mask = \"1\"", &["no `taps`", "taps = "]),
        ("mask = [\"1\", \"1\"]\ntaps = 2", &["superfluous"]),
        ("mask = []", &["has no weight"]),
        ("mask = [\"0\", \"0\"]", &["every weight of the mask is zero"]),
        ("mask = [\"sqrt(2)/2\", \"1\"]", &["not a rational number"]),
        ("mask = [\"1/0\", \"1\", \"1/(2-2)\"]", &["division by zero", "mine.toml:3:10", "mine.toml:3:22"]),
        ("average = [\"1/2\", \"1/4\"]", &["sum rule fails"]),
        ("average = [\"1\"]\naveraged = \"some\"", &["there is no averaged `some`"]),
        ("average = [\"1\"]\narity = 3", &["has the arity 2 by itself"]),
        ("halves = [\"1\"]\npoints = 2", &["a list of two formulas"]),
        ("halves = [\"binom(i,j)\", \"1/2\"]\npoints = 2", &["the weights of the new point i = 1 sum to 2"]),
        ("halves = [\"1/2\", \"1/2\"]\npoints = 1000", &["from 2 to 64"]),
        ("halves = [\"1/2\", \"1/2\"]", &["points = "]),
        ("", &["one of `mask`, `symbol`, `average` and `halves` is missing"]),
        ("mask = [\"1\", \"1\"]\nvertex = 3", &["has no key `vertex`"]),
        ("mask = [\"1\", \"1\"]\nmesh2 = 1", &["has no key `mesh2`", "did you mean `mesh`"]),
        ("mask = [\"w\", \"1\"]\n[parameters]\nw = { default = \"2\", range = \"0..1\" }", &["outside its range"]),
        ("mask = [\"1\", \"1\"]\n[parameters]\nz = \"2\"", &["already has a meaning"]),
        (
            "mask = [\"1/4\",\"3/4\",\"3/4\",\"1/4\"]\n[ends]\nrules = [[\"1/2\"]]",
            &["this end rule sum to 1/2", "mine.toml:5"],
        ),
        ("mask = [\"1\",\"1/2\",\"0\",\"1/2\"]\n[ends]\nrules = [[\"1\"]]", &["the same from both ends"]),
        ("mask = [\"1/2\",\"1\",\"1/2\"]\n[ends]\nrules = [[\"1\"]]\nthen = -5", &["`then` must be a whole number"]),
        ("mask = [\"1/2\",\"1\",\"1/2\"]\n[ends]\nthen = 1", &["[ends] needs a list of rules"]),
        ("mask = [\"1\", \"1\"]\n[[claims]]\nwhat = \"C\"", &["can't be about `C`", "generation degree"]),
        ("mask = [\"1\", \"1\"]\n[[claims]]\nwhat = \"hoelder\"", &["gives no value"]),
    ];
    let mut wrong = Vec::new();
    for (body, words) in cases {
        fs::write(folder.path().join("mine.toml"), format!("name = \"Mine\"\nmesh = \"curve\"\n{body}\n")).unwrap();
        wrong.extend(complaint(folder.path(), &["analyze", "mine.toml"], words).map(|why| format!("{body}\n{why}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn bad_files_of_grids_and_other_commands() {
    let folder = TempDir::new().unwrap();
    for (product, words) in [
        ("[\"chaikin\"]", "a list of two"),
        ("[\"chaikin\", \"chaikim\"]", "did you mean `chaikin`"),
        ("[\"loop\", \"chaikin\"]", "there is no scheme for curves `loop`"),
        ("[{ d = 3 }, \"chaikin\"]", "doesn't name its scheme"),
        ("[{ scheme = \"b-spline\", e = 3 }, \"chaikin\"]", "has no parameter `e`"),
        ("[{ scheme = \"b-spline\", d = 99 }, \"chaikin\"]", "outside its range"),
        ("[\"bezier\", \"chaikin\"]", "has no mask"),
    ] {
        fs::write(folder.path().join("mine.toml"), format!("name = \"Mine\"\nmesh = \"grid\"\nproduct = {product}\n"))
            .unwrap();
        refused(folder.path(), &["analyze", "mine.toml"], &[words]);
    }
    refused(folder.path(), &["analyze", "chaikin", "--boundary", "3"], &["--boundary is for surfaces"]);
    refused(folder.path(), &["verify", "chaikin"], &["a scheme for curves"]);
    refused(folder.path(), &["matrix", "chaikin", "--valence", "5"], &["no valence"]);
    refused(folder.path(), &["matrix", "chaikin", "--at", "start"], &["no point `start`", "vertex, mid-edge"]);
    refused(folder.path(), &["matrix", "four-point", "--at", "spline"], &["no binary B-spline"]);
    refused(folder.path(), &["matrix", "loop"], &["--valence 5"]);
    refused(folder.path(), &["analyze", "four-point", "--set", "v=1"], &["no parameter `v`; it has w"]);
    refused(folder.path(), &["analyze", "bezier", "--set", "t=1"], &["outside its range"]);
}

#[test]
fn bad_polygons() {
    let folder = TempDir::new().unwrap();
    let try_file = |name: &str, text: &str, words: &[&str]| {
        fs::write(folder.path().join(name), text).unwrap();
        refused(folder.path(), &["refine", "chaikin", name, "-o", "out.svg"], words);
        fs::remove_file(folder.path().join(name)).unwrap();
    };
    try_file("a.csv", "", &["there is nothing in it"]);
    try_file("a.csv", "# nothing\n", &["there is no polygon"]);
    try_file("a.csv", "1,2\n", &["there is one point"]);
    try_file("a.csv", "1,2\n1,2\n1,2\n", &["all 3 points are the same"]);
    try_file("a.csv", "x,y\n1,2\n3,nan\n", &["line 3", "not a finite number"]);
    try_file("a.csv", "1,2\n3,inf\n", &["line 2", "not a finite number"]);
    try_file("a.csv", "1,2\n3,1e999\n", &["line 2", "not a finite number"]);
    try_file("a.csv", "1,2\n3,four\n", &["line 2", "`four` is not a number"]);
    try_file("a.csv", "1,2\n3\n", &["line 2", "two or three coordinates, and 1 are here"]);
    try_file("a.csv", "1,2\n3,4,5\n", &["line 2", "this point has 3 coordinates, and those before it 2"]);
    try_file("a.json", "{\"points\": 3}", &["no list `points`"]);
    try_file("a.json", "[[1,2],[3,4]", &["this is not JSON"]);
    try_file("a.json", "[[1,2],\"x\"]", &["point 1 (counted from 0)"]);
    try_file("a.json", "[]", &["there is no point"]);
    try_file("a.svg", "<svg><path d=\"M 0 0 C 1 1 2 2 3 3\"/></svg>", &["line 1", "no straight line"]);
    try_file("a.svg", "<svg>\n<path d=\"M 0 0 L 1\"/></svg>", &["line 2", "has no y"]);
    try_file("a.svg", "<svg><path d=\"M 0 0 L ?\"/></svg>", &["is not a number"]);
    try_file("a.svg", "<svg><circle r=\"1\"/></svg>", &["there is no polygon"]);
    try_file("a.svg", "<svg><polyline points=\"0,0 1\"/></svg>", &["3 numbers"]);
    try_file("a.obj", "v 0 0 0\nv 1 0 0\nl 1 3\n", &["line 3", "there is no vertex 3; the file has 2"]);
    try_file("a.obj", "v 0 0 0\nl 0 1\n", &["line 2", "no index of a vertex"]);
    try_file("a.obj", "v 0 0 x\n", &["line 1", "not a finite number"]);
    try_file("a.obj", "v 0 0 0\nv 1 1 1\n", &["there is no polygon"]);
    try_file("a.txt", "1,2\n", &["names no format of polygons", ".csv, .json, .svg, .obj"]);
}

#[test]
fn polygons_that_do_not_fit() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("two.csv"), "0,0\n1,1\n").unwrap();
    fs::write(folder.path().join("five.csv"), "0,0\n1,1\n2,0\n3,1\n4,5\n").unwrap();
    let refine = |scheme: &str, file: &str, more: &[&str], words: &[&str]| {
        let arguments = [&["refine", scheme, file, "-o", "out.csv"], more].concat();
        refused(folder.path(), &arguments, words);
    };
    refine("four-point", "two.csv", &[], &["has 2 points, and at least 3 are needed", "--closed"]);
    refine("cubic-b-spline-clamped", "five.csv", &[], &["has 5 points, and at least 6 are needed"]);
    refine("bezier", "five.csv", &[], &["one of 4 points is needed", "--set d=4"]);
    refine("bezier", "five.csv", &["--set", "d=4", "--closed"], &["takes open polygons"]);
    refine("chaikin", "five.csv", &["--levels", "40"], &["more than", "--levels"]);
    refine("bicubic", "five.csv", &[], &["is no grid", "an empty line between two rows"]);
    refused(folder.path(), &["refine", "chaikin", "none.csv", "-o", "out.csv"], &["can't be opened"]);
    refused(folder.path(), &["refine", "chaikin", "two.csv", "-o", "out.ply"], &["names no format of polygons"]);
}

/// Points that coincide are kept, and told; a polygon of two points with one side of no length is none.
#[test]
fn coincident_points_are_told() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.csv"), "0,0\n1,1\n1,1\n2,0\n").unwrap();
    let (status, _, message) = told(folder.path(), &["refine", "chaikin", "a.csv", "-o", "b.csv"]);
    assert_eq!(status, Some(0), "{message}");
    assert!(message.contains("1 points coincide"), "{message}");
    assert!(fs::read_to_string(folder.path().join("b.csv")).unwrap().lines().count() == 6);
}
