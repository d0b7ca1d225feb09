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
// GLSL ES    Include this text after #version, `precision highp float;`,
//            `precision highp int;` and `precision highp sampler2DArray;`: lower
//            precision breaks the geometry.
//
// Translated from wgsl/ltc.wgsl; edit that file, not this one.
// SPDX-License-Identifier: MIT OR Apache-2.0

#ifndef LTC_GLSL_INCLUDED
#define LTC_GLSL_INCLUDED

// A surface point with its shading frame: the view direction lies in the half-plane of tangent
// and normal, tangent x bitangent = normal.
struct LtcSurface {
    // The point, in the caller's space.
    vec3 position;
    // Perceptual roughness, at least LTC_ROUGHNESS_FLOOR.
    float roughness;
    // First axis of the frame.
    vec3 tangent;
    // Cosine between normal and view, 0 to 1.
    float cos_view;
    // Second axis of the frame.
    vec3 bitangent;
    // Sine between normal and view, 0 to 1.
    float sin_view;
    // Third axis of the frame.
    vec3 normal;
    // Square of the roughness.
    float alpha;
};

// One lobe: a linearly transformed cosine and the weights of the BRDF's two parts.
struct LtcLobe {
    // First row of the inverse matrix: it leads vectors from the caller's space to the lobe's.
    vec3 axis_x;
    // The BRDF's integral of f cos over the hemisphere, for F = 1.
    float albedo;
    // Second row of the inverse matrix.
    vec3 axis_y;
    // The BRDF's integral of f cos (1 - v.h)^5 over the hemisphere.
    float fresnel;
    // Third row of the inverse matrix.
    vec3 axis_z;
    // Share of the lobe's energy above the surface.
    float share;
    // First row of its cofactors: they lead cross products of vectors to the lobe's space, and directions,
    // as the transpose, back.
    vec3 normal_x;
    // Second row of the cofactors.
    vec3 normal_y;
    // Third row of the cofactors.
    vec3 normal_z;
};

// A convex quad light, cut at the surface's horizon: what all lobes share of the work on it.
struct LtcQuad {
    // First vertex of the pentagon that is left of the quad, from `base`; where the quad is not cut, the last
    // two coincide.
    vec3 a;
    // Whether the light reaches the surface at all.
    bool reaches;
    // Second vertex.
    vec3 b;
    // Whether the horizon cuts the quad.
    bool clipped;
    // Third vertex.
    vec3 c;
    // Whether the light is small for its distance.
    bool distant;
    // Fourth vertex.
    vec3 d;
    // Whether the light shows its emitting side.
    bool front;
    // Fifth vertex.
    vec3 e;
    // Whether the light emits from both sides.
    bool two_sided;
    // Zero for a near light; for a distant one the quad's first vertex from the surface point, so that the vertices
    // keep their digits.
    vec3 base;
    // Cross product of the first and the second vertex, both from the surface point.
    vec3 a_normal;
    // That of the second and the third.
    vec3 b_normal;
    // That of the third and the fourth.
    vec3 c_normal;
    // That of the fourth and the fifth.
    vec3 d_normal;
    // That of the fifth and the first.
    vec3 e_normal;
};

// State of a polygon that is given vertex by vertex, and its last edge, cut at the surface's horizon: what
// all lobes share of the work on it. Read and written by the library alone.
struct LtcOutline {
    // First vertex, in the caller's space.
    vec3 first;
    // Factor that brings the first vertex to a distance of about 1.
    float scale;
    // Last vertex so far, in the caller's space.
    vec3 previous;
    // Twice the signed area so far times the height of the surface point over the light's plane.
    float facing;
    // First point on the surface's horizon.
    vec3 crossing;
    // Form factor so far, times 2 pi and signed.
    float diffuse;
    // Offset of that point from the first vertex.
    vec3 crossing_offset;
    // Whether there is such a point.
    bool crossed;
    // The first vertex, scaled as the points of the last edge.
    vec3 reference;
    // Whether anything of the last edge lies above the horizon.
    bool above;
    // Where what is left of the last edge starts.
    vec3 start;
    // Whether the last edge leaves the upper side or comes back to it, so that a piece of the horizon closes it.
    bool closes;
    // Offset of the start from the first vertex.
    vec3 start_offset;
    // Where it ends.
    vec3 end;
    // Offset of the end.
    vec3 end_offset;
    // Cross product of start and end.
    vec3 normal;
    // Where the piece of the horizon starts.
    vec3 horizon_start;
    // Offset of that point.
    vec3 horizon_start_offset;
    // Where it ends.
    vec3 horizon_end;
    // Offset of that point.
    vec3 horizon_end_offset;
    // Cross product of the two.
    vec3 horizon_normal;
};

// What one lobe knows of an outline. Read and written by the library alone.
struct LtcOutlineLobe {
    // First point on the lobe's horizon, in the lobe's space.
    vec3 crossing;
    // Whether there is such a point.
    bool crossed;
    // Its offset from the first vertex.
    vec3 crossing_offset;
    // Vector form factor so far in the lobe's space, times 2 pi and signed.
    vec3 sum;
};

// A polygon's outline and the lobe that it lights.
struct LtcPolygon {
    // The outline.
    LtcOutline outline;
    // What the lobe knows of it.
    LtcOutlineLobe lobe;
};

// Pi.
const float LTC_PI = 3.1415927;

// 1 / (2 pi).
const float LTC_OVER_TWO_PI = 0.15915494;

// Roughness below which the lobe no longer changes: alpha = 0.0004.
const float LTC_ROUGHNESS_FLOOR = 0.02;

// Smallest length by which anything is divided; a reciprocal of it is still finite.
const float LTC_TINY = 1e-37;

// Factor on positions that leaves room for their differences, a power of two.
const float LTC_HEADROOM = 0.0625;


// Largest absolute component of `v`.
float ltc_extent(vec3 v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// `v` over its length, whatever that is: neither huge nor tiny vectors lose their direction.
// Zero for a zero vector.
vec3 ltc_direction(vec3 v) {
    float _e1 = ltc_extent(v);
    vec3 scaled = (v * (1.0 / max(_e1, LTC_TINY)));
    return (scaled * inversesqrt(max(dot(scaled, scaled), LTC_TINY)));
}

// Frame and roughness of a surface point. `normal` and `view` (towards the eye) need not be unit,
// but not zero. A view along the normal is as good as any other; one below the surface counts as
// a grazing one. `roughness` outside 0 to 1 is clamped.
//
// The tangent is the azimuth of the view in a basis made from the normal alone (Duff et al. 2017,
// "Building an Orthonormal Basis, Revisited"), so the frame stays orthonormal to rounding however
// close the view comes to the normal.
LtcSurface ltc_surface(vec3 position, vec3 normal, vec3 view, float roughness) {
    LtcSurface surface = LtcSurface(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0);
    vec3 _e4 = ltc_direction(normal);
    vec3 _e5 = ltc_direction(view);
    float side = ((_e4.z >= 0.0) ? 1.0 : -1.0);
    float p = (-1.0 / (side + _e4.z));
    float q = ((_e4.x * _e4.y) * p);
    vec3 basis_x = vec3((1.0 + (((side * _e4.x) * _e4.x) * p)), (side * q), (-(side) * _e4.x));
    vec3 basis_y = vec3(q, (side + ((_e4.y * _e4.y) * p)), -(_e4.y));
    vec2 along = vec2(dot(basis_x, _e5), dot(basis_y, _e5));
    float sine_squared = dot(along, along);
    float sine_inverse = inversesqrt(max(sine_squared, 1e-12));
    vec2 azimuth = ((sine_squared > 1e-12) ? (along * sine_inverse) : vec2(1.0, 0.0));
    float cosine = dot(_e4, _e5);
    float sine = ((cosine > 0.0) ? min((sine_squared * sine_inverse), 1.0) : 1.0);
    float clamped = clamp(roughness, LTC_ROUGHNESS_FLOOR, 1.0);
    surface.position = position;
    surface.roughness = clamped;
    surface.tangent = ((basis_x * azimuth.x) + (basis_y * azimuth.y));
    surface.cos_view = clamp(cosine, 0.0, 1.0);
    surface.bitangent = ((basis_y * azimuth.x) - (basis_x * azimuth.y));
    surface.sin_view = sine;
    surface.normal = _e4;
    surface.alpha = (clamped * clamped);
    LtcSurface _e88 = surface;
    return _e88;
}

// Texture coordinates of a surface in a table of `table_size` by `table_size` texels: roughness
// along x, the square root of the view's cosine along y, from the first texel's centre to the last
// one's. Sample with bilinear filtering and clamping.
vec2 ltc_table_coordinates(LtcSurface surface, float table_size) {
    float root = (surface.cos_view * inversesqrt(max(surface.cos_view, 1e-20)));
    return (((vec2(surface.roughness, root) * (table_size - 1.0)) + vec2(0.5)) / vec2(table_size));
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
LtcLobe ltc_lobe(LtcSurface surface, vec4 shape, vec4 amplitude) {
    LtcLobe lobe = LtcLobe(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), vec3(0.0), vec3(0.0));
    float c = surface.cos_view;
    float s = surface.sin_view;
    float a = surface.alpha;
    vec4 m = vec4(((c * c) + (a * shape.x)), ((a * s) * shape.y), (s * (c + (a * shape.z))), (a * shape.w));
    lobe.axis_x = ((surface.tangent * m.x) + (surface.normal * m.z));
    lobe.albedo = amplitude.x;
    lobe.axis_y = surface.bitangent;
    lobe.fresnel = amplitude.y;
    lobe.axis_z = ((surface.tangent * m.y) + (surface.normal * m.w));
    lobe.share = (0.5 + ((0.5 * m.x) * inversesqrt(max(((m.x * m.x) + (m.y * m.y)), LTC_TINY))));
    lobe.normal_x = ((surface.tangent * m.w) - (surface.normal * m.y));
    lobe.normal_y = (surface.bitangent * ((m.x * m.w) - (m.y * m.z)));
    lobe.normal_z = ((surface.normal * m.x) - (surface.tangent * m.z));
    LtcLobe _e86 = lobe;
    return _e86;
}

// The lobe of a surface from the table's texture array (layers 0 and 1, `table_size` texels along
// each side) and a sampler that filters linearly and clamps to the edge.
LtcLobe ltc_lobe_from_table(LtcSurface surface, highp sampler2DArray table, float table_size) {
    vec2 _e4 = ltc_table_coordinates(surface, table_size);
    vec4 shape = textureLod(table, vec3(_e4, 0), 0.0);
    vec4 amplitude = textureLod(table, vec3(_e4, 1), 0.0);
    LtcLobe _e11 = ltc_lobe(surface, shape, amplitude);
    return _e11;
}

// `v`, a vector from the surface point, in the lobe's space.
vec3 ltc_transform(LtcLobe lobe, vec3 v) {
    return vec3(dot(lobe.axis_x, v), dot(lobe.axis_y, v), dot(lobe.axis_z, v));
}

// The cross product of two vectors from the surface point, in the lobe's space: what it is the cross
// product of there. Unlike that of the transformed vectors it keeps the digits of an edge that passes
// the surface point closely.
vec3 ltc_transform_normal(LtcLobe lobe, vec3 v) {
    return vec3(dot(lobe.normal_x, v), dot(lobe.normal_y, v), dot(lobe.normal_z, v));
}

// Reflected radiance of a specular surface with reflectance `normal_reflectance` (F0) at normal and
// `grazing_reflectance` (F90) at grazing incidence, from the value (diffuse, specular, fresnel) of a
// light of unit radiance (Schlick 1994).
vec3 ltc_reflectance(vec3 value, vec3 normal_reflectance, vec3 grazing_reflectance) {
    return ((normal_reflectance * (value.y - value.z)) + (grazing_reflectance * value.z));
}

// The parts (specular, fresnel) of a light's value, from the `coverage` of a lobe, the share of
// its energy that the light covers, and the mean direction `toward` the light in the lobe's space.
//
// A lobe's shape is fitted to the whole BRDF. Schlick's part has another shape, and knows it from
// the direction: for a small light it is (1 - v.h)^5 of the specular part, v.h taken at the light;
// for a light that covers the whole lobe it is the table's average. The square of the coverage
// leads from one to the other.
vec2 ltc_specular(LtcSurface surface, LtcLobe lobe, float coverage, vec3 toward) {
    vec3 _e15 = ltc_direction((((lobe.normal_x * toward.x) + (lobe.normal_y * toward.y)) + (lobe.normal_z * toward.z)));
    float along = ((surface.sin_view * dot(surface.tangent, _e15)) + (surface.cos_view * dot(surface.normal, _e15)));
    float half_cosine = clamp((0.5 + (0.5 * along)), 0.0, 1.0);
    float f = (1.0 - (half_cosine * inversesqrt(max(half_cosine, 1e-20))));
    float schlick = ((((f * f) * f) * f) * f);
    float whole = (coverage * coverage);
    return (coverage * vec2(lobe.albedo, (((lobe.albedo * schlick) * (1.0 - whole)) + (lobe.fresnel * whole))));
}

// The value (diffuse, specular, fresnel) from the form factor over the surface's horizon and the vector
// form factor over both horizons in the lobe's space, both of the light that the surface receives.
vec3 ltc_value(LtcSurface surface, LtcLobe lobe, float form_factor, vec3 toward) {
    vec2 _e10 = ltc_specular(surface, lobe, clamp((toward.z / lobe.share), 0.0, 1.0), toward);
    return vec3(form_factor, _e10);
}

// The form factor of the light that arrives, from a signed one; `front` tells whether the light shows its
// emitting side. A two-sided light is lit by the sign that the sum itself has: `front` may differ from it by
// rounding where the light is seen edge-on.
float ltc_received(float form_factor, bool front, bool two_sided) {
    float received = (two_sided ? abs(form_factor) : form_factor);
    return ((front || two_sided) ? clamp(received, 0.0, 1.0) : 0.0);
}

// ltc_received for a vector form factor, whose sign is that of its z.
vec3 ltc_received_vector(vec3 form_factor, bool front, bool two_sided) {
    vec3 received = ((two_sided && (form_factor.z < 0.0)) ? -(form_factor) : form_factor);
    return ((front || two_sided) ? received : vec3(0.0));
}

// (t / sin t) - 1 for an angle t of at most pi/2, from k = 1 - cos t. The relative error of
// t / sin t is below 2e-7. The coefficients are the minimax fit `softbox::fit::fit_angle_excess`
// of degree 7; no built-in inverse function of WGSL is guaranteed to be as close.
float ltc_angle_excess(float k) {
    float high = ((((((0.01714316 * k) - 0.041149218) * k) + 0.058181286) * k) - 0.022927942);
    float low = (((((0.03800492 + (high * k)) * k) + 0.054650154) * k) + 0.13356799);
    return (((low * k) + 0.33332586) * k);
}

// The cross product a x b of two vectors whose difference b - a is `side`. That with the shorter of the
// two has the fewest digits to lose.
vec3 ltc_edge_normal(vec3 a, vec3 b, vec3 side) {
    return cross(((dot(b, b) < dot(a, a)) ? b : a), side);
}

// The angle between the unit vectors `a` and `b`, whose sine is given.
float ltc_angle(vec3 a, vec3 b, float sine) {
    vec3 chord = (b - a);
    float k = (0.5 * dot(chord, chord));
    float bounded = min(sine, 1.0);
    float _e13 = ltc_angle_excess(min(k, clamp((2.0 - k), 0.0, 1.0)));
    float acute = (bounded + (bounded * _e13));
    return ((k > 1.0) ? (LTC_PI - acute) : acute);
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
vec3 ltc_edge(vec3 a, vec3 b, vec3 normal, float scale) {
    float squared = dot(normal, normal);
    float inverse_length = inversesqrt(max(squared, LTC_TINY));
    float _e10 = ltc_angle(a, b, ((squared * inverse_length) * scale));
    return (normal * (inverse_length * _e10));
}

// ltc_edge for a part of an edge, for which `normal` has the right direction only.
vec3 ltc_edge_part(vec3 a, vec3 b, vec3 normal) {
    vec3 product = cross(a, (b - a));
    float squared = dot(product, product);
    float inverse_length = inversesqrt(max(dot(normal, normal), LTC_TINY));
    float _e14 = ltc_angle(a, b, (squared * inversesqrt(max(squared, 1e-30))));
    return (normal * (inverse_length * _e14));
}

// The edge integral of a short edge from the unit vector `a` along `chord`, less the cross product of its ends.
vec3 ltc_edge_excess(vec3 a, vec3 chord) {
    float _e8 = ltc_angle_excess(min((0.5 * dot(chord, chord)), 1.0));
    return (cross(a, chord) * _e8);
}

// ltc_edge_about for offsets that are both shorter than a quarter.
vec3 ltc_edge_near(vec3 reference, vec3 a, vec3 a_offset, vec3 b_offset) {
    float along = dot(reference, cross(a_offset, b_offset));
    vec3 across = (0.5 * ((a_offset * dot(b_offset, b_offset)) - (b_offset * dot(a_offset, a_offset))));
    vec3 _e17 = ltc_edge_excess(a, (b_offset - a_offset));
    return (((reference * along) + cross(reference, across)) + _e17);
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
vec3 ltc_edge_about(vec3 reference, vec3 a, vec3 a_offset, vec3 b, vec3 b_offset, vec3 normal) {
    vec3 _e6 = ltc_edge_near(reference, a, a_offset, b_offset);
    if ((max(dot(a_offset, a_offset), dot(b_offset, b_offset)) < 0.0625)) {
        return _e6;
    }
    vec3 _e13 = ltc_edge_excess(a, (b_offset - a_offset));
    vec3 _e15 = ltc_edge_part(a, b, normal);
    return (((_e6 - _e13) + _e15) - cross(a, (b - a)));
}

// Difference of the directions of `target_point` and `origin`, which differ by `offset`, with the
// relative precision of `offset`: the two unit vectors themselves differ by rounding alone when the
// points are close. `reference` is the direction of `origin`.
vec3 ltc_offset(vec3 origin, vec3 reference, vec3 target_point, vec3 offset) {
    float inverse_length = inversesqrt(max(dot(target_point, target_point), LTC_TINY));
    float length_sum = ((dot(target_point, target_point) * inverse_length) + dot(origin, reference));
    float length_difference = (dot(offset, (origin + target_point)) / max(length_sum, LTC_TINY));
    vec3 near = ((offset - (reference * length_difference)) * inverse_length);
    vec3 far = ((target_point * inverse_length) - reference);
    return ((dot(offset, offset) < (0.0625 * dot(origin, origin))) ? near : far);
}

// ltc_offset for an offset much shorter than `origin`.
vec3 ltc_far_offset(vec3 origin, vec3 reference, vec3 offset) {
    vec3 target_point = (origin + offset);
    float inverse_length = inversesqrt(max(dot(target_point, target_point), LTC_TINY));
    float length_sum = ((dot(target_point, target_point) * inverse_length) + dot(origin, reference));
    float length_difference = (dot(offset, (origin + target_point)) / max(length_sum, LTC_TINY));
    return ((offset - (reference * length_difference)) * inverse_length);
}

// Whether `v` lies above the lobe's horizon, or on it but for rounding. Where that horizon is the surface's,
// as it is seen along the normal, rounding would scatter the points of a light cut there to both sides.
bool ltc_is_above(vec3 v) {
    return ((v.z > 0.0) || ((v.z * v.z) < (1e-12 * dot(v, v))));
}

// Where the segment from `above` the plane z = 0 to `below` it meets that plane; only its direction where
// it passes the surface point closely. `normal` has the direction of above x below.
vec3 ltc_crossing(vec3 above, vec3 below, vec3 normal) {
    float t = (max(above.z, 0.0) / max((above.z - below.z), LTC_TINY));
    vec3 between = vec3((above.xy + ((below.xy - above.xy) * t)), 0.0);
    vec3 turned = vec3(normal.y, -(normal.x), 0.0);
    bool cancels = (dot(between, between) < (1e-6 * max(dot(above, above), dot(below, below))));
    bool tilted = (dot(turned, turned) > (0.001 * dot(normal, normal)));
    return ((cancels && tilted) ? turned : between);
}

// Vector form factor, times 2 pi and signed, of a convex pentagon in the lobe's space, cut at the lobe's
// horizon z = 0. Each normal has the direction of the cross product of the vertex of its name and the
// next one. Repeated vertices make it any smaller polygon; `five` tells whether `d` and `e` differ.
vec3 ltc_pentagon(vec3 a, vec3 b, vec3 c, vec3 d, vec3 e, vec3 a_normal, vec3 b_normal, vec3 c_normal, vec3 d_normal, vec3 e_normal, bool five) {
    vec3 edges = vec3(0.0);
    bool _e11 = ltc_is_above(a);
    bool _e12 = ltc_is_above(b);
    bool _e13 = ltc_is_above(c);
    bool _e14 = ltc_is_above(d);
    bool _e15 = ltc_is_above(e);
    if (!(((((_e11 || _e12) || _e13) || _e14) || _e15))) {
        return vec3(0.0);
    }
    float a_inverse = inversesqrt(max(dot(a, a), LTC_TINY));
    float b_inverse = inversesqrt(max(dot(b, b), LTC_TINY));
    float c_inverse = inversesqrt(max(dot(c, c), LTC_TINY));
    float d_inverse = inversesqrt(max(dot(d, d), LTC_TINY));
    float e_inverse = inversesqrt(max(dot(e, e), LTC_TINY));
    vec3 a_unit = (a * a_inverse);
    vec3 b_unit = (b * b_inverse);
    vec3 c_unit = (c * c_inverse);
    vec3 d_unit = (d * d_inverse);
    vec3 e_unit = (e * e_inverse);
    if (((((_e11 && _e12) && _e13) && _e14) && _e15)) {
        vec3 _e53 = ltc_edge(a_unit, b_unit, a_normal, (a_inverse * b_inverse));
        vec3 _e55 = ltc_edge(b_unit, c_unit, b_normal, (b_inverse * c_inverse));
        vec3 _e58 = ltc_edge(c_unit, d_unit, c_normal, (c_inverse * d_inverse));
        vec3 _e61 = ltc_edge(e_unit, a_unit, e_normal, (e_inverse * a_inverse));
        edges = (((_e53 + _e55) + _e58) + _e61);
        if (five) {
            vec3 _e64 = edges;
            vec3 _e66 = ltc_edge(d_unit, e_unit, d_normal, (d_inverse * e_inverse));
            edges = (_e64 + _e66);
        }
        vec3 _e68 = edges;
        return -(_e68);
    }
    bool leave_b = (_e12 && !(_e13));
    bool leave_c = (_e13 && !(_e14));
    bool leave_d = (_e14 && !(_e15));
    bool leave_e = (_e15 && !(_e11));
    vec3 leave_from = (leave_e ? e : (leave_d ? d : (leave_c ? c : (leave_b ? b : a))));
    vec3 leave_to = (leave_e ? a : (leave_d ? e : (leave_c ? d : (leave_b ? c : b))));
    vec3 leave_normal = (leave_e ? e_normal : (leave_d ? d_normal : (leave_c ? c_normal : (leave_b ? b_normal : a_normal))));
    bool enter_b = (_e12 && !(_e11));
    bool enter_c = (_e13 && !(_e12));
    bool enter_d = (_e14 && !(_e13));
    bool enter_e = (_e15 && !(_e14));
    vec3 enter_to = (enter_e ? e : (enter_d ? d : (enter_c ? c : (enter_b ? b : a))));
    vec3 enter_from = (enter_e ? d : (enter_d ? c : (enter_c ? b : (enter_b ? a : e))));
    vec3 enter_normal = (enter_e ? d_normal : (enter_d ? c_normal : (enter_c ? b_normal : (enter_b ? a_normal : e_normal))));
    vec3 _e110 = ltc_crossing(leave_from, leave_to, leave_normal);
    vec3 _e112 = ltc_crossing(enter_to, enter_from, -(enter_normal));
    vec3 leave = (_e110 * inversesqrt(max(dot(_e110, _e110), LTC_TINY)));
    vec3 enter = (_e112 * inversesqrt(max(dot(_e112, _e112), LTC_TINY)));
    vec3 a_end = (_e11 ? a_unit : (_e15 ? leave : enter));
    vec3 b_end = (_e12 ? b_unit : (_e11 ? leave : enter));
    vec3 c_end = (_e13 ? c_unit : (_e12 ? leave : enter));
    vec3 d_end = (_e14 ? d_unit : (_e13 ? leave : enter));
    vec3 e_end = (_e15 ? e_unit : (_e14 ? leave : enter));
    vec3 a_start = (_e11 ? a_unit : enter);
    vec3 b_start = (_e12 ? b_unit : enter);
    vec3 c_start = (_e13 ? c_unit : enter);
    vec3 d_start = (_e14 ? d_unit : enter);
    vec3 e_start = (_e15 ? e_unit : enter);
    vec3 _e139 = ltc_edge_normal(_e110, _e112, (_e112 - _e110));
    vec3 _e140 = ltc_edge_part(leave, enter, _e139);
    vec3 _e141 = ltc_edge_part(a_start, b_end, a_normal);
    vec3 _e142 = ltc_edge_part(b_start, c_end, b_normal);
    vec3 _e144 = ltc_edge_part(c_start, d_end, c_normal);
    vec3 _e146 = ltc_edge_part(d_start, e_end, d_normal);
    vec3 _e148 = ltc_edge_part(e_start, a_end, e_normal);
    return -((((((_e141 + _e142) + _e144) + _e146) + _e148) + _e140));
}

// Vector form factor, times 2 pi and signed, of a pentagon above the horizon from one point `origin`
// on or near it and the offsets of its vertices from there, all much shorter than the distance; `five` tells
// whether `d` and `e` differ.
vec3 ltc_far_pentagon(vec3 origin, vec3 a, vec3 b, vec3 c, vec3 d, vec3 e, bool five) {
    vec3 e_offset = vec3(0.0);
    vec3 fifth_excess = vec3(0.0);
    vec3 reference = (origin * inversesqrt(max(dot(origin, origin), LTC_TINY)));
    vec3 _e12 = ltc_far_offset(origin, reference, a);
    vec3 _e13 = ltc_far_offset(origin, reference, b);
    vec3 _e14 = ltc_far_offset(origin, reference, c);
    vec3 _e15 = ltc_far_offset(origin, reference, d);
    e_offset = _e15;
    if (five) {
        vec3 _e20 = ltc_far_offset(origin, reference, e);
        e_offset = _e20;
        vec3 _e22 = e_offset;
        vec3 _e24 = ltc_edge_excess((reference + _e15), (_e22 - _e15));
        fifth_excess = _e24;
    }
    float a_squared = dot(_e12, _e12);
    float b_squared = dot(_e13, _e13);
    float c_squared = dot(_e14, _e14);
    float d_squared = dot(_e15, _e15);
    vec3 _e29 = e_offset;
    vec3 _e30 = e_offset;
    float e_squared = dot(_e29, _e30);
    vec3 _e37 = e_offset;
    vec3 _e40 = e_offset;
    vec3 area = ((((cross(_e12, _e13) + cross(_e13, _e14)) + cross(_e14, _e15)) + cross(_e15, _e37)) + cross(_e40, _e12));
    vec3 _e54 = e_offset;
    vec3 across = (((((_e12 * (b_squared - e_squared)) + (_e13 * (c_squared - a_squared))) + (_e14 * (d_squared - b_squared))) + (_e15 * (e_squared - c_squared))) + (_e54 * (a_squared - d_squared)));
    vec3 _e60 = ltc_edge_excess((reference + _e12), (_e13 - _e12));
    vec3 _e63 = ltc_edge_excess((reference + _e13), (_e14 - _e13));
    vec3 _e67 = ltc_edge_excess((reference + _e14), (_e15 - _e14));
    vec3 _e69 = fifth_excess;
    vec3 _e71 = e_offset;
    vec3 _e73 = e_offset;
    vec3 _e75 = ltc_edge_excess((reference + _e71), (_e12 - _e73));
    vec3 excess = ((((_e60 + _e63) + _e67) + _e69) + _e75);
    return -((((reference * dot(reference, area)) + cross(reference, (0.5 * across))) + excess));
}

// Cuts a convex quad light with the vertices `a`, `b`, `c`, `d` at the surface's horizon; see ltc_quad.
LtcQuad ltc_quad_begin(LtcSurface surface, vec3 a_9, vec3 b_7, vec3 c_2, vec3 d_2, bool two_sided_2) {
    LtcQuad quad = LtcQuad(vec3(0.0), false, vec3(0.0), false, vec3(0.0), false, vec3(0.0), false, vec3(0.0), false, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    vec3 v_a = vec3(0.0);
    vec3 v_b = vec3(0.0);
    vec3 v_c = vec3(0.0);
    vec3 v_d = vec3(0.0);
    vec3 v_e = vec3(0.0);
    vec3 origin = (surface.position * LTC_HEADROOM);
    vec3 a_far = (a_9 * LTC_HEADROOM);
    vec3 a_full = (a_far - origin);
    vec3 b_full = ((b_7 * LTC_HEADROOM) - origin);
    vec3 c_full = ((c_2 * LTC_HEADROOM) - origin);
    vec3 d_full = ((d_2 * LTC_HEADROOM) - origin);
    float _e21 = ltc_extent(a_full);
    float _e22 = ltc_extent(b_full);
    float _e24 = ltc_extent(c_full);
    float _e25 = ltc_extent(d_full);
    float extent = max(max(_e21, _e22), max(_e24, _e25));
    float scale = (1.0 / max(extent, LTC_TINY));
    vec3 side_b = (((b_7 * LTC_HEADROOM) - a_far) * scale);
    vec3 side_c = (((c_2 * LTC_HEADROOM) - a_far) * scale);
    vec3 side_d = (((d_2 * LTC_HEADROOM) - a_far) * scale);
    vec3 p_a = (a_full * scale);
    quad.front = (dot(cross(side_c, (side_d - side_b)), p_a) < 0.0);
    quad.two_sided = two_sided_2;
    quad.reaches = false;
    bool _e56 = quad.front;
    if (!((_e56 || two_sided_2))) {
        LtcQuad _e59 = quad;
        return _e59;
    }
    float size_squared = max(max(dot(side_b, side_b), dot(side_c, side_c)), dot(side_d, side_d));
    bool distant = (size_squared < (0.0625 * dot(p_a, p_a)));
    vec3 p_b = (distant ? side_b : (b_full * scale));
    vec3 p_c = (distant ? side_c : (c_full * scale));
    vec3 p_d = (distant ? side_d : (d_full * scale));
    float a_height = dot(surface.normal, p_a);
    float base_height = (distant ? a_height : 0.0);
    vec4 heights = vec4(a_height, (base_height + dot(surface.normal, p_b)), (base_height + dot(surface.normal, p_c)), (base_height + dot(surface.normal, p_d)));
    bool a_up = (heights.x > 0.0);
    bool b_up = (heights.y > 0.0);
    bool c_up = (heights.z > 0.0);
    bool d_up = (heights.w > 0.0);
    if (!((((a_up || b_up) || c_up) || d_up))) {
        LtcQuad _e105 = quad;
        return _e105;
    }
    quad.reaches = true;
    quad.distant = distant;
    vec3 first = (distant ? vec3(0.0) : p_a);
    v_a = first;
    v_b = p_b;
    v_c = p_c;
    v_d = p_d;
    v_e = p_d;
    quad.clipped = !((((a_up && b_up) && c_up) && d_up));
    bool _e123 = quad.clipped;
    if (_e123) {
        bool last_a = (b_up && !(a_up));
        bool last_b = (c_up && !(b_up));
        bool last_c = (d_up && !(c_up));
        bool half_turn = (last_b || last_c);
        bool turn = (last_a || last_c);
        vec3 half_a = (half_turn ? p_c : first);
        vec3 half_b = (half_turn ? p_d : p_b);
        vec3 half_c = (half_turn ? first : p_c);
        vec3 half_d = (half_turn ? p_b : p_d);
        vec4 half_heights = (half_turn ? heights.zwxy : heights);
        vec3 q_a = (turn ? half_b : half_a);
        vec3 q_b = (turn ? half_c : half_b);
        vec3 q_c = (turn ? half_d : half_c);
        vec3 q_d = (turn ? half_a : half_d);
        vec4 h = (turn ? half_heights.yzwx : half_heights);
        bool up_b = (h.y > 0.0);
        bool up_c = (h.z > 0.0);
        vec3 leave_from = (up_c ? q_c : (up_b ? q_b : q_a));
        vec3 leave_to = (up_c ? q_d : (up_b ? q_c : q_b));
        float leave_high = (up_c ? h.z : (up_b ? h.y : h.x));
        float leave_low = (up_c ? h.w : (up_b ? h.z : h.y));
        vec3 leave = (leave_from + ((leave_to - leave_from) * (leave_high / max((leave_high - leave_low), LTC_TINY))));
        v_a = q_a;
        v_b = (up_b ? q_b : leave);
        v_c = (up_c ? q_c : leave);
        v_d = leave;
        v_e = (q_a + ((q_d - q_a) * (h.x / max((h.x - h.w), LTC_TINY))));
    }
    vec3 base = (distant ? p_a : vec3(0.0));
    vec3 _e187 = v_a;
    quad.a = _e187;
    vec3 _e189 = v_b;
    quad.b = _e189;
    vec3 _e191 = v_c;
    quad.c = _e191;
    vec3 _e193 = v_d;
    quad.d = _e193;
    vec3 _e195 = v_e;
    quad.e = _e195;
    quad.base = base;
    vec3 _e198 = v_a;
    vec3 _e200 = v_b;
    vec3 _e202 = v_b;
    vec3 _e203 = v_a;
    vec3 _e205 = ltc_edge_normal((base + _e198), (base + _e200), (_e202 - _e203));
    quad.a_normal = _e205;
    vec3 _e207 = v_b;
    vec3 _e209 = v_c;
    vec3 _e211 = v_c;
    vec3 _e212 = v_b;
    vec3 _e214 = ltc_edge_normal((base + _e207), (base + _e209), (_e211 - _e212));
    quad.b_normal = _e214;
    vec3 _e216 = v_c;
    vec3 _e218 = v_d;
    vec3 _e220 = v_d;
    vec3 _e221 = v_c;
    vec3 _e223 = ltc_edge_normal((base + _e216), (base + _e218), (_e220 - _e221));
    quad.c_normal = _e223;
    vec3 _e227 = v_d;
    vec3 _e229 = v_e;
    vec3 _e231 = v_e;
    vec3 _e232 = v_d;
    vec3 _e234 = ltc_edge_normal((base + _e227), (base + _e229), (_e231 - _e232));
    quad.d_normal = (surface.normal * dot(surface.normal, _e234));
    vec3 _e238 = v_e;
    vec3 _e240 = v_a;
    vec3 _e242 = v_a;
    vec3 _e243 = v_e;
    vec3 _e245 = ltc_edge_normal((base + _e238), (base + _e240), (_e242 - _e243));
    quad.e_normal = _e245;
    LtcQuad _e246 = quad;
    return _e246;
}

// Vector form factor, times 2 pi and signed, of what the surface's horizon leaves of a quad, in the
// caller's space.
vec3 ltc_quad_form_factor(LtcQuad quad) {
    vec3 edges = vec3(0.0);
    if (quad.distant) {
        vec3 _e9 = ltc_far_pentagon(quad.base, quad.a, quad.b, quad.c, quad.d, quad.e, quad.clipped);
        return _e9;
    }
    float a_inverse = inversesqrt(max(dot(quad.a, quad.a), LTC_TINY));
    float b_inverse = inversesqrt(max(dot(quad.b, quad.b), LTC_TINY));
    float c_inverse = inversesqrt(max(dot(quad.c, quad.c), LTC_TINY));
    float d_inverse = inversesqrt(max(dot(quad.d, quad.d), LTC_TINY));
    float e_inverse = inversesqrt(max(dot(quad.e, quad.e), LTC_TINY));
    vec3 a_unit = (quad.a * a_inverse);
    vec3 b_unit = (quad.b * b_inverse);
    vec3 c_unit = (quad.c * c_inverse);
    vec3 d_unit = (quad.d * d_inverse);
    vec3 e_unit = (quad.e * e_inverse);
    vec3 _e52 = ltc_edge(a_unit, b_unit, quad.a_normal, (a_inverse * b_inverse));
    vec3 _e55 = ltc_edge(b_unit, c_unit, quad.b_normal, (b_inverse * c_inverse));
    vec3 _e59 = ltc_edge(c_unit, d_unit, quad.c_normal, (c_inverse * d_inverse));
    vec3 _e63 = ltc_edge(e_unit, a_unit, quad.e_normal, (e_inverse * a_inverse));
    edges = (((_e52 + _e55) + _e59) + _e63);
    if (quad.clipped) {
        vec3 _e67 = edges;
        vec3 _e70 = ltc_edge(d_unit, e_unit, quad.d_normal, (d_inverse * e_inverse));
        edges = (_e67 + _e70);
    }
    vec3 _e72 = edges;
    return -(_e72);
}

// The form factor of a quad, 0 to 1.
float ltc_quad_diffuse(LtcSurface surface, LtcQuad quad) {
    if (!(quad.reaches)) {
        return 0.0;
    }
    vec3 _e6 = ltc_quad_form_factor(quad);
    float _e12 = ltc_received((dot(surface.normal, _e6) * LTC_OVER_TWO_PI), quad.front, quad.two_sided);
    return _e12;
}

// The vector form factor of a quad in a lobe's space, cut at both horizons, towards the light.
vec3 ltc_quad_lobe(LtcQuad quad, LtcLobe lobe) {
    vec3 sum = vec3(0.0);
    if (!(quad.reaches)) {
        return vec3(0.0);
    }
    vec3 _e7 = ltc_transform(lobe, quad.a);
    vec3 _e9 = ltc_transform(lobe, quad.b);
    vec3 _e11 = ltc_transform(lobe, quad.c);
    vec3 _e13 = ltc_transform(lobe, quad.d);
    vec3 _e15 = ltc_transform(lobe, quad.e);
    vec3 _e17 = ltc_transform(lobe, quad.base);
    float lowest = (_e17.z + min(min(min(_e7.z, _e9.z), min(_e11.z, _e13.z)), _e15.z));
    float size = max(max(max(dot(_e7, _e7), dot(_e9, _e9)), max(dot(_e11, _e11), dot(_e13, _e13))), dot(_e15, _e15));
    if (((quad.distant && (lowest > 0.0)) && (size < (0.0625 * dot(_e17, _e17))))) {
        vec3 _e49 = ltc_far_pentagon(_e17, _e7, _e9, _e11, _e13, _e15, quad.clipped);
        sum = _e49;
    } else {
        vec3 _e56 = ltc_transform_normal(lobe, quad.a_normal);
        vec3 _e58 = ltc_transform_normal(lobe, quad.b_normal);
        vec3 _e60 = ltc_transform_normal(lobe, quad.c_normal);
        vec3 _e62 = ltc_transform_normal(lobe, quad.d_normal);
        vec3 _e64 = ltc_transform_normal(lobe, quad.e_normal);
        vec3 _e66 = ltc_pentagon((_e17 + _e7), (_e17 + _e9), (_e17 + _e11), (_e17 + _e13), (_e17 + _e15), _e56, _e58, _e60, _e62, _e64, quad.clipped);
        sum = _e66;
    }
    vec3 _e67 = sum;
    vec3 _e72 = ltc_received_vector((_e67 * LTC_OVER_TWO_PI), quad.front, quad.two_sided);
    return _e72;
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
vec3 ltc_quad(LtcSurface surface, LtcLobe lobe, vec3 a, vec3 b, vec3 c, vec3 d, bool two_sided) {
    LtcQuad _e7 = ltc_quad_begin(surface, a, b, c, d, two_sided);
    if (!(_e7.reaches)) {
        return vec3(0.0);
    }
    float _e12 = ltc_quad_diffuse(surface, _e7);
    vec3 _e13 = ltc_quad_lobe(_e7, lobe);
    vec3 _e14 = ltc_value(surface, lobe, _e12, _e13);
    return _e14;
}

// Starts an outline at its first vertex.
LtcOutline ltc_outline_begin(LtcSurface surface, vec3 corner) {
    LtcOutline outline = LtcOutline(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), false, vec3(0.0), false, vec3(0.0), false, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    vec3 to_first = ((corner * LTC_HEADROOM) - (surface.position * LTC_HEADROOM));
    outline.first = corner;
    float _e11 = ltc_extent(to_first);
    outline.scale = (1.0 / max(_e11, LTC_TINY));
    outline.previous = corner;
    outline.facing = 0.0;
    outline.diffuse = 0.0;
    outline.crossed = false;
    LtcOutline _e23 = outline;
    return _e23;
}

// ltc_edge_about for points and their offsets from `origin`. A point far from `origin` may as well be
// given by its direction.
vec3 ltc_edge_from(vec3 origin, vec3 a, vec3 a_offset, vec3 b, vec3 b_offset, vec3 normal) {
    vec3 reference = (origin * inversesqrt(max(dot(origin, origin), LTC_TINY)));
    vec3 a_unit = (a * inversesqrt(max(dot(a, a), LTC_TINY)));
    vec3 b_unit = (b * inversesqrt(max(dot(b, b), LTC_TINY)));
    vec3 _e21 = ltc_offset(origin, reference, a, a_offset);
    vec3 _e22 = ltc_offset(origin, reference, b, b_offset);
    vec3 _e23 = ltc_edge_about(reference, a_unit, _e21, b_unit, _e22, normal);
    return _e23;
}

// Adds the next vertex, or the first one again to close the outline.
void ltc_outline_add(inout LtcOutline outline, LtcSurface surface, vec3 corner) {
    vec3 start = vec3(0.0);
    vec3 start_offset = vec3(0.0);
    vec3 end = vec3(0.0);
    vec3 end_offset = vec3(0.0);
    vec3 origin = (surface.position * LTC_HEADROOM);
    vec3 _e7 = outline.first;
    vec3 first_far = (_e7 * LTC_HEADROOM);
    vec3 _e11 = outline.previous;
    vec3 a_far = (_e11 * LTC_HEADROOM);
    vec3 b_far = (corner * LTC_HEADROOM);
    float _e17 = ltc_extent((a_far - origin));
    float _e19 = ltc_extent((b_far - origin));
    float extent = max(_e17, _e19);
    float _e22 = outline.scale;
    float scale_2 = min(_e22, (1000000000000.0 / max(extent, 1e-25)));
    vec3 reference_7 = ((first_far - origin) * scale_2);
    vec3 a = ((a_far - origin) * scale_2);
    vec3 b = ((b_far - origin) * scale_2);
    vec3 a_offset = ((a_far - first_far) * scale_2);
    vec3 b_offset = ((b_far - first_far) * scale_2);
    float _e39 = outline.facing;
    outline.facing = (_e39 + dot(cross(a_offset, b_offset), reference_7));
    outline.previous = corner;
    outline.reference = reference_7;
    float height = dot(surface.normal, reference_7);
    bool near = (max(dot(a_offset, a_offset), dot(b_offset, b_offset)) < (0.0625 * dot(reference_7, reference_7)));
    float a_height = (near ? (height + dot(surface.normal, a_offset)) : dot(surface.normal, a));
    float b_height = (near ? (height + dot(surface.normal, b_offset)) : dot(surface.normal, b));
    bool a_up = (a_height > 0.0);
    bool b_up = (b_height > 0.0);
    outline.above = (a_up || b_up);
    outline.closes = false;
    if (!((a_up || b_up))) {
        return;
    }
    start = a;
    start_offset = a_offset;
    end = b;
    end_offset = b_offset;
    if (!((a_up && b_up))) {
        vec3 above_1 = (a_up ? a : b);
        vec3 below = (a_up ? b : a);
        vec3 above_offset = (a_up ? a_offset : b_offset);
        vec3 below_offset = (a_up ? b_offset : a_offset);
        float high = max(a_height, b_height);
        float t = (high / max((high - min(a_height, b_height)), LTC_TINY));
        vec3 crossing = (above_1 + ((below - above_1) * t));
        vec3 crossing_offset = (above_offset + ((below_offset - above_offset) * t));
        bool _e99 = outline.crossed;
        if (_e99) {
            vec3 base = outline.crossing;
            vec3 base_offset = outline.crossing_offset;
            vec3 horizon_start = (a_up ? crossing : base);
            vec3 horizon_end = (a_up ? base : crossing);
            vec3 horizon_start_offset = (a_up ? crossing_offset : base_offset);
            vec3 horizon_end_offset = (a_up ? base_offset : crossing_offset);
            vec3 _e109 = ltc_edge_normal(horizon_start, horizon_end, (horizon_end_offset - horizon_start_offset));
            vec3 normal_7 = (surface.normal * dot(surface.normal, _e109));
            outline.closes = true;
            outline.horizon_start = horizon_start;
            outline.horizon_end = horizon_end;
            outline.horizon_start_offset = horizon_start_offset;
            outline.horizon_end_offset = horizon_end_offset;
            outline.horizon_normal = normal_7;
            float _e122 = outline.diffuse;
            vec3 _e124 = ltc_edge_from(reference_7, horizon_start, horizon_start_offset, horizon_end, horizon_end_offset, normal_7);
            outline.diffuse = (_e122 - dot(surface.normal, _e124));
        } else {
            outline.crossed = true;
            outline.crossing = crossing;
            outline.crossing_offset = crossing_offset;
        }
        start = (a_up ? a : crossing);
        start_offset = (a_up ? a_offset : crossing_offset);
        end = (a_up ? crossing : b);
        end_offset = (a_up ? crossing_offset : b_offset);
    }
    vec3 _e135 = start;
    vec3 _e136 = end;
    vec3 _e137 = end_offset;
    vec3 _e138 = start_offset;
    vec3 _e140 = ltc_edge_normal(_e135, _e136, (_e137 - _e138));
    vec3 _e142 = start;
    outline.start = _e142;
    vec3 _e144 = end;
    outline.end = _e144;
    vec3 _e146 = start_offset;
    outline.start_offset = _e146;
    vec3 _e148 = end_offset;
    outline.end_offset = _e148;
    outline.normal = _e140;
    float _e151 = outline.diffuse;
    vec3 _e153 = start;
    vec3 _e154 = start_offset;
    vec3 _e155 = end;
    vec3 _e156 = end_offset;
    vec3 _e157 = ltc_edge_from(reference_7, _e153, _e154, _e155, _e156, _e140);
    outline.diffuse = (_e151 - dot(surface.normal, _e157));
    return;
}

// Starts a lobe's part of an outline.
LtcOutlineLobe ltc_outline_lobe_begin() {
    LtcOutlineLobe sum_1 = LtcOutlineLobe(vec3(0.0), false, vec3(0.0), vec3(0.0));
    sum_1.crossed = false;
    sum_1.sum = vec3(0.0);
    LtcOutlineLobe _e6 = sum_1;
    return _e6;
}

// Adds one edge that lies above the surface or on its horizon; `reference` is in the lobe's space.
void ltc_outline_lobe_edge(inout LtcOutlineLobe sum_2, LtcLobe lobe, vec3 reference, vec3 a, vec3 a_offset, vec3 b, vec3 b_offset, vec3 normal) {
    vec3 start = vec3(0.0);
    vec3 start_offset = vec3(0.0);
    vec3 end = vec3(0.0);
    vec3 end_offset = vec3(0.0);
    vec3 _e8 = ltc_transform(lobe, a);
    vec3 _e9 = ltc_transform(lobe, b);
    vec3 _e10 = ltc_transform(lobe, a_offset);
    vec3 _e11 = ltc_transform(lobe, b_offset);
    vec3 _e12 = ltc_transform_normal(lobe, normal);
    bool _e13 = ltc_is_above(_e8);
    bool _e14 = ltc_is_above(_e9);
    if (!((_e13 || _e14))) {
        return;
    }
    start = _e8;
    start_offset = _e10;
    end = _e9;
    end_offset = _e11;
    if (!((_e13 && _e14))) {
        vec3 above = (_e13 ? _e8 : _e9);
        vec3 below = (_e13 ? _e9 : _e8);
        vec3 above_offset = (_e13 ? _e10 : _e11);
        vec3 below_offset = (_e13 ? _e11 : _e10);
        float t = (max(above.z, 0.0) / max((above.z - below.z), LTC_TINY));
        vec3 _e38 = ltc_crossing(above, below, (_e13 ? _e12 : -(_e12)));
        vec3 crossing_offset_1 = (above_offset + ((below_offset - above_offset) * t));
        bool _e43 = sum_2.crossed;
        if (_e43) {
            vec3 base = sum_2.crossing;
            vec3 base_offset = sum_2.crossing_offset;
            vec3 horizon_start = (_e13 ? _e38 : base);
            vec3 horizon_end = (_e13 ? base : _e38);
            vec3 _e51 = sum_2.sum;
            vec3 _e55 = ltc_edge_normal(horizon_start, horizon_end, (horizon_end - horizon_start));
            vec3 _e56 = ltc_edge_from(reference, horizon_start, (_e13 ? crossing_offset_1 : base_offset), horizon_end, (_e13 ? base_offset : crossing_offset_1), _e55);
            sum_2.sum = (_e51 - _e56);
        } else {
            sum_2.crossed = true;
            sum_2.crossing = _e38;
            sum_2.crossing_offset = crossing_offset_1;
        }
        start = (_e13 ? _e8 : _e38);
        start_offset = (_e13 ? _e10 : crossing_offset_1);
        end = (_e13 ? _e38 : _e9);
        end_offset = (_e13 ? crossing_offset_1 : _e11);
    }
    vec3 _e67 = sum_2.sum;
    vec3 _e68 = start;
    vec3 _e69 = start_offset;
    vec3 _e70 = end;
    vec3 _e71 = end_offset;
    vec3 _e72 = ltc_edge_from(reference, _e68, _e69, _e70, _e71, _e12);
    sum_2.sum = (_e67 - _e72);
    return;
}

// Adds what ltc_outline_add has last added to `outline` to a lobe.
void ltc_outline_lobe_add(inout LtcOutlineLobe sum, LtcOutline outline, LtcLobe lobe) {
    if (!(outline.above)) {
        return;
    }
    vec3 _e6 = ltc_transform(lobe, outline.reference);
    if (outline.closes) {
        ltc_outline_lobe_edge(sum, lobe, _e6, outline.horizon_start, outline.horizon_start_offset, outline.horizon_end, outline.horizon_end_offset, outline.horizon_normal);
    }
    ltc_outline_lobe_edge(sum, lobe, _e6, outline.start, outline.start_offset, outline.end, outline.end_offset, outline.normal);
    return;
}

// The form factor of a closed outline, 0 to 1. Its error is that of ltc_quad, and grows with the root of the number
// of vertices.
float ltc_outline_diffuse(LtcOutline outline, bool two_sided) {
    float _e8 = ltc_received((outline.diffuse * LTC_OVER_TWO_PI), (outline.facing < 0.0), two_sided);
    return _e8;
}

// The vector form factor of a closed outline in a lobe's space, cut at both horizons, towards the light.
vec3 ltc_outline_lobe(LtcOutline outline, LtcOutlineLobe sum_4, bool two_sided) {
    vec3 _e9 = ltc_received_vector((sum_4.sum * LTC_OVER_TWO_PI), (outline.facing < 0.0), two_sided);
    return _e9;
}

// Starts a polygon at its first vertex.
LtcPolygon ltc_polygon_begin(LtcSurface surface, vec3 corner) {
    LtcPolygon polygon = LtcPolygon(LtcOutline(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), false, vec3(0.0), false, vec3(0.0), false, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0)), LtcOutlineLobe(vec3(0.0), false, vec3(0.0), vec3(0.0)));
    LtcOutline _e4 = ltc_outline_begin(surface, corner);
    polygon.outline = _e4;
    LtcOutlineLobe _e6 = ltc_outline_lobe_begin();
    polygon.lobe = _e6;
    LtcPolygon _e7 = polygon;
    return _e7;
}

// Adds the next vertex.
void ltc_polygon_add(inout LtcPolygon polygon, LtcSurface surface, LtcLobe lobe_9, vec3 corner) {
    LtcOutline outline_5 = LtcOutline(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), false, vec3(0.0), false, vec3(0.0), false, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    LtcOutlineLobe sum = LtcOutlineLobe(vec3(0.0), false, vec3(0.0), vec3(0.0));
    LtcOutline _e5 = polygon.outline;
    outline_5 = _e5;
    LtcOutlineLobe _e8 = polygon.lobe;
    sum = _e8;
    ltc_outline_add(outline_5, surface, corner);
    LtcOutline _e10 = outline_5;
    ltc_outline_lobe_add(sum, _e10, lobe_9);
    LtcOutline _e12 = outline_5;
    polygon.outline = _e12;
    LtcOutlineLobe _e14 = sum;
    polygon.lobe = _e14;
    return;
}

// The value (diffuse, specular, fresnel) of the polygon whose vertices have all been added.
vec3 ltc_polygon_end(inout LtcPolygon polygon, LtcSurface surface, LtcLobe lobe_10, bool two_sided) {
    vec3 first_1 = polygon.outline.first;
    ltc_polygon_add(polygon, surface, lobe_10, first_1);
    LtcOutline _e8 = polygon.outline;
    float _e9 = ltc_outline_diffuse(_e8, two_sided);
    LtcOutline _e11 = polygon.outline;
    LtcOutlineLobe _e13 = polygon.lobe;
    vec3 _e14 = ltc_outline_lobe(_e11, _e13, two_sided);
    vec3 _e15 = ltc_value(surface, lobe_10, _e9, _e14);
    return _e15;
}

#endif // LTC_GLSL_INCLUDED
