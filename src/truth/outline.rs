//! A planar polygon as seen from the origin: where vertical half-planes cut it.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3};

use super::{Footprint, Segment};

/// Factor between successive break points near an edge that passes close to the vertical axis.
///
/// A 15-point panel resolves the arc tangent of such an edge over about this stretch.
const APPROACH_RATIO: f64 = 8.0;

/// Bound on the relative rounding of a crossing, its vertices' included.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A simple planar polygon, convex or not, seen from the origin.
pub(super) struct Outline {
    edges: Vec<Edge>,
    /// Area vector of the polygon, towards the side from which its vertices run counter-clockwise.
    normal: DVec3,
    /// `normal` times any point of the plane; negative if the origin is on the emitting side.
    offset: f64,
}

/// A directed edge with what every cut needs of it.
struct Edge {
    start: DVec3,
    end: DVec3,
    /// `end` − `start`.
    along: DVec3,
    /// Vertical component of `start` × `end`: on which side the edge passes the vertical axis, and how closely.
    moment: f64,
    /// Height at which the edge's line passes the axis closest.
    foot: f64,
    /// Horizontal vector whose product with a horizontal vector along the line is the rise along it.
    slope: DVec2,
    /// Distance of the nearer end from the origin.
    near: f64,
}

impl Outline {
    /// The polygon through `points`, or nothing if it covers no solid angle: fewer than three points, no area, or a
    /// plane through the origin.
    pub(super) fn new(points: &[DVec3]) -> Option<Self> {
        let extent = points.iter().map(|point| point.abs().max_element()).fold(0.0, f64::max);
        if points.len() < 3 || extent <= 0.0 || !extent.is_finite() {
            return None;
        }
        // Solid angle knows no scale. A power of two brings products into range without rounding; the limits keep
        // the factor itself in range.
        let scale = (-extent.log2().round().clamp(-1000.0, 1000.0)).exp2();
        let points: Vec<DVec3> = points.iter().map(|&point| point * scale).collect();
        let anchor = points
            .iter()
            .copied()
            .min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
            .unwrap_or_default();
        let mut normal = DVec3::ZERO;
        let mut edges = Vec::with_capacity(points.len());
        for (&start, &end) in points.iter().zip(points.iter().cycle().skip(1)) {
            normal += (start - anchor).cross(end - anchor);
            edges.push(Edge::new(start, end));
        }
        let offset = normal.dot(anchor);
        (offset != 0.0).then_some(Self { edges, normal, offset })
    }

    /// Whether the origin is on the side that the polygon emits to.
    pub(super) fn faces_origin(&self) -> bool {
        self.offset < 0.0
    }
}

/// A point where a vertical half-plane cuts the outline.
#[derive(Clone, Copy)]
pub(super) struct Crossing {
    /// Distance from the vertical axis, and height.
    point: DVec2,
    /// Error of the point's elevation that rounded vertices cause, in radians.
    error: f64,
}

/// The stretch between two crossings, `lower` being further from the zenith, as far as it is above the horizon.
fn segment(lower: Crossing, upper: Crossing) -> Option<Segment> {
    if upper.point.y <= 0.0 {
        return None;
    }
    let (mut start, end) = (lower.point, upper.point);
    let mut error = lower.error + upper.error;
    if start.y < 0.0 {
        let x = start.x + (end.x - start.x) * (start.y / (start.y - end.y));
        start = DVec2::new(x.max(0.0), 0.0);
        // The horizon is where it is, wherever the lower end was.
        error = upper.error;
    }
    let width = start.perp_dot(end).atan2(start.dot(end));
    let length = start.length();
    (width > 0.0 && length > 0.0).then(|| Segment { start: start / length, width, error })
}

impl Edge {
    fn new(start: DVec3, end: DVec3) -> Self {
        let along = end - start;
        // The end that is nearer to the axis has the smaller rounding error.
        let near =
            if start.truncate().length_squared() < end.truncate().length_squared() { start } else { end };
        let horizontal = along.truncate();
        let slope = if horizontal == DVec2::ZERO {
            DVec2::ZERO
        } else {
            horizontal / horizontal.length() * (along.z / horizontal.length())
        };
        Self {
            start,
            end,
            along,
            moment: near.truncate().perp_dot(horizontal),
            foot: near.z - near.truncate().dot(slope),
            slope,
            near: start.length().min(end.length()),
        }
    }

    /// Where the half-plane in the horizontal `direction` cuts the edge, if it does.
    fn cut(&self, direction: DVec2) -> Option<Crossing> {
        let before = direction.perp_dot(self.start.truncate());
        let after = direction.perp_dot(self.end.truncate());
        if (before > 0.0) == (after > 0.0) {
            return None;
        }
        let change = direction.perp_dot(self.along.truncate());
        // Rounding may turn the sign of an almost radial edge; the two sides have the sign that counted above.
        let change = if change * (after - before) > 0.0 { change } else { after - before };
        // The distance from the axis is (start × end)/change, without cancellation. Its sign decides the parity of
        // the crossings, hence it must depend on the azimuth only through `change`.
        let distance = self.moment / change;
        if distance.is_nan() || distance <= 0.0 {
            return None;
        }
        // Measured from where the line passes the axis, heights vary smoothly with the azimuth; measured from an end,
        // they would carry the rounding noise of that end even close to the origin.
        let height = (self.foot + distance * direction.dot(self.slope))
            .clamp(self.start.z.min(self.end.z), self.start.z.max(self.end.z));
        let point = DVec2::new(distance, height);
        Some(Crossing { point, error: ROUNDING * (1.0 + self.near / point.length()) })
    }

    /// Azimuths at which cuts of this edge are not smooth, or change fast.
    fn breaks(&self, breaks: &mut Vec<f64>) {
        breaks.push(azimuth(self.start));
        if (self.start.z > 0.0) != (self.end.z > 0.0) {
            breaks.push(azimuth(self.start + self.along * (self.start.z / (self.start.z - self.end.z))));
        }
        let along = self.along.truncate();
        let closest = self.moment.abs();
        // An edge that passes close to the axis turns through almost a half circle within a short stretch, and runs
        // on at almost constant azimuth. The azimuth of its ends differs from that limit by `gap`.
        for (vertex, outward) in [(self.end, along), (self.start, -along)] {
            let gap = closest / vertex.truncate().dot(outward);
            if !(gap > 0.0 && gap < 0.02) {
                continue;
            }
            let limit = outward.y.atan2(outward.x);
            let inward = -(self.moment * outward.dot(along)).signum();
            let mut distance = gap.max(1e-9) * APPROACH_RATIO;
            while distance < 1.0 {
                breaks.push(limit + inward * distance);
                distance *= APPROACH_RATIO;
            }
        }
    }
}

fn azimuth(point: DVec3) -> f64 {
    point.y.atan2(point.x)
}

impl Footprint for Outline {
    fn breaks(&self, breaks: &mut Vec<f64>) {
        for edge in &self.edges {
            edge.breaks(breaks);
        }
    }

    fn cut(&self, azimuth: f64, crossings: &mut Vec<Crossing>, segments: &mut Vec<Segment>) {
        crossings.clear();
        segments.clear();
        let (sine, cosine) = azimuth.sin_cos();
        let direction = DVec2::new(cosine, sine);
        crossings.extend(self.edges.iter().filter_map(|edge| edge.cut(direction)));
        // Inside a polygon that the vertical axis pierces, the cut begins on the axis.
        if crossings.len() % 2 == 1 && self.normal.z != 0.0 {
            crossings.push(Crossing { point: DVec2::new(0.0, self.offset / self.normal.z), error: 0.0 });
        }
        // The half-plane meets the polygon's plane in a line that does not pass through the origin, so that elevation
        // is monotone along it; `line` is the direction in which it rises.
        let line = self.offset.signum() * DVec2::new(-self.normal.z, self.normal.truncate().dot(direction));
        crossings.sort_unstable_by(|a, b| a.point.dot(line).total_cmp(&b.point.dot(line)));
        segments.extend(crossings.chunks_exact(2).filter_map(|pair| segment(pair[0], pair[1])));
    }
}

/// Elevation of a cut's point above the horizon, −π/2…π/2.
pub(super) fn elevation(point: DVec2) -> f64 {
    point.y.atan2(point.x).clamp(-FRAC_PI_2, FRAC_PI_2)
}

/// `angle` brought into −π…π.
pub(super) fn wrap(angle: f64) -> f64 {
    angle - 2.0 * PI * (angle / (2.0 * PI)).round()
}
