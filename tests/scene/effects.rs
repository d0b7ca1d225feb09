//! What scenes call for.

use softbox::effects::{Effect, Effects};
use softbox::scene::Scene;

use crate::{CAMERA, LIGHT, SPHERE, shipped};

#[test]
fn shipped_scenes_call_for_what_they_show() {
    for (name, effects) in [
        ("gallery.toml", "quad,polygon+ggx+two-sided"),
        ("hard.toml", "quad,polygon+ggx+two-sided"),
        (
            "lights.toml",
            "quad,polygon,disk,sphere,tube,textured+ggx,clearcoat,sheen,rough-diffuse,energy-compensation,anisotropic\
             +two-sided,caps",
        ),
    ] {
        let scene = shipped(name);
        assert_eq!(scene.effects().to_string(), effects, "{name}");
        let of_entries = scene.entries().into_iter().fold(Effects::NONE, |sum, (_, effects)| sum | effects);
        assert_eq!(of_entries, scene.effects(), "{name}");
    }
}

#[test]
fn a_scene_calls_for_what_its_entries_need() {
    const DULL: &str = "roughness = 0.5, f0 = 0, f90 = 0";
    const SQUARE: &str = "points = [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]";
    const DENT: &str = "points = [[0, 0, 1], [1, 0, 1], [0.2, 0.2, 1], [0, 1, 1]]";
    const FIVE: &str = "points = [[0, 0, 1], [2, 0, 1], [3, 1, 1], [2, 2, 1], [0, 2, 1]]";
    const DISK: &str = "shape = 'disk'\ncenter = [0, 0, 1]\nhalf_x = [1, 0, 0]\nhalf_y = [0, 1, 0]";
    const TUBE: &str = "shape = 'tube'\nstart = [0, 0, 1]\nend = [1, 0, 1]\nradius = 0.1";
    const TRIANGLE: &str = "points = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]";
    let cases = [
        ("", TRIANGLE, DULL, "quad"),
        ("", TRIANGLE, "roughness = 0.5", "quad+ggx"),
        ("", TRIANGLE, "roughness = 0.5, f0 = 0", "quad+ggx"),
        ("", TRIANGLE, "roughness = 0.5, f90 = 0", "quad+ggx"),
        ("", SQUARE, DULL, "quad"),
        ("", &format!("{SQUARE}\ntwo_sided = true"), DULL, "quad+two-sided"),
        ("", &format!("{SQUARE}\ntwo_sided = false"), DULL, "quad"),
        ("", DENT, DULL, "polygon"),
        ("", FIVE, DULL, "polygon"),
        ("", DISK, DULL, "disk"),
        ("", &format!("{DISK}\ntwo_sided = true"), DULL, "disk+two-sided"),
        ("", "shape = 'sphere'\ncenter = [0, 0, 1]\nradius = 1", DULL, "sphere"),
        ("", TUBE, DULL, "tube"),
        ("", &format!("{TUBE}\ncaps = true"), DULL, "tube+caps"),
        ("", TRIANGLE, &format!("{DULL}, coat = 0.1"), "quad+ggx,clearcoat"),
        ("", TRIANGLE, &format!("{DULL}, coat = 0, coat_roughness = 1"), "quad"),
        ("", TRIANGLE, &format!("{DULL}, sheen_colour = 0.1"), "quad+sheen"),
        ("", TRIANGLE, &format!("{DULL}, diffuse_roughness = 0.1, base_colour = 0.1"), "quad+rough-diffuse"),
        ("", TRIANGLE, &format!("{DULL}, diffuse_roughness = 0.1"), "quad"),
        ("", TRIANGLE, &format!("{DULL}, anisotropy = 0.1, grain = [1, 0, 0]"), "quad"),
        ("", TRIANGLE, "roughness = 0.5, anisotropy = 0.1, grain = [1, 0, 0]", "quad+ggx,anisotropic"),
        ("energy_compensation = true\n", TRIANGLE, DULL, "quad"),
        ("energy_compensation = true\n", TRIANGLE, "roughness = 0.5, f0 = 0", "quad+ggx"),
        ("energy_compensation = true\n", TRIANGLE, "roughness = 0.5", "quad+ggx,energy-compensation"),
    ];
    for (start, light, material, effects) in cases {
        let sphere = SPHERE.replace("roughness = 0.5", material);
        let text = format!("{start}{CAMERA}{sphere}[[light]]\n{light}\nradiance = 1\n");
        let scene = Scene::parse(&text, "scene").unwrap_or_else(|error| panic!("{error}: {text}"));
        assert_eq!(scene.effects().to_string(), effects, "{text}");
    }
}

#[test]
fn a_scene_with_nothing_to_shade_calls_for_nothing() {
    let dark = LIGHT.replace("radiance = 1", "radiance = 0");
    for text in [
        CAMERA.to_owned(),
        format!("{CAMERA}{SPHERE}"),
        format!("{CAMERA}{LIGHT}"),
        format!("{CAMERA}{SPHERE}{dark}"),
    ] {
        let scene = Scene::parse(&text, "scene").unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.effects(), Effects::NONE, "{text}");
        assert_eq!(scene.check_effects(Effects::NONE), Ok(()));
    }
}

#[test]
fn what_is_missing_is_named_with_its_place() {
    let set = |text: &str| text.parse::<Effects>().unwrap_or_else(|error| panic!("{error}"));
    let gallery = shipped("gallery.toml");
    for effects in [gallery.effects(), Effects::all(), Effects::present()] {
        assert_eq!(gallery.check_effects(effects), Ok(()));
    }
    for (scene, effects, sentence) in [
        (
            "gallery.toml",
            "none",
            "plane 1: calls for the effect \"lambert\", which the set \"none\" lacks; \
             \"quad,polygon+ggx+two-sided\" would do",
        ),
        (
            "gallery.toml",
            "quad+ggx+two-sided",
            "light 2: calls for the effect \"polygon\", which the set \"quad+ggx+two-sided\" lacks; \
             \"quad,polygon+ggx+two-sided\" would do",
        ),
        (
            "gallery.toml",
            "quad,polygon+two-sided",
            "plane 1: calls for the effect \"ggx\", which the set \"quad,polygon+two-sided\" lacks; \
             \"quad,polygon+ggx+two-sided\" would do",
        ),
    ] {
        let error = shipped(scene).check_effects(set(effects)).unwrap_err();
        assert_eq!(error.to_string(), sentence);
    }
    let lights = shipped("lights.toml");
    for (effect, place) in [
        (Effect::Textured, "light 1"),
        (Effect::Tube, "light 2"),
        (Effect::Caps, "light 2"),
        (Effect::Disk, "light 4"),
        (Effect::Sphere, "light 5"),
        (Effect::Polygon, "light 6"),
        (Effect::TwoSided, "light 1"),
        (Effect::Ggx, "plane 1"),
        (Effect::ClearCoat, "sphere 2"),
        (Effect::Anisotropic, "sphere 3"),
        (Effect::Sheen, "sphere 4"),
        (Effect::RoughDiffuse, "sphere 5"),
        (Effect::EnergyCompensation, "energy_compensation"),
    ] {
        let error = lights.check_effects(lights.effects().without(effect)).unwrap_err().to_string();
        let start = format!("{place}: calls for the effect \"{}\"", effect.name());
        assert!(error.starts_with(&start), "{error}; not {start}");
    }
}

/// Metals keep with a lobe less what a level promises of dielectrics.
#[test]
fn a_scene_of_metals_needs_fewer_lobes() {
    use softbox::effects::{Effect, Quality};

    let scene = |f0: &str| {
        let ball = format!(
            "[[sphere]]\ncentre = [0.0, 0.0, 0.0]\nradius = 0.5\nmaterial = {{ roughness = 0.4, f0 = {f0} }}\n"
        );
        Scene::parse(&format!("{CAMERA}{ball}{LIGHT}"), "metals").unwrap_or_else(|error| panic!("{error}"))
    };
    let lobes = |f0: &str, level: Quality| {
        let effects = scene(f0).effects_at(level);
        1 + usize::from(effects.contains(Effect::SecondLobe))
            + usize::from(effects.contains(Effect::ThirdLobe))
    };
    let levels = [Quality::Standard, Quality::Fine, Quality::Finest];
    assert_eq!(levels.map(|level| lobes("0.04", level)), [1, 2, 3]);
    assert_eq!(levels.map(|level| lobes("[0.95, 0.93, 0.9]", level)), [1, 1, 2]);
    assert!(scene("0.9").effects_at(Quality::Fast).contains(Effect::TableFree));
}
