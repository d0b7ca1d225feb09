//! Images on lights: the pyramid of blurred images that the include's `ltc_texture_fetch` reads.
//!
//! ```
//! use softbox::texture::{Prefiltered, prefilter};
//!
//! // Left half red, right half green.
//! let image: Vec<[f32; 4]> =
//!     (0..64 * 32).map(|i| if i % 64 < 32 { [1.0, 0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0, 1.0] }).collect();
//! let prefiltered: Prefiltered = prefilter(64, 32, &image);
//! assert_eq!(prefiltered.levels().len(), 7);
//! // Sharp at the first level, the mean at the last one.
//! assert_eq!(prefiltered.sample([0.25, 0.5], 0.0), [1.0, 0.0, 0.0, 1.0]);
//! assert!((prefiltered.sample([0.25, 0.5], 6.0)[0] - 0.5).abs() < 1e-6);
//! ```
//!
//! # Conventions
//!
//! Colours are linear and premultiplied by alpha: what a texel emits is its red, green and blue, times the light's
//! radiance; alpha comes along for whoever composites. Rows run from the picture's top to its bottom, texels from
//! left to right; texture coordinates run 0…1 from the outer edge of the first texel to that of the last.
//!
//! On a quad light with the vertices a, b, c, d, counter-clockwise seen from the side that emits, a is the
//! picture's lower left corner, b the lower right, c the upper right and d the upper left: whoever looks at the
//! emitting side sees the picture the right way round. The other side of a two-sided light shows it mirrored.
//!
//! # The pyramid
//!
//! Level L is the image blurred by a kernel of the variance [`VARIANCE`]·(4ᴸ − 1) in squared texels of the image,
//! close to a Gaussian from the second level on, and the first level is the image itself. The image continues
//! mirrored beyond its edges, which neither darkens them nor lets light get lost: every level has the image's mean
//! where its sides can be halved, and to a thousandth of the contrast where sides of seven texels and more cannot. The
//! last level, one texel, is the mean.
//!
//! Each level comes from the one before (Burt 1981, hierarchical discrete correlation): its texel is the sum of 8 × 8
//! texels, weighted by the cubic B-spline whose knots are two texels apart. Cubic B-splines reproduce polynomials up to
//! the third degree (Strang and Fix 1971), so weights add up to one and their variance is 4/3 wherever the texel's
//! centre lies.

mod bytes;
mod prefilter;

pub use prefilter::{LINEAR_VARIANCE, Level, Prefiltered, TAPS, VARIANCE, prefilter, weights};
