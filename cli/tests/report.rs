//! `softbox report` and quality levels, as a user calls them.

use std::process::{Command, Output};

fn softbox(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_softbox")).args(arguments).output().expect("the program starts")
}

/// Asserts one sentence of failure that says all of `says`.
fn fails(arguments: &[&str], says: &[&str]) {
    let output = softbox(arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    for part in says {
        assert!(said.contains(part), "{arguments:?}: {said}");
    }
}

#[test]
fn a_quick_report_holds_every_level() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("report");
    let out = out.to_str().expect("a name");
    let output = softbox(&["report", "--quick", "--out", out]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let page = std::fs::read_to_string(format!("{out}/index.html")).expect("a page");
    let markdown = std::fs::read_to_string(format!("{out}/report.md")).expect("a text");
    for name in ["Fast", "Standard", "Fine", "Finest", "LTC as published"] {
        assert!(page.contains(name) && markdown.contains(name), "{name}");
    }
    let text = std::fs::read_to_string(format!("{out}/report.json")).expect("the figures");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert!(report["errors"].as_array().is_some_and(|rows| rows.len() > 500), "errors");
    assert!(report["costs"].as_array().is_some_and(|rows| rows.len() > 100), "costs");
}

#[test]
fn what_cannot_be_is_refused_before_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("mine"), "mine").expect("a file");
    let own = folder.path().to_str().expect("a name");
    fails(&["report", "--out", own], &["mine", "name another folder"]);
    let out = folder.path().join("report");
    let out = out.to_str().expect("a name");
    fails(&["report", "--out", out, "--compare-table", "/none"], &["/none", "name a file"]);
    fails(&["report", "--out", out, "--measured", "/none"], &["/none"]);
    fails(&["eval", "--quality", "best"], &["best", "fast, standard, fine, finest"]);
    fails(&["build", "--quality", "fast", "--model", "beckmann", "--out", out], &["closed form", "GGX"]);
    assert!(!std::path::Path::new(out).exists());
}

#[test]
fn a_level_is_a_set_of_effects() {
    let set = |level: &str| {
        let output = softbox(&["select", "quad+ggx", "--quality", level]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("text")
    };
    assert!(set("fast").contains("fn ltc_lobe_fitted(") && !set("standard").contains("fn ltc_lobe_fitted("));
    assert!(set("fine").contains("fn ltc_two_lobes(") && !set("fine").contains("fn ltc_three_lobes("));
    assert!(set("finest").contains("override ltc_use_third_lobe: bool = true;"));
}
