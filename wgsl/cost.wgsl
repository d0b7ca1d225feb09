// Shades one surface point by point lights and area lights: what an engine's shader does, to measure what
// the include adds to it. Appended to ltc.wgsl.

/// A surface point.
struct CostSurface {
    position: vec3<f32>,
    /// Perceptual roughness, 0 to 1.
    roughness: f32,
    normal: vec3<f32>,
    spare_a: f32,
    /// Towards the eye.
    view: vec3<f32>,
    spare_b: f32,
    base_colour: vec3<f32>,
    coat_roughness: f32,
    sheen_colour: vec3<f32>,
    sheen_roughness: f32,
    grain: vec3<f32>,
    anisotropy: f32,
}

/// A light without extent.
struct CostPoint {
    position: vec3<f32>,
    spare: f32,
    intensity: vec3<f32>,
    spare_b: f32,
}

/// An area light: `count` vectors from `first` on.
struct CostLight {
    radiance: vec3<f32>,
    /// One of the kinds below.
    kind: u32,
    first: u32,
    count: u32,
    two_sided: u32,
    caps: u32,
}

const COST_QUAD: u32 = 0u;
const COST_POLYGON: u32 = 1u;
const COST_DISK: u32 = 2u;
const COST_SPHERE: u32 = 3u;
const COST_TUBE: u32 = 4u;
const COST_PICTURE: u32 = 5u;

@group(0) @binding(0) var<storage, read> surfaces: array<CostSurface>;
@group(0) @binding(1) var<storage, read> points: array<CostPoint>;
@group(0) @binding(2) var<storage, read> lights: array<CostLight>;
/// The fourth number of a light's first vector is its radius.
@group(0) @binding(3) var<storage, read> vertices: array<vec4<f32>>;
/// Reflected radiance, and 0.
@group(0) @binding(4) var<storage, read_write> reflected: array<vec4<f32>>;
@group(0) @binding(5) var table: texture_2d_array<f32>;
@group(0) @binding(6) var table_sampler: sampler;
@group(0) @binding(7) var picture: texture_2d<f32>;

@compute @workgroup_size(64)
fn cost(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if (index >= arrayLength(&surfaces)) {
        return;
    }
    let at = surfaces[index];
    var radiance = vec3<f32>(0.0);
    for (var i = 0u; i < arrayLength(&points); i++) {
        let away = points[i].position - at.position;
        let squared = max(dot(away, away), 1e-6);
        let cosine = max(dot(at.normal, away) * inverseSqrt(squared), 0.0);
        radiance += at.base_colour * points[i].intensity * (cosine / squared);
    }
    // From here on area lights.
    if (ltc_use_quad | ltc_use_polygon | ltc_use_disk | ltc_use_sphere | ltc_use_tube) {
        var material = ltc_material(at.base_colour, at.roughness, vec3<f32>(0.04));
        material.coat = at.spare_a;
        material.coat_roughness = at.coat_roughness;
        material.sheen_colour = at.sheen_colour;
        material.sheen_roughness = at.sheen_roughness;
        material.diffuse_roughness = at.spare_b;
        material.grain = at.grain;
        material.anisotropy = at.anisotropy;
        var layers: LtcLayers;
        layers.lobes = 6;
        layers.sheen = 2;
        layers.diffuse = 3;
        layers.anisotropic = 4;
        let shading = ltc_shading(at.position, at.normal, at.view, material, layers, table, table_sampler, 64.0);
        for (var i = 0u; i < arrayLength(&lights); i++) {
            let light = lights[i];
            let first = light.first;
            let two_sided = light.two_sided != 0u;
            let a = vertices[first];
            var received: LtcReceived;
            if (ltc_use_quad & (light.kind == COST_QUAD)) {
                received = ltc_shading_quad(shading, a.xyz, vertices[first + 1u].xyz, vertices[first + 2u].xyz, vertices[first + 3u].xyz, two_sided);
            }
            if (ltc_use_disk & (light.kind == COST_DISK)) {
                received = ltc_shading_disk(shading, a.xyz, vertices[first + 1u].xyz, vertices[first + 2u].xyz, two_sided);
            }
            if (ltc_use_sphere & (light.kind == COST_SPHERE)) {
                received = ltc_shading_sphere(shading, a.xyz, a.w);
            }
            if (ltc_use_tube & (light.kind == COST_TUBE)) {
                received = ltc_shading_tube(shading, a.xyz, vertices[first + 1u].xyz, a.w, light.caps != 0u);
            }
            if (ltc_use_polygon & (light.kind == COST_POLYGON)) {
                var polygon = ltc_shading_polygon_begin(shading, a.xyz);
                for (var j = 1u; j < light.count; j++) {
                    ltc_shading_polygon_add(&polygon, shading, vertices[first + j].xyz);
                }
                received = ltc_shading_polygon_end(&polygon, shading, two_sided);
            }
            var part = ltc_reflected(shading, material, received);
            if (ltc_use_textured & (light.kind == COST_PICTURE)) {
                part = ltc_reflected_picture(shading, material, a.xyz, vertices[first + 1u].xyz, vertices[first + 2u].xyz, vertices[first + 3u].xyz,
                    two_sided, picture, table_sampler, vec2<f32>(256.0));
            }
            radiance += light.radiance * part;
        }
    }
    reflected[index] = vec4<f32>(radiance, 0.0);
}
