//! Compilers that the tests run.
#![allow(dead_code, reason = "each test file uses a part of this module")]

use std::path::{Path, PathBuf};
use std::process::Command;

/// A fresh folder for a test's files.
pub fn scratch(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&path).unwrap_or_else(|error| panic!("cannot make {}: {error}", path.display()));
    path
}

/// Runs a tool and returns what it printed; panics when it is missing or fails.
pub fn run(command: &mut Command) -> String {
    let shown = format!("{command:?}");
    let output = command.output().unwrap_or_else(|error| {
        panic!("cannot run {shown}: {error}; `tests/tools/install` installs what the tests need")
    });
    let text =
        String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{shown} failed:\n{text}");
    text
}

/// The HLSL compiler with its first argument, the library.
pub fn dxc() -> Command {
    let tools = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/tools");
    let mut command = Command::new(tools.join("dxc"));
    command.arg(tools.join("libdxcompiler.so"));
    command
}

/// Writes a text to a file and returns its path.
pub fn write(folder: &Path, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap_or_else(|error| panic!("cannot write {}: {error}", path.display()));
    path
}

/// Reads a file's bytes.
pub fn read(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|error| panic!("cannot read {}: {error}", path.display()))
}

/// A hand-written shader with the include in its place.
pub fn with_include(shader: &str, include: &str) -> String {
    assert!(shader.contains("//include\n"), "the shader has no line for the include");
    shader.replacen("//include\n", include, 1)
}

/// Asserts that a compiler had nothing to say but what it always says.
pub fn assert_silent(text: &str, always: &[&str]) {
    let rest: Vec<&str> = text
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty() && !always.iter().any(|known| line.contains(known)))
        .collect();
    assert!(rest.is_empty(), "the compiler says:\n{}", rest.join("\n"));
}
