//! Simpler settings that offend as well.

use super::Setting;
use super::settings::{each_number, fewer_digits};
use crate::stability::Shape;

/// What a number takes to write: nothing for 0, little for 1, digits and exponent for others.
fn length_of(number: f32) -> u32 {
    if number == 0.0 {
        return u32::from(number.is_sign_negative());
    }
    if number == 1.0 {
        return 2;
    }
    let bits = number.to_bits();
    let digits = 24 - (bits & 0x007F_FFFF | 0x0080_0000).trailing_zeros();
    let exponent = ((bits >> 23 & 0xFF) as i32 - 127).unsigned_abs();
    3 + digits + exponent / 2 + u32::from(number < 0.0)
}

/// What a setting takes to write.
fn length(setting: &Setting) -> u32 {
    let mut case = setting.case.clone();
    let mut sum = length_of(case.roughness) + 20 * case.shape.vertices().len() as u32;
    each_number(&mut case, &mut |number| sum += length_of(*number));
    sum
}

/// Ways to simplify.
fn simpler(setting: &Setting) -> Vec<Setting> {
    let mut found = Vec::new();
    let mut push = |change: &dyn Fn(&mut Setting)| {
        let mut other = setting.clone();
        change(&mut other);
        found.push(other);
    };
    let vertices = setting.case.shape.vertices().len();
    if let Shape::Polygon { .. } = setting.case.shape {
        for victim in 0..vertices {
            push(&|other| {
                if let Shape::Polygon { vertices, .. } = &mut other.case.shape {
                    vertices.remove(victim);
                }
            });
        }
    }
    push(&|other| other.case.view = other.case.normal);
    for roughness in [1.0, 0.5, 0.0] {
        push(&|other| other.case.roughness = roughness);
    }
    for digits in [1, 2, 4, 8, 12, 16, 20] {
        push(&|other| each_number(&mut other.case, &mut |number| *number = fewer_digits(*number, digits)));
    }
    let mut count = 0;
    each_number(&mut setting.case.clone(), &mut |_| count += 1);
    for index in 0..count {
        let mut replace = |by: &dyn Fn(f32) -> f32| {
            push(&|other| {
                let mut at = 0;
                each_number(&mut other.case, &mut |number| {
                    if at == index {
                        *number = by(*number);
                    }
                    at += 1;
                });
            });
        };
        replace(&|_| 0.0);
        replace(&|number| 1.0_f32.copysign(number));
        for digits in [1, 4, 8, 16] {
            replace(&|number| fewer_digits(number, digits));
        }
    }
    found
}

/// The simplest setting that is found by steps each of which `offends`: fewer vertices, numbers of fewer digits. It is the given
/// one where none is simpler.
pub fn shrunk(setting: &Setting, offends: &dyn Fn(&Setting) -> bool) -> Setting {
    let mut best = setting.clone();
    loop {
        let limit = length(&best);
        let next = simpler(&best).into_iter().find(|other| length(other) < limit && offends(other));
        match next {
            Some(next) => best = next,
            None => return best,
        }
    }
}
