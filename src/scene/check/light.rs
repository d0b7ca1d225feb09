//! Lights.

use glam::DVec3;

use super::Place;
use crate::light;
use crate::scene::file::{LightEntry, Pictures};
use crate::scene::{Light, SceneError};
use crate::texture::Prefiltered;

/// Share of a light's size by which its fourth point may miss the parallelogram of the others.
const SKEW: f64 = 1e-4;

pub(super) fn light(entry: &LightEntry, place: &Place, pictures: &Pictures) -> Result<Light, SceneError> {
    let fields = Fields { entry, place, shape: entry.shape.as_deref().unwrap_or("polygon") };
    let shape = fields.shape()?;
    shape.check().or_else(|error| place.error(error.to_string()))?;
    let normal = match &shape {
        light::Light::Polygon { points, .. } => {
            light::polygon_normal(points).or_else(|error| place.error(error.to_string()))?
        }
        light::Light::Disk { half_x, half_y, .. } => half_x.normalize().cross(half_y.normalize()).normalize(),
        _ => DVec3::ZERO,
    };
    let (_, size) = shape.bounds();
    if size < 1e-6 {
        return place.error(format!("the light is {size} large; it must measure 1e-6 or more"));
    }
    let picture = picture(entry, &shape, place, pictures)?;
    Ok(Light { shape, normal, radiance: place.radiance("radiance", entry.radiance)?, picture })
}

fn picture(
    entry: &LightEntry,
    shape: &light::Light,
    place: &Place,
    pictures: &Pictures,
) -> Result<Option<Prefiltered>, SceneError> {
    let (Some(name), light::Light::Polygon { points, .. }) = (&entry.picture, shape) else { return Ok(None) };
    let &[a, b, c, d] = &points[..] else {
        return place.error(format!(
            "points holds {} of them; a light with a picture needs four, from the picture's lower left corner on",
            points.len()
        ));
    };
    let (_, size) = shape.bounds();
    let fourth = a + c - b;
    if d.distance(fourth) > SKEW * size {
        return place.error(format!(
            "points are no parallelogram, which a light with a picture must be; the fourth point would be {:?}",
            fourth.to_array()
        ));
    }
    match pictures(name) {
        Ok(picture) => Ok(Some(picture)),
        Err(reason) => place.error(format!(
            "picture {name:?} could not be read ({reason}); name a PNG file, relative to the scene file"
        )),
    }
}

/// The fields of a light, of which each shape has its own.
struct Fields<'a> {
    entry: &'a LightEntry,
    place: &'a Place,
    shape: &'a str,
}

impl Fields<'_> {
    fn shape(&self) -> Result<light::Light, SceneError> {
        let entry = self.entry;
        let two_sided = entry.two_sided.unwrap_or(false);
        let shape = match self.shape {
            "polygon" => {
                self.only(&["points", "two_sided", "picture"])?;
                let points = self.needed("points", entry.points.as_ref())?;
                let points = points.iter().map(|&point| self.place.position("a point", point));
                light::Light::Polygon { points: points.collect::<Result<_, _>>()?, two_sided }
            }
            "disk" => {
                self.only(&["center", "half_x", "half_y", "two_sided"])?;
                light::Light::Disk {
                    center: self.position("center", entry.center)?,
                    half_x: self.position("half_x", entry.half_x)?,
                    half_y: self.position("half_y", entry.half_y)?,
                    two_sided,
                }
            }
            "sphere" => {
                self.only(&["center", "radius"])?;
                light::Light::Sphere {
                    center: self.position("center", entry.center)?,
                    radius: self.place.length("radius", self.needed("radius", entry.radius)?)?,
                }
            }
            "tube" => {
                self.only(&["start", "end", "radius", "caps"])?;
                light::Light::Tube {
                    start: self.position("start", entry.start)?,
                    end: self.position("end", entry.end)?,
                    radius: self.place.length("radius", self.needed("radius", entry.radius)?)?,
                    caps: entry.caps.unwrap_or(false),
                }
            }
            other => {
                return self.place.error(format!(
                    "shape is \"{other}\"; the known shapes are \"polygon\", \"disk\", \"sphere\" and \"tube\""
                ));
            }
        };
        Ok(shape)
    }

    fn needed<T>(&self, field: &str, value: Option<T>) -> Result<T, SceneError> {
        match value {
            Some(value) => Ok(value),
            None => self.place.error(format!("a {} needs the field {field}", self.shape)),
        }
    }

    fn position(&self, field: &str, value: Option<[f64; 3]>) -> Result<DVec3, SceneError> {
        self.place.position(field, self.needed(field, value)?)
    }

    /// Refuses fields that the shape does not have: whoever wrote them meant something by them.
    fn only(&self, fields: &[&str]) -> Result<(), SceneError> {
        let entry = self.entry;
        let given = [
            ("points", entry.points.is_some()),
            ("center", entry.center.is_some()),
            ("half_x", entry.half_x.is_some()),
            ("half_y", entry.half_y.is_some()),
            ("start", entry.start.is_some()),
            ("end", entry.end.is_some()),
            ("radius", entry.radius.is_some()),
            ("caps", entry.caps.is_some()),
            ("two_sided", entry.two_sided.is_some()),
            ("picture", entry.picture.is_some()),
        ];
        match given.iter().find(|(name, given)| *given && !fields.contains(name)) {
            Some((name, _)) => self.place.error(format!(
                "a {} has no field {name}; it has {}",
                self.shape,
                fields.join(", ")
            )),
            None => Ok(()),
        }
    }
}
