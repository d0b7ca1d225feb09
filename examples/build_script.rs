//! What a `build.rs` does: choose a target, a table size and a format, and get text and bytes.
//!
//! ```text
//! [build-dependencies]
//! softbox = { version = "0.1", features = ["package"] }
//! ```
//!
//! Run it here with `cargo run --release -p softbox --example build_script --features package`.

use std::error::Error;
use std::path::PathBuf;

use softbox::fit::{self, Settings};
use softbox::table::{Container, Table};
use softbox::translate::{self, Target};

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo sets OUT_DIR for a build script.
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_else(|| std::env::temp_dir().into()));

    // A smaller table for a small device: 32 × 32 texels take a quarter of the memory.
    let fitted = fit::bake(&fit::ggx, Settings::native(32), &|_| ());
    let table = Container::Ktx.write(&Table::pack(&fitted))?;
    std::fs::write(out.join("ltc.ktx2"), &table)?;

    let shader = translate::include(Target::GlslEs300)?;
    std::fs::write(out.join("ltc.glsl"), &shader)?;

    println!("{}: table of {} bytes, shader of {} bytes", out.display(), table.len(), shader.len());
    println!("cargo::rerun-if-changed=build.rs");
    Ok(())
}
