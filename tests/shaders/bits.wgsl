// The value of a light for inputs of any bits; the test writes them.

struct BitsCase {
    position: vec3<f32>,
    roughness: f32,
    normal: vec3<f32>,
    radius: f32,
    view: vec3<f32>,
    kind: u32,
    a: vec3<f32>,
    flag: u32,
    b: vec3<f32>,
    spare_a: f32,
    c: vec3<f32>,
    spare_b: f32,
    d: vec3<f32>,
    spare_c: f32,
}

@group(0) @binding(0) var<storage, read> inputs: array<BitsCase>;
// For each input (diffuse, specular, fresnel, albedo), then a look-up of a picture: (place, apart) and the level.
@group(0) @binding(1) var<storage, read_write> values: array<vec4<f32>>;
@group(0) @binding(2) var table: texture_2d_array<f32>;
@group(0) @binding(3) var table_sampler: sampler;

@compute @workgroup_size(64)
fn bits(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if (index >= arrayLength(&inputs)) {
        return;
    }
    let at = inputs[index];
    let flag = at.flag != 0u;
    let surface = ltc_surface(at.position, at.normal, at.view, at.roughness);
    let lobes = ltc_lobes_from_table(surface, table, table_sampler, f32(textureDimensions(table).x), 0);
    var albedo = lobes.first.albedo;
    if (lobes.count > 1) {
        albedo += lobes.second.albedo;
    }
    if (lobes.count > 2) {
        albedo += lobes.third.albedo;
    }
    var value: vec3<f32>;
    var lookup: LtcLookup;
    switch at.kind {
        case 0u: {
            value = ltc_quad(surface, lobes, at.a, at.b, at.c, at.d, flag);
            let quad = ltc_quad_begin(surface, at.a, at.b, at.c, at.d, flag);
            let size = vec2<f32>(256.0, 128.0);
            lookup = ltc_rectangle_lookup(surface, lobes.first, at.a, at.b, at.d, ltc_quad_lobe(quad, lobes.first), size, flag);
        }
        case 1u: {
            value = ltc_disk(surface, lobes, at.a, at.b, at.c, flag);
        }
        case 2u: {
            value = ltc_sphere(surface, lobes, at.a, at.radius);
        }
        case 3u: {
            value = ltc_tube(surface, lobes, at.a, at.b, at.radius, flag);
        }
        default: {
            var polygon = ltc_polygon_begin(surface, at.a);
            ltc_polygon_add(&polygon, surface, lobes, at.b);
            ltc_polygon_add(&polygon, surface, lobes, at.c);
            ltc_polygon_add(&polygon, surface, lobes, at.d);
            value = ltc_polygon_end(&polygon, surface, lobes, flag);
        }
    }
    values[3u * index] = vec4<f32>(value, albedo);
    values[3u * index + 1u] = vec4<f32>(lookup.place, lookup.apart);
    values[3u * index + 2u] = vec4<f32>(lookup.level, 0.0, 0.0, 0.0);
}
