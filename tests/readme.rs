//! Does the README say what the program does: keys of the format, commands, the JSON contract?
#![allow(clippy::unwrap_used)]

use eigenring::report::boundary::{Variant, boundary};
use eigenring::report::{Study, json};
use eigenring::scheme::vocabulary::{Arrival, RuleKind, Vocabulary};
use eigenring::scheme::{AnyScheme, KEYS, catalogue};
use std::collections::BTreeSet;

const README: &str = include_str!("../README.md");

/// The first cells of the rows of the table under a heading, without their code marks.
fn first_column(heading: &str) -> Vec<String> {
    let part = README.split(&format!("\n{heading}\n")).nth(1).unwrap_or_else(|| panic!("no heading {heading}"));
    let rows = part.lines().skip_while(|line| !line.starts_with('|')).take_while(|line| line.starts_with('|'));
    let cell = |line: &str| line.split('|').nth(1).unwrap().trim().replace('`', "");
    rows.skip(2).map(cell).collect()
}

#[test]
fn the_key_table_is_the_schema() {
    assert_eq!(first_column("### Keys"), KEYS);
}

#[test]
fn the_position_table_is_the_vocabulary() {
    let told: BTreeSet<String> = first_column("### Positions").into_iter().collect();
    let mut known = BTreeSet::new();
    for (_, kind) in RuleKind::ALL {
        known.extend(Vocabulary::get().around(kind, None).map(|position| position.name.clone()));
    }
    known.insert("i,j".to_string());
    assert_eq!(told, known);
    assert!(Vocabulary::get().positions.iter().flat_map(|p| &p.walks).any(|walk| walk.arrival == Arrival::NewFace));
}

/// Every scheme file that the README shows is sound.
#[test]
fn the_scheme_files_of_the_readme_are_sound() {
    let files: Vec<&str> = README.split("```toml\n").skip(1).map(|part| part.split("```").next().unwrap()).collect();
    let whole: Vec<&&str> = files.iter().filter(|text| text.contains("name")).collect();
    assert!(whole.len() >= 2);
    for text in whole {
        match AnyScheme::parse("readme", "README.md", text).unwrap_or_else(|faults| panic!("{faults}")) {
            AnyScheme::Surface(scheme) => {
                eigenring::refine::check(&scheme, &[3, 4, 5, 6, 7, 12]).unwrap_or_else(|faults| panic!("{faults}"));
            }
            AnyScheme::Curve(scheme) => drop(scheme.rules().unwrap_or_else(|faults| panic!("{faults}"))),
            AnyScheme::Grid(_) => panic!("no grid is shown"),
        }
    }
}

fn keys_of(value: &serde_json::Value, keys: &mut BTreeSet<String>) {
    match value {
        serde_json::Value::Object(object) => {
            for (key, value) in object {
                keys.insert(key.clone());
                if key != "parameters" {
                    keys_of(value, keys);
                }
            }
        }
        serde_json::Value::Array(list) => list.iter().for_each(|value| keys_of(value, keys)),
        _ => {}
    }
}

/// Every key of a report stands in the README's part on JSON.
#[test]
fn the_json_contract_names_every_key() {
    let contract = README.split("\n## The JSON of a report\n").nth(1).unwrap().split("\n## ").next().unwrap();
    let mut keys = BTreeSet::new();
    for id in ["loop", "doo-sabin", "modified-butterfly"] {
        let scheme = catalogue::open(id).unwrap().unwrap();
        let mut study = Study::of(&scheme, &[3, 5], false, &|| ()).unwrap();
        if !scheme.boundary.is_empty() {
            let found = boundary(&scheme, &Variant::all_of(&scheme).unwrap(), &[3, 7, 25], 10, &|| ()).unwrap();
            study.report.add_boundary(found);
        }
        keys_of(&serde_json::from_str(&json(&study.report).unwrap()).unwrap(), &mut keys);
    }
    for id in ["b-spline", "bezier", "ternary-four-point"] {
        let document =
            eigenring::report::curve::curve(&catalogue::curve(id).unwrap().unwrap(), None, 10, false).unwrap();
        keys_of(&serde_json::from_str(&document.json).unwrap(), &mut keys);
    }
    for key in &keys {
        assert!(contract.contains(&format!("\"{key}\"")) || contract.contains(&format!("`{key}`")), "{key}");
    }
    assert!(keys.len() > 30);
}

/// The example is what the program prints.
#[test]
fn the_example_is_true() {
    let scheme = catalogue::open("loop").unwrap().unwrap();
    let study = Study::of(&scheme, &(3..=12).collect::<Vec<_>>(), false, &|| ()).unwrap();
    assert!(README.contains(&eigenring::report::terminal(&study.report)));
}
