//! GGX in single precision, as shaders have it.

use glam::Vec3;

/// A GGX surface seen from one direction, with height-correlated Smith masking.
#[derive(Clone, Copy)]
pub(super) struct Microfacet {
    pub normal: Vec3,
    pub view: Vec3,
    /// Square of α.
    squared: f32,
    cos_view: f32,
    /// √(α² + (1 − α²)·cos²) of the view.
    root_view: f32,
}

impl Microfacet {
    /// The surface of an α.
    pub fn new(normal: Vec3, view: Vec3, alpha: f32) -> Self {
        let squared = alpha * alpha;
        let cos_view = normal.dot(view).max(1e-4);
        Self { normal, view, squared, cos_view, root_view: root(squared, cos_view) }
    }

    /// f·cos for F = 1, (1 − v·h)⁵, and the density of visible normals turned into that of reflected directions (Heitz
    /// 2014, equation 99; Heitz 2018, equation 3), for a direction above the surface.
    pub fn evaluate(&self, light: Vec3) -> [f32; 3] {
        let cos_light = self.normal.dot(light);
        let sum = self.view + light;
        let half = sum * (1.0 / sum.dot(sum).max(1e-20).sqrt());
        // The sine between normal and half vector keeps its digits where the cosine has lost them.
        let across = self.normal.cross(half);
        let along = self.normal.dot(half);
        let divisor = across.dot(across) + self.squared * along * along;
        let distribution = self.squared * core::f32::consts::FRAC_1_PI / (divisor * divisor);
        let masking =
            0.5 / (cos_light * self.root_view + self.cos_view * root(self.squared, cos_light)).max(1e-20);
        let f = (1.0 - self.view.dot(half)).max(0.0);
        let density = distribution / (2.0 * (self.cos_view + self.root_view));
        [distribution * masking * cos_light, f * f * f * f * f, density]
    }
}

fn root(squared: f32, cosine: f32) -> f32 {
    (squared + (1.0 - squared) * cosine * cosine).sqrt()
}
