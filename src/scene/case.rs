//! Single cases: a surface point and a light, as a line of JSON.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use serde::Deserialize;
use serde_json::Value;

use crate::light::{Light, LightError};
use crate::texture::Prefiltered;

/// The shapes that a case may name.
const SHAPES: [&str; 4] = ["polygon", "disk", "sphere", "tube"];

/// Bytes of the longest line.
pub const LONGEST_LINE: usize = 16 << 20;

/// Share of a light's longer diagonal by which its fourth point may miss the parallelogram of the others.
const SKEW: f64 = 1e-4;

/// What a case's numbers must fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// f32.
    Single,
    /// f64.
    Double,
}

impl Precision {
    fn name(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::Double => "double",
        }
    }
}

/// A surface point and a light.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The point.
    pub position: DVec3,
    /// Normal of the surface, of any length but zero.
    pub normal: DVec3,
    /// Towards the eye, of any length but zero.
    pub view: DVec3,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f64,
    /// The light, which may cover no area.
    pub light: Light,
    /// What a parallelogram shows, from its first point, the lower left corner, on counter-clockwise.
    pub picture: Option<Arc<Prefiltered>>,
}

/// Why a line is no case: one sentence.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct CaseError(String);

#[derive(Deserialize)]
struct RawCase {
    surface: RawSurface,
    light: Value,
}

#[derive(Deserialize)]
struct RawSurface {
    position: [f64; 3],
    normal: [f64; 3],
    view: [f64; 3],
    roughness: f64,
}

fn refuse<T>(message: impl Into<String>) -> Result<T, CaseError> {
    Err(CaseError(message.into()))
}

impl Case {
    /// Reads a line of JSON, `{"surface": …, "light": …}`. `pictures` gives the picture of a name, or says in a sentence why
    /// there is none.
    ///
    /// # Errors
    ///
    /// If the line is no case, or holds a number that is not finite in that precision.
    pub fn parse(
        line: &[u8],
        precision: Precision,
        pictures: &mut dyn FnMut(&str) -> Result<Arc<Prefiltered>, String>,
    ) -> Result<Self, CaseError> {
        let value = json(line)?;
        for (name, part) in
            [("a case", Some(&value)), ("surface", value.get("surface")), ("light", value.get("light"))]
        {
            if !part.is_none_or(Value::is_object) {
                return refuse(format!("not a case: {name} must be an object in braces"));
            }
        }
        let RawCase { surface, light } = serde_path_to_error::deserialize(&value).map_err(|error| {
            CaseError(format!("not a case: {error}").replace("expected f64", "expected a number"))
        })?;
        let shape = match light.get("shape") {
            Some(Value::String(shape)) if SHAPES.contains(&shape.as_str()) => shape,
            Some(shape) => {
                return refuse(format!("the light's shape is {shape}, but the known shapes are {SHAPES:?}"));
            }
            None => {
                return refuse(format!("the light has no field `shape`; the known shapes are {SHAPES:?}"));
            }
        };
        let picture = match light.get("picture") {
            None => None,
            Some(Value::String(name)) => Some(pictures(name).map_err(CaseError)?),
            Some(name) => {
                return refuse(format!("the light's picture is {name}, but must be the name of a PNG file"));
            }
        };
        let light =
            Light::deserialize(&light).map_err(|error| CaseError(format!("not a {shape} light: {error}")))?;
        match light.check() {
            // It emits nothing, and the include says so.
            Err(LightError::NoArea) => {}
            checked => checked.map_err(|error| CaseError(format!("the {shape}'s {error}")))?,
        }
        if picture.is_some() && !is_parallelogram(&light) {
            return refuse(
                "the light has a picture, but only a polygon that is a parallelogram can show one",
            );
        }
        let roughness = surface.roughness;
        if !(0.0..=1.0).contains(&roughness) {
            return refuse(format!("roughness is {roughness}, but must be from 0 to 1"));
        }
        Ok(Self {
            position: vector("position", surface.position, precision)?,
            normal: direction("normal", surface.normal, precision)?,
            view: direction("view", surface.view, precision)?,
            roughness,
            light,
            picture,
        })
    }
}

fn json(line: &[u8]) -> Result<Value, CaseError> {
    let Ok(text) = core::str::from_utf8(line) else { return refuse("the line is not UTF-8 text") };
    let text = text.trim_start_matches('\u{feff}').trim_end();
    serde_json::from_str(text).map_err(|error| {
        let rest = text.get(error.column().saturating_sub(1)..).unwrap_or_default();
        let rest = rest.trim_start_matches('-');
        if error.to_string().contains("out of range") || rest.starts_with("NaN") || rest.starts_with("Inf") {
            CaseError(format!("the number at column {} is not finite", error.column()))
        } else {
            let reason = error.to_string();
            let reason = reason.split(" at line ").next().unwrap_or_default();
            CaseError(format!("the line is not JSON: {reason} at column {}", error.column()))
        }
    })
}

fn is_parallelogram(light: &Light) -> bool {
    let Light::Polygon { points, .. } = light else { return false };
    let &[a, b, c, d] = &points[..] else { return false };
    (a + c - b - d).length() <= SKEW * (c - a).length().max((d - b).length())
}

fn vector(name: &str, v: [f64; 3], precision: Precision) -> Result<DVec3, CaseError> {
    let v = DVec3::from(v);
    if v.is_finite() && (precision == Precision::Double || v.as_vec3().is_finite()) {
        Ok(v)
    } else {
        refuse(format!("{name} is not finite in {} precision", precision.name()))
    }
}

fn direction(name: &str, v: [f64; 3], precision: Precision) -> Result<DVec3, CaseError> {
    let v = vector(name, v, precision)?;
    if v == DVec3::ZERO || (precision == Precision::Single && v.as_vec3() == Vec3::ZERO) {
        return refuse(format!("{name} is zero, but a direction needs a length"));
    }
    Ok(v)
}
