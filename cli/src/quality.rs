//! `--quality`.

use clap::Args;
use softbox::effects::{Effects, Quality};
use softbox::scene::Scene;

#[derive(Args, Clone, Copy, Debug)]
pub struct QualityArguments {
    /// Quality level, one of fast, standard, fine and finest; `softbox report` measures what each costs and buys.
    #[arg(long, value_name = "LEVEL")]
    pub quality: Option<Quality>,
}

impl QualityArguments {
    /// What a scene calls for at the level, or at any.
    pub fn of_scene(&self, scene: &Scene) -> Effects {
        self.quality.map_or_else(|| scene.effects(), |level| scene.effects_at(level))
    }

    /// The set at the level, or as it is where none is given.
    pub fn of(&self, effects: Effects) -> Effects {
        self.quality.map_or(effects, |level| level.of(effects))
    }
}
