//! The distance of lobes from the BRDF's own.

use core::f64::consts::{PI, TAU};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{Effort, model};
use crate::brdf::{Brdf, schlick};
use crate::report::data::{LobeRow, Part};
use crate::shade::{LtcLobe, ltc_surface, ltc_transform};
use crate::table::Table;

/// What stands in for f·cos and for f·cos·(1 − v·h)⁵ towards a light direction above the surface, in the surface's frame
/// with the view in the xz-plane, x ≥ 0; any positive factor on either changes nothing.
pub type Density = Box<dyn Fn(DVec3) -> [f64; 2]>;

/// The densities at a roughness and a cosine of the view.
pub type Lobes<'a> = &'a (dyn Fn(f64, f64) -> Density + Sync);

/// The density of linearly transformed cosines (Heitz et al. 2016, equation 1), each with its albedo, and times (1 − v·h)⁵
/// for Schlick's part: what the include makes of small lights. `view` is that of the lobes' surface.
pub fn cosine_density(lobes: Vec<LtcLobe<f64>>, view: DVec3) -> Density {
    Box::new(move |light| {
        let plain = lobes.iter().map(|lobe| {
            let moved = ltc_transform(lobe, light);
            let determinant = lobe.axis_x.dot(lobe.normal_x);
            lobe.albedo / lobe.share * determinant * moved.z.max(0.0) / (PI * moved.length_squared().powi(2))
        });
        let plain: f64 = plain.sum();
        [plain, plain * schlick(view, light)]
    })
}

/// The lobes of a table in the include's layout.
pub fn table_lobes(table: &Table) -> impl Fn(f64, f64) -> Density + Sync {
    move |roughness, cosine| {
        let view = view(cosine);
        let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, view, roughness);
        cosine_density(vec![table.lobe(&surface)], view)
    }
}

fn view(cosine: f64) -> DVec3 {
    DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine)
}

/// Distances between the normalised lobes of `brdf` and of `density` for both parts: half the integral of |difference|
/// over the hemisphere, 0 to 1.
///
/// Integrated at `count`² / 2 directions of the model's own sampling over half the hemisphere and a quarter of that evenly,
/// weighed by the balance heuristic (Veach 1997). A density whose lobe lies where neither samples densely has a
/// distance of about 1 whatever its integral is found to be.
pub fn total_variation(
    brdf: &dyn Brdf,
    cosine: f64,
    density: &dyn Fn(DVec3) -> [f64; 2],
    count: usize,
) -> [f64; 2] {
    let view = view(cosine);
    let (own, even) = ((count * (count / 2)) as f64, ((count / 2) * (count / 4)) as f64);
    let mut nodes: Vec<(f64, [f64; 2], [f64; 2])> = Vec::with_capacity(count * count);
    let mut add = |light: DVec3| {
        let chance = own * brdf.pdf(view, light) + even / TAU;
        if light.z > 0.0 {
            let value = brdf.evaluate(view, light) * light.z;
            nodes.push((1.0 / chance, [value, value * schlick(view, light)], density(light)));
        }
    };
    for (i, j) in grid(count) {
        add(brdf.sample(view, DVec2::new(i, j)));
    }
    for (z, turn) in grid(count / 2) {
        let ((sine, cosine), radius) = ((TAU * turn).sin_cos(), (1.0 - z * z).sqrt());
        add(DVec3::new(radius * cosine, radius * sine, z));
    }
    core::array::from_fn(|part| {
        let whole: f64 = nodes.iter().map(|(weight, exact, _)| weight * exact[part]).sum();
        let other: f64 = nodes.iter().map(|(weight, _, lobe)| weight * lobe[part]).sum();
        if whole <= 0.0 || other <= 0.0 {
            return if whole == other { 0.0 } else { 1.0 };
        }
        let differences = nodes
            .iter()
            .map(|(weight, exact, lobe)| weight * (exact[part] / whole - lobe[part] / other).abs());
        0.5 * differences.sum::<f64>()
    })
}

/// Centres of `count` by `count` / 2 cells over 0…1 by 0…½.
fn grid(count: usize) -> impl Iterator<Item = (f64, f64)> {
    let place = move |index: usize, cells: usize| (index as f64 + 0.5) / cells as f64;
    let rows = count / 2;
    (0..count).flat_map(move |i| (0..rows).map(move |j| (place(i, count), place(j, 2 * rows))))
}

/// Distances over a grid of roughness 0.1…1 by cosines of the view 0.05…1: mean, largest, and where that is, for the plain
/// part and for Schlick's.
pub fn lobe_rows(method: &str, lobes: Lobes, effort: Effort) -> [LobeRow; 2] {
    let (cells, count) = match effort {
        Effort::Quick => (8, 48),
        Effort::Full => (20, 128),
    };
    let at = |low: f64, index: usize| low + (1.0 - low) * index as f64 / (cells - 1) as f64;
    let distances: Vec<([f64; 2], [f64; 2])> = (0..cells * cells)
        .into_par_iter()
        .map(|index| {
            let place @ [roughness, cosine] = [at(0.1, index % cells), at(0.05, index / cells)];
            let density = lobes(roughness, cosine);
            (place, total_variation(&model(roughness), cosine, &density, count))
        })
        .collect();
    [Part::Specular, Part::Fresnel].map(|label| {
        let part = usize::from(label == Part::Fresnel);
        let worst = distances.iter().max_by(|a, b| a.1[part].total_cmp(&b.1[part]));
        let (worst, maximum) = worst.map_or(([0.0; 2], 0.0), |(place, distance)| (*place, distance[part]));
        LobeRow {
            method: method.to_owned(),
            part: label,
            mean: distances.iter().map(|(_, distance)| distance[part]).sum::<f64>() / distances.len() as f64,
            maximum,
            worst,
        }
    })
}
