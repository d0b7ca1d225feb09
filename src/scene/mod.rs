//! Scenes: what a scene file holds, and the same picture of it through the include and in ground truth.
//!
//! A scene has a camera, planes, boxes and spheres of layered materials, and lights of every shape. Light falls
//! directly from each light on each surface: nothing casts a shadow, and surfaces do not light each other.

mod case;
mod check;
mod effects;
mod file;
mod image;
mod label;
mod layers;
mod picture;
mod ray;
mod truth;

pub use case::{Case, CaseError, LONGEST_LINE, Precision};
pub use file::{Pictures, SceneError};
pub use image::{Comparison, Image, ImageError, Panel, check_png_path, write_png};
pub use picture::{decode_picture, load_picture};
pub use ray::{Hit, sample_positions};
pub use truth::{Truth, render_truth};

use glam::DVec3;

use crate::texture::Prefiltered;

/// A scene whose numbers have been checked: directions are unit vectors, lengths are positive.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The eye.
    pub camera: Camera,
    /// Radiance seen where there is neither surface nor light.
    pub background: DVec3,
    /// Everything that reflects light.
    pub objects: Vec<Object>,
    /// Everything that emits light.
    pub lights: Vec<Light>,
    /// Whether specular parts make up for the light that one bounce between their facets loses.
    pub energy_compensation: bool,
}

impl Scene {
    /// How many lights may have a picture.
    pub const MOST_PICTURES: usize = 4;
}

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The pinhole.
    pub position: DVec3,
    /// Unit vector to the centre of the picture.
    pub forward: DVec3,
    /// Unit vector to the right of the picture.
    pub right: DVec3,
    /// Unit vector to the top of the picture.
    pub up: DVec3,
    /// Angle between the picture's lower and upper edge, in radians.
    pub field_of_view: f64,
    /// Factor on radiance before tone mapping.
    pub exposure: f64,
}

/// A surface with a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Object {
    /// Where the surface is.
    pub shape: Shape,
    /// How it reflects.
    pub material: Material,
}

/// The form of a surface. Planes are seen and lit from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A rectangle, or a whole plane where its extent is infinite.
    Plane {
        /// Its centre.
        point: DVec3,
        /// Unit vectors along its sides, then its normal.
        axes: [DVec3; 3],
        /// Half the length of its sides.
        extent: [f64; 2],
    },
    /// A box.
    Box {
        /// Its centre.
        centre: DVec3,
        /// Unit vectors along its edges, right-handed.
        axes: [DVec3; 3],
        /// Half the length of its edges.
        half_size: DVec3,
    },
    /// A sphere.
    Sphere {
        /// Its centre.
        centre: DVec3,
        /// Its radius.
        radius: f64,
    },
}

/// A diffuse part under a GGX part with Schlick's Fresnel reflectance, under a sheen, under a clear coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Reflectance of the diffuse part.
    pub base_colour: DVec3,
    /// Specular reflectance at normal incidence.
    pub f0: DVec3,
    /// Specular reflectance at grazing incidence.
    pub f90: DVec3,
    /// Perceptual roughness.
    pub roughness: Roughness,
    /// Roughness of the diffuse part, 0 for Lambert's law to 1.
    pub diffuse_roughness: f64,
    /// Share of the surface that a clear coat covers.
    pub coat: f64,
    /// Perceptual roughness of the coat.
    pub coat_roughness: f64,
    /// Reflectance of the coat at normal incidence.
    pub coat_reflectance: f64,
    /// Reflectance of the sheen; black where there is none.
    pub sheen_colour: DVec3,
    /// Perceptual roughness of the sheen.
    pub sheen_roughness: f64,
    /// Strength of the anisotropy, 0 to 1, as `ltc_anisotropic_alpha` takes it.
    pub anisotropy: f64,
    /// Direction, projected onto the surface, in which highlights are longest; zero where there is no anisotropy.
    pub grain: DVec3,
}

/// Perceptual roughness that runs linearly from one point to another and is constant beyond both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Value at `start`.
    pub from: f64,
    /// Value at `start` + `gradient` / `gradient`².
    pub to: f64,
    /// Where the change begins.
    pub start: DVec3,
    /// Change of the share of `to` per unit of length; zero for a roughness that is `from` everywhere.
    pub gradient: DVec3,
}

impl Roughness {
    /// Its value at a point.
    pub fn at(&self, point: DVec3) -> f64 {
        let share = (point - self.start).dot(self.gradient).clamp(0.0, 1.0);
        self.from + (self.to - self.from) * share
    }
}

/// An area light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// What it is and where.
    pub shape: crate::light::Light,
    /// Unit normal of the emitting side of a polygon or disk, whose other side is black unless it is two-sided;
    /// zero for any other light.
    pub normal: DVec3,
    /// What it emits in all directions; with a picture, where that is white.
    pub radiance: DVec3,
    /// What a parallelogram shows, from its first point, the lower left corner, on counter-clockwise.
    pub picture: Option<Prefiltered>,
}
