//! Lobes over quads in exact arithmetic for every practical purpose, by cutting polygons.

use core::f64::consts::TAU;
use glam::DVec3;

use crate::fit::fit_angle_excess;
use crate::shade::{LtcLobe, LtcSurface, ltc_lobe_value, ltc_transform};

/// The angle between two unit vectors.
pub type EdgeAngle<'a> = &'a (dyn Fn(DVec3, DVec3) -> f64 + Sync);

/// The angle itself.
pub fn exact_angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// The angle by the polynomial of the include's `ltc_angle_excess`, in f64: its coefficients are those of
/// [`fit_angle_excess`], rounded to f32.
pub fn fitted_angle() -> impl Fn(DVec3, DVec3) -> f64 + Sync {
    let coefficients = fit_angle_excess(7).0.into_iter().map(|q| f64::from(q as f32));
    let coefficients: Vec<f64> = coefficients.collect();
    move |a, b| {
        let chord = b - a;
        let k = 0.5 * chord.length_squared();
        let lesser = k.min((2.0 - k).max(0.0));
        let excess = lesser * coefficients.iter().rev().fold(0.0, |sum, q| sum * lesser + q);
        let acute = a.cross(chord).length() * (1.0 + excess);
        if k > 1.0 { core::f64::consts::PI - acute } else { acute }
    }
}

/// (diffuse, specular, fresnel) of lobes over a quad that is counter-clockwise seen from the surface point, which is the
/// origin: cut at the surface's horizon z = 0, then in the space of each lobe at that one's. A sum of lobes has the sum
/// of their values.
pub fn exact_value(
    surface: &LtcSurface<f64>,
    lobes: &[LtcLobe<f64>],
    corners: &[DVec3],
    angle: EdgeAngle,
) -> [f64; 3] {
    let above = cut(corners);
    let mut value = [form_factor(&above, angle).z.clamp(0.0, 1.0), 0.0, 0.0];
    for lobe in lobes {
        let moved: Vec<DVec3> = above.iter().map(|corner| ltc_transform(lobe, *corner)).collect();
        let [specular, fresnel] = ltc_lobe_value(surface, lobe, form_factor(&cut(&moved), angle)).to_array();
        value[1] += specular;
        value[2] += fresnel;
    }
    value
}

/// The part of a convex polygon above the plane z = 0 (Sutherland and Hodgman 1974).
fn cut(corners: &[DVec3]) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        if a.z > 0.0 {
            kept.push(*a);
        }
        if (a.z > 0.0) != (b.z > 0.0) {
            kept.push((*a + (*b - *a) * (a.z / (a.z - b.z))).with_z(0.0));
        }
    }
    kept
}

/// Vector form factor of a polygon (Lambert 1760): the sum of the edges' angles along their planes' normals.
fn form_factor(corners: &[DVec3], angle: EdgeAngle) -> DVec3 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let sum: DVec3 = edges
        .map(|(a, b)| {
            let normal = a.cross(*b - *a).normalize_or_zero();
            normal * angle(a.normalize_or_zero(), b.normalize_or_zero())
        })
        .sum();
    -sum / TAU
}
