//! Is every text either refused as a scheme file, or analysed, without a panic, a hang or unbounded memory?
#![no_main]

use eigenring::analysis::Analyzer;
use eigenring::refine;
use eigenring::scheme::{RuleBook, Scheme};
use libfuzzer_sys::fuzz_target;

const VALENCES: [usize; 6] = [3, 4, 5, 6, 7, 100];

fuzz_target!(|text: &str| {
    match Scheme::parse("fuzzed", "fuzzed.toml", text) {
        Err(faults) => {
            assert!(!faults.faults.is_empty());
            let _ = faults.render(false);
        }
        Ok(scheme) => match refine::check(&scheme, &VALENCES) {
            Err(faults) => {
                assert!(!faults.faults.is_empty());
                let _ = faults.render(false);
            }
            Ok(_) => {
                if let Ok(analyzer) = Analyzer::new(&scheme) {
                    let _ = analyzer.at(5);
                }
            }
        },
    }
    for mesh in ["triangles", "quads", "polygons"] {
        if let Ok(book) = RuleBook::parse_boundary("fuzzed.toml", text, mesh) {
            let _ = book.check(&[1, 2, 3], 6);
        }
    }
});
