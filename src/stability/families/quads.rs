//! Quads, each of them as a polygon too.

use glam::{DVec3, Vec3};

use super::{Axes, Builder, STANDARD, edge_ratio, frame, parallelogram, perpendicular, place};
use crate::stability::{Bound, Case, Shape};

/// A quad so close that single precision no longer tells its edge's direction in the lobe's space: there
/// specular light may be that of the other side.
pub(super) const TOUCHING: f64 = 4e-7;

/// How far specular light of a quad or polygon may be from exact arithmetic: rounding moves a light by so much in the
/// space of a lobe that is α wide, and 1 / cos θ times as sensitive seen at a grazing angle. `slack` is what the light's
/// closeness adds.
pub(super) fn specular_bound(case: &Case, slack: f64) -> f64 {
    let base = match (case.bound, &case.shape) {
        // A distant light is small, and so is its error.
        (Bound::Relative(_), _) => 4e-8,
        // An outline takes its points on the horizon one by one and measures all of them from the first.
        (Bound::Absolute(_), Shape::Polygon { .. }) => 8e-6,
        (Bound::Absolute(_), _) => 4e-6,
        _ => return f64::INFINITY,
    };
    base / case.sharpness() + slack
}

impl Builder {
    /// Adds a polygon, given in the frame of the surface, and where it is a quad, as such before.
    pub(super) fn polygon(
        &mut self,
        family: &'static str,
        axes: &Axes,
        position: DVec3,
        local: &[DVec3],
        bound: Bound,
    ) -> &mut [Case] {
        let vertices: Vec<Vec3> = local.iter().map(|v| (position + place(axes, *v)).as_vec3()).collect();
        let shape = Shape::Polygon { vertices: vertices.clone(), two_sided: false };
        let mut case = self.case(family, axes, position, shape, bound);
        let two_sided = bound != Bound::Zero && self.random.index(4) == 0;
        case.shape = Shape::Polygon { vertices: vertices.clone(), two_sided };
        let mut slack = 0.0;
        if let Bound::Absolute(bound) = case.bound {
            // The contact families are exact in their coordinates and keep their bound.
            let wider = 4e-8 * edge_ratio(&case.seen());
            if !family.starts_with("standing on") && wider > bound {
                case.family = "an edge passes close by";
                case.bound = Bound::Absolute(wider);
                slack = wider;
            }
        }
        let before = self.cases.len();
        if let [a, b, c, d] = vertices[..] {
            let shape = Shape::Quad { corners: [a, b, c, d], two_sided };
            self.cases.push(Case { shape, ..case.clone() });
        }
        self.cases.push(case);
        for case in &mut self.cases[before..] {
            if let (Shape::Polygon { .. }, Bound::Absolute(bound)) = (&case.shape, &mut case.bound) {
                // An outline is not known as a whole when its first edges are summed.
                *bound *= 2.0;
            }
            case.specular_bound = specular_bound(case, slack);
        }
        &mut self.cases[before..]
    }

    pub(super) fn quads(&mut self, scale: usize) {
        self.ordinary(500 * scale);
        self.distant(100 * scale);
        self.contact(10 * scale + 2);
        self.turned_contact(5 * scale + 2);
        self.turned_horizon(5 * scale);
        self.ceiling(10 * scale + 2);
        self.dark(20 * scale);
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
            let family = "size at least a tenth of the distance";
            self.polygon(family, &axes, position, &corners, Bound::Absolute(1e-6));
        }
    }

    fn distant(&mut self, count: usize) {
        let mut left = count;
        while left > 0 {
            let axes = self.axes();
            let aligned = axes[2] == DVec3::Z;
            let direction = self.random.upper();
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
            self.polygon("distant", &axes, DVec3::ZERO, &corners, Bound::Relative(1e-4));
        }
        // On the horizon, where the frame is exact.
        for _ in 0..count / 10 {
            let size = self.random.log(1e-5, 0.1);
            let azimuth = self.random.between(0.0, core::f64::consts::TAU);
            let height = size * self.random.between(-0.2, 0.2);
            let centre = DVec3::new(azimuth.cos(), azimuth.sin(), height);
            let side = DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0);
            let tilt = side * self.random.between(-0.3, 0.3) + DVec3::Z;
            let corners = parallelogram(centre, side * (0.5 * size), tilt * (0.5 * size), -centre);
            let family = "distant, on the horizon";
            self.polygon(family, &STANDARD, DVec3::ZERO, &corners, Bound::Relative(1e-4));
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
            let touching = gap < TOUCHING;
            let family = if touching {
                "standing on the surface, less than 4e-7 away"
            } else {
                "standing on the surface"
            };
            let gap = f64::from(gap as f32);
            let (width, height) = (f64::from(width as f32), f64::from(height as f32));
            for case in self.polygon(family, &STANDARD, DVec3::ZERO, &corners, Bound::Absolute(2e-6)) {
                case.form_factor = Some(2.0 * perpendicular(width, height, gap));
                case.specular_bound =
                    if touching { f64::INFINITY } else { specular_bound(case, 4e-10 / gap) };
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
            let axes = frame(self.random.direction());
            let family = "standing on a turned surface";
            let bound = Bound::Absolute(2e-6 + 4e-10 / gap);
            for case in self.polygon(family, &axes, DVec3::ZERO, &corners, bound) {
                case.specular_bound = specular_bound(case, 2e-8 / gap);
            }
        }
    }

    /// Distant lights on the horizon of any surface, whose rounded normal leaves that horizon uncertain by
    /// 1e-7 of the distance: the bound follows the light's size.
    fn turned_horizon(&mut self, count: usize) {
        for _ in 0..count {
            let axes = frame(self.random.direction());
            let size = self.random.log(1e-5, 0.1);
            let azimuth = self.random.between(0.0, core::f64::consts::TAU);
            let side = DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0) * (0.5 * size);
            let height = size * self.random.between(-0.2, 0.2);
            let centre = DVec3::new(azimuth.cos(), azimuth.sin(), height);
            let corners = parallelogram(centre, side, DVec3::Z * (0.5 * size), -centre);
            let bound = Bound::Relative(1e-4 + 2e-6 / size);
            self.polygon("distant, on a turned horizon", &axes, DVec3::ZERO, &corners, bound);
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
            let axes = if height < 1e-3 { STANDARD } else { axes };
            self.polygon("ceiling", &axes, DVec3::ZERO, &corners, Bound::Absolute(2e-6));
        }
        for _ in 0..count {
            let size = self.random.log(10.0, 1e6);
            let facing = self.random.upper();
            let [x, y, _] = frame(facing);
            let aside = x * self.random.between(-1.2, 1.2) + y * self.random.between(-1.2, 1.2);
            let corners = parallelogram(facing + aside * size, x * size, y * size, -facing);
            let family = "a million times the distance";
            for case in self.polygon(family, &STANDARD, DVec3::ZERO, &corners, Bound::Absolute(2e-6)) {
                case.specular_bound *= 2.0;
            }
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
            self.polygon("below the horizon", &axes, DVec3::ZERO, &corners, Bound::Zero);
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
            self.polygon("seen from behind", &axes, DVec3::ZERO, &corners, Bound::Zero);
        }
    }
}
