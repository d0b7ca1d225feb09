//! What the surface has to do with it: its lobe, its view, its least steps.

use glam::Vec3;

use super::settings::{each_number, stepped};
use super::sight::rounding;
use super::{Claim, Lobes, Posed, slack};
use crate::stability::{Case, Random, Shape};

/// A lobe whose matrix is the identity reflects as the form factor says.
pub(super) fn identity_is_lambert(case: &Case, _: &mut Random) -> Option<Posed> {
    // In a lobe's space a tube has a width of its own making: another form than that of the form factor.
    if matches!(case.shape, Shape::Tube { .. }) {
        return None;
    }
    // The table of the identity holds it for this surface only.
    let case = Case { roughness: 1.0, view: case.normal, ..case.clone() };
    Some(Posed { lobes: Lobes::Identity, ..Posed::exact(vec![case], Claim::Cosine) })
}

/// The form factor is the same for every view and every roughness.
pub(super) fn form_factor_has_no_view(case: &Case, random: &mut Random) -> Option<Posed> {
    let mut other = case.clone();
    other.roughness = random.unit() as f32;
    other.view = random.direction().as_vec3();
    let posed = Posed::exact(vec![case.clone(), other], Claim::Nothing(vec![1.0, -1.0]));
    Some(Posed { slack: [0.0, f64::INFINITY, f64::INFINITY], ..posed })
}

/// The length of normal and view means nothing.
pub(super) fn lengths_of_directions(case: &Case, random: &mut Random) -> Option<Posed> {
    let has_room = |v: Vec3| v.to_array().iter().all(|n| *n == 0.0 || (1e-9..1e9).contains(&n.abs()));
    if !has_room(case.normal) || !has_room(case.view) {
        return None;
    }
    let mut factor = || 2.0_f32.powi(random.index(41) as i32 - 20);
    let other = Case { normal: case.normal * factor(), view: case.view * factor(), ..case.clone() };
    Some(Posed::exact(vec![case.clone(), other], Claim::SameBits))
}

/// One number, moved to the next representable one.
pub(super) fn one_step(case: &Case, random: &mut Random) -> Option<Posed> {
    let mut numbers = Vec::new();
    each_number(&mut case.clone(), &mut |number| numbers.push(*number));
    // As each_number shows them: the place of the surface, the light's vectors, normal and view, the light's length.
    let lengths = usize::from(numbers.len() % 3 == 1);
    let index = random.index(numbers.len() + 1);
    let other = stepped(case, index, random.sign() as i64);
    let is_direction = (numbers.len() - lengths - 6..numbers.len() - lengths).contains(&index);
    let step = |number: f32| 2.0 * rounding(Vec3::splat(number));
    let slack = if index >= numbers.len() {
        slack::turned(case, step(case.roughness))
    } else if is_direction {
        let first = numbers.len() - lengths - 6;
        let vector = if index < first + 3 { case.normal } else { case.view };
        slack::turned(case, step(numbers[index]) / f64::from(vector.length()))
    } else {
        slack::moved(case, step(numbers[index]))
    };
    Some(Posed::rounded(vec![case.clone(), other], Claim::Nothing(vec![1.0, -1.0]), slack))
}
