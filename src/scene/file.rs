//! The scene file.

use std::path::Path;

use glam::DVec3;
use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor, value::MapAccessDeserializer};

use super::Scene;
use super::picture::read_picture;
use crate::input;
use crate::texture::Prefiltered;

/// Bytes of the largest scene file.
const LARGEST_FILE: usize = 16 << 20;

/// Where a scene's pictures come from: the picture of a name, or the reason why there is none.
pub type Pictures<'a> = dyn Fn(&str) -> Result<Prefiltered, String> + 'a;

/// Why a file is no scene: one sentence that says where, what is wrong and what would be right.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {message}")]
pub struct SceneError {
    place: String,
    message: String,
}

impl SceneError {
    pub(super) fn new(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self { place: place.into(), message: message.into() }
    }
}

impl Scene {
    /// Reads a scene file.
    ///
    /// # Errors
    ///
    /// If the file cannot be read or is no scene.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        match input::read_text(path, LARGEST_FILE) {
            Ok(text) => {
                let folder = path.parent().unwrap_or(Path::new(""));
                Self::parse_with(&text, &name, &|picture| read_picture(&folder.join(picture)))
            }
            Err(error) => Err(SceneError::new(
                name,
                format!("the scene file could not be read ({error}); name a file in TOML"),
            )),
        }
    }

    /// Reads the text of a scene file; errors call it `name`. Names of pictures are relative to the current folder.
    ///
    /// # Errors
    ///
    /// If the text is no scene.
    pub fn parse(text: &str, name: &str) -> Result<Self, SceneError> {
        Self::parse_with(text, name, &|picture| read_picture(Path::new(picture)))
    }

    /// The same with pictures from elsewhere: `pictures` gives that of a name, or the reason why there is none.
    ///
    /// # Errors
    ///
    /// If the text is no scene.
    pub fn parse_with(text: &str, name: &str, pictures: &Pictures) -> Result<Self, SceneError> {
        let file: File = toml::from_str(text).map_err(|error| {
            let message = error.message().lines().collect::<Vec<_>>().join(", ");
            let place = match error.span() {
                Some(span) => format!("{name}, line {}", 1 + text[..span.start].matches('\n').count()),
                None => name.to_owned(),
            };
            SceneError::new(place, message)
        })?;
        file.check(name, pictures)
    }
}

/// A scene file as written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    pub camera: CameraEntry,
    #[serde(default)]
    pub background: Colour,
    #[serde(default)]
    pub energy_compensation: bool,
    #[serde(default, rename = "plane")]
    pub planes: Vec<PlaneEntry>,
    #[serde(default, rename = "box")]
    pub boxes: Vec<BoxEntry>,
    #[serde(default, rename = "sphere")]
    pub spheres: Vec<SphereEntry>,
    #[serde(default, rename = "light")]
    pub lights: Vec<LightEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraEntry {
    pub position: [f64; 3],
    pub target: [f64; 3],
    #[serde(default = "z_axis")]
    pub up: [f64; 3],
    /// Vertical, in degrees.
    pub field_of_view: f64,
    #[serde(default = "one")]
    pub exposure: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaneEntry {
    pub point: [f64; 3],
    pub normal: [f64; 3],
    /// Half the length of the sides.
    pub extent: Option<[f64; 2]>,
    /// Direction of the first side.
    pub along: Option<[f64; 3]>,
    pub material: MaterialEntry,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BoxEntry {
    pub centre: [f64; 3],
    pub half_size: [f64; 3],
    pub rotation: Option<RotationEntry>,
    pub material: MaterialEntry,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RotationEntry {
    pub axis: [f64; 3],
    pub degrees: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereEntry {
    pub centre: [f64; 3],
    pub radius: f64,
    pub material: MaterialEntry,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialEntry {
    pub roughness: RoughnessEntry,
    #[serde(default)]
    pub base_colour: Colour,
    #[serde(default = "dielectric")]
    pub f0: Colour,
    #[serde(default = "white")]
    pub f90: Colour,
    #[serde(default)]
    pub diffuse_roughness: f64,
    #[serde(default)]
    pub coat: f64,
    #[serde(default = "tenth")]
    pub coat_roughness: f64,
    #[serde(default = "dielectric_reflectance")]
    pub coat_reflectance: f64,
    #[serde(default)]
    pub sheen_colour: Colour,
    #[serde(default = "half")]
    pub sheen_roughness: f64,
    #[serde(default)]
    pub anisotropy: f64,
    pub grain: Option<[f64; 3]>,
}

/// Which fields a light has depends on its shape, a polygon without one.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightEntry {
    pub shape: Option<String>,
    pub points: Option<Vec<[f64; 3]>>,
    #[serde(alias = "centre")]
    pub center: Option<[f64; 3]>,
    pub half_x: Option<[f64; 3]>,
    pub half_y: Option<[f64; 3]>,
    pub start: Option<[f64; 3]>,
    pub end: Option<[f64; 3]>,
    pub radius: Option<f64>,
    pub caps: Option<bool>,
    pub two_sided: Option<bool>,
    pub picture: Option<String>,
    pub radiance: Colour,
}

fn one() -> f64 {
    1.0
}

fn z_axis() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

fn half() -> f64 {
    0.5
}

fn tenth() -> f64 {
    0.1
}

/// Reflectance at normal incidence for a refractive index of 1.5, which is about that of plastic, paint and glass.
fn dielectric_reflectance() -> f64 {
    0.04
}

fn dielectric() -> Colour {
    Colour(DVec3::splat(dielectric_reflectance()))
}

fn white() -> Colour {
    Colour(DVec3::ONE)
}

/// Three numbers, or one for all three.
#[derive(Clone, Copy, Default)]
pub(super) struct Colour(pub DVec3);

impl<'de> Deserialize<'de> for Colour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Numbers;
        impl<'de> Visitor<'de> for Numbers {
            type Value = Colour;

            fn expecting(&self, formatter: &mut core::fmt::Formatter) -> core::fmt::Result {
                formatter.write_str("one number or three, [red, green, blue]")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Colour, E> {
                Ok(Colour(DVec3::splat(value)))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Colour, E> {
                Ok(Colour(DVec3::splat(value as f64)))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Colour, A::Error> {
                let mut numbers = Vec::new();
                while let Some(number) = sequence.next_element::<f64>()? {
                    numbers.push(number);
                }
                match numbers[..] {
                    [red, green, blue] => Ok(Colour(DVec3::new(red, green, blue))),
                    _ => Err(Error::invalid_length(numbers.len(), &self)),
                }
            }
        }
        deserializer.deserialize_any(Numbers)
    }
}

/// One roughness, or two and where each holds.
#[derive(Clone, Copy)]
pub(super) enum RoughnessEntry {
    Constant(f64),
    Varying(VaryingEntry),
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct VaryingEntry {
    pub from: f64,
    pub to: f64,
    pub start: [f64; 3],
    pub end: [f64; 3],
}

impl<'de> Deserialize<'de> for RoughnessEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = RoughnessEntry;

            fn expecting(&self, formatter: &mut core::fmt::Formatter) -> core::fmt::Result {
                formatter.write_str("a number from 0 to 1 or { from, to, start, end }")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<RoughnessEntry, E> {
                Ok(RoughnessEntry::Constant(value))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<RoughnessEntry, E> {
                Ok(RoughnessEntry::Constant(value as f64))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RoughnessEntry, A::Error> {
                VaryingEntry::deserialize(MapAccessDeserializer::new(map)).map(RoughnessEntry::Varying)
            }
        }
        deserializer.deserialize_any(Either)
    }
}
