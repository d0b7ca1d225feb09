//! What it changes of a light's values that rounding has moved it.

use core::f64::consts::{PI, TAU};

use super::sight::{Sight, from_segment};
use crate::stability::{Case, Shape};

/// Distance of the outline that the point sees, and the length along which it is that close at most; nothing where there
/// is no outline.
fn outline(case: &Case) -> Option<(f64, f64)> {
    let seen = |v: glam::Vec3| (v - case.position).as_dvec3();
    match case.shape {
        Shape::Quad { .. } | Shape::Polygon { .. } => {
            let sight = Sight::of(&case.seen())?;
            Some((sight.nearest, sight.size * sight.farthest))
        }
        Shape::Disk { center, half_x, half_y, .. } => {
            let [center, x, y] = [seen(center), half_x.as_dvec3(), half_y.as_dvec3()];
            let rim = (0..64).map(|k| {
                let (sine, cosine) = (TAU * f64::from(k) / 64.0).sin_cos();
                (center + x * cosine + y * sine).length()
            });
            let size = x.length() + y.length();
            // The nearest of the points may be 1/20 of the size along the rim from the nearest of all.
            let nearest = rim.fold(f64::INFINITY, f64::min);
            Some(((nearest - 2e-3 * size).max(1e-3 * nearest), TAU * size))
        }
        Shape::Sphere { center, radius } => {
            let (distance, radius) = (seen(center).length(), f64::from(radius));
            let tangent = (distance * distance - radius * radius).abs().sqrt();
            Some((tangent, TAU * radius))
        }
        Shape::Tube { start, end, radius, .. } => {
            let [start, end] = [seen(start), seen(end)];
            let radius = f64::from(radius);
            Some((from_segment(start, end) - radius, 2.0 * (start - end).length() + TAU * radius))
        }
    }
}

/// What it may change that every point of the outline is `moved` so far.
///
/// A sliver of width δ at distance g is seen under a width of δ / g at most; seen from there its length is no more than two
/// radians, and the sliver's form factor that over π. A lobe holds at most 1 / (α cos θ) of its light in a radian of width.
pub fn moved(case: &Case, moved: f64) -> [f64; 3] {
    let Some((nearest, length)) = outline(case) else { return [f64::INFINITY; 3] };
    let (width, length) = (moved / nearest.max(f64::MIN_POSITIVE), (length / nearest).min(2.0));
    let sharpness = case.sharpness();
    let alpha = f64::from(case.roughness.clamp(0.02, 1.0)).powi(2);
    let specular = width * (1.0 / sharpness).min(length / (alpha * sharpness));
    [width * length / PI, specular, 2.0 * specular]
}

/// What it may change that normal and view are `turned` by so many radians.
///
/// The form factor is the vector form factor times the normal; a lobe moves with the directions, a table of 64 texels along
/// each side by at most 32 of what it holds in a radian.
pub fn turned(case: &Case, turned: f64) -> [f64; 3] {
    let Some((nearest, length)) = outline(case) else { return [f64::INFINITY; 3] };
    let solid_angle = (length / nearest.max(f64::MIN_POSITIVE)).powi(2).min(1.0);
    let specular = 32.0 * turned / case.sharpness();
    [turned * solid_angle, specular, 2.0 * specular]
}

/// The sum of both.
pub fn and(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|part| a[part] + b[part])
}

/// What it may change that a flat light of which a vertex leaves the plane of the others is cut along another diagonal.
pub fn bent(case: &Case) -> [f64; 3] {
    Sight::of(&case.seen()).map_or([f64::INFINITY; 3], |sight| moved(case, sight.bend))
}
