// The evaluation kernel as a C++ program around the translated include in Metal.
//
//   evaluate INPUT OUTPUT
//
// INPUT: the counts of surfaces, lights, vertices, pairs and the table's size as uint32, then those
// arrays as the kernel binds them, then the texels of all layers of the table as floats. OUTPUT: four floats a pair.
//
// ROUNDING, where defined, is a rounding mode of <cfenv>; FLUSH flushes denormal numbers to zero: what a device may do.
#include <cfenv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include INCLUDE

struct Surface { float position[3], roughness, normal[3], spare_a, view[3], spare_b; };
struct Light { uint32_t first, count, flags, kind; };
struct Pair { uint32_t surface, light; };

template <class T> std::vector<T> read(FILE *file, size_t count) {
    std::vector<T> values(count);
    if (std::fread(values.data(), sizeof(T), count, file) != count) std::exit(1);
    return values;
}

int main(int, char **arguments) {
    FILE *input = std::fopen(arguments[1], "rb");
    const auto counts = read<uint32_t>(input, 5);
    const auto surfaces = read<Surface>(input, counts[0]);
    const auto lights = read<Light>(input, counts[1]);
    const auto vertices = read<metal::float4>(input, counts[2]);
    const auto pairs = read<Pair>(input, counts[3]);
    const uint32_t size = counts[4];
    std::vector<metal::float4> texels;
    for (metal::float4 texel; std::fread(&texel, sizeof texel, 1, input) == 1;) texels.push_back(texel);
    const uint32_t layers = uint32_t(texels.size()) / (size * size);
    const metal::texture2d_array<float, metal::access::sample> table{texels.data(), size, size, layers};
#ifdef ROUNDING
    std::fesetround(ROUNDING);
#endif
#ifdef FLUSH
    __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040);
#endif
    FILE *output = std::fopen(arguments[2], "wb");
    for (const Pair pair : pairs) {
        const Surface &at = surfaces[pair.surface];
        const Light light = lights[pair.light];
        const bool two_sided = light.flags & 1;
        const LtcSurface surface = ltc_surface(metal::float3{at.position[0], at.position[1], at.position[2]},
            metal::float3{at.normal[0], at.normal[1], at.normal[2]},
            metal::float3{at.view[0], at.view[1], at.view[2]}, at.roughness);
        const LtcLobes lobes = ltc_lobes_from_table(surface, table, metal::sampler{}, float(size), 0);
        const auto vertex = [&](uint32_t i) { return vertices[light.first + i].xyz; };
        const float radius = vertices[light.first].w;
        metal::float3 value;
        if (light.kind == 1) {
            value = ltc_disk(surface, lobes, vertex(0), vertex(1), vertex(2), two_sided);
        } else if (light.kind == 2) {
            value = ltc_sphere(surface, lobes, vertex(0), radius);
        } else if (light.kind == 3) {
            value = ltc_tube(surface, lobes, vertex(0), vertex(1), radius, light.flags & 4);
        } else if (light.flags & 2) {
            value = ltc_quad(surface, lobes, vertex(0), vertex(1), vertex(2), vertex(3), two_sided);
        } else {
            LtcPolygon polygon = ltc_polygon_begin(surface, vertex(0));
            for (uint32_t i = 1; i < light.count; i++) ltc_polygon_add(polygon, surface, lobes, vertex(i));
            value = ltc_polygon_end(polygon, surface, lobes, two_sided);
        }
        const float result[4] = {value.x, value.y, value.z, 0};
        std::fwrite(result, sizeof result, 1, output);
    }
    return std::fclose(output);
}
