//! Files that appear whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::Package;

/// Why a package could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The folder holds something else.
    #[error("{} is not empty and holds no package that could be replaced; name another folder, or empty it", .0.display())]
    Occupied(PathBuf),
    /// The operating system refused.
    #[error("cannot write {}: {source}", path.display())]
    Refused {
        /// What could not be written.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// The file by which a folder is known to hold a package.
const MARK: &str = "wgsl/ltc.wgsl";

/// Writes a package into `folder`, in the place of an older package there.
///
/// The files are written into a new folder beside it, which then takes its name. Until that moment an
/// older package is left as it is.
///
/// # Errors
///
/// If the folder holds anything but a package, or the operating system refuses.
pub fn write_folder(package: &Package, folder: &Path) -> Result<(), WriteError> {
    let refused = |path: &Path| {
        let path = path.to_owned();
        move |source| WriteError::Refused { path, source }
    };
    let occupied = match fs::read_dir(folder) {
        Ok(mut entries) => entries.next().is_some(),
        Err(error) if error.kind() == io::ErrorKind::NotFound => false,
        Err(error) => return Err(refused(folder)(error)),
    };
    if occupied && !folder.join(MARK).is_file() {
        return Err(WriteError::Occupied(folder.to_owned()));
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
        if folder.exists() {
            fs::rename(folder, &old).map_err(refused(folder))?;
        }
        fs::rename(&fresh, folder).map_err(|error| {
            // Best effort: the older package back to its place.
            let _ = fs::rename(&old, folder);
            refused(folder)(error)
        })
    });
    // What is left of a failed attempt, or the replaced package.
    let _ = fs::remove_dir_all(&fresh);
    let _ = fs::remove_dir_all(&old);
    written
}

fn write_files(package: &Package, folder: &Path) -> Result<(), WriteError> {
    for (path, bytes) in &package.files {
        let path = folder.join(path);
        let refused = |source| WriteError::Refused { path: path.clone(), source };
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(refused)?;
        }
        fs::write(&path, bytes).map_err(refused)?;
    }
    Ok(())
}
