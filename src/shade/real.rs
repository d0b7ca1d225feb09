//! The number types that the CPU implementation runs on.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use glam::{DVec2, DVec3, DVec4, Vec2, Vec3, Vec4};

/// A floating-point type with its glam vectors: `f32`, which computes what the shader computes, or
/// `f64`, in which the same formulas are exact for every practical purpose.
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// glam's vector of two.
    type Vec2: Copy + Debug + From<[Self; 2]> + Into<[Self; 2]>;
    /// glam's vector of three.
    type Vec3: Vector<Self>;
    /// glam's vector of four.
    type Vec4: Copy + Debug + From<[Self; 4]> + Into<[Self; 4]>;

    /// The nearest value to `value`.
    fn new(value: f64) -> Self;
    /// This value as an f64.
    fn to_f64(self) -> f64;
    /// 1 / √self.
    fn inverse_sqrt(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// The magnitude.
    fn abs(self) -> Self;
    /// The smaller of two numbers.
    fn min(self, other: Self) -> Self;
    /// The larger of two numbers.
    fn max(self, other: Self) -> Self;
    /// θ / sin θ − 1 for k = 1 − cos θ in 0…1: the include's polynomial in f32, the function itself
    /// in f64.
    fn angle_excess(k: Self) -> Self;
    /// η / sinh η − 1 for k = cosh η − 1 ≥ 0: as the include computes it in f32, the function itself
    /// in f64.
    fn hyperbolic_excess(k: Self) -> Self;
    /// Steps of an iteration that needs `single` of them for the accuracy of f32.
    fn steps(single: usize) -> usize;

    /// This value, no less than `low` and no more than `high`.
    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }
}

/// A vector of three, as glam's `Vec3` and `DVec3`.
pub trait Vector<R>:
    Copy
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<R, Output = Self>
    + From<[R; 3]>
    + Into<[R; 3]>
    + Send
    + Sync
    + 'static
{
    /// The vector (x, y, z).
    fn new(x: R, y: R, z: R) -> Self;
    /// First component.
    fn x(self) -> R;
    /// Second component.
    fn y(self) -> R;
    /// Third component.
    fn z(self) -> R;
    /// Scalar product.
    fn dot(self, other: Self) -> R;
    /// Vector product.
    fn cross(self, other: Self) -> Self;
}

macro_rules! real {
    ($real:ty, $vec2:ty, $vec3:ty, $vec4:ty, $extra:expr, $k:ident => $excess:expr, $hyperbolic:expr) => {
        impl Real for $real {
            type Vec2 = $vec2;
            type Vec3 = $vec3;
            type Vec4 = $vec4;

            fn new(value: f64) -> Self {
                value as $real
            }
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            fn inverse_sqrt(self) -> Self {
                1.0 / self.sqrt()
            }
            fn ln(self) -> Self {
                <$real>::ln(self)
            }
            fn abs(self) -> Self {
                <$real>::abs(self)
            }
            fn min(self, other: Self) -> Self {
                <$real>::min(self, other)
            }
            fn max(self, other: Self) -> Self {
                <$real>::max(self, other)
            }
            fn angle_excess($k: Self) -> Self {
                $excess
            }
            fn hyperbolic_excess($k: Self) -> Self {
                $hyperbolic
            }
            fn steps(single: usize) -> usize {
                single + $extra
            }
        }

        impl Vector<$real> for $vec3 {
            fn new(x: $real, y: $real, z: $real) -> Self {
                <$vec3>::new(x, y, z)
            }
            fn x(self) -> $real {
                self.x
            }
            fn y(self) -> $real {
                self.y
            }
            fn z(self) -> $real {
                self.z
            }
            fn dot(self, other: Self) -> $real {
                <$vec3>::dot(self, other)
            }
            fn cross(self, other: Self) -> Self {
                <$vec3>::cross(self, other)
            }
        }
    };
}

real!(f32, Vec2, Vec3, Vec4, 0, k => {
    let high = ((0.017_143_16 * k - 0.041_149_218) * k + 0.058_181_286) * k - 0.022_927_942;
    let low = ((0.038_004_92 + high * k) * k + 0.054_650_154) * k + 0.133_567_99;
    (low * k + 0.333_325_86) * k
}, {
    if k < 1.0 {
        let high = (0.001_350_465 * k - 0.007_621_603_6) * k + 0.023_172_159;
        (((high * k - 0.056_460_18) * k + 0.133_233_59) * k - 0.333_328_37) * k
    } else {
        let bounded = k.min(1e18);
        let sine = (bounded * (bounded + 2.0)).sqrt();
        (bounded + 1.0 + sine).ln() / sine - 1.0
    }
});
real!(f64, DVec2, DVec3, DVec4, 4, k => angle_excess(k), hyperbolic_excess(k));

/// θ / sin θ − 1 as a function of k = 1 − cos θ in 0…1, by the half angle, which keeps its
/// relative accuracy down to the smallest k.
pub fn angle_excess(k: f64) -> f64 {
    // The difference of angle and sine loses its digits for small angles, where four terms of the
    // series are exact.
    if k < 1e-3 {
        return k * (1.0 / 3.0 + k * (2.0 / 15.0 + k * (2.0 / 35.0 + k * 8.0 / 315.0)));
    }
    2.0 * (0.5 * k).sqrt().asin() / (k * (2.0 - k)).sqrt() - 1.0
}

/// η / sinh η − 1 as a function of k = cosh η − 1 ≥ 0: [`angle_excess`] of −k, for the two are one
/// analytic function.
pub fn hyperbolic_excess(k: f64) -> f64 {
    if k < 1e-3 {
        return -k * (1.0 / 3.0 - k * (2.0 / 15.0 - k * (2.0 / 35.0 - k * 8.0 / 315.0)));
    }
    2.0 * (0.5 * k).sqrt().asinh() / (k * (2.0 + k)).sqrt() - 1.0
}
