//! Vulkan and OpenGL drivers, through wgpu, each in a process of its own.

use std::path::Path;
use std::process::{Command, ExitCode};

use softbox::device::{Batch, Device, Program};
use softbox::effects::{EffectsError, Quality};
use softbox::stability::{driver_name, driver_version, table};

use crate::compile::{self, Form};
use crate::level::{self as files, Level};
use crate::{Output, Promise, Way, is_long};

/// First argument of the process that talks to a driver.
pub const CHILD: &str = "--on-driver";

/// A driver: the adapter of an API that has that place, in an environment.
#[derive(Clone, Debug)]
struct Driver {
    name: String,
    opengl: bool,
    adapter: usize,
    environment: Vec<(String, String)>,
    /// It runs every recipe; others only what differs by more than its text.
    every: bool,
}

impl Driver {
    fn new(name: &str, opengl: bool, environment: &[(&str, &str)]) -> Self {
        let environment =
            environment.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
        Self { name: name.to_owned(), opengl, adapter: 0, environment, every: false }
    }

    fn run(&self, level: &Level, form: Form, program: &Path) -> Result<Output, String> {
        let output = level.folder.join("values.bin");
        let this = std::env::current_exe().map_err(|error| error.to_string())?;
        let mut command = Command::new(this);
        command
            .arg(CHILD)
            .args([if self.opengl { "opengl" } else { "vulkan" }, &self.adapter.to_string()])
            .args([level.inputs.level.name(), form.name()])
            .arg(program)
            .arg(&level.folder)
            .arg(&output)
            .envs(self.environment.iter().map(|(name, value)| (name, value)));
        let _ = std::fs::remove_file(&output);
        let run = command.output().map_err(|error| format!("{command:?}: {error}"))?;
        if !run.status.success() {
            return Err(format!("{command:?}: {}: {}", run.status, String::from_utf8_lossy(&run.stderr)));
        }
        Ok(Output {
            values: files::values(&output)?,
            version: String::from_utf8_lossy(&run.stdout).trim().to_owned(),
        })
    }
}

/// The process of one driver: evaluates, writes the values, and prints what the driver says of itself.
pub fn child(arguments: &[String]) -> ExitCode {
    match evaluate(arguments) {
        Ok(version) => {
            println!("{version}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn evaluate(arguments: &[String]) -> Result<String, String> {
    let [api, adapter, level, form, program, folder, output] = arguments else {
        return Err(format!(
            "{CHILD} wants an API, an adapter, a level, a form, a program, a folder and a file, not {arguments:?}"
        ));
    };
    let level: Quality = level.parse().map_err(|error: EffectsError| error.to_string())?;
    let backends = if api == "opengl" { wgpu::Backends::GL } else { wgpu::Backends::VULKAN };
    let place: usize = adapter.parse().map_err(|error| format!("{adapter}: {error}"))?;
    let mut devices = Device::every(backends).map_err(|error| error.to_string())?;
    if place >= devices.len() {
        return Err(format!("there are {} adapters, and none at {place}", devices.len()));
    }
    let device = devices.swap_remove(place);
    let bytes = std::fs::read(program).map_err(|error| format!("cannot read {program}: {error}"))?;
    let text = || String::from_utf8(bytes.clone()).map_err(|error| error.to_string());
    // SAFETY: the kernel checks its index against the number of pairs, and walks over the vertices that a light counts;
    // `softbox::stability::batch` makes both right.
    let program = match Form::named(form)? {
        Form::Wgsl => Program::wgsl(text()?),
        Form::Glsl => unsafe { Program::glsl(text()?) },
        Form::Spirv(entry_point) => unsafe { Program::spirv(bytes, entry_point) },
    };
    let folder = Path::new(folder);
    let batch = Batch {
        surfaces: files::read(&folder.join("surfaces.bin"))?,
        lights: files::read(&folder.join("lights.bin"))?,
        vertices: files::read(&folder.join("vertices.bin"))?,
        pairs: files::read(&folder.join("pairs.bin"))?,
    };
    let values = device.evaluate(&program, &table(level), &batch).map_err(|error| error.to_string())?;
    let values: Vec<[f32; 4]> = values.into_iter().map(|[a, b, c]| [a, b, c, 0.0]).collect();
    std::fs::write(output, bytemuck::cast_slice(&values))
        .map_err(|error| format!("cannot write {output}: {error}"))?;
    Ok(driver_version(&device))
}

/// Where `tests/tools/install` and `tests/stacks/install` put things.
pub fn installed(path: &str) -> Result<String, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("target").join(path);
    let install = if path.to_string_lossy().contains("stacks") {
        "tests/stacks/install"
    } else {
        "tests/tools/install"
    };
    if path.exists() {
        Ok(path.display().to_string())
    } else {
        Err(format!("{} is missing: {install} gets it", path.display()))
    }
}

/// Every driver with every recipe that it takes.
pub fn ways() -> Vec<Way> {
    let recipes = compile::recipes();
    let mut ways = Vec::new();
    for driver in drivers() {
        for recipe in recipes.iter().filter(|recipe| is_long() || !recipe.long) {
            let runs = match recipe.form {
                Form::Wgsl => true,
                Form::Glsl => driver.opengl && driver.every,
                Form::Spirv(_) => !driver.opengl && driver.every,
            };
            if runs {
                let (driver, recipe) = (driver.clone(), recipe.clone());
                ways.push(Way {
                    driver: driver.name.clone(),
                    path: recipe.name.clone(),
                    levels: if is_long() { recipe.levels.clone() } else { recipe.short_levels() },
                    promise: Promise::Bounds(1.0),
                    run: Box::new(move |level| driver.run(level, recipe.form, &recipe.program(level)?)),
                });
            }
        }
    }
    ways
}

/// The drivers that are there without settings, each with every recipe, and Chromium's; then those that settings or
/// `tests/stacks/install` bring.
fn drivers() -> Vec<Driver> {
    let mut drivers = Vec::new();
    for (opengl, backends) in [(false, wgpu::Backends::VULKAN), (true, wgpu::Backends::GL)] {
        let devices = Device::every(backends).unwrap_or_else(|error| panic!("{error}"));
        for (adapter, device) in devices.iter().enumerate() {
            drivers.push(Driver { adapter, every: true, ..Driver::new(&driver_name(device), opengl, &[]) });
        }
    }
    let icd =
        installed("tools/swiftshader/vk_swiftshader_icd.json").unwrap_or_else(|error| panic!("{error}"));
    drivers.push(Driver { every: true, ..Driver::new("SwiftShader", false, &[("VK_ICD_FILENAMES", &icd)]) });
    if !is_long() {
        return drivers;
    }
    for (name, variable, value) in [
        ("lavapipe, vectors of 128 bits", "LP_NATIVE_VECTOR_WIDTH", "128"),
        ("lavapipe, vectors of 512 bits", "LP_NATIVE_VECTOR_WIDTH", "512"),
        ("lavapipe, no optimisation", "GALLIVM_PERF", "nopt"),
        ("lavapipe, filtering as written", "GALLIVM_PERF", "no_filter_hacks,no_aos_sampling"),
        ("lavapipe, a processor with SSE2 alone", "GALLIUM_OVERRIDE_CPU_CAPS", "sse2"),
        ("lavapipe, a processor with AVX but no FMA", "GALLIUM_OVERRIDE_CPU_CAPS", "avx"),
    ] {
        // Mesa's cache on disk does not know all settings.
        drivers.push(Driver::new(name, false, &[(variable, value), ("MESA_SHADER_CACHE_DISABLE", "true")]));
    }
    // It has all that the kernel calls for, but not all of OpenGL 4.5.
    let softpipe = [
        ("GALLIUM_DRIVER", "softpipe"),
        ("MESA_GL_VERSION_OVERRIDE", "4.5"),
        ("MESA_GLSL_VERSION_OVERRIDE", "450"),
    ];
    drivers.push(Driver { every: true, ..Driver::new("softpipe", true, &softpipe) });
    drivers.extend(further_mesas());
    drivers
}

/// Mesas of other versions: what `tests/stacks/install` unpacks into folders.
fn further_mesas() -> Vec<Driver> {
    let root = installed("stacks/mesa-backports").unwrap_or_else(|error| panic!("{error}"));
    let libraries = format!("{root}/usr/lib/x86_64-linux-gnu");
    let icd = format!("{root}/lvp_icd.json");
    let base = [("LD_LIBRARY_PATH", libraries.as_str())];
    let vulkan = [&base[..], &[("VK_ICD_FILENAMES", icd.as_str())]].concat();
    let vendor = format!("{root}/usr/share/glvnd/egl_vendor.d/50_mesa.json");
    let drivers = format!("{libraries}/dri");
    let opengl = [
        &base[..],
        &[("__EGL_VENDOR_LIBRARY_FILENAMES", vendor.as_str()), ("LIBGL_DRIVERS_PATH", drivers.as_str())],
    ]
    .concat();
    vec![
        Driver::new("lavapipe of Debian's backports", false, &vulkan),
        Driver::new("llvmpipe of Debian's backports", true, &opengl),
    ]
}
