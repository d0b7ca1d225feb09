//! Inputs that every form of the include has to survive, with the bound that holds for each.
#![allow(dead_code, reason = "each test file uses a part of this module")]

pub mod tools;

use glam::{DVec3, Vec3};
use softbox::device::{Batch, EvaluateLight, EvaluateSurface};
use softbox::shade::{
    Real, Vector, ltc_polygon_add, ltc_polygon_begin, ltc_polygon_end, ltc_quad, ltc_surface,
};
use softbox::table::Table;

/// Numbers that look random and are the same on every run (Steele et al. 2014, SplitMix64).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in 0…1.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in the logarithm.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub fn index(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    pub fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let azimuth = self.between(0.0, core::f64::consts::TAU);
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z)
    }

    /// Any finite f32, all bit patterns alike.
    pub fn finite(&mut self) -> f32 {
        loop {
            let value = f32::from_bits(self.next() as u32);
            if value.is_finite() {
                return value;
            }
        }
    }
}

/// What must hold for a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// The form factor is within this of exact arithmetic.
    Absolute(f64),
    /// The form factor is within this share of its value of exact arithmetic.
    Relative(f64),
    /// All three numbers are exactly zero.
    Zero,
    /// Finite, and within what physics allows.
    Physical,
}

/// A surface, a light and what must hold. Coordinates are f32, so every form sees the same input.
#[derive(Clone, Debug)]
pub struct Case {
    pub family: &'static str,
    pub position: Vec3,
    pub normal: Vec3,
    pub view: Vec3,
    pub roughness: f32,
    pub vertices: Vec<Vec3>,
    pub two_sided: bool,
    /// Hand it to the quad functions.
    pub quad: bool,
    pub bound: Bound,
    /// The form factor where a closed form knows it better than exact arithmetic on rounded input.
    pub form_factor: Option<f64>,
    /// What the light's closeness adds to the error that specular light may have.
    pub specular_slack: f64,
}

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
                case.bound = Bound::Absolute(2e-6 + 2e-10 / gap);
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
                vertices,
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

/// F of a rectangle that stands on the surface with a lower corner at the foot of the
/// perpendicular: width along the surface, height over it, gap between point and rectangle
/// (Hamilton and Morgan 1952; Howell's catalogue, B-4).
pub fn perpendicular(width: f64, height: f64, gap: f64) -> f64 {
    let hypotenuse = (height * height + gap * gap).sqrt();
    ((width / gap).atan() - gap / hypotenuse * (width / hypotenuse).atan()) / core::f64::consts::TAU
}

/// All inputs: about `scale` × 1000 ordinary ones and the hard families.
pub fn cases(scale: usize) -> Vec<Case> {
    let mut builder = Builder { random: Random::new(0x50F7_B0C5), cases: Vec::new() };
    builder.ordinary(500 * scale);
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

/// The value of a case by the twin.
pub fn twin<R: Real>(table: &Table, case: &Case) -> [f64; 3] {
    let v = |v: Vec3| R::Vec3::new(R::new(v.x.into()), R::new(v.y.into()), R::new(v.z.into()));
    let roughness = R::new(case.roughness.into());
    let surface = ltc_surface::<R>(v(case.position), v(case.normal), v(case.view), roughness);
    let lobe = table.lobe(&surface);
    let value = if case.quad {
        let corners = core::array::from_fn(|i| v(case.vertices[i]));
        ltc_quad(&surface, &lobe, corners, case.two_sided)
    } else {
        let mut polygon = ltc_polygon_begin(&surface, v(case.vertices[0]));
        for vertex in &case.vertices[1..] {
            ltc_polygon_add(&mut polygon, &surface, &lobe, v(*vertex));
        }
        ltc_polygon_end(&mut polygon, &surface, &lobe, case.two_sided)
    };
    [value.x(), value.y(), value.z()].map(Real::to_f64)
}

/// The albedo of the lobe that a case is shaded with.
pub fn albedo(table: &Table, case: &Case) -> f64 {
    let v = |v: Vec3| v.as_dvec3();
    let surface = ltc_surface::<f64>(v(case.position), v(case.normal), v(case.view), case.roughness.into());
    table.lobe(&surface).albedo
}

/// The cases as buffers of the evaluation kernel, one surface and one light each.
pub fn batch(cases: &[Case]) -> Batch {
    let mut batch = Batch::default();
    for (index, case) in cases.iter().enumerate() {
        batch.surfaces.push(EvaluateSurface {
            position: case.position.into(),
            roughness: case.roughness,
            normal: case.normal.into(),
            view: case.view.into(),
            ..EvaluateSurface::default()
        });
        let vertices: Vec<[f32; 3]> = case.vertices.iter().map(|v| (*v).into()).collect();
        let flags = u32::from(case.two_sided) * EvaluateLight::TWO_SIDED
            + u32::from(case.quad) * EvaluateLight::CONVEX_QUAD;
        let light = batch.add_light(&vertices, flags);
        batch.pairs.push([index as u32, light]);
    }
    batch
}

/// How far specular light may be from exact arithmetic: rounding moves a light by so much in the space of
/// a lobe that is α wide, and 1 / cos θ times as sensitive seen at a grazing angle.
fn specular_bound(case: &Case) -> f64 {
    let bounded = matches!(case.bound, Bound::Absolute(_) | Bound::Relative(_)) && case.family != TOUCHING;
    if !bounded {
        return f64::INFINITY;
    }
    let alpha = f64::from(case.roughness.clamp(0.02, 1.0)).powi(2);
    let cosine = case.view.as_dvec3().normalize().dot(case.normal.as_dvec3().normalize());
    4e-6 / (alpha * cosine.max(1e-9)) + case.specular_slack
}

/// A quad so close that single precision no longer tells its edge's direction in the lobe's space: there
/// specular light may be that of the other side.
const TOUCHING: &str = "standing on the surface, less than 4e-7 away";

/// Checks values against the bounds and exact arithmetic (the twin in f64, or a closed form).
/// Returns the worst form-factor error of each family; panics with the first offenders.
pub fn check(what: &str, cases: &[Case], exact: &[[f64; 3]], values: &[[f32; 3]], table: &Table) {
    assert_eq!(cases.len(), values.len(), "{what}: one value for each case");
    let mut worst: std::collections::BTreeMap<&str, (f64, usize)> = std::collections::BTreeMap::new();
    let mut offenders = Vec::new();
    for (i, ((case, exact), value)) in cases.iter().zip(exact).zip(values).enumerate() {
        let [diffuse, specular, fresnel] = value.map(f64::from);
        let reference = case.form_factor.unwrap_or(exact[0]);
        let difference = (diffuse - reference).abs();
        let error = match case.bound {
            Bound::Absolute(_) => difference,
            Bound::Relative(_) => difference / reference,
            Bound::Zero => diffuse.max(specular).max(fresnel),
            Bound::Physical => 0.0,
        };
        let limit = match case.bound {
            Bound::Absolute(bound) | Bound::Relative(bound) => bound,
            Bound::Zero | Bound::Physical => 0.0,
        };
        // One rounding of the table's own interpolation may separate device and twin.
        let albedo = albedo(table, case) * (1.0 + 1e-6);
        let physical = (0.0..=1.0).contains(&diffuse)
            && (0.0..=albedo).contains(&specular)
            && (0.0..=specular * (1.0 + 1e-6)).contains(&fresnel);
        let within = error <= limit
            && (specular - exact[1]).abs() <= specular_bound(case)
            && (fresnel - exact[2]).abs() <= specular_bound(case);
        if !physical || !within {
            offenders.push((i, error));
        }
        let entry = worst.entry(case.family).or_insert((0.0, i));
        if error > entry.0 || error.is_nan() {
            *entry = (error, i);
        }
    }
    for (family, (error, index)) in &worst {
        let count = cases.iter().filter(|case| case.family == *family).count();
        println!("{what}: {family}: worst of {count} {error:.2e} at {index} ({:?})", cases[*index].bound);
    }
    if !offenders.is_empty() {
        let shown: Vec<String> = offenders
            .iter()
            .enumerate()
            .filter(|(k, (i, _))| *k < 3 || cases[*i].family != cases[offenders[k - 3].0].family)
            .take(20)
            .map(|(_, (i, error))| {
                format!(
                    "value {:?}, exact {:?}, error {error:e}, input {i}: {:?}",
                    values[*i], exact[*i], cases[*i]
                )
            })
            .collect();
        panic!(
            "{what}: {} of {} cases beyond their bounds:\n{}",
            offenders.len(),
            cases.len(),
            shown.join("\n")
        );
    }
}
