//! The pyramid as bytes for uploads and files.

use half::f16;

use super::{Level, Prefiltered};

impl Level {
    /// The texels as RGBA16F, little-endian, row after row from the top. Values beyond the range of half precision
    /// become its largest number.
    pub fn bytes(&self) -> Vec<u8> {
        let largest = f16::MAX.to_f32();
        let numbers = self.texels.iter().flatten();
        numbers.flat_map(|value| f16::from_f32(value.clamp(-largest, largest)).to_le_bytes()).collect()
    }
}

impl Prefiltered {
    /// The bytes of all levels, the image first, as a texture upload in the order of mipmaps takes them.
    pub fn bytes(&self) -> Vec<u8> {
        self.levels().iter().flat_map(Level::bytes).collect()
    }
}

/// First bytes of a KTX 2.0 file.
const IDENTIFIER: [u8; 12] = [0xAB, b'K', b'T', b'X', b' ', b'2', b'0', 0xBB, b'\r', b'\n', 0x1A, b'\n'];

const VK_FORMAT_R16G16B16A16_SFLOAT: u32 = 97;

impl Prefiltered {
    /// A KTX 2.0 file of the pyramid: an R16G16B16A16_SFLOAT texture with mipmaps, linear, alpha premultiplied, the
    /// first row at the top (Khronos, KTX File Format Specification 2.0, sections 3 and 4).
    pub fn ktx2(&self) -> Vec<u8> {
        const HEADER_LENGTH: usize = 80;
        const LEVEL_INDEX_LENGTH: usize = 24;
        const DESCRIPTOR_LENGTH: usize = 4 + 24 + 16 * 4;
        let levels = self.levels();
        let descriptor_at = HEADER_LENGTH + LEVEL_INDEX_LENGTH * levels.len();
        let mut data = Vec::new();
        // Level data starts at a multiple of the texel's 8 bytes, the smallest level first.
        let data_at = (descriptor_at + DESCRIPTOR_LENGTH).next_multiple_of(8);
        let mut index = vec![(0, 0); levels.len()];
        for (level, place) in levels.iter().zip(&mut index).rev() {
            let bytes = level.bytes();
            *place = ((data_at + data.len()) as u64, bytes.len() as u64);
            data.extend(bytes);
        }
        let mut bytes = IDENTIFIER.to_vec();
        let mut put = |words: &[u32]| bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        let (width, height) = (levels[0].width as u32, levels[0].height as u32);
        // vkFormat, typeSize, width, height, depth, layers, faces, levels, supercompression.
        put(&[VK_FORMAT_R16G16B16A16_SFLOAT, 2, width, height, 0, 0, 1, levels.len() as u32, 0]);
        // Offsets and lengths of descriptor, key/value data and (64-bit) supercompression data.
        put(&[descriptor_at as u32, DESCRIPTOR_LENGTH as u32, 0, 0, 0, 0, 0, 0]);
        for (offset, length) in index {
            for number in [offset, length, length] {
                put(&[number as u32, (number >> 32) as u32]);
            }
        }
        // The basic data format descriptor: RGB with BT.709 primaries, linear, premultiplied; a texel of 8 bytes.
        put(&[DESCRIPTOR_LENGTH as u32, 0, 2 | ((DESCRIPTOR_LENGTH as u32 - 4) << 16)]);
        put(&[u32::from_le_bytes([1, 1, 1, 1]), 0, 8, 0]);
        // Each sample: bit offset, bit length − 1, channel with the float and signed flags; position; range −1…1.
        for (index, channel) in [0, 1, 2, 15].into_iter().enumerate() {
            put(&[(16 * index as u32) | (15 << 16) | ((channel | 0xC0) << 24), 0]);
            put(&[(-1.0_f32).to_bits(), 1.0_f32.to_bits()]);
        }
        bytes.resize(data_at, 0);
        bytes.extend(data);
        bytes
    }
}
