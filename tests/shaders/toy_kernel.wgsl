
@group(0) @binding(0) var<storage, read> kinds: array<u32>;
@group(0) @binding(1) var<storage, read_write> values: array<f32>;

@compute @workgroup_size(64)
fn evaluate(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let kind = kinds[invocation.x];
    values[invocation.x] = ltc_surface(vec3<f32>(invocation), kind, (kind & 4u) != 0u);
}
