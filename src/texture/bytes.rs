//! The pyramid as bytes for uploads and files.

use half::f16;

use super::{Level, Prefiltered};
use crate::ktx;

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

    /// A KTX 2.0 file of the pyramid: an R16G16B16A16_SFLOAT texture with mipmaps, linear, alpha premultiplied, the
    /// first row at the top.
    pub fn ktx2(&self) -> Vec<u8> {
        let levels: Vec<Vec<u8>> = self.levels().iter().map(Level::bytes).collect();
        ktx::file([self.levels()[0].width, self.levels()[0].height], 0, &levels, true)
    }
}
