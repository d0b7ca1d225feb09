// Softbox: light from polygons, disks, spheres and tubes by linearly transformed cosines.
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
//   1. ltc_table_coordinates: where to sample; sample in any way you like. Then ltc_lobes_of(surface, ltc_lobe(...)) from the two
//      texels, or ltc_two_lobes from three, ltc_three_lobes from five.
//   2. ltc_lobes_from_table, with the texture array and a sampler; then ltc_quad, ltc_disk, ltc_sphere, ltc_tube or the
//      ltc_polygon functions: a specular over a diffuse part.
//   3. ltc_shading: all lobes of a material; then ltc_shading_quad and so on for each light, and ltc_reflected.
//
// ARITHMETIC
//   All geometry is f32. No input with finite coordinates makes an infinity or a NaN; nothing here
//   tests for one. Positions are scaled by 1/16 so that the difference of two finite positions is
//   finite, and by the light's own size so that no product leaves the range of f32.
//
// SWITCHES
//   What a scene never calls for costs nothing: each effect has a switch, and what only serves
//   effects that are off is dead code. In WGSL a switch is an override, set for each pipeline.
//
// HLSL       Written in the subset of HLSL 2018 that shader model 5 compiles. Declares no
//            register: texture and sampler are parameters.
//            Define a switch, such as LTC_POLYGON, as 0 before, and what only serves that effect is
//            not compiled.
//
// Translated from wgsl/ltc.wgsl; edit that file, not this one.
// SPDX-License-Identifier: MIT OR Apache-2.0

#ifndef LTC_HLSL_INCLUDED
#define LTC_HLSL_INCLUDED

// Convex quads and triangles.
#ifndef LTC_QUAD
#define LTC_QUAD 1
#endif
// Polygons of any number of vertices, convex or not.
#ifndef LTC_POLYGON
#define LTC_POLYGON 1
#endif
// Disks and ellipses.
#ifndef LTC_DISK
#define LTC_DISK 1
#endif
// Spheres.
#ifndef LTC_SPHERE
#define LTC_SPHERE 1
#endif
// Cylinders, from thin lines on.
#ifndef LTC_TUBE
#define LTC_TUBE 1
#endif
// Rectangles that show an image.
#ifndef LTC_TEXTURED
#define LTC_TEXTURED 1
#endif
// Specular reflection of a rough surface.
#ifndef LTC_GGX
#define LTC_GGX 1
#endif
// A second, clear layer on top.
#ifndef LTC_CLEARCOAT
#define LTC_CLEARCOAT 1
#endif
// Reflection of fibres at grazing angles.
#ifndef LTC_SHEEN
#define LTC_SHEEN 1
#endif
// Diffuse reflection of a rough surface.
#ifndef LTC_ROUGH_DIFFUSE
#define LTC_ROUGH_DIFFUSE 1
#endif
// Light that a rough surface reflects more than once.
#ifndef LTC_ENERGY_COMPENSATION
#define LTC_ENERGY_COMPENSATION 1
#endif
// Different roughness along two axes.
#ifndef LTC_ANISOTROPIC
#define LTC_ANISOTROPIC 1
#endif
// Lights that emit from both sides.
#ifndef LTC_TWO_SIDED
#define LTC_TWO_SIDED 1
#endif
// Tubes with ends that emit.
#ifndef LTC_CAPS
#define LTC_CAPS 1
#endif
// Quads and polygons cut at the horizons by a cheap approximation.
#ifndef LTC_CHEAP_HORIZON
#define LTC_CHEAP_HORIZON 0
#endif
// Small lights treated like any other, at a loss of digits.
#ifndef LTC_CHEAP_DISTANCE
#define LTC_CHEAP_DISTANCE 0
#endif
// A closed form in place of the table of specular reflection.
#ifndef LTC_TABLE_FREE
#define LTC_TABLE_FREE 0
#endif
// Isotropic specular reflection by the sum of two lobes.
#ifndef LTC_SECOND_LOBE
#define LTC_SECOND_LOBE 0
#endif
// Isotropic specular reflection by the sum of three lobes.
#ifndef LTC_THIRD_LOBE
#define LTC_THIRD_LOBE 0
#endif

// A surface point with its shading frame: the view direction lies in the half-plane of tangent
// and normal, tangent x bitangent = normal.
struct LtcSurface {
    // The point, in the caller's space.
    float3 position;
    // Perceptual roughness, at least LTC_ROUGHNESS_FLOOR.
    float roughness;
    // First axis of the frame.
    float3 tangent;
    // Cosine between normal and view, 0 to 1.
    float cos_view;
    // Second axis of the frame.
    float3 bitangent;
    // Sine between normal and view, 0 to 1.
    float sin_view;
    // Third axis of the frame.
    float3 normal;
    // Square of the roughness.
    float alpha;
};

// One lobe: a linearly transformed cosine and the weights of the BRDF's two parts.
struct LtcLobe {
    // First row of the inverse matrix: it leads vectors from the caller's space to the lobe's.
    float3 axis_x;
    // The BRDF's integral of f cos over the hemisphere, for F = 1.
    float albedo;
    // Second row of the inverse matrix.
    float3 axis_y;
    // The BRDF's integral of f cos (1 - v.h)^5 over the hemisphere.
    float fresnel;
    // Third row of the inverse matrix.
    float3 axis_z;
    // Share of the lobe's energy above the surface.
    float share;
    // First row of its cofactors: they lead cross products of vectors to the lobe's space, and directions,
    // as the transpose, back.
    float3 normal_x;
    // Second row of the cofactors.
    float3 normal_y;
    // Third row of the cofactors.
    float3 normal_z;
    // The same for vectors in the surface's frame (tangent, bitangent, normal), where most entries of most lobes vanish:
    // first row of the inverse matrix.
    float3 frame_x;
    // Its second row.
    float3 frame_y;
    // Its third row.
    float3 frame_z;
    // First row of its cofactors.
    float3 frame_normal_x;
    // Second row of its cofactors.
    float3 frame_normal_y;
    // Third row of its cofactors.
    float3 frame_normal_z;
};

// What makes a lobe whose matrix is planar, in the surface's frame: less to keep than the lobe.
struct LtcShape {
    // The matrix, as for ltc_planar_lobe.
    float4 entries;
    // The lobe's part of the BRDF's integral of f cos, for F = 1.
    float albedo;
    // For a single lobe the integral of f cos (1 - v.h)^5, for one of a sum its excess, see ltc_lobes_part.
    float fresnel;
};

// The lobes whose sum is isotropic GGX. Those that are switched off are not read.
//
// One linearly transformed cosine is not GGX: its tails are shorter, and Schlick's part is a lobe of another shape. A sum
// of two or three, each with a weight for either part, comes closer, at the cost of a lobe each.
struct LtcLobes {
    // The first lobe; where it is the only one, that of ltc_lobe_from_table.
    LtcLobe first;
    // The second lobe.
    LtcShape second;
    // The third lobe.
    LtcShape third;
    // How many lobes this surface has; may be fewer than the switches allow.
    int count;
};

#if LTC_QUAD || LTC_TEXTURED
// A convex quad light, cut at the surface's horizon: what all lobes share of the work on it, in the surface's frame.
struct LtcQuad {
    // First vertex of the pentagon that is left of the quad, from the surface point.
    float3 a;
    // Whether the light reaches the surface at all.
    bool reaches;
    // Second vertex; of a distant light the offset from the first one, which keeps its digits, like the others.
    float3 b;
    // Whether the horizon cuts the quad.
    bool clipped;
    // Third vertex.
    float3 c;
    // Whether the light is small for its distance.
    bool distant;
    // Fourth vertex.
    float3 d;
    // Whether the light shows its emitting side.
    bool front;
    // Fifth vertex; where the quad is not cut it coincides with the fourth.
    float3 e;
    // Whether the light emits from both sides.
    bool two_sided;
    // Cross product of the first and the second vertex; of a near light only, like the others.
    float3 a_normal;
    // That of the fourth and the fifth, the exit and the entry, is vertical: its height.
    float rim;
    // That of the second and the third.
    float3 b_normal;
    // That of the third and the fourth.
    float3 c_normal;
    // That of the fifth and the first.
    float3 e_normal;
};
#endif

#if LTC_POLYGON
// State of a polygon that is given vertex by vertex, and its last edge, cut at the surface's horizon: what
// all lobes share of the work on it. Read and written by the library alone.
struct LtcOutline {
    // First vertex, in the caller's space.
    float3 first;
    // Factor that brings the first vertex to a distance of about 1.
    float scale;
    // Last vertex so far, in the caller's space.
    float3 previous;
    // Twice the signed area so far times the height of the surface point over the light's plane.
    float facing;
    // Whether the first vertex counts as above the surface.
    bool first_up;
    // Whether the last vertex so far does.
    bool previous_up;
    // First point on the surface's horizon.
    float3 crossing;
    // Form factor so far, times 2 pi and signed.
    float diffuse;
    // Offset of that point from the first vertex.
    float3 crossing_offset;
    // Whether there is such a point.
    bool crossed;
    // The first vertex, scaled as the points of the last edge.
    float3 reference;
    // Whether the last edge starts above the horizon; otherwise what is left of it starts on the horizon.
    bool starts_up;
    // Whether it ends above the horizon.
    bool ends_up;
    // Whether it ends at the first vertex.
    bool returns;
    // Where what is left of the last edge starts.
    float3 start;
    // Whether the last edge leaves the upper side or comes back to it, so that a piece of the horizon closes it.
    bool closes;
    // Offset of the start from the first vertex.
    float3 start_offset;
    // Where it ends.
    float3 end;
    // Offset of the end.
    float3 end_offset;
    // Cross product of start and end.
    float3 normal;
    // Where the piece of the horizon starts.
    float3 horizon_start;
    // Offset of that point.
    float3 horizon_start_offset;
    // Where it ends.
    float3 horizon_end;
    // Offset of that point.
    float3 horizon_end_offset;
    // Cross product of the two.
    float3 horizon_normal;
    // Vector form factor so far, times 2 pi and signed; for a cheap horizon only.
    float3 sum;
};
#endif

#if LTC_POLYGON
// What one lobe knows of an outline. Read and written by the library alone.
struct LtcOutlineLobe {
    // First point on the lobe's horizon, in the lobe's space.
    float3 crossing;
    // Whether there is such a point.
    bool crossed;
    // Its offset from the first vertex.
    float3 crossing_offset;
    // Whether there has been an edge.
    bool begun;
    // Whether the first vertex counts as above the lobe's horizon.
    bool first_up;
    // Whether the last vertex so far does.
    bool previous_up;
    // Whether the outline's first point on the surface's horizon does.
    bool crossing_up;
    // Vector form factor so far in the lobe's space, times 2 pi and signed.
    float3 sum;
    // The lobe's share above the surface; for a cheap horizon only.
    float share;
};
#endif

#if LTC_POLYGON
// What the lobes of a sum know of an outline. Those that are switched off are not read.
struct LtcOutlineLobes {
    // What the first lobe knows.
    LtcOutlineLobe first;
    // What the second lobe knows.
    LtcOutlineLobe second;
    // What the third lobe knows.
    LtcOutlineLobe third;
};
#endif

#if LTC_POLYGON
// A polygon's outline and the lobes that it lights.
struct LtcPolygon {
    // The outline.
    LtcOutline outline;
    // What the lobes know of it.
    LtcOutlineLobes sums;
};
#endif

#if LTC_TUBE
// A tube as all lobes share it: relative to the surface point, scaled, and cut at the surface's horizon.
struct LtcTube {
    // One end of what is left of the axis, moved to where the rim is seen.
    float3 start;
    // Length of what is left.
    float remaining_length;
    // Its other end.
    float3 end;
    // Distance of the moved axis.
    float axis_distance;
    // Direction from `start` to `end`; zero for a tube of no length.
    float3 axis;
    // Sine of half the angle under which the tube's width is seen, 0 to 1.
    float sine;
    // Normal of the plane through axis and surface point; shorter than 1 where the point is inside the tube.
    float3 across;
    // Share of the width that is above the surface's horizon; 0 if all of the axis is below.
    float share;
    // Towards the cap at the start, as long as the sine of half the angle under which it is seen.
    float3 start_cap;
    // Share of that cap that is seen, 0 to 1.
    float start_weight;
    // Towards the cap at the end.
    float3 end_cap;
    // Share of that cap that is seen.
    float end_weight;
};
#endif

#if LTC_TEXTURED
// Where to sample the picture of a light.
struct LtcLookup {
    // Texture coordinates.
    float2 place;
    // What to add to them for one sample of a pair, and to subtract for the other; zero if there is but one.
    float2 apart;
    // Level among the mipmaps; from 0 to any number beyond the last one.
    float level;
};
#endif

#if (LTC_ANISOTROPIC && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_TEXTURED) || (LTC_GGX && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// What a sum of lobes sees of a rectangle that shows a picture.
struct LtcSeen {
    // The colour that the lobes see on average, each by its share of the specular value.
    float3 colour;
    // The parts (specular, fresnel) for a white picture.
    float2 value;
};
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The cone over an ellipse. Vectors "in the frame" have their components along the ellipse's axes; lengths
// have a unit that makes them about 1.
struct LtcCone {
    // First semi-axis.
    float3 half_x;
    // Minus the negative eigenvalue.
    float depth;
    // Second semi-axis, conjugate to the first.
    float3 half_y;
    // Length of the vector form factor of the whole cone.
    float whole;
    // The ellipse's centre.
    float3 centre;
    // Factor on lengths that leads to the unit.
    float scale;
    // First axis of the frame, along the ellipse's longer axis.
    float3 first;
    // Square of half the longer axis.
    float first_square;
    // Second axis of the frame, along the shorter axis.
    float3 second;
    // Square of half the shorter axis.
    float second_square;
    // Third axis of the frame, away from the surface point.
    float3 third;
    // Reciprocal of the distance at which the cone's axis meets the ellipse's plane.
    float nearness;
    // The ellipse's centre in the frame.
    float3 place;
    // Where the cone's axis meets the ellipse's plane, in units of the semi-axes given: the first one's.
    float pierced_x;
    // The cone's axis in the frame, a unit vector.
    float3 axis;
    // The same, the second one's.
    float pierced_y;
};
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The other two eigenvectors of a cone, in the frame, unit vectors.
struct LtcAcross {
    // That across the wider side.
    float3 first;
    // Its eigenvalue.
    float first_value;
    // That across the narrower side.
    float3 second;
    // Its eigenvalue.
    float second_value;
};
#endif

#if LTC_DISK || LTC_SPHERE
// A plane through the surface point, as it cuts an ellipse. In units of the semi-axes given the ellipse is the
// unit circle, and the plane cuts it along a chord.
struct LtcCut {
    // Normal of the plane, a unit vector towards the side that counts.
    float3 normal;
    // Height of the circle's centre over the plane.
    float height;
    // Direction of rise in the circle's plane.
    float2 toward;
    // Rise by one radius.
    float steepness;
    // Distance of the chord from the centre along `toward`: at least 1 where nothing counts, at most -1 where
    // everything does.
    float offset;
    // Half the length of the chord.
    float reach;
    // Length of the cross product of the chord's middle and a radius along the chord.
    float moment;
};
#endif

#if LTC_DISK || LTC_SPHERE
// An elliptical disk over a surface: what all lobes share of the work on it.
struct LtcDisk {
    // First semi-axis over `size`; the two run counter-clockwise about the direction away from the surface.
    float3 half_x;
    // Factor on the semi-axes.
    float size;
    // Second semi-axis over `size`.
    float3 half_y;
    // Scalar product of `normal` and `centre`, not negative.
    float volume;
    // The centre from the surface point, in units of the farthest coordinate.
    float3 centre;
    // Whether the light reaches the surface at all.
    bool reaches;
    // Cross product of the semi-axes over `size`.
    float3 normal;
    // Whether the horizon cuts the disk.
    bool clipped;
    // The surface's horizon.
    LtcCut cut;
};
#endif

#if LTC_SPHERE
// A sphere over a surface.
struct LtcSphere {
    // A disk that hides the same directions.
    LtcDisk disk;
    // Whether the surface point is in the sphere.
    bool inside;
};
#endif

#if LTC_ANISOTROPIC
// The directions along which a surface is roughest and smoothest, turned so that the view has no negative
// component along either: the BRDF is symmetric under these turns.
struct LtcAnisotropy {
    // Direction of the larger alpha.
    float3 major;
    // The larger alpha.
    float alpha_major;
    // Direction of the smaller alpha.
    float3 minor;
    // The smaller alpha.
    float alpha_minor;
    // Component of the view along the major direction, 0 to 1.
    float view_major;
    // Component of the view along the minor direction, 0 to 1.
    float view_minor;
    // Alpha of the isotropic surface whose lobe is stretched.
    float alpha_round;
    // 1 where major x minor is the normal, -1 where it is the opposite.
    float handedness;
};
#endif

// What a surface is made of. Members that belong to a switched-off effect are not read.
struct LtcMaterial {
    // Reflectance of the diffuse part, 0 to 1.
    float3 base_colour;
    // Perceptual roughness of the specular part, 0 to 1.
    float roughness;
    // Specular reflectance at normal incidence (F0).
    float3 normal_reflectance;
    // Roughness of the diffuse part, from 0 for Lambert's law to 1.
    float diffuse_roughness;
    // Specular reflectance at grazing incidence (F90).
    float3 grazing_reflectance;
    // Share of the surface that a clear coat covers, 0 to 1.
    float coat;
    // Reflectance of the sheen over everything but the coat, 0 to 1.
    float3 sheen_colour;
    // Perceptual roughness of the sheen.
    float sheen_roughness;
    // Direction along the surface in which highlights are longest; need be neither unit nor quite along it.
    float3 grain;
    // Strength of the anisotropy, 0 to 1, see ltc_anisotropic_alpha.
    float anisotropy;
    // Perceptual roughness of the coat.
    float coat_roughness;
    // Reflectance of the coat at normal incidence.
    float coat_reflectance;
};

// Which layers of the table's texture array hold what; constants of the caller. Those of switched-off effects
// are not read.
struct LtcLayers {
    // The first of the layers of several lobes, see ltc_lobes_from_table.
    int lobes;
    // The layer of the sheen.
    int sheen;
    // The layer of rough diffuse parts.
    int diffuse;
    // The first of the two layers of anisotropic surfaces.
    int anisotropic;
};

// A surface point with all its lobes.
struct LtcShading {
    // The point and its frame.
    LtcSurface surface;
    // The specular lobes. An anisotropic surface has one; the others weigh nothing there.
    LtcLobes specular;
    // The coat's lobes.
    LtcLobes coat;
    // The sheen's lobe.
    LtcLobe sheen;
    // The lobe of a rough diffuse part.
    LtcLobe rough;
};

// What the parts of a surface receive of a light of unit radiance and reflect of it for a colour of 1.
struct LtcReceived {
    // The form factor.
    float diffuse;
    // The value of the rough diffuse lobe.
    float rough;
    // The specular value and Schlick's part of it.
    float2 specular;
    // The same of the coat.
    float2 coat;
    // The value of the sheen's lobe.
    float sheen;
};

#if LTC_POLYGON
// A polygon that is given vertex by vertex to a whole surface.
struct LtcShadingPolygon {
    // Its outline.
    LtcOutline outline;
    // What the specular lobes know of it.
    LtcOutlineLobes specular;
    // What the coat's lobes know of it.
    LtcOutlineLobes coat;
    // What the sheen's lobe knows of it.
    LtcOutlineLobe sheen;
    // What the rough diffuse lobe knows of it.
    LtcOutlineLobe rough;
};
#endif

// Whether surfaces are specular. Without it only the diffuse value means anything.
static const bool ltc_use_ggx = bool(LTC_GGX);

// Whether surfaces have a clear coat.
static const bool ltc_use_clearcoat = bool(LTC_CLEARCOAT);

// Whether surfaces have a sheen.
static const bool ltc_use_sheen = bool(LTC_SHEEN);

// Whether diffuse parts are rough. Without it they follow Lambert's law.
static const bool ltc_use_rough_diffuse = bool(LTC_ROUGH_DIFFUSE);

// Whether rough metals get back the light that their facets reflect more than once.
static const bool ltc_use_energy_compensation = bool(LTC_ENERGY_COMPENSATION);

// Whether the roughness of specular parts depends on the direction.
static const bool ltc_use_anisotropic = bool(LTC_ANISOTROPIC);

// Whether lights may emit from both sides. Without it `two_sided` counts as false.
static const bool ltc_use_two_sided = bool(LTC_TWO_SIDED);

// Whether tubes may have caps. Without it `caps` counts as false.
static const bool ltc_use_caps = bool(LTC_CAPS);

// Whether quads and polygons are cut at the horizons by a cheap approximation, see ltc_quad. Off unless it is asked for.
static const bool ltc_use_cheap_horizon = bool(LTC_CHEAP_HORIZON);

// Whether quads and polygons that are small for their distance are treated like any other, see ltc_quad. Off unless it
// is asked for.
static const bool ltc_use_cheap_distance = bool(LTC_CHEAP_DISTANCE);

// Whether a closed form stands in for the table of the specular lobe, see ltc_lobe_fitted. Off unless it is asked for.
static const bool ltc_use_table_free = bool(LTC_TABLE_FREE);

// Whether isotropic GGX is the sum of two lobes rather than one, see LtcLobes. Off unless it is asked for.
static const bool ltc_use_second_lobe = bool(LTC_SECOND_LOBE);

// Whether it is the sum of three; means nothing without the second lobe. Off unless it is asked for.
static const bool ltc_use_third_lobe = bool(LTC_THIRD_LOBE);

// Pi.
static const float LTC_PI = 3.1415927;

// 1 / (2 pi).
static const float LTC_OVER_TWO_PI = 0.15915494;

// Roughness below which the lobe no longer changes: alpha = 0.0004.
static const float LTC_ROUGHNESS_FLOOR = 0.02;

// How far the mean direction of a light turns towards a lobe's axis in ltc_mean_schlick.
static const float LTC_MEAN_SHIFT = 0.5;

// Smallest length by which anything is divided; a reciprocal of it is still finite.
static const float LTC_TINY = 1e-37;

// Extent of a polygon, sphere or tube together with its distance, times LTC_HEADROOM, below which it shrinks to nothing. A
// reciprocal of it times an inverse root of LTC_TINY is finite, in whichever order a compiler takes a product.
static const float LTC_SMALLEST = 1e-19;

// Smallest square by which a tube's own directions are divided: several inverse roots of it in one product are finite,
// in whichever order a compiler takes it.
static const float LTC_TUBE_TINY = 1e-20;

// Least depth of a cone, in units of the disk's distance and size together, squared. Products of its reciprocal and of inverse roots
// of it with one of LTC_TINY are finite, in whichever order a compiler takes them.
static const float LTC_SHALLOWEST = 1e-18;

// Largest product of the reciprocal distances of two points of a disk's rim, in units of its distance and size together, for the
// same reason.
static const float LTC_NEAREST_PAIR = 1e18;

// Factor on positions that leaves room for their differences, a power of two.
static const float LTC_HEADROOM = 0.0625;

// Share of the blur's variance that is missing for a direction on the horizon.
static const float LTC_LOOKUP_TILT = 0.555;

// Share that is missing for a light seen edge-on.
static const float LTC_LOOKUP_EDGE_ON = 0.7;

// How much further from the middle to look for each unit of variance: blurred images are drawn to it.
static const float LTC_LOOKUP_PUSH = 3.7;

// Least share of the longer variance in that of each sample of a pair.
static const float LTC_LOOKUP_PAIR_SHARE = 0.133;

// Distance of the two from their middle over what would restore the variance.
static const float LTC_LOOKUP_PAIR_REACH = 0.642;

// Sheen roughness below which the sheen no longer changes.
static const float LTC_SHEEN_ROUGHNESS_FLOOR = 0.1;

// Albedo to which a lobe's own is raised where energy compensation divides by it. No entry of the
// table for GGX is as small.
static const float LTC_ALBEDO_FLOOR = 0.125;

// Smallest alpha along any direction: the square of LTC_ROUGHNESS_FLOOR.
static const float LTC_ALPHA_FLOOR = 0.0004;

// Texels along each of the anisotropic table's four axes.
static const float LTC_ANISOTROPIC_SIZE = 8.0;

// Tangent of half the stretched view's angle around which the table's second axis bends.
static const float LTC_ANISOTROPIC_KNEE = 0.8;

// Largest absolute component of `v`.
float ltc_extent(float3 v)
{
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// `v` over its length, whatever that is: neither huge nor tiny vectors lose their direction.
// Zero for a zero vector.
float3 ltc_direction(float3 v)
{
    const float _e1 = ltc_extent(v);
    float3 scaled = (v * (1.0 / clamp(_e1, 1e-35, 8e37)));
    return (scaled * rsqrt(max(dot(scaled, scaled), 0.001)));
}

// Frame and roughness of a surface point. `normal` and `view` (towards the eye) need not be unit,
// but not zero. A view along the normal is as good as any other; one below the surface counts as
// a grazing one. `roughness` outside 0 to 1 is clamped.
//
// The tangent is the azimuth of the view in a basis made from the normal alone (Duff et al. 2017,
// "Building an Orthonormal Basis, Revisited"), so the frame stays orthonormal to rounding however
// close the view comes to the normal.
LtcSurface ltc_surface(float3 position, float3 normal, float3 view, float roughness)
{
    LtcSurface surface = (LtcSurface)0;

    const float3 _e4 = ltc_direction(normal);
    const float3 _e5 = ltc_direction(view);
    float side = ((_e4.z >= 0.0) ? 1.0 : -1.0);
    float p = (-1.0 / (side + _e4.z));
    float q = ((_e4.x * _e4.y) * p);
    float3 basis_x = float3((1.0 + (((side * _e4.x) * _e4.x) * p)), (side * q), (-(side) * _e4.x));
    float3 basis_y = float3(q, (side + ((_e4.y * _e4.y) * p)), -(_e4.y));
    float2 along = float2(dot(basis_x, _e5), dot(basis_y, _e5));
    float sine_squared = dot(along, along);
    float sine_inverse = rsqrt(max(sine_squared, 1e-12));
    float2 azimuth = ((sine_squared > 1e-12) ? (along * sine_inverse) : float2(1.0, 0.0));
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
    const LtcSurface ltcsurface = _e88;
    return ltcsurface;
}

#if LTC_ANISOTROPIC || (LTC_CLEARCOAT && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_SECOND_LOBE) || LTC_GGX || LTC_ROUGH_DIFFUSE || LTC_SHEEN
// Texture coordinates of a surface in a table of `table_size` by `table_size` texels: roughness
// along x, the square root of the view's cosine along y, from the first texel's centre to the last
// one's. Sample with bilinear filtering and clamping.
float2 ltc_table_coordinates(LtcSurface surface, float table_size)
{
    float root = (surface.cos_view * rsqrt(max(surface.cos_view, 1e-20)));
    return (((float2(surface.roughness, root) * (table_size - 1.0)) + (0.5).xx) / (table_size).xx);
}
#endif

#if (LTC_CLEARCOAT && !LTC_SECOND_LOBE) || LTC_GGX || LTC_SECOND_LOBE || LTC_TABLE_FREE || LTC_THIRD_LOBE
// The shape that a texel of the table describes.
//
// It holds the lobe as its deviation (X, Y, Z, W) from the mirror's lobe, in units of the lobe's width, with t the
// angle between normal and view:
//     x = cos^2 t + alpha X      z = sin t (cos t + alpha Z)
//     y = alpha sin t Y          w = alpha W
// so neither interpolation nor half precision moves a sharp highlight off its place. For
// alpha -> 0, X and Z vanish, and the rest tends to Y = -2 cos t, W = 2 cos^2 t.
LtcShape ltc_shape(LtcSurface surface, float4 texel, float albedo, float fresnel)
{
    LtcShape shape = (LtcShape)0;

    float c = surface.cos_view;
    float s = surface.sin_view;
    float a = surface.alpha;
    shape.entries = float4(((c * c) + (a * texel.x)), ((a * s) * texel.y), (s * (c + (a * texel.z))), (a * texel.w));
    shape.albedo = albedo;
    shape.fresnel = fresnel;
    LtcShape _e25 = shape;
    const LtcShape ltcshape = _e25;
    return ltcshape;
}
#endif

#if (LTC_CLEARCOAT && !LTC_SECOND_LOBE) || LTC_GGX || LTC_ROUGH_DIFFUSE || LTC_SECOND_LOBE || LTC_SHEEN || LTC_TABLE_FREE || LTC_THIRD_LOBE
// The lobe whose inverse matrix has the rows (m.x, 0, m.z), (0, 1, 0), (m.y, 0, m.w) in the surface's frame.
LtcLobe ltc_planar_lobe(LtcSurface surface, float4 m, float albedo_1, float fresnel_1)
{
    LtcLobe lobe = (LtcLobe)0;

    lobe.axis_x = ((surface.tangent * m.x) + (surface.normal * m.z));
    lobe.albedo = albedo_1;
    lobe.axis_y = surface.bitangent;
    lobe.fresnel = fresnel_1;
    lobe.axis_z = ((surface.tangent * m.y) + (surface.normal * m.w));
    lobe.share = (0.5 + ((0.5 * m.x) * rsqrt(max(((m.x * m.x) + (m.y * m.y)), LTC_TINY))));
    lobe.normal_x = ((surface.tangent * m.w) - (surface.normal * m.y));
    lobe.normal_y = (surface.bitangent * ((m.x * m.w) - (m.y * m.z)));
    lobe.normal_z = ((surface.normal * m.x) - (surface.tangent * m.z));
    lobe.frame_x = float3(m.x, 0.0, m.z);
    lobe.frame_y = float3(0.0, 1.0, 0.0);
    lobe.frame_z = float3(m.y, 0.0, m.w);
    lobe.frame_normal_x = float3(m.w, 0.0, -(m.y));
    lobe.frame_normal_y = float3(0.0, ((m.x * m.w) - (m.y * m.z)), 0.0);
    lobe.frame_normal_z = float3(-(m.z), 0.0, m.x);
    LtcLobe _e106 = lobe;
    const LtcLobe ltclobe = _e106;
    return ltclobe;
}
#endif

#if (LTC_CLEARCOAT && !LTC_SECOND_LOBE) || LTC_GGX || LTC_SECOND_LOBE || LTC_TABLE_FREE || LTC_THIRD_LOBE
// The lobe of a shape.
LtcLobe ltc_shape_lobe(LtcSurface surface, LtcShape shape)
{
    const LtcLobe _e5 = ltc_planar_lobe(surface, shape.entries, shape.albedo, shape.fresnel);
    const LtcLobe ltclobe = _e5;
    return ltclobe;
}
#endif

#if (LTC_CLEARCOAT && !LTC_SECOND_LOBE) || LTC_GGX || LTC_SECOND_LOBE || LTC_TABLE_FREE || LTC_THIRD_LOBE
// The lobe that two texels of the table describe: the shape as for ltc_shape, and the albedo and its Schlick part in x
// and y of `amplitude`.
LtcLobe ltc_lobe(LtcSurface surface, float4 shape, float4 amplitude)
{
    const LtcShape _e5 = ltc_shape(surface, shape, amplitude.x, amplitude.y);
    const LtcLobe _e6 = ltc_shape_lobe(surface, _e5);
    const LtcLobe ltclobe = _e6;
    return ltclobe;
}
#endif

#if LTC_TABLE_FREE
// The lobe of a surface by a closed form in the roughness and the cosine of the view, in place of the table.
//
// The shape is that of ltc_lobe: X, Y, Z and W vary so little that 16 coefficients are enough. On random quads the mean error
// is 3.0 % of the specular value and 4.2 % of Schlick's part, that of the table 2.1 and 4.7 %. The coefficients are the
// fit `softbox::fit::fit_lobe_formula`. The idea of a closed form for the two albedos: Lazarov 2013, "Getting More Physical
// in Call of Duty: Black Ops II"; Karis 2014, "Physically Based Shading on Mobile".
LtcLobe ltc_lobe_fitted(LtcSurface surface)
{
    float4 shape = (float4)0;

    float r = surface.roughness;
    float c = surface.cos_view;
    float a = surface.alpha;
    float c_squared = (c * c);
    float a_squared = (a * a);
    shape.x = (r * (((1.508871 + ((3.145455 - (3.884754 * r)) * r)) * r) + ((1.488739 - (2.649476 * c)) * c)));
    shape.y = ((((1.19368 * a_squared) - 0.8051475) * c) + ((0.4593228 - (0.5799547 * r)) * a));
    shape.z = (r * ((1.491276 - (1.525616 * c)) - (1.383334 * a)));
    shape.w = (((0.7461472 - (1.447918 * a_squared)) * c_squared) + (1.22383 + (0.3294481 * a)));
    float albedo = saturate((1.0 + (r * (((0.4340052 * c_squared) - 0.1695292) + (((1.536499 * r) - 2.495072) * (a * c))))));
    float beside = (1.0 - c);
    float z = (r * beside);
    float root = max((((1.00488 * beside) + (0.1454361 * r)) + ((((3.282343 - (1.25427 * z)) * z) - 2.643383) * (z * z))), 0.0);
    float root_squared = (root * root);
    float fresnel = min(((root_squared * root_squared) * root), albedo);
    float4 _e94 = shape;
    const LtcLobe _e98 = ltc_lobe(surface, _e94, float4(albedo, fresnel, 0.0, 0.0));
    const LtcLobe ltclobe = _e98;
    return ltclobe;
}
#endif

#if (LTC_CLEARCOAT && !LTC_SECOND_LOBE) || LTC_GGX
// The lobe of a surface from the table's texture array (layers 0 and 1, `table_size` texels along
// each side) and a sampler that filters linearly and clamps to the edge.
LtcLobe ltc_lobe_from_table(LtcSurface surface, Texture2DArray<float4> table, SamplerState table_sampler, float table_size)
{
#if LTC_TABLE_FREE
    if (ltc_use_table_free) {
        const LtcLobe _e5 = ltc_lobe_fitted(surface);
        const LtcLobe ltclobe_4 = _e5;
        return ltclobe_4;
    }
#endif
    const float2 _e6 = ltc_table_coordinates(surface, table_size);
    float4 shape = table.SampleLevel(table_sampler, float3(_e6, int(0)), 0.0);
    float4 amplitude = table.SampleLevel(table_sampler, float3(_e6, int(1)), 0.0);
    const LtcLobe _e13 = ltc_lobe(surface, shape, amplitude);
    const LtcLobe ltclobe_5 = _e13;
    return ltclobe_5;
}
#endif

#if (LTC_ANISOTROPIC && LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_GGX && LTC_SECOND_LOBE) || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The vector form factor, in a lobe's space, of a light all around the surface: half the sum of the normals of the two
// horizons.
float3 ltc_all_around(LtcLobe lobe)
{
    float3 horizon = float3(lobe.frame_normal_x.z, lobe.frame_normal_y.z, lobe.frame_normal_z.z);
    float3 unit = (horizon * rsqrt(max(dot(horizon, horizon), LTC_TINY)));
    return float3((0.5 * unit.xy), (0.5 + (0.5 * unit.z)));
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && LTC_POLYGON && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && LTC_QUAD && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TUBE) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_DISK && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_POLYGON && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_QUAD && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TUBE) || (LTC_CLEARCOAT && LTC_SECOND_LOBE) || (LTC_DISK && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_DISK && LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE) || (LTC_DISK && !LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_DISK && LTC_SECOND_LOBE && LTC_SHEEN) || LTC_GGX || (LTC_POLYGON && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE) || (LTC_POLYGON && !LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_POLYGON && LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_QUAD && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_QUAD && LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE) || (LTC_QUAD && !LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_QUAD && LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_TUBE) || (LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE && LTC_TUBE) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_SPHERE) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_TEXTURED) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_TUBE) || (LTC_SECOND_LOBE && LTC_SHEEN && LTC_SPHERE) || (LTC_SECOND_LOBE && LTC_SHEEN && LTC_TEXTURED) || (LTC_SECOND_LOBE && LTC_SHEEN && LTC_TUBE)
// Schlick's factor (1 - v.h)^5 for light from a direction `toward` in the lobe's space, of any length.
float ltc_schlick(LtcSurface surface, LtcLobe lobe, float3 toward)
{
    float3 turned = (float3)0;
    float along = (float)0;

    turned = (((lobe.frame_normal_x * toward.x) + (lobe.frame_normal_y * toward.y)) + (lobe.frame_normal_z * toward.z));
#if !LTC_CHEAP_DISTANCE
    if (!(ltc_use_cheap_distance)) {
        float3 _e17 = turned;
        const float3 _e18 = ltc_direction(_e17);
        turned = _e18;
    }
#endif
    float _e21 = turned.x;
    float _e25 = turned.z;
    along = ((surface.sin_view * _e21) + (surface.cos_view * _e25));
#if LTC_CHEAP_DISTANCE
    if (ltc_use_cheap_distance) {
        float _e30 = along;
        float3 _e31 = turned;
        float3 _e32 = turned;
        along = (_e30 * rsqrt(max(dot(_e31, _e32), LTC_TINY)));
    }
#endif
    float _e38 = along;
    float half_cosine = clamp((0.5 + (0.5 * _e38)), 0.0, 1.0);
    float f = max((1.0 - (half_cosine * rsqrt(max(half_cosine, 1e-20)))), 0.0);
    return ((((f * f) * f) * f) * f);
}
#endif

#if (LTC_ANISOTROPIC && LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_SECOND_LOBE) || (LTC_DISK && LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE) || (LTC_DISK && LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_GGX && LTC_SECOND_LOBE) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE) || (LTC_POLYGON && LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_QUAD && LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE) || (LTC_QUAD && LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE && LTC_TUBE) || (LTC_SECOND_LOBE && LTC_SHEEN && LTC_SPHERE) || (LTC_SECOND_LOBE && LTC_SHEEN && LTC_TEXTURED) || (LTC_SECOND_LOBE && LTC_SHEEN && LTC_TUBE)
// Schlick's factor at the mean direction of a light, from its vector form factor `toward` in a lobe's space.
//
// The vector form factor t averages directions without the lobe's cosine. For a cap around a direction d, so small
// that |t| is the square of its angle, the mean with the cosine is d cos + |t|/4 z, up to a factor: z turns in by
// |t|^2/(4 cos) beside t. The cosine is left out, and LTC_MEAN_SHIFT is not the derived factor but the round number that
// did best of a few on random quads.
float ltc_mean_schlick(LtcSurface surface, LtcLobe lobe, float3 toward)
{
    const float _e10 = ltc_schlick(surface, lobe, float3(toward.xy, (toward.z + (LTC_MEAN_SHIFT * dot(toward, toward)))));
    return _e10;
}
#endif

#if LTC_ANISOTROPIC || (LTC_CLEARCOAT && !LTC_SECOND_LOBE) || LTC_GGX
// A sum of one lobe, whatever the switches say.
LtcLobes ltc_lobes_of(LtcSurface surface, LtcLobe lobe)
{
    LtcLobes lobes = (LtcLobes)0;

    lobes.first = lobe;
    lobes.count = int(1);
#if LTC_SECOND_LOBE
    if (ltc_use_second_lobe) {
        const float3 _e11 = ltc_all_around(lobe);
        const float _e12 = ltc_mean_schlick(surface, lobe, _e11);
        lobes.first.fresnel = (lobe.fresnel - (lobe.albedo * _e12));
    }
#endif
    LtcLobes _e15 = lobes;
    const LtcLobes ltclobes = _e15;
    return ltclobes;
}
#endif

#if LTC_SECOND_LOBE
// The sum of two lobes that three texels of the table describe: the shapes of the two, as in ltc_lobe, and (albedo of the
// first, of the second, excess of the first, of the second); see ltc_lobes_part.
LtcLobes ltc_two_lobes(LtcSurface surface, float4 first, float4 second, float4 weights)
{
    LtcLobes lobes = (LtcLobes)0;

    const LtcLobe _e7 = ltc_lobe(surface, first, weights.xzxz);
    lobes.first = _e7;
    const LtcShape _e11 = ltc_shape(surface, second, weights.y, weights.w);
    lobes.second = _e11;
    lobes.count = int(2);
    LtcLobes _e14 = lobes;
    const LtcLobes ltclobes = _e14;
    return ltclobes;
}
#endif

#if LTC_THIRD_LOBE
// The sum of three lobes that five texels of the table describe: their shapes, their albedos, and their excesses;
// see ltc_lobes_part.
LtcLobes ltc_three_lobes(LtcSurface surface, float4 first_1, float4 second_1, float4 third, float4 albedos, float4 excesses)
{
    LtcLobes lobes = (LtcLobes)0;

    const LtcLobe _e13 = ltc_lobe(surface, first_1, float4(albedos.x, excesses.x, 0.0, 0.0));
    lobes.first = _e13;
    const LtcShape _e17 = ltc_shape(surface, second_1, albedos.y, excesses.y);
    lobes.second = _e17;
    const LtcShape _e21 = ltc_shape(surface, third, albedos.z, excesses.z);
    lobes.third = _e21;
    lobes.count = int(3);
    LtcLobes _e24 = lobes;
    const LtcLobes ltclobes = _e24;
    return ltclobes;
}
#endif

#if LTC_CLEARCOAT || LTC_GGX
// The lobes of a surface, as many as the switches say, from the table's texture array and a sampler that filters linearly
// and clamps to the edge. A single lobe is that of layers 0 and 1; of two lobes the three texels of ltc_two_lobes lie in
// the layers from `layer` on, of three lobes the five of ltc_three_lobes.
LtcLobes ltc_lobes_from_table(LtcSurface surface, Texture2DArray<float4> table, SamplerState table_sampler, float table_size, int layer)
{
    LtcLobes lobes = (LtcLobes)0;

#if !LTC_SECOND_LOBE
    if (!(ltc_use_second_lobe)) {
        const LtcLobe _e8 = ltc_lobe_from_table(surface, table, table_sampler, table_size);
        const LtcLobes _e9 = ltc_lobes_of(surface, _e8);
        lobes = _e9;
    }
#endif
#if LTC_SECOND_LOBE
    if (ltc_use_second_lobe) {
        const float2 _e11 = ltc_table_coordinates(surface, table_size);
        float4 first = table.SampleLevel(table_sampler, float3(_e11, layer), 0.0);
        float4 second = table.SampleLevel(table_sampler, float3(_e11, asint(asuint(layer) + asuint(int(1)))), 0.0);
        float4 next = table.SampleLevel(table_sampler, float3(_e11, asint(asuint(layer) + asuint(int(2)))), 0.0);
#if !LTC_THIRD_LOBE
        if (!(ltc_use_third_lobe)) {
            const LtcLobes _e24 = ltc_two_lobes(surface, first, second, next);
            lobes = _e24;
        }
#endif
#if LTC_THIRD_LOBE
        if (ltc_use_third_lobe) {
            float4 albedos = table.SampleLevel(table_sampler, float3(_e11, asint(asuint(layer) + asuint(int(3)))), 0.0);
            float4 excesses = table.SampleLevel(table_sampler, float3(_e11, asint(asuint(layer) + asuint(int(4)))), 0.0);
            const LtcLobes _e34 = ltc_three_lobes(surface, first, second, next, albedos, excesses);
            lobes = _e34;
        }
#endif
    }
#endif
    LtcLobes _e35 = lobes;
    const LtcLobes ltclobes = _e35;
    return ltclobes;
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && LTC_POLYGON && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && LTC_QUAD && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TUBE) || (LTC_CLEARCOAT && LTC_DISK && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_POLYGON && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_QUAD && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_SECOND_LOBE) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TUBE) || (LTC_DISK && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_DISK && !LTC_SECOND_LOBE && LTC_SHEEN) || LTC_GGX || (LTC_POLYGON && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_POLYGON && !LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_QUAD && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_QUAD && !LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_TUBE) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_SPHERE) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_TEXTURED) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_TUBE)
// The parts (specular, fresnel) of a light's value, from the `coverage` of a lobe, the share of
// its energy that the light covers, and the mean direction `toward` the light in the lobe's space.
//
// A lobe's shape is fitted to the whole BRDF. Schlick's part has another shape, and knows it from
// the direction: for a small light it is (1 - v.h)^5 of the specular part, v.h taken at the light;
// for a light that covers the whole lobe it is the table's average. The square of the coverage
// leads from one to the other.
float2 ltc_specular(LtcSurface surface, LtcLobe lobe, float coverage, float3 toward)
{
    const float _e4 = ltc_schlick(surface, lobe, toward);
    float whole = (coverage * coverage);
    return (coverage * float2(lobe.albedo, (((lobe.albedo * _e4) * (1.0 - whole)) + (lobe.fresnel * whole))));
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && LTC_POLYGON && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && LTC_QUAD && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TUBE) || (LTC_CLEARCOAT && LTC_DISK && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_POLYGON && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_QUAD && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_SECOND_LOBE) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TUBE) || (LTC_DISK && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_DISK && !LTC_SECOND_LOBE && LTC_SHEEN) || LTC_GGX || (LTC_POLYGON && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_POLYGON && !LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_QUAD && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_QUAD && !LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_TUBE) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_SPHERE) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_TEXTURED) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_TUBE)
// The parts (specular, fresnel) of a lobe from the vector form factor in its space.
float2 ltc_lobe_value(LtcSurface surface, LtcLobe lobe, float3 toward)
{
    const float2 _e9 = ltc_specular(surface, lobe, clamp((toward.z / lobe.share), 0.0, 1.0), toward);
    return _e9;
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && LTC_DISK && LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && LTC_POLYGON) || (LTC_ANISOTROPIC && LTC_QUAD && !LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && LTC_QUAD && LTC_SECOND_LOBE) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TUBE) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TUBE) || (LTC_CLEARCOAT && LTC_DISK && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && LTC_POLYGON) || (LTC_CLEARCOAT && LTC_QUAD && !LTC_SECOND_LOBE) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TUBE) || (LTC_CLEARCOAT && LTC_SECOND_LOBE) || (LTC_DISK && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_DISK && LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE) || (LTC_DISK && !LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_DISK && LTC_SECOND_LOBE && LTC_SHEEN) || LTC_GGX || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN) || (LTC_QUAD && LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE) || (LTC_QUAD && LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE) || (LTC_QUAD && !LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_QUAD && LTC_SECOND_LOBE && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_TUBE) || (LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE && LTC_TUBE) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_SPHERE) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_TEXTURED) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_TUBE) || (LTC_SECOND_LOBE && LTC_SHEEN && LTC_SPHERE) || (LTC_SECOND_LOBE && LTC_SHEEN && LTC_TEXTURED) || (LTC_SECOND_LOBE && LTC_SHEEN && LTC_TUBE)
// The parts (specular, fresnel) of one lobe of a sum from the vector form factor in its space.
//
// A single lobe is as in ltc_specular. In a sum Schlick's factor is that of the mean direction of the light. What a light
// all around gets beyond that, the lobe's `fresnel` holds as an excess of either sign; it comes in with the variance of
// the factor over the light, for which the square of the coverage stands.
float2 ltc_lobes_part(LtcSurface surface, LtcLobe lobe, float3 toward)
{
    float2 value = (0.0).xx;

#if !LTC_SECOND_LOBE
    if (!(ltc_use_second_lobe)) {
        const float2 _e8 = ltc_lobe_value(surface, lobe, toward);
        value = _e8;
    }
#endif
#if LTC_SECOND_LOBE
    if (ltc_use_second_lobe) {
        float coverage = clamp((toward.z / lobe.share), 0.0, 1.0);
        const float _e17 = ltc_mean_schlick(surface, lobe, toward);
        float schlick = ((lobe.albedo * _e17) + (lobe.fresnel * (coverage * coverage)));
        value = (coverage * float2(lobe.albedo, clamp(schlick, 0.0, lobe.albedo)));
    }
#endif
    float2 _e29 = value;
    return _e29;
}
#endif

#if LTC_CLEARCOAT || LTC_GGX
// The first lobe with the albedo and the Schlick part of all: for functions that ask how much a surface reflects, not where.
LtcLobe ltc_lobes_together(LtcSurface surface, LtcLobes lobes)
{
    LtcLobe together = (LtcLobe)0;
    float2 sum = (float2)0;

    together = lobes.first;
#if LTC_SECOND_LOBE
    if (ltc_use_second_lobe) {
        const float3 _e7 = ltc_all_around(lobes.first);
        const float2 _e8 = ltc_lobes_part(surface, lobes.first, _e7);
        sum = _e8;
        if ((lobes.count > int(1))) {
            const LtcLobe _e14 = ltc_shape_lobe(surface, lobes.second);
            float2 _e15 = sum;
            const float3 _e16 = ltc_all_around(_e14);
            const float2 _e17 = ltc_lobes_part(surface, _e14, _e16);
            sum = (_e15 + _e17);
        }
#if LTC_THIRD_LOBE
        if ((ltc_use_third_lobe & (lobes.count > int(2)))) {
            const LtcLobe _e25 = ltc_shape_lobe(surface, lobes.third);
            float2 _e26 = sum;
            const float3 _e27 = ltc_all_around(_e25);
            const float2 _e28 = ltc_lobes_part(surface, _e25, _e27);
            sum = (_e26 + _e28);
        }
#endif
        float _e32 = sum.x;
        together.albedo = _e32;
        float _e35 = sum.y;
        together.fresnel = _e35;
    }
#endif
    LtcLobe _e36 = together;
    const LtcLobe ltclobe = _e36;
    return ltclobe;
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_ANISOTROPIC && LTC_POLYGON) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_ANISOTROPIC && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_TUBE) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_CLEARCOAT && LTC_POLYGON) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_TUBE) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_GGX && LTC_POLYGON) || (LTC_GGX && LTC_SPHERE) || (LTC_GGX && LTC_TEXTURED) || (LTC_GGX && LTC_TUBE) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && LTC_TUBE) || (LTC_SHEEN && LTC_SPHERE) || (LTC_SHEEN && LTC_TEXTURED) || (LTC_SHEEN && LTC_TUBE)
// `v`, a vector from the surface point, in the lobe's space.
float3 ltc_transform(LtcLobe lobe, float3 v)
{
    return float3(dot(lobe.axis_x, v), dot(lobe.axis_y, v), dot(lobe.axis_z, v));
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_ANISOTROPIC && LTC_POLYGON) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_ANISOTROPIC && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_TUBE) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_CLEARCOAT && LTC_POLYGON) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_TUBE) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_GGX && LTC_POLYGON) || (LTC_GGX && LTC_SPHERE) || (LTC_GGX && LTC_TEXTURED) || (LTC_GGX && LTC_TUBE) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && LTC_TUBE) || (LTC_SHEEN && LTC_SPHERE) || (LTC_SHEEN && LTC_TEXTURED) || (LTC_SHEEN && LTC_TUBE)
// The cross product of two vectors from the surface point, in the lobe's space: what it is the cross
// product of there. Unlike that of the transformed vectors it keeps the digits of an edge that passes
// the surface point closely.
float3 ltc_transform_normal(LtcLobe lobe, float3 v)
{
    return float3(dot(lobe.normal_x, v), dot(lobe.normal_y, v), dot(lobe.normal_z, v));
}
#endif

#if LTC_ANISOTROPIC || LTC_QUAD || LTC_TEXTURED
// `v` in the surface's frame: its parts along tangent, bitangent and normal.
float3 ltc_in_frame(LtcSurface surface, float3 v)
{
    return float3(dot(surface.tangent, v), dot(surface.bitangent, v), dot(surface.normal, v));
}
#endif

#if LTC_ANISOTROPIC
// A lobe whose rows are given for the caller's space only, with those for the surface's frame.
LtcLobe ltc_framed_lobe(LtcSurface surface, LtcLobe lobe)
{
    LtcLobe framed = (LtcLobe)0;

    framed = lobe;
    const float3 _e5 = ltc_in_frame(surface, lobe.axis_x);
    framed.frame_x = _e5;
    const float3 _e8 = ltc_in_frame(surface, lobe.axis_y);
    framed.frame_y = _e8;
    const float3 _e11 = ltc_in_frame(surface, lobe.axis_z);
    framed.frame_z = _e11;
    const float3 _e14 = ltc_in_frame(surface, lobe.normal_x);
    framed.frame_normal_x = _e14;
    const float3 _e17 = ltc_in_frame(surface, lobe.normal_y);
    framed.frame_normal_y = _e17;
    const float3 _e20 = ltc_in_frame(surface, lobe.normal_z);
    framed.frame_normal_z = _e20;
    LtcLobe _e21 = framed;
    const LtcLobe ltclobe = _e21;
    return ltclobe;
}
#endif

#if (LTC_ANISOTROPIC && LTC_QUAD) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_QUAD) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_QUAD) || (LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// ltc_transform for a vector in the surface's frame.
float3 ltc_transform_framed(LtcLobe lobe, float3 v)
{
    return float3(dot(lobe.frame_x, v), dot(lobe.frame_y, v), dot(lobe.frame_z, v));
}
#endif

#if (LTC_ANISOTROPIC && LTC_QUAD) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_QUAD) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_QUAD) || (LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// ltc_transform_normal for a vector in the surface's frame.
float3 ltc_transform_framed_normal(LtcLobe lobe, float3 v)
{
    return float3(dot(lobe.frame_normal_x, v), dot(lobe.frame_normal_y, v), dot(lobe.frame_normal_z, v));
}
#endif

#if LTC_GGX
// Reflected radiance of a specular surface with reflectance `normal_reflectance` (F0) at normal and
// `grazing_reflectance` (F90) at grazing incidence, from the value (diffuse, specular, fresnel) of a
// light of unit radiance (Schlick 1994).
float3 ltc_reflectance(float3 value, float3 normal_reflectance, float3 grazing_reflectance)
{
    return ((normal_reflectance * (value.y - value.z)) + (grazing_reflectance * value.z));
}
#endif

#if LTC_POLYGON || LTC_QUAD || LTC_TEXTURED
// The form factor of the light that arrives, from a signed one; `front` tells whether the light shows its
// emitting side. A two-sided light is lit by the sign that the sum itself has: `front` may differ from it by
// rounding where the light is seen edge-on.
float ltc_received(float form_factor, bool front, bool two_sided)
{
    bool both_sides = (two_sided & ltc_use_two_sided);
    float received = (both_sides ? abs(form_factor) : form_factor);
    return ((front | both_sides) ? clamp(received, 0.0, 1.0) : 0.0);
}
#endif

#if (LTC_ANISOTROPIC && LTC_POLYGON) || (LTC_ANISOTROPIC && LTC_QUAD) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_POLYGON) || (LTC_CLEARCOAT && LTC_QUAD) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_POLYGON) || (LTC_GGX && LTC_QUAD) || (LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// ltc_received for a vector form factor, whose sign is that of its z.
float3 ltc_received_vector(float3 form_factor, bool front, bool two_sided)
{
    bool both_sides = (two_sided & ltc_use_two_sided);
    float3 received = ((both_sides & (form_factor.z < 0.0)) ? -(form_factor) : form_factor);
    return ((front | both_sides) ? received : (0.0).xxx);
}
#endif

#if LTC_DISK || LTC_POLYGON || LTC_QUAD || LTC_SPHERE || LTC_TEXTURED || LTC_TUBE
// (t / sin t) - 1 for an angle t of at most pi/2, from k = 1 - cos t. The relative error of
// t / sin t is below 2e-7. The coefficients are the minimax fit `softbox::fit::fit_angle_excess`
// of degree 7; no built-in inverse function of WGSL is guaranteed to be as close.
float ltc_angle_excess(float k)
{
    float high = ((((((0.01714316 * k) - 0.041149218) * k) + 0.058181286) * k) - 0.022927942);
    float low = (((((0.03800492 + (high * k)) * k) + 0.054650154) * k) + 0.13356799);
    return (((low * k) + 0.33332586) * k);
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_GGX && LTC_SPHERE) || LTC_POLYGON || LTC_QUAD || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE) || LTC_TEXTURED
// The shorter of two vectors.
float3 ltc_shorter(float3 a, float3 b)
{
    return ((dot(b, b) < dot(a, a)) ? b : a);
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_GGX && LTC_SPHERE) || LTC_POLYGON || LTC_QUAD || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE) || LTC_TEXTURED
// The cross product a x b of two vectors whose difference b - a is `side`. That with the shorter of the
// two has the fewest digits to lose.
float3 ltc_edge_normal(float3 a, float3 b, float3 side)
{
    const float3 _e3 = ltc_shorter(a, b);
    return cross(_e3, side);
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_GGX && LTC_SPHERE) || LTC_POLYGON || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The angle between the unit vectors `a` and `b`, whose sine is given.
float ltc_angle(float3 a, float3 b, float sine)
{
    float3 chord = (b - a);
    float k = (0.5 * dot(chord, chord));
    float bounded = min(sine, 1.0);
    const float _e13 = ltc_angle_excess(min(k, saturate((2.0 - k))));
    float acute = (bounded + (bounded * _e13));
    return ((k > 1.0) ? (LTC_PI - acute) : acute);
}
#endif

#if LTC_POLYGON
// The edge integral of the segment between the directions `a` and `b`: the angle between these unit vectors along
// the unit normal of their plane, for which `normal` has the right direction.
float3 ltc_edge_part(float3 a, float3 b, float3 normal)
{
    float3 product = cross(a, (b - a));
    float squared = dot(product, product);
    float inverse_length = rsqrt(max(dot(normal, normal), LTC_TINY));
    const float _e14 = ltc_angle(a, b, (squared * rsqrt(max(squared, 1e-30))));
    return (normal * (inverse_length * _e14));
}
#endif

#if LTC_POLYGON
// The edge integral of a short edge from the unit vector `a` along `chord`, less the cross product of its ends.
float3 ltc_edge_excess(float3 a, float3 chord)
{
    const float _e8 = ltc_angle_excess(min((0.5 * dot(chord, chord)), 1.0));
    return (cross(a, chord) * _e8);
}
#endif

#if LTC_POLYGON
// ltc_edge_about for offsets that are both shorter than a quarter.
float3 ltc_edge_near(float3 reference, float3 a, float3 a_offset, float3 b_offset)
{
    float along = dot(reference, cross(a_offset, b_offset));
    float3 across = (0.5 * ((a_offset * dot(b_offset, b_offset)) - (b_offset * dot(a_offset, a_offset))));
    const float3 _e17 = ltc_edge_excess(a, (b_offset - a_offset));
    return (((reference * along) + cross(reference, across)) + _e17);
}
#endif

#if LTC_POLYGON
// The edge integral of the unit vectors `a` and `b`, less a part that vanishes over every closed
// polygon. The offsets are a - reference and b - reference; `normal` has the direction of a x b.
//
// Over a closed polygon the cross products of neighbours add up to those of their offsets from any
// fixed vector. Offsets of a distant light are known to full relative precision, see ltc_offset,
// so its form factor is too, where a sum over edges has lost its digits: its terms are of the
// order of the light's angular size, its sum of that size squared. A unit vector's offset along the
// unit reference is -offset^2 / 2 exactly; with that the sum stays precise for a light on the
// horizon as well. Exact for polygons of every size.
float3 ltc_edge_about(float3 reference, float3 a, float3 a_offset, float3 b, float3 b_offset, float3 normal)
{
    const float3 _e6 = ltc_edge_near(reference, a, a_offset, b_offset);
    if ((max(dot(a_offset, a_offset), dot(b_offset, b_offset)) < 0.0625)) {
        return _e6;
    }
    const float3 _e13 = ltc_edge_excess(a, (b_offset - a_offset));
    const float3 _e15 = ltc_edge_part(a, b, normal);
    return (((_e6 - _e13) + _e15) - cross(a, (b - a)));
}
#endif

#if LTC_POLYGON
// Difference of the directions of `target_point` and `origin`, which differ by `offset`, with the
// relative precision of `offset`: the two unit vectors themselves differ by rounding alone when the
// points are close. `reference` is the direction of `origin`.
float3 ltc_offset(float3 origin, float3 reference, float3 target_point, float3 offset)
{
    float inverse_length = rsqrt(max(dot(target_point, target_point), 1e-22));
    float length_sum = ((dot(target_point, target_point) * inverse_length) + dot(origin, reference));
    float length_difference = (dot(offset, (origin + target_point)) / max(length_sum, LTC_TINY));
    float3 near = ((offset - (reference * length_difference)) * inverse_length);
    float3 far = ((target_point * inverse_length) - reference);
    return ((dot(offset, offset) < (0.0625 * dot(origin, origin))) ? near : far);
}
#endif

#if (LTC_ANISOTROPIC && LTC_POLYGON) || (LTC_CLEARCOAT && LTC_POLYGON) || (LTC_GGX && LTC_POLYGON) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN)
// Where the segment from `above` the plane z = 0 to `below` it meets that plane; only the direction of that
// where it passes the surface point closely. `normal` has the direction of above x below; `exact` tells that it does not come
// from these points and their rounding.
float3 ltc_crossing(float3 above, float3 below, float3 normal, bool exact)
{
    float high = max(above.z, 0.0);
    float t = (high / max((high - min(below.z, 0.0)), LTC_TINY));
    float3 between = float3((above.xy + ((below.xy - above.xy) * t)), 0.0);
    float above_square = dot(above, above);
    float below_square = dot(below, below);
    bool cancels = (dot(between, between) < (1e-6 * max(above_square, below_square)));
    float3 turned = float3(normal.y, -(normal.x), 0.0);
    float turned_square = dot(turned, turned);
    float normal_square = dot(normal, normal);
    float normal_inverse = rsqrt(max(normal_square, LTC_TINY));
    float rounding = (exact ? normal_inverse : (rsqrt(max(above_square, LTC_TINY)) * rsqrt(max(below_square, LTC_TINY))));
    bool tilted = ((turned_square * rounding) > ((2e-7 * normal_square) * normal_inverse));
    return ((cancels & tilted) ? (turned * rsqrt(max(turned_square, LTC_TINY))) : between);
}
#endif

#if LTC_SPHERE
// The form factor of what a horizon leaves of a round light: `size` is the sine of its half-angle, `tilt` the cosine between
// its direction and the horizon's normal, `offset` the cosine of half the arc of its rim that is above, less for more,
// and `reach` the sine (Snyder 1996, "Area Light Sources for Real-Time Graphics", in another form).
float ltc_cap(float size, float tilt, float offset, float reach)
{
    float half_chord = (size * reach);
    float k = ((2.0 * half_chord) * half_chord);
    float under = max((1.0 - (half_chord * half_chord)), 0.0);
    float sine = ((2.0 * half_chord) * (under * rsqrt(max(under, LTC_TINY))));
    const float _e23 = ltc_angle_excess(min(k, (2.0 - k)));
    float excess = (sine * _e23);
    float rest = ((k > 1.0) ? ((LTC_PI - (2.0 * sine)) - excess) : excess);
    float around_k = ((2.0 * reach) * reach);
    float lesser = ((2.0 * reach) * abs(offset));
    const float _e45 = ltc_angle_excess(max(min(around_k, (2.0 - around_k)), 0.0));
    float acute = (lesser + (lesser * _e45));
    float part = ((around_k > 1.0) ? (LTC_PI - acute) : acute);
    float angle = ((tilt < 0.0) ? part : (6.2831855 - part));
    return ((rest + (tilt * ((sine * tilt) + ((size * size) * angle)))) * LTC_OVER_TWO_PI);
}
#endif

#if LTC_QUAD || LTC_TEXTURED
// (t / sin t) `scale` for the angle t whose cosine is given, if that is acute; otherwise that of pi - t, see ltc_edge_turn.
float ltc_edge_weight(float cosine, float scale)
{
    const float _e6 = ltc_angle_excess(saturate((1.0 - abs(cosine))));
    return (scale + (scale * _e6));
}
#endif

#if LTC_QUAD || LTC_TEXTURED
// What the `weight` from ltc_edge_weight lacks if the angle is obtuse: t / sin t is pi / sin t less that of pi - t, and the
// length of `normal` is that sine over the scale. It comes from ltc_edge_normal, which keeps the distance at which an
// edge passes the surface point.
float ltc_edge_turn(float cosine, float weight, float3 normal)
{
    return ((cosine < 0.0) ? ((LTC_PI * rsqrt(max(dot(normal, normal), LTC_TINY))) - (2.0 * weight)) : 0.0);
}
#endif

#if LTC_QUAD || LTC_TEXTURED
// 1 over the length of a point `v`, at most 1e15: the product of two of them, times what rounding leaves of a cross product that
// vanishes, has a square in range.
float ltc_inverse_length(float3 v)
{
    return rsqrt(max(dot(v, v), 1e-30));
}
#endif

#if LTC_QUAD || LTC_TEXTURED
// Vector form factor, times 2 pi and signed, of a quad, or of a pentagon with `five`; without it `e` is `d`. Each
// normal is the cross product of the vertex of its name and the next one, and each edge's integral is the angle t
// that it subtends along the unit vector of its normal (Lambert; Baum et al. 1989). Where that angle is acute
// it is t / sin t times the normal over the lengths of both vertices. Where it is not, that sine has no digits left
// for an edge that subtends nearly 180 degrees, which is every edge of a light that touches the surface: there the
// normal's own length takes its place.
float3 ltc_edges(float3 a, float3 b, float3 c, float3 d, float3 e, float3 a_normal, float3 b_normal, float3 c_normal, float3 d_normal, float3 e_normal, bool five)
{
    float e_inverse = (float)0;
    float d_cosine = 1.0;
    float d_weight = 0.0;
    float a_weight = (float)0;
    float b_weight = (float)0;
    float c_weight = (float)0;
    float e_weight = (float)0;

    const float _e11 = ltc_inverse_length(a);
    const float _e12 = ltc_inverse_length(b);
    const float _e13 = ltc_inverse_length(c);
    const float _e14 = ltc_inverse_length(d);
    e_inverse = _e14;
    if (five) {
        const float _e20 = ltc_inverse_length(e);
        e_inverse = _e20;
        float _e21 = e_inverse;
        float d_scale = (_e14 * _e21);
        d_cosine = (dot(d, e) * d_scale);
        float _e25 = d_cosine;
        const float _e26 = ltc_edge_weight(_e25, d_scale);
        d_weight = _e26;
    }
    float a_scale = (_e11 * _e12);
    float b_scale = (_e12 * _e13);
    float c_scale = (_e13 * _e14);
    float _e30 = e_inverse;
    float e_scale = (_e30 * _e11);
    float a_cosine = (dot(a, b) * a_scale);
    float b_cosine = (dot(b, c) * b_scale);
    float c_cosine = (dot(c, d) * c_scale);
    float e_cosine = (dot(e, a) * e_scale);
    const float _e40 = ltc_edge_weight(a_cosine, a_scale);
    a_weight = _e40;
    const float _e42 = ltc_edge_weight(b_cosine, b_scale);
    b_weight = _e42;
    const float _e44 = ltc_edge_weight(c_cosine, c_scale);
    c_weight = _e44;
    const float _e46 = ltc_edge_weight(e_cosine, e_scale);
    e_weight = _e46;
    float _e49 = d_cosine;
    bool obtuse = (min(min(min(a_cosine, b_cosine), min(c_cosine, _e49)), e_cosine) < 0.0);
    if (obtuse) {
        float _e55 = a_weight;
        float _e56 = a_weight;
        const float _e57 = ltc_edge_turn(a_cosine, _e56, a_normal);
        a_weight = (_e55 + _e57);
        float _e59 = b_weight;
        float _e60 = b_weight;
        const float _e61 = ltc_edge_turn(b_cosine, _e60, b_normal);
        b_weight = (_e59 + _e61);
        float _e63 = c_weight;
        float _e64 = c_weight;
        const float _e65 = ltc_edge_turn(c_cosine, _e64, c_normal);
        c_weight = (_e63 + _e65);
        float _e67 = d_weight;
        float _e68 = d_cosine;
        float _e69 = d_weight;
        const float _e70 = ltc_edge_turn(_e68, _e69, d_normal);
        d_weight = (_e67 + _e70);
        float _e72 = e_weight;
        float _e73 = e_weight;
        const float _e74 = ltc_edge_turn(e_cosine, _e73, e_normal);
        e_weight = (_e72 + _e74);
    }
    float _e76 = a_weight;
    float _e78 = b_weight;
    float _e81 = c_weight;
    float _e84 = d_weight;
    float _e87 = e_weight;
    return -((((((a_normal * _e76) + (b_normal * _e78)) + (c_normal * _e81)) + (d_normal * _e84)) + (e_normal * _e87)));
}
#endif

#if (LTC_ANISOTROPIC && LTC_QUAD) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_QUAD) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_QUAD) || (LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// Where the edge from `above` the plane z = 0 to `below` it meets that plane: `turned`, which is what the plane of the edge
// says, or for an edge that is nearly parallel to the horizon what its ends say, if that has more digits: those cancel
// where the edge passes the surface point closely. `tilt` is the squared sine between that plane and the horizon; `rise` is
// the height of the plane's normal, whose sign is that of the turn from `above` to `below`: a crossing that does not lie on
// that turn would put the light on the other side of the point.
float2 ltc_flat_crossing(float3 above, float3 below, float tilt, float rise, float2 turned)
{
    float t = (max(above.z, 0.0) / max((above.z - below.z), LTC_TINY));
    float2 between = (above.xy + ((below.xy - above.xy) * t));
    float squared = dot(between, between);
    bool after = ((((above.x * turned.y) - (above.y * turned.x)) * rise) >= 0.0);
    bool before = ((((turned.x * below.y) - (turned.y * below.x)) * rise) >= 0.0);
    bool resolved = ((tilt * max(dot(above, above), dot(below, below))) > squared);
    bool tilted = ((tilt > 0.001) | ((resolved & after) & before));
    return (tilted ? turned : (between * rsqrt(max(squared, LTC_TINY))));
}
#endif

#if (LTC_ANISOTROPIC && LTC_QUAD) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_QUAD) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_QUAD) || (LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// Cross product of the ends of a part of an edge, unit vectors, and the cosine between them.
float4 ltc_part(float3 start, float3 end)
{
    return float4(cross(start, (end - start)), dot(start, end));
}
#endif

#if (LTC_ANISOTROPIC && LTC_QUAD) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_QUAD) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_QUAD) || (LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// What a part from ltc_part times its weight lacks if the angle is obtuse; see ltc_edge_turn.
float3 ltc_part_turn(float4 part, float weight, float3 normal, bool present)
{
    return ((present & (part.w < 0.0)) ? ((normal * (LTC_PI * rsqrt(max(dot(normal, normal), LTC_TINY)))) - (part.xyz * (2.0 * weight))) : (0.0).xxx);
}
#endif

#if (LTC_ANISOTROPIC && LTC_QUAD) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_QUAD) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_QUAD) || (LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// The sine of the elevation down to which a vertex counts as above the lobe's horizon. Where that horizon is the
// surface's, as it is seen along the normal, rounding would scatter the points of a light cut there to both
// sides. The lobe's space squeezes heights by the length of its third axis.
float ltc_horizon(LtcLobe lobe)
{
    const float _e2 = ltc_extent(lobe.frame_z);
    return (-1e-6 * min(_e2, 1.0));
}
#endif

#if (LTC_ANISOTROPIC && LTC_QUAD) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_QUAD) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_QUAD) || (LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// Vector form factor, times 2 pi and signed, of a convex pentagon in the lobe's space, cut at the lobe's
// horizon z = 0. Each normal is the cross product of the vertex of its name and the
// next one. Repeated vertices make it any smaller polygon; `five` tells whether `d` and `e` differ. A vertex counts as
// above the horizon if the sine of its elevation is larger than `horizon`, which is ltc_horizon.
float3 ltc_pentagon(float3 a, float3 b, float3 c, float3 d, float3 e, float3 a_normal, float3 b_normal, float3 c_normal, float3 d_normal, float3 e_normal, bool five, float horizon)
{
    float e_height = (float)0;
    float2 leave_xy = (float2)0;
    float2 enter_xy = (float2)0;
    float3 sum = (float3)0;

    const float _e13 = ltc_inverse_length(a);
    float a_height = (a.z * _e13);
    const float _e16 = ltc_inverse_length(b);
    float b_height = (b.z * _e16);
    const float _e19 = ltc_inverse_length(c);
    float c_height = (c.z * _e19);
    const float _e22 = ltc_inverse_length(d);
    float d_height = (d.z * _e22);
    e_height = d_height;
    if (five) {
        const float _e26 = ltc_inverse_length(e);
        e_height = (e.z * _e26);
    }
    float _e31 = e_height;
    float highest = max(max(max(a_height, b_height), max(c_height, d_height)), _e31);
    if ((highest <= horizon)) {
        return (0.0).xxx;
    }
    float _e39 = e_height;
    float lowest = min(min(min(a_height, b_height), min(c_height, d_height)), _e39);
    if ((lowest > horizon)) {
        const float3 _e42 = ltc_edges(a, b, c, d, e, a_normal, b_normal, c_normal, d_normal, e_normal, five);
        return _e42;
    }
    bool a_up = (a_height > horizon);
    bool b_up = (b_height > horizon);
    bool c_up = (c_height > horizon);
    bool d_up = (d_height > horizon);
    float _e47 = e_height;
    bool e_up = (_e47 > horizon);
    bool leave_b = (b_up & !(c_up));
    bool leave_c = (c_up & !(d_up));
    bool leave_d = (d_up & !(e_up));
    bool leave_e = (e_up & !(a_up));
    bool enter_b = (b_up & !(a_up));
    bool enter_c = (c_up & !(b_up));
    bool enter_d = (d_up & !(c_up));
    bool enter_e = (e_up & !(d_up));
    float3 leave_normal = (leave_e ? e_normal : (leave_d ? d_normal : (leave_c ? c_normal : (leave_b ? b_normal : a_normal))));
    float3 enter_normal = (enter_e ? d_normal : (enter_d ? c_normal : (enter_c ? b_normal : (enter_b ? a_normal : e_normal))));
    float leave_squared = dot(leave_normal.xy, leave_normal.xy);
    float enter_squared = dot(enter_normal.xy, enter_normal.xy);
    leave_xy = (float2(leave_normal.y, -(leave_normal.x)) * rsqrt(max(leave_squared, LTC_TINY)));
    enter_xy = (float2(-(enter_normal.y), enter_normal.x) * rsqrt(max(enter_squared, LTC_TINY)));
    float leave_tilt = (leave_squared / max(dot(leave_normal, leave_normal), LTC_TINY));
    float enter_tilt = (enter_squared / max(dot(enter_normal, enter_normal), LTC_TINY));
    bool flat_edge = (min(leave_tilt, enter_tilt) <= 0.001);
    if (flat_edge) {
        float3 leave_from = (leave_e ? e : (leave_d ? d : (leave_c ? c : (leave_b ? b : a))));
        float3 leave_to = (leave_e ? a : (leave_d ? e : (leave_c ? d : (leave_b ? c : b))));
        float3 enter_to = (enter_e ? e : (enter_d ? d : (enter_c ? c : (enter_b ? b : a))));
        float3 enter_from = (enter_e ? d : (enter_d ? c : (enter_c ? b : (enter_b ? a : e))));
        float2 _e125 = leave_xy;
        const float2 _e126 = ltc_flat_crossing(leave_from, leave_to, leave_tilt, leave_normal.z, _e125);
        leave_xy = _e126;
        float2 _e129 = enter_xy;
        const float2 _e130 = ltc_flat_crossing(enter_to, enter_from, enter_tilt, -(enter_normal.z), _e129);
        enter_xy = _e130;
    }
    float2 _e131 = leave_xy;
    float3 leave = float3(_e131, 0.0);
    float2 _e134 = enter_xy;
    float3 enter = float3(_e134, 0.0);
    const float _e137 = ltc_inverse_length(a);
    float3 a_unit = (a * _e137);
    const float _e139 = ltc_inverse_length(b);
    float3 b_unit = (b * _e139);
    const float _e141 = ltc_inverse_length(c);
    float3 c_unit = (c * _e141);
    const float _e143 = ltc_inverse_length(d);
    float3 d_unit = (d * _e143);
    const float _e145 = ltc_inverse_length(e);
    float3 e_unit = (e * _e145);
    const float4 _e149 = ltc_part((a_up ? a_unit : enter), (b_up ? b_unit : leave));
    const float4 _e152 = ltc_part((b_up ? b_unit : enter), (c_up ? c_unit : leave));
    const float4 _e155 = ltc_part((c_up ? c_unit : enter), (d_up ? d_unit : leave));
    const float4 _e158 = ltc_part((d_up ? d_unit : enter), (e_up ? e_unit : leave));
    const float4 _e161 = ltc_part((e_up ? e_unit : enter), (a_up ? a_unit : leave));
    const float _e164 = ltc_edge_weight(_e149.w, 1.0);
    float a_weight = ((a_up | b_up) ? _e164 : 0.0);
    const float _e170 = ltc_edge_weight(_e152.w, 1.0);
    float b_weight = ((b_up | c_up) ? _e170 : 0.0);
    const float _e176 = ltc_edge_weight(_e155.w, 1.0);
    float c_weight = ((c_up | d_up) ? _e176 : 0.0);
    const float _e182 = ltc_edge_weight(_e158.w, 1.0);
    float d_weight = ((d_up | e_up) ? _e182 : 0.0);
    const float _e188 = ltc_edge_weight(_e161.w, 1.0);
    float e_weight = ((e_up | a_up) ? _e188 : 0.0);
    sum = (((((_e149.xyz * a_weight) + (_e152.xyz * b_weight)) + (_e155.xyz * c_weight)) + (_e158.xyz * d_weight)) + (_e161.xyz * e_weight));
    bool obtuse = (min(min(min(_e149.w, _e152.w), min(_e155.w, _e158.w)), _e161.w) < 0.0);
    if (obtuse) {
        float3 _e218 = sum;
        const float3 _e220 = ltc_part_turn(_e149, a_weight, a_normal, (a_up | b_up));
        const float3 _e222 = ltc_part_turn(_e152, b_weight, b_normal, (b_up | c_up));
        const float3 _e225 = ltc_part_turn(_e155, c_weight, c_normal, (c_up | d_up));
        const float3 _e228 = ltc_part_turn(_e158, d_weight, d_normal, (d_up | e_up));
        const float3 _e231 = ltc_part_turn(_e161, e_weight, e_normal, (e_up | a_up));
        sum = (_e218 + ((((_e220 + _e222) + _e225) + _e228) + _e231));
    }
    float2 _e234 = leave_xy;
    float2 _e235 = enter_xy;
    float along = dot(_e234, _e235);
    float area = ((leave.x * enter.y) - (leave.y * enter.x));
    const float _e245 = ltc_edge_weight(along, 1.0);
    float acute = (area * _e245);
    float angle = ((along < 0.0) ? (((area < 0.0) ? -3.1415927 : LTC_PI) - acute) : acute);
    float3 _e256 = sum;
    float _e259 = sum.z;
    return -(float3(_e256.xy, (_e259 + angle)));
}
#endif

#if (!LTC_CHEAP_DISTANCE && LTC_QUAD) || (!LTC_CHEAP_DISTANCE && LTC_TEXTURED)
// Difference of the directions of `origin + offset` and `origin`, for an offset much shorter than `origin`, with the
// relative precision of `offset`. `reference` is the direction of `origin`.
float3 ltc_far_offset(float3 origin, float3 reference, float distance_to_origin, float3 offset)
{
    float rise = dot(offset, ((origin + origin) + offset));
    float squared = max(((distance_to_origin * distance_to_origin) + rise), LTC_TINY);
    float inverse_length = rsqrt(squared);
    float length_difference = (rise / ((squared * inverse_length) + distance_to_origin));
    return ((offset - (reference * length_difference)) * inverse_length);
}
#endif

#if (!LTC_CHEAP_DISTANCE && LTC_QUAD) || (!LTC_CHEAP_DISTANCE && LTC_TEXTURED)
// Vector form factor, times 2 pi and signed, of a pentagon above the horizon, from its first vertex `origin` and the
// offsets of the others from there, all much shorter than the distance; `five` tells whether `d` and `e` differ.
//
// Over a closed polygon the cross products of neighbouring directions add up to those of their offsets from any of them.
// These offsets are known to full relative precision, where the terms of a sum over edges cancel: they are of the
// order of the light's angular size, their sum of that size squared. A unit vector's offset along the
// unit vector that it is measured from is -offset^2 / 2 exactly; with that the sum stays precise for a light on the
// horizon as well.
float3 ltc_far_pentagon(float3 origin, float3 b, float3 c, float3 d, float3 e, bool five)
{
    float3 e_offset = (float3)0;
    float3 fifth_area = (0.0).xxx;
    float3 fifth_chord = (0.0).xxx;
    float fifth_excess = 0.0;

    float squared = dot(origin, origin);
    float inverse_length = rsqrt(max(squared, LTC_TINY));
    float3 reference = (origin * inverse_length);
    float distance_to_origin = (squared * inverse_length);
    const float3 _e12 = ltc_far_offset(origin, reference, distance_to_origin, b);
    const float3 _e13 = ltc_far_offset(origin, reference, distance_to_origin, c);
    const float3 _e14 = ltc_far_offset(origin, reference, distance_to_origin, d);
    e_offset = _e14;
    if (five) {
        const float3 _e24 = ltc_far_offset(origin, reference, distance_to_origin, e);
        e_offset = _e24;
        float3 _e25 = e_offset;
        fifth_area = cross(_e14, _e25);
        float3 _e27 = e_offset;
        fifth_chord = (_e27 - _e14);
        float3 _e29 = fifth_chord;
        float3 _e30 = fifth_chord;
        const float _e34 = ltc_angle_excess((0.5 * dot(_e29, _e30)));
        fifth_excess = _e34;
    }
    float b_squared = dot(_e12, _e12);
    float c_squared = dot(_e13, _e13);
    float d_squared = dot(_e14, _e14);
    float3 _e38 = e_offset;
    float3 _e39 = e_offset;
    float e_squared = dot(_e38, _e39);
    float3 b_area = cross(_e12, _e13);
    float3 c_area = cross(_e13, _e14);
    float3 b_chord = (_e13 - _e12);
    float3 c_chord = (_e14 - _e13);
    const float _e47 = ltc_angle_excess((0.5 * b_squared));
    const float _e51 = ltc_angle_excess((0.5 * dot(b_chord, b_chord)));
    const float _e55 = ltc_angle_excess((0.5 * dot(c_chord, c_chord)));
    const float _e58 = ltc_angle_excess((0.5 * e_squared));
    float3 _e73 = e_offset;
    float3 _e83 = fifth_chord;
    float _e84 = fifth_excess;
    float3 across = (((((((_e12 * ((0.5 * c_squared) + _e47)) + (_e13 * (0.5 * (d_squared - b_squared)))) + (_e14 * (0.5 * (e_squared - c_squared)))) - (_e73 * ((0.5 * d_squared) + _e58))) + (b_chord * _e51)) + (c_chord * _e55)) + (_e83 * _e84));
    float3 _e88 = fifth_area;
    float along = dot(reference, ((b_area + c_area) + _e88));
    float3 _e98 = fifth_area;
    float _e99 = fifth_excess;
    return -((((((reference * along) + cross(reference, across)) + (b_area * _e51)) + (c_area * _e55)) + (_e98 * _e99)));
}
#endif

#if LTC_QUAD || LTC_TEXTURED
// `v` with its part along the normal.
float4 ltc_with_rise(LtcSurface surface, float3 v)
{
    return float4(v, dot(surface.normal, v));
}
#endif

#if LTC_QUAD || LTC_TEXTURED
// What ltc_with_rise gives in the surface's frame.
float3 ltc_rise_in_frame(LtcSurface surface, float4 v)
{
    return float3(dot(surface.tangent, v.xyz), dot(surface.bitangent, v.xyz), v.w);
}
#endif

#if (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_POLYGON) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_QUAD) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_TEXTURED)
// `v` over its length, for a `v` whose square is in range; shorter than 1 below 1e-18.
float3 ltc_fast_unit(float3 v)
{
    return (v * rsqrt(((v.x * v.x) + ((v.y * v.y) + ((v.z * v.z) + LTC_TINY)))));
}
#endif

#if (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_QUAD) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_TEXTURED)
// A quad light as its four directions, in the place of the vertices, in the surface's frame.
LtcQuad ltc_fast_quad(LtcSurface surface, float3 a_9, float3 b_8, float3 c_3, float3 d_3, bool two_sided_2)
{
    LtcQuad quad = (LtcQuad)0;

    const float _e6 = ltc_extent(a_9);
    const float _e7 = ltc_extent(b_8);
    const float _e9 = ltc_extent(c_3);
    const float _e10 = ltc_extent(d_3);
    float reach = max(max(_e6, _e7), max(_e9, _e10));
    const float _e14 = ltc_extent(surface.position);
    float extent = max(max(reach, _e14), 1e-30);
    float scale = asfloat((2139095040u - (asuint(extent) & 2139095040u)));
    float3 origin = (surface.position * scale);
    const float3 _e30 = ltc_fast_unit(((a_9 * scale) - origin));
    const float3 _e31 = ltc_in_frame(surface, _e30);
    quad.a = _e31;
    const float3 _e35 = ltc_fast_unit(((b_8 * scale) - origin));
    const float3 _e36 = ltc_in_frame(surface, _e35);
    quad.b = _e36;
    const float3 _e40 = ltc_fast_unit(((c_3 * scale) - origin));
    const float3 _e41 = ltc_in_frame(surface, _e40);
    quad.c = _e41;
    const float3 _e45 = ltc_fast_unit(((d_3 * scale) - origin));
    const float3 _e46 = ltc_in_frame(surface, _e45);
    quad.d = _e46;
    float3 _e49 = quad.b;
    float3 _e51 = quad.d;
    float3 _e54 = quad.c;
    float3 _e57 = quad.a;
    quad.front = (dot(cross((_e49 - _e51), _e54), _e57) < 0.0);
    quad.two_sided = (two_sided_2 & ltc_use_two_sided);
    bool _e66 = quad.front;
    bool _e68 = quad.two_sided;
    quad.reaches = (_e66 | _e68);
    LtcQuad _e70 = quad;
    const LtcQuad ltcquad = _e70;
    return ltcquad;
}
#endif

#if LTC_QUAD || LTC_TEXTURED
// Cuts a convex quad light with the vertices `a`, `b`, `c`, `d` at the surface's horizon; see ltc_quad.
LtcQuad ltc_quad_begin(LtcSurface surface, float3 a_10, float3 b_9, float3 c_4, float3 d_4, bool two_sided_3)
{
    LtcQuad quad = (LtcQuad)0;
    float4 v_b = (float4)0;
    float4 v_c = (float4)0;
    float4 v_d = (float4)0;
    float4 first = (float4)0;
    float4 v_e = (float4)0;

#if LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON
    if ((ltc_use_cheap_horizon & ltc_use_cheap_distance)) {
        const LtcQuad _e9 = ltc_fast_quad(surface, a_10, b_9, c_4, d_4, two_sided_3);
        const LtcQuad ltcquad_1 = _e9;
        return ltcquad_1;
    }
#endif
    float3 origin = (surface.position * LTC_HEADROOM);
    float3 a_far = (a_10 * LTC_HEADROOM);
    float3 a_full = (a_far - origin);
    float3 b_full = ((b_9 * LTC_HEADROOM) - origin);
    float3 c_full = ((c_4 * LTC_HEADROOM) - origin);
    float3 d_full = ((d_4 * LTC_HEADROOM) - origin);
    const float _e25 = ltc_extent(a_full);
    const float _e26 = ltc_extent(b_full);
    const float _e28 = ltc_extent(c_full);
    const float _e29 = ltc_extent(d_full);
    float extent = max(max(_e25, _e26), max(_e28, _e29));
    float scale = (1.0 / max(extent, LTC_TINY));
    float3 side_b = (((b_9 * LTC_HEADROOM) - a_far) * scale);
    float3 side_c = (((c_4 * LTC_HEADROOM) - a_far) * scale);
    float3 side_d = (((d_4 * LTC_HEADROOM) - a_far) * scale);
    float3 p_a = (a_full * scale);
    quad.front = (dot(cross(side_c, (side_d - side_b)), p_a) < 0.0);
    quad.two_sided = (two_sided_3 & ltc_use_two_sided);
    quad.reaches = false;
    bool _e62 = quad.front;
    bool _e64 = quad.two_sided;
    if (!((_e62 | _e64))) {
        LtcQuad _e67 = quad;
        const LtcQuad ltcquad_2 = _e67;
        return ltcquad_2;
    }
    float size_squared = max(max(dot(side_b, side_b), dot(side_c, side_c)), dot(side_d, side_d));
    bool distant_1 = (!(ltc_use_cheap_distance) & (size_squared < (0.0625 * dot(p_a, p_a))));
    const float4 _e80 = ltc_with_rise(surface, p_a);
    const float4 _e83 = ltc_with_rise(surface, (distant_1 ? side_b : (b_full * scale)));
    v_b = _e83;
    const float4 _e87 = ltc_with_rise(surface, (distant_1 ? side_c : (c_full * scale)));
    v_c = _e87;
    const float4 _e91 = ltc_with_rise(surface, (distant_1 ? side_d : (d_full * scale)));
    v_d = _e91;
    float base_height = (distant_1 ? _e80.w : 0.0);
    bool a_up = (_e80.w > 0.0);
    float _e100 = v_b.w;
    bool b_up = ((base_height + _e100) > 0.0);
    float _e105 = v_c.w;
    bool c_up = ((base_height + _e105) > 0.0);
    float _e110 = v_d.w;
    bool d_up = ((base_height + _e110) > 0.0);
    if (!((((a_up | b_up) | c_up) | d_up))) {
        LtcQuad _e118 = quad;
        const LtcQuad ltcquad_3 = _e118;
        return ltcquad_3;
    }
    quad.reaches = true;
    quad.distant = distant_1;
    quad.clipped = (!((((a_up & b_up) & c_up) & d_up)) & !(ltc_use_cheap_horizon));
    first = _e80;
    float4 _e131 = v_d;
    v_e = _e131;
    bool _e136 = quad.clipped;
#if !LTC_CHEAP_HORIZON
    if ((!(ltc_use_cheap_horizon) & _e136)) {
        bool last_a = (b_up & !(a_up));
        bool last_b = (c_up & !(b_up));
        bool last_c = (d_up & !(c_up));
        bool half_turn = (last_b | last_c);
        bool turn = (last_a | last_c);
        float4 start = (distant_1 ? (0.0).xxxx : _e80);
        float4 _e149 = v_c;
        float4 half_a = (half_turn ? _e149 : start);
        float4 _e151 = v_b;
        float4 _e152 = v_d;
        float4 half_b = (half_turn ? _e152 : _e151);
        float4 _e154 = v_c;
        float4 half_c = (half_turn ? start : _e154);
        float4 _e156 = v_d;
        float4 _e157 = v_b;
        float4 half_d = (half_turn ? _e157 : _e156);
        float4 q_a = (turn ? half_b : half_a);
        float4 q_b = (turn ? half_c : half_b);
        float4 q_c = (turn ? half_d : half_c);
        float4 q_d = (turn ? half_a : half_d);
        bool up_b = ((base_height + q_b.w) > 0.0);
        bool up_c = ((base_height + q_c.w) > 0.0);
        float4 leave_from = (up_c ? q_c : (up_b ? q_b : q_a));
        float4 leave_to = (up_c ? q_d : (up_b ? q_c : q_b));
        float4 leave_side = (leave_to - leave_from);
        float4 enter_side = (q_d - q_a);
        float4 leave = (leave_from + (leave_side * saturate(((base_height + leave_from.w) / max(-(leave_side.w), LTC_TINY)))));
        float4 enter = (q_a + (enter_side * saturate(((base_height + q_a.w) / max(-(enter_side.w), LTC_TINY)))));
        first = q_a;
        v_b = (up_b ? q_b : leave);
        v_c = (up_c ? q_c : leave);
        v_d = leave;
        v_e = enter;
        if (distant_1) {
            first = (_e80 + q_a);
            float4 _e200 = v_b;
            v_b = (_e200 - q_a);
            float4 _e202 = v_c;
            v_c = (_e202 - q_a);
            float4 _e204 = v_d;
            v_d = (_e204 - q_a);
            float4 _e206 = v_e;
            v_e = (_e206 - q_a);
        }
    }
#endif
    float4 _e209 = first;
    const float3 _e210 = ltc_rise_in_frame(surface, _e209);
    quad.a = _e210;
    float4 _e212 = v_b;
    const float3 _e213 = ltc_rise_in_frame(surface, _e212);
    quad.b = _e213;
    float4 _e215 = v_c;
    const float3 _e216 = ltc_rise_in_frame(surface, _e215);
    quad.c = _e216;
    float4 _e218 = v_d;
    const float3 _e219 = ltc_rise_in_frame(surface, _e218);
    quad.d = _e219;
    float3 _e222 = quad.d;
    quad.e = _e222;
    bool _e226 = quad.clipped;
#if !LTC_CHEAP_HORIZON
    if ((!(ltc_use_cheap_horizon) & _e226)) {
        float4 _e229 = v_e;
        const float3 _e230 = ltc_rise_in_frame(surface, _e229);
        quad.e = _e230;
    }
#endif
    if (!(distant_1)) {
        float4 _e233 = first;
        float4 _e235 = v_b;
        float4 _e237 = v_b;
        float4 _e239 = first;
        const float3 _e242 = ltc_edge_normal(_e233.xyz, _e235.xyz, (_e237.xyz - _e239.xyz));
        const float3 _e243 = ltc_in_frame(surface, _e242);
        quad.a_normal = _e243;
        float4 _e245 = v_b;
        float4 _e247 = v_c;
        float4 _e249 = v_c;
        float4 _e251 = v_b;
        const float3 _e254 = ltc_edge_normal(_e245.xyz, _e247.xyz, (_e249.xyz - _e251.xyz));
        const float3 _e255 = ltc_in_frame(surface, _e254);
        quad.b_normal = _e255;
        float4 _e257 = v_c;
        float4 _e259 = v_d;
        float4 _e261 = v_d;
        float4 _e263 = v_c;
        const float3 _e266 = ltc_edge_normal(_e257.xyz, _e259.xyz, (_e261.xyz - _e263.xyz));
        const float3 _e267 = ltc_in_frame(surface, _e266);
        quad.c_normal = _e267;
        float4 _e269 = v_e;
        float4 _e271 = first;
        float4 _e273 = first;
        float4 _e275 = v_e;
        const float3 _e278 = ltc_edge_normal(_e269.xyz, _e271.xyz, (_e273.xyz - _e275.xyz));
        const float3 _e279 = ltc_in_frame(surface, _e278);
        quad.e_normal = _e279;
        bool _e283 = quad.clipped;
#if !LTC_CHEAP_HORIZON
        if ((!(ltc_use_cheap_horizon) & _e283)) {
            float4 _e287 = v_d;
            float4 _e289 = v_e;
            float4 _e291 = v_e;
            float4 _e293 = v_d;
            const float3 _e296 = ltc_edge_normal(_e287.xyz, _e289.xyz, (_e291.xyz - _e293.xyz));
            quad.rim = dot(surface.normal, _e296);
        }
#endif
    }
    LtcQuad _e298 = quad;
    const LtcQuad ltcquad_4 = _e298;
    return ltcquad_4;
}
#endif

#if (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_POLYGON) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_QUAD) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_TEXTURED)
// t / sin t for the angle t between two unit vectors, from their sum, whose length is twice the cosine of t / 2.
//
// It has a pole at 180 degrees: there an edge passes the surface point, or the middle of a lobe. Over the
// reciprocal of that cosine it is smooth, so one polynomial serves all angles. A scalar product would have lost the
// digits of the cosine near the pole, the sum has not. The relative error of t / sin t is below 7.7e-4; the coefficients
// are those of the fit `softbox::fit::fit_half_angle` of degree 2. Bounded by 4e6 for any input.
float ltc_fast_ratio(float3 v)
{
    float squared = ((v.x * v.x) + ((v.y * v.y) + ((v.z * v.z) + 1e-12)));
    float inverse = rsqrt(squared);
    return ((3.1391902 * inverse) + ((((0.2799755 * inverse) - 0.0423115) * squared) - 0.9603001));
}
#endif

#if (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_QUAD) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_TEXTURED)
// Vector form factor, times 2 pi and signed, of the quad between four unit vectors: the sum of ltc_fast_edge, with the
// cross products of opposite vertices with their neighbours in place of those of the edges. A small quad's are those
// of two differences, and of a vertex with another one close to it, so that rounding is as small as the quad.
float3 ltc_fast_form_factor(float3 a, float3 b, float3 c, float3 d)
{
    const float _e5 = ltc_fast_ratio((a + b));
    const float _e7 = ltc_fast_ratio((b + c));
    const float _e9 = ltc_fast_ratio((c + d));
    const float _e11 = ltc_fast_ratio((d + a));
    float3 from_a = ((b * _e5) - (d * _e11));
    float3 more_from_c = ((b * (_e7 - _e5)) + (d * (_e11 - _e9)));
    return (cross((c - a), from_a) + cross(c, more_from_c));
}
#endif

#if LTC_QUAD || LTC_TEXTURED
// Vector form factor, times 2 pi and signed, of what the surface's horizon leaves of a quad, in the surface's frame.
float3 ltc_quad_form_factor(LtcQuad quad)
{
#if LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON
    if ((ltc_use_cheap_horizon & ltc_use_cheap_distance)) {
        const float3 _e8 = ltc_fast_form_factor(quad.a, quad.b, quad.c, quad.d);
        return _e8;
    }
#endif
#if !LTC_CHEAP_DISTANCE
    if ((!(ltc_use_cheap_distance) & quad.distant)) {
        const float3 _e19 = ltc_far_pentagon(quad.a, quad.b, quad.c, quad.d, quad.e, quad.clipped);
        return _e19;
    }
#endif
    const float3 _e34 = ltc_edges(quad.a, quad.b, quad.c, quad.d, quad.e, quad.a_normal, quad.b_normal, quad.c_normal, float3(0.0, 0.0, quad.rim), quad.e_normal, quad.clipped);
    return _e34;
}
#endif

#if (LTC_CHEAP_HORIZON && LTC_POLYGON) || (LTC_CHEAP_HORIZON && LTC_QUAD) || (LTC_CHEAP_HORIZON && LTC_TEXTURED)
// The form factor of what a horizon leaves of the round light whose vector form factor is given; `height` is the product
// of that one and the horizon's normal (the idea: Snyder 1996, "Area Light Sources for Real-Time Graphics"; Hill and
// Heitz 2016).
//
// Of the light above and the light below, what counts of either is the same but for `height`. What a level horizon
// leaves is that of half the light, and between there and the light that it does not cut the fit
// `softbox::fit::fit_round_above` runs, off by at most 0.006 and exact where nothing is cut.
float ltc_round_above(float3 form_factor, float height)
{
    float squared = min(dot(form_factor, form_factor), 1.0);
    float inverse = rsqrt(max(squared, LTC_TINY));
    float whole = (squared * inverse);
    float reach = (whole * sqrt(max(whole, LTC_TINY)));
    float tilt = min(abs((height * inverse)), 1.0);
    float offset = min(((tilt * tilt) * inverse), 1.0);
    float depth = sqrt(max((1.0 - whole), LTC_TINY));
    float missing = (((1.221 - (0.80223 * depth)) * depth) + (0.0892 * offset));
    return saturate((0.5 * (height + max(abs(height), (reach * (1.0 - ((1.0 - offset) * missing)))))));
}
#endif

#if LTC_QUAD || LTC_TEXTURED
// The form factor of a quad, 0 to 1.
float ltc_quad_diffuse(LtcSurface surface, LtcQuad quad)
{
    if (!(quad.reaches)) {
        return 0.0;
    }
#if LTC_CHEAP_HORIZON
    if (ltc_use_cheap_horizon) {
        const float3 _e5 = ltc_quad_form_factor(quad);
        float3 toward = (_e5 * (quad.front ? LTC_OVER_TWO_PI : -0.15915494));
        const float _e12 = ltc_round_above(toward, toward.z);
        return _e12;
    }
#endif
    const float3 _e13 = ltc_quad_form_factor(quad);
    const float _e19 = ltc_received((_e13.z * LTC_OVER_TWO_PI), true, quad.two_sided);
    return _e19;
}
#endif

#if LTC_TEXTURED
// The vector form factor of a quad, cut at the surface's horizon, in the caller's space, towards the light.
float3 ltc_quad_toward(LtcSurface surface, LtcQuad quad)
{
    const float3 _e2 = ltc_quad_form_factor(quad);
    float3 form_factor = (_e2 * LTC_OVER_TWO_PI);
    float3 toward = ((form_factor.z < 0.0) ? -(form_factor) : form_factor);
    return (((surface.tangent * toward.x) + (surface.bitangent * toward.y)) + (surface.normal * toward.z));
}
#endif

#if (LTC_ANISOTROPIC && LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_QUAD) || (LTC_ANISOTROPIC && LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_CLEARCOAT && LTC_QUAD) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_GGX && LTC_QUAD) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_QUAD && LTC_SHEEN) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_SHEEN && LTC_TEXTURED)
// ltc_quad_lobe for a quad of ltc_fast_quad.
float3 ltc_fast_lobe(LtcQuad quad, LtcLobe lobe)
{
    const float3 _e3 = ltc_transform_framed(lobe, quad.a);
    const float3 _e4 = ltc_fast_unit(_e3);
    const float3 _e6 = ltc_transform_framed(lobe, quad.b);
    const float3 _e7 = ltc_fast_unit(_e6);
    const float3 _e9 = ltc_transform_framed(lobe, quad.c);
    const float3 _e10 = ltc_fast_unit(_e9);
    const float3 _e12 = ltc_transform_framed(lobe, quad.d);
    const float3 _e13 = ltc_fast_unit(_e12);
    const float3 _e14 = ltc_fast_form_factor(_e4, _e7, _e10, _e13);
    float3 toward = (_e14 * (quad.front ? LTC_OVER_TWO_PI : -0.15915494));
    const float _e22 = ltc_round_above(toward, toward.z);
    return (float3(toward.xy, _e22) * lobe.share);
}
#endif

#if (LTC_ANISOTROPIC && LTC_QUAD) || (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_QUAD) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_QUAD) || (LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// The vector form factor of a quad in a lobe's space, cut at both horizons, towards the light.
float3 ltc_quad_lobe(LtcQuad quad, LtcLobe lobe)
{
    float3 b_11 = (float3)0;
    float3 c_6 = (float3)0;
    float3 d_6 = (float3)0;
    float3 e_3 = (float3)0;
    float3 a_normal_2 = (float3)0;
    float3 b_normal_2 = (float3)0;
    float3 c_normal_2 = (float3)0;
    float3 e_normal_2 = (float3)0;
    float rim = (float)0;
    bool distant = false;
    LtcQuad moved = (LtcQuad)0;
    float3 sum = (float3)0;

    if (!(quad.reaches)) {
        return (0.0).xxx;
    }
#if LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON
    if ((ltc_use_cheap_horizon & ltc_use_cheap_distance)) {
        const float3 _e9 = ltc_fast_lobe(quad, lobe);
        return _e9;
    }
#endif
    const float3 _e11 = ltc_transform_framed(lobe, quad.a);
    const float3 _e13 = ltc_transform_framed(lobe, quad.b);
    b_11 = _e13;
    const float3 _e16 = ltc_transform_framed(lobe, quad.c);
    c_6 = _e16;
    const float3 _e19 = ltc_transform_framed(lobe, quad.d);
    d_6 = _e19;
    float3 _e21 = d_6;
    e_3 = _e21;
    if (quad.clipped) {
        const float3 _e25 = ltc_transform_framed(lobe, quad.e);
        e_3 = _e25;
    }
    a_normal_2 = quad.a_normal;
    b_normal_2 = quad.b_normal;
    c_normal_2 = quad.c_normal;
    e_normal_2 = quad.e_normal;
    rim = quad.rim;
#if !LTC_CHEAP_DISTANCE
    if ((!(ltc_use_cheap_distance) & quad.distant)) {
        float _e44 = b_11.z;
        float _e46 = c_6.z;
        float _e49 = d_6.z;
        float _e51 = e_3.z;
        float lowest = (_e11.z + min(min(min(_e44, _e46), min(_e49, _e51)), 0.0));
        float _e59 = b_11.z;
        float _e61 = c_6.z;
        float _e64 = d_6.z;
        float _e66 = e_3.z;
        float highest = (_e11.z + max(max(max(_e59, _e61), max(_e64, _e66)), 0.0));
        float3 _e72 = b_11;
        float3 _e73 = b_11;
        float3 _e75 = c_6;
        float3 _e76 = c_6;
        float3 _e79 = d_6;
        float3 _e80 = d_6;
        float3 _e82 = e_3;
        float3 _e83 = e_3;
        float size = max(max(dot(_e72, _e73), dot(_e75, _e76)), max(dot(_e79, _e80), dot(_e82, _e83)));
        distant = (size < (0.0625 * dot(_e11, _e11)));
#if !LTC_CHEAP_HORIZON
        if (!(ltc_use_cheap_horizon)) {
            bool _e93 = distant;
            if ((_e93 & (highest <= 0.0))) {
                return (0.0).xxx;
            }
            bool _e99 = distant;
            distant = (_e99 & ((lowest > 0.0) | (size < (4e-5 * dot(_e11, _e11)))));
        }
#endif
        bool _e108 = distant;
        if (!(_e108)) {
            float3 _e110 = b_11;
            b_11 = (_e110 + _e11);
            float3 _e112 = c_6;
            c_6 = (_e112 + _e11);
            float3 _e114 = d_6;
            d_6 = (_e114 + _e11);
            float3 _e116 = e_3;
            e_3 = (_e116 + _e11);
            a_normal_2 = cross(quad.a, quad.b);
            b_normal_2 = cross((quad.a + quad.c), (quad.c - quad.b));
            c_normal_2 = cross((quad.a + quad.d), (quad.d - quad.c));
            e_normal_2 = cross(quad.e, quad.a);
            rim = cross((quad.a + quad.e), (quad.e - quad.d)).z;
        }
    }
#endif
#if LTC_CHEAP_HORIZON
    if (ltc_use_cheap_horizon) {
        moved = quad;
        bool _e149 = distant;
        moved.distant = _e149;
        moved.a = _e11;
        float3 _e152 = b_11;
        moved.b = _e152;
        float3 _e154 = c_6;
        moved.c = _e154;
        float3 _e156 = d_6;
        moved.d = _e156;
        float3 _e158 = e_3;
        moved.e = _e158;
        float3 _e160 = a_normal_2;
        const float3 _e161 = ltc_transform_framed_normal(lobe, _e160);
        moved.a_normal = _e161;
        float3 _e163 = b_normal_2;
        const float3 _e164 = ltc_transform_framed_normal(lobe, _e163);
        moved.b_normal = _e164;
        float3 _e166 = c_normal_2;
        const float3 _e167 = ltc_transform_framed_normal(lobe, _e166);
        moved.c_normal = _e167;
        float3 _e169 = e_normal_2;
        const float3 _e170 = ltc_transform_framed_normal(lobe, _e169);
        moved.e_normal = _e170;
        LtcQuad _e171 = moved;
        const float3 _e172 = ltc_quad_form_factor(_e171);
        float3 winding = (_e172 * LTC_OVER_TWO_PI);
        float3 form_factor = (quad.front ? winding : -(winding));
        const float _e180 = ltc_round_above(form_factor, form_factor.z);
        return (float3(form_factor.xy, _e180) * lobe.share);
    }
#endif
    bool _e187 = distant;
#if !LTC_CHEAP_DISTANCE
    if ((!(ltc_use_cheap_distance) & _e187)) {
        float3 _e189 = b_11;
        float3 _e190 = c_6;
        float3 _e191 = d_6;
        float3 _e192 = e_3;
        const float3 _e194 = ltc_far_pentagon(_e11, _e189, _e190, _e191, _e192, quad.clipped);
        sum = _e194;
    } else {
#else
    {
#endif
        float3 _e195 = b_11;
        float3 _e196 = c_6;
        float3 _e197 = d_6;
        float3 _e198 = e_3;
        float3 _e199 = a_normal_2;
        const float3 _e200 = ltc_transform_framed_normal(lobe, _e199);
        float3 _e201 = b_normal_2;
        const float3 _e202 = ltc_transform_framed_normal(lobe, _e201);
        float3 _e203 = c_normal_2;
        const float3 _e204 = ltc_transform_framed_normal(lobe, _e203);
        float _e205 = rim;
        const float3 _e209 = ltc_transform_framed_normal(lobe, float3(0.0, 0.0, _e205));
        float3 _e210 = e_normal_2;
        const float3 _e211 = ltc_transform_framed_normal(lobe, _e210);
        const float _e213 = ltc_horizon(lobe);
        const float3 _e214 = ltc_pentagon(_e11, _e195, _e196, _e197, _e198, _e200, _e202, _e204, _e209, _e211, quad.clipped, _e213);
        sum = _e214;
    }
    float3 _e215 = sum;
    const float3 _e220 = ltc_received_vector((_e215 * LTC_OVER_TWO_PI), true, quad.two_sided);
    return _e220;
}
#endif

#if (LTC_ANISOTROPIC && LTC_QUAD) || (LTC_CLEARCOAT && LTC_QUAD) || (LTC_GGX && LTC_QUAD) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN)
// The parts (specular, fresnel) that a sum of lobes reflects of a quad of unit radiance.
float2 ltc_quad_specular(LtcSurface surface, LtcQuad quad, LtcLobes lobes)
{
    float2 value = (0.0).xx;
    LtcLobe lobe = (LtcLobe)0;
    LtcShape shape = (LtcShape)0;
    int index = int(1);

#if !LTC_SECOND_LOBE
    if (!(ltc_use_second_lobe)) {
        const float3 _e10 = ltc_quad_lobe(quad, lobes.first);
        const float2 _e11 = ltc_lobes_part(surface, lobes.first, _e10);
        value = _e11;
    }
#endif
#if LTC_SECOND_LOBE
    if (ltc_use_second_lobe) {
        lobe = lobes.first;
        shape = lobes.second;
        while(true) {
            float2 _e19 = value;
            LtcLobe _e20 = lobe;
            LtcLobe _e21 = lobe;
            const float3 _e22 = ltc_quad_lobe(quad, _e21);
            const float2 _e23 = ltc_lobes_part(surface, _e20, _e22);
            value = (_e19 + _e23);
            int _e25 = index;
            if ((_e25 >= lobes.count)) {
                break;
            }
            LtcShape _e28 = shape;
            const LtcLobe _e29 = ltc_shape_lobe(surface, _e28);
            lobe = _e29;
#if LTC_THIRD_LOBE
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
#endif
            int _e32 = index;
            index = asint(asuint(_e32) + asuint(int(1)));
        }
    }
#endif
    float2 _e35 = value;
    return _e35;
}
#endif

#if LTC_QUAD
// The value (diffuse, specular, fresnel) of a convex quad light with the vertices `a`, `b`, `c`,
// `d`, counter-clockwise seen from the side that emits (from both with `two_sided`). Repeated
// vertices make it a triangle. For a quad that is not convex use the polygon functions.
//
// Error of the form factor against exact arithmetic: at most 1e-6 for a light whose size is at
// least a tenth of its distance, 2e-6 for one that touches or all but touches the surface; at most
// 1e-4 of its value for smaller ones down to 1e-5 of the distance, unless they are seen edge-on.
// Where an edge passes by at less than 1/25 of the distance of its ends, 4e-8 times that ratio takes the
// place of 1e-6: so much do the coordinates' own digits leave open.
//
// With the switch for a cheap horizon a light is not cut. A round light of the same vector form factor stands in for
// it where a horizon would cut it (Hill and Heitz 2016, "Real-Time Area Lighting: a Journey from Research to
// Production"), and lobes are cut at their own horizon only. A light above the horizons has the same value; one that
// straddles them is off by up to 0.1, by 1.9 % of the mean on random quads, and light may come from a little below the
// surface.
//
// With the switch for a cheap distance a small light loses digits: the form factor's relative error is about 1e-7 times
// its distance over its size, up to 1e-6 times that where it is not seen near the normal. With both switches each edge is off by up to 8e-4 of itself besides, see ltc_fast_ratio.
float3 ltc_quad(LtcSurface surface, LtcLobes lobes, float3 a, float3 b, float3 c, float3 d, bool two_sided)
{
    float2 specular = (0.0).xx;

    const LtcQuad _e7 = ltc_quad_begin(surface, a, b, c, d, two_sided);
    if (!(_e7.reaches)) {
        return (0.0).xxx;
    }
#if LTC_GGX
    if (ltc_use_ggx) {
        const float2 _e16 = ltc_quad_specular(surface, _e7, lobes);
        specular = _e16;
    }
#endif
    const float _e17 = ltc_quad_diffuse(surface, _e7);
    float2 _e18 = specular;
    return float3(_e17, _e18);
}
#endif

#if LTC_POLYGON
// Starts an outline at its first vertex.
LtcOutline ltc_outline_begin(LtcSurface surface, float3 corner)
{
    LtcOutline outline = (LtcOutline)0;

    float3 to_first = ((corner * LTC_HEADROOM) - (surface.position * LTC_HEADROOM));
    outline.first = corner;
    const float _e11 = ltc_extent(to_first);
    outline.scale = (1.0 / max(_e11, LTC_SMALLEST));
    outline.first_up = (dot(surface.normal, to_first) > 0.0);
    bool _e23 = outline.first_up;
    outline.previous_up = _e23;
    outline.previous = corner;
    outline.facing = 0.0;
    outline.diffuse = 0.0;
    outline.crossed = false;
    outline.sum = (0.0).xxx;
    LtcOutline _e34 = outline;
    const LtcOutline ltcoutline = _e34;
    return ltcoutline;
}
#endif

#if LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON && LTC_POLYGON
// The edge integral of two unit vectors: the angle between them along the normal of their plane.
float3 ltc_fast_edge(float3 a, float3 b)
{
    float3 product = cross(a, (b - a));
    const float _e5 = ltc_fast_ratio((a + b));
    return (product * _e5);
}
#endif

#if LTC_POLYGON
// ltc_edge_about for points and their offsets from `origin`. A point far from `origin` may as well be
// given by its direction.
float3 ltc_edge_from(float3 origin, float3 a, float3 a_offset, float3 b, float3 b_offset, float3 normal)
{
    float3 reference = (origin * rsqrt(max(dot(origin, origin), LTC_TINY)));
    float3 a_unit = (a * rsqrt(max(dot(a, a), LTC_TINY)));
    float3 b_unit = (b * rsqrt(max(dot(b, b), LTC_TINY)));
    const float3 _e21 = ltc_offset(origin, reference, a, a_offset);
    const float3 _e22 = ltc_offset(origin, reference, b, b_offset);
    const float3 _e23 = ltc_edge_about(reference, a_unit, _e21, b_unit, _e22, normal);
    return _e23;
}
#endif

#if LTC_POLYGON
// Adds the next vertex, or the first one again to close the outline.
void ltc_outline_add(inout LtcOutline outline, LtcSurface surface, float3 corner)
{
    float3 edge = (float3)0;
    float3 start_1 = (float3)0;
    float3 start_offset = (float3)0;
    float3 end_1 = (float3)0;
    float3 end_offset = (float3)0;

    float3 origin = (surface.position * LTC_HEADROOM);
    float3 _e7 = outline.first;
    float3 first_far = (_e7 * LTC_HEADROOM);
    float3 _e11 = outline.previous;
    float3 a_far = (_e11 * LTC_HEADROOM);
    float3 b_far = (corner * LTC_HEADROOM);
    const float _e17 = ltc_extent((a_far - origin));
    const float _e19 = ltc_extent((b_far - origin));
    float extent = max(_e17, _e19);
    float _e22 = outline.scale;
    float scale_3 = min(_e22, (100000000.0 / max(extent, 1e-11)));
    float3 reference_7 = ((first_far - origin) * scale_3);
    float3 a = ((a_far - origin) * scale_3);
    float3 b = ((b_far - origin) * scale_3);
    float3 a_offset = ((a_far - first_far) * scale_3);
    float3 b_offset = ((b_far - first_far) * scale_3);
    float _e39 = outline.facing;
    const float3 _e40 = ltc_shorter(a_offset, b_offset);
    const float3 _e41 = ltc_shorter(a, b);
    const float3 _e42 = ltc_shorter(_e40, _e41);
    outline.facing = (_e39 + dot(cross(_e42, ((b_far - a_far) * scale_3)), reference_7));
    outline.previous = corner;
    outline.reference = reference_7;
#if LTC_CHEAP_HORIZON
    if (ltc_use_cheap_horizon) {
#if LTC_CHEAP_DISTANCE
        if (ltc_use_cheap_distance) {
            const float3 _e54 = ltc_fast_unit(a);
            outline.start = _e54;
            const float3 _e56 = ltc_fast_unit(b);
            outline.end = _e56;
            float3 _e58 = outline.start;
            float3 _e60 = outline.end;
            const float3 _e61 = ltc_fast_edge(_e58, _e60);
            edge = _e61;
        }
#endif
#if !LTC_CHEAP_DISTANCE
        if (!(ltc_use_cheap_distance)) {
            outline.start = a;
            outline.end = b;
            outline.start_offset = a_offset;
            outline.end_offset = b_offset;
            const float3 _e70 = ltc_edge_normal(a, b, (b_offset - a_offset));
            outline.normal = _e70;
            float3 _e72 = outline.normal;
            const float3 _e73 = ltc_edge_from(reference_7, a, a_offset, b, b_offset, _e72);
            edge = _e73;
        }
#endif
        float3 _e75 = outline.sum;
        float3 _e76 = edge;
        outline.sum = (_e75 - _e76);
        float _e79 = outline.diffuse;
        float3 _e81 = edge;
        outline.diffuse = (_e79 - dot(surface.normal, _e81));
        return;
    }
#endif
    float height = dot(surface.normal, reference_7);
    bool near = (!(ltc_use_cheap_distance) & (max(dot(a_offset, a_offset), dot(b_offset, b_offset)) < (0.0625 * dot(reference_7, reference_7))));
    float a_height = (near ? (height + dot(surface.normal, a_offset)) : dot(surface.normal, a));
    float b_height = (near ? (height + dot(surface.normal, b_offset)) : dot(surface.normal, b));
    bool a_up = outline.previous_up;
    float3 _e112 = outline.first;
    outline.returns = all((corner == _e112));
    bool _e118 = outline.first_up;
    bool _e120 = outline.returns;
    bool b_up = (_e120 ? _e118 : (b_height > 0.0));
    outline.previous_up = b_up;
    outline.starts_up = a_up;
    outline.ends_up = b_up;
    outline.closes = false;
    if (!((a_up | b_up))) {
        return;
    }
    start_1 = a;
    start_offset = a_offset;
    end_1 = b;
    end_offset = b_offset;
    if (!((a_up & b_up))) {
        float3 above = (a_up ? a : b);
        float3 below = (a_up ? b : a);
        float3 above_offset = (a_up ? a_offset : b_offset);
        float3 below_offset = (a_up ? b_offset : a_offset);
        float high = max((a_up ? a_height : b_height), 0.0);
        float low = min((a_up ? b_height : a_height), 0.0);
        float t = (high / max((high - low), LTC_TINY));
        float3 between = (above + ((below - above) * t));
        float3 crossing = (between - (surface.normal * dot(surface.normal, between)));
        float3 crossing_offset = (above_offset + ((below_offset - above_offset) * t));
        bool _e161 = outline.crossed;
        if (_e161) {
            float3 base = outline.crossing;
            float3 base_offset = outline.crossing_offset;
            float3 horizon_start = (a_up ? crossing : base);
            float3 horizon_end = (a_up ? base : crossing);
            float3 horizon_start_offset = (a_up ? crossing_offset : base_offset);
            float3 horizon_end_offset = (a_up ? base_offset : crossing_offset);
            const float3 _e171 = ltc_edge_normal(horizon_start, horizon_end, (horizon_end_offset - horizon_start_offset));
            float3 normal_13 = (surface.normal * dot(surface.normal, _e171));
            outline.closes = true;
            outline.horizon_start = horizon_start;
            outline.horizon_end = horizon_end;
            outline.horizon_start_offset = horizon_start_offset;
            outline.horizon_end_offset = horizon_end_offset;
            outline.horizon_normal = normal_13;
            float _e184 = outline.diffuse;
            const float3 _e186 = ltc_edge_from(reference_7, horizon_start, horizon_start_offset, horizon_end, horizon_end_offset, normal_13);
            outline.diffuse = (_e184 - dot(surface.normal, _e186));
        } else {
            outline.crossed = true;
            outline.crossing = crossing;
            outline.crossing_offset = crossing_offset;
        }
        start_1 = (a_up ? a : crossing);
        start_offset = (a_up ? a_offset : crossing_offset);
        end_1 = (a_up ? crossing : b);
        end_offset = (a_up ? crossing_offset : b_offset);
    }
    float3 _e197 = start_1;
    float3 _e198 = end_1;
    float3 _e199 = end_offset;
    float3 _e200 = start_offset;
    const float3 _e202 = ltc_edge_normal(_e197, _e198, (_e199 - _e200));
    float3 _e204 = start_1;
    outline.start = _e204;
    float3 _e206 = end_1;
    outline.end = _e206;
    float3 _e208 = start_offset;
    outline.start_offset = _e208;
    float3 _e210 = end_offset;
    outline.end_offset = _e210;
    outline.normal = _e202;
    float _e213 = outline.diffuse;
    float3 _e215 = start_1;
    float3 _e216 = start_offset;
    float3 _e217 = end_1;
    float3 _e218 = end_offset;
    const float3 _e219 = ltc_edge_from(reference_7, _e215, _e216, _e217, _e218, _e202);
    outline.diffuse = (_e213 - dot(surface.normal, _e219));
    return;
}
#endif

#if LTC_POLYGON
// Starts a lobe's part of an outline.
LtcOutlineLobe ltc_outline_lobe_begin()
{
    LtcOutlineLobe sum_3 = (LtcOutlineLobe)0;

    sum_3.crossed = false;
    sum_3.begun = false;
    sum_3.sum = (0.0).xxx;
    sum_3.share = 1.0;
    LtcOutlineLobe _e10 = sum_3;
    const LtcOutlineLobe ltcoutlinelobe = _e10;
    return ltcoutlinelobe;
}
#endif

#if (LTC_ANISOTROPIC && LTC_POLYGON) || (LTC_CLEARCOAT && LTC_POLYGON) || (LTC_GGX && LTC_POLYGON) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN)
// Adds one edge that lies above the surface or on its horizon, in the lobe's space, and what of it counts as above the lobe's
// horizon; `exact` as for ltc_crossing.
void ltc_outline_lobe_edge(inout LtcOutlineLobe sum_4, float3 reference, float3 a, float3 a_offset, bool a_up, float3 b, float3 b_offset, bool b_up, float3 normal, bool exact)
{
    float3 start = (float3)0;
    float3 start_offset = (float3)0;
    float3 end = (float3)0;
    float3 end_offset = (float3)0;

    if (!((a_up | b_up))) {
        return;
    }
    start = a;
    start_offset = a_offset;
    end = b;
    end_offset = b_offset;
    if (!((a_up & b_up))) {
        float3 above = (a_up ? a : b);
        float3 below = (a_up ? b : a);
        float3 above_offset = (a_up ? a_offset : b_offset);
        float3 below_offset = (a_up ? b_offset : a_offset);
        float high = max(above.z, 0.0);
        float t = (high / max((high - min(below.z, 0.0)), LTC_TINY));
        const float3 _e34 = ltc_crossing(above, below, (a_up ? normal : -(normal)), exact);
        bool distant = (max(dot(above_offset, above_offset), dot(below_offset, below_offset)) < (0.0625 * dot(reference, reference)));
        float3 crossing_offset_1 = (distant ? (above_offset + ((below_offset - above_offset) * t)) : (_e34 - reference));
        bool _e48 = sum_4.crossed;
        if (_e48) {
            float3 base = sum_4.crossing;
            float3 base_offset = sum_4.crossing_offset;
            float3 horizon_start = (a_up ? _e34 : base);
            float3 horizon_end = (a_up ? base : _e34);
            float3 _e56 = sum_4.sum;
            const float3 _e60 = ltc_edge_normal(horizon_start, horizon_end, (horizon_end - horizon_start));
            const float3 _e61 = ltc_edge_from(reference, horizon_start, (a_up ? crossing_offset_1 : base_offset), horizon_end, (a_up ? base_offset : crossing_offset_1), _e60);
            sum_4.sum = (_e56 - _e61);
        } else {
            sum_4.crossed = true;
            sum_4.crossing = _e34;
            sum_4.crossing_offset = crossing_offset_1;
        }
        start = (a_up ? a : _e34);
        start_offset = (a_up ? a_offset : crossing_offset_1);
        end = (a_up ? _e34 : b);
        end_offset = (a_up ? crossing_offset_1 : b_offset);
    }
    float3 _e72 = sum_4.sum;
    float3 _e73 = start;
    float3 _e74 = start_offset;
    float3 _e75 = end;
    float3 _e76 = end_offset;
    const float3 _e77 = ltc_edge_from(reference, _e73, _e74, _e75, _e76, normal);
    sum_4.sum = (_e72 - _e77);
    return;
}
#endif

#if (LTC_ANISOTROPIC && LTC_POLYGON) || (LTC_CLEARCOAT && LTC_POLYGON) || (LTC_GGX && LTC_POLYGON) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN)
// Adds what ltc_outline_add has last added to `outline` to a lobe.
void ltc_outline_lobe_add(inout LtcOutlineLobe sum_5, LtcOutline outline, LtcLobe lobe)
{
#if LTC_CHEAP_HORIZON
    if (ltc_use_cheap_horizon) {
        sum_5.share = lobe.share;
    }
#endif
#if LTC_CHEAP_DISTANCE && LTC_CHEAP_HORIZON
    if ((ltc_use_cheap_horizon & ltc_use_cheap_distance)) {
        float3 _e10 = sum_5.sum;
        const float3 _e12 = ltc_transform(lobe, outline.start);
        const float3 _e13 = ltc_fast_unit(_e12);
        const float3 _e15 = ltc_transform(lobe, outline.end);
        const float3 _e16 = ltc_fast_unit(_e15);
        const float3 _e17 = ltc_fast_edge(_e13, _e16);
        sum_5.sum = (_e10 - _e17);
        return;
    }
#endif
#if !LTC_CHEAP_HORIZON
    if ((!(ltc_use_cheap_horizon) & !((outline.starts_up | outline.ends_up)))) {
        return;
    }
#endif
    const float3 _e27 = ltc_transform(lobe, outline.reference);
#if LTC_CHEAP_HORIZON
    if (ltc_use_cheap_horizon) {
        float3 _e30 = sum_5.sum;
        const float3 _e32 = ltc_transform(lobe, outline.start);
        const float3 _e34 = ltc_transform(lobe, outline.start_offset);
        const float3 _e36 = ltc_transform(lobe, outline.end);
        const float3 _e38 = ltc_transform(lobe, outline.end_offset);
        const float3 _e40 = ltc_transform_normal(lobe, outline.normal);
        const float3 _e41 = ltc_edge_from(_e27, _e32, _e34, _e36, _e38, _e40);
        sum_5.sum = (_e30 - _e41);
        return;
    }
#endif
    const float3 _e44 = ltc_transform(lobe, outline.start);
    const float3 _e46 = ltc_transform(lobe, outline.end);
    bool _e51 = sum_5.previous_up;
    bool _e53 = sum_5.begun;
    bool start_up = ((_e53 & outline.starts_up) ? _e51 : (_e44.z > 0.0));
    bool _e58 = sum_5.begun;
    if (!(_e58)) {
        sum_5.begun = true;
        sum_5.first_up = start_up;
    }
    bool _e67 = sum_5.first_up;
    bool end_up = ((outline.returns & outline.ends_up) ? _e67 : (_e46.z > 0.0));
    sum_5.previous_up = end_up;
    if ((outline.starts_up != outline.ends_up)) {
        bool crossing_up = (outline.starts_up ? end_up : start_up);
        if (outline.closes) {
            bool _e80 = sum_5.crossing_up;
            bool horizon_start_up = (outline.starts_up ? crossing_up : _e80);
            bool _e84 = sum_5.crossing_up;
            bool horizon_end_up = (outline.starts_up ? _e84 : crossing_up);
            const float3 _e88 = ltc_transform(lobe, outline.horizon_start);
            const float3 _e90 = ltc_transform(lobe, outline.horizon_start_offset);
            const float3 _e92 = ltc_transform(lobe, outline.horizon_end);
            const float3 _e94 = ltc_transform(lobe, outline.horizon_end_offset);
            const float3 _e96 = ltc_transform_normal(lobe, outline.horizon_normal);
            ltc_outline_lobe_edge(sum_5, _e27, _e88, _e90, horizon_start_up, _e92, _e94, horizon_end_up, _e96, true);
        } else {
            sum_5.crossing_up = crossing_up;
        }
    }
    const float3 _e100 = ltc_transform(lobe, outline.start_offset);
    const float3 _e102 = ltc_transform(lobe, outline.end_offset);
    const float3 _e104 = ltc_transform_normal(lobe, outline.normal);
    ltc_outline_lobe_edge(sum_5, _e27, _e44, _e100, start_up, _e46, _e102, end_up, _e104, false);
    return;
}
#endif

#if LTC_CHEAP_HORIZON && LTC_POLYGON
// What an outline's sums are to be multiplied by for the form factor of the light that arrives.
float ltc_outline_scale(LtcOutline outline, bool two_sided)
{
    bool front = (outline.facing < 0.0);
    return (front ? LTC_OVER_TWO_PI : ((two_sided & ltc_use_two_sided) ? -0.15915494 : 0.0));
}
#endif

#if LTC_POLYGON
// The form factor of a closed outline, 0 to 1. Its error is that of ltc_quad, and grows with the root of the number
// of vertices.
float ltc_outline_diffuse(LtcOutline outline, bool two_sided)
{
#if LTC_CHEAP_HORIZON
    if (ltc_use_cheap_horizon) {
        const float _e3 = ltc_outline_scale(outline, two_sided);
        const float _e8 = ltc_round_above((outline.sum * _e3), (outline.diffuse * _e3));
        return _e8;
    }
#endif
    const float _e15 = ltc_received((outline.diffuse * LTC_OVER_TWO_PI), (outline.facing < 0.0), two_sided);
    return _e15;
}
#endif

#if (LTC_ANISOTROPIC && LTC_POLYGON) || (LTC_CLEARCOAT && LTC_POLYGON) || (LTC_GGX && LTC_POLYGON) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN)
// The vector form factor of a closed outline in a lobe's space, cut at both horizons, towards the light.
float3 ltc_outline_lobe(LtcOutline outline, LtcOutlineLobe sum_6, bool two_sided)
{
#if LTC_CHEAP_HORIZON
    if (ltc_use_cheap_horizon) {
        const float _e5 = ltc_outline_scale(outline, two_sided);
        float3 toward = (sum_6.sum * _e5);
        const float _e9 = ltc_round_above(toward, toward.z);
        return (float3(toward.xy, _e9) * sum_6.share);
    }
#endif
    const float3 _e19 = ltc_received_vector((sum_6.sum * LTC_OVER_TWO_PI), (outline.facing < 0.0), two_sided);
    return _e19;
}
#endif

#if LTC_POLYGON
// Starts what a sum of lobes knows of an outline.
LtcOutlineLobes ltc_outline_lobes_begin()
{
    LtcOutlineLobes sums = (LtcOutlineLobes)0;

    const LtcOutlineLobe _e2 = ltc_outline_lobe_begin();
    sums.first = _e2;
    const LtcOutlineLobe _e4 = ltc_outline_lobe_begin();
    sums.second = _e4;
    const LtcOutlineLobe _e6 = ltc_outline_lobe_begin();
    sums.third = _e6;
    LtcOutlineLobes _e7 = sums;
    const LtcOutlineLobes ltcoutlinelobes = _e7;
    return ltcoutlinelobes;
}
#endif

#if (LTC_ANISOTROPIC && LTC_POLYGON) || (LTC_CLEARCOAT && LTC_POLYGON) || (LTC_GGX && LTC_POLYGON) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN)
// Adds the outline's last edge to the lobes of a sum.
void ltc_outline_lobes_add(inout LtcOutlineLobes sums, LtcSurface surface, LtcOutline outline, LtcLobes lobes)
{
    LtcOutlineLobe sum = (LtcOutlineLobe)0;
    LtcLobe lobe = (LtcLobe)0;
    LtcShape shape = (LtcShape)0;
    int index = int(1);

    LtcOutlineLobe _e5 = sums.first;
    sum = _e5;
#if !LTC_SECOND_LOBE
    if (!(ltc_use_second_lobe)) {
        ltc_outline_lobe_add(sum, outline, lobes.first);
        LtcOutlineLobe _e11 = sum;
        sums.first = _e11;
    }
#endif
#if LTC_SECOND_LOBE
    if (ltc_use_second_lobe) {
        lobe = lobes.first;
        shape = lobes.second;
        while(true) {
            LtcLobe _e19 = lobe;
            ltc_outline_lobe_add(sum, outline, _e19);
            int _e20 = index;
            if ((_e20 <= int(1))) {
                LtcOutlineLobe _e24 = sum;
                sums.first = _e24;
                LtcOutlineLobe _e26 = sums.second;
                sum = _e26;
            } else {
                int _e27 = index;
                if ((_e27 <= int(2))) {
                    LtcOutlineLobe _e31 = sum;
                    sums.second = _e31;
#if LTC_THIRD_LOBE
                    if (ltc_use_third_lobe) {
                        LtcOutlineLobe _e34 = sums.third;
                        sum = _e34;
                    }
#endif
                } else {
                    LtcOutlineLobe _e36 = sum;
                    sums.third = _e36;
                }
            }
            int _e37 = index;
            if ((_e37 >= lobes.count)) {
                break;
            }
            LtcShape _e40 = shape;
            const LtcLobe _e41 = ltc_shape_lobe(surface, _e40);
            lobe = _e41;
#if LTC_THIRD_LOBE
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
#endif
            int _e44 = index;
            index = asint(asuint(_e44) + asuint(int(1)));
        }
        return;
    } else {
#else
    {
#endif
#if !LTC_SECOND_LOBE
        return;
#endif
    }
}
#endif

#if (LTC_ANISOTROPIC && LTC_POLYGON) || (LTC_CLEARCOAT && LTC_POLYGON) || (LTC_GGX && LTC_POLYGON) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN)
// The parts (specular, fresnel) that a sum of lobes reflects of a closed outline of unit radiance.
float2 ltc_outline_specular(LtcSurface surface, LtcOutline outline, LtcOutlineLobes sums, LtcLobes lobes, bool two_sided)
{
    float2 value = (float2)0;

    const float3 _e7 = ltc_outline_lobe(outline, sums.first, two_sided);
    const float2 _e8 = ltc_lobes_part(surface, lobes.first, _e7);
    value = _e8;
#if LTC_SECOND_LOBE
    if ((ltc_use_second_lobe & (lobes.count > int(1)))) {
        float2 _e15 = value;
        const LtcLobe _e17 = ltc_shape_lobe(surface, lobes.second);
        const float3 _e19 = ltc_outline_lobe(outline, sums.second, two_sided);
        const float2 _e20 = ltc_lobes_part(surface, _e17, _e19);
        value = (_e15 + _e20);
    }
#endif
#if LTC_THIRD_LOBE
    if ((ltc_use_third_lobe & (lobes.count > int(2)))) {
        float2 _e27 = value;
        const LtcLobe _e29 = ltc_shape_lobe(surface, lobes.third);
        const float3 _e31 = ltc_outline_lobe(outline, sums.third, two_sided);
        const float2 _e32 = ltc_lobes_part(surface, _e29, _e31);
        value = (_e27 + _e32);
    }
#endif
    float2 _e34 = value;
    return _e34;
}
#endif

#if LTC_POLYGON
// Starts a polygon at its first vertex.
LtcPolygon ltc_polygon_begin(LtcSurface surface, float3 corner)
{
    LtcPolygon polygon = (LtcPolygon)0;

    const LtcOutline _e4 = ltc_outline_begin(surface, corner);
    polygon.outline = _e4;
    const LtcOutlineLobes _e6 = ltc_outline_lobes_begin();
    polygon.sums = _e6;
    LtcPolygon _e7 = polygon;
    const LtcPolygon ltcpolygon = _e7;
    return ltcpolygon;
}
#endif

#if LTC_POLYGON
// Adds the next vertex.
void ltc_polygon_add(inout LtcPolygon polygon, LtcSurface surface, LtcLobes lobes, float3 corner)
{
    LtcOutline outline_8 = (LtcOutline)0;
    LtcOutlineLobes sums_3 = (LtcOutlineLobes)0;

    LtcOutline _e5 = polygon.outline;
    outline_8 = _e5;
    LtcOutlineLobes _e8 = polygon.sums;
    sums_3 = _e8;
    ltc_outline_add(outline_8, surface, corner);
#if LTC_GGX
    if (ltc_use_ggx) {
        LtcOutline _e11 = outline_8;
        ltc_outline_lobes_add(sums_3, surface, _e11, lobes);
    }
#endif
    LtcOutline _e13 = outline_8;
    polygon.outline = _e13;
    LtcOutlineLobes _e15 = sums_3;
    polygon.sums = _e15;
    return;
}
#endif

#if LTC_POLYGON
// The value (diffuse, specular, fresnel) of the polygon whose vertices have all been added.
float3 ltc_polygon_end(inout LtcPolygon polygon, LtcSurface surface, LtcLobes lobes, bool two_sided)
{
    float2 specular = (0.0).xx;

    float3 first_5 = polygon.outline.first;
    ltc_polygon_add(polygon, surface, lobes, first_5);
    LtcOutline _e8 = polygon.outline;
    const float _e9 = ltc_outline_diffuse(_e8, two_sided);
#if LTC_GGX
    if (ltc_use_ggx) {
        LtcOutline _e15 = polygon.outline;
        LtcOutlineLobes _e17 = polygon.sums;
        const float2 _e18 = ltc_outline_specular(surface, _e15, _e17, lobes, two_sided);
        specular = _e18;
    }
#endif
    float2 _e19 = specular;
    return float3(_e9, _e19);
}
#endif

#if LTC_TUBE
// Square root of a number that is not negative; 0 below 1e-30.
float ltc_root(float x)
{
    return (x * rsqrt(max(x, 1e-30)));
}
#endif

#if LTC_TUBE
// Share of what reaches from `height` - `rise` to `height` + `rise` that is above 0.
float ltc_tube_share(float height, float rise)
{
    return saturate((0.5 + ((0.5 * height) / max(max(rise, abs(height)), LTC_TINY))));
}
#endif

#if LTC_TUBE
// The vector form factor of a line of constant width from `a` to `b`, over the sine of half the angle under
// which that width is seen at its `foot`, the direction of its closest point, at the given distance.
//
// With t the angle from the foot, w(t) the direction there and s = sin of half the width, it is
// s / pi times the integral of 2 cos t w(t). Between two ends that is the sum of their directions, each
// times the cosine of the other and the sine of the angle between them, and of the foot times that angle
// less its sine times its cosine: no difference of large terms, so a distant line keeps its digits, and
// one on the horizon too. A `foot` shorter than 1 is that of an axis nearer than `distance`.
float3 ltc_tube_line(float3 a, float3 b, float3 foot, float distance_to_line, float length_of_line)
{
    float hidden = max((1.0 - dot(foot, foot)), 0.0);
    float inside = ((hidden * distance_to_line) * distance_to_line);
    float a_inverse = rsqrt(max((dot(a, a) + inside), LTC_TINY));
    float b_inverse = rsqrt(max((dot(b, b) + inside), LTC_TINY));
    float3 a_unit = (a * a_inverse);
    float3 b_unit = (b * b_inverse);
    float a_cosine = min((distance_to_line * a_inverse), 1.0);
    float b_cosine = min((distance_to_line * b_inverse), 1.0);
    float ends_sine = (length_of_line * min((a_inverse * b_cosine), (b_inverse * a_cosine)));
    float3 chord = (b_unit - a_unit);
    float change = (b_cosine - a_cosine);
    float ends_k = (0.5 * (dot(chord, chord) + ((hidden * change) * change)));
    float ends_cosine = (1.0 - ends_k);
    float agreed = rsqrt(max(((ends_sine * ends_sine) + (ends_cosine * ends_cosine)), LTC_TINY));
    float sine = (ends_sine * agreed);
    float k = (ends_k + (((1.0 - (ends_cosine * agreed)) - ends_k) * min(ends_k, 1.0)));
    const float _e64 = ltc_angle_excess(min(k, max((2.0 - k), 0.0)));
    float bulge = ((k > 1.0) ? (LTC_PI - (sine * ((2.0 + _e64) - min(k, 2.0)))) : (sine * (_e64 + k)));
    return (((((a_unit * b_cosine) + (b_unit * a_cosine)) * sine) + (foot * bulge)) * 0.31830987);
}
#endif

#if LTC_CAPS && LTC_TUBE
// Towards a cap around `center`, the end of a tube in the direction `outward`, as long as the sine of half
// the angle under which it is seen; in w the share of it that is seen. `inverse_distance` is 1 over the distance,
// `reach` the radius or the tube's length if that is less, and `turned` tells how far the tube's end is turned
// towards the surface point, from -1 to 1.
float4 ltc_tube_cap_begin(LtcSurface surface, float3 center_, float inverse_distance, float3 outward, float radius, float reach, float turned)
{
    float3 toward = (center_ * inverse_distance);
    float3 aside = (outward - (toward * dot(toward, outward)));
    float3 middle = (center_ + (aside * ((0.42441317 * reach) * (1.0 - turned))));
    const float _e20 = ltc_tube_share(dot(surface.normal, middle), radius);
    const float3 _e27 = ltc_direction((middle + (surface.normal * (radius * (1.0 - _e20)))));
    return float4((_e27 * min((radius * inverse_distance), 1.0)), ((0.5 + (0.5 * turned)) * _e20));
}
#endif

#if LTC_TUBE
// The tube of the given `radius` around the line from `start` to `end`, which emits outwards from its lateral
// surface; with `caps` its ends are rounded by hemispheres that emit too, else they are open and it is
// dark inside.
//
// The axis is cut at the surface's horizon. Where the tube lies along the horizon, part of its width is
// below: then what is left counts, with the middle that it has. A surface point inside the tube counts
// as one at the radius's distance from the axis, in the direction in which the axis is, so that light stays continuous.
LtcTube ltc_tube_begin(LtcSurface surface, float3 start_3, float3 end_3, float radius, bool caps)
{
    LtcTube tube = (LtcTube)0;

    float3 origin = (surface.position * LTC_HEADROOM);
    float3 a_full = ((start_3 * LTC_HEADROOM) - origin);
    float3 b_full = ((end_3 * LTC_HEADROOM) - origin);
    float radius_full = (abs(radius) * LTC_HEADROOM);
    const float _e17 = ltc_extent(a_full);
    const float _e18 = ltc_extent(b_full);
    float scale = (1.0 / max(max(max(_e17, _e18), radius_full), LTC_SMALLEST));
    float3 side = (((end_3 * LTC_HEADROOM) - (start_3 * LTC_HEADROOM)) * scale);
    float3 p_a = (a_full * scale);
    float3 p_b = (b_full * scale);
    float r = (radius_full * scale);
    float3 axis = (side * rsqrt(max(dot(side, side), 1e-36)));
    float full_length = dot(axis, side);
    float a_squared = dot(p_a, p_a);
    float b_squared = dot(p_b, p_b);
    float3 moment = cross(((b_squared < a_squared) ? p_b : p_a), axis);
    float squared = max(dot(moment, moment), (r * r));
    float inverse = rsqrt(max(squared, 1e-30));
    bool is_inside = (dot(moment, moment) < (r * r));
    float sine_5 = (is_inside ? 1.0 : min((r * inverse), 1.0));
    float3 across_7 = (moment * inverse);
    float nearer = ((caps & ltc_use_caps) ? 0.0 : (0.7853982 * sine_5));
    float3 moved = (cross(axis, moment) * nearer);
    float3 upright = (surface.normal - (axis * dot(surface.normal, axis)));
    float hidden = (is_inside ? max((1.0 - dot(across_7, across_7)), 0.0) : 0.0);
    float3 slope = ((across_7 * dot(surface.normal, across_7)) + (upright * hidden));
    const float _e89 = ltc_root(max(dot(surface.normal, slope), dot(slope, slope)));
    float rise = (r * _e89);
    float highest = max(dot(surface.normal, (p_a - moved)), dot(surface.normal, (p_b - moved)));
    const float _e98 = ltc_tube_share(highest, rise);
    float3 lift = (slope * (((1.0 - _e98) * r) / max(_e89, 1e-15)));
    float3 q_a = ((p_a - moved) + lift);
    float3 q_b = ((p_b - moved) + lift);
    float a_height = dot(surface.normal, q_a);
    float b_height = dot(surface.normal, q_b);
    float a_part = saturate((-(a_height) / max((b_height - a_height), LTC_TINY)));
    float b_part = saturate((-(b_height) / max((a_height - b_height), LTC_TINY)));
    float3 left = (q_b - q_a);
    tube.start = (q_a + (left * a_part));
    tube.remaining_length = (full_length * max(((1.0 - a_part) - b_part), 0.0));
    tube.end = (q_b - (left * b_part));
    tube.axis_distance = ((squared * inverse) * (1.0 - nearer));
    tube.axis = axis;
    tube.sine = sine_5;
    tube.across = across_7;
    tube.share = ((max(a_height, b_height) > 0.0) ? _e98 : 0.0);
    tube.start_cap = (0.0).xxx;
    tube.start_weight = 0.0;
    tube.end_cap = (0.0).xxx;
    tube.end_weight = 0.0;
#if LTC_CAPS
    if ((ltc_use_caps & caps)) {
        float a_inverse = rsqrt(max(max(a_squared, (r * r)), LTC_TUBE_TINY));
        float b_inverse = rsqrt(max(max(b_squared, (r * r)), LTC_TUBE_TINY));
        float farther = ((max(b_squared, (r * r)) * b_inverse) - (max(a_squared, (r * r)) * a_inverse));
        float turned = (sine_5 * clamp((farther / max(full_length, LTC_TINY)), -1.0, 1.0));
        float reach = min(r, full_length);
        const float4 _e193 = ltc_tube_cap_begin(surface, p_a, a_inverse, -(axis), r, reach, turned);
        const float4 _e195 = ltc_tube_cap_begin(surface, p_b, b_inverse, axis, r, reach, -(turned));
        tube.start_cap = _e193.xyz;
        tube.start_weight = _e193.w;
        tube.end_cap = _e195.xyz;
        tube.end_weight = _e195.w;
        float _e205 = tube.share;
        tube.share = (_e205 * max((1.0 - (turned * turned)), 0.0));
    }
#endif
    LtcTube _e212 = tube;
    const LtcTube ltctube = _e212;
    return ltctube;
}
#endif

#if LTC_TUBE
// The form factor of a tube, 0 to 1. Its mean error against the integral over the solid angle is 0.09 times
// the square of radius over distance of the value, with caps 0.3 times.
float ltc_tube_diffuse(LtcSurface surface, LtcTube tube)
{
    float value = (float)0;

    float3 foot = cross(tube.axis, tube.across);
    const float3 _e9 = ltc_tube_line(tube.start, tube.end, foot, tube.axis_distance, tube.remaining_length);
    value = ((max(dot(surface.normal, _e9), 0.0) * tube.sine) * tube.share);
#if LTC_CAPS
    if (ltc_use_caps) {
        float _e20 = value;
        const float _e31 = ltc_root(dot(tube.start_cap, tube.start_cap));
        value = (_e20 + ((tube.start_weight * max(dot(surface.normal, tube.start_cap), 0.0)) * _e31));
        float _e34 = value;
        const float _e45 = ltc_root(dot(tube.end_cap, tube.end_cap));
        value = (_e34 + ((tube.end_weight * max(dot(surface.normal, tube.end_cap), 0.0)) * _e45));
    }
#endif
    float _e48 = value;
    return saturate(_e48);
}
#endif

#if (LTC_ANISOTROPIC && LTC_CAPS && LTC_TUBE) || (LTC_CAPS && LTC_CLEARCOAT && LTC_TUBE) || (LTC_CAPS && LTC_GGX && LTC_TUBE) || (LTC_CAPS && LTC_ROUGH_DIFFUSE && LTC_TUBE) || (LTC_CAPS && LTC_SHEEN && LTC_TUBE)
// The vector form factor of a tube's cap in the lobe's space: that of a small disk at its middle.
float3 ltc_tube_cap(LtcLobe lobe, float3 cap, float weight)
{
    const float3 _e3 = ltc_transform(lobe, cap);
    float squared = dot(cap, cap);
    float inverse = rsqrt(max(dot(_e3, _e3), LTC_TINY));
    const float _e9 = ltc_root(squared);
    float narrowed = min((_e9 * inverse), 1000000000.0);
    const float3 _e13 = ltc_transform_normal(lobe, cap);
    float area = min((((max(dot(_e13, _e3), 0.0) * narrowed) * narrowed) * narrowed), 1e30);
    float covered = min((area / max(((1.0 - squared) + area), LTC_TINY)), 1.0);
    return (_e3 * ((_e3.z > 0.0) ? ((weight * covered) * inverse) : 0.0));
}
#endif

#if (LTC_ANISOTROPIC && LTC_TUBE) || (LTC_CLEARCOAT && LTC_TUBE) || (LTC_GGX && LTC_TUBE) || (LTC_ROUGH_DIFFUSE && LTC_TUBE) || (LTC_SHEEN && LTC_TUBE)
// The vector form factor of a tube in the lobe's space, of its part above both horizons; z is not negative.
//
// There a tube has another width, and need be neither thin nor seen square. The two planes of its outline give
// its width as the chord between their directions across the axis. The line is moved to where the middle
// between these directions meets the tube's section.
//
// Mean error of the coverage against the lobe's integral over the solid angle, for a radius of 0.02 and
// 0.08 of the distance: 0.006 and 0.09 % at roughness 0.4 to 1, 0.03 and 0.2 % at 0.15 to 0.4; with caps 0.02 and
// 0.2 %, 0.04 and 0.5 %. A cap is one point: a lobe narrower than a cap misses it or sees it whole, 5 % at 0.05
// to 0.15 and a radius of 0.02.
float3 ltc_tube_lobe(LtcTube tube, LtcLobe lobe)
{
    float3 value = (float3)0;

    const float3 _e3 = ltc_transform(lobe, tube.axis);
    const float3 _e5 = ltc_transform_normal(lobe, tube.axis);
    float volume = max(dot(_e5, _e3), 0.0);
    float stretch_squared = dot(_e3, _e3);
    float stretch_inverse = rsqrt(max(stretch_squared, LTC_TUBE_TINY));
    float stretch = (stretch_squared * stretch_inverse);
    const float3 _e15 = ltc_transform_normal(lobe, tube.across);
    float hidden = ((tube.sine >= 1.0) ? max((1.0 - dot(tube.across, tube.across)), 0.0) : 0.0);
    float squared = (dot(_e15, _e15) + ((hidden * volume) * stretch));
    float inverse = rsqrt(max(squared, LTC_TUBE_TINY));
    float3 normal = (_e15 * inverse);
    float3 toward = (cross(_e3, _e15) * (inverse * stretch_inverse));
    float sine_6 = (tube.sine * tube.share);
    const float3 _e43 = ltc_transform(lobe, tube.across);
    float3 side = (_e43 * sine_6);
    float full_depth = ((squared * inverse) * stretch_inverse);
    const float _e52 = ltc_root(max((1.0 - (sine_6 * sine_6)), 0.0));
    float depth = (full_depth * _e52);
    float width = ((sine_6 * volume) * inverse);
    float slope = dot(toward, side);
    float left_depth = (depth - slope);
    float right_depth = (depth + slope);
    float left_squared = ((left_depth * left_depth) + (width * width));
    float right_squared = ((right_depth * right_depth) + (width * width));
    float left_inverse = rsqrt(max(left_squared, LTC_TUBE_TINY));
    float right_inverse = rsqrt(max(right_squared, LTC_TUBE_TINY));
    float left_cosine = (left_depth * left_inverse);
    float right_cosine = (right_depth * right_inverse);
    float cosines = (left_cosine + right_cosine);
    float narrow = ((width * left_inverse) * right_inverse);
    float chord_depth = ((cosines > 1.0) ? (((((4.0 * depth) * slope) * narrow) * narrow) / max(cosines, 1.0)) : (right_cosine - left_cosine));
    float chord_width = (width * (left_inverse + right_inverse));
    float chord_squared = ((chord_depth * chord_depth) + (chord_width * chord_width));
    float chord_inverse = rsqrt(max(chord_squared, 1e-30));
    float foot_depth = (chord_width * chord_inverse);
    float foot_width = (-(chord_depth) * chord_inverse);
    float3 foot = ((toward * foot_depth) + (normal * foot_width));
    float lengths = ((left_squared * left_inverse) + (right_squared * right_inverse));
    float shift = (((-4.0 * full_depth) * slope) / max((lengths * lengths), 1e-16));
    float line_distance = (tube.axis_distance * max(((foot_depth * (full_depth + (slope * shift))) + ((foot_width * width) * shift)), 0.0));
    float3 moved = (side * (tube.axis_distance * shift));
    const float3 _e126 = ltc_transform(lobe, tube.start);
    float3 a = (_e126 + moved);
    const float3 _e129 = ltc_transform(lobe, tube.end);
    float3 b = (_e129 + moved);
    float a_part = saturate((-(a.z) / max((b.z - a.z), LTC_TINY)));
    float b_part = saturate((-(b.z) / max((a.z - b.z), LTC_TINY)));
    float3 left = (b - a);
    float line_length = ((tube.remaining_length * stretch) * max(((1.0 - a_part) - b_part), 0.0));
    const float3 _e162 = ltc_tube_line((a + (left * a_part)), (b - (left * b_part)), foot, line_distance, line_length);
    value = (_e162 * ((max(a.z, b.z) > 0.0) ? ((0.5 * chord_squared) * chord_inverse) : 0.0));
#if LTC_CAPS
    if ((ltc_use_caps & ((tube.start_weight + tube.end_weight) > 0.0))) {
        float3 _e182 = value;
        const float3 _e185 = ltc_tube_cap(lobe, tube.start_cap, tube.start_weight);
        const float3 _e188 = ltc_tube_cap(lobe, tube.end_cap, tube.end_weight);
        value = (_e182 + (_e185 + _e188));
        float3 _e191 = value;
        float3 _e192 = value;
        float3 _e193 = value;
        value = (_e191 * min(rsqrt(max(dot(_e192, _e193), LTC_TINY)), 1.0));
    }
#endif
    float3 _e201 = value;
    float _e204 = value.z;
    return float3(_e201.xy, max(_e204, 0.0));
}
#endif

#if (LTC_ANISOTROPIC && LTC_TUBE) || (LTC_CLEARCOAT && LTC_TUBE) || (LTC_GGX && LTC_TUBE) || (LTC_ROUGH_DIFFUSE && LTC_TUBE) || (LTC_SHEEN && LTC_TUBE)
// The parts (specular, fresnel) that a sum of lobes reflects of a tube of unit radiance.
float2 ltc_tube_specular(LtcSurface surface, LtcTube tube, LtcLobes lobes)
{
    float2 value = (0.0).xx;
    LtcLobe lobe = (LtcLobe)0;
    LtcShape shape = (LtcShape)0;
    int index = int(1);

#if !LTC_SECOND_LOBE
    if (!(ltc_use_second_lobe)) {
        const float3 _e10 = ltc_tube_lobe(tube, lobes.first);
        const float2 _e11 = ltc_lobes_part(surface, lobes.first, _e10);
        value = _e11;
    }
#endif
#if LTC_SECOND_LOBE
    if (ltc_use_second_lobe) {
        lobe = lobes.first;
        shape = lobes.second;
        while(true) {
            float2 _e19 = value;
            LtcLobe _e20 = lobe;
            LtcLobe _e21 = lobe;
            const float3 _e22 = ltc_tube_lobe(tube, _e21);
            const float2 _e23 = ltc_lobes_part(surface, _e20, _e22);
            value = (_e19 + _e23);
            int _e25 = index;
            if ((_e25 >= lobes.count)) {
                break;
            }
            LtcShape _e28 = shape;
            const LtcLobe _e29 = ltc_shape_lobe(surface, _e28);
            lobe = _e29;
#if LTC_THIRD_LOBE
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
#endif
            int _e32 = index;
            index = asint(asuint(_e32) + asuint(int(1)));
        }
    }
#endif
    float2 _e35 = value;
    return _e35;
}
#endif

#if LTC_TUBE
// The value (diffuse, specular, fresnel) of a tube light of the given `radius` around the line from `start` to
// `end`, at best an eighth of the distance or less; with `caps` its ends are rounded. See ltc_tube_begin.
//
// Error of the form factor against exact arithmetic: at most 4e-7 and 1e-7 times the ratio of the farther end's
// distance to that of the axis, in units of the angles under which the tube's width and length are seen,
// each counted as no more than 1: so much do the coordinates' own digits leave open. For a lobe's coverage see
// ltc_tube_lobe.
float3 ltc_tube(LtcSurface surface, LtcLobes lobes, float3 start, float3 end, float radius, bool caps)
{
    float2 specular = (0.0).xx;

    const LtcTube _e6 = ltc_tube_begin(surface, start, end, radius, caps);
#if LTC_GGX
    if (ltc_use_ggx) {
        const float2 _e11 = ltc_tube_specular(surface, _e6, lobes);
        specular = _e11;
    }
#endif
    const float _e12 = ltc_tube_diffuse(surface, _e6);
    float2 _e13 = specular;
    return float3(_e12, _e13);
}
#endif

#if LTC_TEXTURED
// Factor that brings the furthest of three corners, scaled by LTC_HEADROOM, to a distance of about 1.
float ltc_rectangle_scale(LtcSurface surface, float3 a, float3 b, float3 d)
{
    float3 origin = (surface.position * LTC_HEADROOM);
    const float _e10 = ltc_extent(((a * LTC_HEADROOM) - origin));
    const float _e14 = ltc_extent(((b * LTC_HEADROOM) - origin));
    const float _e19 = ltc_extent(((d * LTC_HEADROOM) - origin));
    float extent = max(max(_e10, _e14), _e19);
    return (1.0 / max(extent, LTC_TINY));
}
#endif

#if LTC_TEXTURED
// Variance of the blur that leaves of the second wave across a picture what a spread of the given variance leaves
// of it: exp(-2 pi^2 blur) = 1 / (1 + 2 pi^2 spread). The same for small ones.
float ltc_outlined(float spread)
{
    float x = (19.739208 * spread);
    return (((x < 0.001) ? (x - ((0.5 * x) * x)) : (log2((1.0 + x)) * 0.6931472)) * 0.05066059);
}
#endif

#if LTC_TEXTURED
// The look-up from the unit vector `toward` the light; the heights (`rise`) of the sides u and v and of `toward`
// over the cosine's horizon; the cross products v x corner, corner x u and u x v (`normal`); and the product
// `offset` of the corner and the last one. Whatever these are, place is within 0 to 1, and all is finite.
//
// The vector form factor points to the mean of the light's points p, of distance r, weighted by 1 / r^4; the
// cosine weights them by p.z / r^4. The ratio of the weights is linear over the light, so the cosine's mean lies
// off by the covariance of the first weights times the slope of p.z, exactly. That covariance is about that of
// directions spread evenly around the mean one, as far as the light's outline leaves room for it.
//
// The blur is that spread too; folded at the picture's edges, it has to grow with the logarithm of the spread
// to shrink the picture's waves as the cosine does.
LtcLookup ltc_lookup(float3 toward, float3 rise, float3 normal_u, float3 normal_v, float3 normal, float offset, float2 texels, bool pair)
{
    LtcLookup lookup = (LtcLookup)0;

    float facing = dot(toward, normal);
    float inverse_facing = (((facing < 0.0) ? -1.0 : 1.0) / max(abs(facing), 1e-30));
    float2 hit = clamp((float2(dot(toward, normal_u), dot(toward, normal_v)) * inverse_facing), (0.0).xx, (1.0).xx);
    float3 free_u = ((normal_u - (normal * hit.x)) * inverse_facing);
    float3 free_v = ((normal_v - (normal * hit.y)) * inverse_facing);
    const float _e35 = ltc_extent(free_u);
    float3 along_u = (free_u * (10000.0 / max(_e35, 10000.0)));
    const float _e41 = ltc_extent(free_v);
    float3 along_v = (free_v * (10000.0 / max(_e41, 10000.0)));
    float3 moment = float3(dot(along_u, along_u), dot(along_u, along_v), dot(along_v, along_v));
    float3 product = cross(along_u, along_v);
    float area = dot(product, product);
    float2 within = (hit * ((1.0).xx - hit));
    float2 room = (((1.3333334 * within) * within) + (1e-6).xx);
    float spread_area = ((0.24700901 * 0.24700901) * area);
    float cross_u = ((0.24700901 * moment.x) * room.y);
    float cross_v = ((0.24700901 * moment.z) * room.x);
    float share = (1.0 / (((spread_area + cross_u) + cross_v) + (room.x * room.y)));
    float variance_u = (room.x * ((spread_area + cross_u) * share));
    float variance_v = (room.y * ((spread_area + cross_v) * share));
    float covariance = ((room.x * room.y) * ((0.24700901 * moment.y) * share));
    float2 slope = (rise.xy * (1.0 / max(((offset * inverse_facing) * rise.z), LTC_TINY)));
    float2 shift = float2(((variance_u * slope.x) + (covariance * slope.y)), ((covariance * slope.x) + (variance_v * slope.y)));
    float2 middle = clamp((hit + shift), (0.0).xx, (1.0).xx);
    float cosine = (abs(facing) * rsqrt(max(dot(normal, normal), LTC_TINY)));
    float lean = ((LTC_LOOKUP_TILT * (1.0 - rise.z)) + (LTC_LOOKUP_EDGE_ON * (1.0 - cosine)));
    float blur = (0.9409 * max((1.0 - lean), 0.05));
    float aspect = (max(texels.x, 1.0) / max(texels.y, 1.0));
    float x_4 = ((blur * moment.x) * aspect);
    float y = (blur * moment.y);
    float z_1 = ((blur * moment.z) / aspect);
    float difference = (0.5 * (x_4 - z_1));
    float square = ((difference * difference) + (y * y));
    float turn = (square * rsqrt(max(square, LTC_TINY)));
    float longer = ((0.5 * (x_4 + z_1)) + turn);
    const float _e174 = ltc_outlined(longer);
    const float _e180 = ltc_outlined((((blur * blur) * area) / max(longer, LTC_TINY)));
    float2 sides = float2(_e174, _e180);
    float sides_product = (sides.x * sides.y);
    float single = (sides_product * rsqrt(max(sides_product, LTC_TINY)));
    float variance = (pair ? max(sides.y, (LTC_LOOKUP_PAIR_SHARE * sides.x)) : single);
    float level = (0.5 * log2(max(((((variance * texels.x) * texels.y) + 0.44444445) * 1.6363636), 1.0)));
    float2 axis = ((difference < 0.0) ? float2(y, (turn - difference)) : float2((turn + difference), y));
    float rest = max((pair ? (sides.x - variance) : 0.0), 0.0);
    float reach = ((LTC_LOOKUP_PAIR_REACH * (rest * rsqrt(max(rest, LTC_TINY)))) * rsqrt(max(dot(axis, axis), LTC_TINY)));
    float stretch = (aspect * rsqrt(max(aspect, LTC_TINY)));
    float push = (1.0 + ((LTC_LOOKUP_PUSH + (12.580001 * variance)) * variance));
    lookup.place = clamp(((0.5).xx + ((middle - (0.5).xx) * push)), (0.0).xx, (1.0).xx);
    lookup.apart = (reach * float2((axis.x / stretch), (axis.y * stretch)));
    lookup.level = level;
    LtcLookup _e265 = lookup;
    const LtcLookup ltclookup = _e265;
    return ltclookup;
}
#endif

#if (LTC_ANISOTROPIC && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_TEXTURED) || (LTC_GGX && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// The look-up for a lobe on the rectangle of the corners `a`, `b` and `d`; `toward` is the vector form factor
// in the lobe's space. See above for the other parameters.
LtcLookup ltc_rectangle_lookup(LtcSurface surface, LtcLobe lobe, float3 a, float3 b, float3 d, float3 toward, float2 texels, bool pair)
{
    const float _e8 = ltc_rectangle_scale(surface, a, b, d);
    float3 corner = (((d * LTC_HEADROOM) - (surface.position * LTC_HEADROOM)) * _e8);
    float3 edge_u = (((b * LTC_HEADROOM) - (a * LTC_HEADROOM)) * _e8);
    float3 edge_v = (((a * LTC_HEADROOM) - (d * LTC_HEADROOM)) * _e8);
    const float3 _e28 = ltc_direction(toward);
    float3 rise = float3(dot(lobe.axis_z, edge_u), dot(lobe.axis_z, edge_v), _e28.z);
    const float3 _e36 = ltc_transform_normal(lobe, cross(edge_u, edge_v));
    const float3 _e38 = ltc_transform_normal(lobe, cross(edge_v, corner));
    const float3 _e40 = ltc_transform_normal(lobe, cross(corner, edge_u));
    const float3 _e41 = ltc_transform(lobe, corner);
    const LtcLookup _e43 = ltc_lookup(_e28, rise, _e38, _e40, _e36, dot(_e41, _e36), texels, pair);
    const LtcLookup ltclookup = _e43;
    return ltclookup;
}
#endif

#if LTC_TEXTURED
// The look-up for diffuse light; `toward` is the vector form factor in the caller's space.
LtcLookup ltc_rectangle_diffuse_lookup(LtcSurface surface, float3 a, float3 b, float3 d, float3 toward, float2 texels, bool pair)
{
    const float _e7 = ltc_rectangle_scale(surface, a, b, d);
    float3 corner = (((d * LTC_HEADROOM) - (surface.position * LTC_HEADROOM)) * _e7);
    float3 edge_u = (((b * LTC_HEADROOM) - (a * LTC_HEADROOM)) * _e7);
    float3 edge_v = (((a * LTC_HEADROOM) - (d * LTC_HEADROOM)) * _e7);
    const float3 _e27 = ltc_direction(toward);
    float3 rise = float3(dot(surface.normal, edge_u), dot(surface.normal, edge_v), dot(surface.normal, _e27));
    float3 normal_15 = cross(edge_u, edge_v);
    const LtcLookup _e39 = ltc_lookup(_e27, rise, cross(edge_v, corner), cross(corner, edge_u), normal_15, dot(corner, normal_15), texels, pair);
    const LtcLookup ltclookup = _e39;
    return ltclookup;
}
#endif

#if LTC_TEXTURED
// The picture's colour at a look-up with one sample.
float4 ltc_texture_fetch(Texture2D<float4> picture, SamplerState picture_sampler, LtcLookup lookup)
{
    float4 _e5 = picture.SampleLevel(picture_sampler, lookup.place, lookup.level);
    return _e5;
}
#endif

#if LTC_TEXTURED
// The picture's colour at a look-up with a pair of samples.
float4 ltc_texture_fetch_pair(Texture2D<float4> picture, SamplerState picture_sampler, LtcLookup lookup)
{
    float4 first = picture.SampleLevel(picture_sampler, (lookup.place + lookup.apart), lookup.level);
    float4 second = picture.SampleLevel(picture_sampler, (lookup.place - lookup.apart), lookup.level);
    return (0.5 * (first + second));
}
#endif

#if (LTC_ANISOTROPIC && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ANISOTROPIC && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_GGX && LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && !LTC_SECOND_LOBE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && LTC_SECOND_LOBE && LTC_TEXTURED) || (!LTC_SECOND_LOBE && LTC_SHEEN && LTC_TEXTURED) || (LTC_SECOND_LOBE && LTC_SHEEN && LTC_TEXTURED)
// What one lobe sees of a rectangle that shows a picture; see ltc_rectangle_lookup.
LtcSeen ltc_lobe_picture(LtcSurface surface, LtcQuad quad, LtcLobe lobe, float3 a, float3 b, float3 d, Texture2D<float4> picture, SamplerState picture_sampler, float2 texels)
{
    LtcSeen seen = (LtcSeen)0;

    const float3 _e9 = ltc_quad_lobe(quad, lobe);
    const LtcLookup _e11 = ltc_rectangle_lookup(surface, lobe, a, b, d, _e9, texels, false);
    const float4 _e14 = ltc_texture_fetch(picture, picture_sampler, _e11);
    seen.colour = _e14.xyz;
    const float2 _e17 = ltc_lobes_part(surface, lobe, _e9);
    seen.value = _e17;
    LtcSeen _e18 = seen;
    const LtcSeen ltcseen = _e18;
    return ltcseen;
}
#endif

#if (LTC_ANISOTROPIC && LTC_TEXTURED) || (LTC_CLEARCOAT && LTC_TEXTURED) || (LTC_GGX && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_SHEEN && LTC_TEXTURED)
// What a sum of lobes sees of a rectangle that shows a picture; see ltc_rectangle_lookup.
LtcSeen ltc_quad_picture(LtcSurface surface, LtcQuad quad, LtcLobes lobes, float3 a, float3 b, float3 d, Texture2D<float4> picture, SamplerState picture_sampler, float2 texels)
{
    LtcSeen seen = (LtcSeen)0;
    LtcLobe lobe = (LtcLobe)0;
    LtcShape shape = (LtcShape)0;
    int index = int(1);

#if !LTC_SECOND_LOBE
    if (!(ltc_use_second_lobe)) {
        const LtcSeen _e13 = ltc_lobe_picture(surface, quad, lobes.first, a, b, d, picture, picture_sampler, texels);
        seen = _e13;
    }
#endif
#if LTC_SECOND_LOBE
    if (ltc_use_second_lobe) {
        lobe = lobes.first;
        shape = lobes.second;
        while(true) {
            LtcLobe _e21 = lobe;
            const LtcSeen _e22 = ltc_lobe_picture(surface, quad, _e21, a, b, d, picture, picture_sampler, texels);
            float2 _e24 = seen.value;
            seen.value = (_e24 + _e22.value);
            float3 _e28 = seen.colour;
            float3 _e31 = seen.colour;
            float _e37 = seen.value.x;
            seen.colour = (_e28 + ((_e22.colour - _e31) * (_e22.value.x / max(_e37, LTC_TINY))));
            int _e43 = index;
            if ((_e43 >= lobes.count)) {
                break;
            }
            LtcShape _e46 = shape;
            const LtcLobe _e47 = ltc_shape_lobe(surface, _e46);
            lobe = _e47;
#if LTC_THIRD_LOBE
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
#endif
            int _e50 = index;
            index = asint(asuint(_e50) + asuint(int(1)));
        }
    }
#endif
    LtcSeen _e53 = seen;
    const LtcSeen ltcseen = _e53;
    return ltcseen;
}
#endif

#if LTC_CLEARCOAT || LTC_ROUGH_DIFFUSE || LTC_SHEEN
// The same surface point and frame with another roughness, which is clamped as in ltc_surface: that of
// a sheen, a coat or a diffuse part.
LtcSurface ltc_surface_with_roughness(LtcSurface surface, float roughness_1)
{
    LtcSurface other = (LtcSurface)0;

    other = surface;
    other.roughness = clamp(roughness_1, LTC_ROUGHNESS_FLOOR, 1.0);
    float _e9 = other.roughness;
    float _e11 = other.roughness;
    other.alpha = (_e9 * _e11);
    LtcSurface _e13 = other;
    const LtcSurface ltcsurface = _e13;
    return ltcsurface;
}
#endif

#if LTC_SHEEN
// The lobe of a sheen of colour 1 from its texel (X, Z, W, albedo), with t the angle between normal
// and view and r the surface's roughness, which is the sheen's:
//     x = X      z = sin t Z / r
//     y = 0      w = W / r
// The model is that of Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF", with Smith's
// shadowing; the texels are the fit `softbox::fit::bake` with `softbox::fit::Settings::sheen`. Their albedo,
// and with it the light of a whole room, is right to half precision where the roughness is 0.2 or more. One
// lobe is a coarse likeness of light that comes back and light that goes on along the horizon: on random
// quads the mean error is 9 per cent of the mean value, 6 to 14 by roughness and view.
LtcLobe ltc_sheen_lobe(LtcSurface surface, float4 texel)
{
    float reach = (1.0 / max(surface.roughness, LTC_SHEEN_ROUGHNESS_FLOOR));
    const LtcLobe _e18 = ltc_planar_lobe(surface, float4(texel.x, 0.0, ((surface.sin_view * texel.y) * reach), (texel.z * reach)), texel.w, 0.0);
    const LtcLobe ltclobe = _e18;
    return ltclobe;
}
#endif

#if LTC_SHEEN
// ltc_sheen_lobe from the given layer of the table's texture array.
LtcLobe ltc_sheen_lobe_from_table(LtcSurface surface, Texture2DArray<float4> table, SamplerState table_sampler, float table_size, int layer)
{
    const float2 _e5 = ltc_table_coordinates(surface, table_size);
    float4 _e7 = table.SampleLevel(table_sampler, float3(_e5, layer), 0.0);
    const LtcLobe _e8 = ltc_sheen_lobe(surface, _e7);
    const LtcLobe ltclobe = _e8;
    return ltclobe;
}
#endif

#if LTC_SHEEN
// Radiance of a surface under a sheen of `sheen_colour` (each channel 0 to 1): `base` is the radiance
// without it, `value` the light's for the lobe `sheen`. Call it with the sum over all lights, or for
// each of them. The base is dimmed alike in all channels, so that it keeps its hue.
float3 ltc_sheen_over(float3 base, LtcLobe sheen, float3 value, float3 sheen_colour)
{
    float strongest = max(max(sheen_colour.x, sheen_colour.y), sheen_colour.z);
    return ((base * max((1.0 - (strongest * sheen.albedo)), 0.0)) + (sheen_colour * value.y));
}
#endif

#if LTC_ROUGH_DIFFUSE
// The lobe of what a rough diffuse surface of colour 1 reflects at the first bounce, from its texel
// (Y, Z, W, albedo), with t the angle between normal and view:
//     x = 1            z = sin t Z
//     y = sin t Y      w = W
// The surface's roughness is the diffuse one as the model takes it, not squared. The model is that of
// Portsmouth, Kutz and Hill 2025, "EON: A practical energy-preserving rough diffuse BRDF"; the texels are
// the fit `softbox::fit::bake` with `softbox::fit::Settings::diffuse`. On random quads the mean error is
// 1.4 per cent of the mean value, up to 5 at grazing views.
LtcLobe ltc_diffuse_lobe(LtcSurface surface, float4 texel)
{
    float s = surface.sin_view;
    const LtcLobe _e12 = ltc_planar_lobe(surface, float4(1.0, (s * texel.x), (s * texel.y), texel.z), texel.w, 0.0);
    const LtcLobe ltclobe = _e12;
    return ltclobe;
}
#endif

#if LTC_ROUGH_DIFFUSE
// ltc_diffuse_lobe from the given layer of the table's texture array.
LtcLobe ltc_diffuse_lobe_from_table(LtcSurface surface, Texture2DArray<float4> table, SamplerState table_sampler, float table_size, int layer)
{
    const float2 _e5 = ltc_table_coordinates(surface, table_size);
    float4 _e7 = table.SampleLevel(table_sampler, float3(_e5, layer), 0.0);
    const LtcLobe _e8 = ltc_diffuse_lobe(surface, _e7);
    const LtcLobe ltclobe = _e8;
    return ltclobe;
}
#endif

#if LTC_ROUGH_DIFFUSE
// Reflected radiance of a rough diffuse surface of the given colour (each channel 0 to 1), from the
// value (diffuse, lobe, -) of a light of unit radiance for ltc_diffuse_lobe's lobe. It takes the place
// of colour times diffuse.
//
// What leaves at a later bounce has lost its direction: it is Lambert's form factor, with the albedo
// that the first bounce leaves over, so a white surface reflects all light. Its colour is the sum of the
// bounces, m the mean albedo of the first one:
//     colour^2 m / (1 - colour (1 - m))
// The model lets later bounces leave less at grazing angles; their mean in place of that keeps the energy
// for each view, and the mean error for a white surface is 2.1 per cent in place of 1.4.
float3 ltc_rough_diffuse(LtcSurface surface, LtcLobe lobe, float3 value, float3 colour)
{
    float mean_albedo = ((1.0 + (0.07248821 * surface.roughness)) / (1.0 + (0.2877934 * surface.roughness)));
    float3 series = max(((1.0).xxx - (colour * (1.0 - mean_albedo))), (0.5).xxx);
    float3 later = (((colour * colour) * mean_albedo) / series);
    return ((colour * value.y) + (later * ((1.0 - lobe.albedo) * value.x)));
}
#endif

#if LTC_CLEARCOAT
// Share of the light that reaches the base below a clear coat: 1 - weight * (directional albedo of the
// coat for this view). `coat` is the coat's lobe from ltc_lobe, `reflectance` its F0 (0.04 for the usual
// index of 1.5), its F90 is 1; `weight` is the share of the surface that it covers, 0 to 1.
float ltc_coat_transmission(LtcLobe coat, float reflectance, float weight)
{
    return clamp((1.0 - (weight * ((reflectance * (coat.albedo - coat.fresnel)) + coat.fresnel))), 0.0, 1.0);
}
#endif

#if LTC_CLEARCOAT
// Radiance of a surface under a clear coat: `base` is the radiance without it, `value` the light's for
// the lobe `coat`. In light of the same radiance from everywhere a base that reflects all of it does so
// under its coat, too, whatever that one's weight and roughness.
float3 ltc_coat_over(float3 base, LtcLobe coat, float3 value, float reflectance, float weight)
{
    float gloss = (weight * ((reflectance * (value.y - value.z)) + value.z));
    const float _e12 = ltc_coat_transmission(coat, reflectance, weight);
    return ((base * _e12) + (gloss).xxx);
}
#endif

#if LTC_ENERGY_COMPENSATION
// Factor on the reflected radiance of a rough metal that makes up for the light which a single bounce
// between its facets loses: 1 + F0 (1 / albedo - 1) (Turquin 2019, "Practical multiple scattering
// compensation for microfacet models", after Kulla and Conty 2017). A white metal, F0 = 1, then
// reflects all light; for a dielectric the factor is close to 1.
float3 ltc_energy_compensation(LtcLobe lobe, float3 normal_reflectance)
{
    return ((1.0).xxx + (normal_reflectance * ((1.0 / max(lobe.albedo, LTC_ALBEDO_FLOOR)) - 1.0)));
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// 1 - E for an imaginary angle: 1 - w / sinh w from k = cosh w - 1, not negative. The error is below 2e-7.
// The coefficients are the minimax fit `softbox::fit::fit_hyperbolic_excess` of degree 5; the logarithm's
// argument is at least 3.7, where WGSL guarantees it to 3 ULP.
float ltc_hyperbolic_deficit(float k)
{
    if ((k < 1.0)) {
        float high = ((((0.001350465 * k) - 0.0076216036) * k) + 0.023172159);
        return -((((((((high * k) - 0.05646018) * k) + 0.13323359) * k) - 0.33332837) * k));
    }
    float bounded = min(k, 1e18);
    float square = (bounded * (bounded + 2.0));
    float inverse_sine = rsqrt(square);
    return (1.0 - (log(((bounded + 1.0) + (square * inverse_sine))) * inverse_sine));
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// Cosine and sine of the angle by which to turn the first of two conjugate semi-axes to the longer axis of their
// ellipse: half the angle of the vector (`difference`, `product`) of half the difference of their squares and
// their scalar product.
float2 ltc_half_turn(float difference, float product)
{
    float square = ((difference * difference) + (product * product));
    float inverse_length = rsqrt(max(square, 1e-30));
    bool circular = (square < 1e-30);
    float cosine = (circular ? 1.0 : (abs(difference) * inverse_length));
    float sine = (circular ? 0.0 : (product * inverse_length));
    float large_square = (0.5 + (0.5 * cosine));
    float inverse_large = rsqrt(large_square);
    float large = (large_square * inverse_large);
    float small = ((0.5 * sine) * inverse_large);
    return ((difference >= 0.0) ? float2(large, small) : float2(small, large));
}
#endif

#if LTC_DISK || LTC_SPHERE
// The plane with the unit vector `normal` as it cuts the ellipse with the semi-axes `half_x` and `half_y` times
// `size` around `centre`.
LtcCut ltc_cut(float3 normal_9, float3 half_x, float3 half_y, float size, float3 centre)
{
    LtcCut cut = (LtcCut)0;

    float2 slope = float2(dot(normal_9, half_x), dot(normal_9, half_y));
    float square = dot(slope, slope);
    float inverse_slope = rsqrt(max(square, LTC_TINY));
    cut.normal = normal_9;
    cut.height = dot(normal_9, centre);
    cut.toward = (slope * inverse_slope);
    cut.steepness = ((size * square) * inverse_slope);
    float _e23 = cut.height;
    float _e26 = cut.steepness;
    cut.offset = clamp((-(_e23) / max(_e26, LTC_TINY)), -1000000000.0, 1000000000.0);
    float _e34 = cut.offset;
    float bounded = clamp(_e34, -1.0, 1.0);
    float reach_square = ((1.0 - bounded) * (1.0 + bounded));
    cut.reach = (reach_square * rsqrt(max(reach_square, LTC_TINY)));
    float _e50 = cut.toward.x;
    float _e54 = cut.toward.y;
    float3 middle = (centre + (((half_x * _e50) + (half_y * _e54)) * (size * bounded)));
    float _e62 = cut.toward.y;
    float _e66 = cut.toward.x;
    float3 along = (((half_x * _e62) - (half_y * _e66)) * size);
    cut.moment = max(dot(normal_9, cross(middle, along)), 0.0);
    LtcCut _e75 = cut;
    const LtcCut ltccut = _e75;
    return ltccut;
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// One step of Laguerre's iteration towards the largest root of x^3 + `quadratic` x^2 + `linear` x + `absolute`, all
// of whose roots are real.
float ltc_cone_step(float x, float quadratic, float linear_, float absolute)
{
    float value = (((((x + quadratic) * x) + linear_) * x) + absolute);
    float slope = ((((3.0 * x) + (2.0 * quadratic)) * x) + linear_);
    float bend = ((6.0 * x) + (2.0 * quadratic));
    float under = max((((4.0 * slope) * slope) - ((6.0 * value) * bend)), 0.0);
    float root = (under * rsqrt(max(under, LTC_TINY)));
    return (x - ((3.0 * value) / max((slope + root), LTC_TINY)));
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The cone over the ellipse with the semi-axes `half_x` and `half_y` times `size` around `centre`. `normal` is the
// cross product of the two, `volume` its scalar product with the centre, which must not be negative.
LtcCone ltc_cone(float3 half_x_1, float3 half_y_1, float size, float3 centre_1, float3 normal, float volume)
{
    LtcCone cone = (LtcCone)0;
    float depth = (float)0;

    const float2 _e12 = ltc_half_turn((0.5 * (dot(half_x_1, half_x_1) - dot(half_y_1, half_y_1))), dot(half_x_1, half_y_1));
    float3 longest = ((half_x_1 * _e12.x) + (half_y_1 * _e12.y));
    float long_square = dot(longest, longest);
    float long_inverse = rsqrt(max(long_square, LTC_TINY));
    float normal_square = dot(normal, normal);
    float normal_inverse = rsqrt(max(normal_square, 1e-30));
    float aspect = min((((normal_square * normal_inverse) * long_inverse) * long_inverse), 1.0);
    float long_half = ((size * long_square) * long_inverse);
    cone.scale = rsqrt(max((dot(centre_1, centre_1) + (long_half * long_half)), LTC_TINY));
    cone.first = (longest * long_inverse);
    cone.third = (normal * normal_inverse);
    float3 _e47 = cone.third;
    float3 _e49 = cone.first;
    cone.second = cross(_e47, _e49);
    float _e53 = cone.scale;
    cone.half_x = (half_x_1 * (size * _e53));
    float _e58 = cone.scale;
    cone.half_y = (half_y_1 * (size * _e58));
    float _e63 = cone.scale;
    cone.centre = (centre_1 * _e63);
    float3 _e67 = cone.centre;
    float3 _e69 = cone.first;
    float3 _e72 = cone.centre;
    float3 _e74 = cone.second;
    float _e78 = cone.scale;
    cone.place = float3(dot(_e67, _e69), dot(_e72, _e74), ((volume * normal_inverse) * _e78));
    float _e82 = cone.scale;
    float a = min((long_half * _e82), 1.0);
    float b = (a * aspect);
    float3 _e88 = cone.place;
    float3 _e90 = cone.place;
    float3 p = (_e88 * _e90);
    float2 s = float2((a * a), (b * b));
    cone.first_square = s.x;
    cone.second_square = s.y;
    float aspect_square = (aspect * aspect);
    float joint = ((p.x * aspect_square) + p.y);
    float ratio = (joint / max((((p.x * aspect_square) * aspect_square) + p.y), LTC_TINY));
    float pole = min((s.y * ratio), s.x);
    float weight = min((joint * ratio), (p.x + p.y));
    float middle = (0.5 * ((weight + p.z) - pole));
    float under = ((middle * middle) + (p.z * pole));
    float root = (under * rsqrt(max(under, LTC_TINY)));
    float lowest = ((middle > 0.0) ? (middle + root) : (p.z * min((pole / max((root - middle), LTC_TINY)), 1e19)));
    float highest = ((p.x + p.y) + p.z);
    float quadratic = ((s.x + s.y) - highest);
    float linear_1 = ((s.y * ((s.x - p.x) - p.z)) - (s.x * (p.y + p.z)));
    float absolute = ((-(p.z) * s.x) * s.y);
    depth = lowest;
    if ((aspect < 0.9999)) {
        float _e177 = depth;
        const float _e178 = ltc_cone_step(_e177, quadratic, linear_1, absolute);
        depth = min(max(_e178, lowest), highest);
        float _e181 = depth;
        const float _e182 = ltc_cone_step(_e181, quadratic, linear_1, absolute);
        depth = min(max(_e182, lowest), highest);
        float _e185 = depth;
        const float _e186 = ltc_cone_step(_e185, quadratic, linear_1, absolute);
        depth = min(max(_e186, lowest), highest);
    }
    float _e190 = depth;
    cone.depth = max(_e190, LTC_SHALLOWEST);
    float _e195 = cone.depth;
    float inverse_x = (1.0 / (s.x + _e195));
    float _e201 = cone.depth;
    float inverse_y = (1.0 / (s.y + _e201));
    float _e207 = cone.place.x;
    float _e209 = cone.depth;
    float _e216 = cone.place.y;
    float _e218 = cone.depth;
    float _e225 = cone.place.z;
    float3 toward = float3((_e207 * min((_e209 * inverse_x), 1.0)), (_e216 * min((_e218 * inverse_y), 1.0)), _e225);
    cone.nearness = rsqrt(max(dot(toward, toward), 1e-30));
    float _e234 = cone.nearness;
    cone.axis = (toward * _e234);
    float _e238 = cone.depth;
    float _e242 = cone.depth;
    float spread = rsqrt(((s.x + _e238) * (s.y + _e242)));
    float _e249 = cone.place.z;
    float _e251 = cone.nearness;
    cone.whole = min(((_e249 * _e251) * ((a * b) * spread)), 1.0);
    float _e261 = cone.place.x;
    float _e267 = cone.place.y;
    float2 pierced = float2(((-(a) * _e261) * inverse_x), ((-(b) * _e267) * inverse_y));
    cone.pierced_x = ((pierced.x * _e12.x) - (pierced.y * _e12.y));
    cone.pierced_y = ((pierced.x * _e12.y) + (pierced.y * _e12.x));
    LtcCone _e287 = cone;
    const LtcCone ltccone = _e287;
    return ltccone;
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// `v` in the cone's frame.
float3 ltc_cone_inward(LtcCone cone, float3 v)
{
    return float3(dot(cone.first, v), dot(cone.second, v), dot(cone.third, v));
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// `v`, given in the cone's frame, in the space that the cone is in.
float3 ltc_cone_outward(LtcCone cone, float3 v)
{
    return (((cone.first * v.x) + (cone.second * v.y)) + (cone.third * v.z));
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The point of the ellipse's plane at `p`, in units of the semi-axes given.
float3 ltc_cone_point(LtcCone cone, float2 p)
{
    return ((cone.centre + (cone.half_x * p.x)) + (cone.half_y * p.y));
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// A cut's moment in a cone's units, where it is at most 1 but for rounding.
float ltc_cone_moment(LtcCone cone, LtcCut cut)
{
    return min((cut.moment * (cone.scale * cone.scale)), 2.0);
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// Cosine between the cone's axis and a plane's normal.
float ltc_cone_tilt(LtcCone cone, LtcCut cut)
{
    float rise = (((cone.pierced_x * cut.toward.x) + (cone.pierced_y * cut.toward.y)) * cut.steepness);
    float distant = (((cut.height + rise) * cone.scale) * cone.nearness);
    const float3 _e21 = ltc_cone_inward(cone, cut.normal);
    return ((cone.first_square < 0.06) ? distant : dot(cone.axis, _e21));
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The axes across a cone. With W = diag(a^2 + m, b^2 + m, m), D + m = W^1/2 (1 - g g^T) W^1/2 for the unit vector
// g = W^-1/2 c, so the remaining eigenvalues are those of diag(a^2, b^2, 0) restricted to the plane across g: a
// matrix of two by two whose entries are sums of positive terms.
LtcAcross ltc_cone_across(LtcCone cone)
{
    LtcAcross across = (LtcAcross)0;

    float a_square = cone.first_square;
    float b_square = cone.second_square;
    float3 w = float3((a_square + cone.depth), (b_square + cone.depth), cone.depth);
    float3 inverse_root = rsqrt(w);
    float3 weighted = (cone.place * inverse_root);
    float3 g = (weighted * rsqrt(max(dot(weighted, weighted), 1e-6)));
    float q = (-1.0 / (1.0 + g.z));
    float3 u = float3((1.0 + ((g.x * g.x) * q)), ((g.x * g.y) * q), -(g.x));
    float3 v = float3(((g.x * g.y) * q), (1.0 + ((g.y * g.y) * q)), -(g.y));
    float u_square = (((a_square * u.x) * u.x) + ((b_square * u.y) * u.y));
    float v_square = (((a_square * v.x) * v.x) + ((b_square * v.y) * v.y));
    float product = (((a_square * u.x) * v.x) + ((b_square * u.y) * v.y));
    float scale = (1.0 / max((u_square + v_square), LTC_TINY));
    const float2 _e88 = ltc_half_turn(((0.5 * scale) * (u_square - v_square)), clamp((scale * product), -1.0, 1.0));
    float3 wide = ((u * _e88.x) + (v * _e88.y));
    float3 first_7 = ((wide * w) * inverse_root);
    across.first = (first_7 * rsqrt(max(dot(first_7, first_7), LTC_TINY)));
    across.first_value = (((a_square * wide.x) * wide.x) + ((b_square * wide.y) * wide.y));
    float3 _e116 = across.first;
    across.second = cross(cone.axis, _e116);
    float _e120 = across.first_value;
    float _e132 = across.first_value;
    across.second_value = min(((a_square * min((b_square / max(_e120, LTC_TINY)), 1.0)) * (g.z * g.z)), _e132);
    LtcAcross _e134 = across;
    const LtcAcross ltcacross = _e134;
    return ltcacross;
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The integral along an arc, less a vector along `normal` whose length is the sine below and of which `rest` gives
// back a part; components along the axes across the cone and its own. The arc's chord spans the plane with the unit
// vector `normal` (components along the same axes), `sine` is the sine of the angle between its ends, `k` that
// angle's 1 - cosine, `ratio` the h of the formula above; `large` tells an arc of more than half the cone.
float3 ltc_cone_sweep(LtcCone cone, LtcAcross across, float3 normal, float sine, float k, float ratio, bool large, float rest)
{
    float second = (float)0;

    const float _e13 = ltc_hyperbolic_deficit(max(((ratio * across.first_value) - k), 0.0));
    float first = (rest + (sine * _e13));
    float second_k = clamp((k - (ratio * across.second_value)), 0.0, 2.0);
    const float _e25 = ltc_angle_excess(min(second_k, (2.0 - second_k)));
    second = ((rest - (sine * _e25)) * normal.y);
    if ((second_k > 1.0)) {
        float factor_square = (((across.first_value - across.second_value) * (cone.depth + across.second_value)) / max((cone.depth * across.first_value), LTC_TINY));
        float lesser_1 = (sine * abs(normal.y));
        float angle = max(((LTC_PI * rsqrt(max(factor_square, LTC_TINY))) - (lesser_1 * (1.0 + _e25))), 0.0);
        second = (((rest + sine) * normal.y) - ((normal.y < 0.0) ? -(angle) : angle));
    }
    float axis_k = min((k + (ratio * cone.depth)), 2.0);
    float lesser_2 = min((sine * abs(normal.z)), cone.whole);
    const float _e82 = ltc_angle_excess(min(axis_k, (2.0 - axis_k)));
    float acute = (lesser_2 + (lesser_2 * _e82));
    float part = ((axis_k > 1.0) ? ((LTC_PI * cone.whole) - acute) : acute);
    float _e94 = second;
    return float3((first * normal.x), _e94, (large ? ((6.2831855 * cone.whole) - part) : part));
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || LTC_DISK || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// Vector form factor, times 2 pi, of the part of a cone on the side of a plane that counts; in w its component along
// the plane's normal, which has more digits for a distant light.
float4 ltc_cone_part(LtcCone cone, LtcAcross across, LtcCut cut)
{
    const float3 _e6 = ltc_cone_point(cone, (cut.toward * cut.offset));
    float3 along = (((cone.half_x * cut.toward.y) - (cone.half_y * cut.toward.x)) * cut.reach);
    float3 start_point = (_e6 + along);
    float3 end_point = (_e6 - along);
    float start_inverse = rsqrt(max(dot(start_point, start_point), LTC_TINY));
    float end_inverse = rsqrt(max(dot(end_point, end_point), LTC_TINY));
    float both = min((start_inverse * end_inverse), LTC_NEAREST_PAIR);
    float3 start = (start_point * start_inverse);
    float3 end = (end_point * end_inverse);
    const float _e36 = ltc_cone_moment(cone, cut);
    float sine = min((((2.0 * cut.reach) * _e36) * both), 1.0);
    float3 side = (start - end);
    float far_k = (0.5 * dot(side, side));
    float k = ((far_k > 1.0) ? far_k : ((sine * sine) / max((2.0 - far_k), 1.0)));
    const float _e58 = ltc_angle_excess(min(k, saturate((2.0 - k))));
    float excess = (sine * _e58);
    float rest = ((k > 1.0) ? ((LTC_PI - (2.0 * sine)) - excess) : excess);
    const float _e68 = ltc_cone_tilt(cone, cut);
    const float3 _e70 = ltc_cone_inward(cone, cut.normal);
    float3 normal_16 = float3(dot(_e70, across.first), dot(_e70, across.second), _e68);
    const float3 _e84 = ltc_cone_sweep(cone, across, normal_16, sine, k, (((2.0 * cut.reach) * cut.reach) * both), (_e68 >= 0.0), rest);
    float3 sum = float3(_e84.xy, (_e84.z + (_e68 * (rest + sine))));
    float3 turned = (((across.first * sum.x) + (across.second * sum.y)) + (cone.axis * sum.z));
    const float3 _e102 = ltc_cone_outward(cone, turned);
    return float4(_e102, dot(normal_16, sum));
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The point of a plane's chord at `s` from its middle, in the circle's plane.
float2 ltc_cut_point(LtcCut cut, float s)
{
    return ((cut.toward * cut.offset) + (float2(cut.toward.y, -(cut.toward.x)) * s));
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The edge integral of the part of a plane's chord between two points of the circle's plane.
float3 ltc_cone_chord(LtcCone cone, LtcCut cut, float2 start, float2 end)
{
    const float3 _e4 = ltc_cone_point(cone, start);
    const float3 _e5 = ltc_cone_point(cone, end);
    float a_inverse = rsqrt(max(dot(_e4, _e4), LTC_TINY));
    float b_inverse = rsqrt(max(dot(_e5, _e5), LTC_TINY));
    float2 along = (end - start);
    float square = dot(along, along);
    const float _e20 = ltc_cone_moment(cone, cut);
    float sine = (((square * rsqrt(max(square, LTC_TINY))) * _e20) * min((a_inverse * b_inverse), LTC_NEAREST_PAIR));
    const float _e29 = ltc_angle((_e4 * a_inverse), (_e5 * b_inverse), sine);
    return (cut.normal * _e29);
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The integral along the arc between two points of the circle, counter-clockwise. `nearly_full` tells an arc of all
// but the whole circle from one of next to nothing.
float3 ltc_cone_arc(LtcCone cone, LtcAcross across, float2 start, float2 end, bool nearly_full)
{
    const float3 _e5 = ltc_cone_point(cone, start);
    const float3 _e6 = ltc_cone_point(cone, end);
    float a_inverse = rsqrt(max(dot(_e5, _e5), LTC_TINY));
    float b_inverse = rsqrt(max(dot(_e6, _e6), LTC_TINY));
    float both = min((a_inverse * b_inverse), LTC_NEAREST_PAIR);
    float2 back = (start - end);
    float back_square = dot(back, back);
    const float3 _e27 = ltc_edge_normal(_e6, _e5, ((cone.half_x * back.x) + (cone.half_y * back.y)));
    const float3 _e28 = ltc_cone_inward(cone, _e27);
    float product_square = dot(_e28, _e28);
    float product_inverse = rsqrt(max(product_square, LTC_TINY));
    float3 normal = (float3(dot(_e28, across.first), dot(_e28, across.second), dot(_e28, cone.axis)) * product_inverse);
    float sine = min(((product_square * product_inverse) * both), 1.0);
    float3 side = ((_e5 * a_inverse) - (_e6 * b_inverse));
    bool large = ((back_square < 1e-9) ? nearly_full : (normal.z >= 0.0));
    const float3 _e61 = ltc_cone_sweep(cone, across, normal, sine, (0.5 * dot(side, side)), ((0.5 * back_square) * both), large, -(sine));
    const float3 _e73 = ltc_cone_outward(cone, (((across.first * _e61.x) + (across.second * _e61.y)) + (cone.axis * _e61.z)));
    return _e73;
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// Vector form factor, times 2 pi, of the part of a cone on the sides of two planes that count, where the chords of
// the two cross.
float3 ltc_cone_between(LtcCone cone, LtcAcross across, LtcCut a, LtcCut b)
{
    float2 apart = (b.toward - a.toward);
    float sine = ((a.toward.x * apart.y) - (a.toward.y * apart.x));
    bool turned = (sine > 0.0);
    float bounded = max(abs(sine), 1e-20);
    float rest = ((a.offset - b.offset) - (a.offset * (0.5 * dot(apart, apart))));
    const float2 _e37 = ltc_cut_point(a, clamp((rest / (turned ? bounded : -(bounded))), -(a.reach), a.reach));
    const float2 _e42 = ltc_cut_point(a, (turned ? -(a.reach) : a.reach));
    const float2 _e47 = ltc_cut_point(b, (turned ? b.reach : -(b.reach)));
    const float3 _e50 = ltc_cone_chord(cone, a, (turned ? _e42 : _e37), (turned ? _e37 : _e42));
    const float3 _e53 = ltc_cone_chord(cone, b, (turned ? _e37 : _e47), (turned ? _e47 : _e37));
    const float3 _e61 = ltc_cone_arc(cone, across, (turned ? _e47 : _e42), (turned ? _e42 : _e47), ((a.offset + b.offset) < -1.0));
    return ((_e50 + _e53) + _e61);
}
#endif

#if LTC_DISK
// Places an elliptical disk over a surface; see ltc_disk.
LtcDisk ltc_disk_begin(LtcSurface surface, float3 centre_2, float3 half_x_2, float3 half_y_2, bool two_sided)
{
    LtcDisk disk = (LtcDisk)0;

    float3 away = ((centre_2 * LTC_HEADROOM) - (surface.position * LTC_HEADROOM));
    float3 x_far = (half_x_2 * LTC_HEADROOM);
    float3 y_far = (half_y_2 * LTC_HEADROOM);
    const float _e15 = ltc_extent(x_far);
    const float _e16 = ltc_extent(y_far);
    float width = max(_e15, _e16);
    const float _e18 = ltc_extent(away);
    float scale = (1.0 / max(max(_e18, width), LTC_TINY));
    float shrink = (1.0 / max(width, LTC_TINY));
    float3 x = (x_far * shrink);
    float3 y = (y_far * shrink);
    float3 normal_18 = cross(x, y);
    disk.centre = (away * scale);
    disk.size = min((width * scale), 1.0);
    float3 _e39 = disk.centre;
    float volume_2 = dot(normal_18, _e39);
    bool front = (volume_2 < 0.0);
    disk.half_x = (front ? y : x);
    disk.half_y = (front ? x : y);
    disk.normal = (front ? -(normal_18) : normal_18);
    disk.volume = abs(volume_2);
    float3 _e55 = disk.half_x;
    float3 _e57 = disk.half_y;
    float _e59 = disk.size;
    float3 _e61 = disk.centre;
    const LtcCut _e62 = ltc_cut(surface.normal, _e55, _e57, _e59, _e61);
    disk.cut = _e62;
    float _e66 = disk.cut.offset;
    disk.clipped = (_e66 > -1.0);
    bool is_line = (dot(normal_18, normal_18) <= LTC_TINY);
    float _e81 = disk.cut.offset;
    disk.reaches = (((front | ((two_sided & ltc_use_two_sided) & (volume_2 > 0.0))) & (_e81 < 1.0)) & !(is_line));
    LtcDisk _e87 = disk;
    const LtcDisk ltcdisk = _e87;
    return ltcdisk;
}
#endif

#if LTC_DISK
// The form factor of a disk, 0 to 1.
float ltc_disk_diffuse(LtcDisk disk)
{
    float value = (float)0;

    if (!(disk.reaches)) {
        return 0.0;
    }
    const LtcCone _e10 = ltc_cone(disk.half_x, disk.half_y, disk.size, disk.centre, disk.normal, disk.volume);
    const float _e13 = ltc_cone_tilt(_e10, disk.cut);
    value = (_e10.whole * _e13);
    if (disk.clipped) {
        const LtcAcross _e17 = ltc_cone_across(_e10);
        const float4 _e19 = ltc_cone_part(_e10, _e17, disk.cut);
        value = (_e19.w * LTC_OVER_TWO_PI);
    }
    float _e23 = value;
    return saturate(_e23);
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The vector form factor of a disk in a lobe's space, cut at both horizons, towards the light.
float3 ltc_disk_lobe(LtcDisk disk, LtcLobe lobe)
{
    LtcCut cut_6 = (LtcCut)0;
    float3 sum = (float3)0;

    if (!(disk.reaches)) {
        return (0.0).xxx;
    }
    const float3 _e7 = ltc_transform(lobe, disk.half_x);
    const float3 _e9 = ltc_transform(lobe, disk.half_y);
    const float3 _e11 = ltc_transform(lobe, disk.centre);
    const LtcCut _e17 = ltc_cut(float3(0.0, 0.0, 1.0), _e7, _e9, disk.size, _e11);
    if ((_e17.offset >= 1.0)) {
        return (0.0).xxx;
    }
    float volume_3 = dot(lobe.axis_x, lobe.normal_x);
    const float3 _e28 = ltc_transform_normal(lobe, disk.normal);
    const LtcCone _e31 = ltc_cone(_e7, _e9, disk.size, _e11, _e28, (volume_3 * disk.volume));
    const float3 _e33 = ltc_cone_outward(_e31, _e31.axis);
    float3 entire = (_e33 * _e31.whole);
    bool own_clips = (_e17.offset > -1.0);
    if (!((disk.clipped | own_clips))) {
        return float3(entire.xy, max(entire.z, 0.0));
    }
    const float3 _e49 = ltc_transform_normal(lobe, disk.cut.normal);
    float horizon_square = dot(_e49, _e49);
    float horizon_inverse = rsqrt(max(horizon_square, LTC_TINY));
    cut_6 = disk.cut;
    cut_6.normal = (_e49 * horizon_inverse);
    float _e60 = cut_6.height;
    cut_6.height = (_e60 * (volume_3 * horizon_inverse));
    float _e65 = cut_6.steepness;
    cut_6.steepness = (_e65 * (volume_3 * horizon_inverse));
    float _e70 = cut_6.moment;
    cut_6.moment = (_e70 * (horizon_square * horizon_inverse));
    bool twice = (disk.clipped & own_clips);
    float2 _e77 = cut_6.toward;
    float2 apart = (_e17.toward - _e77);
    float2 _e81 = cut_6.toward;
    float2 along = (_e17.toward + _e81);
    float _e85 = cut_6.offset;
    float difference = (_e17.offset - _e85);
    float _e89 = cut_6.offset;
    float total = (_e17.offset + _e89);
    float _e93 = cut_6.reach;
    float _e97 = cut_6.reach;
    float reaches = ((_e17.reach - _e93) * (_e17.reach - _e97));
    bool nested = (((difference * difference) + reaches) >= dot(apart, apart));
    bool opposite = ((((total * total) + reaches) >= dot(along, along)) & !(nested));
    if (((twice & opposite) & (total >= 0.0))) {
        return (0.0).xxx;
    }
    const LtcAcross _e116 = ltc_cone_across(_e31);
    if ((twice & !((nested | opposite)))) {
        LtcCut _e121 = cut_6;
        const float3 _e122 = ltc_cone_between(_e31, _e116, _e121, _e17);
        sum = _e122;
    } else {
        bool own_counts = (own_clips & (!(disk.clipped) | (nested & (difference >= 0.0))));
        if (own_counts) {
            cut_6 = _e17;
        }
        LtcCut _e130 = cut_6;
        const float4 _e131 = ltc_cone_part(_e31, _e116, _e130);
        sum = _e131.xyz;
        if ((twice & opposite)) {
            float3 _e134 = sum;
            const float4 _e135 = ltc_cone_part(_e31, _e116, _e17);
            sum = (_e134 + (_e135.xyz - (entire * 6.2831855)));
        }
    }
    float3 _e141 = sum;
    sum = (_e141 * LTC_OVER_TWO_PI);
    float3 _e144 = sum;
    float _e147 = sum.z;
    return float3(_e144.xy, max(_e147, 0.0));
}
#endif

#if (LTC_ANISOTROPIC && LTC_DISK) || (LTC_CLEARCOAT && LTC_DISK) || (LTC_DISK && LTC_GGX) || (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN)
// The parts (specular, fresnel) that a sum of lobes reflects of a disk of unit radiance.
float2 ltc_disk_specular(LtcSurface surface, LtcDisk disk, LtcLobes lobes)
{
    float2 value = (0.0).xx;
    LtcLobe lobe = (LtcLobe)0;
    LtcShape shape = (LtcShape)0;
    int index = int(1);

#if !LTC_SECOND_LOBE
    if (!(ltc_use_second_lobe)) {
        const float3 _e10 = ltc_disk_lobe(disk, lobes.first);
        const float2 _e11 = ltc_lobes_part(surface, lobes.first, _e10);
        value = _e11;
    }
#endif
#if LTC_SECOND_LOBE
    if (ltc_use_second_lobe) {
        lobe = lobes.first;
        shape = lobes.second;
        while(true) {
            float2 _e19 = value;
            LtcLobe _e20 = lobe;
            LtcLobe _e21 = lobe;
            const float3 _e22 = ltc_disk_lobe(disk, _e21);
            const float2 _e23 = ltc_lobes_part(surface, _e20, _e22);
            value = (_e19 + _e23);
            int _e25 = index;
            if ((_e25 >= lobes.count)) {
                break;
            }
            LtcShape _e28 = shape;
            const LtcLobe _e29 = ltc_shape_lobe(surface, _e28);
            lobe = _e29;
#if LTC_THIRD_LOBE
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
#endif
            int _e32 = index;
            index = asint(asuint(_e32) + asuint(int(1)));
        }
    }
#endif
    float2 _e35 = value;
    return _e35;
}
#endif

#if LTC_DISK
// The value (diffuse, specular, fresnel) of an elliptical disk light around `centre` with the semi-axes `half_x` and
// `half_y`, any two conjugate half-diameters. It emits to the side of their cross product (to both with `two_sided`).
//
// Error of the form factor against exact arithmetic: at most 1e-6, 2e-6 for a disk that all but touches the surface;
// at most 1e-4 of its value for one whose size is 1e-5 to a tenth of its distance. Where the rim itself passes by
// closely, 6e-7 times the ratio of the disk's size to that distance takes the place of 1e-6.
float3 ltc_disk(LtcSurface surface, LtcLobes lobes, float3 centre, float3 half_x, float3 half_y, bool two_sided)
{
    float2 specular = (0.0).xx;

    const LtcDisk _e6 = ltc_disk_begin(surface, centre, half_x, half_y, two_sided);
    if (!(_e6.reaches)) {
        return (0.0).xxx;
    }
#if LTC_GGX
    if (ltc_use_ggx) {
        const float2 _e15 = ltc_disk_specular(surface, _e6, lobes);
        specular = _e15;
    }
#endif
    const float _e16 = ltc_disk_diffuse(_e6);
    float2 _e17 = specular;
    return float3(_e16, _e17);
}
#endif

#if LTC_SPHERE
// Places a sphere over a surface; see ltc_sphere.
LtcSphere ltc_sphere_begin(LtcSurface surface, float3 centre_4, float radius)
{
    LtcSphere sphere = (LtcSphere)0;
    LtcDisk disk_4 = (LtcDisk)0;

    float3 away_far = ((centre_4 * LTC_HEADROOM) - (surface.position * LTC_HEADROOM));
    float radius_far = (abs(radius) * LTC_HEADROOM);
    const float _e12 = ltc_extent(away_far);
    float scale = (1.0 / max(max(_e12, radius_far), LTC_SMALLEST));
    float3 away = (away_far * scale);
    float ball = (radius_far * scale);
    float square = dot(away, away);
    float inverse_distance = rsqrt(max(square, LTC_TINY));
    float distance_ = (square * inverse_distance);
    float3 w = (away * inverse_distance);
    float sine = min((ball * inverse_distance), 1.0);
    float cosine_square = (max((distance_ - ball), 0.0) * (distance_ + ball));
    float cosine = ((cosine_square * rsqrt(max(cosine_square, LTC_TINY))) * inverse_distance);
    float side = ((w.z >= 0.0) ? 1.0 : -1.0);
    float p = (-1.0 / (side + w.z));
    float q = ((w.x * w.y) * p);
    sphere.inside = (ball >= distance_);
    disk_4.half_x = float3((1.0 + (((side * w.x) * w.x) * p)), (side * q), (-(side) * w.x));
    disk_4.half_y = float3(q, (side + ((w.y * w.y) * p)), -(w.y));
    disk_4.size = sine;
    disk_4.centre = (w * cosine);
    disk_4.normal = w;
    disk_4.volume = cosine;
    float3 _e87 = disk_4.half_x;
    float3 _e89 = disk_4.half_y;
    float3 _e91 = disk_4.centre;
    const LtcCut _e92 = ltc_cut(surface.normal, _e87, _e89, sine, _e91);
    disk_4.cut = _e92;
    float _e96 = disk_4.cut.offset;
    disk_4.clipped = (_e96 > -1.0);
    bool _e101 = sphere.inside;
    float _e104 = disk_4.cut.offset;
    disk_4.reaches = ((_e101 | ((_e104 < 1.0) & (cosine > 0.0))) & (ball > 0.0));
    bool _e116 = sphere.inside;
    bool _e118 = disk_4.reaches;
    sphere.inside = (_e116 & _e118);
    LtcDisk _e121 = disk_4;
    sphere.disk = _e121;
    LtcSphere _e122 = sphere;
    const LtcSphere ltcsphere = _e122;
    return ltcsphere;
}
#endif

#if LTC_SPHERE
// The form factor of a sphere, 0 to 1: ltc_cone_part for a circular cone, whose centre has the height `tilt` over the
// horizon (the integral of Snyder 1996, "Area Light Sources for Real-Time Graphics", without its differences of
// nearly equal angles).
float ltc_sphere_diffuse(LtcSphere sphere)
{
    float value = (float)0;

    LtcDisk disk_5 = sphere.disk;
    float tilt = dot(disk_5.cut.normal, disk_5.normal);
    value = ((disk_5.size * disk_5.size) * tilt);
    if (disk_5.clipped) {
        const float _e17 = ltc_cap(disk_5.size, tilt, disk_5.cut.offset, disk_5.cut.reach);
        value = _e17;
    }
    float _e18 = value;
    return (sphere.inside ? 1.0 : (disk_5.reaches ? saturate(_e18) : 0.0));
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The vector form factor of a sphere in a lobe's space, cut at both horizons, towards the light. A sphere around
// the surface point covers the whole lobe.
float3 ltc_sphere_lobe(LtcSphere sphere, LtcLobe lobe)
{
    if (sphere.inside) {
        const float3 _e3 = ltc_all_around(lobe);
        return float3(_e3.xy, lobe.share);
    }
    const float3 _e8 = ltc_disk_lobe(sphere.disk, lobe);
    return _e8;
}
#endif

#if (LTC_ANISOTROPIC && LTC_SPHERE) || (LTC_CLEARCOAT && LTC_SPHERE) || (LTC_GGX && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_SHEEN && LTC_SPHERE)
// The parts (specular, fresnel) that a sum of lobes reflects of a sphere of unit radiance.
float2 ltc_sphere_specular(LtcSurface surface, LtcSphere sphere, LtcLobes lobes)
{
    float2 value = (0.0).xx;
    LtcLobe lobe = (LtcLobe)0;
    LtcShape shape = (LtcShape)0;
    int index = int(1);

#if !LTC_SECOND_LOBE
    if (!(ltc_use_second_lobe)) {
        const float3 _e10 = ltc_sphere_lobe(sphere, lobes.first);
        const float2 _e11 = ltc_lobes_part(surface, lobes.first, _e10);
        value = _e11;
    }
#endif
#if LTC_SECOND_LOBE
    if (ltc_use_second_lobe) {
        lobe = lobes.first;
        shape = lobes.second;
        while(true) {
            float2 _e19 = value;
            LtcLobe _e20 = lobe;
            LtcLobe _e21 = lobe;
            const float3 _e22 = ltc_sphere_lobe(sphere, _e21);
            const float2 _e23 = ltc_lobes_part(surface, _e20, _e22);
            value = (_e19 + _e23);
            int _e25 = index;
            if ((_e25 >= lobes.count)) {
                break;
            }
            LtcShape _e28 = shape;
            const LtcLobe _e29 = ltc_shape_lobe(surface, _e28);
            lobe = _e29;
#if LTC_THIRD_LOBE
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
#endif
            int _e32 = index;
            index = asint(asuint(_e32) + asuint(int(1)));
        }
    }
#endif
    float2 _e35 = value;
    return _e35;
}
#endif

#if LTC_SPHERE
// The value (diffuse, specular, fresnel) of a sphere light, which emits outwards, and inwards to a surface point
// that it contains.
//
// Error of the form factor against exact arithmetic: at most 1e-6, and 1e-4 of its value for a sphere whose radius is
// less than a twentieth of its distance. At the distance g, in radii, from the sphere 1e-7 / sqrt(g) takes the place
// of 1e-6: so much does the rounding of that distance move the sphere's outline.
float3 ltc_sphere(LtcSurface surface, LtcLobes lobes, float3 centre, float radius)
{
    float2 specular = (0.0).xx;

    const LtcSphere _e4 = ltc_sphere_begin(surface, centre, radius);
    if (!(_e4.disk.reaches)) {
        return (0.0).xxx;
    }
#if LTC_GGX
    if (ltc_use_ggx) {
        const float2 _e14 = ltc_sphere_specular(surface, _e4, lobes);
        specular = _e14;
    }
#endif
    const float _e15 = ltc_sphere_diffuse(_e4);
    float2 _e16 = specular;
    return float3(_e15, _e16);
}
#endif

#if LTC_ANISOTROPIC
// The square root of `x`, 0 or more, without WGSL's sqrt(0), which has no accuracy guarantee.
float ltc_anisotropic_root(float x)
{
    return (x * rsqrt(max(x, LTC_TINY)));
}
#endif

#if LTC_ANISOTROPIC
// Alpha along the tangent and across it, from a perceptual `roughness` and an `anisotropy` of 0 to 1 (both are
// clamped). The ratio of the two is 1 / (1 - 0.9 anisotropy), 1 to 10, and their geometric mean
// roughness^2 (Burley 2012), except that neither exceeds 1.
float2 ltc_anisotropic_alpha(float roughness, float anisotropy)
{
    float clamped = clamp(roughness, 0.0, 1.0);
    float ratio = (1.0 - (0.9 * clamp(anisotropy, 0.0, 1.0)));
    float stretch = rsqrt(ratio);
    return float2(min(((clamped * clamped) * stretch), 1.0), (((clamped * clamped) * ratio) * stretch));
}
#endif

#if LTC_ANISOTROPIC
// The anisotropy of a surface point with `alpha_x` along `tangent` and `alpha_y` across it. Either may be the larger;
// both are clamped to LTC_ALPHA_FLOOR and 1. The table holds ratios up to 10, beyond which the correction stays
// that of 10. `tangent` need not be unit nor perpendicular to the normal; where it is zero or along the
// normal, the view's azimuth takes its place. The roughness of `surface` has no effect.
LtcAnisotropy ltc_anisotropy(LtcSurface surface, float3 tangent, float alpha_x, float alpha_y)
{
    LtcAnisotropy anisotropy = (LtcAnisotropy)0;

    const float3 _e4 = ltc_direction(tangent);
    float3 flat_part = (_e4 - (surface.normal * dot(surface.normal, _e4)));
    float3 fallback = surface.tangent;
    const float3 _e15 = ltc_direction(((dot(flat_part, flat_part) > 1e-8) ? flat_part : fallback));
    float3 across = cross(surface.normal, _e15);
    float bounded_x = clamp(alpha_x, LTC_ALPHA_FLOOR, 1.0);
    float bounded_y = clamp(alpha_y, LTC_ALPHA_FLOOR, 1.0);
    bool swapped = (bounded_y > bounded_x);
    float3 major = (swapped ? across : _e15);
    float3 minor = (swapped ? _e15 : across);
    float cos_major = dot(surface.tangent, major);
    float cos_minor = dot(surface.tangent, minor);
    bool back_major = (cos_major < 0.0);
    bool back_minor = (cos_minor < 0.0);
    anisotropy.major = (back_major ? -(major) : major);
    anisotropy.alpha_major = max(bounded_x, bounded_y);
    anisotropy.minor = (back_minor ? -(minor) : minor);
    anisotropy.alpha_minor = min(bounded_x, bounded_y);
    anisotropy.view_major = (surface.sin_view * abs(cos_major));
    anisotropy.view_minor = (surface.sin_view * abs(cos_minor));
    float _e55 = anisotropy.alpha_major;
    float _e57 = anisotropy.view_major;
    float wide = (_e55 * _e57);
    float _e60 = anisotropy.alpha_minor;
    float _e62 = anisotropy.view_minor;
    float narrow = (_e60 * _e62);
    float _e65 = anisotropy.alpha_major;
    float _e67 = anisotropy.alpha_minor;
    float upright = (((_e65 * _e67) * surface.cos_view) * surface.cos_view);
    const float _e77 = ltc_anisotropic_root((((wide * wide) + (narrow * narrow)) + upright));
    float _e80 = anisotropy.alpha_minor;
    float _e82 = anisotropy.alpha_major;
    anisotropy.alpha_round = clamp(_e77, _e80, _e82);
    anisotropy.handedness = (((swapped != back_major) != back_minor) ? -1.0 : 1.0);
    LtcAnisotropy _e90 = anisotropy;
    const LtcAnisotropy ltcanisotropy = _e90;
    return ltcanisotropy;
}
#endif

#if LTC_ANISOTROPIC
// The isotropic surface whose lobe is stretched: where to sample the isotropic table.
LtcSurface ltc_anisotropic_round(LtcSurface surface, LtcAnisotropy anisotropy)
{
    LtcSurface isotropic = (LtcSurface)0;

    isotropic = surface;
    const float _e5 = ltc_anisotropic_root(anisotropy.alpha_round);
    isotropic.roughness = _e5;
    isotropic.alpha = anisotropy.alpha_round;
    LtcSurface _e8 = isotropic;
    const LtcSurface ltcsurface = _e8;
    return ltcsurface;
}
#endif

#if LTC_ANISOTROPIC
// The four coordinates of a lobe in the anisotropic table, each 0 to 1.
//
// GGX of any alpha is GGX of alpha = 1 on a surface that is stretched along its normal, and less along the one axis
// than along the other; there the view has another direction. Along that one's angle t from the normal lobes of all
// alphas change alike, where along the view's own sharp ones would change next to the horizon alone.
// x: root of the larger alpha. y: 1.8 h / (h + 0.8) for h = tan(t / 2), finer next to the normal, where most views
// lie. z: (1 + sin p - cos p) / 2 for the view's azimuth p from the major direction, nearly proportional to p. w: 1
// less the root of the ratio of the alphas, scaled to 1 at a ratio of 1 / 10.
float4 ltc_anisotropic_coordinates(LtcSurface surface, LtcAnisotropy anisotropy)
{
    float wide = (anisotropy.alpha_major * anisotropy.view_major);
    float narrow = (anisotropy.alpha_minor * anisotropy.view_minor);
    float tangential = ((wide * wide) + (narrow * narrow));
    const float _e15 = ltc_anisotropic_root((tangential + (surface.cos_view * surface.cos_view)));
    const float _e16 = ltc_anisotropic_root(tangential);
    float bent = ((_e16 * 1.8) / max((_e16 + (LTC_ANISOTROPIC_KNEE * (_e15 + surface.cos_view))), LTC_TINY));
    float aside = ((anisotropy.view_minor - anisotropy.view_major) / max(surface.sin_view, 1e-6));
    float ratio = (anisotropy.alpha_minor / anisotropy.alpha_major);
    const float _e38 = ltc_anisotropic_root(anisotropy.alpha_major);
    const float _e43 = ltc_anisotropic_root(ratio);
    float4 coordinates = float4(_e38, bent, (0.5 + (0.5 * aside)), ((1.0 - _e43) * 1.4624753));
    return clamp(coordinates, (0.0).xxxx, (1.0).xxxx);
}
#endif

#if LTC_ANISOTROPIC
// The lobe of an anisotropic surface, from two texels of the isotropic table at
// ltc_table_coordinates(ltc_anisotropic_round(surface, anisotropy)) and the two texels `first` and `second` of the
// anisotropic table, which are zero for no correction.
//
// The stretch: GGX's visible normals are those of a hemisphere, a clamped cosine about the stretched view (Heitz
// 2018; Dupuy and Benyoub 2023), scaled by the alphas. To first order about the middle h of the visible normals,
// l = 2 (v.h) h - v leads from them to light; linear maps all, so their product is a lobe's matrix already.
// It is so for the isotropic surface too. What that one's table says beyond the product is taken from there: the
// lobe's matrix is the anisotropic stretch times the isotropic stretch's inverse times the isotropic lobe's matrix.
// For equal alphas that is the isotropic lobe, for small ones the exact limit.
//
// The correction: added to the product of the last two, normalised by its last entry, in units of the lobe's width,
// so that the table moves no sharp highlight. Of nine entries the scale and a turn about the lobe's axis mean
// nothing, so the upper left block is symmetric and seven are left: `first` holds (1,1), (1,2), (2,2),
// (1,3), `second` (2,3), (3,1), (3,2) and the relative change of albedo and Schlick part. All are multiplied by
// the fourth coordinate, hence vanish for equal alphas. The symmetries used are those of Kt, Heitz, Dupuy and
// Narayanan 2022, "Bringing Linearly Transformed Cosines to Anisotropic GGX"; the fit is
// `softbox::fit::bake_anisotropic`.
LtcLobe ltc_anisotropic_lobe(LtcSurface surface, LtcAnisotropy anisotropy, float4 shape, float4 amplitude, float4 first, float4 second)
{
    LtcLobe lobe = (LtcLobe)0;

    float c = surface.cos_view;
    float s = surface.sin_view;
    float a = anisotropy.alpha_round;
    float4 m = float4(((c * c) + (a * shape.x)), ((a * s) * shape.y), (s * (c + (a * shape.z))), (a * shape.w));
    float round_tangential = (((a * s) * a) * s);
    float round_inverse = rsqrt(max((round_tangential + (c * c)), LTC_TINY));
    float round_slope = (((a * a) * s) * round_inverse);
    float round_tilt = (round_tangential * round_inverse);
    float round_height = (round_tilt + c);
    float round_lift = (0.5 + ((0.5 * round_slope) * round_slope));
    float rise = (s - (c * round_slope));
    float reach = ((s * (round_lift - 1.0)) - (round_tilt * round_slope));
    float scale = (1.0 / max((a * ((rise * m.z) + (round_height * m.x))), 1e-12));
    float along_along = ((((c * round_lift) * m.w) + (reach * m.y)) * scale);
    float along_up = (-((((c * round_lift) * m.z) + (reach * m.x))) * scale);
    float up_along = ((-(((rise * m.w) + (round_height * m.y))) * a) * scale);
    float across_across = ((((m.x * m.w) - (m.y * m.z)) * scale) * ((c * round_lift) - ((reach * rise) / max(round_height, LTC_TINY))));
    float view_x = anisotropy.view_major;
    float view_y = anisotropy.view_minor;
    float alpha_x = anisotropy.alpha_major;
    float alpha_y = anisotropy.alpha_minor;
    float wide = (alpha_x * view_x);
    float narrow = (alpha_y * view_y);
    float tangential = ((wide * wide) + (narrow * narrow));
    float2 azimuth = ((tangential > 1e-30) ? (float2(wide, narrow) * rsqrt(max(tangential, 1e-30))) : float2(1.0, 0.0));
    float ratio = (alpha_y / alpha_x);
    const float _e117 = ltc_anisotropic_root(ratio);
    float depth = clamp(((1.0 - _e117) * 1.4624753), 0.0, 1.0);
    float2 squares = (azimuth * azimuth);
    float both = (azimuth.x * azimuth.y);
    float e_uu = (along_along + (depth * (((first.x * squares.x) + ((2.0 * first.y) * both)) + (first.z * squares.y))));
    float e_uv = (depth * (((first.z - first.x) * both) + (first.y * (squares.x - squares.y))));
    float e_vv = (across_across + (depth * (((first.x * squares.y) - ((2.0 * first.y) * both)) + (first.z * squares.x))));
    float e_uz = (along_up + (depth * ((first.w * azimuth.x) + (second.x * azimuth.y))));
    float e_vz = (depth * ((second.x * azimuth.x) - (first.w * azimuth.y)));
    float e_zu = (up_along + (depth * ((second.y * azimuth.x) + (second.z * azimuth.y))));
    float e_zv = (depth * ((second.z * azimuth.x) - (second.y * azimuth.y)));
    float inverse_length = rsqrt(max((tangential + (c * c)), LTC_TINY));
    float slope_x = ((alpha_x * wide) * inverse_length);
    float slope_y = ((alpha_y * narrow) * inverse_length);
    float tilt = (tangential * inverse_length);
    float height = (tilt + c);
    float lift = (0.5 + (0.5 * ((slope_x * slope_x) + (slope_y * slope_y))));
    float turn = ((view_x * slope_y) - (view_y * slope_x));
    float3 normal_19 = surface.normal;
    float3 major_1 = anisotropy.major;
    float3 minor_1 = anisotropy.minor;
    float2 x_6 = (alpha_x * azimuth);
    float2 y_2 = (alpha_y * azimuth);
    float3 u = (((major_1 * ((x_6.x * height) - (y_2.y * turn))) + (minor_1 * ((x_6.x * turn) + (y_2.y * height)))) + (normal_19 * ((x_6.x * (view_x - (c * slope_x))) + (y_2.y * (view_y - (c * slope_y))))));
    float3 v = (((minor_1 * ((y_2.x * height) - (x_6.y * turn))) - (major_1 * ((y_2.x * turn) + (x_6.y * height)))) + (normal_19 * ((((c * inverse_length) * wide) * azimuth.y) * ((alpha_x - alpha_y) * (alpha_x + alpha_y)))));
    float3 z_2 = (((major_1 * ((view_x * (lift - 1.0)) - (tilt * slope_x))) + (minor_1 * ((view_y * (lift - 1.0)) - (tilt * slope_y)))) + (normal_19 * (c * lift)));
    float3 m_x = (((u * e_uu) + (v * e_uv)) + (z_2 * e_zu));
    float3 m_y = ((((u * e_uv) + (v * e_vv)) + (z_2 * e_zv)) * anisotropy.handedness);
    float3 m_z = (((u * e_uz) + (v * e_vz)) + z_2);
    float3 middle = cross(m_z, m_x);
    float unit_scale = rsqrt(max(dot(middle, middle), LTC_TINY));
    float3 heights = float3(dot(normal_19, m_x), dot(normal_19, m_y), dot(normal_19, m_z));
    float brightness = (1.0 + (depth * second.w));
    lobe.axis_x = (cross(m_y, m_z) * unit_scale);
    lobe.albedo = clamp((amplitude.x * brightness), 0.0, 1.0);
    lobe.axis_y = (middle * unit_scale);
    lobe.fresnel = clamp((amplitude.y * brightness), 0.0, 1.0);
    lobe.axis_z = (cross(m_x, m_y) * unit_scale);
    lobe.share = (0.5 + ((0.5 * heights.z) * rsqrt(max(dot(heights, heights), LTC_TINY))));
    float3 _e353 = lobe.axis_y;
    float volume = abs((unit_scale * dot(m_y, _e353)));
    lobe.normal_x = (m_x * volume);
    lobe.normal_y = (m_y * volume);
    lobe.normal_z = (m_z * volume);
    LtcLobe _e363 = lobe;
    const LtcLobe _e364 = ltc_framed_lobe(surface, _e363);
    const LtcLobe ltclobe = _e364;
    return ltclobe;
}
#endif

#if LTC_ANISOTROPIC
// The lobe of an anisotropic surface from the isotropic table alone: 2 samples of layers 0 and 1, as
// ltc_lobe_from_table takes them.
LtcLobe ltc_stretched_lobe_from_table(LtcSurface surface, LtcAnisotropy anisotropy, Texture2DArray<float4> table, SamplerState table_sampler, float table_size)
{
    const LtcSurface _e5 = ltc_anisotropic_round(surface, anisotropy);
    const float2 _e6 = ltc_table_coordinates(_e5, table_size);
    float4 shape = table.SampleLevel(table_sampler, float3(_e6, int(0)), 0.0);
    float4 amplitude = table.SampleLevel(table_sampler, float3(_e6, int(1)), 0.0);
    const LtcLobe _e17 = ltc_anisotropic_lobe(surface, anisotropy, shape, amplitude, (0.0).xxxx, (0.0).xxxx);
    const LtcLobe ltclobe = _e17;
    return ltclobe;
}
#endif

#if LTC_ANISOTROPIC
// The lobe of an anisotropic surface from the table's texture array, of which the layers `first_layer` and the next
// hold the anisotropic table: 2 samples of layers 0 and 1, and 8 of these. `table_size` is the texels along
// each side of a layer, 64 or more; the sampler filters linearly.
//
// Tiles of 8 x 8 texels fill the first 64 x 64: the first two coordinates run within a tile, from the first texel's
// centre to the last one's, so that filtering never reaches the next tile; the others run from tile to tile.
LtcLobe ltc_anisotropic_lobe_from_table(LtcSurface surface, LtcAnisotropy anisotropy, Texture2DArray<float4> table, SamplerState table_sampler, float table_size, int first_layer)
{
    const LtcSurface _e6 = ltc_anisotropic_round(surface, anisotropy);
    const float2 _e7 = ltc_table_coordinates(_e6, table_size);
    float4 shape = table.SampleLevel(table_sampler, float3(_e7, int(0)), 0.0);
    float4 amplitude = table.SampleLevel(table_sampler, float3(_e7, int(1)), 0.0);
    const float4 _e14 = ltc_anisotropic_coordinates(surface, anisotropy);
    float4 position = (_e14 * 7.0);
    float2 tile = min(floor(position.zw), (6.0).xx);
    float2 between = (position.zw - tile);
    float next = (LTC_ANISOTROPIC_SIZE / table_size);
    float2 upper_left = ((((tile * LTC_ANISOTROPIC_SIZE) + position.xy) + (0.5).xx) / (table_size).xx);
    float2 upper_right = (upper_left + float2(next, 0.0));
    float2 lower_left = (upper_left + float2(0.0, next));
    float2 lower_right = (upper_left + float2(next, next));
    float4 _e44 = table.SampleLevel(table_sampler, float3(upper_left, first_layer), 0.0);
    float4 _e46 = table.SampleLevel(table_sampler, float3(upper_right, first_layer), 0.0);
    float4 upper_first = lerp(_e44, _e46, (between.x).xxxx);
    float4 _e51 = table.SampleLevel(table_sampler, float3(lower_left, first_layer), 0.0);
    float4 _e53 = table.SampleLevel(table_sampler, float3(lower_right, first_layer), 0.0);
    float4 lower_first = lerp(_e51, _e53, (between.x).xxxx);
    float4 _e60 = table.SampleLevel(table_sampler, float3(upper_left, asint(asuint(first_layer) + asuint(int(1)))), 0.0);
    float4 _e64 = table.SampleLevel(table_sampler, float3(upper_right, asint(asuint(first_layer) + asuint(int(1)))), 0.0);
    float4 upper_second = lerp(_e60, _e64, (between.x).xxxx);
    float4 _e71 = table.SampleLevel(table_sampler, float3(lower_left, asint(asuint(first_layer) + asuint(int(1)))), 0.0);
    float4 _e75 = table.SampleLevel(table_sampler, float3(lower_right, asint(asuint(first_layer) + asuint(int(1)))), 0.0);
    float4 lower_second = lerp(_e71, _e75, (between.x).xxxx);
    float4 first = lerp(upper_first, lower_first, (between.y).xxxx);
    float4 second = lerp(upper_second, lower_second, (between.y).xxxx);
    const LtcLobe _e85 = ltc_anisotropic_lobe(surface, anisotropy, shape, amplitude, first, second);
    const LtcLobe ltclobe = _e85;
    return ltclobe;
}
#endif

// A material of a diffuse and a specular part and nothing else; F90 is 1.
LtcMaterial ltc_material(float3 base_colour, float roughness_3, float3 normal_reflectance_2)
{
    LtcMaterial material = (LtcMaterial)0;

    material.base_colour = base_colour;
    material.roughness = roughness_3;
    material.normal_reflectance = normal_reflectance_2;
    material.diffuse_roughness = 0.0;
    material.grazing_reflectance = (1.0).xxx;
    material.coat = 0.0;
    material.sheen_colour = (0.0).xxx;
    material.sheen_roughness = 0.5;
    material.grain = (0.0).xxx;
    material.anisotropy = 0.0;
    material.coat_roughness = 0.1;
    material.coat_reflectance = 0.04;
    LtcMaterial _e28 = material;
    const LtcMaterial ltcmaterial = _e28;
    return ltcmaterial;
}

// Whether a surface point lies within `range` of the centre of a light, beyond which the light may be skipped; see
// softbox::light::Light::range.
bool ltc_in_range(float3 position, float3 centre, float range)
{
    float3 away = ((centre * LTC_HEADROOM) - (position * LTC_HEADROOM));
    const float _e8 = ltc_extent(away);
    float3 scaled = (away * (1.0 / max(_e8, LTC_TINY)));
    float squared = dot(scaled, scaled);
    return ((_e8 * (squared * rsqrt(max(squared, LTC_TINY)))) <= (range * LTC_HEADROOM));
}

// The lobes of a surface point. `normal` and `view` are as for ltc_surface, the table as for ltc_lobe_from_table,
// with the layers of the effects that are on.
LtcShading ltc_shading(float3 position, float3 normal, float3 view, LtcMaterial material, LtcLayers layers, Texture2DArray<float4> table, SamplerState table_sampler, float table_size)
{
    LtcShading shading = (LtcShading)0;

    const LtcSurface _e9 = ltc_surface(position, normal, view, material.roughness);
    shading.surface = _e9;
#if LTC_ANISOTROPIC
    if ((ltc_use_anisotropic & (material.anisotropy > 0.0))) {
        const float2 _e19 = ltc_anisotropic_alpha(material.roughness, material.anisotropy);
        const LtcAnisotropy _e23 = ltc_anisotropy(_e9, material.grain, _e19.x, _e19.y);
        const LtcLobe _e26 = ltc_anisotropic_lobe_from_table(_e9, _e23, table, table_sampler, table_size, layers.anisotropic);
        const LtcLobes _e27 = ltc_lobes_of(_e9, _e26);
        shading.specular = _e27;
    } else {
#else
    {
#endif
#if LTC_GGX
        if (ltc_use_ggx) {
            const LtcLobes _e31 = ltc_lobes_from_table(_e9, table, table_sampler, table_size, layers.lobes);
            shading.specular = _e31;
        }
#endif
    }
#if LTC_CLEARCOAT
    if (ltc_use_clearcoat) {
        const LtcSurface _e35 = ltc_surface_with_roughness(_e9, material.coat_roughness);
        const LtcLobes _e37 = ltc_lobes_from_table(_e35, table, table_sampler, table_size, layers.lobes);
        shading.coat = _e37;
    }
#endif
#if LTC_SHEEN
    if (ltc_use_sheen) {
        const LtcSurface _e41 = ltc_surface_with_roughness(_e9, material.sheen_roughness);
        const LtcLobe _e43 = ltc_sheen_lobe_from_table(_e41, table, table_sampler, table_size, layers.sheen);
        shading.sheen = _e43;
    }
#endif
#if LTC_ROUGH_DIFFUSE
    if (ltc_use_rough_diffuse) {
        const LtcSurface _e47 = ltc_surface_with_roughness(_e9, material.diffuse_roughness);
        const LtcLobe _e49 = ltc_diffuse_lobe_from_table(_e47, table, table_sampler, table_size, layers.diffuse);
        shading.rough = _e49;
    }
#endif
    LtcShading _e50 = shading;
    const LtcShading ltcshading = _e50;
    return ltcshading;
}

#if (LTC_DISK && LTC_ROUGH_DIFFUSE) || (LTC_DISK && LTC_SHEEN) || (LTC_POLYGON && LTC_ROUGH_DIFFUSE) || (LTC_POLYGON && LTC_SHEEN) || (LTC_QUAD && LTC_ROUGH_DIFFUSE) || (LTC_QUAD && LTC_SHEEN) || (LTC_ROUGH_DIFFUSE && LTC_SPHERE) || (LTC_ROUGH_DIFFUSE && LTC_TEXTURED) || (LTC_ROUGH_DIFFUSE && LTC_TUBE) || (LTC_SHEEN && LTC_SPHERE) || (LTC_SHEEN && LTC_TEXTURED) || (LTC_SHEEN && LTC_TUBE)
// The value of a lobe without a Schlick part from the vector form factor in its space.
float ltc_plain_value(LtcLobe lobe, float3 toward)
{
    return (lobe.albedo * clamp((toward.z / lobe.share), 0.0, 1.0));
}
#endif

#if LTC_QUAD
// What the surface receives of a convex quad; see ltc_quad.
LtcReceived ltc_shading_quad(LtcShading shading, float3 a, float3 b, float3 c, float3 d, bool two_sided)
{
    LtcReceived received = (LtcReceived)0;

    const LtcQuad _e8 = ltc_quad_begin(shading.surface, a, b, c, d, two_sided);
    if (_e8.reaches) {
        const float _e12 = ltc_quad_diffuse(shading.surface, _e8);
        received.diffuse = _e12;
#if LTC_GGX
        if (ltc_use_ggx) {
            const float2 _e17 = ltc_quad_specular(shading.surface, _e8, shading.specular);
            received.specular = _e17;
        }
#endif
#if LTC_CLEARCOAT
        if (ltc_use_clearcoat) {
            const float2 _e22 = ltc_quad_specular(shading.surface, _e8, shading.coat);
            received.coat = _e22;
        }
#endif
#if LTC_SHEEN
        if (ltc_use_sheen) {
            const float3 _e27 = ltc_quad_lobe(_e8, shading.sheen);
            const float _e28 = ltc_plain_value(shading.sheen, _e27);
            received.sheen = _e28;
        }
#endif
#if LTC_ROUGH_DIFFUSE
        if (ltc_use_rough_diffuse) {
            const float3 _e33 = ltc_quad_lobe(_e8, shading.rough);
            const float _e34 = ltc_plain_value(shading.rough, _e33);
            received.rough = _e34;
        }
#endif
    }
    LtcReceived _e35 = received;
    const LtcReceived ltcreceived = _e35;
    return ltcreceived;
}
#endif

#if LTC_DISK
// What the surface receives of a disk; see ltc_disk.
LtcReceived ltc_shading_disk(LtcShading shading, float3 centre, float3 half_x, float3 half_y, bool two_sided)
{
    LtcReceived received = (LtcReceived)0;

    const LtcDisk _e7 = ltc_disk_begin(shading.surface, centre, half_x, half_y, two_sided);
    const float _e9 = ltc_disk_diffuse(_e7);
    received.diffuse = _e9;
#if LTC_GGX
    if (ltc_use_ggx) {
        const float2 _e14 = ltc_disk_specular(shading.surface, _e7, shading.specular);
        received.specular = _e14;
    }
#endif
#if LTC_CLEARCOAT
    if (ltc_use_clearcoat) {
        const float2 _e19 = ltc_disk_specular(shading.surface, _e7, shading.coat);
        received.coat = _e19;
    }
#endif
#if LTC_SHEEN
    if (ltc_use_sheen) {
        const float3 _e24 = ltc_disk_lobe(_e7, shading.sheen);
        const float _e25 = ltc_plain_value(shading.sheen, _e24);
        received.sheen = _e25;
    }
#endif
#if LTC_ROUGH_DIFFUSE
    if (ltc_use_rough_diffuse) {
        const float3 _e30 = ltc_disk_lobe(_e7, shading.rough);
        const float _e31 = ltc_plain_value(shading.rough, _e30);
        received.rough = _e31;
    }
#endif
    LtcReceived _e32 = received;
    const LtcReceived ltcreceived = _e32;
    return ltcreceived;
}
#endif

#if LTC_SPHERE
// What the surface receives of a sphere; see ltc_sphere.
LtcReceived ltc_shading_sphere(LtcShading shading, float3 centre, float radius)
{
    LtcReceived received = (LtcReceived)0;

    const LtcSphere _e5 = ltc_sphere_begin(shading.surface, centre, radius);
    const float _e7 = ltc_sphere_diffuse(_e5);
    received.diffuse = _e7;
#if LTC_GGX
    if (ltc_use_ggx) {
        const float2 _e12 = ltc_sphere_specular(shading.surface, _e5, shading.specular);
        received.specular = _e12;
    }
#endif
#if LTC_CLEARCOAT
    if (ltc_use_clearcoat) {
        const float2 _e17 = ltc_sphere_specular(shading.surface, _e5, shading.coat);
        received.coat = _e17;
    }
#endif
#if LTC_SHEEN
    if (ltc_use_sheen) {
        const float3 _e22 = ltc_sphere_lobe(_e5, shading.sheen);
        const float _e23 = ltc_plain_value(shading.sheen, _e22);
        received.sheen = _e23;
    }
#endif
#if LTC_ROUGH_DIFFUSE
    if (ltc_use_rough_diffuse) {
        const float3 _e28 = ltc_sphere_lobe(_e5, shading.rough);
        const float _e29 = ltc_plain_value(shading.rough, _e28);
        received.rough = _e29;
    }
#endif
    LtcReceived _e30 = received;
    const LtcReceived ltcreceived = _e30;
    return ltcreceived;
}
#endif

#if LTC_TUBE
// What the surface receives of a tube; see ltc_tube.
LtcReceived ltc_shading_tube(LtcShading shading, float3 start, float3 end, float radius, bool caps)
{
    LtcReceived received = (LtcReceived)0;

    const LtcTube _e7 = ltc_tube_begin(shading.surface, start, end, radius, caps);
    const float _e10 = ltc_tube_diffuse(shading.surface, _e7);
    received.diffuse = _e10;
#if LTC_GGX
    if (ltc_use_ggx) {
        const float2 _e15 = ltc_tube_specular(shading.surface, _e7, shading.specular);
        received.specular = _e15;
    }
#endif
#if LTC_CLEARCOAT
    if (ltc_use_clearcoat) {
        const float2 _e20 = ltc_tube_specular(shading.surface, _e7, shading.coat);
        received.coat = _e20;
    }
#endif
#if LTC_SHEEN
    if (ltc_use_sheen) {
        const float3 _e25 = ltc_tube_lobe(_e7, shading.sheen);
        const float _e26 = ltc_plain_value(shading.sheen, _e25);
        received.sheen = _e26;
    }
#endif
#if LTC_ROUGH_DIFFUSE
    if (ltc_use_rough_diffuse) {
        const float3 _e31 = ltc_tube_lobe(_e7, shading.rough);
        const float _e32 = ltc_plain_value(shading.rough, _e31);
        received.rough = _e32;
    }
#endif
    LtcReceived _e33 = received;
    const LtcReceived ltcreceived = _e33;
    return ltcreceived;
}
#endif

#if LTC_POLYGON
// Starts a polygon of any number of vertices at its first one.
LtcShadingPolygon ltc_shading_polygon_begin(LtcShading shading, float3 corner)
{
    LtcShadingPolygon polygon = (LtcShadingPolygon)0;

    const LtcOutline _e5 = ltc_outline_begin(shading.surface, corner);
    polygon.outline = _e5;
    const LtcOutlineLobes _e7 = ltc_outline_lobes_begin();
    polygon.specular = _e7;
    const LtcOutlineLobes _e9 = ltc_outline_lobes_begin();
    polygon.coat = _e9;
    const LtcOutlineLobe _e11 = ltc_outline_lobe_begin();
    polygon.sheen = _e11;
    const LtcOutlineLobe _e13 = ltc_outline_lobe_begin();
    polygon.rough = _e13;
    LtcShadingPolygon _e14 = polygon;
    const LtcShadingPolygon ltcshadingpolygon = _e14;
    return ltcshadingpolygon;
}
#endif

#if LTC_POLYGON
// Adds the next vertex.
void ltc_shading_polygon_add(inout LtcShadingPolygon polygon, LtcShading shading, float3 corner)
{
    LtcOutline outline_9 = (LtcOutline)0;
    LtcOutlineLobes specular_5 = (LtcOutlineLobes)0;
    LtcOutlineLobes coat_2 = (LtcOutlineLobes)0;
    LtcOutlineLobe sheen_1 = (LtcOutlineLobe)0;
    LtcOutlineLobe rough = (LtcOutlineLobe)0;

    LtcOutline _e4 = polygon.outline;
    outline_9 = _e4;
    ltc_outline_add(outline_9, shading.surface, corner);
    LtcOutline _e8 = outline_9;
    polygon.outline = _e8;
#if LTC_GGX
    if (ltc_use_ggx) {
        LtcOutlineLobes _e11 = polygon.specular;
        specular_5 = _e11;
        LtcOutline _e14 = outline_9;
        ltc_outline_lobes_add(specular_5, shading.surface, _e14, shading.specular);
        LtcOutlineLobes _e17 = specular_5;
        polygon.specular = _e17;
    }
#endif
#if LTC_CLEARCOAT
    if (ltc_use_clearcoat) {
        LtcOutlineLobes _e20 = polygon.coat;
        coat_2 = _e20;
        LtcOutline _e23 = outline_9;
        ltc_outline_lobes_add(coat_2, shading.surface, _e23, shading.coat);
        LtcOutlineLobes _e26 = coat_2;
        polygon.coat = _e26;
    }
#endif
#if LTC_SHEEN
    if (ltc_use_sheen) {
        LtcOutlineLobe _e29 = polygon.sheen;
        sheen_1 = _e29;
        LtcOutline _e31 = outline_9;
        ltc_outline_lobe_add(sheen_1, _e31, shading.sheen);
        LtcOutlineLobe _e34 = sheen_1;
        polygon.sheen = _e34;
    }
#endif
#if LTC_ROUGH_DIFFUSE
    if (ltc_use_rough_diffuse) {
        LtcOutlineLobe _e37 = polygon.rough;
        rough = _e37;
        LtcOutline _e39 = outline_9;
        ltc_outline_lobe_add(rough, _e39, shading.rough);
        LtcOutlineLobe _e42 = rough;
        polygon.rough = _e42;
        return;
    } else {
#else
    {
#endif
#if !LTC_ROUGH_DIFFUSE
        return;
#endif
    }
}
#endif

#if LTC_POLYGON
// What the surface receives of the polygon whose vertices have all been added.
LtcReceived ltc_shading_polygon_end(inout LtcShadingPolygon polygon, LtcShading shading, bool two_sided)
{
    LtcReceived received = (LtcReceived)0;

    float3 first_10 = polygon.outline.first;
    ltc_shading_polygon_add(polygon, shading, first_10);
    LtcOutline outline_10 = polygon.outline;
    const float _e10 = ltc_outline_diffuse(outline_10, two_sided);
    received.diffuse = _e10;
#if LTC_GGX
    if (ltc_use_ggx) {
        LtcOutlineLobes _e15 = polygon.specular;
        const float2 _e17 = ltc_outline_specular(shading.surface, outline_10, _e15, shading.specular, two_sided);
        received.specular = _e17;
    }
#endif
#if LTC_CLEARCOAT
    if (ltc_use_clearcoat) {
        LtcOutlineLobes _e22 = polygon.coat;
        const float2 _e24 = ltc_outline_specular(shading.surface, outline_10, _e22, shading.coat, two_sided);
        received.coat = _e24;
    }
#endif
#if LTC_SHEEN
    if (ltc_use_sheen) {
        LtcOutlineLobe _e29 = polygon.sheen;
        const float3 _e30 = ltc_outline_lobe(outline_10, _e29, two_sided);
        const float _e31 = ltc_plain_value(shading.sheen, _e30);
        received.sheen = _e31;
    }
#endif
#if LTC_ROUGH_DIFFUSE
    if (ltc_use_rough_diffuse) {
        LtcOutlineLobe _e36 = polygon.rough;
        const float3 _e37 = ltc_outline_lobe(outline_10, _e36, two_sided);
        const float _e38 = ltc_plain_value(shading.rough, _e37);
        received.rough = _e38;
    }
#endif
    LtcReceived _e39 = received;
    const LtcReceived ltcreceived = _e39;
    return ltcreceived;
}
#endif

// Radiance that a surface reflects of a light of unit radiance; it is linear in what is received.
//
// The specular part lies over the diffuse one without loss, as in most engines; sheen and coat take from what is
// below them, see ltc_sheen_over and ltc_coat_over.
float3 ltc_reflected(LtcShading shading, LtcMaterial material, LtcReceived received)
{
    float3 radiance = (float3)0;
    float3 specular_6 = (float3)0;

    radiance = (material.base_colour * received.diffuse);
#if LTC_ROUGH_DIFFUSE
    if (ltc_use_rough_diffuse) {
        const LtcSurface _e10 = ltc_surface_with_roughness(shading.surface, material.diffuse_roughness);
        const float3 _e17 = ltc_rough_diffuse(_e10, shading.rough, float3(received.diffuse, received.rough, 0.0), material.base_colour);
        float3 _e18 = radiance;
        radiance = ((material.diffuse_roughness > 0.0) ? _e17 : _e18);
    }
#endif
#if LTC_GGX
    if (ltc_use_ggx) {
        float3 value = float3(received.diffuse, received.specular);
        const float3 _e29 = ltc_reflectance(value, material.normal_reflectance, material.grazing_reflectance);
        specular_6 = _e29;
#if LTC_ENERGY_COMPENSATION
        if (ltc_use_energy_compensation) {
            float3 _e32 = specular_6;
            const LtcLobe _e35 = ltc_lobes_together(shading.surface, shading.specular);
            const float3 _e37 = ltc_energy_compensation(_e35, material.normal_reflectance);
            specular_6 = (_e32 * _e37);
        }
#endif
        float3 _e39 = radiance;
        float3 _e40 = specular_6;
        radiance = (_e39 + _e40);
    }
#endif
#if LTC_SHEEN
    if (ltc_use_sheen) {
        float3 _e43 = radiance;
        const float3 _e50 = ltc_sheen_over(_e43, shading.sheen, float3(received.diffuse, received.sheen, 0.0), material.sheen_colour);
        radiance = _e50;
    }
#endif
#if LTC_CLEARCOAT
    if (ltc_use_clearcoat) {
        float3 _e52 = radiance;
        const LtcLobe _e55 = ltc_lobes_together(shading.surface, shading.coat);
        const float3 _e61 = ltc_coat_over(_e52, _e55, float3(received.diffuse, received.coat), material.coat_reflectance, material.coat);
        radiance = _e61;
    }
#endif
    float3 _e62 = radiance;
    return _e62;
}

#if LTC_TEXTURED
// Radiance that a surface reflects of a rectangle, or another parallelogram, that shows a picture of `texels`
// texels: each lobe sees the picture as blurred as it is wide.
float3 ltc_reflected_picture(LtcShading shading, LtcMaterial material, float3 a, float3 b, float3 c, float3 d, bool two_sided, Texture2D<float4> picture, SamplerState picture_sampler, float2 texels)
{
    LtcReceived diffuse = (LtcReceived)0;
    float3 radiance = (float3)0;
    LtcReceived specular_7 = (LtcReceived)0;
    LtcReceived coat_3 = (LtcReceived)0;
    LtcReceived sheen_2 = (LtcReceived)0;

    const LtcQuad _e11 = ltc_quad_begin(shading.surface, a, b, c, d, two_sided);
    if (!(_e11.reaches)) {
        return (0.0).xxx;
    }
    const float _e19 = ltc_quad_diffuse(shading.surface, _e11);
    diffuse.diffuse = _e19;
#if LTC_ROUGH_DIFFUSE
    if (ltc_use_rough_diffuse) {
        const float3 _e24 = ltc_quad_lobe(_e11, shading.rough);
        const float _e25 = ltc_plain_value(shading.rough, _e24);
        diffuse.rough = _e25;
    }
#endif
    const float3 _e28 = ltc_quad_toward(shading.surface, _e11);
    const LtcLookup _e30 = ltc_rectangle_diffuse_lookup(shading.surface, a, b, d, _e28, texels, false);
    LtcReceived _e31 = diffuse;
    const float3 _e32 = ltc_reflected(shading, material, _e31);
    const float4 _e33 = ltc_texture_fetch(picture, picture_sampler, _e30);
    radiance = (_e32 * _e33.xyz);
#if LTC_GGX
    if (ltc_use_ggx) {
        const LtcSeen _e40 = ltc_quad_picture(shading.surface, _e11, shading.specular, a, b, d, picture, picture_sampler, texels);
        specular_7.specular = _e40.value;
        float3 _e44 = radiance;
        LtcReceived _e45 = specular_7;
        const float3 _e46 = ltc_reflected(shading, material, _e45);
        radiance = (_e44 + (_e46 * _e40.colour));
    }
#endif
#if LTC_CLEARCOAT
    if (ltc_use_clearcoat) {
        const LtcSeen _e53 = ltc_quad_picture(shading.surface, _e11, shading.coat, a, b, d, picture, picture_sampler, texels);
        coat_3.coat = _e53.value;
        float3 _e57 = radiance;
        LtcReceived _e58 = coat_3;
        const float3 _e59 = ltc_reflected(shading, material, _e58);
        radiance = (_e57 + (_e59 * _e53.colour));
    }
#endif
#if LTC_SHEEN
    if (ltc_use_sheen) {
        const float3 _e65 = ltc_quad_lobe(_e11, shading.sheen);
        const float _e69 = ltc_plain_value(shading.sheen, _e65);
        sheen_2.sheen = _e69;
        const LtcLookup _e73 = ltc_rectangle_lookup(shading.surface, shading.sheen, a, b, d, _e65, texels, false);
        float3 _e74 = radiance;
        LtcReceived _e75 = sheen_2;
        const float3 _e76 = ltc_reflected(shading, material, _e75);
        const float4 _e77 = ltc_texture_fetch(picture, picture_sampler, _e73);
        radiance = (_e74 + (_e76 * _e77.xyz));
    }
#endif
    float3 _e81 = radiance;
    return _e81;
}
#endif

#endif // LTC_HLSL_INCLUDED
