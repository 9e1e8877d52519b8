//! `schemes` and `new`: which schemes are there, and how does one start another?

use super::open::open;
use super::{Failure, failure, print};
use clap::Args;
use eigenring::analysis::Analyzer;
use eigenring::refine::is_dual;
use eigenring::report::regular::{RegularReport, regular_report};
use eigenring::report::write_whole;
use eigenring::scheme::curve::Rules;
use eigenring::scheme::{RuleBook, Scheme, catalogue};
use std::fmt::Write;
use std::path::PathBuf;

/// Lists the schemes of the catalogue and its boundary files, or prints the file of one.
#[derive(Args)]
#[command(after_help = "Examples:\n  eigenring schemes\n  eigenring schemes loop > my-scheme.toml")]
pub(crate) struct Schemes {
    /// A scheme or a boundary file of the catalogue, which is printed
    name: Option<String>,
}

impl Schemes {
    pub(crate) fn run(self) -> Result<(), Failure> {
        match self.name {
            None => print(&listing()?),
            Some(name) => match catalogue::all().chain(catalogue::BOUNDARIES).find(|listed| listed.id == name) {
                Some(listed) => print(listed.text),
                None => Err(failure(format!("there is no scheme `{name}`; `eigenring schemes` lists them"))),
            },
        }
    }
}

/// The schemes as surveys group them: by mesh and by what a step splits, each with its smoothness.
fn listing() -> Result<String, Failure> {
    let schemes = catalogue::SCHEMES.iter().map(|listed| open(listed.id, &[])).collect::<Result<Vec<Scheme>, _>>()?;
    let mut text = format!("{:2}{:<26} {:<14} {:<15} {}\n", "", "scheme", "", "regular meshes", "elsewhere");
    let mut groups: Vec<(String, Vec<&Scheme>)> = Vec::new();
    for scheme in &schemes {
        let class = scheme.classification(is_dual(scheme));
        let title = format!("On {}, {}", class.mesh, class.kind_of_split());
        match groups.iter_mut().find(|(own, _)| *own == title) {
            Some((_, group)) => group.push(scheme),
            None => groups.push((title, vec![scheme])),
        }
    }
    for (title, mut group) in groups {
        group.sort_by_key(|scheme| scheme.is_interpolating());
        let _ = writeln!(text, "\n{title}");
        group.into_iter().for_each(|scheme| text.push_str(&line(scheme)));
    }
    text.push_str(&others()?);
    text.push_str(
        "\nAll are linear and stationary. The smoothness on regular meshes is proved here, from the symbol; that elsewhere is\n\
         the literature's, and `eigenring analyze NAME` looks at both.\n\
         `eigenring schemes NAME` prints a file, `eigenring new MINE --like NAME` starts one of your own.\n",
    );
    Ok(text)
}

/// A scheme in a line, its spline and parameters in another.
fn line(scheme: &Scheme) -> String {
    let class = scheme.classification(is_dual(scheme));
    let analyzer = Analyzer::new(scheme).ok();
    let regular = analyzer.as_ref().and_then(|analyzer| analyzer.regular().ok()).map(regular_report);
    let smoothness = regular.as_ref().map_or("-".to_string(), RegularReport::smoothness_in_words);
    let claimed = Some(class.claimed()).filter(|words| !words.is_empty()).unwrap_or("-".to_string());
    let kind = class.kind_of_points();
    let mut text = format!("  {:<26} {kind:<14} {smoothness:<15} {claimed}\n", scheme.id);
    let spline = regular.and_then(|regular| regular.spline).map(|spline| spline.name);
    let parameters: Vec<&str> = scheme.book.parameters.iter().map(|p| p.name.as_str()).collect();
    let set = (!parameters.is_empty()).then(|| format!("parameter {}", parameters.join(", ")));
    let more: Vec<String> = [Some(scheme.book.title.clone()), Some(format!("split {}", class.split)), spline, set]
        .into_iter()
        .flatten()
        .collect();
    let _ = writeln!(text, "      {}", more.join("; "));
    text
}

/// The schemes for curves and grids, and the boundary files.
fn others() -> Result<String, Failure> {
    let set = |book: &RuleBook| {
        let names: Vec<&str> = book.parameters.iter().map(|p| p.name.as_str()).collect();
        if names.is_empty() { String::new() } else { format!(", parameter {}", names.join(", ")) }
    };
    let mut text = "\nOn curves\n".to_string();
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
    text.push_str("\nOn grids\n");
    for listed in catalogue::GRIDS {
        let Some(scheme) = catalogue::grid(listed.id).transpose()? else { continue };
        let [a, b] = &scheme.factors;
        let _ = writeln!(text, "  {:<26} {} ({} x {})", scheme.id, scheme.book.title, a.scheme, b.scheme);
    }
    text.push_str("\nBoundary rules, for --boundary-rules\n");
    for listed in catalogue::BOUNDARIES {
        let Some(book) = catalogue::boundary(listed.id, "triangles").transpose()? else { continue };
        let like = book.like.as_ref().map_or(String::new(), |like| format!("; like {}", like.title));
        let _ = writeln!(text, "  {:<30}  {}{like}{}", listed.id, book.title, set(&book));
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
