//! What each quality level promises of a case: on a device that rounds to nearest, and on every device that conforms to WGSL.

use super::{Bound, Case, Shape};
use crate::effects::Quality;

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

/// By how much a filter that weights texels by 8 binary places, as graphics processors have it, moves specular light and Schlick's part at
/// most, as a share of the albedo and beside the rounding of what follows: it takes the texels of a roughness and a view that are up
/// to 1/256 of a texel away. Measured over the catalogue: 0.0009.
pub const FILTERED: f64 = 0.002;

/// The largest number of every vector, and every radius, is within these or nothing where values are promised on devices that put
/// products in another order as well. The include brings lengths into range by reciprocals of up to 1e37; in another order two
/// of those may meet before either meets the length that it belongs to.
pub const REORDERED: core::ops::RangeInclusive<f32> = 1e-9..=1e9;

/// How far quads and polygons may be off at the level [`Quality::Fast`], in [`FAST_FAMILIES`]: the form factor, and specular light
/// beside what the catalogue allows it; absolute, and measured on the worst device that conforms. Elsewhere that level promises no
/// more of them than physical values: a flat light is its four directions there, so one that touches the surface or is much larger
/// than its distance loses the digits of that distance, on plain devices too.
pub const FAST: [f64; 2] = [1e-3, 2e-3];

/// The families of flat lights in which the level [`Quality::Fast`] is bounded: all but those that touch the surface or the point.
pub const FAST_FAMILIES: [&str; 24] = [
    "size at least a tenth of the distance",
    "distant",
    "distant, on the horizon",
    "distant, on a turned horizon",
    "an edge subtends nearly a half turn",
    "an edge subtends nearly nothing",
    "ceiling",
    "the point in the light",
    "a million times the distance",
    "edge-on",
    "vertices on the horizon",
    "flat on the horizon",
    "seen along the normal",
    "seen along the surface",
    "mirrors",
    "normal and view of any length",
    "between the table's texels",
    "far from the origin",
    "in units of 2^-40 to 2^40",
    "a million times as long as wide",
    "simple polygon",
    "thousands of vertices",
    "spiral",
    "around the nadir",
];

/// Rounding of view and normal turns the azimuth of a view by up to this over the sine of its angle to the normal.
const AZIMUTH: f64 = 1e-7;

/// The most that a turn of the lobe of [`Quality::Fast`] about the normal changes of specular light, as a share of it, where the
/// view is close to the normal: its closed form is not quite round there.
const UNROUND: f64 = 0.05;

/// Light below this has squares, in the frame of a narrow lobe, that are subnormal: a device may take them for zero, and Schlick's part
/// loses its direction.
const FAINT: f64 = 1e-17;

/// A case of the catalogue with the bounds that hold for it at a level, on a device that rounds to nearest and keeps the order of
/// the text; `specular` is its specular light by exact arithmetic at that level.
///
/// The exact levels share the bounds of the catalogue. At [`Quality::Fast`] exact arithmetic is that of its own closed forms. Quads
/// and polygons are bounded by [`FAST`], in [`FAST_FAMILIES`] alone. Disks, spheres and tubes are evaluated as elsewhere. Its lobe
/// shows the azimuth's rounding close to the normal.
pub fn at_level(quality: Quality, case: &Case, specular: f64) -> Case {
    let mut case = case.clone();
    if quality != Quality::Fast {
        return case;
    }
    case.form_factor = None;
    case.specular_bound = fast_bound(&case, specular);
    if !case.shape.vertices().is_empty() {
        let bounded = FAST_FAMILIES.contains(&case.family) && case.bound != Bound::Physical;
        let [form_factor, specular] = FAST;
        (case.bound, case.specular_bound) = match bounded {
            true => (Bound::Absolute(form_factor), specular + case.specular_bound),
            false => (Bound::Physical, f64::INFINITY),
        };
    }
    case
}

/// The catalogue's bound of specular light with what the lobe of [`Quality::Fast`] adds to it.
fn fast_bound(case: &Case, specular: f64) -> f64 {
    case.specular_bound + (AZIMUTH / case.tilt().max(1e-30)).min(UNROUND) * specular + FAINT
}

/// How far the form factor and the specular value may be from exact arithmetic on the numbers that the device is given, texels
/// included, which makes the latter `specular`; the Schlick part may be twice as far as that. Nothing for inputs of which no more is promised than
/// that values are physical, which are those, too, that a device which flushes subnormal numbers cannot tell from zero.
pub fn conforming_bound(quality: Quality, case: &Case, specular: f64) -> Option<[f64; 2]> {
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
    let plain_specular = match quality {
        Quality::Fast => fast_bound(case, specular),
        _ => case.specular_bound,
    };
    let [factor, specular_factor] = FACTORS;
    let terms = match &case.shape {
        Shape::Polygon { vertices, .. } => TERM * vertices.len() as f64,
        _ => 0.0,
    };
    Some([factor * plain + terms, specular_factor * plain_specular + terms])
}
