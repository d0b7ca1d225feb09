//! Lights as values: what is refused, and how far each reaches.

mod common;

use common::Random;
use glam::DVec3;
use softbox::light::{Light, LightError, light_value};
use softbox::shade::{ltc_in_range, ltc_surface};
use softbox::table::Table;

fn polygon(points: &[[f64; 3]]) -> Light {
    Light::Polygon { points: points.iter().copied().map(DVec3::from).collect(), two_sided: false }
}

fn disk(half_x: DVec3, half_y: DVec3) -> Light {
    Light::Disk { center: DVec3::Z, half_x, half_y, two_sided: false }
}

#[test]
fn what_emits_nothing_or_was_not_meant_is_refused() {
    let square = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]];
    let infinite = f64::INFINITY;
    let cases = [
        (polygon(&square[..2]), LightError::TooFewPoints { count: 2 }),
        (polygon(&[[0.0; 3], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]]), LightError::NoArea),
        (polygon(&[[5.0; 3]; 4]), LightError::NoArea),
        (polygon(&[square[0], square[1], [1.0, 1.0, 1.5], square[3]]), LightError::NotPlanar { share: 1e-4 }),
        (
            polygon(&[square[0], square[1], [0.0, 1.0, 1.0], [0.7, 1.0, 1.0]]),
            LightError::Crossing { first: 2, second: 4 },
        ),
        (disk(DVec3::ZERO, DVec3::Y), LightError::ZeroAxis { field: "half_x" }),
        (disk(DVec3::X, DVec3::ZERO), LightError::ZeroAxis { field: "half_y" }),
        (disk(DVec3::X, -3.0 * DVec3::X), LightError::ParallelAxes),
        (Light::Sphere { center: DVec3::Z, radius: 0.0 }, LightError::Radius { radius: 0.0 }),
        (Light::Sphere { center: DVec3::Z, radius: -1.0 }, LightError::Radius { radius: -1.0 }),
        (
            Light::Tube { start: DVec3::Z, end: DVec3::X, radius: -0.5, caps: true },
            LightError::Radius { radius: -0.5 },
        ),
        (
            disk(DVec3::new(1.0, infinite, 0.0), DVec3::Y),
            LightError::NotFinite { field: "half_x".to_owned(), value: "[1.0, inf, 0.0]".to_owned() },
        ),
        (
            Light::Sphere { center: DVec3::Z, radius: 1e39 },
            LightError::NotFinite { field: "radius".to_owned(), value: format!("{}", 1e39) },
        ),
    ];
    for (light, error) in cases {
        let refused = light.check();
        assert_eq!(refused, Err(error), "{light:?}");
        let sentence = refused.map_or_else(|error| error.to_string(), |()| String::new());
        assert!(!sentence.contains('\n') && sentence.len() > 30, "{sentence}");
    }
}

#[test]
fn rounded_vertices_far_from_the_origin_are_planar() {
    let mut random = Random::new(41);
    for _ in 0..2000 {
        let (normal, turn) = (random.direction(), random.direction());
        let x = normal.cross(turn).normalize_or(normal.any_orthonormal_vector());
        let y = normal.cross(x);
        let centre = random.direction() * random.log(1.0, 1e6);
        let (width, height) = (random.log(0.1, 10.0), random.log(0.1, 10.0));
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let points: Vec<DVec3> = corners
            .iter()
            .map(|(a, b)| (centre + x * width * *a + y * height * *b).as_vec3().as_dvec3())
            .collect();
        let light = Light::Polygon { points, two_sided: false };
        // At a million units f32 counts in sixteenths: a light that small may vanish, but it does not cross itself.
        let checked = light.check();
        assert!(matches!(checked, Ok(()) | Err(LightError::NoArea)), "{checked:?}: {light:?}");
    }
}

/// A light of any shape, of size about 1.
fn random_light(random: &mut Random, shape: usize) -> Light {
    let mut vector = |size: f64| random.direction() * random.log(0.3 * size, size);
    let (a, b, c) = (vector(1.0), vector(1.0), vector(1.0));
    match shape {
        0 => Light::Polygon { points: vec![c, c + a, c + a + b, c + b], two_sided: true },
        1 => Light::Disk { center: c, half_x: a, half_y: b, two_sided: true },
        2 => Light::Sphere { center: c, radius: a.length() },
        _ => Light::Tube { start: a, end: b, radius: 0.02 * c.length(), caps: shape == 4 },
    }
}

#[test]
fn nothing_above_the_threshold_lies_out_of_range() {
    let table = Table::default();
    let peaks: Vec<f64> = (0..10).map(|column| table.peak(f64::from(column) / 10.0)).collect();
    println!("peaks by tenths of roughness: {peaks:.1?}");
    let mut random = Random::new(42);
    let mut closest = 0.0_f64;
    for index in 0..40_000 {
        let light = random_light(&mut random, index % 5);
        let roughness = random.between(0.15, 1.0);
        // Any surface as rough as this or rougher.
        let column = (roughness * 10.0) as usize;
        let roughness = column as f64 / 10.0;
        let peak = peaks[column];
        let radiance = random.log(0.1, 1e3);
        let threshold = radiance * random.log(1e-4, 0.5);
        let (centre, _) = light.bounds();
        let diffuse_range = light.range(radiance, threshold, core::f64::consts::FRAC_1_PI);
        let specular_range = light.range(radiance, threshold, peak);
        for (range, specular) in [(diffuse_range, false), (specular_range, true)] {
            let toward = random.direction();
            let position = centre - toward * range * random.between(1.0 + 1e-9, 1.2);
            // The surface faces the light, and mirrors the eye towards it, or nearly so.
            let normal = (toward + random.direction() * random.between(0.0, 0.9)).normalize();
            let mirror = 2.0 * normal.dot(toward) * normal - toward;
            let view = (mirror + random.direction() * random.log(1e-3, 1.0)).normalize();
            if view.dot(normal) <= 0.0 {
                continue;
            }
            assert!(
                !ltc_in_range::<f64>(position, centre, range),
                "{position} is beyond {range} of {centre}"
            );
            assert!(ltc_in_range::<f64>(position, centre, 1.3 * range));
            let surface = ltc_surface::<f64>(position, normal, view, random.between(roughness, 1.0));
            let value = light_value(&surface, &table.lobe(&surface), &light);
            let reflected = radiance * if specular { value.y } else { value.x };
            assert!(
                reflected <= threshold,
                "{reflected} beyond {range}, threshold {threshold}: {light:?} {surface:?}"
            );
            closest = closest.max(reflected / threshold);
        }
    }
    // The bound is no idle one.
    println!("the brightest light out of range has {closest} of the threshold");
    assert!(closest > 0.5, "{closest}");
}

#[test]
fn ranges_at_the_limits() {
    let light = Light::Sphere { center: DVec3::ZERO, radius: 2.0 };
    assert_eq!(light.range(1.0, 1.0, 0.3), 0.0);
    assert_eq!(light.range(0.0, 0.1, 0.3), 0.0);
    assert_eq!(light.range(1.0, 0.0, 0.3), f64::INFINITY);
    // Diffuse light falls with the square of the distance.
    let near = light.range(1.0, 1e-4, core::f64::consts::FRAC_1_PI);
    let far = light.range(100.0, 1e-4, core::f64::consts::FRAC_1_PI);
    assert!((far / near - 10.0).abs() < 1e-2, "{near} {far}");
}
