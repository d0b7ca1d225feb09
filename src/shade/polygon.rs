//! Polygons of any number of vertices, convex or not, vertex by vertex.

use super::quad::{OVER_TWO_PI, ltc_crossing, ltc_edge_about, ltc_offset};
use super::real::{Real, Vector};
use super::surface::{
    LTC_HEADROOM, LTC_TINY, LtcLobe, LtcSurface, constant, ltc_extent, ltc_to_frame,
    ltc_transform, ltc_value, unit,
};

/// State of a polygon that is given vertex by vertex.
#[derive(Clone, Copy, Debug)]
pub struct LtcPolygon<R: Real> {
    first: R::Vec3,
    scale: R,
    previous: R::Vec3,
    facing: R,
    diffuse: R,
    lobe_sum: R::Vec3,
    surface_crossing: Option<Point<R>>,
    lobe_crossing: Option<Point<R>>,
}

/// A point and its offset from the polygon's first vertex, which is known more precisely than the
/// difference of the two.
#[derive(Clone, Copy, Debug)]
struct Point<R: Real> {
    at: R::Vec3,
    offset: R::Vec3,
}

impl<R: Real> Point<R> {
    fn transform(self, lobe: &LtcLobe<R>) -> Self {
        Self { at: ltc_transform(lobe, self.at), offset: ltc_transform(lobe, self.offset) }
    }

    fn is_up(&self) -> bool {
        self.at.z() > constant(0.0)
    }
}

/// Starts a polygon at its first vertex.
pub fn ltc_polygon_begin<R: Real>(surface: &LtcSurface<R>, vertex: R::Vec3) -> LtcPolygon<R> {
    let zero: R = constant(0.0);
    let headroom: R = constant(LTC_HEADROOM);
    let to_first = vertex * headroom - surface.position * headroom;
    LtcPolygon {
        first: vertex,
        scale: constant::<R>(1.0) / ltc_extent::<R>(to_first).max(constant(LTC_TINY)),
        previous: vertex,
        facing: zero,
        diffuse: zero,
        lobe_sum: R::Vec3::new(zero, zero, zero),
        surface_crossing: None,
        lobe_crossing: None,
    }
}

/// Adds the next vertex.
pub fn ltc_polygon_add<R: Real>(
    polygon: &mut LtcPolygon<R>,
    surface: &LtcSurface<R>,
    lobe: &LtcLobe<R>,
    vertex: R::Vec3,
) {
    let headroom: R = constant(LTC_HEADROOM);
    let origin = surface.position * headroom;
    let first = polygon.first * headroom;
    let (a, b) = (polygon.previous * headroom, vertex * headroom);
    let extent = ltc_extent::<R>(a - origin).max(ltc_extent::<R>(b - origin));
    let scale = polygon.scale.min(constant::<R>(1e12) / extent.max(constant(1e-25)));
    let place = |v: R::Vec3| Point::<R> {
        at: ltc_to_frame(surface, (v - origin) * scale),
        offset: ltc_to_frame(surface, (v - first) * scale),
    };
    let reference = place(first).at;
    let (a, b) = (place(a), place(b));
    polygon.facing += a.offset.cross(b.offset).dot(reference);
    polygon.previous = vertex;
    let mut crossing = polygon.surface_crossing;
    cut(a, b, &mut crossing, &mut |a, b| ltc_polygon_edge(polygon, lobe, reference, a, b));
    polygon.surface_crossing = crossing;
}

/// The value (diffuse, specular, fresnel) of the polygon whose vertices have all been added.
pub fn ltc_polygon_end<R: Real>(
    polygon: &mut LtcPolygon<R>,
    surface: &LtcSurface<R>,
    lobe: &LtcLobe<R>,
    two_sided: bool,
) -> R::Vec3 {
    let first = polygon.first;
    ltc_polygon_add(polygon, surface, lobe, first);
    let over_two_pi: R = constant(OVER_TWO_PI);
    ltc_value(
        lobe,
        polygon.diffuse * over_two_pi,
        polygon.lobe_sum * over_two_pi,
        polygon.facing < constant(0.0),
        two_sided,
    )
}

/// Hands the part of an edge above z = 0 to `add`, and the piece of the plane that closes the cut
/// polygon from the first crossing to this one.
fn cut<R: Real>(
    a: Point<R>,
    b: Point<R>,
    first_crossing: &mut Option<Point<R>>,
    add: &mut dyn FnMut(Point<R>, Point<R>),
) {
    if !(a.is_up() | b.is_up()) {
        return;
    }
    if a.is_up() & b.is_up() {
        add(a, b);
        return;
    }
    let (above, below) = if a.is_up() { (a, b) } else { (b, a) };
    let height = above.at.z();
    let t = height / (height - below.at.z()).max(constant(LTC_TINY));
    let crossing = Point {
        at: ltc_crossing::<R>(above.at, below.at),
        offset: above.offset + (below.offset - above.offset) * t,
    };
    match *first_crossing {
        Some(base) if a.is_up() => add(crossing, base),
        Some(base) => add(base, crossing),
        None => *first_crossing = Some(crossing),
    }
    if a.is_up() { add(a, crossing) } else { add(crossing, b) }
}

/// Adds one edge that lies above the surface to both integrals.
fn ltc_polygon_edge<R: Real>(
    polygon: &mut LtcPolygon<R>,
    lobe: &LtcLobe<R>,
    reference: R::Vec3,
    a: Point<R>,
    b: Point<R>,
) {
    polygon.diffuse += edge_about(reference, a, b).z();
    let reference = ltc_transform(lobe, reference);
    let (a, b) = (a.transform(lobe), b.transform(lobe));
    let mut crossing = polygon.lobe_crossing;
    cut(a, b, &mut crossing, &mut |a, b| {
        polygon.lobe_sum = polygon.lobe_sum + edge_about(reference, a, b);
    });
    polygon.lobe_crossing = crossing;
}

fn edge_about<R: Real>(reference: R::Vec3, a: Point<R>, b: Point<R>) -> R::Vec3 {
    let direction = unit::<R>(reference);
    let a_away = ltc_offset::<R>(reference, direction, a.at, a.offset);
    let b_away = ltc_offset::<R>(reference, direction, b.at, b.offset);
    ltc_edge_about::<R>(direction, b_away, a_away)
}
