//! The table: baked again it is the same, packed it is safe, and every file of it reads back.

mod common;

use std::process::Command;

use common::tools;
use softbox::brdf::{Beckmann, Brdf, Ggx, Lambert, Masking};
use softbox::fit::{self, Layout, Settings};
use softbox::table::{Container, Table, clipped_sphere};

fn bake(settings: Settings) -> Table {
    Table::pack(&fit::bake(&fit::ggx, settings, &|_| ()))
}

#[test]
fn the_committed_tables_are_what_a_bake_gives() {
    assert!(bake(Settings::native(64)).bytes() == softbox::TABLE_NATIVE, "table/ltc.bin is stale");
    assert!(
        bake(Settings::compatible(64)).bytes() == softbox::TABLE_COMPATIBLE,
        "table/ltc_compatible.bin is stale"
    );
}

#[test]
fn a_bake_does_not_depend_on_the_number_of_threads() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
        pool.install(|| bake(Settings::native(16)).bytes())
    };
    assert!(with(1) == with(3));
}

#[test]
fn every_size_bakes() {
    for size in [2, 3, 8, 33] {
        let table = bake(Settings { nodes: 16, ..Settings::native(size) });
        assert_eq!(table.size(), size);
        assert_eq!(Table::from_bytes(size, &table.bytes()), Ok(table));
    }
}

#[test]
fn no_texel_is_subnormal_and_amplitudes_are_physical() {
    for bytes in [softbox::TABLE_NATIVE, softbox::TABLE_COMPATIBLE] {
        let table = Table::from_bytes(64, bytes).expect("the embedded table");
        for row in 0..64 {
            for column in 0..64 {
                for layer in 0..2 {
                    let texel = table.texel(layer, column, row);
                    for number in texel {
                        assert!(number.is_finite(), "layer {layer} ({column}, {row}): {texel:?}");
                        let magnitude = number.to_f32().abs();
                        assert!(magnitude == 0.0 || number.is_normal(), "({column}, {row}): {texel:?}");
                    }
                }
                let [albedo, fresnel, ..] = table.texel(1, column, row).map(f32::from);
                assert!(
                    0.0 < albedo && albedo <= 1.0 && (0.0..=albedo).contains(&fresnel),
                    "({column}, {row}): albedo {albedo}, Schlick part {fresnel}"
                );
            }
        }
    }
}

#[test]
fn bytes_that_are_no_table_are_refused() {
    let refused = |size, bytes: &[u8]| {
        let error = Table::from_bytes(size, bytes).expect_err("these bytes are no table");
        assert!(error.to_string().contains("bytes"), "{error}");
    };
    refused(64, &[]);
    refused(64, &softbox::TABLE_NATIVE[1..]);
    refused(usize::MAX, softbox::TABLE_NATIVE);
    refused(1, &[0; 16]);
    let mut infinite = softbox::TABLE_NATIVE.to_vec();
    infinite[..2].copy_from_slice(&half::f16::INFINITY.to_le_bytes());
    refused(64, &infinite);
}

/// The albedo in closed form: 1 − ln 2 for α = 1 seen along the normal; and for small α no energy is
/// lost at all.
#[test]
fn albedos_agree_with_closed_forms() {
    let table = Table::default();
    let albedo = |column, row| table.texel(1, column, row)[0].to_f64();
    let expected = 1.0 - core::f64::consts::LN_2;
    assert!((albedo(63, 63) - expected).abs() < 3e-4, "{} is not {expected}", albedo(63, 63));
    assert!((albedo(0, 63) - 1.0).abs() < 5e-4, "{}", albedo(0, 63));
}

#[test]
fn a_diffuse_surface_bakes_to_the_identity() {
    let family = |_: f64| -> Box<dyn Brdf> { Box::new(Lambert) };
    let fitted = fit::bake(&family, Settings { layout: Layout::Compatible, ..Settings::native(8) }, &|_| ());
    for row in 0..8 {
        for column in 0..8 {
            let lobe = fitted.lobe(column, row);
            for (entry, expected) in lobe.entries().into_iter().zip([1.0, 0.0, 0.0, 1.0]) {
                assert!((entry - expected).abs() < 2e-3, "({column}, {row}): {lobe:?}");
            }
            let texel = fitted.texels[column + row * 8];
            assert!((texel.albedo - 1.0).abs() < 1e-3, "({column}, {row}): {}", texel.albedo);
        }
    }
}

/// Each model's sampling has the density it says, and a smooth one loses no energy.
#[test]
fn samples_have_their_density() {
    let models: [(&str, Box<dyn Brdf>, f64); 5] = [
        ("GGX 0.1", Box::new(Ggx::new(0.1)), 0.01),
        ("GGX 0.6", Box::new(Ggx::new(0.6)), 0.01),
        ("Schlick", Box::new(Ggx { alpha: 0.3, masking: Masking::Schlick { k: 0.15 } }), 0.01),
        ("Beckmann", Box::new(Beckmann { alpha: 0.3 }), 0.01),
        ("Lambert", Box::new(Lambert), 0.01),
    ];
    for (name, model, tolerance) in &models {
        for cosine in [0.3_f64, 0.8, 1.0] {
            let view = glam::DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
            // ∫ f·cos by the model's samples and by uniform ones.
            let mut random = common::Random::new(7);
            let (mut own, mut uniform) = (0.0, 0.0);
            let count = 400_000;
            for _ in 0..count {
                let light = model.sample(view, glam::DVec2::new(random.unit(), random.unit()));
                let value = model.evaluate(view, light);
                if value > 0.0 {
                    own += value * light.z / model.pdf(view, light);
                }
                let light = random.direction();
                uniform += model.evaluate(view, light) * light.z.max(0.0) * 4.0 * core::f64::consts::PI;
            }
            let (own, uniform) = (own / f64::from(count), uniform / f64::from(count));
            assert!(
                (own - uniform).abs() < tolerance * uniform.max(0.5) * 2.0 && own <= 1.0 + tolerance,
                "{name}, cosine {cosine}: {own} by own samples, {uniform} by uniform ones"
            );
        }
    }
}

/// The fourth channel against the integral of the cosine over the part of a cap above the horizon.
#[test]
fn the_clipped_sphere_is_the_integral_over_a_cap() {
    for whole in [0.01, 0.3, 0.7, 0.99] {
        for cosine in [-0.9, -0.3, -0.05, 0.0, 0.2, 0.6, 1.0_f64] {
            let sine = (1.0 - cosine * cosine).sqrt();
            let limit = (1.0_f64 - whole).sqrt();
            let steps = 800;
            let mut sum = 0.0;
            for i in 0..steps {
                let z = limit + (1.0 - limit) * (f64::from(i) + 0.5) / f64::from(steps);
                let radius = (1.0 - z * z).sqrt();
                for j in 0..steps {
                    let azimuth = core::f64::consts::TAU * (f64::from(j) + 0.5) / f64::from(steps);
                    sum += (z * cosine + radius * azimuth.cos() * sine).max(0.0);
                }
            }
            let integral = sum * (1.0 - limit) * 2.0 / f64::from(steps) / f64::from(steps) / whole;
            let formula = clipped_sphere(cosine, whole);
            assert!(
                (integral - formula).abs() < 1e-4,
                "cosine {cosine}, whole {whole}: {integral} and {formula}"
            );
        }
    }
}

#[test]
fn dds_reads_back() {
    let bytes = Container::Dds.write(&Table::default()).expect("a DDS file");
    let mut decoder = dds::Decoder::new(bytes.as_slice()).expect("another reader takes the file");
    assert_eq!(decoder.format(), dds::Format::R16G16B16A16_FLOAT);
    assert_eq!(decoder.main_size(), dds::Size::new(64, 64));
    let mut layers = Vec::new();
    for _ in 0..2 {
        let mut layer = vec![0_u8; 64 * 64 * 16];
        let view = dds::ImageViewMut::new(&mut layer, dds::Size::new(64, 64), dds::ColorFormat::RGBA_F32)
            .expect("a buffer of the layer's size");
        decoder.read_surface(view).expect("two layers");
        layers.extend(layer);
    }
    let read: Vec<f32> =
        layers.chunks_exact(4).map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect();
    assert_eq!(read, numbers());
}

fn numbers() -> Vec<f32> {
    softbox::TABLE_NATIVE
        .chunks_exact(2)
        .map(|pair| half::f16::from_le_bytes([pair[0], pair[1]]).to_f32())
        .collect()
}

#[test]
fn ktx_reads_back() {
    let bytes = Container::Ktx.write(&Table::default()).expect("a KTX file");
    let reader = ktx2::Reader::new(bytes.as_slice()).expect("another reader takes the file");
    let header = reader.header();
    assert_eq!(header.format, Some(ktx2::Format::R16G16B16A16_SFLOAT));
    assert_eq!((header.pixel_width, header.pixel_height, header.layer_count), (64, 64, 2));
    let levels: Vec<_> = reader.levels().collect();
    assert_eq!(levels.len(), 1);
    assert!(levels[0].data == softbox::TABLE_NATIVE);
    assert_eq!(reader.dfd_blocks().len(), 1, "one data format descriptor");
}

#[test]
fn the_c_header_and_the_rust_constant_compile_to_the_bytes() {
    let folder = tools::scratch("table");
    let table = Table::default();
    let text = |container: Container| container.write(&table).expect("a text");
    tools::write(&folder, "ltc.h", text(Container::C));
    let source = tools::write(
        &folder,
        "main.cpp",
        "#include \"ltc.h\"\n#include \"ltc.h\"\n#include <cstdio>\nint main() { return std::fwrite(ltc_table, 2, 8 * LTC_TABLE_SIZE * LTC_TABLE_SIZE, stdout) == 0; }\n",
    );
    let program = folder.join("c");
    tools::run(Command::new("g++").arg("-Wall").arg("-Werror").arg(source).arg("-o").arg(&program));
    let printed = Command::new(&program).output().expect("the program runs").stdout;
    assert!(printed == softbox::TABLE_NATIVE, "the C header holds other numbers");

    tools::write(&folder, "ltc.rs", text(Container::Rust));
    let source = tools::write(
        &folder,
        "main.rs",
        "include!(\"ltc.rs\");\nuse std::io::Write;\nfn main() { for word in LTC_TABLE { std::io::stdout().write_all(&word.to_le_bytes()).unwrap(); } assert_eq!(LTC_TABLE.len(), 8 * LTC_TABLE_SIZE * LTC_TABLE_SIZE); }\n",
    );
    let program = folder.join("rust");
    tools::run(Command::new("rustc").args(["--edition", "2024"]).arg(source).arg("-o").arg(&program));
    let printed = Command::new(&program).output().expect("the program runs").stdout;
    assert!(printed == softbox::TABLE_NATIVE, "the Rust constant holds other numbers");
}
