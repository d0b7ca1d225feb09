//! From what a file says to a scene that can be drawn.

use glam::{DQuat, DVec3};

use super::file::{
    BoxEntry, CameraEntry, Colour, File, LightEntry, MaterialEntry, PlaneEntry, RoughnessEntry, SphereEntry,
};
use super::{Camera, Light, Material, Object, Roughness, Scene, SceneError, Shape};

/// Largest length: f32 squares it and still counts in parts of it.
const LARGEST_LENGTH: f64 = 1e6;

/// Largest radiance and exposure: their product is far from the end of f32.
const LARGEST_RADIANCE: f64 = 1e9;

/// Share of a light's size by which its vertices may leave one plane.
const FLATNESS: f64 = 1e-4;

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
    if entry.points.len() < 3 {
        return place
            .error(format!("points holds {} of them; a light needs three or more", entry.points.len()));
    }
    let points =
        entry.points.iter().map(|&point| place.position("a point", point)).collect::<Result<Vec<_>, _>>()?;
    let sides: Vec<DVec3> = points.iter().map(|&point| point - points[0]).collect();
    let size = sides.iter().map(|side| side.length()).fold(0.0, f64::max);
    let area: DVec3 = sides.windows(2).map(|pair| pair[0].cross(pair[1])).sum();
    if size < 1e-6 || area.length() < 1e-9 * size * size {
        return place.error("points cover no area; a light must be a polygon that is not flat as a line");
    }
    let normal = area.normalize();
    if sides.iter().any(|side| side.dot(normal).abs() > FLATNESS * size) {
        return place
            .error(format!("points are not in one plane; a light must be flat to {FLATNESS} of its size"));
    }
    if let Some((first, second)) = crossing(&points, normal) {
        return place.error(format!(
            "sides {} and {} cross; the outline of a light must not cross itself",
            first + 1,
            second + 1
        ));
    }
    let radiance = place.radiance("radiance", entry.radiance)?;
    Ok(Light { points, normal, radiance, two_sided: entry.two_sided })
}

/// Two sides of a flat polygon that cross each other in their inside.
fn crossing(points: &[DVec3], normal: DVec3) -> Option<(usize, usize)> {
    let count = points.len();
    let side = |index: usize| (points[index], points[(index + 1) % count]);
    let turn = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - a).dot(normal);
    let pairs = (0..count).flat_map(|first| (first + 1..count).map(move |second| (first, second)));
    pairs.into_iter().find(|&(first, second)| {
        let ((a, b), (c, d)) = (side(first), side(second));
        turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0
    })
}
