//! Pictures: tone mapping, comparison, files.

use std::path::{Path, PathBuf};

use super::label::{draw_text, text_width};
use super::truth::Truth;
use crate::output;

/// Linear radiance, row after row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue of each pixel.
    pub pixels: Vec<[f32; 3]>,
}

/// A picture as it is shown: bytes in sRGB, row after row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Panel {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue of each pixel.
    pub pixels: Vec<[u8; 3]>,
}

/// Why a picture could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The name has another ending.
    #[error("{0}: pictures are written as PNG; give a name that ends in .png")]
    Name(PathBuf),
    /// The file system or the encoder refused.
    #[error(
        "{path}: the picture could not be written ({reason}); name a file in a folder that exists and can be written to"
    )]
    Refused {
        /// The file.
        path: PathBuf,
        /// What was said.
        reason: String,
    },
}

/// How far a picture is from ground truth, over the pixels that show nothing but surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Number of those pixels.
    pub pixels: usize,
    /// Mean luminance of the truth.
    pub mean: f64,
    /// Mean absolute difference of luminance over `mean`.
    pub mean_error: f64,
    /// Absolute difference of luminance over `mean` that one pixel in a hundred exceeds.
    pub high_error: f64,
    /// The largest such difference.
    pub largest_error: f64,
}

fn luminance([red, green, blue]: [f32; 3]) -> f64 {
    0.2126 * f64::from(red) + 0.7152 * f64::from(green) + 0.0722 * f64::from(blue)
}

impl Comparison {
    /// Compares a picture with its ground truth of the same size.
    pub fn new(image: &Image, truth: &Truth) -> Self {
        let pairs = image.pixels.iter().zip(&truth.image.pixels).zip(&truth.shaded);
        let (mut errors, truths): (Vec<f64>, Vec<f64>) = pairs
            .filter(|(_, shaded)| **shaded)
            .map(|((pixel, truth), _)| ((luminance(*pixel) - luminance(*truth)).abs(), luminance(*truth)))
            .unzip();
        let pixels = errors.len();
        let mean = truths.iter().sum::<f64>() / pixels.max(1) as f64;
        let unit = if mean > 0.0 { mean } else { 1.0 };
        errors.sort_unstable_by(f64::total_cmp);
        let ranked = |index: usize| errors.get(index).copied().unwrap_or(0.0) / unit;
        Self {
            pixels,
            mean,
            mean_error: errors.iter().sum::<f64>() / pixels.max(1) as f64 / unit,
            high_error: ranked(pixels * 99 / 100),
            largest_error: ranked(pixels.saturating_sub(1)),
        }
    }
}

impl Image {
    /// The picture as a film shows it: 1 − exp(−exposure · radiance) in each channel, which keeps small values in
    /// proportion and runs into white without an edge.
    pub fn tone_mapped(&self, exposure: f64) -> Panel {
        let channel = |value: f32| srgb(-(-exposure * f64::from(value.max(0.0))).exp_m1());
        let pixels = self.pixels.iter().map(|pixel| pixel.map(channel)).collect();
        Panel { width: self.width, height: self.height, pixels }
    }

    /// The difference to ground truth in false colours: red where the picture is too bright, blue where it is too
    /// dark, full at `scale` times the mean luminance of the truth; grey where the picture shows no surface.
    pub fn difference(&self, truth: &Truth, comparison: &Comparison, scale: f64) -> Panel {
        let full = if comparison.mean > 0.0 { scale * comparison.mean } else { 1.0 };
        let pairs = self.pixels.iter().zip(&truth.image.pixels).zip(&truth.shaded);
        let pixels = pairs.map(|((pixel, truth), shaded)| {
            if *shaded { false_colour((luminance(*pixel) - luminance(*truth)) / full) } else { [70; 3] }
        });
        Panel { width: self.width, height: self.height, pixels: pixels.collect() }
    }
}

fn srgb(value: f64) -> u8 {
    let encoded = if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded.clamp(0.0, 1.0)).round() as u8
}

/// From blue at −1 over black at 0 to red and yellow at 1.
fn false_colour(value: f64) -> [u8; 3] {
    let size = value.abs().min(1.0);
    let [strong, middle] = [srgb(size), srgb(size * size * 0.75)];
    if value > 0.0 { [strong, middle, 0] } else { [0, middle, strong] }
}

impl Panel {
    /// Several panels of one height side by side.
    pub fn beside(panels: &[Self]) -> Self {
        const GAP: u32 = 4;
        let height = panels.iter().map(|panel| panel.height).max().unwrap_or(0);
        let widths: u32 = panels.iter().map(|panel| panel.width).sum();
        let width = widths + GAP * (panels.len() as u32).saturating_sub(1);
        let mut whole = Self { width, height, pixels: vec![[16; 3]; width as usize * height as usize] };
        let mut left = 0;
        for panel in panels {
            for row in 0..panel.height as usize {
                let from = row * panel.width as usize;
                let to = row * width as usize + left;
                whole.pixels[to..to + panel.width as usize]
                    .copy_from_slice(&panel.pixels[from..from + panel.width as usize]);
            }
            left += (panel.width + GAP) as usize;
        }
        whole
    }

    /// Writes a line of capitals, digits and `% + - . / |` in the upper left corner.
    pub fn caption(&mut self, text: &str) {
        let scale = self.text_scale();
        draw_text(self, 4 * scale, 4 * scale, scale, text);
    }

    /// Draws the scale of [`Image::difference`] along the lower edge.
    pub fn legend(&mut self, scale: f64) {
        let text = self.text_scale();
        let [left, length] = [4 * text, (self.width / 2).max(1)];
        let bar = self.height.saturating_sub(8 * text);
        for x in 0..length {
            let colour = false_colour(2.0 * f64::from(x) / f64::from(length) - 1.0);
            for y in 0..4 * text {
                self.set(left + x, bar + y, colour);
            }
        }
        let top = bar.saturating_sub(7 * text);
        let end = format!("+{}% OF MEAN", 100.0 * scale);
        draw_text(self, left, top, text, &format!("-{}%", 100.0 * scale));
        draw_text(self, left + length / 2 - text, top, text, "0");
        draw_text(self, left + length.saturating_sub(text_width("+00%", text)), top, text, &end);
    }

    pub(super) fn set(&mut self, x: u32, y: u32, colour: [u8; 3]) {
        if x < self.width && y < self.height {
            self.pixels[(y * self.width + x) as usize] = colour;
        }
    }

    fn text_scale(&self) -> u32 {
        (self.width / 240).clamp(1, 4)
    }
}

impl Panel {
    /// The picture as the bytes of a PNG file.
    ///
    /// # Errors
    ///
    /// If the encoder refuses, as it does a picture without pixels: what it says.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let mut file = std::io::Cursor::new(Vec::new());
        image::write_buffer_with_format(
            &mut file,
            &self.pixels.concat(),
            self.width,
            self.height,
            image::ExtendedColorType::Rgb8,
            image::ImageFormat::Png,
        )
        .map_err(|error| error.to_string())?;
        Ok(file.into_inner())
    }
}

/// Whether [`write_png`] could write to this name: said before a long computation, it saves the time.
///
/// # Errors
///
/// If the name does not end in `.png` or its folder does not exist.
pub fn check_png_path(path: &Path) -> Result<(), ImageError> {
    if !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png")) {
        return Err(ImageError::Name(path.to_owned()));
    }
    let refused =
        |error: std::io::Error| ImageError::Refused { path: path.to_owned(), reason: error.to_string() };
    output::check_file(path).map_err(refused)
}

/// Writes a picture as PNG, first under a temporary name in the same folder, so that a file of that name is a whole
/// one at any time.
///
/// # Errors
///
/// If the name does not end in `.png` or the file cannot be written.
pub fn write_png(path: &Path, panel: &Panel) -> Result<(), ImageError> {
    check_png_path(path)?;
    let refused = |reason: String| ImageError::Refused { path: path.to_owned(), reason };
    let bytes = panel.png().map_err(refused)?;
    output::write_file(path, &bytes).map_err(|error| refused(error.to_string()))
}
