//! `softbox bake`.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::Context;
use clap::{Args, ValueEnum};
use softbox::fit::{self, Settings};
use softbox::output;
use softbox::package::measure;
use softbox::report::{Accuracy, REGIONS, Technique};
use softbox::table::{Container, Table};

use crate::model::ModelArguments;
use crate::number::Whole;
use crate::progress;
use crate::say::say;

#[derive(Args)]
pub struct BakeArguments {
    /// File to write; its extension chooses the format: .bin (raw texels), .dds, .ktx2, .rs or .h.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Texels along each axis, 2 to 1024.
    #[arg(long, default_value = "64", value_name = "N", value_parser = TABLE_SIZES, allow_negative_numbers = true)]
    size: u32,
    /// Meaning of the texels.
    #[arg(long, value_enum, default_value = "native")]
    layout: LayoutName,
    #[command(flatten)]
    model: ModelArguments,
    /// Measure the table against numerical integration, and print its error by region.
    #[arg(long)]
    measure: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum LayoutName {
    /// What the include reads.
    Native,
    /// What code that implements the published technique reads.
    Compatible,
    /// One layer that the include reads for sheen.
    Sheen,
    /// One layer that the include reads for the first bounce of rough diffuse surfaces.
    Diffuse,
}

/// Texels along each axis of a table.
pub const TABLE_SIZES: Whole = Whole { least: 2, most: 1024 };

pub fn bake(arguments: &BakeArguments) -> anyhow::Result<()> {
    let started = Instant::now();
    let size = arguments.size as usize;
    let extension = arguments.out.extension().unwrap_or_default().to_string_lossy();
    let container = Container::ALL
        .into_iter()
        .find(|container| extension.eq_ignore_ascii_case(container.extension()))
        .with_context(|| {
            format!(
                "{} has no extension that names a table format; use .bin, .dds, .ktx2, .rs or .h",
                arguments.out.display()
            )
        })?;
    check_file(&arguments.out)?;
    let (settings, technique) = match arguments.layout {
        LayoutName::Native => (Settings::native(size), Some(Technique::Include)),
        LayoutName::Compatible => (Settings::compatible(size), Some(Technique::Published)),
        LayoutName::Sheen => (Settings::sheen(size), None),
        LayoutName::Diffuse => (Settings::diffuse(size), None),
    };
    let family = arguments.model.family_for(settings.layout)?;
    anyhow::ensure!(
        technique.is_some() || !arguments.measure,
        "--measure is for tables of specular lobes, the layouts native and compatible"
    );
    let bar = progress::bar("Baking");
    let fitted = fit::bake(&family, settings, &|share| progress::advance(&bar, share));
    bar.finish_and_clear();
    let table = Table::pack(&fitted);
    let bytes = container.write(&table)?;
    write_file(&arguments.out, &bytes)?;
    say!(
        "Wrote {} ({} bytes) in {:.1} s.",
        arguments.out.display(),
        bytes.len(),
        started.elapsed().as_secs_f64()
    );
    if let Some(technique) = technique.filter(|_| arguments.measure) {
        let bar = progress::bar("Measuring");
        let measured = measure(&table, technique, &family, 200, &|share| progress::advance(&bar, share));
        bar.finish_and_clear();
        say!("\nMean |error| over mean value, per cent, on random quads:");
        say!("{:34} {:>9} {:>9} {:>11}", "", "specular", "Schlick", "dielectric");
        print_row("all", &measured.all)?;
        for (region, accuracy) in REGIONS.iter().zip(&measured.regions) {
            let ((low, high), (grazing, steep)) = (region.roughness, region.cosine);
            print_row(&format!("roughness {low}-{high}, cosine {grazing}-{steep}"), accuracy)?;
        }
    }
    Ok(())
}

pub fn print_row(name: &str, accuracy: &Accuracy) -> anyhow::Result<()> {
    say!(
        "{name:34} {:9.2} {:9.2} {:11.2}",
        100.0 * accuracy.specular,
        100.0 * accuracy.fresnel,
        100.0 * accuracy.dielectric
    );
    Ok(())
}

/// Tells before any work is done why a file cannot be written.
pub fn check_file(path: &Path) -> anyhow::Result<()> {
    output::check_file(path).with_context(|| format!("cannot write {}", path.display()))
}

/// Writes a file whole or not at all.
pub fn write_file(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    output::write_file(path, bytes).with_context(|| format!("cannot write {}", path.display()))
}
