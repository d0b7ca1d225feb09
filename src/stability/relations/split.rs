//! Lights in parts.

use glam::{DVec3, Vec3};

use super::sight::rounding;
use super::{Claim, Posed, slack};
use crate::stability::{Case, Random, Shape};

/// The outline of a quad or polygon, without repeated neighbours.
pub(super) fn outline(case: &Case) -> Vec<Vec3> {
    let mut vertices = case.shape.vertices().to_vec();
    vertices.dedup();
    while vertices.len() > 1 && vertices.first() == vertices.last() {
        vertices.pop();
    }
    vertices
}

/// The same surface under another outline, by the functions of quads for up to four vertices where `as_quad`.
pub(super) fn with_outline(case: &Case, vertices: &[Vec3], as_quad: bool) -> Case {
    let two_sided = is_two_sided(case);
    let shape = match *vertices {
        [a, b, c] if as_quad => Shape::Quad { corners: [a, b, c, c], two_sided },
        [a, b, c, d] if as_quad => Shape::Quad { corners: [a, b, c, d], two_sided },
        _ => Shape::Polygon { vertices: vertices.to_vec(), two_sided },
    };
    Case { shape, ..case.clone() }
}

/// Whether the light emits from both sides.
pub(super) fn is_two_sided(case: &Case) -> bool {
    match case.shape {
        Shape::Quad { two_sided, .. } | Shape::Polygon { two_sided, .. } | Shape::Disk { two_sided, .. } => {
            two_sided
        }
        _ => false,
    }
}

/// Area vector of an outline.
fn area(vertices: &[Vec3]) -> DVec3 {
    let points: Vec<DVec3> = vertices.iter().map(|v| v.as_dvec3()).collect();
    let fan = points.windows(2).map(|pair| (pair[0] - points[0]).cross(pair[1] - points[0]));
    fan.sum()
}

/// Whether every corner turns the same way.
pub(super) fn is_convex(vertices: &[Vec3]) -> bool {
    let normal = area(vertices);
    let count = vertices.len();
    let corner = |k: usize| {
        let [a, b, c] = [k, k + 1, k + 2].map(|k| vertices[k % count].as_dvec3());
        (b - a).cross(c - b).dot(normal) > 0.0
    };
    count >= 3 && (0..count).all(corner) && winds_once(vertices, normal)
}

/// Whether an outline whose corners all turn the same way closes after one turn.
fn winds_once(vertices: &[Vec3], normal: DVec3) -> bool {
    let count = vertices.len();
    let normal = normal.normalize_or_zero();
    let turn = |k: usize| {
        let [a, b, c] = [k, k + 1, k + 2].map(|k| vertices[k % count].as_dvec3());
        let (before, after) = (b - a, c - b);
        before.cross(after).dot(normal).atan2(before.dot(after))
    };
    let turns: f64 = (0..count).map(turn).sum();
    (turns - core::f64::consts::TAU).abs() < 1.0
}

/// A whole and two parts of it that share the chord.
fn parts(case: &Case, whole: &[Vec3], [left, right]: [&[Vec3]; 2], random: &mut Random) -> Vec<Case> {
    let mut made = |vertices: &[Vec3]| with_outline(case, vertices, random.index(2) == 0);
    vec![made(whole), made(left), made(right)]
}

/// Split at a diagonal.
pub(super) fn at_diagonal(case: &Case, random: &mut Random) -> Option<Posed> {
    let mut vertices = outline(case);
    if vertices.len() < 4 || !is_convex(&vertices) {
        return None;
    }
    let first = random.index(vertices.len());
    vertices.rotate_left(first);
    let to = 2 + random.index(vertices.len() - 3);
    let left = &vertices[..=to];
    let right: Vec<Vec3> = vertices[to..].iter().chain(&vertices[..1]).copied().collect();
    let cases = parts(case, &vertices, [left, &right], random);
    let slack = slack::bent(&cases[0]);
    Some(Posed::rounded(cases, Claim::Nothing(vec![-1.0, 1.0, 1.0]), slack).without_schlick())
}

/// Split from a point on one edge to a point on another.
pub(super) fn at_chord(case: &Case, random: &mut Random) -> Option<Posed> {
    let mut vertices = outline(case);
    if !is_convex(&vertices) {
        return None;
    }
    let first = random.index(vertices.len());
    vertices.rotate_left(first);
    let count = vertices.len();
    let to = 1 + random.index(count - 1);
    let mut point = |from: usize| {
        let [a, b] = [from, from + 1].map(|k| vertices[k % count].as_dvec3());
        let share = match random.index(3) {
            0 => random.log(1e-7, 0.5),
            1 => 1.0 - random.log(1e-7, 0.5),
            _ => random.unit(),
        };
        a.lerp(b, share).as_vec3()
    };
    let (start, end) = (point(0), point(to));
    let left: Vec<Vec3> = [start].into_iter().chain(vertices[1..=to].iter().copied()).chain([end]).collect();
    let right: Vec<Vec3> =
        [end].into_iter().chain(vertices[to + 1..].iter().copied()).chain([vertices[0], start]).collect();
    let cases = parts(case, &vertices, [&left, &right], random);
    // Both parts have the same rounded chord: only the whole's two edges are bent, each into a triangle.
    let slack =
        slack::and(slack::moved(&cases[0], rounding(start).max(rounding(end))), slack::bent(&cases[0]));
    Some(Posed::rounded(cases, Claim::Nothing(vec![-1.0, 1.0, 1.0]), slack).without_schlick())
}
