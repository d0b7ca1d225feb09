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

/// Pi.
const LTC_PI: f32 = 3.14159265358979;

/// 1 / (2 pi).
const LTC_OVER_TWO_PI: f32 = 0.159154943091895;

/// Roughness below which the lobe no longer changes: alpha = 0.0004.
const LTC_ROUGHNESS_FLOOR: f32 = 0.02;

/// Smallest length by which anything is divided; a reciprocal of it is still finite.
const LTC_TINY: f32 = 1e-37;

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
    /// Entries (x, y, z, w) of the inverse matrix in the surface's frame:
    /// rows (x, 0, z), (0, 1, 0), (y, 0, w).
    entries: vec4<f32>,
    /// First row of the matrix that leads vectors from the caller's space to the lobe's.
    axis_x: vec3<f32>,
    /// The BRDF's integral of f cos over the hemisphere, for F = 1.
    albedo: f32,
    /// Second row of that matrix.
    axis_y: vec3<f32>,
    /// The BRDF's integral of f cos (1 - v.h)^5 over the hemisphere.
    fresnel: f32,
    /// Third row of that matrix.
    axis_z: vec3<f32>,
    /// Share of the lobe's energy above the surface.
    share: f32,
    /// First row of the matrix that leads cross products of vectors there.
    normal_x: vec3<f32>,
    /// Determinant of the entries.
    volume: f32,
    /// Third row of that matrix; the second is `volume` times `axis_y`.
    normal_z: vec3<f32>,
}

/// State of a polygon that is given vertex by vertex; read and written by the library alone.
struct LtcPolygon {
    /// First vertex, in the caller's space.
    first: vec3<f32>,
    /// Factor that brings the first vertex to a distance of about 1.
    scale: f32,
    /// Last vertex so far, in the caller's space.
    previous: vec3<f32>,
    /// Twice the signed area so far times the height of the surface point over the light's plane.
    facing: f32,
    /// First point on the surface's horizon, in the frame.
    surface_crossing: vec3<f32>,
    /// 1 once there is such a point.
    surface_crossed: f32,
    /// Its offset from the first vertex.
    surface_crossing_offset: vec3<f32>,
    /// Form factor so far, times 2 pi and signed.
    diffuse: f32,
    /// First point on the lobe's horizon, in the lobe's space.
    lobe_crossing: vec3<f32>,
    /// 1 once there is such a point.
    lobe_crossed: f32,
    /// Its offset from the first vertex.
    lobe_crossing_offset: vec3<f32>,
    /// Vector form factor so far in the lobe's space, times 2 pi and signed.
    lobe_sum: vec3<f32>,
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
    let scaled = v * (1.0 / max(ltc_extent(v), LTC_TINY));
    return scaled * inverseSqrt(max(dot(scaled, scaled), LTC_TINY));
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

/// The lobe that two texels of the table describe.
///
/// `shape` (layer 0) holds the lobe as its deviation (X, Y, Z, W) from the mirror's lobe, in units
/// of the lobe's width, with t the angle between normal and view:
///     x = cos^2 t + alpha X      z = sin t (cos t + alpha Z)
///     y = alpha sin t Y          w = alpha W
/// so neither interpolation nor half precision moves a sharp highlight off its place. For
/// alpha -> 0, X and Z vanish, and the rest tends to Y = -2 cos t, W = 2 cos^2 t.
/// `amplitude` (layer 1) holds the albedo and its Schlick part in x and y.
fn ltc_lobe(surface: LtcSurface, shape: vec4<f32>, amplitude: vec4<f32>) -> LtcLobe {
    let c = surface.cos_view;
    let s = surface.sin_view;
    let a = surface.alpha;
    let m = vec4<f32>(c * c + a * shape.x, a * s * shape.y, s * (c + a * shape.z), a * shape.w);
    var lobe: LtcLobe;
    lobe.entries = m;
    lobe.axis_x = surface.tangent * m.x + surface.normal * m.z;
    lobe.albedo = amplitude.x;
    lobe.axis_y = surface.bitangent;
    lobe.fresnel = amplitude.y;
    lobe.axis_z = surface.tangent * m.y + surface.normal * m.w;
    // In the lobe's space the surface's half-space has the normal (-y, 0, x). The cosine hemisphere
    // that it cuts projects to half a disk and half an ellipse: (1 + cos g) / 2 of the whole for an
    // angle g between the two normals.
    lobe.share = 0.5 + 0.5 * m.x * inverseSqrt(max(m.x * m.x + m.y * m.y, LTC_TINY));
    lobe.normal_x = surface.tangent * m.w - surface.normal * m.y;
    lobe.volume = m.x * m.w - m.y * m.z;
    lobe.normal_z = surface.normal * m.x - surface.tangent * m.z;
    return lobe;
}

/// The lobe of a surface from the table's texture array (layers 0 and 1, `table_size` texels along
/// each side) and a sampler that filters linearly and clamps to the edge.
fn ltc_lobe_from_table(surface: LtcSurface, table: texture_2d_array<f32>, table_sampler: sampler, table_size: f32) -> LtcLobe {
    let at = ltc_table_coordinates(surface, table_size);
    let shape = textureSampleLevel(table, table_sampler, at, 0, 0.0);
    let amplitude = textureSampleLevel(table, table_sampler, at, 1, 0.0);
    return ltc_lobe(surface, shape, amplitude);
}

/// `v`, a vector from the surface point, in the lobe's space.
fn ltc_transform(lobe: LtcLobe, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(lobe.axis_x, v), dot(lobe.axis_y, v), dot(lobe.axis_z, v));
}

/// The cross product of two vectors from the surface point, in the lobe's space: what it is the cross
/// product of there. Unlike that of the transformed vectors it keeps the digits of an edge that passes
/// the surface point closely.
fn ltc_transform_normal(lobe: LtcLobe, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(lobe.normal_x, v), lobe.volume * dot(lobe.axis_y, v), dot(lobe.normal_z, v));
}

/// Reflected radiance of a specular surface with reflectance `normal_reflectance` (F0) at normal and
/// `grazing_reflectance` (F90) at grazing incidence, from the value (diffuse, specular, fresnel) of a
/// light of unit radiance (Schlick 1994).
fn ltc_reflectance(value: vec3<f32>, normal_reflectance: vec3<f32>, grazing_reflectance: vec3<f32>) -> vec3<f32> {
    return normal_reflectance * (value.y - value.z) + grazing_reflectance * value.z;
}

/// The parts (specular, fresnel) of a light's value, from the `coverage` of a lobe, the share of
/// its energy that the light covers, and the mean direction `toward` the light in the lobe's space.
///
/// A lobe's shape is fitted to the whole BRDF. Schlick's part has another shape, and knows it from
/// the direction: for a small light it is (1 - v.h)^5 of the specular part, v.h taken at the light;
/// for a light that covers the whole lobe it is the table's average. The square of the coverage
/// leads from one to the other.
fn ltc_specular(surface: LtcSurface, lobe: LtcLobe, coverage: f32, toward: vec3<f32>) -> vec2<f32> {
    // The matrix itself, up to the positive factor 1 / determinant.
    let m = lobe.entries;
    let direction = vec3<f32>(m.w * toward.x - m.z * toward.z, lobe.volume * toward.y, m.x * toward.z - m.y * toward.x);
    let unit = ltc_direction(direction);
    // cos^2 of half the angle between view and light: the half vector's cosine, squared.
    let half_cosine = clamp(0.5 + 0.5 * (surface.sin_view * unit.x + surface.cos_view * unit.z), 0.0, 1.0);
    let f = 1.0 - half_cosine * inverseSqrt(max(half_cosine, 1e-20));
    let schlick = f * f * f * f * f;
    let whole = coverage * coverage;
    return coverage * vec2<f32>(lobe.albedo, lobe.albedo * schlick * (1.0 - whole) + lobe.fresnel * whole);
}

/// The value (diffuse, specular, fresnel) from the signed form factor over the surface's horizon
/// and the signed vector form factor over both horizons in the lobe's space; `front` tells whether
/// the light shows its emitting side.
fn ltc_value(surface: LtcSurface, lobe: LtcLobe, form_factor: f32, lobe_form_factor: vec3<f32>, front: bool, two_sided: bool) -> vec3<f32> {
    // A two-sided light is lit by the sign that the sum itself has: `front` may differ from it by
    // rounding where the light is seen edge-on.
    let emits = front | two_sided;
    let flipped = two_sided & (lobe_form_factor.z < 0.0);
    let toward = select(lobe_form_factor, -lobe_form_factor, flipped);
    let diffuse = select(form_factor, abs(form_factor), two_sided);
    let coverage = select(0.0, clamp(toward.z / lobe.share, 0.0, 1.0), emits);
    let specular = ltc_specular(surface, lobe, coverage, toward);
    return vec3<f32>(select(0.0, clamp(diffuse, 0.0, 1.0), emits), specular);
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

/// The cross product a x b of two vectors whose difference b - a is `side`. That with the shorter of the
/// two has the fewest digits to lose.
fn ltc_edge_normal(a: vec3<f32>, b: vec3<f32>, side: vec3<f32>) -> vec3<f32> {
    return cross(select(a, b, dot(b, b) < dot(a, a)), side);
}

/// The edge integral of the segment between the directions `a` and `b` (unit vectors): the angle t between
/// them along the unit normal of their plane, which is 2 pi times the edge's share of the vector form
/// factor (Lambert; Baum et al. 1989). `normal` is the cross product of the two vectors before they were
/// divided by their lengths, `scale` the reciprocal of the product of these.
///
/// The usual form (t / sin t) (a x b) takes sin t from 1 - (a.b)^2 and a x b from the products. Both cancel,
/// the first for an edge that subtends nearly 180 degrees, which is every edge of a light that touches
/// the surface, the second for a short one. Here both come from ltc_edge_normal, which keeps the distance
/// at which the edge passes. Bounded by pi for any input.
fn ltc_edge(a: vec3<f32>, b: vec3<f32>, normal: vec3<f32>, scale: f32) -> vec3<f32> {
    let squared = dot(normal, normal);
    let inverse_length = inverseSqrt(max(squared, LTC_TINY));
    return normal * (inverse_length * ltc_angle(a, b, squared * inverse_length * scale));
}

/// ltc_edge for a part of an edge, for which `normal` has the right direction only.
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
/// so its form factor is too, where a sum of ltc_edge has lost its digits: its terms are of the
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
    let inverse_length = inverseSqrt(max(dot(target_point, target_point), LTC_TINY));
    let length_sum = dot(target_point, target_point) * inverse_length + dot(origin, reference);
    let length_difference = dot(offset, origin + target_point) / max(length_sum, LTC_TINY);
    let near = (offset - reference * length_difference) * inverse_length;
    // With points far apart the subtraction loses nothing, and `offset` may be the less precise.
    let far = target_point * inverse_length - reference;
    return select(far, near, dot(offset, offset) < 0.0625 * dot(origin, origin));
}

/// ltc_offset for an offset much shorter than `origin`.
fn ltc_far_offset(origin: vec3<f32>, reference: vec3<f32>, offset: vec3<f32>) -> vec3<f32> {
    let target_point = origin + offset;
    let inverse_length = inverseSqrt(max(dot(target_point, target_point), LTC_TINY));
    let length_sum = dot(target_point, target_point) * inverse_length + dot(origin, reference);
    let length_difference = dot(offset, origin + target_point) / max(length_sum, LTC_TINY);
    return (offset - reference * length_difference) * inverse_length;
}

/// Whether `v` lies above the lobe's horizon, or on it but for rounding. Where that horizon is the surface's,
/// as it is seen along the normal, rounding would scatter the points of a light cut there to both sides.
fn ltc_is_above(v: vec3<f32>) -> bool {
    return (v.z > 0.0) | (v.z * v.z < 1e-12 * dot(v, v));
}

/// Where the segment from `above` the plane z = 0 to `below` it meets that plane; only its direction where
/// it passes the surface point closely. `normal` has the direction of above x below.
fn ltc_crossing(above: vec3<f32>, below: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    let t = max(above.z, 0.0) / max(above.z - below.z, LTC_TINY);
    let between = vec3<f32>(above.xy + (below.xy - above.xy) * t, 0.0);
    // Where the segment passes the surface point closely the ends cancel; the plane of the segment still
    // has its digits, unless it is that of the horizon.
    let turned = vec3<f32>(normal.y, -normal.x, 0.0);
    let cancels = dot(between, between) < 1e-6 * max(dot(above, above), dot(below, below));
    let tilted = dot(turned, turned) > 1e-3 * dot(normal, normal);
    return select(between, turned, cancels & tilted);
}

// ---------------------------------------------------------------------------------------------
// Quads
// ---------------------------------------------------------------------------------------------

/// Vector form factor, times 2 pi and signed, of a convex pentagon in the lobe's space, cut at the lobe's
/// horizon z = 0. Each normal has the direction of the cross product of the vertex of its name and the
/// next one. Repeated vertices make it any smaller polygon; `five` tells whether `d` and `e` differ.
fn ltc_pentagon(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, e: vec3<f32>, a_normal: vec3<f32>, b_normal: vec3<f32>, c_normal: vec3<f32>, d_normal: vec3<f32>, e_normal: vec3<f32>, five: bool) -> vec3<f32> {
    let a_up = ltc_is_above(a);
    let b_up = ltc_is_above(b);
    let c_up = ltc_is_above(c);
    let d_up = ltc_is_above(d);
    let e_up = ltc_is_above(e);
    if (!(a_up | b_up | c_up | d_up | e_up)) {
        return vec3<f32>(0.0);
    }
    let a_inverse = inverseSqrt(max(dot(a, a), LTC_TINY));
    let b_inverse = inverseSqrt(max(dot(b, b), LTC_TINY));
    let c_inverse = inverseSqrt(max(dot(c, c), LTC_TINY));
    let d_inverse = inverseSqrt(max(dot(d, d), LTC_TINY));
    let e_inverse = inverseSqrt(max(dot(e, e), LTC_TINY));
    let a_unit = a * a_inverse;
    let b_unit = b * b_inverse;
    let c_unit = c * c_inverse;
    let d_unit = d * d_inverse;
    let e_unit = e * e_inverse;
    if (a_up & b_up & c_up & d_up & e_up) {
        var edges = ltc_edge(a_unit, b_unit, a_normal, a_inverse * b_inverse) + ltc_edge(b_unit, c_unit, b_normal, b_inverse * c_inverse)
            + ltc_edge(c_unit, d_unit, c_normal, c_inverse * d_inverse) + ltc_edge(e_unit, a_unit, e_normal, e_inverse * a_inverse);
        if (five) {
            edges += ltc_edge(d_unit, e_unit, d_normal, d_inverse * e_inverse);
        }
        return -edges;
    }
    // A convex polygon leaves the upper side once and comes back once.
    let leave_b = b_up & !c_up;
    let leave_c = c_up & !d_up;
    let leave_d = d_up & !e_up;
    let leave_e = e_up & !a_up;
    let leave_from = select(select(select(select(a, b, leave_b), c, leave_c), d, leave_d), e, leave_e);
    let leave_to = select(select(select(select(b, c, leave_b), d, leave_c), e, leave_d), a, leave_e);
    let leave_normal = select(select(select(select(a_normal, b_normal, leave_b), c_normal, leave_c), d_normal, leave_d), e_normal, leave_e);
    let enter_b = b_up & !a_up;
    let enter_c = c_up & !b_up;
    let enter_d = d_up & !c_up;
    let enter_e = e_up & !d_up;
    let enter_to = select(select(select(select(a, b, enter_b), c, enter_c), d, enter_d), e, enter_e);
    let enter_from = select(select(select(select(e, a, enter_b), b, enter_c), c, enter_d), d, enter_e);
    let enter_normal = select(select(select(select(e_normal, a_normal, enter_b), b_normal, enter_c), c_normal, enter_d), d_normal, enter_e);
    let leave_point = ltc_crossing(leave_from, leave_to, leave_normal);
    let enter_point = ltc_crossing(enter_to, enter_from, -enter_normal);
    let leave = leave_point * inverseSqrt(max(dot(leave_point, leave_point), LTC_TINY));
    let enter = enter_point * inverseSqrt(max(dot(enter_point, enter_point), LTC_TINY));
    // Each edge runs between what is left of its ends; an edge below is left with one point.
    let a_end = select(select(enter, leave, e_up), a_unit, a_up);
    let b_end = select(select(enter, leave, a_up), b_unit, b_up);
    let c_end = select(select(enter, leave, b_up), c_unit, c_up);
    let d_end = select(select(enter, leave, c_up), d_unit, d_up);
    let e_end = select(select(enter, leave, d_up), e_unit, e_up);
    let a_start = select(enter, a_unit, a_up);
    let b_start = select(enter, b_unit, b_up);
    let c_start = select(enter, c_unit, c_up);
    let d_start = select(enter, d_unit, d_up);
    let e_start = select(enter, e_unit, e_up);
    let horizon = ltc_edge_part(leave, enter, ltc_edge_normal(leave_point, enter_point, enter_point - leave_point));
    return -(ltc_edge_part(a_start, b_end, a_normal) + ltc_edge_part(b_start, c_end, b_normal) + ltc_edge_part(c_start, d_end, c_normal)
        + ltc_edge_part(d_start, e_end, d_normal) + ltc_edge_part(e_start, a_end, e_normal) + horizon);
}

/// Vector form factor, times 2 pi and signed, of a pentagon above the horizon from one point `origin`
/// on or near it and the offsets of its vertices from there, all much shorter than the distance; `five` tells
/// whether `d` and `e` differ.
fn ltc_far_pentagon(origin: vec3<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, e: vec3<f32>, five: bool) -> vec3<f32> {
    let reference = origin * inverseSqrt(max(dot(origin, origin), LTC_TINY));
    let a_offset = ltc_far_offset(origin, reference, a);
    let b_offset = ltc_far_offset(origin, reference, b);
    let c_offset = ltc_far_offset(origin, reference, c);
    let d_offset = ltc_far_offset(origin, reference, d);
    var e_offset = d_offset;
    var fifth_excess = vec3<f32>(0.0);
    if (five) {
        e_offset = ltc_far_offset(origin, reference, e);
        fifth_excess = ltc_edge_excess(reference + d_offset, e_offset - d_offset);
    }
    // The sum of ltc_edge_near over the edges, with what is linear in the reference taken out of it.
    let a_squared = dot(a_offset, a_offset);
    let b_squared = dot(b_offset, b_offset);
    let c_squared = dot(c_offset, c_offset);
    let d_squared = dot(d_offset, d_offset);
    let e_squared = dot(e_offset, e_offset);
    let area = cross(a_offset, b_offset) + cross(b_offset, c_offset) + cross(c_offset, d_offset) + cross(d_offset, e_offset)
        + cross(e_offset, a_offset);
    let across = a_offset * (b_squared - e_squared) + b_offset * (c_squared - a_squared) + c_offset * (d_squared - b_squared)
        + d_offset * (e_squared - c_squared) + e_offset * (a_squared - d_squared);
    let excess = ltc_edge_excess(reference + a_offset, b_offset - a_offset) + ltc_edge_excess(reference + b_offset, c_offset - b_offset)
        + ltc_edge_excess(reference + c_offset, d_offset - c_offset) + fifth_excess
        + ltc_edge_excess(reference + e_offset, a_offset - e_offset);
    return -(reference * dot(reference, area) + cross(reference, 0.5 * across) + excess);
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
fn ltc_quad(surface: LtcSurface, lobe: LtcLobe, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, two_sided: bool) -> vec3<f32> {
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
    let front = dot(cross(side_c, side_d - side_b), p_a) < 0.0;
    if (!(front | two_sided)) {
        return vec3<f32>(0.0);
    }

    // What is cut at the horizon: the vertices of a near light, the offsets of a distant one's from its
    // first vertex, with the heights of the vertices over the surface.
    let size_squared = max(max(dot(side_b, side_b), dot(side_c, side_c)), dot(side_d, side_d));
    let distant = size_squared < 0.0625 * dot(p_a, p_a);
    let p_b = select(b_full * scale, side_b, distant);
    let p_c = select(c_full * scale, side_c, distant);
    let p_d = select(d_full * scale, side_d, distant);
    let a_height = dot(surface.normal, p_a);
    let base_height = select(0.0, a_height, distant);
    let heights = vec4<f32>(a_height, base_height + dot(surface.normal, p_b), base_height + dot(surface.normal, p_c),
        base_height + dot(surface.normal, p_d));
    let a_up = heights.x > 0.0;
    let b_up = heights.y > 0.0;
    let c_up = heights.z > 0.0;
    let d_up = heights.w > 0.0;
    if (!(a_up | b_up | c_up | d_up)) {
        return vec3<f32>(0.0);
    }
    let first = select(p_a, vec3<f32>(0.0), distant);
    var v_a = first;
    var v_b = p_b;
    var v_c = p_c;
    var v_d = p_d;
    var v_e = p_d;
    let clipped = !(a_up & b_up & c_up & d_up);
    if (clipped) {
        // Turn the quad until its last vertex is the last one below; the quad cut at the surface is
        // then the pentagon of the first three vertices, the exit and the entry.
        let last_a = b_up & !a_up;
        let last_b = c_up & !b_up;
        let last_c = d_up & !c_up;
        let half_turn = last_b | last_c;
        let turn = last_a | last_c;
        let half_a = select(first, p_c, half_turn);
        let half_b = select(p_b, p_d, half_turn);
        let half_c = select(p_c, first, half_turn);
        let half_d = select(p_d, p_b, half_turn);
        let half_heights = select(heights, heights.zwxy, half_turn);
        let q_a = select(half_a, half_b, turn);
        let q_b = select(half_b, half_c, turn);
        let q_c = select(half_c, half_d, turn);
        let q_d = select(half_d, half_a, turn);
        let h = select(half_heights, half_heights.yzwx, turn);
        let up_b = h.y > 0.0;
        let up_c = h.z > 0.0;
        let leave_from = select(select(q_a, q_b, up_b), q_c, up_c);
        let leave_to = select(select(q_b, q_c, up_b), q_d, up_c);
        let leave_high = select(select(h.x, h.y, up_b), h.z, up_c);
        let leave_low = select(select(h.y, h.z, up_b), h.w, up_c);
        let leave = leave_from + (leave_to - leave_from) * (leave_high / max(leave_high - leave_low, LTC_TINY));
        v_a = q_a;
        v_b = select(leave, q_b, up_b);
        v_c = select(leave, q_c, up_c);
        v_d = leave;
        v_e = q_a + (q_d - q_a) * (h.x / max(h.x - h.w, LTC_TINY));
    }

    // Cross products of neighbouring vertices, from the edges' own vectors.
    let base = select(vec3<f32>(0.0), p_a, distant);
    let a_normal = ltc_edge_normal(base + v_a, base + v_b, v_b - v_a);
    let b_normal = ltc_edge_normal(base + v_b, base + v_c, v_c - v_b);
    let c_normal = ltc_edge_normal(base + v_c, base + v_d, v_d - v_c);
    // The edge from exit to entry lies on the horizon, whatever rounding says of its normal.
    let d_normal = surface.normal * dot(surface.normal, ltc_edge_normal(base + v_d, base + v_e, v_e - v_d));
    let e_normal = ltc_edge_normal(base + v_e, base + v_a, v_a - v_e);
    let l_a = ltc_transform(lobe, v_a);
    let l_b = ltc_transform(lobe, v_b);
    let l_c = ltc_transform(lobe, v_c);
    let l_d = ltc_transform(lobe, v_d);
    let l_e = ltc_transform(lobe, v_e);
    let l_base = ltc_transform(lobe, base);
    let m_a = ltc_transform_normal(lobe, a_normal);
    let m_b = ltc_transform_normal(lobe, b_normal);
    let m_c = ltc_transform_normal(lobe, c_normal);
    let m_d = ltc_transform_normal(lobe, d_normal);
    let m_e = ltc_transform_normal(lobe, e_normal);
    let lowest = l_base.z + min(min(min(l_a.z, l_b.z), min(l_c.z, l_d.z)), l_e.z);
    var sum: f32;
    if (distant) {
        sum = dot(surface.normal, ltc_far_pentagon(p_a, v_a, v_b, v_c, v_d, v_e, clipped));
    } else {
        let a_inverse = inverseSqrt(max(dot(v_a, v_a), LTC_TINY));
        let b_inverse = inverseSqrt(max(dot(v_b, v_b), LTC_TINY));
        let c_inverse = inverseSqrt(max(dot(v_c, v_c), LTC_TINY));
        let d_inverse = inverseSqrt(max(dot(v_d, v_d), LTC_TINY));
        let e_inverse = inverseSqrt(max(dot(v_e, v_e), LTC_TINY));
        let a_unit = v_a * a_inverse;
        let b_unit = v_b * b_inverse;
        let c_unit = v_c * c_inverse;
        let d_unit = v_d * d_inverse;
        let e_unit = v_e * e_inverse;
        var edges = ltc_edge(a_unit, b_unit, a_normal, a_inverse * b_inverse) + ltc_edge(b_unit, c_unit, b_normal, b_inverse * c_inverse)
            + ltc_edge(c_unit, d_unit, c_normal, c_inverse * d_inverse) + ltc_edge(e_unit, a_unit, e_normal, e_inverse * a_inverse);
        if (clipped) {
            edges += ltc_edge(d_unit, e_unit, d_normal, d_inverse * e_inverse);
        }
        sum = -dot(surface.normal, edges);
    }
    var lobe_sum: vec3<f32>;
    // The lobe's space stretches: there a distant light may be near.
    let lobe_size = max(max(max(dot(l_a, l_a), dot(l_b, l_b)), max(dot(l_c, l_c), dot(l_d, l_d))), dot(l_e, l_e));
    if (distant & (lowest > 0.0) & (lobe_size < 0.0625 * dot(l_base, l_base))) {
        lobe_sum = ltc_far_pentagon(l_base, l_a, l_b, l_c, l_d, l_e, clipped);
    } else {
        lobe_sum = ltc_pentagon(l_base + l_a, l_base + l_b, l_base + l_c, l_base + l_d, l_base + l_e, m_a, m_b, m_c, m_d, m_e, clipped);
    }
    return ltc_value(surface, lobe, sum * LTC_OVER_TWO_PI, lobe_sum * LTC_OVER_TWO_PI, front, two_sided);
}

// ---------------------------------------------------------------------------------------------
// Polygons of any number of vertices, convex or not
//
//     var polygon = ltc_polygon_begin(surface, first_vertex);
//     ltc_polygon_add(&polygon, surface, lobe, vertex);     // for each of the others
//     let value = ltc_polygon_end(&polygon, surface, lobe, two_sided);
//
// Nothing is stored but sums and one point on each horizon. All points where a planar polygon
// crosses a plane through the surface point lie on one straight line, so the pieces of the horizon
// that close the cut polygon can all be measured from the first such point: forth to each point of
// entry, back from each point of exit.
// ---------------------------------------------------------------------------------------------

/// Starts a polygon at its first vertex.
fn ltc_polygon_begin(surface: LtcSurface, corner: vec3<f32>) -> LtcPolygon {
    let to_first = (corner * LTC_HEADROOM) - (surface.position * LTC_HEADROOM);
    var polygon: LtcPolygon;
    polygon.first = corner;
    polygon.scale = 1.0 / max(ltc_extent(to_first), LTC_TINY);
    polygon.previous = corner;
    polygon.facing = 0.0;
    polygon.surface_crossing = vec3<f32>(0.0);
    polygon.surface_crossed = 0.0;
    polygon.surface_crossing_offset = vec3<f32>(0.0);
    polygon.diffuse = 0.0;
    polygon.lobe_crossing = vec3<f32>(0.0);
    polygon.lobe_crossed = 0.0;
    polygon.lobe_crossing_offset = vec3<f32>(0.0);
    polygon.lobe_sum = vec3<f32>(0.0);
    return polygon;
}

/// Adds the next vertex.
fn ltc_polygon_add(polygon: ptr<function, LtcPolygon>, surface: LtcSurface, lobe: LtcLobe, corner: vec3<f32>) {
    let origin = surface.position * LTC_HEADROOM;
    let first_far = (*polygon).first * LTC_HEADROOM;
    let a_far = (*polygon).previous * LTC_HEADROOM;
    let b_far = corner * LTC_HEADROOM;
    // Lengths in units of the distance to the first vertex, but below 1e12 of anything.
    let extent = max(ltc_extent(a_far - origin), ltc_extent(b_far - origin));
    let scale = min((*polygon).scale, 1e12 / max(extent, 1e-25));
    let reference = (first_far - origin) * scale;
    let a = (a_far - origin) * scale;
    let b = (b_far - origin) * scale;
    let a_offset = (a_far - first_far) * scale;
    let b_offset = (b_far - first_far) * scale;
    (*polygon).facing += dot(cross(a_offset, b_offset), reference);
    (*polygon).previous = corner;

    // Heights of a distant light from that of the first vertex and the rise from there.
    let height = dot(surface.normal, reference);
    let near = max(dot(a_offset, a_offset), dot(b_offset, b_offset)) < 0.0625 * dot(reference, reference);
    let a_height = select(dot(surface.normal, a), height + dot(surface.normal, a_offset), near);
    let b_height = select(dot(surface.normal, b), height + dot(surface.normal, b_offset), near);
    let a_up = a_height > 0.0;
    let b_up = b_height > 0.0;
    if (!(a_up | b_up)) {
        return;
    }
    // What is left of the edge, added at one place: compilers copy a function to each of its calls.
    var start = a;
    var start_offset = a_offset;
    var end = b;
    var end_offset = b_offset;
    if (!(a_up & b_up)) {
        let above = select(b, a, a_up);
        let below = select(a, b, a_up);
        let above_offset = select(b_offset, a_offset, a_up);
        let below_offset = select(a_offset, b_offset, a_up);
        let high = max(a_height, b_height);
        let t = high / max(high - min(a_height, b_height), LTC_TINY);
        let crossing = above + (below - above) * t;
        let crossing_offset = above_offset + (below_offset - above_offset) * t;
        if ((*polygon).surface_crossed > 0.0) {
            let base = (*polygon).surface_crossing;
            let base_offset = (*polygon).surface_crossing_offset;
            ltc_polygon_edge(polygon, surface, lobe, reference, select(base, crossing, a_up), select(base_offset, crossing_offset, a_up),
                select(crossing, base, a_up), select(crossing_offset, base_offset, a_up), true);
        } else {
            (*polygon).surface_crossed = 1.0;
            (*polygon).surface_crossing = crossing;
            (*polygon).surface_crossing_offset = crossing_offset;
        }
        start = select(crossing, a, a_up);
        start_offset = select(crossing_offset, a_offset, a_up);
        end = select(b, crossing, a_up);
        end_offset = select(b_offset, crossing_offset, a_up);
    }
    ltc_polygon_edge(polygon, surface, lobe, reference, start, start_offset, end, end_offset, false);
}

/// The value (diffuse, specular, fresnel) of the polygon whose vertices have all been added. Its
/// error is that of ltc_quad, and grows with the root of the number of vertices.
fn ltc_polygon_end(polygon: ptr<function, LtcPolygon>, surface: LtcSurface, lobe: LtcLobe, two_sided: bool) -> vec3<f32> {
    let first = (*polygon).first;
    ltc_polygon_add(polygon, surface, lobe, first);
    let front = (*polygon).facing < 0.0;
    return ltc_value(surface, lobe, (*polygon).diffuse * LTC_OVER_TWO_PI, (*polygon).lobe_sum * LTC_OVER_TWO_PI, front, two_sided);
}

/// Adds one edge that lies above the surface, or with `closing` on its horizon, to both integrals.
fn ltc_polygon_edge(polygon: ptr<function, LtcPolygon>, surface: LtcSurface, lobe: LtcLobe, reference: vec3<f32>, a: vec3<f32>, a_offset: vec3<f32>, b: vec3<f32>, b_offset: vec3<f32>, closing: bool) {
    let product = ltc_edge_normal(a, b, b_offset - a_offset);
    // An edge on the horizon has the surface's normal, whatever rounding says of its own.
    let normal = select(product, surface.normal * dot(surface.normal, product), closing);
    (*polygon).diffuse -= dot(surface.normal, ltc_edge_from(reference, a, a_offset, b, b_offset, normal));

    let m = ltc_transform(lobe, reference);
    let m_a = ltc_transform(lobe, a);
    let m_b = ltc_transform(lobe, b);
    let m_a_offset = ltc_transform(lobe, a_offset);
    let m_b_offset = ltc_transform(lobe, b_offset);
    let m_normal = ltc_transform_normal(lobe, normal);
    let a_up = ltc_is_above(m_a);
    let b_up = ltc_is_above(m_b);
    if (!(a_up | b_up)) {
        return;
    }
    var start = m_a;
    var start_offset = m_a_offset;
    var end = m_b;
    var end_offset = m_b_offset;
    if (!(a_up & b_up)) {
        let above = select(m_b, m_a, a_up);
        let below = select(m_a, m_b, a_up);
        let above_offset = select(m_b_offset, m_a_offset, a_up);
        let below_offset = select(m_a_offset, m_b_offset, a_up);
        let t = max(above.z, 0.0) / max(above.z - below.z, LTC_TINY);
        let crossing = ltc_crossing(above, below, select(-m_normal, m_normal, a_up));
        let crossing_offset = above_offset + (below_offset - above_offset) * t;
        if ((*polygon).lobe_crossed > 0.0) {
            let base = (*polygon).lobe_crossing;
            let base_offset = (*polygon).lobe_crossing_offset;
            let horizon_start = select(base, crossing, a_up);
            let horizon_end = select(crossing, base, a_up);
            (*polygon).lobe_sum -= ltc_edge_from(m, horizon_start, select(base_offset, crossing_offset, a_up), horizon_end,
                select(crossing_offset, base_offset, a_up), ltc_edge_normal(horizon_start, horizon_end, horizon_end - horizon_start));
        } else {
            (*polygon).lobe_crossed = 1.0;
            (*polygon).lobe_crossing = crossing;
            (*polygon).lobe_crossing_offset = crossing_offset;
        }
        start = select(crossing, m_a, a_up);
        start_offset = select(crossing_offset, m_a_offset, a_up);
        end = select(m_b, crossing, a_up);
        end_offset = select(m_b_offset, crossing_offset, a_up);
    }
    (*polygon).lobe_sum -= ltc_edge_from(m, start, start_offset, end, end_offset, m_normal);
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
