//! Bakes the table of the published technique that reports compare with:
//!
//! ```text
//! cargo run --release -p softbox --features bake --example bake_published -- table/ltc_published.bin
//! ```

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("name the file to write")?;
    let (coefficients, error) = softbox::fit::fit_published_angle();
    println!("edge integral: {coefficients:.7?}, relative error {error:.2e}");
    std::fs::write(path, softbox::fit::bake_published(softbox::TABLE_SIZE).bytes())?;
    Ok(())
}
