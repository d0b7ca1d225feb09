// Radiance that whole surfaces reflect of one light each; the test writes the inputs.

struct WholeCase {
    position: vec3<f32>,
    roughness: f32,
    normal: vec3<f32>,
    diffuse_roughness: f32,
    view: vec3<f32>,
    coat: f32,
    base_colour: vec3<f32>,
    sheen_roughness: f32,
    normal_reflectance: vec3<f32>,
    anisotropy: f32,
    sheen_colour: vec3<f32>,
    coat_roughness: f32,
    grain: vec3<f32>,
    radius: f32,
    a: vec3<f32>,
    kind: u32,
    b: vec3<f32>,
    flag: u32,
    c: vec3<f32>,
    spare_a: u32,
    d: vec3<f32>,
    spare_b: u32,
}

@group(0) @binding(0) var<storage, read> inputs: array<WholeCase>;
@group(0) @binding(1) var<storage, read_write> values: array<vec4<f32>>;
@group(0) @binding(2) var table: texture_2d_array<f32>;
@group(0) @binding(3) var table_sampler: sampler;

@compute @workgroup_size(64)
fn whole(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if (index >= arrayLength(&inputs)) {
        return;
    }
    let at = inputs[index];
    var material = ltc_material(at.base_colour, at.roughness, at.normal_reflectance);
    material.diffuse_roughness = at.diffuse_roughness;
    material.coat = at.coat;
    material.coat_roughness = at.coat_roughness;
    material.sheen_colour = at.sheen_colour;
    material.sheen_roughness = at.sheen_roughness;
    material.grain = at.grain;
    material.anisotropy = at.anisotropy;
    var layers: LtcLayers;
    layers.lobes = 6;
    layers.sheen = 2;
    layers.diffuse = 3;
    layers.anisotropic = 4;
    let shading = ltc_shading(at.position, at.normal, at.view, material, layers, table, table_sampler, 64.0);
    let flag = at.flag != 0u;
    var received: LtcReceived;
    if (ltc_use_quad & (at.kind == 0u)) {
        received = ltc_shading_quad(shading, at.a, at.b, at.c, at.d, flag);
    } else if (ltc_use_disk & (at.kind == 1u)) {
        received = ltc_shading_disk(shading, at.a, at.b, at.c, flag);
    } else if (ltc_use_sphere & (at.kind == 2u)) {
        received = ltc_shading_sphere(shading, at.a, at.radius);
    } else if (ltc_use_tube & (at.kind == 3u)) {
        received = ltc_shading_tube(shading, at.a, at.b, at.radius, flag);
    } else if (ltc_use_polygon & (at.kind == 4u)) {
        var polygon = ltc_shading_polygon_begin(shading, at.a);
        ltc_shading_polygon_add(&polygon, shading, at.b);
        ltc_shading_polygon_add(&polygon, shading, at.c);
        ltc_shading_polygon_add(&polygon, shading, at.d);
        received = ltc_shading_polygon_end(&polygon, shading, flag);
    }
    values[index] = vec4<f32>(ltc_reflected(shading, material, received), received.diffuse);
}
