//! How do files come onto the disk whole or not at all?

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Writes a file beside its place and renames it there, so that nobody ever sees half of it.
///
/// # Errors
/// Those of the file system; the old file is then still there, and no temporary one.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let name = path.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "not a file name"))?;
    let mut beside = PathBuf::from(path);
    beside.set_file_name(format!(".{}.{}.part", name.to_string_lossy(), std::process::id()));
    let written = fs::write(&beside, bytes).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        // the write has failed already: whether the rest of it can be removed changes nothing
        let _ = fs::remove_file(&beside);
    }
    written
}
