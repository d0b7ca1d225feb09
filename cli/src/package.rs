//! `softbox build`.

use std::path::PathBuf;
use std::sync::Mutex;
use std::time::Instant;

use anyhow::Context;
use clap::Args;
use softbox::effects::{Effects, Quality};
use softbox::fit::Layout;
use softbox::package::{self, Contents, Step};
use softbox::scene::Scene;

use crate::bake::{TABLE_SIZES, print_row, write_file};
use crate::model::ModelArguments;
use crate::progress;
use crate::say::say;

#[derive(Args)]
pub struct BuildArguments {
    /// Folder of the package; an older package there is replaced.
    #[arg(long, default_value = "softbox-package", value_name = "DIR")]
    out: PathBuf,
    /// Texels along each axis of the tables, 2 to 1024.
    #[arg(long, default_value = "64", value_name = "N", value_parser = TABLE_SIZES, allow_negative_numbers = true)]
    table_size: u32,
    #[command(flatten)]
    model: ModelArguments,
    /// What the shaders can do, such as quad,disk+ggx,clearcoat+two-sided: the package then holds that part of the
    /// include, and a table with the layers that it needs. `softbox select --list` names all effects.
    #[arg(long, value_name = "SET", conflicts_with = "update")]
    effects: Option<String>,
    /// A scene file: the package holds what it calls for.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["effects", "update"])]
    scene: Option<PathBuf>,
    /// Quality level of the package: fast, standard, fine or finest; of the whole include where no effects are given.
    #[arg(long, value_name = "LEVEL", conflicts_with = "update")]
    quality: Option<Quality>,
    /// Write the translations and raw tables over those of a repository instead of a package.
    #[arg(long, value_name = "REPOSITORY", conflicts_with = "out")]
    update: Option<PathBuf>,
}

pub fn build(arguments: &BuildArguments) -> anyhow::Result<()> {
    let started = Instant::now();
    if let Some(repository) = &arguments.update {
        anyhow::ensure!(
            repository.join("wgsl/ltc.wgsl").is_file(),
            "{} is no repository of this library, as it has no wgsl/ltc.wgsl; name its root",
            repository.display()
        );
    }
    let family = arguments.model.family()?;
    let effects = match &arguments.scene {
        Some(scene) => {
            let scene = Scene::load(scene)?;
            Some(arguments.quality.map_or_else(|| scene.effects(), |level| scene.effects_at(level)))
        }
        None => arguments.effects.as_deref().map(str::parse::<Effects>).transpose()?,
    };
    let effects = match arguments.quality {
        Some(level) if arguments.scene.is_none() => Some(level.of(effects.unwrap_or_else(Effects::standing))),
        _ => effects,
    };
    let contents = Contents { table_size: arguments.table_size as usize, effects, ..Contents::default() };
    let bar = progress::bar("Building");
    let shown = Mutex::new(None);
    let package = package::build(&family, &contents, &|step, share| {
        let what = match step {
            Step::Bake(Layout::Compatible) => "Baking the compatible",
            Step::Bake(_) => "Baking the table",
            Step::Measure(_) => "Measuring",
            Step::Translate => "Translating",
        };
        if let Ok(mut shown) = shown.lock()
            && *shown != Some(step)
        {
            *shown = Some(step);
            bar.reset();
            bar.set_message(what);
        }
        progress::advance(&bar, share);
    })?;
    bar.finish_and_clear();
    if let Some(repository) = &arguments.update {
        let committed = ["glsl/", "hlsl/", "msl/", "spirv/"];
        for (path, bytes) in &package.files {
            if committed.iter().any(|folder| path.starts_with(folder))
                || (path.ends_with(".bin") && !path.ends_with("_all.bin"))
            {
                let path = repository.join(path);
                if let Some(folder) = path.parent() {
                    std::fs::create_dir_all(folder)
                        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
                }
                write_file(&path, bytes)?;
                say!("{}", path.display());
            }
        }
        return Ok(());
    }
    package::write_folder(&package, &arguments.out)?;
    say!("Wrote {}:", arguments.out.display());
    for (path, bytes) in &package.files {
        say!("  {path:28} {:>8}", bytes.len());
    }
    let bytes: usize = package.files.iter().map(|(_, bytes)| bytes.len()).sum();
    say!("{} files, {bytes} bytes.", package.files.len());
    say!("\nMean |error| over mean value, per cent, against numerical integration on random quads:");
    say!("{:34} {:>9} {:>9} {:>11}", "", "specular", "Schlick", "dielectric");
    for (name, measured) in
        [("the include", &package.native), ("published technique, our table", &package.compatible)]
    {
        if let Some(measured) = measured {
            print_row(name, &measured.all)?;
        }
    }
    say!("\nTook {:.1} s.", started.elapsed().as_secs_f64());
    Ok(())
}
