//! How fast is C1 decided for every valence? Each figure beside the exact analysis that it starts from: `cargo bench`.
#![allow(clippy::print_stdout)]

mod shared;

use eigenring::analysis::Analyzer;
use eigenring::proof::c1::Proofs;
use eigenring::refine;
use eigenring::report::certificate;
use eigenring::scheme::catalogue;
use eigenring::verdicts::EveryValence;
use shared::median;
use std::hint::black_box;

/// The schemes, and the number of runs that the median is taken of.
const SCHEMES: [(&str, &str, usize); 13] = [
    ("loop", "", 11),
    ("loop-warren", "", 11),
    ("catmull-clark", "", 11),
    ("doo-sabin", "", 11),
    ("catmull-clark-biquadratic", "", 11),
    ("modified-butterfly", "", 5),
    ("butterfly", "", 5),
    ("sqrt3", "", 5),
    ("kobbelt", "", 5),
    ("four-eight", "", 5),
    ("midpoint", "4", 3),
    ("midpoint", "6", 1),
    ("midpoint", "9", 1),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("median of several runs; ratios hold within this run only\n");
    for (id, degree, runs) in SCHEMES {
        let mut scheme = catalogue::open(id).ok_or("no such scheme")??;
        if !degree.is_empty() {
            scheme.book.set("d", degree)?;
        }
        let sums = refine::check(&scheme, &[3, 4, 5, 6, 7, 8])?;
        let analyzer = Analyzer::new(&scheme)?;
        let forms = median(runs, || drop(black_box(Analyzer::new(&scheme))));
        let prove = || EveryValence::of(&Proofs::of(&analyzer), &sums, &|_| None);
        let proved = median(runs, || drop(black_box(prove())));
        let name = format!("{id} {degree}");
        println!("{name:<28} proof {proved:>9.2} ms   {:>6.2} of the closed forms ({forms:.2} ms)", proved / forms);
        if let Ok(text) = certificate(&Proofs::of(&analyzer)) {
            let checked = median(runs, || drop(black_box(eigenring_check::check(&text, None))));
            println!("{:<28} check {checked:>9.2} ms   {:>6.2} of the proof", "", checked / proved);
        }
    }
    Ok(())
}
