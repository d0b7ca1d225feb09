//! Scene files are read or refused in one sentence, and their pictures are finite and near ground truth.

use std::path::{Path, PathBuf};

use glam::DVec3;
use softbox::device::Device;
use softbox::light::{is_convex_quad, light_value};
use softbox::scene::{Comparison, Hit, Panel, Scene, render_truth, write_png};
use softbox::shade::ltc_surface;
use softbox::table::Table;

fn shipped(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    Scene::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_shipped_scenes_are_scenes() {
    assert_eq!(shipped("gallery.toml").lights.len(), 4);
    assert_eq!(shipped("hard.toml").lights.len(), 6);
}

const CAMERA: &str = "camera = { position = [0, -5, 1], target = [0, 0, 1], field_of_view = 40 }\n";
const SPHERE: &str = "[[sphere]]\ncentre = [0, 0, 1]\nradius = 1\nmaterial = { roughness = 0.5 }\n";
const LIGHT: &str = "[[light]]\npoints = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]\nradiance = 1\n";

#[test]
fn a_scene_needs_neither_lights_nor_objects() {
    assert!(Scene::parse(CAMERA, "scene").is_ok());
    assert!(Scene::parse(&format!("{CAMERA}{SPHERE}{LIGHT}"), "scene").is_ok());
}

#[test]
fn every_mistake_is_named_in_one_sentence() {
    let cases: &[(&str, &str, &str, &str)] = &[
        (
            SPHERE,
            "radius = 1",
            "radius = 0",
            "s: sphere 1: radius is 0; it must be a length from 1e-6 to 1e6",
        ),
        (
            SPHERE,
            "radius = 1",
            "radius = nan",
            "s: sphere 1: radius is NaN; it must be a length from 1e-6 to 1e6",
        ),
        (SPHERE, "radius = 1\n", "", "s, line 2: missing field `radius`"),
        (
            SPHERE,
            "radius = 1",
            "radius = 1\nweight = 2",
            "s, line 5: unknown field `weight`, expected one of `centre`, `radius`, `material`",
        ),
        (SPHERE, "0.5", "1.5", "s: sphere 1: roughness is 1.5; it must be a number from 0 to 1"),
        (
            SPHERE,
            "0.5",
            "'rough'",
            "s, line 5: invalid type: string \"rough\", expected a number from 0 to 1 or { from, to, start, end }",
        ),
        (
            SPHERE,
            "0.5",
            "{ from = 0, to = 1, start = [1, 0, 0], end = [1, 0, 0] }",
            "s: sphere 1: roughness's start and end are one point; they must be apart",
        ),
        (
            SPHERE,
            "0.5",
            "0.5, f0 = 2",
            "s: sphere 1: f0 is [2.0, 2.0, 2.0]; a reflectance must be from 0 to 1",
        ),
        (
            SPHERE,
            "0.5",
            "0.5, base_colour = [1, 0]",
            "s, line 5: invalid length 2, expected one number or three, [red, green, blue]",
        ),
        (
            SPHERE,
            "[0, 0, 1]",
            "[0, 0, inf]",
            "s: sphere 1: centre is [0.0, 0.0, inf]; each number must be finite and from -1e6 to 1e6",
        ),
        (LIGHT, "[1, 0, 1], ", "", "s: light 1: points holds 2 of them; a light needs three or more"),
        (
            LIGHT,
            "[1, 0, 1], ",
            "[0, 2, 1], ",
            "s: light 1: points cover no area; a light must be a polygon that is not flat as a line",
        ),
        (
            LIGHT,
            "[0, 1, 1]]",
            "[0, 1, 1], [0, 0.5, 2]]",
            "s: light 1: points are not in one plane; a light must be flat to 0.0001 of its size",
        ),
        (
            LIGHT,
            "[1, 0, 1], ",
            "[1, 2, 1], [1.5, 0, 1], ",
            "s: light 1: sides 1 and 3 cross; the outline of a light must not cross itself",
        ),
        (
            LIGHT,
            "radiance = 1",
            "radiance = -1",
            "s: light 1: radiance is [-1.0, -1.0, -1.0]; a radiance must be from 0 to 1e9",
        ),
        (
            CAMERA,
            "target = [0, 0, 1]",
            "target = [0, -5, 1]",
            "s: camera: target is the position itself; it must be another point, to look at",
        ),
        (
            CAMERA,
            "target = [0, 0, 1]",
            "target = [0, -5, 2]",
            "s: camera: up runs along the line of sight; it must point to the side of it",
        ),
        (
            CAMERA,
            "field_of_view = 40",
            "field_of_view = 180",
            "s: camera: field_of_view is 180; it must be a number from 0.001 to 179",
        ),
        (
            PLANE,
            "[0, 0, 2]",
            "[0, 0, 0]",
            "s: plane 1: normal is [0.0, 0.0, 0.0]; a direction must not be zero",
        ),
        (
            PLANE,
            "along = [1, 0, 0]",
            "along = [0, 0, 1]",
            "s: plane 1: along runs along the normal; it must point along the plane",
        ),
        (
            PLANE,
            "extent = [3, 4]",
            "extent = [3, -4]",
            "s: plane 1: extent's second number is -4; it must be a length from 1e-6 to 1e6",
        ),
    ];
    for (part, good, bad, sentence) in cases {
        assert!(part.contains(good), "the case replaces {good}, which is not in it");
        let changed = part.replace(good, bad);
        let text = if *part == CAMERA { changed } else { format!("{CAMERA}{changed}") };
        match Scene::parse(&text, "s") {
            Ok(_) => panic!("{bad} was taken, where this was due: {sentence}"),
            Err(error) => assert_eq!(error.to_string(), *sentence),
        }
    }
    let missing = Scene::load(Path::new("no/such/scene.toml")).unwrap_err().to_string();
    assert!(missing.starts_with("no/such/scene.toml: the scene file could not be read ("), "{missing}");
}

const PLANE: &str = "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 2]\nalong = [1, 0, 0]\nextent = [3, 4]\nmaterial = { roughness = 0.5 }\n";

/// A fifth above the 2.35 % and 5.04 % that were measured with the table of this version; they are the distance of
/// one lobe from the BRDF, as the next test shows.
#[test]
fn pictures_are_near_ground_truth() {
    let device = Device::open_any().unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default();
    for (name, bound) in [("gallery.toml", GALLERY_BOUND), ("hard.toml", HARD_BOUND)] {
        let scene = shipped(name);
        let image =
            device.render(&table, &scene, [64, 36], 1, &|_| ()).unwrap_or_else(|error| panic!("{error}"));
        assert!(image.pixels.iter().flatten().all(|value| value.is_finite() && *value >= 0.0), "{name}");
        let truth = render_truth(&scene, 64, 36, 1, &|_| ());
        let comparison = Comparison::new(&image, &truth);
        println!("{name}: {comparison:?}");
        assert!(comparison.pixels > 1000, "{name}: {comparison:?}");
        assert!(comparison.mean_error < bound, "{name}: {comparison:?}, bound {bound}");
    }
}

const GALLERY_BOUND: f64 = 0.028;
const HARD_BOUND: f64 = 0.06;

/// The scene's pixel in f64 by the twin, or nothing where the ray passes close to an outline: a neighbour within a
/// thousandth of a pixel meets something else, and rounding decides which.
fn exact(scene: &Scene, table: &Table, column: u32, row: u32, [width, height]: [u32; 2]) -> Option<DVec3> {
    let ray = |x: f64, y: f64| {
        let direction =
            scene.camera.direction(f64::from(column) + 0.5 + x, f64::from(row) + 0.5 + y, width, height);
        (direction, scene.trace(scene.camera.position, direction))
    };
    let (direction, hit) = ray(0.0, 0.0);
    let Hit::Surface { object, position, normal } = hit else {
        return None;
    };
    for (x, y) in [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (0.0, -1e-3)] {
        match ray(x, y).1 {
            Hit::Surface { object: beside, normal: turned, .. }
                if beside == object && normal.dot(turned) > 0.999 => {}
            _ => return None,
        }
    }
    let material = &scene.objects[object].material;
    let surface = ltc_surface::<f64>(position, normal, -direction, material.roughness.at(position));
    let lobe = table.lobe(&surface);
    let mut sum = DVec3::ZERO;
    for light in &scene.lights {
        let value = light_value(&surface, &lobe, &light.shape);
        sum += light.radiance
            * (material.base_colour * value.x + material.f0 * (value.y - value.z) + material.f90 * value.z);
    }
    Some(sum)
}

/// Away from outlines, every pixel is what the twin says in f64: no seam, speck or hole is left to arithmetic.
#[test]
fn pictures_have_no_seams_or_specks() {
    let device = Device::open_any().unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default();
    for name in ["gallery.toml", "hard.toml"] {
        let scene = shipped(name);
        let size @ [width, height] = [384, 216];
        let image = device.render(&table, &scene, size, 1, &|_| ()).unwrap_or_else(|error| panic!("{error}"));
        let mut worst = (0.0, 0, 0);
        let (mut sum, mut total, mut count) = (0.0, 0.0, 0);
        for (column, row) in (0..height).flat_map(|row| (0..width).map(move |column| (column, row))) {
            let Some(expected) = exact(&scene, &table, column, row, size) else { continue };
            let pixel = DVec3::from(image.pixels[(row * width + column) as usize].map(f64::from));
            let error = (pixel - expected).abs().max_element() / (expected.max_element() + 0.01);
            if error > worst.0 {
                worst = (error, column, row);
            }
            sum += error;
            total += expected.max_element();
            count += 1;
        }
        println!(
            "{name}: worst {worst:?}, mean {}, {count} pixels, mean radiance {}",
            sum / f64::from(count),
            total / f64::from(count)
        );
        assert!(worst.0 < SEAM_BOUND, "{name}: {worst:?}");
    }
}

/// Twice the largest error of a channel over the pixel's brightest channel that was measured, 1.6e-3 at the rim of a
/// mirror-like sphere that touches a light (gallery: 2.8e-4; mean 1.7e-6 and 7e-7).
const SEAM_BOUND: f64 = 3e-3;

/// The bands that a large picture is drawn in leave no seam: what is drawn at once and in bands is one picture.
#[test]
fn bands_do_not_show() {
    let device = Device::open_any().unwrap_or_else(|error| panic!("{error}"));
    let mut scene = shipped("gallery.toml");
    scene.lights.truncate(1);
    let bands = std::cell::Cell::new(0);
    let count = |_| bands.set(bands.get() + 1);
    let table = Table::default();
    let few = device.render(&table, &scene, [96, 54], 1, &count).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(bands.replace(0), 1);
    // The first sample is the centre however many there are, and equal pictures average to themselves.
    scene.objects.clear();
    scene.lights.clear();
    let many =
        device.render(&table, &scene, [96, 54], 1024, &count).unwrap_or_else(|error| panic!("{error}"));
    assert!(bands.get() > 1);
    assert_eq!(few.pixels.len(), many.pixels.len());
    let background = scene.background.as_vec3();
    assert!(
        many.pixels.iter().all(|pixel| (glam::Vec3::from(*pixel) - background).abs().max_element() < 1e-6)
    );
}

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
