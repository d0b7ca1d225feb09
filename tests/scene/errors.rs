//! Every mistake in a scene file is named in one sentence.

use std::path::Path;

use softbox::scene::{Panel, Scene, write_png};

use crate::{CAMERA, LIGHT, PLANE, SPHERE};

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
        (SPHERE, "0.5", "0.5, coat = 2", "s: sphere 1: coat is 2; it must be a number from 0 to 1"),
        (
            SPHERE,
            "0.5",
            "0.5, coat_roughness = -1",
            "s: sphere 1: coat_roughness is -1; it must be a number from 0 to 1",
        ),
        (
            SPHERE,
            "0.5",
            "0.5, coat_reflectance = nan",
            "s: sphere 1: coat_reflectance is NaN; it must be a number from 0 to 1",
        ),
        (
            SPHERE,
            "0.5",
            "0.5, sheen_colour = [0, 0, 1.5]",
            "s: sphere 1: sheen_colour is [0.0, 0.0, 1.5]; a reflectance must be from 0 to 1",
        ),
        (
            SPHERE,
            "0.5",
            "0.5, sheen_roughness = 7",
            "s: sphere 1: sheen_roughness is 7; it must be a number from 0 to 1",
        ),
        (
            SPHERE,
            "0.5",
            "0.5, diffuse_roughness = 1.01",
            "s: sphere 1: diffuse_roughness is 1.01; it must be a number from 0 to 1",
        ),
        (
            SPHERE,
            "0.5",
            "0.5, anisotropy = -0.5, grain = [0, 0, 1]",
            "s: sphere 1: anisotropy is -0.5; it must be a number from 0 to 1",
        ),
        (
            SPHERE,
            "0.5",
            "0.5, anisotropy = 0.5",
            "s: sphere 1: anisotropy is 0.5, but there is no grain; give a direction along the surface, such as grain = [1, 0, 0]",
        ),
        (
            SPHERE,
            "0.5",
            "0.5, anisotropy = 0.5, grain = [0, 0, 0]",
            "s: sphere 1: grain is [0.0, 0.0, 0.0]; a direction must not be zero",
        ),
        (
            PLANE,
            "0.5",
            "0.5, anisotropy = 0.5, grain = [0, 0, 3]",
            "s: plane 1: grain runs along the normal; it must be a direction along the plane",
        ),
        (
            CAMERA,
            "camera",
            "energy_compensation = 1\ncamera",
            "s, line 1: invalid type: integer `1`, expected a boolean",
        ),
        (
            LIGHT,
            "radiance = 1",
            "radiance = 1\npicture = 'a.png'",
            "s: light 1: points holds 3 of them; a light with a picture needs four, from the picture's lower left corner on",
        ),
        (
            LIGHT,
            "[0, 1, 1]]",
            "[1, 1, 1], [0, 0.9, 1]]\npicture = 'a.png'",
            "s: light 1: points are no parallelogram, which a light with a picture must be; the fourth point would be [0.0, 1.0, 1.0]",
        ),
        (
            LIGHT,
            "points = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]",
            "shape = 'sphere'\ncenter = [0, 0, 1]\nradius = 1\npicture = 'a.png'",
            "s: light 1: a sphere has no field picture; it has center, radius",
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

#[test]
fn pictures_are_found_beside_the_scene_or_missed_by_name() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pictures");
    std::fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{error}"));
    let light = LIGHT.replace("[1, 0, 1], [0", "[1, 0, 1], [1, 1, 1], [0") + "picture = \"p.png\"\n";
    let text = |count: usize| format!("{CAMERA}{SPHERE}{}", light.repeat(count));
    let file = folder.join("s.toml");
    let load = |count: usize| {
        std::fs::write(&file, text(count)).unwrap_or_else(|error| panic!("{error}"));
        Scene::load(&file)
    };
    let picture = folder.join("p.png");
    let _ = std::fs::remove_file(&picture);
    let place = file.display().to_string();
    let missing = load(1).unwrap_err().to_string();
    assert!(
        missing.starts_with(&format!("{place}: light 1: picture \"p.png\" could not be read (")),
        "{missing}"
    );
    assert!(missing.ends_with("); name a PNG file, relative to the scene file"), "{missing}");
    std::fs::write(&picture, b"no picture").unwrap_or_else(|error| panic!("{error}"));
    let broken = load(1).unwrap_err().to_string();
    assert!(
        broken.starts_with(&format!("{place}: light 1: picture \"p.png\" could not be read (")),
        "{broken}"
    );

    // Half of sRGB's range is about a fifth of the light.
    let panel = Panel { width: 2, height: 1, pixels: vec![[0, 128, 255], [255; 3]] };
    write_png(&picture, &panel).unwrap_or_else(|error| panic!("{error}"));
    let scene = load(4).unwrap_or_else(|error| panic!("{error}"));
    let [red, green, blue, alpha] =
        scene.lights[3].picture.as_ref().expect("a picture").levels()[0].texels[0];
    assert_eq!([red, blue, alpha], [0.0, 1.0, 1.0]);
    assert!((green - 0.21586).abs() < 1e-4, "{green}");
    assert_eq!(
        load(5).unwrap_err().to_string(),
        format!(
            "{place}: light 5: the scene has more than 4 lights with a picture; leave out the others' pictures"
        )
    );
}
