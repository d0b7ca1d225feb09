//! Approaches to singular configurations: on both sides of each, log-uniformly and by neighbours of the critical value.

use core::f64::consts::TAU;

use glam::{DVec3, Vec3};

use super::quads::{TOUCHING, specular_bound};
use super::{Axes, Builder, STANDARD, frame, parallelogram, place};
use crate::TABLE_SIZE;
use crate::stability::{Bound, Case, Shape};

/// Numbers that single precision may flush to zero, and those next to them.
const NOTHINGS: [f32; 9] =
    [0.0, -0.0, 1e-45, -1e-45, 1e-40, -1e-40, f32::MIN_POSITIVE, -f32::MIN_POSITIVE, 1e-30];

impl Builder {
    pub(super) fn further(&mut self, scale: usize) {
        self.edges(10 * scale);
        self.near_the_plane(10 * scale);
        self.on_the_horizon(10 * scale);
        self.views(10 * scale);
        self.texels(10 * scale);
        self.far_and_large(10 * scale);
        self.slivers(10 * scale);
        self.outlines(2 * scale);
        self.bent(10 * scale);
        self.round_horizon(10 * scale);
    }

    /// A distance to a singular configuration: none, next to none, or some.
    fn approach(&mut self) -> f64 {
        match self.random.index(6) {
            0 => f64::from(NOTHINGS[self.random.index(NOTHINGS.len())]),
            1 => self.random.log(1e-38, 1e-8),
            _ => self.random.log(1e-8, 0.3),
        }
    }

    /// An ordinary quad above the surface, wholly in front of it.
    fn window(&mut self) -> [DVec3; 4] {
        loop {
            let centre = self.random.upper() * self.random.log(0.5, 4.0);
            let (x, y) = (self.random.direction(), self.random.direction());
            let facing = x.cross(y).dot(centre).abs();
            if facing > 0.2 * centre.length() {
                return parallelogram(centre, x, y, -centre);
            }
        }
    }

    /// Edges whose ends are seen in nearly opposite or nearly the same directions, and vertices next to the point.
    fn edges(&mut self, count: usize) {
        for i in 0..count {
            // The first is wide enough to count among these, however few there are.
            let gap = self.random.log(if i == 0 { 0.3 } else { 1e-8 }, 1.0);
            let (left, right) = (self.random.log(0.2, 3.0), self.random.log(0.2, 3.0));
            let height = self.random.log(0.2, 3.0);
            let corners = [(-left, 0.0), (right, 0.0), (right, 1.0), (-left, 1.0)]
                .map(|(x, t)| DVec3::new(x, gap + t * height * 0.5, gap * 0.5 + t * height));
            let bound = Bound::Absolute(1e-6);
            self.polygon("an edge subtends nearly a half turn", &STANDARD, DVec3::ZERO, &corners, bound);

            let mut corners = self.window().to_vec();
            let share = self.random.log(1e-12, 1e-2);
            let extra = corners[1].lerp(corners[2], share);
            corners.insert(2, extra);
            let family = "an edge subtends nearly nothing";
            self.polygon(family, &STANDARD, DVec3::ZERO, &corners, Bound::Absolute(1e-6));

            let near = self.random.upper() * self.random.log(1e-30, 1e-2);
            let (along, up) = (self.random.direction(), self.random.upper());
            if along.cross(up).length() > 0.3 {
                let corners = [near, near + along, near + along + up, near + up];
                let corners = if (corners[1] - corners[0]).cross(corners[3] - corners[0]).dot(near) > 0.0 {
                    [corners[0], corners[3], corners[2], corners[1]]
                } else {
                    corners
                };
                let family = "a vertex next to the point";
                self.polygon(family, &STANDARD, DVec3::ZERO, &corners, Bound::Physical);
            }
        }
    }

    /// Points next to the light's plane: inside the light, beside it, and on its back.
    fn near_the_plane(&mut self, count: usize) {
        for i in 0..count {
            let height = self.approach();
            let (x, y) = (DVec3::X * self.random.log(0.3, 3.0), DVec3::Y * self.random.log(0.3, 3.0));
            let inside = x * self.random.between(-0.8, 0.8) + y * self.random.between(-0.8, 0.8);
            let corners = parallelogram(inside + DVec3::Z * height, x, y, -DVec3::Z);
            // On the plane itself the light is seen from neither side.
            let seen = f64::from(height as f32) >= f64::from(f32::MIN_POSITIVE);
            let bound = if seen { Bound::Absolute(2e-6) } else { Bound::Physical };
            for case in self.polygon("the point in the light", &STANDARD, DVec3::ZERO, &corners, bound) {
                // In the lobe's space single precision no longer tells the light's front from its back.
                if height < TOUCHING {
                    case.specular_bound = f64::INFINITY;
                }
            }

            let behind = parallelogram(inside + DVec3::Z * height.abs().max(1e-30), x, y, DVec3::Z);
            self.polygon("seen from behind", &STANDARD, DVec3::ZERO, &behind, Bound::Zero);

            let axes = if i % 2 == 0 { STANDARD } else { frame(self.random.direction()) };
            let [x, y, z] =
                if i % 2 == 0 { [DVec3::X, DVec3::Z, DVec3::Y] } else { frame(self.random.direction()) };
            let height = self.approach();
            let (half_x, half_y) = (self.random.log(0.1, 2.0), self.random.log(0.1, 2.0));
            let away = half_x * (1.1 + self.random.log(0.01, 5.0)) * self.random.sign();
            let centre = x * away + y * (half_y * self.random.between(-1.5, 1.5)) + z * height;
            let corners = parallelogram(centre, x * half_x, y * half_y, -z);
            self.polygon("edge-on", &axes, DVec3::ZERO, &corners, Bound::Absolute(1e-6));
        }
    }

    /// Vertices on the surface's horizon, by a subnormal number above or below, or by the last digit.
    fn on_the_horizon(&mut self, count: usize) {
        for i in 0..count {
            let low = match i % 3 {
                0 => f64::from(NOTHINGS[self.random.index(NOTHINGS.len())]),
                1 => self.random.sign() * self.random.log(1e-12, 1e-5),
                _ => self.random.sign() * self.random.log(1e-5, 0.1),
            };
            let azimuth = self.random.between(0.0, TAU);
            let away = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0) * self.random.log(0.3, 3.0);
            let side = DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0) * self.random.log(0.3, 3.0);
            let top =
                DVec3::Z * if i % 4 == 0 { -self.random.log(0.1, 2.0) } else { self.random.log(0.1, 2.0) };
            let foot = DVec3::Z * low;
            let corners = [away - side + foot, away + side + foot, away + side + top, away - side + top];
            let toward = (corners[1] - corners[0]).cross(corners[3] - corners[0]).dot(away);
            let corners =
                if toward > 0.0 { [corners[1], corners[0], corners[3], corners[2]] } else { corners };
            let family = "vertices on the horizon";
            self.polygon(family, &STANDARD, DVec3::ZERO, &corners, Bound::Absolute(1e-6));
            // All of it, seen edge-on.
            let flat = [away - side, away + side, away * 2.0 + side, away * 2.0 - side].map(|v| v + foot);
            self.polygon("flat on the horizon", &STANDARD, DVec3::ZERO, &flat, Bound::Absolute(1e-6));
        }
    }

    /// A window seen by a given view on a given roughness.
    fn seen_by(&mut self, family: &'static str, view: Vec3, normal: Vec3, roughness: f32) {
        let axes = frame(normal.as_dvec3().normalize());
        let corners = self.window().map(|corner| place(&axes, corner).as_vec3());
        let two_sided = self.random.index(4) == 0;
        for shape in
            [Shape::Quad { corners, two_sided }, Shape::Polygon { vertices: corners.to_vec(), two_sided }]
        {
            let mut case = Case {
                family,
                position: Vec3::ZERO,
                normal,
                view,
                roughness,
                shape,
                bound: Bound::Absolute(1e-6),
                specular_bound: 0.0,
                form_factor: None,
            };
            case.specular_bound = specular_bound(&case, 0.0);
            if super::edge_ratio(&case.seen()) < 25.0 {
                self.cases.push(case);
            }
        }
    }

    fn views(&mut self, count: usize) {
        for i in 0..count {
            let axes: Axes = self.axes();
            let normal = axes[2].as_vec3();
            let roughness = self.roughness();
            let around = self.random.direction();
            // Along the normal.
            let view = if i % 2 == 0 {
                normal.to_array().map(|number| self.random.near(number, 3)).into()
            } else {
                (axes[2] + around * self.random.log(1e-12, 1e-2)).as_vec3()
            };
            self.seen_by("seen along the normal", view, normal, roughness);
            // Along the surface.
            let tangent = around - axes[2] * around.dot(axes[2]);
            let view = tangent.normalize() + axes[2] * (self.random.sign() * self.approach());
            self.seen_by("seen along the surface", view.as_vec3(), normal, roughness);
            // Mirrors.
            let roughness = match i % 4 {
                0 => self.random.near(0.02, 3),
                1 => self.random.near(0.0, 3).max(0.0),
                _ => self.random.log(1e-12, 1e-4) as f32,
            };
            let view = place(&axes, self.random.upper()).as_vec3();
            self.seen_by("mirrors", view, normal, roughness);
            // Any length.
            let [long, wide] = [0; 2].map(|_| self.random.log(1e-37, 1e37));
            let roughness = self.random.unit() as f32;
            let (normal, view) = ((axes[2] * long).as_vec3(), (view.as_dvec3() * wide).as_vec3());
            self.seen_by("normal and view of any length", view, normal, roughness);
        }
    }

    /// Roughness and view at centres, edges and corners of the table's texels, and next to them.
    fn texels(&mut self, count: usize) {
        let last = 2 * (TABLE_SIZE - 1);
        for _ in 0..count {
            let [across, down] = [0; 2].map(|_| self.random.index(last + 1) as f64 / last as f64);
            let roughness = self.random.near(across as f32, 2).clamp(0.0, 1.0);
            let cosine = down * down;
            let (sine, azimuth) = ((1.0 - cosine * cosine).sqrt(), self.random.between(0.0, TAU));
            let view = DVec3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine).as_vec3();
            let view = view.to_array().map(|number| self.random.near(number, 2)).into();
            self.seen_by("between the table's texels", view, Vec3::Z, roughness);
        }
    }

    /// Everything far from the origin of coordinates, and in very small and very large units.
    fn far_and_large(&mut self, count: usize) {
        for _ in 0..count {
            let axes = self.axes();
            let corners = self.window();
            let offset = self.random.log(1e4, 1e6);
            let size = self.random.log(1.0, 100.0);
            let position = self.random.direction() * offset;
            let corners_there = corners.map(|corner| corner * size);
            let before = self.cases.len();
            let family = "far from the origin";
            self.polygon(family, &axes, position, &corners_there, Bound::Absolute(2e-6));
            // Coordinates round by 1e-7 of the offset, which bends the light: the two precisions see the same bent light.
            for case in &mut self.cases[before..] {
                case.specular_bound *= 2.0;
            }
            let scale = 2.0_f64.powi(self.random.index(81) as i32 - 40);
            let position = self.random.direction() * scale;
            let corners = corners.map(|corner| corner * scale);
            let family = "in units of 2^-40 to 2^40";
            self.polygon(family, &axes, position, &corners, Bound::Absolute(1e-6));
        }
    }

    /// Quads up to a million times as long as wide.
    fn slivers(&mut self, count: usize) {
        for _ in 0..count {
            let axes = self.axes();
            let distance = self.random.log(0.2, 20.0);
            let centre = self.random.direction() * distance;
            let facing = (self.random.direction() - centre.normalize()).normalize();
            if facing.dot(centre).abs() < 0.1 * distance {
                continue;
            }
            let [x, y, _] = frame(facing);
            let size = distance * self.random.log(0.1, 10.0);
            let slender = size * self.random.log(1e-6, 1e-2);
            let turn = self.random.between(0.0, TAU);
            let along = x * turn.cos() + y * turn.sin();
            let across = facing.cross(along);
            let corners = parallelogram(centre, along * size, across * slender, -centre);
            let family = "a million times as long as wide";
            self.polygon(family, &axes, DVec3::ZERO, &corners, Bound::Absolute(1e-6));
        }
    }

    /// Outlines of thousands of vertices, spirals, and polygons around the nadir that reach over the horizon.
    fn outlines(&mut self, count: usize) {
        for i in 0..count {
            let axes = self.axes();
            let centre = self.random.upper() * self.random.log(0.5, 3.0);
            let [x, y, _] = frame(-centre.normalize());
            let (x, y) = if x.cross(y).dot(centre) < 0.0 { (x, y) } else { (y, x) };
            let size = self.random.log(0.3, 3.0);
            let at = |radius: f64, azimuth: f64| {
                centre + (x * azimuth.cos() + y * azimuth.sin()) * (radius * size)
            };
            let vertices = 1000 + self.random.index(3000);
            let rough: Vec<DVec3> = (0..vertices)
                .map(|k| at(self.random.between(0.8, 1.0), TAU * k as f64 / vertices as f64))
                .collect();
            let family = "thousands of vertices";
            self.polygon(family, &axes, DVec3::ZERO, &rough, Bound::Absolute(2e-6));

            let turns = 1.0 + self.random.between(0.0, 6.0);
            let arm = |t: f64| 0.05 + 0.9 * t;
            let width = 0.4 / turns;
            let steps = 64 * (1 + turns as usize);
            let outward = (0..=steps).map(|k| k as f64 / steps as f64);
            let outer: Vec<DVec3> =
                outward.clone().map(|t| at(arm(t) + width * t, TAU * turns * t)).collect();
            let inner: Vec<DVec3> = outward.map(|t| at(arm(t), TAU * turns * t)).collect();
            let spiral: Vec<DVec3> = outer.into_iter().chain(inner.into_iter().rev()).collect();
            self.polygon("spiral", &axes, DVec3::ZERO, &spiral, Bound::Absolute(2e-6));

            let tilt = self.random.between(0.0, 1.2);
            let azimuth = self.random.between(0.0, TAU);
            let facing = DVec3::new(tilt.sin() * azimuth.cos(), tilt.sin() * azimuth.sin(), tilt.cos());
            let [x, y, _] = frame(facing);
            let (x, y) = if x.cross(y).dot(facing) > 0.0 { (x, y) } else { (y, x) };
            let count = 3 + i % 20;
            let reach = self.random.log(1.0, 30.0);
            let around: Vec<DVec3> = (0..count)
                .map(|k| {
                    let (sine, cosine) = (TAU * k as f64 / count as f64).sin_cos();
                    (x * cosine + y * sine) * (reach * self.random.between(0.7, 1.0)) - facing
                })
                .collect();
            if count != 4 {
                self.polygon("around the nadir", &axes, DVec3::ZERO, &around, Bound::Absolute(1e-6));
            }
        }
    }

    /// Quads that are not what `ltc_quad` asks for: crossed, not convex, not planar.
    fn bent(&mut self, count: usize) {
        for i in 0..count {
            let axes = self.axes();
            let mut corners = self.window();
            match i % 3 {
                0 => corners.swap(1, 2),
                1 => {
                    corners[1] =
                        corners[0].lerp(corners[2], self.random.between(0.1, 0.9)).lerp(corners[3], 0.4)
                }
                _ => corners[3] += self.random.direction(),
            }
            self.polygon("crossed, dented and bent quads", &axes, DVec3::ZERO, &corners, Bound::Physical);
        }
    }

    /// Spheres that touch the surface's plane from above and below, and disks whose rim does.
    fn round_horizon(&mut self, count: usize) {
        for _ in 0..count {
            let azimuth = self.random.between(0.0, TAU);
            let away = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0) * self.random.log(0.3, 10.0);
            let radius = away.length() * self.random.log(0.01, 0.9);
            let off = 1.0 + self.random.sign() * self.approach();
            let height = self.random.sign() * radius * off;
            self.sphere_on_the_horizon(away + DVec3::Z * height, radius);
            let (side, up) = (DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0) * radius, DVec3::Z * radius);
            self.disk_on_the_horizon([away + DVec3::Z * height, side, up]);
        }
    }
}
