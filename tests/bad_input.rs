//! Is every wrong input met with exit status 2 and a message that names the thing and its place, and nothing half written?
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;
use std::time::Duration;
use tempfile::TempDir;

/// A sound scheme file; the cases below are edits of it.
const SOUND: &str = r#"name = "Sound"
mesh = "triangles"
split = "1-to-4"

[vertex]
centre = "5/8"
ring = "3/(8*n)"

[edge]
ends = "3/8"
opposite = "1/8"
"#;

/// Longer than any refusal may take, on a slow machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// A case: its name, the words of [`SOUND`] that are replaced ("" to add at the end), what by, the line of the fault (0 for
/// the file as a whole), words of the message.
type Edit<'a> = (&'a str, &'a str, &'a str, usize, &'a [&'a str]);

/// What the program says in a folder: its exit status, standard output and standard error.
fn told(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = assert_cmd::cargo::cargo_bin_cmd!("eigenring");
    let output = command.current_dir(folder).args(arguments).timeout(PATIENCE).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// The files and folders below a folder.
fn listed(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// What is wrong with a refusal: nothing, when its status is 2, nothing was written, and the message has the words.
fn complaint(folder: &Path, arguments: &[&str], words: &[&str]) -> Option<String> {
    let before = listed(folder);
    let (status, out, message) = told(folder, arguments);
    let mut wrong = Vec::new();
    if status != Some(2) {
        wrong.push(format!("status {status:?}"));
    }
    if !out.is_empty() {
        wrong.push(format!("{} bytes on standard output", out.len()));
    }
    if listed(folder) != before {
        wrong.push(format!("left behind: {:?}", listed(folder)));
    }
    wrong.extend(words.iter().filter(|word| !message.contains(**word)).map(|word| format!("no word of `{word}`")));
    if message.contains("internal error") || message.contains("RUST_BACKTRACE") {
        wrong.push("a panic".to_string());
    }
    if message.len() > 20_000 {
        wrong.push(format!("a message of {} bytes", message.len()));
    }
    let shown: String = message.chars().take(1500).collect();
    (!wrong.is_empty()).then(|| format!("{}\n{shown}", wrong.join("; ")))
}

/// What is wrong with the refusal of a scheme file, which is to point at a line with a caret.
fn complaint_about_file(text: &[u8], line: usize, words: &[&str]) -> Option<String> {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("wrong.toml"), text).unwrap();
    let place = format!("wrong.toml:{line}:");
    let words: Vec<&str> =
        if line == 0 { words.to_vec() } else { words.iter().copied().chain([place.as_str(), "^"]).collect() };
    complaint(folder.path(), &["analyze", "wrong.toml", "-n", "3..7", "--format", "json"], &words)
}

fn edited(from: &str, to: &str) -> String {
    assert!(SOUND.contains(from), "{from}");
    if from.is_empty() { format!("{SOUND}{to}") } else { SOUND.replacen(from, to, 1) }
}

fn hold(edits: &[Edit]) {
    let wrong = edits.iter().filter_map(|(name, from, to, line, words)| {
        complaint_about_file(edited(from, to).as_bytes(), *line, words).map(|what| format!("== {name}: {what}"))
    });
    let wrong: Vec<String> = wrong.collect();
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), edits.len(), wrong.join("\n"));
}

#[test]
fn the_sound_file_is_taken() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("sound.toml"), SOUND).unwrap();
    for (name, text) in
        [("sound", SOUND.to_string()), ("crlf", SOUND.replace('\n', "\r\n")), ("bom", format!("\u{feff}{SOUND}"))]
    {
        fs::write(folder.path().join("sound.toml"), text).unwrap();
        let (status, out, message) = told(folder.path(), &["analyze", "sound.toml", "-n", "3..7", "--format", "json"]);
        assert_eq!((status, message.as_str()), (Some(0), ""), "{name}");
        assert!(out.starts_with('{'), "{name}");
    }
}

#[test]
fn faults_of_toml_keys_and_positions() {
    let deep = format!("deep = {}", "[".repeat(30_000));
    let deep_tables = format!("deep = {}", "{a=".repeat(20_000));
    let dotted = format!("{} = 1", vec!["a"; 20_000].join("."));
    hold(&[
        ("an open quote", "\"Sound\"", "\"Sound", 1, &["not TOML"]),
        ("an open bracket", "[vertex]", "[vertex", 5, &["not TOML"]),
        ("a duplicate key", "ring =", "centre =", 7, &["duplicate key", "not TOML"]),
        ("a duplicate table", "", "[vertex]\ncentre = \"1\"\n", 12, &["duplicate key"]),
        ("deep lists", "", &deep, 12, &["not TOML"]),
        ("deep tables", "", &deep_tables, 12, &["not TOML"]),
        ("a deep dotted key", "", &dotted, 0, &["recursion limit"]),
        ("an unknown key", "split", "splitt", 3, &["no key `splitt`", "did you mean `split`?"]),
        ("an unknown table", "[edge]", "[egde]", 9, &["`egde`", "did you mean `edge`?"]),
        ("an unknown kind of rule", "[edge]", "[edge.irregular]", 9, &["`irregular`"]),
        ("no name", "name = \"Sound\"", "", 0, &["the key `name` is missing", "wrong.toml"]),
        ("no mesh", "mesh = \"triangles\"", "", 0, &["the key `mesh` is missing", "\"polygons\""]),
        ("an unknown mesh", "triangles", "triangle", 2, &["no mesh `triangle`", "did you mean `triangles`?"]),
        ("an unknown split", "1-to-4", "1-to-5", 3, &["no split `1-to-5`", "did you mean"]),
        ("a split of another mesh", "1-to-4", "dual", 3, &["doesn't go with triangles"]),
        ("a name that is no text", "\"Sound\"", "7", 1, &["a text in quotes is needed"]),
        ("a rule that is no table", "split", "face = 3\nsplit", 3, &["a table of positions and weights is needed"]),
        ("a source that is no text", "split", "source = [1]\nsplit", 3, &["a text in quotes is needed"]),
        ("an unknown boundary file", "split", "boundary = [\"cubik\"]\nsplit", 3, &["no boundary file `cubik`"]),
        ("a boundary rule", "[edge]", "[edge.crease]\nends = \"1/2\"\n[edge]", 9, &["`crease`"]),
        ("an unknown position", "ring =", "rign =", 7, &["[vertex] has no position `rign`", "did you mean `ring`?"]),
        ("a position of quads", "ring =", "diagonals =", 7, &["no position `diagonals`"]),
        ("an address too far", "ring =", "\"17,0\" =", 7, &["`17,0`", "at most 8"]),
        ("an address beyond numbers", "ring =", "\"4294967295,1\" =", 7, &["`4294967295,1`"]),
        ("an address around an edge", "opposite", "\"2,0\"", 11, &["`2,0`"]),
        ("a pick that is no number", "ring =", "\"ring[x]\" =", 7, &["`ring[x]`", "ring[-1,1]"]),
        ("an open pick", "ring =", "\"ring[1\" =", 7, &["`ring[1`"]),
        ("a rule that no point asks for", "", "[face]\ncorners = \"1/n\"\n", 12, &["no point for the rule [face]"]),
        ("a rule missing", "[edge]\nends = \"3/8\"\nopposite = \"1/8\"\n", "", 3, &["needs a rule [edge]"]),
        ("an empty rule", "ends = \"3/8\"\nopposite = \"1/8\"\n", "", 9, &["a rule without weights"]),
    ]);
}

#[test]
fn faults_of_formulas() {
    let parentheses = format!("\"{}n{}\"", "(".repeat(10_000), ")".repeat(10_000));
    let shorter = format!("\"{}n{}\"", "(".repeat(4_000), ")".repeat(4_000));
    let signs = format!("\"{}n\"", "-".repeat(9_000));
    let digits = format!("\"{}\"", "9".repeat(101));
    let names = format!("\"{}\"", vec!["a"; 5_000].join("+"));
    let ring = "\"3/(8*n)\"";
    hold(&[
        ("an open parenthesis", ring, "\"3/(8*n\"", 7, &["needs `)`", "the formula ends here"]),
        ("a missing operand", ring, "\"3/\"", 7, &["needs a number, a name or `(`"]),
        ("a missing operator", ring, "\"3 n\"", 7, &["needs an operator", "found `n`"]),
        ("an unknown sign", ring, "\"3 § n\"", 7, &["`§` has no meaning"]),
        ("an empty formula", ring, "\"\"", 7, &["needs a number"]),
        ("a function with a typo", ring, "\"coz(n)\"", 7, &["no function `coz`", "did you mean `cos`?"]),
        ("a function short of an argument", ring, "\"binom(n)\"", 7, &["needs `,`"]),
        ("a number with two points", ring, "\"1.2.3\"", 7, &["`1.2.3` is not a number"]),
        ("too many digits", ring, &digits, 7, &["101 digits", "100"]),
        ("an unknown name", ring, "\"beta\"", 7, &["the name `beta` is not known here"]),
        ("five thousand unknown names", ring, &names, 7, &["the name `a` is not known here", "more"]),
        ("n in an edge rule", "ends = \"3/8\"", "ends = \"3/n\"", 10, &["the name `n` is not known here"]),
        ("j at the centre", "\"5/8\"", "\"j\"", 6, &["the name `j` is not known here"]),
        ("k at a vertex", ring, "\"k\"", 7, &["the name `k` is not known here"]),
        ("a weight that is no formula", ring, "true", 7, &["a formula in quotes is needed", "boolean"]),
        ("a float with an exponent", ring, "3e-2", 5, &["sum to 0.715 at n = 3"]),
        ("a float that is no number", ring, "nan", 7, &["`nan`"]),
        ("ten thousand parentheses", ring, &parentheses, 7, &["20001 bytes", "10000", "[let]"]),
        ("four thousand parentheses", ring, &shorter, 7, &["nested more than 100 deep"]),
        ("nine thousand signs", ring, &signs, 7, &["nested more than 100 deep"]),
    ]);
}

#[test]
fn faults_of_values_sums_and_cases() {
    let ring = "\"3/(8*n)\"";
    let line = "ring = \"3/(8*n)\"";
    hold(&[
        ("division by zero at one valence", ring, "\"3/(8*n) + 0/(n - 5)\"", 7, &["division by zero at n = 5"]),
        ("a root of a negative number", ring, "\"sqrt(5 - n)\"", 7, &["square root of a negative number at n = 6"]),
        ("not a number", ring, "\"(-8)^(1/3)\"", 7, &["not a finite number"]),
        ("infinity", ring, "\"10^400\"", 7, &["not a finite number"]),
        ("infinity less infinity", ring, "\"10^308*10 - 10^308*10\"", 7, &["not a finite number"]),
        ("a sum that is not 1", ring, "\"1/(8*n)\"", 5, &["[vertex] sum to 0.7", "not to 1", "n x ring"]),
        (
            "a sum that is not 1 at one valence",
            line,
            "[vertex.ring]\n\"n == 5\" = \"1/8\"\n\"n != 5\" = \"3/(8*n)\"",
            5,
            &["n = 5"],
        ),
        ("a sum of an edge that is not 1", "\"3/8\"", "\"3/9\"", 9, &["[edge] sum to", "2 x ends"]),
        ("huge weights that hide a wrong sum", ring, "\"10^200 - 10^200*(1 + 1/10^10)\"", 5, &["too large", "1e6"]),
        ("a list too short", ring, "[\"1/8\", \"1/8\", \"1/8\"]", 7, &["3 weights for 4 points of `ring` at n = 4"]),
        ("an empty list", ring, "[]", 7, &["0 weights"]),
        (
            "two cases at once",
            line,
            "[vertex.ring]\n\"n <= 5\" = \"3/(8*n)\"\n\"n >= 5\" = \"3/(8*n)\"",
            9,
            &["two cases hold at n = 5", "n <= 5"],
        ),
        (
            "a valence left out",
            line,
            "[vertex.ring]\n\"n < 5\" = \"3/(8*n)\"\n\"n > 5\" = \"3/(8*n)\"",
            8,
            &["no case holds at n = 5"],
        ),
        ("a table without a case", ring, "{}", 7, &["no case"]),
        ("a case that is no comparison", line, "[vertex.ring]\n\"n\" = \"3/(8*n)\"", 8, &["needs a comparison"]),
        ("a case with a single =", line, "[vertex.ring]\n\"n = 3\" = \"3/(8*n)\"", 8, &["`=`", "`n == 3`"]),
        ("a case of an unknown name", line, "[vertex.ring]\n\"m == 3\" = \"3/(8*n)\"", 8, &["the name `m`"]),
        (
            "a case that divides by zero",
            line,
            "[vertex.ring]\n\"1/(n - 5) >= 0\" = \"3/(8*n)\"\n\"n < 5\" = \"3/(8*n)\"",
            8,
            &["division by zero at n = 5"],
        ),
        ("one edge before others", "ring =", "\"ring[0]\" =", 5, &["[vertex] sum to", "1 x ring"]),
        (
            "one edge before others, summing to 1",
            line,
            "\"ring[0]\" = \"3/8\"",
            5,
            &["not the same seen from every side"],
        ),
        (
            "one end before the other",
            "ends = \"3/8\"",
            "\"ends[0]\" = \"1/2\"\n\"ends[1]\" = \"1/4\"",
            9,
            &["not the same seen"],
        ),
    ]);
}

#[test]
fn faults_of_names_parameters_and_claims() {
    let chain: String = (1..40).map(|i| format!("a{i} = \"a{}\"\n", i - 1)).collect();
    let chain = format!("[let]\na0 = \"1\"\n{chain}");
    hold(&[
        ("a name that means itself", "", "[let]\na = \"a\"\n", 13, &["round in a circle", "`a`"]),
        ("names in a circle", "", "[let]\na = \"b + 1\"\nb = \"a\"\n", 13, &["round in a circle"]),
        (
            "a name whose case asks for itself",
            "[edge]",
            "[let.a]\n\"a > 0\" = \"1\"\n\"a <= 0\" = \"2\"\n[edge]",
            10,
            &["the name `a`", "known here"],
        ),
        ("a name whose case asks for itself, used", ring_with_a().0, ring_with_a().1, 9, &["the name `a`"]),
        ("a chain of forty names", "", &chain, 0, &["deep"]),
        ("a reserved name", "", "[let]\npi = \"3\"\n", 13, &["`pi` already has a meaning"]),
        ("a name with a sign", "", "[let]\na-b = \"3\"\n", 13, &["`a-b` can't be a name"]),
        ("a name without a value", "", "[let]\na = \"c\"\n", 13, &["the name `c`"]),
        (
            "a name that is a parameter too",
            "",
            "[let]\na = \"1\"\n[parameters]\na = \"1\"\n",
            15,
            &["both a parameter and"],
        ),
        (
            "a parameter out of range",
            "",
            "[parameters]\nw = { default = \"2\", range = \"0..1\" }\n",
            13,
            &["outside its range", "0 to 1"],
        ),
        (
            "a parameter that is not whole",
            "",
            "[parameters]\nw = { default = \"1/2\", integer = true }\n",
            13,
            &["a whole number", "`w`"],
        ),
        ("a parameter without a default", "", "[parameters]\nw = { range = \"0..1\" }\n", 13, &["`w` has no default"]),
        ("a parameter of n", "", "[parameters]\nw = \"n\"\n", 13, &["the name `n`"]),
        ("a parameter that divides by zero", "", "[parameters]\nw = \"1/0\"\n", 13, &["division by zero"]),
        ("a range without dots", "", "[parameters]\nw = { default = \"0\", range = \"0-1\" }\n", 13, &["low..high"]),
        (
            "a range that runs backwards",
            "",
            "[parameters]\nw = { default = \"0\", range = \"1..0\" }\n",
            13,
            &["range 1 to 0 runs backwards"],
        ),
        (
            "an unknown key of a parameter",
            "",
            "[parameters]\nw = { defalt = \"0\" }\n",
            13,
            &["`defalt`", "did you mean `default`?"],
        ),
        (
            "a claim about something unknown",
            "",
            "[[claims]]\nwhat = \"subdominance\"\n",
            13,
            &["`subdominance`", "subdominant"],
        ),
        ("a claim about an unknown position", "", "[[claims]]\nwhat = \"limit rign\"\nequals = \"0\"\n", 13, &["rign"]),
        ("a claim about nothing", "", "[[claims]]\nequals = \"1\"\n", 12, &["`what`"]),
        ("a claim without its value", "", "[[claims]]\nwhat = \"cup\"\n", 13, &["no value", "equals"]),
        ("a claim with a superfluous value", "", "[[claims]]\nwhat = \"C1\"\nequals = \"1\"\n", 13, &["no value"]),
        (
            "a claim with a typo in its value",
            "",
            "[[claims]]\nwhat = \"cup\"\nequals = \"1/\"\n",
            14,
            &["needs a number"],
        ),
        (
            "a claim that divides by zero",
            "",
            "[[claims]]\nwhat = \"cup\"\nequals = \"1/(n-5)\"\n",
            14,
            &["division by zero at n = 5"],
        ),
        ("a claim with a wrong condition", "", "[[claims]]\nwhat = \"C1\"\nwhere = \"n =< 3\"\n", 14, &["`=`"]),
        ("claims that are no list", "", "[claims]\nwhat = \"C1\"\n", 12, &["[[claims]]"]),
    ]);
}

fn ring_with_a() -> (&'static str, &'static str) {
    ("ring = \"3/(8*n)\"\n", "ring = \"a\"\n[let.a]\n\"a > 0\" = \"3/(8*n)\"\n\"a <= 0\" = \"3/(8*n)\"\n")
}

/// Files that are short, and would take for ever if each step were followed.
#[test]
fn files_that_would_take_for_ever() {
    let doubling: String = (1..31).map(|i| format!("a{i} = \"a{0} - a{0} + a{0}\"\n", i - 1)).collect();
    let doubling = format!("ring = \"a30\"\n[let]\na0 = \"3/(8*n)\"\n{doubling}");
    let nested: String = (1..30).map(|i| format!("a{i} = \"cos(a{0}) + sin(a{0})\"\n", i - 1)).collect();
    let nested = format!("ring = \"3/(8*n) + 0*a29\"\n[let]\na0 = \"1\"\n{nested}");
    let many_names: String = (0..30_000).map(|i| format!("a{i}=1\n")).collect();
    let many_names = format!("[let]\n{many_names}b=\"c\"\n");
    let many_unknown: String = (0..10_000).map(|i| format!("b{i}xxxxxxxxxx=\"c{i}\"\n")).collect();
    let many_unknown = format!("[let]\n{many_unknown}");
    let many_cases: String = (3..20_000).map(|i| format!("\"n == {i}\" = \"3/(8*n)\"\n")).collect();
    let many_cases = format!("[vertex.ring]\n{many_cases}");
    let line = "ring = \"3/(8*n)\"\n";
    let far = "[vertex.ring]\n\"n <= 1000000000000\" = \"3/(8*n)\"\n\"n > 1000000000000\" = \"3/(8*n)\"\n";
    let farthest =
        "[vertex.ring]\n\"n <= 9223372036854775807\" = \"3/(8*n)\"\n\"n > 9223372036854775807\" = \"3/(8*n)\"\n";
    let ring = |weight: &str, centre: &str| edited("\"3/(8*n)\"", weight).replace("\"5/8\"", centre);
    let files = [
        ("huge weights that cancel", ring("\"10^300\"", "\"1 - n*10^300\"")),
        ("weights that overflow", ring("\"10^308\"\n\"2,0\" = \"-10^308\"", "\"1\"")),
        ("tiny weights", ring("\"10^-300\"", "\"1 - n*10^-300\"")),
        ("names that double", edited(line, &doubling)),
        ("waves of waves", edited(line, &nested)),
        ("very many names", edited("", &many_names)),
        ("very many unknown names", edited("", &many_unknown)),
        ("very many cases", edited(line, &many_cases)),
        ("a case far away", edited(line, far)),
        ("a case at the end of numbers", edited(line, farthest)),
    ];
    let mut slow = Vec::new();
    for (name, text) in files {
        let folder = TempDir::new().unwrap();
        fs::write(folder.path().join("long.toml"), text).unwrap();
        let (status, out, message) = told(folder.path(), &["analyze", "long.toml", "-n", "5", "--format", "csv"]);
        let refused = status == Some(2) && out.is_empty() && !message.is_empty();
        if !(refused || status == Some(0)) || message.contains("internal error") || message.len() > 20_000 {
            let shown: String = message.chars().take(500).collect();
            slow.push(format!("== {name}: status {status:?}, a message of {} bytes\n{shown}", message.len()));
        }
    }
    assert!(slow.is_empty(), "{}", slow.join("\n"));
}

#[test]
fn all_faults_are_reported_at_once() {
    let text = r#"name = 3
mesh = "triangels"
split = "1-to-4"
colour = "red"

[parameters]
w = { defalt = "1" }

[let]
beta = "3/(8*m)"

[vertex]
centre = "1 - n*beta"
rign = "beta"

[edge]
ends = "3/"
opposite = "coz(1)"
wings = "1.2.3"

[[claims]]
what = "sharpness"
"#;
    let words = [":1:", ":2:", ":4:", ":7:", ":10:", ":14:", ":17:", ":18:", ":19:", ":22:"];
    assert_eq!(complaint_about_file(text.as_bytes(), 1, &words), None);
    let sums = edited("\"5/8\"", "\"1/8\"").replacen("\"1/8\"\n", "\"1/9\"\n", 2);
    assert_eq!(complaint_about_file(sums.as_bytes(), 5, &["[vertex] sum", "[edge] sum", ":9:"]), None);
    let toml = edited("\"Sound\"", "\"Sound").replace("split =", "split");
    assert_eq!(complaint_about_file(toml.as_bytes(), 1, &[":3:"]), None);
}

#[test]
fn no_fault_is_reported_twice() {
    let folder = TempDir::new().unwrap();
    // not symmetric at any of the points that are looked at
    let ring = "\"ring[0]\" = \"1/8\"\n\"ring[1]\" = \"1/8\"\n\"2,0\" = \"1/(8*n)\"";
    fs::write(folder.path().join("wrong.toml"), edited("ring = \"3/(8*n)\"", ring)).unwrap();
    let (status, _, message) = told(folder.path(), &["analyze", "wrong.toml", "-n", "3..12", "--format", "csv"]);
    assert_eq!((status, message.matches("error:").count()), (Some(2), 1), "{message}");
}

/// What a refinement of quads by face splits never meets need not be answered for: faces of other than four corners.
#[test]
fn faces_of_a_mesh_of_quads_have_four_corners() {
    let text = r#"name = "Bicubic on quads"
mesh = "quads"
split = "1-to-n"
face.corners = "1/4"
edge = { ends = "1/4", "new faces" = "1/4" }
vertex = { centre = "1 - 2/n", ring = "1/n^2", "new faces" = "1/n^2" }
"#;
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("quads.toml"), text).unwrap();
    let (status, _, message) = told(folder.path(), &["analyze", "quads.toml", "-n", "3..7", "--format", "csv"]);
    assert_eq!((status, message.as_str()), (Some(0), ""));
}

#[test]
fn places_are_right_after_a_byte_order_mark_carriage_returns_and_letters_beyond_ascii() {
    let wrong = edited("\"3/(8*n)\"", "\"3/(8*m)\"");
    let place = ":7:14";
    assert_eq!(complaint_about_file(wrong.as_bytes(), 7, &[place]), None);
    assert_eq!(complaint_about_file(format!("\u{feff}{wrong}").as_bytes(), 7, &[place]), None);
    assert_eq!(complaint_about_file(wrong.replace('\n', "\r\n").as_bytes(), 7, &[place]), None);
    assert_eq!(complaint_about_file(wrong.replace("Sound", "Ünsöund 💥").as_bytes(), 7, &[place]), None);
    let escaped = edited("\"3/(8*n)\"", "\"3/(8*\\u006d)\"");
    assert_eq!(complaint_about_file(escaped.as_bytes(), 7, &["the name `m`"]), None);
}

#[test]
fn files_that_are_no_scheme_files() {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).unwrap();
    fs::create_dir(folder.path().join("folder")).unwrap();
    write("empty.toml", b"");
    write("blank.toml", b"\n\n");
    write("latin.toml", b"name = \"Caf\xe9\"\n");
    write("binary.toml", &(0..=255).cycle().take(5000).collect::<Vec<u8>>());
    write("nul.toml", &[0; 100]);
    write("large.toml", "# comment\n".repeat(200_000).as_bytes());
    write("long-line.toml", "x".repeat(1_000_000).as_bytes());
    let cases: [(&str, &[&str]); 11] = [
        ("empty.toml", &["empty.toml", "empty", "eigenring new"]),
        ("blank.toml", &["`name` is missing", "`mesh` is missing", "`split` is missing"]),
        ("latin.toml", &["latin.toml", "UTF-8", "11"]),
        ("binary.toml", &["binary.toml", "UTF-8"]),
        ("nul.toml", &["nul.toml", "not TOML"]),
        ("large.toml", &["large.toml", "65536 bytes"]),
        ("long-line.toml", &["long-line.toml", "65536 bytes"]),
        ("folder", &["`folder` is a directory"]),
        ("missing.toml", &["no file `missing.toml`", "help"]),
        ("lop", &["`lop`", "did you mean `loop`?"]),
        ("", &["``"]),
    ];
    for (name, words) in cases {
        for command in ["analyze", "matrix"] {
            assert_eq!(complaint(folder.path(), &[command, name, "-n", "5"], words), None, "{command} {name}");
        }
    }
}

#[cfg(unix)]
#[test]
fn files_that_never_end_or_may_not_be_read() {
    use std::os::unix::fs::PermissionsExt;
    let folder = TempDir::new().unwrap();
    let pipe = std::process::Command::new("mkfifo").arg(folder.path().join("pipe")).status().unwrap();
    assert!(pipe.success());
    assert_eq!(complaint(folder.path(), &["analyze", "/dev/zero"], &["/dev/zero"]), None);
    assert_eq!(complaint(folder.path(), &["analyze", "/dev/null"], &["/dev/null"]), None);
    assert_eq!(complaint(folder.path(), &["analyze", "pipe"], &["pipe"]), None);
    let locked = folder.path().join("locked.toml");
    fs::write(&locked, SOUND).unwrap();
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o0)).unwrap();
    if fs::read(&locked).is_err() {
        // a superuser may read it all the same
        assert_eq!(complaint(folder.path(), &["analyze", "locked.toml"], &["`locked.toml` can't be opened"]), None);
    }
}

#[test]
fn wrong_arguments() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("there.toml"), SOUND).unwrap();
    let many = (3..1100).map(|n| n.to_string()).collect::<Vec<_>>().join(",");
    let cases: [(&[&str], &[&str]); 49] = [
        (&["analyze", "loop", "-n", "0"], &["at least 3", "0"]),
        (&["analyze", "loop", "-n", "1"], &["at least 3"]),
        (&["analyze", "loop", "-n", "1000000000"], &["at most 100000"]),
        (&["analyze", "loop", "-n", "99999999999999999999999999999999999999999"], &["9999"]),
        (&["analyze", "loop", "-n", "12..3"], &["backwards", "3..12"]),
        (&["analyze", "loop", "-n", "3.."], &["missing", "3.."]),
        (&["analyze", "loop", "-n", ""], &["valence"]),
        (&["analyze", "loop", "-n", "five"], &["`five` is not a valence"]),
        (&["analyze", "loop", "-n", "3..2000"], &["1000 valences"]),
        (&["analyze", "loop", "-n", &many], &["1000 valences"]),
        (&["analyze", "loop", "-n", "99996,99997,99998,99999,100000,99995"], &["sum", "500000"]),
        (&["analyze", "loop", "--set", "w=1"], &["no parameters", "`w`"]),
        (&["analyze", "modified-butterfly", "--set", "v=1"], &["no parameter `v`", "w"]),
        (&["analyze", "modified-butterfly", "--set", "w"], &["name=value", "`w`"]),
        (&["analyze", "modified-butterfly", "--set", "w="], &["`w=`"]),
        (&["analyze", "modified-butterfly", "--set", "w=1/"], &["`w=1/`"]),
        (&["analyze", "modified-butterfly", "--set", "w=n"], &["`n` is a name"]),
        (&["analyze", "modified-butterfly", "--set", "w=1/0"], &["division by zero", "1/0"]),
        (&["analyze", "modified-butterfly", "--set", "w=10^400"], &["not a finite number"]),
        (&["analyze", "loop", "--symbolic", "w"], &["Loop has no parameters", "`w`"]),
        (&["analyze", "modified-butterfly", "--symbolic", "v"], &["no parameter `v`", "it has w"]),
        (&["analyze", "modified-butterfly", "--sweep", "w=0"], &["name=low..high"]),
        (&["analyze", "modified-butterfly", "--sweep", "w=0..1:19999"], &["too many", "fewer steps"]),
        (&["analyze", "modified-butterfly", "--range", "w=1..0"], &["does not run upwards"]),
        (&["analyze", "four-point", "--range", "v=0..1"], &["no parameter `v`; it has w"]),
        (&["analyze", "deslauriers-dubuc", "--range", "N=1..3"], &["whole numbers only"]),
        (&["analyze", "four-point", "--valence", "3..5"], &["--valence is for surfaces"]),
        (&["analyze", "loop", "--claim", "C2", "--range", "w=0..1"], &["--claim is for curves"]),
        (&["analyze", "loop", "--claim", "C2"], &["--range"]),
        (&["analyze", "loop", "--boundary", "3", "--boundary-rules", "none"], &["takes none"]),
        (
            &["analyze", "loop", "--boundary", "3", "--boundary-rules", "thirds"],
            &["by the rules `thirds`", "edge.crease"],
        ),
        (&["analyze", "modified-butterfly", "--range", "v=0..1"], &["no parameter `v`"]),
        (&["analyze", "loop", "--boundary", "0"], &["at least 1, not 0"]),
        (&["analyze", "loop", "--boundary", "150..201"], &["at most 200, not 201"]),
        (&["analyze", "loop", "--boundary", "3..1"], &["runs backwards", "1..3"]),
        (&["analyze", "modified-butterfly", "--boundary", "3"], &["names no boundary file", "boundary = [\"cubic\"]"]),
        (&["analyze", "doo-sabin", "--boundary", "3"], &["the boundary recedes", "dual"]),
        (&["analyze", "loop", "--format", "pdf"], &["pdf", "json"]),
        (&["analyze", "loop", "--out", "there.toml"], &["`there.toml`"]),
        (&["analyze", "loop", "--out", "there.toml/below"], &["there.toml/below"]),
        (&["matrix", "loop", "-n", "2"], &["at least 3, not 2"]),
        (&["matrix", "loop", "-n", "5", "--block", "5"], &["no block 5", "0 to 4"]),
        (&["matrix", "loop", "-n", "5", "--block=-1"], &["-1"]),
        (&["matrix", "loop", "-n", "1000"], &["--format mtx", "--block"]),
        (&["new", "there"], &["`there.toml` is there already"]),
        (&["new", "mine", "--like", "lop"], &["`lop`", "eigenring schemes"]),
        (&["new", "missing/mine"], &["missing/mine.toml"]),
        (&["new", ""], &["``"]),
        (&["schemes", "lop"], &["no scheme `lop`"]),
    ];
    let wrong = cases.iter().filter_map(|(arguments, words)| {
        complaint(folder.path(), arguments, words).map(|what| format!("== {}: {what}", arguments.join(" ")))
    });
    let wrong: Vec<String> = wrong.collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(fs::read_to_string(folder.path().join("there.toml")).unwrap(), SOUND);
}

#[test]
fn a_report_is_written_whole_or_not_at_all() {
    let folder = TempDir::new().unwrap();
    let (status, ..) = told(folder.path(), &["analyze", "loop", "-n", "5", "--no-pictures", "--out", "whole"]);
    assert_eq!(status, Some(0));
    for name in listed(&folder.path().join("whole")) {
        let out = folder.path().join("half");
        fs::create_dir_all(out.join(&name)).unwrap();
        let arguments = ["analyze", "loop", "-n", "5", "--no-pictures", "--out", "half"];
        assert_eq!(complaint(folder.path(), &arguments, &["can't be written", name.as_str()]), None, "{name}");
        assert_eq!(listed(&out), [name.as_str()], "files were written before the one that can't be");
        fs::remove_dir_all(&out).unwrap();
    }
}

#[test]
fn a_division_by_zero_is_a_fault_where_it_is_asked_for() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("at-5.toml"), edited("\"3/(8*n)\"", "\"3/(8*n) + 0/(n - 5)\"")).unwrap();
    fs::write(folder.path().join("at-6.toml"), edited("\"3/(8*n)\"", "\"3/(8*n) + 0/(n - 6)\"")).unwrap();
    let asked = |name: &'static str, n: &'static str| ["analyze", name, "-n", n, "--format", "csv"];
    assert_eq!(told(folder.path(), &asked("at-5.toml", "3,4,7")).0, Some(0));
    assert_eq!(complaint(folder.path(), &asked("at-5.toml", "3..5"), &["division by zero at n = 5", "^"]), None);
    // the regular valence is needed in every analysis
    assert_eq!(complaint(folder.path(), &asked("at-6.toml", "5"), &["division by zero at n = 6", "^"]), None);
}

/// Weights that tell the edges of a vertex apart are refused at large valences too.
#[test]
fn asymmetry_is_a_fault_at_every_valence() {
    let ring = "[vertex.ring]\n\"n < 100\" = \"3/(8*n)\"\n\"n >= 100\" = \"3*j/(4*n*(n - 1))\"";
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("far.toml"), edited("ring = \"3/(8*n)\"", ring)).unwrap();
    let arguments = ["analyze", "far.toml", "-n", "100", "--format", "csv"];
    assert_eq!(complaint(folder.path(), &arguments, &["not the same seen from every side", "n = 100"]), None);
}
