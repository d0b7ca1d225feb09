// Softbox: light from polygons by linearly transformed cosines.
//
// The idea (Heitz, Dupuy, Hill and Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly
// Transformed Cosines"): the integral of a clamped cosine over a polygon has a closed form
// (Lambert 1760). A matrix M that maps the clamped cosine onto the shape of a BRDF's lobe turns the
// integral of that lobe over a polygon into the integral of the cosine over the polygon times the
// inverse of M. A table holds that inverse for each roughness and view.
//
// CONVENTIONS
//   Space       any right-handed space; all positions and directions in the same one.
//   Directions  point away from the surface. The view direction points to the eye.
//   Lengths     normal and view need not be unit; positions are in any unit.
//   Roughness   perceptual, 0 to 1: alpha = roughness * roughness. Below LTC_ROUGHNESS_FLOOR the
//               lobe stays that of the floor.
//   Winding     a polygon emits from the side from which its vertices run counter-clockwise.
//   Values      integrals over the solid angle of the light for unit radiance. Diffuse: of
//               cos / pi, the form factor, 0 to 1. Specular: of f cos for F = 1. Fresnel: of
//               f cos (1 - v.h)^5, Schlick's part. No factor of pi is left to the caller: multiply
//               by the light's radiance, and the diffuse value by the surface's base colour.
//   Table       two layers of RGBA16F over (roughness, square root of cos view); see ltc_lobe.
//
// THREE LEVELS OF USE
//   1. ltc_table_coordinates: where to sample; sample in any way you like.
//   2. ltc_lobe from the two texels, then ltc_quad or the ltc_polygon functions.
//   3. ltc_lobe_from_table: with the texture array and a sampler.
//
// ARITHMETIC
//   All geometry is f32. No input with finite coordinates makes an infinity or a NaN; nothing here
//   tests for one. Positions are scaled by 1/16 so that the difference of two finite positions is
//   finite, and by the light's own size so that no product leaves the range of f32.
//
// Metal      Include this text in a .metal file. No Metal compiler has seen it: it is
//            tested as C++ with a stand-in for the Metal library.
//
// Translated from wgsl/ltc.wgsl; edit that file, not this one.
// SPDX-License-Identifier: MIT OR Apache-2.0

#ifndef LTC_METAL_INCLUDED
#define LTC_METAL_INCLUDED

#include <metal_stdlib>
#include <simd/simd.h>


// A surface point with its shading frame: the view direction lies in the half-plane of tangent
// and normal, tangent x bitangent = normal.
struct LtcSurface {
    // The point, in the caller's space.
    metal::packed_float3 position;
    // Perceptual roughness, at least LTC_ROUGHNESS_FLOOR.
    float roughness;
    // First axis of the frame.
    metal::packed_float3 tangent;
    // Cosine between normal and view, 0 to 1.
    float cos_view;
    // Second axis of the frame.
    metal::packed_float3 bitangent;
    // Sine between normal and view, 0 to 1.
    float sin_view;
    // Third axis of the frame.
    metal::packed_float3 normal;
    // Square of the roughness.
    float alpha;
};

// One lobe: a linearly transformed cosine and the weights of the BRDF's two parts.
struct LtcLobe {
    // Entries (x, y, z, w) of the inverse matrix in the surface's frame:
    // rows (x, 0, z), (0, 1, 0), (y, 0, w).
    metal::float4 inverse;
    // First row of the matrix that leads from the caller's space to the lobe's.
    metal::packed_float3 axis_x;
    // The BRDF's integral of f cos over the hemisphere, for F = 1.
    float albedo;
    // Second row of that matrix.
    metal::packed_float3 axis_y;
    // The BRDF's integral of f cos (1 - v.h)^5 over the hemisphere.
    float fresnel;
    // Third row of that matrix.
    metal::packed_float3 axis_z;
    // Share of the lobe's energy above the surface.
    float share;
};

// State of a polygon that is given vertex by vertex; read and written by the library alone.
struct LtcPolygon {
    // First vertex, in the caller's space.
    metal::packed_float3 first;
    // Factor that brings the first vertex to a distance of about 1.
    float scale;
    // Last vertex so far, in the caller's space.
    metal::packed_float3 previous;
    // Twice the signed area so far times the height of the surface point over the light's plane.
    float facing;
    // First point on the surface's horizon, in the frame.
    metal::packed_float3 surface_crossing;
    // 1 once there is such a point.
    float surface_crossed;
    // Its offset from the first vertex.
    metal::packed_float3 surface_crossing_offset;
    // Form factor so far, times 2 pi and signed.
    float diffuse;
    // First point on the lobe's horizon, in the lobe's space.
    metal::packed_float3 lobe_crossing;
    // 1 once there is such a point.
    float lobe_crossed;
    // Its offset from the first vertex.
    metal::float3 lobe_crossing_offset;
    // Vector form factor so far in the lobe's space, times 2 pi and signed.
    metal::float3 lobe_sum;
};

// Pi.
constant float LTC_PI = 3.1415927;

// 1 / (2 pi).
constant float LTC_OVER_TWO_PI = 0.15915494;

// Roughness below which the lobe no longer changes: alpha = 0.0004.
constant float LTC_ROUGHNESS_FLOOR = 0.02;

// Smallest length by which anything is divided; a reciprocal of it is still finite.
constant float LTC_TINY = 0.0000000000000000000000000000000000001;

// Factor on positions that leaves room for their differences, a power of two.
constant float LTC_HEADROOM = 0.0625;

// Largest absolute component of `v`.
float ltc_extent(
    metal::float3 v
) {
    return metal::max(metal::max(metal::abs(v.x), metal::abs(v.y)), metal::abs(v.z));
}

// `v` over its length, whatever that is: neither huge nor tiny vectors lose their direction.
// Zero for a zero vector.
metal::float3 ltc_direction(
    metal::float3 v
) {
    float _e1 = ltc_extent(v);
    metal::float3 scaled = v * (1.0 / metal::max(_e1, LTC_TINY));
    return scaled * metal::rsqrt(metal::max(metal::dot(scaled, scaled), LTC_TINY));
}

// Frame and roughness of a surface point. `normal` and `view` (towards the eye) need not be unit,
// but not zero. A view along the normal is as good as any other; one below the surface counts as
// a grazing one. `roughness` outside 0 to 1 is clamped.
//
// The tangent is the azimuth of the view in a basis made from the normal alone (Duff et al. 2017,
// "Building an Orthonormal Basis, Revisited"), so the frame stays orthonormal to rounding however
// close the view comes to the normal.
LtcSurface ltc_surface(
    metal::float3 position,
    metal::float3 normal,
    metal::float3 view,
    float roughness
) {
    LtcSurface surface = {};
    metal::float3 _e4 = ltc_direction(normal);
    metal::float3 _e5 = ltc_direction(view);
    float side = (_e4.z >= 0.0) ? 1.0 : -1.0;
    float p = -1.0 / (side + _e4.z);
    float q = (_e4.x * _e4.y) * p;
    metal::float3 basis_x = metal::float3(1.0 + (((side * _e4.x) * _e4.x) * p), side * q, -(side) * _e4.x);
    metal::float3 basis_y = metal::float3(q, side + ((_e4.y * _e4.y) * p), -(_e4.y));
    metal::float2 along = metal::float2(metal::dot(basis_x, _e5), metal::dot(basis_y, _e5));
    float sine_squared = metal::dot(along, along);
    float sine_inverse = metal::rsqrt(metal::max(sine_squared, 0.000000000001));
    metal::float2 azimuth = (sine_squared > 0.000000000001) ? (along * sine_inverse) : metal::float2(1.0, 0.0);
    float cosine = metal::dot(_e4, _e5);
    float sine = (cosine > 0.0) ? metal::min(sine_squared * sine_inverse, 1.0) : 1.0;
    float clamped = metal::clamp(roughness, LTC_ROUGHNESS_FLOOR, 1.0);
    surface.position = position;
    surface.roughness = clamped;
    surface.tangent = (basis_x * azimuth.x) + (basis_y * azimuth.y);
    surface.cos_view = metal::clamp(cosine, 0.0, 1.0);
    surface.bitangent = (basis_y * azimuth.x) - (basis_x * azimuth.y);
    surface.sin_view = sine;
    surface.normal = _e4;
    surface.alpha = clamped * clamped;
    LtcSurface _e88 = surface;
    return _e88;
}

// Texture coordinates of a surface in a table of `table_size` by `table_size` texels: roughness
// along x, the square root of the view's cosine along y, from the first texel's centre to the last
// one's. Sample with bilinear filtering and clamping.
metal::float2 ltc_table_coordinates(
    LtcSurface surface,
    float table_size
) {
    float root = surface.cos_view * metal::rsqrt(metal::max(surface.cos_view, 0.00000000000000000001));
    return ((metal::float2(surface.roughness, root) * (table_size - 1.0)) + metal::float2(0.5)) / metal::float2(table_size);
}

// The lobe that two texels of the table describe.
//
// `shape` (layer 0) holds the lobe as its deviation (X, Y, Z, W) from the mirror's lobe, in units
// of the lobe's width, with t the angle between normal and view:
//     x = cos^2 t + alpha X      z = sin t (cos t + alpha Z)
//     y = alpha sin t Y          w = alpha W
// so neither interpolation nor half precision moves a sharp highlight off its place. For
// alpha -> 0, X and Z vanish, and the rest tends to Y = -2 cos t, W = 2 cos^2 t.
// `amplitude` (layer 1) holds the albedo and its Schlick part in x and y.
LtcLobe ltc_lobe(
    LtcSurface surface,
    metal::float4 shape,
    metal::float4 amplitude
) {
    LtcLobe lobe = {};
    float c = surface.cos_view;
    float s = surface.sin_view;
    float a = surface.alpha;
    metal::float4 m = metal::float4((c * c) + (a * shape.x), (a * s) * shape.y, s * (c + (a * shape.z)), a * shape.w);
    lobe.inverse = m;
    lobe.axis_x = (surface.tangent * m.x) + (surface.normal * m.z);
    lobe.albedo = amplitude.x;
    lobe.axis_y = surface.bitangent;
    lobe.fresnel = amplitude.y;
    lobe.axis_z = (surface.tangent * m.y) + (surface.normal * m.w);
    lobe.share = 0.5 + ((0.5 * m.x) * metal::rsqrt(metal::max((m.x * m.x) + (m.y * m.y), LTC_TINY)));
    LtcLobe _e61 = lobe;
    return _e61;
}

// The lobe of a surface from the table's texture array (layers 0 and 1, `table_size` texels along
// each side) and a sampler that filters linearly and clamps to the edge.
LtcLobe ltc_lobe_from_table(
    LtcSurface surface,
    metal::texture2d_array<float, metal::access::sample> table,
    metal::sampler table_sampler,
    float table_size
) {
    metal::float2 _e4 = ltc_table_coordinates(surface, table_size);
    metal::float4 shape = table.sample(table_sampler, _e4, 0, metal::level(0.0));
    metal::float4 amplitude = table.sample(table_sampler, _e4, 1, metal::level(0.0));
    LtcLobe _e11 = ltc_lobe(surface, shape, amplitude);
    return _e11;
}

// `v`, a vector from the surface point, in the lobe's space.
metal::float3 ltc_transform(
    LtcLobe lobe,
    metal::float3 v
) {
    return metal::float3(metal::dot(lobe.axis_x, v), metal::dot(lobe.axis_y, v), metal::dot(lobe.axis_z, v));
}

// Reflected radiance of a specular surface with reflectance `normal_reflectance` (F0) at normal and
// `grazing_reflectance` (F90) at grazing incidence, from the value (diffuse, specular, fresnel) of a
// light of unit radiance (Schlick 1994).
metal::float3 ltc_reflectance(
    metal::float3 value,
    metal::float3 normal_reflectance,
    metal::float3 grazing_reflectance
) {
    return (normal_reflectance * (value.y - value.z)) + (grazing_reflectance * value.z);
}

// The parts (specular, fresnel) of a light's value, from the `coverage` of a lobe, the share of
// its energy that the light covers, and the mean direction `toward` the light in the lobe's space.
//
// A lobe's shape is fitted to the whole BRDF. Schlick's part has another shape, and knows it from
// the direction: for a small light it is (1 - v.h)^5 of the specular part, v.h taken at the light;
// for a light that covers the whole lobe it is the table's average. The square of the coverage
// leads from one to the other.
metal::float2 ltc_specular(
    LtcSurface surface,
    LtcLobe lobe,
    float coverage,
    metal::float3 toward
) {
    metal::float4 m = lobe.inverse;
    float volume = (lobe.inverse.x * lobe.inverse.w) - (lobe.inverse.y * lobe.inverse.z);
    metal::float3 direction = metal::float3((lobe.inverse.w * toward.x) - (lobe.inverse.z * toward.z), volume * toward.y, (lobe.inverse.x * toward.z) - (lobe.inverse.y * toward.x));
    metal::float3 _e29 = ltc_direction(direction);
    float half_cosine = metal::clamp(0.5 + (0.5 * ((surface.sin_view * _e29.x) + (surface.cos_view * _e29.z))), 0.0, 1.0);
    float f = 1.0 - (half_cosine * metal::rsqrt(metal::max(half_cosine, 0.00000000000000000001)));
    float schlick = (((f * f) * f) * f) * f;
    float whole = coverage * coverage;
    return coverage * metal::float2(lobe.albedo, ((lobe.albedo * schlick) * (1.0 - whole)) + (lobe.fresnel * whole));
}

// The value (diffuse, specular, fresnel) from the signed form factor over the surface's horizon
// and the signed vector form factor over both horizons in the lobe's space; `front` tells whether
// the light shows its emitting side.
metal::float3 ltc_value(
    LtcSurface surface,
    LtcLobe lobe,
    float form_factor,
    metal::float3 lobe_form_factor,
    bool front,
    bool two_sided
) {
    bool emits = front | two_sided;
    bool flipped = two_sided & (lobe_form_factor.z < 0.0);
    metal::float3 toward = flipped ? -(lobe_form_factor) : lobe_form_factor;
    float diffuse = two_sided ? metal::abs(form_factor) : form_factor;
    float coverage = emits ? metal::clamp(toward.z / lobe.share, 0.0, 1.0) : 0.0;
    metal::float2 _e23 = ltc_specular(surface, lobe, coverage, toward);
    return metal::float3(emits ? metal::clamp(diffuse, 0.0, 1.0) : 0.0, _e23);
}

// (t / sin t) - 1 for an angle t of at most pi/2, from k = 1 - cos t. The relative error of
// t / sin t is below 2e-7. The coefficients are the minimax fit `softbox::fit::fit_angle_excess`
// of degree 7; no built-in inverse function of WGSL is guaranteed to be as close.
float ltc_angle_excess(
    float k
) {
    float high = (((((0.01714316 * k) - 0.041149218) * k) + 0.058181286) * k) - 0.022927942;
    float low = ((((0.03800492 + (high * k)) * k) + 0.054650154) * k) + 0.13356799;
    return ((low * k) + 0.33332586) * k;
}

// The edge integral (t / sin t) (a x b) of two unit vectors with the angle t between them, which is
// 2 pi times the edge's share of the vector form factor (Lambert; Baum et al. 1989).
//
// The usual form takes sin t from 1 - (a.b)^2 and a x b from the products; both cancel, the first
// for an edge that subtends nearly 180 degrees, which is every edge of a light that touches the
// surface, the second for a short one. Here the cross product is that of a and the difference
// b - a, and its length is the sine (Lagrange's identity). Bounded by pi for any input.
metal::float3 ltc_edge(
    metal::float3 a,
    metal::float3 b
) {
    metal::float3 chord = b - a;
    metal::float3 normal = metal::cross(a, chord);
    float k = 0.5 * metal::dot(chord, chord);
    float _e12 = ltc_angle_excess(metal::min(k, metal::max(2.0 - k, 0.0)));
    float obtuse = (LTC_PI * metal::rsqrt(metal::max(metal::dot(normal, normal), 0.000000000000000000000000000001))) - (1.0 + _e12);
    return normal * ((k > 1.0) ? obtuse : (1.0 + _e12));
}

// The edge integral's signed length for an edge on the surface's horizon: the angle from `a` to `b`
// around `normal`. Its direction is known, and rounding cannot tilt it, however close to the
// surface point the edge passes.
float ltc_horizon_edge(
    metal::float3 a,
    metal::float3 b,
    metal::float3 normal
) {
    metal::float3 _e3 = ltc_edge(a, b);
    float squared = metal::dot(_e3, _e3);
    float angle = squared * metal::rsqrt(metal::max(squared, 0.000000000000000000000000000001));
    return (metal::dot(_e3, normal) > 0.0) ? angle : -(angle);
}

// The edge integral of unit vectors `a` and `b`, less a part that vanishes over every closed
// polygon. The offsets are a - reference and b - reference.
//
// Over a closed polygon the cross products of neighbours add up to those of their offsets from any
// fixed vector. Offsets of a distant light are known to full relative precision, see ltc_offset,
// so its form factor is too, where a sum of ltc_edge has lost its digits: its terms are of the
// order of the light's angular size, its sum of that size squared. A unit vector's offset along the
// unit reference is -offset^2 / 2 exactly; with that the sum stays precise for a light on the
// horizon as well. Exact for polygons of every size; nothing has to take over from anything.
metal::float3 ltc_edge_about(
    metal::float3 reference,
    metal::float3 a,
    metal::float3 a_offset,
    metal::float3 b,
    metal::float3 b_offset
) {
    float a_squared = metal::dot(a_offset, a_offset);
    float b_squared = metal::dot(b_offset, b_offset);
    metal::float3 chord = (metal::max(a_squared, b_squared) < 0.0625) ? (b_offset - a_offset) : (b - a);
    metal::float3 normal = metal::cross(a, chord);
    float k = 0.5 * metal::dot(chord, chord);
    float _e22 = ltc_angle_excess(metal::min(k, metal::max(2.0 - k, 0.0)));
    float obtuse = (LTC_PI * metal::rsqrt(metal::max(metal::dot(normal, normal), 0.000000000000000000000000000001))) - (2.0 + _e22);
    float along = metal::dot(reference, metal::cross(a_offset, b_offset));
    metal::float3 across = 0.5 * ((a_offset * b_squared) - (b_offset * a_squared));
    return ((reference * along) + metal::cross(reference, across)) + (normal * ((k > 1.0) ? obtuse : _e22));
}

// Difference of the directions of `point` and `origin`, which differ by `offset`, with the
// relative precision of `offset`: the two unit vectors themselves differ by rounding alone when the
// points are close. `reference` is the direction of `origin`.
metal::float3 ltc_offset(
    metal::float3 origin,
    metal::float3 reference,
    metal::float3 point,
    metal::float3 offset
) {
    float inverse_length = metal::rsqrt(metal::max(metal::dot(point, point), LTC_TINY));
    float length_sum = (metal::dot(point, point) * inverse_length) + metal::dot(origin, reference);
    float length_difference = metal::dot(offset, origin + point) / metal::max(length_sum, LTC_TINY);
    metal::float3 near = (offset - (reference * length_difference)) * inverse_length;
    metal::float3 far = (point * inverse_length) - reference;
    return (metal::dot(offset, offset) < (0.0625 * metal::dot(origin, origin))) ? near : far;
}

// Where the segment from `a`, above the plane z = 0, to `b`, not above it, meets that plane.
metal::float3 ltc_crossing(
    metal::float3 a,
    metal::float3 b
) {
    float t = a.z / metal::max(a.z - b.z, LTC_TINY);
    return metal::float3(a.xy + ((b.xy - a.xy) * t), 0.0);
}

// Vector form factor, times 2 pi and signed, of a convex pentagon cut at z = 0, in any linear
// space; x and y are meaningful only as a direction. Repeated vertices make it any smaller polygon.
metal::float3 ltc_pentagon(
    metal::float3 a,
    metal::float3 b,
    metal::float3 c,
    metal::float3 d,
    metal::float3 e
) {
    float lowest = metal::min(metal::min(metal::min(a.z, b.z), metal::min(c.z, d.z)), e.z);
    float highest = metal::max(metal::max(metal::max(a.z, b.z), metal::max(c.z, d.z)), e.z);
    metal::float3 a_unit = a * metal::rsqrt(metal::max(metal::dot(a, a), LTC_TINY));
    metal::float3 b_unit = b * metal::rsqrt(metal::max(metal::dot(b, b), LTC_TINY));
    metal::float3 c_unit = c * metal::rsqrt(metal::max(metal::dot(c, c), LTC_TINY));
    metal::float3 d_unit = d * metal::rsqrt(metal::max(metal::dot(d, d), LTC_TINY));
    metal::float3 e_unit = e * metal::rsqrt(metal::max(metal::dot(e, e), LTC_TINY));
    if (lowest > 0.0) {
        metal::float3 _e50 = ltc_edge(b_unit, a_unit);
        metal::float3 _e51 = ltc_edge(c_unit, b_unit);
        metal::float3 _e53 = ltc_edge(d_unit, c_unit);
        metal::float3 _e55 = ltc_edge(e_unit, d_unit);
        metal::float3 _e57 = ltc_edge(a_unit, e_unit);
        return (((_e50 + _e51) + _e53) + _e55) + _e57;
    }
    if (highest <= 0.0) {
        return metal::float3(0.0);
    }
    bool a_up = a.z > 0.0;
    bool b_up = b.z > 0.0;
    bool c_up = c.z > 0.0;
    bool d_up = d.z > 0.0;
    bool e_up = e.z > 0.0;
    bool leave_b = b_up & !(c_up);
    bool leave_c = c_up & !(d_up);
    bool leave_d = d_up & !(e_up);
    bool leave_e = e_up & !(a_up);
    metal::float3 leave_from = leave_e ? e : (leave_d ? d : (leave_c ? c : (leave_b ? b : a)));
    metal::float3 leave_to = leave_e ? a : (leave_d ? e : (leave_c ? d : (leave_b ? c : b)));
    bool enter_b = b_up & !(a_up);
    bool enter_c = c_up & !(b_up);
    bool enter_d = d_up & !(c_up);
    bool enter_e = e_up & !(d_up);
    metal::float3 enter_to = enter_e ? e : (enter_d ? d : (enter_c ? c : (enter_b ? b : a)));
    metal::float3 enter_from = enter_e ? d : (enter_d ? c : (enter_c ? b : (enter_b ? a : e)));
    metal::float3 _e110 = ltc_crossing(leave_from, leave_to);
    metal::float3 _e111 = ltc_crossing(enter_to, enter_from);
    metal::float3 x = _e110 * metal::rsqrt(metal::max(metal::dot(_e110, _e110), LTC_TINY));
    metal::float3 y = _e111 * metal::rsqrt(metal::max(metal::dot(_e111, _e111), LTC_TINY));
    metal::float3 a_end = a_up ? a_unit : (e_up ? x : y);
    metal::float3 b_end = b_up ? b_unit : (a_up ? x : y);
    metal::float3 c_end = c_up ? c_unit : (b_up ? x : y);
    metal::float3 d_end = d_up ? d_unit : (c_up ? x : y);
    metal::float3 e_end = e_up ? e_unit : (d_up ? x : y);
    metal::float3 a_start = a_up ? a_unit : y;
    metal::float3 b_start = b_up ? b_unit : y;
    metal::float3 c_start = c_up ? c_unit : y;
    metal::float3 d_start = d_up ? d_unit : y;
    metal::float3 e_start = e_up ? e_unit : y;
    metal::float3 _e137 = ltc_edge(b_end, a_start);
    metal::float3 _e138 = ltc_edge(c_end, b_start);
    metal::float3 _e140 = ltc_edge(d_end, c_start);
    metal::float3 _e142 = ltc_edge(e_end, d_start);
    metal::float3 _e144 = ltc_edge(a_end, e_start);
    metal::float3 _e146 = ltc_edge(y, x);
    return ((((_e137 + _e138) + _e140) + _e142) + _e144) + _e146;
}

// Vector form factor, times 2 pi and signed, of a pentagon above the horizon from one point `origin`
// on or near it and the offsets of its vertices from there, all much shorter than the distance.
metal::float3 ltc_far_pentagon(
    metal::float3 origin,
    metal::float3 a,
    metal::float3 b,
    metal::float3 c,
    metal::float3 d,
    metal::float3 e
) {
    metal::float3 reference = origin * metal::rsqrt(metal::max(metal::dot(origin, origin), LTC_TINY));
    metal::float3 _e12 = ltc_offset(origin, reference, origin + a, a);
    metal::float3 _e14 = ltc_offset(origin, reference, origin + b, b);
    metal::float3 _e16 = ltc_offset(origin, reference, origin + c, c);
    metal::float3 _e18 = ltc_offset(origin, reference, origin + d, d);
    metal::float3 _e20 = ltc_offset(origin, reference, origin + e, e);
    metal::float3 a_unit = reference + _e12;
    metal::float3 b_unit = reference + _e14;
    metal::float3 c_unit = reference + _e16;
    metal::float3 d_unit = reference + _e18;
    metal::float3 e_unit = reference + _e20;
    metal::float3 _e26 = ltc_edge_about(reference, b_unit, _e14, a_unit, _e12);
    metal::float3 _e27 = ltc_edge_about(reference, c_unit, _e16, b_unit, _e14);
    metal::float3 _e29 = ltc_edge_about(reference, d_unit, _e18, c_unit, _e16);
    metal::float3 _e31 = ltc_edge_about(reference, e_unit, _e20, d_unit, _e18);
    metal::float3 _e33 = ltc_edge_about(reference, a_unit, _e12, e_unit, _e20);
    return (((_e26 + _e27) + _e29) + _e31) + _e33;
}

// The value (diffuse, specular, fresnel) of a convex quad light with the vertices `a`, `b`, `c`,
// `d`, counter-clockwise seen from the side that emits (from both with `two_sided`). Repeated
// vertices make it a triangle. For a quad that is not convex use the polygon functions.
//
// Error of the form factor against exact arithmetic: at most 1e-6 for a light whose size is at
// least a tenth of its distance, 2e-6 for one that touches or all but touches the surface; at most
// 1e-4 of its value for smaller ones down to 1e-5 of the distance, unless they are seen edge-on.
// Where an edge passes by at less than 1/25 of the distance of its ends, 4e-8 times that ratio takes the
// place of 1e-6: so much do the coordinates' own digits leave open.
metal::float3 ltc_quad(
    LtcSurface surface,
    LtcLobe lobe,
    metal::float3 a,
    metal::float3 b,
    metal::float3 c,
    metal::float3 d,
    bool two_sided
) {
    metal::float3 v_a = {};
    metal::float3 v_b = {};
    metal::float3 v_c = {};
    metal::float3 v_d = {};
    metal::float3 v_e = {};
    float sum = {};
    metal::float3 lobe_sum = {};
    metal::float3 origin = surface.position * LTC_HEADROOM;
    metal::float3 a_far = a * LTC_HEADROOM;
    metal::float3 a_full = a_far - origin;
    metal::float3 b_full = (b * LTC_HEADROOM) - origin;
    metal::float3 c_full = (c * LTC_HEADROOM) - origin;
    metal::float3 d_full = (d * LTC_HEADROOM) - origin;
    float _e22 = ltc_extent(a_full);
    float _e23 = ltc_extent(b_full);
    float _e25 = ltc_extent(c_full);
    float _e26 = ltc_extent(d_full);
    float extent = metal::max(metal::max(_e22, _e23), metal::max(_e25, _e26));
    float scale = 1.0 / metal::max(extent, LTC_TINY);
    metal::float3 side_b = ((b * LTC_HEADROOM) - a_far) * scale;
    metal::float3 side_c = ((c * LTC_HEADROOM) - a_far) * scale;
    metal::float3 side_d = ((d * LTC_HEADROOM) - a_far) * scale;
    metal::float3 p_a = a_full * scale;
    bool front = metal::dot(metal::cross(side_c, side_d - side_b), p_a) < 0.0;
    float size_squared = metal::max(metal::max(metal::dot(side_b, side_b), metal::dot(side_c, side_c)), metal::dot(side_d, side_d));
    bool distant = size_squared < (0.0625 * metal::dot(p_a, p_a));
    metal::float3 p_b = distant ? side_b : (b_full * scale);
    metal::float3 p_c = distant ? side_c : (c_full * scale);
    metal::float3 p_d = distant ? side_d : (d_full * scale);
    float a_height = metal::dot(surface.normal, p_a);
    float base_height = distant ? a_height : 0.0;
    metal::float4 heights = metal::float4(a_height, base_height + metal::dot(surface.normal, p_b), base_height + metal::dot(surface.normal, p_c), base_height + metal::dot(surface.normal, p_d));
    bool a_up = heights.x > 0.0;
    bool b_up = heights.y > 0.0;
    bool c_up = heights.z > 0.0;
    bool d_up = heights.w > 0.0;
    if (!((((a_up | b_up) | c_up) | d_up))) {
        return metal::float3(0.0);
    }
    metal::float3 first = distant ? metal::float3(0.0) : p_a;
    v_a = first;
    v_b = p_b;
    v_c = p_c;
    v_d = p_d;
    v_e = p_d;
    if (!((((a_up & b_up) & c_up) & d_up))) {
        bool last_a = b_up & !(a_up);
        bool last_b = c_up & !(b_up);
        bool last_c = d_up & !(c_up);
        bool half_turn = last_b | last_c;
        bool turn = last_a | last_c;
        metal::float3 half_a = half_turn ? p_c : first;
        metal::float3 half_b = half_turn ? p_d : p_b;
        metal::float3 half_c = half_turn ? first : p_c;
        metal::float3 half_d = half_turn ? p_b : p_d;
        metal::float4 half_heights = half_turn ? heights.zwxy : heights;
        metal::float3 q_a = turn ? half_b : half_a;
        metal::float3 q_b = turn ? half_c : half_b;
        metal::float3 q_c = turn ? half_d : half_c;
        metal::float3 q_d = turn ? half_a : half_d;
        metal::float4 h = turn ? half_heights.yzwx : half_heights;
        bool up_b = h.y > 0.0;
        bool up_c = h.z > 0.0;
        metal::float3 leave_from = up_c ? q_c : (up_b ? q_b : q_a);
        metal::float3 leave_to = up_c ? q_d : (up_b ? q_c : q_b);
        float leave_high = up_c ? h.z : (up_b ? h.y : h.x);
        float leave_low = up_c ? h.w : (up_b ? h.z : h.y);
        metal::float3 leave = leave_from + ((leave_to - leave_from) * (leave_high / metal::max(leave_high - leave_low, LTC_TINY)));
        v_a = q_a;
        v_b = up_b ? q_b : leave;
        v_c = up_c ? q_c : leave;
        v_d = leave;
        v_e = q_a + ((q_d - q_a) * (h.x / metal::max(h.x - h.w, LTC_TINY)));
    }
    metal::float3 _e169 = v_a;
    metal::float3 _e170 = ltc_transform(lobe, _e169);
    metal::float3 _e171 = v_b;
    metal::float3 _e172 = ltc_transform(lobe, _e171);
    metal::float3 _e173 = v_c;
    metal::float3 _e174 = ltc_transform(lobe, _e173);
    metal::float3 _e175 = v_d;
    metal::float3 _e176 = ltc_transform(lobe, _e175);
    metal::float3 _e177 = v_e;
    metal::float3 _e178 = ltc_transform(lobe, _e177);
    if (distant) {
        metal::float3 _e182 = v_a;
        metal::float3 _e183 = v_b;
        metal::float3 _e184 = v_c;
        metal::float3 _e185 = v_d;
        metal::float3 _e186 = v_e;
        metal::float3 _e187 = ltc_far_pentagon(p_a, _e182, _e183, _e184, _e185, _e186);
        sum = metal::dot(surface.normal, _e187);
        metal::float3 _e189 = ltc_transform(lobe, p_a);
        float lobe_size = metal::max(metal::max(metal::max(metal::dot(_e170, _e170), metal::dot(_e172, _e172)), metal::max(metal::dot(_e174, _e174), metal::dot(_e176, _e176))), metal::dot(_e178, _e178));
        float lowest = _e189.z + metal::min(metal::min(metal::min(_e170.z, _e172.z), metal::min(_e174.z, _e176.z)), _e178.z);
        if ((lobe_size < (0.0625 * metal::dot(_e189, _e189))) & (lowest > 0.0)) {
            metal::float3 _e217 = ltc_far_pentagon(_e189, _e170, _e172, _e174, _e176, _e178);
            lobe_sum = _e217;
        } else {
            metal::float3 _e223 = ltc_pentagon(_e189 + _e170, _e189 + _e172, _e189 + _e174, _e189 + _e176, _e189 + _e178);
            lobe_sum = _e223;
        }
    } else {
        metal::float3 _e224 = v_a;
        metal::float3 _e225 = v_a;
        metal::float3 _e226 = v_a;
        metal::float3 a_unit = _e224 * metal::rsqrt(metal::max(metal::dot(_e225, _e226), LTC_TINY));
        metal::float3 _e232 = v_b;
        metal::float3 _e233 = v_b;
        metal::float3 _e234 = v_b;
        metal::float3 b_unit = _e232 * metal::rsqrt(metal::max(metal::dot(_e233, _e234), LTC_TINY));
        metal::float3 _e240 = v_c;
        metal::float3 _e241 = v_c;
        metal::float3 _e242 = v_c;
        metal::float3 c_unit = _e240 * metal::rsqrt(metal::max(metal::dot(_e241, _e242), LTC_TINY));
        metal::float3 _e248 = v_d;
        metal::float3 _e249 = v_d;
        metal::float3 _e250 = v_d;
        metal::float3 d_unit = _e248 * metal::rsqrt(metal::max(metal::dot(_e249, _e250), LTC_TINY));
        metal::float3 _e256 = v_e;
        metal::float3 _e257 = v_e;
        metal::float3 _e258 = v_e;
        metal::float3 e_unit = _e256 * metal::rsqrt(metal::max(metal::dot(_e257, _e258), LTC_TINY));
        metal::float3 _e264 = ltc_edge(b_unit, a_unit);
        metal::float3 _e265 = ltc_edge(c_unit, b_unit);
        metal::float3 _e267 = ltc_edge(d_unit, c_unit);
        metal::float3 _e269 = ltc_edge(a_unit, e_unit);
        metal::float3 edges = ((_e264 + _e265) + _e267) + _e269;
        float _e274 = ltc_horizon_edge(e_unit, d_unit, surface.normal);
        sum = metal::dot(surface.normal, edges) + _e274;
        metal::float3 _e276 = ltc_pentagon(_e170, _e172, _e174, _e176, _e178);
        lobe_sum = _e276;
    }
    float _e277 = sum;
    metal::float3 _e280 = lobe_sum;
    metal::float3 _e283 = ltc_value(surface, lobe, _e277 * LTC_OVER_TWO_PI, _e280 * LTC_OVER_TWO_PI, front, two_sided);
    return _e283;
}

// Starts a polygon at its first vertex.
LtcPolygon ltc_polygon_begin(
    LtcSurface surface,
    metal::float3 vertex_
) {
    LtcPolygon polygon = {};
    metal::float3 to_first = (vertex_ * LTC_HEADROOM) - (surface.position * LTC_HEADROOM);
    polygon.first = vertex_;
    float _e11 = ltc_extent(to_first);
    polygon.scale = 1.0 / metal::max(_e11, LTC_TINY);
    polygon.previous = vertex_;
    polygon.facing = 0.0;
    polygon.surface_crossing = metal::float3(0.0);
    polygon.surface_crossed = 0.0;
    polygon.surface_crossing_offset = metal::float3(0.0);
    polygon.diffuse = 0.0;
    polygon.lobe_crossing = metal::float3(0.0);
    polygon.lobe_crossed = 0.0;
    polygon.lobe_crossing_offset = metal::float3(0.0);
    polygon.lobe_sum = metal::float3(0.0);
    LtcPolygon _e40 = polygon;
    return _e40;
}

// ltc_edge_about for points and their offsets from `origin`, walked from `b` to `a` so that light
// counts positive.
metal::float3 ltc_edge_from(
    metal::float3 origin,
    metal::float3 a,
    metal::float3 a_offset,
    metal::float3 b,
    metal::float3 b_offset
) {
    metal::float3 reference = origin * metal::rsqrt(metal::max(metal::dot(origin, origin), LTC_TINY));
    metal::float3 a_unit = a * metal::rsqrt(metal::max(metal::dot(a, a), LTC_TINY));
    metal::float3 b_unit = b * metal::rsqrt(metal::max(metal::dot(b, b), LTC_TINY));
    metal::float3 _e20 = ltc_offset(origin, reference, a, a_offset);
    metal::float3 _e21 = ltc_offset(origin, reference, b, b_offset);
    metal::float3 _e22 = ltc_edge_about(reference, b_unit, _e21, a_unit, _e20);
    return _e22;
}

// Adds one edge that lies above the surface, or with `closing` on its horizon, to both integrals.
void ltc_polygon_edge(
    thread LtcPolygon& polygon,
    LtcSurface surface,
    LtcLobe lobe,
    metal::float3 reference,
    metal::float3 a,
    metal::float3 a_offset,
    metal::float3 b,
    metal::float3 b_offset,
    bool closing
) {
    metal::float3 _e9 = ltc_edge_from(reference, a, a_offset, b, b_offset);
    float along = metal::dot(surface.normal, _e9);
    float _e13 = polygon.diffuse;
    polygon.diffuse = _e13 + along;
    float reach = metal::max(metal::dot(a_offset, a_offset), metal::dot(b_offset, b_offset));
    if (closing & (reach >= (0.0625 * metal::dot(reference, reference)))) {
        metal::float3 a_unit = a * metal::rsqrt(metal::max(metal::dot(a, a), LTC_TINY));
        metal::float3 b_unit = b * metal::rsqrt(metal::max(metal::dot(b, b), LTC_TINY));
        metal::float3 _e33 = ltc_edge(b_unit, a_unit);
        float _e35 = polygon.diffuse;
        float _e37 = ltc_horizon_edge(b_unit, a_unit, surface.normal);
        polygon.diffuse = _e35 + (_e37 - metal::dot(surface.normal, _e33));
    }
    metal::float3 _e42 = ltc_transform(lobe, reference);
    metal::float3 _e43 = ltc_transform(lobe, a);
    metal::float3 _e44 = ltc_transform(lobe, b);
    metal::float3 _e45 = ltc_transform(lobe, a_offset);
    metal::float3 _e46 = ltc_transform(lobe, b_offset);
    bool a_up = _e43.z > 0.0;
    bool b_up = _e44.z > 0.0;
    if (a_up & b_up) {
        metal::float3 _e55 = polygon.lobe_sum;
        metal::float3 _e56 = ltc_edge_from(_e42, _e43, _e45, _e44, _e46);
        polygon.lobe_sum = _e55 + _e56;
        return;
    } else {
        if (a_up | b_up) {
            metal::float3 above = a_up ? _e43 : _e44;
            metal::float3 below = a_up ? _e44 : _e43;
            metal::float3 above_offset = a_up ? _e45 : _e46;
            metal::float3 below_offset = a_up ? _e46 : _e45;
            float t = above.z / metal::max(above.z - below.z, LTC_TINY);
            metal::float3 _e70 = ltc_crossing(above, below);
            metal::float3 crossing_offset = above_offset + ((below_offset - above_offset) * t);
            float _e75 = polygon.lobe_crossed;
            if (_e75 > 0.0) {
                metal::float3 base = polygon.lobe_crossing;
                metal::float3 base_offset = polygon.lobe_crossing_offset;
                metal::float3 _e83 = polygon.lobe_sum;
                metal::float3 _e88 = ltc_edge_from(_e42, a_up ? _e70 : base, a_up ? crossing_offset : base_offset, a_up ? base : _e70, a_up ? base_offset : crossing_offset);
                polygon.lobe_sum = _e83 + _e88;
            } else {
                polygon.lobe_crossed = 1.0;
                polygon.lobe_crossing = _e70;
                polygon.lobe_crossing_offset = crossing_offset;
            }
            metal::float3 _e95 = polygon.lobe_sum;
            metal::float3 _e100 = ltc_edge_from(_e42, a_up ? _e43 : _e70, a_up ? _e45 : crossing_offset, a_up ? _e70 : _e44, a_up ? crossing_offset : _e46);
            polygon.lobe_sum = _e95 + _e100;
            return;
        } else {
            return;
        }
    }
}

// Adds the next vertex.
void ltc_polygon_add(
    thread LtcPolygon& polygon,
    LtcSurface surface,
    LtcLobe lobe,
    metal::float3 vertex_1
) {
    metal::float3 origin = surface.position * LTC_HEADROOM;
    metal::float3 _e8 = polygon.first;
    metal::float3 first_far = _e8 * LTC_HEADROOM;
    metal::float3 _e12 = polygon.previous;
    metal::float3 a_far = _e12 * LTC_HEADROOM;
    metal::float3 b_far = vertex_1 * LTC_HEADROOM;
    float _e18 = ltc_extent(a_far - origin);
    float _e20 = ltc_extent(b_far - origin);
    float extent = metal::max(_e18, _e20);
    float _e23 = polygon.scale;
    float scale_1 = metal::min(_e23, 1000000000000.0 / metal::max(extent, 0.0000000000000000000000001));
    metal::float3 reference = (first_far - origin) * scale_1;
    metal::float3 a = (a_far - origin) * scale_1;
    metal::float3 b = (b_far - origin) * scale_1;
    metal::float3 a_offset = (a_far - first_far) * scale_1;
    metal::float3 b_offset = (b_far - first_far) * scale_1;
    float _e40 = polygon.facing;
    polygon.facing = _e40 + metal::dot(metal::cross(a_offset, b_offset), reference);
    polygon.previous = vertex_1;
    float height = metal::dot(surface.normal, reference);
    bool near = metal::max(metal::dot(a_offset, a_offset), metal::dot(b_offset, b_offset)) < (0.0625 * metal::dot(reference, reference));
    float a_height = near ? (height + metal::dot(surface.normal, a_offset)) : metal::dot(surface.normal, a);
    float b_height = near ? (height + metal::dot(surface.normal, b_offset)) : metal::dot(surface.normal, b);
    bool a_up = a_height > 0.0;
    bool b_up = b_height > 0.0;
    if (a_up & b_up) {
        ltc_polygon_edge(polygon, surface, lobe, reference, a, a_offset, b, b_offset, false);
        return;
    } else {
        if (a_up | b_up) {
            metal::float3 above = a_up ? a : b;
            metal::float3 below = a_up ? b : a;
            metal::float3 above_offset = a_up ? a_offset : b_offset;
            metal::float3 below_offset = a_up ? b_offset : a_offset;
            float high = metal::max(a_height, b_height);
            float t = high / metal::max(high - metal::min(a_height, b_height), LTC_TINY);
            metal::float3 crossing = above + ((below - above) * t);
            metal::float3 crossing_offset = above_offset + ((below_offset - above_offset) * t);
            float _e90 = polygon.surface_crossed;
            if (_e90 > 0.0) {
                metal::float3 base = polygon.surface_crossing;
                metal::float3 base_offset = polygon.surface_crossing_offset;
                ltc_polygon_edge(polygon, surface, lobe, reference, a_up ? crossing : base, a_up ? crossing_offset : base_offset, a_up ? base : crossing, a_up ? base_offset : crossing_offset, true);
            } else {
                polygon.surface_crossed = 1.0;
                polygon.surface_crossing = crossing;
                polygon.surface_crossing_offset = crossing_offset;
            }
            ltc_polygon_edge(polygon, surface, lobe, reference, a_up ? a : crossing, a_up ? a_offset : crossing_offset, a_up ? crossing : b, a_up ? crossing_offset : b_offset, false);
            return;
        } else {
            return;
        }
    }
}

// The value (diffuse, specular, fresnel) of the polygon whose vertices have all been added. Its
// error is that of ltc_quad, and grows with the root of the number of vertices.
metal::float3 ltc_polygon_end(
    thread LtcPolygon& polygon,
    LtcSurface surface,
    LtcLobe lobe,
    bool two_sided
) {
    metal::float3 first_1 = polygon.first;
    ltc_polygon_add(polygon, surface, lobe, first_1);
    float _e7 = polygon.facing;
    bool front = _e7 < 0.0;
    float _e11 = polygon.diffuse;
    metal::float3 _e15 = polygon.lobe_sum;
    metal::float3 _e18 = ltc_value(surface, lobe, _e11 * LTC_OVER_TWO_PI, _e15 * LTC_OVER_TWO_PI, front, two_sided);
    return _e18;
}

#endif // LTC_METAL_INCLUDED
