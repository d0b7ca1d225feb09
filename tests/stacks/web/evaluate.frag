// The evaluation kernel as a fragment shader of GLSL ES 300 around the translated include, which is inserted at the line
// that names it. Arrays are textures, 1024 texels wide.
precision highp float;
precision highp int;
precision highp sampler2DArray;
precision highp sampler2D;
precision highp usampler2D;

//include

uniform sampler2D surfaces;
uniform usampler2D lights;
uniform sampler2D vertices;
uniform usampler2D pairs;
uniform sampler2DArray table;
uniform uint count;
out vec4 result;

ivec2 place(uint index) {
    return ivec2(int(index & 1023u), int(index >> 10u));
}

vec4 vertex(uint index) {
    return texelFetch(vertices, place(index), 0);
}

void main() {
    uint index = uint(gl_FragCoord.y) * 1024u + uint(gl_FragCoord.x);
    if (index >= count) {
        result = vec4(0.0);
        return;
    }
    uvec2 pair = texelFetch(pairs, place(index), 0).xy;
    vec4 position = texelFetch(surfaces, place(3u * pair.x), 0);
    vec3 normal = texelFetch(surfaces, place(3u * pair.x + 1u), 0).xyz;
    vec3 view = texelFetch(surfaces, place(3u * pair.x + 2u), 0).xyz;
    uvec4 light = texelFetch(lights, place(pair.y), 0);
    bool two_sided = (light.z & 1u) != 0u;
    LtcSurface surface = ltc_surface(position.xyz, normal, view, position.w);
    LtcLobes lobes = ltc_lobes_from_table(surface, table, float(textureSize(table, 0).x), 0);
    uint first = light.x;
    vec4 a = vertex(first);
    vec3 value;
    if (light.w == 1u) {
        value = ltc_disk(surface, lobes, a.xyz, vertex(first + 1u).xyz, vertex(first + 2u).xyz, two_sided);
    } else if (light.w == 2u) {
        value = ltc_sphere(surface, lobes, a.xyz, a.w);
    } else if (light.w == 3u) {
        value = ltc_tube(surface, lobes, a.xyz, vertex(first + 1u).xyz, a.w, (light.z & 4u) != 0u);
    } else if ((light.z & 2u) != 0u) {
        value = ltc_quad(surface, lobes, a.xyz, vertex(first + 1u).xyz, vertex(first + 2u).xyz, vertex(first + 3u).xyz, two_sided);
    } else {
        LtcPolygon polygon = ltc_polygon_begin(surface, a.xyz);
        for (uint i = 1u; i < light.y; i++) {
            ltc_polygon_add(polygon, surface, lobes, vertex(first + i).xyz);
        }
        value = ltc_polygon_end(polygon, surface, lobes, two_sided);
    }
    result = vec4(value, 0.0);
}
