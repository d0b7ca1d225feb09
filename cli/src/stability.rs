//! `softbox stability`: hard cases on the CPU and on this machine's devices.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use indicatif::ProgressBar;
use softbox::device::Device;
use softbox::effects::Quality;
use softbox::input;
use softbox::scene::Scene;
use softbox::stability::page::{LevelSheet, Section, Sheet, all_curves, check_folder, read_stacks};
use softbox::stability::{Inputs, Run, beyond_lines, scene_by_both, sheet, summary, table_text};

use crate::bake::write_file;
use crate::number::Whole;
use crate::progress;
use crate::say::say;

/// Bytes of the largest file of recorded stacks.
const LARGEST_FILE: usize = 16 << 20;

/// Scenes that are drawn where no other is named: file names, and texts.
const SCENES: [(&str, &str); 2] = [
    ("contact", include_str!("../../scenes/contact.toml")),
    ("hard", include_str!("../../scenes/hard.toml")),
];

/// Pixels of a picture of a scene.
const SIZE: [u32; 2] = [320, 240];

#[derive(Args)]
pub struct StabilityArguments {
    /// Quality level to print: fast, standard, fine or finest; --out tries all of them.
    #[arg(long, value_name = "LEVEL", default_value = "standard")]
    quality: Quality,
    /// How many cases to try, in units of about 3000.
    #[arg(long, value_name = "N", default_value = "20", value_parser = Whole { least: 1, most: 1000 }, allow_negative_numbers = true)]
    cases: u32,
    /// Run the include's twin on the CPU and no device; --out then draws no scene.
    #[arg(long, conflicts_with_all = ["adapter", "scene"])]
    cpu_only: bool,
    /// Run the CPU and the adapters whose name holds this text; by default every adapter.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Print a line of JSON for each family on each stack instead of a table.
    #[arg(long)]
    json: bool,
    /// Fail where more than this share of a bound is used; 1 is the bound itself.
    #[arg(long, value_name = "SHARE", default_value = "1", value_parser = share, allow_negative_numbers = true)]
    limit: f64,
    /// Folder for all of it: a page, a chart of the error along each approach by the published form and by ours, the
    /// numbers, scenes drawn by both. An older one there is replaced.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Scene file (TOML) of polygons to draw by the published form and by ours, in the place of two that come along.
    #[arg(long, value_name = "FILE", requires = "out")]
    scene: Option<PathBuf>,
    /// Write stability.md and stability.svg of the documentation into this folder, from fixed cases on the CPU and the
    /// stacks.jsonl that is there, and do nothing else.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["out", "cases", "quality", "limit", "json", "adapter", "cpu_only"])]
    docs: Option<PathBuf>,
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(share) if share > 0.0 && share <= 1.0 => Ok(share),
        _ => Err("a share of a bound is a number above 0, at most 1".to_owned()),
    }
}

/// Tries the cases, prints what came of them, and writes what is asked for.
///
/// # Errors
///
/// If anything is beyond its bound, a device is missing or fails, or something cannot be written.
pub fn stability(arguments: &StabilityArguments) -> anyhow::Result<()> {
    if let Some(folder) = &arguments.docs {
        anyhow::ensure!(
            folder.is_dir(),
            "there is no folder {}; --docs names one with the documentation",
            folder.display()
        );
        return document(folder);
    }
    if let Some(folder) = &arguments.out {
        check_folder(folder)?;
    }
    let scenes = match (&arguments.scene, &arguments.out) {
        (Some(path), _) => vec![("scene".to_owned(), Scene::load(path)?)],
        (None, Some(_)) if !arguments.cpu_only => {
            let scene = |(name, text): (&str, &str)| Ok((name.to_owned(), Scene::parse(text, name)?));
            SCENES.into_iter().map(scene).collect::<anyhow::Result<_>>()?
        }
        _ => Vec::new(),
    };
    let devices = devices(arguments)?;
    let levels = match &arguments.out {
        Some(_) => Quality::ALL.to_vec(),
        None => vec![arguments.quality],
    };
    let bar = progress::bar("Trying hard cases");
    // Levels take a half of the time, curves and scenes the rest.
    let part = if arguments.out.is_some() { 0.5 } else { 1.0 } / levels.len() as f64;
    let levels = levels.into_iter().enumerate().map(|(index, level)| {
        bar.set_message(format!("Trying {level}"));
        let tried = try_level(arguments, level, &devices);
        progress::advance(&bar, part * (index + 1) as f64);
        tried
    });
    let levels = levels.collect::<anyhow::Result<Vec<_>>>()?;
    let written = match &arguments.out {
        Some(folder) => Some(write(arguments, folder, &levels, &devices, &scenes, &bar)?),
        None => None,
    };
    bar.finish_and_clear();
    for level in levels.iter().filter(|level| level.inputs.level == arguments.quality) {
        if arguments.json {
            for run in &level.runs {
                say!("{}", run.lines().map_err(anyhow::Error::msg)?.trim_end());
            }
        } else {
            say!("{}", table_text(&level.inputs, &level.runs));
        }
    }
    if let Some(path) = written {
        say!("{}", path.display());
    }
    for level in &levels {
        for line in beyond_lines(&level.inputs, &level.runs) {
            eprintln!("{line}");
        }
    }
    match levels.iter().find_map(|level| summary(&level.inputs, &level.runs, arguments.limit)) {
        Some(sentence) => anyhow::bail!(sentence),
        None => Ok(()),
    }
}

/// The devices that are asked for.
fn devices(arguments: &StabilityArguments) -> anyhow::Result<Vec<Device>> {
    if arguments.cpu_only {
        return Ok(Vec::new());
    }
    let mut devices = Device::every(wgpu::Backends::all())
        .context("hard cases need a device unless --cpu-only is given")?;
    if let Some(wanted) = &arguments.adapter {
        let names: Vec<String> = devices.iter().map(|device| device.info().name.clone()).collect();
        devices.retain(|device| device.info().name.to_lowercase().contains(&wanted.to_lowercase()));
        anyhow::ensure!(
            !devices.is_empty(),
            "no adapter's name holds {wanted:?}; there are {}",
            names.join("; ")
        );
    }
    Ok(devices)
}

fn try_level(
    arguments: &StabilityArguments,
    level: Quality,
    devices: &[Device],
) -> anyhow::Result<LevelSheet> {
    let command = format!("softbox stability --quality {level} --cases {}", arguments.cases);
    let inputs = Inputs::of(level, arguments.cases as usize);
    let twin = inputs.run_twin(&command);
    let reference = twin.values.clone();
    let mut runs: Vec<Run> = vec![twin];
    for device in devices {
        runs.push(inputs.run_device(device, &command, &reference)?);
    }
    Ok(LevelSheet { inputs, runs })
}

/// Writes the folder; returns its page.
fn write(
    arguments: &StabilityArguments,
    folder: &Path,
    levels: &[LevelSheet],
    devices: &[Device],
    scenes: &[(String, Scene)],
    bar: &ProgressBar,
) -> anyhow::Result<PathBuf> {
    bar.set_message("Drawing approaches");
    let mut sheet = Sheet {
        levels: levels.to_vec(),
        curves: all_curves(),
        stacks: levels.iter().flat_map(|level| &level.runs).map(|run| run.stack.clone()).collect(),
        sections: Vec::new(),
        command: format!("softbox stability --out {} --cases {}", folder.display(), arguments.cases),
    };
    progress::advance(bar, 0.75);
    let mut pictures = Vec::new();
    if let Some(device) = devices.first() {
        bar.set_message("Drawing scenes");
        let mut text = String::new();
        for (index, (name, scene)) in scenes.iter().enumerate() {
            text += &draw(device, name, scene, &mut pictures)?;
            progress::advance(bar, 0.75 + 0.25 * (index + 1) as f64 / scenes.len() as f64);
        }
        sheet.sections.push(Section { title: "Scenes by the published form and by ours".to_owned(), text });
    }
    let files = sheet.files(pictures).map_err(anyhow::Error::msg)?;
    Sheet::write(&files, folder)?;
    Ok(folder.join("stability.md"))
}

/// Draws a scene by both; returns what the page says of it.
fn draw(
    device: &Device,
    name: &str,
    scene: &Scene,
    pictures: &mut Vec<(String, Vec<u8>)>,
) -> anyhow::Result<String> {
    let shaded = scene_by_both(device, scene, SIZE)?;
    let picture = sheet(&shaded, scene.camera.exposure);
    let file = format!("scene-{name}.png");
    pictures.push((file.clone(), picture.png().map_err(anyhow::Error::msg)?));
    let mut text = format!(
        "![{name}: published forms, ours, and their errors]({file})\n\nOn {}; {} by {} pixels, each against itself in exact arithmetic.\n\n\
         | form | off by more than 1 % of the mean | not finite | mean error |\n| --- | ---: | ---: | ---: |\n",
        device.info().name,
        SIZE[0],
        SIZE[1]
    );
    for shaded in &shaded {
        let spread = shaded.spread();
        text += &format!(
            "| {} | {:.2} % of the pixels | {} | {:.1e} of the mean |\n",
            shaded.method.label(),
            100.0 * spread.visible,
            spread.not_finite,
            spread.mean
        );
    }
    Ok(text + "\n")
}

/// Writes the page of the documentation.
fn document(folder: &Path) -> anyhow::Result<()> {
    let recorded = folder.join("stacks.jsonl");
    let stacks = match recorded.try_exists() {
        Ok(false) => Vec::new(),
        _ => {
            let text = input::read_text(&recorded, LARGEST_FILE)
                .with_context(|| format!("cannot read {}", recorded.display()))?;
            read_stacks(&text).map_err(anyhow::Error::msg).with_context(|| recorded.display().to_string())?
        }
    };
    let bar = progress::bar("Trying hard cases");
    let sheet = Sheet::documented(stacks);
    bar.finish_and_clear();
    let files = sheet.documents();
    for (name, text) in files {
        let path = folder.join(name);
        write_file(&path, text.as_bytes())?;
        say!("{}", path.display());
    }
    Ok(())
}
