//! Edges and convex quads.

use super::real::{Real, Vector};
use super::surface::{
    LTC_HEADROOM, LTC_TINY, LtcLobe, LtcSurface, constant, ltc_extent, ltc_to_frame,
    ltc_transform, ltc_value, unit,
};
use super::polygon::{ltc_polygon_add, ltc_polygon_begin, ltc_polygon_end};

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

/// The edge integral of a = reference + `a_offset` and b = reference + `b_offset`, less a part that
/// vanishes over every closed polygon; see the include.
pub fn ltc_edge_about<R: Real>(reference: R::Vec3, a_offset: R::Vec3, b_offset: R::Vec3) -> R::Vec3 {
    let (zero, one, two) = (R::new(0.0), R::new(1.0), R::new(2.0));
    let half: R = constant(0.5);
    let a = reference + a_offset;
    let chord = b_offset - a_offset;
    let normal = a.cross(chord);
    let k = half * chord.dot(chord);
    let excess = ltc_angle_excess(k.min((two - k).max(zero)));
    let obtuse = constant::<R>(core::f64::consts::PI)
        * normal.dot(normal).max(constant(1e-30)).inverse_sqrt()
        - (two + excess);
    let along = reference.dot(a_offset.cross(b_offset));
    let across =
        (a_offset * b_offset.dot(b_offset) - b_offset * a_offset.dot(a_offset)) * half;
    reference * along
        + reference.cross(across)
        + normal * if k > one { obtuse } else { excess }
}

/// Difference of the directions of `point` and `origin`, which differ by `offset`, with the
/// relative precision of `offset`. `reference` is the direction of `origin`.
pub fn ltc_offset<R: Real>(
    origin: R::Vec3,
    reference: R::Vec3,
    point: R::Vec3,
    offset: R::Vec3,
) -> R::Vec3 {
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
pub fn ltc_pentagon<R: Real>(
    a: R::Vec3,
    b: R::Vec3,
    c: R::Vec3,
    d: R::Vec3,
    e: R::Vec3,
) -> R::Vec3 {
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

/// Vector form factor, times 2π and signed, of a quad above the horizon from its first vertex and
/// the sides from there to the others.
pub fn ltc_far_quad<R: Real>(
    a: R::Vec3,
    side_b: R::Vec3,
    side_c: R::Vec3,
    side_d: R::Vec3,
) -> R::Vec3 {
    let zero: R = constant(0.0);
    let reference = unit::<R>(a);
    let b_offset = ltc_offset::<R>(a, reference, a + side_b, side_b);
    let c_offset = ltc_offset::<R>(a, reference, a + side_c, side_c);
    let d_offset = ltc_offset::<R>(a, reference, a + side_d, side_d);
    let a_offset = R::Vec3::new(zero, zero, zero);
    ltc_edge_about::<R>(reference, b_offset, a_offset)
        + ltc_edge_about::<R>(reference, c_offset, b_offset)
        + ltc_edge_about::<R>(reference, d_offset, c_offset)
        + ltc_edge_about::<R>(reference, a_offset, d_offset)
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
    let to_a = full[0] * scale;
    let sides = [far[1], far[2], far[3]].map(|v| (v - far[0]) * scale);
    let area = sides[1].cross(sides[2] - sides[0]);
    let front = area.dot(to_a) < zero;

    let p_a = ltc_to_frame(surface, to_a);
    let squares = sides.map(|side| side.dot(side));
    let size_squared = squares[0].max(squares[1]).max(squares[2]);
    if size_squared < constant::<R>(0.0625) * to_a.dot(to_a) {
        let e = sides.map(|side| ltc_to_frame(surface, side));
        let lowest = p_a.z() + zero.min(e[0].z()).min(e[1].z().min(e[2].z()));
        let highest = p_a.z() + zero.max(e[0].z()).max(e[1].z().max(e[2].z()));
        if highest <= zero {
            return nothing;
        }
        if lowest > zero {
            let near = ltc_far_quad::<R>(p_a, e[0], e[1], e[2]);
            let l_a = ltc_transform(lobe, p_a);
            let l = e.map(|side| ltc_transform(lobe, side));
            let squares = l.map(|side| side.dot(side));
            let lobe_size = squares[0].max(squares[1]).max(squares[2]);
            let lobe_lowest = l_a.z() + zero.min(l[0].z()).min(l[1].z().min(l[2].z()));
            let vector = if (lobe_size < constant::<R>(0.0625) * l_a.dot(l_a))
                & (lobe_lowest > zero)
            {
                ltc_far_quad::<R>(l_a, l[0], l[1], l[2])
            } else {
                ltc_pentagon::<R>(l_a, l_a + l[0], l_a + l[1], l_a + l[2], l_a + l[2])
            };
            return ltc_value(
                lobe,
                near.z() * over_two_pi,
                vector * over_two_pi,
                front,
                two_sided,
            );
        }
        let mut polygon = ltc_polygon_begin(surface, vertices[0]);
        for vertex in &vertices[1..] {
            ltc_polygon_add(&mut polygon, surface, lobe, *vertex);
        }
        return ltc_polygon_end(&mut polygon, surface, lobe, two_sided);
    }

    let p = [
        p_a,
        ltc_to_frame(surface, full[1] * scale),
        ltc_to_frame(surface, full[2] * scale),
        ltc_to_frame(surface, full[3] * scale),
    ];
    let up = p.map(|v| v.z() > zero);
    if up == [false; 4] {
        return nothing;
    }
    // Turned until the last vertex is the last one below.
    let turns = (0..3).find(|&i| up[i + 1] & !up[i]).map_or(0, |i| i + 1);
    let q: [R::Vec3; 4] = core::array::from_fn(|i| p[(i + turns) % 4]);
    let mut v = [q[0], q[1], q[2], q[3], q[3]];
    if !(q[3].z() > zero) {
        let (up_b, up_c) = (q[1].z() > zero, q[2].z() > zero);
        let (from, to) = match (up_b, up_c) {
            (_, true) => (q[2], q[3]),
            (true, false) => (q[1], q[2]),
            (false, false) => (q[0], q[1]),
        };
        let leave = ltc_crossing::<R>(from, to);
        v = [
            q[0],
            if up_b { q[1] } else { leave },
            if up_c { q[2] } else { leave },
            leave,
            ltc_crossing::<R>(q[0], q[3]),
        ];
    }
    let u = v.map(unit::<R>);
    let sum = ltc_edge::<R>(u[1], u[0]).z()
        + ltc_edge::<R>(u[2], u[1]).z()
        + ltc_edge::<R>(u[3], u[2]).z()
        + ltc_edge::<R>(u[4], u[3]).z()
        + ltc_edge::<R>(u[0], u[4]).z();
    let [a, b, c, d, e] = v.map(|v| ltc_transform(lobe, v));
    let vector = ltc_pentagon::<R>(a, b, c, d, e);
    ltc_value(lobe, sum * over_two_pi, vector * over_two_pi, front, two_sided)
}
