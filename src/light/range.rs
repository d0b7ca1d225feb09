//! How far a light reaches.

use core::f64::consts::{PI, TAU};

use glam::DVec3;

use super::Light;

impl Light {
    /// Centre and radius of a sphere around the light.
    pub fn bounds(&self) -> (DVec3, f64) {
        match *self {
            Self::Polygon { ref points, .. } => {
                let low = points.iter().fold(DVec3::INFINITY, |low, point| low.min(*point));
                let high = points.iter().fold(DVec3::NEG_INFINITY, |high, point| high.max(*point));
                let center = 0.5 * low + 0.5 * high;
                (center, points.iter().map(|point| point.distance(center)).fold(0.0, f64::max))
            }
            // |x cos t + y sin t|² ≤ |x|² + |y|²; exact for a circle is the larger singular value.
            Self::Disk { center, half_x, half_y, .. } => {
                let (xx, yy, xy) = (half_x.dot(half_x), half_y.dot(half_y), half_x.dot(half_y));
                let largest = 0.5 * (xx + yy) + (0.25 * (xx - yy).powi(2) + xy * xy).sqrt();
                (center, largest.sqrt())
            }
            Self::Sphere { center, radius } => (center, radius),
            Self::Tube { start, end, radius, caps } => {
                let half = 0.5 * start.distance(end);
                (0.5 * start + 0.5 * end, if caps { half + radius } else { half.hypot(radius) })
            }
        }
    }

    /// The largest area that the light shows to any point.
    pub fn largest_projected_area(&self) -> f64 {
        match *self {
            Self::Polygon { ref points, .. } => {
                let sides: Vec<DVec3> = points.iter().map(|&point| point - points[0]).collect();
                sides.windows(2).map(|pair| 0.5 * pair[0].cross(pair[1])).sum::<DVec3>().length()
            }
            Self::Disk { half_x, half_y, .. } => PI * half_x.cross(half_y).length(),
            Self::Sphere { radius, .. } => PI * radius * radius,
            // The silhouette of a capsule; an open tube's is smaller.
            Self::Tube { start, end, radius, .. } => {
                2.0 * radius * start.distance(end) + PI * radius * radius
            }
        }
    }

    /// The distance from the centre of [`Light::bounds`] beyond which a surface reflects less than `threshold` of
    /// the light: the radius to cull it by, for clustered renderers.
    ///
    /// `radiance` is the largest component of what the light emits; `peak` bounds the surface's BRDF times the
    /// cosine, per steradian: base colour / π for a diffuse surface, [`Table::peak`](crate::table::Table::peak) for a
    /// glossy one, their sum for both. A mirror's peak is huge, and so is the range: a mirror does show distant lights.
    ///
    /// Conservative: reflected radiance is at most radiance · peak · solid angle, and the light's solid angle is at most
    /// its area over the square of the distance to the bounding sphere. 0 if nothing anywhere reflects as much, that is
    /// if `threshold` is at least `radiance`; infinite if `threshold` is not positive, if any of the numbers is
    /// none, and for a light of a negative radius, which [`Light::check`] refuses.
    pub fn range(&self, radiance: f64, threshold: f64, peak: f64) -> f64 {
        // No surface reflects more than it receives.
        if threshold >= radiance || peak <= 0.0 {
            return 0.0;
        }
        let solid_angle = threshold / (radiance * peak);
        let ((_, radius), area) = (self.bounds(), self.largest_projected_area());
        // What is not a number, and a light of a negative radius, bounds nothing.
        let bounds = solid_angle > 0.0 && radius >= 0.0 && area >= 0.0;
        if !bounds {
            return f64::INFINITY;
        }
        let by_area = radius + (area / solid_angle).sqrt();
        // A cap of the solid angle 2π (1 − cos), seen from outside the bounding sphere.
        let cosine = 1.0 - solid_angle / TAU;
        let by_sphere = if cosine > 0.0 { radius / ((1.0 - cosine) * (1.0 + cosine)).sqrt() } else { radius };
        by_area.min(by_sphere)
    }
}
