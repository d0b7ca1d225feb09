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

/// Whether there are convex quads and triangles.
override ltc_use_quad: bool = true;

/// Whether there are polygons of any number of vertices.
override ltc_use_polygon: bool = true;

/// Whether there are disks and ellipses.
override ltc_use_disk: bool = true;

/// Whether there are spheres.
override ltc_use_sphere: bool = true;

/// Whether there are tubes.
override ltc_use_tube: bool = true;

/// Whether there are rectangles that show a picture.
override ltc_use_textured: bool = true;

/// Whether surfaces are specular. Without it only the diffuse value means anything.
override ltc_use_ggx: bool = true;

/// Whether surfaces have a clear coat.
override ltc_use_clearcoat: bool = true;

/// Whether surfaces have a sheen.
override ltc_use_sheen: bool = true;

/// Whether diffuse parts are rough. Without it they follow Lambert's law.
override ltc_use_rough_diffuse: bool = true;

/// Whether rough metals get back the light that their facets reflect more than once.
override ltc_use_energy_compensation: bool = true;

/// Whether the roughness of specular parts depends on the direction.
override ltc_use_anisotropic: bool = true;

/// Whether lights may emit from both sides. Without it `two_sided` counts as false.
override ltc_use_two_sided: bool = true;

/// Whether tubes may have caps. Without it `caps` counts as false.
override ltc_use_caps: bool = true;

/// Whether quads and polygons are cut at the horizons by a cheap approximation, see ltc_quad. Off unless it is asked for.
override ltc_use_cheap_horizon: bool = false;

/// Whether quads and polygons that are small for their distance are treated like any other, see ltc_quad. Off unless it
/// is asked for.
override ltc_use_cheap_distance: bool = false;

/// Whether a closed form stands in for the table of the specular lobe, see ltc_lobe_fitted. Off unless it is asked for.
override ltc_use_table_free: bool = false;

/// Whether isotropic GGX is the sum of two lobes rather than one, see LtcLobes. Off unless it is asked for.
override ltc_use_second_lobe: bool = false;

/// Whether it is the sum of three; means nothing without the second lobe. Off unless it is asked for.
override ltc_use_third_lobe: bool = false;

/// Pi.
const LTC_PI: f32 = 3.14159265358979;

/// 1 / (2 pi).
const LTC_OVER_TWO_PI: f32 = 0.159154943091895;

/// Roughness below which the lobe no longer changes: alpha = 0.0004.
const LTC_ROUGHNESS_FLOOR: f32 = 0.02;

/// How far the mean direction of a light turns towards a lobe's axis in ltc_mean_schlick.
const LTC_MEAN_SHIFT: f32 = 0.5;

/// Smallest length by which anything is divided; a reciprocal of it is still finite.
const LTC_TINY: f32 = 1e-37;

/// Extent of a polygon, sphere or tube together with its distance, times LTC_HEADROOM, below which it shrinks to nothing. A
/// reciprocal of it times an inverse root of LTC_TINY is finite, in whichever order a compiler takes a product.
const LTC_SMALLEST: f32 = 1e-19;

/// Smallest square by which a tube's own directions are divided: several inverse roots of it in one product are finite,
/// in whichever order a compiler takes it.
const LTC_TUBE_TINY: f32 = 1e-20;

/// Least depth of a cone, in units of the disk's distance and size together, squared. Products of its reciprocal and of inverse roots
/// of it with one of LTC_TINY are finite, in whichever order a compiler takes them.
const LTC_SHALLOWEST: f32 = 1e-18;

/// Largest product of the reciprocal distances of two points of a disk's rim, in units of its distance and size together, for the
/// same reason.
const LTC_NEAREST_PAIR: f32 = 1e18;

/// Factor on positions that leaves room for their differences, a power of two.
const LTC_HEADROOM: f32 = 0.0625;

/// A surface point with its shading frame: the view direction lies in the half-plane of tangent
/// and normal, tangent x bitangent = normal.
struct LtcSurface {
    /// The point, in the caller's space.
    position: vec3<f32>,
    /// Perceptual roughness, at least LTC_ROUGHNESS_FLOOR.
    roughness: f32,
    /// First axis of the frame.
    tangent: vec3<f32>,
    /// Cosine between normal and view, 0 to 1.
    cos_view: f32,
    /// Second axis of the frame.
    bitangent: vec3<f32>,
    /// Sine between normal and view, 0 to 1.
    sin_view: f32,
    /// Third axis of the frame.
    normal: vec3<f32>,
    /// Square of the roughness.
    alpha: f32,
}

/// One lobe: a linearly transformed cosine and the weights of the BRDF's two parts.
struct LtcLobe {
    /// First row of the inverse matrix: it leads vectors from the caller's space to the lobe's.
    axis_x: vec3<f32>,
    /// The BRDF's integral of f cos over the hemisphere, for F = 1.
    albedo: f32,
    /// Second row of the inverse matrix.
    axis_y: vec3<f32>,
    /// The BRDF's integral of f cos (1 - v.h)^5 over the hemisphere.
    fresnel: f32,
    /// Third row of the inverse matrix.
    axis_z: vec3<f32>,
    /// Share of the lobe's energy above the surface.
    share: f32,
    /// First row of its cofactors: they lead cross products of vectors to the lobe's space, and directions,
    /// as the transpose, back.
    normal_x: vec3<f32>,
    /// Second row of the cofactors.
    normal_y: vec3<f32>,
    /// Third row of the cofactors.
    normal_z: vec3<f32>,
    /// The same for vectors in the surface's frame (tangent, bitangent, normal), where most entries of most lobes vanish:
    /// first row of the inverse matrix.
    frame_x: vec3<f32>,
    /// Its second row.
    frame_y: vec3<f32>,
    /// Its third row.
    frame_z: vec3<f32>,
    /// First row of its cofactors.
    frame_normal_x: vec3<f32>,
    /// Second row of its cofactors.
    frame_normal_y: vec3<f32>,
    /// Third row of its cofactors.
    frame_normal_z: vec3<f32>,
}

// ---------------------------------------------------------------------------------------------
// Surface and lobe
// ---------------------------------------------------------------------------------------------

/// Largest absolute component of `v`.
fn ltc_extent(v: vec3<f32>) -> f32 {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

/// `v` over its length, whatever that is: neither huge nor tiny vectors lose their direction.
/// Zero for a zero vector.
fn ltc_direction(v: vec3<f32>) -> vec3<f32> {
    // The reciprocal of anything larger would be subnormal, which a device may take for zero.
    let scaled = v * (1.0 / clamp(ltc_extent(v), 1e-35, 8e37));
    // The square is 1 to 3, and less for a subnormal vector alone. So the product of the two factors is finite, which a compiler
    // may take first.
    return scaled * inverseSqrt(max(dot(scaled, scaled), 1e-3));
}

/// Frame and roughness of a surface point. `normal` and `view` (towards the eye) need not be unit,
/// but not zero. A view along the normal is as good as any other; one below the surface counts as
/// a grazing one. `roughness` outside 0 to 1 is clamped.
///
/// The tangent is the azimuth of the view in a basis made from the normal alone (Duff et al. 2017,
/// "Building an Orthonormal Basis, Revisited"), so the frame stays orthonormal to rounding however
/// close the view comes to the normal.
fn ltc_surface(position: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, roughness: f32) -> LtcSurface {
    let n = ltc_direction(normal);
    let v = ltc_direction(view);
    let side = select(-1.0, 1.0, n.z >= 0.0);
    let p = -1.0 / (side + n.z);
    let q = n.x * n.y * p;
    let basis_x = vec3<f32>(1.0 + side * n.x * n.x * p, side * q, -side * n.x);
    let basis_y = vec3<f32>(q, side + n.y * n.y * p, -n.y);
    let along = vec2<f32>(dot(basis_x, v), dot(basis_y, v));
    let sine_squared = dot(along, along);
    // Within a microradian of the normal the azimuth is noise, and lobes there are round.
    let sine_inverse = inverseSqrt(max(sine_squared, 1e-12));
    let azimuth = select(vec2<f32>(1.0, 0.0), along * sine_inverse, sine_squared > 1e-12);
    let cosine = dot(n, v);
    // Near the normal the sine is taken from the tangential part: 1 - cosine^2 has no digits there.
    let sine = select(1.0, min(sine_squared * sine_inverse, 1.0), cosine > 0.0);
    let clamped = clamp(roughness, LTC_ROUGHNESS_FLOOR, 1.0);
    var surface: LtcSurface;
    surface.position = position;
    surface.roughness = clamped;
    surface.tangent = basis_x * azimuth.x + basis_y * azimuth.y;
    surface.cos_view = clamp(cosine, 0.0, 1.0);
    surface.bitangent = basis_y * azimuth.x - basis_x * azimuth.y;
    surface.sin_view = sine;
    surface.normal = n;
    surface.alpha = clamped * clamped;
    return surface;
}

/// Texture coordinates of a surface in a table of `table_size` by `table_size` texels: roughness
/// along x, the square root of the view's cosine along y, from the first texel's centre to the last
/// one's. Sample with bilinear filtering and clamping.
fn ltc_table_coordinates(surface: LtcSurface, table_size: f32) -> vec2<f32> {
    // The square root without WGSL's sqrt(0), which has no accuracy guarantee.
    let root = surface.cos_view * inverseSqrt(max(surface.cos_view, 1e-20));
    return (vec2<f32>(surface.roughness, root) * (table_size - 1.0) + 0.5) / table_size;
}

/// The shape that a texel of the table describes.
///
/// It holds the lobe as its deviation (X, Y, Z, W) from the mirror's lobe, in units of the lobe's width, with t the
/// angle between normal and view:
///     x = cos^2 t + alpha X      z = sin t (cos t + alpha Z)
///     y = alpha sin t Y          w = alpha W
/// so neither interpolation nor half precision moves a sharp highlight off its place. For
/// alpha -> 0, X and Z vanish, and the rest tends to Y = -2 cos t, W = 2 cos^2 t.
fn ltc_shape(surface: LtcSurface, texel: vec4<f32>, albedo: f32, fresnel: f32) -> LtcShape {
    let c = surface.cos_view;
    let s = surface.sin_view;
    let a = surface.alpha;
    var shape: LtcShape;
    shape.entries = vec4<f32>(c * c + a * texel.x, a * s * texel.y, s * (c + a * texel.z), a * texel.w);
    shape.albedo = albedo;
    shape.fresnel = fresnel;
    return shape;
}

/// The lobe that two texels of the table describe: the shape as for ltc_shape, and the albedo and its Schlick part in x
/// and y of `amplitude`.
fn ltc_lobe(surface: LtcSurface, shape: vec4<f32>, amplitude: vec4<f32>) -> LtcLobe {
    return ltc_shape_lobe(surface, ltc_shape(surface, shape, amplitude.x, amplitude.y));
}

/// The lobe whose inverse matrix has the rows (m.x, 0, m.z), (0, 1, 0), (m.y, 0, m.w) in the surface's frame.
fn ltc_planar_lobe(surface: LtcSurface, m: vec4<f32>, albedo: f32, fresnel: f32) -> LtcLobe {
    var lobe: LtcLobe;
    lobe.axis_x = surface.tangent * m.x + surface.normal * m.z;
    lobe.albedo = albedo;
    lobe.axis_y = surface.bitangent;
    lobe.fresnel = fresnel;
    lobe.axis_z = surface.tangent * m.y + surface.normal * m.w;
    // In the lobe's space the surface's half-space has the normal (-y, 0, x). The cosine hemisphere
    // that it cuts projects to half a disk and half an ellipse: (1 + cos g) / 2 of the whole for an
    // angle g between the two normals.
    lobe.share = 0.5 + 0.5 * m.x * inverseSqrt(max(m.x * m.x + m.y * m.y, LTC_TINY));
    lobe.normal_x = surface.tangent * m.w - surface.normal * m.y;
    lobe.normal_y = surface.bitangent * (m.x * m.w - m.y * m.z);
    lobe.normal_z = surface.normal * m.x - surface.tangent * m.z;
    lobe.frame_x = vec3<f32>(m.x, 0.0, m.z);
    lobe.frame_y = vec3<f32>(0.0, 1.0, 0.0);
    lobe.frame_z = vec3<f32>(m.y, 0.0, m.w);
    lobe.frame_normal_x = vec3<f32>(m.w, 0.0, -m.y);
    lobe.frame_normal_y = vec3<f32>(0.0, m.x * m.w - m.y * m.z, 0.0);
    lobe.frame_normal_z = vec3<f32>(-m.z, 0.0, m.x);
    return lobe;
}

/// The lobe of a surface from the table's texture array (layers 0 and 1, `table_size` texels along
/// each side) and a sampler that filters linearly and clamps to the edge.
fn ltc_lobe_from_table(surface: LtcSurface, table: texture_2d_array<f32>, table_sampler: sampler, table_size: f32) -> LtcLobe {
    if (ltc_use_table_free) {
        return ltc_lobe_fitted(surface);
    }
    let at = ltc_table_coordinates(surface, table_size);
    let shape = textureSampleLevel(table, table_sampler, at, 0, 0.0);
    let amplitude = textureSampleLevel(table, table_sampler, at, 1, 0.0);
    return ltc_lobe(surface, shape, amplitude);
}

/// What makes a lobe whose matrix is planar, in the surface's frame: less to keep than the lobe.
struct LtcShape {
    /// The matrix, as for ltc_planar_lobe.
    entries: vec4<f32>,
    /// The lobe's part of the BRDF's integral of f cos, for F = 1.
    albedo: f32,
    /// For a single lobe the integral of f cos (1 - v.h)^5, for one of a sum its excess, see ltc_lobes_part.
    fresnel: f32,
}

/// The lobes whose sum is isotropic GGX. Those that are switched off are not read.
///
/// One linearly transformed cosine is not GGX: its tails are shorter, and Schlick's part is a lobe of another shape. A sum
/// of two or three, each with a weight for either part, comes closer, at the cost of a lobe each.
struct LtcLobes {
    /// The first lobe; where it is the only one, that of ltc_lobe_from_table.
    first: LtcLobe,
    /// The second lobe.
    second: LtcShape,
    /// The third lobe.
    third: LtcShape,
    /// How many lobes this surface has; may be fewer than the switches allow.
    count: i32,
}

/// A sum of one lobe, whatever the switches say.
fn ltc_lobes_of(surface: LtcSurface, lobe: LtcLobe) -> LtcLobes {
    var lobes: LtcLobes;
    lobes.first = lobe;
    lobes.count = 1;
    if (ltc_use_second_lobe) {
        lobes.first.fresnel = lobe.fresnel - lobe.albedo * ltc_mean_schlick(surface, lobe, ltc_all_around(lobe));
    }
    return lobes;
}

/// The sum of two lobes that three texels of the table describe: the shapes of the two, as in ltc_lobe, and (albedo of the
/// first, of the second, excess of the first, of the second); see ltc_lobes_part.
fn ltc_two_lobes(surface: LtcSurface, first: vec4<f32>, second: vec4<f32>, weights: vec4<f32>) -> LtcLobes {
    var lobes: LtcLobes;
    lobes.first = ltc_lobe(surface, first, weights.xzxz);
    lobes.second = ltc_shape(surface, second, weights.y, weights.w);
    lobes.count = 2;
    return lobes;
}

/// The sum of three lobes that five texels of the table describe: their shapes, their albedos, and their excesses;
/// see ltc_lobes_part.
fn ltc_three_lobes(surface: LtcSurface, first: vec4<f32>, second: vec4<f32>, third: vec4<f32>, albedos: vec4<f32>, excesses: vec4<f32>) -> LtcLobes {
    var lobes: LtcLobes;
    lobes.first = ltc_lobe(surface, first, vec4<f32>(albedos.x, excesses.x, 0.0, 0.0));
    lobes.second = ltc_shape(surface, second, albedos.y, excesses.y);
    lobes.third = ltc_shape(surface, third, albedos.z, excesses.z);
    lobes.count = 3;
    return lobes;
}

/// The lobes of a surface, as many as the switches say, from the table's texture array and a sampler that filters linearly
/// and clamps to the edge. A single lobe is that of layers 0 and 1; of two lobes the three texels of ltc_two_lobes lie in
/// the layers from `layer` on, of three lobes the five of ltc_three_lobes.
fn ltc_lobes_from_table(surface: LtcSurface, table: texture_2d_array<f32>, table_sampler: sampler, table_size: f32, layer: i32) -> LtcLobes {
    var lobes: LtcLobes;
    if (!ltc_use_second_lobe) {
        lobes = ltc_lobes_of(surface, ltc_lobe_from_table(surface, table, table_sampler, table_size));
    }
    if (ltc_use_second_lobe) {
        let at = ltc_table_coordinates(surface, table_size);
        let first = textureSampleLevel(table, table_sampler, at, layer, 0.0);
        let second = textureSampleLevel(table, table_sampler, at, layer + 1, 0.0);
        let next = textureSampleLevel(table, table_sampler, at, layer + 2, 0.0);
        if (!ltc_use_third_lobe) {
            lobes = ltc_two_lobes(surface, first, second, next);
        }
        if (ltc_use_third_lobe) {
            let albedos = textureSampleLevel(table, table_sampler, at, layer + 3, 0.0);
            let excesses = textureSampleLevel(table, table_sampler, at, layer + 4, 0.0);
            lobes = ltc_three_lobes(surface, first, second, next, albedos, excesses);
        }
    }
    return lobes;
}

/// The lobe of a shape.
fn ltc_shape_lobe(surface: LtcSurface, shape: LtcShape) -> LtcLobe {
    return ltc_planar_lobe(surface, shape.entries, shape.albedo, shape.fresnel);
}

/// The first lobe with the albedo and the Schlick part of all: for functions that ask how much a surface reflects, not where.
fn ltc_lobes_together(surface: LtcSurface, lobes: LtcLobes) -> LtcLobe {
    var together = lobes.first;
    if (ltc_use_second_lobe) {
        var sum = ltc_lobes_part(surface, lobes.first, ltc_all_around(lobes.first));
        if (lobes.count > 1) {
            let second = ltc_shape_lobe(surface, lobes.second);
            sum += ltc_lobes_part(surface, second, ltc_all_around(second));
        }
        if (ltc_use_third_lobe & (lobes.count > 2)) {
            let third = ltc_shape_lobe(surface, lobes.third);
            sum += ltc_lobes_part(surface, third, ltc_all_around(third));
        }
        together.albedo = sum.x;
        together.fresnel = sum.y;
    }
    return together;
}

/// `v`, a vector from the surface point, in the lobe's space.
fn ltc_transform(lobe: LtcLobe, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(lobe.axis_x, v), dot(lobe.axis_y, v), dot(lobe.axis_z, v));
}

/// The cross product of two vectors from the surface point, in the lobe's space: what it is the cross
/// product of there. Unlike that of the transformed vectors it keeps the digits of an edge that passes
/// the surface point closely.
fn ltc_transform_normal(lobe: LtcLobe, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(lobe.normal_x, v), dot(lobe.normal_y, v), dot(lobe.normal_z, v));
}

/// `v` in the surface's frame: its parts along tangent, bitangent and normal.
fn ltc_in_frame(surface: LtcSurface, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(surface.tangent, v), dot(surface.bitangent, v), dot(surface.normal, v));
}

/// A lobe whose rows are given for the caller's space only, with those for the surface's frame.
fn ltc_framed_lobe(surface: LtcSurface, lobe: LtcLobe) -> LtcLobe {
    var framed = lobe;
    framed.frame_x = ltc_in_frame(surface, lobe.axis_x);
    framed.frame_y = ltc_in_frame(surface, lobe.axis_y);
    framed.frame_z = ltc_in_frame(surface, lobe.axis_z);
    framed.frame_normal_x = ltc_in_frame(surface, lobe.normal_x);
    framed.frame_normal_y = ltc_in_frame(surface, lobe.normal_y);
    framed.frame_normal_z = ltc_in_frame(surface, lobe.normal_z);
    return framed;
}

/// ltc_transform for a vector in the surface's frame.
fn ltc_transform_framed(lobe: LtcLobe, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(lobe.frame_x, v), dot(lobe.frame_y, v), dot(lobe.frame_z, v));
}

/// ltc_transform_normal for a vector in the surface's frame.
fn ltc_transform_framed_normal(lobe: LtcLobe, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(lobe.frame_normal_x, v), dot(lobe.frame_normal_y, v), dot(lobe.frame_normal_z, v));
}

/// Reflected radiance of a specular surface with reflectance `normal_reflectance` (F0) at normal and
/// `grazing_reflectance` (F90) at grazing incidence, from the value (diffuse, specular, fresnel) of a
/// light of unit radiance (Schlick 1994).
fn ltc_reflectance(value: vec3<f32>, normal_reflectance: vec3<f32>, grazing_reflectance: vec3<f32>) -> vec3<f32> {
    return normal_reflectance * (value.y - value.z) + grazing_reflectance * value.z;
}

/// Schlick's factor (1 - v.h)^5 for light from a direction `toward` in the lobe's space, of any length.
fn ltc_schlick(surface: LtcSurface, lobe: LtcLobe, toward: vec3<f32>) -> f32 {
    var turned = lobe.frame_normal_x * toward.x + lobe.frame_normal_y * toward.y + lobe.frame_normal_z * toward.z;
    if (!ltc_use_cheap_distance) {
        turned = ltc_direction(turned);
    }
    // cos^2 of half the angle between view and light: the half vector's cosine, squared.
    var along = surface.sin_view * turned.x + surface.cos_view * turned.z;
    if (ltc_use_cheap_distance) {
        // Of a faint light: squares as small as that of its form factor count.
        along *= inverseSqrt(max(dot(turned, turned), LTC_TINY));
    }
    let half_cosine = clamp(0.5 + 0.5 * along, 0.0, 1.0);
    // The root may round up, and a fused product and difference sees by how much.
    let f = max(1.0 - half_cosine * inverseSqrt(max(half_cosine, 1e-20)), 0.0);
    return f * f * f * f * f;
}

/// The parts (specular, fresnel) of a light's value, from the `coverage` of a lobe, the share of
/// its energy that the light covers, and the mean direction `toward` the light in the lobe's space.
///
/// A lobe's shape is fitted to the whole BRDF. Schlick's part has another shape, and knows it from
/// the direction: for a small light it is (1 - v.h)^5 of the specular part, v.h taken at the light;
/// for a light that covers the whole lobe it is the table's average. The square of the coverage
/// leads from one to the other.
fn ltc_specular(surface: LtcSurface, lobe: LtcLobe, coverage: f32, toward: vec3<f32>) -> vec2<f32> {
    let schlick = ltc_schlick(surface, lobe, toward);
    let whole = coverage * coverage;
    return coverage * vec2<f32>(lobe.albedo, lobe.albedo * schlick * (1.0 - whole) + lobe.fresnel * whole);
}

/// The parts (specular, fresnel) of a lobe from the vector form factor in its space.
fn ltc_lobe_value(surface: LtcSurface, lobe: LtcLobe, toward: vec3<f32>) -> vec2<f32> {
    return ltc_specular(surface, lobe, clamp(toward.z / lobe.share, 0.0, 1.0), toward);
}

/// Schlick's factor at the mean direction of a light, from its vector form factor `toward` in a lobe's space.
///
/// The vector form factor t averages directions without the lobe's cosine. For a cap around a direction d, so small
/// that |t| is the square of its angle, the mean with the cosine is d cos + |t|/4 z, up to a factor: z turns in by
/// |t|^2/(4 cos) beside t. The cosine is left out, and LTC_MEAN_SHIFT is not the derived factor but the round number that
/// did best of a few on random quads.
fn ltc_mean_schlick(surface: LtcSurface, lobe: LtcLobe, toward: vec3<f32>) -> f32 {
    return ltc_schlick(surface, lobe, vec3<f32>(toward.xy, toward.z + LTC_MEAN_SHIFT * dot(toward, toward)));
}

/// The vector form factor, in a lobe's space, of a light all around the surface: half the sum of the normals of the two
/// horizons.
fn ltc_all_around(lobe: LtcLobe) -> vec3<f32> {
    let horizon = vec3<f32>(lobe.frame_normal_x.z, lobe.frame_normal_y.z, lobe.frame_normal_z.z);
    let unit = horizon * inverseSqrt(max(dot(horizon, horizon), LTC_TINY));
    return vec3<f32>(0.5 * unit.xy, 0.5 + 0.5 * unit.z);
}

/// The parts (specular, fresnel) of one lobe of a sum from the vector form factor in its space.
///
/// A single lobe is as in ltc_specular. In a sum Schlick's factor is that of the mean direction of the light. What a light
/// all around gets beyond that, the lobe's `fresnel` holds as an excess of either sign; it comes in with the variance of
/// the factor over the light, for which the square of the coverage stands.
fn ltc_lobes_part(surface: LtcSurface, lobe: LtcLobe, toward: vec3<f32>) -> vec2<f32> {
    var value = vec2<f32>(0.0);
    if (!ltc_use_second_lobe) {
        value = ltc_lobe_value(surface, lobe, toward);
    }
    if (ltc_use_second_lobe) {
        let coverage = clamp(toward.z / lobe.share, 0.0, 1.0);
        let schlick = lobe.albedo * ltc_mean_schlick(surface, lobe, toward) + lobe.fresnel * (coverage * coverage);
        value = coverage * vec2<f32>(lobe.albedo, clamp(schlick, 0.0, lobe.albedo));
    }
    return value;
}

/// The form factor of the light that arrives, from a signed one; `front` tells whether the light shows its
/// emitting side. A two-sided light is lit by the sign that the sum itself has: `front` may differ from it by
/// rounding where the light is seen edge-on.
fn ltc_received(form_factor: f32, front: bool, two_sided: bool) -> f32 {
    let both_sides = two_sided & ltc_use_two_sided;
    let received = select(form_factor, abs(form_factor), both_sides);
    return select(0.0, clamp(received, 0.0, 1.0), front | both_sides);
}

/// ltc_received for a vector form factor, whose sign is that of its z.
fn ltc_received_vector(form_factor: vec3<f32>, front: bool, two_sided: bool) -> vec3<f32> {
    let both_sides = two_sided & ltc_use_two_sided;
    let received = select(form_factor, -form_factor, both_sides & (form_factor.z < 0.0));
    return select(vec3<f32>(0.0), received, front | both_sides);
}

// ---------------------------------------------------------------------------------------------
// Edges
// ---------------------------------------------------------------------------------------------

/// (t / sin t) - 1 for an angle t of at most pi/2, from k = 1 - cos t. The relative error of
/// t / sin t is below 2e-7. The coefficients are the minimax fit `softbox::fit::fit_angle_excess`
/// of degree 7; no built-in inverse function of WGSL is guaranteed to be as close.
fn ltc_angle_excess(k: f32) -> f32 {
    let high = ((0.01714316 * k - 0.041149218) * k + 0.058181286) * k - 0.022927942;
    let low = ((0.03800492 + high * k) * k + 0.054650154) * k + 0.13356799;
    return (low * k + 0.33332586) * k;
}

/// The shorter of two vectors.
fn ltc_shorter(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return select(a, b, dot(b, b) < dot(a, a));
}

/// The cross product a x b of two vectors whose difference b - a is `side`. That with the shorter of the
/// two has the fewest digits to lose.
fn ltc_edge_normal(a: vec3<f32>, b: vec3<f32>, side: vec3<f32>) -> vec3<f32> {
    return cross(ltc_shorter(a, b), side);
}

/// The edge integral of the segment between the directions `a` and `b`: the angle between these unit vectors along
/// the unit normal of their plane, for which `normal` has the right direction.
fn ltc_edge_part(a: vec3<f32>, b: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    let product = cross(a, b - a);
    let squared = dot(product, product);
    let inverse_length = inverseSqrt(max(dot(normal, normal), LTC_TINY));
    return normal * (inverse_length * ltc_angle(a, b, squared * inverseSqrt(max(squared, 1e-30))));
}

/// The angle between the unit vectors `a` and `b`, whose sine is given.
fn ltc_angle(a: vec3<f32>, b: vec3<f32>, sine: f32) -> f32 {
    let chord = b - a;
    let k = 0.5 * dot(chord, chord);
    let bounded = min(sine, 1.0);
    let acute = bounded + bounded * ltc_angle_excess(min(k, saturate(2.0 - k)));
    return select(acute, LTC_PI - acute, k > 1.0);
}

/// The edge integral of the unit vectors `a` and `b`, less a part that vanishes over every closed
/// polygon. The offsets are a - reference and b - reference; `normal` has the direction of a x b.
///
/// Over a closed polygon the cross products of neighbours add up to those of their offsets from any
/// fixed vector. Offsets of a distant light are known to full relative precision, see ltc_offset,
/// so its form factor is too, where a sum over edges has lost its digits: its terms are of the
/// order of the light's angular size, its sum of that size squared. A unit vector's offset along the
/// unit reference is -offset^2 / 2 exactly; with that the sum stays precise for a light on the
/// horizon as well. Exact for polygons of every size.
fn ltc_edge_about(reference: vec3<f32>, a: vec3<f32>, a_offset: vec3<f32>, b: vec3<f32>, b_offset: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    let near = ltc_edge_near(reference, a, a_offset, b_offset);
    if (max(dot(a_offset, a_offset), dot(b_offset, b_offset)) < 0.0625) {
        return near;
    }
    // Far from the reference the vectors hold the digits of their difference, not the offsets.
    let near_part = ltc_edge_excess(a, b_offset - a_offset);
    return near - near_part + ltc_edge_part(a, b, normal) - cross(a, b - a);
}

/// ltc_edge_about for offsets that are both shorter than a quarter.
fn ltc_edge_near(reference: vec3<f32>, a: vec3<f32>, a_offset: vec3<f32>, b_offset: vec3<f32>) -> vec3<f32> {
    let along = dot(reference, cross(a_offset, b_offset));
    let across = 0.5 * (a_offset * dot(b_offset, b_offset) - b_offset * dot(a_offset, a_offset));
    return reference * along + cross(reference, across) + ltc_edge_excess(a, b_offset - a_offset);
}

/// The edge integral of a short edge from the unit vector `a` along `chord`, less the cross product of its ends.
fn ltc_edge_excess(a: vec3<f32>, chord: vec3<f32>) -> vec3<f32> {
    return cross(a, chord) * ltc_angle_excess(min(0.5 * dot(chord, chord), 1.0));
}

/// Difference of the directions of `target_point` and `origin`, which differ by `offset`, with the
/// relative precision of `offset`: the two unit vectors themselves differ by rounding alone when the
/// points are close. `reference` is the direction of `origin`.
fn ltc_offset(origin: vec3<f32>, reference: vec3<f32>, target_point: vec3<f32>, offset: vec3<f32>) -> vec3<f32> {
    // Bounded, so that cubes of what becomes of a point that is lost in the rounding of far ones stay in range.
    let inverse_length = inverseSqrt(max(dot(target_point, target_point), 1e-22));
    let length_sum = dot(target_point, target_point) * inverse_length + dot(origin, reference);
    let length_difference = dot(offset, origin + target_point) / max(length_sum, LTC_TINY);
    let near = (offset - reference * length_difference) * inverse_length;
    // With points far apart the subtraction loses nothing, and `offset` may be the less precise.
    let far = target_point * inverse_length - reference;
    return select(far, near, dot(offset, offset) < 0.0625 * dot(origin, origin));
}

/// Where the segment from `above` the plane z = 0 to `below` it meets that plane; only the direction of that
/// where it passes the surface point closely. `normal` has the direction of above x below; `exact` tells that it does not come
/// from these points and their rounding.
fn ltc_crossing(above: vec3<f32>, below: vec3<f32>, normal: vec3<f32>, exact: bool) -> vec3<f32> {
    let high = max(above.z, 0.0);
    let t = high / max(high - min(below.z, 0.0), LTC_TINY);
    let between = vec3<f32>(above.xy + (below.xy - above.xy) * t, 0.0);
    let above_square = dot(above, above);
    let below_square = dot(below, below);
    // Where the segment passes the surface point closely the ends cancel.
    let cancels = dot(between, between) < 1e-6 * max(above_square, below_square);
    // The plane of the segment still has its digits if an end is close as well, or if it is known. Its direction in the horizon
    // errs by the rounding of `normal` over the sine of the angle between the planes; `between` by an unknown part
    // of a segment that is that sine away from the horizon. Here the two are equal.
    let turned = vec3<f32>(normal.y, -normal.x, 0.0);
    let turned_square = dot(turned, turned);
    let normal_square = dot(normal, normal);
    let normal_inverse = inverseSqrt(max(normal_square, LTC_TINY));
    let rounding = select(inverseSqrt(max(above_square, LTC_TINY)) * inverseSqrt(max(below_square, LTC_TINY)), normal_inverse, exact);
    let tilted = turned_square * rounding > 2e-7 * normal_square * normal_inverse;
    // Of unit length, as products of two such must not vanish.
    return select(between, turned * inverseSqrt(max(turned_square, LTC_TINY)), cancels & tilted);
}

/// The form factor of what a horizon leaves of a round light: `size` is the sine of its half-angle, `tilt` the cosine between
/// its direction and the horizon's normal, `offset` the cosine of half the arc of its rim that is above, less for more,
/// and `reach` the sine (Snyder 1996, "Area Light Sources for Real-Time Graphics", in another form).
fn ltc_cap(size: f32, tilt: f32, offset: f32, reach: f32) -> f32 {
    // The angle between the ends of the chord, seen from the surface point, and that around the light's direction.
    let half_chord = size * reach;
    let k = 2.0 * half_chord * half_chord;
    let under = max(1.0 - half_chord * half_chord, 0.0);
    let sine = 2.0 * half_chord * (under * inverseSqrt(max(under, LTC_TINY)));
    let excess = sine * ltc_angle_excess(min(k, 2.0 - k));
    let rest = select(excess, LTC_PI - 2.0 * sine - excess, k > 1.0);
    let around_k = 2.0 * reach * reach;
    let lesser = 2.0 * reach * abs(offset);
    let acute = lesser + lesser * ltc_angle_excess(max(min(around_k, 2.0 - around_k), 0.0));
    let part = select(acute, LTC_PI - acute, around_k > 1.0);
    let angle = select(2.0 * LTC_PI - part, part, tilt < 0.0);
    return (rest + tilt * (sine * tilt + size * size * angle)) * LTC_OVER_TWO_PI;
}

// ---------------------------------------------------------------------------------------------
// Quads
//
// All in the surface's frame (tangent, bitangent, normal): there heights are z, the horizon is z = 0, and most
// entries of a lobe's matrix vanish.
// ---------------------------------------------------------------------------------------------

/// (t / sin t) `scale` for the angle t whose cosine is given, if that is acute; otherwise that of pi - t, see ltc_edge_turn.
fn ltc_edge_weight(cosine: f32, scale: f32) -> f32 {
    return scale + scale * ltc_angle_excess(saturate(1.0 - abs(cosine)));
}

/// What the `weight` from ltc_edge_weight lacks if the angle is obtuse: t / sin t is pi / sin t less that of pi - t, and the
/// length of `normal` is that sine over the scale. It comes from ltc_edge_normal, which keeps the distance at which an
/// edge passes the surface point.
fn ltc_edge_turn(cosine: f32, weight: f32, normal: vec3<f32>) -> f32 {
    return select(0.0, LTC_PI * inverseSqrt(max(dot(normal, normal), LTC_TINY)) - 2.0 * weight, cosine < 0.0);
}

/// 1 over the length of a point `v`, at most 1e15: the product of two of them, times what rounding leaves of a cross product that
/// vanishes, has a square in range.
fn ltc_inverse_length(v: vec3<f32>) -> f32 {
    return inverseSqrt(max(dot(v, v), 1e-30));
}

/// Vector form factor, times 2 pi and signed, of a quad, or of a pentagon with `five`; without it `e` is `d`. Each
/// normal is the cross product of the vertex of its name and the next one, and each edge's integral is the angle t
/// that it subtends along the unit vector of its normal (Lambert; Baum et al. 1989). Where that angle is acute
/// it is t / sin t times the normal over the lengths of both vertices. Where it is not, that sine has no digits left
/// for an edge that subtends nearly 180 degrees, which is every edge of a light that touches the surface: there the
/// normal's own length takes its place.
fn ltc_edges(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, e: vec3<f32>, a_normal: vec3<f32>, b_normal: vec3<f32>, c_normal: vec3<f32>, d_normal: vec3<f32>, e_normal: vec3<f32>, five: bool) -> vec3<f32> {
    let a_inverse = ltc_inverse_length(a);
    let b_inverse = ltc_inverse_length(b);
    let c_inverse = ltc_inverse_length(c);
    let d_inverse = ltc_inverse_length(d);
    var e_inverse = d_inverse;
    var d_cosine = 1.0;
    var d_weight = 0.0;
    if (five) {
        e_inverse = ltc_inverse_length(e);
        let d_scale = d_inverse * e_inverse;
        d_cosine = dot(d, e) * d_scale;
        d_weight = ltc_edge_weight(d_cosine, d_scale);
    }
    let a_scale = a_inverse * b_inverse;
    let b_scale = b_inverse * c_inverse;
    let c_scale = c_inverse * d_inverse;
    let e_scale = e_inverse * a_inverse;
    let a_cosine = dot(a, b) * a_scale;
    let b_cosine = dot(b, c) * b_scale;
    let c_cosine = dot(c, d) * c_scale;
    let e_cosine = dot(e, a) * e_scale;
    var a_weight = ltc_edge_weight(a_cosine, a_scale);
    var b_weight = ltc_edge_weight(b_cosine, b_scale);
    var c_weight = ltc_edge_weight(c_cosine, c_scale);
    var e_weight = ltc_edge_weight(e_cosine, e_scale);
    let obtuse = min(min(min(a_cosine, b_cosine), min(c_cosine, d_cosine)), e_cosine) < 0.0;
    if (obtuse) {
        a_weight += ltc_edge_turn(a_cosine, a_weight, a_normal);
        b_weight += ltc_edge_turn(b_cosine, b_weight, b_normal);
        c_weight += ltc_edge_turn(c_cosine, c_weight, c_normal);
        d_weight += ltc_edge_turn(d_cosine, d_weight, d_normal);
        e_weight += ltc_edge_turn(e_cosine, e_weight, e_normal);
    }
    return -(a_normal * a_weight + b_normal * b_weight + c_normal * c_weight + d_normal * d_weight + e_normal * e_weight);
}

/// Where the edge from `above` the plane z = 0 to `below` it meets that plane: `turned`, which is what the plane of the edge
/// says, or for an edge that is nearly parallel to the horizon what its ends say, if that has more digits: those cancel
/// where the edge passes the surface point closely. `tilt` is the squared sine between that plane and the horizon; `rise` is
/// the height of the plane's normal, whose sign is that of the turn from `above` to `below`: a crossing that does not lie on
/// that turn would put the light on the other side of the point.
fn ltc_flat_crossing(above: vec3<f32>, below: vec3<f32>, tilt: f32, rise: f32, turned: vec2<f32>) -> vec2<f32> {
    let t = max(above.z, 0.0) / max(above.z - below.z, LTC_TINY);
    let between = above.xy + (below.xy - above.xy) * t;
    let squared = dot(between, between);
    let after = (above.x * turned.y - above.y * turned.x) * rise >= 0.0;
    let before = (turned.x * below.y - turned.y * below.x) * rise >= 0.0;
    let resolved = tilt * max(dot(above, above), dot(below, below)) > squared;
    let tilted = (tilt > 1e-3) | (resolved & after & before);
    return select(between * inverseSqrt(max(squared, LTC_TINY)), turned, tilted);
}

/// Cross product of the ends of a part of an edge, unit vectors, and the cosine between them.
fn ltc_part(start: vec3<f32>, end: vec3<f32>) -> vec4<f32> {
    return vec4<f32>(cross(start, end - start), dot(start, end));
}

/// What a part from ltc_part times its weight lacks if the angle is obtuse; see ltc_edge_turn.
fn ltc_part_turn(part: vec4<f32>, weight: f32, normal: vec3<f32>, present: bool) -> vec3<f32> {
    return select(vec3<f32>(0.0), normal * (LTC_PI * inverseSqrt(max(dot(normal, normal), LTC_TINY))) - part.xyz * (2.0 * weight), present & (part.w < 0.0));
}

/// The sine of the elevation down to which a vertex counts as above the lobe's horizon. Where that horizon is the
/// surface's, as it is seen along the normal, rounding would scatter the points of a light cut there to both
/// sides. The lobe's space squeezes heights by the length of its third axis.
fn ltc_horizon(lobe: LtcLobe) -> f32 {
    return -1e-6 * min(ltc_extent(lobe.frame_z), 1.0);
}

/// Vector form factor, times 2 pi and signed, of a convex pentagon in the lobe's space, cut at the lobe's
/// horizon z = 0. Each normal is the cross product of the vertex of its name and the
/// next one. Repeated vertices make it any smaller polygon; `five` tells whether `d` and `e` differ. A vertex counts as
/// above the horizon if the sine of its elevation is larger than `horizon`, which is ltc_horizon.
fn ltc_pentagon(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, e: vec3<f32>, a_normal: vec3<f32>, b_normal: vec3<f32>, c_normal: vec3<f32>, d_normal: vec3<f32>, e_normal: vec3<f32>, five: bool, horizon: f32) -> vec3<f32> {
    let a_height = a.z * ltc_inverse_length(a);
    let b_height = b.z * ltc_inverse_length(b);
    let c_height = c.z * ltc_inverse_length(c);
    let d_height = d.z * ltc_inverse_length(d);
    var e_height = d_height;
    if (five) {
        e_height = e.z * ltc_inverse_length(e);
    }
    let highest = max(max(max(a_height, b_height), max(c_height, d_height)), e_height);
    if (highest <= horizon) {
        return vec3<f32>(0.0);
    }
    let lowest = min(min(min(a_height, b_height), min(c_height, d_height)), e_height);
    if (lowest > horizon) {
        return ltc_edges(a, b, c, d, e, a_normal, b_normal, c_normal, d_normal, e_normal, five);
    }
    let a_up = a_height > horizon;
    let b_up = b_height > horizon;
    let c_up = c_height > horizon;
    let d_up = d_height > horizon;
    let e_up = e_height > horizon;
    // A convex polygon leaves the upper side once and comes back once, where the planes of the edges say.
    let leave_b = b_up & !c_up;
    let leave_c = c_up & !d_up;
    let leave_d = d_up & !e_up;
    let leave_e = e_up & !a_up;
    let enter_b = b_up & !a_up;
    let enter_c = c_up & !b_up;
    let enter_d = d_up & !c_up;
    let enter_e = e_up & !d_up;
    let leave_normal = select(select(select(select(a_normal, b_normal, leave_b), c_normal, leave_c), d_normal, leave_d), e_normal, leave_e);
    let enter_normal = select(select(select(select(e_normal, a_normal, enter_b), b_normal, enter_c), c_normal, enter_d), d_normal, enter_e);
    let leave_squared = dot(leave_normal.xy, leave_normal.xy);
    let enter_squared = dot(enter_normal.xy, enter_normal.xy);
    var leave_xy = vec2<f32>(leave_normal.y, -leave_normal.x) * inverseSqrt(max(leave_squared, LTC_TINY));
    var enter_xy = vec2<f32>(-enter_normal.y, enter_normal.x) * inverseSqrt(max(enter_squared, LTC_TINY));
    let leave_tilt = leave_squared / max(dot(leave_normal, leave_normal), LTC_TINY);
    let enter_tilt = enter_squared / max(dot(enter_normal, enter_normal), LTC_TINY);
    let flat_edge = min(leave_tilt, enter_tilt) <= 1e-3;
    if (flat_edge) {
        let leave_from = select(select(select(select(a, b, leave_b), c, leave_c), d, leave_d), e, leave_e);
        let leave_to = select(select(select(select(b, c, leave_b), d, leave_c), e, leave_d), a, leave_e);
        let enter_to = select(select(select(select(a, b, enter_b), c, enter_c), d, enter_d), e, enter_e);
        let enter_from = select(select(select(select(e, a, enter_b), b, enter_c), c, enter_d), d, enter_e);
        leave_xy = ltc_flat_crossing(leave_from, leave_to, leave_tilt, leave_normal.z, leave_xy);
        enter_xy = ltc_flat_crossing(enter_to, enter_from, enter_tilt, -enter_normal.z, enter_xy);
    }
    let leave = vec3<f32>(leave_xy, 0.0);
    let enter = vec3<f32>(enter_xy, 0.0);
    let a_unit = a * ltc_inverse_length(a);
    let b_unit = b * ltc_inverse_length(b);
    let c_unit = c * ltc_inverse_length(c);
    let d_unit = d * ltc_inverse_length(d);
    let e_unit = e * ltc_inverse_length(e);
    // Each edge runs between what is left of its ends.
    let a_part = ltc_part(select(enter, a_unit, a_up), select(leave, b_unit, b_up));
    let b_part = ltc_part(select(enter, b_unit, b_up), select(leave, c_unit, c_up));
    let c_part = ltc_part(select(enter, c_unit, c_up), select(leave, d_unit, d_up));
    let d_part = ltc_part(select(enter, d_unit, d_up), select(leave, e_unit, e_up));
    let e_part = ltc_part(select(enter, e_unit, e_up), select(leave, a_unit, a_up));
    let a_weight = select(0.0, ltc_edge_weight(a_part.w, 1.0), a_up | b_up);
    let b_weight = select(0.0, ltc_edge_weight(b_part.w, 1.0), b_up | c_up);
    let c_weight = select(0.0, ltc_edge_weight(c_part.w, 1.0), c_up | d_up);
    let d_weight = select(0.0, ltc_edge_weight(d_part.w, 1.0), d_up | e_up);
    let e_weight = select(0.0, ltc_edge_weight(e_part.w, 1.0), e_up | a_up);
    var sum = a_part.xyz * a_weight + b_part.xyz * b_weight + c_part.xyz * c_weight + d_part.xyz * d_weight + e_part.xyz * e_weight;
    let obtuse = min(min(min(a_part.w, b_part.w), min(c_part.w, d_part.w)), e_part.w) < 0.0;
    if (obtuse) {
        sum += ltc_part_turn(a_part, a_weight, a_normal, a_up | b_up) + ltc_part_turn(b_part, b_weight, b_normal, b_up | c_up)
            + ltc_part_turn(c_part, c_weight, c_normal, c_up | d_up) + ltc_part_turn(d_part, d_weight, d_normal, d_up | e_up)
            + ltc_part_turn(e_part, e_weight, e_normal, e_up | a_up);
    }
    // The horizon from exit to entry.
    let along = dot(leave_xy, enter_xy);
    let area = leave.x * enter.y - leave.y * enter.x;
    let acute = area * ltc_edge_weight(along, 1.0);
    let angle = select(acute, select(LTC_PI, -LTC_PI, area < 0.0) - acute, along < 0.0);
    return -vec3<f32>(sum.xy, sum.z + angle);
}

/// Vector form factor, times 2 pi and signed, of a pentagon above the horizon, from its first vertex `origin` and the
/// offsets of the others from there, all much shorter than the distance; `five` tells whether `d` and `e` differ.
///
/// Over a closed polygon the cross products of neighbouring directions add up to those of their offsets from any of them.
/// These offsets are known to full relative precision, where the terms of a sum over edges cancel: they are of the
/// order of the light's angular size, their sum of that size squared. A unit vector's offset along the
/// unit vector that it is measured from is -offset^2 / 2 exactly; with that the sum stays precise for a light on the
/// horizon as well.
fn ltc_far_pentagon(origin: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, e: vec3<f32>, five: bool) -> vec3<f32> {
    let squared = dot(origin, origin);
    let inverse_length = inverseSqrt(max(squared, LTC_TINY));
    let reference = origin * inverse_length;
    let distance_to_origin = squared * inverse_length;
    let b_offset = ltc_far_offset(origin, reference, distance_to_origin, b);
    let c_offset = ltc_far_offset(origin, reference, distance_to_origin, c);
    let d_offset = ltc_far_offset(origin, reference, distance_to_origin, d);
    var e_offset = d_offset;
    var fifth_area = vec3<f32>(0.0);
    var fifth_chord = vec3<f32>(0.0);
    var fifth_excess = 0.0;
    if (five) {
        e_offset = ltc_far_offset(origin, reference, distance_to_origin, e);
        fifth_area = cross(d_offset, e_offset);
        fifth_chord = e_offset - d_offset;
        fifth_excess = ltc_angle_excess(0.5 * dot(fifth_chord, fifth_chord));
    }
    let b_squared = dot(b_offset, b_offset);
    let c_squared = dot(c_offset, c_offset);
    let d_squared = dot(d_offset, d_offset);
    let e_squared = dot(e_offset, e_offset);
    let b_area = cross(b_offset, c_offset);
    let c_area = cross(c_offset, d_offset);
    let b_chord = c_offset - b_offset;
    let c_chord = d_offset - c_offset;
    // What each edge's angle exceeds its sine by, relative to it.
    let a_excess = ltc_angle_excess(0.5 * b_squared);
    let b_excess = ltc_angle_excess(0.5 * dot(b_chord, b_chord));
    let c_excess = ltc_angle_excess(0.5 * dot(c_chord, c_chord));
    let e_excess = ltc_angle_excess(0.5 * e_squared);
    let across = b_offset * (0.5 * c_squared + a_excess) + c_offset * (0.5 * (d_squared - b_squared))
        + d_offset * (0.5 * (e_squared - c_squared)) - e_offset * (0.5 * d_squared + e_excess)
        + b_chord * b_excess + c_chord * c_excess + fifth_chord * fifth_excess;
    let along = dot(reference, b_area + c_area + fifth_area);
    return -(reference * along + cross(reference, across) + b_area * b_excess + c_area * c_excess + fifth_area * fifth_excess);
}

/// Difference of the directions of `origin + offset` and `origin`, for an offset much shorter than `origin`, with the
/// relative precision of `offset`. `reference` is the direction of `origin`.
fn ltc_far_offset(origin: vec3<f32>, reference: vec3<f32>, distance_to_origin: f32, offset: vec3<f32>) -> vec3<f32> {
    let rise = dot(offset, origin + origin + offset);
    let squared = max(distance_to_origin * distance_to_origin + rise, LTC_TINY);
    let inverse_length = inverseSqrt(squared);
    let length_difference = rise / (squared * inverse_length + distance_to_origin);
    return (offset - reference * length_difference) * inverse_length;
}

/// A convex quad light, cut at the surface's horizon: what all lobes share of the work on it, in the surface's frame.
struct LtcQuad {
    /// First vertex of the pentagon that is left of the quad, from the surface point.
    a: vec3<f32>,
    /// Whether the light reaches the surface at all.
    reaches: bool,
    /// Second vertex; of a distant light the offset from the first one, which keeps its digits, like the others.
    b: vec3<f32>,
    /// Whether the horizon cuts the quad.
    clipped: bool,
    /// Third vertex.
    c: vec3<f32>,
    /// Whether the light is small for its distance.
    distant: bool,
    /// Fourth vertex.
    d: vec3<f32>,
    /// Whether the light shows its emitting side.
    front: bool,
    /// Fifth vertex; where the quad is not cut it coincides with the fourth.
    e: vec3<f32>,
    /// Whether the light emits from both sides.
    two_sided: bool,
    /// Cross product of the first and the second vertex; of a near light only, like the others.
    a_normal: vec3<f32>,
    /// That of the fourth and the fifth, the exit and the entry, is vertical: its height.
    rim: f32,
    /// That of the second and the third.
    b_normal: vec3<f32>,
    /// That of the third and the fourth.
    c_normal: vec3<f32>,
    /// That of the fifth and the first.
    e_normal: vec3<f32>,
}

/// `v` with its part along the normal.
fn ltc_with_rise(surface: LtcSurface, v: vec3<f32>) -> vec4<f32> {
    return vec4<f32>(v, dot(surface.normal, v));
}

/// What ltc_with_rise gives in the surface's frame.
fn ltc_rise_in_frame(surface: LtcSurface, v: vec4<f32>) -> vec3<f32> {
    return vec3<f32>(dot(surface.tangent, v.xyz), dot(surface.bitangent, v.xyz), v.w);
}

/// Cuts a convex quad light with the vertices `a`, `b`, `c`, `d` at the surface's horizon; see ltc_quad.
fn ltc_quad_begin(surface: LtcSurface, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, two_sided: bool) -> LtcQuad {
    if (ltc_use_cheap_horizon & ltc_use_cheap_distance) {
        return ltc_fast_quad(surface, a, b, c, d, two_sided);
    }
    let origin = surface.position * LTC_HEADROOM;
    let a_far = a * LTC_HEADROOM;
    let a_full = a_far - origin;
    let b_full = b * LTC_HEADROOM - origin;
    let c_full = c * LTC_HEADROOM - origin;
    let d_full = d * LTC_HEADROOM - origin;
    let extent = max(max(ltc_extent(a_full), ltc_extent(b_full)), max(ltc_extent(c_full), ltc_extent(d_full)));
    let scale = 1.0 / max(extent, LTC_TINY);
    // Differences of the vertices themselves: those of the vectors to the surface have lost digits.
    let side_b = (b * LTC_HEADROOM - a_far) * scale;
    let side_c = (c * LTC_HEADROOM - a_far) * scale;
    let side_d = (d * LTC_HEADROOM - a_far) * scale;
    let p_a = a_full * scale;
    var quad: LtcQuad;
    quad.front = dot(cross(side_c, side_d - side_b), p_a) < 0.0;
    quad.two_sided = two_sided & ltc_use_two_sided;
    quad.reaches = false;
    if (!(quad.front | quad.two_sided)) {
        return quad;
    }

    // What is cut at the horizon: the vertices of a near light, the offsets of a distant one's from its
    // first vertex.
    let size_squared = max(max(dot(side_b, side_b), dot(side_c, side_c)), dot(side_d, side_d));
    let distant = !ltc_use_cheap_distance & (size_squared < 0.0625 * dot(p_a, p_a));
    let v_a = ltc_with_rise(surface, p_a);
    var v_b = ltc_with_rise(surface, select(b_full * scale, side_b, distant));
    var v_c = ltc_with_rise(surface, select(c_full * scale, side_c, distant));
    var v_d = ltc_with_rise(surface, select(d_full * scale, side_d, distant));
    let base_height = select(0.0, v_a.w, distant);
    let a_up = v_a.w > 0.0;
    let b_up = base_height + v_b.w > 0.0;
    let c_up = base_height + v_c.w > 0.0;
    let d_up = base_height + v_d.w > 0.0;
    if (!(a_up | b_up | c_up | d_up)) {
        return quad;
    }
    quad.reaches = true;
    quad.distant = distant;
    quad.clipped = !(a_up & b_up & c_up & d_up) & !ltc_use_cheap_horizon;
    var first = v_a;
    var v_e = v_d;
    if (!ltc_use_cheap_horizon & quad.clipped) {
        // Turn the quad until its last vertex is the last one below; the quad cut at the surface is
        // then the pentagon of the first three vertices, the exit and the entry.
        let last_a = b_up & !a_up;
        let last_b = c_up & !b_up;
        let last_c = d_up & !c_up;
        let half_turn = last_b | last_c;
        let turn = last_a | last_c;
        let start = select(v_a, vec4<f32>(0.0), distant);
        let half_a = select(start, v_c, half_turn);
        let half_b = select(v_b, v_d, half_turn);
        let half_c = select(v_c, start, half_turn);
        let half_d = select(v_d, v_b, half_turn);
        let q_a = select(half_a, half_b, turn);
        let q_b = select(half_b, half_c, turn);
        let q_c = select(half_c, half_d, turn);
        let q_d = select(half_d, half_a, turn);
        let up_b = base_height + q_b.w > 0.0;
        let up_c = base_height + q_c.w > 0.0;
        let leave_from = select(select(q_a, q_b, up_b), q_c, up_c);
        let leave_to = select(select(q_b, q_c, up_b), q_d, up_c);
        let leave_side = leave_to - leave_from;
        let enter_side = q_d - q_a;
        // Between the ends, also where a compiler rounds one height in two ways.
        let leave = leave_from + leave_side * saturate((base_height + leave_from.w) / max(-leave_side.w, LTC_TINY));
        let enter = q_a + enter_side * saturate((base_height + q_a.w) / max(-enter_side.w, LTC_TINY));
        first = q_a;
        v_b = select(leave, q_b, up_b);
        v_c = select(leave, q_c, up_c);
        v_d = leave;
        v_e = enter;
        if (distant) {
            // The first vertex is another one now.
            first = v_a + q_a;
            v_b -= q_a;
            v_c -= q_a;
            v_d -= q_a;
            v_e -= q_a;
        }
    }
    quad.a = ltc_rise_in_frame(surface, first);
    quad.b = ltc_rise_in_frame(surface, v_b);
    quad.c = ltc_rise_in_frame(surface, v_c);
    quad.d = ltc_rise_in_frame(surface, v_d);
    quad.e = quad.d;

    if (!ltc_use_cheap_horizon & quad.clipped) {
        quad.e = ltc_rise_in_frame(surface, v_e);
    }
    if (!distant) {
        // Cross products of neighbouring vertices, from the edges' own vectors and from the nearer end, for any of them may
        // be close to the surface point. In the caller's space: where an edge along one of its axes all but touches
        // that point, a turn of its ends would lose the distance.
        quad.a_normal = ltc_in_frame(surface, ltc_edge_normal(first.xyz, v_b.xyz, v_b.xyz - first.xyz));
        quad.b_normal = ltc_in_frame(surface, ltc_edge_normal(v_b.xyz, v_c.xyz, v_c.xyz - v_b.xyz));
        quad.c_normal = ltc_in_frame(surface, ltc_edge_normal(v_c.xyz, v_d.xyz, v_d.xyz - v_c.xyz));
        quad.e_normal = ltc_in_frame(surface, ltc_edge_normal(v_e.xyz, first.xyz, first.xyz - v_e.xyz));
        if (!ltc_use_cheap_horizon & quad.clipped) {
            // The edge from exit to entry lies on the horizon, whatever rounding says of its normal.
            quad.rim = dot(surface.normal, ltc_edge_normal(v_d.xyz, v_e.xyz, v_e.xyz - v_d.xyz));
        }
    }
    return quad;
}

/// Vector form factor, times 2 pi and signed, of what the surface's horizon leaves of a quad, in the surface's frame.
fn ltc_quad_form_factor(quad: LtcQuad) -> vec3<f32> {
    if (ltc_use_cheap_horizon & ltc_use_cheap_distance) {
        return ltc_fast_form_factor(quad.a, quad.b, quad.c, quad.d);
    }
    if (!ltc_use_cheap_distance & quad.distant) {
        return ltc_far_pentagon(quad.a, quad.b, quad.c, quad.d, quad.e, quad.clipped);
    }
    return ltc_edges(quad.a, quad.b, quad.c, quad.d, quad.e, quad.a_normal, quad.b_normal, quad.c_normal, vec3<f32>(0.0, 0.0, quad.rim),
        quad.e_normal, quad.clipped);
}

/// The form factor of a quad, 0 to 1.
fn ltc_quad_diffuse(surface: LtcSurface, quad: LtcQuad) -> f32 {
    if (!quad.reaches) {
        return 0.0;
    }
    if (ltc_use_cheap_horizon) {
        let toward = ltc_quad_form_factor(quad) * select(-LTC_OVER_TWO_PI, LTC_OVER_TWO_PI, quad.front);
        return ltc_round_above(toward, toward.z);
    }
    return ltc_received(ltc_quad_form_factor(quad).z * LTC_OVER_TWO_PI, true, quad.two_sided);
}

/// The vector form factor of a quad, cut at the surface's horizon, in the caller's space, towards the light.
fn ltc_quad_toward(surface: LtcSurface, quad: LtcQuad) -> vec3<f32> {
    let form_factor = ltc_quad_form_factor(quad) * LTC_OVER_TWO_PI;
    let toward = select(form_factor, -form_factor, form_factor.z < 0.0);
    return surface.tangent * toward.x + surface.bitangent * toward.y + surface.normal * toward.z;
}

/// The vector form factor of a quad in a lobe's space, cut at both horizons, towards the light.
fn ltc_quad_lobe(quad: LtcQuad, lobe: LtcLobe) -> vec3<f32> {
    if (!quad.reaches) {
        return vec3<f32>(0.0);
    }
    if (ltc_use_cheap_horizon & ltc_use_cheap_distance) {
        return ltc_fast_lobe(quad, lobe);
    }
    let a = ltc_transform_framed(lobe, quad.a);
    var b = ltc_transform_framed(lobe, quad.b);
    var c = ltc_transform_framed(lobe, quad.c);
    var d = ltc_transform_framed(lobe, quad.d);
    var e = d;
    if (quad.clipped) {
        e = ltc_transform_framed(lobe, quad.e);
    }
    var a_normal = quad.a_normal;
    var b_normal = quad.b_normal;
    var c_normal = quad.c_normal;
    var e_normal = quad.e_normal;
    var rim = quad.rim;
    var distant = false;
    if (!ltc_use_cheap_distance & quad.distant) {
        // The lobe's space stretches: there a distant light may be near.
        let lowest = a.z + min(min(min(b.z, c.z), min(d.z, e.z)), 0.0);
        let highest = a.z + max(max(max(b.z, c.z), max(d.z, e.z)), 0.0);
        let size = max(max(dot(b, b), dot(c, c)), max(dot(d, d), dot(e, e)));
        distant = size < 0.0625 * dot(a, a);
        if (!ltc_use_cheap_horizon) {
            if (distant & (highest <= 0.0)) {
                return vec3<f32>(0.0);
            }
            // A light smaller than 0.006 of its distance shows on the lobe's horizon less than that share of itself; cut
            // as a near one it would have no digits left.
            distant = distant & ((lowest > 0.0) | (size < 4e-5 * dot(a, a)));
        }
        if (!distant) {
            b += a;
            c += a;
            d += a;
            e += a;
            a_normal = cross(quad.a, quad.b);
            b_normal = cross(quad.a + quad.c, quad.c - quad.b);
            c_normal = cross(quad.a + quad.d, quad.d - quad.c);
            e_normal = cross(quad.e, quad.a);
            rim = cross(quad.a + quad.e, quad.e - quad.d).z;
        }
    }
    if (ltc_use_cheap_horizon) {
        var moved = quad;
        moved.distant = distant;
        moved.a = a;
        moved.b = b;
        moved.c = c;
        moved.d = d;
        moved.e = e;
        moved.a_normal = ltc_transform_framed_normal(lobe, a_normal);
        moved.b_normal = ltc_transform_framed_normal(lobe, b_normal);
        moved.c_normal = ltc_transform_framed_normal(lobe, c_normal);
        moved.e_normal = ltc_transform_framed_normal(lobe, e_normal);
        let winding = ltc_quad_form_factor(moved) * LTC_OVER_TWO_PI;
        let form_factor = select(-winding, winding, quad.front);
        return vec3<f32>(form_factor.xy, ltc_round_above(form_factor, form_factor.z)) * lobe.share;
    }
    var sum: vec3<f32>;
    if (!ltc_use_cheap_distance & distant) {
        sum = ltc_far_pentagon(a, b, c, d, e, quad.clipped);
    } else {
        sum = ltc_pentagon(a, b, c, d, e, ltc_transform_framed_normal(lobe, a_normal), ltc_transform_framed_normal(lobe, b_normal),
            ltc_transform_framed_normal(lobe, c_normal), ltc_transform_framed_normal(lobe, vec3<f32>(0.0, 0.0, rim)),
            ltc_transform_framed_normal(lobe, e_normal), quad.clipped, ltc_horizon(lobe));
    }
    return ltc_received_vector(sum * LTC_OVER_TWO_PI, true, quad.two_sided);
}

/// The parts (specular, fresnel) that a sum of lobes reflects of a quad of unit radiance.
fn ltc_quad_specular(surface: LtcSurface, quad: LtcQuad, lobes: LtcLobes) -> vec2<f32> {
    var value = vec2<f32>(0.0);
    if (!ltc_use_second_lobe) {
        value = ltc_lobes_part(surface, lobes.first, ltc_quad_lobe(quad, lobes.first));
    }
    if (ltc_use_second_lobe) {
        var lobe = lobes.first;
        var shape = lobes.second;
        var index = 1;
        loop {
            value += ltc_lobes_part(surface, lobe, ltc_quad_lobe(quad, lobe));
            if (index >= lobes.count) {
                break;
            }
            lobe = ltc_shape_lobe(surface, shape);
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
            index += 1;
        }
    }
    return value;
}

/// The value (diffuse, specular, fresnel) of a convex quad light with the vertices `a`, `b`, `c`,
/// `d`, counter-clockwise seen from the side that emits (from both with `two_sided`). Repeated
/// vertices make it a triangle. For a quad that is not convex use the polygon functions.
///
/// Error of the form factor against exact arithmetic: at most 1e-6 for a light whose size is at
/// least a tenth of its distance, 2e-6 for one that touches or all but touches the surface; at most
/// 1e-4 of its value for smaller ones down to 1e-5 of the distance, unless they are seen edge-on.
/// Where an edge passes by at less than 1/25 of the distance of its ends, 4e-8 times that ratio takes the
/// place of 1e-6: so much do the coordinates' own digits leave open.
///
/// With the switch for a cheap horizon a light is not cut. A round light of the same vector form factor stands in for
/// it where a horizon would cut it (Hill and Heitz 2016, "Real-Time Area Lighting: a Journey from Research to
/// Production"), and lobes are cut at their own horizon only. A light above the horizons has the same value; one that
/// straddles them is off by up to 0.1, by 1.9 % of the mean on random quads, and light may come from a little below the
/// surface.
///
/// With the switch for a cheap distance a small light loses digits: the form factor's relative error is about 1e-7 times
/// its distance over its size, up to 1e-6 times that where it is not seen near the normal. With both switches each edge is off by up to 8e-4 of itself besides, see ltc_fast_ratio.
fn ltc_quad(surface: LtcSurface, lobes: LtcLobes, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, two_sided: bool) -> vec3<f32> {
    let quad = ltc_quad_begin(surface, a, b, c, d, two_sided);
    if (!quad.reaches) {
        return vec3<f32>(0.0);
    }
    var specular = vec2<f32>(0.0);
    if (ltc_use_ggx) {
        specular = ltc_quad_specular(surface, quad, lobes);
    }
    return vec3<f32>(ltc_quad_diffuse(surface, quad), specular);
}

// ---------------------------------------------------------------------------------------------
// Polygons of any number of vertices, convex or not
//
//     var polygon = ltc_polygon_begin(surface, first_vertex);
//     ltc_polygon_add(&polygon, surface, lobes, vertex);    // for each of the others
//     let value = ltc_polygon_end(&polygon, surface, lobes, two_sided);
//
// With several lobes, add each vertex to the outline and then to each lobe, the first one again at the end:
//
//     var outline = ltc_outline_begin(surface, first_vertex);
//     var sum = ltc_outline_lobe_begin();
//     ltc_outline_add(&outline, surface, vertex);
//     ltc_outline_lobe_add(&sum, outline, lobe);
//     let form_factor = ltc_outline_diffuse(outline, two_sided);
//     let toward = ltc_outline_lobe(outline, sum, two_sided);
//
// Nothing is stored but sums and one point on each horizon. All points where a planar polygon
// crosses a plane through the surface point lie on one straight line, so the pieces of the horizon
// that close the cut polygon can all be measured from the first such point: forth to each point of
// entry, back from each point of exit.
// ---------------------------------------------------------------------------------------------

/// State of a polygon that is given vertex by vertex, and its last edge, cut at the surface's horizon: what
/// all lobes share of the work on it. Read and written by the library alone.
struct LtcOutline {
    /// First vertex, in the caller's space.
    first: vec3<f32>,
    /// Factor that brings the first vertex to a distance of about 1.
    scale: f32,
    /// Last vertex so far, in the caller's space.
    previous: vec3<f32>,
    /// Twice the signed area so far times the height of the surface point over the light's plane.
    facing: f32,
    /// Whether the first vertex counts as above the surface.
    first_up: bool,
    /// Whether the last vertex so far does.
    previous_up: bool,
    /// First point on the surface's horizon.
    crossing: vec3<f32>,
    /// Form factor so far, times 2 pi and signed.
    diffuse: f32,
    /// Offset of that point from the first vertex.
    crossing_offset: vec3<f32>,
    /// Whether there is such a point.
    crossed: bool,
    /// The first vertex, scaled as the points of the last edge.
    reference: vec3<f32>,
    /// Whether the last edge starts above the horizon; otherwise what is left of it starts on the horizon.
    starts_up: bool,
    /// Whether it ends above the horizon.
    ends_up: bool,
    /// Whether it ends at the first vertex.
    returns: bool,
    /// Where what is left of the last edge starts.
    start: vec3<f32>,
    /// Whether the last edge leaves the upper side or comes back to it, so that a piece of the horizon closes it.
    closes: bool,
    /// Offset of the start from the first vertex.
    start_offset: vec3<f32>,
    /// Where it ends.
    end: vec3<f32>,
    /// Offset of the end.
    end_offset: vec3<f32>,
    /// Cross product of start and end.
    normal: vec3<f32>,
    /// Where the piece of the horizon starts.
    horizon_start: vec3<f32>,
    /// Offset of that point.
    horizon_start_offset: vec3<f32>,
    /// Where it ends.
    horizon_end: vec3<f32>,
    /// Offset of that point.
    horizon_end_offset: vec3<f32>,
    /// Cross product of the two.
    horizon_normal: vec3<f32>,
    /// Vector form factor so far, times 2 pi and signed; for a cheap horizon only.
    sum: vec3<f32>,
}

/// What one lobe knows of an outline. Read and written by the library alone.
struct LtcOutlineLobe {
    /// First point on the lobe's horizon, in the lobe's space.
    crossing: vec3<f32>,
    /// Whether there is such a point.
    crossed: bool,
    /// Its offset from the first vertex.
    crossing_offset: vec3<f32>,
    /// Whether there has been an edge.
    begun: bool,
    /// Whether the first vertex counts as above the lobe's horizon.
    first_up: bool,
    /// Whether the last vertex so far does.
    previous_up: bool,
    /// Whether the outline's first point on the surface's horizon does.
    crossing_up: bool,
    /// Vector form factor so far in the lobe's space, times 2 pi and signed.
    sum: vec3<f32>,
    /// The lobe's share above the surface; for a cheap horizon only.
    share: f32,
}

/// What the lobes of a sum know of an outline. Those that are switched off are not read.
struct LtcOutlineLobes {
    /// What the first lobe knows.
    first: LtcOutlineLobe,
    /// What the second lobe knows.
    second: LtcOutlineLobe,
    /// What the third lobe knows.
    third: LtcOutlineLobe,
}

/// A polygon's outline and the lobes that it lights.
struct LtcPolygon {
    /// The outline.
    outline: LtcOutline,
    /// What the lobes know of it.
    sums: LtcOutlineLobes,
}

/// Starts an outline at its first vertex.
fn ltc_outline_begin(surface: LtcSurface, corner: vec3<f32>) -> LtcOutline {
    let to_first = (corner * LTC_HEADROOM) - (surface.position * LTC_HEADROOM);
    var outline: LtcOutline;
    outline.first = corner;
    outline.scale = 1.0 / max(ltc_extent(to_first), LTC_SMALLEST);
    outline.first_up = dot(surface.normal, to_first) > 0.0;
    outline.previous_up = outline.first_up;
    outline.previous = corner;
    outline.facing = 0.0;
    outline.diffuse = 0.0;
    outline.crossed = false;
    outline.sum = vec3<f32>(0.0);
    return outline;
}

/// Adds the next vertex, or the first one again to close the outline.
fn ltc_outline_add(outline: ptr<function, LtcOutline>, surface: LtcSurface, corner: vec3<f32>) {
    let origin = surface.position * LTC_HEADROOM;
    let first_far = (*outline).first * LTC_HEADROOM;
    let a_far = (*outline).previous * LTC_HEADROOM;
    let b_far = corner * LTC_HEADROOM;
    // Lengths in units of the distance to the first vertex, but below 1e8 of anything, so that squares of areas are finite.
    let extent = max(ltc_extent(a_far - origin), ltc_extent(b_far - origin));
    let scale = min((*outline).scale, 1e8 / max(extent, 1e-11));
    let reference = (first_far - origin) * scale;
    let a = (a_far - origin) * scale;
    let b = (b_far - origin) * scale;
    let a_offset = (a_far - first_far) * scale;
    let b_offset = (b_far - first_far) * scale;
    // The determinant of first vertex, a and b, by the shortest of the vectors that give it: next to a point far from the first
    // vertex the offsets from there differ by rounding alone.
    (*outline).facing += dot(cross(ltc_shorter(ltc_shorter(a_offset, b_offset), ltc_shorter(a, b)), (b_far - a_far) * scale), reference);
    (*outline).previous = corner;
    (*outline).reference = reference;
    if (ltc_use_cheap_horizon) {
        var edge: vec3<f32>;
        if (ltc_use_cheap_distance) {
            (*outline).start = ltc_fast_unit(a);
            (*outline).end = ltc_fast_unit(b);
            edge = ltc_fast_edge((*outline).start, (*outline).end);
        }
        if (!ltc_use_cheap_distance) {
            (*outline).start = a;
            (*outline).end = b;
            (*outline).start_offset = a_offset;
            (*outline).end_offset = b_offset;
            (*outline).normal = ltc_edge_normal(a, b, b_offset - a_offset);
            edge = ltc_edge_from(reference, a, a_offset, b, b_offset, (*outline).normal);
        }
        (*outline).sum -= edge;
        (*outline).diffuse -= dot(surface.normal, edge);
        return;
    }

    // Heights of a distant light from that of the first vertex and the rise from there.
    let height = dot(surface.normal, reference);
    let near = !ltc_use_cheap_distance & (max(dot(a_offset, a_offset), dot(b_offset, b_offset)) < 0.0625 * dot(reference, reference));
    let a_height = select(dot(surface.normal, a), height + dot(surface.normal, a_offset), near);
    let b_height = select(dot(surface.normal, b), height + dot(surface.normal, b_offset), near);
    // A vertex on the horizon counts as above for both of its edges or for neither, whatever rounding says at each of them:
    // otherwise the horizon would not close the outline.
    let a_up = (*outline).previous_up;
    (*outline).returns = all(corner == (*outline).first);
    let b_up = select(b_height > 0.0, (*outline).first_up, (*outline).returns);
    (*outline).previous_up = b_up;
    (*outline).starts_up = a_up;
    (*outline).ends_up = b_up;
    (*outline).closes = false;
    if (!(a_up | b_up)) {
        return;
    }
    var start = a;
    var start_offset = a_offset;
    var end = b;
    var end_offset = b_offset;
    if (!(a_up & b_up)) {
        let above = select(b, a, a_up);
        let below = select(a, b, a_up);
        let above_offset = select(b_offset, a_offset, a_up);
        let below_offset = select(a_offset, b_offset, a_up);
        let high = max(select(b_height, a_height, a_up), 0.0);
        let low = min(select(a_height, b_height, a_up), 0.0);
        let t = high / max(high - low, LTC_TINY);
        let between = above + (below - above) * t;
        // Its height is zero, not the rounding of its ends: close to the surface point a lobe's horizon would go by that.
        let crossing = between - surface.normal * dot(surface.normal, between);
        let crossing_offset = above_offset + (below_offset - above_offset) * t;
        if ((*outline).crossed) {
            let base = (*outline).crossing;
            let base_offset = (*outline).crossing_offset;
            let horizon_start = select(base, crossing, a_up);
            let horizon_end = select(crossing, base, a_up);
            let horizon_start_offset = select(base_offset, crossing_offset, a_up);
            let horizon_end_offset = select(crossing_offset, base_offset, a_up);
            let product = ltc_edge_normal(horizon_start, horizon_end, horizon_end_offset - horizon_start_offset);
            // An edge on the horizon has the surface's normal, whatever rounding says of its own.
            let normal = surface.normal * dot(surface.normal, product);
            (*outline).closes = true;
            (*outline).horizon_start = horizon_start;
            (*outline).horizon_end = horizon_end;
            (*outline).horizon_start_offset = horizon_start_offset;
            (*outline).horizon_end_offset = horizon_end_offset;
            (*outline).horizon_normal = normal;
            (*outline).diffuse -= dot(surface.normal, ltc_edge_from(reference, horizon_start, horizon_start_offset, horizon_end, horizon_end_offset, normal));
        } else {
            (*outline).crossed = true;
            (*outline).crossing = crossing;
            (*outline).crossing_offset = crossing_offset;
        }
        start = select(crossing, a, a_up);
        start_offset = select(crossing_offset, a_offset, a_up);
        end = select(b, crossing, a_up);
        end_offset = select(b_offset, crossing_offset, a_up);
    }
    let normal = ltc_edge_normal(start, end, end_offset - start_offset);
    (*outline).start = start;
    (*outline).end = end;
    (*outline).start_offset = start_offset;
    (*outline).end_offset = end_offset;
    (*outline).normal = normal;
    (*outline).diffuse -= dot(surface.normal, ltc_edge_from(reference, start, start_offset, end, end_offset, normal));
}

/// Starts a lobe's part of an outline.
fn ltc_outline_lobe_begin() -> LtcOutlineLobe {
    var sum: LtcOutlineLobe;
    sum.crossed = false;
    sum.begun = false;
    sum.sum = vec3<f32>(0.0);
    sum.share = 1.0;
    return sum;
}

/// Adds what ltc_outline_add has last added to `outline` to a lobe.
fn ltc_outline_lobe_add(sum: ptr<function, LtcOutlineLobe>, outline: LtcOutline, lobe: LtcLobe) {
    if (ltc_use_cheap_horizon) {
        (*sum).share = lobe.share;
    }
    if (ltc_use_cheap_horizon & ltc_use_cheap_distance) {
        (*sum).sum -= ltc_fast_edge(ltc_fast_unit(ltc_transform(lobe, outline.start)), ltc_fast_unit(ltc_transform(lobe, outline.end)));
        return;
    }
    if (!ltc_use_cheap_horizon & !(outline.starts_up | outline.ends_up)) {
        return;
    }
    let reference = ltc_transform(lobe, outline.reference);
    if (ltc_use_cheap_horizon) {
        (*sum).sum -= ltc_edge_from(reference, ltc_transform(lobe, outline.start), ltc_transform(lobe, outline.start_offset),
            ltc_transform(lobe, outline.end), ltc_transform(lobe, outline.end_offset), ltc_transform_normal(lobe, outline.normal));
        return;
    }
    let start = ltc_transform(lobe, outline.start);
    let end = ltc_transform(lobe, outline.end);
    // As for the surface's horizon: a point that edges share counts as above for all of them or for none, whatever rounding says
    // at each.
    let start_up = select(start.z > 0.0, (*sum).previous_up, (*sum).begun & outline.starts_up);
    if (!(*sum).begun) {
        (*sum).begun = true;
        (*sum).first_up = start_up;
    }
    let end_up = select(end.z > 0.0, (*sum).first_up, outline.returns & outline.ends_up);
    (*sum).previous_up = end_up;
    if (outline.starts_up != outline.ends_up) {
        let crossing_up = select(start_up, end_up, outline.starts_up);
        if (outline.closes) {
            let horizon_start_up = select((*sum).crossing_up, crossing_up, outline.starts_up);
            let horizon_end_up = select(crossing_up, (*sum).crossing_up, outline.starts_up);
            ltc_outline_lobe_edge(sum, reference, ltc_transform(lobe, outline.horizon_start), ltc_transform(lobe, outline.horizon_start_offset), horizon_start_up,
                ltc_transform(lobe, outline.horizon_end), ltc_transform(lobe, outline.horizon_end_offset), horizon_end_up, ltc_transform_normal(lobe, outline.horizon_normal), true);
        } else {
            (*sum).crossing_up = crossing_up;
        }
    }
    ltc_outline_lobe_edge(sum, reference, start, ltc_transform(lobe, outline.start_offset), start_up,
        end, ltc_transform(lobe, outline.end_offset), end_up, ltc_transform_normal(lobe, outline.normal), false);
}

/// Adds one edge that lies above the surface or on its horizon, in the lobe's space, and what of it counts as above the lobe's
/// horizon; `exact` as for ltc_crossing.
fn ltc_outline_lobe_edge(sum: ptr<function, LtcOutlineLobe>, reference: vec3<f32>, a: vec3<f32>, a_offset: vec3<f32>, a_up: bool,
    b: vec3<f32>, b_offset: vec3<f32>, b_up: bool, normal: vec3<f32>, exact: bool) {
    if (!(a_up | b_up)) {
        return;
    }
    var start = a;
    var start_offset = a_offset;
    var end = b;
    var end_offset = b_offset;
    if (!(a_up & b_up)) {
        let above = select(b, a, a_up);
        let below = select(a, b, a_up);
        let above_offset = select(b_offset, a_offset, a_up);
        let below_offset = select(a_offset, b_offset, a_up);
        let high = max(above.z, 0.0);
        let t = high / max(high - min(below.z, 0.0), LTC_TINY);
        let crossing = ltc_crossing(above, below, select(-normal, normal, a_up), exact);
        // The offsets of a distant light hold more digits than its points. Elsewhere a crossing may be a direction only, and
        // its offset has to be that of the point that stands for it.
        let distant = max(dot(above_offset, above_offset), dot(below_offset, below_offset)) < 0.0625 * dot(reference, reference);
        let crossing_offset = select(crossing - reference, above_offset + (below_offset - above_offset) * t, distant);
        if ((*sum).crossed) {
            let base = (*sum).crossing;
            let base_offset = (*sum).crossing_offset;
            let horizon_start = select(base, crossing, a_up);
            let horizon_end = select(crossing, base, a_up);
            (*sum).sum -= ltc_edge_from(reference, horizon_start, select(base_offset, crossing_offset, a_up), horizon_end,
                select(crossing_offset, base_offset, a_up), ltc_edge_normal(horizon_start, horizon_end, horizon_end - horizon_start));
        } else {
            (*sum).crossed = true;
            (*sum).crossing = crossing;
            (*sum).crossing_offset = crossing_offset;
        }
        start = select(crossing, a, a_up);
        start_offset = select(crossing_offset, a_offset, a_up);
        end = select(b, crossing, a_up);
        end_offset = select(b_offset, crossing_offset, a_up);
    }
    (*sum).sum -= ltc_edge_from(reference, start, start_offset, end, end_offset, normal);
}

/// The form factor of a closed outline, 0 to 1. Its error is that of ltc_quad, and grows with the root of the number
/// of vertices.
fn ltc_outline_diffuse(outline: LtcOutline, two_sided: bool) -> f32 {
    if (ltc_use_cheap_horizon) {
        let scale = ltc_outline_scale(outline, two_sided);
        return ltc_round_above(outline.sum * scale, outline.diffuse * scale);
    }
    return ltc_received(outline.diffuse * LTC_OVER_TWO_PI, outline.facing < 0.0, two_sided);
}

/// The vector form factor of a closed outline in a lobe's space, cut at both horizons, towards the light.
fn ltc_outline_lobe(outline: LtcOutline, sum: LtcOutlineLobe, two_sided: bool) -> vec3<f32> {
    if (ltc_use_cheap_horizon) {
        let toward = sum.sum * ltc_outline_scale(outline, two_sided);
        return vec3<f32>(toward.xy, ltc_round_above(toward, toward.z)) * sum.share;
    }
    return ltc_received_vector(sum.sum * LTC_OVER_TWO_PI, outline.facing < 0.0, two_sided);
}

/// Starts what a sum of lobes knows of an outline.
fn ltc_outline_lobes_begin() -> LtcOutlineLobes {
    var sums: LtcOutlineLobes;
    sums.first = ltc_outline_lobe_begin();
    sums.second = ltc_outline_lobe_begin();
    sums.third = ltc_outline_lobe_begin();
    return sums;
}

/// Adds the outline's last edge to the lobes of a sum.
fn ltc_outline_lobes_add(sums: ptr<function, LtcOutlineLobes>, surface: LtcSurface, outline: LtcOutline, lobes: LtcLobes) {
    var sum = (*sums).first;
    if (!ltc_use_second_lobe) {
        ltc_outline_lobe_add(&sum, outline, lobes.first);
        (*sums).first = sum;
    }
    if (ltc_use_second_lobe) {
        var lobe = lobes.first;
        var shape = lobes.second;
        var index = 1;
        loop {
            ltc_outline_lobe_add(&sum, outline, lobe);
            if (index <= 1) {
                (*sums).first = sum;
                sum = (*sums).second;
            } else if (index <= 2) {
                (*sums).second = sum;
                if (ltc_use_third_lobe) {
                    sum = (*sums).third;
                }
            } else {
                (*sums).third = sum;
            }
            if (index >= lobes.count) {
                break;
            }
            lobe = ltc_shape_lobe(surface, shape);
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
            index += 1;
        }
    }
}

/// The parts (specular, fresnel) that a sum of lobes reflects of a closed outline of unit radiance.
fn ltc_outline_specular(surface: LtcSurface, outline: LtcOutline, sums: LtcOutlineLobes, lobes: LtcLobes, two_sided: bool) -> vec2<f32> {
    var value = ltc_lobes_part(surface, lobes.first, ltc_outline_lobe(outline, sums.first, two_sided));
    if (ltc_use_second_lobe & (lobes.count > 1)) {
        value += ltc_lobes_part(surface, ltc_shape_lobe(surface, lobes.second), ltc_outline_lobe(outline, sums.second, two_sided));
    }
    if (ltc_use_third_lobe & (lobes.count > 2)) {
        value += ltc_lobes_part(surface, ltc_shape_lobe(surface, lobes.third), ltc_outline_lobe(outline, sums.third, two_sided));
    }
    return value;
}

/// Starts a polygon at its first vertex.
fn ltc_polygon_begin(surface: LtcSurface, corner: vec3<f32>) -> LtcPolygon {
    var polygon: LtcPolygon;
    polygon.outline = ltc_outline_begin(surface, corner);
    polygon.sums = ltc_outline_lobes_begin();
    return polygon;
}

/// Adds the next vertex.
fn ltc_polygon_add(polygon: ptr<function, LtcPolygon>, surface: LtcSurface, lobes: LtcLobes, corner: vec3<f32>) {
    var outline = (*polygon).outline;
    var sums = (*polygon).sums;
    ltc_outline_add(&outline, surface, corner);
    if (ltc_use_ggx) {
        ltc_outline_lobes_add(&sums, surface, outline, lobes);
    }
    (*polygon).outline = outline;
    (*polygon).sums = sums;
}

/// The value (diffuse, specular, fresnel) of the polygon whose vertices have all been added.
fn ltc_polygon_end(polygon: ptr<function, LtcPolygon>, surface: LtcSurface, lobes: LtcLobes, two_sided: bool) -> vec3<f32> {
    let first = (*polygon).outline.first;
    ltc_polygon_add(polygon, surface, lobes, first);
    let form_factor = ltc_outline_diffuse((*polygon).outline, two_sided);
    var specular = vec2<f32>(0.0);
    if (ltc_use_ggx) {
        specular = ltc_outline_specular(surface, (*polygon).outline, (*polygon).sums, lobes, two_sided);
    }
    return vec3<f32>(form_factor, specular);
}

/// ltc_edge_about for points and their offsets from `origin`. A point far from `origin` may as well be
/// given by its direction.
fn ltc_edge_from(origin: vec3<f32>, a: vec3<f32>, a_offset: vec3<f32>, b: vec3<f32>, b_offset: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    let reference = origin * inverseSqrt(max(dot(origin, origin), LTC_TINY));
    let a_unit = a * inverseSqrt(max(dot(a, a), LTC_TINY));
    let b_unit = b * inverseSqrt(max(dot(b, b), LTC_TINY));
    let a_away = ltc_offset(origin, reference, a, a_offset);
    let b_away = ltc_offset(origin, reference, b, b_offset);
    return ltc_edge_about(reference, a_unit, a_away, b_unit, b_away, normal);
}

// ---------------------------------------------------------------------------------------------
// Tubes
//
//     let tube = ltc_tube_begin(surface, start, end, radius, caps);
//     let form_factor = ltc_tube_diffuse(surface, tube);
//     let toward = ltc_tube_lobe(tube, lobe);      // for each lobe
//
// A thin tube is seen as a line whose width in angle falls with the cosine to its closest point. The
// integral of directions along it is closed (Heitz and Hill 2017, "Linear-Light Shading with Linearly
// Transformed Cosines"). Three things make it exact but for the square of radius over distance: the sine
// of half the width in place of its angle, which makes a tube without ends exact; ends at the distance at
// which their rims are seen on average; and in the lobe's space, where a tube may be wide, the two planes
// of its outline in place of a width.
// ---------------------------------------------------------------------------------------------

/// A tube as all lobes share it: relative to the surface point, scaled, and cut at the surface's horizon.
struct LtcTube {
    /// One end of what is left of the axis, moved to where the rim is seen.
    start: vec3<f32>,
    /// Length of what is left.
    remaining_length: f32,
    /// Its other end.
    end: vec3<f32>,
    /// Distance of the moved axis.
    axis_distance: f32,
    /// Direction from `start` to `end`; zero for a tube of no length.
    axis: vec3<f32>,
    /// Sine of half the angle under which the tube's width is seen, 0 to 1.
    sine: f32,
    /// Normal of the plane through axis and surface point; shorter than 1 where the point is inside the tube.
    across: vec3<f32>,
    /// Share of the width that is above the surface's horizon; 0 if all of the axis is below.
    share: f32,
    /// Towards the cap at the start, as long as the sine of half the angle under which it is seen.
    start_cap: vec3<f32>,
    /// Share of that cap that is seen, 0 to 1.
    start_weight: f32,
    /// Towards the cap at the end.
    end_cap: vec3<f32>,
    /// Share of that cap that is seen.
    end_weight: f32,
}

/// Square root of a number that is not negative; 0 below 1e-30.
fn ltc_root(x: f32) -> f32 {
    return x * inverseSqrt(max(x, 1e-30));
}

/// Share of what reaches from `height` - `rise` to `height` + `rise` that is above 0.
fn ltc_tube_share(height: f32, rise: f32) -> f32 {
    return saturate(0.5 + 0.5 * height / max(max(rise, abs(height)), LTC_TINY));
}

/// The vector form factor of a line of constant width from `a` to `b`, over the sine of half the angle under
/// which that width is seen at its `foot`, the direction of its closest point, at the given distance.
///
/// With t the angle from the foot, w(t) the direction there and s = sin of half the width, it is
/// s / pi times the integral of 2 cos t w(t). Between two ends that is the sum of their directions, each
/// times the cosine of the other and the sine of the angle between them, and of the foot times that angle
/// less its sine times its cosine: no difference of large terms, so a distant line keeps its digits, and
/// one on the horizon too. A `foot` shorter than 1 is that of an axis nearer than `distance`.
fn ltc_tube_line(a: vec3<f32>, b: vec3<f32>, foot: vec3<f32>, distance_to_line: f32, length_of_line: f32) -> vec3<f32> {
    let hidden = max(1.0 - dot(foot, foot), 0.0);
    let inside = hidden * distance_to_line * distance_to_line;
    let a_inverse = inverseSqrt(max(dot(a, a) + inside, LTC_TINY));
    let b_inverse = inverseSqrt(max(dot(b, b) + inside, LTC_TINY));
    let a_unit = a * a_inverse;
    let b_unit = b * b_inverse;
    let a_cosine = min(distance_to_line * a_inverse, 1.0);
    let b_cosine = min(distance_to_line * b_inverse, 1.0);
    // As if no farther than its ends, whichever is named first: a line that the horizon has moved may be nearer than that.
    let ends_sine = length_of_line * min(a_inverse * b_cosine, b_inverse * a_cosine);
    let chord = b_unit - a_unit;
    let change = b_cosine - a_cosine;
    let ends_k = 0.5 * (dot(chord, chord) + hidden * change * change);
    // Sine and cosine come from different quantities. Where a part of the width is cut off, or the surface point
    // is inside, these disagree; they must not at the right angle, where one form takes over from the other.
    let ends_cosine = 1.0 - ends_k;
    let agreed = inverseSqrt(max(ends_sine * ends_sine + ends_cosine * ends_cosine, LTC_TINY));
    let sine = ends_sine * agreed;
    let k = ends_k + (1.0 - ends_cosine * agreed - ends_k) * min(ends_k, 1.0);
    let excess = ltc_angle_excess(min(k, max(2.0 - k, 0.0)));
    // The angle between the ends less the product of its sine and cosine.
    let bulge = select(sine * (excess + k), LTC_PI - sine * (2.0 + excess - min(k, 2.0)), k > 1.0);
    return ((a_unit * b_cosine + b_unit * a_cosine) * sine + foot * bulge) * (2.0 * LTC_OVER_TWO_PI);
}

/// Towards a cap around `center`, the end of a tube in the direction `outward`, as long as the sine of half
/// the angle under which it is seen; in w the share of it that is seen. `inverse_distance` is 1 over the distance,
/// `reach` the radius or the tube's length if that is less, and `turned` tells how far the tube's end is turned
/// towards the surface point, from -1 to 1.
fn ltc_tube_cap_begin(surface: LtcSurface, center: vec3<f32>, inverse_distance: f32, outward: vec3<f32>, radius: f32, reach: f32, turned: f32) -> vec4<f32> {
    let toward = center * inverse_distance;
    // Half a disk has its centre of area at 4 / (3 pi) of the radius; less counts where two halves become a sphere.
    let aside = outward - toward * dot(toward, outward);
    let middle = center + aside * (0.424413182 * reach * (1.0 - turned));
    // Of a cap on the horizon the middle of what is above counts.
    let seen = ltc_tube_share(dot(surface.normal, middle), radius);
    let lifted = ltc_direction(middle + surface.normal * (radius * (1.0 - seen)));
    return vec4<f32>(lifted * min(radius * inverse_distance, 1.0), (0.5 + 0.5 * turned) * seen);
}

/// The tube of the given `radius` around the line from `start` to `end`, which emits outwards from its lateral
/// surface; with `caps` its ends are rounded by hemispheres that emit too, else they are open and it is
/// dark inside.
///
/// The axis is cut at the surface's horizon. Where the tube lies along the horizon, part of its width is
/// below: then what is left counts, with the middle that it has. A surface point inside the tube counts
/// as one at the radius's distance from the axis, in the direction in which the axis is, so that light stays continuous.
fn ltc_tube_begin(surface: LtcSurface, start: vec3<f32>, end: vec3<f32>, radius: f32, caps: bool) -> LtcTube {
    let origin = surface.position * LTC_HEADROOM;
    let a_full = start * LTC_HEADROOM - origin;
    let b_full = end * LTC_HEADROOM - origin;
    let radius_full = abs(radius) * LTC_HEADROOM;
    let scale = 1.0 / max(max(max(ltc_extent(a_full), ltc_extent(b_full)), radius_full), LTC_SMALLEST);
    // The difference of the ends themselves: that of the vectors to the surface has lost digits.
    let side = (end * LTC_HEADROOM - start * LTC_HEADROOM) * scale;
    let p_a = a_full * scale;
    let p_b = b_full * scale;
    let r = radius_full * scale;
    // A tube shorter than 1e-18 of its distance has none.
    let axis = side * inverseSqrt(max(dot(side, side), 1e-36));
    let full_length = dot(axis, side);
    let a_squared = dot(p_a, p_a);
    let b_squared = dot(p_b, p_b);
    let moment = cross(select(p_a, p_b, b_squared < a_squared), axis);
    let squared = max(dot(moment, moment), r * r);
    let inverse = inverseSqrt(max(squared, 1e-30));
    let is_inside = dot(moment, moment) < r * r;
    let sine = select(min(r * inverse, 1.0), 1.0, is_inside);
    let across = moment * inverse;

    // Rims are seen nearer than the axis, by pi / 4 of the radius on average; the outline of caps begins at it.
    let nearer = select(0.25 * LTC_PI * sine, 0.0, caps & ltc_use_caps);
    let moved = cross(axis, moment) * nearer;
    // Half the tube's extent in height, across its axis: that of its width as it is seen, or inside the tube of
    // its whole section.
    let upright = surface.normal - axis * dot(surface.normal, axis);
    let hidden = select(0.0, max(1.0 - dot(across, across), 0.0), is_inside);
    let slope = across * dot(surface.normal, across) + upright * hidden;
    // But for rounding the first is not less than the second.
    let extent = ltc_root(max(dot(surface.normal, slope), dot(slope, slope)));
    let rise = r * extent;
    let highest = max(dot(surface.normal, p_a - moved), dot(surface.normal, p_b - moved));
    let seen = ltc_tube_share(highest, rise);
    let lift = slope * ((1.0 - seen) * r / max(extent, 1e-15));
    let q_a = p_a - moved + lift;
    let q_b = p_b - moved + lift;
    let a_height = dot(surface.normal, q_a);
    let b_height = dot(surface.normal, q_b);
    let a_part = saturate(-a_height / max(b_height - a_height, LTC_TINY));
    let b_part = saturate(-b_height / max(a_height - b_height, LTC_TINY));
    let left = q_b - q_a;
    var tube: LtcTube;
    tube.start = q_a + left * a_part;
    tube.remaining_length = full_length * max(1.0 - a_part - b_part, 0.0);
    tube.end = q_b - left * b_part;
    tube.axis_distance = squared * inverse * (1.0 - nearer);
    tube.axis = axis;
    tube.sine = sine;
    tube.across = across;
    tube.share = select(0.0, seen, max(a_height, b_height) > 0.0);
    tube.start_cap = vec3<f32>(0.0);
    tube.start_weight = 0.0;
    tube.end_cap = vec3<f32>(0.0);
    tube.end_weight = 0.0;
    if (ltc_use_caps & caps) {
        // The outline of a capsule has half a disk at each end, but more of the nearer one and less of the other:
        // its straight parts meet the two disks where both have the same tangent.
        let a_inverse = inverseSqrt(max(max(a_squared, r * r), LTC_TUBE_TINY));
        let b_inverse = inverseSqrt(max(max(b_squared, r * r), LTC_TUBE_TINY));
        let farther = max(b_squared, r * r) * b_inverse - max(a_squared, r * r) * a_inverse;
        let turned = sine * clamp(farther / max(full_length, LTC_TINY), -1.0, 1.0);
        let reach = min(r, full_length);
        let start_cap = ltc_tube_cap_begin(surface, p_a, a_inverse, -axis, r, reach, turned);
        let end_cap = ltc_tube_cap_begin(surface, p_b, b_inverse, axis, r, reach, -turned);
        tube.start_cap = start_cap.xyz;
        tube.start_weight = start_cap.w;
        tube.end_cap = end_cap.xyz;
        tube.end_weight = end_cap.w;
        // Seen along its axis a capsule shows one cap, and its side lies behind it.
        tube.share *= max(1.0 - turned * turned, 0.0);
    }
    return tube;
}

/// The form factor of a tube, 0 to 1. Its mean error against the integral over the solid angle is 0.09 times
/// the square of radius over distance of the value, with caps 0.3 times.
fn ltc_tube_diffuse(surface: LtcSurface, tube: LtcTube) -> f32 {
    let foot = cross(tube.axis, tube.across);
    let sum = ltc_tube_line(tube.start, tube.end, foot, tube.axis_distance, tube.remaining_length);
    var value = max(dot(surface.normal, sum), 0.0) * tube.sine * tube.share;
    if (ltc_use_caps) {
        value += tube.start_weight * max(dot(surface.normal, tube.start_cap), 0.0) * ltc_root(dot(tube.start_cap, tube.start_cap));
        value += tube.end_weight * max(dot(surface.normal, tube.end_cap), 0.0) * ltc_root(dot(tube.end_cap, tube.end_cap));
    }
    return saturate(value);
}

/// The vector form factor of a tube's cap in the lobe's space: that of a small disk at its middle.
fn ltc_tube_cap(lobe: LtcLobe, cap: vec3<f32>, weight: f32) -> vec3<f32> {
    let toward = ltc_transform(lobe, cap);
    let squared = dot(cap, cap);
    let inverse = inverseSqrt(max(dot(toward, toward), LTC_TINY));
    // Bounded step by step, so that no two of the inverse roots meet in one product.
    let narrowed = min(ltc_root(squared) * inverse, 1e9);
    // The solid angle over pi that the disk has there if it is small; it grows to no more than a half-space.
    let area = min(max(dot(ltc_transform_normal(lobe, cap), toward), 0.0) * narrowed * narrowed * narrowed, 1e30);
    let covered = min(area / max(1.0 - squared + area, LTC_TINY), 1.0);
    return toward * select(0.0, weight * covered * inverse, toward.z > 0.0);
}

/// The vector form factor of a tube in the lobe's space, of its part above both horizons; z is not negative.
///
/// There a tube has another width, and need be neither thin nor seen square. The two planes of its outline give
/// its width as the chord between their directions across the axis. The line is moved to where the middle
/// between these directions meets the tube's section.
///
/// Mean error of the coverage against the lobe's integral over the solid angle, for a radius of 0.02 and
/// 0.08 of the distance: 0.006 and 0.09 % at roughness 0.4 to 1, 0.03 and 0.2 % at 0.15 to 0.4; with caps 0.02 and
/// 0.2 %, 0.04 and 0.5 %. A cap is one point: a lobe narrower than a cap misses it or sees it whole, 5 % at 0.05
/// to 0.15 and a radius of 0.02.
fn ltc_tube_lobe(tube: LtcTube, lobe: LtcLobe) -> vec3<f32> {
    let axis = ltc_transform(lobe, tube.axis);
    let volume = max(dot(ltc_transform_normal(lobe, tube.axis), axis), 0.0);
    let stretch_squared = dot(axis, axis);
    let stretch_inverse = inverseSqrt(max(stretch_squared, LTC_TUBE_TINY));
    let stretch = stretch_squared * stretch_inverse;
    let across = ltc_transform_normal(lobe, tube.across);
    // Exactly 0 outside the tube: a sharp lobe would magnify its rounding.
    let hidden = select(0.0, max(1.0 - dot(tube.across, tube.across), 0.0), tube.sine >= 1.0);
    let squared = dot(across, across) + hidden * volume * stretch;
    let inverse = inverseSqrt(max(squared, LTC_TUBE_TINY));
    let normal = across * inverse;
    let toward = cross(axis, across) * (inverse * stretch_inverse);

    // Both outlines across the axis, as (depth, width) over the tube's distance: (right_depth, width) and
    // (left_depth, -width).
    let sine = tube.sine * tube.share;
    let side = ltc_transform(lobe, tube.across) * sine;
    let full_depth = squared * inverse * stretch_inverse;
    let depth = full_depth * ltc_root(max(1.0 - sine * sine, 0.0));
    let width = sine * volume * inverse;
    let slope = dot(toward, side);
    let left_depth = depth - slope;
    let right_depth = depth + slope;
    let left_squared = left_depth * left_depth + width * width;
    let right_squared = right_depth * right_depth + width * width;
    let left_inverse = inverseSqrt(max(left_squared, LTC_TUBE_TINY));
    let right_inverse = inverseSqrt(max(right_squared, LTC_TUBE_TINY));
    let left_cosine = left_depth * left_inverse;
    let right_cosine = right_depth * right_inverse;
    // The chord between their directions. For a narrow tube the difference of the cosines has no digits.
    let cosines = left_cosine + right_cosine;
    let narrow = width * left_inverse * right_inverse;
    let chord_depth = select(right_cosine - left_cosine, 4.0 * depth * slope * narrow * narrow / max(cosines, 1.0), cosines > 1.0);
    let chord_width = width * (left_inverse + right_inverse);
    let chord_squared = chord_depth * chord_depth + chord_width * chord_width;
    let chord_inverse = inverseSqrt(max(chord_squared, 1e-30));
    let foot_depth = chord_width * chord_inverse;
    let foot_width = -chord_depth * chord_inverse;
    let foot = toward * foot_depth + normal * foot_width;
    let lengths = left_squared * left_inverse + right_squared * right_inverse;
    let shift = -4.0 * full_depth * slope / max(lengths * lengths, 1e-16);
    let line_distance = tube.axis_distance * max(foot_depth * (full_depth + slope * shift) + foot_width * width * shift, 0.0);

    let moved = side * (tube.axis_distance * shift);
    let a = ltc_transform(lobe, tube.start) + moved;
    let b = ltc_transform(lobe, tube.end) + moved;
    let a_part = saturate(-a.z / max(b.z - a.z, LTC_TINY));
    let b_part = saturate(-b.z / max(a.z - b.z, LTC_TINY));
    let left = b - a;
    let line_length = tube.remaining_length * stretch * max(1.0 - a_part - b_part, 0.0);
    let sum = ltc_tube_line(a + left * a_part, b - left * b_part, foot, line_distance, line_length);
    var value = sum * select(0.0, 0.5 * chord_squared * chord_inverse, max(a.z, b.z) > 0.0);
    if (ltc_use_caps & (tube.start_weight + tube.end_weight > 0.0)) {
        value += ltc_tube_cap(lobe, tube.start_cap, tube.start_weight) + ltc_tube_cap(lobe, tube.end_cap, tube.end_weight);
        // Caps of a thick tube overlap it; there is no more than the hemisphere.
        value *= min(inverseSqrt(max(dot(value, value), LTC_TINY)), 1.0);
    }
    return vec3<f32>(value.xy, max(value.z, 0.0));
}

/// The parts (specular, fresnel) that a sum of lobes reflects of a tube of unit radiance.
fn ltc_tube_specular(surface: LtcSurface, tube: LtcTube, lobes: LtcLobes) -> vec2<f32> {
    var value = vec2<f32>(0.0);
    if (!ltc_use_second_lobe) {
        value = ltc_lobes_part(surface, lobes.first, ltc_tube_lobe(tube, lobes.first));
    }
    if (ltc_use_second_lobe) {
        var lobe = lobes.first;
        var shape = lobes.second;
        var index = 1;
        loop {
            value += ltc_lobes_part(surface, lobe, ltc_tube_lobe(tube, lobe));
            if (index >= lobes.count) {
                break;
            }
            lobe = ltc_shape_lobe(surface, shape);
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
            index += 1;
        }
    }
    return value;
}

/// The value (diffuse, specular, fresnel) of a tube light of the given `radius` around the line from `start` to
/// `end`, at best an eighth of the distance or less; with `caps` its ends are rounded. See ltc_tube_begin.
///
/// Error of the form factor against exact arithmetic: at most 4e-7 and 1e-7 times the ratio of the farther end's
/// distance to that of the axis, in units of the angles under which the tube's width and length are seen,
/// each counted as no more than 1: so much do the coordinates' own digits leave open. For a lobe's coverage see
/// ltc_tube_lobe.
fn ltc_tube(surface: LtcSurface, lobes: LtcLobes, start: vec3<f32>, end: vec3<f32>, radius: f32, caps: bool) -> vec3<f32> {
    let tube = ltc_tube_begin(surface, start, end, radius, caps);
    var specular = vec2<f32>(0.0);
    if (ltc_use_ggx) {
        specular = ltc_tube_specular(surface, tube, lobes);
    }
    return vec3<f32>(ltc_tube_diffuse(surface, tube), specular);
}

// ---------------------------------------------------------------------------------------------
// Textured rectangles
//
//     let place = ltc_rectangle_lookup(surface, lobe, a, b, d, toward, texels, false);
//     let colour = ltc_texture_fetch(picture, picture_sampler, place);
//
// The value of a textured light is that of the plain one times the colour which the lobe sees on average. That
// is the picture, blurred as much as the lobe is wide, at the place where its middle lies on the light (the
// idea of Heitz et al. 2016). Diffuse light and each lobe have a colour of their own; the parts specular and
// fresnel share one:
//     diffuse value * diffuse colour,  ltc_reflectance(value, ...) * specular colour
//
// PICTURES are linear and premultiplied by alpha; a texel emits its red, green and blue, alpha masks and comes along. The
// texture's mipmaps hold ever more blurred images, see softbox::texture and wgsl/prefilter.wgsl; ordinary
// mipmaps will do, at a loss. Filter linearly in all three directions and clamp to the edge.
//   a, b, c, d   counter-clockwise from the emitting side: the picture's lower left, lower right, upper
//                right and upper left corner; its first row of texels is the one at the top, between d
//                and c. It is seen the right way round from there, mirrored from the other side.
//   c            is b + d - a: the light is a rectangle or another parallelogram. On any other quad the
//                picture is laid out as if it were, and light from beyond its edges shows the edge.
//   toward       the vector form factor of the light, cut at the horizons, of any length.
//   texels       size of the picture in texels.
//   pair         true for two samples along the lobe's longer side on the light instead of one in the
//                middle: on images as varied as photographs, a quarter less error where reflections are
//                drawn out (roughness below 0.7), a tenth elsewhere.
//
// Neither place nor blur needs the picture, so pictures of one size can share them.
// ---------------------------------------------------------------------------------------------

/// Spread of directions around the mean one where no outline limits it, in units of their distance. This and the
/// following are the fit `softbox::fit::fit_lookup`.
const LTC_LOOKUP_SPREAD: f32 = 0.497;

/// The same for the blur.
const LTC_LOOKUP_BLUR: f32 = 0.97;

/// Share of the blur's variance that is missing for a direction on the horizon.
const LTC_LOOKUP_TILT: f32 = 0.555;

/// Share that is missing for a light seen edge-on.
const LTC_LOOKUP_EDGE_ON: f32 = 0.7;

/// How much further from the middle to look for each unit of variance: blurred images are drawn to it.
const LTC_LOOKUP_PUSH: f32 = 3.7;

/// The same for each unit of the variance's square, over that.
const LTC_LOOKUP_PUSH_MORE: f32 = 3.4;

/// Least share of the longer variance in that of each sample of a pair.
const LTC_LOOKUP_PAIR_SHARE: f32 = 0.133;

/// Distance of the two from their middle over what would restore the variance.
const LTC_LOOKUP_PAIR_REACH: f32 = 0.642;

/// Where to sample the picture of a light.
struct LtcLookup {
    /// Texture coordinates.
    place: vec2<f32>,
    /// What to add to them for one sample of a pair, and to subtract for the other; zero if there is but one.
    apart: vec2<f32>,
    /// Level among the mipmaps; from 0 to any number beyond the last one.
    level: f32,
}

/// The look-up for a lobe on the rectangle of the corners `a`, `b` and `d`; `toward` is the vector form factor
/// in the lobe's space. See above for the other parameters.
fn ltc_rectangle_lookup(surface: LtcSurface, lobe: LtcLobe, a: vec3<f32>, b: vec3<f32>, d: vec3<f32>, toward: vec3<f32>, texels: vec2<f32>, pair: bool) -> LtcLookup {
    let scale = ltc_rectangle_scale(surface, a, b, d);
    let corner = (d * LTC_HEADROOM - surface.position * LTC_HEADROOM) * scale;
    let edge_u = (b * LTC_HEADROOM - a * LTC_HEADROOM) * scale;
    let edge_v = (a * LTC_HEADROOM - d * LTC_HEADROOM) * scale;
    let direction = ltc_direction(toward);
    let rise = vec3<f32>(dot(lobe.axis_z, edge_u), dot(lobe.axis_z, edge_v), direction.z);
    let normal = ltc_transform_normal(lobe, cross(edge_u, edge_v));
    return ltc_lookup(direction, rise, ltc_transform_normal(lobe, cross(edge_v, corner)), ltc_transform_normal(lobe, cross(corner, edge_u)),
        normal, dot(ltc_transform(lobe, corner), normal), texels, pair);
}

/// The look-up for diffuse light; `toward` is the vector form factor in the caller's space.
fn ltc_rectangle_diffuse_lookup(surface: LtcSurface, a: vec3<f32>, b: vec3<f32>, d: vec3<f32>, toward: vec3<f32>, texels: vec2<f32>, pair: bool) -> LtcLookup {
    let scale = ltc_rectangle_scale(surface, a, b, d);
    let corner = (d * LTC_HEADROOM - surface.position * LTC_HEADROOM) * scale;
    let edge_u = (b * LTC_HEADROOM - a * LTC_HEADROOM) * scale;
    let edge_v = (a * LTC_HEADROOM - d * LTC_HEADROOM) * scale;
    let direction = ltc_direction(toward);
    let rise = vec3<f32>(dot(surface.normal, edge_u), dot(surface.normal, edge_v), dot(surface.normal, direction));
    let normal = cross(edge_u, edge_v);
    return ltc_lookup(direction, rise, cross(edge_v, corner), cross(corner, edge_u), normal, dot(corner, normal), texels, pair);
}

/// Factor that brings the furthest of three corners, scaled by LTC_HEADROOM, to a distance of about 1.
fn ltc_rectangle_scale(surface: LtcSurface, a: vec3<f32>, b: vec3<f32>, d: vec3<f32>) -> f32 {
    let origin = surface.position * LTC_HEADROOM;
    let extent = max(max(ltc_extent(a * LTC_HEADROOM - origin), ltc_extent(b * LTC_HEADROOM - origin)), ltc_extent(d * LTC_HEADROOM - origin));
    return 1.0 / max(extent, LTC_TINY);
}

/// The look-up from the unit vector `toward` the light; the heights (`rise`) of the sides u and v and of `toward`
/// over the cosine's horizon; the cross products v x corner, corner x u and u x v (`normal`); and the product
/// `offset` of the corner and the last one. Whatever these are, place is within 0 to 1, and all is finite.
///
/// The vector form factor points to the mean of the light's points p, of distance r, weighted by 1 / r^4; the
/// cosine weights them by p.z / r^4. The ratio of the weights is linear over the light, so the cosine's mean lies
/// off by the covariance of the first weights times the slope of p.z, exactly. That covariance is about that of
/// directions spread evenly around the mean one, as far as the light's outline leaves room for it.
///
/// The blur is that spread too; folded at the picture's edges, it has to grow with the logarithm of the spread
/// to shrink the picture's waves as the cosine does.
fn ltc_lookup(toward: vec3<f32>, rise: vec3<f32>, normal_u: vec3<f32>, normal_v: vec3<f32>, normal: vec3<f32>, offset: f32, texels: vec2<f32>, pair: bool) -> LtcLookup {
    // Where the mean direction meets the light: corner + u x + v y = toward times a length, by Cramer's rule.
    let facing = dot(toward, normal);
    let inverse_facing = select(1.0, -1.0, facing < 0.0) / max(abs(facing), 1e-30);
    let hit = clamp(vec2<f32>(dot(toward, normal_u), dot(toward, normal_v)) * inverse_facing, vec2<f32>(0.0), vec2<f32>(1.0));
    // How fast that point moves with the direction. A light so small that the bound matters shows its mean.
    let free_u = (normal_u - normal * hit.x) * inverse_facing;
    let free_v = (normal_v - normal * hit.y) * inverse_facing;
    let along_u = free_u * (1e4 / max(ltc_extent(free_u), 1e4));
    let along_v = free_v * (1e4 / max(ltc_extent(free_v), 1e4));
    let moment = vec3<f32>(dot(along_u, along_u), dot(along_u, along_v), dot(along_v, along_v));
    let product = cross(along_u, along_v);
    let area = dot(product, product);

    // From the mean of the directions to that of the cosine. `room` is the variance of an even light, less
    // towards its edges; the variances are those of spread and room in parallel, (S^-1 + R^-1)^-1.
    let spread = LTC_LOOKUP_SPREAD * LTC_LOOKUP_SPREAD;
    let within = hit * (1.0 - hit);
    let room = 1.3333334 * within * within + 1e-6;
    let spread_area = spread * spread * area;
    let cross_u = spread * moment.x * room.y;
    let cross_v = spread * moment.z * room.x;
    let share = 1.0 / (spread_area + cross_u + cross_v + room.x * room.y);
    let variance_u = room.x * ((spread_area + cross_u) * share);
    let variance_v = room.y * ((spread_area + cross_v) * share);
    let covariance = room.x * room.y * (spread * moment.y * share);
    let slope = rise.xy * (1.0 / max(offset * inverse_facing * rise.z, LTC_TINY));
    let shift = vec2<f32>(variance_u * slope.x + covariance * slope.y, covariance * slope.x + variance_v * slope.y);
    let middle = clamp(hit + shift, vec2<f32>(0.0), vec2<f32>(1.0));

    // The blur's ellipse, in units of the geometric mean of the picture's sides: squares of its half-axes.
    let cosine = abs(facing) * inverseSqrt(max(dot(normal, normal), LTC_TINY));
    let lean = LTC_LOOKUP_TILT * (1.0 - rise.z) + LTC_LOOKUP_EDGE_ON * (1.0 - cosine);
    let blur = LTC_LOOKUP_BLUR * LTC_LOOKUP_BLUR * max(1.0 - lean, 0.05);
    let aspect = max(texels.x, 1.0) / max(texels.y, 1.0);
    let x = blur * moment.x * aspect;
    let y = blur * moment.y;
    let z = blur * moment.z / aspect;
    let difference = 0.5 * (x - z);
    let square = difference * difference + y * y;
    let turn = square * inverseSqrt(max(square, LTC_TINY));
    let longer = 0.5 * (x + z) + turn;
    let sides = vec2<f32>(ltc_outlined(longer), ltc_outlined(blur * blur * area / max(longer, LTC_TINY)));
    let sides_product = sides.x * sides.y;
    let single = sides_product * inverseSqrt(max(sides_product, LTC_TINY));
    let variance = select(single, max(sides.y, LTC_LOOKUP_PAIR_SHARE * sides.x), pair);

    // Level L has the variance 4/9 (4^L - 1), and 1/6 4^L from the filter between its texels.
    let level = 0.5 * log2(max((variance * texels.x * texels.y + 0.44444445) * 1.6363636, 1.0));
    let axis = select(vec2<f32>(turn + difference, y), vec2<f32>(y, turn - difference), difference < 0.0);
    let rest = max(select(0.0, sides.x - variance, pair), 0.0);
    let reach = LTC_LOOKUP_PAIR_REACH * (rest * inverseSqrt(max(rest, LTC_TINY))) * inverseSqrt(max(dot(axis, axis), LTC_TINY));
    let stretch = aspect * inverseSqrt(max(aspect, LTC_TINY));
    let push = 1.0 + (LTC_LOOKUP_PUSH + LTC_LOOKUP_PUSH * LTC_LOOKUP_PUSH_MORE * variance) * variance;
    var lookup: LtcLookup;
    lookup.place = clamp(0.5 + (middle - 0.5) * push, vec2<f32>(0.0), vec2<f32>(1.0));
    lookup.apart = reach * vec2<f32>(axis.x / stretch, axis.y * stretch);
    lookup.level = level;
    return lookup;
}

/// Variance of the blur that leaves of the second wave across a picture what a spread of the given variance leaves
/// of it: exp(-2 pi^2 blur) = 1 / (1 + 2 pi^2 spread). The same for small ones.
fn ltc_outlined(spread: f32) -> f32 {
    let x = 19.739209 * spread;
    // The logarithm of a number near 1 has lost the digits of x.
    return select(log2(1.0 + x) * 0.6931472, x - 0.5 * x * x, x < 1e-3) * 0.05066059;
}

/// The picture's colour at a look-up with one sample.
fn ltc_texture_fetch(picture: texture_2d<f32>, picture_sampler: sampler, lookup: LtcLookup) -> vec4<f32> {
    return textureSampleLevel(picture, picture_sampler, lookup.place, lookup.level);
}

/// The picture's colour at a look-up with a pair of samples.
fn ltc_texture_fetch_pair(picture: texture_2d<f32>, picture_sampler: sampler, lookup: LtcLookup) -> vec4<f32> {
    let first = textureSampleLevel(picture, picture_sampler, lookup.place + lookup.apart, lookup.level);
    let second = textureSampleLevel(picture, picture_sampler, lookup.place - lookup.apart, lookup.level);
    return 0.5 * (first + second);
}

/// What a sum of lobes sees of a rectangle that shows a picture.
struct LtcSeen {
    /// The colour that the lobes see on average, each by its share of the specular value.
    colour: vec3<f32>,
    /// The parts (specular, fresnel) for a white picture.
    value: vec2<f32>,
}

/// What one lobe sees of a rectangle that shows a picture; see ltc_rectangle_lookup.
fn ltc_lobe_picture(surface: LtcSurface, quad: LtcQuad, lobe: LtcLobe, a: vec3<f32>, b: vec3<f32>, d: vec3<f32>, picture: texture_2d<f32>, picture_sampler: sampler, texels: vec2<f32>) -> LtcSeen {
    let toward = ltc_quad_lobe(quad, lobe);
    let place = ltc_rectangle_lookup(surface, lobe, a, b, d, toward, texels, false);
    var seen: LtcSeen;
    seen.colour = ltc_texture_fetch(picture, picture_sampler, place).xyz;
    seen.value = ltc_lobes_part(surface, lobe, toward);
    return seen;
}

/// What a sum of lobes sees of a rectangle that shows a picture; see ltc_rectangle_lookup.
fn ltc_quad_picture(surface: LtcSurface, quad: LtcQuad, lobes: LtcLobes, a: vec3<f32>, b: vec3<f32>, d: vec3<f32>, picture: texture_2d<f32>, picture_sampler: sampler, texels: vec2<f32>) -> LtcSeen {
    var seen: LtcSeen;
    if (!ltc_use_second_lobe) {
        seen = ltc_lobe_picture(surface, quad, lobes.first, a, b, d, picture, picture_sampler, texels);
    }
    if (ltc_use_second_lobe) {
        var lobe = lobes.first;
        var shape = lobes.second;
        var index = 1;
        loop {
            let part = ltc_lobe_picture(surface, quad, lobe, a, b, d, picture, picture_sampler, texels);
            seen.value += part.value;
            seen.colour += (part.colour - seen.colour) * (part.value.x / max(seen.value.x, LTC_TINY));
            if (index >= lobes.count) {
                break;
            }
            lobe = ltc_shape_lobe(surface, shape);
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
            index += 1;
        }
    }
    return seen;
}

// ---------------------------------------------------------------------------------------------
// Sheen, rough diffuse surfaces, clear coat and rough metals
//
// Sheen and rough diffuse surfaces are lobes of their own, each in one further layer of the table's
// texture array: one texel holds three numbers of shape, and the albedo. Their axes, size and sampler
// are those of the specular lobe, their roughness is their own. A light's value for such a lobe is
// (diffuse, lobe, -): the third number is Schlick's part, which these lobes do not have.
//
//     let cloth = ltc_surface_with_roughness(surface, sheen_roughness);
//     let sheen = ltc_sheen_lobe_from_table(cloth, table, table_sampler, table_size, sheen_layer);
//     let value = ltc_quad(cloth, sheen, a, b, c, d, two_sided);
//     radiance = ltc_sheen_over(radiance, sheen, value, sheen_colour);
//
// What lies below a layer gets what that layer does not reflect for this view. That keeps the energy:
// in light of the same radiance from everywhere nothing becomes brighter than that. It is not
// reciprocal: the loss depends on the view alone, where light is lost on its way in, too.
// ---------------------------------------------------------------------------------------------

/// Sheen roughness below which the sheen no longer changes.
const LTC_SHEEN_ROUGHNESS_FLOOR: f32 = 0.1;

/// Albedo to which a lobe's own is raised where energy compensation divides by it. No entry of the
/// table for GGX is as small.
const LTC_ALBEDO_FLOOR: f32 = 0.125;

/// The same surface point and frame with another roughness, which is clamped as in ltc_surface: that of
/// a sheen, a coat or a diffuse part.
fn ltc_surface_with_roughness(surface: LtcSurface, roughness: f32) -> LtcSurface {
    var other = surface;
    other.roughness = clamp(roughness, LTC_ROUGHNESS_FLOOR, 1.0);
    other.alpha = other.roughness * other.roughness;
    return other;
}

/// The lobe of a sheen of colour 1 from its texel (X, Z, W, albedo), with t the angle between normal
/// and view and r the surface's roughness, which is the sheen's:
///     x = X      z = sin t Z / r
///     y = 0      w = W / r
/// The model is that of Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF", with Smith's
/// shadowing; the texels are the fit `softbox::fit::bake` with `softbox::fit::Settings::sheen`. Their albedo,
/// and with it the light of a whole room, is right to half precision where the roughness is 0.2 or more. One
/// lobe is a coarse likeness of light that comes back and light that goes on along the horizon: on random
/// quads the mean error is 9 per cent of the mean value, 6 to 14 by roughness and view.
fn ltc_sheen_lobe(surface: LtcSurface, texel: vec4<f32>) -> LtcLobe {
    let reach = 1.0 / max(surface.roughness, LTC_SHEEN_ROUGHNESS_FLOOR);
    return ltc_planar_lobe(surface, vec4<f32>(texel.x, 0.0, surface.sin_view * texel.y * reach, texel.z * reach), texel.w, 0.0);
}

/// ltc_sheen_lobe from the given layer of the table's texture array.
fn ltc_sheen_lobe_from_table(surface: LtcSurface, table: texture_2d_array<f32>, table_sampler: sampler, table_size: f32, layer: i32) -> LtcLobe {
    let at = ltc_table_coordinates(surface, table_size);
    return ltc_sheen_lobe(surface, textureSampleLevel(table, table_sampler, at, layer, 0.0));
}

/// Radiance of a surface under a sheen of `sheen_colour` (each channel 0 to 1): `base` is the radiance
/// without it, `value` the light's for the lobe `sheen`. Call it with the sum over all lights, or for
/// each of them. The base is dimmed alike in all channels, so that it keeps its hue.
fn ltc_sheen_over(base: vec3<f32>, sheen: LtcLobe, value: vec3<f32>, sheen_colour: vec3<f32>) -> vec3<f32> {
    let strongest = max(max(sheen_colour.x, sheen_colour.y), sheen_colour.z);
    return base * max(1.0 - strongest * sheen.albedo, 0.0) + sheen_colour * value.y;
}

/// The lobe of what a rough diffuse surface of colour 1 reflects at the first bounce, from its texel
/// (Y, Z, W, albedo), with t the angle between normal and view:
///     x = 1            z = sin t Z
///     y = sin t Y      w = W
/// The surface's roughness is the diffuse one as the model takes it, not squared. The model is that of
/// Portsmouth, Kutz and Hill 2025, "EON: A practical energy-preserving rough diffuse BRDF"; the texels are
/// the fit `softbox::fit::bake` with `softbox::fit::Settings::diffuse`. On random quads the mean error is
/// 1.4 per cent of the mean value, up to 5 at grazing views.
fn ltc_diffuse_lobe(surface: LtcSurface, texel: vec4<f32>) -> LtcLobe {
    let s = surface.sin_view;
    return ltc_planar_lobe(surface, vec4<f32>(1.0, s * texel.x, s * texel.y, texel.z), texel.w, 0.0);
}

/// ltc_diffuse_lobe from the given layer of the table's texture array.
fn ltc_diffuse_lobe_from_table(surface: LtcSurface, table: texture_2d_array<f32>, table_sampler: sampler, table_size: f32, layer: i32) -> LtcLobe {
    let at = ltc_table_coordinates(surface, table_size);
    return ltc_diffuse_lobe(surface, textureSampleLevel(table, table_sampler, at, layer, 0.0));
}

/// Reflected radiance of a rough diffuse surface of the given colour (each channel 0 to 1), from the
/// value (diffuse, lobe, -) of a light of unit radiance for ltc_diffuse_lobe's lobe. It takes the place
/// of colour times diffuse.
///
/// What leaves at a later bounce has lost its direction: it is Lambert's form factor, with the albedo
/// that the first bounce leaves over, so a white surface reflects all light. Its colour is the sum of the
/// bounces, m the mean albedo of the first one:
///     colour^2 m / (1 - colour (1 - m))
/// The model lets later bounces leave less at grazing angles; their mean in place of that keeps the energy
/// for each view, and the mean error for a white surface is 2.1 per cent in place of 1.4.
fn ltc_rough_diffuse(surface: LtcSurface, lobe: LtcLobe, value: vec3<f32>, colour: vec3<f32>) -> vec3<f32> {
    // 1/2 - 2/(3 pi) and 2/3 - 28/(15 pi): the model's scale, and the mean of its closed-form albedo.
    let mean_albedo = (1.0 + 0.07248821 * surface.roughness) / (1.0 + 0.28779341 * surface.roughness);
    // At least the mean albedo, which is above 0.8, for every colour in its domain.
    let series = max(vec3<f32>(1.0) - colour * (1.0 - mean_albedo), vec3<f32>(0.5));
    let later = colour * colour * mean_albedo / series;
    return colour * value.y + later * ((1.0 - lobe.albedo) * value.x);
}

/// Share of the light that reaches the base below a clear coat: 1 - weight * (directional albedo of the
/// coat for this view). `coat` is the coat's lobe from ltc_lobe, `reflectance` its F0 (0.04 for the usual
/// index of 1.5), its F90 is 1; `weight` is the share of the surface that it covers, 0 to 1.
fn ltc_coat_transmission(coat: LtcLobe, reflectance: f32, weight: f32) -> f32 {
    return clamp(1.0 - weight * (reflectance * (coat.albedo - coat.fresnel) + coat.fresnel), 0.0, 1.0);
}

/// Radiance of a surface under a clear coat: `base` is the radiance without it, `value` the light's for
/// the lobe `coat`. In light of the same radiance from everywhere a base that reflects all of it does so
/// under its coat, too, whatever that one's weight and roughness.
fn ltc_coat_over(base: vec3<f32>, coat: LtcLobe, value: vec3<f32>, reflectance: f32, weight: f32) -> vec3<f32> {
    let gloss = weight * (reflectance * (value.y - value.z) + value.z);
    return base * ltc_coat_transmission(coat, reflectance, weight) + vec3<f32>(gloss);
}

/// Factor on the reflected radiance of a rough metal that makes up for the light which a single bounce
/// between its facets loses: 1 + F0 (1 / albedo - 1) (Turquin 2019, "Practical multiple scattering
/// compensation for microfacet models", after Kulla and Conty 2017). A white metal, F0 = 1, then
/// reflects all light; for a dielectric the factor is close to 1.
fn ltc_energy_compensation(lobe: LtcLobe, normal_reflectance: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(1.0) + normal_reflectance * (1.0 / max(lobe.albedo, LTC_ALBEDO_FLOOR) - 1.0);
}

// ---------------------------------------------------------------------------------------------
// Cones over ellipses
//
// Seen from the surface point a disk fills an elliptical cone, in the caller's space and in every lobe's
// (Heitz and Hill 2017, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines"). Its rim
// is r(t) = c + x cos t + y sin t, and everything about the cone is in the symmetric matrix
//     D = x x^T + y y^T - c c^T,
// whose one negative eigenvalue, -m, belongs to the cone's axis. With the ellipse's semi-axes a and b and the
// coordinates (x, y, z) of c along them and across, m is the largest root of
//     x^2 / (a^2 + m) + y^2 / (b^2 + m) + z^2 / m = 1:
// of the ellipsoids that have the ellipse as their focal conic, the one through the surface point has the
// square m of its least semi-axis, and its normal there is the axis. All terms are positive: digits are lost
// only where the rim itself passes the surface point closely, however large, small, near or oblique the disk is.
//
// The whole cone's vector form factor points along the axis; its length is the product of the sines of the
// cone's half-angles along the other two eigenvectors. Of a cone cut by planes the boundary consists of
// pieces of the planes, which are edges (see ltc_edges), and arcs. Along the arc between the directions u and
// v of two points of the rim, whose parameters differ by d,
//     integral of r x dr / r.r = E(k - h D) (u x v),   k = 1 - u.v,   h = (1 - cos d) / (|r_u| |r_v|),
// where E(1 - cos w) = w / sin w is applied to a matrix by its eigenvalues. Along the axis w is the angle
// swept around it, of the larger of the other eigenvectors it is imaginary: E = w / sinh w with cosh.
// ---------------------------------------------------------------------------------------------

/// The cone over an ellipse. Vectors "in the frame" have their components along the ellipse's axes; lengths
/// have a unit that makes them about 1.
struct LtcCone {
    /// First semi-axis.
    half_x: vec3<f32>,
    /// Minus the negative eigenvalue.
    depth: f32,
    /// Second semi-axis, conjugate to the first.
    half_y: vec3<f32>,
    /// Length of the vector form factor of the whole cone.
    whole: f32,
    /// The ellipse's centre.
    centre: vec3<f32>,
    /// Factor on lengths that leads to the unit.
    scale: f32,
    /// First axis of the frame, along the ellipse's longer axis.
    first: vec3<f32>,
    /// Square of half the longer axis.
    first_square: f32,
    /// Second axis of the frame, along the shorter axis.
    second: vec3<f32>,
    /// Square of half the shorter axis.
    second_square: f32,
    /// Third axis of the frame, away from the surface point.
    third: vec3<f32>,
    /// Reciprocal of the distance at which the cone's axis meets the ellipse's plane.
    nearness: f32,
    /// The ellipse's centre in the frame.
    place: vec3<f32>,
    /// Where the cone's axis meets the ellipse's plane, in units of the semi-axes given: the first one's.
    pierced_x: f32,
    /// The cone's axis in the frame, a unit vector.
    axis: vec3<f32>,
    /// The same, the second one's.
    pierced_y: f32,
}

/// The other two eigenvectors of a cone, in the frame, unit vectors.
struct LtcAcross {
    /// That across the wider side.
    first: vec3<f32>,
    /// Its eigenvalue.
    first_value: f32,
    /// That across the narrower side.
    second: vec3<f32>,
    /// Its eigenvalue.
    second_value: f32,
}

/// A plane through the surface point, as it cuts an ellipse. In units of the semi-axes given the ellipse is the
/// unit circle, and the plane cuts it along a chord.
struct LtcCut {
    /// Normal of the plane, a unit vector towards the side that counts.
    normal: vec3<f32>,
    /// Height of the circle's centre over the plane.
    height: f32,
    /// Direction of rise in the circle's plane.
    toward: vec2<f32>,
    /// Rise by one radius.
    steepness: f32,
    /// Distance of the chord from the centre along `toward`: at least 1 where nothing counts, at most -1 where
    /// everything does.
    offset: f32,
    /// Half the length of the chord.
    reach: f32,
    /// Length of the cross product of the chord's middle and a radius along the chord.
    moment: f32,
}

/// 1 - E for an imaginary angle: 1 - w / sinh w from k = cosh w - 1, not negative. The error is below 2e-7.
/// The coefficients are the minimax fit `softbox::fit::fit_hyperbolic_excess` of degree 5; the logarithm's
/// argument is at least 3.7, where WGSL guarantees it to 3 ULP.
fn ltc_hyperbolic_deficit(k: f32) -> f32 {
    if (k < 1.0) {
        let high = (0.001350465 * k - 0.0076216036) * k + 0.023172159;
        return -((((high * k - 0.05646018) * k + 0.13323359) * k - 0.33332837) * k);
    }
    let bounded = min(k, 1e18);
    let square = bounded * (bounded + 2.0);
    let inverse_sine = inverseSqrt(square);
    return 1.0 - log(bounded + 1.0 + square * inverse_sine) * inverse_sine;
}

/// Cosine and sine of the angle by which to turn the first of two conjugate semi-axes to the longer axis of their
/// ellipse: half the angle of the vector (`difference`, `product`) of half the difference of their squares and
/// their scalar product.
fn ltc_half_turn(difference: f32, product: f32) -> vec2<f32> {
    let square = difference * difference + product * product;
    let inverse_length = inverseSqrt(max(square, 1e-30));
    // A circle has no longer axis.
    let circular = square < 1e-30;
    let cosine = select(abs(difference) * inverse_length, 1.0, circular);
    let sine = select(product * inverse_length, 0.0, circular);
    let large_square = 0.5 + 0.5 * cosine;
    let inverse_large = inverseSqrt(large_square);
    let large = large_square * inverse_large;
    let small = 0.5 * sine * inverse_large;
    return select(vec2<f32>(small, large), vec2<f32>(large, small), difference >= 0.0);
}

/// The plane with the unit vector `normal` as it cuts the ellipse with the semi-axes `half_x` and `half_y` times
/// `size` around `centre`.
fn ltc_cut(normal: vec3<f32>, half_x: vec3<f32>, half_y: vec3<f32>, size: f32, centre: vec3<f32>) -> LtcCut {
    let slope = vec2<f32>(dot(normal, half_x), dot(normal, half_y));
    let square = dot(slope, slope);
    let inverse_slope = inverseSqrt(max(square, LTC_TINY));
    var cut: LtcCut;
    cut.normal = normal;
    cut.height = dot(normal, centre);
    cut.toward = slope * inverse_slope;
    cut.steepness = size * square * inverse_slope;
    // Beyond 1 the plane misses the rim; how far beyond does not matter, but squares of it shall be finite.
    cut.offset = clamp(-cut.height / max(cut.steepness, LTC_TINY), -1e9, 1e9);
    let bounded = clamp(cut.offset, -1.0, 1.0);
    let reach_square = (1.0 - bounded) * (1.0 + bounded);
    cut.reach = reach_square * inverseSqrt(max(reach_square, LTC_TINY));
    let middle = centre + (half_x * cut.toward.x + half_y * cut.toward.y) * (size * bounded);
    let along = (half_x * cut.toward.y - half_y * cut.toward.x) * size;
    cut.moment = max(dot(normal, cross(middle, along)), 0.0);
    return cut;
}

/// One step of Laguerre's iteration towards the largest root of x^3 + `quadratic` x^2 + `linear` x + `absolute`, all
/// of whose roots are real.
fn ltc_cone_step(x: f32, quadratic: f32, linear: f32, absolute: f32) -> f32 {
    let value = ((x + quadratic) * x + linear) * x + absolute;
    let slope = (3.0 * x + 2.0 * quadratic) * x + linear;
    let bend = 6.0 * x + 2.0 * quadratic;
    let under = max(4.0 * slope * slope - 6.0 * value * bend, 0.0);
    let root = under * inverseSqrt(max(under, LTC_TINY));
    return x - 3.0 * value / max(slope + root, LTC_TINY);
}

/// The cone over the ellipse with the semi-axes `half_x` and `half_y` times `size` around `centre`. `normal` is the
/// cross product of the two, `volume` its scalar product with the centre, which must not be negative.
fn ltc_cone(half_x: vec3<f32>, half_y: vec3<f32>, size: f32, centre: vec3<f32>, normal: vec3<f32>, volume: f32) -> LtcCone {
    // The ellipse's axes. Its width comes from the normal: the difference of conjugate semi-axes has lost the
    // digits of a slender one's.
    let turn = ltc_half_turn(0.5 * (dot(half_x, half_x) - dot(half_y, half_y)), dot(half_x, half_y));
    let longest = half_x * turn.x + half_y * turn.y;
    let long_square = dot(longest, longest);
    let long_inverse = inverseSqrt(max(long_square, LTC_TINY));
    let normal_square = dot(normal, normal);
    let normal_inverse = inverseSqrt(max(normal_square, 1e-30));
    let aspect = min(normal_square * normal_inverse * long_inverse * long_inverse, 1.0);
    let long_half = size * long_square * long_inverse;
    var cone: LtcCone;
    cone.scale = inverseSqrt(max(dot(centre, centre) + long_half * long_half, LTC_TINY));
    cone.first = longest * long_inverse;
    cone.third = normal * normal_inverse;
    cone.second = cross(cone.third, cone.first);
    cone.half_x = half_x * (size * cone.scale);
    cone.half_y = half_y * (size * cone.scale);
    cone.centre = centre * cone.scale;
    cone.place = vec3<f32>(dot(cone.centre, cone.first), dot(cone.centre, cone.second), volume * normal_inverse * cone.scale);
    let a = min(long_half * cone.scale, 1.0);
    let b = a * aspect;
    let p = cone.place * cone.place;
    let s = vec2<f32>(a * a, b * b);
    cone.first_square = s.x;
    cone.second_square = s.y;

    // The least possible depth: with both poles of the ellipse's plane drawn together into one that has the same
    // value and slope at 0, which is exact for a circle.
    let aspect_square = aspect * aspect;
    let joint = p.x * aspect_square + p.y;
    let ratio = joint / max(p.x * aspect_square * aspect_square + p.y, LTC_TINY);
    let pole = min(s.y * ratio, s.x);
    let weight = min(joint * ratio, p.x + p.y);
    let middle = 0.5 * (weight + p.z - pole);
    let under = middle * middle + p.z * pole;
    let root = under * inverseSqrt(max(under, LTC_TINY));
    let lowest = select(p.z * min(pole / max(root - middle, LTC_TINY), 1e19), middle + root, middle > 0.0);
    let highest = p.x + p.y + p.z;
    let quadratic = s.x + s.y - highest;
    let linear = s.y * (s.x - p.x - p.z) - s.x * (p.y + p.z);
    let absolute = -p.z * s.x * s.y;
    var depth = lowest;
    if (aspect < 0.9999) {
        // From there up, three steps reach the root to rounding unless the ellipse is more slender than 1 : 10000.
        depth = min(max(ltc_cone_step(depth, quadratic, linear, absolute), lowest), highest);
        depth = min(max(ltc_cone_step(depth, quadratic, linear, absolute), lowest), highest);
        depth = min(max(ltc_cone_step(depth, quadratic, linear, absolute), lowest), highest);
    }
    cone.depth = max(depth, LTC_SHALLOWEST);

    let inverse_x = 1.0 / (s.x + cone.depth);
    let inverse_y = 1.0 / (s.y + cone.depth);
    // Bounded, so that a product with the reciprocal of their length is finite in any order.
    let toward = vec3<f32>(cone.place.x * min(cone.depth * inverse_x, 1.0), cone.place.y * min(cone.depth * inverse_y, 1.0), cone.place.z);
    cone.nearness = inverseSqrt(max(dot(toward, toward), 1e-30));
    cone.axis = toward * cone.nearness;
    let spread = inverseSqrt((s.x + cone.depth) * (s.y + cone.depth));
    cone.whole = min(cone.place.z * cone.nearness * (a * b * spread), 1.0);
    let pierced = vec2<f32>(-a * cone.place.x * inverse_x, -b * cone.place.y * inverse_y);
    cone.pierced_x = pierced.x * turn.x - pierced.y * turn.y;
    cone.pierced_y = pierced.x * turn.y + pierced.y * turn.x;
    return cone;
}

/// `v` in the cone's frame.
fn ltc_cone_inward(cone: LtcCone, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(cone.first, v), dot(cone.second, v), dot(cone.third, v));
}

/// `v`, given in the cone's frame, in the space that the cone is in.
fn ltc_cone_outward(cone: LtcCone, v: vec3<f32>) -> vec3<f32> {
    return cone.first * v.x + cone.second * v.y + cone.third * v.z;
}

/// The point of the ellipse's plane at `p`, in units of the semi-axes given.
fn ltc_cone_point(cone: LtcCone, p: vec2<f32>) -> vec3<f32> {
    return cone.centre + cone.half_x * p.x + cone.half_y * p.y;
}

/// A cut's moment in a cone's units, where it is at most 1 but for rounding.
fn ltc_cone_moment(cone: LtcCone, cut: LtcCut) -> f32 {
    return min(cut.moment * (cone.scale * cone.scale), 2.0);
}

/// Cosine between the cone's axis and a plane's normal.
fn ltc_cone_tilt(cone: LtcCone, cut: LtcCut) -> f32 {
    // A distant light's from the heights over the plane, which keep their digits on the horizon.
    let rise = (cone.pierced_x * cut.toward.x + cone.pierced_y * cut.toward.y) * cut.steepness;
    let distant = (cut.height + rise) * cone.scale * cone.nearness;
    return select(dot(cone.axis, ltc_cone_inward(cone, cut.normal)), distant, cone.first_square < 0.06);
}

/// The axes across a cone. With W = diag(a^2 + m, b^2 + m, m), D + m = W^1/2 (1 - g g^T) W^1/2 for the unit vector
/// g = W^-1/2 c, so the remaining eigenvalues are those of diag(a^2, b^2, 0) restricted to the plane across g: a
/// matrix of two by two whose entries are sums of positive terms.
fn ltc_cone_across(cone: LtcCone) -> LtcAcross {
    let a_square = cone.first_square;
    let b_square = cone.second_square;
    let w = vec3<f32>(a_square + cone.depth, b_square + cone.depth, cone.depth);
    let inverse_root = inverseSqrt(w);
    let weighted = cone.place * inverse_root;
    let g = weighted * inverseSqrt(max(dot(weighted, weighted), 1e-6));
    let q = -1.0 / (1.0 + g.z);
    let u = vec3<f32>(1.0 + g.x * g.x * q, g.x * g.y * q, -g.x);
    let v = vec3<f32>(g.x * g.y * q, 1.0 + g.y * g.y * q, -g.y);
    let u_square = a_square * u.x * u.x + b_square * u.y * u.y;
    let v_square = a_square * v.x * v.x + b_square * v.y * v.y;
    let product = a_square * u.x * v.x + b_square * u.y * v.y;
    let scale = 1.0 / max(u_square + v_square, LTC_TINY);
    let turn = ltc_half_turn(0.5 * scale * (u_square - v_square), clamp(scale * product, -1.0, 1.0));
    let wide = u * turn.x + v * turn.y;
    let first = wide * w * inverse_root;
    var across: LtcAcross;
    across.first = first * inverseSqrt(max(dot(first, first), LTC_TINY));
    across.first_value = a_square * wide.x * wide.x + b_square * wide.y * wide.y;
    across.second = cross(cone.axis, across.first);
    across.second_value = min(a_square * min(b_square / max(across.first_value, LTC_TINY), 1.0) * (g.z * g.z), across.first_value);
    return across;
}

/// The integral along an arc, less a vector along `normal` whose length is the sine below and of which `rest` gives
/// back a part; components along the axes across the cone and its own. The arc's chord spans the plane with the unit
/// vector `normal` (components along the same axes), `sine` is the sine of the angle between its ends, `k` that
/// angle's 1 - cosine, `ratio` the h of the formula above; `large` tells an arc of more than half the cone.
fn ltc_cone_sweep(cone: LtcCone, across: LtcAcross, normal: vec3<f32>, sine: f32, k: f32, ratio: f32, large: bool, rest: f32) -> vec3<f32> {
    let first = rest + sine * ltc_hyperbolic_deficit(max(ratio * across.first_value - k, 0.0));

    let second_k = clamp(k - ratio * across.second_value, 0.0, 2.0);
    let second_excess = ltc_angle_excess(min(second_k, 2.0 - second_k));
    var second = (rest - sine * second_excess) * normal.y;
    if (second_k > 1.0) {
        // Beyond a right angle from the supplement, whose sine is `factor` times the component.
        let factor_square = (across.first_value - across.second_value) * (cone.depth + across.second_value)
            / max(cone.depth * across.first_value, LTC_TINY);
        let lesser = sine * abs(normal.y);
        let angle = max(LTC_PI * inverseSqrt(max(factor_square, LTC_TINY)) - lesser * (1.0 + second_excess), 0.0);
        second = (rest + sine) * normal.y - select(angle, -angle, normal.y < 0.0);
    }

    let axis_k = min(k + ratio * cone.depth, 2.0);
    let lesser = min(sine * abs(normal.z), cone.whole);
    let acute = lesser + lesser * ltc_angle_excess(min(axis_k, 2.0 - axis_k));
    let part = select(acute, LTC_PI * cone.whole - acute, axis_k > 1.0);
    return vec3<f32>(first * normal.x, second, select(part, 2.0 * LTC_PI * cone.whole - part, large));
}

/// Vector form factor, times 2 pi, of the part of a cone on the side of a plane that counts; in w its component along
/// the plane's normal, which has more digits for a distant light.
fn ltc_cone_part(cone: LtcCone, across: LtcAcross, cut: LtcCut) -> vec4<f32> {
    let middle = ltc_cone_point(cone, cut.toward * cut.offset);
    let along = (cone.half_x * cut.toward.y - cone.half_y * cut.toward.x) * cut.reach;
    let start_point = middle + along;
    let end_point = middle - along;
    let start_inverse = inverseSqrt(max(dot(start_point, start_point), LTC_TINY));
    let end_inverse = inverseSqrt(max(dot(end_point, end_point), LTC_TINY));
    let both = min(start_inverse * end_inverse, LTC_NEAREST_PAIR);
    let start = start_point * start_inverse;
    let end = end_point * end_inverse;
    let sine = min(2.0 * cut.reach * ltc_cone_moment(cone, cut) * both, 1.0);
    let side = start - end;
    // The ends of a short chord differ by rounding alone; their cross product does not.
    let far_k = 0.5 * dot(side, side);
    let k = select(sine * sine / max(2.0 - far_k, 1.0), far_k, far_k > 1.0);
    // The chord's edge and the arc share the cross product of their ends, which is left out of both: of a distant
    // light it is all that they amount to but for a small part.
    let excess = sine * ltc_angle_excess(min(k, saturate(2.0 - k)));
    let rest = select(excess, LTC_PI - 2.0 * sine - excess, k > 1.0);
    let tilt = ltc_cone_tilt(cone, cut);
    let plane = ltc_cone_inward(cone, cut.normal);
    let normal = vec3<f32>(dot(plane, across.first), dot(plane, across.second), tilt);
    let swept = ltc_cone_sweep(cone, across, normal, sine, k, 2.0 * cut.reach * cut.reach * both, tilt >= 0.0, rest);
    let sum = vec3<f32>(swept.xy, swept.z + tilt * (rest + sine));
    let turned = across.first * sum.x + across.second * sum.y + cone.axis * sum.z;
    return vec4<f32>(ltc_cone_outward(cone, turned), dot(normal, sum));
}

/// The point of a plane's chord at `s` from its middle, in the circle's plane.
fn ltc_cut_point(cut: LtcCut, s: f32) -> vec2<f32> {
    return cut.toward * cut.offset + vec2<f32>(cut.toward.y, -cut.toward.x) * s;
}

/// The edge integral of the part of a plane's chord between two points of the circle's plane.
fn ltc_cone_chord(cone: LtcCone, cut: LtcCut, start: vec2<f32>, end: vec2<f32>) -> vec3<f32> {
    let a = ltc_cone_point(cone, start);
    let b = ltc_cone_point(cone, end);
    let a_inverse = inverseSqrt(max(dot(a, a), LTC_TINY));
    let b_inverse = inverseSqrt(max(dot(b, b), LTC_TINY));
    let along = end - start;
    let square = dot(along, along);
    let sine = square * inverseSqrt(max(square, LTC_TINY)) * ltc_cone_moment(cone, cut) * min(a_inverse * b_inverse, LTC_NEAREST_PAIR);
    return cut.normal * ltc_angle(a * a_inverse, b * b_inverse, sine);
}

/// The integral along the arc between two points of the circle, counter-clockwise. `nearly_full` tells an arc of all
/// but the whole circle from one of next to nothing.
fn ltc_cone_arc(cone: LtcCone, across: LtcAcross, start: vec2<f32>, end: vec2<f32>, nearly_full: bool) -> vec3<f32> {
    let a = ltc_cone_point(cone, start);
    let b = ltc_cone_point(cone, end);
    let a_inverse = inverseSqrt(max(dot(a, a), LTC_TINY));
    let b_inverse = inverseSqrt(max(dot(b, b), LTC_TINY));
    let both = min(a_inverse * b_inverse, LTC_NEAREST_PAIR);
    let back = start - end;
    let back_square = dot(back, back);
    let product = ltc_cone_inward(cone, ltc_edge_normal(b, a, cone.half_x * back.x + cone.half_y * back.y));
    let product_square = dot(product, product);
    let product_inverse = inverseSqrt(max(product_square, LTC_TINY));
    let normal = vec3<f32>(dot(product, across.first), dot(product, across.second), dot(product, cone.axis)) * product_inverse;
    let sine = min(product_square * product_inverse * both, 1.0);
    let side = a * a_inverse - b * b_inverse;
    let large = select(normal.z >= 0.0, nearly_full, back_square < 1e-9);
    let swept = ltc_cone_sweep(cone, across, normal, sine, 0.5 * dot(side, side), 0.5 * back_square * both, large, -sine);
    return ltc_cone_outward(cone, across.first * swept.x + across.second * swept.y + cone.axis * swept.z);
}

/// Vector form factor, times 2 pi, of the part of a cone on the sides of two planes that count, where the chords of
/// the two cross.
fn ltc_cone_between(cone: LtcCone, across: LtcAcross, a: LtcCut, b: LtcCut) -> vec3<f32> {
    // The sine between the directions of rise, and where the chord of `a` meets that of `b`, from the difference of
    // the two: the planes may all but coincide.
    let apart = b.toward - a.toward;
    let sine = a.toward.x * apart.y - a.toward.y * apart.x;
    let turned = sine > 0.0;
    let bounded = max(abs(sine), 1e-20);
    let rest = a.offset - b.offset - a.offset * (0.5 * dot(apart, apart));
    let meeting = ltc_cut_point(a, clamp(rest / select(-bounded, bounded, turned), -a.reach, a.reach));
    let a_end = ltc_cut_point(a, select(a.reach, -a.reach, turned));
    let b_end = ltc_cut_point(b, select(-b.reach, b.reach, turned));
    let a_chord = ltc_cone_chord(cone, a, select(meeting, a_end, turned), select(a_end, meeting, turned));
    let b_chord = ltc_cone_chord(cone, b, select(b_end, meeting, turned), select(meeting, b_end, turned));
    let arc = ltc_cone_arc(cone, across, select(a_end, b_end, turned), select(b_end, a_end, turned), a.offset + b.offset < -1.0);
    return a_chord + b_chord + arc;
}

// ---------------------------------------------------------------------------------------------
// Disks and spheres
// ---------------------------------------------------------------------------------------------

/// An elliptical disk over a surface: what all lobes share of the work on it.
struct LtcDisk {
    /// First semi-axis over `size`; the two run counter-clockwise about the direction away from the surface.
    half_x: vec3<f32>,
    /// Factor on the semi-axes.
    size: f32,
    /// Second semi-axis over `size`.
    half_y: vec3<f32>,
    /// Scalar product of `normal` and `centre`, not negative.
    volume: f32,
    /// The centre from the surface point, in units of the farthest coordinate.
    centre: vec3<f32>,
    /// Whether the light reaches the surface at all.
    reaches: bool,
    /// Cross product of the semi-axes over `size`.
    normal: vec3<f32>,
    /// Whether the horizon cuts the disk.
    clipped: bool,
    /// The surface's horizon.
    cut: LtcCut,
}

/// A sphere over a surface.
struct LtcSphere {
    /// A disk that hides the same directions.
    disk: LtcDisk,
    /// Whether the surface point is in the sphere.
    inside: bool,
}

/// Places an elliptical disk over a surface; see ltc_disk.
fn ltc_disk_begin(surface: LtcSurface, centre: vec3<f32>, half_x: vec3<f32>, half_y: vec3<f32>, two_sided: bool) -> LtcDisk {
    let away = centre * LTC_HEADROOM - surface.position * LTC_HEADROOM;
    let x_far = half_x * LTC_HEADROOM;
    let y_far = half_y * LTC_HEADROOM;
    let width = max(ltc_extent(x_far), ltc_extent(y_far));
    let scale = 1.0 / max(max(ltc_extent(away), width), LTC_TINY);
    let shrink = 1.0 / max(width, LTC_TINY);
    let x = x_far * shrink;
    let y = y_far * shrink;
    let normal = cross(x, y);
    var disk: LtcDisk;
    disk.centre = away * scale;
    // Of a disk that is nothing at the surface point `scale` is large, and must not meet other reciprocals in one product.
    disk.size = min(width * scale, 1.0);
    let volume = dot(normal, disk.centre);
    let front = volume < 0.0;
    disk.half_x = select(x, y, front);
    disk.half_y = select(y, x, front);
    disk.normal = select(normal, -normal, front);
    disk.volume = abs(volume);
    disk.cut = ltc_cut(surface.normal, disk.half_x, disk.half_y, disk.size, disk.centre);
    disk.clipped = disk.cut.offset > -1.0;
    // An ellipse more slender than 1e18 has no plane in single precision, and no area.
    let is_line = dot(normal, normal) <= LTC_TINY;
    disk.reaches = (front | (two_sided & ltc_use_two_sided & (volume > 0.0))) & (disk.cut.offset < 1.0) & !is_line;
    return disk;
}

/// The form factor of a disk, 0 to 1.
fn ltc_disk_diffuse(disk: LtcDisk) -> f32 {
    if (!disk.reaches) {
        return 0.0;
    }
    let cone = ltc_cone(disk.half_x, disk.half_y, disk.size, disk.centre, disk.normal, disk.volume);
    var value = cone.whole * ltc_cone_tilt(cone, disk.cut);
    if (disk.clipped) {
        value = ltc_cone_part(cone, ltc_cone_across(cone), disk.cut).w * LTC_OVER_TWO_PI;
    }
    return saturate(value);
}

/// The vector form factor of a disk in a lobe's space, cut at both horizons, towards the light.
fn ltc_disk_lobe(disk: LtcDisk, lobe: LtcLobe) -> vec3<f32> {
    if (!disk.reaches) {
        return vec3<f32>(0.0);
    }
    let half_x = ltc_transform(lobe, disk.half_x);
    let half_y = ltc_transform(lobe, disk.half_y);
    let centre = ltc_transform(lobe, disk.centre);
    let own = ltc_cut(vec3<f32>(0.0, 0.0, 1.0), half_x, half_y, disk.size, centre);
    if (own.offset >= 1.0) {
        return vec3<f32>(0.0);
    }
    // The determinant of the lobe's matrix.
    let volume = dot(lobe.axis_x, lobe.normal_x);
    let cone = ltc_cone(half_x, half_y, disk.size, centre, ltc_transform_normal(lobe, disk.normal), volume * disk.volume);
    let entire = ltc_cone_outward(cone, cone.axis) * cone.whole;
    let own_clips = own.offset > -1.0;
    if (!(disk.clipped | own_clips)) {
        return vec3<f32>(entire.xy, max(entire.z, 0.0));
    }
    // The surface's horizon in the lobe's space; heights over it scale as volumes over the normal.
    let horizon = ltc_transform_normal(lobe, disk.cut.normal);
    let horizon_square = dot(horizon, horizon);
    let horizon_inverse = inverseSqrt(max(horizon_square, LTC_TINY));
    var cut = disk.cut;
    cut.normal = horizon * horizon_inverse;
    cut.height = cut.height * (volume * horizon_inverse);
    cut.steepness = cut.steepness * (volume * horizon_inverse);
    cut.moment = cut.moment * (horizon_square * horizon_inverse);

    // Two horizons leave arcs of the rim around the directions of rise, of the half-angles f and g, whose cosines are
    // the offsets. With h between the directions, one arc lies in the other for |f - g| >= h, and they meet at
    // neither or both of their far ends for |f + g - pi| >= pi - h. In terms of chords, for the planes may all but
    // coincide.
    let twice = disk.clipped & own_clips;
    let apart = own.toward - cut.toward;
    let along = own.toward + cut.toward;
    let difference = own.offset - cut.offset;
    let total = own.offset + cut.offset;
    let reaches = (own.reach - cut.reach) * (own.reach - cut.reach);
    let nested = difference * difference + reaches >= dot(apart, apart);
    let opposite = (total * total + reaches >= dot(along, along)) & !nested;
    if (twice & opposite & (total >= 0.0)) {
        return vec3<f32>(0.0);
    }
    let across = ltc_cone_across(cone);
    var sum: vec3<f32>;
    if (twice & !(nested | opposite)) {
        sum = ltc_cone_between(cone, across, cut, own);
    } else {
        let own_counts = own_clips & (!disk.clipped | (nested & (difference >= 0.0)));
        if (own_counts) {
            cut = own;
        }
        sum = ltc_cone_part(cone, across, cut).xyz;
        if (twice & opposite) {
            // What neither cuts off is what each leaves, together, less the whole.
            sum += ltc_cone_part(cone, across, own).xyz - entire * (2.0 * LTC_PI);
        }
    }
    sum *= LTC_OVER_TWO_PI;
    return vec3<f32>(sum.xy, max(sum.z, 0.0));
}

/// The parts (specular, fresnel) that a sum of lobes reflects of a disk of unit radiance.
fn ltc_disk_specular(surface: LtcSurface, disk: LtcDisk, lobes: LtcLobes) -> vec2<f32> {
    var value = vec2<f32>(0.0);
    if (!ltc_use_second_lobe) {
        value = ltc_lobes_part(surface, lobes.first, ltc_disk_lobe(disk, lobes.first));
    }
    if (ltc_use_second_lobe) {
        var lobe = lobes.first;
        var shape = lobes.second;
        var index = 1;
        loop {
            value += ltc_lobes_part(surface, lobe, ltc_disk_lobe(disk, lobe));
            if (index >= lobes.count) {
                break;
            }
            lobe = ltc_shape_lobe(surface, shape);
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
            index += 1;
        }
    }
    return value;
}

/// The value (diffuse, specular, fresnel) of an elliptical disk light around `centre` with the semi-axes `half_x` and
/// `half_y`, any two conjugate half-diameters. It emits to the side of their cross product (to both with `two_sided`).
///
/// Error of the form factor against exact arithmetic: at most 1e-6, 2e-6 for a disk that all but touches the surface;
/// at most 1e-4 of its value for one whose size is 1e-5 to a tenth of its distance. Where the rim itself passes by
/// closely, 6e-7 times the ratio of the disk's size to that distance takes the place of 1e-6.
fn ltc_disk(surface: LtcSurface, lobes: LtcLobes, centre: vec3<f32>, half_x: vec3<f32>, half_y: vec3<f32>, two_sided: bool) -> vec3<f32> {
    let disk = ltc_disk_begin(surface, centre, half_x, half_y, two_sided);
    if (!disk.reaches) {
        return vec3<f32>(0.0);
    }
    var specular = vec2<f32>(0.0);
    if (ltc_use_ggx) {
        specular = ltc_disk_specular(surface, disk, lobes);
    }
    return vec3<f32>(ltc_disk_diffuse(disk), specular);
}

/// Places a sphere over a surface; see ltc_sphere.
fn ltc_sphere_begin(surface: LtcSurface, centre: vec3<f32>, radius: f32) -> LtcSphere {
    let away_far = centre * LTC_HEADROOM - surface.position * LTC_HEADROOM;
    let radius_far = abs(radius) * LTC_HEADROOM;
    let scale = 1.0 / max(max(ltc_extent(away_far), radius_far), LTC_SMALLEST);
    let away = away_far * scale;
    let ball = radius_far * scale;
    let square = dot(away, away);
    let inverse_distance = inverseSqrt(max(square, LTC_TINY));
    let distance = square * inverse_distance;
    let w = away * inverse_distance;
    let sine = min(ball * inverse_distance, 1.0);
    let cosine_square = max(distance - ball, 0.0) * (distance + ball);
    let cosine = cosine_square * inverseSqrt(max(cosine_square, LTC_TINY)) * inverse_distance;
    // A basis across the direction, as in ltc_surface.
    let side = select(-1.0, 1.0, w.z >= 0.0);
    let p = -1.0 / (side + w.z);
    let q = w.x * w.y * p;
    var sphere: LtcSphere;
    sphere.inside = ball >= distance;
    var disk: LtcDisk;
    disk.half_x = vec3<f32>(1.0 + side * w.x * w.x * p, side * q, -side * w.x);
    disk.half_y = vec3<f32>(q, side + w.y * w.y * p, -w.y);
    disk.size = sine;
    disk.centre = w * cosine;
    disk.normal = w;
    disk.volume = cosine;
    disk.cut = ltc_cut(surface.normal, disk.half_x, disk.half_y, sine, disk.centre);
    disk.clipped = disk.cut.offset > -1.0;
    // A sphere of no radius gives nothing, at its centre either.
    disk.reaches = (sphere.inside | ((disk.cut.offset < 1.0) & (cosine > 0.0))) & (ball > 0.0);
    sphere.inside = sphere.inside & disk.reaches;
    sphere.disk = disk;
    return sphere;
}

/// The form factor of a sphere, 0 to 1: ltc_cone_part for a circular cone, whose centre has the height `tilt` over the
/// horizon (the integral of Snyder 1996, "Area Light Sources for Real-Time Graphics", without its differences of
/// nearly equal angles).
fn ltc_sphere_diffuse(sphere: LtcSphere) -> f32 {
    let disk = sphere.disk;
    let tilt = dot(disk.cut.normal, disk.normal);
    var value = disk.size * disk.size * tilt;
    if (disk.clipped) {
        value = ltc_cap(disk.size, tilt, disk.cut.offset, disk.cut.reach);
    }
    return select(select(0.0, saturate(value), disk.reaches), 1.0, sphere.inside);
}

/// The vector form factor of a sphere in a lobe's space, cut at both horizons, towards the light. A sphere around
/// the surface point covers the whole lobe.
fn ltc_sphere_lobe(sphere: LtcSphere, lobe: LtcLobe) -> vec3<f32> {
    if (sphere.inside) {
        return vec3<f32>(ltc_all_around(lobe).xy, lobe.share);
    }
    return ltc_disk_lobe(sphere.disk, lobe);
}

/// The parts (specular, fresnel) that a sum of lobes reflects of a sphere of unit radiance.
fn ltc_sphere_specular(surface: LtcSurface, sphere: LtcSphere, lobes: LtcLobes) -> vec2<f32> {
    var value = vec2<f32>(0.0);
    if (!ltc_use_second_lobe) {
        value = ltc_lobes_part(surface, lobes.first, ltc_sphere_lobe(sphere, lobes.first));
    }
    if (ltc_use_second_lobe) {
        var lobe = lobes.first;
        var shape = lobes.second;
        var index = 1;
        loop {
            value += ltc_lobes_part(surface, lobe, ltc_sphere_lobe(sphere, lobe));
            if (index >= lobes.count) {
                break;
            }
            lobe = ltc_shape_lobe(surface, shape);
            if (ltc_use_third_lobe) {
                shape = lobes.third;
            }
            index += 1;
        }
    }
    return value;
}

/// The value (diffuse, specular, fresnel) of a sphere light, which emits outwards, and inwards to a surface point
/// that it contains.
///
/// Error of the form factor against exact arithmetic: at most 1e-6, and 1e-4 of its value for a sphere whose radius is
/// less than a twentieth of its distance. At the distance g, in radii, from the sphere 1e-7 / sqrt(g) takes the place
/// of 1e-6: so much does the rounding of that distance move the sphere's outline.
fn ltc_sphere(surface: LtcSurface, lobes: LtcLobes, centre: vec3<f32>, radius: f32) -> vec3<f32> {
    let sphere = ltc_sphere_begin(surface, centre, radius);
    if (!sphere.disk.reaches) {
        return vec3<f32>(0.0);
    }
    var specular = vec2<f32>(0.0);
    if (ltc_use_ggx) {
        specular = ltc_sphere_specular(surface, sphere, lobes);
    }
    return vec3<f32>(ltc_sphere_diffuse(sphere), specular);
}

// ---------------------------------------------------------------------------------------------
// Anisotropic surfaces
// ---------------------------------------------------------------------------------------------
//
// A lobe of anisotropic GGX is the lobe of an isotropic surface, stretched, and then corrected:
//   1. ltc_surface as ever, of any roughness; then ltc_anisotropy from a tangent and two values of alpha
//      (ltc_anisotropic_alpha makes them of a roughness and an anisotropy).
//   2. ltc_stretched_lobe_from_table takes 2 samples of the isotropic table and corrects nothing;
//      ltc_anisotropic_lobe_from_table takes 8 more from two further layers of it, 64 KiB.
//   3. The lobe goes where any other does: ltc_quad, the ltc_polygon functions.
//
// Mean |error| over mean value of light from random quads, roughness 0.1 to 1, cos view 0.05 to 1, in per cent, for
// F = 1 and for a dielectric (F0 = 0.04), by the ratio of the two alphas:
//                                     1 to 2       2 to 4       4 to 7      7 to 10
//   isotropic, geometric mean        7.1   9.5    21    23     26    30     45    47
//   stretched, 2 samples             3.7   5.8     7.5   8.0    8.3   8.8   14    13
//   corrected, 10 samples            2.7   5.1     3.8   6.1    5.0   6.2    7.0   8.6
// What is left is the limit of one lobe, whose highlight is straight where the BRDF's is bent: lobes fitted to each
// case alone are better by a twentieth.

/// Smallest alpha along any direction: the square of LTC_ROUGHNESS_FLOOR.
const LTC_ALPHA_FLOOR: f32 = 0.0004;

/// Texels along each of the anisotropic table's four axes.
const LTC_ANISOTROPIC_SIZE: f32 = 8.0;

/// Tangent of half the stretched view's angle around which the table's second axis bends.
const LTC_ANISOTROPIC_KNEE: f32 = 0.8;

/// The directions along which a surface is roughest and smoothest, turned so that the view has no negative
/// component along either: the BRDF is symmetric under these turns.
struct LtcAnisotropy {
    /// Direction of the larger alpha.
    major: vec3<f32>,
    /// The larger alpha.
    alpha_major: f32,
    /// Direction of the smaller alpha.
    minor: vec3<f32>,
    /// The smaller alpha.
    alpha_minor: f32,
    /// Component of the view along the major direction, 0 to 1.
    view_major: f32,
    /// Component of the view along the minor direction, 0 to 1.
    view_minor: f32,
    /// Alpha of the isotropic surface whose lobe is stretched.
    alpha_round: f32,
    /// 1 where major x minor is the normal, -1 where it is the opposite.
    handedness: f32,
}

/// The square root of `x`, 0 or more, without WGSL's sqrt(0), which has no accuracy guarantee.
fn ltc_anisotropic_root(x: f32) -> f32 {
    return x * inverseSqrt(max(x, LTC_TINY));
}

/// Alpha along the tangent and across it, from a perceptual `roughness` and an `anisotropy` of 0 to 1 (both are
/// clamped). The ratio of the two is 1 / (1 - 0.9 anisotropy), 1 to 10, and their geometric mean
/// roughness^2 (Burley 2012), except that neither exceeds 1.
fn ltc_anisotropic_alpha(roughness: f32, anisotropy: f32) -> vec2<f32> {
    let clamped = clamp(roughness, 0.0, 1.0);
    let ratio = 1.0 - 0.9 * clamp(anisotropy, 0.0, 1.0);
    let stretch = inverseSqrt(ratio);
    return vec2<f32>(min(clamped * clamped * stretch, 1.0), clamped * clamped * ratio * stretch);
}

/// The anisotropy of a surface point with `alpha_x` along `tangent` and `alpha_y` across it. Either may be the larger;
/// both are clamped to LTC_ALPHA_FLOOR and 1. The table holds ratios up to 10, beyond which the correction stays
/// that of 10. `tangent` need not be unit nor perpendicular to the normal; where it is zero or along the
/// normal, the view's azimuth takes its place. The roughness of `surface` has no effect.
fn ltc_anisotropy(surface: LtcSurface, tangent: vec3<f32>, alpha_x: f32, alpha_y: f32) -> LtcAnisotropy {
    let given = ltc_direction(tangent);
    let flat_part = given - surface.normal * dot(surface.normal, given);
    let fallback = surface.tangent;
    let along = ltc_direction(select(fallback, flat_part, dot(flat_part, flat_part) > 1e-8));
    let across = cross(surface.normal, along);
    let bounded_x = clamp(alpha_x, LTC_ALPHA_FLOOR, 1.0);
    let bounded_y = clamp(alpha_y, LTC_ALPHA_FLOOR, 1.0);
    let swapped = bounded_y > bounded_x;
    let major = select(along, across, swapped);
    let minor = select(across, along, swapped);
    let cos_major = dot(surface.tangent, major);
    let cos_minor = dot(surface.tangent, minor);
    let back_major = cos_major < 0.0;
    let back_minor = cos_minor < 0.0;
    var anisotropy: LtcAnisotropy;
    anisotropy.major = select(major, -major, back_major);
    anisotropy.alpha_major = max(bounded_x, bounded_y);
    anisotropy.minor = select(minor, -minor, back_minor);
    anisotropy.alpha_minor = min(bounded_x, bounded_y);
    anisotropy.view_major = surface.sin_view * abs(cos_major);
    anisotropy.view_minor = surface.sin_view * abs(cos_minor);
    // Seen at a grazing angle the masking of the view counts, which knows alpha along the view alone; along
    // the normal all azimuths must agree, and the geometric mean is best.
    let wide = anisotropy.alpha_major * anisotropy.view_major;
    let narrow = anisotropy.alpha_minor * anisotropy.view_minor;
    let upright = anisotropy.alpha_major * anisotropy.alpha_minor * surface.cos_view * surface.cos_view;
    let alpha_round = ltc_anisotropic_root(wide * wide + narrow * narrow + upright);
    anisotropy.alpha_round = clamp(alpha_round, anisotropy.alpha_minor, anisotropy.alpha_major);
    anisotropy.handedness = select(1.0, -1.0, (swapped != back_major) != back_minor);
    return anisotropy;
}

/// The isotropic surface whose lobe is stretched: where to sample the isotropic table.
fn ltc_anisotropic_round(surface: LtcSurface, anisotropy: LtcAnisotropy) -> LtcSurface {
    var isotropic = surface;
    isotropic.roughness = ltc_anisotropic_root(anisotropy.alpha_round);
    isotropic.alpha = anisotropy.alpha_round;
    return isotropic;
}

/// The four coordinates of a lobe in the anisotropic table, each 0 to 1.
///
/// GGX of any alpha is GGX of alpha = 1 on a surface that is stretched along its normal, and less along the one axis
/// than along the other; there the view has another direction. Along that one's angle t from the normal lobes of all
/// alphas change alike, where along the view's own sharp ones would change next to the horizon alone.
/// x: root of the larger alpha. y: 1.8 h / (h + 0.8) for h = tan(t / 2), finer next to the normal, where most views
/// lie. z: (1 + sin p - cos p) / 2 for the view's azimuth p from the major direction, nearly proportional to p. w: 1
/// less the root of the ratio of the alphas, scaled to 1 at a ratio of 1 / 10.
fn ltc_anisotropic_coordinates(surface: LtcSurface, anisotropy: LtcAnisotropy) -> vec4<f32> {
    let wide = anisotropy.alpha_major * anisotropy.view_major;
    let narrow = anisotropy.alpha_minor * anisotropy.view_minor;
    let tangential = wide * wide + narrow * narrow;
    let whole = ltc_anisotropic_root(tangential + surface.cos_view * surface.cos_view);
    let sine = ltc_anisotropic_root(tangential);
    let bent = sine * (1.0 + LTC_ANISOTROPIC_KNEE) / max(sine + LTC_ANISOTROPIC_KNEE * (whole + surface.cos_view), LTC_TINY);
    // Along the normal every azimuth is the same.
    let aside = (anisotropy.view_minor - anisotropy.view_major) / max(surface.sin_view, 1e-6);
    let ratio = anisotropy.alpha_minor / anisotropy.alpha_major;
    let coordinates = vec4<f32>(ltc_anisotropic_root(anisotropy.alpha_major), bent, 0.5 + 0.5 * aside,
        (1.0 - ltc_anisotropic_root(ratio)) * 1.4624753);
    return clamp(coordinates, vec4<f32>(0.0), vec4<f32>(1.0));
}

/// The lobe of an anisotropic surface, from two texels of the isotropic table at
/// ltc_table_coordinates(ltc_anisotropic_round(surface, anisotropy)) and the two texels `first` and `second` of the
/// anisotropic table, which are zero for no correction.
///
/// The stretch: GGX's visible normals are those of a hemisphere, a clamped cosine about the stretched view (Heitz
/// 2018; Dupuy and Benyoub 2023), scaled by the alphas. To first order about the middle h of the visible normals,
/// l = 2 (v.h) h - v leads from them to light; linear maps all, so their product is a lobe's matrix already.
/// It is so for the isotropic surface too. What that one's table says beyond the product is taken from there: the
/// lobe's matrix is the anisotropic stretch times the isotropic stretch's inverse times the isotropic lobe's matrix.
/// For equal alphas that is the isotropic lobe, for small ones the exact limit.
///
/// The correction: added to the product of the last two, normalised by its last entry, in units of the lobe's width,
/// so that the table moves no sharp highlight. Of nine entries the scale and a turn about the lobe's axis mean
/// nothing, so the upper left block is symmetric and seven are left: `first` holds (1,1), (1,2), (2,2),
/// (1,3), `second` (2,3), (3,1), (3,2) and the relative change of albedo and Schlick part. All are multiplied by
/// the fourth coordinate, hence vanish for equal alphas. The symmetries used are those of Kt, Heitz, Dupuy and
/// Narayanan 2022, "Bringing Linearly Transformed Cosines to Anisotropic GGX"; the fit is
/// `softbox::fit::bake_anisotropic`.
fn ltc_anisotropic_lobe(surface: LtcSurface, anisotropy: LtcAnisotropy, shape: vec4<f32>, amplitude: vec4<f32>, first: vec4<f32>, second: vec4<f32>) -> LtcLobe {
    let c = surface.cos_view;
    let s = surface.sin_view;
    let a = anisotropy.alpha_round;
    let m = vec4<f32>(c * c + a * shape.x, a * s * shape.y, s * (c + a * shape.z), a * shape.w);

    // The isotropic stretch in the view's plane: its columns are a (height, 0, rise), a (0, height, 0) and
    // (reach, 0, c lift), with the middle normal (slope, 0, 1) and height its product with the view.
    let round_tangential = a * s * a * s;
    let round_inverse = inverseSqrt(max(round_tangential + c * c, LTC_TINY));
    let round_slope = a * a * s * round_inverse;
    let round_tilt = round_tangential * round_inverse;
    let round_height = round_tilt + c;
    let round_lift = 0.5 + 0.5 * round_slope * round_slope;
    let rise = s - c * round_slope;
    let reach = s * (round_lift - 1.0) - round_tilt * round_slope;
    // Its inverse times the isotropic lobe's matrix.
    let scale = 1.0 / max(a * (rise * m.z + round_height * m.x), 1e-12);
    let along_along = (c * round_lift * m.w + reach * m.y) * scale;
    let along_up = -(c * round_lift * m.z + reach * m.x) * scale;
    let up_along = -(rise * m.w + round_height * m.y) * a * scale;
    let across_across = (m.x * m.w - m.y * m.z) * scale * (c * round_lift - reach * rise / max(round_height, LTC_TINY));

    // Corrected, in the plane of the stretched view's azimuth, where the isotropic product has no more entries. A turn about
    // the lobe's axis means nothing, and in any other frame sharp lobes seen at a grazing angle would be what is left of
    // products that are larger by 1 / alpha.
    let view_x = anisotropy.view_major;
    let view_y = anisotropy.view_minor;
    let alpha_x = anisotropy.alpha_major;
    let alpha_y = anisotropy.alpha_minor;
    let wide = alpha_x * view_x;
    let narrow = alpha_y * view_y;
    let tangential = wide * wide + narrow * narrow;
    let azimuth = select(vec2<f32>(1.0, 0.0), vec2<f32>(wide, narrow) * inverseSqrt(max(tangential, 1e-30)), tangential > 1e-30);
    let ratio = alpha_y / alpha_x;
    let depth = clamp((1.0 - ltc_anisotropic_root(ratio)) * 1.4624753, 0.0, 1.0);
    let squares = azimuth * azimuth;
    let both = azimuth.x * azimuth.y;
    let e_uu = along_along + depth * (first.x * squares.x + 2.0 * first.y * both + first.z * squares.y);
    let e_uv = depth * ((first.z - first.x) * both + first.y * (squares.x - squares.y));
    let e_vv = across_across + depth * (first.x * squares.y - 2.0 * first.y * both + first.z * squares.x);
    let e_uz = along_up + depth * (first.w * azimuth.x + second.x * azimuth.y);
    let e_vz = depth * (second.x * azimuth.x - first.w * azimuth.y);
    let e_zu = up_along + depth * (second.y * azimuth.x + second.z * azimuth.y);
    let e_zv = depth * (second.z * azimuth.x - second.y * azimuth.y);

    // The anisotropic stretch; as the isotropic one, but for `turn`, which is zero there. Its first two columns are turned, too; what
    // the second one has along the normal vanishes for a view along the surface.
    let inverse_length = inverseSqrt(max(tangential + c * c, LTC_TINY));
    let slope_x = alpha_x * wide * inverse_length;
    let slope_y = alpha_y * narrow * inverse_length;
    let tilt = tangential * inverse_length;
    let height = tilt + c;
    let lift = 0.5 + 0.5 * (slope_x * slope_x + slope_y * slope_y);
    let turn = view_x * slope_y - view_y * slope_x;
    let normal = surface.normal;
    let major = anisotropy.major;
    let minor = anisotropy.minor;
    let x = alpha_x * azimuth;
    let y = alpha_y * azimuth;
    let u = major * (x.x * height - y.y * turn) + minor * (x.x * turn + y.y * height)
        + normal * (x.x * (view_x - c * slope_x) + y.y * (view_y - c * slope_y));
    let v = minor * (y.x * height - x.y * turn) - major * (y.x * turn + x.y * height)
        + normal * (c * inverse_length * wide * azimuth.y * ((alpha_x - alpha_y) * (alpha_x + alpha_y)));
    let z = major * (view_x * (lift - 1.0) - tilt * slope_x) + minor * (view_y * (lift - 1.0) - tilt * slope_y)
        + normal * (c * lift);

    // The lobe's matrix; a mirrored frame mirrors the lobe's space, in which the cosine is symmetric.
    let m_x = u * e_uu + v * e_uv + z * e_zu;
    let m_y = (u * e_uv + v * e_vv + z * e_zv) * anisotropy.handedness;
    let m_z = u * e_uz + v * e_vz + z;
    // Its cofactors are the inverse up to a factor, and those of the inverse the matrix.
    let middle = cross(m_z, m_x);
    let unit_scale = inverseSqrt(max(dot(middle, middle), LTC_TINY));
    let heights = vec3<f32>(dot(normal, m_x), dot(normal, m_y), dot(normal, m_z));
    let brightness = 1.0 + depth * second.w;
    var lobe: LtcLobe;
    lobe.axis_x = cross(m_y, m_z) * unit_scale;
    lobe.albedo = clamp(amplitude.x * brightness, 0.0, 1.0);
    lobe.axis_y = middle * unit_scale;
    lobe.fresnel = clamp(amplitude.y * brightness, 0.0, 1.0);
    lobe.axis_z = cross(m_x, m_y) * unit_scale;
    lobe.share = 0.5 + 0.5 * heights.z * inverseSqrt(max(dot(heights, heights), LTC_TINY));
    // Of a map that mirrors nothing; rounding may say otherwise where the matrix is all but singular, next to the horizon.
    let volume = abs(unit_scale * dot(m_y, lobe.axis_y));
    lobe.normal_x = m_x * volume;
    lobe.normal_y = m_y * volume;
    lobe.normal_z = m_z * volume;
    return ltc_framed_lobe(surface, lobe);
}

/// The lobe of an anisotropic surface from the isotropic table alone: 2 samples of layers 0 and 1, as
/// ltc_lobe_from_table takes them.
fn ltc_stretched_lobe_from_table(surface: LtcSurface, anisotropy: LtcAnisotropy, table: texture_2d_array<f32>, table_sampler: sampler, table_size: f32) -> LtcLobe {
    let at = ltc_table_coordinates(ltc_anisotropic_round(surface, anisotropy), table_size);
    let shape = textureSampleLevel(table, table_sampler, at, 0, 0.0);
    let amplitude = textureSampleLevel(table, table_sampler, at, 1, 0.0);
    return ltc_anisotropic_lobe(surface, anisotropy, shape, amplitude, vec4<f32>(0.0), vec4<f32>(0.0));
}

/// The lobe of an anisotropic surface from the table's texture array, of which the layers `first_layer` and the next
/// hold the anisotropic table: 2 samples of layers 0 and 1, and 8 of these. `table_size` is the texels along
/// each side of a layer, 64 or more; the sampler filters linearly.
///
/// Tiles of 8 x 8 texels fill the first 64 x 64: the first two coordinates run within a tile, from the first texel's
/// centre to the last one's, so that filtering never reaches the next tile; the others run from tile to tile.
fn ltc_anisotropic_lobe_from_table(surface: LtcSurface, anisotropy: LtcAnisotropy, table: texture_2d_array<f32>, table_sampler: sampler, table_size: f32, first_layer: i32) -> LtcLobe {
    let at = ltc_table_coordinates(ltc_anisotropic_round(surface, anisotropy), table_size);
    let shape = textureSampleLevel(table, table_sampler, at, 0, 0.0);
    let amplitude = textureSampleLevel(table, table_sampler, at, 1, 0.0);
    let position = ltc_anisotropic_coordinates(surface, anisotropy) * (LTC_ANISOTROPIC_SIZE - 1.0);
    let tile = min(floor(position.zw), vec2<f32>(LTC_ANISOTROPIC_SIZE - 2.0));
    let between = position.zw - tile;
    let next = LTC_ANISOTROPIC_SIZE / table_size;
    let upper_left = (tile * LTC_ANISOTROPIC_SIZE + position.xy + 0.5) / table_size;
    let upper_right = upper_left + vec2<f32>(next, 0.0);
    let lower_left = upper_left + vec2<f32>(0.0, next);
    let lower_right = upper_left + vec2<f32>(next, next);
    let upper_first = mix(textureSampleLevel(table, table_sampler, upper_left, first_layer, 0.0),
        textureSampleLevel(table, table_sampler, upper_right, first_layer, 0.0), vec4<f32>(between.x));
    let lower_first = mix(textureSampleLevel(table, table_sampler, lower_left, first_layer, 0.0),
        textureSampleLevel(table, table_sampler, lower_right, first_layer, 0.0), vec4<f32>(between.x));
    let upper_second = mix(textureSampleLevel(table, table_sampler, upper_left, first_layer + 1, 0.0),
        textureSampleLevel(table, table_sampler, upper_right, first_layer + 1, 0.0), vec4<f32>(between.x));
    let lower_second = mix(textureSampleLevel(table, table_sampler, lower_left, first_layer + 1, 0.0),
        textureSampleLevel(table, table_sampler, lower_right, first_layer + 1, 0.0), vec4<f32>(between.x));
    let first = mix(upper_first, lower_first, vec4<f32>(between.y));
    let second = mix(upper_second, lower_second, vec4<f32>(between.y));
    return ltc_anisotropic_lobe(surface, anisotropy, shape, amplitude, first, second);
}

// ---------------------------------------------------------------------------------------------
// Whole surfaces under many lights
//
//     let shading = ltc_shading(position, normal, view, material, layers, table, table_sampler, table_size);
//     for each light:
//         let received = ltc_shading_quad(shading, a, b, c, d, two_sided);
//         sum += radiance * ltc_reflected(shading, material, received);
//
// What belongs to the surface alone - frame, samples of the table, lobes - is made once, and what belongs to
// a light alone - its cut at the surface's horizon - once for all lobes. A part of the surface that is
// switched off costs nothing; one that is on costs its lobe even where a material gives it no weight.
// ---------------------------------------------------------------------------------------------

/// What a surface is made of. Members that belong to a switched-off effect are not read.
struct LtcMaterial {
    /// Reflectance of the diffuse part, 0 to 1.
    base_colour: vec3<f32>,
    /// Perceptual roughness of the specular part, 0 to 1.
    roughness: f32,
    /// Specular reflectance at normal incidence (F0).
    normal_reflectance: vec3<f32>,
    /// Roughness of the diffuse part, from 0 for Lambert's law to 1.
    diffuse_roughness: f32,
    /// Specular reflectance at grazing incidence (F90).
    grazing_reflectance: vec3<f32>,
    /// Share of the surface that a clear coat covers, 0 to 1.
    coat: f32,
    /// Reflectance of the sheen over everything but the coat, 0 to 1.
    sheen_colour: vec3<f32>,
    /// Perceptual roughness of the sheen.
    sheen_roughness: f32,
    /// Direction along the surface in which highlights are longest; need be neither unit nor quite along it.
    grain: vec3<f32>,
    /// Strength of the anisotropy, 0 to 1, see ltc_anisotropic_alpha.
    anisotropy: f32,
    /// Perceptual roughness of the coat.
    coat_roughness: f32,
    /// Reflectance of the coat at normal incidence.
    coat_reflectance: f32,
}

/// Which layers of the table's texture array hold what; constants of the caller. Those of switched-off effects
/// are not read.
struct LtcLayers {
    /// The first of the layers of several lobes, see ltc_lobes_from_table.
    lobes: i32,
    /// The layer of the sheen.
    sheen: i32,
    /// The layer of rough diffuse parts.
    diffuse: i32,
    /// The first of the two layers of anisotropic surfaces.
    anisotropic: i32,
}

/// A surface point with all its lobes.
struct LtcShading {
    /// The point and its frame.
    surface: LtcSurface,
    /// The specular lobes. An anisotropic surface has one; the others weigh nothing there.
    specular: LtcLobes,
    /// The coat's lobes.
    coat: LtcLobes,
    /// The sheen's lobe.
    sheen: LtcLobe,
    /// The lobe of a rough diffuse part.
    rough: LtcLobe,
}

/// What the parts of a surface receive of a light of unit radiance and reflect of it for a colour of 1.
struct LtcReceived {
    /// The form factor.
    diffuse: f32,
    /// The value of the rough diffuse lobe.
    rough: f32,
    /// The specular value and Schlick's part of it.
    specular: vec2<f32>,
    /// The same of the coat.
    coat: vec2<f32>,
    /// The value of the sheen's lobe.
    sheen: f32,
}

/// A polygon that is given vertex by vertex to a whole surface.
struct LtcShadingPolygon {
    /// Its outline.
    outline: LtcOutline,
    /// What the specular lobes know of it.
    specular: LtcOutlineLobes,
    /// What the coat's lobes know of it.
    coat: LtcOutlineLobes,
    /// What the sheen's lobe knows of it.
    sheen: LtcOutlineLobe,
    /// What the rough diffuse lobe knows of it.
    rough: LtcOutlineLobe,
}

/// A material of a diffuse and a specular part and nothing else; F90 is 1.
fn ltc_material(base_colour: vec3<f32>, roughness: f32, normal_reflectance: vec3<f32>) -> LtcMaterial {
    var material: LtcMaterial;
    material.base_colour = base_colour;
    material.roughness = roughness;
    material.normal_reflectance = normal_reflectance;
    material.diffuse_roughness = 0.0;
    material.grazing_reflectance = vec3<f32>(1.0);
    material.coat = 0.0;
    material.sheen_colour = vec3<f32>(0.0);
    material.sheen_roughness = 0.5;
    material.grain = vec3<f32>(0.0);
    material.anisotropy = 0.0;
    material.coat_roughness = 0.1;
    material.coat_reflectance = 0.04;
    return material;
}

/// Whether a surface point lies within `range` of the centre of a light, beyond which the light may be skipped; see
/// softbox::light::Light::range.
fn ltc_in_range(position: vec3<f32>, centre: vec3<f32>, range: f32) -> bool {
    let away = centre * LTC_HEADROOM - position * LTC_HEADROOM;
    let extent = ltc_extent(away);
    let scaled = away * (1.0 / max(extent, LTC_TINY));
    let squared = dot(scaled, scaled);
    return extent * (squared * inverseSqrt(max(squared, LTC_TINY))) <= range * LTC_HEADROOM;
}

/// The lobes of a surface point. `normal` and `view` are as for ltc_surface, the table as for ltc_lobe_from_table,
/// with the layers of the effects that are on.
fn ltc_shading(position: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, material: LtcMaterial, layers: LtcLayers, table: texture_2d_array<f32>, table_sampler: sampler, table_size: f32) -> LtcShading {
    let surface = ltc_surface(position, normal, view, material.roughness);
    var shading: LtcShading;
    shading.surface = surface;
    if (ltc_use_anisotropic & (material.anisotropy > 0.0)) {
        let alpha = ltc_anisotropic_alpha(material.roughness, material.anisotropy);
        let anisotropy = ltc_anisotropy(surface, material.grain, alpha.x, alpha.y);
        shading.specular = ltc_lobes_of(surface, ltc_anisotropic_lobe_from_table(surface, anisotropy, table, table_sampler, table_size, layers.anisotropic));
    } else if (ltc_use_ggx) {
        shading.specular = ltc_lobes_from_table(surface, table, table_sampler, table_size, layers.lobes);
    }
    if (ltc_use_clearcoat) {
        shading.coat = ltc_lobes_from_table(ltc_surface_with_roughness(surface, material.coat_roughness), table, table_sampler, table_size, layers.lobes);
    }
    if (ltc_use_sheen) {
        shading.sheen = ltc_sheen_lobe_from_table(ltc_surface_with_roughness(surface, material.sheen_roughness), table, table_sampler, table_size, layers.sheen);
    }
    if (ltc_use_rough_diffuse) {
        shading.rough = ltc_diffuse_lobe_from_table(ltc_surface_with_roughness(surface, material.diffuse_roughness), table, table_sampler, table_size, layers.diffuse);
    }
    return shading;
}

/// The value of a lobe without a Schlick part from the vector form factor in its space.
fn ltc_plain_value(lobe: LtcLobe, toward: vec3<f32>) -> f32 {
    return lobe.albedo * clamp(toward.z / lobe.share, 0.0, 1.0);
}

/// What the surface receives of a convex quad; see ltc_quad.
fn ltc_shading_quad(shading: LtcShading, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, two_sided: bool) -> LtcReceived {
    var received: LtcReceived;
    let quad = ltc_quad_begin(shading.surface, a, b, c, d, two_sided);
    if (quad.reaches) {
        received.diffuse = ltc_quad_diffuse(shading.surface, quad);
        if (ltc_use_ggx) {
            received.specular = ltc_quad_specular(shading.surface, quad, shading.specular);
        }
        if (ltc_use_clearcoat) {
            received.coat = ltc_quad_specular(shading.surface, quad, shading.coat);
        }
        if (ltc_use_sheen) {
            received.sheen = ltc_plain_value(shading.sheen, ltc_quad_lobe(quad, shading.sheen));
        }
        if (ltc_use_rough_diffuse) {
            received.rough = ltc_plain_value(shading.rough, ltc_quad_lobe(quad, shading.rough));
        }
    }
    return received;
}

/// What the surface receives of a disk; see ltc_disk.
fn ltc_shading_disk(shading: LtcShading, centre: vec3<f32>, half_x: vec3<f32>, half_y: vec3<f32>, two_sided: bool) -> LtcReceived {
    var received: LtcReceived;
    let disk = ltc_disk_begin(shading.surface, centre, half_x, half_y, two_sided);
    received.diffuse = ltc_disk_diffuse(disk);
    if (ltc_use_ggx) {
        received.specular = ltc_disk_specular(shading.surface, disk, shading.specular);
    }
    if (ltc_use_clearcoat) {
        received.coat = ltc_disk_specular(shading.surface, disk, shading.coat);
    }
    if (ltc_use_sheen) {
        received.sheen = ltc_plain_value(shading.sheen, ltc_disk_lobe(disk, shading.sheen));
    }
    if (ltc_use_rough_diffuse) {
        received.rough = ltc_plain_value(shading.rough, ltc_disk_lobe(disk, shading.rough));
    }
    return received;
}

/// What the surface receives of a sphere; see ltc_sphere.
fn ltc_shading_sphere(shading: LtcShading, centre: vec3<f32>, radius: f32) -> LtcReceived {
    var received: LtcReceived;
    let sphere = ltc_sphere_begin(shading.surface, centre, radius);
    received.diffuse = ltc_sphere_diffuse(sphere);
    if (ltc_use_ggx) {
        received.specular = ltc_sphere_specular(shading.surface, sphere, shading.specular);
    }
    if (ltc_use_clearcoat) {
        received.coat = ltc_sphere_specular(shading.surface, sphere, shading.coat);
    }
    if (ltc_use_sheen) {
        received.sheen = ltc_plain_value(shading.sheen, ltc_sphere_lobe(sphere, shading.sheen));
    }
    if (ltc_use_rough_diffuse) {
        received.rough = ltc_plain_value(shading.rough, ltc_sphere_lobe(sphere, shading.rough));
    }
    return received;
}

/// What the surface receives of a tube; see ltc_tube.
fn ltc_shading_tube(shading: LtcShading, start: vec3<f32>, end: vec3<f32>, radius: f32, caps: bool) -> LtcReceived {
    var received: LtcReceived;
    let tube = ltc_tube_begin(shading.surface, start, end, radius, caps);
    received.diffuse = ltc_tube_diffuse(shading.surface, tube);
    if (ltc_use_ggx) {
        received.specular = ltc_tube_specular(shading.surface, tube, shading.specular);
    }
    if (ltc_use_clearcoat) {
        received.coat = ltc_tube_specular(shading.surface, tube, shading.coat);
    }
    if (ltc_use_sheen) {
        received.sheen = ltc_plain_value(shading.sheen, ltc_tube_lobe(tube, shading.sheen));
    }
    if (ltc_use_rough_diffuse) {
        received.rough = ltc_plain_value(shading.rough, ltc_tube_lobe(tube, shading.rough));
    }
    return received;
}

/// Starts a polygon of any number of vertices at its first one.
fn ltc_shading_polygon_begin(shading: LtcShading, corner: vec3<f32>) -> LtcShadingPolygon {
    var polygon: LtcShadingPolygon;
    polygon.outline = ltc_outline_begin(shading.surface, corner);
    polygon.specular = ltc_outline_lobes_begin();
    polygon.coat = ltc_outline_lobes_begin();
    polygon.sheen = ltc_outline_lobe_begin();
    polygon.rough = ltc_outline_lobe_begin();
    return polygon;
}

/// Adds the next vertex.
fn ltc_shading_polygon_add(polygon: ptr<function, LtcShadingPolygon>, shading: LtcShading, corner: vec3<f32>) {
    var outline = (*polygon).outline;
    ltc_outline_add(&outline, shading.surface, corner);
    (*polygon).outline = outline;
    if (ltc_use_ggx) {
        var specular = (*polygon).specular;
        ltc_outline_lobes_add(&specular, shading.surface, outline, shading.specular);
        (*polygon).specular = specular;
    }
    if (ltc_use_clearcoat) {
        var coat = (*polygon).coat;
        ltc_outline_lobes_add(&coat, shading.surface, outline, shading.coat);
        (*polygon).coat = coat;
    }
    if (ltc_use_sheen) {
        var sheen = (*polygon).sheen;
        ltc_outline_lobe_add(&sheen, outline, shading.sheen);
        (*polygon).sheen = sheen;
    }
    if (ltc_use_rough_diffuse) {
        var rough = (*polygon).rough;
        ltc_outline_lobe_add(&rough, outline, shading.rough);
        (*polygon).rough = rough;
    }
}

/// What the surface receives of the polygon whose vertices have all been added.
fn ltc_shading_polygon_end(polygon: ptr<function, LtcShadingPolygon>, shading: LtcShading, two_sided: bool) -> LtcReceived {
    let first = (*polygon).outline.first;
    ltc_shading_polygon_add(polygon, shading, first);
    let outline = (*polygon).outline;
    var received: LtcReceived;
    received.diffuse = ltc_outline_diffuse(outline, two_sided);
    if (ltc_use_ggx) {
        received.specular = ltc_outline_specular(shading.surface, outline, (*polygon).specular, shading.specular, two_sided);
    }
    if (ltc_use_clearcoat) {
        received.coat = ltc_outline_specular(shading.surface, outline, (*polygon).coat, shading.coat, two_sided);
    }
    if (ltc_use_sheen) {
        received.sheen = ltc_plain_value(shading.sheen, ltc_outline_lobe(outline, (*polygon).sheen, two_sided));
    }
    if (ltc_use_rough_diffuse) {
        received.rough = ltc_plain_value(shading.rough, ltc_outline_lobe(outline, (*polygon).rough, two_sided));
    }
    return received;
}

/// Radiance that a surface reflects of a light of unit radiance; it is linear in what is received.
///
/// The specular part lies over the diffuse one without loss, as in most engines; sheen and coat take from what is
/// below them, see ltc_sheen_over and ltc_coat_over.
fn ltc_reflected(shading: LtcShading, material: LtcMaterial, received: LtcReceived) -> vec3<f32> {
    var radiance = material.base_colour * received.diffuse;
    if (ltc_use_rough_diffuse) {
        let diffuse = ltc_surface_with_roughness(shading.surface, material.diffuse_roughness);
        let rough = ltc_rough_diffuse(diffuse, shading.rough, vec3<f32>(received.diffuse, received.rough, 0.0), material.base_colour);
        radiance = select(radiance, rough, material.diffuse_roughness > 0.0);
    }
    if (ltc_use_ggx) {
        let value = vec3<f32>(received.diffuse, received.specular);
        var specular = ltc_reflectance(value, material.normal_reflectance, material.grazing_reflectance);
        if (ltc_use_energy_compensation) {
            specular *= ltc_energy_compensation(ltc_lobes_together(shading.surface, shading.specular), material.normal_reflectance);
        }
        radiance += specular;
    }
    if (ltc_use_sheen) {
        radiance = ltc_sheen_over(radiance, shading.sheen, vec3<f32>(received.diffuse, received.sheen, 0.0), material.sheen_colour);
    }
    if (ltc_use_clearcoat) {
        radiance = ltc_coat_over(radiance, ltc_lobes_together(shading.surface, shading.coat), vec3<f32>(received.diffuse, received.coat), material.coat_reflectance, material.coat);
    }
    return radiance;
}

/// Radiance that a surface reflects of a rectangle, or another parallelogram, that shows a picture of `texels`
/// texels: each lobe sees the picture as blurred as it is wide.
fn ltc_reflected_picture(shading: LtcShading, material: LtcMaterial, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, two_sided: bool, picture: texture_2d<f32>, picture_sampler: sampler, texels: vec2<f32>) -> vec3<f32> {
    let quad = ltc_quad_begin(shading.surface, a, b, c, d, two_sided);
    if (!quad.reaches) {
        return vec3<f32>(0.0);
    }
    // What is reflected is linear in what is received, so each part brings its own colour.
    var diffuse: LtcReceived;
    diffuse.diffuse = ltc_quad_diffuse(shading.surface, quad);
    if (ltc_use_rough_diffuse) {
        diffuse.rough = ltc_plain_value(shading.rough, ltc_quad_lobe(quad, shading.rough));
    }
    let place = ltc_rectangle_diffuse_lookup(shading.surface, a, b, d, ltc_quad_toward(shading.surface, quad), texels, false);
    var radiance = ltc_reflected(shading, material, diffuse) * ltc_texture_fetch(picture, picture_sampler, place).xyz;
    if (ltc_use_ggx) {
        let glossy = ltc_quad_picture(shading.surface, quad, shading.specular, a, b, d, picture, picture_sampler, texels);
        var specular: LtcReceived;
        specular.specular = glossy.value;
        radiance += ltc_reflected(shading, material, specular) * glossy.colour;
    }
    if (ltc_use_clearcoat) {
        let clear = ltc_quad_picture(shading.surface, quad, shading.coat, a, b, d, picture, picture_sampler, texels);
        var coat: LtcReceived;
        coat.coat = clear.value;
        radiance += ltc_reflected(shading, material, coat) * clear.colour;
    }
    if (ltc_use_sheen) {
        let toward = ltc_quad_lobe(quad, shading.sheen);
        var sheen: LtcReceived;
        sheen.sheen = ltc_plain_value(shading.sheen, toward);
        let soft = ltc_rectangle_lookup(shading.surface, shading.sheen, a, b, d, toward, texels, false);
        radiance += ltc_reflected(shading, material, sheen) * ltc_texture_fetch(picture, picture_sampler, soft).xyz;
    }
    return radiance;
}

// ---------------------------------------------------------------------------------------------
// Fast lights: a lobe without a table, quads that are neither cut nor told apart by distance
//
// With the switches for a cheap horizon and a cheap distance a quad is its four directions. There are no branches, no
// products of positions, and a horizon is a formula in the vector form factor.
// ---------------------------------------------------------------------------------------------

/// `v` over its length, for a `v` whose square is in range; shorter than 1 below 1e-18.
fn ltc_fast_unit(v: vec3<f32>) -> vec3<f32> {
    // Added to the first square the bound costs nothing where multiplication and addition are one.
    return v * inverseSqrt(v.x * v.x + (v.y * v.y + (v.z * v.z + LTC_TINY)));
}

/// t / sin t for the angle t between two unit vectors, from their sum, whose length is twice the cosine of t / 2.
///
/// It has a pole at 180 degrees: there an edge passes the surface point, or the middle of a lobe. Over the
/// reciprocal of that cosine it is smooth, so one polynomial serves all angles. A scalar product would have lost the
/// digits of the cosine near the pole, the sum has not. The relative error of t / sin t is below 7.7e-4; the coefficients
/// are those of the fit `softbox::fit::fit_half_angle` of degree 2. Bounded by 4e6 for any input.
fn ltc_fast_ratio(v: vec3<f32>) -> f32 {
    let squared = v.x * v.x + (v.y * v.y + (v.z * v.z + 1e-12));
    let inverse = inverseSqrt(squared);
    return 3.1391903 * inverse + ((0.2799755 * inverse - 0.0423115) * squared - 0.9603001);
}

/// The edge integral of two unit vectors: the angle between them along the normal of their plane.
fn ltc_fast_edge(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    let product = cross(a, b - a);
    return product * ltc_fast_ratio(a + b);
}

/// Vector form factor, times 2 pi and signed, of the quad between four unit vectors: the sum of ltc_fast_edge, with the
/// cross products of opposite vertices with their neighbours in place of those of the edges. A small quad's are those
/// of two differences, and of a vertex with another one close to it, so that rounding is as small as the quad.
fn ltc_fast_form_factor(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> vec3<f32> {
    let a_ratio = ltc_fast_ratio(a + b);
    let b_ratio = ltc_fast_ratio(b + c);
    let c_ratio = ltc_fast_ratio(c + d);
    let d_ratio = ltc_fast_ratio(d + a);
    let from_a = b * a_ratio - d * d_ratio;
    let more_from_c = b * (b_ratio - a_ratio) + d * (d_ratio - c_ratio);
    return cross(c - a, from_a) + cross(c, more_from_c);
}

/// The form factor of what a horizon leaves of the round light whose vector form factor is given; `height` is the product
/// of that one and the horizon's normal (the idea: Snyder 1996, "Area Light Sources for Real-Time Graphics"; Hill and
/// Heitz 2016).
///
/// Of the light above and the light below, what counts of either is the same but for `height`. What a level horizon
/// leaves is that of half the light, and between there and the light that it does not cut the fit
/// `softbox::fit::fit_round_above` runs, off by at most 0.006 and exact where nothing is cut.
fn ltc_round_above(form_factor: vec3<f32>, height: f32) -> f32 {
    let squared = min(dot(form_factor, form_factor), 1.0);
    let inverse = inverseSqrt(max(squared, LTC_TINY));
    // The square of the sine of the light's half-angle, and that times the sine.
    let whole = squared * inverse;
    let reach = whole * sqrt(max(whole, LTC_TINY));
    let tilt = min(abs(height * inverse), 1.0);
    // 1 where the horizon touches the light's rim.
    let offset = min(tilt * tilt * inverse, 1.0);
    let depth = sqrt(max(1.0 - whole, LTC_TINY));
    let missing = (1.221 - 0.80223 * depth) * depth + 0.0892 * offset;
    return saturate(0.5 * (height + max(abs(height), reach * (1.0 - (1.0 - offset) * missing))));
}

/// A quad light as its four directions, in the place of the vertices, in the surface's frame.
fn ltc_fast_quad(surface: LtcSurface, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, two_sided: bool) -> LtcQuad {
    // A power of two, so that it takes no digits from the difference of two positions.
    let reach = max(max(ltc_extent(a), ltc_extent(b)), max(ltc_extent(c), ltc_extent(d)));
    let extent = max(max(reach, ltc_extent(surface.position)), 1e-30);
    let scale = bitcast<f32>(0x7f800000u - (bitcast<u32>(extent) & 0x7f800000u));
    let origin = surface.position * scale;
    var quad: LtcQuad;
    quad.a = ltc_in_frame(surface, ltc_fast_unit(a * scale - origin));
    quad.b = ltc_in_frame(surface, ltc_fast_unit(b * scale - origin));
    quad.c = ltc_in_frame(surface, ltc_fast_unit(c * scale - origin));
    quad.d = ltc_in_frame(surface, ltc_fast_unit(d * scale - origin));
    quad.front = dot(cross(quad.b - quad.d, quad.c), quad.a) < 0.0;
    quad.two_sided = two_sided & ltc_use_two_sided;
    quad.reaches = quad.front | quad.two_sided;
    return quad;
}

/// ltc_quad_lobe for a quad of ltc_fast_quad.
fn ltc_fast_lobe(quad: LtcQuad, lobe: LtcLobe) -> vec3<f32> {
    let a = ltc_fast_unit(ltc_transform_framed(lobe, quad.a));
    let b = ltc_fast_unit(ltc_transform_framed(lobe, quad.b));
    let c = ltc_fast_unit(ltc_transform_framed(lobe, quad.c));
    let d = ltc_fast_unit(ltc_transform_framed(lobe, quad.d));
    let toward = ltc_fast_form_factor(a, b, c, d) * select(-LTC_OVER_TWO_PI, LTC_OVER_TWO_PI, quad.front);
    return vec3<f32>(toward.xy, ltc_round_above(toward, toward.z)) * lobe.share;
}

/// What an outline's sums are to be multiplied by for the form factor of the light that arrives.
fn ltc_outline_scale(outline: LtcOutline, two_sided: bool) -> f32 {
    let front = outline.facing < 0.0;
    return select(select(0.0, -LTC_OVER_TWO_PI, two_sided & ltc_use_two_sided), LTC_OVER_TWO_PI, front);
}

/// The lobe of a surface by a closed form in the roughness and the cosine of the view, in place of the table.
///
/// The shape is that of ltc_lobe: X, Y, Z and W vary so little that 16 coefficients are enough. On random quads the mean error
/// is 3.0 % of the specular value and 4.2 % of Schlick's part, that of the table 2.1 and 4.7 %. The coefficients are the
/// fit `softbox::fit::fit_lobe_formula`. The idea of a closed form for the two albedos: Lazarov 2013, "Getting More Physical
/// in Call of Duty: Black Ops II"; Karis 2014, "Physically Based Shading on Mobile".
fn ltc_lobe_fitted(surface: LtcSurface) -> LtcLobe {
    let r = surface.roughness;
    let c = surface.cos_view;
    let a = surface.alpha;
    let c_squared = c * c;
    let a_squared = a * a;
    var shape: vec4<f32>;
    shape.x = r * ((1.508871 + (3.145455 - 3.884754 * r) * r) * r + (1.488739 - 2.649476 * c) * c);
    shape.y = (1.19368 * a_squared - 0.8051475) * c + (0.4593228 - 0.5799547 * r) * a;
    shape.z = r * (1.491276 - 1.525616 * c - 1.383334 * a);
    shape.w = (0.7461472 - 1.447918 * a_squared) * c_squared + (1.22383 + 0.3294481 * a);
    let albedo = saturate(1.0 + r * (0.4340052 * c_squared - 0.1695292 + (1.536499 * r - 2.495072) * (a * c)));
    let beside = 1.0 - c;
    let z = r * beside;
    let root = max(1.00488 * beside + 0.1454361 * r + ((3.282343 - 1.25427 * z) * z - 2.643383) * (z * z), 0.0);
    let root_squared = root * root;
    let fresnel = min(root_squared * root_squared * root, albedo);
    return ltc_lobe(surface, shape, vec4<f32>(albedo, fresnel, 0.0, 0.0));
}
