//! The drop-in package: the include in every language, the tables in every format, a guide.

mod guide;

use std::path::Path;

use glam::DVec3;

use crate::effects::{self, Effect, Effects, EffectsError};
use crate::fit::{self, Family, Layout, Settings};
use crate::folder;
use crate::report::{self, Accuracy, REGIONS, Technique};
use crate::table::{Container, ContainerError, Layer, Table};
use crate::translate::{self, Target, TranslateError};

pub use crate::folder::{MANIFEST, WriteError};

/// What to put into a package.
#[derive(Clone, Debug, PartialEq)]
pub struct Contents {
    /// Texels along each axis of the tables.
    pub table_size: usize,
    /// Formats of the table files.
    pub containers: Vec<Container>,
    /// Languages of the include; WGSL is always there.
    pub targets: Vec<Target>,
    /// Whether to bake the table for code that implements the published technique, too.
    pub compatible: bool,
    /// What the shaders can do and which layers the table has; the whole include, with its switches, and a table for
    /// each of two uses where nothing is chosen.
    pub effects: Option<Effects>,
    /// Quads of each region on which the tables are measured; 0 for no measurement.
    pub quads: usize,
}

impl Default for Contents {
    fn default() -> Self {
        Self {
            table_size: crate::TABLE_SIZE,
            containers: Container::ALL.to_vec(),
            targets: Target::ALL.to_vec(),
            compatible: true,
            effects: None,
            quads: 200,
        }
    }
}

/// The accuracy of a table, in all and by region.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// On all quads.
    pub all: Accuracy,
    /// In each of [`REGIONS`].
    pub regions: Vec<Accuracy>,
}

/// A package in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Package {
    /// Relative path with `/` between folders, and bytes.
    pub files: Vec<(String, Vec<u8>)>,
    /// Accuracy of the include with its table.
    pub native: Option<Measured>,
    /// Accuracy of the published technique with the compatible table.
    pub compatible: Option<Measured>,
}

/// Why a package could not be made.
#[derive(Debug, thiserror::Error)]
pub enum PackageError {
    /// The include could not be translated.
    #[error(transparent)]
    Translate(#[from] TranslateError),
    /// A table could not be written in its format.
    #[error(transparent)]
    Container(#[from] ContainerError),
    /// The include lacks an effect.
    #[error(transparent)]
    Effects(#[from] EffectsError),
    /// A closed form for a model that it is not of.
    #[error(
        "the set \"{effects}\" has a closed form in place of the table, which is that of GGX with height-correlated masking; leave table-free out or bake that model"
    )]
    TableFree {
        /// The set.
        effects: Effects,
    },
    /// Anisotropic surfaces in a table that cannot have them.
    #[error(
        "the set \"{effects}\" has anisotropic surfaces, whose layers have {} texels along each axis, not {size}; leave the table's size at that or anisotropic out",
        crate::TABLE_SIZE
    )]
    Anisotropic {
        /// The set.
        effects: Effects,
        /// Texels along each axis that were asked for.
        size: usize,
    },
}

/// A step of [`build`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A table is baked.
    Bake(Layout),
    /// A table is measured.
    Measure(Layout),
    /// The include is translated.
    Translate,
}

/// Makes a package: bakes the tables of a reflectance model, measures them, translates the include.
///
/// `progress` is told each step and the share of it done, 0…1, from any thread.
///
/// # Errors
///
/// If the include is broken or a format refuses a table.
pub fn build(
    family: &dyn Family,
    contents: &Contents,
    progress: &(dyn Fn(Step, f64) + Sync),
) -> Result<Package, PackageError> {
    let mut package = Package { files: Vec::new(), native: None, compatible: None };
    let size = contents.table_size;
    let mut tables = vec![(Settings::native(size), Technique::Include, "ltc")];
    if contents.compatible {
        tables.push((Settings::compatible(size), Technique::Published, "ltc_compatible"));
    }
    for (settings, technique, name) in tables {
        let layout = settings.layout;
        let fitted = fit::bake(family, settings, &|share| progress(Step::Bake(layout), share));
        let table = Table::pack(&fitted);
        let mut written = vec![(name.to_owned(), table.clone())];
        if technique == Technique::Include {
            match contents.effects {
                Some(effects) => written[0].1 = with_layers(table.clone(), family, effects, progress)?,
                None if size == crate::TABLE_SIZE => {
                    written.push((
                        format!("{name}_all"),
                        with_layers(table.clone(), family, Effects::standing(), progress)?,
                    ));
                    written.push((format!("{name}_two_lobes"), Table::two_lobes()));
                    written.push((format!("{name}_three_lobes"), Table::three_lobes()));
                }
                None => {}
            }
        }
        for (name, table) in &written {
            for container in &contents.containers {
                let path = format!("table/{name}.{}", container.extension());
                package.files.push((path, container.write(table)?));
            }
        }
        if contents.quads > 0 {
            let effects = contents.effects.unwrap_or_else(Effects::standing);
            let (table, technique) = match technique {
                Technique::Include
                    if effects.has_lobe() && !effects.layers().is_empty() && contents.effects.is_some() =>
                {
                    (written[0].1.clone(), Technique::With(effects))
                }
                Technique::Include => (table, Technique::With(effects)),
                Technique::With(_) => (table, technique),
                Technique::Published => (table, technique),
            };
            let measured = measure(&table, technique, family, contents.quads, &|share| {
                progress(Step::Measure(layout), share);
            });
            match technique {
                Technique::Include | Technique::With(_) => package.native = Some(measured),
                Technique::Published => package.compatible = Some(measured),
            }
        }
    }
    let mut text = |path: &str, text: String| package.files.push((path.to_owned(), text.into_bytes()));
    let include = match contents.effects {
        Some(effects) => effects::wgsl(effects)?,
        None => crate::WGSL_INCLUDE.to_owned(),
    };
    text("wgsl/ltc.wgsl", include);
    if contents.effects.is_none() {
        text("wgsl/evaluate.wgsl", crate::WGSL_EVALUATE.to_owned());
    }
    for (index, target) in contents.targets.iter().enumerate() {
        let translated = match contents.effects {
            Some(effects) => translate::include_for(*target, effects)?,
            None => translate::include(*target)?,
        };
        text(target.path(), translated);
        progress(Step::Translate, (index + 1) as f64 / contents.targets.len() as f64);
    }
    text("LICENSE-MIT", include_str!("../../LICENSE-MIT").to_owned());
    text("LICENSE-APACHE", include_str!("../../LICENSE-APACHE").to_owned());
    let kernel = match contents.effects {
        Some(effects) => {
            let source = format!("{}\n{}", crate::WGSL_INCLUDE, crate::WGSL_EVALUATE);
            translate::kernel_spirv(&source, "evaluate", effects)?
        }
        None => translate::spirv()?,
    };
    package.files.push((translate::SPIRV_PATH.to_owned(), kernel));
    package.files.push(("README.md".to_owned(), guide::guide(contents, &package).into_bytes()));
    package.files.push((MANIFEST.to_owned(), Vec::new()));
    package.files.sort();
    let names: String = package.files.iter().map(|(path, _)| format!("{path}\n")).collect();
    for (path, bytes) in &mut package.files {
        if path == MANIFEST {
            *bytes = names.clone().into_bytes();
        }
    }
    Ok(package)
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
    let kind = folder::Kind { name: "package", mark: "wgsl/ltc.wgsl" };
    folder::write(&package.files, folder, kind)
}

/// A table with the further layers that `effects` need. Those of the embedded size are embedded, too.
fn with_layers(
    mut table: Table,
    family: &dyn Family,
    effects: Effects,
    progress: &(dyn Fn(Step, f64) + Sync),
) -> Result<Table, PackageError> {
    let (size, layers) = (table.size(), effects.layers());
    if effects.contains(Effect::TableFree) && !is_default(family) {
        return Err(PackageError::TableFree { effects });
    }
    if effects.contains(Effect::SecondLobe) && !(size == crate::TABLE_SIZE && is_default(family)) {
        let count = if effects.contains(Effect::ThirdLobe) { 3 } else { 2 };
        let lobes =
            fit::bake_lobes(family, count, size, &|share| progress(Step::Bake(Layout::Native), share));
        table = table.with(&Table::pack_lobes(&lobes));
    }
    let only = |table: Table| if layers.is_empty() { table } else { table.only(&layers) };
    if size == crate::TABLE_SIZE {
        return Ok(only(table.completed(&layers)));
    }
    if layers.contains(&Layer::AnisotropicFirst) {
        return Err(PackageError::Anisotropic { effects, size });
    }
    let bake = |settings: Settings, family: &dyn Family| {
        let layout = settings.layout;
        Table::pack(&fit::bake(family, settings, &|share| progress(Step::Bake(layout), share)))
    };
    Ok(only(layers.iter().fold(table, |table, layer| match layer {
        Layer::Sheen => table.with(&bake(Settings::sheen(size), &fit::sheen)),
        Layer::Diffuse => table.with(&bake(Settings::diffuse(size), &fit::diffuse)),
        _ => table,
    })))
}

/// Whether a family is GGX with height-correlated Smith masking, which the embedded lobes and the closed form are of.
fn is_default(family: &dyn Family) -> bool {
    let directions = [DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.48, 0.6, 0.64), DVec3::new(0.0, -0.96, 0.28)];
    [0.2, 0.5, 0.9].iter().all(|roughness| {
        let (own, ggx) = (family.at(*roughness), fit::ggx(*roughness));
        directions.iter().all(|view| {
            directions.iter().all(|light| own.evaluate(*view, *light) == ggx.evaluate(*view, *light))
        })
    })
}

/// Measures a table in every region.
pub fn measure(
    table: &Table,
    technique: Technique,
    family: &dyn Family,
    quads: usize,
    progress: &dyn Fn(f64),
) -> Measured {
    let mut all = Vec::new();
    let regions = REGIONS
        .iter()
        .enumerate()
        .map(|(index, region)| {
            let random = report::random_quads(*region, quads);
            let accuracy = report::accuracy(table, technique, family, &random);
            all.extend(random);
            progress(index as f64 / REGIONS.len() as f64);
            accuracy
        })
        .collect();
    let all = report::accuracy(table, technique, family, &all);
    progress(1.0);
    Measured { all, regions }
}
