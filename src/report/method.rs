//! Ways to evaluate a quad light, side by side.

use super::data::MethodInfo;
use super::measure::Quad;

/// A way to evaluate a quad light on a GGX surface at the origin, whose normal is +z.
pub trait Method: Sync {
    /// What it is.
    fn info(&self) -> MethodInfo;

    /// (diffuse, specular, fresnel) of a quad of unit radiance that emits towards the surface: ∫ cos/π, ∫ f·cos for F = 1 and
    /// ∫ f·cos·(1 − v·h)⁵ over the light, in the arithmetic that a shader would use (f32).
    fn value(&self, quad: &Quad) -> [f64; 3];
}
