//! The methods that reports compare with are what they claim to be, on the CPU and in WGSL.

mod common;

use common::Random;
use glam::{DVec2, DVec3, Mat3, Vec3};
use rayon::prelude::*;
use softbox::brdf::{Brdf, Ggx};
use softbox::device::Device;
use softbox::fit;
use softbox::report::compare::{self, Input, Samples};
use softbox::report::costs::{Kernel, programs};
use softbox::report::{Method, Quad, Region, Technique, random_quads, shade};
use softbox::truth;

/// What every figure of a report is measured on: quads over the whole range of roughness and view.
fn quads(count: usize) -> Vec<Quad> {
    random_quads(Region { roughness: (0.1, 1.0), cosine: (0.05, 1.0) }, count)
}

/// A quad with coordinates that single precision has.
fn rounded(quad: &Quad) -> Quad {
    let round = |v: DVec3| v.as_vec3().as_dvec3();
    Quad {
        roughness: f64::from(quad.roughness as f32),
        view: round(quad.view),
        corners: quad.corners.map(round),
    }
}

fn device() -> Device {
    Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"))
}

/// Every method that exists in WGSL.
fn methods() -> Vec<Box<dyn Method>> {
    let mut methods = compare::comparators();
    methods.extend(compare::Level::all().map(|level| Box::new(level) as Box<dyn Method>));
    methods
}

/// The functions that take any space.
type Function = fn(&Input) -> [f32; 3];
const FUNCTIONS: [(&str, Function); 4] = [
    ("published", |input| compare::published_value(&compare::published_table(), input)),
    ("proxy", |input| compare::proxy_value(&compare::published_table(), input)),
    ("representative", compare::representative_value),
    ("phong", |input| compare::phong_value(&compare::published_table(), input)),
];

#[test]
fn names_are_unique_and_all_but_the_truth_are_in_wgsl() {
    let names: Vec<String> = methods().iter().map(|method| method.info().name).collect();
    let wanted = "published proxy representative phong samples-1 samples-4 samples-16 samples-64 light-16 brdf-16 standard";
    for name in wanted.split(' ') {
        assert_eq!(names.iter().filter(|known| *known == name).count(), 1, "{name} among {names:?}");
        assert!(compare::wgsl(name).is_some(), "{name} has no WGSL");
    }
    assert_eq!(compare::Truth::default().info().name, "truth");
    assert!(compare::wgsl("truth").is_none());
}

/// A text can be put beside any other: its names are its own, and it needs nothing of the include.
#[test]
fn texts_stand_alone_under_names_of_their_own() {
    for method in compare::comparators() {
        let name = method.info().name;
        let text = compare::wgsl(&name).unwrap_or_else(|| panic!("{name} has no WGSL"));
        assert!(!text.contains("ltc_"), "{name} calls the include");
        let prefix = if name.contains('-') { "samples" } else { &name };
        for line in text.lines() {
            let declared = ["fn ", "struct ", "const "].iter().find_map(|word| line.strip_prefix(word));
            let Some(declared) = declared else { continue };
            let declared = declared.to_ascii_lowercase();
            assert!(
                declared.starts_with(prefix) || declared.starts_with("method_value("),
                "{name} declares {line:?}"
            );
        }
        let kernel = Kernel::of(&name).unwrap_or_else(|| panic!("{name} has no kernel"));
        programs(&kernel).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

/// The largest difference of two lists of values, relative to their size where that is above 1.
fn distance(a: &[f32; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|k| (f64::from(a[k]) - b[k]).abs() / b[k].abs().max(1.0)).fold(0.0, f64::max)
}

#[test]
fn a_device_returns_what_the_cpu_does() {
    let quads = quads(1500);
    let device = device();
    for method in methods() {
        let name = method.info().name;
        let values = compare::run(&device, &name, &quads).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(values.len(), quads.len());
        let random = compare::wgsl(&name).is_some_and(|text| text.contains("samples_hash"));
        let mut apart: Vec<(f64, usize)> = quads
            .iter()
            .enumerate()
            .map(|(i, quad)| (distance(&values[i], &method.value(quad)), i))
            .collect();
        apart.sort_by(|a, b| b.0.total_cmp(&a.0));
        // A ray that meets the light's very edge may count on one side only.
        let skipped = if random { quads.len() / 500 } else { 0 };
        let (worst, i) = apart[skipped];
        println!("{name}: {worst:.1e} apart, at worst {:.1e}", apart[0].0);
        assert!(
            worst < 5e-5,
            "{name}: {:?} on {}, {:?} on the CPU, for {:?}",
            values[i],
            device.info().name,
            method.value(&quads[i]),
            quads[i]
        );
        assert!(values.iter().any(|value| value[0] > 0.1 && value[1] > 0.1), "{name} is dark");
    }
    // The comparison can fail: these two differ at the horizon only.
    let values = compare::run(&device, "proxy", &quads).unwrap_or_else(|error| panic!("{error}"));
    let published = compare::Published::default();
    let worst = quads.iter().zip(&values).map(|(quad, value)| distance(value, &published.value(quad)));
    assert!(worst.fold(0.0, f64::max) > 1e-3);
}

/// Moves an input to any place and orientation.
fn moved(input: &Input, random: &mut Random) -> Input {
    let z = random.direction().as_vec3();
    let x = z.any_orthonormal_vector();
    let turn = Mat3::from_cols(x, z.cross(x), z);
    let offset = random.direction().as_vec3();
    Input {
        position: offset + turn * input.position,
        normal: turn * input.normal,
        view: turn * input.view,
        roughness: input.roughness,
        corners: input.corners.map(|v| offset + turn * v),
    }
}

#[test]
fn values_do_not_depend_on_the_space() {
    let mut random = Random::new(7);
    let device = device();
    let inputs: Vec<Input> = quads(400).iter().map(Input::from).collect();
    let elsewhere: Vec<Input> = inputs.iter().map(|input| moved(input, &mut random)).collect();
    for (name, function) in FUNCTIONS {
        let on_device =
            compare::run_inputs(&device, name, &elsewhere).unwrap_or_else(|error| panic!("{name}: {error}"));
        for ((input, other), on_device) in inputs.iter().zip(&elsewhere).zip(&on_device) {
            let (here, there) = (function(input), function(other));
            assert!(
                distance(&there, &here.map(f64::from)) < 2e-4,
                "{name}: {here:?}, {there:?} for {input:?}"
            );
            assert!(
                distance(on_device, &there.map(f64::from)) < 2e-4,
                "{name}: {there:?}, {on_device:?} on the device for {other:?}"
            );
        }
    }
}

/// Exact clipping and exact edges with the same table differ by rounding and the fit of the edge integral only.
#[test]
fn published_is_the_exact_polygon_integral_of_its_lobes() {
    let table = compare::published_table();
    let method = compare::Published::default();
    let mut cases = [0; 16];
    let mut random = Random::new(11);
    let mut total = 0.0;
    for quad in &quads(4000) {
        let mut quad = rounded(quad);
        // Any vertex may be the first.
        quad.corners.rotate_left(random.index(4));
        let above = |i: usize| usize::from(quad.corners[i].z > 0.0) << i;
        cases[above(0) + above(1) + above(2) + above(3)] += 1;
        let [diffuse, specular, fresnel] = method.value(&quad);
        let [exact, exact_fresnel] = shade(&table, Technique::Published, &quad);
        let brdf = softbox::brdf::Lambert;
        let exact_diffuse = truth::polygon(&brdf, quad.view, &quad.corners, false, 1e-7).diffuse;
        for (value, exact) in [(diffuse, exact_diffuse), (specular, exact), (fresnel, exact_fresnel)] {
            // Edges of nearly half a turn, which sharp lobes have, lose most of their digits.
            assert!((value - exact).abs() < 1e-3, "{value} instead of {exact} for {quad:?}");
            total += (value - exact).abs();
        }
    }
    println!("mean difference {:.1e}", total / 12_000.0);
    assert!(total / 12_000.0 < 2e-6, "{total}");
    let impossible = |case: usize| case == 0b0101 || case == 0b1010;
    for (case, count) in cases.iter().enumerate().skip(1) {
        assert!((*count > 0) != impossible(case), "case {case:04b} came {count} times");
    }
}

#[test]
fn the_edge_integral_keeps_its_error() {
    let (coefficients, error) = fit::fit_published_angle();
    let written = [0.863_855_5, 0.498_149_1, 0.014_316_3, 3.455_423_7, 4.192_250_5];
    for (fitted, written) in coefficients.iter().zip(written) {
        assert!((fitted - written).abs() < 2e-7, "{fitted} is written as {written}");
    }
    assert!(error < 6e-7, "{error}");
    let angles = (1..30_000).map(|i| f64::from(i) * 1e-4);
    for angle in angles {
        let direction = DVec2::from_angle(angle).as_vec2();
        let edge = compare::published_edge(Vec3::X, direction.extend(0.0));
        let exact = f64::from(direction.y).atan2(f64::from(direction.x)) / core::f64::consts::TAU;
        let relative = (f64::from(edge.z) / exact - 1.0).abs();
        // Near half a turn the square of the cosine has lost the sine's digits.
        let bound = 1e-6 + 1.5e-7 / angle.sin().powi(2).min(1.0);
        assert!(relative < bound, "{} instead of {exact} at {angle}: {relative:e}", edge.z);
    }
    // The formula's known end: opposite directions have no edge at all.
    let flat = compare::published_edge(Vec3::X, Vec3::new(-1.0, 1e-5, 0.0).normalize());
    assert!(flat.z < 0.1, "{flat}, half a turn is 0.5");
}

#[test]
fn the_table_is_the_one_that_is_baked() {
    let table = compare::published_table();
    for (column, row) in [(20, 50), (45, 0), (45, 20), (45, 63)] {
        let (_, lobe) = fit::published_lobe(table.size(), column, row);
        let stored = table.texel(0, column, row).map(f64::from);
        for (fitted, stored) in lobe.entries().into_iter().zip(stored) {
            let error = (fitted - stored).abs();
            assert!(error < 1e-4 + 1e-3 * fitted.abs(), "({column}, {row}): {fitted} is stored as {stored}");
        }
    }
}

/// The fit has three parameters: the normal of the lobe's horizon is the BRDF's mean direction.
#[test]
fn lobes_of_the_table_stand_on_the_mean_direction() {
    for (column, row) in [(20, 30), (40, 20), (60, 40)] {
        let (brdf, lobe) = fit::published_lobe(64, column, row);
        let cosine = 1.0 - (row as f64 / 63.0).powi(2);
        let view = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
        let mut mean = DVec3::ZERO;
        for i in 0..100 * 100 {
            let light = brdf
                .sample(view, DVec2::new(((i % 100) as f64 + 0.5) / 100.0, ((i / 100) as f64 + 0.5) / 100.0));
            if light.z > 0.0 {
                mean += light * (brdf.evaluate(view, light) * light.z / brdf.pdf(view, light));
            }
        }
        let (axis, mean) = (DVec3::new(lobe.y, 0.0, lobe.w).normalize(), mean.normalize());
        assert!(axis.distance(mean) < 5e-3, "({column}, {row}): {axis} instead of {mean}");
        let mirror = DVec3::new(-view.x, 0.0, view.z);
        assert!(axis.distance(mirror) > 1e-2, "({column}, {row}): the test cannot tell {axis} from {mirror}");
    }
}

/// Mean |error| over mean value, in per cent: of diffuse, specular, Schlick's part and a dielectric.
fn errors(method: &dyn Method, quads: &[Quad], truths: &[[f64; 3]]) -> [f64; 4] {
    let four = |v: [f64; 3]| [v[0], v[1], v[2], 0.04 * (v[1] - v[2]) + v[2]];
    let mut sums = [[0.0; 2]; 4];
    for (quad, truth) in quads.iter().zip(truths) {
        let (value, truth) = (four(method.value(quad)), four(*truth));
        for k in 0..4 {
            sums[k][0] += (value[k] - truth[k]).abs();
            sums[k][1] += truth[k];
        }
    }
    sums.map(|[error, value]| 100.0 * error / value)
}

#[test]
fn errors_lie_where_each_technique_has_them() {
    let quads = quads(3000);
    let truth = compare::Truth::default();
    let truths: Vec<[f64; 3]> = quads.par_iter().map(|quad| truth.value(quad)).collect();
    let find = |name: &str| {
        methods().into_iter().find(|method| method.info().name == name).unwrap_or_else(|| panic!("{name}"))
    };
    // Smallest and largest error of each kind.
    let windows: [(&str, [[f64; 2]; 4]); 5] = [
        ("standard", [[0.0, 1e-3], [1.5, 2.6], [4.0, 7.5], [3.0, 5.5]]),
        ("published", [[0.0, 1e-3], [4.5, 8.0], [10.0, 22.0], [6.5, 13.0]]),
        ("proxy", [[1.0, 6.0], [4.5, 8.0], [10.0, 22.0], [6.5, 13.0]]),
        ("phong", [[0.0, 1e-3], [10.0, 25.0], [13.0, 35.0], [11.0, 30.0]]),
        ("representative", [[10.0, 45.0], [40.0, 250.0], [100.0, 900.0], [80.0, 700.0]]),
    ];
    for (name, windows) in windows {
        let measured = errors(find(name).as_ref(), &quads, &truths);
        println!("{name}: {measured:.3?} %");
        for (error, [low, high]) in measured.iter().zip(windows) {
            assert!((low..=high).contains(error), "{name}: {measured:?} leaves {windows:?}");
        }
    }
    // Four times the directions, about half the error.
    let specular = |name: &str| errors(find(name).as_ref(), &quads, &truths)[1];
    let ladder = ["samples-1", "samples-4", "samples-16", "samples-64"].map(specular);
    println!("1, 4, 16 and 64 directions: {ladder:.2?} %");
    for pair in ladder.windows(2) {
        assert!((1.5..3.5).contains(&(pair[0] / pair[1])), "{ladder:?}");
    }
    assert!(ladder[2] < specular("light-16") && ladder[2] < specular("brdf-16"), "{ladder:?}");
    assert!(errors(&truth, &quads, &truths).iter().all(|error| *error < 1e-12));
}

/// Mean and standard error of a variant's values over many seeds.
fn mean(samples: &Samples, input: &Input, seeds: u32) -> [[f64; 2]; 3] {
    let mut sums = [[0.0; 2]; 3];
    for seed in 0..seeds {
        let seed = [seed.wrapping_mul(0x9E37_79B9), 0x85EB_CA6B, 17];
        for (sum, value) in sums.iter_mut().zip(compare::samples_value(samples, input, seed)) {
            let value = f64::from(value);
            sum[0] += value;
            sum[1] += value * value;
        }
    }
    let n = f64::from(seeds);
    sums.map(|[sum, squares]| {
        let mean = sum / n;
        [mean, ((squares / n - mean * mean).max(0.0) / (n - 1.0)).sqrt()]
    })
}

/// The mean over seeds is the integral: within 4.5 standard errors for 144 means, whose squared deviations average to one.
#[test]
fn monte_carlo_has_no_bias() {
    const SEEDS: u32 = 20_000;
    let region = Region { roughness: (0.35, 1.0), cosine: (0.2, 1.0) };
    let lit = |quad: &Quad| {
        let value = compare::Truth::default().value(quad);
        value[0] > 0.02 && value[1] > 0.02
    };
    let quads: Vec<Quad> = random_quads(region, 60).iter().map(rounded).filter(lit).take(8).collect();
    assert_eq!(quads.len(), 8);
    let pairs: Vec<(Samples, &Quad)> =
        Samples::ALL.iter().flat_map(|samples| quads.iter().map(|quad| (*samples, quad))).collect();
    let deviations: Vec<f64> = pairs
        .par_iter()
        .flat_map(|(samples, quad)| {
            let seeds = SEEDS / samples.count.min(4);
            let means = mean(samples, &Input::from(*quad), seeds);
            let truth = compare::Truth::default().value(quad);
            let deviations = [0, 1, 2].map(|k| {
                let [mean, error] = means[k];
                assert!(error < 0.1 * truth[k], "{}: {error} tells nothing of {}", samples.name, truth[k]);
                let deviation = (mean - truth[k]) / error;
                assert!(
                    deviation.abs() < 4.5,
                    "{}: {mean} ± {error} instead of {} for {quad:?}",
                    samples.name,
                    truth[k]
                );
                deviation
            });
            deviations.to_vec()
        })
        .collect();
    let square = deviations.iter().map(|d| d * d).sum::<f64>() / deviations.len() as f64;
    let worst = deviations.iter().fold(0.0_f64, |worst, d| worst.max(d.abs()));
    println!("{} means, worst {worst:.2} standard errors, mean square {square:.2}", deviations.len());
    assert!((0.5..1.6).contains(&square), "{square}");
    // The test can fail: a surface that is rougher by a twentieth is told from this one.
    let (quad, samples) = (&quads[0], &Samples::ALL[3]);
    let rougher = Quad { roughness: 1.05 * quad.roughness, ..quad.clone() };
    let [mean, error] = mean(samples, &Input::from(&rougher), 4000)[1];
    let truth = compare::Truth::default().value(quad)[1];
    assert!((mean - truth).abs() > 6.0 * error, "{mean} ± {error} is taken for {truth}");
}

/// A cosine to a power around the mirror direction, normalised over its own hemisphere.
struct PhongLobe {
    exponent: f64,
}

impl Brdf for PhongLobe {
    fn evaluate(&self, view: DVec3, light: DVec3) -> f64 {
        let along = (view.z * light.z - view.x * light.x - view.y * light.y).max(0.0);
        let lobe = (self.exponent + 1.0) / core::f64::consts::TAU * along.powf(self.exponent);
        if light.z > 0.0 { lobe / light.z } else { 0.0 }
    }

    fn sample(&self, _view: DVec3, _random: DVec2) -> DVec3 {
        DVec3::Z
    }

    fn pdf(&self, _view: DVec3, _light: DVec3) -> f64 {
        0.0
    }

    fn width(&self) -> f64 {
        1.0 / self.exponent.sqrt()
    }
}

#[test]
fn axial_moments_are_the_integral_of_the_lobe() {
    let mut seen = 0;
    for (index, quad) in quads(1600).iter().enumerate() {
        let quad = rounded(quad);
        let exponents = [1.0, 2.0, 3.0, 4.5, 9.0, 31.0, 200.0, 2047.0];
        let exponent: f64 = exponents[index % exponents.len()];
        let [diffuse, lobe] = compare::phong_integrals(&Input::from(&quad), exponent as f32);
        // To the power of 2047 a length that is not quite 1 shows.
        let quad = Quad { view: quad.view.normalize(), ..quad };
        // Between odd exponents it interpolates.
        let low = 1.0 + 2.0 * (0.5 * (exponent - 1.0)).floor();
        let share = 0.5 * (exponent - low);
        let integral = |exponent: f64| {
            let exact = truth::polygon(&PhongLobe { exponent }, quad.view, &quad.corners, false, 1e-7);
            assert!(exact.error.specular < 1e-6, "{exact:?}");
            [exact.diffuse, exact.specular]
        };
        let [exact_diffuse, first] = integral(low);
        let second = if share > 0.0 { integral(low + 2.0)[1] } else { 0.0 };
        let exact = (1.0 - share) * first + share * second;
        assert!((f64::from(diffuse) - exact_diffuse).abs() < 3e-6, "{diffuse}, {exact_diffuse} for {quad:?}");
        // Sharp lobes amplify the rounding of the vertices' directions.
        let bound = 3e-6 + 4e-7 * exponent.sqrt();
        assert!(
            (f64::from(lobe) - exact).abs() < bound,
            "{lobe} instead of {exact} for the exponent {exponent} and {quad:?}"
        );
        seen += usize::from(exact > 0.05);
    }
    assert!(seen > 300, "only {seen} lobes were lit");
}

/// A square that faces the surface point, with sides of `size` times its distance.
fn square(towards: DVec3, size: f64) -> [DVec3; 4] {
    let x = towards.any_orthonormal_vector();
    let y = x.cross(towards);
    let half = 0.5 * size;
    [towards - (x + y) * half, towards + (x - y) * half, towards + (x + y) * half, towards + (y - x) * half]
}

#[test]
fn a_small_light_has_its_representative_point_anywhere() {
    let mut random = Random::new(3);
    let mut farthest = 0.0_f64;
    for _ in 0..300 {
        let up = |v: DVec3| DVec3::new(v.x, v.y, v.z.abs() + 0.2).normalize();
        let (view, towards) = (up(random.direction()), up(random.direction()));
        let roughness = random.between(0.3, 1.0);
        let value = |size: f64| {
            let quad = Quad { roughness, view, corners: square(towards, size) };
            let [diffuse, specular, fresnel] = compare::Representative.value(&quad);
            [diffuse, specular, fresnel].map(|part| part / (size * size))
        };
        let brdf = Ggx::new(roughness * roughness);
        let specular = brdf.evaluate(view, towards) * towards.z;
        let exact =
            [towards.z / core::f64::consts::PI, specular, specular * softbox::brdf::schlick(view, towards)];
        for size in [1e-2, 1e-3] {
            let found = value(size);
            for k in 0..3 {
                // The lobe is widened by size / 2√π, so the peak falls by about size / (√π α).
                let bound = exact[k] * 16.0 * size + 1e-6;
                assert!(
                    (found[k] - exact[k]).abs() < bound,
                    "part {k}: {} instead of {} at the size {size}, roughness {roughness}, view {view}, light {towards}",
                    found[k],
                    exact[k]
                );
            }
        }
        farthest = farthest.max((value(0.5)[1] / exact[1] - 1.0).abs());
    }
    assert!(farthest > 0.3, "the test cannot tell large lights from small ones: {farthest}");
}

/// With the mirror direction inside a light that covers the lobe, the light's radiance comes back, and at a slanted view
/// more than that: the normalisation knows nothing of the foreshortening.
#[test]
fn the_representative_point_keeps_energy_along_the_normal_only() {
    let value = |cosine: f64| {
        let view = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
        let mirror = DVec3::new(-view.x, 0.0, view.z);
        compare::Representative.value(&Quad { roughness: 0.1, view, corners: square(mirror, 0.6) })[1]
    };
    assert!((0.85..=1.0).contains(&value(1.0)), "{}", value(1.0));
    let ratio = value(0.4) / value(1.0);
    assert!((ratio * 0.4 - 1.0).abs() < 0.05, "{ratio} instead of 1 / 0.4");
}

#[test]
fn a_light_behind_or_below_gives_nothing() {
    let view = DVec3::new(0.6, 0.0, 0.8);
    let above = square(DVec3::new(-0.6, 0.0, 0.8), 0.5);
    let turned = [above[3], above[2], above[1], above[0]];
    let below = above.map(|corner| corner - DVec3::Z * 5.0);
    for method in methods() {
        let name = method.info().name;
        let at = |roughness, corners| method.value(&Quad { roughness, view, corners });
        let value = |corners| at(0.5, corners);
        // One direction may miss.
        assert!((1..10).any(|i| at(0.1 * f64::from(i), above)[1] > 0.0), "{name} is dark");
        assert_eq!(value(turned), [0.0; 3], "{name} sees the light's back");
        // The sphere in place of the light is cut by a table, which has a last row.
        assert!(value(below).iter().all(|part| *part <= 2e-6), "{name}: {:?} from below", value(below));
    }
}
