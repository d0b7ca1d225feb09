//! Any finite numbers at all.

use glam::Vec3;

use super::Builder;
use crate::stability::{Bound, Case, Shape};

/// Numbers at the ends of single precision.
const ENDS: [f32; 8] = [f32::MAX, -f32::MAX, 0.0, -0.0, 1e-45, f32::MIN_POSITIVE, 1.0, 1e30];

impl Builder {
    pub(super) fn bits(&mut self, scale: usize) {
        for i in 0..160 * scale {
            let number = |this: &mut Self| match i % 4 {
                0 => this.random.finite(),
                1 => ENDS[this.random.index(8)],
                2 => (this.random.between(-1.0, 1.0) * this.random.log(1e-30, 1e30)) as f32,
                _ => (this.random.sign() * this.random.log(1e-38, 3e38)) as f32,
            };
            let vector = |this: &mut Self| Vec3::new(number(this), number(this), number(this));
            let corners = [0; 4].map(|_| vector(self));
            let (radius, roughness) = (number(self), number(self));
            let position = match i % 5 {
                0 => Vec3::ZERO,
                1 => corners[0],
                2 => -corners[0],
                _ => vector(self),
            };
            let (normal, view) = if i % 3 == 0 {
                (self.nonzero(), self.nonzero())
            } else {
                let nonzero = |v: Vec3| if v == Vec3::ZERO { Vec3::Z } else { v };
                (nonzero(vector(self)), nonzero(vector(self)))
            };
            let [a, b, c, _] = corners;
            let two_sided = self.random.index(2) == 0;
            let shape = match i % 7 {
                0 => Shape::Quad { corners, two_sided },
                1 => {
                    let vertices = (0..1 + i % 6).map(|_| vector(self)).collect();
                    Shape::Polygon { vertices, two_sided }
                }
                2 => Shape::Disk { center: a, half_x: b, half_y: c, two_sided },
                3 => Shape::Disk { center: position, half_x: b, half_y: a, two_sided },
                4 => Shape::Sphere { center: a, radius },
                5 => Shape::Tube { start: a, end: b, radius, caps: two_sided },
                _ => Shape::Tube { start: a, end: a, radius, caps: two_sided },
            };
            self.cases.push(Case {
                family: "any finite numbers",
                position,
                normal,
                view,
                roughness,
                shape,
                bound: Bound::Physical,
                specular_bound: f64::INFINITY,
                form_factor: None,
            });
        }
    }
}
