//! Rough diffuse surfaces.

use core::f64::consts::PI;
use glam::{DVec2, DVec3};

use super::Brdf;

/// Which paths of light an [`Eon`] counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scattering {
    /// Those that meet the surface once: Fujii's variant of Oren and Nayar's model.
    Single,
    /// Those that meet it more often.
    Multiple,
    /// All.
    All,
}

/// The energy-preserving variant of Oren and Nayar's diffuse model by Portsmouth, Kutz and Hill
/// 2025, "EON: A practical energy-preserving rough diffuse BRDF".
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eon {
    /// The model's own roughness r in 0…1, at which its formulas take it; 0 is Lambert's surface.
    pub roughness: f64,
    /// The colour ρ in one channel, 0…1.
    pub colour: f64,
    /// What light it counts.
    pub scattering: Scattering,
}

impl Eon {
    /// The white surface with all its light: its albedo is 1 from everywhere.
    pub fn new(roughness: f64) -> Self {
        Self { roughness, colour: 1.0, scattering: Scattering::All }
    }

    /// The white surface's light that met it once.
    pub fn single(roughness: f64) -> Self {
        Self { scattering: Scattering::Single, ..Self::new(roughness) }
    }

    /// Scale of the single-scattering lobe, 1 / (1 + (1/2 − 2/(3π))·r), with which Fujii
    /// keeps its albedo at or below 1.
    fn scale(&self) -> f64 {
        1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * self.roughness)
    }

    /// Directional albedo of the white surface's single scattering: the integral of the lobe against
    /// the cosine in closed form.
    pub fn single_albedo(&self, cosine: f64) -> f64 {
        let cosine = cosine.clamp(0.0, 1.0);
        let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
        // tan θ·(1 − sin³ θ) without its division by zero.
        let rest = sine * cosine * (1.0 + sine + sine * sine) / (1.0 + sine);
        let bump = sine * (cosine.acos() - sine * cosine - 2.0 / 3.0) + 2.0 / 3.0 * rest;
        self.scale() * (1.0 + self.roughness * bump / PI)
    }

    /// The cosine-weighted mean of [`Eon::single_albedo`] over the hemisphere.
    pub fn mean_albedo(&self) -> f64 {
        self.scale() * (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * PI)) * self.roughness)
    }

    /// Colour of the light that met the surface more than once: the geometric series of its bounces.
    pub fn multiple_colour(&self) -> f64 {
        let mean = self.mean_albedo();
        self.colour * self.colour * mean / (1.0 - self.colour * (1.0 - mean))
    }

    /// The density of samples in height z is 2·(1 − w)·z + b·min(1, z / c) with c the view's height: what
    /// the cosine leaves of Lambert's part, and of the part that piles up towards the eye. Returns c, w
    /// and b.
    fn heights(&self, view: DVec3) -> (f64, f64, f64) {
        let c = view.z.clamp(1e-9, 1.0);
        let w = 0.5 * self.roughness * ((1.0 - c) * (1.0 + c)).sqrt();
        (c, w, w / (1.0 - 0.5 * c))
    }
}

impl Brdf for Eon {
    fn evaluate(&self, view: DVec3, light: DVec3) -> f64 {
        if view.z <= 0.0 || light.z <= 0.0 {
            return 0.0;
        }
        let single = || {
            let s = view.x * light.x + view.y * light.y;
            let ratio = if s > 0.0 { s / view.z.max(light.z) } else { s };
            self.colour / PI * self.scale() * (1.0 + self.roughness * ratio)
        };
        let multiple = || {
            let lost = |cosine: f64| (1.0 - self.single_albedo(cosine)).max(0.0);
            let mean_lost = (1.0 - self.mean_albedo()).max(f64::MIN_POSITIVE);
            self.multiple_colour() / PI * lost(view.z) * lost(light.z) / mean_lost
        };
        match self.scattering {
            Scattering::Single => single(),
            Scattering::Multiple => multiple(),
            Scattering::All => single() + multiple(),
        }
    }

    /// Heights in proportion to the light's mean over azimuth, azimuths uniformly.
    fn sample(&self, view: DVec3, random: DVec2) -> DVec3 {
        let (c, w, b) = self.heights(view);
        let low = (1.0 - w) + 0.5 * b / c;
        let z = if random.x < low * c * c {
            (random.x / low).sqrt()
        } else {
            // The root of (1 − w)·z² + b·(z − c / 2) = random.x.
            let known = random.x + 0.5 * b * c;
            2.0 * known / (b + (b * b + 4.0 * (1.0 - w) * known).sqrt()).max(f64::MIN_POSITIVE)
        };
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let azimuth = 2.0 * PI * random.y;
        DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z)
    }

    fn pdf(&self, view: DVec3, light: DVec3) -> f64 {
        if light.z < 0.0 {
            return 0.0;
        }
        let (c, w, b) = self.heights(view);
        (2.0 * (1.0 - w) * light.z + b * (light.z / c).min(1.0)) / (2.0 * PI)
    }

    fn width(&self) -> f64 {
        1.0
    }
}
