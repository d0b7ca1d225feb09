//! Area lights by linearly transformed cosines.
//!
//! One WGSL include evaluates the light of polygons on rough surfaces in closed form (Heitz, Dupuy, Hill
//! and Neubelt 2016); this crate holds it, its translations to GLSL, HLSL, MSL and SPIR-V, and the lookup
//! table that it reads:
//!
//! ```
//! assert!(softbox::WGSL_INCLUDE.contains("fn ltc_quad("));
//! let glsl = softbox::GLSL.get_file("450/ltc.glsl").unwrap().contents_utf8().unwrap();
//! assert!(glsl.contains("vec3 ltc_quad("));
//! // Two layers of 64 x 64 texels of RGBA16F.
//! assert_eq!(softbox::TABLE_NATIVE.len(), 2 * 64 * 64 * 4 * 2);
//! ```
//!
//! A scene pays only for what it calls for: [`effects`] selects from the include. By default that is all.
//! Everything else is behind a feature:
//!
//! | feature | brings |
//! |---|---|
//! | `shade` | the include's functions on the CPU, table look-up, ground truth |
//! | `bake` | fitting tables from reflectance models, measuring them |
//! | `translate` | the include as text for each target, made on the spot |
//! | `package` | the drop-in package, table file formats |
//! | `device` | evaluation on a wgpu adapter |
//! | `scene` | scene files and their rendering |
//! | `interpret` | kernels run operation by operation: what they take, and what any conforming device may make of them |
//! | `cost` | what a compiler for AMD's processors makes of a set of effects |
//! | `report` | errors and costs of every quality level, side by side |
//! | `stability` | hard cases and what must hold there |

use include_dir::{Dir, include_dir};

/// The include.
pub const WGSL_INCLUDE: &str = include_str!("../wgsl/ltc.wgsl");

/// A kernel that evaluates pairs of surfaces and lights; to be appended to [`WGSL_INCLUDE`].
pub const WGSL_EVALUATE: &str = include_str!("../wgsl/evaluate.wgsl");

/// A kernel that renders scenes; to be appended to [`WGSL_INCLUDE`].
pub const WGSL_RENDER: &str = include_str!("../wgsl/render.wgsl");

/// Kernels that make the mipmaps of a textured light's picture; a module of its own.
pub const WGSL_PREFILTER: &str = include_str!("../wgsl/prefilter.wgsl");

/// The include in GLSL: `450/ltc.glsl`, `330/ltc.glsl`, `es300/ltc.glsl` and `es310/ltc.glsl`.
pub static GLSL: Dir = include_dir!("$CARGO_MANIFEST_DIR/glsl");

/// The include in HLSL: `ltc.hlsl`, and `Ltc.ush` for Unreal.
pub static HLSL: Dir = include_dir!("$CARGO_MANIFEST_DIR/hlsl");

/// The include in the Metal shading language.
pub const MSL_INCLUDE: &str = include_str!("../msl/ltc.metal");

/// [`WGSL_EVALUATE`] with the include as a SPIR-V 1.3 module; its entry point is `evaluate`.
pub const SPIRV_EVALUATE: &[u8] = include_bytes!("../spirv/ltc_evaluate.spv");

/// Texels along each axis of the embedded tables.
pub const TABLE_SIZE: usize = 64;

/// The table that the include reads, for GGX with height-correlated Smith masking: the texels of an
/// RGBA16F texture array of two layers, little-endian, layer after layer, row after row.
pub const TABLE_NATIVE: &[u8] = include_bytes!("../table/ltc.bin");

/// The same for code that implements the published technique, in the layout of the published tables.
pub const TABLE_COMPATIBLE: &[u8] = include_bytes!("../table/ltc_compatible.bin");

/// The layer that the include reads for sheen, of the same format and size: one layer, for the model
/// of Estevez and Kulla (2017).
pub const TABLE_SHEEN: &[u8] = include_bytes!("../table/ltc_sheen.bin");

/// The layer that the include reads for rough diffuse surfaces: one layer, for the single scattering
/// of the model of Portsmouth, Kutz and Hill (2025).
pub const TABLE_DIFFUSE: &[u8] = include_bytes!("../table/ltc_diffuse.bin");

/// The three layers that the include reads in place of [`TABLE_NATIVE`] for a sum of two lobes: see `ltc_lobes_from_table` in
/// the include.
pub const TABLE_TWO_LOBES: &[u8] = include_bytes!("../table/ltc_two_lobes.bin");

/// The five layers for a sum of three lobes.
pub const TABLE_THREE_LOBES: &[u8] = include_bytes!("../table/ltc_three_lobes.bin");

/// Two further layers of that array, for anisotropic GGX: see `ltc_anisotropic_lobe` in the include.
pub const TABLE_ANISOTROPIC: &[u8] = include_bytes!("../table/ltc_anisotropic.bin");

#[cfg(feature = "shade")]
pub mod brdf;
#[cfg(feature = "device")]
pub mod device;
pub mod effects;
#[cfg(feature = "bake")]
pub mod fit;
#[cfg(any(feature = "package", feature = "report"))]
mod folder;
#[cfg(any(feature = "scene", feature = "report"))]
pub mod input;
#[cfg(feature = "interpret")]
pub mod interpret;
#[cfg(feature = "shade")]
mod ktx;
#[cfg(feature = "shade")]
pub mod light;
#[cfg(feature = "shade")]
pub mod lobe;
#[cfg(any(feature = "package", feature = "scene", feature = "report"))]
pub mod output;
#[cfg(feature = "package")]
pub mod package;
#[cfg(any(feature = "bake", feature = "cost"))]
pub mod report;
#[cfg(feature = "scene")]
pub mod scene;
#[cfg(feature = "shade")]
pub mod shade;
#[cfg(feature = "stability")]
pub mod stability;
#[cfg(feature = "shade")]
pub mod table;
#[cfg(feature = "shade")]
pub mod texture;
#[cfg(feature = "translate")]
pub mod translate;
#[cfg(feature = "shade")]
pub mod truth;
