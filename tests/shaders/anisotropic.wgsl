// Light of a quad on anisotropic surfaces, by the corrected lobe and by the stretched one. Appended to ltc.wgsl.

struct Point {
    normal: vec3<f32>,
    alpha_x: f32,
    view: vec3<f32>,
    alpha_y: f32,
    tangent: vec3<f32>,
    spare: f32,
    a: vec4<f32>,
    b: vec4<f32>,
    c: vec4<f32>,
    d: vec4<f32>,
}

@group(0) @binding(0) var<storage, read> points: array<Point>;
@group(0) @binding(1) var<storage, read_write> values: array<vec4<f32>>;
@group(0) @binding(2) var table: texture_2d_array<f32>;
@group(0) @binding(3) var table_sampler: sampler;

@compute @workgroup_size(64)
fn evaluate(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if (index >= arrayLength(&points)) {
        return;
    }
    let point = points[index];
    let surface = ltc_surface(vec3<f32>(0.0), point.normal, point.view, 0.5);
    let anisotropy = ltc_anisotropy(surface, point.tangent, point.alpha_x, point.alpha_y);
    let corrected = ltc_anisotropic_lobe_from_table(surface, anisotropy, table, table_sampler, 64.0, 2);
    let stretched = ltc_stretched_lobe_from_table(surface, anisotropy, table, table_sampler, 64.0);
    let first = ltc_quad(surface, ltc_lobes_of(surface, corrected), point.a.xyz, point.b.xyz, point.c.xyz, point.d.xyz, false);
    let second = ltc_quad(surface, ltc_lobes_of(surface, stretched), point.a.xyz, point.b.xyz, point.c.xyz, point.d.xyz, false);
    values[2u * index] = vec4<f32>(first, corrected.albedo);
    values[2u * index + 1u] = vec4<f32>(second, stretched.albedo);
}
