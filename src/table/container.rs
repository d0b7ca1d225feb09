//! The table in the file formats that engines read.

use super::Table;

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
            Self::Ktx => ktx(table),
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

/// KTX 2.0 by its specification (Khronos, sections 3 and 4): identifier, header, index, one level,
/// data format descriptor, level data. No crate writes it for an uncompressed array.
fn ktx(table: &Table) -> Vec<u8> {
    const IDENTIFIER: [u8; 12] = [0xAB, b'K', b'T', b'X', b' ', b'2', b'0', 0xBB, b'\r', b'\n', 0x1A, b'\n'];
    const VK_FORMAT_R16G16B16A16_SFLOAT: u32 = 97;
    const HEADER_LENGTH: u32 = 80;
    const LEVEL_INDEX_LENGTH: u32 = 24;
    const SAMPLES: u32 = 4;
    const DESCRIPTOR_LENGTH: u32 = 4 + 24 + 16 * SAMPLES;

    let data = table.bytes();
    let descriptor_at = HEADER_LENGTH + LEVEL_INDEX_LENGTH;
    // Level data starts at a multiple of the texel's 8 bytes.
    let data_at = (descriptor_at + DESCRIPTOR_LENGTH).next_multiple_of(8);
    let size = table.size() as u32;
    // An array of one layer is written as such, not as a plain texture.
    let layers = table.layers().len() as u32;

    let mut bytes = IDENTIFIER.to_vec();
    let mut put = |word: u32| bytes.extend(word.to_le_bytes());
    // vkFormat, typeSize, width, height, depth, layers, faces, levels, supercompression.
    for word in [VK_FORMAT_R16G16B16A16_SFLOAT, 2, size, size, 0, layers, 1, 1, 0] {
        put(word);
    }
    // Offsets and lengths of descriptor, key/value data and (64-bit) supercompression data.
    for word in [descriptor_at, DESCRIPTOR_LENGTH, 0, 0, 0, 0, 0, 0] {
        put(word);
    }
    // The level's offset, length and uncompressed length, each of 64 bits.
    for word in [data_at, 0, data.len() as u32, 0, data.len() as u32, 0] {
        put(word);
    }
    // The basic data format descriptor: RGB with BT.709 primaries, linear, texel block of 8 bytes.
    put(DESCRIPTOR_LENGTH);
    put(0);
    put(2 | ((DESCRIPTOR_LENGTH - 4) << 16));
    put(u32::from_le_bytes([1, 1, 1, 0]));
    put(0);
    put(8);
    put(0);
    // Each sample: bit offset, bit length − 1, channel with the float and signed flags; position;
    // the range −1…1 as floats.
    for (index, channel) in [0_u32, 1, 2, 15].into_iter().enumerate() {
        put((16 * index as u32) | (15 << 16) | ((channel | 0xC0) << 24));
        put(0);
        put((-1.0_f32).to_bits());
        put(1.0_f32.to_bits());
    }
    bytes.resize(data_at as usize, 0);
    bytes.extend(data);
    bytes
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
