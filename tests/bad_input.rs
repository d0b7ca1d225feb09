//! Bad input: what the fuzzer keeps is read again, and what it found stays fixed.

#[path = "../fuzz/src/targets/mod.rs"]
mod targets;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Mutex;

use targets::Target;

#[global_allocator]
static MEMORY: targets::Counting = targets::Counting;

/// Memory is counted for the whole process: one test at a time.
static ALONE: Mutex<()> = Mutex::new(());

fn target(name: &str) -> &'static Target {
    targets::ALL.iter().find(|target| target.name == name).unwrap_or_else(|| panic!("no target {name}"))
}

/// Every file of the corpus, each also cut short and with some bytes of another kind.
#[test]
fn the_corpus_is_read_without_a_panic() {
    let _alone = ALONE.lock();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus");
    for target in targets::ALL {
        let folder = root.join(target.name);
        let entries =
            std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
        files.sort();
        assert!(files.len() > 4, "{} holds {} files", folder.display(), files.len());
        let mut read = 0;
        for path in &files {
            let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            let mut variants = vec![bytes.clone(), bytes[..bytes.len() / 2].to_vec()];
            for share in 1..8 {
                let mut changed = bytes.clone();
                if let Some(byte) = changed.get_mut(share * bytes.len() / 8) {
                    *byte ^= 1 << share;
                }
                variants.push(changed);
            }
            for variant in variants {
                if catch_unwind(AssertUnwindSafe(|| target.check(&variant))).is_err() {
                    panic!("{} of {}: {:?}", target.name, path.display(), variant.escape_ascii().to_string());
                }
                read += 1;
            }
        }
        println!("{}: {read} inputs", target.name);
    }
}

/// The check above would tell: a target that takes too much memory, and one that panics.
#[test]
fn memory_and_panics_are_seen() {
    let _alone = ALONE.lock();
    let greedy = Target { name: "greedy", run: |_| drop(vec![1_u8; 2 << 20]), memory: 1 };
    assert!(catch_unwind(|| greedy.check(&[])).is_err());
    let modest = Target { name: "modest", run: |_| drop(vec![1_u8; 1 << 19]), memory: 1 };
    assert!(catch_unwind(|| modest.check(&[])).is_ok());
    let broken = Target { name: "broken", run: |data| assert!(data.is_empty(), "not empty"), memory: 1 };
    assert!(catch_unwind(|| broken.check(&[1])).is_err());
}

/// A picture of 100,000 × 100,000 texels in a file of a few bytes is refused before anything is unpacked.
#[test]
fn a_small_file_of_a_huge_picture_takes_no_memory() {
    let _alone = ALONE.lock();
    let picture = target("picture");
    let mut bytes = std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus/picture/endless"))
        .unwrap_or_else(|error| panic!("{error}"));
    picture.check(&bytes);
    let error = softbox::scene::decode_picture(&bytes).expect_err("too large");
    assert!(!error.is_empty());
    bytes.truncate(33);
    picture.check(&bytes);
}

/// Found by the target `light`: a polygon without a vertex is no light, and no reason to panic.
#[test]
fn a_polygon_without_a_vertex_is_dark() {
    use glam::Vec3;
    use softbox::effects::{Effects, Quality};
    use softbox::light::{Light, LightError, light_value_with};
    let light = Light::Polygon { points: Vec::new(), two_sided: true };
    assert_eq!(light.check(), Err(LightError::TooFewPoints { count: 0 }));
    let surface = softbox::shade::ltc_surface::<f32>(Vec3::ZERO, Vec3::Z, Vec3::Z, 0.5);
    let table = softbox::table::Table::default();
    for effects in [Effects::NONE, Quality::Fast.of("quad,polygon+ggx".parse().expect("a set"))] {
        let value = light_value_with(&surface, &table.specular(&surface, effects), &light, effects);
        assert_eq!(value, Vec3::ZERO, "{effects}");
    }
    assert_eq!(light.bounds().1, 0.0);
    assert_eq!(light.largest_projected_area(), 0.0);
    assert!(!light.range(1.0, 0.1, 1.0).is_nan());
}

/// Found by the target `light`: what is not a number culls no light, and neither does a radius that no light has.
#[test]
fn a_light_of_no_known_size_is_never_culled() {
    use glam::DVec3;
    use softbox::light::Light;
    let sphere = |radius: f64| Light::Sphere { center: DVec3::ZERO, radius };
    assert!(sphere(1.0).range(1.0, 0.1, 1.0).is_finite());
    for radius in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(sphere(radius).range(1.0, 0.1, 1.0), f64::INFINITY, "{radius}");
    }
    let nan = f64::NAN;
    let corner = DVec3::new(0.0, -3.9e261, 1.8e-307);
    let points = vec![corner, corner, corner.with_z(nan), corner.with_z(nan)];
    assert_eq!(Light::Polygon { points, two_sided: true }.range(1.0, 1e-20, 1.0), f64::INFINITY);
    for [radiance, threshold, peak] in [[nan, 0.1, 1.0], [1.0, nan, 1.0], [1.0, 0.1, nan]] {
        let range = sphere(1.0).range(radiance, threshold, peak);
        assert_eq!(range, f64::INFINITY, "{radiance} {threshold} {peak}");
    }
}
