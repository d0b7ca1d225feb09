//! `softbox effects`: what a scene calls for.

use std::path::PathBuf;

use clap::Args;
use softbox::scene::Scene;

use crate::quality::QualityArguments;
use crate::select::print_text;

/// What `softbox effects` is given.
#[derive(Args)]
pub struct EffectsArguments {
    /// The scene file (TOML).
    scene: PathBuf,
    #[command(flatten)]
    quality: QualityArguments,
    /// Tell for each entry which effects it calls for, too.
    #[arg(long)]
    list: bool,
}

/// Prints the least set of effects that draws the scene right.
///
/// # Errors
///
/// If the scene cannot be read.
pub fn effects(arguments: &EffectsArguments) -> anyhow::Result<()> {
    let scene = Scene::load(&arguments.scene)?;
    let mut text = format!("{}\n", arguments.quality.of_scene(&scene));
    if arguments.list {
        for (place, effects) in scene.entries() {
            text += &format!("{place:20} {effects}\n");
        }
    }
    print_text(&text)
}
