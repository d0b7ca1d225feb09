//! Edges and convex quads.

use super::real::{Real, Vector};
use super::several::{LobeSum, ltc_lobes_value, with_form_factor};
use super::surface::{
    LTC_HEADROOM, LTC_TINY, LtcLobe, LtcSurface, ltc_extent, ltc_received, ltc_received_vector,
    ltc_transform, ltc_transform_normal, unit,
};

pub(super) const OVER_TWO_PI: f64 = 0.5 / core::f64::consts::PI;

/// (θ / sin θ) − 1 from k = 1 − cos θ in 0…1.
pub fn ltc_angle_excess<R: Real>(k: R) -> R {
    R::angle_excess(k)
}

/// The cross product a × b of two vectors whose difference b − a is `side`, from the shorter of the two.
pub fn ltc_edge_normal<R: Real>(a: R::Vec3, b: R::Vec3, side: R::Vec3) -> R::Vec3 {
    (if b.dot(b) < a.dot(a) { b } else { a }).cross(side)
}

/// The edge integral of the segment between two directions: the angle between the unit vectors `a` and `b`
/// along the unit normal of their plane. `normal` is the cross product of the two vectors before they were
/// divided by their lengths, `scale` the reciprocal of the product of these.
pub fn ltc_edge<R: Real>(a: R::Vec3, b: R::Vec3, normal: R::Vec3, scale: R) -> R::Vec3 {
    let squared = normal.dot(normal);
    let inverse_length = squared.max(R::new(LTC_TINY)).inverse_sqrt();
    normal * (inverse_length * ltc_angle::<R>(a, b, squared * inverse_length * scale))
}

/// [`ltc_edge`] for a part of an edge, for which `normal` has the right direction only.
pub fn ltc_edge_part<R: Real>(a: R::Vec3, b: R::Vec3, normal: R::Vec3) -> R::Vec3 {
    let product = a.cross(b - a);
    let squared = product.dot(product);
    let inverse_length = normal.dot(normal).max(R::new(LTC_TINY)).inverse_sqrt();
    let sine = squared * squared.max(R::new(1e-30)).inverse_sqrt();
    normal * (inverse_length * ltc_angle::<R>(a, b, sine))
}

/// The angle between the unit vectors `a` and `b`, whose sine is given.
pub fn ltc_angle<R: Real>(a: R::Vec3, b: R::Vec3, sine: R) -> R {
    let (zero, one, two) = (R::new(0.0), R::new(1.0), R::new(2.0));
    let chord = b - a;
    let k = R::new(0.5) * chord.dot(chord);
    let bounded = sine.min(one);
    let acute = bounded + bounded * ltc_angle_excess(k.min((two - k).max(zero)));
    if k > one { R::new(core::f64::consts::PI) - acute } else { acute }
}

/// The edge integral of the unit vectors `a` and `b`, less a part that vanishes over every closed
/// polygon; see the include. The offsets are a − reference and b − reference.
pub fn ltc_edge_about<R: Real>(
    reference: R::Vec3,
    a: R::Vec3,
    a_offset: R::Vec3,
    b: R::Vec3,
    b_offset: R::Vec3,
    normal: R::Vec3,
) -> R::Vec3 {
    let near = ltc_edge_near::<R>(reference, a, a_offset, b_offset);
    if a_offset.dot(a_offset).max(b_offset.dot(b_offset)) < R::new(0.0625) {
        return near;
    }
    let near_part = ltc_edge_excess::<R>(a, b_offset - a_offset);
    near - near_part + ltc_edge_part::<R>(a, b, normal) - a.cross(b - a)
}

/// [`ltc_edge_about`] for offsets that are both shorter than a quarter.
pub fn ltc_edge_near<R: Real>(
    reference: R::Vec3,
    a: R::Vec3,
    a_offset: R::Vec3,
    b_offset: R::Vec3,
) -> R::Vec3 {
    let along = reference.dot(a_offset.cross(b_offset));
    let across = (a_offset * b_offset.dot(b_offset) - b_offset * a_offset.dot(a_offset)) * R::new(0.5);
    reference * along + reference.cross(across) + ltc_edge_excess::<R>(a, b_offset - a_offset)
}

/// The edge integral of a short edge from the unit vector `a` along `chord`, less the cross product of its
/// ends.
pub fn ltc_edge_excess<R: Real>(a: R::Vec3, chord: R::Vec3) -> R::Vec3 {
    a.cross(chord) * ltc_angle_excess((R::new(0.5) * chord.dot(chord)).min(R::new(1.0)))
}

/// Difference of the directions of `target_point` and `origin`, which differ by `offset`, with the
/// relative precision of `offset`. `reference` is the direction of `origin`.
pub fn ltc_offset<R: Real>(
    origin: R::Vec3,
    reference: R::Vec3,
    target_point: R::Vec3,
    offset: R::Vec3,
) -> R::Vec3 {
    let square = target_point.dot(target_point);
    let inverse_length = square.max(R::new(LTC_TINY)).inverse_sqrt();
    let length_sum = square * inverse_length + origin.dot(reference);
    let length_difference = offset.dot(origin + target_point) / length_sum.max(R::new(LTC_TINY));
    if offset.dot(offset) < R::new(0.0625) * origin.dot(origin) {
        (offset - reference * length_difference) * inverse_length
    } else {
        target_point * inverse_length - reference
    }
}

/// [`ltc_offset`] for an offset much shorter than `origin`.
pub fn ltc_far_offset<R: Real>(origin: R::Vec3, reference: R::Vec3, offset: R::Vec3) -> R::Vec3 {
    let target_point = origin + offset;
    let square = target_point.dot(target_point);
    let inverse_length = square.max(R::new(LTC_TINY)).inverse_sqrt();
    let length_sum = square * inverse_length + origin.dot(reference);
    let length_difference = offset.dot(origin + target_point) / length_sum.max(R::new(LTC_TINY));
    (offset - reference * length_difference) * inverse_length
}

/// Whether `v` lies above the lobe's horizon, or on it but for rounding.
pub fn ltc_is_above<R: Real>(v: R::Vec3, tolerance: R) -> bool {
    (v.z() > R::new(0.0)) | (v.z() * v.z() < tolerance * v.dot(v))
}

/// That rounding, squared, in the space of a lobe, which squeezes heights by the length of its third axis.
pub fn ltc_above_tolerance<R: Real>(lobe: &LtcLobe<R>) -> R {
    R::new(1e-12) * lobe.axis_z.dot(lobe.axis_z).min(R::new(1.0))
}

/// Where the segment from `above` the plane z = 0 to `below` it meets that plane; only its direction where it
/// passes the surface point closely. `normal` has the direction of above × below.
pub fn ltc_crossing<R: Real>(above: R::Vec3, below: R::Vec3, normal: R::Vec3) -> R::Vec3 {
    let zero: R = R::new(0.0);
    let t = above.z().max(zero) / (above.z() - below.z()).max(R::new(LTC_TINY));
    let between =
        R::Vec3::new(above.x() + (below.x() - above.x()) * t, above.y() + (below.y() - above.y()) * t, zero);
    let turned = R::Vec3::new(normal.y(), -normal.x(), zero);
    let cancels = between.dot(between) < R::new(1e-6) * above.dot(above).max(below.dot(below));
    let tilted = turned.dot(turned) > R::new(1e-3) * normal.dot(normal);
    if cancels & tilted { turned } else { between }
}

/// Vector form factor, times 2π and signed, of a convex pentagon in the lobe's space, cut at the lobe's
/// horizon. Each normal has the direction of the cross product of its vertex and the next one.
pub fn ltc_pentagon<R: Real>(vertices: [R::Vec3; 5], normals: [R::Vec3; 5], tolerance: R) -> R::Vec3 {
    let zero: R = R::new(0.0);
    let up = vertices.map(|v| ltc_is_above::<R>(v, tolerance));
    if up == [false; 5] {
        return R::Vec3::new(zero, zero, zero);
    }
    let inverses = vertices.map(inverse_length::<R>);
    let units: [R::Vec3; 5] = core::array::from_fn(|i| vertices[i] * inverses[i]);
    let next = |i: usize| (i + 1) % 5;
    if up == [true; 5] {
        let edge =
            |i: usize| ltc_edge::<R>(units[i], units[next(i)], normals[i], inverses[i] * inverses[next(i)]);
        return -(edge(0) + edge(1) + edge(2) + edge(3) + edge(4));
    }
    // The last edge that leaves the upper side and the last one that comes back, as in the include; a convex
    // polygon has one of each.
    let (mut leaving, mut entering) = (0, 4);
    for i in 1..5 {
        if up[i] & !up[next(i)] {
            leaving = i;
        }
        if up[i] & !up[i - 1] {
            entering = i - 1;
        }
    }
    let (from, to) = (vertices[leaving], vertices[next(leaving)]);
    let leave = ltc_crossing::<R>(from, to, normals[leaving]);
    let (from, to) = (vertices[entering], vertices[next(entering)]);
    let enter = ltc_crossing::<R>(to, from, -normals[entering]);
    let horizon_normal = ltc_edge_normal::<R>(leave, enter, enter - leave);
    let (leave, enter) = (unit::<R>(leave), unit::<R>(enter));
    let ends: [R::Vec3; 5] = core::array::from_fn(|i| match (up[i], up[(i + 4) % 5]) {
        (true, _) => units[i],
        (false, true) => leave,
        (false, false) => enter,
    });
    let starts: [R::Vec3; 5] = core::array::from_fn(|i| if up[i] { units[i] } else { enter });
    let horizon = ltc_edge_part::<R>(leave, enter, horizon_normal);
    let edge = |i: usize| ltc_edge_part::<R>(starts[i], ends[next(i)], normals[i]);
    -(edge(0) + edge(1) + edge(2) + edge(3) + edge(4) + horizon)
}

/// 1 over the length of `v`.
fn inverse_length<R: Real>(v: R::Vec3) -> R {
    v.dot(v).max(R::new(LTC_TINY)).inverse_sqrt()
}

/// Vector form factor, times 2π and signed, of a pentagon above the horizon from one point `origin` on
/// or near it and the offsets of its vertices from there, all much shorter than the distance.
pub fn ltc_far_pentagon<R: Real>(origin: R::Vec3, vertices: [R::Vec3; 5]) -> R::Vec3 {
    let reference = unit::<R>(origin);
    let offsets = vertices.map(|v| ltc_far_offset::<R>(origin, reference, v));
    let squares = offsets.map(|offset| offset.dot(offset));
    let (next, last) = (|i: usize| (i + 1) % 5, |i: usize| (i + 4) % 5);
    let product = |i: usize| offsets[i].cross(offsets[next(i)]);
    let area = product(0) + product(1) + product(2) + product(3) + product(4);
    let across = |i: usize| offsets[i] * (squares[next(i)] - squares[last(i)]);
    let across = across(0) + across(1) + across(2) + across(3) + across(4);
    let excess = |i: usize| ltc_edge_excess::<R>(reference + offsets[i], offsets[next(i)] - offsets[i]);
    let excess = excess(0) + excess(1) + excess(2) + excess(3) + excess(4);
    -(reference * reference.dot(area) + reference.cross(across * R::new(0.5)) + excess)
}

/// A convex quad light, cut at the surface's horizon: what all lobes share of the work on it.
#[derive(Clone, Copy, Debug)]
pub struct LtcQuad<R: Real> {
    /// The vertices of the pentagon that is left of the quad, from `base`.
    vertices: [R::Vec3; 5],
    /// Cross products of each vertex and the next one, both from the surface point.
    normals: [R::Vec3; 5],
    /// Zero for a near light; for a distant one the quad's first vertex from the surface point.
    base: R::Vec3,
    reaches: bool,
    distant: bool,
    front: bool,
    two_sided: bool,
}

/// Cuts a convex quad light at the surface's horizon.
pub fn ltc_quad_begin<R: Real>(
    surface: &LtcSurface<R>,
    vertices: [R::Vec3; 4],
    two_sided: bool,
) -> LtcQuad<R> {
    let zero: R = R::new(0.0);
    let nothing = R::Vec3::new(zero, zero, zero);
    let headroom: R = R::new(LTC_HEADROOM);
    let origin = surface.position * headroom;
    let far = vertices.map(|v| v * headroom);
    let full = far.map(|v| v - origin);
    let extents = full.map(ltc_extent::<R>);
    let extent = extents[0].max(extents[1]).max(extents[2].max(extents[3]));
    let scale = R::new(1.0) / extent.max(R::new(LTC_TINY));
    let sides = [far[1], far[2], far[3]].map(|v| (v - far[0]) * scale);
    let p_a = full[0] * scale;
    let front = sides[1].cross(sides[2] - sides[0]).dot(p_a) < zero;
    let mut quad = LtcQuad {
        vertices: [nothing; 5],
        normals: [nothing; 5],
        base: nothing,
        reaches: false,
        distant: false,
        front,
        two_sided,
    };
    if !(front | two_sided) {
        return quad;
    }
    let size_squared = largest(sides.map(|side| side.dot(side)));
    let distant = size_squared < R::new(0.0625) * p_a.dot(p_a);
    let first = if distant { nothing } else { p_a };
    let others = if distant { sides } else { [full[1], full[2], full[3]].map(|v| v * scale) };
    let p = [first, others[0], others[1], others[2]];
    let a_height = surface.normal.dot(p_a);
    let base_height = if distant { a_height } else { zero };
    let [b_height, c_height, d_height] = others.map(|v| base_height + surface.normal.dot(v));
    let heights = [a_height, b_height, c_height, d_height];
    let up = heights.map(|height| height > zero);
    if up == [false; 4] {
        return quad;
    }
    let mut v = [p[0], p[1], p[2], p[3], p[3]];
    if up != [true; 4] {
        // Turned until the last vertex is the last one below.
        let turns = (0..3).find(|&i| up[i + 1] & !up[i]).map_or(0, |i| i + 1);
        let q: [R::Vec3; 4] = core::array::from_fn(|i| p[(i + turns) % 4]);
        let h: [R; 4] = core::array::from_fn(|i| heights[(i + turns) % 4]);
        let cross = |high: usize, low: usize| {
            q[high] + (q[low] - q[high]) * (h[high] / (h[high] - h[low]).max(R::new(LTC_TINY)))
        };
        let (up_b, up_c) = (h[1] > zero, h[2] > zero);
        let leave = match (up_b, up_c) {
            (_, true) => cross(2, 3),
            (true, false) => cross(1, 2),
            (false, false) => cross(0, 1),
        };
        let kept = |i: usize| if h[i] > zero { q[i] } else { leave };
        v = [q[0], kept(1), kept(2), leave, cross(0, 3)];
    }
    let base = if distant { p_a } else { nothing };
    let mut normals: [R::Vec3; 5] = core::array::from_fn(|i| {
        let (a, b) = (v[i], v[(i + 1) % 5]);
        ltc_edge_normal::<R>(base + a, base + b, b - a)
    });
    normals[3] = surface.normal * surface.normal.dot(normals[3]);
    quad.reaches = true;
    quad.distant = distant;
    quad.vertices = v;
    quad.normals = normals;
    quad.base = base;
    quad
}

/// Vector form factor, times 2π and signed, of what the surface's horizon leaves of a quad, in the caller's space.
pub fn ltc_quad_form_factor<R: Real>(quad: &LtcQuad<R>) -> R::Vec3 {
    let v = quad.vertices;
    if quad.distant {
        return ltc_far_pentagon::<R>(quad.base, v);
    }
    let inverses = v.map(inverse_length::<R>);
    let units: [R::Vec3; 5] = core::array::from_fn(|i| v[i] * inverses[i]);
    let edge = |i: usize| {
        let next = (i + 1) % 5;
        ltc_edge::<R>(units[i], units[next], quad.normals[i], inverses[i] * inverses[next])
    };
    -(edge(0) + edge(1) + edge(2) + edge(3) + edge(4))
}

/// The form factor of a quad, 0…1.
pub fn ltc_quad_diffuse<R: Real>(surface: &LtcSurface<R>, quad: &LtcQuad<R>) -> R {
    if !quad.reaches {
        return R::new(0.0);
    }
    let sum = surface.normal.dot(ltc_quad_form_factor(quad));
    ltc_received(sum * R::new(OVER_TWO_PI), quad.front, quad.two_sided)
}

/// The vector form factor of a quad, cut at the surface's horizon, in the caller's space, towards the light.
pub fn ltc_quad_toward<R: Real>(surface: &LtcSurface<R>, quad: &LtcQuad<R>) -> R::Vec3 {
    let form_factor = ltc_quad_form_factor(quad) * R::new(OVER_TWO_PI);
    if surface.normal.dot(form_factor) < R::new(0.0) { -form_factor } else { form_factor }
}

/// The vector form factor of a quad in a lobe's space, cut at both horizons, towards the light.
pub fn ltc_quad_lobe<R: Real>(quad: &LtcQuad<R>, lobe: &LtcLobe<R>) -> R::Vec3 {
    let zero: R = R::new(0.0);
    if !quad.reaches {
        return R::Vec3::new(zero, zero, zero);
    }
    let v = quad.vertices.map(|v| ltc_transform(lobe, v));
    let base = ltc_transform(lobe, quad.base);
    let lowest = base.z() + v.iter().fold(v[0].z(), |low, v| low.min(v.z()));
    let size = v.iter().fold(zero, |size, v| size.max(v.dot(*v)));
    let small = size < R::new(0.0625) * base.dot(base);
    let sum = if quad.distant & (lowest > zero) & small {
        ltc_far_pentagon::<R>(base, v)
    } else {
        let normals = quad.normals.map(|normal| ltc_transform_normal(lobe, normal));
        ltc_pentagon::<R>(v.map(|v| base + v), normals, ltc_above_tolerance(lobe))
    };
    ltc_received_vector::<R>(sum * R::new(OVER_TWO_PI), quad.front, quad.two_sided)
}

/// The value (diffuse, specular, fresnel) of a convex quad light; see the include for its domain
/// and its error.
pub fn ltc_quad<R: Real>(
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    vertices: [R::Vec3; 4],
    two_sided: bool,
) -> R::Vec3 {
    let quad = ltc_quad_begin(surface, vertices, two_sided);
    if !quad.reaches {
        let zero: R = R::new(0.0);
        return R::Vec3::new(zero, zero, zero);
    }
    let specular = ltc_lobes_value(surface, lobes, |lobe| ltc_quad_lobe(&quad, lobe));
    with_form_factor(ltc_quad_diffuse(surface, &quad), specular)
}

fn largest<R: Real>(values: [R; 3]) -> R {
    values[0].max(values[1]).max(values[2])
}
