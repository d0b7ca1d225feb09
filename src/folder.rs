//! Folders whose files appear whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::output;

/// The file of a written folder that names all its files, itself included, a line each.
pub const MANIFEST: &str = "MANIFEST";

/// What a folder holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kind {
    /// What messages call it.
    pub name: &'static str,
    /// A file that every folder of this kind has, which tells it from those of other kinds.
    pub mark: &'static str,
}

/// Why a folder could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// It holds something that nothing of its kind put there.
    #[error("{} holds {}, which is no part of a {kind}; name another folder, or move it away", folder.display(), foreign.display())]
    Occupied {
        /// What was to be written.
        kind: &'static str,
        /// The folder.
        folder: PathBuf,
        /// What is in it, relative to the folder.
        foreign: PathBuf,
    },
    /// The operating system refused.
    #[error("cannot write {}: {reason}", path.display())]
    Refused {
        /// What could not be written.
        path: PathBuf,
        /// Why.
        reason: io::Error,
    },
}

fn refused(path: &Path) -> impl FnOnce(io::Error) -> WriteError + use<> {
    let path = path.to_owned();
    move |reason| WriteError::Refused { path, reason }
}

/// Writes files (relative path with `/` between folders, and bytes) and their [`MANIFEST`] into `folder`, in the place of
/// an older folder of that kind.
///
/// The files are written into a new folder beside it, which then takes its name. Until that moment an
/// older one is left as it is, and nothing is ever removed that its manifest does not name.
///
/// # Errors
///
/// If the folder holds anything but what is of that kind, or the operating system refuses.
pub fn write(files: &[(String, Vec<u8>)], folder: &Path, kind: Kind) -> Result<(), WriteError> {
    check_replaceable(folder, kind)?;
    // The folder itself and not a link to it takes part in the exchange. A name like `.` has no place beside it.
    let folder = &match folder.file_name() {
        Some(_) if folder.exists() => fs::canonicalize(folder).map_err(refused(folder))?,
        Some(_) => folder.to_owned(),
        None => {
            let reason = io::Error::new(
                io::ErrorKind::InvalidInput,
                "it has no name of its own; name the folder itself",
            );
            return Err(refused(folder)(reason));
        }
    };
    let parent = match folder.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(parent).map_err(refused(parent))?;
    output::remove_stale(folder);
    let fresh = output::beside(folder, "new");
    // Left by another process of that number.
    let _ = fs::remove_dir_all(&fresh);
    let written = write_files(files, &fresh).and_then(|()| replace(&fresh, folder).map_err(refused(folder)));
    let written = written.map_err(|error| named(error, &fresh, folder));
    // The new folder that was not to be, or the old one that no longer is; what is left of it does no harm.
    let _ = fs::remove_dir_all(&fresh);
    written
}

/// The error with the names that files were to have, not those that they had for the time being.
fn named(error: WriteError, fresh: &Path, folder: &Path) -> WriteError {
    match error {
        WriteError::Refused { path, reason } => match path.strip_prefix(fresh) {
            Ok(rest) if rest == Path::new("") => WriteError::Refused { path: folder.to_owned(), reason },
            Ok(rest) => WriteError::Refused { path: folder.join(rest), reason },
            Err(_) => WriteError::Refused { path, reason },
        },
        WriteError::Occupied { .. } => error,
    }
}

/// Gives `folder` what is in `fresh`, which gets what was in `folder`: at every moment there is one of the two.
#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
fn replace(fresh: &Path, folder: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    if !folder.exists() {
        return fs::rename(fresh, folder);
    }
    match renameat_with(CWD, fresh, CWD, folder, RenameFlags::EXCHANGE) {
        // A file system that cannot.
        Err(rustix::io::Errno::INVAL | rustix::io::Errno::NOSYS | rustix::io::Errno::NOTSUP) => {
            replace_in_steps(fresh, folder)
        }
        exchanged => Ok(exchanged?),
    }
}

#[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
use replace_in_steps as replace;

/// The same where two names cannot be exchanged at once: for a moment the old folder lies beside.
fn replace_in_steps(fresh: &Path, folder: &Path) -> io::Result<()> {
    let old = output::beside(folder, "old");
    if !folder.exists() {
        return fs::rename(fresh, folder);
    }
    fs::rename(folder, &old)?;
    if let Err(error) = fs::rename(fresh, folder) {
        // Best effort: the older folder back to its place; if that fails it stays beside it.
        let _ = fs::rename(&old, folder);
        return Err(error);
    }
    fs::rename(&old, fresh)
}

/// Asserts that every file in `folder` is one that a folder of that kind has.
pub fn check_replaceable(folder: &Path, kind: Kind) -> Result<(), WriteError> {
    restore(folder);
    if !folder.exists() {
        return Ok(());
    }
    let manifest = fs::read_to_string(folder.join(MANIFEST)).unwrap_or_default();
    let mut known: Vec<&Path> = manifest.lines().map(Path::new).collect();
    if !known.contains(&Path::new(kind.mark)) {
        known.clear();
    }
    let mut pending = vec![folder.to_owned()];
    while let Some(directory) = pending.pop() {
        for entry in fs::read_dir(&directory).map_err(refused(&directory))? {
            let path = entry.map_err(refused(&directory))?.path();
            let relative = path.strip_prefix(folder).unwrap_or(&path);
            let part = known.iter().any(|known| *known == relative || known.starts_with(relative));
            if !part {
                return Err(WriteError::Occupied {
                    kind: kind.name,
                    folder: folder.to_owned(),
                    foreign: relative.to_owned(),
                });
            }
            // A link is one entry, whatever it leads to.
            if path.is_dir() && !path.is_symlink() {
                pending.push(path);
            }
        }
    }
    Ok(())
}

/// Gives an older folder its name back, if a process was killed in the middle of [`replace_in_steps`].
fn restore(folder: &Path) {
    if let [old] = &output::all_beside(folder, "old")[..]
        && folder.symlink_metadata().is_err()
    {
        // Best effort: if it stays beside, there is none to replace.
        let _ = fs::rename(old, folder);
    }
}

fn write_files(files: &[(String, Vec<u8>)], folder: &Path) -> Result<(), WriteError> {
    let mut names: Vec<&str> = files.iter().map(|(path, _)| path.as_str()).chain([MANIFEST]).collect();
    names.sort_unstable();
    names.dedup();
    let manifest: String = names.iter().map(|name| format!("{name}\n")).collect();
    let files = files.iter().map(|(path, bytes)| (path.as_str(), bytes.as_slice()));
    let files = files.filter(|(path, _)| *path != MANIFEST).chain([(MANIFEST, manifest.as_bytes())]);
    let mut written = Vec::new();
    for (path, bytes) in files {
        let path = folder.join(path);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(refused(parent))?;
        }
        let mut file = File::create(&path).map_err(refused(&path))?;
        file.write_all(bytes).map_err(refused(&path))?;
        written.push((path, file));
    }
    // All after all are written, which takes a fraction of the time of one by one.
    written.iter().try_for_each(|(path, file)| output::sync(file).map_err(refused(path)))
}
