//! Does every layer look to its right only: report -> verdicts -> analysis -> refine -> {scheme, mesh} -> numbers?
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};

/// Each layer with the layers that it may use.
const MAY_USE: [(&str, &[&str]); 9] = [
    ("fault", &[]),
    ("numbers", &[]),
    ("mesh", &["numbers", "fault"]),
    ("scheme", &["numbers", "fault"]),
    ("refine", &["scheme", "mesh", "numbers", "fault"]),
    ("analysis", &["refine", "scheme", "mesh", "numbers", "fault"]),
    ("proof", &["analysis", "refine", "scheme", "mesh", "numbers", "fault"]),
    ("verdicts", &["proof", "analysis", "refine", "scheme", "mesh", "numbers", "fault"]),
    ("report", &["verdicts", "proof", "analysis", "refine", "scheme", "mesh", "numbers", "fault"]),
];

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

#[test]
fn layers_look_one_way() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut seen = 0;
    for file in rust_files(&src) {
        let inner = file.strip_prefix(&src).unwrap();
        let layer = inner.components().next().unwrap().as_os_str().to_string_lossy().replace(".rs", "");
        let Some((_, allowed)) = MAY_USE.iter().find(|(name, _)| *name == layer) else {
            assert!(["lib", "main", "cli"].contains(&layer.as_str()), "{} belongs to no layer", inner.display());
            continue;
        };
        let text = fs::read_to_string(&file).unwrap();
        // unit tests may look anywhere
        let code = text.split("#[cfg(test)]").next().unwrap();
        let used = code
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"))
            .flat_map(|line| line.split("crate::").skip(1));
        for word in used {
            let word = word.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap();
            assert!(word == layer || allowed.contains(&word), "{} uses crate::{word}", inner.display());
            seen += 1;
        }
    }
    assert!(seen > 50, "only {seen} uses were seen");
}

/// Every file of the library opens with what it is about.
#[test]
fn files_open_with_their_question() {
    for file in rust_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src")) {
        let text = fs::read_to_string(&file).unwrap();
        assert!(text.starts_with("//! "), "{}", file.display());
    }
}

/// Only the command line prints.
#[test]
fn nothing_prints_below_the_command_line() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for file in rust_files(&src).iter().filter(|file| !file.starts_with(src.join("cli"))) {
        let text = fs::read_to_string(file).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap();
        for word in ["println!", "print!", "eprintln!", "stdout()", "stderr()"] {
            assert!(!code.contains(word), "{} has {word}", file.display());
        }
    }
}

/// Every function and type that docs/theory.md says applies a theorem exists, in the file of its module.
#[test]
fn the_theory_names_what_exists() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let theory = fs::read_to_string(root.join("docs/theory.md")).unwrap();
    let sources: Vec<(PathBuf, String)> = rust_files(&root.join("src"))
        .into_iter()
        .map(|file| (file.clone(), fs::read_to_string(file).unwrap()))
        .collect();
    let mut seen = 0;
    for name in theory.split('`').skip(1).step_by(2).filter(|word| word.contains("::")) {
        let parts: Vec<&str> = name.split("::").collect();
        let (item, module) = (parts[parts.len() - 1], parts[0]);
        let defines = |text: &str| {
            ["fn ", "struct ", "enum ", "pub mod "].iter().any(|word| text.contains(&format!("{word}{item}")))
        };
        let known = |(file, text): &(PathBuf, String)| {
            let in_module = file.to_string_lossy().contains(&format!("src/{module}"));
            (in_module || module.starts_with(char::is_uppercase)) && defines(text)
        };
        assert!(sources.iter().any(known), "{name}");
        seen += 1;
    }
    assert!(seen >= 10, "{seen}");
}

/// Every source that docs/theory.md refers to is in the bibliography.
#[test]
fn the_theory_cites_known_sources() {
    let theory = include_str!("../docs/theory.md");
    let years = |word: &&str| {
        word.len() > 5 && word.rsplit('-').next().is_some_and(|year| year.len() == 4 && year.parse::<u16>().is_ok())
    };
    let cited: Vec<&str> = theory.split(|c: char| !c.is_alphanumeric() && c != '-').filter(years).collect();
    assert!(cited.len() >= 8);
    for key in cited {
        assert!(eigenring::scheme::catalogue::sources().contains_key(key), "{key}");
    }
}
