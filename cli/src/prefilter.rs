//! `softbox prefilter`.

use std::path::PathBuf;

use clap::Args;
use softbox::scene::load_picture;

use crate::bake::{check_file, write_file};
use crate::say::say;

#[derive(Args)]
pub struct PrefilterArguments {
    /// A PNG file in sRGB; its alpha masks what it emits.
    picture: PathBuf,
    /// File to write: .ktx2, or .bin for the texels of all levels as they are uploaded.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

pub fn prefilter(arguments: &PrefilterArguments) -> anyhow::Result<()> {
    let is_raw = match arguments.out.extension().and_then(|extension| extension.to_str()) {
        Some("ktx2") => false,
        Some("bin") => true,
        _ => anyhow::bail!("{} names no format; the name must end in .ktx2 or .bin", arguments.out.display()),
    };
    check_file(&arguments.out)?;
    let pyramid = load_picture(&arguments.picture)?;
    let bytes = if is_raw { pyramid.bytes() } else { pyramid.ktx2() };
    write_file(&arguments.out, &bytes)?;
    say!(
        "Wrote {}: RGBA16F, linear, premultiplied, {} levels:",
        arguments.out.display(),
        pyramid.levels().len()
    );
    for (index, level) in pyramid.levels().iter().enumerate() {
        say!("  level {index:2}  {:4} x {:4}", level.width, level.height);
    }
    Ok(())
}
