//! The table in the file formats that engines read.

use super::Table;
use crate::ktx;

/// A way to write a table's texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Container {
    /// The bytes of [`Table::bytes`] and nothing else.
    Raw,
    /// A DirectDraw surface with the DX10 header: a texture array of R16G16B16A16_FLOAT layers.
    Dds,
    /// Khronos texture 2: an array of R16G16B16A16_SFLOAT layers, without supercompression.
    Ktx,
    /// A Rust constant, `pub const LTC_TABLE: [u16; …]`.
    Rust,
    /// A C or C++ header, `static const uint16_t ltc_table[…]`.
    C,
}

/// Why a table could not be written.
#[derive(Debug, thiserror::Error)]
#[error("no DDS file of the table: {0}")]
pub struct ContainerError(#[from] ddsfile::Error);

impl Container {
    /// Every container.
    pub const ALL: [Self; 5] = [Self::Raw, Self::Dds, Self::Ktx, Self::Rust, Self::C];

    /// The file name's extension.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Raw => "bin",
            Self::Dds => "dds",
            Self::Ktx => "ktx2",
            Self::Rust => "rs",
            Self::C => "h",
        }
    }

    /// The file's bytes.
    ///
    /// # Errors
    ///
    /// If the DDS writer refuses the table.
    pub fn write(self, table: &Table) -> Result<Vec<u8>, ContainerError> {
        Ok(match self {
            Self::Raw => table.bytes(),
            Self::Dds => dds(table)?,
            // An array of one layer is written as such, not as a plain texture.
            Self::Ktx => ktx::file([table.size(); 2], table.layers().len(), &[table.bytes()], false),
            Self::Rust => rust(table).into_bytes(),
            Self::C => c(table).into_bytes(),
        })
    }
}

fn dds(table: &Table) -> Result<Vec<u8>, ContainerError> {
    let size = table.size() as u32;
    let mut file = ddsfile::Dds::new_dxgi(ddsfile::NewDxgiParams {
        height: size,
        width: size,
        depth: None,
        format: ddsfile::DxgiFormat::R16G16B16A16_Float,
        mipmap_levels: None,
        array_layers: Some(table.layers().len() as u32),
        caps2: None,
        is_cubemap: false,
        resource_dimension: ddsfile::D3D10ResourceDimension::Texture2D,
        alpha_mode: ddsfile::AlphaMode::Custom,
    })?;
    file.data = table.bytes();
    let mut bytes = Vec::new();
    file.write(&mut bytes)?;
    Ok(bytes)
}

fn words(table: &Table) -> impl Iterator<Item = String> {
    let words: Vec<u16> =
        table.bytes().chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
    words
        .chunks(12)
        .map(|row| row.iter().map(|word| format!("0x{word:04x},")).collect::<Vec<_>>().join(" "))
        .collect::<Vec<_>>()
        .into_iter()
}

fn describe(table: &Table) -> String {
    let size = table.size();
    let layers = match table.layers().len() {
        1 => "One layer".to_owned(),
        2 => "Two layers".to_owned(),
        count => format!("{count} layers"),
    };
    format!(
        "{layers} of {size} x {size} texels of four half-precision numbers, as their bits; layer\n// after layer, row after row, roughness fastest."
    )
}

fn rust(table: &Table) -> String {
    let size = table.size();
    let mut text = format!(
        "// {}\n\n/// Texels along each axis.\npub const LTC_TABLE_SIZE: usize = {size};\n\n/// The texels of an RGBA16F texture array.\n#[rustfmt::skip]\npub const LTC_TABLE: [u16; {}] = [\n",
        describe(table),
        4 * table.layers().len() * size * size
    );
    for row in words(table) {
        text.push_str("    ");
        text.push_str(&row);
        text.push('\n');
    }
    text.push_str("];\n");
    text
}

fn c(table: &Table) -> String {
    let size = table.size();
    let mut text = format!(
        "// {}\n\n#ifndef LTC_TABLE_INCLUDED\n#define LTC_TABLE_INCLUDED\n\n#include <stdint.h>\n\n#define LTC_TABLE_SIZE {size}\n\nstatic const uint16_t ltc_table[{}] = {{\n",
        describe(table),
        4 * table.layers().len() * size * size
    );
    for row in words(table) {
        text.push_str("    ");
        text.push_str(&row);
        text.push('\n');
    }
    text.push_str("};\n\n#endif // LTC_TABLE_INCLUDED\n");
    text
}
