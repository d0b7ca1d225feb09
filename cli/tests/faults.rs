//! Writers survive faults: a full disk, folders that cannot be written to, a reader that leaves, and being killed at any
//! moment. What was there before is there after, or the new thing whole.
#![cfg(unix)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::os::unix::fs::{FileTypeExt, MetadataExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant, SystemTime};

use softbox::output::write_file;
use softbox::package::{MANIFEST, Package, write_folder};

const SOFTBOX: &str = env!("CARGO_BIN_EXE_softbox");

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

/// Every file in a folder, those whose name begins with a dot too, with what it holds.
fn tree(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut pending = vec![folder.to_owned()];
    while let Some(directory) = pending.pop() {
        for entry in
            fs::read_dir(&directory).unwrap_or_else(|error| panic!("{}: {error}", directory.display()))
        {
            let path = entry.expect("an entry").path();
            if path.is_dir() && !path.is_symlink() {
                pending.push(path);
            } else {
                let bytes = fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
                files.insert(path.strip_prefix(folder).expect("within").to_owned(), bytes);
            }
        }
    }
    files
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Asserts exit code 2 and one sentence with the given words.
fn assert_refused(what: &dyn core::fmt::Debug, output: &Output, words: &[&str]) {
    let text = String::from_utf8_lossy(&output.stderr);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(output.status.code(), Some(2), "{what:?}: {lines:?}");
    assert_eq!(lines.len(), 1, "{what:?}: one sentence: {lines:?}");
    for word in words {
        assert!(lines[0].contains(word), "{what:?}: {word:?} is not in {:?}", lines[0]);
    }
}

/// Commands that write, each with the name of what it writes.
fn writers(folder: &Path) -> Vec<(Vec<String>, PathBuf)> {
    let scene = scenes().join("hard.toml").display().to_string();
    let picture = scenes().join("sunset.png").display().to_string();
    let out = |name: &str| folder.join(name);
    let command = |arguments: &[&str], name: &str| {
        let mut all: Vec<String> = arguments.iter().map(|argument| (*argument).to_owned()).collect();
        all.extend(["--out".to_owned(), out(name).display().to_string()]);
        (all, out(name))
    };
    vec![
        command(&["build", "--table-size", "2", "--effects", "quad+ggx"], "package"),
        command(&["bake", "--size", "32"], "table.dds"),
        command(&["prefilter", &picture], "picture.ktx2"),
        command(&["select", "quad,disk+ggx", "--target", "hlsl"], "shader.hlsl"),
        command(&["render", &scene, "--width", "320", "--samples", "1"], "picture.png"),
    ]
}

fn softbox(arguments: &[String]) -> Command {
    let mut command = Command::new(SOFTBOX);
    command.args(arguments).env("MESA_SHADER_CACHE_DISABLE", "true");
    command
}

fn run(arguments: &[String]) -> Output {
    softbox(arguments).output().expect("the program starts")
}

/// What is at a path, whatever it is.
fn state(path: &Path) -> Option<BTreeMap<PathBuf, Vec<u8>>> {
    if path.is_dir() {
        Some(tree(path))
    } else {
        path.exists().then(|| BTreeMap::from([(PathBuf::new(), fs::read(path).expect("a file"))]))
    }
}

/// Runs a command where each file may be of so many blocks of 1024 bytes, and one byte more is refused.
fn run_on_a_full_disk(arguments: &[String], blocks: &str) -> Output {
    Command::new("bash")
        .args(["-c", "trap '' XFSZ; ulimit -f \"$1\"; shift; exec \"$@\"", "bash", blocks, SOFTBOX])
        .args(arguments)
        .env("MESA_SHADER_CACHE_DISABLE", "true")
        .output()
        .expect("bash starts")
}

#[test]
fn a_full_disk_leaves_what_was_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let full = |arguments: &[String], out: &Path, blocks: &str| {
        let before = (state(out), names(folder.path()));
        let name = out.file_name().expect("a name").to_string_lossy();
        let words = if arguments[0] == "render" { "could not be written" } else { "cannot write" };
        let output = run_on_a_full_disk(arguments, blocks);
        assert_refused(&(arguments, blocks), &output, &[words, &name, "File too large"]);
        assert!((state(out), names(folder.path())) == before, "{arguments:?} left something at {blocks}");
    };
    for (arguments, out) in writers(folder.path()) {
        // Nothing at all, and a part of the first file or of a later one.
        full(&arguments, &out, "0");
        let output = run(&arguments);
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        // And where there is something to lose.
        full(&arguments, &out, "8");
    }
    assert_eq!(names(folder.path()).iter().filter(|name| name.starts_with('.')).count(), 0);
}

/// Where nothing can be written: below a file, in a system's own folder, and without the right to.
#[test]
fn places_that_cannot_be_written_to_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    fs::write(&file, "mine").expect("a file");
    // A folder that another user may read and not write.
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755)).expect("permissions");
    let locked = folder.path().join("locked");
    fs::create_dir(&locked).expect("a folder");
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o555)).expect("permissions");
    // The program where that user can reach it.
    let program = folder.path().join("softbox");
    fs::copy(SOFTBOX, &program).expect("a copy of the program");
    let sunset = folder.path().join("sunset.png");
    fs::copy(scenes().join("sunset.png"), &sunset).expect("a copy of the picture");
    let is_root = fs::metadata(folder.path()).expect("the folder").uid() == 0;
    for place in [file.join("below"), PathBuf::from("/proc/softbox-none"), locked.clone()] {
        for (arguments, out) in writers(&place) {
            // A missing folder is made for a package only.
            let (render, missing) = (arguments[0] == "render", place != locked);
            let mut command = Command::new(if is_root { Path::new("setpriv") } else { &program });
            if is_root {
                command.args(["--reuid=65534", "--regid=65534", "--clear-groups"]).arg(&program);
            }
            let scene = scenes().join("hard.toml").display().to_string();
            let sunset_here = sunset.display().to_string();
            let picture = scenes().join("sunset.png").display().to_string();
            let arguments: Vec<String> = arguments
                .iter()
                .map(|argument| if *argument == picture { sunset_here.clone() } else { argument.clone() })
                .collect();
            if render && !missing {
                // The scene lies where that user may not look; the name is refused in the same way for a missing folder.
                continue;
            }
            let _ = scene;
            let output = command.args(&arguments).env("HOME", "/nonexistent").output().expect("it starts");
            let parent = out.parent().expect("a parent").display().to_string();
            let parent = if arguments[0] == "build" && place.starts_with(&file) {
                file.display().to_string()
            } else {
                parent
            };
            let words: &[&str] = if render {
                &["picture.png", "there is no folder"]
            } else {
                &["cannot write", parent.as_str()]
            };
            assert_refused(&arguments, &output, words);
        }
    }
    assert_eq!(fs::read_to_string(&file).expect("the file"), "mine");
    assert!(names(&locked).is_empty());
    let deep = folder.path().join("a/b/package").display().to_string();
    let build = ["build", "--table-size", "2", "--effects", "quad", "--out", &deep].map(str::to_owned);
    assert!(run(&build).status.success(), "a package's folder is made with those above it");
    assert!(Path::new(&deep).join(MANIFEST).exists());
}

/// Standard output may be full, or closed by who reads it.
#[test]
fn standard_output_may_fail() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("t.bin").display().to_string();
    let scene = scenes().join("lights.toml").display().to_string();
    let case = r#"{"surface":{"position":[0,0,0],"normal":[0,0,1],"view":[0,0,1],"roughness":1},"light":{"shape":"sphere","center":[0,0,2],"radius":1}}"#;
    let cases = folder.path().join("cases").display().to_string();
    fs::write(&cases, format!("{case}\n")).expect("a file");
    for arguments in [
        vec!["eval", &cases],
        vec!["effects", &scene],
        vec!["select", "quad"],
        vec!["select", "--list"],
        vec!["bake", "--size", "2", "--out", &table],
    ] {
        let full = File::options().write(true).open("/dev/full").expect("a full device");
        let output = Command::new(SOFTBOX).args(&arguments).stdout(full).output().expect("it starts");
        assert_refused(&arguments, &output, &["standard output", "No space left"]);
        // Nobody reads.
        let mut child = Command::new(SOFTBOX)
            .args(&arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("it ends");
        assert!(output.status.success() && output.stderr.is_empty(), "{arguments:?}: {output:?}");
    }
}

/// Devices and links are written through, not replaced.
#[test]
fn links_stay_links() {
    let folder = tempfile::tempdir().expect("a folder");
    let (real, link, null) =
        (folder.path().join("real"), folder.path().join("link"), folder.path().join("null"));
    fs::write(&real, "old").expect("a file");
    symlink(&real, &link).expect("a link");
    symlink("/dev/null", &null).expect("a link");
    for out in [&link, &null] {
        let output = run(&["select", "quad", "--out", &out.display().to_string()].map(str::to_owned));
        assert!(output.status.success() && out.is_symlink(), "{}: {output:?}", out.display());
    }
    assert!(fs::read_to_string(&real).expect("text").contains("fn ltc_quad("));
    assert!(fs::metadata(&null).expect("the device").file_type().is_char_device());
    let (package, to_package) = (folder.path().join("package"), folder.path().join("to-package"));
    write_folder(&version(1), &package).expect("a package");
    symlink(&package, &to_package).expect("a link");
    write_folder(&version(2), &to_package).expect("another package");
    assert!(to_package.is_symlink() && tree(&package) == expected(2));
    assert_eq!(names(folder.path()), ["link", "null", "package", "real", "to-package"]);
    for none in [".", ".."] {
        let error = write_folder(&version(1), &folder.path().join(none)).expect_err("no name").to_string();
        assert!(error.contains("no part of a package") || error.contains("no name of its own"), "{error}");
    }
}

/// A package in one of two versions, which have other files, too.
fn version(number: u8) -> Package {
    let mut files: Vec<(String, Vec<u8>)> = (0..12)
        .map(|index| (format!("folder-{}/file-{index}", index % 3), vec![number; 2000 * index + 1]))
        .collect();
    files.push(("wgsl/ltc.wgsl".to_owned(), vec![b'0' + number; 200_000]));
    files.push((format!("only-{number}"), vec![number]));
    Package { files, native: None, compatible: None }
}

fn expected(number: u8) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = version(number).files;
    let mut names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).chain([MANIFEST]).collect();
    names.sort_unstable();
    let manifest: String = names.iter().map(|name| format!("{name}\n")).collect();
    files.push((MANIFEST.to_owned(), manifest.into_bytes()));
    files.into_iter().map(|(name, bytes)| (PathBuf::from(name), bytes)).collect()
}

fn file_of(number: u8) -> Vec<u8> {
    vec![number; 3_000_000]
}

/// Not a test of its own: writes until it is killed, for the tests below.
#[test]
#[ignore = "started by other tests, and never ends"]
fn writes_for_ever() {
    let Some(target) = std::env::var_os("SOFTBOX_FAULTS_TARGET").map(PathBuf::from) else { return };
    let how = std::env::var("SOFTBOX_FAULTS_HOW").unwrap_or_default();
    for number in [2, 1].into_iter().cycle() {
        match how.as_str() {
            "folder" => write_folder(&version(number), &target).expect("a package"),
            "file" => write_file(&target, &file_of(number)).expect("a file"),
            // What the tests below must catch.
            _ => fs::write(&target, file_of(number)).expect("a file"),
        }
    }
}

/// SplitMix64 (Steele et al. 2014), in 0…1.
fn unit(seed: u64) -> f64 {
    let z = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Starts a writer, kills it after a while, `count` times over, and looks at what is there each time. Returns how often the
/// first and the second version were there, and neither.
fn killed(how: &str, target: &Path, count: u64, look: &dyn Fn() -> Option<u8>) -> [usize; 3] {
    let mut seen = [0; 3];
    for index in 0..count {
        let mut child = Command::new(std::env::current_exe().expect("this program"))
            .args(["--exact", "writes_for_ever", "--ignored", "--nocapture"])
            .env("SOFTBOX_FAULTS_TARGET", target)
            .env("SOFTBOX_FAULTS_HOW", how)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("a writer starts");
        std::thread::sleep(Duration::from_secs_f64(0.2 * unit(index)));
        assert!(child.try_wait().expect("the writer").is_none(), "the writer failed by itself");
        child.kill().expect("a signal");
        child.wait().expect("the writer");
        match look() {
            Some(number) => seen[usize::from(number) - 1] += 1,
            None => seen[2] += 1,
        }
    }
    seen
}

#[test]
fn a_killed_writer_leaves_one_whole_package() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = folder.path().join("package");
    write_folder(&version(1), &target).expect("a package");
    let trees = [1, 2].map(expected);
    let look = || trees.iter().position(|expected| tree(&target) == *expected).map(|index| index as u8 + 1);
    let seen = killed("folder", &target, 150, &look);
    let left: Vec<String> = names(folder.path()).into_iter().filter(|name| name != "package").collect();
    println!("{seen:?}, {} left beside", left.len());
    assert!(seen[0] > 0 && seen[1] > 0 && seen[2] == 0, "{seen:?}");
    // Some were killed in the middle; what they left does not hinder, and goes when nobody can still be writing it.
    assert!(left.len() > 5, "{left:?}");
    assert!(left.iter().all(|name| name.starts_with(".package.new-")), "{left:?}");
    write_folder(&version(1), &target).expect("a package");
    assert!(tree(&target) == trees[0] && names(folder.path()).len() == left.len() + 1);
    let long_ago = SystemTime::now() - Duration::from_secs(3600);
    for name in &left {
        File::open(folder.path().join(name))
            .and_then(|there| there.set_modified(long_ago))
            .expect("its time");
    }
    fs::create_dir(folder.path().join(".package.new-mine")).expect("a folder of another kind");
    write_folder(&version(2), &target).expect("a package");
    assert!(tree(&target) == trees[1]);
    assert_eq!(names(folder.path()), [".package.new-mine", "package"]);
}

#[test]
fn a_killed_writer_leaves_one_whole_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = folder.path().join("table.bin");
    fs::write(&target, file_of(1)).expect("a file");
    let look = || [1, 2].into_iter().find(|number| fs::read(&target).expect("the file") == file_of(*number));
    let seen = killed("file", &target, 100, &look);
    assert!(seen[0] > 0 && seen[1] > 0 && seen[2] == 0, "{seen:?}");
    let left: Vec<String> = names(folder.path()).into_iter().filter(|name| name != "table.bin").collect();
    assert!(left.iter().all(|name| name.starts_with(".table.bin.new-")), "{left:?}");
    // A writer in place is caught by the same look.
    let seen = killed("in place", &target, 100, &look);
    assert!(seen[2] > 0, "half a file is not seen: {seen:?}");
}

/// The program itself, killed over all of its time.
#[test]
fn a_killed_build_leaves_the_old_package_or_the_new_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = |name: &str| folder.path().join(name);
    let build = |effects: &str, name: &str| {
        let out = out(name).display().to_string();
        ["build", "--table-size", "2", "--effects", effects, "--out", &out].map(str::to_owned)
    };
    let started = Instant::now();
    assert!(run(&build("quad+ggx", "new")).status.success());
    let whole = started.elapsed().as_secs_f64();
    for name in ["old", "package"] {
        assert!(run(&build("disk", name)).status.success());
    }
    let (old, new) = (tree(&out("old")), tree(&out("new")));
    let mut seen = BTreeSet::new();
    for index in 0..14 {
        let mut child = softbox(&build("quad+ggx", "package"))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("it starts");
        if index % 2 == 0 {
            std::thread::sleep(Duration::from_secs_f64(whole * unit(index)));
        } else {
            // Just when it begins to write.
            let fresh = out(&format!(".package.new-{}", child.id()));
            let begun = Instant::now();
            while !fresh.exists() && begun.elapsed().as_secs() < 60 && child.try_wait().expect("it").is_none()
            {
                std::thread::sleep(Duration::from_micros(200));
            }
            std::thread::sleep(Duration::from_secs_f64(0.03 * unit(index)));
        }
        // It may have ended.
        let _ = child.kill();
        child.wait().expect("it ends");
        let now = tree(&out("package"));
        assert!(now == old || now == new, "after {index}: {:?}", now.keys());
        seen.insert(now == new);
        if now == new {
            assert!(run(&build("disk", "package")).status.success());
        }
    }
    assert!(run(&build("quad+ggx", "package")).status.success());
    assert!(tree(&out("package")) == new);
    assert!(seen.contains(&false), "it was never killed in time");
}
