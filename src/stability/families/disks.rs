//! Disks, ellipses and spheres.

use core::f64::consts::TAU;

use glam::DVec3;

use super::{Axes, Builder, STANDARD, frame, place};
use crate::stability::{Bound, Case, Shape};

/// How far specular light of a disk or sphere may be from exact arithmetic; `slack` is what its closeness adds.
fn specular_bound(case: &Case, slack: f64) -> f64 {
    let base = match case.bound {
        Bound::Absolute(_) => 2e-6,
        Bound::Relative(_) => 4e-8,
        _ => return f64::INFINITY,
    };
    // Next to the normal the azimuth is noise, and the table's lobes are round to half precision.
    let azimuth = if case.tilt() < 1e-5 { 3e-5 } else { 0.0 };
    base / case.sharpness() + azimuth + slack
}

impl Builder {
    /// Adds a disk, given in the frame of the surface, turned so that the surface sees it from the front.
    fn disk(&mut self, family: &'static str, axes: &Axes, local: [DVec3; 3], bound: Bound, slack: f64) {
        let position = if axes[2] == DVec3::Z || matches!(bound, Bound::Relative(_)) {
            DVec3::ZERO
        } else {
            self.random.direction() * self.random.between(0.0, 2.0)
        };
        let [center, x, y] = local;
        let behind = bound == Bound::Zero && !family.starts_with("below");
        let (x, y) = if (x.cross(y).dot(center) < 0.0) != behind { (x, y) } else { (y, x) };
        let two_sided = bound != Bound::Zero && self.random.index(4) == 0;
        let v = |v: DVec3| place(axes, v).as_vec3();
        let center = (position + place(axes, center)).as_vec3();
        let shape = Shape::Disk { center, half_x: v(x), half_y: v(y), two_sided };
        let mut case = self.case(family, axes, position, shape, bound);
        case.specular_bound = specular_bound(&case, slack);
        self.cases.push(case);
    }

    /// Adds a sphere; returns its case.
    fn sphere(
        &mut self,
        family: &'static str,
        axes: &Axes,
        center: DVec3,
        radius: f64,
        bound: Bound,
    ) -> &mut Case {
        let moved = axes[2] != DVec3::Z && !matches!(bound, Bound::Relative(_));
        let position =
            if moved { self.random.direction() * self.random.between(0.0, 2.0) } else { DVec3::ZERO };
        let center = (position + place(axes, center)).as_vec3();
        let shape = Shape::Sphere { center, radius: radius as f32 };
        let mut case = self.case(family, axes, position, shape, bound);
        case.specular_bound = specular_bound(&case, 0.0);
        self.cases.push(case);
        let last = self.cases.len() - 1;
        &mut self.cases[last]
    }

    pub(super) fn disks(&mut self, scale: usize) {
        self.ordinary_disks(120 * scale);
        self.distant_disks(40 * scale);
        self.disks_on_the_horizon(10 * scale);
        self.disks_in_contact(10 * scale + 2);
        self.rims(10 * scale + 2);
        self.disk_ceilings(10 * scale + 2);
        self.slender_disks(20 * scale);
        self.edge_on_disks(10 * scale + 2);
        self.dark_disks(10 * scale);
        self.spheres(40 * scale + 2);
    }

    fn ordinary_disks(&mut self, count: usize) {
        for _ in 0..count {
            let axes = self.axes();
            let distance = self.random.log(0.2, 20.0);
            let size = distance * self.random.log(0.05, 15.0);
            let center = self.random.direction() * distance;
            let facing = self.random.direction();
            let [x, y, _] = frame(facing);
            let aspect = if self.random.index(2) == 0 { 1.0 } else { self.random.log(0.1, 1.0) };
            let turn = self.random.between(0.0, 1.0);
            // A disk as close as a hundredth of its size is a contact.
            let clearance = center.dot(facing).abs();
            if clearance < 0.01 * (size + distance) {
                continue;
            }
            let local = [center, (x + y * turn) * size, (y - x * turn) * (size * aspect)];
            let bound = Bound::Absolute(1e-6 + 3e-8 * (size + distance) / clearance);
            self.disk("disk, ordinary", &axes, local, bound, 0.0);
        }
    }

    fn distant_disks(&mut self, count: usize) {
        let mut left = count;
        while left > 0 {
            let axes = self.axes();
            let direction = self.random.direction();
            let size = self.random.log(1e-5, 0.1);
            if direction.z < if axes[2] == DVec3::Z { 2.0 * size } else { 3e-3 } {
                continue;
            }
            let facing = self.random.direction();
            if facing.dot(direction).abs() < 0.1 {
                continue;
            }
            left -= 1;
            let distance = self.random.log(1e-3, 1e3);
            let half = 0.5 * size * distance;
            let [x, y, _] = frame(facing);
            let aspect = self.random.log(0.01, 1.0);
            let local = [direction * distance, x * half, y * (half * aspect)];
            self.disk("disk, distant", &axes, local, Bound::Relative(1e-4), 0.0);
            self.sphere("sphere, distant", &axes, direction * distance, half, Bound::Relative(1e-4));
        }
    }

    /// Where the frame is exact, the horizon is.
    fn disks_on_the_horizon(&mut self, count: usize) {
        for _ in 0..count {
            let size = self.random.log(1e-5, 0.1);
            let azimuth = self.random.between(0.0, TAU);
            let height = size * self.random.between(-0.25, 0.25);
            let center = DVec3::new(azimuth.cos(), azimuth.sin(), height);
            let side = DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0);
            let tilt = side * self.random.between(-0.3, 0.3) + DVec3::Z;
            let local = [center, side * (0.5 * size), tilt * (0.5 * size)];
            let bound = Bound::Relative(1e-4);
            self.disk("disk, distant, on the horizon", &STANDARD, local, bound, 0.0);
            self.sphere("sphere, distant, on the horizon", &STANDARD, center, 0.5 * size, bound);
        }
    }

    /// Upright disks that all but touch the surface point, and the point near their rims.
    fn disks_in_contact(&mut self, count: usize) {
        for i in 0..count {
            let gap = 10_f64.powf(-1.0 - 5.0 * i as f64 / (count - 1) as f64);
            let (width, height) = (self.random.log(0.2, 5.0), self.random.log(0.2, 5.0));
            let (x, z) = (self.random.between(-0.9, 0.9), self.random.between(-0.4, 0.4));
            let local = [DVec3::new(x * width, gap, z * height), DVec3::X * width, DVec3::Z * height];
            let slack = 1e-7 / gap;
            self.disk("disk, standing on the surface", &STANDARD, local, Bound::Absolute(2e-6), slack);
            let axes = frame(self.random.direction());
            let bound = Bound::Absolute(3e-6 + 1e-9 / gap);
            self.disk("disk, standing on a turned surface", &axes, local, bound, 2.0 * slack);
        }
    }

    fn rims(&mut self, count: usize) {
        for i in 0..count {
            let gap = 10_f64.powf(-1.0 - 4.0 * i as f64 / (count - 1) as f64);
            let axes = self.axes();
            let [x, y, z] = frame(self.random.direction());
            let aspect = self.random.log(0.2, 1.0);
            let (sine, cosine) = self.random.between(0.0, TAU).sin_cos();
            let rim = x * cosine + y * (sine * aspect);
            let toward = self.random.direction() * gap;
            if toward.dot(z).abs() < 0.1 * gap {
                continue;
            }
            let local = [toward - rim, x, y * aspect];
            let bound = Bound::Absolute(1e-6 + 6e-7 / gap);
            self.disk("disk, the rim passes close by", &axes, local, bound, 1.6e-5 / gap);
            // Rounding of point and disk turns the rim by 2e-7 over its distance, and a lobe sees that in units of its width.
            let last = self.cases.len() - 1;
            let alpha = f64::from(self.cases[last].roughness.clamp(0.02, 1.0)).powi(2);
            self.cases[last].specular_bound += 2e-7 / (gap * alpha);
        }
    }

    fn disk_ceilings(&mut self, count: usize) {
        for i in 0..count {
            let height = 10_f64.powf(-6.0 * i as f64 / (count - 1) as f64);
            let size = self.random.log(0.3, 3.0);
            let aspect = self.random.log(0.2, 1.0);
            let large = if i % 2 == 0 { 1.0 } else { self.random.log(1.0, 1e6) };
            let aside = size * large * self.random.between(0.0, 0.8);
            let center = if i % 5 == 0 { DVec3::Z * height } else { DVec3::new(aside, 0.0, height) };
            let local = [center, DVec3::X * (size * large), DVec3::Y * (size * large * aspect)];
            self.disk("disk, ceiling", &STANDARD, local, Bound::Absolute(2e-6), 0.0);
        }
        // Where other code has failed: axial, parallel, huge and tiny.
        for radius in [0.003, 0.01, 4.0, 200.0] {
            for aside in [0.0, 1e-4, 0.5, 3.9, 150.0] {
                let local = [DVec3::new(aside, 0.0, 6.0), DVec3::X * radius, DVec3::Y * radius];
                let bound = if radius < 1.0 { Bound::Relative(1e-5) } else { Bound::Absolute(1e-6) };
                self.disk("disk, parallel to the surface", &STANDARD, local, bound, 0.0);
            }
        }
    }

    fn slender_disks(&mut self, count: usize) {
        for _ in 0..count {
            let axes = self.axes();
            let distance = self.random.log(0.2, 20.0);
            let size = distance * self.random.log(0.05, 15.0);
            let center = self.random.direction() * distance;
            let facing = self.random.direction();
            let [x, y, _] = frame(facing);
            let aspect = self.random.log(1e-6, 0.1);
            if center.dot(facing).abs() < 0.01 * (size + distance) {
                continue;
            }
            let local = [center, x * size, y * (size * aspect)];
            self.disk("disk, slender", &axes, local, Bound::Absolute(1e-6), 0.0);
        }
    }

    fn edge_on_disks(&mut self, count: usize) {
        for i in 0..count {
            let lift = 10_f64.powf(-1.0 - 6.0 * i as f64 / (count - 1) as f64);
            let axes = self.axes();
            let [x, y, z] = frame(self.random.direction());
            let away = self.random.log(1.2, 20.0);
            let (sine, cosine) = self.random.between(0.0, TAU).sin_cos();
            let local = [(x * cosine + y * sine) * away + z * lift, x, y];
            self.disk("disk, edge-on", &axes, local, Bound::Absolute(1e-6), 0.0);
        }
    }

    fn dark_disks(&mut self, count: usize) {
        for _ in 0..count {
            let axes = self.axes();
            let size = self.random.log(1e-4, 1e3);
            let margin = self.random.log(1e-3, 1.0);
            let [x, y] = [0; 2].map(|_| self.random.direction() * size);
            let aside = self.random.direction() * size;
            let depth = x.z.hypot(y.z) + margin * (size + 1.0);
            let center = DVec3::new(aside.x, aside.y, -depth);
            self.disk("below the horizon", &axes, [center, x, y], Bound::Zero, 0.0);
            let center = DVec3::new(aside.x, aside.y, -size - margin * (size + 1.0));
            self.sphere("below the horizon", &axes, center, size, Bound::Zero);
            let facing = self.random.direction();
            let [x, y, _] = frame(facing);
            let away = facing * self.random.log(1e-3, 10.0) + x * size * self.random.between(-1.0, 1.0);
            if facing.dot(away) > 1e-3 * (size + away.length()) {
                self.disk("seen from behind", &axes, [away, x * size, y * size], Bound::Zero, 0.0);
            }
            let [center, axis] = [0; 2].map(|_| self.random.direction() * self.random.log(0.01, 10.0));
            let parallel = axis * (self.random.index(3) as f64 - 1.0);
            let nothing = DVec3::ZERO;
            for local in [[center, nothing, axis], [center, axis, nothing], [center, nothing, nothing]] {
                self.disk("without area", &STANDARD, local, Bound::Zero, 0.0);
            }
            let local = [center, axis, parallel];
            self.disk("without area, but for rounding", &STANDARD, local, Bound::Physical, 0.0);
            self.sphere("without area", &STANDARD, center, 0.0, Bound::Zero);
            self.sphere("without area", &STANDARD, nothing, 0.0, Bound::Zero);
            self.disk("in the light's plane", &STANDARD, [nothing, axis, center], Bound::Zero, 0.0);
        }
    }

    fn spheres(&mut self, count: usize) {
        for i in 0..count {
            let axes = self.axes();
            let distance = self.random.log(0.2, 20.0);
            let center = self.random.direction() * distance;
            let radius = distance * self.random.log(0.05, 0.99);
            self.sphere("sphere, ordinary", &axes, center, radius, Bound::Absolute(1e-6));
            let radius = distance * self.random.log(1.01, 100.0);
            self.sphere("sphere, around the point", &axes, center, radius, Bound::Absolute(1e-6));
            let gap = 10_f64.powf(-1.0 - 6.0 * i as f64 / (count - 1) as f64);
            let center = DVec3::new(0.0, 0.0, self.random.between(-0.9, 1.0));
            let aside = (1.0 - center.z * center.z).max(0.0).sqrt() * (1.0 + gap);
            let center = DVec3::new(aside, 0.0, center.z * (1.0 + gap));
            // The distance itself rounds by 1e-7 of the radius.
            let bound = Bound::Absolute(1e-6 + 1e-7 / gap.sqrt());
            if gap > 3e-7 {
                let case = self.sphere("sphere, all but touched", &STANDARD, center, 1.0, bound);
                let alpha = f64::from(case.roughness.clamp(0.02, 1.0)).powi(2);
                case.specular_bound = specular_bound(case, 4e-8 / (gap.sqrt() * alpha));
            }
        }
    }
}

impl Builder {
    /// A sphere on the horizon of a surface along the axes.
    pub(super) fn sphere_on_the_horizon(&mut self, center: DVec3, radius: f64) {
        self.sphere("sphere, touching the horizon", &STANDARD, center, radius, Bound::Absolute(1e-6));
    }

    /// A disk whose rim touches the horizon of a surface along the axes.
    pub(super) fn disk_on_the_horizon(&mut self, local: [DVec3; 3]) {
        self.disk("disk, touching the horizon", &STANDARD, local, Bound::Absolute(1e-6), 0.0);
    }
}
