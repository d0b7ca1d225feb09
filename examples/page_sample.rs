//! Writes a report of invented figures, to look at the page's layout: nothing in it was measured.
//!
//!     cargo run --release --features report --example page_sample -- FOLDER

#[path = "../tests/report_page/sample.rs"]
mod sample;

use std::path::PathBuf;

use softbox::report::page::{LobePlot, lobe_plots, write};
use softbox::table::Table;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("name a folder to write to")?);
    let (report, pictures) = sample::report();
    let mut plots = lobe_plots(&Table::default());
    // Two further curves for each pair: the model itself at other roughness.
    for (roughness, cosine) in softbox::report::page::LOBE_SIGHTS {
        for (label, factor) in [("two lobes (invented)", 0.97), ("three lobes (invented)", 1.01)] {
            let other = LobePlot::ggx(factor * roughness, cosine);
            plots.push(LobePlot { label: label.to_owned(), roughness, ..other });
        }
    }
    write(&report, &plots, &pictures, &folder)?;
    println!("{}", folder.join("index.html").display());
    Ok(())
}
