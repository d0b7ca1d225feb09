//! Lights whose radiance depends on the direction that they are seen in.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::outline::{Crossing, Outline, elevation};
use super::{Footprint, Segment, Truth, solid_angle};
use crate::brdf::{Brdf, Lambert};

/// [`polygon`](super::polygon) for a light whose radiance in a direction is that number which `emission` returns for
/// the unit vector to it; each colour is a number of its own.
///
/// The adaptive integration finds out by itself how `emission` varies, but not where it jumps: `lines` are the
/// segments, anywhere on the light, across which it does. With all of them the result is as precise as without a
/// texture. `tolerance` is relative to the result, which for an emission of both signs may be small.
pub fn textured_polygon(
    brdf: &dyn Brdf,
    view: DVec3,
    points: &[DVec3],
    two_sided: bool,
    tolerance: f64,
    emission: &(dyn Fn(DVec3) -> f64 + Sync),
    lines: &[[DVec3; 2]],
) -> Truth {
    let dark = Truth { converged: true, ..Truth::default() };
    if points.iter().all(|point| point.z <= 0.0) {
        return dark;
    }
    let Some(outline) = Outline::new(points).filter(|outline| two_sided || outline.faces_origin()) else {
        return dark;
    };
    let footprint = Ruled { outline: &outline, lines };
    // Emission is a factor of the integrand, and so is the reflectance; the diffuse integrand is that of Lambert's.
    let specular = solid_angle(&Lit { brdf, emission }, view, &footprint, tolerance);
    let diffuse = solid_angle(&Lit { brdf: &Lambert, emission }, DVec3::Z, &footprint, tolerance);
    let mut truth = Truth {
        diffuse: diffuse.specular,
        evaluations: specular.evaluations + diffuse.evaluations,
        converged: specular.converged && diffuse.converged,
        ..specular
    };
    truth.error.diffuse = diffuse.error.specular;
    truth
}

/// A reflectance times the light that comes from each direction.
struct Lit<'a> {
    brdf: &'a dyn Brdf,
    emission: &'a (dyn Fn(DVec3) -> f64 + Sync),
}

impl Brdf for Lit<'_> {
    fn evaluate(&self, view: DVec3, light: DVec3) -> f64 {
        self.brdf.evaluate(view, light) * (self.emission)(light)
    }

    fn sample(&self, view: DVec3, random: DVec2) -> DVec3 {
        self.brdf.sample(view, random)
    }

    fn pdf(&self, view: DVec3, light: DVec3) -> f64 {
        self.brdf.pdf(view, light)
    }

    fn width(&self) -> f64 {
        self.brdf.width()
    }
}

/// An outline whose cuts end at lines too.
struct Ruled<'a> {
    outline: &'a Outline,
    lines: &'a [[DVec3; 2]],
}

impl Footprint for Ruled<'_> {
    fn breaks(&self, breaks: &mut Vec<f64>) {
        self.outline.breaks(breaks);
        for [start, end] in self.lines {
            breaks.extend([start, end].map(|point| point.y.atan2(point.x)));
            if (start.z > 0.0) != (end.z > 0.0) {
                let crossing = *start + (*end - *start) * (start.z / (start.z - end.z));
                breaks.push(crossing.y.atan2(crossing.x));
            }
        }
        // Where two lines cross, the order of cuts changes; a grid's lines cross at each other's ends or within.
        for (index, a) in self.lines.iter().enumerate() {
            for b in &self.lines[index + 1..] {
                if let Some(point) = meeting(a, b) {
                    breaks.push(point.y.atan2(point.x));
                }
            }
        }
    }

    fn cut(&self, azimuth: f64, crossings: &mut Vec<Crossing>, segments: &mut Vec<Segment>) {
        self.outline.cut(azimuth, crossings, segments);
        let (sine, cosine) = azimuth.sin_cos();
        let direction = DVec2::new(cosine, sine);
        let mut elevations: Vec<f64> = self
            .lines
            .iter()
            .filter_map(|[start, end]| {
                let (before, after) =
                    (direction.perp_dot(start.truncate()), direction.perp_dot(end.truncate()));
                let point = *start + (*end - *start) * (before / (before - after));
                let distance = point.truncate().dot(direction);
                ((before > 0.0) != (after > 0.0) && distance > 0.0)
                    .then(|| elevation(DVec2::new(distance, point.z)))
            })
            .collect();
        elevations.sort_unstable_by(f64::total_cmp);
        let whole = std::mem::take(segments);
        for segment in whole {
            let base = elevation(segment.start);
            let mut from = 0.0;
            let inside = elevations.iter().map(|angle| angle - base).filter(|angle| *angle < segment.width);
            for to in inside.chain([segment.width]).filter(|angle| *angle > 0.0) {
                let (sine, cosine) = f64::sin_cos(from);
                let start = DVec2::new(
                    segment.start.x * cosine - segment.start.y * sine,
                    segment.start.y * cosine + segment.start.x * sine,
                );
                if to > from {
                    segments.push(Segment { start, width: to - from, error: segment.error });
                }
                from = to;
            }
        }
    }
}

/// Where two segments in one plane meet.
fn meeting([a, b]: &[DVec3; 2], [c, d]: &[DVec3; 2]) -> Option<DVec3> {
    let (along, other) = (*b - *a, *d - *c);
    let normal = along.cross(other);
    let squared = normal.length_squared();
    let at = (*c - *a).cross(other).dot(normal) / squared;
    let there = (*c - *a).cross(along).dot(normal) / squared;
    ((0.0..=1.0).contains(&at) && (0.0..=1.0).contains(&there)).then(|| *a + along * at)
}

/// The three values (diffuse, specular, Schlick part) that each texel of an image on a parallelogram adds for unit
/// radiance, row after row: a way to the same integrals that shares nothing with [`textured_polygon`] but the BRDF.
///
/// The parallelogram has the corners a, b, c = b + d − a and d, relative to the surface point in its frame; d is the
/// picture's upper left corner, a the lower left one. It emits to the side of the surface point. Each texel is
/// integrated by Gauss rules over its area, as many as its size in relation to its distance and to the width of the
/// lobe calls for, up to 16 × 16. From 64 × 64 texels and a roughness of
/// 0.15 on, the sum is within 2e-3 of the integral unless the point nearly touches the light.
pub fn texel_shares(
    brdf: &dyn Brdf,
    view: DVec3,
    [a, b, d]: [DVec3; 3],
    [width, height]: [usize; 2],
) -> Vec<[f64; 3]> {
    const NODES: [(f64, f64); 2] = [(0.211_324_865_405_187_1, 0.5), (0.788_675_134_594_812_9, 0.5)];
    let (u, v) = ((b - a) / width as f64, (a - d) / height as f64);
    let volume = d.dot(u.cross(v)).abs();
    let size = u.length().max(v.length());
    let mut shares = Vec::with_capacity(width * height);
    for row in 0..height {
        for column in 0..width {
            let corner = d + u * column as f64 + v * row as f64;
            let centre = corner + 0.5 * (u + v);
            let distance = centre.length().max(size);
            let light = centre / distance;
            // The lobe's width in the direction of the light, as that of the half vector's deviation.
            let half = (view + light).normalize_or(DVec3::Z);
            let lean = half.truncate().length();
            let detail = (size / distance) / brdf.width().max(lean).min(1.0);
            let parts = (4.0 * detail).ceil().clamp(1.0, 8.0) as usize;
            let mut sums = [0.0; 3];
            for i in 0..2 * parts {
                for j in 0..2 * parts {
                    let place = |k: usize| (((k / 2) as f64) + NODES[k % 2].0) / parts as f64;
                    let point = corner + u * place(i) + v * place(j);
                    if point.z <= 0.0 {
                        continue;
                    }
                    let distance = point.length();
                    let light = point / distance;
                    let weight =
                        volume / (distance * distance * distance) * light.z * 0.25 / (parts * parts) as f64;
                    let specular = brdf.evaluate(view, light) * weight;
                    let schlick = 1.0 - view.dot((view + light).normalize_or(view));
                    sums[0] += weight / PI;
                    sums[1] += specular;
                    sums[2] += specular * schlick.powi(5);
                }
            }
            shares.push(sums);
        }
    }
    shares
}
