//! Files and folders that appear whole or not at all.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// After this long nobody is still writing: what lies beside under a temporary name is left over from a run that was killed.
const STALE: Duration = Duration::from_secs(600);

/// Tells before any work is done why a file of that name cannot be written, as far as that can be seen.
///
/// # Errors
///
/// If the name is that of a folder, or of nothing, or there is no folder for it.
pub fn check_file(path: &Path) -> io::Result<()> {
    if path.is_dir() || path.file_name().is_none() {
        return Err(io::Error::other("it is a folder; name a file in it"));
    }
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            Err(io::Error::other(format!("there is no folder {}; make it first", folder.display())))
        }
        _ => Ok(()),
    }
}

/// Writes a file whole or not at all: under a temporary name in the same folder, which then becomes its own. What a link leads
/// to is written, and a device or a pipe, which cannot be replaced, as it is.
///
/// # Errors
///
/// If the operating system refuses; what was there before then still is.
pub fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    check_file(path)?;
    let path = &match fs::metadata(path) {
        Ok(there) if there.is_file() => fs::canonicalize(path)?,
        Ok(_) => return fs::OpenOptions::new().write(true).open(path)?.write_all(bytes),
        // That there is none is no reason, and any other will show again.
        Err(_) => path.to_owned(),
    };
    remove_stale(path);
    let fresh = beside(path, "new");
    let write = || {
        let mut file = File::create(&fresh)?;
        file.write_all(bytes)?;
        sync(&file)
    };
    let written = write().and_then(|()| fs::rename(&fresh, path));
    if written.is_err() {
        // What there is of it; the error that counts is the one above.
        let _ = fs::remove_file(&fresh);
    }
    written
}

/// Brings a new file down to the medium: some systems tell only then that there was no room for it.
pub(crate) fn sync(file: &File) -> io::Result<()> {
    // A medium that cannot be told to is trusted.
    match file.sync_all() {
        Err(error) if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => {
            Ok(())
        }
        synced => synced,
    }
}

/// A name beside `path` that no other process takes: `.NAME.what-PROCESS`.
pub(crate) fn beside(path: &Path, what: &str) -> PathBuf {
    let mut name = temporary(path, what);
    name.push(std::process::id().to_string());
    path.with_file_name(name)
}

fn temporary(path: &Path, what: &str) -> OsString {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{what}-"));
    name
}

/// What lies beside `path` under temporary names of that kind, whatever process gave them.
pub(crate) fn all_beside(path: &Path, what: &str) -> Vec<PathBuf> {
    let start = temporary(path, what);
    let parent = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let entries = fs::read_dir(parent).into_iter().flatten().flatten();
    let named = entries.filter(|entry| {
        let name = entry.file_name();
        let rest = name.as_encoded_bytes().strip_prefix(start.as_encoded_bytes());
        rest.is_some_and(|rest| !rest.is_empty() && rest.iter().all(u8::is_ascii_digit))
    });
    named.map(|entry| entry.path()).collect()
}

/// Removes what runs that were killed have left beside `path`. Best effort: what stays does no harm.
pub(crate) fn remove_stale(path: &Path) {
    for left in all_beside(path, "new") {
        let changed = fs::symlink_metadata(&left).and_then(|there| there.modified());
        let age = changed.ok().and_then(|changed| SystemTime::now().duration_since(changed).ok());
        if age.is_some_and(|age| age > STALE) {
            let _ = fs::remove_dir_all(&left).or_else(|_| fs::remove_file(&left));
        }
    }
}
