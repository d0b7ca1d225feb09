//! How far values may be from exact arithmetic, for any case, from its geometry alone: what the documentation states, so that
//! cases which a relation makes of others have bounds of their own.

use glam::DVec3;

use super::sight::{Sight, coordinate_rounding, is_along_an_axis};
use crate::light::{is_convex_quad, polygon_normal};
use crate::stability::families::tube_bounds;
use crate::stability::level::VANISHING;
use crate::stability::{Case, Shape};

/// Largest errors of the form factor, of specular light and of its Schlick part; infinite where physics alone bounds them.
pub type Promise = [f64; 3];

/// Nothing is promised but physics.
pub const PHYSICAL: Promise = [f64::INFINITY; 3];

/// Within these extents no product of coordinates leaves the range of single precision.
const EXTENTS: core::ops::Range<f64> = 1e-18..1e18;

/// Largest component of a normal or view within which its digits are those of a normal number.
const DIRECTIONS: core::ops::Range<f32> = 1e-18..1e18;

/// Share of its distance below which a light is a distant one, and below which nothing is promised of it.
const DISTANT: core::ops::Range<f64> = 1e-5..0.1;

/// A light so close to the point, as a share of its own reach, that its side may be taken for the other.
const TOUCHING: f64 = 4e-7;

/// What is promised of a case whose form factor is about `value`.
///
/// The form factor: 2e-6, and 6e-8 times the ratio of an edge's farther end to its own distance; twice that of polygons; 1e-4 of
/// its value for distant lights, and 2e-6 over their size more on the horizon of a turned surface. Specular light: 4e-6 over
/// the product of α and the cosine of the view, twice that of polygons, a hundredth of it of distant lights. Its Schlick part
/// twice that.
pub fn promise(case: &Case, value: f64) -> Promise {
    let extent = case.position.abs().max_element().max(reach(case));
    let direction = |v: glam::Vec3| DIRECTIONS.contains(&v.abs().max_element());
    let vanishes = |v: glam::Vec3| v.to_array().iter().any(|x| *x != 0.0 && x.abs() <= VANISHING);
    let is_lost = case.shape.vertices().iter().any(|vertex| vanishes(*vertex - case.position));
    if is_lost || !direction(case.normal) || !direction(case.view) {
        return PHYSICAL;
    }
    if !EXTENTS.contains(&f64::from(extent)) || !(0.0..=1.0).contains(&case.roughness) {
        return PHYSICAL;
    }
    let [form_factor, specular] = match &case.shape {
        Shape::Quad { .. } | Shape::Polygon { .. } => flat(case, value),
        Shape::Disk { center, half_x, half_y, .. } => {
            disk(case, *center - case.position, *half_x, *half_y, value)
        }
        Shape::Sphere { center, radius } => {
            sphere(case, (*center - case.position).as_dvec3(), *radius, value)
        }
        Shape::Tube { start, end, radius, .. } => tube(case, [*start, *end], *radius),
    };
    // The azimuth of a view from straight below is noise.
    let cosine = case.view.as_dvec3().normalize_or_zero().dot(case.normal.as_dvec3().normalize_or_zero());
    let specular = if cosine <= 0.0 && case.tilt() < 1e-5 { f64::INFINITY } else { specular };
    // Next to the normal the azimuth is noise, and the table's lobes are round to half precision.
    let specular = specular + if case.tilt() < 1e-5 { 3e-5 } else { 0.0 };
    [form_factor, specular, 2.0 * specular]
}

/// Largest coordinate of the light.
fn reach(case: &Case) -> f32 {
    let of = |vectors: &[glam::Vec3]| vectors.iter().map(|v| v.abs().max_element()).fold(0.0, f32::max);
    match &case.shape {
        Shape::Quad { corners, .. } => of(corners),
        Shape::Polygon { vertices, .. } => of(vertices),
        Shape::Disk { center, half_x, half_y, .. } => of(&[*center, *half_x, *half_y]),
        Shape::Sphere { center, radius } => of(&[*center]).max(*radius),
        Shape::Tube { start, end, radius, .. } => of(&[*start, *end]).max(*radius),
    }
}

/// What a distant light's errors may be: a share of its value, where that is at least what a tenth of the light, turned to
/// the point, would give.
fn distant(case: &Case, value: f64, size: f64, area: f64, directions: &[DVec3]) -> [f64; 2] {
    let normal = case.normal.as_dvec3().normalize_or_zero();
    let heights = directions.iter().map(|direction| direction.normalize_or_zero().dot(normal));
    let (low, high) = heights.fold((1.0_f64, 0.0_f64), |(low, high), h| (low.min(h), high.max(h)));
    let least = 0.1 * area * high / core::f64::consts::PI;
    // A rounded normal leaves the horizon itself uncertain by 1e-7 of the distance.
    let turned = !is_along_an_axis(case.normal) && low < 3e-3;
    let share = 1e-4 + if turned { 2e-6 / size } else { 0.0 };
    // Of a light that the horizon all but hides, that much of what it would give straight ahead.
    let hidden = 2e-6 * area / core::f64::consts::PI;
    [(share * value.max(least)).max(hidden), 4e-8 / case.sharpness()]
}

fn flat(case: &Case, value: f64) -> [f64; 2] {
    let seen = case.seen();
    let is_quad = matches!(case.shape, Shape::Quad { .. });
    let is_simple = polygon_normal(&seen).is_ok() && (!is_quad || is_convex_quad(&seen));
    let Some(sight) = Sight::of(&seen).filter(|_| is_simple) else { return [f64::INFINITY; 2] };
    let is_bent = sight.bend > 4.0 * coordinate_rounding(case);
    // How far rounding may move the plane of the light where the point is; that of a needle the farther, the narrower it is.
    let narrow = (sight.size * sight.size / sight.area).max(1.0);
    let uncertain = match sight.is_level {
        true => 0.0,
        false => narrow * (4.0 * TOUCHING * sight.farthest).max(8.0 * coordinate_rounding(case)),
    };
    let may_turn = sight.height == 0.0 || sight.height < uncertain;
    // In the plane of a light that is not convex rounding may also bend it over the point.
    let is_touched = sight.is_surrounded && may_turn;
    if is_bent || is_touched || sight.size < DISTANT.start {
        return [f64::INFINITY; 2];
    }
    if sight.size < DISTANT.end {
        // A needle counts as a hundredth as wide as it is long, as a disk does.
        return distant(case, value, sight.size, sight.area.max(0.01 * sight.size * sight.size), &seen);
    }
    let twice = if is_quad { 1.0 } else { 2.0 };
    let close = 6e-8 * sight.ratio;
    let form_factor = twice * close.max(2e-6);
    if sight.nearest.min(sight.distance) < TOUCHING * sight.farthest {
        return [form_factor, f64::INFINITY];
    }
    // Lights much larger than their distance, and coordinates much larger than either.
    let far = f64::from(case.position.abs().max_element());
    let large = if sight.farthest.max(far) > 10.0 * sight.distance { 2.0 } else { 1.0 };
    let slack = if sight.ratio > 25.0 { close } else { 0.0 };
    // The other side of a light next to which, but not on which, the point lies.
    let turned = if may_turn { uncertain / sight.nearest } else { 0.0 };
    let specular = twice * large * 4e-6 / case.sharpness() + slack + turned / case.sharpness();
    [form_factor + turned, specular]
}

fn disk(case: &Case, center: glam::Vec3, half_x: glam::Vec3, half_y: glam::Vec3, value: f64) -> [f64; 2] {
    let [center, x, y] = [center, half_x, half_y].map(|v| v.as_dvec3());
    let size = x.length().max(y.length());
    let area = x.cross(y);
    // Conjugate half-axes that are nearly parallel leave the disk's plane to rounding.
    if area.length() < 1e-3 * x.length() * y.length() || size == 0.0 {
        return [f64::INFINITY; 2];
    }
    let points: Vec<DVec3> = (0..64)
        .map(|k| {
            let (sine, cosine) = (f64::from(k) * core::f64::consts::TAU / 64.0).sin_cos();
            center + x * cosine + y * sine
        })
        .collect();
    let Some(sight) = Sight::of(&points) else { return [f64::INFINITY; 2] };
    if sight.size < DISTANT.start || (sight.is_inside && sight.height < 1e-5 * sight.farthest) {
        return [f64::INFINITY; 2];
    }
    if sight.size < DISTANT.end {
        let area = sight.area.max(0.01 * sight.size * sight.size);
        return distant(case, value, sight.size, area, &points);
    }
    // The polygon is inside the disk by 1/800 of its size.
    let rim = (sight.nearest - 2e-3 * size).max(0.0) / size;
    // Close to its face, too, the disk's own plane is uncertain by what its distance loses.
    let face = 1e-7 * sight.farthest / sight.height.max(f64::MIN_POSITIVE);
    [
        2e-6 + 1e-6 / rim + 3e-8 * sight.farthest / sight.height,
        (2e-6 + face) / case.sharpness() + 1.6e-5 / rim,
    ]
}

fn sphere(case: &Case, center: DVec3, radius: f32, value: f64) -> [f64; 2] {
    let (distance, radius) = (center.length(), f64::from(radius));
    let size = 2.0 * radius / distance;
    let gap = (distance / radius - 1.0).abs();
    // Next to its surface a point may count as inside or outside.
    if !(size >= DISTANT.start && gap > 3e-7) {
        return [f64::INFINITY; 2];
    }
    if size < DISTANT.end {
        let normal = case.normal.as_dvec3().normalize_or_zero();
        let rim = [center + normal * radius, center - normal * radius];
        let area = core::f64::consts::PI * (radius / distance).powi(2);
        return distant(case, value, size, area, &rim);
    }
    let alpha = f64::from(case.roughness.clamp(0.02, 1.0)).powi(2);
    let close = 1.0 / gap.min(1.0).sqrt();
    [2e-6 + 1e-7 * close, 2e-6 / case.sharpness() + 4e-8 * close / alpha]
}

fn tube(case: &Case, ends: [glam::Vec3; 2], radius: f32) -> [f64; 2] {
    let [start, end] = ends.map(|end| (end - case.position).as_dvec3());
    let side = end - start;
    let t = (-start.dot(side) / side.length_squared()).clamp(0.0, 1.0);
    let nearest = (start + side * t).length();
    // So short that rounding turns the axis, or all but touched, or as wide as far away.
    if !(side.length() > 1e-3 * nearest && nearest > 1.1 * f64::from(radius)) {
        return [f64::INFINITY; 2];
    }
    // Along the horizon rounding decides how much of the width is above it.
    let normal = case.normal.as_dvec3().normalize_or_zero();
    let heights = [start, end].map(|end| end.dot(normal));
    if heights[0].abs().max(heights[1].abs()) < 1.1 * f64::from(radius) {
        return [f64::INFINITY; 2];
    }
    let (form_factor, specular) = tube_bounds(case);
    [form_factor.max(1e-37), 2.0 * specular.max(1e-37)]
}
