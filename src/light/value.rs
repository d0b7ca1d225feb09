//! The value of a light by the functions of the include.

use glam::DVec3;

use super::{Light, is_convex_quad};
use crate::effects::Effects;
use crate::shade::{
    LobeSum, LtcSurface, Real, Vector, ltc_disk, ltc_fast_polygon, ltc_fast_quad, ltc_polygon_add,
    ltc_polygon_begin, ltc_polygon_end, ltc_quad, ltc_sphere, ltc_tube,
};

/// The value (diffuse, specular, fresnel) of a polygon light, by `ltc_quad` for a `convex_quad` and by the
/// polygon functions for any other.
///
/// # Panics
///
/// If there is no point, or `convex_quad` is set and there are not four.
pub fn polygon_value<R: Real>(
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    points: &[R::Vec3],
    convex_quad: bool,
    two_sided: bool,
) -> R::Vec3 {
    if convex_quad {
        return ltc_quad(surface, lobes, [points[0], points[1], points[2], points[3]], two_sided);
    }
    let mut polygon = ltc_polygon_begin(surface, points[0]);
    for point in &points[1..] {
        ltc_polygon_add(&mut polygon, surface, lobes, *point);
    }
    ltc_polygon_end(&mut polygon, surface, lobes, two_sided)
}

/// The value (diffuse, specular, fresnel) of any light with some effects.
pub fn light_value_with<R: Real>(
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    light: &Light,
    effects: Effects,
) -> R::Vec3 {
    match light {
        Light::Polygon { points: corners, two_sided } if effects.is_fast() && !corners.is_empty() => {
            let v = |v: &DVec3| R::Vec3::new(R::new(v.x), R::new(v.y), R::new(v.z));
            let points: Vec<R::Vec3> = corners.iter().map(v).collect();
            match points[..] {
                [a, b, c] => ltc_fast_quad(surface, lobes, [a, b, c, c], *two_sided),
                [a, b, c, d] if is_convex_quad(corners) => {
                    ltc_fast_quad(surface, lobes, [a, b, c, d], *two_sided)
                }
                _ => ltc_fast_polygon(surface, lobes, &points, *two_sided),
            }
        }
        _ => light_value(surface, lobes, light),
    }
}

/// The value (diffuse, specular, fresnel) of any light.
pub fn light_value<R: Real>(surface: &LtcSurface<R>, lobes: &impl LobeSum<R>, light: &Light) -> R::Vec3 {
    let v = |v: DVec3| R::Vec3::new(R::new(v.x), R::new(v.y), R::new(v.z));
    match light {
        // No outline encloses anything.
        Light::Polygon { points, .. } if points.is_empty() => v(DVec3::ZERO),
        Light::Polygon { points, two_sided } => {
            let mut points = points.clone();
            if let [_, _, last] = points[..] {
                points.push(last);
            }
            let convex = is_convex_quad(&points);
            let points: Vec<R::Vec3> = points.iter().map(|point| v(*point)).collect();
            polygon_value(surface, lobes, &points, convex, *two_sided)
        }
        Light::Tube { start, end, radius, caps } => {
            ltc_tube(surface, lobes, v(*start), v(*end), R::new(*radius), *caps)
        }
        Light::Disk { center, half_x, half_y, two_sided } => {
            ltc_disk(surface, lobes, v(*center), v(*half_x), v(*half_y), *two_sided)
        }
        Light::Sphere { center, radius } => ltc_sphere(surface, lobes, v(*center), R::new(*radius)),
    }
}
