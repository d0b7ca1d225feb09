//! A linearly transformed cosine: the lobe that stands in for a BRDF.

use glam::DVec3;

/// The inverse matrix of a linearly transformed cosine (Heitz et al. 2016), with its middle entry
/// normalised to 1:
///
/// ```text
/// M⁻¹ = | x 0 z |
///       | 0 1 0 |
///       | y 0 w |
/// ```
///
/// The names follow the components of the published table's first texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Row 1, column 1.
    pub x: f64,
    /// Row 3, column 1.
    pub y: f64,
    /// Row 1, column 3.
    pub z: f64,
    /// Row 3, column 3.
    pub w: f64,
}

impl Lobe {
    /// The clamped cosine itself.
    pub const IDENTITY: Self = Self { x: 1.0, y: 0.0, z: 0.0, w: 1.0 };

    /// The limit of GGX's lobe as α → 0 at the view angle whose cosine is given: the clamped
    /// cosine squeezed by α around the mirror direction.
    ///
    /// ```
    /// let lobe = softbox::lobe::Lobe::mirror_limit(1e-3, 0.6);
    /// // The mirror direction of a view at (0.8, 0, 0.6) is the lobe's axis.
    /// let axis = lobe.transform(glam::DVec3::new(-0.8, 0.0, 0.6));
    /// assert!(axis.x.abs() < 1e-15 && axis.z > 0.0);
    /// ```
    pub fn mirror_limit(alpha: f64, cosine: f64) -> Self {
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        Self {
            x: cosine * cosine,
            y: -2.0 * alpha * sine * cosine,
            z: sine * cosine,
            w: 2.0 * alpha * cosine * cosine,
        }
    }

    /// The four entries in the order x, y, z, w.
    pub fn entries(&self) -> [f64; 4] {
        [self.x, self.y, self.z, self.w]
    }

    /// The inverse of [`Lobe::entries`].
    pub fn from_entries([x, y, z, w]: [f64; 4]) -> Self {
        Self { x, y, z, w }
    }

    /// M⁻¹·`direction`.
    pub fn transform(&self, direction: DVec3) -> DVec3 {
        DVec3::new(
            self.x * direction.x + self.z * direction.z,
            direction.y,
            self.y * direction.x + self.w * direction.z,
        )
    }

    /// |M⁻¹|.
    pub fn determinant(&self) -> f64 {
        self.x * self.w - self.y * self.z
    }
}
