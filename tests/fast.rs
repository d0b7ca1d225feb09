//! The switches that trade accuracy for cost: what they cost in accuracy, on a device and on the CPU.

mod common;

use common::Random;
use glam::DVec3;
use rayon::prelude::*;
use softbox::brdf::Ggx;
use softbox::device::{Batch, Device, EvaluateLight, EvaluateSurface, Program};
use softbox::fit::{fit_half_angle, fit_lobe_formula, fit_round_above};
use softbox::light::Light;
use softbox::report::{Quad, Region, random_quads};
use softbox::shade::{
    LTC_FITTED, LTC_HALF_ANGLE, LTC_ROUND_ABOVE, LtcSurface, ltc_fast_polygon, ltc_fast_quad,
    ltc_lobe_fitted, ltc_quad, ltc_surface,
};
use softbox::table::Table;
use softbox::truth;

const SWITCHES: [&str; 3] = ["cheap_horizon", "cheap_distance", "table_free"];

fn device() -> Device {
    Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"))
}

/// The include and the kernel with some switches on.
fn program(switches: &[&str]) -> Program {
    let mut text = format!("{}\n{}", softbox::WGSL_INCLUDE, softbox::WGSL_EVALUATE);
    for switch in switches {
        let declared = format!("override ltc_use_{switch}: bool = ");
        let switched = text.replace(&format!("{declared}false;"), &format!("{declared}true;"));
        assert_ne!(text, switched, "{switch} is no switch that is off");
        text = switched;
    }
    Program::wgsl(text)
}

fn evaluate(device: &Device, switches: &[&str], batch: &Batch) -> Vec<[f32; 3]> {
    let values = device.evaluate(&program(switches), &Table::default(), batch);
    values.unwrap_or_else(|error| panic!("{error}"))
}

/// The quads as a batch; as polygons of any kind if they are to be `streamed`.
fn batch(quads: &[Quad], streamed: bool) -> Batch {
    let mut batch = Batch::default();
    for (index, quad) in quads.iter().enumerate() {
        batch.surfaces.push(EvaluateSurface {
            roughness: quad.roughness as f32,
            normal: [0.0, 0.0, 1.0],
            view: quad.view.as_vec3().into(),
            ..EvaluateSurface::default()
        });
        let light = batch.add_light(&Light::Polygon { points: quad.corners.to_vec(), two_sided: false });
        if streamed {
            batch.lights[light as usize].flags &= !EvaluateLight::CONVEX_QUAD;
        }
        batch.pairs.push([index as u32, light]);
    }
    batch
}

fn surface(quad: &Quad) -> LtcSurface<f64> {
    // What the device is given.
    let view = quad.view.as_vec3().as_dvec3();
    ltc_surface(DVec3::ZERO, DVec3::Z, view, f64::from(quad.roughness as f32))
}

fn rounded(quad: &Quad) -> [DVec3; 4] {
    quad.corners.map(|corner| corner.as_vec3().as_dvec3())
}

fn twin(quad: &Quad) -> [f64; 3] {
    let surface = surface(quad);
    ltc_fast_quad(&surface, &ltc_lobe_fitted(&surface), rounded(quad), false).into()
}

fn everywhere() -> Region {
    Region { roughness: (0.02, 1.0), cosine: (0.0, 1.0) }
}

#[test]
fn the_device_gives_what_the_twin_gives() {
    let quads = random_quads(everywhere(), 20_000);
    let device = device();
    let values = evaluate(&device, &SWITCHES, &batch(&quads, false));
    let streamed = evaluate(&device, &SWITCHES, &batch(&quads, true));
    let mut worst = [[0.0_f64; 3]; 2];
    for ((quad, value), streamed) in quads.iter().zip(values).zip(streamed) {
        let exact = twin(quad);
        let surface = surface(quad);
        let polygon = ltc_fast_polygon(&surface, &ltc_lobe_fitted(&surface), &rounded(quad), false);
        let polygon: [f64; 3] = polygon.into();
        for k in 0..3 {
            let difference =
                [(value[k], exact[k]), (streamed[k], polygon[k])].map(|(a, b)| (f64::from(a) - b).abs());
            // Sharp lobes magnify the digits that the vertices' directions lack.
            let bound = if k == 0 { 4e-6 } else { 1e-5 + 4e-7 / (quad.roughness * quad.roughness) };
            for (which, difference) in difference.into_iter().enumerate() {
                worst[which][k] = worst[which][k].max(difference / bound);
            }
            assert!(
                difference[0] < bound && difference[1] < bound,
                "{k}: {value:?} and {streamed:?}, exact {exact:?} and {polygon:?}: {quad:?}"
            );
            let apart = (exact[k] - polygon[k]).abs();
            assert!(apart < 1e-9, "{k}: quad {exact:?}, polygon {polygon:?}: {quad:?}");
        }
    }
    println!("largest difference over its bound: quads {:.3?}, polygons {:.3?}", worst[0], worst[1]);
}

/// Mean |error| over mean value in per cent, against what is exact or true.
fn compare(pairs: impl Iterator<Item = ([f64; 3], [f64; 3])>) -> ([f64; 4], [f64; 4]) {
    let (mut errors, mut sums, mut largest) = ([0.0; 4], [0.0; 4], [0.0_f64; 4]);
    let all = |[d, s, f]: [f64; 3]| [d, s, f, 0.04 * (s - f) + f];
    for (value, exact) in pairs {
        let (value, exact) = (all(value), all(exact));
        for k in 0..4 {
            let error: f64 = (value[k] - exact[k]).abs();
            errors[k] += error;
            sums[k] += exact[k];
            largest[k] = largest[k].max(error);
        }
    }
    (core::array::from_fn(|k| 100.0 * errors[k] / sums[k]), largest)
}

/// Against integrals of the model itself.
#[test]
fn the_fast_level_keeps_its_figures() {
    let region = Region { roughness: (0.1, 1.0), cosine: (0.05, 1.0) };
    let quads = random_quads(region, 4000);
    let rows: Vec<_> = quads
        .par_iter()
        .map(|quad| {
            let brdf = Ggx::new(quad.roughness * quad.roughness);
            let exact = truth::polygon(&brdf, quad.view, &quad.corners, false, 1e-5);
            let surface = surface(quad);
            let lobe: [f64; 3] = ltc_quad(&surface, &ltc_lobe_fitted(&surface), quad.corners, false).into();
            (twin(quad), lobe, [exact.diffuse, exact.specular, exact.fresnel])
        })
        .collect();
    let (fast, largest) = compare(rows.iter().map(|row| (row.0, row.2)));
    let (lobe, _) = compare(rows.iter().map(|row| (row.1, row.2)));
    println!("diffuse, specular, Schlick's part, dielectric: fast {fast:.2?} %, at most {largest:.3?}");
    println!("the closed form of the lobe alone: {lobe:.2?} %");
    for (error, bound) in fast.into_iter().zip([2.0, 4.5, 15.5, 11.0]) {
        assert!(error < bound, "{fast:?}");
    }
    for (error, bound) in lobe.into_iter().zip([1e-6, 3.8, 8.6, 6.5]) {
        assert!(error < bound, "{lobe:?}");
    }
    assert!(largest[0] < 0.1, "{largest:?}");
}

/// A square light straight above, ever farther away.
#[test]
fn distant_lights_lose_digits_as_stated() {
    let mut random = Random::new(7);
    let mut quads = Vec::new();
    let mut ratios = Vec::new();
    for _ in 0..20_000 {
        let distance = random.log(4.0, 1e5);
        let mut toward = random.direction();
        toward.z = toward.z.abs() + 0.3;
        let toward = toward.normalize();
        let x = toward.cross(random.direction()).normalize();
        let y = x.cross(toward);
        let centre = toward * distance;
        let offsets = [-x - y, x - y, x + y, y - x];
        let corners = offsets.map(|offset| centre + offset * 0.5);
        quads.push(Quad { roughness: 1.0, view: DVec3::Z, corners });
        ratios.push(distance);
    }
    let device = device();
    let fast = evaluate(&device, &SWITCHES, &batch(&quads, false));
    let streamed = evaluate(&device, &SWITCHES, &batch(&quads, true));
    let uncut = evaluate(&device, &["cheap_distance"], &batch(&quads, false));
    let mut worst = [0.0_f64; 3];
    for ((((quad, ratio), fast), streamed), uncut) in
        quads.iter().zip(ratios).zip(fast).zip(streamed).zip(uncut)
    {
        let surface = surface(quad);
        let lobe = ltc_lobe_fitted(&surface);
        let exact = ltc_quad(&surface, &lobe, rounded(quad), false).x;
        let cheap = ltc_fast_quad(&surface, &lobe, rounded(quad), false).x;
        assert!((exact - cheap).abs() < 1e-3 * exact, "{exact:e} and {cheap:e}: {quad:?}");
        let bound = 1e-6 * ratio + 1e-6;
        for (k, (value, reference)) in
            [(fast[0], cheap), (streamed[0], cheap), (uncut[0], exact)].into_iter().enumerate()
        {
            let error = (f64::from(value) - reference).abs() / reference;
            worst[k] = worst[k].max(error / bound);
            assert!(error < bound, "{k}: {value:e}, exact {reference:e}, distance {ratio}: {quad:?}");
        }
    }
    println!(
        "largest relative error over 1e-6 times distance over size: {worst:.3?} (quad, polygon, cut quad)"
    );
}

/// A panel that stands on the floor, from a point ever closer to its lower edge, with and without a gap between.
#[test]
fn light_is_continuous_where_lights_touch_the_surface() {
    let device = device();
    for gap in [0.0, 1e-4] {
        for turn in [0.0, 0.3, 1.1] {
            let mut quads = Vec::new();
            for step in 0..600 {
                let away = 10.0_f64.powf(-5.0 + 5.5 * f64::from(step) / 599.0);
                let (sine, cosine) = f64::sin_cos(turn);
                let place =
                    |x: f64, z: f64| DVec3::new(x * cosine - away * sine, x * sine + away * cosine, z);
                let corners =
                    [place(-1.0, gap), place(1.0, gap), place(1.0, 1.0 + gap), place(-1.0, 1.0 + gap)];
                let facing = (corners[2] - corners[0]).cross(corners[3] - corners[1]).dot(corners[0]);
                let corners =
                    if facing < 0.0 { corners } else { [corners[3], corners[2], corners[1], corners[0]] };
                quads.push(Quad { roughness: 0.5, view: DVec3::new(0.6, 0.0, 0.8), corners });
            }
            let exact = evaluate(&device, &["table_free"], &batch(&quads, false));
            for streamed in [false, true] {
                let fast = evaluate(&device, &SWITCHES, &batch(&quads, streamed));
                for (index, (fast, exact)) in fast.iter().zip(&exact).enumerate() {
                    let near = quads[index].corners[0];
                    for k in 0..3 {
                        let error = (fast[k] - exact[k]).abs();
                        assert!(error < 0.06, "gap {gap}: {fast:?}, exact {exact:?}, vertex at {near}");
                    }
                }
                for (pair, reference) in fast.windows(2).zip(exact.windows(2)) {
                    for k in 0..3 {
                        let (step, allowed) = (pair[1][k] - pair[0][k], reference[1][k] - reference[0][k]);
                        assert!(
                            (step - allowed).abs() < 0.01,
                            "gap {gap}, turn {turn}: {pair:?} against {reference:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn any_finite_input_gives_physical_values() {
    let mut random = Random::new(3);
    let mut batch = Batch::default();
    for index in 0..60_000_u32 {
        let wild = index % 3 != 0;
        let mut vector = |scale: f64| -> [f32; 3] {
            core::array::from_fn(|_| {
                if wild { random.finite() } else { (scale * (random.unit() - 0.5)).round() as f32 }
            })
        };
        let (normal, view, position) = (vector(2.0), vector(2.0), vector(4.0));
        let points: Vec<DVec3> = (0..4).map(|_| vector(4.0).map(f64::from).into()).collect();
        let is_zero = |v: [f32; 3]| v.iter().all(|c| c.abs() < f32::MIN_POSITIVE);
        let fallback = |v: [f32; 3]| if is_zero(v) { [0.0, 0.0, 1.0] } else { v };
        let surface = EvaluateSurface {
            position,
            roughness: random.between(-0.2, 1.2) as f32,
            normal: fallback(normal),
            view: fallback(view),
            ..EvaluateSurface::default()
        };
        batch.surfaces.push(surface);
        let light = batch.add_light(&Light::Polygon { points, two_sided: index % 2 == 0 });
        if index % 5 < 3 {
            batch.lights[light as usize].flags |= EvaluateLight::CONVEX_QUAD;
        }
        batch.pairs.push([index, light]);
    }
    let device = device();
    let sets: [&[&str]; 5] = [
        &SWITCHES,
        &["cheap_horizon"],
        &["cheap_distance"],
        &["table_free"],
        &["cheap_horizon", "cheap_distance"],
    ];
    for switches in sets {
        let values = evaluate(&device, switches, &batch);
        let lit = values.iter().filter(|value| value[0] > 0.0).count();
        println!("{switches:?}: {lit} of {} are lit", values.len());
        assert!(lit > values.len() / 20, "{switches:?}: only {lit} are lit");
        for (value, pair) in values.iter().zip(&batch.pairs) {
            assert!(
                value.iter().all(|v| (0.0..=1.0).contains(v)) && value[2] <= value[1] + 1e-6,
                "{switches:?}: {value:?}: {:?} {:?}",
                batch.surfaces[pair[0] as usize],
                batch.lights[pair[1] as usize]
            );
        }
    }
}

#[test]
fn the_closed_form_is_a_lobe_everywhere() {
    for i in 0..=200 {
        for j in 0..=200 {
            let (roughness, cosine) = (f64::from(i) / 200.0, (f64::from(j) / 200.0).powi(3));
            let view = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
            let surface = ltc_surface(DVec3::ZERO, DVec3::Z, view, roughness);
            let [x, y, z, w] = LTC_FITTED.shape(surface.roughness, surface.cos_view);
            let (c, s, a) = (surface.cos_view, surface.sin_view, surface.alpha);
            // The determinant over alpha and the two entries that make it positive.
            let (x, z) = (c * c + a * x, s * (c + a * z));
            let determinant = x * w - s * y * z;
            let lobe = ltc_lobe_fitted(&surface);
            assert!(
                x > 0.0 && w > 0.5 && determinant > 0.0,
                "roughness {roughness}, cosine {cosine}: {x} {w} {determinant}"
            );
            assert!(
                (0.25..=1.0).contains(&lobe.albedo) && (0.0..=lobe.albedo).contains(&lobe.fresnel),
                "roughness {roughness}, cosine {cosine}: {} {}",
                lobe.albedo,
                lobe.fresnel
            );
        }
    }
}

#[test]
fn coefficients_are_those_of_the_fits() {
    let near = |what: &str, held: &[f64], fitted: &[f64]| {
        println!("{what}: {fitted:?}");
        for (held, fitted) in held.iter().zip(fitted) {
            assert!((held - fitted).abs() < 2e-4 * (1.0 + fitted.abs()), "{what}: {held} is not {fitted}");
        }
    };
    let (angle, error) = fit_half_angle(2);
    near("half angle", &LTC_HALF_ANGLE, &angle);
    assert!(error < 7.7e-4, "{error}");
    let (above, error) = fit_round_above();
    near("round light", &LTC_ROUND_ABOVE, &above);
    println!("off by {error}");
    assert!(error < 0.0062, "{error}");
    let fitted = fit_lobe_formula();
    near("X", &LTC_FITTED.x, &fitted.x);
    near("Y", &LTC_FITTED.y, &fitted.y);
    near("Z", &LTC_FITTED.z, &fitted.z);
    near("W", &LTC_FITTED.w, &fitted.w);
    near("albedo", &LTC_FITTED.albedo, &fitted.albedo);
    near("Schlick's part", &LTC_FITTED.fresnel, &fitted.fresnel);
}

#[test]
fn the_include_holds_the_same_coefficients() {
    let held = LTC_FITTED;
    let all =
        [&held.x[..], &held.y, &held.z, &held.w, &held.albedo, &held.fresnel, &LTC_ROUND_ABOVE].concat();
    let text = softbox::WGSL_INCLUDE;
    let body = &text[text.find("fn ltc_fast_ratio").expect("the function")..];
    for coefficient in all {
        assert!(body.contains(&coefficient.abs().to_string()), "{coefficient} is not in the include");
    }
    let [a, b, c] = LTC_HALF_ANGLE;
    for value in [2.0 * a, 0.5 * (c - b), 0.25 * c, a - b - 1.0] {
        let near =
            body.split(|ch: char| !(ch.is_ascii_digit() || ch == '.')).filter_map(|word| word.parse().ok());
        let closest = near.fold(f64::INFINITY, |least: f64, number: f64| least.min((number - value).abs()));
        assert!(closest < 1e-7, "{value} is not in the include, by {closest}");
    }
}
