//! `softbox render`: a picture of a scene.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context;
use clap::Args;
use softbox::device::Device;
use softbox::scene::{Comparison, Panel, Scene, check_png_path, render_truth, write_png};
use softbox::table::Table;

use crate::number::Whole;
use crate::progress;
use crate::quality::QualityArguments;
use crate::say::say;

/// Difference, over the mean of the truth, that has the full colour.
const DIFFERENCE_SCALE: f64 = 0.2;

/// What `softbox render` is given.
#[derive(Args, Debug)]
pub struct RenderArguments {
    /// The scene file (TOML).
    pub scene: PathBuf,
    /// The picture to write (PNG).
    #[arg(long, value_name = "IMAGE.png")]
    pub out: PathBuf,
    /// Place the numerically integrated ground truth beside the picture.
    #[arg(long)]
    pub truth: bool,
    /// Place the difference to ground truth beside the picture, in false colours.
    #[arg(long)]
    pub difference: bool,
    /// Set of effects to draw with, such as quad,polygon+ggx+two-sided; what the scene calls for by default.
    #[arg(long, value_name = "SET")]
    pub effects: Option<String>,
    #[command(flatten)]
    pub quality: QualityArguments,
    /// Pixels in a row; 960, or 480 with ground truth.
    #[arg(long, value_name = "PIXELS", value_parser = Whole { least: 1, most: 16384 }, allow_negative_numbers = true)]
    pub width: Option<u32>,
    /// Rows; 9/16 of the width.
    #[arg(long, value_name = "PIXELS", value_parser = Whole { least: 1, most: 16384 }, allow_negative_numbers = true)]
    pub height: Option<u32>,
    /// Samples of each pixel; 16, or 1 with ground truth, whose time grows with them.
    #[arg(long, value_name = "N", value_parser = Whole { least: 1, most: 4096 }, allow_negative_numbers = true)]
    pub samples: Option<u32>,
}

/// Draws the scene, and its ground truth if that is asked for.
///
/// # Errors
///
/// If the scene cannot be read, no device draws it, or the picture cannot be written.
pub fn render(arguments: &RenderArguments) -> anyhow::Result<()> {
    check_png_path(&arguments.out)?;
    let scene = Scene::load(&arguments.scene)?;
    let effects = match &arguments.effects {
        Some(text) => arguments.quality.of(text.parse()?),
        None => arguments.quality.of_scene(&scene),
    };
    scene.check_effects(effects).with_context(|| arguments.scene.display().to_string())?;
    let with_truth = arguments.truth || arguments.difference;
    let width = arguments.width.unwrap_or(if with_truth { 480 } else { 960 });
    let height = arguments.height.unwrap_or((width * 9).div_ceil(16));
    let samples = arguments.samples.unwrap_or(if with_truth { 1 } else { 16 });
    let table = Table::default();
    let device = Device::open_any()?;
    let (image, seconds) = timed("include", |progress| {
        device.render_with(&table, &scene, effects, [width, height], samples, &|share| progress(share))
    });
    let image = image?;
    say!(
        "{width} x {height}, {samples} samples, {} lights, {effects}: {:.2} s on {}",
        scene.lights.len(),
        seconds,
        device.info().name
    );
    let mut panels = vec![image.tone_mapped(scene.camera.exposure)];
    if with_truth {
        let (truth, seconds) =
            timed("ground truth", |progress| render_truth(&scene, width, height, samples, progress));
        let comparison = Comparison::new(&image, &truth);
        say!("ground truth: {seconds:.1} s");
        say!(
            "difference over the mean, {} pixels of surface: mean {:.2} %, 99th percentile {:.1} %, largest {:.1} %",
            comparison.pixels,
            100.0 * comparison.mean_error,
            100.0 * comparison.high_error,
            100.0 * comparison.largest_error
        );
        panels[0].caption("INCLUDE");
        if arguments.truth {
            let mut panel = truth.image.tone_mapped(scene.camera.exposure);
            panel.caption("GROUND TRUTH");
            panels.push(panel);
        }
        if arguments.difference {
            say!(
                "difference panel: yellow is too bright, blue too dark, full colour at {} % of the mean, grey where there is no surface",
                100.0 * DIFFERENCE_SCALE
            );
            let mut panel = image.difference(&truth, &comparison, DIFFERENCE_SCALE);
            panel.caption(&format!("DIFFERENCE: MEAN {:.2}%", 100.0 * comparison.mean_error));
            panel.legend(DIFFERENCE_SCALE);
            panels.push(panel);
        }
    }
    write_png(&arguments.out, &Panel::beside(&panels))?;
    say!("{}", arguments.out.display());
    Ok(())
}

/// Runs `work` with a progress bar and a clock; the bar is silent where there is no terminal.
fn timed<T>(name: &'static str, work: impl FnOnce(&(dyn Fn(f64) + Sync)) -> T) -> (T, f64) {
    let bar = progress::bar(name);
    let start = Instant::now();
    let result = work(&|share| progress::advance(&bar, share));
    bar.finish_and_clear();
    (result, start.elapsed().as_secs_f64())
}
