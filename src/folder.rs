//! Folders whose files appear whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

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
    let replaces = folder.exists();
    check_replaceable(folder, kind)?;
    let parent = match folder.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(parent).map_err(refused(parent))?;
    let name =
        folder.file_name().map_or_else(|| kind.name.into(), |name| name.to_string_lossy().into_owned());
    let beside = |what: &str| parent.join(format!(".{name}.{what}-{}", std::process::id()));
    let (fresh, old) = (beside("new"), beside("old"));
    let written = write_files(files, &fresh).and_then(|()| {
        if replaces {
            fs::rename(folder, &old).map_err(refused(folder))?;
        }
        fs::rename(&fresh, folder).map_err(|error| {
            // Best effort: the older folder back to its place; if that fails it stays beside it.
            let _ = fs::rename(&old, folder);
            refused(folder)(error)
        })
    });
    if written.is_ok() {
        // The new folder is there; what is left of the old one does no harm.
        let _ = fs::remove_dir_all(&old);
    } else {
        let _ = fs::remove_dir_all(&fresh);
    }
    written
}

/// Asserts that every file in `folder` is one that a folder of that kind has.
pub fn check_replaceable(folder: &Path, kind: Kind) -> Result<(), WriteError> {
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

fn write_files(files: &[(String, Vec<u8>)], folder: &Path) -> Result<(), WriteError> {
    let mut names: Vec<&str> = files.iter().map(|(path, _)| path.as_str()).chain([MANIFEST]).collect();
    names.sort_unstable();
    names.dedup();
    let manifest: String = names.iter().map(|name| format!("{name}\n")).collect();
    let files = files.iter().map(|(path, bytes)| (path.as_str(), bytes.as_slice()));
    let files = files.filter(|(path, _)| *path != MANIFEST).chain([(MANIFEST, manifest.as_bytes())]);
    for (path, bytes) in files {
        let path = folder.join(path);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(refused(parent))?;
        }
        fs::write(&path, bytes).map_err(refused(&path))?;
    }
    Ok(())
}
