//! How fast is the analysis? Each figure beside a yardstick measured in the same run: `cargo bench`.
#![allow(clippy::print_stdout)]

mod shared;

use eigenring::analysis::blocks::Blocks;
use eigenring::analysis::cores::Cores;
use eigenring::analysis::spectrum::Spectrum;
use eigenring::analysis::{Analysis, Analyzer};
use eigenring::report::{Study, csv, json, latex, markdown, png};
use eigenring::scheme::{Scheme, catalogue};
use shared::median;
use std::hint::black_box;

fn row(what: &str, milliseconds: f64, yardstick: &str, other: f64) {
    println!("{what:<58} {milliseconds:>9.3} ms   {:>7.3} of {yardstick} ({other:.3} ms)", milliseconds / other);
}

fn open(id: &str) -> Result<Scheme, Box<dyn std::error::Error>> {
    Ok(catalogue::open(id).ok_or("no such scheme")??)
}

/// Eigenvalues of the blocks 0..floor(n/2) as dense complex matrices, by the library alone.
fn dense_blocks(analysis: &Analysis) -> usize {
    (0..=analysis.valence / 2)
        .filter_map(|k| analysis.blocks.block(k).try_schur(1e-14, 1000))
        .filter_map(|schur| schur.eigenvalues())
        .map(|eigenvalues| eigenvalues.len())
        .sum()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("median of several runs; ratios hold within this run only\n");
    for id in ["loop", "catmull-clark", "doo-sabin"] {
        let scheme = open(id)?;
        let analyzer = Analyzer::new(&scheme)?;
        let analyses: Vec<Analysis> = [10_000, 100_000].iter().filter_map(|n| analyzer.at(*n).ok()).collect();
        let [small, large] = analyses.as_slice() else { return Err("no analysis".into()) };
        let spectrum = |analysis: &Analysis| {
            let blocks = Blocks::of(&analysis.local);
            let cores = Cores::of(&blocks);
            let _ = black_box(Spectrum::of(&blocks, &cores));
        };
        let ours = median(5, || spectrum(large));
        row(
            &format!("{id}: all eigenvalues, n = 100,000"),
            ours,
            "dense blocks",
            median(1, || {
                black_box(dense_blocks(large));
            }),
        );
        row(&format!("{id}: all eigenvalues, n = 100,000"), ours, "n = 10,000", median(5, || spectrum(small)));
        let valences: Vec<usize> = (3..=12).collect();
        let analysis = median(21, || {
            for n in &valences {
                let _ = black_box(analyzer.at(*n));
            }
        });
        let forms = median(21, || drop(black_box(Analyzer::new(&scheme))));
        row(&format!("{id}: closed forms for all n"), forms, "the analysis of n = 3..12, exact", analysis);
        let (few, many) =
            (median(5, || drop(black_box(analyzer.at(11)))), median(5, || drop(black_box(analyzer.at(43)))));
        row(&format!("{id}: exact analysis, n = 43 (degree 21)"), many, "n = 11 (degree 5)", few);
        let study = median(11, || drop(black_box(Study::of(&scheme, &valences, false, &|| ()))));
        row(&format!("{id}: analysis, n = 3..12"), analysis, "reading, checking and judging too", study);
        let drawn = median(5, || drop(black_box(Study::of(&scheme, &valences, true, &|| ()))));
        row(&format!("{id}: report without pictures, n = 3..12"), study, "with pictures (SVG)", drawn);
        let study = Study::of(&scheme, &valences, true, &|| ())?;
        let texts = median(11, || {
            let figures = study.figures();
            let _ = black_box((
                json(&study.report),
                csv(&study.report),
                markdown(&study.report, &figures),
                latex(&study.report, &figures),
            ));
        });
        let pictures = median(3, || study.pictures.iter().for_each(|picture| drop(black_box(png(&picture.svg)))));
        row(&format!("{id}: Markdown, LaTeX, CSV and JSON"), texts, "PNG of all pictures, one thread", pictures);
    }
    Ok(())
}
