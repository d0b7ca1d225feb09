//! The errors that the README states hold, against numerical integration.

use softbox::brdf::{Brdf, Ggx};
use softbox::fit::{self, Settings};
use softbox::report::{Accuracy, REGIONS, Region, Technique, accuracy, random_quads};
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

#[test]
fn every_region_keeps_its_figures() {
    // Specular, Schlick part, dielectric, in per cent.
    let bounds = [
        [0.24, 6.3, 0.47],
        [0.56, 2.5, 1.6],
        [3.9, 4.4, 4.3],
        [1.0, 19.5, 1.8],
        [2.8, 8.8, 5.6],
        [8.4, 9.5, 9.0],
        [1.4, 29.5, 2.6],
        [3.2, 17.2, 7.9],
        [5.4, 17.7, 13.3],
    ];
    for (region, [specular, fresnel, dielectric]) in REGIONS.into_iter().zip(bounds) {
        let measured = accuracy(&Table::default(), Technique::Include, &model, &random_quads(region, 1000));
        let bound =
            Accuracy { specular: 0.01 * specular, fresnel: 0.01 * fresnel, dielectric: 0.01 * dielectric };
        assert_within(&format!("{region:?}"), measured, bound);
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
