//! What a table's texels hold and where they lie.

use crate::brdf::SHEEN_ROUGHNESS_FLOOR;
use crate::lobe::Lobe;
use crate::shade::LTC_ROUGHNESS_FLOOR;

/// The meaning of a table's axes and of the four numbers that describe a lobe.
///
/// All layouts place roughness along the first axis, from 0 at the first texel's centre to 1 at
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
    /// One layer for a sheen of the roughness r, on the include's axes: with (X, Z, W) and the albedo
    /// in a texel,
    ///
    /// ```text
    /// x = X    z = sin θ·Z / r
    /// y = 0    w = W / r
    /// ```
    ///
    /// The lobe lies on the surface's horizon and is about r high, so W is of order 1. A fourth
    /// entry y, which tilts the lobe's own horizon, would lower the error of the lobe's shape by less
    /// than a thirtieth of itself; without it no part of the lobe lies below the surface.
    Sheen,
    /// One layer for a rough diffuse surface, on the include's axes: with (Y, Z, W) and the albedo in
    /// a texel,
    ///
    /// ```text
    /// x = 1            z = sin θ·Z
    /// y = sin θ·Y      w = W
    /// ```
    ///
    /// Lambert's surface is (0, 0, 1). Here x is the entry to do without: that raises the error of the
    /// lobe's shape by a tenth to a fifth of itself; y = 0 would about double it.
    Diffuse,
}

/// The largest and the smallest cosine at which lobes are fitted; the layouts' formulas lose
/// their meaning where sin θ or cos θ is 0.
const COSINES: (f64, f64) = (1e-4, 1.0 - 1e-7);

impl Layout {
    /// cos θ at a coordinate of the second axis in 0…1, kept within the fitted range.
    pub fn cosine(self, coordinate: f64) -> f64 {
        let cosine = match self {
            Self::Native | Self::Sheen | Self::Diffuse => coordinate * coordinate,
            Self::Compatible => 1.0 - coordinate * coordinate,
        };
        cosine.clamp(COSINES.0, COSINES.1)
    }

    /// α at a coordinate of the first axis.
    pub fn alpha(self, coordinate: f64) -> f64 {
        let floor = if self == Self::Sheen { SHEEN_ROUGHNESS_FLOOR } else { LTC_ROUGHNESS_FLOOR };
        coordinate.max(floor).powi(2)
    }

    /// Whether the fit walks from the first row of texels to the last one: from the view at which lobes
    /// are easiest to find. A specular lobe is round along the normal; a sheen hardly reflects there, and
    /// is brightest at grazing views.
    pub(crate) fn ascends(self) -> bool {
        matches!(self, Self::Compatible | Self::Sheen)
    }

    /// The layout in which a lobe that fits one view best starts the fit of the next one.
    pub(crate) fn walk(self) -> Self {
        if self == Self::Compatible { Self::Native } else { self }
    }

    /// Which of the lobe's entries are fitted; the others are the layout's own.
    pub(crate) fn free(self) -> [bool; 4] {
        match self {
            Self::Native | Self::Compatible => [true; 4],
            Self::Sheen => [true, false, true, true],
            Self::Diffuse => [false, true, true, true],
        }
    }

    /// Lobes from which to start at the first view.
    pub(crate) fn starts(self, alpha: f64, cosine: f64) -> [Lobe; 2] {
        let first = match self {
            // Round, and as narrow as the mirror's, 2α to about α.
            Self::Native | Self::Compatible => {
                super::decode(Self::Native, &[0.0, -2.0, 0.0, 2.0 - alpha], alpha, cosine)
            }
            // Close to the horizon, and leaning back towards the view.
            Self::Sheen => super::decode(self, &[1.3, 0.0, -0.4, 1.2], alpha, cosine),
            Self::Diffuse => Lobe::IDENTITY,
        };
        [first, Lobe::IDENTITY]
    }

    /// Each entry of the lobe is `offset + scale·parameter`; the scale of one that is not free is 0.
    pub(crate) fn affine(self, alpha: f64, cosine: f64) -> ([f64; 4], [f64; 4]) {
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        match self {
            Self::Native => {
                let limit = Lobe::mirror_limit(alpha, cosine);
                ([limit.x, 0.0, limit.z, 0.0], [alpha, alpha * sine, alpha * sine, alpha])
            }
            Self::Compatible => ([0.0; 4], [1.0; 4]),
            Self::Sheen => {
                let reach = 1.0 / alpha.sqrt();
                ([0.0; 4], [1.0, 0.0, sine * reach, reach])
            }
            Self::Diffuse => ([1.0, 0.0, 0.0, 0.0], [0.0, sine, sine, 1.0]),
        }
    }
}
