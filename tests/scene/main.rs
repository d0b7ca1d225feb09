//! Scene files are read or refused in one sentence, and their pictures are finite and near ground truth.

mod effects;
mod errors;
mod pictures;
mod twin;

use std::path::{Path, PathBuf};

use glam::DVec3;
use softbox::light::is_convex_quad;
use softbox::scene::{Panel, Scene, write_png};

fn shipped(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    Scene::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_shipped_scenes_are_scenes() {
    assert_eq!(shipped("gallery.toml").lights.len(), 4);
    assert_eq!(shipped("hard.toml").lights.len(), 6);
    let lights = shipped("lights.toml");
    assert_eq!(lights.lights.len(), 8);
    assert!(lights.energy_compensation);
    let picture = lights.lights[0].picture.as_ref().expect("a picture");
    assert_eq!(picture.texels(), [256.0, 144.0]);
}

const CAMERA: &str = "camera = { position = [0, -5, 1], target = [0, 0, 1], field_of_view = 40 }\n";
const SPHERE: &str = "[[sphere]]\ncentre = [0, 0, 1]\nradius = 1\nmaterial = { roughness = 0.5 }\n";
const LIGHT: &str = "[[light]]\npoints = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]\nradiance = 1\n";

#[test]
fn a_scene_needs_neither_lights_nor_objects() {
    assert!(Scene::parse(CAMERA, "scene").is_ok());
    assert!(Scene::parse(&format!("{CAMERA}{SPHERE}{LIGHT}"), "scene").is_ok());
}

const PLANE: &str = "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 2]\nalong = [1, 0, 0]\nextent = [3, 4]\nmaterial = { roughness = 0.5 }\n";

#[test]
fn files_are_whole_or_absent() {
    let panel = Panel { width: 2, height: 1, pixels: vec![[0; 3], [255; 3]] };
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let path = folder.join("two.png");
    write_png(&path, &panel).unwrap_or_else(|error| panic!("{error}"));
    assert!(std::fs::read(&path).is_ok_and(|bytes| bytes.starts_with(b"\x89PNG")));
    let name = write_png(Path::new("two.jpg"), &panel).unwrap_err().to_string();
    assert_eq!(name, "two.jpg: pictures are written as PNG; give a name that ends in .png");
    assert!(write_png(&folder.join("absent/two.png"), &panel).is_err());
}

#[test]
fn convexity_survives_degenerate_quads() {
    let [a, b, c, d] = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
    let middle = DVec3::new(0.5, 0.0, 0.0);
    let dent = DVec3::new(0.3, 0.3, 0.0);
    let turned = |points: [DVec3; 4], by: usize| {
        let mut points = points;
        points.rotate_left(by);
        points
    };
    for by in 0..4 {
        for convex in [
            [a, b, c, d],
            [d, c, b, a],
            [a, b, c, c],
            [a, b, b, b],
            [a, a, a, a],
            [a, a, b, b],
            [a, middle, b, c],
        ] {
            for scale in [1e-30, 1.0, 1e30] {
                let points = turned(convex, by).map(|point| point * scale);
                assert!(is_convex_quad(&points), "{points:?}");
            }
        }
        for concave in [[a, c, b, d], [a, b, dent, d], [a, b, middle, d], [a, b, a, c]] {
            assert!(!is_convex_quad(&turned(concave, by)), "{:?}", turned(concave, by));
        }
    }
    assert!(!is_convex_quad(&[a, b, c]));
    assert!(!is_convex_quad(&[a, b, c, d, d]));
    assert!(!is_convex_quad(&[a, b, c, DVec3::splat(f64::NAN)]));
    // A rectangle that rounding to f32 has bent.
    let rounded = [[0.1, 0.2, 0.3], [1.1, 0.2, 0.3], [1.1, 0.2, 1.7], [0.1, 0.2, 1.7]];
    let bent = rounded.map(|point| DVec3::from(point).as_vec3().as_dvec3());
    assert!(is_convex_quad(&bent));
}
