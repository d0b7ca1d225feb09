//! The closed forms that stand in for the table and for a cut at a horizon.

use core::f64::consts::PI;

use rayon::prelude::*;

use super::angle::eliminate;
use super::single::Target;
use super::{Layout, Settings, decode, encode, ggx};
use crate::lobe::Lobe;
use crate::shade::{FittedLobe, LTC_ROUGHNESS_FLOOR};

/// Views and roughnesses along each axis at which lobes are fitted.
const PLACES: usize = 25;

/// Quadrature nodes across a lobe.
const NODES: usize = 32;

/// A share of Schlick's part below which its error counts absolutely.
const FAINT: f64 = 0.003;

/// The best lobe at one roughness and view.
struct Place {
    roughness: f64,
    cosine: f64,
    albedo: f64,
    fresnel: f64,
    /// (X, Y, Z, W).
    shape: [f64; 4],
    /// Half the loss's curvature there, by the same four.
    hessian: [[f64; 4]; 4],
    /// How many random views it stands for: their cosines are even, and grazing ones count a little besides.
    weight: f64,
}

/// Fits the closed form of the specular lobe to GGX.
///
/// Each view's own best lobe is found as for a table. The coefficients of the shape are those for which the loss,
/// as far as its curvature at each of these lobes tells, is the least over all of them: an error counts as much as it
/// changes the lobe. The albedo's are the least squares, those of Schlick's part the least squares of relative errors. Which
/// monomials to take was found by trying, one at a time, which one lowers the loss most.
pub fn fit_lobe_formula() -> FittedLobe {
    let columns: Vec<Vec<Place>> = (0..PLACES).into_par_iter().map(column).collect();
    let places: Vec<&Place> = columns.iter().flatten().collect();

    let monomials = |r: f64, c: f64| -> [Vec<f64>; 4] {
        let (r2, c2) = (r * r, c * c);
        [
            vec![r2, r2 * r, r2 * r2, r * c, r * c2],
            vec![c, r2 * r2 * c, r2, r2 * r],
            vec![r, r * c, r2 * r],
            vec![1.0, r2, c2, r2 * r2 * c2],
        ]
    };
    // Normal equations of the sum of (p − p*)ᵀ H (p − p*) with p = Σ coefficient · monomial.
    let owner: Vec<(usize, usize)> =
        [5, 4, 3, 4].into_iter().enumerate().flat_map(|(k, n)| (0..n).map(move |i| (k, i))).collect();
    let mut rows = vec![vec![0.0; owner.len() + 1]; owner.len()];
    for place in &places {
        let values = monomials(place.roughness, place.cosine);
        let weight = 2.0 * place.cosine.sqrt() + 0.05;
        let weight = if place.roughness < 0.06 { 0.3 * weight } else { weight };
        for (row, &(k, i)) in rows.iter_mut().zip(&owner) {
            for (entry, &(l, j)) in row.iter_mut().zip(&owner) {
                *entry += weight * values[k][i] * place.hessian[k][l] * values[l][j];
            }
            let pull: f64 = (0..4).map(|l| place.hessian[k][l] * place.shape[l]).sum();
            row[owner.len()] += weight * values[k][i] * pull;
        }
    }
    let shape = eliminate(rows);

    let albedo = least_squares(places.iter().map(|place| {
        let (r, c) = (place.roughness, place.cosine);
        (vec![r, r * c * c, r * r * r * c, r.powi(4) * c], place.albedo - 1.0, place.weight)
    }));
    let fresnel = least_squares(places.iter().map(|place| {
        let (r, u) = (place.roughness, 1.0 - place.cosine);
        let z = r * u;
        let root = place.fresnel.powf(0.2);
        let slope = 5.0 * root.powi(4) / (place.fresnel + FAINT);
        (vec![u, r, z * z, z.powi(3), z.powi(4)], root, place.weight * slope * slope)
    }));
    let take = |from: usize| shape[from];
    FittedLobe {
        x: core::array::from_fn(take),
        y: core::array::from_fn(|i| shape[5 + i]),
        z: core::array::from_fn(|i| shape[9 + i]),
        w: core::array::from_fn(|i| shape[12 + i]),
        albedo: core::array::from_fn(|i| albedo[i]),
        fresnel: core::array::from_fn(|i| fresnel[i]),
    }
}

/// The best lobes at one roughness, from the normal view to the grazing one.
fn column(index: usize) -> Vec<Place> {
    let last = (PLACES - 1) as f64;
    let layout = Layout::Native;
    let settings = Settings::native(PLACES);
    let roughness = LTC_ROUGHNESS_FLOOR + (1.0 - LTC_ROUGHNESS_FLOOR) * index as f64 / last;
    let alpha = roughness * roughness;
    let brdf = ggx(roughness);
    let mut start = None;
    let mut places = Vec::with_capacity(PLACES);
    for step in 0..PLACES {
        let cosine = layout.cosine(1.0 - step as f64 / last);
        let target = Target::new(brdf.as_ref(), cosine, NODES, 60);
        let starts = match start {
            Some(start) => vec![decode(layout, &start, alpha, cosine)],
            None => layout.starts(alpha, cosine).to_vec(),
        };
        let fits = starts.into_iter().map(|start| {
            let lobe = target.fit(start, [true; 4], settings.goal(), 80);
            (target.normal(&lobe, settings.goal()), lobe)
        });
        let best = fits.min_by(|a, b| a.0.loss.total_cmp(&b.0.loss));
        let (normal, lobe) = best.unwrap_or((Default::default(), Lobe::IDENTITY));
        let shape = encode(layout, &lobe, alpha, cosine);
        start = Some(shape);
        let (_, scale) = layout.affine(alpha, cosine);
        let mut hessian: [[f64; 4]; 4] =
            core::array::from_fn(|i| core::array::from_fn(|j| scale[i] * scale[j] * normal.hessian[i][j]));
        // What the loss leaves open, as Y and Z along the normal, is drawn to the fitted lobe.
        let trace: f64 = (0..4).map(|i| hessian[i][i]).sum();
        for i in 0..4 {
            hessian[i][i] += 1e-9 * trace;
        }
        places.push(Place {
            roughness,
            cosine,
            albedo: target.albedo,
            fresnel: target.fresnel,
            shape,
            hessian,
            weight: 2.0 * cosine + 0.02,
        });
    }
    places
}

/// The least squares of (values, target, weight).
fn least_squares(samples: impl Iterator<Item = (Vec<f64>, f64, f64)>) -> Vec<f64> {
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for (values, target, weight) in samples {
        if rows.is_empty() {
            rows = vec![vec![0.0; values.len() + 1]; values.len()];
        }
        for (row, value) in rows.iter_mut().zip(&values) {
            for (entry, other) in row.iter_mut().zip(values.iter().chain([&target])) {
                *entry += weight * value * other;
            }
        }
    }
    eliminate(rows)
}

/// The form factor of a round light of the half-angle whose sine is given, the cosine between whose direction and
/// the horizon's normal is `tilt`: by rings around that direction, each of which the horizon cuts at an angle.
fn round_above(sine: f64, tilt: f64) -> f64 {
    const RINGS: usize = 400;
    let steep = (1.0 - tilt * tilt).max(0.0).sqrt();
    let half_angle = sine.min(1.0).asin();
    // The rings lie evenly, and their weights are those of the midpoint rule.
    let width = half_angle / RINGS as f64;
    let sum: f64 = (0..RINGS)
        .map(|ring| {
            let (s, c) = ((ring as f64 + 0.5) * width).sin_cos();
            let (level, swing) = (c * tilt, s * steep);
            let half = if level >= swing {
                PI
            } else if level <= -swing {
                0.0
            } else {
                (-level / swing).acos()
            };
            2.0 * (level * half + swing * half.sin()) * s * width
        })
        .sum();
    sum / PI
}

/// Coefficients of the include's `ltc_round_above`, by the cosine of the half-angle, its square and the offset, and the
/// largest error of the form factor: those for which the largest one is the least, by weights that grow where it
/// is large (Lawson 1961).
pub fn fit_round_above() -> ([f64; 3], f64) {
    let mut samples = Vec::new();
    for i in 0..24 {
        let whole = 0.002 + 0.996 * i as f64 / 23.0;
        for j in 0..20 {
            let offset = 0.999 * j as f64 / 19.0;
            let sine = whole.sqrt();
            let above = round_above(sine, offset * sine);
            let reach = whole * sine;
            // What the form is to give: 1 − (1 − offset²)·missing = 2·above / reach − offset.
            let missing = (1.0 - (2.0 * above / reach - offset)) / (1.0 - offset * offset);
            let depth = (1.0 - whole).sqrt();
            let scale = 0.5 * reach * (1.0 - offset * offset);
            samples.push((vec![depth, depth * depth, offset * offset], missing, scale));
        }
    }
    let mut weights = vec![1.0; samples.len()];
    let mut best = ([0.0; 3], f64::INFINITY);
    for _ in 0..400 {
        let weighted = samples
            .iter()
            .zip(&weights)
            .map(|((values, target, scale), weight)| (values.clone(), *target, weight * scale * scale));
        let fit = least_squares(weighted);
        let errors: Vec<f64> = samples
            .iter()
            .map(|(values, target, scale)| {
                let value: f64 = values.iter().zip(&fit).map(|(v, c)| v * c).sum();
                scale * (value - target).abs()
            })
            .collect();
        let largest = errors.iter().copied().fold(0.0, f64::max);
        if largest < best.1 {
            best = ([fit[0], fit[1], fit[2]], largest);
        }
        for (weight, error) in weights.iter_mut().zip(&errors) {
            *weight *= (error / largest + 1e-3).powf(0.1);
        }
        let sum: f64 = weights.iter().sum();
        for weight in &mut weights {
            *weight /= sum;
        }
    }
    best
}
