//! KTX 2.0 files of half-precision textures.

/// First bytes of a file.
const IDENTIFIER: [u8; 12] = [0xAB, b'K', b'T', b'X', b' ', b'2', b'0', 0xBB, b'\r', b'\n', 0x1A, b'\n'];

const VK_FORMAT_R16G16B16A16_SFLOAT: u32 = 97;
const HEADER_LENGTH: usize = 80;
const LEVEL_INDEX_LENGTH: usize = 24;
const DESCRIPTOR_LENGTH: usize = 4 + 24 + 16 * 4;

/// A file by its specification (Khronos, KTX File Format Specification 2.0, sections 3 and 4): identifier, header, index,
/// data format descriptor, levels. No crate writes it for uncompressed texels.
///
/// The texture has `layers` layers, or is no array for 0; `levels` are the texels of its mipmaps, the largest first.
/// Colours are linear with BT.709 primaries, and premultiplied by alpha or not.
pub(crate) fn file(
    [width, height]: [usize; 2],
    layers: usize,
    levels: &[Vec<u8>],
    premultiplied: bool,
) -> Vec<u8> {
    let descriptor_at = HEADER_LENGTH + LEVEL_INDEX_LENGTH * levels.len();
    let mut data: Vec<u8> = Vec::new();
    // Level data starts at a multiple of the texel's 8 bytes, the smallest level first.
    let data_at = (descriptor_at + DESCRIPTOR_LENGTH).next_multiple_of(8);
    let mut index = vec![(0, 0); levels.len()];
    for (level, place) in levels.iter().zip(&mut index).rev() {
        *place = ((data_at + data.len()) as u64, level.len() as u64);
        data.extend(level);
    }
    let mut bytes = IDENTIFIER.to_vec();
    let mut put = |words: &[u32]| bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    let [width, height, layers, count] = [width, height, layers, levels.len()].map(|number| number as u32);
    // vkFormat, typeSize, width, height, depth, layers, faces, levels, supercompression.
    put(&[VK_FORMAT_R16G16B16A16_SFLOAT, 2, width, height, 0, layers, 1, count, 0]);
    // Offsets and lengths of descriptor, key/value data and (64-bit) supercompression data.
    put(&[descriptor_at as u32, DESCRIPTOR_LENGTH as u32, 0, 0, 0, 0, 0, 0]);
    for (offset, length) in index {
        for number in [offset, length, length] {
            put(&[number as u32, (number >> 32) as u32]);
        }
    }
    // The basic data format descriptor: RGB with BT.709 primaries, linear; a texel of 8 bytes.
    put(&[DESCRIPTOR_LENGTH as u32, 0, 2 | ((DESCRIPTOR_LENGTH as u32 - 4) << 16)]);
    put(&[u32::from_le_bytes([1, 1, 1, u8::from(premultiplied)]), 0, 8, 0]);
    // Each sample: bit offset, bit length − 1, channel with the float and signed flags; position; range −1…1.
    for (index, channel) in [0, 1, 2, 15].into_iter().enumerate() {
        put(&[(16 * index as u32) | (15 << 16) | ((channel | 0xC0) << 24), 0]);
        put(&[(-1.0_f32).to_bits(), 1.0_f32.to_bits()]);
    }
    bytes.resize(data_at, 0);
    bytes.extend(data);
    bytes
}
