//! Scene files, single cases, pictures.

use std::sync::Arc;

use softbox::scene::{Case, Precision, Scene, decode_picture};
use softbox::texture::{Prefiltered, prefilter};

use super::assert_sentence;
use super::lights::{assert_light_is_described, assert_twin_is_physical};

/// A picture in the place of the one that a text names: what it names is not the fuzzer's to read.
fn stand_in(name: &str) -> Result<Prefiltered, String> {
    if name.len().is_multiple_of(2) {
        Ok(prefilter(2, 1, &[[0.5; 4], [1.0; 4]]))
    } else {
        Err("no such file".to_owned())
    }
}

/// A scene file: a scene of finite numbers, or a sentence that begins with the file's name.
pub fn scene(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    match Scene::parse_with(text, "scene.toml", &stand_in) {
        Ok(scene) => {
            let camera = scene.camera;
            for v in [camera.position, camera.forward, camera.right, camera.up, scene.background] {
                assert!(v.is_finite(), "{camera:?}, {}", scene.background);
            }
            assert!((camera.right.cross(camera.forward) - camera.up).length() < 1e-9, "{camera:?}");
            let _ = scene.effects();
            for light in &scene.lights {
                light.shape.check().unwrap_or_else(|error| panic!("{error}: {light:?}"));
                assert!(light.normal.is_finite() && light.radiance.is_finite(), "{light:?}");
                assert_light_is_described(&light.shape);
            }
        }
        Err(error) => {
            assert_sentence(&error);
            assert!(error.to_string().starts_with("scene.toml"), "{error}");
        }
    }
}

/// A line of JSON: a case that the twin shades to physical values, or a sentence.
pub fn case(data: &[u8]) {
    let mut pictures = |name: &str| stand_in(name).map(Arc::new);
    for precision in [Precision::Single, Precision::Double] {
        match Case::parse(data, precision, &mut pictures) {
            Ok(case) => {
                assert_light_is_described(&case.light);
                if precision == Precision::Single {
                    assert_twin_is_physical(
                        [case.position, case.normal, case.view],
                        case.roughness,
                        &case.light,
                    );
                }
            }
            Err(error) => assert_sentence(&error),
        }
    }
}

/// A PNG file: a pyramid of finite texels, or a reason.
pub fn picture(data: &[u8]) {
    // Large pictures take seconds; a test of their own has them.
    let side = |at: usize| data.get(at..at + 4).map_or(0, |b| u32::from_be_bytes([b[0], b[1], b[2], b[3]]));
    let (width, height) = (side(16), side(20));
    if width.max(height) <= 4096 && u64::from(width) * u64::from(height) > 1 << 18 {
        return;
    }
    match decode_picture(data) {
        Ok(pyramid) => {
            for level in pyramid.levels() {
                assert_eq!(level.texels.len(), level.width * level.height);
                assert!(level.texels.iter().flatten().all(|value| (-1e-3..=1.001).contains(value)));
            }
            assert_eq!(
                pyramid.bytes().len(),
                8 * pyramid.levels().iter().map(|l| l.texels.len()).sum::<usize>()
            );
            let _ = pyramid.ktx2();
        }
        Err(reason) => assert!(reason.len() > 3 && !reason.contains('\n'), "{reason:?}"),
    }
}
