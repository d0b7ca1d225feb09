//! Fits the sums of two and of three lobes, and writes their layers to the files that the crate embeds:
//!
//!     cargo run --release -p softbox --example bake_lobes --features bake -- table

use std::path::PathBuf;

use softbox::fit::{bake_lobes, ggx};
use softbox::table::Table;

fn main() -> std::io::Result<()> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "table".to_owned()));
    for (count, name) in [(2, "ltc_two_lobes.bin"), (3, "ltc_three_lobes.bin")] {
        let table = Table::pack_lobes(&bake_lobes(&ggx, count, softbox::TABLE_SIZE, &|_| ()));
        std::fs::write(folder.join(name), table.bytes())?;
        println!("{}", folder.join(name).display());
    }
    Ok(())
}
