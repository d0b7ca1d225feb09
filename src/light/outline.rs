//! Facts about the outlines of polygons.

use glam::DVec3;

use super::LightError;

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

/// Share of a polygon's size by which its vertices may leave one plane.
const FLATNESS: f64 = 1e-4;

/// Share of the largest coordinate by which rounding to f32 may move a vertex, with room for a few operations
/// that made it.
const ROUNDING: f64 = 4.0 * f32::EPSILON as f64;

/// Unit normal of the emitting side of a planar polygon that does not cross itself.
///
/// # Errors
///
/// If there are fewer than three points, they cover no area, they are not in one plane, or two sides cross; by more
/// than rounding the vertices to f32 explains.
pub fn polygon_normal(points: &[DVec3]) -> Result<DVec3, LightError> {
    if points.len() < 3 {
        return Err(LightError::TooFewPoints { count: points.len() });
    }
    let sides: Vec<DVec3> = points.iter().map(|&point| point - points[0]).collect();
    let size = sides.iter().map(|side| side.abs().max_element()).fold(0.0, f64::max);
    let farthest = points.iter().map(|point| point.abs().max_element()).fold(0.0, f64::max);
    let slack = ROUNDING * farthest;
    let sides: Vec<DVec3> = sides.into_iter().map(|side| side / size.max(f64::MIN_POSITIVE)).collect();
    let slack = slack / size.max(f64::MIN_POSITIVE);
    let area: DVec3 = sides.windows(2).map(|pair| pair[0].cross(pair[1])).sum();
    if size == 0.0 || area.length() < 1e-9 {
        // A bow tie may cover as much on one side as on the other; its plane is that of any three of its points.
        let wide = sides.iter().flat_map(|a| sides.iter().map(move |b| a.cross(*b)));
        let wide = wide.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let crossed = wide
            .filter(|normal| normal.length() > 1e-6)
            .and_then(|normal| crossing(&sides, normal.normalize(), slack));
        return Err(match crossed {
            Some((first, second)) => LightError::Crossing { first: first + 1, second: second + 1 },
            None => LightError::NoArea,
        });
    }
    let normal = area.normalize();
    // A narrow polygon's plane is known no better than its width allows.
    let tilt = slack / area.length().min(1.0);
    if sides.iter().any(|side| side.dot(normal).abs() > FLATNESS + 4.0 * tilt) {
        return Err(LightError::NotPlanar { share: FLATNESS });
    }
    match crossing(&sides, normal, slack) {
        Some((first, second)) => Err(LightError::Crossing { first: first + 1, second: second + 1 }),
        None => Ok(normal),
    }
}

/// Two sides of a flat polygon that cross each other in their inside, by more than `slack` at each end.
fn crossing(points: &[DVec3], normal: DVec3, slack: f64) -> Option<(usize, usize)> {
    let count = points.len();
    let side = |index: usize| (points[index], points[(index + 1) % count]);
    // Distances from the line through a and b, to its left.
    let apart = |a: DVec3, b: DVec3, c: DVec3| (b - a).normalize_or_zero().cross(c - a).dot(normal);
    let across = |p: f64, q: f64| p.min(q) < -slack && p.max(q) > slack;
    let pairs = (0..count).flat_map(|first| (first + 1..count).map(move |second| (first, second)));
    pairs.into_iter().find(|&(first, second)| {
        let ((a, b), (c, d)) = (side(first), side(second));
        across(apart(a, b, c), apart(a, b, d)) && across(apart(c, d, a), apart(c, d, b))
    })
}
