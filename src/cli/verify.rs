//! `verify`: do the masks say what refinement does?

use super::analyze::explain;
use super::mesh_file::Reading;
use super::open::{BoundaryRules, only, open_with_rules, refiner};
use super::refine::{BEFORE_LIMIT, check_rules, check_size, no_limit, refused, valences_of};
use super::valences::{Faces, Valences};
use super::{Failure, failure, print};
use clap::{Args, ValueEnum};
use eigenring::analysis::boundary::MAX_FACES;
use eigenring::analysis::places::Place;
use eigenring::analysis::verify::{Check, Levels, NORMAL, POSITION, Verifier};
use eigenring::mesh::{Connectivity, FanKind, HalfEdgeMesh, PolygonSoup, Tags, shapes};
use eigenring::refine::{Level, Obstacle, Refiner, fan_kinds};
use eigenring::scheme::Scheme;
use indicatif::{ProgressBar, ProgressStyle};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::PathBuf;

/// Checks limit and tangent masks against deep refinement of meshes.
#[derive(Args)]
#[command(
    after_help = "At each valence random points around the vertex are refined until rounding ends it, and compared with \
    the masks applied once. On whole meshes limits from the first level are compared with those from a later one. Exit status 1: a \
    mask is wrong.\n\n\
    Examples:\n  eigenring verify loop --valence 3..12\n  eigenring verify catmull-clark --mesh in.obj\n  \
    eigenring verify my-scheme.toml --valence 3..8 --format csv"
)]
pub(crate) struct Verify {
    /// A scheme of the catalogue, or the path of a scheme file
    scheme: String,
    /// Valences inside the mesh: 3..12 (both included), or a list such as 3,4,7..9 [default: 3..12; with --mesh, the mesh's]
    #[arg(long, short = 'n', value_name = "LIST")]
    valence: Option<Valences>,
    /// Numbers of faces at a boundary vertex [default: 1..6 where the scheme has boundary rules; with --mesh, the mesh's]
    #[arg(long, short, value_name = "LIST")]
    boundary_faces: Option<Faces>,
    #[command(flatten)]
    rules: BoundaryRules,
    /// Check limits on this mesh, too: OBJ, PLY, OFF or STL
    #[arg(long, value_name = "FILE")]
    mesh: Option<PathBuf>,
    #[command(flatten)]
    reading: Reading,
    /// How many steps later limits on meshes are taken again
    #[arg(long, short, default_value_t = 3, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=10))]
    levels: u8,
    /// Random neighbourhoods at each place
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    trials: u16,
    /// The seed of the random points
    #[arg(long, default_value_t = 1, value_name = "N")]
    seed: u64,
    /// Set a parameter of the scheme, for example w=1/32; may be given several times
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// How the result is printed
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Csv,
}

/// What was compared on a mesh.
struct OnMesh {
    name: String,
    steps: usize,
    levels: Levels,
}

impl Verify {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let (scheme, variants) = open_with_rules(&self.scheme, &self.set, Some(&self.rules))?;
        let book = only(variants)?;
        let meshes = self.meshes()?;
        let mut valences = self.valence.as_ref().map_or_else(|| (3..=12).collect(), |list| list.0.clone());
        if let (None, Some((_, level))) = (&self.valence, meshes.first().filter(|_| self.mesh.is_some())) {
            valences = valences_of(&level.mesh, &scheme);
        }
        eigenring::refine::check(&scheme, &valences)?;
        if let Some((_, level)) = meshes.first() {
            check_rules(&scheme, book.as_ref(), &level.mesh)?;
        }
        let plain = Refiner::new(&scheme, book.as_ref()).map_err(|wrong| refused(&scheme, wrong))?;
        if self.boundary_faces.is_some() && !(plain.boundary().is_some() && plain.keeps_boundary()) {
            let why = "there are no masks at a boundary to check: the scheme has no boundary rules, or the boundary recedes under its splits";
            return Err(failure(format!("{}: {why}", scheme.book.title)));
        }
        let own = meshes.first().map(|(_, level)| boundary_faces_of(&level.mesh));
        let places = self.places(&plain, &valences, own);
        let meshes = if self.mesh.is_some() { meshes } else { shapes_for(&plain)? };
        let refiner = refiner(&scheme, book.as_ref(), kinds(&scheme, &places, &meshes))?;
        let verifier = Verifier::new(&refiner).map_err(|obstacle| explain(&scheme, obstacle))?;
        let bar = progress(places.len());
        let mut checks = Vec::new();
        for place in places {
            let masks = verifier.masks(place).map_err(|obstacle| no_masks(&scheme, place, obstacle))?;
            let check = verifier.check(place, &masks, self.trials.into(), self.seed);
            checks.push(check.map_err(|wrong| no_limit(&scheme, wrong))?);
            bar.inc(1);
        }
        bar.finish_and_clear();
        let on_meshes = self.on_meshes(&scheme, &refiner, &verifier, meshes)?;
        print(&match self.format {
            Format::Text => text(&scheme, &self, &checks, &on_meshes),
            Format::Csv => csv(&checks, &on_meshes),
        })?;
        let wrong = checks.iter().any(|check| !check.agrees) || on_meshes.iter().any(|mesh| !mesh.levels.agrees);
        if wrong { Err(Failure::No) } else { Ok(()) }
    }

    /// Inside, and where there are boundary rules, on boundaries, at corners and at darts.
    fn places(&self, refiner: &Refiner, valences: &[usize], own: Option<Vec<usize>>) -> Vec<Place> {
        let mut places: Vec<Place> = valences.iter().map(|n| Place::Inside(*n)).collect();
        if refiner.boundary().is_none() || !refiner.keeps_boundary() {
            return places;
        }
        let asked = self.boundary_faces.as_ref().map(|list| list.0.clone());
        let faces = asked.or(own).unwrap_or_else(|| (1..=6).collect());
        places.extend(FanKind::each(&faces, refiner.keeps_edges()).into_iter().map(Place::Fan));
        places
    }

    /// The user's mesh, or shapes to try.
    fn meshes(&self) -> Result<Vec<(String, Level<f64>)>, Failure> {
        let Some(path) = &self.mesh else { return Ok(Vec::new()) };
        let loaded = self.reading.load(path)?;
        let level = Level { mesh: loaded.mesh, positions: loaded.positions, tags: loaded.tags };
        Ok(vec![(path.display().to_string(), level)])
    }

    fn on_meshes(
        &self,
        scheme: &Scheme,
        refiner: &Refiner,
        verifier: &Verifier,
        meshes: Vec<(String, Level<f64>)>,
    ) -> Result<Vec<OnMesh>, Failure> {
        let mut found = Vec::new();
        for (name, level) in meshes {
            let steps = usize::from(self.levels);
            let before = verifier.steps_before(&level);
            let why = if before > 1 { Some(BEFORE_LIMIT) } else { None };
            check_size::<f64>(refiner, &level.mesh, before.saturating_add(steps), true, why)?;
            let levels = verifier.levels(&level, steps).map_err(|wrong| no_limit(scheme, wrong))?;
            found.push(OnMesh { name, steps, levels });
        }
        Ok(found)
    }
}

/// The kinds of vertices on boundaries and creases of places, of meshes, and at the rims of the discs around places.
fn kinds(scheme: &Scheme, places: &[Place], meshes: &[(String, Level<f64>)]) -> BTreeSet<FanKind> {
    let of_place = |place: &Place| if let Place::Fan(kind) = place { Some(*kind) } else { None };
    let of_mesh = meshes.iter().flat_map(|(_, level)| fan_kinds(&level.mesh, &level.tags));
    let rim = (1..scheme.regular_valence()).flat_map(|faces| [FanKind::Crease { faces }, FanKind::Corner { faces }]);
    places.iter().filter_map(of_place).chain(of_mesh).chain(rim).collect()
}

/// Why a place has no masks, with the place where that is it.
fn no_masks(scheme: &Scheme, place: Place, obstacle: Obstacle) -> Failure {
    match obstacle {
        Obstacle::Boundary(_) => {
            let at = place_words(place);
            let help = "a shorter rule is needed there; --boundary-rules none leaves boundaries, corners and darts out";
            failure(format!("{}: at the place `{at}`: {obstacle}\n  help: {help}", scheme.book.title))
        }
        other => explain(scheme, other),
    }
}

/// The numbers of faces at a mesh's boundary vertices: the smallest so many.
fn boundary_faces_of(mesh: &HalfEdgeMesh) -> Vec<usize> {
    const CHECKED: usize = 20;
    let boundary = mesh.vertex_edges().iter().filter(|h| mesh.boundary_at(**h).is_some());
    let faces: BTreeSet<usize> = boundary.map(|h| mesh.valence(*h) - 1).filter(|k| *k <= MAX_FACES).collect();
    faces.into_iter().take(CHECKED).collect()
}

/// Named shapes that a scheme can refine; closed ones where it has no boundary rules.
fn shapes_for(refiner: &Refiner) -> Result<Vec<(String, Level<f64>)>, Failure> {
    let triangles = refiner.scheme().mesh == "triangles";
    let polygons = refiner.scheme().mesh == "polygons";
    let mut list: Vec<(&str, PolygonSoup)> = vec![("a torus", shapes::torus(5, 6, triangles))];
    if triangles || polygons {
        list.push(("valences 3 to 9", shapes::many_valences()));
    }
    if polygons {
        list.push(("a pentagonal prism", shapes::prism(5)));
    }
    if refiner.boundary().is_some() && refiner.keeps_boundary() {
        list.push(("an open tube", shapes::tube(3, 5, triangles)));
        list.push(("a disc", shapes::disc(5, triangles)));
    }
    let level = |(name, soup): (&str, PolygonSoup)| {
        let mesh = HalfEdgeMesh::new(soup.positions.len(), soup.faces).map_err(|wrong| failure(wrong.to_string()))?;
        Ok((name.to_string(), Level { mesh, positions: soup.positions, tags: Tags::default() }))
    };
    list.into_iter().map(level).collect()
}

fn progress(places: usize) -> ProgressBar {
    let bar = ProgressBar::new(places as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} places, {eta} left") {
        bar.set_style(style);
    }
    bar
}

fn place_words(place: Place) -> String {
    match place {
        Place::Inside(n) => format!("n = {n}"),
        Place::Fan(FanKind::Crease { faces }) => format!("boundary, k = {faces}"),
        Place::Fan(FanKind::Corner { faces }) => format!("corner, k = {faces}"),
        Place::Fan(FanKind::Dart { faces }) => format!("dart, n = {faces}"),
        Place::Cone => "cone".to_string(),
    }
}

/// A small number as a bound that rounding does not change from machine to machine.
fn bound(value: f64) -> String {
    if value.is_nan() {
        return "nan".to_string();
    }
    if value < 1e-15 { "< 1e-15".to_string() } else { format!("{value:.1e}") }
}

fn rate(value: f64) -> String {
    format!("{value:.8}")
}

fn text(scheme: &Scheme, asked: &Verify, checks: &[Check], meshes: &[OnMesh]) -> String {
    let trials = asked.trials;
    let mut text = format!(
        "{}: masks against random neighbourhoods, {trials} at each place, refined deeply (seed {})\n\n",
        scheme.book.title, asked.seed
    );
    let _ = writeln!(
        text,
        "{:<16} {:>5} {:>11} {:>9} {:>9}  {:>21} {:>21} {:>10} {:>10}  verdict",
        "place", "steps", "limit point", "tangents", "normal", "lambda", "lambda seen", "mu", "mu seen"
    );
    for check in checks {
        let _ = writeln!(text, "{}", line(check));
    }
    let _ = writeln!(
        text,
        "\nlimit point: the largest difference of a coordinate (at most {POSITION:.0e}); tangents: that between a step and lambda times the \
         tangents\nbefore it, over the sum of the mask's weights without their signs where that is above 1 (at most {POSITION:.0e}); normal: the angle in \
         radians\n(at most {NORMAL:.0e}, or what slow convergence leaves); lambda: the factors by which tangents shrink in a step; mu: that of what is \
         beside them.\n"
    );
    for mesh in meshes {
        let Levels { vertices, position, normal, without_normal, gaps, agrees } = &mesh.levels;
        let verdict = if *agrees { "agree" } else { "DIFFER" };
        let none = if *without_normal > 0 { format!(", {without_normal} without a normal") } else { String::new() };
        let _ = writeln!(
            text,
            "{}: limits of level 0 and level {} {verdict}: positions {} of its size, normals {}, {vertices} vertices{none}",
            mesh.name,
            mesh.steps,
            bound(*position),
            bound(*normal)
        );
        let _ = writeln!(text, "  from the control net to the limit: {}", shrinking(gaps));
    }
    let wrong =
        checks.iter().filter(|check| !check.agrees).count() + meshes.iter().filter(|m| !m.levels.agrees).count();
    let all = checks.len() + meshes.len();
    text + &match wrong {
        0 => format!("\nAll {all} checks agree.\n"),
        1 => format!("\n1 of {all} checks disagrees: a mask is wrong.\n"),
        _ => format!("\n{wrong} of {all} checks disagree: masks are wrong.\n"),
    }
}

fn line(check: &Check) -> String {
    let seen = check.normal.as_ref().ok().filter(|normal| normal.is_seen());
    let normal = seen.map_or("-".to_string(), |normal| bound(normal.angle));
    let tangent = if check.rates.is_some() { bound(check.tangent) } else { "-".to_string() };
    // of the two factors the larger first; rounding of a double one is not shown
    let pair = |[a, b]: [f64; 2]| {
        if (a - b).abs() < 1e-7 { rate((a + b) / 2.0) } else { format!("{}, {}", rate(a.max(b)), rate(a.min(b))) }
    };
    let (lambda, seen, mu, mu_seen) = check.rates.map_or_else(Default::default, |(rates, seen)| {
        let mu_seen = seen.mu.map_or("-".to_string(), rate);
        (pair(rates.lambda), pair(seen.lambda), rate(rates.mu), mu_seen)
    });
    let verdict = match (&check.agrees, &check.normal) {
        (false, _) => "WRONG".to_string(),
        (true, Ok(normal)) if normal.bound.is_infinite() => {
            "agrees; a Jordan block: normals converge like 1/m".to_string()
        }
        (true, Ok(normal)) if !normal.is_seen() => "agrees; normals converge too slowly to be seen".to_string(),
        (true, Ok(normal)) if normal.bound > NORMAL => format!("agrees (normals to {:.0e})", normal.bound),
        (true, Ok(_)) => "agrees".to_string(),
        (true, Err(why)) => format!("limit point agrees; {why}"),
    };
    format!(
        "{:<16} {:>5} {:>11} {:>9} {:>9}  {:>21} {:>21} {:>10} {:>10}  {verdict}",
        place_words(check.place),
        check.steps,
        bound(check.position),
        tangent,
        normal,
        lambda,
        seen,
        mu,
        mu_seen
    )
}

/// Distances level by level, and by which factor the last one is smaller than the one before.
fn shrinking(gaps: &[f64]) -> String {
    let list: Vec<String> = gaps.iter().map(|gap| format!("{gap:.3e}")).collect();
    let ratio = match gaps {
        [.., before, last] if *last > 0.0 => format!("; {:.3} times less in the last step", before / last),
        _ => String::new(),
    };
    format!("{}{ratio}", list.join(", "))
}

fn csv(checks: &[Check], meshes: &[OnMesh]) -> String {
    let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    let mut text = "place,steps,position,tangent,normal,normal_bound,lambda_1,lambda_2,lambda_1_seen,lambda_2_seen,mu,mu_seen,agrees,why\n"
        .to_string();
    for check in checks {
        let angle = check.normal.as_ref().ok();
        let rates = check.rates.as_ref();
        let why = check.normal.as_ref().err().map_or(String::new(), |why| format!("\"{}\"", why.replace('"', "'")));
        let _ = writeln!(
            text,
            "\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{why}",
            place_words(check.place),
            check.steps,
            check.position,
            check.tangent,
            number(angle.map(|a| a.angle)),
            number(angle.map(|a| a.bound)),
            number(rates.map(|(rates, _)| rates.lambda[0])),
            number(rates.map(|(rates, _)| rates.lambda[1])),
            number(rates.map(|(_, seen)| seen.lambda[0])),
            number(rates.map(|(_, seen)| seen.lambda[1])),
            number(rates.map(|(rates, _)| rates.mu)),
            number(rates.and_then(|(_, seen)| seen.mu)),
            check.agrees,
        );
    }
    for mesh in meshes {
        let Levels { position, normal, agrees, .. } = &mesh.levels;
        let name = mesh.name.replace('"', "'");
        let _ = writeln!(text, "\"{name}\",{},{position},,{normal},{NORMAL},,,,,,,{agrees},", mesh.steps);
    }
    text
}
