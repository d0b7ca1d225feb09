//! The families of disks and spheres.

use glam::{DVec3, Vec3};
use softbox::shade::{Real, Vector, ltc_disk, ltc_sphere, ltc_surface};
use softbox::table::Table;

use crate::common::Random;

pub use crate::common::Bound;

/// A light.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    Disk { center: Vec3, half_x: Vec3, half_y: Vec3, two_sided: bool },
    Sphere { center: Vec3, radius: f32 },
}

/// A surface, a light and what must hold.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub family: &'static str,
    pub position: Vec3,
    pub normal: Vec3,
    pub view: Vec3,
    pub roughness: f32,
    pub shape: Shape,
    pub bound: Bound,
    /// What the light's closeness adds to the error that specular light may have.
    pub slack: f64,
}

impl Case {
    /// The value by the twin.
    pub fn twin<R: Real>(&self, table: &Table) -> [f64; 3] {
        let v = |v: Vec3| R::Vec3::new(R::new(v.x.into()), R::new(v.y.into()), R::new(v.z.into()));
        let roughness = R::new(self.roughness.into());
        let surface = ltc_surface::<R>(v(self.position), v(self.normal), v(self.view), roughness);
        let lobe = table.lobe(&surface);
        let value = match self.shape {
            Shape::Disk { center, half_x, half_y, two_sided } => {
                ltc_disk(&surface, &lobe, v(center), v(half_x), v(half_y), two_sided)
            }
            Shape::Sphere { center, radius } => ltc_sphere(&surface, &lobe, v(center), R::new(radius.into())),
        };
        [value.x(), value.y(), value.z()].map(Real::to_f64)
    }

    /// The albedo of the lobe that the case is shaded with, in single precision: what a light around the point gets.
    pub fn albedo(&self, table: &Table) -> f64 {
        let surface = ltc_surface::<f32>(self.position, self.normal, self.view, self.roughness);
        table.lobe(&surface).albedo.into()
    }

    /// How far specular light may be from exact arithmetic: rounding moves a light by so much in the space of a
    /// lobe that is α wide, and 1 / cos θ times as sensitive seen at a grazing angle.
    pub fn specular_bound(&self) -> f64 {
        let alpha = f64::from(self.roughness.clamp(0.02, 1.0)).powi(2);
        let cosine = self.view.as_dvec3().normalize().dot(self.normal.as_dvec3().normalize());
        let base = match self.bound {
            Bound::Absolute(_) => 2e-6,
            Bound::Relative(_) => 4e-8,
            _ => return f64::INFINITY,
        };
        // Next to the normal the azimuth is noise, and the table's lobes are round to half precision.
        let sine = self.view.as_dvec3().normalize().cross(self.normal.as_dvec3().normalize()).length();
        let azimuth = if sine < 1e-5 { 3e-5 } else { 0.0 };
        base / (alpha * cosine.max(1e-9)) + azimuth + self.slack
    }
}

type Axes = [DVec3; 3];

fn frame(normal: DVec3) -> Axes {
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    [tangent, bitangent, normal]
}

fn place(axes: &Axes, v: DVec3) -> DVec3 {
    axes[0] * v.x + axes[1] * v.y + axes[2] * v.z
}

const STANDARD: Axes = [DVec3::X, DVec3::Y, DVec3::Z];

struct Builder {
    random: Random,
    cases: Vec<Case>,
}

impl Builder {
    fn axes(&mut self) -> Axes {
        if self.random.index(2) == 0 { STANDARD } else { frame(self.random.direction()) }
    }

    /// A surface with the exact normal, its neighbourhood, the horizon and directions below it among the views.
    fn surface(&mut self, family: &'static str, axes: &Axes, position: DVec3, bound: Bound) -> Case {
        let around = self.random.direction();
        let local = match self.random.index(10) {
            0 => DVec3::Z,
            1 => DVec3::Z + around * self.random.log(1e-8, 1e-2),
            2 => DVec3::new(around.x, around.y, around.z * self.random.log(1e-8, 1e-2)),
            3 => DVec3::new(around.x, around.y, -around.z.abs()),
            _ => DVec3::new(around.x, around.y, around.z.abs()),
        };
        let roughness = match self.random.index(10) {
            0 => 0.0,
            1 => 1.0,
            2 => self.random.log(1e-4, 0.1) as f32,
            _ => self.random.unit() as f32,
        };
        Case {
            family,
            position: position.as_vec3(),
            normal: (axes[2] * self.random.log(0.1, 10.0)).as_vec3(),
            view: (place(axes, local) * self.random.log(0.1, 10.0)).as_vec3(),
            roughness,
            shape: Shape::Sphere { center: Vec3::ZERO, radius: 0.0 },
            bound,
            slack: 0.0,
        }
    }

    /// Adds a disk, turned so that the surface sees it from the front.
    fn disk(&mut self, family: &'static str, axes: &Axes, local: [DVec3; 3], bound: Bound, slack: f64) {
        let position = if axes[2] == DVec3::Z || matches!(bound, Bound::Relative(_)) {
            DVec3::ZERO
        } else {
            self.random.direction() * self.random.between(0.0, 2.0)
        };
        let [center, x, y] = local;
        let behind = matches!(bound, Bound::Zero) && !family.starts_with("below");
        let (x, y) = if (x.cross(y).dot(center) < 0.0) != behind { (x, y) } else { (y, x) };
        let two_sided = bound != Bound::Zero && self.random.index(4) == 0;
        let mut case = self.surface(family, axes, position, bound);
        let v = |v: DVec3| place(axes, v).as_vec3();
        let center = (position + place(axes, center)).as_vec3();
        case.shape = Shape::Disk { center, half_x: v(x), half_y: v(y), two_sided };
        case.slack = slack;
        self.cases.push(case);
    }

    fn sphere(&mut self, family: &'static str, axes: &Axes, center: DVec3, radius: f64, bound: Bound) {
        let position = if matches!(bound, Bound::Relative(_)) {
            DVec3::ZERO
        } else {
            self.random.direction() * self.random.between(0.0, 2.0)
        };
        let position = if axes[2] == DVec3::Z { DVec3::ZERO } else { position };
        let mut case = self.surface(family, axes, position, bound);
        let center = (position + place(axes, center)).as_vec3();
        case.shape = Shape::Sphere { center, radius: radius as f32 };
        self.cases.push(case);
    }

    fn ordinary(&mut self, count: usize) {
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
            self.disk("disk, ordinary", &axes, local, Bound::Absolute(1e-6), 0.0);
        }
    }

    fn distant(&mut self, count: usize) {
        let mut left = count;
        while left > 0 {
            let axes = self.axes();
            let direction = self.random.direction();
            let size = self.random.log(1e-5, 0.1);
            let height = direction.z;
            if height < if axes[2] == DVec3::Z { 2.0 * size } else { 3e-3 } {
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
    fn horizon(&mut self, count: usize) {
        for _ in 0..count {
            let size = self.random.log(1e-5, 0.1);
            let azimuth = self.random.between(0.0, core::f64::consts::TAU);
            let height = size * self.random.between(-0.25, 0.25);
            let center = DVec3::new(azimuth.cos(), azimuth.sin(), height);
            let side = DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0);
            let tilt = side * self.random.between(-0.3, 0.3) + DVec3::Z;
            let local = [center, side * (0.5 * size), tilt * (0.5 * size)];
            self.disk("disk, distant, on the horizon", &STANDARD, local, Bound::Relative(1e-4), 0.0);
            self.sphere(
                "sphere, distant, on the horizon",
                &STANDARD,
                center,
                0.5 * size,
                Bound::Relative(1e-4),
            );
        }
    }

    /// Upright disks that all but touch the surface point, and the point near their rims.
    fn contact(&mut self, count: usize) {
        for i in 0..count {
            let gap = 10_f64.powf(-1.0 - 5.0 * i as f64 / (count - 1) as f64);
            let (width, height) = (self.random.log(0.2, 5.0), self.random.log(0.2, 5.0));
            let (x, z) = (self.random.between(-0.9, 0.9), self.random.between(-0.4, 0.4));
            let local = [DVec3::new(x * width, gap, z * height), DVec3::X * width, DVec3::Z * height];
            let slack = 1e-7 / gap;
            self.disk("disk, standing on the surface", &STANDARD, local, Bound::Absolute(2e-6), slack);
            let axes = frame(self.random.direction());
            self.disk("disk, standing on a turned surface", &axes, local, Bound::Absolute(2e-6), slack);
        }
    }

    fn rim(&mut self, count: usize) {
        for i in 0..count {
            let gap = 10_f64.powf(-1.0 - 4.0 * i as f64 / (count - 1) as f64);
            let axes = self.axes();
            let [x, y, z] = frame(self.random.direction());
            let aspect = self.random.log(0.2, 1.0);
            let (sine, cosine) = self.random.between(0.0, core::f64::consts::TAU).sin_cos();
            let rim = x * cosine + y * (sine * aspect);
            let toward = self.random.direction() * gap;
            if toward.dot(z).abs() < 0.1 * gap {
                continue;
            }
            let local = [toward - rim, x, y * aspect];
            let bound = Bound::Absolute(1e-6 + 6e-7 / gap);
            self.disk("disk, the rim passes close by", &axes, local, bound, 4e-6 / gap);
        }
    }

    fn ceiling(&mut self, count: usize) {
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

    fn slender(&mut self, count: usize) {
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

    fn edge_on(&mut self, count: usize) {
        for i in 0..count {
            let lift = 10_f64.powf(-1.0 - 6.0 * i as f64 / (count - 1) as f64);
            let axes = self.axes();
            let [x, y, z] = frame(self.random.direction());
            let away = self.random.log(1.2, 20.0);
            let (sine, cosine) = self.random.between(0.0, core::f64::consts::TAU).sin_cos();
            let local = [(x * cosine + y * sine) * away + z * lift, x, y];
            self.disk("disk, edge-on", &axes, local, Bound::Absolute(1e-6), 0.0);
        }
    }

    fn dark(&mut self, count: usize) {
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
            self.disk("without area", &STANDARD, [center, DVec3::ZERO, axis], Bound::Zero, 0.0);
            self.disk("without area", &STANDARD, [center, axis, DVec3::ZERO], Bound::Zero, 0.0);
            self.disk("without area", &STANDARD, [center, DVec3::ZERO, DVec3::ZERO], Bound::Zero, 0.0);
            self.disk(
                "without area, but for rounding",
                &STANDARD,
                [center, axis, parallel],
                Bound::Physical,
                0.0,
            );
            self.sphere("without area", &STANDARD, center, 0.0, Bound::Zero);
            self.disk("in the light's plane", &STANDARD, [DVec3::ZERO, axis, center], Bound::Zero, 0.0);
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
                self.sphere("sphere, all but touched", &STANDARD, center, 1.0, bound);
                if let Some(case) = self.cases.last_mut() {
                    let alpha = f64::from(case.roughness.clamp(0.02, 1.0)).powi(2);
                    case.slack = 4e-8 / (gap.sqrt() * alpha);
                }
            }
        }
    }

    fn extreme(&mut self, count: usize) {
        for i in 0..count {
            let mut number = || match i % 3 {
                0 => self.random.finite(),
                1 => [f32::MAX, -f32::MAX, 0.0, -0.0, 1e-45, f32::MIN_POSITIVE, 1.0, 1e30]
                    [self.random.index(8)],
                _ => (self.random.between(-1.0, 1.0) * self.random.log(1e-30, 1e30)) as f32,
            };
            let mut vector = || Vec3::new(number(), number(), number());
            let [position, normal, view, center, half_x, half_y] = [0; 6].map(|_| vector());
            let (radius, roughness) = (number(), number());
            if normal == Vec3::ZERO || view == Vec3::ZERO {
                continue;
            }
            for shape in [
                Shape::Disk { center, half_x, half_y, two_sided: i % 2 == 0 },
                Shape::Disk { center: position, half_x, half_y, two_sided: true },
                Shape::Disk { center, half_x: center, half_y, two_sided: true },
                Shape::Sphere { center, radius },
            ] {
                self.cases.push(Case {
                    family: "any bits",
                    position,
                    normal,
                    view,
                    roughness,
                    shape,
                    bound: Bound::Physical,
                    slack: 0.0,
                });
            }
        }
    }
}

/// All families, `count` of each.
pub fn cases(count: usize) -> Vec<Case> {
    let mut builder = Builder { random: Random::new(20), cases: Vec::new() };
    builder.ordinary(4 * count);
    builder.distant(2 * count);
    builder.horizon(count);
    builder.contact(count);
    builder.rim(count);
    builder.ceiling(count);
    builder.slender(2 * count);
    builder.edge_on(count);
    builder.dark(count);
    builder.spheres(2 * count);
    builder.extreme(10 * count);
    builder.cases
}
