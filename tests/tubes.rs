//! Tubes: ground truth against other integrals, the closed form against ground truth, and relations that
//! hold whatever the value is.

mod common;

use std::f64::consts::{PI, TAU};

use common::Random;
use glam::{DVec3, Vec3};
use softbox::brdf::{Brdf, Lambert};
use softbox::shade::{
    LtcLobe, LtcSurface, ltc_lobe, ltc_surface, ltc_transform, ltc_transform_normal, ltc_tube,
    ltc_tube_begin, ltc_tube_diffuse, ltc_tube_lobe,
};
use softbox::table::Table;
use softbox::truth;

/// A tube relative to the surface point at the origin, whose normal is +z.
#[derive(Clone, Copy, Debug)]
struct Tube {
    start: DVec3,
    end: DVec3,
    radius: f64,
    caps: bool,
}

impl Tube {
    /// A tube above the horizon, `ratio` of its distance thick.
    fn random(random: &mut Random, ratio: f64, caps: bool) -> Self {
        loop {
            let direction = random.direction();
            let center = DVec3::new(direction.x, direction.y, direction.z.abs() + 0.3);
            let half = random.direction() * random.between(0.2, 2.0);
            let (start, end) = (center - half, center + half);
            let radius = ratio * nearest(start, end).length();
            if start.z > radius && end.z > radius {
                return Self { start, end, radius, caps };
            }
        }
    }

    fn truth(&self, brdf: &dyn Brdf, view: DVec3, tolerance: f64) -> truth::Truth {
        truth::tube(brdf, view, self.start, self.end, self.radius, self.caps, tolerance)
    }

    fn diffuse(&self) -> f64 {
        let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, DVec3::Z, 1.0);
        ltc_tube_diffuse(&surface, &ltc_tube_begin(&surface, self.start, self.end, self.radius, self.caps))
    }
}

/// The point of a segment that is nearest to the origin.
fn nearest(start: DVec3, end: DVec3) -> DVec3 {
    let side = end - start;
    let t = (-start.dot(side) / side.length_squared().max(1e-300)).clamp(0.0, 1.0);
    start + side * t
}

// ---- ground truth ----

/// The sum over the lateral surface of what reaches the origin, by the midpoint rule around the tube and along it.
fn lateral_sum(tube: &Tube) -> f64 {
    let side = tube.end - tube.start;
    let (length, axis) = (side.length(), side.normalize());
    let (x, y) = axis.any_orthonormal_pair();
    let (around, along) = (1200, 200);
    let area = length * TAU * tube.radius / f64::from(around * along);
    let mut sum = 0.0;
    for i in 0..around {
        let (sine, cosine) = (TAU * (f64::from(i) + 0.5) / f64::from(around)).sin_cos();
        let normal = x * cosine + y * sine;
        for k in 0..along {
            let point = tube.start + side * ((f64::from(k) + 0.5) / f64::from(along)) + normal * tube.radius;
            let squared = point.length_squared();
            sum += point.z.max(0.0) * (-normal.dot(point)).max(0.0) / (squared * squared);
        }
    }
    sum * area / PI
}

#[test]
fn truth_is_the_sum_over_the_surface() {
    let mut random = Random::new(1);
    for i in 0..40 {
        let ratio = random.log(0.02, 0.6);
        let mut tube = Tube::random(&mut random, ratio, false);
        if i % 2 == 0 {
            // Through the horizon.
            tube.start.z = -tube.start.z;
        }
        let (axis, foot) = (tube.end - tube.start, nearest(tube.start, tube.end));
        if axis.cross(tube.start).length() < 1.5 * tube.radius * axis.length()
            || foot.length() < 2.0 * tube.radius
        {
            continue;
        }
        let integral = tube.truth(&Lambert, DVec3::Z, 1e-8);
        let sum = lateral_sum(&tube);
        assert!((integral.diffuse - sum).abs() < 5e-4 * sum, "{} and {sum}: {tube:?}", integral.diffuse);
    }
}

#[test]
fn truth_of_a_capsule_without_length_is_a_sphere() {
    let mut random = Random::new(2);
    for _ in 0..50 {
        let center = random.direction() * random.between(1.0, 3.0);
        let radius = random.between(0.01, 0.9);
        let tube = Tube { start: center, end: center, radius, caps: true };
        if center.z < radius {
            continue;
        }
        let integral = tube.truth(&Lambert, DVec3::Z, 1e-9).diffuse;
        // A sphere above the horizon: the cosine to its centre times r² / d² (Howell's catalogue, B-16).
        let exact = center.z * radius * radius / center.length().powi(3);
        assert!((integral - exact).abs() < 1e-8 * exact, "{integral} and {exact}: {tube:?}");
        let open = Tube { caps: false, ..tube };
        assert_eq!(open.truth(&Lambert, DVec3::Z, 1e-6).diffuse, 0.0);
    }
}

/// A capsule by rays: where the ray passes its segment, at less than the radius?
#[test]
fn truth_of_a_capsule_is_what_rays_hit() {
    let mut random = Random::new(3);
    for i in 0..12 {
        let ratio = random.log(0.05, 0.7);
        let mut tube = Tube::random(&mut random, ratio, true);
        if i % 3 == 0 {
            tube.start.z = -tube.start.z;
            tube.radius = tube.radius.min(0.9 * nearest(tube.start, tube.end).length());
        }
        let (rings, spokes) = (800, 1000);
        let mut hits = 0;
        for ring in 0..rings {
            // Rays with density cos / pi: a disk's points, lifted to the hemisphere.
            let radius = ((f64::from(ring) + 0.5) / f64::from(rings)).sqrt();
            for spoke in 0..spokes {
                let azimuth = TAU * (f64::from(spoke) + 0.618 * f64::from(ring)) / f64::from(spokes);
                let ray = DVec3::new(
                    radius * azimuth.cos(),
                    radius * azimuth.sin(),
                    (1.0 - radius * radius).max(0.0).sqrt(),
                );
                // The distance of a segment's points from a ray is convex along the segment.
                let (mut low, mut high) = (0.0, 1.0);
                let distance = |t: f64| {
                    let point = tube.start.lerp(tube.end, t);
                    (point - ray * point.dot(ray).max(0.0)).length()
                };
                for _ in 0..24 {
                    let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
                    if distance(a) < distance(b) {
                        high = b;
                    } else {
                        low = a;
                    }
                }
                hits += u32::from(distance(0.5 * (low + high)) < tube.radius);
            }
        }
        let counted = f64::from(hits) / f64::from(rings * spokes);
        let integral = tube.truth(&Lambert, DVec3::Z, 1e-7).diffuse;
        assert!((counted - integral).abs() < 3e-4, "{counted} and {integral}: {tube:?}");
    }
}

// ---- the closed form against ground truth ----

/// Mean |error| over mean value of the form factor.
fn diffuse_error(ratio: f64, caps: bool) -> f64 {
    let mut random = Random::new(4);
    let (mut error, mut sum) = (0.0, 0.0);
    for _ in 0..200 {
        let tube = Tube::random(&mut random, ratio, caps);
        let exact = tube.truth(&Lambert, DVec3::Z, 1e-7).diffuse;
        error += (tube.diffuse() - exact).abs();
        sum += exact;
    }
    error / sum
}

#[test]
fn the_error_falls_with_the_square_of_the_radius() {
    // Of the value, in units of (radius / distance)².
    for (caps, coefficient) in [(false, 0.095), (true, 0.3)] {
        let mut last = f64::INFINITY;
        for ratio in [0.25, 0.125, 0.0625, 0.03125, 0.015625] {
            let error = diffuse_error(ratio, caps);
            println!("caps {caps}, radius {ratio} of the distance: {:.4} %", 100.0 * error);
            assert!(error < coefficient * ratio * ratio, "{error} at {ratio}, caps {caps}");
            assert!(error < last / 3.0, "{error} after {last} at {ratio}, caps {caps}");
            last = error;
        }
    }
}

/// A lobe as a reflectance model, so that ground truth integrates the lobe itself.
struct LobeModel(LtcLobe<f64>);

impl Brdf for LobeModel {
    fn evaluate(&self, _view: DVec3, light: DVec3) -> f64 {
        let there = ltc_transform(&self.0, light);
        let volume = ltc_transform_normal(&self.0, light).dot(there);
        let squared = there.length_squared();
        there.z.max(0.0) / PI * volume / (squared * squared) / light.z
    }

    fn sample(&self, _: DVec3, _: glam::DVec2) -> DVec3 {
        unreachable!("integration draws nothing")
    }

    fn pdf(&self, _: DVec3, _: DVec3) -> f64 {
        unreachable!("integration draws nothing")
    }

    fn width(&self) -> f64 {
        1.0
    }
}

/// Mean |error| over mean value of a lobe's integral, for lobes of the given roughness.
fn lobe_error(ratio: f64, roughness: (f64, f64), caps: bool) -> f64 {
    let table = Table::default();
    let mut random = Random::new(5);
    let (mut error, mut sum) = (0.0, 0.0);
    for _ in 0..150 {
        let mut tube = Tube::random(&mut random, ratio, caps);
        let view = (random.direction() + DVec3::Z * 1.05).normalize();
        // Where the mirror direction meets the tube, or thereabouts.
        let mirror = DVec3::new(-view.x, -view.y, view.z);
        let middle = 0.5 * (tube.start + tube.end);
        let moved = (mirror + random.direction() * 0.2) * middle.length() - middle;
        (tube.start, tube.end) = (tube.start + moved, tube.end + moved);
        let distance = nearest(tube.start, tube.end).length();
        tube.radius = ratio * distance;
        let line = (tube.end - tube.start).normalize().cross(tube.start).length();
        if tube.start.z < tube.radius || tube.end.z < tube.radius || line < 0.3 * distance {
            continue;
        }
        let surface =
            ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, view, random.between(roughness.0, roughness.1));
        let lobe = table.lobe(&surface);
        let begun = ltc_tube_begin(&surface, tube.start, tube.end, tube.radius, caps);
        let value = ltc_tube_lobe(&begun, &lobe).z;
        let exact = tube.truth(&LobeModel(lobe), view, 1e-5).specular;
        error += (value - exact).abs();
        sum += exact;
    }
    error / sum
}

#[test]
fn lobes_cover_tubes_as_their_integral_does() {
    for (caps, roughness, ratio, bound) in [
        (false, (0.4, 1.0), 0.02, 1e-4),
        (false, (0.4, 1.0), 0.08, 1.3e-3),
        (false, (0.15, 0.4), 0.02, 5e-4),
        (false, (0.15, 0.4), 0.08, 3e-3),
        (false, (0.05, 0.15), 0.02, 3.5e-3),
        (true, (0.4, 1.0), 0.02, 2.5e-4),
        (true, (0.4, 1.0), 0.08, 3.5e-3),
        (true, (0.15, 0.4), 0.02, 6e-4),
        (true, (0.15, 0.4), 0.08, 8e-3),
        (true, (0.05, 0.15), 0.02, 5e-2),
    ] {
        let error = lobe_error(ratio, roughness, caps);
        println!(
            "caps {caps}, roughness {roughness:?}, radius {ratio}: {:.4} % of {:.4} %",
            100.0 * error,
            100.0 * bound
        );
        assert!(
            error < bound,
            "{error} beyond {bound}: caps {caps}, roughness {roughness:?}, radius {ratio}"
        );
    }
}

// ---- relations ----

/// A surface at the origin with any frame, its lobe, and a tube above its horizon.
fn setting(random: &mut Random, table: &Table) -> (LtcSurface<f32>, LtcLobe<f32>, [Vec3; 2], f32) {
    loop {
        let normal = random.direction();
        let view = normal + random.direction() * 0.95;
        let roughness = random.between(0.1, 1.0) as f32;
        let surface = ltc_surface::<f32>(Vec3::ZERO, normal.as_vec3(), view.as_vec3(), roughness);
        let center = random.direction() * random.between(0.3, 3.0);
        let half = random.direction() * random.log(0.05, 3.0);
        let (start, end) = (center - half, center + half);
        let radius = nearest(start, end).length() * random.log(1e-3, 0.125);
        if start.dot(normal).min(end.dot(normal)) > 1.01 * radius {
            return (surface, table.lobe(&surface), [start.as_vec3(), end.as_vec3()], radius as f32);
        }
    }
}

fn assert_near(a: Vec3, b: Vec3, tolerance: Vec3, input: &dyn core::fmt::Debug) {
    assert!((a - b).abs().cmple(tolerance).all(), "{a:?} and {b:?} differ by {:?}: {input:?}", a - b);
}

#[test]
fn parts_add_up_and_ends_may_be_exchanged() {
    let table = Table::default();
    let mut random = Random::new(21);
    for _ in 0..20_000 {
        let (surface, lobe, [start, end], radius) = setting(&mut random, &table);
        let input = (surface, start, end, radius);
        let whole = ltc_tube(&surface, &lobe, start, end, radius, false);
        let middle = start.lerp(end, random.unit() as f32);
        let parts = ltc_tube(&surface, &lobe, start, middle, radius, false)
            + ltc_tube(&surface, &lobe, middle, end, radius, false);
        // Schlick's part follows the mean direction and does not add up exactly. A wide lobe moves the ends of a tube
        // that is wide in its space, by the same for both parts.
        assert_near(whole, parts, Vec3::new(2e-6, 3e-4, f32::INFINITY), &input);
        for caps in [false, true] {
            let one = ltc_tube(&surface, &lobe, start, end, radius, caps);
            let other = ltc_tube(&surface, &lobe, end, start, radius, caps);
            assert_near(one, other, Vec3::new(1e-6, 1e-4, 1e-4), &input);
        }
    }
}

#[test]
fn scaling_by_a_power_of_two_changes_no_bit() {
    let table = Table::default();
    let mut random = Random::new(22);
    for i in 0..5_000 {
        let (surface, lobe, [start, end], radius) = setting(&mut random, &table);
        let value =
            |scale: f32| ltc_tube(&surface, &lobe, start * scale, end * scale, radius * scale, i % 2 == 0);
        let expected = value(1.0).to_array().map(f32::to_bits);
        for exponent in [-40, -20, -1, 1, 20, 40] {
            assert_eq!(expected, value(2.0_f32.powi(exponent)).to_array().map(f32::to_bits), "2^{exponent}");
        }
    }
}

/// The clamped cosine itself as a lobe sees what a diffuse surface sees.
#[test]
fn the_cosine_lobe_gives_the_form_factor() {
    let table = Table::default();
    let mut random = Random::new(23);
    for i in 0..20_000 {
        let (surface, _, [start, end], radius) = setting(&mut random, &table);
        let surface = ltc_surface::<f32>(Vec3::ZERO, surface.normal, surface.normal, 1.0);
        let shape = glam::Vec4::new(0.0, 0.0, 0.0, 1.0);
        let lobe = ltc_lobe(&surface, shape, glam::Vec4::new(1.0, 0.0, 0.0, 0.0));
        let tube = ltc_tube_begin(&surface, start, end, radius, i % 2 == 0);
        let (diffuse, lobe) = (ltc_tube_diffuse(&surface, &tube), ltc_tube_lobe(&tube, &lobe).z);
        assert!((diffuse - lobe).abs() < 1e-6, "{diffuse} and {lobe}: {surface:?} {tube:?}");
    }
}

#[test]
fn a_tube_of_no_length_or_width_is_dark_but_for_its_caps() {
    let table = Table::default();
    let mut random = Random::new(24);
    for _ in 0..2_000 {
        let (surface, lobe, [start, end], radius) = setting(&mut random, &table);
        assert_eq!(ltc_tube(&surface, &lobe, start, start, radius, false), Vec3::ZERO);
        assert_eq!(ltc_tube(&surface, &lobe, start, end, 0.0, false), Vec3::ZERO);
        assert_eq!(ltc_tube(&surface, &lobe, start, end, 0.0, true), Vec3::ZERO);
        // A sphere above the horizon: the cosine to its centre times r² / d² (Howell's catalogue, B-16).
        let sphere = ltc_tube(&surface, &lobe, start, start, radius, true).x;
        let exact = surface.normal.dot(start) * radius * radius / start.length().powi(3);
        let bound = 1e-6 * radius * radius / start.length_squared();
        assert!((sphere - exact).abs() < bound, "{sphere} and {exact}: {start:?} {radius}");
    }
}

/// Seen along its axis a capsule shows one cap and nothing else; its side is hidden behind that.
#[test]
fn a_capsule_that_points_at_the_surface_shows_one_cap() {
    let view = DVec3::new(0.6, 0.0, 0.8);
    for ratio in [1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 100.0] {
        for degrees in [0.0_f64, 0.5, 2.0, 5.0, 20.0, 45.0, 70.0] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let start = DVec3::new(0.2, 0.1, 1.0).normalize();
            let aside = start.any_orthonormal_vector();
            let end = start + (start * cosine + aside * sine) * 0.7;
            let tube = Tube { start, end, radius: ratio, caps: true };
            let (value, exact) = (tube.diffuse(), tube.truth(&Lambert, view, 1e-8).diffuse);
            let error = (value / exact - 1.0).abs();
            assert!(error < 0.012, "{value} and {exact} at {degrees} degrees: {tube:?}");
        }
    }
}
