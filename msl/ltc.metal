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
    metal::float4 entries;
    // First row of the matrix that leads vectors from the caller's space to the lobe's.
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
    // First row of the matrix that leads cross products of vectors there.
    metal::packed_float3 normal_x;
    // Determinant of the entries.
    float volume;
    // Third row of that matrix; the second is `volume` times `axis_y`.
    metal::float3 normal_z;
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
    lobe.entries = m;
    lobe.axis_x = (surface.tangent * m.x) + (surface.normal * m.z);
    lobe.albedo = amplitude.x;
    lobe.axis_y = surface.bitangent;
    lobe.fresnel = amplitude.y;
    lobe.axis_z = (surface.tangent * m.y) + (surface.normal * m.w);
    lobe.share = 0.5 + ((0.5 * m.x) * metal::rsqrt(metal::max((m.x * m.x) + (m.y * m.y), LTC_TINY)));
    lobe.normal_x = (surface.tangent * m.w) - (surface.normal * m.y);
    lobe.volume = (m.x * m.w) - (m.y * m.z);
    lobe.normal_z = (surface.normal * m.x) - (surface.tangent * m.z);
    LtcLobe _e85 = lobe;
    return _e85;
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

// The cross product of two vectors from the surface point, in the lobe's space: what it is the cross
// product of there. Unlike that of the transformed vectors it keeps the digits of an edge that passes
// the surface point closely.
metal::float3 ltc_transform_normal(
    LtcLobe lobe,
    metal::float3 v
) {
    return metal::float3(metal::dot(lobe.normal_x, v), lobe.volume * metal::dot(lobe.axis_y, v), metal::dot(lobe.normal_z, v));
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
    metal::float4 m = lobe.entries;
    metal::float3 direction = metal::float3((lobe.entries.w * toward.x) - (lobe.entries.z * toward.z), lobe.volume * toward.y, (lobe.entries.x * toward.z) - (lobe.entries.y * toward.x));
    metal::float3 _e23 = ltc_direction(direction);
    float half_cosine = metal::clamp(0.5 + (0.5 * ((surface.sin_view * _e23.x) + (surface.cos_view * _e23.z))), 0.0, 1.0);
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

// The cross product a x b of two vectors whose difference b - a is `side`. That with the shorter of the
// two has the fewest digits to lose.
metal::float3 ltc_edge_normal(
    metal::float3 a,
    metal::float3 b,
    metal::float3 side
) {
    return metal::cross((metal::dot(b, b) < metal::dot(a, a)) ? b : a, side);
}

// The angle between the unit vectors `a` and `b`, whose sine is given.
float ltc_angle(
    metal::float3 a,
    metal::float3 b,
    float sine
) {
    metal::float3 chord = b - a;
    float k = 0.5 * metal::dot(chord, chord);
    float bounded = metal::min(sine, 1.0);
    float _e13 = ltc_angle_excess(metal::min(k, metal::saturate(2.0 - k)));
    float acute = bounded + (bounded * _e13);
    return (k > 1.0) ? (LTC_PI - acute) : acute;
}

// The edge integral of the segment between the directions `a` and `b` (unit vectors): the angle t between
// them along the unit normal of their plane, which is 2 pi times the edge's share of the vector form
// factor (Lambert; Baum et al. 1989). `normal` is the cross product of the two vectors before they were
// divided by their lengths, `scale` the reciprocal of the product of these.
//
// The usual form (t / sin t) (a x b) takes sin t from 1 - (a.b)^2 and a x b from the products. Both cancel,
// the first for an edge that subtends nearly 180 degrees, which is every edge of a light that touches
// the surface, the second for a short one. Here both come from ltc_edge_normal, which keeps the distance
// at which the edge passes. Bounded by pi for any input.
metal::float3 ltc_edge(
    metal::float3 a,
    metal::float3 b,
    metal::float3 normal,
    float scale
) {
    float squared = metal::dot(normal, normal);
    float inverse_length = metal::rsqrt(metal::max(squared, LTC_TINY));
    float _e10 = ltc_angle(a, b, (squared * inverse_length) * scale);
    return normal * (inverse_length * _e10);
}

// ltc_edge for a part of an edge, for which `normal` has the right direction only.
metal::float3 ltc_edge_part(
    metal::float3 a,
    metal::float3 b,
    metal::float3 normal
) {
    metal::float3 product = metal::cross(a, b - a);
    float squared = metal::dot(product, product);
    float inverse_length = metal::rsqrt(metal::max(metal::dot(normal, normal), LTC_TINY));
    float _e14 = ltc_angle(a, b, squared * metal::rsqrt(metal::max(squared, 0.000000000000000000000000000001)));
    return normal * (inverse_length * _e14);
}

// The edge integral of a short edge from the unit vector `a` along `chord`, less the cross product of its ends.
metal::float3 ltc_edge_excess(
    metal::float3 a,
    metal::float3 chord
) {
    float _e8 = ltc_angle_excess(metal::min(0.5 * metal::dot(chord, chord), 1.0));
    return metal::cross(a, chord) * _e8;
}

// ltc_edge_about for offsets that are both shorter than a quarter.
metal::float3 ltc_edge_near(
    metal::float3 reference,
    metal::float3 a,
    metal::float3 a_offset,
    metal::float3 b_offset
) {
    float along = metal::dot(reference, metal::cross(a_offset, b_offset));
    metal::float3 across = 0.5 * ((a_offset * metal::dot(b_offset, b_offset)) - (b_offset * metal::dot(a_offset, a_offset)));
    metal::float3 _e17 = ltc_edge_excess(a, b_offset - a_offset);
    return ((reference * along) + metal::cross(reference, across)) + _e17;
}

// The edge integral of the unit vectors `a` and `b`, less a part that vanishes over every closed
// polygon. The offsets are a - reference and b - reference; `normal` has the direction of a x b.
//
// Over a closed polygon the cross products of neighbours add up to those of their offsets from any
// fixed vector. Offsets of a distant light are known to full relative precision, see ltc_offset,
// so its form factor is too, where a sum of ltc_edge has lost its digits: its terms are of the
// order of the light's angular size, its sum of that size squared. A unit vector's offset along the
// unit reference is -offset^2 / 2 exactly; with that the sum stays precise for a light on the
// horizon as well. Exact for polygons of every size.
metal::float3 ltc_edge_about(
    metal::float3 reference,
    metal::float3 a,
    metal::float3 a_offset,
    metal::float3 b,
    metal::float3 b_offset,
    metal::float3 normal
) {
    metal::float3 _e6 = ltc_edge_near(reference, a, a_offset, b_offset);
    if (metal::max(metal::dot(a_offset, a_offset), metal::dot(b_offset, b_offset)) < 0.0625) {
        return _e6;
    }
    metal::float3 _e13 = ltc_edge_excess(a, b_offset - a_offset);
    metal::float3 _e15 = ltc_edge_part(a, b, normal);
    return ((_e6 - _e13) + _e15) - metal::cross(a, b - a);
}

// Difference of the directions of `target_point` and `origin`, which differ by `offset`, with the
// relative precision of `offset`: the two unit vectors themselves differ by rounding alone when the
// points are close. `reference` is the direction of `origin`.
metal::float3 ltc_offset(
    metal::float3 origin,
    metal::float3 reference,
    metal::float3 target_point,
    metal::float3 offset
) {
    float inverse_length = metal::rsqrt(metal::max(metal::dot(target_point, target_point), LTC_TINY));
    float length_sum = (metal::dot(target_point, target_point) * inverse_length) + metal::dot(origin, reference);
    float length_difference = metal::dot(offset, origin + target_point) / metal::max(length_sum, LTC_TINY);
    metal::float3 near = (offset - (reference * length_difference)) * inverse_length;
    metal::float3 far = (target_point * inverse_length) - reference;
    return (metal::dot(offset, offset) < (0.0625 * metal::dot(origin, origin))) ? near : far;
}

// ltc_offset for an offset much shorter than `origin`.
metal::float3 ltc_far_offset(
    metal::float3 origin,
    metal::float3 reference,
    metal::float3 offset
) {
    metal::float3 target_point = origin + offset;
    float inverse_length = metal::rsqrt(metal::max(metal::dot(target_point, target_point), LTC_TINY));
    float length_sum = (metal::dot(target_point, target_point) * inverse_length) + metal::dot(origin, reference);
    float length_difference = metal::dot(offset, origin + target_point) / metal::max(length_sum, LTC_TINY);
    return (offset - (reference * length_difference)) * inverse_length;
}

// Whether `v` lies above the lobe's horizon, or on it but for rounding. Where that horizon is the surface's,
// as it is seen along the normal, rounding would scatter the points of a light cut there to both sides.
bool ltc_is_above(
    metal::float3 v
) {
    return (v.z > 0.0) | ((v.z * v.z) < (0.000000000001 * metal::dot(v, v)));
}

// Where the segment from `above` the plane z = 0 to `below` it meets that plane; only its direction where
// it passes the surface point closely. `normal` has the direction of above x below.
metal::float3 ltc_crossing(
    metal::float3 above,
    metal::float3 below,
    metal::float3 normal
) {
    float t = metal::max(above.z, 0.0) / metal::max(above.z - below.z, LTC_TINY);
    metal::float3 between = metal::float3(above.xy + ((below.xy - above.xy) * t), 0.0);
    metal::float3 turned = metal::float3(normal.y, -(normal.x), 0.0);
    bool cancels = metal::dot(between, between) < (0.000001 * metal::max(metal::dot(above, above), metal::dot(below, below)));
    bool tilted = metal::dot(turned, turned) > (0.001 * metal::dot(normal, normal));
    return (cancels & tilted) ? turned : between;
}

// Vector form factor, times 2 pi and signed, of a convex pentagon in the lobe's space, cut at the lobe's
// horizon z = 0. Each normal has the direction of the cross product of the vertex of its name and the
// next one. Repeated vertices make it any smaller polygon; `five` tells whether `d` and `e` differ.
metal::float3 ltc_pentagon(
    metal::float3 a,
    metal::float3 b,
    metal::float3 c,
    metal::float3 d,
    metal::float3 e,
    metal::float3 a_normal,
    metal::float3 b_normal,
    metal::float3 c_normal,
    metal::float3 d_normal,
    metal::float3 e_normal,
    bool five
) {
    metal::float3 edges = {};
    bool _e11 = ltc_is_above(a);
    bool _e12 = ltc_is_above(b);
    bool _e13 = ltc_is_above(c);
    bool _e14 = ltc_is_above(d);
    bool _e15 = ltc_is_above(e);
    if (!(((((_e11 | _e12) | _e13) | _e14) | _e15))) {
        return metal::float3(0.0);
    }
    float a_inverse = metal::rsqrt(metal::max(metal::dot(a, a), LTC_TINY));
    float b_inverse = metal::rsqrt(metal::max(metal::dot(b, b), LTC_TINY));
    float c_inverse = metal::rsqrt(metal::max(metal::dot(c, c), LTC_TINY));
    float d_inverse = metal::rsqrt(metal::max(metal::dot(d, d), LTC_TINY));
    float e_inverse = metal::rsqrt(metal::max(metal::dot(e, e), LTC_TINY));
    metal::float3 a_unit = a * a_inverse;
    metal::float3 b_unit = b * b_inverse;
    metal::float3 c_unit = c * c_inverse;
    metal::float3 d_unit = d * d_inverse;
    metal::float3 e_unit = e * e_inverse;
    if ((((_e11 & _e12) & _e13) & _e14) & _e15) {
        metal::float3 _e53 = ltc_edge(a_unit, b_unit, a_normal, a_inverse * b_inverse);
        metal::float3 _e55 = ltc_edge(b_unit, c_unit, b_normal, b_inverse * c_inverse);
        metal::float3 _e58 = ltc_edge(c_unit, d_unit, c_normal, c_inverse * d_inverse);
        metal::float3 _e61 = ltc_edge(e_unit, a_unit, e_normal, e_inverse * a_inverse);
        edges = ((_e53 + _e55) + _e58) + _e61;
        if (five) {
            metal::float3 _e64 = edges;
            metal::float3 _e66 = ltc_edge(d_unit, e_unit, d_normal, d_inverse * e_inverse);
            edges = _e64 + _e66;
        }
        metal::float3 _e68 = edges;
        return -(_e68);
    }
    bool leave_b = _e12 & !(_e13);
    bool leave_c = _e13 & !(_e14);
    bool leave_d = _e14 & !(_e15);
    bool leave_e = _e15 & !(_e11);
    metal::float3 leave_from = leave_e ? e : (leave_d ? d : (leave_c ? c : (leave_b ? b : a)));
    metal::float3 leave_to = leave_e ? a : (leave_d ? e : (leave_c ? d : (leave_b ? c : b)));
    metal::float3 leave_normal = leave_e ? e_normal : (leave_d ? d_normal : (leave_c ? c_normal : (leave_b ? b_normal : a_normal)));
    bool enter_b = _e12 & !(_e11);
    bool enter_c = _e13 & !(_e12);
    bool enter_d = _e14 & !(_e13);
    bool enter_e = _e15 & !(_e14);
    metal::float3 enter_to = enter_e ? e : (enter_d ? d : (enter_c ? c : (enter_b ? b : a)));
    metal::float3 enter_from = enter_e ? d : (enter_d ? c : (enter_c ? b : (enter_b ? a : e)));
    metal::float3 enter_normal = enter_e ? d_normal : (enter_d ? c_normal : (enter_c ? b_normal : (enter_b ? a_normal : e_normal)));
    metal::float3 _e110 = ltc_crossing(leave_from, leave_to, leave_normal);
    metal::float3 _e112 = ltc_crossing(enter_to, enter_from, -(enter_normal));
    metal::float3 leave = _e110 * metal::rsqrt(metal::max(metal::dot(_e110, _e110), LTC_TINY));
    metal::float3 enter = _e112 * metal::rsqrt(metal::max(metal::dot(_e112, _e112), LTC_TINY));
    metal::float3 a_end = _e11 ? a_unit : (_e15 ? leave : enter);
    metal::float3 b_end = _e12 ? b_unit : (_e11 ? leave : enter);
    metal::float3 c_end = _e13 ? c_unit : (_e12 ? leave : enter);
    metal::float3 d_end = _e14 ? d_unit : (_e13 ? leave : enter);
    metal::float3 e_end = _e15 ? e_unit : (_e14 ? leave : enter);
    metal::float3 a_start = _e11 ? a_unit : enter;
    metal::float3 b_start = _e12 ? b_unit : enter;
    metal::float3 c_start = _e13 ? c_unit : enter;
    metal::float3 d_start = _e14 ? d_unit : enter;
    metal::float3 e_start = _e15 ? e_unit : enter;
    metal::float3 _e139 = ltc_edge_normal(_e110, _e112, _e112 - _e110);
    metal::float3 _e140 = ltc_edge_part(leave, enter, _e139);
    metal::float3 _e141 = ltc_edge_part(a_start, b_end, a_normal);
    metal::float3 _e142 = ltc_edge_part(b_start, c_end, b_normal);
    metal::float3 _e144 = ltc_edge_part(c_start, d_end, c_normal);
    metal::float3 _e146 = ltc_edge_part(d_start, e_end, d_normal);
    metal::float3 _e148 = ltc_edge_part(e_start, a_end, e_normal);
    return -((((((_e141 + _e142) + _e144) + _e146) + _e148) + _e140));
}

// Vector form factor, times 2 pi and signed, of a pentagon above the horizon from one point `origin`
// on or near it and the offsets of its vertices from there, all much shorter than the distance; `five` tells
// whether `d` and `e` differ.
metal::float3 ltc_far_pentagon(
    metal::float3 origin,
    metal::float3 a,
    metal::float3 b,
    metal::float3 c,
    metal::float3 d,
    metal::float3 e,
    bool five
) {
    metal::float3 e_offset = {};
    metal::float3 fifth_excess = metal::float3(0.0);
    metal::float3 reference = origin * metal::rsqrt(metal::max(metal::dot(origin, origin), LTC_TINY));
    metal::float3 _e12 = ltc_far_offset(origin, reference, a);
    metal::float3 _e13 = ltc_far_offset(origin, reference, b);
    metal::float3 _e14 = ltc_far_offset(origin, reference, c);
    metal::float3 _e15 = ltc_far_offset(origin, reference, d);
    e_offset = _e15;
    if (five) {
        metal::float3 _e20 = ltc_far_offset(origin, reference, e);
        e_offset = _e20;
        metal::float3 _e22 = e_offset;
        metal::float3 _e24 = ltc_edge_excess(reference + _e15, _e22 - _e15);
        fifth_excess = _e24;
    }
    float a_squared = metal::dot(_e12, _e12);
    float b_squared = metal::dot(_e13, _e13);
    float c_squared = metal::dot(_e14, _e14);
    float d_squared = metal::dot(_e15, _e15);
    metal::float3 _e29 = e_offset;
    metal::float3 _e30 = e_offset;
    float e_squared = metal::dot(_e29, _e30);
    metal::float3 _e37 = e_offset;
    metal::float3 _e40 = e_offset;
    metal::float3 area = (((metal::cross(_e12, _e13) + metal::cross(_e13, _e14)) + metal::cross(_e14, _e15)) + metal::cross(_e15, _e37)) + metal::cross(_e40, _e12);
    metal::float3 _e54 = e_offset;
    metal::float3 across = ((((_e12 * (b_squared - e_squared)) + (_e13 * (c_squared - a_squared))) + (_e14 * (d_squared - b_squared))) + (_e15 * (e_squared - c_squared))) + (_e54 * (a_squared - d_squared));
    metal::float3 _e60 = ltc_edge_excess(reference + _e12, _e13 - _e12);
    metal::float3 _e63 = ltc_edge_excess(reference + _e13, _e14 - _e13);
    metal::float3 _e67 = ltc_edge_excess(reference + _e14, _e15 - _e14);
    metal::float3 _e69 = fifth_excess;
    metal::float3 _e71 = e_offset;
    metal::float3 _e73 = e_offset;
    metal::float3 _e75 = ltc_edge_excess(reference + _e71, _e12 - _e73);
    metal::float3 excess = (((_e60 + _e63) + _e67) + _e69) + _e75;
    return -((((reference * metal::dot(reference, area)) + metal::cross(reference, 0.5 * across)) + excess));
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
    metal::float3 edges = {};
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
    if (!((front | two_sided))) {
        return metal::float3(0.0);
    }
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
    bool clipped = !((((a_up & b_up) & c_up) & d_up));
    if (clipped) {
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
    metal::float3 base = distant ? p_a : metal::float3(0.0);
    metal::float3 _e176 = v_a;
    metal::float3 _e178 = v_b;
    metal::float3 _e180 = v_b;
    metal::float3 _e181 = v_a;
    metal::float3 _e183 = ltc_edge_normal(base + _e176, base + _e178, _e180 - _e181);
    metal::float3 _e184 = v_b;
    metal::float3 _e186 = v_c;
    metal::float3 _e188 = v_c;
    metal::float3 _e189 = v_b;
    metal::float3 _e191 = ltc_edge_normal(base + _e184, base + _e186, _e188 - _e189);
    metal::float3 _e192 = v_c;
    metal::float3 _e194 = v_d;
    metal::float3 _e196 = v_d;
    metal::float3 _e197 = v_c;
    metal::float3 _e199 = ltc_edge_normal(base + _e192, base + _e194, _e196 - _e197);
    metal::float3 _e202 = v_d;
    metal::float3 _e204 = v_e;
    metal::float3 _e206 = v_e;
    metal::float3 _e207 = v_d;
    metal::float3 _e209 = ltc_edge_normal(base + _e202, base + _e204, _e206 - _e207);
    metal::float3 d_normal = surface.normal * metal::dot(surface.normal, _e209);
    metal::float3 _e212 = v_e;
    metal::float3 _e214 = v_a;
    metal::float3 _e216 = v_a;
    metal::float3 _e217 = v_e;
    metal::float3 _e219 = ltc_edge_normal(base + _e212, base + _e214, _e216 - _e217);
    metal::float3 _e220 = v_a;
    metal::float3 _e221 = ltc_transform(lobe, _e220);
    metal::float3 _e222 = v_b;
    metal::float3 _e223 = ltc_transform(lobe, _e222);
    metal::float3 _e224 = v_c;
    metal::float3 _e225 = ltc_transform(lobe, _e224);
    metal::float3 _e226 = v_d;
    metal::float3 _e227 = ltc_transform(lobe, _e226);
    metal::float3 _e228 = v_e;
    metal::float3 _e229 = ltc_transform(lobe, _e228);
    metal::float3 _e230 = ltc_transform(lobe, base);
    metal::float3 _e231 = ltc_transform_normal(lobe, _e183);
    metal::float3 _e232 = ltc_transform_normal(lobe, _e191);
    metal::float3 _e233 = ltc_transform_normal(lobe, _e199);
    metal::float3 _e234 = ltc_transform_normal(lobe, d_normal);
    metal::float3 _e235 = ltc_transform_normal(lobe, _e219);
    float lowest = _e230.z + metal::min(metal::min(metal::min(_e221.z, _e223.z), metal::min(_e225.z, _e227.z)), _e229.z);
    if (distant) {
        metal::float3 _e249 = v_a;
        metal::float3 _e250 = v_b;
        metal::float3 _e251 = v_c;
        metal::float3 _e252 = v_d;
        metal::float3 _e253 = v_e;
        metal::float3 _e254 = ltc_far_pentagon(p_a, _e249, _e250, _e251, _e252, _e253, clipped);
        sum = metal::dot(surface.normal, _e254);
    } else {
        metal::float3 _e256 = v_a;
        metal::float3 _e257 = v_a;
        float a_inverse = metal::rsqrt(metal::max(metal::dot(_e256, _e257), LTC_TINY));
        metal::float3 _e262 = v_b;
        metal::float3 _e263 = v_b;
        float b_inverse = metal::rsqrt(metal::max(metal::dot(_e262, _e263), LTC_TINY));
        metal::float3 _e268 = v_c;
        metal::float3 _e269 = v_c;
        float c_inverse = metal::rsqrt(metal::max(metal::dot(_e268, _e269), LTC_TINY));
        metal::float3 _e274 = v_d;
        metal::float3 _e275 = v_d;
        float d_inverse = metal::rsqrt(metal::max(metal::dot(_e274, _e275), LTC_TINY));
        metal::float3 _e280 = v_e;
        metal::float3 _e281 = v_e;
        float e_inverse = metal::rsqrt(metal::max(metal::dot(_e280, _e281), LTC_TINY));
        metal::float3 _e286 = v_a;
        metal::float3 a_unit = _e286 * a_inverse;
        metal::float3 _e288 = v_b;
        metal::float3 b_unit = _e288 * b_inverse;
        metal::float3 _e290 = v_c;
        metal::float3 c_unit = _e290 * c_inverse;
        metal::float3 _e292 = v_d;
        metal::float3 d_unit = _e292 * d_inverse;
        metal::float3 _e294 = v_e;
        metal::float3 e_unit = _e294 * e_inverse;
        metal::float3 _e297 = ltc_edge(a_unit, b_unit, _e183, a_inverse * b_inverse);
        metal::float3 _e299 = ltc_edge(b_unit, c_unit, _e191, b_inverse * c_inverse);
        metal::float3 _e302 = ltc_edge(c_unit, d_unit, _e199, c_inverse * d_inverse);
        metal::float3 _e305 = ltc_edge(e_unit, a_unit, _e219, e_inverse * a_inverse);
        edges = ((_e297 + _e299) + _e302) + _e305;
        if (clipped) {
            metal::float3 _e308 = edges;
            metal::float3 _e310 = ltc_edge(d_unit, e_unit, d_normal, d_inverse * e_inverse);
            edges = _e308 + _e310;
        }
        metal::float3 _e313 = edges;
        sum = -(metal::dot(surface.normal, _e313));
    }
    float lobe_size = metal::max(metal::max(metal::max(metal::dot(_e221, _e221), metal::dot(_e223, _e223)), metal::max(metal::dot(_e225, _e225), metal::dot(_e227, _e227))), metal::dot(_e229, _e229));
    if ((distant & (lowest > 0.0)) & (lobe_size < (0.0625 * metal::dot(_e230, _e230)))) {
        metal::float3 _e334 = ltc_far_pentagon(_e230, _e221, _e223, _e225, _e227, _e229, clipped);
        lobe_sum = _e334;
    } else {
        metal::float3 _e340 = ltc_pentagon(_e230 + _e221, _e230 + _e223, _e230 + _e225, _e230 + _e227, _e230 + _e229, _e231, _e232, _e233, _e234, _e235, clipped);
        lobe_sum = _e340;
    }
    float _e341 = sum;
    metal::float3 _e344 = lobe_sum;
    metal::float3 _e347 = ltc_value(surface, lobe, _e341 * LTC_OVER_TWO_PI, _e344 * LTC_OVER_TWO_PI, front, two_sided);
    return _e347;
}

// Starts a polygon at its first vertex.
LtcPolygon ltc_polygon_begin(
    LtcSurface surface,
    metal::float3 corner
) {
    LtcPolygon polygon = {};
    metal::float3 to_first = (corner * LTC_HEADROOM) - (surface.position * LTC_HEADROOM);
    polygon.first = corner;
    float _e11 = ltc_extent(to_first);
    polygon.scale = 1.0 / metal::max(_e11, LTC_TINY);
    polygon.previous = corner;
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

// ltc_edge_about for points and their offsets from `origin`. A point far from `origin` may as well be
// given by its direction.
metal::float3 ltc_edge_from(
    metal::float3 origin,
    metal::float3 a,
    metal::float3 a_offset,
    metal::float3 b,
    metal::float3 b_offset,
    metal::float3 normal
) {
    metal::float3 reference = origin * metal::rsqrt(metal::max(metal::dot(origin, origin), LTC_TINY));
    metal::float3 a_unit = a * metal::rsqrt(metal::max(metal::dot(a, a), LTC_TINY));
    metal::float3 b_unit = b * metal::rsqrt(metal::max(metal::dot(b, b), LTC_TINY));
    metal::float3 _e21 = ltc_offset(origin, reference, a, a_offset);
    metal::float3 _e22 = ltc_offset(origin, reference, b, b_offset);
    metal::float3 _e23 = ltc_edge_about(reference, a_unit, _e21, b_unit, _e22, normal);
    return _e23;
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
    metal::float3 start = {};
    metal::float3 start_offset = {};
    metal::float3 end = {};
    metal::float3 end_offset = {};
    metal::float3 _e10 = ltc_edge_normal(a, b, b_offset - a_offset);
    metal::float3 normal_6 = closing ? (surface.normal * metal::dot(surface.normal, _e10)) : _e10;
    float _e17 = polygon.diffuse;
    metal::float3 _e19 = ltc_edge_from(reference, a, a_offset, b, b_offset, normal_6);
    polygon.diffuse = _e17 - metal::dot(surface.normal, _e19);
    metal::float3 _e22 = ltc_transform(lobe, reference);
    metal::float3 _e23 = ltc_transform(lobe, a);
    metal::float3 _e24 = ltc_transform(lobe, b);
    metal::float3 _e25 = ltc_transform(lobe, a_offset);
    metal::float3 _e26 = ltc_transform(lobe, b_offset);
    metal::float3 _e27 = ltc_transform_normal(lobe, normal_6);
    bool _e28 = ltc_is_above(_e23);
    bool _e29 = ltc_is_above(_e24);
    if (!((_e28 | _e29))) {
        return;
    }
    start = _e23;
    start_offset = _e25;
    end = _e24;
    end_offset = _e26;
    if (!((_e28 & _e29))) {
        metal::float3 above = _e28 ? _e23 : _e24;
        metal::float3 below = _e28 ? _e24 : _e23;
        metal::float3 above_offset = _e28 ? _e25 : _e26;
        metal::float3 below_offset = _e28 ? _e26 : _e25;
        float t = metal::max(above.z, 0.0) / metal::max(above.z - below.z, LTC_TINY);
        metal::float3 _e53 = ltc_crossing(above, below, _e28 ? _e27 : -(_e27));
        metal::float3 crossing_offset = above_offset + ((below_offset - above_offset) * t);
        float _e58 = polygon.lobe_crossed;
        if (_e58 > 0.0) {
            metal::float3 base = polygon.lobe_crossing;
            metal::float3 base_offset = polygon.lobe_crossing_offset;
            metal::float3 horizon_start = _e28 ? _e53 : base;
            metal::float3 horizon_end = _e28 ? base : _e53;
            metal::float3 _e68 = polygon.lobe_sum;
            metal::float3 _e72 = ltc_edge_normal(horizon_start, horizon_end, horizon_end - horizon_start);
            metal::float3 _e73 = ltc_edge_from(_e22, horizon_start, _e28 ? crossing_offset : base_offset, horizon_end, _e28 ? base_offset : crossing_offset, _e72);
            polygon.lobe_sum = _e68 - _e73;
        } else {
            polygon.lobe_crossed = 1.0;
            polygon.lobe_crossing = _e53;
            polygon.lobe_crossing_offset = crossing_offset;
        }
        start = _e28 ? _e23 : _e53;
        start_offset = _e28 ? _e25 : crossing_offset;
        end = _e28 ? _e53 : _e24;
        end_offset = _e28 ? crossing_offset : _e26;
    }
    metal::float3 _e84 = polygon.lobe_sum;
    metal::float3 _e85 = start;
    metal::float3 _e86 = start_offset;
    metal::float3 _e87 = end;
    metal::float3 _e88 = end_offset;
    metal::float3 _e89 = ltc_edge_from(_e22, _e85, _e86, _e87, _e88, _e27);
    polygon.lobe_sum = _e84 - _e89;
    return;
}

// Adds the next vertex.
void ltc_polygon_add(
    thread LtcPolygon& polygon,
    LtcSurface surface,
    LtcLobe lobe,
    metal::float3 corner
) {
    metal::float3 start = {};
    metal::float3 start_offset = {};
    metal::float3 end = {};
    metal::float3 end_offset = {};
    metal::float3 origin = surface.position * LTC_HEADROOM;
    metal::float3 _e8 = polygon.first;
    metal::float3 first_far = _e8 * LTC_HEADROOM;
    metal::float3 _e12 = polygon.previous;
    metal::float3 a_far = _e12 * LTC_HEADROOM;
    metal::float3 b_far = corner * LTC_HEADROOM;
    float _e18 = ltc_extent(a_far - origin);
    float _e20 = ltc_extent(b_far - origin);
    float extent = metal::max(_e18, _e20);
    float _e23 = polygon.scale;
    float scale_2 = metal::min(_e23, 1000000000000.0 / metal::max(extent, 0.0000000000000000000000001));
    metal::float3 reference = (first_far - origin) * scale_2;
    metal::float3 a = (a_far - origin) * scale_2;
    metal::float3 b = (b_far - origin) * scale_2;
    metal::float3 a_offset = (a_far - first_far) * scale_2;
    metal::float3 b_offset = (b_far - first_far) * scale_2;
    float _e40 = polygon.facing;
    polygon.facing = _e40 + metal::dot(metal::cross(a_offset, b_offset), reference);
    polygon.previous = corner;
    float height = metal::dot(surface.normal, reference);
    bool near = metal::max(metal::dot(a_offset, a_offset), metal::dot(b_offset, b_offset)) < (0.0625 * metal::dot(reference, reference));
    float a_height = near ? (height + metal::dot(surface.normal, a_offset)) : metal::dot(surface.normal, a);
    float b_height = near ? (height + metal::dot(surface.normal, b_offset)) : metal::dot(surface.normal, b);
    bool a_up = a_height > 0.0;
    bool b_up = b_height > 0.0;
    if (!((a_up | b_up))) {
        return;
    }
    start = a;
    start_offset = a_offset;
    end = b;
    end_offset = b_offset;
    if (!((a_up & b_up))) {
        metal::float3 above = a_up ? a : b;
        metal::float3 below = a_up ? b : a;
        metal::float3 above_offset = a_up ? a_offset : b_offset;
        metal::float3 below_offset = a_up ? b_offset : a_offset;
        float high = metal::max(a_height, b_height);
        float t = high / metal::max(high - metal::min(a_height, b_height), LTC_TINY);
        metal::float3 crossing = above + ((below - above) * t);
        metal::float3 crossing_offset = above_offset + ((below_offset - above_offset) * t);
        float _e95 = polygon.surface_crossed;
        if (_e95 > 0.0) {
            metal::float3 base = polygon.surface_crossing;
            metal::float3 base_offset = polygon.surface_crossing_offset;
            ltc_polygon_edge(polygon, surface, lobe, reference, a_up ? crossing : base, a_up ? crossing_offset : base_offset, a_up ? base : crossing, a_up ? base_offset : crossing_offset, true);
        } else {
            polygon.surface_crossed = 1.0;
            polygon.surface_crossing = crossing;
            polygon.surface_crossing_offset = crossing_offset;
        }
        start = a_up ? a : crossing;
        start_offset = a_up ? a_offset : crossing_offset;
        end = a_up ? crossing : b;
        end_offset = a_up ? crossing_offset : b_offset;
    }
    metal::float3 _e115 = start;
    metal::float3 _e116 = start_offset;
    metal::float3 _e117 = end;
    metal::float3 _e118 = end_offset;
    ltc_polygon_edge(polygon, surface, lobe, reference, _e115, _e116, _e117, _e118, false);
    return;
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
