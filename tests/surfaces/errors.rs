//! How close the layers come to the models on random quads, and the shader to the twin.

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use softbox::brdf::{Brdf, Charlie, Eon};
use softbox::device::{Batch, Device, EvaluateSurface, Program};
use softbox::light::Light;
use softbox::report::{Quad, REGIONS, Region, random_quads};
use softbox::shade::{
    LtcLobe, LtcSurface, Vector, ltc_coat_over, ltc_energy_compensation, ltc_quad, ltc_rough_diffuse,
    ltc_sheen_over, ltc_surface, ltc_surface_with_roughness,
};
use softbox::table::{Layer, Table};
use softbox::truth;

use crate::{lobe, table};

/// Quads that no parameter of the fits was chosen with.
fn fresh_quads(region: Region, count: usize) -> Vec<Quad> {
    random_quads(region, 4000 + count).split_off(4000)
}

/// Mean |value − truth| over mean truth.
fn error(quads: &[Quad], pair: impl Fn(&Quad) -> (f64, f64) + Sync + Send) -> f64 {
    let pairs: Vec<(f64, f64)> = quads.par_iter().map(pair).collect();
    let difference: f64 = pairs.iter().map(|(value, exact)| (value - exact).abs()).sum();
    difference / pairs.iter().map(|(_, exact)| exact).sum::<f64>()
}

fn shade(table: &Table, layer: Layer, quad: &Quad) -> (LtcSurface<f64>, LtcLobe<f64>, DVec3) {
    let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
    let lobe = lobe(table, layer, &surface);
    (surface, lobe, ltc_quad(&surface, &lobe, quad.corners, false))
}

fn exact(model: &dyn Brdf, quad: &Quad) -> f64 {
    truth::polygon(model, quad.view, &quad.corners, false, 1e-5).specular
}

fn everywhere() -> Region {
    Region { roughness: (0.1, 1.0), cosine: (0.05, 1.0) }
}

const GRAZING: Region = Region { roughness: (0.1, 1.0), cosine: (0.01, 0.05) };

fn assert_figures(what: &str, figures: [f64; 11], measure: impl Fn(&[Quad]) -> f64) {
    let regions = [everywhere()].into_iter().chain(REGIONS).chain([GRAZING]);
    let mut failures = Vec::new();
    for (index, (region, figure)) in regions.zip(figures).enumerate() {
        let measured = 100.0 * measure(&fresh_quads(region, if index == 0 { 4000 } else { 800 }));
        println!("{what}: {region:?}: {measured:.2} per cent, at most {figure}");
        if measured > figure {
            failures.push(format!("{region:?}: {measured:.2} per cent is more than {figure}"));
        }
    }
    assert!(failures.is_empty(), "{what}: {failures:#?}");
}

#[test]
fn sheen_keeps_its_figures() {
    let table = table();
    let figures = [9.2, 11.0, 12.1, 14.5, 10.9, 12.7, 12.6, 6.4, 7.6, 9.4, 13.8];
    assert_figures("sheen", figures, |quads| {
        error(quads, |quad| {
            (shade(&table, Layer::Sheen, quad).2.y, exact(&Charlie::of_roughness(quad.roughness), quad))
        })
    });
}

#[test]
fn rough_diffuse_keeps_its_figures() {
    let table = table();
    let figures = [1.45, 0.22, 0.7, 1.75, 0.48, 1.55, 3.3, 0.95, 2.2, 4.8, 4.3];
    assert_figures("first bounce", figures, |quads| {
        error(quads, |quad| {
            (shade(&table, Layer::Diffuse, quad).2.y, exact(&Eon::single(quad.roughness), quad))
        })
    });
    for (colour, figures) in [
        (1.0, [2.25, 0.8, 0.8, 1.7, 1.85, 1.85, 3.1, 3.2, 3.0, 4.6, 4.2]),
        (0.5, [1.8, 0.46, 0.72, 1.75, 1.12, 1.65, 3.2, 2.0, 2.5, 4.7, 4.3]),
    ] {
        assert_figures(&format!("all bounces, colour {colour}"), figures, |quads| {
            error(quads, |quad| {
                let (surface, lobe, value) = shade(&table, Layer::Diffuse, quad);
                let reflected = ltc_rough_diffuse(&surface, &lobe, value, DVec3::splat(colour));
                (reflected.x, exact(&Eon { colour, ..Eon::new(quad.roughness) }, quad))
            })
        });
    }
}

/// What it costs to take the mean of what later bounces leave at grazing angles, alone: everything else
/// is integrated numerically.
#[test]
fn the_mean_of_later_bounces_costs_little() {
    let quads = fresh_quads(everywhere(), 2000);
    let measured = error(&quads, |quad| {
        let model = Eon::new(quad.roughness);
        let single = truth::polygon(&Eon::single(quad.roughness), quad.view, &quad.corners, false, 1e-5);
        let later = (1.0 - model.single_albedo(quad.view.z)) * single.diffuse;
        (single.specular + later, exact(&model, quad))
    });
    println!("the mean of later bounces alone: {:.2} per cent", 100.0 * measured);
    assert!((0.001..0.02).contains(&measured), "{measured}");
}

/// What it would cost to leave the model out, and that the measurement can fail.
#[test]
fn lambert_is_no_rough_diffuse_surface() {
    let table = table();
    let quads = fresh_quads(everywhere(), 1000);
    let lambert = error(&quads, |quad| {
        (shade(&table, Layer::Diffuse, quad).2.x, exact(&Eon::new(quad.roughness), quad))
    });
    println!("Lambert in place of the rough diffuse surface: {:.1} per cent", 100.0 * lambert);
    assert!(lambert > 0.1, "{lambert}");
}

#[test]
fn single_precision_is_close_to_double() {
    let table = table();
    let single = |v: DVec3| v.as_vec3();
    let mut worst = 0.0_f64;
    for quad in random_quads(everywhere(), 4000) {
        // The same rounded input for both.
        let (eye, corners) = (single(quad.view), quad.corners.map(single));
        let roughness = quad.roughness as f32;
        let narrow = ltc_surface::<f32>(Vec3::ZERO, Vec3::Z, eye, roughness);
        let wide = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, eye.as_dvec3(), roughness.into());
        for layer in [Layer::Sheen, Layer::Diffuse] {
            let value = ltc_quad(&narrow, &lobe(&table, layer, &narrow), corners, false).y();
            let exact = ltc_quad(&wide, &lobe(&table, layer, &wide), corners.map(Vec3::as_dvec3), false).y();
            let difference = (f64::from(value) - exact).abs();
            worst = worst.max(difference);
            assert!(difference < 1e-5, "{layer:?}: {value} and {exact} for {quad:?}");
        }
    }
    println!("largest difference between f32 and f64: {worst:.1e}");
}

/// The shader finds its layers and computes what the twin computes.
#[test]
fn a_device_agrees_with_the_twin() {
    let device = Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"));
    let table = table();
    let colour = Vec3::new(0.2, 0.6, 1.0);
    let quads = random_quads(everywhere(), 2000);
    let mut batch = Batch::default();
    for (index, quad) in quads.iter().enumerate() {
        batch.surfaces.push(EvaluateSurface {
            position: [0.0; 3],
            roughness: quad.roughness as f32,
            normal: [0.0, 0.0, 1.0],
            view: quad.view.as_vec3().into(),
            ..EvaluateSurface::default()
        });
        let light = batch.add_light(&Light::Polygon { points: quad.corners.to_vec(), two_sided: false });
        batch.pairs.push([index as u32, light]);
    }
    type Combine = fn(&LtcSurface<f32>, &LtcLobe<f32>, Vec3, Vec3) -> Vec3;
    let cases: [(Layer, &str, &str, Combine); 4] = [
        (
            Layer::Sheen,
            "ltc_sheen_lobe_from_table(surface, table, table_sampler, table_size, 2)",
            "ltc_sheen_over(vec3<f32>(0.5), lobes.first, value, vec3<f32>(0.2, 0.6, 1.0))",
            |_, lobe, value, colour| ltc_sheen_over(Vec3::splat(0.5), lobe, value, colour),
        ),
        (
            Layer::Diffuse,
            "ltc_diffuse_lobe_from_table(surface, table, table_sampler, table_size, 3)",
            "ltc_rough_diffuse(surface, lobes.first, value, vec3<f32>(0.2, 0.6, 1.0))",
            ltc_rough_diffuse,
        ),
        (
            Layer::Shape,
            "ltc_lobe_from_table(surface, table, table_sampler, table_size)",
            "ltc_coat_over(vec3<f32>(0.5), lobes.first, value, 0.04, 0.7)",
            |_, lobe, value, _| ltc_coat_over(Vec3::splat(0.5), lobe, value, 0.04, 0.7),
        ),
        (
            Layer::Shape,
            "ltc_lobe_from_table(ltc_surface_with_roughness(surface, 0.9), table, table_sampler, table_size)",
            "ltc_energy_compensation(lobes.first, vec3<f32>(0.2, 0.6, 1.0))",
            |_, lobe, _, colour| ltc_energy_compensation(lobe, colour),
        ),
    ];
    for (layer, make, combine, twin) in cases {
        let kernel = softbox::WGSL_EVALUATE
            .replace(
                "ltc_lobes_from_table(surface, table, table_sampler, table_size, 0)",
                &format!("ltc_lobes_of(surface, {make})"),
            )
            .replace("vec4<f32>(value, 0.0)", &format!("vec4<f32>({combine}, 0.0)"));
        assert!(kernel.contains(make) && kernel.contains(combine), "the kernel has changed its words");
        let program = Program::wgsl(format!("{}{kernel}", softbox::WGSL_INCLUDE));
        let values = device.evaluate(&program, &table, &batch).unwrap_or_else(|error| panic!("{error}"));
        let mut worst = 0.0_f32;
        for (quad, value) in quads.iter().zip(values) {
            let surface = ltc_surface::<f32>(Vec3::ZERO, Vec3::Z, quad.view.as_vec3(), quad.roughness as f32);
            let rough = ltc_surface_with_roughness(&surface, 0.9);
            let at = if make.contains("0.9") { &rough } else { &surface };
            let lobe = lobe(&table, layer, at);
            let light = ltc_quad(&surface, &lobe, quad.corners.map(|corner| corner.as_vec3()), false);
            let expected = twin(&surface, &lobe, light, colour);
            let difference = (Vec3::from(value) - expected).abs().max_element();
            worst = worst.max(difference);
            // Filtering on a device has 8 bits of its own.
            assert!(difference < 4e-3, "{combine}: {value:?} and {expected} for {quad:?}");
        }
        println!("{combine}: largest difference {worst:.1e}");
    }
}
