//! How fast are polygons refined? Plane closed polygons, one step to some ten million points, one thread: `cargo bench --bench curves`.
#![allow(clippy::print_stdout)]

use eigenring::refine::curve::CurveRefiner;
use eigenring::scheme::catalogue;
use std::hint::black_box;
use std::time::Instant;

const POINTS: usize = 10_000_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for id in ["chaikin", "b-spline", "four-point", "six-point", "ternary-four-point", "bezier"] {
        let rules = catalogue::curve(id).ok_or("no such scheme")??.rules()?;
        let refiner = CurveRefiner::new(&rules);
        let closed = id != "bezier";
        let count = POINTS / refiner.arity() / 3 * 3 + 1;
        let points: Vec<[f64; 2]> = (0..count).map(|j| [j as f64, (j % 7) as f64]).collect();
        let mut times: Vec<(f64, usize)> = Vec::new();
        for _ in 0..7 {
            let start = Instant::now();
            let refined = black_box(refiner.step(&points, closed)?);
            times.push((start.elapsed().as_secs_f64(), refined.len()));
        }
        times.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (time, made) = times[times.len() / 2];
        println!("{id:<20} {:.1} million points a second", made as f64 / 1e6 / time);
    }
    Ok(())
}
