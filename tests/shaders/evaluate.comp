// The evaluation kernel written by hand in GLSL around the translated include, which is inserted
// at the line that names it. TABLE_SEPARATE is defined for Vulkan, whose textures and samplers are
// bound apart.
precision highp float;
precision highp int;
precision highp sampler2DArray;
layout(local_size_x = 64) in;

//include

struct Surface { vec3 position; float roughness; vec3 normal; float spare_a; vec3 view; float spare_b; };
struct Light { uint first; uint count; uint flags; uint kind; };
layout(std430, binding = 0) readonly buffer Surfaces { Surface surfaces[]; };
layout(std430, binding = 1) readonly buffer Lights { Light lights[]; };
layout(std430, binding = 2) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 3) readonly buffer Pairs { uvec2 pairs[]; };
layout(std430, binding = 4) writeonly buffer Values { vec4 values[]; };
#ifdef TABLE_SEPARATE
layout(binding = 5) uniform highp texture2DArray table;
layout(binding = 6) uniform highp sampler table_sampler;
#else
layout(binding = 0) uniform highp sampler2DArray table;
#endif

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= uint(pairs.length())) {
        return;
    }
    Surface point = surfaces[pairs[index].x];
    Light light = lights[pairs[index].y];
    bool two_sided = (light.flags & 1u) != 0u;
    LtcSurface surface = ltc_surface(point.position, point.normal, point.view, point.roughness);
#ifdef TABLE_SEPARATE
    float table_size = float(textureSize(sampler2DArray(table, table_sampler), 0).x);
    vec2 at = ltc_table_coordinates(surface, table_size);
#define TEXEL(layer) textureLod(sampler2DArray(table, table_sampler), vec3(at, layer), 0.0)
#if LOBES == 3
    LtcLobes lobes = ltc_three_lobes(surface, TEXEL(0.0), TEXEL(1.0), TEXEL(2.0), TEXEL(3.0), TEXEL(4.0));
#elif LOBES == 2
    LtcLobes lobes = ltc_two_lobes(surface, TEXEL(0.0), TEXEL(1.0), TEXEL(2.0));
#elif defined(TABLE_FREE)
    LtcLobes lobes = ltc_lobes_of(surface, ltc_lobe_fitted(surface));
#else
    LtcLobes lobes = ltc_lobes_of(surface, ltc_lobe(surface, TEXEL(0.0), TEXEL(1.0)));
#endif
#else
    LtcLobes lobes = ltc_lobes_from_table(surface, table, float(textureSize(table, 0).x), 0);
#endif
    uint first = light.first;
    vec4 a = vertices[first];
    vec3 value;
    if (light.kind == 1u) {
        value = ltc_disk(surface, lobes, a.xyz, vertices[first + 1u].xyz, vertices[first + 2u].xyz, two_sided);
    } else if (light.kind == 2u) {
        value = ltc_sphere(surface, lobes, a.xyz, a.w);
    } else if (light.kind == 3u) {
        value = ltc_tube(surface, lobes, a.xyz, vertices[first + 1u].xyz, a.w, (light.flags & 4u) != 0u);
    } else if ((light.flags & 2u) != 0u) {
        value = ltc_quad(surface, lobes, vertices[first].xyz, vertices[first + 1u].xyz, vertices[first + 2u].xyz, vertices[first + 3u].xyz, two_sided);
    } else {
        LtcPolygon polygon = ltc_polygon_begin(surface, vertices[first].xyz);
        for (uint i = 1u; i < light.count; i++) {
            ltc_polygon_add(polygon, surface, lobes, vertices[first + i].xyz);
        }
        value = ltc_polygon_end(polygon, surface, lobes, two_sided);
    }
    values[index] = vec4(value, 0.0);
}
