//! Pictures on lights.

use std::io::Cursor;
use std::path::Path;

use glam::DVec3;

use super::{Light, SceneError};
use crate::input;
use crate::light;
use crate::texture::{Prefiltered, prefilter};

/// Largest number of texels along a side: what every device takes.
const LARGEST_SIDE: u32 = 4096;

/// Bytes of the largest file: a picture of that size in eight bytes a texel, and as much again.
const LARGEST_FILE: usize = 256 << 20;

/// Reads a PNG file in sRGB and makes its pyramid, linear and premultiplied by alpha.
///
/// # Errors
///
/// If the file cannot be read, is no PNG file, or is too large.
pub fn load_picture(path: &Path) -> Result<Prefiltered, SceneError> {
    read_picture(path).map_err(|reason| {
        SceneError::new(
            path.display().to_string(),
            format!("the picture could not be read ({reason}); name a PNG file of up to {LARGEST_SIDE} texels a side"),
        )
    })
}

/// [`load_picture`], with nothing but the reason for an error.
pub(super) fn read_picture(path: &Path) -> Result<Prefiltered, String> {
    decode_picture(&input::read(path, LARGEST_FILE).map_err(|error| error.to_string())?)
}

/// The pyramid of the bytes of a PNG file in sRGB, linear and premultiplied by alpha.
///
/// # Errors
///
/// The reason, if they are no PNG file or the picture is too large.
pub fn decode_picture(bytes: &[u8]) -> Result<Prefiltered, String> {
    let reader = || image::ImageReader::with_format(Cursor::new(bytes), image::ImageFormat::Png);
    // Before anything is unpacked: a file of a few bytes may hold a picture of gigabytes.
    let (width, height) = reader().into_dimensions().map_err(|error| error.to_string())?;
    if width.max(height) > LARGEST_SIDE {
        return Err(format!("it has {width} x {height} texels, and a side may have at most {LARGEST_SIDE}"));
    }
    let picture = reader().decode().map_err(|error| error.to_string())?.into_rgba32f();
    let texels: Vec<[f32; 4]> = picture
        .pixels()
        .map(|&image::Rgba([red, green, blue, alpha])| {
            let [red, green, blue] = [red, green, blue].map(|value| linear(value) * alpha);
            [red, green, blue, alpha]
        })
        .collect();
    Ok(prefilter(width as usize, height as usize, &texels))
}

/// The light that a value of sRGB stands for (IEC 61966-2-1).
fn linear(value: f32) -> f32 {
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

impl Light {
    /// What the light emits from a point on it.
    pub(super) fn emitted(&self, point: DVec3) -> DVec3 {
        match (&self.picture, &self.shape) {
            (Some(picture), light::Light::Polygon { points, .. }) => {
                let (u, v) = (points[1] - points[0], points[0] - points[3]);
                let offset = point - points[3];
                let area = u.cross(v);
                let at = [offset.cross(v).dot(area), u.cross(offset).dot(area)]
                    .map(|share| share / area.length_squared());
                let [red, green, blue, _] = picture.sample(at, 0.0);
                self.radiance * DVec3::new(red, green, blue)
            }
            _ => self.radiance,
        }
    }
}
