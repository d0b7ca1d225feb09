//! Errors of rendered scenes.

use std::path::Path;

use crate::device::{Device, RenderError};
use crate::effects::Effects;
use crate::report::data::PictureRow;
use crate::scene::{Comparison, Image, ImageError, Scene, Truth, render_truth, write_png};
use crate::table::Table;

/// Difference over the mean luminance of the truth that has the full colour in a difference image.
pub const DIFFERENCE_SCALE: f64 = 0.2;

/// A way to draw scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureLevel {
    /// The method's name.
    pub name: String,
    /// What it asks for besides what a scene calls for.
    pub effects: Effects,
    /// Its table; layers that it lacks are the embedded ones.
    pub table: Table,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// It was not drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// It was not written.
    #[error(transparent)]
    Image(#[from] ImageError),
}

/// Draws a scene once for each level, with one sample a pixel, and once in ground truth, which takes most of the time;
/// writes each picture and its difference to the truth as `SCENE-LEVEL.png` and `SCENE-LEVEL-difference.png` into
/// `folder`, and the truth as `SCENE-truth.png`.
///
/// Errors are those of luminance over the pixels that show nothing but surfaces. `origin` is the rows' index of theirs.
/// `progress` hears the share of the ground truth.
///
/// # Errors
///
/// If the device fails, or a picture cannot be written.
pub fn pictures(
    device: &Device,
    levels: &[PictureLevel],
    (name, scene): (&str, &Scene),
    size @ [width, height]: [u32; 2],
    folder: &Path,
    origin: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<PictureRow>, PictureError> {
    let truth = render_truth(scene, width, height, 1, progress);
    let exposure = scene.camera.exposure;
    write_png(&folder.join(format!("{name}-truth.png")), &truth.image.tone_mapped(exposure))?;
    let mut rows = Vec::with_capacity(levels.len());
    for level in levels {
        let effects = scene.effects() | level.effects;
        let image = device.render_with(&level.table, scene, effects, size, 1, &|_| ())?;
        let comparison = Comparison::new(&image, &truth);
        let picture = format!("{name}-{}.png", level.name);
        let difference = format!("{name}-{}-difference.png", level.name);
        write_png(&folder.join(&picture), &image.tone_mapped(exposure))?;
        let mut panel = image.difference(&truth, &comparison, DIFFERENCE_SCALE);
        panel.legend(DIFFERENCE_SCALE);
        write_png(&folder.join(&difference), &panel)?;
        rows.push(PictureRow {
            method: level.name.clone(),
            scene: name.to_owned(),
            rmse: root_mean_square(&image, &truth)
                / if comparison.mean > 0.0 { comparison.mean } else { 1.0 },
            mean: comparison.mean_error,
            picture,
            difference,
            origin,
        });
    }
    Ok(rows)
}

/// Root mean square difference of luminance (ITU-R BT.709) over the pixels that show nothing but surfaces.
fn root_mean_square(image: &Image, truth: &Truth) -> f64 {
    let luminance = |pixel: &[f32; 3]| {
        pixel
            .iter()
            .zip([0.2126, 0.7152, 0.0722])
            .map(|(value, weight)| weight * f64::from(*value))
            .sum::<f64>()
    };
    let pairs = image.pixels.iter().zip(&truth.image.pixels).zip(&truth.shaded);
    let squares: Vec<f64> = pairs
        .filter(|(_, shaded)| **shaded)
        .map(|((pixel, truth), _)| (luminance(pixel) - luminance(truth)).powi(2))
        .collect();
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}
