//! How fast is the mesh engine? One step to some ten million faces, connectivity and positions in f32, beside a plain copy of
//! the bytes that it writes, in the same run: `cargo bench --bench mesh`.
#![allow(clippy::print_stdout)]

use eigenring::mesh::{HalfEdgeMesh, PolygonSoup, Tags, shapes};
use eigenring::refine::{Buffers, Level, Refined, Refiner, Route};
use eigenring::scheme::{Scheme, catalogue};
use std::hint::black_box;
use std::time::Instant;

type Done<T> = Result<T, Box<dyn std::error::Error + Send + Sync>>;

const FACES: usize = 10_000_000;

fn seconds<R>(work: impl FnOnce() -> R) -> (f64, R) {
    let start = Instant::now();
    let result = work();
    (start.elapsed().as_secs_f64(), result)
}

/// The median of several runs, in seconds.
fn median(runs: usize, mut work: impl FnMut() -> f64) -> f64 {
    let mut times: Vec<f64> = (0..runs).map(|_| work()).collect();
    times.sort_by(f64::total_cmp);
    times[runs / 2]
}

fn level(soup: &PolygonSoup) -> Done<Level<f32>> {
    let mesh = HalfEdgeMesh::new(soup.positions.len(), soup.faces.clone())?;
    let positions = soup.positions.iter().map(|p| p.map(|x| x as f32)).collect();
    Ok(Level { mesh, positions, tags: Tags::default() })
}

/// The mesh one step short of the faces wanted.
fn short_of(refiner: &Refiner, soup: &PolygonSoup) -> Done<Level<f32>> {
    let mut at = level(soup)?;
    while at.mesh.faces().len() * 5 < FACES {
        at = refiner.step(&at, Route::Fast)?;
    }
    Ok(at)
}

/// The bytes of faces and points, copied into memory that was touched before.
fn copy(refined: &Refined<f32>, into: &mut Refined<f32>) -> f64 {
    let mut corners = std::mem::replace(&mut into.faces, eigenring::mesh::Faces::same(3, Vec::new())).into_corners();
    let (time, ()) = seconds(|| {
        corners.copy_from_slice(refined.faces.corners());
        into.positions.copy_from_slice(&refined.positions);
    });
    into.faces = eigenring::mesh::Faces::same(1, corners);
    time
}

fn measure(id: &str, soup: &PolygonSoup, threads: usize) -> Done<()> {
    let scheme: Scheme = catalogue::open(id).ok_or("no such scheme")??;
    let book = catalogue::boundary("cubic", &scheme.mesh).ok_or("no such boundary file")??;
    let refiner = Refiner::new(&scheme, Some(&book))?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    pool.install(|| {
        let at = short_of(&refiner, soup)?;
        let (cold, refined) = seconds(|| refiner.last_step(&at, Route::Fast));
        let refined = refined?;
        let faces = refined.faces.len() as f64 / 1e6;
        let mut other = refined.clone();
        let copied = median(5, || copy(&refined, &mut other));
        let mut buffers = Buffers::default();
        buffers.take(refined);
        let warm = median(5, || {
            let (time, refined) = seconds(|| refiner.last_step_in(&at, Route::Fast, &mut buffers));
            if let Ok(refined) = black_box(refined) {
                buffers.take(refined);
            }
            time
        });
        println!(
            "{id:<15} {threads} thread{}  {faces:>5.1} million faces  {:>6.1} (cold {:>5.1}) million faces a second, {:>4.1} times a copy of the bytes",
            if threads == 1 { " " } else { "s" },
            faces / warm,
            faces / cold,
            warm / copied,
        );
        Ok(())
    })
}

/// Points by rows, for a scheme whose rules are not compact, and for one whose rules are.
fn rows(id: &str, soup: &PolygonSoup) -> Done<()> {
    let scheme: Scheme = catalogue::open(id).ok_or("no such scheme")??;
    let refiner = Refiner::new(&scheme, None)?;
    let mut at = level(soup)?;
    for _ in 0..4 {
        at = refiner.step(&at, Route::General)?;
    }
    let (time, refined) = seconds(|| refiner.last_step(&at, Route::General));
    let points = refined?.positions.len() as f64 / 1e6;
    println!("{id:<15} by rows    {points:>5.2} million points  {:>6.2} million points a second", points / time);
    Ok(())
}

fn main() -> Done<()> {
    println!("one step, f32, into touched buffers (cold: into fresh memory)\n");
    let all = std::thread::available_parallelism()?.get();
    for threads in [1, all] {
        measure("loop", &shapes::torus(20, 20, true), threads)?;
        measure("catmull-clark", &shapes::torus(25, 25, false), threads)?;
        measure("doo-sabin", &shapes::torus(25, 25, false), threads)?;
    }
    rows("loop", &shapes::torus(20, 20, true))?;
    rows("modified-butterfly", &shapes::torus(20, 20, true))?;
    Ok(())
}
