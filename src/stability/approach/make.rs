//! The surfaces and lights of the approaches.

use core::f64::consts::TAU;

use glam::{DQuat, DVec3};

use super::setting::Setting;
use crate::light::Light;
use crate::shade::ltc_surface;
use crate::table::Table;

/// Numbers that fill the unit cube evenly (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
pub(super) struct Variation(pub usize);

impl Variation {
    /// The number of an axis, 0 to 5, between two others.
    fn between(&self, axis: usize, low: f64, high: f64) -> f64 {
        // The root of x⁷ = x + 1.
        const GENERATOR: f64 = 1.112_775_684_278_705_5;
        let step = GENERATOR.powi(-(axis as i32 + 1));
        low + (high - low) * (0.5 + step * self.0 as f64).fract()
    }
}

/// Upwards, at the origin, seen from a direction that varies, with a roughness.
fn over(light: Light, roughness: f64, variation: &Variation) -> Setting {
    let cosine = variation.between(4, 0.3, 0.9);
    let azimuth = variation.between(5, 0.0, TAU);
    Setting { position: DVec3::ZERO, normal: DVec3::Z, view: from_polar(cosine, azimuth), roughness, light }
}

fn from_polar(cosine: f64, azimuth: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).sqrt();
    DVec3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine)
}

fn polygon(points: [DVec3; 4]) -> Light {
    Light::Polygon { points: points.to_vec(), two_sided: false }
}

/// The rectangle around a centre with half-edges `x` and `y`; it emits to the side of x × y.
fn rectangle(centre: DVec3, x: DVec3, y: DVec3) -> Light {
    polygon([centre - x - y, centre + x - y, centre + x + y, centre - x + y])
}

/// A square of a size around a centre, that faces the origin at an angle, turned in its plane.
fn facing(centre: DVec3, size: f64, slant: f64, turn: f64) -> Light {
    let [x, y, normal] = facing_axes(centre, turn);
    let (x, normal) = (x * slant.cos() + normal * slant.sin(), normal * slant.cos() - x * slant.sin());
    debug_assert!(normal.dot(centre) < 0.0);
    rectangle(centre, x * (0.5 * size), y * (0.5 * size))
}

/// Axes of a plane through a centre that faces the origin, turned about the third, which points to the origin.
fn facing_axes(centre: DVec3, turn: f64) -> [DVec3; 3] {
    let normal = -centre.normalize();
    let x = DQuat::from_axis_angle(normal, turn) * normal.any_orthonormal_vector();
    [x, normal.cross(x), normal]
}

/// A square that stands on the floor.
fn standing(gap: f64, roughness: f64, variation: &Variation) -> Setting {
    let width = variation.between(0, 0.5, 2.0);
    let height = variation.between(1, 0.5, 2.0);
    let aside = variation.between(2, -0.4, 0.4) * width;
    let at = |x: f64, z: f64| DVec3::new(aside + x * width, gap, z * height);
    over(polygon([at(-1.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(-1.0, 1.0)]), roughness, variation)
}

pub(super) fn gap(gap: f64, variation: &Variation) -> Setting {
    standing(gap, 0.3, variation)
}

pub(super) fn gap_glossy(gap: f64, variation: &Variation) -> Setting {
    standing(gap, variation.between(3, 0.1, 0.5), variation)
}

pub(super) fn ceiling(gap: f64, variation: &Variation) -> Setting {
    let aside = DVec3::new(variation.between(0, -0.7, 0.7), variation.between(1, -0.7, 0.7), gap);
    let azimuth = variation.between(2, 0.0, TAU);
    let (x, y) =
        (DVec3::new(azimuth.cos(), azimuth.sin(), 0.0), DVec3::new(azimuth.sin(), -azimuth.cos(), 0.0));
    over(rectangle(aside, x, y), 0.3, variation)
}

pub(super) fn vertex(gap: f64, variation: &Variation) -> Setting {
    let corner = from_polar(variation.between(0, 0.3, 0.9), variation.between(1, 0.0, TAU)) * gap;
    let [x, y, _] = facing_axes(corner, variation.between(2, 0.0, TAU));
    let width = variation.between(3, 0.5, 2.0);
    over(polygon([corner, corner + x * width, corner + (x + y) * width, corner + y * width]), 0.3, variation)
}

pub(super) fn edge_line(gap: f64, variation: &Variation) -> Setting {
    let along = from_polar(variation.between(0, 0.2, 0.8), variation.between(1, 0.0, TAU));
    let [x, y, _] = facing_axes(along, variation.between(2, 0.0, TAU));
    let start = along * variation.between(3, 0.1, 1.0) + x * gap;
    let corners = [start, start + along, start + along + y, start + y];
    // Its plane passes by as closely as the line of its edge does, on either side.
    let away = (corners[1] - corners[0]).cross(corners[3] - corners[0]).dot(start) > 0.0;
    let order = if away { [3, 2, 1, 0] } else { [0, 1, 2, 3] };
    over(polygon(order.map(|i| corners[i])), 0.3, variation)
}

fn distant(size: f64, roughness: f64, variation: &Variation) -> Setting {
    let distance = variation.between(3, 1.0, 4.0);
    let centre = from_polar(variation.between(0, 0.4, 0.95), variation.between(1, 0.0, TAU)) * distance;
    let turn = variation.between(2, 0.0, TAU);
    over(facing(centre, size * distance, 0.5, turn), roughness, variation)
}

pub(super) fn distance(size: f64, variation: &Variation) -> Setting {
    distant(size, 0.5, variation)
}

/// In the mirror direction, where the lobe is.
pub(super) fn distance_glossy(size: f64, variation: &Variation) -> Setting {
    let mut setting = distant(size, variation.between(3, 0.3, 0.8), variation);
    let distance = variation.between(3, 1.0, 4.0);
    let centre = DVec3::new(-setting.view.x, -setting.view.y, setting.view.z) * distance;
    setting.light = facing(centre, size * distance, 0.5, variation.between(2, 0.0, TAU));
    setting
}

/// Half of it above the horizon of the standard level's lobe.
pub(super) fn lobe_horizon(size: f64, variation: &Variation) -> Setting {
    let mut setting = distant(size, variation.between(3, 0.3, 0.8), variation);
    let surface = ltc_surface(setting.position, setting.normal, setting.view, setting.roughness);
    let horizon = Table::default().lobe::<f64>(&surface).axis_z.normalize();
    // On both horizons, turned along that of the lobe to where it is above that of the surface.
    let level = horizon.cross(DVec3::Z).normalize();
    let up = level.cross(horizon);
    let up = if up.z < 0.0 { -up } else { up };
    let azimuth = variation.between(0, 0.2, 1.4);
    let toward =
        level * azimuth.cos() + up * azimuth.sin() + horizon * (size * variation.between(1, -0.6, 0.6));
    let centre = toward.normalize() * variation.between(3, 1.0, 4.0);
    setting.light = facing(centre, size * centre.length(), 0.5, variation.between(2, 0.0, TAU));
    setting
}

fn upright(low: f64, high: f64, variation: &Variation) -> Setting {
    let distance = variation.between(0, 0.5, 3.0);
    let half = variation.between(1, 0.2, 1.0);
    let azimuth = variation.between(2, 0.0, TAU);
    let toward = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0);
    let side = DVec3::new(azimuth.sin(), -azimuth.cos(), 0.0);
    let at = |x: f64, z: f64| toward * distance + side * (half * x) + DVec3::Z * z;
    over(polygon([at(-1.0, low), at(1.0, low), at(1.0, high), at(-1.0, high)]), 0.3, variation)
}

pub(super) fn rising(height: f64, variation: &Variation) -> Setting {
    upright(-0.7, height, variation)
}

pub(super) fn lifted(height: f64, variation: &Variation) -> Setting {
    upright(height, height + 0.7, variation)
}

pub(super) fn sunk(depth: f64, variation: &Variation) -> Setting {
    upright(-depth, 0.7, variation)
}

pub(super) fn edge_on(angle: f64, variation: &Variation) -> Setting {
    let centre = from_polar(variation.between(0, 0.3, 0.9), variation.between(1, 0.0, TAU));
    let [x, y, normal] = facing_axes(centre, variation.between(2, 0.0, TAU));
    let half = variation.between(3, 0.2, 0.5);
    // Turned about y until only a sine of the angle is left.
    let x = x * angle.sin() - normal * angle.cos();
    over(rectangle(centre, x * half, y * half), 0.3, variation)
}

/// A surface that faces anywhere, with a light above it.
fn tilted(view: impl Fn(DVec3) -> DVec3, roughness: f64, variation: &Variation) -> Setting {
    let normal = from_polar(variation.between(0, -0.95, 0.95), variation.between(1, 0.0, TAU));
    let view = view(normal);
    let mirrored = normal * (2.0 * normal.dot(view)) - view;
    let centre = (mirrored + normal * 0.3).normalize() * variation.between(2, 0.8, 2.0);
    let light = facing(centre, variation.between(3, 0.5, 1.5), 0.3, variation.between(4, 0.0, TAU));
    Setting { position: DVec3::ZERO, normal, view, roughness, light }
}

pub(super) fn view_normal(angle: f64, variation: &Variation) -> Setting {
    let azimuth = variation.between(5, 0.0, TAU);
    // A level floor, seen from an eye above a point whose coordinates have digits down to 2e-7.
    if variation.0.is_multiple_of(3) {
        let digits = |x: f64| (x * 4_194_304.0).round() / 4_194_304.0;
        let mut setting = tilted(|normal| normal, variation.between(3, 0.2, 0.8), variation);
        setting.normal = DVec3::Z;
        let sine = angle.sin();
        setting.view = DVec3::new(digits(sine * azimuth.cos()), digits(sine * azimuth.sin()), angle.cos());
        let centre = from_polar(0.95, azimuth) * variation.between(2, 0.8, 2.0);
        setting.light = facing(centre, variation.between(3, 0.5, 1.5), 0.3, variation.between(4, 0.0, TAU));
        return setting;
    }
    let view = |normal: DVec3| {
        let [x, y, _] = facing_axes(-normal, azimuth);
        normal * angle.cos() + (x + y).normalize() * angle.sin()
    };
    tilted(view, variation.between(3, 0.2, 0.8), variation)
}

pub(super) fn grazing(cosine: f64, variation: &Variation) -> Setting {
    let azimuth = variation.between(5, 0.0, TAU);
    let view = |normal: DVec3| {
        let [x, _, _] = facing_axes(-normal, azimuth);
        normal * cosine + x * (1.0 - cosine * cosine).sqrt()
    };
    tilted(view, variation.between(3, 0.2, 0.8), variation)
}

pub(super) fn glossy(roughness: f64, variation: &Variation) -> Setting {
    let view = from_polar(variation.between(0, 0.3, 0.9), variation.between(1, 0.0, TAU));
    let mirrored = DVec3::new(-view.x, -view.y, view.z);
    let light = facing(
        mirrored * variation.between(2, 0.5, 2.0),
        variation.between(3, 0.1, 1.0),
        0.4,
        variation.between(4, 0.0, TAU),
    );
    Setting { view, ..over(light, roughness, variation) }
}

/// Just beyond the centre of a texel.
pub(super) fn texel(beyond: f64, variation: &Variation) -> Setting {
    let column = variation.between(5, 4.0, 60.0).floor();
    glossy((column + beyond) / 63.0, variation)
}

pub(super) fn thin(aspect: f64, variation: &Variation) -> Setting {
    let centre = from_polar(variation.between(0, 0.4, 0.95), variation.between(1, 0.0, TAU));
    let [x, y, _] = facing_axes(centre, variation.between(2, 0.0, TAU));
    let half = variation.between(3, 0.2, 0.6);
    over(rectangle(centre, x * half, y * (half / aspect)), 0.3, variation)
}

/// Moved away from the origin; the light is placed relative to the surface point as rounding has placed that.
pub(super) fn offset(by: f64, variation: &Variation) -> Setting {
    let mut setting = distant(1.0, 0.5, variation);
    let direction = from_polar(variation.between(4, -1.0, 1.0), variation.between(5, 0.0, TAU));
    let by = (direction * by).as_vec3().as_dvec3();
    setting.position += by;
    setting.light = setting.light.moved(|point| point + by, |vector| vector);
    setting
}

pub(super) fn scaled(by: f64, variation: &Variation) -> Setting {
    let mut setting = distant(1.0, 0.5, variation);
    setting.light = setting.light.moved(|point| point * by, |vector| vector * by);
    setting
}

fn disk(centre: DVec3, radius: f64, slant: f64, turn: f64) -> Light {
    let [x, y, normal] = facing_axes(centre, turn);
    let x = x * slant.cos() + normal * slant.sin();
    Light::Disk { center: centre, half_x: x * radius, half_y: y * radius, two_sided: false }
}

pub(super) fn disk_axis(aside: f64, variation: &Variation) -> Setting {
    let height = variation.between(0, 0.5, 3.0);
    let azimuth = variation.between(1, 0.0, TAU);
    let radius = variation.between(2, 0.3, 3.0);
    let light = Light::Disk {
        center: DVec3::new(aside * azimuth.cos(), aside * azimuth.sin(), height),
        half_x: DVec3::X * radius,
        half_y: -DVec3::Y * radius,
        two_sided: false,
    };
    over(light, 0.3, variation)
}

pub(super) fn disk_large(radius: f64, variation: &Variation) -> Setting {
    let centre = from_polar(variation.between(0, 0.9, 1.0), variation.between(1, 0.0, TAU));
    over(disk(centre, radius, 0.1, variation.between(2, 0.0, TAU)), 0.3, variation)
}

pub(super) fn disk_small(radius: f64, variation: &Variation) -> Setting {
    let centre = from_polar(variation.between(0, 0.4, 0.95), variation.between(1, 0.0, TAU));
    over(disk(centre, radius, 0.5, variation.between(2, 0.0, TAU)), 0.3, variation)
}

pub(super) fn sphere_contact(gap: f64, variation: &Variation) -> Setting {
    let radius = variation.between(0, 0.3, 2.0);
    let toward = from_polar(variation.between(1, 0.2, 1.0), variation.between(2, 0.0, TAU));
    over(Light::Sphere { center: toward * (radius + gap), radius }, 0.3, variation)
}

fn tube(start: DVec3, end: DVec3, variation: &Variation) -> Setting {
    let nearest = crate::light::Light::Tube { start, end, radius: 0.01, caps: false };
    over(nearest, 0.3, variation)
}

pub(super) fn tube_short(length: f64, variation: &Variation) -> Setting {
    let centre = from_polar(variation.between(0, 0.4, 0.95), variation.between(1, 0.0, TAU));
    let along = from_polar(variation.between(2, -0.5, 0.5), variation.between(3, 0.0, TAU));
    tube(centre - along * (0.5 * length), centre + along * (0.5 * length), variation)
}

pub(super) fn tube_end_on(gap: f64, variation: &Variation) -> Setting {
    let along = from_polar(variation.between(0, 0.4, 0.95), variation.between(1, 0.0, TAU));
    let aside = along.any_orthonormal_vector() * gap;
    tube(along * 0.5 + aside, along * 1.5 + aside, variation)
}
