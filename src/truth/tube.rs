//! Cylinders and capsules as seen from the origin: where vertical half-planes cut them.

use glam::{DVec2, DVec3};

use super::outline::Crossing;
use super::{Brdf, Footprint, Segment, Truth, solid_angle};

/// Bound on the relative rounding of a boundary's direction, the ends' included.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Integrates `brdf` over a tube of the given `radius` around the segment from `start` to `end`, relative to the
/// surface point in its frame (normal +z). The tube emits outwards from its lateral surface; its inside is dark. It is
/// open at its ends, or with `caps` closed by hemispheres that emit outwards too.
///
/// What shines is the set of directions that enter the tube from outside through the part that emits, cut at the
/// horizon. A point inside the tube sees nothing; without `caps` nor does one inside the infinite cylinder, nor one
/// that sees a tube of no length. `view` and `tolerance` are as for [`polygon`](super::polygon).
pub fn tube(
    brdf: &dyn Brdf,
    view: DVec3,
    start: DVec3,
    end: DVec3,
    radius: f64,
    caps: bool,
    tolerance: f64,
) -> Truth {
    let dark = Truth { converged: true, ..Truth::default() };
    let extent = start.abs().max_element().max(end.abs().max_element());
    if !(extent > 0.0 && extent.is_finite() && radius > 0.0 && radius.is_finite()) {
        return dark;
    }
    // Solid angle knows no scale; a power of two rounds nothing.
    let scale = (-extent.log2().round().clamp(-1000.0, 1000.0)).exp2();
    match Tube::new(start * scale, end * scale, radius * scale, caps) {
        Some(tube) => solid_angle(brdf, view, &tube, tolerance),
        None => dark,
    }
}

/// A cylinder or capsule around a segment.
struct Tube {
    ends: [DVec3; 2],
    axis: DVec3,
    length: f64,
    radius: f64,
    caps: bool,
    /// Relative error of boundaries.
    error: f64,
}

impl Tube {
    fn new(start: DVec3, end: DVec3, radius: f64, caps: bool) -> Option<Self> {
        let side = end - start;
        let length = side.length();
        let axis = if length > 0.0 { side / length } else { DVec3::ZERO };
        let tube = Self {
            ends: [start, end],
            axis,
            length,
            radius,
            caps,
            error: ROUNDING * (1.0 + start.length().max(end.length()) / radius),
        };
        let inside = if caps {
            (start - axis * axis.dot(start).clamp(-length, 0.0)).length() <= radius
        } else {
            length == 0.0 || axis.cross(start).length() <= radius
        };
        (!inside).then_some(tube)
    }

    /// Whether the ray in the given direction enters through what emits.
    fn is_hit(&self, direction: DVec3) -> bool {
        let start = self.ends[0];
        let (across, squared) = (direction.cross(self.axis), self.radius * self.radius);
        let (a, moment) = (across.length_squared(), self.axis.dot(direction.cross(start)));
        let discriminant = a * squared - moment * moment;
        if self.length > 0.0 && discriminant > 0.0 {
            let b = across.dot(start.cross(self.axis));
            let c = start.cross(self.axis).length_squared() - squared;
            let entry = c / (b + discriminant.sqrt());
            let along = self.axis.dot(direction * entry - start);
            if c > 0.0 && b > 0.0 && along > 0.0 && along < self.length {
                return true;
            }
        }
        self.caps
            && self
                .ends
                .iter()
                .any(|&end| direction.dot(end) > 0.0 && direction.cross(end).length() < self.radius)
    }

    /// Two axes that span the plane across the axis.
    fn across(&self) -> [DVec3; 2] {
        let (x, y) = self.axis.any_orthonormal_pair();
        [x, y]
    }

    /// The points of both rims where the outline leaves them, in pairs along the outline's straight parts.
    fn contacts(&self) -> Vec<[DVec3; 2]> {
        let foot = self.ends[0] - self.axis * self.axis.dot(self.ends[0]);
        let distance = foot.length();
        if self.length <= 0.0 || distance <= self.radius {
            return Vec::new();
        }
        let sine = self.radius / distance;
        let (toward, aside) = (-foot / distance, self.axis.cross(foot) / distance);
        [-1.0, 1.0]
            .map(|sign| self.radius * (toward * sine + aside * (sign * (1.0 - sine * sine).sqrt())))
            .map(|offset| self.ends.map(|end| end + offset))
            .to_vec()
    }
}

/// Roots (x, y), x ≥ 0 < y or y = 0 < x, of αx² + 2βxy + γy² with the given β² − αγ.
fn roots(alpha: f64, beta: f64, gamma: f64, discriminant: f64) -> impl Iterator<Item = DVec2> {
    let k = -(beta + discriminant.max(0.0).sqrt().copysign(beta));
    let both = [DVec2::new(gamma, k), DVec2::new(k, alpha)];
    let upward = both.map(|root| if root.y < 0.0 { -root } else { root });
    upward.into_iter().filter(move |root| discriminant >= 0.0 && root.x >= 0.0 && root.length() > 0.0)
}

/// Angles φ at which α cos φ + β sin φ + γ vanishes.
fn zeros(alpha: f64, beta: f64, gamma: f64) -> Vec<f64> {
    let cosine = -gamma / alpha.hypot(beta);
    if cosine.abs() <= 1.0 {
        let (middle, half) = (beta.atan2(alpha), cosine.acos());
        vec![middle - half, middle + half]
    } else {
        Vec::new()
    }
}

impl Footprint for Tube {
    fn breaks(&self, breaks: &mut Vec<f64>) {
        let azimuth = |point: DVec3| point.y.atan2(point.x);
        for [a, b] in self.contacts() {
            breaks.extend([azimuth(a), azimuth(b)]);
            if (a.z > 0.0) != (b.z > 0.0) {
                breaks.push(azimuth(a + (b - a) * (a.z / (a.z - b.z))));
            }
        }
        for &end in &self.ends {
            breaks.push(azimuth(end));
            let r = self.radius;
            if self.caps {
                let horizontal = end.truncate().length();
                let reach = (1.0 - (r / end.length()).powi(2)).max(0.0).sqrt() * end.length();
                for half in [(r / horizontal).asin(), (reach / horizontal).acos()] {
                    if half.is_finite() {
                        breaks.extend([azimuth(end) - half, azimuth(end) + half]);
                    }
                }
            } else {
                let [x, y] = self.across();
                let moment = |v: DVec3, w: DVec3| v.truncate().perp_dot(w.truncate());
                let tangent = zeros(moment(end, y), -moment(end, x), r * moment(x, y));
                let horizon = zeros(r * x.z, r * y.z, end.z);
                for angle in tangent.into_iter().chain(horizon) {
                    breaks.push(azimuth(end + r * (x * angle.cos() + y * angle.sin())));
                }
            }
        }
    }

    fn cut(&self, azimuth: f64, _crossings: &mut Vec<Crossing>, segments: &mut Vec<Segment>) {
        segments.clear();
        let (sine, cosine) = azimuth.sin_cos();
        let (out, up) = (DVec3::new(cosine, sine, 0.0), DVec3::Z);
        let aside = out.cross(up);
        let r2 = self.radius * self.radius;
        let mut bounds = vec![DVec2::X, DVec2::Y];
        if self.length > 0.0 {
            // Rays that touch the infinite cylinder: r²|d × a|² = (a · d × start)².
            let (out_across, up_across) = (out.cross(self.axis), up.cross(self.axis));
            let x = self.axis.dot(out.cross(self.ends[0]));
            let y = self.axis.dot(up.cross(self.ends[0]));
            let turned = self.axis.dot(aside);
            let discriminant =
                r2 * ((out_across * y - up_across * x).length_squared() - r2 * turned * turned);
            bounds.extend(roots(
                r2 * out_across.length_squared() - x * x,
                r2 * out_across.dot(up_across) - x * y,
                r2 * up_across.length_squared() - y * y,
                discriminant,
            ));
        }
        for &end in &self.ends {
            let center = DVec2::new(end.dot(out), end.z);
            let aside = end.dot(aside);
            if self.caps {
                // Rays that touch the sphere: r²|d|² = |d × end|², which is aside² plus the part in the half-plane.
                let size = r2 - aside * aside;
                bounds.extend(roots(
                    size - center.y * center.y,
                    center.x * center.y,
                    size - center.x * center.x,
                    size * (center.length_squared() - size),
                ));
            } else {
                let normal = DVec2::new(self.axis.dot(out), self.axis.z);
                let slope = normal.length();
                if slope > 0.0 {
                    let normal = normal / slope;
                    // The rim's plane is across the axis, which leans out of the half-plane.
                    let offset = self.axis.dot(out.cross(up)) * aside / slope;
                    let half = (r2 - aside * aside - offset * offset).max(0.0).sqrt();
                    let foot = center + normal * offset;
                    let rim = [foot + normal.perp() * half, foot - normal.perp() * half];
                    bounds.extend(rim.into_iter().filter(|point| point.x > 0.0 && point.y > 0.0));
                }
            }
        }
        for bound in &mut bounds {
            *bound /= bound.length();
        }
        bounds.sort_unstable_by(|a, b| a.y.atan2(a.x).total_cmp(&b.y.atan2(b.x)));
        for pair in bounds.windows(2) {
            let (start, end) = (pair[0], pair[1]);
            let width = start.perp_dot(end).atan2(start.dot(end));
            let middle = start + end;
            if width > 0.0 && self.is_hit((out * middle.x + up * middle.y).normalize()) {
                segments.push(Segment { start, width, error: self.error * width });
            }
        }
    }
}
