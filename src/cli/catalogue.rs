//! `schemes` and `new`: which schemes are there, and how does one start another?

use super::open::open;
use super::{Failure, failure, print};
use clap::Args;
use eigenring::report::write_whole;
use eigenring::scheme::curve::Rules;
use eigenring::scheme::{RuleBook, Scheme, catalogue};
use std::fmt::Write;
use std::path::PathBuf;

/// Lists the schemes of the catalogue, or prints the file of one.
#[derive(Args)]
#[command(after_help = "Examples:\n  eigenring schemes\n  eigenring schemes loop > my-scheme.toml")]
pub(crate) struct Schemes {
    /// A scheme of the catalogue, whose file is printed
    name: Option<String>,
}

impl Schemes {
    pub(crate) fn run(self) -> Result<(), Failure> {
        match self.name {
            None => print(&listing()?),
            Some(name) => match catalogue::all().find(|listed| listed.id == name) {
                Some(listed) => print(listed.text),
                None => Err(failure(format!("there is no scheme `{name}`; `eigenring schemes` lists them"))),
            },
        }
    }
}

fn listing() -> Result<String, Failure> {
    let schemes = catalogue::SCHEMES.iter().map(|listed| open(listed.id, &[])).collect::<Result<Vec<Scheme>, _>>()?;
    let mut text = String::new();
    for (mesh, title) in [("triangles", "On triangles"), ("quads", "On quads"), ("polygons", "On polygons")] {
        let own: Vec<&Scheme> = schemes.iter().filter(|scheme| scheme.mesh == mesh).collect();
        if own.is_empty() {
            continue;
        }
        let _ = writeln!(text, "{title}");
        for scheme in own {
            let kind = if scheme.is_interpolating() { "interpolating" } else { "approximating" };
            let split = if scheme.is_dual() { "vertex split" } else { "face split" };
            let parameters: Vec<&str> = scheme.book.parameters.iter().map(|p| p.name.as_str()).collect();
            let set =
                if parameters.is_empty() { String::new() } else { format!(", parameter {}", parameters.join(", ")) };
            let _ =
                writeln!(text, "  {:<26} {} ({}, {split}, {kind}{set})", scheme.id, scheme.book.title, scheme.split);
        }
    }
    text.push_str(&others()?);
    text.push_str(
        "\n`eigenring schemes NAME` prints a file, `eigenring new MINE --like NAME` starts one of your own.\n",
    );
    Ok(text)
}

/// The schemes for curves and grids.
fn others() -> Result<String, Failure> {
    let set = |book: &RuleBook| {
        let names: Vec<&str> = book.parameters.iter().map(|p| p.name.as_str()).collect();
        if names.is_empty() { String::new() } else { format!(", parameter {}", names.join(", ")) }
    };
    let mut text = "On curves\n".to_string();
    for listed in catalogue::CURVES {
        let Some(scheme) = catalogue::curve(listed.id).transpose()? else { continue };
        let arity = match scheme.rules()? {
            Rules::Mask(mask, _) => format!("arity {}", mask.arity),
            Rules::Halves(_) => "polygons".to_string(),
        };
        let told = scheme.form_word();
        let _ =
            writeln!(text, "  {:<26} {} ({arity}, told as {told}{})", scheme.id, scheme.book.title, set(&scheme.book));
    }
    text.push_str("On grids\n");
    for listed in catalogue::GRIDS {
        let Some(scheme) = catalogue::grid(listed.id).transpose()? else { continue };
        let [a, b] = &scheme.factors;
        let _ = writeln!(text, "  {:<26} {} ({} x {})", scheme.id, scheme.book.title, a.scheme, b.scheme);
    }
    Ok(text)
}

/// Starts a scheme file of your own from one of the catalogue.
#[derive(Args)]
#[command(after_help = "Examples:\n  eigenring new my-scheme --like loop\n  eigenring analyze my-scheme.toml")]
pub(crate) struct New {
    /// The scheme's name; the file is NAME.toml
    name: String,
    /// The scheme of the catalogue to start from
    #[arg(long, default_value = "loop", value_name = "SCHEME")]
    like: String,
}

impl New {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let listed = catalogue::all().find(|listed| listed.id == self.like);
        let listed = listed
            .ok_or_else(|| failure(format!("there is no scheme `{}`; `eigenring schemes` lists them", self.like)))?;
        let stem = self.name.trim_end_matches(".toml");
        let path = PathBuf::from(format!("{stem}.toml"));
        let title = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        if stem.is_empty()
            || stem.ends_with(['/', '.'])
            || title.contains(['"', '\\'])
            || title.chars().any(char::is_control)
        {
            return Err(failure(format!("`{}` can't be the name of a scheme", self.name)));
        }
        if path.exists() {
            return Err(failure(format!("`{}` is there already; choose another name", path.display())));
        }
        write_whole(&path, starter(listed.text, &title, &self.like).as_bytes())
            .map_err(|error| failure(format!("`{}` can't be written: {error}", path.display())))?;
        let shown = path.display().to_string();
        let quoted = if shown.contains(char::is_whitespace) { format!("\"{shown}\"") } else { shown.clone() };
        let valences = if catalogue::scheme(&self.like).is_some() { " --valence 3..12" } else { "" };
        print(&format!("Written: {shown}\nNow try: eigenring analyze {quoted}{valences}\n"))
    }
}

/// The file of the catalogue under a new name, with a word on what may be changed, and without its claims.
fn starter(text: &str, title: &str, like: &str) -> String {
    let body: Vec<&str> = text
        .split("[[claims]]")
        .next()
        .unwrap_or(text)
        .lines()
        .filter(|line| !line.starts_with('#') && !line.starts_with("source"))
        .collect();
    let named: Vec<String> = body
        .iter()
        .map(|line| if line.starts_with("name ") { format!("name     = \"{title}\"") } else { (*line).to_string() })
        .collect();
    let surface = catalogue::scheme(like).is_some();
    let (head, claims) = if surface { (HEAD, CLAIMS) } else { (CURVE_HEAD, "") };
    format!("{}\n{}\n{claims}", head.replace("LIKE", like), named.join("\n").trim_end())
}

const HEAD: &str = "\
# A scheme like LIKE, to be changed.
#
# A weight is that of each point of its name; weights are formulas in n, the number of edges at the vertex (or corners of
# the face) that the rule is told around. The weights of every rule must sum to 1 for every n. Formulas know numbers,
# + - * / ^, parentheses, pi, cos, sin, sqrt, binom, min and max; j is a point's index in its class (ring[0], ring[1], ...);
# names may be defined under [let], numbers that you want to try out under [parameters] (w = \"1/16\", then --set w=1/20).
";

const CURVE_HEAD: &str = "\
# A scheme like LIKE, to be changed.
#
# Weights are formulas: a mask with the index of its first weight, the symbol in z, or averaging weights after a split at
# midpoints. The weights with equal index modulo the arity must sum to 1. Numbers that you want to try out stand under
# [parameters] (w = \"1/16\", then --set w=1/20).
";

const CLAIMS: &str = "
# What you expect can be claimed here; every report compares it with the analysis.
# [[claims]]
# what   = \"subdominant\"
# equals = \"1/2\"
# where  = \"n >= 3\"
";
