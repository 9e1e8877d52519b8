//! How do files come onto the disk whole or not at all?

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Writes a file beside its place and renames it there, so that nobody ever sees half of it.
///
/// # Errors
/// Those of the file system; the old file is then still there, and no temporary one.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_all_whole(&[(path.to_path_buf(), bytes)]).map_err(|(_, error)| error)
}

/// Writes a file piece by piece beside its place, and renames it there when `fill` is done.
///
/// # Errors
/// Those of the file system and of `fill`; the old file is then still there, and no temporary one.
pub fn write_in_pieces<R>(path: &Path, fill: impl FnOnce(&mut BufWriter<fs::File>) -> io::Result<R>) -> io::Result<R> {
    let beside = beside(path)?;
    let write = || {
        let mut file = BufWriter::with_capacity(1 << 20, fs::File::create(&beside)?);
        let result = fill(&mut file)?;
        file.flush()?;
        fs::rename(&beside, path)?;
        Ok(result)
    };
    write().inspect_err(|_| fs::remove_file(&beside).unwrap_or_default())
}

/// Writes files beside their places, and renames them there when all are written.
///
/// # Errors
/// The first file that can't be written, and why; no other file is then changed, unless a rename fails half-way.
pub fn write_all_whole(files: &[(PathBuf, &[u8])]) -> Result<(), (PathBuf, io::Error)> {
    let mut staged: Vec<(PathBuf, &PathBuf)> = Vec::new();
    let staging = files.iter().try_for_each(|(path, bytes)| {
        let beside = beside(path).map_err(|error| (path.clone(), error))?;
        staged.push((beside.clone(), path));
        fs::write(beside, bytes).map_err(|error| (path.clone(), error))
    });
    let renamed = staging.and_then(|()| {
        staged.iter().try_for_each(|(beside, path)| fs::rename(beside, path).map_err(|error| ((*path).clone(), error)))
    });
    if renamed.is_err() {
        // the writing has failed already: whether the rest of it can be removed changes nothing
        staged.iter().for_each(|(beside, _)| fs::remove_file(beside).unwrap_or_default());
    }
    renamed
}

/// The name of a file while it is being written.
fn beside(path: &Path) -> io::Result<PathBuf> {
    if path.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "there is a directory of this name"));
    }
    let name = path.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "not a file name"))?;
    let mut beside = PathBuf::from(path);
    beside.set_file_name(format!(".{}.{}.part", name.to_string_lossy(), std::process::id()));
    Ok(beside)
}
