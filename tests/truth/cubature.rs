//! Cubature over a light's area, which shares nothing with the integration under test but the BRDF.

use std::f64::consts::PI;

use glam::DVec3;
use softbox::brdf::{Brdf, Ggx};

/// The three values over the light's area, and the sum of the magnitudes of what was added.
pub fn by_area(brdf: &Ggx, eye: DVec3, light: &[DVec3], tolerance: f64) -> [[f64; 3]; 2] {
    let normal = (1..light.len() - 1)
        .map(|index| (light[index] - light[0]).cross(light[index + 1] - light[0]))
        .sum::<DVec3>()
        .normalize();
    let function = |point: DVec3| {
        let direction = point.normalize();
        let weight = direction.z.max(0.0) * normal.dot(direction).abs() / point.length_squared();
        let specular = brdf.evaluate(eye, direction) * weight;
        let schlick = 1.0 - eye.dot((eye + direction).normalize());
        [weight / PI, specular, specular * schlick.powi(5)]
    };
    let mut totals = [[0.0; 3]; 2];
    for index in 1..light.len() - 1 {
        let triangle = [light[0], light[index], light[index + 1]];
        let sign = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).dot(normal).signum();
        let mut above = Vec::new();
        for corner in 0..3 {
            let (a, b) = (triangle[corner], triangle[(corner + 1) % 3]);
            if a.z >= 0.0 {
                above.push(a);
            }
            if (a.z >= 0.0) != (b.z >= 0.0) {
                above.push(a + (b - a) * (a.z / (a.z - b.z)));
            }
        }
        for corner in 1..above.len().max(2) - 1 {
            let part = [above[0], above[corner], above[corner + 1]];
            let rough = over_triangle(&part, &function);
            let fine = refined(&part, rough, tolerance, 0, &function);
            for component in 0..3 {
                totals[0][component] += sign * fine[component];
                totals[1][component] += fine[component];
            }
        }
    }
    totals
}

fn refined(
    triangle: &[DVec3; 3],
    rough: [f64; 3],
    tolerance: f64,
    depth: u32,
    function: &impl Fn(DVec3) -> [f64; 3],
) -> [f64; 3] {
    let [a, b, c] = *triangle;
    let (ab, bc, ca) = (0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a));
    let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    let values = parts.map(|part| over_triangle(&part, function));
    let sum =
        |values: [[f64; 3]; 4]| std::array::from_fn(|index| values.iter().map(|value| value[index]).sum());
    let total: [f64; 3] = sum(values);
    if depth > 8 || (0..3).all(|index| (total[index] - rough[index]).abs() <= tolerance * total[index].abs())
    {
        return total;
    }
    sum(std::array::from_fn(|index| refined(&parts[index], values[index], tolerance, depth + 1, function)))
}

/// Product of 5-point Gauss rules on the square that collapses to a triangle.
fn over_triangle(triangle: &[DVec3; 3], function: &impl Fn(DVec3) -> [f64; 3]) -> [f64; 3] {
    const RULE: [(f64, f64); 5] = [
        (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (0.906_179_845_938_664, 0.236_926_885_056_189_1),
    ];
    let (first, second) = (triangle[1] - triangle[0], triangle[2] - triangle[0]);
    let area = first.cross(second).length();
    let mut sum = DVec3::ZERO;
    for (u, u_weight) in RULE {
        for (v, v_weight) in RULE {
            let (s, t) = (0.5 * (1.0 + u), 0.5 * (1.0 + v));
            let value = function(triangle[0] + s * ((1.0 - t) * first + t * second));
            sum += 0.25 * u_weight * v_weight * s * area * DVec3::from(value);
        }
    }
    sum.to_array()
}
