//! Figures of the README that the code can make are those that it makes; `SOFTBOX_UPDATE_README=1` writes them anew.

use std::path::PathBuf;
use std::process::Command;

use softbox::WGSL_INCLUDE;
use softbox::report::costs::Baseline;
use softbox::stability::approach::approaches;
use softbox::stability::relations::RELATIONS;
use softbox::stability::{CATALOGUE, KNOWN};

const UPDATE: &str = "SOFTBOX_UPDATE_README";

fn root(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(name)
}

fn read(name: &str) -> String {
    std::fs::read_to_string(root(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Compares the README with what it should be, or writes that.
fn check(expected: &str, kept: &str) {
    if kept == expected {
        return;
    }
    if std::env::var_os(UPDATE).is_some() {
        std::fs::write(root("README.md"), expected).unwrap_or_else(|error| panic!("README.md: {error}"));
        return;
    }
    let lines = kept.lines().zip(expected.lines()).filter(|(kept, expected)| kept != expected);
    let lines: Vec<String> = lines.map(|(kept, expected)| format!("{kept}\nshould be\n{expected}")).collect();
    panic!("the README is stale, {UPDATE}=1 writes it anew:\n{}", lines.join("\n"));
}

/// One number of each family's report, as the README writes it.
fn three(rows: &[&serde_json::Value], what: &str) -> String {
    let numbers: Vec<String> = rows.iter().map(|row| row[what].to_string()).collect();
    numbers.join(" / ")
}

/// All in one test: each writes the file.
#[test]
fn figures_are_what_the_code_makes() {
    let kept = read("README.md");
    let text = with_effects(&kept);
    let text = with_levels(&text);
    check(&text, &kept);
}

fn with_effects(readme: &str) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_softbox")).args(["cost", "--json"]).output();
    let output = output.expect("the program starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let reports: Vec<serde_json::Value> = serde_json::from_slice(&output.stdout).expect("JSON");
    let driver = reports[0]["driver"].as_str().expect("a text");
    let version = driver.trim_start_matches("radv ");
    assert!(
        readme.contains(version),
        "the README's costs are not those of {driver}: {UPDATE}=1 after naming it"
    );

    let count = reports[0]["sets"].as_array().expect("rows").len();
    let head = "| effects | VGPRs | spilled | instructions | inverse throughput | HLSL | table |\n|---|---|---|---|---|---|---|\n";
    let mut table = head.to_owned();
    for at in 0..count {
        let rows: Vec<_> = reports.iter().map(|report| &report["sets"][at]).collect();
        let name = match rows[0]["effects"].as_str() {
            None => "(without the include)".to_owned(),
            Some(_) if at + 1 == count => "everything that is on by default".to_owned(),
            Some(set) => format!("`{set}`"),
        };
        let [registers, spilled, instructions, throughput] =
            ["vector_registers", "spilled_registers", "instructions", "inverse_throughput"]
                .map(|what| three(&rows, what));
        table += &format!(
            "| {name} | {registers} | {spilled} | {instructions} | {throughput} | {} | {} |\n",
            rows[0]["hlsl_bytes"], rows[0]["table_bytes"]
        );
    }
    let start = readme.find("| effects | VGPRs").expect("the README has a table of effects");
    let end = start + readme[start..].find("\n\n").expect("a table ends") + 1;
    format!("{}{table}{}", &readme[..start], &readme[end..])
}

fn with_levels(readme: &str) -> String {
    let baseline = read("docs/cost-baseline.toml");
    let baseline =
        Baseline::read(&baseline).unwrap_or_else(|error| panic!("docs/cost-baseline.toml: {error}"));
    let executed = |method: &str| {
        let found =
            baseline.executed.iter().find(|row| row.method == method && row.measure == "executed mean");
        found.unwrap_or_else(|| panic!("no {method}")).value
    };
    let compiled = |method: &str, what: &str| {
        let measure = format!("navi21 {what}, compute");
        let figures = baseline.compiled.iter().flat_map(|compiled| &compiled.figures);
        let mut found = figures.filter(|row| row.method == method && row.measure == measure);
        found.next().unwrap_or_else(|| panic!("no {measure} of {method}")).value
    };
    let rows = [
        ("| `fast`:", "fast"),
        ("| `standard`:", "standard"),
        ("| `fine`:", "fine"),
        ("| `finest`:", "finest"),
        ("| the technique as published |", "published"),
    ];
    let mut lines: Vec<String> = readme.lines().map(str::to_owned).collect();
    for (start, method) in rows {
        let line = lines.iter_mut().find(|line| line.starts_with(start));
        let line = line.unwrap_or_else(|| panic!("the README has no row {start}"));
        let mut cells: Vec<String> = line.split('|').map(str::to_owned).collect();
        // The report runs more inputs than the baseline.
        let operations: f64 = cells[3].trim().parse().unwrap_or_else(|error| panic!("{line}: {error}"));
        let ratio = executed(method) / executed("published");
        assert!((operations / ratio - 1.0).abs() < 0.02, "{method} executes {ratio} times as much: {line}");
        cells[6] =
            format!(" {} / {} ", compiled(method, "instructions"), compiled(method, "vector registers"));
        *line = cells.join("|");
    }
    lines.join("\n") + "\n"
}

/// What the text counts.
#[test]
fn counts_are_right() {
    let readme = read("README.md");
    let comments: usize = WGSL_INCLUDE
        .lines()
        .filter(|line| line.trim_start().starts_with("//"))
        .map(|line| line.len() + 1)
        .sum();
    let length = WGSL_INCLUDE.len();
    // As many as `tests/translations_run.rs` takes.
    let inputs = softbox::stability::cases(100).len();
    for said in [
        format!("catalogue of {} families", CATALOGUE.len()),
        format!("all {} ways", approaches().len()),
        format!("{} cases that were met in engines", KNOWN.len()),
        format!("{} relations that need no oracle", RELATIONS.len()),
        format!(
            "{} KB of text in all, {} % of it comments",
            (length + 500) / 1000,
            (100 * comments + length / 2) / length
        ),
        format!("{},000 inputs", inputs / 1000),
    ] {
        let one_line = readme.replace('\n', " ");
        assert!(one_line.contains(&said), "the README does not say {said:?}");
    }
}
