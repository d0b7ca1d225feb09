//! The same outline written otherwise, and its two sides.

use super::split::{is_convex, is_two_sided, outline, with_outline};
use super::{Claim, Posed, slack};
use crate::stability::{Case, Random, Shape};

const EQUAL: [f64; 2] = [1.0, -1.0];

/// Another vertex first.
pub(super) fn another_first(case: &Case, random: &mut Random) -> Option<Posed> {
    let mut vertices = outline(case);
    if vertices.len() < 3 {
        return None;
    }
    let as_quad = matches!(case.shape, Shape::Quad { .. });
    let whole = with_outline(case, &vertices, as_quad);
    let first = 1 + random.index(vertices.len() - 1);
    vertices.rotate_left(first);
    let other = with_outline(case, &vertices, as_quad);
    let slack = slack::bent(&whole);
    Some(Posed::rounded(vec![whole, other], Claim::Nothing(EQUAL.to_vec()), slack))
}

/// By the function of quads and by those of polygons.
pub(super) fn by_either_function(case: &Case, _: &mut Random) -> Option<Posed> {
    let vertices = outline(case);
    if !(3..=4).contains(&vertices.len()) {
        return None;
    }
    let [quad, polygon] = [true, false].map(|as_quad| with_outline(case, &vertices, as_quad));
    let slack = slack::bent(&quad);
    Some(Posed::rounded(vec![quad, polygon], Claim::Nothing(EQUAL.to_vec()), slack))
}

/// Vertices twice, and points between two vertices whose coordinates are exact.
pub(super) fn more_vertices(case: &Case, random: &mut Random) -> Option<Posed> {
    let vertices = outline(case);
    if vertices.len() < 3 {
        return None;
    }
    let mut more = Vec::new();
    for (a, b) in vertices.iter().zip(vertices.iter().cycle().skip(1)) {
        more.push(*a);
        let middle = (*a + *b) * 0.5;
        match random.index(3) {
            0 => more.push(*a),
            1 if middle.as_dvec3() * 2.0 == a.as_dvec3() + b.as_dvec3() => more.push(middle),
            _ => (),
        }
    }
    let [plain, other] = [&vertices, &more].map(|vertices| with_outline(case, vertices, false));
    let slack = slack::bent(&plain);
    Some(Posed::rounded(vec![plain, other], Claim::Nothing(EQUAL.to_vec()), slack))
}

/// The case with its light turned to the other side.
fn reversed(case: &Case) -> Option<Case> {
    let mut other = case.clone();
    match &mut other.shape {
        Shape::Quad { corners, .. } => corners.reverse(),
        Shape::Polygon { vertices, .. } => vertices.reverse(),
        Shape::Disk { half_x, half_y, .. } => core::mem::swap(half_x, half_y),
        Shape::Sphere { .. } | Shape::Tube { .. } => return None,
    }
    Some(other)
}

/// The case with its light on one side or on both.
fn sided(mut case: Case, both: bool) -> Case {
    match &mut case.shape {
        Shape::Quad { two_sided, .. } | Shape::Polygon { two_sided, .. } | Shape::Disk { two_sided, .. } => {
            *two_sided = both
        }
        Shape::Sphere { .. } | Shape::Tube { .. } => (),
    }
    case
}

/// Both sides and their sum.
pub(super) fn both_sides(case: &Case, _: &mut Random) -> Option<Posed> {
    let back = reversed(case)?;
    let cases = vec![sided(case.clone(), true), sided(case.clone(), false), sided(back, false)];
    let slack = flat_slack(case);
    Some(Posed::rounded(cases, Claim::Nothing(vec![1.0, -1.0, -1.0]), slack))
}

/// One side of the two.
pub(super) fn one_side(case: &Case, _: &mut Random) -> Option<Posed> {
    let back = reversed(case)?;
    let slack = flat_slack(case);
    Some(Posed::rounded(vec![sided(case.clone(), false), sided(back, false)], Claim::OneLit, slack))
}

/// A light on both sides, and the same reversed.
pub(super) fn either_way(case: &Case, _: &mut Random) -> Option<Posed> {
    let [case, back] = [case.clone(), reversed(case)?].map(|case| sided(case, true));
    let slack = flat_slack(&case);
    Some(Posed::rounded(vec![case, back], Claim::Nothing(EQUAL.to_vec()), slack))
}

/// What the bend of an outline that is read from another vertex costs.
fn flat_slack(case: &Case) -> [f64; 3] {
    if case.shape.vertices().is_empty() { [0.0; 3] } else { slack::bent(case) }
}

/// A part of a light gives no more than all of it, a two-sided one no less than one of its sides.
pub(super) fn part_of(case: &Case, random: &mut Random) -> Option<Posed> {
    let at_most = |part: Case, whole: Case, slack| {
        Some(Posed::rounded(vec![part, whole], Claim::AtMost(EQUAL.to_vec()), slack).without_schlick())
    };
    let share = if random.index(2) == 0 { 0.5 } else { 1.0 - random.log(1e-7, 0.9) as f32 };
    match case.shape {
        Shape::Quad { .. } | Shape::Polygon { .. } => {
            if random.index(4) == 0 && !is_two_sided(case) {
                return at_most(case.clone(), sided(case.clone(), true), [0.0; 3]);
            }
            let mut vertices = outline(case);
            if !is_convex(&vertices) || vertices.len() < 4 {
                return None;
            }
            let whole = with_outline(case, &vertices, random.index(2) == 0);
            vertices.remove(random.index(vertices.len()));
            let part = with_outline(case, &vertices, random.index(2) == 0);
            let slack = slack::bent(&whole);
            at_most(part, whole, slack)
        }
        Shape::Disk { center, half_x, half_y, two_sided } => {
            // Both axes by the same factor: a rounding of either leaves the smaller one inside, but for that rounding.
            let [half_x, half_y] = [half_x * share, half_y * share];
            let part = Case { shape: Shape::Disk { center, half_x, half_y, two_sided }, ..case.clone() };
            let slack = slack::moved(case, super::sight::rounding(half_x) + super::sight::rounding(half_y));
            at_most(part, case.clone(), slack)
        }
        Shape::Sphere { center, radius } => {
            let part = Case { shape: Shape::Sphere { center, radius: radius * share }, ..case.clone() };
            at_most(part, case.clone(), [0.0; 3])
        }
        // A line with ends in the place of a tube: what is left out of it is no part of the light that it stands for.
        Shape::Tube { .. } => None,
    }
}
