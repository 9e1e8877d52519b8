//! Which scheme does a name or a path mean?

use super::analyze::explain;
use super::refine::refused;
use super::{Failure, failure};
use clap::Args;
use eigenring::analysis::boundary::flatness;
use eigenring::fault::nearest;
use eigenring::mesh::FanKind;
use eigenring::refine::{self, Refiner};
use eigenring::report::boundary::Variant;
use eigenring::scheme::{AnyScheme, MAX_FILE_BYTES, RuleBook, RuleSum, Scheme, catalogue};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The scheme for surfaces of a name of the catalogue, or of a file, with its parameters set.
pub(crate) fn open(name: &str, settings: &[String]) -> Result<Scheme, Failure> {
    Ok(open_with_rules(name, settings, None)?.0)
}

/// The same with the boundary files asked for.
pub(crate) fn open_with_rules(
    name: &str,
    settings: &[String],
    rules: Option<&BoundaryRules>,
) -> Result<(Scheme, Vec<Variant>), Failure> {
    let (scheme, variants) = open_any(name, settings, rules)?;
    match scheme {
        AnyScheme::Surface(scheme) => Ok((*scheme, variants)),
        other => {
            let kind = if matches!(other, AnyScheme::Grid(_)) { "grids" } else { "curves" };
            let title = &other.book().title;
            Err(failure(format!("{title} is a scheme for {kind}; this command takes schemes for surfaces")))
        }
    }
}

/// A scheme of whatever kind, and the boundary files to be taken with it: those asked for, `all` that it names, or its first. Parameters are
/// those of the scheme or of these files.
pub(crate) fn open_any(
    name: &str,
    settings: &[String],
    rules: Option<&BoundaryRules>,
) -> Result<(AnyScheme, Vec<Variant>), Failure> {
    let mut scheme = match catalogue::any(name) {
        Some(scheme) => scheme?,
        None => AnyScheme::parse(&short_name(name), name, &read(name)?)?,
    };
    let mut variants = match (&scheme, rules) {
        (AnyScheme::Surface(scheme), Some(rules)) => rules.open(scheme)?,
        _ => vec![],
    };
    let mut set: Vec<&str> = Vec::new();
    for setting in settings {
        let (parameter, value) = setting
            .split_once('=')
            .ok_or_else(|| failure(format!("--set takes name=value, for example --set w=1/32, not `{setting}`")))?;
        let (parameter, value) = (parameter.trim(), value.trim());
        if set.contains(&parameter) {
            return Err(failure(format!("`{parameter}` is set twice")));
        }
        set.push(parameter);
        let knows = |book: &RuleBook| book.has_parameter(parameter);
        let mut books: Vec<&mut RuleBook> =
            variants.iter_mut().map(|variant| &mut variant.book).filter(|book| knows(book)).collect();
        if knows(scheme.book()) || books.is_empty() {
            scheme.set(parameter, value).map_err(failure)?;
        }
        books.iter_mut().try_for_each(|book| book.set(parameter, value)).map_err(failure)?;
    }
    Ok((scheme, variants))
}

/// Which boundary files are asked for.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct BoundaryRules {
    /// The boundary file whose rules are taken: a name such as cubic, the path of a file, several with commas, all, or none [default: the first that the scheme names]
    #[arg(long = "boundary-rules", value_name = "RULES", value_delimiter = ',')]
    asked: Vec<String>,
}

impl BoundaryRules {
    /// Whether none are asked for.
    pub(crate) fn are_none(&self) -> bool {
        self.asked == ["none"]
    }

    /// Those asked for, `none` being none; the scheme's first where nothing is asked for, and none where it names none.
    fn open(&self, scheme: &Scheme) -> Result<Vec<Variant>, Failure> {
        match self.asked.iter().map(String::as_str).collect::<Vec<_>>()[..] {
            [] => scheme.boundary.first().map(|name| variant(scheme, name)).into_iter().collect(),
            ["none"] => Ok(vec![]),
            ["all"] => scheme.boundary.iter().map(|name| variant(scheme, name)).collect(),
            ref names => names.iter().map(|name| variant(scheme, name.trim())).collect(),
        }
    }
}

/// The boundary file of a name or a path.
fn variant(scheme: &Scheme, name: &str) -> Result<Variant, Failure> {
    let book = match catalogue::boundary(name, &scheme.mesh) {
        Some(book) => book?,
        None if Path::new(name).exists() => RuleBook::parse_boundary(name, &read(name)?, &scheme.mesh)?,
        None => {
            let known: Vec<&str> = catalogue::BOUNDARIES.iter().map(|listed| listed.id).collect();
            let known = known.join(", ");
            return Err(failure(format!(
                "there is no boundary file `{name}`\n  help: the boundary files are {known}; one of your own is given by its path"
            )));
        }
    };
    Ok(Variant { name: if Path::new(name).exists() { short_name(name) } else { name.to_string() }, book })
}

/// The only boundary file of a list, which may be none.
pub(crate) fn only(variants: Vec<Variant>) -> Result<Option<RuleBook>, Failure> {
    let mut books = variants.into_iter().map(|variant| variant.book);
    match (books.next(), books.next()) {
        (book, None) => Ok(book),
        _ => Err(failure("a mesh is refined by one boundary file: give one name with --boundary-rules")),
    }
}

/// A scheme with boundary rules, ready to refine meshes with these kinds of vertices on boundaries and creases.
pub(crate) fn refiner<'a>(
    scheme: &'a Scheme,
    book: Option<&'a RuleBook>,
    kinds: impl IntoIterator<Item = FanKind>,
) -> Result<Refiner<'a>, Failure> {
    let refiner = Refiner::new(scheme, book).map_err(|wrong| refused(scheme, wrong))?;
    let Some(book) = book else { return Ok(refiner) };
    let flatness = flatness::of(scheme, book, kinds).map_err(|obstacle| explain(scheme, obstacle))?;
    Ok(refiner.with_flatness(flatness))
}

/// Opens a scheme and checks it at the valences asked for.
pub(crate) fn open_checked(
    name: &str,
    settings: &[String],
    valences: &[usize],
) -> Result<(Scheme, Vec<RuleSum>), Failure> {
    let scheme = open(name, settings)?;
    let sums = refine::check(&scheme, valences)?;
    Ok((scheme, sums))
}

/// The file's name without its ending, in letters that every file system takes.
fn short_name(path: &str) -> String {
    let stem = Path::new(path).file_stem().map_or("scheme".into(), |stem| stem.to_string_lossy());
    let safe = |c: char| if c.is_alphanumeric() || c == '_' || c == '-' { c } else { '-' };
    let name: String = stem.chars().take(100).map(safe).collect();
    if name.is_empty() { "scheme".to_string() } else { name }
}

/// The text of the file of a scheme, of the catalogue or of a path.
pub(crate) fn text(name: &str) -> Result<String, Failure> {
    match catalogue::all().find(|listed| listed.id == name) {
        Some(listed) => Ok(listed.text.to_string()),
        None => read(name),
    }
}

fn read(name: &str) -> Result<String, Failure> {
    let path = Path::new(name);
    if path.is_dir() {
        return Err(failure(format!("`{name}` is a directory; a scheme file is needed")));
    }
    if path.metadata().is_ok_and(|metadata| !metadata.is_file()) {
        return Err(failure(format!("`{name}` is not a file but a pipe or a device; a scheme file is needed")));
    }
    let file = File::open(path).map_err(|error| not_opened(name, &error))?;
    let mut bytes = Vec::new();
    let limit = MAX_FILE_BYTES as u64 + 1;
    file.take(limit).read_to_end(&mut bytes).map_err(|error| failure(format!("`{name}` can't be read: {error}")))?;
    if bytes.len() > MAX_FILE_BYTES {
        return Err(failure(format!("`{name}` is larger than {MAX_FILE_BYTES} bytes, the limit for a scheme file")));
    }
    if bytes.is_empty() {
        return Err(failure(format!("`{name}` is empty; start a scheme file with `eigenring new NAME --like loop`")));
    }
    String::from_utf8(bytes).map_err(|error| {
        let place = error.utf8_error().valid_up_to();
        failure(format!("`{name}` is not text in UTF-8: byte {place} does not belong there"))
    })
}

fn not_opened(name: &str, error: &std::io::Error) -> Failure {
    if error.kind() != std::io::ErrorKind::NotFound {
        return failure(format!("`{name}` can't be opened: {error}"));
    }
    let known: Vec<&str> = catalogue::all().map(|listed| listed.id).collect();
    let hint = match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("the schemes are {}; a file is given by its path", known.join(", ")),
    };
    failure(format!("there is no scheme and no file `{name}`\n  help: {hint}"))
}
