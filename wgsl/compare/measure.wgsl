// Evaluates a method on a few surface points and quads over and over, to measure what it costs. Appended to a text that
// defines `method_value`.

/// A surface point.
struct CompareSurface {
    position: vec3<f32>,
    /// Perceptual roughness, 0 to 1.
    roughness: f32,
    normal: vec3<f32>,
    spare_a: f32,
    /// Towards the eye.
    view: vec3<f32>,
    spare_b: f32,
}

/// The corners of a quad.
struct CompareQuad {
    a: vec4<f32>,
    b: vec4<f32>,
    c: vec4<f32>,
    d: vec4<f32>,
}

/// As many as there are quads, a power of two.
@group(0) @binding(0) var<storage, read> surfaces: array<CompareSurface>;
@group(0) @binding(1) var<storage, read> quads: array<CompareQuad>;
/// (diffuse, specular, fresnel) and 0.
@group(0) @binding(2) var<storage, read_write> results: array<vec4<f32>>;
@group(0) @binding(3) var table: texture_2d_array<f32>;
@group(0) @binding(4) var table_sampler: sampler;

fn compare_at(index: u32) -> vec4<f32> {
    let at = index & (arrayLength(&quads) - 1u);
    let surface = surfaces[at];
    let quad = quads[at];
    return vec4<f32>(method_value(surface.position, surface.normal, surface.view, surface.roughness, quad.a.xyz, quad.b.xyz, quad.c.xyz, quad.d.xyz), 0.0);
}

@compute @workgroup_size(64)
fn compare_quads(@builtin(global_invocation_id) invocation: vec3<u32>) {
    if (invocation.x >= arrayLength(&results)) {
        return;
    }
    results[invocation.x] = compare_at(invocation.x);
}

/// The same in the stage in which most renderers shade.
@fragment
fn compare_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return compare_at(u32(position.x));
}

/// A triangle over the whole target.
@vertex
fn compare_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u));
    return vec4<f32>(corner * 2.0 - 1.0, 0.0, 1.0);
}
