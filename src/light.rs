//! Lights as the host prepares them.

use glam::DVec3;

/// Whether four points in order are the corners of a convex quad, so that `ltc_quad` may take it; any
/// other polygon goes through the polygon functions, vertex by vertex.
///
/// Repeated and collinear corners are convex, within a millionth of the area. A quad without area, or one
/// whose edges cross, is not.
///
/// ```
/// use glam::DVec3;
/// let corners = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
/// assert!(softbox::light::is_convex_quad(&corners));
/// let dart = [DVec3::ZERO, DVec3::X, DVec3::new(0.2, 0.2, 0.0), DVec3::Y];
/// assert!(!softbox::light::is_convex_quad(&dart));
/// ```
pub fn is_convex_quad(points: &[DVec3]) -> bool {
    let &[a, b, c, d] = points else { return false };
    // Any scale, so that no square leaves the range of numbers.
    let extent = [b - a, c - a, d - a].iter().map(|v| v.abs().max_element()).fold(0.0, f64::max);
    if extent <= 0.0 || !extent.is_finite() {
        return false;
    }
    let sides = [b - a, c - b, d - c, a - d].map(|side| side / extent);
    let area = ((c - a) / extent).cross((d - b) / extent);
    let least = -1e-6 * area.length_squared();
    area.length_squared() > 0.0 && (0..4).all(|i| sides[i].cross(sides[(i + 1) % 4]).dot(area) >= least)
}
