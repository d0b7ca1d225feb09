//! GGX with a different roughness along each of two axes.

use core::f64::consts::PI;
use glam::{DVec2, DVec3};

use crate::brdf::Brdf;

/// The anisotropic GGX microfacet model with height-correlated Smith masking (Walter et al. 2007;
/// Burley 2012 for the anisotropic distribution; Heitz 2014, equations 85, 86 and 99).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnisotropicGgx {
    /// The distribution's α along the tangent, in (0, 1].
    pub alpha_x: f64,
    /// The distribution's α across the tangent, in (0, 1].
    pub alpha_y: f64,
    /// Azimuth of the tangent in the surface's frame, counter-clockwise from +x in radians.
    pub azimuth: f64,
}

impl AnisotropicGgx {
    /// The direction with its azimuth measured from the tangent.
    fn turned(&self, direction: DVec3) -> DVec3 {
        let (sine, cosine) = self.azimuth.sin_cos();
        DVec3::new(
            cosine * direction.x + sine * direction.y,
            cosine * direction.y - sine * direction.x,
            direction.z,
        )
    }

    /// The inverse of [`Self::turned`].
    fn turned_back(&self, direction: DVec3) -> DVec3 {
        Self { azimuth: -self.azimuth, ..*self }.turned(direction)
    }

    /// The density of half vectors, from one whose azimuth is measured from the tangent.
    fn distribution(&self, half: DVec3) -> f64 {
        let (x, y) = (half.x / self.alpha_x, half.y / self.alpha_y);
        let denominator = x * x + y * y + half.z * half.z;
        1.0 / (PI * self.alpha_x * self.alpha_y * denominator * denominator)
    }

    /// Smith's auxiliary function Λ.
    fn lambda(&self, direction: DVec3) -> f64 {
        let (x, y) = (self.alpha_x * direction.x, self.alpha_y * direction.y);
        let tangent2 = (x * x + y * y) / (direction.z * direction.z).max(f64::MIN_POSITIVE);
        // (√(1 + t) − 1) / 2 without its cancellation at small t.
        0.5 * tangent2 / ((1.0 + tangent2).sqrt() + 1.0)
    }
}

impl Brdf for AnisotropicGgx {
    fn evaluate(&self, view: DVec3, light: DVec3) -> f64 {
        if view.z <= 0.0 || light.z <= 0.0 {
            return 0.0;
        }
        let (view, light) = (self.turned(view), self.turned(light));
        let half = (view + light).normalize();
        let masking = 1.0 / (1.0 + self.lambda(view) + self.lambda(light));
        self.distribution(half) * masking / (4.0 * view.z * light.z)
    }

    /// Samples the visible normals by the spherical-cap method (Dupuy and Benyoub 2023).
    fn sample(&self, view: DVec3, random: DVec2) -> DVec3 {
        let view = self.turned(view);
        let stretched =
            DVec3::new(self.alpha_x * view.x, self.alpha_y * view.y, view.z.max(1e-9)).normalize();
        // Measured from the stretched view's azimuth, so that for equal roughnesses the mirror symmetry in
        // `random.y` is exact.
        let azimuth = stretched.y.atan2(stretched.x) + 2.0 * PI * random.y;
        let z = (1.0 - random.x) * (1.0 + stretched.z) - stretched.z;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let visible = DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z) + stretched;
        let half = DVec3::new(self.alpha_x * visible.x, self.alpha_y * visible.y, visible.z.max(0.0))
            .normalize_or(DVec3::Z);
        self.turned_back(2.0 * view.dot(half) * half - view)
    }

    fn pdf(&self, view: DVec3, light: DVec3) -> f64 {
        if view.z <= 0.0 {
            return 0.0;
        }
        let (view, light) = (self.turned(view), self.turned(light));
        let half = (view + light).normalize();
        if half.z <= 0.0 {
            return 0.0;
        }
        self.distribution(half) / (4.0 * view.z * (1.0 + self.lambda(view)))
    }

    /// The narrower of the two widths, so that integrators find the lobe wherever they cut it.
    fn width(&self) -> f64 {
        self.alpha_x.min(self.alpha_y)
    }
}
