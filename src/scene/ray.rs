//! What a camera sees where, in f64.

use glam::DVec3;

use super::{Camera, Light, Scene, Shape};
use crate::light;

/// What a ray meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hit {
    /// Nothing.
    Background,
    /// The light of the given index: from the emitting side, or from the black back.
    Light(usize, bool),
    /// A surface.
    Surface {
        /// Index of the object.
        object: usize,
        /// Where.
        position: DVec3,
        /// Unit normal on the side of the viewer.
        normal: DVec3,
    },
}

/// Positions in a pixel, each number from 0 to 1, at which to sample it: the centre, then points that fill the
/// pixel evenly however many there are (Roberts 2018, the R2 sequence of the plastic number).
///
/// All pixels and both ways to draw share them, so that two pictures differ in their shading only.
pub fn sample_positions(count: u32) -> Vec<[f32; 2]> {
    let share = |index: u32, step: f64| ((0.5 + f64::from(index) * step) % 1.0) as f32;
    (0..count)
        .map(|index| [share(index, 0.754_877_666_246_692_8), share(index, 0.569_840_290_998_053_3)])
        .collect()
}

impl Camera {
    /// Unit direction through a point of a picture, both coordinates in pixels from the upper left corner.
    pub fn direction(&self, x: f64, y: f64, width: u32, height: u32) -> DVec3 {
        let [width, height] = [f64::from(width), f64::from(height)];
        let half = (0.5 * self.field_of_view).tan();
        let across = (2.0 * x / width - 1.0) * half * width / height;
        let upward = (1.0 - 2.0 * y / height) * half;
        (self.forward + self.right * across + self.up * upward).normalize()
    }
}

impl Scene {
    /// What the ray from `origin` in the unit direction `direction` meets first.
    pub fn trace(&self, origin: DVec3, direction: DVec3) -> Hit {
        let mut nearest = f64::INFINITY;
        let mut hit = Hit::Background;
        for (index, object) in self.objects.iter().enumerate() {
            if let Some((distance, position, normal)) = object.shape.meet(origin, direction)
                && distance < nearest
            {
                nearest = distance;
                let normal = if normal.dot(direction) > 0.0 { -normal } else { normal };
                hit = Hit::Surface { object: index, position, normal };
            }
        }
        for (index, light) in self.lights.iter().enumerate() {
            if let Some(distance) = light.meet(origin, direction)
                && distance < nearest
            {
                nearest = distance;
                hit = Hit::Light(index, light.emits_against(direction));
            }
        }
        hit
    }
}

impl Shape {
    /// Distance, place and outer normal of the first hit in front of `origin`.
    fn meet(&self, origin: DVec3, direction: DVec3) -> Option<(f64, DVec3, DVec3)> {
        match self {
            Self::Plane { point, axes, extent } => {
                let steepness = direction.dot(axes[2]);
                let distance = (*point - origin).dot(axes[2]) / steepness;
                if !(distance > 0.0 && distance.is_finite()) {
                    return None;
                }
                let offset = origin + direction * distance - *point;
                let (across, along) = (offset.dot(axes[0]), offset.dot(axes[1]));
                let inside = across.abs() <= extent[0] && along.abs() <= extent[1];
                inside.then(|| (distance, *point + axes[0] * across + axes[1] * along, axes[2]))
            }
            Self::Box { centre, axes, half_size } => {
                let into = |v: DVec3| DVec3::new(v.dot(axes[0]), v.dot(axes[1]), v.dot(axes[2]));
                let (start, way) = (into(origin - *centre), into(direction));
                let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
                let (mut enter_axis, mut leave_axis) = (0, 0);
                for axis in 0..3 {
                    let inverse = 1.0 / if way[axis].abs() < 1e-20 { 1e-20 } else { way[axis] };
                    let one = (-half_size[axis] - start[axis]) * inverse;
                    let other = (half_size[axis] - start[axis]) * inverse;
                    if one.min(other) > enter {
                        (enter, enter_axis) = (one.min(other), axis);
                    }
                    if one.max(other) < leave {
                        (leave, leave_axis) = (one.max(other), axis);
                    }
                }
                if enter > leave || leave <= 0.0 {
                    return None;
                }
                let (distance, axis) = if enter > 0.0 { (enter, enter_axis) } else { (leave, leave_axis) };
                let mut local = start + way * distance;
                let side = local[axis].signum();
                local[axis] = side * half_size[axis];
                let position = *centre + axes[0] * local.x + axes[1] * local.y + axes[2] * local.z;
                Some((distance, position, axes[axis] * side))
            }
            Self::Sphere { centre, radius } => {
                let offset = origin - *centre;
                let half = -offset.dot(direction);
                let aside = offset + direction * half;
                let depth_squared = radius * radius - aside.length_squared();
                if depth_squared < 0.0 {
                    return None;
                }
                let depth = depth_squared.sqrt();
                let distance = if half > depth { half - depth } else { half + depth };
                if distance <= 0.0 {
                    return None;
                }
                let normal = (offset + direction * distance).normalize();
                Some((distance, *centre + normal * *radius, normal))
            }
        }
    }
}

impl Light {
    /// What a ray that meets the light's emitting side sees.
    pub(super) fn seen(&self, origin: DVec3, direction: DVec3) -> DVec3 {
        self.meet(origin, direction)
            .map_or(DVec3::ZERO, |distance| self.emitted(origin + direction * distance))
    }

    /// Whether the side that a ray in the given direction meets emits.
    fn emits_against(&self, direction: DVec3) -> bool {
        match self.shape {
            light::Light::Polygon { two_sided, .. } | light::Light::Disk { two_sided, .. } => {
                two_sided || self.normal.dot(direction) < 0.0
            }
            _ => true,
        }
    }

    /// Distance to the first point of the light in front of `origin`.
    fn meet(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        match &self.shape {
            light::Light::Polygon { points, .. } => meet_polygon(points, self.normal, origin, direction),
            &light::Light::Disk { center, half_x, half_y, .. } => {
                let distance = meet_plane(center, self.normal, origin, direction)?;
                let place = origin + direction * distance - center;
                let area = half_x.cross(half_y).dot(self.normal);
                let x = place.cross(half_y).dot(self.normal) / area;
                let y = half_x.cross(place).dot(self.normal) / area;
                (x * x + y * y <= 1.0).then_some(distance)
            }
            &light::Light::Sphere { center, radius } => meet_sphere(center, radius, origin, direction),
            &light::Light::Tube { start, end, radius, caps } => {
                let lateral = meet_cylinder(start, end, radius, origin, direction);
                let ends = [start, end]
                    .map(|end| caps.then(|| meet_sphere(end, radius, origin, direction)).flatten());
                [lateral, ends[0], ends[1]].into_iter().flatten().min_by(f64::total_cmp)
            }
        }
    }
}

fn meet_plane(point: DVec3, normal: DVec3, origin: DVec3, direction: DVec3) -> Option<f64> {
    let distance = (point - origin).dot(normal) / direction.dot(normal);
    (distance > 0.0 && distance.is_finite()).then_some(distance)
}

/// The first point of a sphere that is seen from outside; from inside there is none.
fn meet_sphere(center: DVec3, radius: f64, origin: DVec3, direction: DVec3) -> Option<f64> {
    let half = (center - origin).dot(direction);
    let aside = origin + direction * half - center;
    let depth_squared = radius * radius - aside.length_squared();
    if depth_squared < 0.0 {
        return None;
    }
    let distance = half - depth_squared.sqrt();
    (distance > 0.0).then_some(distance)
}

/// The first point of an open cylinder that is seen from outside: its inside is not there.
fn meet_cylinder(start: DVec3, end: DVec3, radius: f64, origin: DVec3, direction: DVec3) -> Option<f64> {
    let axis = (end - start).try_normalize()?;
    let length = (end - start).length();
    let across = |v: DVec3| v - axis * v.dot(axis);
    let (offset, way) = (across(origin - start), across(direction));
    let (a, b, c) = (way.dot(way), offset.dot(way), offset.dot(offset) - radius * radius);
    let discriminant = b * b - a * c;
    if a == 0.0 || discriminant < 0.0 {
        return None;
    }
    let distance = (-b - discriminant.sqrt()) / a;
    let along = (origin + direction * distance - start).dot(axis);
    (distance > 0.0 && (0.0..=length).contains(&along)).then_some(distance)
}

fn meet_polygon(points: &[DVec3], normal: DVec3, origin: DVec3, direction: DVec3) -> Option<f64> {
    let distance = meet_plane(points[0], normal, origin, direction)?;
    let place = origin + direction * distance - points[0];
    let [first, second] = projection(normal);
    // A ray to one side within the plane crosses the outline of what surrounds it an odd number of times.
    let mut inside = false;
    for (index, &start) in points.iter().enumerate() {
        let a = start - points[0] - place;
        let b = points[(index + 1) % points.len()] - points[0] - place;
        if (a[second] > 0.0) != (b[second] > 0.0) {
            let across = a[first] + (b[first] - a[first]) * (a[second] / (a[second] - b[second]));
            inside ^= across > 0.0;
        }
    }
    inside.then_some(distance)
}

/// The two axes on which a polygon with the given normal has the largest shadow.
fn projection(normal: DVec3) -> [usize; 2] {
    let size = normal.abs();
    if size.x >= size.y && size.x >= size.z {
        [1, 2]
    } else if size.y >= size.z {
        [2, 0]
    } else {
        [0, 1]
    }
}
