//! A report as a page, as Markdown, and as tables.
//!
//! [`write()`] makes a folder of them, of one content:
//!
//! | file | holds |
//! |---|---|
//! | `index.html` | everything on one page that needs no other file |
//! | `report.md` | the same as Markdown, with `charts/` and the pictures beside |
//! | `report.json` | the [`Report`] itself |
//! | `data/*.csv` | its lists |
//! | `charts/error-cost.svg` | the first chart, to be shown elsewhere: `docs/error-cost.svg` is a copy |
//!
//! [`Report`]: crate::report::data::Report

mod budget;
mod chart;
mod check;
mod curve;
mod document;
mod frontier;
mod html;
mod label;
mod lobe;
mod map;
mod markdown;
mod measure;
#[cfg(feature = "stability")]
mod multiples;
mod number;
mod scale;
mod section;
mod sphere;
mod svg;
mod table;

use std::path::Path;

pub use chart::chart_svg;
pub use frontier::frontier;
pub use label::{Anchor, Bounds, Placed, place};
pub use lobe::{LOBE_SIGHTS, LobePlot, lobe_plots};
#[cfg(feature = "stability")]
pub use multiples::{ERROR_AXIS, ErrorLine, Series, SmallChart, small_charts};

use super::data::Report;
use crate::folder::{self, Kind, WriteError};

const KIND: Kind = Kind { name: "report", mark: "report.json" };

/// Asserts that [`write()`] would replace nothing in a folder but an older report: before the work that a report is.
///
/// # Errors
///
/// If it holds anything else.
pub fn check_folder(folder: &Path) -> Result<(), PageError> {
    Ok(folder::check_replaceable(folder, KIND)?)
}

/// A picture that a report names: its name and the bytes of its PNG file.
pub type PictureFile = (String, Vec<u8>);

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// The report contradicts itself.
    #[error("the report is not whole: {place}: {reason}")]
    Fault {
        /// Which row.
        place: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A picture that it names is not there, or is none.
    #[error("the picture {name}: {reason}")]
    Picture {
        /// Its name.
        name: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The folder is not free, or the operating system refused.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Reads the pictures that a report names from a folder.
///
/// # Errors
///
/// If one is not there or its name leads out of the folder.
pub fn read_pictures(report: &Report, folder: &Path) -> Result<Vec<PictureFile>, PageError> {
    section::picture_names(report)
        .into_iter()
        .map(|name| {
            if !check::is_picture_name(name) {
                return Err(PageError::Picture { name: name.to_owned(), reason: "it is no name".to_owned() });
            }
            let bytes = std::fs::read(folder.join(name))
                .map_err(|error| PageError::Picture { name: name.to_owned(), reason: error.to_string() })?;
            Ok((name.to_owned(), bytes))
        })
        .collect()
}

/// The files of a report: relative paths with `/` between folders, and bytes.
///
/// # Errors
///
/// If the report contradicts itself or a picture that it names is not among `pictures`.
pub fn files(
    report: &Report,
    lobes: &[LobePlot],
    pictures: &[PictureFile],
) -> Result<Vec<(String, Vec<u8>)>, PageError> {
    check::check(report)?;
    let title = "Softbox: what accuracy costs in time";
    let blocks = section::blocks(report, lobes, pictures)?;
    let (text, mut files) = markdown::text(title, &blocks);
    files.push(("report.md".to_owned(), text.into_bytes()));
    files.push(("index.html".to_owned(), html::page(title, &blocks).into_bytes()));
    files.push(("report.json".to_owned(), table::json(report)));
    files.extend(table::csv(report));
    // Pictures last, and whole: the Markdown text shows the files, not what the page holds of them.
    for name in section::picture_names(report) {
        files.retain(|(known, _)| known != name);
        files.extend(pictures.iter().find(|(known, _)| known == name).cloned());
    }
    Ok(files)
}

/// Writes a report into `folder`, in the place of an older one there, whole or not at all.
///
/// # Errors
///
/// If [`files`] refuses, the folder holds anything but a report, or the operating system refuses.
pub fn write(
    report: &Report,
    lobes: &[LobePlot],
    pictures: &[PictureFile],
    folder: &Path,
) -> Result<(), PageError> {
    Ok(folder::write(&files(report, lobes, pictures)?, folder, KIND)?)
}
