//! `softbox select`.

use std::collections::BTreeSet;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::Context;
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use softbox::effects::{self, Effect, Effects};
use softbox::translate::{self, Target};

use crate::bake::{check_file, write_file};
use crate::progress;
use crate::quality::QualityArguments;

#[derive(Args)]
pub struct SelectArguments {
    /// The set of effects, such as quad,polygon+ggx+two-sided.
    #[arg(value_name = "SET", required_unless_present_any = ["list", "count"])]
    effects: Option<String>,
    #[command(flatten)]
    quality: QualityArguments,
    /// Language of the text.
    #[arg(long, value_enum, default_value = "wgsl")]
    target: Language,
    /// File to write; standard output by default.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print all effects with what they mean instead.
    #[arg(long, conflicts_with_all = ["effects", "out"])]
    list: bool,
    /// Make the module of every set instead, and count the different ones; takes minutes.
    #[arg(long, conflicts_with_all = ["effects", "out", "list"])]
    count: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum Language {
    Wgsl,
    #[value(name = "glsl-450")]
    Glsl450,
    #[value(name = "glsl-330")]
    Glsl330,
    #[value(name = "glsl-es300")]
    GlslEs300,
    #[value(name = "glsl-es310")]
    GlslEs310,
    Hlsl,
    Unreal,
    Msl,
}

pub fn select(arguments: &SelectArguments) -> anyhow::Result<()> {
    if let Some(path) = &arguments.out {
        check_file(path)?;
    }
    let text = match &arguments.effects {
        Some(effects) => selected(arguments.quality.of(effects.parse()?), arguments.target)?,
        None if arguments.count => count()?,
        None => list(),
    };
    match &arguments.out {
        Some(path) => write_file(path, text.as_bytes())?,
        None => print_text(&text)?,
    }
    Ok(())
}

/// Prints a whole text; that its reader stops early is no error.
pub fn print_text(text: &str) -> anyhow::Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to standard output")
        }
        _ => Ok(()),
    }
}

fn selected(effects: Effects, language: Language) -> anyhow::Result<String> {
    let target = match language {
        Language::Wgsl => return Ok(effects::wgsl(effects)?),
        Language::Glsl450 => Target::Glsl450,
        Language::Glsl330 => Target::Glsl330,
        Language::GlslEs300 => Target::GlslEs300,
        Language::GlslEs310 => Target::GlslEs310,
        Language::Hlsl => Target::Hlsl,
        Language::Unreal => Target::Unreal,
        Language::Msl => Target::Msl,
    };
    Ok(translate::include_for(target, effects)?)
}

fn list() -> String {
    let present = Effects::present();
    Effect::all().fold(String::new(), |list, effect| {
        let absent = if present.contains(effect) { "" } else { " (not in this include)" };
        list + &format!("{:20} {}{absent}\n", effect.name(), effect.entry().meaning)
    })
}

/// How many sets there are, and how many modules they make.
fn count() -> anyhow::Result<String> {
    let present = Effects::present();
    let sets: Vec<Effects> = Effects::every().filter(|effects| present.is_superset(*effects)).collect();
    let bar = progress::bar("Translating");
    let done = AtomicUsize::new(0);
    let modules: BTreeSet<Vec<u8>> = sets
        .par_iter()
        .map(|effects| {
            let module = translate::library_spirv(softbox::WGSL_INCLUDE, *effects);
            let share = (done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / sets.len() as f64;
            progress::advance(&bar, share);
            module
        })
        .collect::<Result<_, _>>()?;
    bar.finish_and_clear();
    Ok(format!("{} sets of effects make {} different modules\n", sets.len(), modules.len()))
}
