//! Polygons of any number of vertices, convex or not, vertex by vertex.

use super::quad::{OVER_TWO_PI, ltc_crossing, ltc_edge_about, ltc_edge_normal, ltc_offset, ltc_shorter};
use super::real::{Real, Vector};
use super::several::{LobeSum, ltc_lobes_value, with_form_factor};
use super::surface::{
    LTC_HEADROOM, LTC_SMALLEST, LTC_TINY, LtcLobe, LtcSurface, ltc_extent, ltc_received, ltc_received_vector,
    ltc_transform, ltc_transform_normal, unit,
};

/// State of a polygon that is given vertex by vertex, and its last edge, cut at the surface's horizon: what all
/// lobes share of the work on it.
#[derive(Clone, Copy, Debug)]
pub struct LtcOutline<R: Real> {
    first: R::Vec3,
    scale: R,
    /// Whether the first vertex counts as above the surface.
    first_up: bool,
    /// Whether the last vertex so far does.
    previous_up: bool,
    previous: R::Vec3,
    facing: R,
    diffuse: R,
    crossing: Option<Point<R>>,
    /// The first vertex, scaled as the points of the last edges.
    reference: R::Vec3,
    /// Whether the last edge starts and ends above the horizon.
    up: [bool; 2],
    /// Whether it ends at the first vertex.
    returns: bool,
    /// What it left above the surface: a piece of the horizon that closes it, and the edge itself.
    closing: Option<Part<R>>,
    edge: Option<Part<R>>,
}

/// What one lobe knows of an outline.
#[derive(Clone, Copy, Debug)]
pub struct LtcOutlineLobe<R: Real> {
    crossing: Option<Point<R>>,
    /// Whether the first vertex counts as above the lobe's horizon; none before the first edge.
    first_up: Option<bool>,
    /// Whether the last vertex so far does.
    previous_up: bool,
    /// Whether the outline's first point on the surface's horizon does.
    crossing_up: bool,
    sum: R::Vec3,
}

/// A polygon's outline and the lobes that it lights.
#[derive(Clone, Copy, Debug)]
pub struct LtcPolygon<R: Real> {
    outline: LtcOutline<R>,
    sums: [LtcOutlineLobe<R>; 3],
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
}

/// Starts an outline at its first vertex.
pub fn ltc_outline_begin<R: Real>(surface: &LtcSurface<R>, corner: R::Vec3) -> LtcOutline<R> {
    let zero: R = R::new(0.0);
    let headroom: R = R::new(LTC_HEADROOM);
    let to_first = corner * headroom - surface.position * headroom;
    let first_up = surface.normal.dot(to_first) > zero;
    LtcOutline {
        first_up,
        previous_up: first_up,
        first: corner,
        scale: R::new(1.0) / ltc_extent::<R>(to_first).max(R::new(LTC_SMALLEST)),
        previous: corner,
        facing: zero,
        diffuse: zero,
        crossing: None,
        reference: R::Vec3::new(zero, zero, zero),
        up: [first_up; 2],
        returns: false,
        closing: None,
        edge: None,
    }
}

/// Adds the next vertex, or the first one again to close the outline.
pub fn ltc_outline_add<R: Real>(outline: &mut LtcOutline<R>, surface: &LtcSurface<R>, corner: R::Vec3) {
    let headroom: R = R::new(LTC_HEADROOM);
    let origin = surface.position * headroom;
    let first = outline.first * headroom;
    let (a, b) = (outline.previous * headroom, corner * headroom);
    let extent = ltc_extent::<R>(a - origin).max(ltc_extent::<R>(b - origin));
    let scale = outline.scale.min(R::new(1e8) / extent.max(R::new(1e-11)));
    let place = |v: R::Vec3| Point::<R> { at: (v - origin) * scale, offset: (v - first) * scale };
    let reference = place(first).at;
    let side = (b - a) * scale;
    let (a, b) = (place(a), place(b));
    let lever = ltc_shorter::<R>(ltc_shorter::<R>(a.offset, b.offset), ltc_shorter::<R>(a.at, b.at));
    outline.facing += lever.cross(side).dot(reference);
    outline.returns = corner == outline.first;
    outline.previous = corner;
    outline.reference = reference;

    let normal = surface.normal;
    let height = normal.dot(reference);
    let reach = a.offset.dot(a.offset).max(b.offset.dot(b.offset));
    let near = reach < R::new(0.0625) * reference.dot(reference);
    let [a_height, b_height] =
        [a, b].map(|p| if near { height + normal.dot(p.offset) } else { normal.dot(p.at) });
    let zero: R = R::new(0.0);
    // As in the include: a vertex counts the same for both of its edges.
    let b_up = if outline.returns { outline.first_up } else { b_height > zero };
    let a_up = core::mem::replace(&mut outline.previous_up, b_up);
    outline.up = [a_up, b_up];
    let ends = [(a, a_height, a_up), (b, b_height, b_up)];
    let parts = cut(ends[0], ends[1], &mut outline.crossing, |above, below, t| {
        let between = above.at + (below.at - above.at) * t;
        Point {
            at: between - normal * normal.dot(between),
            offset: above.offset + (below.offset - above.offset) * t,
        }
    });
    [outline.closing, outline.edge] = parts.map(|part| {
        part.map(|((start, end), closing)| {
            let product = ltc_edge_normal::<R>(start.at, end.at, end.offset - start.offset);
            Part {
                edge: (start, end),
                normal: if closing { normal * normal.dot(product) } else { product },
                is_horizon: closing,
            }
        })
    });
    for part in [outline.closing, outline.edge].into_iter().flatten() {
        outline.diffuse += -normal.dot(ltc_edge_from(reference, part.edge, part.normal));
    }
}

/// Starts a lobe's part of an outline.
pub fn ltc_outline_lobe_begin<R: Real>() -> LtcOutlineLobe<R> {
    let zero: R = R::new(0.0);
    LtcOutlineLobe {
        crossing: None,
        first_up: None,
        previous_up: false,
        crossing_up: false,
        sum: R::Vec3::new(zero, zero, zero),
    }
}

/// Adds what [`ltc_outline_add`] has last added to `outline` to a lobe.
pub fn ltc_outline_lobe_add<R: Real>(
    sum: &mut LtcOutlineLobe<R>,
    outline: &LtcOutline<R>,
    lobe: &LtcLobe<R>,
) {
    let Some(edge) = outline.edge.map(|part| part.transform(lobe)) else { return };
    let reference = ltc_transform(lobe, outline.reference);
    let is_above = |point: Point<R>| point.at.z() > R::new(0.0);
    let [starts_up, ends_up] = outline.up;
    // As in the include: a point counts the same for all edges that share it.
    let start_up = match sum.first_up {
        Some(_) if starts_up => sum.previous_up,
        _ => is_above(edge.edge.0),
    };
    let first_up = *sum.first_up.get_or_insert(start_up);
    let end_up = if outline.returns & ends_up { first_up } else { is_above(edge.edge.1) };
    sum.previous_up = end_up;
    if starts_up != ends_up {
        let crossing_up = if starts_up { end_up } else { start_up };
        match outline.closing.map(|part| part.transform(lobe)) {
            Some(closing) if starts_up => {
                ltc_outline_lobe_edge(sum, reference, closing, [crossing_up, sum.crossing_up]);
            }
            Some(closing) => ltc_outline_lobe_edge(sum, reference, closing, [sum.crossing_up, crossing_up]),
            None => sum.crossing_up = crossing_up,
        }
    }
    ltc_outline_lobe_edge(sum, reference, edge, [start_up, end_up]);
}

/// The form factor of a closed outline, 0…1.
pub fn ltc_outline_diffuse<R: Real>(outline: &LtcOutline<R>, two_sided: bool) -> R {
    ltc_received(outline.diffuse * R::new(OVER_TWO_PI), outline.facing < R::new(0.0), two_sided)
}

/// The vector form factor of a closed outline in a lobe's space, cut at both horizons, towards the light.
pub fn ltc_outline_lobe<R: Real>(
    outline: &LtcOutline<R>,
    sum: &LtcOutlineLobe<R>,
    two_sided: bool,
) -> R::Vec3 {
    ltc_received_vector::<R>(sum.sum * R::new(OVER_TWO_PI), outline.facing < R::new(0.0), two_sided)
}

/// Starts a polygon at its first vertex.
pub fn ltc_polygon_begin<R: Real>(surface: &LtcSurface<R>, corner: R::Vec3) -> LtcPolygon<R> {
    LtcPolygon { outline: ltc_outline_begin(surface, corner), sums: [ltc_outline_lobe_begin(); 3] }
}

/// Adds the next vertex.
pub fn ltc_polygon_add<R: Real>(
    polygon: &mut LtcPolygon<R>,
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    corner: R::Vec3,
) {
    ltc_outline_add(&mut polygon.outline, surface, corner);
    for (sum, lobe) in polygon.sums.iter_mut().zip(lobes.lobes()) {
        ltc_outline_lobe_add(sum, &polygon.outline, lobe);
    }
}

/// The value (diffuse, specular, fresnel) of the polygon whose vertices have all been added.
pub fn ltc_polygon_end<R: Real>(
    polygon: &mut LtcPolygon<R>,
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    two_sided: bool,
) -> R::Vec3 {
    let first = polygon.outline.first;
    ltc_polygon_add(polygon, surface, lobes, first);
    let form_factor = ltc_outline_diffuse(&polygon.outline, two_sided);
    let mut sums = polygon.sums.iter();
    let specular = ltc_lobes_value(surface, lobes, |_| {
        let sum = sums.next().expect("there are as many sums as a sum has lobes at most");
        ltc_outline_lobe(&polygon.outline, sum, two_sided)
    });
    with_form_factor(form_factor, specular)
}

/// A directed edge.
type Edge<R> = (Point<R>, Point<R>);

/// A part of an outline above the surface.
#[derive(Clone, Copy, Debug)]
struct Part<R: Real> {
    edge: Edge<R>,
    /// The cross product of its ends.
    normal: R::Vec3,
    /// Whether it is a piece of the horizon.
    is_horizon: bool,
}

impl<R: Real> Part<R> {
    fn transform(self, lobe: &LtcLobe<R>) -> Self {
        Self {
            edge: (self.edge.0.transform(lobe), self.edge.1.transform(lobe)),
            normal: ltc_transform_normal(lobe, self.normal),
            is_horizon: self.is_horizon,
        }
    }
}

/// An end of an edge with its height over a plane, and whether it counts as above.
type End<R> = (Point<R>, R, bool);

/// The part of an edge from `a` to `b` that lies above a plane, and before it the piece of the plane that
/// closes the cut polygon, from its first crossing to this one. The flag marks the latter.
fn cut<R: Real>(
    (a, a_height, a_up): End<R>,
    (b, b_height, b_up): End<R>,
    first_crossing: &mut Option<Point<R>>,
    cross: impl Fn(Point<R>, Point<R>, R) -> Point<R>,
) -> [Option<(Edge<R>, bool)>; 2] {
    if a_up & b_up {
        return [None, Some(((a, b), false))];
    }
    if !(a_up | b_up) {
        return [None, None];
    }
    let (above, below) = if a_up { (a, b) } else { (b, a) };
    let (high, low) = if a_up { (a_height, b_height) } else { (b_height, a_height) };
    let (high, low) = (high.max(R::new(0.0)), low.min(R::new(0.0)));
    let t = high / (high - low).max(R::new(LTC_TINY));
    let crossing = cross(above, below, t);
    let closing = match *first_crossing {
        Some(base) => Some((if a_up { (crossing, base) } else { (base, crossing) }, true)),
        None => {
            *first_crossing = Some(crossing);
            None
        }
    };
    [closing, Some((if a_up { (a, crossing) } else { (crossing, b) }, false))]
}

/// Adds one edge that lies above the surface or on its horizon, in the lobe's space, whose ends count as above the lobe's
/// horizon or not.
fn ltc_outline_lobe_edge<R: Real>(
    sum: &mut LtcOutlineLobe<R>,
    reference: R::Vec3,
    part: Part<R>,
    [a_up, b_up]: [bool; 2],
) {
    let ((a, b), normal) = (part.edge, part.normal);
    let turned = if a_up { normal } else { -normal };
    let ends = [(a, a.at.z(), a_up), (b, b.at.z(), b_up)];
    let edges = cut(ends[0], ends[1], &mut sum.crossing, |above, below, t| {
        let at = ltc_crossing::<R>(above.at, below.at, turned, part.is_horizon);
        let reach = above.offset.dot(above.offset).max(below.offset.dot(below.offset));
        // As in the include: the offset of a point that is known by its direction only is that of what stands for it.
        let offset = if reach < R::new(0.0625) * reference.dot(reference) {
            above.offset + (below.offset - above.offset) * t
        } else {
            at - reference
        };
        Point { at, offset }
    });
    for (edge, closing) in edges.into_iter().flatten() {
        let (start, end) = edge;
        let horizon = ltc_edge_normal::<R>(start.at, end.at, end.at - start.at);
        let normal = if closing { horizon } else { normal };
        sum.sum = sum.sum - ltc_edge_from(reference, edge, normal);
    }
}

/// [`ltc_edge_about`](super::ltc_edge_about) for points and their offsets from `origin`.
fn ltc_edge_from<R: Real>(origin: R::Vec3, (a, b): Edge<R>, normal: R::Vec3) -> R::Vec3 {
    let reference = unit::<R>(origin);
    let (a_unit, b_unit) = (unit::<R>(a.at), unit::<R>(b.at));
    let a_away = ltc_offset::<R>(origin, reference, a.at, a.offset);
    let b_away = ltc_offset::<R>(origin, reference, b.at, b.offset);
    ltc_edge_about::<R>(reference, a_unit, a_away, b_unit, b_away, normal)
}
