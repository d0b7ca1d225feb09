//! Disks and spheres against integrals, polygons, closed forms and themselves.

mod common;

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};
use softbox::brdf::{Ggx, Lambert};
use softbox::effects::Effects;
use softbox::shade::{
    LtcLobe, LtcSurface, Real, ltc_disk, ltc_hyperbolic_deficit, ltc_polygon_add, ltc_polygon_begin,
    ltc_polygon_end, ltc_sphere, ltc_surface,
};
use softbox::table::{Table, clipped_sphere};
use softbox::truth;

use common::{Bound, Random, Shape, cases};

/// A disk around any direction, between a tenth and ten times its size away.
fn disk(random: &mut Random) -> [DVec3; 3] {
    let centre = random.direction() * random.log(0.3, 3.0);
    let half_x = random.direction() * random.log(0.1, 3.0);
    [centre, half_x, random.direction() * random.log(0.1, 3.0)]
}

fn surface<R: Real>(random: &mut Random) -> LtcSurface<R>
where
    R::Vec3: From<[R; 3]>,
{
    let v = |v: DVec3| R::Vec3::from(v.to_array().map(R::new));
    let normal = random.direction();
    let view = if random.index(8) == 0 { normal } else { normal + random.direction() * 0.95 };
    let roughness = R::new(random.between(0.05, 1.0));
    ltc_surface::<R>(v(DVec3::ZERO), v(normal), v(view), roughness)
}

/// The lobe that is the clamped cosine itself.
fn cosine<R: Real>(surface: &LtcSurface<R>) -> LtcLobe<R> {
    let one: R = R::new(1.0);
    let v = |v: DVec3| R::Vec3::from(v.to_array().map(R::new));
    LtcLobe {
        axis_x: surface.tangent,
        albedo: one,
        axis_y: surface.bitangent,
        fresnel: one,
        axis_z: surface.normal,
        share: one,
        normal_x: surface.tangent,
        normal_y: surface.bitangent,
        normal_z: surface.normal,
        frame_x: v(DVec3::X),
        frame_y: v(DVec3::Y),
        frame_z: v(DVec3::Z),
        frame_normal_x: v(DVec3::X),
        frame_normal_y: v(DVec3::Y),
        frame_normal_z: v(DVec3::Z),
    }
}

fn polygon(surface: &LtcSurface<f64>, lobe: &LtcLobe<f64>, [centre, x, y]: [DVec3; 3], count: u32) -> DVec3 {
    // A circumscribed polygon's area is larger by tan, an inscribed one's smaller by sin: this one's is right.
    let step = TAU / f64::from(count);
    let grown = (step / step.sin()).sqrt();
    let vertex = |i: u32| {
        let (sine, cosine) = (step * f64::from(i)).sin_cos();
        centre + (x * cosine + y * sine) * grown
    };
    let mut polygon = ltc_polygon_begin(surface, vertex(0));
    for i in 1..count {
        ltc_polygon_add(&mut polygon, surface, lobe, vertex(i));
    }
    ltc_polygon_end(&mut polygon, surface, lobe, true)
}

/// The bounds are against exact arithmetic, which the twin in f64 stands for: here is that it may.
#[test]
fn the_twin_in_double_precision_is_the_integral() {
    let table = Table::default();
    let mut compared = 0;
    for case in cases(2) {
        if matches!(case.bound, Bound::Physical) {
            continue;
        }
        let normal = case.normal.as_dvec3().normalize();
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let turn = |v: DVec3| DVec3::new(v.dot(tangent), v.dot(bitangent), v.dot(normal));
        let place = |v: Vec3| turn(v.as_dvec3() - case.position.as_dvec3());
        let integral = match case.shape {
            Shape::Disk { center, half_x, half_y, two_sided } => {
                let [x, y] = [half_x, half_y].map(|v| turn(v.as_dvec3()));
                truth::disk(&Lambert, DVec3::Z, place(center), x, y, two_sided, 1e-10)
            }
            Shape::Sphere { center, radius } => {
                truth::sphere(&Lambert, DVec3::Z, place(center), radius.into(), 1e-10)
            }
            _ => continue,
        };
        let twin = case.twin::<f64>(&table, Effects::NONE)[0];
        // The rounding of the turned points counts by as much as the light is close or small.
        let tolerance = 1e-10 + 1e-8 * integral.diffuse + 2.0 * integral.error.diffuse;
        let difference = (twin - integral.diffuse).abs();
        assert!(difference <= tolerance, "{twin} and {integral:?}: {case:?}");
        compared += 1;
    }
    assert!(compared > 300, "{compared}");
}

/// Both horizons, by functions that know nothing of cones.
#[test]
fn many_vertices_make_a_disk() {
    let table = Table::default();
    let mut random = Random::new(30);
    for _ in 0..300 {
        let surface = surface::<f64>(&mut random);
        let lobe = table.lobe(&surface);
        let light = disk(&mut random);
        let expected = polygon(&surface, &lobe, light, 8192);
        let value = ltc_disk(&surface, &lobe, light[0], light[1], light[2], true);
        let difference = (value - expected).abs();
        assert!(difference.max_element() < 1e-7, "{value} and {expected}: {surface:?} {light:?}");
    }
}

/// The specular value of the cosine's lobe is the form factor, by other code: its horizon is cut twice.
#[test]
fn the_cosine_s_lobe_sees_the_form_factor() {
    let mut random = Random::new(31);
    let mut worst = [0.0_f64; 2];
    for _ in 0..20_000 {
        let seed = random.index(1 << 30) as u64;
        let [centre, x, y] = disk(&mut random);
        let radius = centre.length() * random.between(0.01, 0.99);
        let wide = {
            let surface = surface::<f64>(&mut Random::new(seed));
            let lobe = cosine(&surface);
            [ltc_disk(&surface, &lobe, centre, x, y, true), ltc_sphere(&surface, &lobe, centre, radius)]
        };
        let single = {
            let surface = surface::<f32>(&mut Random::new(seed));
            let lobe = cosine(&surface);
            let [centre, x, y] = [centre, x, y].map(|v| v.as_vec3());
            [
                ltc_disk(&surface, &lobe, centre, x, y, true),
                ltc_sphere(&surface, &lobe, centre, radius as f32),
            ]
        };
        for value in wide {
            worst[0] = worst[0].max((value.x - value.y).abs());
        }
        for value in single {
            worst[1] = worst[1].max(f64::from((value.x - value.y).abs()));
        }
    }
    println!("form factor against the cosine's lobe: {:.1e} in f64, {:.1e} in f32", worst[0], worst[1]);
    assert!(worst[0] < 1e-12 && worst[1] < 1e-5, "{worst:?}");
}

#[test]
fn a_sphere_has_the_form_factor_of_the_closed_form() {
    let mut random = Random::new(32);
    for i in 0..50_000 {
        let surface = surface::<f64>(&mut random);
        let direction = random.direction();
        let sine = if i % 2 == 0 { random.unit() } else { random.log(1e-3, 1.0) };
        let distance = random.log(0.1, 10.0);
        let value = ltc_sphere(&surface, &cosine(&surface), direction * distance, distance * sine).x;
        let tilt = surface.normal.dot(direction);
        let whole = sine * sine;
        let expected = if tilt <= -sine { 0.0 } else { whole * clipped_sphere(tilt, whole) };
        assert!((value - expected).abs() < 1e-9, "{value} and {expected}: {tilt} {sine}");
    }
}

/// Facing, coaxial: R² / (R² + h²).
#[test]
fn a_disk_straight_ahead_has_the_textbook_s_form_factor() {
    let surface = ltc_surface::<f32>(Vec3::ZERO, Vec3::Z, Vec3::Z, 0.5);
    let lobe = Table::default().lobe(&surface);
    for height in [1e-6_f32, 1e-3, 0.5, 1.0, 6.0, 1e3] {
        for radius in [1e-3_f32, 0.01, 1.0, 200.0, 1e6] {
            let (x, y) = (Vec3::X * radius, Vec3::Y * radius);
            let value = ltc_disk(&surface, &lobe, Vec3::Z * height, y, x, false);
            let (r, h) = (f64::from(radius), f64::from(height));
            let exact = r * r / (r * r + h * h);
            let error = (f64::from(value.x) / exact - 1.0).abs();
            assert!(error < 1e-6, "{} and {exact}: radius {radius}, height {height}", value.x);
        }
    }
}

/// Nothing in the arithmetic has a length of its own.
#[test]
fn scaling_by_a_power_of_two_changes_no_bit() {
    let table = Table::default();
    let mut random = Random::new(33);
    for _ in 0..5_000 {
        let surface = surface::<f32>(&mut random);
        let lobe = table.lobe(&surface);
        let light = disk(&mut random).map(|v| v.as_vec3());
        let radius = random.log(0.01, 10.0) as f32;
        let at = |scale: f32| {
            let [centre, x, y] = light.map(|v| v * scale);
            let disk = ltc_disk(&surface, &lobe, centre, x, y, true);
            let sphere = ltc_sphere(&surface, &lobe, centre, radius * scale);
            [disk, sphere].map(|v| v.to_array().map(f32::to_bits))
        };
        for exponent in [-40, -1, 20, 40] {
            assert_eq!(at(1.0), at(2.0_f32.powi(exponent)), "2^{exponent}: {light:?} {radius}");
        }
    }
}

#[test]
fn a_reversed_disk_shines_the_other_way_and_any_half_diameters_will_do() {
    let table = Table::default();
    let mut random = Random::new(34);
    for _ in 0..20_000 {
        let surface = surface::<f64>(&mut random);
        let lobe = table.lobe(&surface);
        let [centre, x, y] = disk(&mut random);
        let at = |x, y, two_sided| ltc_disk(&surface, &lobe, centre, x, y, two_sided);
        let (front, back, both) = (at(x, y, false), at(y, x, false), at(x, y, true));
        assert!(front == DVec3::ZERO || back == DVec3::ZERO, "{front} and {back}");
        assert!((front + back - both).abs().max_element() < 1e-12, "{front}, {back} and {both}");
        let (sine, cosine) = random.between(0.0, TAU).sin_cos();
        let turned = at(x * cosine + y * sine, y * cosine - x * sine, true);
        assert!((turned - both).abs().max_element() < 1e-8, "{turned} and {both}: {centre} {x} {y}");
    }
}

#[test]
fn truth_of_round_lights_agrees_with_that_of_polygons_and_closed_forms() {
    let brdf = Ggx::new(0.2);
    let view = DVec3::new(0.6, 0.0, 0.8);
    let mut random = Random::new(35);
    for _ in 0..12 {
        let [centre, x, y] = disk(&mut random);
        let disk = truth::disk(&brdf, view, centre, x, y, true, 1e-9);
        let count = 512;
        let step = TAU / f64::from(count);
        let grown = (step / step.sin()).sqrt();
        let points: Vec<DVec3> = (0..count)
            .map(|i| {
                let (sine, cosine) = (step * f64::from(i)).sin_cos();
                centre + (x * cosine + y * sine) * grown
            })
            .collect();
        let polygon = truth::polygon(&brdf, view, &points, true, 1e-8);
        let pairs = [
            (disk.diffuse, polygon.diffuse),
            (disk.specular, polygon.specular),
            (disk.fresnel, polygon.fresnel),
        ];
        for (a, b) in pairs {
            assert!((a - b).abs() < 1e-8 + 2e-5 * b, "{disk:?} and {polygon:?}: {centre} {x} {y}");
        }
    }
    // A sphere that the horizon does not cut, one that contains the point, and one below.
    let sphere = truth::sphere(&brdf, view, DVec3::new(0.0, 1.0, 2.0), 0.5, 1e-10);
    let exact = 0.25 / 5.0 * (2.0 / 5.0_f64.sqrt());
    assert!((sphere.diffuse - exact).abs() < 1e-10, "{sphere:?} and {exact}");
    let around = truth::sphere(&brdf, view, DVec3::X, 1.5, 1e-9);
    let hemisphere = truth::disk(&brdf, view, DVec3::Z * 1e-9, DVec3::X, DVec3::Y, true, 1e-9);
    assert!((around.diffuse - 1.0).abs() < 1e-9, "{around:?}");
    assert!((around.specular - hemisphere.specular).abs() < 1e-7, "{around:?} and {hemisphere:?}");
    assert_eq!(truth::sphere(&brdf, view, -DVec3::Z, 0.9, 1e-9).specular, 0.0);
    // A disk straight ahead.
    let disk = truth::disk(&brdf, view, DVec3::Z, DVec3::Y * 2.0, DVec3::X * 2.0, false, 1e-10);
    assert!((disk.diffuse - 0.8).abs() < 1e-10, "{disk:?}");
    assert_eq!(truth::disk(&brdf, view, DVec3::Z, DVec3::X, DVec3::Y, false, 1e-9).diffuse, 0.0);
}

#[test]
fn the_hyperbolic_fit_is_close_and_stands_in_the_include() {
    let mut worst = 0.0_f64;
    for i in 0..400_000 {
        let k = 10.0_f32.powf(-9.0 + 20.0 * i as f32 / 400_000.0);
        let error = f64::from(ltc_hyperbolic_deficit(k)) - ltc_hyperbolic_deficit(f64::from(k));
        worst = worst.max(error.abs());
    }
    println!("largest error {worst:.3e}");
    assert!(worst < 2e-7, "{worst:e}");
    let (coefficients, error) = softbox::fit::fit_hyperbolic_excess(5);
    assert!(error < 8e-8, "{error:e}");
    for coefficient in coefficients {
        let text = format!("{:?}", (coefficient as f32).abs());
        assert!(softbox::WGSL_INCLUDE.contains(&text), "{text} does not stand in the include");
    }
}
