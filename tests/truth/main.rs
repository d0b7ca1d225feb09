//! Ground truth against closed forms, against itself, and against cubature over the light's area.

mod cubature;

use std::f64::consts::{LN_2, PI, TAU};

use glam::{DVec2, DVec3, dvec3};
use softbox::brdf::{Brdf, Ggx};
use softbox::truth::{Truth, polygon};

/// A reproducible sequence of numbers in 0…1 (SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let (sine, cosine) = self.between(0.0, TAU).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        dvec3(radius * cosine, radius * sine, z)
    }

    fn view(&mut self) -> DVec3 {
        view(self.between(0.05, 1.0), self.between(0.0, TAU))
    }

    /// A quad, star or convex polygon that faces the origin from 0.5…4 away.
    fn light(&mut self) -> Vec<DVec3> {
        let center = self.direction() * self.between(0.5, 4.0);
        let normal = self.direction();
        let normal = if normal.dot(center) > 0.0 { -normal } else { normal };
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let count = 3 + (self.next() * 7.0) as usize;
        let size = self.between(0.05, 1.5);
        let jagged = self.next() < 0.5;
        (0..count)
            .map(|index| {
                let (sine, cosine) = (TAU * index as f64 / count as f64).sin_cos();
                let radius = size * if jagged { self.between(0.2, 1.0) } else { 1.0 };
                center + radius * (cosine * tangent + sine * bitangent)
            })
            .collect()
    }
}

fn view(cosine: f64, azimuth: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    dvec3(sine * azimuth.cos(), sine * azimuth.sin(), cosine)
}

fn values(truth: &Truth) -> [f64; 3] {
    [truth.diffuse, truth.specular, truth.fresnel]
}

fn errors(truth: &Truth) -> [f64; 3] {
    [truth.error.diffuse, truth.error.specular, truth.error.fresnel]
}

fn assert_close(actual: f64, expected: f64, relative: f64, what: &str) {
    assert!(
        (actual - expected).abs() <= relative * expected.abs(),
        "{what}: {actual:e}, expected {expected:e}"
    );
}

fn rectangle(corner: DVec3, first: DVec3, second: DVec3) -> [DVec3; 4] {
    [corner, corner + first, corner + first + second, corner + second]
}

fn diffuse(points: &[DVec3]) -> f64 {
    polygon(&Ggx::new(0.5), DVec3::Z, points, true, 1e-10).diffuse
}

/// Parallel rectangle with a corner on the normal (Howell's catalogue, B-3).
fn parallel(width: f64, depth: f64, height: f64) -> f64 {
    let (a, b) = (width / height, depth / height);
    let (p, q) = (a.hypot(1.0), b.hypot(1.0));
    (a / p * (b / p).atan() + b / q * (a / q).atan()) / TAU
}

/// Rectangle standing upright on the surface: `width` along, from the foot of the normal distance on, `height` high.
fn perpendicular(width: f64, distance: f64, height: f64) -> f64 {
    let (x, y) = (width / distance, height / distance);
    let root = y.hypot(1.0);
    (x.atan() - (x / root).atan() / root) / TAU
}

#[test]
fn rectangles_agree_with_closed_forms() {
    for width in [1e-2, 0.3, 1.0, 1e3, 1e6] {
        for depth in [1e-2, 1.0, 50.0, 1e6] {
            for distance in [1e-7, 1e-3, 0.5, 1.0, 20.0] {
                let ceiling = rectangle(DVec3::Z * distance, DVec3::Y * depth, DVec3::X * width);
                let expected = parallel(width, depth, distance);
                assert_close(diffuse(&ceiling), expected, 1e-9, "parallel");
                let wall = rectangle(DVec3::X * distance, DVec3::Y * width, DVec3::Z * depth);
                let expected = perpendicular(width, distance, depth);
                // The closed form is the difference of two arc tangents; that limits it for low walls.
                let cancelled = f64::EPSILON * (width / distance).atan() / expected;
                assert_close(
                    diffuse(&wall),
                    expected,
                    1e-9 + cancelled,
                    &format!("wall {width} {depth} {distance}"),
                );
            }
        }
    }
}

#[test]
fn small_lights_keep_their_digits() {
    let brdf = Ggx::new(0.3);
    let eye = view(0.6, 0.4);
    for exponent in 1..=8 {
        let size = 10f64.powi(-exponent);
        let center = dvec3(-0.5, -0.25, 0.75);
        let points = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
            .map(|(x, y)| center + dvec3(x * size, y * size, 0.0));
        let truth = polygon(&brdf, eye, &points, false, 1e-10);
        let direction = center.normalize();
        let solid_angle = 4.0 * size * size * center.z / center.length().powi(3);
        // The point approximation is off by a multiple of size².
        let bound = 20.0 * size * size + 1e-15 / size + 1e-9;
        assert_close(truth.diffuse, solid_angle * direction.z / PI, bound, "diffuse");
        let specular = solid_angle * direction.z * brdf.evaluate(eye, direction);
        assert_close(truth.specular, specular, bound, "specular");
        assert!((truth.specular - specular).abs() <= truth.error.specular + 20.0 * size * size * specular);
        let overhead = rectangle(dvec3(-size, -size, 0.75), DVec3::Y * 2.0 * size, DVec3::X * 2.0 * size);
        let truth = polygon(&brdf, eye, &overhead, false, 1e-10);
        let expected = 4.0 * parallel(size, size, 0.75);
        assert_close(truth.diffuse, expected, 1e-13, "overhead");
        assert!((truth.diffuse - expected).abs() <= truth.error.diffuse);
    }
}

#[test]
fn edge_on_lights_keep_their_digits() {
    for exponent in 1..=14 {
        let height = 10f64.powi(-exponent);
        // A ceiling that is seen ever more obliquely.
        let ceiling = rectangle(dvec3(1.0, 0.0, height), DVec3::Y, DVec3::X);
        let truth = polygon(&Ggx::new(0.5), DVec3::Z, &ceiling, false, 1e-10);
        // ∫ cos·cos/(π·r²) = height²/π · ∫∫ dx dy / (x² + y² + height²)², here for height → 0.
        let expected = height * height / PI * RECIPROCAL_FOURTH;
        assert_close(truth.diffuse, expected, 1e-9 + 4.0 * height * height, &format!("{height:e}"));
    }
}

/// ∫∫ dx dy / (x² + y²)² over 1 < x < 2, 0 < y < 1: of ∫ dy = 1/(2x²(1 + x²)) + atan(1/x)/(2x³), over x by parts.
const RECIPROCAL_FOURTH: f64 = 0.211_933_926_687_651;

#[test]
fn closed_box_returns_the_albedo() {
    let low = -0.7;
    let corners =
        [dvec3(-1.0, -2.0, low), dvec3(3.0, -2.0, low), dvec3(3.0, 1.5, low), dvec3(-1.0, 1.5, low)];
    let up = DVec3::Z * 2.0;
    let mut lights: Vec<Vec<DVec3>> = (0..4)
        .map(|index| {
            let (a, b) = (corners[index], corners[(index + 1) % 4]);
            vec![b, a, a + up, b + up]
        })
        .collect();
    lights.push(corners.iter().rev().map(|corner| *corner + up).collect());
    let sum = |brdf: &Ggx, eye: DVec3| {
        lights.iter().fold([0.0; 3], |sum, light| {
            let truth = polygon(brdf, eye, light, false, 1e-9);
            assert!(truth.converged);
            let values = values(&truth);
            std::array::from_fn(|index| sum[index] + values[index])
        })
    };
    let at_normal = sum(&Ggx::new(1.0), DVec3::Z);
    assert_close(at_normal[0], 1.0, 1e-9, "diffuse");
    assert_close(at_normal[1], 1.0 - LN_2, 1e-9, "albedo at normal incidence, alpha 1");
    for alpha in [4e-4, 0.01, 0.1, 0.4, 1.0] {
        for cosine in [0.02, 0.3, 0.8, 1.0] {
            let brdf = Ggx::new(alpha);
            let eye = view(cosine, 2.2);
            let [diffuse, specular, fresnel] = sum(&brdf, eye);
            assert_close(diffuse, 1.0, 1e-8, "diffuse");
            let [expected, expected_fresnel] = sampled_albedo(&brdf, eye);
            assert_close(specular, expected, 3e-3, &format!("albedo, alpha {alpha}, cosine {cosine}"));
            // Where the Schlick part is carried by rare samples, sampling says little.
            if fresnel > 0.02 {
                assert_close(
                    fresnel,
                    expected_fresnel,
                    2e-2,
                    &format!("Schlick part, alpha {alpha}, cosine {cosine}"),
                );
            }
        }
    }
}

/// Directional albedo and its Schlick part from the model's own samples.
fn sampled_albedo(brdf: &Ggx, eye: DVec3) -> [f64; 2] {
    const SIDE: usize = 300;
    let mut sum = [0.0; 2];
    for index in 0..SIDE * SIDE {
        let cell = DVec2::new((index % SIDE) as f64, (index / SIDE) as f64);
        let light = brdf.sample(eye, (cell + 0.5) / SIDE as f64);
        if light.z > 0.0 {
            let weight = brdf.evaluate(eye, light) * light.z / brdf.pdf(eye, light);
            let schlick = 1.0 - eye.dot((eye + light).normalize());
            sum[0] += weight;
            sum[1] += weight * schlick.powi(5);
        }
    }
    sum.map(|value| value / (SIDE * SIDE) as f64)
}

#[test]
fn mirror_like_lobe_is_found() {
    for alpha in [1e-5, 4e-4, 0.003] {
        for cosine in [0.05, 0.5, 0.999, 1.0] {
            for azimuth in [0.3, 1.9, PI] {
                let eye = view(cosine, azimuth);
                let mirror = dvec3(-eye.x, -eye.y, eye.z);
                let (tangent, bitangent) = mirror.any_orthonormal_pair();
                let half = 0.04;
                let corner = mirror - half * (tangent + bitangent);
                let light = rectangle(corner, 2.0 * half * bitangent, 2.0 * half * tangent);
                let truth = polygon(&Ggx::new(alpha), eye, &light, false, 1e-7);
                assert!(truth.converged);
                // D falls to (α/δ)⁴ of its peak at half vectors δ = half/2 away; its integral beyond is (α/δ)².
                let missing = (2.0 * alpha / half).powi(2);
                let masked = 2.0 * (alpha / cosine).powi(2);
                assert!(truth.specular <= 1.0 + 1e-7, "{}", truth.specular);
                assert!(
                    truth.specular >= 1.0 - 1.5 * missing - masked - 1e-6,
                    "alpha {alpha}, cosine {cosine}: {}",
                    truth.specular
                );
            }
        }
    }
}

#[test]
fn behind_and_below_are_exactly_zero() {
    let brdf = Ggx::new(0.2);
    let eye = view(0.7, 0.0);
    let ceiling = rectangle(dvec3(-1.0, -1.0, 1.0), DVec3::Y * 2.0, DVec3::X * 2.0);
    let front = polygon(&brdf, eye, &ceiling, false, 1e-7);
    assert!(front.diffuse > 0.0);
    let reversed: Vec<DVec3> = ceiling.iter().rev().copied().collect();
    assert_eq!(values(&polygon(&brdf, eye, &reversed, false, 1e-7)), [0.0; 3]);
    let both = polygon(&brdf, eye, &reversed, true, 1e-7);
    for (one, other) in values(&front).into_iter().zip(values(&both)) {
        assert_close(other, one, 1e-12, "two-sided");
    }
    // Around the nadir, touching the horizon, beside the axis below.
    for offset in [dvec3(0.0, 0.0, -2.0), dvec3(0.0, 0.0, -1.0), dvec3(5.0, 0.0, -1.5)] {
        let floor = ceiling.map(|point| point + offset);
        assert_eq!(values(&polygon(&brdf, eye, &floor, true, 1e-7)), [0.0; 3]);
    }
    // In its plane, too few points, no area, no extent.
    let inside = ceiling.map(|point| point - DVec3::Z);
    for points in [&inside[..], &ceiling[..2], &[ceiling[0]; 4], &[DVec3::ZERO; 3], &[]] {
        assert_eq!(values(&polygon(&brdf, eye, points, true, 1e-7)), [0.0; 3]);
    }
    // From below, only the diffuse value is left.
    let below = polygon(&brdf, -eye, &ceiling, false, 1e-7);
    assert_eq!([below.specular, below.fresnel], [0.0; 2]);
    assert_close(below.diffuse, front.diffuse, 1e-7, "diffuse does not depend on the view");
}

/// A plane that surrounds the nadir but reaches above the horizon on one side.
#[test]
fn tilted_floor_around_the_nadir() {
    let brdf = Ggx::new(0.3);
    let eye = view(0.4, 0.5);
    let floor = |from: f64, to: f64| {
        [(from, -3.0), (to, -3.0), (to, 3.0), (from, 3.0)].map(|(x, y)| dvec3(x, y, x - 1.0))
    };
    let whole = polygon(&brdf, eye, &floor(-1.0, 4.0), false, 1e-9);
    let rest = polygon(&brdf, eye, &floor(1.0, 4.0), false, 1e-9);
    assert!(whole.diffuse > 0.0);
    for (whole, rest) in values(&whole).into_iter().zip(values(&rest)) {
        assert_close(whole, rest, 1e-8, "cut at the horizon");
    }
}

#[test]
fn parts_add_up() {
    let mut random = Random(1);
    for case in 0..60 {
        let light = random.light();
        let eye = random.view();
        let brdf = Ggx::new(random.between(0.02, 1.0));
        let whole = polygon(&brdf, eye, &light, true, 1e-9);
        // Triangles of a fan, counted with their signs, make up any polygon.
        let normal = (1..light.len() - 1)
            .map(|index| (light[index] - light[0]).cross(light[index + 1] - light[0]))
            .sum::<DVec3>();
        let mut sum = [0.0; 3];
        let mut magnitude = [0.0; 3];
        for index in 1..light.len() - 1 {
            let triangle = [light[0], light[index], light[index + 1]];
            let sign = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).dot(normal).signum();
            let truth = values(&polygon(&brdf, eye, &triangle, true, 1e-9));
            for component in 0..3 {
                sum[component] += sign * truth[component];
                magnitude[component] += truth[component];
            }
        }
        for (component, value) in values(&whole).into_iter().enumerate() {
            let deviation = (value - sum[component]).abs();
            assert!(
                deviation <= 1e-8 * magnitude[component],
                "case {case}: {value:e}, parts {:e}",
                sum[component]
            );
        }
    }
}

#[test]
fn turned_scaled_and_renumbered_lights_give_the_same() {
    let mut random = Random(2);
    for _ in 0..20 {
        let light = random.light();
        let eye = random.view();
        let brdf = Ggx::new(random.between(0.02, 1.0));
        let expected = values(&polygon(&brdf, eye, &light, true, 1e-9));
        let turn = glam::DMat3::from_rotation_z(random.between(0.0, TAU));
        let turned: Vec<DVec3> = light.iter().map(|&point| turn * point).collect();
        let mut renumbered = light.clone();
        renumbered.rotate_left(1);
        renumbered.insert(1, renumbered[0]);
        renumbered.insert(1, 0.5 * (renumbered[1] + renumbered[2]));
        renumbered.swap(1, 2);
        for scale in [1e-300, 1e-30, 1.0, 1e30, 1e300] {
            let scaled: Vec<DVec3> = light.iter().map(|&point| point * scale).collect();
            let actual = values(&polygon(&brdf, eye, &scaled, true, 1e-9));
            for component in 0..3 {
                assert_close(actual[component], expected[component], 2e-9, "scaled");
            }
        }
        for (points, eye) in [(turned, turn * eye), (renumbered, eye)] {
            let actual = values(&polygon(&brdf, eye, &points, true, 1e-9));
            for component in 0..3 {
                assert_close(actual[component], expected[component], 2e-9, "turned or renumbered");
            }
        }
    }
}

/// True deviations stay within the estimates, and the estimates within the tolerance.
#[test]
fn estimates_hold() {
    let mut random = Random(3);
    for case in 0..60 {
        let light = random.light();
        let eye = random.view();
        let brdf = Ggx::new(10f64.powf(random.between(-3.4, 0.0)));
        let reference = polygon(&brdf, eye, &light, true, 1e-11);
        for tolerance in [1e-2, 1e-3, 1e-4, 1e-6] {
            let truth = polygon(&brdf, eye, &light, true, tolerance);
            assert!(truth.converged);
            for component in 0..3 {
                let expected = values(&reference)[component];
                let deviation = (values(&truth)[component] - expected).abs();
                let estimate = errors(&truth)[component];
                assert!(
                    deviation <= estimate + errors(&reference)[component],
                    "case {case}, tolerance {tolerance}, value {component}: {deviation:e} off {expected:e}, {estimate:e} estimated"
                );
                assert!(estimate <= 2.0 * tolerance * expected, "case {case}: {estimate:e} of {expected:e}");
            }
        }
    }
}

#[test]
fn touching_huge_and_pierced_lights_are_finite() {
    let brdf = Ggx::new(4e-4);
    let eye = view(0.6, 0.2);
    for extent in [1e-5, 1.0, 1e6] {
        for distance in [1e-15, 1e-7, 1e-2, 1.0] {
            for tilt in [0.0, 0.5, 1.0, 1.57, 1.8, 3.0] {
                for shift in [0.0, 1e-9, 0.3, 1.0, 2.0] {
                    let turn = glam::DMat3::from_rotation_y(tilt);
                    let square = rectangle(dvec3(-1.0 + shift, -1.0, 0.0), DVec3::Y * 2.0, DVec3::X * 2.0);
                    let light = square.map(|point| turn * (point * extent + DVec3::Z * distance));
                    let truth = polygon(&brdf, eye, &light, true, 1e-6);
                    for value in values(&truth).into_iter().chain(errors(&truth)) {
                        assert!(value.is_finite() && (0.0..=1.0 + 1e-6).contains(&value), "{truth:?}");
                    }
                    // Closer, rounded vertices no longer tell on which side the light passes.
                    assert!(
                        truth.converged || distance < 1e-10 * extent,
                        "{extent} {distance} {tilt} {shift}: {truth:?}"
                    );
                }
            }
        }
    }
}

/// Quads that a narrow lobe hits, near the surface or far, cut in two through the lobe.
#[test]
fn narrow_lobes_are_not_missed() {
    let mut random = Random(5);
    for case in 0..300 {
        let alpha = 10f64.powf(random.between(-3.4, -0.5));
        let eye = view(10f64.powf(random.between(-2.0, 0.0)), random.between(0.0, TAU));
        let spread = random.between(0.0, 3.0) * alpha;
        let mirror = (dvec3(-eye.x, -eye.y, eye.z) + spread * random.direction()).normalize();
        let normal = random.direction();
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let first = tangent * 10f64.powf(random.between(-4.0, 2.0));
        let second = bitangent * 10f64.powf(random.between(-4.0, 2.0));
        let corner = mirror - random.next() * first - random.next() * second;
        // The cut passes through the lobe's peak.
        let portion = (mirror - corner).dot(first) / first.length_squared();
        let whole = polygon(&Ggx::new(alpha), eye, &rectangle(corner, first, second), true, 1e-8);
        let left = polygon(&Ggx::new(alpha), eye, &rectangle(corner, portion * first, second), true, 1e-8);
        let rest = rectangle(corner + portion * first, (1.0 - portion) * first, second);
        let right = polygon(&Ggx::new(alpha), eye, &rest, true, 1e-8);
        for component in 0..3 {
            let sum = values(&left)[component] + values(&right)[component];
            let allowed = errors(&whole)[component] + errors(&left)[component] + errors(&right)[component];
            let deviation = (values(&whole)[component] - sum).abs();
            assert!(
                deviation <= allowed && allowed <= 1e-6 * sum,
                "case {case}, value {component}: {deviation:e} off {sum:e}, {allowed:e} estimated"
            );
        }
    }
}

/// Cubature over area shares nothing with the method under test but the BRDF.
#[test]
fn area_cubature_agrees() {
    let mut random = Random(4);
    for case in 0..25 {
        let light = random.light();
        let eye = random.view();
        let brdf = Ggx::new(random.between(0.1, 1.0));
        let truth = polygon(&brdf, eye, &light, true, 1e-9);
        let [sum, magnitude] = cubature::by_area(&brdf, eye, &light, 1e-8);
        for component in 0..3 {
            let deviation = (values(&truth)[component] - sum[component]).abs();
            assert!(
                deviation <= 1e-6 * magnitude[component],
                "case {case}: {:?}, by area {sum:?}",
                values(&truth)
            );
        }
    }
}

/// A case whose Schlick part is 1e-15 of the diffuse value: each value has a relative tolerance of its own.
#[test]
fn minute_schlick_part_is_right() {
    let light = [
        dvec3(-0.9359868977599212, 0.3799165803057074, -0.1750174700044012),
        dvec3(-0.8856610464057632, 0.834366232263454, -0.07268012275586694),
        dvec3(-0.9406059132148573, 0.7965695766192571, 0.12218348020572076),
        dvec3(-0.9909317645690153, 0.34211992466151064, 0.019846132957186485),
    ];
    let eye = dvec3(-0.7869580391344363, 0.5149936544821887, 0.33982139497795477);
    let brdf = Ggx::new(0.2189592243545468f64.powi(2));
    let truth = polygon(&brdf, eye, &light, false, 1e-9);
    let [sum, _] = cubature::by_area(&brdf, eye, &light, 1e-9);
    for (value, expected) in values(&truth).into_iter().zip(sum) {
        assert_close(value, expected, 1e-7, "by area");
    }
}
