//! From a BRDF to sums of lobes.
//!
//! The whole table is fitted at once, first with few texels and then with ever more of them, each time starting from
//! the interpolated last result: so each lobe of a sum keeps its part over the whole table. The last fit compares at the
//! centres between the texels, too.

mod field;
mod level;
mod sum;
mod view;

use core::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::{Family, Layout, Settings, decode};
use crate::lobe::Lobe;
use crate::shade::LTC_MEAN_SHIFT;
use field::{Field, resample};
use level::{Level, separate};
use sum::Cut;

/// A fitted table of sums of lobes before it is packed.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedLobes {
    /// Texels along each axis.
    pub size: usize,
    /// How many lobes each texel has, 2 or 3.
    pub count: usize,
    /// `size`² texels, roughness fastest.
    pub texels: Vec<LobesTexel>,
}

/// The lobes of a texel; where there are two, the third one is all zeros.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LobesTexel {
    /// Their shapes in the parameters of [`Layout::Native`].
    pub shapes: [[f64; 4]; 3],
    /// Their parts of ∫ f·cos over the hemisphere.
    pub albedos: [f64; 3],
    /// By how much their parts of ∫ f·cos·(1 − v·h)⁵ over the hemisphere exceed what the mean direction of a light all
    /// around promises; see [`ltc_lobes_part`](crate::shade::ltc_lobes_part).
    pub excesses: [f64; 3],
    /// ∫ f·cos·(1 − v·h)⁵ over the hemisphere, by all lobes.
    pub fresnel: f64,
}

const LAYOUT: Layout = Layout::Native;

/// Texels along each axis of the smallest table, about.
const COARSEST: usize = 4;

/// Steps of the first fit, and of each further one; most end sooner.
const STEPS: (usize, usize) = (60, 20);

/// Nodes of the fit of the single lobes.
const SINGLE_NODES: usize = 24;

/// Fits a whole table of sums of `count` lobes. The result depends on nothing but the arguments: not on the number of
/// threads, nor on their timing.
///
/// `progress` is told the share of the work done, 0…1, from any thread.
///
/// # Panics
///
/// If `count` is neither 2 nor 3, or `size` < 2.
pub fn bake_lobes(
    family: &dyn Family,
    count: usize,
    size: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> FittedLobes {
    assert!(size >= 2, "a table needs at least 2 texels along each axis, not {size}");
    match count {
        2 => bake::<2, 9>(family, size, [0.95, 1.1], progress),
        3 => bake::<3, 14>(family, size, [0.9, 1.0, 1.3], progress),
        _ => panic!("there are tables of two and of three lobes, not of {count}"),
    }
}

/// `widths` says how much narrower or wider than a single lobe each lobe is at first. Of a dozen choices these were among
/// the half that led close to the least loss.
fn bake<const N: usize, const D: usize>(
    family: &dyn Family,
    size: usize,
    widths: [f64; N],
    progress: &(dyn Fn(f64) + Sync),
) -> FittedLobes {
    let mut sizes = vec![size];
    while sizes[0] > COARSEST {
        sizes.insert(0, sizes[0].div_ceil(2));
    }
    // In places compared, of which the last table has two a texel. The single lobes count as one step.
    let work: usize = size * size + sizes.iter().map(|size| 2 * size * size * STEPS.1).sum::<usize>();
    let done = AtomicUsize::new(0);
    let advance = |places: usize| {
        let before = done.fetch_add(places, Ordering::Relaxed);
        progress(((before + places) as f64 / work as f64).min(1.0));
    };

    // Sharp lobes at grazing views change too much between the texels of a coarse table. But they differ little from a
    // single lobe, so that the differences are what goes from one table to the next.
    let settings = Settings { nodes: SINGLE_NODES, ..Settings::native(size) };
    let single = super::bake(family, settings, &|_| ());
    let single: Field<4> = single.texels.iter().map(|texel| texel.parameters).collect();
    advance(size * size);
    let mut level = Level::new(family, sizes[0], sizes.len() == 1);
    let mut base = resample(&single, size, sizes[0]);
    let mut field = level.fit::<N, D>(spread(&base, &level, widths), STEPS.0, &advance);
    for &next in &sizes[1..] {
        let finer = Level::new(family, next, next == size);
        shift::<N, D>(&mut field, &base, -1.0);
        field = resample(&field, level.size, next);
        base = resample(&single, size, next);
        shift::<N, D>(&mut field, &base, 1.0);
        finer.mend::<N, D>(&mut field, &base);
        field = finer.fit::<N, D>(field, STEPS.1, &advance);
        level = finer;
    }
    let texels =
        (0..field.len()).into_par_iter().map(|texel| finish::<N, D>(&level, texel, &field[texel])).collect();
    progress(1.0);
    FittedLobes { size, count: N, texels }
}

/// Adds `factor` times the single lobes to all lobes.
fn shift<const N: usize, const D: usize>(field: &mut Field<D>, single: &Field<4>, factor: f64) {
    for (numbers, single) in field.iter_mut().zip(single) {
        for i in 0..N {
            for k in 0..4 {
                numbers[5 * i + k] += factor * single[k];
            }
        }
    }
}

/// The single lobes N times, with other widths and equal weights.
fn spread<const N: usize, const D: usize>(single: &Field<4>, level: &Level, widths: [f64; N]) -> Field<D> {
    let texel = |(single, [albedo, _]): (&[f64; 4], &[f64; 2])| {
        let mut numbers = [0.0; D];
        for i in 0..N {
            numbers[5 * i..5 * i + 4].copy_from_slice(single);
            numbers[5 * i + 3] *= widths[i];
            if i + 1 < N {
                numbers[5 * i + 4] = albedo / N as f64;
            }
        }
        numbers
    };
    let mut field: Field<D> = single.iter().zip(&level.amplitudes).map(texel).collect();
    level.mend::<N, D>(&mut field, single);
    field
}

/// Adds the Schlick parts. Each lobe has the part of its own shape, in proportion.
fn finish<const N: usize, const D: usize>(level: &Level, texel: usize, numbers: &[f64; D]) -> LobesTexel {
    let [albedo, fresnel] = level.amplitudes[texel];
    let (shapes, weights) = separate::<N, D>(numbers, albedo);
    let place = &level.places[texel];
    let lobes = shapes.map(|shape| decode(LAYOUT, &shape, place.alpha, place.cosine));
    let parts: [f64; N] = core::array::from_fn(|i| {
        weights[i] * Cut::new(lobes[i]).map_or(0.0, |cut| cut.schlick(&level.views[texel]))
    });
    let scale = fresnel / parts.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    let mut result = LobesTexel { fresnel, ..LobesTexel::default() };
    for i in 0..N {
        result.shapes[i] = shapes[i];
        result.albedos[i] = weights[i];
        result.excesses[i] = scale * parts[i] - weights[i] * schlick_all_around(&lobes[i], place.cosine);
    }
    result
}

/// (1 − v·h)⁵ in the mean direction of a light all around, as the include finds it.
fn schlick_all_around(lobe: &Lobe, cosine: f64) -> f64 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    // The vector form factor of the lune between the lobe's horizon and the surface's: half the sum of the unit vectors
    // across its two edges.
    let radius = (lobe.x * lobe.x + lobe.y * lobe.y).sqrt();
    let (x, z) = (-0.5 * lobe.y / radius, 0.5 + 0.5 * lobe.x / radius);
    let height = z + LTC_MEAN_SHIFT * (x * x + z * z);
    let toward = glam::DVec2::new(lobe.w * x - lobe.z * height, lobe.x * height - lobe.y * x);
    let along = glam::DVec2::new(sine, cosine).dot(toward.normalize_or_zero());
    (1.0 - (0.5 + 0.5 * along).clamp(0.0, 1.0).sqrt()).powi(5)
}
