//! Ground truth of textured lights, two ways that share nothing but the model.

use glam::DVec3;
use softbox::brdf::Ggx;
use softbox::report::{Quad, Region, random_quads};
use softbox::truth::{Truth, polygon, texel_shares, textured_polygon};

fn values(truth: &Truth) -> [f64; 3] {
    [truth.diffuse, truth.specular, truth.fresnel]
}

fn assert_near(found: [f64; 3], wanted: [f64; 3], share: f64, input: &dyn core::fmt::Debug) {
    for k in 0..3 {
        let bound = share * wanted[k].abs() + 1e-9;
        assert!((found[k] - wanted[k]).abs() < bound, "value {k}: {found:?}, not {wanted:?}: {input:?}");
    }
}

/// Texture coordinates of the point that a direction meets.
fn place(quad: &Quad, direction: DVec3) -> [f64; 2] {
    let [a, b, _, d] = quad.corners;
    let (u, v) = (b - a, a - d);
    let normal = u.cross(v);
    let point = direction * (d.dot(normal) / direction.dot(normal)) - d;
    [point.dot(u) / u.length_squared(), point.dot(v) / v.length_squared()]
}

fn cases(count: usize) -> Vec<(Ggx, Quad)> {
    let quads = random_quads(Region { roughness: (0.15, 1.0), cosine: (0.1, 1.0) }, count);
    quads.into_iter().map(|quad| (Ggx::new(quad.roughness.powi(2)), quad)).collect()
}

#[test]
fn a_plain_light_is_a_textured_one() {
    for (brdf, quad) in cases(40) {
        let plain = polygon(&brdf, quad.view, &quad.corners, false, 1e-7);
        let textured = textured_polygon(&brdf, quad.view, &quad.corners, false, 1e-7, &|_| 2.5, &[]);
        assert_near(values(&textured), values(&plain).map(|value| 2.5 * value), 1e-6, &quad);
    }
}

/// A light that is dark on one half is the other half.
#[test]
fn lines_are_where_emission_may_jump() {
    for (brdf, quad) in cases(40) {
        let [a, b, c, d] = quad.corners;
        let (lower, upper) = (0.5 * (a + b), 0.5 * (c + d));
        let half = polygon(&brdf, quad.view, &[a, lower, upper, d], false, 1e-7);
        let emission = |direction: DVec3| if place(&quad, direction)[0] < 0.5 { 1.0 } else { 0.0 };
        let textured =
            textured_polygon(&brdf, quad.view, &quad.corners, false, 1e-6, &emission, &[[lower, upper]]);
        assert!(textured.converged, "{quad:?}");
        assert_near(values(&textured), values(&half), 1e-5, &quad);
    }
}

/// Texels of one colour add up to a board of fields, and to a plain light.
#[test]
fn texels_add_up_to_the_integral() {
    let size = 64;
    for (brdf, quad) in cases(40) {
        let [a, b, _, d] = quad.corners;
        let is_light = |u: f64, v: f64| ((4.0 * u) as usize + (4.0 * v) as usize).is_multiple_of(2);
        let shares = texel_shares(&brdf, quad.view, [a, b, d], [size; 2]);
        let mut sums = [[0.0; 3]; 2];
        for (index, share) in shares.iter().enumerate() {
            let at = |k: usize| (k as f64 + 0.5) / size as f64;
            for k in 0..3 {
                sums[0][k] += share[k];
                sums[1][k] += if is_light(at(index % size), at(index / size)) { share[k] } else { 0.0 };
            }
        }
        let plain = polygon(&brdf, quad.view, &quad.corners, false, 1e-6);
        assert_near(sums[0], values(&plain), 2e-3, &("plain", &quad));
        let on = |u: f64, v: f64| d + (b - a) * u + (a - d) * v;
        let lines: Vec<[DVec3; 2]> = (1..4)
            .flat_map(|k| {
                let at = 0.25 * f64::from(k);
                [[on(at, 0.0), on(at, 1.0)], [on(0.0, at), on(1.0, at)]]
            })
            .collect();
        let emission = |direction: DVec3| {
            let [u, v] = place(&quad, direction);
            if is_light(u.clamp(0.0, 0.999), v.clamp(0.0, 0.999)) { 1.0 } else { 0.0 }
        };
        let board = textured_polygon(&brdf, quad.view, &quad.corners, false, 1e-4, &emission, &lines);
        assert!(board.converged, "{quad:?}");
        // Fields that the lobe hardly sees have values below that of the whole light by orders.
        for k in 0..3 {
            let (found, wanted) = (sums[1][k], values(&board)[k]);
            let bound = 2e-3 * values(&plain)[k] + 1e-9;
            assert!((found - wanted).abs() < bound, "board, value {k}: {found}, not {wanted}: {quad:?}");
        }
    }
}
