//! Edges and convex quads.

use super::real::{Real, Vector};
use super::several::{LobeSum, ltc_lobes_value, with_form_factor};
use super::surface::{
    LTC_HEADROOM, LTC_TINY, LtcLobe, LtcSurface, ltc_extent, ltc_in_frame, ltc_received, ltc_received_vector,
    ltc_transform_framed, ltc_transform_framed_normal, unit,
};

pub(super) const OVER_TWO_PI: f64 = 0.5 / core::f64::consts::PI;

/// (θ / sin θ) − 1 from k = 1 − cos θ in 0…1.
pub fn ltc_angle_excess<R: Real>(k: R) -> R {
    R::angle_excess(k)
}

/// The shorter of two vectors.
pub fn ltc_shorter<R: Real>(a: R::Vec3, b: R::Vec3) -> R::Vec3 {
    if b.dot(b) < a.dot(a) { b } else { a }
}

/// The cross product a × b of two vectors whose difference b − a is `side`, from the shorter of the two.
pub fn ltc_edge_normal<R: Real>(a: R::Vec3, b: R::Vec3, side: R::Vec3) -> R::Vec3 {
    ltc_shorter::<R>(a, b).cross(side)
}

/// The edge integral of the segment between the directions `a` and `b`: the angle between these unit vectors along
/// the unit normal of their plane, for which `normal` has the right direction.
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
    let inverse_length = square.max(R::new(1e-22)).inverse_sqrt();
    let length_sum = square * inverse_length + origin.dot(reference);
    let length_difference = offset.dot(origin + target_point) / length_sum.max(R::new(LTC_TINY));
    if offset.dot(offset) < R::new(0.0625) * origin.dot(origin) {
        (offset - reference * length_difference) * inverse_length
    } else {
        target_point * inverse_length - reference
    }
}

/// Where the segment from `above` the plane z = 0 to `below` it meets that plane; only the direction of that where
/// it passes the surface point closely. `normal` has the direction of above × below; `exact` tells that it does not come
/// from these points and their rounding.
pub fn ltc_crossing<R: Real>(above: R::Vec3, below: R::Vec3, normal: R::Vec3, exact: bool) -> R::Vec3 {
    let (zero, tiny): (R, R) = (R::new(0.0), R::new(LTC_TINY));
    let (high, low) = (above.z().max(zero), below.z().min(zero));
    let t = high / (high - low).max(tiny);
    let between =
        R::Vec3::new(above.x() + (below.x() - above.x()) * t, above.y() + (below.y() - above.y()) * t, zero);
    let (above_square, below_square) = (above.dot(above), below.dot(below));
    let cancels = between.dot(between) < R::new(1e-6) * above_square.max(below_square);
    // As in the include: `turned` where its rounding does less harm than that of `between`.
    let turned = R::Vec3::new(normal.y(), -normal.x(), zero);
    let (turned_square, normal_square) = (turned.dot(turned), normal.dot(normal));
    let inverse = |square: R| square.max(tiny).inverse_sqrt();
    let rounding = if exact { inverse(normal_square) } else { inverse(above_square) * inverse(below_square) };
    let tilted = turned_square * rounding > R::new(2e-7) * normal_square * inverse(normal_square);
    if cancels & tilted { unit::<R>(turned) } else { between }
}

/// (θ / sin θ) · `scale` for the angle θ whose cosine is given, if that is acute; otherwise that of π − θ, see
/// [`ltc_edge_turn`].
pub fn ltc_edge_weight<R: Real>(cosine: R, scale: R) -> R {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    scale + scale * ltc_angle_excess((one - cosine.abs()).clamp(zero, one))
}

/// What the `weight` from [`ltc_edge_weight`] lacks if the angle is obtuse; see the include.
pub fn ltc_edge_turn<R: Real>(cosine: R, weight: R, normal: R::Vec3) -> R {
    if cosine < R::new(0.0) {
        R::new(core::f64::consts::PI) * inverse_tiny::<R>(normal) - R::new(2.0) * weight
    } else {
        R::new(0.0)
    }
}

/// 1 over the length of `v`.
pub fn ltc_inverse_length<R: Real>(v: R::Vec3) -> R {
    v.dot(v).max(R::new(1e-30)).inverse_sqrt()
}

/// 1 over the length of a normal, however small.
fn inverse_tiny<R: Real>(normal: R::Vec3) -> R {
    normal.dot(normal).max(R::new(LTC_TINY)).inverse_sqrt()
}

/// Vector form factor, times 2π and signed, of a pentagon; a quad's last two vertices coincide. Each normal is the
/// cross product of its vertex and the next one.
pub fn ltc_edges<R: Real>(vertices: [R::Vec3; 5], normals: [R::Vec3; 5]) -> R::Vec3 {
    let inverses = vertices.map(ltc_inverse_length::<R>);
    let edge = |i: usize| {
        let next = (i + 1) % 5;
        let scale = inverses[i] * inverses[next];
        let cosine = vertices[i].dot(vertices[next]) * scale;
        let weight = ltc_edge_weight(cosine, scale);
        normals[i] * (weight + ltc_edge_turn(cosine, weight, normals[i]))
    };
    -(edge(0) + edge(1) + edge(2) + edge(3) + edge(4))
}

/// Where the edge from `above` the plane z = 0 to `below` it meets that plane: `turned`, which is what the plane of the
/// edge says, or for an edge that is nearly parallel to the horizon what its ends say, if that has more digits.
/// `tilt` is the squared sine between that plane and the horizon.
pub fn ltc_flat_crossing<R: Real>(
    above: R::Vec3,
    below: R::Vec3,
    tilt: R,
    rise: R,
    turned: R::Vec3,
) -> R::Vec3 {
    let zero = R::new(0.0);
    let t = above.z().max(zero) / (above.z() - below.z()).max(R::new(LTC_TINY));
    let (x, y) = (above.x() + (below.x() - above.x()) * t, above.y() + (below.y() - above.y()) * t);
    let between = R::Vec3::new(x, y, zero);
    let farthest = above.dot(above).max(below.dot(below));
    let after = (above.x() * turned.y() - above.y() * turned.x()) * rise >= zero;
    let before = (turned.x() * below.y() - turned.y() * below.x()) * rise >= zero;
    let resolved = tilt * farthest > between.dot(between);
    if (tilt > R::new(1e-3)) | (resolved & after & before) { turned } else { unit::<R>(between) }
}

/// Where the edge with this normal, from `above` to `below`, leaves the upper side.
fn leaving<R: Real>(normal: R::Vec3, above: R::Vec3, below: R::Vec3) -> R::Vec3 {
    let turned = R::Vec3::new(normal.y(), -normal.x(), R::new(0.0));
    let tilt = turned.dot(turned) / normal.dot(normal).max(R::new(LTC_TINY));
    ltc_flat_crossing::<R>(above, below, tilt, normal.z(), unit::<R>(turned))
}

/// The sine of the elevation down to which a vertex counts as above the lobe's horizon.
pub fn ltc_horizon<R: Real>(lobe: &LtcLobe<R>) -> R {
    R::new(-1e-6) * ltc_extent::<R>(lobe.frame_z).min(R::new(1.0))
}

/// Vector form factor, times 2π and signed, of a convex pentagon in the lobe's space, cut at the lobe's
/// horizon. Each normal is the cross product of its vertex and the next one. A vertex counts as above the
/// horizon if the sine of its elevation is larger than `lowest`, which is [`ltc_horizon`].
pub fn ltc_pentagon<R: Real>(vertices: [R::Vec3; 5], normals: [R::Vec3; 5], lowest: R) -> R::Vec3 {
    let (zero, one, pi): (R, R, R) = (R::new(0.0), R::new(1.0), R::new(core::f64::consts::PI));
    let up = vertices.map(|v| v.z() * ltc_inverse_length::<R>(v) > lowest);
    if up == [false; 5] {
        return R::Vec3::new(zero, zero, zero);
    }
    if up == [true; 5] {
        return ltc_edges::<R>(vertices, normals);
    }
    let next = |i: usize| (i + 1) % 5;
    // The last edge that leaves the upper side and the last one that comes back, as in the include; a convex
    // polygon has one of each.
    let (mut last_leaving, mut last_entering) = (0, 4);
    for i in 1..5 {
        if up[i] & !up[next(i)] {
            last_leaving = i;
        }
        if up[i] & !up[i - 1] {
            last_entering = i - 1;
        }
    }
    let leave = leaving::<R>(normals[last_leaving], vertices[last_leaving], vertices[next(last_leaving)]);
    let enter = leaving::<R>(-normals[last_entering], vertices[next(last_entering)], vertices[last_entering]);
    let units = vertices.map(unit::<R>);
    let edge = |i: usize| {
        let next = next(i);
        if !(up[i] | up[next]) {
            return R::Vec3::new(zero, zero, zero);
        }
        let start = if up[i] { units[i] } else { enter };
        let end = if up[next] { units[next] } else { leave };
        let cosine = start.dot(end);
        let (product, weight) = (start.cross(end - start), ltc_edge_weight(cosine, one));
        if cosine < zero {
            normals[i] * (pi * inverse_tiny::<R>(normals[i])) - product * weight
        } else {
            product * weight
        }
    };
    let along = leave.dot(enter);
    let area = leave.x() * enter.y() - leave.y() * enter.x();
    let acute = area * ltc_edge_weight(along, one);
    let angle = match (along < zero, area < zero) {
        (false, _) => acute,
        (true, true) => -pi - acute,
        (true, false) => pi - acute,
    };
    let horizon = R::Vec3::new(zero, zero, angle);
    -(edge(0) + edge(1) + edge(2) + edge(3) + edge(4) + horizon)
}

/// Vector form factor, times 2π and signed, of a pentagon above the horizon from its first vertex `origin` and the
/// offsets of the others from there, all much shorter than the distance.
pub fn ltc_far_pentagon<R: Real>(origin: R::Vec3, others: [R::Vec3; 4]) -> R::Vec3 {
    let half: R = R::new(0.5);
    let squared = origin.dot(origin);
    let inverse_length = squared.max(R::new(LTC_TINY)).inverse_sqrt();
    let reference = origin * inverse_length;
    let distance = squared * inverse_length;
    let offsets = others.map(|v| ltc_far_offset::<R>(origin, reference, distance, v));
    let squares = offsets.map(|offset| offset.dot(offset));
    let areas: [R::Vec3; 3] = core::array::from_fn(|i| offsets[i].cross(offsets[i + 1]));
    let chords: [R::Vec3; 3] = core::array::from_fn(|i| offsets[i + 1] - offsets[i]);
    let excesses = chords.map(|chord| ltc_angle_excess(half * chord.dot(chord)));
    let (first, last) = (ltc_angle_excess(half * squares[0]), ltc_angle_excess(half * squares[3]));
    let across = offsets[0] * (half * squares[1] + first)
        + offsets[1] * (half * (squares[2] - squares[0]))
        + offsets[2] * (half * (squares[3] - squares[1]))
        - offsets[3] * (half * squares[2] + last)
        + chords[0] * excesses[0]
        + chords[1] * excesses[1]
        + chords[2] * excesses[2];
    let along = reference.dot(areas[0] + areas[1] + areas[2]);
    let rest = areas[0] * excesses[0] + areas[1] * excesses[1] + areas[2] * excesses[2];
    -(reference * along + reference.cross(across) + rest)
}

/// Difference of the directions of `origin + offset` and `origin`, for an offset much shorter than `origin`, with the
/// relative precision of `offset`. `reference` is the direction of `origin`.
pub fn ltc_far_offset<R: Real>(origin: R::Vec3, reference: R::Vec3, distance: R, offset: R::Vec3) -> R::Vec3 {
    let rise = offset.dot(origin + origin + offset);
    let squared = (distance * distance + rise).max(R::new(LTC_TINY));
    let inverse_length = squared.inverse_sqrt();
    let length_difference = rise / (squared * inverse_length + distance);
    (offset - reference * length_difference) * inverse_length
}

/// A convex quad light, cut at the surface's horizon: what all lobes share of the work on it, in the surface's frame.
#[derive(Clone, Copy, Debug)]
pub struct LtcQuad<R: Real> {
    /// The vertices of the pentagon that is left of the quad, from the surface point; but for the first those of a
    /// distant light from the first one.
    vertices: [R::Vec3; 5],
    /// Cross products of each vertex and the next one, both from the surface point.
    normals: [R::Vec3; 5],
    reaches: bool,
    distant: bool,
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
    let mut quad =
        LtcQuad { vertices: [nothing; 5], normals: [nothing; 5], reaches: false, distant: false, two_sided };
    if !(front | two_sided) {
        return quad;
    }
    let size_squared = largest(sides.map(|side| side.dot(side)));
    let distant = size_squared < R::new(0.0625) * p_a.dot(p_a);
    let others = if distant { sides } else { [full[1], full[2], full[3]].map(|v| v * scale) };
    let a_height = surface.normal.dot(p_a);
    let base_height = if distant { a_height } else { zero };
    let first = if distant { nothing } else { p_a };
    let p = [first, others[0], others[1], others[2]];
    let rises = p.map(|v| surface.normal.dot(v));
    let up = rises.map(|rise| base_height + rise > zero);
    if up == [false; 4] {
        return quad;
    }
    let mut v = [p_a, p[1], p[2], p[3], p[3]];
    let mut rise = [a_height, rises[1], rises[2], rises[3], rises[3]];
    if up != [true; 4] {
        // Turned until the last vertex is the last one below.
        let turns = (0..3).find(|&i| up[i + 1] & !up[i]).map_or(0, |i| i + 1);
        let q: [(R::Vec3, R); 4] = core::array::from_fn(|i| (p[(i + turns) % 4], rises[(i + turns) % 4]));
        let cross = |from: usize, to: usize| {
            let (side, fall) = (q[to].0 - q[from].0, q[from].1 - q[to].1);
            let t = ((base_height + q[from].1) / fall.max(R::new(LTC_TINY))).max(zero).min(R::new(1.0));
            (q[from].0 + side * t, q[from].1 - fall * t)
        };
        let up = q.map(|q| base_height + q.1 > zero);
        let leave = match (up[1], up[2]) {
            (_, true) => cross(2, 3),
            (true, false) => cross(1, 2),
            (false, false) => cross(0, 1),
        };
        let kept = |i: usize| if up[i] { q[i] } else { leave };
        let cut = [q[0], kept(1), kept(2), leave, cross(0, 3)];
        let moved = if distant { q[0] } else { (nothing, zero) };
        v = cut.map(|v| v.0 - moved.0);
        rise = cut.map(|v| v.1 - moved.1);
        if distant {
            (v[0], rise[0]) = (p_a + q[0].0, a_height + q[0].1);
        }
    }
    quad.vertices = core::array::from_fn(|i| {
        R::Vec3::new(surface.tangent.dot(v[i]), surface.bitangent.dot(v[i]), rise[i])
    });
    quad.normals = if distant {
        let [a, b, c, d, e] = quad.vertices;
        [a.cross(b), (a + c).cross(c - b), (a + d).cross(d - c), (a + e).cross(e - d), e.cross(a)]
    } else {
        // In the caller's space: where an edge along one of its axes all but touches the surface point, a turn of its
        // ends would lose the distance.
        let [a, b, c, d, e] = v;
        let rim = ltc_edge_normal::<R>(d, e, e - d);
        let normal = |a, b: R::Vec3| ltc_edge_normal::<R>(a, b, b - a);
        [normal(a, b), normal(b, c), normal(c, d), rim, normal(e, a)]
            .map(|normal| ltc_in_frame(surface, normal))
    };
    // The edge from exit to entry lies on the horizon, whatever rounding says of its normal.
    quad.normals[3] = R::Vec3::new(zero, zero, quad.normals[3].z());
    quad.reaches = true;
    quad.distant = distant;
    quad
}

/// Vector form factor, times 2π and signed, of what the surface's horizon leaves of a quad, in the surface's frame.
pub fn ltc_quad_form_factor<R: Real>(quad: &LtcQuad<R>) -> R::Vec3 {
    let [a, b, c, d, e] = quad.vertices;
    if quad.distant {
        ltc_far_pentagon::<R>(a, [b, c, d, e])
    } else {
        ltc_edges::<R>(quad.vertices, quad.normals)
    }
}

/// The form factor of a quad, 0…1.
pub fn ltc_quad_diffuse<R: Real>(_surface: &LtcSurface<R>, quad: &LtcQuad<R>) -> R {
    if !quad.reaches {
        return R::new(0.0);
    }
    ltc_received(ltc_quad_form_factor(quad).z() * R::new(OVER_TWO_PI), true, quad.two_sided)
}

/// The vector form factor of a quad, cut at the surface's horizon, in the caller's space, towards the light.
pub fn ltc_quad_toward<R: Real>(surface: &LtcSurface<R>, quad: &LtcQuad<R>) -> R::Vec3 {
    let form_factor = ltc_quad_form_factor(quad) * R::new(OVER_TWO_PI);
    let toward = if form_factor.z() < R::new(0.0) { -form_factor } else { form_factor };
    surface.tangent * toward.x() + surface.bitangent * toward.y() + surface.normal * toward.z()
}

/// The vector form factor of a quad in a lobe's space, cut at both horizons, towards the light.
pub fn ltc_quad_lobe<R: Real>(quad: &LtcQuad<R>, lobe: &LtcLobe<R>) -> R::Vec3 {
    let zero: R = R::new(0.0);
    if !quad.reaches {
        return R::Vec3::new(zero, zero, zero);
    }
    let [a, b, c, d, e] = quad.vertices.map(|v| ltc_transform_framed(lobe, v));
    let others = [b, c, d, e];
    let lowest = a.z() + others.iter().fold(zero, |low, v| low.min(v.z()));
    let size = others.iter().fold(zero, |size, v| size.max(v.dot(*v)));
    let small = size < R::new(0.0625) * a.dot(a);
    let highest = a.z() + others.iter().fold(zero, |high, v| high.max(v.z()));
    if quad.distant & small & (highest <= zero) {
        return R::Vec3::new(zero, zero, zero);
    }
    let whole = (lowest > zero) | (size < R::new(4e-5) * a.dot(a));
    let sum = if quad.distant & small & whole {
        ltc_far_pentagon::<R>(a, others)
    } else {
        let normals = quad.normals.map(|normal| ltc_transform_framed_normal(lobe, normal));
        let [b, c, d, e] = if quad.distant { others.map(|v| v + a) } else { others };
        ltc_pentagon::<R>([a, b, c, d, e], normals, ltc_horizon(lobe))
    };
    ltc_received_vector::<R>(sum * R::new(OVER_TWO_PI), true, quad.two_sided)
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
