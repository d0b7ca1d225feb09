//! An elliptical disk or a sphere as seen from the origin: where vertical half-planes cut it.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec2, DVec3};

use super::outline::Crossing;
use super::{Footprint, Segment};

/// Factor between successive break points near the azimuths where a disk begins and ends.
///
/// The width of a cut grows with the root of the distance from there: from 1 to 4 times the distance a 15-point
/// panel integrates a root to 1e-12.
const RIM_RATIO: f64 = 4.0;

/// Bound on the relative rounding of a point of the rim.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A planar ellipse, seen from the origin.
pub(super) struct Ellipse {
    center: DVec3,
    half_x: DVec3,
    half_y: DVec3,
}

impl Ellipse {
    /// The ellipse, or nothing if it covers no solid angle: no area, or a plane through the origin.
    pub(super) fn new(center: DVec3, half_x: DVec3, half_y: DVec3) -> Option<Self> {
        let extent = [center, half_x, half_y].iter().map(|v| v.abs().max_element()).fold(0.0, f64::max);
        if extent <= 0.0 || !extent.is_finite() {
            return None;
        }
        let scale = (-extent.log2().round().clamp(-1000.0, 1000.0)).exp2();
        let [center, half_x, half_y] = [center, half_x, half_y].map(|v| v * scale);
        (center.dot(half_x.cross(half_y)) != 0.0).then_some(Self { center, half_x, half_y })
    }

    /// The directions that a sphere hides from a point outside: those of a disk at its tangent circle.
    pub(super) fn of_sphere(center: DVec3, radius: f64) -> Option<Self> {
        let distance = center.length();
        let sine = radius / distance;
        let cosine = ((distance - radius) * (distance + radius)).sqrt() / distance;
        let toward = center / distance;
        let (tangent, bitangent) = toward.any_orthonormal_pair();
        Self::new(toward * cosine, tangent * sine, bitangent * sine)
    }

    /// Whether the origin is on the side that `half_x` × `half_y` points to.
    pub(super) fn faces_origin(&self) -> bool {
        self.center.dot(self.half_x.cross(self.half_y)) < 0.0
    }

    fn at(&self, point: DVec2) -> DVec3 {
        self.center + self.half_x * point.x + self.half_y * point.y
    }

    /// Both points where the plane with the given normal cuts the rim, in the semi-axes.
    fn chord(&self, normal: DVec3) -> Option<[DVec2; 2]> {
        let slope = DVec2::new(normal.dot(self.half_x), normal.dot(self.half_y));
        let steepness = slope.length();
        let height = normal.dot(self.center);
        let inside = (steepness - height) * (steepness + height);
        (inside > 0.0).then(|| {
            let toward = slope / steepness;
            let foot = -toward * (height / steepness);
            let along = toward.perp() * (inside.sqrt() / steepness);
            [foot - along, foot + along]
        })
    }
}

impl Footprint for Ellipse {
    fn breaks(&self, breaks: &mut Vec<f64>) {
        // Where the rim passes the horizon, cuts change their lower end.
        if let Some(points) = self.chord(DVec3::Z) {
            breaks.extend(points.map(|point| azimuth(self.at(point))));
        }
        // A vertical plane with the horizontal normal n touches the rim where (n·c)² = (n·x)² + (n·y)²; as a quadratic
        // form of n that is q. From the origin, the rim then begins or ends at a right angle to n.
        let [c, x, y] = [self.center, self.half_x, self.half_y].map(DVec3::truncate);
        let q = [x.x * x.x + y.x * y.x - c.x * c.x, x.y * x.y + y.y * y.y - c.y * c.y];
        let mixed = x.x * x.y + y.x * y.y - c.x * c.y;
        // With n at the angle t the form is mean + swing·cos(2t − phase).
        let (mean, difference) = (0.5 * (q[0] + q[1]), 0.5 * (q[0] - q[1]));
        let (swing, phase) = (difference.hypot(mixed), mixed.atan2(difference));
        // The azimuth of least width, where a rim that all but touches the axis changes fast.
        let narrowest = 0.5 * (phase + std::f64::consts::PI) - FRAC_PI_2;
        let opening = (-mean / swing).clamp(-1.0, 1.0).acos();
        for sign in [-1.0, 1.0] {
            for turn in [0.0, FRAC_PI_2, 2.0 * FRAC_PI_2, 3.0 * FRAC_PI_2] {
                breaks.push(narrowest + turn);
            }
            let tangent = 0.5 * (phase + sign * opening) - FRAC_PI_2;
            for limit in [tangent, tangent + 0.5 * TAU] {
                breaks.push(limit);
                let mut distance = 1e-9;
                while distance < 1.0 {
                    breaks.extend([limit - distance, limit + distance]);
                    distance *= RIM_RATIO;
                }
            }
        }
    }

    fn cut(&self, azimuth: f64, _: &mut Vec<Crossing>, segments: &mut Vec<Segment>) {
        segments.clear();
        let (sine, cosine) = azimuth.sin_cos();
        let Some(points) = self.chord(DVec3::new(-sine, cosine, 0.0)) else {
            return;
        };
        // Both ends of the chord in the vertical plane: distance along the azimuth, and height.
        let [a, b] = points.map(|point| {
            let point = self.at(point);
            DVec2::new(point.x * cosine + point.y * sine, point.z)
        });
        let error = ROUNDING * (1.0 / a.length() + 1.0 / b.length());
        let half_plane = |(a, b): (DVec2, DVec2), height: fn(DVec2) -> f64| {
            let (before, after) = (height(a), height(b));
            let meet = || a + (b - a) * (before / (before - after));
            match (before > 0.0, after > 0.0) {
                (true, true) => Some((a, b)),
                (true, false) => Some((a, meet())),
                (false, true) => Some((meet(), b)),
                (false, false) => None,
            }
        };
        let Some((a, b)) = half_plane((a, b), |p| p.x).and_then(|ends| half_plane(ends, |p| p.y)) else {
            return;
        };
        let turn = a.perp_dot(b);
        let (start, width) = (if turn > 0.0 { a } else { b }, turn.abs().atan2(a.dot(b)));
        let length = start.length();
        if width > 0.0 && length > 0.0 {
            segments.push(Segment { start: (start / length).max(DVec2::ZERO), width, error });
        }
    }
}

fn azimuth(point: DVec3) -> f64 {
    point.y.atan2(point.x)
}

/// Every direction: what a sphere hides from a point in it.
pub(super) struct Everything;

impl Footprint for Everything {
    fn breaks(&self, breaks: &mut Vec<f64>) {
        breaks.extend([0.0, 0.25 * TAU, 0.5 * TAU, 0.75 * TAU]);
    }

    fn cut(&self, _: f64, _: &mut Vec<Crossing>, segments: &mut Vec<Segment>) {
        segments.clear();
        segments.push(Segment { start: DVec2::X, width: FRAC_PI_2, error: 0.0 });
    }
}
