//! The bounds that the documentation states hold for the twin in f32.

mod common;

use common::{Bound, Case, Random, Shape};
use glam::{DVec3, Vec3};
use softbox::brdf::Lambert;
use softbox::effects::Effects;
use softbox::light::Light;
use softbox::table::Table;
use softbox::truth;

#[test]
fn the_twin_in_single_precision_keeps_every_bound() {
    let table = Table::default();
    let cases = common::cases(200);
    let exact = common::exact(&cases, &table);
    let values = common::twin(&cases, &table, Effects::NONE);
    common::check("twin", &cases, &exact, &values, &table);
}

/// The bounds are against exact arithmetic, which the twin in f64 stands for: here is that it may.
#[test]
fn the_twin_in_double_precision_is_the_integral() {
    let table = Table::default();
    let mut compared = 0;
    for case in common::cases(8) {
        if matches!(case.bound, Bound::Physical) {
            continue;
        }
        let normal = case.normal.as_dvec3().normalize();
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let vector = |v: DVec3| DVec3::new(v.dot(tangent), v.dot(bitangent), v.dot(normal));
        let light = case.shape.light().moved(|point| vector(point - case.position.as_dvec3()), vector);
        if matches!(light, Light::Tube { .. }) {
            // A tube is a line whose ends stand for its rims: close to the integral, and bounded in a test of its own.
            continue;
        }
        let integral = truth::light(&Lambert, DVec3::Z, &light, 1e-10).diffuse;
        let twin = case.twin::<f64>(&table, Effects::NONE)[0];
        // Vertices that rounding has moved out of their plane make the two differ by as much.
        let tolerance = 1e-9 + 2e-6 * integral;
        assert!((twin - integral).abs() <= tolerance, "{twin} and {integral}: {case:?}");
        compared += 1;
    }
    assert!(compared > 10_000, "{compared}");
}

/// The edge of a light that stands on a turned surface, cut at the lobe's horizon next to the surface point: the crossing
/// once came to lie on the wrong side of the point, which took all specular light away.
#[test]
fn a_crossing_next_to_the_point_stays_on_its_side() {
    let table = Table::default();
    let corners = [
        Vec3::new(-0.6460615, 0.19206198, 0.28338563),
        Vec3::new(0.64607567, -0.19208394, -0.28333843),
        Vec3::new(0.41328767, -0.7175637, -0.45790866),
        Vec3::new(-0.8788495, -0.33341774, 0.108815424),
    ];
    let mut random = Random::new(1);
    for step in 0..20_000 {
        let mut near = |v: Vec3| {
            let steps = if step == 0 { 0 } else { 4 };
            Vec3::from(v.to_array().map(|number| random.near(number, steps)))
        };
        let case = Case {
            family: "standing on a turned surface",
            position: Vec3::ZERO,
            normal: near(Vec3::new(-0.20311227, -0.45849174, -0.15231606)),
            view: near(Vec3::new(-0.1300628, -0.19394794, 0.2850817)),
            roughness: 1.0,
            shape: Shape::Quad { corners: corners.map(near), two_sided: false },
            bound: Bound::Physical,
            specular_bound: f64::INFINITY,
            form_factor: None,
        };
        let value = case.twin::<f32>(&table, Effects::NONE);
        let exact = case.twin::<f64>(&table, Effects::NONE);
        assert!((value[1] - exact[1]).abs() < 1e-3, "{value:?}, exact {exact:?}: {case:?}");
    }
}
