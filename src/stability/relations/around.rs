//! Lights all around the point, and round lights between flat ones.

use core::f64::consts::TAU;

use glam::{DVec3, Vec3};

use super::sight::rounding;
use super::split::{is_convex, outline, with_outline};
use super::{Claim, Posed, slack};
use crate::stability::{Case, Random, Shape};

/// The same surface under a flat light that shows the point its front.
fn facing(case: &Case, vertices: &[Vec3], as_quad: bool) -> Case {
    let mut vertices = vertices.to_vec();
    let points: Vec<DVec3> = vertices.iter().map(|v| v.as_dvec3() - case.position.as_dvec3()).collect();
    let fan = points.windows(2).map(|pair| (pair[0] - points[0]).cross(pair[1] - points[0]));
    let away: DVec3 = fan.sum();
    if away.dot(points[0]) > 0.0 {
        vertices.reverse();
    }
    let mut made = with_outline(case, &vertices, as_quad);
    if let Shape::Quad { two_sided, .. } | Shape::Polygon { two_sided, .. } = &mut made.shape {
        *two_sided = false;
    }
    made
}

/// A light and its complement: the pyramid over the light whose apex lies behind the point has the point inside.
pub(super) fn with_complement(case: &Case, random: &mut Random) -> Option<Posed> {
    let vertices = outline(case);
    if !is_convex(&vertices) {
        return None;
    }
    // The pyramid over a distant light is a needle: all of its faces pass by so closely that nothing is promised of them.
    let is_large = super::sight::Sight::of(&case.seen()).is_some_and(|sight| sight.size >= 0.1);
    if !is_large {
        return None;
    }
    let position = case.position.as_dvec3();
    let weights: Vec<f64> = vertices.iter().map(|_| random.between(0.05, 1.0)).collect();
    let sum: f64 = weights.iter().sum();
    let inside: DVec3 =
        vertices.iter().zip(&weights).map(|(v, weight)| (v.as_dvec3() - position) * (weight / sum)).sum();
    let behind = inside * random.log(1e-2, 1e2);
    let apex = (position - behind).as_vec3();
    // Far from the origin the rounded apex may leave the point outside.
    if (apex.as_dvec3() - (position - behind)).length() > 1e-3 * behind.length() {
        return None;
    }
    let mut cases = vec![facing(case, &vertices, random.index(2) == 0)];
    for (a, b) in vertices.iter().zip(vertices.iter().cycle().skip(1)) {
        cases.push(facing(case, &[*a, *b, apex], random.index(2) == 0));
    }
    Some(Posed::exact(cases, Claim::AllAround).without_schlick())
}

/// A box around the point, its walls at distances of any size.
pub(super) fn in_a_box(case: &Case, random: &mut Random) -> Option<Posed> {
    let extent = case.position.abs().max_element();
    if extent > 1e9 {
        return None;
    }
    let least = if extent == 0.0 { 1e-6 } else { f64::from(extent) * 1e-3 };
    let mut wall =
        |sign: f32, axis: usize| case.position[axis] + sign * random.log(least, least * 1e6) as f32;
    let low: [f32; 3] = core::array::from_fn(|axis| wall(-1.0, axis));
    let high: [f32; 3] = core::array::from_fn(|axis| wall(1.0, axis));
    let as_quad = random.index(2) == 0;
    let face = |axis: usize, at: f32| {
        let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|sides: [usize; 2]| {
            let mut corner = [at; 3];
            for (k, side) in sides.into_iter().enumerate() {
                let across = (axis + 1 + k) % 3;
                corner[across] = [low, high][side][across];
            }
            Vec3::from(corner)
        });
        facing(case, &corners, as_quad)
    };
    let cases = (0..3).flat_map(|axis| [face(axis, low[axis]), face(axis, high[axis])]).collect();
    Some(Posed::exact(cases, Claim::AllAround).without_schlick())
}

/// A disk lies between the polygons of its rim's points and of its tangents.
pub(super) fn between_polygons(case: &Case, random: &mut Random) -> Option<Posed> {
    let Shape::Disk { center, half_x, half_y, two_sided } = case.shape else { return None };
    let count = 3 + random.index(38);
    let is_inner = random.index(2) == 0;
    let reach = if is_inner { 1.0 } else { 1.0 / (0.5 * TAU / count as f64).cos() };
    let start = random.between(0.0, TAU);
    let [center, x, y] = [center, half_x, half_y].map(|v| v.as_dvec3());
    let vertices: Vec<Vec3> = (0..count)
        .map(|k| {
            let (sine, cosine) = (start + TAU * k as f64 / count as f64).sin_cos();
            (center + (x * cosine + y * sine) * reach).as_vec3()
        })
        .collect();
    let moved = vertices.iter().map(|v| rounding(*v)).fold(0.0, f64::max);
    let polygon = Case { shape: Shape::Polygon { vertices, two_sided }, ..case.clone() };
    let slack = slack::and(slack::moved(&polygon, moved), slack::moved(case, moved));
    let cases = if is_inner { vec![polygon, case.clone()] } else { vec![case.clone(), polygon] };
    Some(Posed::rounded(cases, Claim::AtMost(vec![1.0, -1.0]), slack).without_schlick())
}

/// A sphere is seen as the disk is that its tangents from the point touch.
pub(super) fn as_its_silhouette(case: &Case, random: &mut Random) -> Option<Posed> {
    let Shape::Sphere { center, radius } = case.shape else { return None };
    let toward = (center - case.position).as_dvec3();
    let (distance, radius) = (toward.length(), f64::from(radius));
    let share = 1.0 - (radius / distance).powi(2);
    if !(share > 1e-4 && radius > 0.0) {
        return None;
    }
    let (x, y) = (toward / distance).any_orthonormal_pair();
    let (sine, cosine) = random.between(0.0, TAU).sin_cos();
    let size = radius * share.sqrt();
    let (x, y) = ((x * cosine + y * sine) * size, (y * cosine - x * sine) * size);
    let (x, y) = if x.cross(y).dot(toward) < 0.0 { (x, y) } else { (y, x) };
    let middle = (case.position.as_dvec3() + toward * share).as_vec3();
    let [half_x, half_y] = [x, y].map(|v| v.as_vec3());
    let shape = Shape::Disk { center: middle, half_x, half_y, two_sided: random.index(2) == 0 };
    let disk = Case { shape, ..case.clone() };
    let moved = rounding(middle) + rounding(half_x) + rounding(half_y);
    let slack = slack::and(slack::moved(case, moved), slack::moved(&disk, moved));
    Some(Posed::rounded(vec![case.clone(), disk], Claim::Nothing(vec![1.0, -1.0]), slack))
}

/// A sphere lies between the octahedron in it and the cube around it.
pub(super) fn between_polyhedra(case: &Case, random: &mut Random) -> Option<Posed> {
    let Shape::Sphere { center, radius } = case.shape else { return None };
    let z = random.direction();
    let (x, y) = z.any_orthonormal_pair();
    let axes = [x, y, z];
    let (middle, radius) = (center.as_dvec3(), f64::from(radius));
    let toward = case.position.as_dvec3() - middle;
    let is_inner = random.index(2) == 0;
    let place = |v: DVec3| (middle + (axes[0] * v.x + axes[1] * v.y + axes[2] * v.z) * radius).as_vec3();
    let signs = [-1.0, 1.0];
    let faces: Vec<Vec<Vec3>> = if is_inner {
        if toward.length() <= radius * 1.000_01 {
            return None;
        }
        let corner = |k: usize| DVec3::new(signs[k & 1], signs[k >> 1 & 1], signs[k >> 2]);
        let face = |k: usize| {
            let v = corner(k);
            [DVec3::X * v.x, DVec3::Y * v.y, DVec3::Z * v.z].map(place).to_vec()
        };
        (0..8).map(face).collect()
    } else {
        // Outside the cube, by more than rounding.
        if axes.iter().all(|axis| axis.dot(toward).abs() < radius * 1.000_01) {
            return None;
        }
        let face = |k: usize| {
            let (axis, sign) = (k / 2, signs[k % 2]);
            let corner = |[a, b]: [f64; 2]| {
                let mut v = [sign; 3];
                (v[(axis + 1) % 3], v[(axis + 2) % 3]) = (a, b);
                place(DVec3::from(v))
            };
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(corner).to_vec()
        };
        (0..6).map(face).collect()
    };
    let moved = faces.iter().flatten().map(|v| rounding(*v)).fold(0.0, f64::max);
    let mut slack = slack::moved(case, moved);
    let mut cases = vec![case.clone()];
    for vertices in faces {
        let outward = (vertices[1] - vertices[0]).cross(vertices[2] - vertices[0]);
        let mut vertices = vertices;
        if outward.as_dvec3().dot(vertices[0].as_dvec3() - middle) < 0.0 {
            vertices.reverse();
        }
        let shape = Shape::Polygon { vertices, two_sided: false };
        let face = Case { shape, ..case.clone() };
        slack = slack::and(slack, slack::moved(&face, moved));
        cases.push(face);
    }
    let sign = if is_inner { -1.0 } else { 1.0 };
    let weights = (0..cases.len()).map(|k| if k == 0 { sign } else { -sign }).collect();
    Some(Posed::rounded(cases, Claim::AtMost(weights), slack).without_schlick())
}
