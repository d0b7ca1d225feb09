//! The families of inputs.

use glam::{DVec3, Vec3};

use softbox::device::EvaluateLight;

use super::{Bound, Case, Random, perpendicular};

/// A quad so close that single precision no longer tells its edge's direction in the lobe's space: there
/// specular light may be that of the other side.
pub const TOUCHING: &str = "standing on the surface, less than 4e-7 away";

/// An orthonormal frame with the given third axis.
pub fn frame(normal: DVec3) -> [DVec3; 3] {
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    [tangent, bitangent, normal]
}

fn place(axes: &[DVec3; 3], v: DVec3) -> DVec3 {
    axes[0] * v.x + axes[1] * v.y + axes[2] * v.z
}

fn upper(random: &mut Random) -> DVec3 {
    let direction = random.direction();
    DVec3::new(direction.x, direction.y, direction.z.abs())
}

/// Roughness with its ends and the floor's surroundings among the ordinary values.
fn roughness(random: &mut Random) -> f32 {
    match random.index(10) {
        0 => 0.0,
        1 => 1.0,
        2 => random.log(1e-4, 0.1) as f32,
        _ => random.unit() as f32,
    }
}

/// A view with the exact normal, its neighbourhood, the horizon and directions below it among the
/// ordinary ones.
fn view(random: &mut Random, axes: &[DVec3; 3]) -> Vec3 {
    let around = random.direction();
    let local = match random.index(10) {
        0 => DVec3::Z,
        1 => DVec3::Z + around * random.log(1e-8, 1e-2),
        2 => DVec3::new(around.x, around.y, around.z * random.log(1e-8, 1e-2)),
        3 => DVec3::new(around.x, around.y, -around.z.abs()),
        _ => upper(random),
    };
    (place(axes, local) * random.log(0.1, 10.0)).as_vec3()
}

/// The corners of a parallelogram, counter-clockwise seen from `facing`.
fn parallelogram(centre: DVec3, x: DVec3, y: DVec3, facing: DVec3) -> [DVec3; 4] {
    let (x, y) = if x.cross(y).dot(facing) >= 0.0 { (x, y) } else { (y, x) };
    [centre - x - y, centre + x - y, centre + x + y, centre - x + y]
}

struct Builder {
    random: Random,
    cases: Vec<Case>,
}

impl Builder {
    fn add(
        &mut self,
        family: &'static str,
        axes: &[DVec3; 3],
        position: DVec3,
        local: &[DVec3],
        bound: Bound,
    ) {
        let view = view(&mut self.random, axes);
        let roughness = roughness(&mut self.random);
        let length = self.random.log(0.1, 10.0);
        let two_sided = bound != Bound::Zero && self.random.index(4) == 0;
        let vertices: Vec<Vec3> = local.iter().map(|v| (position + place(axes, *v)).as_vec3()).collect();
        let mut case = Case {
            family,
            position: position.as_vec3(),
            normal: (axes[2] * length).as_vec3(),
            view,
            roughness,
            quad: vertices.len() == 4,
            kind: 0,
            radius: 0.0,
            vertices,
            two_sided,
            bound,
            form_factor: None,
            specular_slack: 0.0,
        };
        if let Bound::Absolute(bound) = case.bound {
            // The contact families are exact in their coordinates and keep their bound.
            let wider = 4e-8 * edge_ratio(&case);
            if !family.starts_with("standing on the surface") && wider > bound {
                case.family = "an edge passes close by";
                case.bound = Bound::Absolute(wider);
                case.specular_slack = wider;
            }
        }
        self.cases.push(case.clone());
        // Every quad is a polygon too.
        if case.quad {
            case.quad = false;
            self.cases.push(case);
        }
    }

    fn axes(&mut self) -> [DVec3; 3] {
        if self.random.index(2) == 0 {
            [DVec3::X, DVec3::Y, DVec3::Z]
        } else {
            let normal = self.random.direction();
            frame(normal)
        }
    }

    /// Parallelograms and other convex quads of every size down to a tenth of the distance.
    fn ordinary(&mut self, count: usize) {
        for _ in 0..count {
            let axes = self.axes();
            let position = self.random.direction() * self.random.between(0.0, 2.0);
            let distance = self.random.log(0.2, 20.0);
            let size = distance * self.random.log(0.1, 30.0);
            let centre = self.random.direction() * distance;
            let (x, y) = (self.random.direction() * size, self.random.direction() * size);
            let facing = -centre * if self.random.index(5) == 0 { -1.0 } else { 1.0 };
            let mut corners = parallelogram(centre, x, y, facing);
            // Moving corners along their edges keeps the quad planar and convex.
            if self.random.index(2) == 0 {
                let share = self.random.between(0.0, 0.9);
                corners[1] = corners[1].lerp(corners[0], share);
                let share = self.random.between(0.0, 0.9);
                corners[3] = corners[3].lerp(corners[0], share);
            }
            self.add(
                "size at least a tenth of the distance",
                &axes,
                position,
                &corners,
                Bound::Absolute(1e-6),
            );
        }
    }

    fn distant(&mut self, count: usize) {
        let mut left = count;
        while left > 0 {
            let axes = self.axes();
            let aligned = axes[2] == DVec3::Z;
            let direction = upper(&mut self.random);
            let size = self.random.log(1e-5, 0.1);
            // A rounded normal leaves the horizon itself uncertain by 1e-7 of the distance.
            if direction.z < if aligned { 2.0 * size } else { 3e-3 } {
                continue;
            }
            let (x, y) = (self.random.direction(), self.random.direction());
            let facing = x.cross(y);
            if facing.dot(direction).abs() < 0.1 {
                continue;
            }
            left -= 1;
            let distance = self.random.log(1e-3, 1e3);
            let half = 0.5 * size * distance;
            let corners = parallelogram(direction * distance, x * half, y * half, -direction);
            self.add("distant", &axes, DVec3::ZERO, &corners, Bound::Relative(1e-4));
        }
        // On the horizon, where the frame is exact.
        for _ in 0..count / 10 {
            let axes = [DVec3::X, DVec3::Y, DVec3::Z];
            let size = self.random.log(1e-5, 0.1);
            let azimuth = self.random.between(0.0, core::f64::consts::TAU);
            let height = size * self.random.between(-0.2, 0.2);
            let centre = DVec3::new(azimuth.cos(), azimuth.sin(), height);
            let side = DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0);
            let tilt = side * self.random.between(-0.3, 0.3) + DVec3::Z;
            let corners = parallelogram(centre, side * (0.5 * size), tilt * (0.5 * size), -centre);
            self.add("distant, on the horizon", &axes, DVec3::ZERO, &corners, Bound::Relative(1e-4));
        }
    }

    fn contact(&mut self, count: usize) {
        for i in 0..count {
            let gap = 10_f64.powf(-1.0 - 6.0 * i as f64 / (count - 1) as f64);
            let (width, height) = (self.random.log(0.2, 5.0), self.random.log(0.2, 5.0));
            let depth = if i % 3 == 0 { self.random.log(0.01, 2.0) } else { 0.0 };
            let turn = i % 4;
            let corners = [
                DVec3::new(-width, gap, -depth),
                DVec3::new(width, gap, -depth),
                DVec3::new(width, gap, height),
                DVec3::new(-width, gap, height),
            ]
            .map(|v| match turn {
                0 => v,
                1 => DVec3::new(-v.y, v.x, v.z),
                2 => DVec3::new(-v.x, -v.y, v.z),
                _ => DVec3::new(v.y, -v.x, v.z),
            });
            let axes = [DVec3::X, DVec3::Y, DVec3::Z];
            let before = self.cases.len();
            let family = if gap < 4e-7 { TOUCHING } else { "standing on the surface" };
            self.add(family, &axes, DVec3::ZERO, &corners, Bound::Absolute(2e-6));
            let gap = f64::from(gap as f32);
            let (width, height) = (f64::from(width as f32), f64::from(height as f32));
            for case in &mut self.cases[before..] {
                case.form_factor = Some(2.0 * perpendicular(width, height, gap));
                case.specular_slack = 1e-10 / gap;
            }
        }
    }

    /// The same in any orientation, where the vertices' rounding moves the light by 1e-7 of its size: the
    /// bound follows the gap.
    fn turned_contact(&mut self, count: usize) {
        for i in 0..count {
            let gap = 10_f64.powf(-1.0 - 4.0 * i as f64 / (count - 1) as f64);
            let (width, height) = (self.random.log(0.2, 2.0), self.random.log(0.2, 2.0));
            let corners = [(-1.0, 0.0), (1.0, 0.0), (1.0, 1.0), (-1.0, 1.0)]
                .map(|(x, z)| DVec3::new(width * x, gap, height * z));
            let normal = self.random.direction();
            let axes = frame(normal);
            let before = self.cases.len();
            self.add("standing on a turned surface", &axes, DVec3::ZERO, &corners, Bound::Absolute(1e-6));
            for case in &mut self.cases[before..] {
                case.family = "standing on a turned surface";
                case.bound = Bound::Absolute(2e-6 + 4e-10 / gap);
                case.specular_slack = 1e-8 / gap;
            }
        }
    }

    /// Distant lights on the horizon of any surface, whose rounded normal leaves that horizon uncertain by
    /// 1e-7 of the distance: the bound follows the light's size.
    fn turned_horizon(&mut self, count: usize) {
        for _ in 0..count {
            let normal = self.random.direction();
            let axes = frame(normal);
            let size = self.random.log(1e-5, 0.1);
            let azimuth = self.random.between(0.0, core::f64::consts::TAU);
            let side = DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0) * (0.5 * size);
            let height = size * self.random.between(-0.2, 0.2);
            let centre = DVec3::new(azimuth.cos(), azimuth.sin(), height);
            let corners = parallelogram(centre, side, DVec3::Z * (0.5 * size), -centre);
            let bound = Bound::Relative(1e-4 + 2e-6 / size);
            self.add("distant, on a turned horizon", &axes, DVec3::ZERO, &corners, bound);
        }
    }

    fn ceiling(&mut self, count: usize) {
        for i in 0..count {
            let height = 10_f64.powf(-6.0 * i as f64 / (count - 1) as f64);
            let extent = [self.random.log(0.3, 3.0), self.random.log(0.3, 3.0)];
            let large = if i % 2 == 0 { 1.0 } else { self.random.log(1.0, 1e6 * height.max(1e-6)).max(1.0) };
            let axes = self.axes();
            let (x, y) = (DVec3::X * extent[0] * large, DVec3::Y * extent[1] * large);
            let aside = DVec3::new(
                extent[0] * large * self.random.between(-1.5, 1.5),
                extent[1] * large * self.random.between(-1.5, 1.5),
                height,
            );
            let corners = parallelogram(aside, x, y, -DVec3::Z);
            let axes = if height < 1e-3 { [DVec3::X, DVec3::Y, DVec3::Z] } else { axes };
            self.add("ceiling", &axes, DVec3::ZERO, &corners, Bound::Absolute(2e-6));
        }
        for _ in 0..count {
            let size = self.random.log(10.0, 1e6);
            let axes = [DVec3::X, DVec3::Y, DVec3::Z];
            let facing = upper(&mut self.random);
            let [x, y, _] = frame(facing);
            let aside = x * self.random.between(-1.2, 1.2) + y * self.random.between(-1.2, 1.2);
            let corners = parallelogram(facing + aside * size, x * size, y * size, -facing);
            self.add("a million times the distance", &axes, DVec3::ZERO, &corners, Bound::Absolute(2e-6));
        }
    }

    fn dark(&mut self, count: usize) {
        for _ in 0..count {
            let axes = self.axes();
            let size = self.random.log(1e-4, 1e3);
            let margin = self.random.log(1e-3, 1.0);
            let (x, y) = (self.random.direction() * size, self.random.direction() * size);
            let reach = x.z.abs() + y.z.abs();
            let aside = self.random.direction() * size;
            let centre = DVec3::new(aside.x, aside.y, -reach - margin * (size + 1.0));
            let corners = parallelogram(centre, x, y, -centre);
            self.add("below the horizon", &axes, DVec3::ZERO, &corners, Bound::Zero);
        }
        for _ in 0..count {
            let axes = self.axes();
            let size = self.random.log(1e-4, 1e3);
            let facing = self.random.direction();
            let [x, y, _] = frame(facing);
            let away = facing * self.random.log(1e-3, 10.0)
                + x * size * self.random.between(-1.0, 1.0)
                + y * size * self.random.between(-1.0, 1.0);
            if facing.dot(away) < 1e-3 * (size + away.length()) {
                continue;
            }
            let corners = parallelogram(away, x * size, y * size, facing);
            self.add("seen from behind", &axes, DVec3::ZERO, &corners, Bound::Zero);
        }
    }

    fn degenerate(&mut self, count: usize) {
        let standard = [DVec3::X, DVec3::Y, DVec3::Z];
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
            self.add("degenerate", &standard, DVec3::ZERO, &corners, Bound::Physical);
        }
    }

    fn extreme(&mut self, count: usize) {
        for i in 0..count {
            let vertices: Vec<Vec3> = (0..3 + i % 5)
                .map(|_| match i % 3 {
                    0 => Vec3::new(self.random.finite(), self.random.finite(), self.random.finite()),
                    1 => {
                        let scale = self.random.log(1e-38, 3e38);
                        (self.random.direction() * scale).as_vec3()
                    }
                    _ => {
                        Vec3::new(f32::MAX, -f32::MAX, f32::MIN_POSITIVE)
                            * self.random.between(-1.0, 1.0) as f32
                    }
                })
                .collect();
            let nonzero = |v: Vec3| if v == Vec3::ZERO { Vec3::Z } else { v };
            let normal = Vec3::new(self.random.finite(), self.random.finite(), self.random.finite());
            let view = Vec3::new(self.random.finite(), self.random.finite(), self.random.finite());
            let position = match i % 4 {
                0 => Vec3::ZERO,
                1 => Vec3::new(self.random.finite(), self.random.finite(), self.random.finite()),
                2 => vertices[0],
                _ => -vertices[0],
            };
            self.cases.push(Case {
                family: "any finite numbers",
                position,
                normal: nonzero(normal),
                view: nonzero(view),
                roughness: self.random.unit() as f32,
                quad: vertices.len() == 4,
                kind: 0,
                radius: 0.0,
                vertices,
                two_sided: i % 2 == 0,
                bound: Bound::Physical,
                form_factor: None,
                specular_slack: 0.0,
            });
        }
    }

    /// Disks, spheres and tubes, each family in turn; the hard cases of these lights have tests of their own.
    fn round(&mut self, count: usize) {
        for i in 0..count {
            let axes = self.axes();
            let distance = self.random.log(0.3, 5.0);
            let position = self.random.direction() * self.random.between(0.0, 1.0);
            let centre = position + self.random.direction() * distance;
            let size = distance * self.random.log(0.1, 0.8);
            let (x, y) = (self.random.direction() * size, self.random.direction() * size);
            let (family, kind, vectors, radius) = match i % 3 {
                0 => ("disk", EvaluateLight::DISK, vec![centre, x, y], 0.0),
                1 => ("sphere", EvaluateLight::SPHERE, vec![centre], size),
                _ => ("tube", EvaluateLight::TUBE, vec![centre - x, centre + x], 0.05 * size),
            };
            self.cases.push(Case {
                family,
                position: position.as_vec3(),
                normal: axes[2].as_vec3(),
                view: view(&mut self.random, &axes),
                roughness: roughness(&mut self.random),
                quad: false,
                kind,
                radius: radius as f32,
                vertices: vectors.iter().map(|v| v.as_vec3()).collect(),
                two_sided: self.random.index(2) == 0,
                bound: Bound::Absolute(2e-6),
                form_factor: None,
                specular_slack: 0.0,
            });
        }
    }

    fn extreme_round(&mut self, count: usize) {
        for i in 0..count {
            let mut vector = || Vec3::new(self.random.finite(), self.random.finite(), self.random.finite());
            let (kind, vectors) = match i % 3 {
                0 => (EvaluateLight::DISK, vec![vector(), vector(), vector()]),
                1 => (EvaluateLight::SPHERE, vec![vector()]),
                _ => (EvaluateLight::TUBE, vec![vector(), vector()]),
            };
            let (position, normal, view) = (vector(), vector(), vector());
            let nonzero = |v: Vec3| if v == Vec3::ZERO { Vec3::Z } else { v };
            self.cases.push(Case {
                family: "any finite numbers for a round light",
                position,
                normal: nonzero(normal),
                view: nonzero(view),
                roughness: self.random.unit() as f32,
                quad: false,
                kind,
                radius: self.random.finite().abs(),
                vertices: vectors,
                two_sided: i % 2 == 0,
                bound: Bound::Physical,
                form_factor: None,
                specular_slack: 0.0,
            });
        }
    }

    /// Simple polygons, most of them not convex: stars around a centre in a plane.
    fn polygons(&mut self, count: usize) {
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
                    let azimuth = core::f64::consts::TAU * k as f64 / vertices as f64;
                    let radius = size * self.random.between(0.2, 1.0);
                    centre + x * (radius * azimuth.cos()) + y * (radius * azimuth.sin())
                })
                .collect();
            if corners.len() != 4 {
                self.add("simple polygon", &axes, DVec3::ZERO, &corners, Bound::Absolute(2e-6));
            }
        }
    }
}

/// The largest ratio, over all edges, of the farther end's distance to the edge's own.
fn edge_ratio(case: &Case) -> f64 {
    let count = case.vertices.len();
    (0..count)
        .map(|i| {
            let a = case.vertices[i].as_dvec3() - case.position.as_dvec3();
            let b = case.vertices[(i + 1) % count].as_dvec3() - case.position.as_dvec3();
            let along = (b - a).normalize_or_zero();
            let nearest = a - along * a.dot(along).clamp(-(b - a).length(), 0.0);
            a.length().max(b.length()) / nearest.length()
        })
        .fold(1.0, f64::max)
}

/// All inputs: about `scale` × 1000 ordinary ones and the hard families.
pub fn cases(scale: usize) -> Vec<Case> {
    let mut builder = Builder { random: Random::new(0x50F7_B0C5), cases: Vec::new() };
    builder.ordinary(500 * scale);
    builder.round(150 * scale);
    builder.extreme_round(60 * scale);
    builder.distant(100 * scale);
    builder.contact(10 * scale + 2);
    builder.turned_contact(5 * scale + 2);
    builder.turned_horizon(5 * scale);
    builder.ceiling(10 * scale + 2);
    builder.dark(20 * scale);
    builder.degenerate(20 * scale);
    builder.extreme(20 * scale);
    builder.polygons(20 * scale);
    builder.cases
}
