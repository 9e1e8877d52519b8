//! `refine` and `limit`: what becomes of this mesh?

use super::analyze::explain;
use super::mesh_file::{Loaded, Reading, check_destination, creases_of, save, statistics, statistics_of_faces};
use super::open::{BoundaryRules, only, open_any, refiner};
use super::{Failure, failure, memory, say};
use clap::{Args, ValueEnum};
use eigenring::analysis::boundary::MAX_FACES;
use eigenring::analysis::limit::{LimitSurface, Limits, NoLimit};
use eigenring::analysis::local::MAX_VALENCE;
use eigenring::mesh::io::{Coordinates, Output};
use eigenring::mesh::{Connectivity, HalfEdgeMesh, Tags};
use eigenring::refine::{Coordinate, Counts, Level, NotRefinable, Obstacle, Refined, Refiner, Route, fan_kinds};
use eigenring::scheme::{AnyScheme, RuleBook, Scheme};
use indicatif::{ProgressBar, ProgressStyle};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Refines a mesh: OBJ, PLY, OFF or STL in; these or binary glTF out. Schemes for curves refine polygons: CSV, JSON, SVG or OBJ.
#[derive(Args)]
#[command(
    after_help = "Creases are read from OBJ lines such as `t crease 1/2 3.5`: the edge between vertices 1 and 2, \
    for three and a half steps. A boundary needs the boundary file that the scheme names.\n\n\
    Examples:\n  eigenring refine loop in.obj -o out.ply --levels 3\n  \
    eigenring refine catmull-clark in.obj -o out.glb --levels 2 --to-limit\n  \
    eigenring refine catmull-clark in.off -o out.obj --crease-angle 40 --boundary corner"
)]
pub(crate) struct Refine {
    #[command(flatten)]
    job: Job,
    /// The number of steps
    #[arg(long, short, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=40))]
    levels: u8,
    /// Push the vertices of the last level to the limit, with normals
    #[arg(long)]
    to_limit: bool,
}

/// Pushes the vertices of a mesh to the limit surface, with normals.
#[derive(Args)]
#[command(
    after_help = "Limit points and normals come from the masks of the analysis. Where there is no tangent plane the \
    normal is zero, and the reason is told.\n\n\
    Examples:\n  eigenring limit loop in.obj -o out.ply\n  eigenring limit catmull-clark in.obj -o out.glb --levels 3"
)]
pub(crate) struct Limit {
    #[command(flatten)]
    job: Job,
    /// The number of steps that the mesh is refined by first
    #[arg(long, short, default_value_t = 0, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=40))]
    levels: u8,
}

#[derive(Args)]
struct Job {
    /// A scheme of the catalogue, or the path of a scheme file
    scheme: String,
    /// The mesh: OBJ, PLY, OFF or STL; or polygons: CSV, JSON, SVG or OBJ
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The file to be written: OBJ, PLY, OFF, STL or GLB; or CSV, JSON, SVG or OBJ
    #[arg(long, short, value_name = "OUT")]
    out: PathBuf,
    /// Set a parameter of the scheme, for example w=1/32; may be given several times
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    rules: BoundaryRules,
    #[command(flatten)]
    reading: Reading,
    /// For curves: close the polygons of files that can't tell
    #[arg(long)]
    closed: bool,
    /// The number of threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Numbers of 32 or 64 bits
    #[arg(long, value_enum, default_value = "double")]
    precision: Precision,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Precision {
    /// 32 bits
    Single,
    /// 64 bits
    Double,
}

impl Refine {
    pub(crate) fn run(self) -> Result<(), Failure> {
        self.job.run(self.levels.into(), self.to_limit)
    }
}

impl Limit {
    pub(crate) fn run(self) -> Result<(), Failure> {
        self.job.run(self.levels.into(), true)
    }
}

impl Job {
    fn run(&self, levels: usize, to_limit: bool) -> Result<(), Failure> {
        let (scheme, variants) = open_any(&self.scheme, &self.set, Some(&self.rules))?;
        let scheme = match scheme {
            AnyScheme::Surface(scheme) => *scheme,
            AnyScheme::Curve(scheme) => {
                return super::curve::refine(&scheme, (&self.input, &self.out), self.closed, levels, to_limit);
            }
            AnyScheme::Grid(scheme) => return super::grid::refine(&scheme, (&self.input, &self.out), levels, to_limit),
        };
        check_destination(&self.out)?;
        let loaded = self.reading.load(&self.input)?;
        say(&statistics("read", &loaded.mesh));
        let threads = self.threads.map_or(0, usize::from);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|error| failure(format!("{threads} threads can't be started: {error}")))?;
        let book = only(variants)?;
        eigenring::refine::check(&scheme, &valences_of(&loaded.mesh, &scheme))?;
        check_rules(&scheme, book.as_ref(), &loaded.mesh)?;
        pool.install(|| match self.precision {
            Precision::Single => self.work::<f32>(&scheme, book.as_ref(), loaded, levels, to_limit),
            Precision::Double => self.work::<f64>(&scheme, book.as_ref(), loaded, levels, to_limit),
        })
    }

    fn work<T: Coordinate>(
        &self,
        scheme: &Scheme,
        book: Option<&RuleBook>,
        loaded: Loaded,
        levels: usize,
        to_limit: bool,
    ) -> Result<(), Failure>
    where
        for<'a> &'a [[T; 3]]: Into<Coordinates<'a>>,
    {
        let refiner = refiner(scheme, book, fan_kinds(&loaded.mesh, &loaded.tags))?;
        refiner.fits(&loaded.mesh, &loaded.tags).map_err(|wrong| refused(scheme, wrong))?;
        check_size::<T>(&refiner, &loaded.mesh, levels, to_limit, None)?;
        let ending = loaded.tags.most_steps().ceil() as usize;
        if to_limit && ending > levels {
            check_size::<f64>(&refiner, &loaded.mesh, ending, true, Some(BEFORE_LIMIT))?;
        }
        let start = Instant::now();
        let positions = loaded.positions.into_iter().map(|p| p.map(T::from_f64)).collect();
        let mut at = Level { mesh: loaded.mesh, positions, tags: loaded.tags };
        let bar = progress(levels, Counts::of(&at.mesh).faces << (2 * levels as u32).min(100));
        // of the last step no mesh is needed, unless something is to be done with it
        let receding = refiner.recedes() && !at.mesh.is_closed();
        let whole = to_limit || receding || !at.tags.is_empty();
        let whole_steps = if whole { levels } else { levels.saturating_sub(1) };
        for _ in 0..whole_steps {
            at = refiner.step(&at, Route::Fast).map_err(|wrong| refused(scheme, wrong))?;
            bar.inc(1);
        }
        if to_limit {
            self.write_limit::<T>(scheme, &refiner, at, start, &bar)
        } else if whole_steps < levels {
            let edges = refiner.counts_after(Counts::of(&at.mesh), &at.tags).edges;
            let Refined { faces, positions } =
                refiner.finish(at, Route::Fast).map_err(|wrong| refused(scheme, wrong))?;
            bar.finish_and_clear();
            let time = start.elapsed();
            say(&statistics_of_faces("refined", positions.len(), edges as usize, &faces));
            say(&made(faces.len(), time));
            save(&self.out, &Output::new(positions.as_slice(), &faces))
        } else {
            bar.finish_and_clear();
            let time = start.elapsed();
            say(&statistics("refined", &at.mesh));
            say(&made(at.mesh.faces().len(), time));
            let (creases, corners) = (creases_of(&at.mesh, &at.tags), at.tags.corners());
            save(&self.out, &Output::new(at.positions.as_slice(), at.mesh.faces()).tags(&creases, corners))
        }
    }

    fn write_limit<T: Coordinate>(
        &self,
        scheme: &Scheme,
        refiner: &Refiner,
        at: Level<T>,
        start: Instant,
        bar: &ProgressBar,
    ) -> Result<(), Failure>
    where
        for<'a> &'a [[T; 3]]: Into<Coordinates<'a>>,
    {
        let limits = Limits::new(refiner).map_err(|obstacle| explain(scheme, obstacle))?;
        let positions = at.positions.into_iter().map(|p| p.map(T::to_f64)).collect();
        let at = Level { mesh: at.mesh, positions, tags: at.tags };
        let more = limits.steps_before(&at);
        check_size::<f64>(refiner, &at.mesh, more, true, Some(BEFORE_LIMIT))?;
        bar.inc_length(more as u64);
        let surface = limits.of(&at, &|| bar.inc(1)).map_err(|wrong| no_limit(scheme, wrong))?;
        bar.finish_and_clear();
        let time = start.elapsed();
        say(&statistics("pushed to the limit", &at.mesh));
        say(&made(at.mesh.faces().len(), time));
        say_without_normal(&surface);
        let positions: Vec<[T; 3]> = surface.positions.into_iter().map(|p| p.map(T::from_f64)).collect();
        let normals: Vec<[T; 3]> = surface.normals.into_iter().map(|n| n.map(T::from_f64)).collect();
        save(&self.out, &Output::new(positions.as_slice(), at.mesh.faces()).normals(normals.as_slice()))
    }
}

/// The valences of a mesh that a scheme's rules are told around, and the sizes of its faces where they are, too: the smallest so many.
pub(crate) fn valences_of(mesh: &HalfEdgeMesh, scheme: &Scheme) -> Vec<usize> {
    const CHECKED: usize = 40;
    let inside = mesh.vertex_edges().iter().filter(|h| mesh.boundary_at(**h).is_none());
    let sizes = mesh.faces().iter().filter(|_| scheme.mesh != "triangles").map(<[u32]>::len);
    let valences = inside.map(|h| mesh.valence(*h)).chain(sizes);
    let valences: BTreeSet<usize> = valences.filter(|n| (3..=MAX_VALENCE).contains(n)).collect();
    valences.into_iter().take(CHECKED).collect()
}

/// Checks boundary rules at the numbers of faces and the valences of a mesh.
pub(crate) fn check_rules(scheme: &Scheme, book: Option<&RuleBook>, mesh: &HalfEdgeMesh) -> Result<(), Failure> {
    let Some(book) = book else { return Ok(()) };
    let boundary = mesh.vertex_edges().iter().filter(|h| mesh.boundary_at(**h).is_some());
    let faces: BTreeSet<usize> = boundary.map(|h| mesh.valence(*h) - 1).filter(|k| *k <= MAX_FACES).collect();
    let counts: Vec<usize> = faces.into_iter().take(40).chain(valences_of(mesh, scheme)).collect();
    book.check(&counts, scheme.regular_valence())?;
    Ok(())
}

/// Checks, before starting, that indices and memory suffice for some steps; `why` they are made, and what to do otherwise, is told
/// where it isn't `--levels`.
pub(crate) fn check_size<T: Coordinate>(
    refiner: &Refiner,
    mesh: &HalfEdgeMesh,
    levels: usize,
    to_limit: bool,
    why: Option<&str>,
) -> Result<(), Failure> {
    let mut counts = Counts::of(mesh);
    let limit_of = |counts: Counts| if to_limit { counts.bytes_of_mesh::<f64>() + counts.bytes_of_limit() } else { 0 };
    let mut most = limit_of(counts);
    let (mut needed, mut fits, mut made) = (most, 0, 0);
    let available = memory::available();
    while made < levels && counts.can_be_numbered() {
        most = most.max(refiner.bytes_of_step::<T>(counts));
        counts = refiner.counts_after(counts, &Tags::default());
        made += 1;
        // of the last level a mesh is made, to be told about or pushed to the limit
        needed = most.max(counts.bytes_of_mesh::<T>()).max(limit_of(counts));
        if counts.can_be_numbered() && available.is_none_or(|available| needed <= available) {
            fits = made;
        }
    }
    let help = why.map_or(format!("--levels {fits} fits"), str::to_string);
    if !counts.can_be_numbered() {
        let (limit, Counts { faces, corners, .. }) = (eigenring::mesh::MAX_CORNERS, counts);
        let message = format!("{made} of {levels} steps make {faces} faces with {corners} corners, more than {limit}");
        return Err(failure(format!("{message}\n  help: {help}")));
    }
    let what = format!("a mesh of {} faces after {levels} steps", counts.faces);
    memory::check(needed, &what, &help)
}

/// What is to be done where a mesh must be refined too often before its limit is taken.
pub(crate) const BEFORE_LIMIT: &str = "before limits are taken, creases that end are refined away, and irregular vertices apart: creases \
    of a few steps, or for ever (inf), and a mesh of fewer faces need less";

/// A bar on a terminal, when there will be much to do.
fn progress(levels: usize, faces: u128) -> ProgressBar {
    if faces < 2_000_000 {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(levels as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} step {pos} of {len}, {elapsed}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

fn made(faces: usize, time: Duration) -> String {
    let (seconds, millions) = (time.as_secs_f64(), faces as f64 / 1e6);
    let speed =
        if millions > 0.1 { format!(", {:.1} million faces a second", millions / seconds) } else { String::new() };
    format!("  in {seconds:.3} s{speed}")
}

fn say_without_normal(surface: &LimitSurface) {
    for (why, (first, count)) in &surface.without_normal {
        let others = if *count > 1 { format!(" and {} more", count - 1) } else { String::new() };
        say(&format!("note: no normal at vertex {first} (the first is 0){others}: {why}"));
    }
    if let Some((first, count)) = surface.slow_normals {
        let others = if count > 1 { format!(" and {} more", count - 1) } else { String::new() };
        let why =
            "its tangents belong to a Jordan block; the normals of refined meshes come near to its normal like 1/m";
        say(&format!("note: vertex {first}{others}: {why}"));
    }
}

/// Why a mesh can't be refined, in words that help.
pub(crate) fn refused(scheme: &Scheme, wrong: NotRefinable) -> Failure {
    match wrong {
        NotRefinable::Obstacle(Obstacle::NoRule(rule)) => {
            let help = match scheme.boundary.first() {
                Some(name) => format!("the scheme names the file of boundary rules `{name}`; or close the mesh"),
                None => "name a file of boundary rules in the scheme file, boundary = [\"cubic\"], or close the mesh"
                    .to_string(),
            };
            let why = "which this mesh needs: it has a boundary or a crease";
            failure(format!("{} has no rule [{rule}], {why}\n  help: {help}", scheme.book.title))
        }
        NotRefinable::Obstacle(obstacle) => explain(scheme, obstacle),
        NotRefinable::At(_, ref obstacle) if matches!(**obstacle, Obstacle::Boundary(_)) => failure(format!(
            "{}: {wrong}\n  help: no rule is told for such a place: a shorter rule is needed, or a mesh without boundary and creases",
            scheme.book.title
        )),
        NotRefinable::Face { needed: 3, .. } => failure(format!(
            "{}: {wrong}\n  help: --triangulate cuts them, or take a scheme for polygons, such as catmull-clark",
            scheme.book.title
        )),
        NotRefinable::Face { needed: 4, .. } => failure(format!(
            "{}: {wrong}\n  help: a step of `eigenring refine catmull-clark` makes quads of any mesh; or take a scheme for polygons",
            scheme.book.title
        )),
        other => failure(format!("{}: {other}", scheme.book.title)),
    }
}

pub(crate) fn no_limit(scheme: &Scheme, wrong: NoLimit) -> Failure {
    match wrong {
        NoLimit::Refinement(wrong) => refused(scheme, wrong),
        NoLimit::Vertex(..) => failure(format!("{}: {wrong}", scheme.book.title)),
    }
}
