// Evaluates a quad on a surface in each invocation, by the function `method_value` of the text that this is appended to.

/// A surface point.
struct CompareSurface {
    position: vec3<f32>,
    /// Perceptual roughness, 0 to 1.
    roughness: f32,
    /// Unit vector.
    normal: vec3<f32>,
    spare_a: f32,
    /// Unit vector to the eye.
    view: vec3<f32>,
    spare_b: f32,
}

/// The vertices of a light, counter-clockwise seen from where it emits to.
struct CompareQuad {
    a: vec4<f32>,
    b: vec4<f32>,
    c: vec4<f32>,
    d: vec4<f32>,
}

@group(0) @binding(0) var<storage, read> surfaces: array<CompareSurface>;
@group(0) @binding(1) var<storage, read> quads: array<CompareQuad>;
/// Diffuse, specular and fresnel value, and 0.
@group(0) @binding(2) var<storage, read_write> results: array<vec4<f32>>;
@group(0) @binding(3) var table: texture_2d_array<f32>;
@group(0) @binding(4) var table_sampler: sampler;

@compute @workgroup_size(64)
fn compare_quads(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if (index >= arrayLength(&results)) {
        return;
    }
    let at = surfaces[index];
    let light = quads[index];
    let value = method_value(at.position, at.normal, at.view, at.roughness, light.a.xyz, light.b.xyz, light.c.xyz, light.d.xyz);
    results[index] = vec4<f32>(value, 0.0);
}
