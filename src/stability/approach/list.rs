//! The approaches.

use super::curve::Method;
use super::make::{self, Variation};
use super::setting::Setting;
use crate::effects::Quality;
use crate::light::Light;

/// Which part of a value an approach looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The form factor.
    Diffuse,
    /// What the lobe reflects for F = 1.
    Specular,
}

/// What an error is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The difference; a light that fills the lobe is 1 or a little less.
    Absolute,
    /// The difference over the value.
    Relative,
    /// The difference over the form factor of the light: what a mirror would show of it.
    OfLight,
}

/// A way to a hard place: a surface and a light that depend on one number.
#[derive(Clone, Copy, Debug)]
pub struct Approach {
    /// Its name in tables and files.
    pub name: &'static str,
    /// What happens, in a few words.
    pub title: &'static str,
    /// What the number is.
    pub parameter: &'static str,
    /// From where to where it runs.
    pub range: [f64; 2],
    /// Whether the hard place is at the upper end of the range.
    pub rises: bool,
    /// What is measured.
    pub part: Part,
    /// In which measure.
    pub measure: Measure,
    bound: fn(&Setting, f64) -> f64,
    make: fn(f64, &Variation) -> Setting,
}

impl PartialEq for Approach {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Approach {
    /// The setting at a parameter, one of many that differ in what does not matter.
    pub fn setting(&self, parameter: f64, variant: usize) -> Setting {
        (self.make)(parameter, &Variation(variant)).rounded()
    }

    /// The largest error that this library may make of a setting at a parameter. The fast level keeps fewer digits where edges
    /// pass by closely and where lights are small, and has a lobe that is not quite round along the normal.
    pub fn bound(&self, method: Method, setting: &Setting, parameter: f64) -> f64 {
        let bound = (self.bound)(setting, parameter);
        if method != Method::Level(Quality::Fast) {
            return bound;
        }
        match self.name {
            "gap" | "gap-glossy" | "edge-line" | "edge-on" => bound + (3e-7 / parameter).min(1.0),
            "distance" | "distance-glossy" | "lobe-horizon" => bound + 1e-6 / parameter,
            "view-normal" => bound + 1e-3,
            _ => bound,
        }
    }
}

fn contact_bound(_: &Setting, _: f64) -> f64 {
    2e-6
}

fn relative_bound(_: &Setting, _: f64) -> f64 {
    1e-4
}

/// Rounding moves a light by so much in the space of a lobe that is α wide, and 1 / cos θ times as much seen at a grazing angle.
fn specular_bound(setting: &Setting, _: f64) -> f64 {
    (4e-6 / (setting.alpha() * setting.cosine().max(1e-9))).min(1.0)
}

fn specular_contact_bound(setting: &Setting, gap: f64) -> f64 {
    (specular_bound(setting, gap) + 1e-10 / gap).min(1.0)
}

/// `ltc_sphere`: the outline moves with the rounding of the distance. Below 4e-7 radii that leaves it open on which side of it the
/// point is.
fn sphere_bound(setting: &Setting, gap: f64) -> f64 {
    let Light::Sphere { radius, .. } = setting.light else { panic!("{setting:?} has no sphere") };
    (1e-7 / (gap / radius).sqrt()).max(1e-6)
}

/// `ltc_quad_lobe`: a small light is not cut at a lobe's own horizon.
fn lobe_horizon_bound(_: &Setting, _: f64) -> f64 {
    2e-2
}

const NEAR: [f64; 2] = [1e-8, 1.0];

impl Approach {
    const fn new(
        name: &'static str,
        title: &'static str,
        parameter: &'static str,
        make: fn(f64, &Variation) -> Setting,
    ) -> Self {
        Self {
            name,
            title,
            parameter,
            range: NEAR,
            rises: false,
            part: Part::Diffuse,
            measure: Measure::Absolute,
            bound: contact_bound,
            make,
        }
    }

    const fn within(self, low: f64, high: f64) -> Self {
        Self { range: [low, high], ..self }
    }

    const fn rising(self, low: f64, high: f64) -> Self {
        Self { range: [low, high], rises: true, ..self }
    }

    const fn specular(self) -> Self {
        Self { part: Part::Specular, bound: specular_bound, ..self }
    }

    const fn relative(self) -> Self {
        Self { measure: Measure::Relative, bound: relative_bound, ..self }
    }

    const fn of_light(self) -> Self {
        Self { measure: Measure::OfLight, bound: lobe_horizon_bound, ..self }
    }

    const fn bounded(self, bound: fn(&Setting, f64) -> f64) -> Self {
        Self { bound, ..self }
    }
}

/// Every approach, in the order in which they are shown.
pub fn approaches() -> Vec<Approach> {
    let approach = Approach::new;
    vec![
        approach("gap", "A quad stands on the floor", "gap", make::gap),
        approach("gap-glossy", "The same, in a glossy floor", "gap", make::gap_glossy)
            .specular()
            .bounded(specular_contact_bound),
        approach("head-on", "The point touches the light's face", "gap", make::ceiling),
        approach("vertex", "The point touches a vertex", "gap", make::vertex),
        approach("edge-line", "On the line of an edge", "gap", make::edge_line),
        approach("distance", "A light far away", "size / distance", make::distance)
            .relative()
            .within(1e-6, 10.0),
        approach("distance-glossy", "The same, in a glossy floor", "size / distance", make::distance_glossy)
            .specular()
            .relative()
            .within(1e-6, 1.0),
        approach("lobe-horizon", "Far away, on the lobe's horizon", "size / distance", make::lobe_horizon)
            .specular()
            .of_light()
            .within(1e-5, 1.0),
        approach("rising", "Just its edge above the horizon", "height", make::rising),
        approach("lifted", "Lower edge just above the horizon", "height", make::lifted),
        approach("sunk", "Lower edge just below the horizon", "depth", make::sunk),
        approach("edge-on", "Seen edge-on", "angle", make::edge_on),
        approach("view-normal", "Seen along the normal", "angle to the normal", make::view_normal).specular(),
        approach("grazing", "Seen at grazing angles", "cosine to the normal", make::grazing)
            .specular()
            .within(1e-8, 0.5),
        approach("roughness", "Towards a mirror", "roughness", make::glossy).specular().within(1e-4, 1.0),
        approach("texel", "Across a texel of the table", "beyond its centre", make::texel)
            .specular()
            .within(1e-8, 0.9),
        approach("thin", "A thinner and thinner light", "aspect ratio", make::thin).rising(1.0, 1e6),
        approach("offset", "Far from the origin", "offset / distance", make::offset).rising(1.0, 1e6),
        approach("scale", "Any unit of length", "scale", make::scaled).rising(1e-12, 1e12),
        approach("disk-axis", "On the axis of a disk", "offset", make::disk_axis),
        approach("disk-large", "A disk as wide as the sky", "radius / distance", make::disk_large)
            .rising(1.0, 1e6),
        approach("disk-small", "A small disk", "radius / distance", make::disk_small)
            .relative()
            .within(1e-5, 1.0),
        approach("sphere-contact", "A sphere touches the point", "gap", make::sphere_contact)
            .within(1e-6, 1.0)
            .bounded(sphere_bound),
        approach("tube-short", "A tube of no length", "length / distance", make::tube_short).relative(),
        approach("tube-end-on", "A tube that points at the point", "gap", make::tube_end_on),
    ]
}
