//! What a light calls for.

use super::{Light, is_convex_quad};
use crate::effects::{Effect, Effects};

impl Light {
    /// The least set of effects that shades this light on a diffuse surface.
    ///
    /// ```
    /// use glam::DVec3;
    /// use softbox::light::Light;
    ///
    /// let tube = Light::Tube { start: DVec3::ZERO, end: DVec3::X, radius: 0.1, caps: true };
    /// assert_eq!(tube.effects().to_string(), "tube+caps");
    /// ```
    pub fn effects(&self) -> Effects {
        let (shape, option) = match self {
            Self::Polygon { points, two_sided } => {
                let quad = points.len() == 3 || is_convex_quad(points);
                (if quad { Effect::Quad } else { Effect::Polygon }, two_sided.then_some(Effect::TwoSided))
            }
            Self::Disk { two_sided, .. } => (Effect::Disk, two_sided.then_some(Effect::TwoSided)),
            Self::Sphere { .. } => (Effect::Sphere, None),
            Self::Tube { caps, .. } => (Effect::Tube, caps.then_some(Effect::Caps)),
        };
        let effects: Vec<Effect> = option.into_iter().chain([shape]).collect();
        Effects::of(&effects).expect("an option comes with a shape that has it")
    }
}
