//! The errors that the README states hold, against numerical integration.

use glam::DVec3;
use rayon::prelude::*;
use softbox::brdf::{Brdf, Ggx};
use softbox::fit::{self, Settings};
use softbox::light::{Light, light_value};
use softbox::report::{Accuracy, Quad, Region, Technique, accuracy, random_quads};
use softbox::shade::ltc_surface;
use softbox::table::Table;
use softbox::truth;

fn model(roughness: f64) -> Box<dyn Brdf> {
    Box::new(Ggx::new(roughness.max(0.02).powi(2)))
}

fn assert_within(what: &str, measured: Accuracy, bound: Accuracy) {
    println!("{what}: {measured:.4?}");
    assert!(
        measured.specular <= bound.specular
            && measured.fresnel <= bound.fresnel
            && measured.dielectric <= bound.dielectric,
        "{what}: {measured:.4?} is beyond {bound:.4?}"
    );
}

/// Quads over the whole range of roughness and view, uniformly.
fn uniform() -> Region {
    Region { roughness: (0.1, 1.0), cosine: (0.05, 1.0) }
}

#[test]
fn the_default_table_keeps_its_figures() {
    let quads = random_quads(uniform(), 4000);
    let measured = accuracy(&Table::default(), Technique::Include, &model, &quads);
    assert_within("include", measured, Accuracy { specular: 0.025, fresnel: 0.072, dielectric: 0.053 });
}

#[test]
fn the_compatible_table_keeps_its_figures() {
    let table = Table::from_bytes(64, softbox::TABLE_COMPATIBLE).expect("the embedded table");
    let quads = random_quads(uniform(), 4000);
    let measured = accuracy(&table, Technique::Published, &model, &quads);
    assert_within(
        "published technique with the compatible table",
        measured,
        Accuracy { specular: 0.049, fresnel: 0.175, dielectric: 0.104 },
    );
}

type Range = (f64, f64);

/// Specular, Schlick part and dielectric, in per cent, for each range of roughness by each of the cosine.
const FIGURES: [(Range, [[f64; 3]; 5]); 4] = [
    (
        (0.02, 0.1),
        [[0.02, 0.9, 0.04], [0.03, 0.3, 0.2], [0.1, 0.25, 0.2], [1.9, 1.8, 1.8], [19.0, 16.0, 16.0]],
    ),
    ((0.1, 0.3), [[0.3, 7.5, 0.5], [0.6, 2.5, 1.7], [4.5, 5.2, 5.0], [21.0, 14.5, 14.5], [36.0, 24.0, 24.0]]),
    (
        (0.3, 0.6),
        [[1.1, 20.0, 1.9], [2.9, 9.5, 6.0], [8.6, 10.0, 9.5], [14.0, 10.5, 10.5], [17.5, 12.0, 12.0]],
    ),
    (
        (0.6, 1.0),
        [[1.6, 31.0, 2.9], [3.4, 17.5, 8.5], [5.6, 19.0, 14.5], [7.7, 23.0, 19.0], [8.0, 24.5, 20.5]],
    ),
];

const COSINES: [Range; 5] = [(0.6, 1.0), (0.3, 0.6), (0.05, 0.3), (0.01, 0.05), (0.001, 0.01)];

#[test]
fn every_region_keeps_its_figures() {
    for (roughness, row) in FIGURES {
        for (cosine, figures) in COSINES.into_iter().zip(row) {
            let quads = random_quads(Region { roughness, cosine }, 600);
            let measured = accuracy(&Table::default(), Technique::Include, &model, &quads);
            let [specular, fresnel, dielectric] = figures.map(|figure| 0.01 * figure);
            let bound = Accuracy { specular, fresnel, dielectric };
            assert_within(&format!("roughness {roughness:?}, cosine {cosine:?}"), measured, bound);
        }
    }
}

/// Small roughness, where tables of matrix entries fail between their first texels.
#[test]
fn sharp_lobes_are_as_good_between_texels() {
    let region = Region { roughness: (0.02, 0.1), cosine: (0.2, 1.0) };
    let measured = accuracy(&Table::default(), Technique::Include, &model, &random_quads(region, 1500));
    assert_within("sharp", measured, Accuracy { specular: 0.0003, fresnel: 0.002, dielectric: 0.001 });
}

/// The measurement can fail: a table of the wrong model is far off.
#[test]
fn a_table_of_another_model_is_condemned() {
    let squared = |roughness: f64| -> Box<dyn Brdf> { Box::new(Ggx::new(roughness.powi(4).max(1e-3))) };
    let settings = Settings { nodes: 16, ..Settings::native(16) };
    let table = Table::pack(&fit::bake(&squared, settings, &|_| ()));
    let measured = accuracy(&table, Technique::Include, &model, &random_quads(uniform(), 300));
    assert!(measured.specular > 0.2, "{measured:?}");
}

/// The other lights are no worse than quads of the same table, tubes no worse than twice as much.
#[test]
fn every_light_keeps_its_figures() {
    let table = Table::default();
    let quads = random_quads(uniform(), 1500);
    type Shape = fn(&Quad) -> Light;
    let shapes: [(&str, Shape, [f64; 4]); 4] = [
        // Bounds of diffuse, specular, Schlick's part and a dielectric, in per cent.
        (
            "quads",
            |quad| Light::Polygon { points: quad.corners.to_vec(), two_sided: false },
            [1e-9, 2.6, 8.6, 5.9],
        ),
        (
            "disks",
            |quad| {
                let [a, b, c, d] = quad.corners;
                let center = 0.25 * (a + b + c + d);
                Light::Disk { center, half_x: 0.5 * (b - a), half_y: 0.5 * (d - a), two_sided: true }
            },
            [1e-9, 2.8, 8.6, 6.0],
        ),
        (
            "spheres",
            |quad| {
                let [a, b, c, _] = quad.corners;
                Light::Sphere {
                    center: 0.5 * (a + c),
                    radius: (0.5 * a.distance(b)).min(0.9 * (0.5 * (a + c)).length()),
                }
            },
            [1e-9, 2.2, 6.9, 4.8],
        ),
        (
            "tubes",
            |quad| {
                let [a, b, ..] = quad.corners;
                let side = (b - a).normalize();
                let along = (-a.dot(side)).clamp(0.0, a.distance(b));
                Light::Tube { start: a, end: b, radius: (a + side * along).length() / 16.0, caps: false }
            },
            [0.11, 6.6, 11.3, 9.6],
        ),
    ];
    for (name, shape, bounds) in shapes {
        let rows: Vec<[f64; 8]> = quads
            .par_iter()
            .map(|quad| {
                let light = shape(quad);
                let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
                let value = light_value(&surface, &table.lobe(&surface), &light);
                let brdf = Ggx::new(quad.roughness * quad.roughness);
                let exact = truth::light(&brdf, quad.view, &light, 1e-6);
                let dielectric = |specular: f64, fresnel: f64| 0.04 * (specular - fresnel) + fresnel;
                let pairs = [
                    (value.x, exact.diffuse),
                    (value.y, exact.specular),
                    (value.z, exact.fresnel),
                    (dielectric(value.y, value.z), dielectric(exact.specular, exact.fresnel)),
                ];
                core::array::from_fn(|k| {
                    let (value, exact) = pairs[k / 2];
                    if k % 2 == 0 { (value - exact).abs() } else { exact }
                })
            })
            .collect();
        let sum = |k: usize| rows.iter().map(|row| row[k]).sum::<f64>();
        let errors: [f64; 4] = core::array::from_fn(|k| 100.0 * sum(2 * k) / sum(2 * k + 1));
        println!(
            "{name}: diffuse {:.1e} %, specular {:.2} %, Schlick {:.2} %, dielectric {:.2} %",
            errors[0], errors[1], errors[2], errors[3]
        );
        for (error, bound) in errors.iter().zip(bounds) {
            assert!(*error < bound.max(1e-4), "{name}: {errors:?} exceed {bounds:?}");
        }
    }
}
