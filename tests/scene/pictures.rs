//! Pictures are finite, near ground truth, and the same whatever else is compiled.

use glam::DVec3;
use softbox::device::{Device, RenderError};
use softbox::effects::{Effect, Effects};
use softbox::scene::{Comparison, Scene, render_truth};
use softbox::table::Table;
use softbox::texture::prefilter;

use crate::shipped;
use crate::twin::exact;

/// A fifth above the 2.35 %, 5.04 % and 4.17 % that were measured with the table of this version; they are the distance
/// of lobes from their BRDFs, as the next test shows.
#[test]
fn pictures_are_near_ground_truth() {
    let device = Device::open_any().unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default();
    for (name, bound, size) in [
        ("gallery.toml", GALLERY_BOUND, [64, 36]),
        ("hard.toml", HARD_BOUND, [64, 36]),
        ("lights.toml", LIGHTS_BOUND, [48, 27]),
    ] {
        let scene = shipped(name);
        let [width, height] = size;
        let image = device.render(&table, &scene, size, 1, &|_| ()).unwrap_or_else(|error| panic!("{error}"));
        assert!(image.pixels.iter().flatten().all(|value| value.is_finite() && *value >= 0.0), "{name}");
        let truth = render_truth(&scene, width, height, 1, &|_| ());
        let comparison = Comparison::new(&image, &truth);
        println!("{name}: {comparison:?}");
        assert!(comparison.pixels as u32 > width * height * 2 / 5, "{name}: {comparison:?}");
        assert!(comparison.mean_error < bound, "{name}: {comparison:?}, bound {bound}");
    }
}

const GALLERY_BOUND: f64 = 0.028;
const HARD_BOUND: f64 = 0.06;
const LIGHTS_BOUND: f64 = 0.05;

/// Away from outlines, every pixel is what the twin says in f64: no seam, speck or hole is left to arithmetic.
#[test]
fn pictures_have_no_seams_or_specks() {
    let device = Device::open_any().unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default().completed(&Effects::all().layers());
    for name in ["gallery.toml", "hard.toml", "lights.toml"] {
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

/// Everything that leaves the picture of `scene` as it is.
fn everything(scene: &Scene) -> Effects {
    let all = Effects::standing();
    if scene.energy_compensation { all } else { all.without(Effect::EnergyCompensation) }
}

/// What a scene does not call for changes nothing where it is compiled all the same.
#[test]
fn a_scene_needs_no_more_than_its_effects() {
    let device = Device::open_any().unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default();
    let whole = shipped("lights.toml");
    let mut scenes: Vec<(String, Scene)> =
        ["gallery.toml", "hard.toml"].map(|name| (name.to_owned(), shipped(name))).into();
    for index in 0..whole.lights.len() {
        let mut one = whole.clone();
        one.lights = vec![whole.lights[index].clone()];
        // Each of the spheres' materials once.
        one.objects = vec![whole.objects[0], whole.objects[2 + index % (whole.objects.len() - 2)]];
        scenes.push((format!("light {} of lights.toml", index + 1), one));
    }
    scenes.push(("lights.toml".to_owned(), whole));
    for (name, scene) in scenes {
        let draw = |effects: Effects| {
            device
                .render_with(&table, &scene, effects, [64, 36], 1, &|_| ())
                .unwrap_or_else(|error| panic!("{name}, {effects}: {error}"))
        };
        let (least, most) = (draw(scene.effects()), draw(everything(&scene)));
        let mut worst = (0.0, 0);
        for (index, (one, other)) in least.pixels.iter().zip(&most.pixels).enumerate() {
            let [one, other] = [*one, *other].map(glam::Vec3::from);
            let error = (one - other).abs().max_element() / (1e-3 + one.max_element());
            if error > worst.0 {
                worst = (error, index);
            }
        }
        println!("{name}: {}: {worst:?}", scene.effects());
        // Lambert's law among rough diffuse surfaces is a lobe of its own where a light shows a picture.
        let bound = if scene.effects().contains(Effect::Textured) { 1e-5 } else { 1e-6 };
        assert!(worst.0 < bound, "{name}, {}: {worst:?}, bound {bound}", scene.effects());
    }
}

/// A module without an effect that the scene calls for is refused before anything is drawn.
#[test]
fn a_scene_is_not_drawn_without_its_effects() {
    let device = Device::open_any().unwrap_or_else(|error| panic!("{error}"));
    let scene = shipped("gallery.toml");
    let less = scene.effects().without(Effect::Polygon);
    match device.render_with(&Table::default(), &scene, less, [8, 8], 1, &|_| ()) {
        Err(RenderError::Effects(error)) => assert_eq!(error, scene.check_effects(less).unwrap_err()),
        other => panic!("{other:?}"),
    }
}

/// In light of the same radiance from everywhere a white surface cannot be seen, whatever its layers: nothing is lost
/// between them.
#[test]
fn white_surfaces_vanish_in_light_from_everywhere() {
    let device = Device::open_any().unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default();
    for material in [
        "roughness = 0.7, f0 = 1",
        "roughness = 0.3, f0 = 1, coat = 1, coat_roughness = 0.4",
        "roughness = 0.5, f0 = 1, anisotropy = 0.8, grain = [0, 0, 1]",
        "roughness = 0.5, f0 = 0, f90 = 0, base_colour = 1",
        "roughness = 0.5, f0 = 0, f90 = 0, base_colour = 1, diffuse_roughness = 0.8",
        "roughness = 0.5, f0 = 0, f90 = 0, base_colour = 1, sheen_colour = 1, sheen_roughness = 0.6",
        "roughness = 0.5, f0 = 0, f90 = 0, base_colour = 1, sheen_colour = 0.5, coat = 0.5",
    ] {
        let sphere = crate::SPHERE.replace("roughness = 0.5", material);
        let light = "[[light]]\nshape = 'sphere'\ncenter = [0, 0, 0]\nradius = 100\nradiance = 1\n";
        let text = format!("energy_compensation = true\nbackground = 0.5\n{}{sphere}{light}", crate::CAMERA);
        let scene = Scene::parse(&text, "scene").unwrap_or_else(|error| panic!("{error}: {text}"));
        let truth = render_truth(&scene, 16, 9, 1, &|_| ()).image;
        let image = device
            .render(&table, &scene, [16, 9], 1, &|_| ())
            .unwrap_or_else(|error| panic!("{material}: {error}"));
        for picture in [truth, image] {
            // The four pixels in the middle show the sphere, the corners what is behind it.
            let at = |column: usize, row: usize| picture.pixels[16 * row + column];
            assert_eq!(at(0, 0), [0.5; 3]);
            for (column, row) in [(6, 4), (9, 4), (7, 3), (8, 5)] {
                let pixel = at(column, row);
                let error = pixel.iter().map(|value| (value - 1.0).abs()).fold(0.0, f32::max);
                assert!(error < 1e-5, "{material}: {pixel:?}");
            }
        }
    }
}

/// A white picture is no picture, in truth to what its texels' integrals are good for.
#[test]
fn a_white_picture_changes_nothing() {
    let device = Device::open_any().unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default();
    let mut plain = shipped("lights.toml");
    plain.lights.truncate(1);
    plain.lights[0].picture = None;
    let mut white = plain.clone();
    white.lights[0].picture = Some(prefilter(64, 36, &[[1.0; 4]; 64 * 36]));
    let size @ [width, height] = [32, 18];
    let draw = |scene: &Scene| {
        device.render(&table, scene, size, 1, &|_| ()).unwrap_or_else(|error| panic!("{error}"))
    };
    let trace = |scene: &Scene| render_truth(scene, width, height, 1, &|_| ()).image;
    for (name, one, other, bound) in
        [("include", draw(&plain), draw(&white), 1e-5), ("truth", trace(&plain), trace(&white), WHITE_BOUND)]
    {
        let pairs = one.pixels.iter().zip(&other.pixels).enumerate();
        let errors = pairs.map(|(index, (one, other))| {
            let [one, other] = [*one, *other].map(glam::Vec3::from);
            ((one - other).abs().max_element() / (1e-2 + one.max_element()), index)
        });
        let worst = errors.fold((0.0, 0), |worst, error| if error.0 > worst.0 { error } else { worst });
        println!("{name}: {worst:?}");
        assert!(worst.0 < bound, "{name}: {worst:?}, bound {bound}");
    }
}

/// Twice what was measured, on the glossy end of the floor, where texels are wide for the lobe.
const WHITE_BOUND: f32 = 1.4e-2;
