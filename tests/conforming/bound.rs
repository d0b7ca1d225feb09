//! What holds on every device that conforms.

use softbox::effects::Quality;

use softbox::stability::{Bound, Case, Shape};

/// By how much the bounds of a device that rounds to nearest are widened: for the form factor, and for specular light.
///
/// These factors are measured, not derived. The worst that was found of the form factor is 3.7 times the plain bound, where an
/// edge passes close by and every operation errs as far as it may in the direction that counts; of specular light it is 7.7 times,
/// at the level of two lobes, for a light a million times as large as its distance. A sum or product may be off by twice as much
/// as with rounding to nearest, an inverse root by four times and a quotient by five times.
pub const FACTORS: [f64; 2] = [6.0, 10.0];

/// What each vertex of an outline adds to both bounds. A running sum of edge integrals is at most 2 pi, where a unit in the last
/// place is 2^-21; each term may lose one when it is added, and the worst device always loses it on the same side. Rounding
/// to nearest loses half of that, on either side.
pub const TERM: f64 = 4.768_371_582e-7 / core::f64::consts::TAU;

/// Largest coordinate that a device may take for zero: scaled by 1/16, as the include does at first, it is subnormal.
pub const VANISHING: f32 = 16.0 * f32::MIN_POSITIVE;

/// The same for quads and polygons at the level [`Quality::Fast`], absolute and measured, in [`FAST_FAMILIES`]. Elsewhere that
/// level promises no more than physical values: a flat light is its four directions there, so one that touches the surface or
/// is much larger than its distance loses the digits of that distance, on plain devices too.
pub const FAST: [f64; 2] = [1e-3, 2e-3];

/// The families of flat lights in which the level [`Quality::Fast`] is bounded.
pub const FAST_FAMILIES: [&str; 5] = [
    "size at least a tenth of the distance",
    "distant",
    "distant, on the horizon",
    "distant, on a turned horizon",
    "ceiling",
];

/// How far the form factor and the specular value may be from exact arithmetic on the numbers that the device is given, texels
/// included; the Schlick part may be twice as far as the specular value. Nothing for inputs of which no more is promised than
/// that values are physical, which are those, too, that a device which flushes subnormal numbers cannot tell from zero.
pub fn conforming_bound(quality: Quality, case: &Case) -> Option<[f64; 2]> {
    let is_flat = !case.shape.vertices().is_empty();
    if quality == Quality::Fast && is_flat {
        let [form_factor, specular] = FAST;
        let bounded = FAST_FAMILIES.contains(&case.family);
        return bounded.then_some([form_factor, specular + FACTORS[1] * case.specular_bound]);
    }
    let vanishes = |v: glam::Vec3| v.to_array().iter().any(|x| *x != 0.0 && x.abs() <= VANISHING);
    if case.shape.vertices().iter().any(|vertex| vanishes(*vertex - case.position)) {
        return None;
    }
    let plain = match case.bound {
        Bound::Physical => return None,
        Bound::Zero => return Some([1e-30, 1e-30]),
        Bound::Absolute(bound) => bound,
        Bound::Relative(bound) => bound * case.form_factor.unwrap_or(1.0),
    };
    let [factor, specular] = FACTORS;
    let terms = match &case.shape {
        Shape::Polygon { vertices, .. } => TERM * vertices.len() as f64,
        _ => 0.0,
    };
    Some([factor * plain + terms, specular * case.specular_bound + terms])
}
