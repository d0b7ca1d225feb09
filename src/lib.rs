//! Softbox.

/// The include.
pub const WGSL_INCLUDE: &str = include_str!("../wgsl/ltc.wgsl");
/// The kernel.
pub const WGSL_EVALUATE: &str = include_str!("../wgsl/evaluate.wgsl");
pub const TABLE_SIZE: usize = 64;
pub const TABLE_NATIVE: &[u8] = include_bytes!("../table/ltc.bin");
pub const TABLE_COMPATIBLE: &[u8] = include_bytes!("../table/ltc_compatible.bin");

#[cfg(feature = "shade")]
pub mod brdf;
#[cfg(feature = "device")]
pub mod device;
#[cfg(feature = "bake")]
pub mod fit;
#[cfg(feature = "shade")]
pub mod light;
#[cfg(feature = "shade")]
pub mod lobe;
#[cfg(feature = "package")]
pub mod package;
#[cfg(feature = "bake")]
pub mod report;
#[cfg(feature = "shade")]
pub mod shade;
#[cfg(feature = "shade")]
pub mod table;
#[cfg(feature = "translate")]
pub mod translate;
#[cfg(feature = "shade")]
pub mod truth;
