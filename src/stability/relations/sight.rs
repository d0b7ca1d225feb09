//! A flat light as it lies before the surface point: what errors and the effect of rounding follow.

use glam::{DVec3, Vec3};

use crate::stability::Case;

/// An outline seen from the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Distance of the outline's nearest point.
    pub nearest: f64,
    /// Distance of its farthest vertex.
    pub farthest: f64,
    /// Distance of the light, its inside included.
    pub distance: f64,
    /// Distance of the light's plane.
    pub height: f64,
    /// Whether the foot of the perpendicular lies in the light.
    pub is_inside: bool,
    /// Whether it lies in the light's convex hull.
    pub is_surrounded: bool,
    /// Whether the light's plane is a coordinate plane, moved: its distance has no rounding.
    pub is_level: bool,
    /// Largest ratio of the distance of an edge's farther end to that of the edge.
    pub ratio: f64,
    /// Longest chord from the first vertex over the farthest distance.
    pub size: f64,
    /// Area over the square of the farthest distance.
    pub area: f64,
    /// How far a vertex leaves the plane of the others.
    pub bend: f64,
}

impl Sight {
    /// None of outlines without area.
    pub fn of(points: &[DVec3]) -> Option<Self> {
        let first = *points.first()?;
        let fan = points.windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first));
        let area: DVec3 = fan.sum::<DVec3>() * 0.5;
        let normal = area.try_normalize()?;
        let edges = || points.iter().zip(points.iter().cycle().skip(1));
        let farthest = points.iter().map(|point| point.length()).fold(0.0, f64::max);
        let longest = points.iter().map(|point| (*point - first).length()).fold(0.0, f64::max);
        let nearest = edges().map(|(a, b)| from_segment(*a, *b)).fold(f64::INFINITY, f64::min);
        let ratios = edges().map(|(a, b)| a.length().max(b.length()) / from_segment(*a, *b));
        let height = normal.dot(first).abs();
        let is_inside = holds_foot(points, normal);
        let level = |of: fn(&DVec3) -> f64| points.iter().all(|point| of(point) == of(&first));
        Some(Self {
            nearest,
            farthest,
            distance: if is_inside { height } else { nearest },
            height,
            is_inside,
            is_surrounded: is_inside || surround_foot(points, normal),
            is_level: level(|v| v.x) || level(|v| v.y) || level(|v| v.z),
            ratio: ratios.fold(1.0, f64::max),
            size: longest / farthest,
            area: area.length() / (farthest * farthest),
            bend: points.iter().map(|point| (*point - first).dot(normal).abs()).fold(0.0, f64::max),
        })
    }
}

/// Distance of the origin from a segment.
pub fn from_segment(a: DVec3, b: DVec3) -> f64 {
    let side = b - a;
    let t = (-a.dot(side) / side.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (a + side * t).length()
}

/// Points in a plane of that normal.
fn flattened(points: &[DVec3], normal: DVec3) -> Vec<[f64; 2]> {
    let (x, y) = normal.any_orthonormal_pair();
    points.iter().map(|point| [point.dot(x), point.dot(y)]).collect()
}

/// Whether no half-plane at the origin's foot on the plane holds all points.
fn surround_foot(points: &[DVec3], normal: DVec3) -> bool {
    let mut angles: Vec<f64> = flattened(points, normal).iter().map(|[x, y]| y.atan2(*x)).collect();
    angles.sort_by(f64::total_cmp);
    let around = angles.first().map(|first| first + core::f64::consts::TAU);
    let gaps = angles.iter().zip(angles.iter().skip(1).copied().chain(around)).map(|(a, b)| b - a);
    gaps.fold(0.0, f64::max) < core::f64::consts::PI
}

/// Whether the origin's foot on the plane lies inside, by the number of edges that a ray crosses.
fn holds_foot(points: &[DVec3], normal: DVec3) -> bool {
    let flat = flattened(points, normal);
    let edges = flat.iter().zip(flat.iter().cycle().skip(1));
    let crosses = |&(a, b): &(&[f64; 2], &[f64; 2])| {
        (a[1] > 0.0) != (b[1] > 0.0) && a[0] + (b[0] - a[0]) * (-a[1] / (b[1] - a[1])) > 0.0
    };
    edges.filter(crosses).count() % 2 == 1
}

/// Whether a vector has one component only: a frame of it has no rounding.
pub fn is_along_an_axis(v: Vec3) -> bool {
    v.to_array().iter().filter(|number| **number != 0.0).count() == 1
}

/// Half a unit in the last place of the largest coordinate, along all three axes: how far rounding may have moved a point.
pub fn rounding(v: Vec3) -> f64 {
    let largest = f64::from(v.abs().max_element());
    largest * f64::from(f32::EPSILON) * 0.5 * 1.7321 + f64::from(f32::MIN_POSITIVE)
}

/// The most that rounding may have moved a vertex of a flat light.
pub fn coordinate_rounding(case: &Case) -> f64 {
    case.shape.vertices().iter().map(|vertex| rounding(*vertex)).fold(0.0, f64::max)
}
