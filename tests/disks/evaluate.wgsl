
struct DiskCase {
    position: vec3<f32>,
    roughness: f32,
    normal: vec3<f32>,
    /// Radius of a sphere.
    radius: f32,
    view: vec3<f32>,
    /// 0: one-sided disk; 1: two-sided disk; 2: sphere.
    kind: f32,
    center: vec3<f32>,
    spare_a: f32,
    half_x: vec3<f32>,
    spare_b: f32,
    half_y: vec3<f32>,
    spare_c: f32,
}

@group(0) @binding(0) var<storage, read> cases: array<DiskCase>;
@group(0) @binding(1) var<storage, read_write> values: array<vec4<f32>>;
@group(0) @binding(2) var table: texture_2d_array<f32>;
@group(0) @binding(3) var table_sampler: sampler;

@compute @workgroup_size(64)
fn evaluate_disks(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if (index >= arrayLength(&cases)) {
        return;
    }
    let it = cases[index];
    let surface = ltc_surface(it.position, it.normal, it.view, it.roughness);
    let lobes = ltc_lobes_from_table(surface, table, table_sampler, f32(textureDimensions(table).x), 0);
    var value: vec3<f32>;
    if (it.kind > 1.5) {
        value = ltc_sphere(surface, lobes, it.center, it.radius);
    } else {
        value = ltc_disk(surface, lobes, it.center, it.half_x, it.half_y, it.kind > 0.5);
    }
    values[index] = vec4<f32>(value, 0.0);
}
