//! The picture of a scene with every light integrated numerically.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use rayon::prelude::*;

use super::layers::Layers;
use super::{Hit, Image, Scene, sample_positions};

/// A picture in ground truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Linear radiance.
    pub image: Image,
    /// Which pixels show nothing but surfaces; in all others the include has less or nothing to say.
    pub shaded: Vec<bool>,
}

/// Draws a scene by numerical integration of the reflectance models that the tables are baked from, each integral to
/// a relative error of 1e-4, with the samples of [`sample_positions`]. What a layer takes from what is below it, and
/// energy compensation, come from the models' own albedos. A light's picture is integrated texel by texel, each
/// texel of one colour. `progress` hears the share that is done, from any thread.
pub fn render_truth(
    scene: &Scene,
    width: u32,
    height: u32,
    samples: u32,
    progress: &(dyn Fn(f64) + Sync),
) -> Truth {
    let positions = sample_positions(samples.max(1));
    let done = AtomicUsize::new(0);
    let rows: Vec<Vec<([f32; 3], bool)>> = (0..height)
        .into_par_iter()
        .map(|row| {
            let pixel = |column| scene.pixel(column, row, width, height, &positions);
            let pixels = (0..width).map(pixel).collect();
            let rows_done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress(rows_done as f64 / f64::from(height));
            pixels
        })
        .collect();
    let (pixels, shaded) = rows.into_iter().flatten().unzip();
    Truth { image: Image { width, height, pixels }, shaded }
}

impl Scene {
    fn pixel(
        &self,
        column: u32,
        row: u32,
        width: u32,
        height: u32,
        positions: &[[f32; 2]],
    ) -> ([f32; 3], bool) {
        let mut sum = DVec3::ZERO;
        let mut shaded = true;
        for &[x, y] in positions {
            let (x, y) = (f64::from(column) + f64::from(x), f64::from(row) + f64::from(y));
            let direction = self.camera.direction(x, y, width, height);
            let hit = self.trace(self.camera.position, direction);
            shaded &= matches!(hit, Hit::Surface { .. });
            sum += match hit {
                Hit::Background => self.background,
                Hit::Light(index, emitting) if emitting => {
                    self.lights[index].seen(self.camera.position, direction)
                }
                Hit::Light(..) => DVec3::ZERO,
                Hit::Surface { object, position, normal } => {
                    let material = &self.objects[object].material;
                    let layers =
                        Layers::new(material, self.energy_compensation, position, normal, -direction);
                    self.lights.iter().map(|light| layers.reflected(light)).sum()
                }
            };
        }
        ((sum / positions.len() as f64).as_vec3().to_array(), shaded)
    }
}
