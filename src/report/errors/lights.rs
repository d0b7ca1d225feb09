//! Random lights to measure errors on.

use core::f64::consts::TAU;
use glam::DVec3;

use crate::report::measure::Random;
use crate::report::{Quad, Region};

/// `count` quads over a region of roughness and view, the same for a seed on every run.
///
/// Roughness and cosine are uniform. 60 % of the lights lie near the mirror direction, at a normally distributed distance from
/// it of which the deviation is uniform from 0.05 to 0.5; the others in all directions. Their distance is uniform in the logarithm
/// from 0.5 to 8, so are half their sides from 0.1 to 2; they face the surface point, tilted by a normal distribution
/// around that direction. What lies wholly below the horizon is drawn anew. Distances and sizes are thus as far apart as
/// scenes have them: a quarter of the lights is below 0.04 and a quarter above 0.8 steradians.
///
/// One seed makes alike lights in different regions, as seen along the normal and the mirror direction, so that regions
/// differ by less than their lights' chances.
pub fn random_lights(seed: u64, region: Region, count: usize) -> Vec<Quad> {
    let mut random = Random(seed);
    let mut quads = Vec::with_capacity(count);
    while quads.len() < count {
        // Every try takes as many numbers, so that lights stay alike behind one that was drawn anew.
        let roughness = random.between(region.roughness);
        let cosine = random.between(region.cosine);
        let near_mirror = random.unit() < 0.6;
        let spread = random.between((0.05, 0.5));
        let (aside, anywhere, tilt, turn) =
            (random.normal(), random.normal(), random.normal(), random.normal());
        let distance = random.between_logarithms((0.5, 8.0));
        let half_sides = [0; 2].map(|_| random.between_logarithms((0.1, 2.0)));
        let view = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
        let mirror = DVec3::new(-view.x, 0.0, view.z);
        let towards = if near_mirror {
            (mirror + aside * spread).normalize_or(mirror)
        } else {
            anywhere.normalize_or(DVec3::Z)
        };
        let normal = (tilt * TILT - towards).normalize_or(-towards);
        let x = turn.cross(normal).normalize_or_zero() * half_sides[0];
        let y = normal.cross(x).normalize_or_zero() * half_sides[1];
        let centre = towards * distance;
        let corners = [centre - x - y, centre + x - y, centre + x + y, centre - x + y];
        let faces = normal.dot(centre) < -0.02 * distance;
        if faces && x != DVec3::ZERO && corners.iter().any(|corner| corner.z > 0.0) {
            quads.push(Quad { roughness, view, corners });
        }
    }
    quads
}

/// Deviation of a light's normal from the direction to the surface point, before it is made a unit vector.
const TILT: f64 = 0.7;

impl Random {
    fn between_logarithms(&mut self, (low, high): (f64, f64)) -> f64 {
        self.between((low.ln(), high.ln())).exp()
    }

    /// Three normally distributed numbers (Box and Muller 1958).
    fn normal(&mut self) -> DVec3 {
        let mut pair = || {
            let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
            let (sine, cosine) = (TAU * self.unit()).sin_cos();
            [radius * cosine, radius * sine]
        };
        let ([x, y], [z, _]) = (pair(), pair());
        DVec3::new(x, y, z)
    }
}
