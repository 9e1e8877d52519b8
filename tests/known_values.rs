//! Does the analysis give the published values, and would it notice a wrong digit in a scheme file?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::{Analysis, Analyzer};
use eigenring::numbers::{Field, Trouble};
use eigenring::refine::{self, OrbitNames, Refinement};
use eigenring::scheme::catalogue::{self, Listed};
use eigenring::scheme::formula::{Formula, Names};
use eigenring::scheme::{RuleBook, Scheme};
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    values: Vec<Known>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Known {
    scheme: String,
    source: String,
    what: String,
    #[serde(rename = "for")]
    valences: Vec<usize>,
    equals: Option<String>,
    each: Option<Vec<String>>,
}

struct Valence(usize);

impl Names<f64> for Valence {
    fn value(&self, name: &str) -> Result<f64, Trouble> {
        if name == "n" { Ok(f64::whole(self.0 as i64)) } else { Err(Trouble::Domain("no such name")) }
    }
}

impl Known {
    /// The valences with their values and tolerances: half a unit of a decimal's last digit, 1e-13 for formulas.
    fn expected(&self) -> Vec<(usize, f64, f64)> {
        let texts = match (&self.equals, &self.each) {
            (Some(formula), None) => vec![formula.clone(); self.valences.len()],
            (None, Some(list)) => list.clone(),
            _ => panic!("{}: either `equals` or `each`", self.source),
        };
        assert_eq!(texts.len(), self.valences.len(), "{}", self.source);
        let value = |n: usize, text: &str| Formula::parse(text).unwrap().evaluate(&Valence(n)).unwrap();
        let tolerance = |text: &str| match text.split_once('.') {
            Some((_, digits)) => 0.500_001 * 0.1_f64.powi(digits.len() as i32),
            None => 1e-13,
        };
        self.valences.iter().zip(&texts).map(|(n, text)| (*n, value(*n, text), tolerance(text))).collect()
    }
}

fn known_values() -> Vec<Known> {
    toml::from_str::<Table>(include_str!("known_values.toml")).unwrap().values
}

fn quantity(analyzer: &Analyzer, analysis: &Analysis, what: &str) -> Option<f64> {
    let (spectrum, lambda) = (&analysis.spectrum, analysis.lambda?.value.re);
    match what.split_once(' ') {
        Some(("limit", "centre")) => analysis.limit_mask.as_ref()?.centre,
        Some(("limit", name)) => {
            let names = OrbitNames::of(&Refinement::<f64>::new(analyzer.scheme(), None), analyzer.lattice());
            let orbit = analysis.local.orbits.iter().position(|orbit| Some(*orbit) == names.orbit(name))?;
            Some(analysis.limit_mask.as_ref()?.amplitudes[orbit].re)
        }
        Some(("second", k)) => spectrum.largest_of(k.parse().ok()?)?.real(),
        _ => match what {
            "lambda" => spectrum.subdominant()?.real(),
            "ratio" => Some(spectrum.after_subdominant().next()?.modulus() / (lambda * lambda)),
            "cup" => analysis.classical.cup?.real(),
            "saddle" => analysis.classical.saddle?.real(),
            "size" => Some(analysis.local.size() as f64),
            _ => panic!("unknown quantity {what}"),
        },
    }
}

/// The known values that a scheme does not have, in words.
fn misses(scheme: &Scheme, known: &[Known]) -> Vec<String> {
    let Ok(analyzer) = Analyzer::new(scheme) else { return vec!["no analysis".to_string()] };
    let mut misses = Vec::new();
    for value in known.iter().filter(|value| value.scheme == scheme.id) {
        for (n, expected, tolerance) in value.expected() {
            let found = analyzer.at(n).ok().and_then(|analysis| quantity(&analyzer, &analysis, &value.what));
            if found.is_none_or(|found| (found - expected).abs() > tolerance) {
                misses.push(format!(
                    "{} {} at n = {n}: {found:?}, not {expected} ({})",
                    scheme.id, value.what, value.source
                ));
            }
        }
    }
    misses
}

#[test]
fn published_values_are_found() {
    let known = known_values();
    for listed in catalogue::SCHEMES {
        let scheme = catalogue::open(listed.id).unwrap().unwrap();
        assert!(known.iter().any(|value| value.scheme == scheme.id), "no known value of {}", scheme.id);
        let misses = misses(&scheme, &known);
        assert!(misses.is_empty(), "{}", misses.join("\n"));
    }
}

/// The file with the last digit of each of its numerals changed, one at a time: in rules, names and parameters.
fn mutants(listed: Listed) -> Vec<(String, String)> {
    let end = listed.text.find("[[claims]]").unwrap_or(listed.text.len());
    let mut mutants = Vec::new();
    let mut start = 0;
    for line in listed.text[..end].split_inclusive('\n') {
        // a range of values, and what is said of a parameter, say nothing of the weights
        let code = ["#", "integer", "means"].iter().fold(line, |code, end| code.split(end).next().unwrap_or(""));
        let header = ["name", "mesh", "split", "source", "boundary", "like", "default", "range"]
            .iter()
            .any(|key| code.starts_with(key));
        for (at, digit) in code.char_indices().filter(|(_, c)| !header && c.is_ascii_digit()) {
            let last = !code[at + 1..].starts_with(|c: char| c.is_ascii_digit());
            if last {
                let other = char::from_digit((digit.to_digit(10).unwrap() + 1) % 10, 10).unwrap();
                let mut text = listed.text.to_string();
                text.replace_range(start + at..start + at + 1, &other.to_string());
                mutants.push((format!("{}: {}", listed.id, &text[start..start + line.len()]), text));
            }
        }
        start += line.len();
    }
    mutants
}

/// Whether reading, checking or the known values show that something is wrong.
fn is_noticed(id: &str, text: &str, known: &[Known]) -> bool {
    let Ok(scheme) = Scheme::parse(id, id, text) else { return true };
    let valences: Vec<usize> = (3..=12).collect();
    refine::check(&scheme, &valences).is_err() || !misses(&scheme, known).is_empty()
}

#[test]
fn a_wrong_digit_in_a_scheme_file_is_noticed() {
    let known = known_values();
    for listed in catalogue::SCHEMES {
        let mutants = mutants(listed);
        assert!(mutants.len() >= 2, "{}", listed.id);
        assert!(!is_noticed(listed.id, listed.text, &known), "{} as it stands", listed.id);
        for (name, text) in mutants {
            assert!(is_noticed(listed.id, &text, &known), "not noticed: {name}");
        }
    }
}

#[test]
fn a_wrong_digit_in_a_boundary_file_is_noticed() {
    for listed in catalogue::BOUNDARIES {
        let mutants = mutants(listed);
        // a file may tell a flatness alone: a free choice, no weights
        assert!(mutants.len() >= 5 || listed.text.contains("\n[flatness]"), "{}", listed.id);
        for (name, text) in mutants {
            let sound = |(mesh, regular): (&str, usize)| {
                RuleBook::parse_boundary(listed.id, &text, mesh)
                    .is_ok_and(|book| book.check(&[1, 2, 3, 4], regular).is_ok())
            };
            assert!(![("triangles", 6), ("quads", 4)].into_iter().all(sound), "not noticed: {name}");
        }
    }
}

/// At large valences the closed forms hold as well: nothing gets lost in rings of many points.
#[test]
fn closed_forms_hold_at_large_valences() {
    for (id, n) in [("loop", 20_000), ("catmull-clark", 20_000), ("doo-sabin", 3_001), ("loop-warren", 9_999)] {
        let scheme = catalogue::open(id).unwrap().unwrap();
        let sums = refine::check(&scheme, &[n]).unwrap_or_else(|faults| panic!("{faults}"));
        assert!(sums.iter().all(|sum| sum.approx_deviation < 1e-14), "{sums:?}");
        let analysis = Analyzer::new(&scheme).unwrap().at(n).unwrap();
        let c = (std::f64::consts::TAU / n as f64).cos();
        let lambda = match id {
            "doo-sabin" => 0.5,
            "catmull-clark" => (5.0 + c + ((c + 1.0) * (c + 9.0)).sqrt()) / 16.0,
            _ => 0.375 + c / 4.0,
        };
        let found = analysis.spectrum.largest_of(1).unwrap().value.re;
        assert!((found - lambda).abs() < 1e-13, "{id}: {found} and {lambda}");
        assert!((analysis.spectrum.one().unwrap().value.re - 1.0).abs() < 1e-12, "{id}");
    }
}
