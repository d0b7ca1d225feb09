//! The reflectance models that a table is baked from.
//!
//! Every model works in the surface frame: the normal is +z, and directions are unit vectors that
//! point away from the surface. Fresnel reflectance is left out (F = 1); it enters at shading time
//! through the table's Schlick part.

mod anisotropic;
mod charlie;
mod eon;

pub use anisotropic::AnisotropicGgx;
pub use charlie::{Charlie, SHEEN_ROUGHNESS_FLOOR, Visibility};
pub use eon::{Eon, Scattering};

use core::f64::consts::PI;
use glam::{DVec2, DVec3};

/// A bidirectional reflectance distribution function without its Fresnel factor.
///
/// Implement it to bake a table for a material model of your own; see `fit::bake`.
pub trait Brdf: Sync {
    /// The value f(view, light) in 1/sr, without the cosine; 0 when either direction is below the
    /// surface.
    fn evaluate(&self, view: DVec3, light: DVec3) -> f64;

    /// A light direction drawn with density [`Brdf::pdf`] from `random` in [0, 1)². It may lie
    /// below the surface, where `evaluate` is 0. It must be a smooth function of `random`, because
    /// the fit integrates with a regular grid of such points; and mirroring `random.y` to
    /// `1 - random.y` must mirror the result at the plane of incidence.
    fn sample(&self, view: DVec3, random: DVec2) -> DVec3;

    /// Density of [`Brdf::sample`] with respect to solid angle, in 1/sr.
    fn pdf(&self, view: DVec3, light: DVec3) -> f64;

    /// Angular width of the lobe around the mirror direction in radians: α for a microfacet model,
    /// 1 for a diffuse one. Integrators place their first subdivisions with it.
    fn width(&self) -> f64;
}

/// How microfacets hide each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Masking {
    /// Smith masking and shadowing correlated by height (Heitz 2014, equation 99).
    HeightCorrelated,
    /// The product of G1 = (n·w) / ((n·w)(1 − k) + k) for both directions, Schlick's approximation
    /// to Smith masking (Schlick 1994; Karis 2013 uses k = (roughness + 1)² / 8 for analytic
    /// lights and k = α / 2 otherwise).
    Schlick {
        /// The constant k, 0 for no masking.
        k: f64,
    },
}

/// The GGX microfacet model (Walter et al. 2007; Trowbridge and Reitz 1975).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    /// The distribution's α = roughness², in (0, 1].
    pub alpha: f64,
    /// The masking term.
    pub masking: Masking,
}

impl Ggx {
    /// GGX with height-correlated Smith masking.
    pub fn new(alpha: f64) -> Self {
        Self { alpha, masking: Masking::HeightCorrelated }
    }

    fn distribution(&self, half: DVec3) -> f64 {
        let a2 = self.alpha * self.alpha;
        let tangential = half.x * half.x + half.y * half.y;
        let denominator = tangential + a2 * half.z * half.z;
        a2 / (PI * denominator * denominator)
    }

    /// Smith's auxiliary function Λ for GGX (Heitz 2014, equation 72).
    fn lambda(&self, direction: DVec3) -> f64 {
        let tangent2 = (direction.x * direction.x + direction.y * direction.y)
            / (direction.z * direction.z).max(f64::MIN_POSITIVE);
        let root = (1.0 + self.alpha * self.alpha * tangent2).sqrt();
        // (root − 1) / 2 without its cancellation at small α.
        0.5 * self.alpha * self.alpha * tangent2 / (root + 1.0)
    }
}

impl Brdf for Ggx {
    fn evaluate(&self, view: DVec3, light: DVec3) -> f64 {
        if view.z <= 0.0 || light.z <= 0.0 {
            return 0.0;
        }
        let half = (view + light).normalize();
        let masking = match self.masking {
            Masking::HeightCorrelated => 1.0 / (1.0 + self.lambda(view) + self.lambda(light)),
            Masking::Schlick { k } => schlick_masking(view.z, k) * schlick_masking(light.z, k),
        };
        self.distribution(half) * masking / (4.0 * view.z * light.z)
    }

    /// Samples the visible normals by the spherical-cap method (Dupuy and Benyoub 2023).
    fn sample(&self, view: DVec3, random: DVec2) -> DVec3 {
        let stretched = DVec3::new(self.alpha * view.x, self.alpha * view.y, view.z.max(1e-9)).normalize();
        // The azimuth is measured from the plane of incidence, which makes the mirror symmetry in
        // `random.y` exact for a view in the xz-plane.
        let azimuth = 2.0 * PI * random.y;
        let z = (1.0 - random.x) * (1.0 + stretched.z) - stretched.z;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let cap = DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z);
        let visible = cap + stretched;
        let half = DVec3::new(self.alpha * visible.x, self.alpha * visible.y, visible.z.max(0.0))
            .normalize_or(DVec3::Z);
        2.0 * view.dot(half) * half - view
    }

    fn pdf(&self, view: DVec3, light: DVec3) -> f64 {
        if view.z <= 0.0 {
            return 0.0;
        }
        let half = (view + light).normalize();
        if half.z <= 0.0 {
            return 0.0;
        }
        self.distribution(half) / (4.0 * view.z * (1.0 + self.lambda(view)))
    }

    fn width(&self) -> f64 {
        self.alpha
    }
}

fn schlick_masking(cosine: f64, k: f64) -> f64 {
    cosine / (cosine * (1.0 - k) + k)
}

/// The Beckmann microfacet model with height-correlated Smith masking (Walter et al. 2007, with
/// Λ as its exact expression in the error function).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beckmann {
    /// The distribution's α, in (0, 1].
    pub alpha: f64,
}

impl Beckmann {
    fn distribution(&self, half: DVec3) -> f64 {
        let a2 = self.alpha * self.alpha;
        let cos2 = half.z * half.z;
        let tangent2 = (half.x * half.x + half.y * half.y) / cos2.max(f64::MIN_POSITIVE);
        (-tangent2 / a2).exp() / (PI * a2 * (cos2 * cos2).max(f64::MIN_POSITIVE))
    }

    fn lambda(&self, direction: DVec3) -> f64 {
        let tangent = (direction.x * direction.x + direction.y * direction.y).sqrt()
            / direction.z.abs().max(f64::MIN_POSITIVE);
        let a = 1.0 / (self.alpha * tangent).max(1e-12);
        0.5 * ((-a * a).exp() / (a * PI.sqrt()) - complementary_error_function(a))
    }
}

impl Brdf for Beckmann {
    fn evaluate(&self, view: DVec3, light: DVec3) -> f64 {
        if view.z <= 0.0 || light.z <= 0.0 {
            return 0.0;
        }
        let half = (view + light).normalize();
        let masking = 1.0 / (1.0 + self.lambda(view) + self.lambda(light));
        self.distribution(half) * masking / (4.0 * view.z * light.z)
    }

    fn sample(&self, view: DVec3, random: DVec2) -> DVec3 {
        let tangent = self.alpha * (-(1.0 - random.x).max(f64::MIN_POSITIVE).ln()).sqrt();
        let azimuth = 2.0 * PI * random.y;
        let half = DVec3::new(tangent * azimuth.cos(), tangent * azimuth.sin(), 1.0).normalize();
        2.0 * view.dot(half) * half - view
    }

    fn pdf(&self, view: DVec3, light: DVec3) -> f64 {
        let half = (view + light).normalize();
        let cosine = view.dot(half);
        if half.z <= 0.0 || cosine <= 0.0 {
            return 0.0;
        }
        self.distribution(half) * half.z / (4.0 * cosine)
    }

    fn width(&self) -> f64 {
        self.alpha
    }
}

/// erfc(x) for x ≥ 0 by its continued fraction above 2 and the Maclaurin series below; both are
/// summed to f64 precision.
fn complementary_error_function(x: f64) -> f64 {
    if x < 2.0 {
        let (mut term, mut sum, mut n) = (x, x, 0.0);
        while term.abs() > 1e-18 {
            n += 1.0;
            term *= -x * x / n;
            sum += term / (2.0 * n + 1.0);
        }
        1.0 - 2.0 / PI.sqrt() * sum
    } else {
        let mut fraction = 0.0;
        for k in (1..=60).rev() {
            fraction = 0.5 * f64::from(k) / (x + fraction);
        }
        (-x * x).exp() / (PI.sqrt() * (x + fraction))
    }
}

/// A perfectly diffuse surface, f = 1/π. Its exact lobe is the identity, which makes it a test of
/// the whole bake.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lambert;

impl Brdf for Lambert {
    fn evaluate(&self, view: DVec3, light: DVec3) -> f64 {
        if view.z <= 0.0 || light.z <= 0.0 { 0.0 } else { 1.0 / PI }
    }

    fn sample(&self, _view: DVec3, random: DVec2) -> DVec3 {
        let azimuth = 2.0 * PI * random.y;
        let radius = random.x.sqrt();
        DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), (1.0 - random.x).sqrt())
    }

    fn pdf(&self, _view: DVec3, light: DVec3) -> f64 {
        light.z.max(0.0) / PI
    }

    fn width(&self) -> f64 {
        1.0
    }
}

/// (1 − v·h)⁵, the factor that separates F90 from F0 in Schlick's approximation (Schlick 1994).
pub fn schlick(view: DVec3, light: DVec3) -> f64 {
    let half = (view + light).normalize_or(view);
    (1.0 - view.dot(half)).clamp(0.0, 1.0).powi(5)
}
