//! The errors that the README states hold, against numerical integration.

use softbox::brdf::{Brdf, Ggx};
use softbox::fit::{self, Settings};
use softbox::report::{Accuracy, Region, Technique, accuracy, random_quads};
use softbox::table::Table;

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
