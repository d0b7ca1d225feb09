//! The bounds that the documentation states hold for the twin in f32.

mod common;

use common::Bound;
use glam::DVec3;
use softbox::brdf::Lambert;
use softbox::light::Light;
use softbox::table::Table;
use softbox::truth;

#[test]
fn the_twin_in_single_precision_keeps_every_bound() {
    let table = Table::default();
    let cases = common::families::cases(200);
    let exact: Vec<_> = cases.iter().map(|case| common::twin::<f64>(&table, case)).collect();
    let values: Vec<_> =
        cases.iter().map(|case| common::twin::<f32>(&table, case).map(|v| v as f32)).collect();
    common::check("twin", &cases, &exact, &values, &table);
}

/// The bounds are against exact arithmetic, which the twin in f64 stands for: here is that it may.
#[test]
fn the_twin_in_double_precision_is_the_integral() {
    let table = Table::default();
    let mut compared = 0;
    for case in common::families::cases(8) {
        if matches!(case.bound, Bound::Physical) {
            continue;
        }
        let normal = case.normal.as_dvec3().normalize();
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let vector = |v: DVec3| DVec3::new(v.dot(tangent), v.dot(bitangent), v.dot(normal));
        let light = case.light().moved(|point| vector(point - case.position.as_dvec3()), vector);
        if matches!(light, Light::Tube { .. }) {
            // A tube is a line whose ends stand for its rims: close to the integral, and bounded in a test of its own.
            continue;
        }
        let integral = truth::light(&Lambert, DVec3::Z, &light, 1e-10).diffuse;
        let twin = common::twin::<f64>(&table, &case)[0];
        // Vertices that rounding has moved out of their plane make the two differ by as much.
        let tolerance = 1e-9 + 2e-6 * integral;
        assert!((twin - integral).abs() <= tolerance, "{twin} and {integral}: {case:?}");
        compared += 1;
    }
    assert!(compared > 10_000, "{compared}");
}
