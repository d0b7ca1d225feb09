//! Metal's text as C++: processors as devices, whose compilers take liberties one by one.

use std::path::Path;
use std::process::Command;

use softbox::effects::Quality;
use softbox::translate::{self, Target};

use crate::compile::run;
use crate::level::{self, Level};
use crate::{Output, Promise, Way, is_long};

/// A device made of compiler switches.
struct Native {
    name: &'static str,
    /// For clang, on top of what the stand-in of Metal's library wants.
    flags: &'static str,
    long: bool,
    promise: Promise,
}

/// Where every operation rounds to the same side, errors of thousands of edges add up instead of evening out.
const ONE_WAY: f64 = 25.0;

/// The bounds of specular light are those of lobes between texels; weights of 8 bits move the lobe itself, by up to 1/512 of
/// the way from a texel to the next.
const EIGHT_BITS: f64 = 40.0;

const NATIVE: &[Native] = &[
    Native { name: "-O0", flags: "-O0 -ffp-contract=off", long: true, promise: Promise::Bounds(1.0) },
    Native { name: "-O2", flags: "-O2 -ffp-contract=off", long: false, promise: Promise::Bounds(1.0) },
    Native { name: "-O3", flags: "-O3 -ffp-contract=off", long: true, promise: Promise::Bounds(1.0) },
    Native {
        name: "-O3, products and sums fused",
        flags: "-O3 -mfma -ffp-contract=fast",
        long: false,
        promise: Promise::Bounds(1.0),
    },
    Native { name: "-O3 -ffast-math", flags: "-O3 -ffast-math", long: true, promise: Promise::Bounds(1.0) },
    Native {
        name: "-O3 -ffast-math, fused",
        flags: "-O3 -mavx2 -mfma -ffast-math",
        long: false,
        promise: Promise::Bounds(1.0),
    },
    Native {
        name: "-O3 -ffast-math, fused, reciprocals from estimates with one step of Newton",
        flags: "-O3 -mavx2 -mfma -ffast-math -mrecip=all:1",
        long: true,
        promise: Promise::InRange,
    },
    Native {
        name: "-O3 -ffast-math, reciprocals from estimates of 12 bits",
        flags: "-O3 -ffast-math -mrecip=all:0",
        long: false,
        promise: Promise::Beyond,
    },
    Native {
        name: "rounding towards zero",
        flags: "-O2 -ffp-contract=off -frounding-math -DROUNDING=FE_TOWARDZERO",
        long: false,
        promise: Promise::Bounds(ONE_WAY),
    },
    Native {
        name: "rounding up",
        flags: "-O2 -ffp-contract=off -frounding-math -DROUNDING=FE_UPWARD",
        long: true,
        promise: Promise::Bounds(ONE_WAY),
    },
    Native {
        name: "rounding down",
        flags: "-O2 -ffp-contract=off -frounding-math -DROUNDING=FE_DOWNWARD",
        long: true,
        promise: Promise::Bounds(ONE_WAY),
    },
    Native {
        name: "denormal numbers flushed",
        flags: "-O2 -ffp-contract=off -DFLUSH",
        long: false,
        promise: Promise::Bounds(1.0),
    },
    Native {
        name: "textures filtered with weights of 8 bits",
        flags: "-O2 -ffp-contract=off -DMETAL_FILTER_BITS=8",
        long: false,
        promise: Promise::Bounds(EIGHT_BITS),
    },
];

/// Every such device.
pub fn ways() -> Vec<Way> {
    let natives = NATIVE.iter().filter(|native| is_long() || !native.long);
    let way = |native: &'static Native| Way {
        driver: "this processor".to_owned(),
        path: format!("Metal, clang {}", native.name),
        levels: if is_long() { Quality::ALL.to_vec() } else { vec![Quality::Standard] },
        promise: native.promise,
        run: Box::new(|level| evaluate(level, native.flags)),
    };
    natives.map(way).collect()
}

fn evaluate(level: &Level, flags: &str) -> Result<Output, String> {
    let include = level.made("ltc.metal", |path| {
        let text =
            translate::include_for(Target::Msl, level.inputs.effects).map_err(|error| error.to_string())?;
        std::fs::write(path, text).map_err(|error| error.to_string())
    })?;
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let program = level.folder.join("metal");
    run(Command::new("clang++")
        .args(["-std=c++17", "-Xclang", "-cl-single-precision-constant", "-w", "-I"])
        .arg(tests.join("tools/metal"))
        .args(flags.split(' '))
        .arg(format!("-DINCLUDE=\"{}\"", include.display()))
        .arg(tests.join("shaders/evaluate.metal.cpp"))
        .arg("-o")
        .arg(&program))?;
    let output = level.folder.join("metal.bin");
    run(Command::new(&program).arg(level.folder.join("input.bin")).arg(&output))?;
    let version = Command::new("clang++").arg("--version").output().map_err(|error| error.to_string())?;
    let version = String::from_utf8_lossy(&version.stdout);
    Ok(Output {
        values: level::values(&output)?,
        version: format!("{}; {}", version.lines().next().unwrap_or_default().trim(), std::env::consts::ARCH),
    })
}
