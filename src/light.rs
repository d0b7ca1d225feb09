//! Facts about the outlines of lights.

use glam::DVec3;

use crate::shade::{
    LtcLobe, LtcSurface, Real, ltc_polygon_add, ltc_polygon_begin, ltc_polygon_end, ltc_quad,
};

/// Share of the longest side's square below which a corner counts as straight: an order above what rounding a
/// rectangle's vertices to f32 can bend it by.
const STRAIGHT: f64 = 1e-6;

/// Whether `points` are the vertices of a convex quad, which is what `ltc_quad` takes.
///
/// Repeated vertices make it a triangle, a segment or a point, all of which are convex; so do straight corners, as
/// long as the outline does not run back over itself. Corners that are concave by no more than rounding to f32 can
/// bend them count as straight.
///
/// ```
/// use glam::DVec3;
/// use softbox::light::is_convex_quad;
///
/// let square = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
/// assert!(is_convex_quad(&square));
/// let bow_tie = [square[0], square[2], square[1], square[3]];
/// assert!(!is_convex_quad(&bow_tie));
/// ```
pub fn is_convex_quad(points: &[DVec3]) -> bool {
    let &[a, b, c, d] = points else {
        return false;
    };
    let extent = points.iter().map(|&point| (point - a).abs().max_element()).fold(0.0, f64::max);
    if !extent.is_finite() {
        return false;
    }
    if extent == 0.0 {
        return true;
    }
    // Sides in units of the quad's size, so that no product leaves the range of f64.
    let sides = [b - a, c - b, d - c, a - d].map(|side| side / extent);
    let present: Vec<DVec3> =
        sides.into_iter().filter(|side| side.length_squared() > STRAIGHT * STRAIGHT).collect();
    let normal = ((c - a) / extent).cross((d - b) / extent).normalize_or_zero();
    let corners = present.iter().zip(present.iter().cycle().skip(1));
    corners.into_iter().all(|(before, after)| {
        let turn = before.cross(*after);
        let turn_forward = turn.dot(normal);
        let straight = turn.length() <= STRAIGHT;
        // A quad of two distinct points runs back over itself at both, which harms nothing.
        let back = straight && before.dot(*after) < 0.0 && present.len() > 2;
        (straight || turn_forward > 0.0) && !back
    })
}

/// The value (diffuse, specular, fresnel) of a polygon light, by `ltc_quad` for a `convex_quad` and by the
/// polygon functions for any other.
///
/// # Panics
///
/// If there is no point, or `convex_quad` is set and there are not four.
pub fn ltc_light<R: Real>(
    surface: &LtcSurface<R>,
    lobe: &LtcLobe<R>,
    points: &[R::Vec3],
    convex_quad: bool,
    two_sided: bool,
) -> R::Vec3 {
    if convex_quad {
        return ltc_quad(surface, lobe, [points[0], points[1], points[2], points[3]], two_sided);
    }
    let mut polygon = ltc_polygon_begin(surface, points[0]);
    for point in &points[1..] {
        ltc_polygon_add(&mut polygon, surface, lobe, *point);
    }
    ltc_polygon_end(&mut polygon, surface, lobe, two_sided)
}
