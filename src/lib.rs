//! Softbox.
#[cfg(feature = "shade")]
pub mod brdf;
#[cfg(feature = "bake")]
pub mod fit;
#[cfg(feature = "shade")]
pub mod lobe;
