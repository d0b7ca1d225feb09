//! The command line from outside.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn softbox(arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_softbox"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // A program that has stopped reading has closed the pipe.
    let _ = child.stdin.take().expect("a pipe").write_all(input.as_bytes());
    child.wait_with_output().expect("the program ends")
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).expect("the program writes UTF-8")
}

fn lines(output: &Output) -> Vec<serde_json::Value> {
    text(&output.stdout).lines().map(|line| serde_json::from_str(line).expect("a line of JSON")).collect()
}

/// Asserts exit code 2 and one sentence with the given words.
fn assert_refused(output: &Output, words: &[&str]) {
    let error: Vec<&str> = text(&output.stderr).lines().collect();
    assert_eq!(output.status.code(), Some(2), "{error:?}");
    assert_eq!(error.len(), 1, "one sentence: {error:?}");
    for word in words {
        assert!(error[0].contains(word), "{word:?} is not in {:?}", error[0]);
    }
}

const GOOD: &str = r#"{"surface":{"position":[0,0,0],"normal":[0,0,2],"view":[0.6,0,0.8],"roughness":0.5,"name":"x"},"light":{"shape":"polygon","points":[[-1,-1,1],[-1,1,1],[1,1,1],[1,-1,1]]},"truth":{}}"#;

/// The form factor of a square of side 2 over a point at distance 1 (Howell's catalogue, B-3, times 4).
fn form_factor() -> f64 {
    4.0 / core::f64::consts::PI * 0.5_f64.sqrt() * 0.5_f64.sqrt().atan()
}

#[test]
fn eval_gives_the_form_factor_on_every_evaluator() {
    let mut specular = Vec::new();
    for (on, tolerance) in [("cpu", 2e-7), ("cpu-f64", 1e-12), ("gpu", 2e-7), ("truth", 1e-7)] {
        let output = softbox(&["eval", "--on", on], GOOD);
        assert!(output.status.success(), "{on}: {}", text(&output.stderr));
        let values = lines(&output);
        assert_eq!(values.len(), 1);
        let diffuse = values[0]["diffuse"].as_f64().expect("a number");
        assert!((diffuse - form_factor()).abs() < tolerance, "{on}: {diffuse}");
        specular.push(values[0]["specular"].as_f64().expect("a number"));
        assert!(values[0]["fresnel"].as_f64().expect("a number") > 0.0);
    }
    assert!(
        (specular[0] - specular[1]).abs() < 1e-5 && (specular[0] - specular[2]).abs() < 1e-5,
        "{specular:?}"
    );
    assert!((specular[0] / specular[3] - 1.0).abs() < 0.05, "{specular:?}");
}

#[test]
fn eval_reads_files_blank_lines_and_many_cases() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("cases.jsonl");
    std::fs::write(&path, format!("{GOOD}\n\n").repeat(5000)).expect("a file");
    let output = softbox(&["eval", path.to_str().expect("a path")], "");
    assert!(output.status.success());
    assert_eq!(lines(&output).len(), 5000);
    assert!(softbox(&["eval"], "").stdout.is_empty());
}

#[test]
fn eval_keeps_what_came_before_a_bad_line_and_says_what_is_wrong() {
    let with = |from: &str, to: &str| {
        assert!(GOOD.contains(from));
        GOOD.replace(from, to)
    };
    let bad = [
        ("{".to_owned(), "not JSON"),
        ("[]".to_owned(), "must be an object"),
        (
            with(
                r#"{"position":[0,0,0],"normal":[0,0,2],"view":[0.6,0,0.8],"roughness":0.5,"name":"x"}"#,
                "[1]",
            ),
            "surface must be",
        ),
        (with(r#""roughness":0.5,"#, ""), "missing field `roughness`"),
        (with(r#""view":[0.6,0,0.8],"#, ""), "missing field `view`"),
        (with("[0,0,2]", "[0,0,0]"), "normal is zero"),
        (with("[0.6,0,0.8]", "[0,0,0]"), "view is zero"),
        (with("[0.6,0,0.8]", "[0,0]"), "not a case"),
        (with("0.5", "1.25"), "roughness is 1.25"),
        (with("0.5", "-0.1"), "roughness is -0.1"),
        (with("[[-1,-1,1],[-1,1,1],", "["), "points holds 2 of them"),
        (with("[-1,1,1]", "[-1,1e999,1]"), "not finite"),
        (with("[-1,1,1]", "[-1,1e39,1]"), "point 2 is not finite in single precision"),
        (with("[-1,1,1]", "[-1,NaN,1]"), "not finite"),
        (with(r#""shape":"polygon""#, r#""shape":"pyramid""#), "pyramid"),
        (with(r#""shape":"polygon","#, ""), "no field `shape`"),
        (with(r#""points""#, r#""vertices""#), "missing field `points`"),
    ];
    for (line, words) in bad {
        let output = softbox(&["eval"], &format!("{GOOD}\n{line}\n{GOOD}\n"));
        assert_refused(&output, &["line 2", words]);
        assert_eq!(lines(&output).len(), 1, "{line}");
    }
    assert_refused(&softbox(&["eval", "no/such/file"], ""), &["no/such/file"]);
}

#[test]
fn degenerate_geometry_has_an_answer() {
    for points in [
        "[[0,0,0],[0,0,0],[0,0,0]]",
        "[[0,0,1],[0,0,1],[0,0,1],[0,0,1]]",
        "[[0,0,1],[1,0,1],[2,0,1],[3,0,1]]",
        "[[0,0,0],[1,0,0],[1,1,0],[0,1,0]]",
        "[[-1,-1,-1],[-1,1,-1],[1,1,-1]]",
    ] {
        let line = GOOD.replace("[[-1,-1,1],[-1,1,1],[1,1,1],[1,-1,1]]", points);
        for on in ["cpu", "cpu-f64", "truth", "gpu"] {
            let output = softbox(&["eval", "--on", on], &line);
            assert!(output.status.success(), "{points}: {}", text(&output.stderr));
            for (name, value) in lines(&output)[0].as_object().expect("an object") {
                let value = value.as_f64().expect("a number");
                assert!((0.0..=1.0).contains(&value), "{name} of {points} on {on} is {value}");
            }
        }
    }
}

#[test]
fn build_writes_a_package_and_replaces_it_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("deep").join("package");
    let path = out.to_str().expect("a path");
    let output = softbox(&["build", "--table-size", "8", "--out", path], "");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let summary = text(&output.stdout);
    for word in ["glsl/450/ltc.glsl", "table/ltc.ktx2", "bytes", "the include", "Took"] {
        assert!(summary.contains(word), "{word} is not in {summary}");
    }
    assert_eq!(std::fs::read(out.join("table/ltc.bin")).expect("the table").len(), 16 * 8 * 8);
    assert_eq!(
        std::fs::read_to_string(out.join("wgsl/ltc.wgsl")).expect("the include"),
        softbox::WGSL_INCLUDE
    );
    for file in ["hlsl/Ltc.ush", "msl/ltc.metal", "spirv/ltc_evaluate.spv", "README.md", "LICENSE-MIT"] {
        assert!(out.join(file).is_file(), "{file} is missing");
    }
    // A package replaces an older one, whatever that held; but nothing that a user put into it.
    assert!(softbox(&["build", "--table-size", "4", "--out", path], "").status.success());
    assert_eq!(std::fs::read(out.join("table/ltc.bin")).expect("the table").len(), 16 * 4 * 4);
    assert_eq!(entries(out.parent().expect("a parent")), ["package"], "nothing is left beside the package");
    std::fs::write(out.join("glsl/mine.glsl"), "kept").expect("a file");
    assert_refused(&softbox(&["build", "--table-size", "8", "--out", path], ""), &["glsl/mine.glsl"]);
    assert!(out.join("glsl/mine.glsl").is_file());
    assert_eq!(std::fs::read(out.join("table/ltc.bin")).expect("the table").len(), 16 * 4 * 4);
    assert_eq!(entries(out.parent().expect("a parent")), ["package"]);
}

#[test]
fn build_takes_no_repository_for_a_package() {
    let folder = tempfile::tempdir().expect("a folder");
    for file in ["wgsl/ltc.wgsl", ".git/config"] {
        let path = folder.path().join(file);
        std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        std::fs::write(path, "kept").expect("a file");
    }
    let path = folder.path().to_str().expect("a path");
    assert_refused(&softbox(&["build", "--table-size", "4", "--out", path], ""), &["no part of a package"]);
    assert!(folder.path().join(".git/config").is_file() && folder.path().join("wgsl/ltc.wgsl").is_file());
}

fn entries(folder: &Path) -> Vec<String> {
    std::fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect()
}

#[test]
fn build_touches_no_folder_that_holds_something_else() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("precious"), "kept").expect("a file");
    let path = folder.path().to_str().expect("a path");
    let output = softbox(&["build", "--table-size", "4", "--out", path], "");
    assert_refused(&output, &[path, "precious"]);
    assert_eq!(entries(folder.path()), ["precious"]);
    let under_a_file = folder.path().join("precious/package");
    let output =
        softbox(&["build", "--table-size", "4", "--out", under_a_file.to_str().expect("a path")], "");
    assert_refused(&output, &["precious"]);
}

#[test]
fn bake_writes_every_format_and_refuses_the_rest() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_str().expect("a path").to_owned();
    for name in ["t.bin", "t.dds", "t.ktx2", "t.rs", "t.h"] {
        let output = softbox(&["bake", "--size", "4", "--out", &at(name)], "");
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(Path::new(&at(name)).is_file());
    }
    for model in ["ggx", "ggx-schlick", "beckmann", "lambert"] {
        let output = softbox(
            &["bake", "--size", "4", "--model", model, "--out", &at(model), "--layout", "compatible"],
            "",
        );
        assert_refused(&output, &["extension"]);
        let name = at(&format!("{model}.bin"));
        assert!(
            softbox(&["bake", "--size", "4", "--model", model, "--out", &name], "").status.success(),
            "{model}"
        );
    }
    assert_refused(&softbox(&["build", "--update", &at("")], ""), &["wgsl/ltc.wgsl"]);
    assert_refused(
        &softbox(&["bake", "--size", "8", "--out", &at("none/s.bin")], ""),
        &["there is no folder"],
    );
    assert_refused(&softbox(&["eval", "--on", "truth", "--quality", "fast"], ""), &["--quality", "truth"]);
    assert_refused(&softbox(&["bake", "--sise", "8"], ""), &["--sise", "--size"]);
    assert_refused(
        &softbox(&["bake", "--size", "1", "--out", &at("s.bin")], ""),
        &["--size is 1", "from 2 to 1024"],
    );
    assert_refused(
        &softbox(&["bake", "--size", "4", "--model", "ggx-schlick", "--k", "7", "--out", &at("s.bin")], ""),
        &["--k is 7"],
    );
    assert_refused(
        &softbox(&["bake", "--size", "4", "--k", "0.5", "--out", &at("s.bin")], ""),
        &["ggx-schlick"],
    );
    assert_refused(&softbox(&["bake", "--size", "4", "--out", &at("none/s.bin")], ""), &["none/s.bin"]);
    assert!(!entries(folder.path()).iter().any(|name| name.contains("tmp")));
}

#[test]
fn render_refuses_bad_input_and_writes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, "surprise = 1").expect("a file");
    let image = folder.path().join("image.png");
    let output =
        softbox(&["render", scene.to_str().expect("a path"), "--out", image.to_str().expect("a path")], "");
    assert_refused(&output, &["scene.toml", "surprise"]);
    assert_refused(
        &softbox(&["render", "no.toml", "--out", image.to_str().expect("a path")], ""),
        &["no.toml"],
    );
    assert_eq!(entries(folder.path()), ["scene.toml"]);
}

#[test]
fn help_describes_the_input() {
    let help = softbox(&["eval", "--help"], "");
    for word in ["\"shape\":\"polygon\"", "counter-clockwise", "two_sided", "--on"] {
        assert!(text(&help.stdout).contains(word), "{word} is not in the help");
    }
    for command in ["build", "bake", "render"] {
        assert!(softbox(&[command, "--help"], "").status.success());
    }
}

#[test]
fn pictures_are_prefiltered_and_shine() {
    let folder = tempfile::tempdir().expect("a folder");
    let sunset = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/sunset.png");
    let out = folder.path().join("sunset.ktx2");
    let path = out.to_str().expect("a path");
    let output = softbox(&["prefilter", sunset, "--out", path], "");
    assert!(output.status.success() && text(&output.stdout).contains("9 levels"), "{output:?}");
    assert!(std::fs::read(&out).expect("the pyramid").starts_with(b"\xABKTX 20\xBB"));
    let elsewhere = folder.path().join("sunset.png");
    assert_refused(
        &softbox(&["prefilter", sunset, "--out", elsewhere.to_str().expect("a path")], ""),
        &[".ktx2"],
    );
    assert_refused(&softbox(&["prefilter", "no/such.png", "--out", path], ""), &["no/such.png", "PNG"]);
    // A red sky over a dark sea: more red than blue, in the twin as in truth.
    let with = |field: &str| GOOD.replace(r#""shape":"polygon","#, &format!(r#""shape":"polygon",{field},"#));
    let shown = with(&format!(r#""picture":"{sunset}""#));
    for on in ["cpu", "cpu-f64", "truth"] {
        let output = softbox(&["eval", "--on", on], &shown);
        assert!(output.status.success(), "{on}: {}", text(&output.stderr));
        for name in ["diffuse", "specular", "fresnel"] {
            let colour: Vec<f64> = lines(&output)[0][name]
                .as_array()
                .expect("three numbers")
                .iter()
                .map(|value| value.as_f64().expect("a number"))
                .collect();
            assert!(colour.len() == 3 && colour[0] > colour[2] && colour[2] > 0.0, "{on}: {name} {colour:?}");
        }
    }
    assert_refused(&softbox(&["eval", "--on", "gpu"], &shown), &["line 1", "picture", "not gpu"]);
    assert_refused(&softbox(&["eval"], &with(r#""picture":"no/such.png""#)), &["line 1", "no/such.png"]);
    assert_refused(&softbox(&["eval"], &with(r#""picture":7"#)), &["line 1", "PNG file"]);
    let bent = shown.replace("[1,-1,1]]", "[2,-1,1]]");
    assert_refused(&softbox(&["eval"], &bent), &["line 1", "parallelogram"]);
}

/// Lights of every shape that cannot be shaded are refused in one sentence.
#[test]
fn eval_refuses_lights_that_cannot_be_shaded() {
    let polygon = r#""shape":"polygon","points":[[-1,-1,1],[-1,1,1],[1,1,1],[1,-1,1]]"#;
    assert!(GOOD.contains(polygon));
    for (light, words) in [
        (r#""shape":"disk","center":[0,0,1],"half_x":[0,0,0],"half_y":[0,1,0]"#, "half_x is zero"),
        (r#""shape":"disk","center":[0,0,1],"half_x":[1,0,0],"half_y":[2,0,0]"#, "parallel"),
        (r#""shape":"disk","center":[0,0,1],"half_x":[1,0,0]"#, "missing field `half_y`"),
        (r#""shape":"sphere","center":[0,0,1],"radius":0"#, "radius is 0"),
        (r#""shape":"sphere","center":[0,0,1],"radius":-2"#, "radius is -2"),
        (r#""shape":"tube","start":[0,0,1],"end":[1,0,1],"radius":1e39"#, "not finite in single precision"),
        (r#""shape":"polygon","points":[[-1,-1,1],[1,1,1],[-1,1,1],[1,-1,1]]"#, "cross"),
        (r#""shape":"polygon","points":[[-2,-1,1],[1,1,1],[-1,1,1],[1,-1,1]]"#, "cross"),
        (r#""shape":"polygon","points":[[-1,-1,1],[-1,1,1],[1,1,2],[1,-1,1]]"#, "not in one plane"),
    ] {
        let output = softbox(&["eval"], &GOOD.replace(polygon, light));
        assert_refused(&output, &["line 1", words]);
    }
}
