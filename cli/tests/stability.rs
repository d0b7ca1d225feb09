//! `softbox stability`, as a user calls it.

use std::path::Path;
use std::process::{Command, Output};

fn softbox(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_softbox")).args(arguments).output().expect("the program starts")
}

/// Standard output of a run that must succeed.
fn said(arguments: &[&str]) -> String {
    let output = softbox(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// Asserts that the run fails with one line that says all of `says`.
fn fails(arguments: &[&str], says: &[&str]) {
    let output = softbox(arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    for part in says {
        assert!(said.contains(part), "{arguments:?}: {said}");
    }
}

#[test]
fn a_table_of_every_family_on_every_stack() {
    for level in ["fast", "standard", "fine", "finest"] {
        let text = said(&["stability", "--cases", "1", "--quality", level]);
        let head = text.lines().next().expect("a head");
        assert!(head.contains("CPU") && head.split_whitespace().count() > 8, "{head}");
        for family in softbox::stability::CATALOGUE {
            assert!(text.contains(family.name), "{level}: {} is not there:\n{text}", family.name);
        }
        assert!(text.contains(&format!("cases of {level} beyond their bounds, 0 not finite")), "{text}");
    }
}

#[test]
fn rows_as_json() {
    let text = said(&["stability", "--cases", "1", "--cpu-only", "--json"]);
    let rows: Vec<serde_json::Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}")))
        .collect();
    assert_eq!(rows.len(), softbox::stability::CATALOGUE.len());
    for row in rows {
        assert_eq!((row["driver"].as_str(), row["level"].as_str()), (Some("CPU"), Some("standard")));
        assert!(row["inputs"].as_u64().is_some_and(|inputs| inputs > 0) && row["beyond"] == 0, "{row}");
    }
}

#[test]
fn what_uses_too_much_of_a_bound_fails() {
    let arguments = ["stability", "--cases", "1", "--cpu-only", "--limit", "0.001"];
    fails(&arguments, &["at standard on CPU", "the family", "more than 0.001"]);
}

#[test]
fn a_folder_of_all() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let out_name = out.to_str().expect("a name");
    // Twice: the second takes the place of the first.
    for adapters in [&["--cpu-only"][..], &[]] {
        let text = said(&[&["stability", "--cases", "1", "--out", out_name], adapters].concat());
        assert!(text.contains("stability.md"), "{text}");
        assert_eq!(out.join("scene-contact.png").exists(), adapters.is_empty());
    }
    let read = |name: &str| std::fs::read(out.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    let page = String::from_utf8(read("stability.md")).expect("text");
    let shown: Vec<&str> = page.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert_eq!(shown.len(), 1 + softbox::stability::approach::approaches().len() + 2, "{shown:?}");
    for name in shown {
        assert!(!read(name).is_empty(), "{name}");
    }
    let rows = |name: &str| String::from_utf8(read(name)).expect("text").lines().count();
    assert_eq!(rows("curves.csv"), rows("curves.jsonl") + 1);
    let stacks = rows("stacks.jsonl");
    assert!(stacks >= 8 && stacks % 4 == 0, "the CPU and a device, four levels each, not {stacks}");
    assert_eq!(rows("families.jsonl"), stacks * softbox::stability::CATALOGUE.len());
    assert!(read("scene-contact.png").starts_with(b"\x89PNG") && page.contains("Softbox, standard"));
}

#[test]
fn what_cannot_be_is_refused_before_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("mine"), "mine").expect("a file");
    let own = folder.path().to_str().expect("a name");
    fails(&["stability", "--out", own], &["mine", "name another folder"]);
    assert!(Path::new(own).join("mine").exists());
    let out = folder.path().join("out");
    let out = out.to_str().expect("a name");
    fails(&["stability", "--quality", "best"], &["best", "fast, standard, fine, finest"]);
    fails(&["stability", "--cases", "0"], &["--cases", "from 1 to 1000"]);
    fails(&["stability", "--cases", "-1"], &["--cases is -1", "from 1 to 1000"]);
    fails(&["stability", "--docs", "/no/such/folder"], &["no folder /no/such/folder"]);
    fails(&["stability", "--limit", "2"], &["--limit", "at most 1"]);
    fails(&["stability", "--adapter", "no such adapter"], &["no such adapter", "there are"]);
    fails(&["stability", "--cpu-only", "--adapter", "x"], &["cannot be used with"]);
    fails(&["stability", "--out", out, "--scene", "/none.toml"], &["/none.toml"]);
    let lights = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/lights.toml");
    fails(&["stability", "--cases", "1", "--out", out, "--scene", lights], &["light ", "for polygons"]);
    let docs = folder.path().join("docs");
    std::fs::create_dir(&docs).expect("a folder");
    std::fs::write(docs.join("stacks.jsonl"), "{}\n").expect("a file");
    fails(
        &["stability", "--docs", docs.to_str().expect("a name")],
        &["stacks.jsonl", "line 1", "tests/stacks/run"],
    );
    assert!(!Path::new(out).exists() && !docs.join("stability.md").exists());
}
