// A quality level of the include; which, its switches say.

fn method_value(position: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, roughness: f32, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> vec3<f32> {
    let surface = ltc_surface(position, normal, view, roughness);
    let lobes = ltc_lobes_from_table(surface, table, table_sampler, 64.0, 0);
    return ltc_quad(surface, lobes, a, b, c, d, false);
}
