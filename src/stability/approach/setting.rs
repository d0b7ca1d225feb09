//! A surface point and a light.

use glam::DVec3;

use crate::light::Light;

/// A surface point and a light, of which every coordinate is an f32: all methods see the same input, in whatever precision
/// they work.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The surface point.
    pub position: DVec3,
    /// Normal, of length 1 as far as f32 goes.
    pub normal: DVec3,
    /// Towards the eye, of length 1 as far as f32 goes.
    pub view: DVec3,
    /// Perceptual roughness, 0…1.
    pub roughness: f64,
    /// The light.
    pub light: Light,
}

/// The nearest f32.
pub(super) fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

fn single_vector(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}

impl Setting {
    /// The setting whose coordinates are the nearest ones.
    pub fn rounded(self) -> Self {
        let light = match self.light {
            Light::Polygon { points, two_sided } => {
                Light::Polygon { points: points.into_iter().map(single_vector).collect(), two_sided }
            }
            Light::Disk { center, half_x, half_y, two_sided } => Light::Disk {
                center: single_vector(center),
                half_x: single_vector(half_x),
                half_y: single_vector(half_y),
                two_sided,
            },
            Light::Sphere { center, radius } => {
                Light::Sphere { center: single_vector(center), radius: single(radius) }
            }
            Light::Tube { start, end, radius, caps } => Light::Tube {
                start: single_vector(start),
                end: single_vector(end),
                radius: single(radius),
                caps,
            },
        };
        Self {
            position: single_vector(self.position),
            normal: single_vector(self.normal),
            view: single_vector(self.view),
            roughness: single(self.roughness),
            light,
        }
    }

    /// Whether the light is flat and emits to both sides.
    pub fn is_two_sided(&self) -> bool {
        matches!(self.light, Light::Polygon { two_sided: true, .. } | Light::Disk { two_sided: true, .. })
    }

    /// The cosine between normal and view.
    pub fn cosine(&self) -> f64 {
        self.normal.normalize().dot(self.view.normalize())
    }

    /// The square of the roughness, at least that of the floor of the library.
    pub fn alpha(&self) -> f64 {
        self.roughness.clamp(crate::shade::LTC_ROUGHNESS_FLOOR, 1.0).powi(2)
    }
}
