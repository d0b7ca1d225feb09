//! From what a file says to a scene that can be drawn.

use glam::{DQuat, DVec3};

use super::file::{
    BoxEntry, CameraEntry, Colour, File, LightEntry, MaterialEntry, PlaneEntry, RoughnessEntry, SphereEntry,
};
use crate::light;

use super::{Camera, Light, Material, Object, Roughness, Scene, SceneError, Shape};

/// Largest length: f32 squares it and still counts in parts of it.
const LARGEST_LENGTH: f64 = 1e6;

/// Largest radiance and exposure: their product is far from the end of f32.
const LARGEST_RADIANCE: f64 = 1e9;

impl File {
    /// The scene, if everything in it can be drawn.
    pub(super) fn check(&self, name: &str) -> Result<Scene, SceneError> {
        let place = |kind: &str, index: usize| Place(format!("{name}: {kind} {}", index + 1));
        let camera = camera(&self.camera, &Place(format!("{name}: camera")))?;
        let background = Place(name.to_owned()).radiance("background", self.background)?;
        let mut objects = Vec::new();
        for (index, entry) in self.planes.iter().enumerate() {
            objects.push(plane(entry, &place("plane", index))?);
        }
        for (index, entry) in self.boxes.iter().enumerate() {
            objects.push(cuboid(entry, &place("box", index))?);
        }
        for (index, entry) in self.spheres.iter().enumerate() {
            objects.push(sphere(entry, &place("sphere", index))?);
        }
        let lights =
            self.lights.iter().enumerate().map(|(index, entry)| light(entry, &place("light", index)));
        Ok(Scene { camera, background, objects, lights: lights.collect::<Result<_, _>>()? })
    }
}

/// The name of an entry, for errors.
struct Place(String);

impl Place {
    fn error<T>(&self, message: impl Into<String>) -> Result<T, SceneError> {
        Err(SceneError::new(&self.0, message))
    }

    fn position(&self, field: &str, value: [f64; 3]) -> Result<DVec3, SceneError> {
        if value.iter().all(|number| number.abs() <= LARGEST_LENGTH) {
            Ok(DVec3::from(value))
        } else {
            self.error(format!("{field} is {value:?}; each number must be finite and from -1e6 to 1e6"))
        }
    }

    fn direction(&self, field: &str, value: [f64; 3]) -> Result<DVec3, SceneError> {
        match self.position(field, value)?.try_normalize() {
            Some(direction) => Ok(direction),
            None => self.error(format!("{field} is {value:?}; a direction must not be zero")),
        }
    }

    fn length(&self, field: &str, value: f64) -> Result<f64, SceneError> {
        if (1e-6..=LARGEST_LENGTH).contains(&value) {
            Ok(value)
        } else {
            self.error(format!("{field} is {value}; it must be a length from 1e-6 to 1e6"))
        }
    }

    fn within(&self, field: &str, value: f64, low: f64, high: f64) -> Result<f64, SceneError> {
        if value >= low && value <= high {
            Ok(value)
        } else {
            self.error(format!("{field} is {value}; it must be a number from {low} to {high}"))
        }
    }

    fn reflectance(&self, field: &str, Colour(value): Colour) -> Result<DVec3, SceneError> {
        if value.to_array().iter().all(|number| (0.0..=1.0).contains(number)) {
            Ok(value)
        } else {
            self.error(format!("{field} is {:?}; a reflectance must be from 0 to 1", value.to_array()))
        }
    }

    fn radiance(&self, field: &str, Colour(value): Colour) -> Result<DVec3, SceneError> {
        if value.to_array().iter().all(|number| (0.0..=LARGEST_RADIANCE).contains(number)) {
            Ok(value)
        } else {
            self.error(format!("{field} is {:?}; a radiance must be from 0 to 1e9", value.to_array()))
        }
    }
}

fn camera(entry: &CameraEntry, place: &Place) -> Result<Camera, SceneError> {
    let position = place.position("position", entry.position)?;
    let target = place.position("target", entry.target)?;
    let up = place.direction("up", entry.up)?;
    let Some(forward) = (target - position).try_normalize() else {
        return place.error("target is the position itself; it must be another point, to look at");
    };
    let across = forward.cross(up);
    if across.length() < 1e-6 {
        return place.error("up runs along the line of sight; it must point to the side of it");
    }
    let right = across.normalize();
    let degrees = place.within("field_of_view", entry.field_of_view, 1e-3, 179.0)?;
    let exposure = place.within("exposure", entry.exposure, 0.0, LARGEST_RADIANCE)?;
    let up = right.cross(forward);
    Ok(Camera { position, forward, right, up, field_of_view: degrees.to_radians(), exposure })
}

fn plane(entry: &PlaneEntry, place: &Place) -> Result<Object, SceneError> {
    let point = place.position("point", entry.point)?;
    let normal = place.direction("normal", entry.normal)?;
    let first = match entry.along {
        Some(along) => {
            let along = place.direction("along", along)?;
            match (along - normal * along.dot(normal)).try_normalize() {
                Some(first) if first.dot(along) > 1e-6 => first,
                _ => return place.error("along runs along the normal; it must point along the plane"),
            }
        }
        None => normal.any_orthonormal_vector(),
    };
    let extent = match entry.extent {
        Some([width, height]) => {
            [place.length("extent's first number", width)?, place.length("extent's second number", height)?]
        }
        None => [f64::INFINITY; 2],
    };
    let shape = Shape::Plane { point, axes: [first, normal.cross(first), normal], extent };
    Ok(Object { shape, material: material(&entry.material, place)? })
}

fn cuboid(entry: &BoxEntry, place: &Place) -> Result<Object, SceneError> {
    let centre = place.position("centre", entry.centre)?;
    let [width, depth, height] = entry.half_size;
    let half_size = DVec3::new(
        place.length("half_size's first number", width)?,
        place.length("half_size's second number", depth)?,
        place.length("half_size's third number", height)?,
    );
    let turn = match &entry.rotation {
        Some(rotation) => {
            let axis = place.direction("rotation's axis", rotation.axis)?;
            let degrees = place.within("rotation's degrees", rotation.degrees, -1e6, 1e6)?;
            DQuat::from_axis_angle(axis, degrees.to_radians())
        }
        None => DQuat::IDENTITY,
    };
    let axes = DVec3::AXES.map(|axis| turn * axis);
    Ok(Object { shape: Shape::Box { centre, axes, half_size }, material: material(&entry.material, place)? })
}

fn sphere(entry: &SphereEntry, place: &Place) -> Result<Object, SceneError> {
    let centre = place.position("centre", entry.centre)?;
    let radius = place.length("radius", entry.radius)?;
    Ok(Object { shape: Shape::Sphere { centre, radius }, material: material(&entry.material, place)? })
}

fn material(entry: &MaterialEntry, place: &Place) -> Result<Material, SceneError> {
    let roughness = match entry.roughness {
        RoughnessEntry::Constant(value) => {
            let value = place.within("roughness", value, 0.0, 1.0)?;
            Roughness { from: value, to: value, start: DVec3::ZERO, gradient: DVec3::ZERO }
        }
        RoughnessEntry::Varying(varying) => {
            let from = place.within("roughness's from", varying.from, 0.0, 1.0)?;
            let to = place.within("roughness's to", varying.to, 0.0, 1.0)?;
            let start = place.position("roughness's start", varying.start)?;
            let way = place.position("roughness's end", varying.end)? - start;
            if way.length() < 1e-6 {
                return place.error("roughness's start and end are one point; they must be apart");
            }
            Roughness { from, to, start, gradient: way / way.length_squared() }
        }
    };
    Ok(Material {
        base_colour: place.reflectance("base_colour", entry.base_colour)?,
        f0: place.reflectance("f0", entry.f0)?,
        f90: place.reflectance("f90", entry.f90)?,
        roughness,
    })
}

fn light(entry: &LightEntry, place: &Place) -> Result<Light, SceneError> {
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
    Ok(Light { shape, normal, radiance: place.radiance("radiance", entry.radiance)? })
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
                self.only(&["points", "two_sided"])?;
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
