//! Polygons that are no convex quads: many vertices, not convex, degenerate.

use core::f64::consts::TAU;

use glam::DVec3;

use super::{Builder, STANDARD, frame};
use crate::stability::Bound;

impl Builder {
    pub(super) fn flat(&mut self, scale: usize) {
        self.degenerate(20 * scale);
        self.stars(20 * scale);
    }

    fn degenerate(&mut self, count: usize) {
        for i in 0..count {
            let [a, b, c] = [0; 3].map(|_| self.random.direction() * self.random.log(0.01, 10.0));
            let d = a + (c - b);
            let zero = DVec3::ZERO;
            let mut corners = match i % 10 {
                0 => vec![a, a, b, c],
                1 => vec![a, b, b, c],
                2 => vec![a, a, a, b],
                3 => vec![a, a, a, a],
                4 => vec![a, a.lerp(b, 0.5), b, a.lerp(b, 0.25)],
                5 => vec![zero, b, c, c - b],
                6 => vec![a, b, zero, a - b],
                7 => vec![zero; 4],
                8 => vec![a, -a, b, -b],
                _ => vec![a, b, c, d],
            };
            if i % 3 == 0 {
                corners.iter_mut().for_each(|v| v.z = 0.0);
            }
            if i % 7 == 0 {
                corners.truncate(3);
            }
            self.polygon("degenerate", &STANDARD, DVec3::ZERO, &corners, Bound::Physical);
        }
    }

    /// Simple polygons, most of them not convex: stars around a centre in a plane.
    fn stars(&mut self, count: usize) {
        for i in 0..count {
            let axes = self.axes();
            let distance = self.random.log(0.3, 5.0);
            let centre = self.random.direction() * distance;
            let facing = (-centre.normalize() + self.random.direction() * 0.7).normalize();
            if facing.dot(centre) > -0.1 * distance {
                continue;
            }
            let [x, y, _] = frame(facing);
            let (x, y) = if x.cross(y).dot(facing) > 0.0 { (x, y) } else { (y, x) };
            let vertices = 3 + self.random.index(if i % 20 == 0 { 200 } else { 12 });
            let size = distance * self.random.log(0.2, 5.0);
            let corners: Vec<DVec3> = (0..vertices)
                .map(|k| {
                    let azimuth = TAU * k as f64 / vertices as f64;
                    let radius = size * self.random.between(0.2, 1.0);
                    centre + x * (radius * azimuth.cos()) + y * (radius * azimuth.sin())
                })
                .collect();
            if corners.len() != 4 {
                self.polygon("simple polygon", &axes, DVec3::ZERO, &corners, Bound::Absolute(1e-6));
            }
        }
    }
}
