// Evaluates pairs of surfaces and lights from storage buffers. Appended to ltc.wgsl.
//
// One invocation evaluates one pair; dispatch (number of pairs + 63) / 64 workgroups.

/// A surface point.
struct EvaluateSurface {
    position: vec3<f32>,
    /// Perceptual roughness, 0 to 1.
    roughness: f32,
    normal: vec3<f32>,
    spare_a: f32,
    /// Towards the eye.
    view: vec3<f32>,
    spare_b: f32,
}

/// A light: `count` vectors from `first` on.
struct EvaluateLight {
    first: u32,
    count: u32,
    /// Sum of EVALUATE_TWO_SIDED, EVALUATE_CONVEX_QUAD and EVALUATE_CAPS, where they apply.
    flags: u32,
    /// EVALUATE_POLYGON, EVALUATE_DISK, EVALUATE_SPHERE or EVALUATE_TUBE.
    kind: u32,
}

const EVALUATE_TWO_SIDED: u32 = 1u;
/// The light has four vertices and is convex.
const EVALUATE_CONVEX_QUAD: u32 = 2u;
const EVALUATE_CAPS: u32 = 4u;
/// A light's vectors are its vertices.
const EVALUATE_POLYGON: u32 = 0u;
/// They are its centre and its half-axes.
const EVALUATE_DISK: u32 = 1u;
/// They are its centre, with the radius.
const EVALUATE_SPHERE: u32 = 2u;
/// They are its ends, the first with the radius.
const EVALUATE_TUBE: u32 = 3u;

@group(0) @binding(0) var<storage, read> surfaces: array<EvaluateSurface>;
@group(0) @binding(1) var<storage, read> lights: array<EvaluateLight>;
@group(0) @binding(2) var<storage, read> vertices: array<vec4<f32>>;
/// Indices of a surface and a light.
@group(0) @binding(3) var<storage, read> pairs: array<vec2<u32>>;
/// Diffuse, specular and fresnel value of each pair, and 0.
@group(0) @binding(4) var<storage, read_write> values: array<vec4<f32>>;
@group(0) @binding(5) var table: texture_2d_array<f32>;
@group(0) @binding(6) var table_sampler: sampler;

@compute @workgroup_size(64)
fn evaluate(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if (index >= arrayLength(&pairs)) {
        return;
    }
    let pair = pairs[index];
    let point = surfaces[pair.x];
    let light = lights[pair.y];
    let two_sided = (light.flags & EVALUATE_TWO_SIDED) != 0u;
    let surface = ltc_surface(point.position, point.normal, point.view, point.roughness);
    var lobes: LtcLobes;
    if (ltc_use_ggx) {
        let table_size = f32(textureDimensions(table).x);
        lobes = ltc_lobes_from_table(surface, table, table_sampler, table_size, 0);
    }
    let first = light.first;
    let a = vertices[first];
    var value: vec3<f32>;
    if (ltc_use_disk & (light.kind == EVALUATE_DISK)) {
        value = ltc_disk(surface, lobes, a.xyz, vertices[first + 1u].xyz, vertices[first + 2u].xyz, two_sided);
    } else if (ltc_use_sphere & (light.kind == EVALUATE_SPHERE)) {
        value = ltc_sphere(surface, lobes, a.xyz, a.w);
    } else if (ltc_use_tube & (light.kind == EVALUATE_TUBE)) {
        value = ltc_tube(surface, lobes, a.xyz, vertices[first + 1u].xyz, a.w, (light.flags & EVALUATE_CAPS) != 0u);
    } else if (ltc_use_quad & ((light.flags & EVALUATE_CONVEX_QUAD) != 0u)) {
        value = ltc_quad(surface, lobes, a.xyz, vertices[first + 1u].xyz, vertices[first + 2u].xyz, vertices[first + 3u].xyz, two_sided);
    } else if (ltc_use_polygon) {
        var polygon = ltc_polygon_begin(surface, a.xyz);
        for (var i = 1u; i < light.count; i++) {
            ltc_polygon_add(&polygon, surface, lobes, vertices[first + i].xyz);
        }
        value = ltc_polygon_end(&polygon, surface, lobes, two_sided);
    }
    values[index] = vec4<f32>(value, 0.0);
}
