//! Files that appear whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::{MANIFEST, Package};

/// Why a package could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The folder holds something that no package put there.
    #[error("{} holds {}, which is no part of a package; name another folder, or move it away", folder.display(), foreign.display())]
    Occupied {
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

/// Writes a package into `folder`, in the place of an older package there.
///
/// The files are written into a new folder beside it, which then takes its name. Until that moment an
/// older package is left as it is, and nothing is ever removed that its [`MANIFEST`] does not name.
///
/// # Errors
///
/// If the folder holds anything but a package, or the operating system refuses.
pub fn write_folder(package: &Package, folder: &Path) -> Result<(), WriteError> {
    let replaces = folder.exists();
    if replaces {
        check_replaceable(folder)?;
    }
    let parent = match folder.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(parent).map_err(refused(parent))?;
    let name =
        folder.file_name().map_or_else(|| "package".into(), |name| name.to_string_lossy().into_owned());
    let beside = |what: &str| parent.join(format!(".{name}.{what}-{}", std::process::id()));
    let (fresh, old) = (beside("new"), beside("old"));
    let written = write_files(package, &fresh).and_then(|()| {
        if replaces {
            fs::rename(folder, &old).map_err(refused(folder))?;
        }
        fs::rename(&fresh, folder).map_err(|error| {
            // Best effort: the older package back to its place; if that fails it stays beside it.
            let _ = fs::rename(&old, folder);
            refused(folder)(error)
        })
    });
    if written.is_ok() {
        // The new package is there; what is left of the old one does no harm.
        let _ = fs::remove_dir_all(&old);
    } else {
        let _ = fs::remove_dir_all(&fresh);
    }
    written
}

/// Asserts that every file in `folder` is one that a package put there.
fn check_replaceable(folder: &Path) -> Result<(), WriteError> {
    let manifest = fs::read_to_string(folder.join(MANIFEST)).unwrap_or_default();
    let known: Vec<&Path> = manifest.lines().map(Path::new).collect();
    let mut pending = vec![folder.to_owned()];
    while let Some(directory) = pending.pop() {
        for entry in fs::read_dir(&directory).map_err(refused(&directory))? {
            let path = entry.map_err(refused(&directory))?.path();
            let relative = path.strip_prefix(folder).unwrap_or(&path);
            let part = known.iter().any(|known| *known == relative || known.starts_with(relative));
            if !part {
                return Err(WriteError::Occupied { folder: folder.to_owned(), foreign: relative.to_owned() });
            }
            // A link is one entry, whatever it leads to.
            if path.is_dir() && !path.is_symlink() {
                pending.push(path);
            }
        }
    }
    Ok(())
}

fn write_files(package: &Package, folder: &Path) -> Result<(), WriteError> {
    for (path, bytes) in &package.files {
        let path = folder.join(path);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(refused(parent))?;
        }
        fs::write(&path, bytes).map_err(refused(&path))?;
    }
    Ok(())
}
