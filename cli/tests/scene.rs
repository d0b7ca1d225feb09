//! What scenes call for, on the command line.

use std::process::{Command, Output};

fn softbox(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_softbox")).args(arguments).output().expect("the program starts")
}

const LIGHTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/lights.toml");
const GALLERY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/gallery.toml");

fn printed(arguments: &[&str]) -> String {
    let output = softbox(arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[test]
fn a_scene_s_effects_are_a_set_to_select() {
    let set = printed(&["effects", LIGHTS]);
    assert!(set.starts_with("quad,polygon,disk,sphere,tube,textured+ggx,clearcoat,"), "{set}");
    let text = printed(&["select", set.trim()]);
    assert!(text.contains("fn ltc_reflected_picture("), "{text}");
    assert_eq!(printed(&["effects", GALLERY]), "quad,polygon+ggx+two-sided\n");
}

#[test]
fn each_entry_is_listed_with_its_effects() {
    let list = printed(&["effects", LIGHTS, "--list"]);
    for (place, effects) in [
        ("plane 1", "ggx"),
        ("sphere 4", "sheen"),
        ("light 1", "quad,textured+two-sided"),
        ("light 2", "tube+caps"),
        ("energy_compensation", "ggx,energy-compensation"),
    ] {
        let line = list.lines().find(|line| line.starts_with(&format!("{place} "))).expect(place);
        assert_eq!(line.split_whitespace().last(), Some(effects), "{line}");
    }
}

#[test]
fn a_picture_is_drawn_with_enough_or_not_at_all() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("gallery.png");
    let out = path.to_str().expect("UTF-8");
    let draw = |set: &str| {
        let size = ["--width", "32", "--samples", "1"];
        softbox(&[&["render", GALLERY, "--out", out, "--effects", set], &size[..]].concat())
    };
    for (set, words) in [
        ("quad+ggx+two-sided", "gallery.toml: light 2: calls for the effect \"polygon\", which the set"),
        ("quad+ggx,caps", "means nothing without tube"),
        ("quda+ggx", "the nearest is \"quad\""),
    ] {
        let output = draw(set);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(said.contains(words), "{said}");
        assert!(!path.exists(), "{set}");
    }
    let output = draw("quad,polygon,disk+ggx,sheen+two-sided");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(path.exists());
}
