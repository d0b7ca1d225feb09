//! Sheen: the reflection of fibres that stand on the surface.

use core::f64::consts::PI;
use glam::{DVec2, DVec3};

use super::Brdf;

/// Sheen roughness below which [`Charlie::of_roughness`] does not change any more: α = 0.01. The
/// published shadowing is within 0.05 of Smith's own for an α of 0.15 or more; below about 0.06 it lets more
/// light out than came in at grazing views.
pub const SHEEN_ROUGHNESS_FLOOR: f64 = 0.1;

/// How the fibres of a sheen hide each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Visibility {
    /// 1 / ((1 + Λ(v) + Λ(l))·4·(n·v)·(n·l)) with Estevez and Kulla's fit of Smith's Λ for their
    /// distribution, without their softening of the terminator, which is not
    /// reciprocal.
    Smith,
    /// 1 / (4·(n·l + n·v − (n·l)·(n·v))) (Neubelt and Pettineo 2013). Smooth cloth then
    /// reflects more than it receives at grazing views; an albedo beyond 1 is cut to 1 when a table is fitted.
    Neubelt,
}

/// The sheen of Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF":
/// D(h) = (2 + 1/α)·sin^(1/α) θ / (2π), for a colour of 1. It is what glTF's material extension for
/// sheen describes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Charlie {
    /// The distribution's α, in (0, 1].
    pub alpha: f64,
    /// The shadowing and masking term.
    pub visibility: Visibility,
}

impl Charlie {
    /// Sheen of the given α with Smith's shadowing.
    pub fn new(alpha: f64) -> Self {
        Self { alpha, visibility: Visibility::Smith }
    }

    /// Sheen of a perceptual roughness in 0…1: α is its square, with [`SHEEN_ROUGHNESS_FLOOR`].
    pub fn of_roughness(roughness: f64) -> Self {
        Self::new(roughness.max(SHEEN_ROUGHNESS_FLOOR).powi(2))
    }

    fn distribution(&self, half: DVec3) -> f64 {
        let sine_squared = half.x * half.x + half.y * half.y;
        (2.0 + 1.0 / self.alpha) * sine_squared.powf(0.5 / self.alpha) / (2.0 * PI)
    }

    /// Smith's Λ by the published fit: the logarithm is a / (1 + b·x^c) + d·x + e up to 60°, and from
    /// there on the point reflection of itself.
    fn lambda(&self, cosine: f64) -> f64 {
        let keep = (1.0 - self.alpha) * (1.0 - self.alpha);
        let between = |smooth: f64, rough: f64| keep * smooth + (1.0 - keep) * rough;
        let a = between(25.3245, 21.5473);
        let b = between(3.32435, 3.82987);
        let c = between(0.16801, 0.19823);
        let d = between(-1.27393, -1.97760);
        let e = between(-4.85967, -4.32054);
        let logarithm = |x: f64| a / (1.0 + b * x.powf(c)) + d * x + e;
        if cosine < 0.5 {
            logarithm(cosine).exp()
        } else {
            (2.0 * logarithm(0.5) - logarithm(1.0 - cosine)).exp()
        }
    }

    /// Height within which the samples crowd: the half vector has to be within about √α of the
    /// surface, the light within twice that.
    fn crowding(&self) -> f64 {
        2.0 * self.alpha.sqrt()
    }
}

impl Brdf for Charlie {
    fn evaluate(&self, view: DVec3, light: DVec3) -> f64 {
        if view.z <= 0.0 || light.z <= 0.0 {
            return 0.0;
        }
        let half = (view + light).normalize();
        let visibility = match self.visibility {
            Visibility::Smith => {
                1.0 / (4.0 * view.z * light.z * (1.0 + self.lambda(view.z) + self.lambda(light.z)))
            }
            Visibility::Neubelt => 0.25 / (view.z + light.z - view.z * light.z),
        };
        self.distribution(half) * visibility
    }

    /// Samples heights z with the density b·(1 + b) / (z + b)², which crowds them towards the horizon
    /// as the distribution does, and azimuths uniformly.
    fn sample(&self, _view: DVec3, random: DVec2) -> DVec3 {
        let b = self.crowding();
        let z = b * random.x / (1.0 + b - random.x);
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let azimuth = 2.0 * PI * random.y;
        DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z)
    }

    fn pdf(&self, _view: DVec3, light: DVec3) -> f64 {
        if light.z < 0.0 {
            return 0.0;
        }
        let b = self.crowding();
        b * (1.0 + b) / (2.0 * PI * (light.z + b) * (light.z + b))
    }

    fn width(&self) -> f64 {
        1.0
    }
}
