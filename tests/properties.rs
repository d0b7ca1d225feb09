//! Relations that hold whatever the true value is, on the CPU in single precision.

mod common;

use common::Random;
use glam::{DVec3, Mat3, Vec3};
use softbox::shade::{
    LtcLobe, LtcSurface, ltc_angle_excess, ltc_edge_turn, ltc_edge_weight, ltc_lobe, ltc_polygon_add,
    ltc_polygon_begin, ltc_polygon_end, ltc_quad, ltc_surface,
};
use softbox::table::Table;

type Surface = LtcSurface<f32>;
type Lobe = LtcLobe<f32>;

struct Setting {
    random: Random,
    table: Table,
}

impl Setting {
    fn new(seed: u64) -> Self {
        Self { random: Random::new(seed), table: Table::default() }
    }

    fn vector(&mut self) -> Vec3 {
        self.random.direction().as_vec3()
    }

    /// A surface at the origin with any frame, and its lobe.
    fn surface(&mut self) -> (Surface, Lobe) {
        let normal = self.vector();
        let view = (normal + self.vector() * 0.95).normalize();
        let roughness = self.random.between(0.05, 1.0) as f32;
        let surface = ltc_surface::<f32>(Vec3::ZERO, normal, view, roughness);
        let lobe = self.table.lobe(&surface);
        (surface, lobe)
    }

    /// A parallelogram within two of its sizes around the surface point, as a corner and two sides.
    fn parallelogram(&mut self) -> [Vec3; 3] {
        let corner = self.vector() * self.random.between(0.3, 3.0) as f32;
        let x = self.vector() * self.random.log(0.2, 3.0) as f32;
        let y = self.vector() * self.random.log(0.2, 3.0) as f32;
        [corner, x, y]
    }
}

fn quad(surface: &Surface, lobe: &Lobe, [corner, x, y]: [Vec3; 3], two_sided: bool) -> Vec3 {
    ltc_quad(surface, lobe, [corner, corner + x, corner + x + y, corner + y], two_sided)
}

fn polygon(surface: &Surface, lobe: &Lobe, vertices: &[Vec3], two_sided: bool) -> Vec3 {
    let mut polygon = ltc_polygon_begin(surface, vertices[0]);
    for vertex in &vertices[1..] {
        ltc_polygon_add(&mut polygon, surface, lobe, *vertex);
    }
    ltc_polygon_end(&mut polygon, surface, lobe, two_sided)
}

fn assert_near(a: Vec3, b: Vec3, tolerance: Vec3, input: &dyn core::fmt::Debug) {
    assert!((a - b).abs().cmple(tolerance).all(), "{a:?} and {b:?} differ by {:?}: {input:?}", a - b);
}

/// Diffuse, specular; Schlick's part follows the mean direction and does not add up exactly.
const TOLERANCE: Vec3 = Vec3::new(3e-6, 2e-4, f32::INFINITY);

#[test]
fn parts_add_up_to_the_whole() {
    let mut setting = Setting::new(1);
    for _ in 0..20_000 {
        let (surface, lobe) = setting.surface();
        let [corner, x, y] = setting.parallelogram();
        let share = setting.random.unit() as f32;
        let whole = quad(&surface, &lobe, [corner, x, y], true);
        let left = quad(&surface, &lobe, [corner, x * share, y], true);
        let right = quad(&surface, &lobe, [corner + x * share, x * (1.0 - share), y], true);
        assert_near(whole, left + right, TOLERANCE, &(surface, corner, x, y, share));
    }
}

#[test]
fn a_quad_is_the_polygon_of_four_and_two_triangles() {
    let mut setting = Setting::new(2);
    for _ in 0..20_000 {
        let (surface, lobe) = setting.surface();
        let [corner, x, y] = setting.parallelogram();
        let vertices = [corner, corner + x, corner + x + y, corner + y];
        let whole = quad(&surface, &lobe, [corner, x, y], false);
        let same = polygon(&surface, &lobe, &vertices, false);
        assert_near(whole, same, Vec3::new(3e-6, 2e-4, 2e-3), &(surface, vertices));
        let turned = polygon(&surface, &lobe, &[vertices[2], vertices[3], vertices[0], vertices[1]], false);
        assert_near(whole, turned, Vec3::new(3e-6, 2e-4, 2e-3), &(surface, vertices));
        let triangles = polygon(&surface, &lobe, &vertices[..3], false)
            + polygon(&surface, &lobe, &[vertices[0], vertices[2], vertices[3]], false);
        assert_near(whole, triangles, TOLERANCE, &(surface, vertices));
    }
}

#[test]
fn a_reversed_light_shines_the_other_way_and_a_two_sided_one_both_ways() {
    let mut setting = Setting::new(3);
    for _ in 0..20_000 {
        let (surface, lobe) = setting.surface();
        let [corner, x, y] = setting.parallelogram();
        let front = quad(&surface, &lobe, [corner, x, y], false);
        let back = quad(&surface, &lobe, [corner, y, x], false);
        assert!(front.x == 0.0 || back.x == 0.0, "{front} and {back}");
        let both = quad(&surface, &lobe, [corner, x, y], true);
        assert_near(both, front + back, Vec3::new(2e-6, 2e-4, 2e-3), &(surface, corner, x, y));
    }
}

#[test]
fn turning_everything_changes_nothing() {
    let mut setting = Setting::new(4);
    for _ in 0..20_000 {
        let light = setting.parallelogram();
        let (normal, around) = (setting.vector(), setting.vector());
        let view = (normal + around * 0.9).normalize();
        let roughness = setting.random.between(0.2, 1.0) as f32;
        let turn = Mat3::from_axis_angle(setting.vector(), setting.random.between(0.0, 6.0) as f32);
        let at = |turn: Mat3| {
            let surface = ltc_surface::<f32>(Vec3::ZERO, turn * normal, turn * view, roughness);
            let lobe = setting.table.lobe(&surface);
            quad(&surface, &lobe, light.map(|v| turn * v), false)
        };
        assert_near(at(Mat3::IDENTITY), at(turn), Vec3::new(1e-5, 2e-3, 2e-3), &(light, normal, view, turn));
    }
}

/// Nothing in the arithmetic has a length of its own.
#[test]
fn scaling_by_a_power_of_two_changes_no_bit() {
    let mut setting = Setting::new(5);
    for _ in 0..5_000 {
        let (surface, lobe) = setting.surface();
        let light = setting.parallelogram();
        let vertices = [light[0], light[0] + light[1], light[0] + light[1] + light[2]];
        let expected = quad(&surface, &lobe, light, true);
        let streamed = polygon(&surface, &lobe, &vertices, true);
        for exponent in [-40, -20, -1, 1, 20, 40] {
            let scale = 2.0_f32.powi(exponent);
            let scaled = quad(&surface, &lobe, light.map(|v| v * scale), true);
            assert_eq!(
                expected.to_array().map(f32::to_bits),
                scaled.to_array().map(f32::to_bits),
                "2^{exponent}"
            );
            let scaled = polygon(&surface, &lobe, &vertices.map(|v| v * scale), true);
            assert_eq!(
                streamed.to_array().map(f32::to_bits),
                scaled.to_array().map(f32::to_bits),
                "2^{exponent}"
            );
        }
    }
}

#[test]
fn a_larger_light_is_no_darker() {
    let mut setting = Setting::new(6);
    for _ in 0..20_000 {
        let (surface, lobe) = setting.surface();
        let [corner, x, y] = setting.parallelogram();
        let large = quad(&surface, &lobe, [corner, x, y], true);
        let inset = corner + x * 0.1 + y * 0.2;
        let small = quad(&surface, &lobe, [inset, x * 0.7, y * 0.6], true);
        assert!(small.x <= large.x + 2e-6 && small.y <= large.y + 1e-4, "{small} and {large}");
    }
}

/// The faces of a box around the point, seen from inside.
fn closed_box(low: Vec3, high: Vec3) -> Vec<[Vec3; 4]> {
    let corner = |x: bool, y: bool, z: bool| {
        Vec3::new(
            if x { high.x } else { low.x },
            if y { high.y } else { low.y },
            if z { high.z } else { low.z },
        )
    };
    let face = |a: [bool; 3], b: [bool; 3], c: [bool; 3], d: [bool; 3]| {
        let vertices = [a, b, c, d].map(|[x, y, z]| corner(x, y, z));
        let inward = (vertices[2] - vertices[0]).cross(vertices[3] - vertices[1]);
        if inward.dot(vertices[0]) < 0.0 {
            vertices
        } else {
            [vertices[3], vertices[2], vertices[1], vertices[0]]
        }
    };
    let (f, t) = (false, true);
    vec![
        face([f, f, f], [t, f, f], [t, t, f], [f, t, f]),
        face([f, f, t], [t, f, t], [t, t, t], [f, t, t]),
        face([f, f, f], [t, f, f], [t, f, t], [f, f, t]),
        face([f, t, f], [t, t, f], [t, t, t], [f, t, t]),
        face([f, f, f], [f, t, f], [f, t, t], [f, f, t]),
        face([t, f, f], [t, t, f], [t, t, t], [t, f, t]),
    ]
}

/// A furnace: inside a box that glows all over, a surface reflects its albedo.
#[test]
fn a_closed_box_returns_one_and_the_albedo() {
    let mut setting = Setting::new(7);
    for _ in 0..5_000 {
        let (surface, lobe) = setting.surface();
        let mut extent = || Vec3::from_array([0; 3].map(|_| setting.random.log(0.05, 20.0) as f32));
        let faces = closed_box(-extent(), extent());
        let quads: Vec3 = faces.iter().map(|face| ltc_quad(&surface, &lobe, *face, false)).sum();
        let polygons: Vec3 = faces.iter().map(|face| polygon(&surface, &lobe, face, false)).sum();
        for sum in [quads, polygons] {
            assert!((sum.x - 1.0).abs() < 1e-5, "diffuse {}: {faces:?}", sum.x);
            assert!((sum.y - lobe.albedo).abs() < 3e-4, "specular {}, albedo {}", sum.y, lobe.albedo);
        }
    }
}

#[test]
fn the_identity_lobe_is_lambert() {
    let mut setting = Setting::new(8);
    for _ in 0..20_000 {
        let (surface, _) = setting.surface();
        let (c, s, a) = (surface.cos_view, surface.sin_view, surface.alpha);
        let shape = glam::Vec4::new((1.0 - c * c) / a, 0.0, -c / a, 1.0 / a);
        let lobe = ltc_lobe(&surface, shape, glam::Vec4::new(1.0, 1.0, 0.0, 0.0));
        let tilt = lobe.axis_x.dot(surface.normal).abs();
        assert!(tilt < 1e-3 * s.max(1e-3) / a, "{tilt}");
        let light = setting.parallelogram();
        let value = quad(&surface, &lobe, light, false);
        assert!((value.x - value.y).abs() < 5e-5, "{value}: {surface:?} {light:?}");
    }
}

/// Across the change from one form of the sum to the other, at a light's size of a quarter of its
/// distance, and from the quad's to the polygon's functions.
#[test]
fn no_seam_shows_between_near_and_far_lights() {
    let mut setting = Setting::new(9);
    let mut worst = 0.0_f32;
    for _ in 0..20_000 {
        let (surface, lobe) = setting.surface();
        let direction = (surface.normal + setting.vector() * 0.8).normalize();
        let [x, y] = {
            let x = direction.any_orthonormal_vector();
            [x, direction.cross(x)]
        };
        let (x, y) = (x + direction * 0.3, y - direction * 0.2);
        // The first vertex's farthest neighbour is at a quarter of its distance.
        let size = 0.25 / (x + y).length();
        let at = |size: f32| quad(&surface, &lobe, [direction, y * size, x * size], false);
        let (below, above) = (at(size * (1.0 - 1e-6)), at(size * (1.0 + 1e-6)));
        if below.x > 1e-4 {
            let step = ((above.x - below.x) / below.x).abs();
            worst = worst.max(step);
            // Net of what exact arithmetic makes of the two lights. Rounding counts by 1 / (α cos θ) in the
            // space of a lobe.
            let exact = |size: f32| {
                let to = |v: Vec3| v.as_dvec3();
                let view = surface.tangent * surface.sin_view + surface.normal * surface.cos_view;
                let roughness = f64::from(surface.roughness);
                let surface = ltc_surface::<f64>(DVec3::ZERO, to(surface.normal), to(view), roughness);
                let lobe = setting.table.lobe(&surface);
                let corners =
                    [direction, direction + y * size, direction + y * size + x * size, direction + x * size];
                ltc_quad(&surface, &lobe, corners.map(to), false).y
            };
            let step =
                f64::from(above.y - below.y) - (exact(size * (1.0 + 1e-6)) - exact(size * (1.0 - 1e-6)));
            let rounding = 2e-7 / (surface.alpha * surface.cos_view.max(1e-3));
            assert!(
                step.abs() <= f64::from(1e-5 * below.y + rounding),
                "{below} and {above}: {step}, {rounding}"
            );
        }
    }
    println!("largest relative step {worst:.2e}");
    assert!(worst > 0.0, "no light was seen");
}

/// Small steps of the light make small steps of the value, down through the horizon.
#[test]
fn values_are_continuous() {
    let mut setting = Setting::new(10);
    for _ in 0..200 {
        let (surface, lobe) = setting.surface();
        let [corner, x, y] = setting.parallelogram();
        let motion = -surface.normal * 2.0 * (corner.dot(surface.normal).abs() + x.length() + y.length());
        // Where the light's own plane passes through the point, half the sky may change at once.
        let area = x.cross(y);
        if (area.dot(corner) > 0.0) != (area.dot(corner + motion) > 0.0) {
            continue;
        }
        let mut previous: Option<Vec3> = None;
        let steps = 2_000;
        for step in 0..=steps {
            let offset = motion * (step as f32 / steps as f32);
            let value = quad(&surface, &lobe, [corner + offset, x, y], true);
            if let Some(previous) = previous {
                let change = (value - previous).abs();
                assert!(change.x < 0.02 && change.y < 0.1, "{previous} to {value} at step {step}");
            }
            previous = Some(value);
        }
        assert_eq!(previous.map(|value| value.x), Some(0.0), "a light below is dark");
    }
}

#[test]
fn the_frame_survives_every_view() {
    let mut setting = Setting::new(11);
    for i in 0..100_000 {
        let normal = setting.vector() * setting.random.log(1e-30, 1e30) as f32;
        let view = match i % 4 {
            0 => normal,
            1 => normal.normalize() + setting.vector() * setting.random.log(1e-9, 1e-2) as f32,
            2 => -normal,
            _ => setting.vector() * setting.random.log(1e-30, 1e30) as f32,
        };
        let surface = ltc_surface::<f32>(Vec3::ZERO, normal, view, 0.5);
        let frame = Mat3::from_cols(surface.tangent, surface.bitangent, surface.normal);
        let product = frame * frame.transpose();
        for (axis, expected) in
            [product.x_axis, product.y_axis, product.z_axis].into_iter().zip([Vec3::X, Vec3::Y, Vec3::Z])
        {
            assert!((axis - expected).abs().max_element() < 1e-6, "{normal:?} {view:?}: {surface:?}");
        }
        assert!((0.0..=1.0).contains(&surface.cos_view) && (0.0..=1.0).contains(&surface.sin_view));
    }
}

/// Every float from 2⁻¹⁵⁰ to 1 but for a stride, against the function in f64.
#[test]
fn the_angle_s_polynomial_keeps_its_bound() {
    let one = 1.0_f32.to_bits();
    let (mut worst, mut at) = (0.0_f64, 0.0);
    for bits in (0..=one).step_by(37) {
        let k = f32::from_bits(bits);
        let error =
            (f64::from(1.0 + ltc_angle_excess(k)) / (1.0 + ltc_angle_excess(f64::from(k))) - 1.0).abs();
        if error > worst {
            (worst, at) = (error, k);
        }
    }
    println!("largest relative error {worst:.3e} at {at}");
    assert!(worst < 2e-7, "{worst:e} at {at}");
}

#[test]
fn the_include_holds_the_fitted_coefficients() {
    let (coefficients, error) = softbox::fit::fit_angle_excess(7);
    assert!(error < 7.5e-8, "{error:e}");
    for coefficient in coefficients {
        let text = format!("{:?}", (coefficient as f32).abs());
        assert!(softbox::WGSL_INCLUDE.contains(&text), "{text} does not stand in the include");
    }
}

/// The form in wide use, which takes the sine from 1 − (a·b)²: the tests above would not pass it.
fn published_edge(a: Vec3, b: Vec3) -> Vec3 {
    let cosine = a.dot(b);
    let ratio = 1.0 + ltc_angle_excess(1.0 - cosine.abs());
    let obtuse = core::f32::consts::PI / (1.0 - cosine * cosine).max(1e-7).sqrt() - ratio;
    a.cross(b) * if cosine > 0.0 { ratio } else { obtuse }
}

#[test]
fn the_published_edge_integral_is_condemned() {
    let worst = |edge: fn(Vec3, Vec3) -> Vec3| {
        (1..=7)
            .map(|exponent| {
                let gap = 10.0_f32.powi(-exponent);
                let corners = [
                    Vec3::new(-1.0, gap, 0.0),
                    Vec3::new(1.0, gap, 0.0),
                    Vec3::new(1.0, gap, 2.0),
                    Vec3::new(-1.0, gap, 2.0),
                ];
                let units = corners.map(Vec3::normalize);
                let sum: f32 = (0..4).map(|i| edge(units[(i + 1) % 4], units[i]).z).sum();
                let exact = 2.0 * common::perpendicular(1.0, 2.0, f64::from(gap));
                (f64::from(sum) / core::f64::consts::TAU - exact).abs()
            })
            .fold(0.0, f64::max)
    };
    let own = |a: Vec3, b: Vec3| {
        let (normal, cosine) = (a.cross(b - a), a.dot(b));
        let weight = ltc_edge_weight(cosine, 1.0);
        normal * (weight + ltc_edge_turn::<f32>(cosine, weight, normal))
    };
    assert!(worst(published_edge) > 0.1, "{}", worst(published_edge));
    assert!(worst(own) < 2e-6, "{}", worst(own));
}

/// A regular polygon of many vertices over the point comes close to the disk's closed form.
#[test]
fn many_vertices_make_a_disk() {
    let surface = ltc_surface::<f32>(Vec3::ZERO, Vec3::Z, Vec3::Z, 0.5);
    let lobe = Table::default().lobe(&surface);
    for (radius, height) in [(1.0_f64, 1.0_f64), (0.1, 3.0), (50.0, 0.5)] {
        let count = 4096;
        let vertices: Vec<Vec3> = (0..count)
            .map(|i| {
                let azimuth = -core::f64::consts::TAU * f64::from(i) / f64::from(count);
                DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), height).as_vec3()
            })
            .collect();
        let value = polygon(&surface, &lobe, &vertices, false);
        let exact = radius * radius / (radius * radius + height * height);
        assert!((f64::from(value.x) - exact).abs() < 5e-6, "{} and {exact}", value.x);
    }
}
