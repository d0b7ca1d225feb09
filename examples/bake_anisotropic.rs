//! Bakes the table of anisotropic GGX: `bake_anisotropic FILE` writes what `table/ltc_anisotropic.bin` holds.

use std::path::PathBuf;
use std::time::Instant;

use softbox::fit::bake_anisotropic;
use softbox::table::{AnisotropicTable, Table};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path: PathBuf = std::env::args_os().nth(1).ok_or("the file to write is missing")?.into();
    let started = Instant::now();
    let table = AnisotropicTable::pack(&bake_anisotropic(&Table::default(), 40, &|_| ()));
    std::fs::write(&path, table.bytes())?;
    println!("Wrote {} in {:.1} s.", path.display(), started.elapsed().as_secs_f64());
    Ok(())
}
