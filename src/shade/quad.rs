//! Edges and convex quads.

use super::real::{Real, Vector};
use super::surface::{
    LTC_HEADROOM, LTC_TINY, LtcLobe, LtcSurface, constant, ltc_extent, ltc_transform, ltc_value, unit,
};

pub(super) const OVER_TWO_PI: f64 = 0.5 / core::f64::consts::PI;

/// (θ / sin θ) − 1 from k = 1 − cos θ in 0…1.
pub fn ltc_angle_excess<R: Real>(k: R) -> R {
    R::angle_excess(k)
}

/// The edge integral (θ / sin θ)(a × b) of two unit vectors with the angle θ between them.
pub fn ltc_edge<R: Real>(a: R::Vec3, b: R::Vec3) -> R::Vec3 {
    let (zero, one, two) = (R::new(0.0), R::new(1.0), R::new(2.0));
    let chord = b - a;
    let normal = a.cross(chord);
    let k = constant::<R>(0.5) * chord.dot(chord);
    let excess = ltc_angle_excess(k.min((two - k).max(zero)));
    let obtuse = constant::<R>(core::f64::consts::PI)
        * normal.dot(normal).max(constant(1e-30)).inverse_sqrt()
        - (one + excess);
    normal * if k > one { obtuse } else { one + excess }
}

/// The edge integral's signed length for an edge on the surface's horizon: the angle from `a` to `b`
/// around `normal`.
pub fn ltc_horizon_edge<R: Real>(a: R::Vec3, b: R::Vec3, normal: R::Vec3) -> R {
    let integral = ltc_edge::<R>(a, b);
    let squared = integral.dot(integral);
    let angle = squared * squared.max(constant(1e-30)).inverse_sqrt();
    if integral.dot(normal) > constant(0.0) { angle } else { -angle }
}

/// The edge integral of unit vectors `a` and `b`, less a part that vanishes over every closed
/// polygon; see the include. The offsets are a − reference and b − reference.
pub fn ltc_edge_about<R: Real>(
    reference: R::Vec3,
    a: R::Vec3,
    a_offset: R::Vec3,
    b: R::Vec3,
    b_offset: R::Vec3,
) -> R::Vec3 {
    let (zero, one, two) = (R::new(0.0), R::new(1.0), R::new(2.0));
    let half: R = constant(0.5);
    let (a_squared, b_squared) = (a_offset.dot(a_offset), b_offset.dot(b_offset));
    let chord = if a_squared.max(b_squared) < constant(0.0625) { b_offset - a_offset } else { b - a };
    let normal = a.cross(chord);
    let k = half * chord.dot(chord);
    let excess = ltc_angle_excess(k.min((two - k).max(zero)));
    let obtuse = constant::<R>(core::f64::consts::PI)
        * normal.dot(normal).max(constant(1e-30)).inverse_sqrt()
        - (two + excess);
    let along = reference.dot(a_offset.cross(b_offset));
    let across = (a_offset * b_squared - b_offset * a_squared) * half;
    reference * along + reference.cross(across) + normal * if k > one { obtuse } else { excess }
}

/// Difference of the directions of `point` and `origin`, which differ by `offset`, with the
/// relative precision of `offset`. `reference` is the direction of `origin`.
pub fn ltc_offset<R: Real>(origin: R::Vec3, reference: R::Vec3, point: R::Vec3, offset: R::Vec3) -> R::Vec3 {
    let square = point.dot(point);
    let inverse_length = square.max(constant(LTC_TINY)).inverse_sqrt();
    let length_sum = square * inverse_length + origin.dot(reference);
    let length_difference = offset.dot(origin + point) / length_sum.max(constant(LTC_TINY));
    if offset.dot(offset) < constant::<R>(0.0625) * origin.dot(origin) {
        (offset - reference * length_difference) * inverse_length
    } else {
        point * inverse_length - reference
    }
}

/// Where the segment from `a`, above the plane z = 0, to `b`, not above it, meets that plane.
pub fn ltc_crossing<R: Real>(a: R::Vec3, b: R::Vec3) -> R::Vec3 {
    let t = a.z() / (a.z() - b.z()).max(constant(LTC_TINY));
    R::Vec3::new(a.x() + (b.x() - a.x()) * t, a.y() + (b.y() - a.y()) * t, constant(0.0))
}

/// Vector form factor, times 2π and signed, of a convex pentagon cut at z = 0.
pub fn ltc_pentagon<R: Real>(a: R::Vec3, b: R::Vec3, c: R::Vec3, d: R::Vec3, e: R::Vec3) -> R::Vec3 {
    let zero: R = constant(0.0);
    let vertices = [a, b, c, d, e];
    let up = vertices.map(|v| v.z() > zero);
    let units = vertices.map(unit::<R>);
    let sum = |starts: [R::Vec3; 5], ends: [R::Vec3; 5]| {
        ltc_edge::<R>(ends[1], starts[0])
            + ltc_edge::<R>(ends[2], starts[1])
            + ltc_edge::<R>(ends[3], starts[2])
            + ltc_edge::<R>(ends[4], starts[3])
            + ltc_edge::<R>(ends[0], starts[4])
    };
    if up == [true; 5] {
        return sum(units, units);
    }
    if up == [false; 5] {
        return R::Vec3::new(zero, zero, zero);
    }
    // The last edge that leaves the upper side and the last one that comes back, as in the include;
    // a convex polygon has one of each.
    let edge_after = |i: usize| (i + 1) % 5;
    let (mut leaving, mut entering) = (0, 4);
    for i in 1..5 {
        if up[i] & !up[edge_after(i)] {
            leaving = i;
        }
        if up[i] & !up[i - 1] {
            entering = i - 1;
        }
    }
    let x = unit::<R>(ltc_crossing::<R>(vertices[leaving], vertices[edge_after(leaving)]));
    let y = unit::<R>(ltc_crossing::<R>(vertices[edge_after(entering)], vertices[entering]));
    let ends = core::array::from_fn(|i| match (up[i], up[(i + 4) % 5]) {
        (true, _) => units[i],
        (false, true) => x,
        (false, false) => y,
    });
    let starts = core::array::from_fn(|i| if up[i] { units[i] } else { y });
    sum(starts, ends) + ltc_edge::<R>(y, x)
}

/// Vector form factor, times 2π and signed, of a pentagon above the horizon from one point `origin` on
/// or near it and the offsets of its vertices from there.
pub fn ltc_far_pentagon<R: Real>(origin: R::Vec3, vertices: [R::Vec3; 5]) -> R::Vec3 {
    let reference = unit::<R>(origin);
    let offsets = vertices.map(|v| ltc_offset::<R>(origin, reference, origin + v, v));
    let units = offsets.map(|offset| reference + offset);
    let edge = |from: usize, to: usize| {
        ltc_edge_about::<R>(reference, units[from], offsets[from], units[to], offsets[to])
    };
    edge(1, 0) + edge(2, 1) + edge(3, 2) + edge(4, 3) + edge(0, 4)
}

/// The value (diffuse, specular, fresnel) of a convex quad light; see the include for its domain
/// and its error.
pub fn ltc_quad<R: Real>(
    surface: &LtcSurface<R>,
    lobe: &LtcLobe<R>,
    vertices: [R::Vec3; 4],
    two_sided: bool,
) -> R::Vec3 {
    let zero: R = constant(0.0);
    let nothing = R::Vec3::new(zero, zero, zero);
    let headroom: R = constant(LTC_HEADROOM);
    let over_two_pi: R = constant(OVER_TWO_PI);
    let origin = surface.position * headroom;
    let far = vertices.map(|v| v * headroom);
    let full = far.map(|v| v - origin);
    let extents = full.map(ltc_extent::<R>);
    let extent = extents[0].max(extents[1]).max(extents[2].max(extents[3]));
    let scale = constant::<R>(1.0) / extent.max(constant(LTC_TINY));
    let sides = [far[1], far[2], far[3]].map(|v| (v - far[0]) * scale);
    let p_a = full[0] * scale;
    let front = sides[1].cross(sides[2] - sides[0]).dot(p_a) < zero;

    let size_squared = largest(sides.map(|side| side.dot(side)));
    let distant = size_squared < constant::<R>(0.0625) * p_a.dot(p_a);
    let first = if distant { nothing } else { p_a };
    let others = if distant { sides } else { [full[1], full[2], full[3]].map(|v| v * scale) };
    let p = [first, others[0], others[1], others[2]];
    let a_height = surface.normal.dot(p_a);
    let base_height = if distant { a_height } else { zero };
    let [b_height, c_height, d_height] = others.map(|v| base_height + surface.normal.dot(v));
    let heights = [a_height, b_height, c_height, d_height];
    let up = heights.map(|height| height > zero);
    if up == [false; 4] {
        return nothing;
    }
    let mut v = [p[0], p[1], p[2], p[3], p[3]];
    if up != [true; 4] {
        // Turned until the last vertex is the last one below.
        let turns = (0..3).find(|&i| up[i + 1] & !up[i]).map_or(0, |i| i + 1);
        let q: [R::Vec3; 4] = core::array::from_fn(|i| p[(i + turns) % 4]);
        let h: [R; 4] = core::array::from_fn(|i| heights[(i + turns) % 4]);
        let cross = |high: usize, low: usize| {
            q[high] + (q[low] - q[high]) * (h[high] / (h[high] - h[low]).max(constant(LTC_TINY)))
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
    let l = v.map(|v| ltc_transform(lobe, v));
    let (sum, lobe_sum) = if distant {
        let sum = surface.normal.dot(ltc_far_pentagon::<R>(p_a, v));
        let l_first = ltc_transform(lobe, p_a);
        let lobe_size = l.iter().fold(zero, |size, v| size.max(v.dot(*v)));
        let lowest = l_first.z() + l.iter().fold(l[0].z(), |low, v| low.min(v.z()));
        let near = lobe_size < constant::<R>(0.0625) * l_first.dot(l_first);
        let lobe_sum = if near & (lowest > zero) {
            ltc_far_pentagon::<R>(l_first, l)
        } else {
            let [a, b, c, d, e] = l.map(|v| l_first + v);
            ltc_pentagon::<R>(a, b, c, d, e)
        };
        (sum, lobe_sum)
    } else {
        let u = v.map(unit::<R>);
        let edges = ltc_edge::<R>(u[1], u[0])
            + ltc_edge::<R>(u[2], u[1])
            + ltc_edge::<R>(u[3], u[2])
            + ltc_edge::<R>(u[0], u[4]);
        let sum = surface.normal.dot(edges) + ltc_horizon_edge::<R>(u[4], u[3], surface.normal);
        let [a, b, c, d, e] = l;
        (sum, ltc_pentagon::<R>(a, b, c, d, e))
    };
    ltc_value(surface, lobe, sum * over_two_pi, lobe_sum * over_two_pi, front, two_sided)
}

fn largest<R: Real>(values: [R; 3]) -> R {
    values[0].max(values[1]).max(values[2])
}
