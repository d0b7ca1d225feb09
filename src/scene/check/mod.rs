//! From what a file says to a scene that can be drawn.

use glam::{DQuat, DVec3};

use super::file::{BoxEntry, CameraEntry, Colour, File, Pictures, PlaneEntry, SphereEntry};
use super::{Camera, Light, Object, Scene, SceneError, Shape};
use light::light;
use material::material;

mod light;
mod material;

/// Largest length: f32 squares it and still counts in parts of it.
const LARGEST_LENGTH: f64 = 1e6;

/// Largest radiance and exposure: their product is far from the end of f32.
const LARGEST_RADIANCE: f64 = 1e9;

impl File {
    /// The scene, if everything in it can be drawn. Its pictures are those of `pictures`.
    pub(super) fn check(&self, name: &str, pictures: &Pictures) -> Result<Scene, SceneError> {
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
        let mut lights: Vec<Light> = Vec::new();
        for (index, entry) in self.lights.iter().enumerate() {
            let place = place("light", index);
            lights.push(light(entry, &place, pictures)?);
            if lights.iter().filter(|light| light.picture.is_some()).count() > Scene::MOST_PICTURES {
                return place.error(format!(
                    "the scene has more than {} lights with a picture; leave out the others' pictures",
                    Scene::MOST_PICTURES
                ));
            }
        }
        Ok(Scene { camera, background, objects, lights, energy_compensation: self.energy_compensation })
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
    let material = material(&entry.material, place)?;
    if material.anisotropy > 0.0 && material.grain.cross(normal).length() < 1e-3 {
        return place.error("grain runs along the normal; it must be a direction along the plane");
    }
    Ok(Object { shape, material })
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
