//! The pyramid of blurred images.

use softbox::texture::{Prefiltered, TAPS, VARIANCE, prefilter, weights};

use crate::common::Random;

const SIZES: [[usize; 2]; 8] = [[64, 64], [128, 32], [1, 1], [1, 7], [5, 3], [100, 37], [33, 64], [2, 2]];

pub fn noise(random: &mut Random, [width, height]: [usize; 2]) -> Vec<[f32; 4]> {
    (0..width * height).map(|_| core::array::from_fn(|_| random.unit() as f32)).collect()
}

fn mean(texels: &[[f32; 4]], channel: usize) -> f64 {
    texels.iter().map(|texel| f64::from(texel[channel])).sum::<f64>() / texels.len() as f64
}

#[test]
fn a_constant_image_stays_constant() {
    let colour = [0.3, 1.0, 700.0, 0.0];
    for [width, height] in SIZES {
        let prefiltered = prefilter(width, height, &vec![colour; width * height]);
        for level in prefiltered.levels() {
            for texel in &level.texels {
                for k in 0..4 {
                    let (found, wanted) = (texel[k], colour[k]);
                    assert!(
                        (found - wanted).abs() <= 2e-6 * wanted,
                        "{found}, not {wanted}: {width} x {height}"
                    );
                }
            }
        }
    }
}

#[test]
fn levels_halve_down_to_the_mean() {
    let mut random = Random::new(1);
    for [width, height] in SIZES {
        let image = noise(&mut random, [width, height]);
        let prefiltered = prefilter(width, height, &image);
        assert_eq!(prefiltered.levels().len(), 1 + width.max(height).ilog2() as usize);
        assert_eq!(prefiltered.levels()[0].texels, image);
        let top = prefiltered.levels().last().unwrap();
        assert_eq!((top.width, top.height), (1, 1));
        for k in 0..4 {
            let (found, wanted) = (f64::from(top.texels[0][k]), mean(&image, k));
            assert!((found - wanted).abs() < 1e-6, "{found}, not {wanted}: {width} x {height}");
        }
    }
}

#[test]
fn no_level_gains_or_loses_light() {
    let mut random = Random::new(2);
    for [width, height] in SIZES {
        let image = noise(&mut random, [width, height]);
        // Where a side cannot be halved some texels count more than others, most of all in the shortest rows.
        let bound = match (width.is_power_of_two() && height.is_power_of_two(), width.max(height)) {
            (true, _) => 1e-6,
            (false, 7..) => 1e-3,
            (false, _) => 0.03,
        };
        for level in prefilter(width, height, &image).levels() {
            for k in 0..4 {
                let (found, wanted) = (mean(&level.texels, k), mean(&image, k));
                assert!(
                    (found - wanted).abs() < bound,
                    "{found}, not {wanted}: {width} x {height} at {} x {}",
                    level.width,
                    level.height
                );
            }
        }
    }
}

#[test]
fn blurring_is_linear() {
    let mut random = Random::new(3);
    for size in SIZES {
        let [first, second] = [noise(&mut random, size), noise(&mut random, size)];
        let both: Vec<[f32; 4]> = first
            .iter()
            .zip(&second)
            .map(|(a, b)| core::array::from_fn(|k| 2.0 * a[k] + 0.5 * b[k]))
            .collect();
        let [first, second, both] = [first, second, both].map(|image| prefilter(size[0], size[1], &image));
        for (level, texels) in both.levels().iter().enumerate() {
            for (index, texel) in texels.texels.iter().enumerate() {
                let [a, b] = [&first, &second].map(|image| image.levels()[level].texels[index]);
                for k in 0..4 {
                    let wanted = 2.0 * a[k] + 0.5 * b[k];
                    assert!(
                        (texel[k] - wanted).abs() < 3e-6,
                        "{}, not {wanted}: {size:?} level {level}",
                        texel[k]
                    );
                }
            }
        }
    }
}

#[test]
fn turning_the_image_turns_every_level() {
    let mut random = Random::new(4);
    for [width, height] in SIZES {
        let image = noise(&mut random, [width, height]);
        let mirrored: Vec<_> = image.chunks_exact(width).flat_map(|row| row.iter().rev().copied()).collect();
        let transposed: Vec<_> =
            (0..width * height).map(|i| image[(i % height) * width + i / height]).collect();
        let [plain, mirrored] = [&image, &mirrored].map(|image| prefilter(width, height, image));
        let transposed = prefilter(height, width, &transposed);
        let mut places = || [random.unit(), random.unit(), random.between(0.0, 8.0)];
        for _ in 0..200 {
            let [u, v, level] = places();
            let wanted = plain.sample([u, v], level);
            for found in [mirrored.sample([1.0 - u, v], level), transposed.sample([v, u], level)] {
                for k in 0..4 {
                    assert!(
                        (found[k] - wanted[k]).abs() < 3e-6,
                        "{found:?}, not {wanted:?}: {width} x {height} at {u} {v} {level}"
                    );
                }
            }
        }
    }
}

/// The kernel has one mass and one variance, and no mean offset, wherever it lies.
#[test]
fn weights_have_the_moments_that_are_stated() {
    for (from, to) in [(64, 32), (5, 2), (7, 3), (3, 1), (101, 50), (1, 1)] {
        for index in 0..to {
            let (first, weights) = weights(index, from, to);
            let centre = (index as f64 + 0.5) * from as f64 / to as f64;
            let moment = |power: i32| -> f64 {
                let place = |tap: usize| (first + tap as isize) as f64 + 0.5 - centre;
                (0..TAPS).map(|tap| f64::from(weights[tap]) * place(tap).powi(power)).sum()
            };
            let moments = [moment(0), moment(1), moment(2)];
            for (found, wanted) in moments.into_iter().zip([1.0, 0.0, 3.0 * VARIANCE]) {
                assert!(
                    (found - wanted).abs() < 2e-5,
                    "{found}, not {wanted}: texel {index} of {to} from {from}"
                );
            }
            assert!(weights.iter().all(|weight| *weight >= -1e-7), "{weights:?}");
        }
    }
}

/// Splines reproduce parabolas but for a constant, their variance; and a step becomes the error function.
#[test]
fn blurs_have_the_variance_that_is_stated() {
    let (width, height) = (1024, 1);
    let image: Vec<[f32; 4]> = (0..width)
        .map(|x| {
            let x = (x as f32 + 0.5) / 512.0 - 1.0;
            [x * x, if x > 0.0 { 1.0 } else { 0.0 }, 0.0, 1.0]
        })
        .collect();
    let prefiltered = prefilter(width, height, &image);
    for (index, level) in prefiltered.levels().iter().enumerate().take(6) {
        let deviation = (VARIANCE * (4.0_f64.powi(index as i32) - 1.0)).sqrt() / 512.0;
        for (column, texel) in level.texels.iter().enumerate() {
            let x = 2.0 * (column as f64 + 0.5) / level.width as f64 - 1.0;
            if x.abs() + 6.0 * deviation > 1.0 {
                continue;
            }
            let (found, wanted) = (f64::from(texel[0]), x * x + deviation * deviation);
            assert!((found - wanted).abs() < 1e-6, "parabola: {found}, not {wanted}: level {index} at {x}");
            if index >= 2 {
                let (found, wanted) = (f64::from(texel[1]), normal_distribution(x / deviation));
                assert!((found - wanted).abs() < 0.006, "step: {found}, not {wanted}: level {index} at {x}");
            }
        }
    }
}

/// Share of a normal distribution below `x` deviations, by Simpson's rule.
fn normal_distribution(x: f64) -> f64 {
    let x = x.clamp(-8.0, 8.0);
    let density = |t: f64| (-0.5 * t * t).exp() / core::f64::consts::TAU.sqrt();
    let step = x / 200.0;
    let sum: f64 = (0..100)
        .map(|i| {
            let t = 2.0 * f64::from(i) * step;
            density(t) + 4.0 * density(t + step) + density(t + 2.0 * step)
        })
        .sum();
    0.5 + sum * step / 3.0
}

#[test]
fn bytes_are_those_of_half_precision_mipmaps() {
    let mut random = Random::new(5);
    let mut image = noise(&mut random, [8, 4]);
    image[0] = [1e9, -1e9, 0.5, 1.0];
    let prefiltered: Prefiltered = prefilter(8, 4, &image);
    let bytes = prefiltered.bytes();
    assert_eq!(bytes.len(), 8 * (8 * 4 + 4 * 2 + 2 + 1));
    // 65504, its negative, 0.5 and 1 in half precision.
    assert_eq!(bytes[..8], [0xFF, 0x7B, 0xFF, 0xFB, 0x00, 0x38, 0x00, 0x3C]);
}

#[test]
fn ktx2_files_hold_every_level() {
    let mut random = Random::new(9);
    let prefiltered = prefilter(20, 6, &noise(&mut random, [20, 6]));
    let bytes = prefiltered.ktx2();
    let reader = ktx2::Reader::new(&bytes).expect("a KTX 2.0 file");
    let header = reader.header();
    assert_eq!(header.format, Some(ktx2::Format::R16G16B16A16_SFLOAT));
    assert_eq!((header.pixel_width, header.pixel_height, header.level_count), (20, 6, 5));
    assert_eq!(reader.levels().count(), prefiltered.levels().len());
    for (found, wanted) in reader.levels().zip(prefiltered.levels()) {
        assert!(found.data == wanted.bytes(), "{} x {}", wanted.width, wanted.height);
    }
}
