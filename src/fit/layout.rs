//! What a table's texels hold and where they lie.

use crate::lobe::Lobe;
use crate::shade::LTC_ROUGHNESS_FLOOR;

/// The meaning of a table's axes and of the four numbers that describe a lobe.
///
/// Both layouts place roughness along the first axis, from 0 at the first texel's centre to 1 at
/// the last one's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Layout {
    /// The include's own layout: the second axis is √cos θ, and the four numbers (X, Y, Z, W) are
    /// deviations from the mirror limit in units of the lobe's width,
    ///
    /// ```text
    /// x = cos²θ + α·X    z = sin θ·(cos θ + α·Z)
    /// y = α·sin θ·Y      w = α·W
    /// ```
    ///
    /// All four stay of order 1 and vary slowly, so neither interpolation nor half precision
    /// moves a sharp lobe off the mirror direction.
    Native,
    /// The layout of the published tables (Heitz et al. 2016, as released in 2017): the second
    /// axis is √(1 − cos θ), the four numbers are the entries (x, y, z, w) themselves.
    Compatible,
}

/// The largest and the smallest cosine at which lobes are fitted; the layouts' formulas lose
/// their meaning where sin θ or cos θ is 0.
const COSINES: (f64, f64) = (1e-4, 1.0 - 1e-7);

impl Layout {
    /// cos θ at a coordinate of the second axis in 0…1, kept within the fitted range.
    pub fn cosine(self, coordinate: f64) -> f64 {
        let cosine = match self {
            Self::Native => coordinate * coordinate,
            Self::Compatible => 1.0 - coordinate * coordinate,
        };
        cosine.clamp(COSINES.0, COSINES.1)
    }

    /// α at a coordinate of the first axis.
    pub fn alpha(self, coordinate: f64) -> f64 {
        coordinate.max(LTC_ROUGHNESS_FLOOR).powi(2)
    }

    /// Each entry of the lobe is `offset + scale·parameter`.
    pub(crate) fn affine(self, alpha: f64, cosine: f64) -> ([f64; 4], [f64; 4]) {
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        match self {
            Self::Native => {
                let limit = Lobe::mirror_limit(alpha, cosine);
                ([limit.x, 0.0, limit.z, 0.0], [alpha, alpha * sine, alpha * sine, alpha])
            }
            Self::Compatible => ([0.0; 4], [1.0; 4]),
        }
    }
}
