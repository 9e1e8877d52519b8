//! Which scheme does a name or a path mean?

use super::{Failure, failure};
use eigenring::fault::nearest;
use eigenring::refine;
use eigenring::scheme::{AnyScheme, MAX_FILE_BYTES, RuleBook, RuleSum, Scheme, catalogue};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The scheme for surfaces of a name of the catalogue, or of a file, with its parameters set.
pub(crate) fn open(name: &str, settings: &[String]) -> Result<Scheme, Failure> {
    match open_any(name, settings)? {
        AnyScheme::Surface(scheme) => Ok(*scheme),
        other => {
            let kind = if matches!(other, AnyScheme::Grid(_)) { "grids" } else { "curves" };
            let title = &other.book().title;
            Err(failure(format!("{title} is a scheme for {kind}; this command takes schemes for surfaces")))
        }
    }
}

/// The scheme of a name of the catalogue, or of a file, of whatever kind, with its parameters set.
pub(crate) fn open_any(name: &str, settings: &[String]) -> Result<AnyScheme, Failure> {
    let mut scheme = match catalogue::any(name) {
        Some(scheme) => scheme?,
        None => AnyScheme::parse(&short_name(name), name, &read(name)?)?,
    };
    let mut set: Vec<&str> = Vec::new();
    for setting in settings {
        let (parameter, value) = setting
            .split_once('=')
            .ok_or_else(|| failure(format!("--set takes name=value, for example --set w=1/32, not `{setting}`")))?;
        if set.contains(&parameter.trim()) {
            return Err(failure(format!("`{}` is set twice", parameter.trim())));
        }
        set.push(parameter.trim());
        scheme.set(parameter.trim(), value.trim()).map_err(failure)?;
    }
    Ok(scheme)
}

/// The rules of the first boundary file that a scheme names.
pub(crate) fn boundary_of(scheme: &Scheme) -> Result<Option<RuleBook>, Failure> {
    let Some(name) = scheme.boundary.first() else { return Ok(None) };
    let book = catalogue::boundary(name, &scheme.mesh);
    let unknown = || failure(format!("{}: there is no boundary file `{name}`", scheme.book.title));
    Ok(Some(book.ok_or_else(unknown)??))
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
