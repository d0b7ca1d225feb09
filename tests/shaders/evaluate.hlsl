// The evaluation kernel written by hand in HLSL around the translated include, which is inserted
// at the line that names it.

//include

struct Surface { float3 position; float roughness; float3 normal; float spare_a; float3 view; float spare_b; };
struct Light { uint first; uint count; uint flags; uint kind; };
#ifdef VULKAN_BINDINGS
#define BINDING(index) [[vk::binding(index, 0)]]
#else
#define BINDING(index)
#endif
BINDING(0) StructuredBuffer<Surface> surfaces : register(t0);
BINDING(1) StructuredBuffer<Light> lights : register(t1);
BINDING(2) StructuredBuffer<float4> vertices : register(t2);
BINDING(3) StructuredBuffer<uint2> pairs : register(t3);
BINDING(4) RWStructuredBuffer<float4> values : register(u0);
BINDING(5) Texture2DArray<float4> table : register(t5);
BINDING(6) SamplerState table_sampler : register(s0);

[numthreads(64, 1, 1)]
void main(uint3 invocation : SV_DispatchThreadID) {
    uint index = invocation.x;
    uint count, stride;
    pairs.GetDimensions(count, stride);
    if (index >= count) {
        return;
    }
    Surface at = surfaces[pairs[index].x];
    Light light = lights[pairs[index].y];
    bool two_sided = (light.flags & 1u) != 0u;
    float width, height, layers;
    table.GetDimensions(width, height, layers);
    LtcSurface surface = ltc_surface(at.position, at.normal, at.view, at.roughness);
    LtcLobes lobes = ltc_lobes_from_table(surface, table, table_sampler, width, 0);
    uint first = light.first;
    float4 a = vertices[first];
    float3 value;
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
    values[index] = float4(value, 0.0);
}
