//! Inputs that aim at trouble: the catalogue's, bent towards what coincides.

use glam::Vec3;

use crate::stability::families::cases_of;
use crate::stability::{Case, Random, Shape, neighbour};

/// Polygons of more vertices than this take long and are the catalogue's to examine.
pub(super) const MOST_VERTICES: usize = 40;

/// A case and the seed of what relations choose of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The case; its bounds count for nothing here.
    pub case: Case,
    /// Where the choices come from.
    pub seed: u64,
}

/// At least `count` settings, others for every seed: a third of them the catalogue's own cases, the others changed.
pub fn settings(seed: u64, count: usize) -> Vec<Setting> {
    let mut random = Random::new(0x5E77_1465 ^ seed.rotate_left(32));
    let mut settings = Vec::new();
    let mut round = 0;
    while settings.len() < count {
        // A seed of the catalogue for each round; those of neighbouring seeds do not meet.
        let mut cases = cases_of(seed.wrapping_mul(1009).wrapping_add(round) & 0xFFFF_FFFF, 1);
        cases.retain(|case| case.shape.vertices().len() <= MOST_VERTICES);
        // In an order of no family, so that any number of them is a sample of all.
        for at in (1..cases.len()).rev() {
            cases.swap(at, random.index(at + 1));
        }
        for mut case in cases {
            change(&mut case, &mut random);
            settings.push(Setting { case, seed: random.bits() });
        }
        round += 1;
    }
    settings.truncate(count);
    settings
}

/// Changes a case in one of the ways that have led to trouble, or not at all.
fn change(case: &mut Case, random: &mut Random) {
    match random.index(9) {
        0..=2 => (),
        // The next numbers.
        3 => each_number(case, &mut |number| *number = random.near(*number, 2)),
        // Bits of mantissas.
        4 => each_number(case, &mut |number| {
            if random.index(4) == 0 {
                *number = f32::from_bits(number.to_bits() ^ (1 << random.index(23)));
            }
        }),
        // The lowest bits of exponents: twice, half, four times.
        5 => {
            let victim = random.index(12);
            let mut at = 0;
            each_number(case, &mut |number| {
                if at == victim {
                    let other = f32::from_bits(number.to_bits() ^ (1 << (23 + random.index(2))));
                    *number = if other.is_finite() { other } else { *number };
                }
                at += 1;
            });
        }
        // A highlight on a vertex or the centre, or all but there.
        6 => aim(case, random),
        // Few digits: points on axes and planes, and on one another.
        7 => {
            let digits = 1 + random.index(6) as u32;
            each_number(case, &mut |number| *number = fewer_digits(*number, digits));
        }
        // Towards the point or away from it, by logarithm, all but straight.
        _ => {
            let factor = random.log(1e-6, 1e4) as f32;
            let position = case.position;
            each_point(&mut case.shape, &mut |point| *point = position + (*point - position) * factor);
            each_length(&mut case.shape, &mut |length| *length *= factor);
        }
    }
}

/// A view whose mirror direction leads to one of the light's points.
fn aim(case: &mut Case, random: &mut Random) {
    let mut points = Vec::new();
    each_point(&mut case.shape, &mut |point| points.push(*point));
    let toward = (points[random.index(points.len())] - case.position).as_dvec3().normalize_or_zero();
    let normal = case.normal.as_dvec3().normalize_or_zero();
    let view = normal * (2.0 * normal.dot(toward)) - toward;
    let view = (view + random.direction() * random.log(1e-9, 0.1)).as_vec3();
    if view != Vec3::ZERO && view.is_finite() {
        case.view = view;
    }
}

/// A number rounded to so many binary digits.
pub(super) fn fewer_digits(number: f32, digits: u32) -> f32 {
    let drop = 24 - digits.clamp(1, 24);
    let half = if drop == 0 { 0 } else { 1_u32 << (drop - 1) };
    let rounded = f32::from_bits(number.to_bits().wrapping_add(half) & (u32::MAX << drop));
    if rounded.is_finite() { rounded } else { number }
}

/// Shows every number of a case but the roughness.
pub(super) fn each_number(case: &mut Case, show: &mut dyn FnMut(&mut f32)) {
    let mut vector = |v: &mut Vec3| [&mut v.x, &mut v.y, &mut v.z].into_iter().for_each(&mut *show);
    vector(&mut case.position);
    each_point(&mut case.shape, &mut vector);
    each_axis(&mut case.shape, &mut vector);
    let (normal, view) = (case.normal, case.view);
    vector(&mut case.normal);
    vector(&mut case.view);
    let is_direction = |v: Vec3| v != Vec3::ZERO && v.is_finite();
    if !is_direction(case.normal) {
        case.normal = normal;
    }
    if !is_direction(case.view) {
        case.view = view;
    }
    each_length(&mut case.shape, &mut |length| {
        show(length);
        *length = length.abs();
    });
}

/// Shows every place of a light.
pub(super) fn each_point(shape: &mut Shape, show: &mut dyn FnMut(&mut Vec3)) {
    match shape {
        Shape::Quad { corners, .. } => corners.iter_mut().for_each(show),
        Shape::Polygon { vertices, .. } => vertices.iter_mut().for_each(show),
        Shape::Disk { center, .. } | Shape::Sphere { center, .. } => show(center),
        Shape::Tube { start, end, .. } => [start, end].into_iter().for_each(show),
    }
}

/// Shows every difference of places.
pub(super) fn each_axis(shape: &mut Shape, show: &mut dyn FnMut(&mut Vec3)) {
    if let Shape::Disk { half_x, half_y, .. } = shape {
        [half_x, half_y].into_iter().for_each(show);
    }
}

/// Shows every length of a light.
pub(super) fn each_length(shape: &mut Shape, show: &mut dyn FnMut(&mut f32)) {
    match shape {
        Shape::Sphere { radius, .. } | Shape::Tube { radius, .. } => show(radius),
        _ => (),
    }
}

/// The number of a case with the given index, moved by so many representable ones; the roughness is the last of them.
pub(super) fn stepped(case: &Case, index: usize, steps: i64) -> Case {
    let mut other = case.clone();
    let mut at = 0;
    let mut step = |number: &mut f32| {
        if at == index {
            *number = neighbour(*number, steps);
        }
        at += 1;
    };
    each_number(&mut other, &mut step);
    let is_last = at <= index;
    if is_last {
        other.roughness = neighbour(case.roughness, steps).clamp(0.0, 1.0);
    }
    other
}
