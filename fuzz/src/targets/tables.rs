//! Table files.

use glam::DVec3;
use softbox::effects::{Layer, Quality};
use softbox::light::{Light, light_value};
use softbox::report::Technique;
use softbox::report::errors::decode_table;
use softbox::shade::ltc_surface;
use softbox::table::{AnisotropicTable, Container, Table};

use super::bytes::Bytes;

/// A table file of a format that the first byte tells: a table of finite numbers, which reads back what it is written as,
/// or a reason.
pub fn table(data: &[u8]) {
    let Some((&kind, rest)) = data.split_first() else { return };
    let extension = ["bin", "dds", "txt", "js"][kind as usize % 4];
    match decode_table(rest, extension) {
        Ok((table, technique)) => assert_table(&table, technique),
        Err(reason) => assert!(reason.len() > 3 && !reason.contains('\n'), "{reason:?}"),
    }
    let mut bytes = Bytes(rest);
    let (size, count) = (usize::from(bytes.byte()), usize::from(bytes.byte()));
    let layers = Layer::THREE_LOBES.into_iter().chain(Layer::BASE).chain(Layer::TWO_LOBES);
    let layers: Vec<Layer> = layers.take(count).collect();
    for size in [size, size << 24, size << 56] {
        if let Ok(table) = Table::from_layers(size, &layers, bytes.0) {
            assert_eq!(table.bytes(), bytes.0);
        }
    }
    let _ = AnisotropicTable::from_bytes(rest);
}

fn assert_table(table: &Table, technique: Technique) {
    let written = Container::Dds.write(table).unwrap_or_else(|error| panic!("{error}"));
    let (again, same) = decode_table(&written, "dds").unwrap_or_else(|reason| panic!("{reason}"));
    assert!(again == *table && same == technique, "another table is read than was written");
    for container in [Container::Ktx, Container::Rust, Container::C] {
        container.write(table).unwrap_or_else(|error| panic!("{error}"));
    }
    // Whatever the numbers are, the twin ends, and the diffuse value needs no table.
    let light = Light::Sphere { center: DVec3::new(0.3, 0.2, 2.0), radius: 0.5 };
    for roughness in [0.0, 0.4, 1.0] {
        let surface =
            ltc_surface::<f32>(glam::Vec3::ZERO, glam::Vec3::Z, glam::Vec3::new(0.6, 0.0, 0.8), roughness);
        let value = light_value(&surface, &table.lobe(&surface), &light);
        assert!((0.0..=1.0).contains(&value.x), "{value}");
        let _ = table.specular(&surface, Quality::Fast.of("sphere+ggx".parse().expect("a set")));
    }
    if table.size() <= 4 {
        let _ = table.peak(0.5);
    }
}
