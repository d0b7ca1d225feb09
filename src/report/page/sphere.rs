//! Distributions over directions, as pictures.

use std::io::Cursor;

use glam::{DVec2, DVec3};
use image::{
    ExtendedColorType, ImageEncoder,
    codecs::png::{CompressionType, FilterType, PngEncoder},
};
use rayon::prelude::*;

use super::map::colour;
use super::scale::signed_root;

/// Pixels along each side of a picture.
pub(super) const SIZE: usize = 280;
/// Samples along each side of a pixel.
const SAMPLES: usize = 2;
/// Steps of the colours, so that pictures are small.
const SHADES: f64 = 64.0;

/// What a sample of a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sample {
    /// Red, green, blue and opacity.
    colour: [f64; 4],
    /// Which band between two contours it is in.
    band: i32,
}

const NOTHING: Sample = Sample { colour: [0.0; 4], band: i32::MIN };

fn opaque(colour: [u8; 3]) -> [f64; 4] {
    let [red, green, blue] = colour.map(f64::from);
    [red, green, blue, 255.0]
}

/// Draws what `sample` says of each place in [−1, 1]² (y up), with contours where bands meet, as PNG.
fn picture(sample: impl Fn(DVec2) -> Sample + Sync) -> Vec<u8> {
    let side = SIZE * SAMPLES;
    let grid: Vec<Sample> = (0..side * side)
        .into_par_iter()
        .map(|index| {
            let place = |index: usize| (2.0 * (index as f64 + 0.5) / side as f64 - 1.0) * 1.02;
            sample(DVec2::new(place(index % side), -place(index / side)))
        })
        .collect();
    let shown = |x: usize, y: usize| {
        let here = grid[y * side + x];
        let next = [(x + 1, y), (x, y + 1), (x + 1, y + 1)];
        let next = next.into_iter().filter(|(x, y)| *x < side && *y < side).map(|(x, y)| grid[y * side + x]);
        let edge = next.into_iter().any(|other| other.band != here.band && other != NOTHING);
        if edge && here != NOTHING {
            // Contours are white on dark colours and black on light ones.
            let [red, green, blue, _] = here.colour;
            let light = 0.3 * red + 0.6 * green + 0.1 * blue > 140.0;
            let line = if light { 0.0 } else { 255.0 };
            here.colour.map(|channel| 0.45 * channel + 0.55 * line).map(f64::round)
        } else {
            here.colour
        }
    };
    let bytes: Vec<u8> = (0..SIZE * SIZE)
        .flat_map(|index| {
            let (x, y) = (SAMPLES * (index % SIZE), SAMPLES * (index / SIZE));
            let mut sum = [0.0; 4];
            for sample in 0..SAMPLES * SAMPLES {
                let [red, green, blue, opacity] = shown(x + sample % SAMPLES, y + sample / SAMPLES);
                let weight = opacity / 255.0;
                for (sum, channel) in
                    sum.iter_mut().zip([red * weight, green * weight, blue * weight, opacity])
                {
                    *sum += channel;
                }
            }
            let weight = (sum[3] / 255.0).max(1e-9);
            let opacity = sum[3] / (SAMPLES * SAMPLES) as f64;
            [sum[0] / weight, sum[1] / weight, sum[2] / weight, opacity].map(|channel| channel.round() as u8)
        })
        .collect();
    let mut png = Cursor::new(Vec::new());
    PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive)
        .write_image(&bytes, SIZE as u32, SIZE as u32, ExtendedColorType::Rgba8)
        .expect("a picture in memory has the size of its bytes");
    png.into_inner()
}

/// The direction at a place of the map of the hemisphere: Lambert's azimuthal projection around the normal, which keeps
/// areas; none outside. The view lies to the right, the mirror direction to the left.
pub(super) fn direction(place: DVec2) -> Option<DVec3> {
    // Radius √2·sin(θ/2), which is 1 on the horizon.
    let half = 0.5 * place.length_squared();
    (half <= 0.5).then(|| {
        let z = 1.0 - 2.0 * half;
        let sine = (1.0 - z * z).max(0.0).sqrt();
        let across = place.normalize_or(DVec2::X) * sine;
        DVec3::new(across.x, across.y, z)
    })
}

/// The inverse of [`direction`].
fn place(direction: DVec3) -> DVec2 {
    let radius = (1.0 - direction.z).max(0.0).sqrt();
    DVec2::new(direction.x, direction.y).normalize_or(DVec2::X) * radius
}

/// Marks the view (a ring) and the mirror direction (a dot) on a map of the hemisphere.
fn marked(at: DVec2, cosine: f64) -> Option<[f64; 4]> {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let view = at.distance(place(DVec3::new(sine, 0.0, cosine)));
    let mirror = at.distance(place(DVec3::new(-sine, 0.0, cosine)));
    match (view, mirror) {
        (0.028..0.042, _) | (_, ..0.014) => Some(opaque([255, 255, 255])),
        (0.02..0.05, _) | (_, ..0.024) => Some(opaque([0, 0, 0])),
        _ => None,
    }
}

/// Powers of ten that a map of a density spans.
pub(super) const DECADES: f64 = 3.0;

/// The map of a density over the hemisphere for a view with a cosine to the normal: colours from `peak`/10³ to `peak` on a
/// logarithmic scale, two contours for each power of ten.
pub(super) fn density_map(density: &(dyn Fn(DVec3) -> f64 + Sync), peak: f64, cosine: f64) -> Vec<u8> {
    picture(|at| {
        let Some(direction) = direction(at) else { return NOTHING };
        let share = (density(direction).max(0.0) / peak).max(1e-12).log10() / DECADES + 1.0;
        let shade = (share.clamp(0.0, 1.0) * SHADES).round() / SHADES;
        let band = (2.0 * DECADES * share.max(0.0)).floor() as i32;
        Sample { colour: marked(at, cosine).unwrap_or_else(|| opaque(colour(shade))), band }
    })
}

/// The colour of a difference −1…1: purple for too little, orange for too much (Brewer 2003).
pub(super) fn difference_colour(share: f64) -> [u8; 3] {
    colorous::PURPLE_ORANGE.eval_continuous(0.5 + 0.5 * share.clamp(-1.0, 1.0)).as_array()
}

/// The map of a difference over the hemisphere, by its signed root, full at ±`full`.
pub(super) fn difference_map(difference: &(dyn Fn(DVec3) -> f64 + Sync), full: f64, cosine: f64) -> Vec<u8> {
    picture(|at| {
        let Some(direction) = direction(at) else { return NOTHING };
        let share = signed_root(difference(direction) / full);
        let shade = (share.clamp(-1.0, 1.0) * SHADES).round() / SHADES;
        // Zero lies within a band, not between two, where noise would draw it.
        let band = (4.0 * share).clamp(-4.0, 4.0).round() as i32;
        Sample { colour: marked(at, cosine).unwrap_or_else(|| opaque(difference_colour(shade))), band }
    })
}

/// Angle of the eye of [`ball`] above the horizon.
const ELEVATION: f64 = 0.6;

/// The unit sphere with a density on it, seen in parallel projection from the side, 34° above the horizon, so that the
/// surface's x axis runs to the right; a line marks the horizon. Colours from 0 to `peak`, contours at each tenth.
pub(super) fn ball(density: &(dyn Fn(DVec3) -> f64 + Sync), peak: f64) -> Vec<u8> {
    let (sine, cosine) = ELEVATION.sin_cos();
    picture(|at| {
        let depth = 1.0 - at.length_squared();
        if depth < 0.0 {
            return NOTHING;
        }
        let depth = depth.sqrt();
        let direction = DVec3::new(at.x, at.y * sine - depth * cosine, at.y * cosine + depth * sine);
        let value = density(direction);
        // A light from the upper left gives the sphere its form.
        let light = 0.72 + 0.28 * DVec3::new(-0.4, 0.5, 0.77).dot(DVec3::new(at.x, at.y, depth)).max(0.0);
        let share = (value / peak).clamp(0.0, 1.0);
        let shade = if value > 0.0 { colour((share * SHADES).round() / SHADES) } else { [226, 226, 226] };
        let mut shown = opaque(shade).map(|channel| (channel * light).round());
        shown[3] = 255.0;
        if direction.z.abs() < 0.012 {
            shown = opaque([90, 90, 90]);
        }
        Sample { colour: shown, band: (10.0 * share).ceil() as i32 }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_directions_are_inverse_and_keep_areas() {
        for (x, y) in (-9..=9).flat_map(|x| (-9..=9).map(move |y| (0.1 * f64::from(x), 0.1 * f64::from(y)))) {
            let at = DVec2::new(x, y);
            let Some(found) = direction(at) else {
                assert!(at.length() > 0.99, "{at}");
                continue;
            };
            assert!((found.length() - 1.0).abs() < 1e-12, "{found} is a unit vector");
            assert!((place(found) - at).length() < 1e-7, "{at} {}", place(found));
            // Solid angle per area: 2 on the disk of area π for the hemisphere of 2π.
            let near = |offset: DVec2| direction(at + offset);
            if let (Some(right), Some(up)) = (near(DVec2::X * 1e-5), near(DVec2::Y * 1e-5)) {
                let area = (right - found).cross(up - found).length() / 1e-10;
                assert!((area - 2.0).abs() < 2e-3, "{area} at {at}");
            }
        }
    }
}
