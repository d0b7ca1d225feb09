//! WebGPU and WebGL 2: Chromium, whose compilers are Tint and ANGLE, and Dawn without a browser around it.

use std::path::Path;
use std::process::Command;

use softbox::effects::Quality;
use softbox::translate::{self, Target};

use crate::compile;
use crate::driver::installed;
use crate::level::{self as files, Level};
use crate::{Output, Promise, Way, tools};

/// What every run of Chromium wants: no window, no traffic of its own, a profile of its own.
const CHROMIUM: &str = "--headless=new --no-sandbox --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --disable-quic --user-data-dir=PROFILE";

/// Where a program of WGSL or GLSL ES runs.
struct Place {
    driver: &'static str,
    path: &'static str,
    /// In a browser: webgpu or webgl.
    api: Option<&'static str>,
    /// Of the browser, or of Dawn.
    flags: &'static str,
    /// A Mesa that `tests/stacks/install` unpacked.
    mesa: Option<&'static str>,
    /// Chromium's Vulkan driver in place of the machine's.
    swiftshader: bool,
}

const PLACES: &[Place] = &[
    Place {
        driver: "Chromium, WebGPU on SwiftShader",
        path: "WGSL, Tint",
        api: Some("webgpu"),
        flags: "--enable-unsafe-webgpu --use-webgpu-adapter=swiftshader",
        mesa: None,
        swiftshader: false,
    },
    Place {
        driver: "Chromium, WebGL 2 on SwiftShader",
        path: "GLSL ES 300, ANGLE",
        api: Some("webgl"),
        flags: "--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader",
        mesa: None,
        swiftshader: false,
    },
    Place {
        driver: "Chromium, WebGL 2 on llvmpipe",
        path: "GLSL ES 300, ANGLE",
        api: Some("webgl"),
        flags: "--use-gl=angle --use-angle=gl-egl --ignore-gpu-blocklist",
        mesa: None,
        swiftshader: false,
    },
    Place {
        driver: "Dawn on SwiftShader",
        path: "WGSL, Tint",
        api: None,
        flags: "backend=vulkan",
        mesa: None,
        swiftshader: true,
    },
    Place {
        driver: "Dawn on lavapipe of Debian's backports",
        path: "WGSL, Tint",
        api: None,
        flags: "backend=vulkan",
        mesa: Some("stacks/mesa-backports"),
        swiftshader: false,
    },
    Place {
        driver: "Dawn on llvmpipe",
        path: "WGSL, Tint",
        api: None,
        flags: "backend=opengles",
        mesa: None,
        swiftshader: false,
    },
];

/// Every such place.
pub fn ways() -> Vec<Way> {
    let way = |place: &'static Place| Way {
        driver: place.driver.to_owned(),
        path: place.path.to_owned(),
        levels: Quality::ALL.to_vec(),
        promise: Promise::Bounds(1.0),
        run: Box::new(|level| evaluate(place, level)),
    };
    PLACES.iter().map(way).collect()
}

fn evaluate(place: &Place, level: &Level) -> Result<Output, String> {
    let effects = level.inputs.effects;
    let is_webgl = place.api == Some("webgl");
    let program = if is_webgl {
        level.made("evaluate.frag", |path| {
            let include =
                translate::include_for(Target::GlslEs300, effects).map_err(|error| error.to_string())?;
            let text = tools::with_include(include_str!("web/evaluate.frag"), &include);
            std::fs::write(path, format!("#version 300 es\n{text}")).map_err(|error| error.to_string())
        })?
    } else {
        let recipes = compile::recipes();
        let recipe = recipes.iter().find(|recipe| recipe.form == compile::Form::Wgsl);
        recipe.ok_or("there is no recipe for WGSL")?.program(level)?
    };
    let web = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/stacks/web");
    let output = level.folder.join("web.bin");
    let mut command = Command::new("node");
    match place.api {
        Some(api) => {
            command.arg(web.join("browser.mjs")).arg(api).arg(&level.folder);
            command.arg(program).arg(&output).arg("chromium").args(CHROMIUM.split_whitespace());
        }
        None => {
            command.arg(web.join("dawn.mjs")).arg(installed("stacks/node/node_modules/webgpu/index.js")?);
            command.arg(&level.folder).arg(program).arg(&output);
        }
    }
    command.args(place.flags.split(' '));
    if place.swiftshader {
        command.env("VK_ICD_FILENAMES", installed("tools/swiftshader/vk_swiftshader_icd.json")?);
    }
    // Without a display there is no other platform of EGL.
    command.env("EGL_PLATFORM", "surfaceless");
    if let Some(mesa) = place.mesa {
        let root = installed(mesa)?;
        command.env("VK_ICD_FILENAMES", format!("{root}/lvp_icd.json"));
        command.env("LD_LIBRARY_PATH", format!("{root}/usr/lib/x86_64-linux-gnu"));
    }
    let _ = std::fs::remove_file(&output);
    let run = command.output().map_err(|error| {
        format!("cannot run {command:?}: {error}; `tests/stacks/install` installs Node and Chromium")
    })?;
    if !run.status.success() {
        return Err(format!("{command:?}: {}: {}", run.status, String::from_utf8_lossy(&run.stderr)));
    }
    Ok(Output {
        values: files::values(&output)?,
        version: String::from_utf8_lossy(&run.stdout).trim().to_owned(),
    })
}
