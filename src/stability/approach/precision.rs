//! What the published forms ask of a number type beyond what the include does.

use crate::shade::{Real, Vector};

/// A number type with the functions that the published forms call. Those of the standard library round better than a
/// shading language has to: what goes wrong here goes wrong on every device.
pub trait Precision: Real {
    /// Square root; not a number below zero.
    fn sqrt(self) -> Self;
    /// The angle of a cosine; not a number beyond ±1.
    fn acos(self) -> Self;
    /// The angle of a tangent.
    fn atan(self) -> Self;
    /// The angle of the direction (x, self).
    fn atan2(self, x: Self) -> Self;
    /// The cosine.
    fn cos(self) -> Self;
    /// The sine.
    fn sin(self) -> Self;
}

macro_rules! precision {
    ($real:ty) => {
        impl Precision for $real {
            fn sqrt(self) -> Self {
                <$real>::sqrt(self)
            }
            fn acos(self) -> Self {
                <$real>::acos(self)
            }
            fn atan(self) -> Self {
                <$real>::atan(self)
            }
            fn atan2(self, x: Self) -> Self {
                <$real>::atan2(self, x)
            }
            fn cos(self) -> Self {
                <$real>::cos(self)
            }
            fn sin(self) -> Self {
                <$real>::sin(self)
            }
        }
    };
}

precision!(f32);
precision!(f64);

/// A vector of coordinates that both number types hold.
pub(super) fn vector<R: Real>(v: glam::DVec3) -> R::Vec3 {
    R::Vec3::new(R::new(v.x), R::new(v.y), R::new(v.z))
}

/// `v` over its length, without a guard: as shading languages have it.
pub(super) fn normalize<R: Precision>(v: R::Vec3) -> R::Vec3 {
    v * (R::new(1.0) / v.dot(v).sqrt())
}
