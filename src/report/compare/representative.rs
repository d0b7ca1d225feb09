//! The representative point of a light.

use core::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::microfacet::Microfacet;
use super::{Input, comparator};
use crate::report::data::MethodInfo;
use crate::report::measure::Quad;
use crate::report::method::Method;

/// The representative point (Karis 2013, "Real Shading in Unreal Engine 4").
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Representative;

impl Method for Representative {
    fn info(&self) -> MethodInfo {
        comparator(
            "representative",
            "Representative point",
            "GGX at the point of the light closest to the mirror direction, times the solid angle, darkened as if the \
             lobe were widened by the light (Karis 2013); diffuse by the cosines at the vertices and the centre (Lagarde \
             and de Rousiers 2014).",
        )
    }

    fn value(&self, quad: &Quad) -> [f64; 3] {
        representative_value(&quad.into()).map(f64::from)
    }
}

/// (diffuse, specular, fresnel) of a rectangle by its representative point.
///
/// Specular: the light is taken for a point light of the same solid angle Ω in the place of the rectangle's point that is
/// closest to where the mirror direction meets the rectangle's plane. The lobe is thus as wide as lobe and light together,
/// and is divided by as much as a lobe of that width is higher: α² / α'², α' = α + √(Ω/π) / 2, as for a sphere of the
/// angular radius √(Ω/π) (Karis 2013, "Sphere Lights"). With the factor ½ a mirror that sees nothing but the light
/// reflects its radiance.
///
/// Diffuse: the solid angle times the mean of the clamped cosines at the four vertices and the centre (Lagarde and de
/// Rousiers 2014, "Moving Frostbite to Physically Based Rendering", rectangular lights).
pub fn representative_value(input: &Input) -> [f32; 3] {
    let [a, b, c, d] = input.corners.map(|v| v - input.position);
    let (x, y) = (b - a, d - a);
    let plane = x.cross(y);
    let distance = -plane.dot(a);
    if distance <= 0.0 {
        return [0.0; 3];
    }
    let n = input.normal;
    let [unit_a, unit_b, unit_c, unit_d] = [a, b, c, d].map(normalize);
    let solid_angle = triangle(unit_a, unit_b, unit_c) + triangle(unit_a, unit_c, unit_d);
    let unit_centre = normalize(a + b + c + d);
    let cosines = n.dot(unit_a).max(0.0)
        + n.dot(unit_b).max(0.0)
        + n.dot(unit_c).max(0.0)
        + n.dot(unit_d).max(0.0)
        + n.dot(unit_centre).max(0.0);
    let diffuse = solid_angle * cosines * (0.2 * FRAC_1_PI);

    let mirror = n * (2.0 * n.dot(input.view)) - input.view;
    // A ray that leaves the plane meets it at infinity.
    let facing = (-plane.dot(mirror)).max(1e-4 * plane.dot(plane).sqrt());
    let met = mirror * (distance / facing) - a;
    let along = (met.dot(x) / x.dot(x)).clamp(0.0, 1.0);
    let across = (met.dot(y) / y.dot(y)).clamp(0.0, 1.0);
    let light = normalize(a + x * along + y * across);
    if n.dot(light) <= 0.0 {
        return [diffuse, 0.0, 0.0];
    }
    let alpha = input.roughness * input.roughness;
    let widened = (alpha + 0.5 * (solid_angle * FRAC_1_PI).sqrt()).min(1.0);
    let [value, schlick, _] = Microfacet::new(n, input.view, alpha).evaluate(light);
    let specular = value * solid_angle * (alpha * alpha) / (widened * widened);
    [diffuse, specular, specular * schlick]
}

/// The solid angle of the triangle of three unit vectors (van Oosterom and Strackee 1983, equation 8).
fn triangle(a: Vec3, b: Vec3, c: Vec3) -> f32 {
    // By differences, so that small triangles keep their digits.
    let volume = a.dot((b - a).cross(c - a)).abs();
    let divisor = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
    2.0 * volume.atan2(divisor)
}

fn normalize(v: Vec3) -> Vec3 {
    v * (1.0 / v.dot(v).max(1e-30).sqrt())
}
