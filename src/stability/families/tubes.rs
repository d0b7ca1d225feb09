//! Tubes.

use core::f64::consts::TAU;

use glam::DVec3;

use super::{Builder, STANDARD, frame, place};
use crate::stability::{Bound, Case, Shape};

/// Bounds on the errors of the form factor and of specular light of a tube.
///
/// Both grow with the angles under which the tube's width and length are seen, and with the ratio of its farther end's
/// distance to its own, for coordinates have digits to so much. Specular light is 1 / α as sensitive, and
/// 1 / cos θ times that seen at a grazing angle.
pub(in crate::stability) fn bounds(case: &Case) -> (f64, f64) {
    let Shape::Tube { start, end, radius, caps } = case.shape else { return (0.0, f64::INFINITY) };
    let radius = f64::from(radius);
    let [start, end] = [start, end].map(|v| (v - case.position).as_dvec3());
    let side = end - start;
    let moment = start.cross(side).length() / side.length().max(1e-300);
    let far = start.length().max(end.length());
    let near = moment.max(radius).max(1e-300);
    let sine = radius / near;
    let moved = f64::from(case.position.abs().max_element()) / near;
    let cap = if caps { radius / start.length().min(end.length()) } else { 0.0 };
    let share = sine.max(cap).min(1.0);
    let reach = side.length() + if caps { radius } else { 0.0 };
    let nearest = {
        let t = (-start.dot(side) / side.length_squared().max(1e-300)).clamp(0.0, 1.0);
        start + side * t
    };
    let size = share * (2.0 * reach / nearest.length()).min(1.0);
    let rounding = far / near + moved;
    // Where the tube is on the lobe's peak, its light is 1 / α² of its size.
    let alpha = f64::from(case.roughness.clamp(0.02, 1.0)).powi(2);
    // Next to the normal the azimuth is noise, and the table's lobes are round to half precision.
    let azimuth = if case.tilt() < 1e-5 { 2e-4 } else { 1e-6 };
    let peak = azimuth * (size / (alpha * alpha)).min(1.0);
    (size * (8e-7 + 2e-7 * rounding), size * (1e-6 + 6e-7 * rounding) / case.sharpness() + peak)
}

impl Builder {
    /// Adds a tube without and with caps, given in the frame of a surface at the origin; `bounded` where exact arithmetic
    /// says more than physics.
    fn tube(&mut self, family: &'static str, start: DVec3, end: DVec3, radius: f64, bounded: bool) {
        let shape = |caps| {
            let (start, end) = (start.as_vec3(), end.as_vec3());
            Shape::Tube { start, end, radius: radius as f32, caps }
        };
        let case = self.case(family, &STANDARD, DVec3::ZERO, shape(false), Bound::Physical);
        for caps in [false, true] {
            self.bounded_tube(Case { shape: shape(caps), ..case.clone() }, bounded);
        }
    }

    fn bounded_tube(&mut self, mut case: Case, bounded: bool) {
        if bounded {
            let (form_factor, specular) = bounds(&case);
            // A tube of no width gives no light, exactly.
            case.bound = Bound::Absolute(form_factor.max(1e-37));
            case.specular_bound = specular.max(1e-37);
        }
        self.cases.push(case);
    }

    pub(super) fn tubes(&mut self, scale: usize) {
        for i in 0..30 * scale {
            let distance = self.random.log(0.1, 30.0);
            let center = self.random.direction() * distance;
            let half = self.random.direction() * (distance * self.random.log(0.05, 30.0));
            let radius = distance * self.random.log(1e-3, 0.125);
            self.tube("tube, ordinary", center - half, center + half, radius, true);
            if i % 3 == 0 {
                self.moved_tube([center - half, center + half], radius);
            }

            let center = self.random.upper() * self.random.log(1e-3, 1e3);
            let size = center.length() * self.random.log(1e-5, 0.1);
            let half = self.random.direction() * size;
            let radius = size * self.random.log(1e-3, 0.5);
            self.tube("tube, distant", center - half, center + half, radius, true);

            let center = self.random.upper();
            let half = self.random.direction() * self.random.log(1e-12, 1e-4);
            let radius = self.random.log(1e-12, 1e-3);
            self.tube("tube, tiny", center - half, center + half, radius, true);

            let gap = self.random.log(1e-7, 0.1);
            let azimuth = self.random.between(0.0, TAU);
            let foot = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0) * gap;
            let along = match self.random.index(3) {
                0 => DVec3::Z,
                1 => DVec3::new(-foot.y, foot.x, 0.0) / gap,
                _ => self.random.direction(),
            };
            let reach = [self.random.log(0.01, 3.0), self.random.log(0.01, 3.0)];
            let radius = gap * self.random.log(1e-2, 0.9);
            let middle = foot + DVec3::Z * (self.random.between(0.0, 3.0) * gap);
            let ends = [middle - along * reach[0], middle + along * reach[1]];
            self.tube("tube, all but touched", ends[0], ends[1], radius, true);

            let height = self.random.log(1e-6, 0.3);
            let direction = DVec3::new(azimuth.sin(), azimuth.cos(), 0.0);
            let center = DVec3::new(azimuth.cos(), azimuth.sin(), height * self.random.between(-1.5, 1.5));
            let half = direction * self.random.log(1e-3, 10.0);
            self.tube("tube, along the horizon", center - half, center + half, height, true);

            let direction = self.random.direction();
            let aside = direction.any_orthonormal_vector() * self.random.log(1e-6, 1e-1);
            let near = self.random.log(0.1, 2.0);
            let far = near + self.random.log(0.01, 5.0);
            let radius = self.random.log(1e-4, 0.1);
            let ends = [direction * near + aside, direction * far + aside];
            self.tube("tube, pointing at the point", ends[0], ends[1], radius, true);

            let reach = self.random.log(0.01, 3.0);
            self.tube("tube, along the normal", DVec3::Z * near, DVec3::Z * far, radius, true);
            self.tube("tube, from the point", DVec3::ZERO, direction * near, radius, false);
            self.tube("tube, through the point", direction * -reach, direction * near, radius, false);
            self.tube("tube, through the point", direction * -reach, direction * near, 0.0, false);
            let radius = [0.0, near, near * 0.999, far, 1e-30, 1e30][self.random.index(6)];
            let ends = [direction * near + aside, direction * far - aside];
            self.tube("tube, around the point", ends[0], ends[1], radius, false);
            self.tube("tube, of no length", direction * near, direction * near, 0.1 * near, false);
            self.tube("tube, of no length", DVec3::ZERO, DVec3::ZERO, radius, false);
        }
    }

    /// A tube in any frame and place.
    fn moved_tube(&mut self, ends: [DVec3; 2], radius: f64) {
        let axes = frame(self.random.direction());
        let position = self.random.direction();
        let [start, end] = ends.map(|end| place(&axes, end).as_vec3() + position.as_vec3());
        for caps in [false, true] {
            let shape = Shape::Tube { start, end, radius: radius as f32, caps };
            let case = self.case("tube, turned and moved", &axes, position, shape, Bound::Physical);
            self.bounded_tube(case, true);
            let last = self.cases.len() - 1;
            self.cases[last].specular_bound *= 2.0;
        }
    }
}
