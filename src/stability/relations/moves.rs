//! Everything moved, scaled, turned or mirrored together.

use glam::{DQuat, DVec3, Mat3, Vec3};

use super::settings::{each_axis, each_length, each_point};
use super::sight::rounding;
use super::{Claim, Posed, slack};
use crate::stability::{Case, Random, Shape};

/// Numbers that may be scaled by 2^±20 without becoming subnormal or infinite, by a margin for products of two of them and with
/// the components of directions.
fn has_room(case: &Case) -> bool {
    for direction in [case.normal, case.view] {
        let least = 1e-20 * direction.abs().max_element();
        if direction.to_array().iter().any(|number| *number != 0.0 && number.abs() < least) {
            return false;
        }
    }
    let mut numbers = case.position.to_array().to_vec();
    let mut shape = case.shape.clone();
    each_point(&mut shape, &mut |v| numbers.extend(v.to_array()));
    each_axis(&mut shape, &mut |v| numbers.extend(v.to_array()));
    each_length(&mut shape, &mut |length| numbers.push(*length));
    numbers.iter().all(|number| *number == 0.0 || (1e-9..1e9).contains(&number.abs()))
}

/// A case with every place, difference of places and length changed.
fn changed(
    case: &Case,
    point: impl Fn(Vec3) -> Vec3,
    axis: impl Fn(Vec3) -> Vec3,
    length: impl Fn(f32) -> f32,
) -> Case {
    let mut other = case.clone();
    other.position = point(case.position);
    each_point(&mut other.shape, &mut |v| *v = point(*v));
    each_axis(&mut other.shape, &mut |v| *v = axis(*v));
    each_length(&mut other.shape, &mut |v| *v = length(*v));
    other
}

/// Everything 2^k times as large.
pub(super) fn scaled(case: &Case, random: &mut Random) -> Option<Posed> {
    if !has_room(case) {
        return None;
    }
    let factor = 2.0_f32.powi(random.index(41) as i32 - 20);
    let other = changed(case, |v| v * factor, |v| v * factor, |v| v * factor);
    Some(Posed::exact(vec![case.clone(), other], Claim::SameBits))
}

/// Everything on a grid, and as many steps of it away as keep every coordinate exact.
pub(super) fn shifted(case: &Case, random: &mut Random) -> Option<Posed> {
    let mut extent = case.position.abs().max_element();
    each_point(&mut case.shape.clone(), &mut |v| extent = extent.max(v.abs().max_element()));
    if !(1e-12..1e12).contains(&extent) {
        return None;
    }
    let step = 2.0_f32.powi(extent.log2().ceil() as i32 - 11);
    let on_grid = changed(case, |v| (v / step).round() * step, |v| v, |v| v);
    let mut steps = || (random.index(8193) as f32 - 4096.0) * step;
    let offset = Vec3::new(steps(), steps(), steps());
    let other = changed(&on_grid, |v| v + offset, |v| v, |v| v);
    Some(Posed::exact(vec![on_grid, other], Claim::SameBits))
}

/// A case whose every vector a matrix of zeros and ones leads elsewhere, exactly; mirrored outlines run the other way.
fn permuted(case: &Case, matrix: Mat3) -> Case {
    let mut other = changed(case, |v| matrix * v, |v| matrix * v, |v| v);
    (other.normal, other.view) = (matrix * case.normal, matrix * case.view);
    if matrix.determinant() < 0.0 {
        match &mut other.shape {
            Shape::Quad { corners, .. } => corners.reverse(),
            Shape::Polygon { vertices, .. } => vertices.reverse(),
            Shape::Disk { half_x, half_y, .. } => core::mem::swap(half_x, half_y),
            Shape::Sphere { .. } | Shape::Tube { .. } => (),
        }
    }
    other
}

/// Axes of coordinates exchanged and turned round.
pub(super) fn exchanged(case: &Case, random: &mut Random) -> Option<Posed> {
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let columns = orders[random.index(6)].map(|axis| axes[axis] * random.sign() as f32);
    let other = permuted(case, Mat3::from_cols(columns[0], columns[1], columns[2]));
    // The frame of a turned surface is made in another order, and rounded by as much as its directions.
    let slack = slack::turned(case, 2.0 * rounding(Vec3::ONE));
    Some(Posed::rounded(vec![case.clone(), other], Claim::Nothing(vec![1.0, -1.0]), slack))
}

/// Everything turned about any axis through the origin.
pub(super) fn turned(case: &Case, random: &mut Random) -> Option<Posed> {
    let angle = match random.index(3) {
        0 => random.log(1e-8, 1.0),
        _ => random.between(0.0, core::f64::consts::TAU),
    };
    turned_by(case, DQuat::from_axis_angle(random.direction(), angle))
}

/// Light and view turned about the normal.
pub(super) fn turned_about_the_normal(case: &Case, random: &mut Random) -> Option<Posed> {
    let normal = case.normal.as_dvec3().try_normalize()?;
    let at_origin = changed(case, |v| v - case.position, |v| v, |v| v);
    let turn = DQuat::from_axis_angle(normal, random.between(0.0, core::f64::consts::TAU));
    let mut posed = turned_by(&at_origin, turn)?;
    posed.cases[1].normal = case.normal;
    Some(posed)
}

fn turned_by(case: &Case, turn: DQuat) -> Option<Posed> {
    let turned = |v: Vec3| (turn * v.as_dvec3()).as_vec3();
    let mut other = changed(case, turned, turned, |v| v);
    (other.normal, other.view) = (turned(case.normal), turned(case.view));
    let mut moved = rounding(case.position);
    each_point(&mut other.shape, &mut |v| moved = moved.max(rounding(*v)));
    let mut axes = 0.0;
    each_axis(&mut other.shape, &mut |v| axes += rounding(*v));
    let moved = moved + rounding(case.position) + axes;
    // Places so far from the origin that rounding them turns the light itself: which side it shows is open.
    let (mut nearest, place) = (f64::INFINITY, other.position);
    each_point(&mut other.shape, &mut |v| nearest = nearest.min((*v - place).as_dvec3().length()));
    if moved > 1e-4 * nearest {
        return None;
    }
    // Each of the two directions is rounded by half a unit along each axis.
    let directions = 2.0 * rounding(Vec3::ONE);
    let slack = slack::and(slack::moved(case, moved), slack::turned(case, directions));
    Some(Posed::rounded(vec![case.clone(), other], Claim::Nothing(vec![1.0, -1.0]), slack))
}

/// The light's vertices slide along their rays, each by a power of two: a triangle stays one, and all directions are the same.
pub(super) fn slid(case: &Case, random: &mut Random) -> Option<Posed> {
    let outline = super::split::outline(case);
    if outline.len() < 3 {
        return None;
    }
    let first = random.index(outline.len());
    let corners = [0, 1, 2].map(|k| outline[(first + k) % outline.len()] - case.position);
    let surface = Case { position: Vec3::ZERO, ..case.clone() };
    let spread = 1 + random.index(5);
    let slid =
        corners.map(|corner| corner * 2.0_f32.powi(random.index(2 * spread + 1) as i32 - spread as i32));
    let mut made = |corners: &[Vec3]| super::split::with_outline(&surface, corners, random.index(2) == 0);
    Some(Posed::exact(vec![made(&corners), made(&slid)], Claim::Nothing(vec![1.0, -1.0])))
}

/// Other half-axes of the same disk, the other end of the same tube first.
pub(super) fn named_otherwise(case: &Case, random: &mut Random) -> Option<Posed> {
    let mut slack = [0.0; 3];
    let shape = match case.shape {
        Shape::Disk { center, half_x, half_y, two_sided } => {
            let [half_x, half_y] = match random.index(4) {
                0 => [half_y, -half_x],
                1 => [-half_x, -half_y],
                2 => [-half_y, half_x],
                _ => {
                    let (sine, cosine) = random.between(0.0, core::f64::consts::TAU).sin_cos();
                    let [x, y]: [DVec3; 2] = [half_x, half_y].map(|v| v.as_dvec3());
                    let axes = [x * cosine + y * sine, y * cosine - x * sine].map(|v| v.as_vec3());
                    slack = slack::moved(case, rounding(axes[0]) + rounding(axes[1]));
                    axes
                }
            };
            Shape::Disk { center, half_x, half_y, two_sided }
        }
        Shape::Tube { start, end, radius, caps } => Shape::Tube { start: end, end: start, radius, caps },
        _ => return None,
    };
    let other = Case { shape, ..case.clone() };
    Some(Posed::rounded(vec![case.clone(), other], Claim::Nothing(vec![1.0, -1.0]), slack))
}
